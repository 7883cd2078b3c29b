// SPDX-License-Identifier: MIT
//
// Values packed in runs: written and read as a whole, or a part of them read.

#ifndef TALUS_SRC_NAV_OBSTACLES_PACKED_RUNS_H
#define TALUS_SRC_NAV_OBSTACLES_PACKED_RUNS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Some values of one or two bytes, one after the other.
typedef struct tl_value_array {
    const uint8_t *bytes;
    size_t size; ///< of a value, bytes
    uint64_t count;
} tl_value_array;

/// Room that the values never need more than.
uint64_t tl_packed_runs_most_bytes(const tl_value_array *values);
/// Writes the values, for which there is room; returns the end of what was written.
uint8_t *tl_packed_runs_write(const tl_value_array *values, uint8_t *to);
/// Reads `count` values; returns the end of what was read.
const uint8_t *tl_packed_runs_read(const uint8_t *from, size_t size, uint64_t count, void *to);

/// A place among packed values. It is not moved beyond the last of them.
typedef struct tl_run_reader {
    const uint8_t *from;
    uint32_t size; ///< of a value, bytes
    uint32_t left; ///< values of the run at hand
    bool same;     ///< they are one
} tl_run_reader;

tl_run_reader tl_run_reader_make(const uint8_t *from, uint32_t size);
void tl_run_reader_skip(tl_run_reader *reader, uint64_t count);
void tl_run_reader_read(tl_run_reader *reader, uint64_t count, void *to);
/// Passes over values of two bytes; returns their sum.
uint64_t tl_run_reader_sum(tl_run_reader *reader, uint64_t count);

#endif
