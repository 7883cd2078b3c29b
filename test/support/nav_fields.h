// SPDX-License-Identifier: MIT
//
// Small lattices for the tests of the navmesh build: configs by hand, random heightfields, floors from a drawing, task
// hooks that run in odd orders.

#ifndef TALUS_TEST_NAV_FIELDS_H
#define TALUS_TEST_NAV_FIELDS_H

#include "backward_tasks.h"
#include "talus_test.h"

#include <string.h>
#include <talus/nav_bake.h>

/// One tile of width * height cells of 1 m, voxels of 1 m, agent 3 voxels high that steps 1.
static inline tl_nav_config test_nav_config(uint32_t width, uint32_t height)
{
    tl_nav_config config;
    memset(&config, 0, sizeof config);
    config.bounds.max = tl_vec3_make((float)width, 64.0f, (float)height);
    config.cell_size = config.cell_height = 1.0f;
    config.width = width;
    config.height = height;
    config.height_voxels = 64;
    config.walkable_height = 3;
    config.walkable_climb = 1;
    config.walkable_slope_cos = 0.70710678f;
    config.max_verts_per_poly = 6;
    return config;
}

/// A heightfield of random columns of up to max_spans spans, heap-allocated so that tl_nav_heightfield_free frees it.
/// Small gaps and small steps are frequent.
static inline tl_nav_heightfield test_random_heightfield(test_random *random, const tl_nav_config *config,
                                                         uint32_t max_spans)
{
    tl_nav_heightfield field;
    memset(&field, 0, sizeof field);
    field.width = config->width;
    field.height = config->height;
    field.bounds = config->bounds;
    field.lattice = config->lattice;
    field.cell_size = config->cell_size;
    field.cell_height = config->cell_height;
    uint32_t columns = field.width * field.height;
    field.first_span = (uint32_t *)test_blob_alloc((columns + 1) * sizeof(uint32_t));
    field.spans = (tl_nav_span *)test_blob_alloc((uint64_t)columns * (max_spans + 1) * sizeof(tl_nav_span));
    for (uint32_t c = 0; c < columns; c++) {
        field.first_span[c] = field.span_count;
        uint32_t at = test_random_below(random, 3), count = test_random_below(random, max_spans + 1);
        for (uint32_t i = 0; i < count; i++) {
            uint32_t end = at + 1 + test_random_below(random, 3);
            uint32_t area = test_random_below(random, 3) == 0 ? 0 : 1 + test_random_below(random, 3) * 31;
            tl_nav_span span = { (uint16_t)at, (uint16_t)end, (uint16_t)area, 0 };
            field.spans[field.span_count++] = span;
            at = end + 1 + test_random_below(random, 6);
        }
    }
    field.first_span[columns] = field.span_count;
    return field;
}

/// Counts progress calls and cancels at one of them (0: never). Checks that `done` never exceeds `total`.
typedef struct test_progress {
    tl_progress progress; ///< pass &test.progress
    uint32_t calls;
    uint32_t cancel_at;
} test_progress;

static inline bool test_progress_update(const char *stage, uint64_t done, uint64_t total, void *user)
{
    test_progress *test = (test_progress *)user;
    TEST_CHECK(stage != NULL && done <= total);
    test->calls++;
    return test->calls != test->cancel_at;
}

static inline void test_progress_init(test_progress *test, uint32_t cancel_at)
{
    test->progress.update = test_progress_update;
    test->progress.user = test;
    test->calls = 0;
    test->cancel_at = cancel_at;
}

/// Whether two heightfields hold the same spans.
static inline bool test_same_heightfield(const tl_nav_heightfield *a, const tl_nav_heightfield *b)
{
    uint32_t columns = a->width * a->height;
    return a->width == b->width && a->height == b->height && a->span_count == b->span_count &&
           memcmp(a->first_span, b->first_span, (columns + 1) * sizeof(uint32_t)) == 0 &&
           memcmp(a->spans, b->spans, a->span_count * sizeof(tl_nav_span)) == 0;
}

#endif
