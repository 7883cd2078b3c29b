// SPDX-License-Identifier: MIT
//
// Convex polygon generation in its plain form, O(n^3), as the text describes it: every corner tested against every edge
// before each cut, every pair of polygons before each merge. The oracle of the fast form. It shares no function with
// it.

#ifndef TALUS_POLYGON_ORACLE_H
#define TALUS_POLYGON_ORACLE_H

#include "talus_test.h"

#include <string.h>

typedef struct oracle_point {
    int64_t x, z;
} oracle_point;

static inline int64_t oracle_area2(oracle_point a, oracle_point b, oracle_point c)
{
    return (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
}

static inline bool oracle_same(oracle_point a, oracle_point b)
{
    return a.x == b.x && a.z == b.z;
}

static inline int oracle_sign(int64_t value)
{
    return (value > 0) - (value < 0);
}

static inline bool oracle_between(oracle_point a, oracle_point b, oracle_point c)
{
    if (oracle_area2(a, b, c) != 0) {
        return false;
    }
    if (a.x != b.x) {
        return (a.x <= c.x && c.x <= b.x) || (a.x >= c.x && c.x >= b.x);
    }
    return (a.z <= c.z && c.z <= b.z) || (a.z >= c.z && c.z >= b.z);
}

/// Whether two closed segments share a point.
static inline bool oracle_segments_meet(oracle_point a, oracle_point b, oracle_point c, oracle_point d)
{
    int abc = oracle_sign(oracle_area2(a, b, c)), abd = oracle_sign(oracle_area2(a, b, d));
    int cda = oracle_sign(oracle_area2(c, d, a)), cdb = oracle_sign(oracle_area2(c, d, b));
    if (abc * abd < 0 && cda * cdb < 0) {
        return true;
    }
    return oracle_between(a, b, c) || oracle_between(a, b, d) || oracle_between(c, d, a) || oracle_between(c, d, b);
}

/// Whether no two edges share a point, but neighbours their corner.
static inline bool oracle_is_simple(const oracle_point *p, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        oracle_point a = p[i], b = p[(i + 1) % n], c = p[(i + 2) % n];
        if (oracle_same(a, b) || oracle_between(a, b, c) || oracle_between(b, c, a)) {
            return false;
        }
        for (uint32_t j = i + 2; j < n; j++) {
            if ((j + 1) % n != i && oracle_segments_meet(a, b, p[j], p[(j + 1) % n])) {
                return false;
            }
        }
    }
    return true;
}

static inline int64_t oracle_contour_area2(const oracle_point *p, uint32_t n)
{
    int64_t sum = 0;
    for (uint32_t i = 0; i < n; i++) {
        sum += p[(i + 1) % n].x * p[i].z - p[i].x * p[(i + 1) % n].z;
    }
    return sum;
}

// Whether `target` lies strictly inside the interior angle of corner i of the outline `left`.
static inline bool oracle_in_angle(const oracle_point *p, const uint32_t *left, uint32_t n, uint32_t i,
                                   oracle_point target)
{
    oracle_point before = p[left[(i + n - 1) % n]], corner = p[left[i]], after = p[left[(i + 1) % n]];
    // In this orientation "left of" means area2 < 0.
    if (oracle_area2(before, corner, after) <= 0) {
        return oracle_area2(corner, target, before) < 0 && oracle_area2(target, corner, after) < 0;
    }
    return !(oracle_area2(corner, target, after) <= 0 && oracle_area2(target, corner, before) <= 0);
}

static inline bool oracle_is_valid_cut(const oracle_point *p, const uint32_t *left, uint32_t n, uint32_t i)
{
    uint32_t k = (i + 2) % n;
    oracle_point a = p[left[i]], b = p[left[(i + 1) % n]], c = p[left[k]];
    if (oracle_area2(a, b, c) >= 0 || !oracle_in_angle(p, left, n, i, c) || !oracle_in_angle(p, left, n, k, a)) {
        return false;
    }
    for (uint32_t j = 0; j < n; j++) {
        oracle_point d = p[left[j]], e = p[left[(j + 1) % n]];
        if (oracle_same(a, d) || oracle_same(a, e) || oracle_same(c, d) || oracle_same(c, e)) {
            continue;
        }
        if (oracle_segments_meet(a, c, d, e)) {
            return false;
        }
    }
    return true;
}

/// Whether corners i and j of the outline `left`, not neighbours, are joined by a chord strictly inside it.
static inline bool oracle_sees(const oracle_point *p, const uint32_t *left, uint32_t n, uint32_t i, uint32_t j)
{
    oracle_point a = p[left[i]], b = p[left[j]];
    if (!oracle_in_angle(p, left, n, i, b) || !oracle_in_angle(p, left, n, j, a)) {
        return false;
    }
    for (uint32_t k = 0; k < n; k++) {
        uint32_t l = (k + 1) % n;
        if (k != i && k != j && l != i && l != j && oracle_segments_meet(a, b, p[left[k]], p[left[l]])) {
            return false;
        }
    }
    return true;
}

