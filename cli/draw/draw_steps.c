// SPDX-License-Identifier: MIT

#include "cli/draw/draw_steps.h"

#include "cli/draw/draw_paper.h"
#include "cli/draw/draw_steps_record.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COLUMNS = 4, MAX_STEP_PANELS = 12, HEAD = 64, FOOT = 44, CAPTION = 40, GAP = 14 };

static const draw_colour FLOOR = 0xeceef1, DONE = 0xcfe3f1, OUTLINE = 0x23303f, CANDIDATE = 0x4f86b5, CHOSEN = 0xc0392b,
                         FRESH = 0xf2c14e, FAINT = 0xa9b4c0;

typedef struct steps_sheet {
    const tl_contour_set *set;
    const draw_steps_options *options;
    const steps_record *record;
    const char *summary;
    uint32_t columns, rows, width, height;
    uint32_t panel_width, panel_height; // pixels, without the caption
    int64_t min_x, min_z;
    double scale; // pixels a lattice unit
} steps_sheet;

uint32_t draw_steps_telling_contour(const tl_contour_set *set)
{
    enum { EASY_TO_READ = 32 };
    uint32_t best = UINT32_MAX;
    for (uint32_t i = 0; i < set->contour_count; i++) {
        uint32_t count = set->contours[i].vertex_count;
        uint32_t best_count = best != UINT32_MAX ? set->contours[best].vertex_count : 0;
        bool easy = count <= EASY_TO_READ, best_easy = best_count <= EASY_TO_READ;
        bool better = easy ? !best_easy || count > best_count : !best_easy && count < best_count;
        if (count >= 3 && (best == UINT32_MAX || better)) {
            best = i;
        }
    }
    return best;
}

static void to_panel(const steps_sheet *sheet, int32_t x, int32_t z, double *u, double *v)
{
    *u = ((double)(x - sheet->min_x) + 0.5) * sheet->scale;
    *v = ((double)(z - sheet->min_z) + 0.5) * sheet->scale;
}

static void add_loop(cairo_t *cairo, const steps_sheet *sheet, const int32_t *pairs, uint32_t count)
{
    cairo_new_sub_path(cairo); // else the loop begins where the last one ended
    for (uint32_t i = 0; i < count; i++) {
        double u, v;
        to_panel(sheet, pairs[2 * (size_t)i], pairs[2 * (size_t)i + 1], &u, &v);
        cairo_line_to(cairo, u, v);
    }
    cairo_close_path(cairo);
}

static void fill_loop(cairo_t *cairo, const steps_sheet *sheet, const int32_t *pairs, uint32_t count,
                      draw_colour colour)
{
    add_loop(cairo, sheet, pairs, count);
    draw_set_colour(cairo, colour, 1.0);
    cairo_fill(cairo);
}

static void add_step_contour(cairo_t *cairo, const steps_sheet *sheet)
{
    const tl_contour *contour = &sheet->set->contours[sheet->options->contour];
    for (uint32_t i = 0; i < contour->vertex_count; i++) {
        const tl_contour_vertex *vertex = &sheet->set->vertices[contour->first_vertex + i];
        double u, v;
        to_panel(sheet, vertex->x, vertex->z, &u, &v);
        cairo_line_to(cairo, u, v);
    }
    cairo_close_path(cairo);
}

static void stroke_step(cairo_t *cairo, draw_colour colour, double width)
{
    draw_set_colour(cairo, colour, 1.0);
    cairo_set_line_width(cairo, width);
    cairo_stroke(cairo);
}

static void add_segment(cairo_t *cairo, const steps_sheet *sheet, const int32_t *ends)
{
    double u, v;
    to_panel(sheet, ends[0], ends[1], &u, &v);
    cairo_move_to(cairo, u, v);
    to_panel(sheet, ends[2], ends[3], &u, &v);
    cairo_line_to(cairo, u, v);
}

static const int32_t *partitions_of(const steps_sheet *sheet, const steps_entry *entry)
{
    return sheet->record->numbers + entry->first;
}

static const int32_t *step_outline(const steps_sheet *sheet, const steps_entry *entry)
{
    return partitions_of(sheet, entry) + 4 * (size_t)entry->partition_count;
}

static const int32_t *step_corners(const steps_sheet *sheet, const steps_entry *entry)
{
    return step_outline(sheet, entry) + 2 * (size_t)entry->outline_count;
}

