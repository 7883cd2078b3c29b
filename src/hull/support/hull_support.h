// SPDX-License-Identifier: MIT
//
// What the support query's parts share: the climb's blocks, the rings of large faces, and the ways to answer.
//
// All float estimates here are of edge vectors or of positions relative to the hull's own middle, never of world
// positions, so their error bounds scale with the hull and not with its distance from the origin.

#ifndef TALUS_SRC_HULL_SUPPORT_H
#define TALUS_SRC_HULL_SUPPORT_H

#include "base/arena.h"
#include "base/cpu.h"
#include "base/stage.h"

#include <talus/hull.h>

// Hulls up to this many vertices are scanned, larger ones start from the direction table: there both take equally long
// with AVX2; with SSE4.2 they do at 32. (bench_support)
#define TL_HULL_SCAN_LIMIT 48u

// Directions d with |x| + |y| + |z| between these need no scaling: no product of a component and an edge of a hull
// within TL_MAX_HULL_COORDINATE overflows, and underflow is covered by TL_SUPPORT_UNDERFLOW.
#define TL_SUPPORT_DIRECTION_MIN 9.5367432e-7f // 2^-20
#define TL_SUPPORT_DIRECTION_MAX 1048576.0f    // 2^20

// Each of at most 8 operations on a dot product may underflow by half of the smallest float: 8 * 2^-150 < 2^-145.
#define TL_SUPPORT_UNDERFLOW 2.2420775e-44f // 2^-145

#define TL_CLIMB_LANES       8u
#define TL_SCAN_PAIR         16u         // rows of more than eight vertices are padded to whole pairs of lanes
#define TL_CLIMB_MORE        0x80000000u // in the last link: not a neighbour, the rest of them is in that block

// Up to eight neighbours of a vertex: the vectors to them and which they are. Unused lanes repeat the first neighbour.
// Vertex v has block v; the rest of vertices with more than eight neighbours follows behind.
typedef struct tl_climb_block {
    float x[TL_CLIMB_LANES], y[TL_CLIMB_LANES], z[TL_CLIMB_LANES];
    uint32_t link[TL_CLIMB_LANES];
} tl_climb_block;

#define TL_TABLE_RING       0x80000000u // in a cell of the table: not a vertex, look in that ring
#define TL_TABLE_SHORT_RING 0x8000u     // the same in a cell of two bytes; ring and vertices are below it

// A large face: where a direction points in its plane tells the vertex, by cells of their own behind the table's. Or a
// cap (cap_ring.h), whose ring has levels.
typedef struct tl_face_ring {
    float u[3], v[3];           // axes of the plane, stretched by the face's extents
    uint32_t first, cell_count; // in the table; of a cap: of its outermost level, with TL_RING_OF_CAP
} tl_face_ring;

#define TL_RING_OF_CAP 0x80000000u

// Where a half-edge starts.
static inline tl_vec3 tl_hull_corner(const tl_hull *hull, uint32_t half_edge)
{
    return tl_hull_vertices(hull)[tl_hull_edge_origin(hull, half_edge)];
}

// Of a hull of more than TL_HULL_FEW vertices.
static inline const tl_hull_climb *tl_hull_climb_head(const tl_hull *hull)
{
    return (const tl_hull_climb *)(const void *)((const char *)hull + TL_HULL_CLIMB_OFFSET);
}

static inline const void *tl_hull_part(const tl_hull *hull, uint32_t part)
{
    return (const char *)hull + (uint64_t)part * TL_BLOB_ALIGNMENT;
}

static inline const tl_climb_block *tl_hull_blocks(const tl_hull *hull)
{
    return tl_hull_part(hull, tl_hull_climb_head(hull)->blocks);
}

static inline uint32_t tl_hull_source_bytes(const tl_hull *hull)
{
    return hull->flags & TL_HULL_SOURCE_BYTES;
}

// Whether sources can be so many bytes each.
static inline bool tl_hull_is_width(uint32_t bytes)
{
    return bytes == 0 || bytes == 1 || bytes == 2 || bytes == 4;
}

// Length of the scan's rows; 0: the hull is too large to be scanned.
static inline uint32_t tl_hull_scan_count(const tl_hull *hull)
{
    return hull->vertex_count <= TL_CLIMB_LANES       ? TL_CLIMB_LANES
           : hull->vertex_count <= TL_HULL_SCAN_LIMIT ? (hull->vertex_count + TL_SCAN_PAIR - 1) & ~(TL_SCAN_PAIR - 1)
                                                      : 0;
}

// float [3][scan_count]: x, y, z from the middle of the bounds.
static inline const float *tl_hull_scan_rows(const tl_hull *hull)
{
    const size_t few = sizeof *hull, more = TL_HULL_CLIMB_OFFSET + sizeof(tl_hull_climb);
    return (const float *)(const void *)((const char *)hull + (hull->vertex_count <= TL_HULL_FEW ? few : more));
}

static inline const tl_face_ring *tl_hull_rings(const tl_hull *hull)
{
    return tl_hull_part(hull, tl_hull_climb_head(hull)->rings);
}

