// SPDX-License-Identifier: MIT
//
// Text to float against strtof, which glibc rounds correctly.

#include "talus_test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/text/parse_float.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// Both readers and strtof (the program's locale is "C") must agree on the bits and on where the number ends.
static float check_text(const char *text)
{
    char padded[4096 + TL_PARSE_PADDING] = { 0 };
    size_t size = strlen(text);
    TEST_CHECK(size < 4000);
    memcpy(padded, text, size);
    padded[size] = '\n';

    char *expected_end;
    float expected = strtof(text, &expected_end);
    float exact = -1.0f;
    const char *end = tl_parse_float(text, text + size, &exact);
    float fast = -1.0f;
    const char *fast_end = tl_parse_float_padded(padded, padded + size + 1, &fast);
    if (expected_end == text) {
        TEST_CHECK(end == NULL && fast_end == NULL && exact == -1.0f && fast == -1.0f);
        return 0.0f;
    }
    if (end != expected_end || bits_of(exact) != bits_of(expected)) {
        fail_msg("'%s': %a, strtof says %a", text, (double)exact, (double)expected);
    }
    if (fast_end - padded != expected_end - text || bits_of(fast) != bits_of(expected)) {
        fail_msg("'%s' padded: %a, strtof says %a", text, (double)fast, (double)expected);
    }
    return exact;
}

static void test_forms(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "0",
        "-0",
        "+0",
        "0.0",
        ".5",
        "5.",
        "-.5e1",
        "1e5",
        "1E5",
        "1e+5",
        "1e-5",
        "1e",
        "1e+",
        "1e-x",
        "1.5e3.7",
        "1.2.3",
        "--1",
        "+-1",
        "",
        "-",
        "+",
        ".",
        "-.",
        ".e5",
        "e5",
        "1 2",
        "12345678",
        "123456789",
        "1234567890123456789012345678901234567890",
        "0.14302844",
        "32.471557617",
        "-0.08156099999999999",
        "0.12345678901234567890",
        "1234567.8901234567",
        "00000000000000000000001.5",
        "0.00000000000000000000000000000000000000000000000000000000000001e62",
        "1e39",
        "-1e39",
        "1e400",
        "1e-400",
        "1e99999999999999999999",
        "1e-99999999999999999999",
        "0e99999999999999999999",
        "3.4028234663852886e38",
        "3.4028235677973366e38",
        "3.4028235677973365e38",
        "340282356779733661637539395458142568447.9999",
        "340282356779733661637539395458142568448",
        "1.17549435e-38",
        "1.17549421e-38",
        "1.4012984643248170e-45",
        "7.0064923216240853e-46",
        "7.0064923216240854e-46",
        "7.0064923216240862e-46",
        "1e-45",
        "1e-46",
        "16777217",
        "16777219",
        "16777217.0000001",
        "8388608.5",
        "8388609.5",
        "1,5",
        "1/2",
        "1;",
        "0.1\t",
        "9007199254740993",
        "18446744073709551616",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        check_text(texts[i]);
    }
    TEST_CHECK(check_text("16777217") == 16777216.0f && check_text("16777217.0000001") == 16777218.0f);
    float value = 2.0f;
    TEST_CHECK(tl_parse_float("inf", &"inf"[3], &value) == NULL && tl_parse_float("nan", &"nan"[3], &value) == NULL);
    const char *hexadecimal = "0x10";
    TEST_CHECK(tl_parse_float(hexadecimal, hexadecimal + 4, &value) == hexadecimal + 1 && value == 0.0f);
}

// The end is a wall: nothing behind it is read as part of the number.
static void test_every_prefix(void **state)
{
    (void)state;
    const char *text = "-123456789.0123456789e-12";
    for (size_t size = 0; size <= strlen(text); size++) {
        char *exact_size = malloc(size + 1);
        memcpy(exact_size, text, size);
        float value = 0.0f;
        const char *end = tl_parse_float(exact_size, exact_size + size, &value);
        exact_size[size] = '\0';
        char *expected_end;
        float expected = strtof(exact_size, &expected_end);
        TEST_CHECK(size < 2 ? end == NULL : end == expected_end && bits_of(value) == bits_of(expected));
        free(exact_size);
    }
}

