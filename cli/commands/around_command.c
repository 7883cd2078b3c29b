// SPDX-License-Identifier: MIT
//
// talus around: what lies around a place on the navmesh: walls, what can be reached, random points.

#include "base/random.h"
#include "cli/level/navmesh_query.h"
#include "cli/level/open_input.h"
#include "cli/shared/line_batch.h"

#include <stdlib.h>
#include <string.h>
#include <talus/nav_around.h>

enum { LIST_WALLS, LIST_POLYGONS };

typedef struct around_settings {
    tl_bake_settings bake;
    const char *places;
    const char *extents_text;
    tl_vec3 extents;
    float radius;
    int list;
    uint32_t random; // how many points; 0: none
    uint64_t seed;
    bool everywhere; // random points of the whole navmesh
    bool json;
} around_settings;

// What the workers share, and each worker's own query.
typedef struct around_queries {
    const tl_navmesh *navmesh;
    const around_settings *settings;
    tl_nav_query **queries;
    uint32_t count;
} around_queries;

// Begins a list: its number on a line of its own, or the name of an array.
static void begin_list(tl_text *text, const around_settings *settings, const char *name, uint32_t count)
{
    if (settings->json) {
        tl_text_add(text, "{\"");
        tl_text_add(text, name);
        tl_text_add(text, "\":[");
    } else {
        tl_text_add_count(text, count);
        tl_text_add(text, "\n");
    }
}

static void end_list(tl_text *text, const around_settings *settings)
{
    tl_text_add(text, settings->json ? "]}\n" : "");
}

static void write_place(tl_text *text, const around_settings *settings, tl_vec3 point)
{
    if (settings->json) {
        tl_text_add_json_point(text, point);
    } else {
        tl_text_add_point(text, point, ',');
    }
}

static bool list_walls(const around_queries *all, tl_nav_query *query, const tl_nav_location *center, tl_text *text)
{
    const around_settings *settings = all->settings;
    uint32_t count = 0;
    const tl_nav_around_request request = { .center = *center, .radius = settings->radius };
    tl_nav_query_find_walls(query, all->navmesh, &request, NULL, 0, &count);
    tl_nav_wall_segment *walls = malloc((count + 1u) * sizeof(*walls));
    if (walls == NULL) {
        return false;
    }
    tl_nav_query_find_walls(query, all->navmesh, &request, walls, count, &count);
    begin_list(text, settings, "walls", count);
    for (uint32_t i = 0; i < count; ++i) {
        tl_text_add(text, !settings->json ? "" : i > 0 ? ",{\"distance\":" : "{\"distance\":");
        tl_text_add_float(text, walls[i].distance);
        tl_text_add(text, settings->json ? ",\"start\":" : " ");
        write_place(text, settings, walls[i].start);
        tl_text_add(text, settings->json ? ",\"end\":" : " ");
        write_place(text, settings, walls[i].end);
        tl_text_add(text, settings->json ? "}" : "\n");
    }
    end_list(text, settings);
    free(walls);
    return true;
}

static bool list_polygons(const around_queries *all, tl_nav_query *query, const tl_nav_location *center, tl_text *text)
{
    const around_settings *settings = all->settings;
    tl_nav_field_def def = tl_default_nav_field_def();
    def.max_cost = settings->radius;
    uint32_t count = 0;
    tl_nav_query_flood(query, all->navmesh, center, &def, NULL, 0, &count);
    tl_nav_field_entry *entries = malloc((count + 1u) * sizeof(*entries));
    if (entries == NULL) {
        return false;
    }
    tl_nav_query_flood(query, all->navmesh, center, &def, entries, count, &count);
    begin_list(text, settings, "polygons", count);
    for (uint32_t i = 0; i < count; ++i) {
        tl_text_add(text, !settings->json ? "" : i > 0 ? ",{\"cost\":" : "{\"cost\":");
        tl_text_add_float(text, entries[i].cost);
        tl_text_add(text, settings->json ? ",\"point\":" : " ");
        write_place(text, settings, entries[i].point);
        tl_text_add(text, settings->json ? "}" : "\n");
    }
    end_list(text, settings);
    free(entries);
    return true;
}

static void list_random(const around_queries *all, tl_nav_query *query, const tl_nav_location *center, tl_text *text)
{
    const around_settings *settings = all->settings;
    uint64_t state = settings->seed;
    begin_list(text, settings, "points", settings->random);
    for (uint32_t i = 0; i < settings->random; ++i) {
        const uint64_t bits[2] = { tl_random_bits(&state), tl_random_bits(&state) };
        tl_nav_location at;
        if (center == NULL) {
            tl_navmesh_random_point(all->navmesh, NULL, bits, &at);
        } else {
            const tl_nav_around_request request = { .center = *center, .radius = settings->radius };
            tl_nav_query_random_reachable(query, all->navmesh, &request, bits, &at);
        }
        tl_text_add(text, settings->json && i > 0 ? "," : "");
        write_place(text, settings, at.point);
        tl_text_add(text, settings->json ? "" : "\n");
    }
    end_list(text, settings);
}

