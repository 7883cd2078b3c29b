// SPDX-License-Identifier: MIT
//
// The nearest point of a simplex, against those of all its corners, edges and faces.

#include "talus_test.h"

#include "convex_oracle.h"

#include "convex/core/simplex.h"

#include <math.h>
#include <string.h>

static tl_vec3d random_point(test_random *random, double scale)
{
    const tl_vec3 p = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
    return tl_vec3d_scale(tl_vec3d_from(p), scale);
}

static double volume6(tl_vec3d a, tl_vec3d b, tl_vec3d c)
{
    return tl_vec3d_dot(tl_vec3d_cross(a, b), c);
}

// The origin is inside a tetrahedron when it is on the inner side of all four faces; a flat one has no inside.
static bool holds_origin(const tl_simplex *s, double scale)
{
    const tl_vec3d a = s->points[0].w, b = s->points[1].w, c = s->points[2].w, d = s->points[3].w;
    const double whole = volume6(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a), tl_vec3d_sub(d, a));
    const double parts[4] = { volume6(b, c, d), -volume6(a, c, d), volume6(a, b, d), -volume6(a, b, c) };
    bool inside = fabs(whole) > 1e-9 * scale * scale * scale;
    for (int i = 0; i < 4; i++) {
        inside = inside && (whole > 0.0 ? parts[i] >= 0.0 : parts[i] <= 0.0);
    }
    return inside;
}

static double plain_distance(const tl_simplex *s, double scale)
{
    const tl_vec3d origin = tl_vec3d_make(0, 0, 0);
    double best = (double)INFINITY;
    for (uint32_t i = 0; i < s->count; i++) {
        for (uint32_t j = i; j < s->count; j++) {
            best = fmin(best, oracle_point_segment(origin, s->points[i].w, s->points[j].w));
            for (uint32_t k = j + 1; j > i && k < s->count; k++) {
                best = fmin(best, oracle_point_triangle(origin, s->points[i].w, s->points[j].w, s->points[k].w));
            }
        }
    }
    return s->count == 4 && holds_origin(s, scale) ? 0.0 : best;
}

static void the_nearest_point_is_that_of_all_features(void **state)
{
    (void)state;
    test_random random = { 11 };
    uint32_t inside = 0, carried[5] = { 0 };
    for (int round = 0; round < 40000; round++) {
        tl_simplex s;
        memset(&s, 0, sizeof s);
        s.count = 1 + (uint32_t)round % 4;
        const tl_vec3d shift = random_point(&random, round % 3 == 0 ? 0.3 : 1.5);
        const double scale = pow(10.0, (double)((int)test_random_below(&random, 9) - 4));
        for (uint32_t i = 0; i < s.count; i++) {
            // Now and then points in line, in a plane or in one place.
            const bool repeats = i > 1 && test_random_below(&random, 12) == 0;
            tl_vec3d w = repeats ? tl_vec3d_scale(tl_vec3d_add(s.points[0].w, s.points[1].w), 0.5)
                                 : tl_vec3d_scale(tl_vec3d_add(random_point(&random, 1.0), shift), scale);
            s.points[i].w = s.points[i].a = w;
        }
        const double expected = plain_distance(&s, scale);
        tl_simplex_point nearest;
        tl_simplex_solve(&s, &nearest);
        TEST_CHECK(fabs(sqrt(nearest.distance_sq) - expected) <= 1e-6 * scale);
        TEST_CHECK(nearest.count >= 1 && nearest.count <= s.count);
        double sum = 0.0;
        tl_vec3d at = tl_vec3d_make(0, 0, 0);
        for (uint32_t i = 0; i < nearest.count; i++) {
            TEST_CHECK(nearest.weight[i] >= 0.0 && (i == 0 || nearest.index[i] > nearest.index[i - 1]));
            sum += nearest.weight[i];
            at = tl_vec3d_mul_add(at, s.points[nearest.index[i]].w, nearest.weight[i]);
        }
        TEST_CHECK(fabs(sum - 1.0) < 1e-9);
        TEST_CHECK(tl_vec3d_length(tl_vec3d_sub(at, nearest.point)) <= 1e-6 * scale);
        inside += nearest.count == 4;
        carried[nearest.count]++;
        // Cut down to what carries the point, the simplex has the same nearest point, and that is its witness on A.
        tl_simplex_keep(&s, &nearest);
        TEST_CHECK(s.count == nearest.count);
        tl_vec3d on_a, on_b;
        tl_simplex_witness(&s, &on_a, &on_b);
        TEST_CHECK(tl_vec3d_length(tl_vec3d_sub(on_a, nearest.point)) <= 1e-6 * scale &&
                   tl_vec3d_length(on_b) <= 1e-6 * scale);
    }
    TEST_CHECK(inside > 100 && carried[1] > 1000 && carried[2] > 1000 && carried[3] > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(the_nearest_point_is_that_of_all_features) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
