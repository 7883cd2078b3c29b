// SPDX-License-Identifier: MIT
//
// Contour repair: simplified outlines that collapse, change their winding or cross get traced vertices back.
//
// An edge between two regions is made straight however far it bends, and walls may move by max_error on both of their
// sides; so simplified outlines can cross themselves or one another, and thin floors and thin walls can vanish. Of two
// edges that conflict the one with the larger error gets its farthest traced vertex back, on both of its sides; then
// all regions concerned are checked again. Traced outlines have no conflict, so this ends with them at the latest.
//
// A hole that an edge has left behind on its wrong side is a conflict too. And so is a pillar between two regions of
// which both outlines have become one edge, the same there and back: the polygons on its two sides would be neighbours.
// Conflicts are found exactly, by a sweep along x over the edges of one region. Allowed are edges that share an end,
// and those that run the same way back: the two sides of a drop inside a region. (Recast does not look; it names the
// region in its log when a hole is left without an outline.)

#include "nav_bake/contours/contours.h"

#include "base/assert.h"
#include "base/hash.h"

#include <string.h>

typedef struct simple_edge {
    uint32_t before, begin, end; // raw vertices; the loop's last edge ran from `before` to `begin`
    int32_t low_x, high_x, low_z, high_z;
} simple_edge;

typedef struct repair {
    tl_contour_work *work;
    uint32_t region_count;
    uint8_t *dirty;  // [region_count] to be checked
    uint8_t *mended; // [loop_count]
    simple_edge *edges;
    tl_sort_item *items, *scratch;
    uint32_t *path_vertices; // of one loop
    uint32_t *stack;
} repair;

static int sign_of_turn(int64_t value)
{
    return (value > 0) - (value < 0);
}

static bool is_between(const tl_contour_vertex *p, const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    int64_t along = ((int64_t)p->x - a->x) * ((int64_t)b->x - a->x) + ((int64_t)p->z - a->z) * ((int64_t)b->z - a->z);
    int64_t back = ((int64_t)p->x - b->x) * ((int64_t)a->x - b->x) + ((int64_t)p->z - b->z) * ((int64_t)a->z - b->z);
    return along > 0 && back > 0;
}

// Two edges cross, or one's end lies inside the other. Not: a common end, or the same edge there and back.
static bool edges_conflict(const tl_contour_vertex *a, const tl_contour_vertex *b, const tl_contour_vertex *c,
                           const tl_contour_vertex *d)
{
    int c_side = sign_of_turn(tl_contour_area2(a, b, c)), d_side = sign_of_turn(tl_contour_area2(a, b, d));
    int a_side = sign_of_turn(tl_contour_area2(c, d, a)), b_side = sign_of_turn(tl_contour_area2(c, d, b));
    if (c_side * d_side < 0 && a_side * b_side < 0) {
        return true;
    }
    return (c_side == 0 && is_between(c, a, b)) || (d_side == 0 && is_between(d, a, b)) ||
           (a_side == 0 && is_between(a, c, d)) || (b_side == 0 && is_between(b, c, d));
}

// Whether the direction to p lies strictly within the floor's wedge of the corner before, at, after.
static bool is_in_wedge(const tl_contour_vertex *before, const tl_contour_vertex *at, const tl_contour_vertex *after,
                        const tl_contour_vertex *p)
{
    if (tl_contour_area2(before, at, after) < 0) { // convex
        return tl_contour_area2(before, at, p) < 0 && tl_contour_area2(at, after, p) < 0;
    }
    return tl_contour_area2(before, at, p) < 0 || tl_contour_area2(at, after, p) < 0;
}

// Two outlines pass one place. They cross there when the floor's wedges overlap.
static bool corners_conflict(const tl_contour_vertex *v, const simple_edge *e, const simple_edge *f)
{
    const tl_contour_vertex *a = &v[e->before], *at = &v[e->begin], *b = &v[e->end], *c = &v[f->before],
                            *d = &v[f->end];
    return is_in_wedge(a, at, b, c) || is_in_wedge(a, at, b, d) || is_in_wedge(c, at, d, a) || is_in_wedge(c, at, d, b);
}

