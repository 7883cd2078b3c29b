// SPDX-License-Identifier: MIT
//
// rcBuildPolyMesh on a tl_contour_set.

#include "polygon_recast.h"
#include "measure.h"

#ifdef TALUS_BENCH_RECAST

#include <recastnavigation/Recast.h>
#include <vector>

double bench_recast_polygons(const tl_contour_set *set, uint32_t max_verts_per_poly, uint32_t *polygons_out)
{
    std::vector<int> vertices;
    std::vector<rcContour> contours(set->contour_count);
    vertices.reserve(4 * static_cast<size_t>(set->vertex_count) + 4);
    for (uint32_t i = 0; i < set->contour_count; i++) {
        const tl_contour &from = set->contours[i];
        rcContour &to = contours[i];
        to = rcContour();
        to.verts = vertices.data() + vertices.size();
        to.nverts = static_cast<int>(from.vertex_count);
        to.reg = static_cast<unsigned short>(from.region);
        to.area = static_cast<unsigned char>(from.area);
        for (uint32_t k = 0; k < from.vertex_count; k++) {
            const tl_contour_vertex &v = set->vertices[from.first_vertex + k];
            vertices.push_back(v.x);
            vertices.push_back(v.y);
            vertices.push_back(v.z);
            vertices.push_back(static_cast<int>(v.flags));
        }
    }
    rcContourSet *given = rcAllocContourSet();
    given->conts = contours.data();
    given->nconts = static_cast<int>(contours.size());
    given->cs = set->cell_size;
    given->ch = set->cell_height;
    given->width = set->width;
    given->height = set->height;
    given->borderSize = set->border_size;
    given->maxError = set->max_error;
    rcPolyMesh *mesh = rcAllocPolyMesh();
    rcContext context(false);
    double began = bench_process_seconds();
    bool ok = rcBuildPolyMesh(&context, *given, static_cast<int>(max_verts_per_poly), *mesh);
    double seconds = bench_process_seconds() - began;
    *polygons_out = ok ? static_cast<uint32_t>(mesh->npolys) : 0;
    rcFreePolyMesh(mesh);
    // The contours are not the set's to free.
    given->conts = nullptr;
    given->nconts = 0;
    rcFreeContourSet(given);
    return seconds;
}

#else

double bench_recast_polygons(const tl_contour_set *set, uint32_t max_verts_per_poly, uint32_t *polygons_out)
{
    (void)set;
    (void)max_verts_per_poly;
    *polygons_out = 0;
    return 0.0;
}

#endif
