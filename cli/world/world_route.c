// SPDX-License-Identifier: MIT
//
// Routes over a whole world: baked into its file, and asked with the tiles of both ends in memory alone.

#include "cli/world/world_route.h"

#include "cli/level/navmesh_query.h"
#include "cli/options/output_check.h"
#include "cli/options/parse_value.h"
#include "cli/shared/json_out.h"
#include "cli/world/route_picture.h"
#include "world/job/route_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

tl_exit tl_run_world_routes(tl_cli *cli, const char *path, const char *output, uint32_t block)
{
    tl_world_routes_report report;
    tl_io_error error;
    const tl_world_routes_def def = { path, output != NULL ? output : path, block, cli->host };
    const tl_result result = tl_world_add_routes(&def, &report, &error);
    tl_progress_end(&cli->progress);
    if (result != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    const double a_tile = report.tiles > 0 ? (double)report.route_bytes / (double)report.tiles : 0.0;
    if (cli->json) {
        return tl_cli_print_json(cli, json_pack("{so so sI sI sI sI so sI}", "file", tl_json_text(path), "output",
                                                tl_json_text(def.output), "tiles", (json_int_t)report.tiles, "gates",
                                                (json_int_t)report.gates, "lengths", (json_int_t)report.lengths,
                                                "route_bytes", (json_int_t)report.route_bytes, "route_bytes_a_tile",
                                                tl_json_double(a_tile), "bytes", (json_int_t)report.bytes));
    }
    printf("routes   %llu gates between %llu tiles, %llu lengths, %.0f bytes a tile\n",
           (unsigned long long)report.gates, (unsigned long long)report.tiles, (unsigned long long)report.lengths,
           a_tile);
    printf("wrote    %s\n", def.output);
    return TL_EXIT_OK;
}

// ---- One route -----------------------------------------------------------------------------------------------

typedef struct route_session {
    tl_vec3 extents; // metres around each end that are looked at for the navmesh
    tl_world_reader reader;
    tl_nav_world *world;
    tl_nav_router *router;
    tl_nav_world_route_point *points;
    uint32_t capacity;
    tl_nav_world_route route;
    tl_io_error error;
} route_session;

static tl_result fail_session(route_session *session, tl_result result, const tl_report *report)
{
    return tl_world_reader_fail(&session->reader, result, report, &session->error);
}

static tl_result open_session(route_session *session, const char *path)
{
    tl_report report;
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_result result = tl_world_reader_open(path, &session->reader, &session->error);
    if (result != TL_OK) {
        return result;
    }
    def.read = tl_world_reader_read;
    def.user = &session->reader;
    result = tl_nav_world_create(&def, &session->world, &report);
    if (result == TL_OK) {
        result = tl_nav_router_create(session->world, NULL, &session->router, &report);
    }
    if (result == TL_NOT_FOUND && session->world != NULL) {
        return tl_io_fail(&session->error, TL_ERR_UNSUPPORTED, path, 0, "run 'talus world routes' first",
                          "it holds no routes");
    }
    return result == TL_OK ? result : fail_session(session, result, &report);
}

// Loads the tiles around both ends.
static tl_result load_ends(route_session *session, double ends[2][3])
{
    tl_nav_world_interest interests[2];
    tl_report report;
    memset(&report, 0, sizeof report);
    for (int i = 0; i < 2; i++) {
        memcpy(interests[i].point, ends[i], sizeof interests[i].point);
        interests[i].radius =
            2.0 * (double)(session->extents.x > session->extents.z ? session->extents.x : session->extents.z);
    }
    tl_result loaded = TL_OK;
    while (loaded == TL_OK) {
        const tl_result result = tl_nav_world_update(session->world, interests, 2, UINT32_MAX);
        if (tl_is_error(result)) {
            return fail_session(session, result, &report);
        }
        tl_nav_world_load load;
        loaded = tl_nav_world_begin_load(session->world, &load);
        if (loaded == TL_OK) {
            const tl_result read = tl_nav_world_run_load(&load);
            report.advice = load.advice;
            tl_nav_world_end_load(&load);
            if (read != TL_OK) {
                return fail_session(session, read, &report);
            }
        }
    }
    return loaded == TL_NOT_FOUND ? TL_OK : fail_session(session, loaded, &report);
}

// TL_NOT_FOUND: there is no navmesh at an end, whose number is written.
static tl_result find_session_route(route_session *session, double ends[2][3], int *missing_out)
{
    tl_nav_world_route_request request;
    tl_nav_location *at[2] = { &request.start, &request.goal };
    tl_report report;
    memset(&report, 0, sizeof report);
    for (int i = 0; i < 2; i++) {
        const tl_result found = tl_nav_world_find_nearest(session->world, NULL, ends[i], session->extents, at[i]);
        if (found != TL_OK) {
            *missing_out = i;
            return tl_is_error(found) || found == TL_NOT_LOADED ? fail_session(session, found, &report) : found;
        }
    }
    tl_result result = TL_INCOMPLETE;
    while (result == TL_INCOMPLETE) {
        session->capacity = session->capacity > 0 ? session->route.point_count : 256;
        free(session->points);
        session->points = malloc(session->capacity * sizeof *session->points);
        if (session->points == NULL) {
            return fail_session(session, TL_ERR_MEMORY, &report);
        }
        result = tl_nav_world_find_route(session->world, session->router, &request, session->points, session->capacity,
                                         &session->route);
    }
    return result == TL_OK ? result : fail_session(session, result, &report);
}

static tl_exit print_json_route(tl_cli *cli, const route_session *session, const char *no)
{
    const tl_nav_world_route *route = &session->route;
    json_t *points = json_array();
    for (uint32_t i = 0; i < route->point_count; i++) {
        const tl_nav_world_route_point *point = &session->points[i];
        json_array_append_new(points,
                              json_pack("{s[fff] sf s[ii]}", "point", point->point[0], point->point[1], point->point[2],
                                        "length", point->length, "tile", point->tile_x, point->tile_z));
    }
    return tl_cli_print_json(cli, json_pack("{ss so so so}", "status", no != NULL ? no : "complete", "length",
                                            no != NULL ? json_null() : tl_json_double(route->length), "lower_bound",
                                            no != NULL ? json_null() : tl_json_double(route->lower_bound), "points",
                                            points));
}

static tl_exit print_route(tl_cli *cli, const route_session *session, tl_result result, int missing)
{
    const char *no = result == TL_NOT_FOUND ? missing == 0 ? "no navmesh at the start" : "no navmesh at the goal"
                     : session->route.status != TL_NAV_PATH_COMPLETE ? "unreachable"
                                                                     : NULL;
    if (cli->json) {
        const tl_exit code = print_json_route(cli, session, no);
        return code != TL_EXIT_OK || no == NULL ? code : TL_EXIT_NEGATIVE;
    }
    if (no != NULL) {
        printf("none: %s\n", no);
        return TL_EXIT_NEGATIVE;
    }
    printf("length   %.3f m, and no path is shorter than %.3f m\n", session->route.length, session->route.lower_bound);
    for (uint32_t i = 0; i < session->route.point_count; i++) {
        const tl_nav_world_route_point *point = &session->points[i];
        printf("%.3f  %.3f,%.3f,%.3f  tile %d,%d\n", point->length, point->point[0], point->point[1], point->point[2],
               (int)point->tile_x, (int)point->tile_z);
    }
    return TL_EXIT_OK;
}

static tl_exit draw_session_route(tl_cli *cli, route_session *session, const tl_world_route_request *request)
{
    const tl_route_picture picture = { &session->reader, tl_nav_world_index(session->world),
                                       request->output,  session->points,
                                       &session->route,  request->size };
    tl_io_error error;
    return tl_draw_world_route(&picture, &error) == TL_OK ? TL_EXIT_OK : tl_cli_fail_io(cli, &error);
}

static tl_exit answer_route(tl_cli *cli, route_session *session, const tl_world_route_request *request,
                            tl_result result, int missing)
{
    if (result != TL_OK && (result != TL_NOT_FOUND || session->error.result != TL_OK)) {
        return tl_cli_fail_io(cli, &session->error);
    }
    if (request->output != NULL && result == TL_OK && session->route.status == TL_NAV_PATH_COMPLETE) {
        const tl_exit drawn = draw_session_route(cli, session, request);
        if (drawn != TL_EXIT_OK) {
            return drawn;
        }
    }
    return print_route(cli, session, result, missing);
}

tl_exit tl_run_world_route(tl_cli *cli, const tl_world_route_request *request)
{
    double points[2][3];
    for (int i = 0; i < 2; i++) {
        const char *reason = tl_parse_double_triple(request->ends[i], points[i]);
        if (reason != NULL) {
            return tl_cli_fail(cli, TL_EXIT_USAGE, "'%s' %s; give x,y,z", request->ends[i], reason);
        }
    }
    if (request->output != NULL && !tl_has_ending(request->output, ".png") && !tl_has_ending(request->output, ".svg")) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--output: a route is drawn as .png or .svg; '%s' is neither",
                           request->output);
    }
    route_session session;
    memset(&session, 0, sizeof session);
    session.extents = tl_vec3_make(2.0f, 4.0f, 2.0f); // as talus path does
    tl_exit refused;
    if (!tl_extents_read(cli, request->extents, &session.extents, &refused)) {
        return refused;
    }
    int missing = 0;
    tl_result result = open_session(&session, request->file);
    if (result == TL_OK) {
        result = load_ends(&session, points);
    }
    if (result == TL_OK) {
        result = find_session_route(&session, points, &missing);
    }
    const tl_exit code = answer_route(cli, &session, request, result, missing);
    free(session.points);
    tl_nav_router_destroy(session.router);
    tl_nav_world_destroy(session.world);
    tl_world_reader_close(&session.reader);
    return code;
}
