// SPDX-License-Identifier: MIT
//
// Metres to voxels: defaults, roundings, limits, and tiles that share one lattice.

#include "talus_test.h"

#include <string.h>
#include <talus/nav_bake.h>

static const tl_aabb LEVEL = { { -10, 0, -20 }, { 50, 12, 40 } };

static tl_nav_config make(const tl_nav_def *def)
{
    tl_nav_config config;
    tl_report report;
    TEST_RESULT(tl_nav_config_from_def(def, LEVEL, 0, 0, &config, &report), TL_OK);
    return config;
}

static void defaults_are_those_of_recasts_demo(void **state)
{
    (void)state;
    tl_nav_def def = tl_default_nav_def();
    tl_nav_config config = make(&def);
    TEST_CHECK(config.walkable_height == 10);
    TEST_CHECK(config.walkable_climb == 4);
    TEST_CHECK(config.walkable_radius == 2);
    TEST_CHECK(config.min_region_area == 64 && config.merge_region_area == 400);
    TEST_CHECK(config.max_edge_len == 40);
    TEST_CHECK(config.max_simplification_error == 1.3f);
    TEST_CHECK(config.max_verts_per_poly == 6);
    TEST_CHECK(config.detail_sample_dist == 0.3f * 6.0f);
    TEST_CHECK(config.detail_sample_max_error == 0.2f);
    TEST_CHECK(config.border_size == 0);
    TEST_CHECK(config.width == 200 && config.height == 200 && config.height_voxels == 60);
    TEST_CHECK(config.walkable_slope_cos == 0.70710678f);
}

static void ratios_of_decimals_are_whole_numbers(void **state)
{
    (void)state;
    const struct {
        float length, unit;
        uint32_t up, down;
    } cases[] = {
        { 0.6f, 0.3f, 2, 2 },   { 0.9f, 0.2f, 5, 4 },    { 0.9f, 0.3f, 3, 3 },    { 0.6f, 0.1f, 6, 6 },
        { 2.0f, 0.2f, 10, 10 }, { 1.8f, 0.15f, 12, 12 }, { 0.7f, 0.1f, 7, 7 },    { 0.61f, 0.3f, 3, 2 },
        { 0.0f, 0.3f, 0, 0 },   { 0.29f, 0.3f, 1, 0 },   { 2.1f, 0.07f, 30, 30 }, { 100.0f, 0.01f, 10000, 10000 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tl_nav_def def = tl_default_nav_def();
        def.cell_size = cases[i].unit;
        def.cell_height = cases[i].unit;
        def.agent_radius = cases[i].length;
        def.agent_max_climb = cases[i].length;
        def.edge_max_len = cases[i].length;
        tl_nav_config config = make(&def);
        TEST_CHECK(config.walkable_radius == cases[i].up);
        TEST_CHECK(config.walkable_climb == cases[i].down);
        // A length that was asked for never becomes "any length".
        TEST_CHECK(config.max_edge_len == (cases[i].length > 0 && cases[i].down == 0 ? 1 : cases[i].down));
    }
}

static void decimal_ratios_hold_in_general(void **state)
{
    (void)state;
    test_random random = { 11 };
    for (uint32_t i = 0; i < 20000; i++) {
        uint32_t unit = 1 + test_random_below(&random, 200), count = 1 + test_random_below(&random, 200);
        tl_nav_def def = tl_default_nav_def();
        def.cell_size = (float)((double)unit / 100);
        def.agent_radius = (float)((double)(unit * count) / 100);
        TEST_CHECK(make(&def).walkable_radius == count);
    }
}

static void every_field_is_checked(void **state)
{
    (void)state;
    const float bad[] = { -1.0f, NAN, INFINITY, -INFINITY };
    const struct {
        const char *name;
        size_t offset;
        bool zero_is_bad;
    } fields[] = {
        { "cell_size", offsetof(tl_nav_def, cell_size), true },
        { "cell_height", offsetof(tl_nav_def, cell_height), true },
        { "agent_height", offsetof(tl_nav_def, agent_height), true },
        { "agent_radius", offsetof(tl_nav_def, agent_radius), false },
        { "agent_max_climb", offsetof(tl_nav_def, agent_max_climb), false },
        { "agent_max_slope", offsetof(tl_nav_def, agent_max_slope), false },
        { "region_min_size", offsetof(tl_nav_def, region_min_size), false },
        { "region_merge_size", offsetof(tl_nav_def, region_merge_size), false },
        { "edge_max_len", offsetof(tl_nav_def, edge_max_len), false },
        { "edge_max_error", offsetof(tl_nav_def, edge_max_error), false },
        { "detail_sample_dist", offsetof(tl_nav_def, detail_sample_dist), false },
        { "detail_sample_max_error", offsetof(tl_nav_def, detail_sample_max_error), false },
    };
    for (size_t f = 0; f < sizeof fields / sizeof fields[0]; f++) {
        for (size_t b = 0; b <= sizeof bad / sizeof bad[0]; b++) {
            float value = b < sizeof bad / sizeof bad[0] ? bad[b] : 0.0f;
            tl_nav_def def = tl_default_nav_def();
            memcpy((char *)&def + fields[f].offset, &value, sizeof value);
            tl_nav_config config;
            tl_report report;
            bool allowed = value == 0.0f && !fields[f].zero_is_bad;
            TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, &report), allowed ? TL_OK : TL_ERR_ARGUMENT);
            if (!allowed) {
                assert_string_equal(report.field, fields[f].name);
                TEST_CHECK(report.advice != NULL);
            }
        }
    }
    tl_nav_def def = tl_default_nav_def();
    tl_nav_config config;
    tl_report report;
    def.cell_size = 0.9f * TL_NAV_MIN_CELL;
    TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.field, "cell_size");
    def.cell_size = 0.3f;
    def.cell_height = 0.9f * TL_NAV_MIN_CELL;
    TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.field, "cell_height");
    def = tl_default_nav_def();
    def.agent_max_slope = 90.0f;
    TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, NULL), TL_ERR_ARGUMENT);
    for (uint32_t verts = 0; verts < 70; verts++) {
        def = tl_default_nav_def();
        def.max_verts_per_poly = verts;
        TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, NULL),
                    verts >= 3 && verts <= 64 ? TL_OK : TL_ERR_ARGUMENT);
    }
    def = tl_default_nav_def();
    int partition = 7;
    memcpy(&def.partition, &partition, sizeof def.partition);
    TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, NULL), TL_ERR_ARGUMENT);
    def = tl_default_nav_def();
    memcpy(&def.polygon_method, &partition, sizeof def.polygon_method);
    TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, NULL), TL_ERR_ARGUMENT);
}

