// SPDX-License-Identifier: MIT
//
// What areas look like, in all stages alike.

#include "cli/draw/draw_stage.h"

#include <stdio.h>

draw_colour draw_colour_of_area(uint8_t area, uint32_t shade)
{
    const draw_colour colour = area == TL_NAV_WALKABLE_AREA ? DRAW_WALKABLE : draw_colour_of_id(area);
    return shade == 0 ? colour : draw_colour_mix(colour, 0xffffff, 0.14f);
}

void draw_add_area_legends(draw_scene *scene, const bool used[TL_NAV_MAX_AREA + 1])
{
    if (used[TL_NAV_WALKABLE_AREA]) {
        draw_add_legend(scene, DRAW_WALKABLE, "walkable");
    }
    uint32_t left = 0;
    for (uint32_t area = 1; area <= TL_NAV_MAX_AREA; area++) {
        left += used[area] && area != TL_NAV_WALKABLE_AREA;
    }
    for (uint32_t area = 1; area <= TL_NAV_MAX_AREA && left > 0; area++) {
        if (!used[area] || area == TL_NAV_WALKABLE_AREA) {
            continue;
        }
        char text[64];
        const bool last = scene->legend_count + 1 == DRAW_MAX_LEGENDS && left > 1;
        if (last) {
            snprintf(text, sizeof text, "area %u, and %u others", area, left - 1);
        } else {
            snprintf(text, sizeof text, "area %u", area);
        }
        draw_add_legend(scene, draw_colour_of_area((uint8_t)area, 0), text);
        left = last ? 0 : left - 1;
    }
}
