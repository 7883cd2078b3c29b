// SPDX-License-Identifier: MIT
//
// coincident.c: triangles that take one lane answer every query as they do with a lane each, bit for bit. The oracle is
// the soup of the same pairs and tree that nothing was merged for.

#include "soup_models.h"

#include "base/lowest_bit.h"
#include "soup/bake/soup_bake.h"
#include "soup/layout/compact_layout.h"
#include "soup/ray/ray_job.h"

#include <math.h>
#include <talus/hull.h>
#include <talus/soup_scaled.h>

// ---------------------------------------------------------------------------------------------------------------------
// Levels with repeats.

// A level, and what its triangles are made of.
typedef struct level {
    model m;
    uint16_t *materials;
} level;

static uint32_t copy_corner(model *m, uint32_t vertex, bool own, test_random *random)
{
    if (!own) {
        return vertex;
    }
    tl_vec3 at = m->vertices[vertex];
    // Equal positions, other bits.
    at.x = at.x == 0.0f && test_random_below(random, 2) != 0 ? -at.x : at.x;
    return model_vertex(m, at.x, at.y, at.z);
}

// Repeats some triangles, up to `most` times, from any corner and in any winding, some with vertices of their own;
// drops in a few without area; in any order. Materials at random.
static level make_level(model m, uint32_t most, uint64_t seed)
{
    test_random random = { seed };
    const uint32_t count = m.triangle_count;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t repeats = test_random_below(&random, 3) == 0 ? 0 : test_random_below(&random, most) + 1;
        for (uint32_t r = 0; r < repeats; r++) {
            const uint8_t *order = tl_soup_corner_slots[1 + test_random_below(&random, 6)];
            const bool own = test_random_below(&random, 3) == 0;
            uint32_t corner[3];
            for (uint32_t k = 0; k < 3; k++) {
                corner[k] = copy_corner(&m, m.indices[3 * (size_t)i + order[k]], own, &random);
            }
            model_triangle(&m, corner[0], corner[1], corner[2]);
        }
        if (i % 16 == 0) {
            model_triangle(&m, m.indices[3 * (size_t)i], m.indices[3 * (size_t)i + 1], m.indices[3 * (size_t)i]);
        }
    }
    for (uint32_t i = m.triangle_count; i-- > 1;) {
        const uint32_t other = test_random_below(&random, i + 1);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t kept = m.indices[3 * (size_t)i + k];
            m.indices[3 * (size_t)i + k] = m.indices[3 * (size_t)other + k];
            m.indices[3 * (size_t)other + k] = kept;
        }
    }
    level l = { m, malloc(m.triangle_count * sizeof *l.materials) };
    TEST_CHECK(l.materials != NULL);
    for (uint32_t i = 0; i < m.triangle_count; i++) {
        l.materials[i] = (uint16_t)test_random_below(&random, 3);
    }
    return l;
}

static tl_mesh_view view_of(const level *l)
{
    tl_mesh_view view = model_view(&l->m);
    view.materials = l->materials;
    return view;
}

static void free_level(level *l)
{
    model_free(&l->m);
    free(l->materials);
}

// Triangles with corners of small integers, so that rays through integer points meet edges and corners; many coincide
// by chance.
static model lattice(uint32_t count, uint64_t seed)
{
    test_random random = { seed };
    model m = { 0 };
    for (uint32_t i = 0; i < count; i++) {
        uint32_t corner[3];
        const float x = (float)test_random_below(&random, 8), z = (float)test_random_below(&random, 8);
        for (uint32_t k = 0; k < 3; k++) {
            corner[k] = model_vertex(&m, x + (float)test_random_below(&random, 3), (float)test_random_below(&random, 3),
                                     z + (float)test_random_below(&random, 3));
        }
        model_triangle(&m, corner[0], corner[1], corner[2]);
    }
    return m;
}

static level levels[4];

