// SPDX-License-Identifier: MIT
//
// The validator's second half: do the polygons of one contour cover it exactly?
//
// Overlap: two convex polygons are apart when one of them has an edge with all of the other on its outer side (the
// separating axis theorem in the plane). Covering: disjoint polygons inside an outline whose area is the outline's.
// That they are inside follows from their common outline, which is the contour's: see outline_balance.c.

#include "polygon/check/polygon_check.h"

#include "base/assert.h"
#include "base/disjoint_sets.h"
#include "base/radix_sort.h"
#include "polygon/outline/outline.h"

#include <string.h>

// Of all polygons of a group. Below so many pairs are quicker.
enum { FEWEST_SWEPT_CORNERS = 256 };

typedef struct lattice_box {
    int32_t min_x, max_x, min_z, max_z;
} lattice_box;

// Polygons of one contour: a range of `order`. Those of several contours are parted into pieces that hang together by
// edges: two pieces are different floors, which may lie over one another.
typedef struct cover {
    tl_polygon_checker *checker;
    tl_sort_item *order; // polygons by group, then by their lowest x
    lattice_box *boxes;  // of each polygon
    tl_sort_item *vertices;
    uint32_t first, end;
} cover;

static lattice_box polygon_box(const tl_polygon_mesh *mesh, uint32_t p)
{
    tl_lattice_point a = tl_mesh_corner(mesh, mesh->first[p]);
    lattice_box box = { a.x, a.x, a.z, a.z };
    for (uint32_t k = mesh->first[p] + 1; k < mesh->first[p + 1]; k++) {
        a = tl_mesh_corner(mesh, k);
        box.min_x = a.x < box.min_x ? a.x : box.min_x;
        box.max_x = a.x > box.max_x ? a.x : box.max_x;
        box.min_z = a.z < box.min_z ? a.z : box.min_z;
        box.max_z = a.z > box.max_z ? a.z : box.max_z;
    }
    return box;
}

// How far a corner lies to the inner side of the edge at k of polygon p, times the edge's length.
static int64_t depth_of_corner(const tl_polygon_mesh *mesh, uint32_t p, uint32_t k, uint32_t corner)
{
    return tl_turn(tl_mesh_corner(mesh, k), tl_mesh_corner(mesh, tl_mesh_next(mesh, p, k)),
                   tl_mesh_corner(mesh, corner));
}

// Whether an edge of p has all of q on its outer side. As the edges of p turn once around, the corner of q that is
// deepest inside goes around q once: O(corners) in all.
static bool has_separating_edge(const tl_polygon_mesh *mesh, uint32_t p, uint32_t q)
{
    const uint32_t begin = mesh->first[p];
    uint32_t deepest = mesh->first[q];
    for (uint32_t j = deepest + 1; j < mesh->first[q + 1]; j++) {
        deepest = depth_of_corner(mesh, p, begin, j) > depth_of_corner(mesh, p, begin, deepest) ? j : deepest;
    }
    for (uint32_t k = begin; k < mesh->first[p + 1]; k++) {
        uint32_t next = tl_mesh_next(mesh, q, deepest);
        while (depth_of_corner(mesh, p, k, next) > depth_of_corner(mesh, p, k, deepest)) {
            deepest = next;
            next = tl_mesh_next(mesh, q, deepest);
        }
        if (depth_of_corner(mesh, p, k, deepest) <= 0) {
            return true;
        }
    }
    return false;
}

static uint32_t x_key(int32_t x)
{
    return (uint32_t)(x + TL_MAX_CONTOUR_COORDINATE);
}

// A key of `order`: x_key, at most 2 * TL_MAX_CONTOUR_COORDINATE = 2^30, under the 33 bits of the group.
enum { GROUP_SHIFT = 31 };

static uint32_t group_x(uint64_t key)
{
    return (uint32_t)(key & (((uint64_t)1 << GROUP_SHIFT) - 1));
}

typedef struct height_range {
    int32_t low, high;
} height_range;

static height_range heights_of(const tl_polygon_mesh *mesh, uint32_t p)
{
    height_range range = { INT32_MAX, INT32_MIN };
    for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
        int32_t y = mesh->vertices[3 * (size_t)mesh->indices[k] + 1];
        range.low = y < range.low ? y : range.low;
        range.high = y > range.high ? y : range.high;
    }
    return range;
}

