// SPDX-License-Identifier: MIT
//
// Compact heightfields for tests, made straight from maps of floors: ASCII art, or random storeys.

#ifndef TALUS_NAV_COMPACT_FIXTURE_H
#define TALUS_NAV_COMPACT_FIXTURE_H

#include "talus_test.h"

#include <talus/nav_bake.h>

#include "base/arena.h"

#include <string.h>

enum { FIXTURE_MAX_STOREYS = 8, FIXTURE_CLIMB = 2, FIXTURE_HEIGHT = 10 };

/// Floors of each column, bottom to top. area 0 with `present` is a floor that is not walkable.
typedef struct fixture_floor {
    int height; ///< voxels; < 0: no floor
    uint8_t area;
} fixture_floor;

typedef struct fixture_map {
    uint32_t width, height;
    fixture_floor *floors; ///< [width * height][FIXTURE_MAX_STOREYS]
} fixture_map;

static inline fixture_map fixture_map_make(uint32_t width, uint32_t height)
{
    fixture_map map = { width, height, NULL };
    size_t count = (size_t)width * height * FIXTURE_MAX_STOREYS;
    map.floors = (fixture_floor *)calloc(count, sizeof *map.floors);
    for (size_t i = 0; i < count; i++) {
        map.floors[i].height = -1;
    }
    return map;
}

static inline fixture_floor *fixture_column(const fixture_map *map, uint32_t x, uint32_t z)
{
    return map->floors + ((size_t)z * map->width + x) * FIXTURE_MAX_STOREYS;
}

/// Adds a floor on top of the column's others; at least FIXTURE_HEIGHT + 1 above the last, or it is left out.
static inline bool fixture_add_floor(fixture_map *map, uint32_t x, uint32_t z, int height, uint8_t area)
{
    fixture_floor *column = fixture_column(map, x, z);
    for (int k = 0; k < FIXTURE_MAX_STOREYS; k++) {
        if (column[k].height < 0) {
            if (k > 0 && height < column[k - 1].height + FIXTURE_HEIGHT + 1) {
                return false;
            }
            column[k].height = height;
            column[k].area = area;
            return true;
        }
    }
    return false;
}

static inline int fixture_floor_count(const fixture_map *map, uint32_t x, uint32_t z)
{
    const fixture_floor *column = fixture_column(map, x, z);
    int count = 0;
    while (count < FIXTURE_MAX_STOREYS && column[count].height >= 0) {
        count++;
    }
    return count;
}

static inline uint32_t fixture_link(const tl_nav_compact *compact, uint32_t i, uint32_t column)
{
    for (uint32_t k = compact->first_span[column]; k < compact->first_span[column + 1]; k++) {
        int low = compact->floor[i], other_low = compact->floor[k];
        int high = low + compact->clearance[i], other_high = other_low + compact->clearance[k];
        int open = (high < other_high ? high : other_high) - (low > other_low ? low : other_low);
        int step = low > other_low ? low - other_low : other_low - low;
        if (open >= FIXTURE_HEIGHT && step <= FIXTURE_CLIMB) {
            return k;
        }
    }
    return TL_NAV_NO_SPAN;
}

static inline void fixture_compact_init(tl_nav_compact *compact, uint32_t width, uint32_t height, uint32_t border)
{
    memset(compact, 0, sizeof *compact);
    compact->width = width;
    compact->height = height;
    compact->border_size = border;
    compact->allocator = tl_allocator_or_default(NULL);
    compact->walkable_height = FIXTURE_HEIGHT;
    compact->walkable_climb = FIXTURE_CLIMB;
    compact->cell_size = 0.5f;
    compact->cell_height = 0.25f;
    compact->lattice.origin = tl_vec3_make(-3.0f, 0.0f, 7.0f);
    compact->bounds.min = compact->lattice.origin;
    compact->bounds.max = tl_vec3_make(-3.0f + 0.5f * (float)width, 300.0f, 7.0f + 0.5f * (float)height);
}

