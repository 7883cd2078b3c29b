// SPDX-License-Identifier: MIT
//
// How many bytes of stack a function takes: it runs on a thread whose stack is painted before.

#ifndef TALUS_TEST_PAINTED_STACK_H
#define TALUS_TEST_PAINTED_STACK_H

#include "talus_test.h"

#include <pthread.h>
#include <string.h>

// Measured in an optimised build without sanitizers only.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define FRAMES_ARE_WIDER 1
#endif
#endif
#if !defined(__OPTIMIZE__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define FRAMES_ARE_WIDER 1
#endif

enum { PAINTED_BYTES = 1 << 18, PAINT = 0xa5, PROMISED_STACK = 32 * 1024 };

/// Bytes that were written on the stack of a thread that ran run(user). The file defines _DEFAULT_SOURCE first.
static inline size_t painted_stack_used(void *(*run)(void *user), void *user)
{
    uint8_t *stack = (uint8_t *)aligned_alloc(4096, PAINTED_BYTES);
    TEST_CHECK(stack != NULL);
    memset(stack, PAINT, PAINTED_BYTES);
    pthread_attr_t attributes;
    pthread_t thread;
    TEST_CHECK(pthread_attr_init(&attributes) == 0 && pthread_attr_setstack(&attributes, stack, PAINTED_BYTES) == 0);
    TEST_CHECK(pthread_create(&thread, &attributes, run, user) == 0 && pthread_join(thread, NULL) == 0);
    pthread_attr_destroy(&attributes);
    size_t untouched = 0;
    while (untouched < PAINTED_BYTES && stack[untouched] == PAINT) {
        untouched++;
    }
    free(stack);
    return PAINTED_BYTES - untouched;
}

#endif
