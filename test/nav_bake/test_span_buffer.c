// SPDX-License-Identifier: MIT
//
// The canonical union of spans, against a drawing of each column voxel by voxel.

#include "nav_bake/voxels/span_buffer.h"

#include "talus_test.h"

#include <string.h>

enum { COLUMNS = 40, VOXELS = 64 };

// The union by definition: mark voxels, so that spans that touch join, then look for the best area near each top.
static uint32_t naive_union(const tl_span_item *items, uint32_t count, uint32_t column, uint32_t climb,
                            tl_nav_span *spans)
{
    bool solid[VOXELS + 2] = { false };
    for (uint32_t i = 0; i < count; i++) {
        if (tl_span_item_column(items[i]) == column) {
            for (uint32_t y = tl_span_item_min(items[i]); y < tl_span_item_max(items[i]); y++) {
                solid[y] = true;
            }
        }
    }
    uint32_t span_count = 0;
    for (uint32_t y = 0; y <= VOXELS; y++) {
        if (!solid[y]) {
            continue;
        }
        uint32_t begin = y;
        while (solid[y]) {
            y++;
        }
        uint32_t area = 0;
        for (uint32_t i = 0; i < count; i++) {
            uint32_t top = tl_span_item_max(items[i]);
            if (tl_span_item_column(items[i]) == column && top <= y && top > begin && top + climb >= y &&
                tl_span_item_area(items[i]) > area) {
                area = tl_span_item_area(items[i]);
            }
        }
        tl_nav_span span = { (uint16_t)begin, (uint16_t)y, (uint16_t)area, 0 };
        spans[span_count++] = span;
    }
    return span_count;
}

static void add(tl_span_buffer *buffer, const tl_span_item *items, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        TEST_RESULT(tl_span_buffer_reserve(buffer, 1), TL_OK);
        tl_span_buffer_add(buffer, tl_span_item_column(items[i]), tl_span_item_min(items[i]),
                           tl_span_item_max(items[i]), tl_span_item_area(items[i]));
    }
}

static void shuffle(test_random *random, tl_span_item *items, uint32_t count)
{
    for (uint32_t i = count; i > 1; i--) {
        uint32_t k = test_random_below(random, i);
        tl_span_item t = items[i - 1];
        items[i - 1] = items[k];
        items[k] = t;
    }
}

static void agrees_with_voxels(void **state)
{
    (void)state;
    test_random random = { 3 };
    static tl_span_item items[COLUMNS * 30];
    uint32_t merged_many = 0, low_area_won = 0;
    tl_span_buffer buffer = { 0 };
    uint32_t late = 0;
    for (uint32_t round = 0; round < 400; round++) {
        tl_span_buffer_free(&buffer);
        buffer.max_nodes = round % 2 == 0 ? 0 : 1 + test_random_below(&random, 40); // what finds no node comes late
        uint32_t count = test_random_below(&random, COLUMNS * 30);
        for (uint32_t i = 0; i < count; i++) {
            uint32_t min = test_random_below(&random, VOXELS - 8), max = min + 1 + test_random_below(&random, 6);
            items[i] = tl_span_item_make(test_random_below(&random, COLUMNS), min, max, test_random_below(&random, 5));
        }
        buffer.walkable_climb = test_random_below(&random, 5);
        TEST_RESULT(tl_span_buffer_begin(&buffer, COLUMNS), TL_OK);
        add(&buffer, items, count);
        late += buffer.late_count > 0;
        uint32_t first[COLUMNS + 1], at = 0;
        const tl_nav_span *spans;
        TEST_RESULT(tl_span_buffer_merge(&buffer, first, &spans), TL_OK);
        for (uint32_t c = 0; c < COLUMNS; c++) {
            tl_nav_span expected[VOXELS];
            uint32_t expected_count = naive_union(items, count, c, buffer.walkable_climb, expected);
            TEST_CHECK(first[c] == at);
            TEST_CHECK(memcmp(spans + at, expected, expected_count * sizeof *expected) == 0);
            at += expected_count;
            merged_many += expected_count > 0 && expected[0].max - expected[0].min > 12;
            low_area_won += expected_count > 0 && expected[0].area < 4;
        }
        TEST_CHECK(at == first[COLUMNS]);
    }
    TEST_CHECK(merged_many > 100 && low_area_won > 100 && late > 100);
    tl_span_buffer_free(&buffer);
}

