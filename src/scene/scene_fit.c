// SPDX-License-Identifier: MIT
//
// Refitting the top-level BVH to instances that moved: records and boxes of those that did, then all inner boxes from
// the last node to the first, since children lie behind their parents.
//
// An instance whose pose, scale and box have the same bits as before keeps its record: most things in a game stand
// still in most frames.
//
// The cost is that of the surface area heuristic: a random ray through a box enters one inside it with the probability
// of their surfaces' ratio. Source: Goldsmith, Salmon, Automatic Creation of Object Hierarchies for Ray Tracing, 1987.

#include "scene/scene_fit.h"

#include "base/assert.h"
#include "base/host.h"
#include "scene/instance_box.h"

#include <string.h>

static tl_scene_node *nodes_of(tl_scene *scene)
{
    return (tl_scene_node *)(void *)((char *)scene + scene->nodes);
}

void tl_scene_set_lane(tl_scene *scene, uint32_t lane, tl_aabb box, uint32_t mask)
{
    tl_scene_node *node = &nodes_of(scene)[lane / TL_SCENE_WIDTH];
    uint32_t i = lane % TL_SCENE_WIDTH;
    box = mask != 0 ? box : tl_aabb_empty();
    node->plane[0][i] = box.min.x;
    node->plane[1][i] = box.max.x;
    node->plane[2][i] = box.min.y;
    node->plane[3][i] = box.max.y;
    node->plane[4][i] = box.min.z;
    node->plane[5][i] = box.max.z;
    node->mask[i] = mask;
}

static float min_of_eight(const float *eight)
{
    float a = tl_minf(tl_minf(eight[0], eight[1]), tl_minf(eight[2], eight[3]));
    return tl_minf(a, tl_minf(tl_minf(eight[4], eight[5]), tl_minf(eight[6], eight[7])));
}

static float largest_of_eight(const float *eight)
{
    float a = tl_maxf(tl_maxf(eight[0], eight[1]), tl_maxf(eight[2], eight[3]));
    return tl_maxf(a, tl_maxf(tl_maxf(eight[4], eight[5]), tl_maxf(eight[6], eight[7])));
}

static_assert(TL_SCENE_WIDTH == 16, "lanes of min_of_lanes");

static float min_of_lanes(const float *lanes)
{
    return tl_minf(min_of_eight(lanes), min_of_eight(lanes + 8));
}

static float largest_of_lanes(const float *lanes)
{
    return tl_maxf(largest_of_eight(lanes), largest_of_eight(lanes + 8));
}

// Around all children.
static tl_aabb box_of_children(const tl_scene_node *node, uint32_t *mask_out)
{
    tl_aabb box = { { min_of_lanes(node->plane[0]), min_of_lanes(node->plane[2]), min_of_lanes(node->plane[4]) },
                    { largest_of_lanes(node->plane[1]), largest_of_lanes(node->plane[3]),
                      largest_of_lanes(node->plane[5]) } };
    *mask_out = 0;
    for (uint32_t i = 0; i < TL_SCENE_WIDTH; i++) {
        *mask_out |= node->mask[i];
    }
    return box;
}

// In double: boxes may be 1e12 m wide. Of an empty box 0.
static double half_area_f64(tl_aabb box)
{
    if (tl_aabb_is_empty(box)) {
        return 0.0;
    }
    tl_vec3d size = tl_vec3d_sub(tl_vec3d_from(box.max), tl_vec3d_from(box.min));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

void tl_scene_fit_nodes(tl_scene *scene)
{
    tl_scene_node *nodes = nodes_of(scene);
    double below = 0.0;
    for (uint32_t n = scene->node_count; n-- > 0;) {
        for (uint32_t i = 0; i < TL_SCENE_WIDTH; i++) {
            uint32_t child = nodes[n].child[i], mask;
            if (child != 0 && (child & TL_CHILD_INSTANCE) == 0) {
                tl_aabb box = box_of_children(&nodes[child], &mask);
                tl_scene_set_lane(scene, n * TL_SCENE_WIDTH + i, box, mask);
                below += half_area_f64(box);
            }
        }
    }
    uint32_t all;
    scene->bounds = box_of_children(&nodes[0], &all);
    double whole = half_area_f64(scene->bounds);
    scene->cost = 1.0 + (whole > 0.0 ? below / whole : 0.0);
}

tl_result tl_scene_refuse_instance(tl_report *report, tl_result result, uint32_t instance)
{
    const char *advice = result == TL_ERR_NOT_FINITE ? "make its pose, its scale and its shape's corners finite"
                         : result == TL_ERR_RANGE
                             ? "keep its position and box within TL_MAX_COORDINATE, its scale within TL_MAX_SCALE"
                             : "give it a soup or a shape, with a radius of at least 0, and rounded shapes the "
                               "same scale along all axes";
    return tl_report_fail(report, result, "instance", instance, advice);
}

static bool has_not_moved(const tl_scene_record *record, const tl_scene_place *place, const tl_scene_instance *instance,
                          const tl_aabb *local, uint32_t mask)
{
    tl_vec3 scale = tl_scale_factors(instance->scale);
    return memcmp(&record->pose, &instance->pose, sizeof instance->pose) == 0 &&
           memcmp(&place->scale, &scale, sizeof scale) == 0 && memcmp(&record->local, local, sizeof *local) == 0 &&
           (mask != 0) == (instance->mask != 0);
}

static void refit_instance(tl_scene *scene, uint32_t i, const tl_scene_instance *instance, tl_aabb local)
{
    tl_scene_record *record = &((tl_scene_record *)(void *)((char *)scene + scene->records))[i];
    tl_scene_place *place = &((tl_scene_place *)(void *)((char *)scene + scene->places))[i];
    uint32_t *mask = &nodes_of(scene)[place->lane / TL_SCENE_WIDTH].mask[place->lane % TL_SCENE_WIDTH];
    if (has_not_moved(record, place, instance, &local, *mask)) {
        *mask = instance->mask;
        return;
    }
    tl_aabb box = tl_scene_place_instance(record, place, instance, local);
    tl_scene_set_lane(scene, place->lane, box, instance->mask);
}

tl_result tl_scene_refit(tl_scene *scene, const tl_scene_instance *instances, uint32_t count, float *growth_out,
                         tl_report *report_out)
{
    tl_report_begin(report_out, "refit scene");
    if (growth_out != NULL) {
        *growth_out = 0.0f;
    }
    if (scene == NULL || (instances == NULL && count > 0)) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, scene == NULL ? "scene" : "instances",
                               "give a scene and its instances");
    }
    if (count != scene->instance_count) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "count",
                               "bake the scene anew for another number of instances");
    }
    tl_aabb local;
    for (uint32_t i = 0; i < count; i++) {
        tl_result result = tl_scene_read_instance(&instances[i], &local);
        if (result != TL_OK) {
            return tl_scene_refuse_instance(report_out, result, i);
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        (void)tl_scene_read_instance(&instances[i], &local);
        refit_instance(scene, i, &instances[i], local);
    }
    tl_scene_fit_nodes(scene);
    if (growth_out != NULL) {
        *growth_out = (float)(scene->cost / scene->baked_cost);
    }
    return TL_OK;
}

tl_aabb tl_scene_bounds(const tl_scene *scene)
{
    TL_ASSERT(scene != NULL);
    return scene->bounds;
}

tl_scene_stats tl_scene_get_stats(const tl_scene *scene)
{
    TL_ASSERT(scene != NULL);
    tl_scene_stats stats = { scene->blob.size, scene->instance_count, scene->node_count, scene->depth, scene->cost };
    return stats;
}
