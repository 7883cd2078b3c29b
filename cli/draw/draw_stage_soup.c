// SPDX-License-Identifier: MIT
//
// The soup: each pair in two shades of one hue, singles in orange, the tree's boxes down to a depth, lower ones in
// thinner lines.

#include "cli/draw/draw_stage.h"

#include <stdio.h>

typedef struct box_job {
    draw_scene *scene;
    uint32_t depth;
    uint32_t count;
} box_job;

static bool add_tree_box(tl_aabb box, uint32_t depth, bool leaf, void *user)
{
    (void)leaf;
    box_job *job = user;
    if (depth > 0 || job->depth == 0) {
        // The lowest boxes in the thinnest line, and no more than three widths.
        uint32_t above = job->depth - depth < 2 ? job->depth - depth : 2;
        draw_add_box(job->scene, box, 0x1d2f6f, 0.8f + 0.8f * (float)above, above == 0 ? 0.5f : 0.75f);
        job->count++;
    }
    return true;
}

void draw_stage_soup(draw_scene *scene, const tl_soup *soup, uint32_t depth)
{
    const draw_colour single = 0xe8833a;
    scene->overlay_alpha = 1.0f;
    scene->overlay_bias = 0.002f * tl_length(tl_aabb_size(tl_soup_bounds(soup)));
    uint64_t cursor = 0;
    tl_soup_pair pair;
    for (uint32_t i = 1; tl_soup_next_pair(soup, &cursor, &pair); i++) {
        draw_colour hue = draw_colour_of_id(i);
        if (pair.triangles[1] == TL_NO_TRIANGLE) {
            draw_add_triangle(scene, pair.corners[0], pair.corners[1], pair.corners[2], single);
        } else {
            draw_add_triangle(scene, pair.corners[0], pair.corners[1], pair.corners[2],
                              draw_colour_mix(hue, 0xffffff, 0.5f));
            draw_add_triangle(scene, pair.corners[0], pair.corners[2], pair.corners[3],
                              draw_colour_mix(hue, 0x8a8a90, 0.35f));
        }
    }
    tl_soup_stats stats = tl_soup_get_stats(soup);
    depth = depth < stats.depth ? depth : stats.depth;
    box_job job = { scene, depth, 0 };
    tl_soup_bvh_boxes(soup, depth, add_tree_box, &job);

    snprintf(scene->subtitle, sizeof scene->subtitle,
             "%u triangles, %.1f%% of them in %u pairs; %u nodes, %.1f bytes a triangle; %u boxes down to depth %u",
             stats.triangle_count, 200.0 * stats.pair_count / (stats.triangle_count - stats.coincident_count),
             stats.pair_count, stats.node_count, (double)stats.size / stats.triangle_count, job.count, depth);
    draw_add_legend(scene, draw_colour_mix(draw_colour_of_id(2), 0xffffff, 0.5f), "pair: first triangle");
    draw_add_legend(scene, draw_colour_mix(draw_colour_of_id(2), 0x8a8a90, 0.35f), "second triangle");
    draw_add_legend(scene, single, "single");
    draw_add_legend(scene, 0x1d2f6f, "box of the tree");
}
