// SPDX-License-Identifier: MIT
//
// Numbers are formatted without printf, which would follow the locale; floats read back as they were.

#include "io/text/polygon_text_write.h"

#include "io/text/format_float.h"

#include <string.h>

enum { TEXT_BUFFER_BYTES = 8192, MAX_NUMBER_BYTES = 24 };

// Collects small pieces; the first failure of the sink sticks.
typedef struct text_writer {
    tl_text_sink_fn *sink;
    void *user;
    tl_result result;
    size_t used;
    char buffer[TEXT_BUFFER_BYTES];
} text_writer;

static void flush_text(text_writer *w)
{
    if (w->result == TL_OK && w->used > 0) {
        w->result = w->sink(w->buffer, w->used, w->user);
    }
    w->used = 0;
}

static void put_bytes(text_writer *w, const char *bytes, size_t size)
{
    while (size > 0) {
        if (w->used == TEXT_BUFFER_BYTES) {
            flush_text(w);
        }
        size_t part = TEXT_BUFFER_BYTES - w->used < size ? TEXT_BUFFER_BYTES - w->used : size;
        memcpy(w->buffer + w->used, bytes, part);
        w->used += part;
        bytes += part;
        size -= part;
    }
}

static void put_text(text_writer *w, const char *text)
{
    put_bytes(w, text, strlen(text));
}

// A name on a line of its own: line ends in it would begin another one.
static void put_name(text_writer *w, const char *word, const char *name)
{
    put_text(w, word);
    put_text(w, " ");
    for (; *name != '\0'; name++) {
        put_bytes(w, *name == '\n' || *name == '\r' ? " " : name, 1);
    }
    put_text(w, "\n");
}

static void put_integer(text_writer *w, int64_t value)
{
    char digits[MAX_NUMBER_BYTES];
    size_t at = sizeof digits;
    uint64_t rest = value < 0 ? 0 - (uint64_t)value : (uint64_t)value;
    do {
        digits[--at] = (char)('0' + rest % 10);
        rest /= 10;
    } while (rest > 0);
    if (value < 0) {
        digits[--at] = '-';
    }
    put_bytes(w, digits + at, sizeof digits - at);
}

static void put_float(text_writer *w, float value)
{
    char text[TL_FLOAT_TEXT_BYTES];
    put_bytes(w, text, tl_format_float(value, text));
}

static void put_integer_line(text_writer *w, const char *word, int64_t value)
{
    put_text(w, word);
    put_text(w, " ");
    put_integer(w, value);
    put_text(w, "\n");
}

static void put_float_line(text_writer *w, const char *word, float value)
{
    put_text(w, word);
    put_text(w, " ");
    put_float(w, value);
    put_text(w, "\n");
}

static void put_integers(text_writer *w, const int64_t *values, int count)
{
    for (int i = 0; i < count; i++) {
        put_text(w, i > 0 ? " " : "");
        put_integer(w, values[i]);
    }
    put_text(w, "\n");
}

static void begin_text(text_writer *w, tl_text_sink_fn *sink, void *user)
{
    w->sink = sink;
    w->user = user;
    w->result = TL_OK;
    w->used = 0;
}

static void put_neighbour(text_writer *w, uint32_t neighbour)
{
    if (neighbour == TL_NO_POLYGON) {
        put_text(w, " -1");
    } else if (neighbour >= TL_PORTAL) {
        put_text(w, " x");
        put_integer(w, neighbour & 15u);
    } else {
        put_text(w, " ");
        put_integer(w, neighbour);
    }
}

static void put_polygon(text_writer *w, const tl_polygon_mesh *mesh, uint32_t p)
{
    uint32_t first = mesh->first[p];
    uint32_t end = mesh->first[p + 1];
    put_text(w, "p ");
    put_integer(w, mesh->regions[p]);
    put_text(w, " ");
    put_integer(w, mesh->areas[p]);
    put_text(w, " ");
    put_integer(w, end - first);
    for (uint32_t k = first; k < end; k++) {
        put_text(w, " ");
        put_integer(w, mesh->indices[k]);
    }
    put_text(w, " |");
    for (uint32_t k = first; k < end; k++) {
        put_neighbour(w, mesh->neighbours[k]);
    }
    put_text(w, "\n");
}

tl_result tl_polygon_text_write(const tl_polygon_mesh *mesh, const char *name, const char *producer,
                                uint32_t bad_triangulations, double cpu_us, tl_text_sink_fn *sink, void *user)
{
    text_writer w;
    begin_text(&w, sink, user);
    put_text(&w, "navpolys 1\n");
    put_name(&w, "name", name);
    put_name(&w, "producer", producer);
    put_text(&w, "ok 1\n");
    put_integer_line(&w, "badtriangulations", bad_triangulations);
    put_float_line(&w, "cpu_us", (float)cpu_us);
    put_integer_line(&w, "nvp", mesh->max_verts_per_poly);
    put_integer_line(&w, "verts", mesh->vertex_count);
    put_integer_line(&w, "polys", mesh->polygon_count);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        int64_t place[3] = { mesh->vertices[3 * (size_t)v], mesh->vertices[3 * (size_t)v + 1],
                             mesh->vertices[3 * (size_t)v + 2] };
        put_text(&w, "v ");
        put_integers(&w, place, 3);
    }
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        put_polygon(&w, mesh, p);
    }
    put_text(&w, "end\n");
    flush_text(&w);
    return w.result;
}
