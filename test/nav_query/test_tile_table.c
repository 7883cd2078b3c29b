// SPDX-License-Identifier: MIT
//
// The table of tiles and the links across their seams: symmetric after any edits, equal to those of a fresh table.

#include "nav_fixture.h"

#include <math.h>

static const char *const OPEN[] = { "0000", "0000", "0000", "0000" };

static void test_example(void **state)
{
    (void)state;
    fixture_level level = fixture_make(OPEN, 4);
    level.tile_cells = 2;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    TEST_CHECK(tl_navmesh_tile_count(navmesh) == 4 && tl_navmesh_slot_count(navmesh) == 4);
    TEST_CHECK(tl_navmesh_link_count(navmesh) == 48); // 24 inner edges, both ways
    TEST_CHECK(tl_navmesh_find_tile(navmesh, 1, 1) == tl_navmesh_slot_tile(navmesh, 3));
    TEST_CHECK(tl_navmesh_find_tile(navmesh, 2, 1) == NULL && tl_navmesh_slot_tile(navmesh, 4) == NULL);

    tl_nav_ref ref = tl_navmesh_polygon_ref(navmesh, 0, 1);
    tl_nav_link links[4];
    uint32_t count = 0;
    TEST_RESULT(tl_navmesh_links(navmesh, ref, links, 4, &count), TL_OK);
    TEST_CHECK(count == 3);
    TEST_RESULT(tl_navmesh_links(navmesh, ref, links, 2, &count), TL_INCOMPLETE);
    TEST_CHECK(count == 3);

    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    TEST_CHECK(polygon == 1 && tile == tl_navmesh_slot_tile(navmesh, 0));
    TEST_CHECK(tl_navmesh_polygon_ref(navmesh, 0, 4) == TL_NAV_NO_REF);
    TEST_CHECK(tl_navmesh_polygon_ref(navmesh, 4, 0) == TL_NAV_NO_REF);
    TEST_RESULT(tl_navmesh_resolve(navmesh, TL_NAV_NO_REF, NULL, NULL), TL_ERR_STALE);
    TEST_RESULT(tl_navmesh_resolve(navmesh, UINT64_MAX, NULL, NULL), TL_ERR_STALE);

    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_OK);
    TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_NOT_FOUND);
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, NULL, NULL), TL_ERR_STALE);
    TEST_CHECK(tl_navmesh_link_count(navmesh) == 2 * 24 - 2 * 4 - 2 * 4);
    tl_nav_tile *again = fixture_build_tile(&level, 0, 0, NULL);
    TEST_RESULT(tl_navmesh_add_tile(navmesh, again, TL_NAV_TILE_OWNED), TL_OK);
    // The same tile in the same slot is not the same polygon.
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, NULL, NULL), TL_ERR_STALE);
    TEST_CHECK(tl_navmesh_polygon_ref(navmesh, 0, 1) != ref);
    tl_navmesh_destroy(navmesh);
}

static void test_refused_tiles(void **state)
{
    (void)state;
    fixture_level level = fixture_make(OPEN, 4);
    level.tile_cells = 2;
    tl_navmesh *navmesh = fixture_build(&level, NULL);
    uint64_t links = tl_navmesh_link_count(navmesh);
    fixture_level others[4] = { level, level, level, level };
    others[1].cell_size = 0.26f;
    others[2].origin.x = 0.01f;
    others[3].tile_cells = 0;
    for (uint32_t i = 0; i < 4; i++) {
        int32_t place = i == 0 || i == 3 ? 0 : 2; // 0: there is one already
        tl_nav_tile *tile = fixture_build_tile(&others[i], 0, 0, NULL);
        tile->tile_x = place;
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_ERR_ARGUMENT);
        tl_blob_free(tile);
    }
    TEST_CHECK(tl_navmesh_link_count(navmesh) == links && tl_navmesh_tile_count(navmesh) == 4);
    tl_navmesh_destroy(navmesh);
    tl_navmesh_destroy(NULL);
}

// A link as seen from outside: places instead of references.
typedef struct plain_link {
    int32_t from_x, from_z, to_x, to_z;
    uint32_t from, to, edge;
    tl_vec3 left, right;
} plain_link;

static int compare_links(const void *a, const void *b)
{
    return memcmp(a, b, sizeof(plain_link));
}

