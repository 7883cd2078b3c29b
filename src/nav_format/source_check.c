// SPDX-License-Identifier: MIT
//
// The check of a tile's source: every property that queries rely on, in integers, before a byte is written. So a fault
// in a caller's polygons is named, and never becomes a wrong path.

#include "nav_format/source_check.h"

#include "base/assert.h"
#include "base/host.h"
#include "nav_format/lattice_polygon.h"

#include <math.h>
#include <talus/mesh.h>

static bool is_finite_point(tl_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static tl_result check_settings(const tl_nav_tile_source *source, tl_report *report)
{
    const tl_polygon_mesh *polygons = source->polygons;
    const struct {
        const char *name;
        float value;
        bool is_sound;
        const char *advice;
    } sizes[] = {
        { "cell_size", polygons->cell_size, polygons->cell_size >= TL_NAV_MIN_CELL, "make it >= TL_NAV_MIN_CELL" },
        { "cell_height", polygons->cell_height, polygons->cell_height >= TL_NAV_MIN_CELL,
          "make it >= TL_NAV_MIN_CELL" },
        { "agent_height", source->agent_height, source->agent_height > 0.0f, "make it > 0" },
        { "agent_radius", source->agent_radius, source->agent_radius >= 0.0f, "make it >= 0" },
        { "agent_max_climb", source->agent_max_climb, source->agent_max_climb >= 0.0f, "make it >= 0" },
    };
    for (size_t i = 0; i < TL_COUNT_OF(sizes); i++) {
        if (!sizes[i].is_sound || !isfinite(sizes[i].value)) {
            return tl_report_field(report, TL_ERR_ARGUMENT, sizes[i].name, sizes[i].advice);
        }
    }
    if (source->tile_size > TL_MAX_CONTOUR_COORDINATE) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "tile_size", "use tiles of 32 to 1024 cells");
    }
    const int32_t limit = source->tile_size == 0 ? 0 : TL_NAV_MAX_TILE_INDEX;
    const bool x_fits = source->tile_x >= -limit && source->tile_x <= limit;
    if (!x_fits || source->tile_z > limit || source->tile_z < -limit) {
        return tl_report_field(report, TL_ERR_ARGUMENT, x_fits ? "tile_z" : "tile_x",
                               "stay within +-TL_NAV_MAX_TILE_INDEX; without a tile_size the only tile is (0, 0)");
    }
    if (source->layer > TL_NAV_MAX_LAYER) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "layer", "give 0 to 65535");
    }
    return TL_OK;
}

// How far the tile's own origin may lie from where the grid puts it: float rounding of the caller's sums is far below
// a quarter of a cell wherever a lattice makes sense, and a wrong tile_x or border is at least a whole cell.
#define ORIGIN_AGREEMENT_CELLS 0.25

static bool origin_agrees(float origin, int32_t tile_index, uint32_t tile_size, float cell, float claimed)
{
    double expected = (double)origin + (double)tile_index * (double)tile_size * (double)cell;
    return fabs(expected - (double)claimed) <= ORIGIN_AGREEMENT_CELLS * (double)cell;
}

static tl_result check_origin(const tl_nav_tile_source *source, tl_report *report)
{
    const tl_polygon_mesh *polygons = source->polygons;
    tl_vec3 claimed = polygons->bounds.min;
    if (!is_finite_point(source->origin) || !is_finite_point(claimed)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "origin", "use finite numbers");
    }
    if (!origin_agrees(source->origin.x, source->tile_x, source->tile_size, polygons->cell_size, claimed.x) ||
        !origin_agrees(source->origin.z, source->tile_z, source->tile_size, polygons->cell_size, claimed.z) ||
        !origin_agrees(source->origin.y, 0, 0, polygons->cell_height, claimed.y)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "origin",
                               "origin + tile * tile_size * cell_size is not where the polygons' bounds begin");
    }
    return TL_OK;
}

static bool in_range(float position)
{
    return position >= -TL_MAX_COORDINATE && position <= TL_MAX_COORDINATE;
}

