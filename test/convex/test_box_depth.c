// SPDX-License-Identifier: MIT
//
// The depth of two boxes by their 15 axes, against GJK and EPA; boxes that are nearly parallel, flat or thin too.

#include "talus_test.h"

#include "base/cpu.h"
#include "convex/contact/box_axes.h"
#include "convex/contact/contact_axis.h"

#include <string.h>

static tl_quat random_rotation(test_random *random, float spread)
{
    tl_vec3 axis = tl_scale(test_random_direction(random), spread);
    return tl_quat_normalize((tl_quat){ axis.x, axis.y, axis.z, 1.0f });
}

static void test_depth(void **state)
{
    (void)state;
    static const float spreads[] = { 0.0f, 1e-7f, 1e-5f, 1e-3f, 1.0f, 1.0f };
    test_random random = { 71 };
    uint32_t deep = 0, apart = 0, edges = 0;
    for (int i = 0; i < 60000; i++) {
        tl_vec3 half_a = test_random_point(&random, tl_vec3_make(.1f, .1f, .1f), tl_vec3_make(1, 1, 1)),
                half_b = test_random_point(&random, tl_vec3_make(.1f, .1f, .1f), tl_vec3_make(1, 1, 1));
        half_b.y = i % 7 == 0 ? 0.0f : half_b.y;
        tl_convex a = tl_convex_box(tl_scale(test_random_direction(&random), 0.1f), half_a, 0.0f),
                  b = tl_convex_box(tl_scale(test_random_direction(&random), 0.1f), half_b, 0.0f);
        tl_transform pose_a = { random_rotation(&random, 1.0f), { 3, 2, 1 } }, pose_b = pose_a;
        pose_b.rotation = tl_quat_normalize(tl_quat_mul(pose_a.rotation, random_rotation(&random, spreads[i % 6])));
        pose_b.position =
            tl_mul_add(pose_a.position, test_random_direction(&random), test_random_range(&random, 0.1f, 2.0f));
        tl_minkowski pair;
        TEST_CHECK(tl_minkowski_init(&pair, &a, &pose_a, &b, &pose_b));
        tl_deepest found;
        tl_box box_a, box_b;
        TEST_CHECK(tl_box_of(&a, &box_a) && tl_box_of(&b, &box_b));
        tl_box_depth(&pair, &box_a, &box_b, &found);
        tl_separation s;
        tl_penetration p;
        if (tl_convex_penetration(&a, pose_a, &b, pose_b, NULL, &p) && p.depth > 1e-6f) {
            TEST_CHECK(fabs(-found.separation - (double)p.depth) <= 2e-6 && found.lower_depth <= (double)p.upper_bound);
            TEST_CHECK(found.lower_depth >= -found.separation - 2e-6);
            tl_minkowski_point support;
            tl_minkowski_support(&pair, found.normal, &support);
            TEST_CHECK(fabs(tl_vec3d_dot(support.w, found.normal) + found.separation) <= 1e-9);
            if (found.has_points) {
                tl_vec3d off =
                    tl_vec3d_sub(tl_vec3d_sub(found.on_a, found.on_b), tl_vec3d_scale(found.normal, -found.separation));
                TEST_CHECK(tl_vec3d_length(off) < 1e-6);
                edges++;
            }
            deep++;
        } else if (found.separation > 0.0) {
            tl_convex_distance(&a, pose_a, &b, pose_b, NULL, &s);
            TEST_CHECK(found.separation <= (double)s.distance + 1e-6 && s.distance > 0.0f);
            apart++;
        }
    }
    print_message("deep %u (edges %u), apart %u\n", deep, edges, apart);
    TEST_CHECK(deep > 20000 && edges > 2000 && apart > 5000);
}

// The hull of a box's corners is that box; one corner off, it is not.
static void test_hulls_of_boxes(void **state)
{
    (void)state;
    for (int off = 0; off < 2; off++) {
        tl_vec3 corners[8];
        for (int k = 0; k < 8; k++) {
            corners[k] = tl_vec3_make(k & 1 ? 3.0f : 1.0f, k & 2 ? 2.5f : -1.5f, k & 4 ? 0.5f : 0.25f);
        }
        corners[7].x += off != 0 ? 1e-3f : 0.0f;
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(corners, 8, NULL, &hull, NULL), TL_OK);
        tl_convex shape = tl_convex_from_hull(hull, 0.0f);
        tl_box box;
        TEST_CHECK(tl_box_of(&shape, &box) == (off == 0));
        TEST_CHECK(off != 0 ||
                   (box.middle.x == 2.0 && box.middle.y == 0.5 && box.half.y == 2.0 && box.half.z == 0.125));
        tl_blob_free(hull);
    }
}

#if TL_CPU_LEVELS >= 2

static void random_vector(test_random *random, double out[4])
{
    for (int i = 0; i < 3; i++) {
        out[i] = (double)(float)test_random_range(random, -1.0f, 1.0f);
    }
    out[3] = 0.0;
}

// Plain C and AVX2 find the same bits.
static void test_levels(void **state)
{
    (void)state;
    test_random random = { 72 };
    for (int i = 0; i < 20000 && tl_cpu_has_avx2(); i++) {
        tl_box_axes base, best;
        memset(&base, 0, sizeof base);
        random_vector(&random, base.half_a);
        random_vector(&random, base.half_b);
        random_vector(&random, base.apart);
        for (int k = 0; k < 3; k++) {
            random_vector(&random, base.turn[k]);
            random_vector(&random, base.columns[k]);
        }
        if (i % 3 == 0) { // parallel to an axis
            memset(base.turn, 0, sizeof base.turn);
            base.turn[0][1] = base.turn[1][2] = base.turn[2][0] = 1.0;
        }
        best = base;
        tl_box_axes_base(&base);
        tl_box_axes_avx2(&best);
        for (int k = 0; k < TL_BOX_AXES; k++) {
            TEST_CHECK(memcmp(&base.depths[k / 3][k % 3], &best.depths[k / 3][k % 3], sizeof(double)) == 0);
        }
    }
}

#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
#if TL_CPU_LEVELS >= 2
        cmocka_unit_test(test_levels),
#endif
        cmocka_unit_test(test_depth),
        cmocka_unit_test(test_hulls_of_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
