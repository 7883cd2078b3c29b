// SPDX-License-Identifier: MIT
//
// Collecting what a picture shows.

#include "cli/draw/draw_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void draw_scene_init(draw_scene *scene, tl_aabb world_bounds)
{
    memset(scene, 0, sizeof *scene);
    scene->center = tl_aabb_center(world_bounds);
    scene->bounds = tl_aabb_empty();
    scene->overlay_alpha = 0.85f;
    scene->overlay_bias = 1.0f;
}

void draw_scene_free(draw_scene *scene)
{
    free(scene->backdrop.corners);
    free(scene->backdrop.colours);
    free(scene->overlay.corners);
    free(scene->overlay.colours);
    free(scene->lines);
    free(scene->dots);
    memset(scene, 0, sizeof *scene);
}

// Grows `*array` so that it holds `count` + 1 elements; false and the sticky flag when memory is out.
static bool grow_elements(draw_scene *scene, void **array, uint32_t count, uint32_t capacity, size_t size)
{
    if (count < capacity) {
        return true;
    }
    size_t larger = (capacity == 0 ? 1024 : (size_t)capacity * 2) * size;
    void *memory = capacity > UINT32_MAX / 2 ? NULL : realloc(*array, larger);
    if (memory == NULL) {
        scene->out_of_memory = true;
        return false;
    }
    *array = memory;
    return true;
}

static uint32_t grown_elements(uint32_t count, uint32_t capacity)
{
    return count < capacity ? capacity : capacity == 0 ? 1024 : capacity * 2;
}

static tl_vec3 next_element(draw_scene *scene, tl_vec3 world)
{
    tl_vec3 p = tl_sub(world, scene->center);
    scene->bounds = tl_aabb_add_point(scene->bounds, p);
    return p;
}

static void add_to_layer(draw_scene *scene, draw_layer *layer, const tl_vec3 corners[3], draw_colour colour)
{
    void *places = layer->corners;
    void *colours = layer->colours;
    bool fits = grow_elements(scene, &places, layer->count, layer->capacity, 3 * sizeof *layer->corners);
    layer->corners = places;
    fits = fits && grow_elements(scene, &colours, layer->count, layer->capacity, sizeof *layer->colours);
    layer->colours = colours;
    if (!fits) {
        return;
    }
    layer->capacity = grown_elements(layer->count, layer->capacity);
    for (uint32_t k = 0; k < 3; k++) {
        layer->corners[3 * (size_t)layer->count + k] = next_element(scene, corners[k]);
    }
    layer->colours[layer->count++] = colour;
}

void draw_add_backdrop(draw_scene *scene, const tl_mesh_view *mesh)
{
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        tl_vec3 corners[3];
        for (uint32_t k = 0; k < 3; k++) {
            corners[k] = mesh->vertices[mesh->indices[3 * (size_t)i + k]];
        }
        add_to_layer(scene, &scene->backdrop, corners, 0xe2ded5);
    }
}

void draw_add_triangle(draw_scene *scene, tl_vec3 a, tl_vec3 b, tl_vec3 c, draw_colour colour)
{
    const tl_vec3 corners[3] = { a, b, c };
    add_to_layer(scene, &scene->overlay, corners, colour);
}

void draw_add_quad(draw_scene *scene, tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d, draw_colour colour)
{
    draw_add_triangle(scene, a, b, c, colour);
    draw_add_triangle(scene, a, c, d, colour);
}

void draw_add_line(draw_scene *scene, tl_vec3 a, tl_vec3 b, draw_colour colour, float width, float alpha)
{
    void *lines = scene->lines;
    bool fits = grow_elements(scene, &lines, scene->line_count, scene->line_capacity, sizeof *scene->lines);
    scene->lines = lines;
    if (fits) {
        scene->line_capacity = grown_elements(scene->line_count, scene->line_capacity);
        draw_line line = { next_element(scene, a), next_element(scene, b), colour, width, alpha };
        scene->lines[scene->line_count++] = line;
    }
}

void draw_add_dot(draw_scene *scene, tl_vec3 at, draw_colour colour, float radius)
{
    void *dots = scene->dots;
    bool fits = grow_elements(scene, &dots, scene->dot_count, scene->dot_capacity, sizeof *scene->dots);
    scene->dots = dots;
    if (fits) {
        scene->dot_capacity = grown_elements(scene->dot_count, scene->dot_capacity);
        draw_dot dot = { next_element(scene, at), colour, radius };
        scene->dots[scene->dot_count++] = dot;
    }
}

void draw_add_box(draw_scene *scene, tl_aabb box, draw_colour colour, float width, float alpha)
{
    tl_vec3 corner[8];
    for (int i = 0; i < 8; i++) {
        corner[i] = tl_vec3_make((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                 (i & 4) != 0 ? box.max.z : box.min.z);
    }
    for (int i = 0; i < 8; i++) {
        for (int axis = 1; axis < 8; axis *= 2) {
            if ((i & axis) == 0) {
                draw_add_line(scene, corner[i], corner[i | axis], colour, width, alpha);
            }
        }
    }
}

void draw_add_legend(draw_scene *scene, draw_colour colour, const char *text)
{
    if (scene->legend_count < DRAW_MAX_LEGENDS) {
        draw_legend *legend = &scene->legends[scene->legend_count++];
        legend->colour = colour;
        snprintf(legend->text, sizeof legend->text, "%s", text);
    }
}

static uint32_t channel(float value)
{
    return (uint32_t)lrintf(255.0f * tl_clampf(value, 0.0f, 1.0f));
}

// Hue in turns; saturation and value fixed where neighbouring colours are told apart and text stays readable.
static draw_colour colour_of_hue(float hue, float saturation, float value)
{
    float rgb[3];
    const float offset[3] = { 0.0f, 2.0f / 3.0f, 1.0f / 3.0f };
    for (int i = 0; i < 3; i++) {
        float turn = hue + offset[i];
        float distance = fabsf((turn - floorf(turn)) * 6.0f - 3.0f) - 1.0f;
        rgb[i] = value * (1.0f + saturation * (tl_clampf(distance, 0.0f, 1.0f) - 1.0f));
    }
    return channel(rgb[0]) << 16 | channel(rgb[1]) << 8 | channel(rgb[2]);
}

draw_colour draw_colour_of_id(uint32_t id)
{
    if (id == 0) {
        return 0x9a9a9a;
    }
    // Steps of the golden ratio: consecutive ids lie far apart on the colour circle.
    float hue = (float)id * 0.61803399f;
    float value = 0.95f - 0.12f * (float)(id % 3);
    return colour_of_hue(hue - floorf(hue), 0.48f, value);
}

draw_colour draw_colour_mix(draw_colour a, draw_colour b, float t)
{
    draw_colour mixed = 0;
    for (int shift = 0; shift < 24; shift += 8) {
        float from = (float)((a >> shift) & 255);
        float to = (float)((b >> shift) & 255);
        mixed |= (uint32_t)lrintf(from + (to - from) * tl_clampf(t, 0.0f, 1.0f)) << shift;
    }
    return mixed;
}
