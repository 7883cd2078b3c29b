// SPDX-License-Identifier: MIT
//
// A soup at a scale, as walks take it.

#ifndef TALUS_SRC_SOUP_WALK_SCALE_H
#define TALUS_SRC_SOUP_WALK_SCALE_H

#include "soup/query/bvh_walk.h"

#include <talus/soup_scaled.h>

/// Checks a soup and its scale. `*used_out` is `scale_out`, or NULL where all factors are 1. TL_ERR_ARGUMENT: no soup;
/// TL_ERR_NOT_FINITE, TL_ERR_RANGE: the scale.
tl_result tl_walk_scale_make(const tl_scaled_soup *scaled, tl_walk_scale *scale_out, const tl_walk_scale **used_out);

/// In the view a feature of a triangle whose corners 1 and 2 changed places.
tl_triangle_feature tl_walk_mirrored_feature(tl_triangle_feature feature);

static inline tl_scaled_soup tl_unscaled_soup(const tl_soup *soup)
{
    tl_scaled_soup as_it_is = { soup, { 0.0f, 0.0f, 0.0f } };
    return as_it_is;
}

#endif
