// SPDX-License-Identifier: MIT
//
// Scaled instances (scene_layout.h, instance_box.c): rays against the exact planes of scaled, turned triangles; shapes
// and points against instances of soups that were baked of scaled corners, bit by bit; scales that change; scales that
// are refused. test_scene_cast_ray and test_scene_queries mix scaled instances with others. An argument sets the number
// of queries a scale.

#include "scene_models.h"

#include "math/tolerance.h"

static uint32_t query_count = 150;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

enum { SCALES = 10 };

static const tl_vec3 scales[SCALES] = { { 2, 2, 2 },           { 1.3f, 1.3f, 1.3f },    { 1, 2.7f, 0.4f },
                                        { -1, 1, 1 },          { -1.1f, -1.2f, -0.9f }, { -2, -2, 1 },
                                        { 40, 1, 0.05f },      { 1e-6f, 1e-6f, 1e-6f }, { 3e5f, -3e5f, 3e5f },
                                        { 3e-3f, -0.3f, 7.0f } };

static tl_scene_instance place(const tl_soup *soup, tl_vec3 scale, test_random *random, uint32_t k)
{
    tl_scene_instance instance = { .soup = soup, .mask = 1, .scale = scale };
    tl_vec3 far = k % 2 ? vec(1, 1, 1) : vec(1000, 300, 2000);
    instance.pose.position = test_random_point(random, tl_neg(far), far);
    if (k % 3 != 0) {
        instance.pose.rotation = scene_rotation(random);
    }
    return instance;
}

static tl_vec3d corner_out(const tl_scene_instance *instance, tl_vec3 corner)
{
    tl_frame frame = tl_frame_from(instance->pose);
    tl_vec3d s = tl_vec3d_from(instance->scale), c = tl_vec3d_from(corner);
    return tl_frame_point(&frame, tl_vec3d_mul(s, c));
}

typedef struct ray_regimes {
    uint32_t rays;
    double worst, worst_normal;
} ray_regimes;

// The outer normal of a triangle in the world.
static tl_vec3d plane_out(const tl_scene_instance *instance, const model *m, uint32_t triangle, tl_vec3d *point)
{
    const uint32_t *k = m->indices + 3 * (size_t)triangle;
    tl_vec3d a = corner_out(instance, m->vertices[k[0]]), b = corner_out(instance, m->vertices[k[1]]);
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(corner_out(instance, m->vertices[k[2]]), a));
    *point = a;
    return tl_vec3d_scale(n, (tl_scale_is_mirrored(instance->scale) ? -1 : 1) / tl_vec3d_length(n));
}

// The point at t lies in the triangle's plane, as near as the header says, and the normal is the outer one.
static void check_ray_hit(const tl_scene_instance *instance, const model *m, const tl_ray *ray, const tl_scene_hit *hit,
                          ray_regimes *r)
{
    tl_vec3d on;
    tl_vec3d normal = plane_out(instance, m, hit->hit.triangle, &on);
    tl_vec3d at = tl_vec3d_mul_add(tl_vec3d_from(ray->origin), tl_vec3d_from(ray->direction), (double)hit->hit.t);
    double off = fabs(tl_vec3d_dot(normal, tl_vec3d_sub(at, on)));
    double way = (double)hit->hit.t * tl_vec3d_length(tl_vec3d_from(ray->direction));
    double share = tl_vec3d_length(tl_vec3d_from(scene_point_in(instance, ray->origin))) + way;
    double bound = (double)TL_FLOAT_ROUNDING * (1.001 * share + 1.25 * way);
    TEST_CHECK(off <= bound);
    r->worst = off / bound > r->worst ? off / bound : r->worst;
    tl_vec3 size = tl_abs(instance->scale);
    double ratio = (double)tl_maxf(size.x, tl_maxf(size.y, size.z)) / (double)tl_minf(size.x, tl_minf(size.y, size.z));
    double turned = tl_vec3d_length(tl_vec3d_sub(tl_vec3d_from(hit->hit.normal), normal));
    bound = 3.0 * (double)TL_FLOAT_ROUNDING * ratio;
    TEST_CHECK(turned <= bound && hit->hit.back);
    r->worst_normal = turned / bound > r->worst_normal ? turned / bound : r->worst_normal;
    r->rays++;
}

