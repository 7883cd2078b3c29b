// SPDX-License-Identifier: MIT
//
// Depth against brute force: 14 families of bodies in all pairs, the gap classes that overlap, three scales; bounds,
// normals and witnesses; radii; flat, straight and point shapes; custom and curved shapes; far places.

#include "talus_test.h"

#include "convex_oracle.h"

#include <string.h>

static oracle_body oracle_a, oracle_b;

// A point lies in a body, or at most this far outside.
static bool in_hull(const test_body *body, tl_transform pose, tl_vec3 point, float slack)
{
    tl_convex probe = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.0f);
    tl_transform there = tl_transform_identity();
    there.position = point;
    tl_separation s;
    tl_convex_distance(&body->shape, pose, &probe, there, NULL, &s);
    return s.distance <= slack;
}

static double oracle_true_depth(const test_body *a, tl_transform pose_a, const test_body *b, tl_transform pose_b)
{
    test_body_oracle(a, pose_a, &oracle_a);
    test_body_oracle(b, pose_b, &oracle_b);
    double depth = oracle_depth(&oracle_a, &oracle_b);
    return depth < (double)INFINITY ? depth : 0.0; // no axis at all: points and parallel segments are 0 deep
}

static void check_depth(const test_body *a, tl_transform pose_a, const test_body *b, tl_transform pose_b,
                        const tl_penetration *p, double *worst)
{
    double size = (double)tl_maxf(a->size, b->size);
    double expected = oracle_true_depth(a, pose_a, b, pose_b);
    double error = fabs((double)p->depth - expected) / size;
    *worst = fmax(*worst, error);
    TEST_CHECK(error <= 1e-6);
    TEST_CHECK((double)p->lower_bound <= expected + 1e-9 * size && expected <= (double)p->upper_bound + 1e-9 * size);
    TEST_CHECK(fabsf(tl_length(p->normal) - 1.0f) < 1e-5f);
    // The normal is worth its depth, and the witnesses are its ends.
    double along = tl_vec3d_dot(tl_vec3d_from(p->normal), oracle_support(&oracle_a, tl_vec3d_from(p->normal))) -
                   tl_vec3d_dot(tl_vec3d_from(p->normal), oracle_support(&oracle_b, tl_vec3d_from(tl_neg(p->normal))));
    TEST_CHECK(fabs(along - expected) <= 2e-6 * size);
    tl_vec3 moved = tl_mul_add(p->point_b, p->normal, p->depth);
    TEST_CHECK(tl_distance(moved, p->point_a) <= 2e-6f * (float)size);
    TEST_CHECK(in_hull(a, pose_a, p->point_a, 2e-6f * (float)size) &&
               in_hull(b, pose_b, p->point_b, 2e-6f * (float)size));
}

static void test_depth_matches_brute_force(void **state)
{
    (void)state;
    static const float scales[] = { 1.0f, 1e-6f, 1e5f };
    test_random random = { 11 };
    uint32_t seen[GAP_COUNT] = { 0 }, overlaps[GAP_COUNT] = { 0 }, unconverged = 0, most = 0, sum = 0, deep = 0;
    double worst = 0.0;
    for (int round = 0; round < 3; round++) {
        for (int pair = 0; pair < BODY_COUNT * BODY_COUNT; pair++) {
            test_body a, b;
            test_body_make(&a, (body_family)(pair % BODY_COUNT), (uint64_t)(round * 1000 + pair), scales[round]);
            test_body_make(&b, (body_family)(pair / BODY_COUNT), (uint64_t)(round * 1000 + pair) + 500, scales[round]);
            for (int gap = 0; gap < GAP_COUNT; gap++) {
                tl_transform pose_a, pose_b;
                test_place(&random, &a, &b, (gap_class)gap, &pose_a, &pose_b);
                tl_penetration p;
                bool overlap = tl_convex_penetration(&a.shape, pose_a, &b.shape, pose_b, NULL, &p);
                tl_separation s;
                tl_convex_distance(&a.shape, pose_a, &b.shape, pose_b, NULL, &s);
                TEST_CHECK(overlap == p.overlap && overlap == s.overlap);
                seen[gap]++;
                overlaps[gap] += overlap;
                if (!overlap) {
                    TEST_CHECK(p.depth == 0.0f && p.upper_bound == 0.0f);
                    continue;
                }
                check_depth(&a, pose_a, &b, pose_b, &p, &worst);
                unconverged += p.status != TL_CONVEX_CONVERGED;
                most = p.iterations > most ? p.iterations : most;
                sum += p.iterations;
                deep++;
            }
            test_body_free(&a);
            test_body_free(&b);
        }
    }
    print_message("worst error %g of the size, %u of %u not converged, %u iterations at most, %u on average\n", worst,
                  unconverged, deep, most, sum / deep);
    TEST_CHECK(unconverged * 200 <= deep);
    for (int gap = 0; gap < GAP_COUNT; gap++) {
        TEST_CHECK(seen[gap] == 3 * BODY_COUNT * BODY_COUNT);
    }
    TEST_CHECK(overlaps[GAP_CONCENTRIC] > 300 && overlaps[GAP_DEEP] > 200 && overlaps[GAP_SHALLOW] > 150);
    TEST_CHECK(overlaps[GAP_ONE] == 0 && overlaps[GAP_HUNDRED] == 0);
}

