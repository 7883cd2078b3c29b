// SPDX-License-Identifier: MIT
//
// What a picture shows: a level as backdrop, coloured triangles over it, lines, dots, and the words around them.
// Positions are kept relative to the scene's centre, so that a level far from the origin is drawn as sharply as any.

#ifndef TALUS_CLI_DRAW_SCENE_H
#define TALUS_CLI_DRAW_SCENE_H

#include <talus/mesh.h>

#include <stdbool.h>
#include <stdint.h>

/// 0xRRGGBB.
typedef uint32_t draw_colour;

/// Triangles with a colour each: three corners a triangle.
typedef struct draw_layer {
    tl_vec3 *corners;
    draw_colour *colours;
    uint32_t count;
    uint32_t capacity;
} draw_layer;

typedef struct draw_line {
    tl_vec3 a, b;
    draw_colour colour;
    float width; ///< pixels
    float alpha; ///< where nothing hides it; a hidden stretch is drawn faintly
} draw_line;

typedef struct draw_dot {
    tl_vec3 at;
    draw_colour colour;
    float radius; ///< pixels
} draw_dot;

typedef struct draw_legend {
    draw_colour colour;
    char text[64];
} draw_legend;

enum { DRAW_MAX_LEGENDS = 8 };

typedef struct draw_scene {
    tl_vec3 center; ///< of the world; all positions below are relative to it
    tl_aabb bounds; ///< relative, of all that was added
    draw_layer backdrop;
    draw_layer overlay;
    float overlay_alpha; ///< 1: the overlay is solid
    float overlay_bias;  ///< metres by which the backdrop may cover the overlay before it counts as hidden
    draw_line *lines;
    uint32_t line_count, line_capacity;
    draw_dot *dots;
    uint32_t dot_count, dot_capacity;
    draw_legend legends[DRAW_MAX_LEGENDS];
    uint32_t legend_count;
    char title[128];
    char subtitle[192];
    bool out_of_memory; ///< sticky; checked once, when the scene is rendered
} draw_scene;

void draw_scene_init(draw_scene *scene, tl_aabb world_bounds);
void draw_scene_free(draw_scene *scene);

/// All triangles of a mesh as the backdrop.
void draw_add_backdrop(draw_scene *scene, const tl_mesh_view *mesh);
void draw_add_triangle(draw_scene *scene, tl_vec3 a, tl_vec3 b, tl_vec3 c, draw_colour colour);
/// Corners in order around.
void draw_add_quad(draw_scene *scene, tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d, draw_colour colour);
void draw_add_line(draw_scene *scene, tl_vec3 a, tl_vec3 b, draw_colour colour, float width, float alpha);
void draw_add_dot(draw_scene *scene, tl_vec3 at, draw_colour colour, float radius);
void draw_add_box(draw_scene *scene, tl_aabb box, draw_colour colour, float width, float alpha);
/// An entry beyond DRAW_MAX_LEGENDS is left out.
void draw_add_legend(draw_scene *scene, draw_colour colour, const char *text);

/// A colour that tells neighbouring ids apart; 0 is grey.
draw_colour draw_colour_of_id(uint32_t id);
/// From a (t = 0) to b (t = 1).
draw_colour draw_colour_mix(draw_colour a, draw_colour b, float t);

#endif
