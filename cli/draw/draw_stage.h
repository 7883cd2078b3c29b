// SPDX-License-Identifier: MIT
//
// From each stage's data to a scene. Every function adds triangles, lines and legends, and writes the subtitle.

#ifndef TALUS_CLI_DRAW_STAGE_H
#define TALUS_CLI_DRAW_STAGE_H

#include "cli/crowd/crowd_play.h"
#include "cli/draw/draw_scene.h"

#include <talus/nav_bake.h>
#include <talus/nav_links.h>
#include <talus/nav_query.h>
#include <talus/soup.h>

/// The colour of what is walkable by its slope, and of an area; neighbours' shades differ a little by `shade`, 0 or 1.
#define DRAW_WALKABLE 0x7fb3d5u
draw_colour draw_colour_of_area(uint8_t area, uint32_t shade);
/// A legend entry for each area that is in use, the walkable one first; of more than fit the last says how many.
void draw_add_area_legends(draw_scene *scene, const bool used[TL_NAV_MAX_AREA + 1]);

/// Pairs in two shades of a hue, singles apart, and the boxes of the tree at `depth`.
void draw_stage_soup(draw_scene *scene, const tl_soup *soup, uint32_t depth);

/// The solid spans as blocks, walkable tops coloured.
void draw_stage_spans(draw_scene *scene, const tl_nav_heightfield *heightfield);

/// What colours an open floor.
typedef enum draw_floor_colour { DRAW_FLOOR_AREA, DRAW_FLOOR_DISTANCE, DRAW_FLOOR_REGION } draw_floor_colour;
void draw_stage_floors(draw_scene *scene, const tl_nav_compact *compact, draw_floor_colour colour);

/// Traced outlines, thin, under the simplified ones.
void draw_stage_contours(draw_scene *scene, const tl_nav_contours *contours);
/// The outlines of a set alone.
void draw_stage_contour_set(draw_scene *scene, const tl_contour_set *set);

/// Polygons filled by region, with edges; `what` names them in the subtitle ("polygons", "triangles").
void draw_stage_polygons(draw_scene *scene, const tl_polygon_mesh *polygons, const char *what);

void draw_stage_detail(draw_scene *scene, const tl_nav_detail *detail);

/// The baked tiles, their polygons coloured by area.
void draw_stage_navmesh(draw_scene *scene, const tl_navmesh *navmesh);

/// The baked tiles, and the trajectories of links over them.
void draw_stage_links(draw_scene *scene, const tl_navmesh *navmesh, const tl_nav_links *links);

/// A route over the navmesh: the polygons of the corridor, the straight path, start and goal.
void draw_stage_route(draw_scene *scene, const tl_navmesh *navmesh, const tl_nav_route *route,
                      const tl_nav_path_buffers *buffers);

/// A scenario that was run: the navmesh, the way of everybody in the colour of their group, obstacles.
void draw_stage_crowd(draw_scene *scene, const tl_crowd_play *play);

#endif
