// SPDX-License-Identifier: MIT
//
// The polygons of a finished hull, laid out as one block: topology and planes for whoever reads them, and for the
// support query the rows of the scan, or the blocks of the climb and the direction table.

#include "base/assert.h"
#include "hull/bake/quickhull.h"
#include "hull/support/hull_support.h"
#include "math/predicates.h"
#include "math/tolerance.h"
#include "math/vec3d.h"

#include <string.h>

// A plane's normal is right to this share of its length: 2^-45, which is what tl_area2d promises. At the far end of a
// face as large as the hull the plane is then off by some 3e-14 of the size.
#define TL_NORMAL_ERROR 2.8421709430404007e-14

// Vertices whose blocks are written between two calls of progress, at some 300 ns each.
enum { VERTICES_PER_CALL = 1 << 14 };

// What an encoding works with.
typedef struct hull_encoder {
    const tl_hull_polygons *polygons, *exact; // exact: what a climb goes along, so that it ends at a maximum
    const tl_vec3 *points;
    uint32_t copies;
    uint32_t *degrees, *edges; // [vertex_count] of the exact polygons: at each vertex, and one that starts there
    tl_arena *arena;
    tl_stage *stage;
} hull_encoder;

static tl_result count_blocks(const hull_encoder *e, uint32_t *blocks_out)
{
    const tl_hull_polygons *polygons = e->exact;
    *blocks_out = 0;
    for (uint32_t h = polygons->half_edge_count; h-- > 0;) {
        TL_TRY(tl_stage_tick(e->stage, h));
        const uint32_t v = polygons->half_edges[h].origin;
        e->degrees[v]++;
        e->edges[v] = h; // the first stays
    }
    for (uint32_t v = 0; v < polygons->vertex_count; v++) {
        *blocks_out += tl_hull_blocks_of(e->degrees[v]);
    }
    return TL_OK;
}

static tl_result write_topology(tl_hull *hull, const hull_encoder *e)
{
    const tl_hull_polygons *polygons = e->polygons;
    tl_stage *stage = e->stage;
    char *bytes = (char *)hull;
    tl_vec3 *vertices = (tl_vec3 *)(void *)(bytes + hull->vertices);
    uint32_t *sources = (uint32_t *)(void *)(bytes + hull->sources);
    uint32_t *vertex_edges = (uint32_t *)(void *)(bytes + hull->vertex_edges);
    tl_hull_half_edge *half_edges = (tl_hull_half_edge *)(void *)(bytes + hull->half_edges);
    tl_hull_face *faces = (tl_hull_face *)(void *)(bytes + hull->faces);
    hull->bounds = tl_aabb_empty();
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        TL_TRY(tl_stage_tick(stage, v));
        vertices[v] = e->points[polygons->points[v]];
        sources[v] = polygons->points[v] / e->copies;
        vertex_edges[v] = TL_NONE;
        hull->bounds = tl_aabb_add_point(hull->bounds, vertices[v]);
    }
    for (uint32_t h = 0; h < hull->half_edge_count; h++) {
        TL_TRY(tl_stage_tick(stage, h));
        half_edges[h] = polygons->half_edges[h];
        if (vertex_edges[half_edges[h].origin] == TL_NONE) {
            vertex_edges[half_edges[h].origin] = h;
        }
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        faces[f] = polygons->faces[f];
    }
    return TL_OK;
}

// Twice the area's vector of a triangle, (b - a) x (c - a), to within TL_NORMAL_ERROR of its length. A face may be
// thinner than double rounding: then the digits are summed exactly.
static tl_vec3d normal_of(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    tl_vec3d u = tl_vec3d_sub(tl_vec3d_from(b), tl_vec3d_from(a));
    tl_vec3d v = tl_vec3d_sub(tl_vec3d_from(c), tl_vec3d_from(a));
    tl_vec3d n = tl_vec3d_cross(u, v);
    double products =
        fabs(u.y * v.z) + fabs(u.z * v.y) + fabs(u.z * v.x) + fabs(u.x * v.z) + fabs(u.x * v.y) + fabs(u.y * v.x);
    if (TL_CROSS_ERROR * products <= TL_NORMAL_ERROR * (fabs(n.x) + fabs(n.y) + fabs(n.z))) {
        return n;
    }
    return tl_vec3d_make(tl_area2d(a.y, a.z, b.y, b.z, c.y, c.z), tl_area2d(a.z, a.x, b.z, b.x, c.z, c.x),
                         tl_area2d(a.x, a.y, b.x, b.y, c.x, c.y));
}

static tl_vec3 face_corner(const tl_vec3 *vertices, const tl_hull_half_edge *half_edges, uint32_t half_edge)
{
    return vertices[half_edges[half_edge].origin];
}