static tl_result check_source_vertices(const tl_nav_tile_source *source, tl_report *report)
{
    const tl_polygon_mesh *polygons = source->polygons;
    for (uint32_t i = 0; i < polygons->vertex_count; i++) {
        const int32_t *v = polygons->vertices + 3 * (size_t)i;
        bool fits = true;
        for (int axis = 0; axis < 3; axis++) {
            fits = fits && v[axis] >= -TL_MAX_CONTOUR_COORDINATE && v[axis] <= TL_MAX_CONTOUR_COORDINATE;
        }
        if (!fits ||
            !in_range(
                tl_nav_tile_position(source->origin.x, source->tile_x, source->tile_size, v[0], polygons->cell_size)) ||
            !in_range(tl_nav_tile_position(source->origin.y, 0, 0, v[1], polygons->cell_height)) ||
            !in_range(
                tl_nav_tile_position(source->origin.z, source->tile_z, source->tile_size, v[2], polygons->cell_size))) {
            return tl_report_fail(report, TL_ERR_RANGE, "vertex", i, "it lies beyond what can be computed exactly");
        }
    }
    return TL_OK;
}

static tl_result check_shape(const tl_polygon_mesh *polygons, uint32_t p, tl_report *report)
{
    uint32_t begin = polygons->first[p];
    uint32_t end = polygons->first[p + 1];
    if (end < begin || end > polygons->index_count || end - begin < 3) {
        return tl_report_fail(report, TL_ERR_INDEX, "polygon", p, "its range of corners is wrong");
    }
    if (end - begin > TL_NAV_MAX_CORNERS) {
        return tl_report_fail(report, TL_ERR_LIMIT, "polygon", p, "a polygon has at most 64 corners");
    }
    for (uint32_t k = begin; k < end; k++) {
        if (polygons->indices[k] >= polygons->vertex_count) {
            return tl_report_fail(report, TL_ERR_INDEX, "polygon", p, "a corner names no vertex");
        }
    }
    tl_nav_lattice_polygon outline;
    tl_nav_gather_polygon(polygons->vertices, polygons->indices + begin, end - begin, &outline);
    const int64_t area2 = tl_nav_double_area(&outline);
    if (area2 == 0) {
        return tl_report_fail(report, TL_ERR_DEGENERATE, "polygon", p, "it has no area");
    }
    if (area2 < 0 || !tl_nav_is_convex(&outline)) {
        return tl_report_fail(report, TL_ERR_WINDING, "polygon", p, "it is not convex, or wound the wrong way");
    }
    return TL_OK;
}

bool tl_nav_links_back(const uint32_t *first, const uint32_t *corner_vertices, const uint32_t *links, uint32_t polygon,
                       uint32_t corner)
{
    uint32_t next = corner + 1 < first[polygon + 1] ? corner + 1 : first[polygon];
    uint32_t other = links[corner];
    for (uint32_t k = first[other]; k < first[other + 1]; k++) {
        uint32_t k_next = k + 1 < first[other + 1] ? k + 1 : first[other];
        if (links[k] == polygon && corner_vertices[k] == corner_vertices[next] &&
            corner_vertices[k_next] == corner_vertices[corner]) {
            return true;
        }
    }
    return false;
}

static tl_result check_neighbours(const tl_polygon_mesh *polygons, uint32_t p, tl_report *report)
{
    for (uint32_t k = polygons->first[p]; k < polygons->first[p + 1]; k++) {
        uint32_t across = polygons->neighbours[k];
        if (across == TL_NO_POLYGON || (across >= TL_PORTAL && across < TL_PORTAL + 4)) {
            continue;
        }
        if (across >= polygons->polygon_count) {
            return tl_report_fail(report, TL_ERR_INDEX, "polygon", p, "a neighbour does not exist");
        }
        if (across == p || !tl_nav_links_back(polygons->first, polygons->indices, polygons->neighbours, p, k)) {
            return tl_report_fail(report, TL_ERR_NON_MANIFOLD, "polygon", p, "a neighbour does not point back");
        }
    }
    return TL_OK;
}

