// SPDX-License-Identifier: MIT
//
// The layer of each polygon of a place.
//
// Regions are assigned as wholes: each is connected and does not overlap itself, so most often a storey or less. Its
// layer is the one that holds most of its area, so that a storey stays whole, together with the stairs of its region.
// Rejected: each polygon by its own height, which cuts every slope along every border between layers; the region's
// lowest corner, which puts a storey that takes the stairs from below along into the layer below; columns of voxels,
// which cut polygons.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/radix_sort.h"

#include <string.h>
#include <talus/nav_bake.h>

// Of the mean of its corners.
static uint32_t own_layer(const tl_polygon_mesh *polygons, uint32_t p, uint32_t layer_height)
{
    const uint32_t count = polygons->first[p + 1] - polygons->first[p];
    int64_t sum = 0;
    for (uint32_t k = polygons->first[p]; k < polygons->first[p + 1]; k++) {
        sum += polygons->vertices[3 * (size_t)polygons->indices[k] + 1];
    }
    const int64_t layer = sum > 0 ? sum / ((int64_t)count * layer_height) : 0;
    return layer < TL_NAV_MAX_LAYER ? (uint32_t)layer : TL_NAV_MAX_LAYER;
}

static int64_t double_area(const tl_polygon_mesh *polygons, uint32_t p)
{
    const uint32_t first = polygons->first[p];
    const int32_t *a = polygons->vertices + 3 * (size_t)polygons->indices[first];
    int64_t sum = 0;
    for (uint32_t k = first + 1; k + 1 < polygons->first[p + 1]; k++) {
        const int32_t *b = polygons->vertices + 3 * (size_t)polygons->indices[k];
        const int32_t *c = polygons->vertices + 3 * (size_t)polygons->indices[k + 1];
        sum += ((int64_t)c[0] - a[0]) * ((int64_t)b[2] - a[2]) - ((int64_t)b[0] - a[0]) * ((int64_t)c[2] - a[2]);
    }
    return sum;
}

// Polygons by region, then by their own layer: the layer with the largest area, the lowest of several, is that of all.
static void assign_region(const tl_polygon_mesh *polygons, const tl_sort_item *items, uint32_t count,
                          uint32_t *layers_out)
{
    uint32_t best = 0;
    int64_t most = -1;
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        int64_t area = 0;
        for (end = begin; end < count && items[end].key == items[begin].key; end++) {
            area += double_area(polygons, items[end].value);
        }
        if (area > most) {
            most = area;
            best = (uint32_t)items[begin].key;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        layers_out[items[i].value] = best;
    }
}

tl_result tl_nav_assign_layers(const tl_nav_config *config, const tl_polygon_mesh *polygons,
                               const tl_allocator *allocator, uint32_t *layers_out, tl_report *report_out)
{
    tl_report_begin(report_out, "layers");
    TL_REFUSE_NULL(config, report_out);
    TL_REFUSE_NULL(polygons, report_out);
    TL_REFUSE_NULL(layers_out, report_out);
    const uint32_t count = polygons->polygon_count;
    if (config->layer_height == 0) {
        memset(layers_out, 0, count * sizeof *layers_out);
        return TL_OK;
    }
    tl_sort_item *items = tl_allocate_array(allocator, 2 * (uint64_t)count, sizeof *items);
    if (items == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t p = 0; p < count; p++) {
        const uint32_t layer = own_layer(polygons, p, config->layer_height);
        const tl_sort_item item = { (uint64_t)polygons->regions[p] << 32 | layer, p, 0 };
        items[p] = item;
        layers_out[p] = layer; // which it keeps where it is of several regions
    }
    tl_radix_sort(items, items + count, count);
    for (uint32_t begin = 0, end; begin < count; begin = end) {
        const uint64_t region = items[begin].key >> 32;
        for (end = begin; end < count && items[end].key >> 32 == region; end++) {
        }
        if (region != TL_SEVERAL_REGIONS) {
            assign_region(polygons, items + begin, end - begin, layers_out);
        }
    }
    tl_release_array(allocator, items, 2 * (uint64_t)count, sizeof *items);
    return TL_OK;
}
