// SPDX-License-Identifier: MIT
//
// Polygons to triangles, by themselves and as faces of OBJ texts.

#include "talus_test.h"

#include "io/mesh/obj_reader.h"
#include "io/mesh/split_polygon.h"

#include <stdio.h>
#include <string.h>

static tl_imported_mesh read_good(const char *text)
{
    tl_imported_mesh mesh;
    tl_io_error error;
    if (tl_obj_read(text, strlen(text), "level.obj", false, NULL, &mesh, &error) != TL_OK) {
        fail_msg("%s", error.message);
    }
    return mesh;
}

static void check_triangle(const tl_imported_mesh *mesh, uint32_t triangle, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t *indices = mesh->indices + (size_t)triangle * 3;
    if (triangle >= mesh->triangle_count || indices[0] != a || indices[1] != b || indices[2] != c) {
        fail_msg("triangle %u is not %u %u %u", triangle, a, b, c);
    }
}

static double area_xy(const tl_imported_mesh *mesh, uint32_t triangle)
{
    const uint32_t *i = mesh->indices + (size_t)triangle * 3;
    tl_vec3 a = mesh->vertices[i[0]];
    tl_vec3 b = mesh->vertices[i[1]];
    tl_vec3 c = mesh->vertices[i[2]];
    return 0.5 * (((double)b.x - (double)a.x) * ((double)c.y - (double)a.y) -
                  ((double)b.y - (double)a.y) * ((double)c.x - (double)a.x));
}

static void test_convex_polygons_are_fans(void **state)
{
    (void)state;
    tl_imported_mesh mesh =
        read_good("v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\nf 5 4 3 2 1\nf 1 2 4 5");
    TEST_CHECK(mesh.triangle_count == 8 && mesh.face_count == 3 && mesh.polygon_count == 3 && mesh.clipped_count == 0);
    check_triangle(&mesh, 0, 0, 1, 2);
    check_triangle(&mesh, 1, 0, 2, 3);
    check_triangle(&mesh, 2, 0, 3, 4);
    check_triangle(&mesh, 3, 4, 3, 2);
    check_triangle(&mesh, 6, 0, 1, 3);
    check_triangle(&mesh, 7, 0, 3, 4);
    tl_imported_mesh_free(&mesh);
}

static void test_concave_quad(void **state)
{
    (void)state;
    // An arrow head: the fan from the first corner would leave the outline. In all three planes, and pointing ahead.
    static const char *const texts[] = {
        "v 0 0 0\nv 4 -2 0\nv 1 0 0\nv 4 2 0\nf 2 3 4 1\nf 1 2 3 4\n",
        "f 2 3 4 1\nf 1 2 3 4\nv 0 0 0\nv 0 4 -2\nv 0 1 0\nv 0 4 2\n",
        "v 0 0 0\nv -2 0 4\nv 0 0 1\nv 2 0 4\nf 2 3 4 1\nf 1 2 3 4\n",
    };
    for (int i = 0; i < 3; i++) {
        tl_imported_mesh mesh = read_good(texts[i]);
        TEST_CHECK(mesh.triangle_count == 4);
        // The diagonal from the tip to the dent is the only one, whatever the first corner is.
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t seen = 0;
            for (uint32_t c = 0; c < 3; c++) {
                seen |= 1u << mesh.indices[k * 3 + c];
            }
            TEST_CHECK((seen & 5u) == 5u);
        }
        tl_imported_mesh_free(&mesh);
    }
}

static void test_corner_in_line(void **state)
{
    (void)state;
    // A square with a corner in the middle of its first edge: no triangle without area.
    tl_imported_mesh mesh = read_good("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n");
    TEST_CHECK(mesh.triangle_count == 3 && mesh.clipped_count == 1);
    double area = 0.0;
    for (uint32_t i = 0; i < 3; i++) {
        TEST_CHECK(area_xy(&mesh, i) > 0.0);
        area += area_xy(&mesh, i);
    }
    TEST_CHECK(area == 4.0);
    tl_imported_mesh_free(&mesh);
}

static void test_degenerate_polygons(void **state)
{
    (void)state;
    tl_imported_mesh mesh =
        read_good("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 3 4\nf 1 1 1 1\nf 1 2 1 2 1\n");
    TEST_CHECK(mesh.triangle_count == 7 && mesh.polygon_count == 3);
    check_triangle(&mesh, 1, 0, 2, 3);
    tl_imported_mesh_free(&mesh);
    // A bow tie crosses itself: the larger loop's winding is kept, and the count of triangles.
    mesh = read_good("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 3 0\nf 1 2 3 4\n");
    TEST_CHECK(mesh.triangle_count == 2);
    tl_imported_mesh_free(&mesh);
}

