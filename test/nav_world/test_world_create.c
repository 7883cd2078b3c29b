// SPDX-License-Identifier: MIT
//
// Opening a world by its index: what is refused by name, and that no damaged byte of the index or of a tile goes
// unseen.

#include "nav_world_file.h"

static const double HERE[3] = { 1e6, 0, 0 };

static fixture_level small_level(void)
{
    test_random random = { 21 };
    fixture_level level = fixture_random(&random, 1, 12);
    level.tile_cells = 4;
    return level;
}

static tl_result try_open(world_file *file, tl_report *report)
{
    tl_nav_world_def def = tl_default_nav_world_def();
    tl_nav_world *world = NULL;
    def.read = world_file_read;
    def.user = file;
    const tl_result result = tl_nav_world_create(&def, &world, report);
    TEST_CHECK((result == TL_OK) == (world != NULL));
    tl_nav_world_destroy(world);
    return result;
}

// The chunks of a file, to be written again otherwise.
static world_file rewrite(const world_file *file, const tl_pack_item *extra, bool backwards, bool doubled)
{
    tl_pack pack;
    tl_pack_item items[64];
    world_file copy, out;
    uint32_t count = 0;
    memset(&out, 0, sizeof out);
    copy.in.bytes = test_blob_alloc(file->in.size);
    memcpy(copy.in.bytes, file->in.bytes, file->in.size);
    TEST_RESULT(tl_pack_to_host_order(copy.in.bytes, file->in.size, NULL), TL_OK);
    TEST_RESULT(tl_pack_open(copy.in.bytes, file->in.size, &pack, NULL), TL_OK);
    TEST_CHECK(pack.chunk_count + 2 <= 64);
    for (uint32_t i = 0; i < pack.chunk_count; i++) {
        const tl_pack_chunk chunk = tl_pack_chunk_at(&pack, backwards ? pack.chunk_count - 1 - i : i);
        const tl_pack_item item = { chunk.type, chunk.id, chunk.bytes, chunk.size };
        items[count++] = item;
    }
    if (doubled) {
        items[count] = items[count - 1];
        items[count++].id = 999;
    }
    if (extra != NULL) {
        items[count++] = *extra;
    }
    TEST_RESULT(tl_pack_write(items, count, NULL, memory_file_write, &out.in, NULL), TL_OK);
    test_blob_free(copy.in.bytes);
    return out;
}

static void test_refused_by_name(void **state)
{
    (void)state;
    const fixture_level level = small_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_report report;
    TEST_RESULT(try_open(&file, &report), TL_OK);

    tl_pack_offmesh *links = NULL;
    TEST_RESULT(tl_pack_offmesh_encode(NULL, 0, NULL, &links, NULL), TL_OK);
    const tl_pack_item extra = { TL_PACK_OFFM, 0, links, links->blob.size };
    world_file linked = rewrite(&file, &extra, false, false);
    TEST_RESULT(try_open(&linked, &report), TL_ERR_UNSUPPORTED);
    TEST_CHECK(strcmp(report.element, "chunk") == 0 && report.advice != NULL);
    world_file twice = rewrite(&file, NULL, false, true);
    TEST_RESULT(try_open(&twice, &report), TL_ERR_CORRUPT);
    world_file backwards = rewrite(&file, NULL, true, false);
    TEST_RESULT(try_open(&backwards, &report), TL_ERR_CORRUPT);
    world_file empty;
    memset(&empty, 0, sizeof empty);
    TEST_RESULT(tl_pack_write(NULL, 0, NULL, memory_file_write, &empty.in, NULL), TL_OK);
    TEST_RESULT(try_open(&empty, &report), TL_NOT_FOUND);

    tl_blob_free(links);
    world_file_free(&linked);
    world_file_free(&twice);
    world_file_free(&backwards);
    world_file_free(&empty);
    world_file_free(&file);
}

// Every prefix, and every byte of the index altered.
static void test_damaged_index(void **state)
{
    (void)state;
    const fixture_level level = small_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    uint64_t index_size = 0;
    union {
        uint64_t aligned[TL_PACK_HEAD_SIZE / 8];
        unsigned char bytes[TL_PACK_HEAD_SIZE];
    } head;
    memcpy(head.bytes, file.in.bytes, sizeof head);
    TEST_RESULT(tl_pack_index_size(head.bytes, &index_size, NULL), TL_OK);
    const size_t whole = file.in.size;
    for (size_t size = 0; size < index_size; size++) {
        file.in.size = size;
        TEST_CHECK(tl_is_error(try_open(&file, NULL)));
    }
    file.in.size = whole;
    for (size_t i = 0; i < index_size; i++) {
        file.in.bytes[i] ^= 0x10;
        TEST_CHECK(tl_is_error(try_open(&file, NULL)));
        file.in.bytes[i] ^= 0x10;
    }
    TEST_RESULT(try_open(&file, NULL), TL_OK);
    world_file_free(&file);
}

