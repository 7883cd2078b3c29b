// SPDX-License-Identifier: MIT
//
// The editable half-edge mesh: vertices, half-edges and polygon faces that can be added and removed at any time in any
// order, with all neighbours at hand.
//
// A face is a loop of half-edges with the face to the left. Every edge is a pair of half-edges, 2k and 2k + 1, and has
// a face on at least one side; the half-edge on a side without a face is a boundary half-edge, and these are linked in
// loops around the holes. So the ring around any vertex, on a boundary or not, meets each of its edges once. A vertex
// may join several fans of faces as long as none of them is closed.
// Sources: Allen Chou, Game Physics: Implementing Support Function for Polyhedrons using Half Edges, 2013; the linked
// boundaries by Botsch, Steinberg, Bischoff, Kobbelt, OpenMesh, 2002.

#ifndef TALUS_HALFEDGE_H
#define TALUS_HALFEDGE_H

#include <talus/base.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// "None" for every kind of index here.
#define TL_HALFEDGE_NONE UINT32_MAX

/// Marks a pool entry in use.
#define TL_HALFEDGE_LIVE (UINT32_MAX - 1u)

/// No pool grows beyond this many entries.
#define TL_MAX_HALFEDGE_ENTRIES 0x7ffffffeu

/// A vertex of the pool.
typedef struct tl_halfedge_vertex {
    tl_vec3 position; ///< may be written at any time
    uint32_t edge;    ///< a half-edge that starts here, or TL_HALFEDGE_NONE
    uint32_t link;    ///< TL_HALFEDGE_LIVE, else the next free entry
    uint32_t mark;    ///< private scratch
} tl_halfedge_vertex;

/// A half-edge of the pool. Its twin is the entry with the lowest bit of the index flipped.
typedef struct tl_halfedge_edge {
    uint32_t vertex; ///< where it points to; TL_HALFEDGE_NONE when the entry is free
    uint32_t face;   ///< to its left, or TL_HALFEDGE_NONE on the boundary
    uint32_t next;   ///< in the loop of its face or hole; the next free pair when the entry is free
    uint32_t prev;   ///< in the same loop
} tl_halfedge_edge;

/// A face of the pool.
typedef struct tl_halfedge_face {
    uint32_t edge; ///< one of its half-edges
    uint32_t link; ///< TL_HALFEDGE_LIVE, else the next free entry
} tl_halfedge_face;

/// The mesh. Read the fields freely, change them through the functions only. An index stays valid until its element is
/// removed; then it is given to a new one. Not thread safe while it is changed.
typedef struct tl_halfedge_mesh {
    tl_halfedge_vertex *vertices;                           ///< [vertex_end], live and free ones
    tl_halfedge_edge *edges;                                ///< [edge_end]
    tl_halfedge_face *faces;                                ///< [face_end]
    uint32_t vertex_end, edge_end, face_end;                ///< entries ever used: indices are below
    uint32_t vertex_count;                                  ///< live ones
    uint32_t half_edge_count;                               ///< live ones, two an edge
    uint32_t face_count;                                    ///< live ones
    uint32_t boundary_count;                                ///< edges with one face only
    uint32_t vertex_capacity, edge_capacity, face_capacity; ///< private
    uint32_t free_vertex, free_edge, free_face;             ///< private: heads of the free lists
    uint32_t stamp;                                         ///< private: the last value of tl_halfedge_vertex.mark
    tl_allocator allocator;                                 ///< private: what frees it
} tl_halfedge_mesh;

/// An empty mesh; takes no memory yet. `allocator` NULL: malloc. The mesh remembers it.
TL_API void tl_halfedge_mesh_init(tl_halfedge_mesh *mesh, const tl_allocator *allocator);

/// Gives all memory back; the mesh is as after tl_halfedge_mesh_init. NULL or zeroed: nothing happens.
TL_API void tl_halfedge_mesh_destroy(tl_halfedge_mesh *mesh);

