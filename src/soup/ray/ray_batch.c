// SPDX-License-Identifier: MIT
//
// Many rays in one call, with the bits of single calls: slices on the host's tasks; in a slice coherent rays in packets
// (ray_walk_packet.inl), and the others several in flight at once (ray_walk_interleaved.inl).
//
// Rejected: sorting the rays of a slice by a Morton code of origin and direction. It gains a sixth in a soup of ten
// million triangles, nothing at three million, and costs a sixth at one million and half a ray's time below, even where
// all rays begin in 64 places: once rays hide each other's cache misses, what is left to gain is less than the sort and
// the jumps from ray to ray.

#include "base/assert.h"
#include "base/host.h"
#include "soup/ray/ray_filter.h"
#include "soup/ray/ray_job.h"

// Some 50 to 100 us of one thread: a batch of a few thousand still has work for all, and the last slice is not waited
// for.
enum { SLICE_RAYS = 1 << 9 };

// A packet numbers children by node * 16 + lane, in 32 bits.
#define PACKET_MAX_NODES (1u << 28)

void tl_ray_batch_one(const tl_ray_batch *batch, uint32_t index)
{
    tl_ray_walk_fn *walk = tl_ray_best_walk();
    const tl_vec3 *origin, *target;
    float tmax;
    tl_ray_of_batch(batch, index, &origin, &target, &tmax);
    tl_ray_hit *hit = batch->hits != NULL ? &batch->hits[index] : NULL;
    tl_ray_report(batch, index, walk(batch->soup, origin, target, tmax, batch->rays == NULL, batch->filter, hit));
}

// The rays from `first` to `end` as a batch.
static tl_ray_batch part_of(const tl_ray_batch *all, uint32_t first, uint32_t end)
{
    tl_ray_batch part = *all;
    part.rays = all->rays != NULL ? all->rays + first : NULL;
    part.segments = all->segments != NULL ? all->segments + first : NULL;
    part.hits = all->hits != NULL ? all->hits + first : NULL;
    part.answers = all->answers != NULL ? all->answers + first : NULL;
    part.count = end - first;
    return part;
}

void tl_ray_batch_apart(const tl_ray_batch *batch, uint32_t first, uint32_t end)
{
    if (batch->soup->layout == TL_SOUP_FAST && end - first > 1) {
        tl_ray_batch part = part_of(batch, first, end);
        tl_ray_best_walk_many()(&part);
        return;
    }
    for (uint32_t i = first; i < end; i++) {
        tl_ray_batch_one(batch, i);
    }
}

static void trace_slice(uint32_t slice, uint32_t worker, void *user)
{
    const tl_ray_batch *all = user;
    (void)worker;
    tl_ray_batch part = part_of(all, slice * SLICE_RAYS, tl_block_end(slice, SLICE_RAYS, all->count));
    bool packets = all->filter == NULL && all->soup->layout == TL_SOUP_FAST && all->soup->node_count < PACKET_MAX_NODES;
    if (packets) {
        tl_ray_best_packets()(&part);
    } else {
        tl_ray_batch_apart(&part, 0, part.count);
    }
}

static void trace_batch(tl_ray_batch *batch, const tl_host *host)
{
    batch->filter = tl_ray_filter_in_use(batch->soup, batch->filter);
    tl_run_tasks(host, trace_slice, tl_block_count(batch->count, SLICE_RAYS), batch);
}

void tl_soup_cast_rays(const tl_soup *soup, const tl_ray *rays, uint32_t count, const tl_ray_filter *filter,
                       const tl_host *host, tl_ray_hit *hits_out)
{
    TL_ASSERT(soup != NULL && (count == 0 || (rays != NULL && hits_out != NULL)));
    tl_ray_batch batch = { soup, rays, NULL, count, filter, hits_out, NULL, true };
    trace_batch(&batch, host);
}

void tl_soup_cast_segments(const tl_soup *soup, const tl_segment *segments, uint32_t count, const tl_ray_filter *filter,
                           const tl_host *host, tl_ray_hit *hits_out)
{
    TL_ASSERT(soup != NULL && (count == 0 || (segments != NULL && hits_out != NULL)));
    tl_ray_batch batch = { soup, NULL, segments, count, filter, hits_out, NULL, true };
    trace_batch(&batch, host);
}

void tl_soup_occluded_rays(const tl_soup *soup, const tl_ray *rays, uint32_t count, const tl_ray_filter *filter,
                           const tl_host *host, bool *occluded_out)
{
    TL_ASSERT(soup != NULL && (count == 0 || (rays != NULL && occluded_out != NULL)));
    tl_ray_batch batch = { soup, rays, NULL, count, filter, NULL, occluded_out, true };
    trace_batch(&batch, host);
}

void tl_soup_lines_of_sight(const tl_soup *soup, const tl_segment *segments, uint32_t count,
                            const tl_ray_filter *filter, const tl_host *host, bool *clear_out)
{
    TL_ASSERT(soup != NULL && (count == 0 || (segments != NULL && clear_out != NULL)));
    tl_ray_batch batch = { soup, NULL, segments, count, filter, NULL, clear_out, false };
    trace_batch(&batch, host);
}
