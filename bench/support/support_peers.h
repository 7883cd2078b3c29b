// SPDX-License-Identifier: MIT
//
// What tl_hull_support is measured beside: exhaustive scans in each instruction set, and hill climbing on half-edges as
// Allen Chou's article has it (Game Physics: Implementing Support Function for Polyhedrons using Half Edges, 2013).

#ifndef TALUS_BENCH_SUPPORT_PEERS_H
#define TALUS_BENCH_SUPPORT_PEERS_H

#include <talus/hull.h>

/// The half-edges of the article, field for field, so that its climb walks the memory that the article lays out.
typedef struct chou_vert {
    tl_vec3 position;
    int edge; ///< the first half-edge that leaves it
    int free_link;
    bool active;
} chou_vert;

typedef struct chou_edge {
    int vert; ///< it points to
    int face, next, prev, twin, free_link;
    bool active;
} chou_edge;

typedef struct peer_hull {
    const tl_hull *hull; ///< the caller's
    const tl_vec3 *vertices;
    uint32_t count;
    float *rows;     ///< x, y, z of all vertices, each row padded
    uint32_t padded; ///< length of a row: a multiple of 32
    chou_vert *chou_verts;
    chou_edge *chou_edges;
    uint32_t last; ///< answer; where a warm start begins
} peer_hull;

/// Makes what the peers need of a hull. False: out of memory.
bool peer_hull_make(peer_hull *peer, const tl_hull *hull);
void peer_hull_free(peer_hull *peer);

typedef uint32_t peer_support_fn(peer_hull *peer, tl_vec3 direction);

peer_support_fn peer_scan_scalar;
/// Source: Allen Chou, Game Physics: Implementing Support Function for Polyhedrons using Half Edges, 2013. Its index
/// slip is mended, or it would always answer 0; from the first vertex, and from the last answer.
peer_support_fn peer_chou_climb, peer_chou_climb_warm;

/// NULL where the machine or the compiler lacks the instructions.
peer_support_fn *peer_scan_sse2(void), *peer_scan_avx2(void), *peer_scan_avx512(void);

#endif
