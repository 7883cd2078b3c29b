// SPDX-License-Identifier: MIT

#include "polygon/outline/sweep.h"

#include "polygon_shapes.h"

enum { MAX_POINTS = 200, MAX_SEGMENTS = 200 };

static bool brute_apart(const tl_lattice_point *points, const tl_lattice_segment *segments, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = i + 1; j < count; j++) {
            oracle_point p[4];
            const uint32_t ends[4] = { segments[i].a, segments[i].b, segments[j].a, segments[j].b };
            for (uint32_t k = 0; k < 4; k++) {
                p[k].x = points[ends[k]].x;
                p[k].z = points[ends[k]].z;
            }
            bool shares = ends[0] == ends[2] || ends[0] == ends[3] || ends[1] == ends[2] || ends[1] == ends[3];
            if (!shares && oracle_segments_meet(p[0], p[1], p[2], p[3])) {
                return false;
            }
            for (uint32_t k = 0; shares && k < 4; k++) {
                uint32_t other = k < 2 ? 2 : 0;
                if (ends[k] != ends[other] && ends[k] != ends[other + 1] &&
                    oracle_between(p[other], p[other + 1], p[k])) {
                    return false;
                }
            }
        }
    }
    return true;
}

// Different points and different segments, few enough that a good part of the sets has no contact.
static uint32_t random_segments(test_random *random, uint32_t side, tl_lattice_point *points, uint32_t *point_count,
                                tl_lattice_segment *segments, uint32_t wanted, uint32_t reach)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < *point_count; i++) {
        points[i].x = (int32_t)test_random_below(random, side) - (int32_t)(side / 2);
        points[i].z = (int32_t)test_random_below(random, side) - (int32_t)(side / 2);
        for (uint32_t j = 0; j < i; j++) {
            if (tl_same_point(points[i], points[j])) {
                i--;
                *point_count -= 1;
                break;
            }
        }
    }
    for (uint32_t i = 0; i < 20 * wanted && count<wanted && * point_count> 1; i++) {
        uint32_t a = test_random_below(random, *point_count), b = test_random_below(random, *point_count);
        bool is_new = a != b && (reach == 0 || tl_distance2(points[a], points[b]) <= (int64_t)reach * reach);
        for (uint32_t k = 0; k < count; k++) {
            is_new =
                is_new && !(segments[k].a == a && segments[k].b == b) && !(segments[k].a == b && segments[k].b == a);
        }
        if (is_new) {
            segments[count].a = a;
            segments[count++].b = b;
        }
    }
    return count;
}

// The segment that crosses the line just before a point, in the sweep's order, next below it; by rational heights.
static uint32_t brute_below(const tl_lattice_point *points, const tl_lattice_segment *segments, uint32_t count,
                            uint32_t point)
{
    uint32_t next = TL_NO_SEGMENT;
    tl_lattice_segment best = { 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        const bool forward = tl_is_swept_first(points[segments[i].a], points[segments[i].b]);
        const tl_lattice_segment e = { forward ? segments[i].a : segments[i].b,
                                       forward ? segments[i].b : segments[i].a };
        if (!tl_is_swept_first(points[e.a], points[point]) || !tl_is_swept_first(points[point], points[e.b]) ||
            tl_turn(points[e.a], points[e.b], points[point]) < 0) {
            continue;
        }
        // Both are below the point and apart: the one that begins later lies on one side of the other.
        const bool later = next == TL_NO_SEGMENT || !tl_is_swept_first(points[best.a], points[e.a]);
        int64_t side = 1;
        if (next != TL_NO_SEGMENT && best.a == e.a) {
            side = tl_turn(points[best.a], points[best.b], points[e.b]);
        } else if (next != TL_NO_SEGMENT) {
            side = later ? -tl_turn(points[e.a], points[e.b], points[best.a])
                         : tl_turn(points[best.a], points[best.b], points[e.a]);
        }
        if (side > 0) {
            next = i;
            best = e;
        }
    }
    return next;
}

