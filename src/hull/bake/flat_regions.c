// SPDX-License-Identifier: MIT
//
// Faces that are flat to within a tolerance become one: a turned box, whose corners were rounded to floats, has six
// faces and not twelve.
//
// Qhull and Gregorius merge while they build, across edges that rounding made concave, and must then repair what
// merging broke (Barber, Dobkin, Huhdanpaa, ACM TOMS 22, 1996; Gregorius, Implementing QuickHull, GDC 2014). Here the
// exact hull is there first, so nothing is ever concave, and merging is a matter of its faces alone: regions grow from
// the largest face that is left over neighbours whose corners lie within the tolerance behind its plane. That plane
// stays, so a region cannot creep around a curve, and each face is asked a few times only.

#include "hull/bake/flat_regions.h"

#include "base/assert.h"
#include "base/radix_sort.h"
#include "math/vec3d.h"

#include <string.h>

// Faces of a region lie within 45 degrees of its plane, so that a thin plate keeps its sides: cos^2 45.
#define MIN_COSINE_SQ 0.5

// A corner of a merged face is strictly convex when it turns by more than this, as a sine: 2^-30 is far above the
// rounding of the turn, which is some 2^-50, and far below any bend that matters.
#define MIN_TURN 9.313225746154785e-10

typedef struct region_grower {
    const tl_hull_polygons *fine;
    const tl_vec3 *points;
    double distance;
    bool keeps_corners;
    tl_stage *stage;
    tl_vec3d *normals; // [face_count] of length twice the area
    tl_sort_item *seeds;
    uint32_t *region; // [face_count] the seed of the face's region, or TL_NONE
    uint32_t *queue;  // half-edges of the region to grow across
    uint32_t queue_begin, queue_end;
    // Only when corners are kept:
    uint32_t *degree;          // [vertex_count] borders that end at a vertex
    uint32_t *on_region;       // [vertex_count] the seed of the region that last had it on its border
    uint32_t *next, *previous; // [half_edge_count] around the border of a region
    // The plane of the region that grows.
    uint32_t seed;
    tl_vec3d normal, origin;
    double normal_sq, depth; // depth: the distance times the normal's length
} region_grower;

static tl_vec3d corner_of(const region_grower *g, uint32_t half_edge)
{
    return tl_vec3d_from(g->points[g->fine->points[g->fine->half_edges[half_edge].origin]]);
}

static uint32_t origin_of(const region_grower *g, uint32_t half_edge)
{
    return g->fine->half_edges[half_edge].origin;
}

static uint32_t twin_of(const region_grower *g, uint32_t half_edge)
{
    return g->fine->half_edges[half_edge].twin;
}

static tl_vec3d area_vector(const region_grower *g, tl_hull_face face)
{
    tl_vec3d a = corner_of(g, face.first), sum = { 0.0, 0.0, 0.0 };
    for (uint32_t k = 1; k + 1 < face.count; k++) {
        tl_vec3d b = tl_vec3d_sub(corner_of(g, face.first + k), a);
        tl_vec3d c = tl_vec3d_sub(corner_of(g, face.first + k + 1), a);
        sum = tl_vec3d_add(sum, tl_vec3d_cross(b, c));
    }
    return sum;
}

