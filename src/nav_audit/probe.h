// SPDX-License-Identifier: MIT
//
// Walking the probe: floor under each point, a sweep from floor to floor, and a record of each place that is wrong.

#ifndef TALUS_SRC_NAV_AUDIT_PROBE_H
#define TALUS_SRC_NAV_AUDIT_PROBE_H

#include "nav_audit/records.h"

/// What all walks of an audit share.
typedef struct tl_audit_scene {
    const tl_navmesh *navmesh;
    const tl_soup *soup;
    tl_nav_config config; ///< of the level in one piece
    tl_nav_probe probe;
    /// Metres: what erosion and the simplified outline leave free between the outline and the nearest wall, at least;
    /// negative where the outline may cut into a wall. INFINITY: the probe's radius was given, and is free everywhere.
    float promise;
    float stride; ///< metres between two points of a walk
} tl_audit_scene;

/// One walk at a time.
typedef struct tl_audit_walker {
    const tl_audit_scene *scene;
    tl_audit_records *records;
    tl_nav_query *query; ///< to look for the outline
    uint64_t sweeps;
    uint64_t steps;     ///< points walked to
    uint64_t tolerated; ///< places where a thinner probe was enough
    bool standing;
    tl_vec3 feet;       ///< where the probe stands, when it does
    float rise;         ///< of the slope that it stands on, over a metre
    tl_nav_ref polygon; ///< that it stands on
} tl_audit_walker;

/// What a navmesh of this config promises at its outline: the scene's `promise`.
float tl_audit_outline_promise(const tl_nav_config *config);

/// A walker that stands nowhere.
tl_audit_walker tl_audit_walker_make(const tl_audit_scene *scene, tl_nav_query *query, tl_audit_records *records);

/// Begins a new walk: the first point is taken without a sweep.
void tl_audit_walk_begin(tl_audit_walker *walker);

/// Walks to a point of a polygon, at most a stride away. False: out of memory.
bool tl_audit_walk_to(tl_audit_walker *walker, tl_nav_ref polygon, float x, float z);

/// The steps of a straight line, 1 or more, a stride long at most, and 2^31 at most.
uint64_t tl_audit_line_steps(const tl_audit_scene *scene, tl_vec3 from, tl_vec3 to);

/// Walks those steps of a straight line within one polygon that lie in [first, end); the points at both ends are
/// included. False: out of memory.
bool tl_audit_walk_line(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 from, tl_vec3 to, uint64_t first,
                        uint64_t end);

#endif
