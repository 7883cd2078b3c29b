// SPDX-License-Identifier: MIT
//
// Support queries, nanoseconds each, one thread: a scalar scan, a scan in SIMD over separate coordinates, the text's
// climb as written (its index slip mended, or it would answer nothing), and tl_hull_support without and with a hint.
//
// A figure is the best of several repetitions in CPU time; every query waits for the one before it, as in GJK. Random
// directions have nothing in common; turning ones differ by one degree.

#define _GNU_SOURCE

#include "hull/lanes.h"

#include <talus/halfedge.h>
#include <talus/hull.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { QUERIES = 4096, REPETITIONS = 15, MOST_POINTS = 65536 };

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static uint64_t random_state = 1;

static float random_unit(void)
{
    uint64_t z = (random_state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (float)((z ^ (z >> 31)) >> 40) * (1.0f / 16777216.0f);
}

static tl_vec3 random_direction(void)
{
    for (;;) {
        tl_vec3 d = tl_vec3_make(2 * random_unit() - 1, 2 * random_unit() - 1, 2 * random_unit() - 1);
        if (tl_length_sq(d) > 0.01f && tl_length_sq(d) < 1.0f) {
            return tl_normalize(d);
        }
    }
}

typedef enum cloud_kind { CLOUD_SPHERE, CLOUD_PRISM, CLOUD_CAPSULE, CLOUD_NEEDLE, CLOUD_COUNT } cloud_kind;

static const char *const cloud_names[] = { "sphere", "prism", "capsule", "needle 100:1" };

static void make_cloud(cloud_kind kind, tl_vec3 *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 d = random_direction();
        float angle = 6.2831853f * (float)(i / 2) / (float)(count / 2);
        points[i] = kind == CLOUD_PRISM     ? tl_vec3_make(cosf(angle), i % 2 ? 1.0f : -1.0f, sinf(angle))
                    : kind == CLOUD_CAPSULE ? tl_vec3_make(d.x, d.y + (d.y > 0 ? 2.0f : -2.0f), d.z)
                    : kind == CLOUD_NEEDLE  ? tl_vec3_make(d.x * 100, d.y, d.z)
                                            : d;
    }
}

// ---- what is measured

typedef struct subject {
    const tl_hull *hull;
    float *rows; // x, y, z, padded to 8
    uint32_t padded;
    tl_halfedge mesh; // for the text's climb
    uint32_t last;
} subject;

static uint32_t scalar_scan(subject *s, tl_vec3 d)
{
    const tl_vec3 *v = tl_hull_vertices(s->hull);
    uint32_t best = 0;
    float best_dot = tl_dot(d, v[0]);
    for (uint32_t i = 1; i < s->hull->vertex_count; i++) {
        float dot = tl_dot(d, v[i]);
        if (dot > best_dot) {
            best_dot = dot;
            best = i;
        }
    }
    return best;
}

// The maximum first, then where it is: no index is carried through the loop.
static uint32_t simd_scan(subject *s, tl_vec3 d)
{
    const float *x = s->rows, *y = x + s->padded, *z = y + s->padded;
    static _Alignas(64) float dots[MOST_POINTS + 8];
    tl_lanes dx = tl_lanes_all(d.x), dy = tl_lanes_all(d.y), dz = tl_lanes_all(d.z), best = tl_lanes_all(-INFINITY);
    for (uint32_t i = 0; i < s->padded; i += 4) {
        tl_lanes dot =
            tl_lanes_add(tl_lanes_add(tl_lanes_mul(dx, tl_lanes_load(x + i)), tl_lanes_mul(dy, tl_lanes_load(y + i))),
                         tl_lanes_mul(dz, tl_lanes_load(z + i)));
        tl_lanes_store(dots + i, dot);
        best = tl_lanes_max(best, dot);
    }
    tl_lanes all = tl_lanes_all(tl_lanes_largest(best));
    for (uint32_t i = 0;; i += 4) {
        uint32_t mask = tl_lanes_mask_ge(tl_lanes_load(dots + i), all);
        if (mask != 0) {
            return i + tl_lowest_bit(mask);
        }
    }
}

static uint32_t text_climb_from(const subject *s, tl_vec3 d, uint32_t best)
{
    const tl_halfedge *mesh = &s->mesh;
    float best_dot = tl_dot(d, mesh->vertices[best].position);
    for (bool end = false; !end;) {
        uint32_t start = mesh->vertices[best].edge, e = start;
        float old = best_dot;
        do {
            uint32_t other = mesh->edges[e].vertex;
            float dot = tl_dot(d, mesh->vertices[other].position);
            if (dot >= best_dot + 1e-6f) {
                best = other;
                best_dot = dot;
            }
            e = tl_halfedge_around(mesh, e);
        } while (e != start);
        end = best_dot == old;
    }
    return best;
}

static uint32_t text_climb(subject *s, tl_vec3 d)
{
    return text_climb_from(s, d, 0);
}

static uint32_t text_warm(subject *s, tl_vec3 d)
{
    return s->last = text_climb_from(s, d, s->last);
}

