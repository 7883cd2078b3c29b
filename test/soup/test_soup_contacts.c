// SPDX-License-Identifier: MIT
//
// Contacts with triangles: a floor of many triangles is one floor, edges that stand out stay edges, and what slides
// over the floor meets no bump.

#include "talus_test.h"

#include "contact_solver.h"

#include <talus/soup.h>

enum { CELLS = 40, MOST_CONTACTS = 128 };

typedef struct floor_mesh {
    tl_vec3 vertices[(CELLS + 1) * (CELLS + 1)];
    uint32_t indices[6 * CELLS * CELLS];
} floor_mesh;

// A floor of uneven cells, 0.3 m wide or so, with heights of the caller's.
static tl_soup *bake_floor(test_random *random, float (*height)(float x, float z))
{
    static floor_mesh m;
    for (uint32_t i = 0; i <= CELLS; i++) {
        for (uint32_t k = 0; k <= CELLS; k++) {
            float x = 0.3f * ((float)i + test_random_range(random, -0.2f, 0.2f)) - 6.0f,
                  z = 0.3f * ((float)k + test_random_range(random, -0.2f, 0.2f)) - 6.0f;
            m.vertices[i * (CELLS + 1) + k] = tl_vec3_make(x, height(x, z), z);
        }
    }
    uint32_t *at = m.indices;
    for (uint32_t i = 0; i < CELLS; i++) {
        for (uint32_t k = 0; k < CELLS; k++) {
            uint32_t a = i * (CELLS + 1) + k, b = a + 1, c = a + CELLS + 1, d = c + 1;
            bool other = test_random_below(random, 2) != 0;
            const uint32_t cell[6] = { a, b, other ? d : c, other ? a : b, d, c };
            memcpy(at, cell, sizeof cell);
            at += 6;
        }
    }
    tl_mesh_view view = { m.vertices, (CELLS + 1) * (CELLS + 1), m.indices, 2 * CELLS * CELLS, NULL };
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
    return soup;
}

static float flat_height(float x, float z)
{
    (void)x;
    (void)z;
    return 0.0f;
}

enum { SHAPES = 6 };

static tl_hull *rock;

static void make_shapes(tl_convex shapes[SHAPES], float lowest[SHAPES])
{
    test_random random = { 5 };
    tl_vec3 points[40];
    for (int i = 0; i < 40; i++) {
        points[i] = tl_scale(test_random_direction(&random), 0.7f);
        points[i].y = tl_maxf(points[i].y, -0.4f);
    }
    TEST_RESULT(tl_hull_bake(points, 40, NULL, &rock, NULL), TL_OK);
    shapes[0] = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.4f, 0.5f), 0.0f);
    shapes[1] = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.4f);
    shapes[2] = tl_convex_capsule(tl_vec3_make(-0.5f, 0, 0), tl_vec3_make(0.5f, 0, 0), 0.4f);
    shapes[3] = tl_convex_cylinder(tl_vec3_make(0, -0.4f, 0), tl_vec3_make(0, 0.4f, 0), 0.5f, 0.0f);
    shapes[4] = tl_convex_from_hull(rock, 0.0f);
    shapes[5] = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.3f, 0.5f), 0.1f);
    for (int i = 0; i < SHAPES; i++) {
        lowest[i] = tl_convex_bounds(&shapes[i], tl_transform_identity()).min.y;
    }
}

