// SPDX-License-Identifier: MIT
//
// Casts against the exact time of impact: the origin as a ray against all half-spaces of A - B (face normals and edge
// pairs), 14 families in all pairs; fine steps for pairs without a volume; rays; radii; overlap, touch and parting at
// the start; curved shapes.

#include "talus_test.h"

#include "convex_oracle.h"

#include <string.h>

static oracle_body oracle_a, oracle_b;

// Times of impact of the bodies as they are, grown, and shrunk; infinite when they pass.
typedef struct impact_times {
    double enter[3], leave[3], grow[3];
} impact_times;

enum { IMPACT_EXACT, IMPACT_GROWN, IMPACT_SHRUNK };

// The times between which B, moving, overlaps A along one axis.
static void clip_axis(tl_vec3d axis, tl_vec3d motion, impact_times *times)
{
    double speed = tl_vec3d_dot(axis, motion);
    double apart = tl_vec3d_dot(axis, oracle_support(&oracle_b, tl_vec3d_neg(axis))) -
                   tl_vec3d_dot(axis, oracle_support(&oracle_a, axis));
    for (int i = 0; i < 3; i++) {
        double gap = apart - times->grow[i];
        // Apart along the axis while gap + t speed > 0.
        if (speed < 0.0) {
            times->enter[i] = fmax(times->enter[i], -gap / speed);
        } else if (speed > 0.0) {
            times->leave[i] = fmin(times->leave[i], -gap / speed);
        } else if (gap > 0.0) {
            times->leave[i] = -(double)INFINITY;
        }
    }
}

static void clip_both(tl_vec3d n, double least, tl_vec3d motion, impact_times *times)
{
    double length = tl_vec3d_length(n);
    if (length > least) {
        n = tl_vec3d_scale(n, 1.0 / length);
        clip_axis(n, motion, times);
        clip_axis(tl_vec3d_neg(n), motion, times);
    }
}

// One of the bodies has a volume.
static void find_times(tl_vec3d motion, double size, double times_out[3])
{
    impact_times times = { { 0, 0, 0 }, { 1, 1, 1 }, { 0, 2e-6 * size, -1e-6 * size } };
    for (int turn = 0; turn < 2; turn++) {
        const oracle_body *p = turn ? &oracle_b : &oracle_a;
        for (uint32_t t = 0; t < p->triangle_count; t++) {
            tl_vec3d o = p->vertices[p->triangles[3 * t]];
            clip_both(tl_vec3d_cross(tl_vec3d_sub(p->vertices[p->triangles[3 * t + 1]], o),
                                     tl_vec3d_sub(p->vertices[p->triangles[3 * t + 2]], o)),
                      0.0, motion, &times);
        }
    }
    for (uint32_t i = 0; i < oracle_a.edge_count; i++) {
        tl_vec3d u =
            tl_vec3d_sub(oracle_a.vertices[oracle_a.edges[2 * i + 1]], oracle_a.vertices[oracle_a.edges[2 * i]]);
        for (uint32_t j = 0; j < oracle_b.edge_count; j++) {
            tl_vec3d v =
                tl_vec3d_sub(oracle_b.vertices[oracle_b.edges[2 * j + 1]], oracle_b.vertices[oracle_b.edges[2 * j]]);
            clip_both(tl_vec3d_cross(u, v), 1e-12 * tl_vec3d_length(u) * tl_vec3d_length(v), motion, &times);
        }
    }
    for (int i = 0; i < 3; i++) {
        times_out[i] = times.enter[i] <= times.leave[i] ? times.enter[i] : (double)INFINITY;
    }
}

static void check_normal(const tl_convex_hit *hit, tl_vec3 motion)
{
    TEST_CHECK(fabsf(tl_length(hit->normal) - 1.0f) < 1e-5f);
    TEST_CHECK(tl_dot(hit->normal, motion) < 0.0f);
}

