// SPDX-License-Identifier: MIT
//
// Rays and points against a hull, compared with exact sidedness of every face's triangles.

#include "talus_test.h"

#include "hull/ray/hull_ray.h"
#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/convex.h>
#include <talus/hull.h>

#include <string.h>

static void test_rays_agree_with_sidedness(void **state)
{
    (void)state;
    tl_vec3 points[60];
    uint32_t hits = 0, misses = 0, inside = 0, grazing = 0;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        test_random random = { (uint64_t)kind + 1 };
        shape_make((shape_kind)kind, &random, points, 60);
        // Far away on some kinds: exact in floats, as the lattice has whole coordinates there.
        tl_vec3 offset = kind == SHAPE_GRID ? tl_vec3_make(1e5f, -2e5f, 5e4f) : tl_vec3_make(0, 0, 0);
        for (int i = 0; i < 60; i++) {
            points[i] = tl_add(points[i], offset);
        }
        tl_hull_def def = tl_default_hull_def();
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 60, &def, &hull, NULL), TL_OK);
        tl_vec3 middle = tl_aabb_center(hull->bounds), size = tl_aabb_size(hull->bounds);
        const tl_vec3 *v = tl_hull_vertices(hull);
        for (int i = 0; i < 4000; i++) {
            tl_vec3 u = test_random_point(&random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
            tl_vec3 w = test_random_point(&random, tl_vec3_make(-0.6f, -0.6f, -0.6f), tl_vec3_make(0.6f, 0.6f, 0.6f));
            tl_vec3 origin = tl_add(middle, tl_mul(u, size));
            tl_vec3 target = tl_add(middle, tl_mul(w, size));
            tl_vec3 direction = tl_sub(target, origin);
            // The faces that the whole line enters through, exactly.
            uint32_t entry = TL_NO_VERTEX;
            bool edge = false;
            for (uint32_t f = 0; f < hull->face_count; f++) {
                tl_hull_face face = tl_hull_face_at(hull, f);
                bool all = true;
                for (uint32_t k = 0; k < face.count && all; k++) {
                    const tl_hull_half_edge h = tl_hull_edge_at(hull, face.first + k);
                    tl_vec3 a = v[h.origin], b = v[tl_hull_edge_origin(hull, h.next)];
                    int side = tl_line_side(origin, direction, a, b);
                    // Entering, the line passes the counter-clockwise edges on the right of its direction.
                    all = side <= 0;
                    edge = edge || side == 0;
                }
                if (all) {
                    entry = f;
                }
            }
            tl_hull_hit hit;
            bool starts_inside = tl_hull_contains(hull, origin);
            bool found = tl_hull_cast_ray(hull, origin, direction, 3e38f, &hit);
            if (edge) {
                grazing++;
                continue;
            }
            if (starts_inside) {
                inside++;
                TEST_CHECK(found && hit.t == 0.0f && hit.face == TL_NO_VERTEX);
                continue;
            }
            // The hull may lie behind the origin.
            if (found) {
                hits++;
                TEST_CHECK(hit.face == entry && hit.t > 0.0f && tl_dot(hit.normal, direction) < 0.0f);
                tl_hull_hit again;
                TEST_CHECK(!tl_hull_cast_ray(hull, origin, direction, hit.t * 0.999f, &again));
                TEST_CHECK(tl_hull_cast_ray(hull, origin, direction, hit.t * 1.001f, &again));
            } else {
                misses++;
                TEST_CHECK(entry == TL_NO_VERTEX || tl_hull_cast_ray(hull, origin, tl_neg(direction), 3e38f, NULL));
            }
        }
        tl_blob_free(hull);
    }
    TEST_CHECK(hits > 10000 && misses > 5000 && inside > 500 && grazing < 500);
}

// Every instruction set gives the bits of the scalar kernel.
static void test_kernels_agree(void **state)
{
    (void)state;
    tl_vec3 points[200];
    uint32_t hits = 0, misses = 0, inside = 0, kernels = 0;
    static const uint32_t counts[] = { 4, 5, 6, 8, 20, 32, 100, 200 };
    static const int exponents[] = { 0, 0, -40, 90 };
    for (int level = 1; level <= 3; level++) {
        kernels += tl_ray_planes_for(level) != NULL;
    }
    for (uint32_t c = 0; c < 4 * (uint32_t)(sizeof counts / sizeof *counts); c++) {
        test_random random = { c };
        uint32_t count = shape_make(c % 8 < 4 ? SHAPE_SPHERE : SHAPE_CUBE_SURFACE, &random, points, counts[c / 4]);
        for (uint32_t i = 0; i < count; i++) {
            points[i] = tl_scale(points[i], ldexpf(1.0f, exponents[c % 4]));
        }
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
        double size = (double)tl_maxf(hull->bounds.max.x, -hull->bounds.min.x);
        for (int i = 0; i < 4000; i++) {
            double o[3], d[3], t[4] = { 0.0 }, max_t = i % 5 == 0 ? (double)INFINITY : 1.0;
            uint32_t face[4] = { 0 };
            for (int k = 0; k < 3; k++) {
                o[k] = size * (double)test_random_range(&random, -2.0f, 2.0f);
                d[k] = size * (double)test_random_range(&random, -0.7f, 0.7f) - o[k];
                d[k] = i % 7 == 0 && k > 0 ? 0.0 : d[k];
            }
            bool hit = tl_ray_planes_scalar(hull, o, d, max_t, &t[0], &face[0]);
            for (int level = 1; level <= 3; level++) {
                tl_ray_planes_fn *kernel = tl_ray_planes_for(level);
                TEST_CHECK(kernel == NULL || kernel(hull, o, d, max_t, &t[level], &face[level]) == hit);
                TEST_CHECK(kernel == NULL || !hit ||
                           (memcmp(&t[0], &t[level], sizeof t[0]) == 0 && face[0] == face[level]));
            }
            inside += hit && face[0] == TL_NO_VERTEX;
            hits += hit;
            misses += !hit;
        }
        tl_blob_free(hull);
    }
    print_message("%u kernels beside the scalar one\n", kernels);
    TEST_CHECK(hits > 30000 && misses > 30000 && inside > 1000);
}

