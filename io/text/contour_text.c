// SPDX-License-Identifier: MIT
//
// Contour sets as text. Counts in the text are checked but not trusted: arrays grow with the lines that are really
// there, so a file cannot ask for more memory than a few times its own size.

#include "io/text/contour_text.h"

#include "io/files/growable.h"

#include <string.h>

#define CONTOUR_TRY(expression)                                                                                        \
    do {                                                                                                               \
        tl_result try_result_ = (expression);                                                                          \
        if (try_result_ != TL_OK) {                                                                                    \
            return try_result_;                                                                                        \
        }                                                                                                              \
    } while (0)

enum { LARGEST_LATTICE_SIDE = TL_MAX_CONTOUR_COORDINATE };

void tl_contour_text_free(tl_contour_text *text)
{
    if (text->vertex_capacity > 0) {
        tl_io_release(&text->allocator, (void *)(uintptr_t)text->set.vertices,
                      (size_t)text->vertex_capacity * sizeof(tl_contour_vertex));
    }
    if (text->contour_capacity > 0) {
        tl_io_release(&text->allocator, (void *)(uintptr_t)text->set.contours,
                      (size_t)text->contour_capacity * sizeof(tl_contour));
    }
    memset(text, 0, sizeof *text);
}

// One header line after the first. *count_out is set by the last one, "contours COUNT".
static tl_result read_contour_header_line(const tl_text_reader *reader, tl_line line, tl_contour_text *text,
                                          int64_t *count_out, tl_io_error *error)
{
    tl_contour_set *set = &text->set;
    int64_t value = 0;
    if (tl_take_word(&line, "name")) {
        tl_take_rest(&line, text->name, sizeof text->name);
        return TL_OK;
    }
    bool good;
    if (tl_take_word(&line, "cs")) {
        good = tl_take_float(&line, &set->cell_size) && set->cell_size > 0.0f;
    } else if (tl_take_word(&line, "ch")) {
        good = tl_take_float(&line, &set->cell_height) && set->cell_height > 0.0f;
    } else if (tl_take_word(&line, "bmin")) {
        good = tl_take_float(&line, &set->bounds.min.x) && tl_take_float(&line, &set->bounds.min.y) &&
               tl_take_float(&line, &set->bounds.min.z);
    } else if (tl_take_word(&line, "bmax")) {
        good = tl_take_float(&line, &set->bounds.max.x) && tl_take_float(&line, &set->bounds.max.y) &&
               tl_take_float(&line, &set->bounds.max.z);
    } else if (tl_take_word(&line, "width")) {
        good = tl_take_integer(&line, 0, LARGEST_LATTICE_SIDE, &value);
        set->width = (int32_t)value;
    } else if (tl_take_word(&line, "height")) {
        good = tl_take_integer(&line, 0, LARGEST_LATTICE_SIDE, &value);
        set->height = (int32_t)value;
    } else if (tl_take_word(&line, "border")) {
        good = tl_take_integer(&line, 0, LARGEST_LATTICE_SIDE, &value);
        set->border_size = (int32_t)value;
    } else if (tl_take_word(&line, "maxerror")) {
        good = tl_take_float(&line, &set->max_error);
    } else if (tl_take_word(&line, "nvp")) {
        good = tl_take_integer(&line, 0, UINT32_MAX, &value);
        text->max_verts_per_poly = (uint32_t)value;
    } else if (tl_take_word(&line, "contours")) {
        good = tl_take_integer(&line, 0, UINT32_MAX - 1, count_out);
    } else {
        return tl_line_fail(reader, error,
                            "name, cs, ch, bmin, bmax, width, height, border, maxerror, nvp or contours");
    }
    return good && tl_line_is_done(&line) ? TL_OK : tl_line_fail(reader, error, "a number in the word's range");
}

static tl_result read_contour_header(tl_text_reader *reader, tl_contour_text *text, int64_t *count_out,
                                     tl_io_error *error)
{
    tl_line line;
    if (!tl_next_line(reader, &line)) {
        return tl_line_missing(reader, error, "'navcontours 1'");
    }
    if (!tl_take_word(&line, "navcontours")) {
        tl_line_fail(reader, error, "'navcontours 1'");
        if (error != NULL) {
            error->result = TL_ERR_MAGIC;
        }
        return TL_ERR_MAGIC;
    }
    if (!tl_take_word(&line, "1") || !tl_line_is_done(&line)) {
        tl_line_fail(reader, error, "version 1");
        if (error != NULL) {
            error->result = TL_ERR_VERSION;
        }
        return TL_ERR_VERSION;
    }
    *count_out = -1;
    while (*count_out < 0) {
        if (!tl_next_line(reader, &line)) {
            return tl_line_missing(reader, error, "'contours COUNT'");
        }
        CONTOUR_TRY(read_contour_header_line(reader, line, text, count_out, error));
    }
    if (!(text->set.cell_size > 0.0f) || !(text->set.cell_height > 0.0f)) {
        return tl_line_fail(reader, error, "cs and ch before the contours");
    }
    return TL_OK;
}

