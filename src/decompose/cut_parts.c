// SPDX-License-Identifier: MIT
//
// Cutting until the tolerance holds, in rounds: all parts that break it are judged, searched and cut side by side.
//
// Source: Lien, Amato, Approximate Convex Decomposition of Polyhedra, 2007: cut the part of too large a concavity, and
// judge its halves again. What a cut leaves in loose pieces becomes as many parts.

#include "base/assert.h"
#include "base/min_max.h"
#include "decompose/cut_search.h"
#include "decompose/decomposer.h"

#include <math.h>
#include <string.h>

enum {
    CUT_ROUNDS = 64, // halves of halves: no float is divided more often
    PROOF_BUDGET = 1 << 14,
    PARTS_PER_KEPT = 4, // with max_parts, so many times as many parts are enough to merge from
    MOST_MADE = 2 * TL_MAX_PART_PIECES,
};

tl_result tl_decomposer_bake_hull(const tl_decomposer *d, const tl_vec3 *points, uint32_t count, tl_hull **hull_out)
{
    tl_hull_def def = tl_default_hull_def();
    def.thickness = d->thickness;
    def.host.allocator = d->allocator;
    return tl_hull_bake(points, count, &def, hull_out, NULL);
}

tl_result tl_decomposer_judge(const tl_decomposer *d, const tl_hull *hull, bool *holds_out, double *concavity_out)
{
    const tl_concavity_goal goal = { d->tolerance, d->tolerance, 0.0, PROOF_BUDGET };
    tl_concavity concavity;
    TL_TRY(tl_concavity_prove(hull, &d->grid, &goal, d->allocator, &concavity));
    *holds_out = concavity.bound <= d->tolerance;
    *concavity_out = *holds_out ? concavity.bound : tl_max_f64(concavity.reached, d->tolerance);
    return TL_OK;
}

tl_result tl_decomposer_add(tl_decomposer *d, const tl_part *part)
{
    if (d->part_count == TL_MAX_DECOMPOSED_PARTS) {
        return tl_report_field(&d->report->base, TL_ERR_LIMIT, "tolerance", "make it larger");
    }
    if (d->part_count == d->part_capacity) {
        tl_part *grown = tl_grow_array(d->allocator, d->parts, &d->part_capacity, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        d->parts = grown;
    }
    d->parts[d->part_count++] = *part;
    return TL_OK;
}

typedef struct part_cut {
    uint32_t part;
    uint32_t direction_count;
    tl_vec3d directions[TL_CUT_DIRECTIONS];
    tl_cut_choice choices[TL_CUT_DIRECTIONS];
    tl_result results[TL_CUT_DIRECTIONS];
    tl_part *made; // [MOST_MADE] that the part is cut into
    uint32_t made_count;
    bool is_cut;
} part_cut;

typedef struct cut_round {
    tl_decomposer *d;
    part_cut *cuts;
    uint32_t cut_count;
    uint32_t first_new; // part: all before are known
    tl_result *results; // of judging, one a new part
} cut_round;

// The hull of a new part, and whether it keeps the tolerance.
static void judge_part(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const cut_round *round = user;
    tl_part *part = &round->d->parts[round->first_new + index];
    tl_result result = tl_decomposer_bake_hull(round->d, part->corners, 3 * part->triangle_count, &part->hull);
    if (result == TL_OK) {
        result = tl_decomposer_judge(round->d, part->hull, &part->is_whole, &part->concavity);
    }
    round->results[index] = result;
}

static void find_directions(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const cut_round *round = user;
    part_cut *cut = &round->cuts[index];
    cut->direction_count = tl_cut_directions(&round->d->parts[cut->part], cut->directions);
}

static void search_direction(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const cut_round *round = user;
    part_cut *cut = &round->cuts[index / TL_CUT_DIRECTIONS];
    const uint32_t direction = index % TL_CUT_DIRECTIONS;
    if (direction < cut->direction_count) {
        cut->results[direction] = tl_cut_search(&round->d->parts[cut->part], cut->directions[direction],
                                                &round->d->grid, round->d->allocator, &cut->choices[direction]);
    }
}

static const tl_cut_choice *best_choice(const part_cut *cut)
{
    const tl_cut_choice *best = &cut->choices[0];
    for (uint32_t i = 1; i < cut->direction_count; i++) {
        best = tl_cut_is_better(&cut->choices[i], best) ? &cut->choices[i] : best;
    }
    return best;
}

// Cuts a part by its best plane. It stays as it is where no plane divides it.
static tl_result cut_by_best(const tl_decomposer *d, part_cut *cut)
{
    const tl_part *part = &d->parts[cut->part];
    const tl_cut_choice *choice = best_choice(cut);
    if (choice->cost == (double)INFINITY) {
        return TL_OK;
    }
    tl_part halves[2];
    TL_TRY(tl_part_cut(part, &choice->plane, d->allocator, halves));
    cut->is_cut = halves[0].triangle_count > 0 && halves[1].triangle_count > 0;
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < 2 && result == TL_OK && cut->is_cut; i++) {
        result = tl_part_divide(&halves[i], d->allocator, cut->made + cut->made_count, &cut->made_count);
    }
    tl_part_free(&halves[0], d->allocator);
    tl_part_free(&halves[1], d->allocator);
    return result;
}