// However the shape lies, upright, on the floor: all normals are the floor's.
static void test_a_floor_is_flat(void **state)
{
    (void)state;
    test_random random = { 91 };
    tl_soup *soup = bake_floor(&random, flat_height);
    tl_convex shapes[SHAPES];
    float lowest[SHAPES];
    make_shapes(shapes, lowest);
    uint32_t plain_ghosts = 0, contacts = 0;
    for (int i = 0; i < 6000; i++) {
        int k = i % SHAPES;
        float angle = test_random_range(&random, 0, 3.1f), depth = test_random_range(&random, -0.005f, 0.02f);
        tl_transform pose = { { 0, sinf(angle), 0, cosf(angle) },
                              { test_random_range(&random, -4, 4), -lowest[k] - depth,
                                test_random_range(&random, -4, 4) } };
        tl_soup_contact found[MOST_CONTACTS];
        tl_soup_contact_query query = { &shapes[k], pose, { 0.01f, 0.01f, 0 }, NULL };
        uint32_t count;
        TEST_RESULT(tl_soup_find_contacts(soup, &query, found, MOST_CONTACTS, &count), TL_OK);
        float least = INFINITY;
        for (uint32_t c = 0; c < count; c++) {
            const tl_contact_manifold *m = &found[c].manifold;
            TEST_CHECK(found[c].is_face && m->normal.y > 0.999999f);
            for (uint32_t j = 0; j < m->count; j++) {
                least = tl_minf(least, m->contacts[j].separation);
                TEST_CHECK(fabsf(m->contacts[j].point_a.y) < 1e-5f);
                contacts++;
            }
        }
        TEST_CHECK(count > 0 && fabsf(least + depth) < 2e-5f);
        // The same triangles without a look at their neighbours.
        uint32_t near[MOST_CONTACTS];
        TEST_RESULT(tl_soup_find_overlaps(soup, &shapes[k], pose, NULL, near, MOST_CONTACTS, &count), TL_OK);
        uint64_t cursor = 0;
        tl_soup_triangle t;
        while (i % 100 < SHAPES && tl_soup_next_triangle(soup, &cursor, &t)) {
            tl_convex one = tl_convex_triangle(t.corners[0], t.corners[1], t.corners[2], 0.0f);
            tl_contact_manifold m;
            plain_ghosts +=
                tl_convex_contacts(&one, tl_transform_identity(), &shapes[k], pose, &query.limits, NULL, &m) > 0 &&
                m.normal.y < 0.99f;
        }
    }
    print_message("%u contacts; triangle by triangle %u ghosts in 360 places\n", contacts, plain_ghosts);
    TEST_CHECK(plain_ghosts > 100);
    tl_blob_free(soup);
    tl_blob_free(rock);
}

static float roof_height(float x, float z)
{
    (void)z;
    return -fabsf(x);
}

static float valley_height(float x, float z)
{
    (void)z;
    return fabsf(x) < 0.11f ? 0.0f : fabsf(x) - 0.11f;
}

// A ball on a ridge meets the ridge; one in a valley both its sides.
static void test_edges_that_stand_out(void **state)
{
    (void)state;
    const tl_vec3 ridge[] = { { 0, 0, -5 }, { 0, 0, 5 }, { -5, -5, -5 }, { -5, -5, 5 }, { 5, -5, -5 }, { 5, -5, 5 } };
    const uint32_t indices[] = { 0, 2, 3, 0, 3, 1, 0, 1, 5, 0, 5, 4 };
    tl_mesh_view view = { ridge, 6, indices, 4, NULL };
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
    tl_convex ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.5f);
    for (int i = -6; i <= 6; i++) {
        float angle = 0.1f * (float)i; // within 45 degrees: the ridge's normals
        tl_transform pose = { tl_quat_identity(), { 0.49f * sinf(angle), 0.49f * cosf(angle), 0.3f } };
        tl_soup_contact found[8];
        tl_soup_contact_query query = { &ball, pose, { 0.0f, 0.01f, 0 }, NULL };
        uint32_t count;
        TEST_RESULT(tl_soup_find_contacts(soup, &query, found, 8, &count), TL_OK);
        TEST_CHECK(count == 2); // both triangles have the ridge
        for (uint32_t c = 0; c < count; c++) {
            TEST_CHECK(!found[c].is_face && fabsf(found[c].manifold.normal.x - sinf(angle)) < 1e-4f);
            TEST_CHECK(fabsf(found[c].manifold.separation + 0.01f) < 1e-5f);
        }
    }
    tl_blob_free(soup);
}

