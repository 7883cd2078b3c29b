// SPDX-License-Identifier: MIT
//
// Soups at a scale: boxes and corners are scaled as a walk reads them, so that every length is measured in the space
// that the query's shape is in.
//
// The other way, the query's shape scaled by the inverse, is no cheaper and wrong: along axes of different scales a
// ball becomes an ellipsoid, and the nearest point and the depth of a penetration become those of another measure.

#include "soup/query/walk_scale.h"

#include "base/assert.h"
#include "math/scale.h"

// A corner's coordinate rounds by u of itself, a clipped box's plane by as much, and the difference by u of both.
#define CLIPPED_BOX_ERROR TL_FLOAT_GAMMA(4)

tl_result tl_walk_scale_make(const tl_scaled_soup *scaled, tl_walk_scale *scale_out, const tl_walk_scale **used_out)
{
    *used_out = NULL;
    if (scaled == NULL || scaled->soup == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(tl_scale_check(scaled->scale, TL_MAX_SCALE));
    if (tl_scale_is_one(scaled->scale)) {
        return TL_OK;
    }
    const float by[3] = { scaled->scale.x, scaled->scale.y, scaled->scale.z };
    tl_aabb bounds = tl_soup_bounds(scaled->soup);
    tl_vec3 low = tl_abs(bounds.min), high = tl_abs(bounds.max);
    const float reach[3] = { tl_maxf(low.x, high.x), tl_maxf(low.y, high.y), tl_maxf(low.z, high.z) };
    for (int i = 0; i < 3; i++) {
        scale_out->by[i] = by[i];
        scale_out->wider[i] = fabsf(by[i]) * reach[i] * CLIPPED_BOX_ERROR + FLT_MIN;
    }
    scale_out->mirrored = tl_scale_is_mirrored(scaled->scale);
    *used_out = scale_out;
    return TL_OK;
}

void tl_walk_scale_boxes(const tl_walk_scale *scale, tl_walk_boxes *boxes)
{
    for (uint32_t axis = 0; axis < 3; axis++) {
        float by = scale->by[axis], wider = scale->wider[axis];
        const float *lows = tl_walk_min(boxes, axis), *highs = tl_walk_max(boxes, axis);
        float *scaled = boxes->expanded + 2 * (size_t)axis * TL_WALK_WIDTH;
        for (uint32_t lane = 0; lane < TL_WALK_WIDTH; lane++) {
            float min = lows[lane] * by, max = highs[lane] * by;
            scaled[lane] = (by < 0.0f ? max : min) - wider;
            scaled[TL_WALK_WIDTH + lane] = (by < 0.0f ? min : max) + wider;
        }
    }
    boxes->planes = boxes->expanded;
}

void tl_walk_scale_corners(const tl_walk_scale *scale, tl_vec3 corners[3])
{
    tl_vec3 by = tl_vec3_make(scale->by[0], scale->by[1], scale->by[2]);
    for (int k = 0; k < 3; k++) {
        corners[k] = tl_mul(corners[k], by);
    }
    if (scale->mirrored) {
        tl_vec3 second = corners[1];
        corners[1] = corners[2];
        corners[2] = second;
    }
}

tl_triangle_feature tl_walk_mirrored_feature(tl_triangle_feature feature)
{
    switch (feature) {
    case TL_TRIANGLE_EDGE_0:
        return TL_TRIANGLE_EDGE_2;
    case TL_TRIANGLE_EDGE_2:
        return TL_TRIANGLE_EDGE_0;
    case TL_TRIANGLE_CORNER_1:
        return TL_TRIANGLE_CORNER_2;
    case TL_TRIANGLE_CORNER_2:
        return TL_TRIANGLE_CORNER_1;
    default:
        return feature;
    }
}
