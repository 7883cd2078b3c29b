// SPDX-License-Identifier: MIT
//
// Wavefront OBJ in one pass over the text (obj_statements.h), then its polygons are split, when all vertices are known.
// Two passes that count first, or a line table, were rejected: the text is what is large here, so it is read once.

#include "io/mesh/obj_reader.h"

#include "io/files/growable.h"
#include "io/mesh/obj_statements.h"
#include "io/mesh/split_polygon.h"
#include "io/text/text_scan.h"

#include <string.h>

static tl_result read_sections(tl_obj_state *reader, const char *text, size_t size)
{
    size_t in_place = tl_text_first_section(text, size);
    tl_result result = tl_obj_read_section(reader, text, text + in_place);
    if (result != TL_OK) {
        return result;
    }
    size_t block = tl_text_last_section_block(size - in_place);
    char *copy = tl_io_allocate(&reader->mesh->allocator, block);
    if (copy == NULL) {
        return tl_io_fail(reader->error, TL_ERR_MEMORY, reader->path, reader->line, NULL, "out of memory");
    }
    size_t last = tl_text_copy_last_section(text + in_place, size - in_place, copy);
    reader->section_offset = in_place;
    result = tl_obj_read_section(reader, copy, copy + last);
    tl_io_release(&reader->mesh->allocator, copy, block);
    return result;
}

// --- the whole ------------------------------------------------------------------------------------------------------

// Splits what is no good as a fan. A polygon's corners are read back from its fan.
static tl_result split_polygons(tl_obj_state *reader)
{
    tl_imported_mesh *mesh = reader->mesh;
    const tl_allocator *allocator = &mesh->allocator;
    uint32_t most = TL_MAX_SPLIT_CORNERS;
    tl_split_corner *scratch = tl_io_allocate(allocator, most * sizeof *scratch);
    uint32_t *corners = tl_io_allocate(allocator, most * sizeof *corners);
    tl_result result = scratch != NULL && corners != NULL ? TL_OK : TL_ERR_MEMORY;
    if (result != TL_OK) {
        tl_io_fail(reader->error, result, reader->path, 0, NULL, "out of memory");
    }
    for (uint64_t i = 0; result == TL_OK && i < reader->polygon_count; i++) {
        tl_obj_polygon polygon = reader->polygons[i];
        uint32_t *triangles = mesh->indices + (size_t)polygon.first_triangle * 3;
        if (polygon.corner_count > most) {
            mesh->crooked_count++;
            continue;
        }
        corners[0] = triangles[0];
        corners[1] = triangles[1];
        for (uint32_t k = 2; k < polygon.corner_count; k++) {
            corners[k] = triangles[(size_t)(k - 2) * 3 + 2];
        }
        tl_split split = tl_split_polygon(mesh->vertices, corners, polygon.corner_count, scratch, triangles);
        mesh->clipped_count += split == TL_SPLIT_EARS;
        mesh->crooked_count += split == TL_SPLIT_GAVE_UP;
        if (i % 65536 == 65535 && tl_io_progress(reader->host, TL_OBJ_STAGE, reader->size, reader->size) != TL_OK) {
            result = tl_io_fail(reader->error, TL_ERR_CANCELLED, reader->path, 0, NULL, "cancelled");
        }
    }
    tl_io_release(allocator, scratch, most * sizeof *scratch);
    tl_io_release(allocator, corners, most * sizeof *corners);
    return result;
}

static tl_result check_whole(tl_obj_state *reader, bool allow_no_faces)
{
    const tl_imported_mesh *mesh = reader->mesh;
    tl_io_error *error = reader->error;
    if (reader->ahead_line != 0 && reader->ahead_index >= mesh->vertex_count) {
        tl_io_fail(error, TL_ERR_INDEX, reader->path, reader->ahead_line,
                   "the file is cut short, or its indices are wrong", "a corner names vertex %u, and the file has %u",
                   (unsigned)reader->ahead_index + 1u, (unsigned)mesh->vertex_count);
        return tl_io_blame(error, TL_ERR_INDEX, "face", reader->ahead_face);
    }
    if (mesh->vertex_count == 0) {
        return tl_io_fail(error, TL_ERR_EMPTY, reader->path, 0, "is this an OBJ file?", "%s",
                          reader->size == 0 ? "the file is empty" : "no vertices");
    }
    if (mesh->triangle_count == 0 && !allow_no_faces) {
        return tl_io_fail(error, TL_ERR_EMPTY, reader->path, 0, "export the level with its faces",
                          "no faces, only %u vertices", (unsigned)mesh->vertex_count);
    }
    return TL_OK;
}

