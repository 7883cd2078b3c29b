// SPDX-License-Identifier: MIT
//
// Each cause on a level made for it; and each value that is named, tried by a bake of the whole level.

#include "nav_audit_level.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <talus/nav_audit.h>

typedef struct question {
    test_level level;
    tl_nav_def def;
    tl_nav_input input;
    tl_nav_why_answer answer;
} question;

static void begin(question *q)
{
    memset(q, 0, sizeof *q);
    audit_floor(&q->level, 0, 0, 30, 20, 0);
    q->def = tl_default_nav_def();
    q->def.edge_max_error = 0.5f;
}

// `within`: how far the surface may lie above or below the floor's voxel.
static bool is_walkable(const tl_nav_def *def, const tl_nav_input *input, tl_vec3 floor, float within)
{
    tl_navmesh *navmesh = test_nav_bake(def, input);
    tl_nav_location location;
    const bool there = tl_navmesh_find_nearest(navmesh, NULL, floor, tl_vec3_make(0, within, 0), &location) == TL_OK;
    tl_navmesh_destroy(navmesh);
    return there;
}

static void prepare(question *q)
{
    q->input.mesh = q->level.mesh;
    q->input.mesh.vertices = q->level.vertices;
    q->input.mesh.indices = q->level.indices;
}

// Asks, and tries the needed values by a whole bake.
static const tl_nav_reason *ask(question *q, tl_vec3 point, tl_nav_cause cause, const char *stage)
{
    prepare(q);
    TEST_RESULT(tl_nav_why(&q->def, &q->input, NULL, NULL, point, &q->answer, NULL), TL_OK);
    assert_false(q->answer.walkable);
    assert_true(q->answer.reason_count > 0);
    const tl_nav_reason *reason = &q->answer.reasons[0];
    assert_string_equal(tl_nav_cause_name(reason->cause), tl_nav_cause_name(cause));
    assert_string_equal(reason->stage, stage);
    assert_false(is_walkable(&q->def, &q->input, q->answer.floor, 0.7f));
    if (q->answer.proven) {
        assert_true(is_walkable(&q->answer.needed, &q->input, q->answer.floor, 0.7f));
    }
    return reason;
}

static void expect_needed(const question *q, const char *parameter, float value, float needed, float within)
{
    const tl_nav_reason *reason = &q->answer.reasons[0];
    assert_non_null(reason->parameter);
    assert_string_equal(reason->parameter, parameter);
    TEST_CHECK(reason->value == value);
    if (!(fabsf(reason->needed - needed) <= within)) {
        fail_msg("%s: %g is needed, expected %g", parameter, (double)reason->needed, (double)needed);
    }
    assert_true(q->answer.proven);
}

static void a_walkable_point_has_no_cause(void **state)
{
    (void)state;
    question q;
    begin(&q);
    prepare(&q);
    for (uint32_t tile_size = 0; tile_size <= 32; tile_size += 32) {
        q.def.tile_size = tile_size;
        TEST_RESULT(tl_nav_why(&q.def, &q.input, NULL, NULL, tl_vec3_make(15, 0, 10), &q.answer, NULL), TL_OK);
        TEST_CHECK(q.answer.walkable && q.answer.reason_count == 0 && q.answer.proven);
        TEST_CHECK(tile_size == 0 || (q.answer.tile_x == 1 && q.answer.tile_z == 1));
        tl_navmesh *navmesh = test_nav_bake(&q.def, &q.input);
        TEST_RESULT(tl_nav_why(&q.def, &q.input, navmesh, NULL, tl_vec3_make(15, 0, 10), &q.answer, NULL), TL_OK);
        TEST_CHECK(q.answer.walkable && !q.answer.apart && q.answer.island_area > 400.0f);
        tl_navmesh_destroy(navmesh);
    }
}

static void outside(void **state)
{
    (void)state;
    question q;
    begin(&q);
    ask(&q, tl_vec3_make(40, 0, 10), TL_NAV_CAUSE_OUTSIDE, "config");
    assert_string_equal(q.answer.reasons[0].parameter, "bounds");
    assert_false(q.answer.proven); // there is nothing to stand on
    assert_int_equal(q.answer.reasons[1].cause, TL_NAV_CAUSE_NO_FLOOR);
    // On a level that goes on beyond what was built, wider bounds do help.
    q.def.bounds.min = tl_vec3_make(3, -1, 3);
    q.def.bounds.max = tl_vec3_make(20.1f, 3, 18);
    ask(&q, tl_vec3_make(22, 0, 10), TL_NAV_CAUSE_OUTSIDE, "config");
    assert_true(q.answer.proven);
    ask(&q, tl_vec3_make(3.2f, 0, 10), TL_NAV_CAUSE_OUTSIDE, "config");
    assert_true(q.answer.proven);
}

