// SPDX-License-Identifier: MIT
//
// scene/scene_cast_shape.c, scene_overlap.c, scene_nearest.c, instances_in_box.c: against each instance queried in
// turn, by example, and on many threads at once. An argument sets the number of queries a scene.

#include "scene_models.h"

#include "scene/scene_layout.h"

#include <pthread.h>

static uint32_t query_count = 400;

static tl_vec3 vec(float x, float y, float z)
{
    return tl_vec3_make(x, y, z);
}

typedef struct regimes {
    uint32_t hits, free_ways, overlaps, deep, triangles, shapes, crowded, nearest_soup, nearest_shape, inside, none;
} regimes;

// A shape's pose in an instance's space; the library's own, as its rounding is part of the answer.
static tl_transform pose_in(const tl_scene_instance *instance, tl_transform pose)
{
    tl_transform seen = { pose.rotation, scene_point_in(instance, pose.position) };
    if (scene_is_turned(instance)) {
        tl_quatd q = tl_quatd_between(tl_quatd_from(instance->pose.rotation), tl_quatd_from(pose.rotation));
        double scale = 1.0 / sqrt(q.length_sq);
        seen.rotation.x = (float)(q.x * scale);
        seen.rotation.y = (float)(q.y * scale);
        seen.rotation.z = (float)(q.z * scale);
        seen.rotation.w = (float)(q.w * scale);
    }
    return seen;
}

// Without the rule for what touches: that is left out of the comparison, and has a test of its own.
static bool cast_at_instance(const tl_scene_instance *instance, const tl_convex *shape, tl_transform pose,
                             tl_vec3 motion, tl_shape_hit *hit)
{
    if (instance->soup != NULL) {
        const tl_scaled_soup soup = scene_scaled_soup(instance);
        if (tl_scaled_soup_cast_shape(&soup, shape, pose_in(instance, pose), scene_direction_in(instance, motion), NULL,
                                      hit) != TL_OK) {
            return false;
        }
        hit->point = scene_point_out(instance, hit->point);
        hit->normal = scene_direction_out(instance, hit->normal);
        hit->face_normal = scene_direction_out(instance, hit->face_normal);
        return true;
    }
    tl_convex_hit met;
    tl_scaled_convex room;
    const tl_convex *other = instance->shape != NULL ? scene_scaled_shape(instance, &room) : NULL;
    if (other == NULL || !tl_convex_cast(other, instance->pose, shape, pose, motion, &met)) {
        return false;
    }
    memset(hit, 0, sizeof *hit);
    hit->triangle = TL_NO_TRIANGLE;
    hit->t = met.t;
    hit->point = met.point;
    hit->normal = met.normal;
    if (met.initial_overlap) {
        tl_penetration in;
        tl_convex_penetration(other, instance->pose, shape, pose, NULL, &in);
        hit->initial_overlap = true;
        hit->depth = in.depth;
        hit->point = in.point_a;
        hit->normal = in.normal;
    }
    return true;
}

