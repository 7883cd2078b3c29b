// SPDX-License-Identifier: MIT
//
// How much of a navmesh each area has.

#ifndef TALUS_CLI_AREA_SUMS_H
#define TALUS_CLI_AREA_SUMS_H

#include <jansson.h>
#include <talus/nav_tile.h>

/// Polygons and square metres in the plane. Zero is none.
typedef struct tl_area_sums {
    uint64_t polygons[TL_NAV_MAX_AREA + 1];
    double square_metres[TL_NAV_MAX_AREA + 1];
} tl_area_sums;

void tl_area_sums_add(tl_area_sums *sums, const tl_nav_tile *tile);

/// Whether there is an area beside the one that slope gives.
bool tl_area_sums_has_others(const tl_area_sums *sums);

/// A line for each area that has polygons; nothing when there are no others.
void tl_area_sums_print(const tl_area_sums *sums);

/// [{"area": 63, "polygons": 12, "square_metres": 3.5}, ...]
json_t *tl_area_sums_json(const tl_area_sums *sums);

#endif
