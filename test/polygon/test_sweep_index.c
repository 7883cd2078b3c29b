// SPDX-License-Identifier: MIT

#include "polygon/outline/sweep_index.h"

#include "talus_test.h"

enum { ITEMS = 3000 };

static tl_sweep_item items[ITEMS]; // by place on the line
static tl_sweep_index tree;

static uint32_t depth_of(uint32_t item)
{
    uint32_t depth = 0;
    for (; items[item].parent != TL_NO_SEGMENT; item = items[item].parent) {
        TEST_CHECK(items[items[item].parent].child[items[item].parent < item] == item);
        depth++;
    }
    TEST_CHECK(tree.root == item);
    return depth;
}

// Each item is reached by its place, and no deeper than twice as deep as in a full tree.
static void check_tree(void)
{
    uint32_t count = 0, limit = 2;
    for (uint32_t most = tree.most; most > 1; most /= 2) {
        limit += 2;
    }
    for (uint32_t i = 0; i < ITEMS; i++) {
        if (items[i].parent == TL_NOT_INDEXED) {
            continue;
        }
        count++;
        TEST_CHECK(depth_of(i) < limit);
        uint32_t at = tree.root;
        while (at != i && at != TL_NO_SEGMENT) {
            at = items[at].child[at < i];
        }
        TEST_CHECK(at == i);
    }
    TEST_CHECK(count == tree.count && count <= tree.most && count >= tree.most / 2);
}

static void add(uint32_t item)
{
    uint32_t below = item;
    while (below > 0 && items[below - 1].parent == TL_NOT_INDEXED) {
        below--;
    }
    tl_sweep_index_add(&tree, below > 0 ? below - 1 : TL_NO_SEGMENT, item);
}

static void begin(void)
{
    tree = (tl_sweep_index){ items, TL_NO_SEGMENT, 0, 0 };
    for (uint32_t i = 0; i < ITEMS; i++) {
        items[i].parent = TL_NOT_INDEXED;
    }
}

static void stays_flat_in_any_order(void **state)
{
    (void)state;
    for (uint32_t order = 0; order < 4; order++) {
        begin();
        for (uint32_t i = 0; i < ITEMS; i++) {
            const uint32_t inward = i % 2 == 0 ? i / 2 : ITEMS - 1 - i / 2;
            const uint32_t by_order[4] = { i, ITEMS - 1 - i, inward, (i * 1009) % ITEMS };
            add(by_order[order]);
            if (i % 100 == 0) {
                check_tree();
            }
        }
        check_tree();
        TEST_CHECK(tree.count == ITEMS);
        for (uint32_t i = 0; i < ITEMS; i++) {
            tl_sweep_index_remove(&tree, order % 2 == 0 ? i : (i * 1009 + 5) % ITEMS);
            if (i % 100 == 0) {
                check_tree();
            }
        }
        TEST_CHECK(tree.count == 0 && tree.root == TL_NO_SEGMENT);
    }
}

static void comes_and_goes_at_random(void **state)
{
    (void)state;
    test_random random = { 5 };
    begin();
    for (uint32_t round = 0; round < 40000; round++) {
        // Now more come, now more go.
        const uint32_t item = test_random_below(&random, round / 5000 % 2 == 0 ? ITEMS : ITEMS / 4);
        if (items[item].parent == TL_NOT_INDEXED) {
            add(item);
        } else {
            tl_sweep_index_remove(&tree, item);
        }
        if (round % 200 == 0) {
            check_tree();
        }
    }
    for (uint32_t item = 0; item < ITEMS; item++) {
        if (items[item].parent != TL_NOT_INDEXED) {
            tl_sweep_index_remove(&tree, item);
        }
    }
    TEST_CHECK(tree.count == 0 && tree.root == TL_NO_SEGMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(stays_flat_in_any_order),
                                        cmocka_unit_test(comes_and_goes_at_random) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
