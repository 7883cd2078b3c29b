// SPDX-License-Identifier: MIT
//
// Records: what is a float of the world comes back with the same bits wherever its triangle lies; a triangle has one
// cell; what has no area, or is no number, is found.
#include "talus_test.h"

#include "base/random.h"
#include "world/bytes/little_endian.h"
#include "world/store/triangle_record.h"

#include <math.h>
#include <talus/mesh.h>

static double random_coordinate(uint64_t *random)
{
    const double size = ldexp(1.0, (int)tl_random_below(random, 40) - 20);
    const double value = (tl_random_unit(random) - 0.5) * size;
    return (double)(float)value;
}

static void floats_are_exact(void **state)
{
    (void)state;
    uint64_t random = 1;
    int wide = 0, straddling = 0, taken = 0;
    for (int i = 0; i < 200000; i++) {
        tl_world_triangle triangle = { { { 0 } }, (uint8_t)i };
        double centre[3];
        for (int k = 0; k < 3; k++) {
            centre[k] = random_coordinate(&random);
        }
        for (int k = 0; k < 9; k++) {
            const double near = i % 3 == 0 ? random_coordinate(&random) : tl_random_unit(&random) * 3.0 - 1.5;
            triangle.corner[k / 3][k % 3] = (double)(float)(i % 2 == 0 ? centre[k % 3] + near : near);
        }
        tl_world_cell cell;
        unsigned char record[TL_WORLD_RECORD_BYTES];
        if (tl_world_record_encode(&triangle, 32.0, &cell, record) != TL_WORLD_TAKEN) {
            continue;
        }
        double origin[3];
        tl_world_cell_origin(&cell, 32.0, origin);
        for (int k = 0; k < 9; k++) {
            const double back = origin[k % 3] + (double)tl_get_float(record + 4 * k);
            TEST_CHECK(back == triangle.corner[k / 3][k % 3]);
        }
        TEST_CHECK(record[36] == (uint8_t)i && record[37] == 0 && record[39] == 0);
        taken++;
        wide += cell.level > 0;
        straddling += cell.x == 0 && cell.z == 0;
    }
    TEST_CHECK(taken > 150000 && wide > 20000 && straddling > 20000);
}

// Far out doubles keep what a float of the cell keeps.
static void doubles_are_near(void **state)
{
    (void)state;
    uint64_t random = 2;
    double worst = 0.0;
    for (int i = 0; i < 20000; i++) {
        tl_world_triangle triangle = { { { 0 } }, 0 };
        for (int k = 0; k < 9; k++) {
            triangle.corner[k / 3][k % 3] = (k % 3 == 0   ? 1e7
                                             : k % 3 == 1 ? 200.0
                                                          : -3e9) +
                                            20.0 * tl_random_unit(&random);
        }
        tl_world_cell cell;
        unsigned char record[TL_WORLD_RECORD_BYTES];
        double origin[3];
        TEST_CHECK(tl_world_record_encode(&triangle, 32.0, &cell, record) == TL_WORLD_TAKEN && cell.level == 0);
        tl_world_cell_origin(&cell, 32.0, origin);
        for (int k = 0; k < 9; k++) {
            const double error = origin[k % 3] + (double)tl_get_float(record + 4 * k) - triangle.corner[k / 3][k % 3];
            worst = k % 3 != 1 ? fmax(worst, fabs(error)) : worst;
        }
    }
    TEST_CHECK(worst > 0.0 && worst <= 64.0 * 0x1p-24);
}

// The same answer as tl_mesh_bake, for triangles that are thin, in line, or have equal corners.
static void no_area_as_the_mesh_says(void **state)
{
    (void)state;
    uint64_t random = 3;
    int flat = 0, thin = 0;
    static const uint32_t indices[3] = { 0, 1, 2 };
    for (int i = 0; i < 20000; i++) {
        tl_world_triangle triangle = { { { 0 } }, 0 };
        tl_vec3 corners[3];
        const float t = (float)tl_random_below(&random, 8) / 4.0f;
        for (int axis = 0; axis < 3; axis++) {
            const float a = tl_random_unit_float(&random) * 8.0f, b = tl_random_unit_float(&random) * 8.0f;
            triangle.corner[0][axis] = (double)a;
            triangle.corner[1][axis] = (double)b;
            triangle.corner[2][axis] = (double)(float)((double)a + (double)t * ((double)b - (double)a));
        }
        for (int k = 0; k < 3; k++) {
            corners[k] =
                tl_vec3_make((float)triangle.corner[k][0], (float)triangle.corner[k][1], (float)triangle.corner[k][2]);
        }
        const tl_mesh_view view = { corners, 3, indices, 1, NULL };
        tl_mesh mesh;
        const bool has_area = tl_mesh_bake(&view, NULL, &mesh, NULL) == TL_OK;
        tl_mesh_free(&mesh);
        tl_world_cell cell;
        unsigned char record[TL_WORLD_RECORD_BYTES];
        const tl_world_taken taken = tl_world_record_encode(&triangle, 16.0, &cell, record);
        TEST_CHECK(taken == (has_area ? TL_WORLD_TAKEN : TL_WORLD_NO_AREA));
        flat += !has_area;
        thin += has_area;
    }
    TEST_CHECK(flat > 1000 && thin > 1000);
}

static void bad_coordinates(void **state)
{
    (void)state;
    tl_world_triangle triangle = { { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } }, 63 };
    tl_world_cell cell;
    unsigned char record[TL_WORLD_RECORD_BYTES];
    TEST_CHECK(tl_world_record_encode(&triangle, 32.0, &cell, record) == TL_WORLD_TAKEN);
    TEST_CHECK(cell.level == 0 && cell.x == 0 && cell.y == 0 && cell.z == 0);
    triangle.corner[1][1] = (double)NAN;
    TEST_CHECK(tl_world_record_encode(&triangle, 32.0, &cell, record) == TL_WORLD_NOT_FINITE);
    triangle.corner[1][1] = (double)INFINITY;
    TEST_CHECK(tl_world_record_encode(&triangle, 32.0, &cell, record) == TL_WORLD_NOT_FINITE);
    triangle.corner[1][1] = -1e13;
    TEST_CHECK(tl_world_record_encode(&triangle, 32.0, &cell, record) == TL_WORLD_TOO_FAR);
    for (int k = 0; k < 3; k++) {
        triangle.corner[k][0] += 1e12 - 10.0; // in range, and beyond 2^30 cells of a micrometre
        triangle.corner[k][1] = 0.0;
    }
    TEST_CHECK(tl_world_record_encode(&triangle, 0x1p-20, &cell, record) == TL_WORLD_TOO_FAR);
    const tl_world_triangle large = { { { -1e12, 0, 0 }, { 1e12, 0, 0 }, { 0, 0, 1e12 } }, 63 };
    TEST_CHECK(tl_world_record_encode(&large, 32.0, &cell, record) == TL_WORLD_TAKEN && cell.level > 25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_exact),
        cmocka_unit_test(doubles_are_near),
        cmocka_unit_test(no_area_as_the_mesh_says),
        cmocka_unit_test(bad_coordinates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
