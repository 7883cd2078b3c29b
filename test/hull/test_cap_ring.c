// SPDX-License-Identifier: MIT
//
// Caps of many small faces that lie nearly in one plane: that climbs begin beside their end, counted in steps, that
// answers are those of a scan in every instruction set, and that what is no cap has no ring.

#include "talus_test.h"

#include "hull/support/cap_ring.h"
#include "hull/support/direction_table.h"
#include "hull_climb.h"
#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/hull.h>

enum { MAX_SIDES = 512, MAX_POINTS = 2 * MAX_SIDES + 1 };

typedef enum cap_kind {
    CAP_ROUNDED, ///< a prism, whose caps only rounding makes other than flat
    CAP_ROUGH,   ///< a prism with a cap that is off by a hundred-thousandth
    CAP_OVAL,    ///< a prism four times as wide as thick
    CAP_DOME,    ///< a thousandth high
    CAP_CONE,    ///< a hundredth high
    CAP_KINDS
} cap_kind;

// Turned by a rotation that keeps no axis.
static tl_vec3 turned(double along, double u, double v)
{
    return tl_vec3_make((float)(0.36 * along + 0.48 * u - 0.8 * v), (float)(-0.8 * along + 0.6 * u),
                        (float)(0.48 * along + 0.64 * u + 0.6 * v));
}

static uint32_t make_points(cap_kind kind, uint32_t sides, test_random *random, tl_vec3 *points)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < sides; i++) {
        const double angle = 6.283185307179586 * (double)i / (double)sides;
        const double width = kind == CAP_OVAL ? 4.0 : 1.0, u = width * cos(angle), v = sin(angle);
        const double rough = kind == CAP_ROUGH ? 1e-5 * (double)test_random_range(random, -1.0f, 1.0f) : 0.0;
        const double out = kind == CAP_DOME ? sqrt((double)test_random_range(random, 0.0f, 1.0f)) : 1.0;
        const double high = kind == CAP_DOME ? 1e-3 * (1.0 - out * out) : 0.0;
        points[count++] = turned(0.5 + rough + high, out * u, out * v);
        points[count++] = turned(-0.5, u, v);
    }
    if (kind == CAP_CONE) {
        points[count++] = turned(0.51, 0.0, 0.0);
    }
    return count;
}

static tl_hull *build_cap(cap_kind kind, uint32_t sides)
{
    static tl_vec3 points[MAX_POINTS];
    test_random random = { (uint64_t)kind + 1 };
    const uint32_t count = make_points(kind, sides, &random, points);
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
    return hull;
}

// A direction off the axis of the cap by so much.
static tl_vec3 direction_off(test_random *random, double off)
{
    const double angle = (double)test_random_range(random, 0.0f, 6.2831853f);
    return turned(1.0, off * cos(angle), off * sin(angle));
}

// Without rings: 2 to 6 steps on the mean at prisms, 12 at the dome; and up to 18 at the worst.
static void test_climbs_begin_near_their_end(void **state)
{
    (void)state;
    enum { QUERIES = 200 };
    static const char *const names[CAP_KINDS] = { "rounded", "rough", "oval", "dome", "cone" };
    test_random random = { 11 };
    for (int kind = 0; kind < CAP_KINDS; kind++) {
        double most_mean = 0.0;
        uint32_t most = 0;
        for (uint32_t sides = 64; sides <= MAX_SIDES; sides *= 2) {
            tl_hull *hull = build_cap((cap_kind)kind, sides);
            for (double off = 1e-9; off < 0.2; off *= 10.0) {
                uint32_t sum = 0;
                for (int i = 0; i < QUERIES; i++) {
                    const uint32_t steps = hull_climb_steps(hull, direction_off(&random, off));
                    sum += steps;
                    most = steps > most ? steps : most;
                }
                most_mean = fmax(most_mean, (double)sum / QUERIES);
            }
            tl_blob_free(hull);
        }
        print_message("%-8s %.2f steps on the mean at most, %u at the worst\n", names[kind], most_mean, most);
        TEST_CHECK(most_mean <= (kind == CAP_DOME ? 3.5 : 2.0) && most <= 8);
    }
}

static uint32_t scan_all(const tl_hull *hull, tl_vec3 d)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    uint32_t best = 0;
    for (uint32_t v = 1; v < hull->vertex_count; v++) {
        best = tl_compare_along(d, vertices[v], vertices[best]) > 0 ? v : best;
    }
    return best;
}

