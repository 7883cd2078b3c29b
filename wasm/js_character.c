// SPDX-License-Identifier: MIT
//
// Characters. Their state is JavaScript's: it comes in by the slot and goes out by it, each number an exact double.

#include "js_scene.h"

#include <string.h>

enum { DEF_NUMBERS = 5 };

static tl_character_report last;

/// Slot: the numbers of a mover's def, and the most triangles near it.
void TL_JS_FULL_EXPORT(js_character_default)(void)
{
    const tl_character_def d = tl_default_character_def();
    const double numbers[] = { (double)d.radius,    (double)d.height, (double)d.step_height,
                               (double)d.max_slope, (double)d.gap,    d.max_triangles };
    memcpy(tl_js_slot, numbers, sizeof numbers);
}

/// Slot: those numbers; then the result.
tl_character_mover *TL_JS_FULL_EXPORT(js_character_create)(void)
{
    tl_character_def def = tl_default_character_def();
    float *const numbers[DEF_NUMBERS] = { &def.radius, &def.height, &def.step_height, &def.max_slope, &def.gap };
    for (uint32_t i = 0; i < DEF_NUMBERS; i++) {
        *numbers[i] = tl_js_f32(i);
    }
    def.max_triangles = tl_js_u32(DEF_NUMBERS);
    tl_character_mover *mover = NULL;
    tl_js_put(0, tl_character_mover_create(&def, &mover, &tl_js_report));
    return mover;
}

void TL_JS_FULL_EXPORT(js_character_free)(tl_character_mover *mover)
{
    tl_character_mover_destroy(mover);
}

static uint32_t put_rotation(uint32_t at, tl_quat q)
{
    at = tl_js_put(tl_js_put(at, (double)q.x), (double)q.y);
    return tl_js_put(tl_js_put(at, (double)q.z), (double)q.w);
}

static uint32_t put_character(const tl_character *c)
{
    uint32_t at = tl_js_put_vec3(tl_js_put_vec3(0, c->position), c->velocity);
    at = tl_js_put_vec3(tl_js_put_vec3(at, c->ground_normal), c->ground_point);
    at = tl_js_put(tl_js_put(tl_js_put(at, c->grounded), c->ground_triangle), c->ground_instance);
    return tl_js_put_vec3(put_rotation(at, c->ground_pose.rotation), c->ground_pose.position);
}

static tl_character take_character(void)
{
    tl_character c;
    c.position = tl_js_vec3(0);
    c.velocity = tl_js_vec3(3);
    c.ground_normal = tl_js_vec3(6);
    c.ground_point = tl_js_vec3(9);
    c.grounded = tl_js_u32(12);
    c.ground_triangle = tl_js_u32(13);
    c.ground_instance = tl_js_u32(14);
    c.ground_pose = tl_js_pose(15);
    return c;
}

enum { STEP = 22 };

/// Moves a character in a soup or a scene; the other one is NULL. Slot: its state, 22 numbers; velocity, seconds,
/// whether it jumps. Then the state, and what the move did.
tl_result TL_JS_FULL_EXPORT(js_character_move)(tl_character_mover *mover, const tl_soup *soup, const tl_js_scene *scene,
                                               const tl_ray_filter *soup_filter, const tl_scene_filter *scene_filter)
{
    tl_character character = take_character();
    const tl_character_step step = { tl_js_vec3(STEP), tl_js_f32(STEP + 3), tl_js_u32(STEP + 4) != 0 };
    tl_character_level level = { .soup = soup, .soup_filter = soup_filter, .scene_filter = scene_filter };
    if (scene != NULL) {
        level.scene = scene->scene;
        level.instances = scene->instances;
    }
    const tl_result result = tl_character_move(mover, &level, &step, &character, &last);
    tl_js_report = last.base;
    uint32_t at = put_character(&character);
    const bool flags[] = { last.landed, last.left_ground, last.blocked, last.hit_ceiling, last.stuck };
    for (uint32_t i = 0; i < sizeof flags / sizeof flags[0]; i++) {
        at = tl_js_put(at, flags[i]);
    }
    at = tl_js_put_vec3(tl_js_put(tl_js_put(at, (double)last.stepped_up), (double)last.pushed), last.carried);
    at = tl_js_put(put_rotation(at, last.turned), last.hit_count);
    for (uint32_t i = 0; i < last.hit_count && i < TL_MAX_CHARACTER_HITS; i++) {
        const tl_character_hit *h = &last.hits[i];
        at = tl_js_put_vec3(tl_js_put_vec3(at, h->point), h->normal);
        at = tl_js_put(tl_js_put(tl_js_put(tl_js_put(at, h->instance), h->triangle), h->material), h->surface);
    }
    return result;
}
