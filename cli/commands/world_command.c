// SPDX-License-Identifier: MIT
//
// talus world: worlds larger than memory, baked in shards.

#include "cli/level/bake_level.h"
#include "cli/options/parse_value.h"
#include "cli/shared/command.h"
#include "cli/shared/json_out.h"
#include "cli/world/bake_shard.h"
#include "cli/world/world_route.h"
#include "world/job/merge_tiles.h"
#include "world/job/plan_world.h"
#include "world/job/rank_replay.h"
#include "world/job/tile_times.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_TILE_SIZE = 128, DEFAULT_MEMORY_MIB = 1024, MAX_MEMORY_MIB = 1 << 20, DEFAULT_PICTURE_SIZE = 900 };

typedef struct world_options {
    const char *output;
    const char *origin;
    const char *shard;
    const char *extents;
    uint32_t shards, ranks, memory_mib, block, size;
    bool as_planned;
    tl_bake_settings bake;
} world_options;

typedef struct world_action {
    const char *name;
    uint32_t words; // with its own name
    bool needs_output;
    tl_exit (*run)(tl_cli *cli, world_options *options);
    const char *const *takes; // names of options, beside the common ones
} world_action;

static void warn_of_tile(const tl_io_error *error, void *user)
{
    tl_cli_warn_io(user, "", error);
}

static json_t *grid_json(uint32_t x, uint32_t z)
{
    return json_pack("[ii]", (int)x, (int)z);
}

static double percent(uint64_t part, uint64_t whole)
{
    return whole > 0 ? 100.0 * (double)part / (double)whole : 100.0;
}

// ---- plan --------------------------------------------------------------------------------------------------

static bool take_plan_def(tl_cli *cli, world_options *options, tl_world_plan_def *def, tl_exit *exit_out)
{
    memset(def, 0, sizeof *def);
    if (!tl_bake_take_bounds(cli, &options->bake, exit_out)) {
        return false;
    }
    def->input = cli->arguments.words[1];
    def->job = options->output;
    def->nav = tl_bake_nav_def(&options->bake);
    def->nav.host = cli->host;
    def->reading.up = (tl_up_axis)options->bake.level.up;
    def->reading.scale = options->bake.level.scale;
    def->memory = (uint64_t)options->memory_mib << 20;
    if (def->nav.tile_size == 0) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--tile-size: worlds are baked in tiles; use 32 or more cells");
        return false;
    }
    if (options->origin != NULL && strcmp(options->origin, "auto") != 0) {
        const char *reason = tl_parse_double_triple(options->origin, def->origin);
        if (reason != NULL) {
            *exit_out =
                tl_cli_fail(cli, TL_EXIT_USAGE, "--origin: '%s' %s; give x,y,z, or auto", options->origin, reason);
            return false;
        }
        def->has_origin = true;
    }
    return true;
}