// Random texts of many shapes.
static void test_random_texts(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t normal = 0;
    uint32_t subnormal = 0;
    uint32_t infinite = 0;
    uint32_t zero = 0;
    for (int i = 0; i < 1000000; i++) {
        char text[160];
        int at = 0;
        text[at] = '-';
        at += (int)test_random_below(&random, 2);
        uint32_t whole = test_random_below(&random, test_random_below(&random, 16) == 0 ? 60 : 8);
        uint32_t fraction = test_random_below(&random, test_random_below(&random, 16) == 0 ? 60 : 12);
        for (uint32_t k = 0; k < whole; k++) {
            text[at++] = (char)('0' + test_random_below(&random, 10));
        }
        text[at++] = '.';
        for (uint32_t k = 0; k < fraction; k++) {
            text[at++] = (char)('0' + test_random_below(&random, 10));
        }
        text[at] = '\0';
        if (test_random_below(&random, 3) == 0) {
            sprintf(text + at, "e%d", (int)test_random_below(&random, 120) - 65);
        }
        float value = fabsf(check_text(text));
        infinite += isinf(value) ? 1u : 0u;
        zero += value == 0.0f;
        subnormal += value > 0.0f && value < FLT_MIN;
        normal += value >= FLT_MIN && !isinf(value);
    }
    TEST_CHECK(normal > 500000 && subnormal > 5000 && infinite > 5000 && zero > 5000);
}

// Floats as others print them: 6 to 17 significant digits.
static void test_printed_floats(void **state)
{
    (void)state;
    test_random random = { 2 };
    for (int i = 0; i < 500000; i++) {
        float value = float_of((uint32_t)test_random_u64(&random));
        if (!isfinite(value)) {
            continue;
        }
        char text[64];
        sprintf(text, "%.*g", 6 + (int)test_random_below(&random, 12), (double)value);
        check_text(text);
        sprintf(text, "%.9g", (double)value);
        TEST_CHECK(bits_of(check_text(text)) == bits_of(value));
    }
}

// The middle of two neighbouring floats, written out exactly, and the texts just below and above it.
static void check_middle(uint32_t bits)
{
    double low = (double)float_of(bits);
    double high = bits + 1 == 0x7f800000u ? 0x1p128 : (double)float_of(bits + 1);
    char text[512];
    int length = sprintf(text, "%.150f", low * 0.5 + high * 0.5); // exact: a float's middle has 150 binary places
    float even = check_text(text);
    TEST_CHECK((bits_of(even) & 1u) == 0);
    memcpy(text + length, "0000000000000001", 17);
    TEST_CHECK(bits_of(check_text(text)) == bits + 1);
    // One less in the last place that is not 0.
    int last = length - 1;
    while (text[last] == '0' || text[last] == '.') {
        last--;
    }
    text[last]--;
    memcpy(text + length, "9999999999999999", 17);
    for (int i = last + 1; i < length; i++) {
        text[i] = text[i] == '.' ? '.' : '9';
    }
    TEST_CHECK(bits_of(check_text(text)) == bits);
    // As many digits as doubles are printed with: the fast path's double is the middle, the text is beside it.
    sprintf(text, "%.17e", low * 0.5 + high * 0.5);
    check_text(text);
    sprintf(text, "%.15e", low * 0.5 + high * 0.5);
    check_text(text);
}

static void test_middles(void **state)
{
    (void)state;
    test_random random = { 3 };
    static const uint32_t special[] = { 0,          1,          2,          0x7ffffe,   0x7fffff,
                                        0x800000,   0x800001,   0x3f7fffff, 0x3f800000, 0x4b7fffff,
                                        0x7f000000, 0x7effffff, 0x7f7ffffe, 0x7f7fffff };
    for (size_t i = 0; i < sizeof special / sizeof special[0]; i++) {
        check_middle(special[i]);
    }
    for (int i = 0; i < 40000; i++) {
        check_middle(test_random_below(&random, 0x7f800000u));
    }
    for (int i = 0; i < 10000; i++) {
        check_middle(test_random_below(&random, 0x800000u)); // subnormal
    }
}

