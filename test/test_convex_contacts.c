// SPDX-License-Identifier: MIT
//
// Contacts: boxes in all the ways they can rest, and, for hulls of all families, that each contact lies on both
// surfaces, that its separation is the one between its points, that the deepest one is as deep as the penetration query
// says, and that four contacts span what the whole patch spans.

#include "talus_test.h"

#include "convex_oracle.h"

static tl_transform at(float x, float y, float z)
{
    tl_transform t = tl_transform_identity();
    t.position = tl_vec3_make(x, y, z);
    return t;
}

static void test_boxes(void **state)
{
    (void)state;
    static const tl_vec3 corners[] = { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 },
                                       { -1, -1, 1 },  { 1, -1, 1 },  { 1, 1, 1 },  { -1, 1, 1 } };
    tl_hull *hull;
    TEST_RESULT(tl_hull_build(corners, 8, NULL, &hull, NULL), TL_OK);
    tl_convex shapes[2] = { tl_convex_from_hull(hull, 0.0f),
                            tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0.0f) };
    for (int k = 0; k < 4; k++) {
        const tl_convex *a = &shapes[k & 1], *b = &shapes[k >> 1];
        tl_contact_manifold m;
        // Face on face, in place, a little deep, a little apart.
        static const float lifts[] = { 2.0f, 1.99f, 2.01f };
        for (int i = 0; i < 3; i++) {
            TEST_CHECK(tl_convex_contacts(a, at(5, 5, 5), b, at(5, 5 + lifts[i], 5), 0.02f, 0.02f, NULL, &m) == 4);
            TEST_CHECK(fabsf(m.normal.y - 1.0f) < 1e-6f && m.status == TL_CONVEX_CONVERGED);
            for (uint32_t c = 0; c < 4; c++) {
                TEST_CHECK(fabsf(m.contacts[c].separation - (lifts[i] - 2.0f)) < 1e-5f);
                TEST_CHECK(fabsf(fabsf(m.contacts[c].point_a.x - 5) - 1) < 1e-5f &&
                           fabsf(fabsf(m.contacts[c].point_a.z - 5) - 1) < 1e-5f);
                TEST_CHECK(fabsf(m.contacts[c].point_a.y - 6) < 1e-5f);
            }
        }
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, at(0, 2.1f, 0), 0.02f, 0.02f, NULL, &m) == 0);
        // Shifted: the patch is a quarter.
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, at(1, 1.99f, 1), 0.02f, 0.02f, NULL, &m) == 4);
        for (uint32_t c = 0; c < 4; c++) {
            TEST_CHECK(m.contacts[c].point_a.x > -1e-5f && m.contacts[c].point_a.z > -1e-5f);
        }
        // Turned by 45 degrees about the normal: eight corners, the four that span most.
        tl_transform turned = at(0, 1.99f, 0);
        turned.rotation.y = 0.38268343f;
        turned.rotation.w = 0.92387953f;
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, turned, 0.02f, 0.02f, NULL, &m) == 4);
        // Standing on an edge, on a corner, edge across edge.
        tl_transform edge = at(0, 2.41f, 0);
        edge.rotation.x = 0.38268343f;
        edge.rotation.w = 0.92387953f;
        uint32_t count = tl_convex_contacts(a, at(0, 0, 0), b, edge, 0.02f, 0.02f, NULL, &m);
        TEST_CHECK(count == 2 && fabsf(m.normal.y - 1.0f) < 1e-5f);
        TEST_CHECK(fabsf(fabsf(m.contacts[0].point_a.x - m.contacts[1].point_a.x) - 2.0f) < 1e-4f);
        // A tilt of 0.02 over two metres: one edge with a small tolerance, the face with a large one.
        tl_transform tilted = at(0, 2.0f, 0);
        tilted.rotation.x = 0.005f;
        tilted.rotation.w = 0.9999875f;
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, tilted, 0.1f, 0.001f, NULL, &m) == 2);
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, tilted, 0.1f, 0.05f, NULL, &m) == 4);
    }
    tl_blob_free(hull, NULL);
}

