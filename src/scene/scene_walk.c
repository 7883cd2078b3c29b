// SPDX-License-Identifier: MIT
//
// What is computed once a line, and the choice of the walk: by a look at the processor's features, as in the soup's ray
// query, so that there is no state.

#include "scene/scene_walk.h"

#include "base/assert.h"
#include "base/cpu.h"
#include "base/min_max.h"
#include "math/tolerance.h"

#include <float.h>

#define LINE_ERROR (12.0 * (double)TL_FLOAT_ROUNDING * 1.001)

// Products of what is farther away could overflow.
#define MAX_LINE_REACH 1e15

// Shorter directions are denormal in an instance's space, where roundings are no longer relative.
#define SHORTEST        1e-30

#define LARGEST_INVERSE 1180591620717411303424.0 // 2^70

// A limit in double, times a scale, to float: a rounding each.
#define LIMIT_ERROR (1.0 + 4.0 * (double)TL_FLOAT_ROUNDING)

tl_scene_walk_fn *tl_scene_walk_for(int level)
{
    static tl_scene_walk_fn *const walks[] = {
        tl_scene_walk_scalar,
#if TL_CPU_LEVELS >= 1
        tl_scene_walk_vec128,
#endif
#if TL_CPU_LEVELS >= 2
        tl_scene_walk_avx2,
#endif
    };
    int count = (int)(sizeof walks / sizeof *walks);
    return level < count && tl_cpu_has_level(level) ? walks[level] : NULL;
}

static inline tl_scene_walk_fn *best_scene_walk(void)
{
#if TL_CPU_LEVELS >= 2
    return tl_cpu_has_avx2() ? tl_scene_walk_avx2 : tl_cpu_has_vec128() ? tl_scene_walk_vec128 : tl_scene_walk_scalar;
#elif TL_CPU_LEVELS == 1
    return tl_scene_walk_vec128;
#else
    return tl_scene_walk_scalar;
#endif
}

// From a point to the farther of two planes.
static inline double farther_plane(float min, float max, double at)
{
    return tl_max_f64(fabs((double)min - at), fabs((double)max - at));
}

void tl_scene_line_make(tl_scene_line *line, const tl_scene *scene, uint32_t mask, tl_vec3 from, tl_vec3 direction,
                        tl_vec3d half, double limit)
{
    line->scene = scene;
    line->mask = mask;
    line->walk = best_scene_walk();
    const double at[3] = { (double)from.x, (double)from.y, (double)from.z };
    const double along[3] = { (double)direction.x, (double)direction.y, (double)direction.z };
    const double wide[3] = { half.x, half.y, half.z };
    double largest = tl_max_f64(tl_max_f64(fabs(along[0]), fabs(along[1])), fabs(along[2]));
    bool stands = largest == 0.0;
    line->per_t = stands ? 1.0 : largest;
    tl_scene_line_shorten(line, limit);
    double size = fabs(at[0]) + fabs(at[1]) + fabs(at[2]);
    tl_vec3 low = scene->bounds.min, high = scene->bounds.max;
    double farthest = tl_max_f64(tl_max_f64(farther_plane(low.x, high.x, at[0]), farther_plane(low.y, high.y, at[1])),
                                 farther_plane(low.z, high.z, at[2]));
    // An empty scene's box is infinite, and a difference of points may be.
    line->every = (tl_max_f64(size + tl_vec3d_size(half), farthest) > MAX_LINE_REACH) |
                  (!stands & (largest < SHORTEST)) | (largest == (double)INFINITY);
    if (line->every) {
        return;
    }
    double error = LINE_ERROR * (size + farthest) + (double)FLT_MIN;
    line->backward = 0;
    for (uint32_t i = 0; i < 3; i++) {
        double inverse = line->per_t / along[i];
        inverse = fabs(inverse) <= LARGEST_INVERSE ? inverse : along[i] < 0.0 ? -LARGEST_INVERSE : LARGEST_INVERSE;
        double pad = fabs(inverse) * (wide[i] + error), base = at[i] * inverse;
        line->scale[i] = (float)inverse;
        line->near_base[i] = (float)(-base - pad);
        line->far_base[i] = (float)(pad - base);
        line->backward |= (uint32_t)(inverse < 0.0) << i;
    }
}

void tl_scene_line_shorten(tl_scene_line *line, double t)
{
    line->limit = (float)(t * line->per_t * LIMIT_ERROR + (double)FLT_MIN);
}

bool tl_scene_line_walk(tl_scene_line *line)
{
    if (!line->every) {
        return line->walk(line);
    }
    for (uint32_t i = 0; i < line->scene->instance_count; i++) {
        const tl_scene_record *record = &tl_scene_records(line->scene)[i];
        uint32_t mask = tl_scene_nodes(line->scene)[record->lane / TL_SCENE_WIDTH].mask[record->lane % TL_SCENE_WIDTH];
        if ((mask & line->mask) != 0 && !line->visit(line, i)) {
            return false;
        }
    }
    return true;
}
