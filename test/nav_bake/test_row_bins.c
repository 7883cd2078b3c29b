// SPDX-License-Identifier: MIT
//
// Bands of rows against testing every triangle's rows with every band; the same lists for any number of workers.

#include "nav_bake/input/row_bins.h"

#include "nav_fields.h"

#include <math.h>
#include <string.h>

enum { TRIANGLES = 5000 };

static tl_mesh_view random_mesh(test_random *random, tl_vec3 *vertices, uint32_t *indices)
{
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        const float size = i % 700 == 0 ? 1e9f : i % 30 == 0 ? 60.0f : 4.0f;
        const tl_vec3 center = test_random_point(random, tl_vec3_make(-20, 0, -20), tl_vec3_make(120, 5, 120));
        for (uint32_t k = 0; k < 3; k++) {
            const tl_vec3 d = test_random_point(random, tl_vec3_make(-size, 0, -size), tl_vec3_make(size, 1, size));
            vertices[3 * i + k] = tl_add(center, d);
            indices[3 * i + k] = 3 * i + k;
        }
    }
    return (tl_mesh_view){ vertices, 3 * TRIANGLES, indices, TRIANGLES, NULL };
}

static bool overlaps(const tl_mesh_view *mesh, const tl_lattice_map *map, uint32_t triangle, double begin, double end)
{
    double min = (double)INFINITY, max = -(double)INFINITY;
    for (uint32_t k = 0; k < 3; k++) {
        const double z = tl_lattice_map_z(map, mesh->vertices[mesh->indices[3 * triangle + k]].z);
        min = fmin(min, z);
        max = fmax(max, z);
    }
    return min <= end && max >= begin;
}

static void every_overlap_is_listed(void **state)
{
    (void)state;
    test_random random = { 8 };
    static tl_vec3 vertices[3 * TRIANGLES];
    static uint32_t indices[3 * TRIANGLES];
    tl_tasks tasks;
    tasks = test_backward_tasks(&tasks, 3);
    const tl_host many = { NULL, &tasks, NULL };
    uint64_t listed = 0, needed = 0, outside = 0;
    for (uint32_t round = 0; round < 20; round++) {
        const tl_mesh_view mesh = random_mesh(&random, vertices, indices);
        const tl_nav_lattice lattice = { { 0, 0, 0 }, 0, 0 };
        const tl_lattice_map map = tl_lattice_map_make(&lattice, 0.5f, 0.2f);
        const tl_row_grid grid = { 1 + test_random_below(&random, 40), 1 + test_random_below(&random, 30),
                                   test_random_below(&random, 3) };
        const tl_triangle_list all = { NULL, TRIANGLES };
        tl_triangle_bins bins, shared;
        TEST_RESULT(tl_row_bins_init(&mesh, all, &map, grid, NULL, &bins), TL_OK);
        TEST_RESULT(tl_row_bins_init(&mesh, all, &map, grid, &many, &shared), TL_OK);
        for (uint32_t k = 0; k < grid.count; k++) {
            const tl_triangle_list list = tl_triangle_bins_get(&bins, k), same = tl_triangle_bins_get(&shared, k);
            TEST_CHECK(list.count == same.count &&
                       memcmp(list.indices, same.indices, list.count * sizeof *list.indices) == 0);
            const double begin = (double)(k * grid.size) - grid.margin,
                         end = (double)((k + 1) * grid.size) + grid.margin;
            uint32_t next = 0;
            for (uint32_t t = 0; t < TRIANGLES; t++) {
                const bool there = next < list.count && list.indices[next] == t;
                const bool must = overlaps(&mesh, &map, t, begin, end);
                TEST_CHECK(there || !must);
                TEST_CHECK(!there || overlaps(&mesh, &map, t, begin - 1, end + 1)); // little in vain
                next += there;
                listed += there;
                needed += must;
                outside += !must;
            }
            TEST_CHECK(next == list.count); // ascending, nothing else
        }
        tl_triangle_bins_free(&bins);
        tl_triangle_bins_free(&shared);
    }
    TEST_CHECK(needed > 10000 && outside > 10000 && listed > needed);
}

static void failing_memory_is_reported(void **state)
{
    (void)state;
    test_random random = { 8 };
    static tl_vec3 vertices[3 * TRIANGLES];
    static uint32_t indices[3 * TRIANGLES];
    const tl_mesh_view mesh = random_mesh(&random, vertices, indices);
    const tl_nav_lattice lattice = { { 0, 0, 0 }, 0, 0 };
    const tl_lattice_map map = tl_lattice_map_make(&lattice, 0.5f, 0.2f);
    const tl_row_grid grid = { 4, 50, 1 };
    const tl_triangle_list all = { NULL, TRIANGLES };
    for (uint64_t k = 1; k <= 5; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        const tl_host host = { &memory.allocator, NULL, NULL };
        tl_triangle_bins bins;
        TEST_RESULT(tl_row_bins_init(&mesh, all, &map, grid, &host, &bins), k <= 4 ? TL_ERR_MEMORY : TL_OK);
        tl_triangle_bins_free(&bins);
        TEST_CHECK(memory.live_blocks == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(every_overlap_is_listed),
                                        cmocka_unit_test(failing_memory_is_reported) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
