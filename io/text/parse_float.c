// SPDX-License-Identifier: MIT
//
// Any decimal text to the nearest float; the exact comparison with the middle between two floats.
//
// When the fast product is in doubt, the candidates are the float below it and the next one. The text is compared with
// their middle m = (2 M + 1) * 2^q: digits * 10^e against it, all powers brought to the side where they are integers.
// Digits behind the 128th cannot matter but by being there: a middle between floats has at most 113 significant digits,
// so one digit 1 stands for all of them.

#include "io/text/parse_float.h"

#include <assert.h>
#include <stddef.h>

enum {
    FAST_DIGITS = 19,    // what a uint64_t always holds
    EXACT_DIGITS = 128,  // kept for the comparison, and one more for the rest
    LIMBS = 32,          // see compare_with_middle
    LEADING_LIMIT = 40,  // 10^39 > FLT_MAX
    TRAILING_LIMIT = -46 // 10^-46 < 2^-150, half of the smallest float
};

const double tl_decimal_powers[TL_DECIMAL_MAX_EXPONENT - TL_DECIMAL_MIN_EXPONENT + 1] = {
    1e-65, 1e-64, 1e-63, 1e-62, 1e-61, 1e-60, 1e-59, 1e-58, 1e-57, 1e-56, 1e-55, 1e-54, 1e-53, 1e-52, 1e-51,
    1e-50, 1e-49, 1e-48, 1e-47, 1e-46, 1e-45, 1e-44, 1e-43, 1e-42, 1e-41, 1e-40, 1e-39, 1e-38, 1e-37, 1e-36,
    1e-35, 1e-34, 1e-33, 1e-32, 1e-31, 1e-30, 1e-29, 1e-28, 1e-27, 1e-26, 1e-25, 1e-24, 1e-23, 1e-22, 1e-21,
    1e-20, 1e-19, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-11, 1e-10, 1e-9,  1e-8,  1e-7,  1e-6,
    1e-5,  1e-4,  1e-3,  1e-2,  1e-1,  1e0,   1e1,   1e2,   1e3,   1e4,   1e5,   1e6,   1e7,   1e8,   1e9,
    1e10,  1e11,  1e12,  1e13,  1e14,  1e15,  1e16,  1e17,  1e18,  1e19,  1e20,  1e21,  1e22,  1e23,  1e24,
    1e25,  1e26,  1e27,  1e28,  1e29,  1e30,  1e31,  1e32,  1e33,  1e34,  1e35,  1e36,  1e37,  1e38,  1e39,
    1e40,  1e41,  1e42,  1e43,  1e44,  1e45,  1e46,  1e47,  1e48,  1e49,  1e50,  1e51,  1e52,  1e53,  1e54,
    1e55,  1e56,  1e57,  1e58,  1e59,  1e60,  1e61,  1e62,  1e63,  1e64,  1e65,
};

// A number's text, taken apart.
typedef struct decimal {
    bool negative;
    uint64_t significand; // the first FAST_DIGITS digits behind leading zeros
    unsigned taken;       // how many those are
    int64_t exponent10;   // of the significand
    const char *digits;   // the first digit that is not 0, or NULL; the point may be among the following ones
    const char *digits_end;
} decimal;

// A non-negative integer, little-endian.
typedef struct big {
    uint32_t limbs[LIMBS];
    unsigned count;
} big;

