// SPDX-License-Identifier: MIT

#include "cli/shapes/shape_option.h"

#include "cli/level/load_level.h"
#include "cli/options/parse_value.h"

#include <string.h>

tl_shape_option tl_default_shape_option(void)
{
    tl_shape_option shape;
    memset(&shape, 0, sizeof(shape));
    shape.radius = 0.6f; // the navmesh's agent
    return shape;
}

void tl_shape_options(tl_shape_option *shape, tl_option *options_out)
{
    const tl_option options[TL_SHAPE_OPTIONS] = {
        { "radius", 0, TL_OPTION_FLOAT, &shape->radius, "M",
          "metres: radius of the ball around the point, or of the capsule", NULL, 0.0f, 1e6f, 0, 0 },
        { "height", 0, TL_OPTION_FLOAT, &shape->height, "M",
          "metres: height of an upright capsule that stands on the point, round ends included (0: a ball)", NULL, 0.0f,
          1e6f, 0, 0 },
        { "half", 0, TL_OPTION_TEXT, &shape->half, "X,Y,Z", "metres: half extents of a box around the point", NULL, 0,
          0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    memcpy(options_out, options, sizeof(options));
}

bool tl_shape_option_read(tl_cli *cli, tl_shape_option *shape, tl_exit *exit_out)
{
    tl_vec3 zero = tl_vec3_make(0.0f, 0.0f, 0.0f);
    if (shape->half != NULL) {
        float half[3];
        const char *reason = tl_parse_float_list(shape->half, half, 3, 3, NULL);
        if (reason == NULL && !(half[0] >= 0.0f && half[1] >= 0.0f && half[2] >= 0.0f)) {
            reason = "is negative";
        }
        if (reason != NULL) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--half '%s' %s; write it as X,Y,Z", shape->half, reason);
            return false;
        }
        if (shape->height != 0.0f) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "give --half for a box or --height for a capsule, not both");
            return false;
        }
        shape->shape = tl_convex_box(zero, tl_level_enter_half(cli, tl_vec3_make(half[0], half[1], half[2])), 0.0f);
        return true;
    }
    if (shape->height != 0.0f && shape->height < 2.0f * shape->radius) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "a capsule of radius %g is at least %g high; --height is %g",
                                (double)shape->radius, 2.0 * (double)shape->radius, (double)shape->height);
        return false;
    }
    if (shape->height == 0.0f) {
        shape->shape = tl_convex_sphere(zero, shape->radius);
    } else {
        shape->shape = tl_convex_capsule(tl_vec3_make(0.0f, shape->radius, 0.0f),
                                         tl_vec3_make(0.0f, shape->height - shape->radius, 0.0f), shape->radius);
    }
    return true;
}