static tl_result check_patch(const tl_nav_detail *detail, uint32_t p, uint32_t corner_count, tl_report *report)
{
    const tl_nav_detail_patch *patch = &detail->patches[p];
    if (patch->first_vertex > detail->vertex_count ||
        patch->vertex_count > detail->vertex_count - patch->first_vertex ||
        patch->first_triangle > detail->triangle_count ||
        patch->triangle_count > detail->triangle_count - patch->first_triangle || patch->vertex_count < corner_count ||
        patch->vertex_count > UINT16_MAX + 1u || patch->triangle_count == 0) {
        return tl_report_fail(report, TL_ERR_INDEX, "patch", p, "its vertices or triangles are out of range");
    }
    for (uint32_t i = 0; i < patch->vertex_count; i++) {
        tl_vec3 v = detail->vertices[patch->first_vertex + i];
        if (!is_finite_point(v)) {
            return tl_report_fail(report, TL_ERR_NOT_FINITE, "patch", p, "use finite numbers");
        }
        if (!in_range(v.x) || !in_range(v.y) || !in_range(v.z)) {
            return tl_report_fail(report, TL_ERR_RANGE, "patch", p, "keep within TL_MAX_COORDINATE");
        }
    }
    for (uint32_t i = 0; i < patch->triangle_count; i++) {
        const tl_nav_detail_triangle *triangle = &detail->triangles[patch->first_triangle + i];
        for (int k = 0; k < 3; k++) {
            if (triangle->corner[k] >= patch->vertex_count || triangle->edge_flags > 7) {
                return tl_report_fail(report, TL_ERR_INDEX, "patch", p, "a triangle is out of range");
            }
        }
    }
    return TL_OK;
}

static tl_result check_detail(const tl_nav_tile_source *source, tl_report *report)
{
    const tl_nav_detail *detail = source->detail;
    const tl_polygon_mesh *polygons = source->polygons;
    if (detail == NULL) {
        return TL_OK;
    }
    if (detail->patch_count != polygons->polygon_count) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "detail", "there is one patch a polygon");
    }
    uint64_t vertices = 0;
    uint64_t triangles = 0;
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        TL_TRY(check_patch(detail, p, polygons->first[p + 1] - polygons->first[p], report));
        vertices += detail->patches[p].vertex_count;
        triangles += detail->patches[p].triangle_count;
    }
    // Patches may share ranges in the source, not in the tile.
    if (vertices > UINT32_MAX || triangles > UINT32_MAX) {
        return tl_report_field(report, TL_ERR_LIMIT, "detail", "use smaller tiles");
    }
    return TL_OK;
}

static tl_result check_cuts(const tl_nav_tile_source *source, tl_report *report)
{
    const tl_polygon_mesh *polygons = source->polygons;
    for (uint32_t i = 0; i < source->cut_count; i++) {
        const tl_nav_cut *cut = &source->cuts[i];
        if (cut->corner >= polygons->index_count || (i > 0 && cut->corner <= source->cuts[i - 1].corner)) {
            return tl_report_fail(report, TL_ERR_INDEX, "cut", i, "cuts stand by rising corner");
        }
        if (polygons->neighbours[cut->corner] != TL_NO_POLYGON || cut->layer > TL_NAV_MAX_LAYER ||
            cut->layer == source->layer || cut->ordinal > INT32_MAX) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "cut", i, "it is a wall here, and leads to another layer");
        }
    }
    return TL_OK;
}

tl_result tl_nav_tile_check_source(const tl_nav_tile_source *source, tl_report *report)
{
    const tl_polygon_mesh *polygons = source->polygons;
    if (polygons == NULL || polygons->polygon_count == 0) {
        return tl_report_fail(report, TL_ERR_EMPTY, "polygon", TL_NO_ELEMENT, "give at least one");
    }
    if (polygons->polygon_count > TL_NAV_MAX_TILE_POLYGONS || polygons->index_count > TL_NAV_LINK_PORTAL - 1u) {
        return tl_report_fail(report, TL_ERR_LIMIT, "polygon", TL_NO_ELEMENT, "use smaller tiles");
    }
    TL_TRY(check_settings(source, report));
    TL_TRY(check_origin(source, report));
    TL_TRY(check_source_vertices(source, report));
    if (polygons->first[0] != 0 || polygons->first[polygons->polygon_count] != polygons->index_count) {
        return tl_report_fail(report, TL_ERR_INDEX, "polygon", 0, "its range of corners is wrong");
    }
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        TL_TRY(check_shape(polygons, p, report));
        if (polygons->areas[p] == 0 || polygons->areas[p] > TL_NAV_MAX_AREA) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "polygon", p, "areas are 1 to 255");
        }
    }
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        TL_TRY(check_neighbours(polygons, p, report));
    }
    TL_TRY(check_cuts(source, report));
    return check_detail(source, report);
}
