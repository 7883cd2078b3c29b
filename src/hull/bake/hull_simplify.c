// SPDX-License-Identifier: MIT
//
// Leaves corners out that a weld distance or a merge distance makes superfluous, and proves by how much.
//
// Which corners may go is a guess: those within the weld distance of an earlier one, and those inside a nearly flat
// region or on a nearly straight border. How far each that went lies outside of the exact hull of the others is then
// measured, and what lies farther out than allowed comes back for good. So the bound holds whatever was guessed, and a
// chain of small steps cannot add up.
//
// Inner points need no look: the distance from a convex body is convex, so it is largest at a corner.

#include "hull/bake/flat_regions.h"

#include "base/assert.h"
#include "hull/bake/quickhull.h"
#include "math/point_grid.h"

#include <string.h>

// Each pass of leaving out finds what the one before made possible; nearly always two are all.
enum { MAX_PASSES = 8, MAX_RESTORES = 4 };

// Corners that are welded between two calls of progress, at some us each.
enum { CORNERS_PER_CALL = 1 << 12 };

typedef struct hull_simplifier {
    const tl_vec3 *points;
    const tl_hull_def *def;
    tl_arena *arena;
    tl_host host;
    tl_stage *stage;
    uint32_t corner_count;    // of the exact hull
    const uint32_t *corners;  // [corner_count] points
    bool *is_kept, *is_fixed; // [corner_count] fixed: came back, and stays
    uint32_t kept_count;
    tl_vec3 *places; // [corner_count] of the kept corners, then of the others
    uint32_t *order; // [corner_count] which corner each of them is
} hull_simplifier;

static bool is_near_a_kept_one(const hull_simplifier *s, const tl_point_grid *grid, tl_vec3 p, tl_point_cell cell)
{
    for (int around = 0; around < 27; around++) {
        uint32_t other = grid->slots[tl_point_grid_slot(grid, cell, around)];
        for (; other != TL_POINT_GRID_NONE; other = grid->next[other]) {
            if (tl_points_are_within(p, s->points[s->corners[other]], grid->distance)) {
                return true;
            }
        }
    }
    return false;
}

