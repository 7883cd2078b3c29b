// SPDX-License-Identifier: MIT
//
// What a hull takes, and that it is the same hull in words of one, two and four bytes: loops and twins, sources, cells
// of the direction table.

#include "talus_test.h"

#include "hull/support/hull_support.h"
#include "hull_shapes.h"

#include <talus/hull.h>

static tl_hull *bake_cloud(const tl_vec3 *points, uint32_t count)
{
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
    return hull;
}

static tl_hull *bake_sphere(uint32_t count)
{
    tl_vec3 *points = malloc(count * sizeof *points);
    test_random random = { count };
    tl_hull *hull = bake_cloud(points, shape_make(SHAPE_SPHERE, &random, points, count));
    free(points);
    return hull;
}

static void box_corners(tl_vec3 corners[8])
{
    for (uint32_t i = 0; i < 8; i++) {
        corners[i] = tl_vec3_make(i & 1u ? 1.0f : -1.0f, i & 2u ? 2.0f : -2.0f, i & 4u ? 0.5f : -0.5f);
    }
}

static void test_small_hulls_are_small(void **state)
{
    (void)state;
    tl_vec3 corners[8];
    box_corners(corners);
    tl_hull *box = bake_cloud(corners, 8), *tetrahedron = bake_sphere(4), *ball = bake_sphere(32);
    TEST_CHECK(box->face_count == 6 && box->blob.size == 640);
    TEST_CHECK(tetrahedron->blob.size <= 512);
    TEST_CHECK(ball->blob.size <= 32 * 280);
    tl_blob_free(box);
    tl_blob_free(tetrahedron);
    tl_blob_free(ball);
    tl_hull *large = bake_sphere(4096);
    TEST_CHECK(large->blob.size <= 4096 * 290);
    tl_blob_free(large);
}

// The sources are the points that the corners are.
static void check_sources(const tl_hull *hull, const tl_vec3 *points, uint32_t width)
{
    TEST_CHECK(tl_hull_source_bytes(hull) == width);
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        TEST_CHECK(tl_distance(tl_hull_vertices(hull)[v], points[tl_hull_source(hull, v)]) == 0.0f);
    }
}

// Corners at the end of a cloud, behind points inside of their box.
static void test_sources_of_all_widths(void **state)
{
    (void)state;
    enum { MOST = 70000 };
    const struct {
        uint32_t inner, width;
    } cases[] = { { 0, 0 }, { 1, 1 }, { 248, 1 }, { 249, 2 }, { 65528, 2 }, { 65529, 4 } };
    tl_vec3 *points = malloc(MOST * sizeof *points);
    test_random random = { 3 };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (uint32_t k = 0; k < cases[i].inner; k++) {
            points[k] = test_random_point(&random, tl_vec3_make(-1, -2, -0.5f), tl_vec3_make(1, 2, 0.5f));
        }
        box_corners(points + cases[i].inner);
        tl_hull *hull = bake_cloud(points, cases[i].inner + 8), *moved;
        check_sources(hull, points, cases[i].width);
        // A copy names the points of the first bake, in as many bytes.
        const tl_transform pose = { { 0.0f, 0.0f, 0.0f, 1.0f }, { 4.0f, 0.0f, 0.0f } };
        TEST_RESULT(tl_hull_transform(hull, tl_vec3_make(2, 2, 2), pose, NULL, &moved, NULL), TL_OK);
        TEST_CHECK(tl_hull_source_bytes(moved) == tl_hull_source_bytes(hull) && shape_is_same_topology(moved, hull));
        TEST_RESULT(tl_hull_check(moved, moved->blob.size, NULL), TL_OK);
        tl_blob_free(moved);
        tl_blob_free(hull);
    }
    free(points);
}

