// SPDX-License-Identifier: MIT
//
// Places along the borders of a navmesh, and candidates for links from there.

#ifndef TALUS_SRC_NAV_LINKS_LEDGES_H
#define TALUS_SRC_NAV_LINKS_LEDGES_H

#include "base/stage.h"
#include "nav_links/trajectory.h"

/// A place on a border edge.
typedef struct tl_nav_ledge_point {
    tl_nav_ref polygon;
    tl_vec3 point;    ///< on the surface
    tl_vec3 out;      ///< unit, in the plane, away from the polygon
    float off_middle; ///< metres from the middle of its edge
} tl_nav_ledge_point;

/// Places evenly along all border edges, at most `spacing` apart. Writes the first `capacity`. `*count_out`: the true
/// count, `*edge_count_out`: border edges. Calls progress and adds nothing to it. TL_ERR_LIMIT: more than
/// TL_NAV_LINKS_MAX_PLACES, or four times as many along the edges that may be borders in part. TL_ERR_CANCELLED.
tl_result tl_nav_sample_ledges(const tl_navmesh *navmesh, float spacing, tl_stage *stage, tl_nav_ledge_point *points,
                               uint64_t capacity, uint64_t *count_out, uint64_t *edge_count_out);

/// Candidates that start at one place: one down, and a jump in each of three directions.
#define TL_NAV_CANDIDATES_PER_PLACE 4u

typedef enum tl_nav_candidate_fate {
    TL_NAV_CANDIDATE_NO_LANDING, ///< nothing to land on
    TL_NAV_CANDIDATE_TOO_FAST,
    TL_NAV_CANDIDATE_BLOCKED,
    TL_NAV_CANDIDATE_FREE
} tl_nav_candidate_fate;

typedef struct tl_nav_link_candidate {
    tl_nav_jump_link link;
    float cost; ///< metres, straight from start to end
    float rank; ///< candidates of lower rank are selected first
    tl_nav_candidate_fate fate;
} tl_nav_link_candidate;

/// What all candidates share.
typedef struct tl_nav_landing_search {
    const tl_nav_links_def *def;
    const tl_navmesh *navmesh;
    tl_nav_walker walker;
    float radius, lift; ///< of the agent
    float cell;
    float reach; ///< metres: a jump is no longer, by the def and by the size of the navmesh
} tl_nav_landing_search;

/// Finds where links from a place may land, and proves them.
void tl_nav_find_candidates(const tl_nav_landing_search *search, const tl_nav_ledge_point *place,
                            tl_nav_link_candidate candidates[TL_NAV_CANDIDATES_PER_PLACE]);

#endif
