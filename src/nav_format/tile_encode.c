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

static void *array_of(tl_nav_tile *tile, uint64_t offset)
{
    return (char *)tile + offset;
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
}

static void bake_polygons(const tl_nav_tile_source *source, tl_nav_tile *tile)
{
    const tl_polygon_mesh *polygons = source->polygons;
    memcpy(array_of(tile, tile->first_corner), polygons->first, (polygons->polygon_count + 1u) * sizeof(uint32_t));
    memcpy(array_of(tile, tile->corner_vertices), polygons->indices, polygons->index_count * sizeof(uint32_t));
    memcpy(array_of(tile, tile->vertices), polygons->vertices, 3 * (size_t)polygons->vertex_count * sizeof(int32_t));
    tl_vec3 *corners = array_of(tile, tile->corners);
    uint32_t *links = array_of(tile, tile->links);
    for (uint32_t k = 0; k < polygons->index_count; k++) {
        const int32_t *v = polygons->vertices + 3 * (size_t)polygons->indices[k];
        corners[k].x = tl_nav_tile_position(tile->origin.x, tile->tile_x, tile->tile_size, v[0], tile->cell_size);
        corners[k].y = tl_nav_tile_position(tile->origin.y, 0, 0, v[1], tile->cell_height);
        corners[k].z = tl_nav_tile_position(tile->origin.z, tile->tile_z, tile->tile_size, v[2], tile->cell_size);
        uint32_t across = polygons->neighbours[k];
        links[k] = across >= TL_PORTAL ? TL_NAV_LINK_WALL : across;
    }
    uint64_t *flags = array_of(tile, tile->flags);
    uint8_t *areas = array_of(tile, tile->areas);
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        flags[p] = source->flags != NULL ? source->flags[p] : 1;
        areas[p] = (uint8_t)polygons->areas[p];
        tile->area += tl_nav_tile_polygon_area(tile, p);
    }
}

static void bake_portals(const tl_nav_portals *portals, tl_nav_tile *tile)
{
    uint32_t *links = array_of(tile, tile->links);
    for (uint32_t i = 0; i < portals->portal_count; i++) {
        links[portals->portals[i].corner] = TL_NAV_LINK_PORTAL | i;
    }
    if (portals->portal_count > 0) {
        memcpy(array_of(tile, tile->portals), portals->portals, portals->portal_count * sizeof(tl_nav_portal));
        memcpy(array_of(tile, tile->profile), portals->profile, portals->profile_count * sizeof(tl_nav_profile_point));
    }
}

// The corners of a patch are the polygon's own, bit by bit, so that no gap opens between the two; heights are kept.
static void bake_patch(const tl_nav_detail *detail, uint32_t p, const tl_vec3 *corners, uint32_t corner_count,
                       tl_vec3 *vertices, tl_nav_detail_triangle *triangles)
{
    const tl_nav_detail_patch *patch = &detail->patches[p];
    memcpy(vertices, detail->vertices + patch->first_vertex, patch->vertex_count * sizeof *vertices);
    memcpy(triangles, detail->triangles + patch->first_triangle, patch->triangle_count * sizeof *triangles);
    for (uint32_t i = 0; i < corner_count; i++) {
        vertices[i].x = corners[i].x;
        vertices[i].z = corners[i].z;
    }
}

static void bake_fan(const tl_vec3 *corners, uint32_t corner_count, tl_vec3 *vertices,
                     tl_nav_detail_triangle *triangles)
{
    memcpy(vertices, corners, corner_count * sizeof *vertices);
    for (uint32_t i = 0; i + 2 < corner_count; i++) {
        triangles[i] = tl_nav_fan_triangle(i, corner_count);
    }
}

static void bake_surface(const tl_nav_tile_source *source, tl_nav_tile *tile)
{
    uint32_t *first_vertex = array_of(tile, tile->detail_first_vertex);
    uint32_t *first_triangle = array_of(tile, tile->detail_first_triangle);
    tl_vec3 *vertices = array_of(tile, tile->detail_vertices);
    tl_nav_detail_triangle *triangles = array_of(tile, tile->detail_triangles);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        uint32_t corner_count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(tile, p, &corner_count);
        tl_vec3 *vertex = vertices + first_vertex[p];
        tl_nav_detail_triangle *triangle = triangles + first_triangle[p];
        if (source->detail != NULL) {
            bake_patch(source->detail, p, corners, corner_count, vertex, triangle);
            first_vertex[p + 1] = first_vertex[p] + source->detail->patches[p].vertex_count;
            first_triangle[p + 1] = first_triangle[p] + source->detail->patches[p].triangle_count;
        } else {
            bake_fan(corners, corner_count, vertex, triangle);
            first_vertex[p + 1] = first_vertex[p] + corner_count;
            first_triangle[p + 1] = first_triangle[p] + corner_count - 2;
        }
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
    tile->bounds = tl_nav_tile_nodes(tile)[0].box;
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
