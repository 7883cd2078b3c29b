// SPDX-License-Identifier: MIT
//
// The baked file: the chunks and their order are those of `talus bake`.

#include "js_navmesh.h"

#include <stdlib.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------------------
// Reading.

static tl_pack pack;

/// The bytes stay JavaScript's, and must stand while the pack is read. Slot: chunks.
tl_result TL_JS_EXPORT(js_pack_open)(const void *bytes, uint32_t size)
{
    const tl_result result = tl_pack_open(bytes, size, &pack, &tl_js_report);
    tl_js_put(0, pack.chunk_count);
    return result;
}

/// Slot: type, id, size, address.
void TL_JS_EXPORT(js_pack_chunk)(uint32_t index)
{
    const tl_pack_chunk chunk = tl_pack_chunk_at(&pack, index);
    tl_js_put_pointer(tl_js_put(tl_js_put(tl_js_put(0, chunk.type), chunk.id), (double)chunk.size), chunk.bytes);
}

/// Slot: name, counts, bounds, up.
tl_result TL_JS_EXPORT(js_pack_meta)(const void *bytes, uint32_t size)
{
    const tl_result result = tl_pack_meta_check(bytes, size, &tl_js_report);
    if (result == TL_OK) {
        const tl_pack_meta *meta = bytes;
        uint32_t at = tl_js_put_pointer(0, tl_pack_meta_name(meta));
        at = tl_js_put(tl_js_put(at, (double)meta->source_vertices), (double)meta->source_triangles);
        tl_js_put(tl_js_put_aabb(at, meta->bounds), meta->source_up);
    }
    return result;
}

/// Slot: the def, then the grid of tiles.
tl_result TL_JS_EXPORT(js_pack_navmesh)(const void *bytes, uint32_t size, tl_js_navmesh *self)
{
    const tl_result result = tl_pack_navmesh_check(bytes, size, &tl_js_report);
    if (result == TL_OK) {
        const tl_pack_navmesh *navmesh = bytes;
        self->def = tl_pack_navmesh_def(navmesh);
        self->tiles_x = navmesh->tiles_x;
        self->tiles_z = navmesh->tiles_z;
    }
    return result;
}

/// Slot: the origin, then the axes.
tl_result TL_JS_EXPORT(js_pack_frame)(const void *bytes, uint32_t size)
{
    const tl_result result = tl_pack_frame_check(bytes, size, &tl_js_report);
    if (result == TL_OK) {
        const tl_pack_frame *frame = bytes;
        tl_js_put(tl_js_put(tl_js_put(tl_js_put(0, frame->origin[0]), frame->origin[1]), frame->origin[2]),
                  frame->axes);
    }
    return result;
}

/// The rules by which the navmesh was pruned: a copy is kept.
tl_result TL_JS_EXPORT(js_pack_pruning)(const void *bytes, uint32_t size, tl_js_navmesh *self)
{
    const tl_result result = tl_pack_pruning_check(bytes, size, &tl_js_report);
    if (result != TL_OK) {
        return result;
    }
    const tl_pack_pruning *rules = bytes;
    tl_nav_prune_def def = tl_default_nav_prune_def();
    const tl_mesh_view some_solids = { 0 };
    def.seeds = tl_pack_pruning_seeds(rules);
    def.seed_count = rules->seed_count;
    def.seed_extents = rules->seed_extents;
    def.solids = rules->drop_inside_solids ? &some_solids : NULL;
    def.min_area = rules->min_area;
    return tl_pack_pruning_encode(&def, NULL, &self->pruning, &tl_js_report);
}

/// Slot: how many links set by hand there are.
tl_result TL_JS_EXPORT(js_pack_offmesh)(const void *bytes, uint32_t size)
{
    const tl_result result = tl_pack_offmesh_check(bytes, size, &tl_js_report);
    tl_js_put(0, result == TL_OK ? ((const tl_pack_offmesh *)bytes)->count : 0.0);
    return result;
}

/// Slot: a link of checked ones.
void TL_JS_EXPORT(js_pack_offmesh_at)(const tl_pack_offmesh *offmesh, uint32_t index)
{
    const tl_nav_offmesh link = tl_pack_offmesh_at(offmesh, index);
    tl_js_put_offmesh(0, &link);
}

