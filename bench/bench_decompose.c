// SPDX-License-Identifier: MIT
//
// Decomposition into convex parts: how many, how far they reach beyond the body, their volume and the processor time of
// one thread, at tolerances of 10, 5 and 2.5% of the longest side. On the models of TALUS_DATA_DIR and three levels; or
//
//   bench_decompose MODEL.obj [PARTS.obj]
//
// where PARTS.obj, of an object a part, is what another tool made of the model: its vertices' hulls are judged by the
// proof that talus judges its own by, and talus decomposes with the concavity that they have.

#include "base/arena.h"
#include "base/stage.h"
#include "bench_options.h"
#include "decompose/concavity_proof.h"
#include "measure.h"
#include "report.h"
#include "soup_levels.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <talus/decompose.h>

enum { MAX_PART_VERTICES = 1 << 16, PROOF_BUDGET = 1 << 22 };

static const float TOLERANCES[] = { 0.1f, 0.05f, 0.025f };
static const float PROOF_PRECISION = 0.001f; // share of the longest side

static float longest_side(const tl_mesh_view *view)
{
    tl_aabb box = tl_aabb_empty();
    for (uint32_t i = 0; i < 3 * view->triangle_count; i++) {
        const tl_vec3 corner = view->vertices[view->indices[i]];
        const tl_aabb point = { corner, corner };
        box = tl_aabb_union(box, point);
    }
    const tl_vec3 size = tl_aabb_size(box);
    return tl_maxf(size.x, tl_maxf(size.y, size.z));
}

static void bench_tolerance(bench_report *report, const bench_level *level, float side, float share)
{
    tl_decompose_def def = tl_default_decompose_def();
    def.tolerance = share * side;
    tl_decomposition body;
    tl_decompose_report found;
    const double start = bench_thread_seconds();
    const tl_result result = tl_decomposition_bake(&level->view, &def, &body, &found);
    const double seconds = bench_thread_seconds() - start;
    if (result != TL_OK) {
        printf("%-22s %8.4f  %s\n", level->name, (double)share, tl_result_text(result));
        return;
    }
    uint32_t vertices = 0;
    for (uint32_t i = 0; i < body.part_count; i++) {
        vertices += body.parts[i].hull->vertex_count;
    }
    const double volume = body.hull_volume / ((double)side * (double)side * (double)side);
    printf("%-22s %9u %9.4f %6u %9u %9.4f %9.5f %9.2f\n", level->name, level->view.triangle_count, (double)share,
           body.part_count, vertices, body.concavity / (double)side, volume, seconds);
    char series[32];
    snprintf(series, sizeof series, "tolerance %g", (double)share);
    bench_report_value(report, "parts", series, level->name, (double)body.part_count);
    bench_report_value(report, "seconds", series, level->name, seconds);
    tl_decomposition_free(&body);
}

static void bench_model(bench_report *report, const bench_level *level)
{
    const float side = longest_side(&level->view);
    for (size_t i = 0; i < sizeof TOLERANCES / sizeof *TOLERANCES; i++) {
        bench_tolerance(report, level, side, TOLERANCES[i]);
    }
}

// ---- Another tool's parts -----------------------------------------------------------------------------------

typedef struct foreign_parts {
    const tl_distance_grid *grid;
    float side;
    uint32_t count, vertex_count;
    double concavity, volume;
} foreign_parts;

static void judge_part(foreign_parts *parts, const tl_vec3 *points, uint32_t count)
{
    const tl_allocator allocator = tl_allocator_or_default(NULL);
    const tl_concavity_goal goal = { 0.0, (double)INFINITY, (double)(PROOF_PRECISION * parts->side), PROOF_BUDGET };
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    tl_concavity concavity;
    def.thickness = 1e-4f * parts->side;
    if (count == 0) {
        return;
    }
    if (tl_hull_bake(points, count, &def, &hull, NULL) != TL_OK ||
        tl_concavity_prove(hull, parts->grid, &goal, &allocator, &concavity) != TL_OK) {
        fprintf(stderr, "a part could not be judged\n");
        exit(1);
    }
    parts->count++;
    parts->vertex_count += hull->vertex_count;
    parts->volume += hull->mass.volume;
    parts->concavity = fmax(parts->concavity, concavity.bound);
    tl_blob_free(hull);
}

