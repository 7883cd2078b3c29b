// SPDX-License-Identifier: MIT
//
// What the tables of the searches on a navmesh share: two places of the level, and a call's input with the case's
// flaw.

#ifndef TALUS_TEST_CONTRACT_NAV_H
#define TALUS_TEST_CONTRACT_NAV_H

#include "contract.h"

#include <math.h>
#include <string.h>

enum { CONTRACT_CAPACITY = 256 };

/// A pointer, or NULL where that is the case.
#define CONTRACT_INPUT(run, number, pointer)                                                                           \
    ((run)->what == CONTRACT_NULL_INPUT && (run)->variant == (number) ? NULL : (pointer))
#define CONTRACT_OUTPUT(run, number, pointer)                                                                          \
    ((run)->what == CONTRACT_NULL_OUTPUT && (run)->variant == (number) ? NULL : (pointer))

/// What a search is called with.
typedef struct contract_nav {
    const tl_navmesh *navmesh; ///< NULL input 0
    tl_nav_query *query;       ///< NULL input 1; with few nodes in CONTRACT_NO_NODES
    tl_nav_filter own_filter;
    tl_nav_location here, there; ///< `here` is stale in CONTRACT_STALE
    uint32_t capacity;           ///< of the buffer
} contract_nav;

static inline tl_nav_location contract_nav_location(tl_vec3 point)
{
    const contract_level *level = contract_level_get();
    tl_nav_location location;
    TEST_RESULT(tl_navmesh_find_nearest(level->navmesh, NULL, point, tl_vec3_make(1, 1, 1), &location), TL_OK);
    return location;
}

static inline contract_nav contract_nav_begin(const contract_run *run)
{
    const contract_level *level = contract_level_get();
    contract_nav nav;
    memset(&nav, 0, sizeof nav);
    nav.navmesh = CONTRACT_INPUT(run, 0, level->navmesh);
    nav.query = CONTRACT_INPUT(run, 1, run->what == CONTRACT_NO_NODES ? level->tiny_query : level->query);
    if (run->what != CONTRACT_ZEROED_DEF) {
        nav.own_filter = tl_default_nav_filter();
    }
    nav.here = contract_nav_location(level->here);
    nav.there = contract_nav_location(level->there);
    if (run->what == CONTRACT_STALE) {
        nav.here.polygon = level->stale;
    }
    nav.capacity = run->what == CONTRACT_NO_BUFFER ? 0 : CONTRACT_CAPACITY;
    return nav;
}

/// The filter of a call: none, a zeroed one, or the default one.
static inline const tl_nav_filter *contract_nav_filter(const contract_run *run, const contract_nav *nav)
{
    return run->what == CONTRACT_NULL_DEF ? NULL : &nav->own_filter;
}

/// After a call with the whole buffer: whether another one with a buffer that is short by one is the case.
static inline bool contract_nav_shorten(contract_run *run, uint32_t count, contract_nav *nav)
{
    run->count = count;
    if (run->what != CONTRACT_SHORT_BUFFER || nav->capacity != CONTRACT_CAPACITY || count == 0) {
        return false;
    }
    nav->capacity = count - 1;
    return true;
}

/// Whether outputs are as they must be after a result: the caller's, where one was NULL; zeroed after an error.
static inline bool contract_nav_is_clear(const contract_run *run, tl_result result, const void *output, size_t size)
{
    return run->what == CONTRACT_NULL_OUTPUT || run->what == CONTRACT_NULL_INPUT || result == TL_ERR_NODES ||
           contract_is_zero(output, size);
}

#endif