static void expect_limit(const tl_nav_def *def, tl_aabb bounds, const char *element)
{
    tl_nav_config config;
    tl_report report;
    TEST_RESULT(tl_nav_config_from_def(def, bounds, 0, 0, &config, &report), TL_ERR_LIMIT);
    assert_string_equal(report.field, element);
    TEST_CHECK(report.advice != NULL);
}

static void limits_are_named_before_any_work(void **state)
{
    (void)state;
    const tl_aabb tall = { { 0, 0, 0 }, { 10, 2000, 10 } };
    tl_nav_def def = tl_default_nav_def();
    def.cell_height = 0.1f;
    tl_nav_config config;
    TEST_RESULT(tl_nav_config_from_def(&def, tall, 0, 0, &config, NULL), TL_OK); // 20,000 voxels
    def.cell_height = 0.01f;
    expect_limit(&def, tall, "cell_height");

    const tl_aabb wide = { { -10000, 0, -10000 }, { 10000, 100, 10000 } };
    def = tl_default_nav_def();
    expect_limit(&def, wide, "cell_size");
    def.tile_size = 1;
    expect_limit(&def, wide, "tile_size"); // 66,667 * 66,667 places
    def.tile_size = 64;
    TEST_RESULT(tl_nav_config_from_def(&def, wide, 1041, 1041, &config, NULL), TL_OK); // more than may hold triangles
    def.tile_size = 1u << 30;
    expect_limit(&def, wide, "tile_size");

    const tl_aabb huge = { { -1e12f, 0, -1e12f }, { 1e12f, 1, 1e12f } };
    def = tl_default_nav_def();
    expect_limit(&def, huge, "cell_size");
    def = tl_default_nav_def();
    def.cell_height = 1e-5f;
    expect_limit(&def, LEVEL, "agent_height");
    def = tl_default_nav_def();
    def.agent_max_climb = 1e9f;
    expect_limit(&def, LEVEL, "agent_max_climb");
    def = tl_default_nav_def();
    def.agent_radius = 1e9f;
    expect_limit(&def, LEVEL, "agent_radius");
}

static void bounds_are_checked(void **state)
{
    (void)state;
    tl_nav_def def = tl_default_nav_def();
    tl_nav_config config;
    tl_aabb bounds = tl_aabb_empty();
    TEST_RESULT(tl_nav_config_from_def(&def, bounds, 0, 0, &config, NULL), TL_ERR_EMPTY);
    bounds = LEVEL;
    bounds.max.y = NAN;
    TEST_CHECK(tl_nav_config_from_def(&def, bounds, 0, 0, &config, NULL) != TL_OK);
    bounds = LEVEL;
    bounds.max.z = INFINITY;
    TEST_RESULT(tl_nav_config_from_def(&def, bounds, 0, 0, &config, NULL), TL_ERR_NOT_FINITE);
    bounds = LEVEL;
    bounds.max.y = 1e13f;
    TEST_RESULT(tl_nav_config_from_def(&def, bounds, 0, 0, &config, NULL), TL_ERR_RANGE);
    // A flat level, and one smaller than a cell, have a lattice all the same.
    bounds = (tl_aabb){ { 1, 2, 3 }, { 1, 2, 3 } };
    TEST_RESULT(tl_nav_config_from_def(&def, bounds, 0, 0, &config, NULL), TL_OK);
    TEST_CHECK(config.width == 1 && config.height == 1 && config.height_voxels == 0);
    // The def's bounds win.
    def.bounds = (tl_aabb){ { 0, 0, 0 }, { 3, 3, 6 } };
    TEST_RESULT(tl_nav_config_from_def(&def, LEVEL, 0, 0, &config, NULL), TL_OK);
    TEST_CHECK(config.width == 10 && config.height == 20 && config.height_voxels == 15);
}

