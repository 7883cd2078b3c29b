// SPDX-License-Identifier: MIT
//
// Many rays or segments in one call. Hits leave as an array a quantity, since JavaScript copies whole arrays as fast as
// memory, while a loop over records took it longer than a camera's ray takes the module.
//
// Blocks of them are tasks, smaller ones than the library's own: a page asks for some thousands at once, of which those
// would leave all threads but one without work in the end. A block's hits go to the arrays while the cache has them.

#include "js_slot.h"
#include "js_threads.h"

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

// A batch of a few blocks is done before a thread is awake.
enum { BLOCK_RAYS = 256, FEW_BLOCKS = 4 };

/// A batch in the module's room: rays or segments, and what becomes of them.
typedef struct ray_job {
    const tl_soup *soup;
    const tl_ray_filter *filter;
    const tl_ray *rays;         ///< NULL: segments
    const tl_segment *segments; ///< NULL: rays
    uint32_t count;
    tl_ray_hit *hits; ///< NULL: answers
    hit_arrays to;    ///< of hits
    bool *answers;    ///< of occluded rays, or of clear segments
} ray_job;

static void spread_hits(const ray_job *job, uint32_t first, uint32_t end)
{
    const hit_arrays *to = &job->to;
    for (uint32_t i = first; i < end; i++) {
        const tl_ray_hit *h = &job->hits[i];
        to->t[i] = h->t;
        to->triangle[i] = h->triangle;
        to->uv[2 * i] = h->u;
        to->uv[2 * i + 1] = h->v;
        to->normal[3 * i] = h->normal.x;
        to->normal[3 * i + 1] = h->normal.y;
        to->normal[3 * i + 2] = h->normal.z;
        to->material[i] = h->material;
        to->back[i] = h->back;
    }
}

static void cast_block(uint32_t block, uint32_t worker, void *user)
{
    const ray_job *job = user;
    (void)worker;
    const uint32_t first = block * BLOCK_RAYS, left = job->count - first, count = left < BLOCK_RAYS ? left : BLOCK_RAYS;
    if (job->hits == NULL && job->rays != NULL) {
        tl_soup_occluded_rays(job->soup, job->rays + first, count, job->filter, NULL, job->answers + first);
    } else if (job->hits == NULL) {
        tl_soup_lines_of_sight(job->soup, job->segments + first, count, job->filter, NULL, job->answers + first);
    } else if (job->rays != NULL) {
        tl_soup_cast_rays(job->soup, job->rays + first, count, job->filter, NULL, job->hits + first);
    } else {
        tl_soup_cast_segments(job->soup, job->segments + first, count, job->filter, NULL, job->hits + first);
    }
    if (job->hits != NULL) {
        spread_hits(job, first, first + count);
    }
}

// A filter's function is JavaScript's, which other threads cannot call.
static void cast_all(ray_job *job)
{
    const uint32_t blocks = job->count / BLOCK_RAYS + (job->count % BLOCK_RAYS != 0);
    const tl_tasks *tasks = job->filter == NULL || job->filter->accept == NULL ? tl_js_tasks() : NULL;
    if (tasks != NULL && blocks > FEW_BLOCKS) {
        tasks->run(cast_block, blocks, job, tasks->user);
        return;
    }
    for (uint32_t block = 0; block < blocks; block++) {
        cast_block(block, 0, job);
    }
}

// Hits and arrays stand behind the rays or segments; of arrays those with the largest elements are the first.
static float *cast_hits(ray_job *job, void *room)
{
    const uint32_t count = job->count;
    job->hits = (tl_ray_hit *)(void *)((tl_ray *)room + count);
    job->to.t = (float *)(void *)(job->hits + count);
    job->to.triangle = (uint32_t *)(void *)(job->to.t + count);
    job->to.uv = (float *)(void *)(job->to.triangle + count);
    job->to.normal = job->to.uv + 2 * (size_t)count;
    job->to.material = (uint16_t *)(void *)(job->to.normal + 3 * (size_t)count);
    job->to.back = (uint8_t *)(job->to.material + count);
    cast_all(job);
    return job->to.t;
}

static bool *cast_answers(ray_job *job, void *room)
{
    job->answers = (bool *)((tl_ray *)room + job->count);
    cast_all(job);
    return job->answers;
}

/// Casts the rays of js_batch_room. Returns the arrays of their hits: t, triangle, u and v, normal, material, back.
float *TL_JS_EXPORT(js_soup_cast_rays)(const tl_soup *soup, tl_ray *rays, uint32_t count, const tl_ray_filter *filter)
{
    ray_job job = { .soup = soup, .filter = filter, .rays = rays, .count = count };
    return cast_hits(&job, rays);
}

/// The same of segments.
float *TL_JS_EXPORT(js_soup_cast_segments)(const tl_soup *soup, tl_segment *segments, uint32_t count,
                                           const tl_ray_filter *filter)
{
    ray_job job = { .soup = soup, .filter = filter, .segments = segments, .count = count };
    return cast_hits(&job, segments);
}

/// Whether each ray of js_batch_room hits anything: a byte each.
bool *TL_JS_EXPORT(js_soup_occluded_rays)(const tl_soup *soup, tl_ray *rays, uint32_t count,
                                          const tl_ray_filter *filter)
{
    ray_job job = { .soup = soup, .filter = filter, .rays = rays, .count = count };
    return cast_answers(&job, rays);
}

/// Whether each segment of js_batch_room is clear: a byte each.
bool *TL_JS_EXPORT(js_soup_lines_of_sight)(const tl_soup *soup, tl_segment *segments, uint32_t count,
                                           const tl_ray_filter *filter)
{
    ray_job job = { .soup = soup, .filter = filter, .segments = segments, .count = count };
    return cast_answers(&job, segments);
}
