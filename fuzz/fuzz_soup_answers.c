// SPDX-License-Identifier: MIT
//
// Any few triangles and any rays: a soup's answers are defined by the triangles alone. So all layouts, trees and
// qualities give the same bits, batches those of single calls, and the closest hit is that of soups of one triangle
// each. Coordinates are mostly small integers, so that much lies in one plane, on one edge or in one point.

#include "fuzz/fuzz_input.h"

#include <math.h>
#include <string.h>
#include <talus/soup.h>

enum { MAX_VERTICES = 24, MAX_TRIANGLES = 48, MAX_RAYS = 40, SOUPS = 6 };

typedef struct input {
    fuzz_bytes bytes;
    tl_vec3 vertices[MAX_VERTICES];
    uint32_t indices[3 * MAX_TRIANGLES];
    uint16_t materials[MAX_TRIANGLES];
    tl_mesh_view view;
    tl_soup *soups[SOUPS];
    tl_soup *single[MAX_TRIANGLES]; // NULL: the triangle has no area
    tl_ray rays[MAX_RAYS];
    uint32_t ray_count;
    tl_ray_filter filter;
} input;

static float next_raw_float(input *in)
{
    uint8_t bytes[4];
    for (uint32_t i = 0; i < 4; i++) {
        bytes[i] = next_byte(&in->bytes);
    }
    float value;
    memcpy(&value, bytes, sizeof value);
    return value;
}

static float next_coordinate(input *in)
{
    const uint8_t kind = next_byte(&in->bytes);
    const float small = (float)(kind % 16) - 8.0f;
    switch (kind / 16) {
    case 12:
        return small * 0.1f;
    case 13:
        return ldexpf(small, (int)next_byte(&in->bytes) - 128);
    case 14:
        return nextafterf(small, INFINITY);
    case 15:
        return next_raw_float(in);
    default:
        return small;
    }
}

static tl_vec3 next_vector(input *in)
{
    const float x = next_coordinate(in), y = next_coordinate(in);
    return tl_vec3_make(x, y, next_coordinate(in));
}

static void read_triangles(input *in)
{
    const uint32_t vertex_count = 3 + next_byte(&in->bytes) % (MAX_VERTICES - 2);
    const uint32_t triangle_count = 1 + next_byte(&in->bytes) % MAX_TRIANGLES;
    for (uint32_t i = 0; i < vertex_count; i++) {
        in->vertices[i] = next_vector(in);
    }
    for (uint32_t i = 0; i < 3 * triangle_count; i++) {
        in->indices[i] = next_byte(&in->bytes) % vertex_count;
    }
    for (uint32_t i = 0; i < triangle_count; i++) {
        in->materials[i] = (uint16_t)(i % 5);
    }
    const tl_mesh_view view = { in->vertices, vertex_count, in->indices, triangle_count, in->materials };
    in->view = view;
}

// The same soup in all ways that there are. Whether the triangles are refused does not depend on the way.
static bool bake_soups(input *in)
{
    static const struct {
        bool pairs;
        tl_soup_partition partition;
        tl_soup_layout layout;
        tl_soup_quality quality;
        float split_budget;
    } ways[SOUPS] = {
        { true, TL_SOUP_BVH, TL_SOUP_FAST, TL_SOUP_QUALITY_DEFAULT, 0.0f },
        { true, TL_SOUP_BVH, TL_SOUP_COMPACT, TL_SOUP_QUALITY_FAST, 0.0f },
        { false, TL_SOUP_BVH, TL_SOUP_FAST, TL_SOUP_QUALITY_FAST, 0.0f },
        { true, TL_SOUP_BVH, TL_SOUP_FAST, TL_SOUP_QUALITY_FAST, 1.0f },
        { true, TL_SOUP_BVH, TL_SOUP_COMPACT, TL_SOUP_QUALITY_HIGH, 0.5f },
        { true, TL_SOUP_KD_TREE, TL_SOUP_FAST, TL_SOUP_QUALITY_DEFAULT, 0.0f },
    };
    tl_result first = TL_OK;
    for (uint32_t i = 0; i < SOUPS; i++) {
        tl_soup_def def = tl_default_soup_def();
        def.pair_triangles = ways[i].pairs;
        def.partition = ways[i].partition;
        def.layout = ways[i].layout;
        def.quality = ways[i].quality;
        def.split_budget = ways[i].split_budget;
        tl_soup_report report;
        const tl_result result = tl_soup_bake(&in->view, &def, &in->soups[i], &report);
        first = i == 0 ? result : first;
        require(result == first && (result == TL_OK) == (in->soups[i] != NULL));
        require(result != TL_OK || tl_soup_check(in->soups[i], tl_soup_size(in->soups[i]), NULL) == TL_OK);
    }
    return first == TL_OK;
}

