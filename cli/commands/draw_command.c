// SPDX-License-Identifier: MIT
//
// talus draw: pictures of every stage, of a level or of a baked file.

#include "cli/draw/draw_picture.h"
#include "cli/draw/draw_route.h"
#include "cli/draw/draw_sheet.h"
#include "cli/draw/draw_source.h"
#include "cli/draw/draw_stage.h"
#include "cli/draw/draw_steps.h"
#include "cli/draw/draw_world.h"
#include "cli/options/output_check.h"
#include "cli/options/parse_value.h"
#include "cli/shared/json_out.h"
#include "cli/world/ground_picture.h"

#include <stdio.h>
#include <string.h>

// The order is that of the pipeline.
static const char *const STAGE_NAMES[] = { "soup",     "spans",         "areas",   "distance",  "regions",
                                           "contours", "triangulation", "merging", "triangles", "polygons",
                                           "detail",   "navmesh",       "path",    "crowd" };
enum {
    STAGE_SOUP,
    STAGE_SPANS,
    STAGE_AREAS,
    STAGE_DISTANCE,
    STAGE_REGIONS,
    STAGE_CONTOURS,
    STAGE_TRIANGULATION,
    STAGE_MERGING,
    STAGE_TRIANGLES,
    STAGE_POLYGONS,
    STAGE_DETAIL,
    STAGE_NAVMESH,
    STAGE_PATH,
    STAGE_CROWD,
    STAGE_COUNT
};

enum { MAX_PATH_BYTES = 4096, OVERVIEW_COLUMNS = 4 };

typedef struct draw_settings {
    tl_bake_settings bake;
    const char *output;
    const char *stages_text;
    const char *from_text, *to_text;
    const char *scenario; // of the crowd stage
    int view;             // 0 both, 1 top, 2 oblique
    uint32_t size;
    uint32_t depth;
    uint32_t contour; // UINT32_MAX: one worth a look
    uint32_t set;
    bool all;      // what of it FILE can show
    bool overview; // all in one picture
    bool stages[STAGE_COUNT];
    uint32_t stage_count;
    bool has_ends;
    draw_route_ends ends;
} draw_settings;

// One word of --stage. False when it names no stage.
static bool choose_stage(draw_settings *settings, const char *word, size_t length)
{
    bool all = length == 3 && strncmp(word, "all", 3) == 0;
    bool known = all;
    settings->all = settings->all || all;
    for (int i = 0; i < STAGE_COUNT; i++) {
        bool named = strlen(STAGE_NAMES[i]) == length && strncmp(STAGE_NAMES[i], word, length) == 0;
        if ((all || named) && !settings->stages[i]) {
            settings->stages[i] = true;
            settings->stage_count++;
        }
        known = known || named;
    }
    return known;
}

static bool choose_stages(tl_cli *cli, draw_settings *settings, tl_exit *exit_out)
{
    const char *text = settings->stages_text;
    if (text == NULL) {
        text = settings->overview           ? "all"
               : settings->scenario != NULL ? "crowd"
               : settings->has_ends         ? "path"
                                            : "polygons";
    }
    for (const char *word = text; *word != '\0';) {
        size_t length = strcspn(word, ",");
        if (!choose_stage(settings, word, length)) {
            *exit_out = tl_cli_fail(
                cli, TL_EXIT_USAGE,
                "--stage: there is no stage '%.*s'; there are soup, spans, areas, distance, regions, "
                "contours, triangulation, merging, triangles, polygons, detail, navmesh, path, crowd, and all",
                (int)length, word);
            return false;
        }
        word += length + (word[length] == ',');
    }
    if (settings->stage_count == 0) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--stage: name a stage, or all");
    }
    return settings->stage_count > 0;
}

static bool read_end(tl_cli *cli, const char *option, const char *text, tl_vec3 *point, tl_exit *exit_out)
{
    const char *reason = tl_parse_point_value(text, point);
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "%s: '%s' %s; give x,y,z", option, text, reason);
    }
    return reason == NULL;
}

