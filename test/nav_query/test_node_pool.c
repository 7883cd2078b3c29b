// SPDX-License-Identifier: MIT
//
// The nodes of a search, their table and their heap, against plain arrays: keys that were given nodes, the cheapest way
// to each, the order in which nodes come out.

#include "talus_test.h"

#include "nav_query/search/node_pool.h"
#include "nav_query/search/query_memory.h"

enum { KEYS = 300, POOL = 256 };

// What the pool must know of a key.
typedef struct plain_node {
    float cost, total;
    bool is_known, is_closed;
} plain_node;

static tl_nav_query *make_query(void)
{
    tl_nav_query *query = NULL;
    const tl_nav_query_sizes sizes = { 16, 0 };
    TEST_RESULT(tl_nav_query_allocate(POOL, sizes, NULL, &query), TL_OK);
    return query;
}

// A search of random keys and costs over the pool; returns how often it was used up.
static uint32_t search(tl_nav_query *query, test_random *random)
{
    plain_node plain[KEYS] = { { 0 } };
    uint32_t known = 0, refused = 0, open = 0;
    tl_nav_pool_reset(query);
    for (int step = 0; step < 2000; step++) {
        if (test_random_below(random, 4) > 0) {
            const uint32_t k = test_random_below(random, KEYS);
            // Keys of a few tiles, as references have them.
            const tl_nav_way_in way = {
                (uint64_t)(k % 3) << 40 | k,          k % 3,         k, tl_vec3_make((float)k, 0, 0),
                (float)test_random_below(random, 50), (uint32_t)step
            };
            bool is_full = false;
            tl_nav_node *node = tl_nav_pool_relax(query, way, &is_full);
            TEST_CHECK(is_full == (!plain[k].is_known && known == POOL));
            const bool is_cheaper =
                !is_full && (!plain[k].is_known || (!plain[k].is_closed && way.cost < plain[k].cost));
            TEST_CHECK((node != NULL) == is_cheaper);
            refused += is_full;
            if (node != NULL) {
                TEST_CHECK(node->key == way.key && node->slot == way.slot && node->polygon == k &&
                           node->cost == way.cost && node->point.x == (float)k && node->parent == way.parent);
                known += !plain[k].is_known;
                open += !plain[k].is_known;
                plain[k].is_known = true;
                plain[k].cost = way.cost;
                // A cheaper way may enter where the goal is farther.
                plain[k].total = node->total = way.cost + (float)test_random_below(random, 50);
                tl_nav_heap_improve(query, (uint32_t)(node - query->nodes));
            }
        } else {
            const uint32_t index = tl_nav_heap_pop(query);
            TEST_CHECK((index == TL_NAV_NO_NODE) == (open == 0));
            if (index != TL_NAV_NO_NODE) {
                const uint32_t k = query->nodes[index].polygon;
                TEST_CHECK(plain[k].is_known && !plain[k].is_closed && query->nodes[index].total == plain[k].total);
                for (uint32_t i = 0; i < KEYS; i++) {
                    TEST_CHECK(!plain[i].is_known || plain[i].is_closed || plain[i].total >= plain[k].total);
                }
                plain[k].is_closed = true;
                open--;
            }
        }
    }
    TEST_CHECK(query->node_count == known);
    return refused;
}

static void nodes_are_those_of_a_plain_search(void **state)
{
    (void)state;
    test_random random = { 5 };
    tl_nav_query *query = make_query();
    uint32_t refused = 0;
    for (int round = 0; round < 50; round++) {
        refused += search(query, &random); // each forgets the one before
    }
    TEST_CHECK(refused > 100);
    tl_nav_query_release(query);
}

// Of nodes of one total the one that was made first comes first, so that a path depends on nothing else.
static void ties_come_in_the_order_of_nodes(void **state)
{
    (void)state;
    tl_nav_query *query = make_query();
    tl_nav_pool_reset(query);
    for (uint32_t k = 0; k < 100; k++) {
        bool is_full = false;
        const tl_nav_way_in way = { 1000 - k, 0, k, tl_vec3_make(0, 0, 0), 1.0f, TL_NAV_NO_NODE };
        tl_nav_node *node = tl_nav_pool_relax(query, way, &is_full);
        TEST_CHECK(node != NULL);
        node->total = 1.0f;
        tl_nav_heap_improve(query, (uint32_t)(node - query->nodes));
    }
    for (uint32_t k = 0; k < 100; k++) {
        TEST_CHECK(tl_nav_heap_pop(query) == k);
    }
    TEST_CHECK(tl_nav_heap_pop(query) == TL_NAV_NO_NODE);
    tl_nav_query_release(query);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(nodes_are_those_of_a_plain_search),
                                        cmocka_unit_test(ties_come_in_the_order_of_nodes) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