// Random star-shaped outlines, tilted in space: the areas are positive and sum up to the outline's, so none overlaps.
static void test_random_polygons(void **state)
{
    (void)state;
    test_random random = { 7 };
    uint32_t clipped = 0;
    uint32_t fans = 0;
    for (int i = 0; i < 3000; i++) {
        enum { CAPACITY = 40 };
        static const float circle[8][2] = { { 1, 0 },  { 0.7f, 0.7f },   { 0, 1 },  { -0.7f, 0.7f },
                                            { -1, 0 }, { -0.7f, -0.7f }, { 0, -1 }, { 0.7f, -0.7f } };
        tl_vec3 vertices[CAPACITY];
        uint32_t corners[CAPACITY];
        uint32_t triangles[(CAPACITY - 2) * 3];
        tl_split_corner scratch[CAPACITY];
        uint32_t count = 0;
        // Points around the origin in order of angle, at random distances.
        for (uint32_t k = 0; k < 8; k++) {
            for (uint32_t part = 0; part < 5; part++) {
                // Four of them always, so that the outline goes around the origin and cannot cross itself.
                if (test_random_below(&random, 3) != 0 && !(part == 0 && k % 2 == 0)) {
                    continue;
                }
                float t = (float)part / 5.0f;
                const float *a = circle[k];
                const float *b = circle[(k + 1) % 8];
                float radius = i % 3 == 0 ? 1.0f : test_random_range(&random, 0.2f, 1.0f);
                vertices[count] =
                    tl_vec3_make((a[0] * (1 - t) + b[0] * t) * radius, (a[1] * (1 - t) + b[1] * t) * radius, 0.0f);
                corners[count] = count;
                count++;
            }
        }
        TEST_CHECK(count >= 4);
        bool reversed = i % 2 == 0;
        for (uint32_t k = 0; k < count; k++) {
            corners[k] = reversed ? count - 1 - k : k;
        }
        for (uint32_t k = 0; k + 2 < count; k++) {
            triangles[k * 3] = corners[0];
            triangles[k * 3 + 1] = corners[k + 1];
            triangles[k * 3 + 2] = corners[k + 2];
        }
        tl_split split = tl_split_polygon(vertices, corners, count, scratch, triangles);
        tl_imported_mesh mesh;
        memset(&mesh, 0, sizeof mesh);
        mesh.vertices = vertices;
        mesh.indices = triangles;
        double area = 0.0;
        double sum = 0.0;
        double absolute = 0.0;
        for (uint32_t k = 0; k + 2 < count; k++) {
            sum += area_xy(&mesh, k);
            absolute += fabs(area_xy(&mesh, k));
        }
        for (uint32_t k = 0; k < count; k++) {
            tl_vec3 a = vertices[corners[k]];
            tl_vec3 b = vertices[corners[(k + 1) % count]];
            area += 0.5 * ((double)a.x * (double)b.y - (double)a.y * (double)b.x);
        }
        clipped += split == TL_SPLIT_EARS;
        fans += split == TL_SPLIT_FAN;
        // A few hundred sums in doubles of size 1.
        TEST_CHECK(split != TL_SPLIT_GAVE_UP && fabs(sum - area) < 1e-12 && fabs(absolute - fabs(area)) < 1e-12);
    }
    TEST_CHECK(clipped > 1000 && fans > 10);
}

// A comb is the worst for ear clipping: still whole, at the limit of corners.
static void test_comb(void **state)
{
    (void)state;
    enum { CORNERS = TL_MAX_SPLIT_CORNERS };
    char *text = malloc(CORNERS * 40);
    size_t size = 0;
    for (int i = 0; i < CORNERS - 2; i++) {
        size += (size_t)sprintf(text + size, "v %d %d 0\n", i, i % 2 == 0 ? 10 : 1);
    }
    size += (size_t)sprintf(text + size, "v %d 0 0\nv 0 0 0\nf", CORNERS - 3);
    for (int i = 1; i <= CORNERS; i++) {
        size += (size_t)sprintf(text + size, " %d", i);
    }
    tl_imported_mesh mesh = read_good(text);
    TEST_CHECK(mesh.triangle_count == CORNERS - 2 && mesh.clipped_count == 1 && mesh.crooked_count == 0);
    for (uint32_t i = 0; i < mesh.triangle_count; i++) {
        TEST_CHECK(area_xy(&mesh, i) <= 0.0); // the outline runs clockwise
    }
    tl_imported_mesh_free(&mesh);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_convex_polygons_are_fans), cmocka_unit_test(test_concave_quad),
        cmocka_unit_test(test_corner_in_line),           cmocka_unit_test(test_degenerate_polygons),
        cmocka_unit_test(test_random_polygons),          cmocka_unit_test(test_comb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
