// SPDX-License-Identifier: MIT
//
// Goal trees: the funnels of their entries, the search (goal_tree.c) and the paths (goal_path.c).

#ifndef TALUS_SRC_NAV_QUERY_GOAL_TREE_H
#define TALUS_SRC_NAV_QUERY_GOAL_TREE_H

#include "nav_query/navmesh/navmesh.h"

#include <talus/nav_around.h>

/// What is seen of a corner from beyond some portals. Left and right as seen from the corner, in x and z.
typedef struct tl_nav_goal_funnel {
    tl_vec3 corner;
    float cost; ///< from the corner to the goal
    float left[2], right[2];
} tl_nav_goal_funnel;

/// An edge, as seen from the polygon that is nearer to the goal.
typedef struct tl_nav_goal_portal {
    tl_vec3 left, right;
} tl_nav_goal_portal;

typedef struct tl_nav_goal_search {
    tl_nav_query *query;
    const tl_navmesh *navmesh;
    const tl_nav_filter *filter;
    tl_nav_goal_tree *tree; ///< its entries stand in the order of the query's nodes
    float unit;             ///< what a metre costs
    bool is_uniform;        ///< everywhere
    bool all_pass;          ///< the filter refuses nothing
    bool out_of_nodes, out_of_entries;
} tl_nav_goal_search;

/// A corner that is seen from everywhere around it.
void tl_nav_goal_funnel_open(tl_nav_goal_funnel *funnel, tl_vec3 corner, float cost);
/// The funnel beyond one more portal. `unit`: what a metre costs.
tl_nav_goal_funnel tl_nav_goal_funnel_pass(const tl_nav_goal_funnel *before, const tl_nav_goal_portal *portal,
                                           float unit);
/// What it costs from a point beyond a funnel's portals to the goal.
float tl_nav_goal_funnel_cost(const tl_nav_goal_funnel *funnel, const float at[2], float unit);
/// What it costs from the cheapest point of the last portal that a funnel goes through.
float tl_nav_goal_portal_cost(const tl_nav_goal_funnel *funnel, const tl_nav_goal_portal *portal, float unit);
/// Where the way from a point on passes a portal: the portal of the funnel that it is seen through last.
tl_vec3 tl_nav_goal_funnel_cross(const tl_nav_goal_funnel *funnel, const tl_nav_goal_portal *portal,
                                 const float from[2]);
/// The edge `i` of a ring, from within.
tl_nav_goal_portal tl_nav_goal_portal_of(const tl_nav_ring *ring, uint32_t i);
/// What a metre costs for a filter. TL_ERR_ARGUMENT: it is none.
tl_result tl_nav_goal_begin(const tl_nav_filter *filter, float *unit_out, bool *is_uniform_out);

static inline tl_nav_goal_funnel tl_nav_goal_funnel_of(const tl_nav_goal_entry *entry)
{
    const tl_nav_goal_funnel funnel = {
        entry->corner, entry->cost, { entry->left[0], entry->left[1] }, { entry->right[0], entry->right[1] }
    };
    return funnel;
}

#endif
