// SPDX-License-Identifier: MIT
//
// The pictures are made by the library's own rays: each layer of a scene is baked into a soup, and each pixel asks it.

#ifndef TALUS_CLI_DRAW_RAYCAST_H
#define TALUS_CLI_DRAW_RAYCAST_H

#include "cli/draw/draw_camera.h"
#include "cli/draw/draw_scene.h"

#include <talus/soup.h>

/// The layers of a scene, ready for rays. A layer without triangles is NULL.
typedef struct draw_soups {
    tl_soup *backdrop;
    tl_soup *overlay;
} draw_soups;

tl_result draw_soups_build(const draw_scene *scene, const tl_host *host, draw_soups *soups_out);
void draw_soups_free(draw_soups *soups);

/// Fills camera->width * camera->height pixels, 0xffRRGGBB, rows of `stride` pixels.
tl_result draw_raycast(const draw_scene *scene, const draw_soups *soups, const draw_camera *camera, const tl_host *host,
                       uint32_t *pixels, uint32_t stride);

/// Whether something lies between the eye and a point of the scene, by more than the overlay's bias.
bool draw_is_hidden(const draw_scene *scene, const draw_soups *soups, const draw_camera *camera, tl_vec3 point);

#define DRAW_PAPER 0xfbfaf7u

#endif