/// Slot: how many triangles have areas, and where.
tl_result TL_JS_EXPORT(js_pack_areas)(const void *bytes, uint32_t size)
{
    const tl_result result = tl_pack_areas_check(bytes, size, &tl_js_report);
    if (result == TL_OK) {
        const tl_pack_areas *areas = bytes;
        tl_js_put_pointer(tl_js_put(0, areas->count), tl_pack_areas_array(areas));
    }
    return result;
}

/// Slot: how many volumes there are.
tl_result TL_JS_EXPORT(js_pack_volumes)(const void *bytes, uint32_t size)
{
    const tl_result result = tl_pack_volumes_check(bytes, size, &tl_js_report);
    tl_js_put(0, result == TL_OK ? ((const tl_pack_volumes *)bytes)->count : 0.0);
    return result;
}

/// Slot: a volume of checked ones: kind, area, box, base, radius, height, points and where they are.
void TL_JS_EXPORT(js_pack_volume)(const tl_pack_volumes *volumes, uint32_t index)
{
    const tl_nav_volume v = tl_pack_volumes_at(volumes, index);
    uint32_t at = tl_js_put_vec3(tl_js_put_aabb(tl_js_put(tl_js_put(0, v.kind), v.area), v.box), v.base);
    at = tl_js_put(tl_js_put(tl_js_put(at, (double)v.radius), (double)v.height), v.point_count);
    tl_js_put_pointer(at, v.points);
}

// ---------------------------------------------------------------------------------------------------------
// Writing.

static tl_nav_offmesh *hand_links; // for the next file
static uint32_t hand_link_count;

/// Slot: a link set by hand, number `index` of `count`: the next file has them.
tl_result TL_JS_FULL_EXPORT(js_pack_put_link)(uint32_t index, uint32_t count)
{
    if (hand_link_count != count) {
        free(hand_links);
        hand_links = malloc(count * sizeof *hand_links);
        hand_link_count = hand_links != NULL ? count : 0;
    }
    if (index >= hand_link_count) {
        return TL_ERR_MEMORY;
    }
    hand_links[index] = tl_js_offmesh(0);
    return TL_OK;
}

static tl_result append_bytes(const void *bytes, size_t size, void *user)
{
    tl_js_buffer *buffer = user;
    tl_js_buffer_add(buffer, bytes, size);
    return buffer->failed ? TL_ERR_MEMORY : TL_OK;
}

static void add_item(tl_pack_item *items, uint32_t *count, uint32_t type, uint32_t id, const void *blob)
{
    if (blob != NULL) {
        const tl_pack_item item = { type, id, blob, ((const tl_blob *)blob)->size };
        items[(*count)++] = item;
    }
}

typedef struct pack_parts {
    tl_pack_meta *meta;
    tl_pack_frame *frame;
    const void *soup, *hull;
    const tl_js_navmesh *navmesh;
    tl_pack_navmesh *settings;
    tl_pack_offmesh *offmesh;
    tl_pack_areas *areas;
    tl_pack_volumes *volumes;
} pack_parts;

// False: out of memory.
static bool add_tiles(tl_pack_item *items, uint32_t *count, uint32_t type, const tl_navmesh *navmesh)
{
    if (navmesh == NULL) {
        return true;
    }
    uint32_t *order = tl_js_tile_order(navmesh);
    const uint32_t tiles = order != NULL ? tl_navmesh_tile_count(navmesh) : 0;
    for (uint32_t i = 0; i < tiles; i++) {
        add_item(items, count, type, i, tl_navmesh_slot_tile(navmesh, order[i]));
    }
    free(order);
    return order != NULL;
}

static uint32_t count_tiles(const tl_navmesh *navmesh)
{
    return navmesh != NULL ? tl_navmesh_tile_count(navmesh) : 0;
}

