// SPDX-License-Identifier: MIT
//
// Is this block of bytes a hull? Every count, offset and index is proven in range before it is used, and everything
// that the bake derives from the vertices and the topology is derived again and compared. So a climb on a hull that
// passes ends, since each of its steps is a true gain; and it ends at a maximum, since the surface is convex there.

#include "hull/bake/quickhull.h"
#include "hull/support/face_ring.h"

#include "base/assert.h"
#include "base/blob_check.h"
#include "base/host.h"
#include "math/predicates.h"

#include <float.h>
#include <string.h>

static bool same_float_bits(float a, float b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static tl_result wrong_field(tl_report *report, const char *field)
{
    return tl_report_field(report, TL_ERR_CORRUPT, field, "bake the hull again");
}

static tl_result wrong_element(tl_report *report, const char *element, uint64_t index)
{
    return tl_report_fail(report, TL_ERR_CORRUPT, element, index, "bake the hull again");
}

static tl_result check_head(const tl_hull *hull, tl_report *report)
{
    // E <= 3 V - 6, F <= 2 V - 4 (Euler), and a block holds at least one half-edge.
    if (hull->vertex_count < 4 || hull->vertex_count > TL_MAX_HULL_POINTS) {
        return wrong_field(report, "vertex_count");
    }
    if (hull->half_edge_count % 2 != 0 || hull->half_edge_count > 6 * (uint64_t)hull->vertex_count) {
        return wrong_field(report, "half_edge_count");
    }
    if ((uint64_t)hull->vertex_count + hull->face_count != (uint64_t)hull->half_edge_count / 2 + 2) {
        return wrong_field(report, "face_count");
    }
    const bool is_merged = hull->merge_distance > 0.0;
    const uint64_t max_blocks = is_merged ? 6 * (uint64_t)hull->vertex_count : hull->half_edge_count;
    if (hull->block_count < hull->vertex_count || hull->block_count > max_blocks) {
        return wrong_field(report, "block_count");
    }
    if (!(hull->merge_distance >= 0.0 && hull->merge_distance <= (double)FLT_MAX) ||
        (!is_merged && signbit(hull->merge_distance))) {
        return wrong_field(report, "merge_distance");
    }
    if (hull->ring_count > hull->face_count || hull->ring_cells > tl_face_ring_cells(hull->half_edge_count)) {
        return wrong_field(report, "ring_count");
    }
    tl_hull expected = *hull;
    uint64_t expected_size = tl_hull_lay_out(&expected);
    if (hull->blob.size != expected_size) {
        return wrong_field(report, "blob.size");
    }
    return memcmp(&expected, hull, sizeof expected) == 0 ? TL_OK : wrong_field(report, "offsets");
}

static tl_result check_loops(const tl_hull *hull, tl_report *report)
{
    const tl_hull_face *faces = tl_hull_faces(hull);
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(hull);
    uint32_t first = 0;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        if (faces[f].first != first || faces[f].count < 3 || faces[f].count > hull->half_edge_count - first) {
            return wrong_element(report, "face", f);
        }
        for (uint32_t k = 0; k < faces[f].count; k++) {
            tl_hull_half_edge h = half_edges[first + k];
            uint32_t next = k + 1 < faces[f].count ? first + k + 1 : first;
            if (h.face != f || h.next != next || h.origin >= hull->vertex_count || h.twin >= hull->half_edge_count ||
                h.origin < half_edges[first].origin) {
                return wrong_element(report, "half-edge", first + k);
            }
        }
        first += faces[f].count;
    }
    if (first != hull->half_edge_count) {
        return wrong_field(report, "half_edge_count");
    }
    for (uint32_t h = 0; h < hull->half_edge_count; h++) {
        uint32_t twin = half_edges[h].twin;
        if (twin == h || half_edges[twin].twin != h || half_edges[twin].origin == half_edges[h].origin ||
            half_edges[half_edges[h].next].origin != half_edges[twin].origin) {
            return wrong_element(report, "half-edge", h);
        }
    }
    return TL_OK;
}

