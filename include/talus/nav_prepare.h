// SPDX-License-Identifier: MIT
//
// Preparing a navmesh whose tiles stay for a while: what shortest paths ask for is found beforehand.

#ifndef TALUS_NAV_PREPARE_H
#define TALUS_NAV_PREPARE_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What a prepared navmesh may know, and how much memory that may take.
typedef struct tl_nav_prepare_def {
    /// Bytes that a table of the lengths between all bends may take; 6 for each pair of them. Default 32 MiB, which is
    /// enough for 2,364 bends; 0: no table.
    uint64_t table_bytes;
    /// Bytes that hub labels may take where a table is too large: for each bend the lengths to some hundred others.
    /// They cost time, on a city of 25,000 bends 20 s for 78 MB, and are given up when the bytes are used up.
    /// A query needs as many nodes as there are bends to use them. Default 0: none are made.
    uint64_t label_bytes;
} tl_nav_prepare_def;

TL_API tl_nav_prepare_def tl_default_nav_prepare_def(void);

/// What shortest paths are found by.
typedef enum tl_nav_prepared_kind {
    TL_NAV_PREPARED_NONE,  ///< the polygons: floors fork at a seam
    TL_NAV_PREPARED_ROADS, ///< a search over roads; a table is larger than it may be, and so are labels
    TL_NAV_PREPARED_TABLE, ///< a table of all lengths between bends; no search
    TL_NAV_PREPARED_LABELS ///< hub labels, by which all lengths between bends are known; no search
} tl_nav_prepared_kind;

/// A word for a kind: "none", "roads", "table", "labels".
TL_API const char *tl_nav_prepared_kind_name(tl_nav_prepared_kind kind);

/// What preparing made.
typedef struct tl_nav_prepared {
    tl_nav_prepared_kind kind;
    uint32_t bend_count;  ///< vertices at which a shortest path may turn
    uint32_t road_count;  ///< straight ways between them, counted from both ends
    uint64_t bytes;       ///< that are held now, table and labels among them
    uint64_t table_bytes; ///< that a table takes, or would take; UINT64_MAX: there are more bends than one can hold
} tl_nav_prepared;

/// Makes path searches fast: finds the bends, vertices at which shortest paths turn, and all straight ways ("roads")
/// between them; and where that fits, a table of the lengths between all bends, or hub labels.
///
/// Answers stay the same: the shortest paths. Roads serve where all polygons pass and cost the same, while there are no
/// off-mesh links, and until a tile or link is added or removed; then searches are as before until this is called
/// again. Where floors fork at a seam (a polygon is linked to two others over the same stretch) there are none. NULL
/// def: the default one. `prepared_out` (may be NULL) says what was made. A navmesh that is prepared already keeps its
/// roads, and gets or loses the table as the def says. O(what all bends see), and a Dijkstra over the roads a bend for
/// the table: 1 to 3 ms for levels of 100 to 200 polygons, 28 ms for one of 300 bends in the open; roads alone 0.8 s
/// and 42 MB for a city of 26,000 polygons. Changes the navmesh: no query may run meanwhile. On failure the navmesh is
/// not prepared, else nothing is changed: TL_ERR_MEMORY, TL_ERR_LIMIT.
TL_API tl_result tl_navmesh_prepare(tl_navmesh *navmesh, const tl_nav_prepare_def *def, tl_nav_prepared *prepared_out);
/// Whether searches use roads now.
TL_API bool tl_navmesh_is_prepared(const tl_navmesh *navmesh);

#ifdef __cplusplus
}
#endif

#endif