// From inside of closed balls at their corners and edges: every ray hits a back.
static void test_rays_at_exact_planes(void **state)
{
    (void)state;
    test_random random = { 6 };
    ray_regimes r = { 0, 0, 0 };
    model m = model_ball(2, 1, 0.05f, vec(0.3f, -0.2f, 0.1f), 3);
    tl_soup *soup = model_soup(&m, NULL);
    for (uint32_t k = 0; k < 6 * SCALES; k++) {
        tl_scene_instance instance = place(soup, scales[k % SCALES], &random, k);
        if (k % SCALES == 7) {
            instance.pose.position = vec(0, 1e-6f, 0); // else it is smaller than a step of its coordinates
        }
        tl_scene *scene = scene_build(&instance, 1);
        for (uint32_t i = 0; i < query_count; i++) {
            const uint32_t *corner = m.indices + 3 * (size_t)test_random_below(&random, m.triangle_count);
            tl_vec3 target =
                tl_lerp(m.vertices[corner[0]], m.vertices[corner[1]], i % 3 == 0 ? 0.0f : test_random_unit(&random));
            tl_vec3 inside = tl_mul_add(vec(0.3f, -0.2f, 0.1f), test_random_direction(&random), 0.5f);
            tl_vec3 from = tl_vec3d_to_float(corner_out(&instance, inside));
            tl_vec3 to = tl_vec3d_to_float(corner_out(&instance, target));
            tl_ray ray = { from, tl_sub(to, from), INFINITY };
            tl_scene_hit hit;
            if (ray.direction.x == 0 && ray.direction.y == 0 && ray.direction.z == 0) {
                continue;
            }
            TEST_CHECK(tl_scene_cast_ray(scene, &instance, &ray, NULL, &hit));
            TEST_CHECK(tl_scene_occluded(scene, &instance, &ray, NULL));
            check_ray_hit(&instance, &m, &ray, &hit, &r);
            tl_vec3 beyond = tl_mul_add(from, ray.direction, 1.5f * hit.hit.t);
            TEST_CHECK(!tl_scene_line_of_sight(scene, &instance, from, beyond, NULL));
        }
        tl_blob_free(scene);
    }
    print_message("%u rays, worst error %.2f of its bound, of normals %.2f\n", r.rays, r.worst, r.worst_normal);
    TEST_CHECK(r.rays > 50 * query_count && r.worst > 0.05 && r.worst_normal > 0.05);
    tl_blob_free(soup);
    model_free(&m);
}

// Powers of two round nothing: a ray has the bits of a soup of scaled corners.
static void test_powers_of_two(void **state)
{
    (void)state;
    test_random random = { 8 };
    const tl_vec3 powers[3] = { { 2, 2, 2 }, { 0.25f, 8, 1 }, { -4, 0.5f, 4 } };
    model m = model_ball(2, 1, 0.1f, vec(0, 0, 0), 5);
    tl_soup *soup = model_soup(&m, NULL);
    uint32_t hits = 0;
    for (uint32_t k = 0; k < 3; k++) {
        model larger = model_scaled(&m, powers[k]);
        tl_soup *baked = model_soup(&larger, NULL);
        tl_scene_instance instance = { .soup = soup, .mask = 1, .scale = powers[k] };
        tl_scene *scene = scene_build(&instance, 1);
        for (uint32_t i = 0; i < 10 * query_count; i++) {
            tl_ray ray = { test_random_point(&random, vec(-9, -9, -9), vec(9, 9, 9)), vec(0, 0, 0), INFINITY };
            ray.direction = tl_sub(tl_mul(test_random_direction(&random), powers[k]), ray.origin);
            tl_ray_hit expected;
            tl_scene_hit hit;
            bool met = tl_soup_cast_ray(baked, &ray, NULL, &expected);
            TEST_CHECK(tl_scene_cast_ray(scene, &instance, &ray, NULL, &hit) == met);
            if (met) {
                TEST_CHECK(hit.hit.t == expected.t && hit.hit.triangle == expected.triangle);
                TEST_CHECK(hit.hit.back == expected.back && tl_dot(hit.hit.normal, expected.normal) > 0.999999f);
                hits++;
            }
        }
        tl_blob_free(scene);
        tl_blob_free(baked);
        model_free(&larger);
    }
    TEST_CHECK(hits > 10 * query_count);
    tl_blob_free(soup);
    model_free(&m);
}

