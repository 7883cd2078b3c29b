// SPDX-License-Identifier: MIT
//
// Areas that change in a tile's border: where it is said to keep its bytes, it has them when it is baked again. Random
// marks on every tile of the test level, among marks that stay; and what is said of changes that are not in the border.

#include "base/arena.h"
#include "obstacle_world.h"

#include <stdlib.h>

enum { MOST_TILES = 64, MOST_FLOORS = 8192 };

// The floors of all tiles.
typedef struct tile_fields {
    tl_nav_config configs[MOST_TILES];
    tl_nav_compact fields[MOST_TILES];
    uint32_t count;
} tile_fields;

static void take_field(const tl_nav_config *config, tl_nav_stages *stages, void *user)
{
    tile_fields *tiles = user;
    TEST_CHECK(tiles->count < MOST_TILES && stages->compact.span_count <= MOST_FLOORS);
    tiles->configs[tiles->count] = *config;
    tl_nav_compact *field = &tiles->fields[tiles->count++];
    *field = stages->compact;
    memset(&stages->compact, 0, sizeof stages->compact);
    tl_release_array(&field->allocator, field->distance, field->span_count, sizeof *field->distance);
    tl_release_array(&field->allocator, field->region, field->span_count, sizeof *field->region);
    field->distance = NULL;
    field->region = NULL;
}

static void make_fields(tile_fields *tiles)
{
    test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = make_def();
    const tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    const tl_nav_stage_sink sink = { take_field, tiles };
    tl_nav_tile_range all = { 0, 0, 0, 0 };
    tl_nav_tile_block block;
    tiles->count = 0;
    TEST_RESULT(tl_nav_tile_grid(&def, def.bounds, &all.count_x, &all.count_z, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_range(&def, &input, all, &sink, &block, NULL), TL_OK);
    tl_nav_tile_block_free(&block);
}

// A square of walkable floors gets an area, 0 in two of three cases; any columns, or some of the border's.
static void mark_square(test_random *random, const tl_nav_compact *field, bool in_border, uint8_t *area)
{
    const uint32_t side = 1 + test_random_below(random, 6);
    uint32_t x = test_random_below(random, field->width), z = test_random_below(random, field->height);
    if (in_border) {
        uint32_t *along = test_random_below(random, 2) == 0 ? &x : &z;
        *along = test_random_below(random, 2) == 0 ? 0 : field->width - 1 - test_random_below(random, 3);
    }
    const uint8_t mark = (uint8_t)(test_random_below(random, 3) == 0 ? 7 : TL_NAV_NULL_AREA);
    for (uint32_t row = z; row < z + side && row < field->height; row++) {
        for (uint32_t column = x; column < x + side && column < field->width; column++) {
            const uint32_t *first = field->first_span + (size_t)row * field->width + column;
            for (uint32_t i = first[0]; i < first[1]; i++) {
                area[i] = area[i] != TL_NAV_NULL_AREA ? mark : area[i];
            }
        }
    }
}

static tl_nav_tile_stack bake_marked(const tl_nav_config *config, tl_nav_compact field, const uint8_t *base,
                                     uint8_t *area)
{
    tl_nav_tile_memo *memo = NULL;
    tl_nav_tile_stack stack;
    field.area = area;
    TEST_RESULT(tl_nav_tile_rebake(config, &field, base, &memo, NULL, &stack, NULL), TL_OK);
    tl_nav_tile_memo_free(memo);
    return stack;
}

static bool same_stacks(const tl_nav_tile_stack *a, const tl_nav_tile_stack *b)
{
    bool same = a->count == b->count;
    for (uint32_t i = 0; same && i < a->count; i++) {
        const tl_nav_tile *p = a->tiles[i], *q = b->tiles[i];
        same = p->blob.size == q->blob.size && memcmp(p, q, p->blob.size) == 0;
    }
    return same;
}

typedef struct change_tally {
    uint32_t kept, kept_cut, same, other; // of `kept` those with area 0; of the rest, bytes that were the same or not
} change_tally;

static void compare_change(test_random *random, const tl_nav_config *config, const tl_nav_compact *field,
                           change_tally *tally)
{
    static uint8_t before[MOST_FLOORS], after[MOST_FLOORS];
    const uint32_t count = field->span_count;
    memcpy(before, field->area, count);
    for (uint32_t k = test_random_below(random, 3); k > 0; k--) {
        mark_square(random, field, false, before); // stays
    }
    memcpy(after, before, count);
    mark_square(random, field, test_random_below(random, 4) != 0, after);
    if (test_random_below(random, 2) == 0) { // or goes
        static uint8_t swapped[MOST_FLOORS];
        memcpy(swapped, before, count);
        memcpy(before, after, count);
        memcpy(after, swapped, count);
    }
    tl_nav_compact marked = *field;
    marked.area = after;
    const bool kept = tl_nav_tile_keeps_bytes(config, &marked, before);
    tl_nav_tile_stack a = bake_marked(config, *field, field->area, before);
    tl_nav_tile_stack b = bake_marked(config, *field, field->area, after);
    const bool same = same_stacks(&a, &b), changed = memcmp(before, after, count) != 0;
    TEST_CHECK(same || !kept);
    TEST_CHECK(kept || changed);
    tally->kept += kept && changed;
    for (uint32_t i = 0; i < count && kept && changed; i++) {
        if (before[i] != after[i]) {
            tally->kept_cut += before[i] == TL_NAV_NULL_AREA || after[i] == TL_NAV_NULL_AREA;
            break;
        }
    }
    tally->same += !kept && same;
    tally->other += !same;
    tl_nav_tile_stack_free(&a);
    tl_nav_tile_stack_free(&b);
}

static void compare_changes(tl_nav_partition used, int rounds, change_tally *tally)
{
    static tile_fields tiles;
    test_random random = { 71 };
    memset(tally, 0, sizeof *tally);
    partition = used;
    make_fields(&tiles);
    for (int round = 0; round < rounds; round++) {
        for (uint32_t t = 0; t < tiles.count; t++) {
            compare_change(&random, &tiles.configs[t], &tiles.fields[t], tally);
        }
    }
    for (uint32_t t = 0; t < tiles.count; t++) {
        tl_nav_compact_free(&tiles.fields[t]);
    }
}

static int rounds_of(int few)
{
    const char *more = getenv("TALUS_ROUNDS");
    return more != NULL ? atoi(more) : few;
}

static void monotone(void **state)
{
    (void)state;
    change_tally tally;
    compare_changes(TL_NAV_MONOTONE, rounds_of(1500), &tally);
    TEST_CHECK(tally.kept > 200 && tally.kept_cut > 100 && tally.other > 1000 && tally.same > 50);
}

static void layers(void **state)
{
    (void)state;
    change_tally tally;
    compare_changes(TL_NAV_LAYERS, rounds_of(1500), &tally);
    TEST_CHECK(tally.kept > 200 && tally.kept_cut > 100 && tally.other > 1000 && tally.same > 50);
}

// Distances carry a change anywhere.
static void watershed(void **state)
{
    (void)state;
    change_tally tally;
    compare_changes(TL_NAV_WATERSHED, 10, &tally);
    TEST_CHECK(tally.kept == 0 && tally.other > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(monotone), cmocka_unit_test(layers),
                                        cmocka_unit_test(watershed) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
