// SPDX-License-Identifier: MIT
//
// Audit: a navmesh checked against the triangles that it was baked from.
//
//   tl_nav_audit_run   sweeps a probe of the agent along paths, polygons and portals through the soup, and looks for
//                      floor that the navmesh lacks: every place where one says free and the other says blocked
//   tl_nav_why         the stage and the setting that made a point not walkable, and the value that would make it so
//
// What "free" promises: the probe is the agent, reduced by what voxels, a simplified outline and a coarse surface may
// cost; docs/guide/audit.md derives how much that is. Where even the probe does not fit, the navmesh is wrong.

#ifndef TALUS_NAV_AUDIT_H
#define TALUS_NAV_AUDIT_H

#include <talus/nav_bake.h>
#include <talus/nav_prune.h>
#include <talus/nav_query.h>
#include <talus/soup.h>

#ifdef __cplusplus
extern "C" {
#endif

// ---------------------------------------------------------------------------------------------------------
// The audit.

/// The part of an agent that must be free wherever the navmesh says so: a capsule. Metres.
typedef struct tl_nav_probe {
    float radius;  ///< of the capsule
    float step;    ///< above the floor, where the capsule begins: what is lower can be climbed
    float height;  ///< above the floor, where the capsule ends
    float surface; ///< how far the navmesh's surface may lie above or below the floor, a step not counted
    float gap;     ///< holes narrower than twice this do not show in voxels
} tl_nav_probe;

/// The probe of a navmesh that was baked with `config`.
///
/// radius: what erosion leaves at least less max_simplification_error, and no less than half of the agent's (where that
/// does not fit, an audit sweeps a thinner one, by what is promised at that distance from the outline); step:
/// walkable_climb and one voxel more; height: walkable_height in metres, less one voxel. An audit limits the radius to
/// half the distance between step and height.
TL_API tl_nav_probe tl_nav_probe_from_config(const tl_nav_config *config);

/// Places, a cell wide, that an audit lists before it gives up: TL_ERR_LIMIT.
#define TL_NAV_AUDIT_MAX_PLACES (1u << 21)

typedef struct tl_nav_audit_def {
    tl_nav_def nav;       ///< what the navmesh was baked with; `bounds` empty: those of the soup. Its host is ignored
    uint32_t path_count;  ///< random shortest paths. Default 2000
    uint64_t seed;        ///< of their random ends. Default 1
    float probe_radius;   ///< metres, to be free everywhere; negative (the default): as tl_nav_probe_from_config says
    const uint8_t *areas; ///< as in tl_nav_input, by the soup's triangles, or NULL: floor of area 0 is not missing
    const tl_nav_volume *volumes; ///< the same for volumes of area 0
    uint32_t volume_count;
    const tl_navmesh *pruned; ///< what tl_nav_prune removed: floor there is not missing. NULL: nothing was
    /// Square metres: smaller missing floors are ignored. Negative (the default): 8 columns of voxels beside navmesh,
    /// and apart from it the smallest island that a bake keeps (region_min_size). What counts is floor that must
    /// outlive erosion and the simplified outline, whole columns of it.
    float min_missing_area;
    /// Steps along lines and paths, a cell long each, and samples of floors, all together; more is TL_ERR_LIMIT. A step
    /// takes some microseconds. Default 2^26: a thousand times what a level of a square kilometre needs.
    uint64_t max_steps;
    tl_host host;    ///< tasks, progress ("audit polygons", "audit paths", "audit floors", "audit findings") and memory
    uint32_t cookie; ///< set by tl_default_nav_audit_def
} tl_nav_audit_def;

TL_API tl_nav_audit_def tl_default_nav_audit_def(void);

typedef enum tl_nav_finding_kind {
    TL_NAV_FINDING_BLOCKED,  ///< the probe is stopped by a triangle
    TL_NAV_FINDING_STEP,     ///< the floor rises or falls by more than a step between two points a cell apart
    TL_NAV_FINDING_NO_FLOOR, ///< nothing to stand on within a step of the navmesh
    TL_NAV_FINDING_MISSING   ///< floor with room for the agent all around, and no navmesh
} tl_nav_finding_kind;

/// "blocked", "step", "no floor", "missing".
TL_API const char *tl_nav_finding_name(tl_nav_finding_kind kind);

/// One fault, reported once even when many paths pass it.
typedef struct tl_nav_finding {
    tl_nav_finding_kind kind;
    uint32_t triangle;  ///< that blocks the probe, or on which the missing floor lies; else TL_NO_TRIANGLE
    tl_nav_ref polygon; ///< of the navmesh; of missing floor: one beside it, TL_NAV_NO_REF when none is
    tl_vec3 point;      ///< on the floor, or on the navmesh where there is none: the worst of those places
    tl_vec3 contact;    ///< on the triangle
    /// Metres. Blocked: how deep the probe overlaps the triangle; step: its height; no floor: how deep one falls,
    /// INFINITY when for ever; missing: 0.
    float depth;
    uint32_t count; ///< places a cell apart that were merged into this finding
    tl_aabb bounds; ///< of those places
    float area;     ///< square metres, of missing floor; else 0
} tl_nav_finding;

/// What an audit found, and what it did. Free with tl_nav_audit_free.
typedef struct tl_nav_audit {
    tl_nav_finding *findings; ///< by kind, then the worst first, by depth or area
    uint32_t finding_count;
    tl_nav_probe probe;     ///< as it was used
    uint64_t path_count;    ///< random paths walked
    double path_metres;     ///< their length in all
    uint64_t polygon_count; ///< polygons whose outline and middle were walked
    uint64_t portal_count;  ///< links between polygons that were crossed
    uint64_t step_count;    ///< sweeps of the probe
    /// Places where the probe touched a triangle beside the outline, but no deeper than erosion and the simplified
    /// outline may bring it there.
    uint64_t tolerated_count;
    uint64_t contradictions; ///< places of the findings, a cell wide each
    uint64_t floor_samples;  ///< points of the soup that were compared with the navmesh
    float sample_spacing;    ///< metres between these
    double missing_area;     ///< square metres, of the findings
    tl_allocator allocator;  ///< private
} tl_nav_audit;

/// Checks a navmesh against a soup.
///
/// Each polygon's outline, its lines from the middle to its neighbours' middles, and random shortest paths are walked
/// in steps of a cell: the floor under the path is looked up in the soup, and the probe is swept from floor to floor.
/// Then the floors of the soup themselves are sampled, every two cells (on levels wider than 4096 samples: sparser, and
/// `sample_spacing` says so): floor that must outlive the filters and erosion, farther from any navmesh than the
/// outline may have been simplified, is missing; so is nearer floor that a larger erosion would leave. The same result
/// for any number of workers. Links that leave the surface are
/// not walked.
///
/// `def` NULL: the default one. `navmesh` may be empty or NULL: then all floor is missing. `report_out` may be NULL.
/// The work is bounded by def->max_steps, times what one sweep of the probe touches; the lengths of all lines are known
/// before the first step. TL_ERR_LIMIT: more steps, or over TL_NAV_AUDIT_MAX_PLACES places that are wrong, as when
/// navmesh and soup do not belong together. TL_ERR_ARGUMENT and TL_ERR_LIMIT as of tl_nav_config_from_def too,
/// TL_ERR_MEMORY, TL_ERR_CANCELLED; `*audit_out` is zeroed then.
TL_API tl_result tl_nav_audit_run(const tl_nav_audit_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                                  tl_nav_audit *audit_out, tl_report *report_out);
/// Frees what an audit holds and zeroes it. NULL or zeroed: nothing happens.
TL_API void tl_nav_audit_free(tl_nav_audit *audit);

// ---------------------------------------------------------------------------------------------------------
// Why a point is not walkable.

/// The first stage that took a point away.
typedef enum tl_nav_cause {
    TL_NAV_CAUSE_NONE,       ///< the point is walkable
    TL_NAV_CAUSE_OUTSIDE,    ///< beyond the bounds of what was baked, or on their rim
    TL_NAV_CAUSE_NO_FLOOR,   ///< no triangle within a step of the point
    TL_NAV_CAUSE_SLOPE,      ///< the floor is too steep, or faces down
    TL_NAV_CAUSE_AREA_INPUT, ///< the triangle's own area is 0
    TL_NAV_CAUSE_LEDGE,      ///< beside a drop, or on too steep a stair
    TL_NAV_CAUSE_CEILING,    ///< too little height above
    TL_NAV_CAUSE_RADIUS,     ///< too near to a wall or a ledge
    TL_NAV_CAUSE_VOLUME,     ///< a volume marked it as not walkable
    TL_NAV_CAUSE_ISLAND,     ///< of an island (connected component) of fewer columns than region_min_size squared
    TL_NAV_CAUSE_OUTLINE,    ///< the simplified outline cut it off
    TL_NAV_CAUSE_CHANGED,    ///< these triangles and settings give navmesh here, but the navmesh has none
    TL_NAV_CAUSE_PRUNED,     ///< of an island that tl_nav_prune removed
    TL_NAV_CAUSE_WALL        ///< a wall or a high step stands in the same column of voxels
} tl_nav_cause;

/// One to four words, such as "small island"; of another number "unknown".
TL_API const char *tl_nav_cause_name(tl_nav_cause cause);
/// A sentence for a cause.
TL_API const char *tl_nav_cause_text(tl_nav_cause cause);

/// One cause, and the setting that removes it.
typedef struct tl_nav_reason {
    tl_nav_cause cause;
    const char *stage; ///< static; as bakes name it
    /// static; the field of tl_nav_def to blame, or NULL when none helps. Pruned: the field of tl_nav_prune_def:
    /// "solids", "seeds" (a seed on the island keeps it; `value` and `needed` are 0) or "min_area".
    const char *parameter;
    float value;  ///< of that field now
    float needed; ///< the nearest value with which this cause no longer applies
    /// What was found at the point. Slope: degrees; ledge: metres of the drop or stair; ceiling: metres of free height;
    /// radius: metres kept; island: columns; pruned: the island's square metres; wall: metres to it; no floor: metres
    /// to the nearest floor below, INFINITY when there is none.
    float measured;
    uint32_t triangle; ///< of the view that is the floor, or TL_NO_TRIANGLE
} tl_nav_reason;

enum { TL_NAV_MAX_REASONS = 6 };

/// The answer to "why?".
typedef struct tl_nav_why_answer {
    bool walkable; ///< nothing to explain: a polygon lies at the point
    tl_vec3 floor; ///< the floor nearest to the point, which the answer is about
    /// The first is why the point is not walkable. Each other one is the reason that is left once those before it are
    /// removed.
    tl_nav_reason reasons[TL_NAV_MAX_REASONS];
    uint32_t reason_count;
    bool proven;             ///< the tile was baked with all the needed values, and the point lies on its navmesh
    tl_nav_def needed;       ///< the def with those values
    uint32_t tile_x, tile_z; ///< the tile that was baked
    uint32_t bake_count;     ///< tiles that were baked to find out
    bool apart;              ///< walkable, but not on the largest island: no path leads there from it
    float island_area, largest_island_area; ///< square metres; 0 without a navmesh
} tl_nav_why_answer;

/// What tl_nav_prune removed from a navmesh.
typedef struct tl_nav_pruning {
    const tl_navmesh *removed; ///< its removed_out, as a navmesh
    double min_area;           ///< square metres, of its def
} tl_nav_pruning;

/// Bakes the tile around a point, stage by stage, until one removes the point; finds the nearest value of that stage's
/// setting with which it stays, and repeats until the point is walkable or nothing helps. Bakes some 30 tiles at most.
///
/// `def`, `input`: what the navmesh was baked with; `def` NULL: the default one. `navmesh` may be NULL: then the answer
/// is about a fresh bake. `pruning` NULL: nothing was pruned. `def->host`: memory, and tasks and progress of the bakes.
/// `report_out` may be NULL. Errors: those of tl_nav_tile_bake; TL_ERR_NOT_FINITE (the point), TL_ERR_INDEX (a
/// triangle); `*answer_out` is zeroed then.
TL_API tl_result tl_nav_why(const tl_nav_def *def, const tl_nav_input *input, const tl_navmesh *navmesh,
                            const tl_nav_pruning *pruning, tl_vec3 point, tl_nav_why_answer *answer_out,
                            tl_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
