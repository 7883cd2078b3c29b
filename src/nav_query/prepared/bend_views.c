// SPDX-License-Identifier: MIT
//
// From where in a polygon a path may go straight to a bend and turn there: wedges of sight, cut to the directions from
// which one comes with the bend's walls on the hand of the turn.
//
// What a bend sees through the edge by which sight enters a polygon is a cone. So are the directions that have both
// walls on one hand, and what is left of it is a cone again: two cross products say whether a point is in it. That
// leaves few bends for a point, where the polygon as a whole is seen by many and turned to from more. Cones side by
// side are joined. A cone is kept as two half planes, a little too wide by rounding: who goes a leg walks along it in
// the end. They stand array by array, so that a compiler takes several at once.

#include "nav_query/prepared/roads.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/exact/wedge_sight.h"

#include <math.h>
#include <string.h>

typedef struct cone {
    tl_nav_direction right, left;
} cone;

// Leaves the part of a cone that lies left of a wall (hand 1) or right of it (-1). False: none does.
static bool cut(cone *c, tl_nav_direction wall, int hand, double rounding)
{
    double wall_size = fabs(wall.x) + fabs(wall.z);
    double left = hand * cross(wall, c->left);
    double right = hand * cross(wall, c->right);
    bool keeps_left = left <= 2.0 * rounding * (wall_size + fabs(c->left.x) + fabs(c->left.z));
    bool keeps_right = right <= 2.0 * rounding * (wall_size + fabs(c->right.x) + fabs(c->right.z));
    if (is_open(wall) || (keeps_left && keeps_right)) {
        return true;
    }
    if (!keeps_left && !keeps_right) {
        return false;
    }
    // The wall's line leaves the bend inside the cone, along the wall or away from it.
    bool is_along = cross(c->left, wall) >= cross(c->right, wall);
    tl_nav_direction end = { is_along ? wall.x : -wall.x, is_along ? wall.z : -wall.z };
    *(keeps_left ? &c->right : &c->left) = end;
    return true;
}

static bool clip(const tl_nav_wedge *wedge, const tl_nav_ring_walls *walls, int hand, double rounding, cone *cone_out)
{
    const tl_nav_direction first = { (double)walls->first_x, (double)walls->first_z };
    const tl_nav_direction last = { (double)walls->last_x, (double)walls->last_z };
    cone c = { wedge->right, wedge->left };
    if (is_open(c.left) || is_open(c.right)) {
        // Beside the bend: between the walls, or one of them and where the other leads.
        const tl_nav_direction back = { -last.x, -last.z };
        c.right = hand > 0 ? first : back;
        c.left = hand > 0 ? back : first;
    } else if (!cut(&c, first, hand, rounding) || !cut(&c, last, hand, rounding)) {
        return false;
    }
    *cone_out = c;
    return true;
}

tl_result tl_nav_note_views(tl_nav_view_list *list, const tl_nav_roads *roads, uint32_t bend, const tl_nav_wedge *wedge)
{
    for (int hand = -1; hand <= 1; hand += 2) {
        cone c;
        if (!clip(wedge, &roads->bends[bend].walls, hand, roads->rounding, &c)) {
            continue;
        }
        tl_nav_view view = { wedge->slot,      wedge->polygon,  bend,           hand, (float)c.right.x,
                             (float)c.right.z, (float)c.left.x, (float)c.left.z };
        if (list->count == list->capacity) {
            tl_nav_view *grown = tl_grow_array(list->allocator, list->views, &list->capacity, sizeof *grown);
            if (grown == NULL) {
                return TL_ERR_MEMORY;
            }
            list->views = grown;
        }
        list->views[list->count++] = view;
    }
    return TL_OK;
}

static bool joins(const tl_nav_view *a, const tl_nav_view *b)
{
    return a->bend == b->bend && a->hand == b->hand && a->left_x == b->right_x && a->left_z == b->right_z;
}