static tl_result start_growing(region_grower *g, tl_arena *arena)
{
    const uint32_t faces = g->fine->face_count, edges = g->fine->half_edge_count, corners = g->fine->vertex_count;
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, faces);
    g->normals = TL_PUSH(arena, tl_vec3d, faces);
    g->seeds = TL_PUSH(arena, tl_sort_item, faces);
    g->region = TL_PUSH(arena, uint32_t, faces);
    g->queue = TL_PUSH(arena, uint32_t, edges);
    g->degree = TL_PUSH_ZERO(arena, uint32_t, corners);
    g->on_region = TL_PUSH(arena, uint32_t, corners);
    g->next = TL_PUSH(arena, uint32_t, edges);
    g->previous = TL_PUSH(arena, uint32_t, edges);
    if (scratch == NULL || g->normals == NULL || g->seeds == NULL || g->region == NULL || g->queue == NULL ||
        g->degree == NULL || g->on_region == NULL || g->next == NULL || g->previous == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t f = 0; f < faces; f++) {
        TL_TRY(tl_stage_tick(g->stage, f));
        g->normals[f] = area_vector(g, g->fine->faces[f]);
        g->region[f] = TL_NONE;
        const double area = tl_vec3d_dot(g->normals[f], g->normals[f]);
        memcpy(&g->seeds[f].key, &area, sizeof area); // the bits of positive doubles are in their order
        g->seeds[f].key = ~g->seeds[f].key;           // the largest first
        g->seeds[f].value = f;
        g->seeds[f].extra = 0;
    }
    for (uint32_t h = 0; h < edges; h++) {
        TL_TRY(tl_stage_tick(g->stage, h));
        g->degree[origin_of(g, h)]++;
        g->next[h] = g->fine->half_edges[h].next;
        g->previous[g->next[h]] = h;
    }
    memset(g->on_region, 0xff, corners * sizeof *g->on_region);
    return tl_radix_sort_in_stage(g->seeds, scratch, faces, g->stage);
}

static bool lies_behind_the_plane(const region_grower *g, uint32_t face)
{
    const tl_vec3d normal = g->normals[face];
    const double along = tl_vec3d_dot(g->normal, normal);
    if (!(along > 0.0 && along * along >= MIN_COSINE_SQ * g->normal_sq * tl_vec3d_dot(normal, normal))) {
        return false;
    }
    const tl_hull_face f = g->fine->faces[face];
    for (uint32_t k = 0; k < f.count; k++) {
        // In front it is by rounding at most, for the hull is convex.
        if (tl_vec3d_dot(g->normal, tl_vec3d_sub(corner_of(g, f.first + k), g->origin)) < -g->depth) {
            return false;
        }
    }
    return true;
}

// Whether the border turns left at b, seen along the region's normal.
static bool turns_left(const region_grower *g, tl_vec3d a, tl_vec3d b, tl_vec3d c)
{
    const tl_vec3d u = tl_vec3d_sub(b, a), v = tl_vec3d_sub(c, b);
    const double turn = tl_vec3d_dot(g->normal, tl_vec3d_cross(u, v));
    return turn > 0.0 && turn * turn > MIN_TURN * MIN_TURN * g->normal_sq * tl_vec3d_dot(u, u) * tl_vec3d_dot(v, v);
}

// Whether a face can join across a border edge of the region so that the border stays one loop, strictly convex, and
// its ends keep three edges.
static bool joins_convexly(const region_grower *g, uint32_t edge)
{
    const uint32_t back = twin_of(g, edge), face = g->fine->half_edges[back].face;
    const uint32_t a = origin_of(g, edge), b = origin_of(g, back);
    if (g->degree[a] < 4 || g->degree[b] < 4) {
        return false;
    }
    const tl_hull_face f = g->fine->faces[face];
    for (uint32_t h = f.first; h < f.first + f.count; h++) {
        const uint32_t v = origin_of(g, h);
        if (v != a && v != b && g->on_region[v] == g->seed) {
            return false; // it touches the region elsewhere too
        }
    }
    const uint32_t after_a = g->fine->half_edges[g->fine->half_edges[back].next].next;
    return turns_left(g, corner_of(g, g->previous[edge]), corner_of(g, edge), corner_of(g, after_a)) &&
           turns_left(g, corner_of(g, g->previous[back]), corner_of(g, back), corner_of(g, twin_of(g, g->next[edge])));
}

static void splice_border(region_grower *g, uint32_t edge)
{
    const uint32_t back = twin_of(g, edge);
    g->next[g->previous[edge]] = g->next[back];
    g->previous[g->next[back]] = g->previous[edge];
    g->next[g->previous[back]] = g->next[edge];
    g->previous[g->next[edge]] = g->previous[back];
    g->degree[origin_of(g, edge)]--;
    g->degree[origin_of(g, back)]--;
}