// Room for a usual file's content, so that it is copied once at most while it grows. A guess: pages that are never
// written to cost nothing.
static tl_result reserve_guess(tl_imported_mesh *mesh, size_t size)
{
    enum { TEXT_BYTES_PER_VERTEX = 72, BYTES_A_TRIANGLE = 40 };
    uint64_t vertices = size / TEXT_BYTES_PER_VERTEX, triangles = size / BYTES_A_TRIANGLE;
    vertices = vertices < TL_MAX_MESH_VERTICES ? vertices : TL_MAX_MESH_VERTICES;
    triangles = triangles < TL_MAX_MESH_TRIANGLES ? triangles : TL_MAX_MESH_TRIANGLES;
    tl_result result = tl_imported_mesh_reserve_vertices(mesh, vertices);
    return result != TL_OK ? result : tl_imported_mesh_reserve_triangles(mesh, triangles);
}

static tl_result read_obj_text(tl_obj_state *reader, const char *text, size_t size, bool allow_no_faces)
{
    uint32_t nameless;
    tl_imported_mesh *mesh = reader->mesh;
    if (size >= 2 && (memcmp(text, "\xff\xfe", 2) == 0 || memcmp(text, "\xfe\xff", 2) == 0)) {
        return tl_io_fail(reader->error, TL_ERR_FORMAT, reader->path, 1, "save it as UTF-8", "UTF-16 text");
    }
    if (tl_name_table_add(&mesh->names, &mesh->allocator, "", 0, 1, &nameless) != TL_OK ||
        reserve_guess(mesh, size) != TL_OK) {
        return tl_io_fail(reader->error, TL_ERR_MEMORY, reader->path, 0, NULL, "out of memory");
    }
    size_t mark = size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0; // UTF-8 byte order mark
    tl_result result = read_sections(reader, text + mark, size - mark);
    result = result == TL_OK ? check_whole(reader, allow_no_faces) : result;
    result = result == TL_OK && reader->polygon_count > 0 ? split_polygons(reader) : result;
    return result == TL_OK && tl_io_progress(reader->host, TL_OBJ_STAGE, size, size) != TL_OK
               ? tl_io_fail(reader->error, TL_ERR_CANCELLED, reader->path, 0, NULL, "cancelled")
               : result;
}

tl_result tl_obj_read_source(const tl_obj_source *source, const tl_host *host, tl_imported_mesh *mesh_out,
                             tl_io_error *error_out)
{
    const double *origin = source->origin;
    tl_imported_mesh_init(mesh_out, host != NULL ? host->allocator : NULL);
    mesh_out->format = "OBJ";
    mesh_out->source_bytes = source->size;
    tl_obj_state reader = { .mesh = mesh_out,
                            .path = source->path,
                            .host = host,
                            .error = error_out,
                            .line = 1,
                            .size = source->size,
                            .next_progress = 1 };
    reader.origin = origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0 ? origin : NULL;
    memcpy(mesh_out->origin, origin, sizeof mesh_out->origin);
    tl_result result = read_obj_text(&reader, source->text, source->size, source->allow_no_faces);
    mesh_out->polygon_count = (uint32_t)reader.polygon_count;
    tl_io_release(&mesh_out->allocator, reader.polygons, reader.polygon_capacity * sizeof *reader.polygons);
    if (result != TL_OK) {
        tl_imported_mesh_free(mesh_out);
    }
    return result;
}

tl_result tl_obj_read(const void *text, size_t size, const char *path, bool allow_no_faces, const tl_host *host,
                      tl_imported_mesh *mesh_out, tl_io_error *error_out)
{
    const tl_obj_source source = { text, size, path, allow_no_faces, { 0.0, 0.0, 0.0 } };
    return tl_obj_read_source(&source, host, mesh_out, error_out);
}
