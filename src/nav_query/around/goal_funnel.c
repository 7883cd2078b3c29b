// SPDX-License-Identifier: MIT
//
// Funnels of a goal tree: a corner, and the two points between which it is seen through the portals passed so far. The
// funnel algorithm keeps a chain of corners on either side; one point of each is enough to know when the next portal
// lies beside what is seen, and then the corner moves there. Source: Lee and Preparata, Euclidean Shortest Paths in the
// Presence of Rectilinear Barriers, 1984; Mononen's short form of it, with one point a side.

#include "nav_query/around/goal_tree.h"

#include <math.h>

// > 0: b points to the left of a.
static double turn(const float from[2], const float a[2], const float b[2])
{
    return ((double)a[1] - (double)from[1]) * ((double)b[0] - (double)from[0]) -
           ((double)a[0] - (double)from[0]) * ((double)b[1] - (double)from[1]);
}

static float funnel_distance(const float a[2], const float b[2])
{
    const float x = a[0] - b[0], z = a[1] - b[1];
    return sqrtf(x * x + z * z);
}

static void set_plane(float out[2], float x, float z)
{
    out[0] = x;
    out[1] = z;
}

void tl_nav_goal_funnel_open(tl_nav_goal_funnel *funnel, tl_vec3 corner, float cost)
{
    funnel->corner = corner;
    funnel->cost = cost;
    set_plane(funnel->left, corner.x, corner.z);
    set_plane(funnel->right, corner.x, corner.z);
}

static bool is_open(const tl_nav_goal_funnel *funnel)
{
    return funnel->left[0] == funnel->right[0] && funnel->left[1] == funnel->right[1] &&
           funnel->left[0] == funnel->corner.x && funnel->left[1] == funnel->corner.z;
}

// The point of a portal at t, of the way from its left end to its right one.
static void point_at(const tl_nav_goal_portal *portal, double t, float out[2])
{
    out[0] = (float)((double)portal->left.x + t * ((double)portal->right.x - (double)portal->left.x));
    out[1] = (float)((double)portal->left.z + t * ((double)portal->right.z - (double)portal->left.z));
}

// Where the line from `from` over `over` meets a portal's line, cut to the portal; `else_at`:
// where it does not.
static double meet_portal(const tl_nav_goal_portal *portal, const float from[2], const float over[2], double else_at)
{
    const float left[2] = { portal->left.x, portal->left.z }, right[2] = { portal->right.x, portal->right.z };
    const double at_left = turn(from, over, left), at_right = turn(from, over, right);
    const double t = at_left / (at_left - at_right);
    return t >= 0.0 && t <= 1.0 ? t : t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : else_at; // NaN: along its line
}

static bool is_at(const float at[2], tl_vec3 point)
{
    return at[0] == point.x && at[1] == point.z;
}

// Corners lie at the ends of portals: at one of two heights, the nearer of which is as good as any.
static void turn_at(tl_nav_goal_funnel *funnel, const float at[2], const tl_nav_goal_portal *portal, float unit)
{
    const float corner[2] = { funnel->corner.x, funnel->corner.z };
    const float y = is_at(at, portal->left)    ? portal->left.y
                    : is_at(at, portal->right) ? portal->right.y
                                               : funnel->corner.y;
    funnel->cost += unit * funnel_distance(corner, at);
    funnel->corner = tl_vec3_make(at[0], y, at[1]);
    set_plane(funnel->left, portal->left.x, portal->left.z);
    set_plane(funnel->right, portal->right.x, portal->right.z);
}

tl_nav_goal_funnel tl_nav_goal_funnel_pass(const tl_nav_goal_funnel *before, const tl_nav_goal_portal *portal,
                                           float unit)
{
    tl_nav_goal_funnel funnel = *before;
    const float corner[2] = { funnel.corner.x, funnel.corner.z };
    const float left[2] = { portal->left.x, portal->left.z }, right[2] = { portal->right.x, portal->right.z };
    if (is_open(&funnel)) {
        set_plane(funnel.left, left[0], left[1]);
        set_plane(funnel.right, right[0], right[1]);
    } else if (turn(corner, funnel.left, right) > 0.0) {
        turn_at(&funnel, before->left, portal, unit);
    } else if (turn(corner, funnel.right, left) < 0.0) {
        turn_at(&funnel, before->right, portal, unit);
    } else {
        // What is seen of the portal: its own ends, or where the lines of sight pass it.
        if (turn(corner, before->left, left) <= 0.0) {
            set_plane(funnel.left, left[0], left[1]);
        } else {
            point_at(portal, meet_portal(portal, corner, before->left, 0.0), funnel.left);
        }
        if (turn(corner, before->right, right) >= 0.0) {
            set_plane(funnel.right, right[0], right[1]);
        } else {
            point_at(portal, meet_portal(portal, corner, before->right, 1.0), funnel.right);
        }
    }
    return funnel;
}

// What a point heads for, and by what way round: the corner, or the funnel's side that hides it.
static const float *head_of(const tl_nav_goal_funnel *funnel, const float at[2], const float corner[2])
{
    if (!is_open(funnel)) {
        if (turn(corner, funnel->left, at) > 0.0) {
            return funnel->left;
        }
        if (turn(corner, funnel->right, at) < 0.0) {
            return funnel->right;
        }
    }
    return corner;
}

float tl_nav_goal_funnel_cost(const tl_nav_goal_funnel *funnel, const float at[2], float unit)
{
    const float corner[2] = { funnel->corner.x, funnel->corner.z };
    const float *head = head_of(funnel, at, corner);
    const float beyond = head == corner ? 0.0f : funnel_distance(head, corner);
    return funnel->cost + unit * (beyond + funnel_distance(at, head));
}

float tl_nav_goal_portal_cost(const tl_nav_goal_funnel *funnel, const tl_nav_goal_portal *portal, float unit)
{
    const float corner[2] = { funnel->corner.x, funnel->corner.z };
    const double from = meet_portal(portal, corner, funnel->left, 0.0);
    const double to = meet_portal(portal, corner, funnel->right, 1.0);
    const double x = (double)portal->right.x - (double)portal->left.x;
    const double z = (double)portal->right.z - (double)portal->left.z;
    const double along =
        x * ((double)corner[0] - (double)portal->left.x) + z * ((double)corner[1] - (double)portal->left.z);
    const double length_sq = x * x + z * z;
    double t = length_sq > 0.0 ? along / length_sq : 0.0;
    t = t < from ? from : t;
    t = t > to ? to : t;
    float nearest[2];
    point_at(portal, t, nearest);
    return funnel->cost + unit * funnel_distance(corner, nearest);
}

tl_vec3 tl_nav_goal_funnel_cross(const tl_nav_goal_funnel *funnel, const tl_nav_goal_portal *portal,
                                 const float from[2])
{
    const float corner[2] = { funnel->corner.x, funnel->corner.z };
    const float *head = head_of(funnel, from, corner);
    return tl_lerp(portal->left, portal->right, (float)meet_portal(portal, from, head, 0.5));
}

tl_nav_goal_portal tl_nav_goal_portal_of(const tl_nav_ring *ring, uint32_t i)
{
    const tl_vec3 *end = &ring->points[i + 1 < ring->count ? i + 1 : 0];
    const tl_nav_goal_portal portal = { *end, ring->points[i] };
    return portal;
}
