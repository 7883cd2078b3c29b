// SPDX-License-Identifier: MIT
//
// Areas by material: the lookup, and what becomes of it where floors of two materials meet in one voxel.

#include "nav_level.h"

static void each_triangle_has_its_materials_area(void **state)
{
    (void)state;
    uint16_t materials[5] = { 0, 2, 1, 3, 65535 };
    const uint8_t material_areas[3] = { 7, 0, 255 };
    uint8_t areas[5];
    tl_mesh_view mesh = { NULL, 0, NULL, 5, materials };
    tl_nav_areas_from_materials(&mesh, material_areas, 3, areas);
    const uint8_t expected[5] = { 7, 255, 0, TL_NAV_WALKABLE_AREA, TL_NAV_WALKABLE_AREA };
    TEST_CHECK(memcmp(areas, expected, sizeof areas) == 0);
    mesh.materials = NULL; // all material 0
    tl_nav_areas_from_materials(&mesh, material_areas, 3, areas);
    TEST_CHECK(areas[0] == 7 && areas[4] == 7);
    tl_nav_areas_from_materials(&mesh, NULL, 0, areas);
    TEST_CHECK(areas[0] == TL_NAV_WALKABLE_AREA && areas[4] == TL_NAV_WALKABLE_AREA);
}

// A floor of 10 by 10 m, and on it a road of 2 m across; both in the same layer of voxels.
static double area_of_road(uint8_t floor_area, uint8_t road_area, float road_height)
{
    test_level level;
    memset(&level, 0, sizeof level);
    test_level_quad(&level, tl_vec3_make(0, 0, 0), tl_vec3_make(0, 0, 10), tl_vec3_make(10, 0, 10),
                    tl_vec3_make(10, 0, 0));
    test_level_quad(&level, tl_vec3_make(4, road_height, 0), tl_vec3_make(4, road_height, 10),
                    tl_vec3_make(6, road_height, 10), tl_vec3_make(6, road_height, 0));
    level.mesh.vertices = level.vertices;
    level.mesh.indices = level.indices;
    uint16_t materials[4] = { 0, 0, 1, 1 };
    level.mesh.materials = materials;
    const uint8_t material_areas[2] = { floor_area, road_area };
    uint8_t areas[4];
    tl_nav_areas_from_materials(&level.mesh, material_areas, 2, areas);
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.cell_height = 0.25f;
    def.agent_radius = 0.0f;
    const tl_nav_input input = { level.mesh, areas, NULL, 0 };
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
    double sum = 0.0;
    for (uint32_t p = 0; p < tiles.tiles[0]->polygon_count; p++) {
        sum += tl_nav_tile_area(tiles.tiles[0], p) == road_area ? tl_nav_tile_polygon_area(tiles.tiles[0], p) : 0.0;
    }
    tl_nav_tiles_free(&tiles);
    return sum;
}

static void the_larger_area_wins_in_a_voxel(void **state)
{
    (void)state;
    const double whole = 2.0 * (10.0 - 2 * 0.25); // the rim is a ledge
    TEST_CHECK(fabs(area_of_road(TL_NAV_WALKABLE_AREA, 200, 0.0f) - whole) < 1e-6);
    TEST_CHECK(fabs(area_of_road(TL_NAV_WALKABLE_AREA, 200, 0.1f) - whole) < 1e-6);
    TEST_CHECK(area_of_road(TL_NAV_WALKABLE_AREA, 62, 0.0f) == 0.0);
    TEST_CHECK(fabs(area_of_road(5, 62, 0.0f) - whole) < 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(each_triangle_has_its_materials_area),
                                        cmocka_unit_test(the_larger_area_wins_in_a_voxel) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
