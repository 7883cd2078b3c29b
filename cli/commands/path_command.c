// SPDX-License-Identifier: MIT
//
// talus path: the path from one point to another, for one pair or many.

#include "cli/level/agent_route.h"
#include "cli/level/area_filter.h"
#include "cli/level/navmesh_query.h"
#include "cli/level/open_input.h"
#include "cli/shared/json_out.h"
#include "cli/shared/line_batch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/nav_prepare.h>

typedef struct path_settings {
    tl_bake_settings bake;
    const char *pairs;
    const char *extents_text;
    tl_vec3 extents;
    tl_area_filter areas;
    float radius; // metres; 0: the mesh's own agent
    float slack;  // share of the shortest length
    bool partial;
    bool prepared;
    bool json;
} path_settings;

// What one worker searches with. Buffers grow when a route needs more.
typedef struct route_searcher {
    tl_nav_query *query;
    tl_nav_path_buffers buffers;
} route_searcher;

typedef struct path_queries {
    const tl_navmesh *navmesh;
    const path_settings *settings;
    route_searcher *searchers; // one a worker
    uint32_t searcher_count;
} path_queries;

enum { FIRST_ROUTE_CAPACITY = 1024 };

static bool grow_route_buffers(route_searcher *s, uint32_t polygons, uint32_t corners)
{
    if (polygons > s->buffers.polygon_capacity) {
        tl_nav_ref *moved = realloc(s->buffers.polygons, polygons * sizeof(*moved));
        if (moved == NULL) {
            return false;
        }
        s->buffers.polygons = moved;
        s->buffers.polygon_capacity = polygons;
    }
    if (corners > s->buffers.corner_capacity) {
        tl_nav_corner *moved = realloc(s->buffers.corners, corners * sizeof(*moved));
        if (moved == NULL) {
            return false;
        }
        s->buffers.corners = moved;
        s->buffers.corner_capacity = corners;
    }
    return true;
}

// A route's corners may outnumber its polygons by the two ends; a second growth happens when only the first count was
// known.
static tl_result find_pair_route(const path_queries *queries, route_searcher *s, const float *n, tl_nav_route *route)
{
    const tl_nav_route_request request = { .filter = &queries->settings->areas.filter,
                                           .start = tl_vec3_make(n[0], n[1], n[2]),
                                           .goal = tl_vec3_make(n[3], n[4], n[5]),
                                           .half_extents = queries->settings->extents };
    tl_result result = TL_INCOMPLETE;
    for (unsigned trial = 0; trial < 3 && result == TL_INCOMPLETE; ++trial) {
        memset(route, 0, sizeof(*route));
        result =
            tl_agent_route_find(s->query, queries->navmesh, &request, queries->settings->radius, &s->buffers, route);
        if (result == TL_INCOMPLETE && !grow_route_buffers(s, route->path.polygon_count, route->corner_count + 2)) {
            return TL_ERR_MEMORY;
        }
    }
    return result;
}

static void write_route_corners(tl_text *text, const route_searcher *s, const tl_nav_route *route, bool json)
{
    for (uint32_t i = 0; i < route->corner_count; ++i) {
        if (json) {
            tl_text_add(text, i > 0 ? "," : "");
            tl_text_add_json_point(text, s->buffers.corners[i].point);
        } else {
            tl_text_add(text, " ");
            tl_text_add_point(text, s->buffers.corners[i].point, ',');
        }
    }
}

// The corners at which an off-mesh link is taken, where there are any.
static void write_json_links(tl_text *text, const route_searcher *s, const tl_nav_route *route)
{
    bool any = false;
    for (uint32_t i = 0; i < route->corner_count; ++i) {
        if ((s->buffers.corners[i].flags & TL_NAV_CORNER_LINK) != 0) {
            tl_text_add(text, any ? "," : ",\"links_at\":[");
            tl_text_add_count(text, i);
            any = true;
        }
    }
    tl_text_add(text, any ? "]" : "");
}

static void write_json_route(tl_text *text, const route_searcher *s, const tl_nav_route *route, tl_result result)
{
    if (result == TL_NOT_FOUND) {
        bool start = route->start.polygon == TL_NAV_NO_REF;
        tl_text_add(text, start ? "{\"status\":\"no navmesh at start\"}\n" : "{\"status\":\"no navmesh at goal\"}\n");
        return;
    }
    tl_text_add(text, "{\"status\":\"");
    tl_text_add(text, tl_nav_path_status_name(route->path.status));
    tl_text_add(text, "\",\"length\":");
    tl_text_add_json_float(text, route->length);
    tl_text_add(text, ",\"polygons\":");
    tl_text_add_count(text, route->path.polygon_count);
    tl_text_add(text, ",\"corners\":[");
    write_route_corners(text, s, route, true);
    tl_text_add(text, "]");
    write_json_links(text, s, route);
    tl_text_add(text, "}\n");
}

