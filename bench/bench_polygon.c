// SPDX-License-Identifier: MIT
//
// Convex polygon generation against rcBuildPolyMesh, where Recast is installed, in one process: all contour sets
// below TALUS_DATA_DIR/contours or those named, then the hard families and how their time grows, regular ones to
// 100,000 vertices and random ones to a million. CPU time of one thread, medians of repeated runs; growth from the
// fastest ones.
//
//   bench_polygon [CONTOURS.txt... | families] [--json FILE]
//

#include "bench_options.h"
#include "io/files/file_map.h"
#include "io/text/contour_text.h"
#include "measure.h"
#include "polygon_random_shapes.h"
#include "polygon_recast.h"
#include "report.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/polygon.h>

enum { MAX_RUNS = 101, MAX_FILES = 512 };

// Recast, and talus by each of its methods.
enum { CLASSIC, OPTIMAL, DELAUNAY, RECAST, METHOD_COUNT };
static const char *const method_names[METHOD_COUNT] = { "classic", "optimal", "Delaunay", "Recast" };

typedef struct totals {
    char kind;
    double seconds[METHOD_COUNT]; // 0: not run
    double fastest[METHOD_COUNT];
    uint64_t polygons[METHOD_COUNT];
    uint64_t contours, vertices;
    uint32_t compared; // sets that Recast divided too; classic is so many times as fast:
    double log_speeds, least_speed;
} totals;

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static double run(int method, const tl_contour_set *set, uint32_t cap, uint32_t *polygons)
{
    static const tl_partition_method methods[] = { TL_PARTITION_CLASSIC, TL_PARTITION_OPTIMAL, TL_PARTITION_DELAUNAY };
    if (method == RECAST) {
        return bench_recast_polygons(set, cap, polygons);
    }
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = cap;
    def.method = methods[method];
    tl_polygon_mesh mesh;
    double began = bench_process_seconds();
    tl_result result = tl_polygon_mesh_bake(set, &def, &mesh, NULL);
    double seconds = bench_process_seconds() - began;
    if (result != TL_OK) {
        fprintf(stderr, "bench_polygon: %s\n", tl_result_text(result));
        exit(1);
    }
    *polygons = mesh.polygon_count;
    tl_polygon_mesh_free(&mesh);
    return seconds;
}

// Runs until 0.1 s have passed, at least 5 and at most MAX_RUNS times, and adds the median to the sums.
static void measure(int method, const tl_contour_set *set, uint32_t cap, totals *sums)
{
    double times[MAX_RUNS];
    int runs = 0;
    uint32_t polygons = 0;
    for (double sum = 0; runs < MAX_RUNS && (runs < 5 || sum < 0.1); runs++) {
        times[runs] = run(method, set, cap, &polygons);
        sum += times[runs];
        if (times[runs] > 2.0) {
            runs++;
            break;
        }
    }
    sums->seconds[method] += bench_quantile(times, (size_t)runs, 0.5);
    sums->fastest[method] += times[0];
    sums->polygons[method] += polygons;
}

static void print_row(const char *name, const totals *sums)
{
    printf("%-34s %8llu", name, (unsigned long long)sums->vertices);
    for (int method = 0; method < METHOD_COUNT; method++) {
        if (sums->seconds[method] > 0.0) {
            printf(" %10.1f %8llu", sums->seconds[method] * 1e6, (unsigned long long)sums->polygons[method]);
        } else {
            printf(" %10s %8s", "-", "-");
        }
    }
    for (int method = 0; method < RECAST && sums->seconds[RECAST] > 0.0; method++) {
        printf(" %8.1f", sums->seconds[RECAST] / sums->seconds[method]);
    }
    printf("\n");
}

