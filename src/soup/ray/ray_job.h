// SPDX-License-Identifier: MIT
//
// One ray in flight through a soup.
//
// A query has three parts. Boxes and leaves are filtered in float, conservatively: what they reject is proven to be no
// hit, however operations round. What passes is decided in double, exactly where signs matter (ray_decide.c). So the
// filters may differ between instruction sets, and the answers do not.

#ifndef TALUS_SRC_SOUP_RAY_JOB_H
#define TALUS_SRC_SOUP_RAY_JOB_H

#include "base/cpu.h"
#include "soup/layout/compact_layout.h"

#include <float.h>
#include <math.h>
#include <string.h>

/// Three coordinates and a spare lane: stored as one vector, read one by one.
typedef union tl_ray_point {
    tl_vec3 point;
    float lane[4];
} tl_ray_point;

/// How a box t follows from a t: (t - start) * scale.
typedef struct tl_ray_box_t {
    double start; ///< t of where the filters' origin lies, and box t begins: not 0 for rays from far away
    float scale;  ///< power of two
    float margin; ///< box t that the rounding of a denormal t, and underflow, may take from a box
} tl_ray_box_t;

typedef struct tl_ray_job {
    const tl_soup *soup;
    const tl_ray_filter *filter; ///< NULL: ignores nothing
    _Alignas(16) tl_ray_point origin;
    tl_ray_point target; ///< a ray's direction or a segment's end
    bool is_segment;     ///< direction is target - origin, not rounded; t is within [0, 1]
    bool is_exact;       ///< direction, exact_shear and inverse_z are filled

    bool has_intervals; ///< t can be told apart in float: nothing overflows, t cannot saturate, nor a denormal t lose
                        ///< more than ray_walk.inl allows for

    // Boxes. Plane p of axis i is met at t = (p * plane_scale[i] + near_base[i]) / box_t.scale, rounded down, or with
    // far_base up. Lane 3 is not used. Vectors are aligned, so that a store is forwarded to the load of a lane.
    _Alignas(16) float plane_scale[4];
    float near_base[4];
    float far_base[4];
    uint32_t backward; ///< bit i: the ray runs down along axis i, so it enters a box by its max plane
    uint32_t outside;  ///< bit i: along axis i the ray begins outside the soup's box
    tl_ray_box_t box_t;
    float box_limit; ///< boxes that begin beyond it are skipped

    // Leaves: origin moved to zero, then sheared so that the ray runs along the last of the axes.
    float per_depth;                   ///< box t a metre along that axis
    _Alignas(16) float leaf_origin[4]; ///< along the axes
    float shear[4];                    ///< direction by its component along the last axis
    const uint32_t *axes;              ///< three, in the order of x, y, z
    float reach;        ///< metres: the largest distance along an axis from the origin to a corner of the soup's box
    float corner_error; ///< metres: bound of the error of a sheared corner

    // The exact part, filled when the first lane is decided.
    double direction[3];
    double exact_shear[2];
    double inverse_z; ///< 1 / direction along the last axis

    // The best so far. t begins as tmax, so the first hit at tmax itself still wins by its index.
    float t;
    uint32_t triangle; ///< UINT32_MAX: none
    float u, v;
    bool back;
    double normal[3]; ///< of no particular length
} tl_ray_job;

/// The box t beyond which no hit is reported at `t` or before. A saturated t says nothing about where the hit is.
static inline float tl_ray_box_limit(const tl_ray_job *job, float t)
{
    if (!(t < FLT_MAX)) {
        return INFINITY;
    }
    if (job->box_t.start != 0.0) {
        // Roundings of the reported t and of the start.
        double from_start = (double)t * (1.0 + 0x1p-22) - job->box_t.start;
        return (float)(from_start * (double)job->box_t.scale * (1.0 + 0x1p-23)) + job->box_t.margin;
    }
    return t * job->box_t.scale + job->box_t.margin;
}

/// Fills what the filters need; the caller has set soup, filter, is_segment and t. False: nothing can be hit.
/// The walks have it inline (ray_prepare.h).
bool tl_ray_prepare(tl_ray_job *job, tl_vec3 origin, tl_vec3 target);

/// The rare cases of it, with origin and target set: directions that need scaling, and origins too far away for the
/// float filters.
bool tl_ray_prepare_unusual(tl_ray_job *job);

/// Moves the filters' origin of a ray from far away close to the soup's box. False: the ray surely misses the box.
bool tl_ray_approach(tl_ray_job *job);

/// Decides one lane of a leaf, all triangles that coincide there. If one is hit, and better than the best so far, it
/// becomes the best.
bool tl_ray_decide(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t lane);

/// Decides a triangle of a lane, given by its id word.
bool tl_ray_decide_triangle(tl_ray_job *job, const tl_soup_leaf *leaf, uint32_t lane, uint32_t id);

/// Describes the best hit.
void tl_ray_describe(const tl_ray_job *job, tl_ray_hit *hit_out);

/// Prepares a ray and walks the BVH, compiled once per instruction set. `target` is a direction, or a segment's end.
/// Without `hit_out` it returns at the first hit. True: something was hit.
typedef bool tl_ray_walk_fn(const tl_soup *soup, const tl_vec3 *origin, const tl_vec3 *target, float tmax,
                            bool is_segment, const tl_ray_filter *filter, tl_ray_hit *hit_out);

