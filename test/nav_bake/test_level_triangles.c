// SPDX-License-Identifier: MIT
//
// The triangles of a level by place: a rebake of those that are near has the bytes of one of all, whatever changed; and
// few of them are near.

#include "nav_level.h"
#include "talus_test.h"

#include <math.h>
#include <stdlib.h>

enum { SIDE = 40, FLOORS = 2 * SIDE * SIDE, SPARE = 200, CAPACITY = FLOORS + SPARE };

// A floor in squares of one metre, whose triangles move up and down, and room for more.
typedef struct field {
    tl_vec3 vertices[3 * CAPACITY];
    uint32_t indices[3 * CAPACITY];
    uint8_t areas[CAPACITY];
    tl_nav_input input;
    tl_nav_def def;
} field;

static void put_triangle(field *f, uint32_t at, tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    f->vertices[3 * at] = a;
    f->vertices[3 * at + 1] = b;
    f->vertices[3 * at + 2] = c;
}

static void make_field(field *f, uint32_t tile_size)
{
    memset(f, 0, sizeof *f);
    for (uint32_t i = 0; i < 3 * CAPACITY; i++) {
        f->indices[i] = i;
    }
    memset(f->areas, TL_NAV_WALKABLE_AREA, sizeof f->areas);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const float x = (float)(i % SIDE), z = (float)(i / SIDE);
        put_triangle(f, 2 * i, tl_vec3_make(x, 0, z), tl_vec3_make(x, 0, z + 1), tl_vec3_make(x + 1, 0, z));
        put_triangle(f, 2 * i + 1, tl_vec3_make(x + 1, 0, z), tl_vec3_make(x, 0, z + 1), tl_vec3_make(x + 1, 0, z + 1));
    }
    f->input.mesh = (tl_mesh_view){ f->vertices, 3 * CAPACITY, f->indices, FLOORS, NULL };
    f->input.areas = f->areas;
    f->def = tl_default_nav_def();
    f->def.tile_size = tile_size;
    f->def.bounds.min = tl_vec3_make(0, -2, 0);
    f->def.bounds.max = tl_vec3_make(SIDE, 6, SIDE);
}

static void check_same_block(const tl_nav_tile_block *a, const tl_nav_tile_block *b)
{
    TEST_CHECK(memcmp(&a->range, &b->range, sizeof a->range) == 0);
    for (uint32_t i = 0; i < a->range.count_x * a->range.count_z; i++) {
        TEST_CHECK(a->stacks[i].count == b->stacks[i].count);
        for (uint32_t k = 0; k < a->stacks[i].count; k++) {
            const tl_nav_tile *one = a->stacks[i].tiles[k], *other = b->stacks[i].tiles[k];
            TEST_CHECK(one->blob.size == other->blob.size && memcmp(one, other, one->blob.size) == 0);
        }
    }
}

// Both ways; returns how many triangles were near.
static uint32_t check_rebake(const field *f, tl_nav_triangles *triangles, tl_aabb changed)
{
    tl_nav_tile_block all, part;
    tl_nav_near_triangles near;
    TEST_RESULT(tl_nav_rebake(&f->def, &f->input, changed, &all, NULL), TL_OK);
    TEST_RESULT(tl_nav_triangles_near(triangles, &f->input, changed, &near, NULL), TL_OK);
    TEST_RESULT(tl_nav_rebake(&f->def, &near.input, changed, &part, NULL), TL_OK);
    check_same_block(&all, &part);
    const uint32_t count = near.input.mesh.triangle_count;
    for (uint32_t i = 0; i < count; i++) {
        TEST_CHECK(i == 0 || near.sources[i] > near.sources[i - 1]);
        TEST_CHECK(memcmp(near.input.mesh.indices + 3 * i, f->indices + 3 * near.sources[i], 12) == 0);
        TEST_CHECK(near.input.areas[i] == f->areas[near.sources[i]]);
    }
    tl_nav_tile_block_free(&all);
    tl_nav_tile_block_free(&part);
    return count;
}

// Triangles of a small square are lifted, by more than a step; half of them get another area.
static tl_aabb lift_square(field *f, test_random *random, uint32_t *changed, uint32_t *count)
{
    const uint32_t x = test_random_below(random, SIDE - 4), z = test_random_below(random, SIDE - 4);
    const float lift = test_random_range(random, 0.0f, 3.0f);
    *count = 0;
    for (uint32_t k = 0; k < 32; k++) {
        const uint32_t t = 2 * ((z + k / 8) * SIDE + x + k / 2 % 4) + k % 2;
        for (uint32_t v = 3 * t; v < 3 * t + 3; v++) {
            f->vertices[v].y = lift;
        }
        f->areas[t] = k % 2 == 0 ? (uint8_t)(1 + test_random_below(random, 8)) : TL_NAV_WALKABLE_AREA;
        changed[(*count)++] = t;
    }
    return (tl_aabb){ { (float)x, -1, (float)z }, { (float)x + 4, 4, (float)z + 4 } };
}

// More at the end: small ones somewhere, at times a large one over all.
static tl_aabb add_triangle(field *f, test_random *random, uint32_t *changed, uint32_t *count)
{
    const uint32_t t = f->input.mesh.triangle_count++;
    const float size = test_random_below(random, 8) == 0 ? 30.0f : 2.0f;
    const tl_vec3 a = test_random_point(random, tl_vec3_make(0, 1, 0), tl_vec3_make(SIDE, 4, SIDE));
    put_triangle(f, t, a, tl_add(a, tl_vec3_make(0, 0, size)), tl_add(a, tl_vec3_make(size, 0, 0)));
    changed[0] = t;
    *count = 1;
    return (tl_aabb){ a, tl_add(a, tl_vec3_make(size, 0, size)) };
}

