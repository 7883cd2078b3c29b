// SPDX-License-Identifier: MIT
//
// Which contacts a manifold has. Cold: the least separation is the signed distance, for all families, and the area of
// the contacts does not jump when bodies tremble. With a cache: the same contacts from call to call, the deepest of
// them within the slack.
//
//   test_contact_choice [pairs]      pairs of each of the first two tests

#include "talus_test.h"

#include "convex_oracle.h"

static uint32_t pair_count = 20000;

static float least_separation(const tl_contact_manifold *m)
{
    float least = INFINITY;
    for (uint32_t i = 0; i < m->count; i++) {
        least = tl_minf(least, m->contacts[i].separation);
    }
    return least;
}

// Bounds of the signed distance, by the two queries that have them.
static void signed_distance(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                            float bounds[2])
{
    tl_penetration p;
    tl_separation s;
    if (tl_convex_penetration(a, pose_a, b, pose_b, NULL, &p) && p.depth > 0.0f) {
        bounds[0] = -p.upper_bound;
        bounds[1] = -p.lower_bound;
    } else {
        tl_convex_distance(a, pose_a, b, pose_b, NULL, &s);
        bounds[0] = s.lower_bound;
        bounds[1] = s.distance;
    }
}

enum { KINDS = BODY_COUNT + 4 };

// The families of hulls, and boxes, cylinders, cones and rounded boxes.
static void make_body(test_body *body, uint32_t kind, uint64_t seed)
{
    if (kind < BODY_COUNT) {
        test_body_make(body, (body_family)kind, seed, 1.0f);
        return;
    }
    test_random random = { seed };
    static const test_body empty;
    *body = empty;
    const tl_vec3 half = test_random_point(&random, tl_vec3_make(.1f, .1f, .1f), tl_vec3_make(1, 1, 1)),
                  middle = tl_scale(test_random_direction(&random), 0.2f), end = tl_mul_add(middle, half, 1.0f);
    body->shape = kind == BODY_COUNT       ? tl_convex_box(middle, half, 0.0f)
                  : kind == BODY_COUNT + 1 ? tl_convex_cylinder(middle, end, half.x, 0.0f)
                  : kind == BODY_COUNT + 2 ? tl_convex_cone(middle, end, half.y, 0.0f)
                                           : tl_convex_box(middle, half, 0.1f);
    body->size = 2.0f;
}