static plain_link *collect(const tl_navmesh *navmesh, uint32_t *count_out)
{
    fixture_refs all = fixture_all_refs(navmesh);
    plain_link *links = calloc((size_t)tl_navmesh_link_count(navmesh) + 1, sizeof *links);
    *count_out = 0;
    for (uint32_t i = 0; i < all.count; i++) {
        tl_nav_link out[64];
        uint32_t count = 0, polygon = 0, to = 0;
        const tl_nav_tile *tile = NULL, *to_tile = NULL;
        TEST_RESULT(tl_navmesh_resolve(navmesh, all.refs[i], &tile, &polygon), TL_OK);
        TEST_RESULT(tl_navmesh_links(navmesh, all.refs[i], out, 64, &count), TL_OK);
        for (uint32_t k = 0; k < count; k++) {
            TEST_RESULT(tl_navmesh_resolve(navmesh, out[k].to, &to_tile, &to), TL_OK);
            plain_link link;
            memset(&link, 0, sizeof link);
            link.from_x = tile->tile_x;
            link.from_z = tile->tile_z;
            link.to_x = to_tile->tile_x;
            link.to_z = to_tile->tile_z;
            link.from = polygon;
            link.to = to;
            link.edge = out[k].edge;
            link.left = out[k].left;
            link.right = out[k].right;
            TEST_CHECK(*count_out < tl_navmesh_link_count(navmesh));
            links[(*count_out)++] = link;
        }
    }
    TEST_CHECK(*count_out == tl_navmesh_link_count(navmesh));
    qsort(links, *count_out, sizeof *links, compare_links);
    free(all.refs);
    return links;
}

// Each link has one back, over the same stretch in the plane.
static uint32_t check_symmetric(const plain_link *links, uint32_t count)
{
    uint32_t seams = 0;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t back = 0;
        for (uint32_t k = 0; k < count; k++) {
            back += links[k].from_x == links[i].to_x && links[k].from_z == links[i].to_z &&
                    links[k].from == links[i].to && links[k].to_x == links[i].from_x &&
                    links[k].to_z == links[i].from_z && links[k].to == links[i].from &&
                    links[k].left.x == links[i].right.x && links[k].left.z == links[i].right.z &&
                    links[k].right.x == links[i].left.x && links[k].right.z == links[i].left.z;
        }
        TEST_CHECK(back == 1);
        seams += links[i].from_x != links[i].to_x || links[i].from_z != links[i].to_z;
    }
    return seams;
}

enum { GRID = 4 };

static void test_random_edits(void **state)
{
    (void)state;
    test_random random = { 21 };
    uint32_t seams = 0, stale = 0, partial_stretches = 0;
    for (uint32_t round = 0; round < 3; round++) {
        fixture_level level = fixture_random(&random, round == 0 ? 5 : round, GRID * 2);
        level.tile_cells = 2;
        level.shake = 4;
        test_allocator counting;
        test_allocator_init(&counting, 0);
        tl_navmesh *navmesh = NULL;
        TEST_RESULT(tl_navmesh_create(&counting.allocator, &navmesh), TL_OK);
        bool present[GRID][GRID] = { { false } };
        tl_nav_ref old[64];
        uint32_t old_count = 0;
        for (uint32_t edit = 0; edit < 60; edit++) {
            uint32_t x = test_random_below(&random, GRID), z = test_random_below(&random, GRID);
            if (present[z][x]) {
                for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh) && old_count < 64; slot++) {
                    const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
                    if (tile != NULL && tile->tile_x == (int32_t)x && tile->tile_z == (int32_t)z) {
                        old[old_count++] = tl_navmesh_polygon_ref(navmesh, slot, 0);
                    }
                }
                TEST_RESULT(tl_navmesh_remove_tile(navmesh, (int32_t)x, (int32_t)z), TL_OK);
            } else {
                tl_nav_tile *tile = fixture_build_tile(&level, (int32_t)x, (int32_t)z, &counting.allocator);
                if (tile == NULL) {
                    continue;
                }
                TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
            }
            present[z][x] = !present[z][x];
            for (uint32_t i = 0; i < old_count; i++) {
                TEST_RESULT(tl_navmesh_resolve(navmesh, old[i], NULL, NULL), TL_ERR_STALE);
                stale++;
            }
            if (edit % 10 != 9) {
                continue;
            }
            tl_navmesh *fresh = NULL;
            TEST_RESULT(tl_navmesh_create(NULL, &fresh), TL_OK);
            for (uint32_t i = 0; i < GRID * GRID; i++) {
                if (present[i / GRID][i % GRID]) {
                    tl_nav_tile *tile = fixture_build_tile(&level, (int32_t)(i % GRID), (int32_t)(i / GRID), NULL);
                    TEST_RESULT(tl_navmesh_add_tile(fresh, tile, TL_NAV_TILE_OWNED), TL_OK);
                }
            }
            uint32_t count = 0, fresh_count = 0;
            plain_link *links = collect(navmesh, &count);
            plain_link *expected = collect(fresh, &fresh_count);
            TEST_CHECK(count == fresh_count && memcmp(links, expected, count * sizeof *links) == 0);
            seams += check_symmetric(links, count);
            for (uint32_t i = 1; i < count; i++) {
                partial_stretches += links[i].from_x == links[i - 1].from_x && links[i].from_z == links[i - 1].from_z &&
                                     links[i].from == links[i - 1].from && links[i].edge == links[i - 1].edge;
            }
            free(links);
            free(expected);
            tl_navmesh_destroy(fresh);
        }
        tl_navmesh_destroy(navmesh);
        TEST_CHECK(counting.live_blocks == 0);
    }
    TEST_CHECK(seams > 300 && stale > 500 && partial_stretches > 30);
}