static void check_cast(const tl_scene *scene, const tl_scene_instance *instances, uint32_t count,
                       const tl_convex *shape, tl_transform pose, tl_vec3 motion, const tl_scene_filter *filter,
                       regimes *r)
{
    tl_shape_hit best = { 0 };
    uint32_t instance = TL_NO_INSTANCE;
    for (uint32_t i = 0; i < count; i++) {
        tl_shape_hit hit;
        if (!scene_passes(filter, instances, i) || !cast_at_instance(&instances[i], shape, pose, motion, &hit)) {
            continue;
        }
        if (hit.initial_overlap && hit.depth < 1e-5f * (1 + tl_length(pose.position))) {
            return;
        }
        double closing = -tl_vec3d_dot(tl_vec3d_from(hit.normal), tl_vec3d_from(motion)) * (1 - (double)hit.t);
        if (!hit.initial_overlap && closing < 0.01 * (double)tl_length(motion)) {
            return;
        }
        if (instance == TL_NO_INSTANCE || hit.t < best.t || (hit.t == best.t && hit.depth > best.depth)) {
            best = hit;
            instance = i;
        }
    }
    tl_scene_shape_hit found;
    tl_result result = tl_scene_cast_shape(scene, instances, shape, pose, motion, filter, &found);
    TEST_RESULT(result, instance == TL_NO_INSTANCE ? TL_NOT_FOUND : TL_OK);
    r->free_ways += instance == TL_NO_INSTANCE;
    if (instance != TL_NO_INSTANCE) {
        TEST_CHECK(found.instance == instance && found.hit.t == best.t && found.hit.triangle == best.triangle);
        TEST_CHECK(found.hit.depth == best.depth && found.hit.initial_overlap == best.initial_overlap);
        TEST_CHECK(memcmp(&found.hit.normal, &best.normal, sizeof best.normal) == 0);
        TEST_CHECK(found.hit.point.x == best.point.x && found.hit.point.y == best.point.y &&
                   found.hit.point.z == best.point.z);
        r->hits++;
        r->deep += found.hit.initial_overlap;
        r->shapes += found.hit.triangle == TL_NO_TRIANGLE;
    }
}

static int by_instance(const void *a, const void *b)
{
    const tl_scene_overlap *x = a, *y = b;
    return x->instance != y->instance  ? (x->instance < y->instance ? -1 : 1)
           : x->triangle < y->triangle ? -1
                                       : x->triangle > y->triangle;
}

static void check_overlaps(const tl_scene *scene, const tl_scene_instance *instances, uint32_t count,
                           const tl_convex *shape, tl_transform pose, const tl_scene_filter *filter, regimes *r)
{
    static tl_scene_overlap expected[20000], found[20000];
    static uint32_t triangles[5000];
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!scene_passes(filter, instances, i)) {
            continue;
        }
        uint32_t some = 0;
        tl_scaled_convex room;
        if (instances[i].soup != NULL) {
            const tl_scaled_soup soup = scene_scaled_soup(&instances[i]);
            TEST_RESULT(
                tl_scaled_soup_find_overlaps(&soup, shape, pose_in(&instances[i], pose), NULL, triangles, 5000, &some),
                TL_OK);
        } else if (instances[i].shape != NULL) {
            some = tl_convex_overlap(scene_scaled_shape(&instances[i], &room), instances[i].pose, shape, pose, NULL);
            triangles[0] = TL_NO_TRIANGLE;
        }
        for (uint32_t k = 0; k < some; k++) {
            tl_scene_overlap overlap = { i, triangles[k] };
            TEST_CHECK(n < 20000);
            expected[n++] = overlap;
        }
    }
    uint32_t m = 0;
    bool any = false;
    const tl_scene_overlap_query query = { shape, pose, filter };
    TEST_RESULT(tl_scene_overlaps(scene, instances, &query, &any), TL_OK);
    TEST_CHECK(any == (n > 0));
    TEST_RESULT(tl_scene_find_overlaps(scene, instances, &query, found, 20000, &m), TL_OK);
    TEST_CHECK(m == n);
    qsort(expected, n, sizeof *expected, by_instance);
    qsort(found, m, sizeof *found, by_instance);
    TEST_CHECK(n == 0 || memcmp(expected, found, n * sizeof *found) == 0);
    if (n > 1) { // less room: each that is written is one of them, and none is written beyond
        uint32_t room = n / 2;
        found[room].instance = 123456789;
        TEST_RESULT(tl_scene_find_overlaps(scene, instances, &query, found, room, &m), TL_INCOMPLETE);
        TEST_CHECK(m == n && found[room].instance == 123456789);
        for (uint32_t k = 0; k < room; k++) {
            TEST_CHECK(bsearch(&found[k], expected, n, sizeof *found, by_instance) != NULL);
        }
        r->crowded++;
    }
    r->overlaps += n > 0;
    r->triangles += n;
}