// Each solid against itself in one place: the deepest and most symmetric case.
static void test_same_place(void **state)
{
    (void)state;
    double worst = 0.0;
    for (int family = 0; family < BODY_POINT; family++) {
        test_body a;
        test_body_make(&a, (body_family)family, (uint64_t)family, 1.0f);
        tl_transform pose = { { 0.1f, 0.2f, -0.3f, 0.9f }, { 1, 2, 3 } };
        tl_penetration p;
        TEST_CHECK(tl_convex_penetration(&a.shape, pose, &a.shape, pose, NULL, &p));
        check_depth(&a, pose, &a, pose, &p, &worst);
        test_body_free(&a);
    }
}

static void test_radii_add_to_the_depth(void **state)
{
    (void)state;
    tl_transform identity = tl_transform_identity(), moved = identity;
    moved.position = tl_vec3_make(0, 3, 4);
    tl_convex a = tl_convex_sphere(tl_vec3_make(0, 0, 0), 2.0f), b = tl_convex_sphere(tl_vec3_make(0, 0, 0), 3.5f);
    tl_penetration p;
    TEST_CHECK(tl_convex_penetration(&a, identity, &b, moved, NULL, &p));
    TEST_CHECK(fabsf(p.depth - 0.5f) < 1e-6f && p.lower_bound <= 0.5f && p.upper_bound >= 0.5f);
    TEST_CHECK(tl_distance(p.normal, tl_vec3_make(0, 0.6f, 0.8f)) < 1e-6f);
    TEST_CHECK(tl_distance(p.point_a, tl_vec3_make(0, 1.2f, 1.6f)) < 1e-6f);
    TEST_CHECK(tl_distance(p.point_b, tl_vec3_make(0, 0.9f, 1.2f)) < 1e-6f);
    // One centre: any direction will do, but it is one.
    TEST_CHECK(tl_convex_penetration(&a, moved, &b, moved, NULL, &p));
    TEST_CHECK(fabsf(p.depth - 5.5f) < 1e-6f && fabsf(tl_length(p.normal) - 1.0f) < 1e-6f);
    TEST_CHECK(fabsf(tl_distance(p.point_a, p.point_b) - 5.5f) < 1e-5f);
    // A capsule whose core lies 0.25 deep in a box.
    tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(2, 1, 2), 0.0f);
    tl_convex capsule = tl_convex_capsule(tl_vec3_make(-1, 0, 0), tl_vec3_make(1, 0, 0), 0.5f);
    moved.position = tl_vec3_make(0.25f, 0.75f, 0.25f);
    TEST_CHECK(tl_convex_penetration(&box, identity, &capsule, moved, NULL, &p));
    TEST_CHECK(fabsf(p.depth - 0.75f) < 1e-6f && fabsf(p.normal.y - 1.0f) < 1e-6f);
    TEST_CHECK(fabsf(p.point_a.y - 1.0f) < 1e-6f && fabsf(p.point_b.y - 0.25f) < 1e-6f);
}

