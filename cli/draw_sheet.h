// SPDX-License-Identifier: MIT

#ifndef TALUS_CLI_DRAW_SHEET_H
#define TALUS_CLI_DRAW_SHEET_H

#include "draw_scene.h"
#include "io/io_error.h"

typedef struct draw_options {
    bool top, oblique;   ///< at least one; side by side when both
    uint32_t panel_size; ///< pixels along the longer side of a panel
} draw_options;

/// Renders the scene with title, legend and scale bar, and writes it: SVG when the path ends in ".svg", else PNG.
/// The file is there whole or not at all. `host` lends tasks and progress.
/// Errors: TL_ERR_EMPTY (nothing to draw), TL_ERR_MEMORY, TL_ERR_CANCELLED, TL_ERR_IO; `error_out` says more.
tl_result draw_sheet_write(const draw_scene *scene, const draw_options *options, const char *path, const tl_host *host,
                           tl_io_error *error_out);

#endif
