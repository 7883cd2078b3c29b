// SPDX-License-Identifier: MIT
//
// The container: written and read back, every prefix and every altered byte refused by name.

#include "nav_fixture.h"

#include <math.h>
#include <talus/pack.h>

typedef struct memory_sink {
    uint8_t *bytes;
    size_t size;
    size_t capacity;
    size_t fail_after; // 0: never
} memory_sink;

static tl_result sink_write(const void *bytes, size_t size, void *user)
{
    memory_sink *sink = user;
    if (sink->fail_after != 0 && sink->size + size > sink->fail_after) {
        return TL_ERR_IO;
    }
    assert_true(sink->size + size <= sink->capacity);
    memcpy(sink->bytes + sink->size, bytes, size);
    sink->size += size;
    return TL_OK;
}

static memory_sink sink_make(size_t capacity)
{
    memory_sink sink = { test_blob_alloc(capacity), 0, capacity, 0 };
    return sink;
}

static memory_sink write_items(const tl_pack_item *items, uint32_t count)
{
    memory_sink sink = sink_make((size_t)tl_pack_size(items, count));
    TEST_RESULT(tl_pack_write(items, count, NULL, sink_write, &sink, NULL), TL_OK);
    TEST_CHECK(sink.size == tl_pack_size(items, count));
    return sink;
}

static const char WORDS[] = "loose rock at the foot of a cliff, and the bone that you walk on, and some more words";

static memory_sink write_small(void)
{
    const tl_pack_item items[] = { { TL_PACK_SOUP, 0, WORDS, 70 },
                                   { TL_PACK_HULL, 0, WORDS, 0 },
                                   { TL_PACK_HULL, 1, WORDS, 64 },
                                   { TL_PACK_NAVT, 7, WORDS, 1 } };
    return write_items(items, 4);
}

static void test_round_trip(void **state)
{
    (void)state;
    memory_sink sink = write_small();
    tl_pack pack;
    tl_pack_chunk chunk;
    TEST_RESULT(tl_pack_open(sink.bytes, sink.size, &pack, NULL), TL_OK);
    TEST_CHECK(pack.chunk_count == 4 && tl_pack_count(&pack, TL_PACK_HULL) == 2);
    TEST_RESULT(tl_pack_find(&pack, TL_PACK_SOUP, 0, &chunk), TL_OK);
    TEST_CHECK(chunk.size == 70 && memcmp(chunk.bytes, WORDS, 70) == 0 && (uintptr_t)chunk.bytes % 64 == 0);
    TEST_RESULT(tl_pack_find(&pack, TL_PACK_HULL, 0, &chunk), TL_OK);
    TEST_CHECK(chunk.size == 0);
    TEST_RESULT(tl_pack_find(&pack, TL_PACK_NAVT, 7, &chunk), TL_OK);
    TEST_CHECK(chunk.size == 1 && ((const char *)chunk.bytes)[0] == 'l');
    TEST_RESULT(tl_pack_find(&pack, TL_PACK_NAVT, 0, &chunk), TL_NOT_FOUND);
    TEST_CHECK(tl_pack_chunk_at(&pack, 2).id == 1);
    test_blob_free(sink.bytes);
}

// The same file from chunks that are fetched one at a time into one place.
typedef struct fetched_words {
    memory_sink sink;
    const tl_pack_item *items;
    char room[128];
    uint32_t next;
    uint32_t alter, fail; // chunks that are handed out otherwise than announced, or not at all; UINT32_MAX: none
} fetched_words;

static tl_result fetch_words(uint32_t index, const void **bytes_out, void *user)
{
    fetched_words *words = user;
    TEST_CHECK(index == words->next++);
    memset(words->room, 0x5a, sizeof words->room);
    memcpy(words->room, words->items[index].bytes, (size_t)words->items[index].size);
    words->room[0] = (char)(words->room[0] ^ (index == words->alter));
    *bytes_out = words->room;
    return index == words->fail ? TL_ERR_IO : TL_OK;
}

