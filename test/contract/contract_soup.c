// SPDX-License-Identifier: MIT
//
// soup.h.

#include "contract.h"

#include <stdlib.h>
#include <string.h>

// Downwards through the box and the floor.
static tl_ray ray_down(void)
{
    tl_ray ray = { { 9.3f, 10, 10.4f }, { 0, -1, 0 }, INFINITY };
    return ray;
}

static uint32_t capacity_of(const contract_run *run, uint32_t all)
{
    return run->what == CONTRACT_NO_BUFFER ? 0 : run->what == CONTRACT_SHORT_BUFFER ? all - 1 : all;
}

static void soup_answer(contract_run *run, tl_soup *soup)
{
    run->answer = soup != NULL ? contract_hash(soup, (size_t)tl_soup_size(soup), 0) : 0;
}

static tl_result bake(contract_run *run)
{
    tl_soup_def def = tl_default_soup_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        def.split_budget = run->variant == 0 ? -0.5f : 0.0f;
        def.partition = (tl_soup_partition)(run->variant == 1 ? 7 : 0);
        def.layout = (tl_soup_layout)(run->variant == 2 ? 7 : 0);
        def.quality = (tl_soup_quality)(run->variant == 3 ? 7 : 0);
    }
    def.host = *run->host;
    tl_soup *soup = NULL;
    tl_soup_report report = { 0 };
    const tl_result result =
        tl_soup_bake(CONTRACT_INPUT(run, 0, &contract_level_get()->view), run->what == CONTRACT_NULL_DEF ? NULL : &def,
                     CONTRACT_OUTPUT(run, 0, &soup), run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = soup == NULL;
    soup_answer(run, soup);
    tl_blob_free(soup);
    return result;
}

static tl_result refit(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&level->view, NULL, &soup, NULL), TL_OK);
    const tl_result result =
        tl_soup_refit(CONTRACT_INPUT(run, 0, soup), CONTRACT_INPUT(run, 1, &level->view), run->report);
    run->is_clear = true;
    soup_answer(run, soup);
    tl_blob_free(soup);
    return result;
}

static tl_result check(contract_run *run)
{
    const tl_soup *soup = contract_level_get()->soup;
    const uint64_t size = tl_soup_size(soup);
    tl_blob *copy = test_blob_alloc(size);
    TEST_CHECK(copy != NULL);
    memcpy(copy, soup, size);
    copy->magic ^= run->what == CONTRACT_BAD_BYTES;
    const tl_result result = tl_soup_check(CONTRACT_INPUT(run, 0, copy), size, run->report);
    run->is_clear = true;
    test_blob_free(copy);
    return result;
}

static tl_result cast_ray(contract_run *run)
{
    tl_ray_filter filter;
    const tl_ray ray = ray_down();
    tl_ray_hit hit;
    TEST_CHECK(tl_soup_cast_ray(contract_level_get()->soup, &ray, contract_ray_filter(run, &filter), &hit));
    run->answer = hit.triangle;
    return TL_OK;
}

static tl_result occluded(contract_run *run)
{
    tl_ray_filter filter;
    const tl_ray ray = ray_down();
    run->answer = tl_soup_occluded(contract_level_get()->soup, &ray, contract_ray_filter(run, &filter));
    return TL_OK;
}

static tl_result cast_segment(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_ray_filter filter;
    tl_ray_hit hit;
    TEST_CHECK(tl_soup_cast_segment(level->soup, tl_vec3_make(4, 1, 10), tl_vec3_make(16, 1, 10.5f),
                                    contract_ray_filter(run, &filter), &hit));
    run->answer = hit.triangle;
    return TL_OK;
}

static tl_result line_of_sight(contract_run *run)
{
    tl_ray_filter filter;
    run->answer = tl_soup_line_of_sight(contract_level_get()->soup, tl_vec3_make(4, 1, 10), tl_vec3_make(16, 1, 10.5f),
                                        contract_ray_filter(run, &filter));
    return TL_OK;
}