static void cut_part(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const cut_round *round = user;
    part_cut *cut = &round->cuts[index];
    tl_result result = TL_OK;
    for (uint32_t i = 0; i < cut->direction_count && result == TL_OK; i++) {
        result = cut->results[i];
    }
    cut->made = result == TL_OK ? tl_allocate_array(round->d->allocator, MOST_MADE, sizeof *cut->made) : NULL;
    result = result == TL_OK && cut->made == NULL ? TL_ERR_MEMORY : result;
    cut->results[0] = result == TL_OK ? cut_by_best(round->d, cut) : result;
}

// Puts what was made in place of what was cut.
static tl_result take_made(tl_decomposer *d, part_cut *cut)
{
    TL_TRY(cut->results[0]);
    tl_part *part = &d->parts[cut->part];
    part->is_whole = !cut->is_cut;
    for (uint32_t i = 0; i < cut->made_count; i++) {
        TL_TRY(tl_decomposer_add(d, &cut->made[i]));
        memset(&cut->made[i], 0, sizeof cut->made[i]);
    }
    if (cut->is_cut) {
        d->report->cut_count++;
        tl_part_free(&d->parts[cut->part], d->allocator);
    }
    return TL_OK;
}

static void free_cut(const tl_decomposer *d, part_cut *cut)
{
    for (uint32_t i = 0; i < cut->made_count; i++) {
        tl_part_free(&cut->made[i], d->allocator);
    }
    tl_release_array(d->allocator, cut->made, MOST_MADE, sizeof *cut->made);
}

// Drops the holes that cut parts left.
static void pack_parts(tl_decomposer *d)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < d->part_count; i++) {
        if (d->parts[i].corners != NULL) {
            d->parts[kept++] = d->parts[i];
        }
    }
    d->part_count = kept;
}

static tl_result run_cuts(cut_round *round, tl_stage *stage)
{
    tl_decomposer *d = round->d;
    TL_TRY(tl_stage_run(stage, find_directions, round->cut_count, round, 1, 0));
    TL_TRY(tl_stage_run(stage, search_direction, round->cut_count * TL_CUT_DIRECTIONS, round, 1, 0));
    TL_TRY(tl_stage_run(stage, cut_part, round->cut_count, round, 1, 0));
    for (uint32_t i = 0; i < round->cut_count; i++) {
        TL_TRY(take_made(d, &round->cuts[i]));
    }
    return TL_OK;
}

// Cuts every part that is not whole. `*any_out`: there was one.
static tl_result cut_broken_parts(tl_decomposer *d, tl_stage *stage, bool *any_out)
{
    cut_round round = { d, NULL, 0, 0, NULL };
    for (uint32_t i = 0; i < d->part_count; i++) {
        round.cut_count += !d->parts[i].is_whole;
    }
    *any_out = round.cut_count > 0;
    if (!*any_out) {
        return TL_OK;
    }
    const uint32_t room = round.cut_count;
    round.cuts = tl_allocate_array(d->allocator, room, sizeof *round.cuts);
    if (round.cuts == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(round.cuts, 0, room * sizeof *round.cuts);
    round.cut_count = 0;
    for (uint32_t i = 0; i < d->part_count; i++) {
        if (!d->parts[i].is_whole) {
            round.cuts[round.cut_count++].part = i;
        }
    }
    const tl_result result = run_cuts(&round, stage);
    for (uint32_t i = 0; i < room; i++) {
        free_cut(d, &round.cuts[i]);
    }
    tl_release_array(d->allocator, round.cuts, room, sizeof *round.cuts);
    pack_parts(d);
    return result;
}

static tl_result judge_new_parts(tl_decomposer *d, uint32_t first_new, tl_stage *stage)
{
    const uint32_t count = d->part_count - first_new;
    cut_round round = { d, NULL, 0, first_new, tl_allocate_array(d->allocator, count, sizeof *round.results) };
    if (round.results == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_result result = tl_stage_run(stage, judge_part, count, &round, 1, 0);
    for (uint32_t i = 0; i < count && result == TL_OK; i++) {
        result = round.results[i];
    }
    tl_release_array(d->allocator, round.results, count, sizeof *round.results);
    return result;
}

tl_result tl_decomposer_cut(tl_decomposer *d)
{
    tl_stage stage;
    d->report->base.stage = "cuts";
    TL_TRY(tl_stage_begin(&stage, &d->def->host, "cuts", CUT_ROUNDS));
    uint32_t first_new = 0;
    for (uint32_t i = 0;; i++) {
        bool any;
        TL_TRY(judge_new_parts(d, first_new, &stage));
        if (i == CUT_ROUNDS || (d->def->max_parts != 0 && d->part_count / PARTS_PER_KEPT >= d->def->max_parts)) {
            break;
        }
        TL_TRY(cut_broken_parts(d, &stage, &any));
        if (!any) {
            break;
        }
        for (first_new = 0; first_new < d->part_count && d->parts[first_new].hull != NULL; first_new++) {
        }
        TL_TRY(tl_stage_add(&stage, 1));
    }
    d->report->parts_before_merging = d->part_count;
    return tl_stage_end(&stage);
}