// The potential partitions dashed, and the chosen one, which is the first, over them.
static void draw_choice(cairo_t *cairo, const steps_sheet *sheet, const steps_entry *entry)
{
    static const double dashes[2] = { 4.0, 3.0 };
    const int32_t *partitions = partitions_of(sheet, entry);
    for (uint32_t i = 1; i < entry->partition_count; i++) {
        add_segment(cairo, sheet, partitions + 4 * (size_t)i);
    }
    cairo_set_dash(cairo, dashes, 2, 0.0);
    stroke_step(cairo, CANDIDATE, 1.2);
    cairo_set_dash(cairo, NULL, 0, 0.0);
    if (entry->partition_count > 0) {
        add_segment(cairo, sheet, partitions);
        stroke_step(cairo, CHOSEN, 2.4);
    }
}

static void draw_contour(cairo_t *cairo, const steps_sheet *sheet)
{
    add_step_contour(cairo, sheet);
    stroke_step(cairo, OUTLINE, 1.6);
}

static void draw_dots(cairo_t *cairo, const steps_sheet *sheet, const int32_t *pairs, uint32_t count)
{
    draw_set_colour(cairo, OUTLINE, 1.0);
    for (uint32_t i = 0; i < count; i++) {
        double u, v;
        to_panel(sheet, pairs[2 * (size_t)i], pairs[2 * (size_t)i + 1], &u, &v);
        cairo_arc(cairo, u, v, 2.2, 0.0, 6.283185307179586);
        cairo_fill(cairo);
    }
}

static void draw_cut(cairo_t *cairo, const steps_sheet *sheet, uint32_t step)
{
    const steps_of_kind *cuts = &sheet->record->kinds[TL_POLYGON_STEP_CUT];
    for (uint32_t i = 0; i <= step; i++) {
        const steps_entry *entry = &cuts->entries[i];
        fill_loop(cairo, sheet, step_corners(sheet, entry), entry->corner_count, i == step ? FRESH : DONE);
    }
    for (uint32_t i = 0; i < step; i++) {
        add_loop(cairo, sheet, step_corners(sheet, &cuts->entries[i]), cuts->entries[i].corner_count);
    }
    stroke_step(cairo, 0xffffff, 1.0);
    draw_contour(cairo, sheet);
    const steps_entry *entry = &cuts->entries[step];
    add_loop(cairo, sheet, step_outline(sheet, entry), entry->outline_count);
    stroke_step(cairo, OUTLINE, 1.6);
    draw_choice(cairo, sheet, entry);
    draw_dots(cairo, sheet, step_outline(sheet, entry), entry->outline_count);
}

// What the cuts left and no earlier merge has taken away.
static void draw_edges(cairo_t *cairo, const steps_sheet *sheet, uint64_t merges_done)
{
    const steps_of_kind *cuts = &sheet->record->kinds[TL_POLYGON_STEP_CUT];
    const steps_of_kind *merges = &sheet->record->kinds[TL_POLYGON_STEP_MERGE];
    for (uint64_t i = 0; i < cuts->count; i++) {
        if (cuts->entries[i].partition_count > 0) {
            add_segment(cairo, sheet, partitions_of(sheet, &cuts->entries[i]));
        }
    }
    stroke_step(cairo, FAINT, 1.0);
    // Painted over with the floor: the same segments, so nothing else can be hit but where edges meet.
    for (uint64_t i = 0; i < merges_done; i++) {
        add_segment(cairo, sheet, partitions_of(sheet, &merges->entries[i]));
    }
    stroke_step(cairo, FLOOR, 2.4);
}

static void draw_merge(cairo_t *cairo, const steps_sheet *sheet, uint32_t step)
{
    draw_edges(cairo, sheet, step);
    const steps_entry *entry = &sheet->record->kinds[TL_POLYGON_STEP_MERGE].entries[step];
    fill_loop(cairo, sheet, step_corners(sheet, entry), entry->corner_count, FRESH);
    add_loop(cairo, sheet, step_corners(sheet, entry), entry->corner_count);
    stroke_step(cairo, OUTLINE, 1.2);
    draw_contour(cairo, sheet);
    draw_choice(cairo, sheet, entry);
}

static void draw_polygons(cairo_t *cairo, const steps_sheet *sheet)
{
    const tl_polygon_mesh *mesh = &sheet->record->mesh;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            const int32_t *vertex = mesh->vertices + 3 * (size_t)mesh->indices[k];
            double u, v;
            to_panel(sheet, vertex[0], vertex[2], &u, &v);
            cairo_line_to(cairo, u, v);
        }
        cairo_close_path(cairo);
        draw_set_colour(cairo, draw_colour_mix(draw_colour_of_id(p + 1), 0xffffff, 0.35f), 1.0);
        cairo_fill_preserve(cairo);
        stroke_step(cairo, 0xffffff, 1.0);
    }
    draw_contour(cairo, sheet);
}