// Keeps a vertex, and marks all regions that got it for another check.
static void keep_vertex(repair *r, uint32_t vertex)
{
    tl_contour_work *work = r->work;
    tl_contours_keep(work, vertex);
    r->mended[work->loop_of[vertex]] = 1;
    r->dirty[work->loops[work->loop_of[vertex]].region] = 1;
    for (uint32_t v = vertex; work->twin[v] != TL_NO_TWIN;) {
        v = tl_contour_next(work, work->twin[v]);
        if (v == vertex) {
            break;
        }
        r->dirty[work->loops[work->loop_of[v]].region] = 1;
    }
    for (uint32_t v = vertex; work->twin[tl_contour_previous(work, v)] != TL_NO_TWIN;) {
        v = work->twin[tl_contour_previous(work, v)];
        if (v == vertex) {
            break;
        }
        r->dirty[work->loops[work->loop_of[v]].region] = 1;
    }
}

// Where the traced path runs along the edge itself, it is straight along an axis: the vertex at p, if p is on it.
static bool keep_at(repair *r, const simple_edge *edge, const tl_contour_vertex *p)
{
    const tl_contour_work *work = r->work;
    const tl_contour_vertex *a = &work->vertices[edge->begin], *b = &work->vertices[edge->end];
    if (tl_contour_area2(a, b, p) != 0 || !is_between(p, a, b)) {
        return false;
    }
    for (uint32_t k = tl_contour_next(work, edge->begin); k != edge->end; k = tl_contour_next(work, k)) {
        if (tl_contour_same_xz(&work->vertices[k], p) && !work->keep[k]) {
            keep_vertex(r, k);
            return true;
        }
    }
    return false;
}

static bool mend_pair(repair *r, const simple_edge *e, const simple_edge *f)
{
    const tl_contour_vertex *v = r->work->vertices;
    double e_error, f_error;
    uint32_t e_far = tl_contours_farthest(r->work, e->begin, e->end, &e_error);
    uint32_t f_far = tl_contours_farthest(r->work, f->begin, f->end, &f_error);
    if (e_error > 0 && e_error >= f_error) {
        keep_vertex(r, e_far);
        return true;
    }
    if (f_error > 0) {
        keep_vertex(r, f_far);
        return true;
    }
    bool at_f = keep_at(r, e, &v[f->begin]) || keep_at(r, e, &v[f->end]);
    bool at_e = keep_at(r, f, &v[e->begin]) || keep_at(r, f, &v[e->end]);
    return at_f || at_e;
}

// Of the four edges that meet where two outlines cross in a place, the one that strayed farthest gets a vertex back.
static void mend_corners(repair *r, const simple_edge *e, const simple_edge *f)
{
    const uint32_t ends[4][2] = {
        { e->before, e->begin }, { e->begin, e->end }, { f->before, f->begin }, { f->begin, f->end }
    };
    double largest = 0;
    uint32_t farthest = 0;
    for (int k = 0; k < 4; k++) {
        double error;
        uint32_t vertex = tl_contours_farthest(r->work, ends[k][0], ends[k][1], &error);
        if (error > largest) {
            largest = error;
            farthest = vertex;
        }
    }
    if (largest > 0) {
        keep_vertex(r, farthest);
    }
}