static int make_levels(void **state)
{
    (void)state;
    levels[0] = make_level(lattice(300, 1), 3, 11);
    levels[1] = make_level(model_terrain(10, 2, tl_vec3_make(-5, 0, -5), 2), 1, 12);
    levels[2] = make_level(model_random(150, 6, 4, 3), 20, 13);
    levels[3] = make_level(model_ball(2, 3, 0.2f, tl_vec3_make(900, 0, 50), 4), 2, 14);
    return 0;
}

static int free_levels(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 4; i++) {
        free_level(&levels[i]);
    }
    return 0;
}

// ---------------------------------------------------------------------------------------------------------------------
// The oracle.

// A soup in which every triangle has its own lane.
static tl_soup *bake_apart(const tl_mesh_view *view, const tl_soup_def *def)
{
    tl_mesh_def mesh_def = tl_default_mesh_def();
    mesh_def.keep_duplicates = true;
    tl_mesh mesh;
    TEST_RESULT(tl_mesh_bake(view, &mesh_def, &mesh, NULL), TL_OK);
    tl_arena arena;
    tl_arena_init(&arena, mesh.allocator.allocate != NULL ? &mesh.allocator : NULL);
    tl_triangle_pair *pairs;
    tl_bvh_input input = { &mesh, NULL, 0, def->split_budget };
    TEST_RESULT(tl_pair_triangles(&mesh, def->pair_triangles, NULL, &arena, &pairs, &input.pair_count), TL_OK);
    input.pairs = pairs;
    tl_bvh tree;
    TEST_RESULT(def->partition == TL_SOUP_KD_TREE ? tl_kd_build(&input, NULL, &arena, &tree)
                                                  : tl_bvh_build(&input, NULL, &arena, &tree),
                TL_OK);
    const tl_soup_parts parts = { view, &mesh, pairs, input.pair_count, { NULL, 0, 0 }, &tree };
    tl_soup *soup;
    TEST_RESULT(tl_soup_encode(&parts, def->layout, NULL, &arena, &soup), TL_OK);
    tl_arena_free(&arena);
    tl_mesh_free(&mesh);
    return soup;
}

// The same level with lanes shared, and not.
typedef struct both_soups {
    tl_soup *merged, *apart;
} both_soups;

static both_soups bake_both(const level *l, model_storage storage)
{
    const tl_mesh_view view = view_of(l);
    const tl_soup_def def = model_soup_def(storage);
    both_soups both;
    tl_soup_report report;
    TEST_RESULT(tl_soup_bake(&view, &def, &both.merged, &report), TL_OK);
    both.apart = bake_apart(&view, &def);
    TEST_RESULT(tl_soup_check(both.merged, tl_soup_size(both.merged), NULL), TL_OK);
    const tl_soup_stats merged = tl_soup_get_stats(both.merged), apart = tl_soup_get_stats(both.apart);
    TEST_CHECK(merged.triangle_count == apart.triangle_count && apart.coincident_count == 0);
    TEST_CHECK(merged.coincident_count > merged.triangle_count / 5);
    TEST_CHECK(report.coincident_count == merged.coincident_count && report.triangle_count == merged.triangle_count);
    TEST_CHECK(merged.leaf_bytes < apart.leaf_bytes);
    return both;
}

static void free_both(both_soups *both)
{
    tl_blob_free(both->merged);
    tl_blob_free(both->apart);
}

// ---------------------------------------------------------------------------------------------------------------------
// Questions.

static bool accept_some(uint32_t triangle, uint16_t material, void *user)
{
    (void)user;
    return (triangle * 2654435761u >> 16) % 3 != 0 && material != 1;
}

static const tl_ray_filter filters[] = {
    { TL_RAY_CULL_NONE, 0, NULL, NULL },        { TL_RAY_CULL_BACK, 0, NULL, NULL },
    { TL_RAY_CULL_FRONT, 0, NULL, NULL },       { TL_RAY_CULL_NONE, 2, NULL, NULL },
    { TL_RAY_CULL_NONE, 0, accept_some, NULL }, { TL_RAY_CULL_BACK, 1, accept_some, NULL }
};
enum { FILTERS = sizeof filters / sizeof filters[0] };