static void check_nearest(const tl_scene *scene, const tl_scene_instance *instances, uint32_t count, tl_vec3 at,
                          float reach, const tl_scene_filter *filter, regimes *r)
{
    tl_soup_point best = { 0 };
    uint32_t instance = TL_NO_INSTANCE;
    for (uint32_t i = 0; i < count; i++) {
        tl_soup_point p;
        if (!scene_passes(filter, instances, i)) {
            continue;
        }
        if (instances[i].soup != NULL) {
            const tl_scaled_soup soup = scene_scaled_soup(&instances[i]);
            if (tl_scaled_soup_nearest(&soup, scene_point_in(&instances[i], at), reach, NULL, &p) != TL_OK) {
                continue;
            }
            p.point = scene_point_out(&instances[i], p.point);
            p.normal = scene_direction_out(&instances[i], p.normal);
        } else if (instances[i].shape != NULL) {
            tl_convex point = tl_convex_sphere(at, 0);
            tl_separation apart;
            tl_scaled_convex room;
            tl_convex_distance(scene_scaled_shape(&instances[i], &room), instances[i].pose, &point,
                               tl_transform_identity(), NULL, &apart);
            memset(&p, 0, sizeof p);
            p.point = apart.overlap ? at : apart.point_a;
            p.normal = apart.normal;
            p.distance = apart.distance;
            p.triangle = TL_NO_TRIANGLE;
        }
        if ((instances[i].soup == NULL && instances[i].shape == NULL) || p.distance > reach) {
            continue;
        }
        if (instance == TL_NO_INSTANCE || p.distance < best.distance) {
            best = p;
            instance = i;
        }
    }
    tl_scene_point found;
    tl_result result = tl_scene_nearest(scene, instances, at, reach, filter, &found);
    TEST_RESULT(result, instance == TL_NO_INSTANCE ? TL_NOT_FOUND : TL_OK);
    r->none += instance == TL_NO_INSTANCE;
    if (instance != TL_NO_INSTANCE) {
        TEST_CHECK(found.instance == instance && found.point.distance == best.distance);
        TEST_CHECK(found.point.triangle == best.triangle && found.point.feature == best.feature);
        TEST_CHECK(memcmp(&found.point.normal, &best.normal, sizeof best.normal) == 0);
        TEST_CHECK(found.point.point.x == best.point.x && found.point.back == best.back);
        r->nearest_soup += best.triangle != TL_NO_TRIANGLE;
        r->nearest_shape += best.triangle == TL_NO_TRIANGLE;
        r->inside += best.triangle == TL_NO_TRIANGLE && best.distance == 0;
    }
}

typedef struct box_search {
    uint8_t *seen;
    uint32_t count, most;
} box_search;

static bool mark_instance(uint32_t instance, void *user)
{
    box_search *b = user;
    TEST_CHECK(b->seen[instance] == 0);
    b->seen[instance] = 1;
    return ++b->count < b->most;
}

static void check_box(const tl_scene *scene, const tl_scene_instance *instances, uint32_t count, tl_aabb box,
                      const tl_scene_filter *filter)
{
    box_search b = { calloc(count + 1, 1), 0, UINT32_MAX };
    TEST_CHECK(b.seen != NULL && tl_scene_instances_in_box(scene, box, filter, mark_instance, &b));
    uint32_t all = b.count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t lane = tl_scene_places(scene)[i].lane;
        const tl_scene_node *node = &tl_scene_nodes(scene)[lane / TL_SCENE_WIDTH];
        lane %= TL_SCENE_WIDTH;
        tl_aabb own = { vec(node->plane[0][lane], node->plane[2][lane], node->plane[4][lane]),
                        vec(node->plane[1][lane], node->plane[3][lane], node->plane[5][lane]) };
        TEST_CHECK(b.seen[i] == (tl_aabb_overlaps(own, box) && scene_passes(filter, instances, i)));
    }
    if (all > 1) {
        memset(b.seen, 0, count);
        b.count = 0;
        b.most = all - 1;
        TEST_CHECK(!tl_scene_instances_in_box(scene, box, filter, mark_instance, &b) && b.count == all - 1);
    }
    free(b.seen);
}