static void write_route(tl_text *text, const route_searcher *s, const tl_nav_route *route, tl_result result,
                        bool partial)
{
    if (result == TL_NOT_FOUND) {
        bool start = route->start.polygon == TL_NAV_NO_REF;
        tl_text_add(text, start ? "none: no navmesh at the start\n" : "none: no navmesh at the goal\n");
        return;
    }
    bool complete = route->path.status == TL_NAV_PATH_COMPLETE;
    if (complete || partial) {
        tl_text_add(text, complete ? "" : "partial ");
        tl_text_add_float(text, route->length);
        write_route_corners(text, s, route, false);
    } else {
        tl_vec3 end = s->buffers.corners[route->corner_count - 1].point;
        tl_text_add(text, "none: ");
        tl_text_add(text, tl_nav_path_status_name(route->path.status));
        tl_text_add(text, ", ends ");
        tl_text_add_float(text, tl_distance(end, route->goal.point));
        tl_text_add(text, " m short at ");
        tl_text_add_point(text, end, ',');
    }
    tl_text_add(text, "\n");
}

// Returns whether the goal is reached.
static bool answer_pair(const path_queries *queries, route_searcher *s, const float *numbers, tl_text *text)
{
    tl_nav_route route;
    tl_result result = find_pair_route(queries, s, numbers, &route);
    if (result != TL_OK && result != TL_NOT_FOUND) {
        bool json = queries->settings->json;
        text->failed = text->failed || result == TL_ERR_MEMORY;
        tl_text_add(text, json ? "{\"status\":\"" : "none: ");
        tl_text_add(text, tl_result_text(result));
        tl_text_add(text, json ? "\"}\n" : "\n");
        return false;
    }
    if (queries->settings->json) {
        write_json_route(text, s, &route, result);
    } else {
        write_route(text, s, &route, result, queries->settings->partial);
    }
    return result == TL_OK && route.path.status == TL_NAV_PATH_COMPLETE;
}

static bool answer_pair_line(const float *numbers, uint32_t count, tl_text *text, uint32_t worker, void *user)
{
    const path_queries *queries = user;
    (void)count;
    return answer_pair(queries, &queries->searchers[worker], numbers, text);
}

static void free_searchers(path_queries *queries)
{
    for (uint32_t i = 0; i < queries->searcher_count; ++i) {
        tl_nav_query_destroy(queries->searchers[i].query);
        free(queries->searchers[i].buffers.polygons);
        free(queries->searchers[i].buffers.corners);
    }
    free(queries->searchers);
}

static bool make_searchers(path_queries *queries, uint32_t count)
{
    tl_nav_query_def def = tl_whole_query_def(queries->navmesh);
    const uint32_t usual = tl_default_nav_query_def().max_nodes;
    // A path that keeps away from walls needs room for those near it, however few polygons there are.
    def.max_nodes = queries->settings->radius > 0.0f && def.max_nodes < usual ? usual : def.max_nodes;
    queries->searchers = calloc(count, sizeof(*queries->searchers));
    if (queries->searchers == NULL) {
        return false;
    }
    for (uint32_t i = 0; i < count; ++i) {
        queries->searcher_count = i + 1;
        route_searcher *s = &queries->searchers[i];
        if (tl_nav_query_create(&def, &s->query, NULL) != TL_OK ||
            !grow_route_buffers(s, FIRST_ROUTE_CAPACITY, FIRST_ROUTE_CAPACITY)) {
            return false;
        }
    }
    return true;
}

// Many wide paths pay for a look around each polygon; for the others that is the user's to say. TL_ERR_MEMORY and
// TL_ERR_CANCELLED; without what is too large, paths are found all the same.
static tl_result prepare_navmesh(const tl_cli *cli, tl_navmesh *navmesh, const path_settings *settings)
{
    if (settings->prepared) {
        tl_nav_prepare_def prepare = tl_default_nav_prepare_def();
        prepare.tasks = cli->host.tasks;
        prepare.progress = cli->host.progress;
        const tl_result result = tl_navmesh_prepare(navmesh, &prepare, NULL);
        if (result == TL_ERR_MEMORY || result == TL_ERR_CANCELLED) {
            return result;
        }
    }
    tl_nav_wide_def def = tl_default_nav_wide_def();
    def.max_radius = settings->radius;
    return settings->pairs != NULL && settings->radius > 0.0f &&
                   tl_navmesh_prepare_wide(navmesh, &def, NULL) == TL_ERR_MEMORY
               ? TL_ERR_MEMORY
               : TL_OK;
}