// Bounds that reached so far would be refused: the answer is the distance, and that no setting helps.
static void far_outside(void **state)
{
    (void)state;
    for (float far = 1e4f; far < 1e13f; far *= 100.0f) {
        question q;
        begin(&q);
        const tl_nav_reason *reason = ask(&q, tl_vec3_make(far, 0, -far), TL_NAV_CAUSE_OUTSIDE, "config");
        assert_null(reason->parameter);
        assert_true(reason->measured > 0.9f * far && q.answer.reason_count == 1 && !q.answer.proven);
    }
}

static void no_floor(void **state)
{
    (void)state;
    question q;
    begin(&q);
    audit_block(&q.level, 5, 6, 5, 8, 7, 8);
    const tl_nav_reason *reason = ask(&q, tl_vec3_make(15, 4, 10), TL_NAV_CAUSE_NO_FLOOR, "rasterize");
    TEST_CHECK(reason->parameter == NULL && fabsf(reason->measured - 4.0f) < 0.25f && !q.answer.proven);
}

static void slope(void **state)
{
    (void)state;
    question q;
    begin(&q);
    // A bank of 50 degrees: 6 m up over 6 / tan 50 degrees.
    test_level_quad(&q.level, tl_vec3_make(10, 0, 0), tl_vec3_make(10, 0, 20), tl_vec3_make(15.0346f, 6, 20),
                    tl_vec3_make(15.0346f, 6, 0));
    const tl_nav_reason *reason = ask(&q, tl_vec3_make(12.5f, 3, 10), TL_NAV_CAUSE_SLOPE, "rasterize");
    TEST_CHECK(fabsf(reason->measured - 50.0f) < 0.01f && reason->triangle >= 2);
    expect_needed(&q, "agent_max_slope", 45.0f, 50.0f, 0.01f);
}

static void area_of_the_triangle(void **state)
{
    (void)state;
    question q;
    begin(&q);
    audit_floor(&q.level, 30, 0, 40, 20, 0);
    const uint8_t areas[] = { 63, 63, 0, 0 };
    q.input.areas = areas;
    const tl_nav_reason *reason = ask(&q, tl_vec3_make(35, 0, 10), TL_NAV_CAUSE_AREA_INPUT, "rasterize");
    TEST_CHECK(reason->parameter == NULL && (reason->triangle == 2 || reason->triangle == 3));
}

static void ledge(void **state)
{
    (void)state;
    question q;
    begin(&q);
    q.def.agent_radius = 0.0f;
    audit_block(&q.level, 10, 0, 5, 16, 1.2f, 15); // a platform: its rim lies 1.2 m above the ground
    const tl_nav_reason *reason = ask(&q, tl_vec3_make(10.1f, 1.2f, 10), TL_NAV_CAUSE_LEDGE, "filter");
    TEST_CHECK(reason->measured > 0.9f && reason->measured < 1.5f);
    expect_needed(&q, "agent_max_climb", 0.9f, 1.2f, 0.01f);
    q.def.filter_ledge_spans = false;
    prepare(&q);
    TEST_RESULT(tl_nav_why(&q.def, &q.input, NULL, NULL, tl_vec3_make(10.1f, 1.2f, 10), &q.answer, NULL), TL_OK);
    assert_true(q.answer.walkable);
}

static void ceiling(void **state)
{
    (void)state;
    question q;
    begin(&q);
    audit_block(&q.level, 8, 1.6f, 4, 20, 3, 16);
    const tl_nav_reason *reason = ask(&q, tl_vec3_make(14, 0, 10), TL_NAV_CAUSE_CEILING, "filter");
    TEST_CHECK(fabsf(reason->measured - 1.4f) < 0.01f); // the floor's voxel takes 0.2 m of the 1.6
    expect_needed(&q, "agent_height", 2.0f, 1.4f, 0.01f);
}

