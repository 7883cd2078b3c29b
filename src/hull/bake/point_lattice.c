// SPDX-License-Identifier: MIT
//
// Points on a coarse lattice, as grids, voxels, quantized models and subdivided boxes are: there a side test in double
// rounds nothing, so its sign needs no second opinion. Such clouds are full of points that lie exactly in a face's
// plane, which for other clouds is the costly case: a third of a grid's time went into proving zeros.

#include "hull/bake/quickhull.h"

#include "base/min_max.h"

// Coordinates are multiples of a unit, and fewer than R = 2^15 of them. Differences are at most 2 R units, the two
// products of a normal's component 4 R^2 each, the component 8 R^2, a term of a height 8 R^3, and their sum with the
// offset 48 R^3 < 2^51: whole numbers of units cubed that fit a double's 53 bits, in any order of summation. A float's
// unit is at least 2^-149 and at most 2^85, so its cube is neither too small nor too large for a double.
enum { LATTICE_BITS = 15 };

static bool is_whole_number(double units)
{
    return units == (double)(int32_t)units;
}

bool tl_quickhull_on_lattice(const tl_quickhull_point *points, uint32_t count, tl_vec3 reach)
{
    int exponent;
    (void)frexp((double)tl_maxf(reach.x, tl_maxf(reach.y, reach.z)), &exponent); // reach < 2^exponent
    const double units = ldexp(1.0, LATTICE_BITS - exponent);                    // in a metre
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 p = points[i].position;
        if (!is_whole_number((double)p.x * units) || !is_whole_number((double)p.y * units) ||
            !is_whole_number((double)p.z * units)) {
            return false; // nearly always the first point
        }
    }
    return true;
}
