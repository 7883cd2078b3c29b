// SPDX-License-Identifier: MIT
//
// Sight on a navmesh: which polygons see one another (a potentially visible set, PVS), and where to take cover.
//
// Places come from the navmesh, what blocks sight from the soup. A line of sight is a closed segment that no triangle
// meets (tl_soup_line_of_sight): exact, and the same in both directions.

#ifndef TALUS_NAV_SIGHT_H
#define TALUS_NAV_SIGHT_H

#include <talus/nav_query.h>
#include <talus/soup.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// The potentially visible set of each polygon.

/// Most polygons of a set: it holds a bit for each pair.
#define TL_NAV_PVS_MAX_POLYGONS (1u << 18)
#define TL_NAV_PVS_MAGIC        0x48474953u ///< "SIGH"
#define TL_NAV_PVS_VERSION      1u

/// How a potentially visible set is baked.
typedef struct tl_nav_pvs_def {
    float eye_height;            ///< metres above the surface, of the viewer and of what is viewed. Default 1.6
    float max_distance;          ///< metres, >= 0: samples farther apart do not see each other. Default INFINITY
    const tl_ray_filter *filter; ///< which triangles block sight; NULL: all
    tl_host host;                ///< tasks, progress (stage "sight") and memory
    uint32_t cookie;             ///< set by tl_default_nav_pvs_def
} tl_nav_pvs_def;

TL_API tl_nav_pvs_def tl_default_nav_pvs_def(void);

/// Which polygons see which. A blob: it may be stored, mapped and shared. Its polygons are numbered slot by slot, so it
/// fits the navmesh that it was baked from until a tile is added or removed, and that navmesh loaded again.
typedef struct tl_nav_pvs {
    tl_blob blob;
    uint32_t slot_count;
    uint32_t polygon_count;
    uint32_t words;      ///< 64-bit words of a row
    float eye_height;    ///< metres
    uint64_t first;      ///< offset in bytes: uint32_t [slot_count + 1], the number of each slot's first polygon
    uint64_t rows;       ///< offset in bytes: uint64_t [polygon_count * words]; bit b of row a: a sees b
    uint64_t pair_count; ///< pairs of different polygons that see each other
    uint64_t reserved;
} tl_nav_pvs;

/// Bakes the set by sampling. A polygon's samples are its middle and the points half way from there to each corner, at
/// eye height. Two polygons see each other when any two of their samples do: what is said to be seen is seen, but a
/// view through a slit between the samples is missed (an "aggressive" visible set, Nirenstein and Blake 2004). A
/// polygon sees itself.
///
/// `def` NULL: the default one. `*pvs_out` is freed with tl_blob_free; NULL on failure. `report_out` may be NULL.
/// TL_ERR_ARGUMENT, TL_ERR_EMPTY (no polygon), TL_ERR_LIMIT (TL_NAV_PVS_MAX_POLYGONS), TL_ERR_MEMORY,
/// TL_ERR_CANCELLED. O(n^2) lines of sight for n polygons; a `max_distance` saves most of them.
TL_API tl_result tl_nav_pvs_bake(const tl_nav_pvs_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                                 tl_nav_pvs **pvs_out, tl_report *report_out);

/// Whether untrusted bytes are a set that can be queried; more bytes may follow. TL_ERR_ARGUMENT (NULL, or not 8-byte
/// aligned), TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_CORRUPT. `report_out` may be NULL. O(tiles).
TL_API tl_result tl_nav_pvs_check(const void *bytes, uint64_t size, tl_report *report_out);

/// Whether two polygons see each other; false on failure. TL_ERR_STALE: a reference names no polygon. TL_ERR_ARGUMENT:
/// NULL, or the set was baked from another navmesh, as far as can be told. O(1).
TL_API tl_result tl_nav_pvs_sees(const tl_nav_pvs *pvs, const tl_navmesh *navmesh, tl_nav_ref a, tl_nav_ref b,
                                 bool *seen_out);

/// The polygons that one sees, itself included, ordered by slot and polygon. TL_INCOMPLETE: the first `capacity` were
/// written, `*count_out` is the number of all. Errors as of tl_nav_pvs_sees; `*count_out` is 0 then. O(polygons).
TL_API tl_result tl_nav_pvs_seen_from(const tl_nav_pvs *pvs, const tl_navmesh *navmesh, tl_nav_ref from,
                                      tl_nav_ref *polygons_out, uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Cover.

enum { TL_NAV_MAX_COVER_HEIGHTS = 8 };

/// Most places that one search for cover tries: points of the grid times floors that may lie above one another.
#define TL_NAV_MAX_COVER_PLACES (1u << 20)

/// Who takes cover from what.
typedef struct tl_nav_cover_request {
    const tl_navmesh *navmesh;
    const tl_soup *soup;         ///< what blocks sight
    const tl_nav_filter *filter; ///< of the agent's paths; NULL: the default one
    tl_nav_location agent;       ///< where the agent is
    tl_vec3 threat;              ///< metres: the threat's eye
} tl_nav_cover_request;

/// What counts as cover, and how it is looked for.
typedef struct tl_nav_cover_def {
    float heights[TL_NAV_MAX_COVER_HEIGHTS]; ///< metres above the surface that must be hidden. Default 0.3, 1, 1.6
    uint32_t height_count;                   ///< [1, TL_NAV_MAX_COVER_HEIGHTS]. Default 3
    float spacing;                           ///< metres between the places that are tried, > 0. Default 1
    float max_length;                        ///< metres in the plane, >= 0: longer paths are ignored. Default 30
    const tl_ray_filter *sight_filter;       ///< which triangles block sight; NULL: all
    uint32_t cookie;                         ///< set by tl_default_nav_cover_def
} tl_nav_cover_def;

TL_API tl_nav_cover_def tl_default_nav_cover_def(void);

/// A hidden place.
typedef struct tl_nav_cover {
    tl_nav_location location;
    float length; ///< metres in the plane, of the shortest path there
} tl_nav_cover;

/// The hidden places around an agent with the shortest paths, the shortest first.
///
/// Candidates are the agent's own place and the points of a grid (whole multiples of `spacing` in x and z), on every
/// floor within max_length up or down. The best `capacity` are written to `covers_out`, `*count_out` of them; of
/// equally long paths the one that was tried first. The grid is searched in growing squares, as far as the navmesh
/// reaches, until no farther point can be better. TL_OK with `*count_out` 0: there is no cover. `def` NULL: the default
/// one. TL_ERR_NODES: the query ran out of nodes for some candidate, which was left out; the others are written.
/// TL_ERR_LIMIT: `spacing` is too fine for `max_length` and the navmesh, TL_NAV_MAX_COVER_PLACES were tried; the best
/// of them are written. Otherwise `*count_out` is 0: TL_ERR_ARGUMENT, TL_ERR_STALE (the agent's polygon),
/// TL_ERR_NOT_FINITE.
TL_API tl_result tl_nav_query_find_cover(tl_nav_query *query, const tl_nav_cover_request *request,
                                         const tl_nav_cover_def *def, tl_nav_cover *covers_out, uint32_t capacity,
                                         uint32_t *count_out);

#ifdef __cplusplus
}
#endif

#endif
