// SPDX-License-Identifier: MIT
//
// coincident.c: every triangle is stored, whatever it coincides with; refitting, damage, and soups in which none do.
// What queries answer is in test_coincident_queries.c.

#include "coincident_levels.h"

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
        cmocka_unit_test(test_every_triangle_is_there), cmocka_unit_test(test_many),  cmocka_unit_test(test_none),
        cmocka_unit_test(test_damage_is_named),         cmocka_unit_test(test_refit),
    };
    return cmocka_run_group_tests(tests, make_levels, free_levels);
}
