// SPDX-License-Identifier: MIT
//
// Audits of levels whose contradictions are known: each is found where it is, and nothing else.

#include "backward_tasks.h"
#include "nav_audit_level.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <talus/nav_audit.h>

// A hall of 20 by 12 m, its floor in four strips along x, walls around.
static void make_hall(test_level *level)
{
    memset(level, 0, sizeof *level);
    for (int i = 0; i < 4; i++) {
        audit_floor(level, 5.0f * (float)i, 0.0f, 5.0f * (float)(i + 1), 12.0f, 0.0f);
    }
    audit_block(level, -1, -1, -1, 0, 4, 13);
    audit_block(level, 20, -1, -1, 21, 4, 13);
    audit_block(level, -1, -1, -1, 21, 4, 0);
    audit_block(level, -1, -1, 12, 21, 4, 13);
}

typedef struct hall {
    test_level level;  // as it was baked
    test_level change; // as it is
    tl_nav_audit_def def;
    tl_navmesh *navmesh;
    tl_nav_audit audit;
} hall;

static void set_up(hall *h, uint32_t tile_size, tl_vec3 offset)
{
    memset(h, 0, sizeof *h);
    make_hall(&h->level);
    make_hall(&h->change);
    audit_move(&h->level, offset);
    h->def = tl_default_nav_audit_def();
    h->def.nav.tile_size = tile_size;
    h->def.nav.bounds = test_level_bounds(&h->level);
    h->def.path_count = 100;
    const tl_nav_input input = { h->level.mesh, NULL, NULL, 0 };
    h->navmesh = test_nav_bake(&h->def.nav, &input);
}

static void run(hall *h, tl_vec3 offset)
{
    audit_move(&h->change, offset);
    tl_soup *soup = audit_soup(&h->change);
    tl_report report;
    TEST_RESULT(tl_nav_audit_run(&h->def, h->navmesh, soup, &h->audit, &report), TL_OK);
    tl_blob_free(soup);
}

static void tear_down(hall *h)
{
    tl_nav_audit_free(&h->audit);
    tl_navmesh_destroy(h->navmesh);
}

static uint32_t count_kind(const tl_nav_audit *audit, tl_nav_finding_kind kind)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < audit->finding_count; i++) {
        count += audit->findings[i].kind == kind;
    }
    return count;
}

static bool near(float a, float b, float within)
{
    return fabsf(a - b) <= within;
}

static const tl_vec3 NOWHERE = { 0.0f, 0.0f, 0.0f };

static void a_sound_level_has_no_findings(void **state)
{
    (void)state;
    const tl_vec3 offsets[] = { NOWHERE, { 5000.0f, -300.0f, -7000.0f } };
    for (size_t i = 0; i < 2; i++) {
        for (uint32_t tile_size = 0; tile_size <= 24; tile_size += 24) {
            hall h;
            set_up(&h, tile_size, offsets[i]);
            run(&h, offsets[i]);
            assert_int_equal(h.audit.finding_count, 0);
            assert_int_equal(h.audit.contradictions, 0);
            assert_int_equal(h.audit.path_count, 100);
            TEST_CHECK(h.audit.path_metres > 400.0 && h.audit.step_count > 2000 && h.audit.floor_samples > 300);
            TEST_CHECK(h.audit.polygon_count >= 1 && (tile_size == 0 || h.audit.portal_count > 4));
            TEST_CHECK(near(h.audit.probe.radius, 0.3f, 1e-6f) && near(h.audit.probe.step, 1.0f, 1e-6f) &&
                       near(h.audit.probe.height, 1.8f, 1e-6f));
            tear_down(&h);
        }
    }
    test_level level;
    test_level_make(&level, NOWHERE);
    tl_nav_audit_def def = tl_default_nav_audit_def();
    def.path_count = 300;
    const tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    tl_navmesh *navmesh = test_nav_bake(&def.nav, &input);
    tl_soup *soup = audit_soup(&level);
    tl_nav_audit audit;
    TEST_RESULT(tl_nav_audit_run(&def, navmesh, soup, &audit, NULL), TL_OK);
    assert_int_equal(audit.finding_count, 0);
    assert_int_equal(audit.path_count, 300);
    tl_nav_audit_free(&audit);
    tl_blob_free(soup);
    tl_navmesh_destroy(navmesh);
}

