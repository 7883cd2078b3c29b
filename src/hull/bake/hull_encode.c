// SPDX-License-Identifier: MIT
//
// The polygons of a finished hull, laid out as one block: topology and planes for whoever reads them, and for the
// support query the rows of the scan, or the blocks of the climb and the direction table.

#include "base/assert.h"
#include "base/min_max.h"
#include "hull/bake/quickhull.h"
#include "hull/support/cap_ring.h"

#include <string.h>

// Vertices whose blocks are written between two calls of progress, at some 300 ns each.
enum { VERTICES_PER_CALL = 1 << 14 };

// What an encoding works with.
typedef struct hull_encoder {
    const tl_hull_polygons *polygons, *exact; // exact: what a climb goes along, so that it ends at a maximum
    const tl_vec3 *points;
    const tl_hull *named; // as in tl_quickhull
    uint32_t copies;
    uint32_t *degrees, *edges; // [vertex_count] of the exact polygons: at each vertex, and one that starts there
    tl_arena *arena;
    tl_stage *stage;
} hull_encoder;

// Of a hull that is climbed.
static tl_result count_blocks(hull_encoder *e, uint32_t *blocks_out)
{
    const tl_hull_polygons *polygons = e->exact;
    e->degrees = TL_PUSH_ZERO(e->arena, uint32_t, polygons->vertex_count);
    e->edges = TL_PUSH(e->arena, uint32_t, polygons->vertex_count);
    if (e->degrees == NULL || e->edges == NULL) {
        return TL_ERR_MEMORY;
    }
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

static void write_word(char *words, uint32_t bytes, uint64_t at, uint32_t value)
{
    if (bytes == 1) {
        ((uint8_t *)words)[at] = (uint8_t)value;
    } else if (bytes == 2) {
        ((uint16_t *)(void *)words)[at] = (uint16_t)value;
    } else {
        ((uint32_t *)(void *)words)[at] = value;
    }
}

static uint32_t source_of(const hull_encoder *e, uint32_t vertex)
{
    const uint32_t point = e->polygons->points[vertex] / e->copies;
    return e->named != NULL ? tl_hull_source(e->named, point) : point;
}

// The least bytes that hold all sources; none where they count up from 0.
static uint8_t least_source_bytes(const hull_encoder *e)
{
    bool counts = true;
    uint32_t largest = 0;
    for (uint32_t v = 0; v < e->polygons->vertex_count; v++) {
        const uint32_t source = source_of(e, v);
        counts = counts && source == v;
        largest = tl_max_u32(largest, source);
    }
    return counts ? 0 : largest < 0x100 ? 1 : largest < 0x10000 ? 2 : 4;
}

static tl_result write_hull_vertices(tl_hull *hull, const hull_encoder *e)
{
    tl_vec3 *vertices = (tl_vec3 *)(uintptr_t)tl_hull_vertices(hull);
    char *sources = (char *)hull + tl_hull_sources_offset(hull);
    hull->bounds = tl_aabb_empty();
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        TL_TRY(tl_stage_tick(e->stage, v));
        vertices[v] = e->points[e->polygons->points[v]];
        hull->bounds = tl_aabb_add_point(hull->bounds, vertices[v]);
        if (tl_hull_source_bytes(hull) > 0) {
            write_word(sources, tl_hull_source_bytes(hull), v, source_of(e, v));
        }
    }
    return TL_OK;
}

static tl_result write_topology(tl_hull *hull, const hull_encoder *e)
{
    const tl_hull_polygons *polygons = e->polygons;
    char *words = (char *)hull + hull->vertices + sizeof(tl_vec3) * (size_t)hull->vertex_count;
    const uint64_t firsts = 3 * (uint64_t)hull->half_edge_count, edges = firsts + hull->face_count + 1;
    const uint32_t bytes = hull->index_bytes;
    // Backwards, so that the first half-edge of each vertex stays.
    for (uint32_t h = hull->half_edge_count; h-- > 0;) {
        TL_TRY(tl_stage_tick(e->stage, h));
        const tl_hull_half_edge half_edge = polygons->half_edges[h];
        write_word(words, bytes, 3 * (uint64_t)h, half_edge.origin);
        write_word(words, bytes, 3 * (uint64_t)h + 1, half_edge.twin);
        write_word(words, bytes, 3 * (uint64_t)h + 2, half_edge.face);
        write_word(words, bytes, edges + half_edge.origin, h);
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        write_word(words, bytes, firsts + f, polygons->faces[f].first);
    }
    write_word(words, bytes, firsts + hull->face_count, hull->half_edge_count);
    return TL_OK;
}