// The fan triangle with the largest area spans the plane best.
tl_hull_plane tl_hull_fit_plane(const tl_vec3 *vertices, const tl_hull_half_edge *half_edges, tl_hull_face face)
{
    tl_vec3 a = face_corner(vertices, half_edges, face.first);
    uint32_t best = 1;
    double best_area = 0.0;
    for (uint32_t k = 1; k + 1 < face.count && face.count > 3; k++) {
        tl_vec3d u = tl_vec3d_sub(tl_vec3d_from(face_corner(vertices, half_edges, face.first + k)), tl_vec3d_from(a));
        tl_vec3d v =
            tl_vec3d_sub(tl_vec3d_from(face_corner(vertices, half_edges, face.first + k + 1)), tl_vec3d_from(a));
        tl_vec3d normal = tl_vec3d_cross(u, v);
        double area = tl_vec3d_dot(normal, normal);
        if (area > best_area) {
            best_area = area;
            best = k;
        }
    }
    tl_vec3 b = face_corner(vertices, half_edges, face.first + best);
    tl_vec3 c = face_corner(vertices, half_edges, face.first + best + 1);
    tl_vec3d n = normal_of(a, b, c);
    double length = tl_vec3d_length(n);
    tl_hull_plane plane = { { n.x / length, n.y / length, n.z / length }, -(double)INFINITY };
    for (uint32_t k = 0; k < face.count; k++) {
        tl_vec3 p = face_corner(vertices, half_edges, face.first + k);
        double offset = plane.normal[0] * (double)p.x + plane.normal[1] * (double)p.y + plane.normal[2] * (double)p.z;
        plane.offset = offset > plane.offset ? offset : plane.offset;
    }
    return plane;
}

// A merged face has the plane of the exact one that it grew from, which the whole hull lies behind.
static tl_result write_planes(tl_hull *hull, const hull_encoder *e)
{
    tl_hull_plane_block *blocks = (tl_hull_plane_block *)(void *)((char *)hull + hull->planes);
    const uint32_t *plane_faces = e->polygons->plane_faces;
    for (uint32_t f = 0; f < hull->face_count; f++) {
        const tl_hull_face face = e->exact->faces[plane_faces != NULL ? plane_faces[f] : f];
        tl_hull_plane plane = tl_hull_fit_plane(tl_hull_vertices(hull), e->exact->half_edges, face);
        tl_hull_plane_block *block = &blocks[f / 8];
        block->x[f % 8] = plane.normal[0];
        block->y[f % 8] = plane.normal[1];
        block->z[f % 8] = plane.normal[2];
        block->offset[f % 8] = plane.offset;
        TL_TRY(tl_stage_tick(e->stage, f));
    }
    return TL_OK;
}

static void write_scan(tl_hull *hull)
{
    float *rows = (float *)(uintptr_t)tl_hull_scan_rows(hull);
    for (uint32_t i = 0; i < hull->scan_count; i++) {
        tl_vec3 r = tl_hull_scan_point(hull, i);
        rows[i] = r.x;
        rows[hull->scan_count + i] = r.y;
        rows[2 * hull->scan_count + i] = r.z;
    }
    hull->scan_error = tl_hull_scan_error(hull);
}

static tl_result write_blocks(tl_hull *hull, const hull_encoder *e)
{
    tl_climb_block *blocks = (tl_climb_block *)(uintptr_t)tl_hull_blocks(hull);
    uint32_t behind = hull->vertex_count;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        uint32_t edge = e->edges[v], left = e->degrees[v], at = v;
        for (;;) {
            bool more = left > TL_CLIMB_LANES;
            tl_hull_fill_block(tl_hull_vertices(hull), e->exact->half_edges, &edge, more ? TL_CLIMB_LANES - 1 : left,
                               &blocks[at]);
            if (!more) {
                break;
            }
            left -= TL_CLIMB_LANES - 1;
            blocks[at].link[TL_CLIMB_LANES - 1] = TL_CLIMB_MORE | behind;
            at = behind++;
        }
        TL_TRY(v % VERTICES_PER_CALL == 0 ? tl_stage_add(e->stage, 0) : TL_OK);
    }
    return TL_OK;
}

static tl_result write_hull(tl_hull *hull, const hull_encoder *e)
{
    TL_TRY(tl_stage_zero(e->stage, hull + 1, hull->blob.size - sizeof *hull));
    TL_TRY(write_topology(hull, e));
    TL_TRY(write_planes(hull, e));
    TL_TRY(tl_hull_measure_mass(hull, e->stage, &hull->mass));
    hull->table_scale = tl_hull_table_scale(hull);
    TL_TRY(write_blocks(hull, e));
    if (hull->scan_count > 0) {
        write_scan(hull);
        return TL_OK;
    }
    return tl_hull_fill_table(hull, e->arena, e->stage);
}

tl_result tl_hull_encode(const tl_hull_polygons *polygons, const tl_vec3 *points, uint32_t copies, tl_arena *arena,
                         tl_stage *stage, tl_hull **hull_out)
{
    hull_encoder e = {
        polygons, polygons->exact != NULL ? polygons->exact : polygons, points, copies, NULL, NULL, arena, stage
    };
    e.degrees = TL_PUSH_ZERO(arena, uint32_t, polygons->vertex_count);
    e.edges = TL_PUSH(arena, uint32_t, polygons->vertex_count);
    if (e.degrees == NULL || e.edges == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_hull head;
    memset(&head, 0, sizeof head); // padding too: blobs are the same byte for byte
    uint64_t size;
    head.vertex_count = polygons->vertex_count;
    head.face_count = polygons->face_count;
    head.half_edge_count = polygons->half_edge_count;
    head.merge_distance = polygons->merge_distance;
    TL_TRY(count_blocks(&e, &head.block_count));
    tl_hull_count_rings(&head, polygons->faces);
    size = tl_hull_lay_out(&head);
    tl_hull *hull = tl_blob_allocate_part(&arena->allocator, TL_HULL_MAGIC, TL_HULL_VERSION, size, sizeof *hull, size);
    if (hull == NULL) {
        return TL_ERR_MEMORY;
    }
    head.blob = hull->blob;
    memcpy(hull, &head, sizeof head);
    const tl_result result = write_hull(hull, &e);
    if (result != TL_OK) {
        tl_blob_free(hull);
        return result;
    }
    *hull_out = hull;
    return TL_OK;
}