// One vertex's ring and blocks. The loops are proven, so to turn around a vertex is a permutation of half-edges and the
// ring closes; rings of different vertices are disjoint, which bounds the work by 2 E.
static bool check_vertex_ring(const tl_hull *hull, uint32_t vertex, uint32_t *half_edges_seen, uint32_t *next_block)
{
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(hull);
    uint32_t start = tl_hull_vertex_edges(hull)[vertex];
    if (start >= hull->half_edge_count || half_edges[start].origin != vertex) {
        return false;
    }
    uint32_t degree = 0, edge = start;
    do {
        if (half_edges[edge].origin != vertex) {
            return false;
        }
        degree++;
        edge = half_edges[half_edges[edge].twin].next;
    } while (edge != start);
    *half_edges_seen += degree;
    uint32_t at = vertex, left = degree;
    for (;;) {
        bool more = left > TL_CLIMB_LANES;
        tl_climb_block expected;
        tl_hull_fill_block(tl_hull_vertices(hull), half_edges, &edge, more ? TL_CLIMB_LANES - 1 : left, &expected);
        if (more) {
            expected.link[TL_CLIMB_LANES - 1] = TL_CLIMB_MORE | *next_block;
        }
        if (memcmp(&expected, &tl_hull_blocks(hull)[at], sizeof expected) != 0) {
            return false;
        }
        if (!more) {
            return true;
        }
        left -= TL_CLIMB_LANES - 1;
        at = (*next_block)++;
        if (at >= hull->block_count) {
            return false;
        }
    }
}

static tl_result check_rings(const tl_hull *hull, tl_report *report)
{
    uint32_t half_edges_seen = 0, blocks_seen = hull->vertex_count;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        if (!check_vertex_ring(hull, v, &half_edges_seen, &blocks_seen)) {
            return wrong_element(report, "vertex", v);
        }
    }
    if (half_edges_seen != hull->half_edge_count) {
        return wrong_field(report, "vertex_edges");
    }
    return blocks_seen == hull->block_count ? TL_OK : wrong_field(report, "block_count");
}

static tl_result check_vertices_and_bounds(const tl_hull *hull, tl_report *report)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        tl_vec3 p = tl_hull_vertices(hull)[v], size = tl_abs(p);
        if (!tl_is_finite(p) || tl_maxf(size.x, tl_maxf(size.y, size.z)) > TL_MAX_HULL_COORDINATE) {
            return wrong_element(report, "vertex", v);
        }
        bounds = tl_aabb_add_point(bounds, p);
    }
    return memcmp(&bounds, &hull->bounds, sizeof bounds) == 0 ? TL_OK : wrong_field(report, "bounds");
}

static tl_hull_plane fit_plane(const tl_hull *hull, uint32_t face)
{
    return tl_hull_fit_plane(tl_hull_vertices(hull), tl_hull_half_edges(hull), tl_hull_faces(hull)[face]);
}

static tl_result check_planes_and_mass(const tl_hull *hull, tl_report *report)
{
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_plane plane = tl_hull_face_plane(hull, f), expected = fit_plane(hull, f);
        double length_sq =
            plane.normal[0] * plane.normal[0] + plane.normal[1] * plane.normal[1] + plane.normal[2] * plane.normal[2];
        // The length is one but for rounding, unless the corners have no plane: then all of it is NaN.
        if (!(length_sq > 0.999 && length_sq < 1.001) || memcmp(&plane, &expected, sizeof plane) != 0) {
            return wrong_element(report, "face", f);
        }
    }
    // A query must not name a face that is not there.
    for (uint32_t f = hull->face_count; f < 8 * tl_hull_plane_block_count(hull->face_count); f++) {
        tl_hull_plane plane = tl_hull_face_plane(hull, f), zero = { { 0.0 }, 0.0 };
        if (memcmp(&plane, &zero, sizeof plane) != 0) {
            return wrong_field(report, "planes");
        }
    }
    tl_hull_mass mass;
    (void)tl_hull_measure_mass(hull, NULL, &mass); // silent: nothing can stop it
    return memcmp(&mass, &hull->mass, sizeof mass) == 0 ? TL_OK : wrong_field(report, "mass");
}