static bool read_ends(tl_cli *cli, draw_settings *settings, tl_exit *exit_out)
{
    if (settings->from_text == NULL && settings->to_text == NULL) {
        return true;
    }
    if (settings->from_text == NULL || settings->to_text == NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "a path needs both --from and --to");
        return false;
    }
    settings->has_ends = true;
    return read_end(cli, "--from", settings->from_text, &settings->ends.from, exit_out) &&
           read_end(cli, "--to", settings->to_text, &settings->ends.to, exit_out);
}

// One stage goes to the output itself; of several, each to a file with the stage's name before the ending.
static bool output_path(const draw_settings *settings, int stage, char *path, size_t size)
{
    const char *output = settings->output;
    int length;
    if (settings->stage_count == 1) {
        length = snprintf(path, size, "%s", output);
    } else {
        const char *slash = strrchr(output, '/');
        const char *dot = strrchr(output, '.');
        const char *end = dot != NULL && (slash == NULL || dot > slash) ? dot : output + strlen(output);
        length = snprintf(path, size, "%.*s-%s%s", (int)(end - output), output, STAGE_NAMES[stage], end);
    }
    return length > 0 && (size_t)length < size;
}

// What can be drawn of a level or its soup; of contours alone; of a navmesh alone. A crowd needs a scenario.
static bool is_drawable(const draw_source *source, const draw_settings *settings, int stage)
{
    return stage == STAGE_CROWD && settings->scenario == NULL ? false
           : source->is_contours                              ? stage >= STAGE_CONTOURS && stage <= STAGE_POLYGONS
           : source->is_bare                                  ? stage == STAGE_POLYGONS || stage >= STAGE_NAVMESH
                                                              : true;
}

static bool add_navmesh(draw_source *source, draw_scene *scene, tl_exit *exit_out)
{
    bool ready = draw_need_navmesh(source, exit_out);
    if (ready) {
        draw_stage_navmesh(scene, source->input.navmesh);
    }
    return ready;
}

// A scenario is run, and drawn with the navmesh that it ran on.
static bool add_crowd(draw_source *source, const draw_settings *settings, draw_scene *scene, tl_exit *exit_out)
{
    enum { FRAMES_A_SECOND = 8 };
    tl_crowd_play play;
    const bool done =
        tl_crowd_play_read(source->cli, settings->scenario, &play, exit_out) &&
        (play.scenario.obstacle_count > 0 || draw_need_walkable(source, exit_out)) &&
        tl_crowd_play_run(source->cli, &source->input, &settings->bake, 1.0f / (float)FRAMES_A_SECOND, &play, exit_out);
    if (done) {
        draw_stage_crowd(scene, &play);
    }
    tl_crowd_play_free(&play);
    return done;
}

static bool add_polygons(draw_source *source, uint32_t max_verts_per_poly, const char *what, draw_scene *scene,
                         tl_exit *exit_out)
{
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = max_verts_per_poly;
    def.method = source->nav_def.polygon_method;
    def.host = source->cli->host;
    tl_polygon_mesh polygons;
    tl_result result = tl_polygon_mesh_bake(source->contours, &def, &polygons, NULL);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(source->cli, source->input.path, result, NULL);
        return false;
    }
    draw_stage_polygons(scene, &polygons, what);
    tl_polygon_mesh_free(&polygons);
    return true;
}

static bool add_contour_stage(draw_source *source, int stage, draw_scene *scene, tl_exit *exit_out)
{
    if (!draw_need_contours(source, exit_out)) {
        return false;
    }
    if (stage == STAGE_TRIANGLES) {
        return add_polygons(source, 3, "triangles", scene, exit_out);
    }
    if (stage == STAGE_POLYGONS) {
        return add_polygons(source, source->nav_def.max_verts_per_poly, "polygons", scene, exit_out);
    }
    if (source->is_contours) {
        draw_stage_contour_set(scene, source->contours);
    } else {
        draw_stage_contours(scene, &source->stages.contours);
    }
    return true;
}

