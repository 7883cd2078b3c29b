// SPDX-License-Identifier: MIT
//
// All hits of a ray, nearest first.
//
// Each triangle is decided for itself, by the code that decides for the closest hit. The hits go into the caller's
// buffer as a heap whose root is the farthest, so that a buffer that is too small ends up with the nearest ones; the
// heap is then sorted in place.

#include "base/assert.h"
#include "soup/query/line_region.h"
#include "soup/ray/ray_job.h"
#include "soup/triangle/line_triangle.h"

typedef struct collector {
    tl_ray_job job;
    tl_vec3 origin, direction;
    float tmax;
    tl_hit_rule rule;
    tl_ray_hit *hits;
    uint32_t capacity;
    uint32_t count;
} collector;

static bool is_farther(const tl_ray_hit *a, const tl_ray_hit *b)
{
    return a->t > b->t || (a->t == b->t && a->triangle > b->triangle);
}

static void swap_hits(tl_ray_hit *a, tl_ray_hit *b)
{
    tl_ray_hit c = *a;
    *a = *b;
    *b = c;
}

static void sift_up(tl_ray_hit *heap, uint32_t at)
{
    while (at > 0 && is_farther(&heap[at], &heap[(at - 1) / 2])) {
        swap_hits(&heap[at], &heap[(at - 1) / 2]);
        at = (at - 1) / 2;
    }
}

static void sift_down(tl_ray_hit *heap, uint32_t count)
{
    uint32_t at = 0;
    for (;;) {
        uint64_t child = 2 * (uint64_t)at + 1;
        if (child >= count) {
            return;
        }
        child += child + 1 < count && is_farther(&heap[child + 1], &heap[child]);
        if (!is_farther(&heap[child], &heap[at])) {
            return;
        }
        swap_hits(&heap[child], &heap[at]);
        at = (uint32_t)child;
    }
}

static void sort_heap(tl_ray_hit *heap, uint32_t count)
{
    for (uint32_t end = count; end > 1; end--) {
        swap_hits(&heap[0], &heap[end - 1]);
        sift_down(heap, end - 1);
    }
}

static bool belongs(const tl_walk_triangle *triangle, void *user)
{
    collector *c = user;
    // As if nothing had been hit yet.
    c->job.t = c->tmax;
    c->job.triangle = UINT32_MAX;
    return tl_ray_decide(&c->job, triangle->leaf->leaf, triangle->lane) &&
           (c->rule == TL_HITS_TOUCHED || tl_moved_line_crosses(c->origin, c->direction, triangle->corners));
}

// Follows upon belongs, so the job still holds the hit.
static bool collect(const tl_walk_triangle *triangle, void *user)
{
    collector *c = user;
    (void)triangle;
    tl_ray_hit hit;
    tl_ray_describe(&c->job, &hit);
    if (c->count < c->capacity) {
        c->hits[c->count] = hit;
        sift_up(c->hits, c->count);
    } else if (c->capacity > 0 && is_farther(&c->hits[0], &hit)) {
        c->hits[0] = hit;
        sift_down(c->hits, c->capacity);
    }
    c->count++;
    return true;
}

tl_result tl_soup_cast_ray_all(const tl_soup *soup, const tl_ray *ray, tl_hit_rule rule, const tl_ray_filter *filter,
                               tl_ray_hit *hits_out, uint32_t capacity, uint32_t *count_out)
{
    TL_ASSERT(soup != NULL && ray != NULL && count_out != NULL && (hits_out != NULL || capacity == 0));
    TL_TRY(tl_ray_check(ray));
    collector c = { .origin = ray->origin,
                    .direction = ray->direction,
                    .tmax = ray->tmax,
                    .rule = rule,
                    .hits = hits_out,
                    .capacity = capacity };
    c.job.soup = soup;
    c.job.filter = filter;
    c.job.is_segment = false;
    c.job.t = ray->tmax;
    if (tl_ray_prepare(&c.job, ray->origin, ray->direction)) {
        tl_line_region line;
        tl_line_region_make(ray, &line);
        tl_region region = { tl_region_enter_line, &line, belongs, collect, &c };
        tl_region_walk(soup, &region);
    }
    sort_heap(hits_out, c.count < capacity ? c.count : capacity);
    *count_out = c.count;
    return c.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