static void bake_singles(input *in)
{
    for (uint32_t i = 0; i < in->view.triangle_count; i++) {
        const tl_mesh_view one = { in->vertices, in->view.vertex_count, in->indices + 3 * (size_t)i, 1,
                                   in->materials + i };
        const tl_result result = tl_soup_bake(&one, NULL, &in->single[i], NULL);
        require(result == TL_OK || result == TL_ERR_DEGENERATE);
    }
}

// Rays, half of them aimed at a vertex, so that edges and corners are met.
static void read_rays(input *in)
{
    in->ray_count = 1 + next_byte(&in->bytes) % MAX_RAYS;
    for (uint32_t i = 0; i < in->ray_count; i++) {
        tl_ray *ray = &in->rays[i];
        ray->origin = next_vector(in);
        const uint8_t aim = next_byte(&in->bytes);
        ray->direction = aim < 128 ? tl_sub(in->vertices[aim % in->view.vertex_count], ray->origin) : next_vector(in);
        ray->tmax = aim % 3 == 0 ? 1.0f : aim % 3 == 1 ? INFINITY : fabsf(next_coordinate(in));
    }
    const uint8_t kind = next_byte(&in->bytes);
    in->filter.cull = (tl_ray_cull)(kind % 3);
    in->filter.ignored_materials = kind / 3 % 8;
}

static bool same_bits(const tl_ray_hit *a, const tl_ray_hit *b)
{
    return memcmp(&a->t, &b->t, sizeof a->t) == 0 && a->triangle == b->triangle &&
           memcmp(&a->u, &b->u, sizeof a->u) == 0 && memcmp(&a->v, &b->v, sizeof a->v) == 0 &&
           memcmp(&a->normal, &b->normal, sizeof a->normal) == 0 && a->material == b->material && a->back == b->back;
}

// The closest hit by a loop over soups of one triangle.
static bool closest_of_singles(const input *in, const tl_ray *ray, tl_ray_hit *closest)
{
    bool found = false;
    for (uint32_t i = 0; i < in->view.triangle_count; i++) {
        tl_ray_hit hit;
        if (in->single[i] != NULL && tl_soup_cast_ray(in->single[i], ray, &in->filter, &hit) &&
            (!found || hit.t < closest->t)) {
            *closest = hit;
            closest->triangle = i;
            found = true;
        }
    }
    return found;
}

static void check_all_hits(const input *in, const tl_soup *soup, const tl_ray *ray, bool is_hit,
                           const tl_ray_hit *closest)
{
    tl_ray_hit all[MAX_TRIANGLES];
    uint32_t count = 0;
    const tl_result result = tl_soup_cast_ray_all(soup, ray, TL_HITS_TOUCHED, &in->filter, all, MAX_TRIANGLES, &count);
    if (result == TL_OK) {
        require((count > 0) == is_hit && (count == 0 || same_bits(&all[0], closest)));
        for (uint32_t i = 1; i < count; i++) {
            require(all[i - 1].t < all[i].t || (all[i - 1].t == all[i].t && all[i - 1].triangle < all[i].triangle));
        }
    } else {
        require((result == TL_ERR_NOT_FINITE || result == TL_ERR_ARGUMENT) && !is_hit);
    }
}