// Among the triangles, through integer points, or nearly in the plane of a triangle, where t rounds differently from
// each corner.
static tl_ray any_ray(const level *l, const tl_soup *soup, test_random *random)
{
    const tl_aabb box = tl_soup_bounds(soup);
    const uint32_t *v = l->m.indices + 3 * (size_t)test_random_below(random, l->m.triangle_count);
    const tl_vec3 a = l->m.vertices[v[0]], b = l->m.vertices[v[1]], c = l->m.vertices[v[2]];
    tl_ray ray = { test_random_point(random, box.min, box.max), test_random_direction(random), INFINITY };
    switch (test_random_below(random, 4)) {
    case 0: {
        const tl_vec3 from = test_random_point(random, box.min, box.max);
        ray.origin = tl_vec3_make(floorf(from.x), floorf(from.y), floorf(from.z));
        ray.direction = tl_sub(test_random_below(random, 2) != 0 ? a : tl_scale(tl_add(a, b), 0.5f), ray.origin);
        break;
    }
    case 1: {
        const tl_vec3 p = tl_sub(b, a), q = tl_sub(c, a);
        const float u = test_random_unit(random) * 0.5f, w = test_random_unit(random) * 0.5f;
        const tl_vec3 at = tl_add(a, tl_add(tl_scale(p, u), tl_scale(q, w)));
        const tl_vec3 along =
            tl_add(tl_scale(p, test_random_range(random, -1, 1)), tl_scale(q, test_random_range(random, -1, 1)));
        const tl_vec3 up = tl_scale(tl_cross(p, q), ldexpf(1.0f, -10 - (int)test_random_below(random, 10)));
        ray.direction = tl_add(along, up);
        ray.origin = tl_sub(at, ray.direction);
        break;
    }
    default:
        ray.tmax = test_random_below(random, 2) != 0 ? test_random_range(random, 0, 8) : INFINITY;
        break;
    }
    return ray;
}

// Bits of fields, not of padding.
static bool same_float(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static bool same_vec(tl_vec3 a, tl_vec3 b)
{
    return same_float(a.x, b.x) && same_float(a.y, b.y) && same_float(a.z, b.z);
}

static bool same_hit(const tl_ray_hit *a, const tl_ray_hit *b)
{
    return same_float(a->t, b->t) && a->triangle == b->triangle && same_float(a->u, b->u) && same_float(a->v, b->v) &&
           same_vec(a->normal, b->normal) && a->material == b->material && a->back == b->back;
}

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

// ---------------------------------------------------------------------------------------------------------------------
// What is stored.

static void count_triangle(const level *l, const tl_soup_triangle *t, uint8_t *seen)
{
    TEST_CHECK(seen[t->triangle]++ == 0 && t->material == l->materials[t->triangle]);
    for (uint32_t k = 0; k < 3; k++) {
        const tl_vec3 v = l->m.vertices[l->m.indices[3 * (size_t)t->triangle + k]];
        TEST_CHECK(v.x == t->corners[k].x && v.y == t->corners[k].y && v.z == t->corners[k].z);
    }
}

typedef struct box_visit {
    const level *l;
    uint8_t *seen;
} box_visit;

static bool visit_in_box(const tl_soup_triangle *triangle, void *user)
{
    const box_visit *v = user;
    count_triangle(v->l, triangle, v->seen);
    return true;
}

static void test_every_triangle_is_there(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 4 * MODEL_STORAGES; i++) {
        const level *l = &levels[i % 4];
        both_soups both = bake_both(l, (model_storage)(i / 4));
        const tl_soup_stats stats = tl_soup_get_stats(both.merged);
        uint8_t *seen = calloc(l->m.triangle_count, 1), *in_box = calloc(l->m.triangle_count, 1);
        TEST_CHECK(seen != NULL && in_box != NULL);
        uint64_t cursor = 0;
        tl_soup_triangle triangle;
        while (tl_soup_next_triangle(both.merged, &cursor, &triangle)) {
            count_triangle(l, &triangle, seen);
        }
        box_visit visit = { l, in_box };
        TEST_CHECK(tl_soup_triangles_in_box(both.merged, tl_soup_bounds(both.merged), visit_in_box, &visit));
        uint32_t count = 0;
        for (uint32_t t = 0; t < l->m.triangle_count; t++) {
            TEST_CHECK(seen[t] == in_box[t]);
            count += seen[t];
        }
        TEST_CHECK(count == stats.triangle_count &&
                   count == 2 * stats.pair_count + stats.single_count + stats.coincident_count);
        tl_soup_pair pair;
        for (cursor = 0, count = 0; tl_soup_next_pair(both.merged, &cursor, &pair); count++) {
            TEST_CHECK(pair.triangles[0] < stats.source_triangle_count);
        }
        TEST_CHECK(count == stats.pair_count + stats.single_count);
        free(seen);
        free(in_box);
        free_both(&both);
    }
}