static void test_flat_shapes(void **state)
{
    (void)state;
    tl_transform identity = tl_transform_identity();
    tl_vec3 o = tl_vec3_make(0, 0, 0);
    tl_penetration p;
    tl_convex x = tl_convex_capsule(tl_vec3_make(-1, 0, 0), tl_vec3_make(1, 0, 0), 0.0f),
              y = tl_convex_capsule(tl_vec3_make(0, -1, 0), tl_vec3_make(0, 1, 0), 0.0f),
              point = tl_convex_sphere(o, 0.0f);
    // Two segments that cross.
    TEST_CHECK(tl_convex_penetration(&x, identity, &y, identity, NULL, &p));
    TEST_CHECK(p.depth == 0.0f && fabsf(p.normal.z) == 1.0f && p.status == TL_CONVEX_CONVERGED);
    // A segment and itself, a point on it, a point and itself.
    TEST_CHECK(tl_convex_penetration(&x, identity, &x, identity, NULL, &p));
    TEST_CHECK(p.depth == 0.0f && p.normal.x == 0.0f && fabsf(tl_length(p.normal) - 1.0f) < 1e-6f);
    TEST_CHECK(tl_convex_penetration(&x, identity, &point, identity, NULL, &p) && p.depth == 0.0f);
    TEST_CHECK(p.normal.x == 0.0f);
    TEST_CHECK(tl_convex_penetration(&point, identity, &point, identity, NULL, &p) && p.depth == 0.0f);
    TEST_CHECK(fabsf(tl_length(p.normal) - 1.0f) < 1e-6f);
    // Two triangles in one plane; with radii they are 1.5 deep, unless the way out is sideways.
    tl_convex triangle =
        tl_convex_triangle(tl_vec3_make(-9, 0, -9), tl_vec3_make(9, 0, -9), tl_vec3_make(0, 0, 9), 1.0f);
    tl_convex other = triangle;
    other.radius = 0.5f;
    TEST_CHECK(tl_convex_penetration(&triangle, identity, &other, identity, NULL, &p));
    TEST_CHECK(fabsf(p.depth - 1.5f) < 1e-6f && fabsf(p.normal.y) == 1.0f);
}

static tl_vec3 ellipsoid(tl_vec3 direction, void *user)
{
    const tl_vec3 *radii = (const tl_vec3 *)user;
    return tl_mul(tl_normalize(tl_mul(direction, *radii)), *radii);
}

static void test_curved_shapes(void **state)
{
    (void)state;
    tl_vec3 radii = tl_vec3_make(1, 2, 3);
    tl_convex shape = tl_convex_custom(ellipsoid, &radii, 0.0f), point = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.0f);
    tl_transform identity = tl_transform_identity(), moved = identity;
    tl_penetration p;
    // On the shortest axis, away from the middle, so that one direction is best.
    TEST_CHECK(tl_convex_penetration(&shape, identity, &point, identity, NULL, &p));
    TEST_CHECK(fabsf(p.depth - 1.0f) < 1e-5f && fabsf(p.normal.x) > 0.999f);
    moved.position = tl_vec3_make(0.75f, 0, 0);
    TEST_CHECK(tl_convex_penetration(&shape, identity, &point, moved, NULL, &p));
    TEST_CHECK(fabsf(p.depth - 0.25f) < 1e-5f && p.normal.x > 0.999f && p.lower_bound > 0.2499f);
    // Where every direction is as good as any other no number of steps is enough; the bounds hold, and are near.
    radii = tl_vec3_make(1, 1, 1);
    TEST_CHECK(tl_convex_penetration(&shape, identity, &shape, identity, NULL, &p));
    TEST_CHECK(p.lower_bound <= 2.0f && p.upper_bound >= 2.0f && fabsf(p.depth - 2.0f) < 1e-5f);
    TEST_CHECK(p.lower_bound > 1.999f && p.status == TL_CONVEX_ITERATIONS);
    TEST_CHECK(p.iterations < TL_MAX_GJK_ITERATIONS + TL_MAX_EPA_ITERATIONS + TL_MAX_DIRECTION_STEPS + 100);
}