// A posed hull is cast at by its planes, the cloud of its vertices by GJK: the same answers.
static void test_posed_hulls_agree_with_clouds(void **state)
{
    (void)state;
    tl_vec3 points[40];
    uint32_t hits = 0, misses = 0;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        test_random random = { (uint64_t)kind };
        shape_make((shape_kind)kind, &random, points, 40);
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 40, NULL, &hull, NULL), TL_OK);
        tl_convex planes = tl_convex_from_hull(hull, 0.0f);
        tl_convex cloud = tl_convex_from_points(tl_hull_vertices(hull), hull->vertex_count, 0.0f);
        tl_vec3 size = tl_aabb_size(hull->bounds);
        float reach = tl_maxf(size.x, tl_maxf(size.y, size.z));
        for (int i = 0; i < 300; i++) {
            tl_transform pose = tl_transform_identity();
            pose.position = tl_scale(test_random_direction(&random), 100.0f * reach);
            tl_vec3 axis = test_random_direction(&random);
            tl_quat turn = { axis.x, axis.y, axis.z, test_random_range(&random, -1.0f, 1.0f) };
            pose.rotation = tl_quat_normalize(turn);
            tl_vec3 middle = tl_transform_point(pose, tl_aabb_center(hull->bounds));
            tl_vec3 origin = tl_add(middle, tl_scale(test_random_direction(&random), 3.0f * reach));
            tl_vec3 target = tl_add(middle, tl_scale(test_random_direction(&random), 0.4f * reach));
            tl_vec3 direction = tl_sub(target, origin);
            tl_convex_hit a, b;
            bool hit = tl_convex_cast_ray(&planes, pose, origin, direction, INFINITY, &a);
            TEST_CHECK(a.status == TL_CONVEX_CONVERGED && a.gap == 0.0f);
            // What passes closer than the gap may be said to hit.
            bool near = tl_convex_cast_ray(&cloud, pose, origin, direction, INFINITY, &b);
            TEST_CHECK(near || !hit);
            if (hit) {
                hits++;
                float slope = -tl_dot(a.normal, tl_normalize(direction));
                TEST_CHECK(slope > 0.0f);
                TEST_CHECK(fabsf(a.t - b.t) * tl_length(direction) * slope <= 2e-6f * reach);
                TEST_CHECK(tl_distance(a.point, tl_mul_add(origin, direction, a.t)) <= 1e-4f * reach);
            }
            misses += !hit && !near;
        }
        tl_blob_free(hull);
    }
    TEST_CHECK(hits > 1000 && misses > 500);
}

static void test_contains_is_exact(void **state)
{
    (void)state;
    tl_vec3 cube[8];
    for (int i = 0; i < 8; i++) {
        cube[i] = tl_vec3_make(i & 1 ? 3.0f : 0.1f, i & 2 ? 3.0f : 0.1f, i & 4 ? 3.0f : 0.1f);
    }
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(cube, 8, &def, &hull, NULL), TL_OK);
    for (int i = 0; i < 8; i++) {
        TEST_CHECK(tl_hull_contains(hull, cube[i]));
    }
    TEST_CHECK(tl_hull_contains(hull, tl_vec3_make(0.1f, 1, 2)));
    TEST_CHECK(!tl_hull_contains(hull, tl_vec3_make(nextafterf(0.1f, 0), 1, 2)));
    TEST_CHECK(!tl_hull_contains(hull, tl_vec3_make(1, nextafterf(3.0f, 4), 2)));
    tl_blob_free(hull);
}

static void test_mass_of_known_bodies(void **state)
{
    (void)state;
    // A tetrahedron far away: volume 1/6, centre at a quarter.
    tl_vec3 corners[4] = {
        { 1e6f, 1e6f, 1e6f }, { 1000001.0f, 1e6f, 1e6f }, { 1e6f, 1000001.0f, 1e6f }, { 1e6f, 1e6f, 1000001.0f }
    };
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(corners, 4, &def, &hull, NULL), TL_OK);
    TEST_CHECK(fabs(hull->mass.volume - 1.0 / 6.0) < 1e-15);
    for (int i = 0; i < 3; i++) {
        TEST_CHECK(fabs(hull->mass.center[i] - 1000000.25) < 1e-9);
        // Second moments of the unit corner tetrahedron about its centre: xx 1/160, xy -1/480.
        TEST_CHECK(fabs(hull->mass.inertia[i] - 2.0 / 160.0) < 1e-15);
        TEST_CHECK(fabs(hull->mass.inertia[i + 3] - 1.0 / 480.0) < 1e-15);
    }
    tl_blob_free(hull);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_agree_with_sidedness),     cmocka_unit_test(test_kernels_agree),
        cmocka_unit_test(test_posed_hulls_agree_with_clouds), cmocka_unit_test(test_contains_is_exact),
        cmocka_unit_test(test_mass_of_known_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
