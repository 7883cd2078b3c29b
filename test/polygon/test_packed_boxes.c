// SPDX-License-Identifier: MIT
//
// The packed tree of boxes against a look at every box, with points, thin and large boxes, many at one place, and
// coordinates at the ends of their range; and that a walk looks at few of many.

#include "polygon/outline/packed_boxes.h"
#include "talus_test.h"

#include <talus/polygon.h>

#include <string.h>

enum { MOST = 3000 };

// Whether the closed segment meets the closed box: some corners on each side of its line, exactly.
static bool meets(tl_lattice_point a, tl_lattice_point b, const tl_lattice_box *box)
{
    if ((a.x < box->low.x && b.x < box->low.x) || (a.x > box->high.x && b.x > box->high.x) ||
        (a.z < box->low.z && b.z < box->low.z) || (a.z > box->high.z && b.z > box->high.z)) {
        return false;
    }
    const tl_lattice_point corners[4] = {
        box->low, box->high, { box->low.x, box->high.z }, { box->high.x, box->low.z }
    };
    bool left = false, right = false;
    for (int i = 0; i < 4; i++) {
        const int64_t turn = tl_turn(a, b, corners[i]);
        left = left || turn >= 0;
        right = right || turn <= 0;
    }
    return left && right;
}

static tl_lattice_point random_lattice_point(test_random *random, uint32_t size)
{
    const tl_lattice_point p = { (int32_t)test_random_below(random, 2 * size) - (int32_t)size,
                                 (int32_t)test_random_below(random, 2 * size) - (int32_t)size };
    return p;
}

static void it_finds_what_a_scan_finds(void **state)
{
    static tl_lattice_box boxes[MOST];
    static uint8_t found[MOST];
    static const uint32_t counts[] = { 1, 2, 8, 9, 64, 65, 1000, MOST };
    static const uint32_t sizes[] = { 4, 1000, (uint32_t)TL_MAX_CONTOUR_COORDINATE };
    test_random random = { 11 };
    uint64_t met = 0, passed = 0, listed = 0, looked = 0;
    (void)state;
    for (uint32_t run = 0; run < 24; run++) {
        const uint32_t count = counts[run % 8], size = sizes[run / 8];
        tl_arena arena;
        tl_packed_boxes tree;
        tl_arena_init(&arena, NULL);
        for (uint32_t i = 0; i < count; i++) {
            const tl_lattice_point p = random_lattice_point(&random, size);
            tl_lattice_point q = i % 3 == 0 ? p : random_lattice_point(&random, size);
            q.x = i % 3 == 1 ? p.x + (q.x - p.x) / 64 : q.x;
            q.z = i % 3 == 1 ? p.z + (q.z - p.z) / 64 : q.z;
            boxes[i].low.x = p.x < q.x ? p.x : q.x;
            boxes[i].low.z = p.z < q.z ? p.z : q.z;
            boxes[i].high.x = p.x < q.x ? q.x : p.x;
            boxes[i].high.z = p.z < q.z ? q.z : p.z;
        }
        TEST_CHECK(tl_packed_boxes_build(&tree, &arena, boxes, count));
        for (uint32_t k = 0; k < 50; k++) {
            const tl_lattice_point a = random_lattice_point(&random, size), b = random_lattice_point(&random, size);
            tl_packed_boxes_walk walk;
            uint32_t item;
            memset(found, 0, sizeof found);
            tl_packed_boxes_begin(&walk, &tree, a, b, 0);
            while (tl_packed_boxes_next(&walk, &item)) {
                TEST_CHECK(item < count && found[item] == 0);
                found[item] = 1;
                listed += size > 4;
            }
            for (uint32_t i = 0; i < count; i++) {
                const bool meets_it = meets(a, b, &boxes[i]);
                TEST_CHECK(!meets_it || found[i] != 0); // the tree may list one that the line passes by a unit
                met += meets_it && size > 4;
                passed += !meets_it && found[i] == 0;
                looked += size > 4;
            }
        }
        tl_arena_free(&arena);
    }
    TEST_CHECK(met > 10000 && passed > 10000);
    TEST_CHECK(listed >= met && listed < met + looked / 100);
}

static void a_margin_makes_boxes_larger(void **state)
{
    const tl_lattice_box point = { { 10, 10 }, { 10, 10 } };
    const tl_lattice_point a = { 0, 11 }, b = { 20, 11 };
    tl_arena arena;
    tl_packed_boxes tree;
    tl_packed_boxes_walk walk;
    uint32_t item = 7;
    (void)state;
    tl_arena_init(&arena, NULL);
    TEST_CHECK(tl_packed_boxes_build(&tree, &arena, &point, 1));
    tl_packed_boxes_begin(&walk, &tree, a, b, 0);
    TEST_CHECK(!tl_packed_boxes_next(&walk, &item));
    tl_packed_boxes_begin(&walk, &tree, a, b, 1);
    TEST_CHECK(tl_packed_boxes_next(&walk, &item) && item == 0);
    TEST_CHECK(!tl_packed_boxes_next(&walk, &item));
    tl_arena_free(&arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_finds_what_a_scan_finds),
        cmocka_unit_test(a_margin_makes_boxes_larger),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
