// SPDX-License-Identifier: MIT
//
// All hits of a ray, nearest first.
//
// Each triangle is decided for itself, by the code that decides for the closest hit. The hits go into the caller's
// buffer as a heap whose root is the farthest, so that a buffer that is too small ends up with the nearest ones; the
// heap is then sorted in place.

#include "base/assert.h"
#include "base/min_max.h"
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

#define TL_HEAP(name)                 farthest_hit_##name
#define TL_HEAP_ITEM                  tl_ray_hit
#define TL_HEAP_BEFORE(context, a, b) is_farther(&(a), &(b))
#include "base/heap.inl"

static void sort_hits(tl_ray_hit *heap, uint32_t count)
{
    while (count > 1) {
        tl_ray_hit farthest = farthest_hit_pop(heap, &count, NULL);
        heap[count] = farthest;
    }
}

static bool is_hit(const tl_walk_triangle *triangle, void *user)
{
    collector *c = user;
    // As if nothing were hit yet.
    c->job.t = c->tmax;
    c->job.triangle = UINT32_MAX;
    return tl_ray_decide_triangle(&c->job, triangle->leaf->leaf, triangle->lane, tl_walk_id(triangle)) &&
           (c->rule == TL_HITS_TOUCHED || tl_moved_line_crosses(c->origin, c->direction, triangle->corners));
}

// Called right after is_hit, so the job still holds the hit.
static bool collect_hit(const tl_walk_triangle *triangle, void *user)
{
    collector *c = user;
    (void)triangle;
    tl_ray_hit hit;
    tl_ray_describe(&c->job, &hit);
    if (c->count < c->capacity) {
        farthest_hit_sift_up(c->hits, c->count, hit, NULL);
    } else if (c->capacity > 0 && is_farther(&c->hits[0], &hit)) {
        farthest_hit_sift_down(c->hits, c->capacity, 0, hit, NULL);
    }
    c->count++;
    return true;
}

tl_result tl_soup_cast_ray_all(const tl_soup *soup, const tl_ray *ray, tl_hit_rule rule, const tl_ray_filter *filter,
                               tl_ray_hit *hits_out, uint32_t capacity, uint32_t *count_out)
{
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (soup == NULL || ray == NULL || (hits_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
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
        tl_region_memory memory;
        tl_region region = { .enter = tl_region_enter_line,
                             .region = &line,
                             .belongs = is_hit,
                             .found = collect_hit,
                             .user = &c,
                             .memory = &memory };
        tl_region_walk(soup, &region);
    }
    sort_hits(hits_out, tl_min_u32(c.count, capacity));
    *count_out = c.count;
    return c.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
