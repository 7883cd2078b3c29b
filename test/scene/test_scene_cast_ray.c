// SPDX-License-Identifier: MIT
//
// scene/scene_cast_ray.c and the walk: against each instance queried in turn, on all instruction sets; nothing slips
// through between triangles of a rotated instance. An argument sets the number of rays a scene.

#include "scene_models.h"

#include "math/tolerance.h"
#include "scene/scene_walk.h"

static uint32_t ray_count = 1500;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

static bool cast_at_shape(const tl_scene_instance *instance, const tl_ray *ray, tl_convex_hit *found)
{
    if (tl_scale_is_one(instance->scale)) {
        return tl_convex_cast_ray(instance->shape, instance->pose, ray->origin, ray->direction, ray->tmax, found);
    }
    bool met = tl_convex_cast_ray(instance->shape, tl_transform_identity(), scene_ray_point_in(instance, ray->origin),
                                  scene_ray_direction_in(instance, ray->direction), ray->tmax, found);
    found->normal = scene_ray_normal_out(instance, found->normal);
    return met;
}

static bool touches_segment(const tl_scene_instance *instance, tl_vec3 a, tl_vec3 b)
{
    bool scaled = !tl_scale_is_one(instance->scale);
    a = scaled ? scene_ray_point_in(instance, a) : a;
    b = scaled ? scene_ray_point_in(instance, b) : b;
    bool before = b.x != a.x ? b.x < a.x : b.y != a.y ? b.y < a.y : b.z < a.z;
    tl_convex segment = tl_convex_capsule(before ? b : a, before ? a : b, 0);
    return tl_convex_overlap(instance->shape, scaled ? tl_transform_identity() : instance->pose, &segment,
                             tl_transform_identity(), NULL);
}

// What one instance says.
static bool ask_instance(const tl_scene_instance *instances, uint32_t i, const tl_ray *ray,
                         const tl_ray_filter *triangles, tl_scene_hit *hit)
{
    memset(hit, 0, sizeof *hit);
    hit->instance = i;
    if (instances[i].soup != NULL) {
        tl_ray local = { scene_ray_point_in(&instances[i], ray->origin),
                         scene_ray_direction_in(&instances[i], ray->direction), ray->tmax };
        bool met = tl_soup_cast_ray(instances[i].soup, &local, triangles, &hit->hit);
        hit->hit.normal = scene_ray_normal_out(&instances[i], hit->hit.normal);
        return met;
    }
    tl_convex_hit found;
    if (instances[i].shape == NULL || !cast_at_shape(&instances[i], ray, &found)) {
        return false;
    }
    hit->hit.t = found.t;
    hit->hit.normal = found.normal;
    hit->hit.triangle = TL_NO_TRIANGLE;
    hit->inside = found.initial_overlap;
    hit->status = found.status;
    return true;
}

static bool ask_all(const tl_scene_instance *instances, uint32_t count, const tl_ray *ray,
                    const tl_scene_filter *filter, tl_scene_hit *best)
{
    bool met = false;
    for (uint32_t i = 0; i < count; i++) {
        tl_scene_hit hit;
        if (scene_passes(filter, instances, i) &&
            ask_instance(instances, i, ray, filter != NULL ? filter->triangles : NULL, &hit) &&
            (!met || hit.hit.t < best->hit.t)) {
            *best = hit;
            met = true;
        }
    }
    return met;
}

static bool same_hit(const tl_scene_hit *a, const tl_scene_hit *b)
{
    return a->instance == b->instance && a->inside == b->inside && a->status == b->status && a->hit.t == b->hit.t &&
           a->hit.triangle == b->hit.triangle && a->hit.u == b->hit.u && a->hit.v == b->hit.v &&
           memcmp(&a->hit.normal, &b->hit.normal, sizeof a->hit.normal) == 0 && a->hit.back == b->hit.back &&
           a->hit.material == b->hit.material;
}

