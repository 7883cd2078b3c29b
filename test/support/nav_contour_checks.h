// SPDX-License-Identifier: MIT
//
// What must hold of traced and simplified contours.

#ifndef TALUS_NAV_CONTOUR_CHECKS_H
#define TALUS_NAV_CONTOUR_CHECKS_H

#include "nav_bake/contours/contours.h"
#include "nav_region_checks.h"

/// Doubled area, > 0 for an outer outline.
static inline int64_t contour_area2(const tl_contour_set *set, uint32_t contour)
{
    const tl_contour *c = &set->contours[contour];
    const tl_contour_vertex *v = set->vertices + c->first_vertex;
    int64_t area2 = 0;
    for (uint32_t k = 0, j = c->vertex_count - 1; k < c->vertex_count; j = k++) {
        area2 += (int64_t)v[k].x * v[j].z - (int64_t)v[j].x * v[k].z;
    }
    return area2;
}

/// Builds distance field, regions and contours of a compact heightfield.
static inline void make_contours(tl_nav_compact *compact, const tl_nav_config *config, tl_nav_contours *contours)
{
    TEST_RESULT(tl_nav_distance_field(NULL, compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_regions(config, NULL, compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_contours(config, compact, NULL, contours, NULL), TL_OK);
}

/// Traces the contours of a compact heightfield, all in `arena`, which is fresh.
static inline void trace_contours(tl_nav_compact *compact, const tl_nav_config *config, tl_arena *arena,
                                  tl_contour_work *work)
{
    TEST_RESULT(tl_nav_distance_field(NULL, compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_regions(config, NULL, compact, NULL), TL_OK);
    tl_arena_init(arena, NULL);
    memset(work, 0, sizeof *work);
    work->config = config;
    work->compact = compact;
    work->arena = arena;
    TEST_RESULT(tl_contours_trace(work), TL_OK);
}

static inline int64_t contour_orient(const tl_contour_vertex *a, const tl_contour_vertex *b, const tl_contour_vertex *c)
{
    return ((int64_t)b->x - a->x) * ((int64_t)c->z - a->z) - ((int64_t)c->x - a->x) * ((int64_t)b->z - a->z);
}

static inline bool contour_strictly_between(const tl_contour_vertex *p, const tl_contour_vertex *a,
                                            const tl_contour_vertex *b)
{
    int64_t dx = b->x - a->x, dz = b->z - a->z, t = (p->x - a->x) * dx + (p->z - a->z) * dz;
    return contour_orient(a, b, p) == 0 && t > 0 && t < dx * dx + dz * dz;
}

/// Two edges cross in their insides, or an end of one lies inside the other.
static inline bool contour_edges_conflict(const tl_contour_vertex *a, const tl_contour_vertex *b,
                                          const tl_contour_vertex *c, const tl_contour_vertex *d)
{
    int64_t o1 = contour_orient(a, b, c), o2 = contour_orient(a, b, d), o3 = contour_orient(c, d, a),
            o4 = contour_orient(c, d, b);
    bool crossing = ((o1 > 0 && o2 < 0) || (o1 < 0 && o2 > 0)) && ((o3 > 0 && o4 < 0) || (o3 < 0 && o4 > 0));
    return crossing || contour_strictly_between(c, a, b) || contour_strictly_between(d, a, b) ||
           contour_strictly_between(a, c, d) || contour_strictly_between(b, c, d);
}

/// No two edges of one contour conflict. Bridges run there and back, which is no conflict.
static inline void check_no_crossing(const tl_contour_set *set, uint32_t contour)
{
    const tl_contour *c = &set->contours[contour];
    const tl_contour_vertex *v = set->vertices + c->first_vertex;
    for (uint32_t k = 0; k < c->vertex_count; k++) {
        for (uint32_t j = 0; j < k; j++) {
            TEST_CHECK(
                !contour_edges_conflict(&v[k], &v[(k + 1) % c->vertex_count], &v[j], &v[(j + 1) % c->vertex_count]));
        }
    }
}

/// For each region: the traced outlines' areas sum up to its columns.
static inline void check_raw_areas(const tl_nav_compact *compact, const tl_nav_contours *contours)
{
    int64_t *columns = calloc(compact->region_count + 1, sizeof *columns);
    int64_t *area2 = calloc(compact->region_count + 1, sizeof *area2);
    for (uint32_t i = 0; i < compact->span_count; i++) {
        uint32_t r = compact->region[i];
        columns[(r & TL_NAV_BORDER_REGION) != 0 ? 0 : r]++;
    }
    for (uint32_t c = 0; c < contours->raw.contour_count; c++) {
        const tl_contour *raw = &contours->raw.contours[c];
        TEST_CHECK(raw->region != 0 && raw->region < compact->region_count && raw->vertex_count >= 2);
        int64_t a = contour_area2(&contours->raw, c);
        area2[raw->region] += a;
        if (c < contours->set.contour_count) {
            TEST_CHECK(a > 0 && raw->region == contours->set.contours[c].region);
            TEST_CHECK(raw->area == contours->set.contours[c].area);
        } else if (c < contours->set.contour_count + contours->hole_count) {
            TEST_CHECK(a < 0);
        } else {
            TEST_CHECK(a == 0);
        }
        for (uint32_t k = 0; k < raw->vertex_count; k++) { // unit steps along an axis
            const tl_contour_vertex *p = &contours->raw.vertices[raw->first_vertex + k];
            const tl_contour_vertex *q = &contours->raw.vertices[raw->first_vertex + (k + 1) % raw->vertex_count];
            TEST_CHECK(abs(p->x - q->x) + abs(p->z - q->z) == 1);
        }
    }
    for (uint32_t r = 1; r < compact->region_count; r++) {
        TEST_CHECK(area2[r] == 2 * columns[r]);
    }
    free(columns);
    free(area2);
}

#endif
