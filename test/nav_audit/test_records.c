// SPDX-License-Identifier: MIT
//
// Records thinned and drawn together, against a flood over all pairs.

#include "talus_test.h"

#include "base/arena.h"
#include "nav_audit/records.h"

#include <string.h>

static void add_random(tl_audit_records *list, test_random *random, uint32_t count, uint32_t width)
{
    for (uint32_t i = 0; i < count; i++) {
        tl_audit_record record;
        memset(&record, 0, sizeof record);
        record.kind = (tl_nav_finding_kind)test_random_below(random, 4);
        record.triangle = i;
        record.depth = record.kind == TL_NAV_FINDING_MISSING ? 0.0f : (float)test_random_below(random, 5);
        for (int axis = 0; axis < 3; axis++) {
            record.cube[axis] = (int32_t)test_random_below(random, width) - (int32_t)width / 2;
        }
        record.point = tl_vec3_make((float)record.cube[0], (float)record.cube[1], (float)record.cube[2]);
        TEST_RESULT(tl_audit_records_add(list, &record), TL_OK);
    }
}

static bool same_cube(const tl_audit_record *a, const tl_audit_record *b)
{
    return a->kind == b->kind && memcmp(a->cube, b->cube, sizeof a->cube) == 0;
}

static int32_t coarse(int32_t cube, int32_t reach)
{
    return cube >= 0 ? cube / reach : -((-cube + reach - 1) / reach);
}

static bool touch(const tl_audit_record *a, const tl_audit_record *b, int32_t reach)
{
    bool close = a->kind == b->kind;
    for (int axis = 0; axis < 3; axis++) {
        close = close && abs(coarse(a->cube[axis], reach) - coarse(b->cube[axis], reach)) <= 1;
    }
    return close;
}

// Gives every record the lowest number of its group.
static uint32_t flood(const tl_audit_records *list, int32_t reach, uint32_t *group)
{
    uint32_t groups = 0;
    for (uint32_t i = 0; i < list->count; i++) {
        group[i] = i;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t i = 0; i < list->count; i++) {
            for (uint32_t k = 0; k < list->count; k++) {
                if (group[k] < group[i] && touch(&list->records[i], &list->records[k], reach)) {
                    group[i] = group[k];
                    changed = true;
                }
            }
        }
    }
    for (uint32_t i = 0; i < list->count; i++) {
        groups += group[i] == i;
    }
    return groups;
}

static void thinned_and_drawn_together(void **state)
{
    (void)state;
    test_random random = { 11 };
    uint32_t thinned = 0, joined = 0;
    for (int round = 0; round < 60; round++) {
        tl_audit_records list = { NULL, 0, 0, NULL, NULL }, all = { NULL, 0, 0, NULL, NULL };
        const uint32_t count = 1 + test_random_below(&random, 120);
        const int32_t reach = 1 + (int32_t)test_random_below(&random, 6);
        add_random(&list, &random, count, 2 + test_random_below(&random, 40));
        TEST_RESULT(tl_audit_records_append(&all, &list), TL_OK);
        TEST_RESULT(tl_audit_records_thin(&list), TL_OK);
        thinned += all.count - list.count;
        for (uint32_t i = 0; i < list.count; i++) { // the deepest of its cube, of equal ones the first
            for (uint32_t k = 0; k < all.count; k++) {
                if (same_cube(&list.records[i], &all.records[k])) {
                    TEST_CHECK(all.records[k].depth < list.records[i].depth ||
                               (all.records[k].depth == list.records[i].depth &&
                                all.records[k].triangle >= list.records[i].triangle));
                }
            }
            TEST_CHECK(i == 0 || !same_cube(&list.records[i - 1], &list.records[i]));
        }
        tl_nav_finding *findings;
        uint32_t found, group[128], members = 0;
        TEST_RESULT(tl_audit_records_cluster(&list, (uint32_t)reach, &findings, &found), TL_OK);
        assert_int_equal(found, flood(&list, reach, group));
        for (uint32_t f = 0; f < found; f++) {
            uint32_t own = 0, size = 0;
            while (list.records[own].triangle != findings[f].triangle) {
                own++;
            }
            tl_aabb box = tl_aabb_empty();
            for (uint32_t i = 0; i < list.count; i++) {
                if (group[i] == group[own]) {
                    size++;
                    box = tl_aabb_add_point(box, list.records[i].point);
                    TEST_CHECK(list.records[i].depth <= findings[f].depth);
                }
            }
            assert_int_equal(size, findings[f].count);
            TEST_CHECK(memcmp(&box, &findings[f].bounds, sizeof box) == 0);
            TEST_CHECK(findings[f].kind == list.records[own].kind);
            members += size;
        }
        assert_int_equal(members, list.count);
        joined += list.count - found;
        tl_release_array(NULL, findings, found, sizeof *findings);
        tl_audit_records_free(&list);
        tl_audit_records_free(&all);
    }
    TEST_CHECK(thinned > 100 && joined > 500);
}

// Cubes at the ends of what 32 bits hold do not wrap around.
static void far_cubes(void **state)
{
    (void)state;
    tl_audit_records list = { NULL, 0, 0, NULL, NULL };
    const int32_t ends[] = { -(1 << 30), 1 << 30 };
    for (int i = 0; i < 2; i++) {
        tl_audit_record record;
        memset(&record, 0, sizeof record);
        record.cube[0] = record.cube[1] = record.cube[2] = ends[i];
        TEST_RESULT(tl_audit_records_add(&list, &record), TL_OK);
    }
    tl_nav_finding *findings;
    uint32_t found;
    TEST_RESULT(tl_audit_records_cluster(&list, 1, &findings, &found), TL_OK);
    assert_int_equal(found, 2);
    tl_release_array(NULL, findings, found, sizeof *findings);
    tl_audit_records_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thinned_and_drawn_together),
        cmocka_unit_test(far_cubes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
