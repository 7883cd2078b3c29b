// SPDX-License-Identifier: MIT
//
// Random walks with jumps, over generated levels and those of the data folder: no place deeper than 1 mm, no sheet gone
// through, nothing stuck; and the same bits with every compiler, optimisation and instruction set.

#include "character_world.h"
#include "cli/sample/sample_level.h"

#include <stdio.h>
#include <string.h>

enum { WALKERS = 12, TICKS = 240 };

typedef struct walk_count {
    uint32_t steps, grounded, blocked, lost;
    float climbed;
    uint64_t hash;
} walk_count;

// A place on or above some triangle under a random vertical line, where a character fits.
static bool find_place(const tl_soup *soup, const tl_character_def *def, test_random *random, tl_vec3 *place)
{
    tl_aabb box = tl_soup_bounds(soup);
    for (int i = 0; i < 100; i++) {
        tl_ray_hit hits[32];
        uint32_t count;
        tl_vec3 top = test_random_point(random, box.min, box.max);
        top.y = box.max.y + 1;
        tl_ray down = { top, { 0, -1, 0 }, INFINITY };
        (void)tl_soup_cast_ray_all(soup, &down, TL_HITS_TOUCHED, NULL, hits, 32, &count);
        if (count > 0) {
            const tl_ray_hit *hit = &hits[test_random_below(random, count < 32 ? count : 32)];
            *place = tl_vec3_make(top.x, top.y - hit->t + 0.1f, top.z);
            if (world_depth(soup, def, *place) == 0.0) {
                return true;
            }
        }
    }
    return false;
}

// The judge: a capsule 1 mm thinner touches nothing, and its middle has gone through nothing.
static void judge(const tl_soup *soup, const tl_character_def *def, tl_vec3 from, tl_vec3 to)
{
    tl_convex thin = tl_convex_capsule(tl_vec3_make(0, def->radius, 0), tl_vec3_make(0, def->height - def->radius, 0),
                                       def->radius - 0.001f);
    tl_transform pose = { { 0, 0, 0, 1 }, to };
    bool overlaps;
    TEST_RESULT(tl_soup_overlaps(soup, &thin, pose, NULL, &overlaps), TL_OK);
    TEST_CHECK(!overlaps);
    from.y += 0.5f * def->height;
    to.y += 0.5f * def->height;
    TEST_CHECK(tl_soup_line_of_sight(soup, from, to, NULL));
}

// The words of the state's numbers, in an order of bytes of no machine.
static uint64_t mix(uint64_t hash, const tl_character *c)
{
    const float numbers[6] = {
        c->position.x, c->position.y, c->position.z, c->velocity.x, c->velocity.y, c->velocity.z
    };
    for (int i = 0; i < 6; i++) {
        uint32_t bits;
        memcpy(&bits, &numbers[i], sizeof bits);
        hash = (hash ^ bits) * 0x100000001b3u;
    }
    return hash ^ c->ground_triangle;
}

static void walk_level(const tl_soup *soup, uint64_t seed, walk_count *n)
{
    test_random random = { seed };
    tl_character_def def = tl_default_character_def();
    def.max_triangles = 8192;
    tl_character_mover *mover;
    TEST_RESULT(tl_character_mover_create(&def, &mover, NULL), TL_OK);
    tl_character_level level = { .soup = soup };
    const float floor = tl_soup_bounds(soup).min.y - 5;
    for (int w = 0; w < WALKERS; w++) {
        tl_character c;
        memset(&c, 0, sizeof c);
        if (!find_place(soup, &def, &random, &c.position)) {
            continue;
        }
        tl_vec3 way = { 1, 0, 0 };
        for (int k = 0; k < TICKS; k++) {
            if (k % 30 == 0) {
                float x = test_random_range(&random, -1, 1), z = test_random_range(&random, -1, 1);
                way = tl_scale(tl_normalize(tl_vec3_make(x, 0, z)), 1 + 1.5f * (float)(w % 6));
            }
            tl_character before = c;
            tl_character_report r;
            tl_character_step step = { way, WORLD_TICK, k % 50 == 49 && c.grounded != 0 };
            step.velocity.y = step.leave_ground ? 5 : c.grounded != 0 ? 0 : c.velocity.y - 9.81f * WORLD_TICK;
            TEST_RESULT(tl_character_move(mover, &level, &step, &c, &r), TL_OK);
            judge(soup, &def, before.position, c.position);
            TEST_CHECK(!r.stuck);
            n->steps++;
            n->grounded += c.grounded;
            n->blocked += r.blocked;
            n->climbed += r.stepped_up;
            n->hash = mix(n->hash, &c);
            if (c.position.y < floor) {
                n->lost++; // over the level's rim
                break;
            }
        }
    }
    tl_character_mover_destroy(mover);
}

static void test_samples(void **state)
{
    (void)state;
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    walk_count n;
    memset(&n, 0, sizeof n);
    for (uint32_t i = 0; i < count; i++) {
        tl_sample_mesh mesh;
        TEST_RESULT(tl_sample_build_level(&levels[i], 20000, 1, &mesh), TL_OK);
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        tl_soup *soup;
        TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
        walk_level(soup, 5 + i, &n);
        tl_blob_free(soup);
        tl_sample_mesh_free(&mesh);
    }
    printf("samples: %u steps, %u on the ground, %u blocked, %g m climbed, %u over the rim, hash %016llx\n", n.steps,
           n.grounded, n.blocked, (double)n.climbed, n.lost, (unsigned long long)n.hash);
    TEST_CHECK(n.steps > 5000 && n.grounded > n.steps / 3 && n.blocked > 200 && n.climbed > 1);
    // The same bits wherever this runs.
    TEST_CHECK(n.hash == 0x1e6953145c6fcb34u);
}

static void test_data_levels(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof model_levels / sizeof *model_levels; i++) {
        model m = model_load(model_levels[i]);
        if (m.triangle_count > 0) {
            walk_count n;
            memset(&n, 0, sizeof n);
            tl_soup *soup = world_bake(&m);
            walk_level(soup, 50 + i, &n);
            printf("%s: %u steps, %u on the ground, %u blocked, %g m climbed, %u over the rim\n", model_levels[i],
                   n.steps, n.grounded, n.blocked, (double)n.climbed, n.lost);
            tl_blob_free(soup);
        }
        model_free(&m);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_data_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
