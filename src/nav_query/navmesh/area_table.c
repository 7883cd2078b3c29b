// SPDX-License-Identifier: MIT
//
// Sums of areas that change as tiles come and go: a Fenwick tree over the slots, and running sums within each
// tile.
//
// Polygons lie on a lattice, so that twice their area is a whole number. Sums of those are exact: they do not depend on
// the order in which tiles came, nor on how many came and went, and a random number picks each square with exactly the
// same probability. They fit 64 bits up to 2^63 squares, which is more than the earth's surface in cells of a
// centimetre.
// Source: Fenwick, A New Data Structure for Cumulative Frequency Tables, 1994.

#include "nav_query/navmesh/area_table.h"

#include "base/arena.h"

#include <string.h>

static uint64_t doubled_polygon_area(const tl_nav_tile *tile, uint32_t polygon)
{
    uint32_t count = 0;
    tl_nav_tile_corners(tile, polygon, &count);
    const tl_nav_lattice_point origin = tl_nav_tile_lattice(tile, polygon, 0);
    int64_t sum = 0;
    for (uint32_t i = 1; i + 1 < count; i++) {
        const tl_nav_lattice_point a = tl_nav_tile_lattice(tile, polygon, i);
        const tl_nav_lattice_point b = tl_nav_tile_lattice(tile, polygon, i + 1);
        int64_t ax = (int64_t)a.at[0] - origin.at[0];
        int64_t az = (int64_t)a.at[2] - origin.at[2];
        int64_t bx = (int64_t)b.at[0] - origin.at[0];
        int64_t bz = (int64_t)b.at[2] - origin.at[2];
        sum += bx * az - bz * ax;
    }
    return sum > 0 ? (uint64_t)sum : 0;
}

static size_t sum_size(const tl_nav_areas *areas)
{
    return areas->is_wide ? sizeof *areas->sums.wide : sizeof *areas->sums.narrow;
}

// False: the sum of all does not fit 32 bits, and the numbers are narrow.
static bool sum_up_areas(const tl_nav_tile *tile, const tl_nav_areas *areas)
{
    uint64_t sum = 0;
    for (uint32_t p = 0; p <= tile->polygon_count; p++) {
        if (areas->is_wide) {
            areas->sums.wide[p] = sum;
        } else {
            areas->sums.narrow[p] = (uint32_t)sum;
        }
        sum += p < tile->polygon_count ? doubled_polygon_area(tile, p) : 0;
    }
    return areas->is_wide || sum <= UINT32_MAX;
}

tl_result tl_nav_areas_make(const tl_allocator *allocator, const tl_nav_tile *tile, tl_nav_areas *areas_out)
{
    for (int wide = 0; wide < 2; wide++) {
        areas_out->is_wide = wide > 0;
        areas_out->sums.wide = tl_allocate_array(allocator, (uint64_t)tile->polygon_count + 1, sum_size(areas_out));
        if (areas_out->sums.wide == NULL) {
            break;
        }
        if (sum_up_areas(tile, areas_out)) {
            return TL_OK;
        }
        tl_nav_areas_free(allocator, areas_out, tile->polygon_count);
    }
    memset(areas_out, 0, sizeof *areas_out);
    return TL_ERR_MEMORY;
}

void tl_nav_areas_free(const tl_allocator *allocator, tl_nav_areas *areas, uint32_t polygon_count)
{
    if (areas->sums.wide != NULL) {
        tl_release_array(allocator, areas->sums.wide, (uint64_t)polygon_count + 1, sum_size(areas));
        memset(areas, 0, sizeof *areas);
    }
}

static uint64_t slot_area(const tl_nav_slot *slot)
{
    return slot->tile != NULL ? tl_nav_area_before(slot, slot->tile->polygon_count) : 0;
}

// Entry i + 1 sums the slots i - (i & -i) .. i, as Fenwick has it.
static uint32_t lowest_bit(uint32_t i)
{
    return i & (~i + 1u);
}

void tl_nav_area_table_fill(uint64_t *table, uint32_t capacity, const tl_nav_slot *slots, uint32_t slot_count)
{
    memset(table, 0, ((size_t)capacity + 1) * sizeof *table);
    for (uint32_t i = 1; i <= capacity; i++) {
        table[i] += i <= slot_count ? slot_area(&slots[i - 1]) : 0;
        uint32_t above = i + lowest_bit(i);
        if (above <= capacity) {
            table[above] += table[i];
        }
    }
}

void tl_nav_area_table_change(tl_navmesh *navmesh, uint32_t slot, int sign)
{
    uint64_t area = slot_area(&navmesh->slots[slot]);
    for (uint32_t i = slot + 1; i <= navmesh->slot_capacity; i += lowest_bit(i)) {
        navmesh->area_table[i] += sign > 0 ? area : ~area + 1u;
        tl_nav_touch(navmesh->history, TL_NAV_PAGED_AREAS, i);
    }
}

uint64_t tl_nav_area_table_sum(const tl_navmesh *navmesh)
{
    uint64_t sum = 0;
    for (uint32_t i = navmesh->slot_count; i > 0; i -= lowest_bit(i)) {
        sum += navmesh->area_table[i];
    }
    return sum;
}

uint32_t tl_nav_area_table_find(const tl_navmesh *navmesh, uint64_t *at)
{
    uint32_t step = 1;
    while (2 * step <= navmesh->slot_capacity) {
        step *= 2;
    }
    uint32_t before = 0;
    for (; step > 0; step /= 2) {
        if (before + step <= navmesh->slot_capacity && navmesh->area_table[before + step] <= *at) {
            before += step;
            *at -= navmesh->area_table[before];
        }
    }
    return before;
}