static void a_pillar_that_was_not_baked_is_found(void **state)
{
    (void)state;
    for (uint32_t tile_size = 0; tile_size <= 24; tile_size += 24) {
        hall h;
        set_up(&h, tile_size, NOWHERE);
        const uint32_t first = h.change.mesh.triangle_count;
        audit_block(&h.change, 8, 0, 5, 9, 3, 6);
        run(&h, NOWHERE);
        assert_int_equal(h.audit.finding_count, 1); // however many paths ran into it
        const tl_nav_finding *f = &h.audit.findings[0];
        assert_int_equal(f->kind, TL_NAV_FINDING_BLOCKED);
        TEST_CHECK(f->triangle >= first && f->polygon != TL_NAV_NO_REF && f->count >= 1);
        TEST_CHECK(near(f->point.x, 8.5f, 1.0f) && near(f->point.z, 5.5f, 1.0f));
        TEST_CHECK(f->depth > 0.05f && f->bounds.min.x > 7.0f && f->bounds.max.x < 10.0f);
        tear_down(&h);
    }
}

// Fins along a wall, which an outline simplified by 0.9 m cuts across: that is promised to happen, and no finding. A
// pillar farther from the outline than that is one; and whoever names a radius wants it free everywhere.
static void a_simplified_outline_is_no_contradiction(void **state)
{
    (void)state;
    hall h;
    memset(&h, 0, sizeof h);
    make_hall(&h.level);
    make_hall(&h.change);
    for (int i = 0; i < 5; i++) {
        const float x = 1.5f + 3.0f * (float)i;
        audit_block(&h.level, x, -1, 0, x + 0.3f, 4, 0.7f);
        audit_block(&h.change, x, -1, 0, x + 0.3f, 4, 0.7f);
    }
    h.def = tl_default_nav_audit_def();
    h.def.path_count = 100;
    h.def.nav.edge_max_error = 3.0f;
    const tl_nav_input input = { h.level.mesh, NULL, NULL, 0 };
    h.navmesh = test_nav_bake(&h.def.nav, &input);
    run(&h, NOWHERE);
    assert_int_equal(h.audit.finding_count, 0);
    TEST_CHECK(h.audit.tolerated_count > 0 && near(h.audit.probe.radius, 0.3f, 1e-6f));
    tl_nav_audit_free(&h.audit);
    h.def.probe_radius = 0.3f;
    run(&h, NOWHERE);
    assert_int_equal(count_kind(&h.audit, TL_NAV_FINDING_BLOCKED), h.audit.finding_count);
    TEST_CHECK(h.audit.finding_count > 0 && h.audit.tolerated_count == 0);
    uint64_t places = 0;
    for (uint32_t i = 0; i < h.audit.finding_count; i++) {
        places += h.audit.findings[i].count;
        TEST_CHECK(h.audit.findings[i].point.z < 1.5f);
    }
    TEST_CHECK(places == h.audit.contradictions);
    tl_nav_audit_free(&h.audit);
    h.def.probe_radius = -1.0f;
    audit_block(&h.change, 9, 0, 5, 10, 3, 6);
    run(&h, NOWHERE);
    assert_int_equal(h.audit.finding_count, 1);
    TEST_CHECK(near(h.audit.findings[0].point.x, 9.5f, 1.0f) && near(h.audit.findings[0].point.z, 5.5f, 1.0f));
    tear_down(&h);
}

static void a_beam_and_a_crate_are_found_and_a_kerb_is_not(void **state)
{
    (void)state;
    hall h;
    set_up(&h, 0, NOWHERE);
    audit_block(&h.change, 4, 1.5f, 0, 4.5f, 1.7f, 12); // a beam across, under which nobody walks upright
    audit_block(&h.change, 12, 0, 5, 14, 1.3f, 7);      // a crate too high to step on
    audit_block(&h.change, 16, 0, 0, 16.3f, 0.6f, 12);  // a kerb
    run(&h, NOWHERE);
    assert_true(h.audit.finding_count >= 2);
    uint32_t beams = 0, crates = 0;
    for (uint32_t i = 0; i < h.audit.finding_count; i++) {
        const tl_nav_finding *f = &h.audit.findings[i];
        const bool beam = near(f->point.x, 4.25f, 0.8f), crate = near(f->point.x, 13.0f, 1.7f);
        TEST_CHECK(beam || crate);
        beams += beam && f->kind == TL_NAV_FINDING_BLOCKED;
        crates += crate;
    }
    TEST_CHECK(beams > 0 && crates > 0);
    tear_down(&h);
}

