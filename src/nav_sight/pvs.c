// SPDX-License-Identifier: MIT
//
// A potentially visible set (PVS) by sampling: a bit for each pair of polygons.
//
// Samples are laid out polygon by polygon first; then each task takes a row and casts from its polygon's samples to
// those of all later polygons until one line is free. Rows are mirrored at the end, so that no two tasks write one
// word. Rejected: one sample a polygon, which misses what lies around a pillar; and the conservative set through
// portals (Teller and Sequin, Visibility Preprocessing for Interactive Walkthroughs, 1991), since a navmesh's portals
// do not bound sight: one sees over walls and through windows.

#include "base/arena.h"
#include "base/assert.h"
#include "base/blob_check.h"
#include "base/host.h"

#include <talus/nav_sight.h>

#include <math.h>
#include <string.h>

enum { ROWS_AT_ONCE = 256 };

typedef struct pvs_job {
    const tl_nav_pvs_def *def;
    const tl_navmesh *navmesh;
    const tl_soup *soup;
    tl_nav_pvs *pvs;
    uint32_t *first_sample; // [polygons + 1]
    tl_vec3 *samples;
    uint64_t sample_count;
    uint32_t first_row;
} pvs_job;

tl_nav_pvs_def tl_default_nav_pvs_def(void)
{
    tl_nav_pvs_def def;
    memset(&def, 0, sizeof def);
    def.eye_height = 1.6f;
    def.max_distance = INFINITY;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static uint32_t *pvs_first(tl_nav_pvs *pvs)
{
    return (uint32_t *)(void *)((char *)pvs + pvs->first);
}

static const uint32_t *read_first(const tl_nav_pvs *pvs)
{
    return (const uint32_t *)(const void *)((const char *)pvs + pvs->first);
}

static uint64_t *row_of(tl_nav_pvs *pvs, uint32_t polygon)
{
    return (uint64_t *)(void *)((char *)pvs + pvs->rows) + (uint64_t)polygon * pvs->words;
}

static const uint64_t *read_row(const tl_nav_pvs *pvs, uint32_t polygon)
{
    return (const uint64_t *)(const void *)((const char *)pvs + pvs->rows) + (uint64_t)polygon * pvs->words;
}

static bool get_bit(const uint64_t *row, uint32_t bit)
{
    return (row[bit / 64] >> (bit % 64) & 1u) != 0;
}

static void set_bit(uint64_t *row, uint32_t bit)
{
    row[bit / 64] |= (uint64_t)1 << (bit % 64);
}

// ---- Samples -----------------------------------------------------------------------------------------------

static tl_vec3 eye_over(const pvs_job *job, tl_nav_ref ref, tl_vec3 place)
{
    (void)tl_navmesh_height(job->navmesh, ref, place.x, place.z, &place.y);
    place.y += job->def->eye_height;
    return place;
}

// The middle, and half way from there to each corner.
static void sample_eyes(const pvs_job *job, const tl_nav_tile *tile, uint32_t polygon, tl_nav_ref ref, tl_vec3 *samples)
{
    uint32_t count;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    tl_vec3 sum = { 0.0f, 0.0f, 0.0f };
    for (uint32_t i = 0; i < count; i++) {
        sum = tl_add(sum, tl_sub(corners[i], corners[0]));
    }
    const tl_vec3 middle = tl_mul_add(corners[0], sum, 1.0f / (float)count);
    samples[0] = eye_over(job, ref, middle);
    for (uint32_t i = 0; i < count; i++) {
        samples[i + 1] = eye_over(job, ref, tl_lerp(middle, corners[i], 0.5f));
    }
}

// Where each slot's polygons and each polygon's samples begin. NULL arrays: only counted.
static void lay_out_samples(const pvs_job *job, uint32_t *first, uint32_t *first_sample, uint64_t *polygons,
                            uint64_t *samples)
{
    const uint32_t slots = tl_navmesh_slot_count(job->navmesh);
    *polygons = *samples = 0;
    for (uint32_t slot = 0; slot < slots; slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(job->navmesh, slot);
        if (first != NULL) {
            first[slot] = (uint32_t)*polygons;
        }
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++, ++*polygons) {
            uint32_t corners;
            (void)tl_nav_tile_corners(tile, p, &corners);
            if (first_sample != NULL) {
                first_sample[*polygons] = (uint32_t)*samples;
            }
            *samples += corners + 1;
        }
    }
    if (first != NULL) {
        first[slots] = (uint32_t)*polygons;
    }
    if (first_sample != NULL) {
        first_sample[*polygons] = (uint32_t)*samples;
    }
}

static void sample_all_eyes(const pvs_job *job)
{
    uint32_t at = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(job->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(job->navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++, at++) {
            sample_eyes(job, tile, p, tl_navmesh_polygon_ref(job->navmesh, slot, p),
                        job->samples + job->first_sample[at]);
        }
    }
}

// ---- Rows --------------------------------------------------------------------------------------------------

