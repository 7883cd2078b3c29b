// SPDX-License-Identifier: MIT
//
// Detour's form of tiles without Detour: there and back again, what cannot be written, and bytes from anywhere.

#include "nav_fixture.h"
#include "nav_level.h"

#include <math.h>
#include <stdlib.h>
#include <talus/nav_detour.h>
#include <talus/nav_query.h>

static tl_nav_tiles bake(uint32_t tile_size, tl_vec3 offset)
{
    static test_level level;
    test_level_make(&level, offset);
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = tile_size;
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
    return tiles;
}

typedef struct byte_list {
    unsigned char *bytes;
    uint64_t size;
} byte_list;

static byte_list write_set(const tl_nav_tiles *tiles, tl_detour_refs refs)
{
    const tl_nav_tile *const *list = (const tl_nav_tile *const *)tiles->tiles;
    byte_list out;
    out.size = tl_detour_set_size(list, tiles->tile_count, refs);
    TEST_CHECK(out.size > 0);
    out.bytes = malloc(out.size);
    tl_detour_report report;
    TEST_RESULT(tl_detour_set_write(list, tiles->tile_count, refs, out.bytes, out.size, &report), TL_OK);
    TEST_CHECK(report.tile_count == tiles->tile_count);
    TEST_RESULT(tl_detour_set_write(list, tiles->tile_count, refs, out.bytes, out.size - 1, &report), TL_INCOMPLETE);
    TEST_RESULT(tl_detour_set_write(list, tiles->tile_count, refs, out.bytes, out.size, NULL), TL_OK);
    return out;
}

static void check_same(const tl_nav_tile *a, const tl_nav_tile *b)
{
    TEST_CHECK(a->tile_x == b->tile_x && a->tile_z == b->tile_z && a->tile_size == b->tile_size);
    TEST_CHECK(a->polygon_count == b->polygon_count && a->corner_count == b->corner_count);
    TEST_CHECK(a->portal_count == b->portal_count && a->detail_triangle_count == b->detail_triangle_count);
    TEST_CHECK(a->agent_height == b->agent_height && a->agent_max_climb == b->agent_max_climb);
    for (uint32_t p = 0; p < a->polygon_count; p++) {
        uint32_t count_a, count_b;
        const tl_vec3 *corners_a = tl_nav_tile_corners(a, p, &count_a);
        const tl_vec3 *corners_b = tl_nav_tile_corners(b, p, &count_b);
        TEST_CHECK(count_a == count_b && tl_nav_tile_area(a, p) == tl_nav_tile_area(b, p));
        TEST_CHECK(tl_nav_tile_flags(a, p) == tl_nav_tile_flags(b, p));
        for (uint32_t k = 0; k < count_a; k++) {
            // Half a step of height is lost; in the plane, what a cell size that was written as its inverse loses.
            TEST_CHECK(fabsf(corners_a[k].y - corners_b[k].y) <= 0.5f / 1024.0f + 1e-6f);
            TEST_CHECK(fabsf(corners_a[k].x - corners_b[k].x) <= 1e-4f &&
                       fabsf(corners_a[k].z - corners_b[k].z) <= 1e-4f);
            TEST_CHECK(tl_nav_tile_neighbour(a, p, k) == tl_nav_tile_neighbour(b, p, k));
        }
        tl_nav_surface surface_a = tl_nav_tile_surface(a, p), surface_b = tl_nav_tile_surface(b, p);
        TEST_CHECK(surface_a.vertex_count == surface_b.vertex_count);
        TEST_CHECK(fixture_same_triangles(&surface_a, &surface_b));
        for (uint32_t i = count_a; i < surface_a.vertex_count; i++) {
            TEST_CHECK(memcmp(&surface_a.vertices[i], &surface_b.vertices[i], sizeof(tl_vec3)) == 0);
        }
    }
}

static void test_there_and_back(void **state)
{
    (void)state;
    static const uint32_t tile_sizes[] = { 0, 20, 32 };
    uint32_t portals = 0, added_heights = 0;
    for (size_t i = 0; i < 3; i++) {
        for (int refs = 0; refs < 2; refs++) {
            tl_nav_tiles tiles = bake(tile_sizes[i], tl_vec3_make(-40.0f, 3.0f, 170.0f));
            byte_list set = write_set(&tiles, (tl_detour_refs)refs);
            tl_detour_tiles back;
            tl_detour_report report;
            TEST_RESULT(tl_detour_read(set.bytes, set.size, NULL, &back, &report), TL_OK);
            TEST_CHECK(back.tile_count == tiles.tile_count);
            TEST_CHECK(report.dropped_polygons + report.one_way_links + report.off_mesh_links + report.area_zeros +
                           report.plain_patches ==
                       0);
            for (uint32_t t = 0; t < back.tile_count; t++) {
                check_same(tiles.tiles[t], back.tiles[t]);
                portals += back.tiles[t]->portal_count;
                added_heights += back.tiles[t]->detail_vertex_count - back.tiles[t]->corner_count;
            }
            tl_detour_tiles_free(&back);
            free(set.bytes);
            tl_nav_tiles_free(&tiles);
        }
    }
    TEST_CHECK(portals > 20 && added_heights > 20);
}