static tl_result cast_rays(contract_run *run)
{
    tl_ray_filter filter;
    const tl_ray ray = ray_down();
    tl_ray_hit hit;
    tl_soup_cast_rays(contract_level_get()->soup, &ray, 1, contract_ray_filter(run, &filter),
                      run->what == CONTRACT_NULL_DEF ? NULL : run->host, &hit);
    run->answer = hit.triangle;
    return TL_OK;
}

static tl_segment segment_across(void)
{
    tl_segment segment = { { 4, 1, 10 }, { 16, 1, 10.5f } };
    return segment;
}

static tl_result cast_segments(contract_run *run)
{
    tl_ray_filter filter;
    const tl_segment segment = segment_across();
    tl_ray_hit hit;
    tl_soup_cast_segments(contract_level_get()->soup, &segment, 1, contract_ray_filter(run, &filter),
                          run->what == CONTRACT_NULL_DEF ? NULL : run->host, &hit);
    run->answer = hit.triangle;
    return TL_OK;
}

static tl_result occluded_rays(contract_run *run)
{
    tl_ray_filter filter;
    const tl_ray ray = ray_down();
    bool occluded = false;
    tl_soup_occluded_rays(contract_level_get()->soup, &ray, 1, contract_ray_filter(run, &filter),
                          run->what == CONTRACT_NULL_DEF ? NULL : run->host, &occluded);
    run->answer = occluded;
    return TL_OK;
}

static tl_result lines_of_sight(contract_run *run)
{
    tl_ray_filter filter;
    const tl_segment segment = segment_across();
    bool clear = false;
    tl_soup_lines_of_sight(contract_level_get()->soup, &segment, 1, contract_ray_filter(run, &filter),
                           run->what == CONTRACT_NULL_DEF ? NULL : run->host, &clear);
    run->answer = clear;
    return TL_OK;
}

static tl_result cast_ray_all(contract_run *run)
{
    enum { HITS = 2 };
    tl_ray_filter filter;
    const tl_ray ray = ray_down();
    tl_ray_hit hits[HITS] = { 0 };
    uint32_t count = 99;
    const bool no_buffer = run->what == CONTRACT_NO_BUFFER || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 1);
    const tl_result result =
        tl_soup_cast_ray_all(CONTRACT_INPUT(run, 0, contract_level_get()->soup), CONTRACT_INPUT(run, 1, &ray),
                             TL_HITS_TOUCHED, contract_ray_filter(run, &filter), no_buffer ? NULL : hits,
                             capacity_of(run, HITS), CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0 || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 0);
    run->count = count;
    run->answer = hits[0].triangle + 100 * hits[1].triangle;
    return result;
}

static tl_result nearest(contract_run *run)
{
    const contract_level *level = contract_level_get();
    tl_ray_filter filter;
    tl_soup_point point;
    memset(&point, 0xff, sizeof point);
    const tl_result result = tl_soup_nearest(CONTRACT_INPUT(run, 0, level->soup), tl_vec3_make(4, 1, 10),
                                             run->what == CONTRACT_NOT_FOUND ? 0.5f : INFINITY,
                                             contract_ray_filter(run, &filter), CONTRACT_OUTPUT(run, 0, &point));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&point, sizeof point);
    run->answer = contract_hash(&point.point, sizeof point.point, point.triangle);
    return result;
}

static tl_result overlaps(contract_run *run)
{
    tl_ray_filter filter;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0);
    bool touches = true;
    const tl_result result =
        tl_soup_overlaps(CONTRACT_INPUT(run, 0, contract_level_get()->soup), CONTRACT_INPUT(run, 1, &shape),
                         contract_pose(run, tl_vec3_make(8, 1, 10)), contract_ray_filter(run, &filter),
                         CONTRACT_OUTPUT(run, 0, &touches));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || !touches;
    run->answer = touches;
    return result;
}

