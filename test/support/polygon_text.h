// SPDX-License-Identifier: MIT
//
// Reading polygon meshes as text, `navpolys 1`: of Recast's results, and of what io/text/polygon_text_write.c writes.

#ifndef TALUS_TEST_POLYGON_TEXT_H
#define TALUS_TEST_POLYGON_TEXT_H

#include "io/files/growable.h"
#include "io/text/line_words.h"

#include <talus/polygon.h>

#include <string.h>

/// A polygon mesh with the text's head.
typedef struct polygon_text {
    tl_polygon_mesh mesh; ///< bounds and cells are not in the text: 0. contours[p]: TL_SEVERAL_CONTOURS
    char name[TL_TEXT_NAME_BYTES];
    char producer[TL_TEXT_NAME_BYTES];
    bool ok;
    uint32_t bad_triangulations;
    double cpu_us;
    tl_allocator allocator;
} polygon_text;

#define POLYGON_TEXT_TRY(expression)                                                                                   \
    do {                                                                                                               \
        tl_result try_result_ = (expression);                                                                          \
        if (try_result_ != TL_OK) {                                                                                    \
            return try_result_;                                                                                        \
        }                                                                                                              \
    } while (0)

// What grows with the lines, before the mesh's block can be made.
typedef struct polygon_text_parse {
    tl_text_reader *reader;
    tl_io_error *error;
    polygon_text *text;
    tl_allocator allocator;
    int64_t vertex_count, polygon_count; // as the header says
    int32_t *vertices;
    uint64_t vertices_used, vertices_capacity;
    uint32_t *words; // per polygon: region, area, n, n corners, n neighbours
    uint64_t words_used, words_capacity;
    uint64_t index_count;
} polygon_text_parse;

static inline tl_result read_polygon_header_line(polygon_text_parse *p, tl_line line)
{
    polygon_text *text = p->text;
    int64_t value = 0;
    float number = 0.0f;
    bool good = true;
    if (tl_take_word(&line, "name")) {
        tl_take_rest(&line, text->name, sizeof text->name);
    } else if (tl_take_word(&line, "producer")) {
        tl_take_rest(&line, text->producer, sizeof text->producer);
    } else if (tl_take_word(&line, "ok")) {
        good = tl_take_integer(&line, 0, 1, &value);
        text->ok = value != 0;
    } else if (tl_take_word(&line, "badtriangulations")) {
        good = tl_take_integer(&line, 0, UINT32_MAX, &value);
        text->bad_triangulations = (uint32_t)value;
    } else if (tl_take_word(&line, "cpu_us")) {
        good = tl_take_float(&line, &number);
        text->cpu_us = (double)number;
    } else if (tl_take_word(&line, "nvp")) {
        good = tl_take_integer(&line, 0, UINT32_MAX, &value);
        text->mesh.max_verts_per_poly = (uint32_t)value;
    } else if (tl_take_word(&line, "verts")) {
        good = tl_take_integer(&line, 0, UINT32_MAX - 1, &p->vertex_count);
    } else if (tl_take_word(&line, "polys")) {
        good = tl_take_integer(&line, 0, UINT32_MAX - 16, &p->polygon_count);
    } else {
        return tl_line_fail(p->reader, p->error, "name, producer, ok, badtriangulations, cpu_us, nvp, verts or polys");
    }
    return good && tl_line_is_done(&line) ? TL_OK : tl_line_fail(p->reader, p->error, "a number in the word's range");
}

static inline tl_result read_polygon_header(polygon_text_parse *p)
{
    tl_line line;
    if (!tl_next_line(p->reader, &line)) {
        return tl_line_missing(p->reader, p->error, "'navpolys 1'");
    }
    if (!tl_take_word(&line, "navpolys") || !tl_take_word(&line, "1") || !tl_line_is_done(&line)) {
        return tl_line_fail(p->reader, p->error, "'navpolys 1'");
    }
    p->vertex_count = p->polygon_count = -1;
    while (p->vertex_count < 0 || p->polygon_count < 0) {
        if (!tl_next_line(p->reader, &line)) {
            return tl_line_missing(p->reader, p->error, "'verts COUNT' and 'polys COUNT'");
        }
        POLYGON_TEXT_TRY(read_polygon_header_line(p, line));
    }
    return TL_OK;
}