// Digits without end, as a hostile file has them.
static void test_long(void **state)
{
    (void)state;
    enum { SIZE = 300000 };
    char *text = calloc(SIZE, 1);
    float value = 0.0f;
    memset(text, '7', SIZE);
    TEST_CHECK(tl_parse_float(text, text + SIZE, &value) == text + SIZE && isinf(value));
    memcpy(text, "0.", 2);
    TEST_CHECK(tl_parse_float(text, text + SIZE, &value) == text + SIZE && value == 0.777777777777777777777f);
    // 1 behind 299,000 zeros, brought back by the exponent.
    memset(text + 2, '0', SIZE - 2);
    memcpy(text + SIZE - 12, "1e299990", 8);
    TEST_CHECK(tl_parse_float(text, text + SIZE - 4, &value) == text + SIZE - 4 && value == 1e3f);
    // A middle, made larger by a digit 300,000 places behind the point.
    memset(text, '0', SIZE);
    memcpy(text, "16777217.", 9);
    TEST_CHECK(tl_parse_float(text, text + SIZE, &value) != NULL && value == 16777216.0f);
    text[SIZE - 1] = '1';
    TEST_CHECK(tl_parse_float(text, text + SIZE, &value) != NULL && value == 16777218.0f);
    free(text);
}

static void test_digit_words(void **state)
{
    (void)state;
    for (unsigned count = 0; count <= 8; count++) {
        for (int other = 0; other < 256; other++) {
            if (other >= '0' && other <= '9') {
                continue;
            }
            char text[8] = { '9', '8', '7', '6', '5', '4', '3', '9' };
            if (count < 8) {
                memset(text + count, other, 8 - count);
            }
            uint64_t bytes = tl_load_text8(text);
            uint32_t expected = 0;
            for (unsigned k = 0; k < count; k++) {
                expected = expected * 10 + (uint32_t)(text[k] - '0');
            }
            TEST_CHECK(tl_digit_count8(bytes) == count && tl_digits_value8(bytes, count) == expected);
        }
    }
}

// As doubles: strtod's value, or at most 2 units in the last place beside it.
static void test_doubles(void **state)
{
    (void)state;
    static const char *const texts[] = { "0",          "-0.5",  "4649000.123456", "500000.1", "123456789012345678901.5",
                                         "1e22",       "1e-22", "-3.25e40",       "7e-30",    "0.000001",
                                         "5000020000", "1e300", "-1e999",         "1e-400",   "+17.25x" };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        double value = -1.0;
        const char *end = tl_parse_double(texts[i], texts[i] + strlen(texts[i]), &value);
        char *expected_end;
        const double expected = strtod(texts[i], &expected_end);
        TEST_CHECK(end == expected_end);
        TEST_CHECK(value == expected || fabs(value - expected) <= 4.5e-16 * fabs(expected) ||
                   (fabs(expected) < 1e-46 && value == 0.0));
    }
    uint64_t seed = 7;
    for (int i = 0; i < 100000; i++) {
        char text[64];
        seed = seed * UINT64_C(6364136223846793005) + 1442695040888963407u;
        const double written = (double)(int64_t)(seed >> 20) / 8192.0 * (i % 2 == 0 ? 1.0 : -1.0);
        snprintf(text, sizeof text, "%.*f", i % 10, written);
        double value = 0.0;
        TEST_CHECK(tl_parse_double(text, text + strlen(text), &value) != NULL);
        TEST_CHECK(fabs(value - strtod(text, NULL)) <= 4.5e-16 * fabs(value));
    }
    double untouched = 3.0;
    const char none[] = "x";
    TEST_CHECK(tl_parse_double(none, none + 1, &untouched) == NULL && untouched == 3.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_doubles),      cmocka_unit_test(test_forms),          cmocka_unit_test(test_every_prefix),
        cmocka_unit_test(test_random_texts), cmocka_unit_test(test_printed_floats), cmocka_unit_test(test_middles),
        cmocka_unit_test(test_long),         cmocka_unit_test(test_digit_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