static tl_result find_overlaps(contract_run *run)
{
    const tl_soup *soup = contract_level_get()->soup;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0);
    const tl_transform pose = contract_pose(run, tl_vec3_make(8, 1, 10));
    tl_ray_filter filter;
    uint32_t found[32] = { 0 }, all, count = 99;
    TEST_RESULT(tl_soup_find_overlaps(soup, &shape, pose, NULL, NULL, 0, &all), TL_INCOMPLETE);
    TEST_CHECK(all > 1 && all <= 32);
    const bool no_buffer = run->what == CONTRACT_NO_BUFFER || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 1);
    const tl_result result = tl_soup_find_overlaps(CONTRACT_INPUT(run, 0, soup), CONTRACT_INPUT(run, 1, &shape), pose,
                                                   contract_ray_filter(run, &filter), no_buffer ? NULL : found,
                                                   capacity_of(run, all), CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0 || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 0);
    run->count = count;
    run->answer = contract_hash(found, sizeof found, 0);
    return result;
}

static tl_result find_contacts(contract_run *run)
{
    const tl_soup *soup = contract_level_get()->soup;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1.001f, 1), 0);
    tl_ray_filter filter;
    const tl_soup_contact_query query = {
        &shape, contract_pose(run, tl_vec3_make(8, 1, 10)), { 0.01f, 0.01f, 0 }, contract_ray_filter(run, &filter)
    };
    static tl_soup_contact found[32]; // 16 KB
    memset(found, 0, sizeof found);
    uint32_t all, count = 99;
    TEST_RESULT(tl_soup_find_contacts(soup, &query, NULL, 0, &all), TL_INCOMPLETE);
    TEST_CHECK(all > 0 && all <= 32);
    const bool no_buffer = run->what == CONTRACT_NO_BUFFER || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 1);
    const tl_result result =
        tl_soup_find_contacts(CONTRACT_INPUT(run, 0, soup), CONTRACT_INPUT(run, 1, &query), no_buffer ? NULL : found,
                              capacity_of(run, all), CONTRACT_OUTPUT(run, 0, &count));
    run->is_clear = count == 0 || (run->what == CONTRACT_NULL_OUTPUT && run->variant == 0);
    run->count = count;
    run->answer = found[0].triangle + 100 * found[0].manifold.count;
    return result;
}

static tl_result cast_shape(contract_run *run)
{
    tl_ray_filter filter;
    const tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.5f, 0.5f), 0);
    tl_shape_hit hit;
    memset(&hit, 0xff, sizeof hit);
    const tl_result result = tl_soup_cast_shape(
        CONTRACT_INPUT(run, 0, contract_level_get()->soup), CONTRACT_INPUT(run, 1, &shape),
        contract_pose(run, tl_vec3_make(4, 1, 10)), tl_vec3_make(run->what == CONTRACT_NOT_FOUND ? -2.0f : 8.0f, 0, 0),
        contract_ray_filter(run, &filter), CONTRACT_OUTPUT(run, 0, &hit));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&hit, sizeof hit);
    run->answer = contract_hash(&hit.t, sizeof hit.t, hit.triangle);
    return result;
}

static tl_result locate(contract_run *run)
{
    tl_soup_location location;
    memset(&location, 0xff, sizeof location);
    const tl_result result = tl_soup_locate(CONTRACT_INPUT(run, 0, contract_level_get()->soup),
                                            contract_level_get()->nowhere, CONTRACT_OUTPUT(run, 0, &location));
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&location, sizeof location);
    return result;
}

static tl_result check_closed(contract_run *run)
{
    static const tl_vec3 corners[4] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    static const uint32_t indices[12] = { 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3 };
    const tl_mesh_view view = { corners, 4, indices, 4, NULL };
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
    const tl_result result = tl_soup_check_closed(CONTRACT_INPUT(run, 0, soup), run->host, run->report);
    run->is_clear = true;
    tl_blob_free(soup);
    return result;
}

static const char *const SOUP_FIELDS[] = { "split_budget", "partition", "layout", "quality", NULL };

