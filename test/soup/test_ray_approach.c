// SPDX-License-Identifier: MIT
//
// ray_approach.c: rays and segments from any distance against a loop over all triangles that uses no filter, with every
// walk; and the boxes that a far ray enters, which must be few.

#include "ray_without_tree.h"
#include "soup/ray/ray_prepare.h"
#include "soup_models.h"

#include <float.h>

typedef struct regimes {
    uint32_t rays, hit, miss, cut;
} regimes;

// No filter, no tree, and nothing of tl_ray_approach: a ray's axes depend on its direction alone.
static bool cast_by_all(const tl_soup *soup, tl_vec3 origin, tl_vec3 target, bool is_segment, float tmax,
                        tl_ray_job *job)
{
    memset(job, 0, sizeof *job);
    job->soup = soup;
    job->t = tmax;
    if (!tl_ray_prepare(job, tl_vec3_make(0, 0, 0), is_segment ? tl_sub(target, origin) : target)) {
        return false;
    }
    job->is_segment = is_segment;
    job->origin.point = origin;
    job->target.point = target;
    return test_decide_all_lanes(soup, job);
}

static void check(const tl_soup *const soups[2], tl_vec3 origin, tl_vec3 target, bool is_segment, float tmax,
                  regimes *seen)
{
    tl_ray_job job;
    tl_ray ray = { origin, target, tmax };
    bool hit = cast_by_all(soups[0], origin, target, is_segment, tmax, &job);
    for (tl_ray_isa isa = TL_RAY_SCALAR; isa < TL_RAY_ISA_COUNT; isa++) {
        tl_ray_walk_fn *walk = tl_ray_walk_for(isa);
        for (uint32_t k = 0; k < 2 && walk != NULL; k++) {
            tl_ray_hit found;
            bool any = is_segment ? tl_soup_cast_segment_with(walk, soups[k], origin, target, NULL, &found)
                                  : tl_soup_cast_ray_with(walk, soups[k], &ray, NULL, &found);
            if (any != hit || (hit && (found.t != job.t || found.triangle != job.triangle))) {
                fail_msg("%s from %a %a %a, %a %a %a to %a: %d, expected %d (t %a of %u)",
                         is_segment ? "segment" : "ray", (double)origin.x, (double)origin.y, (double)origin.z,
                         (double)target.x, (double)target.y, (double)target.z, (double)tmax, any, hit, (double)job.t,
                         job.triangle);
            }
            TEST_CHECK(is_segment ? tl_soup_line_of_sight_with(walk, soups[k], origin, target, NULL) != hit
                                  : tl_soup_occluded_with(walk, soups[k], &ray, NULL) == hit);
        }
    }
    tl_ray_walk_many_fn *many = tl_ray_best_walk_many();
    if (!is_segment) {
        tl_ray_hit found;
        const tl_ray_batch batch = { .soup = soups[0], .rays = &ray, .count = 1, .hits = &found };
        many(&batch);
        TEST_CHECK((found.triangle != TL_NO_TRIANGLE) == hit && (!hit || found.triangle == job.triangle));
    }
    seen->rays++;
    seen->hit += hit;
    seen->miss += !hit;
}

// Aimed at a point of the model, as far as floats can aim. Beyond 2^24 sizes they cannot but at the origin, through
// which all of (-s D) lead, and along axes.
static void check_model(const model *m, uint32_t count, uint64_t seed, regimes *seen)
{
    test_random random = { seed };
    tl_soup_def def = model_soup_def(MODEL_COMPACT);
    tl_soup *soups[2] = { model_soup(m, NULL), model_soup(m, &def) };
    tl_aabb bounds = tl_soup_bounds(soups[0]);
    tl_vec3 extent = tl_aabb_size(bounds);
    float size = tl_maxf(extent.x, tl_maxf(extent.y, extent.z));
    for (uint32_t i = 0; i < count; i++) {
        int farthest = 126 - ilogbf(size);
        int k = 4 + (int)test_random_below(&random, (uint32_t)(i % 2 == 0 ? 26 : farthest - 4));
        float distance = ldexpf(size, k) * test_random_range(&random, 0.5f, 0.99f);
        tl_vec3 at = m->vertices[m->indices[test_random_below(&random, 3 * m->triangle_count)]];
        tl_vec3 away = test_random_direction(&random);
        if (i % 3 == 1) { // along an axis, or nearly so
            uint32_t axis = test_random_below(&random, 3);
            float sign = test_random_below(&random, 2) ? 1.0f : -1.0f;
            away = tl_vec3_make(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0);
        }
        tl_vec3 origin = i % 3 == 2 ? tl_scale(away, distance) : tl_mul_add(at, away, distance);
        tl_vec3 direction = i % 3 == 2 ? tl_scale(away, -1) : tl_sub(at, origin);
        if (i % 3 == 1 && i % 4 != 0) {
            direction = tl_scale(away, -1);
        }
        direction = tl_scale(direction, ldexpf(1, (int)test_random_below(&random, 21) - 20));
        if (direction.x == 0 && direction.y == 0 && direction.z == 0) {
            continue;
        }
        float along = tl_maxf(fabsf(direction.x), tl_maxf(fabsf(direction.y), fabsf(direction.z)));
        float limits[4] = { INFINITY, FLT_MAX, distance / along, distance / along * 1.001f };
        check((const tl_soup *const *)soups, origin, direction, false, limits[i / 5 % 4], seen);
        uint32_t hits = seen->hit;
        check((const tl_soup *const *)soups, origin, i % 5 == 0 ? at : tl_mul_add(at, away, -0.5f * distance), true,
              1.0f, seen);
        check((const tl_soup *const *)soups, at, origin, true, 1.0f, seen);
        seen->cut += seen->hit - hits;
    }
    tl_blob_free(soups[0]);
    tl_blob_free(soups[1]);
}

