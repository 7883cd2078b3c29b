// SPDX-License-Identifier: MIT
//
// Floors packed and unpacked are the same floors: of built-in levels, of a tower of many storeys, with links of 16 and
// of 32 bits; in a fraction of the memory; and every allocation may fail.

#include "nav_obstacles/footprint.h"
#include "nav_obstacles/packed_floors.h"

#include "base/arena.h"
#include "cli/sample/sample_level.h"
#include "talus_test.h"

#include <stdlib.h>
#include <string.h>

static void bake_floors(const char *level, uint32_t triangles, float cell_size, tl_nav_stages *stages)
{
    tl_sample_mesh mesh;
    TEST_RESULT(tl_sample_build_level(tl_sample_find_level(level), triangles, 1, &mesh), TL_OK);
    const tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = cell_size;
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < view.vertex_count; i++) {
        bounds = tl_aabb_add_point(bounds, view.vertices[i]);
    }
    const tl_nav_input input = { view, NULL, NULL, 0 };
    tl_nav_config config;
    tl_nav_tile *tile;
    TEST_RESULT(tl_nav_config_from_def(&def, bounds, 0, 0, &config, NULL), TL_OK);
    TEST_RESULT(tl_nav_tile_bake(&config, &input, NULL, stages, &tile, NULL), TL_OK);
    tl_blob_free(tile);
    tl_sample_mesh_free(&mesh);
}

static void check_equal(const tl_nav_compact *a, const tl_nav_compact *b)
{
    const size_t columns = (size_t)a->width * a->height, spans = a->span_count;
    TEST_CHECK(b->width == a->width && b->height == a->height && b->span_count == a->span_count);
    TEST_CHECK(b->lattice.first_x == a->lattice.first_x && b->cell_height == a->cell_height);
    TEST_CHECK(memcmp(a->first_span, b->first_span, (columns + 1) * sizeof *a->first_span) == 0);
    TEST_CHECK(memcmp(a->floor, b->floor, spans * sizeof *a->floor) == 0);
    TEST_CHECK(memcmp(a->area, b->area, spans) == 0);
    TEST_CHECK((a->step != NULL) == (b->step != NULL) && (a->neighbour != NULL) == (b->neighbour != NULL));
    for (uint32_t i = 0; i < a->span_count; i++) {
        for (uint32_t d = 0; d < 4; d++) {
            TEST_CHECK(tl_nav_compact_neighbour(a, i, d) == tl_nav_compact_neighbour(b, i, d));
        }
    }
}

// Packs and unpacks; returns the packed bytes.
static uint64_t round_trip(const tl_nav_compact *compact)
{
    const tl_allocator allocator = tl_allocator_or_default(NULL);
    tl_floors_scratch scratch = { .allocator = &allocator };
    tl_packed_floors packed;
    tl_nav_compact again;
    uint8_t *base_area;
    TEST_RESULT(tl_floors_pack(compact, &allocator, &packed), TL_OK);
    for (int k = 0; k < 2; k++) { // into a new block, and into the same again
        TEST_RESULT(tl_floors_unpack(&packed, &scratch, &again, &base_area), TL_OK);
        tl_floors_link(&scratch, &again);
        check_equal(compact, &again);
        TEST_CHECK(memcmp(base_area, compact->area, compact->span_count) == 0);
    }
    const uint64_t size = packed.size;
    tl_floors_scratch_free(&scratch);
    tl_packed_floors_free(&packed);
    return size;
}

static void floors_come_back(void **state)
{
    (void)state;
    const char *const levels[] = { "courtyard", "dungeon", "terrain", "city" };
    for (int k = 0; k < 4; k++) {
        tl_nav_stages stages;
        bake_floors(levels[k], 3000, 0.3f, &stages);
        tl_nav_compact *compact = &stages.compact;
        const uint64_t size = round_trip(compact);
        TEST_CHECK(compact->span_count > 5000 && compact->step != NULL);
        TEST_CHECK(size < 5 * (uint64_t)compact->span_count); // 16 bytes a floor before

        // Areas of every kind, so that no runs are left, and links of 32 bits.
        test_random random = { (uint64_t)k };
        for (uint32_t i = 0; i < compact->span_count; i++) {
            compact->area[i] = (uint8_t)test_random_below(&random, 1 + i % 200);
        }
        round_trip(compact);
        tl_nav_compact wide = *compact;
        wide.neighbour = malloc(4 * (size_t)compact->span_count * sizeof *wide.neighbour);
        for (uint32_t i = 0; i < 4 * compact->span_count; i++) {
            wide.neighbour[i] = tl_nav_compact_neighbour(compact, i / 4, i % 4);
        }
        wide.step = NULL;
        round_trip(&wide);
        free(wide.neighbour);
        tl_nav_stages_free(&stages);
    }
}

