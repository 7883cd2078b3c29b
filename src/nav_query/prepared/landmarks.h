// SPDX-License-Identifier: MIT
//
// Lower bounds of distances by landmarks: the ALT heuristic (landmarks.c).

#ifndef TALUS_SRC_NAV_QUERY_LANDMARKS_H
#define TALUS_SRC_NAV_QUERY_LANDMARKS_H

#include "nav_query/prepared/path_ends.h"
#include "nav_query/prepared/visibility_graph.h"

/// Bounds of the distances from an end of a path to the landmarks, by its legs.
typedef struct tl_nav_landmark_bounds {
    float upper[TL_NAV_LANDMARKS], lower[TL_NAV_LANDMARKS];
} tl_nav_landmark_bounds;

void tl_nav_bound_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_corner_leg *legs, uint32_t count,
                               tl_nav_landmark_bounds *bounds_out);
/// Metres from a corner vertex to that end, at least.
float tl_nav_min_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_landmark_bounds *end, uint32_t vertex);

#endif