// The lines of the lattice that a tile uses are different floats, or the level is refused.
static void cells_finer_than_floats_are_refused(void **state)
{
    (void)state;
    tl_nav_config config;
    tl_report report;
    for (float far = 1e3f; far < 1e12f; far *= 1.7f) {
        const tl_nav_def def = tl_default_nav_def();
        const tl_aabb level = { { far, 0, 0 }, { far + 40.0f, 3, 40 } };
        const tl_result result = tl_nav_config_from_def(&def, level, 0, 0, &config, &report);
        if (far > 4194304.0f) {
            TEST_RESULT(result, TL_ERR_RANGE);
            assert_string_equal(report.field, "cell_size");
            continue;
        }
        TEST_RESULT(result, TL_OK);
        for (int64_t line = 0; line < (int64_t)config.width; line++) {
            TEST_CHECK(tl_nav_lattice_to_world(config.lattice.origin.x, line, config.cell_size) <
                       tl_nav_lattice_to_world(config.lattice.origin.x, line + 1, config.cell_size));
        }
    }
    const tl_nav_def def = tl_default_nav_def();
    const tl_aabb high = { { 0, 1e7f, 0 }, { 40, 1e7f + 3, 40 } };
    TEST_RESULT(tl_nav_config_from_def(&def, high, 0, 0, &config, &report), TL_ERR_RANGE);
    assert_string_equal(report.field, "cell_height");
}

static void tiles_share_one_lattice(void **state)
{
    (void)state;
    const tl_vec3 corners[] = { { 0, 0, 0 }, { -10.7f, 3, 22.1f }, { 5000.3f, -100, -5000.9f } };
    for (size_t k = 0; k < 3; k++) {
        tl_aabb level = { corners[k], tl_add(corners[k], tl_vec3_make(123.4f, 9, 77.7f)) };
        tl_nav_def def = tl_default_nav_def();
        def.tile_size = 48;
        uint32_t tiles_x, tiles_z;
        TEST_RESULT(tl_nav_tile_grid(&def, level, &tiles_x, &tiles_z, NULL), TL_OK);
        TEST_CHECK(tiles_x == 9 && tiles_z == 6);
        tl_nav_config left, right;
        for (uint32_t x = 0; x + 1 < tiles_x; x++) {
            TEST_RESULT(tl_nav_config_from_def(&def, level, x, 1, &left, NULL), TL_OK);
            TEST_RESULT(tl_nav_config_from_def(&def, level, x + 1, 1, &right, NULL), TL_OK);
            TEST_CHECK(left.border_size == 5 && left.width == 58 && left.height == 58);
            TEST_CHECK(right.lattice.first_x - left.lattice.first_x == 48);
            TEST_CHECK(memcmp(&left.lattice.origin, &right.lattice.origin, sizeof(tl_vec3)) == 0);
            // The line that they share, without borders, is the same float seen from both.
            int64_t line = (int64_t)left.lattice.first_x + 5 + 48;
            TEST_CHECK(line == (int64_t)right.lattice.first_x + 5);
            // And the corner of the right tile's field is that line, less its border.
            TEST_CHECK(right.bounds.min.x ==
                       tl_nav_lattice_to_world(right.lattice.origin.x, line - 5, right.cell_size));
        }
        TEST_RESULT(tl_nav_config_from_def(&def, level, tiles_x, 0, &left, NULL), TL_ERR_ARGUMENT);
        TEST_RESULT(tl_nav_config_from_def(&def, level, 0, tiles_z, &left, NULL), TL_ERR_ARGUMENT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_are_those_of_recasts_demo),  cmocka_unit_test(ratios_of_decimals_are_whole_numbers),
        cmocka_unit_test(decimal_ratios_hold_in_general),      cmocka_unit_test(every_field_is_checked),
        cmocka_unit_test(limits_are_named_before_any_work),    cmocka_unit_test(bounds_are_checked),
        cmocka_unit_test(cells_finer_than_floats_are_refused), cmocka_unit_test(tiles_share_one_lattice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