// The third strip of the floor is gone, or lies deeper.
static void change_strip(test_level *level, float fall)
{
    for (uint32_t i = 8; i < 12; i++) {
        level->vertices[i].y -= fall;
    }
    for (uint32_t i = 0; fall == 0.0f && i < 6; i++) {
        level->indices[12 + i] = level->indices[6 + i];
    }
}

static void a_missing_floor_is_found(void **state)
{
    (void)state;
    hall h;
    set_up(&h, 0, NOWHERE);
    change_strip(&h.change, 0.0f);
    run(&h, NOWHERE);
    assert_true(h.audit.finding_count >= 1);
    assert_int_equal(count_kind(&h.audit, TL_NAV_FINDING_NO_FLOOR), h.audit.finding_count);
    for (uint32_t i = 0; i < h.audit.finding_count; i++) {
        const tl_nav_finding *f = &h.audit.findings[i];
        TEST_CHECK(f->bounds.min.x > 9.9f && f->bounds.max.x < 15.1f && f->depth == INFINITY);
    }
    tear_down(&h);
}

static void a_floor_that_fell_is_a_step(void **state)
{
    (void)state;
    hall h;
    set_up(&h, 0, NOWHERE);
    change_strip(&h.change, 1.6f);
    run(&h, NOWHERE);
    assert_true(count_kind(&h.audit, TL_NAV_FINDING_STEP) >= 1);
    for (uint32_t i = 0; i < h.audit.finding_count; i++) {
        const tl_nav_finding *f = &h.audit.findings[i];
        if (f->kind == TL_NAV_FINDING_STEP) {
            TEST_CHECK(near(f->depth, 1.6f, 0.01f));
            TEST_CHECK(near(f->point.x, 10.0f, 0.7f) || near(f->point.x, 15.0f, 0.7f));
        }
    }
    tear_down(&h);
}

// A volume takes 8 by 8 m out of the navmesh.
static void missing_navmesh_is_measured(void **state)
{
    (void)state;
    hall h;
    set_up(&h, 0, NOWHERE);
    tl_nav_volume hole;
    memset(&hole, 0, sizeof hole);
    hole.kind = TL_NAV_VOLUME_BOX;
    hole.area = TL_NAV_NULL_AREA;
    hole.box.min = tl_vec3_make(8, -1, 2);
    hole.box.max = tl_vec3_make(16, 1, 10);
    const tl_nav_input input = { h.level.mesh, NULL, &hole, 1 };
    tl_navmesh_destroy(h.navmesh);
    h.navmesh = test_nav_bake(&h.def.nav, &input);
    run(&h, NOWHERE);
    assert_int_equal(h.audit.finding_count, 1);
    const tl_nav_finding *f = &h.audit.findings[0];
    assert_int_equal(f->kind, TL_NAV_FINDING_MISSING);
    TEST_CHECK(near(f->point.x, 12.0f, 0.6f) && near(f->point.z, 6.0f, 0.6f) && f->point.y == 0.0f);
    // Nothing is near but navmesh: all of the hole is certain, up to a sample on each side.
    TEST_CHECK(f->area > 50.0f && f->area <= 68.0f && near((float)h.audit.missing_area, f->area, 1e-3f));
    TEST_CHECK(f->polygon != TL_NAV_NO_REF && f->triangle < 8 && f->depth == 0.0f);
    tl_nav_audit_free(&h.audit);
    h.def.volumes = &hole; // it is meant to be so
    h.def.volume_count = 1;
    run(&h, NOWHERE);
    assert_int_equal(h.audit.finding_count, 0);
    tl_nav_audit_free(&h.audit);
    h.def.volume_count = 0;
    uint8_t areas[TEST_LEVEL_MAX_TRIANGLES];
    memset(areas, TL_NAV_WALKABLE_AREA, sizeof areas);
    memset(areas, TL_NAV_NULL_AREA, 8); // the floor
    h.def.areas = areas;
    run(&h, NOWHERE);
    assert_int_equal(h.audit.finding_count, 0);
    tear_down(&h);
}

