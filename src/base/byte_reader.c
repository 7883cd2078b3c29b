// SPDX-License-Identifier: MIT
//
// Bounded reads from untrusted bytes.

#include "base/byte_reader.h"

#include <string.h>

tl_byte_reader tl_byte_reader_make(const void *bytes, uint64_t size)
{
    tl_byte_reader reader = { bytes, size, 0, false };
    return reader;
}

const void *tl_read_bytes(tl_byte_reader *reader, uint64_t size)
{
    if (reader->failed || size > reader->size - reader->offset) {
        reader->failed = true;
        return NULL;
    }
    const uint8_t *start = reader->bytes + reader->offset;
    reader->offset += size;
    return start;
}

void tl_read_skip(tl_byte_reader *reader, uint64_t size)
{
    (void)tl_read_bytes(reader, size);
}

// Bytes are assembled one by one: no alignment is needed, and every byte order of the host is right.
static uint64_t read_little_endian(tl_byte_reader *reader, uint32_t size)
{
    const uint8_t *bytes = tl_read_bytes(reader, size);
    uint64_t value = 0;
    for (uint32_t i = 0; bytes != NULL && i < size; i++) {
        value |= (uint64_t)bytes[i] << (8 * i);
    }
    return value;
}

uint8_t tl_read_u8(tl_byte_reader *reader)
{
    return (uint8_t)read_little_endian(reader, 1);
}

uint16_t tl_read_u16(tl_byte_reader *reader)
{
    return (uint16_t)read_little_endian(reader, 2);
}

uint32_t tl_read_u32(tl_byte_reader *reader)
{
    return (uint32_t)read_little_endian(reader, 4);
}

uint64_t tl_read_u64(tl_byte_reader *reader)
{
    return read_little_endian(reader, 8);
}

float tl_read_f32(tl_byte_reader *reader)
{
    uint32_t bits = tl_read_u32(reader);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

bool tl_range_fits(uint64_t offset, uint64_t count, uint64_t element_size, uint64_t size)
{
    if (offset > size) {
        return false;
    }
    return element_size == 0 || count <= (size - offset) / element_size;
}
