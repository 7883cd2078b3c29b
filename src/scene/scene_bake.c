// SPDX-License-Identifier: MIT
//
// The top-level BVH (TLAS) over the boxes of the instances: built from the top down by the surface area heuristic with
// bins of centroids, sixteen children a node.
//
// A node's range of instances is split, and of its parts the one with the largest surface again, until there are
// sixteen, or none holds more than sixteen instances. Parts that fit into the free lanes are put there instance by
// instance. So the last four levels of a binary tree, half of its work, are never built, and nodes are full: a visit
// costs the same for two boxes as for sixteen.
//
// Below a depth that costs never reach in practice the largest part is halved instead, which bounds a walk's stack for
// any instances.
//
// Sources: MacDonald, Booth, Heuristics for Ray Tracing Using Space Subdivision, 1990 (SAH); Wald, On fast Construction
// of SAH-based Bounding Volume Hierarchies, 2007 (binning).

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "math/box4.h"
#include "scene/instance_box.h"
#include "scene/scene_fit.h"

#include <string.h>

// Fewer bins for few instances: bins are most of the work of a small split.
enum { INSTANCE_BINS = 16, FEW_INSTANCE_BINS = 8, FEW_INSTANCES = 64, AXES = 3 };

// An instance's box and index: two rows of four, so that a box is loaded as two vectors.
typedef struct instance_ref {
    float min[3];
    uint32_t instance;
    float max[3];
    uint32_t zero;
} instance_ref;

// Instances [begin, end) of the refs.
typedef struct instance_range {
    uint32_t begin, end;
    float half_area;
} instance_range;

// A node being built: its range, and then its children.
typedef struct scene_build_node {
    uint32_t begin, end, depth;
    uint32_t child[TL_SCENE_WIDTH];
} scene_build_node;

typedef struct scene_build {
    instance_ref *refs;
    tl_scene_record *records;
    tl_scene_place *places;
    scene_build_node *nodes;
    uint32_t node_count, depth;
} scene_build;

static tl_box4 load(const instance_ref *ref)
{
    return tl_box4_load(ref->min, ref->max);
}

static float box4_half_area(tl_box4 box)
{
    return tl_aabb_half_area(tl_box4_to_aabb(box));
}

typedef struct bins {
    tl_box4 box[AXES][INSTANCE_BINS];
    uint32_t count[AXES][INSTANCE_BINS];
    float base[4], scale[4]; // of doubled centroids
    uint32_t used;           // bins of each axis
} bins;

// Where a range is cut: instances whose bin along the axis is below `bin` go to the left.
typedef struct bin_cut {
    uint32_t axis, bin; // bin 0: no cut
    float half_areas[2];
    float cost;
} bin_cut;

static void fill_instance_bins(const scene_build *b, const instance_range *range, bins *s)
{
    tl_box4 centroids = tl_box4_empty();
    for (uint32_t i = range->begin; i < range->end; i++) {
        centroids = tl_box4_union(centroids, tl_box4_middle(load(&b->refs[i])));
    }
    tl_aabb spread = tl_box4_to_aabb(centroids);
    tl_vec3 size = tl_aabb_size(spread);
    const float low[3] = { spread.min.x, spread.min.y, spread.min.z }, width[3] = { size.x, size.y, size.z };
    memset(s->count, 0, sizeof s->count);
    s->used = range->end - range->begin < FEW_INSTANCES ? FEW_INSTANCE_BINS : INSTANCE_BINS;
    for (uint32_t axis = 0; axis < AXES; axis++) {
        s->base[axis] = low[axis];
        s->scale[axis] = width[axis] > 0.0f ? (float)s->used / width[axis] : 0.0f;
        for (uint32_t k = 0; k < s->used; k++) {
            s->box[axis][k] = tl_box4_empty();
        }
    }
    s->base[3] = s->scale[3] = 0.0f;
    for (uint32_t i = range->begin; i < range->end; i++) {
        tl_box4 box = load(&b->refs[i]);
        int32_t cells[4];
        tl_box4_cells(tl_box4_middle(box), s->base, s->scale, (float)(s->used - 1), cells);
        for (uint32_t axis = 0; axis < AXES; axis++) {
            s->box[axis][cells[axis]] = tl_box4_union(s->box[axis][cells[axis]], box);
            s->count[axis][cells[axis]]++;
        }
    }
}

static void try_axis(const bins *s, uint32_t axis, uint32_t total, bin_cut *best)
{
    float right_area[INSTANCE_BINS];
    tl_box4 box = tl_box4_empty();
    for (uint32_t k = s->used; k-- > 1;) {
        box = tl_box4_union(box, s->box[axis][k]);
        right_area[k] = box4_half_area(box);
    }
    box = tl_box4_empty();
    uint32_t left = 0;
    for (uint32_t k = 1; k < s->used; k++) {
        box = tl_box4_union(box, s->box[axis][k - 1]);
        left += s->count[axis][k - 1];
        if (left == 0 || left == total) {
            continue;
        }
        float left_area = box4_half_area(box);
        float cost = left_area * (float)left + right_area[k] * (float)(total - left);
        if (cost < best->cost) {
            bin_cut better = { axis, k, { left_area, right_area[k] }, cost };
            *best = better;
        }
    }
}

