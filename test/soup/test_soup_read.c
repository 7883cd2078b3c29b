// SPDX-License-Identifier: MIT
//
// soup_read.c and what soup_bake.c wrote: all triangles come back bit by bit, box search equals a scan, boxes nest.

#include "soup_models.h"

#include <float.h>

static bool same_corner(tl_vec3 a, tl_vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static void check_enumeration(const model *m, const tl_soup *soup)
{
    uint8_t *seen = calloc(m->triangle_count, 1);
    TEST_CHECK(seen != NULL);
    uint64_t cursor = 0;
    uint32_t count = 0;
    tl_soup_triangle triangle;
    while (tl_soup_next_triangle(soup, &cursor, &triangle)) {
        TEST_CHECK(triangle.triangle < m->triangle_count && !seen[triangle.triangle]);
        seen[triangle.triangle] = 1;
        for (uint32_t k = 0; k < 3; k++) {
            TEST_CHECK(same_corner(triangle.corners[k], m->vertices[m->indices[3 * (size_t)triangle.triangle + k]]));
        }
        count++;
    }
    tl_soup_stats stats = tl_soup_get_stats(soup);
    TEST_CHECK(count == stats.triangle_count);
    uint32_t pairs = 0, singles = 0;
    tl_soup_pair pair;
    for (cursor = 0; tl_soup_next_pair(soup, &cursor, &pair);) {
        TEST_CHECK(seen[pair.triangles[0]]);
        if (pair.triangles[1] == TL_NO_TRIANGLE) {
            TEST_CHECK(same_corner(pair.corners[0], pair.corners[3]));
            singles++;
        } else {
            TEST_CHECK(seen[pair.triangles[1]]);
            pairs++;
        }
    }
    TEST_CHECK(pairs == stats.pair_count && singles == stats.single_count && 2 * pairs + singles == count);
    TEST_CHECK(stats.size >= 192 + stats.node_bytes + stats.leaf_bytes + stats.material_bytes);
    TEST_CHECK(stats.reference_count >= pairs + singles && stats.leaf_count * 4 >= stats.reference_count);
    free(seen);
}

typedef struct found_set {
    uint8_t *seen;
    uint32_t count, limit;
} found_set;

static bool mark_found(const tl_soup_triangle *triangle, void *user)
{
    found_set *set = user;
    TEST_CHECK(!set->seen[triangle->triangle]); // each once
    set->seen[triangle->triangle] = 1;
    return ++set->count != set->limit;
}

// Whether points of the triangle, picked at random, lie in the box: then the triangle touches it.
static bool surely_touches(const model *m, uint32_t triangle, tl_aabb box, test_random *random)
{
    const uint32_t *corner = m->indices + 3 * (size_t)triangle;
    for (uint32_t i = 0; i < 8; i++) {
        tl_vec3 p = tl_lerp(m->vertices[corner[0]], m->vertices[corner[1]], test_random_unit(random));
        p = tl_lerp(p, m->vertices[corner[2]], test_random_unit(random));
        tl_vec3 margin = tl_scale(tl_abs(p), 4 * FLT_EPSILON); // p itself is rounded
        tl_aabb inner = { tl_add(box.min, margin), tl_sub(box.max, margin) };
        if (tl_aabb_contains(inner, p)) {
            return true;
        }
    }
    return false;
}

static uint32_t check_box_search(const model *m, const tl_soup *soup, bool has_copies, uint64_t seed)
{
    test_random random = { seed };
    tl_aabb bounds = tl_soup_bounds(soup);
    found_set set = { malloc(m->triangle_count), 0, 0 };
    TEST_CHECK(set.seen != NULL);
    uint32_t empty = 0, some = 0, touching = 0;
    for (uint32_t i = 0; i < 300; i++) {
        tl_vec3 a = test_random_point(&random, bounds.min, bounds.max);
        tl_vec3 size = tl_scale(tl_aabb_size(bounds), i % 3 == 0 ? 0.0f : test_random_range(&random, 0, 0.3f));
        if (i % 7 == 0) { // touching a corner exactly
            a = m->vertices[m->indices[test_random_below(&random, 3 * m->triangle_count)]];
        }
        tl_aabb box = { a, tl_add(a, size) };
        memset(set.seen, 0, m->triangle_count);
        set.count = 0;
        set.limit = 0;
        TEST_CHECK(tl_soup_triangles_in_box(soup, box, mark_found, &set));
        for (uint32_t k = 0; k < m->triangle_count; k++) {
            tl_aabb own = tl_aabb_empty();
            for (uint32_t c = 0; c < 3; c++) {
                own = tl_aabb_add_point(own, m->vertices[m->indices[3 * (size_t)k + c]]);
            }
            TEST_CHECK(tl_aabb_overlaps(own, box) || !set.seen[k]);
            TEST_CHECK(has_copies || tl_aabb_overlaps(own, box) == (set.seen[k] != 0));
            if (surely_touches(m, k, box, &random)) {
                TEST_CHECK(set.seen[k]);
                touching++;
            }
        }
        some += set.count > 0;
        empty += set.count == 0;
        if (set.count > 1) {
            set.limit = 1;
            set.count = 0;
            memset(set.seen, 0, m->triangle_count);
            TEST_CHECK(!tl_soup_triangles_in_box(soup, box, mark_found, &set) && set.count == 1);
        }
    }
    TEST_CHECK(some > 50 && some + empty == 300);
    free(set.seen);
    return touching;
}

typedef struct box_walk {
    uint32_t count, leaves, deepest, limit;
    bool is_compact;
    tl_aabb path[128];
    tl_aabb leaf_union;
} box_walk;

static bool visit_box(tl_aabb box, uint32_t depth, bool leaf, void *user)
{
    box_walk *walk = user;
    TEST_CHECK(depth < 128 && depth <= walk->deepest + 1);
    if (depth == 0) {
        walk->leaf_union = tl_aabb_empty();
    } else {
        // A box of bytes may stand out of its parent's by a step, which is below 2 / 255 of the parent's, or FLT_MIN;
        // and cuts are rounded outward.
        tl_aabb parent = walk->path[depth - 1];
        tl_vec3 far_corner = tl_max(tl_abs(parent.min), tl_abs(parent.max));
        tl_vec3 step = tl_scale(tl_aabb_size(parent), walk->is_compact ? 2.0f / 255.0f : 0.0f);
        step = tl_mul_add(step, far_corner, 4 * FLT_EPSILON);
        step = tl_add(step, tl_vec3_make(2 * FLT_MIN, 2 * FLT_MIN, 2 * FLT_MIN));
        tl_aabb loose = { tl_sub(parent.min, step), tl_add(parent.max, step) };
        TEST_CHECK(tl_aabb_contains(loose, box.min) && tl_aabb_contains(loose, box.max));
    }
    walk->path[depth] = box;
    walk->deepest = depth > walk->deepest ? depth : walk->deepest;
    walk->count++;
    walk->leaves += leaf;
    if (leaf) {
        walk->leaf_union = tl_aabb_union(walk->leaf_union, box);
    }
    return walk->count != walk->limit;
}

static void check_tree_boxes(const tl_soup *soup)
{
    tl_soup_stats stats = tl_soup_get_stats(soup);
    bool is_compact = stats.layout == TL_SOUP_COMPACT;
    box_walk walk = { .is_compact = is_compact };
    TEST_CHECK(tl_soup_bvh_boxes(soup, UINT32_MAX, visit_box, &walk));
    TEST_CHECK(walk.count == stats.node_count + stats.leaf_count && walk.leaves == stats.leaf_count);
    TEST_CHECK(walk.deepest == stats.depth);
    TEST_CHECK(tl_aabb_contains(walk.leaf_union, tl_soup_bounds(soup).min));
    TEST_CHECK(tl_aabb_contains(walk.leaf_union, tl_soup_bounds(soup).max));
    box_walk shallow = { .is_compact = is_compact };
    TEST_CHECK(tl_soup_bvh_boxes(soup, 1, visit_box, &shallow));
    TEST_CHECK(shallow.count <= 17 && shallow.deepest == 1);
    box_walk root = { .is_compact = is_compact };
    TEST_CHECK(tl_soup_bvh_boxes(soup, 0, visit_box, &root) && root.count == 1);
    box_walk ended = { .is_compact = is_compact, .limit = 2 };
    TEST_CHECK(!tl_soup_bvh_boxes(soup, UINT32_MAX, visit_box, &ended) && ended.count == 2);
}

static uint32_t check_all(model m, model_storage storage)
{
    tl_soup_def def = model_soup_def(storage);
    tl_soup *soup = model_soup(&m, &def);
    TEST_RESULT(tl_soup_check(soup, tl_soup_size(soup), NULL), TL_OK);
    check_enumeration(&m, soup);
    uint32_t touching = check_box_search(&m, soup, storage != MODEL_BOXES, 1);
    check_tree_boxes(soup);
    tl_blob_free(soup);
    model_free(&m);
    return touching;
}

static void test_models(void **state)
{
    (void)state;
    uint32_t touching = 0;
    for (model_storage storage = MODEL_BOXES; storage < MODEL_STORAGES; storage++) {
        touching += check_all(model_random(1, 5, 1, 1), storage);
        touching += check_all(model_random(300, 5, 2, 2), storage);
        touching += check_all(model_terrain(16, 2, tl_vec3_make(0, 0, 0), 3), storage);
        touching += check_all(model_terrain(16, 2, tl_vec3_make(5000, 100, -5000), 4), storage);
        touching += check_all(model_ball(3, 1e-6f, 0.1f, tl_vec3_make(0, 0, 0), 5), storage);
        touching += check_all(model_random(100, 1e11f, 1e11f, 6), storage);
        touching += check_all(model_random(100, 1e-36f, 1e-37f, 7), storage);
    }
    TEST_CHECK(touching > 1000);
}

static void test_materials_come_back(void **state)
{
    (void)state;
    model m = model_random(50, 5, 1, 8);
    uint16_t materials[50];
    for (uint32_t i = 0; i < 50; i++) {
        materials[i] = 7;
    }
    tl_mesh_view view = model_view(&m);
    view.materials = materials;
    for (uint32_t mixed = 0; mixed < 2; mixed++) {
        materials[49] = mixed ? 65535 : 7;
        tl_soup *soup;
        TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
        TEST_CHECK(tl_soup_get_stats(soup).material_bytes == (mixed ? 100u : 0u));
        uint64_t cursor = 0;
        tl_soup_triangle triangle;
        while (tl_soup_next_triangle(soup, &cursor, &triangle)) {
            TEST_CHECK(triangle.material == materials[triangle.triangle]);
        }
        tl_blob_free(soup);
    }
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_models),
        cmocka_unit_test(test_materials_come_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