typedef struct regimes {
    uint32_t hits, misses, soups, shapes, inside, filtered, blocked, clear, ties;
} regimes;

static void check_sight(const tl_scene *scene, const tl_scene_instance *instances, uint32_t count, tl_vec3 a, tl_vec3 b,
                        const tl_scene_filter *filter, regimes *r)
{
    bool free = true;
    for (uint32_t i = 0; i < count && free; i++) {
        if (!scene_passes(filter, instances, i)) {
            continue;
        }
        if (instances[i].soup != NULL) {
            free =
                tl_soup_line_of_sight(instances[i].soup, scene_ray_point_in(&instances[i], a),
                                      scene_ray_point_in(&instances[i], b), filter != NULL ? filter->triangles : NULL);
        } else if (instances[i].shape != NULL) {
            free = !touches_segment(&instances[i], a, b);
        }
    }
    TEST_CHECK(tl_scene_line_of_sight(scene, instances, a, b, filter) == free);
    if (filter == NULL || filter->triangles == NULL) {
        TEST_CHECK(tl_scene_line_of_sight(scene, instances, b, a, filter) == free);
    }
    r->blocked += !free;
    r->clear += free;
}

static tl_ray random_ray(test_random *random, const tl_scene_instance *instances, uint32_t count, tl_aabb bounds)
{
    tl_vec3 margin = tl_scale(tl_aabb_size(bounds), 0.1f);
    tl_vec3 from = test_random_point(random, tl_sub(bounds.min, margin), tl_add(bounds.max, margin));
    tl_ray ray = { from, test_random_direction(random), INFINITY };
    uint32_t kind = test_random_below(random, 8);
    if (kind < 3 && count > 0) { // at an instance
        ray.direction = tl_sub(instances[test_random_below(random, count)].pose.position, from);
    } else if (kind == 3) { // along an axis
        ray.direction = vec(0, test_random_below(random, 2) ? -2.0f : 1.0f, 0);
    } else if (kind == 4) {
        ray.tmax = test_random_unit(random) * tl_length(tl_aabb_size(bounds));
    } else if (kind == 5) { // any length
        ray.direction = tl_scale(ray.direction, test_random_below(random, 2) ? 1e-20f : 3e20f);
    }
    return ray;
}

static void check_scene(const tl_scene *scene, const tl_scene_instance *instances, uint32_t count, uint32_t rays,
                        uint64_t seed, regimes *r)
{
    test_random random = { seed };
    tl_aabb bounds = tl_scene_bounds(scene);
    if (tl_aabb_is_empty(bounds)) {
        bounds.min = bounds.max = vec(0, 0, 0);
    }
    for (uint32_t k = 0; k < rays; k++) {
        tl_ray ray = random_ray(&random, instances, count, bounds);
        tl_scene_filter chosen;
        const tl_scene_filter *filter = scene_filter(&random, count, &chosen);
        tl_ray_filter fronts = { 0 };
        fronts.cull = TL_RAY_CULL_BACK;
        if (filter != NULL && k % 2 == 0) {
            chosen.triangles = &fronts;
        }
        tl_scene_hit expected, hit;
        bool met = ask_all(instances, count, &ray, filter, &expected);
        for (int level = 0; level < 3; level++) {
            tl_scene_walk_fn *walk = tl_scene_walk_for(level);
            if (walk != NULL) {
                TEST_CHECK(tl_scene_cast_ray_with(walk, scene, instances, &ray, filter, &hit) == met);
                TEST_CHECK(!met || same_hit(&hit, &expected));
                TEST_CHECK(tl_scene_cast_ray_with(walk, scene, instances, &ray, filter, NULL) == met);
            }
        }
        TEST_CHECK(tl_scene_cast_ray(scene, instances, &ray, filter, &hit) == met);
        TEST_CHECK(tl_scene_occluded(scene, instances, &ray, filter) == met);
        r->hits += met;
        r->misses += !met;
        r->filtered += filter != NULL;
        if (met) {
            TEST_CHECK(same_hit(&hit, &expected));
            r->soups += hit.hit.triangle != TL_NO_TRIANGLE;
            r->shapes += hit.hit.triangle == TL_NO_TRIANGLE;
            r->inside += hit.inside;
            // The end belongs to the ray.
            ray.tmax = hit.hit.t;
            if (hit.hit.triangle != TL_NO_TRIANGLE) {
                TEST_CHECK(tl_scene_cast_ray(scene, instances, &ray, filter, &hit) && same_hit(&hit, &expected));
            }
        }
        tl_vec3 to = test_random_point(&random, bounds.min, bounds.max);
        check_sight(scene, instances, count, ray.origin, to, filter, r);
    }
}

