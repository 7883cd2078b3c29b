// SPDX-License-Identifier: MIT
//
// Bins against testing every triangle's box with every bin.

#include "nav_bake/input/triangle_bins.h"

#include "nav_fields.h"

#include <math.h>
#include <string.h>

enum { TRIANGLES = 300 };

static tl_mesh_view random_mesh(test_random *random, tl_vec3 *vertices, uint32_t *indices)
{
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        float size = i % 7 == 0 ? 1e9f : i % 3 == 0 ? 60.0f : 4.0f;
        tl_vec3 center = test_random_point(random, tl_vec3_make(-20, 0, -20), tl_vec3_make(120, 5, 120));
        for (uint32_t k = 0; k < 3; k++) {
            tl_vec3 d = test_random_point(random, tl_vec3_make(-size, 0, -size), tl_vec3_make(size, 1, size));
            vertices[3 * i + k] = tl_add(center, d);
            indices[3 * i + k] = 3 * i + k;
        }
    }
    tl_mesh_view mesh = { vertices, 3 * TRIANGLES, indices, TRIANGLES, NULL };
    return mesh;
}

static bool overlaps(const tl_mesh_view *mesh, const tl_lattice_map *map, uint32_t triangle, double x0, double x1,
                     double z0, double z1)
{
    double min_x = (double)INFINITY, max_x = -(double)INFINITY, min_z = (double)INFINITY, max_z = -(double)INFINITY;
    for (uint32_t k = 0; k < 3; k++) {
        tl_voxel_point p = tl_lattice_map_point(map, mesh->vertices[mesh->indices[3 * triangle + k]]);
        min_x = fmin(min_x, p.x);
        max_x = fmax(max_x, p.x);
        min_z = fmin(min_z, p.z);
        max_z = fmax(max_z, p.z);
    }
    return min_x <= x1 && max_x >= x0 && min_z <= z1 && max_z >= z0;
}

static void every_overlap_is_listed(void **state)
{
    (void)state;
    test_random random = { 8 };
    static tl_vec3 vertices[3 * TRIANGLES];
    static uint32_t indices[3 * TRIANGLES];
    uint64_t listed = 0, needed = 0, outside = 0;
    for (uint32_t round = 0; round < 40; round++) {
        tl_mesh_view mesh = random_mesh(&random, vertices, indices);
        tl_nav_lattice lattice = { { 0, 0, 0 }, 0, 0 };
        tl_lattice_map map = tl_lattice_map_make(&lattice, 0.5f, 0.2f);
        tl_bin_grid grid = { 1 + test_random_below(&random, 6),  1 + test_random_below(&random, 6),
                             1 + test_random_below(&random, 60), 1 + test_random_below(&random, 60),
                             test_random_below(&random, 12),     false };
        tl_triangle_list all = { NULL, TRIANGLES };
        tl_triangle_bins bins;
        TEST_RESULT(tl_triangle_bins_init(&mesh, all, &map, &grid, NULL, &bins), TL_OK);
        for (uint32_t z = 0; z < grid.count_z; z++) {
            for (uint32_t x = 0; x < grid.count_x; x++) {
                tl_triangle_list list = tl_triangle_bins_get(&bins, (uint64_t)z * grid.count_x + x);
                uint32_t next = 0;
                for (uint32_t t = 0; t < TRIANGLES; t++) {
                    bool there = next < list.count && list.indices[next] == t;
                    bool must =
                        overlaps(&mesh, &map, t, (double)(x * grid.size_x) - grid.margin,
                                 (double)((x + 1) * grid.size_x) + grid.margin, (double)(z * grid.size_z) - grid.margin,
                                 (double)((z + 1) * grid.size_z) + grid.margin);
                    TEST_CHECK(there || !must);
                    next += there;
                    listed += there;
                    needed += must;
                    outside += !must;
                }
                TEST_CHECK(next == list.count); // ascending, nothing else
            }
        }
        tl_triangle_bins_free(&bins);
    }
    TEST_CHECK(needed > 10000 && outside > 10000);
    TEST_CHECK(listed < needed + needed / 2); // and little in vain
}

