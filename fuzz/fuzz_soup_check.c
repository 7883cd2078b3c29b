// SPDX-License-Identifier: MIT
//
// Untrusted bytes as a soup: what tl_soup_check accepts can be queried, ends, and agrees with itself.
//
// Raw mutations of a valid file rarely get past the counts, so an input is a list of edits (offset, byte) to a soup
// that is baked here, in the layout that the first byte's lowest bit selects; an input that begins with 0xff is the
// soup's bytes themselves.

#define _POSIX_C_SOURCE 200112L

#include "fuzz/fuzz_input.h"

#include <string.h>
#include <talus/soup.h>

static tl_soup *build_sample(tl_soup_layout layout)
{
    // A fan around one edge, a strip, and loose triangles: pairs, singles, several leaves and nodes.
    tl_vec3 vertices[120];
    uint32_t indices[3 * 80];
    uint32_t state = 1;
    for (uint32_t i = 0; i < 120; i++) {
        float c[3];
        for (uint32_t k = 0; k < 3; k++) {
            state = state * 1664525u + 1013904223u;
            c[k] = (float)(state >> 16) / 8192.0f - 4.0f;
        }
        vertices[i] = tl_vec3_make(c[0], c[1], c[2]);
    }
    for (uint32_t i = 0; i < 80; i++) {
        indices[3 * i] = i < 10 ? 0 : i;
        indices[3 * i + 1] = i < 10 ? 1 : i + 1;
        indices[3 * i + 2] = i < 40 ? i + 2 : i + 30;
    }
    tl_mesh_view view = { vertices, 120, indices, 80, NULL };
    tl_soup_def def = tl_default_soup_def();
    def.layout = layout;
    tl_soup *soup = NULL;
    return tl_soup_bake(&view, &def, &soup, NULL) == TL_OK ? soup : NULL;
}

static bool count_triangle(const tl_soup_triangle *triangle, void *user)
{
    (void)triangle;
    ++*(uint32_t *)user;
    return true;
}

static bool count_box(tl_aabb box, uint32_t depth, bool leaf, void *user)
{
    (void)box;
    (void)depth;
    (void)leaf;
    ++*(uint32_t *)user;
    return true;
}

static void use_soup(const tl_soup *soup)
{
    tl_soup_stats stats = tl_soup_get_stats(soup);
    for (int i = 0; i < 27; i++) {
        tl_ray ray = { { 0.1f, 0.2f, 0.3f },
                       { (float)(i % 3 - 1), (float)(i / 3 % 3 - 1), (float)(i / 9 - 1) },
                       INFINITY };
        tl_ray_hit hit;
        bool found = tl_soup_cast_ray(soup, &ray, NULL, &hit);
        require(!found || hit.triangle < stats.source_triangle_count);
        (void)tl_soup_occluded(soup, &ray, NULL);
        (void)tl_soup_line_of_sight(soup, ray.origin, ray.direction, NULL);
    }
    uint64_t cursor = 0;
    uint32_t count = 0;
    tl_soup_triangle triangle;
    while (tl_soup_next_triangle(soup, &cursor, &triangle)) {
        count++;
    }
    require(count == stats.triangle_count);
    tl_soup_pair pair;
    for (cursor = 0, count = 0; tl_soup_next_pair(soup, &cursor, &pair);) {
        count++;
    }
    require(count == stats.pair_count + stats.single_count);
    (void)tl_soup_triangles_in_box(soup, tl_soup_bounds(soup), count_triangle, &count);
    count = 0;
    (void)tl_soup_bvh_boxes(soup, UINT32_MAX, count_box, &count);
    require(count == stats.node_count + stats.leaf_count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static tl_soup *samples[2]; // baked once; never freed
    tl_soup_layout layout = size > 0 && (data[0] & 1) != 0 ? TL_SOUP_COMPACT : TL_SOUP_FAST;
    if (samples[layout] == NULL) {
        samples[layout] = build_sample(layout);
        require(samples[layout] != NULL);
    }
    const tl_soup *sample = samples[layout];
    bool raw = size > 0 && data[0] == 0xff;
    size_t bytes = raw ? size - 1 : (size_t)tl_soup_size(sample);
    uint8_t *block = NULL;
    if (posix_memalign((void **)&block, TL_BLOB_ALIGNMENT, bytes + (bytes == 0)) != 0) {
        return 0;
    }
    if (raw) {
        memcpy(block, data + 1, bytes);
    } else {
        memcpy(block, sample, bytes);
        for (size_t i = 0; i + 3 <= size; i += 3) {
            block[((size_t)data[i] << 8 | data[i + 1]) % bytes] = data[i + 2];
        }
    }
    if (tl_soup_check(block, bytes, NULL) == TL_OK) {
        use_soup((const tl_soup *)(const void *)block);
    }
    free(block);
    return 0;
}
