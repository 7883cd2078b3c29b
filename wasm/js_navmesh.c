// SPDX-License-Identifier: MIT
//
// Navmeshes: baked, put together from tiles, and read for drawing.

#include "js_navmesh.h"
#include "js_threads.h"

#include <stdlib.h>
#include <string.h>

tl_js_navmesh *tl_js_navmesh_create(void)
{
    tl_js_navmesh *self = calloc(1, sizeof *self);
    if (self == NULL || tl_navmesh_create(tl_js_allocator(), &self->navmesh) != TL_OK) {
        free(self);
        return NULL;
    }
    self->max_nodes = 1u << 30; // as in navmesh.js
    self->def = tl_default_nav_def();
    return self;
}

void tl_js_navmesh_destroy(tl_js_navmesh *self)
{
    if (self == NULL) {
        return;
    }
    tl_nav_query_destroy(self->query);
    tl_navmesh_destroy(self->navmesh);
    tl_navmesh_destroy(self->removed);
    tl_nav_obstacles_destroy(self->obstacles);
    tl_blob_free(self->pruning);
    free(self->links);
    for (uint32_t i = 0; i < self->copy_count; i++) {
        free(self->copies[i]);
    }
    free(self->copies);
    free(self->corners);
    free(self->polygons);
    free(self);
}

tl_result tl_js_navmesh_query(tl_js_navmesh *self, tl_nav_query **query_out)
{
    tl_result result = TL_OK;
    if (self->query == NULL) {
        tl_nav_query_def def = tl_default_nav_query_def();
        def.max_nodes = self->max_nodes;
        result = tl_nav_query_create(&def, &self->query, &tl_js_report);
    }
    *query_out = self->query;
    return result;
}

void TL_JS_EXPORT(js_navmesh_free)(tl_js_navmesh *self)
{
    tl_js_navmesh_destroy(self);
}

/// The next search makes a query with so many nodes.
void TL_JS_EXPORT(js_navmesh_set_nodes)(tl_js_navmesh *self, uint32_t max_nodes)
{
    tl_nav_query_destroy(self->query);
    self->query = NULL;
    self->max_nodes = max_nodes;
}

// ---------------------------------------------------------------------------------------------------------
// Baking.

double tl_js_pruned_area(const tl_js_navmesh *self)
{
    return self->pruning != NULL ? self->pruning->min_area : 0.0;
}

// The tiles of what was pruned become a navmesh of their own.
static tl_result keep_removed(tl_js_navmesh *self, tl_nav_tiles *removed)
{
    tl_result result = removed->tile_count > 0 ? tl_navmesh_create(NULL, &self->removed) : TL_OK;
    if (result == TL_OK && removed->tile_count > 0) {
        result =
            tl_navmesh_add_tiles(self->removed, removed->tiles, removed->tile_count, TL_NAV_TILE_OWNED, &tl_js_report);
        if (result == TL_OK) {
            removed->tile_count = 0; // the navmesh has them now
        }
    }
    tl_nav_tiles_free(removed);
    return result;
}

static tl_result prune_tiles(tl_js_navmesh *self, tl_nav_tiles *tiles, uint32_t prune_at)
{
    // Slot: how many seeds, whether islands inside solids go, the smallest area, then the seeds' address.
    const uint32_t seed_count = tl_js_u32(prune_at);
    const bool inside = tl_js_slot[prune_at + 1] != 0.0;
    const double min_area = tl_js_slot[prune_at + 2];
    if ((seed_count == 0 && !inside && !(min_area > 0.0)) || tiles->tile_count == 0) {
        return TL_OK;
    }
    tl_nav_prune_def def = tl_default_nav_prune_def();
    def.seeds = (const tl_vec3 *)(uintptr_t)tl_js_slot[prune_at + 3];
    def.seed_count = seed_count;
    def.solids = inside ? &tl_js_input.mesh : NULL;
    def.min_area = min_area;
    def.host = *tl_js_host();
    tl_result result = tl_pack_pruning_encode(&def, NULL, &self->pruning, &tl_js_report);
    if (result != TL_OK) {
        return result;
    }
    tl_nav_tiles removed;
    tl_nav_prune_report report;
    result = tl_nav_prune(&def, tiles, &removed, &report);
    tl_js_report = report.base;
    return result == TL_OK ? keep_removed(self, &removed) : result;
}

