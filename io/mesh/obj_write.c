// SPDX-License-Identifier: MIT
//
// OBJ out, a line at a time into an atomic file.

#include "io/mesh/obj_write.h"

#include "io/files/atomic_write.h"
#include "io/text/format_float.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct tl_obj_writer {
    tl_atomic_file *file;
    char *path;
    uint32_t vertex_count;
    uint32_t face_count;
    tl_io_error failure; // the first one; result TL_OK while there is none
};

tl_result tl_obj_writer_open(const char *path, tl_obj_writer **writer_out, tl_io_error *error_out)
{
    *writer_out = NULL;
    tl_obj_writer *writer = calloc(1, sizeof *writer);
    char *copy = malloc(strlen(path) + 1);
    if (writer == NULL || copy == NULL) {
        free(writer);
        free(copy);
        return tl_io_fail(error_out, TL_ERR_MEMORY, path, 0, NULL, "out of memory");
    }
    strcpy(copy, path);
    writer->path = copy;
    tl_result result = tl_atomic_file_open(path, &writer->file, error_out);
    if (result != TL_OK) {
        tl_obj_writer_abort(writer);
        return result;
    }
    *writer_out = writer;
    return TL_OK;
}

static void put_obj_text(tl_obj_writer *writer, const char *text, size_t size)
{
    if (writer->failure.result == TL_OK) {
        tl_atomic_file_write(writer->file, text, size, &writer->failure);
    }
}

// `keyword`, the text with each of its line ends (and its leading blanks, if `name`) replaced, and a line end.
static void put_line(tl_obj_writer *writer, const char *keyword, const char *text, bool name)
{
    put_obj_text(writer, keyword, strlen(keyword));
    bool leading = name;
    for (const char *at = text; *at != '\0'; at++) {
        leading = leading && (*at == ' ' || *at == '\t');
        bool line_end = *at == '\n' || *at == '\r';
        char c = leading || (line_end && name) ? '_' : line_end ? ' ' : *at;
        put_obj_text(writer, &c, 1);
    }
    put_obj_text(writer, "\n", 1);
}

void tl_obj_writer_comment(tl_obj_writer *writer, const char *text)
{
    put_line(writer, "# ", text, false);
}

void tl_obj_writer_object(tl_obj_writer *writer, const char *name)
{
    put_line(writer, "o ", name, true);
}

void tl_obj_writer_material(tl_obj_writer *writer, const char *name)
{
    put_line(writer, "usemtl ", name, true);
}

static void fail_element(tl_obj_writer *writer, tl_result result, const char *element, uint32_t index,
                         const char *message)
{
    tl_io_fail(&writer->failure, result, writer->path, 0, NULL, "%s %u %s", element, (unsigned)index, message);
    tl_io_blame(&writer->failure, result, element, index);
}

uint32_t tl_obj_writer_vertices(tl_obj_writer *writer, const tl_vec3 *vertices, uint32_t count)
{
    uint32_t first = writer->vertex_count;
    if (count > TL_MAX_MESH_VERTICES - first && writer->failure.result == TL_OK) {
        fail_element(writer, TL_ERR_LIMIT, "vertex", TL_MAX_MESH_VERTICES, "is one more than a mesh may have");
    }
    for (uint32_t i = 0; i < count && writer->failure.result == TL_OK; i++) {
        if (!tl_is_finite(vertices[i])) {
            fail_element(writer, TL_ERR_NOT_FINITE, "vertex", first + i, "is not finite");
            break;
        }
        char line[3 * TL_FLOAT_TEXT_BYTES + 8] = "v ";
        size_t size = 2;
        size += tl_format_float(vertices[i].x, line + size);
        line[size++] = ' ';
        size += tl_format_float(vertices[i].y, line + size);
        line[size++] = ' ';
        size += tl_format_float(vertices[i].z, line + size);
        line[size++] = '\n';
        put_obj_text(writer, line, size);
        writer->vertex_count++;
    }
    return first;
}

