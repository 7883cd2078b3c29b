// SPDX-License-Identifier: MIT
//
// The one contract of the API, over all functions of all headers: NULL defs, zeroed defs, fields named, capacities,
// allocators, reports, quaternions, statuses. contract.h says what each case is.

#include "contract.h"

#include <stdio.h>
#include <string.h>

// contract_tables.inc is made by CMake: TABLE(mesh) for each file contract_mesh.c.
#define TABLE(name) extern const contract_entry CONTRACT_TABLE_##name[];
#include "contract_tables.inc"
#undef TABLE

typedef struct contract_table {
    const char *name;
    const contract_entry *entries;
} contract_table;

static const contract_table TABLES[] = {
#define TABLE(name) { #name, CONTRACT_TABLE_##name },
#include "contract_tables.inc"
#undef TABLE
};

enum { TABLE_COUNT = sizeof TABLES / sizeof *TABLES };

static const char *const CASE_NAMES[CONTRACT_CASE_COUNT] = {
    "good",       "null report", "null def",  "zeroed def",   "zeroed filter", "bad field",
    "null input", "null output", "no buffer", "short buffer", "not found",     "stale",
    "no nodes",   "bad bytes",   "no memory", "cancelled",    "zero rotation", "null free",
};

typedef struct progress_state {
    uint64_t calls;
    uint64_t stop_at; // the call that says stop; 0: none
} progress_state;

static bool update_progress(const char *stage, uint64_t done, uint64_t total, void *user)
{
    progress_state *state = (progress_state *)user;
    (void)stage;
    (void)done;
    (void)total;
    return ++state->calls != state->stop_at;
}

// One call, with what it took from its allocator counted.
typedef struct counted_call {
    contract_run run;
    tl_report report;
    test_allocator memory;
    progress_state progress;
    tl_result result;
} counted_call;

static void make_call(counted_call *c, const contract_entry *entry, contract_case what, uint32_t variant,
                      uint64_t fail_at, uint64_t stop_at)
{
    const tl_progress progress = { update_progress, &c->progress };
    memset(c, 0, sizeof *c);
    test_allocator_init(&c->memory, fail_at);
    c->progress.stop_at = stop_at;
    const tl_host host = { &c->memory.allocator, NULL, &progress };
    c->run.what = what;
    c->run.variant = variant;
    c->run.host = &host;
    c->run.wants_report = what != CONTRACT_NULL_REPORT;
    c->run.report = c->run.wants_report ? &c->report : NULL;
    c->result = entry->call(&c->run);
    c->run.host = NULL;
    if (c->run.own_report.stage != NULL || c->run.own_report.field != NULL || c->run.own_report.element != NULL) {
        c->report = c->run.own_report;
    }
    if (c->memory.live_blocks != 0) {
        fail_msg("%s, %s: %llu blocks leaked", entry->function, CASE_NAMES[what],
                 (unsigned long long)c->memory.live_blocks);
    }
}

static void expect(const contract_entry *entry, const counted_call *c, tl_result expected)
{
    if (c->result != expected) {
        fail_msg("%s, %s %u: %s, expected %s (field %s, %s)", entry->function, CASE_NAMES[c->run.what],
                 (unsigned)c->run.variant, tl_result_name(c->result), tl_result_name(expected),
                 c->report.field != NULL ? c->report.field : "-", c->report.advice != NULL ? c->report.advice : "-");
    }
    if (tl_is_error(c->result) && !c->run.is_clear) {
        fail_msg("%s, %s %u: an output is left behind", entry->function, CASE_NAMES[c->run.what],
                 (unsigned)c->run.variant);
    }
}

static void expect_answer(const contract_entry *entry, const counted_call *c, const counted_call *good)
{
    expect(entry, c, TL_OK);
    if (c->run.answer != good->run.answer) {
        fail_msg("%s, %s: another answer", entry->function, CASE_NAMES[c->run.what]);
    }
}