static void bench_file(const char *path, totals *sums)
{
    tl_file_map map;
    tl_io_error error;
    memset(&error, 0, sizeof error);
    if (tl_file_read(path, 0, &map, &error) != TL_OK) {
        fprintf(stderr, "bench_polygon: %s: %s\n", path, error.message);
        exit(1);
    }
    tl_text_reader reader = { map.bytes, map.size, path, NULL, 0, 0 };
    const char *slash = strrchr(path, '/');
    const char *name = slash != NULL ? slash + 1 : path;
    size_t length = strlen(name);
    // NAME_m.txt: monotone, w: watershed, l: layers.
    char kind = length > 6 ? name[length - 5] : '?';
    totals file;
    memset(&file, 0, sizeof file);
    while (!tl_text_reader_at_end(&reader)) {
        tl_contour_text text;
        if (tl_contour_text_read(&reader, &text, &error) != TL_OK) {
            fprintf(stderr, "bench_polygon: %s:%llu: %s\n", path, (unsigned long long)error.line, error.message);
            exit(1);
        }
        for (int method = 0; method < METHOD_COUNT; method++) {
            measure(method, &text.set, text.max_verts_per_poly, &file);
        }
        file.contours += text.set.contour_count;
        file.vertices += text.set.vertex_count;
        tl_contour_text_free(&text);
    }
    tl_file_map_close(&map);
    print_row(name, &file);
    for (uint32_t i = 0; i < 4; i++) {
        if (sums[i].kind == kind || i == 3) {
            for (int method = 0; method < METHOD_COUNT; method++) {
                sums[i].seconds[method] += file.seconds[method];
                sums[i].polygons[method] += file.polygons[method];
            }
            sums[i].contours += file.contours;
            sums[i].vertices += file.vertices;
            if (file.seconds[RECAST] > 0.0) {
                const double speed = file.seconds[RECAST] / file.seconds[CLASSIC];
                sums[i].log_speeds += log(speed);
                sums[i].least_speed = sums[i].compared++ == 0 ? speed : fmin(sums[i].least_speed, speed);
            }
        }
    }
}

static totals bench_family(const char *name, oracle_point *points, uint32_t n, int method_count)
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
    totals sums;
    memset(&sums, 0, sizeof sums);
    sums.vertices = n;
    for (int method = 0; method < method_count; method++) {
        measure(method, &set, 6, &sums);
    }
    print_row(name, &sums);
    free(vertices);
    return sums;
}

static void bench_families(bench_report *report)
{
    enum { SIZES = 4, FAMILIES = 3 };
    static const uint32_t sizes[SIZES] = { 400, 10000, 20000, 100000 };
    static const char *const names[FAMILIES] = { "star", "comb", "spiral" };
    oracle_point *points = malloc(200000 * sizeof *points);
    totals sums[SIZES][FAMILIES];
    for (uint32_t i = 0; i < SIZES; i++) {
        const int method_count = sizes[i] <= 500 ? METHOD_COUNT : RECAST; // the plain method takes hours beyond this
        shape_star(points, sizes[i], i == 0 ? 3e4 : 1e8, i == 0 ? 1e4 : 3e7);
        sums[i][0] = bench_family(names[0], points, sizes[i], method_count);
        shape_comb(points, sizes[i], 1000);
        sums[i][1] = bench_family(names[1], points, sizes[i], method_count);
        shape_spiral(points, sizes[i]);
        sums[i][2] = bench_family(names[2], points, sizes[i], method_count);
    }
    totals holes = bench_family("1,024 holes", points, shape_holes(points, 32, 32), RECAST);
    bench_report_at_most(report, "1,024 holes in one contour, ms", holes.seconds[CLASSIC] * 1e3, 100.0);
    free(points);
    printf("\ntime of 100,000 vertices over that of 10,000   classic   optimal  Delaunay\n");
    for (uint32_t f = 0; f < FAMILIES; f++) {
        printf("%-43s", names[f]);
        for (int method = 0; method < RECAST; method++) {
            printf(" %9.1f", sums[3][f].fastest[method] / sums[1][f].fastest[method]);
        }
        char claim[96];
        snprintf(claim, sizeof claim, "%s of 20,000 vertices, classic, ms", names[f]);
        bench_report_at_most(report, claim, sums[2][f].seconds[CLASSIC] * 1e3, 50.0);
        snprintf(claim, sizeof claim, "%s of 100,000 vertices, classic, ms", names[f]);
        bench_report_at_most(report, claim, sums[3][f].seconds[CLASSIC] * 1e3, 500.0);
        snprintf(claim, sizeof claim, "%s, time of 100,000 over that of 10,000", names[f]);
        bench_report_at_most(report, claim, sums[3][f].fastest[CLASSIC] / sums[1][f].fastest[0], 15.0);
        printf("\n");
    }
}

static uint32_t make_random_family(uint32_t family, oracle_point *points, uint32_t n)
{
    test_random random = { 1234 };
    switch (family) {
    case 0:
        shape_random_star(&random, points, n, 2.5e8, 0.1);
        return n;
    case 1:
        shape_random_comb(&random, points, n, 1000000);
        return n;
    case 2:
        shape_random_spiral(&random, points, n, 2.5e8);
        return n;
    default:
        break;
    }
    const uint32_t side = (uint32_t)sqrt(n / 6.0); // six corners a hole, two of them its bridge's
    return shape_random_holes(&random, points, side, side);
}

