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
#include "nav_query/prepared/graph_reuse.h"

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

// A slack is (1 + (code % 8) / 8) 2^(code / 8 - 1): the high bits of a float.
enum { SLACK_SHIFT = 20, SLACK_LOWEST = 126 << 23, SLACK_CODE_SHIFT = 24 };

// The code of a slack of 0.5 and more, rounded up. As directions are longer than their rounding, it is below 2^17.
static uint32_t slack_code(double slack)
{
    const float value = (float)(slack * (1.0 + 2.0 * (double)TL_FLOAT_ROUNDING));
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t code = (bits - SLACK_LOWEST + (1u << SLACK_SHIFT) - 1) >> SLACK_SHIFT;
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

static void write_cone(const tl_nav_visibility_graph *graph, const tl_nav_corner_cone *cone, uint32_t at)
{
    const tl_nav_corner_cones *cones = &graph->cones;
    const double rounding = graph->rounding;
    const double left = steps_a_metre(cone->left_x, cone->left_z, rounding);
    const double right = steps_a_metre(cone->right_x, cone->right_z, rounding);
    cones->left_x[at] = whole_steps((double)cone->left_x * left);
    cones->left_z[at] = whole_steps((double)cone->left_z * left);
    cones->right_x[at] = whole_steps(-(double)cone->right_x * right);
    cones->right_z[at] = whole_steps(-(double)cone->right_z * right);
    const uint32_t slack = slack_code(CONE_LEAST_SLACK + 4.0 * rounding * tl_max_f64(left, right));
    cones->vertex[at] = cone->vertex | slack << SLACK_CODE_SHIFT;
}

// Room for `capacity` cones.
static bool allocate_cones(const tl_allocator *allocator, tl_nav_corner_cones *cones, uint32_t capacity)
{
    // An even number, so that each array of halves is whole words.
    cones->places = ((uint64_t)capacity + TL_NAV_CONES_AT_ONCE + 1) & ~(uint64_t)1;
    cones->block = tl_allocate_array(allocator, 3 * cones->places, sizeof *cones->block);
    if (cones->block == NULL) {
        return false;
    }
    cones->vertex = cones->block;
    int16_t **arrays[4] = { &cones->left_x, &cones->left_z, &cones->right_x, &cones->right_z };
    for (uint32_t i = 0; i < 4; i++) {
        *arrays[i] = (int16_t *)(void *)(cones->block + cones->places) + i * cones->places;
    }
    return true;
}

// What is read behind the last cone, with it.
static void clear_behind_cones(const tl_nav_corner_cones *cones)
{
    memset(cones->vertex + cones->count, 0, TL_NAV_CONES_AT_ONCE * sizeof *cones->vertex);
    int16_t *const arrays[4] = { cones->left_x, cones->left_z, cones->right_x, cones->right_z };
    for (uint32_t i = 0; i < 4; i++) {
        memset(arrays[i] + cones->count, 0, TL_NAV_CONES_AT_ONCE * sizeof *arrays[i]);
    }
}

// The cones of the list by polygon, joined: those of polygon p at [first[p], first[p + 1]).
static void sort_cones(const tl_nav_cone_list *list, const tl_nav_visibility_graph *graph, uint32_t *first,
                       tl_nav_corner_cone *grouped)
{
    memset(first, 0, ((size_t)graph->polygon_count + 1) * sizeof *first);
    for (uint64_t i = 0; i < list->count; i++) {
        first[graph->slot_first[list->cones[i].slot] + list->cones[i].polygon]++;
    }
    for (uint32_t p = 1; p <= graph->polygon_count; p++) {
        first[p] += first[p - 1];
    }
    for (uint64_t i = list->count; i > 0; i--) {
        const tl_nav_corner_cone *last = &list->cones[i - 1];
        grouped[--first[graph->slot_first[last->slot] + last->polygon]] = *last;
    }
    uint32_t total = 0;
    for (uint32_t p = 0; p < graph->polygon_count; p++) {
        const uint32_t count = join_cones(grouped + first[p], first[p + 1] - first[p]);
        memmove(grouped + total, grouped + first[p], count * sizeof *grouped);
        first[p] = total;
        total += count;
    }
    first[graph->polygon_count] = total;
}

// A polygon's cones in the graph before, from first[0] to first[1]; NULL: there are none to reuse.
static const uint32_t *old_cones(const tl_navmesh *navmesh, const tl_nav_graph_reuse *reuse, uint32_t slot,
                                 uint32_t polygon)
{
    return tl_nav_is_tile_reused(navmesh, reuse, slot)
               ? reuse->old->cones.first + reuse->old->slot_first[slot] + polygon
               : NULL;
}

static void copy_run(const tl_nav_corner_cones *from, uint32_t first, uint32_t count, const tl_nav_corner_cones *to,
                     uint32_t at)
{
    const size_t bytes = count * sizeof *from->left_x;
    memcpy(to->left_x + at, from->left_x + first, bytes);
    memcpy(to->left_z + at, from->left_z + first, bytes);
    memcpy(to->right_x + at, from->right_x + first, bytes);
    memcpy(to->right_z + at, from->right_z + first, bytes);
}

// Copies the cones of a polygon that are reused to the graph's from `at` on: all that follow one another at once.
// Returns their number.
static uint32_t copy_cones(const tl_nav_graph_reuse *reuse, const uint32_t *range, const tl_nav_corner_cones *to,
                           uint32_t at)
{
    const tl_nav_corner_cones *from = &reuse->old->cones;
    uint32_t count = 0;
    for (uint32_t i = range[0]; i < range[1]; i++) {
        const uint32_t begin = i;
        for (; i < range[1] && reuse->now[tl_nav_cone_vertex(from, i)] != TL_NAV_NO_VERTEX; i++) {
            const uint32_t slack = from->vertex[i] & ~(TL_NAV_MAX_CORNER_VERTICES - 1);
            to->vertex[at + count + (i - begin)] = reuse->now[tl_nav_cone_vertex(from, i)] | slack;
        }
        copy_run(from, begin, i - begin, to, at + count);
        count += i - begin;
    }
    return count;
}

// What lay_cones puts into a graph.
typedef struct cone_layout {
    const tl_navmesh *navmesh;
    tl_nav_visibility_graph *graph;
    const tl_nav_graph_reuse *reuse;
    const uint32_t *first;             // by polygon, of the new ones
    const tl_nav_corner_cone *grouped; // those
    tl_stage *stage;
} cone_layout;

// The cones of one polygon, from `at` on; returns their number. `p`: its number in the graph.
static uint32_t lay_polygon(const cone_layout *l, uint32_t slot, uint32_t polygon, uint32_t p, uint32_t at)
{
    const uint32_t *range = old_cones(l->navmesh, l->reuse, slot, polygon);
    uint32_t count = range != NULL ? copy_cones(l->reuse, range, &l->graph->cones, at) : 0;
    for (uint32_t i = l->first[p]; i < l->first[p + 1]; i++, count++) {
        write_cone(l->graph, &l->grouped[i], at + count);
    }
    return count;
}

// Goes through all polygons, and writes their cones and where they stand.
static tl_result lay_cones(const cone_layout *l)
{
    tl_nav_corner_cones *cones = &l->graph->cones;
    uint32_t p = 0;
    for (uint32_t slot = 0; slot < l->graph->slot_count; slot++) {
        const tl_nav_slot *in = &l->navmesh->slots[slot];
        for (uint32_t polygon = 0; in->tile != NULL && polygon < in->rings.polygon_count; polygon++, p++) {
            cones->first[p] = cones->count;
            cones->count += lay_polygon(l, slot, polygon, p, cones->count);
            TL_TRY(tl_stage_tick(l->stage, p));
        }
    }
    cones->first[p] = cones->count;
    clear_behind_cones(cones);
    return TL_OK;
}

// How many cones of the graph before are reused.
static uint32_t count_reused(const tl_navmesh *navmesh, const tl_nav_graph_reuse *reuse)
{
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        const uint32_t *first = old_cones(navmesh, reuse, slot, 0);
        const uint32_t end = first != NULL ? first[navmesh->slots[slot].rings.polygon_count] : 0;
        for (uint32_t i = first != NULL ? first[0] : 0; i < end; i++) {
            count += reuse->now[tl_nav_cone_vertex(&reuse->old->cones, i)] != TL_NAV_NO_VERTEX ? 1 : 0;
        }
    }
    return count;
}