static void check_random_scene(const scene_parts *parts, uint32_t count, tl_vec3 center, float range, uint32_t rays,
                               regimes *r)
{
    test_random random = { count + 17 };
    tl_scene_instance *instances = malloc((count + 1) * sizeof *instances);
    TEST_CHECK(instances != NULL);
    for (uint32_t i = 0; i < count; i++) {
        instances[i] = scene_instance(parts, &random, center, range);
        if (i > 0 && i % 7 == 0) {
            instances[i] = instances[i - 1]; // the same thing in the same place
        }
    }
    tl_scene *scene = scene_build(instances, count);
    check_scene(scene, instances, count, rays, count, r);
    // Moved, refitted, and baked anew: answers are those of the instances.
    for (uint32_t i = 0; i < count; i += 1 + i % 3) {
        instances[i] = scene_instance(parts, &random, center, range * (i % 11 == 0 ? 3 : 1));
    }
    float growth;
    TEST_RESULT(tl_scene_refit(scene, instances, count, &growth, NULL), TL_OK);
    check_scene(scene, instances, count, rays, count + 1, r);
    tl_blob_free(scene);
    free(instances);
}

static void test_against_all_instances(void **state)
{
    (void)state;
    regimes r = { 0 };
    scene_parts parts;
    scene_parts_make(&parts, 1);
    check_random_scene(&parts, 0, vec(0, 0, 0), 1, ray_count / 10, &r);
    check_random_scene(&parts, 1, vec(0, 0, 0), 1, ray_count, &r);
    check_random_scene(&parts, 2, vec(5, 0, 0), 1, ray_count, &r);
    check_random_scene(&parts, 9, vec(0, 0, 0), 2, ray_count, &r);
    check_random_scene(&parts, 40, vec(0, 0, 0), 1.5f, ray_count, &r); // all over one another
    check_random_scene(&parts, 60, vec(3000, -100, 8000), 12, ray_count, &r);
    check_random_scene(&parts, 60, vec(3e7f, 0, -1e7f), 30, ray_count, &r);
    check_random_scene(&parts, 300, vec(0, 0, 0), 15, ray_count / 2, &r);
    check_random_scene(&parts, 10000, vec(0, 0, 0), 60, ray_count / 100, &r);
    scene_parts_free(&parts);
    scene_parts_make(&parts, 1e-6f);
    check_random_scene(&parts, 30, vec(0, 0, 0), 1e-5f, ray_count, &r);
    scene_parts_free(&parts);
    print_message("hits %u (soups %u, shapes %u, inside %u), misses %u, filtered %u; blocked %u, clear %u\n", r.hits,
                  r.soups, r.shapes, r.inside, r.misses, r.filtered, r.blocked, r.clear);
    TEST_CHECK(r.hits > ray_count && r.misses > ray_count && r.soups > ray_count / 2 && r.shapes > ray_count / 2);
    TEST_CHECK(r.inside > ray_count / 20 && r.filtered > ray_count && r.blocked > ray_count && r.clear > ray_count);
}