// Puts the instances below the cut first; returns where the others begin.
static uint32_t part(const scene_build *b, const instance_range *range, const bins *s, const bin_cut *c)
{
    uint32_t low = range->begin, high = range->end;
    while (low < high) {
        int32_t cells[4];
        tl_box4_cells(tl_box4_middle(load(&b->refs[low])), s->base, s->scale, (float)(s->used - 1), cells);
        if ((uint32_t)cells[c->axis] < c->bin) {
            low++;
        } else {
            instance_ref ref = b->refs[low];
            b->refs[low] = b->refs[--high];
            b->refs[high] = ref;
        }
    }
    return low;
}

// Halves a range by count: for instances in one place, and for trees that got too deep.
static void halve(instance_range *range, instance_range *other)
{
    other->begin = range->begin + (range->end - range->begin) / 2;
    other->end = range->end;
    other->half_area = range->half_area;
    range->end = other->begin;
}

// Splits a range of at least two instances in two.
static void split_range(const scene_build *b, instance_range *range, instance_range *other)
{
    bins s;
    fill_instance_bins(b, range, &s);
    bin_cut best = { 0, 0, { 0.0f, 0.0f }, INFINITY };
    for (uint32_t axis = 0; axis < AXES; axis++) {
        if (s.scale[axis] > 0.0f) {
            try_axis(&s, axis, range->end - range->begin, &best);
        }
    }
    if (best.bin == 0) {
        halve(range, other);
        return;
    }
    other->begin = part(b, range, &s, &best);
    other->end = range->end;
    other->half_area = best.half_areas[1];
    range->end = other->begin;
    range->half_area = best.half_areas[0];
}

// The part with the largest surface (or, not by cost, the most instances) of those that hold `min_size` to `max_size`
// instances; `count` when there is none.
static uint32_t choose_part(const instance_range *parts, uint32_t count, uint32_t min_size, uint32_t max_size,
                            bool by_cost)
{
    uint32_t chosen = count;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t size = parts[i].end - parts[i].begin;
        if (size < min_size || size > max_size) {
            continue;
        }
        bool larger = chosen == count || (by_cost ? parts[i].half_area > parts[chosen].half_area
                                                  : size > parts[chosen].end - parts[chosen].begin);
        chosen = larger ? i : chosen;
    }
    return chosen;
}

// Makes each instance of a part a part of its own; returns how many parts there are now.
static uint32_t dissolve(instance_range *parts, uint32_t count, uint32_t chosen)
{
    instance_range whole = parts[chosen];
    parts[chosen].end = whole.begin + 1;
    for (uint32_t i = whole.begin + 1; i < whole.end; i++) {
        instance_range one = { i, i + 1, 0.0f };
        parts[count++] = one;
    }
    return count;
}

// The children of a node.
static uint32_t part_node(const scene_build *b, const scene_build_node *node, instance_range parts[TL_SCENE_WIDTH])
{
    instance_range whole = { node->begin, node->end, 0.0f };
    parts[0] = whole;
    uint32_t count = node->end > node->begin;
    bool by_cost = node->depth < TL_SCENE_COST_DEPTH;
    uint32_t chosen;
    while (count < TL_SCENE_WIDTH &&
           (chosen = choose_part(parts, count, TL_SCENE_WIDTH + 1, UINT32_MAX, by_cost)) < count) {
        if (by_cost) {
            split_range(b, &parts[chosen], &parts[count]);
        } else {
            halve(&parts[chosen], &parts[count]);
        }
        count++;
    }
    while ((chosen = choose_part(parts, count, 2, TL_SCENE_WIDTH + 1 - count, true)) < count) {
        count = dissolve(parts, count, chosen);
    }
    return count;
}

// Nodes are built breadth first: those not built yet are at the end of the list.
static void build_tree(scene_build *b, uint32_t instance_count)
{
    memset(&b->nodes[0], 0, sizeof b->nodes[0]);
    b->nodes[0].end = instance_count;
    b->nodes[0].depth = 1;
    b->node_count = 1;
    for (uint32_t n = 0; n < b->node_count; n++) {
        scene_build_node *node = &b->nodes[n];
        instance_range parts[TL_SCENE_WIDTH];
        uint32_t count = part_node(b, node, parts);
        b->depth = node->depth;
        for (uint32_t i = 0; i < count; i++) {
            if (parts[i].end - parts[i].begin == 1) {
                uint32_t instance = b->refs[parts[i].begin].instance;
                node->child[i] = TL_CHILD_INSTANCE | instance;
                b->places[instance].lane = n * TL_SCENE_WIDTH + i;
                continue;
            }
            scene_build_node *below = &b->nodes[b->node_count];
            memset(below, 0, sizeof *below);
            below->begin = parts[i].begin;
            below->end = parts[i].end;
            below->depth = node->depth + 1;
            node->child[i] = b->node_count++;
        }
    }
}