/// The map as a compact heightfield. Free it with fixture_compact_free.
static inline tl_nav_compact fixture_compact_make(const fixture_map *map, uint32_t border)
{
    tl_nav_compact compact;
    fixture_compact_init(&compact, map->width, map->height, border);
    uint32_t column_count = map->width * map->height;
    compact.first_span = (uint32_t *)tl_allocate_array(NULL, column_count + 1, sizeof(uint32_t));
    uint32_t count = 0;
    for (uint32_t c = 0; c < column_count; c++) {
        compact.first_span[c] = count;
        count += (uint32_t)fixture_floor_count(map, c % map->width, c / map->width);
    }
    compact.first_span[column_count] = count;
    compact.span_count = count;
    compact.floor = (uint16_t *)tl_allocate_array(NULL, count, sizeof(uint16_t));
    compact.clearance = (uint16_t *)tl_allocate_array(NULL, count, sizeof(uint16_t));
    compact.area = (uint8_t *)tl_allocate_array(NULL, count, sizeof(uint8_t));
    compact.neighbour = (uint32_t *)tl_allocate_array(NULL, 4 * (uint64_t)count, sizeof(uint32_t));
    for (uint32_t c = 0; c < column_count; c++) {
        const fixture_floor *column = fixture_column(map, c % map->width, c / map->width);
        for (uint32_t i = compact.first_span[c], k = 0; i < compact.first_span[c + 1]; i++, k++) {
            bool last = i + 1 == compact.first_span[c + 1];
            compact.floor[i] = (uint16_t)column[k].height;
            compact.area[i] = column[k].area;
            compact.clearance[i] = (uint16_t)(last ? 0xffff : column[k + 1].height - column[k].height - 1);
        }
    }
    static const int step_x[4] = { -1, 0, 1, 0 }, step_z[4] = { 0, 1, 0, -1 };
    for (uint32_t c = 0; c < column_count; c++) {
        for (uint32_t i = compact.first_span[c]; i < compact.first_span[c + 1]; i++) {
            for (int d = 0; d < 4; d++) {
                int x = (int)(c % map->width) + step_x[d], z = (int)(c / map->width) + step_z[d];
                bool inside = x >= 0 && z >= 0 && x < (int)map->width && z < (int)map->height;
                compact.neighbour[4 * i + (uint32_t)d] =
                    inside ? fixture_link(&compact, i, (uint32_t)z * map->width + (uint32_t)x) : TL_NAV_NO_SPAN;
            }
        }
    }
    return compact;
}

static inline void fixture_compact_free(tl_nav_compact *compact)
{
    uint32_t count = compact->span_count;
    tl_release_array(NULL, compact->first_span, (uint64_t)compact->width * compact->height + 1, sizeof(uint32_t));
    tl_release_array(NULL, compact->floor, count, sizeof(uint16_t));
    tl_release_array(NULL, compact->clearance, count, sizeof(uint16_t));
    tl_release_array(NULL, compact->area, count, sizeof(uint8_t));
    tl_release_array(NULL, compact->neighbour, 4 * (uint64_t)count, sizeof(uint32_t));
    tl_release_array(&compact->allocator, compact->distance, count, sizeof(uint16_t));
    tl_release_array(&compact->allocator, compact->region, count, sizeof(uint32_t));
    memset(compact, 0, sizeof *compact);
}

static inline void fixture_map_free(fixture_map *map)
{
    free(map->floors);
    map->floors = NULL;
}

