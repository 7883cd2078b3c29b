// SPDX-License-Identifier: MIT
//
// Jump links: drops, jumps and climbs (off-mesh connections), found along the ledges of a navmesh. Each is proven by
// sweeping the agent's capsule through the level's triangles along the whole trajectory.
//
//   tl_nav_links_find(NULL, navmesh, soup, &links, NULL);
//   tl_nav_links_add(links, NULL, navmesh);                   from now on paths use them

#ifndef TALUS_NAV_LINKS_H
#define TALUS_NAV_LINKS_H

#include <talus/nav_query.h>
#include <talus/soup.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_NAV_LINKS_MAGIC   0x4b4e494cu ///< "LINK"
#define TL_NAV_LINKS_VERSION 1u

/// Most places along ledges that links are sought from: at the default spacing 4,000 km of ledges.
#define TL_NAV_LINKS_MAX_PLACES (1u << 23)
/// Most landings that are tried: each place times the steps of two cells, up to `max_jump` or across the navmesh.
#define TL_NAV_LINKS_MAX_LANDINGS (1u << 27)

/// Least spacing of places, in cells of the navmesh: its outlines are a cell off the true ledges, and places that are
/// nearer to each other find the same links in more time.
#define TL_NAV_LINKS_MIN_SPACING 0.03125f

typedef enum tl_nav_link_kind {
    TL_NAV_LINK_DROP,  ///< a step over a ledge and a fall straight down: one way
    TL_NAV_LINK_JUMP,  ///< a parabola over a gap or an obstacle; both ways where the agent jumps high enough for it
    TL_NAV_LINK_CLIMB, ///< straight up a wall and over its edge, and back: both ways
    TL_NAV_LINK_KINDS
} tl_nav_link_kind;

/// "drop", "jump", "climb"; of another number "unknown".
TL_API const char *tl_nav_link_kind_name(tl_nav_link_kind kind);

/// One link. Points are the agent's feet, on the navmesh, in metres; start is the higher end of a drop or climb.
typedef struct tl_nav_jump_link {
    tl_vec3 start, end;
    float apex;        ///< metres that a jump rises above its start; 0 for a drop or climb
    uint8_t kind;      ///< a tl_nav_link_kind
    uint8_t both_ways; ///< 0 or 1
    uint16_t reserved; ///< 0
} tl_nav_jump_link;

/// The links of a navmesh: a blob.
typedef struct tl_nav_links {
    tl_blob blob;
    uint32_t link_count;
    uint32_t kind_counts[TL_NAV_LINK_KINDS];
    float agent_radius, agent_height; ///< metres, of the agent
    float agent_max_climb; ///< metres above the feet; lower obstacles block no link, as they block no walking
    float margin;          ///< metres by which the swept capsule was thicker than the agent
    uint64_t links;        ///< offset in bytes from the start of the blob: tl_nav_jump_link [link_count]
} tl_nav_links;

/// The links, [links->link_count].
static inline const tl_nav_jump_link *tl_nav_links_array(const tl_nav_links *links)
{
    return (const tl_nav_jump_link *)(const void *)((const char *)links + links->links);
}

/// What an agent can do. Lengths in metres, >= 0; a limit of 0 turns its kind of link off.
typedef struct tl_nav_links_def {
    float spacing;     ///< between two places that are tried along a ledge, > 0, at least TL_NAV_LINKS_MIN_SPACING
                       ///< cells. Default 0.5
    float max_drop;    ///< down, also at the end of a jump. Default 4
    float max_jump;    ///< horizontally, from take-off to landing. Default 3
    float jump_height; ///< of a jump's highest point above its start. Default 1
    float max_speed;   ///< horizontally while jumping, metres a second, >= 0. Default 6
    float gravity;     ///< metres a second squared, > 0. Default 9.81
    float max_climb;   ///< up a wall. Default 1.2
    /// >= 1. Only links that save so much are kept: the shortest path without the link, over polygons and the links
    /// kept before it, is at least this many times as long as the link, or there is none. Default 3
    float min_gain;
    uint32_t max_nodes; ///< of each search for the path without, >= 2; a search that runs out counts as no path.
                        ///< Default 4096
    tl_host host;       ///< tasks, progress (stages "ledges", "sweeps", "selection") and memory
    uint32_t cookie;    ///< set by tl_default_nav_links_def
} tl_nav_links_def;

