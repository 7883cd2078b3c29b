// SPDX-License-Identifier: MIT
//
// The driver of convex polygon generation: contour by contour an outline is prepared, triangulated and merged; then
// border vertices go, neighbours are linked, and all is moved into one block.
// Source: "Convex Polygon Generation", Critterai Navigation Mesh Generation documentation.

#include <talus/polygon.h>

#include "base/assert.h"
#include "base/compiler.h"
#include "base/host.h"
#include "polygon/mesh/merge_contours.h"
#include "polygon/mesh/polygon_store.h"
#include "polygon/optimal/divide_outline.h"
#include "polygon/outline/straight_vertices.h"

#include <string.h>

// Beyond this 3 * (triangles of one contour) could leave 32 bits once repairs have added corners.
#define MAX_CONTOUR_VERTICES (1u << 28)

// What a contour that touches itself nowhere takes of scratch memory, most of it while its triangles are merged.
#define SCRATCH_BYTES_A_VERTEX 200u

enum { STORED_AHEAD = 8 };

typedef struct polygon_mesh_builder {
    const tl_contour_set *contours;
    const tl_polygon_def *def;
    tl_arena arena;   // lives as long as the build
    tl_arena scratch; // emptied after each contour
    tl_polygon_store store;
    tl_place_counts places; // with drop_straight_vertices
    tl_polygon_report report;
} polygon_mesh_builder;

tl_polygon_def tl_default_polygon_def(void)
{
    tl_polygon_def def;
    memset(&def, 0, sizeof def);
    def.max_verts_per_poly = 6;
    def.method = TL_PARTITION_CLASSIC;
    def.merge_height = 2;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

static tl_result check_polygon_arguments(const tl_contour_set *set, const tl_polygon_def *def, uint32_t *vertex_count,
                                         tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_polygon_def()", report));
    if (def->max_verts_per_poly != 0 && (def->max_verts_per_poly < 3 || def->max_verts_per_poly > 64)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_verts_per_poly", "use 0 or 3 to 64");
    }
    if (def->method != TL_PARTITION_CLASSIC && def->method != TL_PARTITION_OPTIMAL &&
        def->method != TL_PARTITION_DELAUNAY) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "method", "use a TL_PARTITION_ value");
    }
    uint64_t vertices = 0;
    for (uint32_t i = 0; i < set->contour_count; i++) {
        const tl_contour *contour = &set->contours[i];
        if (contour->first_vertex > set->vertex_count ||
            contour->vertex_count > set->vertex_count - contour->first_vertex) {
            return tl_report_fail(report, TL_ERR_INDEX, "contour", i, "its vertices must lie within the set's");
        }
        vertices += contour->vertex_count;
        for (uint32_t k = 0; k < contour->vertex_count; k++) {
            const tl_contour_vertex *v = &set->vertices[contour->first_vertex + k];
            const int32_t limit = TL_MAX_CONTOUR_COORDINATE;
            if (v->x < -limit || v->x > limit || v->y < -limit || v->y > limit || v->z < -limit || v->z > limit) {
                return tl_report_fail(report, TL_ERR_RANGE, "contour", i,
                                      "coordinates must lie within +-TL_MAX_CONTOUR_COORDINATE");
            }
        }
    }
    if (vertices > MAX_CONTOUR_VERTICES) {
        return tl_report_fail(report, TL_ERR_LIMIT, "contour", TL_NO_ELEMENT, "divide the level into tiles");
    }
    *vertex_count = (uint32_t)vertices;
    return TL_OK;
}

// Merges the outline's nodes with those of earlier contours. Nodes that no walk uses make no vertex.
static tl_result merge_vertices(polygon_mesh_builder *b, const tl_outline *outline, uint32_t *map)
{
    const tl_outline_nodes *nodes = &outline->nodes;
    if (!outline->is_plain) {
        memset(map, 0xff, nodes->count * sizeof *map);
        for (uint32_t i = 0; i < outline->walk_first[outline->walk_count]; i++) {
            map[outline->corners[i]] = 0;
        }
    }
    for (uint32_t i = 0; i < nodes->count; i++) {
        if (TL_KEYS_AHEAD < nodes->count - i) {
            const tl_lattice_point later = nodes->points[i + TL_KEYS_AHEAD];
            tl_key_table_fetch(&b->store.places, tl_pair_key((uint32_t)later.x, (uint32_t)later.z));
        }
        if (outline->is_plain || map[i] == 0) {
            TL_TRY(tl_polygon_store_vertex(&b->store, nodes->points[i].x, nodes->heights[i], nodes->points[i].z,
                                           nodes->is_border[i], &map[i]));
        }
    }
    return TL_OK;
}

