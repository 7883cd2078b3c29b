// SPDX-License-Identifier: MIT
//
// Visibility cones: from where in a polygon a path may go straight to a corner vertex and turn there.
//
// What a corner vertex sees through the edge by which its sight enters a polygon is a cone. So are the directions that
// have both of its walls on the side of the turn, and the intersection of both is a cone again: two cross products tell
// whether a point lies in it. That leaves few corner vertices for a point; many more see the polygon as a whole.
// Adjacent cones of a vertex are joined. They stand array by array, so that a compiler tests several at once.
//
// A cone is kept as two directions of whole steps from its corner vertex v, 12 bytes with what follows, since a city
// has a million: a direction D, whose larger component is M metres, becomes s D with s = TL_NAV_CONE_STEPS / M, rounded
// by half a step in each component. D itself is off by up to 4 r, r the graph's rounding, in each component and in
// where its line begins. So a point v + d that lies left of D has
//
//   cross(kept, d) >= -(e |d| + 4 r |kept|),  e = 1/2 + 4 r s and what floats round,
//
// with sums of absolute components as lengths. e is kept rounded up, in a code of 8 bits. A cone is a little too wide
// by that, and never too narrow: a leg is walked along before a path takes it.
// Source: Shen, Cheema, Harabor, Stuckey, Euclidean Pathfinding with Compressed Path Databases, IJCAI 2020, for paths
// from the corner vertices that both ends see.

#include "nav_query/prepared/corner_cones.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/min_max.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/prepared/visibility_graph.h"

#include <math.h>
#include <string.h>

typedef struct opening {
    tl_nav_direction right, left;
} opening;

// Leaves the part of a cone that lies left of a wall (side 1) or right of it (-1). False: none does.
static bool cut_by_wall(opening *c, tl_nav_direction wall, int side, double rounding)
{
    double wall_size = fabs(wall.x) + fabs(wall.z);
    double left = side * wedge_cross(wall, c->left);
    double right = side * wedge_cross(wall, c->right);
    bool keeps_left = left <= 2.0 * rounding * (wall_size + fabs(c->left.x) + fabs(c->left.z));
    bool keeps_right = right <= 2.0 * rounding * (wall_size + fabs(c->right.x) + fabs(c->right.z));
    if (is_open_direction(wall) || (keeps_left && keeps_right)) {
        return true;
    }
    if (!keeps_left && !keeps_right) {
        return false;
    }
    // The wall's line leaves the corner vertex inside the cone, along the wall or away from it.
    bool is_along = wedge_cross(c->left, wall) >= wedge_cross(c->right, wall);
    tl_nav_direction end = { is_along ? wall.x : -wall.x, is_along ? wall.z : -wall.z };
    *(keeps_left ? &c->right : &c->left) = end;
    return true;
}

static bool clip_to_walls(const tl_nav_wedge *wedge, const tl_nav_ring_walls *walls, int side, double rounding,
                          opening *opening_out)
{
    const tl_nav_direction first = { (double)walls->first_x, (double)walls->first_z };
    const tl_nav_direction last = { (double)walls->last_x, (double)walls->last_z };
    opening c = { wedge->right, wedge->left };
    if (is_open_direction(c.left) || is_open_direction(c.right)) {
        // Beside the corner vertex: between the walls, or one of them and where the other leads.
        const tl_nav_direction back = { -last.x, -last.z };
        c.right = side > 0 ? first : back;
        c.left = side > 0 ? back : first;
    } else if (!cut_by_wall(&c, first, side, rounding) || !cut_by_wall(&c, last, side, rounding)) {
        return false;
    }
    *opening_out = c;
    return true;
}

tl_result tl_nav_add_cones(tl_nav_cone_list *list, const tl_nav_visibility_graph *graph, uint32_t vertex,
                           const tl_nav_wedge *wedge)
{
    for (int side = -1; side <= 1; side += 2) {
        opening c;
        if (!clip_to_walls(wedge, &graph->vertices[vertex].walls, side, graph->rounding, &c)) {
            continue;
        }
        tl_nav_corner_cone cone = { wedge->slot,      wedge->polygon,   vertex,          side,
                                    (float)c.right.x, (float)c.right.z, (float)c.left.x, (float)c.left.z };
        if (list->count == list->capacity) {
            tl_nav_corner_cone *grown = tl_grow_array(list->allocator, list->cones, &list->capacity, sizeof *grown);
            if (grown == NULL) {
                return TL_ERR_MEMORY;
            }
            list->cones = grown;
        }
        list->cones[list->count++] = cone;
    }
    return TL_OK;
}

static bool joins(const tl_nav_corner_cone *a, const tl_nav_corner_cone *b)
{
    return a->vertex == b->vertex && a->side == b->side && a->left_x == b->right_x && a->left_z == b->right_z;
}