// A tile alone is the whole navmesh; its corner becomes the origin.
static void test_single_tile(void **state)
{
    (void)state;
    tl_nav_tiles tiles = bake(0, tl_vec3_make(0, 0, 0));
    uint64_t size = tl_detour_tile_size(tiles.tiles[0], TL_DETOUR_REFS_32);
    unsigned char *bytes = malloc(size);
    TEST_RESULT(tl_detour_tile_write(tiles.tiles[0], TL_DETOUR_REFS_32, bytes, size, NULL), TL_OK);
    TEST_RESULT(tl_detour_tile_write(tiles.tiles[0], TL_DETOUR_REFS_32, bytes, size - 1, NULL), TL_INCOMPLETE);
    tl_detour_tiles back;
    TEST_RESULT(tl_detour_read(bytes, size, NULL, &back, NULL), TL_OK);
    TEST_CHECK(back.tile_count == 1 && fabs(back.tiles[0]->area - tiles.tiles[0]->area) < 1e-3);
    check_same(tiles.tiles[0], back.tiles[0]);
    tl_detour_tiles_free(&back);
    free(bytes);
    tl_nav_tiles_free(&tiles);
}

// One octagon, clockwise on the page where x runs right and z up.
static tl_nav_tile *make_octagon(void)
{
    static int32_t vertices[24] = { 3, 0, 0, 0, 0, 3, 0, 0, 7, 3, 0, 10, 7, 0, 10, 10, 0, 7, 10, 0, 3, 7, 0, 0 };
    static uint32_t first[2] = { 0, 8 }, indices[8] = { 0, 1, 2, 3, 4, 5, 6, 7 }, areas[1] = { 1 };
    static uint32_t neighbours[8];
    memset(neighbours, 0xff, sizeof neighbours);
    tl_polygon_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = 8;
    mesh.polygon_count = 1;
    mesh.index_count = 8;
    mesh.vertices = vertices;
    mesh.first = first;
    mesh.indices = indices;
    mesh.neighbours = neighbours;
    mesh.areas = areas;
    mesh.cell_size = mesh.cell_height = 0.5f;
    tl_nav_tile_source source;
    memset(&source, 0, sizeof source);
    source.polygons = &mesh;
    source.agent_height = 2.0f;
    tl_nav_tile *tile;
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    return tile;
}

