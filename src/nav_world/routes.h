// SPDX-License-Identifier: MIT
//
// The inside of routes: gates, and a binary tree of places over them.
//
// A cell of the tree is a place, or two cells side by side. Its separator is the gates between these two; its rim is
// the gates that lead out of it. Gates are numbered by the cells whose separators they are in, children before parents,
// so the gates of a cell's separator are the first ones of both its children's rims.

#ifndef TALUS_SRC_NAV_WORLD_ROUTES_H
#define TALUS_SRC_NAV_WORLD_ROUTES_H

#include "nav_world/world.h"

#include <talus/nav_routes.h>

#define TL_ROUTE_NO_CELL UINT32_MAX

enum {
    TL_ROUTE_MAX_GATES = 1 << 28,
    TL_ROUTE_MAX_BLOCK = 16,
    TL_ROUTE_MAX_DEPTH = 66, ///< of cells: a place's number has 64 bits
};

/// A stretch of a seam that can be walked along in both places. Words of four bytes, as they stand in the chunk.
typedef struct tl_nav_gate {
    int32_t x, z;      ///< the place on its lower side, place 0; place 1 lies across
    uint32_t side;     ///< of place 0: 1 (z+) or 2 (x+)
    int32_t low, high; ///< lattice, low < high: along the side, in the place
    float height;      ///< metres, at its middle
    uint32_t layer[2]; ///< of the tiles at its middle, in place 0 and 1
    uint32_t polygon[2];
} tl_nav_gate;

typedef struct tl_route_cell {
    uint32_t parent; ///< TL_ROUTE_NO_CELL: the root
    uint32_t child[2];
    uint32_t first_place, place_count; ///< of tl_route_tree.places
    uint32_t first_gate, gate_count;   ///< its separator
    uint32_t first_rim, rim_count;     ///< of tl_route_tree.rims
    bool is_leaf, is_block, is_above;  ///< a place; the largest cell within a block; larger than a block
    /// Where its lengths begin, floats. base, of a leaf or a block: of all pairs of its rim, i < j, j outside (i
    /// varies first). upper, of all but leaves, and lower, of cells above blocks: for each gate of the separator those
    /// to all of the separator, then to all of the rim.
    uint64_t base, upper, lower;
    uint32_t chain; ///< gates of the separators and rims from here up to the root
} tl_route_cell;

/// A place that has gates.
typedef struct tl_route_place {
    uint64_t code; ///< its coordinates' bits, interleaved (Morton)
    int32_t x, z;
    uint32_t cell;
} tl_route_place;

typedef struct tl_route_tree {
    tl_allocator allocator;
    const tl_nav_gate *gates; ///< the caller's
    uint32_t gate_count;
    uint32_t block;         ///< places on a side of one
    tl_route_place *places; ///< by code
    uint32_t place_count;
    tl_route_cell *cells; ///< children before parents, the root last
    uint32_t cell_count;
    uint32_t *rims; ///< numbers of gates, rising in each cell
    uint64_t rim_count;
    uint64_t length_count;
    uint32_t longest_chain;
} tl_route_tree;

/// Builds the places and cells over gates in any order, without separators and rims. TL_ERR_MEMORY; the tree is freed
/// by tl_route_tree_free in any case.
tl_result tl_route_tree_begin(tl_route_tree *tree, const tl_allocator *allocator, const tl_nav_gate *gates,
                              uint32_t gate_count, uint32_t block);
/// Adds separators, rims, and where lengths begin. TL_ERR_CORRUPT: the gates are not in the order of the cells,
/// TL_ERR_LIMIT: more than 2^32 lengths; TL_ERR_MEMORY.
tl_result tl_route_tree_finish(tl_route_tree *tree);
void tl_route_tree_free(tl_route_tree *tree);
/// The smallest cell that holds both places of a gate, which must be in the tree.
uint32_t tl_route_cell_of_gate(const tl_route_tree *tree, const tl_nav_gate *gate);
/// The tree's place at (x, z), or UINT32_MAX.
uint32_t tl_route_find_place(const tl_route_tree *tree, int32_t x, int32_t z);
/// Where gate stands in the rim of a cell, or UINT32_MAX.
uint32_t tl_route_rim_index(const tl_route_tree *tree, const tl_route_cell *cell, uint32_t gate);

