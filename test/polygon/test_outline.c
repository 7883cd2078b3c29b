// SPDX-License-Identifier: MIT
//
// Contours that touch and cross themselves: what becomes of them is compared with winding numbers counted cell by cell.

#include "polygon/outline/outline.h"

#include "polygon/triangulate/triangulate.h"

#include "polygon_random_shapes.h"

enum { MAX_POINTS = 4096, SIDE = 24 };

static tl_contour_vertex vertices[MAX_POINTS];

typedef struct prepared {
    tl_arena arena;
    tl_outline outline;
} prepared;

static void prepare(prepared *r, const oracle_point *p, uint32_t n)
{
    tl_contour contour;
    shape_as_set(p, n, vertices, &contour);
    tl_arena_init(&r->arena, NULL);
    TEST_RESULT(tl_outline_prepare(&r->arena, vertices, n, 2, &r->outline), TL_OK);
}

static int64_t covered_area2(const prepared *r)
{
    int64_t sum = 0;
    for (uint32_t w = 0; w < r->outline.walk_count; w++) {
        uint32_t first = r->outline.walk_first[w], end = r->outline.walk_first[w + 1];
        for (uint32_t k = first + 1; k + 1 < end; k++) {
            const tl_lattice_point *p = r->outline.nodes.points;
            const uint32_t *c = r->outline.corners;
            sum += tl_turn(p[c[first]], p[c[k]], p[c[k + 1]]);
        }
    }
    return sum;
}

static void expect(const oracle_point *p, uint32_t n, uint32_t faults, uint32_t walks, int64_t area2)
{
    prepared r;
    prepare(&r, p, n);
    if (r.outline.faults != faults || r.outline.walk_count != walks || covered_area2(&r) != area2) {
        fail_msg("faults %x, %u walks, area %lld; expected %x, %u, %lld", (unsigned)r.outline.faults,
                 (unsigned)r.outline.walk_count, (long long)covered_area2(&r), (unsigned)faults, (unsigned)walks,
                 (long long)area2);
    }
    TEST_CHECK(r.outline.area2 == oracle_contour_area2(p, n));
    tl_arena_free(&r.arena);
}

#define EXPECT(points, faults, walks, area2)                                                                           \
    expect(points, (uint32_t)(sizeof(points) / sizeof((points)[0])), faults, walks, area2)

static void names_what_is_wrong(void **state)
{
    (void)state;
    const oracle_point square[] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 4, 0 } };
    EXPECT(square, 0, 1, 32);
    const oracle_point inverted[] = { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 } };
    EXPECT(inverted, TL_CONTOUR_FAULT_WINDING, 0, 0);
    const oracle_point two[] = { { 0, 0 }, { 0, 4 } };
    EXPECT(two, TL_CONTOUR_FAULT_EMPTY, 0, 0);
    const oracle_point flat[] = { { 0, 0 }, { 4, 4 }, { 8, 8 } };
    EXPECT(flat, TL_CONTOUR_FAULT_TOUCH | TL_CONTOUR_FAULT_SPIKE | TL_CONTOUR_FAULT_EMPTY, 0, 0);
    const oracle_point point[] = { { 3, 3 }, { 3, 3 }, { 3, 3 } };
    EXPECT(point, TL_CONTOUR_FAULT_DUPLICATE | TL_CONTOUR_FAULT_EMPTY, 0, 0);
    const oracle_point doubled[] = { { 0, 0 }, { 0, 4 }, { 0, 4 }, { 4, 4 }, { 4, 0 } };
    EXPECT(doubled, TL_CONTOUR_FAULT_DUPLICATE, 1, 32);
    const oracle_point spike_out[] = { { 0, 0 }, { 0, 4 }, { 2, 4 }, { 2, 9 }, { 2, 4 }, { 4, 4 }, { 4, 0 } };
    EXPECT(spike_out, TL_CONTOUR_FAULT_SPIKE, 1, 32);
    const oracle_point spike_in[] = { { 0, 0 }, { 0, 4 }, { 2, 4 }, { 2, 2 }, { 2, 4 }, { 4, 4 }, { 4, 0 } };
    EXPECT(spike_in, TL_CONTOUR_FAULT_SPIKE, 1, 32);
    const oracle_point fold[] = { { 0, 0 }, { 0, 4 }, { 6, 4 }, { 4, 4 }, { 4, 0 } };
    EXPECT(fold, TL_CONTOUR_FAULT_SPIKE | TL_CONTOUR_FAULT_TOUCH, 1, 32);
    const oracle_point eight[] = { { 0, 0 }, { 0, 4 }, { 8, 0 }, { 8, 4 } };
    EXPECT(eight, TL_CONTOUR_FAULT_CROSSING | TL_CONTOUR_FAULT_WINDING, 1, 16);
    // A notch whose tip touches the opposite side: two parts.
    const oracle_point touch[] = { { 0, 0 }, { 0, 4 }, { 3, 4 }, { 4, 0 }, { 5, 4 }, { 8, 4 }, { 8, 0 } };
    EXPECT(touch, TL_CONTOUR_FAULT_TOUCH | TL_CONTOUR_FAULT_PINCH, 2, 56);
    const oracle_point pinch[] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 8, 8 }, { 8, 4 }, { 4, 4 }, { 4, 0 } };
    EXPECT(pinch, TL_CONTOUR_FAULT_PINCH, 2, 48);
    // Around twice: covered once.
    const oracle_point twice[] = { { 0, 0 }, { 0, 4 }, { 4, 4 }, { 4, 0 }, { 0, 0 }, { 0, 4 }, { 4, 4 }, { 4, 0 } };
    EXPECT(twice, TL_CONTOUR_FAULT_WINDING, 1, 32);
}

