// SPDX-License-Identifier: MIT
//
// The editable half-edge mesh, without a peer: nanoseconds for each operation, from a thousand to a million vertices.
// The mesh is a closed torus of triangles, six at each vertex; "in order" builds, walks and removes it as a file would
// list it, "random" shuffles faces and vertices, so that at large sizes every access leaves the cache.

#define _GNU_SOURCE

#include "base/random.h"
#include "bench_options.h"
#include "measure.h"
#include "report.h"

#include <talus/halfedge.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { REPETITIONS = 5, MIN_FACES_A_SIZE = 200000 };

typedef enum figure { ADD_VERTEX, ADD_FACE, FIND_EDGE, RING_STEP, LOOP_STEP, REMOVE_FACE, FIGURE_COUNT } figure;

typedef struct torus {
    uint32_t vertex_count, face_count;
    uint32_t (*faces)[3];
} torus;

static uint64_t random_state = 1;

static uint32_t random_below(uint32_t limit)
{
    return tl_random_below(&random_state, limit);
}

static double now(void)
{
    return 1e9 * bench_thread_seconds();
}

static void *allocate(size_t count, size_t size)
{
    void *memory = malloc(count * size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(1);
    }
    return memory;
}

static void shuffle(uint32_t *list, uint32_t count)
{
    for (uint32_t i = count; i > 1; i--) {
        uint32_t j = random_below(i), kept = list[i - 1];
        list[i - 1] = list[j];
        list[j] = kept;
    }
}

static uint32_t *numbers(uint32_t count, bool shuffled)
{
    uint32_t *list = allocate(count, sizeof *list);
    for (uint32_t i = 0; i < count; i++) {
        list[i] = i;
    }
    if (shuffled) {
        shuffle(list, count);
    }
    return list;
}

static torus make_torus(uint32_t side, bool shuffled)
{
    torus t = { side * side, 2 * side * side, NULL };
    t.faces = allocate(t.face_count, sizeof *t.faces);
    uint32_t *vertex = numbers(t.vertex_count, shuffled), *place = numbers(t.face_count, shuffled);
    for (uint32_t y = 0; y < side; y++) {
        for (uint32_t x = 0; x < side; x++) {
            uint32_t right = (x + 1) % side, up = (y + 1) % side;
            uint32_t a = vertex[y * side + x], b = vertex[y * side + right];
            uint32_t c = vertex[up * side + right], d = vertex[up * side + x];
            uint32_t *first = t.faces[place[2 * (y * side + x)]], *second = t.faces[place[2 * (y * side + x) + 1]];
            first[0] = second[0] = a;
            first[1] = b;
            first[2] = second[1] = c;
            second[2] = d;
        }
    }
    free(vertex);
    free(place);
    return t;
}

static void must(bool fine)
{
    if (!fine) {
        fprintf(stderr, "the mesh is not what it should be\n");
        exit(1);
    }
}

static volatile uint32_t sink;

// One life of a mesh; lowers each figure to the best seen. The mesh keeps its memory from the life before.
static void live(tl_halfedge_mesh *mesh, const torus *t, const uint32_t *vertices, double best[FIGURE_COUNT])
{
    double times[FIGURE_COUNT + 1];
    uint32_t found = 0, steps = 0;
    tl_halfedge_mesh_clear(mesh);
    times[ADD_VERTEX] = now();
    for (uint32_t v = 0; v < t->vertex_count; v++) {
        uint32_t unused;
        must(tl_halfedge_mesh_add_vertex(mesh, tl_vec3_make((float)v, 0.0f, 0.0f), &unused) == TL_OK);
    }
    times[ADD_FACE] = now();
    for (uint32_t f = 0; f < t->face_count; f++) {
        must(tl_halfedge_mesh_add_face(mesh, t->faces[f], 3, NULL) == TL_OK);
    }
    times[FIND_EDGE] = now();
    for (uint32_t f = 0; f < t->face_count; f++) {
        found += tl_halfedge_mesh_find_edge(mesh, t->faces[f][0], t->faces[f][1]) != TL_HALFEDGE_NONE;
    }
    times[RING_STEP] = now();
    for (uint32_t i = 0; i < t->vertex_count; i++) {
        uint32_t start = mesh->vertices[vertices[i]].edge, edge = start;
        do {
            steps += tl_halfedge_target(mesh, edge) != vertices[i];
            edge = tl_halfedge_around(mesh, edge);
        } while (edge != start);
    }
    times[LOOP_STEP] = now();
    for (uint32_t f = 0; f < t->face_count; f++) {
        uint32_t start = mesh->faces[f].edge, edge = start;
        do {
            sink = edge;
            edge = mesh->edges[edge].next;
        } while (edge != start);
    }
    times[REMOVE_FACE] = now();
    must(mesh->boundary_count == 0 && found == t->face_count && steps == 3 * t->face_count);
    for (uint32_t f = 0; f < t->face_count; f++) {
        must(tl_halfedge_mesh_remove_face(mesh, f) == TL_OK);
    }
    times[FIGURE_COUNT] = now();
    must(mesh->half_edge_count == 0);
    const uint32_t counts[FIGURE_COUNT] = { t->vertex_count, t->face_count,     t->face_count,
                                            steps,           3 * t->face_count, t->face_count };
    for (int i = 0; i < FIGURE_COUNT; i++) {
        best[i] = fmin(best[i], (times[i + 1] - times[i]) / counts[i]);
    }
}

