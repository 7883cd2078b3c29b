// SPDX-License-Identifier: MIT
//
// The sweep against the filters one by one and compaction after them: every combination of filters, columns of many
// spans, heights up to the limit, fields wider than a block and than a step; and from triangles the same as from a
// heightfield.

#include "base/arena.h"
#include "cli/sample/sample_level.h"
#include "nav_bake/floors/compact.h"
#include "nav_fields.h"

// Columns of up to `most` spans, whose heights reach to the limit where `high`.
static tl_nav_heightfield random_field(test_random *random, const tl_nav_config *config, uint32_t most, bool high)
{
    const uint32_t columns = config->width * config->height;
    tl_nav_heightfield field = { 0 };
    field.width = config->width;
    field.height = config->height;
    field.lattice = config->lattice;
    field.bounds = config->bounds;
    field.first_span = tl_allocate_array(NULL, columns + 1, sizeof(uint32_t));
    field.spans = malloc((size_t)columns * most * sizeof(tl_nav_span));
    for (uint32_t c = 0; c < columns; c++) {
        field.first_span[c] = field.span_count;
        uint32_t count = test_random_below(random, most + 1), bottom = test_random_below(random, 20);
        bottom += high ? 0xffff - 16 * most - 20 : 0;
        for (uint32_t k = 0; k < count; k++) {
            const uint32_t top = bottom + 1 + test_random_below(random, 4);
            const uint32_t area = test_random_below(random, 3) > 0 ? 1 + test_random_below(random, 63) : 0;
            field.spans[field.span_count++] = (tl_nav_span){ (uint16_t)bottom, (uint16_t)top, (uint16_t)area, 0 };
            bottom = top + 1 + test_random_below(random, 12);
        }
    }
    field.first_span[columns] = field.span_count;
    tl_nav_span *exact = tl_allocate_array(NULL, field.span_count, sizeof *exact);
    memcpy(exact, field.spans, field.span_count * sizeof *exact);
    free(field.spans);
    field.spans = exact;
    return field;
}

static bool same_compact(const tl_nav_compact *a, const tl_nav_compact *b)
{
    const uint32_t count = a->span_count;
    bool same = count == b->span_count && (a->step == NULL) == (b->step == NULL) &&
                memcmp(a->first_span, b->first_span, (a->width * a->height + 1) * sizeof *a->first_span) == 0 &&
                memcmp(a->floor, b->floor, count * sizeof *a->floor) == 0 &&
                memcmp(a->clearance, b->clearance, count * sizeof *a->clearance) == 0 &&
                memcmp(a->area, b->area, count) == 0;
    for (uint32_t i = 0; same && i < count; i++) {
        for (uint32_t d = 0; d < 4; d++) {
            same = same && tl_nav_compact_neighbour(a, i, d) == tl_nav_compact_neighbour(b, i, d);
        }
    }
    return same;
}

static void filter_one_by_one(const tl_nav_config *config, tl_nav_heightfield *field)
{
    if (config->filter_low_hanging_obstacles) {
        tl_nav_filter_low_hanging_obstacles(config, field);
    }
    if (config->filter_ledge_spans) {
        tl_nav_filter_ledge_spans(config, field);
    }
    if (config->filter_walkable_low_height_spans) {
        tl_nav_filter_walkable_low_height_spans(config, field);
    }
}

static void agrees_with_the_filters(void **state)
{
    (void)state;
    test_random random = { 11 };
    uint32_t kept = 0, dropped = 0, many = 0, high_fields = 0;
    for (uint32_t round = 0; round < 400; round++) {
        tl_nav_config config = test_nav_config(1 + test_random_below(&random, 75), 1 + test_random_below(&random, 9));
        config.walkable_climb = test_random_below(&random, 12);
        config.walkable_height = 1 + test_random_below(&random, 10);
        config.filter_low_hanging_obstacles = (round & 1) == 0;
        config.filter_ledge_spans = (round & 2) == 0;
        config.filter_walkable_low_height_spans = (round & 4) == 0;
        const bool high = round % 5 == 0;
        tl_nav_heightfield field = random_field(&random, &config, round % 50 == 0 ? 300 : 1 + round % 4, high);
        tl_nav_compact swept, expected;
        TEST_RESULT(tl_nav_filter_and_compact(&config, &field, NULL, &swept, NULL), TL_OK);
        filter_one_by_one(&config, &field);
        TEST_RESULT(tl_nav_bake_compact(&config, &field, NULL, &expected, NULL), TL_OK);
        if (!same_compact(&swept, &expected)) {
            fail_msg("round %u: %u x %u climb %u room %u count %u %u", round, config.width, config.height,
                     config.walkable_climb, config.walkable_height, swept.span_count, expected.span_count);
        }
        kept += swept.span_count;
        dropped += field.span_count - swept.span_count;
        many += field.span_count > 100 * config.width * config.height;
        high_fields += high;
        tl_nav_compact_free(&swept);
        tl_nav_compact_free(&expected);
        tl_nav_heightfield_free(&field);
    }
    TEST_CHECK(kept > 100000 && dropped > 100000 && many == 8 && high_fields == 80);
}