static void test_cast_matches_exact_time(void **state)
{
    (void)state;
    static const float scales[] = { 1.0f, 1e-5f };
    test_random random = { 21 };
    uint32_t hits = 0, misses = 0, grazing = 0, initial = 0, most = 0, sum = 0, unconverged = 0, cases = 0;
    double worst = 0.0;
    for (int round = 0; round < 2; round++) {
        for (int pair = 0; pair < BODY_COUNT * BODY_COUNT; pair++) {
            if (pair % BODY_COUNT >= BODY_POINT && pair / BODY_COUNT >= BODY_POINT) {
                continue;
            }
            test_body a, b;
            test_body_make(&a, (body_family)(pair % BODY_COUNT), (uint64_t)(round * 1000 + pair), scales[round]);
            test_body_make(&b, (body_family)(pair / BODY_COUNT), (uint64_t)(round * 1000 + pair) + 500, scales[round]);
            double size = (double)tl_maxf(a.size, b.size);
            for (int k = 0; k < 8; k++) {
                tl_transform pose_a, pose_b;
                test_place(&random, &a, &b,
                           k == 0   ? GAP_DEEP
                           : k == 1 ? GAP_TOUCHING
                           : k < 5  ? GAP_1E_2
                                    : GAP_ONE,
                           &pose_a, &pose_b);
                tl_vec3 toward = tl_sub(pose_a.position, pose_b.position);
                tl_vec3 motion = tl_add(tl_scale(toward, test_random_range(&random, 0, 4)),
                                        tl_scale(test_random_direction(&random), (float)size * 0.5f));
                test_body_oracle(&a, pose_a, &oracle_a);
                test_body_oracle(&b, pose_b, &oracle_b);
                tl_vec3d move = tl_vec3d_from(motion);
                double times[3];
                find_times(move, size, times);
                double grown = times[IMPACT_GROWN], shrunk = times[IMPACT_SHRUNK], exact = times[IMPACT_EXACT];
                tl_convex_hit hit;
                TEST_CHECK(tl_convex_cast(&a.shape, pose_a, &b.shape, pose_b, motion, &hit) == hit.hit);
                cases++;
                sum += hit.iterations;
                most = hit.iterations > most ? hit.iterations : most;
                unconverged += hit.status != TL_CONVEX_CONVERGED;
                double error = 0.0;
                if (!(grown < (double)INFINITY)) {
                    TEST_CHECK(!hit.hit);
                    misses++;
                } else if (shrunk < (double)INFINITY) {
                    TEST_CHECK(hit.hit);
                    hits++;
                    initial += hit.initial_overlap;
                    TEST_CHECK((double)hit.t >= grown - 1e-6 && (double)hit.t <= exact + 1e-6);
                    TEST_CHECK(hit.initial_overlap || exact > 0.0 || (double)hit.gap <= 1e-5 * size);
                    // How far the two still are from touching, along the motion; large only where they graze.
                    error = (exact - (double)hit.t) * tl_vec3d_length(move) / size;
                    if (!hit.initial_overlap && hit.t > 0.0f) {
                        check_normal(&hit, motion);
                    }
                } else {
                    grazing++;
                }
                worst = fmax(worst, error);
                TEST_CHECK(!hit.hit || (double)hit.gap <= 2e-6 * size);
            }
            test_body_free(&a);
            test_body_free(&b);
        }
    }
    print_message(
        "%u hits (%u overlaps at the start), %u misses, %u grazing; worst error %g of the size; %u iterations "
        "at most, %u on average, %u not converged\n",
        hits, initial, misses, grazing, worst, most, sum / cases, unconverged);
    TEST_CHECK(hits > 1000 && misses > 200 && initial > 100 && grazing < cases / 20 && worst < 1e-4 &&
               unconverged * 200 <= cases);
}

