// SPDX-License-Identifier: MIT
//
// Recast's solo pipeline behind the same config, stage by stage, for differential tests and benchmarks.

#ifndef TALUS_TEST_RECAST_PIPELINE_HPP
#define TALUS_TEST_RECAST_PIPELINE_HPP

#include <recastnavigation/Recast.h>

#include <cmath>
#include <cstdint>
#include <talus/nav_bake.h>
#include <vector>

struct recast_pipeline {
    rcContext context{ false };
    rcHeightfield *heightfield = rcAllocHeightfield();
    rcCompactHeightfield *compact = rcAllocCompactHeightfield();
    rcContourSet *contours = rcAllocContourSet();
    rcPolyMesh *polygons = rcAllocPolyMesh();
    rcPolyMeshDetail *detail = rcAllocPolyMeshDetail();

    recast_pipeline() = default;
    recast_pipeline(const recast_pipeline &) = delete;
    recast_pipeline &operator=(const recast_pipeline &) = delete;
    ~recast_pipeline()
    {
        rcFreeHeightField(heightfield);
        rcFreeCompactHeightfield(compact);
        rcFreeContourSet(contours);
        rcFreePolyMesh(polygons);
        rcFreePolyMeshDetail(detail);
    }

    bool rasterize(const tl_nav_config &config, const tl_mesh_view &mesh, float slope_degrees)
    {
        const float *vertices = &mesh.vertices->x;
        const int vertex_count = (int)mesh.vertex_count, triangle_count = (int)mesh.triangle_count;
        const int *indices = reinterpret_cast<const int *>(mesh.indices);
        std::vector<unsigned char> areas(mesh.triangle_count, 0);
        rcMarkWalkableTriangles(&context, slope_degrees, vertices, vertex_count, indices, triangle_count, areas.data());
        return rcCreateHeightfield(&context, *heightfield, (int)config.width, (int)config.height, &config.bounds.min.x,
                                   &config.bounds.max.x, config.cell_size, config.cell_height) &&
               rcRasterizeTriangles(&context, vertices, vertex_count, indices, areas.data(), triangle_count,
                                    *heightfield, (int)config.walkable_climb);
    }

    bool filter(const tl_nav_config &config)
    {
        rcFilterLowHangingWalkableObstacles(&context, (int)config.walkable_climb, *heightfield);
        rcFilterLedgeSpans(&context, (int)config.walkable_height, (int)config.walkable_climb, *heightfield);
        rcFilterWalkableLowHeightSpans(&context, (int)config.walkable_height, *heightfield);
        return true;
    }

    bool build_compact(const tl_nav_config &config)
    {
        return rcBuildCompactHeightfield(&context, (int)config.walkable_height, (int)config.walkable_climb,
                                         *heightfield, *compact);
    }

    // Nothing but the floors is read from here on.
    void free_heightfield()
    {
        rcFreeHeightField(heightfield);
        heightfield = nullptr;
    }

    bool erode(const tl_nav_config &config)
    {
        return rcErodeWalkableArea(&context, (int)config.walkable_radius, *compact);
    }

    bool distance_field()
    {
        return rcBuildDistanceField(&context, *compact);
    }

    bool regions(const tl_nav_config &config)
    {
        const int border = (int)config.border_size, least = (int)config.min_region_area;
        const int merge = (int)config.merge_region_area;
        switch (config.partition) {
        case TL_NAV_WATERSHED:
            return rcBuildRegions(&context, *compact, border, least, merge);
        case TL_NAV_MONOTONE:
            return rcBuildRegionsMonotone(&context, *compact, border, least, merge);
        case TL_NAV_LAYERS:
            return rcBuildLayerRegions(&context, *compact, border, least);
        }
        return false;
    }

    bool build_contours(const tl_nav_config &config)
    {
        return rcBuildContours(&context, *compact, config.max_simplification_error, (int)config.max_edge_len,
                               *contours);
    }

    bool build_polygons(const tl_nav_config &config)
    {
        return rcBuildPolyMesh(&context, *contours, (int)config.max_verts_per_poly, *polygons);
    }

    void free_contours()
    {
        rcFreeContourSet(contours);
        contours = nullptr;
    }

    bool build_detail(const tl_nav_config &config)
    {
        return rcBuildPolyMeshDetail(&context, *polygons, *compact, config.detail_sample_dist,
                                     config.detail_sample_max_error, *detail);
    }

    /// Square metres of all polygons.
    double polygon_area() const
    {
        double sum = 0;
        const rcPolyMesh &mesh = *polygons;
        for (int p = 0; p < mesh.npolys; p++) {
            const unsigned short *polygon = mesh.polys + (size_t)p * 2 * (size_t)mesh.nvp;
            for (int k = 2; k < mesh.nvp && polygon[k] != RC_MESH_NULL_IDX; k++) {
                const unsigned short *a = mesh.verts + 3 * polygon[0], *b = mesh.verts + 3 * polygon[k - 1];
                const unsigned short *c = mesh.verts + 3 * polygon[k];
                sum += std::fabs((double)(b[0] - a[0]) * (c[2] - a[2]) - (double)(c[0] - a[0]) * (b[2] - a[2])) / 2;
            }
        }
        return sum * (double)mesh.cs * (double)mesh.cs;
    }
};

#endif
