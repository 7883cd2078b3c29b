// SPDX-License-Identifier: MIT
//
// A hash of what a navmesh answers, bit for bit: two navmeshes with the same one are the same to their readers.

#ifndef TALUS_TEST_NAV_ANSWERS_H
#define TALUS_TEST_NAV_ANSWERS_H

#include "talus_test.h"

#include "base/hash.h"

#include <string.h>
#include <talus/nav_around.h>
#include <talus/nav_prepare.h>
#include <talus/nav_state.h>
#include <talus/nav_wide.h>

enum { TEST_ANSWER_CAPACITY = 512 };

static inline uint64_t test_mix(uint64_t hash, uint64_t value)
{
    return tl_hash_mix(hash * 0x9e3779b97f4a7c15u + value);
}

static inline uint64_t test_mix_float(uint64_t hash, double value)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    return test_mix(hash, bits);
}

static inline uint64_t test_mix_point(uint64_t hash, tl_vec3 point)
{
    hash = test_mix_float(hash, (double)point.x);
    hash = test_mix_float(hash, (double)point.y);
    return test_mix_float(hash, (double)point.z);
}

/// Counts, tiles, links, islands, flags and areas of all polygons, off-mesh links.
static inline uint64_t test_table_hash(const tl_navmesh *navmesh)
{
    uint64_t hash = test_mix(tl_navmesh_tile_count(navmesh), tl_navmesh_link_count(navmesh));
    hash = test_mix(hash, tl_navmesh_edit_count(navmesh));
    hash = test_mix(hash, tl_navmesh_is_prepared(navmesh));
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            const tl_nav_ref ref = tl_navmesh_polygon_ref(navmesh, slot, p);
            tl_nav_link links[64];
            tl_nav_ref from[64];
            uint32_t count = 0, island = 0, from_count = 0;
            hash = test_mix(hash, (uint64_t)tl_navmesh_links(navmesh, ref, links, 64, &count));
            for (uint32_t i = 0; i < count && i < 64; i++) {
                hash = test_mix(test_mix(hash, links[i].to), links[i].edge);
                hash = test_mix_point(test_mix_point(hash, links[i].left), links[i].right);
            }
            hash = test_mix(hash, (uint64_t)tl_navmesh_island(navmesh, ref, &island));
            hash = test_mix(hash, (uint64_t)tl_navmesh_offmesh_from(navmesh, ref, from, 64, &from_count));
            hash = test_mix(test_mix(hash, island), from_count);
            hash = test_mix(test_mix(hash, tl_nav_tile_flags(tile, p)), tl_nav_tile_area(tile, p));
        }
    }
    uint32_t cursor = 0;
    tl_nav_ref link;
    while (tl_navmesh_next_offmesh(navmesh, &cursor, &link)) {
        tl_nav_offmesh_state state;
        hash = test_mix(hash, (uint64_t)tl_navmesh_offmesh_state(navmesh, link, &state));
        hash = test_mix(test_mix(hash, state.ends[0].polygon), state.ends[1].polygon);
        hash = test_mix_float(test_mix_float(hash, (double)state.length), (double)state.cost);
    }
    return hash;
}

/// One random pair of places: a path by areas' costs, the shortest one, a wide one, a ray, what is nearest.
static inline uint64_t test_pair_hash(const tl_navmesh *navmesh, tl_nav_query *query, test_random *random)
{
    tl_nav_location ends[2];
    uint64_t hash = 1;
    for (int i = 0; i < 2; i++) {
        const uint64_t numbers[2] = { test_random_u64(random), test_random_u64(random) };
        hash = test_mix(hash, (uint64_t)tl_navmesh_random_point(navmesh, NULL, numbers, &ends[i]));
        hash = test_mix_point(test_mix(hash, ends[i].polygon), ends[i].point);
    }
    if (ends[0].polygon == TL_NAV_NO_REF) {
        return hash;
    }
    tl_nav_filter dear = tl_default_nav_filter();
    for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
        dear.area_cost[area] = 1.0f + (float)(area % 5);
    }
    tl_nav_ref polygons[TEST_ANSWER_CAPACITY];
    tl_nav_path path;
    const tl_nav_path_request dear_request = { &dear, ends[0], ends[1] }, plain = { NULL, ends[0], ends[1] };
    hash = test_mix(
        hash, (uint64_t)tl_nav_query_find_path(query, navmesh, &dear_request, polygons, TEST_ANSWER_CAPACITY, &path));
    hash = test_mix(hash, (uint64_t)path.status);
    for (uint32_t i = 0; i < path.polygon_count && i < TEST_ANSWER_CAPACITY; i++) {
        hash = test_mix(hash, polygons[i]);
    }
    tl_nav_shortest_path shortest;
    hash = test_mix(hash, (uint64_t)tl_nav_query_find_shortest_path(query, navmesh, &plain, NULL, &shortest));
    hash = test_mix_float(test_mix(hash, (uint64_t)shortest.status), shortest.length);
    tl_nav_corner corners[TEST_ANSWER_CAPACITY];
    tl_nav_wide_path wide;
    hash = test_mix(hash, (uint64_t)tl_nav_query_find_wide_path(query, navmesh, &plain, 0.6f, corners,
                                                                TEST_ANSWER_CAPACITY, &wide));
    hash = test_mix_float(test_mix(hash, (uint64_t)wide.status), wide.length);
    tl_nav_ray_hit hit;
    hash = test_mix(hash, (uint64_t)tl_navmesh_cast_ray(navmesh, NULL, &ends[0], ends[1].point, NULL, 0, &hit));
    hash = test_mix_float(test_mix(hash, hit.hit), (double)hit.t);
    tl_nav_location nearest;
    hash = test_mix(hash, (uint64_t)tl_navmesh_find_nearest(navmesh, NULL, tl_scale(ends[1].point, 1.01f),
                                                            tl_vec3_make(2, 2, 2), &nearest));
    return test_mix_point(test_mix(hash, nearest.polygon), nearest.point);
}

/// Of the table, and of so many pairs.
static inline uint64_t test_answers_hash(const tl_navmesh *navmesh, tl_nav_query *query, uint32_t pairs)
{
    test_random random = { 7 };
    uint64_t hash = test_table_hash(navmesh);
    for (uint32_t i = 0; i < pairs; i++) {
        hash = test_mix(hash, test_pair_hash(navmesh, query, &random));
    }
    return hash;
}

#endif