static inline bool tl_route_is_block_side(uint32_t block)
{
    return block > 0 && block <= TL_ROUTE_MAX_BLOCK && (block & (block - 1)) == 0;
}

/// A filter's function: passes the polygons of one place, the tile_x and tile_z that `user` points to.
bool tl_route_is_of_place(const tl_nav_tile *tile, uint32_t polygon, void *user);

static inline const uint32_t *tl_route_rim(const tl_route_tree *tree, const tl_route_cell *cell)
{
    return tree->rims + cell->first_rim;
}

/// The place across a gate, x and z.
static inline void tl_nav_gate_across(const tl_nav_gate *gate, int32_t out[2])
{
    out[0] = gate->x + (gate->side == 2);
    out[1] = gate->z + (gate->side == 1);
}

/// Index of the pair i < j in `base` lengths.
static inline uint64_t tl_route_pair(uint32_t i, uint32_t j)
{
    return i < j ? (uint64_t)j * (j - 1) / 2 + i : (uint64_t)i * (i - 1) / 2 + j;
}

/// How far a float may be off that a length in metres was rounded from, and the points that it lies between, for
/// coordinates of up to `reach` metres: four roundings of 2^-24 each.
static inline double tl_route_slack(double reach)
{
    return reach * 0x1p-22;
}

/// The float next to a length, no smaller and no larger than it.
static inline float tl_route_round_up(double length)
{
    const float rounded = (float)length;
    return (double)rounded < length ? nextafterf(rounded, INFINITY) : rounded;
}

static inline float tl_route_round_down(double length)
{
    const float rounded = (float)length;
    return (double)rounded > length ? nextafterf(rounded, 0.0f) : rounded;
}

/// The middle of a gate, metres from the corner of a place: x and z.
void tl_nav_gate_middle(const tl_nav_gate *gate, const tl_nav_world *world, int32_t from_x, int32_t from_z,
                        double out[2]);
/// The least distance in the plane from a point, metres of the file, to one of the gate.
double tl_nav_gate_distance_to(const tl_nav_gate *gate, const tl_nav_world *world, const double at[2]);
/// The least distance in the plane of two gates' points.
double tl_nav_gate_distance(const tl_nav_gate *a, const tl_nav_gate *b, const tl_nav_world *world);
static inline double tl_nav_gate_length(const tl_nav_gate *gate, const tl_nav_world *world)
{
    return ((double)gate->high - (double)gate->low) * (double)world->cell_size;
}

/// Fills upper and lower lengths of all cells from the base ones (routes_fronts.c). TL_ERR_MEMORY, TL_ERR_CANCELLED.
tl_result tl_route_fill_fronts(const tl_route_tree *tree, const tl_nav_world *world, const tl_host *host,
                               float *lengths);

typedef struct tl_nav_gate_list {
    tl_nav_gate *gates;
    uint32_t count;
    uint64_t capacity;
} tl_nav_gate_list;

/// Adds the gates on the sides z+ and x+ of a place, by side, then along it (routes_gates.c). The navmesh holds the
/// place, in its own frame, and those across these sides.
tl_result tl_nav_find_gates(const tl_allocator *allocator, const tl_navmesh *navmesh, int32_t x, int32_t z,
                            tl_nav_gate_list *list);

/// What a world knows of routes.
typedef struct tl_world_routes {
    tl_nav_routes *blob;
    tl_route_tree tree;
    const float *lengths;
} tl_world_routes;

/// A hash over the tiles of a file's index.
uint64_t tl_route_tiles_hash(const tl_pack_index *index);
/// Reads the ROUT chunk where the file has one, and holds it to the tiles.
tl_result tl_nav_world_open_routes(tl_nav_world *world, tl_report *report);
void tl_nav_world_close_routes(tl_nav_world *world);

static inline const tl_nav_gate *tl_nav_routes_gates(const tl_nav_routes *routes)
{
    return (const tl_nav_gate *)(const void *)(routes + 1);
}

static inline const float *tl_nav_routes_lengths(const tl_nav_routes *routes)
{
    return (const float *)(const void *)(tl_nav_routes_gates(routes) + routes->gate_count);
}

#endif
