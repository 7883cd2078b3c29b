// SPDX-License-Identifier: MIT
//
// Support by scan: all dot products of a small hull, four at a time; nothing is faster below some 48 vertices.
//
// The first pass keeps only the maximum, so it has no index to carry; the second compares the kept products with the
// maximum less twice their error bound. Nearly always one vertex remains; else the remaining ones are compared exactly.

#include "hull/support.h"

#include "hull/lanes.h"
#include "math/predicates.h"

uint32_t tl_hull_scan(const tl_hull *hull, tl_vec3 direction)
{
    _Alignas(64) float dots[TL_HULL_SCAN_LIMIT];
    const float *x = (const float *)(const void *)((const char *)hull + hull->scan);
    uint32_t count = hull->scan_count;
    const float *y = x + count, *z = y + count;
    tl_lanes dx = tl_lanes_all(direction.x), dy = tl_lanes_all(direction.y), dz = tl_lanes_all(direction.z);
    tl_lanes best = tl_lanes_all(-INFINITY);
    for (uint32_t i = 0; i < count; i += 4) {
        tl_lanes dot =
            tl_lanes_add(tl_lanes_add(tl_lanes_mul(dx, tl_lanes_load(x + i)), tl_lanes_mul(dy, tl_lanes_load(y + i))),
                         tl_lanes_mul(dz, tl_lanes_load(z + i)));
        tl_lanes_store(dots + i, dot);
        best = tl_lanes_max(best, dot);
    }
    tl_vec3 size = tl_abs(direction);
    float error = hull->scan_error * (size.x + size.y + size.z) + TL_SUPPORT_UNDERFLOW;
    tl_lanes threshold = tl_lanes_all(tl_lanes_largest(best) - 2.0f * error);
    uint64_t mask = 0;
    for (uint32_t i = 0; i < count; i += 4) {
        mask |= (uint64_t)tl_lanes_mask_ge(tl_lanes_load(dots + i), threshold) << i;
    }
    if (mask == 0) {
        return 0; // the direction is not finite
    }
    // The rows are padded with the last vertex, whose own bit is lower.
    uint32_t vertex = tl_lowest_bit(mask);
    mask &= mask - 1;
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    while (mask != 0) {
        uint32_t other = tl_lowest_bit(mask);
        mask &= mask - 1;
        if (other < hull->vertex_count && tl_compare_along(direction, vertices[other], vertices[vertex]) > 0) {
            vertex = other;
        }
    }
    return vertex;
}
