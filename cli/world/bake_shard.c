// SPDX-License-Identifier: MIT

#include "cli/world/bake_shard.h"

#include "cli/shared/json_out.h"
#include "cli/world/ranks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct bake_run {
    tl_cli *cli;
    tl_ranks ranks;
    tl_world_shard shard;
} bake_run;

// ---- The shard ---------------------------------------------------------------------------------------------

static const char *look_up_environment(const char *name, void *user)
{
    static const char *const of_ranks[] = { "OMPI_COMM_WORLD_RANK", "PMI_RANK", "SLURM_PROCID" };
    const bool *has_ranks = user;
    for (int i = 0; i < 3 && *has_ranks; i++) {
        if (strcmp(name, of_ranks[i]) == 0) {
            return NULL;
        }
    }
    return getenv(name);
}

bool tl_find_world_shard(tl_cli *cli, const char *text, uint32_t count, bool has_ranks, tl_world_shard *shard_out,
                         tl_exit *exit_out)
{
    tl_io_error error;
    memset(&error, 0, sizeof error);
    if (tl_world_shard_find(text, count, look_up_environment, &has_ranks, shard_out, &error) != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
        return false;
    }
    return true;
}

json_t *tl_world_shard_json(const tl_world_shard *shard)
{
    return json_pack("{si si so}", "number", (int)shard->index + 1, "of", (int)shard->count, "from",
                     shard->source != NULL ? json_string(shard->source) : json_null());
}

void tl_print_world_shard(const tl_world_shard *shard)
{
    if (shard->source != NULL) {
        printf("shard    %u of %u, says %s\n", shard->index + 1, shard->count, shard->source);
    }
}

// ---- What the ranks of a run tell one another ---------------------------------------------------------------

static uint64_t deal_tiles(uint64_t count, void *user)
{
    const bake_run *run = user;
    return run->ranks.calls->add(TL_RANK_TAKEN, count);
}

static uint64_t tell_done(uint64_t count, void *user)
{
    const bake_run *run = user;
    return run->ranks.calls->add(TL_RANK_DONE, count) + count;
}

// The order of a rank's numbers.
enum { SAYS_CODE, SAYS_THERE, SAYS_BAKED, SAYS_FAILED, SAYS_TRIANGLES, SAYS_BYTES };

static void warn_of_rank_tile(const tl_io_error *error, void *user)
{
    bake_run *run = user;
    char rank[32] = "";
    if (run->ranks.count > 1) {
        snprintf(rank, sizeof rank, "rank %u: ", run->ranks.index);
    }
    tl_cli_warn_io(run->cli, rank, error);
}

// A failure that is no tile's: told by the rank that has it, which takes no more tiles.
static tl_exit fail_run(bake_run *run, const tl_io_error *error)
{
    if (run->ranks.count == 1 || error->result == TL_ERR_CANCELLED) {
        return run->ranks.index == 0 ? tl_cli_fail_io(run->cli, error) : TL_EXIT_CANCELLED;
    }
    warn_of_rank_tile(error, run);
    return tl_exit_of(error->result);
}

static tl_exit bake_part(bake_run *run, const tl_world_bake_request *request, tl_world_bake_report *report)
{
    const tl_world_dealer dealer = { deal_tiles, tell_done, run->ranks.count, run };
    tl_world_bake_def def;
    tl_io_error error;
    memset(&def, 0, sizeof def);
    memset(&error, 0, sizeof error);
    def.job = request->job;
    def.shard = run->shard;
    def.dealer = run->ranks.calls != NULL ? &dealer : NULL;
    def.host = run->cli->host;
    def.as_planned = request->as_planned;
    def.fail = warn_of_rank_tile;
    def.user = run;
    const tl_result result = tl_world_bake(&def, report, &error);
    tl_progress_end(&run->cli->progress);
    if (result != TL_OK && (report->failed == 0 || result == TL_ERR_CANCELLED)) {
        return fail_run(run, &error);
    }
    return result != TL_OK ? tl_exit_of(error.result) : TL_EXIT_OK;
}

// ---- The answer --------------------------------------------------------------------------------------------

