// SPDX-License-Identifier: MIT
//
// Triangles that take one lane answer every query as they do with a lane each, bit for bit.

#include "coincident_levels.h"

#include <talus/hull.h>
#include <talus/soup_scaled.h>

// Whether a hit's triangle coincides with a lower one.
static bool is_later(const level *l, const tl_ray_hit *hit)
{
    const uint32_t *v = l->m.indices + 3 * (size_t)hit->triangle;
    for (uint32_t i = 0; i < hit->triangle; i++) {
        uint32_t same = 0;
        for (uint32_t k = 0; k < 9; k++) {
            const tl_vec3 a = l->m.vertices[l->m.indices[3 * (size_t)i + k % 3]], b = l->m.vertices[v[k / 3]];
            same |= (uint32_t)(a.x == b.x && a.y == b.y && a.z == b.z) << k;
        }
        if ((same & 7u) != 0 && (same & 56u) != 0 && (same & 448u) != 0 && tl_bit_count(same) == 3) {
            return true;
        }
    }
    return false;
}

static void test_closest_and_any_hits(void **state)
{
    (void)state;
    test_random random = { 21 };
    uint32_t hits = 0, later = 0, later_filtered = 0;
    for (uint32_t i = 0; i < 4 * MODEL_STORAGES; i++) {
        const level *l = &levels[i % 4];
        both_soups both = bake_both(l, (model_storage)(i / 4));
        for (uint32_t r = 0; r < 6000; r++) {
            const tl_ray ray = any_ray(l, both.apart, &random);
            const tl_vec3 end = tl_add(ray.origin, ray.direction);
            const uint32_t f = r % FILTERS;
            tl_ray_hit expected, hit;
            const bool is_hit = tl_soup_cast_ray(both.apart, &ray, &filters[f], &expected);
            for (int isa = 0; isa < TL_RAY_ISA_COUNT; isa++) {
                tl_ray_walk_fn *walk = tl_ray_walk_for((tl_ray_isa)isa);
                if (walk != NULL) {
                    TEST_CHECK(tl_soup_cast_ray_with(walk, both.merged, &ray, &filters[f], &hit) == is_hit);
                    TEST_CHECK(!is_hit || same_hit(&hit, &expected));
                    TEST_CHECK(tl_soup_occluded_with(walk, both.merged, &ray, &filters[f]) == is_hit);
                }
            }
            if (is_hit) {
                hits++;
                later += f == 0 && is_later(l, &expected);
                later_filtered += f != 0 && is_later(l, &expected);
            }
            const bool is_met = tl_soup_cast_segment(both.apart, ray.origin, end, &filters[f], &expected);
            TEST_CHECK(tl_soup_cast_segment(both.merged, ray.origin, end, &filters[f], &hit) == is_met);
            TEST_CHECK(!is_met || same_hit(&hit, &expected));
            TEST_CHECK(tl_soup_line_of_sight(both.merged, ray.origin, end, &filters[f]) == !is_met);
        }
        free_both(&both);
    }
    print_message("%u hits, %u of them of a later triangle for its t, %u for a filter\n", hits, later, later_filtered);
    TEST_CHECK(hits > 50000 && later_filtered > 5000);
}