static uint32_t ours(subject *s, tl_vec3 d)
{
    return tl_hull_support(s->hull, d, TL_NO_VERTEX);
}

static uint32_t ours_hinted(subject *s, tl_vec3 d)
{
    return s->last = tl_hull_support(s->hull, d, s->last);
}

typedef uint32_t support_fn(subject *s, tl_vec3 d);

// Adding a zero made from the last answer makes each query wait for the one before.
static double measure(subject *s, support_fn *support, const tl_vec3 *directions)
{
    double best = 1e30;
    volatile uint32_t sink = 0;
    for (int k = 0; k < REPETITIONS; k++) {
        uint32_t answer = 0;
        s->last = 0;
        double start = now();
        for (int i = 0; i < QUERIES; i++) {
            float zero = (float)(answer >> 31);
            answer = support(s, tl_vec3_make(directions[i].x + zero, directions[i].y, directions[i].z));
        }
        double time = (now() - start) / QUERIES;
        best = time < best ? time : best;
        sink = sink + answer;
    }
    return best;
}

static uint32_t count_wrong(subject *s, support_fn *support, const tl_vec3 *directions)
{
    uint32_t wrong = 0;
    const tl_vec3 *v = tl_hull_vertices(s->hull);
    s->last = 0;
    for (int i = 0; i < QUERIES; i++) {
        tl_vec3 a = v[support(s, directions[i])], b = v[scalar_scan(s, directions[i])];
        double x = (double)directions[i].x, y = (double)directions[i].y, z = (double)directions[i].z;
        wrong +=
            x * (double)a.x + y * (double)a.y + z * (double)a.z < x * (double)b.x + y * (double)b.y + z * (double)b.z;
    }
    return wrong;
}

static bool make_subject(subject *s, cloud_kind kind, uint32_t count, tl_vec3 *points)
{
    make_cloud(kind, points, count);
    tl_hull_def def = tl_default_hull_def();
    tl_hull *hull;
    if (tl_hull_build(points, count, &def, &hull, NULL) != TL_OK) {
        return false;
    }
    memset(s, 0, sizeof *s);
    s->hull = hull;
    s->padded = (hull->vertex_count + 7) & ~7u;
    s->rows = aligned_alloc(64, (3 * (size_t)s->padded * sizeof(float) + 63) / 64 * 64);
    tl_halfedge_init(&s->mesh, NULL);
    for (uint32_t i = 0; i < s->padded; i++) {
        tl_vec3 p = tl_hull_vertices(hull)[i < hull->vertex_count ? i : hull->vertex_count - 1];
        s->rows[i] = p.x;
        s->rows[s->padded + i] = p.y;
        s->rows[2 * s->padded + i] = p.z;
    }
    uint32_t unused;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        tl_halfedge_add_vertex(&s->mesh, tl_hull_vertices(hull)[v], &unused);
    }
    // The text knows triangles only: a fan for each polygon.
    const tl_hull_half_edge *h = tl_hull_half_edges(hull);
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_faces(hull)[f];
        for (uint32_t k = 1; k + 1 < face.count; k++) {
            tl_halfedge_add_triangle(&s->mesh, h[face.first].origin, h[face.first + k].origin,
                                     h[face.first + k + 1].origin, NULL);
        }
    }
    return true;
}

int main(void)
{
    static const uint32_t counts[] = { 8, 16, 32, 64, 128, 256, 512, 1024, 4096, 16384 };
    static tl_vec3 points[MOST_POINTS], random_directions[QUERIES], turning[QUERIES];
    tl_vec3 d = random_direction();
    for (int i = 0; i < QUERIES; i++) {
        random_directions[i] = random_direction();
        tl_vec3 aside = tl_cross(d, random_direction());
        d = tl_normalize(tl_mul_add(d, tl_normalize(aside), 0.0174533f));
        turning[i] = d;
    }
    printf("support, ns a query; random directions, then directions that turn one degree a query\n");
    for (int kind = 0; kind < CLOUD_COUNT; kind++) {
        printf("\n%-12s | %8s %8s %8s %8s | %8s %8s | wrong (text, ours)\n", cloud_names[kind], "scalar", "simd",
               "text", "talus", "text", "talus");
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            subject s;
            if (!make_subject(&s, (cloud_kind)kind, counts[c], points)) {
                continue;
            }
            printf("%12u | %8.1f %8.1f %8.1f %8.1f | %8.1f %8.1f | %u, %u\n", s.hull->vertex_count,
                   measure(&s, scalar_scan, random_directions), measure(&s, simd_scan, random_directions),
                   measure(&s, text_climb, random_directions), measure(&s, ours, random_directions),
                   measure(&s, text_warm, turning), measure(&s, ours_hinted, turning),
                   count_wrong(&s, text_climb, random_directions), count_wrong(&s, ours, random_directions));
            tl_halfedge_free(&s.mesh);
            free(s.rows);
            tl_blob_free((tl_hull *)(uintptr_t)s.hull, NULL);
        }
    }
    return 0;
}
