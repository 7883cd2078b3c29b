// SPDX-License-Identifier: MIT
//
// A camera without perspective: lengths can be read off the picture.

#ifndef TALUS_CLI_DRAW_CAMERA_H
#define TALUS_CLI_DRAW_CAMERA_H

#include <talus/soup.h>
#include <talus/vec.h>

typedef enum draw_view { DRAW_TOP, DRAW_OBLIQUE } draw_view;

typedef struct draw_camera {
    tl_vec3 right, up, forward; ///< orthonormal; forward points into the picture
    float pixels_per_metre;
    float middle_right, middle_up; ///< the point in the middle of the panel, along right and up, metres
    float eye;                     ///< along forward, metres: in front of everything
    uint32_t width, height;        ///< pixels
} draw_camera;

/// Sees all of `bounds`; the longer side of the panel is `panel_size` pixels.
draw_camera draw_camera_fit(draw_view view, tl_aabb bounds, uint32_t panel_size);

void draw_camera_project(const draw_camera *camera, tl_vec3 p, double *x_out, double *y_out);

/// The ray through a pixel position (centre of the first pixel: 0.5, 0.5), from the eye's plane to infinity.
tl_ray draw_camera_ray(const draw_camera *camera, float x, float y);

#endif
