// SPDX-License-Identifier: MIT
//
// How fast an OBJ file becomes triangles: megabytes a second of talus's reader, and of Assimp on the same files in the
// same run; a ratio is how many times as fast talus is.
//
//   bench_obj [--side N (707)] [--repetitions N (5)] [--assimp N (1)] [--json FILE]
//
// The files are made here: terrain of 1,000,000 triangles, in the forms that exporters write. Each is read from the
// page cache, by one thread. A figure is the median of the repetitions in processor time, which other programs disturb
// less than the clock on the wall.

#define _GNU_SOURCE

#include "bench_options.h"
#include "io/files/atomic_write.h"
#include "io/files/file_map.h"
#include "io/mesh/mesh_import.h"
#include "io/mesh/obj_reader.h"
#include "measure.h"
#include "report.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_REPETITIONS = 9 };

typedef struct obj_form {
    const char *name;
    const char *number; // printf format of a coordinate
    bool references;    // vt and vn lines, and v/vt/vn corners
    bool quads;
} obj_form;

static void write_text(tl_atomic_file *file, const char *text)
{
    tl_atomic_file_write(file, text, strlen(text), NULL);
}

// A hilly square of 2 * side * side triangles.
static tl_result write_terrain(const char *path, const obj_form *form, unsigned side, tl_io_error *error)
{
    tl_atomic_file *file;
    tl_result result = tl_atomic_file_open(path, &file, error);
    if (result != TL_OK) {
        return result;
    }
    char vertex_format[64];
    char line[256];
    snprintf(vertex_format, sizeof vertex_format, "v %s %s %s\n", form->number, form->number, form->number);
    uint64_t noise = 1;
    for (unsigned z = 0; z <= side; z++) {
        for (unsigned x = 0; x <= side; x++) {
            noise = noise * 6364136223846793005u + 1442695040888963407u;
            double height = (double)(noise >> 40) * 1e-6;
            snprintf(line, sizeof line, vertex_format, 0.37 * x - 100.0, height, 0.41 * z - 120.0);
            write_text(file, line);
            if (form->references) {
                snprintf(line, sizeof line, "vt %.6f %.6f\nvn %.4f %.4f %.4f\n", x / 500.0, z / 500.0, 0.1234, 0.9876,
                         -height / 100.0);
                write_text(file, line);
            }
        }
    }
    for (unsigned z = 0; z < side; z++) {
        for (unsigned x = 0; x < side; x++) {
            unsigned a = z * (side + 1) + x + 1;
            unsigned b = a + 1;
            unsigned c = b + side;
            unsigned d = c + 1;
            const char *corners = form->references ? form->quads ? "f %u/%u/%u %u/%u/%u %u/%u/%u %u/%u/%u\n"
                                                                 : "f %u/%u/%u %u/%u/%u %u/%u/%u\n"
                                  : form->quads    ? "f %u %u %u %u\n"
                                                   : "f %u %u %u\n";
            if (form->references) {
                snprintf(line, sizeof line, corners, a, a, a, c, c, c, d, d, d, b, b, b);
            } else {
                snprintf(line, sizeof line, corners, a, c, d, b);
            }
            write_text(file, line);
            if (!form->quads) {
                if (form->references) {
                    snprintf(line, sizeof line, corners, a, a, a, d, d, d, b, b, b);
                } else {
                    snprintf(line, sizeof line, corners, a, d, b);
                }
                write_text(file, line);
            }
        }
    }
    return tl_atomic_file_commit(file, error);
}

// Seconds; the triangles go to `triangles_out`.
static double time_ours(const char *path, uint32_t *triangles_out)
{
    double start = bench_process_seconds();
    tl_imported_mesh mesh;
    tl_io_error error;
    if (tl_import_mesh(path, NULL, &mesh, &error) != TL_OK) {
        char text[1024];
        tl_io_error_format(&error, text, sizeof text);
        fprintf(stderr, "%s\n", text);
        exit(1);
    }
    double seconds = bench_process_seconds() - start;
    *triangles_out = mesh.triangle_count;
    tl_imported_mesh_free(&mesh);
    return seconds;
}

