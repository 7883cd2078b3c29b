// SPDX-License-Identifier: MIT

#include "world/job/shard.h"

#include <stdlib.h>
#include <string.h>

// A scheduler's variables. Where `first` is set, indexes begin there, and with `step` go on in its steps.
typedef struct scheduler {
    const char *index, *count, *first, *step;
    bool many_only; // counts only when there are several: every job has these
} scheduler;

static const scheduler schedulers[] = {
    { "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_STEP", false },
    { "OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", NULL, NULL, false },
    { "PMI_RANK", "PMI_SIZE", NULL, NULL, false },
    { "SLURM_PROCID", "SLURM_NTASKS", NULL, NULL, true },
    { "JOB_COMPLETION_INDEX", "JOB_COMPLETIONS", NULL, NULL, false },
    { "AWS_BATCH_JOB_ARRAY_INDEX", "AWS_BATCH_JOB_ARRAY_SIZE", NULL, NULL, false },
};

// Digits only, below 2^31. Returns where they end, or NULL.
static const char *read_shard_number(const char *text, uint32_t *value_out)
{
    uint64_t value = 0;
    const char *at = text;
    while (*at >= '0' && *at <= '9') {
        value = value * 10 + (uint64_t)(*at - '0');
        if (value > INT32_MAX) {
            return NULL;
        }
        at++;
    }
    *value_out = (uint32_t)value;
    return at > text ? at : NULL;
}

static tl_result take_shard_text(const char *text, tl_world_shard *shard, tl_io_error *error_out)
{
    uint32_t number = 0, count = 0;
    const char *at = read_shard_number(text, &number);
    at = at != NULL && *at == '/' ? read_shard_number(at + 1, &count) : NULL;
    if (at == NULL || *at != '\0' || number < 1 || number > count) {
        return tl_io_fail(error_out, TL_ERR_ARGUMENT, NULL, 0, "write I/N, with I from 1 to N, such as 3/64",
                          "--shard: '%s' is no shard", text);
    }
    shard->index = number - 1;
    shard->count = count;
    shard->source = "--shard";
    return TL_OK;
}

// A variable's number. False: it is not there, or it is none, and then `*result` says so.
static bool look_up(const char *name, tl_world_lookup_fn *lookup, void *user, uint32_t *value_out, tl_result *result,
                    tl_io_error *error_out)
{
    const char *text = name != NULL ? lookup(name, user) : NULL;
    if (text == NULL || text[0] == '\0') {
        return false;
    }
    const char *end = read_shard_number(text, value_out);
    if (end == NULL || *end != '\0') {
        *result =
            tl_io_fail(error_out, TL_ERR_ARGUMENT, NULL, 0, "give --shard I/N", "%s: '%.32s' is no number", name, text);
        return false;
    }
    return true;
}

static tl_result take_scheduler(const scheduler *s, uint32_t given, tl_world_lookup_fn *lookup, void *user,
                                tl_world_shard *shard, tl_io_error *error_out)
{
    tl_result result = TL_OK;
    uint32_t index = 0, count = given, first = 0, step = 1;
    if (!look_up(s->index, lookup, user, &index, &result, error_out)) {
        return result != TL_OK ? result : TL_NOT_FOUND;
    }
    const bool has_count = look_up(s->count, lookup, user, &count, &result, error_out) || given > 0;
    look_up(s->first, lookup, user, &first, &result, error_out);
    look_up(s->step, lookup, user, &step, &result, error_out);
    if (result != TL_OK) {
        return result;
    }
    if (has_count && count == 1 && s->many_only) {
        return TL_NOT_FOUND;
    }
    if (!has_count) {
        return tl_io_fail(error_out, TL_ERR_ARGUMENT, NULL, 0, "give --shards N",
                          "%s says %u, and nothing says of how many", s->index, index);
    }
    if (index < first || step == 0 || (index - first) / step >= count) {
        return tl_io_fail(error_out, TL_ERR_ARGUMENT, NULL, 0, "give --shard I/N",
                          "%s is %u, which is not one of %u from %u on", s->index, index, count, first);
    }
    shard->index = (index - first) / step;
    shard->count = count;
    shard->source = s->index;
    return TL_OK;
}

tl_result tl_world_shard_find(const char *text, uint32_t count, tl_world_lookup_fn *lookup, void *user,
                              tl_world_shard *shard_out, tl_io_error *error_out)
{
    const tl_world_shard whole = { 0, 1, NULL };
    *shard_out = whole;
    if (text != NULL) {
        return take_shard_text(text, shard_out, error_out);
    }
    for (size_t i = 0; i < sizeof schedulers / sizeof schedulers[0]; i++) {
        const tl_result result = take_scheduler(&schedulers[i], count, lookup, user, shard_out, error_out);
        if (result != TL_NOT_FOUND) {
            return result;
        }
    }
    if (count > 1) {
        return tl_io_fail(error_out, TL_ERR_ARGUMENT, NULL, 0, "give --shard I/N",
                          "--shards %u: nothing says which of them this is", count);
    }
    return TL_OK;
}

typedef struct tile_by_cost {
    uint64_t tile;
    uint32_t cost;
} tile_by_cost;

static int compare_costs(const void *a, const void *b)
{
    const tile_by_cost *x = a, *y = b;
    if (x->cost != y->cost) {
        return x->cost > y->cost ? -1 : 1;
    }
    return x->tile < y->tile ? -1 : x->tile > y->tile;
}

uint64_t *tl_world_shard_tiles(const tl_world_plan *plan, const tl_world_shard *shard, uint64_t *count_out)
{
    const uint64_t total = plan->tile_count, count = shard->count;
    tile_by_cost *sorted = malloc((size_t)total * sizeof *sorted + 1);
    uint64_t *tiles = malloc((size_t)(total / count + 1) * sizeof *tiles);
    *count_out = 0;
    if (sorted == NULL || tiles == NULL) {
        free(sorted);
        free(tiles);
        return NULL;
    }
    for (uint64_t i = 0; i < total; i++) {
        sorted[i].tile = i;
        sorted[i].cost = plan->tiles[i].cost;
    }
    qsort(sorted, (size_t)total, sizeof *sorted, compare_costs);
    for (uint64_t round = 0; round * count < total; round++) {
        const uint64_t at = round * count + tl_world_shard_turn(round, shard->index, count);
        if (at < total) {
            tiles[(*count_out)++] = sorted[at].tile;
        }
    }
    free(sorted);
    return tiles;
}
