// SPDX-License-Identifier: MIT
//
// What is near the character, collected once a move: walking the tree costs as much as all that is then computed on the
// few triangles that are found.

#include "character/mover.h"
#include "math/scale.h"
#include "math/tolerance.h"

#include <string.h>

// Of floats, each of half an ulp: a side, the other box's, their difference; or a square, two sums, the limit.
#define BOX_ROUNDINGS (8.0 * (double)TL_FLOAT_ROUNDING)

// From so many items on a look at all of their boxes at once is cheaper than one at each.
enum { MANY_ITEMS = 14 };

typedef struct collection {
    tl_character_mover *m;
    tl_aabb box; // rounded outwards
    const tl_ray_filter *filter;
    const tl_scene_instance *at; // NULL: in the world
    uint32_t instance;
    tl_frame frame;
    tl_vec3d scale; // of the instance
    bool mirrored;
    bool full;
} collection;

static tl_mover_item *next_item(collection *c)
{
    if (c->m->item_count == c->m->def.max_triangles) {
        c->full = true;
        return NULL;
    }
    return &c->m->items[c->m->item_count];
}

// As rays.h says: front and back as seen from the middle of the box, materials, then the caller's word.
static bool accepts_triangle(const collection *c, const tl_soup_triangle *triangle, tl_mover_item *item)
{
    const tl_ray_filter *filter = c->filter;
    if (filter == NULL) {
        return true;
    }
    uint32_t bit = triangle->material < 63 ? triangle->material : 63;
    if ((filter->ignored_materials >> bit & 1) != 0) {
        return false;
    }
    if (filter->cull != TL_RAY_CULL_NONE) {
        tl_vec3d middle = tl_vec3d_from(tl_aabb_center(c->box));
        tl_mover_know(item);
        double height = tl_vec3d_dot(item->normal, tl_vec3d_sub(middle, item->corners[0]));
        if (filter->cull == TL_RAY_CULL_BACK ? height < 0.0 : height > 0.0) {
            return false;
        }
    }
    return filter->accept == NULL || filter->accept(triangle->triangle, triangle->material, filter->accept_user);
}

static tl_vec3d corner_in_world(const collection *c, tl_vec3d corner)
{
    return tl_frame_point(&c->frame, tl_vec3d_mul(corner, c->scale));
}

// In the world the box is that of the floats.
static void set_item_corners(const collection *c, const tl_soup_triangle *triangle, tl_mover_item *item)
{
    const tl_vec3 *corners = triangle->corners;
    if (c->at == NULL) {
        for (int k = 0; k < 3; k++) {
            item->corners[k] = tl_vec3d_from(corners[k]);
        }
        item->low = tl_vec3d_from(tl_min(tl_min(corners[0], corners[1]), corners[2]));
        item->high = tl_vec3d_from(tl_max(tl_max(corners[0], corners[1]), corners[2]));
        item->shape = NULL;
        item->known = false;
        return;
    }
    for (int k = 0; k < 3; k++) {
        item->corners[k] = corner_in_world(c, tl_vec3d_from(corners[c->mirrored ? (3 - k) % 3 : k]));
    }
    tl_mover_set_triangle(item);
}

static bool collect_triangle(const tl_soup_triangle *triangle, void *user)
{
    collection *c = (collection *)user;
    tl_mover_item *item = next_item(c);
    if (item == NULL) {
        return false;
    }
    set_item_corners(c, triangle, item);
    item->instance = c->instance;
    item->triangle = triangle->triangle;
    item->material = triangle->material;
    c->m->item_count += accepts_triangle(c, triangle, item);
    return true;
}

// The box in the instance's space, with room for the rounding of its corners.
static tl_aabb box_in_instance(const collection *c)
{
    tl_vec3d low = tl_vec3d_from(c->box.min), high = tl_vec3d_from(c->box.max);
    tl_vec3d half = tl_vec3d_scale(tl_vec3d_sub(high, low), 0.5);
    tl_vec3d middle = tl_vec3d_sub(tl_vec3d_add(low, half), c->frame.origin);
    tl_vec3d at = tl_frame_rotate_back(&c->frame, middle);
    const tl_vec3d *r = c->frame.rows;
    tl_vec3d reach = tl_vec3d_make(fabs(r[0].x) * half.x + fabs(r[1].x) * half.y + fabs(r[2].x) * half.z,
                                   fabs(r[0].y) * half.x + fabs(r[1].y) * half.y + fabs(r[2].y) * half.z,
                                   fabs(r[0].z) * half.x + fabs(r[1].z) * half.y + fabs(r[2].z) * half.z);
    double room = TL_FLOAT_OUTWARD * (tl_vec3d_size(at) + tl_vec3d_size(reach));
    reach = tl_vec3d_add(reach, tl_vec3d_make(room, room, room));
    const tl_vec3d s = c->scale;
    at = tl_vec3d_make(at.x / s.x, at.y / s.y, at.z / s.z);
    reach = tl_vec3d_make(reach.x / fabs(s.x), reach.y / fabs(s.y), reach.z / fabs(s.z));
    tl_aabb box = { tl_vec3d_to_float(tl_vec3d_sub(at, reach)), tl_vec3d_to_float(tl_vec3d_add(at, reach)) };
    return box;
}