tl_ray_walk_fn tl_ray_walk_scalar;
#if TL_CPU_LEVELS >= 1
tl_ray_walk_fn tl_ray_walk_vec128;
#endif
#if TL_CPU_LEVELS >= 2
tl_ray_walk_fn tl_ray_walk_avx2, tl_ray_walk_avx512;
#endif

/// Rays or segments of one call, for closest hits or any.
typedef struct tl_ray_batch {
    const tl_soup *soup;
    const tl_ray *rays; ///< NULL: segments
    const tl_segment *segments;
    uint32_t count;
    const tl_ray_filter *filter;
    tl_ray_hit *hits; ///< closest hits; NULL: any will do
    bool *answers;    ///< then: `when_met` where there is one
    bool when_met;
} tl_ray_batch;

/// Several rays in flight at once, each on its own way, compiled once per instruction set (ray_walk_interleaved.inl).
/// The soup has the plain layout.
typedef void tl_ray_walk_many_fn(const tl_ray_batch *batch);

tl_ray_walk_many_fn tl_ray_walk_many_scalar;
#if TL_CPU_LEVELS >= 1
tl_ray_walk_many_fn tl_ray_walk_many_vec128;
#endif
#if TL_CPU_LEVELS >= 2
tl_ray_walk_many_fn tl_ray_walk_many_avx2, tl_ray_walk_many_avx512;
#endif

/// Coherent rays in packets, others by tl_ray_batch_apart, compiled once per instruction set (ray_walk_packet.inl). The
/// soup has the plain layout, the filter is NULL, and there are 2^16 rays at most.
typedef void tl_ray_packets_fn(const tl_ray_batch *batch);

tl_ray_packets_fn tl_ray_packets_scalar;
#if TL_CPU_LEVELS >= 1
tl_ray_packets_fn tl_ray_packets_vec128;
#endif
#if TL_CPU_LEVELS >= 2
tl_ray_packets_fn tl_ray_packets_avx2, tl_ray_packets_avx512;
#endif

/// Traces one ray of a batch alone, as single calls do.
void tl_ray_batch_one(const tl_ray_batch *batch, uint32_t index);

/// Traces the rays from `first` to `end` that have nothing in common.
void tl_ray_batch_apart(const tl_ray_batch *batch, uint32_t first, uint32_t end);

/// What a batch reports for a ray that hits nothing.
static inline void tl_ray_miss(tl_ray_hit *hit)
{
    memset(hit, 0, sizeof *hit);
    hit->t = INFINITY;
    hit->triangle = TL_NO_TRIANGLE;
}

/// Writes the answer of a batch's ray; a closest hit is written already.
static inline void tl_ray_report(const tl_ray_batch *batch, uint32_t index, bool met)
{
    if (batch->hits == NULL) {
        batch->answers[index] = met == batch->when_met;
    } else if (!met) {
        tl_ray_miss(&batch->hits[index]);
    }
}

/// Where a ray of a batch begins, its direction or end, and how far it reaches.
static inline void tl_ray_of_batch(const tl_ray_batch *batch, uint32_t index, const tl_vec3 **origin_out,
                                   const tl_vec3 **target_out, float *tmax_out)
{
    bool is_ray = batch->rays != NULL;
    *origin_out = is_ray ? &batch->rays[index].origin : &batch->segments[index].a;
    *target_out = is_ray ? &batch->rays[index].direction : &batch->segments[index].b;
    *tmax_out = is_ray ? batch->rays[index].tmax : 1.0f;
}

/// Instruction sets, ascending: the levels of base/cpu.h.
typedef enum tl_ray_isa { TL_RAY_SCALAR, TL_RAY_VEC128, TL_RAY_AVX2, TL_RAY_AVX512, TL_RAY_ISA_COUNT } tl_ray_isa;

/// The walk for an instruction set, or NULL where this machine or build lacks it.
tl_ray_walk_fn *tl_ray_walk_for(tl_ray_isa isa);

tl_ray_walk_many_fn *tl_ray_walk_many_for(tl_ray_isa isa);
tl_ray_packets_fn *tl_ray_packets_for(tl_ray_isa isa);

/// The instruction set that the public queries use on this machine.
tl_ray_isa tl_ray_best_isa(void);

/// What they run: walks of that instruction set; several rays at once, and packets, of the widest.
tl_ray_walk_fn *tl_ray_best_walk(void);
tl_ray_walk_many_fn *tl_ray_best_walk_many(void);
tl_ray_packets_fn *tl_ray_best_packets(void);

/// The public queries with a walk of the caller's choice.
bool tl_soup_cast_ray_with(tl_ray_walk_fn *walk, const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter,
                           tl_ray_hit *hit_out);
bool tl_soup_occluded_with(tl_ray_walk_fn *walk, const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter);
bool tl_soup_cast_segment_with(tl_ray_walk_fn *walk, const tl_soup *soup, tl_vec3 a, tl_vec3 b,
                               const tl_ray_filter *filter, tl_ray_hit *hit_out);
bool tl_soup_line_of_sight_with(tl_ray_walk_fn *walk, const tl_soup *soup, tl_vec3 a, tl_vec3 b,
                                const tl_ray_filter *filter);

#endif
