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
    TEST_RESULT(tl_hull_bake(corners, 8, NULL, &hull, NULL), TL_OK);
    tl_convex shapes[2] = { tl_convex_from_hull(hull, 0.0f),
                            tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0.0f) };
    for (int k = 0; k < 4; k++) {
        const tl_convex *a = &shapes[k & 1], *b = &shapes[k >> 1];
        tl_contact_manifold m;
        // Face on face, in place, a little deep, a little apart.
        static const float lifts[] = { 2.0f, 1.99f, 2.01f };
        for (int i = 0; i < 3; i++) {
            TEST_CHECK(tl_convex_contacts(a, at(5, 5, 5), b, at(5, 5 + lifts[i], 5),
                                          &(tl_contact_limits){ 0.02f, 0.02f, 0 }, NULL, &m) == 4);
            TEST_CHECK(fabsf(m.normal.y - 1.0f) < 1e-6f && m.status == TL_CONVEX_CONVERGED);
            for (uint32_t c = 0; c < 4; c++) {
                TEST_CHECK(fabsf(m.contacts[c].separation - (lifts[i] - 2.0f)) < 1e-5f);
                TEST_CHECK(fabsf(fabsf(m.contacts[c].point_a.x - 5) - 1) < 1e-5f &&
                           fabsf(fabsf(m.contacts[c].point_a.z - 5) - 1) < 1e-5f);
                TEST_CHECK(fabsf(m.contacts[c].point_a.y - 6) < 1e-5f);
            }
        }
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, at(0, 2.1f, 0), &(tl_contact_limits){ 0.02f, 0.02f, 0 }, NULL,
                                      &m) == 0);
        // Shifted: the patch is a quarter.
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, at(1, 1.99f, 1), &(tl_contact_limits){ 0.02f, 0.02f, 0 }, NULL,
                                      &m) == 4);
        for (uint32_t c = 0; c < 4; c++) {
            TEST_CHECK(m.contacts[c].point_a.x > -1e-5f && m.contacts[c].point_a.z > -1e-5f);
        }
        // Turned by 45 degrees about the normal: eight corners, the four that span most.
        tl_transform turned = at(0, 1.99f, 0);
        turned.rotation.y = 0.38268343f;
        turned.rotation.w = 0.92387953f;
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, turned, &(tl_contact_limits){ 0.02f, 0.02f, 0 }, NULL, &m) ==
                   4);
        // Standing on an edge, on a corner, edge across edge.
        tl_transform edge = at(0, 2.41f, 0);
        edge.rotation.x = 0.38268343f;
        edge.rotation.w = 0.92387953f;
        uint32_t count = tl_convex_contacts(a, at(0, 0, 0), b, edge, &(tl_contact_limits){ 0.02f, 0.02f, 0 }, NULL, &m);
        TEST_CHECK(count == 2 && fabsf(m.normal.y - 1.0f) < 1e-5f);
        TEST_CHECK(fabsf(fabsf(m.contacts[0].point_a.x - m.contacts[1].point_a.x) - 2.0f) < 1e-4f);
        // A tilt of 0.02 over two metres: one edge with a small tolerance, the face with a large one.
        tl_transform tilted = at(0, 2.0f, 0);
        tilted.rotation.x = 0.005f;
        tilted.rotation.w = 0.9999875f;
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, tilted, &(tl_contact_limits){ 0.1f, 0.001f, 0 }, NULL, &m) ==
                   2);
        TEST_CHECK(tl_convex_contacts(a, at(0, 0, 0), b, tilted, &(tl_contact_limits){ 0.1f, 0.05f, 0 }, NULL, &m) ==
                   4);
    }
    tl_blob_free(hull);
}