/// Removes everything, keeps the memory.
TL_API void tl_halfedge_mesh_clear(tl_halfedge_mesh *mesh);

/// Adds a vertex. Amortized O(1). Errors: TL_ERR_ARGUMENT (NULL), TL_ERR_MEMORY, TL_ERR_LIMIT; the mesh is unchanged
/// then.
TL_API tl_result tl_halfedge_mesh_add_vertex(tl_halfedge_mesh *mesh, tl_vec3 position, uint32_t *vertex_out);

/// Removes a vertex and all its faces; the other vertices of these stay. O(sum of the faces' sizes).
/// TL_ERR_STALE: no such live vertex.
TL_API tl_result tl_halfedge_mesh_remove_vertex(tl_halfedge_mesh *mesh, uint32_t vertex);

/// Adds a face of `count` >= 3 vertices, counter-clockwise seen from outside.
///
/// Errors, the mesh unchanged: TL_ERR_ARGUMENT (fewer than 3, or NULL), TL_ERR_STALE (no such live vertex),
/// TL_ERR_DEGENERATE (a vertex twice), TL_ERR_WINDING (it runs along an edge in the same direction as the one face
/// there), TL_ERR_NON_MANIFOLD (an edge has two faces already, or a vertex would get a closed fan beside another fan),
/// TL_ERR_MEMORY, TL_ERR_LIMIT. `face_out` may be NULL.
/// O(sum of the vertices' degrees). The search for an edge walks around both of its ends at once, so a vertex of high
/// degree costs little where its neighbours have low degrees, unless the face touches it by the vertex only.
TL_API tl_result tl_halfedge_mesh_add_face(tl_halfedge_mesh *mesh, const uint32_t *vertices, uint32_t count,
                                           uint32_t *face_out);

/// tl_halfedge_mesh_add_face with three vertices.
TL_API tl_result tl_halfedge_mesh_add_triangle(tl_halfedge_mesh *mesh, uint32_t a, uint32_t b, uint32_t c,
                                               uint32_t *face_out);

/// Removes a face, and those of its edges that no other face has; vertices stay. O(size of the face).
/// TL_ERR_STALE: no such live face.
TL_API tl_result tl_halfedge_mesh_remove_face(tl_halfedge_mesh *mesh, uint32_t face);

/// The half-edge from one vertex to another, or TL_HALFEDGE_NONE; also for indices that are not live.
/// O(the smaller of the two degrees).
TL_API uint32_t tl_halfedge_mesh_find_edge(const tl_halfedge_mesh *mesh, uint32_t from, uint32_t to);

/// The half-edges that start at a vertex, clockwise seen from outside. Returns how many there are and writes those that
/// fit. 0 for a vertex that is isolated or not live.
TL_API uint32_t tl_halfedge_mesh_vertex_edges(const tl_halfedge_mesh *mesh, uint32_t vertex, uint32_t *edges_out,
                                              uint32_t capacity);

/// The vertices that share an edge with a vertex, in the order of its ring. Returns and writes like
/// tl_halfedge_mesh_vertex_edges.
TL_API uint32_t tl_halfedge_mesh_vertex_neighbours(const tl_halfedge_mesh *mesh, uint32_t vertex,
                                                   uint32_t *vertices_out, uint32_t capacity);

/// The faces at a vertex, in the order of its ring; gaps are left out. Returns and writes like
/// tl_halfedge_mesh_vertex_edges.
TL_API uint32_t tl_halfedge_mesh_vertex_faces(const tl_halfedge_mesh *mesh, uint32_t vertex, uint32_t *faces_out,
                                              uint32_t capacity);

/// The vertices of a face, in its order. Returns how many there are and writes those that fit; 0 when it is not live.
TL_API uint32_t tl_halfedge_mesh_face_vertices(const tl_halfedge_mesh *mesh, uint32_t face, uint32_t *vertices_out,
                                               uint32_t capacity);

