// SPDX-License-Identifier: MIT
//
// What a character does on levels whose answer is known: floors, stairs, ramps, ledges, gaps, corners, ceilings; at any
// speed, from inside of something, far away, and with input that is none.

#include "character_world.h"

#include <string.h>

static const double TOUCH = 1e-6; // metres: what the judge's floats may be off

typedef struct world {
    model m;
    tl_soup *soup;
    tl_character_def def;
    tl_character_mover *mover;
    tl_character_level level;
    double deepest;
} world;

// The level of `m`, which is taken over.
static world world_begin(model *m)
{
    world w;
    memset(&w, 0, sizeof w);
    w.m = *m;
    w.soup = world_bake(&w.m);
    w.def = tl_default_character_def();
    w.mover = world_mover();
    w.level.soup = w.soup;
    return w;
}

static void world_end(world *w)
{
    tl_blob_free(w->soup);
    tl_character_mover_destroy(w->mover);
    model_free(&w->m);
}

static tl_character_report tick(world *w, tl_character *c, tl_vec3 walk)
{
    tl_character_report report = world_tick(w->mover, &w->level, c, walk);
    double depth = world_depth(w->soup, &w->def, c->position);
    w->deepest = depth > w->deepest ? depth : w->deepest;
    return report;
}

static tl_character character_at(float x, float y, float z)
{
    tl_character c;
    memset(&c, 0, sizeof c);
    c.position = tl_vec3_make(x, y, z);
    return c;
}

// Ten thousand inner edges, no bump, and no speed lost.
static void test_flat_floor(void **state)
{
    (void)state;
    model m = { 0 };
    world_floor(&m, -1, -1, 201, 1, 0, 0.125f);
    world w = world_begin(&m);
    tl_character c = character_at(0, 0.5f, 0.03f);
    for (int i = 0; i < 60; i++) {
        world_tick(w.mover, &w.level, &c, tl_vec3_make(0, 0, 0));
    }
    TEST_CHECK(c.grounded == 1 && c.ground_normal.y == 1.0f);
    const float height = c.position.y, begin = c.position.x;
    int ticks = 0;
    for (; ticks < 2400; ticks++) {
        tl_character_report r = world_tick(w.mover, &w.level, &c, tl_vec3_make(5, 0, ticks % 50 < 25 ? 0.9f : -0.9f));
        TEST_CHECK(fabsf(c.position.y - height) <= 1e-5f && c.grounded == 1 && !r.blocked && r.hit_count == 0);
    }
    // 1,600 columns, each with an upright and a slanted edge, and rows besides.
    TEST_CHECK(fabsf(c.position.x - begin - 5.0f * (float)ticks * WORLD_TICK) < 1e-2f);
    world_end(&w);
}

static model stairs(float height, float depth, int count)
{
    model m = { 0 };
    world_floor(&m, -5, -5, 15, 5, 0, 1);
    for (int k = 0; k < count; k++) {
        world_box(&m, tl_vec3_make(1 + (float)k * depth, -1, -2),
                  tl_vec3_make(1 + (float)(k + 1) * depth, (float)(k + 1) * height, 2));
    }
    return m;
}

static void climb(float height, float depth, float speed, bool climbs)
{
    model m = stairs(height, depth, 5);
    world w = world_begin(&m);
    tl_character c = character_at(0.5f, 0.01f, 0);
    const float end = 1 + 4.5f * depth;
    float climbed = 0;
    int ticks = 0, most = (int)(2.0f * (end - 0.5f) / speed / WORLD_TICK) + 20, in_air = 0;
    for (; ticks < most && c.position.x < end; ticks++) {
        tl_character_report r = tick(&w, &c, tl_vec3_make(speed, 0, 0));
        climbed += r.stepped_up;
        in_air += c.grounded == 0;
    }
    TEST_CHECK(w.deepest <= TOUCH);
    if (climbs) {
        TEST_CHECK(c.position.x >= end && fabsf(c.position.y - 5 * height) < 0.01f && in_air <= 1);
        in_air = 0;
        for (ticks = 0; ticks < most && c.position.x > 0.4f; ticks++) {
            tick(&w, &c, tl_vec3_make(-speed, 0, 0));
            in_air += c.grounded == 0;
        }
        TEST_CHECK(c.position.x <= 0.4f && fabsf(c.position.y) < 0.01f && in_air == 0);
        TEST_CHECK(height < 0.2f || climbed > height);
    } else {
        TEST_CHECK(c.position.x < 0.71f && c.position.y < 0.01f);
    }
    world_end(&w);
}

