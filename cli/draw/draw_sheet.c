// SPDX-License-Identifier: MIT
//
// The sheet: panels made of rays, lines over them by Cairo (faint where the level hides them), and the words around.

#include "cli/draw/draw_sheet.h"

#include "cli/draw/draw_camera.h"
#include "cli/draw/draw_paper.h"
#include "cli/draw/draw_raycast.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    HEAD_PIXELS = 64,
    FOOT_PIXELS = 62, // scale bar and one row of the legend
    GAP_PIXELS = 12,
    SHEET_MARGIN_PIXELS = 20,
    LEGEND_PIXELS = 22,
    LEGEND_SIZE = 13,
    MIN_WIDTH = 420, // pixels: a sheet's words need room beside a narrow level too
    MAX_SHEET_PANELS = 2
};

typedef struct draw_sheet {
    const draw_scene *scene;
    draw_soups soups;
    draw_camera cameras[MAX_SHEET_PANELS];
    cairo_surface_t *images[MAX_SHEET_PANELS];
    uint32_t panel_count;
    uint32_t width, height;
    uint32_t legend_y; // of its first row
} draw_sheet;

// A stretch of a line: hidden ones are drawn faintly, so that one sees where they go on.
static void stroke_lines(cairo_t *cairo, const draw_line *line, const double from[2], const double to[2], bool hidden)
{
    draw_set_colour(cairo, line->colour, (double)line->alpha * (hidden ? 0.28 : 1.0));
    cairo_set_line_width(cairo, (double)line->width);
    cairo_move_to(cairo, from[0], from[1]);
    cairo_line_to(cairo, to[0], to[1]);
    cairo_stroke(cairo);
}

static void draw_one_line(cairo_t *cairo, const draw_sheet *sheet, const draw_camera *camera, const draw_line *line)
{
    const double piece_pixels = 3.0;
    double a[2];
    double b[2];
    draw_camera_project(camera, line->a, &a[0], &a[1]);
    draw_camera_project(camera, line->b, &b[0], &b[1]);
    int pieces = (int)(hypot(b[0] - a[0], b[1] - a[1]) / piece_pixels) + 1;
    double begin = 0.0;
    bool hidden = false;
    for (int i = 0; i <= pieces; i++) {
        double middle = (i + 0.5) / pieces;
        tl_vec3 point = tl_lerp(line->a, line->b, (float)middle);
        bool now = i < pieces ? draw_is_hidden(sheet->scene, &sheet->soups, camera, point) : !hidden;
        if (i > 0 && now != hidden) {
            double end = (double)i / pieces;
            const double from[2] = { a[0] + (b[0] - a[0]) * begin, a[1] + (b[1] - a[1]) * begin };
            const double to[2] = { a[0] + (b[0] - a[0]) * end, a[1] + (b[1] - a[1]) * end };
            stroke_lines(cairo, line, from, to, hidden);
            begin = end;
        }
        hidden = now;
    }
}

static void draw_marks(cairo_t *cairo, const draw_sheet *sheet, const draw_camera *camera)
{
    const draw_scene *scene = sheet->scene;
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    for (uint32_t i = 0; i < scene->line_count; i++) {
        draw_one_line(cairo, sheet, camera, &scene->lines[i]);
    }
    for (uint32_t i = 0; i < scene->dot_count; i++) {
        const draw_dot *dot = &scene->dots[i];
        double x;
        double y;
        draw_camera_project(camera, dot->at, &x, &y);
        bool hidden = draw_is_hidden(scene, &sheet->soups, camera, dot->at);
        draw_set_colour(cairo, dot->colour, hidden ? 0.28 : 1.0);
        cairo_arc(cairo, x, y, (double)dot->radius, 0.0, 6.283185307179586);
        cairo_fill(cairo);
    }
}

// In as many rows as the width asks for, the first at `y`; returns how many. Paints only if `paints`.
static uint32_t draw_legends(cairo_t *cairo, const draw_scene *scene, double width, double y, bool paints)
{
    double x = SHEET_MARGIN_PIXELS;
    uint32_t rows = 1;
    for (uint32_t i = 0; i < scene->legend_count; i++) {
        const draw_legend *legend = &scene->legends[i];
        draw_choose_font(cairo, LEGEND_SIZE, false);
        double taken = 20 + draw_text_width(cairo, legend->text);
        if (x > (double)SHEET_MARGIN_PIXELS && x + taken > width - (double)SHEET_MARGIN_PIXELS) {
            x = SHEET_MARGIN_PIXELS;
            y += (double)LEGEND_PIXELS;
            rows++;
        }
        if (paints) {
            draw_set_colour(cairo, legend->colour, 1.0);
            cairo_rectangle(cairo, x, y - 11, 14, 14);
            cairo_fill(cairo);
            draw_set_colour(cairo, DRAW_INK, 1.0);
            draw_text(cairo, x + 20, y, LEGEND_SIZE, false, legend->text);
        }
        x += taken + 24;
    }
    return rows;
}

