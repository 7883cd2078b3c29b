// SPDX-License-Identifier: MIT
//
// TalusNavmesh3D: bakes where an agent can walk, and finds the shortest path.

#include "classes.h"

#include <stdlib.h>

typedef struct navmesh_node {
    tl_nav_def def;
    tl_vec3 extents;
    tl_navmesh *navmesh; ///< NULL: not baked
    tl_nav_query *query;
    const char *status; ///< static; of the last search
} navmesh_node;

static void begin(void *at)
{
    navmesh_node *node = at;
    node->def = tl_default_nav_def();
    node->extents = (tl_vec3){ 1, 2, 1 };
    node->status = "not baked";
}

static void forget(navmesh_node *node)
{
    tl_nav_query_destroy(node->query);
    tl_navmesh_destroy(node->navmesh);
    node->query = NULL;
    node->navmesh = NULL;
    node->status = "not baked";
}

static void end(void *at)
{
    forget(at);
}

static tl_result take_tiles(navmesh_node *node, tl_nav_tiles *tiles, tl_report *report)
{
    tl_result result = tl_navmesh_create(NULL, &node->navmesh);
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(node->navmesh, tiles->tiles, tiles->tile_count, TL_NAV_TILE_OWNED, report);
    }
    for (uint32_t i = 0; result == TL_OK && i < tiles->tile_count; i++) {
        tiles->tiles[i] = NULL; // they are the navmesh's now
    }
    tl_nav_query_def def = tl_default_nav_query_def();
    def.max_nodes = 1u << 30; // memory grows with need: no search is too large
    return result == TL_OK ? tl_nav_query_create(&def, &node->query, report) : result;
}

static void bake(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method;
    navmesh_node *node = at;
    forget(node);
    gd_faces faces;
    const char *wrong = gd_faces_of(arguments[0], &faces);
    if (wrong != NULL) {
        gd_string_make(result, wrong);
        return;
    }
    const tl_nav_input input = { .mesh = faces.view };
    tl_nav_tiles tiles = { 0 };
    tl_nav_bake_report report = { 0 };
    tl_result baked = tl_nav_bake(&node->def, &input, &tiles, &report);
    if (baked == TL_OK) {
        baked = take_tiles(node, &tiles, &report.base);
    }
    tl_nav_tiles_free(&tiles);
    free(faces.indices);
    if (baked == TL_OK) {
        node->status = "none";
        gd_string_make(result, "");
    } else {
        forget(node);
        gd_failure_make(result, baked, &report.base);
    }
}

// The corners of the shortest path in a block that the caller frees; NULL: there is none, and the status says why.
static tl_nav_corner *search(navmesh_node *node, const tl_nav_path_request *request, uint32_t *count)
{
    uint32_t capacity = 64;
    for (;;) {
        tl_nav_corner *corners = malloc(capacity * sizeof *corners);
        if (corners == NULL) {
            node->status = "out of memory";
            return NULL;
        }
        const tl_nav_path_buffers buffers = { .corners = corners, .corner_capacity = capacity };
        tl_nav_shortest_path path = { 0 };
        const tl_result result = tl_nav_query_find_shortest_path(node->query, node->navmesh, request, &buffers, &path);
        if (result == TL_OK && path.status == TL_NAV_PATH_COMPLETE) {
            node->status = tl_nav_path_status_name(path.status);
            *count = path.corner_count;
            return corners;
        }
        free(corners);
        if (result != TL_INCOMPLETE) {
            node->status = result == TL_OK ? tl_nav_path_status_name(path.status) : tl_result_text(result);
            return NULL;
        }
        capacity = path.corner_count;
    }
}

static bool locate(navmesh_node *node, const tl_vec3 *point, const char *missing, tl_nav_location *location)
{
    const tl_result result = tl_navmesh_find_nearest(node->navmesh, NULL, *point, node->extents, location);
    if (result != TL_OK) {
        node->status = result == TL_NOT_FOUND ? missing : tl_result_text(result);
    }
    return result == TL_OK;
}

static void find_path(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method;
    navmesh_node *node = at;
    tl_nav_path_request request = { 0 };
    tl_nav_corner *corners = NULL;
    uint32_t count = 0;
    if (node->navmesh != NULL && locate(node, arguments[0], "no floor near the start", &request.start) &&
        locate(node, arguments[1], "no floor near the goal", &request.goal)) {
        corners = search(node, &request, &count);
    }
    tl_vec3 *points = corners != NULL ? malloc(count * sizeof *points) : NULL;
    if (corners != NULL && points == NULL) {
        node->status = "out of memory";
    }
    for (uint32_t i = 0; points != NULL && i < count; i++) {
        points[i] = corners[i].point;
    }
    if (!gd_array_make(result, points, points != NULL ? count : 0)) {
        node->status = "out of memory";
    }
    free(points);
    free(corners);
}

static void get_status(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method, (void)arguments;
    gd_string_make(result, ((const navmesh_node *)at)->status);
}

static void is_baked(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method, (void)arguments;
    *(gd_bool *)result = ((const navmesh_node *)at)->navmesh != NULL;
}

#define PROPERTY(field)                                                                                                \
    { .name = "get_" #field, .run = gd_get_float, .result = GD_FLOAT, .offset = offsetof(navmesh_node, def.field) },   \
    {                                                                                                                  \
        .name = "set_" #field, .run = gd_set_float, .argument_count = 1, .arguments = { GD_FLOAT },                    \
        .names = { #field }, .offset = offsetof(navmesh_node, def.field)                                               \
    }
#define NAMES(field)                                                                                                   \
    {                                                                                                                  \
#field, "get_" #field, "set_" #field                                                                           \
    }

static const gd_method methods[] = {
    { .name = "bake",
      .run = bake,
      .result = GD_STRING,
      .argument_count = 1,
      .arguments = { GD_PACKED_VECTOR3_ARRAY },
      .names = { "faces" } },
    { .name = "find_path",
      .run = find_path,
      .result = GD_PACKED_VECTOR3_ARRAY,
      .argument_count = 2,
      .arguments = { GD_VECTOR3, GD_VECTOR3 },
      .names = { "start", "goal" } },
    { .name = "get_status", .run = get_status, .result = GD_STRING },
    { .name = "is_baked", .run = is_baked, .result = GD_BOOL },
    PROPERTY(cell_size),
    PROPERTY(cell_height),
    PROPERTY(agent_height),
    PROPERTY(agent_radius),
    PROPERTY(agent_max_climb),
    PROPERTY(agent_max_slope),
};

static const gd_property properties[] = {
    NAMES(cell_size),    NAMES(cell_height),     NAMES(agent_height),
    NAMES(agent_radius), NAMES(agent_max_climb), NAMES(agent_max_slope),
};

const gd_class gd_navmesh_class = {
    .name = "TalusNavmesh3D",
    .parent = "Node3D",
    .size = sizeof(navmesh_node),
    .begin = begin,
    .end = end,
    .methods = methods,
    .method_count = GD_COUNT(methods),
    .properties = properties,
    .property_count = GD_COUNT(properties),
};