// A stair or a spiral joins floors that lie over one another. One contour never holds both, but polygons of several
// contours that hang together may; what tells such floors apart is that their heights do not meet.
static bool are_floors_apart(const tl_polygon_mesh *mesh, uint32_t p, uint32_t q)
{
    if (mesh->contours[p] != TL_SEVERAL_CONTOURS) {
        return false;
    }
    height_range a = heights_of(mesh, p), b = heights_of(mesh, q);
    return a.high < b.low || b.high < a.low;
}

static bool is_vertex_apart(const tl_polygon_mesh *mesh, uint32_t p, uint32_t vertex)
{
    height_range range = heights_of(mesh, p);
    int32_t y = mesh->vertices[3 * (size_t)vertex + 1];
    return mesh->contours[p] == TL_SEVERAL_CONTOURS && (y < range.low || y > range.high);
}

static void check_overlaps(cover *c)
{
    const tl_polygon_mesh *mesh = c->checker->mesh;
    for (uint32_t i = c->first; i < c->end; i++) {
        const lattice_box a = c->boxes[c->order[i].value];
        for (uint32_t j = i + 1; j < c->end && group_x(c->order[j].key) < x_key(a.max_x); j++) {
            const lattice_box b = c->boxes[c->order[j].value];
            if (a.min_z < b.max_z && b.min_z < a.max_z &&
                !has_separating_edge(mesh, c->order[i].value, c->order[j].value) &&
                !has_separating_edge(mesh, c->order[j].value, c->order[i].value) &&
                !are_floors_apart(mesh, c->order[i].value, c->order[j].value)) {
                tl_polygon_checker_note(c->checker, TL_POLYGON_FAULT_OVERLAP, "polygon", c->order[j].value);
            }
        }
    }
}

static bool lies_inside_edge(const tl_polygon_mesh *mesh, uint32_t p, uint32_t k, tl_lattice_point v)
{
    const tl_lattice_point a = tl_mesh_corner(mesh, k), b = tl_mesh_corner(mesh, tl_mesh_next(mesh, p, k));
    return tl_turn(a, b, v) == 0 && tl_within_span(a, b, v) && !tl_same_point(a, v) && !tl_same_point(b, v);
}

// Seen from a convex polygon's first corner the others turn left: a search finds the edge towards which a point lies.
static bool lies_inside_an_edge(const tl_polygon_mesh *mesh, uint32_t p, tl_lattice_point v)
{
    const uint32_t first = mesh->first[p], last = mesh->first[p + 1] - 1;
    uint32_t k = first + 1; // the point lies between the ways to this corner and to the next one
    for (uint32_t rest = last - first - 2; rest > 0;) {
        const uint32_t half = (rest + 1) / 2;
        const bool on = tl_turn(tl_mesh_corner(mesh, first), tl_mesh_corner(mesh, k + half), v) >= 0;
        k = on ? k + half : k;
        rest = on ? rest - half : half - 1;
    }
    return lies_inside_edge(mesh, p, first, v) || lies_inside_edge(mesh, p, k, v) || lies_inside_edge(mesh, p, last, v);
}

// The contour's vertices, sorted by x, against its polygons' edges.
static void check_t_junctions(cover *c)
{
    const tl_polygon_mesh *mesh = c->checker->mesh;
    uint32_t count = 0;
    uint64_t last = UINT64_MAX;
    uint32_t filled = 0;
    for (uint32_t i = c->first; i < c->end; i++) {
        uint32_t p = c->order[i].value;
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            tl_lattice_point v = tl_mesh_corner(mesh, k);
            tl_sort_item item = { (uint64_t)x_key(v.x) << 32 | x_key(v.z), mesh->indices[k], 0 };
            c->vertices[filled++] = item;
        }
    }
    tl_radix_sort(c->vertices, c->vertices + filled, filled);
    for (uint32_t i = 0; i < filled; i++) {
        if (c->vertices[i].key != last) {
            last = c->vertices[i].key;
            c->vertices[count++] = c->vertices[i];
        }
    }
    for (uint32_t i = c->first; i < c->end; i++) {
        uint32_t p = c->order[i].value;
        const lattice_box box = c->boxes[p];
        uint32_t low = 0;
        for (uint32_t rest = count; rest > 0;) {
            uint32_t half = rest / 2;
            bool below = (uint32_t)(c->vertices[low + half].key >> 32) < x_key(box.min_x);
            low = below ? low + half + 1 : low;
            rest = below ? rest - half - 1 : half;
        }
        for (; low < count && (uint32_t)(c->vertices[low].key >> 32) <= x_key(box.max_x); low++) {
            tl_lattice_point v = tl_mesh_point(mesh, c->vertices[low].value);
            if (v.z >= box.min_z && v.z <= box.max_z && lies_inside_an_edge(mesh, p, v) &&
                !is_vertex_apart(mesh, p, c->vertices[low].value)) {
                tl_polygon_checker_note(c->checker, TL_POLYGON_FAULT_T_JUNCTION, "polygon", p);
            }
        }
    }
}

