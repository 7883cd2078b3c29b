// SPDX-License-Identifier: MIT
//
// Contour sets and polygon meshes as text, writing. Numbers are spelled by hand: printf would follow the locale, and
// floats have to read back as they were.

#include "io/text/contour_text.h"
#include "io/text/format_float.h"

#include <string.h>

enum { BUFFER_BYTES = 8192, LARGEST_NUMBER_BYTES = 24 };

// Collects small pieces; the first failure of the sink sticks.
typedef struct writer {
    tl_text_sink_fn *sink;
    void *user;
    tl_result result;
    size_t used;
    char buffer[BUFFER_BYTES];
} writer;

static void flush(writer *w)
{
    if (w->result == TL_OK && w->used > 0) {
        w->result = w->sink(w->buffer, w->used, w->user);
    }
    w->used = 0;
}

static void put_bytes(writer *w, const char *bytes, size_t size)
{
    while (size > 0) {
        if (w->used == BUFFER_BYTES) {
            flush(w);
        }
        size_t part = BUFFER_BYTES - w->used < size ? BUFFER_BYTES - w->used : size;
        memcpy(w->buffer + w->used, bytes, part);
        w->used += part;
        bytes += part;
        size -= part;
    }
}

static void put(writer *w, const char *text)
{
    put_bytes(w, text, strlen(text));
}

// A name on a line of its own: line ends in it would begin another one.
static void put_name(writer *w, const char *word, const char *name)
{
    put(w, word);
    put(w, " ");
    for (; *name != '\0'; name++) {
        put_bytes(w, *name == '\n' || *name == '\r' ? " " : name, 1);
    }
    put(w, "\n");
}

static void put_integer(writer *w, int64_t value)
{
    char digits[LARGEST_NUMBER_BYTES];
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

static void put_float(writer *w, float value)
{
    char text[TL_FLOAT_TEXT_BYTES];
    put_bytes(w, text, tl_format_float(value, text));
}

static void put_integer_line(writer *w, const char *word, int64_t value)
{
    put(w, word);
    put(w, " ");
    put_integer(w, value);
    put(w, "\n");
}

static void put_float_line(writer *w, const char *word, float value)
{
    put(w, word);
    put(w, " ");
    put_float(w, value);
    put(w, "\n");
}

static void put_point_line(writer *w, const char *word, tl_vec3 point)
{
    put(w, word);
    put(w, " ");
    put_float(w, point.x);
    put(w, " ");
    put_float(w, point.y);
    put(w, " ");
    put_float(w, point.z);
    put(w, "\n");
}

static void put_integers(writer *w, const int64_t *values, int count)
{
    for (int i = 0; i < count; i++) {
        put(w, i > 0 ? " " : "");
        put_integer(w, values[i]);
    }
    put(w, "\n");
}

static void begin(writer *w, tl_text_sink_fn *sink, void *user)
{
    w->sink = sink;
    w->user = user;
    w->result = TL_OK;
    w->used = 0;
}

tl_result tl_contour_text_write(const tl_contour_set *set, const char *name, uint32_t max_verts_per_poly,
                                tl_text_sink_fn *sink, void *user)
{
    writer w;
    begin(&w, sink, user);
    put(&w, "navcontours 1\n");
    put_name(&w, "name", name);
    put_float_line(&w, "cs", set->cell_size);
    put_float_line(&w, "ch", set->cell_height);
    put_point_line(&w, "bmin", set->bounds.min);
    put_point_line(&w, "bmax", set->bounds.max);
    put_integer_line(&w, "width", set->width);
    put_integer_line(&w, "height", set->height);
    put_integer_line(&w, "border", set->border_size);
    put_float_line(&w, "maxerror", set->max_error);
    put_integer_line(&w, "nvp", max_verts_per_poly);
    put_integer_line(&w, "contours", set->contour_count);
    for (uint32_t i = 0; i < set->contour_count; i++) {
        const tl_contour *contour = &set->contours[i];
        int64_t head[4] = { i, contour->region, contour->area, contour->vertex_count };
        put(&w, "c ");
        put_integers(&w, head, 4);
        for (uint32_t k = 0; k < contour->vertex_count; k++) {
            const tl_contour_vertex *v = &set->vertices[contour->first_vertex + k];
            int64_t numbers[4] = { v->x, v->y, v->z, v->flags };
            put_integers(&w, numbers, 4);
        }
    }
    put(&w, "end\n");
    flush(&w);
    return w.result;
}

static void put_neighbour(writer *w, uint32_t neighbour)
{
    if (neighbour == TL_NO_POLYGON) {
        put(w, " -1");
    } else if (neighbour >= TL_PORTAL) {
        put(w, " x");
        put_integer(w, neighbour & 15u);
    } else {
        put(w, " ");
        put_integer(w, neighbour);
    }
}

static void put_polygon(writer *w, const tl_polygon_mesh *mesh, uint32_t p)
{
    uint32_t first = mesh->first[p];
    uint32_t end = mesh->first[p + 1];
    put(w, "p ");
    put_integer(w, mesh->regions[p]);
    put(w, " ");
    put_integer(w, mesh->areas[p]);
    put(w, " ");
    put_integer(w, end - first);
    for (uint32_t k = first; k < end; k++) {
        put(w, " ");
        put_integer(w, mesh->indices[k]);
    }
    put(w, " |");
    for (uint32_t k = first; k < end; k++) {
        put_neighbour(w, mesh->neighbours[k]);
    }
    put(w, "\n");
}

tl_result tl_polygon_text_write(const tl_polygon_mesh *mesh, const char *name, const char *producer,
                                uint32_t bad_triangulations, double cpu_us, tl_text_sink_fn *sink, void *user)
{
    writer w;
    begin(&w, sink, user);
    put(&w, "navpolys 1\n");
    put_name(&w, "name", name);
    put_name(&w, "producer", producer);
    put(&w, "ok 1\n");
    put_integer_line(&w, "badtriangulations", bad_triangulations);
    put_float_line(&w, "cpu_us", (float)cpu_us);
    put_integer_line(&w, "nvp", mesh->max_verts_per_poly);
    put_integer_line(&w, "verts", mesh->vertex_count);
    put_integer_line(&w, "polys", mesh->polygon_count);
    for (uint32_t v = 0; v < mesh->vertex_count; v++) {
        int64_t place[3] = { mesh->vertices[3 * (size_t)v], mesh->vertices[3 * (size_t)v + 1],
                             mesh->vertices[3 * (size_t)v + 2] };
        put(&w, "v ");
        put_integers(&w, place, 3);
    }
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        put_polygon(&w, mesh, p);
    }
    put(&w, "end\n");
    flush(&w);
    return w.result;
}
