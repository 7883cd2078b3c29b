// SPDX-License-Identifier: MIT
//
// Landmarks: distances from a few far places to every corner vertex, which bound other distances from below (ALT).
//
// A landmark here is a set of places, and its distance that from the nearest of them. Along an edge it changes by no
// more than the edge is long (the triangle inequality), so the difference of two vertices' distances is a lower bound
// for the path between them. On a city the largest of 16 bounds is 5% below the truth where the straight line is 11%
// below, and a search looks at a third of the vertices; of 40, at a quarter.
//
// They are measured by mending/landmark_measure.c, and mended after an edit.
// Source: Goldberg and Harrelson, Computing the Shortest Path: A* Search Meets Graph Theory, 2005.

#include "nav_query/prepared/landmarks.h"

#include <math.h>

void tl_nav_bound_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_corner_leg *legs, uint32_t count,
                               tl_nav_landmark_bounds *bounds_out)
{
    for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
        bounds_out->upper[k] = INFINITY;
        bounds_out->lower[k] = -INFINITY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const float *landmarks = graph->landmarks[legs[i].vertex];
        for (uint32_t k = 0; k < TL_NAV_LANDMARKS; k++) {
            float up = landmarks[k] + legs[i].length;
            float down = landmarks[k] - legs[i].length;
            bounds_out->upper[k] = up < bounds_out->upper[k] ? up : bounds_out->upper[k];
            bounds_out->lower[k] = down > bounds_out->lower[k] ? down : bounds_out->lower[k];
        }
    }
}

float tl_nav_min_by_landmarks(const tl_nav_visibility_graph *graph, const tl_nav_landmark_bounds *end, uint32_t vertex)
{
    enum { LANDMARK_LANES = 8 };
    const float *landmarks = graph->landmarks[vertex];
    float bounds[LANDMARK_LANES];
    for (uint32_t k = 0; k < LANDMARK_LANES; k++) {
        bounds[k] = -INFINITY;
    }
    for (uint32_t first = 0; first < TL_NAV_LANDMARKS; first += LANDMARK_LANES) {
        for (uint32_t k = 0; k < LANDMARK_LANES; k++) {
            float down = landmarks[first + k] - end->lower[first + k];
            float up = end->upper[first + k] - landmarks[first + k];
            down = down > up ? down : up;
            bounds[k] = bounds[k] > down ? bounds[k] : down;
        }
    }
    for (uint32_t half = LANDMARK_LANES / 2; half > 0; half /= 2) {
        for (uint32_t k = 0; k < half; k++) {
            bounds[k] = bounds[k] > bounds[k + half] ? bounds[k] : bounds[k + half];
        }
    }
    return bounds[0] - graph->landmark_error;
}
