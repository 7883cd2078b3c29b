// SPDX-License-Identifier: MIT
//
// The support query: the caller's hint first, then a scan of a small hull or a climb on a large one.
//
// Float arithmetic decides whenever its error bound allows; what it leaves open is settled exactly. So the answer is a
// true maximiser, and does not depend on the hint or on the way it was found.

#include "hull/direction_table.h"
#include "hull/support_climb.h"

#include "base/assert.h"

#include <string.h>

// 2^-exponent(size) as a double, for a float size > 0: exact, and never a denormal.
static double reciprocal_power(float size)
{
    double wide = (double)size;
    uint64_t bits;
    memcpy(&bits, &wide, sizeof bits);
    bits = (uint64_t)(2046u - (bits >> 52)) << 52;
    double result;
    memcpy(&result, &bits, sizeof result);
    return result;
}

static uint32_t support_in_range(const tl_hull *hull, tl_vec3 direction, uint32_t hint)
{
    tl_climber climber = tl_climber_make(direction);
    if (hint < hull->vertex_count) {
        uint32_t block = tl_hull_vertex_blocks(hull)[hint];
        if (tl_hull_climb_is_farthest(hull, &climber, block)) {
            return hint;
        }
    }
    if (hull->scan_count > 0) {
        return tl_hull_scan(hull, direction);
    }
    uint32_t block = tl_hull_table_block(hull, direction);
    uint32_t vertex = tl_hull_climb(hull, &climber, &block);
    return vertex != TL_NO_VERTEX ? vertex : tl_hull_climb_exact(hull, direction, tl_hull_block_vertices(hull)[block]);
}

static uint32_t support_out_of_range(const tl_hull *hull, tl_vec3 direction, float size, uint32_t hint)
{
    if (!(size > 0.0f) || !tl_is_finite(direction)) {
        return 0;
    }
    double scale = reciprocal_power(size);
    double x = (double)direction.x * scale, y = (double)direction.y * scale, z = (double)direction.z * scale;
    tl_vec3 scaled = tl_vec3_make((float)x, (float)y, (float)z);
    if ((double)scaled.x == x && (double)scaled.y == y && (double)scaled.z == z) {
        return support_in_range(hull, scaled, hint);
    }
    // Components too far apart for one float scale.
    return tl_hull_climb_exact(hull, direction, hint < hull->vertex_count ? hint : 0);
}

uint32_t tl_hull_support(const tl_hull *hull, tl_vec3 direction, uint32_t hint)
{
    tl_vec3 size = tl_abs(direction);
    float largest = tl_maxf(size.x, tl_maxf(size.y, size.z));
    if (largest >= TL_SUPPORT_DIRECTION_MIN && largest <= TL_SUPPORT_DIRECTION_MAX) {
        return support_in_range(hull, direction, hint);
    }
    return support_out_of_range(hull, direction, largest, hint);
}
