// SPDX-License-Identifier: MIT
//
// A fixed amount of one kind of work, for counting its instructions and timing it on machines that have nothing but a
// C library: tools/bench-simd builds it with and without SIMD and compares.
//
//   simd_work KIND COUNT    KIND is one of the list that simd_work prints without arguments
//
// With COUNT 0 only the preparation is done, to be subtracted. It prints a hash of the answers, which must be the same
// with and without SIMD, and the seconds that the work took.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/talus.h>
#include <time.h>

static uint64_t answers = 0xcbf29ce484222325u;

// Cheap, so that the hash is little of the work.
static inline void note(uint64_t value)
{
    answers = (answers ^ value) * 0x9e3779b97f4a7c15u;
}

static inline void note_float(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    note(bits);
}

static void note_blob(const void *blob)
{
    uint64_t size = ((const tl_blob *)blob)->size, word;
    for (uint64_t i = 0; i + 8 <= size; i += 8) {
        memcpy(&word, (const char *)blob + i, 8);
        note(word);
    }
}

static void must(tl_result result)
{
    if (result != TL_OK) {
        fprintf(stderr, "simd_work: %s\n", tl_result_name(result));
        exit(1);
    }
}

// SplitMix64.
static uint64_t dice = 1;

static uint32_t roll(uint32_t sides)
{
    dice += 0x9e3779b97f4a7c15u;
    uint64_t z = dice;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)((z >> 32) % sides);
}

static float between(float low, float high)
{
    return low + (high - low) * ((float)roll(1u << 20) / 1048576.0f);
}

static tl_vec3 point_in(tl_aabb box)
{
    float x = between(box.min.x, box.max.x), y = between(box.min.y, box.max.y), z = between(box.min.z, box.max.z);
    return tl_vec3_make(x, y, z);
}

static tl_vec3 direction(void)
{
    tl_aabb cube = { { -1, -1, -1 }, { 1, 1, 1 } };
    tl_vec3 d;
    do {
        d = point_in(cube);
    } while (!(tl_dot(d, d) <= 1.0f && tl_dot(d, d) > 0.01f));
    return d;
}

// A level: hilly ground of SIDE x SIDE cells of a metre, and boxes and walls that stand on it.

enum {
    SIDE = 96,
    BOXES = 500,
    MAX_VERTICES = (SIDE + 1) * (SIDE + 1) + 8 * BOXES,
    MAX_TRIANGLES = 2 * SIDE * SIDE + 12 * BOXES
};

static tl_vec3 vertices[MAX_VERTICES];
static uint32_t indices[3 * MAX_TRIANGLES];
static tl_mesh_view level = { vertices, 0, indices, 0, NULL };

static void add_triangle(uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *to = indices + 3 * (size_t)level.triangle_count++;
    to[0] = a;
    to[1] = b;
    to[2] = c;
}

