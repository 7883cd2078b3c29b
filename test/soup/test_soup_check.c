// SPDX-License-Identifier: MIT
//
// soup_check.c: every truncated prefix is refused, and what is accepted after bits were flipped can be queried safely
// (the sanitizer build watches).

// posix_memalign gives a block of exactly the asked size, so that the sanitizer sees a read beyond it.
#define _POSIX_C_SOURCE 200112L

#include "soup_models.h"

static tl_soup *sample_soup(tl_soup_layout layout, uint32_t *size_out)
{
    model m = model_random(60, 4, 1, 1);
    model flat = model_terrain(3, 1, tl_vec3_make(0, 0, 0), 2);
    for (uint32_t i = 0; i < flat.triangle_count; i++) {
        uint32_t corner[3];
        for (uint32_t k = 0; k < 3; k++) {
            tl_vec3 v = flat.vertices[flat.indices[3 * i + k]];
            corner[k] = model_vertex(&m, v.x, v.y, v.z);
        }
        model_triangle(&m, corner[0], corner[1], corner[2]);
    }
    uint16_t *materials = calloc(m.triangle_count, sizeof *materials);
    TEST_CHECK(materials != NULL);
    materials[5] = 40000;
    tl_mesh_view view = model_view(&m);
    view.materials = materials;
    tl_soup_def def = tl_default_soup_def();
    def.layout = layout;
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, &def, &soup, NULL), TL_OK);
    tl_soup_stats stats = tl_soup_get_stats(soup);
    TEST_CHECK(stats.node_count > 1 && stats.pair_count > 5 && stats.single_count > 5);
    *size_out = (uint32_t)tl_soup_size(soup);
    free(materials);
    model_free(&m);
    model_free(&flat);
    return soup;
}

static bool count_triangle(const tl_soup_triangle *triangle, void *user)
{
    (void)triangle;
    return ++*(uint32_t *)user < 100000;
}

static bool count_box(tl_aabb box, uint32_t depth, bool leaf, void *user)
{
    (void)box;
    (void)depth;
    (void)leaf;
    return ++*(uint32_t *)user < 100000;
}

// All queries; whatever they answer, they must end and stay inside.
static void use_soup(const tl_soup *soup, test_random *random)
{
    for (uint32_t i = 0; i < 6; i++) {
        tl_vec3 low = tl_vec3_make(-6, -6, -6), high = tl_vec3_make(6, 6, 6);
        tl_ray ray = { test_random_point(random, low, high), test_random_direction(random), INFINITY };
        tl_ray_hit hit;
        if (tl_soup_cast_ray(soup, &ray, NULL, &hit)) {
            TEST_CHECK(hit.triangle < tl_soup_get_stats(soup).source_triangle_count);
        }
        tl_soup_occluded(soup, &ray, NULL);
        tl_soup_line_of_sight(soup, ray.origin, test_random_point(random, low, high), NULL);
    }
    uint64_t cursor = 0;
    uint32_t count = 0;
    tl_soup_triangle triangle;
    while (tl_soup_next_triangle(soup, &cursor, &triangle)) {
        count++;
    }
    TEST_CHECK(count == tl_soup_get_stats(soup).triangle_count);
    tl_soup_pair pair;
    for (cursor = 0, count = 0; tl_soup_next_pair(soup, &cursor, &pair);) {
        count++;
    }
    TEST_CHECK(count == tl_soup_get_stats(soup).pair_count + tl_soup_get_stats(soup).single_count);
    count = 0;
    tl_soup_triangles_in_box(soup, tl_soup_bounds(soup), count_triangle, &count);
    tl_soup_bvh_boxes(soup, UINT32_MAX, count_box, &count);
}

static void check_sound_soup_passes(tl_soup_layout layout)
{
    uint32_t size;
    tl_soup *soup = sample_soup(layout, &size);
    TEST_RESULT(tl_soup_check(soup, size, NULL), TL_OK);
    TEST_RESULT(tl_soup_check(soup, size + 1000, NULL), TL_OK); // more bytes may follow
    TEST_RESULT(tl_soup_check(NULL, size, NULL), TL_ERR_ARGUMENT);
    TEST_RESULT(tl_soup_check((const char *)soup + 16, size - 16, NULL), TL_ERR_ARGUMENT);
    ((tl_blob *)soup)->magic ^= 1;
    TEST_RESULT(tl_soup_check(soup, size, NULL), TL_ERR_MAGIC);
    ((tl_blob *)soup)->magic ^= 1;
    static const uint32_t others[] = { TL_SOUP_VERSION + 1, TL_SOUP_VERSION_ALONE - 1, 0 };
    for (uint32_t i = 0; i < 3; i++) {
        ((tl_blob *)soup)->version = others[i];
        TEST_RESULT(tl_soup_check(soup, size, NULL), TL_ERR_VERSION);
    }
    tl_blob_free(soup);
}

