// SPDX-License-Identifier: MIT
//
// Reading text in place without looking for its end: what the readers of text formats share.
//
// A text is read in two sections. The first lies where it is, ends behind a line end, and is followed by enough bytes
// of the second for reads of eight bytes at a time. The second is the text's last lines, copied to where line ends and
// padding follow. So in both a line end is the sentinel of every inner loop.

#ifndef TALUS_IO_TEXT_SCAN_H
#define TALUS_IO_TEXT_SCAN_H

#include "io/text/parse_float.h"

#include <stddef.h>

/// Line ends put behind the last section: one ends a last line, one more follows a last continuation.
#define TL_TEXT_LINE_ENDS 2

static inline bool tl_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static inline bool tl_is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

/// A mark in the top bit of each byte that equals `c`; the lowest mark is exact (Warren, Hacker's Delight, 6-1).
static inline uint64_t tl_match_byte(uint64_t bytes, char c)
{
    uint64_t others = bytes ^ (UINT64_C(0x0101010101010101) * (unsigned char)c);
    return (others - UINT64_C(0x0101010101010101)) & ~others & UINT64_C(0x8080808080808080);
}

/// The line end at or behind `at`. There must be one in the section.
static inline const char *tl_find_line_end(const char *at)
{
    for (;;) {
        uint64_t bytes = tl_load_text8(at);
        if ((tl_match_byte(bytes, '\n') | tl_match_byte(bytes, '\r')) != 0) {
            break;
        }
        at += 8;
    }
    while (!tl_is_line_end(*at)) {
        at++;
    }
    return at;
}

/// Bytes of the first section. It ends behind a line that is not continued by `\`, and TL_PARSE_PADDING bytes follow
/// it.
size_t tl_text_first_section(const char *text, size_t size);

/// Bytes of the block that tl_text_copy_last_section fills, for a last section of `size` bytes.
static inline size_t tl_text_last_section_block(size_t size)
{
    return size + TL_TEXT_LINE_ENDS + TL_PARSE_PADDING;
}

/// Copies the last section, puts line ends and padding behind it, and returns its size with the line ends.
size_t tl_text_copy_last_section(const char *text, size_t size, char *block);

#endif
