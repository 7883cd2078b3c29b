// SPDX-License-Identifier: MIT
//
// SMIL animation of each circle's center, linear between frames: no script, so the picture moves in a page, in a viewer
// of pictures and in a file that was mailed.

#include "cli/crowd/crowd_film.h"

#include "cli/level/navmesh_query.h"

#include <math.h>
#include <stdio.h>

#define LEADER_RIM 0.5f // of its radius

uint32_t tl_crowd_group_color(uint32_t group)
{
    // Colours that the colour-blind tell apart (Okabe, Ito 2008), without black, which vehicles have.
    static const uint32_t colors[] = { 0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7, 0x56b4e9, 0xd55e00, 0xf0e442 };
    return colors[group % (sizeof(colors) / sizeof(colors[0]))];
}

// Centimetres are enough for the eye. 0 is never "-0".
static void add_number(tl_text *text, float value)
{
    char number[48];
    const double rounded = round(100.0 * (double)value) / 100.0;
    snprintf(number, sizeof(number), "%.10g", rounded == 0.0 ? 0.0 : rounded);
    tl_text_add(text, number);
}

static void add_attribute(tl_text *text, const char *name, float value)
{
    tl_text_add(text, " ");
    tl_text_add(text, name);
    tl_text_add(text, "=\"");
    add_number(text, value);
    tl_text_add(text, "\"");
}

static void add_floor(tl_text *text, const tl_nav_tile *tile)
{
    for (uint32_t p = 0; p < tile->polygon_count; ++p) {
        uint32_t count;
        const tl_vec3 *corners = tl_nav_tile_corners(tile, p, &count);
        for (uint32_t k = 0; k < count; ++k) {
            tl_text_add(text, k == 0 ? "M" : "L");
            add_number(text, corners[k].x);
            tl_text_add(text, " ");
            add_number(text, corners[k].z);
        }
        tl_text_add(text, "Z\n");
    }
}

static void add_motion(tl_text *text, const tl_crowd_film *film, uint32_t who, bool is_z)
{
    tl_text_add(text, is_z ? "<animate attributeName=\"cy\"" : "<animate attributeName=\"cx\"");
    tl_text_add(text, " repeatCount=\"indefinite\" dur=\"");
    add_number(text, film->interval * (float)(film->frame_count - 1));
    tl_text_add(text, "s\" values=\"");
    for (uint32_t i = 0; i < film->frame_count; ++i) {
        const tl_vec3 place = film->places[(size_t)i * film->who_count + who];
        tl_text_add(text, i > 0 ? ";" : "");
        add_number(text, is_z ? place.z : place.x);
    }
    tl_text_add(text, "\"/>");
}

static bool moves(const tl_crowd_film *film, uint32_t who)
{
    for (uint32_t i = 1; i < film->frame_count; ++i) {
        const tl_vec3 *place = &film->places[(size_t)i * film->who_count + who];
        const tl_vec3 *before = place - film->who_count;
        if (place->x != before->x || place->z != before->z) {
            return true;
        }
    }
    return false;
}

static void add_everybody(tl_text *text, const tl_crowd_film *film, const tl_crowd_scenario *scenario)
{
    for (uint32_t who = 0; who < film->who_count; ++who) {
        const uint32_t group = film->group_of[who];
        const bool is_vehicle = group == scenario->group_count;
        char fill[32];
        snprintf(fill, sizeof(fill), "<circle fill=\"#%06x\"",
                 is_vehicle ? TL_CROWD_VEHICLE_COLOR : tl_crowd_group_color(group));
        tl_text_add(text, fill);
        add_attribute(text, "r", film->radius[who]);
        add_attribute(text, "cx", film->places[who].x);
        add_attribute(text, "cy", film->places[who].z);
        if (!is_vehicle && scenario->groups[group].is_formed && (who == 0 || film->group_of[who - 1] != group)) {
            tl_text_add(text, " stroke=\"#222222\""); // the leader
            add_attribute(text, "stroke-width", LEADER_RIM * film->radius[who]);
        }
        tl_text_add(text, ">");
        if (moves(film, who)) {
            add_motion(text, film, who, false);
            add_motion(text, film, who, true);
        }
        tl_text_add(text, "</circle>\n");
    }
}

// Shown from one time to another, again and again.
static void add_presence(tl_text *text, const tl_crowd_obstacle *obstacle, float duration)
{
    if (!(duration > 0.0f) || (obstacle->from <= 0.0f && obstacle->until > duration)) {
        return; // always
    }
    if (obstacle->from >= duration) {
        tl_text_add(text, "<set attributeName=\"visibility\" to=\"hidden\"/>");
        return;
    }
    tl_text_add(text, "<animate attributeName=\"visibility\" calcMode=\"discrete\" repeatCount=\"indefinite\"");
    add_attribute(text, "dur", duration);
    tl_text_add(text, " values=\"");
    tl_text_add(text, obstacle->from > 0.0f ? "hidden;visible" : "visible");
    tl_text_add(text, obstacle->until < duration ? ";hidden\" keyTimes=\"0" : "\" keyTimes=\"0");
    const float times[2] = { obstacle->from, obstacle->until };
    for (uint32_t i = 0; i < 2; ++i) {
        if (times[i] > 0.0f && times[i] < duration) {
            char share[32];
            snprintf(share, sizeof(share), ";%.6f", (double)times[i] / (double)duration);
            tl_text_add(text, share);
        }
    }
    tl_text_add(text, "\"/>");
}

