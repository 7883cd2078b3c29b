// SPDX-License-Identifier: MIT
//
// Characters in scenes: on lifts, wagons and turntables, pushed by doors, between soups and shapes at poses.

#include "character_world.h"

#include <string.h>

enum { GROUND, MOVER, PARTS };

typedef struct stage {
    model ground_model, deck_model;
    tl_soup *ground, *deck;
    tl_convex box;
    tl_scene_instance parts[PARTS];
    tl_scene *scene;
    tl_character_mover *mover;
    tl_character_level level;
} stage;

// A floor, and a deck 4 m square and 0.5 m thick, as a soup or as a shape.
static void stage_begin(stage *s, bool soup, tl_vec3 at)
{
    memset(s, 0, sizeof *s);
    world_floor(&s->ground_model, -20, -20, 20, 20, 0, 2);
    world_box(&s->deck_model, tl_vec3_make(-2, -0.5f, -2), tl_vec3_make(2, 0, 2));
    s->ground = world_bake(&s->ground_model);
    s->deck = world_bake(&s->deck_model);
    s->box = tl_convex_box(tl_vec3_make(0, -0.25f, 0), tl_vec3_make(2, 0.25f, 2), 0.0f);
    s->parts[GROUND].soup = s->ground;
    s->parts[GROUND].mask = s->parts[MOVER].mask = 1;
    s->parts[MOVER].soup = soup ? s->deck : NULL;
    s->parts[MOVER].shape = soup ? NULL : &s->box;
    s->parts[MOVER].pose.position = at;
    TEST_RESULT(tl_scene_bake(s->parts, PARTS, NULL, &s->scene, NULL), TL_OK);
    s->mover = world_mover();
    s->level.scene = s->scene;
    s->level.instances = s->parts;
}

static void stage_end(stage *s)
{
    tl_blob_free(s->scene);
    tl_blob_free(s->ground);
    tl_blob_free(s->deck);
    tl_character_mover_destroy(s->mover);
    model_free(&s->ground_model);
    model_free(&s->deck_model);
}

static tl_character_report stage_tick(stage *s, tl_character *c, tl_vec3 walk)
{
    TEST_RESULT(tl_scene_refit(s->scene, s->parts, PARTS, NULL, NULL), TL_OK);
    tl_character_report r = world_tick(s->mover, &s->level, c, walk);
    // The judge: the capsule, a hair thinner for its floats, touches nothing.
    tl_convex capsule = tl_convex_capsule(tl_vec3_make(0, 0.3f, 0), tl_vec3_make(0, 1.5f, 0), 0.2999f);
    tl_transform pose = { { 0, 0, 0, 1 }, c->position };
    tl_scene_overlap_query query = { &capsule, pose, NULL };
    bool overlaps;
    TEST_RESULT(tl_scene_overlaps(s->scene, s->parts, &query, &overlaps), TL_OK);
    TEST_CHECK(!overlaps || r.stuck);
    return r;
}

static tl_character standing(tl_vec3 at)
{
    tl_character c;
    memset(&c, 0, sizeof c);
    c.position = at;
    return c;
}

// Up, down and aside, at up to 10 m/s, it stays on the deck and at its place there, without leaving the ground.
static void test_lifts(void **state)
{
    (void)state;
    const tl_vec3 velocities[] = { { 0, 1, 0 }, { 0, -3, 0 }, { 0, 10, 0 }, { 0, -10, 0 }, { 5, 0, 1 }, { -3, 2, 7 } };
    for (int soup = 0; soup < 2; soup++) {
        for (int i = 0; i < 6; i++) {
            stage s;
            tl_vec3 at = { 0, 30, 0 };
            stage_begin(&s, soup != 0, at);
            tl_character c = standing(tl_vec3_make(0.5f, 30.01f, -0.7f));
            for (int k = 0; k < 10; k++) {
                stage_tick(&s, &c, tl_vec3_make(0, 0, 0));
            }
            TEST_CHECK(c.grounded == 1 && c.ground_instance == MOVER);
            tl_vec3 first = tl_sub(c.position, at);
            for (int k = 0; k < 120; k++) {
                at = tl_mul_add(at, velocities[i], WORLD_TICK);
                s.parts[MOVER].pose.position = at;
                tl_character_report r = stage_tick(&s, &c, tl_vec3_make(0, 0, 0));
                TEST_CHECK(c.grounded == 1 && !r.left_ground && r.pushed == 0);
                TEST_CHECK(tl_distance(r.ground_velocity, velocities[i]) < 0.01f);
                TEST_CHECK(tl_distance(tl_sub(c.position, at), first) < 2e-4f);
            }
            stage_end(&s);
        }
    }
}

