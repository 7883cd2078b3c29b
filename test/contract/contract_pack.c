// SPDX-License-Identifier: MIT
//
// pack.h.

#include "contract.h"

#include <stdlib.h>
#include <string.h>

// ---- The container -----------------------------------------------------------------------------------------

typedef struct file_bytes {
    unsigned char *bytes; // 64-byte aligned
    size_t size;
} file_bytes;

static tl_result append(const void *bytes, size_t size, void *user)
{
    file_bytes *file = user;
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
    return TL_OK;
}

enum { MAX_ITEMS = 16 };

static uint32_t level_items(tl_pack_item *items)
{
    const contract_level *level = contract_level_get();
    const tl_pack_item soup = { TL_PACK_SOUP, 0, level->soup, tl_soup_size(level->soup) };
    uint32_t count = 0;
    items[count++] = soup;
    for (uint32_t i = 0; i < level->tiles.tile_count; i++) {
        const tl_nav_tile *tile = level->tiles.tiles[i];
        const tl_pack_item item = { TL_PACK_NAVT, i, tile, tile->blob.size };
        items[count++] = item;
    }
    // As if the first tile had been pruned from elsewhere.
    const tl_pack_item pruned = { TL_PACK_PRUT, 0, level->tiles.tiles[0], level->tiles.tiles[0]->blob.size };
    items[count++] = pruned;
    TEST_CHECK(count <= MAX_ITEMS);
    return count;
}

static file_bytes file_room(void)
{
    tl_pack_item items[MAX_ITEMS];
    const size_t size = (size_t)tl_pack_size(items, level_items(items));
    file_bytes file = { test_blob_alloc(size), 0 };
    TEST_CHECK(file.bytes != NULL);
    return file;
}

static file_bytes make_file(void)
{
    tl_pack_item items[MAX_ITEMS];
    file_bytes file = file_room();
    TEST_RESULT(tl_pack_write(items, level_items(items), NULL, append, &file, NULL), TL_OK);
    return file;
}

static tl_result pack_write(contract_run *run)
{
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    tl_pack_item items[MAX_ITEMS];
    file_bytes file = file_room();
    const uint32_t count = level_items(items);
    const tl_result result = tl_pack_write(null_input && run->variant == 0 ? NULL : items, count, run->host->allocator,
                                           null_input && run->variant == 1 ? NULL : append, &file, run->report);
    run->is_clear = file.size == 0;
    run->answer = contract_hash(file.bytes, file.size, 0);
    test_blob_free(file.bytes);
    return result;
}

// Hands out the items that level_items makes, as entries say.
static tl_result fetch_item(uint32_t index, const void **bytes_out, void *user)
{
    tl_pack_item items[MAX_ITEMS];
    (void)user;
    TEST_CHECK(index < level_items(items));
    *bytes_out = items[index].bytes;
    return TL_OK;
}

static tl_result pack_write_fetched(contract_run *run)
{
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    tl_pack_item items[MAX_ITEMS];
    tl_pack_entry entries[MAX_ITEMS];
    file_bytes file = file_room();
    const uint32_t count = level_items(items);
    for (uint32_t i = 0; i < count; i++) {
        TEST_RESULT(tl_pack_entry_make(items[i].type, items[i].id, items[i].bytes, items[i].size, &entries[i]), TL_OK);
    }
    const tl_result result =
        tl_pack_write_fetched(null_input && run->variant == 0 ? NULL : entries, count, run->host->allocator,
                              null_input && run->variant == 1 ? NULL : fetch_item,
                              null_input && run->variant == 2 ? NULL : append, &file, run->report);
    run->is_clear = file.size == 0;
    run->answer = contract_hash(file.bytes, file.size, 0);
    test_blob_free(file.bytes);
    return result;
}

static tl_result pack_entry_make(contract_run *run)
{
    tl_pack_entry entry;
    memset(&entry, 0x5a, sizeof entry);
    const tl_result result = tl_pack_entry_make(TL_PACK_NAVT, 3, run->what == CONTRACT_NULL_INPUT ? NULL : "talus", 5,
                                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &entry);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&entry, sizeof entry);
    run->answer = entry.hash;
    return result;
}

