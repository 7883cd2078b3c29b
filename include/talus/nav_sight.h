// SPDX-License-Identifier: MIT
//
// Sight on a navmesh: which polygons see one another, and where to take cover. Places come from the navmesh, what
// stands between them from the soup.
//
// A line of sight is a closed segment that no triangle meets (tl_soup_line_of_sight): exact, and the same both ways.

#ifndef TALUS_NAV_SIGHT_H
#define TALUS_NAV_SIGHT_H

#include <talus/nav_query.h>
#include <talus/soup.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// Between polygons.

/// Most polygons of a table: a bit for each pair.
#define TL_NAV_SIGHT_MAX_POLYGONS (1u << 18)
#define TL_NAV_SIGHT_MAGIC        0x48474953u ///< "SIGH"
#define TL_NAV_SIGHT_VERSION      1u

/// How a table of sight is made.
typedef struct tl_nav_sight_def {
    float eye_height; ///< metres above the surface, of who looks and who is looked at. Default 1.6
    float
        max_distance; ///< metres; polygons whose samples are all farther apart do not see each other. Default INFINITY
    const tl_ray_filter *filter; ///< what blocks sight; NULL: everything
    tl_host host;                ///< tasks, progress ("sight") and memory
} tl_nav_sight_def;

TL_API tl_nav_sight_def tl_default_nav_sight_def(void);

/// A table of which polygons see which. A blob: it may be stored, mapped and shared. Its polygons are numbered slot by
/// slot: it fits the navmesh that it was made from while no tile comes or goes, and that navmesh loaded again.
typedef struct tl_nav_sight {
    tl_blob blob;
    uint32_t slot_count;
    uint32_t polygon_count;
    uint32_t words;      ///< 64-bit words of a row
    float eye_height;    ///< metres
    uint64_t first;      ///< uint32_t [slot_count + 1], offset in bytes: the number of each slot's first polygon
    uint64_t rows;       ///< uint64_t [polygon_count * words], offset in bytes; bit b of row a: a sees b
    uint64_t pair_count; ///< pairs of different polygons that see each other
    uint64_t reserved;
} tl_nav_sight;

/// Each polygon is sampled at its middle and, half way from there, towards each corner; eye_height above the surface.
/// Two polygons see each other when any two of their samples do. What a slit between the samples would show is not
/// seen; what is said to be seen is. A polygon sees itself.
///
/// Errors: TL_ERR_EMPTY (no polygon), TL_ERR_LIMIT (TL_NAV_SIGHT_MAX_POLYGONS), TL_ERR_ARGUMENT, TL_ERR_MEMORY,
/// TL_ERR_CANCELLED; `*sight_out` is NULL then. Free with tl_blob_free. O(n^2) lines of sight; `max_distance` saves
/// most.
TL_API tl_result tl_nav_sight_bake(const tl_nav_sight_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                                   tl_nav_sight **sight_out, tl_report *report_out);

/// Whether untrusted bytes are a table that can be asked. TL_ERR_ARGUMENT (NULL, or not 8-byte aligned),
/// TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_CORRUPT. `report_out` may be NULL. O(tiles).
TL_API tl_result tl_nav_sight_check(const void *bytes, uint64_t size, tl_report *report_out);

/// Whether two polygons see each other. TL_NOT_FOUND: a stale reference; TL_ERR_ARGUMENT: the table was made from
/// another navmesh, as far as can be told. O(1).
TL_API tl_result tl_nav_sight_between(const tl_nav_sight *sight, const tl_navmesh *navmesh, tl_nav_ref a, tl_nav_ref b,
                                      bool *seen_out);

/// The polygons that one sees, itself among them, by slot and polygon. TL_INCOMPLETE: the first `capacity` were
/// written, `*count_out` is the true number. Errors else as tl_nav_sight_between.
TL_API tl_result tl_nav_sight_seen_from(const tl_nav_sight *sight, const tl_navmesh *navmesh, tl_nav_ref from,
                                        tl_nav_ref *polygons_out, uint32_t capacity, uint32_t *count_out);

// ---------------------------------------------------------------------------------------------------------
// Cover.

enum { TL_NAV_MAX_COVER_HEIGHTS = 8 };

/// From whom to hide, and how.
typedef struct tl_nav_cover_def {
    tl_vec3 threat;                          ///< the threat's eye
    float heights[TL_NAV_MAX_COVER_HEIGHTS]; ///< metres above the surface that the threat must not see
    uint32_t height_count;                   ///< 1 to TL_NAV_MAX_COVER_HEIGHTS
    float spacing;                           ///< metres between the places that are tried. Default 1
    float max_length;                        ///< metres in the plane: longer ways are not gone. Default 30
    const tl_ray_filter *sight_filter;       ///< what hides; NULL: everything
} tl_nav_cover_def;

/// 0.3, 1 and 1.6 m must be hidden.
TL_API tl_nav_cover_def tl_default_nav_cover_def(tl_vec3 threat);

typedef struct tl_nav_cover {
    tl_nav_location location;
    float length; ///< metres in the plane, of the shortest path there
} tl_nav_cover;

/// The places around an agent that a threat does not see, those with the shortest way first.
///
/// Tried are: where the agent is, and the points of a grid (whole multiples of `spacing` in x and z), on every floor
/// within max_length up or down. The `capacity` nearest that are hidden are written; of equal ways the one tried first.
/// The grid is gone through in growing squares and no farther than could matter. TL_OK with `*count_out` 0: there is no
/// cover. TL_ERR_LIMIT: the query ran out of nodes for some place, which was left out; the others are right.
/// TL_ERR_ARGUMENT, TL_NOT_FOUND (the agent's polygon is stale), TL_ERR_NOT_FINITE.
TL_API tl_result tl_nav_query_find_cover(tl_nav_query *query, const tl_navmesh *navmesh, const tl_soup *soup,
                                         const tl_nav_filter *filter, const tl_nav_location *agent,
                                         const tl_nav_cover_def *def, tl_nav_cover *covers_out, uint32_t capacity,
                                         uint32_t *count_out);

#ifdef __cplusplus
}
#endif

#endif