static void expect_field(const contract_entry *entry, const counted_call *c, const char *field)
{
    if (!tl_is_error(c->result) || !c->run.is_clear) {
        fail_msg("%s, %s %s: %s", entry->function, CASE_NAMES[c->run.what], field, tl_result_name(c->result));
    }
    if (c->report.field == NULL || strcmp(c->report.field, field) != 0) {
        fail_msg("%s: a bad %s is reported as field %s", entry->function, field,
                 c->report.field != NULL ? c->report.field : "(none)");
    }
    if (c->report.advice == NULL) {
        fail_msg("%s: a bad %s is reported without advice", entry->function, field);
    }
}

// Each allocation fails in turn, until none is left to fail.
static uint32_t fail_memory(const contract_entry *entry)
{
    counted_call c;
    uint32_t made = 0;
    for (uint64_t fail_at = 1;; fail_at++) {
        make_call(&c, entry, CONTRACT_NO_MEMORY, 0, fail_at, 0);
        if (c.result == TL_OK) {
            break;
        }
        expect(entry, &c, TL_ERR_MEMORY);
        made++;
    }
    if (made == 0) {
        fail_msg("%s takes no memory from its host", entry->function);
    }
    return made;
}

// Progress is told, and each time that it is, the hook says stop.
static uint32_t cancel(const contract_entry *entry)
{
    counted_call c;
    uint32_t made = 0;
    for (uint64_t stop_at = 1;; stop_at++) {
        make_call(&c, entry, CONTRACT_CANCELLED, 0, 0, stop_at);
        if (c.result == TL_OK && c.progress.calls < stop_at) {
            break;
        }
        expect(entry, &c, TL_ERR_CANCELLED);
        made++;
    }
    if (made == 0) {
        fail_msg("%s tells no progress", entry->function);
    }
    return made;
}

static uint32_t check_variants(const contract_entry *entry, contract_case what, uint32_t count)
{
    counted_call c;
    for (uint32_t i = 0; i < count; i++) {
        make_call(&c, entry, what, i, 0, 0);
        expect(entry, &c, TL_ERR_ARGUMENT);
    }
    if (count == 0) {
        fail_msg("%s: no variant of %s", entry->function, CASE_NAMES[what]);
    }
    return count;
}

static uint32_t check_fields(const contract_entry *entry)
{
    counted_call c;
    uint32_t i = 0;
    for (; entry->fields != NULL && entry->fields[i] != NULL; i++) {
        make_call(&c, entry, CONTRACT_BAD_FIELD, i, 0, 0);
        expect_field(entry, &c, entry->fields[i]);
    }
    if (i == 0) {
        fail_msg("%s: no field to be bad", entry->function);
    }
    return i;
}

static uint32_t check_buffers(const contract_entry *entry, contract_case what, const counted_call *good)
{
    counted_call c;
    make_call(&c, entry, what, 0, 0, 0);
    expect(entry, &c, TL_INCOMPLETE);
    if (c.run.count != good->run.count || c.run.count == 0) {
        fail_msg("%s, %s: count %u, expected %u", entry->function, CASE_NAMES[what], (unsigned)c.run.count,
                 (unsigned)good->run.count);
    }
    return 1;
}

static uint32_t check_simple(const contract_entry *entry, contract_case what, const counted_call *good)
{
    counted_call c;
    make_call(&c, entry, what, 0, 0, 0);
    switch (what) {
    case CONTRACT_NULL_REPORT:
    case CONTRACT_NULL_DEF:
    case CONTRACT_ZEROED_FILTER:
    case CONTRACT_ZERO_ROTATION:
        expect_answer(entry, &c, good);
        break;
    case CONTRACT_ZEROED_DEF:
        expect(entry, &c, TL_ERR_ARGUMENT);
        if (c.report.advice != NULL || c.report.field != NULL) {
            expect_field(entry, &c, "cookie");
        }
        break;
    case CONTRACT_NOT_FOUND:
        expect(entry, &c, TL_NOT_FOUND);
        break;
    case CONTRACT_STALE:
        expect(entry, &c, TL_ERR_STALE);
        break;
    case CONTRACT_NO_NODES:
        expect(entry, &c, TL_ERR_NODES);
        break;
    case CONTRACT_BAD_BYTES:
        if (!tl_is_error(c.result) || c.report.advice == NULL) {
            fail_msg("%s, bad bytes: %s, without advice", entry->function, tl_result_name(c.result));
        }
        break;
    default:
        expect(entry, &c, TL_OK);
        break;
    }
    return 1;
}

