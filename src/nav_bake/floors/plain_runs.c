// SPDX-License-Identifier: MIT
//
// Finds runs of floors whose neighbours lie as in a picture.
//
// Floors that step alike follow one another, and so do those beside them. What is left to ask is whether the rows
// before and after hang together along the run: one look at one link each, for links are mutual.

#include "nav_bake/floors/plain_runs.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_bake/floors/links.h"

#include <string.h>

enum { MIN_PLAIN_RUN = 8, FIRST_PLAIN_RUNS = 64 };

static tl_result add_run(tl_plain_runs *runs, tl_plain_run run)
{
    if (runs->count == runs->capacity) {
        const uint32_t wanted = runs->capacity > 0 ? runs->capacity + runs->capacity / 2 : FIRST_PLAIN_RUNS;
        tl_plain_run *grown = tl_allocate_array(runs->allocator, wanted, sizeof *grown);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        if (runs->count > 0) {
            memcpy(grown, runs->runs, runs->count * sizeof *grown);
        }
        tl_release_array(runs->allocator, runs->runs, runs->capacity, sizeof *runs->runs);
        runs->runs = grown;
        runs->capacity = wanted;
    }
    runs->runs[runs->count++] = run;
    return TL_OK;
}

// How many of the floors from `first` on, up to `most`, have the one `stride` after them beside them in direction 2.
static uint32_t linked_on(const tl_nav_compact *compact, uint32_t first, uint32_t most, int32_t stride)
{
    const int16_t *right = compact->step + 4 * (size_t)first + 2;
    uint32_t k = 0;
    while (k < most && right[4 * (size_t)k] == stride) {
        k++;
    }
    return k;
}

// Of `count` floors that step alike, the inner ones.
static tl_result split_alike(tl_plain_runs *runs, const tl_nav_compact *compact, uint32_t first, uint32_t count)
{
    const int16_t *step = compact->step + 4 * (size_t)first;
    const int32_t before = step[3], after = step[1], right = step[2];
    const uint32_t stride = (uint32_t)right;
    // Floor k of these is plain where k - stride and k have their links to the right in the rows before and after.
    for (uint32_t begin = 0; begin + stride < count;) {
        const uint32_t from = first + begin, most = count - stride - begin;
        const uint32_t linked = linked_on(compact, from + (uint32_t)before, most, right);
        const uint32_t both = linked_on(compact, from + (uint32_t)after, linked, right);
        if (both >= MIN_PLAIN_RUN + stride) {
            TL_TRY(add_run(runs, (tl_plain_run){ from + stride, both - stride, before, after, stride }));
        }
        begin += both + 1;
    }
    return TL_OK;
}

tl_result tl_plain_runs_find(const tl_nav_compact *compact, uint32_t begin, uint32_t end, const tl_allocator *allocator,
                             tl_plain_runs *runs_out)
{
    memset(runs_out, 0, sizeof *runs_out);
    runs_out->allocator = allocator;
    tl_result result = TL_OK;
    for (uint32_t i = begin; compact->step != NULL && i < end && result == TL_OK;) {
        const int16_t *step = compact->step + 4 * (size_t)i;
        if (step[2] <= 0 || step[0] != -step[2] || step[1] == 0 || step[3] == 0) {
            i++;
            continue;
        }
        const uint32_t alike = tl_nav_steps_alike(compact, i, end - i);
        if (alike >= MIN_PLAIN_RUN + 2) {
            result = split_alike(runs_out, compact, i, alike);
        }
        i += alike;
    }
    if (result != TL_OK) {
        tl_plain_runs_free(runs_out);
    }
    return result;
}

void tl_plain_runs_free(tl_plain_runs *runs)
{
    tl_release_array(runs->allocator, runs->runs, runs->capacity, sizeof *runs->runs);
    memset(runs, 0, sizeof *runs);
}