// Joins the cones of a polygon that stand side by side; those of a bend follow one another. Returns how many are left.
static uint32_t join_views(tl_nav_view *views, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_view view = views[i];
        for (uint32_t k = kept; k > 0 && views[k - 1].bend == view.bend; k--) {
            tl_nav_view *other = &views[k - 1];
            bool is_left = joins(&view, other); // the other is beyond the left end
            if (is_left || joins(other, &view)) {
                view.left_x = is_left ? other->left_x : view.left_x;
                view.left_z = is_left ? other->left_z : view.left_z;
                view.right_x = is_left ? view.right_x : other->right_x;
                view.right_z = is_left ? view.right_z : other->right_z;
                memmove(other, other + 1, (kept - k) * sizeof *other);
                kept--;
                k = kept + 1;
            }
        }
        views[kept++] = view;
    }
    return kept;
}

// The half plane left of a direction from a bend, for points no farther from it than `size`.
static void write_plane(const tl_nav_bend *bend, double x, double z, double size, double rounding, float *x_out,
                        float *z_out, float *least_out)
{
    double at_bend = x * (double)bend->z - z * (double)bend->x;
    *x_out = (float)x;
    *z_out = (float)z;
    *least_out = (float)(at_bend - 4.0 * rounding * (fabs(x) + fabs(z) + size));
}

static void write_view(const tl_navmesh *navmesh, const tl_nav_roads *roads, const tl_nav_view *view, uint32_t at)
{
    const tl_nav_views *views = &roads->views;
    const tl_nav_bend *bend = &roads->bends[view->bend];
    uint32_t count = 0;
    const tl_nav_ring_edge *ring = tl_nav_ring_at(navmesh, view->slot, view->polygon, &count);
    double size = 0.0;
    double largest = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        double x = (double)ring[i].x;
        double z = (double)ring[i].z;
        size = fmax(size, fabs(x - (double)bend->x) + fabs(z - (double)bend->z));
        largest = fmax(largest, fmax(fabs(x), fabs(z)));
    }
    double rounding = fmax(roads->rounding, TL_NAV_ON_LINE * largest);
    write_plane(bend, (double)view->left_x, (double)view->left_z, size, rounding, &views->left_x[at],
                &views->left_z[at], &views->left_least[at]);
    write_plane(bend, -(double)view->right_x, -(double)view->right_z, size, rounding, &views->right_x[at],
                &views->right_z[at], &views->right_least[at]);
    views->bend[at] = view->bend;
}

static bool make_room(const tl_allocator *allocator, tl_nav_views *views)
{
    views->size = 7 * ((uint64_t)views->count + TL_NAV_VIEWS_AT_ONCE);
    views->block = tl_allocate_array(allocator, views->size, sizeof *views->block);
    if (views->block == NULL) {
        return false;
    }
    memset(views->block, 0, views->size * sizeof *views->block);
    float **arrays[6] = { &views->left_x,  &views->left_z,  &views->left_least,
                          &views->right_x, &views->right_z, &views->right_least };
    for (uint32_t i = 0; i < 6; i++) {
        *arrays[i] = views->block + i * (views->size / 7);
    }
    views->bend = (uint32_t *)(void *)(views->block + 6 * (views->size / 7));
    return true;
}

tl_result tl_nav_group_views(tl_nav_view_list *list, const tl_navmesh *navmesh, tl_nav_roads *roads)
{
    tl_nav_views *views = &roads->views;
    if (list->count > UINT32_MAX - TL_NAV_VIEWS_AT_ONCE) {
        return TL_ERR_LIMIT;
    }
    uint32_t *first = tl_allocate_array(list->allocator, (uint64_t)roads->polygon_count + 1, sizeof *first);
    tl_nav_view *grouped = tl_allocate_array(list->allocator, list->count, sizeof *grouped);
    views->first = first;
    bool fits = first != NULL && grouped != NULL;
    if (fits) {
        memset(first, 0, ((size_t)roads->polygon_count + 1) * sizeof *first);
        for (uint64_t i = 0; i < list->count; i++) {
            first[roads->slot_first[list->views[i].slot] + list->views[i].polygon]++;
        }
        for (uint32_t p = 1; p <= roads->polygon_count; p++) {
            first[p] += first[p - 1];
        }
        for (uint64_t i = list->count; i > 0; i--) {
            const tl_nav_view *last = &list->views[i - 1];
            grouped[--first[roads->slot_first[last->slot] + last->polygon]] = *last;
        }
        for (uint32_t p = 0; p < roads->polygon_count; p++) {
            uint32_t count = join_views(grouped + first[p], first[p + 1] - first[p]);
            memmove(grouped + views->count, grouped + first[p], count * sizeof *grouped);
            first[p] = views->count;
            views->count += count;
        }
        first[roads->polygon_count] = views->count;
        fits = make_room(list->allocator, views);
    }
    for (uint32_t i = 0; i < views->count && fits; i++) {
        write_view(navmesh, roads, &grouped[i], i);
    }
    tl_release_array(list->allocator, grouped, list->count, sizeof *grouped);
    return fits ? TL_OK : TL_ERR_MEMORY;
}