// Where no box can be told from another in float.
static void test_far_and_tiny_rays(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    test_random random = { 3 };
    tl_scene_instance instances[20];
    scene_fill(&parts, &random, vec(0, 0, 0), 3, instances, 20);
    tl_scene *scene = scene_build(instances, 20);
    uint32_t hits = 0;
    for (uint32_t k = 0; k < 400; k++) {
        tl_vec3 d = test_random_direction(&random);
        tl_ray ray = { tl_scale(d, -1e16f), d, INFINITY };
        if (k % 2 == 0) {
            ray.origin = test_random_point(&random, vec(-4, -4, -4), vec(4, 4, 4));
            ray.direction = tl_scale(d, k % 4 == 0 ? 1e-42f : 1e-32f);
        }
        tl_scene_hit expected, hit;
        bool met = ask_all(instances, 20, &ray, NULL, &expected);
        TEST_CHECK(tl_scene_cast_ray(scene, instances, &ray, NULL, &hit) == met);
        TEST_CHECK(!met || same_hit(&hit, &expected));
        hits += met;
    }
    TEST_CHECK(hits > 50);
    tl_ray bad[6] = { { vec(0, NAN, 0), vec(0, 1, 0), 1 },      { vec(0, 0, 0), vec(0, 0, 0), 1 },
                      { vec(0, 0, 0), vec(0, 1, 0), -1 },       { vec(0, 0, 0), vec(0, 1, 0), NAN },
                      { vec(0, 0, 0), vec(0, INFINITY, 0), 1 }, { vec(INFINITY, 0, 0), vec(0, 1, 0), 1 } };
    tl_scene_hit untouched = { .instance = 77 };
    for (uint32_t i = 0; i < 6; i++) {
        TEST_CHECK(!tl_scene_cast_ray(scene, instances, &bad[i], NULL, &untouched) && untouched.instance == 77);
        TEST_CHECK(!tl_scene_occluded(scene, instances, &bad[i], NULL));
    }
    TEST_CHECK(tl_scene_line_of_sight(scene, instances, vec(0, NAN, 0), vec(0, 0, 0), NULL));
    TEST_CHECK(tl_scene_line_of_sight(scene, instances, vec(50, 0, 0), vec(50, 0, 0), NULL));
    TEST_CHECK(tl_scene_line_of_sight(scene, instances, vec(3e38f, 3e38f, 0), vec(3e38f, -3e38f, 0), NULL));
    tl_blob_free(scene);
    scene_parts_free(&parts);
}

// An instance at the identity answers as its soup alone, bit for bit.
static void test_identity(void **state)
{
    (void)state;
    model m = model_terrain(20, 2, vec(-10, 0, -10), 9);
    tl_soup *soup = model_soup(&m, NULL);
    tl_scene_instance instance = { .soup = soup, .pose = tl_transform_identity(), .mask = 1 };
    instance.pose.rotation.w = -3; // a turn by nothing
    tl_scene *scene = scene_build(&instance, 1);
    test_random random = { 4 };
    uint32_t hits = 0;
    for (uint32_t k = 0; k < 5000; k++) {
        tl_ray ray = { test_random_point(&random, vec(-12, -1, -12), vec(12, 6, 12)), test_random_direction(&random),
                       INFINITY };
        if (k % 3 == 0) {
            ray.origin.x = -0.0f;
            ray.direction = vec(-0.0f, -1, k % 2 ? 0.0f : -0.0f);
        }
        tl_ray_hit expected;
        tl_scene_hit hit;
        bool met = tl_soup_cast_ray(soup, &ray, NULL, &expected);
        TEST_CHECK(tl_scene_cast_ray(scene, &instance, &ray, NULL, &hit) == met);
        if (met) {
            TEST_CHECK(hit.instance == 0 && hit.hit.t == expected.t && hit.hit.triangle == expected.triangle);
            TEST_CHECK(memcmp(&hit.hit.u, &expected.u, 4) == 0 && memcmp(&hit.hit.v, &expected.v, 4) == 0);
            TEST_CHECK(memcmp(&hit.hit.normal, &expected.normal, 12) == 0 && hit.hit.back == expected.back);
            hits++;
        }
    }
    TEST_CHECK(hits > 1000);
    tl_blob_free(scene);
    tl_blob_free(soup);
    model_free(&m);
}

