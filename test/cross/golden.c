// SPDX-License-Identifier: MIT
//
// The program: digests, the level, and the order of the kinds. A line of output is "kind part hash answers".

#include "golden.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

digest digest_begin(void)
{
    digest d = { 0xcbf29ce484222325u, 0 };
    return d;
}

void digest_bytes(digest *d, const void *bytes, uint64_t size)
{
    const uint8_t *at = bytes;
    for (uint64_t i = 0; i < size; i++) {
        d->hash = (d->hash ^ at[i]) * 0x100000001b3u;
    }
}

void digest_u32(digest *d, uint32_t value)
{
    const uint8_t bytes[4] = { (uint8_t)value, (uint8_t)(value >> 8), (uint8_t)(value >> 16), (uint8_t)(value >> 24) };
    digest_bytes(d, bytes, sizeof bytes);
}

void digest_u64(digest *d, uint64_t value)
{
    digest_u32(d, (uint32_t)value);
    digest_u32(d, (uint32_t)(value >> 32));
}

void digest_f32(digest *d, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    digest_u32(d, bits);
}

void digest_f64(digest *d, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    digest_u64(d, bits);
}

void digest_vec3(digest *d, tl_vec3 value)
{
    digest_f32(d, value.x);
    digest_f32(d, value.y);
    digest_f32(d, value.z);
}

void digest_blob(digest *d, const void *blob)
{
    const uint64_t size = ((const tl_blob *)blob)->size;
    void *copy = malloc((size_t)size);
    must(copy != NULL ? TL_OK : TL_ERR_MEMORY, "malloc");
    memcpy(copy, blob, (size_t)size);
    MUST(tl_blob_to_file_order(copy, size, NULL));
    digest_bytes(d, copy, size);
    MUST(tl_blob_to_host_order(copy, size, NULL));
    must(memcmp(copy, blob, (size_t)size) == 0 ? TL_OK : TL_ERR_CORRUPT, "a blob's way to the file and back");
    free(copy);
    d->found++;
}

bool digest_result(digest *d, tl_result result)
{
    digest_u32(d, (uint32_t)result);
    d->found += result == TL_OK ? 1 : 0;
    return result == TL_OK;
}

bool digest_found(digest *d, bool found)
{
    digest_u32(d, found ? 1 : 0);
    d->found += found ? 1 : 0;
    return found;
}

void digest_print(const digest *d, const char *kind, const char *part)
{
    printf("%-16s %-12s %08x%08x %lu\n", kind, part, (unsigned)(d->hash >> 32), (unsigned)(d->hash & 0xffffffffu),
           (unsigned long)d->found);
    fflush(stdout);
    if (d->found == 0) {
        fprintf(stderr, "golden: %s %s: nothing was found, so its hash shows nothing\n", kind, part);
        exit(1);
    }
}

void must(tl_result result, const char *what)
{
    if (result != TL_OK) {
        fprintf(stderr, "golden: %s gives %s\n", what, tl_result_name(result));
        exit(1);
    }
}

// SplitMix64.
uint32_t roll(dice *d, uint32_t sides)
{
    d->state += 0x9e3779b97f4a7c15u;
    uint64_t z = d->state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)((z >> 32) % sides);
}

float roll_between(dice *d, float low, float high)
{
    const uint32_t steps = (uint32_t)((high - low) * 1024.0f) + 1;
    return low + (float)roll(d, steps) / 1024.0f;
}

tl_vec3 roll_in_box(dice *d, tl_aabb box)
{
    const float x = roll_between(d, box.min.x, box.max.x);
    const float y = roll_between(d, box.min.y, box.max.y);
    const float z = roll_between(d, box.min.z, box.max.z);
    return tl_vec3_make(x, y, z);
}

tl_quat roll_rotation(dice *d)
{
    tl_quat q;
    q.x = roll_between(d, -1, 1);
    q.y = roll_between(d, -1, 1);
    q.z = roll_between(d, -1, 1);
    q.w = roll_between(d, -1, 1);
    return tl_quat_normalize(q);
}

// ---------------------------------------------------------------------------------------------------------
// The level.

static void *grow(void *array, uint32_t count, uint32_t *capacity, size_t size)
{
    if (count < *capacity) {
        return array;
    }
    *capacity = *capacity > 0 ? 2 * *capacity : 1024;
    void *grown = realloc(array, *capacity * size);
    must(grown != NULL ? TL_OK : TL_ERR_MEMORY, "realloc");
    return grown;
}

