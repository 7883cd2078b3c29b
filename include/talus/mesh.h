// SPDX-License-Identifier: MIT
//
// Triangle meshes: a view of the caller's arrays, and the welded, cleaned mesh that all bakes start from.
//
//   tl_mesh_view --tl_mesh_bake (weld, clean)--> tl_mesh --tl_adjacency_bake--> tl_adjacency

#ifndef TALUS_MESH_H
#define TALUS_MESH_H

#include <talus/base.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// No triangle, where an index of one is expected.
#define TL_NO_TRIANGLE UINT32_MAX

/// Limits of one mesh: 2^31 - 1 vertices, and triangles such that 3 * triangle_count fits 32 bits.
#define TL_MAX_MESH_VERTICES  0x7fffffffu
#define TL_MAX_MESH_TRIANGLES 0x55555555u

/// A triangle list as the caller has it. Nothing is copied or owned.
typedef struct tl_mesh_view {
    const tl_vec3 *vertices; ///< [vertex_count] metres
    uint32_t vertex_count;
    const uint32_t *indices; ///< [3 * triangle_count] into vertices; counter-clockwise seen from the front
    uint32_t triangle_count;
    const uint16_t *materials; ///< [triangle_count], or NULL: all 0
} tl_mesh_view;

/// How a mesh is welded and cleaned.
typedef struct tl_mesh_def {
    /// Metres, >= 0. Each vertex in turn becomes the earliest kept vertex that is no farther away than this, or is kept
    /// itself, so none moves by more than the tolerance. 0: only equal positions are welded (-0 equals 0).
    float weld_tolerance;
    bool keep_duplicates; ///< keep triangles that repeat another one's three vertices in the same winding
    tl_host host;         ///< allocator, tasks, progress
    uint32_t cookie;      ///< private: set by tl_default_mesh_def
} tl_mesh_def;

/// A mesh of unique vertices and of triangles with area, each with its index in the input. Free with tl_mesh_free.
typedef struct tl_mesh {
    tl_vec3 *vertices; ///< [vertex_count] metres
    uint32_t vertex_count;
    uint32_t *indices; ///< [3 * triangle_count]
    uint32_t triangle_count;
    uint16_t *materials;        ///< [triangle_count], never NULL
    uint32_t *source_triangles; ///< [triangle_count] of the view that each came from, ascending
    tl_aabb bounds;             ///< of the vertices that triangles use
    void *block;                ///< private: all arrays
    size_t block_size;          ///< private: bytes
    tl_allocator allocator;     ///< private: what frees it
} tl_mesh;

/// What tl_mesh_bake did.
typedef struct tl_mesh_report {
    tl_report base;                ///< what failed, and where
    uint32_t welded_vertices;      ///< input vertices that became another one
    uint32_t unused_vertices;      ///< input vertices that no kept triangle uses
    uint32_t degenerate_triangles; ///< dropped: two equal corners, or no area in exact arithmetic
    uint32_t duplicate_triangles;  ///< dropped: same corners, same winding as an earlier one
} tl_mesh_report;

/// Welds equal positions only, drops duplicate triangles, uses malloc and one thread.
TL_API tl_mesh_def tl_default_mesh_def(void);

/// Welds and cleans a triangle list.
///
/// Triangles keep their order; vertices are ordered by first use. The result depends on nothing but the view and def.
/// Errors, each with the element's index in `report_out->base`: TL_ERR_EMPTY (no triangle left), TL_ERR_NOT_FINITE
/// (vertex), TL_ERR_RANGE (vertex beyond TL_MAX_COORDINATE), TL_ERR_INDEX (triangle), TL_ERR_LIMIT, TL_ERR_ARGUMENT,
/// TL_ERR_MEMORY, TL_ERR_CANCELLED. An unused vertex may hold anything. On failure `*mesh_out` is zeroed. `def` NULL:
/// defaults. `report_out` may be NULL. Free with tl_mesh_free.
TL_API tl_result tl_mesh_bake(const tl_mesh_view *view, const tl_mesh_def *def, tl_mesh *mesh_out,
                              tl_mesh_report *report_out);

