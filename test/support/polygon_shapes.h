// SPDX-License-Identifier: MIT
//
// Outlines for tests and benchmarks of convex polygon generation: random ones of several kinds, and the hard families.
// All run as outer contours do (a convex corner has area2 < 0).

#ifndef TALUS_POLYGON_SHAPES_H
#define TALUS_POLYGON_SHAPES_H

#include "polygon_oracle.h"

#include <talus/polygon.h>

/// Doubles that make integer coordinates on circles; tests only.
#include <math.h>

static inline void shape_make_outer(oracle_point *p, uint32_t n)
{
    if (oracle_contour_area2(p, n) < 0) {
        for (uint32_t i = 0; i < n / 2; i++) {
            oracle_point t = p[i];
            p[i] = p[n - 1 - i];
            p[n - 1 - i] = t;
        }
    }
}

static inline void shape_random_points(test_random *random, oracle_point *p, uint32_t n, uint32_t side)
{
    for (uint32_t i = 0; i < n; i++) {
        p[i].x = test_random_below(random, side);
        p[i].z = test_random_below(random, side);
    }
}

/// Random points in random order, untangled by reversing the run between two crossing edges. False: not simple (points
/// that coincide or lie on edges).
static inline bool shape_untangled(test_random *random, oracle_point *p, uint32_t n, uint32_t side)
{
    shape_random_points(random, p, n, side);
    for (uint32_t round = 0; round < 40 * n; round++) {
        bool crossed = false;
        for (uint32_t i = 0; i < n && !crossed; i++) {
            for (uint32_t j = i + 2; j < n && !crossed; j++) {
                if ((j + 1) % n != i && oracle_segments_meet(p[i], p[i + 1], p[j], p[(j + 1) % n])) {
                    for (uint32_t low = i + 1, high = j; low < high; low++, high--) {
                        oracle_point t = p[low];
                        p[low] = p[high];
                        p[high] = t;
                    }
                    crossed = true;
                }
            }
        }
        if (!crossed) {
            break;
        }
    }
    shape_make_outer(p, n);
    return oracle_is_simple(p, n);
}

/// The outline of a random pile of cells, one corner each lattice point: straight runs, and places where cells meet
/// corner to corner. Holes are filled. Returns the number of corners, 0 when they exceed `capacity`.
static inline uint32_t shape_cells(test_random *random, uint32_t side, uint32_t cells, oracle_point *p,
                                   uint32_t capacity)
{
    enum { MAX_SIDE = 64 };
    static uint8_t is_set[MAX_SIDE + 2][MAX_SIDE + 2];
    static uint8_t is_outside[MAX_SIDE + 2][MAX_SIDE + 2];
    memset(is_set, 0, sizeof is_set);
    memset(is_outside, 0, sizeof is_outside);
    side = side > MAX_SIDE ? MAX_SIDE : side;
    uint32_t x = 1 + side / 2, z = 1 + side / 2;
    for (uint32_t i = 0; i < cells; i++) {
        is_set[z][x] = 1;
        uint32_t step = test_random_below(random, 4);
        x = step == 0 && x > 1 ? x - 1 : step == 1 && x < side ? x + 1 : x;
        z = step == 2 && z > 1 ? z - 1 : step == 3 && z < side ? z + 1 : z;
    }
    // What the outside does not reach is filled.
    is_outside[0][0] = 1;
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t i = 0; i < side + 2; i++) {
            for (uint32_t j = 0; j < side + 2; j++) {
                bool reached = (i > 0 && is_outside[i - 1][j]) || (i <= side && is_outside[i + 1][j]) ||
                               (j > 0 && is_outside[i][j - 1]) || (j <= side && is_outside[i][j + 1]);
                if (!is_set[i][j] && !is_outside[i][j] && reached) {
                    is_outside[i][j] = 1;
                    changed = true;
                }
            }
        }
    }
    // Walk around with the pile on one hand, starting under its topmost row's first cell.
    uint32_t i = 0, j = 0;
    while (is_outside[i][j]) {
        j++;
        i += j > side + 1;
        j = j > side + 1 ? 0 : j;
    }
    static const int step_x[4] = { 1, 0, -1, 0 }, step_z[4] = { 0, 1, 0, -1 };
    int64_t start_x = j, start_z = i, at_x = start_x, at_z = start_z;
    uint32_t direction = 0, n = 0;
    do {
        if (n == capacity) {
            return 0;
        }
        p[n].x = at_x;
        p[n++].z = at_z;
        at_x += step_x[direction];
        at_z += step_z[direction];
        // The cells ahead, to the right and to the left of the direction.
        int64_t right_x = at_x - (direction == 1 || direction == 2),
                right_z = at_z - (direction == 2 || direction == 3);
        int64_t left_x = at_x - (direction == 2 || direction == 3), left_z = at_z - (direction == 3 || direction == 0);
        bool right = !is_outside[right_z][right_x], left = !is_outside[left_z][left_x];
        direction = left ? (direction + 3) % 4 : right ? direction : (direction + 1) % 4;
    } while (at_x != start_x || at_z != start_z || direction != 0);
    shape_make_outer(p, n);
    return n;
}

