// SPDX-License-Identifier: MIT
//
// Encoding a tile: polygons and detail are laid out as one immutable block that queries read in place.

#include "base/assert.h"
#include "base/host.h"
#include "nav_format/box_tree.h"
#include "nav_format/lattice_polygon.h"
#include "nav_format/portal_bake.h"
#include "nav_format/source_check.h"
#include "nav_format/tile_layout.h"
#include "nav_format/triangle_fan.h"

#include <string.h>

// Which arrays need their wider elements.
static void bake_widths(const tl_nav_tile_source *source, tl_nav_tile *tile)
{
    const tl_polygon_mesh *polygons = source->polygons;
    tile->wide = polygons->vertex_count > UINT16_MAX + 1u ? TL_NAV_WIDE_CORNERS : 0;
    for (size_t i = 0; i < 3 * (size_t)polygons->vertex_count; i++) {
        const bool fits = polygons->vertices[i] >= 0 && polygons->vertices[i] <= UINT16_MAX;
        tile->wide |= fits ? 0 : TL_NAV_WIDE_LATTICE;
    }
    tile->wide |= tl_nav_needs_wide_firsts(tile) ? TL_NAV_WIDE_FIRSTS : 0;
    tile->wide |= tl_nav_needs_wide_links(tile) ? TL_NAV_WIDE_LINKS : 0;
    for (uint32_t p = 0; source->flags != NULL && p < polygons->polygon_count; p++) {
        tile->wide |= source->flags[p] > UINT8_MAX ? TL_NAV_WIDE_FLAGS : 0;
    }
    for (uint32_t p = 0; source->detail != NULL && p < polygons->polygon_count; p++) {
        tile->wide |= source->detail->patches[p].vertex_count > UINT8_MAX + 1u ? TL_NAV_WIDE_TRIANGLES : 0;
    }
}

static void bake_header(const tl_nav_tile_source *source, const tl_nav_portals *portals, tl_nav_tile *tile)
{
    const tl_polygon_mesh *polygons = source->polygons;
    tile->tile_x = source->tile_x;
    tile->tile_z = source->tile_z;
    tile->tile_size = source->tile_size;
    tile->polygon_count = polygons->polygon_count;
    tile->vertex_count = polygons->vertex_count;
    tile->corner_count = polygons->index_count;
    tile->node_count = 2 * polygons->polygon_count - 1; // a binary tree with one polygon a leaf
    tile->portal_count = portals->portal_count;
    tile->profile_count = portals->profile_count;
    memcpy(tile->side_end, portals->side_end, sizeof tile->side_end);
    tile->layer = source->layer;
    // Without detail a polygon of n corners is a fan of n - 2 triangles.
    tile->detail_vertex_count = polygons->index_count;
    tile->detail_triangle_count = polygons->index_count - 2 * polygons->polygon_count;
    if (source->detail != NULL) {
        tile->detail_vertex_count = 0;
        tile->detail_triangle_count = 0;
        for (uint32_t p = 0; p < polygons->polygon_count; p++) {
            tile->detail_vertex_count += source->detail->patches[p].vertex_count;
            tile->detail_triangle_count += source->detail->patches[p].triangle_count;
        }
    }
    tile->origin = source->origin;
    tile->cell_size = polygons->cell_size;
    tile->cell_height = polygons->cell_height;
    tile->agent_height = source->agent_height;
    tile->agent_radius = source->agent_radius;
    tile->agent_max_climb = source->agent_max_climb;
    bake_widths(source, tile);
}

// In 32 bits or in 16, which hold it.
static void write_integer(void *array, size_t i, bool is_wide, uint32_t value)
{
    if (is_wide) {
        ((uint32_t *)array)[i] = value;
    } else {
        ((uint16_t *)array)[i] = (uint16_t)value;
    }
}

static void bake_integers(const uint32_t *from, size_t count, bool is_wide, void *to)
{
    for (size_t i = 0; i < count; i++) {
        write_integer(to, i, is_wide, from[i]);
    }
}