static void check_every_prefix_is_refused(tl_soup_layout layout)
{
    uint32_t size;
    tl_soup *soup = sample_soup(layout, &size);
    for (uint32_t prefix = 0; prefix < size; prefix++) {
        void *bytes = NULL;
        TEST_CHECK(posix_memalign(&bytes, TL_BLOB_ALIGNMENT, prefix + (prefix == 0)) == 0);
        memcpy(bytes, soup, prefix);
        TEST_RESULT(tl_soup_check(bytes, prefix, NULL), TL_ERR_TRUNCATED);
        if (prefix >= sizeof(tl_blob) && prefix % 64 == 0) {
            ((tl_blob *)bytes)->size = prefix; // a head that agrees with the cut
            TEST_CHECK(tl_soup_check(bytes, prefix, NULL) != TL_OK);
        }
        free(bytes);
    }
    tl_blob_free(soup);
}

static void check_flipped_bits_are_refused_or_harmless(tl_soup_layout layout)
{
    test_random random = { 3 };
    uint32_t size;
    tl_soup *soup = sample_soup(layout, &size);
    tl_soup *damaged = NULL;
    TEST_CHECK(posix_memalign((void **)&damaged, TL_BLOB_ALIGNMENT, size) == 0);
    uint32_t refused = 0, accepted = 0;
    for (uint32_t i = 0; i < 40000; i++) {
        memcpy(damaged, soup, size);
        uint32_t flips = 1 + i % 3;
        for (uint32_t k = 0; k < flips; k++) {
            // Heads and nodes more often than their share.
            uint32_t byte = test_random_below(&random, i % 2 == 0 ? size : i % 4 == 1 ? 192 : 1024);
            ((uint8_t *)damaged)[byte] ^= (uint8_t)(1u << test_random_below(&random, 8));
        }
        if (tl_soup_check(damaged, size, NULL) == TL_OK) {
            use_soup(damaged, &random);
            accepted++;
        } else {
            refused++;
        }
    }
    print_message("refused %u, accepted %u\n", refused, accepted);
    TEST_CHECK(refused > 10000 && accepted > 5000);
    free(damaged);
    tl_blob_free(soup);
}

static void test_random_bytes_are_refused(void **state)
{
    (void)state;
    test_random random = { 5 };
    static _Alignas(64) uint8_t bytes[4096];
    for (uint32_t i = 0; i < 2000; i++) {
        for (uint32_t k = 0; k < sizeof bytes; k++) {
            bytes[k] = (uint8_t)test_random_below(&random, i % 2 ? 256 : 3);
        }
        tl_blob head = { TL_SOUP_MAGIC, TL_SOUP_VERSION, sizeof bytes };
        memcpy(bytes, &head, i % 3 == 0 ? 0 : sizeof head);
        TEST_CHECK(tl_soup_check(bytes, sizeof bytes, NULL) != TL_OK);
    }
}

static void test_sound_soup_passes(void **state)
{
    (void)state;
    check_sound_soup_passes(TL_SOUP_FAST);
    check_sound_soup_passes(TL_SOUP_COMPACT);
}

static void test_every_prefix_is_refused(void **state)
{
    (void)state;
    check_every_prefix_is_refused(TL_SOUP_FAST);
    check_every_prefix_is_refused(TL_SOUP_COMPACT);
}

static void test_flipped_bits_are_refused_or_harmless(void **state)
{
    (void)state;
    check_flipped_bits_are_refused_or_harmless(TL_SOUP_FAST);
    check_flipped_bits_are_refused_or_harmless(TL_SOUP_COMPACT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sound_soup_passes),
        cmocka_unit_test(test_every_prefix_is_refused),
        cmocka_unit_test(test_flipped_bits_are_refused_or_harmless),
        cmocka_unit_test(test_random_bytes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
