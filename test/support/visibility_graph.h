// SPDX-License-Identifier: MIT
//
// A visibility graph as the oracle of shortest paths: all ends of walls, each pair tried by walking along the segment
// from polygon to polygon, all pairs of them by Floyd and Warshall. It shares nothing with the search but
// tl_navmesh_links.

#ifndef TALUS_TEST_VISIBILITY_GRAPH_H
#define TALUS_TEST_VISIBILITY_GRAPH_H

#include "nav_fixture.h"

#include <math.h>

// Metres within which two points are the same: the rounding of coordinates to float, and room. Set for each level.
static double same;

typedef struct graph {
    const tl_navmesh *navmesh;
    fixture_refs all;
    tl_nav_link *links; // of polygon i: [first[i], first[i + 1])
    uint32_t *to;       // index of the polygon that a link leads to
    uint32_t *first;
    uint32_t *node_polygon;
    tl_vec3 *nodes;
    uint32_t node_count;
    double *lengths; // node_count^2
    double *reached; // by polygon: where on the segment the walk came in; -1: not yet
    uint32_t *queue;
} graph;

static double plan(tl_vec3 a, tl_vec3 b)
{
    return hypot((double)b.x - (double)a.x, (double)b.z - (double)a.z);
}

static double distance_to(tl_vec3 p, tl_vec3 a, tl_vec3 b)
{
    double ex = (double)b.x - (double)a.x, ez = (double)b.z - (double)a.z;
    double px = (double)p.x - (double)a.x, pz = (double)p.z - (double)a.z;
    double t = (px * ex + pz * ez) / (ex * ex + ez * ez);
    t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
    return hypot(px - t * ex, pz - t * ez);
}

// Where the segment from u to w meets the stretch from a to b, ends included; false when it does not.
static bool meets(tl_vec3 u, tl_vec3 w, tl_vec3 a, tl_vec3 b, double *first_out, double *last_out)
{
    double dx = (double)w.x - (double)u.x, dz = (double)w.z - (double)u.z, length = hypot(dx, dz);
    bool at_u = distance_to(u, a, b) <= same, at_w = distance_to(w, a, b) <= same;
    *first_out = at_u ? 0.0 : length;
    *last_out = at_w ? length : 0.0;
    if (at_u || at_w || length == 0.0) {
        return at_u || at_w;
    }
    double ends[2][2] = { { (double)a.x - (double)u.x, (double)a.z - (double)u.z },
                          { (double)b.x - (double)u.x, (double)b.z - (double)u.z } };
    double along[2], off[2];
    for (int i = 0; i < 2; i++) {
        along[i] = (ends[i][0] * dx + ends[i][1] * dz) / length;
        off[i] = (ends[i][0] * dz - ends[i][1] * dx) / length;
    }
    if (fabs(off[0]) <= same && fabs(off[1]) <= same) {
        *first_out = fmin(along[0], along[1]);
        *last_out = fmax(along[0], along[1]);
    } else if ((off[0] > same && off[1] > same) || (off[0] < -same && off[1] < -same)) {
        return false;
    } else {
        double t = off[0] / (off[0] - off[1]);
        t = t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
        *first_out = *last_out = along[0] + t * (along[1] - along[0]);
    }
    return *last_out >= -same && *first_out <= length + same;
}

// Walks from a point of a polygon straight to another point, through all polygons that touch the segment.
static bool sees(graph *g, uint32_t from, tl_vec3 u, uint32_t goal, tl_vec3 w)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < g->all.count; i++) {
        g->reached[i] = -1.0;
    }
    g->reached[from] = 0.0;
    g->queue[count++] = from;
    for (uint32_t at = 0; at < count; at++) {
        uint32_t p = g->queue[at];
        if (p == goal) {
            return true;
        }
        for (uint32_t k = g->first[p]; k < g->first[p + 1]; k++) {
            double first, last;
            if (g->reached[g->to[k]] < 0.0 && meets(u, w, g->links[k].right, g->links[k].left, &first, &last) &&
                last >= g->reached[p] - same) {
                g->reached[g->to[k]] = fmax(fmax(first, g->reached[p]), 0.0);
                g->queue[count++] = g->to[k];
            }
        }
    }
    return false;
}

static void add_node(graph *g, uint32_t polygon, tl_vec3 point)
{
    for (uint32_t i = g->node_count; i > 0 && g->node_polygon[i - 1] == polygon; i--) {
        if (plan(g->nodes[i - 1], point) == 0.0) {
            return;
        }
    }
    g->node_polygon[g->node_count] = polygon;
    g->nodes[g->node_count++] = point;
}

// The ends of what no link covers of an edge.
static void add_wall_ends(graph *g, uint32_t polygon, uint32_t edge, tl_vec3 start, tl_vec3 end)
{
    tl_vec3 at = start;
    while (plan(at, end) > 0.0) {
        // The link that begins here, or the nearest one ahead.
        const tl_nav_link *next = NULL;
        for (uint32_t k = g->first[polygon]; k < g->first[polygon + 1]; k++) {
            const tl_nav_link *link = &g->links[k];
            bool ahead = link->edge == edge && plan(start, link->left) > plan(start, at);
            next = ahead && (next == NULL || plan(start, link->right) < plan(start, next->right)) ? link : next;
        }
        if (next == NULL || plan(start, next->right) > plan(start, at)) {
            add_node(g, polygon, at);
            add_node(g, polygon, next == NULL ? end : next->right);
        }
        at = next == NULL ? end : next->left;
    }
}