static void judge_file(foreign_parts *parts, const char *path)
{
    static tl_vec3 points[MAX_PART_VERTICES];
    char line[256];
    uint32_t count = 0;
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        fprintf(stderr, "%s cannot be read\n", path);
        exit(2);
    }
    while (fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "o ", 2) == 0) {
            judge_part(parts, points, count);
            count = 0;
        }
        tl_vec3 *p = &points[count < MAX_PART_VERTICES ? count : 0];
        count += sscanf(line, "v %f %f %f", &p->x, &p->y, &p->z) == 3;
    }
    fclose(file);
    judge_part(parts, points, count);
}

// The distances that the proof begins with, as a bake measures them.
static void bench_foreign(bench_report *report, const bench_level *level, const char *path)
{
    foreign_parts parts = { NULL, longest_side(&level->view), 0, 0, 0.0, 0.0 };
    const tl_allocator allocator = tl_allocator_or_default(NULL);
    const tl_decompose_def def = tl_default_decompose_def();
    const double tolerance = (double)(def.relative_tolerance * parts.side);
    tl_soup *soup;
    tl_arena arena;
    tl_stage stage;
    tl_distance_grid grid;
    tl_arena_init(&arena, &allocator);
    if (tl_soup_bake(&level->view, NULL, &soup, NULL) != TL_OK ||
        tl_stage_begin(&stage, &def.host, "distances", 1) != TL_OK ||
        tl_distance_grid_build(soup, &def, tolerance, 0.0f, &arena, &stage, &grid) != TL_OK) {
        fprintf(stderr, "%s: no distances\n", level->name);
        exit(1);
    }
    parts.grid = &grid;
    judge_file(&parts, path);
    const double side = (double)parts.side;
    printf("%-22s %9s %9s %6u %9u %9.4f %9.5f\n", level->name, "theirs", "", parts.count, parts.vertex_count,
           parts.concavity / side, parts.volume / (side * side * side));
    bench_tolerance(report, level, parts.side, (float)(parts.concavity / side));
    tl_arena_free(&arena);
    tl_blob_free(soup);
}

// ---- What is measured -----------------------------------------------------------------------------------------

static void bench_all(bench_report *report)
{
    static const char *const models[] = { "cow",     "spot",        "suzanne", "homer",     "rocker-arm",
                                          "fandisk", "cheburashka", "beast",   "alligator", "nefertiti" };
    static const char *const samples[] = { "courtyard", "dungeon", "city" };
    bench_level level;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/models/%s.obj", TALUS_DATA_DIR, models[i]);
        if (bench_load_file(path, &level)) {
            bench_model(report, &level);
            bench_free_levels(&level, 1);
        }
    }
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
        if (bench_make_sample(samples[i], 2000, &level)) {
            bench_model(report, &level);
            bench_free_levels(&level, 1);
        }
    }
}

int main(int argc, char **argv)
{
    const bench_option options[] = { { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    const char **words = calloc((size_t)argc, sizeof *words);
    const int word_count = bench_parse(argc, argv, options, words, &json);
    bench_report *report = bench_report_new("Convex parts", "parts, seconds", NULL);
    printf("%-22s %9s %9s %6s %9s %9s %9s %9s\n", "mesh", "triangles", "tolerance", "parts", "vertices", "concavity",
           "volume", "seconds");
    bench_level level;
    if (word_count == 0) {
        bench_all(report);
    } else if (!bench_load_file(words[0], &level)) {
        fprintf(stderr, "%s cannot be read\n", words[0]);
        return 2;
    } else {
        if (word_count > 1) {
            bench_foreign(report, &level, words[1]);
        } else {
            bench_model(report, &level);
        }
        bench_free_levels(&level, 1);
    }
    free(words);
    return bench_report_close(report, json);
}
