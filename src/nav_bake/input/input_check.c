// SPDX-License-Identifier: MIT
//
// The input of a bake, checked once before any work.

#include "nav_bake/input/input_check.h"

#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/input/level_mesh.h"

#include <math.h>

static bool volume_is_finite(const tl_nav_volume *volume)
{
    switch (volume->kind) {
    case TL_NAV_VOLUME_BOX:
        return tl_is_finite(volume->box.min) && tl_is_finite(volume->box.max);
    case TL_NAV_VOLUME_POLYGON:
        for (uint32_t i = 0; i < volume->point_count; i++) {
            if (!tl_is_finite(volume->points[i])) {
                return false;
            }
        }
        return isfinite(volume->box.min.y) && isfinite(volume->box.max.y);
    case TL_NAV_VOLUME_CYLINDER:
        return tl_is_finite(volume->base) && isfinite(volume->radius) && isfinite(volume->height);
    }
    return false;
}

static tl_result check_area_volume(const tl_nav_volume *volume, uint32_t index, tl_report *report)
{
    if ((unsigned)volume->kind > (unsigned)TL_NAV_VOLUME_CYLINDER) {
        return tl_report_fail(report, TL_ERR_ARGUMENT, "volume", index, "use a tl_nav_volume_kind");
    }
    if (volume->kind == TL_NAV_VOLUME_POLYGON && (volume->points == NULL || volume->point_count < 3)) {
        return tl_report_fail(report, TL_ERR_ARGUMENT, "volume", index, "give the polygon at least three points");
    }
    if (!volume_is_finite(volume)) {
        return tl_report_fail(report, TL_ERR_NOT_FINITE, "volume", index, "remove what is not a number");
    }
    return TL_OK;
}

tl_result tl_nav_input_check(const tl_nav_input *input, const tl_host *host, tl_aabb *bounds_out, tl_report *report)
{
    tl_report_begin(report, "check");
    TL_TRY(tl_level_mesh_check(&input->mesh, host, bounds_out, report));
    for (uint32_t i = 0; i < input->volume_count; i++) {
        TL_TRY(check_area_volume(&input->volumes[i], i, report));
    }
    return TL_OK;
}
