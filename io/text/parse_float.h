// SPDX-License-Identifier: MIT
//
// Decimal text to the nearest float: what strtof does in the C locale, without a locale, an end or a speed limit of its
// own.
//
// Idea: a double has 29 bits more than a float. The digits as an integer times a tabled power of ten gives a double
// that is at most 3 units in the last place off, whatever its three roundings do; rounded to a float that is the right
// answer unless it lies within 4 units of the middle between two floats (about one number in 6e7 that is not made to).
// Only then, and for subnormal and huge values, the digits are compared with that middle as big integers
// (parse_float.c). This needs no 128-bit table as Eisel-Lemire does (Lemire, Number Parsing at a Gigabyte per Second,
// 2021), and does not stop at 15 digits as Clinger's exact path does (How to Read Floating Point Numbers Accurately,
// 1990). Digits are taken eight at a time, without a branch on how many there are: number lengths change at random in
// mesh files, and a mispredicted branch costs more than all the arithmetic.

#ifndef TALUS_IO_PARSE_FLOAT_H
#define TALUS_IO_PARSE_FLOAT_H

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/// A number's text is `[+-] digits [. digits] [(e|E) [+-] digits]`, with a digit before or behind the point. An "e"
/// without digits does not belong to the number.
///
/// Reads the longest number that begins at `text` and ends before `end`. Returns where it ends, or NULL when there is
/// none; then `*value_out` is untouched. The value is the nearest float, ties to even; beyond FLT_MAX an infinity. No
/// length is too long. Words (inf, nan) and hexadecimal are no numbers.
const char *tl_parse_float(const char *text, const char *end, float *value_out);

/// The same as a double, at most 2 units in the last place off: for coordinates that an origin is subtracted from.
/// Below 1e-46 it may be 0.
const char *tl_parse_double(const char *text, const char *end, double *value_out);

/// significand * 10^exponent10 as the nearest float.
float tl_decimal_to_float(uint64_t significand, int exponent10);

/// Readable bytes that must follow a text for the padded readers. Their content does not matter.
#define TL_PARSE_PADDING 32

/// The parts, for the inline reader below and for format_float.c.
#define TL_DECIMAL_MIN_EXPONENT (-65)
#define TL_DECIMAL_MAX_EXPONENT 65
extern const double tl_decimal_powers[TL_DECIMAL_MAX_EXPONENT - TL_DECIMAL_MIN_EXPONENT + 1];

/// Distance from a middle between two floats, in units in the last place of a double, below which a product may round
/// to the wrong float. Significand, power and product are off by half a unit of their own each; carried into a result
/// that lies lowest in its binade a factor's unit counts double: at most 3 * 2 * 1/2 = 3 units. One more for the terms
/// of second order and for digits cut off behind the 19th (below 0.01 units).
#define TL_DECIMAL_DOUBT 4u

/// significand * 10^exponent10 as the nearest float in `*value_out`, or false when that is in doubt.
static inline bool tl_decimal_to_float_fast(uint64_t significand, int exponent10, float *value_out)
{
    if (exponent10 < TL_DECIMAL_MIN_EXPONENT || exponent10 > TL_DECIMAL_MAX_EXPONENT) {
        return false;
    }
    double value = (double)significand * tl_decimal_powers[exponent10 - TL_DECIMAL_MIN_EXPONENT];
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    // Zero, or a normal float below the last binade: [2^-126, 2^127).
    bool normal = bits == 0 || (bits - (UINT64_C(897) << 52) < (UINT64_C(253) << 52));
    uint64_t distance = (bits & 0x1fffffffu) - 0x10000000u + TL_DECIMAL_DOUBT;
    if (!normal || distance <= 2 * TL_DECIMAL_DOUBT) {
        return false;
    }
    *value_out = (float)value;
    return true;
}

/// Eight bytes as a little-endian number, on any machine: compilers make one load of it.
static inline uint64_t tl_load_text8(const char *text)
{
    const unsigned char *b = (const unsigned char *)text;
    return (uint64_t)b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 | (uint64_t)b[4] << 32 |
           (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 | (uint64_t)b[7] << 56;
}

/// How many of eight bytes, from the lowest, are digits: 0 to 8.
static inline unsigned tl_digit_count8(uint64_t bytes)
{
    uint64_t others = bytes ^ UINT64_C(0x3030303030303030); // a digit becomes 0 to 9
    // Adding 0x76 carries 10 to 127 into the top bit, and nothing beyond it: the lowest set bit is exact.
    uint64_t marks = ((others & UINT64_C(0x7f7f7f7f7f7f7f7f)) + UINT64_C(0x7676767676767676)) | others;
    marks &= UINT64_C(0x8080808080808080);
#if defined(__GNUC__)
    return marks != 0 ? (unsigned)__builtin_ctzll(marks) >> 3 : 8u;
#else
    unsigned count = 0;
    while (count < 8 && (marks >> (8 * count + 7) & 1u) == 0) {
        count++;
    }
    return count;
#endif
}

/// The number that the lowest `count` bytes spell, which must be digits; 0 to 8.
static inline uint32_t tl_digits_value8(uint64_t bytes, unsigned count)
{
    // Moved up so that the last digit is in the highest byte; what comes in below counts as leading zeros. Two shifts,
    // because one by 64 is undefined.
    unsigned half = 32 - 4 * count;
    bytes = (bytes & UINT64_C(0x0f0f0f0f0f0f0f0f)) << half << half;
    bytes = bytes * 10 + (bytes >> 8); // pairs, in bytes 0, 2, 4, 6
    return (uint32_t)((((bytes & UINT64_C(0x000000ff000000ff)) * UINT64_C(0x000f424000000064)) +
                       ((bytes >> 16 & UINT64_C(0x000000ff000000ff)) * UINT64_C(0x0000271000000001))) >>
                      32);
}

/// tl_parse_float for text that TL_PARSE_PADDING readable bytes follow from `end` on, and whose last byte before `end`
/// is not part of a number (a line end).
static inline const char *tl_parse_float_padded(const char *text, const char *end, float *value_out)
{
    static const uint32_t powers[9] = { 1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000 };
    const char *at = text;
    bool negative = *at == '-';
    at += negative || *at == '+';
    uint64_t bytes = tl_load_text8(at);
    unsigned whole = tl_digit_count8(bytes);
    uint64_t significand = tl_digits_value8(bytes, whole);
    at += whole;
    unsigned fraction = 0;
    if (*at == '.') {
        bytes = tl_load_text8(at + 1);
        fraction = tl_digit_count8(bytes);
        significand = significand * powers[fraction] + tl_digits_value8(bytes, fraction);
        at += 1 + fraction;
        if (fraction == 8) {
            bytes = tl_load_text8(at);
            unsigned more = tl_digit_count8(bytes);
            if (more == 8 || whole + more > 11) { // 19 digits always fit
                return tl_parse_float(text, end, value_out);
            }
            significand = significand * powers[more] + tl_digits_value8(bytes, more);
            fraction += more;
            at += more;
        }
    }
    // Eight digits may go on before the point; that, an exponent and no digit at all are rare.
    float value;
    if (whole == 8 || whole + fraction == 0 || (*at | 0x20) == 'e' ||
        !tl_decimal_to_float_fast(significand, -(int)fraction, &value)) {
        return tl_parse_float(text, end, value_out);
    }
    *value_out = negative ? -value : value;
    return at;
}

#endif