// Pairs take the square of the time where many polygons are as wide as the contour: a comb's, a spiral's.
static tl_result check_cover_of(cover *c)
{
    const tl_polygon_mesh *mesh = c->checker->mesh;
    bool is_proven = false;
    uint64_t corners = 0;
    for (uint32_t i = c->first; i < c->end && corners < FEWEST_SWEPT_CORNERS; i++) {
        corners += mesh->first[c->order[i].value + 1] - mesh->first[c->order[i].value];
    }
    if (corners >= FEWEST_SWEPT_CORNERS) {
        const tl_arena_mark mark = tl_arena_get_mark(&c->checker->arena);
        TL_TRY(tl_polygon_sweep_cover(c->checker, c->order + c->first, c->end - c->first, &is_proven));
        tl_arena_rollback(&c->checker->arena, mark);
    }
    if (!is_proven) {
        check_overlaps(c);
        check_t_junctions(c);
    }
    return TL_OK;
}

// Joins neighbours of several contours; a piece is named by its lowest polygon.
static uint32_t *join_polygon_pieces(const tl_polygon_mesh *mesh, tl_arena *arena)
{
    uint32_t *parent = TL_PUSH(arena, uint32_t, mesh->polygon_count);
    if (parent != NULL) {
        tl_disjoint_sets_init(parent, mesh->polygon_count);
    }
    for (uint32_t p = 0; parent != NULL && p < mesh->polygon_count; p++) {
        for (uint32_t k = mesh->first[p]; mesh->contours[p] == TL_SEVERAL_CONTOURS && k < mesh->first[p + 1]; k++) {
            uint32_t beside = mesh->neighbours[k];
            if (beside < mesh->polygon_count && mesh->contours[beside] == TL_SEVERAL_CONTOURS) {
                tl_disjoint_sets_unite(parent, p, beside);
            }
        }
    }
    return parent;
}

static tl_result sort_polygons(cover *c)
{
    const tl_polygon_mesh *mesh = c->checker->mesh;
    tl_arena *arena = &c->checker->arena;
    c->order = TL_PUSH(arena, tl_sort_item, 2 * (uint64_t)mesh->polygon_count);
    c->boxes = TL_PUSH(arena, lattice_box, mesh->polygon_count);
    c->vertices = TL_PUSH(arena, tl_sort_item, 2 * (uint64_t)mesh->index_count);
    uint32_t *pieces = join_polygon_pieces(mesh, arena);
    if (c->order == NULL || c->boxes == NULL || c->vertices == NULL || pieces == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        bool is_shared = mesh->contours[p] == TL_SEVERAL_CONTOURS;
        uint64_t group = is_shared ? ((uint64_t)1 << 32) + tl_disjoint_sets_find(pieces, p) : mesh->contours[p];
        c->boxes[p] = polygon_box(mesh, p);
        tl_sort_item item = { group << GROUP_SHIFT | x_key(c->boxes[p].min_x), p, 0 };
        c->order[p] = item;
    }
    tl_radix_sort(c->order, c->order + mesh->polygon_count, mesh->polygon_count);
    return TL_OK;
}