static void test_a_triangle_carries_a_box(void **state)
{
    (void)state;
    tl_convex ground = tl_convex_triangle(tl_vec3_make(-9, 0, -9), tl_vec3_make(9, 0, -9), tl_vec3_make(0, 0, 9), 0.0f);
    tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0.25f);
    tl_convex ball = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1.0f);
    tl_contact_manifold m;
    TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &box, at(0, 1.24f, 0), &(tl_contact_limits){ 0.02f, 0.02f, 0 },
                                  NULL, &m) == 4);
    for (uint32_t c = 0; c < 4; c++) {
        TEST_CHECK(fabsf(m.contacts[c].separation + 0.01f) < 1e-5f && fabsf(m.contacts[c].point_b.y + 0.01f) < 1e-5f);
    }
    TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &box, at(0, -1.24f, 0), &(tl_contact_limits){ 0.02f, 0.02f, 0 },
                                  NULL, &m) == 4);
    TEST_CHECK(m.normal.y < -0.999f);
    TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &ball, at(0, 0.99f, 0), &(tl_contact_limits){ 0.02f, 0.02f, 0 },
                                  NULL, &m) == 1);
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

static float coordinate_of(const test_body *body)
{
    if (body->hull == NULL) {
        return body->size;
    }
    tl_vec3 size = tl_max(tl_abs(body->hull->bounds.min), tl_abs(body->hull->bounds.max));
    return tl_maxf(size.x, tl_maxf(size.y, size.z));
}

// What every manifold of a pair must be. Returns the number of contacts.
static uint32_t check_manifold(const test_body *a, tl_transform pose_a, const test_body *b, tl_transform pose_b)
{
    float size = tl_maxf(a->size, b->size), tolerance = 0.01f * size;
    tl_contact_manifold m;
    tl_convex_contacts(&a->shape, pose_a, &b->shape, pose_b, &(tl_contact_limits){ tolerance, tolerance, 0 }, NULL, &m);
    tl_penetration p;
    tl_separation s;
    bool overlap = tl_convex_penetration(&a->shape, pose_a, &b->shape, pose_b, NULL, &p);
    tl_convex_distance(&a->shape, pose_a, &b->shape, pose_b, NULL, &s);
    float deepest = overlap ? -p.depth : s.distance;
    // Coordinates far from a body's own origin are rounded, and sides are plane to eight of these roundings.
    float slack = 2e-6f * size + 5e-7f * tl_maxf(coordinate_of(a), coordinate_of(b));
    TEST_CHECK((m.count > 0) == (deepest <= tolerance));
    float least = m.count > 0 ? m.contacts[0].separation : 0.0f;
    for (uint32_t c = 1; c < m.count; c++) {
        least = tl_minf(least, m.contacts[c].separation);
    }
    TEST_CHECK(m.count == 0 || least <= deepest + slack);
    for (uint32_t c = 0; c < m.count; c++) {
        const tl_contact *contact = &m.contacts[c];
        TEST_CHECK(contact->separation >= deepest - slack &&
                   contact->separation <= deepest + tolerance * 1.001f + slack);
        TEST_CHECK(tl_distance(tl_mul_add(contact->point_a, m.normal, contact->separation), contact->point_b) <=
                   2 * slack);
        TEST_CHECK(near_body(a, pose_a, contact->point_a, 5 * slack) &&
                   near_body(b, pose_b, contact->point_b, 5 * slack));
        for (uint32_t d = 0; d < c; d++) {
            // Far from the origin two may be rounded to one place.
            TEST_CHECK(tl_distance(contact->point_a, m.contacts[d].point_a) > 0.0f ||
                       tl_length(contact->point_a) > tl_minf(a->size, b->size));
        }
    }
    return m.count;
}

static tl_vec3 middle_of_face(const tl_hull *hull, uint32_t face)
{
    tl_hull_face f = tl_hull_face_at(hull, face);
    tl_vec3 sum = tl_vec3_make(0, 0, 0);
    for (uint32_t i = 0; i < f.count; i++) {
        sum = tl_add(sum, tl_hull_vertices(hull)[tl_hull_edge_origin(hull, f.first + i)]);
    }
    return tl_scale(sum, 1.0f / (float)f.count);
}