static tl_result write_words(const void *bytes, size_t size, void *user)
{
    return sink_write(bytes, size, &((fetched_words *)user)->sink);
}

static void test_fetched(void **state)
{
    (void)state;
    const tl_pack_item items[] = { { TL_PACK_TYPE('W', 'O', 'R', 'D'), 0, WORDS, 70 },
                                   { TL_PACK_TYPE('W', 'O', 'R', 'D'), 2, WORDS, 0 },
                                   { TL_PACK_TYPE('W', 'O', 'R', 'D'), 1, WORDS, 64 },
                                   { TL_PACK_TYPE('L', 'A', 'S', 'T'), 7, WORDS + 5, 1 } };
    tl_pack_entry entries[4];
    memory_sink whole = write_items(items, 4);
    for (uint32_t i = 0; i < 4; i++) {
        TEST_RESULT(tl_pack_entry_make(items[i].type, items[i].id, items[i].bytes, items[i].size, &entries[i]), TL_OK);
        TEST_CHECK(entries[i].offset == 0 && entries[i].size == items[i].size);
    }
    fetched_words words = { sink_make(whole.size), items, { 0 }, 0, UINT32_MAX, UINT32_MAX };
    TEST_RESULT(tl_pack_write_fetched(entries, 4, NULL, fetch_words, write_words, &words, NULL), TL_OK);
    TEST_CHECK(words.next == 4 && words.sink.size == whole.size);
    TEST_CHECK(memcmp(words.sink.bytes, whole.bytes, whole.size) == 0);
    for (uint32_t i = 0; i < 4; i++) {
        tl_report report;
        words.next = 0;
        words.sink.size = 0;
        words.alter = i;
        const tl_result expected = items[i].size > 0 ? TL_ERR_HASH : TL_OK; // of nothing nothing is altered
        TEST_RESULT(tl_pack_write_fetched(entries, 4, NULL, fetch_words, write_words, &words, &report), expected);
        TEST_CHECK(expected == TL_OK || (strcmp(report.element, "chunk") == 0 && report.element_index == i));
        words.alter = UINT32_MAX;
        words.fail = i;
        words.next = 0;
        words.sink.size = 0;
        TEST_RESULT(tl_pack_write_fetched(entries, 4, NULL, fetch_words, write_words, &words, NULL), TL_ERR_IO);
        TEST_CHECK(words.next == i + 1);
        words.fail = UINT32_MAX;
    }
    tl_report report;
    entries[3] = entries[0];
    TEST_RESULT(tl_pack_write_fetched(entries, 4, NULL, fetch_words, write_words, &words, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.element, "chunk") == 0);
    test_blob_free(words.sink.bytes);
    test_blob_free(whole.bytes);
}

// The layout is a promise to other programs: some of its bytes, and its hash.
static void test_layout(void **state)
{
    (void)state;
    memory_sink sink = write_small();
    static const uint8_t head[24] = { 'T', 'A', 'L', 'U', 'S', '\r', '\n', 0xb5, 1, 0, 0, 0, 4, 0, 0, 0, 0xc0, 1 };
    TEST_CHECK(sink.size == 448 && memcmp(sink.bytes, head, sizeof head) == 0);
    static const uint8_t entry[24] = { 'S', 'O', 'U', 'P', 0, 0, 0, 0, 192, 0, 0, 0, 0, 0, 0, 0, 70 };
    TEST_CHECK(memcmp(sink.bytes + 64, entry, sizeof entry) == 0);
    TEST_CHECK(memcmp(sink.bytes + 192, WORDS, 70) == 0);
    test_blob_free(sink.bytes);
}

static void test_empty(void **state)
{
    (void)state;
    memory_sink sink = write_items(NULL, 0);
    tl_pack pack;
    TEST_CHECK(sink.size == 64);
    TEST_RESULT(tl_pack_open(sink.bytes, sink.size, &pack, NULL), TL_OK);
    TEST_CHECK(pack.chunk_count == 0);
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_pack_load_navmesh(&pack, NULL, &navmesh, NULL), TL_NOT_FOUND);
    test_blob_free(sink.bytes);
}

