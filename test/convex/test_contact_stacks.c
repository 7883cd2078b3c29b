// SPDX-License-Identifier: MIT
//
// Towers of ten stand for ten seconds on the contacts of tl_convex_contacts, with a small solver and its impulses kept
// by tl_contact.previous: nothing is ever farther than 5 cm from where it began, and no more than one contact in a
// hundred moves by that in a step.

#include "talus_test.h"

#include "contact_solver.h"

#include <stdio.h>

enum { TOWER = 10, STEPS = 600 };

#define MAX_DRIFT 0.05f

static const tl_convex *ground_of(tl_convex *ground)
{
    *ground = tl_convex_box(tl_vec3_make(0, -1, 0), tl_vec3_make(20, 1, 20), 0.0f);
    return ground;
}

static void run_tower(solver *s, const char *name)
{
    tl_vec3 start[SOLVER_BODIES];
    for (uint32_t i = 0; i < s->body_count; i++) {
        start[i] = s->bodies[i].pose.position;
    }
    float farthest = 0.0f, drift = 0.0f;
    for (int step = 0; step < STEPS; step++) {
        solver_run_step(s);
        drift = 0.0f;
        for (uint32_t i = 0; i < s->body_count; i++) {
            drift = tl_maxf(drift, tl_distance(s->bodies[i].pose.position, start[i]));
        }
        farthest = tl_maxf(farthest, drift);
    }
    double jumps = (double)s->jump_count / (double)s->contact_count;
    print_message("%-24s drift %6.2f cm, at most %6.2f, contacts %7llu, moved over 5 cm %4llu (%.3f%%)\n", name,
                  100.0 * (double)drift, 100.0 * (double)farthest, (unsigned long long)s->contact_count,
                  (unsigned long long)s->jump_count, 100.0 * jumps);
    TEST_CHECK(farthest <= MAX_DRIFT);
    TEST_CHECK(jumps <= 0.01);
    TEST_CHECK(s->contact_count > (uint64_t)(TOWER * STEPS) * 2u);
}

// `height` from the bottom to the top of each; every one is turned about the vertical by `turn` more.
static void tower_of(const tl_convex *shape, tl_vec3 half, float turn, const char *name)
{
    static solver s;
    solver_start(&s);
    tl_convex ground;
    uint32_t below = solver_add_fixed(&s, ground_of(&ground), tl_vec3_make(0, 0, 0));
    for (int i = 0; i < TOWER; i++) {
        uint32_t next = solver_add(&s, shape, tl_vec3_make(0, half.y * (float)(2 * i + 1), 0), half);
        float angle = 0.5f * turn * (float)i;
        s.bodies[next].pose.rotation.y = sinf(angle);
        s.bodies[next].pose.rotation.w = cosf(angle);
        solver_link(&s, below, next);
        below = next;
    }
    run_tower(&s, name);
}

static void test_boxes(void **state)
{
    (void)state;
    const tl_vec3 half = tl_vec3_make(0.5f, 0.5f, 0.5f);
    tl_convex box = tl_convex_box(tl_vec3_make(0, 0, 0), half, 0.0f);
    tower_of(&box, half, 0.0f, "boxes");
    tower_of(&box, half, 0.3f, "boxes, turned");
    tl_convex rounded = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.45f, 0.45f, 0.45f), 0.05f);
    tower_of(&rounded, half, 0.3f, "rounded boxes, turned");
    tl_vec3 corners[8];
    for (int k = 0; k < 8; k++) {
        corners[k] = tl_vec3_make(k & 1 ? 0.5f : -0.5f, k & 2 ? 0.5f : -0.5f, k & 4 ? 0.5f : -0.5f);
    }
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(corners, 8, NULL, &hull, NULL), TL_OK);
    tl_convex baked = tl_convex_from_hull(hull, 0.0f);
    tower_of(&baked, half, 0.3f, "hulls of boxes, turned");
    tl_blob_free(hull);
}

