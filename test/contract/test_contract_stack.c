// SPDX-License-Identifier: MIT
//
// The stack of every public function: 32 KB are promised. The good call of each entry of the contract's tables, on the
// painted stack of a thread, in an optimised build without sanitizers. What the entry itself keeps there counts too.
// Deeper inputs than the tables' have tests of their own: test_query_stack.c, test_bake_stack.c.

#define _DEFAULT_SOURCE // pthread_attr_setstack

#include "contract.h"
#include "painted_stack.h"

#include <stdio.h>

// contract_tables.inc is made by CMake: TABLE(mesh) for each file contract_mesh.c.
#define TABLE(name) extern const contract_entry CONTRACT_TABLE_##name[];
#include "contract_tables.inc"
#undef TABLE

static const contract_entry *const TABLES[] = {
#define TABLE(name) CONTRACT_TABLE_##name,
#include "contract_tables.inc"
#undef TABLE
};

enum { TABLE_COUNT = sizeof TABLES / sizeof *TABLES };

static void *run_nothing(void *user)
{
    (void)user;
    return NULL;
}

static void *run_good_call(void *user)
{
    const contract_entry *entry = user;
    const tl_host host = { NULL, NULL, NULL };
    tl_report report;
    contract_run run;
    memset(&report, 0, sizeof report);
    memset(&run, 0, sizeof run);
    run.what = CONTRACT_GOOD;
    run.host = &host;
    run.report = &report;
    run.wants_report = true;
    TEST_RESULT(entry->call(&run), TL_OK);
    return NULL;
}

static void every_function_fits_a_small_stack(void **state)
{
    (void)state;
#ifdef FRAMES_ARE_WIDER
    skip();
#endif
    (void)contract_level_get(); // made here, not on the thread
    const size_t base = painted_stack_used(run_nothing, NULL);
    size_t most = 0;
    uint32_t functions = 0;
    for (int t = 0; t < TABLE_COUNT; t++) {
        for (const contract_entry *entry = TABLES[t]; entry->function != NULL; entry++) {
            if (!(entry->cases & CONTRACT_BIT(GOOD))) {
                continue;
            }
            contract_entry copy = *entry;
            const size_t used = painted_stack_used(run_good_call, &copy) - base;
            functions++;
            if (used > most) {
                most = used;
                printf("%-32s %6zu bytes\n", entry->function, used);
            }
            if (used > PROMISED_STACK) {
                fail_msg("%s takes %zu bytes of stack", entry->function, used);
            }
        }
    }
    TEST_CHECK(functions > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_fits_a_small_stack),
    };
    return cmocka_run_group_tests_name("stack of every function", tests, NULL, NULL);
}