static tl_result pack_open(contract_run *run)
{
    file_bytes file = make_file();
    tl_pack pack;
    memset(&pack, 0, sizeof pack);
    file.bytes[100] ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    const tl_result result = tl_pack_open(run->what == CONTRACT_NULL_INPUT ? NULL : file.bytes, file.size,
                                          run->what == CONTRACT_NULL_OUTPUT ? NULL : &pack, run->report);
    run->is_clear = contract_is_zero(&pack, sizeof pack);
    run->answer = pack.chunk_count;
    test_blob_free(file.bytes);
    return result;
}

static tl_result pack_index_size(contract_run *run)
{
    file_bytes file = make_file();
    uint64_t size = 0;
    file.bytes[10] ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    const tl_result result = tl_pack_index_size(run->what == CONTRACT_NULL_INPUT ? NULL : file.bytes,
                                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &size, run->report);
    run->is_clear = size == 0;
    run->answer = size;
    test_blob_free(file.bytes);
    return result;
}

static tl_result pack_index_open(contract_run *run)
{
    file_bytes file = make_file();
    uint64_t size = 0;
    tl_pack_index index;
    memset(&index, 0, sizeof index);
    TEST_RESULT(tl_pack_index_size(file.bytes, &size, NULL), TL_OK);
    file.bytes[100] ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    const tl_result result = tl_pack_index_open(run->what == CONTRACT_NULL_INPUT ? NULL : file.bytes, size,
                                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &index, run->report);
    run->is_clear = contract_is_zero(&index, sizeof index);
    run->answer = index.count;
    test_blob_free(file.bytes);
    return result;
}

static tl_result pack_entry_open(contract_run *run)
{
    file_bytes file = make_file();
    uint64_t size = 0;
    tl_pack_index index;
    TEST_RESULT(tl_pack_index_size(file.bytes, &size, NULL), TL_OK);
    TEST_RESULT(tl_pack_index_open(file.bytes, size, &index, NULL), TL_OK);
    const tl_pack_entry *entry = &index.entries[0];
    file.bytes[entry->offset + 70] ^= run->what == CONTRACT_BAD_BYTES ? 1 : 0;
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    const tl_result result =
        tl_pack_entry_open(null_input && run->variant == 0 ? NULL : entry,
                           null_input && run->variant == 1 ? NULL : file.bytes + entry->offset, run->report);
    run->is_clear = true;
    test_blob_free(file.bytes);
    return result;
}

static tl_result pack_find(contract_run *run)
{
    file_bytes file = make_file();
    tl_pack pack;
    tl_pack_chunk chunk;
    memset(&chunk, 0, sizeof chunk);
    TEST_RESULT(tl_pack_open(file.bytes, file.size, &pack, NULL), TL_OK);
    const tl_result result =
        tl_pack_find(run->what == CONTRACT_NULL_INPUT ? NULL : &pack, TL_PACK_SOUP,
                     run->what == CONTRACT_NOT_FOUND ? 7 : 0, run->what == CONTRACT_NULL_OUTPUT ? NULL : &chunk);
    run->is_clear = contract_is_zero(&chunk, sizeof chunk);
    TEST_CHECK(result == TL_OK || run->is_clear);
    test_blob_free(file.bytes);
    return result;
}

static tl_result pack_load_navmesh(contract_run *run)
{
    file_bytes file = make_file();
    tl_pack pack;
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_pack_open(file.bytes, file.size, &pack, NULL), TL_OK);
    pack.chunk_count = run->what == CONTRACT_NOT_FOUND ? 1 : pack.chunk_count; // the soup alone
    if (run->what == CONTRACT_BAD_BYTES) {
        file.bytes[(const unsigned char *)tl_pack_chunk_at(&pack, 1).bytes - file.bytes] ^= 1;
    }
    const tl_result result = tl_pack_load_navmesh(run->what == CONTRACT_NULL_INPUT ? NULL : &pack, run->host->allocator,
                                                  run->what == CONTRACT_NULL_OUTPUT ? NULL : &navmesh, run->report);
    run->is_clear = navmesh == NULL;
    run->answer = navmesh != NULL ? tl_navmesh_link_count(navmesh) : 0;
    TEST_CHECK(result == TL_OK || run->is_clear);
    tl_navmesh_destroy(navmesh);
    test_blob_free(file.bytes);
    return result;
}

