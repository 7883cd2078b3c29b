// SPDX-License-Identifier: MIT
//
// What must hold of any partition into regions.

#ifndef TALUS_NAV_REGION_CHECKS_H
#define TALUS_NAV_REGION_CHECKS_H

#include "nav_compact_fixture.h"

/// A config that divides with the given rule and areas.
static inline tl_nav_config region_config(tl_nav_partition partition, uint32_t min_area, uint32_t merge_area)
{
    tl_nav_config config;
    memset(&config, 0, sizeof config);
    config.partition = partition;
    config.min_region_area = min_area;
    config.merge_region_area = merge_area;
    return config;
}

/// Labels the connected parts of floors that satisfy region[i] == region[seed]. Returns the size of the seed's part.
static inline uint32_t region_part_size(const tl_nav_compact *compact, const uint32_t *region, uint32_t seed,
                                        uint8_t *seen, uint32_t *queue)
{
    uint32_t head = 0, tail = 0;
    seen[seed] = 1;
    queue[tail++] = seed;
    while (head < tail) {
        uint32_t i = queue[head++];
        for (uint32_t d = 0; d < 4; d++) {
            uint32_t beside = tl_nav_compact_neighbour(compact, i, d);
            if (beside != TL_NAV_NO_SPAN && !seen[beside] && region[beside] == region[seed]) {
                seen[beside] = 1;
                queue[tail++] = beside;
            }
        }
    }
    return tail;
}

/// Regions are of one area, connected, used, and hold no two floors of a column. Floors that are not walkable have
/// none.
static inline void check_regions(const tl_nav_compact *compact, const uint32_t *region, uint32_t region_count)
{
    uint32_t count = compact->span_count;
    uint32_t *size = calloc(region_count + 1, sizeof *size), *last_column = calloc(region_count + 1, sizeof *size);
    uint32_t *queue = calloc(count + 1, sizeof *queue);
    uint8_t *area = calloc(region_count + 1, 1), *seen = calloc(count + 1, 1);
    for (uint32_t c = 0; c < compact->width * compact->height; c++) {
        uint32_t x = c % compact->width, z = c / compact->width, border = compact->border_size;
        bool inside = x >= border && z >= border && x + border < compact->width && z + border < compact->height;
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            uint32_t r = region[i];
            if (compact->area[i] == TL_NAV_NULL_AREA) {
                TEST_CHECK(r == 0);
            } else if (!inside) {
                TEST_CHECK((r & TL_NAV_BORDER_REGION) != 0 && (r & ~TL_NAV_BORDER_REGION) - 1 < 4);
            } else if (r != 0) {
                TEST_CHECK(r < region_count);
                TEST_CHECK(last_column[r] != c + 1); // does not lie over itself
                last_column[r] = c + 1;
                TEST_CHECK(size[r] == 0 || area[r] == compact->area[i]);
                area[r] = compact->area[i];
                size[r]++;
            }
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        if (region[i] != 0 && region[i] < region_count && !seen[i]) {
            TEST_CHECK(region_part_size(compact, region, i, seen, queue) == size[region[i]]); // connected
            size[region[i]] = 0;
        }
    }
    free(size);
    free(last_column);
    free(queue);
    free(area);
    free(seen);
}

/// A walkable floor has no region exactly when its island (walkable floors that touch, of any area, without the border)
/// has fewer than min_area floors and does not reach the border. Returns the number of dropped floors.
static inline uint32_t check_islands(const tl_nav_compact *compact, uint32_t min_area)
{
    uint32_t count = compact->span_count, dropped = 0;
    uint32_t *kind = calloc(count + 1, sizeof *kind), *queue = calloc(count + 1, sizeof *queue);
    uint8_t *seen = calloc(count + 1, 1);
    for (uint32_t i = 0; i < count; i++) {
        kind[i] = compact->area[i] == TL_NAV_NULL_AREA ? 0 : (compact->region[i] & TL_NAV_BORDER_REGION) != 0 ? 2 : 1;
    }
    for (uint32_t i = 0; i < count; i++) {
        if (kind[i] != 1 || seen[i]) {
            continue;
        }
        uint32_t size = region_part_size(compact, kind, i, seen, queue);
        bool at_border = false;
        for (uint32_t k = 0; k < size; k++) {
            for (uint32_t d = 0; d < 4; d++) {
                uint32_t beside = tl_nav_compact_neighbour(compact, queue[k], d);
                at_border |= beside != TL_NAV_NO_SPAN && kind[beside] == 2;
            }
        }
        bool expected = size >= min_area || at_border;
        for (uint32_t k = 0; k < size; k++) {
            TEST_CHECK((compact->region[queue[k]] != 0) == expected);
        }
        dropped += expected ? 0 : size;
    }
    free(kind);
    free(queue);
    free(seen);
    return dropped;
}

#endif
