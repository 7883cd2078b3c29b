// SPDX-License-Identifier: MIT
//
// A tile of some of another tile's polygons: its arrays are read back as a source, without the others, and encoded.

#include "nav_format/tile_subset.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <string.h>

typedef struct subset {
    const tl_nav_tile *tile;
    const uint8_t *keep;
    tl_nav_cut *cuts;
    uint32_t cut_count;
    const tl_nav_layering *layering; // NULL: `keep` says what is kept
    uint32_t layer;                  // of what is made
    tl_polygon_mesh mesh;
    tl_nav_detail detail;
    uint64_t *flags;
    uint32_t *number;        // [polygons of the tile]: its number among those kept, or TL_NO_POLYGON
    uint32_t *vertex_number; // [vertices of the tile]: the same, in the tile's order
} subset;

static bool keeps(const subset *s, uint32_t p)
{
    return s->layering != NULL ? s->layering->layers[p] == s->layer : s->keep[p] != 0;
}

static tl_result allocate_subset(subset *s, tl_arena *arena)
{
    const tl_nav_tile *tile = s->tile;
    tl_polygon_mesh *mesh = &s->mesh;
    s->number = TL_PUSH(arena, uint32_t, tile->polygon_count);
    s->vertex_number = TL_PUSH_ZERO(arena, uint32_t, tile->vertex_count);
    s->flags = TL_PUSH(arena, uint64_t, tile->polygon_count);
    s->detail.patches = TL_PUSH(arena, tl_nav_detail_patch, tile->polygon_count);
    s->detail.triangles = TL_PUSH(arena, tl_nav_detail_triangle, tile->detail_triangle_count);
    mesh->vertices = TL_PUSH(arena, int32_t, 3 * (uint64_t)tile->vertex_count);
    mesh->first = TL_PUSH(arena, uint32_t, (uint64_t)tile->polygon_count + 1);
    mesh->indices = TL_PUSH(arena, uint32_t, tile->corner_count);
    mesh->neighbours = TL_PUSH(arena, uint32_t, tile->corner_count);
    mesh->areas = TL_PUSH(arena, uint32_t, tile->polygon_count);
    s->cuts = TL_PUSH(arena, tl_nav_cut, tile->corner_count);
    return s->cuts != NULL && s->number != NULL && s->vertex_number != NULL && s->flags != NULL &&
                   s->detail.patches != NULL && s->detail.triangles != NULL && mesh->vertices != NULL &&
                   mesh->first != NULL && mesh->indices != NULL && mesh->neighbours != NULL && mesh->areas != NULL
               ? TL_OK
               : TL_ERR_MEMORY;
}

static void number_what_is_kept(subset *s)
{
    const tl_nav_tile *tile = s->tile;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        s->number[p] = keeps(s, p) ? s->mesh.polygon_count++ : TL_NO_POLYGON;
        const uint32_t end = tl_nav_tile_first_corner(tile, p + (s->number[p] != TL_NO_POLYGON ? 1 : 0));
        for (uint32_t k = tl_nav_tile_first_corner(tile, p); k < end; k++) {
            s->vertex_number[tl_nav_tile_corner_vertex(tile, k)] = 1;
        }
    }
    for (uint32_t v = 0; v < tile->vertex_count; v++) {
        if (s->vertex_number[v] != 0) {
            const tl_nav_lattice_point point = tl_nav_tile_vertex(tile, v);
            memcpy(s->mesh.vertices + 3 * (size_t)s->mesh.vertex_count, point.at, sizeof point.at);
            s->vertex_number[v] = s->mesh.vertex_count++;
        }
    }
}

static void add_subset_cut(subset *s, uint32_t layer, uint32_t ordinal)
{
    const tl_nav_cut cut = { s->mesh.index_count, layer, ordinal };
    s->cuts[s->cut_count++] = cut;
}

// What lies across a corner's edge in the mesh that is made; a cut is noted.
static uint32_t subset_across(subset *s, uint32_t p, uint32_t k, uint32_t edge)
{
    const tl_nav_tile *tile = s->tile;
    const uint32_t across = tl_nav_tile_neighbour(tile, p, edge);
    if (across == (TL_PORTAL | TL_NAV_SIDE_CUT)) {
        const tl_nav_portal *portal = tl_nav_tile_portals(tile) + tl_nav_link_portal(tl_nav_tile_link(tile, k));
        add_subset_cut(s, (uint32_t)portal->low, (uint32_t)portal->high);
        return TL_NO_POLYGON;
    }
    if (across >= tile->polygon_count) {
        return across;
    }
    if (s->layering != NULL && s->number[across] == TL_NO_POLYGON) {
        add_subset_cut(s, s->layering->layers[across], s->layering->ordinals[k]);
    }
    return s->number[across];
}

