// SPDX-License-Identifier: MIT
//
// Proves a polygon mesh right by trying everything: each corner against each edge, each polygon against each other one.
// For small meshes. It shares nothing with the build or with tl_polygon_mesh_check.

#ifndef TALUS_POLYGON_PROOF_H
#define TALUS_POLYGON_PROOF_H

#include "polygon_oracle.h"

#include <talus/polygon.h>

/// Square roots of lengths; tests only.
#include <math.h>

typedef enum proof_fault {
    PROOF_INVERTED,
    PROOF_ZERO_AREA,
    PROOF_NOT_CONVEX,
    PROOF_OVERLAP,
    PROOF_T_JUNCTION,
    PROOF_LINK,
    PROOF_AREA,
    PROOF_LOST,
    PROOF_FAULT_COUNT
} proof_fault;

static const char *const proof_fault_names[PROOF_FAULT_COUNT] = { "inverted",   "zero area", "not convex", "overlaps",
                                                                  "T-junction", "links",     "area",       "lost" };

static inline oracle_point proof_corner(const tl_polygon_mesh *mesh, uint32_t place)
{
    const int32_t *v = mesh->vertices + 3 * (size_t)mesh->indices[place];
    oracle_point p = { v[0], v[2] };
    return p;
}

static inline uint32_t proof_next(const tl_polygon_mesh *mesh, uint32_t polygon, uint32_t place)
{
    return place + 1 < mesh->first[polygon + 1] ? place + 1 : mesh->first[polygon];
}

/// Doubled area, > 0 when wound as contours are.
static inline int64_t proof_polygon_area2(const tl_polygon_mesh *mesh, uint32_t polygon)
{
    int64_t sum = 0;
    for (uint32_t k = mesh->first[polygon] + 1; k + 1 < mesh->first[polygon + 1]; k++) {
        sum -= oracle_area2(proof_corner(mesh, mesh->first[polygon]), proof_corner(mesh, k), proof_corner(mesh, k + 1));
    }
    return sum;
}

// Every corner but an edge's own two lies strictly inside of it: convex, and around only once.
static inline bool proof_is_convex(const tl_polygon_mesh *mesh, uint32_t polygon)
{
    for (uint32_t k = mesh->first[polygon]; k < mesh->first[polygon + 1]; k++) {
        uint32_t next = proof_next(mesh, polygon, k);
        for (uint32_t other = mesh->first[polygon]; other < mesh->first[polygon + 1]; other++) {
            if (other != k && other != next &&
                oracle_area2(proof_corner(mesh, k), proof_corner(mesh, next), proof_corner(mesh, other)) >= 0) {
                return false;
            }
        }
    }
    return true;
}

// Whether all of polygon b lies outside some edge of polygon a.
static inline bool proof_is_parted(const tl_polygon_mesh *mesh, uint32_t a, uint32_t b)
{
    for (uint32_t k = mesh->first[a]; k < mesh->first[a + 1]; k++) {
        oracle_point from = proof_corner(mesh, k), to = proof_corner(mesh, proof_next(mesh, a, k));
        bool parts = true;
        for (uint32_t other = mesh->first[b]; other < mesh->first[b + 1] && parts; other++) {
            parts = oracle_area2(from, to, proof_corner(mesh, other)) >= 0;
        }
        if (parts) {
            return true;
        }
    }
    return false;
}

// What lies across an edge: TL_NO_POLYGON - 1 when several claim it.
static inline uint32_t proof_across(const tl_polygon_mesh *mesh, uint32_t polygon, uint32_t place)
{
    uint32_t from = mesh->indices[place], to = mesh->indices[proof_next(mesh, polygon, place)];
    uint32_t found = TL_NO_POLYGON;
    for (uint32_t other = 0; other < mesh->polygon_count; other++) {
        for (uint32_t k = mesh->first[other]; k < mesh->first[other + 1]; k++) {
            uint32_t other_from = mesh->indices[k], other_to = mesh->indices[proof_next(mesh, other, k)];
            if (other_from == to && other_to == from) {
                found = found == TL_NO_POLYGON ? other : TL_NO_POLYGON - 1;
            } else if (other_from == from && other_to == to && other != polygon) {
                return TL_NO_POLYGON - 1;
            }
        }
    }
    return found;
}