static void add_face(region_grower *g, uint32_t face)
{
    const tl_hull_face f = g->fine->faces[face];
    g->region[face] = g->seed;
    for (uint32_t h = f.first; h < f.first + f.count; h++) {
        g->queue[g->queue_end++] = h;
        g->on_region[origin_of(g, h)] = g->seed;
    }
}

static void grow_region(region_grower *g, uint32_t seed)
{
    g->seed = seed;
    g->normal = g->normals[seed];
    g->normal_sq = tl_vec3d_dot(g->normal, g->normal);
    g->origin = corner_of(g, g->fine->faces[seed].first);
    g->depth = g->distance * sqrt(g->normal_sq);
    g->queue_begin = g->queue_end = 0;
    add_face(g, seed);
    while (g->queue_begin < g->queue_end) {
        const uint32_t edge = g->queue[g->queue_begin++];
        const uint32_t face = g->fine->half_edges[twin_of(g, edge)].face;
        if (g->region[face] != TL_NONE || !lies_behind_the_plane(g, face)) {
            continue;
        }
        if (g->keeps_corners) {
            if (!joins_convexly(g, edge)) {
                continue;
            }
            splice_border(g, edge);
        }
        add_face(g, face);
    }
}

static tl_result grow_regions(region_grower *g, tl_arena *arena)
{
    TL_TRY(start_growing(g, arena));
    uint32_t work = 0;
    for (uint32_t i = 0; i < g->fine->face_count; i++) {
        if (g->region[g->seeds[i].value] == TL_NONE) {
            grow_region(g, g->seeds[i].value);
            work += g->queue_end;
        }
        if (work >= TL_STAGE_STEP) {
            work = 0;
            TL_TRY(tl_stage_add(g->stage, 0));
        }
    }
    return TL_OK;
}

static double distance_sq_to_line(tl_vec3d a, tl_vec3d b, tl_vec3d p)
{
    const tl_vec3d along = tl_vec3d_sub(b, a), to_p = tl_vec3d_sub(p, a);
    const tl_vec3d off = tl_vec3d_mul_add(to_p, along, -(tl_vec3d_dot(along, to_p) / tl_vec3d_dot(along, along)));
    return tl_vec3d_dot(off, off);
}

// A vertex whose only borders are the two half-edges that start there: it is spare when it is near the line between
// their far ends, and neither of these goes.
static bool is_on_a_straight_border(const region_grower *g, const uint32_t borders[2], const bool *spare)
{
    const uint32_t far[2] = { twin_of(g, borders[0]), twin_of(g, borders[1]) };
    return !spare[origin_of(g, far[0])] && !spare[origin_of(g, far[1])] &&
           distance_sq_to_line(corner_of(g, far[0]), corner_of(g, far[1]), corner_of(g, borders[0])) <=
               g->distance * g->distance;
}

tl_result tl_hull_find_spare_vertices(const tl_hull_polygons *fine, const tl_vec3 *points, double distance,
                                      tl_arena *arena, tl_stage *stage, bool *spare)
{
    region_grower g = { .fine = fine, .points = points, .distance = distance, .stage = stage };
    TL_TRY(grow_regions(&g, arena));
    // Of each vertex, the borders that start there: how many, and the first two.
    uint32_t *counts = TL_PUSH_ZERO(arena, uint32_t, fine->vertex_count);
    uint32_t *borders = TL_PUSH(arena, uint32_t, 2 * (uint64_t)fine->vertex_count);
    if (counts == NULL || borders == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t h = 0; h < fine->half_edge_count; h++) {
        TL_TRY(tl_stage_tick(stage, h));
        const uint32_t v = origin_of(&g, h);
        if (g.region[fine->half_edges[h].face] != g.region[fine->half_edges[twin_of(&g, h)].face]) {
            if (counts[v] < 2) {
                borders[2 * v + counts[v]] = h;
            }
            counts[v]++;
        }
    }
    for (uint32_t v = 0; v < fine->vertex_count; v++) {
        TL_TRY(tl_stage_tick(stage, v));
        spare[v] = counts[v] == 0 || (counts[v] == 2 && is_on_a_straight_border(&g, borders + 2 * (size_t)v, spare));
    }
    return TL_OK;
}