static void draw_triangles(cairo_t *cairo, const steps_sheet *sheet)
{
    const steps_of_kind *cuts = &sheet->record->kinds[TL_POLYGON_STEP_CUT];
    for (uint64_t i = 0; i < cuts->count; i++) {
        const steps_entry *entry = &cuts->entries[i];
        fill_loop(cairo, sheet, step_corners(sheet, entry), entry->corner_count, DONE);
    }
    for (uint64_t i = 0; i < cuts->count; i++) {
        add_loop(cairo, sheet, step_corners(sheet, &cuts->entries[i]), cuts->entries[i].corner_count);
    }
    stroke_step(cairo, CANDIDATE, 1.0);
    draw_contour(cairo, sheet);
}

static void caption(cairo_t *cairo, const char *first, const char *second)
{
    draw_set_colour(cairo, DRAW_INK, 1.0);
    draw_text(cairo, 4, -22, 13, true, first);
    draw_set_colour(cairo, 0x6a6a72, 1.0);
    draw_text(cairo, 4, -6, 11.5, false, second);
}

static void draw_step_panel(cairo_t *cairo, const steps_sheet *sheet, uint32_t step)
{
    bool merging = sheet->options->kind == TL_POLYGON_STEP_MERGE;
    const steps_of_kind *kind = &sheet->record->kinds[sheet->options->kind];
    const steps_entry *entry = &kind->entries[step];
    const int32_t *chosen = partitions_of(sheet, entry);
    char first[64], second[96] = "the last triangle";
    snprintf(first, sizeof first, "%s %u of %llu", merging ? "merge" : "cut", step + 1,
             (unsigned long long)kind->count);
    if (entry->partition_count > 0) {
        double length = hypot((double)chosen[0] - (double)chosen[2], (double)chosen[1] - (double)chosen[3]);
        snprintf(second, sizeof second,
                 merging ? "%u may go, the longest: %.1f cells" : "%u potential, the shortest: %.1f cells",
                 entry->candidates, length);
    }
    caption(cairo, first, second);
    if (merging) {
        draw_merge(cairo, sheet, step);
    } else {
        draw_cut(cairo, sheet, step);
    }
}

static void draw_first_panel(cairo_t *cairo, const steps_sheet *sheet)
{
    char words[64];
    if (sheet->options->kind == TL_POLYGON_STEP_MERGE) {
        snprintf(words, sizeof words, "%llu", (unsigned long long)sheet->record->kinds[TL_POLYGON_STEP_CUT].count);
        caption(cairo, "the triangles", words);
        draw_triangles(cairo, sheet);
    } else {
        snprintf(words, sizeof words, "%u vertices", sheet->set->contours[sheet->options->contour].vertex_count);
        caption(cairo, "the contour", words);
        draw_contour(cairo, sheet);
    }
}

static void draw_last_panel(cairo_t *cairo, const steps_sheet *sheet)
{
    char words[64];
    if (sheet->options->kind == TL_POLYGON_STEP_MERGE) {
        snprintf(words, sizeof words, "%u, all convex", sheet->record->mesh.polygon_count);
        caption(cairo, "the polygons", words);
        draw_polygons(cairo, sheet);
    } else {
        snprintf(words, sizeof words, "%llu", (unsigned long long)sheet->record->kinds[TL_POLYGON_STEP_CUT].count);
        caption(cairo, "the triangles", words);
        draw_triangles(cairo, sheet);
    }
}

static void draw_legend_entry(cairo_t *cairo, double *x, double y, draw_colour colour, const char *words)
{
    draw_set_colour(cairo, colour, 1.0);
    cairo_rectangle(cairo, *x, y - 11, 14, 14);
    cairo_fill(cairo);
    draw_set_colour(cairo, DRAW_INK, 1.0);
    draw_text(cairo, *x + 20, y, 13, false, words);
    *x += 44 + draw_text_width(cairo, words);
}

