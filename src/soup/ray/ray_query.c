// SPDX-License-Identifier: MIT
//
// The public ray queries: choose the walk and run it.
//
// The choice reads the processor's features each time (base/cpu.h): a load and a branch. A cached choice would be
// mutable global state; a choice stored in the soup would make its bytes depend on the machine.

#include "soup/ray/ray_job.h"

#include "base/assert.h"

#include <float.h>
#include <string.h>

tl_ray_walk_fn *tl_ray_walk_for(tl_ray_isa isa)
{
    static tl_ray_walk_fn *const walks[] = {
        tl_ray_walk_scalar,
#if TL_CPU_LEVELS >= 1
        tl_ray_walk_vec128,
#endif
#if TL_CPU_LEVELS >= 2
        tl_ray_walk_avx2,
        tl_ray_walk_avx512,
#endif
    };
    return tl_cpu_has_level((int)isa) ? walks[isa] : NULL;
}

tl_ray_walk_many_fn *tl_ray_walk_many_for(tl_ray_isa isa)
{
    static tl_ray_walk_many_fn *const walks[] = {
        tl_ray_walk_many_scalar,
#if TL_CPU_LEVELS >= 1
        tl_ray_walk_many_vec128,
#endif
#if TL_CPU_LEVELS >= 2
        tl_ray_walk_many_avx2,
        tl_ray_walk_many_avx512,
#endif
    };
    return tl_cpu_has_level((int)isa) ? walks[isa] : NULL;
}

tl_ray_packets_fn *tl_ray_packets_for(tl_ray_isa isa)
{
    static tl_ray_packets_fn *const packets[] = {
        tl_ray_packets_scalar,
#if TL_CPU_LEVELS >= 1
        tl_ray_packets_vec128,
#endif
#if TL_CPU_LEVELS >= 2
        tl_ray_packets_avx2,
        tl_ray_packets_avx512,
#endif
    };
    return tl_cpu_has_level((int)isa) ? packets[isa] : NULL;
}

// AVX-512 on AMD's processors: Zen 4 and later trace a ray 5 to 15 per cent faster with it. On Intel's Emerald Rapids
// it saves instructions and no time (7 to 14 per cent slower), so AVX2 is used there, and on unmeasured processors
// (bench_rays has a row for each). A machine with AVX-512 always has AVX2.
//
// Where the target decides, kernels are named and not looked up, so that a linker can leave the others out.
#if TL_CPU_LEVELS == 3
static inline tl_ray_walk_fn *walk_of_features(uint32_t found)
{
    if ((found & TL_CPU_AVX2) != 0) {
        bool wide = (found & TL_CPU_AMD) != 0 && (found & TL_CPU_AVX512) != 0;
        return wide ? tl_ray_walk_avx512 : tl_ray_walk_avx2;
    }
    return (found & TL_CPU_VEC128) != 0 ? tl_ray_walk_vec128 : tl_ray_walk_scalar;
}

// The first query's walk: it looks at the processor. A call in best_ray_walk would have every query save its registers.
static bool walk_first(const tl_soup *soup, const tl_vec3 *origin, const tl_vec3 *target, float tmax, bool is_segment,
                       const tl_ray_filter *filter, tl_ray_hit *hit_out)
{
    return walk_of_features(tl_cpu_look())(soup, origin, target, tmax, is_segment, filter, hit_out);
}
#endif

static inline tl_ray_walk_fn *best_ray_walk(void)
{
#if TL_CPU_LEVELS == 3
    const uint32_t found = __atomic_load_n(&tl_cpu_found, __ATOMIC_RELAXED);
    return found != 0 ? walk_of_features(found) : walk_first;
#elif TL_CPU_LEVELS == 1
    return tl_ray_walk_vec128;
#else
    return tl_ray_walk_scalar;
#endif
}

tl_ray_isa tl_ray_best_isa(void)
{
    tl_ray_isa isa = TL_RAY_SCALAR;
    while (tl_ray_walk_for(isa) != tl_ray_best_walk()) {
        isa = (tl_ray_isa)(isa + 1);
    }
    return isa;
}

tl_ray_walk_fn *tl_ray_best_walk(void)
{
#if TL_CPU_LEVELS == 3
    return walk_of_features(tl_cpu_features());
#else
    return best_ray_walk();
#endif
}

#if TL_CPU_LEVELS == 3
// What batches run: rays that do not wait for each other fill the lanes, on Intel's processors too.
static tl_ray_isa widest_isa(void)
{
    return (tl_ray_isa)tl_cpu_level_up_to(TL_CPU_LEVELS);
}
#endif

tl_ray_walk_many_fn *tl_ray_best_walk_many(void)
{
#if TL_CPU_LEVELS == 3
    return tl_ray_walk_many_for(widest_isa());
#elif TL_CPU_LEVELS == 1
    return tl_ray_walk_many_vec128;
#else
    return tl_ray_walk_many_scalar;
#endif
}

tl_ray_packets_fn *tl_ray_best_packets(void)
{
#if TL_CPU_LEVELS == 3
    return tl_ray_packets_for(widest_isa());
#elif TL_CPU_LEVELS == 1
    return tl_ray_packets_vec128;
#else
    return tl_ray_packets_scalar;
#endif
}

bool tl_soup_cast_ray_with(tl_ray_walk_fn *walk, const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter,
                           tl_ray_hit *hit_out)
{
    TL_ASSERT(soup != NULL && ray != NULL && hit_out != NULL);
    return walk(soup, &ray->origin, &ray->direction, ray->tmax, false, filter, hit_out);
}

bool tl_soup_occluded_with(tl_ray_walk_fn *walk, const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter)
{
    TL_ASSERT(soup != NULL && ray != NULL);
    return walk(soup, &ray->origin, &ray->direction, ray->tmax, false, filter, NULL);
}

bool tl_soup_cast_segment_with(tl_ray_walk_fn *walk, const tl_soup *soup, tl_vec3 a, tl_vec3 b,
                               const tl_ray_filter *filter, tl_ray_hit *hit_out)
{
    TL_ASSERT(soup != NULL && hit_out != NULL);
    return walk(soup, &a, &b, 1.0f, true, filter, hit_out);
}

bool tl_soup_line_of_sight_with(tl_ray_walk_fn *walk, const tl_soup *soup, tl_vec3 a, tl_vec3 b,
                                const tl_ray_filter *filter)
{
    TL_ASSERT(soup != NULL);
    return !walk(soup, &a, &b, 1.0f, true, filter, NULL);
}

bool tl_soup_cast_ray(const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter, tl_ray_hit *hit_out)
{
    return tl_soup_cast_ray_with(best_ray_walk(), soup, ray, filter, hit_out);
}

bool tl_soup_occluded(const tl_soup *soup, const tl_ray *ray, const tl_ray_filter *filter)
{
    return tl_soup_occluded_with(best_ray_walk(), soup, ray, filter);
}

bool tl_soup_cast_segment(const tl_soup *soup, tl_vec3 a, tl_vec3 b, const tl_ray_filter *filter, tl_ray_hit *hit_out)
{
    return tl_soup_cast_segment_with(best_ray_walk(), soup, a, b, filter, hit_out);
}

bool tl_soup_line_of_sight(const tl_soup *soup, tl_vec3 a, tl_vec3 b, const tl_ray_filter *filter)
{
    return tl_soup_line_of_sight_with(best_ray_walk(), soup, a, b, filter);
}