static uint32_t lowest_on_border(const region_grower *g, uint32_t edge)
{
    uint32_t lowest = edge;
    for (uint32_t h = g->next[edge]; h != edge; h = g->next[h]) {
        lowest = origin_of(g, h) < origin_of(g, lowest) ? h : lowest;
    }
    return lowest;
}

// Faces in the order of (lowest vertex, vertex after it), as the exact ones are.
static tl_result number_regions(const region_grower *g, tl_arena *arena, tl_sort_item *borders, uint32_t count,
                                tl_hull_polygons *out)
{
    const tl_hull_polygons *fine = g->fine;
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, count);
    uint32_t *number = TL_PUSH(arena, uint32_t, fine->half_edge_count);
    out->half_edges = TL_PUSH(arena, tl_hull_half_edge, fine->half_edge_count);
    out->faces = TL_PUSH(arena, tl_hull_face, count);
    out->plane_faces = TL_PUSH(arena, uint32_t, count);
    if (scratch == NULL || number == NULL || out->half_edges == NULL || out->faces == NULL ||
        out->plane_faces == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(tl_radix_sort_in_stage(borders, scratch, count, g->stage));
    uint32_t made = 0;
    for (uint32_t f = 0; f < count; f++) {
        const uint32_t first = made;
        uint32_t edge = borders[f].value;
        do {
            const tl_hull_half_edge half_edge = { origin_of(g, edge), twin_of(g, edge), made + 1, f };
            number[edge] = made;
            out->half_edges[made++] = half_edge;
            edge = g->next[edge];
        } while (edge != borders[f].value);
        TL_TRY(tl_stage_tick(g->stage, f));
        out->half_edges[made - 1].next = first;
        out->faces[f].first = first;
        out->faces[f].count = made - first;
        out->plane_faces[f] = borders[f].extra;
    }
    for (uint32_t h = 0; h < made; h++) {
        out->half_edges[h].twin = number[out->half_edges[h].twin];
    }
    out->vertex_count = fine->vertex_count;
    out->points = fine->points;
    out->face_count = count;
    out->half_edge_count = made;
    return TL_OK;
}

tl_result tl_hull_merge_flat_regions(const tl_hull_polygons *fine, const tl_vec3 *points, float distance,
                                     tl_arena *arena, tl_stage *stage, tl_hull_polygons *merged_out)
{
    region_grower g = {
        .fine = fine, .points = points, .distance = (double)distance, .keeps_corners = true, .stage = stage
    };
    TL_TRY(grow_regions(&g, arena));
    tl_sort_item *borders = TL_PUSH(arena, tl_sort_item, fine->face_count);
    bool *is_taken = TL_PUSH_ZERO(arena, bool, fine->face_count);
    if (borders == NULL || is_taken == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(merged_out, 0, sizeof *merged_out);
    merged_out->exact = fine;
    merged_out->merge_distance = distance;
    uint32_t count = 0;
    for (uint32_t h = 0; h < fine->half_edge_count; h++) {
        TL_TRY(tl_stage_tick(stage, h));
        const uint32_t region = g.region[fine->half_edges[h].face];
        if (!is_taken[region] && g.region[fine->half_edges[twin_of(&g, h)].face] != region) {
            const uint32_t lowest = lowest_on_border(&g, h);
            is_taken[region] = true;
            borders[count].key = (uint64_t)origin_of(&g, lowest) << 32 | origin_of(&g, g.next[lowest]);
            borders[count].value = lowest;
            borders[count++].extra = region;
        }
    }
    return number_regions(&g, arena, borders, count, merged_out);
}
