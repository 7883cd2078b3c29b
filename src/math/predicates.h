// SPDX-License-Identifier: MIT
//
// Exact geometric predicates on float coordinates: the sign is right for every finite input, denormal and huge ones
// included. Each is a floating-point filter with a proven bound first, then exact expansion arithmetic (predicates.c).

#ifndef TALUS_SRC_MATH_PREDICATES_H
#define TALUS_SRC_MATH_PREDICATES_H

#include "base/exact_floats.h"

#include <talus/vec.h>

/// Sign of (b - a) x (c - a): 1 when a, b, c run counter-clockwise, -1 clockwise, 0 on one line.
/// Antisymmetric: to swap two points flips the sign.
int tl_orient2d(float ax, float ay, float bx, float by, float cx, float cy);

/// The value of (b - a) x (c - a), twice the signed area, with a relative error below 2^-45 and the right sign, however
/// thin the triangle is.
double tl_area2d(float ax, float ay, float bx, float by, float cx, float cy);

/// Sign of ((b - a) x (c - a)) . (d - a): 1 when d is in front of the triangle a, b, c (the side from which it runs
/// counter-clockwise), -1 behind, 0 in its plane. Antisymmetric: to swap two points flips the sign.
int tl_orient3d(tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d);

/// Sign of (direction x (a - origin)) . (b - origin): on which side of the directed edge a, b the line passes. A line
/// passes through a triangle when its three edges give no two opposite signs.
/// Antisymmetric in a and b, so two triangles that share an edge never both miss a line through it.
int tl_line_side(tl_vec3 origin, tl_vec3 direction, tl_vec3 a, tl_vec3 b);

/// ((b - a) x (c - a)) . (p - q), summed exactly and rounded to within two ulps; 0 only when it is 0. Slow: for values
/// whose sign or size a filter could not settle.
double tl_normal_dot(tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 p, tl_vec3 q);

/// Sign of direction . (p - q): 1 when p lies farther along the direction than q.
int tl_compare_along(tl_vec3 direction, tl_vec3 p, tl_vec3 q);

/// Whether three points lie on one line, coincident ones included: the triangle has no area.
bool tl_is_collinear(tl_vec3 a, tl_vec3 b, tl_vec3 c);

#endif