// A flat field of more floors in two rows than 16 bits can step over, and one just below.
static void wide_fields_have_indices(void **state)
{
    (void)state;
    const uint32_t widths[] = { 16383, 16384, 40000 };
    for (uint32_t k = 0; k < 3; k++) {
        tl_nav_config config = test_nav_config(widths[k], 3);
        tl_nav_heightfield field = { 0 };
        field.width = config.width;
        field.height = config.height;
        field.span_count = 3 * config.width;
        field.first_span = tl_allocate_array(NULL, field.span_count + 1, sizeof(uint32_t));
        field.spans = tl_allocate_array(NULL, field.span_count, sizeof(tl_nav_span));
        for (uint32_t i = 0; i < field.span_count; i++) {
            field.first_span[i] = i;
            field.spans[i] = (tl_nav_span){ 0, 1, 63, 0 };
        }
        field.first_span[field.span_count] = field.span_count;
        tl_nav_compact compact;
        TEST_RESULT(tl_nav_bake_compact(&config, &field, NULL, &compact, NULL), TL_OK);
        TEST_CHECK(compact.span_count == field.span_count && (compact.step != NULL) == (k == 0));
        for (uint32_t i = 0; i < compact.span_count; i++) {
            const uint32_t x = i % config.width, z = i / config.width;
            TEST_CHECK(tl_nav_compact_neighbour(&compact, i, 0) == (x > 0 ? i - 1 : TL_NAV_NO_SPAN));
            TEST_CHECK(tl_nav_compact_neighbour(&compact, i, 1) == (z < 2 ? i + config.width : TL_NAV_NO_SPAN));
            TEST_CHECK(tl_nav_compact_neighbour(&compact, i, 2) == (x + 1 < config.width ? i + 1 : TL_NAV_NO_SPAN));
            TEST_CHECK(tl_nav_compact_neighbour(&compact, i, 3) == (z > 0 ? i - config.width : TL_NAV_NO_SPAN));
        }
        tl_nav_compact_free(&compact);
        tl_nav_heightfield_free(&field);
    }
}

static void bands_agree_with_the_heightfield(void **state)
{
    (void)state;
    uint32_t bands = 0;
    for (uint32_t round = 0; round < 6; round++) {
        tl_sample_mesh sample;
        const tl_sample_level *level = tl_sample_find_level(round % 2 == 0 ? "city" : "dungeon");
        TEST_RESULT(tl_sample_build_level(level, 4000, round + 1, &sample), TL_OK);
        const tl_mesh_view mesh = tl_sample_mesh_as_view(&sample);
        tl_nav_def def = tl_default_nav_def();
        def.filter_ledge_spans = round < 4;
        tl_aabb bounds = tl_aabb_empty();
        for (uint32_t i = 0; i < mesh.vertex_count; i++) {
            bounds = tl_aabb_add_point(bounds, mesh.vertices[i]);
        }
        tl_nav_config config;
        TEST_RESULT(tl_nav_config_from_def(&def, bounds, 0, 0, &config, NULL), TL_OK);
        tl_tasks tasks;
        test_backward_tasks(&tasks, 2);
        const tl_host host = { NULL, &tasks, NULL };
        const tl_triangle_list all = { NULL, mesh.triangle_count };
        tl_nav_heightfield field;
        tl_nav_compact from_triangles, from_field;
        uint64_t span_count = 0;
        TEST_RESULT(tl_nav_rasterize(&config, &mesh, NULL, NULL, &field, NULL), TL_OK);
        TEST_RESULT(tl_nav_filter_and_compact(&config, &field, NULL, &from_field, NULL), TL_OK);
        TEST_RESULT(tl_nav_open_triangles(&config, &(tl_nav_input){ .mesh = mesh }, all, &host, &from_triangles,
                                          &span_count, NULL),
                    TL_OK);
        TEST_CHECK(span_count == field.span_count && same_compact(&from_triangles, &from_field));
        bands += config.width * config.height > 20000;
        tl_nav_compact_free(&from_triangles);
        tl_nav_compact_free(&from_field);
        tl_nav_heightfield_free(&field);
        tl_sample_mesh_free(&sample);
    }
    TEST_CHECK(bands >= 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(agrees_with_the_filters),
                                        cmocka_unit_test(wide_fields_have_indices),
                                        cmocka_unit_test(bands_agree_with_the_heightfield) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
