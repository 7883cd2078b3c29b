// SPDX-License-Identifier: MIT
//
// Oracle: the xxHash library, on every length up to some stripes and at every alignment.

#include "talus_test.h"

#include "base/hash.h"

#include <xxhash.h>

static void equals_xxhash(void **state)
{
    (void)state;
    uint8_t bytes[300];
    test_random random = { 21 };
    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (uint8_t)test_random_u64(&random);
    }
    for (size_t start = 0; start < 9; start++) {
        for (size_t size = 0; size + start < sizeof bytes; size++) {
            uint64_t seed = size % 3 == 0 ? 0 : test_random_u64(&random);
            TEST_CHECK(tl_hash_bytes(bytes + start, size, seed) == XXH64(bytes + start, size, seed));
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(equals_xxhash) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
