// SPDX-License-Identifier: MIT
//
// The meter against a count of its own.

#include "base/memory_meter.h"

#include "base/arena.h"
#include "talus_test.h"

static void counts_live_and_peak(void **state)
{
    (void)state;
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_memory_meter meter;
    tl_memory_meter_init(&meter, &memory.allocator);
    test_random random = { 3 };
    void *blocks[50] = { NULL };
    size_t sizes[50] = { 0 };
    uint64_t peak = 0;
    for (uint32_t round = 0; round < 5000; round++) {
        uint32_t i = test_random_below(&random, 50);
        if (blocks[i] != NULL) {
            tl_release(&meter.allocator, blocks[i], sizes[i]);
            blocks[i] = NULL;
        } else {
            sizes[i] = 1 + test_random_below(&random, 1000);
            blocks[i] = tl_allocate(&meter.allocator, sizes[i], 64);
        }
        peak = memory.live_bytes > peak ? memory.live_bytes : peak;
        TEST_CHECK(tl_memory_meter_peak(&meter) == peak);
    }
    for (uint32_t i = 0; i < 50; i++) {
        tl_release(&memory.allocator, blocks[i], sizes[i]); // the host's own: the blocks are its
    }
    TEST_CHECK(memory.live_blocks == 0 && peak > 10000);
    memory.fail_at = memory.calls + 1;
    TEST_CHECK(tl_allocate(&meter.allocator, 1u << 20, 64) == NULL);
    TEST_CHECK(tl_memory_meter_peak(&meter) == peak);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(counts_live_and_peak) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