static bool add_pipeline_stage(draw_source *source, int stage, draw_scene *scene, tl_exit *exit_out)
{
    if (!draw_need_stages(source, exit_out)) {
        return false;
    }
    const tl_nav_stages *stages = &source->stages;
    switch (stage) {
    case STAGE_SPANS:
        draw_stage_spans(scene, &stages->heightfield);
        break;
    case STAGE_AREAS:
        draw_stage_floors(scene, &stages->compact, DRAW_FLOOR_AREA);
        break;
    case STAGE_DISTANCE:
        draw_stage_floors(scene, &stages->compact, DRAW_FLOOR_DISTANCE);
        break;
    case STAGE_REGIONS:
        draw_stage_floors(scene, &stages->compact, DRAW_FLOOR_REGION);
        break;
    case STAGE_POLYGONS:
        draw_stage_polygons(scene, &stages->polygons, "polygons");
        break;
    default:
        draw_stage_detail(scene, &stages->detail);
        break;
    }
    return true;
}

static bool make_stage_scene(draw_source *source, const draw_settings *settings, int stage, draw_scene *scene,
                             tl_exit *exit_out)
{
    draw_scene_init(scene, source->bounds);
    snprintf(scene->title, sizeof scene->title, "%s: %s", draw_file_name(source->input.path), STAGE_NAMES[stage]);
    // Coarse polygons dip under the ground between their corners. What is less than an agent's height above them is
    // their own floor, not one overhead.
    scene->overlay_bias = 0.95f * source->nav_def.agent_height;
    // The soup and the spans are the level themselves; everything else lies on it.
    if (stage != STAGE_SOUP && stage != STAGE_SPANS) {
        draw_add_backdrop(scene, &source->mesh);
    }
    if (stage == STAGE_SOUP) {
        bool ready = draw_need_soup(source, exit_out);
        if (ready) {
            draw_stage_soup(scene, source->soup, settings->depth);
        }
        return ready;
    }
    if (stage == STAGE_PATH) {
        return draw_route_add(source, settings->has_ends ? &settings->ends : NULL, scene, exit_out);
    }
    if (stage == STAGE_CROWD) {
        return add_crowd(source, settings, scene, exit_out);
    }
    if (source->is_bare || stage == STAGE_NAVMESH) {
        return add_navmesh(source, scene, exit_out);
    }
    return stage == STAGE_CONTOURS || stage == STAGE_TRIANGLES || source->is_contours
               ? add_contour_stage(source, stage, scene, exit_out)
               : add_pipeline_stage(source, stage, scene, exit_out);
}

static bool draw_scene_of_stage(draw_source *source, const draw_settings *settings, int stage, const char *path,
                                char summary[DRAW_STEPS_SUMMARY], tl_exit *exit_out)
{
    draw_scene scene;
    bool done = make_stage_scene(source, settings, stage, &scene, exit_out);
    if (done) {
        const draw_options options = { settings->view != 2, settings->view != 1, settings->size };
        tl_io_error error;
        memset(&error, 0, sizeof error);
        if (draw_sheet_write(&scene, &options, path, &source->cli->host, &error) != TL_OK) {
            *exit_out = tl_cli_fail_io(source->cli, &error);
            done = false;
        }
        snprintf(summary, DRAW_STEPS_SUMMARY, "%s", scene.subtitle);
    }
    draw_scene_free(&scene);
    return done;
}

