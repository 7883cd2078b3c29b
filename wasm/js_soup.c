// SPDX-License-Identifier: MIT
//
// Soups. Single rays take numbers and leave their hit in a struct of its own, which JavaScript reads where it stands.

#include "js_convex.h"
#include "js_mesh.h"

#include <stdlib.h>
#include <string.h>

static tl_ray_hit ray_hit;
static tl_ray_filter ray_filter;

// JavaScript's function; as progress it throws nothing.
__attribute__((import_module("env"), import_name("accept"))) extern int tl_js_accept(uint32_t triangle,
                                                                                     uint32_t material);

static bool accept_triangle(uint32_t triangle, uint16_t material, void *user)
{
    (void)user;
    return tl_js_accept(triangle, material) != 0;
}

tl_ray_hit *TL_JS_EXPORT(js_ray_hit)(void)
{
    return &ray_hit;
}

/// The filter for the calls that are given what this returns.
tl_ray_filter *TL_JS_EXPORT(js_set_ray_filter)(int32_t cull, uint32_t materials_low, uint32_t materials_high,
                                               int32_t has_accept)
{
    ray_filter.cull = (tl_ray_cull)cull;
    ray_filter.ignored_materials = (uint64_t)materials_high << 32 | materials_low;
    ray_filter.accept = has_accept ? accept_triangle : NULL;
    return &ray_filter;
}

/// Slot: the result.
tl_soup *TL_JS_FULL_EXPORT(js_soup_bake)(int32_t compact, int32_t kd_tree, int32_t pairs, float split_budget,
                                         int32_t quality)
{
    tl_soup_def def = tl_default_soup_def();
    def.layout = compact ? TL_SOUP_COMPACT : TL_SOUP_FAST;
    def.partition = kd_tree ? TL_SOUP_KD_TREE : TL_SOUP_BVH;
    def.pair_triangles = pairs != 0;
    def.split_budget = split_budget;
    def.quality = (tl_soup_quality)quality;
    def.host = *tl_js_host();
    tl_soup *soup;
    tl_soup_report report;
    tl_js_put(0, tl_soup_bake(&tl_js_input.mesh, &def, &soup, &report));
    tl_js_report = report.base;
    return soup;
}

tl_result TL_JS_EXPORT(js_soup_check)(const void *bytes, uint32_t size)
{
    return tl_soup_check(bytes, size, &tl_js_report);
}

/// Slot: the stats, then the bounds.
void TL_JS_EXPORT(js_soup_info)(const tl_soup *soup)
{
    const tl_soup_stats s = tl_soup_get_stats(soup);
    const double numbers[] = { (double)s.size,    s.source_triangle_count,
                               s.triangle_count,  s.pair_count,
                               s.single_count,    s.reference_count,
                               s.leaf_count,      s.node_count,
                               s.depth,           s.layout,
                               s.coincident_count };
    memcpy(tl_js_slot, numbers, sizeof numbers);
    tl_js_put_aabb(sizeof numbers / sizeof numbers[0], tl_soup_bounds(soup));
}

int32_t TL_JS_EXPORT(js_soup_cast_ray)(const tl_soup *soup, float ox, float oy, float oz, float dx, float dy, float dz,
                                       float max_t, const tl_ray_filter *filter)
{
    const tl_ray ray = { { ox, oy, oz }, { dx, dy, dz }, max_t };
    return tl_soup_cast_ray(soup, &ray, filter, &ray_hit);
}

int32_t TL_JS_EXPORT(js_soup_occluded)(const tl_soup *soup, float ox, float oy, float oz, float dx, float dy, float dz,
                                       float max_t, const tl_ray_filter *filter)
{
    const tl_ray ray = { { ox, oy, oz }, { dx, dy, dz }, max_t };
    return tl_soup_occluded(soup, &ray, filter);
}

int32_t TL_JS_EXPORT(js_soup_cast_segment)(const tl_soup *soup, float ax, float ay, float az, float bx, float by,
                                           float bz, const tl_ray_filter *filter)
{
    return tl_soup_cast_segment(soup, tl_vec3_make(ax, ay, az), tl_vec3_make(bx, by, bz), filter, &ray_hit);
}

int32_t TL_JS_EXPORT(js_soup_line_of_sight)(const tl_soup *soup, float ax, float ay, float az, float bx, float by,
                                            float bz, const tl_ray_filter *filter)
{
    return tl_soup_line_of_sight(soup, tl_vec3_make(ax, ay, az), tl_vec3_make(bx, by, bz), filter);
}

/// Slot: origin, direction, max t; then how many hits there are and where.
tl_result TL_JS_EXPORT(js_soup_cast_ray_all)(const tl_soup *soup, int32_t crossed, const tl_ray_filter *filter)
{
    const tl_ray ray = { tl_js_vec3(0), tl_js_vec3(3), tl_js_f32(6) };
    const tl_hit_rule rule = crossed ? TL_HITS_CROSSED : TL_HITS_TOUCHED;
    uint32_t count = 16, room = 0;
    tl_ray_hit *hits = NULL;
    tl_result result = TL_INCOMPLETE;
    while (result == TL_INCOMPLETE) {
        room = count;
        hits = tl_js_buffer_room(room * sizeof *hits);
        if (hits == NULL) {
            return TL_ERR_MEMORY;
        }
        result = tl_soup_cast_ray_all(soup, &ray, rule, filter, hits, room, &count);
    }
    tl_js_put_pointer(tl_js_put(0, count), hits);
    return result;
}

