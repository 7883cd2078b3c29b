// SPDX-License-Identifier: MIT
//
// Levels with triangles that coincide, baked as they are and, as an oracle, with a lane for each; and what is asked of
// both.

#ifndef TALUS_TEST_COINCIDENT_LEVELS_H
#define TALUS_TEST_COINCIDENT_LEVELS_H

#include "soup_models.h"

#include "base/lowest_bit.h"
#include "soup/bake/soup_bake.h"
#include "soup/layout/compact_layout.h"
#include "soup/ray/ray_job.h"

#include <math.h>

// ---------------------------------------------------------------------------------------------------------------------
// Levels with repeats.

// A level, and what its triangles are made of.
typedef struct level {
    model m;
    uint16_t *materials;
} level;

static inline uint32_t copy_corner(model *m, uint32_t vertex, bool own, test_random *random)
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
static inline level make_level(model m, uint32_t most, uint64_t seed)
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

static inline tl_mesh_view view_of(const level *l)
{
    tl_mesh_view view = model_view(&l->m);
    view.materials = l->materials;
    return view;
}

static inline void free_level(level *l)
{
    model_free(&l->m);
    free(l->materials);
}

// Triangles with corners of small integers, so that rays through integer points meet edges and corners; many coincide
// by chance.
static inline model lattice(uint32_t count, uint64_t seed)
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

static inline int make_levels(void **state)
{
    (void)state;
    levels[0] = make_level(lattice(300, 1), 3, 11);
    levels[1] = make_level(model_terrain(10, 2, tl_vec3_make(-5, 0, -5), 2), 1, 12);
    levels[2] = make_level(model_random(150, 6, 4, 3), 20, 13);
    levels[3] = make_level(model_ball(2, 3, 0.2f, tl_vec3_make(900, 0, 50), 4), 2, 14);
    return 0;
}

static inline int free_levels(void **state)
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
static inline tl_soup *bake_apart(const tl_mesh_view *view, const tl_soup_def *def)
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

static inline both_soups bake_both(const level *l, model_storage storage)
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

static inline void free_both(both_soups *both)
{
    tl_blob_free(both->merged);
    tl_blob_free(both->apart);
}

// ---------------------------------------------------------------------------------------------------------------------
// Questions.

static inline bool accept_some(uint32_t triangle, uint16_t material, void *user)
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
static inline tl_ray any_ray(const level *l, const tl_soup *soup, test_random *random)
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
static inline bool same_float(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static inline bool same_vec(tl_vec3 a, tl_vec3 b)
{
    return same_float(a.x, b.x) && same_float(a.y, b.y) && same_float(a.z, b.z);
}

static inline bool same_hit(const tl_ray_hit *a, const tl_ray_hit *b)
{
    return same_float(a->t, b->t) && a->triangle == b->triangle && same_float(a->u, b->u) && same_float(a->v, b->v) &&
           same_vec(a->normal, b->normal) && a->material == b->material && a->back == b->back;
}

#endif
