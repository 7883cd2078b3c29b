// SPDX-License-Identifier: MIT
//
// Whether the polygons of a contour have the contour's outline: along every line, the polygons' edges and the contour's
// edges run backward must cover each stretch as often in one direction as in the other (as chains of edges their sum is
// zero). Then edges between two polygons cancel, and so do bridges; and no edge needs a partner with the same ends, so
// it does not matter which vertices within straight runs the polygons have kept.
//
// What covers a line changes only where edges begin and end. So it is enough to sum, for each end and each direction of
// a line through it, the edges that begin there less those that end there: all sums must be zero.

#include "polygon/check/polygon_check.h"

#include "polygon/outline/key_table.h"
#include "polygon/outline/outline.h"

#include <string.h>

typedef struct edge_ends {
    tl_key_table points;     // (x, z) to a number
    tl_key_table directions; // of lines, to a number
    tl_key_table ends;       // (point, direction) to a place in sums
    int32_t *sums;           // edges that go out along the line, less those that come in
    uint32_t point_count, direction_count, end_count;
} edge_ends;

static uint32_t common_divisor(uint32_t a, uint32_t b)
{
    while (b != 0) {
        const uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static uint32_t number_of(tl_key_table *table, uint64_t key, uint32_t *count)
{
    uint32_t *place = tl_key_table_at(table, key);
    if (*place == TL_NO_VALUE) {
        *place = (*count)++;
    }
    return *place;
}

static void add_end(edge_ends *e, tl_lattice_point point, uint32_t direction, int32_t amount)
{
    const uint32_t number = number_of(&e->points, tl_pair_key((uint32_t)point.x, (uint32_t)point.z), &e->point_count);
    const uint32_t known = e->end_count;
    const uint32_t place = number_of(&e->ends, tl_pair_key(number, direction), &e->end_count);
    if (place == known) {
        e->sums[place] = 0;
    }
    e->sums[place] += amount;
}

static void add_edge_ends(edge_ends *e, tl_lattice_point from, tl_lattice_point to)
{
    int32_t dx = to.x - from.x, dz = to.z - from.z;
    if (dx == 0 && dz == 0) {
        return;
    }
    // A line has one direction, whichever way an edge runs along it.
    if (dx < 0 || (dx == 0 && dz < 0)) {
        dx = -dx;
        dz = -dz;
    }
    const int32_t divisor = (int32_t)common_divisor((uint32_t)dx, (uint32_t)(dz < 0 ? -dz : dz));
    const uint32_t direction =
        number_of(&e->directions, tl_pair_key((uint32_t)(dx / divisor), (uint32_t)(dz / divisor)), &e->direction_count);
    add_end(e, from, direction, 1);
    add_end(e, to, direction, -1);
}

static bool init_edge_ends(edge_ends *e, tl_arena *arena, uint64_t edge_count)
{
    memset(e, 0, sizeof *e);
    e->sums = TL_PUSH(arena, int32_t, 2 * edge_count);
    return e->sums != NULL && tl_key_table_init(&e->points, arena, 2 * edge_count) &&
           tl_key_table_init(&e->directions, arena, edge_count) && tl_key_table_init(&e->ends, arena, 2 * edge_count);
}

static tl_lattice_point point_of(const tl_contour_vertex *vertex)
{
    const tl_lattice_point p = { vertex->x, vertex->z };
    return p;
}

tl_result tl_polygon_check_outline(tl_polygon_checker *checker, const tl_sort_item *polygons, uint32_t count,
                                   uint32_t contour_index)
{
    const tl_polygon_mesh *mesh = checker->mesh;
    const tl_contour *contour = &checker->contours->contours[contour_index];
    const tl_contour_vertex *vertices = tl_contour_begin(checker->contours, contour);
    uint64_t edge_count = contour->vertex_count;
    for (uint32_t i = 0; i < count; i++) {
        edge_count += mesh->first[polygons[i].value + 1] - mesh->first[polygons[i].value];
    }
    edge_ends e;
    if (!init_edge_ends(&e, &checker->arena, edge_count)) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t p = polygons[i].value;
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            add_edge_ends(&e, tl_mesh_corner(mesh, k), tl_mesh_corner(mesh, tl_mesh_next(mesh, p, k)));
        }
    }
    for (uint32_t k = 0; k < contour->vertex_count; k++) {
        add_edge_ends(&e, point_of(&vertices[k + 1 < contour->vertex_count ? k + 1 : 0]), point_of(&vertices[k]));
    }
    for (uint32_t i = 0; i < e.end_count; i++) {
        if (e.sums[i] != 0) {
            tl_polygon_checker_note(checker, TL_POLYGON_FAULT_OUTLINE, "contour", contour_index);
            break;
        }
    }
    return TL_OK;
}