static inline tl_result fail_polygon_memory(const polygon_text_parse *p)
{
    return tl_io_fail(p->error, TL_ERR_MEMORY, p->reader->path, p->reader->line, NULL, "out of memory");
}

static inline tl_result read_polygon_vertex(polygon_text_parse *p)
{
    tl_line line;
    if (!tl_next_line(p->reader, &line)) {
        return tl_line_missing(p->reader, p->error, "a vertex 'v X Y Z'");
    }
    void *array = p->vertices;
    if (!tl_io_grow(&p->allocator, &array, &p->vertices_capacity, p->vertices_used, p->vertices_used + 3,
                    sizeof(int32_t))) {
        return fail_polygon_memory(p);
    }
    p->vertices = array;
    bool good = tl_take_word(&line, "v");
    for (int axis = 0; good && axis < 3; axis++) {
        int64_t value;
        good = tl_take_integer(&line, INT32_MIN, INT32_MAX, &value);
        if (good) {
            p->vertices[p->vertices_used++] = (int32_t)value;
        }
    }
    return good && tl_line_is_done(&line) ? TL_OK : tl_line_fail(p->reader, p->error, "a vertex 'v X Y Z'");
}

static inline bool take_neighbour(polygon_text_parse *p, tl_line *line, uint32_t *neighbour_out)
{
    for (uint32_t side = 0; side < 4; side++) {
        const char name[3] = { 'x', (char)('0' + side), '\0' };
        if (tl_take_word(line, name)) {
            *neighbour_out = TL_PORTAL | side;
            return true;
        }
    }
    int64_t value;
    if (!tl_take_integer(line, -1, p->polygon_count - 1, &value)) {
        return false;
    }
    *neighbour_out = value < 0 ? TL_NO_POLYGON : (uint32_t)value;
    return true;
}

static inline tl_result read_polygon(polygon_text_parse *p)
{
    tl_line line;
    if (!tl_next_line(p->reader, &line)) {
        return tl_line_missing(p->reader, p->error, "a polygon 'p REGION AREA N ...'");
    }
    int64_t region, area, count;
    // Each corner takes two bytes of the line at least.
    if (!tl_take_word(&line, "p") || !tl_take_integer(&line, 0, UINT32_MAX, &region) ||
        !tl_take_integer(&line, 0, UINT32_MAX, &area) || !tl_take_integer(&line, 0, line.end - line.at, &count)) {
        return tl_line_fail(p->reader, p->error, "a polygon 'p REGION AREA N I1 .. IN | M1 .. MN'");
    }
    void *array = p->words;
    uint64_t needed = p->words_used + 3 + 2 * (uint64_t)count;
    if (!tl_io_grow(&p->allocator, &array, &p->words_capacity, p->words_used, needed, sizeof(uint32_t))) {
        return fail_polygon_memory(p);
    }
    p->words = array;
    p->words[p->words_used++] = (uint32_t)region;
    p->words[p->words_used++] = (uint32_t)area;
    p->words[p->words_used++] = (uint32_t)count;
    for (int64_t k = 0; k < count; k++) {
        int64_t corner;
        if (!tl_take_integer(&line, 0, p->vertex_count - 1, &corner)) {
            return tl_line_fail(p->reader, p->error, "corners that are vertices of the mesh");
        }
        p->words[p->words_used++] = (uint32_t)corner;
    }
    bool good = tl_take_word(&line, "|");
    for (int64_t k = 0; good && k < count; k++) {
        good = take_neighbour(p, &line, &p->words[p->words_used++]);
    }
    p->index_count += (uint64_t)count;
    if (!good || !tl_line_is_done(&line) || p->index_count > UINT32_MAX) {
        return tl_line_fail(p->reader, p->error, "'|' and a neighbour for each corner: a polygon, -1 or x0 to x3");
    }
    return TL_OK;
}

