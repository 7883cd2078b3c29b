// SPDX-License-Identifier: MIT
//
// Untrusted bytes as a navmesh tile: what tl_nav_tile_check accepts can be added to a navmesh, linked and queried.
//
// Raw mutations of a valid file rarely get past the counts, so an input is a list of edits (offset, byte) to a tile
// that is baked here; an input that begins with 0xff is taken as the tile's bytes themselves.

#include "fuzz/fuzz_input.h"

#include <math.h>
#include <string.h>
#include <talus/nav_query.h>

enum { SIDE = 3, STEP = 8, POLYGONS = SIDE * SIDE, VERTICES = (SIDE + 1) * (SIDE + 1) };

static uint32_t vertex_at(uint32_t x, uint32_t z)
{
    return z * (SIDE + 1) + x;
}

// A grid of squares with portals all around and some height, one vertex of detail in each square.
static tl_nav_tile *bake_sample(void)
{
    static int32_t vertices[3 * VERTICES];
    static uint32_t first[POLYGONS + 1], indices[4 * POLYGONS], neighbours[4 * POLYGONS], areas[POLYGONS];
    static tl_nav_detail_patch patches[POLYGONS];
    static tl_vec3 detail_vertices[5 * POLYGONS];
    static tl_nav_detail_triangle triangles[4 * POLYGONS];
    for (uint32_t i = 0; i < VERTICES; i++) {
        vertices[3 * i] = (int32_t)(i % (SIDE + 1)) * STEP;
        vertices[3 * i + 1] = (int32_t)(i % 3);
        vertices[3 * i + 2] = (int32_t)(i / (SIDE + 1)) * STEP;
    }
    for (uint32_t p = 0; p < POLYGONS; p++) {
        uint32_t x = p % SIDE, z = p / SIDE;
        const uint32_t corners[4] = { vertex_at(x, z), vertex_at(x, z + 1), vertex_at(x + 1, z + 1),
                                      vertex_at(x + 1, z) };
        const uint32_t across[4] = { x > 0 ? p - 1 : TL_PORTAL | 0u, z + 1 < SIDE ? p + SIDE : TL_PORTAL | 1u,
                                     x + 1 < SIDE ? p + 1 : TL_PORTAL | 2u, z > 0 ? p - SIDE : TL_PORTAL | 3u };
        areas[p] = 1 + p;
        first[p + 1] = 4 * (p + 1);
        patches[p].first_vertex = 5 * p;
        patches[p].vertex_count = 5;
        patches[p].first_triangle = 4 * p;
        patches[p].triangle_count = 4;
        for (uint32_t k = 0; k < 4; k++) {
            const int32_t *v = vertices + 3 * corners[k];
            indices[4 * p + k] = corners[k];
            neighbours[4 * p + k] = across[k];
            detail_vertices[5 * p + k] = tl_vec3_make((float)v[0], (float)v[1], (float)v[2]);
            const tl_nav_detail_triangle triangle = { { (uint16_t)k, (uint16_t)((k + 1) % 4), 4 }, 1 };
            triangles[4 * p + k] = triangle;
        }
        detail_vertices[5 * p + 4] = tl_vec3_make(((float)x + 0.5f) * STEP, 2.5f, ((float)z + 0.5f) * STEP);
    }
    tl_polygon_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = VERTICES;
    mesh.polygon_count = POLYGONS;
    mesh.index_count = 4 * POLYGONS;
    mesh.vertices = vertices;
    mesh.first = first;
    mesh.indices = indices;
    mesh.neighbours = neighbours;
    mesh.areas = areas;
    mesh.cell_size = 1.0f;
    mesh.cell_height = 1.0f;
    tl_nav_detail detail;
    memset(&detail, 0, sizeof detail);
    detail.patch_count = POLYGONS;
    detail.vertex_count = 5 * POLYGONS;
    detail.triangle_count = 4 * POLYGONS;
    detail.patches = patches;
    detail.vertices = detail_vertices;
    detail.triangles = triangles;
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &mesh;
    source.detail = &detail;
    source.tile_size = SIDE * STEP;
    source.agent_height = 2.0f;
    source.agent_max_climb = 1.0f;
    tl_nav_tile *tile = NULL;
    require(tl_nav_tile_encode(&source, NULL, &tile, NULL) == TL_OK);
    return tile;
}

