// SPDX-License-Identifier: MIT
//
// What pictures are drawn from: a level; a baked file, whose soup gives the level's triangles back; or a set of
// contours alone. And each thing that a stage needs, made when the first stage asks for it.

#ifndef TALUS_CLI_DRAW_SOURCE_H
#define TALUS_CLI_DRAW_SOURCE_H

#include "cli/level/open_input.h"
#include "io/text/contour_text.h"

#include <talus/nav_audit.h>

typedef struct draw_source {
    tl_cli *cli;
    tl_input input;
    const tl_bake_settings *settings;
    tl_nav_def nav_def; ///< of the options, or of the baked file
    tl_mesh_view mesh;  ///< the level's triangles
    tl_level_areas areas;
    const uint8_t *soup_areas; ///< of a baked file: the same by the soup's numbers; NULL: materials gave none
    tl_aabb bounds;            ///< of the triangles
    tl_vec3 *corners;          ///< what `mesh` points into for a baked file
    uint32_t *indices;
    uint32_t *numbers;   ///< the same: each triangle's number in the source
    tl_soup *baked_soup; ///< made here
    const tl_soup *soup; ///< after draw_need_soup
    tl_nav_stages stages;
    bool is_bare;     ///< a baked file without triangles: its navmesh can be drawn, and paths over it
    bool is_contours; ///< FILE is a contour set: no triangles, no stages but those that contours have
    tl_contour_text text;
    const tl_contour_set *contours; ///< after draw_need_contours
    bool has_stages;                ///< after draw_need_stages
    bool has_navmesh;               ///< after draw_need_navmesh: input.navmesh, and pruning
    tl_nav_pruning pruning;         ///< what was left out; without a navmesh when nothing was
    tl_navmesh *pruned;             ///< the same navmesh
} draw_source;

/// Opens FILE; of a contour file, set number `set`. `settings` must outlive the source. False: reported, and
/// `*exit_out` says how to end. Close it then too.
bool draw_source_open(tl_cli *cli, const char *path, const tl_bake_settings *settings, uint32_t set,
                      draw_source *source_out, tl_exit *exit_out);
void draw_source_close(draw_source *source);

/// The number in the source's file of a triangle of `mesh`, or of `soup`; TL_NO_TRIANGLE stays what it is.
uint32_t draw_mesh_triangle(const draw_source *source, uint32_t triangle);
uint32_t draw_soup_triangle(const draw_source *source, uint32_t triangle);

bool draw_need_soup(draw_source *source, tl_exit *exit_out);
/// The navmesh pipeline over the whole level in one tile, all intermediate data kept.
bool draw_need_stages(draw_source *source, tl_exit *exit_out);
/// The contours, of the pipeline or of the contour file.
bool draw_need_contours(draw_source *source, tl_exit *exit_out);
bool draw_need_navmesh(draw_source *source, tl_exit *exit_out);
/// A navmesh of at least one polygon: an empty one is reported with its likely cause.
bool draw_need_walkable(draw_source *source, tl_exit *exit_out);

#endif
