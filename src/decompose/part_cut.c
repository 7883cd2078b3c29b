// SPDX-License-Identifier: MIT
//
// Cutting a piece of the mesh by a plane: triangles that cross it are divided, the others go to their side.
//
// A point where an edge crosses is rounded to floats, and both sides get the same one; so what a cut costs is that
// rounding, and the hulls of both sides touch. No cap is needed: the hull of a cut solid's border holds the section.
//
// Source: Sutherland, Hodgman, Reentrant Polygon Clipping, 1974.

#include "base/assert.h"
#include "decompose/part.h"

#include <string.h>

void tl_part_free(tl_part *part, const tl_allocator *allocator)
{
    tl_release_array(allocator, part->corners, 3 * (uint64_t)part->triangle_count, sizeof *part->corners);
    tl_blob_free(part->hull);
    memset(part, 0, sizeof *part);
}

tl_result tl_part_allocate(uint64_t triangle_count, const tl_allocator *allocator, tl_part *part)
{
    memset(part, 0, sizeof *part);
    part->concavity = (double)INFINITY;
    if (triangle_count == 0) {
        return TL_OK;
    }
    if (triangle_count > TL_MAX_SOUP_TRIANGLES) {
        return TL_ERR_LIMIT;
    }
    part->corners = tl_allocate_array(allocator, 3 * triangle_count, sizeof *part->corners);
    part->triangle_count = part->corners != NULL ? (uint32_t)triangle_count : 0;
    return part->corners != NULL ? TL_OK : TL_ERR_MEMORY;
}

tl_result tl_part_from_soup(const tl_soup *soup, uint32_t triangle_count, const tl_allocator *allocator, tl_part *part)
{
    TL_TRY(tl_part_allocate(triangle_count, allocator, part));
    uint64_t cursor = 0;
    tl_soup_triangle triangle;
    for (uint32_t i = 0; i < triangle_count && tl_soup_next_triangle(soup, &cursor, &triangle); i++) {
        memcpy(part->corners + 3 * (size_t)i, triangle.corners, sizeof triangle.corners);
    }
    return TL_OK;
}

// A triangle's corners around a plane, turned so that corner 0 is alone on its side, if one is.
typedef struct cut_triangle {
    tl_vec3 corners[3];
    double heights[3];
    bool is_above, is_below; // it reaches there
    bool is_lone_above;
} cut_triangle;

static void turn_triangle(cut_triangle *t, const tl_vec3 *corners, const double *heights, uint32_t first)
{
    for (uint32_t i = 0; i < 3; i++) {
        t->corners[i] = corners[(first + i) % 3];
        t->heights[i] = heights[(first + i) % 3];
    }
}

static void place_triangle(const tl_vec3 *corners, const tl_cut_plane *plane, cut_triangle *t)
{
    double heights[3];
    uint32_t above = 0, below = 0;
    for (uint32_t i = 0; i < 3; i++) {
        heights[i] = tl_vec3d_dot(plane->normal, tl_vec3d_from(corners[i])) - plane->offset;
        above |= (heights[i] > 0.0 ? 1u : 0u) << i;
        below |= (heights[i] < 0.0 ? 1u : 0u) << i;
    }
    t->is_above = above != 0;
    t->is_below = below != 0;
    // One corner alone above or below, or, with a corner in the plane, either of the two others.
    static const uint8_t lone[8] = { 0, 0, 1, 0, 2, 0, 0, 0 };
    const bool one_above = above == 1 || above == 2 || above == 4;
    t->is_lone_above = one_above;
    turn_triangle(t, corners, heights, lone[one_above ? above : below]);
}

static bool comes_first(tl_vec3 a, tl_vec3 b)
{
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// Where an edge meets the plane, the same from both of its triangles.
static tl_vec3 cross_edge(tl_vec3 a, double height_a, tl_vec3 b, double height_b)
{
    if (height_b == 0.0) {
        return b;
    }
    if (comes_first(b, a)) {
        const tl_vec3 swapped = a;
        const double swapped_height = height_a;
        a = b, b = swapped;
        height_a = height_b, height_b = swapped_height;
    }
    const tl_vec3d from = tl_vec3d_from(a), along = tl_vec3d_sub(tl_vec3d_from(b), from);
    return tl_vec3d_to_float(tl_vec3d_mul_add(from, along, height_a / (height_a - height_b)));
}

static void put_triangle(tl_part *part, tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    tl_vec3 *at = part->corners + 3 * (size_t)part->triangle_count++;
    at[0] = a;
    at[1] = b;
    at[2] = c;
}

// Divides a triangle that reaches above and below.
static void divide_across_plane(const cut_triangle *t, tl_part halves[2])
{
    const tl_vec3 a = t->corners[0], b = t->corners[1], c = t->corners[2];
    const tl_vec3 ab = cross_edge(a, t->heights[0], b, t->heights[1]);
    const tl_vec3 ac = cross_edge(a, t->heights[0], c, t->heights[2]);
    tl_part *lone = &halves[t->is_lone_above ? 1 : 0], *rest = &halves[t->is_lone_above ? 0 : 1];
    put_triangle(lone, a, ab, ac);
    if (t->heights[1] != 0.0) {
        put_triangle(rest, ab, b, c);
    }
    if (t->heights[2] != 0.0) {
        put_triangle(rest, ab, c, ac);
    }
}

// How many triangles each side gets.
static void count_halves(const tl_part *part, const tl_cut_plane *plane, uint64_t counts[2])
{
    cut_triangle t;
    counts[0] = counts[1] = 0;
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        place_triangle(part->corners + 3 * (size_t)i, plane, &t);
        const bool is_cut = t.is_above && t.is_below;
        const uint64_t rest = (t.heights[1] != 0.0 ? 1u : 0u) + (t.heights[2] != 0.0 ? 1u : 0u);
        counts[0] += !is_cut ? !t.is_above : t.is_lone_above ? rest : 1;
        counts[1] += !is_cut ? t.is_above : t.is_lone_above ? 1 : rest;
    }
}

tl_result tl_part_cut(const tl_part *part, const tl_cut_plane *plane, const tl_allocator *allocator, tl_part halves[2])
{
    uint64_t counts[2];
    count_halves(part, plane, counts);
    memset(halves, 0, 2 * sizeof *halves);
    for (uint32_t i = 0; i < 2; i++) {
        const tl_result result = tl_part_allocate(counts[i], allocator, &halves[i]);
        if (result != TL_OK) {
            tl_part_free(&halves[0], allocator);
            return result;
        }
    }
    for (uint32_t i = 0; i < 2; i++) {
        halves[i].triangle_count = 0;
        halves[i].cut_count = part->cut_count + 1;
    }
    cut_triangle t;
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const tl_vec3 *corners = part->corners + 3 * (size_t)i;
        place_triangle(corners, plane, &t);
        if (t.is_above && t.is_below) {
            divide_across_plane(&t, halves);
        } else { // one in the plane goes below
            put_triangle(&halves[t.is_above ? 1 : 0], corners[0], corners[1], corners[2]);
        }
    }
    TL_ASSERT(halves[0].triangle_count == counts[0] && halves[1].triangle_count == counts[1]);
    return TL_OK;
}