static tl_result read_contour_vertex(tl_text_reader *reader, tl_contour_text *text, tl_io_error *error)
{
    void *vertices = (void *)(uintptr_t)text->set.vertices;
    if (!tl_io_grow(&text->allocator, &vertices, &text->vertex_capacity, text->set.vertex_count,
                    (uint64_t)text->set.vertex_count + 1, sizeof(tl_contour_vertex)) ||
        text->set.vertex_count == UINT32_MAX) {
        return tl_io_fail(error, TL_ERR_MEMORY, reader->path, reader->line, NULL, "out of memory");
    }
    text->set.vertices = vertices;
    tl_line line;
    if (!tl_next_line(reader, &line)) {
        return tl_line_missing(reader, error, "a vertex 'X Y Z FLAGS'");
    }
    const int64_t limit = TL_MAX_CONTOUR_COORDINATE;
    int64_t x, y, z, flags;
    if (!tl_take_integer(&line, -limit, limit, &x) || !tl_take_integer(&line, -limit, limit, &y) ||
        !tl_take_integer(&line, -limit, limit, &z) || !tl_take_integer(&line, 0, UINT32_MAX, &flags) ||
        !tl_line_is_done(&line)) {
        return tl_line_fail(reader, error, "a vertex 'X Y Z FLAGS' of whole numbers, coordinates within +-2^29");
    }
    tl_contour_vertex vertex = { (int32_t)x, (int32_t)y, (int32_t)z, (uint32_t)flags };
    ((tl_contour_vertex *)vertices)[text->set.vertex_count++] = vertex;
    return TL_OK;
}

static tl_result read_contour(tl_text_reader *reader, tl_contour_text *text, tl_io_error *error)
{
    void *contours = (void *)(uintptr_t)text->set.contours;
    if (!tl_io_grow(&text->allocator, &contours, &text->contour_capacity, text->set.contour_count,
                    (uint64_t)text->set.contour_count + 1, sizeof(tl_contour))) {
        return tl_io_fail(error, TL_ERR_MEMORY, reader->path, reader->line, NULL, "out of memory");
    }
    text->set.contours = contours;
    tl_line line;
    if (!tl_next_line(reader, &line)) {
        return tl_line_missing(reader, error, "a contour 'c INDEX REGION AREA VERTS'");
    }
    int64_t index, region, area, count;
    if (!tl_take_word(&line, "c") || !tl_take_integer(&line, 0, UINT32_MAX, &index) ||
        !tl_take_integer(&line, 0, UINT32_MAX, &region) || !tl_take_integer(&line, 0, UINT32_MAX, &area) ||
        !tl_take_integer(&line, 0, UINT32_MAX, &count) || !tl_line_is_done(&line)) {
        return tl_line_fail(reader, error, "a contour 'c INDEX REGION AREA VERTS'");
    }
    tl_contour contour = { text->set.vertex_count, (uint32_t)count, (uint32_t)region, (uint32_t)area };
    for (int64_t i = 0; i < count; i++) {
        CONTOUR_TRY(read_contour_vertex(reader, text, error));
    }
    ((tl_contour *)contours)[text->set.contour_count++] = contour;
    return TL_OK;
}

static tl_result read_contour_set(tl_text_reader *reader, tl_contour_text *text, tl_io_error *error)
{
    int64_t count;
    CONTOUR_TRY(read_contour_header(reader, text, &count, error));
    for (int64_t i = 0; i < count; i++) {
        CONTOUR_TRY(read_contour(reader, text, error));
    }
    tl_line line;
    if (!tl_next_line(reader, &line)) {
        return tl_line_missing(reader, error, "'end'");
    }
    return tl_take_word(&line, "end") && tl_line_is_done(&line) ? TL_OK : tl_line_fail(reader, error, "'end'");
}

tl_result tl_contour_text_read(tl_text_reader *reader, tl_contour_text *text_out, tl_io_error *error_out)
{
    memset(text_out, 0, sizeof *text_out);
    text_out->allocator = tl_io_allocator_or_default(reader->allocator);
    tl_result result = read_contour_set(reader, text_out, error_out);
    if (result != TL_OK) {
        tl_contour_text_free(text_out);
    }
    return result;
}
