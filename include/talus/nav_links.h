// SPDX-License-Identifier: MIT
//
// Finding drops, jumps and climbs: from the ledges of a navmesh, each proven by sweeping the agent's capsule through
// the level's triangles along the whole way.
//
//   tl_nav_links_find(&def, navmesh, soup, &links, NULL);
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

typedef enum tl_nav_link_kind {
    TL_NAV_LINK_DROP,  ///< a step over a ledge and a fall straight down: one way
    TL_NAV_LINK_JUMP,  ///< a parabola over a gap or an obstacle; both ways where the agent jumps high enough for it
    TL_NAV_LINK_CLIMB, ///< straight up a wall and over its edge, and back: both ways
    TL_NAV_LINK_KINDS
} tl_nav_link_kind;

/// "drop", "jump", "climb".
TL_API const char *tl_nav_link_kind_name(tl_nav_link_kind kind);

/// One link. Points are the agent's feet, on the navmesh; start is the higher end of a drop or climb.
typedef struct tl_nav_found_link {
    tl_vec3 start, end;
    float apex; ///< of a jump: metres that it rises above its start; else 0
    uint8_t kind;
    uint8_t both_ways;
    uint16_t reserved;
} tl_nav_found_link;

/// The links of a navmesh: a blob.
typedef struct tl_nav_links {
    tl_blob blob;
    uint32_t link_count;
    uint32_t kind_counts[TL_NAV_LINK_KINDS];
    float agent_radius, agent_height; ///< metres, of the capsule that was swept
    float agent_lift; ///< metres: what is lower than this above the feet blocks no way, as in walking (agent_max_climb)
    float margin;     ///< metres that the capsule was thicker than the agent
    uint64_t links;   ///< tl_nav_found_link [link_count], bytes from the start of the blob
} tl_nav_links;

static inline const tl_nav_found_link *tl_nav_links_at(const tl_nav_links *links)
{
    return (const tl_nav_found_link *)(const void *)((const char *)links + links->links);
}

/// What an agent can do. Lengths in metres; 0 for a limit: none of that kind.
typedef struct tl_nav_links_def {
    float spacing;     ///< between two places that are tried along a ledge, > 0
    float max_drop;    ///< down, also at the end of a jump
    float max_jump;    ///< from take-off to landing, in the plane
    float jump_height; ///< of a jump's highest point above its start: nothing higher can be reached by it either
    float max_speed;   ///< metres a second in the plane while jumping
    float gravity;     ///< metres a second squared, > 0
    float max_climb;   ///< up a wall
    /// A link is kept where the way without it, over polygons and links kept before, is at least so many times as long
    /// as the link itself, or leads nowhere; >= 1. So of a row of links side by side some are kept.
    float least_gain;
    uint32_t max_nodes; ///< of a search for the way without; a way that is not found within them counts as long
    const tl_host *host;
} tl_nav_links_def;

/// Spacing 0.5, drop 4, jump 3 and 1 high at 6 m/s, gravity 9.81, climb 1.2, gain 3, 4096 nodes.
TL_API tl_nav_links_def tl_default_nav_links_def(void);

/// What became of the ways that were tried, by kind.
typedef struct tl_nav_links_count {
    uint32_t tried;   ///< with a place to land on
    uint32_t blocked; ///< the capsule met a triangle
    uint32_t useless; ///< there is a way that is not much longer
    uint32_t kept;
} tl_nav_links_count;

typedef struct tl_nav_links_report {
    tl_report base;
    uint32_t ledge_count;  ///< border edges of polygons
    uint32_t sample_count; ///< places along them
    uint32_t no_landing;   ///< ways off a ledge that led over no polygon within reach
    uint32_t too_fast;     ///< jumps that no height within jump_height makes slow enough
    tl_nav_links_count kinds[TL_NAV_LINK_KINDS];
} tl_nav_links_report;

/// Finds links from the border edges of all polygons.
///
/// The agent is the capsule that the navmesh was built for, as its first tile says. Each way is swept in straight
/// pieces: those of drops and climbs are the way itself, those of a jump are chords of its parabola. The capsule is
/// thicker than the agent by `margin`, more than a chord departs from the arc, so that the agent's own capsule, at
/// every moment of the way, is free of triangles. Nothing is proven about where the floor is: that is the navmesh's
/// word. The same input gives the same bytes, whatever the host's tasks. Off-mesh links that the navmesh has count as
/// ways.
/// `*links_out` is freed with tl_blob_free; NULL on failure. TL_ERR_ARGUMENT, TL_ERR_NOT_FINITE (the def), TL_ERR_EMPTY
/// (no tile), TL_ERR_LIMIT, TL_ERR_MEMORY, TL_ERR_CANCELLED. Stages: "ledges", "sweeps", "selection".
/// Sources: Mononen, Automatic Annotations in Killzone 3 (Paris 2011) for sampling ledges; the proof is our own.
TL_API tl_result tl_nav_links_find(const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                                   tl_nav_links **links_out, tl_nav_links_report *report_out);

/// Whether untrusted bytes are a whole set of links; the report, which may be NULL, names the link that is not sound.
/// TL_ERR_ARGUMENT (NULL, or not 8-byte aligned), TL_ERR_TRUNCATED, TL_ERR_MAGIC, TL_ERR_VERSION, TL_ERR_CORRUPT.
/// O(links).
TL_API tl_result tl_nav_links_check(const void *bytes, uint64_t size, tl_report *report_out);

/// Adds all links to a navmesh: `user` is the link's index in the set; radius, flags, costs and area as in `like`
/// (NULL: the default one). On failure, as those of tl_navmesh_add_offmesh, none is added.
TL_API tl_result tl_nav_links_add(const tl_nav_links *links, const tl_nav_offmesh *like, tl_navmesh *navmesh);

/// Where the feet are at `t` of a link's way: [0, 1] from start to end, even in the length of the straight parts of a
/// drop or climb, in time for a jump.
TL_API tl_vec3 tl_nav_found_link_point(const tl_nav_found_link *link, float t);

#ifdef __cplusplus
}
#endif

#endif