static void paint_steps(cairo_t *cairo, const void *user)
{
    const steps_sheet *sheet = user;
    const draw_steps_options *options = sheet->options;
    const steps_of_kind *kind = &sheet->record->kinds[options->kind];
    bool merging = options->kind == TL_POLYGON_STEP_MERGE;
    draw_set_colour(cairo, 0xffffff, 1.0);
    cairo_paint(cairo);
    char title[256];
    snprintf(title, sizeof title, "%s: %s of contour %u", options->name, merging ? "merging" : "triangulation",
             options->contour);
    draw_set_colour(cairo, DRAW_INK, 1.0);
    draw_text(cairo, 20, 30, 20, true, title);
    draw_set_colour(cairo, 0x6a6a72, 1.0);
    draw_text(cairo, 20, 52, 13, false, sheet->summary);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (uint32_t i = 0; i < kind->shown_count + 2; i++) {
        cairo_save(cairo);
        cairo_translate(cairo, (double)GAP + (double)(i % sheet->columns) * (sheet->panel_width + GAP),
                        HEAD + CAPTION + (double)(i / sheet->columns) * (sheet->panel_height + CAPTION + GAP));
        add_step_contour(cairo, sheet);
        draw_set_colour(cairo, FLOOR, 1.0);
        cairo_fill(cairo);
        if (i == 0) {
            draw_first_panel(cairo, sheet);
        } else if (i <= kind->shown_count) {
            draw_step_panel(cairo, sheet, kind->shown[i - 1]);
        } else {
            draw_last_panel(cairo, sheet);
        }
        cairo_restore(cairo);
    }
    double x = 20, y = sheet->height - 16.0;
    draw_legend_entry(cairo, &x, y, CANDIDATE, merging ? "shared edge that may go" : "potential partition");
    draw_legend_entry(cairo, &x, y, CHOSEN, merging ? "the longest: goes" : "the shortest: chosen");
    draw_legend_entry(cairo, &x, y, FRESH, merging ? "merged polygon" : "triangle that it cuts off");
    if (!merging) {
        draw_legend_entry(cairo, &x, y, DONE, "cut before");
    }
}

static void lay_out_steps(steps_sheet *sheet)
{
    const tl_contour *contour = &sheet->set->contours[sheet->options->contour];
    const tl_contour_vertex *vertices = sheet->set->vertices + contour->first_vertex;
    int64_t max_x = vertices[0].x, max_z = vertices[0].z;
    sheet->min_x = max_x;
    sheet->min_z = max_z;
    for (uint32_t i = 1; i < contour->vertex_count; i++) {
        sheet->min_x = vertices[i].x < sheet->min_x ? vertices[i].x : sheet->min_x;
        sheet->min_z = vertices[i].z < sheet->min_z ? vertices[i].z : sheet->min_z;
        max_x = vertices[i].x > max_x ? vertices[i].x : max_x;
        max_z = vertices[i].z > max_z ? vertices[i].z : max_z;
    }
    double size_x = (double)(max_x - sheet->min_x) + 1.0, size_z = (double)(max_z - sheet->min_z) + 1.0;
    uint32_t panels = sheet->record->kinds[sheet->options->kind].shown_count + 2;
    sheet->scale = sheet->options->panel_size / fmax(size_x, size_z);
    double caption_width = 215.0; // what the longest caption takes
    sheet->panel_width = (uint32_t)ceil(fmax(size_x * sheet->scale, caption_width));
    sheet->panel_height = (uint32_t)ceil(size_z * sheet->scale);
    sheet->columns = panels < COLUMNS ? panels : COLUMNS;
    sheet->rows = (panels + sheet->columns - 1) / sheet->columns;
    sheet->width = GAP + sheet->columns * (sheet->panel_width + GAP);
    sheet->height = HEAD + sheet->rows * (sheet->panel_height + CAPTION + GAP) + FOOT;
}

tl_result draw_steps_write(const tl_contour_set *set, const draw_steps_options *options, const char *path,
                           const tl_host *host, char summary_out[DRAW_STEPS_SUMMARY], tl_io_error *error_out)
{
    steps_record record;
    tl_result result = steps_record_make(set, options->contour, options->max_verts_per_poly, options->kind,
                                         MAX_STEP_PANELS - 2, host, &record);
    if (result == TL_OK && record.kinds[TL_POLYGON_STEP_CUT].count == 0) {
        result = TL_ERR_EMPTY;
    }
    if (result != TL_OK) {
        tl_io_fail(error_out, result, path, 0, result == TL_ERR_EMPTY ? "try another --contour" : NULL,
                   "contour %u: %s", options->contour, tl_result_text(result));
    } else {
        unsigned long long cuts = record.kinds[TL_POLYGON_STEP_CUT].count;
        unsigned long long merges = record.kinds[TL_POLYGON_STEP_MERGE].count;
        snprintf(summary_out, DRAW_STEPS_SUMMARY, "%u vertices: %llu cuts, then %llu merges to %u convex polygons",
                 set->contours[options->contour].vertex_count, cuts, merges, record.mesh.polygon_count);
        steps_sheet sheet;
        memset(&sheet, 0, sizeof sheet);
        sheet.set = set;
        sheet.options = options;
        sheet.record = &record;
        sheet.summary = summary_out;
        lay_out_steps(&sheet);
        result = draw_paper_write(path, sheet.width, sheet.height, paint_steps, &sheet, error_out);
    }
    steps_record_free(&record);
    return result;
}