static void add_box(tl_vec3 low, tl_vec3 high)
{
    static const uint8_t sides[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                         { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    uint32_t first = level.vertex_count;
    for (uint32_t i = 0; i < 8; i++) {
        vertices[level.vertex_count++] =
            tl_vec3_make((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
    }
    for (int i = 0; i < 6; i++) {
        add_triangle(first + sides[i][0], first + sides[i][1], first + sides[i][2]);
        add_triangle(first + sides[i][0], first + sides[i][2], first + sides[i][3]);
    }
}

static void make_level(void)
{
    for (uint32_t z = 0; z <= SIDE; z++) {
        for (uint32_t x = 0; x <= SIDE; x++) {
            vertices[level.vertex_count++] = tl_vec3_make((float)x, between(0.0f, 0.3f), (float)z);
        }
    }
    for (uint32_t z = 0; z < SIDE; z++) {
        for (uint32_t x = 0; x < SIDE; x++) {
            uint32_t a = z * (SIDE + 1) + x, b = a + SIDE + 1;
            add_triangle(a, b, b + 1);
            add_triangle(a, b + 1, a + 1);
        }
    }
    for (int i = 0; i < BOXES; i++) {
        float x = between(1, SIDE - 6), z = between(1, SIDE - 6), high = between(0.5f, 6);
        float wide = i % 3 == 0 ? 5.0f : 1.0f, deep = i % 3 == 1 ? 5.0f : 1.0f;
        add_box(tl_vec3_make(x, -0.5f, z), tl_vec3_make(x + wide, high, z + deep));
    }
}

static tl_soup *bake_soup(tl_soup_layout layout)
{
    tl_soup_def def = tl_default_soup_def();
    def.layout = layout;
    tl_soup *soup;
    must(tl_soup_bake(&level, &def, &soup, NULL));
    return soup;
}

// What is asked is made beforehand: a thousand of each, again and again.
enum { QUESTIONS = 1024 };
static tl_vec3 directions[QUESTIONS], starts[QUESTIONS], ends[QUESTIONS];

static void make_questions(tl_aabb box)
{
    for (uint32_t i = 0; i < QUESTIONS; i++) {
        directions[i] = direction();
        starts[i] = point_in(box);
        ends[i] = point_in(box);
    }
}

static clock_t began;

static void note_hit(const tl_ray_hit *hit)
{
    note_float(hit->t);
    note(hit->triangle);
    note_float(hit->u);
}

static void cast_rays(tl_soup_layout layout, uint32_t count)
{
    tl_soup *soup = bake_soup(layout);
    make_questions(tl_soup_bounds(soup));
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        tl_ray ray = { starts[i % QUESTIONS], directions[i % QUESTIONS], INFINITY };
        tl_ray_hit hit;
        if (tl_soup_cast_ray(soup, &ray, NULL, &hit)) {
            note_hit(&hit);
        }
    }
    tl_blob_free(soup);
}

static void rays(uint32_t count)
{
    cast_rays(TL_SOUP_FAST, count);
}

static void rays_compact(uint32_t count)
{
    cast_rays(TL_SOUP_COMPACT, count);
}

static void rays_batch(uint32_t count)
{
    static tl_ray batch[QUESTIONS];
    static tl_ray_hit hits[QUESTIONS];
    tl_soup *soup = bake_soup(TL_SOUP_FAST);
    make_questions(tl_soup_bounds(soup));
    for (uint32_t i = 0; i < QUESTIONS; i++) {
        tl_ray ray = { starts[i], directions[i], INFINITY };
        batch[i] = ray;
    }
    began = clock();
    for (uint32_t i = 0; i < count; i += QUESTIONS) {
        tl_soup_cast_rays(soup, batch, QUESTIONS, NULL, NULL, hits);
        for (uint32_t k = 0; k < QUESTIONS; k++) {
            note_hit(&hits[k]);
        }
    }
    tl_blob_free(soup);
}

static void sight(uint32_t count)
{
    tl_soup *soup = bake_soup(TL_SOUP_FAST);
    make_questions(tl_soup_bounds(soup));
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        note(tl_soup_line_of_sight(soup, starts[i % QUESTIONS], ends[i % QUESTIONS], NULL));
    }
    tl_blob_free(soup);
}

// Boxes of a metre, as likely within one another as apart.
static void scene_rays(uint32_t count)
{
    enum { INSTANCES = 1000 };
    static tl_scene_instance instances[INSTANCES];
    static const tl_aabb box = { { 0, 0, 0 }, { 60, 20, 60 } };
    tl_convex shape = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.5f, 0.5f), 0);
    for (uint32_t i = 0; i < INSTANCES; i++) {
        tl_transform pose = tl_transform_identity();
        pose.position = point_in(box);
        tl_scene_instance instance = { .shape = &shape, .pose = pose, .mask = 1 };
        instances[i] = instance;
    }
    tl_scene *scene;
    must(tl_scene_bake(instances, INSTANCES, NULL, &scene, NULL));
    make_questions(box);
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        tl_ray ray = { starts[i % QUESTIONS], directions[i % QUESTIONS], INFINITY };
        tl_scene_hit hit;
        if (tl_scene_cast_ray(scene, instances, &ray, NULL, &hit)) {
            note_float(hit.hit.t);
            note(hit.instance);
        }
    }
    tl_blob_free(scene);
}

static tl_hull *random_hull(uint32_t points)
{
    enum { MAX_POINTS = 1024 };
    static tl_vec3 cloud[MAX_POINTS];
    for (uint32_t i = 0; i < points; i++) {
        cloud[i] = tl_normalize(direction());
    }
    tl_hull *hull;
    must(tl_hull_bake(cloud, points, NULL, &hull, NULL));
    return hull;
}

static void supports(uint32_t points, uint32_t count)
{
    static const tl_aabb box = { { -1, -1, -1 }, { 1, 1, 1 } };
    tl_hull *hull = random_hull(points);
    make_questions(box);
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        note(tl_hull_support(hull, directions[i % QUESTIONS], TL_NO_VERTEX));
    }
    tl_blob_free(hull);
}

static void support_8(uint32_t count)
{
    supports(8, count);
}

