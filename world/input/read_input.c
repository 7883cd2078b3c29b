// SPDX-License-Identifier: MIT

#include "world/input/read_input.h"

#include "io/files/file_map.h"
#include "io/text/format_float.h"
#include "world/bytes/little_endian.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

tl_result tl_world_place_triangle(const tl_world_input *input, const tl_vec3 corners[3], const double origin[3],
                                  uint8_t area, tl_world_builder *builder, tl_io_error *error_out)
{
    tl_world_triangle triangle;
    triangle.area = area;
    const double *m = input->matrix;
    for (int k = 0; k < 3; k++) {
        double *p = triangle.corner[k];
        const double x = (double)corners[k].x + origin[0], y = (double)corners[k].y + origin[1],
                     z = (double)corners[k].z + origin[2];
        p[0] = x;
        p[1] = y;
        p[2] = z;
        for (int i = 0; i < 3 && input->is_placed; i++) {
            p[i] = m[4 * i] * x + m[4 * i + 1] * y + m[4 * i + 2] * z + m[4 * i + 3];
        }
    }
    const double turn =
        m[0] * (m[5] * m[10] - m[6] * m[9]) + m[1] * (m[6] * m[8] - m[4] * m[10]) + m[2] * (m[4] * m[9] - m[5] * m[8]);
    if (turn < 0.0) { // it mirrors
        for (int i = 0; i < 3; i++) {
            const double second = triangle.corner[1][i];
            triangle.corner[1][i] = triangle.corner[2][i];
            triangle.corner[2][i] = second;
        }
    }
    const tl_result result = tl_world_builder_add(builder, &triangle, error_out);
    if (result != TL_OK && error_out != NULL && error_out->path[0] == '\0') {
        snprintf(error_out->path, sizeof error_out->path, "%s", input->path);
    }
    return result;
}

// The importer's origin, in the file's units and axes, in y-up metres.
static void turn_origin(const tl_world_input *input, const double file_origin[3], double origin[3])
{
    char digits[TL_FLOAT_TEXT_BYTES]; // the scale as it was given: 0.001, not the float next to it
    tl_format_float(input->scale, digits);
    const double scale = strtod(digits, NULL), x = scale * file_origin[0], y = scale * file_origin[1],
                 z = scale * file_origin[2];
    const bool z_up = input->up == TL_UP_Z || input->up == TL_UP_Z_LEFT;
    origin[0] = x;
    origin[1] = z_up ? z : y;
    origin[2] = input->up == TL_UP_Z ? -y : input->up == TL_UP_Z_LEFT ? y : input->up == TL_UP_Y_LEFT ? -z : z;
}

// The area of each material.
static uint8_t *find_areas(const tl_world_input *input, const tl_imported_mesh *mesh)
{
    const uint32_t count = mesh->names.count;
    uint8_t *areas = malloc((size_t)count + 1);
    for (uint32_t i = 0; i < count && areas != NULL; i++) {
        areas[i] = tl_world_input_area(input, tl_name_table_get(&mesh->names, i));
    }
    return areas;
}

static tl_result read_mesh(const tl_world_input *input, uint64_t first, const tl_host *host, tl_world_builder *builder,
                           uint64_t *vertices_out, tl_io_error *error_out)
{
    tl_import_options options = tl_default_import_options();
    options.up_axis = input->up;
    options.unit_scale = input->scale;
    options.auto_origin = true;
    if (host != NULL) {
        options.host = *host;
    }
    tl_imported_mesh mesh;
    tl_result result = tl_import_mesh(input->path, &options, &mesh, error_out);
    if (result != TL_OK) {
        return result;
    }
    double origin[3];
    turn_origin(input, mesh.origin, origin);
    uint8_t *areas = find_areas(input, &mesh);
    if (areas == NULL) {
        result = tl_io_fail(error_out, TL_ERR_MEMORY, input->path, 0, "", "out of memory");
    }
    for (uint64_t t = first; t < mesh.triangle_count && result == TL_OK; t++) {
        const uint32_t *index = mesh.indices + 3 * t;
        const tl_vec3 corners[3] = { mesh.vertices[index[0]], mesh.vertices[index[1]], mesh.vertices[index[2]] };
        const uint8_t area = mesh.materials != NULL ? areas[mesh.materials[t]] : input->area;
        result = tl_world_place_triangle(input, corners, origin, area, builder, error_out);
    }
    *vertices_out = mesh.vertex_count;
    free(areas);
    tl_imported_mesh_free(&mesh);
    return result;
}

