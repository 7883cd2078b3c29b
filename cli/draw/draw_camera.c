// SPDX-License-Identifier: MIT
//
// Fitting and projecting without perspective.

#include "cli/draw/draw_camera.h"

#include <math.h>

enum { VIEW_MARGIN_PIXELS = 18, SMALLEST_PANEL = 220 };

static void set_axes(draw_camera *camera, draw_view view)
{
    if (view == DRAW_TOP) {
        // As a map: x to the right, z down.
        camera->right = tl_vec3_make(1, 0, 0);
        camera->up = tl_vec3_make(0, 0, -1);
        camera->forward = tl_vec3_make(0, -1, 0);
        return;
    }
    // From above the corner of least x and greatest z: the map turned by 30 degrees and tilted by 40.
    camera->forward = tl_normalize(tl_vec3_make(0.38f, -0.64f, -0.66f));
    camera->right = tl_normalize(tl_cross(camera->forward, tl_vec3_make(0, 1, 0)));
    camera->up = tl_cross(camera->right, camera->forward);
}

draw_camera draw_camera_fit(draw_view view, tl_aabb bounds, uint32_t panel_size)
{
    draw_camera camera;
    set_axes(&camera, view);
    tl_aabb seen = tl_aabb_empty();
    for (int i = 0; i < 8; i++) {
        tl_vec3 p = tl_vec3_make((i & 1) != 0 ? bounds.max.x : bounds.min.x, (i & 2) != 0 ? bounds.max.y : bounds.min.y,
                                 (i & 4) != 0 ? bounds.max.z : bounds.min.z);
        tl_vec3 along = tl_vec3_make(tl_dot(p, camera.right), tl_dot(p, camera.up), tl_dot(p, camera.forward));
        seen = tl_aabb_add_point(seen, along);
    }
    tl_vec3 size = tl_aabb_size(seen);
    float longest = tl_maxf(size.x, size.y);
    float room = (float)panel_size - 2.0f * (float)VIEW_MARGIN_PIXELS;
    camera.pixels_per_metre = longest > 0.0f ? room / longest : 1.0f;
    camera.width = (uint32_t)ceilf(size.x * camera.pixels_per_metre) + 2 * VIEW_MARGIN_PIXELS;
    camera.height = (uint32_t)ceilf(size.y * camera.pixels_per_metre) + 2 * VIEW_MARGIN_PIXELS;
    camera.width = camera.width < SMALLEST_PANEL ? SMALLEST_PANEL : camera.width;
    camera.height = camera.height < SMALLEST_PANEL ? SMALLEST_PANEL : camera.height;
    camera.middle_right = 0.5f * (seen.min.x + seen.max.x);
    camera.middle_up = 0.5f * (seen.min.y + seen.max.y);
    camera.eye = seen.min.z - 0.05f * (size.x + size.y + size.z) - 1.0f / camera.pixels_per_metre;
    return camera;
}

void draw_camera_project(const draw_camera *camera, tl_vec3 p, double *x_out, double *y_out)
{
    float x = (tl_dot(p, camera->right) - camera->middle_right) * camera->pixels_per_metre;
    float y = (tl_dot(p, camera->up) - camera->middle_up) * camera->pixels_per_metre;
    *x_out = 0.5 * camera->width + (double)x;
    *y_out = 0.5 * camera->height - (double)y;
}

tl_ray draw_camera_ray(const draw_camera *camera, float x, float y)
{
    float right = camera->middle_right + (x - 0.5f * (float)camera->width) / camera->pixels_per_metre;
    float up = camera->middle_up - (y - 0.5f * (float)camera->height) / camera->pixels_per_metre;
    tl_vec3 origin = tl_scale(camera->forward, camera->eye);
    origin = tl_mul_add(tl_mul_add(origin, camera->right, right), camera->up, up);
    tl_ray ray = { origin, camera->forward, INFINITY };
    return ray;
}
