// SPDX-License-Identifier: MIT
//
// What the three parts of an audit share.

#ifndef TALUS_SRC_NAV_AUDIT_AUDIT_H
#define TALUS_SRC_NAV_AUDIT_AUDIT_H

#include "nav_audit/polygon_list.h"
#include "nav_audit/probe.h"

typedef struct tl_audit_job {
    const tl_nav_audit_def *def;
    const tl_host *host;
    tl_audit_scene scene;
    tl_audit_polygon_list polygons;
    tl_nav_query **queries; ///< one a worker
    tl_audit_records records;
    tl_stage stage; ///< in which the records are merged
    tl_nav_audit *audit;
    tl_report *report; ///< may be NULL
    uint64_t steps;    ///< so far, of shares that are done
} tl_audit_job;

/// What a task returns.
typedef struct tl_audit_share {
    tl_audit_records records;
    tl_result result;
    uint64_t steps, sweeps, tolerated, paths, portals, samples;
    double metres;
} tl_audit_share;

/// Does share number `index`; several run in parallel.
typedef void tl_audit_task(tl_audit_job *job, uint32_t index, uint32_t worker, tl_audit_share *share, void *user);

/// A share's steps, about: a few milliseconds.
enum { TL_AUDIT_SHARE_STEPS = 2048 };

/// Runs `count` shares on the host's tasks, a batch at a time with a call of progress before each, and adds up their
/// results in order. Their records are thinned. TL_ERR_LIMIT, as all above.
tl_result tl_audit_run_shares(tl_audit_job *job, const char *stage, uint32_t count, tl_audit_task *task, void *user);

/// TL_ERR_LIMIT, with the report, when so many steps more are too many.
tl_result tl_audit_expect_steps(const tl_audit_job *job, uint64_t more);

/// Each polygon's outline, and the lines across portals.
tl_result tl_audit_polygons(tl_audit_job *job);
/// Random shortest paths.
tl_result tl_audit_paths(tl_audit_job *job);
/// Floors of the soup that the navmesh lacks.
tl_result tl_audit_floors(tl_audit_job *job);

#endif
