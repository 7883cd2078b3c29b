// SPDX-License-Identifier: MIT
//
// Each line is read from where it lies, without finding its end first: a line end is the sentinel of every inner loop,
// so none of them compares with the end of the text (text_scan.h). Numbers are taken eight bytes at a time
// (parse_float.h). Faces become fans at once, since a face may point ahead.

#include "io/mesh/obj_statements.h"

#include "io/files/growable.h"
#include "io/text/text_scan.h"

#include <string.h>

enum {
    PROGRESS_BYTES = 4 * 1024 * 1024,
    MAX_QUOTED_BYTES = 32, // of an offending word in a message
};

// Whether a number may end before c.
static bool is_separator(char c)
{
    return tl_is_blank(c) || tl_is_line_end(c) || c == '\\';
}

// --- failures -------------------------------------------------------------------------------------------------------

// A word of the text for a message: ends with the word, the line, or "..." when it is long.
static const char *quote(const char *at, const char *end, char text[MAX_QUOTED_BYTES + 4])
{
    size_t size = 0;
    while (size < MAX_QUOTED_BYTES && at + size < end && !is_separator(at[size])) {
        text[size] = at[size] != '\0' ? at[size] : '?';
        size++;
    }
    bool cut = size == MAX_QUOTED_BYTES;
    memcpy(text + size, cut ? "..." : "", cut ? 4 : 1);
    return text;
}

// Notes a failure without words of its own.
static const char *fail_at_line(tl_obj_state *reader, tl_result result, const char *advice, const char *message)
{
    reader->result = tl_io_fail(reader->error, result, reader->path, reader->line, advice, "%s", message);
    return NULL;
}

static const char *fail_obj_memory(tl_obj_state *reader)
{
    return fail_at_line(reader, TL_ERR_MEMORY, NULL, "out of memory");
}

static const char *fail_obj_reserve(tl_obj_state *reader, tl_result result, const char *what)
{
    if (result == TL_ERR_MEMORY) {
        return fail_obj_memory(reader);
    }
    reader->result = tl_io_fail(reader->error, result, reader->path, reader->line, "cut the level into parts",
                                "more %s than one mesh may have", what);
    return NULL;
}

static bool is_word(const char *at, const char *word)
{
    size_t i = 0;
    while (word[i] != '\0' && (at[i] | 0x20) == word[i]) {
        i++;
    }
    return word[i] == '\0';
}

// What stands at `at` instead of a number.
static const char *fail_number(tl_obj_state *reader, const char *at, const char *element, uint64_t index,
                               const char *needed)
{
    char text[MAX_QUOTED_BYTES + 4];
    const char *digits = at + (*at == '-' || *at == '+');
    uint64_t line = reader->line;
    if (tl_is_line_end(*at) || *at == '#') {
        reader->result = tl_io_fail(reader->error, TL_ERR_FORMAT, reader->path, line, "the line is cut short",
                                    "the line ends where %s must be", needed);
    } else if (is_word(digits, "nan") || is_word(digits, "inf") || is_word(digits, "1.#")) {
        reader->result = tl_io_fail(reader->error, TL_ERR_NOT_FINITE, reader->path, line,
                                    "remove the broken vertex in the tool that wrote it", "'%s' is not finite",
                                    quote(at, reader->end, text));
    } else {
        reader->result = tl_io_fail(reader->error, TL_ERR_FORMAT, reader->path, line, "is this an OBJ file?",
                                    "'%s' stands where %s must be", quote(at, reader->end, text), needed);
    }
    tl_io_blame(reader->error, reader->result, element, index);
    return NULL;
}

// --- lines ----------------------------------------------------------------------------------------------------------

// Behind the line end at `at`.
static inline const char *step_line(tl_obj_state *reader, const char *at)
{
    reader->line++;
    return at + 1 + (at[0] == '\r' && at[1] == '\n');
}

// To the next thing on the line, over `\` and the line end behind it.
static inline const char *skip_text_blanks(tl_obj_state *reader, const char *at)
{
    for (;;) {
        while (tl_is_blank(*at)) {
            at++;
        }
        if (*at != '\\' || !tl_is_line_end(at[1])) {
            return at;
        }
        at = step_line(reader, at + 1);
    }
}