static uint32_t check_record(const tl_sweep_record *record, const tl_lattice_point *points, uint32_t point_count,
                             const tl_lattice_segment *segments, uint32_t count)
{
    uint32_t located = 0;
    for (uint32_t i = 0; i < point_count; i++) {
        const uint32_t p = record->order[i];
        TEST_CHECK(i == 0 || tl_is_swept_first(points[record->order[i - 1]], points[p]));
        bool begins = false, ends = false;
        for (uint32_t k = 0; k < count; k++) {
            if (segments[k].a == p || segments[k].b == p) {
                const uint32_t other = segments[k].a == p ? segments[k].b : segments[k].a;
                begins = begins || tl_is_swept_first(points[p], points[other]);
                ends = ends || tl_is_swept_first(points[other], points[p]);
            }
        }
        if (begins || ends) {
            TEST_CHECK(record->below[i] == brute_below(points, segments, count, p));
            located += record->below[i] != TL_NO_SEGMENT;
        }
    }
    return located;
}

static void finds_any_contact(void **state)
{
    (void)state;
    test_random random = { 41 };
    uint32_t apart = 0, touching = 0, large = 0, located = 0;
    for (uint32_t round = 0; round < 20000; round++) {
        tl_lattice_point points[MAX_POINTS];
        tl_lattice_segment segments[MAX_SEGMENTS];
        bool is_large = round % 40 == 0;
        uint32_t side = is_large ? 200 : 3u << test_random_below(&random, 6);
        uint32_t point_count = 2 + test_random_below(&random, is_large ? 100 : 9);
        uint32_t count = random_segments(&random, side, points, &point_count, segments,
                                         1 + test_random_below(&random, is_large ? 60 : 8), is_large ? 20 : 0);
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        bool result = false;
        tl_sweep_record record;
        TEST_CHECK(tl_sweep_record_init(&record, &arena, point_count));
        TEST_RESULT(tl_sweep_segments(&arena, points, point_count, segments, count, &record, &result), TL_OK);
        TEST_CHECK(result == brute_apart(points, segments, count));
        apart += result && count > 2;
        touching += !result;
        large += result && count > 15;
        located += result ? check_record(&record, points, point_count, segments, count) : 0;
        tl_arena_free(&arena);
    }
    TEST_CHECK(apart > 2000 && touching > 5000 && large > 30 && located > 1000);
}

// Of an outline the segments need not be listed.
static void an_outline_is_swept_as_its_segments_are(void **state)
{
    (void)state;
    test_random random = { 42 };
    uint32_t apart_count = 0;
    for (uint32_t round = 0; round < 4000; round++) {
        oracle_point corners[MAX_POINTS];
        const uint32_t n = 3 + test_random_below(&random, round % 4 == 0 ? 60 : 8);
        (void)shape_untangled(&random, corners, n, 8u << test_random_below(&random, 8));
        tl_lattice_point points[MAX_POINTS];
        tl_lattice_segment segments[MAX_SEGMENTS];
        for (uint32_t i = 0; i < n; i++) {
            points[i].x = (int32_t)corners[i].x;
            points[i].z = (int32_t)corners[i].z;
            segments[i].a = i;
            segments[i].b = (i + 1) % n;
        }
        tl_arena arena;
        tl_arena_init(&arena, NULL);
        tl_sweep_record records[2];
        bool apart[2] = { false, true };
        for (uint32_t k = 0; k < 2; k++) {
            TEST_CHECK(tl_sweep_record_init(&records[k], &arena, n));
            TEST_RESULT(tl_sweep_segments(&arena, points, n, k == 0 ? segments : NULL, n, &records[k], &apart[k]),
                        TL_OK);
        }
        TEST_CHECK(apart[0] == apart[1]);
        if (apart[0]) {
            TEST_CHECK(memcmp(records[0].order, records[1].order, n * sizeof *records[0].order) == 0);
            TEST_CHECK(memcmp(records[0].below, records[1].below, n * sizeof *records[0].below) == 0);
            apart_count++;
        }
        tl_arena_free(&arena);
    }
    TEST_CHECK(apart_count > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_any_contact),
        cmocka_unit_test(an_outline_is_swept_as_its_segments_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