/// Slot: the point and the distance; then the nearest point.
tl_result TL_JS_EXPORT(js_soup_nearest)(const tl_soup *soup, const tl_ray_filter *filter)
{
    tl_soup_point p;
    const tl_result result = tl_soup_nearest(soup, tl_js_vec3(0), tl_js_f32(3), filter, &p);
    uint32_t at = tl_js_put_vec3(tl_js_put(tl_js_put_vec3(0, p.point), (double)p.distance), p.normal);
    at = tl_js_put(tl_js_put(at, p.triangle), p.material);
    tl_js_put(tl_js_put(at, p.back), p.feature);
    return result;
}

/// Slot: shape, pose; then whether it overlaps.
tl_result TL_JS_EXPORT(js_soup_overlaps)(const tl_soup *soup, const tl_ray_filter *filter)
{
    const tl_convex shape = tl_js_shape(0);
    bool overlaps;
    const tl_result result = tl_soup_overlaps(soup, &shape, tl_js_pose(TL_JS_SHAPE_NUMBERS), filter, &overlaps);
    tl_js_put(0, overlaps);
    return result;
}

/// Slot: shape, pose; then how many triangles there are and where.
tl_result TL_JS_EXPORT(js_soup_find_overlaps)(const tl_soup *soup, const tl_ray_filter *filter)
{
    const tl_convex shape = tl_js_shape(0);
    const tl_transform pose = tl_js_pose(TL_JS_SHAPE_NUMBERS);
    uint32_t count = 64;
    uint32_t *triangles = NULL;
    tl_result result = TL_INCOMPLETE;
    while (result == TL_INCOMPLETE) {
        const uint32_t room = count;
        triangles = tl_js_buffer_room(room * sizeof *triangles);
        if (triangles == NULL) {
            return TL_ERR_MEMORY;
        }
        result = tl_soup_find_overlaps(soup, &shape, pose, filter, triangles, room, &count);
    }
    tl_js_put_pointer(tl_js_put(0, count), triangles);
    return result;
}

/// Slot: shape, pose, motion; then the hit.
tl_result TL_JS_EXPORT(js_soup_cast_shape)(const tl_soup *soup, const tl_ray_filter *filter)
{
    const tl_convex shape = tl_js_shape(0);
    tl_shape_hit h;
    const tl_result result = tl_soup_cast_shape(soup, &shape, tl_js_pose(TL_JS_SHAPE_NUMBERS),
                                                tl_js_vec3(TL_JS_SHAPE_NUMBERS + 7), filter, &h);
    uint32_t at = tl_js_put(tl_js_put(tl_js_put(0, (double)h.t), h.initial_overlap), h.back);
    at = tl_js_put(tl_js_put(tl_js_put(at, h.material), h.triangle), (double)h.depth);
    at = tl_js_put_vec3(tl_js_put_vec3(tl_js_put_vec3(at, h.point), h.normal), h.face_normal);
    tl_js_put(at, h.status);
    return result;
}

/// Slot: the point; then side, winding, triangle.
tl_result TL_JS_EXPORT(js_soup_locate)(const tl_soup *soup)
{
    tl_soup_location location;
    const tl_result result = tl_soup_locate(soup, tl_js_vec3(0), &location);
    tl_js_put(tl_js_put(tl_js_put(0, location.side), location.winding), location.triangle);
    return result;
}

tl_result TL_JS_EXPORT(js_soup_check_closed)(const tl_soup *soup)
{
    return tl_soup_check_closed(soup, NULL, &tl_js_report);
}

tl_result TL_JS_EXPORT(js_soup_refit)(tl_soup *soup)
{
    return tl_soup_refit(soup, &tl_js_input.mesh, &tl_js_report);
}

// ---------------------------------------------------------------------------------------------------------
// For drawing. Slot: how many there are, and where.

static tl_result put_buffer(const tl_js_buffer *buffer, size_t record)
{
    tl_js_put_pointer(tl_js_put(0, (double)(buffer->used / record)), buffer->bytes);
    return buffer->failed ? TL_ERR_MEMORY : TL_OK;
}

/// Each pair as twelve floats and two triangles.
tl_result TL_JS_EXPORT(js_soup_pairs)(const tl_soup *soup)
{
    tl_js_buffer *buffer = tl_js_buffer_begin();
    uint64_t cursor = 0;
    tl_soup_pair pair;
    while (!buffer->failed && tl_soup_next_pair(soup, &cursor, &pair)) {
        tl_js_buffer_add(buffer, &pair, sizeof pair);
    }
    return put_buffer(buffer, sizeof pair);
}

typedef struct box_record {
    tl_aabb box;
    uint32_t depth, leaf;
} box_record;

static bool add_box(tl_aabb box, uint32_t depth, bool leaf, void *user)
{
    const box_record record = { box, depth, leaf };
    tl_js_buffer *buffer = user;
    tl_js_buffer_add(buffer, &record, sizeof record);
    return !buffer->failed;
}

/// Each box as six floats, depth, and whether it is a leaf.
tl_result TL_JS_EXPORT(js_soup_boxes)(const tl_soup *soup, uint32_t max_depth)
{
    tl_js_buffer *buffer = tl_js_buffer_begin();
    tl_soup_bvh_boxes(soup, max_depth, add_box, buffer);
    return put_buffer(buffer, sizeof(box_record));
}

static bool add_triangle(const tl_soup_triangle *triangle, void *user)
{
    tl_js_buffer *buffer = user;
    tl_js_buffer_add(buffer, &triangle->triangle, sizeof triangle->triangle);
    return !buffer->failed;
}

/// Slot: the box.
tl_result TL_JS_EXPORT(js_soup_triangles_in_box)(const tl_soup *soup)
{
    tl_js_buffer *buffer = tl_js_buffer_begin();
    tl_soup_triangles_in_box(soup, tl_js_aabb(0), add_triangle, buffer);
    return put_buffer(buffer, sizeof(uint32_t));
}