static void test_stairs(void **state)
{
    (void)state;
    const float speeds[] = { 0.1f, 2, 8 };
    for (int i = 0; i < 3; i++) {
        climb(0.05f, 0.5f, speeds[i], true);
        climb(0.18f, 0.28f, speeds[i], true);
        climb(0.3f, 0.4f, speeds[i], true);
        climb(0.4f, 0.5f, speeds[i], true);
        climb(0.41f, 0.5f, speeds[i], false);
        climb(0.45f, 0.5f, speeds[i], false);
        climb(0.6f, 0.5f, speeds[i], false);
    }
}

// A ramp from x = 1, in `pieces` strips, 6 m high or 6 m long.
static model ramp(float degrees, int pieces, float *length_out, float *slope_out)
{
    model m = { 0 };
    float slope = tanf(degrees * 3.14159265f / 180), length = 6 / slope < 6 ? 6 / slope : 6;
    world_floor(&m, -10, -5, 1, 5, 0, 1);
    for (int k = 0; k < pieces; k++) {
        float a = length * (float)k / (float)pieces, b = length * (float)(k + 1) / (float)pieces;
        world_quad(&m, tl_vec3_make(1 + a, a * slope, -5), tl_vec3_make(1 + a, a * slope, 5),
                   tl_vec3_make(1 + b, b * slope, 5), tl_vec3_make(1 + b, b * slope, -5));
    }
    *length_out = length;
    *slope_out = slope;
    return m;
}

// Up to the limit it is walked at full speed and stood on still; beyond, it is a wall from below and a slide from
// above.
static void test_ramps(void **state)
{
    (void)state;
    const float angles[] = { 3, 15, 30, 40, 44, 44.9f, 45.1f, 46, 50, 60, 75, 85 };
    for (int i = 0; i < 12; i++) {
        float length, slope;
        model m = ramp(angles[i], 17, &length, &slope);
        world w = world_begin(&m);
        tl_character c = character_at(0.2f, 0.01f, 0.1f);
        const float end = 1 + 0.8f * length;
        int ticks = 0, in_air = 0;
        for (; ticks < 300 && c.position.x < end; ticks++) {
            tick(&w, &c, tl_vec3_make(3, 0, 0.3f));
            in_air += c.grounded == 0;
        }
        TEST_CHECK(in_air <= 1 && w.deepest <= TOUCH);
        tl_vec3 stood = c.position;
        if (angles[i] < 45) {
            TEST_CHECK(c.position.x >= end);
            TEST_CHECK((float)ticks <= 1.03f * (end - 0.2f) / (3 * WORLD_TICK) + 3);
            TEST_CHECK(fabsf(c.ground_normal.y - cosf(angles[i] * 3.14159265f / 180)) < 1e-3f);
        } else {
            TEST_CHECK(c.position.x < 1 && c.position.y < 0.01f);
        }
        for (int k = 0; k < 100; k++) {
            tick(&w, &c, tl_vec3_make(0, 0, 0));
        }
        TEST_CHECK(tl_distance(stood, c.position) < 1e-5f);
        tl_character dropped = character_at(1 + 0.5f * length, 0.5f * length * slope + 1, 0);
        for (int k = 0; k < 200; k++) {
            tick(&w, &dropped, tl_vec3_make(0, 0, 0));
        }
        TEST_CHECK(dropped.grounded == 1 && w.deepest <= TOUCH);
        TEST_CHECK(angles[i] < 45 ? fabsf(dropped.position.x - 1 - 0.5f * length) < 0.02f : dropped.position.x < 1.2f);
        world_end(&w);
    }
}

// Over the edge it falls, down one step it does not.
static void test_ledges(void **state)
{
    (void)state;
    const float drops[] = { 0.2f, 0.39f, 0.6f, 3 };
    for (int i = 0; i < 4; i++) {
        model m = { 0 };
        world_floor(&m, -5, -5, 10, 5, -drops[i], 1);
        world_box(&m, tl_vec3_make(-4, -drops[i] - 1, -4), tl_vec3_make(1, 0, 4));
        world w = world_begin(&m);
        tl_character c = character_at(0, 0.01f, 0);
        int in_air = 0, landed = 0, left = 0;
        for (int k = 0; k < 120; k++) {
            tl_character_report r = tick(&w, &c, tl_vec3_make(2, 0, 0));
            in_air += c.grounded == 0;
            landed += r.landed;
            left += r.left_ground;
        }
        TEST_CHECK(c.grounded == 1 && fabsf(c.position.y + drops[i]) < 0.01f && w.deepest <= TOUCH);
        TEST_CHECK(drops[i] < 0.4f ? in_air <= 1 && left == 0 : in_air > 3 && left == 1 && landed == 2);
        world_end(&w);
    }
}

