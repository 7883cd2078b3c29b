// SPDX-License-Identifier: MIT
//
// talus sweep: what a moving ball, capsule or box meets first.

#include "cli/level/open_input.h"
#include "cli/shapes/shape_option.h"
#include "cli/shared/json_out.h"
#include "cli/shared/line_batch.h"

#include <string.h>

typedef struct sweep_settings {
    tl_bake_settings bake;
    tl_shape_option shape;
    const char *sweeps;
    int cull; ///< a tl_ray_cull
    bool json;
} sweep_settings;

typedef struct sweep_query {
    const tl_soup *soup;
    tl_ray_filter filter;
    const sweep_settings *settings;
} sweep_query;

static void write_sweep_hit(tl_text *text, const tl_shape_hit *hit)
{
    tl_text_add_float(text, hit->t);
    tl_text_add(text, " ");
    tl_text_add_count(text, hit->triangle);
    tl_text_add(text, " ");
    tl_text_add_point(text, hit->point, ' ');
    tl_text_add(text, " ");
    tl_text_add_direction(text, hit->normal, ' ');
    if (hit->initial_overlap) {
        tl_text_add(text, " ");
        tl_text_add_float(text, hit->depth);
    }
    tl_text_add(text, "\n");
}

static void write_json_sweep_hit(tl_text *text, const tl_shape_hit *hit)
{
    tl_text_add(text, "{\"hit\":true,\"t\":");
    tl_text_add_json_float(text, hit->t);
    tl_text_add(text, ",\"triangle\":");
    tl_text_add_count(text, hit->triangle);
    tl_text_add(text, ",\"point\":");
    tl_text_add_json_point(text, hit->point);
    tl_text_add(text, ",\"normal\":");
    tl_text_add_json_direction(text, hit->normal);
    tl_text_add(text, ",\"face_normal\":");
    tl_text_add_json_direction(text, hit->face_normal);
    tl_text_add(text, hit->back ? ",\"back\":true" : ",\"back\":false");
    tl_text_add(text, hit->initial_overlap ? ",\"overlap\":true,\"depth\":" : ",\"overlap\":false,\"depth\":");
    tl_text_add_json_float(text, hit->depth);
    tl_text_add(text, "}\n");
}

// Answers one sweep; returns whether something was hit.
static bool answer_sweep(const float *n, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const sweep_query *query = user;
    (void)count;
    (void)worker;
    tl_transform pose = tl_transform_identity();
    pose.position = tl_vec3_make(n[0], n[1], n[2]);
    tl_shape_hit hit;
    tl_result result = tl_soup_cast_shape(query->soup, &query->settings->shape.shape, pose,
                                          tl_vec3_make(n[3], n[4], n[5]), &query->filter, &hit);
    if (result != TL_OK) {
        tl_text_add(text, query->settings->json ? "{\"hit\":false}\n" : "free\n");
        return false;
    }
    if (query->settings->json) {
        write_json_sweep_hit(text, &hit);
    } else {
        write_sweep_hit(text, &hit);
    }
    return true;
}

static tl_exit sweep_shape(tl_cli *cli, sweep_settings *settings, const float *numbers)
{
    tl_input input;
    tl_exit code;
    if (tl_input_open_soup(cli, cli->arguments.words[0], &settings->bake, &input, &code) &&
        tl_shape_option_read(cli, &settings->shape, &code)) {
        sweep_query query = { .soup = input.soup, .settings = settings };
        query.filter.cull = (tl_ray_cull)settings->cull;
        tl_batch batch = { settings->sweeps, "x y z dx dy dz", 6, 6, answer_sweep, &query, 2u };
        code = tl_batch_run(cli, &batch, numbers);
    }
    tl_input_close(&input);
    return code;
}

static tl_exit run_sweep(tl_cli *cli)
{
    static const char *const culls[] = { "none", "back", "front", NULL };
    sweep_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    settings.shape = tl_default_shape_option();
    const tl_option options[] = {
        { "sweeps", 's', TL_OPTION_INPUT, &settings.sweeps, "FILE",
          "answer for the sweeps of FILE, one a line; - is standard input", NULL, 0, 0, 0, 0 },
        { "cull", 0, TL_OPTION_CHOICE, &settings.cull, NULL, "sides of triangles to ignore", culls, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    tl_option shape_options[TL_SHAPE_OPTIONS];
    tl_shape_options(&settings.shape, shape_options);
    const tl_option_group groups[] = { { "Options:", options }, { "Shape:", shape_options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    float numbers[6] = { 0 };
    if (!tl_input_parse(cli, groups, TL_INPUT_LEVEL, &settings.bake, 1, 3, &code) ||
        !tl_shape_option_read(cli, &settings.shape, &code)) {
        return code;
    }
    settings.json = cli->json;
    static const tl_question_words words = { "point", "motion", "sweeps" };
    if (!tl_question_read(cli, &words, settings.sweeps, numbers, &code)) {
        return code;
    }
    return sweep_shape(cli, &settings, numbers);
}

const tl_command tl_sweep_command = {
    "sweep",
    "Triangles",
    "sweep a ball, capsule or box",
    "FILE X,Y,Z DX,DY,DZ [options]\n"
    "FILE --sweeps SWEEPS|- [options]",
    "Moves a shape from a point along a motion, and finds the first triangle that it touches. FILE is a baked\n"
    "file, or a level, which is then baked in memory.\n"
    "\n"
    "SWEEPS holds one sweep a line: x y z dx dy dz. The answer is one line for each, in order: t triangle x y\n"
    "z nx ny nz, or free. t is the fraction of the motion before the contact; then come the point of contact\n"
    "and the normal towards the shape. A shape that overlaps the level at its start has t 0 and one more\n"
    "number, the penetration depth along the normal. A single sweep that is free exits with 1.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus sweep courtyard.talus 20,10,20 0,-10,0 --radius 0.4\n"
    "talus sweep courtyard.talus 2,5.5,20 36,0,0 --radius 0.4 --height 1.8 --json\n"
    "echo '20 10 20 0 -10 0' | talus sweep courtyard.obj --sweeps - --half 0.5,0.5,0.5",
    run_sweep,
};
