// SPDX-License-Identifier: MIT
//
// The picture of a navmesh on hills shows the surface that agents walk on, not the flat polygons, which lie deep in the
// ground there: each drawn triangle is held against the level.
#include "talus_test.h"

#include "cli/draw/draw_scene.h"
#include "cli/draw/draw_stage.h"
#include "cli/sample/sample_level.h"

#include <stdio.h>
#include <string.h>
#include <talus/nav_bake.h>
#include <talus/soup.h>

typedef struct hills {
    tl_mesh mesh;
    tl_soup *soup;
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
} hills;

static void make_hills(hills *h)
{
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    while (count > 0 && strcmp(levels->name, "terrain") != 0) {
        levels++;
        count--;
    }
    TEST_CHECK(count > 0);
    tl_sample_mesh source;
    TEST_RESULT(tl_sample_build_level(levels, 6000, 1, &source), TL_OK);
    const tl_mesh_view view = { source.vertices, source.vertex_count, source.indices, source.triangle_count, NULL };
    TEST_RESULT(tl_mesh_bake(&view, NULL, &h->mesh, NULL), TL_OK);
    TEST_RESULT(tl_soup_bake(&view, NULL, &h->soup, NULL), TL_OK);
    const tl_nav_input input = { tl_mesh_as_view(&h->mesh), NULL, NULL, 0 };
    TEST_RESULT(tl_nav_bake(NULL, &input, &h->tiles, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &h->navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_add_tiles(h->navmesh, h->tiles.tiles, h->tiles.tile_count, TL_NAV_TILE_BORROWED, NULL),
                TL_OK);
    tl_sample_mesh_free(&source);
}

static void free_hills(hills *h)
{
    tl_navmesh_destroy(h->navmesh);
    tl_nav_tiles_free(&h->tiles);
    tl_blob_free(h->soup);
    tl_mesh_free(&h->mesh);
}

// Metres from a point to the level straight above or below it; the nearer of the two.
static float distance_to_ground(const hills *h, tl_vec3 point)
{
    float nearest = INFINITY;
    for (int side = 0; side < 2; side++) {
        const float y = side ? 1.0f : -1.0f;
        const tl_ray ray = { tl_vec3_make(point.x, point.y - 0.01f * y, point.z), tl_vec3_make(0.0f, y, 0.0f),
                             1000.0f };
        tl_ray_hit hit;
        if (tl_soup_cast_ray(h->soup, &ray, NULL, &hit)) {
            nearest = tl_minf(nearest, hit.t);
        }
    }
    return nearest;
}

static tl_vec3 middle(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    return tl_scale(tl_add(tl_add(a, b), c), 1.0f / 3.0f);
}

// Metres by which the flat polygons leave the ground at most.
static float depth_of_polygons(const hills *h)
{
    float deepest = 0.0f;
    for (uint32_t t = 0; t < h->tiles.tile_count; t++) {
        const tl_nav_tile *tile = h->tiles.tiles[t];
        for (uint32_t p = 0; p < tile->polygon_count; p++) {
            uint32_t count;
            const tl_vec3 *c = tl_nav_tile_corners(tile, p, &count);
            for (uint32_t k = 2; k < count; k++) {
                const float distance = distance_to_ground(h, middle(c[0], c[k - 1], c[k]));
                deepest = distance < INFINITY ? tl_maxf(deepest, distance) : deepest;
            }
        }
    }
    return deepest;
}

static void test_the_surface_is_drawn(void **state)
{
    (void)state;
    hills h;
    make_hills(&h);
    const float flat = depth_of_polygons(&h);
    draw_scene scene;
    draw_scene_init(&scene, h.mesh.bounds);
    draw_stage_navmesh(&scene, h.navmesh);
    TEST_CHECK(!scene.out_of_memory && scene.overlay.count > 1000);
    float deepest = 0.0f;
    for (uint32_t i = 0; i < scene.overlay.count; i++) {
        const tl_vec3 *c = scene.overlay.corners + 3 * (size_t)i;
        const tl_vec3 point = tl_add(middle(c[0], c[1], c[2]), scene.center);
        deepest = tl_maxf(deepest, distance_to_ground(&h, point));
    }
    printf("off the ground by %.2f m at most, the flat polygons by %.2f m\n", (double)deepest, (double)flat);
    // A height sample is off by the detail's error and a cell, and between samples as the ground bends.
    TEST_CHECK(deepest < 1.5f);
    TEST_CHECK(flat > 4.0f * deepest);
    draw_scene_free(&scene);
    free_hills(&h);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_the_surface_is_drawn) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
