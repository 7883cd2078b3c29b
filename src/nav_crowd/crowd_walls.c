// SPDX-License-Identifier: MIT
//
// The walls around an agent, kept until it has come so far that one which it does not know could matter.

#include "base/min_max.h"
#include "nav_crowd/crowd.h"

#include <math.h>

// Metres that an agent goes before its walls are looked for anew, as a share of how far it must know them; and at
// least.
#define WALL_SLACK_SHARE 1.0f
#define MIN_SLACK        0.5f

void tl_crowd_look_for_walls(const crowd_step *step, uint32_t i, tl_nav_query *query)
{
    tl_nav_crowd *crowd = step->crowd;
    crowd_fields *a = &crowd->a;
    float *center = &a->wall_center[2 * (size_t)i];
    float dx = a->x[i] - center[0];
    float dz = a->z[i] - center[1];
    float slack = a->wall_slack[i];
    if (slack >= 0.0f && dx * dx + dz * dz <= slack * slack) {
        return;
    }
    // As far as it must know them: what it may reach, and the neighbours that they hide.
    const float reach = a->max_speed[i] * crowd->def.wall_horizon + a->clearance[i];
    const float more = tl_max_f32(WALL_SLACK_SHARE * reach, MIN_SLACK);
    const tl_nav_around_request request = { &crowd->filters[a->filter[i]],
                                            { a->path[(size_t)i * crowd->def.max_path], tl_crowd_position(crowd, i) },
                                            reach + more };
    tl_nav_wall_segment walls[CROWD_MAX_WALLS];
    uint32_t count = 0;
    tl_result result = tl_nav_query_find_walls(query, step->navmesh, &request, walls, CROWD_MAX_WALLS, &count);
    center[0] = a->x[i];
    center[1] = a->z[i];
    a->wall_slack[i] = more;
    if (result == TL_INCOMPLETE) {
        // Those left out are no nearer than the last one that is kept.
        a->wall_slack[i] = tl_max_f32(walls[CROWD_MAX_WALLS - 1].distance - reach, 0.0f);
    } else if (result != TL_OK) {
        a->wall_slack[i] = 0.0f; // with what was found, until it has moved
    }
    count = tl_min_u32(count, CROWD_MAX_WALLS);
    float *kept = &a->walls[(size_t)i * 4 * CROWD_MAX_WALLS];
    for (uint32_t k = 0; k < CROWD_MAX_WALLS; k++) {
        const bool is_there = k < count;
        kept[4 * k] = is_there ? walls[k].start.x : 0.0f;
        kept[4 * k + 1] = is_there ? walls[k].start.z : 0.0f;
        kept[4 * k + 2] = is_there ? walls[k].end.x : 0.0f;
        kept[4 * k + 3] = is_there ? walls[k].end.z : 0.0f;
    }
    a->wall_count[i] = (uint8_t)count;
}