static void copy_kept_polygon(subset *s, uint32_t p)
{
    const tl_nav_tile *tile = s->tile;
    const uint32_t to = s->number[p];
    tl_polygon_mesh *mesh = &s->mesh;
    mesh->first[to] = mesh->index_count;
    mesh->areas[to] = tl_nav_tile_area(tile, p);
    s->flags[to] = tl_nav_tile_flags(tile, p);
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, p);
    for (uint32_t k = corners.begin; k < corners.end; k++) {
        mesh->neighbours[mesh->index_count] = subset_across(s, p, k, k - corners.begin);
        mesh->indices[mesh->index_count++] = s->vertex_number[tl_nav_tile_corner_vertex(tile, k)];
    }
    const tl_nav_surface surface = tl_nav_tile_surface(tile, p);
    const uint32_t first_triangle = tl_nav_tile_first(tile, tile->detail_first_triangle, p);
    for (uint32_t i = 0; i < surface.triangle_count; i++) {
        s->detail.triangles[first_triangle + i] = tl_nav_surface_triangle(&surface, i);
    }
    const tl_nav_detail_patch patch = { tl_nav_tile_first(tile, tile->detail_first_vertex, p), surface.vertex_count,
                                        first_triangle, surface.triangle_count };
    s->detail.patches[to] = patch;
}

// The source's array is read only; its struct has no const because builds own theirs.
static void borrow_surface(const tl_nav_tile *tile, tl_nav_detail *detail)
{
    union {
        const void *from;
        void *to;
    } vertices;
    vertices.from = tl_nav_tile_at(tile, tile->detail_vertices);
    detail->vertices = vertices.to;
    detail->vertex_count = tile->detail_vertex_count;
    detail->triangle_count = tile->detail_triangle_count;
}

static tl_result encode_subset(subset *s, const tl_allocator *allocator, tl_nav_tile **tile_out, tl_report *report)
{
    const tl_nav_tile *tile = s->tile;
    s->mesh.cell_size = tile->cell_size;
    s->mesh.cell_height = tile->cell_height;
    s->mesh.max_verts_per_poly = TL_NAV_MAX_CORNERS;
    s->mesh.bounds.min = tl_vec3_make(
        tl_nav_tile_position(tile->origin.x, tile->tile_x, tile->tile_size, 0, tile->cell_size), tile->origin.y,
        tl_nav_tile_position(tile->origin.z, tile->tile_z, tile->tile_size, 0, tile->cell_size));
    s->detail.patch_count = s->mesh.polygon_count;
    borrow_surface(tile, &s->detail);
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &s->mesh;
    source.detail = &s->detail;
    source.tile_x = tile->tile_x;
    source.tile_z = tile->tile_z;
    source.tile_size = tile->tile_size;
    source.origin = tile->origin;
    source.agent_height = tile->agent_height;
    source.agent_radius = tile->agent_radius;
    source.agent_max_climb = tile->agent_max_climb;
    source.flags = s->flags;
    source.layer = s->layer;
    source.cuts = s->cuts;
    source.cut_count = s->cut_count;
    return tl_nav_tile_encode(&source, allocator, tile_out, report);
}

static tl_result make_subset(subset *s, tl_arena *arena, const tl_allocator *allocator, tl_nav_tile **tile_out,
                             tl_report *report)
{
    TL_TRY(allocate_subset(s, arena));
    number_what_is_kept(s);
    for (uint32_t p = 0; p < s->tile->polygon_count; p++) {
        if (s->number[p] != TL_NO_POLYGON) {
            copy_kept_polygon(s, p);
        }
    }
    s->mesh.first[s->mesh.polygon_count] = s->mesh.index_count;
    return encode_subset(s, allocator, tile_out, report);
}

static tl_result run_subset(subset *s, const tl_allocator *allocator, tl_nav_tile **tile_out, tl_report *report)
{
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    *tile_out = NULL;
    const tl_result result = make_subset(s, &arena, allocator, tile_out, report);
    tl_arena_free(&arena);
    return result;
}

tl_result tl_nav_tile_layer(const tl_nav_tile *tile, const tl_nav_layering *layering, uint32_t layer,
                            const tl_allocator *allocator, tl_nav_tile **tile_out, tl_report *report)
{
    subset s;
    memset(&s, 0, sizeof s);
    s.tile = tile;
    s.layering = layering;
    s.layer = layer;
    return run_subset(&s, allocator, tile_out, report);
}

tl_result tl_nav_tile_subset(const tl_nav_tile *tile, const uint8_t *keep, const tl_allocator *allocator,
                             tl_nav_tile **tile_out, tl_report *report_out)
{
    tl_report_begin(report_out, "subset");
    TL_REFUSE_NULL(tile_out, report_out);
    *tile_out = NULL;
    TL_REFUSE_NULL(tile, report_out);
    TL_REFUSE_NULL(keep, report_out);
    subset s;
    memset(&s, 0, sizeof s);
    s.tile = tile;
    s.keep = keep;
    s.layer = tile->layer;
    return run_subset(&s, allocator, tile_out, report_out);
}
