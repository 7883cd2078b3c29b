// SPDX-License-Identifier: MIT
//
// ray_prepare.c: the slab constants bracket the true t of every plane, and sheared corners stay within the bound,
// both measured in long double. The brackets must also be tight: a filter that passes everything is no filter.

#include "soup/ray/ray_job.h"
#include "soup_models.h"

#include <float.h>

static bool prepare(tl_ray_job *job, const tl_soup *soup, tl_vec3 origin, tl_vec3 target, bool is_segment)
{
    memset(job, 0, sizeof *job);
    job->soup = soup;
    job->is_segment = is_segment;
    job->t = is_segment ? 1.0f : INFINITY;
    return tl_ray_prepare(job, origin, target);
}

static long double component(tl_vec3 v, uint32_t axis)
{
    return (long double)(axis == 0 ? v.x : axis == 1 ? v.y : v.z);
}

typedef struct regimes {
    uint32_t planes, inclined, flat, corners;
} regimes;

static void check_planes(const tl_ray_job *job, tl_aabb bounds, test_random *random, regimes *seen)
{
    long double direction[3], largest = 0, reach = 0;
    for (uint32_t i = 0; i < 3; i++) {
        direction[i] = component(job->target.point, i) - (job->is_segment ? component(job->origin.point, i) : 0.0L);
        largest = fabsl(direction[i]) > largest ? fabsl(direction[i]) : largest;
        long double below = fabsl(component(bounds.min, i) - component(job->origin.point, i));
        long double above = fabsl(component(bounds.max, i) - component(job->origin.point, i));
        reach = below > reach ? below : reach;
        reach = above > reach ? above : reach;
    }
    for (uint32_t i = 0; i < 3; i++) {
        float low = (float)component(bounds.min, i), high = (float)component(bounds.max, i);
        float plane = tl_clampf(low + (high - low) * test_random_unit(random), low, high);
        // The filter's arithmetic, unfused; a fused one rounds less.
        float enter = plane * job->plane_scale[i] + job->near_base[i];
        float leave = plane * job->plane_scale[i] + job->far_base[i];
        long double from = component(job->origin.point, i);
        long double distance = (long double)plane - from;
        // The pad grows with coordinates, not only with distances.
        long double farthest = fabsl(from) + fabsl((long double)low) + fabsl((long double)high);
        if (fabsl(direction[i]) > largest * 0x1p-49L) {
            long double t = distance / direction[i] * (long double)job->box_t.scale;
            TEST_CHECK((long double)enter <= t && t <= (long double)leave);
            long double slack = 40 * 6e-8L * (farthest + reach) / fabsl(direction[i]) * (long double)job->box_t.scale;
            TEST_CHECK((long double)leave - (long double)enter <= slack);
            seen->inclined++;
        } else {
            // The ray stays on one side: planes clearly ahead are never entered within reach, nor those behind left.
            bool ahead = distance > 1e-4L * (farthest + reach), behind = -distance > 1e-4L * (farthest + reach);
            long double end = 4 * reach / largest * (long double)job->box_t.scale;
            TEST_CHECK(!ahead || fabsl((long double)enter) > end);
            TEST_CHECK(!behind || fabsl((long double)leave) > end);
            seen->flat++;
        }
        seen->planes++;
    }
}

static void check_corner(const tl_ray_job *job, tl_vec3 p, regimes *seen)
{
    const float origin[3] = { job->origin.lane[0], job->origin.lane[1], job->origin.lane[2] };
    const float point[3] = { p.x, p.y, p.z };
    long double direction[3];
    for (uint32_t i = 0; i < 3; i++) {
        direction[i] = component(job->target.point, i) - (job->is_segment ? component(job->origin.point, i) : 0.0L);
    }
    uint32_t x = job->axes[0], y = job->axes[1], z = job->axes[2];
    TEST_CHECK(x != y && y != z && z != x);
    TEST_CHECK(fabsl(direction[z]) >= fabsl(direction[x]) && fabsl(direction[z]) >= fabsl(direction[y]));
    float depth = point[z] - origin[z];
    float sheared = (point[x] - origin[x]) - job->shear[0] * depth;
    long double true_depth = (long double)point[z] - (long double)origin[z];
    long double truth = (long double)point[x] - (long double)origin[x] - direction[x] / direction[z] * true_depth;
    TEST_CHECK(fabsl((long double)sheared - truth) <= (long double)job->corner_error);
    seen->corners++;
}