/// The next boundary loop (hole): the lowest boundary half-edge that is >= `from` and the lowest one of its loop. Start
/// with 0, continue with the result + 1. TL_HALFEDGE_NONE when there is no more. All calls together take O(size of the
/// mesh), and O(L log L) for a loop of L half-edges.
TL_API uint32_t tl_halfedge_mesh_next_boundary_loop(const tl_halfedge_mesh *mesh, uint32_t from);

/// Whether every invariant holds: links, loops, rings, pools, free lists, counts. TL_ERR_CORRUPT if not, with the
/// vertex, half-edge, face or field in `report_out`, which may be NULL. O(size), and takes one array of marks from the
/// allocator: TL_ERR_MEMORY.
TL_API tl_result tl_halfedge_mesh_check(const tl_halfedge_mesh *mesh, tl_report *report_out);

/// The vertex of a closed convex mesh that is farthest along a direction, by hill climbing from `hint`: no vertex with
/// a face has a larger dot product, exactly decided. Which of several equal ones is not specified.
///
/// A hint that is isolated, removed or out of range is ignored. A mesh without faces is scanned; without vertices the
/// answer is TL_HALFEDGE_NONE. Vertices within flat faces and edges are allowed: where a climb ends among nothing but
/// equal ones, which may be the minimum, all vertices are scanned. On a mesh that is not convex the answer is a local
/// maximum. Thread safe while the mesh is not changed.
TL_API uint32_t tl_halfedge_mesh_support(const tl_halfedge_mesh *mesh, tl_vec3 direction, uint32_t hint);

/// Whether an index, which may be any number, names a live vertex.
static inline bool tl_halfedge_is_vertex(const tl_halfedge_mesh *mesh, uint32_t vertex)
{
    return vertex < mesh->vertex_end && mesh->vertices[vertex].link == TL_HALFEDGE_LIVE;
}

/// Whether an index names a live half-edge.
static inline bool tl_halfedge_is_edge(const tl_halfedge_mesh *mesh, uint32_t edge)
{
    return edge < mesh->edge_end && mesh->edges[edge].vertex != TL_HALFEDGE_NONE;
}

/// Whether an index names a live face.
static inline bool tl_halfedge_is_face(const tl_halfedge_mesh *mesh, uint32_t face)
{
    return face < mesh->face_end && mesh->faces[face].link == TL_HALFEDGE_LIVE;
}

/// The same edge in the other direction.
static inline uint32_t tl_halfedge_twin(uint32_t edge)
{
    return edge ^ 1u;
}

/// Where a half-edge points to.
static inline uint32_t tl_halfedge_target(const tl_halfedge_mesh *mesh, uint32_t edge)
{
    return mesh->edges[edge].vertex;
}

/// Where a half-edge starts.
static inline uint32_t tl_halfedge_origin(const tl_halfedge_mesh *mesh, uint32_t edge)
{
    return mesh->edges[edge ^ 1u].vertex;
}

/// The face to the left of a half-edge, TL_HALFEDGE_NONE on the boundary; that of its twin is the edge's other face.
static inline uint32_t tl_halfedge_left_face(const tl_halfedge_mesh *mesh, uint32_t edge)
{
    return mesh->edges[edge].face;
}

/// The next half-edge around the same face or hole.
static inline uint32_t tl_halfedge_next(const tl_halfedge_mesh *mesh, uint32_t edge)
{
    return mesh->edges[edge].next;
}

/// The half-edge before it around the same face or hole.
static inline uint32_t tl_halfedge_prev(const tl_halfedge_mesh *mesh, uint32_t edge)
{
    return mesh->edges[edge].prev;
}

/// The next half-edge that starts at the same vertex, clockwise; after the last the first.
static inline uint32_t tl_halfedge_around(const tl_halfedge_mesh *mesh, uint32_t edge)
{
    return mesh->edges[edge ^ 1u].next;
}

#ifdef __cplusplus
}
#endif

#endif