static tl_result write_parts(const pack_parts *parts)
{
    static const tl_js_navmesh none;
    const tl_js_navmesh *navmesh = parts->navmesh != NULL ? parts->navmesh : &none;
    enum { OTHER_ITEMS = 9 };
    const uint32_t tiles = count_tiles(navmesh->navmesh) + count_tiles(navmesh->removed);
    tl_pack_item *items = malloc((tiles + OTHER_ITEMS) * sizeof *items);
    tl_result result = TL_ERR_MEMORY;
    uint32_t count = 0;
    if (items != NULL) {
        add_item(items, &count, TL_PACK_META, 0, parts->meta);
        add_item(items, &count, TL_PACK_FRAM, 0, parts->frame);
        add_item(items, &count, TL_PACK_SOUP, 0, parts->soup);
        add_item(items, &count, TL_PACK_HULL, 0, parts->hull);
        add_item(items, &count, TL_PACK_NAVM, 0, parts->settings);
        const bool kept = add_tiles(items, &count, TL_PACK_NAVT, navmesh->navmesh);
        add_item(items, &count, TL_PACK_LINK, 0, navmesh->links);
        add_item(items, &count, TL_PACK_OFFM, 0, parts->offmesh);
        add_item(items, &count, TL_PACK_AREA, 0, parts->areas);
        add_item(items, &count, TL_PACK_MARK, 0, parts->volumes);
        add_item(items, &count, TL_PACK_PRUN, 0, navmesh->pruning);
        if (kept && add_tiles(items, &count, TL_PACK_PRUT, navmesh->removed)) {
            result = TL_OK;
        }
    }
    if (result == TL_OK) {
        tl_js_buffer *buffer = tl_js_buffer_begin();
        result = tl_pack_write(items, count, NULL, append_bytes, buffer, &tl_js_report);
        tl_js_put_pointer(tl_js_put(0, (double)buffer->used), buffer->bytes);
    }
    free(items);
    return result;
}

// Slot: as of js_pack_write.
static tl_result encode_origin(const char *name, pack_parts *parts)
{
    tl_result result = TL_OK;
    if (tl_js_slot[0] != 0.0) {
        const uint32_t up = tl_js_u32(9);
        result = tl_pack_meta_encode(name, (uint64_t)tl_js_slot[1], (uint64_t)tl_js_slot[2], tl_js_aabb(3), NULL,
                                     &parts->meta, &tl_js_report);
        if (result == TL_OK) {
            parts->meta->source_up = up;
        }
    }
    if (result == TL_OK && tl_js_slot[10] != 0.0) {
        result = tl_pack_frame_encode((tl_pack_axes)tl_js_u32(14), &tl_js_slot[11], NULL, &parts->frame, &tl_js_report);
    }
    return result;
}

static tl_result encode_marks(const uint8_t *areas, uint32_t area_count, pack_parts *parts)
{
    tl_result result = TL_OK;
    if (hand_link_count > 0) {
        result = tl_pack_offmesh_encode(hand_links, hand_link_count, NULL, &parts->offmesh, &tl_js_report);
    }
    if (result == TL_OK && area_count > 0) {
        result = tl_pack_areas_encode(areas, area_count, NULL, &parts->areas, &tl_js_report);
    }
    if (result == TL_OK && tl_js_input.volume_count > 0) {
        result =
            tl_pack_volumes_encode(tl_js_input.volumes, tl_js_input.volume_count, NULL, &parts->volumes, &tl_js_report);
    }
    return result;
}

/// Slot: whether there is a meta chunk, its counts, bounds and up axis; whether there is a frame, its origin and axes;
/// how many triangles have areas, and where.
/// `name` is zero-terminated. Volumes are the input's. Pointers may be NULL. Slot afterwards: how many bytes, and
/// where.
tl_result TL_JS_FULL_EXPORT(js_pack_write)(const char *name, const void *soup, const void *hull,
                                           const tl_js_navmesh *navmesh)
{
    pack_parts parts = { NULL, NULL, soup, hull, navmesh, NULL, NULL, NULL, NULL };
    const uint32_t area_count = tl_js_u32(15);
    const uint8_t *areas = (const uint8_t *)(uintptr_t)tl_js_slot[16];
    tl_result result = encode_origin(name, &parts);
    if (result == TL_OK && navmesh != NULL) {
        result = tl_pack_navmesh_encode(&navmesh->def, navmesh->tiles_x, navmesh->tiles_z,
                                        tl_navmesh_tile_count(navmesh->navmesh), NULL, &parts.settings, &tl_js_report);
    }
    if (result == TL_OK) {
        result = encode_marks(areas, area_count, &parts);
    }
    if (result == TL_OK) {
        result = write_parts(&parts);
    }
    tl_blob_free(parts.meta);
    tl_blob_free(parts.frame);
    tl_blob_free(parts.settings);
    tl_blob_free(parts.offmesh);
    tl_blob_free(parts.areas);
    tl_blob_free(parts.volumes);
    free(hand_links);
    hand_links = NULL;
    hand_link_count = 0;
    return result;
}
