// SPDX-License-Identifier: MIT
//
// scene.h.

#include "contract.h"

#include <string.h>

enum { LEVEL, BALL, COUNT };

// The level, and a ball above it.
typedef struct scene_fixture {
    tl_convex ball;
    tl_scene_instance instances[COUNT];
    tl_scene *scene;
} scene_fixture;

static void place(scene_fixture *f, bool zero_rotation)
{
    memset(f, 0, sizeof *f);
    f->ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1);
    f->instances[LEVEL].soup = contract_level_get()->soup;
    f->instances[BALL].shape = &f->ball;
    for (int i = 0; i < COUNT; i++) {
        f->instances[i].pose.rotation.w = zero_rotation ? 0.0f : 1.0f;
        f->instances[i].mask = 1;
    }
    f->instances[BALL].pose.position = tl_vec3_make(4, 4, 10);
}

static const scene_fixture *fixture(void)
{
    static scene_fixture f;
    if (f.scene == NULL) {
        place(&f, false);
        TEST_RESULT(tl_scene_bake(f.instances, COUNT, NULL, &f.scene, NULL), TL_OK);
    }
    return &f;
}

static bool accept_all(uint32_t instance, void *user)
{
    (void)instance;
    (void)user;
    return true;
}

// Three ways to say that nothing is ignored.
static const tl_scene_filter *filter_of(const contract_run *run, tl_scene_filter *filter)
{
    memset(filter, 0, sizeof *filter);
    filter->accept = run->what == CONTRACT_ZEROED_FILTER ? NULL : accept_all;
    return run->what == CONTRACT_NULL_DEF ? NULL : filter;
}

static uint64_t first_hit(const scene_fixture *f, const tl_scene *scene, const tl_scene_filter *filter)
{
    const tl_ray ray = { { 4, 10, 10 }, { 0, -1, 0 }, INFINITY };
    tl_scene_hit hit;
    TEST_CHECK(tl_scene_cast_ray(scene, f->instances, &ray, filter, &hit));
    return hit.instance;
}

static tl_result bake(contract_run *run)
{
    scene_fixture f;
    place(&f, run->what == CONTRACT_ZERO_ROTATION);
    const tl_result result =
        tl_scene_bake(CONTRACT_INPUT(run, 0, f.instances), COUNT, run->what == CONTRACT_NULL_DEF ? NULL : run->host,
                      CONTRACT_OUTPUT(run, 0, &f.scene), run->report);
    run->is_clear = f.scene == NULL;
    run->answer = f.scene != NULL ? first_hit(&f, f.scene, NULL) : 0;
    tl_blob_free(f.scene);
    return result;
}

static tl_result refit(contract_run *run)
{
    scene_fixture f;
    place(&f, run->what == CONTRACT_ZERO_ROTATION);
    TEST_RESULT(tl_scene_bake(f.instances, COUNT, NULL, &f.scene, NULL), TL_OK);
    float growth = 7.0f;
    const tl_result result = tl_scene_refit(CONTRACT_INPUT(run, 0, f.scene), CONTRACT_INPUT(run, 1, f.instances), COUNT,
                                            &growth, run->report);
    run->is_clear = growth == 0.0f;
    run->answer = first_hit(&f, f.scene, NULL);
    tl_blob_free(f.scene);
    return result;
}

static tl_result cast_ray(contract_run *run)
{
    tl_scene_filter filter;
    run->answer = first_hit(fixture(), fixture()->scene, filter_of(run, &filter));
    return TL_OK;
}

static tl_result occluded(contract_run *run)
{
    tl_scene_filter filter;
    const tl_ray ray = { { 4, 10, 10 }, { 0, -1, 0 }, INFINITY };
    run->answer = tl_scene_occluded(fixture()->scene, fixture()->instances, &ray, filter_of(run, &filter));
    return TL_OK;
}

static tl_result line_of_sight(contract_run *run)
{
    tl_scene_filter filter;
    run->answer = tl_scene_line_of_sight(fixture()->scene, fixture()->instances, tl_vec3_make(4, 10, 10),
                                         tl_vec3_make(4, 1, 10), filter_of(run, &filter));
    return TL_OK;
}

static tl_result cast_shape(contract_run *run)
{
    const scene_fixture *f = fixture();
    tl_scene_filter filter;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.5f, 0.5f), 0);
    tl_scene_shape_hit hit;
    memset(&hit, 0xff, sizeof hit);
    const tl_result result = tl_scene_cast_shape(
        CONTRACT_INPUT(run, 0, f->scene), CONTRACT_INPUT(run, 1, f->instances), CONTRACT_INPUT(run, 2, &shape),
        contract_pose(run, tl_vec3_make(4, 8, 10)), tl_vec3_make(0, run->what == CONTRACT_NOT_FOUND ? 8.0f : -8.0f, 0),
        filter_of(run, &filter), CONTRACT_OUTPUT(run, 0, &hit));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&hit, sizeof hit);
    run->answer = contract_hash(&hit.hit.t, sizeof hit.hit.t, hit.instance);
    return result;
}

