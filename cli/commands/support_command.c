// SPDX-License-Identifier: MIT
//
// talus support: the point of a hull that lies farthest along a direction.

#include "cli/shapes/open_hull.h"
#include "cli/shared/line_batch.h"

#include <string.h>

typedef struct support_query {
    const tl_hull *hull;
    const tl_pack_frame *frame; // NULL: talus' own coordinates
    bool json;
} support_query;

// The dot product of the floats, in double, so that an oracle can be compared with it.
static bool answer_direction(const float *n, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const support_query *query = user;
    (void)count;
    (void)worker;
    uint32_t vertex = tl_hull_support(query->hull, tl_vec3_make(n[0], n[1], n[2]), TL_NO_VERTEX);
    tl_vec3 p = tl_hull_vertices(query->hull)[vertex];
    uint32_t source = tl_hull_source(query->hull, vertex);
    double at[3]; // as the level has it, and so the direction
    tl_pack_place_out(query->frame, p, at);
    const tl_vec3 own = tl_vec3_make(n[0], n[1], n[2]);
    const tl_vec3 d = query->frame != NULL ? tl_pack_turn_out((tl_pack_axes)query->frame->axes, own) : own;
    float dot = (float)(at[0] * (double)d.x + at[1] * (double)d.y + at[2] * (double)d.z);
    if (query->json) {
        tl_text_add(text, "{\"vertex\":");
        tl_text_add_count(text, source);
        tl_text_add(text, ",\"point\":");
        tl_text_add_json_point(text, p);
        tl_text_add(text, ",\"dot\":");
        tl_text_add_json_float(text, dot);
        tl_text_add(text, "}\n");
    } else {
        tl_text_add_count(text, source);
        tl_text_add(text, " ");
        tl_text_add_point(text, p, ' ');
        tl_text_add(text, " ");
        tl_text_add_float(text, dot);
        tl_text_add(text, "\n");
    }
    return true;
}

static tl_exit run_support(tl_cli *cli)
{
    const char *directions = NULL;
    tl_hull_settings settings = tl_default_hull_settings();
    const tl_option options[] = {
        { "directions", 'd', TL_OPTION_INPUT, &directions, "FILE",
          "answer for the directions of FILE, one a line; - is standard input", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    tl_exit code;
    if (!tl_hull_parse(cli, options, 2, &settings, &code)) {
        return code;
    }
    cli->speaks_frame = true;
    static const tl_question_words words = { "direction", NULL, "directions" };
    float numbers[3] = { 0 };
    if (!tl_question_read(cli, &words, directions, numbers, &code)) {
        return code;
    }
    tl_hull_input input;
    if (tl_hull_open(cli, cli->arguments.words[0], &settings, &input, &code)) {
        support_query query = { input.hull, cli->frame, cli->json };
        const tl_batch batch = { directions, "dx dy dz", 3, 3, answer_direction, &query, 1u };
        code = tl_batch_run(cli, &batch, numbers);
    }
    tl_hull_input_close(&input);
    return code;
}

const tl_command tl_support_command = {
    "support",
    "Convex hulls",
    "find a hull's farthest vertex in a direction",
    "HULL DX,DY,DZ [options]\n"
    "HULL --directions FILE|- [options]",
    "Finds the vertex of a hull that lies farthest in a direction. HULL is a mesh, points, or a baked file\n"
    "that holds a hull. FILE holds one direction a line: dx dy dz, of any length. The answer is one line for\n"
    "each, in order: vertex x y z dot. The vertex has its number in the file that the hull was baked from,\n"
    "from 0; of several that are equally far it is the first. dot is its product with the direction as given.",
    "printf '%s\\n' '0 0 0' '2 0 0' '0 2 0' '0 0 2' > points.txt\n"
    "talus support points.txt 0,1,0\n"
    "echo '0 1 0' > directions.txt\n"
    "talus support points.txt --directions directions.txt",
    run_support,
};
