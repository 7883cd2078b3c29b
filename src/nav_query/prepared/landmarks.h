// SPDX-License-Identifier: MIT
//
// Lower bounds of distances by landmarks: the ALT heuristic (landmarks.c).

#ifndef TALUS_SRC_NAV_QUERY_LANDMARKS_H
#define TALUS_SRC_NAV_QUERY_LANDMARKS_H

#include "nav_query/prepared/graph_reuse.h"

/// Chooses landmarks and fills in the graph's distances to them; or mends those of the graph before. TL_ERR_MEMORY.
tl_result tl_nav_find_landmarks(const tl_allocator *allocator, const tl_host *host, const tl_nav_graph_reuse *reuse,
                                tl_nav_visibility_graph *graph);

/// Bounds of the distances from an end of a path to the landmarks, by its legs.
typedef struct tl_nav_landmark_bounds {
    float upper[TL_NAV_LANDMARKS], lower[TL_NAV_LANDMARKS];
} tl_nav_landmark_bounds;

void tl_nav_bound_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_corner_leg *legs, uint32_t count,
                               tl_nav_landmark_bounds *bounds_out);
/// Metres from a corner vertex to that end, at least.
float tl_nav_min_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_landmark_bounds *end, uint32_t vertex);

#endif
