// SPDX-License-Identifier: MIT
//
// Numbers in files: little-endian, whatever the machine; compilers make one load or store of each.

#ifndef TALUS_WORLD_LITTLE_ENDIAN_H
#define TALUS_WORLD_LITTLE_ENDIAN_H

#include <stdint.h>
#include <string.h>

static inline void tl_put_u32(unsigned char *at, uint32_t value)
{
    for (unsigned i = 0; i < 4; i++) {
        at[i] = (unsigned char)(value >> 8 * i);
    }
}

static inline uint32_t tl_get_u32(const unsigned char *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

static inline void tl_put_u64(unsigned char *at, uint64_t value)
{
    tl_put_u32(at, (uint32_t)value);
    tl_put_u32(at + 4, (uint32_t)(value >> 32));
}

static inline uint64_t tl_get_u64(const unsigned char *at)
{
    return (uint64_t)tl_get_u32(at) | (uint64_t)tl_get_u32(at + 4) << 32;
}

static inline void tl_put_float(unsigned char *at, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    tl_put_u32(at, bits);
}

static inline float tl_get_float(const unsigned char *at)
{
    const uint32_t bits = tl_get_u32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline void tl_put_double(unsigned char *at, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    tl_put_u64(at, bits);
}

static inline double tl_get_double(const unsigned char *at)
{
    const uint64_t bits = tl_get_u64(at);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