// A box from above; where it is tilted, all that it covers.
static void add_box_outline(tl_text *text, const tl_crowd_obstacle *it)
{
    const double tilt = TL_CROWD_DEGREE * (double)it->tilt;
    const float half = 0.5f * it->size[0] * (float)cos(tilt), lean = it->height * (float)sin(tilt);
    add_attribute(text, "x", it->at.x - half - (lean > 0.0f ? lean : 0.0f));
    add_attribute(text, "y", it->at.z - 0.5f * it->size[1]);
    add_attribute(text, "width", 2.0f * half + fabsf(lean));
    add_attribute(text, "height", it->size[1]);
    tl_text_add(text, " transform=\"rotate(");
    add_number(text, -it->turn); // SVG turns clockwise
    tl_text_add(text, " ");
    add_number(text, it->at.x);
    tl_text_add(text, " ");
    add_number(text, it->at.z);
    tl_text_add(text, ")\"");
}

static void add_capsule_outline(tl_text *text, const tl_crowd_obstacle *it)
{
    tl_text_add(text, " stroke=\"#7a6a58\" stroke-linecap=\"round\"");
    add_attribute(text, "stroke-width", 2.0f * it->radius);
    add_attribute(text, "x1", it->at.x);
    add_attribute(text, "y1", it->at.z);
    add_attribute(text, "x2", it->to.x);
    add_attribute(text, "y2", it->to.z);
}

static void add_obstacles(tl_text *text, const tl_crowd_film *film, const tl_crowd_scenario *scenario)
{
    const float duration = film->interval * (float)(film->frame_count - 1);
    for (uint32_t i = 0; i < scenario->obstacle_count; ++i) {
        const tl_crowd_obstacle *it = &scenario->obstacles[i];
        const char *element = it->is_capsule ? "line" : it->radius > 0.0f ? "circle" : "rect";
        tl_text_add(text, "<");
        tl_text_add(text, element);
        tl_text_add(text, " fill=\"#7a6a58\"");
        if (it->is_capsule) {
            add_capsule_outline(text, it);
        } else if (it->radius > 0.0f) {
            add_attribute(text, "r", it->radius);
            add_attribute(text, "cx", it->at.x);
            add_attribute(text, "cy", it->at.z);
        } else {
            add_box_outline(text, it);
        }
        tl_text_add(text, ">");
        add_presence(text, it, duration);
        tl_text_add(text, "</");
        tl_text_add(text, element);
        tl_text_add(text, ">\n");
    }
}

void tl_crowd_film_add_svg(const tl_crowd_film *film, const tl_crowd_scenario *scenario, const tl_navmesh *navmesh,
                           tl_text *text)
{
    const tl_aabb bounds = tl_navmesh_bounds(navmesh);
    const float margin = 1.0f, width = bounds.max.x - bounds.min.x, depth = bounds.max.z - bounds.min.z;
    tl_text_add(text, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"");
    add_number(text, bounds.min.x - margin);
    tl_text_add(text, " ");
    add_number(text, bounds.min.z - margin);
    tl_text_add(text, " ");
    add_number(text, width + 2.0f * margin);
    tl_text_add(text, " ");
    add_number(text, depth + 2.0f * margin);
    tl_text_add(text, "\">\n<rect fill=\"#ffffff\" width=\"100%\" height=\"100%\"");
    add_attribute(text, "x", bounds.min.x - margin);
    add_attribute(text, "y", bounds.min.z - margin);
    tl_text_add(text, "/>\n<path fill=\"#dfe3e6\" stroke=\"#c3c9ce\" stroke-width=\"0.04\" d=\"");
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); ++slot) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        if (tile != NULL) {
            add_floor(text, tile);
        }
    }
    tl_text_add(text, "\"/>\n");
    add_obstacles(text, film, scenario);
    add_everybody(text, film, scenario);
    tl_text_add(text, "</svg>\n");
}

void tl_crowd_film_add_lines(const tl_crowd_film *film, tl_text *text)
{
    for (uint32_t i = 0; i < film->frame_count; ++i) {
        tl_text_add(text, "{\"t\":");
        tl_text_add_json_float(text, film->interval * (float)i);
        tl_text_add(text, ",\"places\":[");
        for (uint32_t who = 0; who < film->who_count; ++who) {
            tl_text_add(text, who > 0 ? "," : "");
            tl_text_add_json_point(text, film->places[(size_t)i * film->who_count + who]);
        }
        tl_text_add(text, "],\"status\":[");
        for (uint32_t who = 0; who < film->who_count; ++who) {
            tl_text_add(text, who > 0 ? ",\"" : "\"");
            tl_text_add(text,
                        tl_nav_agent_status_name((tl_nav_agent_status)film->status[(size_t)i * film->who_count + who]));
            tl_text_add(text, "\"");
        }
        tl_text_add(text, "]}\n");
    }
}