static void check_scene(const scene_parts *parts, const tl_scene *scene, const tl_scene_instance *instances,
                        uint32_t count, float range, tl_vec3 center, uint32_t queries, regimes *r)
{
    test_random random = { count };
    tl_vec3 wide = vec(range + 1, range + 1, range + 1);
    for (uint32_t k = 0; k < queries; k++) {
        tl_scene_filter chosen;
        const tl_scene_filter *filter = scene_filter(&random, count, &chosen);
        const tl_convex *shape = &parts->shapes[test_random_below(&random, SCENE_SHAPES)];
        tl_convex small = *shape;
        if (small.kind == TL_CONVEX_INLINE) {
            small.radius *= 0.2f;
        }
        tl_transform pose = { scene_rotation(&random),
                              test_random_point(&random, tl_sub(center, wide), tl_add(center, wide)) };
        tl_vec3 motion = tl_scale(test_random_direction(&random), range * test_random_unit(&random));
        if (k % 10 == 0) {
            motion = vec(0, k % 20 == 0 ? 0.0f : -range, 0);
        }
        check_cast(scene, instances, count, &small, pose, motion, filter, r);
        check_overlaps(scene, instances, count, &small, pose, filter, r);
        float reach = k % 3 == 0 ? INFINITY : test_random_unit(&random) * range;
        check_nearest(scene, instances, count, pose.position, reach, filter, r);
        tl_aabb box = { tl_sub(pose.position, tl_abs(motion)), tl_add(pose.position, tl_abs(motion)) };
        check_box(scene, instances, count, box, filter);
    }
}

static void check_random_scene(const scene_parts *parts, uint32_t count, tl_vec3 center, float range, uint32_t queries,
                               regimes *r)
{
    test_random random = { count + 5 };
    tl_scene_instance *instances = malloc((count + 1) * sizeof *instances);
    TEST_CHECK(instances != NULL);
    for (uint32_t i = 0; i < count; i++) {
        instances[i] = scene_instance(parts, &random, center, range);
        if (i > 0 && i % 6 == 0) {
            instances[i] = instances[i - 1];
        }
    }
    tl_scene *scene = scene_build(instances, count);
    check_scene(parts, scene, instances, count, range, center, queries, r);
    for (uint32_t i = 0; i < count; i += 2) {
        instances[i] = scene_instance(parts, &random, center, range);
    }
    TEST_RESULT(tl_scene_refit(scene, instances, count, NULL, NULL), TL_OK);
    check_scene(parts, scene, instances, count, range, center, queries, r);
    tl_blob_free(scene);
    free(instances);
}

static void test_against_all_instances(void **state)
{
    (void)state;
    regimes r = { 0 };
    scene_parts parts;
    scene_parts_make(&parts, 1);
    check_random_scene(&parts, 0, vec(0, 0, 0), 1, 5, &r);
    check_random_scene(&parts, 1, vec(0, 0, 0), 2, query_count / 4, &r);
    check_random_scene(&parts, 10, vec(0, 0, 0), 4, query_count, &r);
    check_random_scene(&parts, 40, vec(2000, -100, 700), 9, query_count, &r);
    check_random_scene(&parts, 300, vec(0, 0, 0), 40, query_count / 4, &r);
    scene_parts_free(&parts);
    print_message("casts: %u hits (%u shapes, %u deep), %u free; %u overlaps, %u triangles, %u too many\n", r.hits,
                  r.shapes, r.deep, r.free_ways, r.overlaps, r.triangles, r.crowded);
    print_message("nearest: soups %u, shapes %u (inside %u), none %u\n", r.nearest_soup, r.nearest_shape, r.inside,
                  r.none);
    TEST_CHECK(r.hits > query_count / 2 && r.shapes > query_count / 8 && r.deep > query_count / 8);
    TEST_CHECK(r.free_ways > query_count / 4 && r.overlaps > query_count / 4 && r.crowded > query_count / 8);
    TEST_CHECK(r.nearest_soup > query_count / 2 && r.nearest_shape > query_count / 4 && r.inside > query_count / 200 &&
               r.none > 50);
}