// Points, segments and triangles against each other: no overlap at any of 200 steps before the hit, contact at it.
static void test_flat_pairs_by_steps(void **state)
{
    (void)state;
    test_random random = { 22 };
    uint32_t hits = 0, misses = 0;
    for (int i = 0; i < 900; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)((int)BODY_POINT + i % 3), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)((int)BODY_POINT + i / 3 % 3), (uint64_t)i + 7, 1.0f);
        float radius = i % 2 ? 0.25f : 0.0f;
        a.shape.radius = radius;
        tl_transform pose_a = tl_transform_identity(), pose_b = pose_a;
        pose_b.position = tl_scale(test_random_direction(&random), 3);
        tl_vec3 motion = tl_add(tl_scale(pose_b.position, -2), tl_scale(test_random_direction(&random), 1));
        tl_convex_hit hit;
        tl_convex_cast(&a.shape, pose_a, &b.shape, pose_b, motion, &hit);
        test_body_oracle(&a, pose_a, &oracle_a);
        double last = hit.hit ? (double)hit.t : 1.0;
        for (int step = 0; step <= 200; step++) {
            double t = last * step / 200;
            test_body_oracle(&b, pose_b, &oracle_b);
            for (uint32_t v = 0; v < oracle_b.vertex_count; v++) {
                oracle_b.vertices[v] = tl_vec3d_mul_add(oracle_b.vertices[v], tl_vec3d_from(motion), t);
            }
            double gap = oracle_distance(&oracle_a, &oracle_b) - (double)radius;
            TEST_CHECK(hit.initial_overlap || gap > -1e-6);
            TEST_CHECK(step < 200 || !hit.hit || hit.initial_overlap || gap < 2e-6);
        }
        hits += hit.hit;
        misses += !hit.hit;
        test_body_free(&a);
        test_body_free(&b);
    }
    TEST_CHECK(hits > 200 && misses > 200);
}

static void test_start(void **state)
{
    (void)state;
    tl_vec3 o = tl_vec3_make(0, 0, 0);
    tl_convex box = tl_convex_box(o, tl_vec3_make(1, 1, 1), 0.0f), ball = tl_convex_sphere(o, 0.5f);
    tl_transform here = tl_transform_identity(), there = here;
    tl_convex_hit hit;
    there.position = tl_vec3_make(0, 1.25f, 0);
    TEST_CHECK(tl_convex_cast(&box, here, &ball, there, tl_vec3_make(0, 5, 0), &hit) && hit.initial_overlap &&
               hit.t == 0.0f);
    // Resting: down is a hit at once, along and up are free.
    there.position = tl_vec3_make(0, 1.5f, 0);
    TEST_CHECK(tl_convex_cast(&box, here, &ball, there, tl_vec3_make(0, -1, 0), &hit) && hit.t == 0.0f);
    there.position = tl_vec3_make(0, 1.5000001f, 0);
    TEST_CHECK(tl_convex_cast(&box, here, &ball, there, tl_vec3_make(0, -1, 0), &hit) && hit.t < 1e-6f &&
               hit.normal.y > 0.999f && !hit.initial_overlap);
    TEST_CHECK(!tl_convex_cast(&box, here, &ball, there, tl_vec3_make(0, 1, 0), &hit));
    TEST_CHECK(!tl_convex_cast(&box, here, &ball, there, tl_vec3_make(7, 0, 0), &hit));
    // No motion.
    TEST_CHECK(!tl_convex_cast(&box, here, &ball, there, o, &hit));
    there.position = tl_vec3_make(0, 4, 0);
    TEST_CHECK(tl_convex_cast(&box, here, &ball, there, tl_vec3_make(0, -5, 0), &hit));
    TEST_CHECK(fabsf(hit.t - 0.5f) < 1e-6f && hit.t <= 0.5f && fabsf(hit.point.y - 1.0f) < 1e-6f);
    TEST_CHECK(hit.normal.y > 0.999f && hit.status == TL_CONVEX_CONVERGED);
    TEST_CHECK(!tl_convex_cast(&box, here, &ball, there, tl_vec3_make(0, -2.49f, 0), &hit));
}