static void radius(void **state)
{
    (void)state;
    question q;
    begin(&q);
    audit_block(&q.level, 15, 0, 0, 16, 4, 20);
    ask(&q, tl_vec3_make(14.5f, 0, 10), TL_NAV_CAUSE_RADIUS, "erode");
    expect_needed(&q, "agent_radius", 0.6f, 0.3f, 1e-6f);
    assert_int_equal(q.answer.reason_count, 1);
}

static void volume(void **state)
{
    (void)state;
    question q;
    begin(&q);
    tl_nav_volume hole;
    memset(&hole, 0, sizeof hole);
    hole.kind = TL_NAV_VOLUME_CYLINDER;
    hole.base = tl_vec3_make(15, -1, 10);
    hole.radius = 3.0f;
    hole.height = 2.0f;
    q.input.volumes = &hole;
    q.input.volume_count = 1;
    const tl_nav_reason *reason = ask(&q, tl_vec3_make(15, 0, 10), TL_NAV_CAUSE_VOLUME, "areas");
    assert_null(reason->parameter);
}

static void small_island(void **state)
{
    (void)state;
    question q;
    begin(&q);
    audit_block(&q.level, 10, 0, 5, 13, 4, 8); // a roof of 3 by 3 m, 10 by 10 columns less two on each side and a rim
    const tl_nav_reason *reason = ask(&q, tl_vec3_make(11.5f, 4, 6.5f), TL_NAV_CAUSE_ISLAND, "regions");
    TEST_CHECK(reason->measured >= 9.0f && reason->measured <= 49.0f);
    expect_needed(&q, "region_min_size", 8.0f, sqrtf(reason->measured), 0.01f);
}

static void outline(void **state)
{
    (void)state;
    question q;
    begin(&q);
    q.def.edge_max_error = 12.0f; // 3.6 m: the notch between two blocks becomes a straight wall
    q.def.agent_radius = 0.0f;
    q.def.edge_max_len = 0.0f;
    audit_block(&q.level, 0, 0, 0, 12, 4, 2);
    audit_block(&q.level, 15, 0, 0, 30, 4, 2);
    prepare(&q);
    bool seen = false;
    for (int i = 0; i < 12 && !seen; i++) {
        const tl_vec3 point = { 12.3f + 0.2f * (float)i, 0, 0.6f };
        TEST_RESULT(tl_nav_why(&q.def, &q.input, NULL, NULL, point, &q.answer, NULL), TL_OK);
        seen = q.answer.reason_count > 0 && q.answer.reasons[0].cause == TL_NAV_CAUSE_OUTLINE;
        if (seen) {
            ask(&q, point, TL_NAV_CAUSE_OUTLINE, "contours");
            assert_string_equal(q.answer.reasons[0].parameter, "edge_max_error");
            TEST_CHECK(q.answer.proven && q.answer.reasons[0].needed < 12.0f && q.answer.reasons[0].needed > 1.0f);
        }
    }
    assert_true(seen);
}

// The navmesh asked about was baked before the block was taken away.
static void changed(void **state)
{
    (void)state;
    question before, now;
    begin(&before);
    begin(&now);
    audit_block(&before.level, 10, 0, 5, 16, 1.5f, 12); // too low to stand in
    prepare(&before);
    prepare(&now);
    tl_navmesh *navmesh = test_nav_bake(&before.def, &before.input);
    TEST_RESULT(tl_nav_why(&now.def, &now.input, navmesh, NULL, tl_vec3_make(13, 0, 9), &now.answer, NULL), TL_OK);
    TEST_CHECK(!now.answer.walkable && now.answer.reason_count == 1);
    assert_int_equal(now.answer.reasons[0].cause, TL_NAV_CAUSE_CHANGED);
    tl_navmesh_destroy(navmesh);
}

static void another_island(void **state)
{
    (void)state;
    question q;
    begin(&q);
    audit_block(&q.level, 10, 0, 5, 18, 4, 15);
    prepare(&q);
    tl_navmesh *navmesh = test_nav_bake(&q.def, &q.input);
    TEST_RESULT(tl_nav_why(&q.def, &q.input, navmesh, NULL, tl_vec3_make(14, 4, 10), &q.answer, NULL), TL_OK);
    TEST_CHECK(q.answer.walkable && q.answer.apart && q.answer.island_area < q.answer.largest_island_area);
    TEST_CHECK(q.answer.island_area > 30.0f && q.answer.island_area < 80.0f);
    tl_navmesh_destroy(navmesh);
}

