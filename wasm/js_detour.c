// SPDX-License-Identifier: MIT
//
// Navmeshes from Detour's bytes and to them, with their off-mesh connections.

#include "js_navmesh.h"

#include <stdlib.h>
#include <string.h>

static void put_detour_report(uint32_t at, const tl_detour_report *report)
{
    const uint32_t numbers[] = { report->tile_count,       report->polygon_count, report->plain_patches,
                                 report->dropped_polygons, report->one_way_links, report->off_mesh_links,
                                 report->off_mesh_outside, report->off_mesh_far,  report->area_zeros };
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        at = tl_js_put(at, numbers[i]);
    }
    tl_js_report = report->base;
}

static tl_result add_connections(tl_navmesh *navmesh, const tl_detour_off_mesh *connections, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_offmesh link = tl_default_nav_offmesh();
        link.start = connections[i].start;
        link.end = connections[i].end;
        link.radius = connections[i].radius;
        link.user = connections[i].user_id;
        link.flags = connections[i].flags;
        link.area = connections[i].area;
        link.both_ways = connections[i].both_ways;
        tl_nav_ref ref;
        const tl_result result = tl_navmesh_add_offmesh(navmesh, &link, &ref, &tl_js_report);
        if (result != TL_OK) {
            return result;
        }
    }
    return TL_OK;
}

static tl_result read_connections(tl_navmesh *navmesh, const void *bytes, uint32_t size, tl_detour_report *report)
{
    uint32_t count = 0;
    tl_result result = tl_detour_read_off_mesh(bytes, size, NULL, 0, &count, report);
    if (result != TL_INCOMPLETE) {
        return result;
    }
    tl_detour_off_mesh *connections = calloc(count, sizeof *connections);
    if (connections == NULL) {
        return TL_ERR_MEMORY;
    }
    result = tl_detour_read_off_mesh(bytes, size, connections, count, &count, report);
    result = result == TL_OK ? add_connections(navmesh, connections, count) : result;
    free(connections);
    return result;
}

/// Into an empty navmesh: a set, or a single tile. Slot: the cell height; then the report.
tl_result TL_JS_FULL_EXPORT(js_detour_read)(tl_js_navmesh *self, const void *bytes, uint32_t size)
{
    tl_detour_read_def def = tl_default_detour_read_def();
    def.cell_height = tl_js_f32(0);
    tl_detour_tiles tiles;
    tl_detour_report report, connections;
    tl_result result = tl_detour_read(bytes, size, &def, &tiles, &report);
    put_detour_report(0, &report);
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(self->navmesh, tiles.tiles, tiles.tile_count, TL_NAV_TILE_OWNED, &tl_js_report);
        if (result == TL_OK) {
            memset(tiles.tiles, 0, tiles.tile_count * sizeof *tiles.tiles); // the navmesh's now
            result = read_connections(self->navmesh, bytes, size, &connections);
        }
    }
    tl_detour_tiles_free(&tiles);
    return result;
}

// All off-mesh links, as connections: NULL without memory.
static tl_detour_off_mesh *collect_connections(const tl_navmesh *navmesh, tl_result *result)
{
    tl_detour_off_mesh *connections = calloc((size_t)tl_navmesh_offmesh_count(navmesh) + 1, sizeof *connections);
    *result = connections != NULL ? TL_OK : TL_ERR_MEMORY;
    tl_nav_ref ref;
    for (uint32_t cursor = 0, i = 0; *result == TL_OK && tl_navmesh_next_offmesh(navmesh, &cursor, &ref); i++) {
        tl_nav_offmesh_state state;
        *result = tl_navmesh_offmesh_state(navmesh, ref, &state);
        const tl_nav_offmesh *link = &state.offmesh;
        connections[i] = (tl_detour_off_mesh){ link->start,           link->end,  link->radius,   (uint32_t)link->user,
                                               (uint16_t)link->flags, link->area, link->both_ways };
        if (link->flags > UINT16_MAX || link->user > UINT32_MAX) {
            const tl_report report = { .element = "off_mesh",
                                       .element_index = i,
                                       .advice = "give flags of 16 bits and a user number of 32" };
            tl_js_report = report;
            *result = TL_ERR_LIMIT;
        }
    }
    return connections;
}

static tl_result write_set(const tl_detour_set *set, tl_detour_report *report)
{
    const uint64_t size = tl_detour_linked_set_size(set);
    void *bytes = tl_js_buffer_room((size_t)size + 1);
    if (bytes == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(report, 0, sizeof *report);
    const tl_result result = tl_detour_linked_set_write(set, bytes, size, report);
    put_detour_report(2, report);
    tl_js_put(tl_js_put_pointer(0, bytes), (double)size);
    return result;
}

/// All tiles as a set. Slot: where it lies, its size, the report. It is valid until the next call.
tl_result TL_JS_FULL_EXPORT(js_detour_write)(const tl_js_navmesh *self, int32_t wide_refs)
{
    const uint32_t count = tl_navmesh_tile_count(self->navmesh);
    uint32_t *order = tl_js_tile_order(self->navmesh);
    const tl_nav_tile **tiles = calloc((size_t)count + 1, sizeof *tiles);
    tl_result result;
    tl_detour_off_mesh *connections = collect_connections(self->navmesh, &result);
    if (order == NULL || tiles == NULL) {
        result = TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; result == TL_OK && i < count; i++) {
        tiles[i] = tl_navmesh_slot_tile(self->navmesh, order[i]);
    }
    if (result == TL_OK) {
        const tl_detour_set set = { tiles, count, connections, tl_navmesh_offmesh_count(self->navmesh),
                                    wide_refs != 0 ? TL_DETOUR_REFS_64 : TL_DETOUR_REFS_32 };
        tl_detour_report report;
        result = write_set(&set, &report);
    }
    free(connections);
    free(tiles);
    free(order);
    return result;
}
