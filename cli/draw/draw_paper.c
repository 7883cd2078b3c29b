// SPDX-License-Identifier: MIT

#include "cli/draw/draw_paper.h"

#include "cli/options/output_check.h"
#include "io/files/atomic_write.h"

#include <cairo-svg.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

void draw_set_colour(cairo_t *cairo, draw_colour colour, double alpha)
{
    cairo_set_source_rgba(cairo, ((colour >> 16) & 255) / 255.0, ((colour >> 8) & 255) / 255.0, (colour & 255) / 255.0,
                          alpha);
}

void draw_choose_font(cairo_t *cairo, double size, bool bold)
{
    cairo_select_font_face(cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, size);
}

void draw_text(cairo_t *cairo, double x, double y, double size, bool bold, const char *words)
{
    draw_choose_font(cairo, size, bold);
    cairo_move_to(cairo, x, y);
    cairo_show_text(cairo, words);
    cairo_new_path(cairo);
}

// Back or on to where a character of UTF-8 begins.
static size_t character_at(const char *words, size_t at, int step)
{
    while (at > 0 && ((unsigned char)words[at] & 0xC0) == 0x80) {
        at += (size_t)(ptrdiff_t)step;
    }
    return at;
}

void draw_text_within(cairo_t *cairo, double x, double y, double size, bool bold, const char *words, double width)
{
    enum { MAX_BYTES = 512 };
    const size_t length = strlen(words);
    char shorter[MAX_BYTES];
    snprintf(shorter, sizeof shorter, "%s", words);
    draw_choose_font(cairo, size, bold);
    for (size_t kept = length < MAX_BYTES - 4 ? length : MAX_BYTES - 4;
         kept > 2 && draw_text_width(cairo, shorter) > width; kept--) {
        size_t head = character_at(words, kept / 2, -1);
        size_t tail = character_at(words, length - kept / 2, 1);
        snprintf(shorter, sizeof shorter, "%.*s\xE2\x80\xA6%s", (int)head, words, words + tail);
    }
    draw_text(cairo, x, y, size, bold, shorter);
}

double draw_text_width(cairo_t *cairo, const char *words)
{
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, words, &extents);
    return extents.x_advance;
}

void draw_scale_bar(cairo_t *cairo, double pixels_per_metre, double width, double right, double y)
{
    const double wish = 0.2 * width / pixels_per_metre, power = pow(10.0, floor(log10(wish)));
    const double metres = wish >= 5.0 * power ? 5.0 * power : wish >= 2.0 * power ? 2.0 * power : power;
    const double length = metres * pixels_per_metre;
    const bool is_far = metres >= 1000.0;
    char words[32];
    snprintf(words, sizeof words, is_far ? "%g km" : "%g m", is_far ? metres / 1000.0 : metres);
    draw_set_colour(cairo, DRAW_INK, 1.0);
    cairo_set_line_width(cairo, 1.5);
    cairo_move_to(cairo, right - length, y - 5);
    cairo_line_to(cairo, right - length, y);
    cairo_line_to(cairo, right, y);
    cairo_line_to(cairo, right, y - 5);
    cairo_stroke(cairo);
    draw_text(cairo, right - length + 6, y - 5, 12, false, words);
}

typedef struct paper_file {
    tl_atomic_file *file;
    tl_io_error *error;
    tl_result result;
} paper_file;

static cairo_status_t write_paper_bytes(void *closure, const unsigned char *bytes, unsigned int size)
{
    paper_file *out = closure;
    out->result = out->result == TL_OK ? tl_atomic_file_write(out->file, bytes, size, out->error) : out->result;
    return out->result == TL_OK ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

tl_result draw_paper_write(const char *path, uint32_t width, uint32_t height, draw_paint_fn *paint, const void *user,
                           tl_io_error *error_out)
{
    paper_file out = { NULL, error_out, TL_OK };
    tl_result result = tl_atomic_file_open(path, &out.file, error_out);
    if (result != TL_OK) {
        return result;
    }
    bool svg = tl_has_ending(path, ".svg");
    cairo_surface_t *surface = svg ? cairo_svg_surface_create_for_stream(write_paper_bytes, &out, width, height)
                                   : cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    cairo_t *cairo = cairo_create(surface);
    paint(cairo, user);
    cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    if (svg) {
        cairo_surface_finish(surface);
    } else if (status == CAIRO_STATUS_SUCCESS) {
        status = cairo_surface_write_to_png_stream(surface, write_paper_bytes, &out);
    }
    status = status == CAIRO_STATUS_SUCCESS ? cairo_surface_status(surface) : status;
    cairo_surface_destroy(surface);
    if (out.result == TL_OK && status != CAIRO_STATUS_SUCCESS) {
        out.result = tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, "try a smaller --size", "cannot paint: %s",
                                cairo_status_to_string(status));
    }
    if (out.result != TL_OK) {
        tl_atomic_file_abort(out.file);
        return out.result;
    }
    return tl_atomic_file_commit(out.file, error_out);
}
