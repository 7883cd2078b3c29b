// SPDX-License-Identifier: MIT

#include "cli/commands/sample_files.h"

#include "cli/sample/sample_world.h"
#include "cli/shared/text_buffer.h"
#include "io/files/atomic_write.h"
#include "world/bytes/folder.h"
#include "world/bytes/little_endian.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PART_HEAD = 84, PART_TRIANGLE = 50 };

static tl_result write_triangles(tl_atomic_file *file, const tl_sample_mesh *mesh, tl_io_error *error)
{
    unsigned char bytes[64 * PART_TRIANGLE];
    tl_result result = TL_OK;
    for (uint32_t first = 0; first < mesh->triangle_count && result == TL_OK; first += 64) {
        const uint32_t left = mesh->triangle_count - first, count = left < 64 ? left : 64;
        memset(bytes, 0, sizeof bytes); // normals are left to the reader, as the format allows
        for (uint32_t i = 0; i < 3 * count; i++) {
            const tl_vec3 p = mesh->vertices[mesh->indices[3 * (size_t)first + i]];
            unsigned char *at = bytes + (size_t)(i / 3) * PART_TRIANGLE + 12 + 12 * (i % 3);
            tl_put_float(at, p.x);
            tl_put_float(at + 4, p.y);
            tl_put_float(at + 8, p.z);
        }
        result = tl_atomic_file_write(file, bytes, (size_t)count * PART_TRIANGLE, error);
    }
    return result;
}

static tl_result write_stl(const char *path, const tl_sample_mesh *mesh, tl_io_error *error)
{
    tl_atomic_file *file;
    unsigned char head[PART_HEAD] = "a part of talus' sample world";
    tl_put_u32(head + 80, mesh->triangle_count);
    tl_result result = tl_atomic_file_open(path, &file, error);
    if (result != TL_OK) {
        return result;
    }
    result = tl_atomic_file_write(file, head, sizeof head, error);
    if (result == TL_OK) {
        result = write_triangles(file, mesh, error);
    }
    if (result != TL_OK) {
        tl_atomic_file_abort(file);
        return result;
    }
    return tl_atomic_file_commit_unflushed(file, error);
}

static tl_exit write_part(tl_cli *cli, const char *output, uint64_t seed, uint32_t x, uint32_t z, uint32_t *count_out)
{
    tl_io_error error;
    tl_sample_mesh mesh;
    char path[4096];
    memset(&error, 0, sizeof error);
    memset(&mesh, 0, sizeof mesh);
    tl_sample_world_part(seed, x, z, &mesh);
    *count_out = mesh.triangle_count;
    const bool fits = (size_t)snprintf(path, sizeof path, "%s/part_%u_%u.stl", output, x, z) < sizeof path;
    tl_exit code = TL_EXIT_OK;
    if (!fits) {
        code = tl_cli_fail(cli, TL_EXIT_USAGE, "the folder's name is too long");
    } else if (mesh.result != TL_OK) {
        code = tl_cli_fail_result(cli, path, mesh.result, NULL);
    } else if (write_stl(path, &mesh, &error) != TL_OK) {
        code = tl_cli_fail_io(cli, &error);
    }
    tl_sample_mesh_free(&mesh);
    return code;
}

static tl_exit write_manifest(tl_cli *cli, const char *output, uint32_t parts_x, uint64_t parts)
{
    tl_text text;
    tl_io_error error;
    char line[160], path[4096];
    memset(&text, 0, sizeof text);
    memset(&error, 0, sizeof error);
    tl_text_add(&text, "{ \"inputs\": [\n");
    for (uint64_t i = 0; i < parts; i++) {
        const unsigned x = (unsigned)(i % parts_x), z = (unsigned)(i / parts_x);
        snprintf(line, sizeof line, "  { \"file\": \"part_%u_%u.stl\", \"translate\": [%u, 0, %u] }%s\n", x, z,
                 x * TL_SAMPLE_PART_METRES, z * TL_SAMPLE_PART_METRES, i + 1 < parts ? "," : "");
        tl_text_add(&text, line);
    }
    tl_text_add(&text, "] }\n");
    snprintf(path, sizeof path, "%s/world.json", output);
    tl_exit code = TL_EXIT_OK;
    if (text.failed) {
        code = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
    } else if (tl_atomic_write(path, text.bytes, text.size, &error) != TL_OK) {
        code = tl_cli_fail_io(cli, &error);
    }
    tl_text_free(&text);
    return code;
}

tl_exit tl_sample_files_write(tl_cli *cli, const char *output, uint64_t triangles, uint64_t seed,
                              tl_sample_files *files_out)
{
    tl_io_error error;
    memset(&error, 0, sizeof error);
    memset(files_out, 0, sizeof *files_out);
    if (tl_folder_make(output, &error) != TL_OK) {
        return tl_cli_fail_io(cli, &error);
    }
    const double side = ceil(sqrt((double)triangles / (double)TL_SAMPLE_PART_TRIANGLES));
    files_out->parts_x = side > 1.0 ? (uint32_t)side : 1;
    uint64_t parts = 0;
    tl_exit code = TL_EXIT_OK;
    while (code == TL_EXIT_OK && (parts == 0 || files_out->triangles < triangles)) {
        uint32_t count = 0;
        code = write_part(cli, output, seed, (uint32_t)(parts % files_out->parts_x),
                          (uint32_t)(parts / files_out->parts_x), &count);
        files_out->triangles += count;
        parts++;
        const tl_progress *progress = cli->host.progress;
        if (code == TL_EXIT_OK &&
            !progress->update("write", files_out->triangles < triangles ? files_out->triangles : triangles, triangles,
                              progress->user)) {
            code = tl_cli_fail(cli, TL_EXIT_CANCELLED, "cancelled");
        }
    }
    files_out->parts_z = (uint32_t)((parts + files_out->parts_x - 1) / files_out->parts_x);
    return code == TL_EXIT_OK ? write_manifest(cli, output, files_out->parts_x, parts) : code;
}
