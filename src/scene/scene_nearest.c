// SPDX-License-Identifier: MIT
//
// The nearest point of a scene: best-first traversal of the top-level BVH, boxes pruned by the best distance so far.
//
// A soup gets the best distance as its limit, one rounding up: what it reports is rounded, and of equal distances the
// lower instance wins, whichever was queried first.

#include "base/lowest_bit.h"
#include "math/tolerance.h"
#include "scene/scene_layout.h"

#include <float.h>
#include <string.h>

// A distance to a box in float, squared: a difference, a square and two sums, each rounded, and a share to spare for
// the limit's own rounding.
#define INSTANCE_KEY_SHRINK (1.0f - TL_FLOAT_GAMMA(8))

// In an instance's space the point is off by this share of its coordinates (instance_box.c has the instance's part).
#define INSTANCE_POINT_ERROR TL_FLOAT_GAMMA(4)

typedef struct scene_nearest_search {
    const tl_scene *scene;
    const tl_scene_instance *instances;
    const tl_scene_record *records;
    const tl_scene_place *places;
    const tl_scene_filter *filter;
    tl_vec3 at;
    float error; // metres
    float max_distance;
    float limit;     // metres: what is farther away does not count
    float limit_key; // its square, rounded up
    tl_soup_point best;
    uint32_t instance; // TL_NO_INSTANCE: none yet
} scene_nearest_search;

static void set_scene_limit(scene_nearest_search *s, float distance)
{
    s->limit = distance;
    s->limit_key = distance * distance * (1.0f + TL_FLOAT_GAMMA(2)) + FLT_MIN;
}

// Lower bounds of the squared distances to sixteen boxes.
static void measure_boxes(const scene_nearest_search *s, const tl_scene_node *node, float keys[TL_SCENE_WIDTH])
{
    for (uint32_t i = 0; i < TL_SCENE_WIDTH; i++) {
        float x = tl_maxf(node->plane[0][i] - s->at.x, s->at.x - node->plane[1][i]) - s->error;
        float y = tl_maxf(node->plane[2][i] - s->at.y, s->at.y - node->plane[3][i]) - s->error;
        float z = tl_maxf(node->plane[4][i] - s->at.z, s->at.z - node->plane[5][i]) - s->error;
        x = tl_maxf(x, 0.0f);
        y = tl_maxf(y, 0.0f);
        z = tl_maxf(z, 0.0f);
        keys[i] = (x * x + y * y + z * z) * INSTANCE_KEY_SHRINK;
    }
}

static bool ask_soup(const scene_nearest_search *s, uint32_t instance, tl_soup_point *found)
{
    tl_scene_record room;
    const tl_scene_record *record = tl_scene_rigid(&s->records[instance], &room);
    const tl_scaled_soup soup = tl_scene_soup(&s->places[instance], s->instances[instance].soup);
    float reach = tl_minf(nextafterf(s->limit, INFINITY), s->max_distance);
    return tl_scaled_soup_nearest(&soup, tl_scene_point_to_instance(record, s->at), reach,
                                  tl_scene_triangles(s->filter), found) == TL_OK;
}

static bool ask_shape(const scene_nearest_search *s, uint32_t instance, tl_soup_point *found)
{
    tl_convex point = tl_convex_sphere(s->at, 0.0f);
    tl_separation apart;
    tl_scaled_convex room;
    const tl_convex *shape = tl_scene_shape(&s->places[instance], s->instances[instance].shape, &room);
    tl_convex_distance(shape, s->records[instance].pose, &point, tl_transform_identity(), NULL, &apart);
    memset(found, 0, sizeof *found);
    found->point = apart.overlap ? s->at : apart.point_a;
    found->distance = apart.distance;
    found->normal = apart.normal;
    found->triangle = TL_NO_TRIANGLE;
    return apart.distance <= s->limit;
}