static void test_brackets(void **state)
{
    (void)state;
    static const struct {
        float range, size, offset;
    } scenes[] = { { 10, 2, 0 },    { 500, 3, 0 },      { 1e-6f, 1e-6f, 0 },
                   { 40, 2, 5000 }, { 1e10f, 1e9f, 0 }, { 1e-30f, 1e-30f, 0 } };
    test_random random = { 1 };
    regimes seen = { 0 };
    for (uint32_t s = 0; s < sizeof scenes / sizeof scenes[0]; s++) {
        model m = model_random(200, scenes[s].range, scenes[s].size, s + 1);
        for (uint32_t i = 0; i < m.vertex_count; i++) {
            m.vertices[i].x += scenes[s].offset;
            m.vertices[i].z -= scenes[s].offset;
        }
        tl_soup *soup = model_soup(&m, NULL);
        tl_aabb bounds = tl_soup_bounds(soup);
        for (uint32_t i = 0; i < 20000; i++) {
            tl_vec3 size = tl_scale(tl_aabb_size(bounds), i % 3 == 0 ? 30.0f : 0.5f);
            tl_vec3 origin = test_random_point(&random, tl_sub(bounds.min, size), tl_add(bounds.max, size));
            tl_vec3 target = test_random_point(&random, tl_sub(bounds.min, size), tl_add(bounds.max, size));
            bool is_segment = i % 2 == 0;
            if (!is_segment) {
                target = tl_scale(test_random_direction(&random), ldexpf(1, (int)test_random_below(&random, 160) - 80));
                target.x = i % 5 == 0 ? 0.0f : i % 5 == 1 ? target.x * 1e-20f : target.x;
                target.y = i % 15 == 0 ? -0.0f : target.y;
            }
            tl_ray_job job;
            if (prepare(&job, soup, origin, target, is_segment)) {
                check_planes(&job, bounds, &random, &seen);
                check_corner(&job, m.vertices[test_random_below(&random, m.vertex_count)], &seen);
            }
        }
        tl_blob_free(soup);
        model_free(&m);
    }
    TEST_CHECK(seen.planes > 300000 && seen.inclined > 200000 && seen.flat > 10000 && seen.corners > 100000);
}

static void test_refused(void **state)
{
    (void)state;
    model m = model_random(3, 1, 1, 1);
    tl_soup *soup = model_soup(&m, NULL);
    tl_ray_job job;
    tl_vec3 zero = tl_vec3_make(0, 0, 0), one = tl_vec3_make(1, 1, 1), nan = tl_vec3_make(0, NAN, 0);
    TEST_CHECK(prepare(&job, soup, zero, one, false) && prepare(&job, soup, zero, one, true));
    TEST_CHECK(!prepare(&job, soup, one, zero, false)); // no direction
    TEST_CHECK(prepare(&job, soup, one, zero, true));
    TEST_CHECK(!prepare(&job, soup, one, one, true));
    TEST_CHECK(!prepare(&job, soup, nan, one, false) && !prepare(&job, soup, one, nan, false));
    // So far away that float filters cannot work: everything passes on to the exact part.
    TEST_CHECK(prepare(&job, soup, tl_vec3_make(3e38f, 0, 0), one, false));
    TEST_CHECK(job.near_base[0] < 0 && job.far_base[0] > 1e38f && job.corner_error > FLT_MAX);
    tl_blob_free(soup);
    model_free(&m);
}

// Hits of a ray of any usual length are told apart in float: deciding each in double would take twice the time.
static void test_intervals_at_all_lengths(void **state)
{
    (void)state;
    model m = model_random(50, 10, 2, 1);
    tl_soup *soup = model_soup(&m, NULL);
    test_random random = { 5 };
    for (int length = -60; length <= 60; length++) {
        tl_ray_job job;
        tl_vec3 direction = tl_scale(test_random_direction(&random), ldexpf(1, length));
        TEST_CHECK(prepare(&job, soup, tl_vec3_make(1, 2, 3), direction, false) && job.has_intervals);
        // box t is t times a power of two, which keeps every bit.
        int exponent;
        TEST_CHECK(frexpf(job.box_t.scale, &exponent) == 0.5f);
        TEST_CHECK(fabsf(job.per_depth) >= 0x1p-21f && fabsf(job.per_depth) <= 0x1p21f);
    }
    tl_ray_job job;
    TEST_CHECK(prepare(&job, soup, tl_vec3_make(0, 0, 0), tl_vec3_make(0, 1e-38f, 0), false) && !job.has_intervals);
    TEST_CHECK(prepare(&job, soup, tl_vec3_make(0, 0, 0), tl_vec3_make(0, 1e38f, 0), false) && !job.has_intervals);
    tl_blob_free(soup);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_brackets),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_intervals_at_all_lengths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