// Face `face_b` of b on face `face_a` of a, a little apart.
static void lay_on(const test_body *a, uint32_t face_a, const test_body *b, uint32_t face_b, tl_transform *pose_a,
                   tl_transform *pose_b)
{
    tl_hull_plane pa = tl_hull_face_plane(a->hull, face_a), pb = tl_hull_face_plane(b->hull, face_b);
    tl_vec3 na = tl_vec3_make((float)pa.normal[0], (float)pa.normal[1], (float)pa.normal[2]);
    tl_vec3 nb = tl_vec3_make(-(float)pb.normal[0], -(float)pb.normal[1], -(float)pb.normal[2]);
    tl_vec3 axis = tl_cross(nb, na);
    tl_quat turn = { axis.x, axis.y, axis.z, 1.0f + tl_dot(na, nb) };
    *pose_a = tl_transform_identity();
    pose_b->rotation = turn.w > 1e-3f ? tl_quat_normalize(turn) : turn;
    pose_b->position = tl_sub(tl_mul_add(middle_of_face(a->hull, face_a), na, 1e-4f * tl_maxf(a->size, b->size)),
                              tl_rotate(pose_b->rotation, middle_of_face(b->hull, face_b)));
}

static void test_contacts_of_all_families(void **state)
{
    (void)state;
    test_random random = { 41 };
    uint32_t by_count[TL_MAX_CONTACTS + 1] = { 0 };
    for (int i = 0; i < 1500; i++) {
        test_body a, b;
        test_body_make(&a, (body_family)(i % BODY_COUNT), (uint64_t)i, 1.0f);
        test_body_make(&b, (body_family)(i / 7 % BODY_COUNT), (uint64_t)i + 1, 1.0f);
        tl_transform pose_a, pose_b;
        test_place(&random, &a, &b, i % 3 == 0 ? GAP_SHALLOW : i % 3 == 1 ? GAP_TOUCHING : GAP_1E_4, &pose_a, &pose_b);
        if (i % 4 == 0 && a.hull != NULL && b.hull != NULL) {
            lay_on(&a, 0, &b, 0, &pose_a, &pose_b);
        }
        by_count[check_manifold(&a, pose_a, &b, pose_b)]++;
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("contacts 0 to 4: %u %u %u %u %u\n", by_count[0], by_count[1], by_count[2], by_count[3], by_count[4]);
    TEST_CHECK(by_count[1] > 100 && by_count[2] > 20 && by_count[3] + by_count[4] > 50);
}

typedef struct cloud_bodies {
    test_body *bodies;
    uint32_t count, capacity;
} cloud_bodies;

static void add_cloud(tl_vec3 *points, uint32_t count, void *user)
{
    cloud_bodies *all = user;
    test_body body;
    if (all->count == all->capacity || tl_hull_bake(points, count, NULL, &body.hull, NULL) != TL_OK) {
        return;
    }
    body.shape = tl_convex_from_hull(body.hull, 0.0f);
    tl_vec3 size = tl_aabb_size(body.hull->bounds);
    body.size = tl_maxf(size.x, tl_maxf(size.y, size.z));
    all->bodies[all->count++] = body;
}

// Real clouds where there are some, else points in a ball; each on faces of others, dropped and pressed together.
static void test_contacts_of_clouds(void **state)
{
    (void)state;
    cloud_bodies all = { NULL, 0, 400 };
    all.bodies = malloc(all.capacity * sizeof *all.bodies);
    test_random random = { 42 };
    shape_each_cloud(TALUS_DATA_DIR "/hulls/hulls_dev.txt", add_cloud, &all);
    while (all.count < 40) {
        tl_vec3 points[200];
        add_cloud(points, shape_make(SHAPE_BALL, &random, points, 200), &all);
    }
    uint32_t by_count[TL_MAX_CONTACTS + 1] = { 0 }, laid[TL_MAX_CONTACTS + 1] = { 0 };
    for (int i = 0; i < 4000; i++) {
        const test_body *a = &all.bodies[test_random_below(&random, all.count)],
                        *b = &all.bodies[test_random_below(&random, all.count)];
        tl_transform pose_a, pose_b;
        if (i % 2 == 0) {
            uint32_t face_a = test_random_below(&random, a->hull->face_count);
            lay_on(a, face_a, b, test_random_below(&random, b->hull->face_count), &pose_a, &pose_b);
            laid[check_manifold(a, pose_a, b, pose_b)]++;
        } else {
            test_place(&random, a, b, i % 4 == 1 ? GAP_SHALLOW : GAP_TOUCHING, &pose_a, &pose_b);
            by_count[check_manifold(a, pose_a, b, pose_b)]++;
        }
    }
    print_message("%u clouds; contacts 0 to 4: %u %u %u %u %u, laid on faces: %u %u %u %u %u\n", all.count, by_count[0],
                  by_count[1], by_count[2], by_count[3], by_count[4], laid[0], laid[1], laid[2], laid[3], laid[4]);
    TEST_CHECK(by_count[1] > 500 && laid[3] + laid[4] > 1000);
    for (uint32_t i = 0; i < all.count; i++) {
        test_body_free(&all.bodies[i]);
    }
    free(all.bodies);
}

// A box that was turned before its corners became floats has sides of two triangles, which are one side still.
static void test_turned_boxes(void **state)
{
    (void)state;
    test_random random = { 43 };
    tl_convex ground = tl_convex_box(tl_vec3_make(0, -1, 0), tl_vec3_make(9, 1, 9), 0.0f);
    uint32_t split = 0;
    for (int i = 0; i < 300; i++) {
        tl_quat turn = test_random_rotation(&random);
        tl_vec3 half = test_random_point(&random, tl_vec3_make(0.5f, 0.5f, 0.5f), tl_vec3_make(2, 2, 2)), corners[8];
        for (int k = 0; k < 8; k++) {
            tl_vec3 sign = tl_vec3_make(k & 1 ? 1.0f : -1.0f, k & 2 ? 1.0f : -1.0f, k & 4 ? 1.0f : -1.0f);
            corners[k] = tl_add(tl_rotate(turn, tl_mul(sign, half)), tl_vec3_make(3, 0, -2));
        }
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(corners, 8, NULL, &hull, NULL), TL_OK);
        split += hull->face_count > 6;
        tl_convex box = tl_convex_from_hull(hull, 0.0f);
        // Turned back, it stands upright again.
        tl_transform pose = tl_transform_identity();
        tl_quat back = { -turn.x, -turn.y, -turn.z, turn.w };
        pose.rotation = back;
        tl_vec3 middle = tl_rotate(back, tl_vec3_make(3, 0, -2));
        pose.position = tl_sub(tl_vec3_make(0, half.y - 0.01f, 0), middle);
        tl_contact_manifold m;
        TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &box, pose, &(tl_contact_limits){ 0.02f, 0.02f, 0 }, NULL,
                                      &m) == 4);
        for (uint32_t c = 0; c < 4; c++) {
            TEST_CHECK(fabsf(fabsf(m.contacts[c].point_b.x) - half.x) < 1e-5f &&
                       fabsf(fabsf(m.contacts[c].point_b.z) - half.z) < 1e-5f);
            TEST_CHECK(fabsf(m.contacts[c].separation + 0.01f) < 1e-5f);
        }
        tl_blob_free(hull);
    }
    TEST_CHECK(split > 200);
}