// Joins adjacent cones of a polygon; those of a corner vertex follow one another. Returns how many are left.
static uint32_t join_cones(tl_nav_corner_cone *cones, uint32_t count)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_corner_cone cone = cones[i];
        for (uint32_t k = kept; k > 0 && cones[k - 1].vertex == cone.vertex; k--) {
            tl_nav_corner_cone *other = &cones[k - 1];
            bool is_left = joins(&cone, other); // the other is beyond the left end
            if (is_left || joins(other, &cone)) {
                cone.left_x = is_left ? other->left_x : cone.left_x;
                cone.left_z = is_left ? other->left_z : cone.left_z;
                cone.right_x = is_left ? cone.right_x : other->right_x;
                cone.right_z = is_left ? cone.right_z : other->right_z;
                memmove(other, other + 1, (kept - k) * sizeof *other);
                kept--;
                k = kept + 1;
            }
        }
        cones[kept++] = cone;
    }
    return kept;
}

// Half a step, and the roundings of dot products of floats, 2^-22 of 32767 steps.
#define CONE_LEAST_SLACK 0.51

// The code of a slack of 0.5 and more, rounded up. As directions are longer than their rounding, it is below 2^17.
static uint32_t slack_code(double slack)
{
    const float value = (float)(slack * (1.0 + 2.0 * (double)TL_FLOAT_ROUNDING));
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t code = (bits - TL_NAV_SLACK_LOWEST + (1u << TL_NAV_SLACK_SHIFT) - 1) >> TL_NAV_SLACK_SHIFT;
    TL_ASSERT(code < 256);
    return code;
}

// Steps a metre of a direction; 0 where it has no length, or so little that it leads anywhere.
static double steps_a_metre(float x, float z, double rounding)
{
    const double largest = tl_max_f64(fabs((double)x), fabs((double)z));
    return largest > rounding ? TL_NAV_CONE_STEPS / largest : 0.0;
}

static int16_t whole_steps(double steps)
{
    return (int16_t)lrint(steps);
}

static void write_cone(const tl_nav_corner_cones *cones, double rounding, const tl_nav_corner_cone *cone, uint32_t at)
{
    const double left = steps_a_metre(cone->left_x, cone->left_z, rounding);
    const double right = steps_a_metre(cone->right_x, cone->right_z, rounding);
    cones->left_x[at] = whole_steps((double)cone->left_x * left);
    cones->left_z[at] = whole_steps((double)cone->left_z * left);
    cones->right_x[at] = whole_steps(-(double)cone->right_x * right);
    cones->right_z[at] = whole_steps(-(double)cone->right_z * right);
    const uint32_t slack = slack_code(CONE_LEAST_SLACK + 4.0 * rounding * tl_max_f64(left, right));
    cones->vertex[at] = cone->vertex | slack << TL_NAV_SLACK_CODE_SHIFT;
}

// Words of 4 bytes of the block of so many cones.
static uint64_t cone_words(uint32_t polygon_count, uint32_t count)
{
    return (uint64_t)polygon_count + 1 + 3 * (uint64_t)count + TL_NAV_CONES_AT_ONCE;
}

uint64_t tl_nav_cones_size(const tl_nav_corner_cones *cones)
{
    return cones->first != NULL ? cone_words(cones->polygon_count, cones->count) * sizeof *cones->first : 0;
}

// A block for so many cones. False: out of memory.
static bool allocate_cones(const tl_allocator *allocator, uint32_t polygon_count, uint32_t count,
                           tl_nav_corner_cones *cones_out)
{
    memset(cones_out, 0, sizeof *cones_out);
    cones_out->polygon_count = polygon_count;
    cones_out->count = count;
    cones_out->first = tl_allocate_array(allocator, cone_words(polygon_count, count), sizeof *cones_out->first);
    if (cones_out->first == NULL) {
        return false;
    }
    // What is read behind the halves are others, or the words: any do, as the words behind are those of corner vertex
    // 0.
    int16_t *halves = (int16_t *)(void *)(cones_out->first + polygon_count + 1);
    cones_out->left_x = halves;
    cones_out->left_z = halves + count;
    cones_out->right_x = halves + 2 * (size_t)count;
    cones_out->right_z = halves + 3 * (size_t)count;
    cones_out->vertex = cones_out->first + polygon_count + 1 + 2 * (size_t)count;
    memset(cones_out->vertex + count, 0, TL_NAV_CONES_AT_ONCE * sizeof *cones_out->vertex);
    return true;
}

void tl_nav_free_cones(const tl_allocator *allocator, tl_nav_corner_cones *cones)
{
    tl_release_array(allocator, cones->first, cone_words(cones->polygon_count, cones->count), sizeof *cones->first);
    memset(cones, 0, sizeof *cones);
}

