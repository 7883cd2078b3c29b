// SPDX-License-Identifier: MIT
//
// Offsets and counts from untrusted bytes are proven to fit before they are used.

#ifndef TALUS_SRC_BASE_RANGE_FITS_H
#define TALUS_SRC_BASE_RANGE_FITS_H

#include <stdbool.h>
#include <stdint.h>

/// Whether `count` elements of `element_size` bytes at `offset` lie within `size` bytes. Nothing overflows.
static inline bool tl_range_fits(uint64_t offset, uint64_t count, uint64_t element_size, uint64_t size)
{
    return offset <= size && (element_size == 0 || count <= (size - offset) / element_size);
}

#endif
