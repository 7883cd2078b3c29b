// SPDX-License-Identifier: MIT
//
// Sectors of directions from a corner vertex.
//
// A direction is told by its diamond angle, which turns left from 0 to 4 as an angle does from 0 to a full turn, but
// takes one division: a quarter of the rhombus |x| + |z| = 1 each.

#ifndef TALUS_SRC_NAV_QUERY_SECTOR_H
#define TALUS_SRC_NAV_QUERY_SECTOR_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#define TL_NAV_FULL_TURN 4.0

/// The directions from `from` leftwards, `width` of them.
typedef struct tl_nav_sector {
    double from;  ///< [0, 4)
    double width; ///< [0, 4]
} tl_nav_sector;

/// Not both 0.
static inline double tl_nav_diamond_angle(double x, double z)
{
    const double t = x / (fabs(x) + fabs(z));
    return z <= 0.0 ? 1.0 - t : 3.0 + t;
}

/// From 0 to below a full turn; `turn` is at most one off.
static inline double tl_nav_wrap_turn(double turn)
{
    turn = turn < 0.0 ? turn + TL_NAV_FULL_TURN : turn;
    return turn >= TL_NAV_FULL_TURN ? turn - TL_NAV_FULL_TURN : turn;
}

/// The direction of a diamond angle, |x| + |z| = 1.
static inline void tl_nav_diamond_direction(double angle, double *x_out, double *z_out)
{
    *x_out = angle < 2.0 ? 1.0 - angle : angle - 3.0;
    *z_out = angle < 2.0 ? fabs(*x_out) - 1.0 : 1.0 - fabs(*x_out);
}

/// From one direction leftwards to another, less than half a turn apart, and `margin` farther on both sides.
static inline tl_nav_sector tl_nav_sector_between(double right_x, double right_z, double left_x, double left_z,
                                                  double margin)
{
    double from = tl_nav_diamond_angle(right_x, right_z);
    double width = tl_nav_wrap_turn(tl_nav_diamond_angle(left_x, left_z) - from);
    if (width > 3.0) { // rounding has exchanged them
        from = tl_nav_wrap_turn(from + width);
        width = TL_NAV_FULL_TURN - width;
    }
    width = width + 2.0 * margin < TL_NAV_FULL_TURN ? width + 2.0 * margin : TL_NAV_FULL_TURN;
    const tl_nav_sector sector = { tl_nav_wrap_turn(from - margin), width };
    return sector;
}

/// The directions where a sector of less than half a turn begins and ends, of any length.
typedef struct tl_nav_sector_rays {
    double right_x, right_z, left_x, left_z;
} tl_nav_sector_rays;

static inline tl_nav_sector_rays tl_nav_rays_of_sector(const tl_nav_sector *sector)
{
    tl_nav_sector_rays rays;
    tl_nav_diamond_direction(sector->from, &rays.right_x, &rays.right_z);
    tl_nav_diamond_direction(tl_nav_wrap_turn(sector->from + sector->width), &rays.left_x, &rays.left_z);
    return rays;
}

/// Whether the second sector surely lies beside the first: all of it left of where that ends, or right of where it
/// begins, by more than `margin` (a cross product).
static inline bool tl_nav_are_rays_apart(const tl_nav_sector_rays *a, const tl_nav_sector_rays *b, double margin)
{
    return (a->left_x * b->right_z - a->left_z * b->right_x < -margin &&
            a->left_x * b->left_z - a->left_z * b->left_x < -margin) ||
           (a->right_x * b->right_z - a->right_z * b->right_x > margin &&
            a->right_x * b->left_z - a->right_z * b->left_x > margin);
}

/// Of two sectors that overlap: a direction within both.
static inline void tl_nav_shared_direction(const tl_nav_sector_rays *a, const tl_nav_sector_rays *b, double *x_out,
                                           double *z_out)
{
    const bool begins_in_a = a->right_x * b->right_z - a->right_z * b->right_x < 0.0;
    const bool ends_in_a = a->left_x * b->left_z - a->left_z * b->left_x > 0.0;
    const double right_x = begins_in_a ? b->right_x : a->right_x, right_z = begins_in_a ? b->right_z : a->right_z;
    const double left_x = ends_in_a ? b->left_x : a->left_x, left_z = ends_in_a ? b->left_z : a->left_z;
    const double right = fabs(right_x) + fabs(right_z), left = fabs(left_x) + fabs(left_z);
    *x_out = right_x / right + left_x / left;
    *z_out = right_z / right + left_z / left;
}

static inline bool tl_nav_sectors_overlap(const tl_nav_sector *a, const tl_nav_sector *b)
{
    const double on = tl_nav_wrap_turn(b->from - a->from);
    return on <= a->width || TL_NAV_FULL_TURN - on <= b->width;
}

static inline bool tl_nav_holds_sector(const tl_nav_sector *a, const tl_nav_sector *b)
{
    return a->width >= TL_NAV_FULL_TURN || tl_nav_wrap_turn(b->from - a->from) + b->width <= a->width;
}

/// Of two that overlap: the middle of a part that they share.
static inline double tl_nav_middle_of_both(const tl_nav_sector *a, const tl_nav_sector *b)
{
    const double on = tl_nav_wrap_turn(b->from - a->from);
    const bool begins_in_a = on <= a->width;
    const double begin = begins_in_a ? on : 0.0;
    const double b_end = begins_in_a ? on + b->width : on + b->width - TL_NAV_FULL_TURN;
    const double end = b_end < a->width ? b_end : a->width;
    return tl_nav_wrap_turn(a->from + 0.5 * (begin + end));
}

/// Of two that overlap: all of both.
static inline tl_nav_sector tl_nav_unite_sectors(const tl_nav_sector *a, const tl_nav_sector *b)
{
    const double on = tl_nav_wrap_turn(b->from - a->from);
    const bool begins_in_a = on <= a->width;
    const tl_nav_sector *first = begins_in_a ? a : b, *second = begins_in_a ? b : a;
    const double end = tl_nav_wrap_turn(second->from - first->from) + second->width;
    const double width = end > first->width ? end : first->width;
    const tl_nav_sector both = { first->from, width < TL_NAV_FULL_TURN ? width : TL_NAV_FULL_TURN };
    return both;
}

#endif
