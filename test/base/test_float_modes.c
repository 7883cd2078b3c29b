// SPDX-License-Identifier: MIT
//
// The caller's floating-point mode. Flush to zero, which many programs set, changes no byte of levels of ordinary size.
// Another rounding mode than to nearest is the caller's mistake (docs/design.md): what is baked under it may be wrong,
// but every call ends, and what follows under the right mode is right again.

#include "soup_models.h"

#include <fenv.h>
#include <talus/hull.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

static size_t test_blob_size(const void *blob)
{
    return (size_t)((const tl_blob *)blob)->size;
}

typedef struct baked {
    tl_soup *soup;
    tl_hull *hull;
    uint32_t hits;
} baked;

static uint32_t cast_rays(const tl_soup *soup)
{
    test_random random = { 4 };
    uint32_t hits = 0;
    for (uint32_t i = 0; i < 2000; i++) {
        tl_ray ray = { test_random_point(&random, tl_vec3_make(-5, -5, -5), tl_vec3_make(45, 5, 45)),
                       test_random_direction(&random), 100.0f };
        tl_ray_hit hit;
        hits += tl_soup_cast_ray(soup, &ray, NULL, &hit);
    }
    return hits;
}

static baked bake_all(const model *m)
{
    baked b = { NULL, NULL, 0 };
    tl_mesh_view view = model_view(m);
    if (tl_soup_bake(&view, NULL, &b.soup, NULL) == TL_OK) {
        b.hits = cast_rays(b.soup);
    }
    (void)tl_hull_bake(m->vertices, m->vertex_count, NULL, &b.hull, NULL);
    return b;
}

static void free_baked(baked *b)
{
    tl_blob_free(b->soup);
    tl_blob_free(b->hull);
}

static void check_equal(const baked *a, const baked *b)
{
    TEST_CHECK(a->hits == b->hits && tl_soup_size(a->soup) == tl_soup_size(b->soup));
    TEST_CHECK(memcmp(a->soup, b->soup, tl_soup_size(a->soup)) == 0);
    TEST_CHECK(test_blob_size(a->hull) == test_blob_size(b->hull));
    TEST_CHECK(memcmp(a->hull, b->hull, test_blob_size(a->hull)) == 0);
}

static void test_other_rounding_modes_end(void **state)
{
    (void)state;
    static const int modes[] = { FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO };
    model m = model_terrain(40, 3, tl_vec3_make(0, 0, 0), 9);
    baked right = bake_all(&m);
    TEST_CHECK(right.soup != NULL && right.hull != NULL && right.hits > 100);
    for (size_t i = 0; i < sizeof modes / sizeof modes[0]; i++) {
        TEST_CHECK(fesetround(modes[i]) == 0);
        baked other = bake_all(&m);
        TEST_CHECK(fegetround() == modes[i]); // the library leaves the mode alone
        TEST_CHECK(fesetround(FE_TONEAREST) == 0);
        free_baked(&other);
        baked again = bake_all(&m);
        check_equal(&right, &again);
        free_baked(&again);
    }
    free_baked(&right);
    model_free(&m);
}

static void test_flush_to_zero_changes_nothing(void **state)
{
    (void)state;
#if defined(__SSE2__)
    model m = model_terrain(40, 3, tl_vec3_make(0, 0, 0), 9);
    baked right = bake_all(&m);
    const unsigned kept = _mm_getcsr();
    _mm_setcsr(kept | 0x8040u); // flush to zero, denormals are zero
    baked flushed = bake_all(&m);
    _mm_setcsr(kept);
    check_equal(&right, &flushed);
    free_baked(&right);
    free_baked(&flushed);
    model_free(&m);
#else
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_other_rounding_modes_end),
        cmocka_unit_test(test_flush_to_zero_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