// A character on a lift, far from the origin: it stands some roundings in the lift's floor, and may walk and rise.
static void test_standing(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 2);
    tl_convex box = tl_convex_box(vec(0, -1, 0), vec(2, 1, 2), 0);
    tl_convex body = tl_convex_capsule(vec(0, 0.3f, 0), vec(0, 1.5f, 0), 0.3f);
    test_random random = { 2 };
    uint32_t caught = 0, walked = 0, sunk = 0;
    for (uint32_t k = 0; k < 2000; k++) {
        bool is_soup = k % 2 == 0;
        tl_scene_instance instance = { .soup = is_soup ? parts.soups[4] : NULL, .shape = is_soup ? NULL : &box };
        instance.mask = 1;
        instance.pose.position = test_random_point(&random, vec(900, 900, 900), vec(1000, 1000, 1000));
        tl_quat turn = { 0, test_random_range(&random, -1, 1), 0, 1 };
        instance.pose.rotation = turn;
        tl_scene *scene = scene_build(&instance, 1);
        tl_transform pose = tl_transform_identity();
        pose.position = tl_add(instance.pose.position, vec(test_random_range(&random, -1, 1), 0, 0));
        // An ulp of 900 is 6e-5.
        pose.position.y = nextafterf(pose.position.y, k % 3 == 0 ? 0.0f : k % 3 == 1 ? 2000.0f : pose.position.y);
        tl_scene_shape_hit hit;
        tl_vec3 along = vec(0.5f, 0, 0.2f);
        tl_result result = tl_scene_cast_shape(scene, &instance, &body, pose, along, NULL, &hit);
        caught += result != TL_NOT_FOUND;
        walked += result == TL_NOT_FOUND;
        TEST_RESULT(tl_scene_cast_shape(scene, &instance, &body, pose, vec(0, 0.5f, 0), NULL, &hit), TL_NOT_FOUND);
        TEST_RESULT(tl_scene_cast_shape(scene, &instance, &body, pose, vec(0, -0.5f, 0), NULL, &hit), TL_OK);
        TEST_CHECK(hit.hit.t < 1e-3f && !hit.hit.initial_overlap && hit.hit.normal.y > 0.99f);
        // Deeper than roundings explain is an overlap.
        pose.position.y = instance.pose.position.y - 0.01f;
        TEST_RESULT(tl_scene_cast_shape(scene, &instance, &body, pose, along, NULL, &hit), TL_OK);
        sunk += hit.hit.initial_overlap && fabsf(hit.hit.depth - 0.01f) < 1e-3f;
        tl_blob_free(scene);
    }
    print_message("walked %u, caught %u, sunk %u\n", walked, caught, sunk);
    TEST_CHECK(caught == 0 && walked == 2000 && sunk == 2000);
    scene_parts_free(&parts);
}