static void big_multiply_add(big *number, uint32_t factor, uint32_t addend)
{
    uint64_t carry = addend;
    for (unsigned i = 0; i < number->count; i++) {
        carry += (uint64_t)number->limbs[i] * factor;
        number->limbs[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry != 0) {
        assert(number->count < LIMBS);
        number->limbs[number->count++] = (uint32_t)carry;
    }
}

static void big_multiply_power5(big *number, unsigned exponent)
{
    for (; exponent >= 13; exponent -= 13) {
        big_multiply_add(number, 1220703125u, 0); // 5^13
    }
    for (; exponent > 0; exponent--) {
        big_multiply_add(number, 5, 0);
    }
}

static void big_shift_left(big *number, unsigned bits)
{
    if (bits % 32 != 0) {
        big_multiply_add(number, UINT32_C(1) << bits % 32, 0);
    }
    unsigned limbs = bits / 32;
    assert(number->count + limbs <= LIMBS);
    memmove(number->limbs + limbs, number->limbs, number->count * sizeof number->limbs[0]);
    memset(number->limbs, 0, limbs * sizeof number->limbs[0]);
    number->count += limbs;
}

static int big_compare(const big *a, const big *b)
{
    if (a->count != b->count) {
        return a->count < b->count ? -1 : 1;
    }
    for (unsigned i = a->count; i-- > 0;) {
        if (a->limbs[i] != b->limbs[i]) {
            return a->limbs[i] < b->limbs[i] ? -1 : 1;
        }
    }
    return 0;
}

// The first EXACT_DIGITS digits as an integer, and a digit 1 for any that follow and are not all 0. Returns how many
// digits were taken in, so the number is value * 10^(exponent of the first digit + 1 - taken).
static unsigned big_from_digits(big *number, const decimal *source)
{
    unsigned taken = 0;
    number->count = 0;
    for (const char *at = source->digits; at < source->digits_end; at++) {
        if (*at == '.') {
            continue;
        }
        if (taken < EXACT_DIGITS) {
            big_multiply_add(number, 10, (uint32_t)(*at - '0'));
            taken++;
        } else if (*at != '0') {
            big_multiply_add(number, 10, 1);
            return taken + 1;
        }
    }
    return taken;
}

// The sign of (the decimal - middle * 2^middle_exponent), middle odd and below 2^25.
//
// Room: the decimal is below 10^129 before scaling (429 bits), and the power of ten lies in [-174, 38] because it is
// between 10^-46 and 10^39. middle_exponent lies in [-150, 103]. So of the powers of two, one side is shifted by
// at most 150 + 39 = 189 (left side) or 103 + 174 = 277 (right). Left: 429 + 91 + 189 = 709 bits, right: 25 + 405 + 277
// = 707 bits, both below 32 * 32 = 1024.
static int compare_with_middle(const decimal *source, uint32_t middle, int middle_exponent)
{
    big left;
    big right = { { middle }, 1 };
    unsigned taken = big_from_digits(&left, source);
    int exponent10 = (int)(source->exponent10 + (int64_t)source->taken) - (int)taken;
    if (exponent10 >= 0) {
        big_multiply_power5(&left, (unsigned)exponent10);
    } else {
        big_multiply_power5(&right, (unsigned)-exponent10);
    }
    int shift = exponent10 - middle_exponent;
    if (shift >= 0) {
        big_shift_left(&left, (unsigned)shift);
    } else {
        big_shift_left(&right, (unsigned)-shift);
    }
    return big_compare(&left, &right);
}

// The nearest float of a positive number whose leading digit lies within the limits.
static float round_exactly(const decimal *source)
{
    double estimate = (double)source->significand * tl_decimal_powers[source->exponent10 - TL_DECIMAL_MIN_EXPONENT];
    uint64_t bits;
    memcpy(&bits, &estimate, sizeof bits);
    // The float below the estimate: 24 bits of its significand, fewer when that is subnormal. The right answer is this
    // float or the next, even if the estimate is on the wrong side of one of them.
    int exponent = (int)(bits >> 52) - 1023;
    uint64_t significand = (bits & ((UINT64_C(1) << 52) - 1)) | UINT64_C(1) << 52;
    unsigned dropped = exponent < -126 ? (unsigned)(-126 - exponent) + 29u : 29u;
    uint32_t below = dropped < 64 ? (uint32_t)(significand >> dropped) : 0u;
    int unit = (exponent < -126 ? -126 : exponent) - 23; // a float here is a multiple of 2^unit
    if (unit > 104) {                                    // 2^128 and more: only FLT_MAX or infinity can be meant
        below = 0xffffffu;
        unit = 104;
    }
    int sign = compare_with_middle(source, 2 * below + 1, unit - 1);
    // The next float's bits are the next integer, also across binades, from subnormal to normal and on to infinity.
    uint32_t result = below < 0x800000u ? below : ((uint32_t)(unit + 150) << 23) + (below - 0x800000u);
    result += sign > 0 || (sign == 0 && (below & 1u) != 0);
    float value;
    memcpy(&value, &result, sizeof value);
    return value;
}

static float nearest(const decimal *source)
{
    int64_t leading = source->exponent10 + (int64_t)source->taken; // the number is below 10^leading
    float value = 0.0f;
    if (source->taken == 0 || leading <= TRAILING_LIMIT) {
        return value;
    }
    if (leading >= LEADING_LIMIT) {
        const uint32_t infinity = 0x7f800000u;
        memcpy(&value, &infinity, sizeof value);
        return value;
    }
    if (!tl_decimal_to_float_fast(source->significand, (int)source->exponent10, &value)) {
        value = round_exactly(source);
    }
    return value;
}

float tl_decimal_to_float(uint64_t significand, int exponent10)
{
    char digits[20]; // of a uint64_t
    char *first = digits + sizeof digits;
    for (uint64_t rest = significand; rest > 0; rest /= 10) {
        *--first = (char)('0' + rest % 10);
    }
    size_t count = (size_t)(digits + sizeof digits - first);
    bool dropped = count > FAST_DIGITS;
    decimal source = { false,
                       dropped ? significand / 10 : significand,
                       dropped ? FAST_DIGITS : (unsigned)count,
                       (int64_t)exponent10 + dropped,
                       first,
                       digits + sizeof digits };
    return nearest(&source);
}

static bool is_digit(const char *at, const char *end)
{
    return at < end && *at >= '0' && *at <= '9';
}

// Digits from `at` on; `exponent_step` is what each adds to the exponent of the digits so far: 0 before the point, -1
// behind.
static const char *take_digits(const char *at, const char *end, int exponent_step, decimal *result)
{
    for (; is_digit(at, end); at++) {
        unsigned digit = (unsigned)(*at - '0');
        if (digit == 0 && result->taken == 0) {
            result->exponent10 += exponent_step;
            continue;
        }
        if (result->digits == NULL) {
            result->digits = at;
        }
        if (result->taken < FAST_DIGITS) {
            result->significand = result->significand * 10 + digit;
            result->taken++;
            result->exponent10 += exponent_step;
        } else {
            result->exponent10 += 1 + exponent_step;
        }
    }
    result->digits_end = at;
    return at;
}

// Returns `at` when no whole exponent stands there.
static const char *take_exponent(const char *at, const char *end, int64_t *exponent10)
{
    // A text's digits shift the point by less than its length, so an exponent cut here stays beyond all limits for any
    // text shorter than this, and memory is.
    const int64_t limit = INT64_C(1) << 60;
    const char *digit = at;
    if (digit == end || (*digit | 0x20) != 'e') {
        return at;
    }
    digit++;
    bool negative = digit < end && *digit == '-';
    digit += digit < end && (negative || *digit == '+');
    if (!is_digit(digit, end)) {
        return at;
    }
    int64_t exponent = 0;
    for (; is_digit(digit, end); digit++) {
        exponent = exponent < limit / 10 ? exponent * 10 + (*digit - '0') : limit;
    }
    *exponent10 += negative ? -exponent : exponent;
    return digit;
}

// NULL: there is no number.
static const char *read_decimal(const char *text, const char *end, decimal *source)
{
    const char *at = text;
    source->negative = at < end && *at == '-';
    at += at < end && (*at == '-' || *at == '+');
    const char *first = at;
    at = take_digits(at, end, 0, source);
    bool any = at > first;
    if (at < end && *at == '.') {
        const char *fraction = at + 1;
        const char *last = is_digit(fraction, end) ? take_digits(fraction, end, -1, source) : fraction;
        any = any || last > fraction;
        at = last;
    }
    if (!any) {
        return NULL;
    }
    return take_exponent(at, end, &source->exponent10);
}

const char *tl_parse_float(const char *text, const char *end, float *value_out)
{
    decimal source = { false, 0, 0, 0, NULL, NULL };
    const char *at = read_decimal(text, end, &source);
    if (at != NULL) {
        const float value = nearest(&source);
        *value_out = source.negative ? -value : value;
    }
    return at;
}

const char *tl_parse_double(const char *text, const char *end, double *value_out)
{
    decimal source = { false, 0, 0, 0, NULL, NULL };
    const char *at = read_decimal(text, end, &source);
    if (at == NULL) {
        return NULL;
    }
    // Far beyond the floats both ways: what is left is an infinity or 0.
    int64_t exponent = source.exponent10;
    double value = (double)source.significand;
    for (int step = 0; step < 8 && exponent > TL_DECIMAL_MAX_EXPONENT; ++step) {
        value *= tl_decimal_powers[TL_DECIMAL_MAX_EXPONENT - TL_DECIMAL_MIN_EXPONENT];
        exponent -= TL_DECIMAL_MAX_EXPONENT;
    }
    if (exponent < TL_DECIMAL_MIN_EXPONENT) {
        value = 0.0;
    } else {
        // A table's power below 1 is rounded, one from 1 to 1e22 is exact: dividing by that is better.
        const int power = exponent > TL_DECIMAL_MAX_EXPONENT ? TL_DECIMAL_MAX_EXPONENT : (int)exponent;
        value = power < 0 && power >= -22 ? value / tl_decimal_powers[-power - TL_DECIMAL_MIN_EXPONENT]
                                          : value * tl_decimal_powers[power - TL_DECIMAL_MIN_EXPONENT];
    }
    *value_out = source.negative ? -value : value;
    return at;
}
