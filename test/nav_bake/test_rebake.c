// SPDX-License-Identifier: MIT
//
// A part of the tiles baked again: the same bytes as a bake of the whole level, and nothing else has changed.

#include "nav_level.h"

#include <math.h>
#include <talus/nav_bake.h>

enum { EDITS = 60 };

static float tile_height; // of all tests, 0 at first

static tl_nav_def make_def(uint32_t tile_size)
{
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = tile_size;
    def.tile_height = tile_height;
    def.bounds.min = tl_vec3_make(-1, -3, -1);
    def.bounds.max = tl_vec3_make(26, 9, 20);
    return def;
}

static bool same_tile(const tl_nav_tile *a, const tl_nav_tile *b)
{
    return a->blob.size == b->blob.size && memcmp(a, b, a->blob.size) == 0;
}

static bool same_stack(const tl_nav_tile_stack *a, const tl_nav_tile_stack *b)
{
    bool same = a->count == b->count;
    for (uint32_t i = 0; same && i < a->count; i++) {
        same = same_tile(a->tiles[i], b->tiles[i]) && a->tiles[i]->layer == b->tiles[i]->layer &&
               (i == 0 || a->tiles[i - 1]->layer < a->tiles[i]->layer);
    }
    return same;
}

static tl_nav_tile_block build_all(const tl_nav_def *def, const tl_nav_input *input)
{
    tl_nav_tile_range range = { 0, 0, 0, 0 };
    TEST_RESULT(tl_nav_tile_grid(def, def->bounds, &range.count_x, &range.count_z, NULL), TL_OK);
    tl_nav_tile_block block;
    TEST_RESULT(tl_nav_bake_range(def, input, range, NULL, &block, NULL), TL_OK);
    return block;
}

// The block of everything is tl_nav_bake's list with its gaps.
static void test_whole_range(void **state)
{
    (void)state;
    test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = make_def(16);
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    tl_nav_tile_block block = build_all(&def, &input);
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
    uint32_t next = 0;
    for (uint32_t t = 0; t < block.range.count_x * block.range.count_z; t++) {
        for (uint32_t i = 0; i < block.stacks[t].count; i++) {
            TEST_CHECK(next < tiles.tile_count && same_tile(block.stacks[t].tiles[i], tiles.tiles[next]));
            next++;
        }
    }
    TEST_CHECK(next == tiles.tile_count && next > 10);
    tl_nav_tiles_free(&tiles);
    tl_nav_tile_block_free(&block);
}

// A block moves about; what its old and its new place touch is baked again.
static void test_edits(void **state)
{
    (void)state;
    static const uint32_t sizes[] = { 12, 20, 0 };
    test_random random = { 5 };
    uint32_t changed = 0, kept = 0, emptied = 0;
    for (int s = 0; s < 3; s++) {
        tl_nav_def def = make_def(sizes[s]);
        test_level level;
        test_level_make(&level, tl_vec3_make(0, 0, 0));
        uint32_t mover = level.mesh.vertex_count;
        test_level_box(&level, 0, 0, 0, 1, 1, 1, 1);
        tl_nav_input input = { level.mesh, NULL, NULL, 0 };
        tl_nav_tile_block now = build_all(&def, &input);
        tl_aabb before = { { 0, 0, 0 }, { 1, 1, 1 } };
        for (int edit = 0; edit < EDITS; edit++) {
            tl_vec3 size = test_random_point(&random, tl_vec3_make(0.2f, 0.1f, 0.2f), tl_vec3_make(6, 3, 6));
            tl_vec3 at = test_random_point(&random, tl_vec3_make(-3, -1, -3), tl_vec3_make(27, 3, 20));
            tl_aabb after = { at, tl_add(at, size) };
            test_level moved;
            memset(&moved, 0, sizeof moved);
            test_level_box(&moved, after.min.x, after.min.y, after.min.z, after.max.x, after.max.y, after.max.z,
                           after.max.y);
            memcpy(level.vertices + mover, moved.vertices, 24 * sizeof(tl_vec3));
            tl_nav_tile_block fresh = build_all(&def, &input), part;
            tl_nav_bake_report report;
            TEST_RESULT(tl_nav_rebake(&def, &input, tl_aabb_union(before, after), &part, &report), TL_OK);
            for (uint32_t z = 0; z < now.range.count_z; z++) {
                for (uint32_t x = 0; x < now.range.count_x; x++) {
                    tl_nav_tile_stack *stack = &now.stacks[z * now.range.count_x + x];
                    bool inside = x >= part.range.x && x < part.range.x + part.range.count_x && z >= part.range.z &&
                                  z < part.range.z + part.range.count_z;
                    if (inside) {
                        tl_nav_tile_stack *baked =
                            &part.stacks[(z - part.range.z) * part.range.count_x + (x - part.range.x)];
                        changed += !same_stack(stack, baked);
                        emptied += stack->count > baked->count;
                        tl_nav_tile_stack_free(stack);
                        *stack = *baked;
                        memset(baked, 0, sizeof *baked);
                    } else {
                        kept++;
                    }
                    TEST_CHECK(same_stack(stack, &fresh.stacks[z * now.range.count_x + x]));
                }
            }
            tl_nav_tile_block_free(&fresh);
            tl_nav_tile_block_free(&part);
            before = after;
        }
        tl_nav_tile_block_free(&now);
    }
    TEST_CHECK(changed > 200 && kept > 200 && emptied > 0);
}