static void test_prefixes(void **state)
{
    (void)state;
    memory_sink sink = write_small();
    for (size_t size = 0; size < sink.size; size++) {
        // No larger than alignment demands, and filled up with what no file has.
        size_t room = size > 0 ? (size + 63) / 64 * 64 : 64;
        uint8_t *block = test_blob_alloc(room);
        memset(block, 0xa5, room);
        memcpy(block, sink.bytes, size);
        tl_pack pack;
        tl_report report;
        TEST_RESULT(tl_pack_open(block, size, &pack, &report), TL_ERR_TRUNCATED);
        TEST_CHECK(pack.bytes == NULL && report.element != NULL);
        test_blob_free(block);
    }
    tl_pack pack;
    uint8_t *longer = test_blob_alloc(sink.size + 64);
    memset(longer, 0, sink.size + 64);
    memcpy(longer, sink.bytes, sink.size);
    TEST_RESULT(tl_pack_open(longer, sink.size + 64, &pack, NULL), TL_ERR_CORRUPT);
    test_blob_free(longer);
    test_blob_free(sink.bytes);
}

static tl_result expected_for(size_t at)
{
    if (at < 8) {
        return TL_ERR_MAGIC;
    }
    if (at < 12) {
        return TL_ERR_VERSION;
    }
    if (at < 192) {
        return TL_ERR_HASH; // header, table
    }
    bool chunk = at < 192 + 70 || (at >= 320 && at < 384) || at == 384;
    return chunk ? TL_ERR_HASH : TL_ERR_CORRUPT; // else padding
}

static void test_altered(void **state)
{
    (void)state;
    const tl_pack_item items[] = { { TL_PACK_SOUP, 0, WORDS, 70 },
                                   { TL_PACK_HULL, 0, WORDS, 0 },
                                   { TL_PACK_HULL, 1, WORDS, 64 },
                                   { TL_PACK_NAVT, 7, WORDS, 1 } };
    memory_sink sink = write_items(items, 4);
    uint32_t hash = 0, corrupt = 0;
    for (size_t at = 0; at < sink.size; at++) {
        for (uint32_t change = 1; change < 256; change++) {
            sink.bytes[at] ^= (uint8_t)change;
            tl_pack pack;
            tl_result result = tl_pack_open(sink.bytes, sink.size, &pack, NULL);
            TEST_RESULT(result, expected_for(at));
            hash += result == TL_ERR_HASH;
            corrupt += result == TL_ERR_CORRUPT;
            sink.bytes[at] ^= (uint8_t)change;
        }
    }
    TEST_CHECK(hash > 10000 && corrupt > 10000);
    tl_pack pack;
    TEST_RESULT(tl_pack_open(sink.bytes, sink.size, &pack, NULL), TL_OK);
    TEST_RESULT(tl_pack_open(sink.bytes + 1, sink.size - 1, &pack, NULL), TL_ERR_ARGUMENT);
    test_blob_free(sink.bytes);
}