// Which portals face each other, by metres and brute force. The fixture's floors are flat along seams, so heights are
// equal or a floor apart.
static void test_seam_oracle(void **state)
{
    (void)state;
    test_random random = { 22 };
    uint32_t linked = 0, apart = 0, disjoint = 0;
    for (uint32_t round = 0; round < 24; round++) {
        fixture_level level = fixture_random(&random, 5, 12);
        level.tile_cells = 6;
        level.shake = 4;
        level.slope = 0;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        const tl_nav_tile *a = tl_navmesh_find_tile(navmesh, 0, 0), *b = tl_navmesh_find_tile(navmesh, 1, 0);
        TEST_CHECK(a != NULL && b != NULL);
        for (uint32_t i = tl_nav_tile_side_first(a, 2); i < tl_nav_tile_side_first(a, 3); i++) {
            const tl_nav_portal *p = &tl_nav_tile_portals(a)[i];
            tl_nav_link links[64];
            uint32_t count = 0;
            TEST_RESULT(tl_navmesh_links(navmesh, tl_navmesh_polygon_ref(navmesh, 0, p->polygon), links, 64, &count),
                        TL_OK);
            for (uint32_t k = tl_nav_tile_side_first(b, 0); k < tl_nav_tile_side_first(b, 1); k++) {
                const tl_nav_portal *q = &tl_nav_tile_portals(b)[k];
                float height_p = fixture_corner(a, p->corner).y;
                float height_q = fixture_corner(b, q->corner).y;
                int32_t low = p->low > q->low ? p->low : q->low, high = p->high < q->high ? p->high : q->high;
                bool meet = fabsf(height_p - height_q) < 0.1f;
                bool found = false;
                for (uint32_t n = 0; n < count; n++) {
                    float z0 = level.origin.z + (float)low * level.cell_size;
                    float z1 = level.origin.z + (float)high * level.cell_size;
                    found = found || (links[n].to == tl_navmesh_polygon_ref(navmesh, 1, q->polygon) &&
                                      fabsf(fminf(links[n].left.z, links[n].right.z) - z0) < 1e-3f &&
                                      fabsf(fmaxf(links[n].left.z, links[n].right.z) - z1) < 1e-3f);
                }
                TEST_CHECK(found == (low < high && meet));
                linked += found;
                disjoint += low >= high;
                apart += low < high && !meet;
            }
        }
        tl_navmesh_destroy(navmesh);
    }
    TEST_CHECK(linked > 100 && apart > 30 && disjoint > 100);
}

