// SPDX-License-Identifier: MIT
//
// Rasterization as a whole: the same bytes in any order and on any number of workers, tiles that agree on the columns
// they share, bad input, cancelling, failing memory. What a single triangle covers is test_voxelize.c's.

#include "base/hash.h"
#include "nav_fields.h"

#include <math.h>

enum { VERTICES = 900, TRIANGLES = 1200 };

typedef struct level {
    tl_vec3 vertices[VERTICES];
    uint32_t indices[3 * TRIANGLES];
    uint8_t areas[TRIANGLES];
    tl_mesh_view mesh;
    tl_aabb bounds;
} level;

// Terrain of a bumpy grid, with walls, floating floors and a few triangles far too large.
static void make_level(level *l, uint64_t seed, tl_vec3 offset)
{
    test_random random = { seed };
    for (uint32_t i = 0; i < VERTICES; i++) {
        float x = (float)(i % 30) * 1.7f, z = (float)(i / 30) * 1.7f;
        l->vertices[i] = tl_vec3_make(x, test_random_range(&random, 0, i % 4 == 0 ? 6.0f : 1.5f), z);
    }
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        uint32_t corner = test_random_below(&random, 29 * 29), at = corner / 29 * 30 + corner % 29;
        uint32_t *t = l->indices + 3 * i;
        t[0] = at;
        t[1] = i % 2 == 0 ? at + 30 : at + 31;
        t[2] = i % 2 == 0 ? at + 31 : at + 1;
        if (i % 50 == 0) {
            t[2] = test_random_below(&random, VERTICES);
        }
        l->areas[i] = (uint8_t)(1 + test_random_below(&random, 63));
    }
    l->bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < VERTICES; i++) {
        l->vertices[i] = tl_add(l->vertices[i], offset);
        l->bounds = tl_aabb_add_point(l->bounds, l->vertices[i]);
    }
    l->vertices[0] = tl_vec3_make(-1e9f, 3, -1e9f);
    l->vertices[31] = tl_vec3_make(1e6f, 5e5f, 2);
    l->mesh = (tl_mesh_view){ l->vertices, VERTICES, l->indices, TRIANGLES, NULL };
}

static tl_nav_config config_of(const level *l, float cell_size, uint32_t tile_size, uint32_t tile_x, uint32_t tile_z)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = cell_size;
    def.tile_size = tile_size;
    tl_nav_config config;
    TEST_RESULT(tl_nav_config_from_def(&def, l->bounds, tile_x, tile_z, &config, NULL), TL_OK);
    return config;
}

static void order_and_workers_do_not_matter(void **state)
{
    (void)state;
    level *l = malloc(sizeof *l);
    make_level(l, 1, tl_vec3_make(0, 0, 0));
    // Columns enough for several bands.
    tl_nav_config config = config_of(l, 0.11f, 0, 0, 0);
    TEST_CHECK(config.width * config.height > 100000);
    tl_nav_heightfield expected, other;
    TEST_RESULT(tl_nav_rasterize(&config, &l->mesh, l->areas, NULL, &expected, NULL), TL_OK);
    TEST_CHECK(expected.span_count > 100000);

    for (uint32_t workers = 1; workers <= 3; workers++) {
        tl_tasks tasks;
        test_backward_tasks(&tasks, workers);
        test_progress progress;
        test_progress_init(&progress, 0);
        tl_host host = { NULL, &tasks, workers == 2 ? &progress.progress : NULL };
        TEST_RESULT(tl_nav_rasterize(&config, &l->mesh, l->areas, &host, &other, NULL), TL_OK);
        TEST_CHECK(test_same_heightfield(&expected, &other));
        tl_nav_heightfield_free(&other);
    }
    test_random random = { 2 };
    for (uint32_t round = 0; round < 4; round++) {
        for (uint32_t i = TRIANGLES; i > 1; i--) {
            uint32_t k = test_random_below(&random, i), turn = test_random_below(&random, 3);
            for (uint32_t c = 0; c < 3; c++) {
                uint32_t t = l->indices[3 * (i - 1) + c];
                l->indices[3 * (i - 1) + c] = l->indices[3 * k + c];
                l->indices[3 * k + c] = t;
            }
            uint8_t area = l->areas[i - 1];
            l->areas[i - 1] = l->areas[k];
            l->areas[k] = area;
            for (; turn > 0; turn--) { // the same winding from another corner
                uint32_t *t = l->indices + 3 * (i - 1), first = t[0];
                t[0] = t[1];
                t[1] = t[2];
                t[2] = first;
            }
        }
        TEST_RESULT(tl_nav_rasterize(&config, &l->mesh, l->areas, NULL, &other, NULL), TL_OK);
        TEST_CHECK(test_same_heightfield(&expected, &other));
        tl_nav_heightfield_free(&other);
    }
    tl_nav_heightfield_free(&expected);
    free(l);
}