static tl_result bake_tiles(tl_js_navmesh *self, uint32_t prune_at)
{
    tl_nav_tiles tiles;
    tl_nav_def def = self->def;
    def.host = *tl_js_host();
    tl_result result = tl_nav_bake(&def, &tl_js_input, &tiles, &self->report);
    tl_js_report = self->report.base;
    if (result != TL_OK) {
        return result;
    }
    self->tiles_x = tiles.tiles_x;
    self->tiles_z = tiles.tiles_z;
    result = prune_tiles(self, &tiles, prune_at);
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(self->navmesh, tiles.tiles, tiles.tile_count, TL_NAV_TILE_OWNED, &tl_js_report);
    }
    if (result == TL_OK) {
        tiles.tile_count = 0; // the navmesh has them now
    }
    tl_nav_tiles_free(&tiles);
    return result;
}

static tl_result bake_with_obstacles(tl_js_navmesh *self)
{
    tl_nav_tile_block block;
    memset(&block, 0, sizeof block);
    tl_nav_def def = self->def;
    def.host = *tl_js_host();
    tl_result result = tl_nav_obstacles_bake(&def, &tl_js_input, &self->obstacles, &block, &self->report);
    tl_js_report = self->report.base;
    const uint32_t places = block.range.count_x * block.range.count_z;
    for (uint32_t i = 0; i < places && result == TL_OK; i++) {
        const uint32_t x = block.range.x + i % block.range.count_x, z = block.range.z + i / block.range.count_x;
        result = tl_navmesh_replace_tiles(self->navmesh, (int32_t)x, (int32_t)z, &block.stacks[i]);
    }
    self->tiles_x = block.range.count_x;
    self->tiles_z = block.range.count_z;
    tl_nav_tile_block_free(&block);
    return result;
}

/// Slot: a def, then from `prune_at` what is pruned; then the result.
tl_js_navmesh *TL_JS_FULL_EXPORT(js_navmesh_bake)(uint32_t prune_at, int32_t obstacles)
{
    tl_js_navmesh *self = tl_js_navmesh_create();
    if (self == NULL) {
        tl_js_put(0, TL_ERR_MEMORY);
        return NULL;
    }
    self->def = tl_js_nav_def(0);
    if (tl_aabb_is_empty(self->def.bounds)) {
        self->def.bounds = tl_js_input_bounds();
    }
    const tl_result result = obstacles ? bake_with_obstacles(self) : bake_tiles(self, prune_at);
    tl_js_put(0, result);
    if (result != TL_OK) {
        tl_js_navmesh_destroy(self);
        self = NULL;
    }
    return self;
}

/// Slot: a def. An empty navmesh, for tiles. NULL: out of memory.
tl_js_navmesh *TL_JS_EXPORT(js_navmesh_empty)(void)
{
    tl_js_navmesh *self = tl_js_navmesh_create();
    if (self != NULL) {
        self->def = tl_js_nav_def(0);
    }
    return self;
}

/// Adds a tile that js_alloc gave memory, to the navmesh or to what was pruned from it; the memory is the navmesh's
/// from then on, also on failure.
tl_result TL_JS_EXPORT(js_navmesh_add_copy)(tl_js_navmesh *self, void *bytes, uint32_t size, int32_t pruned)
{
    if (self->copy_count == self->copy_capacity) {
        const uint32_t capacity = 2 * self->copy_capacity + 16;
        void **copies = realloc(self->copies, capacity * sizeof *copies);
        if (copies == NULL) {
            free(bytes);
            return TL_ERR_MEMORY;
        }
        self->copies = copies;
        self->copy_capacity = capacity;
    }
    self->copies[self->copy_count++] = bytes;
    tl_result result = tl_nav_tile_check(bytes, size, &tl_js_report);
    if (result == TL_OK && ((const tl_blob *)bytes)->size != size) {
        result = TL_ERR_TRUNCATED;
    }
    if (result == TL_OK && pruned && self->removed == NULL) {
        result = tl_navmesh_create(NULL, &self->removed);
    }
    tl_navmesh *target = pruned ? self->removed : self->navmesh;
    return result == TL_OK ? tl_navmesh_add_tile(target, bytes, TL_NAV_TILE_BORROWED) : result;
}