static void walks_bridged_contours_as_they_came(void **state)
{
    (void)state;
    oracle_point p[MAX_POINTS];
    uint32_t n = shape_holes(p, 5, 4);
    prepared r;
    prepare(&r, p, n);
    TEST_CHECK(r.outline.faults == 0 && !r.outline.is_plain && r.outline.walk_count == 1);
    TEST_CHECK(r.outline.walk_first[1] == n);
    for (uint32_t i = 0; i < n; i++) {
        tl_lattice_point q = r.outline.nodes.points[r.outline.corners[i]];
        TEST_CHECK(q.x == p[i].x && q.z == p[i].z);
    }
    tl_arena_free(&r.arena);
}

// Contours with bridges are triangulated from the sweep that found nothing wrong with them: as without it.
static void hands_its_sweep_on(void **state)
{
    (void)state;
    test_random random = { 7 };
    for (uint32_t rows = 3; rows <= 20; rows++) {
        oracle_point p[MAX_POINTS];
        const uint32_t n = shape_random_holes(&random, p, 23 - rows, rows);
        prepared r;
        prepare(&r, p, n);
        TEST_CHECK(r.outline.faults == 0 && r.outline.sweep.place_of != NULL);
        TEST_CHECK(r.outline.sweep.place_count == r.outline.nodes.count);
        tl_lattice_point points[MAX_POINTS];
        for (uint32_t i = 0; i < n; i++) {
            points[i] = r.outline.nodes.points[r.outline.corners[i]];
        }
        uint32_t triangles[2][3 * MAX_POINTS], twins[2][3 * MAX_POINTS];
        for (uint32_t k = 0; k < 2; k++) {
            const tl_outline_sweep *sweep = k == 0 ? &r.outline.sweep : NULL;
            const tl_triangulate_input input = { points, n, sweep, NULL, TL_EARS_BY_MESH, NULL };
            TEST_RESULT(tl_triangulate(&r.arena, &input, triangles[k], twins[k]), TL_OK);
        }
        TEST_CHECK(memcmp(triangles[0], triangles[1], 3 * (n - 2) * sizeof **triangles) == 0);
        TEST_CHECK(memcmp(twins[0], twins[1], 3 * (n - 2) * sizeof **twins) == 0);
        tl_arena_free(&r.arena);
    }
}

