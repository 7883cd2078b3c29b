// SPDX-License-Identifier: MIT
//
// Fills the hit of a triangle that ray_decide.c has found.

#include "soup/ray/ray_measure.h"

void tl_ray_describe(const tl_ray_job *job, tl_ray_hit *hit)
{
    tl_ray_describe_inline(job, hit);
}
