// SPDX-License-Identifier: MIT
//
// Large random outlines that are simple but for bridges: stars, combs, spirals, and squares with holes, of any size.
// All run as outer contours do. Beside the regular families of polygon_shapes.h they have ears of every size in no
// order.

#ifndef TALUS_POLYGON_RANDOM_SHAPES_H
#define TALUS_POLYGON_RANDOM_SHAPES_H

#include "polygon_shapes.h"

/// Corners all around, at random distances from `least` * radius to radius.
static inline void shape_random_star(test_random *random, oracle_point *p, uint32_t n, double radius, double least)
{
    const double turn = 6.283185307179586 / n;
    for (uint32_t i = 0; i < n; i++) {
        const double at = radius * (least + (1.0 - least) * (double)test_random_unit(random));
        p[i].x = (int64_t)floor(at * cos(turn * i));
        p[i].z = (int64_t)floor(at * sin(turn * i));
    }
    shape_make_outer(p, n);
}

/// n even. Pointed teeth of random lengths on a bar, with notches of random depths between them.
static inline void shape_random_comb(test_random *random, oracle_point *p, uint32_t n, uint32_t length)
{
    for (uint32_t i = 0; i + 2 < n; i++) {
        const int64_t height = test_random_below(random, length);
        p[i].x = 4 * (int64_t)i;
        p[i].z = i % 2 == 0 ? 10 + height : 10 + 2 * (int64_t)length + height;
    }
    const oracle_point bar[2] = { { 4 * ((int64_t)n - 3), 0 }, { 0, 0 } };
    p[n - 2] = bar[0];
    p[n - 1] = bar[1];
    shape_make_outer(p, n);
}

/// n even, n >= 64. A corridor wound up, its walls rough: no two rings touch.
static inline void shape_random_spiral(test_random *random, oracle_point *p, uint32_t n, double radius)
{
    const uint32_t half = n / 2;
    const double rings = sqrt((double)half) / 4.0, ring = radius / (rings + 2.0);
    for (uint32_t i = 0; i < n; i++) {
        const double turns = rings * (i < half ? i : n - 1 - i) / half;
        const double wall = (i < half ? 0.0 : 0.5) + 0.35 * (double)test_random_unit(random);
        const double at = ring * (1.0 + turns + wall), angle = 6.283185307179586 * turns;
        p[i].x = (int64_t)floor(at * cos(angle));
        p[i].z = (int64_t)floor(at * sin(angle));
    }
    shape_make_outer(p, n);
}

/// A square with columns * rows holes of four random corners, bridged as those of shape_holes. Returns the number of
/// corners, 4 + rows * (2 + 6 * columns) - rows.
static inline uint32_t shape_random_holes(test_random *random, oracle_point *p, uint32_t columns, uint32_t rows)
{
    enum { SIDE = 1000 };
    const uint32_t n = shape_holes(p, columns, rows);
    for (uint32_t i = 0; i < n; i++) {
        p[i].x *= SIDE / 10;
        p[i].z *= SIDE / 10;
    }
    // Upper and lower corners stand alone; the left and right ones end bridges, and stay.
    for (uint32_t i = 0; i < n; i++) {
        const int64_t across = p[i].z % SIDE;
        if (p[i].x % SIDE == 0 && across != 0) {
            p[i].x += (int64_t)test_random_below(random, 200) - 100;
            p[i].z += (across < SIDE / 2 ? -1 : 1) * (int64_t)test_random_below(random, 150);
        }
    }
    return n;
}

#endif