enum {
    FILTERED = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_FILTER),
    REFUSING = CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT),
    BUFFERED = CONTRACT_BIT(NO_BUFFER) | CONTRACT_BIT(SHORT_BUFFER),
    REPORTED = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT),
    HOSTED = CONTRACT_BIT(NO_MEMORY) | CONTRACT_BIT(CANCELLED)
};

const contract_entry CONTRACT_TABLE_soup[] = {
    { "tl_default_soup_def", 0, 0, 0, NULL, NULL, "returns a constant" },
    { "tl_soup_bake",
      REPORTED | HOSTED | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD) |
          CONTRACT_BIT(NULL_OUTPUT),
      1, 1, SOUP_FIELDS, bake, NULL },
    { "tl_soup_refit", REPORTED, 2, 0, NULL, refit, NULL },
    { "tl_soup_check", REPORTED | CONTRACT_BIT(BAD_BYTES), 1, 0, NULL, check, NULL },
    { "tl_soup_size", 0, 0, 0, NULL, NULL, "reads a field" },
    { "tl_soup_bounds", 0, 0, 0, NULL, NULL, "reads a field" },
    { "tl_soup_get_stats", 0, 0, 0, NULL, NULL, "reads fields: test_soup_read.c" },
    { "tl_soup_cast_ray", FILTERED, 0, 0, NULL, cast_ray, NULL },
    { "tl_soup_occluded", FILTERED, 0, 0, NULL, occluded, NULL },
    { "tl_soup_cast_segment", FILTERED, 0, 0, NULL, cast_segment, NULL },
    { "tl_soup_line_of_sight", FILTERED, 0, 0, NULL, line_of_sight, NULL },
    { "tl_soup_cast_rays", FILTERED, 0, 0, NULL, cast_rays, NULL },
    { "tl_soup_cast_segments", FILTERED, 0, 0, NULL, cast_segments, NULL },
    { "tl_soup_occluded_rays", FILTERED, 0, 0, NULL, occluded_rays, NULL },
    { "tl_soup_lines_of_sight", FILTERED, 0, 0, NULL, lines_of_sight, NULL },
    { "tl_soup_cast_ray_all", FILTERED | REFUSING | BUFFERED, 2, 2, NULL, cast_ray_all, NULL },
    { "tl_soup_nearest", FILTERED | REFUSING | CONTRACT_BIT(NOT_FOUND), 1, 1, NULL, nearest, NULL },
    { "tl_soup_overlaps", FILTERED | REFUSING | CONTRACT_BIT(ZERO_ROTATION), 2, 1, NULL, overlaps, NULL },
    { "tl_soup_find_overlaps", FILTERED | REFUSING | BUFFERED | CONTRACT_BIT(ZERO_ROTATION), 2, 2, NULL, find_overlaps,
      NULL },
    { "tl_soup_find_contacts", FILTERED | REFUSING | BUFFERED | CONTRACT_BIT(ZERO_ROTATION), 2, 2, NULL, find_contacts,
      NULL },
    { "tl_soup_cast_shape", FILTERED | REFUSING | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(ZERO_ROTATION), 2, 1, NULL,
      cast_shape, NULL },
    { "tl_soup_locate", CONTRACT_BIT(GOOD) | REFUSING, 1, 1, NULL, locate, NULL },
    { "tl_soup_check_closed", REPORTED | HOSTED | CONTRACT_BIT(CANCELLED), 1, 0, NULL, check_closed, NULL },
    { "tl_soup_next_triangle", 0, 0, 0, NULL, NULL, "an iterator: test_soup_read.c" },
    { "tl_soup_next_pair", 0, 0, 0, NULL, NULL, "an iterator: test_soup_read.c" },
    { "tl_soup_triangles_in_box", 0, 0, 0, NULL, NULL, "no filter, no result: test_soup_read.c" },
    { "tl_soup_bvh_boxes", 0, 0, 0, NULL, NULL, "no filter, no result: test_soup_read.c" },
    { 0 },
};