// ---- Byte order --------------------------------------------------------------------------------------------

static tl_result pack_to_host_order(contract_run *run)
{
    file_bytes file = make_file();
    const tl_result result =
        tl_pack_to_host_order(run->what == CONTRACT_NULL_INPUT ? NULL : file.bytes, file.size, run->report);
    run->answer = contract_hash(file.bytes, file.size, 0);
    run->is_clear = true;
    test_blob_free(file.bytes);
    return result;
}

typedef tl_result order_fn(void *bytes, uint64_t size, tl_report *report);

static tl_result order_hull(contract_run *run, order_fn *order, order_fn *before)
{
    const tl_hull *hull = contract_level_get()->hull;
    uint8_t *copy = malloc((size_t)hull->blob.size);
    memcpy(copy, hull, (size_t)hull->blob.size);
    if (before != NULL) {
        TEST_RESULT(before(copy, hull->blob.size, NULL), TL_OK);
    }
    copy[0] ^= run->what == CONTRACT_BAD_BYTES ? 0x80 : 0;
    const tl_result result = order(run->what == CONTRACT_NULL_INPUT ? NULL : copy, hull->blob.size, run->report);
    run->answer = contract_hash(copy, (size_t)hull->blob.size, 0);
    run->is_clear = true;
    free(copy);
    return result;
}

static tl_result blob_to_file_order(contract_run *run)
{
    return order_hull(run, tl_blob_to_file_order, NULL);
}

static tl_result blob_to_host_order(contract_run *run)
{
    return order_hull(run, tl_blob_to_host_order, tl_blob_to_file_order);
}

// ---- Chunks of the file itself -----------------------------------------------------------------------------

static tl_result blob_answer(contract_run *run, tl_result result, void *blob)
{
    run->is_clear = blob == NULL;
    run->answer = blob != NULL ? contract_hash(blob, (size_t)((const tl_blob *)blob)->size, 0) : 0;
    tl_blob_free(blob);
    return result;
}

static tl_result meta_encode(contract_run *run)
{
    tl_pack_meta *meta = NULL;
    const tl_result result =
        tl_pack_meta_encode("level.obj", 12, 14, contract_level_get()->mesh.bounds, run->host->allocator,
                            run->what == CONTRACT_NULL_OUTPUT ? NULL : &meta, run->report);
    return blob_answer(run, result, meta);
}

static tl_result meta_check(contract_run *run)
{
    tl_pack_meta *meta;
    TEST_RESULT(tl_pack_meta_encode("level.obj", 1, 1, tl_aabb_empty(), NULL, &meta, NULL), TL_OK);
    meta->source_up = run->what == CONTRACT_BAD_BYTES ? 2 : TL_PACK_UP_Z;
    run->is_clear = true;
    const tl_result result =
        tl_pack_meta_check(run->what == CONTRACT_NULL_INPUT ? NULL : meta, meta->blob.size, run->report);
    tl_blob_free(meta);
    return result;
}

static tl_result navmesh_encode(contract_run *run)
{
    tl_nav_def def = tl_default_nav_def();
    tl_pack_navmesh *navmesh = NULL;
    def.cookie = run->what == CONTRACT_ZEROED_DEF ? 0 : def.cookie;
    const tl_result result =
        tl_pack_navmesh_encode(run->what == CONTRACT_NULL_DEF ? NULL : &def, 2, 2, 4, run->host->allocator,
                               run->what == CONTRACT_NULL_OUTPUT ? NULL : &navmesh, run->report);
    return blob_answer(run, result, navmesh);
}

static tl_result navmesh_check(contract_run *run)
{
    tl_pack_navmesh *navmesh;
    TEST_RESULT(tl_pack_navmesh_encode(NULL, 2, 2, 4, NULL, &navmesh, NULL), TL_OK);
    navmesh->filters = run->what == CONTRACT_BAD_BYTES ? 8 : 7;
    run->is_clear = true;
    const tl_result result =
        tl_pack_navmesh_check(run->what == CONTRACT_NULL_INPUT ? NULL : navmesh, navmesh->blob.size, run->report);
    tl_blob_free(navmesh);
    return result;
}

