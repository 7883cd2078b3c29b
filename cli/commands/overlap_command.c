// SPDX-License-Identifier: MIT
//
// talus overlap: which triangles a ball, capsule or box touches.

#include "cli/level/open_input.h"
#include "cli/shapes/shape_option.h"
#include "cli/shared/json_out.h"
#include "cli/shared/line_batch.h"

#include <stdlib.h>
#include <string.h>

typedef struct overlap_settings {
    tl_bake_settings bake;
    tl_shape_option shape;
    const char *points;
    bool any;
    bool json;
} overlap_settings;

typedef struct overlap_query {
    const tl_soup *soup;
    const overlap_settings *settings;
} overlap_query;

static void write_list(tl_text *text, const uint32_t *triangles, uint32_t count, bool json)
{
    tl_text_add(text, json ? "{\"count\":" : "");
    tl_text_add_count(text, count);
    tl_text_add(text, json ? ",\"triangles\":[" : "");
    for (uint32_t i = 0; i < count; ++i) {
        tl_text_add(text, !json ? " " : i > 0 ? "," : "");
        tl_text_add_count(text, triangles[i]);
    }
    tl_text_add(text, json ? "]}\n" : "\n");
}

// Answers one point; returns whether anything is touched.
static bool answer_overlap(const float *n, uint32_t number_count, tl_text *text, uint32_t worker, void *user)
{
    enum { FEW_OVERLAPS = 256 };
    const overlap_query *query = user;
    (void)number_count;
    (void)worker;
    const overlap_settings *settings = query->settings;
    tl_transform pose = tl_transform_identity();
    pose.position = tl_vec3_make(n[0], n[1], n[2]);
    if (settings->any) {
        bool touches = false;
        (void)tl_soup_overlaps(query->soup, &settings->shape.shape, pose, NULL, &touches);
        tl_text_add(text, settings->json ? touches ? "{\"overlaps\":true}\n" : "{\"overlaps\":false}\n"
                          : touches      ? "touches\n"
                                         : "free\n");
        return touches;
    }
    uint32_t few[FEW_OVERLAPS], *triangles = few, count = 0;
    tl_result result =
        tl_soup_find_overlaps(query->soup, &settings->shape.shape, pose, NULL, few, FEW_OVERLAPS, &count);
    if (result == TL_INCOMPLETE) {
        triangles = malloc(count * sizeof(*triangles));
        if (triangles == NULL) {
            text->failed = true;
            return true;
        }
        (void)tl_soup_find_overlaps(query->soup, &settings->shape.shape, pose, NULL, triangles, count, &count);
    }
    write_list(text, triangles, count, settings->json);
    if (triangles != few) {
        free(triangles);
    }
    return count > 0;
}

static tl_exit run_overlap(tl_cli *cli)
{
    overlap_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    settings.shape = tl_default_shape_option();
    const tl_option options[] = {
        { "points", 'p', TL_OPTION_INPUT, &settings.points, "FILE",
          "answer for the points of FILE, one a line; - is standard input", NULL, 0, 0, 0, 0 },
        { "any", 0, TL_OPTION_FLAG, &settings.any, NULL, "say only touches or free, which is faster", NULL, 0, 0, 0,
          0 },
        TL_OPTION_TABLE_END,
    };
    tl_option shape_options[TL_SHAPE_OPTIONS];
    tl_shape_options(&settings.shape, shape_options);
    const tl_option_group groups[] = { { "Options:", options }, { "Shape:", shape_options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    float numbers[3] = { 0 };
    if (!tl_input_parse(cli, groups, TL_INPUT_LEVEL, &settings.bake, 1, 2, &code) ||
        !tl_shape_option_read(cli, &settings.shape, &code)) {
        return code;
    }
    settings.json = cli->json;
    static const tl_question_words words = { "point", NULL, "points" };
    if (!tl_question_read(cli, &words, settings.points, numbers, &code)) {
        return code;
    }
    tl_input input;
    if (tl_input_open_soup(cli, cli->arguments.words[0], &settings.bake, &input, &code) &&
        tl_shape_option_read(cli, &settings.shape, &code)) {
        overlap_query query = { input.soup, &settings };
        tl_batch batch = { settings.points, "x y z", 3, 3, answer_overlap, &query, 0 };
        code = tl_batch_run(cli, &batch, numbers);
    }
    tl_input_close(&input);
    return code;
}

const tl_command tl_overlap_command = {
    "overlap",
    "Triangles",
    "find what a ball, capsule or box touches",
    "FILE X,Y,Z [options]\n"
    "FILE --points POINTS|- [options]",
    "Lists the triangles that a shape at rest touches. FILE is a baked file, or a level, which is then baked\n"
    "in memory.\n"
    "\n"
    "POINTS holds one point a line: x y z. The answer is one line for each, in order: how many triangles,\n"
    "then their numbers in the source, from 0; with --any: touches or free. A single shape that is free exits\n"
    "with 1.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus overlap courtyard.talus 20,5,20 --radius 0.4\n"
    "talus overlap courtyard.talus 20,4.5,20 --radius 0.4 --height 1.8 --any\n"
    "echo '20 5 20' | talus overlap courtyard.obj --points - --half 1,1,1 --json",
    run_overlap,
};
