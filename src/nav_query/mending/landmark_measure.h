// SPDX-License-Identifier: MIT
//
// Landmarks of a visibility graph, and the distances from them (landmark_measure.c).

#ifndef TALUS_SRC_NAV_QUERY_LANDMARK_MEASURE_H
#define TALUS_SRC_NAV_QUERY_LANDMARK_MEASURE_H

#include "base/stage.h"
#include "math/tolerance.h"
#include "nav_query/prepared/visibility_graph.h"

/// Distances are kept so much shorter than they are.
#define TL_NAV_LANDMARK_SCALE (1.0 - TL_BOUND_SLACK)

/// Chooses landmarks and fills in the distances from them. TL_ERR_MEMORY, TL_ERR_CANCELLED.
tl_result tl_nav_measure_landmarks(const tl_allocator *allocator, tl_nav_visibility_graph *graph, tl_stage *stage);

#endif