static bool sees_polygon(const pvs_job *job, uint32_t a, uint32_t b)
{
    const float far_sq = job->def->max_distance * job->def->max_distance;
    for (uint32_t i = job->first_sample[a]; i < job->first_sample[a + 1]; i++) {
        for (uint32_t k = job->first_sample[b]; k < job->first_sample[b + 1]; k++) {
            if (tl_distance_sq(job->samples[i], job->samples[k]) <= far_sq &&
                tl_soup_line_of_sight(job->soup, job->samples[i], job->samples[k], job->def->filter)) {
                return true;
            }
        }
    }
    return false;
}

static void make_row(uint32_t index, uint32_t worker, void *user)
{
    const pvs_job *job = user;
    const uint32_t a = job->first_row + index;
    uint64_t *row = row_of(job->pvs, a);
    (void)worker;
    set_bit(row, a);
    for (uint32_t b = a + 1; b < job->pvs->polygon_count; b++) {
        if (sees_polygon(job, a, b)) {
            set_bit(row, b);
        }
    }
}

static tl_result make_rows(pvs_job *job)
{
    const uint32_t count = job->pvs->polygon_count;
    for (; job->first_row < count; job->first_row += ROWS_AT_ONCE) {
        const uint32_t left = count - job->first_row;
        TL_TRY(tl_progress_update(&job->def->host, "sight", job->first_row, count));
        tl_run_tasks(&job->def->host, make_row, left < ROWS_AT_ONCE ? left : ROWS_AT_ONCE, job);
    }
    for (uint32_t a = 0; a < count; a++) {
        for (uint32_t b = a + 1; b < count; b++) {
            if (get_bit(row_of(job->pvs, a), b)) {
                set_bit(row_of(job->pvs, b), a);
                job->pvs->pair_count++;
            }
        }
    }
    return tl_progress_update(&job->def->host, "sight", count, count);
}

// ---- The table ---------------------------------------------------------------------------------------------

static uint64_t align_blob(uint64_t bytes)
{
    return (bytes + TL_BLOB_ALIGNMENT - 1) / TL_BLOB_ALIGNMENT * TL_BLOB_ALIGNMENT;
}

static uint64_t first_offset(void)
{
    return align_blob(sizeof(tl_nav_pvs));
}

static uint64_t rows_offset(uint64_t slots)
{
    return first_offset() + align_blob((slots + 1) * sizeof(uint32_t));
}

static uint64_t words_of(uint64_t polygons)
{
    return (polygons + 63) / 64;
}

static tl_result allocate_pvs(pvs_job *job)
{
    const tl_allocator *allocator = job->def->host.allocator;
    const uint32_t slots = tl_navmesh_slot_count(job->navmesh);
    uint64_t polygons, samples;
    lay_out_samples(job, NULL, NULL, &polygons, &samples);
    if (polygons == 0) {
        return TL_ERR_EMPTY;
    }
    if (polygons > TL_NAV_PVS_MAX_POLYGONS) {
        return TL_ERR_LIMIT;
    }
    const uint64_t size = rows_offset(slots) + polygons * words_of(polygons) * sizeof(uint64_t);
    tl_nav_pvs *pvs = tl_blob_allocate(allocator, TL_NAV_PVS_MAGIC, TL_NAV_PVS_VERSION, size);
    job->pvs = pvs;
    job->sample_count = samples;
    job->first_sample = tl_allocate_array(allocator, polygons + 1, sizeof *job->first_sample);
    job->samples = tl_allocate_array(allocator, samples, sizeof *job->samples);
    if (pvs == NULL || job->first_sample == NULL || job->samples == NULL) {
        tl_release_array(allocator, job->first_sample, polygons + 1, sizeof *job->first_sample);
        job->first_sample = NULL;
        return TL_ERR_MEMORY;
    }
    pvs->slot_count = slots;
    pvs->polygon_count = (uint32_t)polygons;
    pvs->words = (uint32_t)words_of(polygons);
    pvs->eye_height = job->def->eye_height;
    pvs->first = first_offset();
    pvs->rows = rows_offset(slots);
    lay_out_samples(job, pvs_first(pvs), job->first_sample, &polygons, &samples);
    return TL_OK;
}

static void release_pvs_job(pvs_job *job)
{
    const tl_allocator *allocator = job->def->host.allocator;
    if (job->first_sample != NULL) {
        tl_release_array(allocator, job->first_sample, (uint64_t)job->pvs->polygon_count + 1,
                         sizeof *job->first_sample);
    }
    tl_release_array(allocator, job->samples, job->sample_count, sizeof *job->samples);
}

static tl_result check_pvs_def(const tl_nav_pvs_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_pvs_def()", report));
    if (!isfinite(def->eye_height)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "eye_height", "make it finite");
    }
    return def->max_distance >= 0.0f
               ? TL_OK
               : tl_report_field(report, TL_ERR_ARGUMENT, "max_distance", "make it >= 0, or INFINITY");
}