static bool collect_instance(uint32_t instance, void *user)
{
    collection *c = (collection *)user;
    const tl_scene_instance *at = &c->m->level->instances[instance];
    c->at = at;
    c->instance = instance;
    const tl_vec3 scale = tl_scale_factors(at->scale);
    if (at->soup != NULL) {
        c->scale = tl_vec3d_from(scale);
        c->mirrored = tl_scale_is_mirrored(scale);
        c->frame = tl_frame_from(at->pose);
        return tl_soup_triangles_in_box(at->soup, box_in_instance(c), collect_triangle, c);
    }
    tl_mover_item *item = at->shape != NULL ? next_item(c) : NULL;
    if (item != NULL) {
        memset(item, 0, sizeof *item);
        item->shape = at->shape;
        item->scale = scale;
        tl_scaled_convex room;
        tl_aabb box = tl_convex_bounds(tl_mover_shape(item, &room), at->pose);
        item->low = tl_vec3d_from(box.min);
        item->high = tl_vec3d_from(box.max);
        item->pose = &at->pose;
        item->instance = instance;
        item->triangle = TL_NO_TRIANGLE;
        c->m->item_count++;
    }
    return !c->full;
}

static void fill_boxes(tl_character_mover *m)
{
    const tl_mover_boxes boxes = m->boxes;
    for (uint32_t i = 0; i < m->item_count; i++) {
        const tl_mover_item *item = &m->items[i];
        boxes.low_x[i] = (float)item->low.x;
        boxes.low_y[i] = (float)item->low.y;
        boxes.low_z[i] = (float)item->low.z;
        boxes.high_x[i] = (float)item->high.x;
        boxes.high_y[i] = (float)item->high.y;
        boxes.high_z[i] = (float)item->high.z;
    }
}

bool tl_mover_collect(tl_character_mover *m, tl_vec3d low, tl_vec3d high)
{
    m->feet_low = low;
    m->feet_high = high;
    double room = TL_FLOAT_OUTWARD * (tl_vec3d_size(low) + tl_vec3d_size(high)) + 2.0 * m->gap, wide = m->radius + room;
    low = tl_vec3d_sub(low, tl_vec3d_make(wide, room, wide));
    high = tl_vec3d_add(high, tl_vec3d_make(wide, m->core_length + 2.0 * m->radius + room, wide));
    collection c;
    memset(&c, 0, sizeof c);
    c.m = m;
    c.box.min = tl_vec3d_to_float(low);
    c.box.max = tl_vec3d_to_float(high);
    m->item_count = m->contact_count = 0;
    m->contacts_known = false;
    const tl_character_level *level = m->level;
    if (level->soup != NULL) {
        c.filter = level->soup_filter;
        (void)tl_soup_triangles_in_box(level->soup, c.box, collect_triangle, &c);
    } else {
        c.filter = level->scene_filter != NULL ? level->scene_filter->triangles : NULL;
        (void)tl_scene_instances_in_box(level->scene, c.box, level->scene_filter, collect_instance, &c);
    }
    m->has_boxes = m->item_count >= MANY_ITEMS;
    if (m->has_boxes) {
        fill_boxes(m);
    }
    return !c.full;
}

// Twice how far two spans are apart, without a branch: at most one of both differences is above 0.
static inline float apart_twice(float low, float high, float from, float to)
{
    const float above = low - to, below = from - high;
    return (above + fabsf(above)) + (below + fabsf(below));
}

// Most of what is near is not as near as `reach`: a loop of plain arithmetic, that compilers do for four items at once.
float tl_mover_measure_boxes(tl_character_mover *m, tl_vec3d low, tl_vec3d high, double reach)
{
    if (!m->has_boxes) {
        return 0.0f;
    }
    const tl_mover_boxes boxes = m->boxes;
    const tl_vec3 from = tl_vec3d_to_float(low), to = tl_vec3d_to_float(high);
    const uint32_t end = (m->item_count + TL_MOVER_BOX_LANES - 1) / TL_MOVER_BOX_LANES * TL_MOVER_BOX_LANES;
    float *restrict away_sq = boxes.away_sq;
    for (uint32_t i = 0; i < end; i++) {
        const float x = apart_twice(boxes.low_x[i], boxes.high_x[i], from.x, to.x);
        const float y = apart_twice(boxes.low_y[i], boxes.high_y[i], from.y, to.y);
        const float z = apart_twice(boxes.low_z[i], boxes.high_z[i], from.z, to.z);
        away_sq[i] = x * x + y * y + z * z;
    }
    // Where a side of an item's box counts, it is no farther from the other box than the reach: nor is its rounding
    // more than that of such a number.
    const double most = reach + BOX_ROUNDINGS * (tl_vec3d_size(low) + tl_vec3d_size(high) + reach);
    return (float)(4.0 * most * most * (1.0 + BOX_ROUNDINGS));
}