static void without_a_navmesh_all_floor_is_missing(void **state)
{
    (void)state;
    hall h;
    set_up(&h, 0, NOWHERE);
    tl_navmesh_destroy(h.navmesh);
    h.navmesh = NULL;
    run(&h, NOWHERE);
    assert_int_equal(count_kind(&h.audit, TL_NAV_FINDING_MISSING), 1);
    TEST_CHECK(h.audit.findings[0].area > 120.0f && h.audit.findings[0].area <= 240.0f);
    assert_int_equal(h.audit.path_count, 0);
    tl_nav_audit_free(&h.audit);
    h.def.min_missing_area = 250.0f;
    run(&h, NOWHERE);
    assert_int_equal(h.audit.finding_count, 0);
    tear_down(&h);
}

// A wall parts the hall, and a link leads through it: paths take it, and it is no contradiction.
static void links_are_not_walked(void **state)
{
    (void)state;
    hall h;
    memset(&h, 0, sizeof h);
    make_hall(&h.level);
    make_hall(&h.change);
    audit_block(&h.level, 9.5f, -1, -1, 10.5f, 4, 13);
    audit_block(&h.change, 9.5f, -1, -1, 10.5f, 4, 13);
    h.def = tl_default_nav_audit_def();
    h.def.path_count = 100;
    const tl_nav_input input = { h.level.mesh, NULL, NULL, 0 };
    h.navmesh = test_nav_bake(&h.def.nav, &input);
    run(&h, NOWHERE);
    const double without = h.audit.path_metres;
    tl_nav_audit_free(&h.audit);
    tl_nav_offmesh link = tl_default_nav_offmesh();
    link.start = tl_vec3_make(8, 0, 6);
    link.end = tl_vec3_make(12, 0, 6);
    link.both_ways = true;
    tl_nav_ref ref;
    TEST_RESULT(tl_navmesh_add_offmesh(h.navmesh, &link, &ref, NULL), TL_OK);
    run(&h, NOWHERE);
    assert_int_equal(h.audit.finding_count, 0);
    assert_int_equal(h.audit.path_count, 100);
    TEST_CHECK(h.audit.path_metres > 1.2 * without); // they go over to the other half
    tear_down(&h);
}

static void any_host_gives_the_same(void **state)
{
    (void)state;
    hall one, three;
    set_up(&one, 24, NOWHERE);
    set_up(&three, 24, NOWHERE);
    tl_tasks tasks;
    test_backward_tasks(&tasks, 3);
    three.def.host.tasks = &tasks;
    hall *halls[] = { &one, &three };
    for (int i = 0; i < 2; i++) {
        halls[i]->def.path_count = 500;
        audit_block(&halls[i]->change, 8, 0, 5, 9, 3, 6);
        audit_block(&halls[i]->change, 14, 1, 2, 15, 3, 3);
        run(halls[i], NOWHERE);
    }
    assert_true(one.audit.finding_count >= 2);
    assert_int_equal(one.audit.finding_count, three.audit.finding_count);
    assert_memory_equal(one.audit.findings, three.audit.findings, one.audit.finding_count * sizeof(tl_nav_finding));
    assert_int_equal(one.audit.step_count, three.audit.step_count);
    TEST_CHECK(one.audit.path_metres == three.audit.path_metres);
    assert_int_equal(one.audit.contradictions, three.audit.contradictions);
    tear_down(&one);
    tear_down(&three);
}

