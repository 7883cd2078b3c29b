// SPDX-License-Identifier: MIT
//
// Floats to short text, by trying digit counts.

#include "io/text/format_float.h"

#include "io/text/parse_float.h"

#include <assert.h>
#include <math.h>

enum {
    MAX_DIGITS = 9,
    PLAIN_MIN = -5, // exponents of the leading digit that are written without "e"
    PLAIN_MAX = 15,
};

// Exponent of the leading digit of value > 0, as a double holds it.
static int leading_exponent(double value)
{
    int exponent = -45; // the smallest float is 1.4e-45
    int step = 64;
    // Binary search for the largest power of ten that is not above the value; FLT_MAX is below 10^39.
    for (; step > 0; step /= 2) {
        int trial = exponent + step;
        if (trial <= TL_DECIMAL_MAX_EXPONENT && tl_decimal_powers[trial - TL_DECIMAL_MIN_EXPONENT] <= value) {
            exponent = trial;
        }
    }
    return exponent;
}

// The shortest significand whose decimal reads back as `value` > 0; it times 10^(*exponent10).
static uint32_t shortest(float value, int *exponent10)
{
    int leading = leading_exponent((double)value);
    for (int digits = 1;; digits++) {
        int scale = digits - 1 - leading; // at most 8 + 45
        double scaled = (double)value * tl_decimal_powers[scale - TL_DECIMAL_MIN_EXPONENT];
        uint32_t significand = (uint32_t)(scaled + 0.5);
        float back;
        if (!tl_decimal_to_float_fast(significand, -scale, &back)) {
            back = tl_decimal_to_float(significand, -scale);
        }
        if (back == value) {
            *exponent10 = -scale;
            return significand;
        }
        assert(digits < MAX_DIGITS);
    }
}

static size_t write_digits(uint32_t significand, char *digits)
{
    char reversed[10];
    size_t count = 0;
    for (; significand > 0; significand /= 10) {
        reversed[count++] = (char)('0' + significand % 10);
    }
    for (size_t i = 0; i < count; i++) {
        digits[i] = reversed[count - 1 - i];
    }
    return count;
}

static char *write_word(char *at, const char *text)
{
    size_t length = strlen(text);
    memcpy(at, text, length);
    return at + length;
}

static char *write_plain(char *at, const char *digits, int count, int leading)
{
    if (leading < 0) {
        at = write_word(at, "0.");
        for (int i = -1; i > leading; i--) {
            *at++ = '0';
        }
    }
    for (int i = 0; i < count; i++) {
        *at++ = digits[i];
        if (i == leading && i + 1 < count) {
            *at++ = '.';
        }
    }
    for (int i = count; i <= leading; i++) {
        *at++ = '0';
    }
    return at;
}

static char *write_scientific(char *at, const char *digits, int count, int leading)
{
    *at++ = digits[0];
    if (count > 1) {
        *at++ = '.';
        memcpy(at, digits + 1, (size_t)count - 1);
        at += count - 1;
    }
    *at++ = 'e';
    *at++ = leading < 0 ? '-' : '+';
    unsigned magnitude = leading < 0 ? (unsigned)-leading : (unsigned)leading;
    *at++ = (char)('0' + magnitude / 10);
    *at++ = (char)('0' + magnitude % 10);
    return at;
}

size_t tl_format_float(float value, char text[TL_FLOAT_TEXT_BYTES])
{
    char *at = text;
    if (signbit(value) && !isnan(value)) {
        *at++ = '-';
        value = -value;
    }
    if (!isfinite(value)) {
        at = write_word(at, isnan(value) ? "nan" : "inf");
    } else if (value == 0.0f) {
        *at++ = '0';
    } else {
        int exponent10;
        char digits[10];
        uint32_t significand = shortest(value, &exponent10);
        int count = (int)write_digits(significand, digits);
        int leading = count - 1 + exponent10;
        while (count > 1 && digits[count - 1] == '0') { // rounded up to the next power of ten
            count--;
        }
        at = leading >= PLAIN_MIN && leading <= PLAIN_MAX ? write_plain(at, digits, count, leading)
                                                          : write_scientific(at, digits, count, leading);
    }
    *at = '\0';
    return (size_t)(at - text);
}
