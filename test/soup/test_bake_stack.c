// SPDX-License-Identifier: MIT
//
// The stack of baking soups: 32 KB are promised, for trees as deep as they come too.

#define _DEFAULT_SOURCE // pthread_attr_setstack

#include "painted_stack.h"
#include "soup_models.h"

typedef struct bake_run {
    const model *m;
    tl_soup_def def;
    tl_result result;
} bake_run;

static void *run_bake(void *user)
{
    bake_run *run = user;
    tl_mesh_view view = model_view(run->m);
    tl_soup *soup = NULL;
    run->result = tl_soup_bake(&view, &run->def, &soup, NULL);
    tl_blob_free(soup);
    return NULL;
}

static void *run_nothing(void *user)
{
    (void)user;
    return NULL;
}

static void check_bakes(const model *m, const char *name)
{
    const size_t base = painted_stack_used(run_nothing, NULL);
    for (uint32_t kind = 0; kind < 4; kind++) {
        bake_run run = { m, tl_default_soup_def(), TL_ERR_ARGUMENT };
        run.def.split_budget = kind == 1 ? 0.3f : 0.0f;
        run.def.partition = kind == 2 ? TL_SOUP_KD_TREE : TL_SOUP_BVH;
        run.def.layout = kind == 3 ? TL_SOUP_COMPACT : TL_SOUP_FAST;
        const size_t used = painted_stack_used(run_bake, &run) - base;
        print_message("%s, kind %u: %zu bytes\n", name, kind, used);
        TEST_RESULT(run.result, TL_OK);
        TEST_CHECK(used > 4000 && used <= PROMISED_STACK);
    }
}

static void test_bakes_fit_small_stacks(void **state)
{
    (void)state;
#ifdef FRAMES_ARE_WIDER
    skip();
#endif
    model terrain = model_terrain(120, 3, tl_vec3_make(0, 0, 0), 9);
    check_bakes(&terrain, "terrain");
    model_free(&terrain);
    // Sizes that halve toward a corner: a tree as deep as the heuristic goes, and then halved by count.
    model chain = { 0 };
    for (uint32_t i = 0; i < 20000; i++) {
        float size = ldexpf(1.0f + (float)(i / 150) * 0.001f, 30 - (int)(i % 150));
        uint32_t a = model_vertex(&chain, size, 0, 0);
        model_vertex(&chain, size * 1.5f, 0, 0);
        model_vertex(&chain, size, size, size * 0.5f);
        model_triangle(&chain, a, a + 1, a + 2);
    }
    check_bakes(&chain, "chain");
    model_free(&chain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bakes_fit_small_stacks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
