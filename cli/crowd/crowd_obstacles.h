// SPDX-License-Identifier: MIT
//
// The obstacles of a scenario, which come and go while it runs, and the navmesh that they change.

#ifndef TALUS_CLI_CROWD_OBSTACLES_H
#define TALUS_CLI_CROWD_OBSTACLES_H

#include "cli/crowd/crowd_scenario.h"
#include "cli/level/open_input.h"

#include <talus/nav_obstacles.h>

typedef struct tl_crowd_obstacles {
    const tl_crowd_scenario *scenario;
    tl_nav_obstacles *tiles;
    tl_navmesh *navmesh;
    tl_nav_obstacle_id *ids; ///< [scenario->obstacle_count]; 0: away just now
    float last_change;       ///< seconds: of the scenario, after which nothing comes or goes
} tl_crowd_obstacles;

/// Bakes the level in tiles that can be rebaked, without obstacles. False: reported; a baked file is refused, as it has
/// no heightfields, and so is pruning. Free with tl_crowd_obstacles_free in any case.
bool tl_crowd_obstacles_make(tl_cli *cli, tl_input *input, const tl_bake_settings *settings,
                             const tl_crowd_scenario *scenario, tl_crowd_obstacles *obstacles_out, tl_exit *exit_out);
/// Lets those come and go that do until `time`; below 0: all go. False: reported.
bool tl_crowd_obstacles_set_time(tl_cli *cli, tl_crowd_obstacles *obstacles, float time, tl_exit *exit_out);
void tl_crowd_obstacles_free(tl_crowd_obstacles *obstacles);

#endif
