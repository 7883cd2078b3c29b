// SPDX-License-Identifier: MIT
//
// A scenario: who walks where, as JSON.
//
//   { "seconds": 40, "step": 0.05,
//     "groups": [ { "name": "west", "count": 40, "at": [4, 0, 20], "goals": [[36, 0, 20]], "start": 2, "repeat": true,
//                   "spacing": 0.9, "radius": 0.3, "height": 1.8, "speed": 1.4, "priority": 0.5,
//                   "formation": "wedge", "apart": 1.2 } ],
//     "vehicles": [ { "from": [0, 0, 10], "to": [30, 0, 10], "start": 5, "speed": 4, "radius": 1, "height": 1.5 } ],
//     "obstacles": [ { "at": [18, 0, 20], "size": [0.4, 2], "turn": 0, "height": 2, "from": 10, "until": 20 } ] }
//
// A group stands around "at", and each of its agents walks to all goals, one after the other. With a "formation" one of
// them does, who is nearest to "at", and the others follow it: "loose", "line", "column", "wedge", "ring", or their own
// slots, [[forward, left], ...]; all in metres, neighbours "apart". A vehicle drives straight
// and evades nobody. An obstacle stands from one time to another: a door that is shut, a crate, one that leans with a
// "tilt"; with "radius" a pillar, with "radius" and "to" one that lies or leans from "at" to there.

#ifndef TALUS_CLI_CROWD_SCENARIO_H
#define TALUS_CLI_CROWD_SCENARIO_H

#include "io/files/io_error.h"

#include <talus/nav_crowd.h>
#include <talus/pack.h>

#define TL_CROWD_DEGREE 0.017453292519943295 ///< radians

typedef struct tl_crowd_group {
    char name[32];
    tl_vec3 at;
    tl_vec3 *goals; ///< [goal_count], at least one
    uint32_t goal_count;
    uint32_t count;
    bool repeat;
    float start;   ///< seconds: when it sets out
    float spacing; ///< metres between those who stand beside one another at the start
    float radius, height, speed, priority;
    bool is_formed; ///< the agents follow the first of them
    tl_nav_group_def form;
    tl_nav_formation_slot *slots; ///< NULL, or [count - 1]: the form's
} tl_crowd_group;

typedef struct tl_crowd_vehicle {
    tl_vec3 from, to;
    float start, speed, radius, height;
} tl_crowd_vehicle;

typedef struct tl_crowd_obstacle {
    tl_vec3 at;        ///< the centre of its base
    float size[2];     ///< metres along x and z, before it is turned
    float radius;      ///< metres; > 0: a cylinder, or a capsule, without size
    float turn;        ///< degrees about the vertical, counter-clockwise from above
    float tilt;        ///< degrees by which a box's own x axis rises, about the centre of its base
    float height;      ///< metres
    tl_vec3 to;        ///< where is_capsule: the other end
    bool is_capsule;   ///< from `at` to `to`, grown by the radius; without turn and height
    float from, until; ///< seconds; until INFINITY: to the end
} tl_crowd_obstacle;

typedef struct tl_crowd_scenario {
    float seconds, step;
    tl_crowd_group *groups;
    uint32_t group_count;
    tl_crowd_vehicle *vehicles;
    uint32_t vehicle_count;
    tl_crowd_obstacle *obstacles;
    uint32_t obstacle_count;
    uint32_t agent_count; ///< of all groups
} tl_crowd_scenario;

/// Reads a scenario; its places are in the level's own coordinates, `frame` (may be NULL) brings them to the baked
/// ones. TL_ERR_IO; TL_ERR_FORMAT with the place; TL_ERR_LIMIT: more agents than a crowd holds; TL_ERR_MEMORY. Free
/// with tl_crowd_scenario_free in any case.
tl_result tl_crowd_scenario_read(const char *path, const tl_pack_frame *frame, tl_crowd_scenario *scenario_out,
                                 tl_io_error *error_out);
void tl_crowd_scenario_free(tl_crowd_scenario *scenario);

#endif