// A cell of the direction table, or of the rings behind it.
static inline uint32_t tl_hull_table_cell(const tl_hull *hull, uint32_t cell)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    const void *table = tl_hull_part(hull, climb->table);
    if (climb->cell_bytes == sizeof(uint16_t)) {
        const uint32_t found = ((const uint16_t *)table)[cell];
        return found + (found & TL_TABLE_SHORT_RING) * (TL_TABLE_RING / TL_TABLE_SHORT_RING - 1);
    }
    return ((const uint32_t *)table)[cell];
}

// Instruction sets, ascending: the levels of base/cpu.h.
typedef enum tl_support_isa {
    TL_SUPPORT_SCALAR,
    TL_SUPPORT_VEC128,
    TL_SUPPORT_AVX2,
    TL_SUPPORT_ISA_COUNT
} tl_support_isa;

// Once per instruction set (support_query.inl): the whole query; the climb alone, from a vertex and for a direction in
// the range above, which needs no table; and the march along a row of the table (support_march.inl).
typedef uint32_t tl_hull_support_fn(const tl_hull *hull, float x, float y, float z, uint32_t hint);
typedef uint32_t tl_hull_march_fn(const tl_hull *hull, tl_vec3 from, tl_vec3 step, uint32_t count, uint32_t vertex,
                                  uint32_t *cells);

tl_hull_support_fn tl_hull_support_scalar, tl_hull_climb_scalar;
tl_hull_march_fn tl_hull_march_scalar;
#if TL_CPU_LEVELS >= 1
tl_hull_support_fn tl_hull_support_vec128, tl_hull_climb_vec128;
tl_hull_march_fn tl_hull_march_vec128;
#endif
#if TL_CPU_LEVELS >= 2
tl_hull_support_fn tl_hull_support_avx2, tl_hull_climb_avx2;
tl_hull_march_fn tl_hull_march_avx2;
#endif

typedef struct tl_support_kernel {
    tl_hull_support_fn *support, *climb;
    tl_hull_march_fn *march;
} tl_support_kernel;

// False where this machine or build lacks the instructions.
bool tl_support_kernel_for(tl_support_isa isa, tl_support_kernel *kernel_out);
// That of this machine.
tl_support_kernel tl_support_kernel_best(void);

// The query for directions out of the range above.
uint32_t tl_hull_support_unusual(const tl_hull *hull, float x, float y, float z, uint32_t hint);

// support_exact.c, for any direction.
// Climbs on the half-edges; where faces are merged, on the blocks.
uint32_t tl_hull_climb_exact(const tl_hull *hull, tl_vec3 direction, uint32_t vertex);
// The lowest of the farthest vertices among those whose bits are set; one is.
uint32_t tl_hull_decide_exact(const tl_hull *hull, float x, float y, float z, uint64_t candidates);

// direction_table.c; the look-up is in direction_table.h.
// Cells along a side for a hull of so many vertices.
uint32_t tl_hull_table_side(uint32_t vertex_count, bool has_rings);
// Cells of the table and of all rings.
uint64_t tl_hull_cell_count(const tl_hull_climb *climb);
// What directions are multiplied by; for a hull whose bounds and planes are there.
tl_vec3 tl_hull_table_scale(const tl_hull *hull);
// Fills the table of an otherwise finished hull.
struct tl_hull_caps;
tl_result tl_hull_fill_table(tl_hull *hull, const struct tl_hull_caps *caps, tl_arena *arena, tl_stage *stage);

// hull_layout.c
// Fills in what follows from V, F, 2 E and the flags, and for a hull of more than TL_HULL_FEW vertices from
// block_count, ring_count and ring_cells; the size of the whole. Of a smaller one `climb` becomes zero.
uint64_t tl_hull_lay_out(tl_hull *head, tl_hull_climb *climb);
// Bytes to a laid out hull's sources.
uint64_t tl_hull_sources_offset(const tl_hull *head);
// Bytes of its planes, with the infinite offsets behind short rows.
uint64_t tl_hull_plane_bytes(const tl_hull *head);
// Counts a face's ring, if a hull of so many vertices has one for it.
void tl_hull_count_ring(uint32_t vertex_count, uint32_t corners, tl_hull_climb *climb);
// Writes a block of the vectors from a vertex to its `count` <= 8 neighbours in `links`.
void tl_hull_fill_block(const tl_vec3 *vertices, uint32_t vertex, const uint32_t *links, uint32_t count,
                        tl_climb_block *block);
// Blocks of a vertex with so many neighbours.
uint32_t tl_hull_blocks_of(uint32_t degree);
tl_vec3 tl_hull_edge_vector(tl_vec3 from, tl_vec3 to);
// Row entry `index` of the scan: a vertex relative to the middle of the bounds; beyond V the last vertex again.
tl_vec3 tl_hull_scan_point(const tl_hull *hull, uint32_t index);
float tl_hull_scan_error(const tl_hull *hull);

#endif