static void failures_leave_nothing(void **state)
{
    (void)state;
    hall h;
    set_up(&h, 24, NOWHERE);
    h.def.path_count = 40;
    audit_block(&h.change, 8, 0, 5, 9, 3, 6);
    tl_soup *soup = audit_soup(&h.change);
    tl_result result = TL_ERR_MEMORY;
    uint64_t k = 0;
    while (result == TL_ERR_MEMORY) {
        test_allocator failing;
        test_allocator_init(&failing, ++k);
        h.def.host.allocator = &failing.allocator;
        result = tl_nav_audit_run(&h.def, h.navmesh, soup, &h.audit, NULL);
        if (result == TL_OK) {
            assert_int_equal(h.audit.finding_count, 1);
        } else {
            TEST_RESULT(result, TL_ERR_MEMORY);
            assert_null(h.audit.findings);
        }
        tl_nav_audit_free(&h.audit);
        assert_int_equal(failing.live_blocks, 0);
    }
    TEST_CHECK(k > 10);
    h.def.host.allocator = NULL;
    h.def.nav.cell_size = -1.0f;
    tl_report report;
    TEST_RESULT(tl_nav_audit_run(&h.def, h.navmesh, soup, &h.audit, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.field, "cell_size");
    tl_blob_free(soup);
    tear_down(&h);
}

static bool stop_at(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)done;
    (void)total;
    return strcmp(stage, user) != 0;
}

static void it_can_be_stopped(void **state)
{
    (void)state;
    char stages[][16] = { "audit polygons", "audit paths", "audit floors" };
    for (size_t i = 0; i < 3; i++) {
        hall h;
        set_up(&h, 0, NOWHERE);
        const tl_progress progress = { stop_at, stages[i] };
        h.def.host.progress = &progress;
        tl_soup *soup = audit_soup(&h.level);
        TEST_RESULT(tl_nav_audit_run(&h.def, h.navmesh, soup, &h.audit, NULL), TL_ERR_CANCELLED);
        tl_blob_free(soup);
        tear_down(&h);
    }
}

static bool count_calls(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)stage;
    (void)done;
    (void)total;
    ++*(uint32_t *)user;
    return true;
}

// A tile can name corners 493 km apart: the lengths of its lines are known before the first step.
static void too_many_steps_are_refused(void **state)
{
    hall h;
    (void)state;
    set_up(&h, 0, NOWHERE);
    tl_soup *soup = audit_soup(&h.level);
    uint32_t calls = 0;
    const tl_progress progress = { count_calls, &calls };
    h.def.host.progress = &progress;
    TEST_RESULT(tl_nav_audit_run(&h.def, h.navmesh, soup, &h.audit, NULL), TL_OK);
    const uint32_t calls_of_all = calls;
    const uint64_t steps = h.audit.step_count;
    tl_nav_audit_free(&h.audit);
    // Before the first line; among the paths; while floors are sampled: the same with one worker and with many.
    const uint64_t limits[3] = { 100, steps / 2, steps + 100 };
    for (uint32_t i = 0; i < 6; i++) {
        tl_tasks backwards;
        test_backward_tasks(&backwards, 3);
        tl_report report;
        calls = 0;
        h.def.max_steps = limits[i % 3];
        h.def.host.tasks = i < 3 ? NULL : &backwards;
        TEST_RESULT(tl_nav_audit_run(&h.def, h.navmesh, soup, &h.audit, &report), TL_ERR_LIMIT);
        assert_string_equal(report.field, "max_steps");
        TEST_CHECK(calls < calls_of_all && (i % 3 != 0 || calls <= 2));
        TEST_CHECK(h.audit.finding_count == 0 && h.audit.findings == NULL);
    }
    tl_blob_free(soup);
    tear_down(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sound_level_has_no_findings),
        cmocka_unit_test(a_pillar_that_was_not_baked_is_found),
        cmocka_unit_test(a_simplified_outline_is_no_contradiction),
        cmocka_unit_test(a_beam_and_a_crate_are_found_and_a_kerb_is_not),
        cmocka_unit_test(a_missing_floor_is_found),
        cmocka_unit_test(a_floor_that_fell_is_a_step),
        cmocka_unit_test(missing_navmesh_is_measured),
        cmocka_unit_test(without_a_navmesh_all_floor_is_missing),
        cmocka_unit_test(links_are_not_walked),
        cmocka_unit_test(any_host_gives_the_same),
        cmocka_unit_test(failures_leave_nothing),
        cmocka_unit_test(it_can_be_stopped),
        cmocka_unit_test(too_many_steps_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