static void test_what_cannot_be_written(void **state)
{
    (void)state;
    static unsigned char bytes[1 << 20];
    tl_detour_report report;
    tl_nav_tile *octagon = make_octagon();
    TEST_RESULT(tl_detour_tile_write(octagon, TL_DETOUR_REFS_32, bytes, sizeof bytes, &report), TL_ERR_LIMIT);
    assert_string_equal(report.base.element, "polygon");
    TEST_CHECK(tl_detour_tile_size(octagon, TL_DETOUR_REFS_32) == 0);
    tl_blob_free(octagon);

    tl_nav_tiles tiles = bake(0, tl_vec3_make(0, 0, 0));
    tl_nav_tile *flagged = NULL;
    TEST_RESULT(tl_nav_tile_copy(tiles.tiles[0], true, NULL, &flagged), TL_OK);
    tl_nav_tile_set_flags(flagged, 2, (uint64_t)1 << 16);
    TEST_RESULT(tl_detour_tile_write(flagged, TL_DETOUR_REFS_32, bytes, sizeof bytes, &report), TL_ERR_LIMIT);
    TEST_CHECK(report.base.element_index == 2);
    tl_blob_free(flagged);
    uint8_t *areas = (uint8_t *)tiles.tiles[0] + 8 * (uint64_t)tiles.tiles[0]->areas;
    areas[1] = TL_DETOUR_MAX_AREA;
    TEST_RESULT(tl_detour_tile_write(tiles.tiles[0], TL_DETOUR_REFS_32, bytes, sizeof bytes, &report), TL_OK);
    areas[1] = TL_DETOUR_MAX_AREA + 1;
    TEST_RESULT(tl_detour_tile_write(tiles.tiles[0], TL_DETOUR_REFS_32, bytes, sizeof bytes, &report), TL_ERR_LIMIT);
    TEST_CHECK(report.base.element_index == 1);
    tl_nav_tiles_free(&tiles);

    TEST_RESULT(tl_detour_set_write(NULL, 0, TL_DETOUR_REFS_32, bytes, sizeof bytes, &report), TL_ERR_EMPTY);
    tl_nav_tiles one = bake(20, tl_vec3_make(0, 0, 0)), other = bake(32, tl_vec3_make(0, 0, 0));
    const tl_nav_tile *mixed[2] = { one.tiles[0], other.tiles[1] };
    TEST_RESULT(tl_detour_set_write(mixed, 2, TL_DETOUR_REFS_32, bytes, sizeof bytes, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(report.base.element_index == 1);
    tl_nav_tiles_free(&one);
    tl_nav_tiles_free(&other);
}

// A copy of exactly the bytes, so that a sanitizer sees a read beyond them.
static tl_result read_copy(const unsigned char *bytes, uint64_t size, tl_detour_report *report, uint32_t *tiles_out)
{
    unsigned char *copy = malloc(size + 1);
    memcpy(copy, bytes, size);
    copy = realloc(copy, size > 0 ? size : 1);
    tl_detour_tiles tiles;
    tl_result result = tl_detour_read(copy, size, NULL, &tiles, report);
    TEST_CHECK((result == TL_OK) == (tiles.tile_count > 0));
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        TEST_RESULT(tl_nav_tile_check(tiles.tiles[i], tiles.tiles[i]->blob.size, NULL), TL_OK);
    }
    *tiles_out = tiles.tile_count;
    tl_detour_tiles_free(&tiles);
    free(copy);
    return result;
}

static void test_bytes_from_anywhere(void **state)
{
    (void)state;
    tl_nav_tiles tiles = bake(48, tl_vec3_make(0, 0, 0));
    byte_list set = write_set(&tiles, TL_DETOUR_REFS_32);
    tl_detour_report report;
    uint32_t count;
    for (uint64_t size = 0; size < set.size; size += size < 400 ? 1 : 37) {
        tl_result result = read_copy(set.bytes, size, &report, &count);
        TEST_CHECK(result == TL_ERR_TRUNCATED || result == TL_ERR_CORRUPT);
    }
    // Every byte of the first tile's head, and a share of all others, in four ways.
    uint32_t refused = 0, taken = 0, repaired = 0;
    for (uint64_t at = 0; at < set.size; at += at < 2000 ? 1 : 13) {
        static const unsigned char flips[4] = { 0x01, 0x80, 0xff, 0x40 };
        for (int f = 0; f < 4; f++) {
            set.bytes[at] ^= flips[f];
            if (read_copy(set.bytes, set.size, &report, &count) == TL_OK) {
                taken++;
                repaired += report.dropped_polygons + report.one_way_links + report.plain_patches > 0;
            } else {
                refused++;
            }
            set.bytes[at] ^= flips[f];
        }
    }
    TEST_CHECK(refused > 500 && taken > 500 && repaired > 20);
    // Words that mean something, at the beginning.
    static const struct {
        uint64_t at;
        uint32_t word;
        tl_result result;
    } words[] = {
        { 0, 0x12345678, TL_ERR_MAGIC },
        { 4, 2, TL_ERR_VERSION },
        { 8, 0, TL_ERR_EMPTY },
        { 8, 0x7fffffff, TL_ERR_CORRUPT },
        { 12, 0x7fc00000, TL_ERR_NOT_FINITE },
        { 24, 0x41200001, TL_ERR_RANGE },
    };
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        uint32_t before;
        memcpy(&before, set.bytes + words[i].at, 4);
        memcpy(set.bytes + words[i].at, &words[i].word, 4);
        TEST_RESULT(read_copy(set.bytes, set.size, &report, &count), words[i].result);
        memcpy(set.bytes + words[i].at, &before, 4);
    }
    free(set.bytes);
    tl_nav_tiles_free(&tiles);
}