// Between walls: a gap 6 mm wider than the capsule lets it through, one narrower than the capsule does not.
static void test_gaps(void **state)
{
    (void)state;
    const float widths[] = { 0.59f, 0.606f, 0.61f, 0.8f };
    for (int i = 0; i < 4; i++) {
        model m = { 0 };
        float half = 0.5f * widths[i];
        world_floor(&m, -5, -5, 10, 5, 0, 1);
        world_box(&m, tl_vec3_make(1, -1, half), tl_vec3_make(4, 3, 4));
        world_box(&m, tl_vec3_make(1, -1, -4), tl_vec3_make(4, 3, -half));
        world w = world_begin(&m);
        tl_character c = character_at(0, 0.01f, 0.01f);
        for (int k = 0; k < 300; k++) {
            tick(&w, &c, tl_vec3_make(2, 0, 0));
        }
        TEST_CHECK(w.deepest <= TOUCH && c.grounded == 1);
        TEST_CHECK(i == 0 ? c.position.x < 1 : c.position.x > 5);
        world_end(&w);
    }
}

// Pushed into corners, of walls of many triangles, it comes to rest: to the bit.
static void test_corners(void **state)
{
    (void)state;
    for (int degrees = 5; degrees <= 165; degrees += 10) {
        float half = (float)degrees * 3.14159265f / 360, c0 = cosf(half), s0 = sinf(half);
        model m = { 0 };
        world_floor(&m, -10, -10, 10, 10, 0, 0.5f);
        for (int k = 0; k < 16; k++) {
            float a = 0.5f * (float)k, b = a + 0.5f;
            for (int side = -1; side <= 1; side += 2) {
                float s = s0 * (float)side;
                world_quad(&m, tl_vec3_make(4 - a * c0, -0.5f, a * s), tl_vec3_make(4 - a * c0, 3, a * s),
                           tl_vec3_make(4 - b * c0, 3, b * s), tl_vec3_make(4 - b * c0, -0.5f, b * s));
            }
        }
        world w = world_begin(&m);
        tl_character c = character_at(degrees < 10 ? -3.5f : -3, 0.01f, 0.02f);
        tl_vec3 before = c.position;
        float moved = 0;
        for (int k = 0; k < 600; k++) {
            before = c.position;
            tl_character_report r = tick(&w, &c, tl_vec3_make(3, 0, 0.02f));
            moved = k > 500 ? fmaxf(moved, tl_distance(before, c.position)) : 0;
            TEST_CHECK(k < 550 || (r.blocked && r.hit_count >= 2));
        }
        TEST_CHECK(moved <= 1e-6f && w.deepest <= TOUCH && c.grounded == 1);
        TEST_CHECK(fabsf(c.position.x - (4 - 0.302f / s0)) < 0.01f);
        TEST_CHECK(tl_length(c.velocity) < 0.05f);
        world_end(&w);
    }
}

static void test_ceilings(void **state)
{
    (void)state;
    model m = { 0 };
    world_floor(&m, -5, -5, 5, 5, 0, 0.5f);
    world_floor(&m, -5, -5, 5, 5, 2.2f, 0.5f);
    // One that slants down to the floor.
    world_quad(&m, tl_vec3_make(1, 2.2f, -5), tl_vec3_make(4, 0, -5), tl_vec3_make(4, 0, 5), tl_vec3_make(1, 2.2f, 5));
    world w = world_begin(&m);
    tl_character c = character_at(-2, 0.01f, 0);
    for (int k = 0; k < 10; k++) {
        tick(&w, &c, tl_vec3_make(0, 0, 0));
    }
    tl_character_step jump = { { 0, 8, 0 }, WORLD_TICK, true };
    tl_character_report r;
    bool hit = false;
    float top = 0;
    TEST_RESULT(tl_character_move(w.mover, &w.level, &jump, &c, &r), TL_OK);
    TEST_CHECK(r.left_ground && c.grounded == 0 && c.velocity.y > 7);
    for (int k = 0; k < 90; k++) {
        r = tick(&w, &c, tl_vec3_make(0, 0, 0));
        hit = hit || r.hit_ceiling;
        top = fmaxf(top, c.position.y);
    }
    TEST_CHECK(hit && top > 0.39f && top < 0.4f && c.grounded == 1);
    tl_vec3 before = c.position;
    for (int k = 0; k < 200; k++) {
        before = c.position;
        tick(&w, &c, tl_vec3_make(4, 0, 0.1f));
    }
    TEST_CHECK(c.grounded == 1 && c.position.y < 0.01f && c.position.x < 1.5f && w.deepest <= TOUCH);
    TEST_CHECK(tl_distance(before, c.position) < 0.1f * WORLD_TICK + 1e-5f);
    world_end(&w);
}

