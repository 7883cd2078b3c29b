// SPDX-License-Identifier: MIT
//
// Is this block of bytes a hull? Every count, offset and index is proven in range before it is used, and everything
// that the bake derives from the vertices and the topology is derived again and compared. So a climb on a hull that
// passes ends, since each of its steps is a true gain; and it ends at a maximum, since the surface is convex there.

#include "hull/bake/quickhull.h"
#include "hull/support/cap_ring.h"
#include "hull/support/direction_table.h"

#include "base/assert.h"
#include "base/blob_check.h"
#include "base/host.h"
#include "math/predicates.h"

#include <float.h>
#include <string.h>

// Cells of rings, a half-edge: 4 of faces' rings, at most 8 a vertex of caps'.
enum { MAX_RING_CELLS = 8 };

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

// E <= 3 V - 6, F <= 2 V - 4 (Euler).
static tl_result check_hull_counts(const tl_hull *hull, tl_report *report)
{
    if (hull->vertex_count < 4 || hull->vertex_count > TL_MAX_HULL_POINTS) {
        return wrong_field(report, "vertex_count");
    }
    if (hull->half_edge_count % 2 != 0 || hull->half_edge_count > 6 * (uint64_t)hull->vertex_count) {
        return wrong_field(report, "half_edge_count");
    }
    if ((uint64_t)hull->vertex_count + hull->face_count != (uint64_t)hull->half_edge_count / 2 + 2) {
        return wrong_field(report, "face_count");
    }
    if (!tl_hull_is_width(tl_hull_source_bytes(hull)) || hull->flags > (TL_HULL_SOURCE_BYTES | TL_HULL_HAS_SIDES)) {
        return wrong_field(report, "flags");
    }
    if (!(hull->merge_distance >= 0.0f && hull->merge_distance <= FLT_MAX) ||
        (hull->merge_distance == 0.0f && signbit(hull->merge_distance))) {
        return wrong_field(report, "merge_distance");
    }
    return TL_OK;
}

// A block holds at least one half-edge.
static tl_result check_climb_counts(const tl_hull *hull, tl_report *report)
{
    if (hull->blob.size < TL_HULL_CLIMB_OFFSET + sizeof(tl_hull_climb)) {
        return wrong_field(report, "blob.size");
    }
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    const uint64_t max_blocks = hull->merge_distance > 0.0f ? 6 * (uint64_t)hull->vertex_count : hull->half_edge_count;
    if (climb->block_count < hull->vertex_count || climb->block_count > max_blocks) {
        return wrong_field(report, "block_count");
    }
    if (climb->ring_count > hull->face_count || climb->cap_count > climb->ring_count ||
        climb->ring_cells > MAX_RING_CELLS * (uint64_t)hull->half_edge_count) {
        return wrong_field(report, "ring_count");
    }
    return TL_OK;
}

static tl_result check_head(const tl_hull *hull, tl_report *report)
{
    const bool few = hull->vertex_count <= TL_HULL_FEW;
    TL_TRY(check_hull_counts(hull, report));
    TL_TRY(few ? TL_OK : check_climb_counts(hull, report));
    tl_hull expected = *hull;
    tl_hull_climb climb;
    memset(&climb, 0, sizeof climb);
    if (!few) {
        climb = *tl_hull_climb_head(hull);
        memset(climb.unused, 0, sizeof climb.unused);
    }
    if (hull->blob.size != tl_hull_lay_out(&expected, &climb)) {
        return wrong_field(report, "blob.size");
    }
    const bool same = memcmp(&expected, hull, sizeof expected) == 0 &&
                      (few || memcmp(&climb, tl_hull_climb_head(hull), sizeof climb) == 0);
    return same ? TL_OK : wrong_field(report, "offsets");
}

// Half-edges first .. end are the loop of a face.
static tl_result check_loop(const tl_hull *hull, uint32_t face, tl_report *report)
{
    const uint32_t first = tl_hull_face_first(hull, face), end = tl_hull_face_first(hull, face + 1);
    for (uint32_t h = first; h < end; h++) {
        const uint32_t origin = tl_hull_edge_origin(hull, h);
        if (tl_hull_edge_face(hull, h) != face || origin >= hull->vertex_count ||
            tl_hull_edge_twin(hull, h) >= hull->half_edge_count || origin < tl_hull_edge_origin(hull, first)) {
            return wrong_element(report, "half-edge", h);
        }
    }
    return TL_OK;
}

