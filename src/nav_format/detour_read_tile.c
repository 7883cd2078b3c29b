// SPDX-License-Identifier: MIT
//
// From Detour's tile to ours. Corners are rounded to the lattice that Recast had them on, where convexity and seams are
// exact. So faults that Detour's floats hide are found: polygons without area or not convex, and one-way links.
//
// The bytes may come from anywhere: counts are checked against the size before anything is read, and every index
// before it is used.

#include "nav_format/detour_read.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_format/lattice_polygon.h"
#include "nav_format/source_check.h"
#include "nav_format/triangle_fan.h"

#include <string.h>

typedef struct reading {
    tl_detour_tile_bytes tile;
    float cell_size, cell_height;
    tl_arena *arena;
    tl_detour_report *report;
    tl_polygon_mesh mesh;
    uint64_t *flags;
    uint32_t *own; // Detour's polygon to ours, or TL_NO_POLYGON
    uint32_t *theirs;
    tl_nav_detail detail;
} reading;

// ---------------------------------------------------------------------------------------------------------
// The header.

static tl_result check_counts(const tl_detour_header *h, tl_detour_report *report)
{
    bool right = h->polygon_count >= 0 && h->vertex_count >= 0 && h->max_link_count >= 0 && h->detail_mesh_count >= 0 &&
                 h->detail_vertex_count >= 0 && h->detail_triangle_count >= 0 && h->node_count >= 0 &&
                 h->off_mesh_count >= 0 && h->off_mesh_count <= h->vertex_count / 2 &&
                 h->detail_mesh_count <= h->polygon_count && h->polygon_count <= TL_DETOUR_MAX_POLYGONS + 1 &&
                 h->vertex_count <= TL_DETOUR_MAX_VERTICES + 1;
    return right
               ? TL_OK
               : tl_report_fail(&report->base, TL_ERR_CORRUPT, "tile", TL_NO_ELEMENT, "a count in its header is wrong");
}