static void support_32(uint32_t count)
{
    supports(32, count);
}

static void support_256(uint32_t count)
{
    supports(256, count);
}

static void support_1024(uint32_t count)
{
    supports(1024, count);
}

static void hull_rays(uint32_t count)
{
    static const tl_aabb box = { { -1, -1, -1 }, { 1, 1, 1 } };
    tl_hull *hull = random_hull(64);
    make_questions(box);
    for (uint32_t i = 0; i < QUESTIONS; i++) {
        starts[i] = tl_scale(tl_normalize(directions[i]), 3.0f);
        ends[i] = tl_sub(ends[i], starts[i]);
    }
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        tl_hull_hit hit;
        if (tl_hull_cast_ray(hull, starts[i % QUESTIONS], ends[i % QUESTIONS], 10.0f, &hit)) {
            note_float(hit.t);
            note(hit.face);
        }
    }
    tl_blob_free(hull);
}

// Pairs of hulls of 8 to 64 vertices, apart.
static void distances(uint32_t count)
{
    enum { HULLS = 4 };
    static const tl_aabb box = { { -1, -1, -1 }, { 1, 1, 1 } };
    tl_hull *hulls[HULLS];
    tl_convex shapes[HULLS];
    for (uint32_t i = 0; i < HULLS; i++) {
        hulls[i] = random_hull(8u << i);
        shapes[i] = tl_convex_from_hull(hulls[i], 0);
    }
    make_questions(box);
    for (uint32_t i = 0; i < QUESTIONS; i++) {
        starts[i] = tl_scale(tl_normalize(directions[i]), 2.5f);
    }
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        tl_transform here = tl_transform_identity(), there = here;
        there.position = starts[i % QUESTIONS];
        tl_separation result;
        tl_convex_distance(&shapes[i % HULLS], here, &shapes[i / HULLS % HULLS], there, NULL, &result);
        note_float(result.distance);
    }
    for (uint32_t i = 0; i < HULLS; i++) {
        tl_blob_free(hulls[i]);
    }
}

static void bake_soups(uint32_t count)
{
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        tl_soup *soup = bake_soup(TL_SOUP_FAST);
        note_blob(soup);
        tl_blob_free(soup);
    }
}

static void bake_hulls(uint32_t count)
{
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        tl_hull *hull = random_hull(256);
        note_blob(hull);
        tl_blob_free(hull);
    }
}

static void bake_navmeshes(uint32_t count)
{
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 64;
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = level;
    began = clock();
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_tiles tiles;
        must(tl_nav_bake(&def, &input, &tiles, NULL));
        for (uint32_t k = 0; k < tiles.tile_count; k++) {
            note_blob(tiles.tiles[k]);
        }
        tl_nav_tiles_free(&tiles);
    }
}

static const struct {
    const char *name;
    void (*work)(uint32_t count);
    uint32_t usual; // so many take some hundredths of a second natively
} kinds[] = {
    { "rays", rays, 20000 },
    { "rays-compact", rays_compact, 20000 },
    { "rays-batch", rays_batch, 20480 },
    { "sight", sight, 20000 },
    { "scene-rays", scene_rays, 20000 },
    { "support-8", support_8, 100000 },
    { "support-32", support_32, 100000 },
    { "support-256", support_256, 100000 },
    { "support-1024", support_1024, 100000 },
    { "hull-rays", hull_rays, 20000 },
    { "distance", distances, 20000 },
    { "bake-soup", bake_soups, 4 },
    { "bake-hull", bake_hulls, 40 },
    { "bake-navmesh", bake_navmeshes, 1 },
};

enum { KINDS = sizeof kinds / sizeof *kinds };

int main(int argc, char **argv)
{
    if (argc < 3) {
        for (int i = 0; i < KINDS; i++) {
            printf("%s %u\n", kinds[i].name, (unsigned)kinds[i].usual);
        }
        return argc != 1;
    }
    make_level();
    for (int i = 0; i < KINDS; i++) {
        if (strcmp(argv[1], kinds[i].name) == 0) {
            kinds[i].work((uint32_t)strtoul(argv[2], NULL, 10));
            printf("hash %08x%08x seconds %.4f\n", (unsigned)(answers >> 32), (unsigned)(answers & 0xffffffffu),
                   (double)(clock() - began) / (double)CLOCKS_PER_SEC);
            return 0;
        }
    }
    fprintf(stderr, "simd_work: no work is called '%s'\n", argv[1]);
    return 2;
}
