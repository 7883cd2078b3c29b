// SPDX-License-Identifier: MIT
//
// Sweeps against a sweep in small steps that measures each place by GJK: free up to t, and half of the gap left there;
// from an overlap, only what leads out.

#include "character/mover.h"
#include "character_world.h"

enum { ROUNDS = 1200, FINE_STEPS = 200 };

static tl_soup *random_soup(uint64_t seed)
{
    model m = model_random(40, 1.5f, 1.2f, seed);
    tl_soup *soup = world_bake(&m);
    model_free(&m);
    return soup;
}

// The distance of the core from the nearest triangle.
static double core_distance(const tl_soup *soup, const tl_character_mover *m, tl_vec3d feet)
{
    tl_character_def thin = m->def;
    thin.radius = 4.0f; // the depth of a fat capsule around the same core
    thin.height = (float)m->core_length + 2.0f * thin.radius;
    tl_vec3 low = tl_vec3d_to_float(feet);
    low.y += m->def.radius - thin.radius;
    return 4.0 - world_depth(soup, &thin, low);
}

static void test_fine_steps(void **state)
{
    (void)state;
    test_random random = { 9 };
    tl_character_def def = tl_default_character_def();
    tl_character_report report;
    uint32_t hits = 0, misses = 0, pressed = 0;
    def.gap = 0.02f;
    tl_character_mover *m;
    TEST_RESULT(tl_character_mover_create(&def, &m, NULL), TL_OK);
    m->report = &report;
    m->gap = (double)def.gap;
    m->ignored_instance = TL_NO_INSTANCE;
    const double keep = m->radius + 0.5 * m->gap;
    for (uint32_t i = 0; i < ROUNDS; i++) {
        tl_soup *soup = random_soup(i / 20);
        tl_character_level level = { .soup = soup };
        m->level = &level;
        tl_vec3 at = test_random_point(&random, tl_vec3_make(-3, -3, -3), tl_vec3_make(3, 2, 3));
        tl_vec3d feet = tl_vec3d_from(at);
        tl_vec3d motion = tl_vec3d_scale(tl_vec3d_from(test_random_direction(&random)), i % 2 ? 3.0 : 0.3);
        TEST_CHECK(tl_mover_collect(m, tl_vec3d_sub(feet, tl_vec3d_make(4, 4, 4)),
                                    tl_vec3d_add(feet, tl_vec3d_make(4, 4, 4))));
        tl_mover_sweep sweep = tl_mover_cast(m, feet, motion);
        double first = core_distance(soup, m, feet);
        if (first < keep) {
            // Too near at the start: it may leave, and comes no nearer than it was.
            double end = core_distance(soup, m, tl_vec3d_mul_add(feet, motion, sweep.t));
            pressed++;
            TEST_CHECK(first < 0.0 || end >= (first < keep ? first : keep) - 0.016 * m->gap);
        } else {
            for (uint32_t k = 0; k <= FINE_STEPS; k++) {
                double t = sweep.t * (double)k / FINE_STEPS;
                TEST_CHECK(core_distance(soup, m, tl_vec3d_mul_add(feet, motion, t)) >= keep - 1e-5);
            }
            double end = core_distance(soup, m, tl_vec3d_mul_add(feet, motion, sweep.t));
            TEST_CHECK(!sweep.hit || end <= keep + 0.004 * m->gap + 1e-5);
            hits += sweep.hit;
            misses += !sweep.hit;
        }
        tl_blob_free(soup);
    }
    tl_character_mover_destroy(m);
    TEST_CHECK(hits > 100 && misses > 100 && pressed > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fine_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
