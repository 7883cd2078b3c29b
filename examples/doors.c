// SPDX-License-Identifier: MIT
//
// A guard, a thief, and a door between them: the level, the door and the thief are instances of one scene. The door
// swings open, the scene is refitted, and the guard sees, shoots and walks through the doorway.

#include <talus/scene.h>

#include <stdio.h>

enum { LEVEL, DOOR, THIEF, INSTANCES };
enum { STATIC = 1, DOORS = 2, PEOPLE = 4 };

// Two walls across z = 0 that leave a doorway from x = 0 to x = 1, 2 m high, and a floor, 20 m square.
static const tl_vec3 vertices[12] = { { -10, 0, 0 },  { 0, 0, 0 },   { 0, 2, 0 },    { -10, 2, 0 },
                                      { 1, 0, 0 },    { 10, 0, 0 },  { 10, 2, 0 },   { 1, 2, 0 },
                                      { -10, 0, 10 }, { 10, 0, 10 }, { 10, 0, -10 }, { -10, 0, -10 } };
static const uint32_t indices[18] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 8, 9, 10, 8, 10, 11 };

// Whether the guard sees the thief: the thief does not hide himself, so the query ignores him.
static bool sees(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 eye, tl_vec3 target)
{
    tl_scene_filter filter = { 0 };
    filter.first_ignored = THIEF;
    filter.ignored_count = 1;
    return tl_scene_line_of_sight(scene, instances, eye, target, &filter);
}

int main(void)
{
    tl_mesh_view view = { vertices, 12, indices, 6, NULL };
    tl_soup *level = NULL;
    tl_scene *scene = NULL;
    if (tl_soup_bake(&view, NULL, &level, NULL) != TL_OK) {
        return 1;
    }
    // The door hangs at its hinge, which is its own origin.
    tl_convex door = tl_convex_box(tl_vec3_make(0.5f, 1, 0), tl_vec3_make(0.5f, 1, 0.03f), 0);
    tl_convex body = tl_convex_capsule(tl_vec3_make(0, 0.3f, 0), tl_vec3_make(0, 1.5f, 0), 0.3f);
    tl_scene_instance instances[INSTANCES] = { { .soup = level, .mask = STATIC },
                                               { .shape = &door, .mask = DOORS },
                                               { .shape = &body, .mask = PEOPLE } };
    instances[THIEF].pose.position = tl_vec3_make(0.5f, 0, 4);
    if (tl_scene_bake(instances, INSTANCES, NULL, &scene, NULL) != TL_OK) {
        return 1;
    }
    tl_vec3 eye = tl_vec3_make(0.5f, 1.6f, -4), chest = tl_vec3_make(0.5f, 1.2f, 4);
    bool before = sees(scene, instances, eye, chest);
    printf("door shut: the guard %s the thief\n", before ? "sees" : "does not see");

    // A quarter turn about y, and a bit more.
    tl_quat open = { 0, 0.75f, 0, 0.66f };
    instances[DOOR].pose.rotation = open;
    if (tl_scene_refit(scene, instances, INSTANCES, NULL, NULL) != TL_OK) {
        return 1;
    }
    bool after = sees(scene, instances, eye, chest);
    printf("door open: the guard %s the thief\n", after ? "sees" : "does not see");

    tl_ray shot = { eye, tl_sub(chest, eye), INFINITY };
    tl_scene_hit hit;
    if (!tl_scene_cast_ray(scene, instances, &shot, NULL, &hit)) {
        return 1;
    }
    printf("a shot hits instance %u after %.2f of the way\n", hit.instance, (double)hit.hit.t);

    tl_transform guard = tl_transform_identity();
    guard.position = tl_vec3_make(0.5f, 0, -4);
    tl_scene_shape_hit met;
    if (tl_scene_cast_shape(scene, instances, &body, guard, tl_vec3_make(0, 0, 10), NULL, &met) != TL_OK) {
        return 1;
    }
    printf("the guard runs into instance %u after %.2f m\n", met.instance, 10 * (double)met.hit.t);

    tl_blob_free(scene);
    tl_blob_free(level);
    bool right = !before && after && hit.instance == THIEF && met.instance == THIEF && fabsf(met.hit.t - 0.74f) < 1e-4f;
    return right ? 0 : 1;
}