/// Gives a mesh's memory back to the allocator of its def and zeroes it. NULL or zeroed: nothing happens.
TL_API void tl_mesh_free(tl_mesh *mesh);

/// A baked mesh as a view. Valid while the mesh lives.
TL_API tl_mesh_view tl_mesh_as_view(const tl_mesh *mesh);

/// Largest absolute coordinate that any bake accepts, metres: squares and cubes of differences stay far from overflow.
#define TL_MAX_COORDINATE 1e12f

/// Which triangle lies across each edge. Edge k of triangle i runs from its corner k to corner (k + 1) % 3.
typedef struct tl_adjacency {
    /// [3 * triangle_count]: 3 * neighbour + its edge, TL_EDGE_BORDER or TL_EDGE_NON_MANIFOLD.
    uint32_t *across;
    uint32_t triangle_count;     ///< of the view
    uint32_t border_edges;       ///< edges with one triangle
    uint32_t paired_edges;       ///< edges with two triangles of opposite direction
    uint32_t non_manifold_edges; ///< edges with more than two triangles, or two that run the same way
    tl_allocator allocator;      ///< private: what frees it
} tl_adjacency;

#define TL_EDGE_BORDER       UINT32_MAX        ///< no other triangle has the edge
#define TL_EDGE_NON_MANIFOLD (UINT32_MAX - 1u) ///< more than one has it, or one that runs the same way

/// Finds each triangle's neighbours. Two triangles are neighbours across an edge when exactly those two have it,
/// in opposite directions. O(triangles). Indices are trusted: give a tl_mesh, or a checked view. Errors:
/// TL_ERR_ARGUMENT (no indices), TL_ERR_LIMIT (over TL_MAX_MESH_TRIANGLES), TL_ERR_MEMORY, TL_ERR_CANCELLED;
/// `*adjacency_out` is zeroed then. `host` and `report_out` may be NULL. A collapsed edge (both ends the same vertex)
/// counts as non-manifold unless it stands alone. Free with tl_adjacency_free.
TL_API tl_result tl_adjacency_bake(const tl_mesh_view *view, const tl_host *host, tl_adjacency *adjacency_out,
                                   tl_report *report_out);

/// Gives the memory back to the host's allocator and zeroes the struct. NULL or zeroed: nothing happens.
TL_API void tl_adjacency_free(tl_adjacency *adjacency);

/// The triangle belongs to no closed part.
#define TL_NO_PART UINT32_MAX

/// The closed parts of a mesh: surfaces that enclose a space.
typedef struct tl_closed_parts {
    uint32_t *part_of;   ///< [triangle_count]: the closed part, numbered in the order of first triangles, or TL_NO_PART
    double *volumes;     ///< [part_count] cubic metres; negative for a part that faces inwards, such as a room
    uint32_t part_count; ///< closed ones
    uint32_t open_part_count; ///< parts with a border
    uint32_t triangle_count;  ///< of the view
    tl_allocator allocator;   ///< private: what frees it
} tl_closed_parts;

/// Finds which triangles belong to closed parts. An edge connects its triangles when as many of them run along it one
/// way as the other; a part, a connected component, is closed when its own triangles do so on every edge. So crates
/// side by side, whose touching faces share edges, are closed, and so is a crate that shares an edge with an open
/// floor. Corners are the same when their indices are: weld the mesh first. O(triangles). Indices are trusted. Errors:
/// TL_ERR_ARGUMENT (no indices), TL_ERR_LIMIT (over TL_MAX_MESH_TRIANGLES), TL_ERR_MEMORY, TL_ERR_CANCELLED;
/// `*parts_out` is zeroed then. `host` and `report_out` may be NULL. Free with tl_closed_parts_free.
TL_API tl_result tl_closed_parts_find(const tl_mesh_view *view, const tl_host *host, tl_closed_parts *parts_out,
                                      tl_report *report_out);

/// Gives the memory back to the host's allocator and zeroes the struct. NULL or zeroed: nothing happens.
TL_API void tl_closed_parts_free(tl_closed_parts *parts);

#ifdef __cplusplus
}
#endif

#endif