// Two edges cross 5.26 mm deep, in front of faces whose common corners are 2 mm apart.
static void test_crossing_edges_before_faces(void **state)
{
    (void)state;
    static const tl_vec3 points_a[] = { { .27f, .9f, .35f },    { .07f, -.35f, .93f },  { .69f, .56f, -.46f },
                                        { -.32f, .95f, -.04f }, { .68f, -.72f, -.15f }, { -.8f, -.29f, .53f },
                                        { .05f, -.1f, .99f },   { .71f, -.69f, -.14f } };
    static const tl_vec3 points_b[] = { { -.4f, -.71f, -.58f }, { .2f, -.79f, .57f }, { -.73f, .68f, .08f },
                                        { -.8f, -.49f, -.34f }, { .37f, .83f, .41f }, { -.11f, -.67f, -.74f },
                                        { .39f, .56f, -.73f },  { -.4f, .81f, -.42f } };
    tl_hull *hull_a, *hull_b;
    TEST_RESULT(tl_hull_bake(points_a, 8, NULL, &hull_a, NULL), TL_OK);
    TEST_RESULT(tl_hull_bake(points_b, 8, NULL, &hull_b, NULL), TL_OK);
    tl_convex a = tl_convex_from_hull(hull_a, 0.0f), b = tl_convex_from_hull(hull_b, 0.0f);
    tl_transform there = at(.21f, -.958f, 1.472f);
    tl_penetration p;
    TEST_CHECK(tl_convex_penetration(&a, at(0, 0, 0), &b, there, NULL, &p) && p.depth > 0.005f);
    tl_contact_manifold m;
    TEST_CHECK(tl_convex_contacts(&a, at(0, 0, 0), &b, there, &(tl_contact_limits){ 0.01f, 0.01f, 0 }, NULL, &m) == 2);
    float least = tl_minf(m.contacts[0].separation, m.contacts[1].separation);
    TEST_CHECK(fabsf(least + p.depth) < 1e-6f);
    tl_blob_free(hull_a);
    tl_blob_free(hull_b);
}