static uint32_t legend_rows(const draw_sheet *sheet)
{
    cairo_t *cairo = cairo_create(sheet->images[0]);
    uint32_t rows = draw_legends(cairo, sheet->scene, sheet->width, 0, false);
    cairo_destroy(cairo);
    return rows;
}

static void paint_views(cairo_t *cairo, const void *user)
{
    const draw_sheet *sheet = user;
    draw_set_colour(cairo, DRAW_PAPER, 1.0);
    cairo_paint(cairo);
    double x = 0;
    for (uint32_t i = 0; i < sheet->panel_count; i++) {
        const draw_camera *camera = &sheet->cameras[i];
        cairo_save(cairo);
        cairo_translate(cairo, x, HEAD_PIXELS);
        cairo_set_source_surface(cairo, sheet->images[i], 0, 0);
        cairo_paint(cairo);
        draw_marks(cairo, sheet, camera);
        cairo_restore(cairo);
        draw_scale_bar(cairo, (double)camera->pixels_per_metre, camera->width, x + camera->width - 20,
                       HEAD_PIXELS + camera->height + 18);
        x += camera->width + GAP_PIXELS;
    }
    draw_set_colour(cairo, DRAW_INK, 1.0);
    const double width = sheet->width - 2.0 * (double)SHEET_MARGIN_PIXELS;
    draw_text_within(cairo, SHEET_MARGIN_PIXELS, 30, 20, true, sheet->scene->title, width);
    draw_set_colour(cairo, 0x6a6a72, 1.0);
    draw_text_within(cairo, SHEET_MARGIN_PIXELS, 52, 13, false, sheet->scene->subtitle, width);
    (void)draw_legends(cairo, sheet->scene, sheet->width, sheet->legend_y, true);
}

static tl_result render_panels(draw_sheet *sheet, const draw_options *options, const tl_host *host)
{
    const bool wanted[MAX_SHEET_PANELS] = { options->top, options->oblique };
    sheet->width = GAP_PIXELS;
    for (uint32_t view = 0; view < MAX_SHEET_PANELS; view++) {
        if (!wanted[view]) {
            continue;
        }
        uint32_t i = sheet->panel_count++;
        draw_camera *camera = &sheet->cameras[i];
        *camera = draw_camera_fit(view == 0 ? DRAW_TOP : DRAW_OBLIQUE, sheet->scene->bounds, options->panel_size);
        sheet->images[i] = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)camera->width, (int)camera->height);
        if (cairo_surface_status(sheet->images[i]) != CAIRO_STATUS_SUCCESS) {
            return TL_ERR_MEMORY;
        }
        uint32_t *pixels = (uint32_t *)(void *)cairo_image_surface_get_data(sheet->images[i]);
        uint32_t stride = (uint32_t)cairo_image_surface_get_stride(sheet->images[i]) / 4;
        tl_result result = draw_raycast(sheet->scene, &sheet->soups, camera, host, pixels, stride);
        if (result != TL_OK) {
            return result;
        }
        cairo_surface_mark_dirty(sheet->images[i]);
        sheet->width += camera->width + (i > 0 ? GAP_PIXELS : 0);
        uint32_t height = camera->height + HEAD_PIXELS + FOOT_PIXELS;
        sheet->height = sheet->height < height ? height : sheet->height;
    }
    sheet->width = sheet->width < MIN_WIDTH ? MIN_WIDTH : sheet->width;
    sheet->legend_y = sheet->height - 18;
    sheet->height += (legend_rows(sheet) - 1) * LEGEND_PIXELS;
    return TL_OK;
}

static void free_sheet(draw_sheet *sheet)
{
    for (uint32_t i = 0; i < sheet->panel_count; i++) {
        cairo_surface_destroy(sheet->images[i]);
    }
    draw_soups_free(&sheet->soups);
}