static void test_out_of_memory(void **state)
{
    (void)state;
    tl_nav_tiles tiles = bake(48, tl_vec3_make(0, 0, 0));
    byte_list set = write_set(&tiles, TL_DETOUR_REFS_64);
    uint32_t failures = 0;
    for (uint64_t k = 1;; k++) {
        test_allocator counting;
        test_allocator_init(&counting, k);
        tl_detour_read_def def = tl_default_detour_read_def();
        def.allocator = &counting.allocator;
        tl_detour_tiles back;
        tl_result result = tl_detour_read(set.bytes, set.size, &def, &back, NULL);
        if (result == TL_OK) {
            tl_detour_tiles_free(&back);
        }
        TEST_CHECK(counting.live_blocks == 0);
        if (result == TL_OK) {
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        failures++;
    }
    TEST_CHECK(failures > 10);
    free(set.bytes);
    tl_nav_tiles_free(&tiles);
}

// What hangs together within a tile, as layers: nothing is cut.
static tl_nav_tiles divide(const tl_nav_tiles *whole)
{
    tl_nav_tiles out;
    memset(&out, 0, sizeof out);
    out.tiles = calloc(4096, sizeof *out.tiles);
    for (uint32_t t = 0; t < whole->tile_count; t++) {
        const tl_nav_tile *tile = whole->tiles[t];
        uint32_t *layers = malloc(tile->polygon_count * sizeof *layers);
        for (uint32_t p = 0; p < tile->polygon_count; p++) {
            layers[p] = p;
        }
        for (bool again = true; again;) {
            again = false;
            for (uint32_t p = 0; p < tile->polygon_count; p++) {
                uint32_t count;
                tl_nav_tile_corners(tile, p, &count);
                for (uint32_t k = 0; k < count; k++) {
                    const uint32_t across = tl_nav_tile_neighbour(tile, p, k);
                    if (across < tile->polygon_count && layers[across] < layers[p]) {
                        layers[p] = layers[across];
                        again = true;
                    }
                }
            }
        }
        tl_nav_tile_stack stack;
        TEST_RESULT(tl_nav_tile_divide(tile, layers, NULL, &stack, NULL), TL_OK);
        for (uint32_t i = 0; i < stack.count; i++) {
            TEST_CHECK(out.tile_count < 4096);
            out.tiles[out.tile_count++] = stack.tiles[i];
            stack.tiles[i] = NULL;
        }
        tl_nav_tile_stack_free(&stack);
        free(layers);
    }
    out.tiles = realloc(out.tiles, out.tile_count * sizeof *out.tiles);
    return out;
}

static uint64_t count_links(tl_nav_tile *const *tiles, uint32_t count)
{
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (uint32_t i = 0; i < count; i++) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
    }
    const uint64_t links = tl_navmesh_link_count(navmesh);
    tl_navmesh_destroy(navmesh);
    return links;
}

// Several layers at one place: written and read where nothing is cut between them, else refused by name.
static void test_layers(void **state)
{
    (void)state;
    tl_nav_tiles whole = bake(20, tl_vec3_make(0, 0, 0)), tiles = divide(&whole);
    TEST_CHECK(tiles.tile_count > whole.tile_count);
    byte_list set = write_set(&tiles, TL_DETOUR_REFS_64);
    tl_detour_tiles back;
    TEST_RESULT(tl_detour_read(set.bytes, set.size, NULL, &back, NULL), TL_OK);
    TEST_CHECK(back.tile_count == tiles.tile_count);
    for (uint32_t t = 0; t < back.tile_count; t++) {
        TEST_CHECK(back.tiles[t]->layer == tiles.tiles[t]->layer);
        check_same(tiles.tiles[t], back.tiles[t]);
    }
    TEST_CHECK(count_links(back.tiles, back.tile_count) == count_links(whole.tiles, whole.tile_count));
    tl_detour_tiles_free(&back);
    free(set.bytes);

    tl_nav_tile_stack stack;
    tl_nav_tile *tile = whole.tiles[0];
    for (uint32_t t = 1; t < whole.tile_count; t++) {
        tile = whole.tiles[t]->polygon_count > tile->polygon_count ? whole.tiles[t] : tile;
    }
    uint32_t *layers = malloc(tile->polygon_count * sizeof *layers);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        layers[p] = 1 + p % 2;
    }
    TEST_RESULT(tl_nav_tile_divide(tile, layers, NULL, &stack, NULL), TL_OK);
    const tl_nav_tile *const *list = (const tl_nav_tile *const *)stack.tiles;
    TEST_CHECK(stack.count == 2 && tl_detour_set_size(list, 2, TL_DETOUR_REFS_32) == 0);
    unsigned char room[8];
    tl_detour_report report;
    TEST_RESULT(tl_detour_tile_write(list[0], TL_DETOUR_REFS_32, room, sizeof room, &report), TL_ERR_LIMIT);
    TEST_CHECK(strcmp(report.base.element, "layer") == 0 && report.base.element_index == 1);
    TEST_RESULT(tl_detour_set_write(list, 2, TL_DETOUR_REFS_32, NULL, 0, &report), TL_ERR_LIMIT);
    TEST_CHECK(strcmp(report.base.element, "layer") == 0);
    tl_nav_tile_stack_free(&stack);
    free(layers);
    tl_nav_tiles_free(&tiles);
    tl_nav_tiles_free(&whole);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_there_and_back),         cmocka_unit_test(test_single_tile),
        cmocka_unit_test(test_what_cannot_be_written), cmocka_unit_test(test_bytes_from_anywhere),
        cmocka_unit_test(test_out_of_memory),          cmocka_unit_test(test_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