static void add_triangle(level *made, tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    const tl_vec3 corners[3] = { a, b, c };
    made->indices = grow(made->indices, made->triangle_count, &made->triangle_capacity, 3 * sizeof *made->indices);
    for (int i = 0; i < 3; i++) {
        made->vertices = grow(made->vertices, made->vertex_count, &made->vertex_capacity, sizeof *made->vertices);
        made->vertices[made->vertex_count] = corners[i];
        made->indices[3 * (size_t)made->triangle_count + (size_t)i] = made->vertex_count++;
    }
    made->triangle_count++;
}

static void add_quad(level *made, tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d)
{
    add_triangle(made, a, b, c);
    add_triangle(made, a, c, d);
}

static void add_box(level *made, tl_vec3 low, tl_vec3 high)
{
    tl_vec3 p[8];
    for (int i = 0; i < 8; i++) {
        p[i] =
            tl_vec3_make((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
    }
    static const uint8_t SIDES[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                         { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    for (int i = 0; i < 6; i++) {
        add_quad(made, p[SIDES[i][0]], p[SIDES[i][1]], p[SIDES[i][2]], p[SIDES[i][3]]);
    }
}

/// Uneven ground: a grid of 2 m whose heights differ by up to a quarter of a metre.
static void add_ground(level *made, dice *d)
{
    enum { SIDE = 20 };
    float heights[SIDE + 1][SIDE + 1];
    for (int z = 0; z <= SIDE; z++) {
        for (int x = 0; x <= SIDE; x++) {
            heights[z][x] = roll_between(d, 0, 0.25f);
        }
    }
    for (int z = 0; z < SIDE; z++) {
        for (int x = 0; x < SIDE; x++) {
            const float x0 = (float)(2 * x), x1 = x0 + 2, z0 = (float)(2 * z), z1 = z0 + 2;
            add_quad(made, tl_vec3_make(x0, heights[z][x], z0), tl_vec3_make(x0, heights[z + 1][x], z1),
                     tl_vec3_make(x1, heights[z + 1][x + 1], z1), tl_vec3_make(x1, heights[z][x + 1], z0));
        }
    }
}

/// Ten steps up to a gallery, which stands on the pillars and ends in a ramp.
static void add_gallery(level *made)
{
    for (int i = 0; i < 10; i++) {
        const float x = 4 + 0.5f * (float)i;
        add_box(made, tl_vec3_make(x, 0, 4), tl_vec3_make(x + 0.5f, 0.3f * (float)(i + 1), 7));
    }
    add_box(made, tl_vec3_make(9, 2.75f, 4), tl_vec3_make(30, 3, 9));
    add_quad(made, tl_vec3_make(24, 3, 9), tl_vec3_make(24, 0, 18), tl_vec3_make(28, 0, 18), tl_vec3_make(28, 3, 9));
}

level level_make(uint64_t seed)
{
    level made;
    memset(&made, 0, sizeof made);
    dice d = { seed };
    add_ground(&made, &d);
    add_gallery(&made);
    for (int i = 0; i < 24; i++) {
        const float x = roll_between(&d, 2, 36), z = roll_between(&d, 12, 36);
        const float side = roll_between(&d, 0.5f, 2), height = roll_between(&d, 0.25f, 4);
        add_box(&made, tl_vec3_make(x, -0.5f, z), tl_vec3_make(x + side, height, z + side));
    }
    // Loose triangles in the air: small ones, needles, and some without any area.
    const tl_aabb air = { { 0, 5, 0 }, { 40, 12, 40 } };
    for (int i = 0; i < 400; i++) {
        const tl_vec3 at = roll_in_box(&d, air);
        const float size = i % 10 == 0 ? 16.0f : 1.0f;
        const tl_aabb near = { tl_vec3_make(-size, -1, -1), tl_vec3_make(size, 1, 1) };
        const tl_vec3 b = tl_add(at, roll_in_box(&d, near));
        add_triangle(&made, at, b, i % 50 == 0 ? b : tl_add(at, roll_in_box(&d, near)));
    }
    return made;
}

void level_free(level *made)
{
    free(made->vertices);
    free(made->indices);
    memset(made, 0, sizeof *made);
}

tl_mesh_view level_view(const level *made)
{
    tl_mesh_view view = { made->vertices, made->vertex_count, made->indices, made->triangle_count, NULL };
    return view;
}

int main(void)
{
    level made = level_make(2026);
    tl_mesh_view view = level_view(&made);
    tl_soup *soup;
    MUST(tl_soup_bake(&view, NULL, &soup, NULL));

    golden_meshes(&view);
    golden_soups(&view);
    golden_scene(soup);
    golden_characters(soup);
    golden_hulls();
    golden_pairs();
    golden_polygons();
    golden_decompositions(&view);
    golden_navmeshes(&view, soup);
    golden_world(&view);

    tl_blob_free(soup);
    level_free(&made);
    return 0;
}