tl_result tl_nav_group_cones(tl_nav_cone_list *list, const tl_navmesh *navmesh, tl_nav_visibility_graph *graph,
                             const tl_nav_graph_reuse *reuse, tl_stage *stage)
{
    tl_nav_corner_cones *cones = &graph->cones;
    const uint32_t reused = count_reused(navmesh, reuse);
    if (list->count + reused > UINT32_MAX - TL_NAV_CONES_AT_ONCE || graph->vertex_count > TL_NAV_MAX_CORNER_VERTICES) {
        return TL_ERR_LIMIT;
    }
    const uint64_t places = (uint64_t)graph->polygon_count + 1;
    uint32_t *first = tl_allocate_array(list->allocator, places, sizeof *first);
    tl_nav_corner_cone *grouped = tl_allocate_array(list->allocator, list->count, sizeof *grouped);
    cones->first = tl_allocate_array(list->allocator, places, sizeof *cones->first);
    tl_result result = first != NULL && grouped != NULL && cones->first != NULL ? TL_OK : TL_ERR_MEMORY;
    const cone_layout layout = { navmesh, graph, reuse, first, grouped, stage };
    if (result == TL_OK) {
        sort_cones(list, graph, first, grouped);
        result = allocate_cones(list->allocator, cones, reused + first[graph->polygon_count]) ? TL_OK : TL_ERR_MEMORY;
    }
    if (result == TL_OK) {
        result = lay_cones(&layout);
    }
    tl_release_array(list->allocator, grouped, list->count, sizeof *grouped);
    tl_release_array(list->allocator, first, places, sizeof *first);
    return result;
}