// The steps of one contour: many small panels.
static bool draw_steps_of_stage(draw_source *source, const draw_settings *settings, int stage, const char *path,
                                char summary[DRAW_STEPS_SUMMARY], tl_exit *exit_out)
{
    if (!draw_need_contours(source, exit_out)) {
        return false;
    }
    const tl_contour_set *set = source->contours;
    uint32_t contour = settings->contour != UINT32_MAX ? settings->contour : draw_steps_telling_contour(set);
    if (contour >= set->contour_count) {
        *exit_out =
            settings->contour != UINT32_MAX
                ? tl_cli_fail(source->cli, TL_EXIT_USAGE, "--contour: there are %u contours, numbered from 0",
                              set->contour_count)
                : tl_cli_fail(source->cli, TL_EXIT_DATA, "%s: there is no contour to divide", source->input.path);
        return false;
    }
    const draw_steps_options options = { stage == STAGE_MERGING ? TL_POLYGON_STEP_MERGE : TL_POLYGON_STEP_CUT, contour,
                                         source->nav_def.max_verts_per_poly, settings->size / 3,
                                         draw_file_name(source->input.path) };
    tl_io_error error;
    memset(&error, 0, sizeof error);
    tl_result result = draw_steps_write(set, &options, path, &source->cli->host, summary, &error);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_io(source->cli, &error);
    }
    return result == TL_OK;
}

static bool draw_one(draw_source *source, const draw_settings *settings, int stage, json_t *list, tl_exit *exit_out)
{
    char path[MAX_PATH_BYTES];
    if (!output_path(settings, stage, path, sizeof path)) {
        *exit_out = tl_cli_fail(source->cli, TL_EXIT_USAGE, "--output: the name is too long");
        return false;
    }
    char summary[DRAW_STEPS_SUMMARY];
    bool steps = stage == STAGE_TRIANGULATION || stage == STAGE_MERGING;
    if (!(steps ? draw_steps_of_stage : draw_scene_of_stage)(source, settings, stage, path, summary, exit_out)) {
        return false;
    }
    if (list != NULL) {
        json_array_append_new(list,
                              json_pack("{ssssss}", "stage", STAGE_NAMES[stage], "output", path, "summary", summary));
    } else if (strcmp(path, "-") != 0) { // else the picture itself went there
        tl_progress_end(&source->cli->progress);
        printf("%s: %s\n", path, summary);
    }
    return true;
}

static bool add_to_overview(draw_source *source, const draw_settings *settings, int stage, draw_overview *overview,
                            tl_exit *exit_out)
{
    draw_scene scene;
    bool done = make_stage_scene(source, settings, stage, &scene, exit_out);
    if (done) {
        const draw_options options = { settings->view != 2, settings->view == 2, settings->size / 2 };
        tl_io_error error;
        memset(&error, 0, sizeof error);
        done = draw_overview_add(overview, &scene, &options, settings->output, &source->cli->host, &error) == TL_OK;
        if (!done) {
            *exit_out = tl_cli_fail_io(source->cli, &error);
        }
    }
    draw_scene_free(&scene);
    return done;
}

// The stages that are a scene each, in one picture; the steps of a contour are sheets of their own.
static bool draw_all_in_one(draw_source *source, const draw_settings *settings, json_t *list, tl_exit *exit_out)
{
    draw_overview overview;
    memset(&overview, 0, sizeof overview);
    bool going = true;
    for (int stage = 0; going && stage < STAGE_COUNT; stage++) {
        const bool steps = stage == STAGE_TRIANGULATION || stage == STAGE_MERGING;
        if (settings->stages[stage] && !steps && is_drawable(source, settings, stage)) {
            going = add_to_overview(source, settings, stage, &overview, exit_out);
        }
    }
    tl_io_error error;
    memset(&error, 0, sizeof error);
    if (going && overview.count == 0) {
        *exit_out = tl_cli_fail(source->cli, TL_EXIT_USAGE, "--overview: none of these stages can be drawn in it");
        going = false;
    } else if (going && draw_overview_write(&overview, OVERVIEW_COLUMNS, settings->output, &error) != TL_OK) {
        *exit_out = tl_cli_fail_io(source->cli, &error);
        going = false;
    }
    if (going && list != NULL) {
        json_array_append_new(list, json_pack("{sssssi}", "stage", "overview", "output", settings->output, "stages",
                                              (int)overview.count));
    } else if (going && strcmp(settings->output, "-") != 0) {
        tl_progress_end(&source->cli->progress);
        printf("%s: %u stages\n", settings->output, overview.count);
    }
    draw_overview_free(&overview);
    return going;
}