static void bake_link(tl_nav_tile *tile, uint32_t corner, uint32_t link)
{
    write_integer(tl_nav_tile_to_write(tile, tile->links), corner, (tile->wide & TL_NAV_WIDE_LINKS) != 0, link);
}

static void bake_first(tl_nav_tile *tile, uint32_t array, uint32_t polygon, uint32_t first)
{
    write_integer(tl_nav_tile_to_write(tile, array), polygon, (tile->wide & TL_NAV_WIDE_FIRSTS) != 0, first);
}

static void bake_polygons(const tl_nav_tile_source *source, tl_nav_tile *tile)
{
    const tl_polygon_mesh *polygons = source->polygons;
    bake_integers(polygons->first, polygons->polygon_count + 1u, (tile->wide & TL_NAV_WIDE_FIRSTS) != 0,
                  tl_nav_tile_to_write(tile, tile->first_corner));
    bake_integers((const uint32_t *)polygons->vertices, 3 * (size_t)polygons->vertex_count,
                  (tile->wide & TL_NAV_WIDE_LATTICE) != 0, tl_nav_tile_to_write(tile, tile->vertices));
    bake_integers(polygons->indices, polygons->index_count, (tile->wide & TL_NAV_WIDE_CORNERS) != 0,
                  tl_nav_tile_to_write(tile, tile->corner_vertices));
    for (uint32_t k = 0; k < polygons->index_count; k++) {
        const uint32_t across = polygons->neighbours[k];
        bake_link(tile, k, across >= TL_PORTAL ? TL_NAV_LINK_WALL : across);
    }
    uint8_t *areas = tl_nav_tile_to_write(tile, tile->areas);
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        tl_nav_tile_set_flags(tile, p, source->flags != NULL ? source->flags[p] : 1);
        areas[p] = (uint8_t)polygons->areas[p];
        tile->area += tl_nav_tile_polygon_area(tile, p);
    }
}

static void bake_portals(const tl_nav_portals *portals, tl_nav_tile *tile)
{
    for (uint32_t i = 0; i < portals->portal_count; i++) {
        bake_link(tile, portals->portals[i].corner, tl_nav_link_portal(i));
    }
    if (portals->portal_count > 0) {
        memcpy(tl_nav_tile_to_write(tile, tile->portals), portals->portals,
               portals->portal_count * sizeof(tl_nav_portal));
        memcpy(tl_nav_tile_to_write(tile, tile->profile), portals->profile,
               portals->profile_count * sizeof(tl_nav_profile_point));
    }
}

// Four numbers a triangle: 8 bits hold the corners of a patch of at most 256 vertices.
static void bake_triangle(const tl_nav_tile *tile, tl_nav_detail_triangle triangle, uint32_t index, void *triangles)
{
    const uint16_t numbers[4] = { triangle.corner[0], triangle.corner[1], triangle.corner[2], triangle.edge_flags };
    for (size_t k = 0; k < 4; k++) {
        if ((tile->wide & TL_NAV_WIDE_TRIANGLES) != 0) {
            ((uint16_t *)triangles)[4 * (size_t)index + k] = numbers[k];
        } else {
            ((uint8_t *)triangles)[4 * (size_t)index + k] = (uint8_t)numbers[k];
        }
    }
}

// A polygon's own corners, bit by bit, so that no gap opens between it and its surface.
static void bake_corners(const tl_nav_tile *tile, uint32_t p, tl_vec3 *vertices)
{
    uint32_t count = 0;
    tl_nav_tile_corners(tile, p, &count);
    for (uint32_t i = 0; i < count; i++) {
        vertices[i] = tl_nav_lattice_position(tile, tl_nav_tile_lattice(tile, p, i));
    }
}

