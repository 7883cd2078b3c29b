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

#include "hull/bake/quickhull.h"

#include "base/assert.h"

#include <string.h>

static void file_under(tl_quickhull *hull, uint32_t face, uint32_t point, double value)
{
    tl_quickhull_conflicts *conflicts = &hull->conflicts[face];
    hull->local[point].next = conflicts->first;
    conflicts->first = point;
    if (point >= hull->point_count) {
        return;
    }
    if (conflicts->farthest == TL_NONE || value > conflicts->farthest_value ||
        (value == conflicts->farthest_value && point < conflicts->farthest)) {
        conflicts->farthest = point;
        conflicts->farthest_value = value;
    }
}

tl_result tl_quickhull_file_all(tl_quickhull *hull, const uint32_t seed[4])
{
    hull->waiting = hull->point_count;
    for (uint32_t p = 0; p < hull->point_count + hull->passive_count; p++) {
        TL_TRY(tl_quickhull_count_work(hull, 1));
        if (p == seed[0] || p == seed[1] || p == seed[2] || p == seed[3]) {
            hull->waiting--;
            continue;
        }
        uint32_t f = 0;
        for (; f < 4; f++) {
            double value;
            if (tl_quickhull_side(hull, &hull->faces[f], hull->local[p].position, &value) > 0) {
                file_under(hull, f, p, value);
                break;
            }
        }
        hull->waiting -= f == 4 && p < hull->point_count;
    }
    return TL_OK;
}

// Files a point under one of the created faces that it is in front of: the first one, or when each_farthest that from
// whose plane it lies farthest. False: it is in front of none.
static bool file_under_created(tl_quickhull *hull, uint32_t point)
{
    const tl_vec3 position = hull->local[point].position;
    uint32_t best = TL_NONE;
    double best_distance = -(double)INFINITY, best_value = 0.0;
    for (uint32_t k = 0; k < hull->created_count; k++) {
        const uint32_t face = hull->created[k];
        double value;
        if (tl_quickhull_side(hull, &hull->faces[face], position, &value) <= 0) {
            continue;
        }
        if (!hull->each_farthest) {
            file_under(hull, face, point, value);
            return true;
        }
        const double distance = value / tl_side_plane_length(&hull->faces[face].plane);
        if (distance > best_distance) {
            best = face;
            best_distance = distance;
            best_value = value;
        }
    }
    if (best != TL_NONE) {
        file_under(hull, best, point, best_value);
    }
    return best != TL_NONE;
}

tl_result tl_quickhull_refile(tl_quickhull *hull)
{
    // The new point lies in the planes of all created faces: it needs no test, and a test would be the costly case.
    uint32_t eye = hull->faces[hull->created[0]].vertex[2];
    for (uint32_t i = 0; i < hull->visible_count; i++) {
        uint32_t p = hull->conflicts[hull->visible[i]].first;
        while (p != TL_NONE) {
            uint32_t next = hull->local[p].next;
            TL_TRY(tl_quickhull_count_work(hull, 1));
            const bool is_outside = p != eye && file_under_created(hull, p);
            hull->waiting -= !is_outside && p < hull->point_count; // inside, or on the surface
            p = next;
        }
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
    const double distance = conflicts->farthest_value / tl_side_plane_length(&hull->faces[face].plane);
    // Of a face so small that its normal is zero in double nothing is known: it comes first.
    tl_quickhull_entry entry = { isnan(distance) ? (double)INFINITY : distance, face, conflicts->farthest };
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
