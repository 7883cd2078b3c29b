// SPDX-License-Identifier: MIT
//
// Conflict lists: each point that is still outside is filed under one face that it lies strictly in front of.
//
// When faces are replaced by a cone, their points are tested against the cone's faces only. That is enough: a point
// that saw a removed face and still sees a kept one sees, walking from one to the other inside its visible region, both
// faces at some horizon edge, and the new face there lies between the two. The newest face is refined first: the step
// after it works on the same few faces and points, which are in the cache, and a point is refiled half as often as when
// faces wait in a ring. Clarkson, Shor, Applications of Random Sampling in Computational Geometry, 1989, keep all
// conflicts; one is enough. Of many points the farthest of all are added first (quickhull.c).

#include "hull/bake/file_points.h"

#include "base/assert.h"

#include <string.h>

// With fewer points outside, a step tests a handful: laying its planes side by side would take as long.
enum { FEWEST_WAITING = 256 };

tl_file_points_fn *tl_file_points_for(int level)
{
    static tl_file_points_fn *const kernels[] = {
        NULL,
#if TL_CPU_LEVELS >= 1
        tl_file_points_vec128,
#endif
#if TL_CPU_LEVELS >= 2
        tl_file_points_avx2,
        tl_file_points_avx2, // a step has too few faces for eight lanes
#endif
    };
    return tl_cpu_has_level(level) ? kernels[level] : NULL;
}

// Files a point under one of some faces that it is in front of: the first one, or when each_farthest that from whose
// plane it lies farthest. False: it is in front of none.
static bool file_under_any(tl_quickhull *hull, const uint32_t *faces, uint32_t count, uint32_t point)
{
    const tl_vec3 position = hull->local[point].position;
    uint32_t best = TL_NONE;
    double best_distance = 0.0, best_value = 0.0;
    for (uint32_t k = 0; k < count; k++) {
        double value;
        if (tl_quickhull_side(hull, &hull->faces[faces[k]], position, &value) <= 0) {
            continue;
        }
        if (!hull->each_farthest) {
            tl_file_under(hull, faces[k], point, value);
            return true;
        }
        const double distance = tl_filing_distance(value, tl_side_plane_length(&hull->faces[faces[k]].plane));
        if (best == TL_NONE || distance > best_distance) {
            best = faces[k];
            best_distance = distance;
            best_value = value;
        }
    }
    if (best != TL_NONE) {
        tl_file_under(hull, best, point, best_value);
    }
    return best != TL_NONE;
}

static tl_result file_list(tl_quickhull *hull, const uint32_t *faces, uint32_t count, uint32_t eye, uint32_t first)
{
    for (uint32_t p = first, next; p != TL_NONE; p = next) {
        next = hull->local[p].next;
        TL_TRY(tl_quickhull_count_work(hull, 1));
        const bool is_outside = p != eye && file_under_any(hull, faces, count, p);
        hull->waiting -= !is_outside && p < hull->point_count; // inside, or on the surface
    }
    return TL_OK;
}

// Planes side by side, where that is worth the trouble.
static bool make_filing(const tl_quickhull *hull, const uint32_t *faces, uint32_t count, uint32_t eye, tl_filing *f)
{
    if (hull->file_points == NULL || count > TL_MAX_FILED_FACES || hull->waiting < FEWEST_WAITING) {
        return false;
    }
    f->faces = faces;
    f->eye = eye;
    f->block_count = (count + 3) / 4;
    for (uint32_t k = 0; k < 4 * f->block_count; k++) {
        const tl_side_plane beyond = { { 0.0, 0.0, 0.0 }, (double)INFINITY, 0.0 };
        const tl_side_plane plane = k < count ? hull->faces[faces[k]].plane : beyond;
        tl_plane_block *block = &f->blocks[k / 4];
        block->x[k % 4] = plane.normal[0];
        block->y[k % 4] = plane.normal[1];
        block->z[k % 4] = plane.normal[2];
        block->offset[k % 4] = plane.offset;
        block->error[k % 4] = plane.error;
        block->length[k % 4] = hull->each_farthest ? tl_side_plane_length(&plane) : 0.0;
    }
    return true;
}

tl_result tl_quickhull_file_all(tl_quickhull *hull, const uint32_t seed[4])
{
    static const uint32_t faces[4] = { 0, 1, 2, 3 };
    uint32_t first = TL_NONE;
    hull->waiting = hull->point_count - 4;
    for (uint32_t p = hull->point_count + hull->passive_count; p-- > 0;) {
        if (p != seed[0] && p != seed[1] && p != seed[2] && p != seed[3]) {
            hull->local[p].next = first;
            first = p;
        }
    }
    tl_filing filing;
    return make_filing(hull, faces, 4, TL_NONE, &filing) ? hull->file_points(hull, &filing, first)
                                                         : file_list(hull, faces, 4, TL_NONE, first);
}

