// SPDX-License-Identifier: MIT
//
// Polygons to triangles by ear clipping, in doubles.
//
// Source: Meisters, Polygons Have Ears (1975); the normal is Newell's sum over edges (Sutherland et al., A
// Characterization of Ten Hidden-Surface Algorithms, 1974), which is right for concave and slightly bent polygons too.
// Most faces of a level are convex and become a fan after one look at each corner. A corner in the middle of a straight
// edge is common in levels (a wall that another one meets): a fan from beside it would begin with a triangle without
// area and leave a T-junction, so such polygons are clipped too. Corners are floats, so differences are exact in double
// for all but extreme ranges, and no tolerance is used.

#include "io/mesh/split_polygon.h"

// Bound on point-in-ear tests: each of the n - 3 ears looks at few candidates in all but made-up polygons.
enum { TESTS_PER_CORNER_PAIR = 8 };

// Twice the area of a, b, c: > 0 when they corner_turn left.
static double corner_turn(const tl_split_corner *a, const tl_split_corner *b, const tl_split_corner *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

// Puts the corners into the plane of the two axes along which the polygon is seen largest. False: it has no area.
static bool project_corners(const tl_vec3 *vertices, const uint32_t *corners, uint32_t count, tl_split_corner *ring)
{
    double nx = 0.0;
    double ny = 0.0;
    double nz = 0.0;
    tl_vec3 origin = vertices[corners[0]];
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 a = vertices[corners[i]];
        tl_vec3 b = vertices[corners[i + 1 < count ? i + 1 : 0]];
        // Relative to one corner, so that nothing is lost far from the origin.
        double ax = (double)a.x - (double)origin.x;
        double ay = (double)a.y - (double)origin.y;
        double az = (double)a.z - (double)origin.z;
        double bx = (double)b.x - (double)origin.x;
        double by = (double)b.y - (double)origin.y;
        double bz = (double)b.z - (double)origin.z;
        nx += ay * bz - az * by;
        ny += az * bx - ax * bz;
        nz += ax * by - ay * bx;
    }
    double size_x = fabs(nx);
    double size_y = fabs(ny);
    double size_z = fabs(nz);
    bool along_x = size_x >= size_y && size_x >= size_z;
    bool along_y = !along_x && size_y >= size_z;
    double sign = along_x ? nx : along_y ? ny : nz;
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 p = vertices[corners[i]];
        double x = (double)(along_x ? p.y : along_y ? p.z : p.x);
        double y = (double)(along_x ? p.z : along_y ? p.x : p.y);
        // Seen from the back the outline runs clockwise: mirrored, it runs counter-clockwise again.
        ring[i].x = sign < 0.0 ? -x : x;
        ring[i].y = y;
        ring[i].previous = i > 0 ? i - 1 : count - 1;
        ring[i].next = i + 1 < count ? i + 1 : 0;
    }
    return sign != 0.0;
}

// Whether every corner turns left or goes straight, and each triangle of the fan from the first one has area.
static bool is_fan(const tl_split_corner *ring, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (corner_turn(&ring[ring[i].previous], &ring[i], &ring[ring[i].next]) < 0.0) {
            return false;
        }
    }
    for (uint32_t i = 1; i + 1 < count; i++) {
        if (!(corner_turn(&ring[0], &ring[i], &ring[i + 1]) > 0.0)) {
            return false;
        }
    }
    return true;
}

static bool same_corner(const tl_split_corner *a, const tl_split_corner *b)
{
    return a->x == b->x && a->y == b->y;
}

// Whether no other corner lies in the closed triangle at `ear`. Only corners that are not convex can; those at the same
// place as one of the triangle's own (bridges to holes, doubled corners) are no obstacle.
static bool is_ear(const tl_split_corner *ring, uint32_t ear, uint64_t *tests)
{
    const tl_split_corner *b = &ring[ear];
    const tl_split_corner *a = &ring[b->previous];
    const tl_split_corner *c = &ring[b->next];
    if (!(corner_turn(a, b, c) > 0.0)) {
        return false;
    }
    for (uint32_t i = c->next; i != b->previous; i = ring[i].next) {
        const tl_split_corner *p = &ring[i];
        *tests += 1;
        if (p->blocks && corner_turn(a, b, p) >= 0.0 && corner_turn(b, c, p) >= 0.0 && corner_turn(c, a, p) >= 0.0 &&
            !same_corner(p, a) && !same_corner(p, b) && !same_corner(p, c)) {
            return false;
        }
    }
    return true;
}

static void update_blocks(tl_split_corner *ring, uint32_t i)
{
    ring[i].blocks = !(corner_turn(&ring[ring[i].previous], &ring[i], &ring[ring[i].next]) > 0.0);
}

// Takes corner i out of the ring.
static void unlink_corner(tl_split_corner *ring, uint32_t i)
{
    uint32_t previous = ring[i].previous;
    uint32_t next = ring[i].next;
    ring[previous].next = next;
    ring[next].previous = previous;
    update_blocks(ring, previous);
    update_blocks(ring, next);
}

// Clips ears until nothing is left. False when it gave up: `triangles` is spoilt then.
static bool clip_ears(tl_split_corner *ring, const uint32_t *corners, uint32_t count, uint32_t *triangles)
{
    uint64_t tests = 0;
    uint64_t max_tests = (uint64_t)TESTS_PER_CORNER_PAIR * count * count;
    uint32_t at = 0;
    uint32_t failed = 0;
    for (uint32_t left = count; left > 2;) {
        // The last triangle is what it is. Corners in line are left for the end, when nothing else can be clipped.
        bool straight = failed >= left && corner_turn(&ring[ring[at].previous], &ring[at], &ring[ring[at].next]) == 0.0;
        if (left > 3 && !straight && !is_ear(ring, at, &tests)) {
            at = ring[at].next;
            failed++;
            if (failed >= 2 * left || tests > max_tests) {
                return false;
            }
            continue;
        }
        *triangles++ = corners[ring[at].previous];
        *triangles++ = corners[at];
        *triangles++ = corners[ring[at].next];
        uint32_t next = ring[at].next;
        unlink_corner(ring, at);
        // Stepping over the next corner spreads the ears around the outline: fewer slivers than a fan.
        at = ring[next].next;
        failed = 0;
        left--;
    }
    return true;
}

static void split_into_fan(const uint32_t *corners, uint32_t count, uint32_t *triangles)
{
    for (uint32_t i = 1; i + 1 < count; i++) {
        *triangles++ = corners[0];
        *triangles++ = corners[i];
        *triangles++ = corners[i + 1];
    }
}

tl_split tl_split_polygon(const tl_vec3 *vertices, const uint32_t *corners, uint32_t count, tl_split_corner *scratch,
                          uint32_t *triangles)
{
    if (count > TL_MAX_SPLIT_CORNERS) {
        return TL_SPLIT_GAVE_UP;
    }
    if (!project_corners(vertices, corners, count, scratch) || is_fan(scratch, count)) {
        return TL_SPLIT_FAN;
    }
    for (uint32_t i = 0; i < count; i++) {
        update_blocks(scratch, i);
    }
    if (!clip_ears(scratch, corners, count, triangles)) {
        split_into_fan(corners, count, triangles);
        return TL_SPLIT_GAVE_UP;
    }
    return TL_SPLIT_EARS;
}