// An obstacle that marks a floor reaches the floors; many that mark none do not.
static void test_reach(void **state)
{
    (void)state;
    const tl_allocator allocator = tl_allocator_or_default(NULL);
    tl_nav_stages stages;
    bake_floors("courtyard", 3000, 0.3f, &stages);
    tl_nav_compact *compact = &stages.compact;
    tl_packed_floors packed;
    TEST_RESULT(tl_floors_pack(compact, &allocator, &packed), TL_OK);
    uint8_t *base = malloc(compact->span_count);
    memcpy(base, compact->area, compact->span_count);
    test_random random = { 4 };
    uint32_t marking = 0, beside = 0;
    for (uint32_t round = 0; round < 2000; round++) {
        tl_nav_obstacle o;
        memset(&o, 0, sizeof o);
        o.base = test_random_point(&random, tl_vec3_make(-8, -6, -8), tl_vec3_make(48, 14, 48));
        o.height = test_random_range(&random, 0.0f, 2.0f);
        o.radius = test_random_range(&random, 0.05f, 2.0f);
        o.area = (uint8_t)(round % 2);
        tl_obstacle_mark(&o, 0.6f, 2.0f, compact);
        const bool marks = memcmp(base, compact->area, compact->span_count) != 0;
        const bool reaches = tl_packed_floors_reach(&packed, tl_obstacle_box(&o, 0.6f, 2.0f));
        TEST_CHECK(reaches || !marks);
        marking += marks;
        beside += !reaches;
        memcpy(compact->area, base, compact->span_count);
    }
    TEST_CHECK(marking > 50 && beside > 200);
    free(base);
    tl_packed_floors_free(&packed);
    tl_nav_stages_free(&stages);
}

// Two columns of 300 floors, each linked with one of the three that it could be.
static void towers_come_back(void **state)
{
    (void)state;
    enum { FLOORS = 300 };
    static uint16_t floor[2 * FLOORS];
    static uint8_t area[2 * FLOORS];
    static int16_t step[4 * 2 * FLOORS];
    uint32_t first_span[3] = { 0, FLOORS, 2 * FLOORS };
    uint32_t linked = 0;
    for (uint32_t i = 0; i < FLOORS; i++) {
        floor[i] = floor[FLOORS + i] = (uint16_t)(7 * i);
        area[i] = area[FLOORS + i] = (uint8_t)(1 + i % 3);
        if (i % 3 != 0 && i + i % 2 < FLOORS) { // upwards by one storey or not: no two cross
            const uint32_t other = FLOORS + i + i % 3 - 1;
            const int32_t to = (int32_t)(other - i);
            step[4 * i + 2] = (int16_t)to;
            step[4 * other] = (int16_t)-to;
            linked++;
        }
    }
    TEST_CHECK(linked > 100);
    tl_nav_compact compact;
    memset(&compact, 0, sizeof compact);
    compact.width = 2;
    compact.height = 1;
    compact.span_count = 2 * FLOORS;
    compact.first_span = first_span;
    compact.floor = floor;
    compact.area = area;
    compact.step = step;
    round_trip(&compact);
}

static void failing_memory_is_reported(void **state)
{
    (void)state;
    tl_nav_stages stages;
    bake_floors("courtyard", 0, 0.6f, &stages);
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_packed_floors packed;
        tl_nav_compact again;
        uint8_t *base_area;
        tl_floors_scratch scratch = { .allocator = &memory.allocator };
        tl_result result = tl_floors_pack(&stages.compact, &memory.allocator, &packed);
        if (result == TL_OK) {
            result = tl_floors_unpack(&packed, &scratch, &again, &base_area);
            tl_floors_scratch_free(&scratch);
            tl_packed_floors_free(&packed);
        }
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 4);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
    tl_nav_stages_free(&stages);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_reach), cmocka_unit_test(floors_come_back),
                                        cmocka_unit_test(towers_come_back),
                                        cmocka_unit_test(failing_memory_is_reported) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