static void test_bad_questions(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    tl_scene_instance instance = { .soup = parts.soups[0], .pose = tl_transform_identity(), .mask = 1 };
    tl_scene *scene = scene_build(&instance, 1);
    tl_convex sphere = tl_convex_sphere(vec(0, 0, 0), 1);
    tl_transform pose = tl_transform_identity(), bad = pose;
    bad.position.x = NAN;
    tl_scene_shape_hit hit;
    bool any;
    uint32_t count;
    TEST_RESULT(tl_scene_cast_shape(scene, &instance, &sphere, bad, vec(0, 1, 0), NULL, &hit), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_scene_cast_shape(scene, &instance, &sphere, pose, vec(0, NAN, 0), NULL, &hit), TL_ERR_NOT_FINITE);
    tl_scene_overlap_query query = { &sphere, bad, NULL };
    TEST_RESULT(tl_scene_overlaps(scene, &instance, &query, &any), TL_ERR_NOT_FINITE);
    sphere.radius = -1;
    TEST_RESULT(tl_scene_cast_shape(scene, &instance, &sphere, pose, vec(0, 1, 0), NULL, &hit), TL_ERR_ARGUMENT);
    query.pose = pose;
    TEST_RESULT(tl_scene_find_overlaps(scene, &instance, &query, NULL, 0, &count), TL_ERR_ARGUMENT);
    tl_scene_point nearest;
    TEST_RESULT(tl_scene_nearest(scene, &instance, vec(NAN, 0, 0), 1, NULL, &nearest), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_scene_nearest(scene, &instance, vec(0, 0, 0), -1, NULL, &nearest), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_scene_nearest(scene, &instance, vec(3e38f, 0, 3e38f), INFINITY, NULL, &nearest), TL_OK);
    tl_blob_free(scene);
    scene_parts_free(&parts);
}

// ------------------------------------------------------------------------------------------------------ threads

typedef struct asked {
    const tl_scene *scene;
    const tl_scene_instance *instances;
    const tl_convex *shape;
    double sum;
} asked;

static void *ask_much(void *user)
{
    asked *a = user;
    test_random random = { 9 };
    a->sum = 0;
    for (uint32_t k = 0; k < 300; k++) {
        tl_ray ray = { test_random_point(&random, vec(-12, -12, -12), vec(12, 12, 12)), test_random_direction(&random),
                       INFINITY };
        tl_scene_hit hit;
        if (tl_scene_cast_ray(a->scene, a->instances, &ray, NULL, &hit)) {
            a->sum += (double)hit.hit.t;
        }
        a->sum += tl_scene_line_of_sight(a->scene, a->instances, ray.origin, vec(0, 0, 0), NULL);
        tl_transform pose = { tl_quat_identity(), ray.origin };
        tl_scene_shape_hit met;
        if (tl_scene_cast_shape(a->scene, a->instances, a->shape, pose, ray.direction, NULL, &met) == TL_OK) {
            a->sum += (double)met.hit.t;
        }
        tl_scene_point nearest;
        if (tl_scene_nearest(a->scene, a->instances, ray.origin, 5, NULL, &nearest) == TL_OK) {
            a->sum += (double)nearest.point.distance;
        }
    }
    return NULL;
}

static void test_threads(void **state)
{
    (void)state;
    scene_parts parts;
    scene_parts_make(&parts, 1);
    test_random random = { 8 };
    tl_scene_instance instances[100];
    scene_fill(&parts, &random, vec(0, 0, 0), 10, instances, 100);
    tl_scene *scene = scene_build(instances, 100);
    asked each[4];
    pthread_t threads[4];
    for (uint32_t i = 0; i < 4; i++) {
        asked a = { scene, instances, &parts.shapes[4], 0 };
        each[i] = a;
        TEST_CHECK(pthread_create(&threads[i], NULL, ask_much, &each[i]) == 0);
    }
    for (uint32_t i = 0; i < 4; i++) {
        TEST_CHECK(pthread_join(threads[i], NULL) == 0);
    }
    TEST_CHECK(each[0].sum > 100 && each[0].sum == each[1].sum && each[1].sum == each[2].sum);
    TEST_CHECK(each[2].sum == each[3].sum);
    tl_blob_free(scene);
    scene_parts_free(&parts);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        query_count = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_all_instances),
        cmocka_unit_test(test_standing),
        cmocka_unit_test(test_bad_questions),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