static void test_least_separation_is_the_distance(void **state)
{
    (void)state;
    test_random random = { 51 };
    uint32_t deep = 0, apart = 0, wrong = 0, lost = 0;
    for (uint32_t i = 0; i < pair_count;) {
        test_body a, b;
        make_body(&a, i / 16 % KINDS, (uint64_t)i + 7);
        make_body(&b, i / 16 / KINDS % KINDS, (uint64_t)i + 8);
        for (uint32_t k = 0; k < 16; k++, i++) {
            tl_transform pose_a = tl_transform_identity(), pose_b = pose_a;
            pose_a.rotation = test_random_rotation(&random);
            pose_b.rotation = test_random_rotation(&random);
            pose_b.position = tl_scale(test_random_direction(&random), test_random_range(&random, 0.2f, 2.0f));
            float size = tl_maxf(a.size, b.size), tolerance = 0.01f * size, bounds[2];
            tl_contact_manifold m;
            const uint32_t count = tl_convex_contacts(&a.shape, pose_a, &b.shape, pose_b,
                                                      &(tl_contact_limits){ tolerance, tolerance, 0 }, NULL, &m);
            signed_distance(&a.shape, pose_a, &b.shape, pose_b, bounds);
            const float gap = 4e-6f * size;
            if (count == 0) {
                lost += bounds[1] < tolerance - gap;
                continue;
            }
            const float least = least_separation(&m);
            deep += bounds[1] < 0.0f;
            apart += bounds[0] > 0.0f;
            wrong += !(least >= bounds[0] - gap && least <= bounds[1] + gap && fabsf(m.separation - least) <= gap);
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("deep %u, apart %u of %u pairs: wrong %u, lost %u\n", deep, apart, pair_count, wrong, lost);
    TEST_CHECK(wrong == 0 && lost == 0);
    TEST_CHECK(deep > pair_count / 10 && apart > pair_count / 1000);
}

// The same with a cache while the pair moves on: within the slack.
static void test_least_separation_while_moving(void **state)
{
    (void)state;
    test_random random = { 55 };
    uint32_t calls = 0, deep = 0, wrong = 0;
    for (uint32_t i = 0; i < pair_count / 8; i++) {
        test_body a, b;
        make_body(&a, i % KINDS, (uint64_t)i + 7);
        make_body(&b, i / KINDS % KINDS, (uint64_t)i + 8);
        const float size = tl_maxf(a.size, b.size), tolerance = 0.01f * size, step = 0.002f * size;
        const tl_contact_limits limits = { tolerance, tolerance, 0 };
        tl_transform pose_a = tl_transform_identity(), pose_b = pose_a;
        pose_a.rotation = test_random_rotation(&random);
        pose_b.rotation = test_random_rotation(&random);
        pose_b.position = tl_scale(test_random_direction(&random), test_random_range(&random, 0.1f, 1.2f));
        const tl_vec3 way = tl_scale(test_random_direction(&random), step), turn = test_random_direction(&random);
        tl_contact_cache cache = { 0 };
        for (int k = 0; k < 8; k++) {
            const tl_quat by = { step * turn.x, step * turn.y, step * turn.z, 1.0f };
            pose_b.rotation = tl_quat_normalize(tl_quat_mul(by, pose_b.rotation));
            pose_b.position = tl_add(pose_b.position, way);
            tl_contact_manifold m;
            float bounds[2];
            if (tl_convex_contacts(&a.shape, pose_a, &b.shape, pose_b, &limits, &cache, &m) == 0) {
                continue;
            }
            signed_distance(&a.shape, pose_a, &b.shape, pose_b, bounds);
            const float gap = 4e-6f * size + TL_CONTACT_SLACK * tolerance, least = least_separation(&m);
            calls++;
            deep += bounds[1] < 0.0f;
            wrong += !(least >= bounds[0] - gap && least <= bounds[1] + gap && m.separation <= bounds[1] + gap);
        }
        test_body_free(&a);
        test_body_free(&b);
    }
    print_message("moving: %u calls, %u deep, wrong %u\n", calls, deep, wrong);
    TEST_CHECK(wrong == 0 && deep > pair_count / 4);
}

// Of the contacts' convex hull, seen along the normal.
static double manifold_area(const tl_contact_manifold *m)
{
    double most = 0.0; // of the quadrilaterals and triangles
    tl_vec3d p[TL_MAX_CONTACTS];
    for (uint32_t i = 0; i < m->count; i++) {
        p[i] = tl_vec3d_from(m->contacts[i].point_a);
    }
    for (uint32_t i = 0; i < m->count; i++) {
        for (uint32_t j = 0; j < m->count; j++) {
            for (uint32_t k = 0; k < m->count; k++) {
                for (uint32_t l = 0; l < m->count; l++) {
                    tl_vec3d c = tl_vec3d_cross(tl_vec3d_sub(p[j], p[i]), tl_vec3d_sub(p[l], p[k]));
                    most = fmax(most, 0.5 * fabs(tl_vec3d_dot(c, tl_vec3d_from(m->normal))));
                }
            }
        }
    }
    return most;
}

// Boxes that lie on one another, turned about the vertical: trembling by 1e-5 changes the area by little.
static void test_area_under_jitter(void **state)
{
    (void)state;
    test_random random = { 52 };
    uint32_t jumps = 0, faces = 0;
    for (uint32_t i = 0; i < pair_count; i++) {
        tl_vec3 half_a = test_random_point(&random, tl_vec3_make(.3f, .3f, .3f), tl_vec3_make(1, 1, 1)),
                half_b = test_random_point(&random, tl_vec3_make(.3f, .3f, .3f), tl_vec3_make(1, 1, 1));
        tl_convex a = tl_convex_box(tl_vec3_make(0, 0, 0), half_a, 0.0f),
                  b = tl_convex_box(tl_vec3_make(0, 0, 0), half_b, 0.0f);
        float angle = test_random_range(&random, 0.0f, 3.2f);
        tl_transform pose = { { 0, sinf(angle), 0, cosf(angle) },
                              { test_random_range(&random, -.3f, .3f), half_a.y + half_b.y - 0.002f,
                                test_random_range(&random, -.3f, .3f) } };
        double area[2] = { 0 };
        for (int k = 0; k < 2; k++) {
            tl_contact_manifold m;
            tl_transform moved = pose;
            moved.position = tl_mul_add(moved.position, test_random_direction(&random), 1e-5f);
            moved.rotation.x += 1e-5f * test_random_range(&random, -1, 1);
            moved.rotation.z += 1e-5f * test_random_range(&random, -1, 1);
            tl_convex_contacts(&a, tl_transform_identity(), &b, moved, &(tl_contact_limits){ 0.02f, 0.02f, 0 }, NULL,
                               &m);
            area[k] = manifold_area(&m);
        }
        faces += area[0] > 0.1;
        jumps += fabs(area[0] - area[1]) > 0.1 * area[0];
    }
    print_message("area moved by a tenth in %u of %u pairs\n", jumps, pair_count);
    TEST_CHECK(faces == pair_count && jumps == 0);
}

// Between A's top and B's bottom, both 1 from their middles.
static bool lies_on_both(const tl_contact *contact, tl_vec3 normal, tl_transform pose_b)
{
    const tl_vec3 below = tl_inverse_rotate(pose_b.rotation, tl_sub(contact->point_b, pose_b.position));
    const tl_vec3 ahead = tl_mul_add(contact->point_a, normal, contact->separation);
    return fabsf(contact->point_a.y - 1.0f) < 1e-6f && fabsf(below.y + 1.0f) < 2e-6f &&
           tl_distance(ahead, contact->point_b) < 1e-6f;
}

// Bodies at rest that tremble and slide slowly, with a cache.
static void test_contacts_continue(void **state)
{
    (void)state;
    uint32_t contacts = 0, fresh = 0, off = 0, doubles = 0, calls = 0, astray = 0;
    for (uint32_t kind = 0; kind < 60; kind++) {
        test_random random = { kind + 1 };
        tl_vec3 points[48];
        uint32_t sides = 3 + kind % 22;
        for (uint32_t i = 0; i < sides; i++) {
            float angle = 6.2831853f * (float)i / (float)sides;
            points[2 * i] = tl_vec3_make(cosf(angle), -1, sinf(angle));
            points[2 * i + 1] = tl_vec3_make(cosf(angle), 1, sinf(angle));
        }
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 2 * sides, NULL, &hull, NULL), TL_OK);
        tl_convex shapes[2] = { kind % 3 == 0 ? tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0.0f)
                                              : tl_convex_from_hull(hull, 0.0f),
                                kind % 3 == 1 ? tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1), 0.0f)
                                              : tl_convex_from_hull(hull, 0.0f) };
        tl_contact_cache cache = { 0 };
        tl_contact_limits limits = { 0.02f, 0.02f, 0 };
        tl_transform pose = { tl_quat_identity(), { 0.1f, 1.999f, 0.2f } };
        for (int step = 0; step < 200; step++) {
            tl_transform moved = pose;
            pose.position.x += 2e-4f;
            moved.position = tl_mul_add(pose.position, test_random_direction(&random), 5e-5f);
            moved.rotation.x += 5e-5f * test_random_range(&random, -1, 1);
            moved.rotation.z += 5e-5f * test_random_range(&random, -1, 1);
            tl_contact_manifold m, cold;
            tl_convex_contacts(&shapes[0], tl_transform_identity(), &shapes[1], moved, &limits, &cache, &m);
            tl_convex_contacts(&shapes[0], tl_transform_identity(), &shapes[1], moved, &limits, NULL, &cold);
            off += fabsf(least_separation(&m) - cold.separation) > TL_CONTACT_SLACK * limits.tolerance + 4e-6f;
            uint32_t seen = 0;
            for (uint32_t i = 0; i < m.count && step > 0; i++) {
                uint32_t from = m.contacts[i].previous;
                contacts++;
                fresh += from == TL_NO_CONTACT;
                doubles += from != TL_NO_CONTACT && (seen >> from & 1u) != 0;
                seen |= from != TL_NO_CONTACT ? 1u << from : 0u;
            }
            for (uint32_t i = 0; i < m.count; i++) {
                astray += !lies_on_both(&m.contacts[i], m.normal, moved);
            }
            calls++;
        }
        tl_blob_free(hull);
    }
    print_message("%u calls, %u contacts: new %u, deepest off %u, astray %u\n", calls, contacts, fresh, off, astray);
    TEST_CHECK(off == 0 && doubles == 0 && astray == 0);
    TEST_CHECK(contacts > 3 * calls && fresh < contacts / 200);
}