// The end of the statement at `at`, over continued lines. Comments and names are not continued: a path that ends with
// `\` would swallow the next line.
static const char *find_statement_end(tl_obj_state *reader, const char *at)
{
    const char *first = at;
    for (;;) {
        at = tl_find_line_end(at);
        if (at == first || at[-1] != '\\') {
            return at;
        }
        at = step_line(reader, at);
    }
}

// --- statements -----------------------------------------------------------------------------------------------------
// Each takes what stands behind its keyword, and returns where its line ends, or NULL.

static inline const char *read_number(tl_obj_state *reader, const char *at, float *value)
{
    at = skip_text_blanks(reader, at);
    const char *next = tl_parse_float_padded(at, reader->end, value);
    if (next == NULL || !is_separator(*next)) {
        return fail_number(reader, at, "vertex", reader->mesh->vertex_count, "a coordinate");
    }
    return next;
}

// What may follow x y z: w, r g b, or both.
static const char *read_vertex_rest(tl_obj_state *reader, const char *at)
{
    uint32_t count = 3;
    float value;
    while (at = skip_text_blanks(reader, at), !tl_is_line_end(*at) && *at != '#') {
        at = read_number(reader, at, &value);
        if (at == NULL) {
            return NULL;
        }
        count++;
    }
    if (count == 5 || count > 7) {
        tl_io_fail(reader->error, TL_ERR_FORMAT, reader->path, reader->line,
                   "write x y z, and w or r g b or both behind it", "a vertex of %u numbers", (unsigned)count);
        reader->result = tl_io_blame(reader->error, TL_ERR_FORMAT, "vertex", reader->mesh->vertex_count);
        return NULL;
    }
    return tl_find_line_end(at);
}

// The three numbers from `at` on again, which read_number has found sound, as doubles.
static void subtract_origin(tl_obj_state *reader, const char *at, tl_vec3 *vertex)
{
    double values[3] = { 0.0, 0.0, 0.0 };
    for (int axis = 0; axis < 3; ++axis) {
        at = skip_text_blanks(reader, at);
        at = tl_parse_double(at, reader->end, &values[axis]);
        values[axis] -= reader->origin[axis];
    }
    *vertex = tl_vec3_make((float)values[0], (float)values[1], (float)values[2]);
}

static inline const char *read_obj_vertex(tl_obj_state *reader, const char *at)
{
    tl_imported_mesh *mesh = reader->mesh;
    const char *first = at;
    tl_vec3 vertex;
    if ((at = read_number(reader, at, &vertex.x)) == NULL || (at = read_number(reader, at, &vertex.y)) == NULL ||
        (at = read_number(reader, at, &vertex.z)) == NULL) {
        return NULL;
    }
    if (reader->origin != NULL) {
        subtract_origin(reader, first, &vertex);
    }
    if (!tl_is_line_end(*at)) {
        at = read_vertex_rest(reader, at);
        if (at == NULL) {
            return NULL;
        }
    }
    if (!tl_is_finite(vertex)) {
        fail_at_line(reader, TL_ERR_RANGE, "check the file's unit", "a coordinate is beyond the largest float");
        tl_io_blame(reader->error, TL_ERR_RANGE, "vertex", mesh->vertex_count);
        return NULL;
    }
    if (mesh->vertex_count == mesh->vertex_capacity) {
        tl_result result = tl_imported_mesh_reserve_vertices(mesh, 1);
        if (result != TL_OK) {
            return fail_obj_reserve(reader, result, "vertices");
        }
    }
    mesh->vertices[mesh->vertex_count++] = vertex;
    return at;
}

static const char *fail_index(tl_obj_state *reader, const char *at)
{
    char text[MAX_QUOTED_BYTES + 4];
    tl_io_fail(reader->error, TL_ERR_INDEX, reader->path, reader->line, "indices count from 1, or backwards from -1",
               "corner '%s' names no vertex: there are %u so far", quote(at, reader->end, text),
               (unsigned)reader->mesh->vertex_count);
    reader->result = tl_io_blame(reader->error, TL_ERR_INDEX, "face", reader->mesh->face_count);
    return NULL;
}

// An index of eight digits and more, or none. Returns the digits' end; UINT32_MAX when it is too large for any mesh.
static const char *read_long_index(const char *at, uint32_t *value_out)
{
    uint64_t value = 0;
    for (; *at >= '0' && *at <= '9'; at++) {
        value = value < UINT32_MAX ? value * 10 + (unsigned)(*at - '0') : value;
    }
    *value_out = value < UINT32_MAX ? (uint32_t)value : UINT32_MAX;
    return at;
}

