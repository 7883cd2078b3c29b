// SPDX-License-Identifier: MIT
//
// talus nearest: the nearest point of the level, or whether a point is inside of it.

#include "cli/level/open_input.h"
#include "cli/shared/json_out.h"
#include "cli/shared/line_batch.h"

#include <string.h>

typedef struct nearest_settings {
    tl_bake_settings bake;
    const char *points;
    float max_distance;
    bool inside;
    bool json;
} nearest_settings;

typedef struct nearest_query {
    const tl_soup *soup;
    const nearest_settings *settings;
} nearest_query;

static const char *feature_name(tl_triangle_feature feature)
{
    return feature == TL_TRIANGLE_FACE ? "face" : feature < TL_TRIANGLE_CORNER_0 ? "edge" : "corner";
}

static void write_json_found_point(tl_text *text, const tl_soup_point *found)
{
    tl_text_add(text, "{\"found\":true,\"distance\":");
    tl_text_add_json_float(text, found->distance);
    tl_text_add(text, ",\"triangle\":");
    tl_text_add_count(text, found->triangle);
    tl_text_add(text, ",\"point\":");
    tl_text_add_json_point(text, found->point);
    tl_text_add(text, ",\"feature\":\"");
    tl_text_add(text, feature_name(found->feature));
    tl_text_add(text, "\",\"normal\":");
    tl_text_add_json_direction(text, found->normal);
    tl_text_add(text, found->back ? ",\"back\":true}\n" : ",\"back\":false}\n");
}

static void write_found_point(tl_text *text, const tl_soup_point *found)
{
    tl_text_add_float(text, found->distance);
    tl_text_add(text, " ");
    tl_text_add_count(text, found->triangle);
    tl_text_add(text, " ");
    tl_text_add_point(text, found->point, ' ');
    tl_text_add(text, " ");
    tl_text_add(text, feature_name(found->feature));
    tl_text_add(text, "\n");
}

// Tells where the point is; returns whether it is inside or on the surface.
static bool answer_inside(const nearest_query *query, tl_vec3 at, tl_text *text)
{
    tl_soup_location place;
    tl_result result = tl_soup_locate(query->soup, at, &place);
    const char *word = result != TL_OK                    ? "open"
                       : place.side == TL_SOUP_INSIDE     ? "inside"
                       : place.side == TL_SOUP_ON_SURFACE ? "surface"
                                                          : "outside";
    if (query->settings->json) {
        tl_text_add(text, "{\"place\":\"");
        tl_text_add(text, word);
        tl_text_add(text, "\"}\n");
    } else {
        tl_text_add(text, word);
        tl_text_add(text, "\n");
    }
    return result == TL_OK && place.side != TL_SOUP_OUTSIDE;
}

// Answers one point; returns whether there is something near it.
static bool answer_nearest(const float *n, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const nearest_query *query = user;
    const nearest_settings *settings = query->settings;
    (void)count;
    (void)worker;
    tl_vec3 at = tl_vec3_make(n[0], n[1], n[2]);
    if (settings->inside) {
        return answer_inside(query, at, text);
    }
    tl_soup_point found;
    if (tl_soup_nearest(query->soup, at, settings->max_distance, NULL, &found) != TL_OK) {
        tl_text_add(text, settings->json ? "{\"found\":false}\n" : "none\n");
        return false;
    }
    if (settings->json) {
        write_json_found_point(text, &found);
    } else {
        write_found_point(text, &found);
    }
    return true;
}

// --inside is for levels that enclose a space. One that does not is answered too, but the user is told.
static void warn_when_open(tl_cli *cli, const nearest_query *query)
{
    tl_report report;
    tl_result result = tl_soup_check_closed(query->soup, &cli->host, &report);
    if (result != TL_OK && report.element != NULL) {
        tl_cli_warn(cli, "%s %llu: %s; %s; inside and outside are certain only for closed surfaces", report.element,
                    (unsigned long long)report.element_index, tl_result_text(result), report.advice);
    }
}

static tl_exit run_nearest(tl_cli *cli)
{
    nearest_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    settings.max_distance = INFINITY;
    const tl_option options[] = {
        { "points", 'p', TL_OPTION_INPUT, &settings.points, "FILE",
          "answer for the points of FILE, one a line; - is standard input", NULL, 0, 0, 0, 0 },
        { "max-distance", 0, TL_OPTION_FLOAT, &settings.max_distance, "M", "metres: ignore what is farther away", NULL,
          0.0f, 3e38f, 0, 0 },
        { "inside", 0, TL_OPTION_FLAG, &settings.inside, NULL,
          "say whether the point is inside a closed surface: inside, outside, surface, or open", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    float numbers[3] = { 0 };
    if (!tl_input_parse(cli, groups, TL_INPUT_LEVEL, &settings.bake, 1, 2, &code)) {
        return code;
    }
    settings.json = cli->json;
    static const tl_question_words words = { "point", NULL, "points" };
    if (!tl_question_read(cli, &words, settings.points, numbers, &code)) {
        return code;
    }
    tl_input input;
    if (tl_input_open_soup(cli, cli->arguments.words[0], &settings.bake, &input, &code)) {
        nearest_query query = { input.soup, &settings };
        tl_batch batch = { settings.points, "x y z", 3, 3, answer_nearest, &query, 0 };
        if (settings.inside) {
            warn_when_open(cli, &query);
        }
        code = tl_batch_run(cli, &batch, numbers);
    }
    tl_input_close(&input);
    return code;
}

const tl_command tl_nearest_command = {
    "nearest",
    "Triangles",
    "find the nearest point, or whether a point is inside",
    "FILE X,Y,Z [options]\n"
    "FILE --points POINTS|- [options]",
    "Finds the point of the triangles that is nearest to a point. FILE is a baked file, or a level, which is\n"
    "then baked in memory.\n"
    "\n"
    "POINTS holds one point a line: x y z. The answer is one line for each, in order: distance triangle x y z\n"
    "feature, or none. The feature is face, edge or corner; triangles have their numbers in the source, from\n"
    "0. A single point with nothing near it, or that is not inside, exits with 1.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus nearest courtyard.talus 20,10,20\n"
    "talus nearest courtyard.talus 20,5.5,20 --max-distance 2 --json\n"
    "echo '20 10 20' | talus nearest courtyard.obj --points - --inside",
    run_nearest,
};
