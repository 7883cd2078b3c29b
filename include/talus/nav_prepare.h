// SPDX-License-Identifier: MIT
//
// Preparing a navmesh whose tiles stay for a while: the visibility graph and distances for shortest paths.

#ifndef TALUS_NAV_PREPARE_H
#define TALUS_NAV_PREPARE_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

/// How much memory a prepared navmesh may take beside its visibility graph.
typedef struct tl_nav_prepare_def {
    /// Bytes for a table of the all-pairs shortest distances between corner vertices, 6 for each pair. Default 32 MiB,
    /// enough for 2,364 corner vertices; 0: no table.
    uint64_t table_bytes;
    /// What corner vertices see, landmarks and the table are found by these. NULL: by the calling thread. Memory comes
    /// from the navmesh's allocator, then from several threads at once. The outcome is the same for any number of
    /// workers.
    const tl_tasks *tasks;
    const tl_progress *progress; ///< stages "visibility graph", "landmarks", "distances"; NULL: not cancellable
    uint32_t cookie;             ///< set by tl_default_nav_prepare_def
} tl_nav_prepare_def;

TL_API tl_nav_prepare_def tl_default_nav_prepare_def(void);

/// How shortest paths are found.
typedef enum tl_nav_prepared_kind {
    TL_NAV_PREPARED_NONE,  ///< by a search over polygons: a seam leads to two floors at once
    TL_NAV_PREPARED_GRAPH, ///< by A* over the visibility graph: no table fits
    TL_NAV_PREPARED_TABLE  ///< by the table of distances, without a search
} tl_nav_prepared_kind;

/// A word for a kind: "none", "graph", "table".
TL_API const char *tl_nav_prepared_kind_name(tl_nav_prepared_kind kind);

/// What tl_navmesh_prepare baked. After an error only `base` says something.
typedef struct tl_nav_prepared {
    tl_report base; ///< peak_bytes is not measured
    tl_nav_prepared_kind kind;
    uint32_t corner_vertex_count; ///< vertices of the navmesh at which a shortest path may turn
    uint32_t edge_count;          ///< of the visibility graph, each counted from both ends
    uint32_t renewed_count;       ///< corner vertices that this call looked from: after an edit not all of them
    uint64_t bytes;               ///< held now, graph and table
    uint64_t table_bytes;         ///< that a table takes, or would take; UINT64_MAX: more than 65,535 corner vertices
} tl_nav_prepared;

/// Makes path searches fast: bakes the visibility graph of the corner vertices, at which shortest paths turn; and where
/// it fits the def, a table of the distances between all of them.
///
/// Answers stay the same: the shortest paths. The graph serves filters that pass every polygon at the same cost, while
/// there are no off-mesh links, and until a tile or link is added or removed; then searches are as before, until this
/// is called again. It then looks anew only from corner vertices that may see what changed, and leaves the rest alone.
/// Where a seam leads to two floors at once (a polygon is linked to two others over the same stretch)
/// there is no graph. NULL def: the default one. `prepared_out` (may be NULL) says what was baked. A navmesh that is
/// prepared already keeps its graph, and gets or loses the table as the def says. O(what all corner vertices
/// see), and a Dijkstra search from each of them for the table: 1 to 3 ms for levels of 100 to 200 polygons, 28 ms for
/// 300 corner vertices in the open; the graph alone 1 s and 29 MB for a city of 26,000 polygons. Changes the navmesh:
/// no query may run meanwhile. On failure the navmesh is not prepared: TL_ERR_MEMORY, TL_ERR_LIMIT, TL_ERR_CANCELLED;
/// or nothing is changed: TL_ERR_ARGUMENT.
TL_API tl_result tl_navmesh_prepare(tl_navmesh *navmesh, const tl_nav_prepare_def *def, tl_nav_prepared *prepared_out);
/// Whether searches use the visibility graph now.
TL_API bool tl_navmesh_is_prepared(const tl_navmesh *navmesh);

#ifdef __cplusplus
}
#endif

#endif