// Rays so near to a triangle's plane that t, measured from another corner, often rounds to another float: then the
// lowest triangle need not win.
static void test_t_of_each_corner(void **state)
{
    (void)state;
    test_random random = { 27 };
    uint32_t hits = 0, later = 0;
    enum { RAYS = 2048 };
    static tl_ray rays[RAYS];
    static tl_ray_hit expected[RAYS], found[RAYS];
    for (uint32_t i = 0; i < 60; i++) {
        model m = { 0 };
        for (uint32_t k = 0; k < 3; k++) {
            const tl_vec3 at = test_random_point(&random, tl_vec3_make(-3, -3, -3), tl_vec3_make(3, 3, 3));
            model_vertex(&m, at.x, at.y, at.z);
        }
        for (uint32_t k = 0; k < 6; k++) {
            const uint8_t *order = tl_soup_corner_slots[1 + (k + i) % 6];
            model_triangle(&m, order[0], order[1], order[2]);
        }
        const tl_mesh_view view = model_view(&m);
        const tl_soup_def def = model_soup_def(MODEL_BOXES);
        tl_soup *merged = model_soup(&m, &def), *apart = bake_apart(&view, &def);
        TEST_CHECK(tl_soup_get_stats(merged).coincident_count == 5);
        const tl_vec3 a = m.vertices[0], p = tl_sub(m.vertices[1], a), q = tl_sub(m.vertices[2], a);
        for (uint32_t r = 0; r < RAYS; r++) {
            const tl_vec3 at = tl_mul_add(tl_mul_add(a, p, test_random_range(&random, 0.1f, 0.5f)), q,
                                          test_random_range(&random, 0.1f, 0.4f));
            const tl_vec3 along = tl_mul_add(tl_scale(p, 1.0f + 0.01f * test_random_unit(&random)), q, 0.3f);
            const float rise = ldexpf(test_random_range(&random, 1.0f, 2.0f), -13 - (int)(r / 16 % 5));
            rays[r].direction = tl_mul_add(along, tl_normalize(tl_cross(p, q)), rise);
            rays[r].origin = tl_sub(at, rays[r].direction);
            rays[r].tmax = INFINITY;
            const bool is_hit = tl_soup_cast_ray(apart, &rays[r], NULL, &expected[r]);
            TEST_CHECK(tl_soup_cast_ray(merged, &rays[r], NULL, &found[r]) == is_hit);
            TEST_CHECK(!is_hit || same_hit(&found[r], &expected[r]));
            hits += is_hit;
            later += is_hit && expected[r].triangle != 0;
        }
        tl_soup_cast_rays(merged, rays, RAYS, NULL, NULL, found);
        tl_soup_cast_rays(apart, rays, RAYS, NULL, NULL, expected);
        for (uint32_t r = 0; r < RAYS; r++) {
            TEST_CHECK(same_hit(&found[r], &expected[r]));
        }
        tl_blob_free(merged);
        tl_blob_free(apart);
        model_free(&m);
    }
    print_message("%u of %u hits are of a triangle that is not the lowest\n", later, hits);
    TEST_CHECK(hits > 100000 && later > 0);
}

static void test_all_hits(void **state)
{
    (void)state;
    test_random random = { 22 };
    enum { MOST = 4000 };
    static tl_ray_hit expected[MOST], found[MOST];
    for (uint32_t i = 0; i < 4 * MODEL_STORAGES; i++) {
        both_soups both = bake_both(&levels[i % 4], (model_storage)(i / 4));
        for (uint32_t r = 0; r < 600; r++) {
            const tl_ray ray = any_ray(&levels[i % 4], both.apart, &random);
            const tl_hit_rule rule = r % 2 == 0 ? TL_HITS_TOUCHED : TL_HITS_CROSSED;
            const tl_ray_filter *filter = &filters[r % FILTERS];
            const uint32_t capacity = r % 5 == 0 ? 3 : MOST;
            uint32_t expected_count, count;
            const tl_result result =
                tl_soup_cast_ray_all(both.apart, &ray, rule, filter, expected, capacity, &expected_count);
            TEST_RESULT(tl_soup_cast_ray_all(both.merged, &ray, rule, filter, found, capacity, &count), result);
            TEST_CHECK(count == expected_count);
            for (uint32_t k = 0; k < count && k < capacity; k++) {
                TEST_CHECK(same_hit(&found[k], &expected[k]));
            }
        }
        free_both(&both);
    }
}

// Coherent rays and others.
static void test_batches(void **state)
{
    (void)state;
    test_random random = { 23 };
    enum { RAYS = 4096 };
    static tl_ray rays[RAYS];
    static tl_segment segments[RAYS];
    static tl_ray_hit hits[RAYS], expected[RAYS];
    static bool met[RAYS], clear[RAYS];
    for (uint32_t i = 0; i < 16; i++) {
        both_soups both = bake_both(&levels[i % 4], i < 8 ? MODEL_BOXES : MODEL_SPLITS);
        const tl_aabb box = tl_soup_bounds(both.apart);
        tl_vec3 eye = box.min, forward = { 1, 0, 0 };
        for (uint32_t r = 0; r < RAYS; r++) {
            if (r % 64 == 0) {
                eye = tl_mul_add(test_random_point(&random, box.min, box.max), test_random_direction(&random), 3.0f);
                forward = tl_sub(test_random_point(&random, box.min, box.max), eye);
            }
            const float near = 0.02f * tl_length(forward);
            rays[r] = i % 2 == 0 ? any_ray(&levels[i % 4], both.apart, &random)
                                 : (tl_ray){ eye, tl_mul_add(forward, test_random_direction(&random), near), INFINITY };
            segments[r] = (tl_segment){ rays[r].origin, tl_mul_add(rays[r].origin, rays[r].direction, 1.3f) };
        }
        for (uint32_t f = 0; f < FILTERS; f++) {
            tl_soup_cast_rays(both.merged, rays, RAYS, &filters[f], NULL, hits);
            tl_soup_cast_rays(both.apart, rays, RAYS, &filters[f], NULL, expected);
            tl_soup_occluded_rays(both.merged, rays, RAYS, &filters[f], NULL, met);
            for (uint32_t r = 0; r < RAYS; r++) {
                TEST_CHECK(same_hit(&hits[r], &expected[r]) && met[r] == (hits[r].triangle != TL_NO_TRIANGLE));
            }
            tl_soup_cast_segments(both.merged, segments, RAYS, &filters[f], NULL, hits);
            tl_soup_cast_segments(both.apart, segments, RAYS, &filters[f], NULL, expected);
            tl_soup_lines_of_sight(both.merged, segments, RAYS, &filters[f], NULL, clear);
            for (uint32_t r = 0; r < RAYS; r++) {
                TEST_CHECK(same_hit(&hits[r], &expected[r]) && clear[r] == (hits[r].triangle == TL_NO_TRIANGLE));
            }
        }
        free_both(&both);
    }
}