static inline const char *read_digits(const char *at, uint32_t *value_out)
{
    uint64_t bytes = tl_load_text8(at);
    unsigned count = tl_digit_count8(bytes);
    if (count == 8) {
        return read_long_index(at, value_out);
    }
    *value_out = tl_digits_value8(bytes, count);
    return at + count;
}

// `/vt`, `//vn` or `/vt/vn`, each of which may be missing. They must be integers and are not looked at any further.
static inline const char *skip_references(const char *at)
{
    uint32_t value;
    for (int i = 0; i < 2 && *at == '/'; i++) {
        at++;
        at = read_digits(at + (*at == '-'), &value);
    }
    return at;
}

// One corner's vertex, counted from 0.
static inline const char *read_corner(tl_obj_state *reader, const char *at, uint32_t *index_out)
{
    uint32_t vertex_count = reader->mesh->vertex_count;
    bool backwards = *at == '-';
    const char *first = at + backwards;
    uint32_t value;
    const char *next = read_digits(first, &value);
    const char *digits_end = next;
    next = skip_references(next);
    if (digits_end == first || !is_separator(*next)) {
        return fail_number(reader, at, "face", reader->mesh->face_count, "a corner");
    }
    // A 0 wraps around to the largest index either way, and is found with those that are too large.
    uint32_t index = backwards ? vertex_count - value : value - 1;
    if (index >= vertex_count) {
        if (backwards || value == 0 || value > TL_MAX_MESH_VERTICES) {
            return fail_index(reader, at);
        }
        if (reader->ahead_line == 0 || index > reader->ahead_index) {
            reader->ahead_index = index;
            reader->ahead_line = reader->line;
            reader->ahead_face = reader->mesh->face_count;
        }
    }
    *index_out = index;
    return next;
}

static bool add_obj_polygon(tl_obj_state *reader, uint32_t corner_count)
{
    if (!tl_io_grow(&reader->mesh->allocator, (void **)&reader->polygons, &reader->polygon_capacity,
                    reader->polygon_count, reader->polygon_count + 1, sizeof *reader->polygons)) {
        return false;
    }
    tl_obj_polygon polygon = { reader->mesh->triangle_count - (corner_count - 2), corner_count };
    reader->polygons[reader->polygon_count++] = polygon;
    return true;
}

static inline const char *read_face(tl_obj_state *reader, const char *at)
{
    tl_imported_mesh *mesh = reader->mesh;
    uint32_t line = (uint32_t)reader->line;
    uint32_t count = 0;
    uint32_t corners[3] = { 0, 0, 0 }; // the first one, the one before, this one
    if (reader->line > UINT32_MAX) {
        return fail_at_line(reader, TL_ERR_LIMIT, "cut the level into parts",
                            "more lines than can be counted in 32 bits");
    }
    while (at = skip_text_blanks(reader, at), !tl_is_line_end(*at) && *at != '#') {
        uint32_t *corner = &corners[count < 2 ? count : 2];
        at = read_corner(reader, at, corner);
        if (at == NULL) {
            return NULL;
        }
        count++;
        if (count < 3) {
            continue;
        }
        uint32_t triangle = mesh->triangle_count;
        if (triangle == mesh->triangle_capacity) {
            tl_result result = tl_imported_mesh_reserve_triangles(mesh, 1);
            if (result != TL_OK) {
                return fail_obj_reserve(reader, result, "triangles");
            }
        }
        uint32_t *indices = mesh->indices + (size_t)triangle * 3;
        indices[0] = corners[0];
        indices[1] = corners[1];
        indices[2] = corners[2];
        mesh->materials[triangle] = (uint16_t)reader->material;
        mesh->source_lines[triangle] = line;
        mesh->triangle_count = triangle + 1;
        corners[1] = corners[2];
    }
    if (count < 3) {
        tl_io_fail(reader->error, TL_ERR_FORMAT, reader->path, reader->line, "a face needs 3 corners",
                   "a face of %u corner%s", (unsigned)count, count == 1 ? "" : "s");
        reader->result = tl_io_blame(reader->error, TL_ERR_FORMAT, "face", mesh->face_count);
        return NULL;
    }
    if (count > 3 && !add_obj_polygon(reader, count)) {
        return fail_obj_memory(reader);
    }
    mesh->face_count++;
    return tl_find_line_end(at);
}