// Their ears come in no order of place, so time grows by more than instructions (tools/check-growth) as caches
// overflow.
static void bench_random_families(bench_report *report)
{
    enum { SIZES = 3, FAMILIES = 4 };
    static const uint32_t sizes[SIZES] = { 10000, 100000, 1000000 };
    static const char *const names[FAMILIES] = { "random star", "random comb", "random spiral", "random holes" };
    oracle_point *points = malloc((sizes[SIZES - 1] + 1000) * sizeof *points);
    totals sums[FAMILIES][SIZES];
    for (uint32_t f = 0; f < FAMILIES; f++) {
        for (uint32_t i = 0; i < SIZES; i++) {
            const uint32_t n = make_random_family(f, points, sizes[i]);
            sums[f][i] = bench_family(names[f], points, n, CLASSIC + 1);
        }
    }
    free(points);
    printf("\ntime grows by n^                     10,000 to 100,000   to 1,000,000\n");
    for (uint32_t f = 0; f < FAMILIES; f++) {
        double powers[2];
        for (uint32_t i = 0; i < 2; i++) {
            powers[i] = log10(sums[f][i + 1].fastest[CLASSIC] / sums[f][i].fastest[CLASSIC]);
        }
        printf("%-36s %17.2f %14.2f\n", names[f], powers[0], powers[1]);
        char claim[96];
        snprintf(claim, sizeof claim, "%s of 1,000,000 vertices, classic, ms", names[f]);
        bench_report_at_most(report, claim, sums[f][2].seconds[CLASSIC] * 1e3, 1500.0);
    }
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

// What the sets of contours show beside Recast's stage.
static void claim_sets(const totals *sums, const char *const *names, bench_report *report)
{
    static const double classic_bars[4] = { 10.0, 6.0, 20.0, 10.0 };
    for (uint32_t i = 0; i < 4; i++) {
        if (sums[i].contours == 0) {
            continue;
        }
        for (int method = 0; method < METHOD_COUNT; method++) {
            if (sums[i].seconds[method] > 0.0) {
                bench_report_value(report, "sets of contours", method_names[method], names[i],
                                   sums[i].seconds[method] * 1e3);
            }
        }
        if (sums[i].seconds[RECAST] > 0.0) {
            char claim[96];
            snprintf(claim, sizeof claim, "%s: classic", names[i]);
            bench_report_speed(report, claim, "Recast", sums[i].seconds[RECAST] / sums[i].seconds[CLASSIC],
                               classic_bars[i]);
            snprintf(claim, sizeof claim, "%s: classic, geometric mean of sets", names[i]);
            bench_report_speed(report, claim, "Recast", exp(sums[i].log_speeds / sums[i].compared), 5.0);
            snprintf(claim, sizeof claim, "%s: classic, worst set", names[i]);
            bench_report_speed(report, claim, "Recast", sums[i].least_speed, 2.0);
            snprintf(claim, sizeof claim, "%s: optimal", names[i]);
            bench_report_speed(report, claim, "Recast", sums[i].seconds[RECAST] / sums[i].seconds[OPTIMAL], 1.0);
        }
    }
    if (sums[0].contours > 0 && sums[0].polygons[RECAST] > 0) {
        bench_report_at_most(report, "all watershed: optimal, fraction of Recast's polygons",
                             (double)sums[0].polygons[OPTIMAL] / (double)sums[0].polygons[RECAST], 0.88);
    }
}

int main(int argc, char **argv)
{
    const bench_option options[] = { { NULL, BENCH_COUNT, NULL, NULL } };
    const char **files = calloc((size_t)argc, sizeof *files);
    const char *json = NULL;
    const int file_count = files != NULL ? bench_parse(argc, argv, options, files, &json) : 0;
    bench_report *report = bench_report_new("polygon", "ms", NULL);
    static const char kinds[4] = { 'w', 'm', 'l', '*' };
    totals sums[4];
    memset(sums, 0, sizeof sums);
    for (uint32_t i = 0; i < 4; i++) {
        sums[i].kind = kinds[i];
    }
    static const char *const names[4] = { "all watershed", "all monotone", "all layers", "all" };
    printf("%-34s %8s %10s %8s %10s %8s %10s %8s %10s %8s %26s\n", "contours", "vertices", "classic us", "polygons",
           "optimal us", "polygons", "Delaunay", "polygons", "Recast us", "polygons", "times as fast as Recast");
    if (file_count > 0 && strcmp(files[0], "families") != 0) {
        for (int i = 0; i < file_count; i++) {
            bench_file(files[i], sums);
        }
    } else if (file_count == 0) {
        bench_folder(TALUS_DATA_DIR "/contours", sums);
    }
    for (uint32_t i = 0; i < 4; i++) {
        if (sums[i].contours > 0) {
            print_row(names[i], &sums[i]);
        }
    }
    claim_sets(sums, names, report);
    bench_families(report);
    bench_random_families(report);
    printf("\n");
    bench_report_print_claims(report);
    free(files);
    return bench_report_close(report, json);
}
