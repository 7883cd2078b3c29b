// SPDX-License-Identifier: MIT
//
// Traces of a crowd: from a dot, where somebody stood at first, to a larger one, where they stood at last.
//
// A trace needs few of its frames: a run of them is one line as long as all lie within a hair's breadth of it.

#include "cli/crowd/crowd_film.h"
#include "cli/draw/draw_stage.h"

#include <math.h>
#include <stdio.h>

static const draw_colour OBSTACLE_COLOUR = 0x7a6a58;

enum { RING_CORNERS = 16 };

#define TRACE_LIFT   0.1f  // metres above the surface
#define TRACE_MISSES 0.03f // metres that a line may pass a frame's place by

static tl_vec3 traced_place(const tl_crowd_film *film, uint32_t who, uint32_t frame)
{
    tl_vec3 place = film->places[(size_t)frame * film->who_count + who];
    place.y += TRACE_LIFT;
    return place;
}

// Whether all frames between two lie on the line between them.
static bool is_one_line(const tl_crowd_film *film, uint32_t who, uint32_t from, uint32_t to)
{
    const tl_vec3 a = traced_place(film, who, from), way = tl_sub(traced_place(film, who, to), a);
    const float length_sq = tl_dot(way, way);
    for (uint32_t i = from + 1; i < to; i++) {
        const tl_vec3 off = tl_sub(traced_place(film, who, i), a);
        const float along = length_sq > 0.0f ? tl_clampf(tl_dot(off, way) / length_sq, 0.0f, 1.0f) : 0.0f;
        if (tl_distance(off, tl_scale(way, along)) > TRACE_MISSES) {
            return false;
        }
    }
    return true;
}

static void add_trace(draw_scene *scene, const tl_crowd_film *film, uint32_t who, draw_colour colour, float width)
{
    enum { MAX_RUN = 64 }; // a run is looked over again for each frame that it grows by
    uint32_t from = 0;
    for (uint32_t to = 1; to < film->frame_count; to++) {
        const bool last = to + 1 == film->frame_count;
        if (last || to + 1 - from > MAX_RUN || !is_one_line(film, who, from, to + 1)) {
            draw_add_line(scene, traced_place(film, who, from), traced_place(film, who, to), colour, width,
                          width > 1.0f ? 0.8f : 0.5f);
            from = to;
        }
    }
    draw_add_dot(scene, traced_place(film, who, 0), draw_colour_mix(colour, 0xffffff, 0.5f), width);
    draw_add_dot(scene, traced_place(film, who, film->frame_count - 1), colour, 1.8f * width);
}

// A corner of an obstacle's base, or of its top: round it, or the corners of a box.
static tl_vec3 obstacle_corner(const tl_crowd_obstacle *it, uint32_t corner, bool top)
{
    if (it->radius > 0.0f) {
        const double angle = TL_CROWD_DEGREE * 360.0 * (double)corner / (double)RING_CORNERS;
        const tl_vec3 at = it->is_capsule && top ? it->to : it->at;
        const float lift = !it->is_capsule && top ? it->height : 0.0f;
        return tl_vec3_make(at.x + it->radius * (float)cos(angle), at.y + lift, at.z + it->radius * (float)sin(angle));
    }
    const double turn = TL_CROWD_DEGREE * (double)it->turn, tilt = TL_CROWD_DEGREE * (double)it->tilt;
    const double x = (corner == 0 || corner == 3 ? -0.5 : 0.5) * (double)it->size[0];
    const double z = (corner < 2 ? -0.5 : 0.5) * (double)it->size[1], y = top ? (double)it->height : 0.0;
    const double along = x * cos(tilt) - y * sin(tilt), up = x * sin(tilt) + y * cos(tilt);
    return tl_vec3_make(it->at.x + (float)(along * cos(turn) + z * sin(turn)), it->at.y + (float)up,
                        it->at.z + (float)(z * cos(turn) - along * sin(turn)));
}

static void add_obstacle(draw_scene *scene, const tl_crowd_obstacle *it)
{
    const uint32_t corners = it->radius > 0.0f ? RING_CORNERS : 4;
    for (uint32_t i = 0; i < corners; i++) {
        const uint32_t next = (i + 1) % corners;
        for (int end = 0; end < 2; end++) {
            draw_add_line(scene, obstacle_corner(it, i, end > 0), obstacle_corner(it, next, end > 0), OBSTACLE_COLOUR,
                          1.6f, 1.0f);
        }
        if (i % (corners / 4) == 0) {
            draw_add_line(scene, obstacle_corner(it, i, false), obstacle_corner(it, i, true), OBSTACLE_COLOUR, 1.6f,
                          1.0f);
        }
    }
}

static void add_crowd_legends(draw_scene *scene, const tl_crowd_scenario *scenario)
{
    const uint32_t others = (scenario->vehicle_count > 0 ? 1u : 0u) + (scenario->obstacle_count > 0 ? 1u : 0u);
    const uint32_t room = DRAW_MAX_LEGENDS - others - scene->legend_count;
    const uint32_t named = scenario->group_count <= room ? scenario->group_count : room - 1;
    char text[64];
    for (uint32_t i = 0; i < named; i++) {
        const tl_crowd_group *group = &scenario->groups[i];
        if (group->name[0] != '\0') {
            snprintf(text, sizeof text, "%s: %u", group->name, group->count);
        } else {
            snprintf(text, sizeof text, "group %u: %u", i, group->count);
        }
        draw_add_legend(scene, tl_crowd_group_color(i), text);
    }
    if (named < scenario->group_count) {
        snprintf(text, sizeof text, "and %u more groups", scenario->group_count - named);
        draw_add_legend(scene, 0x808080, text);
    }
    if (scenario->vehicle_count > 0) {
        draw_add_legend(scene, TL_CROWD_VEHICLE_COLOR, "vehicle");
    }
    if (scenario->obstacle_count > 0) {
        draw_add_legend(scene, OBSTACLE_COLOUR, "obstacle, while it is there");
    }
}

void draw_stage_crowd(draw_scene *scene, const tl_crowd_play *play)
{
    const tl_crowd_film *film = &play->film;
    const tl_crowd_scenario *scenario = &play->scenario;
    const tl_crowd_outcome *outcome = &play->outcome;
    draw_stage_navmesh(scene, play->navmesh);
    scene->legend_count = 1; // the wall's: areas are not what this picture tells
    for (uint32_t i = 0; i < scene->overlay.count; i++) {
        scene->overlay.colours[i] = draw_colour_mix(scene->overlay.colours[i], 0xffffff, 0.65f);
    }
    for (uint32_t i = 0; i < scenario->obstacle_count; i++) {
        add_obstacle(scene, &scenario->obstacles[i]);
    }
    const float width = film->who_count > 200 ? 1.0f : film->who_count > 30 ? 1.6f : 2.4f;
    for (uint32_t who = 0; who < film->who_count; who++) {
        const uint32_t group = film->group_of[who];
        const bool is_vehicle = group == scenario->group_count;
        add_trace(scene, film, who, is_vehicle ? TL_CROWD_VEHICLE_COLOR : tl_crowd_group_color(group),
                  is_vehicle ? 2.0f * width : width);
    }
    add_crowd_legends(scene, scenario);
    const int length = snprintf(scene->subtitle, sizeof scene->subtitle, "%u of %u agents arrived", outcome->arrived,
                                scenario->agent_count);
    if (outcome->arrived > 0) {
        snprintf(scene->subtitle + length, sizeof scene->subtitle - (size_t)length, ", the last after %.1f s",
                 (double)outcome->last);
    }
}
