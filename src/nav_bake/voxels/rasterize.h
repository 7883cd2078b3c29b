// SPDX-License-Identifier: MIT
//
// Rasterization of some of a mesh's triangles, which the caller has checked.

#ifndef TALUS_SRC_NAV_BAKE_RASTERIZE_H
#define TALUS_SRC_NAV_BAKE_RASTERIZE_H

#include "nav_bake/input/triangle_bins.h"
#include "nav_bake/voxels/row_source.h"

typedef struct tl_raster_worker tl_raster_worker;

/// Triangles sorted into bands of rows, to be rasterized a band at a time.
typedef struct tl_rasterizer {
    const tl_nav_config *config;
    const tl_mesh_view *mesh;
    const uint8_t *areas;
    tl_triangle_list list;
    tl_triangle_bins bins; ///< by band; not made when there is one band
    tl_lattice_map map;
    uint32_t margin;
    uint32_t rows_per_band;
    uint32_t band_count;
    uint32_t line;             ///< columns or rows, the more: of a band with its margins
    tl_raster_worker *workers; ///< [worker_count]
    uint32_t worker_count;
    const tl_allocator *allocator;
} tl_rasterizer;

/// Each band is rasterized together with `margin` rows on both sides, where the field has them.
tl_result tl_rasterizer_init(tl_rasterizer *rasterizer, const tl_nav_config *config, const tl_mesh_view *mesh,
                             const uint8_t *areas, tl_triangle_list list, uint32_t margin, const tl_host *host);
void tl_rasterizer_free(tl_rasterizer *rasterizer);

/// Rasterizes a band, whose rows are then to be asked for until the worker's next band.
tl_result tl_rasterizer_run(tl_rasterizer *rasterizer, uint32_t band, uint32_t worker, tl_row_source *rows_out);

tl_result tl_nav_rasterize_list(const tl_nav_config *config, const tl_mesh_view *mesh, const uint8_t *areas,
                                tl_triangle_list list, const tl_host *host, tl_nav_heightfield *heightfield_out,
                                tl_report *report);

#endif
