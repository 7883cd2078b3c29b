// SPDX-License-Identifier: MIT
//
// The stack of the deepest calls of convex queries, soups and scenes: 32 KB are promised. Measured on the painted
// stack of a thread, in an optimised build without sanitizers.

#define _DEFAULT_SOURCE // pthread_attr_setstack

#include "painted_stack.h"
#include "scene_models.h"

#include <talus/character.h>

enum { CALLS = 300 };

typedef struct stack_run {
    const tl_scene *scene;
    const tl_scene_instance *instances;
    const tl_soup *soup;
    const tl_hull *hull;
    tl_character_mover *mover;
    uint32_t query, found;
} stack_run;

static tl_convex any_shape(const stack_run *run, uint32_t i)
{
    const tl_vec3 low = { 0, -1, 0 }, high = { 0, 1, 0 };
    return i % 4 == 0   ? tl_convex_from_hull(run->hull, 0.0f)
           : i % 4 == 1 ? tl_convex_box(low, tl_vec3_make(1, 2, 1), 0.0f)
           : i % 4 == 2 ? tl_convex_cylinder(low, high, 2.0f, 0.0f)
                        : tl_convex_cone(low, high, 2.0f, 0.1f);
}

// A character among the scene's parts, or in one of them: most moves push it out.
static bool move_character(const stack_run *run, tl_vec3 position, tl_vec3 motion)
{
    const tl_character_level level = { NULL, NULL, run->scene, run->instances, NULL };
    const tl_character_step step = { motion, 1.0f, false };
    tl_character character;
    tl_character_report report;
    memset(&character, 0, sizeof character);
    character.position = position;
    TEST_RESULT(tl_character_move(run->mover, &level, &step, &character, &report), TL_OK);
    return report.hit_count > 0 || report.pushed > 0.0f;
}

static bool run_query(const stack_run *run, test_random *random, uint32_t i)
{
    tl_convex shape = any_shape(run, i), other = any_shape(run, i / 4);
    tl_transform here = { scene_rotation(random),
                          test_random_point(random, tl_vec3_make(-5, -5, -5), tl_vec3_make(5, 5, 5)) };
    tl_transform near = { scene_rotation(random),
                          tl_mul_add(here.position, test_random_direction(random), i % 3 == 0 ? 0.0f : 1.0f) };
    tl_vec3 motion = tl_scale(test_random_direction(random), 5.0f);
    tl_scene_shape_hit scene_hit;
    tl_shape_hit soup_hit;
    tl_penetration penetration;
    tl_contact_manifold manifold;
    tl_convex_hit hit;
    const tl_soup_contact_query contacts_of = { &shape, here, { 0.1f, 0.1f, 0 }, NULL };
    uint32_t count;
    switch (run->query) {
    case 0:
        return false; // what the thread itself takes
    case 1:
        return tl_scene_cast_shape(run->scene, run->instances, &shape, here, motion, NULL, &scene_hit) == TL_OK;
    case 2:
        return tl_soup_cast_shape(run->soup, &shape, here, motion, NULL, &soup_hit) == TL_OK;
    case 3:
        return tl_convex_penetration(&shape, here, &other, near, NULL, &penetration);
    case 4:
        return tl_convex_contacts(&shape, here, &other, near, NULL, NULL, &manifold) > 0;
    case 6:
        return tl_soup_find_contacts(run->soup, &contacts_of, NULL, 0, &count) == TL_INCOMPLETE;
    case 7:
        return move_character(run, here.position, motion);
    default:
        return tl_convex_cast(&shape, here, &other, near, motion, &hit);
    }
}

static void *run_calls(void *user)
{
    stack_run *run = user;
    test_random random = { 21 };
    for (uint32_t i = 0; i < CALLS; i++) {
        run->found += run_query(run, &random, i);
    }
    return NULL;
}

static void test_queries_fit_small_stacks(void **state)
{
    (void)state;
#ifdef FRAMES_ARE_WIDER
    skip();
#endif
    static const char *const names[] = {
        "none",        "scene_cast_shape",   "soup_cast_shape", "convex_penetration", "convex_contacts",
        "convex_cast", "soup_find_contacts", "character_move"
    };
    scene_parts parts;
    scene_parts_make(&parts, 3.0f);
    tl_scene_instance instances[40];
    test_random random = { 20 };
    scene_fill(&parts, &random, tl_vec3_make(0, 0, 0), 5.0f, instances, 40);
    tl_scene *scene = scene_build(instances, 40);
    tl_hull *hull = scene_hull(60, 2.0f, 5);
    stack_run run = { scene, instances, NULL, hull, NULL, 0, 0 };
    tl_character_def mover_def = tl_default_character_def();
    mover_def.max_triangles = 1 << 14;
    TEST_RESULT(tl_character_mover_create(&mover_def, &run.mover, NULL), TL_OK);
    for (uint32_t i = 0; i < 40 && run.soup == NULL; i++) {
        run.soup = instances[i].soup;
    }
    size_t base = painted_stack_used(run_calls, &run);
    for (run.query = 1; run.query < sizeof names / sizeof names[0]; run.query++) {
        run.found = 0;
        size_t used = painted_stack_used(run_calls, &run) - base;
        print_message("%-20s %6zu bytes, %u of %d found something\n", names[run.query], used, run.found, CALLS);
        TEST_CHECK(run.found > 20 && used <= PROMISED_STACK);
    }
    tl_character_mover_destroy(run.mover);
    tl_blob_free(scene);
    tl_blob_free(hull);
    scene_parts_free(&parts);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_queries_fit_small_stacks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
