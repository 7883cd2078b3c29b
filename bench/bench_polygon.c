// SPDX-License-Identifier: MIT
//
// Convex polygon generation against rcBuildPolyMesh, where Recast is installed, in one process: all contour sets
// below TALUS_DATA_DIR/contours or those named, then the hard families. Medians of repeated runs.
//
//   bench_polygon [CONTOURS.txt...]

#include "bench_polygon_recast.h"
#include "io/contour_text.h"
#include "io/file_map.h"
#include "test/polygon_shapes.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/polygon.h>
#include <time.h>

enum { MAX_RUNS = 101, MAX_FILES = 512 };

typedef struct totals {
    char kind;
    double talus, recast;
    uint64_t talus_polygons, recast_polygons, contours, vertices;
} totals;

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

// Runs until 0.1 s have passed, at least 3 and at most MAX_RUNS times.
static double median_seconds(double (*run)(const tl_contour_set *, uint32_t, uint32_t *), const tl_contour_set *set,
                             uint32_t cap, uint32_t *polygons)
{
    double times[MAX_RUNS];
    int runs = 0;
    for (double sum = 0; runs < MAX_RUNS && (runs < 3 || sum < 0.1); runs++) {
        times[runs] = run(set, cap, polygons);
        sum += times[runs];
        if (times[runs] > 2.0) {
            return times[runs];
        }
    }
    qsort(times, (size_t)runs, sizeof *times, by_size);
    return times[runs / 2];
}

static double run_talus(const tl_contour_set *set, uint32_t cap, uint32_t *polygons)
{
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = cap;
    tl_polygon_mesh mesh;
    double began = now();
    tl_result result = tl_polygon_mesh_build(set, &def, &mesh, NULL);
    double seconds = now() - began;
    if (result != TL_OK) {
        fprintf(stderr, "bench_polygon: %s\n", tl_result_text(result));
        exit(1);
    }
    *polygons = mesh.polygon_count;
    tl_polygon_mesh_free(&mesh, NULL);
    return seconds;
}

static double run_recast(const tl_contour_set *set, uint32_t cap, uint32_t *polygons)
{
    return bench_recast_polygons(set, cap, polygons);
}

static void print_row(const char *name, uint64_t vertices, double talus, uint64_t talus_polygons, double recast,
                      uint64_t recast_polygons)
{
    printf("%-34s %8llu %10.1f %8llu", name, (unsigned long long)vertices, talus * 1e6,
           (unsigned long long)talus_polygons);
    if (recast > 0.0) {
        printf(" %12.1f %8llu %8.3f", recast * 1e6, (unsigned long long)recast_polygons, talus / recast);
    }
    printf("\n");
}

static void bench_file(const char *path, totals *sums)
{
    tl_file_map map;
    tl_io_error error;
    memset(&error, 0, sizeof error);
    if (tl_file_map_open(path, 0, &map, &error) != TL_OK) {
        fprintf(stderr, "bench_polygon: %s: %s\n", path, error.message);
        exit(1);
    }
    tl_contour_reader reader = { map.bytes, map.size, path, NULL, 0, 0 };
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    size_t length = strlen(name);
    // NAME_m.txt: monotone, w: watershed, l: layers.
    char kind = length > 6 ? name[length - 5] : '?';
    totals file = { kind, 0, 0, 0, 0, 0, 0 };
    while (!tl_contour_reader_at_end(&reader)) {
        tl_contour_text text;
        if (tl_contour_text_read(&reader, &text, &error) != TL_OK) {
            fprintf(stderr, "bench_polygon: %s:%llu: %s\n", path, (unsigned long long)error.line, error.message);
            exit(1);
        }
        uint32_t cap = text.max_verts_per_poly, polygons = 0;
        file.talus += median_seconds(run_talus, &text.set, cap, &polygons);
        file.talus_polygons += polygons;
        polygons = 0;
        file.recast += median_seconds(run_recast, &text.set, cap, &polygons);
        file.recast_polygons += polygons;
        file.contours += text.set.contour_count;
        file.vertices += text.set.vertex_count;
        tl_contour_text_free(&text);
    }
    tl_file_map_close(&map);
    print_row(name, file.vertices, file.talus, file.talus_polygons, file.recast, file.recast_polygons);
    for (uint32_t i = 0; i < 4; i++) {
        if (sums[i].kind == kind || i == 3) {
            sums[i].talus += file.talus;
            sums[i].recast += file.recast;
            sums[i].talus_polygons += file.talus_polygons;
            sums[i].recast_polygons += file.recast_polygons;
            sums[i].contours += file.contours;
            sums[i].vertices += file.vertices;
        }
    }
}

