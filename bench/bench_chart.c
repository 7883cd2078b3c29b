// SPDX-License-Identifier: MIT
//
// Draws what a benchmark reported (see report.h): curves over a log-log grid, with a ring where the first series meets
// another, and bars grouped by label. Written by Cairo as PNG or SVG, by the ending of the name.

#include <cairo-svg.h>
#include <cairo.h>
#include <jansson.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SERIES = 12, MAX_LABELS = 32, MAX_POINTS = 64 };

static const double PANEL_W = 560.0, PANEL_H = 380.0, MARGIN_LEFT = 64.0, MARGIN_RIGHT = 16.0, MARGIN_TOP = 54.0,
                    MARGIN_BOTTOM = 44.0, HEAD = 34.0, TAU = 6.283185307179586;

// Okabe and Ito's colours, told apart by every kind of sight; the first series is the dark one.
static const unsigned PALETTE[MAX_SERIES] = { 0x1b2a41, 0xe69f00, 0x56b4e9, 0x009e73, 0xd55e00, 0xcc79a7,
                                              0x0072b2, 0xb8a300, 0x8c8c8c, 0x7a5195, 0x2f7f4f, 0x9c3d1e };

typedef struct series {
    const char *name;
    double x[MAX_POINTS], y[MAX_POINTS];
    size_t count;
} series;

typedef struct chart {
    const char *name, *x_label, *unit;
    series lines[MAX_SERIES];
    size_t line_count;
    const char *labels[MAX_LABELS]; // of a bar chart: x is the label's number
    size_t label_count;
    double min_x, max_x, min_y, max_y;
} chart;

static void fail(const char *what, const char *why)
{
    fprintf(stderr, "bench_chart: %s: %s\n", what, why);
    exit(1);
}

static void set_colour(cairo_t *cr, unsigned colour)
{
    cairo_set_source_rgb(cr, (colour >> 16 & 255) / 255.0, (colour >> 8 & 255) / 255.0, (colour & 255) / 255.0);
}

// align 0: from x on; 0.5: centred; 1: up to x.
static void write_text(cairo_t *cr, double x, double y, double align, const char *text)
{
    cairo_text_extents_t extents;
    cairo_text_extents(cr, text, &extents);
    cairo_move_to(cr, x - align * extents.x_advance, y);
    cairo_show_text(cr, text);
    cairo_new_path(cr);
}

static series *series_named(chart *c, const char *name)
{
    for (size_t i = 0; i < c->line_count; i++) {
        if (strcmp(c->lines[i].name, name) == 0) {
            return &c->lines[i];
        }
    }
    if (c->line_count == MAX_SERIES) {
        fail(c->name, "has more series than a picture can show");
    }
    series *fresh = &c->lines[c->line_count++];
    fresh->name = name;
    return fresh;
}

static double label_number(chart *c, const char *label)
{
    for (size_t i = 0; i < c->label_count; i++) {
        if (strcmp(c->labels[i], label) == 0) {
            return (double)i;
        }
    }
    if (c->label_count == MAX_LABELS) {
        fail(c->name, "has more labels than a picture can show");
    }
    c->labels[c->label_count] = label;
    return (double)c->label_count++;
}

static void read_chart(const json_t *from, const json_t *root, chart *c)
{
    memset(c, 0, sizeof *c);
    c->name = json_string_value(json_object_get(from, "name"));
    c->unit = json_string_value(json_object_get(root, "unit"));
    c->x_label = json_string_value(json_object_get(root, "x"));
    if (c->name == NULL || c->unit == NULL) {
        fail("the report", "a chart has no name or no unit");
    }
    c->min_x = c->min_y = HUGE_VAL;
    size_t i;
    json_t *row;
    json_array_foreach(json_object_get(from, "rows"), i, row)
    {
        const char *name = json_string_value(json_object_get(row, "series"));
        const char *label = json_string_value(json_object_get(row, "label"));
        if (name == NULL) {
            fail(c->name, "a row has no series");
        }
        series *s = series_named(c, name);
        if (s->count == MAX_POINTS) {
            fail(c->name, "has more points than a picture can show");
        }
        double x = label != NULL ? label_number(c, label) : json_number_value(json_object_get(row, "x"));
        double y = json_number_value(json_object_get(row, "y"));
        s->x[s->count] = x;
        s->y[s->count++] = y;
        c->min_x = fmin(c->min_x, x);
        c->max_x = fmax(c->max_x, x);
        c->min_y = fmin(c->min_y, y);
        c->max_y = fmax(c->max_y, y);
    }
}