static tl_exit draw_stages(tl_cli *cli, const char *path, const draw_settings *settings)
{
    draw_source source;
    tl_exit code = TL_EXIT_OK;
    json_t *list = cli->json ? json_array() : NULL;
    bool going = draw_source_open(cli, path, &settings->bake, settings->set, &source, &code);
    if (going && settings->overview) {
        going = draw_all_in_one(&source, settings, list, &code);
    }
    for (int stage = 0; going && !settings->overview && stage < STAGE_COUNT; stage++) {
        bool can = is_drawable(&source, settings, stage);
        if (settings->stages[stage] && !can && !settings->all) {
            code = tl_cli_fail(cli, TL_EXIT_USAGE, "%s holds %s show%s", path,
                               source.is_bare ? "a navmesh and no triangles: --stage polygons, navmesh, path and crowd"
                                              : "contours: --stage contours, triangulation, merging, triangles and "
                                                "polygons",
                               source.is_bare ? " it" : " them");
            going = false;
        } else if (settings->stages[stage] && can) {
            going = draw_one(&source, settings, stage, list, &code);
        }
    }
    if (list != NULL && going) {
        const tl_exit printed =
            tl_cli_print_json(cli, json_pack("{so so}", "file", tl_json_text(path), "pictures", list));
        code = printed == TL_EXIT_OK ? code : printed;
    } else {
        json_decref(list);
    }
    draw_source_close(&source);
    return code;
}

// Maps of a job's tiles, which take no other options.
static tl_exit draw_job(tl_cli *cli, const draw_settings *settings)
{
    static const char *const taken[] = { "output", "stage", "size", NULL };
    const char *job = cli->arguments.words[0];
    const char *other = tl_arguments_find_other(&cli->arguments, taken, NULL);
    if (other != NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE,
                           "--%s says nothing of %s, a world's job: its maps take --stage and --size", other, job);
    }
    if (settings->output == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "say where to write with -o FILE.png");
    }
    const draw_world_options options = { settings->output, settings->stages_text, settings->size };
    return draw_world(cli, job, &options);
}

// A large world tile by tile, unless what is asked for needs all of it in memory. False: nothing was drawn.
static bool draw_large_world(tl_cli *cli, const draw_settings *settings, tl_exit *exit_out)
{
    const int stage = settings->stages[STAGE_NAVMESH] ? STAGE_NAVMESH : STAGE_POLYGONS;
    const bool fits = settings->stage_count == 1 && settings->stages[stage] && settings->view != 2 &&
                      !settings->overview && !settings->has_ends;
    return fits && tl_draw_large_ground(cli, cli->arguments.words[0], STAGE_NAMES[stage], settings->output,
                                        settings->size, exit_out);
}