static tl_result check_loops(const tl_hull *hull, tl_report *report)
{
    const uint32_t count = hull->half_edge_count;
    if (tl_hull_face_first(hull, 0) != 0 || tl_hull_face_first(hull, hull->face_count) != count) {
        return wrong_field(report, "half_edge_count");
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        const uint32_t first = tl_hull_face_first(hull, f), end = tl_hull_face_first(hull, f + 1);
        if (end > count || first > count || end < first + 3) {
            return wrong_element(report, "face", f);
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        TL_TRY(check_loop(hull, f, report));
    }
    for (uint32_t h = 0; h < count; h++) {
        const tl_hull_half_edge edge = tl_hull_edge_at(hull, h), twin = tl_hull_edge_at(hull, edge.twin);
        if (edge.twin == h || twin.twin != h || twin.origin == edge.origin ||
            tl_hull_edge_origin(hull, edge.next) != twin.origin) {
            return wrong_element(report, "half-edge", h);
        }
    }
    return TL_OK;
}

// The half-edges that start at a vertex, and the next block behind those of all vertices.
typedef struct hull_ring_walk {
    uint32_t half_edges_seen, next_block;
} hull_ring_walk;

// A block with `count` neighbours, those of half-edge `edge` and on, which is moved behind them.
static bool check_block(const tl_hull *hull, uint32_t vertex, uint32_t *edge, uint32_t count, uint32_t more,
                        uint32_t at)
{
    uint32_t links[TL_CLIMB_LANES];
    for (uint32_t i = 0; i < count; i++) {
        links[i] = tl_hull_edge_origin(hull, tl_hull_edge_next(hull, *edge));
        *edge = tl_hull_edge_next(hull, tl_hull_edge_twin(hull, *edge));
    }
    tl_climb_block expected;
    tl_hull_fill_block(tl_hull_vertices(hull), vertex, links, count, &expected);
    if (more != TL_NO_VERTEX) {
        expected.link[TL_CLIMB_LANES - 1] = TL_CLIMB_MORE | more;
    }
    return memcmp(&expected, &tl_hull_blocks(hull)[at], sizeof expected) == 0;
}

// One vertex's ring and blocks. The loops are proven, so to turn around a vertex is a permutation of half-edges and the
// ring closes; rings of different vertices are disjoint, which bounds the work by 2 E.
static bool check_vertex_ring(const tl_hull *hull, uint32_t vertex, hull_ring_walk *walk)
{
    uint32_t start = tl_hull_vertex_edge(hull, vertex), edge = start, left = 0;
    if (start >= hull->half_edge_count) {
        return false;
    }
    do {
        if (tl_hull_edge_origin(hull, edge) != vertex) {
            return false;
        }
        left++;
        edge = tl_hull_edge_next(hull, tl_hull_edge_twin(hull, edge));
    } while (edge != start);
    walk->half_edges_seen += left;
    uint32_t at = vertex;
    for (; hull->vertex_count > TL_HULL_FEW && left > TL_CLIMB_LANES; left -= TL_CLIMB_LANES - 1) {
        if (walk->next_block == tl_hull_climb_head(hull)->block_count ||
            !check_block(hull, vertex, &edge, TL_CLIMB_LANES - 1, walk->next_block, at)) {
            return false;
        }
        at = walk->next_block++;
    }
    return hull->vertex_count <= TL_HULL_FEW || check_block(hull, vertex, &edge, left, TL_NO_VERTEX, at);
}

static tl_result check_rings(const tl_hull *hull, tl_report *report)
{
    hull_ring_walk walk = { 0, hull->vertex_count };
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        if (!check_vertex_ring(hull, v, &walk)) {
            return wrong_element(report, "vertex", v);
        }
    }
    if (walk.half_edges_seen != hull->half_edge_count) {
        return wrong_field(report, "vertex_edges");
    }
    return hull->vertex_count <= TL_HULL_FEW || walk.next_block == tl_hull_climb_head(hull)->block_count
               ? TL_OK
               : wrong_field(report, "block_count");
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
    return tl_hull_fit_plane(tl_hull_loop_of(hull, face));
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
    const uint32_t lanes = tl_hull_plane_lanes(hull);
    for (uint32_t f = hull->face_count; f % 8 < lanes && f % 8 != 0; f++) {
        tl_hull_plane plane = tl_hull_face_plane(hull, f), zero = { { 0.0 }, 0.0 };
        if (memcmp(&plane, &zero, sizeof plane) != 0) {
            return wrong_field(report, "planes");
        }
    }
    for (uint32_t lane = lanes; lane < 8; lane++) {
        const double out_of_reach = (double)INFINITY;
        if (memcmp(&tl_hull_plane_block(hull, 0)[3 * lanes + lane], &out_of_reach, sizeof out_of_reach) != 0) {
            return wrong_field(report, "planes");
        }
    }
    if (((hull->flags & TL_HULL_HAS_SIDES) != 0) != tl_hull_has_sides(hull)) {
        return wrong_field(report, "flags");
    }
    tl_hull_mass mass;
    (void)tl_hull_measure_mass(hull, NULL, &mass); // silent: nothing can stop it
    return memcmp(&mass, &hull->mass, sizeof mass) == 0 ? TL_OK : wrong_field(report, "mass");
}

