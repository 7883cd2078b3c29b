// SPDX-License-Identifier: MIT
//
// Every operation of the vector vocabulary on one set of inputs, and what it gave: simd_ops.inl, compiled once a level.

#ifndef SIMD_OPS_H
#define SIMD_OPS_H

#include "base/cpu.h"

#include <stdint.h>

enum { SIMD_LANES = 16, SIMD_MAX_OUTPUTS = 160 };

typedef struct simd_input {
    float a[SIMD_LANES], b[SIMD_LANES], c[SIMD_LANES], d[SIMD_LANES];
    double p[8], q[8], r[8];
    uint8_t bytes[SIMD_LANES];
    uint32_t order[4]; // below 4
    uint32_t mask;     // of 16 bits
} simd_input;

// What another level owes to plain C.
typedef enum simd_promise {
    SIMD_EXACT,     // the same bits
    SIMD_NUMBER_32, // the same bits, or both NaN
    SIMD_NUMBER_64,
    SIMD_FUSED,   // as SIMD_NUMBER_32; or a b + c rounded once
    SIMD_UNFUSED, // as SIMD_NUMBER_32; or c - a b rounded once
    SIMD_EQUAL    // equal values; nothing where an input is NaN
} simd_promise;

typedef struct simd_output {
    const char *name;
    simd_promise promise;
    uint32_t size; // bytes
    union {
        float f32[SIMD_LANES];
        double f64[8];
        int32_t i32[SIMD_LANES];
        uint32_t u32[SIMD_LANES];
        uint64_t u64[SIMD_LANES];
        uint8_t bytes[128];
    } value;
} simd_output;

// Returns how many outputs there are: the same ones in the same order at each level.
typedef uint32_t simd_ops_fn(const simd_input *in, simd_output *out);

simd_ops_fn simd_ops_scalar;
#if TL_CPU_LEVELS >= 1
simd_ops_fn simd_ops_vec128;
#endif
#if TL_CPU_LEVELS >= 2
simd_ops_fn simd_ops_avx2, simd_ops_avx512;
#endif

#endif