static tl_exit run_plan(tl_cli *cli, world_options *options)
{
    tl_world_plan_def def;
    tl_world_plan_report report;
    tl_io_error error;
    tl_exit code;
    memset(&error, 0, sizeof error);
    if (!take_plan_def(cli, options, &def, &code)) {
        return code;
    }
    if (tl_world_plan_make(&def, &report, &error) != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    tl_progress_end(&cli->progress);
    if (cli->json) {
        json_t *object = json_pack("{so so sI sI sI sI sI sI sI so so}", "input", tl_json_text(def.input), "job",
                                   tl_json_text(def.job), "inputs", (json_int_t)report.inputs, "inputs_read",
                                   (json_int_t)report.inputs_read, "segments", (json_int_t)report.segments, "triangles",
                                   (json_int_t)report.triangles, "degenerate", (json_int_t)report.degenerate,
                                   "store_bytes", (json_int_t)report.store_bytes, "tiles", (json_int_t)report.tiles,
                                   "grid", grid_json(report.tiles_x, report.tiles_z), "origin",
                                   json_pack("[fff]", report.origin[0], report.origin[1], report.origin[2]));
        return tl_cli_print_json(cli, object);
    }
    printf("inputs   %llu, %llu read now, %llu triangles (%llu without area left out)\n",
           (unsigned long long)report.inputs, (unsigned long long)report.inputs_read,
           (unsigned long long)report.triangles, (unsigned long long)report.degenerate);
    printf("store    %llu segments, %.1f MB, %.1f bytes a triangle\n", (unsigned long long)report.segments,
           (double)report.store_bytes / 1e6, (double)report.store_bytes / (double)report.triangles);
    printf("tiles    %llu with triangles, grid %u x %u\n", (unsigned long long)report.tiles, report.tiles_x,
           report.tiles_z);
    printf("planned  %s\n", def.job);
    return TL_EXIT_OK;
}

// ---- bake, status ------------------------------------------------------------------------------------------

static tl_exit run_world_bake(tl_cli *cli, world_options *options)
{
    const tl_world_bake_request request = { cli->arguments.words[1], options->shard, options->shards,
                                            options->as_planned };
    return tl_run_world_bake(cli, &request);
}

// What the noted times say of a run on so many processes. False: reported.
static bool replay_times(tl_cli *cli, const char *job, uint32_t ranks, tl_world_replay *replay, tl_exit *exit_out)
{
    tl_world_plan plan;
    uint64_t *times = NULL;
    tl_io_error error;
    memset(&error, 0, sizeof error);
    tl_result result = tl_world_plan_of_job(job, &plan, &error);
    if (result == TL_OK) {
        result = tl_world_times_read(job, &plan, &times, &error);
    }
    if (result == TL_OK) {
        result = tl_world_replay_ranks(&plan, times, ranks, replay);
    }
    if (result != TL_OK) {
        *exit_out = error.result != TL_OK ? tl_cli_fail_io(cli, &error)
                                          : tl_cli_fail(cli, TL_EXIT_MEMORY, "%s: out of memory", job);
    }
    free(times);
    tl_world_plan_free(&plan);
    return result == TL_OK;
}

static json_t *replay_json(uint32_t ranks, const tl_world_replay *replay)
{
    return json_pack("{sI so so so so so}", "ranks", (json_int_t)ranks, "idle_dealt", tl_json_double(replay->dealt),
                     "idle_shards", tl_json_double(replay->shards), "idle_dealt_in_grid_order",
                     tl_json_double(replay->dealt_naive), "idle_blocks_of_grid", tl_json_double(replay->shards_naive),
                     "idle_at_least", tl_json_double(replay->least));
}

static void print_times(const tl_world_status *status, const world_options *options, const tl_world_replay *replay)
{
    if (status->timed > 0) {
        printf("time     %.1f s of processor for %llu tiles; the longest, tile %u,%u, %.3f s\n",
               (double)status->nanoseconds / 1e9, (unsigned long long)status->timed, status->longest_x,
               status->longest_z, (double)status->longest / 1e9);
    }
    if (options->ranks > 0) {
        printf("ranks    %u: idle %.1f%% with mpirun, %.1f%% with --shard; in the grid's order %.1f%%, in equal blocks "
               "of it %.1f%%\n",
               options->ranks, 100.0 * replay->dealt, 100.0 * replay->shards, 100.0 * replay->dealt_naive,
               100.0 * replay->shards_naive);
    }
}

static tl_exit run_status(tl_cli *cli, world_options *options)
{
    tl_world_shard shard = { 0, 1, NULL };
    tl_world_status status;
    tl_world_replay replay;
    tl_io_error error;
    tl_exit code;
    memset(&error, 0, sizeof error);
    if (options->shard != NULL && !tl_find_world_shard(cli, options->shard, 0, false, &shard, &code)) {
        return code;
    }
    const char *job = cli->arguments.words[1];
    if (tl_world_look(job, &shard, &status, &error) != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    if (options->ranks > 0 && options->shard != NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--ranks counts on the whole job; leave --shard out");
    }
    if (options->ranks > 0 && status.timed < status.tiles) {
        return tl_cli_fail(cli, TL_EXIT_NEGATIVE,
                           "--ranks: of %llu of %llu tiles it is not known how long they take; bake them first",
                           (unsigned long long)(status.tiles - status.timed), (unsigned long long)status.tiles);
    }
    if (options->ranks > 0 && !replay_times(cli, job, options->ranks, &replay, &code)) {
        return code;
    }
    const bool complete = status.there == status.tiles;
    if (cli->json) {
        json_t *object =
            json_pack("{so so sI sI so sI sI so sI so sb}", "job", tl_json_text(job), "shard",
                      tl_world_shard_json(&shard), "inputs", (json_int_t)status.inputs, "triangles",
                      (json_int_t)status.triangles, "grid", grid_json(status.tiles_x, status.tiles_z), "tiles",
                      (json_int_t)status.tiles, "there", (json_int_t)status.there, "cost_there",
                      tl_json_double(status.cost > 0 ? (double)status.cost_there / (double)status.cost : 1.0), "timed",
                      (json_int_t)status.timed, "seconds", tl_json_double((double)status.nanoseconds / 1e9), "complete",
                      (int)complete);
        if (options->ranks > 0) {
            json_object_set_new(object, "replay", replay_json(options->ranks, &replay));
        }
        if (!complete) {
            json_object_set_new(object, "first_missing", grid_json(status.missing_x, status.missing_z));
        }
        code = tl_cli_print_json(cli, object);
        return code != TL_EXIT_OK || complete ? code : TL_EXIT_NEGATIVE;
    }
    tl_print_world_shard(&shard);
    printf("inputs   %llu, %llu triangles\n", (unsigned long long)status.inputs, (unsigned long long)status.triangles);
    printf("tiles    %llu of %llu are there, about %.1f%% of the work\n", (unsigned long long)status.there,
           (unsigned long long)status.tiles, percent(status.cost_there, status.cost));
    print_times(&status, options, &replay);
    if (!complete) {
        printf("missing  tile %u,%u and %llu more\n", status.missing_x, status.missing_z,
               (unsigned long long)(status.tiles - status.there - 1));
    }
    return complete ? TL_EXIT_OK : TL_EXIT_NEGATIVE;
}

// ---- merge, check ------------------------------------------------------------------------------------------

static tl_exit run_merge(tl_cli *cli, world_options *options)
{
    tl_world_merge_report report;
    tl_io_error error;
    const bool to_stdout = strcmp(options->output, "-") == 0;
    memset(&error, 0, sizeof error);
    if (to_stdout && cli->json) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--json and -o -: both would be written to standard output");
    }
    const tl_world_merge_def def = {
        cli->arguments.words[1], options->output, options->as_planned, cli->host, warn_of_tile, cli
    };
    const tl_result result = tl_world_merge(&def, &report, &error);
    tl_progress_end(&cli->progress);
    if (result == TL_NOT_FOUND) {
        char text[TL_IO_PATH_BYTES + TL_IO_MESSAGE_BYTES + TL_IO_ADVICE_BYTES + 8];
        tl_io_error_format(&error, text, sizeof text);
        return tl_cli_fail(cli, report.damaged > 0 ? TL_EXIT_DATA : TL_EXIT_NEGATIVE, "%s", text);
    }
    if (result != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    if (cli->json) {
        return tl_cli_print_json(cli,
                                 json_pack("{so so sI sI sI so sI}", "job", tl_json_text(def.job), "output",
                                           tl_json_text(def.output), "places", (json_int_t)report.places, "tiles",
                                           (json_int_t)report.tiles, "polygons", (json_int_t)report.polygons, "area",
                                           tl_json_double(report.area), "bytes", (json_int_t)report.bytes));
    }
    if (!to_stdout) {
        printf("navmesh  %llu polygons, %.1f m2, %llu tiles at %llu places\n", (unsigned long long)report.polygons,
               report.area, (unsigned long long)report.tiles, (unsigned long long)report.places);
        printf("wrote    %s\n", def.output);
    }
    return report.tiles > 0 ? TL_EXIT_OK
                            : tl_cli_fail(cli, TL_EXIT_EMPTY,
                                          "%s: nothing is walkable; check --up, and the agent's "
                                          "size against the world's units",
                                          def.job);
}

static tl_exit run_world_check(tl_cli *cli, world_options *options)
{
    tl_world_check_report report;
    tl_io_error error;
    (void)options;
    memset(&error, 0, sizeof error);
    const char *path = cli->arguments.words[1];
    if (tl_world_check(path, &report, &error) != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    if (cli->json) {
        return tl_cli_print_json(cli,
                                 json_pack("{so sb sI sI sI so so}", "file", tl_json_text(path), "ok", 1, "tiles",
                                           (json_int_t)report.tiles, "polygons", (json_int_t)report.polygons, "portals",
                                           (json_int_t)report.links, "grid", grid_json(report.tiles_x, report.tiles_z),
                                           "area", tl_json_double(report.area)));
    }
    printf("%s is whole: %llu tiles of a grid %u x %u, %llu polygons, %.1f m2\n", path,
           (unsigned long long)report.tiles, report.tiles_x, report.tiles_z, (unsigned long long)report.polygons,
           report.area);
    return TL_EXIT_OK;
}

// ---- routes, route -----------------------------------------------------------------------------------------

static tl_exit run_routes(tl_cli *cli, world_options *options)
{
    if ((options->block & (options->block - 1)) != 0) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--block: make it 1, 2, 4, 8 or 16");
    }
    return tl_run_world_routes(cli, cli->arguments.words[1], options->output, options->block);
}

static tl_exit run_route(tl_cli *cli, world_options *options)
{
    const char *const *words = cli->arguments.words;
    const tl_world_route_request request = {
        words[1], { words[2], words[3] }, options->extents, options->output, options->size
    };
    return tl_run_world_route(cli, &request);
}

// ---- The command -------------------------------------------------------------------------------------------

static const char *const plan_takes[] = { "output", "memory", "up", "scale", "origin", "*", NULL };
static const char *const bake_takes[] = { "shard", "shards", "as-planned", NULL };
static const char *const status_takes[] = { "shard", "ranks", NULL };
static const char *const merge_takes[] = { "output", "as-planned", NULL };
static const char *const check_takes[] = { NULL };
static const char *const routes_takes[] = { "output", "block", NULL };
static const char *const route_takes[] = { "extents", "output", "size", NULL };

static const world_action actions[] = {
    { "plan", 2, true, run_plan, plan_takes },           { "bake", 2, false, run_world_bake, bake_takes },
    { "status", 2, false, run_status, status_takes },    { "merge", 2, true, run_merge, merge_takes },
    { "check", 2, false, run_world_check, check_takes }, { "routes", 2, false, run_routes, routes_takes },
    { "route", 4, false, run_route, route_takes },
};

// Every option that was given is one of the action's.
static bool check_given(tl_cli *cli, const world_action *action, const tl_option *nav_options, tl_exit *exit_out)
{
    const tl_option *more = tl_is_listed(action->takes, "*") ? nav_options : NULL;
    const char *other = tl_arguments_find_other(&cli->arguments, action->takes, more);
    if (other != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--%s is no option of 'talus world %s'", other, action->name);
    }
    return other == NULL;
}

// The navmesh's options without those that need the whole level at once.
static void list_nav_options(world_options *options, tl_option table[TL_NAV_OPTIONS])
{
    static const char *const whole[] = {
        "area", "areas", "reachable-from", "drop-inside-solids", "island-min-area", "link", "link-file", NULL
    };
    tl_option all[TL_NAV_OPTIONS];
    uint32_t count = 0;
    tl_nav_options(&options->bake, all);
    for (uint32_t i = 0; i < TL_NAV_OPTIONS && all[i].name != NULL; i++) {
        if (!tl_is_listed(whole, all[i].name)) {
            table[count++] = all[i];
        }
    }
    const tl_option end = TL_OPTION_TABLE_END;
    table[count] = end;
}

static const world_action *find_action(tl_cli *cli, tl_exit *exit_out)
{
    const char *word = cli->arguments.words[0];
    for (size_t i = 0; i < sizeof actions / sizeof actions[0]; i++) {
        if (strcmp(actions[i].name, word) == 0) {
            return &actions[i];
        }
    }
    *exit_out =
        tl_cli_fail(cli, TL_EXIT_USAGE, "'%s' is none of plan, bake, status, merge, check, routes, route", word);
    return NULL;
}

static tl_exit run_world(tl_cli *cli)
{
    static const char *const axes[] = { "y", "z", "y-left", "z-left", NULL };
    world_options options;
    memset(&options, 0, sizeof options);
    options.bake = tl_default_bake_settings();
    options.bake.nav_def.tile_size = DEFAULT_TILE_SIZE;
    options.memory_mib = DEFAULT_MEMORY_MIB;
    options.size = DEFAULT_PICTURE_SIZE;
    const tl_option own[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &options.output, "PATH",
          "plan: the job's folder; merge, routes: the baked file; route: a picture, .png or .svg", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option plan[] = {
        { "memory", 0, TL_OPTION_COUNT, &options.memory_mib, "MIB",
          "memory for triangles that are being sorted; results do not depend on it", NULL, 0, 0, 16, MAX_MEMORY_MIB },
        { "up", 0, TL_OPTION_CHOICE, &options.bake.level.up, NULL, "the axis of files that points up", axes, 0, 0, 0,
          0 },
        { "scale", 0, TL_OPTION_FLOAT, &options.bake.level.scale, "S", "metres per unit of files", NULL, 1e-9f, 1e9f, 0,
          0 },
        { "origin", 0, TL_OPTION_TEXT, &options.origin, "X,Y,Z|auto",
          "metres: the point of the world that becomes 0,0,0 inside; auto: 0, or the middle of a world that lies far "
          "out "
          "(auto)",
          NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option bake[] = {
        { "shard", 0, TL_OPTION_TEXT, &options.shard, "I/N", "bake the I-th of N parts, I from 1 on", NULL, 0, 0, 0,
          0 },
        { "shards", 0, TL_OPTION_COUNT, &options.shards, "N",
          "how many parts there are, where the scheduler says only which this is", NULL, 0, 0, 0, 1u << 24 },
        { "ranks", 0, TL_OPTION_COUNT, &options.ranks, "N",
          "status: how long N processes would wait for one another, by the times that the tiles took", NULL, 0, 0, 1,
          1u << 20 },
        { "as-planned", 0, TL_OPTION_FLAG, &options.as_planned, NULL,
          "bake and merge what was planned, though inputs changed since", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option routes[] = {
        { "block", 0, TL_OPTION_COUNT, &options.block, "N",
          "routes: tiles on a side of a block within which lengths are exact, 1, 2, 4, 8 or 16 (4)", NULL, 0, 0, 1,
          16 },
        { "extents", 0, TL_OPTION_TEXT, &options.extents, "X,Y,Z",
          "route: metres around a point that are looked at for the navmesh (2,4,2)", NULL, 0, 0, 0, 0 },
        { "size", 0, TL_OPTION_COUNT, &options.size, "PIXELS", "route: longer side of the picture's map", NULL, 0, 0,
          200, 8000 },
        TL_OPTION_TABLE_END,
    };
    tl_option nav[TL_NAV_OPTIONS];
    list_nav_options(&options, nav);
    const tl_option_group groups[] = { { "Options:", own },           { "plan, how the world is read:", plan },
                                       { "plan, the navmesh:", nav }, { "bake, status, merge:", bake },
                                       { "routes, route:", routes },  { NULL, NULL } };
    tl_exit code;
    if (!tl_cli_parse(cli, groups, 2, 4, &code)) {
        return code;
    }
    const world_action *action = find_action(cli, &code);
    if (action == NULL || !check_given(cli, action, nav, &code)) {
        return code;
    }
    if (cli->arguments.count != action->words) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "%s",
                           action->words == 2 ? "give the action and one path"
                                              : "give route, a file and two points x,y,z");
    }
    if (action->needs_output && options.output == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "say where to write with -o");
    }
    return action->run(cli, &options);
}

const tl_command tl_world_command = {
    "world",
    "Levels",
    "bake a world larger than memory, in shards that resume",
    "plan INPUT -o JOB [options]\n"
    "bake JOB [--shard I/N]\n"
    "status JOB [--ranks N]\n"
    "merge JOB -o FILE.talus\n"
    "check FILE.talus\n"
    "routes FILE.talus [-o FILE.talus] [--block N]\n"
    "route FILE.talus X,Y,Z X,Y,Z [--extents X,Y,Z]",
    "Bakes the navmesh of a world that is larger than memory, tile by tile, on one machine or many. INPUT is a\n"
    "mesh file, a folder of them, or a manifest (world.json) that places files. plan reads it once into JOB/store\n"
    "and lists the tiles; bake makes those that are not there, merge joins them to one file, check proves it.\n"
    "\n"
    "Every tile is a file named after what it is made from. So a bake that was interrupted goes on, an input\n"
    "that changed bakes anew only what it touches (plan again, then bake), and shards may run at once, or twice.\n"
    "The merged file has the same bytes for any number of shards, threads and interruptions, and those of\n"
    "'talus bake --no-soup --tile-size' where that can run.\n"
    "\n"
    "The shard is taken from --shard, or from the variables of Slurm arrays, Open MPI, MPICH, Slurm steps,\n"
    "Kubernetes indexed jobs and AWS Batch arrays. Under mpirun, where talus was built with MPI, the processes\n"
    "share one list of tiles, and each takes the next when it is free. See docs/world.md for recipes.\n"
    "\n"
    "routes puts lengths between tiles into a merged file, so that route, and games, ask for a route over all\n"
    "of the world with the tiles of its ends in memory alone. The answer: its length, a bound that no path is\n"
    "shorter than, and its points, one a line: length x,y,z tile. No route exits with 1.",
    "talus sample city --triangles 20000 -o city.obj\n"
    "talus world plan city.obj -o job --tile-size 64\n"
    "talus world bake job --shard 1/2\n"
    "talus world status job # exits with 1\n"
    "talus world bake job\n"
    "talus world merge job -o city.talus\n"
    "talus world check city.talus\n"
    "talus world routes city.talus\n"
    "talus world route city.talus 5,0,5 45,0,150",
    run_world,
};
