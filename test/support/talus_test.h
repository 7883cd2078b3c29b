// SPDX-License-Identifier: MIT
//
// What all tests share: cmocka, a reproducible random source, an allocator that counts and can fail.

#ifndef TALUS_TEST_H
#define TALUS_TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
// cmocka wants the four above first.
#include <cmocka.h>

#include "base/random.h"

#include <talus/base.h>
#include <talus/vec.h>

/// Fails the test with the condition's text.
#define TEST_CHECK(condition)                                                                                          \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fail_msg("%s", #condition);                                                                                \
        }                                                                                                              \
    } while (0)

/// Fails the test, naming both results.
#define TEST_RESULT(actual, expected)                                                                                  \
    do {                                                                                                               \
        tl_result test_result_ = (actual);                                                                             \
        if (test_result_ != (expected)) {                                                                              \
            fail_msg("%s is %s, expected %s", #actual, tl_result_name(test_result_), tl_result_name(expected));        \
        }                                                                                                              \
    } while (0)

/// A seed, then the state of base/random.h: the same numbers everywhere.
typedef struct test_random {
    uint64_t state;
} test_random;

static inline uint64_t test_random_u64(test_random *random)
{
    return tl_random_bits(&random->state);
}

/// [0, bound), bound > 0.
static inline uint32_t test_random_below(test_random *random, uint32_t bound)
{
    return tl_random_below(&random->state, bound);
}

/// [0, 1), 24 bits.
static inline float test_random_unit(test_random *random)
{
    return (float)(test_random_u64(random) >> 40) * (1.0f / 16777216.0f);
}

/// [low, high).
static inline float test_random_range(test_random *random, float low, float high)
{
    return low + (high - low) * test_random_unit(random);
}

static inline tl_vec3 test_random_point(test_random *random, tl_vec3 low, tl_vec3 high)
{
    float x = test_random_range(random, low.x, high.x);
    float y = test_random_range(random, low.y, high.y);
    float z = test_random_range(random, low.z, high.z);
    return tl_vec3_make(x, y, z);
}

/// A point between -3 and 3; on the lattice, where distances are often equal.
static inline tl_vec3 test_random_place(test_random *random, bool on_lattice)
{
    tl_vec3 p = test_random_point(random, tl_vec3_make(-3, -3, -3), tl_vec3_make(3, 3, 3));
    return on_lattice ? tl_vec3_make(truncf(p.x), truncf(p.y), truncf(p.z)) : p;
}

/// A direction uniform on the sphere, by rejection.
static inline tl_vec3 test_random_direction(test_random *random)
{
    for (;;) {
        tl_vec3 v = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
        float length_sq = tl_length_sq(v);
        if (length_sq > 0.01f && length_sq <= 1.0f) {
            return tl_normalize(v);
        }
    }
}

/// Counts what is live, and returns NULL from the allocation number fail_at (1 is the first; 0 never). Single-threaded.
typedef struct test_allocator {
    tl_allocator allocator; ///< pass &test.allocator
    uint64_t calls;
    uint64_t fail_at;
    uint64_t live_blocks;
    uint64_t live_bytes;
    uint64_t peak_bytes;
    uint64_t largest; ///< bytes of any block so far; may be set to 0
} test_allocator;

/// A block that a blob may lie in; free it with test_blob_free. Windows has such blocks by other functions than
/// malloc's.
static inline void *test_blob_alloc(size_t size)
{
    size_t rounded = (size + TL_BLOB_ALIGNMENT - (size > 0)) / TL_BLOB_ALIGNMENT * TL_BLOB_ALIGNMENT;
#ifdef _WIN32
    return _aligned_malloc(rounded, TL_BLOB_ALIGNMENT);
#else
    return aligned_alloc(TL_BLOB_ALIGNMENT, rounded);
#endif
}

static inline void test_blob_free(void *block)
{
#ifdef _WIN32
    _aligned_free(block);
#else
    free(block);
#endif
}

static inline void *test_allocate(size_t size, size_t alignment, void *user)
{
    test_allocator *test = (test_allocator *)user;
    test->calls++;
    if (test->fail_at != 0 && test->calls >= test->fail_at) {
        return NULL;
    }
    assert_true(alignment <= TL_BLOB_ALIGNMENT);
    void *block = test_blob_alloc(size);
    if (block != NULL) {
        test->live_blocks++;
        test->live_bytes += size;
        test->peak_bytes = test->live_bytes > test->peak_bytes ? test->live_bytes : test->peak_bytes;
        test->largest = size > test->largest ? size : test->largest;
    }
    return block;
}

static inline void test_release(void *block, size_t size, void *user)
{
    test_allocator *test = (test_allocator *)user;
    test->live_blocks--;
    test->live_bytes -= size;
    test_blob_free(block);
}

static inline void test_allocator_init(test_allocator *test, uint64_t fail_at)
{
    test_allocator zero = { { test_allocate, test_release, NULL }, 0, 0, 0, 0, 0, 0 };
    *test = zero;
    test->allocator.user = test;
    test->fail_at = fail_at;
}

#endif
