// SPDX-License-Identifier: MIT
//
// talus ray: what a ray hits, one ray or many.

#include "cli/level/open_input.h"
#include "cli/shared/json_out.h"
#include "cli/shared/line_batch.h"

#include <stdlib.h>
#include <string.h>

typedef struct ray_settings {
    tl_bake_settings bake;
    const char *rays;
    float tmax;
    int cull; ///< a tl_ray_cull
    bool any;
    bool all;       ///< every triangle that is touched
    bool crossings; ///< every passage through a surface, once
    bool segment;
    bool json;
} ray_settings;

typedef struct ray_query {
    const tl_soup *soup;
    tl_ray_filter filter;
    const ray_settings *settings;
} ray_query;

static bool is_any_hit(const ray_query *query, const float *n, float tmax)
{
    if (query->settings->segment) {
        return !tl_soup_line_of_sight(query->soup, tl_vec3_make(n[0], n[1], n[2]), tl_vec3_make(n[3], n[4], n[5]),
                                      &query->filter);
    }
    tl_ray ray = { { n[0], n[1], n[2] }, { n[3], n[4], n[5] }, tmax };
    return tl_soup_occluded(query->soup, &ray, &query->filter);
}

static bool find_closest(const ray_query *query, const float *n, float tmax, tl_ray_hit *hit_out)
{
    if (query->settings->segment) {
        return tl_soup_cast_segment(query->soup, tl_vec3_make(n[0], n[1], n[2]), tl_vec3_make(n[3], n[4], n[5]),
                                    &query->filter, hit_out);
    }
    tl_ray ray = { { n[0], n[1], n[2] }, { n[3], n[4], n[5] }, tmax };
    return tl_soup_cast_ray(query->soup, &ray, &query->filter, hit_out);
}

static void write_ray_hit(tl_text *text, const tl_ray_hit *hit)
{
    tl_text_add_float(text, hit->t);
    tl_text_add(text, " ");
    tl_text_add_count(text, hit->triangle);
    tl_text_add(text, " ");
    tl_text_add_float(text, hit->u);
    tl_text_add(text, " ");
    tl_text_add_float(text, hit->v);
    tl_text_add(text, "\n");
}

static void add_json_hit(tl_text *text, const tl_ray_hit *hit, const float *n, bool segment)
{
    tl_vec3 from = tl_vec3_make(n[0], n[1], n[2]);
    tl_vec3 to = tl_vec3_make(n[3], n[4], n[5]);
    tl_vec3 point = segment ? tl_lerp(from, to, hit->t) : tl_mul_add(from, to, hit->t);
    tl_text_add(text, "\"t\":");
    tl_text_add_json_float(text, hit->t);
    tl_text_add(text, ",\"triangle\":");
    tl_text_add_count(text, hit->triangle);
    tl_text_add(text, ",\"u\":");
    tl_text_add_json_float(text, hit->u);
    tl_text_add(text, ",\"v\":");
    tl_text_add_json_float(text, hit->v);
    tl_text_add(text, ",\"point\":");
    tl_text_add_json_point(text, point);
    tl_text_add(text, ",\"normal\":");
    tl_text_add_json_direction(text, hit->normal);
    tl_text_add(text, hit->back ? ",\"back\":true}" : ",\"back\":false}");
}

static void write_all_hits(tl_text *text, const tl_ray_hit *hits, uint32_t count, const float *n, bool json)
{
    if (json) {
        tl_text_add(text, "{\"hits\":[");
    } else {
        tl_text_add_count(text, count);
        tl_text_add(text, "\n");
    }
    for (uint32_t i = 0; i < count; ++i) {
        if (json) {
            tl_text_add(text, i > 0 ? ",{" : "{");
            add_json_hit(text, &hits[i], n, false);
        } else {
            write_ray_hit(text, &hits[i]);
        }
    }
    tl_text_add(text, json ? "]}\n" : "");
}

// Answers one ray with all its hits; returns whether there are any.
static bool answer_all(const ray_query *query, const float *n, float tmax, tl_text *text)
{
    enum { FEW_HITS = 64 };
    tl_ray ray = { { n[0], n[1], n[2] }, { n[3], n[4], n[5] }, tmax };
    tl_hit_rule rule = query->settings->crossings ? TL_HITS_CROSSED : TL_HITS_TOUCHED;
    tl_ray_hit few[FEW_HITS], *hits = few;
    uint32_t count = 0; // stays 0 for a ray that leads nowhere
    tl_result result = tl_soup_cast_ray_all(query->soup, &ray, rule, &query->filter, few, FEW_HITS, &count);
    if (result == TL_INCOMPLETE) {
        hits = malloc(count * sizeof(*hits));
        if (hits == NULL) {
            text->failed = true;
            return true;
        }
        (void)tl_soup_cast_ray_all(query->soup, &ray, rule, &query->filter, hits, count, &count);
    }
    write_all_hits(text, hits, count, n, query->settings->json);
    if (hits != few) {
        free(hits);
    }
    return count > 0;
}

