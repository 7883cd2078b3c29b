// SPDX-License-Identifier: MIT
//
// Heights come from the polygon's own region, or from where one can walk to from it; never from another storey.

#include "nav_compact_fixture.h"

#include "nav_bake/detail/detail.h"

// The region of a polygon of several with four corners.
static uint32_t region_of_square(const tl_nav_compact *compact, const int32_t corners[4][3], int64_t x, int64_t z,
                                 int32_t height)
{
    int32_t vertices[12];
    memcpy(vertices, corners, sizeof vertices);
    uint32_t first[2] = { 0, 4 }, indices[4] = { 0, 1, 2, 3 };
    tl_polygon_mesh square;
    memset(&square, 0, sizeof square);
    square.vertex_count = square.index_count = 4;
    square.polygon_count = 1;
    square.vertices = vertices;
    square.first = first;
    square.indices = indices;
    return tl_detail_choose_region(compact, &square, 0, 20, x, z, height);
}

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
    tl_detail_floors low = tl_detail_floors_make(&compact, 1, false, 20, 6, 3);
    tl_detail_floors high = tl_detail_floors_make(&compact, 2, false, 20, 6, 3);
    for (int64_t z = -3; z < 9; z++) {
        for (int64_t x = -3; x < 15; x++) {
            int64_t inside_x = x < 0 ? 0 : x > 11 ? 11 : x, inside_z = z < 0 ? 0 : z > 5 ? 5 : z;
            TEST_CHECK(tl_detail_floor_at(&low, x, z, false, -7) == inside_x / 4);
            TEST_CHECK(tl_detail_floor_at(&high, x, z, false, -7) == 40 + inside_z); // from column 3 on it is its own
        }
    }
    // A polygon of several regions takes the one nearest in height at its middle, of those that its corners stand on.
    const int32_t corners_low[4][3] = { { 4, 0, 0 }, { 4, 0, 6 }, { 12, 2, 6 }, { 12, 2, 0 } };
    const int32_t corners_high[4][3] = { { 4, 40, 0 }, { 4, 45, 6 }, { 12, 45, 6 }, { 12, 40, 0 } };
    const int32_t corners_both[4][3] = { { 4, 40, 0 }, { 4, 45, 6 }, { 12, 2, 6 }, { 12, 2, 0 } };
    TEST_CHECK(region_of_square(&compact, corners_low, 6, 3, 39) == 1);
    TEST_CHECK(region_of_square(&compact, corners_high, 6, 3, 5) == 2);
    TEST_CHECK(region_of_square(&compact, corners_both, 6, 3, 39) == 2);
    TEST_CHECK(region_of_square(&compact, corners_both, 6, 3, 5) == 1);
    TEST_CHECK(region_of_square(&compact, corners_both, -4, 3, 39) == 1); // looked for nearby
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
    tl_detail_floors floors = tl_detail_floors_make(&compact, 1, false, 20, 3, 3);
    for (int64_t z = 0; z < 6; z++) {
        TEST_CHECK(tl_detail_floor_at(&floors, 5, z, false, 1) == 1);
        TEST_CHECK(tl_detail_floor_at(&floors, 6, z, false, 1) == 1);
        TEST_CHECK(tl_detail_floor_at(&floors, 7, z, false, 9) == 1); // whatever is expected: it is walked to
        TEST_CHECK(tl_detail_floor_at(&floors, 9, z, true, 1) == 30); // well inside: a polygon of the upper storey
    }
    tl_detail_floors upper = tl_detail_floors_make(&compact, 1, false, 20, 9, 3);
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
    tl_detail_floors floors = tl_detail_floors_make(&compact, 1, false, 20, 0, 0);
    for (int64_t x = 0; x < 7; x++) {
        TEST_CHECK(tl_detail_floor_at(&floors, x, 0, false, -1) == x); // along the row
    }
    TEST_CHECK(tl_detail_floor_at(&floors, 0, 2, false, -1) == 0);
    TEST_CHECK(tl_detail_floor_at(&floors, 2, 2, false, -1) == 4); // round the gap
    tl_detail_floors near = tl_detail_floors_make(&compact, 1, false, 2, 0, 0);
    TEST_CHECK(tl_detail_floor_at(&near, 6, 0, false, -1) == -1); // too far to look
    const int32_t far_away[4][3] = { { 30, 0, 30 }, { 30, 0, 31 }, { 31, 0, 31 }, { 31, 0, 30 } };
    TEST_CHECK(region_of_square(&compact, far_away, 30, 30, 0) == 0);
    tl_detail_floors none = tl_detail_floors_make(&compact, 0, true, 1, 30, 30);
    TEST_CHECK(none.region == 0 && tl_detail_floor_at(&none, 0, 0, false, 9) == 9);
    fixture_compact_free(&compact);
}

// A ridge over an attic: at the middle of the roof's polygon the mean height of its corners, at the eaves, is nearer to
// the attic's floor than to the ridge.
static void roof_over_an_attic(void **state)
{
    (void)state;
    fixture_map map = fixture_map_make(16, 4);
    for (uint32_t z = 0; z < 4; z++) {
        for (uint32_t x = 0; x < 16; x++) {
            if (x >= 5 && x < 11) {
                fixture_add_floor(&map, x, z, 17, TL_NAV_WALKABLE_AREA); // the attic
            }
            fixture_add_floor(&map, x, z, 20 + 2 * (int)(x < 8 ? x : 15 - x), TL_NAV_WALKABLE_AREA);
        }
    }
    tl_nav_compact compact = fixture_compact_make(&map, 0);
    compact.region = tl_allocate_array(NULL, compact.span_count, sizeof(uint32_t));
    compact.region_count = 4;
    for (uint32_t z = 0, i = 0; z < 4; z++) {
        for (uint32_t x = 0; x < 16; x++, i++) {
            if (compact.floor[i] == 17) {
                compact.region[i++] = 3;
            }
            compact.region[i] = x < 9 ? 1 : 2; // the roof's
        }
    }
    const int32_t eaves[4][3] = { { 0, 20, 0 }, { 0, 20, 4 }, { 16, 20, 4 }, { 16, 20, 0 } };
    const uint32_t region = region_of_square(&compact, eaves, 8, 2, 20);
    TEST_CHECK(region == 1);
    const tl_detail_floors roof = tl_detail_floors_make(&compact, region, true, 20, 8, 2);
    for (int64_t x = 0; x < 16; x++) {
        TEST_CHECK(tl_detail_floor_at(&roof, x, 1, true, 20) == 20 + 2 * (x < 8 ? x : 15 - x));
    }
    fixture_compact_free(&compact);
    fixture_map_free(&map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_storey),
        cmocka_unit_test(own_storey_beside_a_stair),
        cmocka_unit_test(walks_on),
        cmocka_unit_test(roof_over_an_attic),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