typedef struct axes {
    double left, top, width, height;
    double log_x0, log_x1, log_y0, log_y1;
} axes;

static double at_x(const axes *a, double x)
{
    return a->left + (log10(x) - a->log_x0) / (a->log_x1 - a->log_x0) * a->width;
}

static double at_y(const axes *a, double y)
{
    return a->top + a->height - (log10(y) - a->log_y0) / (a->log_y1 - a->log_y0) * a->height;
}

static void short_number(double value, char *text, size_t size)
{
    if (value >= 1e6) {
        snprintf(text, size, "%gM", value / 1e6);
    } else if (value >= 1e4) {
        snprintf(text, size, "%gk", value / 1e3);
    } else {
        snprintf(text, size, "%g", value);
    }
}

// Lines at 1, 2 and 5 of each decade; along x at the measured points' powers of two would read worse.
static void draw_grid(cairo_t *cr, const axes *a, bool along_x)
{
    double from = along_x ? a->log_x0 : a->log_y0, to = along_x ? a->log_x1 : a->log_y1;
    static const double steps[3] = { 1.0, 2.0, 5.0 };
    cairo_set_font_size(cr, 10.0);
    for (int decade = (int)floor(from) - 1; decade <= (int)ceil(to); decade++) {
        for (int k = 0; k < 3; k++) {
            double value = steps[k] * pow(10.0, decade);
            if (log10(value) < from - 1e-9 || log10(value) > to + 1e-9 || (to - from > 3.0 && k != 0)) {
                continue;
            }
            char text[32];
            short_number(value, text, sizeof text);
            set_colour(cr, 0xe3e6ea);
            cairo_set_line_width(cr, k == 0 ? 1.0 : 0.5);
            if (along_x) {
                cairo_move_to(cr, at_x(a, value), a->top);
                cairo_rel_line_to(cr, 0.0, a->height);
            } else {
                cairo_move_to(cr, a->left, at_y(a, value));
                cairo_rel_line_to(cr, a->width, 0.0);
            }
            cairo_stroke(cr);
            set_colour(cr, 0x5b6673);
            if (along_x) {
                write_text(cr, at_x(a, value), a->top + a->height + 14.0, 0.5, text);
            } else {
                write_text(cr, a->left - 6.0, at_y(a, value) + 3.5, 1.0, text);
            }
        }
    }
}

// Where the first series meets another between two points that both have measured, the curves taken as straight on
// log-log paper, as they are drawn.
static void mark_crossings(cairo_t *cr, const axes *a, const chart *c, size_t other)
{
    const series *s = &c->lines[0], *o = &c->lines[other];
    double before_x = 0.0, before_gap = 0.0, before_y = 0.0;
    bool has_before = false;
    for (size_t i = 0; i < s->count; i++) {
        for (size_t k = 0; k < o->count; k++) {
            if (o->x[k] != s->x[i]) {
                continue;
            }
            double gap = log10(o->y[k]) - log10(s->y[i]);
            if (has_before && (gap > 0.0) != (before_gap > 0.0)) {
                double t = before_gap / (before_gap - gap);
                double x = pow(10.0, log10(before_x) + t * (log10(s->x[i]) - log10(before_x)));
                double y = pow(10.0, log10(before_y) + t * (log10(s->y[i]) - log10(before_y)));
                set_colour(cr, PALETTE[other]);
                cairo_set_line_width(cr, 1.5);
                cairo_new_sub_path(cr);
                cairo_arc(cr, at_x(a, x), at_y(a, y), 6.0, 0.0, TAU);
                cairo_stroke(cr);
                char text[32];
                snprintf(text, sizeof text, "%.0f", x);
                cairo_set_font_size(cr, 10.0);
                write_text(cr, at_x(a, x) + 8.0, at_y(a, y) + 12.0, 0.0, text);
            }
            has_before = true;
            before_x = s->x[i];
            before_y = s->y[i];
            before_gap = gap;
        }
    }
}

