// SPDX-License-Identifier: MIT
//
// The floors of any rectangle of a tile's columns are those of the whole tile, wherever its runs begin and end; marks
// within it are told to be the same, or not, as a look at each floor does; every allocation may fail.

#include "nav_obstacles/floor_window.h"

#include "base/arena.h"
#include "talus_test.h"

#include <string.h>

enum { SIDE = 40, COLUMNS = SIDE * SIDE, STOREYS = 5, FLOORS = STOREYS * COLUMNS };

// A tile of random floors, in runs of columns that are alike and of others.
typedef struct tile {
    tl_nav_compact compact;
    uint32_t first_span[COLUMNS + 1];
    uint16_t floor[FLOORS];
    uint8_t area[FLOORS];
    int16_t step[4 * FLOORS];
} tile;

static void make_tile(tile *t, test_random *random)
{
    memset(t, 0, sizeof *t);
    tl_nav_compact *compact = &t->compact;
    compact->width = 1 + test_random_below(random, SIDE);
    compact->height = 1 + test_random_below(random, SIDE);
    compact->cell_size = 0.3f;
    compact->cell_height = 0.2f;
    compact->lattice.first_x = (int32_t)test_random_below(random, 1000) - 500;
    compact->lattice.first_z = (int32_t)test_random_below(random, 1000) - 500;
    compact->first_span = t->first_span;
    compact->floor = t->floor;
    compact->area = t->area;
    compact->step = t->step;
    const uint32_t columns = compact->width * compact->height;
    uint32_t count = 0, left = 0, storeys = 0, level = 0;
    for (uint32_t c = 0; c < columns; c++, left--) {
        if (left == 0) {
            left = 1 + test_random_below(random, test_random_below(random, 2) == 0 ? 3 : 400);
            storeys = test_random_below(random, STOREYS + 1);
            level = test_random_below(random, 3);
        }
        for (uint32_t k = 0; k < storeys; k++) {
            t->floor[count] = (uint16_t)(30 * k + level + (level == 2 ? test_random_below(random, 9) : 0));
            t->area[count++] = (uint8_t)(63 * (1 - (level == 1 && test_random_below(random, 2) == 0)));
        }
        t->first_span[c + 1] = count;
    }
    compact->span_count = count;
}

static tl_obstacle_window random_columns(const tl_nav_compact *compact, test_random *random)
{
    tl_obstacle_window w;
    w.first_x = test_random_below(random, compact->width + 1);
    w.first_z = test_random_below(random, compact->height + 1);
    w.end_x = w.first_x + test_random_below(random, compact->width + 1 - w.first_x);
    w.end_z = w.first_z + test_random_below(random, compact->height + 1 - w.first_z);
    if (test_random_below(random, 10) == 0) {
        w = (tl_obstacle_window){ 0, compact->width, 0, compact->height };
    }
    return w;
}

static void check_floors(const tile *t, const tl_floor_window *window, tl_obstacle_window columns)
{
    const tl_nav_compact *all = &t->compact, *part = &window->compact;
    TEST_CHECK(part->width == columns.end_x - columns.first_x && part->height == columns.end_z - columns.first_z);
    TEST_CHECK(part->lattice.first_x == all->lattice.first_x + (int32_t)columns.first_x);
    TEST_CHECK(part->lattice.first_z == all->lattice.first_z + (int32_t)columns.first_z);
    for (uint32_t z = 0; z < part->height; z++) {
        for (uint32_t x = 0; x < part->width; x++) {
            const uint32_t column = (columns.first_z + z) * all->width + columns.first_x + x;
            const uint32_t own = part->first_span[z * part->width + x], first = all->first_span[column];
            const uint32_t count = all->first_span[column + 1] - first;
            TEST_CHECK(part->first_span[z * part->width + x + 1] - own == count);
            TEST_CHECK(x > 0 || window->row_floor[z] == first);
            TEST_CHECK(memcmp(part->floor + own, all->floor + first, count * sizeof *all->floor) == 0);
            TEST_CHECK(memcmp(part->area + own, all->area + first, count) == 0);
            TEST_CHECK(memcmp(window->base_area + own, all->area + first, count) == 0);
        }
    }
}

