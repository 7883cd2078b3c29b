// SPDX-License-Identifier: MIT
//
// Erosion. On one layer the two sweeps are an exact 2-3 distance transform, so the oracle looks at all borders; over
// several layers the twin repeats the sweeps with neighbours that it looks up itself.

#include "nav_fields.h"

enum { SIDE = 24 };

// One layer of floors at height 1 with holes.
static tl_nav_compact flat_compact(test_random *random, const tl_nav_config *config, uint32_t holes)
{
    tl_nav_heightfield field = test_random_heightfield(random, config, 1);
    uint32_t at = 0;
    for (uint32_t c = 0; c < SIDE * SIDE; c++) {
        field.first_span[c] = at;
        if (test_random_below(random, 1000) >= holes) {
            field.spans[at++] = (tl_nav_span){ 0, 1, (uint16_t)(1 + test_random_below(random, 60)), 0 };
        }
    }
    field.first_span[SIDE * SIDE] = field.span_count = at;
    tl_nav_compact compact;
    TEST_RESULT(tl_nav_bake_compact(config, &field, NULL, &compact, NULL), TL_OK);
    tl_nav_heightfield_free(&field);
    return compact;
}

static bool has_floor(const tl_nav_compact *compact, int x, int z)
{
    if (x < 0 || z < 0 || x >= SIDE || z >= SIDE) {
        return false;
    }
    return compact->first_span[z * SIDE + x] < compact->first_span[z * SIDE + x + 1];
}

static bool on_border(const tl_nav_compact *compact, int x, int z)
{
    return !has_floor(compact, x - 1, z) || !has_floor(compact, x + 1, z) || !has_floor(compact, x, z - 1) ||
           !has_floor(compact, x, z + 1);
}

static int naive_distance(const tl_nav_compact *compact, int x, int z)
{
    int nearest = 1000;
    for (int bz = 0; bz < SIDE; bz++) {
        for (int bx = 0; bx < SIDE; bx++) {
            if (has_floor(compact, bx, bz) && on_border(compact, bx, bz)) {
                int dx = abs(bx - x), dz = abs(bz - z), diagonal = dx < dz ? dx : dz;
                int distance = 3 * diagonal + 2 * (dx + dz - 2 * diagonal);
                nearest = distance < nearest ? distance : nearest;
            }
        }
    }
    return nearest;
}

static void one_layer_is_eroded_exactly(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint32_t eroded = 0, kept = 0;
    for (uint32_t round = 0; round < 60; round++) {
        tl_nav_config config = test_nav_config(SIDE, SIDE);
        config.walkable_radius = test_random_below(&random, 5);
        tl_nav_compact compact = flat_compact(&random, &config, 5 + test_random_below(&random, 40));
        uint8_t before[SIDE * SIDE];
        memcpy(before, compact.area, compact.span_count);
        TEST_RESULT(tl_nav_erode(&config, NULL, &compact, NULL), TL_OK);
        for (int z = 0; z < SIDE; z++) {
            for (int x = 0; x < SIDE; x++) {
                if (has_floor(&compact, x, z)) {
                    uint32_t i = compact.first_span[z * SIDE + x];
                    bool stays = naive_distance(&compact, x, z) >= 2 * (int)config.walkable_radius;
                    TEST_CHECK(compact.area[i] == (stays ? before[i] : 0));
                    eroded += !stays;
                    kept += stays && config.walkable_radius > 0;
                }
            }
        }
        tl_nav_compact_free(&compact);
    }
    TEST_CHECK(eroded > 3000 && kept > 3000);
}

static uint32_t beside(const tl_nav_compact *compact, uint32_t i, uint32_t direction)
{
    return i == TL_NAV_NO_SPAN ? i : tl_nav_compact_neighbour(compact, i, direction);
}

static void relax(const int *distance, uint32_t from, int step, int *nearest)
{
    if (from != TL_NAV_NO_SPAN && distance[from] + step < *nearest) {
        *nearest = distance[from] + step;
    }
}