static void test_rays(void **state)
{
    (void)state;
    tl_vec3 o = tl_vec3_make(0, 0, 0);
    tl_transform pose = { { 0, 0, 0.6f, 0.8f }, { 5, 6, 7 } };
    tl_convex_hit hit;
    test_random random = { 23 };
    // A ball: the quadratic formula.
    tl_convex ball = tl_convex_sphere(o, 1.0f);
    uint32_t hits = 0;
    for (int i = 0; i < 2000; i++) {
        tl_vec3 from = tl_scale(test_random_direction(&random), 1.5f);
        tl_vec3 d = test_random_direction(&random);
        tl_vec3d f = tl_vec3d_sub(tl_vec3d_from(tl_add(from, pose.position)), tl_vec3d_from(pose.position));
        double b = tl_vec3d_dot(f, tl_vec3d_from(d)), dd = tl_vec3d_dot(tl_vec3d_from(d), tl_vec3d_from(d));
        double root = b * b - dd * (tl_vec3d_dot(f, f) - 1.0);
        bool found = tl_convex_cast_ray(&ball, pose, tl_add(from, pose.position), d, INFINITY, &hit);
        if (fabs(root) > 1e-4) {
            TEST_CHECK(found == (root > 0.0 && b < 0.0));
        }
        if (found && root > 1e-4) {
            TEST_CHECK(fabs((double)hit.t - (-b - sqrt(root)) / dd) < 1e-5);
            TEST_CHECK(fabsf(tl_distance(hit.point, pose.position) - 1.0f) < 2e-6f);
            hits++;
        }
    }
    TEST_CHECK(hits > 150 && hits < 1500);
    TEST_CHECK(tl_convex_cast_ray(&ball, pose, pose.position, tl_vec3_make(1, 0, 0), 10.0f, &hit) &&
               hit.initial_overlap);
    // A cylinder from its side and its top, a cone along and across its axis.
    tl_transform identity = tl_transform_identity();
    tl_convex cylinder = tl_convex_cylinder(tl_vec3_make(0, -1, 0), tl_vec3_make(0, 1, 0), 0.5f, 0.0f);
    TEST_CHECK(
        tl_convex_cast_ray(&cylinder, identity, tl_vec3_make(3, 0.5f, 0), tl_vec3_make(-1, 0, 0), INFINITY, &hit));
    TEST_CHECK(fabsf(hit.t - 2.5f) < 1e-5f && hit.normal.x > 0.999f);
    TEST_CHECK(
        tl_convex_cast_ray(&cylinder, identity, tl_vec3_make(0.3f, 4, 0.3f), tl_vec3_make(0, -2, 0), 9.0f, &hit));
    TEST_CHECK(fabsf(hit.t - 1.5f) < 1e-5f && hit.normal.y > 0.999f);
    TEST_CHECK(
        !tl_convex_cast_ray(&cylinder, identity, tl_vec3_make(0.36f, 4, 0.36f), tl_vec3_make(0, -2, 0), 9.0f, &hit));
    tl_convex cone = tl_convex_cone(tl_vec3_make(0, 0, 0), tl_vec3_make(0, 2, 0), 1.0f, 0.0f);
    TEST_CHECK(tl_convex_cast_ray(&cone, identity, tl_vec3_make(5, 1, 0), tl_vec3_make(-1, 0, 0), INFINITY, &hit));
    TEST_CHECK(fabsf(hit.t - 4.5f) < 1e-5f && fabsf(hit.normal.x - 2 * hit.normal.y) < 1e-3f);
}

// Against hulls the planes are exact.
static void test_rays_on_hulls(void **state)
{
    (void)state;
    test_random random = { 24 };
    uint32_t hits = 0, misses = 0;
    for (int family = 0; family < BODY_POINT; family++) {
        test_body a;
        test_body_make(&a, (body_family)family, (uint64_t)family, 1.0f);
        test_body_oracle(&a, tl_transform_identity(), &oracle_a);
        for (int i = 0; i < 200; i++) {
            tl_vec3 target = tl_scale(tl_hull_vertices(a.hull)[test_random_below(&random, a.hull->vertex_count)],
                                      test_random_range(&random, 0, 1.1f));
            tl_vec3 from = tl_scale(test_random_direction(&random), 4), d = tl_sub(target, from);
            oracle_from_points(&oracle_b, &from, 1, tl_transform_identity());
            double times[3];
            find_times(tl_vec3d_from(d), (double)a.size, times);
            tl_convex_hit hit;
            tl_convex_cast_ray(&a.shape, tl_transform_identity(), from, d, 1.0f, &hit);
            if (!(times[IMPACT_GROWN] < (double)INFINITY)) {
                TEST_CHECK(!hit.hit);
                misses++;
            } else if (times[IMPACT_SHRUNK] < (double)INFINITY) {
                TEST_CHECK(hit.hit && (double)hit.t >= times[IMPACT_GROWN] - 1e-6 &&
                           (double)hit.t <= times[IMPACT_EXACT] + 1e-6);
                hits++;
            }
        }
        test_body_free(&a);
    }
    TEST_CHECK(hits > 500 && misses > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cast_matches_exact_time),
        cmocka_unit_test(test_flat_pairs_by_steps),
        cmocka_unit_test(test_start),
        cmocka_unit_test(test_rays),
        cmocka_unit_test(test_rays_on_hulls),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
