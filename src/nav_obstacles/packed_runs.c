// SPDX-License-Identifier: MIT
//
// Source: PackBits (Apple, 1984): runs of one value and runs of different ones.
//
// What is not asked for is passed over a run at a time.

#include "nav_obstacles/packed_runs.h"

#include <string.h>

enum {
    MAX_PACKED_LITERALS = 128, // control bytes 0 .. 127: so many values and one more
    MIN_PACKED_RUN = 3,        // control bytes 128 .. 255: a value that stands MIN_PACKED_RUN and more times
    MAX_PACKED_RUN = 127 + MIN_PACKED_RUN
};

uint64_t tl_packed_runs_most_bytes(const tl_value_array *values)
{
    return values->count * values->size + values->count / MAX_PACKED_LITERALS + 1;
}

static bool are_equal(const tl_value_array *values, uint64_t a, uint64_t b)
{
    return memcmp(values->bytes + a * values->size, values->bytes + b * values->size, values->size) == 0;
}

static uint64_t run_length(const tl_value_array *values, uint64_t first)
{
    uint64_t end = first + 1;
    while (end < values->count && end - first < MAX_PACKED_RUN && are_equal(values, first, end)) {
        end++;
    }
    return end - first;
}

uint8_t *tl_packed_runs_write(const tl_value_array *values, uint8_t *to)
{
    for (uint64_t i = 0; i < values->count;) {
        uint64_t run = run_length(values, i);
        if (run >= MIN_PACKED_RUN) {
            *to++ = (uint8_t)(128 + run - MIN_PACKED_RUN);
            memcpy(to, values->bytes + i * values->size, values->size);
            to += values->size;
            i += run;
            continue;
        }
        uint64_t end = i + run; // up to the next run
        while (end < values->count && end - i < MAX_PACKED_LITERALS &&
               (run = run_length(values, end)) < MIN_PACKED_RUN) {
            end += run;
        }
        const uint64_t literals = end - i < MAX_PACKED_LITERALS ? end - i : MAX_PACKED_LITERALS;
        *to++ = (uint8_t)(literals - 1);
        memcpy(to, values->bytes + i * values->size, (size_t)literals * values->size);
        to += literals * values->size;
        i += literals;
    }
    return to;
}

// ---- Reading -----------------------------------------------------------------------------------------------

// A value of one or two bytes, so many times.
static inline void repeat_value(const uint8_t *value, size_t size, uint32_t count, uint8_t *to)
{
    if (size == 1) {
        memset(to, *value, count);
        return;
    }
    for (uint32_t k = 0; k < count; k++) {
        memcpy(to + 2 * (size_t)k, value, 2);
    }
}

// All at once, in less time than by a reader.
const uint8_t *tl_packed_runs_read(const uint8_t *from, size_t size, uint64_t count, void *to)
{
    uint8_t *next = (uint8_t *)to;
    const uint8_t *end = next + count * size;
    while (next < end) {
        const uint32_t control = *from++;
        if (control < 128) {
            const size_t bytes = (control + 1) * size;
            memcpy(next, from, bytes);
            from += bytes;
            next += bytes;
            continue;
        }
        const uint32_t run = control - 128 + MIN_PACKED_RUN;
        repeat_value(from, size, run, next);
        from += size;
        next += run * size;
    }
    return from;
}

tl_run_reader tl_run_reader_make(const uint8_t *from, uint32_t size)
{
    const tl_run_reader reader = { from, size, 0, false };
    return reader;
}

// How many of the next values, at most `most` > 0, stand in one run; they are at reader->from.
static inline uint32_t next_values(tl_run_reader *reader, uint64_t most)
{
    if (reader->left == 0) {
        const uint32_t control = *reader->from++;
        reader->same = control >= 128;
        reader->left = reader->same ? control - 128 + MIN_PACKED_RUN : control + 1;
    }
    return reader->left < most ? reader->left : (uint32_t)most;
}

static inline void pass_values(tl_run_reader *reader, uint32_t count)
{
    reader->left -= count;
    if (!reader->same) {
        reader->from += (size_t)count * reader->size;
    } else if (reader->left == 0) {
        reader->from += reader->size;
    }
}

void tl_run_reader_skip(tl_run_reader *reader, uint64_t count)
{
    while (count > 0) {
        const uint32_t values = next_values(reader, count);
        pass_values(reader, values);
        count -= values;
    }
}

void tl_run_reader_read(tl_run_reader *reader, uint64_t count, void *to)
{
    tl_run_reader at = *reader; // what is written to might be it, as far as a compiler knows
    uint8_t *next = (uint8_t *)to;
    while (count > 0) {
        const uint32_t values = next_values(&at, count);
        if (at.same) {
            repeat_value(at.from, at.size, values, next);
        } else {
            memcpy(next, at.from, (size_t)values * at.size);
        }
        pass_values(&at, values);
        next += (size_t)values * at.size;
        count -= values;
    }
    *reader = at;
}

uint64_t tl_run_reader_sum(tl_run_reader *reader, uint64_t count)
{
    uint64_t sum = 0;
    while (count > 0) {
        const uint32_t values = next_values(reader, count);
        for (uint32_t k = 0; k < (reader->same ? 1 : values); k++) {
            uint16_t value;
            memcpy(&value, reader->from + 2 * (size_t)k, sizeof value);
            sum += reader->same ? (uint64_t)values * value : value;
        }
        pass_values(reader, values);
        count -= values;
    }
    return sum;
}
