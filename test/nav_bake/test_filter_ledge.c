// SPDX-License-Identifier: MIT
//
// Ledges: examples, and a twin that reads the rule literally: all free gaps of all four columns beside, the one below
// the lowest span included.

#include "nav_fields.h"

typedef struct gap {
    int bottom, top;
} gap;

enum { BOTTOMLESS = -1000000, SKY = 1000000 };

static uint32_t gaps_of(const tl_nav_span *spans, uint32_t begin, uint32_t end, gap *gaps)
{
    uint32_t count = 0;
    int bottom = BOTTOMLESS;
    for (uint32_t i = begin; i < end; i++) {
        gaps[count++] = (gap){ bottom, spans[i].min };
        bottom = spans[i].max;
    }
    gaps[count++] = (gap){ bottom, SKY };
    return count;
}

static bool naive_ledge(const tl_nav_config *config, const tl_nav_heightfield *field, uint32_t x, uint32_t z,
                        uint32_t span, bool *steep)
{
    const int climb = (int)config->walkable_climb, room = (int)config->walkable_height;
    const uint32_t column = z * field->width + x;
    const int floor = field->spans[span].max;
    const int ceiling = span + 1 < field->first_span[column + 1] ? field->spans[span + 1].min : SKY;
    const int step_x[] = { -1, 0, 1, 0 }, step_z[] = { 0, 1, 0, -1 };
    int lowest = floor, highest = floor;
    *steep = false;
    for (int d = 0; d < 4; d++) {
        int nx = (int)x + step_x[d], nz = (int)z + step_z[d];
        if (nx < 0 || nz < 0 || nx >= (int)field->width || nz >= (int)field->height) {
            return true;
        }
        uint32_t beside = (uint32_t)nz * field->width + (uint32_t)nx;
        gap gaps[16];
        uint32_t count = gaps_of(field->spans, field->first_span[beside], field->first_span[beside + 1], gaps);
        for (uint32_t g = 0; g < count; g++) {
            int top = gaps[g].top < ceiling ? gaps[g].top : ceiling;
            int bottom = gaps[g].bottom > floor ? gaps[g].bottom : floor;
            if (top - bottom < room) {
                continue;
            }
            if (gaps[g].bottom < floor - climb) {
                return true;
            }
            if (gaps[g].bottom <= floor + climb) {
                lowest = gaps[g].bottom < lowest ? gaps[g].bottom : lowest;
                highest = gaps[g].bottom > highest ? gaps[g].bottom : highest;
            }
        }
    }
    *steep = highest - lowest > climb;
    return *steep;
}

static void agrees_with_the_rule(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t ledges = 0, steeps = 0, kept = 0;
    for (uint32_t round = 0; round < 300; round++) {
        tl_nav_config config = test_nav_config(12, 15);
        config.walkable_climb = test_random_below(&random, 8);
        config.walkable_height = 1 + test_random_below(&random, 4);
        tl_nav_heightfield field = test_random_heightfield(&random, &config, 1 + round % 5);
        // Fewer bottomless columns, or all would be ledges.
        for (uint32_t i = 0; round % 2 == 0 && i < field.span_count; i++) {
            field.spans[i].min = i == 0 || field.spans[i - 1].max > field.spans[i].min ? 0 : field.spans[i].min;
        }
        tl_nav_span before[1000];
        memcpy(before, field.spans, field.span_count * sizeof *before);
        tl_nav_filter_ledge_spans(&config, &field);
        for (uint32_t z = 0; z < 15; z++) {
            for (uint32_t x = 0; x < 12; x++) {
                for (uint32_t i = field.first_span[z * 12 + x]; i < field.first_span[z * 12 + x + 1]; i++) {
                    bool steep;
                    bool ledge = naive_ledge(&config, &field, x, z, i, &steep);
                    TEST_CHECK(field.spans[i].area == (ledge ? 0 : before[i].area));
                    ledges += ledge;
                    steeps += steep;
                    kept += !ledge && before[i].area != 0;
                }
            }
        }
        tl_nav_heightfield_free(&field);
    }
    TEST_CHECK(ledges > 1000 && steeps > 100 && kept > 300);
}

// A floor at the given heights along x, three columns deep; returns which of the middle row stay walkable.
static uint32_t walkable_along(const uint16_t *heights, uint32_t count, uint32_t climb)
{
    tl_nav_config config = test_nav_config(count, 3);
    config.walkable_climb = climb;
    tl_nav_span spans[48];
    uint32_t first[49];
    for (uint32_t c = 0; c < 3 * count; c++) {
        first[c] = c;
        spans[c] = (tl_nav_span){ 0, heights[c % count], 63, 0 };
    }
    first[3 * count] = 3 * count;
    tl_nav_heightfield field;
    memset(&field, 0, sizeof field);
    field.width = count;
    field.height = 3;
    field.first_span = first;
    field.spans = spans;
    field.span_count = 3 * count;
    tl_nav_filter_ledge_spans(&config, &field);
    uint32_t mask = 0;
    for (uint32_t x = 0; x < count; x++) {
        mask |= (uint32_t)(spans[count + x].area != 0) << x;
        TEST_CHECK(spans[x].area == 0 && spans[2 * count + x].area == 0); // the rim
    }
    return mask;
}

static void drops_and_stairs(void **state)
{
    (void)state;
    // Bits from x = 0. A drop of more than the climb takes the edge above it, not the floor below.
    TEST_CHECK(walkable_along((const uint16_t[]){ 9, 9, 9, 5, 5, 5 }, 6, 3) == 0x1a);
    TEST_CHECK(walkable_along((const uint16_t[]){ 9, 9, 9, 5, 5, 5 }, 6, 4) == 0x1e);
    // Steps that fit the climb alone, but not two in a row.
    TEST_CHECK(walkable_along((const uint16_t[]){ 1, 3, 5, 7, 9, 11 }, 6, 3) == 0);
    TEST_CHECK(walkable_along((const uint16_t[]){ 1, 3, 5, 7, 9, 11 }, 6, 4) == 0x1e);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(agrees_with_the_rule), cmocka_unit_test(drops_and_stairs) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