static void failing_memory_is_reported(void **state)
{
    (void)state;
    test_random random = { 8 };
    static tl_vec3 vertices[3 * TRIANGLES];
    static uint32_t indices[3 * TRIANGLES];
    tl_mesh_view mesh = random_mesh(&random, vertices, indices);
    tl_nav_lattice lattice = { { 0, 0, 0 }, 0, 0 };
    tl_lattice_map map = tl_lattice_map_make(&lattice, 0.5f, 0.2f);
    tl_bin_grid grid = { 4, 4, 50, 50, 3, false };
    tl_triangle_list all = { NULL, TRIANGLES };
    for (uint32_t sparse = 0; sparse < 2; sparse++) {
        const uint64_t allocations = sparse ? 5 : 2;
        grid.sparse = sparse != 0;
        for (uint64_t k = 1; k <= allocations + 1; k++) {
            test_allocator memory;
            test_allocator_init(&memory, k);
            tl_triangle_bins bins;
            TEST_RESULT(tl_triangle_bins_init(&mesh, all, &map, &grid, &memory.allocator, &bins),
                        k <= allocations ? TL_ERR_MEMORY : TL_OK);
            tl_triangle_bins_free(&bins);
            TEST_CHECK(memory.live_blocks == 0);
        }
    }
}

// A sparse grid lists what the whole grid does, for the bins that hold anything.
static void sparse_grids_list_the_same(void **state)
{
    (void)state;
    test_random random = { 9 };
    static tl_vec3 vertices[3 * TRIANGLES];
    static uint32_t indices[3 * TRIANGLES];
    uint64_t kept = 0, empty = 0;
    for (uint32_t round = 0; round < 40; round++) {
        tl_mesh_view mesh = random_mesh(&random, vertices, indices);
        for (uint32_t i = 0; i < TRIANGLES; i++) {
            // No triangle covers all, and they lie far apart.
            for (uint32_t k = 0; k < 3; k++) {
                vertices[3 * i + k].x = fminf(fmaxf(vertices[3 * i + k].x, -9), 9) + 40.0f * (float)(i % 60);
                vertices[3 * i + k].z = fminf(fmaxf(vertices[3 * i + k].z, -9), 9) + 40.0f * (float)(i / 60);
            }
        }
        tl_nav_lattice lattice = { { 0, 0, 0 }, 0, 0 };
        tl_lattice_map map = tl_lattice_map_make(&lattice, 0.5f, 0.2f);
        tl_bin_grid grid = { 100 + round,
                             30,
                             1 + test_random_below(&random, 60),
                             1 + test_random_below(&random, 60),
                             test_random_below(&random, 12),
                             false };
        tl_triangle_list all = { NULL, TRIANGLES };
        tl_triangle_bins dense, sparse;
        TEST_RESULT(tl_triangle_bins_init(&mesh, all, &map, &grid, NULL, &dense), TL_OK);
        grid.sparse = true;
        TEST_RESULT(tl_triangle_bins_init(&mesh, all, &map, &grid, NULL, &sparse), TL_OK);
        uint64_t next = 0;
        for (uint64_t place = 0; place < dense.bin_count; place++) {
            const tl_triangle_list expected = tl_triangle_bins_get(&dense, place);
            TEST_CHECK(tl_triangle_bins_place(&dense, place) == place);
            if (expected.count == 0) {
                empty++;
                continue;
            }
            const tl_triangle_list list = tl_triangle_bins_get(&sparse, next);
            TEST_CHECK(next < sparse.bin_count && tl_triangle_bins_place(&sparse, next) == place);
            TEST_CHECK(list.count == expected.count &&
                       memcmp(list.indices, expected.indices, list.count * sizeof *list.indices) == 0);
            next++;
        }
        TEST_CHECK(next == sparse.bin_count);
        kept += next;
        tl_triangle_bins_free(&dense);
        tl_triangle_bins_free(&sparse);
    }
    TEST_CHECK(kept > 1000 && empty > 1000);
}

// One triangle over 2^31 places is refused before it takes their memory.
static void too_many_places_are_refused(void **state)
{
    (void)state;
    const tl_vec3 vertices[3] = { { 0, 0, 0 }, { 2e7f, 0, 0 }, { 0, 0, 2e7f } };
    const uint32_t indices[3] = { 0, 1, 2 };
    tl_mesh_view mesh = { vertices, 3, indices, 1, NULL };
    tl_nav_lattice lattice = { { 0, 0, 0 }, 0, 0 };
    tl_lattice_map map = tl_lattice_map_make(&lattice, 1.0f, 1.0f);
    const tl_bin_grid grid = { 1u << 16, 1u << 15, 100, 100, 3, true };
    tl_triangle_list all = { NULL, 1 };
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_triangle_bins bins;
    TEST_RESULT(tl_triangle_bins_init(&mesh, all, &map, &grid, &memory.allocator, &bins), TL_ERR_LIMIT);
    TEST_CHECK(memory.live_blocks == 0 && memory.peak_bytes < 40u << 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(every_overlap_is_listed),
                                        cmocka_unit_test(failing_memory_is_reported),
                                        cmocka_unit_test(sparse_grids_list_the_same),
                                        cmocka_unit_test(too_many_places_are_refused) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