// The new cones of a tile by polygon, joined: those of polygon p at [first[p], first[p + 1]) of `sorted`.
static void sort_cones(const tl_nav_corner_cone *fresh, uint64_t count, uint32_t polygon_count, uint32_t *first,
                       tl_nav_corner_cone *sorted)
{
    memset(first, 0, ((size_t)polygon_count + 1) * sizeof *first);
    for (uint64_t i = 0; i < count; i++) {
        first[fresh[i].polygon]++;
    }
    for (uint32_t p = 1; p <= polygon_count; p++) {
        first[p] += first[p - 1];
    }
    for (uint64_t i = count; i > 0; i--) {
        sorted[--first[fresh[i - 1].polygon]] = fresh[i - 1];
    }
    uint32_t total = 0;
    for (uint32_t p = 0; p < polygon_count; p++) {
        const uint32_t joined = join_cones(sorted + first[p], first[p + 1] - first[p]);
        memmove(sorted + total, sorted + first[p], joined * sizeof *sorted);
        first[p] = total;
        total += joined;
    }
    first[polygon_count] = total;
}

static void copy_run(const tl_nav_corner_cones *from, uint32_t first, uint32_t count, const tl_nav_corner_cones *to,
                     uint32_t at)
{
    const size_t bytes = count * sizeof *from->left_x;
    memcpy(to->left_x + at, from->left_x + first, bytes);
    memcpy(to->left_z + at, from->left_z + first, bytes);
    memcpy(to->right_x + at, from->right_x + first, bytes);
    memcpy(to->right_z + at, from->right_z + first, bytes);
    memcpy(to->vertex + at, from->vertex + first, count * sizeof *from->vertex);
}

// Copies the cones from `begin` to `end` that are not dropped, all that follow one another at once. Returns their
// number.
static uint32_t copy_kept(const tl_nav_corner_cones *from, uint32_t begin, uint32_t end, const bool *is_dropped,
                          const tl_nav_corner_cones *to, uint32_t at)
{
    uint32_t count = 0;
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t first = i;
        while (i < end && !is_dropped[i]) {
            i++;
        }
        copy_run(from, first, i - first, to, at + count);
        count += i - first;
    }
    return count;
}

// The cones of a polygon before, as [begin, end).
typedef struct cone_range {
    uint32_t begin, end;
} cone_range;

static cone_range cones_before(const tl_nav_corner_cones *old, const uint32_t *old_polygons, uint32_t polygon)
{
    const uint32_t before = old_polygons != NULL ? old_polygons[polygon] : polygon;
    cone_range range = { 0, 0 };
    if (old->count > 0 && before != TL_NO_POLYGON) {
        range.begin = old->first[before];
        range.end = old->first[before + 1];
    }
    return range;
}

static uint64_t count_kept(const tl_nav_corner_cones *old, uint32_t polygon_count, const uint32_t *old_polygons,
                           const bool *is_dropped)
{
    uint64_t kept = 0;
    for (uint32_t p = 0; p < polygon_count; p++) {
        const cone_range range = cones_before(old, old_polygons, p);
        for (uint32_t i = range.begin; i < range.end; i++) {
            kept += is_dropped[i] ? 0 : 1;
        }
    }
    return kept;
}

static tl_result lay_cones(const tl_allocator *allocator, tl_nav_visibility_graph *graph, uint32_t slot,
                           uint32_t polygon_count, const uint32_t *old_polygons, const bool *is_dropped,
                           const uint32_t *first, const tl_nav_corner_cone *sorted)
{
    tl_nav_corner_cones *old = &graph->tiles[slot].cones, made;
    const uint64_t count = count_kept(old, polygon_count, old_polygons, is_dropped) + first[polygon_count];
    if (count > UINT32_MAX - TL_NAV_CONES_AT_ONCE) {
        return TL_ERR_LIMIT;
    }
    if (!allocate_cones(allocator, polygon_count, (uint32_t)count, &made)) {
        return TL_ERR_MEMORY;
    }
    uint32_t at = 0;
    for (uint32_t p = 0; p < polygon_count; p++) {
        const cone_range range = cones_before(old, old_polygons, p);
        made.first[p] = at;
        at += copy_kept(old, range.begin, range.end, is_dropped, &made, at);
        for (uint32_t i = first[p]; i < first[p + 1]; i++) {
            write_cone(&made, graph->rounding, &sorted[i], at++);
        }
    }
    made.first[polygon_count] = at;
    TL_ASSERT(at == made.count);
    tl_nav_free_cones(allocator, old);
    *old = made;
    return TL_OK;
}

tl_result tl_nav_remake_cones(const tl_allocator *allocator, tl_nav_visibility_graph *graph, uint32_t slot,
                              uint32_t polygon_count, const uint32_t *old_polygons, const bool *is_dropped,
                              const tl_nav_corner_cone *fresh, uint64_t count)
{
    const uint64_t places = (uint64_t)polygon_count + 1;
    uint32_t *first = tl_allocate_array(allocator, places, sizeof *first);
    tl_nav_corner_cone *sorted = tl_allocate_array(allocator, count, sizeof *sorted);
    tl_result result = first != NULL && sorted != NULL ? TL_OK : TL_ERR_MEMORY;
    if (result == TL_OK) {
        sort_cones(fresh, count, polygon_count, first, sorted);
        result = lay_cones(allocator, graph, slot, polygon_count, old_polygons, is_dropped, first, sorted);
    }
    tl_release_array(allocator, first, places, sizeof *first);
    tl_release_array(allocator, sorted, count, sizeof *sorted);
    return result;
}