// Rocks with steep sides are steps too, at any speed, up to the height of one.
static void test_rocks(void **state)
{
    (void)state;
    const float heights[] = { 0.2f, 0.39f, 0.5f };
    for (int i = 0; i < 6; i++) {
        model m = { 0 };
        const float h = heights[i % 3], speed = i < 3 ? 3 : 0.5f;
        world_floor(&m, -5, -5, 10, 5, 0, 1);
        // A frustum: 70 degrees, and level on top.
        const tl_vec3 foot[4] = { { 1, -0.1f, -2 }, { 1, -0.1f, 2 }, { 3, -0.1f, 2 }, { 3, -0.1f, -2 } };
        tl_vec3 top[4];
        for (int k = 0; k < 4; k++) {
            float in = (h + 0.1f) * 0.364f;
            top[k] = tl_vec3_make(foot[k].x + (k < 2 ? in : -in), h, foot[k].z + (k == 1 || k == 2 ? -in : in));
        }
        for (int k = 0; k < 4; k++) {
            world_quad(&m, foot[k], foot[(k + 1) % 4], top[(k + 1) % 4], top[k]);
        }
        world_quad(&m, top[0], top[1], top[2], top[3]);
        world w = world_begin(&m);
        tl_character c = character_at(0, 0.01f, 0.1f);
        for (int k = 0; k < (int)(2 / speed / WORLD_TICK); k++) {
            tick(&w, &c, tl_vec3_make(speed, 0, 0));
        }
        TEST_CHECK(w.deepest <= TOUCH && c.grounded == 1);
        TEST_CHECK(i % 3 < 2 ? fabsf(c.position.y - h) < 0.01f && c.position.x > 1.5f : c.position.y < 0.01f);
        world_end(&w);
    }
}

// A beam with steep sides on the floor, or a sheet that stands on its edge, is a step too: over it and down again, at
// any speed, up to a step's height. So is a row of stones without a level face.
static void test_beams(void **state)
{
    (void)state;
    const float heights[] = { 0.1f, 0.25f, 0.39f, 0.43f };
    for (int i = 0; i < 24; i++) {
        model m = { 0 };
        const float h = heights[i % 4], speed = i < 12 ? 3 : 0.5f, half = i / 4 % 3 == 0 ? 0.0f : 0.12f;
        world_floor(&m, -5, -5, 10, 5, 0, 1);
        const float width = i / 4 % 3 == 2 ? 0.5f : 10.0f; // stones, or one beam
        for (float z = -5; z < 4.9f; z += width) {
            const tl_vec3 in = { 1.5f - half, 0, z }, out = { 1.5f + half, 0, z };
            const float lean = width < 1 ? 0.2f * width : 0.0f;
            const tl_vec3 top = { 1.5f, h, z + lean }, end = { 1.5f, h, z + width - lean };
            const tl_vec3 in_end = { in.x, 0, z + width }, out_end = { out.x, 0, z + width };
            world_quad(&m, in, in_end, end, top);
            world_quad(&m, out_end, out, top, end);
        }
        world w = world_begin(&m);
        tl_character c = character_at(0, 0.01f, 0.13f);
        int in_air = 0;
        for (int k = 0; k < (int)(3.5f / speed / WORLD_TICK); k++) {
            tick(&w, &c, tl_vec3_make(speed, 0, 0));
            in_air += c.grounded == 0;
        }
        TEST_CHECK(w.deepest <= TOUCH && c.grounded == 1 && in_air <= 20);
        TEST_CHECK(c.position.y < 0.01f && (i % 4 < 3 ? c.position.x > 2.5f : c.position.x < 1.5f));
        world_end(&w);
    }
}

