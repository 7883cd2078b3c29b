// SPDX-License-Identifier: MIT
//
// Whole levels in tiles: what a bake without tiles finds, seams that match from both sides, the same bytes for any
// number of workers, failing and cancelling.

#include "nav_fields.h"
#include "nav_level.h"

#include <math.h>

static test_level LEVEL;

static tl_nav_def level_def(float cell_size, uint32_t tile_size)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = cell_size;
    def.agent_radius = 0.4f;
    def.region_min_size = 2;
    def.tile_size = tile_size;
    return def;
}

static double area_of(const tl_nav_tiles *tiles)
{
    double sum = 0;
    for (uint32_t i = 0; i < tiles->tile_count; i++) {
        TEST_RESULT(tl_nav_tile_check(tiles->tiles[i], tiles->tiles[i]->blob.size, NULL), TL_OK);
        sum += tiles->tiles[i]->area;
    }
    return sum;
}

static bool same_tiles(const tl_nav_tiles *a, const tl_nav_tiles *b)
{
    bool same = a->tile_count == b->tile_count && a->tiles_x == b->tiles_x && a->tiles_z == b->tiles_z;
    for (uint32_t i = 0; same && i < a->tile_count; i++) {
        same = a->tiles[i]->blob.size == b->tiles[i]->blob.size &&
               memcmp(a->tiles[i], b->tiles[i], a->tiles[i]->blob.size) == 0;
    }
    return same;
}

static void tiles_find_what_one_bake_finds(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_def def = level_def(0.2f, 0);
    tl_nav_tiles whole;
    TEST_RESULT(tl_nav_bake(&def, &input, &whole, NULL), TL_OK);
    TEST_CHECK(whole.tile_count == 1 && whole.tiles_x == 1 && whole.tiles_z == 1);
    const double area = area_of(&whole);
    const uint32_t sizes[] = { 16, 31, 48, 200 };
    for (size_t s = 0; s < sizeof sizes / sizeof sizes[0]; s++) {
        def = level_def(0.2f, sizes[s]);
        tl_nav_tiles tiles;
        tl_nav_bake_report report;
        TEST_RESULT(tl_nav_bake(&def, &input, &tiles, &report), TL_OK);
        TEST_CHECK(tiles.tiles_x == (122 + sizes[s] - 1) / sizes[s]);
        TEST_CHECK(report.tile_count == tiles.tile_count && report.base.peak_bytes > 0);
        TEST_CHECK(fabs(area_of(&tiles) / area - 1) < 0.03);
        uint32_t polygons = 0;
        for (uint32_t i = 0; i < tiles.tile_count; i++) {
            const tl_nav_tile *tile = tiles.tiles[i];
            polygons += tile->polygon_count;
            TEST_CHECK(tile->tile_size == sizes[s]);
            const tl_nav_tile *next = i + 1 < tiles.tile_count ? tiles.tiles[i + 1] : NULL;
            TEST_CHECK(next == NULL || tile->tile_z < next->tile_z ||
                       (tile->tile_z == next->tile_z && tile->tile_x < next->tile_x));
        }
        TEST_CHECK(polygons == report.polygon_count);
        tl_nav_tiles_free(&tiles);
    }
    tl_nav_tiles_free(&whole);
}

// ---- Seams -------------------------------------------------------------------------------------------------

enum { MAX_TILE_SIZE = 64 };

// For each cell along a side: how many floors one can step out from, and how many portals lie there.
typedef struct seam {
    uint32_t links[MAX_TILE_SIZE];
    uint32_t portals[MAX_TILE_SIZE];
    uint32_t link_sum;
} seam;

// Sides and directions: 0 x-, 1 z+, 2 x+, 3 z-.
static void count_links(const tl_nav_compact *compact, uint32_t side, seam *out)
{
    const uint32_t border = compact->border_size, size = compact->width - 2 * border;
    for (uint32_t i = 0; i < size; i++) {
        uint32_t x = side == 0 ? border : side == 2 ? border + size - 1 : border + i;
        uint32_t z = side == 3 ? border : side == 1 ? border + size - 1 : border + i;
        uint32_t column = z * compact->width + x;
        for (uint32_t f = compact->first_span[column]; f < compact->first_span[column + 1]; f++) {
            uint32_t beside = tl_nav_compact_neighbour(compact, f, side);
            bool link = beside != TL_NAV_NO_SPAN && compact->area[f] != 0 && compact->area[beside] != 0;
            out->links[i] += link;
            out->link_sum += link;
        }
    }
}