static tl_result read_instances(scene_build *b, const tl_scene_instance *instances, uint32_t count, tl_report *report)
{
    for (uint32_t i = 0; i < count; i++) {
        tl_aabb local;
        tl_result result = tl_scene_read_instance(&instances[i], &local);
        if (result != TL_OK) {
            return tl_scene_refuse_instance(report, result, i);
        }
        tl_aabb box = tl_scene_place_instance(&b->records[i], &b->places[i], &instances[i], local);
        if (tl_aabb_is_empty(box)) { // it may come back, at its position
            box.min = box.max = instances[i].pose.position;
        }
        instance_ref ref = { { box.min.x, box.min.y, box.min.z }, i, { box.max.x, box.max.y, box.max.z }, 0 };
        b->refs[i] = ref;
    }
    return TL_OK;
}

static tl_result encode_scene(const scene_build *b, const tl_scene_instance *instances, uint32_t count,
                              const tl_allocator *allocator, tl_scene **scene_out)
{
    uint64_t records = (sizeof(tl_scene) + 63) / 64 * 64;
    uint64_t nodes = (records + (uint64_t)count * sizeof(tl_scene_record) + 63) / 64 * 64;
    uint64_t places = nodes + (uint64_t)b->node_count * sizeof(tl_scene_node);
    uint64_t size = places + (uint64_t)count * sizeof(tl_scene_place);
    tl_scene *scene = tl_blob_allocate(allocator, TL_SCENE_MAGIC, TL_SCENE_VERSION, size);
    if (scene == NULL) {
        return TL_ERR_MEMORY;
    }
    scene->instance_count = count;
    scene->node_count = b->node_count;
    scene->depth = b->depth;
    scene->records = records;
    scene->nodes = nodes;
    scene->places = places;
    if (count > 0) {
        memcpy((char *)scene + records, b->records, (size_t)count * sizeof *b->records);
        memcpy((char *)scene + places, b->places, (size_t)count * sizeof *b->places);
    }
    tl_scene_node *out = (tl_scene_node *)(void *)((char *)scene + nodes);
    for (uint32_t n = 0; n < b->node_count; n++) {
        memcpy(out[n].child, b->nodes[n].child, sizeof out[n].child);
        for (uint32_t i = 0; i < TL_SCENE_WIDTH; i++) {
            tl_scene_set_lane(scene, n * TL_SCENE_WIDTH + i, tl_aabb_empty(), 0);
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        const instance_ref *ref = &b->refs[i];
        tl_aabb box = { { ref->min[0], ref->min[1], ref->min[2] }, { ref->max[0], ref->max[1], ref->max[2] } };
        box = tl_aabb_is_empty(b->records[ref->instance].local) ? tl_aabb_empty() : box;
        tl_scene_set_lane(scene, b->places[ref->instance].lane, box, instances[ref->instance].mask);
    }
    tl_scene_fit_nodes(scene);
    scene->baked_cost = scene->cost;
    *scene_out = scene;
    return TL_OK;
}

tl_result tl_scene_bake(const tl_scene_instance *instances, uint32_t count, const tl_host *host, tl_scene **scene_out,
                        tl_report *report_out)
{
    tl_report_begin(report_out, "bake scene");
    if (scene_out == NULL) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "scene_out", "give a place for the scene");
    }
    *scene_out = NULL;
    if (instances == NULL && count > 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "instances", "give the instances");
    }
    if (count > TL_MAX_SCENE_INSTANCES) {
        return tl_report_fail(report_out, TL_ERR_LIMIT, "instance", TL_MAX_SCENE_INSTANCES, "make several scenes");
    }
    const tl_allocator *allocator = host != NULL ? host->allocator : NULL;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    // By induction a range of s >= 2 instances takes s / 2 + (s - 2) / 30 nodes at most: the worst are sixteen parts of
    // two.
    uint64_t max_nodes = (uint64_t)count / 2 + count / 30 + 1;
    scene_build b = { TL_PUSH(&arena, instance_ref, count),
                      TL_PUSH(&arena, tl_scene_record, count),
                      TL_PUSH(&arena, tl_scene_place, count),
                      TL_PUSH(&arena, scene_build_node, max_nodes),
                      0,
                      0 };
    tl_result result = TL_ERR_MEMORY;
    if (b.refs != NULL && b.records != NULL && b.places != NULL && b.nodes != NULL) {
        result = read_instances(&b, instances, count, report_out);
    }
    if (result == TL_OK) {
        build_tree(&b, count);
        result = encode_scene(&b, instances, count, allocator, scene_out);
    }
    if (report_out != NULL) {
        report_out->peak_bytes = arena.peak_bytes + (*scene_out != NULL ? (*scene_out)->blob.size : 0);
    }
    tl_arena_free(&arena);
    return result;
}