// Marks floors within the window, and as many elsewhere as the tile's own marks say.
static void check_marks(const tile *t, tl_floor_window *window, test_random *random, uint32_t held[2])
{
    const uint32_t count = t->compact.span_count;
    static uint8_t before[FLOORS], after[FLOORS];
    tl_tile_marks marks;
    memcpy(before, t->area, count);
    for (uint32_t i = 0; i < count && test_random_below(random, 4) > 0; i += test_random_below(random, 60)) {
        before[i] = (uint8_t)test_random_below(random, 2);
    }
    TEST_RESULT(tl_tile_marks_find(t->area, before, count, NULL, &marks), TL_OK);
    memcpy(after, t->area, count);
    tl_floor_window_paste(window, after); // as it was read
    TEST_CHECK(memcmp(after, t->area, count) == 0);
    const tl_nav_compact *part = &window->compact;
    for (uint32_t z = 0; z < part->height; z++) {
        const uint32_t *row = part->first_span + (size_t)z * part->width;
        memcpy(part->area + row[0], before + window->row_floor[z], row[part->width] - row[0]);
    }
    if (part->span_count > 0 && test_random_below(random, 2) == 0) {
        part->area[test_random_below(random, part->span_count)] = 7;
    }
    memcpy(after, before, count);
    tl_floor_window_paste(window, after);
    const bool same = memcmp(before, after, count) == 0;
    TEST_CHECK(tl_floor_window_holds(window, &marks) == same);
    held[same]++;
    tl_tile_marks_free(&marks, NULL);
}

static void windows_are_parts(void **state)
{
    (void)state;
    const tl_allocator allocator = tl_allocator_or_default(NULL);
    test_random random = { 11 };
    static tile t;
    tl_floor_window window = { 0 };
    uint32_t held[2] = { 0, 0 }, empty = 0, floors = 0;
    for (uint32_t round = 0; round < 500; round++) {
        make_tile(&t, &random);
        tl_packed_floors packed;
        TEST_RESULT(tl_floors_pack(&t.compact, &allocator, &packed), TL_OK);
        for (uint32_t k = 0; k < 10 && t.compact.span_count > 0; k++) {
            const tl_obstacle_window columns = random_columns(&t.compact, &random);
            TEST_RESULT(tl_floor_window_read(&window, &packed, columns, &allocator), TL_OK);
            if (tl_obstacle_window_is_empty(&columns)) {
                TEST_CHECK(window.compact.span_count == 0 && window.compact.height == 0);
                empty++;
                continue;
            }
            check_floors(&t, &window, columns);
            check_marks(&t, &window, &random, held);
            floors += window.compact.span_count;
        }
        tl_packed_floors_free(&packed);
    }
    TEST_CHECK(held[0] > 500 && held[1] > 500 && empty > 50 && floors > 100000);
    TEST_CHECK(tl_floor_window_bytes(&window) > 0);
    tl_floor_window_free(&window, &allocator);
    TEST_CHECK(tl_floor_window_bytes(&window) == 0);
}

static void failing_memory_is_reported(void **state)
{
    (void)state;
    test_random random = { 2 };
    static tile t;
    make_tile(&t, &random);
    TEST_CHECK(t.compact.span_count > 0);
    const tl_allocator allocator = tl_allocator_or_default(NULL);
    const tl_obstacle_window whole = { 0, t.compact.width, 0, t.compact.height };
    tl_packed_floors packed;
    TEST_RESULT(tl_floors_pack(&t.compact, &allocator, &packed), TL_OK);
    for (uint64_t k = 1; k <= 3; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_floor_window window = { 0 };
        const tl_result result = tl_floor_window_read(&window, &packed, whole, &memory.allocator);
        TEST_RESULT(result, k <= 2 ? TL_ERR_MEMORY : TL_OK);
        TEST_CHECK((window.compact.span_count == 0) == (k <= 2));
        tl_floor_window_free(&window, &memory.allocator);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    tl_packed_floors_free(&packed);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(windows_are_parts),
                                        cmocka_unit_test(failing_memory_is_reported) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