typedef struct twins {
    tl_scene_instance instances[2]; // the soup at a scale; a soup of scaled corners
    tl_scene *scenes[2];
} twins;

static void check_shapes(const twins *t, const tl_convex *shape, tl_transform pose, tl_vec3 motion, uint32_t *touched,
                         uint32_t *hits)
{
    tl_scene_shape_hit hit[2];
    static tl_scene_overlap overlaps[2][500];
    uint32_t count[2];
    tl_result result[2];
    for (int i = 0; i < 2; i++) {
        const tl_scene_overlap_query query = { shape, pose, NULL };
        result[i] = tl_scene_cast_shape(t->scenes[i], &t->instances[i], shape, pose, motion, NULL, &hit[i]);
        TEST_RESULT(tl_scene_find_overlaps(t->scenes[i], &t->instances[i], &query, overlaps[i], 500, &count[i]), TL_OK);
        bool any;
        TEST_RESULT(tl_scene_overlaps(t->scenes[i], &t->instances[i], &query, &any), TL_OK);
        TEST_CHECK(any == (count[i] > 0));
    }
    TEST_RESULT(result[0], result[1]);
    TEST_CHECK(memcmp(&hit[0], &hit[1], sizeof hit[0]) == 0);
    TEST_CHECK(count[0] == count[1]);
    *touched += count[0] > 0;
    *hits += result[0] == TL_OK;
}

static void check_nearest(const twins *t, tl_vec3 at)
{
    tl_scene_point found[2];
    for (int i = 0; i < 2; i++) {
        TEST_RESULT(tl_scene_nearest(t->scenes[i], &t->instances[i], at, INFINITY, NULL, &found[i]), TL_OK);
        found[i].point.feature = TL_TRIANGLE_FACE; // the view's corners are others where it is mirrored
    }
    TEST_CHECK(memcmp(&found[0], &found[1], sizeof found[0]) == 0);
}

static void test_shapes_at_scaled_corners(void **state)
{
    (void)state;
    test_random random = { 12 };
    model m = model_ball(2, 1, 0.2f, vec(1, 0, 0), 3);
    tl_soup *soup = model_soup(&m, NULL);
    uint32_t touched = 0, hits = 0;
    for (uint32_t k = 0; k < 3 * SCALES; k++) {
        model larger = model_scaled(&m, scales[k % SCALES]);
        tl_soup *baked = model_soup(&larger, NULL);
        twins t;
        t.instances[0] = t.instances[1] = place(soup, scales[k % SCALES], &random, k);
        t.instances[1].soup = baked;
        t.instances[1].scale = vec(0, 0, 0);
        t.scenes[0] = scene_build(&t.instances[0], 1);
        t.scenes[1] = scene_build(&t.instances[1], 1);
        tl_aabb box = tl_scene_bounds(t.scenes[1]);
        float size = tl_length(tl_aabb_size(box));
        const tl_convex shapes[3] = { tl_convex_capsule(vec(0, 0, 0), vec(0, 0.1f * size, 0), 0.03f * size),
                                      tl_convex_box(vec(0, 0, 0), tl_scale(vec(0.1f, 0.02f, 0.04f), size), 0),
                                      tl_convex_sphere(vec(0, 0, 0), 0.05f * size) };
        for (uint32_t i = 0; i < query_count; i++) {
            tl_transform pose = { scene_rotation(&random), test_random_point(&random, box.min, box.max) };
            check_shapes(&t, &shapes[i % 3], pose, tl_scale(test_random_direction(&random), 0.4f * size), &touched,
                         &hits);
            check_nearest(&t, tl_mul_add(pose.position, test_random_direction(&random), 0.3f * size));
        }
        tl_blob_free(t.scenes[0]);
        tl_blob_free(t.scenes[1]);
        tl_blob_free(baked);
        model_free(&larger);
    }
    print_message("touched %u, hits %u\n", touched, hits);
    TEST_CHECK(touched > 5 * query_count && hits > 8 * query_count);
    tl_blob_free(soup);
    model_free(&m);
}