tl_result tl_quickhull_refile(tl_quickhull *hull)
{
    // The new point lies in the planes of all created faces: it needs no test, and a test would be the costly case.
    const uint32_t eye = hull->faces[hull->created[0]].vertex[2];
    tl_filing filing;
    const bool in_lanes = make_filing(hull, hull->created, hull->created_count, eye, &filing);
    for (uint32_t i = 0; i < hull->visible_count; i++) {
        const uint32_t first = hull->conflicts[hull->visible[i]].first;
        TL_TRY(in_lanes ? hull->file_points(hull, &filing, first)
                        : file_list(hull, hull->created, hull->created_count, eye, first));
    }
    for (uint32_t i = 0; i < hull->visible_count; i++) {
        tl_quickhull_free_face(hull, hull->visible[i]);
    }
    return TL_OK;
}

// A larger distance first; on ties the lower point, so that the order does not depend on the heap's shape.
static bool waits_before(const tl_quickhull_entry *a, const tl_quickhull_entry *b)
{
    if (a->distance != b->distance) {
        return a->distance > b->distance;
    }
    return a->point != b->point ? a->point < b->point : a->face < b->face;
}

#define TL_HEAP(name)                 waiting_##name
#define TL_HEAP_ITEM                  tl_quickhull_entry
#define TL_HEAP_BEFORE(context, a, b) waits_before(&(a), &(b))
#include "base/heap.inl"

static tl_result push_waiting_face(tl_quickhull *hull, uint32_t face)
{
    if (hull->heap_count == hull->heap_capacity) {
        tl_quickhull_entry *grown = tl_arena_grow(hull->arena, hull->heap, &hull->heap_capacity, 64, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        hull->heap = grown;
    }
    const tl_quickhull_conflicts *conflicts = &hull->conflicts[face];
    const double length = tl_side_plane_length(&hull->faces[face].plane);
    tl_quickhull_entry entry = { tl_filing_distance(conflicts->farthest_value, length), face, conflicts->farthest };
    waiting_push(hull->heap, &hull->heap_count, entry, NULL);
    return TL_OK;
}

static void list_waiting_face(tl_quickhull *hull, uint32_t face)
{
    tl_quickhull_conflicts *conflicts = &hull->conflicts[face];
    conflicts->newer = TL_NONE;
    conflicts->older = hull->newest;
    if (hull->newest != TL_NONE) {
        hull->conflicts[hull->newest].newer = face;
    }
    hull->newest = face;
}

tl_result tl_quickhull_enqueue(tl_quickhull *hull, uint32_t face)
{
    if (hull->conflicts[face].farthest == TL_NONE) {
        return TL_OK;
    }
    if (hull->farthest_first) {
        return push_waiting_face(hull, face);
    }
    list_waiting_face(hull, face);
    return TL_OK;
}

void tl_quickhull_end_order(tl_quickhull *hull)
{
    hull->farthest_first = false;
    for (uint32_t face = 0; face < hull->face_count; face++) {
        if (hull->conflicts[face].live && hull->conflicts[face].farthest != TL_NONE) {
            list_waiting_face(hull, face);
        }
    }
}

void tl_quickhull_unqueue(tl_quickhull *hull, uint32_t face)
{
    const tl_quickhull_conflicts *conflicts = &hull->conflicts[face];
    if (hull->farthest_first || conflicts->farthest == TL_NONE) {
        return;
    }
    if (conflicts->newer != TL_NONE) {
        hull->conflicts[conflicts->newer].older = conflicts->older;
    } else {
        hull->newest = conflicts->older;
    }
    if (conflicts->older != TL_NONE) {
        hull->conflicts[conflicts->older].newer = conflicts->newer;
    }
}

uint32_t tl_quickhull_dequeue(tl_quickhull *hull, double enough)
{
    if (!hull->farthest_first) {
        return hull->newest; // it leaves the list when it dies, for its farthest point sees it
    }
    while (hull->heap_count > 0 && hull->heap[0].distance > enough) {
        tl_quickhull_entry entry = waiting_pop(hull->heap, &hull->heap_count, NULL);
        const tl_quickhull_conflicts *conflicts = &hull->conflicts[entry.face];
        // An entry of a face that is gone, or whose place another one took, is dropped.
        if (conflicts->live && conflicts->first != TL_NONE && conflicts->farthest == entry.point) {
            return entry.face;
        }
    }
    return TL_NONE;
}