static tl_quat about_y(float angle)
{
    tl_quat q = { 0, sinf(0.5f * angle), 0, cosf(0.5f * angle) };
    return q;
}

// A turntable carries it around, and tells how far it has turned; it may walk against it.
static void test_turntable(void **state)
{
    (void)state;
    for (int soup = 0; soup < 2; soup++) {
        stage s;
        stage_begin(&s, soup != 0, tl_vec3_make(3, 5, 1));
        tl_character c = standing(tl_vec3_make(4.5f, 5.01f, 1));
        for (int k = 0; k < 10; k++) {
            stage_tick(&s, &c, tl_vec3_make(0, 0, 0));
        }
        float turned = 0;
        for (int k = 1; k <= 300; k++) {
            s.parts[MOVER].pose.rotation = about_y(0.02f * (float)k);
            tl_character_report r = stage_tick(&s, &c, tl_vec3_make(0, 0, 0));
            turned += 2 * asinf(r.turned.y);
            float angle = 0.02f * (float)k;
            tl_vec3 expected = { 3 + 1.5f * cosf(angle), c.position.y, 1 - 1.5f * sinf(angle) };
            TEST_CHECK(c.grounded == 1 && tl_distance(expected, c.position) < 2e-3f);
        }
        TEST_CHECK(fabsf(turned - 6) < 1e-3f);
        stage_end(&s);
    }
}

// A jump from a lift that sinks leaves it, and lands on it again.
static void test_jump_from_sinking_lift(void **state)
{
    (void)state;
    stage s;
    tl_vec3 at = { 0, 60, 0 };
    stage_begin(&s, true, at);
    tl_character c = standing(tl_vec3_make(0, 60.01f, 0));
    tl_character_report r;
    for (int k = 0; k < 90; k++) {
        at.y -= 3 * WORLD_TICK;
        s.parts[MOVER].pose.position = at;
        r = stage_tick(&s, &c, tl_vec3_make(0, 0, 0));
    }
    TEST_CHECK(c.grounded == 1 && fabsf(r.ground_velocity.y + 3) < 0.01f);
    tl_character_step jump = { { 0, 2, 0 }, WORLD_TICK, true };
    at.y -= 3 * WORLD_TICK;
    s.parts[MOVER].pose.position = at;
    TEST_RESULT(tl_scene_refit(s.scene, s.parts, PARTS, NULL, NULL), TL_OK);
    TEST_RESULT(tl_character_move(s.mover, &s.level, &jump, &c, &r), TL_OK);
    TEST_CHECK(r.left_ground && c.grounded == 0 && fabsf(c.velocity.y + 1) < 0.01f);
    int in_air = 1;
    for (int k = 0; k < 60; k++) {
        at.y -= 3 * WORLD_TICK;
        s.parts[MOVER].pose.position = at;
        stage_tick(&s, &c, tl_vec3_make(0, 0, 0));
        in_air += c.grounded == 0;
    }
    TEST_CHECK(in_air > 20 && in_air < 28 && c.grounded == 1 && c.ground_instance == MOVER);
    stage_end(&s);
}

// Carried against a wall that stands still, the wall holds it and the deck slides on below.
static void test_carried_into_wall(void **state)
{
    (void)state;
    stage s;
    tl_vec3 at = { -6, 1, 0 };
    stage_begin(&s, true, at);
    tl_soup *first = s.ground;
    world_box(&s.ground_model, tl_vec3_make(0, 1.2f, -9), tl_vec3_make(1, 6, 9));
    s.ground = world_bake(&s.ground_model);
    s.parts[GROUND].soup = s.ground;
    tl_character c = standing(tl_vec3_make(-5, 1.01f, 0));
    for (int k = 0; k < 180; k++) {
        at.x += 2 * WORLD_TICK;
        s.parts[MOVER].pose.position = at;
        stage_tick(&s, &c, tl_vec3_make(0, 0, 0));
    }
    TEST_CHECK(c.grounded == 1 && c.ground_instance == MOVER && fabsf(c.position.x + 0.302f) < 0.002f);
    tl_blob_free(first);
    stage_end(&s);
}