// The same bytes with every compiler and optimisation level.
static void golden_hash(void **state)
{
    (void)state;
    level *l = malloc(sizeof *l);
    make_level(l, 1, tl_vec3_make(3.7f, -20, 111.3f));
    tl_nav_config config = config_of(l, 0.3f, 0, 0, 0);
    tl_nav_heightfield field;
    TEST_RESULT(tl_nav_rasterize(&config, &l->mesh, l->areas, NULL, &field, NULL), TL_OK);
    uint64_t hash = tl_hash_bytes(field.spans, field.span_count * sizeof *field.spans, 0);
    hash = tl_hash_bytes(field.first_span, (field.width * field.height + 1) * sizeof(uint32_t), hash);
    TEST_CHECK(hash == 0xfb53ae020cf61cbdu);
    tl_nav_heightfield_free(&field);
    free(l);
}

static void spans_are_well_formed(void **state)
{
    (void)state;
    level *l = malloc(sizeof *l);
    uint32_t walkable = 0, steep = 0;
    for (uint64_t seed = 1; seed < 6; seed++) {
        make_level(l, seed, tl_vec3_make(0, 0, 0));
        tl_nav_config config = config_of(l, 0.3f, 0, 0, 0);
        tl_nav_heightfield field;
        TEST_RESULT(tl_nav_rasterize(&config, &l->mesh, NULL, NULL, &field, NULL), TL_OK);
        TEST_CHECK(field.first_span[0] == 0 && field.first_span[field.width * field.height] == field.span_count);
        for (uint32_t c = 0; c < field.width * field.height; c++) {
            uint32_t below = 0;
            for (uint32_t i = field.first_span[c]; i < field.first_span[c + 1]; i++) {
                tl_nav_span span = field.spans[i];
                TEST_CHECK(span.min < span.max && span.max <= config.height_voxels + 1 && span.reserved == 0);
                TEST_CHECK(i == field.first_span[c] || span.min > below);
                TEST_CHECK(span.area == 0 || span.area == TL_NAV_WALKABLE_AREA);
                below = span.max;
                walkable += span.area != 0;
                steep += span.area == 0;
            }
        }
        tl_nav_heightfield_free(&field);
    }
    TEST_CHECK(walkable > 1000 && steep > 1000);
    free(l);
}

// A column that several tiles see has the same spans in each, and in a bake without tiles.
static void tiles_agree_on_shared_columns(void **state)
{
    (void)state;
    level *l = malloc(sizeof *l);
    const tl_vec3 offsets[] = { { 0, 0, 0 }, { 5000.3f, 20, -4999.9f } };
    for (uint32_t k = 0; k < 2; k++) {
        make_level(l, 3, offsets[k]);
        tl_nav_config whole = config_of(l, 0.3f, 0, 0, 0);
        tl_nav_heightfield expected;
        TEST_RESULT(tl_nav_rasterize(&whole, &l->mesh, l->areas, NULL, &expected, NULL), TL_OK);
        uint64_t compared = 0;
        for (uint32_t tile_z = 0; tile_z < 3; tile_z++) {
            for (uint32_t tile_x = 0; tile_x < 3; tile_x++) {
                tl_nav_config config = config_of(l, 0.3f, 60, tile_x, tile_z);
                tl_nav_heightfield field;
                TEST_RESULT(tl_nav_rasterize(&config, &l->mesh, l->areas, NULL, &field, NULL), TL_OK);
                for (uint32_t c = 0; c < field.width * field.height; c++) {
                    int64_t x = (int64_t)(c % field.width) + config.lattice.first_x;
                    int64_t z = (int64_t)(c / field.width) + config.lattice.first_z;
                    // Walls on the far side of a bake without tiles are in its last columns only.
                    if (x < 0 || z < 0 || x >= (int64_t)whole.width - 1 || z >= (int64_t)whole.height - 1) {
                        continue;
                    }
                    uint64_t other = (uint64_t)z * whole.width + (uint64_t)x;
                    uint32_t count = field.first_span[c + 1] - field.first_span[c];
                    TEST_CHECK(count == expected.first_span[other + 1] - expected.first_span[other]);
                    TEST_CHECK(memcmp(field.spans + field.first_span[c], expected.spans + expected.first_span[other],
                                      count * sizeof(tl_nav_span)) == 0);
                    compared += count;
                }
                tl_nav_heightfield_free(&field);
            }
        }
        TEST_CHECK(compared > 20000);
        tl_nav_heightfield_free(&expected);
    }
    free(l);
}

