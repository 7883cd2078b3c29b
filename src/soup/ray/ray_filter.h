// SPDX-License-Identifier: MIT
//
// Whether a triangle counts for a query.

#ifndef TALUS_SRC_SOUP_RAY_FILTER_H
#define TALUS_SRC_SOUP_RAY_FILTER_H

#include "soup/layout/soup_layout.h"

/// The sides of a triangle that a query sees: both when it lies in the triangle's plane.
typedef enum tl_seen { TL_SEEN_FRONT = 1, TL_SEEN_BACK = 2, TL_SEEN_BOTH = 3 } tl_seen;

static inline bool tl_ray_filter_accepts(const tl_soup *soup, const tl_ray_filter *filter, uint32_t triangle,
                                         tl_seen seen)
{
    if (filter == NULL) {
        return true;
    }
    if ((filter->cull == TL_RAY_CULL_BACK && seen == TL_SEEN_BACK) ||
        (filter->cull == TL_RAY_CULL_FRONT && seen == TL_SEEN_FRONT)) {
        return false;
    }
    if (filter->ignored_materials == 0 && filter->accept == NULL) {
        return true;
    }
    uint16_t material = tl_soup_material(soup, triangle);
    uint32_t bit = material < 63 ? material : 63;
    if ((filter->ignored_materials >> bit & 1) != 0) {
        return false;
    }
    return filter->accept == NULL || filter->accept(triangle, material, filter->accept_user);
}

/// The filter, or NULL where it ignores nothing that the soup holds: then hits need not be looked at, and coherent rays
/// are traced in packets.
static inline const tl_ray_filter *tl_ray_filter_in_use(const tl_soup *soup, const tl_ray_filter *filter)
{
    if (filter == NULL || filter->cull != TL_RAY_CULL_NONE || filter->accept != NULL) {
        return filter;
    }
    if (soup->has_materials) {
        return filter->ignored_materials != 0 ? filter : NULL;
    }
    uint32_t bit = soup->uniform_material < 63 ? soup->uniform_material : 63;
    return (filter->ignored_materials >> bit & 1) != 0 ? filter : NULL;
}

#endif
