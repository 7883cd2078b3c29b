// SPDX-License-Identifier: MIT
//
// Guarded outlines: where floors were taken away from under the simplifier's feet, an outline may only draw back.
//
// Douglas-Peucker moves an outline by up to max_error to both sides. Beside walls that is the tolerance that settings
// ask for; beside an obstacle's floors, of which a distance was promised, it would walk an agent into the obstacle. So
// near these a chord must not have traced vertices on its floor's side: what it gains would lie beyond the trace. The
// other side keeps its tolerance. (Growing obstacles by max_error would keep the promise too, and close every passage
// that is narrower.)
//
// Near: within so many steps from floor to floor that whatever a chord gains lies nearer. What a chord gains is within
// max_error of it, and so within max_error + 1.5 columns of a traced vertex; steps go along x or z, so that a distance
// takes sqrt 2 times as many.

#include "nav_bake/contours/contours.h"

#include "base/assert.h"
#include "nav_bake/floors/links.h"

#include <math.h>
#include <string.h>

uint32_t tl_contours_guard_steps(const tl_nav_config *config)
{
    const double columns = (double)config->max_simplification_error + 1.5;
    const double steps = ceil(1.41421357 * columns) + 1.0;
    return steps < 1e9 ? (uint32_t)steps : 1000000000u;
}

// The next floor from `at` on that was taken away; span_count: none.
static uint32_t next_taken(const tl_nav_compact *compact, uint32_t at)
{
    const uint8_t *taken = (const uint8_t *)memchr(compact->taken + at, 1, compact->span_count - at);
    return taken != NULL ? (uint32_t)(taken - compact->taken) : compact->span_count;
}

tl_result tl_contours_find_guarded(tl_contour_work *work)
{
    const tl_nav_compact *compact = work->compact;
    const uint32_t span_count = compact->span_count;
    work->near = NULL;
    if (compact->taken == NULL) {
        return TL_OK;
    }
    uint8_t *near = TL_PUSH_ZERO(work->arena, uint8_t, span_count);
    uint32_t *queue = TL_PUSH(work->arena, uint32_t, (uint64_t)span_count + 1);
    if (near == NULL || queue == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t i = next_taken(compact, 0); i < span_count; i = next_taken(compact, i + 1)) {
        near[i] = 1;
        queue[count++] = i;
    }
    uint32_t at = 0;
    for (uint32_t left = tl_contours_guard_steps(work->config); left > 0 && at < count; left--) {
        for (const uint32_t end = count; at < end; at++) { // a ring a step
            const tl_links links = tl_nav_links_or_self(compact, queue[at]);
            for (uint32_t d = 0; d < 4; d++) {
                queue[count] = links.to[d]; // stays where it was not near yet; the queue has room for one more
                count += !near[links.to[d]];
                near[links.to[d]] = 1;
            }
        }
    }
    work->near = near;
    return TL_OK;
}

// Whether a chord runs past a traced vertex on the vertex's floor's side, or the vertex lies beyond the chord's ends.
static int64_t gain_at(const tl_contour_vertex *a, const tl_contour_vertex *b, const tl_contour_vertex *p)
{
    const int64_t side = tl_contour_area2(a, b, p);
    if (side != 0) {
        return -side; // the floor lies on the right
    }
    const int64_t abx = (int64_t)b->x - a->x, abz = (int64_t)b->z - a->z;
    const int64_t along = abx * ((int64_t)p->x - a->x) + abz * ((int64_t)p->z - a->z);
    return along < 0 || along > abx * abx + abz * abz ? 1 : 0;
}

uint32_t tl_contours_farthest_gain(const tl_contour_work *work, uint32_t begin, uint32_t end)
{
    uint32_t farthest = begin;
    int64_t largest = 0;
    if (work->guarded == NULL) {
        return begin;
    }
    for (uint32_t k = tl_contour_next(work, begin); k != end; k = tl_contour_next(work, k)) {
        const int64_t gain = work->guarded[k] && !work->keep[k]
                                 ? gain_at(&work->vertices[begin], &work->vertices[end], &work->vertices[k])
                                 : 0;
        if (gain > largest) {
            largest = gain;
            farthest = k;
        }
    }
    return farthest;
}
