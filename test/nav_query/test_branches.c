// SPDX-License-Identifier: MIT
//
// Branches of tiles: a step leads astray when the goal can be reached from behind it only by coming back over the same
// edge. In one tile all such steps are known, in several those that the step's own tile shows; a number makes that many
// levels of each kind.

#include "nav_fixture.h"

#include "nav_query/navmesh/ring_step.h"

#include <stdlib.h>

static uint32_t levels = 12;

// A place for each polygon of all tiles, in slot order.
typedef struct all_polygons {
    uint32_t first[64]; // by slot
    uint32_t count;
} all_polygons;

static all_polygons number_polygons(const tl_navmesh *navmesh)
{
    all_polygons all = { { 0 }, 0 };
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        all.first[slot] = all.count;
        all.count += navmesh->slots[slot].tile != NULL ? navmesh->slots[slot].tile->polygon_count : 0;
    }
    return all;
}

// Whether a goal can be reached from behind an edge without going over it.
static bool leads_on(const tl_navmesh *navmesh, const all_polygons *all, tl_nav_ring_place edge, tl_nav_ring_place twin,
                     tl_nav_ring_seam goal)
{
    bool *is_met = calloc(all->count, sizeof *is_met);
    tl_nav_ring_seam *queue = calloc(all->count, sizeof *queue);
    uint32_t count = 0;
    queue[count++] = (tl_nav_ring_seam){ twin.slot, twin.polygon };
    is_met[all->first[twin.slot] + twin.polygon] = true;
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_ring_seam at = queue[i];
        const tl_nav_ring ring = tl_nav_ring_at(navmesh, at.slot, at.polygon);
        for (uint32_t k = 0; k < ring.count; k++) {
            const bool is_edge = at.slot == edge.slot && at.polygon == edge.polygon && k == edge.edge;
            const bool is_twin = at.slot == twin.slot && at.polygon == twin.polygon && k == twin.edge;
            if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, k)) || is_edge || is_twin) {
                continue;
            }
            const tl_nav_ring_seam to = tl_nav_ring_across(navmesh, at.slot, tl_nav_ring_to(&ring, k));
            bool *met = &is_met[all->first[to.slot] + to.polygon];
            if (!*met) {
                *met = true;
                queue[count++] = to;
            }
        }
    }
    const bool leads = is_met[all->first[goal.slot] + goal.polygon];
    free(is_met);
    free(queue);
    return leads;
}

// Steps over all edges of a polygon, to one goal. Counts those that lead astray.
static uint32_t check_steps(const tl_navmesh *navmesh, const all_polygons *all, tl_nav_ring_seam from,
                            tl_nav_ring_seam goal)
{
    uint32_t astray = 0;
    const tl_nav_ring ring = tl_nav_ring_at(navmesh, from.slot, from.polygon);
    for (uint32_t k = 0; k < ring.count; k++) {
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, k))) {
            continue;
        }
        const tl_nav_ring_place edge = { from.slot, from.polygon, k };
        const tl_nav_ring_place twin = tl_nav_ring_twin(navmesh, from.slot, from.polygon, &ring, k);
        const bool is_astray =
            tl_nav_leads_astray(navmesh, from, tl_nav_ring_across(navmesh, from.slot, tl_nav_ring_to(&ring, k)), goal);
        const bool is_on = leads_on(navmesh, all, edge, twin, goal);
        TEST_CHECK(!(is_astray && is_on));
        TEST_CHECK(navmesh->tile_count > 1 || is_astray || is_on);
        astray += is_astray;
    }
    return astray;
}

static uint64_t check_level(const tl_navmesh *navmesh, test_random *random)
{
    const all_polygons all = number_polygons(navmesh);
    uint64_t astray = 0;
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        const uint32_t polygons = navmesh->slots[slot].tile != NULL ? navmesh->slots[slot].tile->polygon_count : 0;
        for (uint32_t p = 0; p < polygons; p++) {
            tl_nav_ring_seam goal = { test_random_below(random, navmesh->slot_count), 0 };
            if (navmesh->slots[goal.slot].tile == NULL) {
                continue;
            }
            goal.polygon = test_random_below(random, navmesh->slots[goal.slot].tile->polygon_count);
            if (tl_nav_island_of(navmesh, slot, p) == tl_nav_island_of(navmesh, goal.slot, goal.polygon)) {
                astray += check_steps(navmesh, &all, (tl_nav_ring_seam){ slot, p }, goal);
            }
        }
    }
    return astray;
}

// Whole levels, then with tiles taken out of them: what is a branch then was one before, or is found to be one.
static void test_steps(void **state)
{
    (void)state;
    test_random random = { 5 };
    uint64_t astray[2] = { 0, 0 };
    for (uint32_t i = 0; i < 6 * levels; i++) {
        fixture_level level = fixture_random(&random, i % 6, 12);
        level.tile_cells = i / 6 % 2 * 4;
        tl_navmesh *navmesh = fixture_build(&level, NULL);
        astray[level.tile_cells > 0] += check_level(navmesh, &random);
        for (uint32_t k = 0; k < 3 && level.tile_cells > 0; k++) {
            tl_navmesh_remove_tile(navmesh, (int32_t)k, (int32_t)(k * k % 3)); // it may be empty
            check_level(navmesh, &random);
        }
        tl_navmesh_destroy(navmesh);
    }
    print_message("steps that lead astray: %llu in one tile, %llu in many\n", (unsigned long long)astray[0],
                  (unsigned long long)astray[1]);
    TEST_CHECK(astray[0] > 500 && astray[1] > 200);
}

int main(int argc, char **argv)
{
    levels = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : levels;
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_steps) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