static tl_result make_sheet(const draw_scene *scene, const draw_options *options, const char *path, const tl_host *host,
                            draw_sheet *sheet, tl_io_error *error_out)
{
    memset(sheet, 0, sizeof *sheet);
    if (scene->out_of_memory) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, NULL, "out of memory for the picture");
    }
    if (tl_aabb_is_empty(scene->bounds)) {
        return tl_io_fail(error_out, TL_ERR_EMPTY, path, 0, "try another --stage",
                          "there is nothing to draw in this stage");
    }
    sheet->scene = scene;
    tl_result result = draw_soups_build(scene, host, &sheet->soups);
    if (result == TL_OK) {
        result = render_panels(sheet, options, host);
    }
    return result == TL_OK ? TL_OK : tl_io_fail(error_out, result, path, 0, NULL, "%s", tl_result_text(result));
}

tl_result draw_sheet_write(const draw_scene *scene, const draw_options *options, const char *path, const tl_host *host,
                           tl_io_error *error_out)
{
    draw_sheet sheet;
    tl_result result = make_sheet(scene, options, path, host, &sheet, error_out);
    if (result == TL_OK) {
        result = draw_paper_write(path, sheet.width, sheet.height, paint_views, &sheet, error_out);
    }
    free_sheet(&sheet);
    return result;
}

// ---- Several sheets --------------------------------------------------------------------------------------------

tl_result draw_overview_add(draw_overview *overview, const draw_scene *scene, const draw_options *options,
                            const char *path, const tl_host *host, tl_io_error *error_out)
{
    if (overview->count == DRAW_MAX_SHEETS) {
        return tl_io_fail(error_out, TL_ERR_LIMIT, path, 0, "draw fewer stages", "too many pictures for one sheet");
    }
    draw_sheet sheet;
    tl_result result = make_sheet(scene, options, path, host, &sheet, error_out);
    if (result == TL_OK) {
        cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)sheet.width, (int)sheet.height);
        cairo_t *cairo = cairo_create(image);
        paint_views(cairo, &sheet);
        const bool painted = cairo_status(cairo) == CAIRO_STATUS_SUCCESS;
        cairo_destroy(cairo);
        overview->sheets[overview->count++] = image;
        result = painted ? TL_OK : tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, NULL, "out of memory");
    }
    free_sheet(&sheet);
    return result;
}

typedef struct overview_grid {
    const draw_overview *overview;
    uint32_t columns, rows;
    uint32_t x[DRAW_MAX_SHEETS + 1], y[DRAW_MAX_SHEETS + 1]; // where columns and rows begin
} overview_grid;

static overview_grid lay_out_sheet(const draw_overview *overview, uint32_t columns)
{
    overview_grid grid;
    memset(&grid, 0, sizeof grid);
    grid.overview = overview;
    grid.columns = columns < overview->count ? columns : overview->count;
    grid.rows = (overview->count + columns - 1) / columns;
    for (uint32_t i = 0; i < overview->count; i++) {
        const uint32_t width = (uint32_t)cairo_image_surface_get_width(overview->sheets[i]);
        const uint32_t height = (uint32_t)cairo_image_surface_get_height(overview->sheets[i]);
        uint32_t *x = &grid.x[i % columns + 1], *y = &grid.y[i / columns + 1];
        *x = *x < width ? width : *x;
        *y = *y < height ? height : *y;
    }
    for (uint32_t i = 0; i < grid.columns; i++) {
        grid.x[i + 1] += grid.x[i];
    }
    for (uint32_t i = 0; i < grid.rows; i++) {
        grid.y[i + 1] += grid.y[i];
    }
    return grid;
}

static void paint_overview(cairo_t *cairo, const void *user)
{
    const overview_grid *grid = user;
    draw_set_colour(cairo, DRAW_PAPER, 1.0);
    cairo_paint(cairo);
    for (uint32_t i = 0; i < grid->overview->count; i++) {
        cairo_set_source_surface(cairo, grid->overview->sheets[i], grid->x[i % grid->columns],
                                 grid->y[i / grid->columns]);
        cairo_paint(cairo);
    }
}

tl_result draw_overview_write(const draw_overview *overview, uint32_t columns, const char *path, tl_io_error *error_out)
{
    const overview_grid grid = lay_out_sheet(overview, columns);
    return draw_paper_write(path, grid.x[grid.columns], grid.y[grid.rows], paint_overview, &grid, error_out);
}

void draw_overview_free(draw_overview *overview)
{
    for (uint32_t i = 0; i < overview->count; i++) {
        cairo_surface_destroy(overview->sheets[i]);
    }
    memset(overview, 0, sizeof *overview);
}