// A loop that lost its area, or its direction, gets a vertex back on each of its edges.
static bool mend_collapse(repair *r, const tl_contour_loop *loop, const tl_contour_path *path)
{
    const tl_contour_work *work = r->work;
    int64_t area2 = 0;
    for (uint32_t k = 0; k < path->count; k++) {
        const tl_contour_vertex *a = &work->vertices[path->vertices[k]];
        const tl_contour_vertex *b = &work->vertices[path->vertices[k + 1 < path->count ? k + 1 : 0]];
        area2 += (int64_t)b->x * a->z - (int64_t)a->x * b->z;
    }
    if (sign_of_turn(area2) == sign_of_turn(loop->area2)) {
        return false;
    }
    bool changed = false;
    for (uint32_t k = 0; k < path->count; k++) {
        double error;
        uint32_t end = path->vertices[k + 1 < path->count ? k + 1 : 0];
        uint32_t farthest = tl_contours_farthest(work, path->vertices[k], end, &error);
        if (error > 0) {
            keep_vertex(r, farthest);
            changed = true;
        }
    }
    return changed;
}

// The simplified edges of a region's loops; 0 when a loop had to be mended first.
static uint32_t collect_edges(repair *r, uint32_t region)
{
    tl_contour_work *work = r->work;
    uint32_t count = 0;
    bool mended = false;
    for (uint32_t k = r->work->region_first[region]; k < r->work->region_first[region + 1]; k++) {
        tl_contour_path path = { r->path_vertices, 0 };
        if (work->loops[r->work->by_region[k]].area2 == 0) {
            continue; // a slit: it will not be part of any contour
        }
        tl_contours_simplified(work, r->work->by_region[k], &path);
        mended |= mend_collapse(r, &work->loops[r->work->by_region[k]], &path);
        for (uint32_t j = 0; j < path.count && path.count > 2; j++) {
            simple_edge e = { path.vertices[j > 0 ? j - 1 : path.count - 1],
                              path.vertices[j],
                              path.vertices[j + 1 < path.count ? j + 1 : 0],
                              0,
                              0,
                              0,
                              0 };
            const tl_contour_vertex *a = &work->vertices[e.begin], *b = &work->vertices[e.end];
            e.low_x = a->x < b->x ? a->x : b->x;
            e.high_x = a->x < b->x ? b->x : a->x;
            e.low_z = a->z < b->z ? a->z : b->z;
            e.high_z = a->z < b->z ? b->z : a->z;
            r->edges[count++] = e;
        }
    }
    return mended ? 0 : count;
}

static void mend_crossings(repair *r, uint32_t count)
{
    const tl_contour_vertex *v = r->work->vertices;
    for (uint32_t k = 0; k < count; k++) {
        r->items[k].key = (uint64_t)((int64_t)r->edges[k].low_x - INT32_MIN);
        r->items[k].value = k;
        r->items[k].extra = 0;
    }
    tl_radix_sort(r->items, r->scratch, count);
    for (uint32_t k = 0; k < count; k++) {
        const simple_edge *e = &r->edges[r->items[k].value];
        for (uint32_t j = k + 1; j < count; j++) {
            const simple_edge *f = &r->edges[r->items[j].value];
            if (f->low_x > e->high_x) {
                break;
            }
            if (f->low_z > e->high_z || f->high_z < e->low_z) {
                continue;
            }
            if (edges_conflict(&v[e->begin], &v[e->end], &v[f->begin], &v[f->end])) {
                mend_pair(r, e, f);
            } else if (tl_contour_same_xz(&v[e->begin], &v[f->begin]) && corners_conflict(v, e, f)) {
                mend_corners(r, e, f);
            }
        }
    }
}

// Signed crossings of the edge from a to b with the ray from p to the left: they sum up to the winding number of p.
static int ray_crossing(const tl_contour_vertex *p, const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    if ((a->z <= p->z) == (b->z <= p->z)) {
        return 0;
    }
    int upward = a->z <= p->z ? 1 : -1;
    int side = sign_of_turn(tl_contour_area2(a, b, p));
    return side * upward < 0 ? upward : 0;
}

// Whether p lies between an edge and the traced path that it stands for.
static bool is_cut_off(const tl_contour_work *work, const simple_edge *e, const tl_contour_vertex *p)
{
    const tl_contour_vertex *v = work->vertices;
    int winding = ray_crossing(p, &v[e->end], &v[e->begin]);
    for (uint32_t k = e->begin; k != e->end;) {
        uint32_t next = tl_contour_next(work, k);
        winding += ray_crossing(p, &v[k], &v[next]);
        k = next;
    }
    return winding != 0;
}