/// n even. Points on two circles in turn.
static inline void shape_star(oracle_point *p, uint32_t n, double outer, double inner)
{
    for (uint32_t i = 0; i < n; i++) {
        double angle = 6.283185307179586 * i / n, radius = i % 2 != 0 ? inner : outer;
        p[i].x = (int64_t)floor(radius * cos(angle) + 0.5);
        p[i].z = (int64_t)floor(radius * sin(angle) + 0.5);
    }
    shape_make_outer(p, n);
}

/// n divisible by 4. Rectangular teeth on a bar.
static inline void shape_comb(oracle_point *p, uint32_t n, int64_t tooth)
{
    uint32_t teeth = n / 4;
    for (uint32_t i = 0; i < teeth; i++) {
        int64_t x = 4 * (int64_t)i;
        oracle_point corners[4] = { { x, 10 }, { x, 10 + tooth }, { x + 2, 10 + tooth }, { x + 2, 10 } };
        memcpy(p + 4 * (size_t)i, corners, sizeof corners);
    }
    p[0].z = 0;
    p[4 * (size_t)teeth - 1].z = 0;
    shape_make_outer(p, 4 * teeth);
}

/// n even. A corridor of width 2 wound up as a square spiral.
static inline void shape_spiral(oracle_point *p, uint32_t n)
{
    uint32_t half = n / 2;
    static const int step_x[4] = { 1, 0, -1, 0 }, step_z[4] = { 0, 1, 0, -1 };
    int64_t x = 0, z = 0;
    for (uint32_t i = 0; i < half; i++) {
        p[i].x = x;
        p[i].z = z;
        int64_t length = 8 * (1 + i / 2);
        x += step_x[i % 4] * length;
        z += step_z[i % 4] * length;
    }
    // The other side of the corridor, two cells to one hand: the corners of the spiral, moved along the diagonal.
    for (uint32_t i = 0; i < half; i++) {
        uint32_t k = half - 1 - i;
        int in = (int)((k + 3) % 4), out = (int)(k % 4);
        // Ends are cut off square.
        int64_t dx = (k > 0 ? -step_z[in] : -step_z[out]) + 0, dz = (k > 0 ? step_x[in] : step_x[out]) + 0;
        p[half + i].x = p[k].x + 2 * dx + (k > 0 && k + 1 < half ? -2 * (int64_t)step_z[out] : 0);
        p[half + i].z = p[k].z + 2 * dz + (k > 0 && k + 1 < half ? 2 * (int64_t)step_x[out] : 0);
    }
    shape_make_outer(p, n);
}

