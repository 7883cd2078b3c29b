// SPDX-License-Identifier: MIT
//
// Contours: the traced outline of each region, thin, and the simplified one over it with its vertices.

#include "cli/draw/draw_stage.h"

#include <stdio.h>

static tl_vec3 contour_point(const tl_contour_set *set, uint32_t vertex)
{
    const tl_contour_vertex *v = &set->vertices[vertex];
    return tl_vec3_make(set->bounds.min.x + (float)v->x * set->cell_size,
                        set->bounds.min.y + ((float)v->y + 1.0f) * set->cell_height,
                        set->bounds.min.z + (float)v->z * set->cell_size);
}

typedef struct outline_style {
    float width, alpha;
    bool plain; // one grey for all, no dots
} outline_style;

static void add_outlines(draw_scene *scene, const tl_contour_set *set, outline_style style)
{
    for (uint32_t i = 0; i < set->contour_count; i++) {
        const tl_contour *contour = &set->contours[i];
        draw_colour colour =
            style.plain ? 0x55555d : draw_colour_mix(draw_colour_of_id(contour->region), 0x101018, 0.35f);
        for (uint32_t k = 0; k < contour->vertex_count; k++) {
            tl_vec3 a = contour_point(set, contour->first_vertex + k);
            tl_vec3 b = contour_point(set, contour->first_vertex + (k + 1) % contour->vertex_count);
            draw_add_line(scene, a, b, colour, style.width, style.alpha);
            if (!style.plain) {
                draw_add_dot(scene, a, draw_colour_mix(colour, 0x000000, 0.3f), 2.2f);
            }
        }
    }
}

void draw_stage_contour_set(draw_scene *scene, const tl_contour_set *set)
{
    const outline_style simplified = { 2.2f, 1.0f, false };
    add_outlines(scene, set, simplified);
    snprintf(scene->subtitle, sizeof scene->subtitle, "%u contours, %u vertices", set->contour_count,
             set->vertex_count);
    draw_add_legend(scene, draw_colour_mix(draw_colour_of_id(1), 0x101018, 0.35f), "contour, a colour for each region");
}

void draw_stage_contours(draw_scene *scene, const tl_nav_contours *contours)
{
    const outline_style traced = { 0.8f, 0.55f, true };
    add_outlines(scene, &contours->raw, traced);
    draw_stage_contour_set(scene, &contours->set);
    snprintf(scene->subtitle, sizeof scene->subtitle, "%u contours: %u traced vertices simplified to %u",
             contours->set.contour_count, contours->raw.vertex_count, contours->set.vertex_count);
    draw_add_legend(scene, 0x55555d, "as traced");
}