static tl_exit print_bake_answer(bake_run *run, const char *job, const uint64_t sums[TL_RANK_NUMBERS],
                                 const uint64_t *all)
{
    const uint64_t tiles = sums[SAYS_THERE] + sums[SAYS_BAKED] + sums[SAYS_FAILED];
    if (!run->cli->json) {
        tl_print_world_shard(&run->shard);
        if (run->ranks.count > 1) {
            printf("ranks    %u\n", run->ranks.count);
        }
        printf("tiles    %llu: %llu were there, %llu baked now, %llu failed\n", (unsigned long long)tiles,
               (unsigned long long)sums[SAYS_THERE], (unsigned long long)sums[SAYS_BAKED],
               (unsigned long long)sums[SAYS_FAILED]);
        return TL_EXIT_OK;
    }
    json_t *baked = json_array();
    for (uint32_t r = 0; r < run->ranks.count; r++) {
        json_array_append_new(baked, json_integer((json_int_t)all[r * TL_RANK_NUMBERS + SAYS_BAKED]));
    }
    return tl_cli_print_json(run->cli, json_pack("{so so so sI sI sI sI sI sI}", "job", tl_json_text(job), "shard",
                                                 tl_world_shard_json(&run->shard), "baked_by_rank", baked, "tiles",
                                                 (json_int_t)tiles, "there", (json_int_t)sums[SAYS_THERE], "baked",
                                                 (json_int_t)sums[SAYS_BAKED], "failed", (json_int_t)sums[SAYS_FAILED],
                                                 "triangles", (json_int_t)sums[SAYS_TRIANGLES], "bytes",
                                                 (json_int_t)sums[SAYS_BYTES]));
}

// Rank 0 answers for all, with the first code that is none of success; the others have nothing more to say.
static tl_exit answer_for_all(bake_run *run, const char *job, const uint64_t mine[TL_RANK_NUMBERS], uint64_t *all)
{
    uint64_t sums[TL_RANK_NUMBERS] = { 0 };
    tl_ranks_gather(&run->ranks, mine, all);
    if (run->ranks.index != 0) {
        return TL_EXIT_OK;
    }
    tl_exit code = TL_EXIT_OK;
    for (uint32_t r = 0; r < run->ranks.count; r++) {
        for (int i = 0; i < TL_RANK_NUMBERS; i++) {
            sums[i] += all[r * TL_RANK_NUMBERS + (uint32_t)i];
        }
        code = code == TL_EXIT_OK ? (tl_exit)all[r * TL_RANK_NUMBERS + SAYS_CODE] : code;
    }
    if (code != TL_EXIT_OK && sums[SAYS_FAILED] == 0) {
        return code; // it is told already
    }
    const tl_exit printed = print_bake_answer(run, job, sums, all);
    if (sums[SAYS_FAILED] > 0 && printed == TL_EXIT_OK) {
        return tl_cli_fail(run->cli, code, "%s: %llu tiles failed; the others are done", job,
                           (unsigned long long)sums[SAYS_FAILED]);
    }
    return code != TL_EXIT_OK ? code : printed;
}

static tl_exit bake_and_answer(bake_run *run, const tl_world_bake_request *request)
{
    uint64_t mine[TL_RANK_NUMBERS] = { 0 };
    uint64_t *all = calloc((size_t)run->ranks.count * TL_RANK_NUMBERS, sizeof *all);
    tl_world_bake_report report;
    tl_exit code = TL_EXIT_MEMORY;
    memset(&report, 0, sizeof report);
    if (all == NULL) { // a rank that cannot gather would let the others wait; ending without goodbye ends them all
        return tl_cli_fail(run->cli, TL_EXIT_MEMORY, "out of memory");
    }
    if (tl_find_world_shard(run->cli, request->shard, request->shards, run->ranks.calls != NULL, &run->shard, &code)) {
        code = bake_part(run, request, &report);
    }
    mine[SAYS_CODE] = (uint64_t)code;
    mine[SAYS_THERE] = report.there;
    mine[SAYS_BAKED] = report.baked;
    mine[SAYS_FAILED] = report.failed;
    mine[SAYS_TRIANGLES] = report.triangles;
    mine[SAYS_BYTES] = report.bytes;
    code = answer_for_all(run, request->job, mine, all);
    free(all);
    tl_ranks_leave(&run->ranks);
    return code;
}

tl_exit tl_run_world_bake(tl_cli *cli, const tl_world_bake_request *request)
{
    bake_run run;
    memset(&run, 0, sizeof run);
    run.cli = cli;
    const char *reason = tl_ranks_join(&run.ranks);
    if (reason != NULL) {
        tl_cli_warn(cli, "bakes as a shard of its own, without MPI: %s", reason);
    }
    if (run.ranks.index != 0) {
        cli->progress.style = TL_PROGRESS_NONE; // rank 0 shows that of all
    }
    return bake_and_answer(&run, request);
}