void tl_nav_free_cones(const tl_allocator *allocator, tl_nav_visibility_graph *graph)
{
    tl_release_array(allocator, graph->cones.first, (uint64_t)graph->polygon_count + 1, sizeof *graph->cones.first);
    tl_release_array(allocator, graph->cones.block, 3 * graph->cones.places, sizeof *graph->cones.block);
}

// A point on a polygon.
typedef struct spot {
    uint32_t slot, polygon;
    tl_vec3 point;
} spot;

static float leg_length(float x, float z, const tl_nav_corner_vertex *vertex)
{
    float to_x = x - vertex->x;
    float to_z = z - vertex->z;
    return sqrtf(to_x * to_x + to_z * to_z);
}

// Which of the cones from `base` on a point is in. Simple loops, which compilers make wide.
static void test_cones(const tl_nav_visibility_graph *graph, uint32_t base, float x, float z,
                       uint32_t is_in[TL_NAV_CONES_AT_ONCE])
{
    enum { N = TL_NAV_CONES_AT_ONCE };
    const tl_nav_corner_cones *cones = &graph->cones;
    const uint32_t *words = cones->vertex + base;
    const int16_t *left_x = cones->left_x + base, *left_z = cones->left_z + base;
    const int16_t *right_x = cones->right_x + base, *right_z = cones->right_z + base;
    const float line = (float)(8.0 * TL_NAV_CONE_STEPS * graph->rounding);
    float dx[N], dz[N], least[N], left[N], right[N];
    for (uint32_t k = 0; k < N; k++) {
        const tl_nav_corner_vertex *vertex = &graph->vertices[words[k] & (TL_NAV_MAX_CORNER_VERTICES - 1)];
        dx[k] = x - vertex->x;
        dz[k] = z - vertex->z;
    }
    for (uint32_t k = 0; k < N; k++) {
        const union {
            uint32_t bits;
            float value;
        } slack = { (words[k] >> SLACK_CODE_SHIFT << SLACK_SHIFT) + SLACK_LOWEST };
        least[k] = -(slack.value * (fabsf(dx[k]) + fabsf(dz[k])) + line);
    }
    for (uint32_t k = 0; k < N; k++) {
        left[k] = (float)left_x[k] * dz[k] - (float)left_z[k] * dx[k];
    }
    for (uint32_t k = 0; k < N; k++) {
        right[k] = (float)right_x[k] * dz[k] - (float)right_z[k] * dx[k];
    }
    for (uint32_t k = 0; k < N; k++) {
        is_in[k] = (left[k] >= least[k] ? 1u : 0u) & (right[k] >= least[k] ? 1u : 0u);
    }
}

// The corner vertices in whose cones a point lies; `other` is the other end of the path. TL_NAV_NO_NODE: they are more
// than capacity.
static uint32_t vertices_in_cones(const tl_nav_visibility_graph *graph, const spot *at, tl_vec3 other,
                                  tl_nav_corner_leg *legs_out, uint32_t capacity)
{
    const tl_nav_corner_cones *cones = &graph->cones;
    const uint32_t *first = cones->first + graph->slot_first[at->slot] + at->polygon;
    const float x = at->point.x;
    const float z = at->point.z;
    uint32_t count = 0;
    for (uint32_t base = first[0]; base < first[1]; base += TL_NAV_CONES_AT_ONCE) {
        uint32_t is_in[TL_NAV_CONES_AT_ONCE];
        test_cones(graph, base, x, z, is_in);
        for (uint32_t k = 0; k < TL_NAV_CONES_AT_ONCE && base + k < first[1]; k++) {
            if (count == capacity) {
                return TL_NAV_NO_NODE;
            }
            legs_out[count].vertex = tl_nav_cone_vertex(cones, base + k);
            count += is_in[k];
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_corner_vertex *vertex = &graph->vertices[legs_out[i].vertex];
        legs_out[i].length = leg_length(x, z, vertex);
        legs_out[i].total = legs_out[i].length + leg_length(other.x, other.z, vertex);
    }
    return count;
}

bool tl_nav_find_ends(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph, tl_nav_ends *ends_out)
{
    const spot start = { search->start_slot, search->start_polygon, search->start };
    const spot goal = { search->goal_slot, search->goal_polygon, search->goal };
    uint32_t room = search->query->max_nodes;
    ends_out->starts = search->query->legs;
    ends_out->start_count = vertices_in_cones(graph, &start, search->goal, ends_out->starts, room);
    if (ends_out->start_count == TL_NAV_NO_NODE) {
        search->query->is_short = true;
        return false;
    }
    room -= ends_out->start_count;
    ends_out->goals = ends_out->starts + ends_out->start_count;
    ends_out->goal_count = vertices_in_cones(graph, &goal, search->start, ends_out->goals, room);
    search->query->is_short = search->query->is_short || ends_out->goal_count == TL_NAV_NO_NODE;
    return ends_out->goal_count != TL_NAV_NO_NODE;
}
