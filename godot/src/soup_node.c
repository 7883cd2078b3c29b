// SPDX-License-Identifier: MIT
//
// TalusSoup3D: what a ray hits, and what can be seen, in a level's triangles.

#include "classes.h"

#include <stdlib.h>

typedef struct soup_node {
    tl_soup *soup; ///< NULL: not baked
} soup_node;

static void begin(void *at)
{
    (void)at;
}

static void end(void *at)
{
    tl_blob_free(((soup_node *)at)->soup);
}

static void bake(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method;
    soup_node *node = at;
    tl_blob_free(node->soup);
    node->soup = NULL;
    gd_faces faces;
    const char *wrong = gd_faces_of(arguments[0], &faces);
    if (wrong != NULL) {
        gd_string_make(result, wrong);
        return;
    }
    tl_soup_report report = { 0 };
    const tl_result baked = tl_soup_bake(&faces.view, NULL, &node->soup, &report);
    free(faces.indices);
    if (baked == TL_OK) {
        gd_string_make(result, "");
    } else {
        gd_failure_make(result, baked, &report.base);
    }
}

static tl_vec3 vector_of(const void *argument)
{
    return *(const tl_vec3 *)argument;
}

// As PhysicsDirectSpaceState3D.intersect_ray: an empty dictionary where nothing is hit.
static void cast_ray(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method;
    const soup_node *node = at;
    const tl_vec3 from = vector_of(arguments[0]), to = vector_of(arguments[1]);
    gd_make(result, GD_DICTIONARY);
    tl_ray_hit hit;
    if (node->soup != NULL && tl_soup_cast_segment(node->soup, from, to, NULL, &hit)) {
        gd_dictionary_set(result, "position", GD_VECTOR3, &(gd_value){ .vector = tl_lerp(from, to, hit.t) });
        gd_dictionary_set(result, "normal", GD_VECTOR3, &(gd_value){ .vector = hit.normal });
        gd_dictionary_set(result, "face_index", GD_INT, &(gd_value){ .integer = hit.triangle });
        gd_dictionary_set(result, "back", GD_BOOL, &(gd_value){ .boolean = hit.back });
    }
}

static void can_see(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method;
    const soup_node *node = at;
    const tl_vec3 from = vector_of(arguments[0]), to = vector_of(arguments[1]);
    *(gd_bool *)result = node->soup == NULL || tl_soup_line_of_sight(node->soup, from, to, NULL);
}

static void is_baked(void *at, const gd_method *method, const void *const *arguments, void *result)
{
    (void)method, (void)arguments;
    *(gd_bool *)result = ((const soup_node *)at)->soup != NULL;
}

static const gd_method methods[] = {
    { .name = "bake",
      .run = bake,
      .result = GD_STRING,
      .argument_count = 1,
      .arguments = { GD_PACKED_VECTOR3_ARRAY },
      .names = { "faces" } },
    { .name = "cast_ray",
      .run = cast_ray,
      .result = GD_DICTIONARY,
      .argument_count = 2,
      .arguments = { GD_VECTOR3, GD_VECTOR3 },
      .names = { "from", "to" } },
    { .name = "can_see",
      .run = can_see,
      .result = GD_BOOL,
      .argument_count = 2,
      .arguments = { GD_VECTOR3, GD_VECTOR3 },
      .names = { "from", "to" } },
    { .name = "is_baked", .run = is_baked, .result = GD_BOOL },
};

const gd_class gd_soup_class = {
    .name = "TalusSoup3D",
    .parent = "Node3D",
    .size = sizeof(soup_node),
    .begin = begin,
    .end = end,
    .methods = methods,
    .method_count = GD_COUNT(methods),
};