// Answers one ray; returns whether it hit.
static bool answer_ray(const float *numbers, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const ray_query *query = user;
    const ray_settings *settings = query->settings;
    const float tmax = count == 7 ? numbers[6] : settings->tmax;
    (void)worker;
    if (settings->all) {
        return answer_all(query, numbers, tmax, text);
    }
    if (settings->any) {
        bool hit = is_any_hit(query, numbers, tmax);
        tl_text_add(text, settings->json ? (hit ? "{\"hit\":true}\n" : "{\"hit\":false}\n") : hit ? "hit\n" : "miss\n");
        return hit;
    }
    tl_ray_hit hit;
    if (!find_closest(query, numbers, tmax, &hit)) {
        tl_text_add(text, settings->json ? "{\"hit\":false}\n" : "miss\n");
        return false;
    }
    if (settings->json) {
        tl_text_add(text, "{\"hit\":true,");
        add_json_hit(text, &hit, numbers, settings->segment);
        tl_text_add(text, "\n");
    } else {
        write_ray_hit(text, &hit);
    }
    return true;
}

static tl_exit cast_rays(tl_cli *cli, const ray_settings *settings, const float *numbers)
{
    tl_input input;
    tl_exit code;
    if (tl_input_open_soup(cli, cli->arguments.words[0], &settings->bake, &input, &code)) {
        ray_query query = { .soup = input.soup, .settings = settings };
        query.filter.cull = (tl_ray_cull)settings->cull;
        const tl_batch rays = { settings->rays, "ox oy oz dx dy dz [tmax]", 6, 7, answer_ray, &query, 2u };
        const tl_batch segments = { settings->rays, "ax ay az bx by bz", 6, 6, answer_ray, &query, 0 };
        code = tl_batch_run(cli, settings->segment ? &segments : &rays, numbers);
    }
    tl_input_close(&input);
    return code;
}

static tl_exit run_ray(tl_cli *cli)
{
    static const char *const culls[] = { "none", "back", "front", NULL };
    ray_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    settings.tmax = INFINITY;
    const tl_option options[] = {
        { "rays", 'r', TL_OPTION_INPUT, &settings.rays, "FILE",
          "cast the rays of FILE, one a line; - is standard input", NULL, 0, 0, 0, 0 },
        { "any", 0, TL_OPTION_FLAG, &settings.any, NULL, "say only hit or miss, which is faster", NULL, 0, 0, 0, 0 },
        { "all", 'a', TL_OPTION_FLAG, &settings.all, NULL, "print every triangle that the ray touches, nearest first",
          NULL, 0, 0, 0, 0 },
        { "crossings", 0, TL_OPTION_FLAG, &settings.crossings, NULL,
          "the same, but each crossing of a surface once, at edges and corners too", NULL, 0, 0, 0, 0 },
        { "segment", 0, TL_OPTION_FLAG, &settings.segment, NULL,
          "cast from point to point: the second triple is the end, t runs from 0 to 1", NULL, 0, 0, 0, 0 },
        { "tmax", 0, TL_OPTION_FLOAT, &settings.tmax, "T", "how far rays reach, in lengths of their direction", NULL,
          0.0f, 3e38f, 0, 0 },
        { "cull", 0, TL_OPTION_CHOICE, &settings.cull, NULL, "sides of triangles to ignore", culls, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    float numbers[6] = { 0 };
    if (!tl_input_parse(cli, groups, TL_INPUT_LEVEL, &settings.bake, 1, 3, &code)) {
        return code;
    }
    settings.json = cli->json;
    settings.all = settings.all || settings.crossings;
    if (settings.all && (settings.any || settings.segment)) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--all and --crossings go with rays, not with --any or --segment");
    }
    static const tl_question_words rays = { "origin", "direction", "rays" }, segments = { "start", "end", "rays" };
    if (!tl_question_read(cli, settings.segment ? &segments : &rays, settings.rays, numbers, &code)) {
        return code;
    }
    if (settings.rays == NULL && !settings.segment && numbers[3] == 0.0f && numbers[4] == 0.0f && numbers[5] == 0.0f) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "the direction 0,0,0 has no length");
    }
    return cast_rays(cli, &settings, numbers);
}

const tl_command tl_ray_command = {
    "ray",
    "Triangles",
    "cast rays",
    "FILE OX,OY,OZ DX,DY,DZ [options]\n"
    "FILE --segment AX,AY,AZ BX,BY,BZ [options]\n"
    "FILE --rays RAYS|- [options]",
    "Finds the first triangle that a ray hits, or only whether it hits one. FILE is a baked file, or a level,\n"
    "which is then baked in memory.\n"
    "\n"
    "RAYS holds one ray a line: ox oy oz dx dy dz [tmax]; with --segment: ax ay az bx by bz. The answer is\n"
    "one line for each ray, in order: t triangle u v, or miss; with --any: hit or miss; with --all or\n"
    "--crossings: the number of hits, then a line for each. The point of the hit is origin + t * direction,\n"
    "and in barycentric coordinates corner 0 * (1-u-v) + corner 1 * u + corner 2 * v. Triangles have their\n"
    "numbers in the source, from 0. A single ray that misses exits with 1.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus ray courtyard.talus 20,10,20 0,-1,0\n"
    "talus ray courtyard.talus 20,10,20 0,-1,0 --all\n"
    "talus ray courtyard.talus --segment 20,10,20 20,0,20 --any\n"
    "echo '20 10 20 0 -1 0' | talus ray courtyard.obj --rays - --json",
    run_ray,
};