// An edge can move right across a hole and leave it outside, or inside another hole, and cross nothing. A vertex of the
// hole then has another winding number than 1 in the region's other loops; the edges that cut it off are mended.
static void mend_stray_holes(repair *r, uint32_t region, uint32_t count)
{
    const tl_contour_work *work = r->work;
    for (uint32_t k = r->work->region_first[region]; k < r->work->region_first[region + 1]; k++) {
        uint32_t hole = r->work->by_region[k];
        int winding = 0;
        if (work->loops[hole].area2 >= 0) {
            continue;
        }
        uint32_t vertex = work->loops[hole].first;
        while (!work->keep[vertex]) {
            vertex++;
        }
        const tl_contour_vertex *p = &work->vertices[vertex];
        for (uint32_t j = 0; j < count; j++) {
            const simple_edge *e = &r->edges[j];
            bool other = work->loop_of[e->begin] != hole;
            winding += other ? ray_crossing(p, &work->vertices[e->begin], &work->vertices[e->end]) : 0;
        }
        for (uint32_t j = 0; j < count && winding != 1; j++) {
            double error;
            const simple_edge *e = &r->edges[j];
            if (work->loop_of[e->begin] != hole && is_cut_off(work, e, p)) {
                uint32_t farthest = tl_contours_farthest(work, e->begin, e->end, &error);
                if (error > 0) {
                    keep_vertex(r, farthest);
                }
            }
        }
    }
}

// ---- Pillars between regions -------------------------------------------------------------------------------------

// Traced vertices that the simplified outline has, each with the next one, where the edge between them is a wall.
typedef struct wall_list {
    tl_sort_item *items, *scratch; // key: a hash of both ends, the same for both directions; value: begin; extra: end
    uint32_t count;
} wall_list;

static uint64_t wall_key(const tl_contour_vertex *a, const tl_contour_vertex *b)
{
    const uint64_t p = tl_hash_mix((uint64_t)(uint32_t)a->x << 32 | (uint32_t)a->z);
    const uint64_t q = tl_hash_mix((uint64_t)(uint32_t)b->x << 32 | (uint32_t)b->z);
    return p + q; // compared in full below
}

static void add_walls_of_loop(const tl_contour_work *work, const tl_contour_loop *loop, wall_list *walls)
{
    uint32_t first = loop->first;
    while (!work->keep[first]) {
        first++;
    }
    for (uint32_t begin = first;;) {
        uint32_t end = tl_contour_next(work, begin);
        while (!work->keep[end]) {
            end = tl_contour_next(work, end);
        }
        if (work->across[begin] == 0) {
            const tl_sort_item item = { wall_key(&work->vertices[begin], &work->vertices[end]), begin, end };
            walls->items[walls->count++] = item;
        }
        if (end == first) {
            return;
        }
        begin = end;
    }
}

static bool runs_back(const tl_contour_work *work, const tl_sort_item *e, const tl_sort_item *f)
{
    const tl_contour_vertex *v = work->vertices;
    return tl_contour_same_xz(&v[e->value], &v[f->extra]) && tl_contour_same_xz(&v[e->extra], &v[f->value]) &&
           v[e->value].y == v[f->extra].y && v[e->extra].y == v[f->value].y;
}

// Room for the walls of all outlines as they are simplified now, in order of their keys.
static tl_result collect_walls(const tl_contour_work *work, wall_list *walls)
{
    uint32_t kept = 0;
    for (uint32_t v = 0; v < work->vertex_count; v++) {
        kept += work->keep[v];
    }
    walls->items = TL_PUSH(work->arena, tl_sort_item, kept);
    walls->scratch = TL_PUSH(work->arena, tl_sort_item, kept);
    walls->count = 0;
    if (walls->items == NULL || walls->scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t l = 0; l < work->loop_count; l++) {
        if (work->loops[l].area2 != 0) {
            add_walls_of_loop(work, &work->loops[l], walls);
        }
    }
    tl_radix_sort(walls->items, walls->scratch, walls->count);
    return TL_OK;
}