static void count_portals(const tl_nav_tile *tile, uint32_t side, seam *out)
{
    for (uint32_t p = tl_nav_tile_side_first(tile, side); p < tl_nav_tile_side_first(tile, side + 1); p++) {
        const tl_nav_portal *portal = &tl_nav_tile_portals(tile)[p];
        for (int32_t i = portal->low; i < portal->high; i++) {
            TEST_CHECK(i >= 0 && i < (int32_t)tile->tile_size);
            out->portals[i]++;
        }
    }
}

typedef struct tile_seams {
    seam sides[4];
} tile_seams;

static tile_seams build_seams(const tl_nav_def *def, const tl_nav_input *input, uint32_t tile_x, uint32_t tile_z)
{
    tile_seams seams;
    memset(&seams, 0, sizeof seams);
    tl_nav_config config;
    TEST_RESULT(tl_nav_config_from_def(def, test_level_bounds(&LEVEL), tile_x, tile_z, &config, NULL), TL_OK);
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    tl_nav_tile *tile;
    TEST_RESULT(tl_nav_tile_bake(&config, input, NULL, &stages, &tile, NULL), TL_OK);
    for (uint32_t side = 0; side < 4; side++) {
        count_links(&stages.compact, side, &seams.sides[side]);
        if (tile != NULL) {
            count_portals(tile, side, &seams.sides[side]);
        }
    }
    tl_blob_free(tile);
    tl_nav_stages_free(&stages);
    return seams;
}

// Two tiles count the same steps across their seam, cell by cell, and each has a portal for every one of them. (A
// portal without a step may be: a wall that happens to lie on the seam. It links to nothing.)
static void check_seam(const seam *a, const seam *b)
{
    TEST_CHECK(memcmp(a->links, b->links, sizeof a->links) == 0);
    for (uint32_t i = 0; i < MAX_TILE_SIZE; i++) {
        TEST_CHECK(a->portals[i] >= a->links[i] && b->portals[i] >= b->links[i]);
    }
}

static void seams_match_from_both_sides(void **state)
{
    (void)state;
    const tl_vec3 offsets[] = { { 0, 0, 0 }, { 5003.7f, 12, -4999.3f } };
    const tl_nav_partition partitions[] = { TL_NAV_WATERSHED, TL_NAV_MONOTONE, TL_NAV_LAYERS };
    uint32_t compared = 0;
    for (uint32_t round = 0; round < 6; round++) {
        test_level_make(&LEVEL, offsets[round / 3]);
        tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
        tl_nav_def def = level_def(0.2f, 24 + round);
        def.partition = partitions[round % 3];
        uint32_t tiles_x, tiles_z;
        TEST_RESULT(tl_nav_tile_grid(&def, test_level_bounds(&LEVEL), &tiles_x, &tiles_z, NULL), TL_OK);
        tile_seams before[8], row[8];
        TEST_CHECK(tiles_x <= 8 && tiles_x > 2 && tiles_z > 2);
        for (uint32_t z = 0; z < tiles_z; z++) {
            for (uint32_t x = 0; x < tiles_x; x++) {
                row[x] = build_seams(&def, &input, x, z);
                if (x > 0) {
                    check_seam(&row[x - 1].sides[2], &row[x].sides[0]);
                    compared += row[x].sides[0].link_sum;
                }
                if (z > 0) {
                    check_seam(&before[x].sides[1], &row[x].sides[3]);
                    compared += row[x].sides[3].link_sum;
                }
            }
            memcpy(before, row, sizeof row);
        }
    }
    TEST_CHECK(compared > 2000);
}

static void workers_do_not_matter(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(3.3f, 0, 1000));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_def def = level_def(0.15f, 32);
    tl_nav_tiles expected, other;
    tl_nav_bake_report expected_report, report;
    TEST_RESULT(tl_nav_bake(&def, &input, &expected, &expected_report), TL_OK);
    for (uint32_t workers = 1; workers <= 5; workers += 2) {
        tl_tasks tasks;
        test_backward_tasks(&tasks, workers);
        def.host.tasks = &tasks;
        TEST_RESULT(tl_nav_bake(&def, &input, &other, &report), TL_OK);
        TEST_CHECK(same_tiles(&expected, &other));
        TEST_CHECK(report.span_count == expected_report.span_count &&
                   report.polygon_count == expected_report.polygon_count);
        tl_nav_tiles_free(&other);
    }
    tl_nav_tiles_free(&expected);
}