// Exactly: every face lies in one plane and turns left at each corner, and at every edge the surface is bent inward.
// What this leaves open is a surface that winds around more than once, which only tl_hull_validate excludes.
static tl_result check_convexity(const tl_hull *hull, tl_report *report)
{
    for (uint32_t h = 0; h < hull->half_edge_count; h++) {
        uint32_t next = tl_hull_edge_next(hull, h), after = tl_hull_edge_next(hull, next);
        // Starts at a corner of the other face, off this edge.
        uint32_t beyond = tl_hull_edge_next(hull, tl_hull_edge_next(hull, tl_hull_edge_twin(hull, h)));
        if (tl_orient3d(tl_hull_corner(hull, h), tl_hull_corner(hull, next), tl_hull_corner(hull, after),
                        tl_hull_corner(hull, beyond)) >= 0) {
            return wrong_element(report, "half-edge", h);
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_face_at(hull, f);
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
    const uint32_t count = tl_hull_scan_count(hull);
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 p = tl_hull_scan_point(hull, i);
        if (!same_float_bits(rows[i], p.x) || !same_float_bits(rows[count + i], p.y) ||
            !same_float_bits(rows[2 * count + i], p.z)) {
            return wrong_field(report, "scan");
        }
    }
    bool right = same_float_bits(hull->scan_error, count > 0 ? tl_hull_scan_error(hull) : 0.0f);
    return right ? TL_OK : wrong_field(report, "scan_error");
}

// Any vertex is a right start, so the cells are only proven to hold vertices.
static tl_result check_cells(const tl_hull *hull, tl_report *report)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    const uint64_t squares = 2 * (uint64_t)climb->table_side * climb->table_side;
    for (uint64_t i = 0; i < squares + climb->ring_cells; i++) {
        const uint32_t cell = tl_hull_table_cell(hull, (uint32_t)i);
        const bool ring = i < squares && (cell & TL_TABLE_RING) != 0;
        if (ring ? (cell & ~TL_TABLE_RING) >= climb->ring_count : cell >= hull->vertex_count) {
            return wrong_element(report, "table cell", i);
        }
    }
    return TL_OK;
}

// Rings of faces, then those of caps. As any vertex is a right start, the latter are only proven to be safe to read.
static tl_result check_face_rings(const tl_hull *hull, tl_report *report)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    const tl_face_ring *rings = tl_hull_rings(hull);
    uint32_t count = 0, first = 2 * climb->table_side * climb->table_side;
    for (uint32_t face = 0; face < hull->face_count && climb->ring_count > 0; face++) {
        const uint32_t corners = tl_hull_face_at(hull, face).count;
        if (tl_face_has_ring(corners)) {
            tl_face_ring expected = tl_face_ring_make(hull, face, first);
            if (memcmp(&expected, &rings[count++], sizeof expected) != 0) {
                return wrong_element(report, "ring", count - 1);
            }
            first += tl_face_ring_cells(corners);
        }
    }
    const uint64_t end = tl_hull_cell_count(climb);
    for (; count < climb->ring_count; count++) {
        if (!tl_is_cap_ring(&rings[count], first, end)) {
            return wrong_element(report, "ring", count);
        }
        first += tl_cap_cells(rings[count].cell_count & ~TL_RING_OF_CAP);
    }
    return first == end ? TL_OK : wrong_field(report, "ring_cells");
}

static tl_result check_ring_counts(const tl_hull *hull, tl_report *report)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    tl_hull_climb expected = *climb;
    expected.ring_count = expected.ring_cells = 0;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_count_ring(hull->vertex_count, tl_hull_face_at(hull, f).count, &expected);
    }
    const bool caps_fit = climb->cap_count == 0 ? expected.ring_cells == climb->ring_cells
                                                : climb->table_side > 0 && expected.ring_cells < climb->ring_cells;
    return caps_fit && expected.ring_count + climb->cap_count == climb->ring_count ? TL_OK
                                                                                   : wrong_field(report, "ring_count");
}

static tl_result check_direction_table(const tl_hull *hull, tl_report *report)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    TL_TRY(check_cells(hull, report));
    TL_TRY(check_face_rings(hull, report));
    const tl_vec3 scale = tl_hull_table_scale(hull);
    return memcmp(&scale, &climb->table_scale, sizeof scale) == 0 ? TL_OK : wrong_field(report, "table_scale");
}

// A hull with merged faces: derived again from its vertices, with its sources, it must be the same bytes.
static tl_result check_merged(const tl_hull *hull, tl_report *report)
{
    tl_hull *again;
    const tl_result result = tl_hull_bake_merged(hull, hull->merge_distance, NULL, &again);
    if (result == TL_ERR_MEMORY) {
        return tl_report_fail(report, result, NULL, TL_NO_ELEMENT, "free some");
    }
    if (result != TL_OK) {
        return wrong_field(report, "vertices");
    }
    const char *wrong = memcmp(hull, again, sizeof *hull) != 0                                       ? "head"
                        : memcmp(hull + 1, again + 1, (size_t)(hull->blob.size - sizeof *hull)) != 0 ? "merge_distance"
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
    if (hull->merge_distance > 0.0f) {
        return check_merged(hull, report_out);
    }
    TL_TRY(check_planes_and_mass(hull, report_out));
    TL_TRY(check_convexity(hull, report_out));
    const bool climbs = hull->vertex_count > TL_HULL_FEW;
    TL_TRY(climbs ? check_ring_counts(hull, report_out) : TL_OK);
    TL_TRY(check_rings(hull, report_out));
    TL_TRY(check_scan(hull, report_out));
    return climbs ? check_direction_table(hull, report_out) : TL_OK;
}