// Any number of repeats, in lanes of eight; a fan that fills its vertex's mask, with and without them.
static void test_many(void **state)
{
    (void)state;
    for (uint32_t count = 1; count < 40; count++) {
        model m = model_one_triangle();
        for (uint32_t i = 1; i < count; i++) {
            const uint8_t *order = tl_soup_corner_slots[1 + i % 6];
            model_triangle(&m, order[0], order[1], order[2]);
        }
        tl_soup *soup = model_soup(&m, NULL);
        const tl_soup_stats stats = tl_soup_get_stats(soup);
        TEST_CHECK(stats.triangle_count == count && 2 * stats.pair_count + stats.single_count == (count + 7) / 8);
        TEST_RESULT(tl_soup_check(soup, tl_soup_size(soup), NULL), TL_OK);
        const tl_ray up = { { 1, -1, 1 }, { 0, 1, 0 }, INFINITY };
        tl_ray_hit hits[40];
        uint32_t found;
        TEST_RESULT(tl_soup_cast_ray_all(soup, &up, TL_HITS_TOUCHED, NULL, hits, 40, &found), TL_OK);
        TEST_CHECK(found == count && hits[count - 1].triangle == count - 1);
        tl_blob_free(soup);
        model_free(&m);
    }
    for (uint32_t repeats = 1; repeats <= 2; repeats++) {
        model m = { 0 };
        enum { FAN = 3000 };
        model_vertex(&m, 0, 1, 0);
        for (uint32_t i = 0; i <= FAN; i++) {
            model_vertex(&m, (float)i, 0, (float)(i % 7));
        }
        for (uint32_t i = 0; i < FAN * repeats; i++) {
            model_triangle(&m, 0, 1 + i % FAN, 2 + i % FAN);
        }
        tl_soup *soup = model_soup(&m, NULL);
        TEST_CHECK(tl_soup_get_stats(soup).coincident_count == FAN * (repeats - 1));
        tl_blob_free(soup);
        model_free(&m);
    }
}

// A soup in which none coincide is of the version that older readers open, byte for byte what they have written.
static void test_none(void **state)
{
    (void)state;
    model m = model_terrain(12, 2, tl_vec3_make(0, 0, 0), 1);
    const tl_mesh_view view = model_view(&m);
    for (uint32_t storage = 0; storage < MODEL_STORAGES; storage++) {
        const tl_soup_def def = model_soup_def((model_storage)storage);
        tl_soup *soup = model_soup(&m, &def), *apart = bake_apart(&view, &def);
        TEST_CHECK(((const tl_blob *)soup)->version == TL_SOUP_VERSION_ALONE);
        TEST_CHECK(tl_soup_size(soup) == tl_soup_size(apart));
        TEST_CHECK(memcmp((const char *)soup + sizeof(tl_blob), (const char *)apart + sizeof(tl_blob),
                          tl_soup_size(soup) - sizeof(tl_blob)) == 0);
        tl_blob_free(soup);
        tl_blob_free(apart);
    }
    model_free(&m);
}