static void bad_meshes_are_refused(void **state)
{
    (void)state;
    tl_nav_config config = test_nav_config(4, 4);
    tl_vec3 vertices[3] = { { 0, 0, 0 }, { 1, 0, NAN }, { 0, 0, 1 } };
    uint32_t indices[3] = { 0, 2, 1 };
    tl_mesh_view mesh = { vertices, 3, indices, 1, NULL };
    tl_nav_heightfield field;
    tl_report report;
    TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, NULL, &field, &report), TL_ERR_NOT_FINITE);
    assert_string_equal(report.stage, "rasterize");
    TEST_CHECK(field.spans == NULL && report.element_index == 1);
    vertices[1] = tl_vec3_make(1, 0, 0);
    indices[1] = 3;
    TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, NULL, &field, &report), TL_ERR_INDEX);
    mesh.triangle_count = 0;
    TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, NULL, &field, &report), TL_ERR_EMPTY);
    // Outside of the bounds: no span, and no error.
    mesh.triangle_count = 1;
    indices[1] = 2;
    for (int i = 0; i < 3; i++) {
        vertices[i] = tl_add(vertices[i], tl_vec3_make(100, 0, 0));
    }
    TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, NULL, &field, &report), TL_OK);
    TEST_CHECK(field.span_count == 0 && field.first_span[16] == 0);
    tl_nav_heightfield_free(&field);
}

static void one_triangle_makes_one_voxel(void **state)
{
    (void)state;
    tl_nav_config config = test_nav_config(1, 1);
    tl_vec3 vertices[3] = { { 0.2f, 5.5f, 0.2f }, { 0.2f, 5.5f, 0.3f }, { 0.3f, 5.5f, 0.2f } };
    uint32_t indices[3] = { 0, 1, 2 };
    tl_mesh_view mesh = { vertices, 3, indices, 1, NULL };
    tl_nav_heightfield field;
    TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, NULL, &field, NULL), TL_OK);
    TEST_CHECK(field.span_count == 1 && field.spans[0].min == 5 && field.spans[0].max == 6);
    TEST_CHECK(field.spans[0].area == TL_NAV_WALKABLE_AREA);
    tl_nav_heightfield_free(&field);
}

// A hundred thousand copies of one triangle: the memory follows the columns, not the triangles.
static void piles_stay_small(void **state)
{
    (void)state;
    enum { COPIES = 100000 };
    tl_nav_config config = test_nav_config(30, 30);
    tl_vec3 vertices[3] = { { 0, 0, 0 }, { 0, 9, 30 }, { 30, 3, 0 } };
    uint32_t *indices = malloc(3 * COPIES * sizeof *indices);
    for (uint32_t i = 0; i < 3 * COPIES; i++) {
        indices[i] = i % 3;
    }
    tl_mesh_view mesh = { vertices, 3, indices, 1, NULL };
    tl_nav_heightfield one, pile;
    TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, NULL, &one, NULL), TL_OK);
    mesh.triangle_count = COPIES / 100;
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_host host = { &memory.allocator, NULL, NULL };
    TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, &host, &pile, NULL), TL_OK);
    TEST_CHECK(test_same_heightfield(&one, &pile));
    TEST_CHECK(memory.calls < 32); // items are reduced when there are 16 chunks of an item a column
    tl_nav_heightfield_free(&one);
    tl_nav_heightfield_free(&pile);
    TEST_CHECK(memory.live_blocks == 0);
    free(indices);
}

static void cancelling_leaves_nothing(void **state)
{
    (void)state;
    level *l = malloc(sizeof *l);
    make_level(l, 1, tl_vec3_make(0, 0, 0));
    tl_nav_config config = config_of(l, 0.1f, 0, 0, 0);
    for (uint32_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        test_progress progress;
        test_progress_init(&progress, k);
        tl_host host = { &memory.allocator, NULL, &progress.progress };
        tl_nav_heightfield field;
        tl_result result = tl_nav_rasterize(&config, &l->mesh, NULL, &host, &field, NULL);
        tl_nav_heightfield_free(&field);
        TEST_CHECK(memory.live_blocks == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 3);
            break;
        }
        TEST_RESULT(result, TL_ERR_CANCELLED);
    }
    free(l);
}

static void failing_memory_is_reported(void **state)
{
    (void)state;
    level *l = malloc(sizeof *l);
    make_level(l, 1, tl_vec3_make(0, 0, 0));
    tl_nav_config config = config_of(l, 0.1f, 0, 0, 0);
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_host host = { &memory.allocator, NULL, NULL };
        tl_nav_heightfield field;
        tl_result result = tl_nav_rasterize(&config, &l->mesh, NULL, &host, &field, NULL);
        TEST_CHECK(result == TL_OK || field.spans == NULL);
        tl_nav_heightfield_free(&field);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 10);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
    free(l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_and_workers_do_not_matter),
        cmocka_unit_test(golden_hash),
        cmocka_unit_test(spans_are_well_formed),
        cmocka_unit_test(tiles_agree_on_shared_columns),
        cmocka_unit_test(bad_meshes_are_refused),
        cmocka_unit_test(one_triangle_makes_one_voxel),
        cmocka_unit_test(piles_stay_small),
        cmocka_unit_test(cancelling_leaves_nothing),
        cmocka_unit_test(failing_memory_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
