// SPDX-License-Identifier: MIT
//
// Which layer of its place a polygon belongs to.
//
// The unit is a region: a connected piece of floor that does not lie over itself, so within a storey. Rejected: each
// polygon by its own height, which cuts every slope along every border between layers; columns of voxels, which cut
// polygons. A region that climbs (a hill, one turn of a spiral ramp) belongs to the layer where it begins.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"

#include <string.h>
#include <talus/nav_build.h>

static int32_t lowest_corner(const tl_polygon_mesh *polygons, uint32_t p)
{
    int32_t lowest = INT32_MAX;
    for (uint32_t k = polygons->first[p]; k < polygons->first[p + 1]; k++) {
        const int32_t height = polygons->vertices[3 * (size_t)polygons->indices[k] + 1];
        lowest = height < lowest ? height : lowest;
    }
    return lowest;
}

tl_result tl_nav_assign_layers(const tl_nav_config *config, const tl_polygon_mesh *polygons,
                               const tl_allocator *allocator, uint32_t *layers_out)
{
    if (config->layer_height == 0) {
        memset(layers_out, 0, polygons->polygon_count * sizeof *layers_out);
        return TL_OK;
    }
    uint32_t region_count = 1;
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        region_count = polygons->regions[p] >= region_count ? polygons->regions[p] + 1 : region_count;
    }
    int32_t *lowest = tl_allocate_array(allocator, region_count, sizeof *lowest);
    if (lowest == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t region = 0; region < region_count; region++) {
        lowest[region] = INT32_MAX;
    }
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        const int32_t height = lowest_corner(polygons, p);
        const uint32_t region = polygons->regions[p];
        lowest[region] = height < lowest[region] ? height : lowest[region];
    }
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        const uint32_t region = polygons->regions[p];
        const int32_t height = region != TL_SEVERAL_REGIONS ? lowest[region] : lowest_corner(polygons, p);
        const uint32_t layer = height > 0 ? (uint32_t)height / config->layer_height : 0;
        layers_out[p] = layer < TL_NAV_MAX_LAYER ? layer : TL_NAV_MAX_LAYER;
    }
    tl_release_array(allocator, lowest, region_count, sizeof *lowest);
    return TL_OK;
}