static void test_damage_is_named(void **state)
{
    (void)state;
    both_soups both = bake_both(&levels[0], MODEL_BOXES);
    tl_soup *soup = both.merged;
    const uint64_t size = tl_soup_size(soup);
    TEST_CHECK(soup->blob.version == TL_SOUP_VERSION && soup->coincident_words > 10);
    uint32_t *words = (uint32_t *)(void *)((char *)soup + soup->coincident_offset);
    soup->blob.version = TL_SOUP_VERSION_ALONE;
    TEST_RESULT(tl_soup_check(soup, size, NULL), TL_ERR_CORRUPT);
    soup->blob.version = TL_SOUP_VERSION;
    static const uint32_t flips[] = { TL_ID_LAST, TL_ID_INDEX, 7u << 29 };
    for (uint32_t i = 0; i < soup->coincident_words; i += i + 3 < soup->coincident_words ? 1 : 3) {
        for (uint32_t k = 0; k < 2; k++) {
            words[i] ^= flips[k];
            TEST_RESULT(tl_soup_check(soup, size, NULL), TL_ERR_CORRUPT);
            words[i] ^= flips[k];
        }
    }
    soup->coincident_words -= 16;
    TEST_RESULT(tl_soup_check(soup, size, NULL), TL_ERR_CORRUPT);
    soup->coincident_words = UINT32_MAX;
    TEST_RESULT(tl_soup_check(soup, size, NULL), TL_ERR_CORRUPT);
    free_both(&both);
}

static void test_refit(void **state)
{
    (void)state;
    test_random random = { 26 };
    level *l = &levels[1];
    both_soups both = bake_both(l, MODEL_BOXES);
    model moved = { 0 };
    for (uint32_t i = 0; i < l->m.vertex_count; i++) {
        const tl_vec3 v = l->m.vertices[i]; // equal positions move equally
        model_vertex(&moved, v.x + 0.3f * v.y, v.y - 0.1f * v.x * v.z, v.z + 1.0f);
    }
    tl_mesh_view view = view_of(l);
    view.vertices = moved.vertices;
    TEST_RESULT(tl_soup_refit(both.merged, &view, NULL), TL_OK);
    TEST_RESULT(tl_soup_refit(both.apart, &view, NULL), TL_OK);
    TEST_RESULT(tl_soup_check(both.merged, tl_soup_size(both.merged), NULL), TL_OK);
    for (uint32_t r = 0; r < 5000; r++) {
        const tl_ray ray = any_ray(l, both.apart, &random);
        tl_ray_hit hit, expected;
        const bool is_hit = tl_soup_cast_ray(both.apart, &ray, &filters[r % FILTERS], &expected);
        TEST_CHECK(tl_soup_cast_ray(both.merged, &ray, &filters[r % FILTERS], &hit) == is_hit);
        TEST_CHECK(!is_hit || same_hit(&hit, &expected));
    }
    // One of two that coincide moves away.
    model two = model_one_triangle();
    for (uint32_t k = 0; k < 3; k++) {
        const tl_vec3 v = two.vertices[(k + 1) % 3];
        model_vertex(&two, v.x, v.y, v.z);
    }
    model_triangle(&two, 4, 3, 5);
    tl_soup *soup = model_soup(&two, NULL);
    TEST_CHECK(tl_soup_get_stats(soup).coincident_count == 1);
    view = model_view(&two);
    TEST_RESULT(tl_soup_refit(soup, &view, NULL), TL_OK);
    two.vertices[4].y = 1.0f;
    tl_report report;
    TEST_RESULT(tl_soup_refit(soup, &view, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.element, "triangle") == 0 && report.element_index == 1);
    tl_blob_free(soup);
    model_free(&two);
    model_free(&moved);
    free_both(&both);
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
        cmocka_unit_test(test_every_triangle_is_there),
        cmocka_unit_test(test_many),
        cmocka_unit_test(test_none),
        cmocka_unit_test(test_damage_is_named),
        cmocka_unit_test(test_refit),
    };
    return cmocka_run_group_tests(tests, make_levels, free_levels);
}