static void measure(uint32_t side, bool shuffled, double best[FIGURE_COUNT])
{
    torus t = make_torus(side, shuffled);
    uint32_t *vertices = numbers(t.vertex_count, shuffled);
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    for (int i = 0; i < FIGURE_COUNT; i++) {
        best[i] = 1e30;
    }
    for (uint32_t k = 0; k < REPETITIONS || k * t.face_count < MIN_FACES_A_SIZE; k++) {
        live(&mesh, &t, vertices, best);
    }
    tl_halfedge_mesh_destroy(&mesh);
    free(vertices);
    free(t.faces);
}

// A fan around one hub, added in order: the hub's degree grows with the fan, the cost of a face must not.
static double star(uint32_t spokes)
{
    tl_halfedge_mesh mesh;
    tl_halfedge_mesh_init(&mesh, NULL);
    uint32_t v;
    for (uint32_t i = 0; i <= spokes; i++) {
        must(tl_halfedge_mesh_add_vertex(&mesh, tl_vec3_make((float)i, 0.0f, 0.0f), &v) == TL_OK);
    }
    double best = 1e30;
    for (int k = 0; k < REPETITIONS; k++) {
        double start = now();
        for (uint32_t i = 1; i + 1 <= spokes; i++) {
            must(tl_halfedge_mesh_add_triangle(&mesh, 0, i, i + 1, NULL) == TL_OK);
        }
        for (uint32_t f = mesh.face_end; f-- > 0;) {
            must(tl_halfedge_mesh_remove_face(&mesh, f) == TL_OK);
        }
        best = fmin(best, (now() - start) / spokes);
    }
    tl_halfedge_mesh_destroy(&mesh);
    return best;
}

int main(int argc, char **argv)
{
    static const char *const names[FIGURE_COUNT] = { "add vertex", "add face",  "find edge",
                                                     "ring step",  "loop step", "remove face" };
    static const uint32_t sides[] = { 32, 90, 256, 512, 1000 };
    const bench_option options[] = { { NULL, BENCH_COUNT, NULL, NULL } };
    const char *json = NULL;
    bench_parse(argc, argv, options, NULL, &json);
    bench_report *report = bench_report_new("Half-edge mesh", "ns", "vertices");
    double worst[FIGURE_COUNT] = { 0.0 };
    for (int shuffled = 0; shuffled < 2; shuffled++) {
        const char *chart = shuffled ? "random order" : "in order";
        printf("%-14s", chart);
        for (int i = 0; i < FIGURE_COUNT; i++) {
            printf(" %11s", names[i]);
        }
        printf("   ns\n");
        for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
            double best[FIGURE_COUNT];
            measure(sides[s], shuffled != 0, best);
            printf("%14u", sides[s] * sides[s]);
            for (int i = 0; i < FIGURE_COUNT; i++) {
                printf(" %11.1f", best[i]);
                bench_report_point(report, chart, names[i], sides[s] * sides[s], best[i]);
                worst[i] = shuffled ? worst[i] : fmax(worst[i], best[i]);
            }
            printf("\n");
        }
    }
    printf("%-14s %11s\n", "hub of degree", "add, remove");
    for (uint32_t spokes = 1000; spokes <= 1000000; spokes *= 10) {
        double time = star(spokes);
        printf("%14u %11.1f\n", spokes, time);
        bench_report_point(report, "hub", "add and remove face", spokes, time);
    }
    bench_report_at_most(report, "add face in order, any size, ns", worst[ADD_FACE], 100.0);
    bench_report_at_most(report, "remove face in order, any size, ns", worst[REMOVE_FACE], 50.0);
    bench_report_at_most(report, "ring walk in order, any size, ns a step", worst[RING_STEP], 3.0);
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