// A spike is left out of the walk: of that the contour's sweep says nothing.
static void keeps_no_sweep_of_another_walk(void **state)
{
    (void)state;
    oracle_point p[MAX_POINTS];
    const uint32_t n = shape_holes(p, 8, 8);
    p[n] = p[n - 1];
    p[n + 1] = p[n - 1];
    p[n].x -= 7; // a spike
    prepared r;
    prepare(&r, p, n + 2);
    TEST_CHECK((r.outline.faults & TL_CONTOUR_FAULT_SPIKE) != 0 && r.outline.sweep.place_count == 0);
    tl_arena_free(&r.arena);
}

// Doubled area of the cells around which a closed rectilinear walk winds at least once.
static int64_t winding_area2(const oracle_point *p, uint32_t n, bool *odd)
{
    int64_t cells = 0;
    for (int64_t z = 0; z < SIDE; z++) {
        for (int64_t x = 0; x < SIDE; x++) {
            // A ray from the cell's middle towards +x.
            int winding = 0;
            for (uint32_t i = 0; i < n; i++) {
                oracle_point a = p[i], b = p[(i + 1) % n];
                if (a.x == b.x && a.x > x) {
                    winding += (b.z <= z && z < a.z) - (a.z <= z && z < b.z);
                }
            }
            cells += winding > 0;
            *odd |= winding < 0 || winding > 1;
        }
    }
    return 2 * cells;
}

static void covers_what_is_wound_around(void **state)
{
    (void)state;
    test_random random = { 21 };
    uint32_t crossing = 0, touching = 0, winding = 0, pinching = 0, spiking = 0, clean = 0;
    for (uint32_t round = 0; round < 4000; round++) {
        oracle_point p[64];
        uint32_t half = 2 + test_random_below(&random, round % 8 == 0 ? 20 : 6);
        int64_t x = test_random_below(&random, SIDE), z = test_random_below(&random, SIDE), x0 = x;
        for (uint32_t i = 0; i < half; i++) {
            p[2 * i].x = x;
            p[2 * i].z = z;
            z = test_random_below(&random, SIDE);
            p[2 * i + 1].x = x;
            p[2 * i + 1].z = i + 1 < half ? z : p[0].z;
            x = i + 1 < half ? (int64_t)test_random_below(&random, SIDE) : x0;
        }
        prepared r;
        prepare(&r, p, 2 * half);
        bool odd = false;
        TEST_CHECK(covered_area2(&r) == winding_area2(p, 2 * half, &odd));
        TEST_CHECK(odd == ((r.outline.faults & TL_CONTOUR_FAULT_WINDING) != 0));
        TEST_CHECK(r.outline.is_plain == oracle_is_simple(p, 2 * half) || oracle_contour_area2(p, 2 * half) < 0);
        crossing += (r.outline.faults & TL_CONTOUR_FAULT_CROSSING) != 0;
        touching += (r.outline.faults & TL_CONTOUR_FAULT_TOUCH) != 0;
        winding += odd;
        pinching += (r.outline.faults & TL_CONTOUR_FAULT_PINCH) != 0;
        spiking += (r.outline.faults & TL_CONTOUR_FAULT_SPIKE) != 0;
        clean += r.outline.faults == 0;
        tl_arena_free(&r.arena);
    }
    TEST_CHECK(crossing > 1000 && touching > 1000 && winding > 1000 && pinching > 300 && spiking > 100 && clean > 100);
}

static void refuses_a_scribble_beyond_measure(void **state)
{
    (void)state;
    // Chords of a circle, each of which crosses nearly half of the others.
    enum { CHORDS = 2501 };
    oracle_point p[CHORDS];
    for (uint32_t i = 0; i < CHORDS; i++) {
        double angle = 6.283185307179586 * (double)(i * 1250u % CHORDS) / CHORDS;
        p[i].x = (int64_t)floor(1e8 * cos(angle) + 0.5);
        p[i].z = (int64_t)floor(1e8 * sin(angle) + 0.5);
    }
    expect(p, CHORDS, TL_CONTOUR_FAULT_CROSSING | TL_CONTOUR_FAULT_REFUSED, 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_what_is_wrong),         cmocka_unit_test(walks_bridged_contours_as_they_came),
        cmocka_unit_test(hands_its_sweep_on),          cmocka_unit_test(keeps_no_sweep_of_another_walk),
        cmocka_unit_test(covers_what_is_wound_around), cmocka_unit_test(refuses_a_scribble_beyond_measure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