// A merged face has the plane of the exact one that it grew from, which the whole hull lies behind.
static tl_result write_planes(tl_hull *hull, const hull_encoder *e)
{
    double *planes = (double *)(uintptr_t)tl_hull_plane_block(hull, 0);
    const uint32_t *plane_faces = e->polygons->plane_faces, lanes = tl_hull_plane_lanes(hull);
    for (uint32_t f = 0; f < hull->face_count; f++) {
        const tl_hull_face face = e->exact->faces[plane_faces != NULL ? plane_faces[f] : f];
        const tl_hull_half_edge *first = &e->exact->half_edges[face.first];
        const tl_hull_loop loop = { tl_hull_vertices(hull), (const char *)&first->origin, sizeof first->origin,
                                    sizeof *first, face.count };
        const tl_hull_plane plane = tl_hull_fit_plane(loop);
        double *at = planes + 32 * (size_t)(f / 8) + f % 8;
        at[0] = plane.normal[0];
        at[lanes] = plane.normal[1];
        at[2 * lanes] = plane.normal[2];
        at[3 * lanes] = plane.offset;
        TL_TRY(tl_stage_tick(e->stage, f));
    }
    for (uint32_t lane = lanes; lane < 8; lane++) {
        planes[3 * lanes + lane] = (double)INFINITY;
    }
    return TL_OK;
}

static void write_scan(tl_hull *hull)
{
    float *rows = (float *)(uintptr_t)tl_hull_scan_rows(hull);
    const uint32_t count = tl_hull_scan_count(hull);
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 r = tl_hull_scan_point(hull, i);
        rows[i] = r.x;
        rows[count + i] = r.y;
        rows[2 * count + i] = r.z;
    }
    hull->scan_error = tl_hull_scan_error(hull);
}

// Writes `count` neighbours, those of half-edge `edge` and on; the half-edge behind them.
static uint32_t write_climb_block(const hull_encoder *e, const tl_vec3 *vertices, uint32_t edge, uint32_t count,
                                  tl_climb_block *block)
{
    const tl_hull_half_edge *half_edges = e->exact->half_edges;
    const uint32_t vertex = half_edges[edge].origin;
    uint32_t links[TL_CLIMB_LANES];
    for (uint32_t i = 0; i < count; i++) {
        links[i] = half_edges[half_edges[edge].next].origin;
        edge = half_edges[half_edges[edge].twin].next;
    }
    tl_hull_fill_block(vertices, vertex, links, count, block);
    return edge;
}

static tl_result write_blocks(tl_hull *hull, const hull_encoder *e)
{
    tl_climb_block *blocks = (tl_climb_block *)(uintptr_t)tl_hull_blocks(hull);
    uint32_t behind = hull->vertex_count;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        uint32_t edge = e->edges[v], left = e->degrees[v], at = v;
        for (; left > TL_CLIMB_LANES; left -= TL_CLIMB_LANES - 1) {
            edge = write_climb_block(e, tl_hull_vertices(hull), edge, TL_CLIMB_LANES - 1, &blocks[at]);
            blocks[at].link[TL_CLIMB_LANES - 1] = TL_CLIMB_MORE | behind;
            at = behind++;
        }
        write_climb_block(e, tl_hull_vertices(hull), edge, left, &blocks[at]);
        TL_TRY(v % VERTICES_PER_CALL == 0 ? tl_stage_add(e->stage, 0) : TL_OK);
    }
    return TL_OK;
}

// What the queries of more than a few vertices need.
static tl_result write_climb(tl_hull *hull, const hull_encoder *e, const tl_hull_caps *caps)
{
    TL_TRY(write_blocks(hull, e));
    return tl_hull_climb_head(hull)->table_side > 0 ? tl_hull_fill_table(hull, caps, e->arena, e->stage) : TL_OK;
}

// All that comes before the table.
static tl_result write_body(tl_hull *hull, const tl_hull_climb *climb, const hull_encoder *e)
{
    TL_TRY(tl_stage_zero(e->stage, hull + 1, hull->blob.size - sizeof *hull));
    if (hull->vertex_count > TL_HULL_FEW) {
        memcpy((char *)hull + TL_HULL_CLIMB_OFFSET, climb, sizeof *climb);
    }
    TL_TRY(write_hull_vertices(hull, e));
    TL_TRY(write_topology(hull, e));
    TL_TRY(write_planes(hull, e));
    hull->flags = (uint8_t)(hull->flags | (tl_hull_has_sides(hull) ? TL_HULL_HAS_SIDES : 0));
    TL_TRY(tl_hull_measure_mass(hull, e->stage, &hull->mass));
    if (tl_hull_scan_count(hull) > 0) {
        write_scan(hull);
    }
    if (hull->vertex_count > TL_HULL_FEW) {
        tl_hull_climb *head = (tl_hull_climb *)(uintptr_t)tl_hull_climb_head(hull);
        head->table_scale = tl_hull_table_scale(hull);
    }
    return TL_OK;
}