/// A square with columns * rows diamond holes, each row bridged to the left edge and the holes of a row to each other.
/// Returns the number of corners: 4 + rows * (2 + 6 * columns), which p must have room for.
static inline uint32_t shape_holes(oracle_point *p, uint32_t columns, uint32_t rows)
{
    uint32_t n = 0;
    int64_t width = 10 * (int64_t)columns + 10, height = 10 * (int64_t)rows + 10;
    oracle_point corners[3] = { { 0, 0 }, { width, 0 }, { width, height } };
    memcpy(p, corners, sizeof corners);
    n = 3;
    oracle_point last = { 0, height };
    p[n++] = last;
    for (uint32_t r = rows; r-- > 0;) {
        int64_t z = 10 * (int64_t)r + 10;
        oracle_point root = { 0, z };
        p[n++] = root;
        // Along the holes' upper sides (z + 3), and back along the lower ones.
        for (uint32_t c = 0; c < columns; c++) {
            int64_t x = 10 * (int64_t)c + 10;
            oracle_point upper[3] = { { x - 3, z }, { x, z + 3 }, { x + 3, z } };
            memcpy(p + n, upper, sizeof upper);
            n += 3;
        }
        for (uint32_t c = columns; c-- > 0;) {
            int64_t x = 10 * (int64_t)c + 10;
            oracle_point lower[2] = { { x, z - 3 }, { x - 3, z } };
            memcpy(p + n, lower, sizeof lower);
            n += 2;
            if (c > 0) {
                oracle_point right = { x - 7, z };
                p[n++] = right;
            }
        }
        p[n++] = root;
    }
    shape_make_outer(p, n);
    return n;
}

/// A contour set of one contour; `vertices` has room for n.
static inline tl_contour_set shape_as_set(const oracle_point *p, uint32_t n, tl_contour_vertex *vertices,
                                          tl_contour *contour)
{
    for (uint32_t i = 0; i < n; i++) {
        vertices[i].x = (int32_t)p[i].x;
        vertices[i].y = 0;
        vertices[i].z = (int32_t)p[i].z;
        vertices[i].flags = 0;
    }
    contour->first_vertex = 0;
    contour->vertex_count = n;
    contour->region = 1;
    contour->area = 63;
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = vertices;
    set.vertex_count = n;
    set.contours = contour;
    set.contour_count = 1;
    set.cell_size = 0.5f;
    set.cell_height = 0.25f;
    return set;
}

/// Fails with the validator's words when the mesh is not what its contours demand.
static inline void shape_check_mesh(const tl_polygon_mesh *mesh, const tl_contour_set *set)
{
    tl_polygon_check_report check;
    if (tl_polygon_mesh_check(mesh, set, NULL, &check) != TL_OK) {
        fail_msg("%s at %s %llu", tl_polygon_fault_text(check.first_fault), check.base.element,
                 (unsigned long long)check.base.element_index);
    }
}

/// Builds a mesh with every allocation failing in turn, until none does: each failure is TL_ERR_MEMORY, nothing leaks
/// and the mesh stays untouched. Returns how many builds it took, and one.
/// The def's allocator is replaced.
static inline uint64_t shape_check_failing_memory(const tl_contour_set *set, tl_polygon_def def)
{
    tl_result result = TL_ERR_MEMORY;
    uint64_t fail_at = 1;
    for (; result == TL_ERR_MEMORY; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        def.host.allocator = &allocator.allocator;
        tl_polygon_mesh mesh;
        memset(&mesh, 0, sizeof mesh);
        result = tl_polygon_mesh_bake(set, &def, &mesh, NULL);
        TEST_CHECK(allocator.live_blocks == (result == TL_OK ? 1 : 0));
        TEST_CHECK(result == TL_OK || mesh.block == NULL);
        if (result == TL_OK) {
            shape_check_mesh(&mesh, set);
        }
        tl_polygon_mesh_free(&mesh);
        TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
    }
    TEST_RESULT(result, TL_OK);
    return fail_at;
}

#endif