static tl_result overlaps(contract_run *run)
{
    const scene_fixture *f = fixture();
    tl_scene_filter filter;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0);
    const tl_scene_overlap_query query = { CONTRACT_INPUT(run, 3, &shape), contract_pose(run, tl_vec3_make(4, 3, 10)),
                                           filter_of(run, &filter) };
    bool touches = true;
    const tl_result result = tl_scene_overlaps(CONTRACT_INPUT(run, 0, f->scene), CONTRACT_INPUT(run, 1, f->instances),
                                               CONTRACT_INPUT(run, 2, &query), CONTRACT_OUTPUT(run, 0, &touches));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || !touches;
    run->answer = touches;
    return result;
}

static tl_result find_overlaps(contract_run *run)
{
    enum { FOUND = 2 };
    const scene_fixture *f = fixture();
    tl_scene_filter filter;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 2, 1), 0);
    const tl_scene_overlap_query query = { CONTRACT_INPUT(run, 3, &shape), contract_pose(run, tl_vec3_make(4, 2, 10)),
                                           filter_of(run, &filter) };
    tl_scene_overlap found[FOUND] = { { 0 } };
    uint32_t count = 99;
    const bool no_buffer = run->what == CONTRACT_NO_BUFFER || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 1);
    const uint32_t capacity = run->what == CONTRACT_NO_BUFFER      ? 0
                              : run->what == CONTRACT_SHORT_BUFFER ? FOUND - 1
                                                                   : FOUND;
    const tl_result result = tl_scene_find_overlaps(
        CONTRACT_INPUT(run, 0, f->scene), CONTRACT_INPUT(run, 1, f->instances), CONTRACT_INPUT(run, 2, &query),
        no_buffer ? NULL : found, capacity, CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0 || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 0);
    run->count = count;
    run->answer = contract_hash(found, sizeof found, 0);
    return result;
}

static tl_result nearest(contract_run *run)
{
    const scene_fixture *f = fixture();
    tl_scene_filter filter;
    tl_scene_point point;
    memset(&point, 0xff, sizeof point);
    const tl_result result = tl_scene_nearest(CONTRACT_INPUT(run, 0, f->scene), CONTRACT_INPUT(run, 1, f->instances),
                                              tl_vec3_make(4, 8, 10), run->what == CONTRACT_NOT_FOUND ? 0.5f : INFINITY,
                                              filter_of(run, &filter), CONTRACT_OUTPUT(run, 0, &point));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&point, sizeof point);
    run->answer = contract_hash(&point.point.point, sizeof point.point.point, point.instance);
    return result;
}

static bool add_instance(uint32_t instance, void *user)
{
    uint64_t *sum = user;
    *sum = 10 * *sum + instance + 1;
    return true;
}

static tl_result instances_in_box(contract_run *run)
{
    tl_scene_filter filter;
    TEST_CHECK(tl_scene_instances_in_box(fixture()->scene, tl_scene_bounds(fixture()->scene), filter_of(run, &filter),
                                         add_instance, &run->answer));
    return TL_OK;
}

enum {
    FILTERED = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_FILTER),
    REFUSING = CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT),
    REPORTED = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(ZERO_ROTATION)
};

const contract_entry CONTRACT_TABLE_scene[] = {
    { "tl_scene_bake", REPORTED | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY), 1, 1,
      NULL, bake, NULL },
    { "tl_scene_refit", REPORTED, 2, 0, NULL, refit, NULL },
    { "tl_scene_bounds", 0, 0, 0, NULL, NULL, "reads a field" },
    { "tl_scene_get_stats", 0, 0, 0, NULL, NULL, "reads fields: test_scene_bake.c" },
    { "tl_scene_cast_ray", FILTERED, 0, 0, NULL, cast_ray, NULL },
    { "tl_scene_occluded", FILTERED, 0, 0, NULL, occluded, NULL },
    { "tl_scene_line_of_sight", FILTERED, 0, 0, NULL, line_of_sight, NULL },
    { "tl_scene_cast_shape", FILTERED | REFUSING | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(ZERO_ROTATION), 3, 1, NULL,
      cast_shape, NULL },
    { "tl_scene_overlaps", FILTERED | REFUSING | CONTRACT_BIT(ZERO_ROTATION), 4, 1, NULL, overlaps, NULL },
    { "tl_scene_find_overlaps",
      FILTERED | REFUSING | CONTRACT_BIT(ZERO_ROTATION) | CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER), 4, 2,
      NULL, find_overlaps, NULL },
    { "tl_scene_nearest", FILTERED | REFUSING | CONTRACT_BIT(NOT_FOUND), 2, 1, NULL, nearest, NULL },
    { "tl_scene_instances_in_box", FILTERED, 0, 0, NULL, instances_in_box, NULL },
    { 0 },
};