static void ask(const tl_navmesh *navmesh, tl_nav_query *query, tl_vec3 from, tl_vec3 to)
{
    tl_nav_ref polygons[64];
    tl_nav_corner corners[64];
    tl_nav_path_buffers buffers = { polygons, 64, corners, 64 };
    tl_nav_route route;
    tl_vec3 extents = { 40.0f, 1e9f, 40.0f };
    const tl_nav_route_request request = { .start = from, .goal = to, .half_extents = extents };
    tl_result result = tl_nav_query_find_route(query, navmesh, &request, &buffers, &route);
    require(result == TL_OK || result == TL_NOT_FOUND || result == TL_INCOMPLETE);
    if (result != TL_OK) {
        return;
    }
    require(route.corner_count >= 2 && isfinite(route.length) && isfinite(route.start.point.y));
    require(polygons[0] == route.start.polygon);
    require(route.path.status != TL_NAV_PATH_COMPLETE || polygons[route.path.polygon_count - 1] == route.goal.polygon);
    tl_nav_ray_hit hit;
    result = tl_navmesh_cast_ray(navmesh, NULL, &route.start, to, polygons, 64, &hit);
    require(result == TL_OK || result == TL_INCOMPLETE || result == TL_ERR_ITERATIONS);
    require(result == TL_ERR_ITERATIONS || (hit.t >= 0.0f && hit.t <= 1.0f && isfinite(hit.point.y)));
}

static void use_tile(const tl_nav_tile *tile, const tl_nav_tile *neighbour)
{
    tl_navmesh *navmesh = NULL;
    tl_nav_query *query = NULL;
    tl_nav_query_def def = { 256, NULL, TL_DEF_COOKIE };
    require(tl_navmesh_create(NULL, &navmesh) == TL_OK && tl_nav_query_create(&def, &query, NULL) == TL_OK);
    require(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED) == TL_OK);
    tl_result result = tl_navmesh_add_tile(navmesh, neighbour, TL_NAV_TILE_BORROWED);
    require(result == TL_OK || result == TL_ERR_ARGUMENT);
    tl_vec3 center = tl_aabb_center(tile->bounds);
    for (uint32_t i = 0; i < 4; i++) {
        tl_vec3 from = { center.x + (float)i * 5.0f - 11.0f, center.y, center.z - 9.0f };
        ask(navmesh, query, from, tl_vec3_make(center.x + 9.0f, center.y, center.z + 10.0f));
        ask(navmesh, query, from, tl_vec3_make(center.x + 30.0f, center.y, center.z));
    }
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        require(tl_nav_tile_polygon_area(tile, p) > 0.0);
        (void)tl_nav_tile_neighbour(tile, p, 0);
    }
    tl_navmesh_remove_tile(navmesh, tile->tile_x, tile->tile_z);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(navmesh);
}

// The sample as two layers of a checkerboard: every inner edge is cut.
static tl_nav_tile *bake_layer(uint32_t layer)
{
    uint32_t layers[POLYGONS];
    for (uint32_t p = 0; p < POLYGONS; p++) {
        layers[p] = (p % SIDE + p / SIDE) % 2;
    }
    tl_nav_tile *whole = bake_sample();
    tl_nav_tile_stack stack;
    require(tl_nav_tile_divide(whole, layers, NULL, &stack, NULL) == TL_OK && stack.count == 2);
    tl_nav_tile *tile = stack.tiles[layer];
    stack.tiles[layer] = NULL;
    tl_nav_tile_stack_free(&stack);
    tl_blob_free(whole);
    return tile;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static tl_nav_tile *samples[2];
    if (samples[0] == NULL) {
        samples[0] = bake_sample();
        samples[1] = bake_layer(1);
    }
    const bool layered = size > 0 && data[0] == 0xfe;
    const tl_nav_tile *sample = samples[layered ? 1 : 0];
    bool raw = size > 0 && data[0] == 0xff;
    size_t byte_count = raw ? size - 1 : (size_t)sample->blob.size;
    uint8_t *bytes = aligned_alloc(64, (byte_count + 63) / 64 * 64 + 64);
    require(bytes != NULL);
    memcpy(bytes, raw ? data + 1 : (const uint8_t *)sample, byte_count);
    for (size_t i = layered ? 1 : 0; !raw && i + 3 <= size; i += 3) {
        bytes[(data[i] | (size_t)data[i + 1] << 8) % byte_count] = data[i + 2];
    }
    const tl_nav_tile *tile = (const tl_nav_tile *)(const void *)bytes;
    if (tl_nav_tile_check(bytes, byte_count, NULL) == TL_OK) {
        tl_nav_tile *neighbour = layered ? bake_layer(0) : bake_sample();
        neighbour->tile_x = layered ? 0 : tile->tile_x + 1;
        neighbour->tile_z = layered ? 0 : tile->tile_z;
        use_tile(tile, neighbour);
        tl_blob_free(neighbour);
    }
    free(bytes);
    return 0;
}