static void bench_family(const char *name, oracle_point *points, uint32_t n)
{
    // Recast's coordinates are 16 bits without sign.
    oracle_point low = points[0];
    for (uint32_t i = 1; i < n; i++) {
        low.x = points[i].x < low.x ? points[i].x : low.x;
        low.z = points[i].z < low.z ? points[i].z : low.z;
    }
    for (uint32_t i = 0; i < n; i++) {
        points[i].x -= low.x;
        points[i].z -= low.z;
    }
    tl_contour_vertex *vertices = malloc(n * sizeof *vertices);
    tl_contour contour;
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    uint32_t polygons = 0, recast_polygons = 0;
    double talus = median_seconds(run_talus, &set, 6, &polygons);
    // The plain method takes hours beyond this.
    double recast = n <= 500 ? median_seconds(run_recast, &set, 6, &recast_polygons) : 0.0;
    print_row(name, n, talus, polygons, recast, recast_polygons);
    free(vertices);
}

static void bench_families(void)
{
    static const uint32_t sizes[4] = { 400, 10000, 20000, 100000 };
    oracle_point *points = malloc(200000 * sizeof *points);
    for (uint32_t i = 0; i < 4; i++) {
        shape_star(points, sizes[i], i == 0 ? 3e4 : 1e8, i == 0 ? 1e4 : 3e7);
        bench_family("star", points, sizes[i]);
        shape_comb(points, sizes[i], 1000);
        bench_family("comb", points, sizes[i]);
        shape_spiral(points, sizes[i]);
        bench_family("spiral", points, sizes[i]);
    }
    bench_family("1,024 holes", points, shape_holes(points, 32, 32));
    free(points);
}

static void bench_folder(const char *folder, totals *sums)
{
    char *paths[MAX_FILES];
    size_t count = 0;
    DIR *directory = opendir(folder);
    if (directory == NULL) {
        return;
    }
    for (struct dirent *entry = readdir(directory); entry != NULL && count < MAX_FILES; entry = readdir(directory)) {
        size_t length = strlen(entry->d_name);
        if (length > 4 && strcmp(entry->d_name + length - 4, ".txt") == 0 && strstr(entry->d_name, ".recast") == NULL &&
            strstr(entry->d_name, "critterai") == NULL) {
            size_t size = strlen(folder) + length + 2;
            paths[count] = malloc(size);
            snprintf(paths[count++], size, "%s/%s", folder, entry->d_name);
        }
    }
    closedir(directory);
    qsort(paths, count, sizeof *paths, by_name);
    for (size_t i = 0; i < count; i++) {
        bench_file(paths[i], sums);
        free(paths[i]);
    }
}

int main(int argc, char **argv)
{
    totals sums[4] = {
        { 'w', 0, 0, 0, 0, 0, 0 }, { 'm', 0, 0, 0, 0, 0, 0 }, { 'l', 0, 0, 0, 0, 0, 0 }, { '*', 0, 0, 0, 0, 0, 0 }
    };
    static const char *const names[4] = { "all watershed", "all monotone", "all layers", "all" };
    printf("%-34s %8s %10s %8s %12s %8s %8s\n", "contours", "vertices", "talus us", "polygons", "Recast us", "polygons",
           "ratio");
    if (argc > 1) {
        for (int i = 1; i < argc; i++) {
            bench_file(argv[i], sums);
        }
    } else {
        bench_folder(TALUS_DATA_DIR "/contours", sums);
    }
    for (uint32_t i = 0; i < 4; i++) {
        if (sums[i].contours > 0) {
            print_row(names[i], sums[i].vertices, sums[i].talus, sums[i].talus_polygons, sums[i].recast,
                      sums[i].recast_polygons);
        }
    }
    bench_families();
    return 0;
}