// Bytes of tiles altered: refused at once, or when they are loaded; never taken in.
static void test_damaged_tiles(void **state)
{
    (void)state;
    const fixture_level level = small_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    test_random random = { 4 };
    uint64_t index_size = 0;
    union {
        uint64_t aligned[TL_PACK_HEAD_SIZE / 8];
        unsigned char bytes[TL_PACK_HEAD_SIZE];
    } head;
    memcpy(head.bytes, file.in.bytes, sizeof head);
    TEST_RESULT(tl_pack_index_size(head.bytes, &index_size, NULL), TL_OK);
    uint32_t refused = 0, failed = 0;
    for (uint32_t i = 0; i < 300; i++) {
        const size_t at =
            (size_t)index_size + 512 + test_random_below(&random, (uint32_t)(file.in.size - index_size - 512));
        const unsigned char flip = (unsigned char)(1u << test_random_below(&random, 8));
        file.in.bytes[at] ^= flip;
        tl_nav_world_def def = tl_default_nav_world_def();
        tl_nav_world *world = NULL;
        def.read = world_file_read;
        def.user = &file;
        if (tl_nav_world_create(&def, &world, NULL) == TL_OK) {
            const tl_nav_world_interest all = world_interest(HERE, 0, 0, 1e6);
            world_settle(world, &all, 1);
            const tl_nav_world_state now = world_state(world);
            TEST_CHECK(now.failed <= 1 && now.loaded + now.failed == now.places && now.missing == 0);
            failed += now.failed;
        } else {
            refused++;
        }
        tl_nav_world_destroy(world);
        file.in.bytes[at] ^= flip;
    }
    // The rest lay in padding between chunks, which nobody reads.
    print_message("%u refused, %u failed when loaded\n", refused, failed);
    TEST_CHECK(refused + failed > 280 && failed > 200);
    world_file_free(&file);
}

// Whatever each of the reads says: an error is passed on, an outcome is no answer of the world's.
static void test_reads_that_say_no(void **state)
{
    (void)state;
    static const tl_result said[4] = { TL_NOT_FOUND, TL_NOT_LOADED, TL_INCOMPLETE, TL_ERR_CANCELLED };
    const fixture_level level = small_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Z_UP);
    tl_report report;
    TEST_RESULT(try_open(&file, &report), TL_OK);
    const uint64_t reads = file.reads;
    TEST_CHECK(reads > 8);
    for (file.fail_at = 1; file.fail_at <= reads; file.fail_at++) {
        for (int i = 0; i < 4; i++) {
            file.reads = 0;
            file.failure = said[i];
            TEST_RESULT(try_open(&file, &report), tl_is_error(said[i]) ? said[i] : TL_ERR_IO);
            TEST_CHECK(report.element != NULL && strcmp(report.advice, "the file could not be read") == 0);
        }
    }
    world_file_free(&file);
}

static void test_memory_fails(void **state)
{
    (void)state;
    const fixture_level level = small_level();
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    tl_result result = TL_ERR_MEMORY;
    uint32_t failures = 0;
    for (uint64_t fail_at = 1; result != TL_OK; fail_at++, failures++) {
        test_allocator memory;
        test_allocator_init(&memory, fail_at);
        tl_nav_world_def def = tl_default_nav_world_def();
        tl_nav_world *world = NULL;
        def.read = world_file_read;
        def.user = &file;
        def.allocator = &memory.allocator;
        const tl_nav_world_interest all = world_interest(HERE, 0, 0, 1e6);
        result = tl_nav_world_create(&def, &world, NULL);
        for (int i = 0; i < 3 && result == TL_OK; i++) {
            tl_nav_world_load load;
            result = tl_nav_world_update(world, &all, 1, 4);
            result = result == TL_NOT_FOUND ? TL_OK : result;
            result = result == TL_OK ? tl_nav_world_begin_load(world, &load) : result;
            if (result == TL_OK) {
                TEST_RESULT(tl_nav_world_run_load(&load), TL_OK);
                TEST_RESULT(tl_nav_world_end_load(&load), TL_OK);
            }
        }
        TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
        tl_nav_world_destroy(world);
        TEST_CHECK(memory.live_blocks == 0);
    }
    TEST_CHECK(failures > 20);
    world_file_free(&file);
}

// Tables are made when the world is opened, for all tiles that the budget will hold: no later one is copied in a frame.
static void test_tables_do_not_grow(void **state)
{
    (void)state;
    static const char row[] = "000000000000000000000000000000000000000000000000";
    const char *rows[sizeof row - 1];
    for (size_t i = 0; i < sizeof row - 1; i++) {
        rows[i] = row;
    }
    fixture_level level = fixture_make(rows, sizeof row - 1);
    level.tile_cells = 3;
    world_file file = world_file_make(&level, HERE, TL_PACK_AXES_Y_UP);
    const tl_nav_world_interest all = world_interest(HERE, 0, 0, 1e6);
    uint32_t most = 0;
    for (uint64_t budget = 128 << 10; budget <= 8 << 20; budget *= 4) {
        test_allocator memory;
        tl_nav_world_def def = tl_default_nav_world_def();
        tl_nav_world *world = NULL;
        test_allocator_init(&memory, 0);
        def.read = world_file_read;
        def.user = &file;
        def.budget = budget;
        def.allocator = &memory.allocator;
        TEST_RESULT(tl_nav_world_create(&def, &world, NULL), TL_OK);
        memory.largest = 0;
        world_settle(world, &all, 1);
        const tl_nav_world_state now = world_state(world);
        TEST_CHECK(now.loaded > 4 && now.peak_bytes <= budget);
        TEST_CHECK(memory.largest < 100 * (uint64_t)now.loaded || now.loaded < 100);
        most = now.loaded > most ? now.loaded : most;
        tl_nav_world_destroy(world);
    }
    TEST_CHECK(most > 200);
    world_file_free(&file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refused_by_name), cmocka_unit_test(test_damaged_index),
        cmocka_unit_test(test_damaged_tiles),   cmocka_unit_test(test_reads_that_say_no),
        cmocka_unit_test(test_memory_fails),    cmocka_unit_test(test_tables_do_not_grow),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