/// Slot: the def with the bounds that were baked, then the grid of tiles.
void TL_JS_EXPORT(js_navmesh_def)(const tl_js_navmesh *self)
{
    const uint32_t at = tl_js_put_nav_def(0, &self->def);
    tl_js_put(tl_js_put(at, self->tiles_x), self->tiles_z);
}

void TL_JS_EXPORT(js_navmesh_report)(const tl_js_navmesh *self)
{
    const tl_nav_bake_report *r = &self->report;
    const double numbers[] = { (double)r->span_count,
                               (double)r->compact_span_count,
                               r->region_count,
                               r->filtered_regions,
                               (double)r->filtered_spans,
                               r->filtered_area,
                               r->contour_count,
                               r->unbridged_holes,
                               r->slit_outlines,
                               r->repaired_contours,
                               r->polygon_count,
                               r->vertex_count,
                               r->detail_triangle_count,
                               r->limited_patches,
                               r->tile_count,
                               (double)r->base.peak_bytes };
    memcpy(tl_js_slot, numbers, sizeof numbers);
}

/// Slot: tiles, polygons, corners, detail vertices, detail triangles, links.
void TL_JS_EXPORT(js_navmesh_counts)(const tl_js_navmesh *self)
{
    double polygons = 0, corners = 0, vertices = 0, triangles = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(self->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(self->navmesh, slot);
        if (tile != NULL) {
            polygons += tile->polygon_count;
            corners += tile->corner_count;
            vertices += tile->detail_vertex_count;
            triangles += tile->detail_triangle_count;
        }
    }
    uint32_t at = tl_js_put(tl_js_put(0, tl_navmesh_tile_count(self->navmesh)), polygons);
    at = tl_js_put(tl_js_put(tl_js_put(at, corners), vertices), triangles);
    tl_js_put(at, (double)tl_navmesh_link_count(self->navmesh));
}

// ---------------------------------------------------------------------------------------------------------
// Tiles in the order of a file.

static const tl_navmesh *sorted_navmesh;

static int compare_slots(const void *left, const void *right)
{
    const tl_nav_tile *a = tl_navmesh_slot_tile(sorted_navmesh, *(const uint32_t *)left);
    const tl_nav_tile *b = tl_navmesh_slot_tile(sorted_navmesh, *(const uint32_t *)right);
    if (a->tile_z != b->tile_z) {
        return a->tile_z < b->tile_z ? -1 : 1;
    }
    if (a->tile_x != b->tile_x) {
        return a->tile_x < b->tile_x ? -1 : 1;
    }
    return (a->layer > b->layer) - (a->layer < b->layer);
}

uint32_t *tl_js_tile_order(const tl_navmesh *navmesh)
{
    const uint32_t slots = tl_navmesh_slot_count(navmesh);
    uint32_t *order = malloc((slots + 1) * sizeof *order);
    if (order == NULL) {
        return NULL;
    }
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < slots; slot++) {
        if (tl_navmesh_slot_tile(navmesh, slot) != NULL) {
            order[count++] = slot;
        }
    }
    sorted_navmesh = navmesh;
    qsort(order, count, sizeof *order, compare_slots);
    return order;
}

/// The slots of all tiles, in order, to be freed with js_free; how many js_navmesh_counts says. NULL: out of memory.
uint32_t *TL_JS_EXPORT(js_tile_order)(const tl_js_navmesh *self)
{
    return tl_js_tile_order(self->navmesh);
}