// Loops, twins and rings as an editable mesh has them, which is built from the loops alone.
static void check_topology(const tl_hull *hull)
{
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    TEST_RESULT(tl_hull_to_halfedge(hull, &mesh), TL_OK);
    for (uint32_t h = 0; h < hull->half_edge_count; h++) {
        const tl_hull_half_edge edge = tl_hull_edge_at(hull, h), twin = tl_hull_edge_at(hull, edge.twin);
        const uint32_t at = tl_halfedge_mesh_find_edge(&mesh, edge.origin, twin.origin);
        TEST_CHECK(at != TL_HALFEDGE_NONE && tl_halfedge_left_face(&mesh, at) == edge.face);
        TEST_CHECK(twin.twin == h && tl_hull_edge_origin(hull, edge.next) == twin.origin);
    }
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        TEST_CHECK(tl_hull_edge_origin(hull, tl_hull_vertex_edge(hull, v)) == v);
    }
    tl_halfedge_mesh_destroy(&mesh);
}

static void check_support(const tl_hull *hull, test_random *random)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    for (int i = 0; i < 40; i++) {
        const tl_vec3 d = test_random_direction(random);
        uint32_t best = 0;
        for (uint32_t v = 1; v < hull->vertex_count; v++) {
            best = tl_dot(d, vertices[v]) > tl_dot(d, vertices[best]) ? v : best;
        }
        const uint32_t found = tl_hull_support(hull, d, i % 2 == 0 ? TL_NO_VERTEX : best);
        TEST_CHECK(tl_dot(d, vertices[found]) >= tl_dot(d, vertices[best]) - 1e-6f);
    }
}

static void test_words_of_all_widths(void **state)
{
    (void)state;
    // 6 V - 12 half-edges: 246 are the most of one byte with vertices on a sphere, and 65,532 of two.
    const struct {
        uint32_t vertices, index_bytes, cell_bytes;
    } cases[] = { { 4, 1, 0 },     { 8, 1, 0 },     { 9, 1, 0 },    { 16, 1, 0 }, { 17, 1, 2 },
                  { 44, 1, 2 },    { 45, 2, 2 },    { 48, 2, 2 },   { 49, 2, 2 }, { 10924, 2, 2 },
                  { 10925, 4, 2 }, { 32768, 4, 2 }, { 32769, 4, 4 } };
    test_random random = { 4 };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tl_hull *hull = bake_sphere(cases[i].vertices);
        TEST_CHECK(hull->vertex_count == cases[i].vertices && hull->half_edge_count == 6 * hull->vertex_count - 12);
        TEST_CHECK(hull->index_bytes == cases[i].index_bytes);
        TEST_CHECK(hull->vertex_count <= TL_HULL_FEW || tl_hull_climb_head(hull)->cell_bytes == cases[i].cell_bytes);
        check_topology(hull);
        check_support(hull, &random);
        tl_blob_free(hull);
    }
}

// Faces whose planes stand in short rows: 4 and 5 lanes are padded to 4 and 6.
static void test_short_rows_of_planes(void **state)
{
    (void)state;
    const tl_vec3 pyramid[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 0, 2 }, { 0, 0, 2 }, { 1, 1, 1 } };
    tl_hull *hulls[] = { bake_cloud(pyramid + 1, 4), bake_cloud(pyramid, 5), bake_sphere(5) };
    const uint32_t faces[] = { 4, 5, 6 }, lanes[] = { 4, 6, 6 };
    for (int i = 0; i < 3; i++) {
        TEST_CHECK(hulls[i]->face_count == faces[i] && tl_hull_plane_lanes(hulls[i]) == lanes[i]);
        for (uint32_t f = 0; f < faces[i]; f++) {
            const tl_hull_plane plane = tl_hull_face_plane(hulls[i], f);
            const tl_vec3 p = tl_hull_corner(hulls[i], tl_hull_face_first(hulls[i], f));
            const double at =
                plane.normal[0] * (double)p.x + plane.normal[1] * (double)p.y + plane.normal[2] * (double)p.z;
            TEST_CHECK(fabs(at - plane.offset) < 1e-12);
        }
        tl_blob_free(hulls[i]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_hulls_are_small),
        cmocka_unit_test(test_sources_of_all_widths),
        cmocka_unit_test(test_words_of_all_widths),
        cmocka_unit_test(test_short_rows_of_planes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