static void draw_legend(cairo_t *cr, const chart *c, double left, double top)
{
    double x = left;
    cairo_set_font_size(cr, 10.5);
    for (size_t i = 0; i < c->line_count; i++) {
        cairo_text_extents_t extents;
        cairo_text_extents(cr, c->lines[i].name, &extents);
        if (x > left && x + 16.0 + extents.x_advance > left + PANEL_W - MARGIN_LEFT - MARGIN_RIGHT) {
            x = left;
            top += 14.0;
        }
        set_colour(cr, PALETTE[i]);
        cairo_rectangle(cr, x, top - 8.0, 10.0, 8.0);
        cairo_fill(cr);
        set_colour(cr, 0x23303f);
        write_text(cr, x + 14.0, top, 0.0, c->lines[i].name);
        x += 28.0 + extents.x_advance;
    }
}

static void draw_curves(cairo_t *cr, const chart *c, const axes *a)
{
    draw_grid(cr, a, true);
    draw_grid(cr, a, false);
    for (size_t i = c->line_count; i-- > 0;) {
        const series *s = &c->lines[i];
        set_colour(cr, PALETTE[i]);
        cairo_set_line_width(cr, i == 0 ? 2.6 : 1.5);
        for (size_t k = 0; k < s->count; k++) {
            cairo_line_to(cr, at_x(a, s->x[k]), at_y(a, s->y[k]));
        }
        cairo_stroke(cr);
        for (size_t k = 0; k < s->count; k++) {
            cairo_arc(cr, at_x(a, s->x[k]), at_y(a, s->y[k]), i == 0 ? 3.2 : 2.2, 0.0, TAU);
            cairo_fill(cr);
        }
    }
    for (size_t i = 1; i < c->line_count; i++) {
        mark_crossings(cr, a, c, i);
    }
}

// Bars lie on their side, so that long labels can be read.
static void draw_bars(cairo_t *cr, const chart *c, double left, double top, double height)
{
    const double label_width = 120.0, width = PANEL_W - MARGIN_RIGHT - label_width - 60.0;
    double group = height / (double)c->label_count, bar = fmin(16.0, group * 0.84 / (double)c->line_count);
    for (size_t g = 0; g < c->label_count; g++) {
        double y0 = top + group * ((double)g + 0.5) - bar * (double)c->line_count / 2.0;
        cairo_set_font_size(cr, 10.5);
        set_colour(cr, 0x23303f);
        write_text(cr, left + label_width - 8.0, top + group * ((double)g + 0.5) + 4.0, 1.0, c->labels[g]);
        for (size_t i = 0; i < c->line_count; i++) {
            for (size_t k = 0; k < c->lines[i].count; k++) {
                if (c->lines[i].x[k] != (double)g) {
                    continue;
                }
                double length = fmax(0.0, c->lines[i].y[k] / c->max_y * width);
                set_colour(cr, PALETTE[i]);
                cairo_rectangle(cr, left + label_width, y0 + bar * (double)i, length, bar * 0.9);
                cairo_fill(cr);
                char text[32];
                snprintf(text, sizeof text, "%.3g", c->lines[i].y[k]);
                cairo_set_font_size(cr, fmin(10.0, fmax(6.0, bar)));
                set_colour(cr, 0x5b6673);
                write_text(cr, left + label_width + length + 4.0, y0 + bar * ((double)i + 0.8), 0.0, text);
            }
        }
    }
}