// A scale that changes takes a refit, and then is that of a fresh bake.
static void test_refit(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    tl_scene_instance instance = { .soup = parts.soups[0], .mask = 1 };
    tl_scene *scene = scene_build(&instance, 1);
    const tl_ray down = { { 0.05f, 50, 0.07f }, { 0, -1, 0 }, INFINITY };
    tl_scene_hit before, hit, fresh;
    TEST_CHECK(tl_scene_cast_ray(scene, &instance, &down, NULL, &before));
    instance.scale = vec(3, 3, 3);
    TEST_CHECK(tl_scene_cast_ray(scene, &instance, &down, NULL, &hit) && hit.hit.t == before.hit.t);
    TEST_RESULT(tl_scene_refit(scene, &instance, 1, NULL, NULL), TL_OK);
    TEST_CHECK(tl_scene_cast_ray(scene, &instance, &down, NULL, &hit) && hit.hit.t < before.hit.t - 1);
    tl_scene *again = scene_build(&instance, 1);
    TEST_CHECK(tl_scene_cast_ray(again, &instance, &down, NULL, &fresh));
    TEST_CHECK(memcmp(&hit.hit, &fresh.hit, sizeof hit.hit) == 0);
    tl_blob_free(again);
    // A bad scale leaves the scene as it was.
    tl_report report;
    instance.scale.y = 0;
    TEST_RESULT(tl_scene_refit(scene, &instance, 1, NULL, &report), TL_ERR_RANGE);
    TEST_CHECK(report.element_index == 0 && strcmp(report.element, "instance") == 0);
    TEST_CHECK(tl_scene_cast_ray(scene, &instance, &down, NULL, &hit) && hit.hit.t == fresh.hit.t);
    // All zero and all one are the same scene, byte by byte.
    instance.scale = vec(0, 0, 0);
    tl_scene *zero = scene_build(&instance, 1);
    instance.scale = vec(1, 1, 1);
    again = scene_build(&instance, 1);
    TEST_CHECK(memcmp(zero, again, (size_t)tl_scene_get_stats(zero).size) == 0);
    tl_blob_free(zero);
    tl_blob_free(again);
    tl_blob_free(scene);
    scene_parts_free(&parts);
}

static void check_refused(tl_scene_instance instance, tl_vec3 scale, tl_result why)
{
    instance.scale = scale;
    tl_scene *scene;
    tl_report report;
    TEST_RESULT(tl_scene_bake(&instance, 1, NULL, &scene, &report), why);
    TEST_CHECK(scene == NULL && strcmp(report.element, "instance") == 0 && report.advice != NULL);
}

static void test_refused(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    const tl_scene_instance soup = { .soup = parts.soups[0], .mask = 1 }, ball = { .shape = &parts.shapes[3] },
                            tower = { .shape = &parts.shapes[6] }, crate = { .shape = &parts.shapes[2] };
    check_refused(soup, vec(0, 1, 1), TL_ERR_RANGE);
    check_refused(soup, vec(1, 1, -0.0f), TL_ERR_RANGE);
    check_refused(soup, vec(1, 1, 1.1e6f), TL_ERR_RANGE);
    check_refused(soup, vec(1, 9e-7f, 1), TL_ERR_RANGE);
    check_refused(soup, vec(1e-44f, 1, 1), TL_ERR_RANGE);
    check_refused(soup, vec(NAN, 1, 1), TL_ERR_NOT_FINITE);
    check_refused(soup, vec(1, -INFINITY, 1), TL_ERR_NOT_FINITE);
    check_refused(crate, vec(1, 0, 1), TL_ERR_RANGE);
    check_refused(ball, vec(1, 2, 1), TL_ERR_ARGUMENT);
    check_refused(tower, vec(1, 1, 2), TL_ERR_ARGUMENT);
    tl_convex huge = tl_convex_box(vec(0, 0, 0), vec(1e8f, 1, 1), 0);
    const tl_scene_instance far = { .shape = &huge };
    check_refused(far, vec(1e5f, 1, 1), TL_ERR_RANGE);
    scene_parts_free(&parts);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        query_count = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays_at_exact_planes),
        cmocka_unit_test(test_powers_of_two),
        cmocka_unit_test(test_shapes_at_scaled_corners),
        cmocka_unit_test(test_refit),
        cmocka_unit_test(test_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
