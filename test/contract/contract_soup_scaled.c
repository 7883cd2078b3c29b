// SPDX-License-Identifier: MIT
//
// soup_scaled.h.

#include "contract.h"

#include <string.h>
#include <talus/soup_scaled.h>

// The level, twice as large; input 1 is its soup.
static tl_scaled_soup twice(const contract_run *run)
{
    const tl_scaled_soup scaled = { CONTRACT_INPUT(run, 1, contract_level_get()->soup), { 2, 2, 2 } };
    return scaled;
}

static tl_result nearest(contract_run *run)
{
    const tl_scaled_soup scaled = twice(run);
    tl_ray_filter filter;
    tl_soup_point point;
    memset(&point, 0xff, sizeof point);
    const tl_result result = tl_scaled_soup_nearest(CONTRACT_INPUT(run, 0, &scaled), tl_vec3_make(8, 2, 20),
                                                    run->what == CONTRACT_NOT_FOUND ? 0.5f : INFINITY,
                                                    contract_ray_filter(run, &filter), CONTRACT_OUTPUT(run, 0, &point));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&point, sizeof point);
    run->answer = contract_hash(&point.point, sizeof point.point, point.triangle);
    return result;
}

static tl_result overlaps(contract_run *run)
{
    const tl_scaled_soup scaled = twice(run);
    tl_ray_filter filter;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(2, 2, 2), 0);
    bool touches = true;
    const tl_result result = tl_scaled_soup_overlaps(
        CONTRACT_INPUT(run, 0, &scaled), CONTRACT_INPUT(run, 2, &shape), contract_pose(run, tl_vec3_make(16, 2, 20)),
        contract_ray_filter(run, &filter), CONTRACT_OUTPUT(run, 0, &touches));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || !touches;
    run->answer = touches;
    return result;
}

static tl_result find_overlaps(contract_run *run)
{
    const tl_scaled_soup scaled = twice(run);
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(2, 2, 2), 0);
    const tl_transform pose = contract_pose(run, tl_vec3_make(16, 2, 20));
    const tl_scaled_soup whole = { contract_level_get()->soup, { 2, 2, 2 } };
    tl_ray_filter filter;
    uint32_t found[32] = { 0 }, all, count = 99;
    TEST_RESULT(tl_scaled_soup_find_overlaps(&whole, &shape, pose, NULL, NULL, 0, &all), TL_INCOMPLETE);
    TEST_CHECK(all > 1 && all <= 32);
    const bool no_buffer = run->what == CONTRACT_NO_BUFFER || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 1);
    const uint32_t capacity = run->what == CONTRACT_NO_BUFFER ? 0 : run->what == CONTRACT_SHORT_BUFFER ? all - 1 : all;
    const tl_result result = tl_scaled_soup_find_overlaps(
        CONTRACT_INPUT(run, 0, &scaled), CONTRACT_INPUT(run, 2, &shape), pose, contract_ray_filter(run, &filter),
        no_buffer ? NULL : found, capacity, CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0 || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 0);
    run->count = count;
    run->answer = contract_hash(found, sizeof found, 0);
    return result;
}

static tl_result cast_shape(contract_run *run)
{
    const tl_scaled_soup scaled = twice(run);
    tl_ray_filter filter;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0);
    tl_shape_hit hit;
    memset(&hit, 0xff, sizeof hit);
    const tl_result result = tl_scaled_soup_cast_shape(
        CONTRACT_INPUT(run, 0, &scaled), CONTRACT_INPUT(run, 2, &shape), contract_pose(run, tl_vec3_make(8, 2, 20)),
        tl_vec3_make(run->what == CONTRACT_NOT_FOUND ? -4.0f : 16.0f, 0, 0), contract_ray_filter(run, &filter),
        CONTRACT_OUTPUT(run, 0, &hit));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&hit, sizeof hit);
    run->answer = contract_hash(&hit.t, sizeof hit.t, hit.triangle);
    return result;
}

enum {
    FILTERED = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_FILTER),
    REFUSING = CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT)
};

const contract_entry CONTRACT_TABLE_soup_scaled[] = {
    { "tl_scaled_soup_nearest", FILTERED | REFUSING | CONTRACT_BIT(NOT_FOUND), 2, 1, NULL, nearest, NULL },
    { "tl_scaled_soup_overlaps", FILTERED | REFUSING | CONTRACT_BIT(ZERO_ROTATION), 3, 1, NULL, overlaps, NULL },
    { "tl_scaled_soup_find_overlaps",
      FILTERED | REFUSING | CONTRACT_BIT(ZERO_ROTATION) | CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER), 3, 2,
      NULL, find_overlaps, NULL },
    { "tl_scaled_soup_cast_shape", FILTERED | REFUSING | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(ZERO_ROTATION), 3, 1,
      NULL, cast_shape, NULL },
    { 0 },
};
