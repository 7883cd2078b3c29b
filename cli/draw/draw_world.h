// SPDX-License-Identifier: MIT
//
// A world's job as maps of its tiles: how much of each is walkable, what it was expected to cost, how long it took, and
// which are missing.

#ifndef TALUS_CLI_DRAW_WORLD_H
#define TALUS_CLI_DRAW_WORLD_H

#include "cli/shared/command.h"

typedef struct draw_world_options {
    const char *output;
    const char *stages; ///< words of walkable, cost, time, missing, with commas between; or all; NULL: all
    uint32_t size;      ///< pixels along the longer side of each map
} draw_world_options;

/// Whether a path is the folder of a job that is planned.
bool draw_is_world_job(const char *path);

/// Writes the maps side by side into one picture.
tl_exit draw_world(tl_cli *cli, const char *job, const draw_world_options *options);

#endif