static size_t format_index(uint32_t index, char *text)
{
    char reversed[10];
    size_t count = 0;
    uint32_t value = index + 1; // OBJ counts from 1
    do {
        reversed[count++] = (char)('0' + value % 10);
        value /= 10;
    } while (value > 0);
    for (size_t i = 0; i < count; i++) {
        text[i] = reversed[count - 1 - i];
    }
    return count;
}

static void put_face_corner(tl_obj_writer *writer, uint32_t index)
{
    if (writer->failure.result != TL_OK) {
        return;
    }
    if (index >= writer->vertex_count) {
        fail_element(writer, TL_ERR_INDEX, "face", writer->face_count, "names a vertex that is not written");
        return;
    }
    char text[12] = " ";
    put_obj_text(writer, text, 1 + format_index(index, text + 1));
}

void tl_obj_writer_face(tl_obj_writer *writer, const uint32_t *corners, uint32_t count)
{
    if (count < 3 && writer->failure.result == TL_OK) {
        fail_element(writer, TL_ERR_ARGUMENT, "face", writer->face_count, "has fewer than 3 corners");
    }
    put_obj_text(writer, "f", 1);
    for (uint32_t i = 0; i < count; i++) {
        put_face_corner(writer, corners[i]);
    }
    put_obj_text(writer, "\n", 1);
    writer->face_count++;
}

void tl_obj_writer_triangles(tl_obj_writer *writer, const uint32_t *indices, uint32_t count, uint32_t first_vertex)
{
    for (uint32_t i = 0; i < count && writer->failure.result == TL_OK; i++) {
        put_obj_text(writer, "f", 1);
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t index = indices[(size_t)i * 3 + k];
            // A sum that wraps around would name a vertex that is there.
            put_face_corner(writer, index <= UINT32_MAX - first_vertex ? first_vertex + index : UINT32_MAX);
        }
        put_obj_text(writer, "\n", 1);
        writer->face_count++;
    }
}

tl_result tl_obj_writer_commit(tl_obj_writer *writer, tl_io_error *error_out)
{
    tl_result result = writer->failure.result;
    if (result != TL_OK) {
        if (error_out != NULL) {
            *error_out = writer->failure;
        }
    } else {
        result = tl_atomic_file_commit(writer->file, error_out);
        writer->file = NULL;
    }
    tl_obj_writer_abort(writer);
    return result;
}

void tl_obj_writer_abort(tl_obj_writer *writer)
{
    if (writer != NULL) {
        tl_atomic_file_abort(writer->file);
        free(writer->path);
        free(writer);
    }
}

tl_result tl_obj_write_mesh(const char *path, const tl_mesh_view *mesh, const char *const *material_names,
                            uint32_t material_name_count, tl_io_error *error_out)
{
    tl_obj_writer *writer;
    tl_result result = tl_obj_writer_open(path, &writer, error_out);
    if (result != TL_OK) {
        return result;
    }
    tl_obj_writer_vertices(writer, mesh->vertices, mesh->vertex_count);
    uint32_t run = 0; // first triangle of the present material
    for (uint32_t i = 0; i <= mesh->triangle_count; i++) {
        bool same = i < mesh->triangle_count && (mesh->materials == NULL || mesh->materials[i] == mesh->materials[run]);
        if (same && i > 0) {
            continue;
        }
        if (i > run) {
            tl_obj_writer_triangles(writer, mesh->indices + (size_t)run * 3, i - run, 0);
            run = i;
        }
        if (i < mesh->triangle_count && mesh->materials != NULL) {
            char number[32];
            uint16_t id = mesh->materials[i];
            snprintf(number, sizeof number, "material_%u", (unsigned)id);
            bool named = material_names != NULL && id < material_name_count;
            tl_obj_writer_material(writer, named ? material_names[id] : number);
        }
    }
    return tl_obj_writer_commit(writer, error_out);
}