static void test_prisms(void **state)
{
    (void)state;
    static const int sides[] = { 6, 8, 12, 16, 24 };
    for (int k = 0; k < 5; k++) {
        tl_vec3 points[48];
        for (int i = 0; i < sides[k]; i++) {
            float angle = 6.2831853f * (float)i / (float)sides[k];
            points[2 * i] = tl_vec3_make(0.5f * cosf(angle), -0.4f, 0.5f * sinf(angle));
            points[2 * i + 1] = tl_vec3_make(0.5f * cosf(angle), 0.4f, 0.5f * sinf(angle));
        }
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, (uint32_t)(2 * sides[k]), NULL, &hull, NULL), TL_OK);
        tl_convex prism = tl_convex_from_hull(hull, 0.0f);
        char name[64];
        snprintf(name, sizeof name, "prisms of %d", sides[k]);
        tower_of(&prism, tl_vec3_make(0.43f, 0.4f, 0.43f), 0.0f, name);
        snprintf(name, sizeof name, "prisms of %d, turned", sides[k]);
        tower_of(&prism, tl_vec3_make(0.43f, 0.4f, 0.43f), 0.1f, name);
        tl_blob_free(hull);
    }
    tl_convex cylinder = tl_convex_cylinder(tl_vec3_make(0, -0.4f, 0), tl_vec3_make(0, 0.4f, 0), 0.5f, 0.0f);
    tower_of(&cylinder, tl_vec3_make(0.43f, 0.4f, 0.43f), 0.1f, "cylinders");
}

// Flat at the top and the bottom, where a third of the points lie at random on a rim each; the others lie around.
static void make_standing(tl_vec3 *points, uint32_t count, test_random *random)
{
    uint32_t rim = count / 3;
    for (uint32_t i = 0; i < count; i++) {
        float angle = 6.2831853f * ((float)(i % rim) + test_random_unit(random)) / (float)rim;
        bool side = i >= 2 * rim;
        points[i] = tl_vec3_make(cosf(angle), 0.0f, sinf(angle));
        points[i] = tl_scale(points[i], side ? 0.6f : test_random_range(random, 0.48f, 0.52f));
        points[i].y = side ? test_random_range(random, -0.2f, 0.2f) : i < rim ? -0.3f : 0.3f;
    }
}

static void test_hulls(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 32, 100 };
    for (int k = 0; k < 2; k++) {
        for (uint64_t seed = 1; seed <= 5; seed++) {
            test_random random = { seed };
            tl_vec3 points[100];
            make_standing(points, counts[k], &random);
            tl_hull *hull, *moved;
            TEST_RESULT(tl_hull_bake(points, counts[k], NULL, &hull, NULL), TL_OK);
            tl_transform center = tl_transform_identity(); // the solver turns bodies about their origin
            center.position = tl_vec3_make(-(float)hull->mass.center[0], 0.0f, -(float)hull->mass.center[2]);
            TEST_RESULT(tl_hull_transform(hull, tl_vec3_make(1, 1, 1), center, NULL, &moved, NULL), TL_OK);
            tl_convex shape = tl_convex_from_hull(moved, 0.0f);
            char name[64];
            snprintf(name, sizeof name, "hulls of %u points (%u)", counts[k], (unsigned)seed);
            tower_of(&shape, tl_vec3_make(0.45f, 0.3f, 0.45f), 0.05f, name);
            tl_blob_free(hull);
            tl_blob_free(moved);
        }
    }
}

// Layers of two capsules, across one another so that neither can roll, and a box on them.
static void test_capsules_on_boxes(void **state)
{
    (void)state;
    static solver s;
    solver_start(&s);
    tl_convex ground, box = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.8f, 0.2f, 0.8f), 0.0f);
    tl_convex capsule = tl_convex_capsule(tl_vec3_make(-0.5f, 0, 0), tl_vec3_make(0.5f, 0, 0), 0.2f);
    tl_convex across = tl_convex_capsule(tl_vec3_make(0, 0, -0.4f), tl_vec3_make(0, 0, 0.4f), 0.2f);
    uint32_t below = solver_add_fixed(&s, ground_of(&ground), tl_vec3_make(0, 0, 0));
    float y = 0.0f;
    for (int i = 0; i < TOWER / 2; i++) {
        uint32_t sides[2];
        sides[0] = solver_add(&s, &capsule, tl_vec3_make(0, y + 0.2f, -0.5f), tl_vec3_make(0.6f, 0.2f, 0.2f));
        sides[1] = solver_add(&s, &across, tl_vec3_make(0, y + 0.2f, 0.25f), tl_vec3_make(0.2f, 0.2f, 0.6f));
        solver_link(&s, below, sides[0]);
        solver_link(&s, below, sides[1]);
        below = solver_add(&s, &box, tl_vec3_make(0, y + 0.6f, 0), tl_vec3_make(0.8f, 0.2f, 0.8f));
        solver_link(&s, sides[0], below);
        solver_link(&s, sides[1], below);
        y += 0.8f;
    }
    run_tower(&s, "capsules and boxes");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_boxes),
        cmocka_unit_test(test_prisms),
        cmocka_unit_test(test_hulls),
        cmocka_unit_test(test_capsules_on_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