static int compare_indices(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static int compare_contacts(const void *a, const void *b)
{
    return compare_indices(&((const tl_soup_contact *)a)->triangle, &((const tl_soup_contact *)b)->triangle);
}

static bool same_shape_hit(const tl_shape_hit *a, const tl_shape_hit *b)
{
    return same_float(a->t, b->t) && a->initial_overlap == b->initial_overlap && a->back == b->back &&
           a->material == b->material && a->triangle == b->triangle && same_float(a->depth, b->depth) &&
           same_vec(a->point, b->point) && same_vec(a->normal, b->normal) && same_vec(a->face_normal, b->face_normal) &&
           a->status == b->status;
}

static void compare_points(const tl_scaled_soup *merged, const tl_scaled_soup *apart, tl_vec3 at,
                           const tl_ray_filter *filter)
{
    tl_soup_point found, expected;
    const tl_result result = tl_scaled_soup_nearest(apart, at, 9.0f, filter, &expected);
    TEST_RESULT(tl_scaled_soup_nearest(merged, at, 9.0f, filter, &found), result);
    TEST_CHECK(same_vec(found.point, expected.point) && same_float(found.distance, expected.distance) &&
               same_vec(found.normal, expected.normal) && found.triangle == expected.triangle &&
               found.material == expected.material && found.back == expected.back && found.feature == expected.feature);
}

static void compare_shapes(const tl_scaled_soup *merged, const tl_scaled_soup *apart, const tl_convex *shape,
                           tl_transform pose, tl_vec3 motion, const tl_ray_filter *filter)
{
    enum { MOST = 8192 };
    static uint32_t found[MOST], expected[MOST];
    uint32_t count, expected_count;
    bool overlaps, expected_overlaps;
    TEST_RESULT(tl_scaled_soup_find_overlaps(merged, shape, pose, filter, found, MOST, &count), TL_OK);
    TEST_RESULT(tl_scaled_soup_find_overlaps(apart, shape, pose, filter, expected, MOST, &expected_count), TL_OK);
    TEST_CHECK(count == expected_count);
    qsort(found, count, sizeof *found, compare_indices);
    qsort(expected, count, sizeof *expected, compare_indices);
    TEST_CHECK(memcmp(found, expected, count * sizeof *found) == 0);
    TEST_RESULT(tl_scaled_soup_overlaps(merged, shape, pose, filter, &overlaps), TL_OK);
    TEST_RESULT(tl_scaled_soup_overlaps(apart, shape, pose, filter, &expected_overlaps), TL_OK);
    TEST_CHECK(overlaps == expected_overlaps && overlaps == (count > 0));
    tl_shape_hit hit, expected_hit;
    const tl_result result = tl_scaled_soup_cast_shape(apart, shape, pose, motion, filter, &expected_hit);
    TEST_RESULT(tl_scaled_soup_cast_shape(merged, shape, pose, motion, filter, &hit), result);
    TEST_CHECK(same_shape_hit(&hit, &expected_hit));
}

static void compare_contacts_of(const both_soups *both, const tl_convex *shape, tl_transform pose,
                                const tl_ray_filter *filter)
{
    enum { MOST = 1024 };
    static tl_soup_contact found[MOST], expected[MOST];
    tl_soup_contact_query query;
    memset(&query, 0, sizeof query);
    query.shape = shape;
    query.pose = pose;
    query.limits.margin = 0.05f;
    query.filter = filter;
    uint32_t count, expected_count;
    const tl_result result = tl_soup_find_contacts(both->apart, &query, expected, MOST, &expected_count);
    TEST_RESULT(tl_soup_find_contacts(both->merged, &query, found, MOST, &count), result);
    TEST_CHECK(count == expected_count && count <= MOST);
    qsort(found, count, sizeof *found, compare_contacts);
    qsort(expected, count, sizeof *expected, compare_contacts);
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(found[i].triangle == expected[i].triangle && found[i].material == expected[i].material &&
                   found[i].is_face == expected[i].is_face && found[i].manifold.count == expected[i].manifold.count &&
                   same_vec(found[i].manifold.normal, expected[i].manifold.normal));
        for (uint32_t k = 0; k < found[i].manifold.count; k++) {
            TEST_CHECK(same_vec(found[i].manifold.contacts[k].point_a, expected[i].manifold.contacts[k].point_a));
        }
    }
}

