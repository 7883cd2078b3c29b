// SPDX-License-Identifier: MIT
//
// What every picture is painted on: PNG or SVG by the ending of the name, written whole or not at all.

#ifndef TALUS_CLI_DRAW_PAPER_H
#define TALUS_CLI_DRAW_PAPER_H

#include "cli/draw/draw_scene.h"
#include "io/files/io_error.h"

#include <cairo.h>

#define DRAW_INK 0x2b2b33u

typedef void draw_paint_fn(cairo_t *cairo, const void *user);

/// Paints a picture of that many pixels and writes it: SVG when the path ends in ".svg", else PNG. Errors:
/// TL_ERR_MEMORY, TL_ERR_IO; `error_out` says more.
tl_result draw_paper_write(const char *path, uint32_t width, uint32_t height, draw_paint_fn *paint, const void *user,
                           tl_io_error *error_out);

void draw_set_colour(cairo_t *cairo, draw_colour colour, double alpha);
void draw_choose_font(cairo_t *cairo, double size, bool bold);
void draw_text(cairo_t *cairo, double x, double y, double size, bool bold, const char *words);
/// The same in at most `width` pixels: words that need more lose their middle, for "…".
void draw_text_within(cairo_t *cairo, double x, double y, double size, bool bold, const char *words, double width);
/// Pixels, in the font that was chosen last.
double draw_text_width(cairo_t *cairo, const char *words);
/// A bar of 1, 2 or 5 times a power of ten of metres, about a fifth of `width` pixels, which ends at (right, y), and
/// its length under it.
void draw_scale_bar(cairo_t *cairo, double pixels_per_metre, double width, double right, double y);

#endif