static void test_answers_from_far_away(void **state)
{
    (void)state;
    regimes seen = { 0 };
    model m = model_random(400, 10, 3, 1);
    check_model(&m, 1000, 1, &seen);
    model_free(&m);
    m = model_terrain(16, 2, tl_vec3_make(0, 0, 0), 2);
    check_model(&m, 600, 2, &seen);
    model_free(&m);
    m = model_terrain(12, 2, tl_vec3_make(5000, 0, -3000), 3);
    check_model(&m, 600, 3, &seen);
    model_free(&m);
    m = model_random(200, 1e-6f, 1e-6f, 4);
    check_model(&m, 400, 4, &seen);
    model_free(&m);
    m = model_random(200, 1e11f, 1e11f, 5);
    check_model(&m, 400, 5, &seen);
    model_free(&m);
    m = model_ball(3, 20, 0, tl_vec3_make(0, 0, 0), 6);
    check_model(&m, 400, 6, &seen);
    model_free(&m);
    for (uint32_t count = 1; count <= 20; count++) {
        m = model_random(count, 3, 2, 100 + count);
        check_model(&m, 50, count, &seen);
        model_free(&m);
    }
    print_message("rays and segments %u, hits %u, misses %u, segments that hit %u\n", seen.rays, seen.hit, seen.miss,
                  seen.cut);
    TEST_CHECK(seen.hit > 2000 && seen.miss > 2000 && seen.cut > 800);
}

// Boxes that the prepared ray enters: a walk without an order, in double.
static uint32_t count_boxes(const tl_ray_job *job, uint32_t child)
{
    if ((child & TL_CHILD_LEAF) != 0) {
        return 1;
    }
    const tl_soup_node *node =
        (const tl_soup_node *)(const void *)((const char *)job->soup + job->soup->node_offset) + child;
    uint32_t count = 1;
    for (uint32_t i = 0; i < TL_SOUP_WIDTH; i++) {
        double first = 0, last = (double)job->box_limit;
        for (uint32_t axis = 0; axis < 3; axis++) {
            bool down = (job->backward >> axis & 1u) != 0;
            double scale = (double)job->plane_scale[axis];
            double enter = (double)node->plane[2 * axis + down][i] * scale + (double)job->near_base[axis];
            double leave = (double)node->plane[2 * axis + !down][i] * scale + (double)job->far_base[axis];
            first = enter > first ? enter : first;
            last = leave < last ? leave : last;
        }
        count += node->child[i] != 0 && first <= last ? count_boxes(job, node->child[i]) : 0;
    }
    return count;
}

static void test_far_rays_enter_few_boxes(void **state)
{
    (void)state;
    model m = model_terrain(100, 2, tl_vec3_make(0, 0, 0), 7);
    tl_soup *soup = model_soup(&m, NULL);
    test_random random = { 9 };
    uint32_t most = 0, moved = 0;
    for (int k = 0; k < 120; k++) {
        for (uint32_t i = 0; i < 20; i++) {
            float height = ldexpf(1.5f, k + 5);
            tl_vec3 at = tl_vec3_make(100 * test_random_unit(&random), 1, 100 * test_random_unit(&random));
            tl_vec3 from = tl_vec3_make(at.x, height, at.z), direction = tl_vec3_make(0, -1, 0);
            if (i % 2 == 0 && k < 18) { // aimed aslant; from farther away floats cannot
                from = tl_add(at, tl_vec3_make(height * 0.3f, height, height * -0.2f));
                direction = tl_sub(at, from);
            }
            tl_ray_job job;
            memset(&job, 0, sizeof job);
            job.soup = soup;
            job.t = INFINITY;
            TEST_CHECK(tl_ray_prepare(&job, from, direction));
            TEST_CHECK(job.outside == 0 || tl_ray_meets_bounds(&job));
            moved += job.box_t.start > 0;
            uint32_t count = count_boxes(&job, 0);
            most = count > most ? count : most;
        }
    }
    tl_soup_stats stats = tl_soup_get_stats(soup);
    print_message("at most %u of %u boxes\n", most, stats.node_count + stats.leaf_count);
    TEST_CHECK(most < 40 && moved > 2000);
    tl_blob_free(soup);
    model_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_answers_from_far_away),
        cmocka_unit_test(test_far_rays_enter_few_boxes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