static const tl_vec3 CORNERS[] = { { 1, 0, 1 }, { 2, 0, 1 }, { 1, 0, 2 } };
static const tl_nav_volume VOLUMES[] = {
    { .kind = TL_NAV_VOLUME_POLYGON, .area = 3, .points = CORNERS, .point_count = 3, .box = { { 0 }, { 0, 2, 0 } } },
};

static tl_result volumes_encode(contract_run *run)
{
    tl_pack_volumes *volumes = NULL;
    const tl_result result =
        tl_pack_volumes_encode(run->what == CONTRACT_NULL_INPUT ? NULL : VOLUMES, 1, run->host->allocator,
                               run->what == CONTRACT_NULL_OUTPUT ? NULL : &volumes, run->report);
    return blob_answer(run, result, volumes);
}

static const char *const FRAME_FIELDS[] = { "axes", "origin", NULL };

static tl_result frame_encode(contract_run *run)
{
    const double origin[3] = { 448262.0, run->what == CONTRACT_BAD_FIELD && run->variant == 1 ? (double)NAN : 0.0,
                               5e6 };
    const bool no_axes = run->what == CONTRACT_BAD_FIELD && run->variant == 0;
    tl_pack_frame *frame = NULL;
    const tl_result result = tl_pack_frame_encode(
        no_axes ? (tl_pack_axes)4 : TL_PACK_AXES_Z_UP, run->what == CONTRACT_NULL_INPUT ? NULL : origin,
        run->host->allocator, run->what == CONTRACT_NULL_OUTPUT ? NULL : &frame, run->report);
    return blob_answer(run, result, frame);
}

static tl_result frame_check(contract_run *run)
{
    const double origin[3] = { 0.0, 0.0, 1.0 };
    tl_pack_frame *frame;
    TEST_RESULT(tl_pack_frame_encode(TL_PACK_AXES_Y_UP_LEFT, origin, NULL, &frame, NULL), TL_OK);
    frame->axes = run->what == CONTRACT_BAD_BYTES ? 4 : 1;
    run->is_clear = true;
    const tl_result result =
        tl_pack_frame_check(run->what == CONTRACT_NULL_INPUT ? NULL : frame, frame->blob.size, run->report);
    tl_blob_free(frame);
    return result;
}

static tl_result volumes_check(contract_run *run)
{
    tl_pack_volumes *volumes;
    TEST_RESULT(tl_pack_volumes_encode(VOLUMES, 1, NULL, &volumes, NULL), TL_OK);
    ((tl_pack_volume *)(volumes + 1))->area = run->what == CONTRACT_BAD_BYTES ? 1000 : 3;
    run->is_clear = true;
    const tl_result result =
        tl_pack_volumes_check(run->what == CONTRACT_NULL_INPUT ? NULL : volumes, volumes->blob.size, run->report);
    tl_blob_free(volumes);
    return result;
}

static tl_result offmesh_encode(contract_run *run)
{
    tl_nav_offmesh link = tl_default_nav_offmesh();
    if (run->what == CONTRACT_ZEROED_DEF) {
        link.cookie = 0;
    }
    tl_pack_offmesh *offmesh = NULL;
    const tl_result result =
        tl_pack_offmesh_encode(run->what == CONTRACT_NULL_INPUT ? NULL : &link, 1, run->host->allocator,
                               run->what == CONTRACT_NULL_OUTPUT ? NULL : &offmesh, run->report);
    return blob_answer(run, result, offmesh);
}

static tl_result offmesh_check(contract_run *run)
{
    const tl_nav_offmesh link = tl_default_nav_offmesh();
    tl_pack_offmesh *offmesh;
    TEST_RESULT(tl_pack_offmesh_encode(&link, 1, NULL, &offmesh, NULL), TL_OK);
    ((tl_pack_offmesh_link *)(offmesh + 1))->both_ways = run->what == CONTRACT_BAD_BYTES ? 2 : 1;
    run->is_clear = true;
    const tl_result result =
        tl_pack_offmesh_check(run->what == CONTRACT_NULL_INPUT ? NULL : offmesh, offmesh->blob.size, run->report);
    tl_blob_free(offmesh);
    return result;
}

