// SPDX-License-Identifier: MIT
//
// A vertex in a straight run costs a chord, for polygons are strictly convex. Where no other vertex lies at its place,
// no neighbour shares it, and the contour encloses the same floor without it. What is lost is its height; a mesh of
// heights is made from the level itself, not from contours.
//
// On a tile's border the neighbour is in another tile, so vertices there stay (those that may go are flagged).

#include "polygon/outline/straight_vertices.h"

#include "polygon/outline/outline.h"

static uint64_t place_key(const tl_contour_vertex *v)
{
    return tl_pair_key((uint32_t)v->x, (uint32_t)v->z);
}

bool tl_place_counts_init(tl_place_counts *counts, tl_arena *arena, const tl_contour_set *contours)
{
    uint64_t total = 0;
    for (uint32_t i = 0; i < contours->contour_count; i++) {
        total += contours->contours[i].vertex_count;
    }
    if (!tl_key_table_init(&counts->table, arena, total)) {
        return false;
    }
    for (uint32_t i = 0; i < contours->contour_count; i++) {
        const tl_contour *contour = &contours->contours[i];
        for (uint32_t k = 0; k < contour->vertex_count; k++) {
            uint32_t *count =
                tl_key_table_at(&counts->table, place_key(&contours->vertices[contour->first_vertex + k]));
            *count = *count == TL_NO_VALUE ? 1 : *count + 1;
        }
    }
    return true;
}

static bool is_on_tile_border(const tl_contour_set *set, const tl_contour_vertex *v)
{
    return set->border_size > 0 && (v->x == 0 || v->z == 0 || v->x == set->width || v->z == set->height);
}

static bool runs_straight(const tl_contour_vertex *a, const tl_contour_vertex *b, const tl_contour_vertex *c)
{
    tl_lattice_point before = { a->x, a->z }, corner = { b->x, b->z }, after = { c->x, c->z };
    return tl_turn(before, corner, after) == 0 && tl_dot2(corner, before, after) < 0;
}

uint32_t tl_drop_straight_vertices(tl_place_counts *counts, const tl_contour_set *contours, const tl_contour *contour,
                                   tl_contour_vertex *kept)
{
    const tl_contour_vertex *vertices = tl_contour_begin(contours, contour);
    uint32_t n = contour->vertex_count;
    uint32_t made = 0;
    for (uint32_t k = 0; k < n; k++) {
        const tl_contour_vertex *v = &vertices[k];
        bool goes = (v->flags & TL_CONTOUR_BORDER_VERTEX) == 0 && !is_on_tile_border(contours, v) &&
                    runs_straight(&vertices[k > 0 ? k - 1 : n - 1], v, &vertices[k + 1 < n ? k + 1 : 0]) &&
                    *tl_key_table_at(&counts->table, place_key(v)) == 1;
        if (!goes) {
            kept[made++] = *v;
        }
    }
    return made;
}
