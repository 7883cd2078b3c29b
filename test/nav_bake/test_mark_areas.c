// SPDX-License-Identifier: MIT
//
// Areas marked by volumes against testing every floor's column centre.

#include "nav_fields.h"

#include <math.h>

enum { SIDE = 30, FIRST_X = 100, FIRST_Z = -40 };

static tl_nav_compact random_compact(test_random *random)
{
    tl_nav_config config = test_nav_config(SIDE, SIDE);
    config.lattice.origin = tl_vec3_make(1000.25f, 50, -300.5f);
    config.lattice.first_x = FIRST_X;
    config.lattice.first_z = FIRST_Z;
    config.cell_size = 0.5f;
    config.cell_height = 0.25f;
    tl_nav_heightfield field = test_random_heightfield(random, &config, 3);
    tl_nav_compact compact;
    TEST_RESULT(tl_nav_bake_compact(&config, &field, NULL, &compact, NULL), TL_OK);
    tl_nav_heightfield_free(&field);
    for (uint32_t i = 0; i < compact.span_count; i++) {
        compact.area[i] = (uint8_t)(i % 5 == 0 ? 0 : 40);
    }
    return compact;
}

// All values are multiples of 1/8, so the centres are exact floats.
static tl_vec3 center_of(uint32_t column, uint32_t floor_height)
{
    return tl_vec3_make(1000.25f + ((float)(FIRST_X + (int)(column % SIDE)) + 0.5f) * 0.5f,
                        50.0f + (float)floor_height * 0.25f,
                        -300.5f + ((float)(FIRST_Z + (int)(column / SIDE)) + 0.5f) * 0.5f);
}

static tl_vec3 random_point(test_random *random)
{
    tl_vec3 low = center_of(0, 0), high = center_of(SIDE * SIDE - 1, 20);
    tl_vec3 margin = { 3, 1, 3 };
    tl_vec3 p = test_random_point(random, tl_sub(low, margin), tl_add(high, margin));
    return tl_vec3_make(floorf(p.x * 8) / 8, floorf(p.y * 8) / 8, floorf(p.z * 8) / 8);
}

typedef bool inside_fn(tl_vec3 p, const void *volume);

static void compare(const tl_nav_compact *compact, uint8_t area, inside_fn *inside, const void *volume,
                    uint32_t *marked, uint32_t *spared)
{
    for (uint32_t c = 0; c < SIDE * SIDE; c++) {
        for (uint32_t i = compact->first_span[c]; i < compact->first_span[c + 1]; i++) {
            bool walkable = i % 5 != 0;
            bool in = inside(center_of(c, compact->floor[i]), volume);
            TEST_CHECK(compact->area[i] == (!walkable ? 0 : in ? area : 40));
            *marked += walkable && in;
            *spared += walkable && !in;
        }
    }
}

static bool in_box(tl_vec3 p, const void *volume)
{
    return tl_aabb_contains(*(const tl_aabb *)volume, p);
}

static void boxes(void **state)
{
    (void)state;
    test_random random = { 21 };
    uint32_t marked = 0, spared = 0;
    for (uint32_t round = 0; round < 200; round++) {
        tl_nav_compact compact = random_compact(&random);
        tl_vec3 a = random_point(&random), b = random_point(&random);
        tl_aabb box = { tl_min(a, b), tl_max(a, b) };
        uint8_t area = (uint8_t)(round % 3 == 0 ? 0 : 7);
        tl_nav_mark_box_area(&compact, box, area);
        compare(&compact, area, in_box, &box, &marked, &spared);
        tl_nav_compact_free(&compact);
    }
    TEST_CHECK(marked > 3000 && spared > 3000);
}

typedef struct cylinder {
    tl_vec3 base;
    float radius, height;
} cylinder;

static bool in_cylinder(tl_vec3 p, const void *volume)
{
    const cylinder *c = volume;
    double dx = (double)p.x - (double)c->base.x, dz = (double)p.z - (double)c->base.z;
    return dx * dx + dz * dz < (double)c->radius * (double)c->radius && p.y >= c->base.y &&
           p.y <= c->base.y + c->height;
}

static void cylinders(void **state)
{
    (void)state;
    test_random random = { 22 };
    uint32_t marked = 0, spared = 0;
    for (uint32_t round = 0; round < 200; round++) {
        tl_nav_compact compact = random_compact(&random);
        cylinder c = { random_point(&random), (float)test_random_below(&random, 50) / 8,
                       (float)test_random_below(&random, 50) / 8 };
        tl_nav_mark_cylinder_area(&compact, c.base, c.radius, c.height, 9);
        compare(&compact, 9, in_cylinder, &c, &marked, &spared);
        tl_nav_compact_free(&compact);
    }
    TEST_CHECK(marked > 1000 && spared > 3000);
}

typedef struct polygon {
    tl_vec3 points[9];
    uint32_t count;
    float min_y, max_y;
} polygon;