// Two tiles of one cell whose seam's heights are given by a bend in the middle of each side.
static uint64_t links_of_bent_seam(float height_a, float bend_a, float height_b, float bend_b)
{
    const char *const rows[] = { "00" };
    fixture_level level = fixture_make(rows, 1);
    level.tile_cells = 1;
    level.detail = true;
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (int32_t x = 0; x < 2; x++) {
        fixture_mesh mesh = fixture_build_mesh(&level, x, 0);
        for (uint32_t i = 0; i < mesh.mesh.vertex_count; i++) {
            mesh.mesh.vertices[3 * (size_t)i + 1] = (int32_t)((x == 0 ? height_a : height_b) / mesh.mesh.cell_height);
        }
        mesh.detail.vertices[4] = tl_vec3_make(4.0f, x == 0 ? bend_a : bend_b, x == 0 ? 1.5f : 2.5f);
        tl_nav_tile_source source = fixture_source(&mesh);
        tl_nav_tile *tile = NULL;
        TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        fixture_free_mesh(&mesh);
    }
    uint64_t count = tl_navmesh_link_count(navmesh);
    tl_navmesh_destroy(navmesh);
    return count;
}

// The tolerance is the climb, 0.5, and one cell height, 0.125.
static void test_heights_along_the_seam(void **state)
{
    (void)state;
    TEST_CHECK(links_of_bent_seam(0, 0, 0, 0) == 2);
    TEST_CHECK(links_of_bent_seam(0, 0, 0.625f, 0.625f) == 2);
    TEST_CHECK(links_of_bent_seam(0, 0, 0.75f, 0.63f) == 0);
    TEST_CHECK(links_of_bent_seam(0, 0, 0.75f, 0.62f) == 2); // at their bends alone
    TEST_CHECK(links_of_bent_seam(0, 3, 3, 3) == 2);         // a hill that touches the upper floor at its bend
    TEST_CHECK(links_of_bent_seam(0, 2, 3, 3) == 0);         // one that does not
    TEST_CHECK(links_of_bent_seam(0, 9, 3, 3) == 2);         // one that runs through it
    TEST_CHECK(links_of_bent_seam(0, 9, 30, 3) == 2);        // two slopes that cross between bends
    TEST_CHECK(links_of_bent_seam(0, 9, 10, 11) == 0);       // a hill under a hill
}

static void test_memory(void **state)
{
    (void)state;
    test_random random = { 23 };
    fixture_level level = fixture_random(&random, 0, 9);
    level.tile_cells = 3;
    uint32_t failures = 0;
    for (uint64_t k = 1;; k++) {
        test_allocator failing;
        test_allocator_init(&failing, 0);
        tl_navmesh *navmesh = NULL;
        failing.fail_at = k == 1 ? 1 : 0;
        if (tl_navmesh_create(&failing.allocator, &navmesh) == TL_ERR_MEMORY) {
            TEST_CHECK(navmesh == NULL && failing.live_blocks == 0);
            continue;
        }
        const int32_t places[5][2] = { { 0, 1 }, { 1, 0 }, { 2, 1 }, { 1, 2 }, { 1, 1 } };
        tl_nav_tile *tiles[5];
        bool failed = false;
        failing.fail_at = k;
        for (uint32_t i = 0; i < 5; i++) {
            tiles[i] = fixture_build_tile(&level, places[i][0], places[i][1], NULL);
            uint64_t links = tl_navmesh_link_count(navmesh);
            uint32_t count = tl_navmesh_tile_count(navmesh);
            tl_result result = tl_navmesh_add_tile(navmesh, tiles[i], TL_NAV_TILE_BORROWED);
            if (result != TL_OK) {
                TEST_RESULT(result, TL_ERR_MEMORY);
                TEST_CHECK(tl_navmesh_link_count(navmesh) == links && tl_navmesh_tile_count(navmesh) == count);
                TEST_CHECK(tl_navmesh_find_tile(navmesh, places[i][0], places[i][1]) == NULL);
                failed = true;
                failures++;
                failing.fail_at = 0;
                TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
            }
        }
        uint32_t count = 0;
        plain_link *links = collect(navmesh, &count);
        TEST_CHECK(check_symmetric(links, count) > 10);
        free(links);
        tl_navmesh_destroy(navmesh);
        for (uint32_t i = 0; i < 5; i++) {
            tl_blob_free(tiles[i]);
        }
        TEST_CHECK(failing.live_blocks == 0);
        if (!failed) {
            break;
        }
    }
    TEST_CHECK(failures > 15);
}

