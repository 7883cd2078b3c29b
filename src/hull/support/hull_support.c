// SPDX-License-Identifier: MIT
//
// The public support query: chooses the instruction set, and scales directions of unusual length.
//
// The baked hull has the same bytes on every machine.

#include "hull/support/hull_support.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/min_max.h"

#include <string.h>

bool tl_support_kernel_for(tl_support_isa isa, tl_support_kernel *kernel_out)
{
    static const tl_support_kernel kernels[TL_SUPPORT_ISA_COUNT] = {
        { tl_hull_support_scalar, tl_hull_climb_scalar, tl_hull_march_scalar },
#if TL_CPU_LEVELS >= 1
        { tl_hull_support_vec128, tl_hull_climb_vec128, tl_hull_march_vec128 },
#endif
#if TL_CPU_LEVELS >= 2
        { tl_hull_support_avx2, tl_hull_climb_avx2, tl_hull_march_avx2 },
#endif
    };
    *kernel_out = kernels[isa];
    return tl_cpu_has_level((int)isa);
}

tl_support_kernel tl_support_kernel_best(void)
{
    const int isa = tl_cpu_level_up_to(tl_min_i32(TL_SUPPORT_ISA_COUNT - 1, TL_CPU_LEVELS));
    tl_support_kernel kernel;
    tl_support_kernel_for((tl_support_isa)isa, &kernel);
    return kernel;
}

#if TL_CPU_LEVELS >= 2
// The first query of all, and every one where there is no AVX2.
static TL_NOINLINE uint32_t support_by_look(const tl_hull *hull, float x, float y, float z, uint32_t hint)
{
    return tl_cpu_has_avx2()     ? tl_hull_support_avx2(hull, x, y, z, hint)
           : tl_cpu_has_vec128() ? tl_hull_support_vec128(hull, x, y, z, hint)
                                 : tl_hull_support_scalar(hull, x, y, z, hint);
}
#endif

uint32_t tl_hull_support(const tl_hull *hull, tl_vec3 d, uint32_t hint)
{
    TL_ASSERT(hull != NULL);
#if TL_CPU_LEVELS >= 2
    return tl_cpu_was_found(TL_CPU_AVX2) ? tl_hull_support_avx2(hull, d.x, d.y, d.z, hint)
                                         : support_by_look(hull, d.x, d.y, d.z, hint);
#elif TL_CPU_LEVELS == 1
    return tl_hull_support_vec128(hull, d.x, d.y, d.z, hint);
#else
    return tl_hull_support_scalar(hull, d.x, d.y, d.z, hint);
#endif
}

// 2^-exponent(size) as a double, for a float size > 0: exact, and never a denormal.
static double reciprocal_power(float size)
{
    double wide = (double)size;
    uint64_t bits;
    memcpy(&bits, &wide, sizeof bits);
    bits = (uint64_t)(2046u - (bits >> 52)) << 52;
    double result;
    memcpy(&result, &bits, sizeof result);
    return result;
}

uint32_t tl_hull_support_unusual(const tl_hull *hull, float dx, float dy, float dz, uint32_t hint)
{
    const tl_vec3 direction = { dx, dy, dz };
    tl_vec3 size = tl_abs(direction);
    float largest = tl_maxf(size.x, tl_maxf(size.y, size.z));
    if (!(largest > 0.0f) || !tl_is_finite(direction)) {
        return 0;
    }
    double scale = reciprocal_power(largest);
    double x = (double)direction.x * scale, y = (double)direction.y * scale, z = (double)direction.z * scale;
    tl_vec3 scaled = tl_vec3_make((float)x, (float)y, (float)z);
    if ((double)scaled.x == x && (double)scaled.y == y && (double)scaled.z == z) {
        return tl_hull_support(hull, scaled, hint); // now its largest component lies in [1, 2)
    }
    // Components too far apart for one float scale.
    return tl_hull_climb_exact(hull, direction, hint < hull->vertex_count ? hint : 0);
}
