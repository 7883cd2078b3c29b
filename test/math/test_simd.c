// SPDX-License-Identifier: MIT
//
// Every operation of the vector vocabulary, at every level that this build has, against plain C, on hostile values:
// NaN of either sign and with payloads, signalling ones, zeros of either sign, denormals, infinities, random bits.
//
// Nothing but the C library, so that it runs wherever a compiler goes (tools/check-simd: AArch64 in qemu, node).

#include "simd_ops.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ROUNDS = 100000 };

static uint64_t random_state = 1;

// SplitMix64.
static uint32_t random_bits(void)
{
    random_state += 0x9e3779b97f4a7c15u;
    uint64_t z = random_state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (uint32_t)(z >> 32);
}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t hostile_bits(void)
{
    static const uint32_t values[] = { 0x00000000, 0x00000001, 0x007fffff, 0x00800000, 0x00800001, 0x3f800000,
                                       0x3f800001, 0x3f7fffff, 0x4b800000, 0x7f7fffff, 0x7f800000, 0x7f800001,
                                       0x7fa00123, 0x7fc00000, 0x7fc00456, 0x7fffffff, 0x5f800000, 0x1f800000 };
    uint32_t bits = random_bits(), sign = bits << 31;
    switch (bits >> 1 & 3) {
    case 0:
        return values[(bits >> 3) % (sizeof values / sizeof *values)] | sign;
    case 1:
        return random_bits();
    default: // numbers of a usual size, many of them equal
        return (0x3e000000u + (random_bits() % 5 << 23) + random_bits() % 3) | sign;
    }
}

// Bits straight into memory: a signalling NaN would not survive every assignment of a float.
static void fill_input(simd_input *in)
{
    float *const rows[4] = { in->a, in->b, in->c, in->d };
    for (int row = 0; row < 4; row++) {
        for (int i = 0; i < SIMD_LANES; i++) {
            uint32_t bits = hostile_bits();
            memcpy(&rows[row][i], &bits, sizeof bits);
        }
    }
    double *const wide[3] = { in->p, in->q, in->r };
    for (int row = 0; row < 3; row++) {
        for (int i = 0; i < 8; i++) {
            uint64_t bits = (uint64_t)random_bits() << 32 | random_bits();
            wide[row][i] = (double)float_of(hostile_bits());
            if (random_bits() % 4 == 0) {
                memcpy(&wide[row][i], &bits, sizeof bits);
            }
        }
    }
    for (int i = 0; i < SIMD_LANES; i++) {
        in->bytes[i] = (uint8_t)random_bits();
    }
    for (int i = 0; i < 4; i++) {
        in->order[i] = random_bits() % 4;
    }
    in->mask = random_bits() & random_bits() & 0xffffu;
}

static int same_f32(float a, float b)
{
    return (isnan(a) && isnan(b)) || memcmp(&a, &b, sizeof a) == 0;
}

// a * b + c, rounded once. The product is exact in double; of the sum's two neighbours the odd one is taken, from which
// rounding to float cannot go wrong (Boldo and Melquiond 2008). Not all C libraries' fmaf rounds once.
static float fused(float a, float b, float c)
{
    const double product = (double)a * (double)b;
    double sum = product + (double)c;
    const double rest = sum - product, error = (product - (sum - rest)) + ((double)c - rest);
    uint64_t bits;
    memcpy(&bits, &sum, sizeof bits);
    if (isfinite(sum) && error != 0.0 && (bits & 1u) == 0) {
        bits += (error > 0.0) == (sum > 0.0) ? 1u : UINT64_MAX;
        memcpy(&sum, &bits, sizeof sum);
    }
    return (float)sum;
}

static int keeps_lane_32(const simd_input *in, const simd_output *plain, const simd_output *other, uint32_t lane)
{
    float x = plain->value.f32[lane], y = other->value.f32[lane];
    switch (plain->promise) {
    case SIMD_FUSED:
        return same_f32(x, y) || same_f32(fused(in->a[lane], in->b[lane], in->c[lane]), y);
    case SIMD_UNFUSED:
        return same_f32(x, y) || same_f32(fused(-in->a[lane], in->b[lane], in->c[lane]), y);
    case SIMD_EQUAL:
        for (uint32_t i = 0; i < plain->size / sizeof x; i++) {
            if (isnan(in->a[i])) {
                return 1;
            }
        }
        return x == y;
    default:
        return same_f32(x, y);
    }
}

static int keeps_promise(const simd_input *in, const simd_output *plain, const simd_output *other)
{
    if (strcmp(plain->name, other->name) != 0 || plain->size != other->size) {
        return 0;
    }
    if (plain->promise == SIMD_EXACT) {
        return memcmp(plain->value.bytes, other->value.bytes, plain->size) == 0;
    }
    if (plain->promise == SIMD_NUMBER_64) {
        for (uint32_t i = 0; i < plain->size / sizeof(double); i++) {
            double x = plain->value.f64[i], y = other->value.f64[i];
            if (memcmp(&x, &y, sizeof x) != 0 && !(isnan(x) && isnan(y))) {
                return 0;
            }
        }
        return 1;
    }
    for (uint32_t i = 0; i < plain->size / sizeof(float); i++) {
        if (!keeps_lane_32(in, plain, other, i)) {
            return 0;
        }
    }
    return 1;
}

static void print_failure(const char *level, const simd_output *plain, const simd_output *other)
{
    printf("%s: %s differs from plain C\n", level, plain->name);
    for (uint32_t i = 0; i < plain->size / 4; i++) {
        printf("    %2u: %08x %08x\n", (unsigned)i, (unsigned)plain->value.u32[i], (unsigned)other->value.u32[i]);
    }
}

// How many operations broke their promise, each counted once.
static int compare_level(const char *level, simd_ops_fn *ops)
{
    static simd_output plain[SIMD_MAX_OUTPUTS], other[SIMD_MAX_OUTPUTS];
    uint8_t failed[SIMD_MAX_OUTPUTS] = { 0 };
    int failures = 0;
    uint32_t count = 0;
    for (int round = 0; round < ROUNDS; round++) {
        simd_input in;
        fill_input(&in);
        count = simd_ops_scalar(&in, plain);
        if (ops(&in, other) != count) {
            printf("%s: other operations than plain C\n", level);
            return 1;
        }
        for (uint32_t i = 0; i < count; i++) {
            if (!failed[i] && !keeps_promise(&in, &plain[i], &other[i])) {
                print_failure(level, &plain[i], &other[i]);
                failed[i] = 1;
                failures++;
            }
        }
    }
    printf("%s: %u operations, %d inputs each, %d differ from plain C\n", level, (unsigned)count, ROUNDS, failures);
    return failures;
}

int main(void)
{
    static simd_ops_fn *const levels[] = {
        simd_ops_scalar,
#if TL_CPU_LEVELS >= 1
        simd_ops_vec128,
#endif
#if TL_CPU_LEVELS >= 2
        simd_ops_avx2,
        simd_ops_avx512,
#endif
    };
    int failures = 0;
    for (int level = 0; level < (int)(sizeof levels / sizeof *levels); level++) {
        if (tl_cpu_has_level(level)) {
            failures += compare_level(tl_cpu_level_name(level), levels[level]);
        } else {
            printf("%s: this machine has it not\n", tl_cpu_level_name(level));
        }
    }
    return failures != 0;
}
