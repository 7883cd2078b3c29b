// SPDX-License-Identifier: MIT

#ifndef TALUS_CLI_DRAW_SHEET_H
#define TALUS_CLI_DRAW_SHEET_H

#include "cli/draw/draw_scene.h"
#include "io/files/io_error.h"

enum { DRAW_MAX_SHEETS = 16 };

typedef struct draw_options {
    bool top, oblique;   ///< at least one; side by side when both
    uint32_t panel_size; ///< pixels along the longer side of a panel
} draw_options;

/// Renders the scene with title, legend and scale bar, and writes it: SVG when the path ends in ".svg", else PNG.
/// The file is there whole or not at all. `host` lends tasks and progress.
/// Errors: TL_ERR_EMPTY (nothing to draw), TL_ERR_MEMORY, TL_ERR_CANCELLED, TL_ERR_IO; `error_out` says more.
tl_result draw_sheet_write(const draw_scene *scene, const draw_options *options, const char *path, const tl_host *host,
                           tl_io_error *error_out);

/// Sheets side by side in one picture: an overview of several scenes. Zero is empty; free with draw_overview_free.
typedef struct draw_overview {
    struct _cairo_surface *sheets[DRAW_MAX_SHEETS];
    uint32_t count;
} draw_overview;

/// Renders a scene as draw_sheet_write does, and keeps the picture. `path` is for errors. Beyond DRAW_MAX_SHEETS:
/// TL_ERR_LIMIT.
tl_result draw_overview_add(draw_overview *overview, const draw_scene *scene, const draw_options *options,
                            const char *path, const tl_host *host, tl_io_error *error_out);
/// Writes them in rows of `columns` >= 1.
tl_result draw_overview_write(const draw_overview *overview, uint32_t columns, const char *path,
                              tl_io_error *error_out);
void draw_overview_free(draw_overview *overview);

#endif
