// SPDX-License-Identifier: MIT
//
// The choice of the walk: by a look at the processor's features, as in the soup's ray query, so that there is no state.
// AVX-512 is left out: the walk compiled for it took a tenth longer on an Intel Sapphire Rapids.

#include "scene/scene_walk.h"

#include "base/cpu.h"

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

void tl_scene_line_make(tl_scene_line *line, const tl_scene *scene, uint32_t mask, tl_vec3 from, tl_vec3 direction,
                        float limit)
{
    line->scene = scene;
    line->walk = best_scene_walk();
    line->mask = mask;
    line->from = from;
    line->direction = direction;
    line->half = tl_vec3_make(0.0f, 0.0f, 0.0f);
    line->limit = limit;
}

bool tl_scene_line_walk(tl_scene_line *line)
{
    return line->walk(line);
}
