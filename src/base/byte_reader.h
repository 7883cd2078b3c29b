// SPDX-License-Identifier: MIT
//
// Bounded reading of untrusted little-endian bytes: every read is checked, a failure sticks, nothing is aligned.

#ifndef TALUS_SRC_BASE_BYTE_READER_H
#define TALUS_SRC_BASE_BYTE_READER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct tl_byte_reader {
    const uint8_t *bytes;
    uint64_t size;
    uint64_t offset;
    bool failed; ///< set by the first read beyond the end; all later reads return 0
} tl_byte_reader;

tl_byte_reader tl_byte_reader_make(const void *bytes, uint64_t size);
uint8_t tl_read_u8(tl_byte_reader *reader);
uint16_t tl_read_u16(tl_byte_reader *reader);
uint32_t tl_read_u32(tl_byte_reader *reader);
uint64_t tl_read_u64(tl_byte_reader *reader);
float tl_read_f32(tl_byte_reader *reader);
/// A pointer to `size` bytes inside the input, or NULL when they are not all there.
const void *tl_read_bytes(tl_byte_reader *reader, uint64_t size);
void tl_read_skip(tl_byte_reader *reader, uint64_t size);

/// Whether `count` elements of `element_size` bytes at `offset` lie inside `size` bytes. No overflow for any arguments.
bool tl_range_fits(uint64_t offset, uint64_t count, uint64_t element_size, uint64_t size);

#endif