/// One storey from ASCII rows of equal length: ' ' nothing, '#' a floor that is not walkable, '0'-'9' a floor at that
/// height of area 63, 'a'-'z' a floor at height 0 of area 1-26.
static inline tl_nav_compact fixture_from_rows(const char *const *rows, uint32_t row_count, uint32_t border)
{
    fixture_map map = fixture_map_make((uint32_t)strlen(rows[0]), row_count);
    for (uint32_t z = 0; z < row_count; z++) {
        TEST_CHECK(strlen(rows[z]) == map.width);
        for (uint32_t x = 0; x < map.width; x++) {
            char c = rows[z][x];
            if (c == '#') {
                fixture_add_floor(&map, x, z, 0, TL_NAV_NULL_AREA);
            } else if (c >= '0' && c <= '9') {
                fixture_add_floor(&map, x, z, c - '0', TL_NAV_WALKABLE_AREA);
            } else if (c >= 'a' && c <= 'z') {
                fixture_add_floor(&map, x, z, 0, (uint8_t)(1 + c - 'a'));
            }
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, border);
    fixture_map_free(&map);
    return compact;
}

/// Rolling storeys with holes, bridges between them by ramps, and patches of other areas.
static inline tl_nav_compact fixture_random(test_random *random, uint32_t width, uint32_t height, int storeys,
                                            uint32_t hole_percent, uint32_t border)
{
    fixture_map map = fixture_map_make(width, height);
    for (int s = 0; s < storeys; s++) {
        int base = 20 * s, ramp = (int)test_random_below(random, 3);
        float lean = test_random_range(random, 0.0f, 1.5f), phase = test_random_range(random, 0.0f, 6.0f);
        uint32_t hole_x = test_random_below(random, width), hole_z = test_random_below(random, height);
        uint32_t hole_size = test_random_below(random, width / 3 + 1);
        uint32_t patch_x = test_random_below(random, width), patch_z = test_random_below(random, height);
        uint32_t patch_size = test_random_below(random, width / 3 + 1);
        for (uint32_t z = 0; z < height; z++) {
            for (uint32_t x = 0; x < width; x++) {
                bool hole = x - hole_x < hole_size && z - hole_z < hole_size;
                if (hole || test_random_below(random, 100) < hole_percent) {
                    continue;
                }
                bool patch = x - patch_x < patch_size && z - patch_z < patch_size;
                // A ramp storey climbs to the next storey's height and overlaps it.
                float rise = ramp == 0   ? lean * (float)x
                             : ramp == 1 ? lean * (float)z
                                         : 1.0f + sinf(phase + (float)x * 0.3f);
                bool dead = test_random_below(random, 200) == 0;
                uint8_t area = dead ? TL_NAV_NULL_AREA : patch ? 7 : TL_NAV_WALKABLE_AREA;
                fixture_add_floor(&map, x, z, base + (int)rise, area);
            }
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, border);
    fixture_map_free(&map);
    return compact;
}

/// A ramp that winds up `turns` times round a pillar: every floor but the ends has one above or below it.
static inline tl_nav_compact fixture_spiral(uint32_t size, uint32_t inner, int turns)
{
    fixture_map map = fixture_map_make(size, size);
    int climb_turn = 16;
    for (uint32_t z = 0; z < size; z++) {
        for (uint32_t x = 0; x < size; x++) {
            int dx = 2 * (int)x - (int)size + 1, dz = 2 * (int)z - (int)size + 1;
            int reach = dx * dx > dz * dz ? (dx < 0 ? -dx : dx) : (dz < 0 ? -dz : dz);
            if (reach < 2 * (int)inner) {
                continue;
            }
            // Fraction of a turn along the square round, [0, 1).
            float side = dx >= (dz < 0 ? -dz : dz)    ? 0.0f + (float)(dz + reach) / (8.0f * (float)reach)
                         : dz >= (dx < 0 ? -dx : dx)  ? 0.25f + (float)(reach - dx) / (8.0f * (float)reach)
                         : -dx >= (dz < 0 ? -dz : dz) ? 0.5f + (float)(reach - dz) / (8.0f * (float)reach)
                                                      : 0.75f + (float)(dx + reach) / (8.0f * (float)reach);
            for (int t = 0; t < turns; t++) {
                fixture_add_floor(&map, x, z, (int)((side + (float)t) * (float)climb_turn), TL_NAV_WALKABLE_AREA);
            }
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, 0);
    fixture_map_free(&map);
    return compact;
}

#endif
