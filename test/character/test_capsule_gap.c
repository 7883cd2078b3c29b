// SPDX-License-Identifier: MIT
//
// The distance of a core from triangles, against GJK and, where they cross, against the ways out; and from shapes.

#include "character/capsule_gap.h"
#include "talus_test.h"

#include <string.h>
#include <talus/convex.h>

enum { ROUNDS = 40000 };

static tl_mover_item item_of(const tl_vec3 corners[3])
{
    tl_mover_item item;
    memset(&item, 0, sizeof item);
    for (int k = 0; k < 3; k++) {
        item.corners[k] = tl_vec3d_from(corners[k]);
    }
    tl_mover_set_triangle(&item);
    return item;
}

static double gjk_distance(const tl_convex *shape, tl_transform pose, const tl_mover_core *core, bool *overlap)
{
    tl_transform at = { { 0, 0, 0, 1 }, tl_vec3d_to_float(core->low) };
    tl_convex segment = tl_convex_capsule(tl_vec3_make(0, 0, 0), tl_vec3_make(0, (float)core->length, 0), 0.0f);
    tl_separation s;
    tl_convex_distance(shape, pose, &segment, at, NULL, &s);
    *overlap = s.overlap;
    return (double)s.distance;
}

static void test_triangles(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint32_t faces = 0, edges = 0, crossed = 0;
    const tl_vec3 low = { -1, -1, -1 }, high = { 1, 1, 1 };
    for (uint32_t i = 0; i < ROUNDS; i++) {
        tl_vec3 corners[3];
        for (int k = 0; k < 3; k++) {
            corners[k] = test_random_point(&random, low, high);
            if (i % 4 == 0) {
                corners[k].y = 0.25f; // level
            } else if (i % 4 == 1) {
                corners[k].x = 0.25f; // upright
            }
        }
        tl_mover_item item = item_of(corners);
        tl_vec3 at = test_random_point(&random, low, high);
        tl_mover_core core = { tl_vec3d_from(at), i % 8 < 6 ? 1.25 : 0.0, 0.25 };
        tl_mover_nearest nearest;
        tl_mover_nearest_of(&item, &core, (double)INFINITY, &nearest);
        bool overlap;
        tl_convex shape = tl_convex_triangle(corners[0], corners[1], corners[2], 0.0f);
        double distance = gjk_distance(&shape, tl_transform_identity(), &core, &overlap);
        TEST_CHECK(fabs(tl_vec3d_length(nearest.normal) - 1.0) < 1e-9);
        if (nearest.distance < 0.0) {
            crossed++;
            TEST_CHECK(overlap || distance < 1e-6);
            // Moved out by the depth it touches the plane, from the side of the normal.
            tl_mover_core out = core;
            out.low = tl_vec3d_mul_add(core.low, nearest.normal, 1e-6 - nearest.distance);
            tl_mover_nearest after;
            tl_mover_nearest_of(&item, &out, (double)INFINITY, &after);
            TEST_CHECK(after.distance >= 0.0 && (!after.face || after.distance < 2e-6));
        } else {
            TEST_CHECK(fabs(nearest.distance - distance) < 1e-6);
            faces += nearest.face;
            edges += !nearest.face;
        }
    }
    TEST_CHECK(faces > 1000 && edges > 10000 && crossed > 500);
}

static void test_shapes(void **state)
{
    (void)state;
    test_random random = { 4 };
    const tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.25f, 0.75f), 0.0f);
    uint32_t apart = 0, inside = 0;
    for (uint32_t i = 0; i < 2000; i++) {
        tl_vec3 at = test_random_point(&random, tl_vec3_make(-2, -2, -2), tl_vec3_make(2, 2, 2));
        tl_transform pose = { { 0, 0.6f, 0, 0.8f }, { 0.1f, 0.2f, 0.3f } };
        tl_mover_item item;
        memset(&item, 0, sizeof item);
        item.shape = &box;
        item.pose = &pose;
        tl_mover_core core = { tl_vec3d_from(at), 1.25, 0.25 };
        tl_mover_nearest nearest;
        tl_mover_nearest_of(&item, &core, (double)INFINITY, &nearest);
        bool overlap;
        double distance = gjk_distance(&box, pose, &core, &overlap);
        TEST_CHECK(overlap ? nearest.distance <= 1e-6 : fabs(nearest.distance - distance) < 1e-5);
        apart += !overlap;
        inside += overlap;
    }
    TEST_CHECK(apart > 500 && inside > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_triangles),
        cmocka_unit_test(test_shapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