static graph make_graph(const tl_navmesh *navmesh)
{
    graph g;
    memset(&g, 0, sizeof g);
    g.navmesh = navmesh;
    g.all = fixture_all_refs(navmesh);
    uint64_t links = tl_navmesh_link_count(navmesh);
    g.links = calloc((size_t)links + 1, sizeof *g.links);
    g.to = calloc((size_t)links + 1, sizeof *g.to);
    g.first = calloc(g.all.count + 1u, sizeof *g.first);
    g.reached = calloc(g.all.count, sizeof *g.reached);
    g.queue = calloc(g.all.count, sizeof *g.queue);
    uint32_t corners = 0;
    for (uint32_t i = 0; i < g.all.count; i++) {
        uint32_t count = 0, polygon = 0;
        const tl_nav_tile *tile = NULL;
        TEST_RESULT(
            tl_navmesh_links(navmesh, g.all.refs[i], g.links + g.first[i], (uint32_t)links - g.first[i], &count),
            TL_OK);
        g.first[i + 1] = g.first[i] + count;
        TEST_RESULT(tl_navmesh_resolve(navmesh, g.all.refs[i], &tile, &polygon), TL_OK);
        tl_nav_tile_corners(tile, polygon, &count);
        corners += count;
    }
    for (uint32_t k = 0; k < links; k++) {
        g.to[k] = fixture_index_of(&g.all, g.links[k].to);
    }
    g.nodes = calloc(2 * (corners + (size_t)links), sizeof *g.nodes);
    g.node_polygon = calloc(2 * (corners + (size_t)links), sizeof *g.node_polygon);
    for (uint32_t i = 0; i < g.all.count; i++) {
        uint32_t polygon = 0, count = 0;
        const tl_nav_tile *tile = NULL;
        TEST_RESULT(tl_navmesh_resolve(navmesh, g.all.refs[i], &tile, &polygon), TL_OK);
        const tl_vec3 *corner = tl_nav_tile_corners(tile, polygon, &count);
        for (uint32_t e = 0; e < count; e++) {
            add_wall_ends(&g, i, e, corner[e], corner[(e + 1) % count]);
        }
    }
    double largest = 0.0;
    for (uint32_t i = 0; i < g.node_count; i++) {
        largest = fmax(largest, fmax(fabs((double)g.nodes[i].x), fabs((double)g.nodes[i].z)));
    }
    same = fmax(2e-5, 4e-7 * largest);
    size_t n = g.node_count;
    g.lengths = malloc((n * n + 1) * sizeof *g.lengths);
    for (uint32_t a = 0; a < n; a++) {
        for (uint32_t b = 0; b < n; b++) {
            bool seen = a == b || sees(&g, g.node_polygon[a], g.nodes[a], g.node_polygon[b], g.nodes[b]);
            g.lengths[a * n + b] = seen ? plan(g.nodes[a], g.nodes[b]) : (double)INFINITY;
        }
    }
    for (uint32_t k = 0; k < n; k++) {
        for (uint32_t a = 0; a < n; a++) {
            double to_k = g.lengths[a * n + k];
            for (uint32_t b = 0; b < n && isfinite(to_k); b++) {
                double through = to_k + g.lengths[k * n + b];
                g.lengths[a * n + b] = through < g.lengths[a * n + b] ? through : g.lengths[a * n + b];
            }
        }
    }
    return g;
}

static void free_graph(graph *g)
{
    free(g->all.refs);
    free(g->links);
    free(g->to);
    free(g->first);
    free(g->reached);
    free(g->queue);
    free(g->nodes);
    free(g->node_polygon);
    free(g->lengths);
}

static inline double oracle(graph *g, const tl_nav_location *start, const tl_nav_location *goal)
{
    uint32_t s = fixture_index_of(&g->all, start->polygon), t = fixture_index_of(&g->all, goal->polygon);
    double best = sees(g, s, start->point, t, goal->point) ? plan(start->point, goal->point) : (double)INFINITY;
    double *from_goal = malloc((g->node_count + 1u) * sizeof *from_goal);
    for (uint32_t b = 0; b < g->node_count; b++) {
        bool seen = sees(g, g->node_polygon[b], g->nodes[b], t, goal->point);
        from_goal[b] = seen ? plan(g->nodes[b], goal->point) : (double)INFINITY;
    }
    for (uint32_t a = 0; a < g->node_count; a++) {
        if (!sees(g, s, start->point, g->node_polygon[a], g->nodes[a])) {
            continue;
        }
        double to_a = plan(start->point, g->nodes[a]);
        const double *row = g->lengths + (size_t)a * g->node_count;
        for (uint32_t b = 0; b < g->node_count; b++) {
            best = fmin(best, to_a + row[b] + from_goal[b]);
        }
    }
    free(from_goal);
    return best;
}

#endif