static tl_hull *allocate_hull(const hull_encoder *e, uint64_t size)
{
    return tl_blob_allocate_part(&e->arena->allocator, TL_HULL_MAGIC, TL_HULL_VERSION, size, sizeof(tl_hull), size);
}

// Makes room for the rings of caps, which are found when all before the table is written: that stays what it is.
static tl_result make_room_for_caps(tl_hull **hull, const tl_hull_caps *caps, const hull_encoder *e)
{
    tl_hull head = **hull;
    tl_hull_climb climb = *tl_hull_climb_head(*hull);
    const size_t body = (size_t)climb.table * TL_BLOB_ALIGNMENT;
    tl_hull_count_caps(caps, &climb);
    const uint64_t size = tl_hull_lay_out(&head, &climb);
    tl_hull *larger = allocate_hull(e, size);
    if (larger == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_ASSERT((size_t)climb.table * TL_BLOB_ALIGNMENT == body);
    head.blob = larger->blob;
    memcpy(larger, *hull, body);
    memcpy(larger, &head, sizeof head);
    memcpy((char *)larger + TL_HULL_CLIMB_OFFSET, &climb, sizeof climb);
    memset((char *)larger + body, 0, (size_t)size - body);
    tl_blob_free(*hull);
    *hull = larger;
    return TL_OK;
}

static tl_result write_hull(tl_hull **hull, const tl_hull_climb *climb, const hull_encoder *e)
{
    TL_TRY(write_body(*hull, climb, e));
    if ((*hull)->vertex_count <= TL_HULL_FEW) {
        return TL_OK;
    }
    tl_hull_caps caps = { 0 };
    if (tl_hull_climb_head(*hull)->table_side > 0) {
        TL_TRY(tl_hull_find_caps(*hull, e->arena, e->stage, &caps));
    }
    TL_TRY(caps.count > 0 ? make_room_for_caps(hull, &caps, e) : TL_OK);
    return write_climb(*hull, e, &caps);
}

// The counts that the layout follows from; the size of the whole.
static tl_result lay_out(hull_encoder *e, tl_hull *head, tl_hull_climb *climb, uint64_t *size_out)
{
    const tl_hull_polygons *polygons = e->polygons;
    memset(head, 0, sizeof *head); // padding too: blobs are the same byte for byte
    memset(climb, 0, sizeof *climb);
    head->vertex_count = polygons->vertex_count;
    head->face_count = polygons->face_count;
    head->half_edge_count = polygons->half_edge_count;
    head->merge_distance = polygons->merge_distance;
    head->flags = least_source_bytes(e);
    if (polygons->vertex_count > TL_HULL_FEW) {
        TL_TRY(count_blocks(e, &climb->block_count));
    }
    for (uint32_t f = 0; f < polygons->face_count && polygons->vertex_count > TL_HULL_SCAN_LIMIT; f++) {
        tl_hull_count_ring(polygons->vertex_count, polygons->faces[f].count, climb);
    }
    *size_out = tl_hull_lay_out(head, climb);
    return TL_OK;
}

tl_result tl_hull_encode(const tl_hull_polygons *polygons, const tl_vec3 *points, const tl_hull *named, uint32_t copies,
                         tl_arena *arena, tl_stage *stage, tl_hull **hull_out)
{
    hull_encoder e = { .polygons = polygons, .points = points, .named = named, .copies = copies, .arena = arena };
    e.exact = polygons->exact != NULL ? polygons->exact : polygons;
    e.stage = stage;
    tl_hull head;
    tl_hull_climb climb;
    uint64_t size;
    TL_TRY(lay_out(&e, &head, &climb, &size));
    tl_hull *hull = allocate_hull(&e, size);
    if (hull == NULL) {
        return TL_ERR_MEMORY;
    }
    head.blob = hull->blob;
    memcpy(hull, &head, sizeof head);
    const tl_result result = write_hull(&hull, &climb, &e);
    if (result != TL_OK) {
        tl_blob_free(hull);
        return result;
    }
    *hull_out = hull;
    return TL_OK;
}
