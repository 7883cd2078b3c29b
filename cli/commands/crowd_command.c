// SPDX-License-Identifier: MIT
//
// talus crowd: a scenario of agents on a navmesh, as figures and as a film.

#include "cli/crowd/crowd_film.h"
#include "cli/crowd/crowd_play.h"
#include "cli/options/output_check.h"
#include "cli/shared/json_out.h"
#include "io/files/atomic_write.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct crowd_settings {
    tl_bake_settings bake;
    const char *output;
    float every; // seconds between the film's frames
} crowd_settings;

static tl_exit write_film(tl_cli *cli, const char *output, const tl_crowd_play *play)
{
    tl_text text;
    memset(&text, 0, sizeof(text));
    if (tl_has_ending(output, ".svg")) {
        tl_crowd_film_add_svg(&play->film, &play->scenario, play->navmesh, &text);
    } else {
        text.frame = cli->frame;
        tl_crowd_film_add_lines(&play->film, &text);
    }
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    tl_exit code = TL_EXIT_OK;
    if (text.failed) {
        code = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
    } else if (tl_atomic_write(output, text.bytes, text.size, &error) != TL_OK) {
        code = tl_cli_fail_io(cli, &error);
    }
    tl_text_free(&text);
    return code;
}

static tl_exit report_outcome(tl_cli *cli, const tl_crowd_scenario *scenario, const tl_crowd_outcome *o)
{
    const double microseconds = o->agent_steps > 0 ? 1e6 * o->compute_seconds / (double)o->agent_steps : 0.0;
    if (cli->json) {
        char hash[17];
        snprintf(hash, sizeof(hash), "%016" PRIx64, o->hash);
        return tl_cli_print_json(
            cli, json_pack("{sI sI so sI sI sI so so sI so so ss}", "agents", (json_int_t)scenario->agent_count,
                           "vehicles", (json_int_t)scenario->vehicle_count, "seconds", tl_json_float(o->seconds),
                           "arrived", (json_int_t)o->arrived, "unreachable", (json_int_t)o->unreachable, "off_mesh",
                           (json_int_t)o->off_mesh, "half_arrived_after", tl_json_float(o->half), "last_arrived_after",
                           tl_json_float(o->last), "overlaps", (json_int_t)o->pairs, "deepest_overlap",
                           tl_json_float(o->deepest), "microseconds_an_agent_step", tl_json_double(microseconds),
                           "hash", hash));
    }
    printf("agents    %u, vehicles %u\n", scenario->agent_count, scenario->vehicle_count);
    printf("arrived   %u", o->arrived);
    if (o->arrived > 0) {
        printf(", half of them after %.1f s, the last after %.1f s", (double)o->half, (double)o->last);
    }
    printf("\nstopped   %u: no path leads to the goal\n", o->unreachable);
    printf("overlaps  %" PRIu64 " pairs in all frames, the deepest %.0f mm\n", o->pairs, 1000.0 * (double)o->deepest);
    printf("run       %.1f s, hash %016" PRIx64 "\n", (double)o->seconds, o->hash);
    return TL_EXIT_OK;
}

static tl_exit run_scenario(tl_cli *cli, const crowd_settings *settings, tl_input *input, tl_crowd_play *play)
{
    tl_exit code = TL_EXIT_OK;
    if (!tl_crowd_play_run(cli, input, &settings->bake, settings->every, play, &code)) {
        return code;
    }
    if (settings->output != NULL) {
        code = write_film(cli, settings->output, play);
    }
    if (code == TL_EXIT_OK && (settings->output == NULL || strcmp(settings->output, "-") != 0)) {
        code = report_outcome(cli, &play->scenario, &play->outcome);
    }
    return code == TL_EXIT_OK && play->outcome.arrived < play->scenario.agent_count ? TL_EXIT_NEGATIVE : code;
}

static tl_exit run_crowd(tl_cli *cli)
{
    static const char *const film_endings[] = { ".svg", ".jsonl", NULL };
    crowd_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    settings.every = 0.25f;
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &settings.output, "FILE",
          "write a film: .svg moves in any browser, .jsonl has a line a frame; - prints such lines", film_endings, 0, 0,
          0, 0 },
        { "every", 0, TL_OPTION_FLOAT, &settings.every, "S", "seconds between frames", NULL, 0.001f, 1e6f, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    if (!tl_input_parse(cli, groups, TL_INPUT_NAVMESH, &settings.bake, 2, 2, &code)) {
        return code;
    }
    tl_input input;
    if (tl_input_open_level(cli, cli->arguments.words[0], &settings.bake, &input, &code)) {
        tl_crowd_play play;
        if (tl_crowd_play_read(cli, cli->arguments.words[1], &play, &code)) {
            code = run_scenario(cli, &settings, &input, &play);
        }
        tl_crowd_play_free(&play);
    }
    tl_input_close(&input);
    return code;
}

const tl_command tl_crowd_command = {
    "crowd",
    "Navmesh",
    "run a crowd through a scenario, as figures and a film",
    "FILE SCENARIO [-o FILM] [options]",
    "Moves agents along the navmesh to their goals; they avoid one another and never leave it. FILE is a baked\n"
    "file, or a level, which is then baked in memory. The run ends when all have arrived, at the latest after the\n"
    "scenario's seconds; exits with 1 when some have not.\n"
    "\n"
    "SCENARIO is JSON: { \"seconds\": 60, \"step\": 0.05, \"groups\": [...], \"vehicles\": [...], \"obstacles\": [...] "
    "}.\n"
    "A group has \"at\"\n"
    "[x, y, z], \"goals\" [[x, y, z], ...], which each agent visits in order, and may have \"count\", \"name\",\n"
    "\"start\" (seconds), \"repeat\", \"spacing\", \"radius\", \"height\", \"speed\" and \"priority\". With a\n"
    "\"formation\" (loose, line, column, wedge, ring, or [[forward, left], ...]) they follow one of them,\n"
    "neighbours so far \"apart\". A vehicle goes straight\n"
    "from \"from\" to \"to\" and evades nobody; it may have \"start\", \"speed\", \"radius\" and \"height\". An "
    "obstacle\n"
    "stands \"at\" a place, with a \"size\" [x, z] or a \"radius\", \"from\" a second \"until\" another: a door that "
    "is\n"
    "shut, a crate; it may have \"turn\" (degrees) and \"height\". Obstacles need a level, not a baked file.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "echo '{\"groups\": [{\"count\": 9, \"at\": [2, 0, 20], \"goals\": [[20, 5, 20]]}]}' > guests.json\n"
    "talus crowd courtyard.talus guests.json -o guests.svg\n"
    "talus crowd courtyard.talus guests.json --json",
    run_crowd,
};