// Who falls against a steep slope slides down it, however hard it pushes: at a terminal speed, as the push takes the
// slide's horizontal part every time.
static void test_clinging(void **state)
{
    (void)state;
    const float angles[] = { 46, 50, 60, 75, 85 };
    for (int i = 0; i < 5; i++) {
        float length, slope;
        model m = ramp(angles[i], 17, &length, &slope);
        world w = world_begin(&m);
        tl_character c = character_at(0.6f + 0.5f * length, 0.5f * length * slope + 0.3f, 0.1f);
        const float top = c.position.y;
        int ticks = 0;
        for (; ticks < 1500 && c.grounded == 0; ticks++) {
            tick(&w, &c, tl_vec3_make(4, 0, 0));
        }
        TEST_CHECK(c.grounded == 1 && c.position.y < 0.01f && w.deepest <= TOUCH);
        TEST_CHECK(top / ((float)ticks * WORLD_TICK) > 0.15f);
        world_end(&w);
    }
}

// Put into walls and floors it comes out, by the short way; between walls that leave no room it says that it is stuck.
static void test_inside(void **state)
{
    (void)state;
    model m = { 0 };
    world_floor(&m, -5, -5, 5, 5, 0, 0.5f);
    world_box(&m, tl_vec3_make(1, -1, -4), tl_vec3_make(2, 3, 4));
    world_quad(&m, tl_vec3_make(-3, 0, -4), tl_vec3_make(-3, 3, -4), tl_vec3_make(-3, 3, 4), tl_vec3_make(-3, 0, 4));
    world_quad(&m, tl_vec3_make(-3.5f, 0, -4), tl_vec3_make(-3.5f, 3, -4), tl_vec3_make(-3.5f, 3, 4),
               tl_vec3_make(-3.5f, 0, 4));
    world w = world_begin(&m);
    const tl_vec3 starts[] = {
        { 0, -0.2f, 0 }, { 0.8f, 0.1f, 0 }, { 0.75f, -0.1f, 0 }, { -2.9f, 0.3f, 1 }, { 0, -0.9f, 2 }
    };
    for (int i = 0; i < 5; i++) {
        tl_character c = character_at(starts[i].x, starts[i].y, starts[i].z);
        tl_character_report first = world_tick(w.mover, &w.level, &c, tl_vec3_make(0, 0, 0));
        TEST_CHECK(first.pushed > 0);
        for (int k = 0; k < 60; k++) {
            first = world_tick(w.mover, &w.level, &c, tl_vec3_make(0, 0, 0));
        }
        TEST_CHECK(!first.stuck && world_depth(w.soup, &w.def, c.position) <= TOUCH);
        TEST_CHECK(c.position.x < 0.7f && (i == 4 || tl_distance(c.position, starts[i]) < 0.6f));
    }
    tl_character c = character_at(-3.25f, 0.1f, 0);
    tl_character_report r = world_tick(w.mover, &w.level, &c, tl_vec3_make(0, 0, 0));
    TEST_CHECK(r.stuck && tl_is_finite(c.position));
    world_end(&w);
}

// A wall of one sheet stops it at any speed, and so does the floor.
static void test_fast(void **state)
{
    (void)state;
    model m = { 0 };
    world_floor(&m, -600, -8, 600, 8, 0, 8);
    world_quad(&m, tl_vec3_make(500, 0, -8), tl_vec3_make(500, 4, -8), tl_vec3_make(500, 4, 8),
               tl_vec3_make(500, 0, 8));
    world w = world_begin(&m);
    for (float speed = 10; speed < 60000; speed *= 1.7f) {
        for (int flies = 0; flies < 2; flies++) {
            tl_character c = character_at(-400, 0.01f, 0.3f);
            tick(&w, &c, tl_vec3_make(0, 0, 0));
            tl_character_step step = { { speed, flies ? -0.1f * speed : 0, 0.001f * speed }, WORLD_TICK, flies != 0 };
            for (int k = 0; k < (int)(1000 / (speed * WORLD_TICK)) + 2; k++) {
                step.velocity.z = -step.velocity.z;
                TEST_RESULT(tl_character_move(w.mover, &w.level, &step, &c, NULL), TL_OK);
            }
            TEST_CHECK(fabsf(c.position.x - 499.698f) < 0.002f && fabsf(c.position.y) < 0.01f);
            TEST_CHECK(world_depth(w.soup, &w.def, c.position) <= 1e-4);
        }
    }
    world_end(&w);
}