static uint32_t check_case(const contract_entry *entry, contract_case what, const counted_call *good)
{
    switch (what) {
    case CONTRACT_NO_MEMORY:
        return fail_memory(entry);
    case CONTRACT_CANCELLED:
        return cancel(entry);
    case CONTRACT_NULL_INPUT:
        return check_variants(entry, what, entry->null_inputs);
    case CONTRACT_NULL_OUTPUT:
        return check_variants(entry, what, entry->null_outputs);
    case CONTRACT_BAD_FIELD:
        return check_fields(entry);
    case CONTRACT_NO_BUFFER:
    case CONTRACT_SHORT_BUFFER:
        return check_buffers(entry, what, good);
    default:
        return check_simple(entry, what, good);
    }
}

static uint32_t check_entry(const contract_entry *entry)
{
    counted_call good;
    memset(&good, 0, sizeof good);
    if (entry->cases == 0) {
        if (entry->remark == NULL) {
            fail_msg("%s has neither cases nor a remark", entry->function);
        }
        return 0;
    }
    if (entry->cases & CONTRACT_BIT(GOOD)) {
        make_call(&good, entry, CONTRACT_GOOD, 0, 0, 0);
        expect(entry, &good, TL_OK);
    }
    uint32_t made = 0;
    for (int what = 0; what < CONTRACT_CASE_COUNT; what++) {
        made += (entry->cases >> what & 1u) != 0 ? check_case(entry, (contract_case)what, &good) : 0;
    }
    return made;
}

static void every_function_keeps_the_contract(void **state)
{
    (void)state;
    uint32_t functions = 0, with_cases = 0, calls = 0;
    for (int t = 0; t < TABLE_COUNT; t++) {
        for (const contract_entry *entry = TABLES[t].entries; entry->function != NULL; entry++) {
            calls += check_entry(entry);
            functions++;
            with_cases += entry->cases != 0;
        }
    }
    printf("%u functions, %u with cases, %u calls\n", (unsigned)functions, (unsigned)with_cases, (unsigned)calls);
    TEST_CHECK(functions > 0);
}

static bool is_in_a_table(const char *name, size_t length)
{
    for (int t = 0; t < TABLE_COUNT; t++) {
        for (const contract_entry *entry = TABLES[t].entries; entry->function != NULL; entry++) {
            if (strlen(entry->function) == length && strncmp(entry->function, name, length) == 0) {
                return true;
            }
        }
    }
    return false;
}

// A declaration begins with TL_API; the function's name stands before the first bracket.
static uint32_t count_missing(const char *header)
{
    char path[512], line[512];
    snprintf(path, sizeof path, "%s/include/talus/%s.h", TALUS_SOURCE_DIR, header);
    FILE *file = fopen(path, "r");
    TEST_CHECK(file != NULL);
    uint32_t missing = 0;
    while (fgets(line, sizeof line, file) != NULL) {
        const char *bracket = strncmp(line, "TL_API ", 7) == 0 ? strchr(line, '(') : NULL;
        if (bracket == NULL) {
            continue;
        }
        const char *name = bracket;
        while (name > line && name[-1] != ' ' && name[-1] != '*') {
            name--;
        }
        if (!is_in_a_table(name, (size_t)(bracket - name))) {
            printf("%s.h: %.*s is in no table\n", header, (int)(bracket - name), name);
            missing++;
        }
    }
    fclose(file);
    return missing;
}

static void no_function_is_missing(void **state)
{
    (void)state;
    uint32_t missing = 0;
    for (int t = 0; t < TABLE_COUNT; t++) {
        // A header may be spread over two tables; only those named after a header are looked up.
        char path[512];
        snprintf(path, sizeof path, "%s/include/talus/%s.h", TALUS_SOURCE_DIR, TABLES[t].name);
        FILE *file = fopen(path, "r");
        if (file != NULL) {
            fclose(file);
            missing += count_missing(TABLES[t].name);
        }
    }
    TEST_CHECK(missing == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_keeps_the_contract),
        cmocka_unit_test(no_function_is_missing),
    };
    return cmocka_run_group_tests_name("contract", tests, NULL, NULL);
}