/// Counts the faults of a mesh whose contours lie side by side on one floor, without portals. O(corners^2).
static inline void proof_count_faults(const tl_polygon_mesh *mesh, uint64_t counts[PROOF_FAULT_COUNT])
{
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        int64_t area2 = proof_polygon_area2(mesh, p);
        counts[PROOF_INVERTED] += area2 < 0;
        counts[PROOF_ZERO_AREA] += area2 == 0;
        counts[PROOF_NOT_CONVEX] += area2 > 0 && !proof_is_convex(mesh, p);
        for (uint32_t other = 0; other < p; other++) {
            counts[PROOF_OVERLAP] += !proof_is_parted(mesh, p, other) && !proof_is_parted(mesh, other, p);
        }
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            oracle_point from = proof_corner(mesh, k), to = proof_corner(mesh, proof_next(mesh, p, k));
            for (uint32_t v = 0; v < mesh->vertex_count; v++) {
                oracle_point at = { mesh->vertices[3 * (size_t)v], mesh->vertices[3 * (size_t)v + 2] };
                counts[PROOF_T_JUNCTION] +=
                    !oracle_same(at, from) && !oracle_same(at, to) && oracle_between(from, to, at);
            }
            counts[PROOF_LINK] += mesh->neighbours[k] != proof_across(mesh, p, k);
        }
    }
}

/// How the edges of a closed outline meet, beside at the corners between them.
typedef enum proof_contact { PROOF_SIMPLE, PROOF_TOUCHING, PROOF_CROSSING } proof_contact;

static inline proof_contact proof_find_contact(const oracle_point *p, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        oracle_point a = p[i], b = p[(i + 1) % n];
        for (uint32_t j = i + 1; j < n; j++) {
            oracle_point c = p[j], d = p[(j + 1) % n];
            if (oracle_sign(oracle_area2(a, b, c)) * oracle_sign(oracle_area2(a, b, d)) < 0 &&
                oracle_sign(oracle_area2(c, d, a)) * oracle_sign(oracle_area2(c, d, b)) < 0) {
                return PROOF_CROSSING;
            }
        }
    }
    return oracle_is_simple(p, n) ? PROOF_SIMPLE : PROOF_TOUCHING;
}

static inline int proof_by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// An edge over a slab: where it is in the middle, and what crossing it upward adds to the winding number.
typedef struct proof_edge {
    double z;
    int winding;
} proof_edge;

static inline int proof_by_height(const void *a, const void *b)
{
    const proof_edge *x = a, *y = b;
    return (x->z > y->z) - (x->z < y->z);
}

/// The doubled area of what a closed outline winds around at least once: slab by slab between the x of corners and
/// crossings. In doubles: exact when rounded to a whole number, for coordinates below 2^15 and no crossings.
static inline double proof_floor_area2(const oracle_point *p, uint32_t n)
{
    enum { MAX_EDGES = 512 };
    static double slabs[MAX_EDGES * (MAX_EDGES + 1) / 2];
    static proof_edge edges[MAX_EDGES];
    uint32_t slab_count = 0;
    TEST_CHECK(n <= MAX_EDGES);
    for (uint32_t i = 0; i < n; i++) {
        oracle_point a = p[i], b = p[(i + 1) % n];
        slabs[slab_count++] = (double)a.x;
        for (uint32_t j = i + 1; j < n; j++) {
            oracle_point c = p[j], d = p[(j + 1) % n];
            double a_side = (double)oracle_area2(c, d, a), b_side = (double)oracle_area2(c, d, b);
            if (a_side * b_side < 0 && oracle_sign(oracle_area2(a, b, c)) * oracle_sign(oracle_area2(a, b, d)) < 0) {
                slabs[slab_count++] = (double)a.x + (double)(b.x - a.x) * (a_side / (a_side - b_side));
            }
        }
    }
    qsort(slabs, slab_count, sizeof *slabs, proof_by_size);
    double area2 = 0.0;
    for (uint32_t s = 0; s + 1 < slab_count; s++) {
        double middle = 0.5 * (slabs[s] + slabs[s + 1]), width = slabs[s + 1] - slabs[s];
        uint32_t count = 0;
        for (uint32_t i = 0; i < n && width > 0.0; i++) {
            oracle_point a = p[i], b = p[(i + 1) % n];
            double low = (double)(a.x < b.x ? a.x : b.x), high = (double)(a.x < b.x ? b.x : a.x);
            if (low < middle && middle < high) {
                edges[count].z = (double)a.z + (double)(b.z - a.z) * ((middle - (double)a.x) / (double)(b.x - a.x));
                edges[count++].winding = b.x < a.x ? 1 : -1;
            }
        }
        qsort(edges, count, sizeof *edges, proof_by_height);
        int winding = 0;
        for (uint32_t e = 0; e + 1 < count; e++) {
            winding += edges[e].winding;
            area2 += winding >= 1 ? 2.0 * width * (edges[e + 1].z - edges[e].z) : 0.0;
        }
    }
    return area2;
}

static inline double proof_perimeter(const oracle_point *p, uint32_t n)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < n; i++) {
        double dx = (double)(p[(i + 1) % n].x - p[i].x), dz = (double)(p[(i + 1) % n].z - p[i].z);
        sum += sqrt(dx * dx + dz * dz);
    }
    return sum;
}

#endif