static double time_assimp(const char *path, uint32_t *triangles_out)
{
    double start = bench_process_seconds();
    const struct aiScene *scene = aiImportFile(path, aiProcess_Triangulate);
    double seconds = bench_process_seconds() - start;
    *triangles_out = 0;
    for (unsigned i = 0; scene != NULL && i < scene->mNumMeshes; i++) {
        *triangles_out += scene->mMeshes[i]->mNumFaces;
    }
    aiReleaseImport(scene);
    return seconds;
}

static void measure(const char *path, const obj_form *form, uint32_t repetitions, uint32_t assimp_repetitions,
                    bench_report *report)
{
    double seconds[MAX_REPETITIONS];
    uint32_t triangles = 0;
    uint32_t assimp_triangles = 0;
    tl_file_map map;
    if (tl_file_read(path, 0, &map, NULL) != TL_OK) {
        return;
    }
    double megabytes = (double)map.size * 1e-6;
    tl_file_map_close(&map);
    time_ours(path, &triangles);
    for (uint32_t i = 0; i < repetitions; i++) {
        seconds[i] = time_ours(path, &triangles);
    }
    double ours = bench_quantile(seconds, repetitions, 0.5);
    printf("%-22s %8.1f %10u %9.1f %8.0f", form->name, megabytes, triangles, ours * 1e3, megabytes / ours);
    bench_report_value(report, "OBJ import", "talus", form->name, megabytes / ours);
    if (assimp_repetitions > 0) {
        for (uint32_t i = 0; i < assimp_repetitions; i++) {
            seconds[i] = time_assimp(path, &assimp_triangles);
        }
        double theirs = bench_quantile(seconds, assimp_repetitions, 0.5);
        printf(" %9.1f %8.0f %7.1f%s", theirs * 1e3, megabytes / theirs, theirs / ours,
               assimp_triangles == triangles ? "" : "  (counts differ)");
        bench_report_value(report, "OBJ import", "Assimp", form->name, megabytes / theirs);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    uint32_t side = 707, repetitions = 5, assimp_repetitions = 1; // 999,698 triangles
    const bench_option options[] = { { "side", BENCH_COUNT, &side, "squares along a side of the terrain" },
                                     { "repetitions", BENCH_COUNT, &repetitions, "of which the median counts" },
                                     { "assimp", BENCH_COUNT, &assimp_repetitions,
                                       "repetitions of Assimp; 0: without it" },
                                     { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    if (side < 1 || side > 10000 || repetitions < 1 || repetitions > MAX_REPETITIONS ||
        assimp_repetitions > MAX_REPETITIONS) {
        fprintf(stderr, "bench_obj: --side 1 to 10000, --repetitions 1 to %d\n", MAX_REPETITIONS);
        return 2;
    }
    static const obj_form forms[] = {
        { "triangles, 6 places", "%.6f", false, false },   { "triangles, 7 digits", "%.7g", false, false },
        { "triangles, 17 digits", "%.17g", false, false }, { "quads, 6 places", "%.6f", false, true },
        { "triangles, v/vt/vn", "%.6f", true, false },
    };
    char path[] = "/tmp/bench_obj_XXXXXX.obj";
    int descriptor = mkstemps(path, 4);
    if (descriptor < 0) {
        perror(path);
        return 1;
    }
    close(descriptor);
    bench_report *report = bench_report_new("obj", "MB/s", NULL);
    printf("%-22s %8s %10s %9s %8s %9s %8s %7s\n", "OBJ", "MB", "triangles", "ms", "MB/s", "Assimp ms", "MB/s",
           "ratio");
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        tl_io_error error;
        if (write_terrain(path, &forms[i], side, &error) != TL_OK) {
            fprintf(stderr, "%s\n", error.message);
            break;
        }
        measure(path, &forms[i], repetitions, assimp_repetitions, report);
        fflush(stdout);
    }
    unlink(path);
    return bench_report_close(report, json);
}