static void test_points_and_shapes(void **state)
{
    (void)state;
    test_random random = { 24 };
    static const tl_vec3 scales[] = { { 0, 0, 0 }, { 1.3f, 0.7f, 1 }, { -1, 1, 2 } };
    const tl_convex shapes[] = { tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.7f),
                                 tl_convex_capsule(tl_vec3_make(0, -0.5f, 0), tl_vec3_make(0, 0.5f, 0), 0.4f),
                                 tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.3f, 0.6f), 0.0f),
                                 tl_convex_cylinder(tl_vec3_make(0, -0.4f, 0), tl_vec3_make(0, 0.4f, 0), 0.5f, 0.0f) };
    for (uint32_t i = 0; i < 4 * MODEL_STORAGES; i++) {
        both_soups both = bake_both(&levels[i % 4], (model_storage)(i / 4));
        const tl_aabb box = tl_soup_bounds(both.apart);
        for (uint32_t r = 0; r < 400; r++) {
            const tl_scaled_soup merged = { both.merged, scales[r % 3] }, apart = { both.apart, scales[r % 3] };
            const tl_vec3 scale = r % 3 == 0 ? tl_vec3_make(1, 1, 1) : scales[r % 3];
            const tl_vec3 at = tl_mul(test_random_point(&random, box.min, box.max), scale);
            const tl_ray_filter *filter = &filters[r / 3 % FILTERS];
            const tl_convex *shape = &shapes[test_random_below(&random, 4)];
            tl_transform pose = tl_transform_identity();
            pose.position = at;
            compare_points(&merged, &apart, at, filter);
            compare_shapes(&merged, &apart, shape, pose, tl_scale(test_random_direction(&random), 3.0f), filter);
            compare_contacts_of(&both, shape, pose, filter);
        }
        free_both(&both);
    }
}

// Both windings of each triangle: closed, and around nothing.
static void test_inside(void **state)
{
    (void)state;
    test_random random = { 25 };
    for (uint32_t i = 0; i < 40; i++) {
        model m = model_ball(1 + i % 2, 2, 0.1f, tl_vec3_make(0, 0, 0), i);
        const uint32_t count = m.triangle_count;
        for (uint32_t t = 0; t < count; t++) { // the ball again, and in every second model inside out
            const uint32_t *v = m.indices + 3 * (size_t)t;
            model_triangle(&m, v[1], v[i % 2 == 0 ? 2 : 0], v[i % 2 == 0 ? 0 : 2]);
        }
        tl_soup *soup = model_soup(&m, NULL);
        TEST_CHECK(tl_soup_get_stats(soup).coincident_count == count);
        TEST_RESULT(tl_soup_check_closed(soup, NULL, NULL), TL_OK);
        tl_soup_location place;
        TEST_RESULT(tl_soup_locate(soup, tl_vec3_make(0.1f, 0.2f, 0.1f), &place), TL_OK);
        TEST_CHECK(place.winding == (i % 2 == 0 ? 2 : 0));
        const uint32_t corner = m.indices[3 * (size_t)test_random_below(&random, 2 * count)];
        TEST_RESULT(tl_soup_locate(soup, m.vertices[corner], &place), TL_OK);
        uint32_t lowest = 0;
        while (m.indices[3 * lowest] != corner && m.indices[3 * lowest + 1] != corner &&
               m.indices[3 * lowest + 2] != corner) {
            lowest++;
        }
        TEST_CHECK(place.side == TL_SOUP_ON_SURFACE && place.triangle == lowest);
        tl_blob_free(soup);
        model_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_closest_and_any_hits),
        cmocka_unit_test(test_t_of_each_corner),
        cmocka_unit_test(test_all_hits),
        cmocka_unit_test(test_batches),
        cmocka_unit_test(test_points_and_shapes),
        cmocka_unit_test(test_inside),
    };
    return cmocka_run_group_tests(tests, make_levels, free_levels);
}