static tl_exit find_paths(tl_cli *cli, path_settings *settings, const float *numbers)
{
    tl_input input;
    tl_exit code;
    if (tl_input_open_navmesh(cli, cli->arguments.words[0], &settings->bake, &input, &code) &&
        tl_extents_read(cli, settings->extents_text, &settings->extents, &code)) {
        path_queries queries = { input.navmesh, settings, NULL, 0 };
        tl_area_filter_warn(cli, &settings->areas, input.navmesh, input.path);
        const tl_result prepared = prepare_navmesh(cli, input.navmesh, settings);
        if (prepared == TL_ERR_CANCELLED) {
            code = tl_cli_fail(cli, TL_EXIT_CANCELLED, "cancelled");
        } else if (prepared != TL_OK ||
                   !make_searchers(&queries, settings->pairs != NULL ? cli->host.tasks->worker_count : 1)) {
            code = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
        } else {
            const tl_batch batch = { settings->pairs, "ax ay az bx by bz", 6, 6, answer_pair_line, &queries, 0 };
            code = tl_batch_run(cli, &batch, numbers);
        }
        free_searchers(&queries);
    }
    tl_input_close(&input);
    return code;
}

static tl_exit run_path(tl_cli *cli)
{
    path_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    settings.extents = tl_vec3_make(2.0f, 4.0f, 2.0f);
    const tl_option options[] = {
        { "pairs", 'p', TL_OPTION_INPUT, &settings.pairs, "FILE",
          "find the paths of FILE, one pair a line; - is standard input", NULL, 0, 0, 0, 0 },
        { "extents", 0, TL_OPTION_TEXT, &settings.extents_text, "X,Y,Z",
          "metres: how far from a point its navmesh polygon may lie (2,4,2)", NULL, 0, 0, 0, 0 },
        { "radius", 'r', TL_OPTION_FLOAT, &settings.radius, "M",
          "metres: radius of an agent wider than the navmesh's own (0: its own)", NULL, 0, 1e6f, 0, 0 },
        { "slack", 0, TL_OPTION_FLOAT, &settings.slack, "SHARE",
          "a path may be longer than the shortest by this share, for which it is found sooner: 0.1 is 10% (0)", NULL, 0,
          TL_NAV_MAX_SLACK, 0, 0 },
        { "partial", 0, TL_OPTION_FLAG, &settings.partial, NULL,
          "print the path to the reachable point nearest to the goal, as: partial length corners", NULL, 0, 0, 0, 0 },
        { "prepared", 0, TL_OPTION_FLAG, &settings.prepared, NULL,
          "prepare the navmesh first (visibility graph); pays off from some hundred pairs on", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    tl_option area_options[TL_AREA_FILTER_OPTIONS];
    tl_area_filter_options(&settings.areas, area_options);
    const tl_option_group groups[] = { { "Options:", options }, { "Areas:", area_options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    float numbers[6] = { 0 };
    if (!tl_input_parse(cli, groups, TL_INPUT_NAVMESH, &settings.bake, 1, 3, &code) ||
        !tl_area_filter_read(cli, &settings.areas, &code)) {
        return code;
    }
    if (settings.radius > 0.0f && settings.areas.costs.count > 0) {
        return tl_cli_fail(cli, TL_EXIT_USAGE,
                           "--area-cost: paths of a given --radius are the shortest ones whatever areas cost; leave "
                           "out one of both, or use --exclude-area");
    }
    if (settings.radius > 0.0f && settings.slack > 0.0f) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--slack: paths of a given --radius have none; leave out one of both");
    }
    settings.areas.filter.slack = settings.slack;
    settings.json = cli->json;
    static const tl_question_words words = { "start", "goal", "pairs" };
    return tl_extents_read(cli, settings.extents_text, &settings.extents, &code) &&
                   tl_question_read(cli, &words, settings.pairs, numbers, &code)
               ? find_paths(cli, &settings, numbers)
               : code;
}

const tl_command tl_path_command = {
    "path",
    "Navmesh",
    "find the path from one point to another",
    "FILE AX,AY,AZ BX,BY,BZ [options]\n"
    "FILE --pairs PAIRS|- [options]",
    "Finds a path over the navmesh, and prints its length in metres and its corners, or why there is none.\n"
    "FILE is a baked file, or a level, which is then baked in memory.\n"
    "\n"
    "PAIRS holds one pair a line: ax ay az bx by bz. The answer is one line for each, in order: length x,y,z\n"
    "x,y,z ..., or none: reason. A single path that does not exist exits with 1.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus path courtyard.talus 2,0,20 38,0,20\n"
    "talus path courtyard.obj 2,0,20 38,0,20 --agent-radius 0.4 --json\n"
    "talus path courtyard.talus 2,0,20 38,0,20 --radius 1.2\n"
    "talus path courtyard.talus 2,0,20 38,0,20 --slack 0.1\n"
    "echo 'box 5 10 -1 10 30 3 30' > mud.txt\n"
    "talus path courtyard.obj 2,0,20 38,0,20 --areas mud.txt --area-cost 5=3\n"
    "talus path courtyard.obj 2,0,20 38,0,20 --areas mud.txt --exclude-area 5\n"
    "echo '2 0 20 38 0 20' > pairs.txt\n"
    "talus path courtyard.talus --pairs pairs.txt --prepared",
    run_path,
};
