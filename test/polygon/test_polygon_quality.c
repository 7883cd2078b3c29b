// SPDX-License-Identifier: MIT

#include <talus/polygon.h>

#include "polygon_shapes.h"

static tl_contour_vertex vertices[64];
static oracle_point points[64];

static tl_polygon_quality measure(uint32_t n, uint32_t cap)
{
    shape_make_outer(points, n);
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = cap;
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_OK);
    tl_polygon_quality quality = tl_polygon_mesh_measure(&mesh);
    tl_polygon_mesh_free(&mesh);
    return quality;
}

static void known_shapes(void **state)
{
    (void)state;
    const oracle_point box[4] = { { 0, 0 }, { 12, 0 }, { 12, 3 }, { 0, 3 } };
    memcpy(points, box, sizeof box);
    tl_polygon_quality q = measure(4, 6);
    TEST_CHECK(q.polygon_count == 1 && q.max_corners == 4 && q.mean_corners == 4.0);
    TEST_CHECK(q.smallest_angle_cosine == 0.0 && q.mean_aspect == 4.0 && q.worst_aspect == 4.0);
    memcpy(points, box, sizeof box);
    q = measure(4, 3);
    TEST_CHECK(q.polygon_count == 2 && q.max_corners == 3);
    // The sharp corners of both halves: 12 / sqrt(153).
    TEST_CHECK(fabs(q.smallest_angle_cosine - 12.0 / sqrt(153.0)) < 1e-12);
    TEST_CHECK(fabs(q.mean_sharpest_cosine - q.smallest_angle_cosine) < 1e-12);
    // Along the diagonal sqrt(153), across it 36 / sqrt(153).
    TEST_CHECK(fabs(q.mean_aspect - 153.0 / 36.0) < 1e-12);
    // A tall triangle on a short base, which is not its longest edge.
    const oracle_point needle[3] = { { 0, 0 }, { 2, 0 }, { 1, 100 } };
    memcpy(points, needle, sizeof needle);
    q = measure(3, 6);
    TEST_CHECK(q.worst_aspect > 50.0 && q.worst_aspect < 51.0);
}

static void without_polygons_nothing_is_divided_by(void **state)
{
    (void)state;
    const oracle_point flat[3] = { { 0, 0 }, { 1, 0 }, { 2, 0 } };
    memcpy(points, flat, sizeof flat);
    tl_polygon_quality q = measure(3, 6);
    TEST_CHECK(q.polygon_count == 0 && q.smallest_angle_cosine == -1.0 && q.mean_corners == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_shapes),
        cmocka_unit_test(without_polygons_nothing_is_divided_by),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
