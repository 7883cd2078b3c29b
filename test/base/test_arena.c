// SPDX-License-Identifier: MIT

#include "talus_test.h"

#include "base/arena.h"

#include <string.h>

static void pushes_are_aligned_and_apart(void **state)
{
    (void)state;
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    test_random random = { 1 };
    unsigned char *previous = NULL;
    size_t previous_size = 0;
    for (int i = 0; i < 5000; i++) {
        size_t size = 1 + test_random_below(&random, i % 100 == 0 ? 200000 : 300);
        unsigned char *memory = TL_PUSH(&arena, unsigned char, size);
        TEST_CHECK(memory != NULL);
        TEST_CHECK((uintptr_t)memory % (size >= 64 ? 64 : 16) == 0);
        memset(memory, i & 0xff, size);
        if (previous != NULL) {
            TEST_CHECK(previous[0] == ((i - 1) & 0xff) && previous[previous_size - 1] == ((i - 1) & 0xff));
        }
        previous = memory;
        previous_size = size;
    }
    TEST_CHECK(arena.peak_bytes == arena.live_bytes && arena.live_bytes > 5000 * 100);
    tl_arena_free(&arena);
    TEST_CHECK(arena.live_bytes == 0);
}

static void rollback_gives_back_blocks(void **state)
{
    (void)state;
    test_allocator test;
    test_allocator_init(&test, 0);
    tl_arena arena;
    tl_arena_init(&arena, &test.allocator);
    tl_arena_mark empty = tl_arena_get_mark(&arena);
    TEST_CHECK(TL_PUSH(&arena, char, 100) != NULL);
    tl_arena_mark mark = tl_arena_get_mark(&arena);
    char *first = TL_PUSH(&arena, char, 100);
    for (int i = 0; i < 100; i++) {
        TEST_CHECK(TL_PUSH(&arena, char, 100000) != NULL);
    }
    TEST_CHECK(test.live_blocks > 1);
    tl_arena_rollback(&arena, mark);
    TEST_CHECK(test.live_blocks == 1);
    TEST_CHECK(TL_PUSH(&arena, char, 100) == first);
    tl_arena_rollback(&arena, empty);
    TEST_CHECK(test.live_blocks == 0);
    tl_arena_free(&arena);
}

static void lent_memory_comes_first_and_is_not_freed(void **state)
{
    (void)state;
    test_allocator test;
    test_allocator_init(&test, 0);
    _Alignas(64) char memory[1024];
    tl_arena arena;
    tl_arena_init_with(&arena, &test.allocator, memory, sizeof memory);
    tl_arena_mark mark = tl_arena_get_mark(&arena);
    char *first = TL_PUSH(&arena, char, 400), *second = TL_PUSH(&arena, char, 400);
    TEST_CHECK(first > memory && first + 400 <= second && second + 400 <= memory + sizeof memory);
    TEST_CHECK((uintptr_t)first % 64 == 0 && (uintptr_t)second % 64 == 0);
    TEST_CHECK(test.live_blocks == 0 && arena.peak_bytes == 0);
    char *third = TL_PUSH(&arena, char, 400);
    TEST_CHECK(third != NULL && (third + 400 <= memory || third >= memory + sizeof memory));
    TEST_CHECK(test.live_blocks == 1 && arena.live_bytes > 400);
    tl_arena_rollback(&arena, mark);
    TEST_CHECK(test.live_blocks == 0 && TL_PUSH(&arena, char, 400) == first);
    TEST_CHECK(TL_PUSH(&arena, char, 2000) != NULL && test.live_blocks == 1);
    tl_arena_free(&arena);
    TEST_CHECK(test.live_blocks == 0 && arena.live_bytes == 0);
}

static void what_is_reserved_costs_one_block(void **state)
{
    (void)state;
    test_allocator test;
    test_allocator_init(&test, 0);
    tl_arena arena;
    tl_arena_init(&arena, &test.allocator);
    TEST_CHECK(tl_arena_reserve(&arena, 1000000) && test.live_blocks == 1);
    tl_arena_mark mark = tl_arena_get_mark(&arena);
    for (int round = 0; round < 3; round++) {
        for (int i = 0; i < 100; i++) {
            TEST_CHECK(TL_PUSH(&arena, char, 9984) != NULL);
        }
        TEST_CHECK(test.live_blocks == 1 && tl_arena_reserve(&arena, 0) && test.live_blocks == 1);
        tl_arena_rollback(&arena, mark);
        TEST_CHECK(test.live_blocks == 1);
    }
    TEST_CHECK(!tl_arena_reserve(&arena, UINT64_MAX) && tl_arena_reserve(&arena, 2000000) && test.live_blocks == 2);
    tl_arena_free(&arena);
    TEST_CHECK(test.live_blocks == 0);
}