// The header tells the size of everything but the links, of which a reference may have four bytes or eight.
tl_result tl_detour_open_tile(const uint8_t *bytes, uint64_t size, tl_detour_tile_bytes *tile, tl_detour_report *report)
{
    tl_detour_header *h = &tile->header;
    if (size < 8) {
        return tl_report_fail(&report->base, TL_ERR_TRUNCATED, "tile", TL_NO_ELEMENT,
                              "the bytes end too early: give them all");
    }
    memcpy(h, bytes, size < sizeof *h ? 8 : sizeof *h);
    if ((uint32_t)h->magic != TL_DETOUR_TILE_MAGIC) {
        return tl_report_fail(&report->base, TL_ERR_MAGIC, "tile", TL_NO_ELEMENT, "this is no data of a Detour tile");
    }
    if (h->version != TL_DETOUR_TILE_VERSION) {
        return tl_report_fail(&report->base, TL_ERR_VERSION, "tile", TL_NO_ELEMENT, "tiles of version 7 can be read");
    }
    if (size < sizeof *h) {
        return tl_report_fail(&report->base, TL_ERR_TRUNCATED, "tile", TL_NO_ELEMENT,
                              "the bytes end too early: give them all");
    }
    TL_TRY(check_counts(h, report));
    tl_detour_offsets narrow = tl_detour_offsets_of(h, TL_DETOUR_REFS_32);
    tl_detour_offsets wide = tl_detour_offsets_of(h, TL_DETOUR_REFS_64);
    tile->bytes = bytes;
    tile->at = size == wide.end ? wide : narrow;
    if (size < narrow.end) {
        return tl_report_fail(&report->base, TL_ERR_TRUNCATED, "tile", TL_NO_ELEMENT,
                              "the bytes end too early: give them all");
    }
    if (size != narrow.end && size != wide.end) {
        return tl_report_fail(&report->base, TL_ERR_CORRUPT, "tile", TL_NO_ELEMENT,
                              "its header does not account for all its bytes");
    }
    if (!tl_detour_is_finite(h->min) || !tl_detour_is_finite(h->max) || !isfinite(h->walkable_height) ||
        !isfinite(h->walkable_radius) || !isfinite(h->walkable_climb)) {
        return tl_report_fail(&report->base, TL_ERR_NOT_FINITE, "tile", TL_NO_ELEMENT, "use finite numbers");
    }
    if (!(h->quantization > 0.0f) || !isfinite(h->quantization) || !isfinite(1.0f / h->quantization)) {
        return tl_report_fail(
            &report->base, TL_ERR_RANGE, "tile", TL_NO_ELEMENT,
            "its bounding volume factor is not one by a cell's size; build the tile with its cell size set");
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Corners, polygons, links.

static tl_result read_vertices(reading *r)
{
    const tl_detour_tile_bytes *tile = &r->tile;
    // The last ones are ends of off-mesh connections, which lie anywhere.
    uint32_t count = (uint32_t)(tile->header.vertex_count - 2 * tile->header.off_mesh_count);
    int32_t *out = TL_PUSH(r->arena, int32_t, 3 * (uint64_t)count);
    if (out == NULL) {
        return TL_ERR_MEMORY;
    }
    const double size = (double)r->cell_size, across = size * (double)tile->tile_size;
    const double base[3] = { (double)tile->origin.x + across * (double)tile->header.x, (double)tile->origin.y,
                             (double)tile->origin.z + across * (double)tile->header.y };
    const double step[3] = { size, (double)r->cell_height, size };
    for (uint32_t i = 0; i < count; i++) {
        float v[3];
        memcpy(v, tile->bytes + tile->at.vertices + sizeof v * (uint64_t)i, sizeof v);
        if (!tl_detour_is_finite(v)) {
            return tl_report_fail(&r->report->base, TL_ERR_NOT_FINITE, "vertex", i, "use finite numbers");
        }
        for (int k = 0; k < 3; k++) {
            double off;
            int32_t at = tl_detour_nearest_step(((double)v[k] - base[k]) / step[k], &off);
            if (at == INT32_MAX || (k != 1 && off > TL_DETOUR_ON_LATTICE)) {
                return tl_report_fail(
                    &r->report->base, TL_ERR_RANGE, "vertex", i,
                    "it does not lie on the lattice of the tile's cells; was the tile made by Recast?");
            }
            out[3 * (size_t)i + (size_t)k] = at;
        }
    }
    r->mesh.vertices = out;
    r->mesh.vertex_count = count;
    return TL_OK;
}

static tl_detour_polygon detour_polygon(const reading *r, uint32_t p)
{
    tl_detour_polygon polygon;
    memcpy(&polygon, r->tile.bytes + r->tile.at.polygons + sizeof polygon * (uint64_t)p, sizeof polygon);
    return polygon;
}

static bool has_area_and_is_convex(const int32_t *vertices, const tl_detour_polygon *polygon)
{
    uint32_t corners[TL_DETOUR_MAX_CORNERS];
    for (uint32_t k = 0; k < polygon->vertex_count; k++) {
        corners[k] = polygon->vertices[k];
    }
    tl_nav_lattice_polygon outline;
    tl_nav_gather_polygon(vertices, corners, polygon->vertex_count, &outline);
    return tl_nav_double_area(&outline) > 0 && tl_nav_is_convex(&outline);
}

// Numbers the polygons that stay.
static tl_result choose_polygons(reading *r)
{
    uint32_t count = (uint32_t)r->tile.header.polygon_count, kept = 0, corners = 0;
    r->own = TL_PUSH(r->arena, uint32_t, count);
    r->theirs = TL_PUSH(r->arena, uint32_t, count);
    if (r->own == NULL || r->theirs == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < count; p++) {
        tl_detour_polygon polygon = detour_polygon(r, p);
        r->own[p] = TL_NO_POLYGON;
        if (polygon.area_and_type >> 6 != TL_DETOUR_GROUND) {
            r->report->off_mesh_links++;
            continue;
        }
        bool right = polygon.vertex_count >= 3 && polygon.vertex_count <= TL_DETOUR_MAX_CORNERS;
        for (uint32_t k = 0; right && k < polygon.vertex_count; k++) {
            right = polygon.vertices[k] < r->mesh.vertex_count;
        }
        if (!right) {
            return tl_report_fail(&r->report->base, TL_ERR_CORRUPT, "polygon", p, "its corners are out of range");
        }
        if (!has_area_and_is_convex(r->mesh.vertices, &polygon)) {
            r->report->dropped_polygons++;
            continue;
        }
        r->own[p] = kept;
        r->theirs[kept++] = p;
        corners += polygon.vertex_count;
    }
    r->mesh.polygon_count = kept;
    r->mesh.index_count = corners;
    return kept > 0 ? TL_OK
                    : tl_report_fail(&r->report->base, TL_ERR_EMPTY, "polygon", TL_NO_ELEMENT, "give at least one");
}

// What lies across an edge, in our numbers; not yet whether it links back.
static uint32_t detour_across(const reading *r, const tl_detour_polygon *polygon, uint32_t edge)
{
    static const uint32_t sides[4] = { 2, 1, 0, 3 }; // of Detour's 0 x+, 2 z+, 4 x-, 6 z-
    uint32_t link = polygon->neighbours[edge];
    if ((link & TL_DETOUR_EXTERNAL) != 0) {
        uint32_t side = link & 0xffu;
        return side < 8 && side % 2 == 0 ? TL_PORTAL | sides[side / 2] : TL_NO_POLYGON;
    }
    return link != 0 && link <= (uint32_t)r->tile.header.polygon_count ? r->own[link - 1] : TL_NO_POLYGON;
}

// Both ends of a broken link become walls in one pass each, so no chain of repairs can arise: a link that points back
// to one that was cut is cut by its own check.
static void cut_one_way_links(reading *r)
{
    tl_polygon_mesh *mesh = &r->mesh;
    bool again = true;
    while (again) {
        again = false;
        for (uint32_t p = 0; p < mesh->polygon_count; p++) {
            for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
                if (mesh->neighbours[k] < mesh->polygon_count &&
                    !tl_nav_links_back(mesh->first, mesh->indices, mesh->neighbours, p, k)) {
                    mesh->neighbours[k] = TL_NO_POLYGON;
                    r->report->one_way_links++;
                    again = true;
                }
            }
        }
    }
}

static tl_result read_polygons(reading *r)
{
    TL_TRY(choose_polygons(r));
    tl_polygon_mesh *mesh = &r->mesh;
    mesh->first = TL_PUSH(r->arena, uint32_t, (uint64_t)mesh->polygon_count + 1);
    mesh->indices = TL_PUSH(r->arena, uint32_t, mesh->index_count);
    mesh->neighbours = TL_PUSH(r->arena, uint32_t, mesh->index_count);
    mesh->areas = TL_PUSH(r->arena, uint32_t, mesh->polygon_count);
    r->flags = TL_PUSH(r->arena, uint64_t, mesh->polygon_count);
    if (mesh->first == NULL || mesh->indices == NULL || mesh->neighbours == NULL || mesh->areas == NULL ||
        r->flags == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t at = 0;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        tl_detour_polygon polygon = detour_polygon(r, r->theirs[p]);
        uint32_t area = polygon.area_and_type & 0x3fu;
        r->report->area_zeros += area == 0;
        mesh->areas[p] = area != 0 ? area : TL_DETOUR_MAX_AREA;
        r->flags[p] = polygon.flags;
        mesh->first[p] = at;
        for (uint32_t k = 0; k < polygon.vertex_count; k++) {
            mesh->indices[at] = polygon.vertices[k];
            mesh->neighbours[at++] = detour_across(r, &polygon, k);
        }
    }
    mesh->first[mesh->polygon_count] = at;
    cut_one_way_links(r);
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Heights.

static tl_vec3 detour_corner(const reading *r, uint32_t vertex)
{
    float v[3];
    memcpy(v, r->tile.bytes + r->tile.at.vertices + sizeof v * (uint64_t)vertex, sizeof v);
    return tl_vec3_make(v[0], v[1], v[2]);
}

// Detour's patch of our polygon p. False when there is none, or its ranges are wrong.
static bool find_patch(const reading *r, uint32_t p, tl_detour_patch *from)
{
    const tl_detour_header *h = &r->tile.header;
    uint32_t theirs = r->theirs[p];
    if (theirs >= (uint32_t)h->detail_mesh_count) {
        return false;
    }
    memcpy(from, r->tile.bytes + r->tile.at.patches + sizeof *from * (uint64_t)theirs, sizeof *from);
    return from->triangle_count > 0 &&
           (uint64_t)from->vertex_base + from->vertex_count <= (uint64_t)h->detail_vertex_count &&
           (uint64_t)from->triangle_base + from->triangle_count <= (uint64_t)h->detail_triangle_count;
}

static bool read_patch(reading *r, uint32_t p, tl_nav_detail_patch *patch)
{
    uint32_t corner_count = r->mesh.first[p + 1] - r->mesh.first[p];
    tl_detour_patch from;
    if (!find_patch(r, p, &from)) {
        return false;
    }
    for (uint32_t i = 0; i < from.vertex_count; i++) {
        float v[3];
        memcpy(v, r->tile.bytes + r->tile.at.detail_vertices + sizeof v * ((uint64_t)from.vertex_base + i), sizeof v);
        if (!tl_detour_is_finite(v)) {
            return false;
        }
        r->detail.vertices[patch->first_vertex + corner_count + i] = tl_vec3_make(v[0], v[1], v[2]);
    }
    patch->vertex_count = corner_count + from.vertex_count;
    for (uint32_t i = 0; i < from.triangle_count; i++) {
        const uint8_t *t = r->tile.bytes + r->tile.at.detail_triangles + 4 * ((uint64_t)from.triangle_base + i);
        tl_nav_detail_triangle triangle = { { t[0], t[1], t[2] }, 0 };
        for (uint32_t k = 0; k < 3; k++) {
            if (t[k] >= patch->vertex_count) {
                return false;
            }
            uint32_t outline = t[3] >> (2 * k) & TL_DETOUR_EDGE_OUTLINE;
            triangle.edge_flags = (uint16_t)(triangle.edge_flags | outline << k);
        }
        r->detail.triangles[patch->first_triangle + i] = triangle;
    }
    patch->triangle_count = from.triangle_count;
    return true;
}

// A patch that is missing or cannot be used becomes a fan over the polygon's corners.
static void fan_patch(reading *r, uint32_t corner_count, tl_nav_detail_patch *patch)
{
    patch->vertex_count = corner_count;
    patch->triangle_count = corner_count - 2;
    for (uint32_t i = 0; i + 2 < corner_count; i++) {
        r->detail.triangles[patch->first_triangle + i] = tl_nav_fan_triangle(i, corner_count);
    }
}

static tl_result read_detail(reading *r)
{
    tl_nav_detail *detail = &r->detail;
    uint32_t count = r->mesh.polygon_count;
    uint64_t vertices = r->mesh.index_count, triangles = r->mesh.index_count; // fans have fewer
    for (uint32_t p = 0; p < count; p++) {
        tl_detour_patch from;
        if (find_patch(r, p, &from)) {
            vertices += from.vertex_count;
            triangles += from.triangle_count;
        }
    }
    detail->patches = TL_PUSH(r->arena, tl_nav_detail_patch, count);
    detail->vertices = TL_PUSH(r->arena, tl_vec3, vertices);
    detail->triangles = TL_PUSH(r->arena, tl_nav_detail_triangle, triangles);
    if (detail->patches == NULL || detail->vertices == NULL || detail->triangles == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < count; p++) {
        uint32_t first = r->mesh.first[p], corner_count = r->mesh.first[p + 1] - first;
        tl_nav_detail_patch *patch = &detail->patches[p];
        memset(patch, 0, sizeof *patch);
        patch->first_vertex = detail->vertex_count;
        patch->first_triangle = detail->triangle_count;
        for (uint32_t k = 0; k < corner_count; k++) {
            detail->vertices[detail->vertex_count + k] = detour_corner(r, r->mesh.indices[first + k]);
        }
        if (!read_patch(r, p, patch)) {
            r->report->plain_patches++;
            fan_patch(r, corner_count, patch);
        }
        detail->vertex_count += patch->vertex_count;
        detail->triangle_count += patch->triangle_count;
    }
    detail->patch_count = count;
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Tiles and sets.

static float at_least(float value, float least)
{
    return value > least ? value : least;
}

static tl_result make_tile(reading *r, const tl_allocator *allocator, tl_nav_tile **tile_out)
{
    const tl_detour_tile_bytes *tile = &r->tile;
    TL_TRY(read_vertices(r));
    TL_TRY(read_polygons(r));
    TL_TRY(read_detail(r));
    r->mesh.cell_size = r->cell_size;
    r->mesh.cell_height = r->cell_height;
    double across = (double)r->cell_size * (double)tile->tile_size;
    r->mesh.bounds.min = tl_vec3_make((float)((double)tile->origin.x + across * (double)tile->header.x), tile->origin.y,
                                      (float)((double)tile->origin.z + across * (double)tile->header.y));
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &r->mesh;
    source.detail = &r->detail;
    source.tile_x = tile->tile_size != 0 ? tile->header.x : 0;
    source.tile_z = tile->tile_size != 0 ? tile->header.y : 0;
    source.tile_size = tile->tile_size;
    source.layer = tile->tile_size != 0 ? (uint32_t)tile->header.layer : 0;
    source.origin = tile->origin;
    source.agent_height = at_least(tile->header.walkable_height, r->cell_height);
    source.agent_radius = at_least(tile->header.walkable_radius, 0.0f);
    source.agent_max_climb = at_least(tile->header.walkable_climb, 0.0f);
    source.flags = r->flags;
    r->report->polygon_count += r->mesh.polygon_count;
    r->report->tile_count++;
    return tl_nav_tile_encode(&source, allocator, tile_out, &r->report->base);
}

tl_result tl_detour_read_tile(const tl_detour_tile_bytes *tile, const tl_detour_read_def *def, tl_detour_report *report,
                              tl_nav_tile **tile_out)
{
    reading r;
    memset(&r, 0, sizeof r);
    tl_arena arena;
    tl_arena_init(&arena, def->allocator);
    r.tile = *tile;
    r.cell_size = 1.0f / tile->header.quantization;
    r.cell_height = def->cell_height;
    r.arena = &arena;
    r.report = report;
    tl_result result = make_tile(&r, def->allocator, tile_out);
    tl_arena_free(&arena);
    return result;
}