static void check_ray(const input *in, const tl_ray *ray)
{
    tl_ray_hit expected = { 0 };
    const bool is_hit = closest_of_singles(in, ray, &expected);
    for (uint32_t i = 0; i < SOUPS; i++) {
        tl_ray_hit hit;
        require(tl_soup_cast_ray(in->soups[i], ray, &in->filter, &hit) == is_hit);
        require(!is_hit || same_bits(&hit, &expected));
        require(tl_soup_occluded(in->soups[i], ray, &in->filter) == is_hit);
        check_all_hits(in, in->soups[i], ray, is_hit, &expected);
    }
}

// The segment that the ray's origin and direction span, both ways.
static void check_segment(const input *in, const tl_ray *ray)
{
    const tl_vec3 a = ray->origin, b = tl_add(ray->origin, ray->direction);
    tl_ray_hit expected = { 0 };
    const bool is_hit = tl_soup_cast_segment(in->soups[0], a, b, NULL, &expected);
    for (uint32_t i = 0; i < SOUPS; i++) {
        tl_ray_hit hit;
        require(tl_soup_cast_segment(in->soups[i], a, b, NULL, &hit) == is_hit);
        require(!is_hit || (same_bits(&hit, &expected) && hit.t >= 0.0f && hit.t <= 1.0f));
        require(tl_soup_line_of_sight(in->soups[i], a, b, NULL) == !is_hit);
        require(tl_soup_line_of_sight(in->soups[i], b, a, NULL) == !is_hit);
    }
}

static void check_batches(const input *in)
{
    tl_ray_hit hits[MAX_RAYS];
    bool occluded[MAX_RAYS];
    for (uint32_t i = 0; i < SOUPS; i++) {
        tl_soup_cast_rays(in->soups[i], in->rays, in->ray_count, NULL, NULL, hits);
        tl_soup_occluded_rays(in->soups[i], in->rays, in->ray_count, NULL, NULL, occluded);
        for (uint32_t k = 0; k < in->ray_count; k++) {
            tl_ray_hit hit;
            const bool is_hit = tl_soup_cast_ray(in->soups[i], &in->rays[k], NULL, &hit);
            require(is_hit ? same_bits(&hit, &hits[k]) : hits[k].triangle == TL_NO_TRIANGLE);
            require(occluded[k] == is_hit);
        }
    }
}

static void check_point(const input *in, tl_vec3 point)
{
    tl_soup_point expected;
    const tl_result result = tl_soup_nearest(in->soups[0], point, INFINITY, NULL, &expected);
    require(result == TL_OK || result == TL_ERR_NOT_FINITE);
    for (uint32_t i = 1; i < SOUPS; i++) {
        tl_soup_point found;
        require(tl_soup_nearest(in->soups[i], point, INFINITY, NULL, &found) == result);
        require(result != TL_OK || (found.triangle == expected.triangle && found.feature == expected.feature &&
                                    memcmp(&found.distance, &expected.distance, sizeof found.distance) == 0));
    }
}

static void free_soups(input *in)
{
    for (uint32_t i = 0; i < SOUPS; i++) {
        tl_blob_free(in->soups[i]);
    }
    for (uint32_t i = 0; i < MAX_TRIANGLES; i++) {
        tl_blob_free(in->single[i]);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static input in;
    memset(&in, 0, sizeof in);
    in.bytes = (fuzz_bytes){ data, size };
    read_triangles(&in);
    if (bake_soups(&in)) {
        bake_singles(&in);
        read_rays(&in);
        for (uint32_t i = 0; i < in.ray_count; i++) {
            check_ray(&in, &in.rays[i]);
            check_segment(&in, &in.rays[i]);
            check_point(&in, in.rays[i].origin);
        }
        check_batches(&in);
    }
    free_soups(&in);
    return 0;
}