// A slot whose salts are used up is not used again; references to its tiles stay stale.
static void test_salts_run_out(void **state)
{
    (void)state;
    const char *const rows[] = { "0" };
    fixture_level level = fixture_make(rows, 1);
    level.tile_cells = 1;
    tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    tl_nav_ref first = TL_NAV_NO_REF;
    for (uint32_t i = 0; i < 65535; i++) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED), TL_OK);
        TEST_CHECK(tl_navmesh_slot_count(navmesh) == 1);
        first = i == 0 ? tl_navmesh_polygon_ref(navmesh, 0, 0) : first;
        TEST_CHECK(i == 0 || tl_navmesh_polygon_ref(navmesh, 0, 0) != first);
        TEST_RESULT(tl_navmesh_remove_tile(navmesh, 0, 0), TL_OK);
    }
    TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED), TL_OK);
    TEST_CHECK(tl_navmesh_slot_count(navmesh) == 2 && tl_navmesh_slot_tile(navmesh, 0) == NULL);
    TEST_RESULT(tl_navmesh_resolve(navmesh, first, NULL, NULL), TL_ERR_STALE);
    tl_navmesh_destroy(navmesh);
    tl_blob_free(tile);
}

// All tiles come in, or none does; then they stay the caller's, and the report names the tile.
static void test_add_tiles(void **state)
{
    (void)state;
    const char *const rows[] = { "000000" };
    fixture_level level = fixture_make(rows, 1);
    level.tile_cells = 2;
    tl_nav_tile *tiles[4] = { NULL };
    for (int32_t x = 0; x < 3; x++) {
        tiles[x] = fixture_build_tile(&level, x, 0, NULL);
    }
    tiles[3] = tiles[1];
    tl_navmesh *navmesh = NULL;
    tl_report report;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_add_tiles(navmesh, tiles, 4, TL_NAV_TILE_OWNED, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.element, "tile") == 0 && report.element_index == 3 && report.advice != NULL);
    TEST_CHECK(tl_navmesh_tile_count(navmesh) == 0 && tl_navmesh_link_count(navmesh) == 0);
    TEST_RESULT(tl_navmesh_add_tiles(navmesh, tiles, 3, TL_NAV_TILE_OWNED, NULL), TL_OK);
    TEST_CHECK(tl_navmesh_tile_count(navmesh) == 3 && tl_navmesh_link_count(navmesh) > 0);
    TEST_RESULT(tl_navmesh_add_tiles(navmesh, NULL, 0, TL_NAV_TILE_OWNED, NULL), TL_OK);
    tl_navmesh_destroy(navmesh);
}

// With room reserved no table of all tiles is made anew: no block is as large as one.
static void test_reserved_tiles(void **state)
{
    (void)state;
    enum { SIDE = 12, TILES = SIDE * SIDE, LEAST_TABLE = TILES * 100 };
    for (uint32_t reserves = 0; reserves < 2; reserves++) {
        const char *const rows[] = { "0" };
        const fixture_level level = fixture_make(rows, 1);
        test_allocator memory;
        test_allocator_init(&memory, 0);
        tl_navmesh *navmesh = NULL;
        TEST_RESULT(tl_navmesh_create(&memory.allocator, &navmesh), TL_OK);
        TEST_RESULT(tl_navmesh_reserve_tiles(navmesh, reserves > 0 ? TILES : 0), TL_OK);
        memory.largest = 0;
        for (int32_t i = 0; i < TILES; i++) {
            tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, NULL);
            tile->tile_x = i % SIDE;
            tile->tile_z = i / SIDE;
            TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
        }
        TEST_CHECK((memory.largest < LEAST_TABLE) == (reserves > 0));
        TEST_RESULT(tl_navmesh_reserve_tiles(navmesh, TL_NAV_MAX_TILES - TILES + 1), TL_ERR_LIMIT);
        TEST_CHECK(tl_navmesh_tile_count(navmesh) == TILES);
        tl_navmesh_destroy(navmesh);
        TEST_CHECK(memory.live_blocks == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_example),
        cmocka_unit_test(test_refused_tiles),
        cmocka_unit_test(test_random_edits),
        cmocka_unit_test(test_seam_oracle),
        cmocka_unit_test(test_heights_along_the_seam),
        cmocka_unit_test(test_memory),
        cmocka_unit_test(test_salts_run_out),
        cmocka_unit_test(test_add_tiles),
        cmocka_unit_test(test_reserved_tiles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
