// SPDX-License-Identifier: MIT
//
// The shape of `sweep` and `overlap`: a ball, an upright capsule or a box.

#ifndef TALUS_CLI_SHAPE_OPTION_H
#define TALUS_CLI_SHAPE_OPTION_H

#include "cli/shared/command.h"

#include <talus/convex.h>

enum { TL_SHAPE_OPTIONS = 4 };

typedef struct tl_shape_option {
    float radius;     ///< of a ball or capsule
    float height;     ///< of a capsule, rounded ends included; 0: a ball
    const char *half; ///< of a box: "X,Y,Z"; NULL: none
    tl_convex shape;  ///< after tl_shape_option_read, around the point (0, 0, 0)
} tl_shape_option;

tl_shape_option tl_default_shape_option(void);

/// The options that fill it, with the end of the table: TL_SHAPE_OPTIONS entries.
void tl_shape_options(tl_shape_option *shape, tl_option *options_out);

/// Makes the shape out of what was parsed; once more when FILE is open, whose axes --half is in. False: reported.
bool tl_shape_option_read(tl_cli *cli, tl_shape_option *shape, tl_exit *exit_out);

#endif
