// SPDX-License-Identifier: MIT
//
// A scenario from its file to its film: read, set on the navmesh of FILE, run.

#ifndef TALUS_CLI_CROWD_PLAY_H
#define TALUS_CLI_CROWD_PLAY_H

#include "cli/crowd/crowd_run.h"

typedef struct tl_crowd_play {
    tl_crowd_scenario scenario;
    tl_crowd_obstacles obstacles; ///< where the scenario has some
    const tl_navmesh *navmesh;    ///< after the run, without its obstacles: the input's, or theirs
    tl_crowd_film film;
    tl_crowd_outcome outcome;
} tl_crowd_play;

/// Reads a scenario, whose places are in the coordinates of the level that was opened last. False: reported. Free with
/// tl_crowd_play_free in any case.
bool tl_crowd_play_read(tl_cli *cli, const char *path, tl_crowd_play *play_out, tl_exit *exit_out);
/// Runs it, a frame of the film every `interval` seconds. With obstacles the level is baked in tiles that they change;
/// else it takes the input's navmesh, which is made where there is none yet. False: reported.
bool tl_crowd_play_run(tl_cli *cli, tl_input *input, const tl_bake_settings *settings, float interval,
                       tl_crowd_play *play, tl_exit *exit_out);
void tl_crowd_play_free(tl_crowd_play *play);

#endif
