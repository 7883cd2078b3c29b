// SPDX-License-Identifier: MIT
//
// The proof by one sweep that polygons do not overlap, against trying every pair: random triangles anywhere, and meshes
// of random contours, whole and with one polygon replaced.

#include "polygon/check/polygon_check.h"
#include "polygon_proof.h"
#include "polygon_random_shapes.h"
#include "polygon_shapes.h"

enum { MAX_TRIANGLES = 12 };

static bool is_proven(const tl_polygon_mesh *mesh)
{
    tl_polygon_checker checker;
    memset(&checker, 0, sizeof checker);
    checker.mesh = mesh;
    tl_arena_init(&checker.arena, NULL);
    tl_sort_item *order = calloc(mesh->polygon_count, sizeof *order);
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        order[p].value = p;
    }
    bool proven;
    TEST_RESULT(tl_polygon_sweep_cover(&checker, order, mesh->polygon_count, &proven), TL_OK);
    tl_arena_free(&checker.arena);
    free(order);
    return proven;
}

static bool is_apart(const tl_polygon_mesh *m)
{
    bool apart = true;
    for (uint32_t p = 0; p < m->polygon_count && apart; p++) {
        for (uint32_t q = 0; q < p && apart; q++) {
            apart = proof_is_parted(m, p, q) || proof_is_parted(m, q, p);
        }
        for (uint32_t place = 0; place < m->index_count && apart; place++) {
            const oracle_point at = proof_corner(m, place);
            for (uint32_t k = m->first[p]; k < m->first[p + 1] && apart; k++) {
                const oracle_point a = proof_corner(m, k), b = proof_corner(m, proof_next(m, p, k));
                apart = oracle_same(a, at) || oracle_same(b, at) || !oracle_between(a, b, at);
            }
        }
    }
    return apart;
}

static void triangles_as_all_pairs_say(void **state)
{
    (void)state;
    test_random random = { 92 };
    uint32_t clean = 0, faulty = 0;
    for (uint32_t round = 0; round < 20000; round++) {
        int32_t vertices[9 * MAX_TRIANGLES];
        uint32_t first[MAX_TRIANGLES + 1], indices[3 * MAX_TRIANGLES];
        tl_polygon_mesh mesh;
        memset(&mesh, 0, sizeof mesh);
        mesh.vertices = vertices;
        mesh.first = first;
        mesh.indices = indices;
        const uint32_t wanted = 1 + test_random_below(&random, round % 2 ? 4 : MAX_TRIANGLES);
        const uint32_t side = 2u << test_random_below(&random, 7), reach = 2 + test_random_below(&random, 5);
        first[0] = 0;
        while (mesh.polygon_count < wanted) {
            oracle_point corners[3];
            shape_random_points(&random, corners, 3, reach);
            shape_make_outer(corners, 3);
            const int32_t x = (int32_t)test_random_below(&random, side), z = (int32_t)test_random_below(&random, side);
            for (uint32_t k = 0; k < 3 && oracle_contour_area2(corners, 3) > 0; k++) {
                vertices[3 * mesh.vertex_count] = (int32_t)corners[k].x + x - 3;
                vertices[3 * mesh.vertex_count + 1] = 0;
                vertices[3 * mesh.vertex_count + 2] = (int32_t)corners[k].z + z - 3;
                indices[mesh.index_count++] = mesh.vertex_count++;
            }
            mesh.polygon_count = mesh.index_count / 3;
            first[mesh.polygon_count] = mesh.index_count;
        }
        const bool apart = is_apart(&mesh);
        TEST_CHECK(is_proven(&mesh) == apart);
        clean += apart;
        faulty += !apart;
    }
    TEST_CHECK(clean > 3000 && faulty > 3000);
}

// A triangle of a mesh moves to where another one is, or grows.
static void spoil(tl_polygon_mesh *mesh, test_random *random)
{
    const uint32_t place = test_random_below(random, mesh->index_count);
    if (test_random_below(random, 2) == 0) {
        const uint32_t p = test_random_below(random, mesh->polygon_count), q = (p + 1) % mesh->polygon_count;
        for (uint32_t k = 0; k < 3; k++) {
            mesh->indices[mesh->first[p] + k] = mesh->indices[mesh->first[q] + k];
        }
    } else {
        mesh->vertices[3 * mesh->indices[place]] += (int32_t)test_random_below(random, 21) - 10;
    }
}

static bool has_shape(const tl_polygon_mesh *mesh)
{
    bool good = true;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        good = good && proof_polygon_area2(mesh, p) > 0;
    }
    return good;
}

static void meshes_as_all_pairs_say(void **state)
{
    (void)state;
    enum { N = 60 };
    test_random random = { 93 };
    uint32_t clean = 0, faulty = 0;
    for (uint32_t round = 0; round < 600; round++) {
        oracle_point points[2 * N];
        if (round % 3 == 0) {
            shape_random_star(&random, points, N, 60.0, 0.2);
        } else if (round % 3 == 1) {
            shape_random_comb(&random, points, N, 50);
        } else {
            shape_random_spiral(&random, points, N, 400.0);
        }
        tl_contour_vertex vertices[2 * N];
        tl_contour contour;
        tl_contour_set set = shape_as_set(points, N, vertices, &contour);
        tl_polygon_def def = tl_default_polygon_def();
        def.max_verts_per_poly = 3;
        tl_polygon_mesh mesh;
        TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_OK);
        for (uint32_t spoilt = 0; spoilt < 4 && mesh.polygon_count > 1; spoilt++) {
            if (has_shape(&mesh)) {
                const bool apart = is_apart(&mesh);
                TEST_CHECK(is_proven(&mesh) == apart && (apart || spoilt > 0 || mesh.note_count > 0));
                clean += apart;
                faulty += !apart;
            }
            spoil(&mesh, &random);
        }
        tl_polygon_mesh_free(&mesh);
    }
    TEST_CHECK(clean > 500 && faulty > 300);
}

// A polygon within another one has no edge or corner in common with it.
static void islands_are_seen(void **state)
{
    (void)state;
    int32_t vertices[3 * 8] = { 0, 0, 0, 0, 0, 90, 90, 0, 0, 10, 0, 10, 10, 0, 20, 20, 0, 10 };
    uint32_t first[3] = { 0, 3, 6 }, indices[6] = { 0, 1, 2, 3, 4, 5 };
    tl_polygon_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    mesh.vertex_count = 6;
    mesh.polygon_count = 2;
    mesh.index_count = 6;
    mesh.vertices = vertices;
    mesh.first = first;
    mesh.indices = indices;
    TEST_CHECK(!is_proven(&mesh)); // one inside the other
    vertices[9] = vertices[12] = 110;
    vertices[15] = 120;
    TEST_CHECK(is_proven(&mesh)); // beside it
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(triangles_as_all_pairs_say),
        cmocka_unit_test(meshes_as_all_pairs_say),
        cmocka_unit_test(islands_are_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
