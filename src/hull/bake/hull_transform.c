// SPDX-License-Identifier: MIT
//
// A hull scaled, turned and moved: its corners are mapped in double and rounded once, and the hull of the result is
// built anew. To keep the topology instead would be quicker and wrong: four corners in one plane are so no more when
// each has been rounded on its own, and a blunt corner may end up inside.

#include "base/arena.h"
#include "base/host.h"
#include "base/min_max.h"
#include "hull/bake/quickhull.h"
#include "math/vec3d.h"

#include <talus/hull.h>

#include <string.h>

tl_result tl_hull_transform(const tl_hull *hull, tl_vec3 scale, tl_transform pose, const tl_host *host,
                            tl_hull **hull_out, tl_hull_report *report_out)
{
    if (report_out != NULL) {
        memset(report_out, 0, sizeof *report_out);
    }
    tl_report *report = report_out != NULL ? &report_out->base : NULL;
    tl_report_begin(report, "hull");
    if (hull_out == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "hull_out", "give where the hull goes");
    }
    *hull_out = NULL;
    if (hull == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "hull", "give a baked hull");
    }
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f; // the hull was no chip of rounding, so what remains of it is meant
    if (hull->merge_distance > 0.0f && tl_is_finite(scale)) { // another scale is refused by the points it makes
        const tl_vec3 size = tl_abs(scale);
        const double distance = (double)hull->merge_distance * (double)tl_maxf(size.x, tl_maxf(size.y, size.z));
        def.merge_distance = (float)tl_min_f64(distance, (double)TL_MAX_HULL_COORDINATE);
    }
    if (host != NULL) {
        def.host = *host;
    }
    tl_vec3 *points = tl_allocate_array(def.host.allocator, hull->vertex_count, sizeof *points);
    if (points == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_frame frame = tl_frame_from(pose);
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        tl_vec3 p = tl_hull_vertices(hull)[v];
        tl_vec3d scaled =
            tl_vec3d_make((double)scale.x * (double)p.x, (double)scale.y * (double)p.y, (double)scale.z * (double)p.z);
        points[v] = tl_vec3d_to_float(tl_frame_point(&frame, scaled));
    }
    const tl_result result = tl_hull_bake_named(points, hull->vertex_count, hull, &def, hull_out, report_out);
    tl_release_array(def.host.allocator, points, hull->vertex_count, sizeof *points);
    return result;
}