static void count_tile(const tl_nav_config *config, tl_nav_stages *stages, void *user)
{
    uint32_t *counts = user;
    TEST_CHECK(stages->compact.lattice.first_x == config->lattice.first_x && stages->compact.region != NULL);
    TEST_CHECK(stages->heightfield.span_count > 0);
    counts[0]++;
    if (counts[0] % 2 == 0) { // takes it
        tl_nav_compact mine = stages->compact;
        memset(&stages->compact, 0, sizeof stages->compact);
        counts[1] += mine.span_count;
        tl_nav_compact_free(&mine);
    }
}

static void test_sink(void **state)
{
    (void)state;
    test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = make_def(16);
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    test_allocator counting;
    test_allocator_init(&counting, 0);
    def.host.allocator = &counting.allocator;
    uint32_t counts[2] = { 0, 0 };
    const tl_nav_stage_sink sink = { count_tile, counts };
    tl_nav_tile_range range = { 1, 1, 3, 2 };
    tl_nav_tile_block block;
    TEST_RESULT(tl_nav_bake_range(&def, &input, range, &sink, &block, NULL), TL_OK);
    TEST_CHECK(counts[0] == 6 && counts[1] > 100);
    tl_nav_tile_block_free(&block);
    TEST_CHECK(counting.live_blocks == 0);
}

static void test_refusals(void **state)
{
    (void)state;
    test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = make_def(16);
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    tl_nav_tile_block block;
    tl_nav_bake_report report;
    tl_nav_tile_range beyond = { 2, 0, 1000, 1 };
    TEST_RESULT(tl_nav_bake_range(&def, &input, beyond, NULL, &block, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.base.field, "range");
    tl_aabb box = { { 1, 0, 1 }, { 2, 1, 2 } }, far_away = { { 900, 0, 1 }, { 901, 1, 2 } };
    tl_aabb not_finite = { { NAN, 0, 1 }, { 2, 1, 2 } };
    TEST_RESULT(tl_nav_rebake(&def, &input, tl_aabb_empty(), &block, &report), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_rebake(&def, &input, not_finite, &block, &report), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_nav_rebake(&def, &input, far_away, &block, &report), TL_OK);
    TEST_CHECK(block.range.count_x == 0 && block.range.count_z == 0);
    tl_nav_tile_block_free(&block);
    // A fault is named by the caller's own number, and one that lies elsewhere does no harm.
    uint32_t last = level.mesh.triangle_count - 1;
    level.vertices[level.indices[3 * last]] = tl_vec3_make(NAN, 0.0f, NAN);
    tl_aabb corner = { { 1, 0, 1 }, { 1.1f, 1, 1.1f } };
    TEST_RESULT(tl_nav_rebake(&def, &input, corner, &block, &report), TL_ERR_NOT_FINITE);
    level.vertices[level.indices[3 * last]] = tl_vec3_make(25.0f, 0.0f, 17.0f);
    level.indices[3 * last] = 60000;
    TEST_RESULT(tl_nav_rebake(&def, &input, corner, &block, &report), TL_ERR_INDEX);
    TEST_CHECK(strcmp(report.base.element, "triangle") == 0 && report.base.element_index == last);
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    def.bounds = tl_aabb_empty();
    TEST_RESULT(tl_nav_rebake(&def, &input, box, &block, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.base.field, "bounds");
    // Every allocation may fail.
    def = make_def(16);
    uint32_t failures = 0;
    for (uint64_t k = 1;; k += 1 + k / 16) {
        test_allocator counting;
        test_allocator_init(&counting, k);
        def.host.allocator = &counting.allocator;
        uint32_t counts[2] = { 0, 0 };
        const tl_nav_stage_sink sink = { count_tile, counts };
        tl_nav_tile_range range = { 1, 1, 2, 1 };
        tl_result result = tl_nav_bake_range(&def, &input, range, &sink, &block, NULL);
        if (result == TL_OK) {
            tl_nav_tile_block_free(&block);
        }
        TEST_CHECK(counting.live_blocks == 0);
        if (result == TL_OK) {
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        failures++;
    }
    TEST_CHECK(failures > 10);
}

// The same with floors in layers of two metres.
static int divide(void **state)
{
    (void)state;
    tile_height = 2.0f;
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_whole_range),
                                        cmocka_unit_test(test_edits),
                                        cmocka_unit_test(test_sink),
                                        cmocka_unit_test(test_refusals),
                                        cmocka_unit_test_setup(test_whole_range, divide),
                                        cmocka_unit_test_setup(test_edits, divide) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