// Keeps a corner unless an earlier kept one is near: kept ones lie apart, so a cell holds few of them.
static tl_result weld_corners(hull_simplifier *s)
{
    const uint32_t size = tl_point_grid_slots(s->corner_count);
    uint32_t *slots = TL_PUSH(s->arena, uint32_t, size), *next = TL_PUSH(s->arena, uint32_t, s->corner_count);
    if (slots == NULL || next == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_point_grid grid = tl_point_grid_make((double)s->def->weld_distance, slots, size, next);
    for (uint32_t i = 0; i < s->corner_count; i++) {
        TL_TRY(i % CORNERS_PER_CALL == 0 ? tl_stage_add(s->stage, 0) : TL_OK);
        const tl_vec3 p = s->points[s->corners[i]];
        const tl_point_cell cell = tl_point_grid_cell(&grid, p);
        if (is_near_a_kept_one(s, &grid, p, cell)) {
            s->is_kept[i] = false;
            s->kept_count--;
        } else {
            tl_point_grid_keep(&grid, cell, i);
        }
    }
    return TL_OK;
}

static void restore_corner(hull_simplifier *s, uint32_t corner)
{
    s->kept_count += !s->is_kept[corner];
    s->is_kept[corner] = s->is_fixed[corner] = true;
}

// Marks corners of the hull of the kept ones, `exact`, as left out. False: none is spare.
static tl_result leave_out_spare(hull_simplifier *s, const tl_hull_polygons *exact, bool *changed)
{
    *changed = false;
    tl_arena_mark mark = tl_arena_get_mark(s->arena);
    bool *spare = TL_PUSH_ZERO(s->arena, bool, exact->vertex_count);
    if (spare == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_hull_find_spare_vertices(exact, s->points, (double)s->def->merge_distance, s->arena, s->stage, spare));
    uint32_t vertex = 0;
    for (uint32_t i = 0; i < s->corner_count; i++) {
        // A subset of a hull's corners are all corners of its own hull.
        if (s->is_kept[i] && spare[vertex++] && !s->is_fixed[i]) {
            s->is_kept[i] = false;
            s->kept_count--;
            *changed = true;
        }
    }
    tl_arena_rollback(s->arena, mark);
    return TL_OK;
}

// The exact hull of the kept corners, with the others filed under faces that they see; its polygons name points.
static tl_result build_kept(hull_simplifier *s, tl_quickhull *hull, tl_hull_polygons *exact)
{
    uint32_t kept = 0, left_out = s->kept_count, copies;
    for (uint32_t i = 0; i < s->corner_count; i++) {
        const uint32_t at = s->is_kept[i] ? kept++ : left_out++;
        s->places[at] = s->points[s->corners[i]];
        s->order[at] = i;
    }
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    TL_TRY(tl_stage_begin(s->stage, &s->host, "merge hull", kept));
    tl_quickhull_init(hull, s->places, kept, s->arena, s->stage);
    hull->passive_count = s->corner_count - kept;
    TL_TRY(tl_quickhull_build(hull, &def, NULL, &copies, exact));
    for (uint32_t v = 0; v < exact->vertex_count; v++) {
        exact->points[v] = s->corners[s->order[exact->points[v]]];
    }
    return TL_OK;
}

// How far the corners that were left out lie outside; those farther out than allowed come back.
static tl_result measure_left_out(hull_simplifier *s, tl_quickhull *hull, double *max_outside, bool *changed)
{
    const double allowed = (double)s->def->weld_distance + (double)s->def->merge_distance;
    uint32_t *beyond = TL_PUSH(s->arena, uint32_t, (uint64_t)hull->passive_count + 1), count;
    if (beyond == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_quickhull_measure_left_out(hull, allowed, beyond, &count, max_outside));
    for (uint32_t i = 0; i < count; i++) {
        restore_corner(s, s->order[beyond[i]]);
    }
    *changed = count > 0;
    return TL_OK;
}

static bool has_no_volume(tl_result result)
{
    return result == TL_ERR_COINCIDENT || result == TL_ERR_COLLINEAR || result == TL_ERR_COPLANAR;
}

// The hull of what is kept, once more for as long as measuring brings corners back; all of them after some times.
static tl_result bring_back(hull_simplifier *s, tl_hull_polygons *exact, double *max_outside)
{
    tl_quickhull hull;
    bool changed = true;
    for (uint32_t restores = 0; changed; restores++) {
        if (restores > MAX_RESTORES) {
            for (uint32_t i = 0; i < s->corner_count; i++) {
                restore_corner(s, i);
            }
        }
        const tl_result result = build_kept(s, &hull, exact);
        if (has_no_volume(result)) {
            restores = MAX_RESTORES;
            continue;
        }
        TL_TRY(result);
        TL_TRY(measure_left_out(s, &hull, max_outside, &changed));
    }
    return TL_OK;
}

tl_result tl_hull_simplify(const tl_vec3 *points, const tl_hull_def *def, tl_arena *arena, tl_hull_polygons *polygons,
                           double *max_outside)
{
    const uint32_t count = polygons->vertex_count;
    tl_stage stage;
    hull_simplifier s = { points,
                          def,
                          arena,
                          { def->host.allocator, NULL, def->host.progress },
                          &stage,
                          count,
                          polygons->points,
                          NULL,
                          NULL,
                          count,
                          NULL,
                          NULL };
    s.is_kept = TL_PUSH(arena, bool, count);
    s.is_fixed = TL_PUSH_ZERO(arena, bool, count);
    s.places = TL_PUSH(arena, tl_vec3, count);
    s.order = TL_PUSH(arena, uint32_t, count);
    if (s.is_kept == NULL || s.is_fixed == NULL || s.places == NULL || s.order == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(s.is_kept, 1, count * sizeof *s.is_kept);
    *max_outside = 0.0;
    TL_TRY(tl_stage_begin(&stage, &s.host, "merge hull", count));
    if (def->weld_distance > 0.0f) {
        TL_TRY(weld_corners(&s));
    }
    if (s.kept_count < count) {
        TL_TRY(bring_back(&s, polygons, max_outside));
    }
    bool changed = def->merge_distance > 0.0f;
    for (uint32_t pass = 0; changed && pass < MAX_PASSES; pass++) {
        TL_TRY(leave_out_spare(&s, polygons, &changed));
        if (changed) {
            TL_TRY(bring_back(&s, polygons, max_outside));
        }
    }
    return tl_stage_end(&stage);
}