static tl_result areas_encode(contract_run *run)
{
    static const uint8_t given[3] = { 1, 2, 3 };
    tl_pack_areas *areas = NULL;
    const tl_result result =
        tl_pack_areas_encode(run->what == CONTRACT_NULL_INPUT ? NULL : given, 3, run->host->allocator,
                             run->what == CONTRACT_NULL_OUTPUT ? NULL : &areas, run->report);
    return blob_answer(run, result, areas);
}

static tl_result areas_check(contract_run *run)
{
    tl_pack_areas *areas;
    TEST_RESULT(tl_pack_areas_encode((const uint8_t[]){ 1 }, 1, NULL, &areas, NULL), TL_OK);
    areas->count = run->what == CONTRACT_BAD_BYTES ? 1000 : 1;
    run->is_clear = true;
    const tl_result result =
        tl_pack_areas_check(run->what == CONTRACT_NULL_INPUT ? NULL : areas, areas->blob.size, run->report);
    tl_blob_free(areas);
    return result;
}

static const char *const PRUNING_FIELDS[] = { "seeds", "min_area", NULL };

static tl_result pruning_encode(contract_run *run)
{
    tl_nav_prune_def def = tl_default_nav_prune_def();
    tl_pack_pruning *pruning = NULL;
    if (run->what == CONTRACT_NO_MEMORY) {
        def.seeds = CORNERS;
        def.seed_count = 3;
    }
    if (run->what == CONTRACT_BAD_FIELD) {
        def.seed_count = run->variant == 0 ? 1 : 0;
        def.min_area = run->variant == 1 ? -1.0 : 0.0;
    }
    def.cookie = run->what == CONTRACT_ZEROED_DEF ? 0 : def.cookie;
    const tl_result result = tl_pack_pruning_encode(run->what == CONTRACT_NULL_DEF ? NULL : &def, run->host->allocator,
                                                    run->what == CONTRACT_NULL_OUTPUT ? NULL : &pruning, run->report);
    return blob_answer(run, result, pruning);
}

static tl_result pruning_check(contract_run *run)
{
    tl_pack_pruning *pruning;
    TEST_RESULT(tl_pack_pruning_encode(NULL, NULL, &pruning, NULL), TL_OK);
    pruning->drop_inside_solids = run->what == CONTRACT_BAD_BYTES ? 2 : 1;
    run->is_clear = true;
    const tl_result result =
        tl_pack_pruning_check(run->what == CONTRACT_NULL_INPUT ? NULL : pruning, pruning->blob.size, run->report);
    tl_blob_free(pruning);
    return result;
}

static tl_result pack_load_pruned(contract_run *run)
{
    file_bytes file = make_file();
    tl_pack pack;
    tl_navmesh *pruned = NULL;
    TEST_RESULT(tl_pack_open(file.bytes, file.size, &pack, NULL), TL_OK);
    pack.chunk_count = run->what == CONTRACT_NOT_FOUND ? 1 : pack.chunk_count; // the soup alone
    if (run->what == CONTRACT_BAD_BYTES) {
        file.bytes[(const unsigned char *)tl_pack_chunk_at(&pack, pack.chunk_count - 1).bytes - file.bytes] ^= 1;
    }
    const tl_result result = tl_pack_load_pruned(run->what == CONTRACT_NULL_INPUT ? NULL : &pack, run->host->allocator,
                                                 run->what == CONTRACT_NULL_OUTPUT ? NULL : &pruned, run->report);
    run->is_clear = pruned == NULL;
    run->answer = pruned != NULL ? tl_navmesh_tile_count(pruned) : 0;
    TEST_CHECK(result == TL_OK || run->is_clear);
    tl_navmesh_destroy(pruned);
    test_blob_free(file.bytes);
    return result;
}

enum {
    ENCODE = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY),
    CHECK = CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_BYTES)
};

