// SPDX-License-Identifier: MIT
//
// The head of a blob: each fault has its own name, and the first one wins.

#include "talus_test.h"

#include "base/blob_check.h"

#include <string.h>

enum { MAGIC = 0x31323334, VERSION = 3, MIN_SIZE = 128 };

static tl_result check(const tl_blob *blob, uint64_t size, tl_report *report)
{
    tl_blob expected;
    memset(&expected, 0, sizeof expected);
    expected.magic = MAGIC;
    expected.version = VERSION;
    expected.size = MIN_SIZE;
    return tl_blob_check_head(blob, size, expected, 16, report);
}

static void each_fault_has_a_name(void **state)
{
    (void)state;
    _Alignas(64) unsigned char bytes[256];
    memset(bytes, 0, sizeof bytes);
    tl_blob *blob = (tl_blob *)(void *)bytes;
    blob->magic = MAGIC;
    blob->version = VERSION;
    blob->size = 192;
    tl_report report;
    TEST_RESULT(check(blob, 192, &report), TL_OK);
    TEST_CHECK(report.element == NULL && strcmp(report.stage, "check") == 0);
    TEST_RESULT(check(blob, 256, NULL), TL_OK); // more may follow
    TEST_RESULT(check(blob, 191, &report), TL_ERR_TRUNCATED);
    TEST_CHECK(strcmp(report.element, "head") == 0 && report.advice != NULL);
    TEST_RESULT(check(blob, sizeof *blob - 1, NULL), TL_ERR_TRUNCATED);
    TEST_RESULT(check(NULL, 192, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(strcmp(report.field, "bytes") == 0);
    TEST_RESULT(check((const tl_blob *)(const void *)(bytes + 8), 192, NULL), TL_ERR_ARGUMENT);
    blob->size = MIN_SIZE - 1; // of itself too short, whatever follows
    TEST_RESULT(check(blob, MIN_SIZE - 1, NULL), TL_ERR_TRUNCATED);
    blob->version = VERSION + 1;
    TEST_RESULT(check(blob, 192, NULL), TL_ERR_VERSION);
    blob->magic++;
    TEST_RESULT(check(blob, 64, &report), TL_ERR_MAGIC); // before version and length
    TEST_CHECK(strcmp(report.element, "head") == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(each_fault_has_a_name) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
