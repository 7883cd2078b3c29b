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
    float stride; ///< metres between two points of a walk
} tl_audit_scene;

/// One walk at a time.
typedef struct tl_audit_walker {
    const tl_audit_scene *scene;
    tl_audit_records *records;
    uint64_t sweeps;
    bool standing;
    tl_vec3 feet; ///< where the probe stands, when it does
} tl_audit_walker;

/// Begins a new walk: the first point is taken without a sweep.
void tl_audit_walk_begin(tl_audit_walker *walker);

/// Walks to a point of a polygon, at most a stride away. False: out of memory.
bool tl_audit_walk_to(tl_audit_walker *walker, tl_nav_ref polygon, float x, float z);

/// Walks a straight line within one polygon, both ends included. False: out of memory.
bool tl_audit_walk_line(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 from, tl_vec3 to);

#endif
