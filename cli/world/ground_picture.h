// SPDX-License-Identifier: MIT
//
// A merged world as one picture from above (ground_map.h), in the memory of the picture, whatever its size.

#ifndef TALUS_CLI_GROUND_PICTURE_H
#define TALUS_CLI_GROUND_PICTURE_H

#include "cli/shared/command.h"

/// Files of more tiles than this are drawn tile by tile; smaller ones in memory, from all sides.
enum { TL_GROUND_LEAST_TILES = 2048 };

/// Draws a file of so many tiles and no triangles, `size` pixels along the longer side. `stage` is what the answer
/// calls it. False: it is another file, and nothing was done.
bool tl_draw_large_ground(tl_cli *cli, const char *path, const char *stage, const char *output, uint32_t size,
                          tl_exit *exit_out);

#endif
