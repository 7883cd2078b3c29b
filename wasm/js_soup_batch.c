// SPDX-License-Identifier: MIT
//
// Many rays or segments in one call. Hits leave as an array a quantity, since JavaScript copies whole arrays as fast as
// memory, while a loop over records took it longer than a camera's ray takes the module.

#include "js_slot.h"

#include <assert.h>

/// Numbers of a hit beside those of its ray: what a batch's arrays take.
typedef struct hit_arrays {
    float *t;
    uint32_t *triangle;
    float *uv;     // two each
    float *normal; // three each
    uint16_t *material;
    uint8_t *back;
} hit_arrays;

enum { HIT_ARRAYS_SIZE = 31 }; // bytes a hit, all arrays

static_assert(sizeof(tl_segment) <= sizeof(tl_ray), "room of js_batch_room");

/// Room for a batch: `count` rays of seven floats or segments of six, their hits, and the arrays. NULL: out of memory.
tl_ray *TL_JS_EXPORT(js_batch_room)(uint32_t count)
{
    const uint64_t size = (uint64_t)count * (sizeof(tl_ray) + sizeof(tl_ray_hit) + HIT_ARRAYS_SIZE);
    return size > SIZE_MAX ? NULL : tl_js_buffer_room((size_t)size);
}

// A filter's function is JavaScript's, which other threads cannot call.
static const tl_host *host_of(const tl_ray_filter *filter)
{
    return filter == NULL || filter->accept == NULL ? tl_js_host() : NULL;
}

static tl_ray_hit *hits_of(void *room, uint32_t count)
{
    return (tl_ray_hit *)(void *)((tl_ray *)room + count);
}

// The arrays behind the hits, largest elements first. Returns the first.
static float *spread_hits(const tl_ray_hit *hits, uint32_t count)
{
    hit_arrays to = { .t = (float *)(void *)(uintptr_t)(hits + count) };
    to.triangle = (uint32_t *)(void *)(to.t + count);
    to.uv = (float *)(void *)(to.triangle + count);
    to.normal = to.uv + 2 * (size_t)count;
    to.material = (uint16_t *)(void *)(to.normal + 3 * (size_t)count);
    to.back = (uint8_t *)(to.material + count);
    for (uint32_t i = 0; i < count; i++) {
        const tl_ray_hit *h = &hits[i];
        to.t[i] = h->t;
        to.triangle[i] = h->triangle;
        to.uv[2 * i] = h->u;
        to.uv[2 * i + 1] = h->v;
        to.normal[3 * i] = h->normal.x;
        to.normal[3 * i + 1] = h->normal.y;
        to.normal[3 * i + 2] = h->normal.z;
        to.material[i] = h->material;
        to.back[i] = h->back;
    }
    return to.t;
}

/// Casts the rays of js_batch_room. Returns the arrays of their hits: t, triangle, u and v, normal, material, back.
float *TL_JS_EXPORT(js_soup_cast_rays)(const tl_soup *soup, tl_ray *rays, uint32_t count, const tl_ray_filter *filter)
{
    tl_ray_hit *hits = hits_of(rays, count);
    tl_soup_cast_rays(soup, rays, count, filter, host_of(filter), hits);
    return spread_hits(hits, count);
}

/// The same of segments.
float *TL_JS_EXPORT(js_soup_cast_segments)(const tl_soup *soup, tl_segment *segments, uint32_t count,
                                           const tl_ray_filter *filter)
{
    tl_ray_hit *hits = hits_of(segments, count);
    tl_soup_cast_segments(soup, segments, count, filter, host_of(filter), hits);
    return spread_hits(hits, count);
}

/// Whether each ray of js_batch_room hits anything: a byte each.
bool *TL_JS_EXPORT(js_soup_occluded_rays)(const tl_soup *soup, tl_ray *rays, uint32_t count,
                                          const tl_ray_filter *filter)
{
    bool *occluded = (bool *)hits_of(rays, count);
    tl_soup_occluded_rays(soup, rays, count, filter, host_of(filter), occluded);
    return occluded;
}

/// Whether each segment of js_batch_room is clear: a byte each.
bool *TL_JS_EXPORT(js_soup_lines_of_sight)(const tl_soup *soup, tl_segment *segments, uint32_t count,
                                           const tl_ray_filter *filter)
{
    bool *clear = (bool *)hits_of(segments, count);
    tl_soup_lines_of_sight(soup, segments, count, filter, host_of(filter), clear);
    return clear;
}