// The same walk far from the origin: off by no more than sixteen roundings of the coordinates each step, never deep.
static void test_far_away(void **state)
{
    (void)state;
    for (float far = 1000; far < 7e4f; far *= 4) {
        model m = { 0 };
        world_floor(&m, far - 4, far - 4, far + 8, far + 4, 0, 1);
        world_box(&m, tl_vec3_make(far + 2, -1, far - 4), tl_vec3_make(far + 4, 0.25f, far + 4));
        world_box(&m, tl_vec3_make(far + 6, -1, far - 4), tl_vec3_make(far + 7, 3, far + 4));
        world w = world_begin(&m);
        tl_character c = character_at(far, 0.5f, far);
        for (int k = 0; k < 240; k++) {
            tick(&w, &c, tl_vec3_make(2, 0, 0.5f));
        }
        float gap = fmaxf(0.002f, 2 * far * 9.6e-7f);
        TEST_CHECK(w.deepest <= 1e-3 && c.grounded == 1);
        TEST_CHECK(fabsf(c.position.x - (far + 5.7f)) < 0.01f + 2 * gap && c.position.y < 0.01f + 2 * gap);
        world_end(&w);
    }
}

static void expect_refusal(const world *w, tl_character_step step, tl_character c, tl_result expected,
                           const char *field)
{
    tl_character before = c;
    tl_character_report r;
    TEST_RESULT(tl_character_move(w->mover, &w->level, &step, &c, &r), expected);
    assert_string_equal(r.base.field, field);
    TEST_CHECK(memcmp(&before, &c, sizeof c) == 0);
}

static void test_bad_input(void **state)
{
    (void)state;
    model m = { 0 };
    world_floor(&m, -5, -5, 5, 5, 0, 0.1f);
    world w = world_begin(&m);
    const tl_character_step still = { { 0, 0, 0 }, WORLD_TICK, false };
    const tl_character here = character_at(0, 0.002f, 0);
    tl_character_step step = still;
    step.velocity.z = NAN;
    expect_refusal(&w, step, here, TL_ERR_NOT_FINITE, "velocity");
    step.velocity.z = 7e4f;
    expect_refusal(&w, step, here, TL_ERR_RANGE, "velocity");
    step = still;
    step.seconds = -1;
    expect_refusal(&w, step, here, TL_ERR_ARGUMENT, "seconds");
    step.seconds = INFINITY;
    expect_refusal(&w, step, here, TL_ERR_ARGUMENT, "seconds");
    expect_refusal(&w, still, character_at(0, INFINITY, 0), TL_ERR_NOT_FINITE, "position");
    expect_refusal(&w, still, character_at(8e4f, 0, 0), TL_ERR_RANGE, "position");
    tl_character_def def = w.def;
    def.max_triangles = 16;
    tl_character_mover_destroy(w.mover);
    TEST_RESULT(tl_character_mover_create(&def, &w.mover, NULL), TL_OK);
    expect_refusal(&w, still, here, TL_ERR_LIMIT, "max_triangles");
    world_end(&w);
}

// The state is all there is: a copy of it goes the same way, with another mover too.
static void test_rollback(void **state)
{
    (void)state;
    model m = stairs(0.3f, 0.4f, 5);
    world w = world_begin(&m);
    tl_character c = character_at(0, 0.3f, 0), saved = c;
    for (int k = 0; k < 100; k++) {
        if (k == 30) {
            saved = c;
        }
        tick(&w, &c, tl_vec3_make(2, 0, 0.2f));
    }
    tl_character_mover *other = world_mover();
    for (int k = 30; k < 100; k++) {
        world_tick(other, &w.level, &saved, tl_vec3_make(2, 0, 0.2f));
    }
    TEST_CHECK(memcmp(&saved, &c, sizeof c) == 0);
    tl_character_mover_destroy(other);
    world_end(&w);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flat_floor), cmocka_unit_test(test_stairs),    cmocka_unit_test(test_ramps),
        cmocka_unit_test(test_ledges),     cmocka_unit_test(test_gaps),      cmocka_unit_test(test_corners),
        cmocka_unit_test(test_ceilings),   cmocka_unit_test(test_inside),    cmocka_unit_test(test_fast),
        cmocka_unit_test(test_far_away),   cmocka_unit_test(test_bad_input), cmocka_unit_test(test_rollback),
        cmocka_unit_test(test_rocks),      cmocka_unit_test(test_beams),     cmocka_unit_test(test_clinging),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