// Polygons come in no order of place: the numbers of the next ones' corners are fetched meanwhile.
static TL_ALWAYS_INLINE void fetch_corners_ahead(const tl_convex_parts *parts, uint32_t part, const uint32_t *map)
{
    if (STORED_AHEAD < parts->count - part) {
        for (uint32_t k = parts->first[part + STORED_AHEAD]; k < parts->first[part + STORED_AHEAD + 1]; k++) {
            tl_prefetch(&map[parts->corners[k]]);
        }
    }
}

static tl_result divide_contour(polygon_mesh_builder *b, uint32_t contour, const tl_outline *outline)
{
    uint32_t *map = TL_PUSH(&b->scratch, uint32_t, outline->nodes.count);
    if (map == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_division division;
    const tl_step_tracer tracer = { b->def->trace, contour };
    TL_TRY(tl_divide_outline(&b->scratch, outline, b->def->method, b->def->max_verts_per_poly,
                             b->def->trace != NULL ? &tracer : NULL, &division));
    TL_TRY(merge_vertices(b, outline, map));
    tl_stored_polygon of = { 0, 0, b->contours->contours[contour].region, b->contours->contours[contour].area,
                             contour };
    const tl_convex_parts *parts = &division.parts;
    for (uint32_t p = 0; p < parts->count; p++) {
        fetch_corners_ahead(parts, p, map);
        TL_TRY(tl_polygon_store_add(&b->store, parts->corners + parts->first[p], parts->first[p + 1] - parts->first[p],
                                    map, &of));
    }
    b->report.triangle_count += division.triangle_count;
    b->report.lower_bound += division.lower_bound;
    return TL_OK;
}

static int64_t stored_area2(const tl_polygon_store *store, uint32_t first_polygon)
{
    uint64_t sum = 0;
    for (uint32_t p = first_polygon; p < store->polygon_count; p++) {
        const uint32_t *corners = store->indices + store->polygons[p].first;
        for (uint32_t k = 1; k + 1 < store->polygons[p].count; k++) {
            sum += (uint64_t)tl_turn(tl_stored_point(store, corners[0]), tl_stored_point(store, corners[k]),
                                     tl_stored_point(store, corners[k + 1]));
        }
    }
    return (int64_t)sum;
}

// Prepares a contour without its straight vertices, where any may go. Not where it needs a repair: crossings that stand
// on such a vertex would be rounded to the lattice without need.
static tl_result prepare_without_straight(polygon_mesh_builder *b, const tl_contour *contour, tl_outline *outline,
                                          bool *is_prepared)
{
    tl_contour_vertex *kept = TL_PUSH(&b->scratch, tl_contour_vertex, contour->vertex_count);
    if (kept == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = tl_drop_straight_vertices(&b->places, b->contours, contour, kept);
    *is_prepared = false;
    if (count < contour->vertex_count) {
        TL_TRY(tl_outline_prepare(&b->scratch, kept, count, b->def->merge_height, outline));
        *is_prepared = outline->faults == 0;
        b->report.removed_straight_vertices += *is_prepared ? contour->vertex_count - count : 0;
    }
    return TL_OK;
}

static tl_result add_contour(polygon_mesh_builder *b, uint32_t index)
{
    const tl_contour *contour = &b->contours->contours[index];
    uint32_t first_polygon = b->store.polygon_count;
    tl_outline outline;
    bool is_prepared = false;
    if (b->def->drop_straight_vertices) {
        TL_TRY(prepare_without_straight(b, contour, &outline, &is_prepared));
    }
    if (!is_prepared) {
        TL_TRY(tl_outline_prepare(&b->scratch, tl_contour_begin(b->contours, contour), contour->vertex_count,
                                  b->def->merge_height, &outline));
    }
    if (outline.walk_count > 0) {
        TL_TRY(divide_contour(b, index, &outline));
    }
    if (outline.faults == 0) {
        return TL_OK;
    }
    tl_contour_note note;
    memset(&note, 0, sizeof note);
    note.contour = index;
    note.faults = outline.faults;
    note.vertex = outline.fault_vertex;
    note.contour_area2 = outline.area2;
    note.covered_area2 = stored_area2(&b->store, first_polygon);
    // Modulo 2^64, as the areas of outlines that wind around much floor several times are.
    b->report.uncovered_area2 =
        (int64_t)((uint64_t)b->report.uncovered_area2 + (uint64_t)note.contour_area2 - (uint64_t)note.covered_area2);
    if (note.faults & TL_CONTOUR_FAULT_REFUSED) {
        b->report.refused_contours++;
    } else if (note.faults & TL_CONTOUR_FAULT_EMPTY) {
        b->report.empty_contours++;
    } else {
        b->report.repaired_contours++;
    }
    return tl_polygon_store_note(&b->store, &note);
}

static tl_result add_contours(polygon_mesh_builder *b)
{
    uint32_t count = b->contours->contour_count;
    for (uint32_t i = 0; i < count; i++) {
        TL_TRY(tl_progress_update(&b->def->host, "polygons", i, count));
        tl_arena_mark mark = tl_arena_get_mark(&b->scratch);
        tl_result result = add_contour(b, i);
        if (result != TL_OK) {
            return tl_report_fail(&b->report.base, result, "contour", i, NULL);
        }
        tl_arena_rollback(&b->scratch, mark);
    }
    return tl_progress_update(&b->def->host, "polygons", count, count);
}

// A run of the block, aligned for all that is put there.
static size_t take(size_t *used, uint64_t count, size_t size)
{
    size_t offset = *used;
    *used += ((size_t)count * size + 15) & ~(size_t)15;
    return offset;
}

static tl_result write_mesh(polygon_mesh_builder *b, tl_polygon_mesh *mesh)
{
    const tl_polygon_store *store = &b->store;
    uint32_t polygons = store->polygon_count;
    uint32_t indices = store->index_count;
    size_t size = 0;
    size_t notes_at = take(&size, store->note_count, sizeof(tl_contour_note));
    size_t vertices_at = take(&size, 3 * (uint64_t)store->vertex_count, sizeof(int32_t));
    size_t first_at = take(&size, (uint64_t)polygons + 1, sizeof(uint32_t));
    size_t indices_at = take(&size, indices, sizeof(uint32_t));
    size_t neighbours_at = take(&size, indices, sizeof(uint32_t));
    size_t regions_at = take(&size, polygons, sizeof(uint32_t));
    size_t areas_at = take(&size, polygons, sizeof(uint32_t));
    size_t contours_at = take(&size, polygons, sizeof(uint32_t));
    char *block = tl_allocate_array(b->def->host.allocator, size, 1);
    if (block == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(block, 0, size);
    memset(mesh, 0, sizeof *mesh);
    mesh->allocator = tl_allocator_or_default(b->def->host.allocator);
    mesh->block = block;
    mesh->block_size = size;
    mesh->notes = (void *)(block + notes_at);
    mesh->vertices = (void *)(block + vertices_at);
    mesh->first = (void *)(block + first_at);
    mesh->indices = (void *)(block + indices_at);
    mesh->neighbours = (void *)(block + neighbours_at);
    mesh->regions = (void *)(block + regions_at);
    mesh->areas = (void *)(block + areas_at);
    mesh->contours = (void *)(block + contours_at);
    mesh->note_count = store->note_count;
    mesh->vertex_count = store->vertex_count;
    mesh->polygon_count = polygons;
    mesh->index_count = indices;
    mesh->bounds = b->contours->bounds;
    mesh->cell_size = b->contours->cell_size;
    mesh->cell_height = b->contours->cell_height;
    mesh->max_verts_per_poly = b->def->max_verts_per_poly;
    if (store->note_count > 0) {
        memcpy(mesh->notes, store->notes, store->note_count * sizeof *mesh->notes);
    }
    memcpy(mesh->vertices, store->vertices, 3 * (size_t)store->vertex_count * sizeof *mesh->vertices);
    memcpy(mesh->indices, store->indices, indices * sizeof *mesh->indices);
    memcpy(mesh->neighbours, store->neighbours, indices * sizeof *mesh->neighbours);
    for (uint32_t p = 0; p < polygons; p++) {
        mesh->first[p] = store->polygons[p].first;
        mesh->regions[p] = store->polygons[p].region;
        mesh->areas[p] = store->polygons[p].area;
        mesh->contours[p] = store->polygons[p].contour;
    }
    mesh->first[polygons] = indices;
    return TL_OK;
}

static uint32_t largest_contour(const tl_contour_set *contours)
{
    uint32_t most = 0;
    for (uint32_t i = 0; i < contours->contour_count; i++) {
        most = contours->contours[i].vertex_count > most ? contours->contours[i].vertex_count : most;
    }
    return most;
}

static tl_result build_mesh(polygon_mesh_builder *b, tl_polygon_mesh *mesh_out)
{
    uint32_t vertex_count = 0;
    TL_TRY(check_polygon_arguments(b->contours, b->def, &vertex_count, &b->report.base));
    // A first block that stays, large enough for most contours: none of them should cost an allocation.
    if (!tl_arena_reserve(&b->scratch, SCRATCH_BYTES_A_VERTEX * (uint64_t)largest_contour(b->contours))) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_polygon_store_init(&b->store, &b->arena, b->def, vertex_count));
    if (b->def->drop_straight_vertices && !tl_place_counts_init(&b->places, &b->arena, b->contours)) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(add_contours(b));
    if (!b->def->keep_border_vertices) {
        TL_TRY(tl_remove_border_vertices(&b->store, &b->scratch, b->def->max_verts_per_poly,
                                         &b->report.removed_border_vertices, &b->report.kept_border_vertices));
    }
    if (b->def->merge_contours) {
        TL_TRY(tl_merge_across_contours(&b->store, &b->scratch, b->def->max_verts_per_poly, &b->report.contour_merges));
    }
    TL_TRY(tl_link_neighbours(&b->store, &b->scratch, b->contours, &b->report));
    b->report.polygon_count = b->store.polygon_count;
    b->report.vertex_count = b->store.vertex_count;
    return write_mesh(b, mesh_out);
}

tl_result tl_polygon_mesh_bake(const tl_contour_set *contours, const tl_polygon_def *def, tl_polygon_mesh *mesh_out,
                               tl_polygon_report *report_out)
{
    tl_report *base = report_out != NULL ? &report_out->base : NULL;
    if (report_out != NULL) {
        memset(report_out, 0, sizeof *report_out);
    }
    tl_report_begin(base, "polygons");
    TL_REFUSE_NULL(mesh_out, base);
    memset(mesh_out, 0, sizeof *mesh_out);
    TL_REFUSE_NULL(contours, base);
    const tl_polygon_def defaults = tl_default_polygon_def();
    def = def != NULL ? def : &defaults;
    polygon_mesh_builder b;
    memset(&b, 0, sizeof b);
    b.contours = contours;
    b.def = def;
    b.report.contour_count = contours->contour_count;
    tl_report_begin(&b.report.base, "polygons");
    tl_arena_init(&b.arena, def->host.allocator);
    tl_arena_init(&b.scratch, def->host.allocator);
    tl_result result = build_mesh(&b, mesh_out);
    b.report.base.peak_bytes = b.arena.peak_bytes + b.scratch.peak_bytes + (result == TL_OK ? mesh_out->block_size : 0);
    tl_arena_free(&b.scratch);
    tl_arena_free(&b.arena);
    if (report_out != NULL) {
        *report_out = b.report;
    }
    return result;
}

void tl_polygon_mesh_free(tl_polygon_mesh *mesh)
{
    if (mesh != NULL) {
        tl_release_array(&mesh->allocator, mesh->block, mesh->block_size, 1);
        memset(mesh, 0, sizeof *mesh);
    }
}