// Bodies pushed over a frictionless floor keep their speed, and do not leave it.
static void test_sliding_without_a_bump(void **state)
{
    (void)state;
    test_random random = { 92 };
    tl_soup *soup = bake_floor(&random, flat_height);
    tl_convex shapes[SHAPES];
    float lowest[SHAPES];
    make_shapes(shapes, lowest);
    static solver s;
    for (int k = 0; k < SHAPES; k++) {
        solver_start(&s);
        s.friction = 0.0;
        tl_convex none = tl_convex_sphere(tl_vec3_make(0, -100, 0), 0.0f);
        uint32_t ground = solver_add_fixed(&s, &none, tl_vec3_make(0, 0, 0)),
                 body = solver_add(&s, &shapes[k], tl_vec3_make(-4.2f, -lowest[k] - 0.0002f, -1.1f),
                                   tl_vec3_make(0.45f, 0.4f, 0.45f));
        s.bodies[body].velocity = tl_vec3d_make(5.0, 0.0, 1.5);
        double bump = 0.0, spin = 0.0, slow = 5.0;
        for (int step = 0; step < 90; step++) {
            tl_soup_contact found[MOST_CONTACTS];
            tl_soup_contact_query query = { &shapes[k], s.bodies[body].pose, s.limits, NULL };
            uint32_t count;
            TEST_RESULT(tl_soup_find_contacts(soup, &query, found, MOST_CONTACTS, &count), TL_OK);
            TEST_CHECK(count > 0);
            solver_fall(&s);
            s.pair_count = 0;
            for (uint32_t c = 0; c < count; c++) {
                solver_link(&s, ground, body);
                s.pairs[c].manifold.count = 0;
                solver_refresh(&s, &s.pairs[c], &found[c].manifold);
            }
            solver_solve(&s);
            bump = fmax(bump, fabs(s.bodies[body].velocity.y));
            spin = fmax(spin, tl_vec3d_length(s.bodies[body].spin));
            slow = fmin(slow, s.bodies[body].velocity.x);
        }
        print_message("shape %d: largest vertical speed %.4f m/s, spin %.4f, slowest %.4f m/s\n", k, bump, spin, slow);
        TEST_CHECK(bump < 0.05 && slow > 4.95);
    }
    tl_blob_free(soup);
    tl_blob_free(rock);
}

// A capsule in a valley of bent edges touches both sides along their normals.
static void test_bent_floors(void **state)
{
    (void)state;
    test_random random = { 93 };
    float (*heights[])(float, float) = { roof_height, valley_height };
    for (int h = 0; h < 2; h++) {
        tl_soup *soup = bake_floor(&random, heights[h]);
        tl_convex ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.4f);
        uint32_t faces = 0, edges = 0;
        for (int i = 0; i < 2000; i++) {
            tl_vec3 p = tl_vec3_make(test_random_range(&random, -3, 3), 0, test_random_range(&random, -3, 3));
            p.y = heights[h](p.x, p.z) + 0.56f;
            tl_soup_contact found[MOST_CONTACTS];
            tl_soup_contact_query query = { &ball, { tl_quat_identity(), p }, { 0.05f, 0.01f, 0 }, NULL };
            uint32_t count;
            TEST_RESULT(tl_soup_find_contacts(soup, &query, found, MOST_CONTACTS, &count), TL_OK);
            for (uint32_t c = 0; c < count; c++) {
                faces += found[c].is_face;
                edges += !found[c].is_face;
                // Nothing points down or along the floor.
                TEST_CHECK(found[c].manifold.normal.y > 0.5f);
            }
        }
        print_message("%s: %u faces, %u edges\n", h == 0 ? "roof" : "valley", faces, edges);
        TEST_CHECK(faces > 500);
        tl_blob_free(soup);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_floor_is_flat),
        cmocka_unit_test(test_edges_that_stand_out),
        cmocka_unit_test(test_sliding_without_a_bump),
        cmocka_unit_test(test_bent_floors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