static void test_bad_items(void **state)
{
    (void)state;
    tl_pack_item items[] = { { TL_PACK_SOUP, 0, WORDS, 8 },
                             { TL_PACK_HULL, 3, WORDS, 8 },
                             { TL_PACK_HULL, 3, WORDS, 9 } };
    memory_sink sink = sink_make(4096);
    tl_report report;
    TEST_RESULT(tl_pack_write(items, 3, NULL, sink_write, &sink, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(report.element_index == 2 && sink.size == 0);
    items[2].type = 0;
    TEST_RESULT(tl_pack_write(items, 3, NULL, sink_write, &sink, &report), TL_ERR_ARGUMENT);
    items[2].type = TL_PACK_META;
    for (uint64_t k = 1;; k++) {
        test_allocator failing;
        test_allocator_init(&failing, k);
        sink.size = 0;
        tl_result result = tl_pack_write(items, 3, &failing.allocator, sink_write, &sink, &report);
        TEST_CHECK(failing.live_blocks == 0);
        if (result == TL_OK) {
            TEST_CHECK(k > 1);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
    size_t whole = sink.size;
    for (size_t limit = 1; limit < whole; limit += 17) {
        sink.size = 0;
        sink.fail_after = limit;
        TEST_RESULT(tl_pack_write(items, 3, NULL, sink_write, &sink, &report), TL_ERR_IO);
    }
    test_blob_free(sink.bytes);
}

static void test_meta(void **state)
{
    (void)state;
    tl_aabb bounds = { { -1, -2, -3 }, { 4, 5, 6 } };
    tl_pack_meta *meta = NULL;
    TEST_RESULT(tl_pack_meta_encode("level.obj", 123, 456, bounds, NULL, &meta, NULL), TL_OK);
    TEST_RESULT(tl_pack_meta_check(meta, meta->blob.size, NULL), TL_OK);
    TEST_CHECK(strcmp(tl_pack_meta_name(meta), "level.obj") == 0 && meta->source_triangles == 456);
    TEST_RESULT(tl_pack_meta_check(meta, meta->blob.size - 64, NULL), TL_ERR_TRUNCATED);
    meta->name_size = 200;
    TEST_RESULT(tl_pack_meta_check(meta, meta->blob.size, NULL), TL_ERR_CORRUPT);
    meta->name_size = 8;
    TEST_RESULT(tl_pack_meta_check(meta, meta->blob.size, NULL), TL_ERR_CORRUPT);
    tl_blob_free(meta);
    TEST_RESULT(tl_pack_meta_encode(NULL, 0, 0, bounds, NULL, &meta, NULL), TL_OK);
    TEST_CHECK(tl_pack_meta_name(meta)[0] == 0);
    TEST_RESULT(tl_pack_meta_check(meta, meta->blob.size, NULL), TL_OK);
    tl_blob_free(meta);
    char *long_name = malloc(70000);
    memset(long_name, 'a', 69999);
    long_name[69999] = 0;
    TEST_RESULT(tl_pack_meta_encode(long_name, 0, 0, bounds, NULL, &meta, NULL), TL_ERR_LIMIT);
    free(long_name);
}

static void test_navmesh_settings(void **state)
{
    (void)state;
    tl_nav_def def = tl_default_nav_def();
    def.filter_low_hanging_obstacles = false;
    def.filter_walkable_low_height_spans = false;
    def.partition = TL_NAV_MONOTONE;
    def.polygon_method = TL_PARTITION_OPTIMAL;
    def.tile_size = 48;
    def.bounds.min = tl_vec3_make(-1, -2, -3);
    def.bounds.max = tl_vec3_make(4, 5, 6);
    tl_pack_navmesh *settings = NULL;
    TEST_RESULT(tl_pack_navmesh_encode(&def, 4, 3, 11, NULL, &settings, NULL), TL_OK);
    TEST_RESULT(tl_pack_navmesh_check(settings, settings->blob.size, NULL), TL_OK);
    TEST_CHECK(settings->filters == 2 && settings->partition == TL_NAV_MONOTONE && settings->tile_size == 48);
    TEST_CHECK(tl_pack_navmesh_def(settings).polygon_method == TL_PARTITION_OPTIMAL);
    settings->polygon_method = 3;
    TEST_RESULT(tl_pack_navmesh_check(settings, settings->blob.size, NULL), TL_ERR_CORRUPT);
    settings->polygon_method = 0;
    settings->tile_count = 13;
    TEST_RESULT(tl_pack_navmesh_check(settings, settings->blob.size, NULL), TL_ERR_CORRUPT);
    settings->tile_count = 12;
    settings->cell_size = NAN;
    TEST_RESULT(tl_pack_navmesh_check(settings, settings->blob.size, NULL), TL_ERR_CORRUPT);
    tl_blob_free(settings);
}

static void test_marks(void **state)
{
    (void)state;
    const tl_vec3 outline[] = { { 0, 9, 0 }, { 0, 8, 4 }, { 4, 7, 4 } };
    tl_nav_volume volumes[3];
    memset(volumes, 0, sizeof volumes);
    volumes[0].kind = TL_NAV_VOLUME_BOX;
    volumes[0].box.max = tl_vec3_make(1, 2, 3);
    volumes[1].kind = TL_NAV_VOLUME_POLYGON;
    volumes[1].area = 7;
    volumes[1].box.max.y = 5;
    volumes[1].points = outline;
    volumes[1].point_count = 3;
    volumes[2].kind = TL_NAV_VOLUME_CYLINDER;
    volumes[2].area = 255;
    volumes[2].radius = 2;
    volumes[2].height = 1;
    tl_pack_volumes *marks = NULL;
    TEST_RESULT(tl_pack_volumes_encode(volumes, 3, NULL, &marks, NULL), TL_OK);
    const uint64_t size = marks->blob.size;
    TEST_RESULT(tl_pack_volumes_check(marks, size, NULL), TL_OK);
    for (uint32_t i = 0; i < 3; i++) {
        const tl_nav_volume volume = tl_pack_volumes_at(marks, i);
        TEST_CHECK(volume.kind == volumes[i].kind && volume.area == volumes[i].area &&
                   volume.radius == volumes[i].radius && volume.point_count == volumes[i].point_count &&
                   memcmp(&volume.box, &volumes[i].box, sizeof volume.box) == 0);
    }
    const tl_nav_volume prism = tl_pack_volumes_at(marks, 1);
    TEST_CHECK(prism.points[2].x == 4.0f && prism.points[2].y == 0.0f && prism.points[2].z == 4.0f);
    for (uint64_t cut = 0; cut < size; cut++) {
        TEST_CHECK(tl_pack_volumes_check(marks, cut, NULL) != TL_OK);
    }
    // Any byte altered: refused, or marks that can be read whole.
    uint8_t *bytes = (uint8_t *)marks;
    uint32_t refused = 0;
    for (uint64_t i = 0; i < size; i++) {
        for (int bit = 0; bit < 8; bit++) {
            bytes[i] ^= (uint8_t)(1 << bit);
            const bool ok = tl_pack_volumes_check(bytes, size, NULL) == TL_OK;
            for (uint32_t k = 0; ok && k < marks->count; k++) {
                const tl_nav_volume volume = tl_pack_volumes_at(marks, k);
                for (uint32_t p = 0; p < volume.point_count; p++) {
                    TEST_CHECK(isfinite(volume.points[p].x) && volume.points[p].y == 0.0f);
                }
            }
            refused += !ok;
            bytes[i] ^= (uint8_t)(1 << bit);
        }
    }
    TEST_CHECK(refused > 1000 && refused < size * 8);
    tl_blob_free(marks);
    volumes[2].radius = NAN;
    TEST_RESULT(tl_pack_volumes_encode(volumes, 3, NULL, &marks, NULL), TL_ERR_NOT_FINITE);
    TEST_RESULT(tl_pack_volumes_encode(NULL, 0, NULL, &marks, NULL), TL_OK);
    TEST_RESULT(tl_pack_volumes_check(marks, marks->blob.size, NULL), TL_OK);
    tl_blob_free(marks);
}

static void test_pruning(void **state)
{
    (void)state;
    const tl_vec3 seeds[] = { { 1, 2, 3 }, { -4, 5, 6 } };
    const tl_mesh_view solids = { 0 };
    tl_nav_prune_def def = tl_default_nav_prune_def();
    tl_pack_pruning *rules = NULL;
    def.seeds = seeds;
    def.seed_count = 2;
    def.min_area = 2.5;
    def.solids = &solids;
    TEST_RESULT(tl_pack_pruning_encode(&def, NULL, &rules, NULL), TL_OK);
    const uint64_t size = rules->blob.size;
    TEST_RESULT(tl_pack_pruning_check(rules, size, NULL), TL_OK);
    TEST_CHECK(rules->min_area == 2.5 && rules->drop_inside_solids == 1 && rules->seed_count == 2);
    TEST_CHECK(rules->seed_extents.y == def.seed_extents.y);
    assert_memory_equal(tl_pack_pruning_seeds(rules), seeds, sizeof seeds);
    for (uint64_t cut = 0; cut < size; cut++) {
        TEST_CHECK(tl_pack_pruning_check(rules, cut, NULL) != TL_OK);
    }
    // Any bit altered: refused, or rules that can be read whole.
    uint8_t *bytes = (uint8_t *)rules;
    uint32_t refused = 0;
    for (uint64_t i = 0; i < 8 * size; i++) {
        bytes[i / 8] ^= (uint8_t)(1 << i % 8);
        const bool ok = tl_pack_pruning_check(rules, size, NULL) == TL_OK;
        TEST_CHECK(!ok || (isfinite(rules->min_area) && rules->min_area >= 0.0));
        for (uint32_t k = 0; ok && k < rules->seed_count; k++) {
            TEST_CHECK(tl_is_finite(tl_pack_pruning_seeds(rules)[k]));
        }
        refused += !ok;
        bytes[i / 8] ^= (uint8_t)(1 << i % 8);
    }
    TEST_CHECK(refused > 300 && refused < size * 8);
    tl_blob_free(rules);
    def.min_area = (double)INFINITY;
    TEST_RESULT(tl_pack_pruning_encode(&def, NULL, &rules, NULL), TL_ERR_ARGUMENT);
}

static void test_load_navmesh(void **state)
{
    (void)state;
    const char *const rows[] = { "0000", "0000", "0000", "0000" };
    fixture_level level = fixture_make(rows, 4);
    level.tile_cells = 2;
    tl_pack_item items[4];
    tl_nav_tile *tiles[4];
    for (uint32_t i = 0; i < 4; i++) {
        tiles[i] = fixture_build_tile(&level, (int32_t)(i % 2), (int32_t)(i / 2), NULL);
        tl_pack_item item = { TL_PACK_NAVT, i, tiles[i], tiles[i]->blob.size };
        items[i] = item;
    }
    memory_sink sink = write_items(items, 4);
    tl_pack pack;
    tl_navmesh *navmesh = NULL;
    TEST_RESULT(tl_pack_open(sink.bytes, sink.size, &pack, NULL), TL_OK);
    TEST_RESULT(tl_pack_load_navmesh(&pack, NULL, &navmesh, NULL), TL_OK);
    TEST_CHECK(tl_navmesh_tile_count(navmesh) == 4);
    TEST_CHECK(tl_navmesh_link_count(navmesh) == 48); // 24 inner edges of a grid of 4 x 4, both ways
    tl_navmesh_destroy(navmesh);
    test_blob_free(sink.bytes);

    tiles[2]->side_end[0]++; // hashes right, content wrong
    sink = write_items(items, 4);
    tl_report report;
    TEST_RESULT(tl_pack_open(sink.bytes, sink.size, &pack, NULL), TL_OK);
    TEST_RESULT(tl_pack_load_navmesh(&pack, NULL, &navmesh, &report), TL_ERR_CORRUPT);
    TEST_CHECK(navmesh == NULL && report.element_index == 2);
    test_blob_free(sink.bytes);
    for (uint32_t i = 0; i < 4; i++) {
        tl_blob_free(tiles[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip), cmocka_unit_test(test_fetched),  cmocka_unit_test(test_layout),
        cmocka_unit_test(test_empty),      cmocka_unit_test(test_prefixes), cmocka_unit_test(test_altered),
        cmocka_unit_test(test_bad_items),  cmocka_unit_test(test_meta),     cmocka_unit_test(test_navmesh_settings),
        cmocka_unit_test(test_marks),      cmocka_unit_test(test_pruning),  cmocka_unit_test(test_load_navmesh),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