static tl_exit run_draw(tl_cli *cli)
{
    draw_settings settings;
    memset(&settings, 0, sizeof settings);
    settings.bake = tl_default_bake_settings();
    settings.size = 900;
    settings.depth = 2;
    settings.contour = UINT32_MAX;
    static const char *const views[] = { "both", "top", "oblique", NULL };
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &settings.output, "FILE", "where to write: .png or .svg; required",
          tl_picture_endings, 0, 0, 0, 0 },
        { "stage", 's', TL_OPTION_TEXT, &settings.stages_text, "NAME,...",
          "what to draw: stages, separated by commas (polygons)", NULL, 0, 0, 0, 0 },
        { "overview", 0, TL_OPTION_FLAG, &settings.overview, NULL,
          "the stages side by side in one picture, half as large, from above unless --view says otherwise", NULL, 0, 0,
          0, 0 },
        { "view", 0, TL_OPTION_CHOICE, &settings.view, NULL, "from above, obliquely, or both side by side", views, 0, 0,
          0, 0 },
        { "size", 0, TL_OPTION_COUNT, &settings.size, "PIXELS", "longer side of each view", NULL, 0, 0, 200, 8000 },
        { "depth", 0, TL_OPTION_COUNT, &settings.depth, "N", "soup: show the boxes of the BVH down to this depth", NULL,
          0, 0, 0, 64 },
        { "contour", 0, TL_OPTION_NEEDED_COUNT, &settings.contour, "N",
          "triangulation, merging: which contour (one that shows much)", NULL, 0, 0, 0, UINT32_MAX - 1 },
        { "set", 0, TL_OPTION_COUNT, &settings.set, "N", "a contour file: which of its sets", NULL, 0, 0, 0,
          UINT32_MAX - 1 },
        { "from", 0, TL_OPTION_TEXT, &settings.from_text, "X,Y,Z", "path: where it starts", NULL, 0, 0, 0, 0 },
        { "to", 0, TL_OPTION_TEXT, &settings.to_text, "X,Y,Z",
          "path: where it ends (without --from and --to: across the level)", NULL, 0, 0, 0, 0 },
        { "scenario", 0, TL_OPTION_INPUT, &settings.scenario, "FILE",
          "crowd: who walks where, as 'talus crowd' takes it; their traces are drawn", NULL, 0, 0, 0, 0 },
        { "radius", 0, TL_OPTION_FLOAT, &settings.ends.radius, "M",
          "metres, path: the radius of an agent wider than the navmesh's own (0: its own)", NULL, 0, 1e6f, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    tl_exit code = TL_EXIT_OK;
    if (!tl_input_parse(cli, groups, TL_INPUT_NAVMESH, &settings.bake, 1, 1, &code)) {
        return code;
    }
    if (draw_is_world_job(cli->arguments.words[0])) {
        return draw_job(cli, &settings);
    }
    if (!read_ends(cli, &settings, &code) || !choose_stages(cli, &settings, &code)) {
        return code;
    }
    if (settings.output == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "say where to write with -o FILE.png");
    }
    if (settings.stages[STAGE_CROWD] != (settings.scenario != NULL) && !settings.all) {
        return tl_cli_fail(cli, TL_EXIT_USAGE,
                           settings.scenario == NULL
                               ? "--stage crowd: say who walks with --scenario FILE.json ('talus crowd --help' shows "
                                 "what it holds)"
                               : "--scenario says nothing of these stages: add crowd to --stage");
    }
    return draw_large_world(cli, &settings, &code) ? code : draw_stages(cli, cli->arguments.words[0], &settings);
}

const tl_command tl_draw_command = {
    "draw",
    "Levels",
    "draw the stages of a level or a baked file as PNG or SVG",
    "FILE -o OUT.png|OUT.svg [--stage NAME,...] [--view both|top|oblique]",
    "Draws a top view and an oblique view, both to scale. FILE is a level, a baked file, or contours\n"
    "('navcontours 1'). The stages, in the order of the pipeline: soup, spans, areas, distance, regions,\n"
    "contours, triangulation, merging, triangles, polygons, detail, navmesh, path, crowd; or all. Several\n"
    "stages go to several files: OUT-STAGE.png. What the level hides is drawn faintly. triangulation and merging\n"
    "show step by step how one contour is divided. crowd runs the --scenario of 'talus crowd' and draws the way\n"
    "that everybody took. A merged world of more than 2048 tiles is drawn from above, tile\n"
    "by tile, unless --view oblique or a path asks for all of it. Of the job of 'talus world' its tiles are drawn\n"
    "as maps: walkable, cost, time, missing; or all.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus draw courtyard.obj -o stages.png --stage soup,regions,polygons --size 400\n"
    "talus draw courtyard.obj -o overview.png --overview --size 400\n"
    "talus draw courtyard.talus -o way.svg --from 2,0,20 --to 38,0,20 --view top\n"
    "echo '{\"groups\": [{\"count\": 9, \"at\": [2, 0, 20], \"goals\": [[20, 5, 20]]}]}' > guests.json\n"
    "talus draw courtyard.talus -o guests.png --scenario guests.json\n"
    "talus draw courtyard.obj -o steps.png --stage triangulation,merging --contour 0",
    run_draw,
};