// Balls of many facets in one place are as deep in nearly every direction; EPA has no room for them.
static void test_concentric_balls(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 100, 512, 1000, 3000 };
    test_random random = { 13 };
    tl_vec3 *points = malloc(3000 * sizeof *points);
    uint32_t searched = 0;
    for (int i = 0; i < 4; i++) {
        tl_hull *hulls[2];
        tl_convex shapes[2];
        for (int k = 0; k < 2; k++) {
            shape_make(SHAPE_SPHERE, &random, points, counts[i]);
            TEST_RESULT(tl_hull_bake(points, counts[i], NULL, &hulls[k], NULL), TL_OK);
            shapes[k] = tl_convex_from_hull(hulls[k], 0.0f);
        }
        tl_transform pose_a = tl_transform_identity(), pose_b = { { 0.1f, 0.2f, 0.3f, 0.9f }, { 0, 0, 0 } };
        tl_penetration p;
        TEST_CHECK(tl_convex_penetration(&shapes[0], pose_a, &shapes[1], pose_b, NULL, &p));
        TEST_CHECK(p.status == TL_CONVEX_CONVERGED && p.upper_bound - p.lower_bound < 1e-5f);
        TEST_CHECK(p.lower_bound <= p.depth && p.depth <= p.upper_bound);
        TEST_CHECK(tl_distance(tl_mul_add(p.point_b, p.normal, p.depth), p.point_a) < 1e-5f);
        searched += p.iterations > TL_MAX_EPA_ITERATIONS + 20;
        // The normal is worth the depth, and no direction is worth less.
        for (int k = 0; k <= 20000; k++) {
            tl_vec3 d = k == 0 ? p.normal : test_random_direction(&random);
            tl_vec3 end = tl_hull_vertices(hulls[0])[tl_hull_support(hulls[0], d, TL_NO_VERTEX)];
            tl_vec3 back = tl_inverse_rotate(tl_quat_normalize(pose_b.rotation), tl_neg(d));
            tl_vec3 begin = tl_hull_vertices(hulls[1])[tl_hull_support(hulls[1], back, TL_NO_VERTEX)];
            float along = tl_dot(d, end) + tl_dot(back, begin);
            TEST_CHECK(along >= p.lower_bound - 1e-6f && (k > 0 || fabsf(along - p.depth) < 1e-6f));
        }
        tl_blob_free(hulls[0]);
        tl_blob_free(hulls[1]);
    }
    free(points);
    TEST_CHECK(searched >= 3);
}

// What a budget leaves open: the bounds hold, moving B by the upper one separates, and the steps are counted.
static void check_budget(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                         const tl_penetration *whole, uint32_t budget, tl_penetration *p)
{
    const float gap = 4e-6f * (1.0f + whole->depth);
    TEST_CHECK(tl_convex_penetration_within(a, pose_a, b, pose_b, NULL, budget, p));
    TEST_CHECK(p->lower_bound <= p->depth && p->depth <= p->upper_bound);
    TEST_CHECK(p->lower_bound <= whole->upper_bound + gap && p->upper_bound >= whole->lower_bound - gap);
    TEST_CHECK(p->iterations <= (uint64_t)TL_MAX_GJK_ITERATIONS + budget + 8);
    TEST_CHECK(p->status == TL_CONVEX_ITERATIONS || p->upper_bound - p->lower_bound <= 16.0f * gap ||
               p->status == TL_CONVEX_DEGENERATE);
    tl_penetration after;
    pose_b.position = tl_mul_add(pose_b.position, p->normal, p->upper_bound);
    tl_convex_penetration(a, pose_a, b, pose_b, NULL, &after);
    TEST_CHECK(after.depth <= 2.0f * gap);
}