TL_API tl_nav_links_def tl_default_nav_links_def(void);

/// What became of the candidates of one kind.
typedef struct tl_nav_links_count {
    uint32_t tried;   ///< candidates with a place to land on
    uint32_t blocked; ///< the capsule met a triangle
    uint32_t useless; ///< the path without the link is not long enough (min_gain)
    uint32_t kept;
} tl_nav_links_count;

typedef struct tl_nav_links_report {
    tl_report base;
    uint32_t ledge_count;  ///< border edges of polygons
    uint32_t sample_count; ///< places along them
    uint32_t no_landing;   ///< candidates without a polygon to land on within reach
    uint32_t too_fast;     ///< jumps that need more than max_speed at every height within jump_height
    tl_nav_links_count kinds[TL_NAV_LINK_KINDS];
} tl_nav_links_report;

/// Finds links from the border edges of all polygons.
///
/// The agent is the one that the navmesh was baked for, as its first tile says. The capsule is swept in straight
/// pieces: the two legs of a drop or climb, and chords of a jump's parabola. It is thicker than the agent by `margin`,
/// which is more than any chord departs from the arc, so the agent's own capsule is free of triangles at every moment
/// of the jump. Where the floor is, is taken from the navmesh, not proven. Off-mesh connections that the navmesh has
/// count as paths. The same input gives the same bytes for any number of workers. `def` NULL: the default one.
/// `*links_out` is freed with tl_blob_free; NULL on failure. `report_out` may be NULL. TL_ERR_ARGUMENT,
/// TL_ERR_NOT_FINITE (fields of the def), TL_ERR_EMPTY (the navmesh has no tile), TL_ERR_LIMIT (`spacing` is too fine
/// for the navmesh: under TL_NAV_LINKS_MIN_SPACING cells, or more than TL_NAV_LINKS_MAX_PLACES or
/// TL_NAV_LINKS_MAX_LANDINGS), TL_ERR_MEMORY, TL_ERR_CANCELLED. Some 10 us a place. Sources: Mononen, Automatic
/// Annotations in Killzone 3 and Beyond (Paris Game AI Conference 2011), for sampling ledges; the proof by sweeps is
/// our own.
TL_API tl_result tl_nav_links_find(const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                                   tl_nav_links **links_out, tl_nav_links_report *report_out);

/// Whether untrusted bytes are a whole set of links; the report, which may be NULL, names the link that is not sound.
/// TL_ERR_ARGUMENT (NULL, or not 8-byte aligned), TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_CORRUPT.
/// O(links).
TL_API tl_result tl_nav_links_check(const void *bytes, uint64_t size, tl_report *report_out);

/// Adds all links to a navmesh as off-mesh connections: `user` is the link's index in the set; radius, flags, costs and
/// area are those of `prototype` (NULL: the default one). TL_ERR_ARGUMENT, TL_ERR_NOT_FINITE (the prototype),
/// TL_ERR_LIMIT, TL_ERR_MEMORY; then none is added.
TL_API tl_result tl_nav_links_add(const tl_nav_links *links, const tl_nav_offmesh *prototype, tl_navmesh *navmesh);

/// Where the agent's feet are at `t` in [0, 1] from start to end: proportional to the length of the two legs of a drop
/// or climb, to time in a jump. `t` beyond is clamped.
TL_API tl_vec3 tl_nav_jump_link_point(const tl_nav_jump_link *link, float t);

#ifdef __cplusplus
}
#endif

#endif