// Lays the mesh out in one block.
static inline tl_result assemble_polygon_text(polygon_text_parse *p)
{
    tl_polygon_mesh *mesh = &p->text->mesh;
    size_t polygons = (size_t)p->polygon_count;
    size_t indices = (size_t)p->index_count;
    size_t words = (size_t)p->vertices_used + (polygons + 1) + 2 * indices + 3 * polygons;
    uint32_t *block = tl_io_allocate(&p->allocator, words * sizeof(uint32_t));
    if (block == NULL) {
        return fail_polygon_memory(p);
    }
    mesh->block = block;
    mesh->block_size = words * sizeof(uint32_t);
    mesh->vertex_count = (uint32_t)p->vertex_count;
    mesh->polygon_count = (uint32_t)polygons;
    mesh->index_count = (uint32_t)indices;
    mesh->vertices = (int32_t *)block;
    mesh->first = block + p->vertices_used;
    mesh->indices = mesh->first + polygons + 1;
    mesh->neighbours = mesh->indices + indices;
    mesh->regions = mesh->neighbours + indices;
    mesh->areas = mesh->regions + polygons;
    mesh->contours = mesh->areas + polygons;
    if (p->vertices_used > 0) {
        memcpy(mesh->vertices, p->vertices, (size_t)p->vertices_used * sizeof(int32_t));
    }
    const uint32_t *word = p->words;
    uint32_t filled = 0;
    for (size_t i = 0; i < polygons; i++) {
        mesh->first[i] = filled;
        mesh->regions[i] = *word++;
        mesh->areas[i] = *word++;
        mesh->contours[i] = TL_SEVERAL_CONTOURS;
        uint32_t count = *word++;
        if (count > 0) {
            memcpy(mesh->indices + filled, word, count * sizeof(uint32_t));
            memcpy(mesh->neighbours + filled, word + count, count * sizeof(uint32_t));
        }
        word += 2 * (size_t)count;
        filled += count;
    }
    mesh->first[polygons] = filled;
    return TL_OK;
}

static inline tl_result read_polygon_mesh(polygon_text_parse *p)
{
    POLYGON_TEXT_TRY(read_polygon_header(p));
    for (int64_t i = 0; i < p->vertex_count; i++) {
        POLYGON_TEXT_TRY(read_polygon_vertex(p));
    }
    for (int64_t i = 0; i < p->polygon_count; i++) {
        POLYGON_TEXT_TRY(read_polygon(p));
    }
    tl_line line;
    if (!tl_next_line(p->reader, &line)) {
        return tl_line_missing(p->reader, p->error, "'end'");
    }
    if (!tl_take_word(&line, "end") || !tl_line_is_done(&line)) {
        return tl_line_fail(p->reader, p->error, "'end'");
    }
    return assemble_polygon_text(p);
}

static inline tl_result polygon_text_read(tl_text_reader *reader, polygon_text *text_out, tl_io_error *error_out)
{
    memset(text_out, 0, sizeof *text_out);
    polygon_text_parse p;
    memset(&p, 0, sizeof p);
    p.reader = reader;
    p.error = error_out;
    p.text = text_out;
    p.allocator = tl_io_allocator_or_default(reader->allocator);
    text_out->allocator = p.allocator;
    tl_result result = read_polygon_mesh(&p);
    tl_io_release(&p.allocator, p.vertices, (size_t)p.vertices_capacity * sizeof(int32_t));
    tl_io_release(&p.allocator, p.words, (size_t)p.words_capacity * sizeof(uint32_t));
    if (result != TL_OK) {
        memset(text_out, 0, sizeof *text_out);
    }
    return result;
}

static inline void polygon_text_free(polygon_text *text)
{
    if (text->mesh.block != NULL) {
        tl_io_release(&text->allocator, text->mesh.block, text->mesh.block_size);
    }
    memset(text, 0, sizeof *text);
}

#undef POLYGON_TEXT_TRY

#endif
