// SPDX-License-Identifier: MIT
//
// Each column of floor is asked for by all places around it whose erosion it might decide, some fifty. Where much floor
// is missing that is what an audit does, so what lies in a column is kept: in a table by a hash of its place, where the
// last column in a slot counts, because places are asked for row by row. A surface's height is that of one ray from
// the level's top, whoever asks.

#include "nav_audit/column_surfaces.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/hash.h"
#include "base/host.h"
#include "base/min_max.h"

#include <math.h>
#include <string.h>

enum { COLUMN_SLOTS = 8192, FIRST_HITS = 64 };

#define NOTHING_KEPT UINT32_MAX

tl_result tl_audit_columns_create(const tl_audit_job *job, tl_audit_columns *columns_out)
{
    memset(columns_out, 0, sizeof *columns_out);
    columns_out->job = job;
    columns_out->slots = tl_allocate_array(job->host->allocator, COLUMN_SLOTS, sizeof *columns_out->slots);
    for (uint32_t i = 0; columns_out->slots != NULL && i < COLUMN_SLOTS; i++) {
        columns_out->slots[i].count = NOTHING_KEPT;
    }
    return columns_out->slots != NULL ? TL_OK : TL_ERR_MEMORY;
}

void tl_audit_columns_free(tl_audit_columns *columns)
{
    if (columns->job != NULL) {
        tl_release_array(columns->job->host->allocator, columns->slots, COLUMN_SLOTS, sizeof *columns->slots);
        tl_audit_hits_free(columns->job, &columns->hits);
    }
    memset(columns, 0, sizeof *columns);
}

tl_vec3 tl_audit_column_point(const tl_audit_job *job, const int32_t column[2], float y)
{
    const tl_nav_config *config = &job->scene.config;
    const tl_vec3 origin = config->lattice.origin;
    const float half = 0.5f * config->cell_size;
    return tl_vec3_make(tl_nav_lattice_to_world(origin.x, column[0], config->cell_size) + half, y,
                        tl_nav_lattice_to_world(origin.z, column[1], config->cell_size) + half);
}

bool tl_audit_is_floor(const tl_audit_job *job, const tl_ray_hit *hit)
{
    const bool is_null = job->def->areas != NULL && job->def->areas[hit->triangle] == TL_NAV_NULL_AREA;
    return !hit->back && !is_null && hit->normal.y > job->scene.config.walkable_slope_cos;
}

tl_result tl_audit_hit_column(const tl_audit_job *job, const int32_t column[2], tl_audit_hits *hits)
{
    const tl_aabb bounds = job->scene.config.bounds;
    const tl_ray ray = { tl_audit_column_point(job, column, bounds.max.y),
                         { 0.0f, -1.0f, 0.0f },
                         bounds.max.y - bounds.min.y };
    while (hits->hits == NULL || tl_soup_cast_ray_all(job->scene.soup, &ray, TL_HITS_TOUCHED, NULL, hits->hits,
                                                      hits->capacity, &hits->count) == TL_INCOMPLETE) {
        const uint32_t capacity = hits->hits == NULL ? FIRST_HITS : hits->count;
        tl_audit_hits_free(job, hits);
        hits->hits = tl_allocate_array(job->host->allocator, capacity, sizeof *hits->hits);
        if (hits->hits == NULL) {
            return TL_ERR_MEMORY;
        }
        hits->capacity = capacity;
    }
    return TL_OK;
}

void tl_audit_hits_free(const tl_audit_job *job, tl_audit_hits *hits)
{
    tl_release_array(job->host->allocator, hits->hits, hits->capacity, sizeof *hits->hits);
    memset(hits, 0, sizeof *hits);
}

static tl_audit_surface surface_of_hit(const tl_audit_job *job, const tl_ray_hit *hit)
{
    const tl_vec3 n = hit->normal;
    const tl_audit_surface surface = { job->scene.config.bounds.max.y - hit->t,
                                       sqrtf(tl_maxf(1.0f - n.y * n.y, 0.0f)) / n.y, tl_audit_is_floor(job, hit), false,
                                       0 };
    return surface;
}

static bool is_within(const tl_audit_surface *surface, float y, float reach)
{
    return surface->y <= y + reach && surface->y >= y - reach;
}

// Of a column that has too many surfaces to be kept: the one that is wanted, in a slot that counts for no column.
static tl_audit_surface *find_among_hits(const tl_audit_columns *columns, float y, float reach, tl_audit_column *slot)
{
    slot->count = NOTHING_KEPT;
    for (uint32_t i = 0; i < columns->hits.count; i++) {
        slot->surfaces[0] = surface_of_hit(columns->job, &columns->hits.hits[i]);
        if (is_within(&slot->surfaces[0], y, reach)) {
            return &slot->surfaces[0];
        }
    }
    return NULL;
}

tl_result tl_audit_find_surface(tl_audit_columns *columns, const int32_t column[2], float y, float reach,
                                tl_audit_surface **surface_out)
{
    const uint64_t place = (uint64_t)(uint32_t)column[0] << 32 | (uint32_t)column[1];
    tl_audit_column *slot = &columns->slots[tl_hash_mix(place) % COLUMN_SLOTS];
    *surface_out = NULL;
    if (slot->count == NOTHING_KEPT || slot->x != column[0] || slot->z != column[1]) {
        TL_TRY(tl_audit_hit_column(columns->job, column, &columns->hits));
        if (columns->hits.count > TL_AUDIT_COLUMN_SURFACES) {
            *surface_out = find_among_hits(columns, y, reach, slot);
            return TL_OK;
        }
        slot->x = column[0];
        slot->z = column[1];
        slot->count = columns->hits.count;
        for (uint32_t i = 0; i < slot->count; i++) {
            slot->surfaces[i] = surface_of_hit(columns->job, &columns->hits.hits[i]);
        }
    }
    for (uint32_t i = 0; i < slot->count && *surface_out == NULL; i++) {
        *surface_out = is_within(&slot->surfaces[i], y, reach) ? &slot->surfaces[i] : NULL;
    }
    return TL_OK;
}