// A polygon's surface. `index` of its first triangle. Returns how many it has.
static uint32_t bake_patch(const tl_nav_detail *detail, const tl_nav_tile *tile, uint32_t p, uint32_t index,
                           tl_vec3 *vertices, void *triangles)
{
    uint32_t corner_count = 0;
    tl_nav_tile_corners(tile, p, &corner_count);
    bake_corners(tile, p, vertices);
    if (detail == NULL) {
        for (uint32_t i = 0; i + 2 < corner_count; i++) {
            bake_triangle(tile, tl_nav_fan_triangle(i, corner_count), index + i, triangles);
        }
        return corner_count - 2;
    }
    const tl_nav_detail_patch *patch = &detail->patches[p];
    memcpy(vertices + corner_count, detail->vertices + patch->first_vertex + corner_count,
           (patch->vertex_count - corner_count) * sizeof *vertices);
    for (uint32_t i = 0; i < patch->triangle_count; i++) {
        bake_triangle(tile, detail->triangles[patch->first_triangle + i], index + i, triangles);
    }
    return patch->triangle_count;
}

static void bake_surface(const tl_nav_tile_source *source, tl_nav_tile *tile)
{
    uint32_t first_vertex = 0, first_triangle = 0;
    tl_vec3 *vertices = tl_nav_tile_to_write(tile, tile->detail_vertices);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        uint32_t vertex_count = 0;
        tl_nav_tile_corners(tile, p, &vertex_count);
        vertex_count = source->detail != NULL ? source->detail->patches[p].vertex_count : vertex_count;
        first_triangle += bake_patch(source->detail, tile, p, first_triangle, vertices + first_vertex,
                                     tl_nav_tile_to_write(tile, tile->detail_triangles));
        first_vertex += vertex_count;
        bake_first(tile, tile->detail_first_vertex, p + 1, first_vertex);
        bake_first(tile, tile->detail_first_triangle, p + 1, first_triangle);
    }
}

static tl_result encode_tile(const tl_nav_tile_source *source, const tl_allocator *allocator, tl_arena *arena,
                             tl_nav_tile **tile_out, tl_report *report)
{
    tl_nav_portals portals;
    TL_TRY(tl_nav_bake_portals(source, arena, &portals, report));
    tl_nav_tile header;
    memset(&header, 0, sizeof header);
    bake_header(source, &portals, &header);
    tl_nav_extent extents[TL_NAV_TILE_ARRAYS];
    tl_nav_tile_extents(&header, extents);
    tl_nav_tile_set_offsets(&header, extents);
    if (extents[TL_NAV_TILE_ARRAYS - 1].end > TL_NAV_MAX_TILE_SIZE) {
        return tl_report_fail(report, TL_ERR_LIMIT, "tile", TL_NO_ELEMENT, "use smaller tiles");
    }
    tl_nav_tile *tile =
        tl_blob_allocate(allocator, TL_NAV_TILE_MAGIC, TL_NAV_TILE_VERSION, extents[TL_NAV_TILE_ARRAYS - 1].end);
    if (tile == NULL) {
        return TL_ERR_MEMORY;
    }
    header.blob = tile->blob;
    *tile = header;
    bake_polygons(source, tile);
    bake_portals(&portals, tile);
    bake_surface(source, tile);
    tl_result result = tl_nav_bake_box_tree(tile, arena);
    if (result != TL_OK) {
        tl_blob_free(tile);
        return result;
    }
    TL_VALIDATE(tl_nav_tile_check(tile, tile->blob.size, NULL) == TL_OK);
    *tile_out = tile;
    return TL_OK;
}

tl_result tl_nav_tile_encode(const tl_nav_tile_source *source, const tl_allocator *allocator, tl_nav_tile **tile_out,
                             tl_report *report_out)
{
    tl_report_begin(report_out, "encode tile");
    TL_REFUSE_NULL(tile_out, report_out);
    *tile_out = NULL;
    TL_REFUSE_NULL(source, report_out);
    TL_TRY(tl_nav_tile_check_source(source, report_out));
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    tl_result result = encode_tile(source, allocator, &arena, tile_out, report_out);
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes + (*tile_out != NULL ? (*tile_out)->blob.size : 0);
    }
    tl_arena_free(&arena);
    return result;
}
