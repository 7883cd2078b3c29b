// SPDX-License-Identifier: MIT
//
// Places that are wrong, as walks meet them, and how they become findings.

#ifndef TALUS_SRC_NAV_AUDIT_RECORDS_H
#define TALUS_SRC_NAV_AUDIT_RECORDS_H

#include "base/stage.h"

#include <talus/nav_audit.h>

/// One place.
typedef struct tl_audit_record {
    tl_nav_finding_kind kind;
    uint32_t triangle;
    tl_nav_ref polygon;
    tl_vec3 point, contact;
    float depth;
    int32_t cube[3]; ///< x, y, z of the cube that holds the point; the edge of cubes is the caller's choice
} tl_audit_record;

/// A growing list. Zero but for the allocator to begin with.
typedef struct tl_audit_records {
    tl_audit_record *records;
    uint32_t count, capacity;
    const tl_allocator *allocator;
    tl_stage *stage; ///< whose progress is called; NULL: silent, as in a task
} tl_audit_records;

void tl_audit_records_free(tl_audit_records *list);
/// TL_ERR_MEMORY, TL_ERR_LIMIT (2^31 records); the list is then as it was.
tl_result tl_audit_records_add(tl_audit_records *list, const tl_audit_record *record);
tl_result tl_audit_records_append(tl_audit_records *list, const tl_audit_records *more);

/// TL_ERR_CANCELLED and TL_ERR_MEMORY here and below. Keeps of the records of one kind in one cube the deepest, of
/// equally deep ones the first; sorts by kind and cube.
tl_result tl_audit_records_thin(tl_audit_records *list);

/// Merges records of one kind into findings: those whose cubes, `reach` cubes of the list a side, are the same or
/// touch. The deepest record represents a group; where none has a depth, the one nearest to the group's middle, with
/// the polygon of any. Areas are left 0. Free the array with tl_release_array(allocator, array, count, size).
tl_result tl_audit_records_cluster(const tl_audit_records *list, uint32_t reach, tl_nav_finding **findings_out,
                                   uint32_t *count_out);

#endif