static const char *read_usemtl(tl_obj_state *reader, const char *at)
{
    tl_imported_mesh *mesh = reader->mesh;
    while (tl_is_blank(*at)) {
        at++;
    }
    const char *line_end = tl_find_line_end(at);
    const char *name_end = line_end;
    while (name_end > at && tl_is_blank(name_end[-1])) {
        name_end--;
    }
    tl_result result = tl_name_table_add(&mesh->names, &mesh->allocator, at, (size_t)(name_end - at),
                                         TL_MAX_IMPORTED_MATERIALS, &reader->material);
    if (result == TL_ERR_LIMIT) {
        return fail_at_line(reader, TL_ERR_LIMIT, "join materials", "more than 65535 different materials");
    }
    return result == TL_OK ? line_end : fail_obj_memory(reader);
}

// A keyword that is not `v` or `f` with a blank behind it: all that is rare.
static const char *read_other(tl_obj_state *reader, const char *at)
{
    const char *keyword_end = at;
    while (!is_separator(*keyword_end)) {
        unsigned char c = (unsigned char)*keyword_end;
        if (c < 0x20 || c == 0x7f) {
            return fail_at_line(reader, TL_ERR_FORMAT, "this is no OBJ file; name it by its kind (.glb, .fbx, .stl...)",
                                "binary content");
        }
        keyword_end++;
        if ((size_t)(keyword_end - at) > TL_MAX_OBJ_KEYWORD_BYTES) {
            return fail_at_line(reader, TL_ERR_LIMIT, "is this an OBJ file?", "a keyword of more than 32 characters");
        }
    }
    size_t size = (size_t)(keyword_end - at);
#define IS_KEYWORD(word) (size == sizeof(word) - 1 && memcmp(at, word, sizeof(word) - 1) == 0)
    if (IS_KEYWORD("vn") || IS_KEYWORD("vt")) {
        return find_statement_end(reader, keyword_end);
    }
    if (IS_KEYWORD("usemtl")) {
        return read_usemtl(reader, keyword_end);
    }
    if (IS_KEYWORD("o") || IS_KEYWORD("g") || IS_KEYWORD("mtllib")) {
        return tl_find_line_end(keyword_end);
    }
    if (IS_KEYWORD("fo")) { // an older word for f
        return read_face(reader, keyword_end);
    }
    reader->mesh->ignored_points += IS_KEYWORD("p");
    reader->mesh->ignored_lines += IS_KEYWORD("l");
    reader->mesh->skipped_lines += !(IS_KEYWORD("p") || IS_KEYWORD("l") || IS_KEYWORD("s") || IS_KEYWORD("vp"));
#undef IS_KEYWORD
    return find_statement_end(reader, keyword_end);
}

// --- lines of a section ---------------------------------------------------------------------------------------------

static inline const char *read_obj_line(tl_obj_state *reader, const char *at)
{
    const char *first = at;
    const char *line_end;
    at = skip_text_blanks(reader, at);
    if (*at == 'v' && is_separator(at[1])) {
        line_end = read_obj_vertex(reader, at + 1);
    } else if (*at == 'f' && is_separator(at[1])) {
        line_end = read_face(reader, at + 1);
    } else if (*at == '#') {
        line_end = tl_find_line_end(at);
    } else if (tl_is_line_end(*at)) {
        line_end = at;
    } else {
        line_end = read_other(reader, at);
    }
    if (line_end == NULL) {
        return NULL;
    }
    if ((size_t)(line_end - first) > TL_MAX_OBJ_LINE_BYTES) {
        return fail_at_line(reader, TL_ERR_LIMIT, "is this an OBJ file?", "a line of more than 1048576 characters");
    }
    return step_line(reader, line_end);
}

tl_result tl_obj_read_section(tl_obj_state *reader, const char *text, const char *end)
{
    reader->end = end;
    const char *at = text;
    while (at < end) {
        at = read_obj_line(reader, at);
        if (at == NULL) {
            return reader->result;
        }
        size_t done = reader->section_offset + (size_t)(at - text);
        if (done >= reader->next_progress) {
            reader->next_progress = done + PROGRESS_BYTES;
            tl_result result = tl_io_progress(reader->host, TL_OBJ_STAGE, done, reader->size);
            if (result != TL_OK) {
                return tl_io_fail(reader->error, result, reader->path, 0, NULL, "cancelled");
            }
        }
    }
    return TL_OK;
}
