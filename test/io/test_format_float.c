// SPDX-License-Identifier: MIT
//
// Floats to text: what is written reads back, and no shorter text would.

#include "talus_test.h"

#include "io/text/format_float.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

static void check_text(float value, const char *expected)
{
    char text[TL_FLOAT_TEXT_BYTES];
    size_t length = tl_format_float(value, text);
    TEST_CHECK(length == strlen(text));
    assert_string_equal(text, expected);
}

static void test_examples(void **state)
{
    (void)state;
    check_text(0.0f, "0");
    check_text(-0.0f, "-0");
    check_text(1.0f, "1");
    check_text(-1.5f, "-1.5");
    check_text(0.1f, "0.1");
    check_text(100.0f, "100");
    check_text(123456.789f, "123456.79");
    check_text(0.00001f, "0.00001");
    check_text(0.00000999f, "9.99e-06");
    check_text(16777216.0f, "16777216");
    check_text(1e15f, "1000000000000000");
    check_text(1e16f, "1e+16");
    check_text(9.9999999e9f, "10000000000");
    check_text(FLT_MAX, "3.4028235e+38");
    check_text(FLT_MIN, "1.1754944e-38");
    check_text(FLT_TRUE_MIN, "1e-45");
    check_text(INFINITY, "inf");
    check_text(-INFINITY, "-inf");
    check_text(NAN, "nan");
}

// printf with fewer digits must not read back; counted so that short and long texts both occur.
static void test_round_trip(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t by_digits[10] = { 0 };
    for (int i = 0; i < 300000; i++) {
        uint32_t bits = (uint32_t)test_random_u64(&random);
        float value;
        memcpy(&value, &bits, sizeof value);
        if (i % 4 == 0) {
            value = (float)((int)test_random_below(&random, 2000000) - 1000000) / 1000.0f;
        }
        if (!isfinite(value) || value == 0.0f) {
            continue;
        }
        char text[TL_FLOAT_TEXT_BYTES];
        tl_format_float(value, text);
        TEST_CHECK(strtof(text, NULL) == value);
        int digits = 0;
        for (char other[64]; digits < 9;) {
            sprintf(other, "%.*e", digits, (double)value);
            digits++;
            if (strtof(other, NULL) == value) {
                break;
            }
        }
        by_digits[digits]++;
        char shortest[64];
        sprintf(shortest, "%.*e", digits - 1, (double)value);
        uint32_t written = 0;
        bool leading = true;
        uint32_t zeros = 0;
        for (const char *at = text; *at != '\0' && *at != 'e'; at++) {
            leading = leading && (*at == '0' || *at == '.' || *at == '-');
            if (!leading && *at != '.') {
                zeros = *at == '0' ? zeros + 1 : 0;
                written++;
            }
        }
        TEST_CHECK(written - zeros <= (uint32_t)digits);
    }
    TEST_CHECK(by_digits[9] > 1000 && by_digits[8] > 10000 && by_digits[7] > 10000 && by_digits[5] > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_examples),
        cmocka_unit_test(test_round_trip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
