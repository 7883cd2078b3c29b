// SPDX-License-Identifier: MIT
//
// A film of a crowd as a file: an animated SVG, which every browser plays, or JSON lines.

#ifndef TALUS_CLI_CROWD_FILM_H
#define TALUS_CLI_CROWD_FILM_H

#include "cli/crowd/crowd_run.h"
#include "cli/shared/text_buffer.h"

/// 0xRRGGBB, in pictures too.
#define TL_CROWD_VEHICLE_COLOR 0x222222u
uint32_t tl_crowd_group_color(uint32_t group);

/// The navmesh seen from above, x to the right and z down, as it was baked; everybody as a circle of their radius, in
/// the colour of their group; obstacles while they are there.
void tl_crowd_film_add_svg(const tl_crowd_film *film, const tl_crowd_scenario *scenario, const tl_navmesh *navmesh,
                           tl_text *text);

/// One line a frame: {"t":0.25,"places":[[x,y,z],...],"status":["walking",...]}, places in the frame of `text`.
void tl_crowd_film_add_lines(const tl_crowd_film *film, tl_text *text);

#endif