const contract_entry CONTRACT_TABLE_pack[] = {
    { "tl_pack_write",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_MEMORY), 2, 0, NULL,
      pack_write, NULL },
    { "tl_pack_write_fetched",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NO_MEMORY), 3, 0, NULL,
      pack_write_fetched, NULL },
    { "tl_pack_entry_make", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT), 1, 1, NULL,
      pack_entry_make, NULL },
    { "tl_pack_size", 0, 0, 0, NULL, NULL, "a sum: test_pack.c" },
    { "tl_pack_open", CHECK | CONTRACT_BIT(NULL_OUTPUT), 1, 1, NULL, pack_open, NULL },
    { "tl_pack_index_size", CHECK | CONTRACT_BIT(NULL_OUTPUT), 1, 1, NULL, pack_index_size, NULL },
    { "tl_pack_index_open", CHECK | CONTRACT_BIT(NULL_OUTPUT), 1, 1, NULL, pack_index_open, NULL },
    { "tl_pack_entry_open", CHECK, 2, 0, NULL, pack_entry_open, NULL },
    { "tl_pack_to_host_order", CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT), 1, 0, NULL,
      pack_to_host_order, NULL },
    { "tl_blob_to_file_order", CHECK, 1, 0, NULL, blob_to_file_order, NULL },
    { "tl_blob_to_host_order", CHECK, 1, 0, NULL, blob_to_host_order, NULL },
    { "tl_pack_chunk_at", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_pack_find",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NOT_FOUND), 1, 1, NULL,
      pack_find, NULL },
    { "tl_pack_count", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_pack_meta_encode", ENCODE, 0, 1, NULL, meta_encode, NULL },
    { "tl_pack_meta_check", CHECK, 1, 0, NULL, meta_check, NULL },
    { "tl_pack_meta_name", 0, 0, 0, NULL, NULL, "returns a place in the blob" },
    { "tl_pack_navmesh_encode", ENCODE | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF), 0, 1, NULL, navmesh_encode,
      NULL },
    { "tl_pack_navmesh_check", CHECK, 1, 0, NULL, navmesh_check, NULL },
    { "tl_pack_navmesh_def", 0, 0, 0, NULL, NULL, "copies a checked blob's fields" },
    { "tl_pack_frame_encode", ENCODE | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_FIELD), 1, 1, FRAME_FIELDS,
      frame_encode, NULL },
    { "tl_pack_frame_check", CHECK, 1, 0, NULL, frame_check, NULL },
    { "tl_pack_place_in", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_pack_place_out", 0, 0, 0, NULL, NULL, "fills a value; what it is given is the caller's duty" },
    { "tl_pack_turn_in", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_pack_turn_out", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_pack_volumes_encode", ENCODE | CONTRACT_BIT(NULL_INPUT), 1, 1, NULL, volumes_encode, NULL },
    { "tl_pack_volumes_check", CHECK, 1, 0, NULL, volumes_check, NULL },
    { "tl_pack_volumes_at", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_pack_load_navmesh", CHECK | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(NO_MEMORY), 1,
      1, NULL, pack_load_navmesh, NULL },
    { "tl_pack_load_pruned", CHECK | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NOT_FOUND) | CONTRACT_BIT(NO_MEMORY), 1,
      1, NULL, pack_load_pruned, NULL },
    { "tl_pack_offmesh_encode", ENCODE | CONTRACT_BIT(NULL_INPUT), 1, 1, NULL, offmesh_encode, NULL },
    { "tl_pack_offmesh_check", CHECK, 1, 0, NULL, offmesh_check, NULL },
    { "tl_pack_offmesh_at", 0, 0, 0, NULL, NULL, "returns a value; what it is given is the caller's duty" },
    { "tl_pack_areas_encode", ENCODE | CONTRACT_BIT(NULL_INPUT), 1, 1, NULL, areas_encode, NULL },
    { "tl_pack_areas_check", CHECK, 1, 0, NULL, areas_check, NULL },
    { "tl_pack_areas_array", 0, 0, 0, NULL, NULL, "returns a place in the blob" },
    { "tl_pack_pruning_encode", ENCODE | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD), 0,
      1, PRUNING_FIELDS, pruning_encode, NULL },
    { "tl_pack_pruning_check", CHECK, 1, 0, NULL, pruning_check, NULL },
    { "tl_pack_pruning_seeds", 0, 0, 0, NULL, NULL, "returns a place in the blob" },
    { 0 },
};
