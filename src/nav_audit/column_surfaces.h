// SPDX-License-Identifier: MIT
//
// What a ray straight down through the middle of a column meets, looked up once and kept.

#ifndef TALUS_SRC_NAV_AUDIT_COLUMN_SURFACES_H
#define TALUS_SRC_NAV_AUDIT_COLUMN_SURFACES_H

#include "nav_audit/audit.h"

typedef struct tl_audit_surface {
    float y;
    float rise;         ///< metres a metre
    bool is_walkable;   ///< its front, not too steep, of an area that is not 0
    bool is_free;       ///< there is free height above all of the block of columns around it
    uint32_t free_edge; ///< columns, the edge of the block that is_free was asked for; 0: of none
} tl_audit_surface;

/// A column with more surfaces is not kept.
enum { TL_AUDIT_COLUMN_SURFACES = 8 };

typedef struct tl_audit_column {
    int32_t x, z;
    uint32_t count; ///< of surfaces, the highest first; UINT32_MAX: nothing is kept here
    tl_audit_surface surfaces[TL_AUDIT_COLUMN_SURFACES];
} tl_audit_column;

/// All that a ray meets, in an array that grows. Zero to begin with.
typedef struct tl_audit_hits {
    tl_ray_hit *hits; ///< the highest first
    uint32_t count, capacity;
} tl_audit_hits;

/// One worker's.
typedef struct tl_audit_columns {
    const tl_audit_job *job;
    tl_audit_column *slots; ///< a column's own one by its hash; the last column there counts
    tl_audit_hits hits;     ///< scratch
} tl_audit_columns;

/// TL_ERR_MEMORY.
tl_result tl_audit_columns_create(const tl_audit_job *job, tl_audit_columns *columns_out);
void tl_audit_columns_free(tl_audit_columns *columns);

/// A point in the middle of a column of the level's lattice.
tl_vec3 tl_audit_column_point(const tl_audit_job *job, const int32_t column[2], float y);

/// All that a ray down through the level meets there. TL_ERR_MEMORY.
tl_result tl_audit_hit_column(const tl_audit_job *job, const int32_t column[2], tl_audit_hits *hits);
void tl_audit_hits_free(const tl_audit_job *job, tl_audit_hits *hits);

/// Whether a hit of that ray is one of floor: see tl_audit_surface.
bool tl_audit_is_floor(const tl_audit_job *job, const tl_ray_hit *hit);

/// The highest surface of a column within `reach` above and below a height; NULL when there is none. It is kept until
/// the next call. TL_ERR_MEMORY.
tl_result tl_audit_find_surface(tl_audit_columns *columns, const int32_t column[2], float y, float reach,
                                tl_audit_surface **surface_out);

#endif
