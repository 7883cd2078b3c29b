// SPDX-License-Identifier: MIT
//
// The polytope that is kept: whatever the motion, what it proves is the depth by a search from nothing, and it proves
// it for most pairs that have moved by a few centimetres.

#include "talus_test.h"

#include "convex_oracle.h"

#include "convex/depth/epa.h"

#include <string.h>

enum { MOTIONS = 6, STEPS = 4 };

static const float motions[MOTIONS] = { 0.0f, 1e-6f, 1e-4f, 2e-3f, 2e-2f, 0.2f };

typedef struct motion_tally {
    uint32_t tried, held, resumed, wrong;
} motion_tally;

static tl_transform moved_by(test_random *random, tl_transform pose, float length)
{
    const tl_vec3 turn = tl_scale(test_random_direction(random), 0.5f * length);
    const tl_quat by = { turn.x, turn.y, turn.z, 1.0f };
    pose.rotation = tl_quat_normalize(tl_quat_mul(by, pose.rotation));
    pose.position = tl_mul_add(pose.position, test_random_direction(random), length);
    return pose;
}

// Whether the depth is that of the search, and the witnesses lie on both shapes, at the depth along the normal.
static bool is_right(tl_minkowski *pair, const tl_core_depth *depth, const tl_penetration *truth, double size)
{
    const double gap = 2e-6 * size;
    const tl_vec3d apart = tl_vec3d_sub(depth->on_a, depth->on_b);
    const tl_vec3d off = tl_vec3d_mul_add(apart, depth->normal, -depth->upper);
    tl_minkowski_point top;
    tl_minkowski_support(pair, depth->normal, &top);
    return depth->lower <= depth->upper + gap && depth->lower <= (double)truth->upper_bound + gap &&
           depth->upper >= (double)truth->lower_bound - gap && depth->upper - (double)truth->upper_bound <= gap &&
           tl_vec3d_length(off) <= gap && fabs(tl_vec3d_dot(depth->normal, top.w) - depth->upper) <= gap &&
           tl_vec3d_dot(depth->normal, tl_vec3d_sub(depth->on_a, top.a)) >= -gap;
}

static void try_motion(test_random *random, const test_body *a, const test_body *b, tl_transform pose_a,
                       tl_transform pose_b, float motion, motion_tally *tally)
{
    const tl_contact_limits limits = { 0.01f, 0.01f, 0 };
    const double size = (double)tl_maxf(a->size, b->size);
    tl_contact_cache cache = { 0 };
    tl_contact_manifold m;
    tl_convex_contacts(&a->shape, pose_a, &b->shape, pose_b, &limits, &cache, &m);
    for (int step = 0; step < STEPS && cache.polytope.point_count > 0; step++) {
        pose_b = moved_by(random, pose_b, motion);
        tl_minkowski pair;
        tl_core_depth depth;
        tl_penetration truth;
        tally->tried++;
        TEST_CHECK(tl_minkowski_init(&pair, &a->shape, &pose_a, &b->shape, &pose_b));
        const bool overlap = tl_convex_penetration(&a->shape, pose_a, &b->shape, pose_b, NULL, &truth);
        if (tl_polytope_holds(&pair, &cache.polytope, &depth)) {
            tally->held++;
            tally->wrong += !overlap || !is_right(&pair, &depth, &truth, size);
        }
        TEST_CHECK(tl_minkowski_init(&pair, &a->shape, &pose_a, &b->shape, &pose_b));
        if (tl_epa_resume(&pair, &cache.polytope, &depth)) {
            tally->resumed++;
            tally->wrong += !overlap || !is_right(&pair, &depth, &truth, size);
        }
    }
}

static void test_what_is_proven(void **state)
{
    (void)state;
    test_random random = { 82 };
    motion_tally tallies[MOTIONS] = { { 0 } };
    for (uint32_t i = 0; i < 2000; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_POINT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 3 % BODY_POINT), (uint64_t)i + 1, 1.0f);
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 2 == 0 ? GAP_SHALLOW : GAP_DEEP, &pose_a, &pose_b);
        for (int k = 0; k < MOTIONS; k++) {
            try_motion(&random, &a, &b, pose_a, pose_b, motions[k], &tallies[k]);
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    for (int k = 0; k < MOTIONS; k++) {
        const motion_tally *t = &tallies[k];
        print_message("motion %g: of %u tried %u hold, %u are gone on with, %u wrong\n", (double)motions[k], t->tried,
                      t->held, t->resumed - t->held, t->wrong);
        TEST_CHECK(t->wrong == 0 && t->tried > 1000);
    }
    TEST_CHECK(tallies[3].resumed > tallies[3].tried * 9 / 10);
}

// A cache that no call left there is refused or proves what is true; it leads nowhere outside.
static void test_garbage(void **state)
{
    (void)state;
    test_random random = { 83 };
    const tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0.0f);
    uint32_t wrong = 0;
    for (uint32_t i = 0; i < 20000; i++) {
        const tl_transform pose_a = tl_transform_identity(),
                           pose_b = moved_by(&random, pose_a, test_random_range(&random, 0.0f, 2.0f));
        tl_polytope_cache cache;
        cache.point_count = (uint16_t)test_random_below(&random, 2 * TL_KEPT_POINTS);
        cache.face_count = (uint16_t)test_random_below(&random, 2 * TL_KEPT_FACES);
        for (uint32_t k = 0; k < TL_KEPT_POINTS; k++) {
            cache.vertices[k][0] = (uint16_t)test_random_below(&random, 9);
            cache.vertices[k][1] = (uint16_t)test_random_below(&random, 9);
        }
        for (uint32_t k = 0; k < TL_KEPT_FACES; k++) {
            for (uint32_t j = 0; j < 3; j++) {
                cache.corners[k][j] = (uint8_t)test_random_below(&random, 1 + TL_KEPT_POINTS);
            }
        }
        tl_minkowski pair;
        tl_core_depth depth;
        TEST_CHECK(tl_minkowski_init(&pair, &box, &pose_a, &box, &pose_b));
        wrong += tl_epa_resume(&pair, &cache, &depth) && !tl_convex_overlap(&box, pose_a, &box, pose_b, NULL);
    }
    TEST_CHECK(wrong == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_proven),
        cmocka_unit_test(test_garbage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
