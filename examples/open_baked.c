// SPDX-License-Identifier: MIT
//
// A baked file, opened and queried in place: check it, cast a ray, find a path. Nothing is parsed or copied, so a game
// would map the file; here it is read, which works everywhere. The core alone is needed.
//
//   open_baked [FILE.talus]       as bake_from_obj.c or `talus bake` writes it

#include <talus/talus.h>

#include <stdio.h>
#include <stdlib.h>

enum { MAX_POLYGONS = 64, MAX_CORNERS = 64 };

// The bytes of a file at an address that is a multiple of 64; NULL when it cannot be read. Free `*block_out`.
static void *read_file(const char *path, uint64_t *size_out, void **block_out)
{
    FILE *file = fopen(path, "rb");
    void *bytes = NULL;
    *block_out = NULL;
    if (file != NULL && fseek(file, 0, SEEK_END) == 0) {
        long size = ftell(file);
        rewind(file);
        *block_out = size > 0 ? malloc((size_t)size + TL_BLOB_ALIGNMENT) : NULL;
        if (*block_out != NULL) {
            uintptr_t address = (uintptr_t)*block_out + TL_BLOB_ALIGNMENT - 1;
            bytes = (void *)(address - address % TL_BLOB_ALIGNMENT);
            *size_out = fread(bytes, 1, (size_t)size, file);
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    return bytes;
}

// Chunks are checked once, when they are opened; queries then need no checks.
static tl_result open_soup(const tl_pack *pack, const tl_soup **soup_out)
{
    tl_pack_chunk chunk;
    tl_result result = tl_pack_find(pack, TL_PACK_SOUP, 0, &chunk);
    if (result == TL_OK) {
        result = tl_soup_check(chunk.bytes, chunk.size, NULL);
        *soup_out = chunk.bytes;
    }
    return result;
}

// The navmesh borrows the tiles: they stay where they lie in the file. Adding one checks it.
static tl_result open_navmesh(const tl_pack *pack, tl_navmesh *navmesh)
{
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < tl_pack_count(pack, TL_PACK_NAVT) && result == TL_OK; i++) {
        tl_pack_chunk chunk;
        result = tl_pack_find(pack, TL_PACK_NAVT, i, &chunk);
        if (result == TL_OK) {
            result = tl_nav_tile_check(chunk.bytes, chunk.size, NULL);
        }
        if (result == TL_OK) {
            result = tl_navmesh_add_tile(navmesh, chunk.bytes, TL_NAV_TILE_BORROWED);
        }
    }
    return result;
}

static tl_result find_path(const tl_navmesh *navmesh, tl_vec3 start, tl_vec3 goal, float *length_out)
{
    tl_nav_query *query;
    tl_result result = tl_nav_query_create(NULL, &query, NULL);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_ref polygons[MAX_POLYGONS];
    tl_nav_corner corners[MAX_CORNERS];
    tl_nav_path_buffers buffers = { polygons, MAX_POLYGONS, corners, MAX_CORNERS };
    const tl_nav_route_request request = { .start = start, .goal = goal, .half_extents = { 1, 2, 1 } };
    tl_nav_route route;
    result = tl_nav_query_find_route(query, navmesh, &request, &buffers, &route);
    if (result == TL_OK) {
        printf("a path of %g m over %u corners\n", (double)route.length, route.corner_count);
        *length_out = route.length;
    }
    tl_nav_query_destroy(query);
    return result;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "baked_from_obj.talus";
    uint64_t size = 0;
    void *block;
    void *bytes = read_file(path, &size, &block);
    if (bytes == NULL) {
        fprintf(stderr, "talus: %s cannot be read\n", path);
        return 1;
    }
    tl_pack pack;
    tl_report report;
    const tl_soup *soup = NULL;
    tl_navmesh *navmesh = NULL;
    float length = 0.0f;
    tl_result result = tl_pack_open(bytes, size, &pack, &report);
    if (result == TL_OK) {
        result = open_soup(&pack, &soup);
    }
    if (result == TL_OK) {
        result = tl_navmesh_create(NULL, &navmesh);
    }
    if (result == TL_OK) {
        result = open_navmesh(&pack, navmesh);
    }
    bool hit = false;
    if (result == TL_OK) {
        printf("%s: %u chunks in %llu bytes\n", path, pack.chunk_count, (unsigned long long)size);
        tl_vec3 start = { -5, 1, -5 };
        tl_vec3 goal = { 5, 1, -5 };
        tl_ray ray = { start, tl_sub(goal, start), 1.0f };
        tl_ray_hit what;
        hit = tl_soup_cast_ray(soup, &ray, NULL, &what);
        printf("the straight way is %s\n", hit ? "blocked" : "clear");
        result = find_path(navmesh, start, goal, &length);
    }
    if (result != TL_OK) {
        fprintf(stderr, "talus: %s: %s\n", path, tl_result_text(result));
    }
    tl_navmesh_destroy(navmesh);
    free(block);
    // Of the example's own level: a wall stands between, and the way around it is over 24 m long.
    return result == TL_OK && (argc > 1 || (hit && length > 24.0f)) ? 0 : 1;
}
