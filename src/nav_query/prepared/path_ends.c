// SPDX-License-Identifier: MIT
//
// The ends of a path over the visibility graph: of the corner vertices that see an end's polygon, those in whose cones
// it lies. Two cross products a cone tell, and a compiler makes several at once.

#include "nav_query/prepared/path_ends.h"

#include "nav_query/prepared/visibility_graph.h"
#include "nav_query/search/query_memory.h"

#include <math.h>

// A point on a polygon.
typedef struct spot {
    uint32_t slot, polygon;
    tl_vec3 point;
} spot;

static float leg_length(float x, float z, const tl_nav_corner_vertex *vertex)
{
    float to_x = x - vertex->x;
    float to_z = z - vertex->z;
    return sqrtf(to_x * to_x + to_z * to_z);
}

// Which of the cones from `base` on a point is in. Simple loops, which compilers make wide.
static void test_cones(const tl_nav_visibility_graph *graph, const tl_nav_corner_cones *cones, uint32_t base, float x,
                       float z, uint32_t is_in[TL_NAV_CONES_AT_ONCE])
{
    enum { N = TL_NAV_CONES_AT_ONCE };
    const uint32_t *words = cones->vertex + base;
    const int16_t *left_x = cones->left_x + base, *left_z = cones->left_z + base;
    const int16_t *right_x = cones->right_x + base, *right_z = cones->right_z + base;
    const float line = (float)(8.0 * TL_NAV_CONE_STEPS * graph->rounding);
    float dx[N], dz[N], least[N], left[N], right[N];
    for (uint32_t k = 0; k < N; k++) {
        const tl_nav_corner_vertex *vertex = &graph->vertices[words[k] & (TL_NAV_MAX_CORNER_VERTICES - 1)];
        dx[k] = x - vertex->x;
        dz[k] = z - vertex->z;
    }
    for (uint32_t k = 0; k < N; k++) {
        least[k] = -(tl_nav_cone_slack(words[k]) * (fabsf(dx[k]) + fabsf(dz[k])) + line);
    }
    for (uint32_t k = 0; k < N; k++) {
        left[k] = (float)left_x[k] * dz[k] - (float)left_z[k] * dx[k];
    }
    for (uint32_t k = 0; k < N; k++) {
        right[k] = (float)right_x[k] * dz[k] - (float)right_z[k] * dx[k];
    }
    for (uint32_t k = 0; k < N; k++) {
        is_in[k] = (left[k] >= least[k] ? 1u : 0u) & (right[k] >= least[k] ? 1u : 0u);
    }
}

// The corner vertices in whose cones a point lies; `other` is the other end of the path. TL_NAV_NO_NODE: they are more
// than capacity.
static uint32_t vertices_in_cones(const tl_nav_visibility_graph *graph, const spot *at, tl_vec3 other,
                                  tl_nav_corner_leg *legs_out, uint32_t capacity)
{
    const tl_nav_corner_cones *cones = &graph->tiles[at->slot].cones;
    const uint32_t *first = cones->first + at->polygon;
    const float x = at->point.x;
    const float z = at->point.z;
    uint32_t count = 0;
    for (uint32_t base = first[0]; base < first[1]; base += TL_NAV_CONES_AT_ONCE) {
        uint32_t is_in[TL_NAV_CONES_AT_ONCE];
        test_cones(graph, cones, base, x, z, is_in);
        for (uint32_t k = 0; k < TL_NAV_CONES_AT_ONCE && base + k < first[1]; k++) {
            if (count == capacity) {
                return TL_NAV_NO_NODE;
            }
            legs_out[count].vertex = tl_nav_cone_vertex(cones, base + k);
            count += is_in[k];
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_corner_vertex *vertex = &graph->vertices[legs_out[i].vertex];
        legs_out[i].length = leg_length(x, z, vertex);
        legs_out[i].total = legs_out[i].length + leg_length(other.x, other.z, vertex);
    }
    return count;
}

bool tl_nav_find_ends(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph, tl_nav_ends *ends_out)
{
    const spot start = { search->start_slot, search->start_polygon, search->start };
    const spot goal = { search->goal_slot, search->goal_polygon, search->goal };
    uint32_t room = search->query->max_nodes;
    ends_out->starts = search->query->legs;
    ends_out->start_count = vertices_in_cones(graph, &start, search->goal, ends_out->starts, room);
    if (ends_out->start_count == TL_NAV_NO_NODE) {
        search->query->is_short = true;
        return false;
    }
    room -= ends_out->start_count;
    ends_out->goals = ends_out->starts + ends_out->start_count;
    ends_out->goal_count = vertices_in_cones(graph, &goal, search->start, ends_out->goals, room);
    search->query->is_short = search->query->is_short || ends_out->goal_count == TL_NAV_NO_NODE;
    return ends_out->goal_count != TL_NAV_NO_NODE;
}
