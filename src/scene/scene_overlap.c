// SPDX-License-Identifier: MIT
//
// What a shape touches in a scene: a line of zero length, with the shape's half extents around it.
//
// A soup writes its triangles straight into the caller's buffer: indices go into the rear half of the free part, and
// are then spread to the front. Place k is written up to word 2 k + 1, and the next index to be read is word capacity +
// k + 1, behind it.

#include "base/assert.h"
#include "scene/moved_shape.h"

#include <string.h>

typedef struct scene_overlap_search {
    const tl_scene_instance *instances;
    const tl_scene_record *records;
    const tl_scene_place *places;
    const tl_scene_filter *filter;
    const tl_moved_shape *shape;
    tl_scene_overlap *overlaps;
    uint32_t capacity, count;
} scene_overlap_search;

static_assert(sizeof(tl_scene_overlap) == 2 * sizeof(uint32_t), "an overlap is two words");

static bool touches_shape(const scene_overlap_search *s, uint32_t instance)
{
    tl_scaled_convex room;
    const tl_convex *shape = tl_scene_shape(&s->places[instance], s->instances[instance].shape, &room);
    return tl_convex_overlap(shape, s->records[instance].pose, s->shape->convex, s->shape->pose, NULL);
}

// The query's shape in the frame of an instance whose soup is asked at its scale.
static tl_transform pose_at_soup(const scene_overlap_search *s, uint32_t instance)
{
    tl_scene_record room;
    return tl_scene_pose_to_instance(tl_scene_rigid(&s->records[instance], &room), s->shape->pose);
}

static void spread_indices(tl_scene_overlap *free_part, uint32_t free_count, uint32_t count, uint32_t instance)
{
    const char *indices = (const char *)free_part + (size_t)free_count * sizeof(uint32_t);
    for (uint32_t k = 0; k < count; k++) {
        tl_scene_overlap overlap = { instance, 0 };
        memcpy(&overlap.triangle, indices + k * sizeof(uint32_t), sizeof overlap.triangle);
        free_part[k] = overlap;
    }
}

static void add_soup(scene_overlap_search *s, uint32_t instance)
{
    uint32_t free_count = s->count < s->capacity ? s->capacity - s->count : 0, count = 0;
    tl_scene_overlap *free_part = free_count > 0 ? s->overlaps + s->count : NULL;
    uint32_t *indices = free_count > 0 ? (uint32_t *)(void *)free_part + free_count : NULL;
    const tl_scaled_soup soup = tl_scene_soup(&s->places[instance], s->instances[instance].soup);
    tl_result result = tl_scaled_soup_find_overlaps(&soup, s->shape->convex, pose_at_soup(s, instance),
                                                    tl_scene_triangles(s->filter), indices, free_count, &count);
    if (result == TL_OK || result == TL_INCOMPLETE) {
        if (free_part != NULL) {
            spread_indices(free_part, free_count, count < free_count ? count : free_count, instance);
        }
        s->count = count > UINT32_MAX - s->count ? UINT32_MAX : s->count + count;
    }
}

static bool visit_all(tl_scene_line *line, uint32_t instance)
{
    scene_overlap_search *s = line->user;
    if (!tl_scene_accepts(s->filter, instance)) {
        return true;
    }
    if (s->instances[instance].soup != NULL) {
        add_soup(s, instance);
    } else if (s->instances[instance].shape != NULL && touches_shape(s, instance)) {
        tl_scene_overlap overlap = { instance, TL_NO_TRIANGLE };
        if (s->count < s->capacity) {
            s->overlaps[s->count] = overlap;
        }
        s->count += s->count < UINT32_MAX;
    }
    return true;
}

static bool visit_any(tl_scene_line *line, uint32_t instance)
{
    scene_overlap_search *s = line->user;
    if (!tl_scene_accepts(s->filter, instance)) {
        return true;
    }
    bool touches = false;
    if (s->instances[instance].soup != NULL) {
        const tl_scaled_soup soup = tl_scene_soup(&s->places[instance], s->instances[instance].soup);
        (void)tl_scaled_soup_overlaps(&soup, s->shape->convex, pose_at_soup(s, instance), tl_scene_triangles(s->filter),
                                      &touches);
    } else if (s->instances[instance].shape != NULL) {
        touches = touches_shape(s, instance);
    }
    return !touches;
}

static tl_vec3 no_motion(void)
{
    return tl_vec3_make(0.0f, 0.0f, 0.0f);
}

static bool walk_overlaps(scene_overlap_search *s, const tl_scene *scene, tl_scene_visit_fn *visit)
{
    tl_scene_line line;
    tl_scene_line_make(&line, scene, tl_scene_mask(s->filter), s->shape->middle, no_motion(), 1.0f);
    line.half = s->shape->half;
    line.kind = TL_SCENE_LINE_OTHER;
    line.any = true;
    line.visit = visit;
    line.user = s;
    return tl_scene_line_walk(&line);
}

// What both queries begin with; their outputs are zero already.
static tl_result begin_overlap_search(const tl_scene *scene, const tl_scene_instance *instances,
                                      const tl_scene_overlap_query *query, tl_moved_shape *moved,
                                      scene_overlap_search *search)
{
    if (!tl_scene_has_instances(scene, instances) || query == NULL || query->shape == NULL) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(tl_moved_shape_make(query->shape, query->pose, no_motion(), moved));
    scene_overlap_search s = {
        instances, tl_scene_records(scene), tl_scene_places(scene), query->filter, moved, NULL, 0, 0
    };
    *search = s;
    return TL_OK;
}

tl_result tl_scene_overlaps(const tl_scene *scene, const tl_scene_instance *instances,
                            const tl_scene_overlap_query *query, bool *overlaps_out)
{
    if (overlaps_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *overlaps_out = false;
    tl_moved_shape moved;
    scene_overlap_search s;
    TL_TRY(begin_overlap_search(scene, instances, query, &moved, &s));
    *overlaps_out = !walk_overlaps(&s, scene, visit_any);
    return TL_OK;
}

tl_result tl_scene_find_overlaps(const tl_scene *scene, const tl_scene_instance *instances,
                                 const tl_scene_overlap_query *query, tl_scene_overlap *overlaps_out, uint32_t capacity,
                                 uint32_t *count_out)
{
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (overlaps_out == NULL && capacity > 0) {
        return TL_ERR_ARGUMENT;
    }
    tl_moved_shape moved;
    scene_overlap_search s;
    TL_TRY(begin_overlap_search(scene, instances, query, &moved, &s));
    s.overlaps = overlaps_out;
    s.capacity = capacity;
    (void)walk_overlaps(&s, scene, visit_all);
    *count_out = s.count;
    return s.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