static void visit_instance(scene_nearest_search *s, uint32_t instance)
{
    const tl_scene_instance *it = &s->instances[instance];
    if ((it->soup == NULL && it->shape == NULL) || !tl_scene_accepts(s->filter, instance)) {
        return;
    }
    tl_soup_point found;
    if (!(it->soup != NULL ? ask_soup(s, instance, &found) : ask_shape(s, instance, &found))) {
        return;
    }
    if (s->instance == TL_NO_INSTANCE || found.distance < s->best.distance ||
        (found.distance == s->best.distance && instance < s->instance)) {
        s->best = found;
        s->instance = instance;
        set_scene_limit(s, found.distance);
    }
}

// Children on the stack, nearest on top: the key's bits above the child word.
static uint32_t enter_scene_node(const scene_nearest_search *s, const tl_scene_node *node, uint64_t *stack,
                                 uint32_t count)
{
    uint64_t *base = stack + count;
    uint32_t added = 0, mask = tl_scene_mask(s->filter);
    float keys[TL_SCENE_WIDTH];
    measure_boxes(s, node, keys);
    for (uint32_t lane = 0; lane < TL_SCENE_WIDTH; lane++) {
        bool is_empty = node->plane[0][lane] > node->plane[1][lane];
        if (is_empty || (node->mask[lane] & mask) == 0 || !(keys[lane] <= s->limit_key)) {
            continue;
        }
        uint32_t bits;
        memcpy(&bits, &keys[lane], sizeof bits);
        uint64_t entry = (uint64_t)bits << 32 | node->child[lane];
        uint32_t place = added++;
        for (; place > 0 && base[place - 1] < entry; place--) {
            base[place] = base[place - 1];
        }
        base[place] = entry;
    }
    return count + added;
}

static void walk_nearest(scene_nearest_search *s)
{
    uint64_t stack[TL_SCENE_STACK_SIZE];
    uint32_t count = enter_scene_node(s, tl_scene_nodes(s->scene), stack, 0);
    while (count > 0) {
        uint64_t entry = stack[--count];
        uint32_t bits = (uint32_t)(entry >> 32), child = (uint32_t)entry;
        float key;
        memcpy(&key, &bits, sizeof key);
        if (!(key <= s->limit_key)) {
            continue;
        }
        if ((child & TL_CHILD_INSTANCE) != 0) {
            visit_instance(s, child & ~TL_CHILD_INSTANCE);
        } else {
            count = enter_scene_node(s, &tl_scene_nodes(s->scene)[child], stack, count);
        }
    }
}

tl_result tl_scene_nearest(const tl_scene *scene, const tl_scene_instance *instances, tl_vec3 point, float max_distance,
                           const tl_scene_filter *filter, tl_scene_point *nearest_out)
{
    if (nearest_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(nearest_out, 0, sizeof *nearest_out);
    if (!tl_scene_has_instances(scene, instances)) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_is_finite(point)) {
        return TL_ERR_NOT_FINITE;
    }
    if (!(max_distance >= 0.0f)) {
        return TL_ERR_ARGUMENT;
    }
    scene_nearest_search s = {
        .scene = scene, .instances = instances, .filter = filter, .at = point, .instance = TL_NO_INSTANCE
    };
    s.max_distance = max_distance;
    s.records = tl_scene_records(scene);
    s.places = tl_scene_places(scene);
    s.error = (fabsf(point.x) + fabsf(point.y) + fabsf(point.z)) * INSTANCE_POINT_ERROR + FLT_MIN;
    set_scene_limit(&s, max_distance);
    walk_nearest(&s);
    if (s.instance == TL_NO_INSTANCE) {
        return TL_NOT_FOUND;
    }
    if (instances[s.instance].soup != NULL) {
        tl_scene_record room;
        const tl_scene_record *record = tl_scene_rigid(&s.records[s.instance], &room);
        s.best.point = tl_scene_point_to_world(record, s.best.point);
        s.best.normal = tl_scene_normal_to_world(record, s.best.normal);
    }
    nearest_out->point = s.best;
    nearest_out->instance = s.instance;
    return TL_OK;
}
