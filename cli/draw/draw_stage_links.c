// SPDX-License-Identifier: MIT
//
// The links of a navmesh: the trajectory of each, coloured by its kind.

#include "cli/draw/draw_stage.h"

#include <stdio.h>

enum { JUMP_PIECES = 24 };

static const draw_colour LINK_COLOURS[TL_NAV_LINK_KINDS] = { 0xc0392b, 0x7d3c98, 0xd68910 };

static tl_vec3 lifted_end(tl_vec3 p)
{
    return tl_vec3_make(p.x, p.y + 0.15f, p.z);
}

static void add_link_arc(draw_scene *scene, const tl_nav_jump_link *link)
{
    draw_colour colour = LINK_COLOURS[link->kind];
    tl_vec3 corner = tl_vec3_make(link->end.x, link->start.y, link->end.z);
    if (link->kind == TL_NAV_LINK_JUMP) {
        tl_vec3 from = link->start;
        for (int i = 1; i <= JUMP_PIECES; i++) {
            tl_vec3 to = tl_nav_jump_link_point(link, (float)i / (float)JUMP_PIECES);
            draw_add_line(scene, lifted_end(from), lifted_end(to), colour, 2.6f, 1.0f);
            from = to;
        }
    } else {
        draw_add_line(scene, lifted_end(link->start), lifted_end(corner), colour, 2.6f, 1.0f);
        draw_add_line(scene, lifted_end(corner), lifted_end(link->end), colour, 2.6f, 1.0f);
    }
    // Where a link can be begun it has a dot.
    draw_add_dot(scene, lifted_end(link->start), colour, 3.6f);
    if (link->both_ways != 0) {
        draw_add_dot(scene, lifted_end(link->end), colour, 3.6f);
    }
}

void draw_stage_links(draw_scene *scene, const tl_navmesh *navmesh, const tl_nav_links *links)
{
    draw_stage_navmesh(scene, navmesh);
    for (uint32_t i = 0; i < links->link_count; i++) {
        add_link_arc(scene, &tl_nav_links_array(links)[i]);
    }
    for (int kind = 0; kind < TL_NAV_LINK_KINDS; kind++) {
        char text[64];
        snprintf(text, sizeof text, "%s (dot: can be begun here)", tl_nav_link_kind_name((tl_nav_link_kind)kind));
        draw_add_legend(scene, LINK_COLOURS[kind], kind == 0 ? text : tl_nav_link_kind_name((tl_nav_link_kind)kind));
    }
    snprintf(scene->subtitle, sizeof scene->subtitle, "%u drops, %u jumps, %u climbs", links->kind_counts[0],
             links->kind_counts[1], links->kind_counts[2]);
}