/// False: no valid partition was left. n >= 3; triangles: [3 * (n - 2)]
static inline bool oracle_triangulate(const oracle_point *p, uint32_t n, uint32_t *triangles)
{
    uint32_t *left = n >= 3 ? malloc(n * sizeof *left) : NULL;
    if (left == NULL) {
        return false;
    }
    for (uint32_t i = 0; i < n; i++) {
        left[i] = i;
    }
    while (n > 3) {
        uint32_t best = UINT32_MAX;
        int64_t best_length = INT64_MAX;
        for (uint32_t i = 0; i < n; i++) {
            oracle_point a = p[left[i]], c = p[left[(i + 2) % n]];
            int64_t length = (a.x - c.x) * (a.x - c.x) + (a.z - c.z) * (a.z - c.z);
            if (length < best_length && oracle_is_valid_cut(p, left, n, i)) {
                best = i;
                best_length = length;
            }
        }
        if (best == UINT32_MAX) {
            free(left);
            return false;
        }
        uint32_t middle = (best + 1) % n;
        *triangles++ = left[best];
        *triangles++ = left[middle];
        *triangles++ = left[(best + 2) % n];
        memmove(left + middle, left + middle + 1, (n - middle - 1) * sizeof *left);
        n--;
    }
    memcpy(triangles, left, 3 * sizeof *left);
    free(left);
    return true;
}

/// Polygons of up to any number of corners, in places that change as polygons merge.
typedef struct oracle_polygons {
    uint32_t count;
    uint32_t *sizes;
    uint32_t **corners;
} oracle_polygons;

static inline void oracle_polygons_free(oracle_polygons *polygons, uint32_t allocated)
{
    for (uint32_t i = 0; i < allocated; i++) {
        free(polygons->corners[i]);
    }
    free(polygons->corners);
    free(polygons->sizes);
}

static inline int64_t oracle_merge_value(const oracle_point *p, const oracle_polygons *polygons, uint32_t a, uint32_t b,
                                         uint32_t max_corners, uint32_t *edge_a, uint32_t *edge_b)
{
    uint32_t na = polygons->sizes[a], nb = polygons->sizes[b];
    const uint32_t *pa = polygons->corners[a], *pb = polygons->corners[b];
    if (max_corners != 0 && na + nb - 2 > max_corners) {
        return -1;
    }
    *edge_a = *edge_b = UINT32_MAX;
    for (uint32_t i = 0; i < na; i++) {
        for (uint32_t j = 0; j < nb; j++) {
            if (pa[i] == pb[(j + 1) % nb] && pa[(i + 1) % na] == pb[j]) {
                *edge_a = i;
                *edge_b = j;
            }
        }
    }
    if (*edge_a == UINT32_MAX) {
        return -1;
    }
    uint32_t i = *edge_a, j = *edge_b;
    if (oracle_area2(p[pa[(i + na - 1) % na]], p[pa[i]], p[pb[(j + 2) % nb]]) >= 0 ||
        oracle_area2(p[pb[(j + nb - 1) % nb]], p[pb[j]], p[pa[(i + 2) % na]]) >= 0) {
        return -1;
    }
    oracle_point u = p[pa[i]], v = p[pa[(i + 1) % na]];
    return (u.x - v.x) * (u.x - v.x) + (u.z - v.z) * (u.z - v.z);
}

/// Merges triangles (corners are numbers of points; equal numbers make shared edges) in the plain way.
static inline oracle_polygons oracle_merge(const oracle_point *p, const uint32_t *triangles, uint32_t count,
                                           uint32_t max_corners)
{
    oracle_polygons r = { count, malloc(count * sizeof *r.sizes), malloc(count * sizeof *r.corners) };
    for (uint32_t t = 0; t < count; t++) {
        r.sizes[t] = 3;
        r.corners[t] = malloc(3 * sizeof(uint32_t));
        memcpy(r.corners[t], triangles + 3 * t, 3 * sizeof(uint32_t));
    }
    for (;;) {
        int64_t best = 0;
        uint32_t best_a = 0, best_b = 0, best_edge_a = 0, best_edge_b = 0;
        for (uint32_t a = 0; a < r.count; a++) {
            for (uint32_t b = a + 1; b < r.count; b++) {
                uint32_t edge_a = 0, edge_b = 0;
                int64_t value = oracle_merge_value(p, &r, a, b, max_corners, &edge_a, &edge_b);
                if (value > best) {
                    best = value;
                    best_a = a, best_b = b, best_edge_a = edge_a, best_edge_b = edge_b;
                }
            }
        }
        if (best == 0) {
            return r;
        }
        uint32_t na = r.sizes[best_a], nb = r.sizes[best_b], n = 0;
        uint32_t *merged = malloc((na + nb - 2) * sizeof *merged);
        for (uint32_t i = 0; i + 1 < na; i++) {
            merged[n++] = r.corners[best_a][(best_edge_a + 1 + i) % na];
        }
        for (uint32_t i = 0; i + 1 < nb; i++) {
            merged[n++] = r.corners[best_b][(best_edge_b + 1 + i) % nb];
        }
        free(r.corners[best_a]);
        r.corners[best_a] = merged;
        r.sizes[best_a] = n;
        r.count--;
        free(r.corners[best_b]);
        r.corners[best_b] = r.corners[r.count];
        r.sizes[best_b] = r.sizes[r.count];
        r.corners[r.count] = NULL;
    }
}

/// Whether two corner lists are equal up to where they begin.
static inline bool oracle_same_polygon(const uint32_t *a, const uint32_t *b, uint32_t n)
{
    for (uint32_t shift = 0; shift < n; shift++) {
        uint32_t k = 0;
        while (k < n && a[k] == b[(k + shift) % n]) {
            k++;
        }
        if (k == n) {
            return true;
        }
    }
    return false;
}

#endif