// Exactly: every face lies in one plane and turns left at each corner, and at every edge the surface is bent inward.
// What this leaves open is a surface that winds around more than once, which only tl_hull_validate excludes.
static tl_result check_convexity(const tl_hull *hull, tl_report *report)
{
    const tl_hull_half_edge *half_edges = tl_hull_half_edges(hull);
    for (uint32_t h = 0; h < hull->half_edge_count; h++) {
        uint32_t next = half_edges[h].next, twin = half_edges[h].twin;
        uint32_t beyond = half_edges[half_edges[twin].next].next; // starts at a corner of the other face, off this edge
        if (tl_orient3d(tl_hull_corner(hull, h), tl_hull_corner(hull, next),
                        tl_hull_corner(hull, half_edges[next].next), tl_hull_corner(hull, beyond)) >= 0) {
            return wrong_element(report, "half-edge", h);
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_faces(hull)[f];
        for (uint32_t k = 3; k < face.count; k++) {
            if (tl_orient3d(tl_hull_corner(hull, face.first), tl_hull_corner(hull, face.first + 1),
                            tl_hull_corner(hull, face.first + 2), tl_hull_corner(hull, face.first + k)) != 0) {
                return wrong_element(report, "face", f);
            }
        }
    }
    return TL_OK;
}

static tl_result check_scan(const tl_hull *hull, tl_report *report)
{
    const float *rows = tl_hull_scan_rows(hull);
    for (uint32_t i = 0; i < hull->scan_count; i++) {
        tl_vec3 p = tl_hull_scan_point(hull, i);
        if (!same_float_bits(rows[i], p.x) || !same_float_bits(rows[hull->scan_count + i], p.y) ||
            !same_float_bits(rows[2 * hull->scan_count + i], p.z)) {
            return wrong_field(report, "scan");
        }
    }
    bool right = same_float_bits(hull->scan_error, hull->scan_count > 0 ? tl_hull_scan_error(hull) : 0.0f);
    return right ? TL_OK : wrong_field(report, "scan_error");
}

// Any vertex is a right start, so the cells are only proven to hold vertices.
static tl_result check_direction_table(const tl_hull *hull, tl_report *report)
{
    tl_vec3 scale = tl_hull_table_scale(hull);
    const uint32_t *table = tl_hull_table(hull);
    uint64_t squares = 2 * (uint64_t)hull->table_side * hull->table_side;
    for (uint64_t i = 0; i < squares + hull->ring_cells; i++) {
        bool ring = i < squares && (table[i] & TL_TABLE_RING) != 0;
        if (ring ? (table[i] & ~TL_TABLE_RING) >= hull->ring_count : table[i] >= hull->vertex_count) {
            return wrong_element(report, "table cell", i);
        }
    }
    uint32_t count = 0, first = (uint32_t)squares;
    for (uint32_t face = 0; face < hull->face_count && hull->ring_count > 0; face++) {
        uint32_t corners = tl_hull_faces(hull)[face].count;
        if (tl_face_has_ring(corners)) {
            tl_face_ring expected = tl_face_ring_make(hull, face, first);
            if (memcmp(&expected, &tl_hull_rings(hull)[count++], sizeof expected) != 0) {
                return wrong_element(report, "ring", count - 1);
            }
            first += tl_face_ring_cells(corners);
        }
    }
    return memcmp(&scale, &hull->table_scale, sizeof scale) == 0 ? TL_OK : wrong_field(report, "table_scale");
}

// A hull with merged faces: derived again from its vertices, it must be the same bytes but for the sources, which only
// the points of the bake can tell.
static tl_result check_merged(const tl_hull *hull, tl_report *report)
{
    tl_hull *again;
    const tl_result result =
        tl_hull_bake_merged(tl_hull_vertices(hull), hull->vertex_count, hull->merge_distance, NULL, &again);
    if (result == TL_ERR_MEMORY) {
        return tl_report_fail(report, result, NULL, TL_NO_ELEMENT, "free some");
    }
    if (result != TL_OK) {
        return wrong_field(report, "vertices");
    }
    const char *bytes = (const char *)hull, *right = (const char *)again;
    const uint64_t behind = hull->sources + sizeof(uint32_t) * (uint64_t)hull->vertex_count;
    again->blob = hull->blob;
    const char *wrong = memcmp(hull, again, sizeof *hull) != 0 ? "head"
                        : memcmp(bytes + sizeof *hull, right + sizeof *hull, hull->sources - sizeof *hull) != 0 ||
                                memcmp(bytes + behind, right + behind, hull->blob.size - behind) != 0
                            ? "merge_distance"
                            : NULL;
    tl_blob_free(again);
    return wrong != NULL ? wrong_field(report, wrong) : TL_OK;
}

tl_result tl_hull_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    const tl_blob expected = { TL_HULL_MAGIC, TL_HULL_VERSION, sizeof(tl_hull) };
    TL_TRY(tl_blob_check_head(bytes, size, expected, 16, report_out));
    const tl_hull *hull = bytes;
    TL_TRY(check_head(hull, report_out));
    TL_TRY(check_loops(hull, report_out));
    TL_TRY(check_vertices_and_bounds(hull, report_out));
    if (hull->merge_distance > 0.0) {
        return check_merged(hull, report_out);
    }
    TL_TRY(check_planes_and_mass(hull, report_out));
    TL_TRY(check_convexity(hull, report_out));
    tl_hull rings = *hull;
    tl_hull_count_rings(&rings, tl_hull_faces(hull));
    if (rings.ring_count != hull->ring_count || rings.ring_cells != hull->ring_cells) {
        return wrong_field(report_out, "ring_count");
    }
    TL_TRY(check_rings(hull, report_out));
    TL_TRY(check_scan(hull, report_out));
    return check_direction_table(hull, report_out);
}
