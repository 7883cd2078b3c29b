// SPDX-License-Identifier: MIT
//
// What targets share that make their input out of bytes, one by one: past the end all are 0.

#ifndef TALUS_FUZZ_FUZZ_INPUT_H
#define TALUS_FUZZ_FUZZ_INPUT_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void require(bool condition)
{
    if (!condition) {
        abort();
    }
}

typedef struct fuzz_bytes {
    const uint8_t *data;
    size_t size;
} fuzz_bytes;

static inline uint8_t next_byte(fuzz_bytes *bytes)
{
    if (bytes->size == 0) {
        return 0;
    }
    bytes->size--;
    return *bytes->data++;
}

/// Metres from 0 to 16, most often multiples of an eighth, seldom anything.
static inline float next_grid_coordinate(fuzz_bytes *bytes)
{
    const uint8_t value = next_byte(bytes);
    if (value < 0xf8) {
        return 0.125f * (float)(value % 128);
    }
    const uint8_t exponent = next_byte(bytes);
    return value == 0xff ? NAN : ldexpf((float)value - 250.0f, (int)(exponent % 64) - 32);
}

#endif
