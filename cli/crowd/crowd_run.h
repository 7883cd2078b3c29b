// SPDX-License-Identifier: MIT
//
// Runs a scenario, and keeps where everybody was.

#ifndef TALUS_CLI_CROWD_RUN_H
#define TALUS_CLI_CROWD_RUN_H

#include "cli/crowd/crowd_obstacles.h"
#include "cli/shared/command.h"

#include <talus/nav_crowd.h>

/// Where everybody was, every `interval` seconds from 0 on. Agents by group, vehicles behind them.
typedef struct tl_crowd_film {
    float interval;
    uint32_t who_count;
    uint32_t *group_of;     ///< [who_count]; a vehicle's is group_count
    float *radius, *height; ///< [who_count], metres
    uint32_t frame_count, frame_capacity;
    tl_vec3 *places; ///< [frame_count * who_count], metres
    uint8_t *status; ///< tl_nav_agent_status, as places
} tl_crowd_film;

typedef struct tl_crowd_outcome {
    float seconds;          ///< of the scenario that were run: it ends when all have arrived
    uint32_t arrived;       ///< agents that came to all their goals
    uint32_t unreachable;   ///< agents that no path leads to a goal, or that gave up
    uint32_t off_mesh;      ///< at the end
    float half, last;       ///< seconds at which half of those who arrived had, and all of them
    uint64_t pairs;         ///< in the frames of the film that overlapped by more than a millimetre
    float deepest;          ///< metres, of those
    uint64_t agent_steps;   ///< without the vehicles
    double compute_seconds; ///< that the steps took
    uint64_t hash;          ///< of the crowd at the end
} tl_crowd_outcome;

/// What a scenario runs on.
typedef struct tl_crowd_stage {
    const tl_navmesh *navmesh;
    tl_crowd_obstacles *obstacles; ///< NULL: none; else theirs is the navmesh
    const tl_crowd_scenario *scenario;
} tl_crowd_stage;

/// False: reported. Free the film with tl_crowd_film_free in any case. The obstacles have gone at the end.
bool tl_crowd_run(tl_cli *cli, const tl_crowd_stage *stage, float interval, tl_crowd_film *film_out,
                  tl_crowd_outcome *outcome_out, tl_exit *exit_out);
void tl_crowd_film_free(tl_crowd_film *film);

#endif