// Answers one place; returns whether there is navmesh near it.
static bool answer_place(const float *n, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const around_queries *all = user;
    const around_settings *settings = all->settings;
    (void)count;
    tl_nav_location center = { TL_NAV_NO_REF, { n[0], n[1], n[2] } };
    if (!settings->everywhere &&
        tl_navmesh_find_nearest(all->navmesh, NULL, center.point, settings->extents, &center) != TL_OK) {
        tl_text_add(text, settings->json ? "{\"status\":\"no navmesh there\"}\n" : "none: no navmesh there\n");
        return false;
    }
    if (settings->random > 0) {
        list_random(all, all->queries[worker], settings->everywhere ? NULL : &center, text);
    } else if (settings->list == LIST_WALLS) {
        text->failed = !list_walls(all, all->queries[worker], &center, text) || text->failed;
    } else {
        text->failed = !list_polygons(all, all->queries[worker], &center, text) || text->failed;
    }
    return true;
}

static bool make_queries(around_queries *all, uint32_t count)
{
    const tl_nav_query_def def = tl_whole_query_def(all->navmesh);
    all->queries = calloc(count, sizeof(*all->queries));
    for (uint32_t i = 0; all->queries != NULL && i < count; ++i) {
        all->count = i + 1;
        if (tl_nav_query_create(&def, &all->queries[i], NULL) != TL_OK) {
            return false;
        }
    }
    return all->queries != NULL;
}

static tl_exit answer_places(tl_cli *cli, around_settings *settings, const float *numbers)
{
    tl_input input;
    tl_exit code;
    if (tl_input_open_navmesh(cli, cli->arguments.words[0], &settings->bake, &input, &code) &&
        tl_extents_read(cli, settings->extents_text, &settings->extents, &code)) {
        around_queries all = { input.navmesh, settings, NULL, 0 };
        if (!make_queries(&all, settings->places != NULL ? cli->host.tasks->worker_count : 1)) {
            code = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
        } else {
            const tl_batch batch = { settings->places, "x y z", 3, 3, answer_place, &all, 0 };
            code = tl_batch_run(cli, &batch, numbers);
        }
        for (uint32_t i = 0; i < all.count; ++i) {
            tl_nav_query_destroy(all.queries[i]);
        }
        free(all.queries);
    }
    tl_input_close(&input);
    return code;
}

static bool parse_around_words(tl_cli *cli, around_settings *settings, float numbers[3], tl_exit *exit_out)
{
    static const tl_question_words words = { "place", NULL, "places" };
    settings->everywhere = cli->arguments.count == 1 && settings->places == NULL && settings->random > 0;
    return tl_extents_read(cli, settings->extents_text, &settings->extents, exit_out) &&
           (settings->everywhere || tl_question_read(cli, &words, settings->places, numbers, exit_out));
}

static tl_exit run_around(tl_cli *cli)
{
    static const char *const LISTS[] = { "walls", "polygons", NULL };
    around_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    settings.extents = tl_vec3_make(2.0f, 4.0f, 2.0f);
    settings.radius = 10.0f;
    settings.seed = 1;
    const tl_option options[] = {
        { "places", 'p', TL_OPTION_INPUT, &settings.places, "FILE",
          "answer for the places of FILE, one a line; - is standard input", NULL, 0, 0, 0, 0 },
        { "radius", 0, TL_OPTION_FLOAT, &settings.radius, "M",
          "metres: radius for walls and random points; length of paths for polygons", NULL, 0.0f, 1e9f, 0, 0 },
        { "list", 0, TL_OPTION_CHOICE, &settings.list, "WHAT",
          "walls within the radius, nearest first; or polygons that a path of that length enters", LISTS, 0, 0, 0, 0 },
        { "random", 0, TL_OPTION_COUNT, &settings.random, "N",
          "print N random points instead, reachable from the place; without a place, of the whole navmesh", NULL, 0, 0,
          0, 1000000000 },
        { "seed", 0, TL_OPTION_NUMBER, &settings.seed, "N", "seed of the random points", NULL, 0, 0, 0, 0 },
        { "extents", 0, TL_OPTION_TEXT, &settings.extents_text, "X,Y,Z",
          "metres: how far from a place its navmesh polygon may lie (2,4,2)", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    float numbers[3] = { 0 };
    if (!tl_input_parse(cli, groups, TL_INPUT_NAVMESH, &settings.bake, 1, 2, &code)) {
        return code;
    }
    settings.json = cli->json;
    return parse_around_words(cli, &settings, numbers, &code) ? answer_places(cli, &settings, numbers) : code;
}

const tl_command tl_around_command = {
    "around",
    "Navmesh",
    "list walls, polygons or random points around a place",
    "FILE X,Y,Z [options]\n"
    "FILE --places PLACES|- [options]\n"
    "FILE --random N [options]",
    "Lists what lies around a place on the navmesh. FILE is a baked file, or a level, which is then baked in\n"
    "memory. The answer is a count, then one line for each: distance x,y,z x,y,z for a wall; cost x,y,z for a\n"
    "polygon, the point where the path enters it; x,y,z for a random point, uniform by area.\n"
    "\n"
    "PLACES holds one place a line: x y z. A single place without navmesh exits with 1.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus around courtyard.talus 2,0,20 --radius 5\n"
    "talus around courtyard.talus 2,0,20 --list polygons --json\n"
    "talus around courtyard.talus --random 100 --seed 7",
    run_around,
};