// A name that changes with all that the segments depend on.
static tl_result name_input(const tl_world_input *input, double cell_size, tl_world_stored *stored,
                            tl_io_error *error_out)
{
    size_t size = strlen(stored->path) + 256;
    for (uint32_t i = 0; i < input->rule_count; i++) {
        size += strlen(input->rules[i].pattern) + 2;
    }
    unsigned char *bytes = calloc(1, size);
    if (bytes == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, input->path, 0, "", "out of memory");
    }
    tl_put_u32(bytes, TL_WORLD_STORE_VERSION);
    tl_put_u32(bytes + 4, (uint32_t)input->up);
    tl_put_u64(bytes + 8, stored->facts.size);
    tl_put_u64(bytes + 16, stored->facts.changed);
    tl_put_double(bytes + 24, cell_size);
    tl_put_float(bytes + 32, input->scale);
    tl_put_u32(bytes + 36, input->area);
    for (int i = 0; i < 12; i++) {
        tl_put_double(bytes + 40 + 8 * i, input->matrix[i]);
    }
    size_t used = 136 + strlen(stored->path) + 1;
    memcpy(bytes + 136, stored->path, strlen(stored->path));
    for (uint32_t i = 0; i < input->rule_count; i++) {
        const size_t length = strlen(input->rules[i].pattern);
        memcpy(bytes + used, input->rules[i].pattern, length);
        bytes[used + length + 1] = input->rules[i].area;
        used += length + 2;
    }
    stored->name = tl_content_hash_of(bytes, size);
    free(bytes);
    return TL_OK;
}

char *tl_world_segment_stem(const char *folder, tl_content_hash name)
{
    char text[TL_CONTENT_TEXT_BYTES];
    tl_content_hash_text(name, text);
    const size_t size = strlen(folder) + sizeof text + 1;
    char *stem = malloc(size);
    if (stem != NULL) {
        snprintf(stem, size, "%s/%s", folder, text);
    }
    return stem;
}

// The segments that are there, one after another. `*last_out`: the input's last is among them.
static tl_result look_at_segments(const char *stem, tl_world_stored *stored, bool *last_out, tl_io_error *error_out)
{
    *last_out = false;
    while (!*last_out) {
        char *path = tl_world_segment_path(stem, stored->segments);
        tl_world_segment segment;
        if (path == NULL) {
            return tl_io_fail(error_out, TL_ERR_MEMORY, stem, 0, "", "out of memory");
        }
        const bool sound = tl_file_look(path, NULL) && tl_world_segment_open(path, false, &segment, NULL) == TL_OK;
        free(path);
        if (!sound) {
            return TL_OK; // it is written again
        }
        const tl_world_segment_head head = segment.head;
        tl_world_segment_close(&segment);
        if (head.first != stored->triangles) {
            return TL_OK;
        }
        stored->segments++;
        stored->triangles += head.count;
        stored->degenerate += head.degenerate;
        stored->vertices = head.vertices;
        *last_out = head.last;
    }
    return TL_OK;
}

static tl_result read_triangles(const tl_world_input *input, const char *stem, const tl_world_storing *storing,
                                const tl_world_stored *stored, const tl_host *host, tl_io_error *error_out)
{
    tl_world_builder *builder =
        tl_world_builder_create(stem, storing->cell_size, storing->memory, stored->segments, stored->triangles);
    if (builder == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, input->path, 0, "", "out of memory");
    }
    uint64_t vertices = 0;
    tl_result result = tl_world_stl_read(input, stored->triangles, host, builder, &vertices, error_out);
    vertices *= 3;
    if (result == TL_NOT_FOUND) {
        result = read_mesh(input, stored->triangles, host, builder, &vertices, error_out);
    }
    tl_file_facts facts;
    if (result == TL_OK && (!tl_file_look(input->path, &facts) || facts.size != stored->facts.size ||
                            facts.changed != stored->facts.changed)) {
        result = tl_io_fail(error_out, TL_ERR_STALE, input->path, 0, "plan again when it is written",
                            "changed while it was read");
    }
    if (result == TL_OK) {
        result = tl_world_builder_finish(builder, vertices, error_out);
    }
    tl_world_builder_free(builder);
    return result;
}

tl_result tl_world_store_input(const tl_world_input *input, const tl_world_storing *storing, const tl_host *host,
                               tl_world_stored *stored_out, tl_io_error *error_out)
{
    memset(stored_out, 0, sizeof *stored_out);
    stored_out->path = tl_full_path(input->path);
    if (stored_out->path == NULL || !tl_file_look(input->path, &stored_out->facts) || stored_out->facts.is_folder) {
        tl_file_map map; // reading it names the reason
        const tl_result result = tl_file_read(input->path, 0, &map, error_out);
        if (result == TL_OK) {
            tl_file_map_close(&map);
        }
        return result != TL_OK ? result : tl_io_fail(error_out, TL_ERR_IO, input->path, 0, "", "cannot be looked at");
    }
    tl_result result = name_input(input, storing->cell_size, stored_out, error_out);
    char *stem = result == TL_OK ? tl_world_segment_stem(storing->folder, stored_out->name) : NULL;
    if (result == TL_OK && stem == NULL) {
        result = tl_io_fail(error_out, TL_ERR_MEMORY, input->path, 0, "", "out of memory");
    }
    bool complete = false;
    if (result == TL_OK) {
        result = look_at_segments(stem, stored_out, &complete, error_out);
        stored_out->was_there = complete;
    }
    if (result == TL_OK && !complete) {
        result = read_triangles(input, stem, storing, stored_out, host, error_out);
        if (result == TL_OK) {
            stored_out->segments = 0;
            stored_out->triangles = stored_out->degenerate = 0;
            result = look_at_segments(stem, stored_out, &complete, error_out);
        }
        if (result == TL_OK && !complete) {
            result = tl_io_fail(error_out, TL_ERR_IO, stem, 0, "", "segments that were just written are not there");
        }
    }
    free(stem);
    return result;
}