static void impossible_sizes_are_refused(void **state)
{
    (void)state;
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    TEST_CHECK(TL_PUSH(&arena, uint64_t, UINT64_MAX / 4) == NULL);
    TEST_CHECK(TL_PUSH(&arena, char, UINT64_MAX) == NULL);
    TEST_CHECK(TL_PUSH(&arena, char, 0) != NULL);
    TEST_CHECK(tl_allocate_array(NULL, UINT64_MAX / 8, 16) == NULL);
    tl_arena_free(&arena);

    test_allocator test;
    test_allocator_init(&test, 1);
    tl_arena_init(&arena, &test.allocator);
    TEST_CHECK(TL_PUSH_ZERO(&arena, char, 10) == NULL);
    TEST_CHECK(arena.peak_bytes == 0);
    tl_arena_free(&arena);
}

static void blobs_are_zeroed_and_counted(void **state)
{
    (void)state;
    test_allocator test;
    test_allocator_init(&test, 0);
    unsigned char *bytes = tl_blob_allocate(&test.allocator, 0x31323334, 7, 65);
    TEST_CHECK(bytes != NULL && (uintptr_t)bytes % TL_BLOB_ALIGNMENT == 0);
    const tl_blob *blob = (const tl_blob *)(const void *)bytes;
    TEST_CHECK(blob->magic == 0x31323334 && blob->version == 7 && blob->size == 128);
    for (size_t i = sizeof(tl_blob); i < 128; i++) {
        TEST_CHECK(bytes[i] == 0);
    }
    tl_blob_free(bytes);
    tl_blob_free(NULL);
    TEST_CHECK(test.live_blocks == 0 && test.live_bytes == 0);
}

static void growing_arrays_keep_their_items(void **state)
{
    (void)state;
    tl_arena arena;
    tl_arena_init(&arena, NULL);
    uint32_t *items = NULL, capacity = 0;
    for (uint32_t i = 0; i < 1000; i++) {
        if (i == capacity) {
            items = tl_arena_grow(&arena, items, &capacity, 3, sizeof *items);
            TEST_CHECK(items != NULL && capacity == (i > 0 ? 2 * i : 3));
        }
        items[i] = 7 * i;
    }
    for (uint32_t i = 0; i < 1000; i++) {
        TEST_CHECK(items[i] == 7 * i);
    }
    // Twice this does not fit 32 bits.
    uint32_t most = 0x80000000u;
    TEST_CHECK(tl_arena_grow(&arena, items, &most, 3, sizeof *items) == NULL && most == 0x80000000u);
    tl_arena_free(&arena);
}

static void arrays_of_blobs_are_freed_whole(void **state)
{
    (void)state;
    test_allocator test;
    test_allocator_init(&test, 0);
    void **blobs = tl_allocate_array(&test.allocator, 3, sizeof *blobs);
    TEST_CHECK(blobs != NULL);
    blobs[0] = tl_blob_allocate(&test.allocator, 1, 1, 100);
    blobs[1] = NULL;
    blobs[2] = tl_blob_allocate(&test.allocator, 1, 1, 1000);
    TEST_CHECK(test.live_blocks == 3);
    tl_blob_array_free(&test.allocator, blobs, 3);
    tl_blob_array_free(&test.allocator, NULL, 3);
    TEST_CHECK(test.live_blocks == 0 && test.live_bytes == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pushes_are_aligned_and_apart),
        cmocka_unit_test(rollback_gives_back_blocks),
        cmocka_unit_test(lent_memory_comes_first_and_is_not_freed),
        cmocka_unit_test(what_is_reserved_costs_one_block),
        cmocka_unit_test(impossible_sizes_are_refused),
        cmocka_unit_test(blobs_are_zeroed_and_counted),
        cmocka_unit_test(growing_arrays_keep_their_items),
        cmocka_unit_test(arrays_of_blobs_are_freed_whole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