// Whether a pillar got a vertex back, so that its regions are to be checked again.
static bool mend_pillars(repair *r, const wall_list *walls)
{
    const tl_contour_work *work = r->work;
    bool mended = false;
    for (uint32_t i = 0; i < walls->count; i++) {
        const tl_sort_item *e = &walls->items[i];
        for (uint32_t k = i + 1; k < walls->count && walls->items[k].key == e->key; k++) {
            const tl_sort_item *f = &walls->items[k];
            double e_error, f_error;
            if (!runs_back(work, e, f)) {
                continue;
            }
            const uint32_t e_far = tl_contours_farthest(work, e->value, e->extra, &e_error);
            const uint32_t f_far = tl_contours_farthest(work, f->value, f->extra, &f_error);
            if (e_error > 0 || f_error > 0) { // else a drop, whose two sides are traced alike
                keep_vertex(r, e_error >= f_error ? e_far : f_far);
                mended = true;
            }
        }
    }
    return mended;
}

static tl_result prepare_repair(repair *r)
{
    tl_contour_work *work = r->work;
    uint32_t count = 0; // of the region with the most traced vertices
    for (uint32_t region = 1; region < r->region_count; region++) {
        uint32_t sum = 0;
        for (uint32_t k = r->work->region_first[region]; k < r->work->region_first[region + 1]; k++) {
            sum += work->loops[r->work->by_region[k]].count;
        }
        count = sum > count ? sum : count;
    }
    r->dirty = TL_PUSH(work->arena, uint8_t, r->region_count);
    r->mended = TL_PUSH_ZERO(work->arena, uint8_t, work->loop_count);
    r->path_vertices = TL_PUSH(work->arena, uint32_t, count);
    r->stack = TL_PUSH(work->arena, uint32_t, count);
    r->edges = TL_PUSH(work->arena, simple_edge, count);
    r->items = TL_PUSH(work->arena, tl_sort_item, count);
    r->scratch = TL_PUSH(work->arena, tl_sort_item, count);
    return r->dirty && r->mended && r->path_vertices && r->stack && r->edges && r->items && r->scratch ? TL_OK
                                                                                                       : TL_ERR_MEMORY;
}

static void repair_regions(repair *r)
{
    for (bool changed = true; changed;) { // each round but the last keeps at least one vertex more
        changed = false;
        for (uint32_t region = 1; region < r->region_count; region++) {
            if (!r->dirty[region]) {
                continue;
            }
            r->dirty[region] = 0;
            for (uint32_t k = r->work->region_first[region]; k < r->work->region_first[region + 1]; k++) {
                tl_contours_refine(r->work, r->work->by_region[k], r->stack);
            }
            uint32_t count = collect_edges(r, region);
            mend_crossings(r, count);
            if (!r->dirty[region]) {
                mend_stray_holes(r, region, count);
            }
            changed = true;
        }
    }
}

tl_result tl_contours_repair(tl_contour_work *work)
{
    repair r = { .work = work, .region_count = work->compact->region_count };
    tl_arena_mark mark = tl_arena_get_mark(work->arena);
    TL_TRY(prepare_repair(&r));
    memset(r.dirty, 1, r.region_count);
    for (bool mended = true; mended;) {
        const tl_arena_mark before = tl_arena_get_mark(work->arena);
        wall_list walls;
        repair_regions(&r);
        TL_TRY(collect_walls(work, &walls));
        mended = mend_pillars(&r, &walls);
        tl_arena_rollback(work->arena, before);
    }
    for (uint32_t l = 0; l < work->loop_count; l++) {
        work->repaired_count += r.mended[l];
    }
    tl_arena_rollback(work->arena, mark);
    return TL_OK;
}