void tl_nav_free_views(const tl_allocator *allocator, tl_nav_roads *roads)
{
    tl_release_array(allocator, roads->views.first, (uint64_t)roads->polygon_count + 1, sizeof *roads->views.first);
    tl_release_array(allocator, roads->views.block, roads->views.size, sizeof *roads->views.block);
}

// A point on a polygon.
typedef struct spot {
    uint32_t slot, polygon;
    tl_vec3 point;
} spot;

static float plan_distance(float x, float z, const tl_nav_bend *bend)
{
    float to_x = x - bend->x;
    float to_z = z - bend->z;
    return sqrtf(to_x * to_x + to_z * to_z);
}

// The bends in view of a point; `other` is the other end of the path. TL_NAV_NO_NODE: there is no room for them.
static uint32_t bends_in_view(const tl_nav_roads *roads, const spot *at, tl_vec3 other, tl_nav_bend_leg *legs_out,
                              uint32_t capacity)
{
    const tl_nav_views *views = &roads->views;
    const uint32_t *first = views->first + roads->slot_first[at->slot] + at->polygon;
    const float x = at->point.x;
    const float z = at->point.z;
    uint32_t count = 0;
    for (uint32_t base = first[0]; base < first[1]; base += TL_NAV_VIEWS_AT_ONCE) {
        uint32_t is_in[TL_NAV_VIEWS_AT_ONCE];
        for (uint32_t k = 0; k < TL_NAV_VIEWS_AT_ONCE; k++) {
            uint32_t i = base + k;
            is_in[k] = (views->left_x[i] * z - views->left_z[i] * x >= views->left_least[i] ? 1u : 0u) &
                       (views->right_x[i] * z - views->right_z[i] * x >= views->right_least[i] ? 1u : 0u);
        }
        if (capacity - count < TL_NAV_VIEWS_AT_ONCE) {
            return TL_NAV_NO_NODE;
        }
        for (uint32_t k = 0; k < TL_NAV_VIEWS_AT_ONCE && base + k < first[1]; k++) {
            legs_out[count].bend = views->bend[base + k];
            count += is_in[k];
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_bend *bend = &roads->bends[legs_out[i].bend];
        legs_out[i].length = plan_distance(x, z, bend);
        legs_out[i].total = legs_out[i].length + plan_distance(other.x, other.z, bend);
    }
    return count;
}

bool tl_nav_find_ends(const tl_nav_shortest_search *search, const tl_nav_roads *roads, tl_nav_ends *ends_out)
{
    const spot start = { search->start_slot, search->start_polygon, search->start };
    const spot goal = { search->goal_slot, search->goal_polygon, search->goal };
    uint32_t room = search->query->max_nodes;
    ends_out->starts = (tl_nav_bend_leg *)(void *)search->query->wedges;
    ends_out->start_count = bends_in_view(roads, &start, search->goal, ends_out->starts, room);
    if (ends_out->start_count == TL_NAV_NO_NODE) {
        return false;
    }
    room -= ends_out->start_count;
    ends_out->goals = ends_out->starts + ends_out->start_count;
    ends_out->goal_count = bends_in_view(roads, &goal, search->start, ends_out->goals, room);
    return ends_out->goal_count != TL_NAV_NO_NODE;
}