static void check_changes(uint32_t tile_size, uint32_t edits)
{
    field *f = malloc(sizeof *f);
    make_field(f, tile_size);
    test_random random = { 12 };
    tl_nav_triangles *triangles;
    TEST_RESULT(tl_nav_triangles_create(&f->def, &f->input.mesh, &triangles, NULL), TL_OK);
    uint64_t near = 0;
    for (uint32_t edit = 0; edit < edits; edit++) {
        uint32_t changed[32], count = 0;
        const uint32_t what = test_random_below(&random, 8);
        tl_aabb box = { { 1, 0, 1 }, { 2, 1, 2 } };
        if (what == 0 && f->input.mesh.triangle_count < CAPACITY) {
            box = add_triangle(f, &random, changed, &count);
        } else if (what == 1 && f->input.mesh.triangle_count > FLOORS) {
            f->input.mesh.triangle_count--; // where it was is in the box of nothing that is compared
        } else {
            box = lift_square(f, &random, changed, &count);
        }
        TEST_RESULT(tl_nav_triangles_change(triangles, &f->input.mesh, changed, count, NULL), TL_OK);
        near += check_rebake(f, triangles, box);
    }
    TEST_CHECK(tile_size == 0 ? near / edits >= FLOORS : near / edits < FLOORS / 3);
    TEST_CHECK(tl_nav_triangles_bytes(triangles) > sizeof(uint32_t) * FLOORS);
    const tl_aabb outside = { { 500, 0, 500 }, { 501, 1, 501 } };
    TEST_CHECK(tile_size == 0 || check_rebake(f, triangles, outside) == 0);
    tl_nav_triangles_destroy(triangles);
    free(f);
}

static void test_changes(void **state)
{
    (void)state;
    check_changes(32, 120); // all of them are sorted again on the way
    check_changes(0, 2);
}

// What a bake refuses is refused wherever it is, and what it is told of must be there.
static void test_refused_triangles(void **state)
{
    (void)state;
    field *f = malloc(sizeof *f);
    make_field(f, 32);
    f->vertices[3 * 7].x = f->vertices[3 * 7].z = NAN;
    tl_nav_triangles *triangles;
    TEST_RESULT(tl_nav_triangles_create(&f->def, &f->input.mesh, &triangles, NULL), TL_OK);
    tl_nav_near_triangles near;
    tl_nav_tile_block block;
    tl_nav_bake_report report;
    const tl_aabb far_away = { { 30, 0, 30 }, { 31, 1, 31 } };
    TEST_RESULT(tl_nav_triangles_near(triangles, &f->input, far_away, &near, NULL), TL_OK);
    TEST_RESULT(tl_nav_rebake(&f->def, &near.input, far_away, &block, &report), TL_ERR_NOT_FINITE);
    f->input.mesh.triangle_count = FLOORS + 1;
    tl_report small = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
    TEST_RESULT(tl_nav_triangles_near(triangles, &f->input, far_away, &near, &small), TL_ERR_ARGUMENT);
    assert_string_equal(small.field, "mesh");
    const uint32_t none[2] = { 1, FLOORS + 1 };
    TEST_RESULT(tl_nav_triangles_change(triangles, &f->input.mesh, none, 2, &small), TL_ERR_INDEX);
    TEST_CHECK(small.element_index == 1);
    tl_nav_triangles_destroy(triangles);
    free(f);
}

static void test_triangles_without_memory(void **state)
{
    (void)state;
    field *f = malloc(sizeof *f);
    make_field(f, 32);
    test_allocator counting;
    f->def.host.allocator = &counting.allocator;
    tl_nav_triangles *triangles = NULL;
    uint32_t failures = 0;
    for (uint64_t k = 1; triangles == NULL; k++) {
        test_allocator_init(&counting, k);
        const tl_result result = tl_nav_triangles_create(&f->def, &f->input.mesh, &triangles, NULL);
        TEST_CHECK(result == TL_OK || (result == TL_ERR_MEMORY && counting.live_blocks == 0));
        failures += result != TL_OK;
    }
    TEST_CHECK(failures >= 4);
    // Sorting all again fails: all are loose, and found as before.
    uint32_t *changed = malloc(FLOORS * sizeof *changed);
    for (uint32_t i = 0; i < FLOORS; i++) {
        changed[i] = i;
        f->vertices[3 * i].x += i % 64 == 0 ? 15.0f : 0.0f; // more cells
    }
    counting.calls = 0;
    counting.fail_at = 1;
    TEST_RESULT(tl_nav_triangles_change(triangles, &f->input.mesh, changed, FLOORS, NULL), TL_OK);
    counting.fail_at = 0;
    const tl_aabb box = { { 9, -1, 9 }, { 11, 4, 11 } };
    f->def.host.allocator = NULL;
    check_rebake(f, triangles, box);
    for (uint64_t k = 1;; k++) {
        tl_nav_near_triangles near;
        counting.calls = 0;
        counting.fail_at = k;
        const tl_result result = tl_nav_triangles_near(triangles, &f->input, box, &near, NULL);
        if (result == TL_OK) {
            break;
        }
        TEST_CHECK(result == TL_ERR_MEMORY && near.sources == NULL);
    }
    counting.fail_at = 0;
    check_rebake(f, triangles, box);
    tl_nav_triangles_destroy(triangles);
    TEST_CHECK(counting.live_blocks == 0);
    free(changed);
    free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_changes),
        cmocka_unit_test(test_refused_triangles),
        cmocka_unit_test(test_triangles_without_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