static void draw_chart(cairo_t *cr, const chart *c, double left, double top)
{
    cairo_set_font_size(cr, 13.0);
    set_colour(cr, 0x1b2a41);
    char title[256];
    snprintf(title, sizeof title, c->label_count > 0 ? "%s, %s" : "%s, %s over %s", c->name, c->unit,
             c->x_label != NULL ? c->x_label : "");
    write_text(cr, left + 12.0, top + 18.0, 0.0, title);
    draw_legend(cr, c, left + 12.0, top + 34.0);
    if (c->label_count > 0) {
        draw_bars(cr, c, left, top + MARGIN_TOP, PANEL_H - MARGIN_TOP - 12.0);
        return;
    }
    if (!(c->min_x > 0.0) || !(c->min_y > 0.0)) {
        fail(c->name, "a curve needs x and y above zero");
    }
    axes a = { left + MARGIN_LEFT,
               top + MARGIN_TOP + 8.0,
               PANEL_W - MARGIN_LEFT - MARGIN_RIGHT,
               PANEL_H - MARGIN_TOP - MARGIN_BOTTOM,
               log10(c->min_x) - 0.05,
               log10(c->max_x) + 0.05,
               log10(c->min_y) - 0.08,
               log10(c->max_y) + 0.08 };
    draw_curves(cr, c, &a);
}

static cairo_status_t draw_all(cairo_surface_t *surface, const json_t *root, double width, double height,
                               size_t columns)
{
    cairo_t *cr = cairo_create(surface);
    set_colour(cr, 0xffffff);
    cairo_rectangle(cr, 0.0, 0.0, width, height);
    cairo_fill(cr);
    cairo_select_font_face(cr, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, 16.0);
    set_colour(cr, 0x1b2a41);
    const char *name = json_string_value(json_object_get(root, "benchmark"));
    write_text(cr, 12.0, 23.0, 0.0, name != NULL ? name : "");
    size_t i;
    json_t *from;
    static chart c;
    json_array_foreach(json_object_get(root, "charts"), i, from)
    {
        read_chart(from, root, &c);
        draw_chart(cr, &c, PANEL_W * (double)(i % columns), HEAD + PANEL_H * (double)(i / columns));
    }
    cairo_status_t status = cairo_status(cr);
    cairo_destroy(cr);
    return status;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: bench_chart REPORT.json OUT.png|OUT.svg\n");
        return 2;
    }
    json_error_t error;
    json_t *root = json_load_file(argv[1], 0, &error);
    if (root == NULL) {
        fail(argv[1], error.text);
    }
    size_t count = json_array_size(json_object_get(root, "charts"));
    if (count == 0) {
        fail(argv[1], "holds no chart");
    }
    size_t columns = count < 2 ? 1 : 2, rows = (count + columns - 1) / columns;
    double width = PANEL_W * (double)columns, height = HEAD + PANEL_H * (double)rows;
    size_t length = strlen(argv[2]);
    bool svg = length > 4 && strcmp(argv[2] + length - 4, ".svg") == 0;
    cairo_surface_t *surface = svg ? cairo_svg_surface_create(argv[2], width, height)
                                   : cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    cairo_status_t status = draw_all(surface, root, width, height, columns);
    if (status == CAIRO_STATUS_SUCCESS && !svg) {
        status = cairo_surface_write_to_png(surface, argv[2]);
    }
    cairo_surface_finish(surface);
    if (status == CAIRO_STATUS_SUCCESS && svg) {
        status = cairo_surface_status(surface);
    }
    cairo_surface_destroy(surface);
    json_decref(root);
    if (status != CAIRO_STATUS_SUCCESS) {
        fail(argv[2], cairo_status_to_string(status));
    }
    return 0;
}
