// SPDX-License-Identifier: MIT

#include "cli/level/area_sums.h"

#include "cli/shared/json_out.h"

#include <stdio.h>
#include <talus/nav_bake.h>

void tl_area_sums_add(tl_area_sums *sums, const tl_nav_tile *tile)
{
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        const uint8_t area = tl_nav_tile_area(tile, p);
        sums->polygons[area]++;
        sums->square_metres[area] += tl_nav_tile_polygon_area(tile, p);
    }
}

bool tl_area_sums_has_others(const tl_area_sums *sums)
{
    for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
        if (area != TL_NAV_WALKABLE_AREA && sums->polygons[area] > 0) {
            return true;
        }
    }
    return false;
}

void tl_area_sums_print(const tl_area_sums *sums)
{
    const bool others = tl_area_sums_has_others(sums);
    for (int area = 0; others && area <= TL_NAV_MAX_AREA; area++) {
        if (sums->polygons[area] > 0) {
            printf("area %-4d  %llu polygons, %.1f m2\n", area, (unsigned long long)sums->polygons[area],
                   sums->square_metres[area]);
        }
    }
}

json_t *tl_area_sums_json(const tl_area_sums *sums)
{
    json_t *array = json_array();
    for (int area = 0; area <= TL_NAV_MAX_AREA; area++) {
        if (sums->polygons[area] > 0) {
            json_array_append_new(array,
                                  json_pack("{si sI so}", "area", area, "polygons", (json_int_t)sums->polygons[area],
                                            "square_metres", tl_json_double(sums->square_metres[area])));
        }
    }
    return array;
}