static void test_budgets(void **state)
{
    (void)state;
    static const uint32_t budgets[] = { 1, 2, 8, 32, 124, 200, 1000, 4000 };
    test_random random = { 14 };
    tl_vec3 *points = malloc(3000 * sizeof *points);
    tl_hull *hulls[2];
    tl_convex shapes[2];
    for (int k = 0; k < 2; k++) {
        shape_make(SHAPE_SPHERE, &random, points, 3000);
        TEST_RESULT(tl_hull_bake(points, 3000, NULL, &hulls[k], NULL), TL_OK);
        shapes[k] = tl_convex_from_hull(hulls[k], 0.0f);
    }
    const tl_transform here = tl_transform_identity();
    tl_penetration whole, p;
    TEST_CHECK(tl_convex_penetration(&shapes[0], here, &shapes[1], here, NULL, &whole));
    float last = INFINITY;
    for (int i = 0; i < 8; i++) {
        check_budget(&shapes[0], here, &shapes[1], here, &whole, budgets[i], &p);
        TEST_CHECK(p.status == TL_CONVEX_ITERATIONS && p.upper_bound <= last);
        last = p.upper_bound;
        tl_contact_manifold m;
        const tl_contact_limits limits = { 0.0f, 0.01f, budgets[i] };
        TEST_CHECK(tl_convex_contacts(&shapes[0], here, &shapes[1], here, &limits, NULL, &m) > 0);
        TEST_CHECK(m.status == TL_CONVEX_ITERATIONS && fabsf(m.separation + p.depth) < 1e-6f);
    }
    check_budget(&shapes[0], here, &shapes[1], here, &whole, UINT32_MAX, &p);
    TEST_CHECK(p.status == whole.status && p.depth == whole.depth && p.iterations == whole.iterations);
    for (int k = 0; k < 2; k++) {
        tl_blob_free(hulls[k]);
    }
    free(points);
}

static void test_budgets_of_families(void **state)
{
    (void)state;
    test_random random = { 15 };
    uint32_t ended = 0, done = 0;
    for (uint32_t i = 0; i < 4000; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_COUNT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / BODY_COUNT % BODY_COUNT), (uint64_t)i + 1, 1.0f);
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 2 == 0 ? GAP_SHALLOW : GAP_DEEP, &pose_a, &pose_b);
        tl_penetration whole, p;
        if (tl_convex_penetration(&a.shape, pose_a, &b.shape, pose_b, NULL, &whole)) {
            check_budget(&a.shape, pose_a, &b.shape, pose_b, &whole, 1 + i % 7, &p);
            ended += p.status == TL_CONVEX_ITERATIONS;
            done += p.status == TL_CONVEX_CONVERGED;
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("budgets ended %u searches, %u were done before\n", ended, done);
    TEST_CHECK(ended > 200 && done > 200);
}

static void compare_far(const test_body *a, const test_body *b, const tl_transform near[2], const tl_transform far[2],
                        void *user)
{
    tl_penetration at_origin, away;
    tl_convex_penetration(&a->shape, near[0], &b->shape, near[1], NULL, &at_origin);
    tl_convex_penetration(&a->shape, far[0], &b->shape, far[1], NULL, &away);
    TEST_CHECK(at_origin.overlap == away.overlap && at_origin.depth == away.depth &&
               at_origin.iterations == away.iterations);
    TEST_CHECK(memcmp(&at_origin.normal, &away.normal, sizeof away.normal) == 0);
    *(uint32_t *)user += away.depth > 0.01f;
}

static void test_place_in_the_world_does_not_matter(void **state)
{
    (void)state;
    uint32_t deep = 0;
    test_each_far_pair(12, 0.25f, compare_far, &deep);
    TEST_CHECK(deep > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_depth_matches_brute_force),
        cmocka_unit_test(test_same_place),
        cmocka_unit_test(test_radii_add_to_the_depth),
        cmocka_unit_test(test_flat_shapes),
        cmocka_unit_test(test_curved_shapes),
        cmocka_unit_test(test_concentric_balls),
        cmocka_unit_test(test_budgets),
        cmocka_unit_test(test_budgets_of_families),
        cmocka_unit_test(test_place_in_the_world_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