static void test_a_triangle_carries_a_box(void **state)
{
    (void)state;
    tl_convex ground = tl_convex_triangle(tl_vec3_make(-9, 0, -9), tl_vec3_make(9, 0, -9), tl_vec3_make(0, 0, 9), 0.0f);
    tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0.25f);
    tl_convex ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1.0f);
    tl_contact_manifold m;
    TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &box, at(0, 1.24f, 0), 0.02f, 0.02f, NULL, &m) == 4);
    for (uint32_t c = 0; c < 4; c++) {
        TEST_CHECK(fabsf(m.contacts[c].separation + 0.01f) < 1e-5f && fabsf(m.contacts[c].point_b.y + 0.01f) < 1e-5f);
    }
    TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &box, at(0, -1.24f, 0), 0.02f, 0.02f, NULL, &m) == 4);
    TEST_CHECK(m.normal.y < -0.999f);
    TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &ball, at(0, 0.99f, 0), 0.02f, 0.02f, NULL, &m) == 1);
    TEST_CHECK(fabsf(m.contacts[0].separation + 0.01f) < 1e-5f);
}

// Distance of a point from a body, below this many metres.
static bool near_body(const test_body *body, tl_transform pose, tl_vec3 point, float slack)
{
    tl_convex probe = tl_convex_sphere(tl_vec3_make(0, 0, 0), 0.0f);
    tl_separation s;
    tl_convex_distance(&body->shape, pose, &probe, at(point.x, point.y, point.z), NULL, &s);
    return s.distance <= slack;
}

static void test_contacts_of_all_families(void **state)
{
    (void)state;
    test_random random = { 41 };
    uint32_t by_count[TL_MAX_CONTACTS + 1] = { 0 }, rested = 0;
    for (int i = 0; i < 1500; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_COUNT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 7 % BODY_COUNT), (uint64_t)i + 1, 1.0f);
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 3 == 0 ? GAP_SHALLOW : i % 3 == 1 ? GAP_TOUCHING : GAP_1E_4, &pose_a, &pose_b);
        float size = tl_maxf(a.size, b.size), tolerance = 0.01f * size;
        if (i % 4 == 0 && a.hull != NULL && b.hull != NULL) {
            // Lay a face of b on a face of a.
            tl_hull_plane pa = tl_hull_face_plane(a.hull, 0), pb = tl_hull_face_plane(b.hull, 0);
            tl_vec3 na = tl_vec3_make((float)pa.normal[0], (float)pa.normal[1], (float)pa.normal[2]);
            tl_vec3 nb = tl_vec3_make(-(float)pb.normal[0], -(float)pb.normal[1], -(float)pb.normal[2]);
            tl_vec3 axis = tl_cross(nb, na);
            tl_quat turn = { axis.x, axis.y, axis.z, 1.0f + tl_dot(na, nb) };
            pose_a = tl_transform_identity();
            pose_b.rotation = tl_quat_normalize(turn);
            tl_vec3 ca = tl_hull_vertices(a.hull)[tl_hull_half_edges(a.hull)[tl_hull_faces(a.hull)->first].origin];
            tl_vec3 cb = tl_hull_vertices(b.hull)[tl_hull_half_edges(b.hull)[tl_hull_faces(b.hull)->first].origin];
            pose_b.position = tl_sub(tl_mul_add(ca, na, 1e-4f * size), tl_rotate(pose_b.rotation, cb));
        }
        tl_contact_manifold m;
        tl_convex_contacts(&a.shape, pose_a, &b.shape, pose_b, tolerance, tolerance, NULL, &m);
        tl_penetration p;
        tl_separation s;
        bool overlap = tl_convex_penetration(&a.shape, pose_a, &b.shape, pose_b, NULL, &p);
        tl_convex_distance(&a.shape, pose_a, &b.shape, pose_b, NULL, &s);
        float deepest = overlap ? -p.depth : s.distance;
        TEST_CHECK((m.count > 0) == (deepest <= tolerance));
        by_count[m.count]++;
        rested += m.count >= 3;
        for (uint32_t c = 0; c < m.count; c++) {
            const tl_contact *contact = &m.contacts[c];
            TEST_CHECK(contact->separation >= deepest - 2e-6f * size &&
                       contact->separation <= deepest + tolerance * 1.001f);
            TEST_CHECK(tl_distance(tl_mul_add(contact->point_a, m.normal, contact->separation), contact->point_b) <=
                       4e-6f * size);
            TEST_CHECK(near_body(&a, pose_a, contact->point_a, 1e-5f * size) &&
                       near_body(&b, pose_b, contact->point_b, 1e-5f * size));
            for (uint32_t d = 0; d < c; d++) {
                TEST_CHECK(tl_distance(contact->point_a, m.contacts[d].point_a) > 0.0f);
            }
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("contacts 0 to 4: %u %u %u %u %u\n", by_count[0], by_count[1], by_count[2], by_count[3], by_count[4]);
    TEST_CHECK(by_count[1] > 100 && by_count[2] > 20 && rested > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_a_triangle_carries_a_box),
        cmocka_unit_test(test_contacts_of_all_families),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
