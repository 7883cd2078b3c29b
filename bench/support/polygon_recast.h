// SPDX-License-Identifier: MIT
//
// Recast's stage for the polygon benchmark.

#ifndef TALUS_BENCH_POLYGON_RECAST_H
#define TALUS_BENCH_POLYGON_RECAST_H

#include <talus/polygon.h>

#ifdef __cplusplus
extern "C" {
#endif

/// CPU seconds of one rcBuildPolyMesh, and the polygons it made. 0 where Recast is not installed.
double bench_recast_polygons(const tl_contour_set *set, uint32_t max_verts_per_poly, uint32_t *polygons_out);

#ifdef __cplusplus
}
#endif

#endif
