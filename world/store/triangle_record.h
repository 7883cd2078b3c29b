// SPDX-License-Identifier: MIT
//
// A triangle as the store keeps it: in a cell of a hierarchical grid, as floats from the cell's origin, which is
// double.
//
// Grid: cells of level k have an edge of 2^k times the store's cell size on x and z. A triangle goes, once, into the
// lowest level whose edge its extent does not exceed, so it overhangs its cell by one edge at most: the loose grid of
// Ulrich, Loose Octrees (Game Programming Gems, 2000). Cells that divide triangles, or list them several times, need
// more disk than the 40 bytes here, and a rule for what is the same triangle.
//
// Exactness: along each axis the cell is that of the corner nearest to 0 (0 itself when the triangle straddles it), and
// the origin is the cell's end nearest to 0, a multiple of a power of two. So a coordinate that is a float of the world
// loses nothing: the difference is a multiple of its last bit, and no larger than it. Doubles are rounded to 2^-24 of
// the cell, 4 micrometres in cells of 64 m, wherever in the world they are.

#ifndef TALUS_WORLD_TRIANGLE_RECORD_H
#define TALUS_WORLD_TRIANGLE_RECORD_H

#include <stdbool.h>
#include <stdint.h>

enum {
    TL_WORLD_RECORD_BYTES = 40, ///< nine floats a.x a.y a.z b.x ..., the area, three zeros
    TL_WORLD_MAX_LEVEL = 30
};

/// Cells along y are as high as this, metres, on every level.
#define TL_WORLD_CELL_HEIGHT 1024.0
/// No coordinate is larger, metres.
#define TL_WORLD_MAX_COORDINATE 1e12

/// Corners in metres, y up, and the area that floors on it get.
typedef struct tl_world_triangle {
    double corner[3][3];
    uint8_t area;
} tl_world_triangle;

typedef struct tl_world_cell {
    int32_t level, x, y, z;
} tl_world_cell;

/// How a triangle is taken.
typedef enum tl_world_taken {
    TL_WORLD_TAKEN,
    TL_WORLD_NO_AREA,    ///< two equal corners, or all in line, as tl_mesh_bake decides: it is dropped
    TL_WORLD_NOT_FINITE, ///< a coordinate is no number
    TL_WORLD_TOO_FAR     ///< beyond TL_WORLD_MAX_COORDINATE, or 2^30 cells from the origin
} tl_world_taken;

/// The cell of a triangle and its record in it. `cell_size`: metres, a power of two.
tl_world_taken tl_world_record_encode(const tl_world_triangle *triangle, double cell_size, tl_world_cell *cell_out,
                                      unsigned char record_out[TL_WORLD_RECORD_BYTES]);

/// Where a cell's floats count from, metres.
void tl_world_cell_origin(const tl_world_cell *cell, double cell_size, double origin_out[3]);

/// By level, z, x, y.
int tl_world_cell_compare(const tl_world_cell *a, const tl_world_cell *b);

#endif