// Piles of items that must be reduced on the way: the result is that of all at once.
static void reducing_changes_nothing(void **state)
{
    (void)state;
    test_random random = { 5 };
    enum { COUNT = 200000, FEW = 3 };
    tl_span_item *items = malloc(COUNT * sizeof *items);
    for (uint32_t i = 0; i < COUNT; i++) {
        uint32_t min = test_random_below(&random, VOXELS - 12), max = min + 1 + test_random_below(&random, 2);
        if (test_random_below(&random, 3) == 0) {
            min -= min % 8; // gaps stay open elsewhere
            max = min + 3;
        } else {
            min -= min % 16;
            max = min + 1 + test_random_below(&random, 10);
        }
        items[i] = tl_span_item_make(test_random_below(&random, FEW), min, max, test_random_below(&random, 64));
    }
    tl_nav_span expected[FEW][VOXELS];
    uint32_t expected_counts[FEW];
    for (uint32_t c = 0; c < FEW; c++) {
        expected_counts[c] = naive_union(items, COUNT, c, 4, expected[c]);
    }
    for (uint32_t round = 0; round < 3; round++) {
        tl_span_buffer buffer = { 0 };
        buffer.walkable_climb = 4;
        TEST_RESULT(tl_span_buffer_begin(&buffer, FEW), TL_OK);
        add(&buffer, items, COUNT);
        TEST_CHECK(buffer.node_capacity < 1000 && buffer.late_capacity < 10000); // it never held them all
        uint32_t first[FEW + 1];
        const tl_nav_span *spans;
        TEST_RESULT(tl_span_buffer_merge(&buffer, first, &spans), TL_OK);
        for (uint32_t c = 0; c < FEW; c++) {
            TEST_CHECK(first[c + 1] - first[c] == expected_counts[c]);
            TEST_CHECK(memcmp(spans + first[c], expected[c], expected_counts[c] * sizeof *spans) == 0);
        }
        tl_span_buffer_free(&buffer);
        shuffle(&random, items, COUNT);
    }
    free(items);
}

// A tower of many floors, more than a list is walked for: from bottom to top, from top to bottom, and in any order.
static void towers_are_sorted(void **state)
{
    (void)state;
    test_random random = { 9 };
    enum { FLOORS = 5000, LISTED = 1000 };
    tl_span_item *items = malloc(FLOORS * sizeof *items);
    for (uint32_t order = 0; order < 3; order++) {
        for (uint32_t i = 0; i < FLOORS; i++) {
            const uint32_t floor = order == 1 ? FLOORS - 1 - i : i;
            items[i] = tl_span_item_make(1, 13 * floor, 13 * floor + 1 + floor % 12, floor % 256);
        }
        if (order == 2) {
            shuffle(&random, items, FLOORS);
        }
        tl_span_buffer buffer = { 0 };
        TEST_RESULT(tl_span_buffer_begin(&buffer, 3), TL_OK);
        add(&buffer, items, FLOORS);
        TEST_CHECK(order == 1 || buffer.late_count > LISTED);
        uint32_t first[4];
        const tl_nav_span *spans;
        TEST_RESULT(tl_span_buffer_merge(&buffer, first, &spans), TL_OK);
        TEST_CHECK(first[1] == 0 && first[2] == FLOORS && first[3] == FLOORS);
        for (uint32_t floor = 0; floor < FLOORS; floor++) {
            TEST_CHECK(spans[floor].min == 13 * floor && spans[floor].max == 13 * floor + 1 + floor % 12 &&
                       spans[floor].area == floor % 256);
        }
        tl_span_buffer_free(&buffer);
    }
    free(items);
}

// The highest span ends at 0xffff, where a column without spans seems to begin.
static void the_highest_voxel_is_a_span(void **state)
{
    (void)state;
    tl_span_buffer buffer = { 0 };
    TEST_RESULT(tl_span_buffer_begin(&buffer, 1), TL_OK);
    const tl_span_item items[2] = { tl_span_item_make(0, 0xfffe, 0xffff, 7), tl_span_item_make(0, 0, 1, 0) };
    add(&buffer, items, 2);
    uint32_t first[2];
    const tl_nav_span *spans;
    TEST_RESULT(tl_span_buffer_merge(&buffer, first, &spans), TL_OK);
    TEST_CHECK(first[1] == 2 && spans[0].max == 1 && spans[1].min == 0xfffe && spans[1].max == 0xffff);
    TEST_CHECK(spans[1].area == 7);
    tl_span_buffer_free(&buffer);
}

static void failing_memory_is_reported(void **state)
{
    (void)state;
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_span_buffer buffer = { 0 };
        buffer.allocator = &memory.allocator;
        tl_result result = tl_span_buffer_begin(&buffer, 2);
        for (uint32_t i = 0; i < 1000 && result == TL_OK; i++) {
            result = tl_span_buffer_reserve(&buffer, 1);
            if (result == TL_OK) {
                tl_span_buffer_add(&buffer, i % 2, 2 * i, 2 * i + 1, 0);
            }
        }
        uint32_t first[3];
        const tl_nav_span *spans;
        result = result == TL_OK ? tl_span_buffer_merge(&buffer, first, &spans) : result;
        tl_span_buffer_free(&buffer);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 6 && first[1] == 500 && first[2] == 1000);
            return;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(agrees_with_voxels),
                                        cmocka_unit_test(reducing_changes_nothing), cmocka_unit_test(towers_are_sorted),
                                        cmocka_unit_test(the_highest_voxel_is_a_span),
                                        cmocka_unit_test(failing_memory_is_reported) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