// A corner of an instance in the world.
static tl_vec3d corner_out(const tl_scene_instance *instance, tl_vec3 corner)
{
    tl_frame frame = tl_frame_from(instance->pose);
    return tl_frame_point(&frame, tl_vec3d_from(corner));
}

// From inside closed, turned balls at their corners and edges: every ray hits, and within the bound of the header.
static void test_nothing_slips_through(void **state)
{
    (void)state;
    test_random random = { 6 };
    uint32_t rays = 0;
    double worst = 0;
    for (uint32_t k = 0; k < 60; k++) {
        float radius = k % 3 == 0 ? 0.01f : k % 3 == 1 ? 1.0f : 300.0f;
        tl_vec3 at = test_random_point(&random, vec(-1000, -1000, -1000), vec(1000, 1000, 1000));
        model m = model_ball(2, radius, 0.05f, k % 2 ? vec(0, 0, 0) : vec(3 * radius, 0, radius), k);
        tl_soup *soup = model_soup(&m, NULL);
        tl_scene_instance instance = { .soup = soup, .pose = { scene_rotation(&random), at }, .mask = 1 };
        tl_scene *scene = scene_build(&instance, 1);
        tl_vec3 middle = k % 2 ? vec(0, 0, 0) : vec(3 * radius, 0, radius);
        for (uint32_t i = 0; i < 300; i++) {
            const uint32_t *corner = m.indices + 3 * (size_t)test_random_below(&random, m.triangle_count);
            tl_vec3 a = m.vertices[corner[0]], b = m.vertices[corner[1]];
            tl_vec3 target = tl_lerp(a, b, i % 3 == 0 ? 0.0f : test_random_unit(&random));
            tl_vec3d to = corner_out(&instance, target);
            tl_vec3d inside = corner_out(&instance, tl_mul_add(middle, test_random_direction(&random), 0.5f * radius));
            tl_vec3 from = tl_vec3d_to_float(inside);
            tl_ray ray = { from, tl_sub(tl_vec3d_to_float(to), from), INFINITY };
            if (ray.direction.x == 0 && ray.direction.y == 0 && ray.direction.z == 0) {
                continue;
            }
            tl_scene_hit hit;
            TEST_CHECK(tl_scene_cast_ray(scene, &instance, &ray, NULL, &hit));
            TEST_CHECK(tl_scene_occluded(scene, &instance, &ray, NULL));
            rays++;
            // The point at t lies in the triangle's plane, as near as the header says.
            const uint32_t *met = m.indices + 3 * (size_t)hit.hit.triangle;
            tl_vec3d p = corner_out(&instance, m.vertices[met[0]]), q = corner_out(&instance, m.vertices[met[1]]);
            tl_vec3d s = corner_out(&instance, m.vertices[met[2]]);
            tl_vec3d normal = tl_vec3d_cross(tl_vec3d_sub(q, p), tl_vec3d_sub(s, p));
            normal = tl_vec3d_scale(normal, 1 / tl_vec3d_length(normal));
            tl_vec3d point =
                tl_vec3d_mul_add(tl_vec3d_from(ray.origin), tl_vec3d_from(ray.direction), (double)hit.hit.t);
            double off = fabs(tl_vec3d_dot(normal, tl_vec3d_sub(point, p)));
            double way = (double)hit.hit.t * tl_vec3d_length(tl_vec3d_from(ray.direction));
            double share = tl_vec3d_length(tl_vec3d_from(scene_point_in(&instance, from))) + way;
            // t itself is rounded, too: 5/8 ulp of the way.
            double bound = (double)TL_FLOAT_ROUNDING * (1.001 * share + 1.25 * way);
            TEST_CHECK(off <= bound);
            worst = off / bound > worst ? off / bound : worst;
        }
        tl_blob_free(scene);
        tl_blob_free(soup);
        model_free(&m);
    }
    print_message("%u rays at corners and edges from inside, none got out; worst error %.2f of its bound\n", rays,
                  worst);
    TEST_CHECK(rays > 10000 && worst > 0.05);
}

