// SPDX-License-Identifier: MIT
//
// From where in a polygon a path may go straight to a bend and turn there: wedges of sight, cut to the directions from
// which one comes with the bend's walls on the hand of the turn.
//
// What a bend sees through the edge by which sight enters a polygon is a cone. So are the directions that have both
// walls on one hand, and what is left of it is a cone again: two cross products say whether a point is in it. That
// leaves few bends for a point, where the polygon as a whole is seen by many and turned to from more. A cone is kept a
// little too wide by rounding; who takes a leg for one walks along it in the end.

#include "nav_query/roads.h"

#include "nav_query/wedge_sight.h"

#include <math.h>

typedef struct cone {
    tl_nav_direction right, left;
} cone;

// Leaves the part of a cone that lies left of a wall (hand 1) or right of it (-1). False: none does.
static bool cut(cone *c, tl_nav_direction wall, int hand, double rounding)
{
    double wall_size = fabs(wall.x) + fabs(wall.z);
    double left = hand * cross(wall, c->left);
    double right = hand * cross(wall, c->right);
    bool keeps_left = left <= 2.0 * rounding * (wall_size + fabs(c->left.x) + fabs(c->left.z));
    bool keeps_right = right <= 2.0 * rounding * (wall_size + fabs(c->right.x) + fabs(c->right.z));
    if (is_open(wall) || (keeps_left && keeps_right)) {
        return true;
    }
    if (!keeps_left && !keeps_right) {
        return false;
    }
    // The wall's line leaves the bend inside the cone, along the wall or away from it.
    bool is_along = cross(c->left, wall) >= cross(c->right, wall);
    tl_nav_direction end = { is_along ? wall.x : -wall.x, is_along ? wall.z : -wall.z };
    *(keeps_left ? &c->right : &c->left) = end;
    return true;
}

bool tl_nav_view_from(const tl_nav_wedge *wedge, const tl_nav_ring_walls *walls, int hand, double rounding,
                      tl_nav_view *view_out)
{
    const tl_nav_direction first = { (double)walls->first_x, (double)walls->first_z };
    const tl_nav_direction last = { (double)walls->last_x, (double)walls->last_z };
    cone c = { wedge->right, wedge->left };
    if (is_open(c.left) || is_open(c.right)) {
        // Beside the bend: between the walls, or one of them and where the other leads.
        const tl_nav_direction back = { -last.x, -last.z };
        c.right = hand > 0 ? first : back;
        c.left = hand > 0 ? back : first;
    } else if (!cut(&c, first, hand, rounding) || !cut(&c, last, hand, rounding)) {
        return false;
    }
    view_out->right_x = (float)c.right.x;
    view_out->right_z = (float)c.right.z;
    view_out->left_x = (float)c.left.x;
    view_out->left_z = (float)c.left.z;
    return true;
}

uint32_t tl_nav_bends_in_view(const tl_nav_roads *roads, uint32_t slot, uint32_t polygon, float x, float z,
                              tl_nav_stop *stops_out, uint32_t capacity)
{
    const uint32_t *first = roads->view_first + roads->slot_first[slot] + polygon;
    const float slack = 4.0f * (float)roads->rounding;
    uint32_t count = 0;
    for (uint32_t i = first[0]; i < first[1]; i++) {
        const tl_nav_view *view = &roads->views[i];
        const tl_nav_bend *bend = &roads->bends[view->bend];
        float to_x = x - bend->x;
        float to_z = z - bend->z;
        float size = fabsf(to_x) + fabsf(to_z);
        float left = view->left_x * to_z - view->left_z * to_x;
        float right = view->right_x * to_z - view->right_z * to_x;
        float left_size = fabsf(view->left_x) + fabsf(view->left_z);
        float right_size = fabsf(view->right_x) + fabsf(view->right_z);
        if (!((left >= -slack * (size + left_size)) & (right <= slack * (size + right_size)))) {
            continue;
        }
        if (count == capacity) {
            return TL_NAV_NO_NODE;
        }
        stops_out[count].cost = (double)sqrtf(to_x * to_x + to_z * to_z);
        stops_out[count].bend = view->bend;
        count++;
    }
    return count;
}
