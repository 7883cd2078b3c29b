// SPDX-License-Identifier: MIT
//
// The slab test in double: plain, because a walk to the end of a ray visits each box once and sorts nothing.
//
// Source: Kay, Kajiya, Ray Tracing Complex Scenes, 1986.

#include "soup/query/line_region.h"

// t of a plane: a difference, the inverse and a product, each rounded; the limit's own rounding is put on top.
#define LINE_PLANE_ERROR TL_DOUBLE_GAMMA(4)

// The reported t is rounded to float before it is compared with tmax.
#define END_ERROR (2.0 * (double)TL_FLOAT_ROUNDING)

tl_result tl_ray_check(const tl_ray *ray)
{
    if (!tl_is_finite(ray->origin) || !tl_is_finite(ray->direction)) {
        return TL_ERR_NOT_FINITE;
    }
    bool leads_nowhere = ray->direction.x == 0.0f && ray->direction.y == 0.0f && ray->direction.z == 0.0f;
    return leads_nowhere || !(ray->tmax >= 0.0f) ? TL_ERR_ARGUMENT : TL_OK;
}

void tl_line_region_make(const tl_ray *ray, tl_line_region *region_out)
{
    const float origin[3] = { ray->origin.x, ray->origin.y, ray->origin.z };
    const float direction[3] = { ray->direction.x, ray->direction.y, ray->direction.z };
    for (int i = 0; i < 3; i++) {
        region_out->origin[i] = (double)origin[i];
        // A denormal float has a finite inverse in double.
        region_out->inverse[i] = direction[i] != 0.0f ? 1.0 / (double)direction[i] : 0.0;
    }
    // A t beyond FLT_MAX is reported as FLT_MAX.
    region_out->end = ray->tmax < FLT_MAX ? (double)ray->tmax * (1.0 + END_ERROR) + (double)FLT_MIN : (double)INFINITY;
}

uint32_t tl_region_enter_line(const tl_walk_boxes *boxes, const void *line_region)
{
    const tl_line_region *line = line_region;
    double enter[TL_WALK_WIDTH], leave[TL_WALK_WIDTH];
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        enter[i] = 0.0;
        leave[i] = line->end;
    }
    for (uint32_t axis = 0; axis < 3; axis++) {
        double inverse = line->inverse[axis], origin = line->origin[axis];
        const float *near_planes = inverse >= 0.0 ? tl_walk_min(boxes, axis) : tl_walk_max(boxes, axis);
        const float *far_planes = inverse >= 0.0 ? tl_walk_max(boxes, axis) : tl_walk_min(boxes, axis);
        for (uint32_t i = 0; inverse != 0.0 && i < TL_WALK_WIDTH; i++) {
            double from = ((double)near_planes[i] - origin) * inverse, to = ((double)far_planes[i] - origin) * inverse;
            enter[i] = from > enter[i] ? from : enter[i];
            leave[i] = to < leave[i] ? to : leave[i];
        }
        for (uint32_t i = 0; inverse == 0.0 && i < TL_WALK_WIDTH; i++) {
            bool within = (double)near_planes[i] <= origin && origin <= (double)far_planes[i];
            leave[i] = within ? leave[i] : -1.0;
        }
    }
    uint32_t mask = 0;
    for (uint32_t i = 0; i < TL_WALK_WIDTH; i++) {
        mask |=
            (uint32_t)(leave[i] >= 0.0 && enter[i] * (1.0 - LINE_PLANE_ERROR) <= leave[i] * (1.0 + LINE_PLANE_ERROR))
            << i;
    }
    return mask;
}
