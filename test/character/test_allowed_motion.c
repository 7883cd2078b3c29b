// SPDX-License-Identifier: MIT
//
// The nearest allowed motion, against all of its possible places: the wish, its foot on each plane, on the line of each
// pair, the point of each triple; of those that all planes allow, the nearest one.

#include "character/allowed_motion.h"
#include "talus_test.h"

enum { ROUNDS = 20000, MAX_PLANES = 7 };

static const double SLACK = 1e-9;

static tl_vec3d random_vec(test_random *random, double size)
{
    double x = (double)test_random_range(random, -1, 1), y = (double)test_random_range(random, -1, 1);
    double z = (double)test_random_range(random, -1, 1);
    return tl_vec3d_make(x * size, y * size, z * size);
}

typedef struct search {
    const tl_mover_plane *planes;
    uint32_t count;
    tl_vec3d wish, best;
    double best_sq;
} search;

static void consider(search *s, tl_vec3d at)
{
    for (uint32_t i = 0; i < s->count; i++) {
        if (tl_vec3d_dot(s->planes[i].normal, at) < s->planes[i].least - 1e-7) {
            return;
        }
    }
    tl_vec3d off = tl_vec3d_sub(at, s->wish);
    double sq = tl_vec3d_dot(off, off);
    if (sq < s->best_sq) {
        s->best_sq = sq;
        s->best = at;
    }
}

// The point with normal . x = least for a, b, c, by Cramer's rule.
static bool meet(tl_mover_plane a, tl_mover_plane b, tl_mover_plane c, tl_vec3d *at)
{
    tl_vec3d bc = tl_vec3d_cross(b.normal, c.normal), ca = tl_vec3d_cross(c.normal, a.normal),
             ab = tl_vec3d_cross(a.normal, b.normal);
    double volume = tl_vec3d_dot(a.normal, bc);
    if (fabs(volume) < 1e-6) {
        return false;
    }
    tl_vec3d sum = tl_vec3d_add(tl_vec3d_scale(bc, a.least), tl_vec3d_scale(ca, b.least));
    *at = tl_vec3d_scale(tl_vec3d_add(sum, tl_vec3d_scale(ab, c.least)), 1.0 / volume);
    return true;
}

static void consider_all(search *s)
{
    consider(s, s->wish);
    for (uint32_t i = 0; i < s->count; i++) {
        const tl_mover_plane *a = &s->planes[i];
        consider(s, tl_vec3d_mul_add(s->wish, a->normal, a->least - tl_vec3d_dot(a->normal, s->wish)));
        for (uint32_t j = 0; j < i; j++) {
            tl_vec3d along = tl_vec3d_cross(a->normal, s->planes[j].normal), at;
            double length = tl_vec3d_length(along);
            if (length > 1e-6) {
                tl_mover_plane across = { tl_vec3d_scale(along, 1.0 / length), 0.0 };
                across.least = tl_vec3d_dot(across.normal, s->wish);
                if (meet(*a, s->planes[j], across, &at)) {
                    consider(s, at);
                }
            }
            for (uint32_t k = 0; k < j; k++) {
                if (meet(*a, s->planes[j], s->planes[k], &at)) {
                    consider(s, at);
                }
            }
        }
    }
}

static void test_nearest(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t free = 0, held = 0, none = 0;
    for (uint32_t round = 0; round < ROUNDS; round++) {
        tl_mover_plane planes[MAX_PLANES];
        uint32_t count = test_random_below(&random, MAX_PLANES + 1);
        for (uint32_t i = 0; i < count; i++) {
            tl_vec3 normal = test_random_direction(&random);
            tl_vec3d n = tl_vec3d_from(normal);
            planes[i].normal = tl_vec3d_scale(n, 1.0 / tl_vec3d_length(n));
            planes[i].least = round % 3 == 0 ? 0.0 : (double)test_random_range(&random, -0.5f, 0.2f);
        }
        search s = { planes, count, random_vec(&random, 1.0), { 0, 0, 0 }, (double)INFINITY };
        consider_all(&s);
        tl_vec3d motion;
        bool found = tl_allowed_motion(planes, count, s.wish, SLACK, &motion);
        assert_int_equal(found, s.best_sq < (double)INFINITY);
        if (!found) {
            none++;
            continue;
        }
        double off = tl_vec3d_length(tl_vec3d_sub(motion, s.best));
        TEST_CHECK(off < 1e-5);
        // Moreau: the nearest motion of a cone is no longer than the wish, and never against it.
        if (round % 3 == 0) {
            TEST_CHECK(fabs(tl_vec3d_dot(motion, s.wish) - tl_vec3d_dot(motion, motion)) < 1e-6);
        }
        free += off == 0.0 && s.best_sq == 0.0;
        held += s.best_sq > 0.0;
    }
    TEST_CHECK(free > 1000 && held > 5000 && none > 500);
}

// Opposed walls: apart they allow a slide between, against each other nothing.
static void test_opposed(void **state)
{
    (void)state;
    tl_mover_plane planes[2] = { { { 1, 0, 0 }, -0.1 }, { { -1, 0, 0 }, -0.1 } };
    tl_vec3d motion;
    TEST_CHECK(tl_allowed_motion(planes, 2, tl_vec3d_make(1, 0, 2), SLACK, &motion));
    TEST_CHECK(fabs(motion.x - 0.1) < 1e-12 && motion.z == 2.0);
    planes[0].least = planes[1].least = 0.1;
    TEST_CHECK(!tl_allowed_motion(planes, 2, tl_vec3d_make(1, 0, 2), SLACK, &motion));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nearest),
        cmocka_unit_test(test_opposed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