static void test_answers_are_those_of_a_scan(void **state)
{
    (void)state;
    test_random random = { 12 };
    for (int kind = 0; kind < CAP_KINDS; kind++) {
        tl_hull *hull = build_cap((cap_kind)kind, 256);
        for (int i = 0; i < 1000; i++) {
            const tl_hull_plane plane = tl_hull_face_plane(hull, (uint32_t)i % hull->face_count);
            const tl_vec3 normal = tl_vec3_make((float)plane.normal[0], (float)plane.normal[1], (float)plane.normal[2]);
            const tl_vec3 d = i % 4 == 0 ? normal : direction_off(&random, pow(10.0, -(double)(i % 10)));
            const uint32_t expected = scan_all(hull, d), hint = i % 3 == 0 ? (uint32_t)i % 7 : TL_NO_VERTEX;
            for (uint32_t isa = 0; isa < TL_SUPPORT_ISA_COUNT; isa++) {
                tl_support_kernel kernel;
                if (tl_support_kernel_for((tl_support_isa)isa, &kernel)) {
                    TEST_CHECK(kernel.support(hull, d.x, d.y, d.z, hint) == expected);
                }
            }
        }
        tl_blob_free(hull);
    }
}

// Level after level, from the outermost inward, without a gap or an overlap.
static void test_levels_lie_side_by_side(void **state)
{
    (void)state;
    for (uint32_t cells = TL_CAP_LEAST_CELLS; cells <= 1u << 20; cells *= 2) {
        uint32_t before = 0;
        for (uint32_t level = 0; level < TL_CAP_LEVELS; level++) {
            TEST_CHECK(tl_cap_cells_before(cells, level) == before);
            TEST_CHECK(tl_cap_level_cells(cells, level) >= TL_CAP_LEAST_CELLS);
            before += tl_cap_level_cells(cells, level);
        }
        TEST_CHECK(tl_cap_cells(cells) == before && before <= 2 * cells + TL_CAP_LEVELS * TL_CAP_LEAST_CELLS);
    }
    TEST_CHECK(tl_cap_level(0.0f, 1.0f) == TL_CAP_LEVELS - 1 && tl_cap_level(1e30f, 1e-6f) == 0);
    for (float reach = 1e-12f; reach < 1e6f; reach *= 1.5f) {
        TEST_CHECK(tl_cap_level(reach, 1.0f) >= tl_cap_level(1.5f * reach, 1.0f));
    }
}

static void test_only_crowded_normals_are_caps(void **state)
{
    (void)state;
    static tl_vec3 points[4000];
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        test_random random = { 13 };
        shape_make((shape_kind)kind, &random, points, 4000);
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 4000, NULL, &hull, NULL), TL_OK);
        if (hull->vertex_count > TL_HULL_FEW) {
            const tl_hull_climb *climb = tl_hull_climb_head(hull);
            TEST_CHECK(kind != SHAPE_SPHERE || climb->cap_count == 0);
            TEST_CHECK(climb->ring_cells <= 8 * hull->half_edge_count);
        }
        tl_blob_free(hull);
    }
    for (int kind = 0; kind < CAP_KINDS; kind++) {
        tl_hull *hull = build_cap((cap_kind)kind, MAX_SIDES);
        TEST_CHECK(tl_hull_climb_head(hull)->cap_count == 2 && tl_hull_climb_head(hull)->ring_count == 2);
        tl_blob_free(hull);
    }
}

// What a query reads of a ring is refused where it could lead out of the table or into numbers that are none.
static void test_altered_rings_are_refused(void **state)
{
    (void)state;
    tl_hull *hull = build_cap(CAP_ROUNDED, 128);
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    tl_face_ring *ring = (tl_face_ring *)(uintptr_t)tl_hull_rings(hull);
    const tl_face_ring right = *ring;
    const uint64_t end = tl_hull_cell_count(climb);
    TEST_CHECK(tl_is_cap_ring(ring, right.first, end) && !tl_is_cap_ring(ring, right.first, right.first + 7u));
    const float wrong_axes[] = { NAN, INFINITY, -3e38f, 1e13f };
    for (int i = 0; i < 4; i++) {
        ring->v[i % 3] = wrong_axes[i];
        TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_ERR_CORRUPT);
        *ring = right;
    }
    const uint32_t cells = right.cell_count & ~TL_RING_OF_CAP;
    const uint32_t wrong_counts[] = { cells,
                                      TL_RING_OF_CAP,
                                      TL_RING_OF_CAP | 4,
                                      right.cell_count + 1,
                                      TL_RING_OF_CAP | 2 * cells,
                                      TL_RING_OF_CAP | cells / 2,
                                      0xc0000000u };
    for (int i = 0; i < 7; i++) {
        ring->cell_count = wrong_counts[i];
        TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_ERR_CORRUPT);
        *ring = right;
    }
    ring->first++;
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_ERR_CORRUPT);
    *ring = right;
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
    tl_blob_free(hull);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_climbs_begin_near_their_end), cmocka_unit_test(test_answers_are_those_of_a_scan),
        cmocka_unit_test(test_levels_lie_side_by_side),     cmocka_unit_test(test_only_crowded_normals_are_caps),
        cmocka_unit_test(test_altered_rings_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