// Both ends of a prism's edge rest, however steep the sides are that meet in it; either shape may be the prism.
static void test_an_edge_on_a_face(void **state)
{
    (void)state;
    tl_convex ground = tl_convex_box(tl_vec3_make(0, -1, 0), tl_vec3_make(50, 1, 50), 0.0f);
    for (int degrees = 5; degrees <= 85; degrees += 5) {
        float w = tanf((float)degrees * 0.017453293f);
        const tl_vec3 corners[] = { { 0, 0, -1 }, { w, 1, -1 }, { -w, 1, -1 }, { 0, 0, 1 }, { w, 1, 1 }, { -w, 1, 1 } };
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(corners, 6, NULL, &hull, NULL), TL_OK);
        const tl_convex shapes[] = { tl_convex_from_hull(hull, 0.0f),
                                     tl_convex_triangle(corners[0], corners[3], corners[5], 0.0f) };
        for (int k = 0; k < 4; k++) {
            const tl_convex *prism = &shapes[k / 2], *a = k % 2 == 0 ? &ground : prism,
                            *b = k % 2 == 0 ? prism : &ground;
            tl_transform pose_a = at(0, k % 2 == 0 ? 0.0f : -0.005f, 0), pose_b = at(0, k % 2 == 0 ? -0.005f : 0.0f, 0);
            tl_contact_manifold m;
            TEST_CHECK(tl_convex_contacts(a, pose_a, b, pose_b, &(tl_contact_limits){ 0.01f, 0.01f, 0 }, NULL, &m) ==
                       2);
            TEST_CHECK(fabsf(m.contacts[0].point_a.z + m.contacts[1].point_a.z) < 1e-6f &&
                       fabsf(fabsf(m.contacts[0].point_a.z) - 1.0f) < 1e-6f);
            TEST_CHECK(fabsf(m.contacts[0].separation + 0.005f) < 1e-6f &&
                       fabsf(m.contacts[1].separation + 0.005f) < 1e-6f);
        }
        // Tilted along the edge by more than the tolerance: the lower end alone.
        tl_transform tilted = at(0, 0.015f, 0);
        tilted.rotation.x = 0.01f;
        tilted.rotation.w = 0.99995f;
        tl_contact_manifold m;
        TEST_CHECK(tl_convex_contacts(&ground, at(0, 0, 0), &shapes[0], tilted, &(tl_contact_limits){ 0.01f, 0.01f, 0 },
                                      NULL, &m) == 1);
        tl_blob_free(hull);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_a_triangle_carries_a_box),
        cmocka_unit_test(test_contacts_of_all_families),
        cmocka_unit_test(test_contacts_of_clouds),
        cmocka_unit_test(test_turned_boxes),
        cmocka_unit_test(test_crossing_edges_before_faces),
        cmocka_unit_test(test_an_edge_on_a_face),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