// Doubled area of the polygons of each contour; polygons of several contours go into *shared. Modulo 2^64: a mesh that
// is wrong may have any number of polygons on one place.
static uint64_t *sum_contour_areas(tl_polygon_checker *checker, uint64_t *shared)
{
    const tl_polygon_mesh *mesh = checker->mesh;
    uint64_t *areas = TL_PUSH_ZERO(&checker->arena, uint64_t, checker->contours->contour_count);
    *shared = 0;
    for (uint32_t p = 0; areas != NULL && p < mesh->polygon_count; p++) {
        uint64_t *sum = mesh->contours[p] == TL_SEVERAL_CONTOURS ? shared : &areas[mesh->contours[p]];
        for (uint32_t k = mesh->first[p] + 1; k + 1 < mesh->first[p + 1]; k++) {
            *sum += (uint64_t)tl_turn(tl_mesh_corner(mesh, mesh->first[p]), tl_mesh_corner(mesh, k),
                                      tl_mesh_corner(mesh, k + 1));
        }
    }
    return areas;
}

static int64_t contour_area2(const tl_contour_set *set, uint32_t index)
{
    const tl_contour_vertex *v = tl_contour_begin(set, &set->contours[index]);
    uint64_t sum = 0;
    for (uint32_t k = 1; k + 1 < set->contours[index].vertex_count; k++) {
        tl_lattice_point a = { v[0].x, v[0].z }, b = { v[k].x, v[k].z }, d = { v[k + 1].x, v[k + 1].z };
        sum += (uint64_t)tl_turn(a, b, d);
    }
    return (int64_t)sum;
}

// is_whole_out[i]: contour i is covered by polygons of its own alone and has no note.
static tl_result check_areas(tl_polygon_checker *checker, uint8_t *is_whole)
{
    const tl_polygon_mesh *mesh = checker->mesh;
    uint64_t shared;
    uint64_t *areas = sum_contour_areas(checker, &shared);
    if (areas == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t note = 0;
    uint64_t missing = 0;
    for (uint32_t i = 0; i < checker->contours->contour_count; i++) {
        int64_t expected = contour_area2(checker->contours, i);
        is_whole[i] = 1;
        for (; note < mesh->note_count && mesh->notes[note].contour <= i; note++) {
            if (mesh->notes[note].contour == i) {
                expected = mesh->notes[note].covered_area2;
                is_whole[i] = 0;
            }
        }
        // Polygons of several contours may hold the rest.
        int64_t rest = (int64_t)((uint64_t)expected - areas[i]);
        if (rest < 0 || (rest > 0 && shared == 0)) {
            tl_polygon_checker_note(checker, TL_POLYGON_FAULT_AREA, "contour", i);
        }
        if (rest > 0) {
            missing += (uint64_t)rest;
            is_whole[i] = 0;
        }
    }
    if (shared != 0 && missing != shared) {
        tl_polygon_checker_note(checker, TL_POLYGON_FAULT_AREA, "contour", TL_NO_ELEMENT);
    }
    return TL_OK;
}

tl_result tl_polygon_check_cover(tl_polygon_checker *checker)
{
    cover c;
    memset(&c, 0, sizeof c);
    c.checker = checker;
    uint8_t *is_whole = NULL;
    TL_TRY(sort_polygons(&c));
    if (checker->contours != NULL) {
        is_whole = TL_PUSH(&checker->arena, uint8_t, checker->contours->contour_count);
        if (is_whole == NULL) {
            return TL_ERR_MEMORY;
        }
        TL_TRY(check_areas(checker, is_whole));
    }
    for (c.first = 0; c.first < checker->mesh->polygon_count; c.first = c.end) {
        uint64_t group = c.order[c.first].key >> GROUP_SHIFT;
        uint32_t contour = checker->mesh->contours[c.order[c.first].value];
        c.end = c.first;
        while (c.end < checker->mesh->polygon_count && c.order[c.end].key >> GROUP_SHIFT == group) {
            c.end++;
        }
        TL_TRY(check_cover_of(&c));
        if (is_whole != NULL && contour != TL_SEVERAL_CONTOURS && is_whole[contour]) {
            tl_arena_mark mark = tl_arena_get_mark(&checker->arena);
            TL_TRY(tl_polygon_check_outline(checker, c.order + c.first, c.end - c.first, contour));
            tl_arena_rollback(&checker->arena, mark);
        }
    }
    return TL_OK;
}
