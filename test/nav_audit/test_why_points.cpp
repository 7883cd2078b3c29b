// SPDX-License-Identifier: MIT
//
// Random points on the floors of levels, most of them beside walls and ledges, and what tl_nav_why says of each, held
// against bakes of the whole level: what it calls walkable has a polygon, and nothing else has; where a triangle lies
// at the point there is a floor; what it says is needed makes the point walkable; and a change that is smaller does
// not.

#include "level_list.hpp"

extern "C" {
#include "nav_bake.h"
}

#include <talus/nav_around.h>
#include <talus/nav_audit.h>
#include <talus/soup.h>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace
{

uint32_t points_per_level = 12;

struct tally {
    uint32_t points, walkable, proven, minimal, faults, causes[TL_NAV_CAUSE_WALL + 1];
};

struct asked_level {
    tl_mesh mesh;
    tl_nav_input input;
    tl_nav_def def;
    tl_navmesh *navmesh;
    tl_soup *soup;
};

bool has_polygon(const tl_navmesh *navmesh, tl_vec3 floor, float within)
{
    tl_nav_location location;
    return tl_navmesh_find_nearest(navmesh, nullptr, floor, tl_vec3_make(0, within, 0), &location) == TL_OK;
}

// How far a surface may lie from the floor: as for the answer.
float surface_of(const asked_level &l, const tl_nav_def &def)
{
    tl_nav_config config;
    TEST_RESULT(tl_nav_config_from_def(&def, l.mesh.bounds, 0, 0, &config, nullptr), TL_OK);
    return std::fmin(tl_nav_probe_from_config(&config).surface, 0.5f * def.agent_height);
}

bool is_walkable(const asked_level &l, const tl_nav_def &def, tl_vec3 floor)
{
    tl_navmesh *navmesh = test_nav_bake(&def, &l.input);
    // A finer voxel's floor lies lower.
    const bool there = has_polygon(navmesh, floor, surface_of(l, def) + l.def.cell_height);
    tl_navmesh_destroy(navmesh);
    return there;
}

// The def with the change of one setting, or a part of it: `share` 1 is the whole.
bool smaller_change(const tl_nav_def &def, const tl_nav_reason &reason, tl_nav_def *out)
{
    *out = def;
    const std::string name = reason.parameter != nullptr ? reason.parameter : "";
    if (name == "agent_radius") {
        out->agent_radius = std::fmin(reason.needed + 0.05f * def.cell_size, reason.value);
    } else if (name == "agent_max_climb") {
        out->agent_max_climb = std::fmax(reason.needed - 0.05f * def.cell_height, reason.value);
    } else if (name == "agent_height") {
        out->agent_height = std::fmin(reason.needed + 0.05f * def.cell_height, reason.value);
    } else if (name == "agent_max_slope") {
        out->agent_max_slope = std::fmax(reason.needed - 0.02f, reason.value);
    } else if (name == "region_min_size") {
        out->region_min_size = std::fmin(reason.needed + 0.03f, reason.value);
    } else if (name == "edge_max_error") {
        out->edge_max_error = std::fmin(reason.needed + 0.05f * reason.value, reason.value);
    } else {
        return false;
    }
    return true;
}

void check_answer(const asked_level &l, const tl_nav_why_answer &answer, tl_vec3 point, tally *t)
{
    const tl_nav_reason &reason = answer.reasons[0];
    const bool whole = is_walkable(l, answer.needed, answer.floor);
    char text[256];
    std::snprintf(text, sizeof text, "at %g,%g,%g: %s, %s %g -> %g (%u reasons)", (double)point.x, (double)point.y,
                  (double)point.z, tl_nav_cause_name(reason.cause),
                  reason.parameter != nullptr ? reason.parameter : "nothing", (double)reason.value,
                  (double)reason.needed, answer.reason_count);
    t->proven += answer.proven;
    if (answer.proven && !whole) {
        std::printf("%s: what is needed does not help\n", text);
        t->faults++;
    }
    tl_nav_def less;
    if (answer.proven && answer.reason_count == 1 && smaller_change(l.def, reason, &less)) {
        t->minimal++;
        if (is_walkable(l, less, answer.floor)) {
            std::printf("%s: less would do\n", text);
            t->faults++;
        }
    }
}

void ask_at(const asked_level &l, tl_vec3 point, tally *t)
{
    tl_nav_why_answer answer;
    TEST_RESULT(tl_nav_why(&l.def, &l.input, l.navmesh, nullptr, point, &answer, nullptr), TL_OK);
    t->points++;
    t->walkable += answer.walkable;
    TEST_CHECK(answer.walkable == has_polygon(l.navmesh, answer.floor, surface_of(l, l.def)));
    if (answer.walkable) {
        return;
    }
    const tl_nav_cause cause = answer.reasons[0].cause;
    TEST_CHECK(answer.reason_count > 0 && cause != TL_NAV_CAUSE_CHANGED);
    t->causes[cause]++;
    if (cause == TL_NAV_CAUSE_NO_FLOOR) {
        std::printf("at %g,%g,%g: no floor, where a triangle lies\n", (double)point.x, (double)point.y,
                    (double)point.z);
        t->faults++;
    }
    check_answer(l, answer, point, t);
}

// The floor under a place, seen from above: false when there is none, or it faces down.
bool find_floor(const asked_level &l, tl_vec3 from, float reach, tl_vec3 *floor)
{
    const tl_ray ray = { from, { 0, -1, 0 }, reach };
    tl_ray_hit hit;
    if (!tl_soup_cast_ray(l.soup, &ray, nullptr, &hit) || hit.back || !(hit.normal.y > 0.3f)) {
        return false;
    }
    *floor = tl_vec3_make(from.x, from.y - hit.t, from.z);
    return true;
}

// A point of the floor beside a random wall of the navmesh, up to a metre from it.
bool random_place(const asked_level &l, test_random *random, tl_vec3 *point)
{
    const uint64_t bits[2] = { test_random_u64(random), test_random_u64(random) };
    tl_nav_location at;
    TEST_RESULT(tl_navmesh_random_point(l.navmesh, nullptr, bits, &at), TL_OK);
    tl_nav_wall_segment walls[64];
    uint32_t count = 0;
    (void)tl_navmesh_polygon_walls(l.navmesh, nullptr, at.polygon, walls, 64, &count);
    tl_vec3 from = at.point;
    if (count > 0 && test_random_below(random, 8) != 0) {
        const tl_nav_wall_segment &wall = walls[test_random_below(random, count < 64 ? count : 64)];
        const tl_vec3 on = tl_lerp(wall.start, wall.end, test_random_unit(random));
        const tl_vec3 along = tl_normalize(tl_sub(wall.end, wall.start));
        // The polygon lies on the wall's left.
        from = tl_mul_add(on, tl_vec3_make(-along.z, 0, along.x), 1.2f * test_random_unit(random) - 0.1f);
    }
    from.y += 0.5f;
    return find_floor(l, from, 1.5f, point);
}

void ask_level(const level &source, tally *t)
{
    asked_level l;
    const tl_mesh_view view = source.view();
    TEST_RESULT(tl_mesh_bake(&view, nullptr, &l.mesh, nullptr), TL_OK);
    l.input = { tl_mesh_as_view(&l.mesh), nullptr, nullptr, 0 };
    l.def = tl_default_nav_def();
    l.def.cell_size = source.cell_size;
    l.def.agent_max_slope = source.max_slope;
    l.navmesh = test_nav_bake(&l.def, &l.input);
    TEST_RESULT(tl_soup_bake(&l.input.mesh, nullptr, &l.soup, nullptr), TL_OK);
    test_random random = { 11 };
    for (uint32_t i = 0; i < points_per_level;) {
        tl_vec3 point;
        if (random_place(l, &random, &point)) {
            ask_at(l, point, t);
            i++;
        }
    }
    tl_blob_free(l.soup);
    tl_navmesh_destroy(l.navmesh);
    tl_mesh_free(&l.mesh);
}

void test_points(void **)
{
    tally t = {};
    for (const level &l : all_levels(1500, { "nav_test", "dungeon", "house", "office" })) {
        const tally before = t;
        ask_level(l, &t);
        std::printf("%-18s %u points, %u walkable, %u proven, %u smaller changes tried\n", l.name.c_str(),
                    t.points - before.points, t.walkable - before.walkable, t.proven - before.proven,
                    t.minimal - before.minimal);
    }
    for (int cause = 1; cause <= TL_NAV_CAUSE_WALL; cause++) {
        std::printf("%-22s %u\n", tl_nav_cause_name((tl_nav_cause)cause), t.causes[cause]);
    }
    TEST_CHECK(t.walkable > 4 && t.causes[TL_NAV_CAUSE_RADIUS] > 20 && t.causes[TL_NAV_CAUSE_WALL] > 2);
    TEST_CHECK(t.minimal > 20 && t.faults == 0);
}

} // namespace

int main(int argc, char **argv)
{
    points_per_level = argc > 2 ? 100 : points_per_level; // of files that are named
    take_level_arguments(argc, argv);
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_points) };
    return cmocka_run_group_tests(tests, nullptr, nullptr);
}
