// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_HALFEDGE_POOL_H
#define TALUS_SRC_HALFEDGE_POOL_H

#include <talus/halfedge.h>

// Reserves capacity for so many more faces and edges, so that taking them cannot fail.
tl_result tl_halfedge_reserve(tl_halfedge_mesh *mesh, uint32_t faces, uint32_t edges);
uint32_t tl_halfedge_take_face(tl_halfedge_mesh *mesh);
// A pair of half-edges; the first of the two. Neither has a face: both count as boundary until they get one.
uint32_t tl_halfedge_take_edge(tl_halfedge_mesh *mesh, uint32_t from, uint32_t to);
void tl_halfedge_give_vertex(tl_halfedge_mesh *mesh, uint32_t vertex);
void tl_halfedge_give_face(tl_halfedge_mesh *mesh, uint32_t face);
void tl_halfedge_give_edge(tl_halfedge_mesh *mesh, uint32_t edge);

static inline void tl_halfedge_join(tl_halfedge_mesh *mesh, uint32_t edge, uint32_t next)
{
    mesh->edges[edge].next = next;
    mesh->edges[next].prev = edge;
}

#endif
