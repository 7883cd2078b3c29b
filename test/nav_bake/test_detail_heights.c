// SPDX-License-Identifier: MIT
//
// Heights come from the polygon's own region, or from where one can walk to from it; never from another storey.

#include "nav_compact_fixture.h"

#include "nav_bake/detail/detail.h"

// A storey above and a storey below, and between them a ramp: the storeys' floors hide one another in plan.
static void own_storey(void **state)
{
    (void)state;
    fixture_map map = fixture_map_make(12, 6);
    for (uint32_t z = 0; z < 6; z++) {
        for (uint32_t x = 0; x < 12; x++) {
            fixture_add_floor(&map, x, z, (int)x / 4, TL_NAV_WALKABLE_AREA);
            if (x >= 3) {
                fixture_add_floor(&map, x, z, 40 + (int)z, TL_NAV_WALKABLE_AREA);
            }
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, 0);
    compact.region = tl_allocate_array(NULL, compact.span_count, sizeof(uint32_t));
    compact.region_count = 3;
    for (uint32_t i = 0; i < compact.span_count; i++) {
        compact.region[i] = compact.floor[i] >= 40 ? 2 : 1;
    }
    tl_detail_floors low = tl_detail_floors_make(&compact, 1, 20, 6, 3, 0);
    tl_detail_floors high = tl_detail_floors_make(&compact, 2, 20, 6, 3, 0);
    for (int64_t z = -3; z < 9; z++) {
        for (int64_t x = -3; x < 15; x++) {
            int64_t inside_x = x < 0 ? 0 : x > 11 ? 11 : x, inside_z = z < 0 ? 0 : z > 5 ? 5 : z;
            TEST_CHECK(tl_detail_floor_at(&low, x, z, false, -7) == inside_x / 4);
            TEST_CHECK(tl_detail_floor_at(&high, x, z, false, -7) == 40 + inside_z); // from column 3 on it is its own
        }
    }
    // A polygon of several regions takes the one nearest in height at its middle.
    tl_detail_floors several = tl_detail_floors_make(&compact, TL_SEVERAL_REGIONS, 20, 6, 3, 39);
    TEST_CHECK(several.region == 2);
    several = tl_detail_floors_make(&compact, TL_SEVERAL_REGIONS, 20, 6, 3, 5);
    TEST_CHECK(several.region == 1);
    several = tl_detail_floors_make(&compact, TL_SEVERAL_REGIONS, 20, -4, 3, 39); // looked for nearby
    TEST_CHECK(several.region == 1);
    fixture_compact_free(&compact);
    fixture_map_free(&map);
}

// A region that has climbed a stair and lies over the floor beside it: on the polygon's rim its upper storey must not
// be taken for the floor below.
static void own_storey_beside_a_stair(void **state)
{
    (void)state;
    fixture_map map = fixture_map_make(12, 6);
    for (uint32_t z = 0; z < 6; z++) {
        for (uint32_t x = 0; x < 12; x++) {
            fixture_add_floor(&map, x, z, 1, TL_NAV_WALKABLE_AREA);
            if (x >= 6) {
                fixture_add_floor(&map, x, z, 30, TL_NAV_WALKABLE_AREA);
            }
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, 0);
    compact.region = tl_allocate_array(NULL, compact.span_count, sizeof(uint32_t));
    compact.region_count = 3;
    for (uint32_t z = 0, i = 0; z < 6; z++) {
        for (uint32_t x = 0; x < 12; x++, i++) {
            compact.region[i] = x < 6 ? 1 : 2;
            if (x >= 6) {
                compact.region[++i] = 1; // the upper storey
            }
        }
    }
    tl_detail_floors floors = tl_detail_floors_make(&compact, 1, 20, 3, 3, 1);
    for (int64_t z = 0; z < 6; z++) {
        TEST_CHECK(tl_detail_floor_at(&floors, 5, z, false, 1) == 1);
        TEST_CHECK(tl_detail_floor_at(&floors, 6, z, false, 1) == 1);
        TEST_CHECK(tl_detail_floor_at(&floors, 7, z, false, 9) == 1); // whatever is expected: it is walked to
        TEST_CHECK(tl_detail_floor_at(&floors, 9, z, true, 1) == 30); // well inside: a polygon of the upper storey
    }
    tl_detail_floors upper = tl_detail_floors_make(&compact, 1, 20, 9, 3, 30);
    TEST_CHECK(tl_detail_floor_at(&upper, 6, 3, false, 30) == 30);
    fixture_compact_free(&compact);
    fixture_map_free(&map);
}

// Beyond its region one walks on over linked floors, and round what is not linked.
static void walks_on(void **state)
{
    (void)state;
    static const char *const rows[] = { "0123456", "0     6", "0246666" };
    tl_nav_compact compact = fixture_from_rows(rows, 3, 0);
    compact.region = tl_allocate_array(NULL, compact.span_count, sizeof(uint32_t));
    compact.region_count = 3;
    for (uint32_t i = 0; i < compact.span_count; i++) {
        compact.region[i] = i == 0 ? 1 : 2;
    }
    tl_detail_floors floors = tl_detail_floors_make(&compact, 1, 20, 0, 0, 0);
    for (int64_t x = 0; x < 7; x++) {
        TEST_CHECK(tl_detail_floor_at(&floors, x, 0, false, -1) == x); // along the row
    }
    TEST_CHECK(tl_detail_floor_at(&floors, 0, 2, false, -1) == 0);
    TEST_CHECK(tl_detail_floor_at(&floors, 2, 2, false, -1) == 4); // round the gap
    tl_detail_floors near = tl_detail_floors_make(&compact, 1, 2, 0, 0, 0);
    TEST_CHECK(tl_detail_floor_at(&near, 6, 0, false, -1) == -1); // too far to look
    tl_detail_floors none = tl_detail_floors_make(&compact, TL_SEVERAL_REGIONS, 1, 30, 30, 0);
    TEST_CHECK(none.region == 0 && tl_detail_floor_at(&none, 0, 0, false, 9) == 9);
    fixture_compact_free(&compact);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_storey),
        cmocka_unit_test(own_storey_beside_a_stair),
        cmocka_unit_test(walks_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