// A door of 4 m sweeps it along the floor.
static void test_door(void **state)
{
    (void)state;
    for (int soup = 0; soup < 2; soup++) {
        stage s;
        stage_begin(&s, soup != 0, tl_vec3_make(0, 0.6f, 0));
        s.parts[MOVER].pose.position = tl_vec3_make(-4, 1.0f, 0);
        tl_character c = standing(tl_vec3_make(0, 0.01f, 0.2f));
        float pushed = 0;
        for (int k = 0; k < 200; k++) {
            s.parts[MOVER].pose.position.x += 3 * WORLD_TICK;
            pushed += stage_tick(&s, &c, tl_vec3_make(0, 0, 0)).pushed;
        }
        TEST_CHECK(c.grounded == 1 && fabsf(c.position.x - 8.3f) < 0.06f && pushed > 5);
        stage_end(&s);
    }
}

// Onto a crate that is a shape, as onto one of triangles; and one too high is a wall.
static void test_crates(void **state)
{
    (void)state;
    for (int soup = 0; soup < 2; soup++) {
        for (int high = 0; high < 2; high++) {
            stage s;
            float top = high ? 0.45f : 0.35f;
            stage_begin(&s, soup != 0, tl_vec3_make(3, top, 0));
            s.parts[MOVER].pose.rotation = about_y(0.3f);
            TEST_RESULT(tl_scene_refit(s.scene, s.parts, PARTS, NULL, NULL), TL_OK);
            tl_character c = standing(tl_vec3_make(-1, 0.01f, 0.1f));
            for (int k = 0; k < 90; k++) {
                stage_tick(&s, &c, tl_vec3_make(2, 0, 0));
            }
            TEST_CHECK(c.grounded == 1 && fabsf(c.position.y - (high ? 0 : top)) < 0.01f);
            TEST_CHECK(c.ground_instance == (high ? GROUND : MOVER));
            stage_end(&s);
        }
    }
}

// On a deck that is scaled, mirrored too, it stands where the deck is larger, and falls beside it.
static void test_scaled_decks(void **state)
{
    (void)state;
    const tl_vec3 scales[] = { { 2, 2, 2 }, { 2, 0.5f, 3 }, { -2, 1, 2 }, { -2, -1, -2 } };
    for (int k = 0; k < 8; k++) {
        const tl_vec3 scale = scales[k / 2];
        const float top = scale.y < 0 ? 2.5f : 2.0f;
        stage s;
        stage_begin(&s, k % 2 == 0, tl_vec3_make(0, 2, 0));
        s.parts[MOVER].scale = scale;
        tl_character on = standing(tl_vec3_make(-3.5f, 3, 3)), beside = standing(tl_vec3_make(4.6f, 3, 0));
        for (int tick = 0; tick < 120; tick++) {
            stage_tick(&s, &on, tl_vec3_make(0, 0, 0));
            stage_tick(&s, &beside, tl_vec3_make(0, 0, 0));
        }
        TEST_CHECK(on.grounded == 1 && on.ground_instance == MOVER && fabsf(on.position.y - top) < 0.02f);
        TEST_CHECK(beside.grounded == 1 && beside.ground_instance == GROUND && fabsf(beside.position.y) < 0.02f);
        // Walks to the edge and off it, at 4 m.
        for (int tick = 0; tick < 300 && on.ground_instance == MOVER; tick++) {
            stage_tick(&s, &on, tl_vec3_make(-1, 0, 0));
        }
        TEST_CHECK(on.position.x < -3.95f && on.position.x > -4.6f);
        stage_end(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_scaled_decks),
        cmocka_unit_test(test_lifts),
        cmocka_unit_test(test_turntable),
        cmocka_unit_test(test_jump_from_sinking_lift),
        cmocka_unit_test(test_carried_into_wall),
        cmocka_unit_test(test_door),
        cmocka_unit_test(test_crates),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