// Flat soups, whose own boxes have no height, turned by quarters and at random, far from the origin too: rays at their
// corners and edges, and along their planes.
static void test_flat_soups(void **state)
{
    (void)state;
    test_random random = { 8 };
    regimes r = { 0 };
    model m = model_terrain(5, 0, vec(-2, 1, -2), 3);
    tl_soup *soup = model_soup(&m, NULL);
    for (uint32_t k = 0; k < 30; k++) {
        float range = k % 3 == 0 ? 4.0f : k % 3 == 1 ? 1000.0f : 1e6f;
        tl_scene_instance instances[30];
        for (uint32_t i = 0; i < 30; i++) {
            tl_vec3 around = tl_scale(vec(1, 1, 1), range);
            tl_quat quarter = { 0, 0, 0, 0.7071068f };
            *(i % 3 == 0 ? &quarter.x : i % 3 == 1 ? &quarter.y : &quarter.z) = i % 2 ? 0.7071068f : -0.7071068f;
            tl_scene_instance instance = { .soup = soup, .mask = 1 };
            instance.pose.position = test_random_point(&random, tl_neg(around), around);
            instance.pose.rotation = i % 5 == 0 ? scene_rotation(&random) : quarter;
            instances[i] = instance;
        }
        tl_scene *scene = scene_build(instances, 30);
        for (uint32_t i = 0; i < 200; i++) {
            const tl_scene_instance *a = &instances[test_random_below(&random, 30)];
            const tl_scene_instance *b = i % 2 ? a : &instances[test_random_below(&random, 30)];
            tl_vec3 to = tl_vec3d_to_float(corner_out(a, m.vertices[test_random_below(&random, m.vertex_count)]));
            tl_vec3 from = tl_vec3d_to_float(corner_out(b, m.vertices[test_random_below(&random, m.vertex_count)]));
            from = i % 4 == 1 ? tl_mul_add(from, test_random_direction(&random), 3.0f) : from;
            tl_ray ray = { from, tl_sub(to, from), i % 3 == 0 ? 1.0f : INFINITY };
            tl_scene_hit expected, hit;
            bool met = ask_all(instances, 30, &ray, NULL, &expected);
            for (int level = 0; level < 3; level++) {
                tl_scene_walk_fn *walk = tl_scene_walk_for(level);
                TEST_CHECK(walk == NULL || tl_scene_cast_ray_with(walk, scene, instances, &ray, NULL, &hit) == met);
                TEST_CHECK(walk == NULL || !met || same_hit(&hit, &expected));
            }
            r.hits += met;
            r.misses += !met;
            check_sight(scene, instances, 30, from, to, NULL, &r);
        }
        tl_blob_free(scene);
    }
    print_message("flat soups: hits %u, misses %u, blocked %u, clear %u\n", r.hits, r.misses, r.blocked, r.clear);
    TEST_CHECK(r.hits > 1000 && r.misses > 100 && r.blocked > 1000 && r.clear > 100);
    tl_blob_free(soup);
    model_free(&m);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        ray_count = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_all_instances),
        cmocka_unit_test(test_far_and_tiny_rays),
        cmocka_unit_test(test_identity),
        cmocka_unit_test(test_nothing_slips_through),
        cmocka_unit_test(test_flat_soups),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