/// Slot: where the tile of a slot lies, what it is, and its arrays.
void TL_JS_EXPORT(js_tile_info)(const tl_js_navmesh *self, uint32_t slot)
{
    const tl_nav_tile *tile = tl_navmesh_slot_tile(self->navmesh, slot);
    uint32_t at = tl_js_put_pointer(0, tile);
    at = tl_js_put(at, (double)tile->blob.size);
    at = tl_js_put(tl_js_put(tl_js_put(at, tile->tile_x), tile->tile_z), tile->layer);
    at = tl_js_put(tl_js_put(at, tile->polygon_count), tile->area);
    at = tl_js_put_aabb(at, tile->bounds);
    at = tl_js_put(at, tile->corner_count);
    at = tl_js_put(tl_js_put(at, tile->detail_vertex_count), tile->detail_triangle_count);
    at = tl_js_put(at, tile->wide);
    const uint32_t arrays[] = { tile->first_corner,
                                tile->links,
                                tile->flags,
                                tile->areas,
                                tile->detail_first_vertex,
                                tile->detail_first_triangle,
                                tile->detail_vertices,
                                tile->detail_triangles };
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        at = tl_js_put_pointer(at, tl_nav_tile_at(tile, arrays[i]));
    }
    tl_js_put_u64(at, tl_navmesh_polygon_ref(self->navmesh, slot, 0));
}

/// The islands of a tile's polygons, in the buffer. NULL: out of memory.
uint32_t *TL_JS_EXPORT(js_tile_islands)(const tl_js_navmesh *self, uint32_t slot)
{
    const tl_nav_tile *tile = tl_navmesh_slot_tile(self->navmesh, slot);
    uint32_t *islands = tl_js_buffer_room(tile->polygon_count * sizeof *islands);
    for (uint32_t p = 0; islands != NULL && p < tile->polygon_count; p++) {
        tl_navmesh_island(self->navmesh, tl_navmesh_polygon_ref(self->navmesh, slot, p), &islands[p]);
    }
    return islands;
}

typedef struct portal_record {
    uint32_t from, to_slot, to_polygon, edge;
    tl_vec3 left, right;
} portal_record;

/// The links of a tile's polygons: ten 32-bit numbers each. Slot: how many, and where.
tl_result TL_JS_EXPORT(js_tile_portals)(const tl_js_navmesh *self, uint32_t slot)
{
    const tl_nav_tile *tile = tl_navmesh_slot_tile(self->navmesh, slot);
    tl_js_buffer *buffer = tl_js_buffer_begin();
    tl_nav_link *links = NULL;
    uint32_t capacity = 0;
    tl_result result = TL_OK;
    for (uint32_t p = 0; p < tile->polygon_count && result == TL_OK; p++) {
        const tl_nav_ref ref = tl_navmesh_polygon_ref(self->navmesh, slot, p);
        uint32_t count = 0;
        while ((result = tl_navmesh_links(self->navmesh, ref, links, capacity, &count)) == TL_INCOMPLETE) {
            free(links);
            capacity = count;
            links = malloc(capacity * sizeof *links);
            if (links == NULL) {
                capacity = 0;
                result = TL_ERR_MEMORY;
                break;
            }
        }
        for (uint32_t i = 0; i < count && result == TL_OK; i++) {
            const uint64_t to = links[i].to;
            const portal_record record = { p,
                                           (uint32_t)(to >> 28 & 0xfffff),
                                           (uint32_t)(to & 0xfffffff),
                                           links[i].edge,
                                           links[i].left,
                                           links[i].right };
            tl_js_buffer_add(buffer, &record, sizeof record);
        }
    }
    free(links);
    tl_js_put_pointer(tl_js_put(0, (double)(buffer->used / sizeof(portal_record))), buffer->bytes);
    return result == TL_OK && buffer->failed ? TL_ERR_MEMORY : result;
}