static void bad_input_is_named(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_def def = level_def(0.2f, 32);
    tl_nav_tiles tiles;
    tl_nav_bake_report report;
    def.agent_max_slope = 95;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.base.field, "agent_max_slope");
    def = level_def(0.2f, 32);
    LEVEL.vertices[9].y = NAN;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, &report), TL_ERR_NOT_FINITE);
    assert_string_equal(report.base.element, "vertex");
    TEST_CHECK(report.base.element_index == 9 && tiles.tiles == NULL);
    // A level on which nobody can walk is no error.
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    def.agent_radius = 50;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, &report), TL_OK);
    TEST_CHECK(tiles.tile_count == 0 && report.tile_count == 0);
    tl_nav_tiles_free(&tiles);
}

// A floor of 256 strips 4 m wide, an area each: all that are walkable come out, whatever the partition.
static void all_areas_are_kept(void **state)
{
    (void)state;
    static const float STRIP = 4.0f, DEPTH = 3.0f;
    static tl_vec3 vertices[2 * 257];
    static uint32_t indices[6 * 256];
    static uint8_t areas[2 * 256];
    for (uint32_t i = 0; i <= 256; i++) {
        vertices[2 * i] = tl_vec3_make(STRIP * (float)i, 0, 0);
        vertices[2 * i + 1] = tl_vec3_make(STRIP * (float)i, 0, DEPTH);
    }
    for (uint32_t i = 0; i < 256; i++) {
        const uint32_t quad[6] = { 2 * i, 2 * i + 1, 2 * i + 3, 2 * i, 2 * i + 3, 2 * i + 2 };
        memcpy(indices + 6 * i, quad, sizeof quad);
        areas[2 * i] = areas[2 * i + 1] = (uint8_t)i;
    }
    const tl_nav_input input = { { vertices, 2 * 257, indices, 2 * 256, NULL }, areas, NULL, 0 };
    for (uint32_t run = 0; run < 6; run++) {
        tl_nav_def def = level_def(0.5f, run < 3 ? 0 : 100);
        def.partition = (tl_nav_partition)(run % 3);
        def.agent_radius = 0.0f;
        def.region_min_size = 0.0f;
        def.region_merge_size = 0.0f;
        tl_nav_tiles tiles;
        TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
        double square_metres[TL_NAV_MAX_AREA + 1] = { 0 };
        for (uint32_t t = 0; t < tiles.tile_count; t++) {
            TEST_RESULT(tl_nav_tile_check(tiles.tiles[t], tiles.tiles[t]->blob.size, NULL), TL_OK);
            for (uint32_t p = 0; p < tiles.tiles[t]->polygon_count; p++) {
                square_metres[tl_nav_tile_area(tiles.tiles[t], p)] += tl_nav_tile_polygon_area(tiles.tiles[t], p);
            }
        }
        TEST_CHECK(square_metres[0] == 0.0);
        for (uint32_t area = 2; area < TL_NAV_MAX_AREA; area++) { // the ends' rims are ledges
            TEST_CHECK(square_metres[area] == (double)STRIP * ((double)DEPTH - 1.0));
        }
        TEST_CHECK(square_metres[1] > 0.0 && square_metres[TL_NAV_MAX_AREA] > 0.0);
        tl_nav_tiles_free(&tiles);
    }
}

static void cancelling_leaves_nothing(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    for (uint32_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        test_progress progress;
        test_progress_init(&progress, k);
        tl_nav_def def = level_def(0.2f, 16);
        def.host.allocator = &memory.allocator;
        def.host.progress = &progress.progress;
        tl_nav_tiles tiles;
        tl_result result = tl_nav_bake(&def, &input, &tiles, NULL);
        TEST_CHECK(result == TL_OK || tiles.tiles == NULL);
        tl_nav_tiles_free(&tiles);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 5);
            break;
        }
        TEST_RESULT(result, TL_ERR_CANCELLED);
    }
}

static void failing_memory_leaves_nothing(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_nav_def def = level_def(0.5f, 20);
        def.host.allocator = &memory.allocator;
        tl_nav_tiles tiles;
        tl_nav_bake_report report;
        tl_result result = tl_nav_bake(&def, &input, &tiles, &report);
        TEST_CHECK(result == TL_OK || tiles.tiles == NULL);
        tl_nav_tiles_free(&tiles);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 50);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_find_what_one_bake_finds),
        cmocka_unit_test(seams_match_from_both_sides),
        cmocka_unit_test(workers_do_not_matter),
        cmocka_unit_test(all_areas_are_kept),
        cmocka_unit_test(bad_input_is_named),
        cmocka_unit_test(cancelling_leaves_nothing),
        cmocka_unit_test(failing_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