// A needle's tip over the edge of a box: what lies within rounding of both its sides is not beyond its tip.
static void test_sharp_tips(void **state)
{
    (void)state;
    test_random random = { 54 };
    const tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.5f, 0.5f, 0.5f), 0.0f);
    uint32_t wrong = 0, found = 0;
    for (uint32_t i = 0; i < 20000; i++) {
        const float width = 1e-5f * (1.0f + (float)(i % 1000)), turn = test_random_range(&random, -1.0f, 1.0f);
        const tl_vec3 tip = tl_vec3_make(0.5f + test_random_range(&random, -1e-4f, 1e-4f), 0.502f, 0.0f);
        const tl_vec3 to = tl_vec3_make(tip.x - 0.8f, tip.y + test_random_range(&random, 0.1f, 0.6f), turn);
        const tl_convex needle = tl_convex_triangle(tip, to, tl_vec3_make(to.x, to.y, to.z + width), 0.0f);
        const tl_transform at = tl_transform_identity();
        tl_contact_manifold m;
        float bounds[2];
        tl_convex_contacts(&box, at, &needle, at, &(tl_contact_limits){ 0.01f, 0.01f, 0 }, NULL, &m);
        signed_distance(&box, at, &needle, at, bounds);
        found += m.count > 0;
        wrong += m.count > 0 && !(least_separation(&m) >= bounds[0] - 4e-6f);
    }
    print_message("%u tips, wrong %u\n", found, wrong);
    TEST_CHECK(found > 19000 && wrong == 0);
}

int main(int argc, char **argv)
{
    pair_count = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : pair_count;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_least_separation_is_the_distance),
        cmocka_unit_test(test_least_separation_while_moving),
        cmocka_unit_test(test_area_under_jitter),
        cmocka_unit_test(test_sharp_tips),
        cmocka_unit_test(test_contacts_continue),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
