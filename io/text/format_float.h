// SPDX-License-Identifier: MIT
//
// A float to the fewest decimal digits that read back as the same float.
//
// For 1, 2, ... 9 digits the nearest decimal is made by one double product and read back by tl_parse_float; the first
// one that gives the same bits is taken. Nine digits always do (Steele and White, How to Print Floating-Point Numbers
// Accurately, 1990), and reading back is exact, so a rounding of that product can cost a digit but never a wrong value.
// printf is no substitute: its point follows the locale, and %.9g writes 0.1f as 0.100000001.

#ifndef TALUS_IO_FORMAT_FLOAT_H
#define TALUS_IO_FORMAT_FLOAT_H

#include <stddef.h>

/// Longest text with its terminator: sign, nine digits, point, and up to sixteen zeros or an exponent.
#define TL_FLOAT_TEXT_BYTES 32

/// Writes `value` into `text` with a terminator and returns the length. Plain notation for magnitudes from 1e-5 up to
/// 1e16, else `d.ddde-XX`. Negative zero keeps its sign. Not finite: "nan", "inf", "-inf".
size_t tl_format_float(float value, char text[TL_FLOAT_TEXT_BYTES]);

#endif