tl_result tl_nav_pvs_bake(const tl_nav_pvs_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                          tl_nav_pvs **pvs_out, tl_report *report_out)
{
    const tl_nav_pvs_def default_def = tl_default_nav_pvs_def();
    def = def != NULL ? def : &default_def;
    tl_report_begin(report_out, "sight");
    if (pvs_out != NULL) {
        *pvs_out = NULL;
    }
    if (navmesh == NULL || soup == NULL || pvs_out == NULL) {
        const char *field = navmesh == NULL ? "navmesh" : soup == NULL ? "soup" : "pvs_out";
        return tl_report_field(report_out, TL_ERR_ARGUMENT, field, "it may not be NULL");
    }
    TL_TRY(check_pvs_def(def, report_out));
    pvs_job job = { def, navmesh, soup, NULL, NULL, NULL, 0, 0 };
    tl_result result = allocate_pvs(&job);
    if (result == TL_OK) {
        sample_all_eyes(&job);
        result = make_rows(&job);
    }
    release_pvs_job(&job);
    if (result != TL_OK) {
        tl_blob_free(job.pvs);
        return tl_report_fail(report_out, result, NULL, TL_NO_ELEMENT,
                              result == TL_ERR_LIMIT   ? "cast single lines of sight instead"
                              : result == TL_ERR_EMPTY ? "bake a navmesh first"
                                                       : NULL);
    }
    *pvs_out = job.pvs;
    return TL_OK;
}

static bool is_sound_pvs_head(const tl_nav_pvs *pvs)
{
    const uint64_t polygons = pvs->polygon_count, slots = pvs->slot_count;
    return polygons > 0 && polygons <= TL_NAV_PVS_MAX_POLYGONS && slots <= TL_NAV_MAX_TILES &&
           pvs->words == words_of(polygons) && pvs->first == first_offset() && pvs->rows == rows_offset(slots) &&
           pvs->blob.size == align_blob(pvs->rows + polygons * pvs->words * sizeof(uint64_t));
}

tl_result tl_nav_pvs_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_NAV_PVS_MAGIC, TL_NAV_PVS_VERSION, sizeof(tl_nav_pvs) };
    const tl_nav_pvs *pvs = bytes;
    TL_TRY(tl_blob_check_head(bytes, size, expected, 8, report_out));
    if (!is_sound_pvs_head(pvs)) {
        return tl_report_fail(report_out, TL_ERR_CORRUPT, "head", TL_NO_ELEMENT, "bake it again");
    }
    const uint32_t *first = read_first(pvs);
    uint32_t slot = 0;
    while (slot < pvs->slot_count && first[slot] <= first[slot + 1]) {
        slot++;
    }
    return first[0] == 0 && slot == pvs->slot_count && first[slot] == pvs->polygon_count
               ? TL_OK
               : tl_report_fail(report_out, TL_ERR_CORRUPT, "tile", slot, "bake it again");
}

// ---- Queries -----------------------------------------------------------------------------------------------

// A reference holds its slot above the polygon's 28 bits (nav_query.h); that it does is verified by encoding it again.
static tl_result polygon_number(const tl_nav_pvs *pvs, const tl_navmesh *navmesh, tl_nav_ref ref, uint32_t *number_out)
{
    enum { POLYGON_BITS = 28, SLOT_BITS = 20 };
    const tl_nav_tile *tile;
    uint32_t polygon;
    if (tl_navmesh_resolve(navmesh, ref, &tile, &polygon) != TL_OK) {
        return TL_ERR_STALE;
    }
    const uint32_t slot = (uint32_t)(ref >> POLYGON_BITS) & ((1u << SLOT_BITS) - 1), *first = read_first(pvs);
    if (slot >= pvs->slot_count || first[slot + 1] - first[slot] != tile->polygon_count ||
        tl_navmesh_polygon_ref(navmesh, slot, polygon) != ref) {
        return TL_ERR_ARGUMENT;
    }
    *number_out = first[slot] + polygon;
    return TL_OK;
}

tl_result tl_nav_pvs_sees(const tl_nav_pvs *pvs, const tl_navmesh *navmesh, tl_nav_ref a, tl_nav_ref b, bool *seen_out)
{
    uint32_t from, to;
    if (seen_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *seen_out = false;
    if (pvs == NULL || navmesh == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(polygon_number(pvs, navmesh, a, &from));
    TL_TRY(polygon_number(pvs, navmesh, b, &to));
    *seen_out = get_bit(read_row(pvs, from), to);
    return TL_OK;
}

tl_result tl_nav_pvs_seen_from(const tl_nav_pvs *pvs, const tl_navmesh *navmesh, tl_nav_ref from,
                               tl_nav_ref *polygons_out, uint32_t capacity, uint32_t *count_out)
{
    uint32_t number, count = 0;
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (pvs == NULL || navmesh == NULL || (polygons_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(polygon_number(pvs, navmesh, from, &number));
    const uint64_t *row = read_row(pvs, number);
    const uint32_t *first = read_first(pvs);
    for (uint32_t slot = 0; slot < pvs->slot_count; slot++) {
        for (uint32_t at = first[slot]; at < first[slot + 1]; at++) {
            if (get_bit(row, at)) {
                if (count < capacity) {
                    polygons_out[count] = tl_navmesh_polygon_ref(navmesh, slot, at - first[slot]);
                }
                count++;
            }
        }
    }
    *count_out = count;
    return count <= capacity ? TL_OK : TL_INCOMPLETE;
}