// On a steep roof that is too small: first the slope, then the island.
static void one_cause_behind_the_other(void **state)
{
    (void)state;
    question q;
    begin(&q);
    test_level_box(&q.level, 10, 0, 5, 12.4f, 4, 7.4f, 6.88f); // 50.2 degrees
    ask(&q, tl_vec3_make(11.2f, 5.44f, 6.2f), TL_NAV_CAUSE_SLOPE, "rasterize");
    TEST_CHECK(q.answer.reason_count >= 2);
    TEST_CHECK(q.answer.proven);
}

// Random points of a level: what is said to be needed makes the point walkable, whenever it is said to be proven; and a
// point is called walkable exactly when a bake has a polygon there.
static void random_points(void **state)
{
    (void)state;
    question q;
    test_random random = { 7 };
    uint32_t walkable = 0, causes[TL_NAV_CAUSE_WALL + 1] = { 0 };
    for (uint32_t i = 0; i < 60; i++) {
        begin(&q);
        test_level_make(&q.level, tl_vec3_make(0, 0, 0));
        q.def.tile_size = i % 2 != 0 ? 32 : 0;
        prepare(&q);
        const tl_vec3 point = test_random_point(&random, tl_vec3_make(-0.5f, 0, -0.5f), tl_vec3_make(25, 3.4f, 18.5f));
        TEST_RESULT(tl_nav_why(&q.def, &q.input, NULL, NULL, point, &q.answer, NULL), TL_OK);
        if (q.answer.walkable) {
            walkable++;
            assert_true(is_walkable(&q.def, &q.input, q.answer.floor, 1.0f));
        } else {
            causes[q.answer.reasons[0].cause]++;
            assert_false(is_walkable(&q.def, &q.input, q.answer.floor, 0.35f) &&
                         q.answer.reasons[0].cause != TL_NAV_CAUSE_NO_FLOOR);
            assert_true(!q.answer.proven || is_walkable(&q.answer.needed, &q.input, q.answer.floor, 1.0f));
        }
    }
    TEST_CHECK(walkable > 10 && causes[TL_NAV_CAUSE_RADIUS] > 2 && causes[TL_NAV_CAUSE_NO_FLOOR] > 2);
}

static void failures_leave_nothing(void **state)
{
    (void)state;
    question q;
    begin(&q);
    audit_block(&q.level, 15, 0, 0, 16, 4, 20);
    prepare(&q);
    tl_navmesh *navmesh = test_nav_bake(&q.def, &q.input);
    tl_result result = TL_ERR_MEMORY;
    for (uint64_t k = 1; result == TL_ERR_MEMORY; k++) {
        test_allocator failing;
        test_allocator_init(&failing, k);
        q.def.host.allocator = &failing.allocator;
        result = tl_nav_why(&q.def, &q.input, navmesh, NULL, tl_vec3_make(14.5f, 0, 10), &q.answer, NULL);
        assert_int_equal(failing.live_blocks, 0);
        TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
    }
    q.def.host.allocator = NULL;
    TEST_RESULT(tl_nav_why(&q.def, &q.input, navmesh, NULL, tl_vec3_make(NAN, 0, 10), &q.answer, NULL),
                TL_ERR_NOT_FINITE);
    q.level.indices[4] = 9999;
    tl_report report;
    TEST_RESULT(tl_nav_why(&q.def, &q.input, navmesh, NULL, tl_vec3_make(1, 0, 10), &q.answer, &report), TL_ERR_INDEX);
    assert_int_equal(report.element_index, 1);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_walkable_point_has_no_cause),
        cmocka_unit_test(outside),
        cmocka_unit_test(far_outside),
        cmocka_unit_test(no_floor),
        cmocka_unit_test(slope),
        cmocka_unit_test(area_of_the_triangle),
        cmocka_unit_test(ledge),
        cmocka_unit_test(ceiling),
        cmocka_unit_test(radius),
        cmocka_unit_test(volume),
        cmocka_unit_test(small_island),
        cmocka_unit_test(outline),
        cmocka_unit_test(changed),
        cmocka_unit_test(another_island),
        cmocka_unit_test(one_cause_behind_the_other),
        cmocka_unit_test(random_points),
        cmocka_unit_test(failures_leave_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