// The winding number, by signed crossings; a simple polygon holds the points with any but 0.
static bool in_polygon(tl_vec3 p, const void *volume)
{
    const polygon *shape = volume;
    int winding = 0;
    for (uint32_t i = 0; i < shape->count; i++) {
        tl_vec3 a = shape->points[i], b = shape->points[(i + 1) % shape->count];
        double side = ((double)b.x - (double)a.x) * ((double)p.z - (double)a.z) -
                      ((double)p.x - (double)a.x) * ((double)b.z - (double)a.z);
        if (a.z <= p.z && b.z > p.z) {
            winding += side > 0;
        } else if (a.z > p.z && b.z <= p.z) {
            winding -= side < 0;
        }
    }
    return winding != 0 && p.y >= shape->min_y && p.y <= shape->max_y;
}

static void polygons(void **state)
{
    (void)state;
    test_random random = { 23 };
    uint32_t marked = 0, spared = 0;
    for (uint32_t round = 0; round < 300; round++) {
        tl_nav_compact compact = random_compact(&random);
        polygon shape;
        shape.count = 3 + test_random_below(&random, 6);
        tl_vec3 middle = random_point(&random);
        // A star around the middle, convex or not, in either winding.
        for (uint32_t i = 0; i < shape.count; i++) {
            double angle = 6.2831853 * i / shape.count * (round % 2 ? 1 : -1);
            float radius = (float)(8 + test_random_below(&random, 70)) / 8;
            shape.points[i] = tl_add(middle, tl_vec3_make(floorf((float)cos(angle) * radius * 8) / 8, 0,
                                                          floorf((float)sin(angle) * radius * 8) / 8));
        }
        shape.min_y = middle.y - 1;
        shape.max_y = middle.y + 2;
        tl_nav_mark_polygon_area(&compact, shape.points, shape.count, shape.min_y, shape.max_y, 3);
        compare(&compact, 3, in_polygon, &shape, &marked, &spared);
        tl_nav_compact_free(&compact);
    }
    TEST_CHECK(marked > 3000 && spared > 3000);
}

// Polygons side by side mark every floor once, also where their common edge runs through centres.
static void neighbours_share_nothing(void **state)
{
    (void)state;
    test_random random = { 24 };
    tl_nav_compact compact = random_compact(&random);
    memset(compact.area, 40, compact.span_count);
    tl_vec3 low = center_of(0, 0), high = center_of(SIDE * SIDE - 1, 0), middle = center_of(SIDE * 12 + 17, 0);
    tl_vec3 corners[4] = { { low.x, 0, low.z }, { low.x, 0, high.z }, { high.x, 0, high.z }, { high.x, 0, low.z } };
    for (uint8_t k = 0; k < 4; k++) {
        tl_vec3 triangle[3] = { corners[k], corners[(k + 1) % 4], middle };
        uint8_t *before = malloc(compact.span_count);
        memcpy(before, compact.area, compact.span_count);
        tl_nav_mark_polygon_area(&compact, triangle, 3, 0, 1000, (uint8_t)(k + 1));
        for (uint32_t i = 0; i < compact.span_count; i++) {
            TEST_CHECK(before[i] == compact.area[i] || before[i] == 40);
        }
        free(before);
    }
    uint32_t left = 0;
    for (uint32_t i = 0; i < compact.span_count; i++) {
        left += compact.area[i] == 40;
    }
    // What is left lies on the far sides, which belong to nobody here.
    uint32_t far_side = 0;
    for (uint32_t c = 0; c < SIDE * SIDE; c++) {
        if (c % SIDE == SIDE - 1 || c / SIDE == SIDE - 1) {
            far_side += compact.first_span[c + 1] - compact.first_span[c];
        }
    }
    TEST_CHECK(left == far_side);
    tl_nav_compact_free(&compact);
}

static void nonsense_marks_nothing(void **state)
{
    (void)state;
    test_random random = { 25 };
    tl_nav_compact compact = random_compact(&random);
    tl_aabb box = { { NAN, 0, -1e9f }, { 1e9f, 100, 1e9f } };
    tl_nav_mark_box_area(&compact, box, 1);
    tl_nav_mark_box_area(&compact, tl_aabb_empty(), 1);
    tl_nav_mark_cylinder_area(&compact, center_of(30, 0), NAN, 10, 1);
    tl_nav_mark_cylinder_area(&compact, center_of(30, 0), -1, 10, 1);
    tl_vec3 points[3] = { { 0, 0, 0 }, { 1e9f, 0, 0 }, { INFINITY, 0, 1e9f } };
    tl_nav_mark_polygon_area(&compact, points, 2, 0, 1000, 1);
    uint32_t marked = 0, spared = 0;
    tl_aabb none = tl_aabb_empty();
    compare(&compact, 1, in_box, &none, &marked, &spared);
    TEST_CHECK(marked == 0 && spared > 100);
    box = (tl_aabb){ { -1e12f, -1e12f, -1e12f }, { 1e12f, 1e12f, 1e12f } };
    tl_nav_mark_box_area(&compact, box, 1);
    compare(&compact, 1, in_box, &box, &marked, &spared);
    TEST_CHECK(marked > 100);
    tl_nav_compact_free(&compact);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes),
        cmocka_unit_test(cylinders),
        cmocka_unit_test(polygons),
        cmocka_unit_test(neighbours_share_nothing),
        cmocka_unit_test(nonsense_marks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