static void layers_agree_with_the_twin(void **state)
{
    (void)state;
    test_random random = { 15 };
    uint32_t eroded = 0, kept = 0;
    for (uint32_t round = 0; round < 100; round++) {
        tl_nav_config config = test_nav_config(SIDE, SIDE);
        config.walkable_radius = 1 + test_random_below(&random, 2);
        config.walkable_climb = 40; // so that most floors have neighbours
        config.walkable_height = 1;
        tl_nav_heightfield field = test_random_heightfield(&random, &config, 3);
        for (uint32_t i = 0; i < field.span_count; i++) {
            field.spans[i].area = field.spans[i].area == 0 ? 5 : field.spans[i].area;
        }
        tl_nav_compact compact;
        TEST_RESULT(tl_nav_bake_compact(&config, &field, NULL, &compact, NULL), TL_OK);
        int *distance = malloc((compact.span_count + 1) * sizeof *distance);
        for (uint32_t i = 0; i < compact.span_count; i++) {
            compact.area[i] = test_random_below(&random, 50) == 0 ? 0 : compact.area[i];
        }
        for (uint32_t i = 0; i < compact.span_count; i++) {
            bool inside = compact.area[i] != 0;
            for (uint32_t d = 0; d < 4; d++) {
                uint32_t n = beside(&compact, i, d);
                inside = inside && n != TL_NAV_NO_SPAN && compact.area[n] != 0;
            }
            distance[i] = inside ? 255 : 0;
        }
        const uint32_t pass[2][4] = { { 0, 3, 3, 2 }, { 2, 1, 1, 0 } };
        for (uint32_t p = 0; p < 2; p++) {
            for (uint32_t n = 0; n < compact.span_count; n++) {
                uint32_t i = p == 0 ? n : compact.span_count - 1 - n;
                for (uint32_t k = 0; k < 2; k++) {
                    uint32_t straight = beside(&compact, i, pass[p][2 * k]);
                    relax(distance, straight, 2, &distance[i]);
                    relax(distance, beside(&compact, straight, pass[p][2 * k + 1]), 3, &distance[i]);
                }
            }
        }
        uint8_t *before = malloc(compact.span_count + 1);
        memcpy(before, compact.area, compact.span_count);
        TEST_RESULT(tl_nav_erode(&config, NULL, &compact, NULL), TL_OK);
        for (uint32_t i = 0; i < compact.span_count; i++) {
            bool stays = distance[i] >= 2 * (int)config.walkable_radius;
            TEST_CHECK(compact.area[i] == (stays ? before[i] : 0));
            eroded += !stays;
            kept += stays;
        }
        free(before);
        free(distance);
        tl_nav_compact_free(&compact);
        tl_nav_heightfield_free(&field);
    }
    TEST_CHECK(eroded > 1000 && kept > 300);
}

static void failing_and_cancelling(void **state)
{
    (void)state;
    test_random random = { 5 };
    tl_nav_config config = test_nav_config(SIDE, SIDE);
    config.walkable_radius = TL_NAV_MAX_VOXELS; // takes all
    tl_nav_compact compact = flat_compact(&random, &config, 0);
    test_allocator memory;
    test_allocator_init(&memory, 1);
    tl_host host = { &memory.allocator, NULL, NULL };
    TEST_RESULT(tl_nav_erode(&config, &host, &compact, NULL), TL_ERR_MEMORY);
    test_progress progress;
    test_progress_init(&progress, 1);
    host = (tl_host){ NULL, NULL, &progress.progress };
    TEST_RESULT(tl_nav_erode(&config, &host, &compact, NULL), TL_ERR_CANCELLED);
    TEST_CHECK(compact.area[0] != 0);
    TEST_RESULT(tl_nav_erode(&config, NULL, &compact, NULL), TL_OK);
    for (uint32_t i = 0; i < compact.span_count; i++) {
        TEST_CHECK(compact.area[i] == 0);
    }
    tl_nav_compact_free(&compact);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(one_layer_is_eroded_exactly),
                                        cmocka_unit_test(layers_agree_with_the_twin),
                                        cmocka_unit_test(failing_and_cancelling) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
