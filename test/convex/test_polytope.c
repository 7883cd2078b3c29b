// SPDX-License-Identifier: MIT
//
// The polytope that EPA grows: after each point it is closed, convex and holds all points that were added.

#include "talus_test.h"

#include "convex/depth/polytope.h"

#include <math.h>
#include <string.h>

// Points lie within RADIUS of the origin, or near it.
#define RADIUS 1000.0
#define SCALE  2000.0

static tl_minkowski_point random_point(test_random *random)
{
    tl_minkowski_point p;
    memset(&p, 0, sizeof p);
    const tl_vec3 q = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(1, 1, 1));
    // Half of them on a ball, so that most faces see few others.
    const float length = tl_length(q);
    const tl_vec3 within = test_random_below(random, 2) == 0 && length > 0.1f ? tl_scale(q, 1.0f / length) : q;
    p.w = tl_vec3d_scale(tl_vec3d_from(within), RADIUS);
    p.a = tl_vec3d_scale(p.w, 2.0);
    return p;
}

static bool is_live(const tl_polytope *p, uint32_t face)
{
    for (uint32_t i = 0; i < p->free_count; i++) {
        if (p->free_faces[i] == face) {
            return false;
        }
    }
    return true;
}

static void check_polytope(const tl_polytope *p)
{
    uint32_t live = 0;
    for (uint32_t f = 0; f < p->face_count; f++) {
        if (!is_live(p, f)) {
            TEST_CHECK(isinf(p->keys[f]));
            continue;
        }
        live++;
        for (uint32_t i = 0; i < 3; i++) {
            const uint32_t edge = 4 * f + i, twin = p->twins[edge];
            TEST_CHECK(p->twins[twin] == edge && is_live(p, twin / 4) && twin / 4 != f);
            // A twin runs the other way.
            TEST_CHECK(p->origins[twin] == p->origins[4 * f + (i + 1) % 3]);
            TEST_CHECK(p->origins[edge] == p->origins[4 * (twin / 4) + (twin % 4 + 1) % 3]);
        }
        const tl_polytope_plane plane = tl_polytope_plane_of(p, f);
        for (uint32_t v = 0; v < p->vertex_count; v++) {
            TEST_CHECK(tl_vec3d_dot(plane.normal, p->vertices[v].w) - plane.offset <= 1e-9 * RADIUS * RADIUS * RADIUS);
        }
    }
    TEST_CHECK(live >= 4 && live % 2 == 0 && live <= 2 * p->vertex_count - 4);
}

static void every_point_grows_the_hull(void **state)
{
    (void)state;
    test_random random = { 31 };
    static tl_polytope polytope;
    uint32_t full = 0, added = 0;
    for (int round = 0; round < 60; round++) {
        tl_minkowski_point seed[4];
        double volume = 0.0;
        while (fabs(volume) < 0.1 * RADIUS * RADIUS * RADIUS) {
            for (int i = 0; i < 4; i++) {
                seed[i] = random_point(&random);
            }
            const tl_vec3d d = seed[3].w;
            volume = tl_vec3d_dot(tl_vec3d_cross(tl_vec3d_sub(seed[0].w, d), tl_vec3d_sub(seed[1].w, d)),
                                  tl_vec3d_sub(seed[2].w, d));
        }
        polytope.ids = NULL;
        tl_polytope_init(&polytope, seed, SCALE);
        check_polytope(&polytope);
        for (int k = 0; k < 600 && full < 20; k++) {
            const tl_minkowski_point p = random_point(&random);
            uint32_t face = 0;
            while (face < polytope.face_count) {
                const tl_polytope_plane plane = tl_polytope_plane_of(&polytope, face);
                if (is_live(&polytope, face) &&
                    tl_vec3d_dot(plane.normal, p.w) - plane.offset > 1e-6 * RADIUS * sqrt(plane.normal_sq)) {
                    break;
                }
                face++;
            }
            if (face == polytope.face_count) {
                continue; // it is inside
            }
            const uint32_t vertices = polytope.vertex_count, faces = polytope.face_count - polytope.free_count;
            if (tl_polytope_add(&polytope, face, &p, SCALE)) {
                added++;
                TEST_CHECK(polytope.vertex_count == vertices + 1);
            } else {
                // Only a full one refuses a point that is clearly outside, and stays as it was.
                TEST_CHECK(vertices == TL_POLYTOPE_VERTICES || faces + 2 > TL_POLYTOPE_FACES);
                TEST_CHECK(polytope.vertex_count == vertices && polytope.face_count - polytope.free_count == faces);
                full++;
                break;
            }
            check_polytope(&polytope);
        }
        // The nearest face is the one of the lowest key.
        const uint32_t nearest = tl_polytope_nearest_face(&polytope);
        for (uint32_t f = 0; f < polytope.face_count; f++) {
            TEST_CHECK(polytope.keys[nearest] <= polytope.keys[f]);
        }
        const tl_polytope_plane plane = tl_polytope_plane_of(&polytope, nearest);
        const double distance = plane.offset / sqrt(plane.normal_sq);
        TEST_CHECK(polytope.keys[nearest] < distance && polytope.keys[nearest] > distance - 1e-6 * RADIUS);
    }
    print_message("%u points added, %u polytopes were full\n", added, full);
    TEST_CHECK(added > 1000 && full > 5);
}

// A tetrahedron one of whose edges is short: two of its faces are thin. Where its corners are off by the noise, their
// planes turn, and pass the origin farther away than the true ones do.
static void noise_never_proves_too_much(void **state)
{
    (void)state;
    const double noise = TL_POLYTOPE_ERROR * SCALE;
    test_random random = { 47 };
    uint32_t too_far = 0;
    for (int round = 0; round < 20000; round++) {
        tl_minkowski_point points[4];
        for (int i = 0; i < 4; i++) {
            points[i] = random_point(&random);
        }
        const double length = pow(10.0, -8.0 * (double)test_random_unit(&random));
        points[1].w = tl_vec3d_mul_add(points[0].w, random_point(&random).w, length);
        static tl_polytope polytope, noisy;
        polytope.ids = NULL;
        tl_polytope_init(&polytope, points, 0.0);
        for (int i = 0; i < 4; i++) {
            points[i].w = tl_vec3d_mul_add(points[i].w, random_point(&random).w, 0.5 * noise / RADIUS);
        }
        noisy.ids = NULL;
        tl_polytope_init(&noisy, points, SCALE);
        for (uint32_t f = 0; f < 4 && memcmp(polytope.origins, noisy.origins, 4 * 4) == 0; f++) {
            const tl_polytope_plane plane = tl_polytope_plane_of(&noisy, f);
            too_far += plane.offset / sqrt(plane.normal_sq) > polytope.keys[f] + noise ? 1 : 0;
            TEST_CHECK(noisy.keys[f] <= polytope.keys[f]);
        }
    }
    print_message("%u planes pass farther than the true ones\n", too_far);
    TEST_CHECK(too_far > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(every_point_grows_the_hull),
                                        cmocka_unit_test(noise_never_proves_too_much) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
