// SPDX-License-Identifier: MIT
//
// One operation on one hostile input of a size: what tools/check-growth counts the instructions of.
//
//   growth OPERATION FAMILY SIZE        prints the result's name
//
// Only growth_measured is counted: making the input, and what the operation needs, is not.

#include "nav_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct level {
    tl_vec3 *vertices;
    uint32_t *indices;
    uint32_t vertex_count, triangle_count;
    tl_contour_vertex *outline;
    uint32_t outline_count;
} level;

static uint64_t state = 88172645463325252u;

static float random_between(float low, float high)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return low + (high - low) * ((float)(state >> 40) * 0x1p-24f);
}

static uint32_t add_vertex(level *l, float x, float y, float z)
{
    l->vertices[l->vertex_count] = tl_vec3_make(x, y, z);
    return l->vertex_count++;
}

static void add_triangle(level *l, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t *to = l->indices + 3 * (size_t)l->triangle_count++;
    to[0] = a;
    to[1] = b;
    to[2] = c;
}

static void add_floor(level *l, float x, float y, float z, float width, float depth)
{
    const uint32_t a = add_vertex(l, x, y, z);
    (void)add_vertex(l, x, y, z + depth);
    (void)add_vertex(l, x + width, y, z + depth);
    (void)add_vertex(l, x + width, y, z);
    add_triangle(l, a, a + 1, a + 2);
    add_triangle(l, a, a + 2, a + 3);
}

// ---------------------------------------------------------------------------------------------------------
// Families. Each fits a box of 20 m, so that a navmesh of it has the same columns at every size.

static void make_fan(level *l, uint32_t n, float height)
{
    const uint32_t hub = add_vertex(l, 10, height, 10);
    for (uint32_t i = 0; i <= n; i++) {
        const float turn = 6.2831853f * (float)i / (float)n;
        (void)add_vertex(l, 10 + 9 * cosf(turn), height > 0 ? random_between(0, 1) : 0, 10 + 9 * sinf(turn));
    }
    for (uint32_t i = 1; i <= n; i++) {
        add_triangle(l, hub, i + 1, i);
    }
}

static bool make_mesh(level *l, const char *family, uint32_t n)
{
    if (strcmp(family, "fan") == 0) {
        make_fan(l, n, 0);
    } else if (strcmp(family, "cone") == 0) {
        make_fan(l, n, 5);
    } else if (strcmp(family, "stack") == 0) {
        for (uint32_t i = 0; i < n / 2; i++) {
            add_floor(l, 5, 20.0f * (float)i / (float)n, 5, 2, 2);
        }
    } else if (strcmp(family, "same") == 0) {
        for (uint32_t i = 0; i < n / 2; i++) {
            add_floor(l, 5, 1, 5, 2, 2);
        }
    } else if (strcmp(family, "comb") == 0) {
        for (uint32_t i = 0; i < n / 2; i++) {
            add_floor(l, 20.0f * (float)i / (float)n * 2, 0, 0, 10.0f / (float)n, 20);
        }
    } else if (strcmp(family, "tangle") == 0) {
        for (uint32_t i = 0; i < 3 * n; i++) {
            (void)add_vertex(l, random_between(0, 20), random_between(0, 20), random_between(0, 20));
        }
        for (uint32_t i = 0; i < n; i++) {
            add_triangle(l, 3 * i, 3 * i + 1, 3 * i + 2);
        }
    } else if (strcmp(family, "chain") == 0) {
        for (uint32_t i = 0; i < n; i++) {
            const float size = ldexpf(1.0f + (float)(i / 100) * 0.001f, 3 - (int)(i % 100));
            const uint32_t a = add_vertex(l, size, 0, 0);
            (void)add_vertex(l, size * 1.5f, 0, 0);
            (void)add_vertex(l, size, size, size * 0.5f);
            add_triangle(l, a, a + 1, a + 2);
        }
    } else {
        return false;
    }
    return true;
}

static void add_corner(level *l, float x, float z)
{
    l->outline[l->outline_count++] = (tl_contour_vertex){ (int32_t)x, 0, (int32_t)z, 0 };
}

// Outer contours turn right.
static void turn_outline_right(level *l)
{
    double area = 0.0;
    for (uint32_t i = 0; i < l->outline_count; i++) {
        const tl_contour_vertex a = l->outline[i], b = l->outline[i + 1 < l->outline_count ? i + 1 : 0];
        area += (double)a.x * (double)b.z - (double)b.x * (double)a.z;
    }
    for (uint32_t i = 0, k = l->outline_count; area > 0.0 && i < k--; i++) {
        const tl_contour_vertex swapped = l->outline[i];
        l->outline[i] = l->outline[k];
        l->outline[k] = swapped;
    }
}

static bool make_outline(level *l, const char *family, uint32_t n)
{
    if (strcmp(family, "teeth") == 0) {
        for (uint32_t i = 0; i < n / 2; i++) {
            add_corner(l, 4.0f * (float)i, 0);
            add_corner(l, 4.0f * (float)i + 1, 4000);
        }
        add_corner(l, 2.0f * (float)n, 5000);
        add_corner(l, 0, 5000);
    } else if (strcmp(family, "star") == 0) {
        for (uint32_t i = 0; i < n; i++) {
            const float turn = -6.2831853f * (float)i / (float)n, radius = i % 2 == 0 ? 500000.0f : 300000.0f;
            add_corner(l, radius * cosf(turn), radius * sinf(turn));
        }
    } else if (strcmp(family, "round") == 0 || strcmp(family, "fringed") == 0) {
        // One convex polygon of as many corners, alone or with a small one on each edge.
        for (uint32_t i = 0; i < n; i++) {
            const bool is_out = i % 2 == 1 && strcmp(family, "fringed") == 0;
            const double turn = -6.283185307179586 * (double)i / (double)n, radius = is_out ? 4.0001e8 : 4e8;
            const tl_contour_vertex corner = { (int32_t)lround(radius * cos(turn)), 0,
                                               (int32_t)lround(radius * sin(turn)), 0 };
            l->outline[l->outline_count++] = corner;
        }
    } else if (strcmp(family, "spikes") == 0) {
        for (uint32_t i = 0; i < n; i++) {
            const float turn = -6.2831853f * (float)i / (float)n, radius = random_between(1e7f, 1e8f);
            add_corner(l, radius * cosf(turn), radius * sinf(turn));
        }
    } else if (strcmp(family, "spiral") == 0) {
        for (uint32_t i = 0; i < n / 2; i++) {
            const float turn = -40.0f * (float)i / (float)n, radius = 1000 + 900000.0f * (float)i / (float)n;
            add_corner(l, radius * cosf(turn), radius * sinf(turn));
        }
        for (uint32_t i = n / 2; i-- > 0;) {
            const float turn = -40.0f * (float)i / (float)n, radius = 40000 + 900000.0f * (float)i / (float)n;
            add_corner(l, radius * cosf(turn), radius * sinf(turn));
        }
    } else if (strcmp(family, "frayed") == 0) {
        // A comb, with long teeth that end anywhere in many small ones: nothing near in number is on the sweep's line.
        enum { FRAYS = 20, CORNERS = FRAYS + 2 };
        const float width = 2 * FRAYS + 10;
        for (uint32_t i = 0; i < n / CORNERS; i++) {
            const float z = width * (float)i, x = random_between(10, 1e6f);
            add_corner(l, 2e6f, z);
            for (uint32_t k = 0; k < FRAYS; k++) {
                add_corner(l, k % 2 == 0 ? x : x - 3, z + 2.0f * (float)k);
            }
            add_corner(l, 2e6f, z + 2.0f * (float)FRAYS);
        }
        add_corner(l, 3e6f, width * (float)(n / CORNERS));
        add_corner(l, 3e6f, -10);
    } else {
        return false;
    }
    turn_outline_right(l);
    return true;
}

// ---------------------------------------------------------------------------------------------------------
// Operations.

typedef struct work {
    const char *operation;
    level l;
    tl_mesh_view view;
    tl_soup *soup;
    tl_navmesh *navmesh;
    tl_nav_tile *tile;
    tl_nav_query *query;
    tl_polygon_mesh polygons;
    uint32_t n;
    tl_result result;
} work;

#if defined(__GNUC__)
#define ALONE __attribute__((noinline))
#else
#define ALONE
#endif

static tl_result bake_soup_of(work *w)
{
    tl_soup_def def = tl_default_soup_def();
    def.layout = strcmp(w->operation, "soup-compact") == 0 ? TL_SOUP_COMPACT : TL_SOUP_FAST;
    def.partition = strcmp(w->operation, "soup-kd") == 0 ? TL_SOUP_KD_TREE : TL_SOUP_BVH;
    def.split_budget = strcmp(w->operation, "soup-split") == 0 ? 0.3f : 0.0f;
    return tl_soup_bake(&w->view, &def, &w->soup, NULL);
}

static tl_result bake_nav_of(const work *w)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.3f;
    const tl_nav_input input = { .mesh = w->view };
    tl_nav_tiles tiles;
    tl_result result = tl_nav_bake(&def, &input, &tiles, NULL);
    tl_nav_tiles_free(&tiles);
    return result;
}

static tl_result bake_polygons_of(work *w)
{
    tl_contour contour = { .vertex_count = w->l.outline_count, .region = 1, .area = 1 };
    const tl_contour_set set = { .vertices = w->l.outline,
                                 .vertex_count = w->l.outline_count,
                                 .contours = &contour,
                                 .contour_count = 1,
                                 .cell_size = 1.0f,
                                 .cell_height = 1.0f };
    tl_polygon_def def = tl_default_polygon_def();
    def.max_verts_per_poly = strcmp(w->operation, "polygon-check") == 0 ? 0 : def.max_verts_per_poly;
    return tl_polygon_mesh_bake(&set, &def, &w->polygons, NULL);
}

// Strips beside one polygon as long as all of them: which of the two comes last is added.
static bool make_hub(work *w, const char *family, uint32_t n)
{
    const bool hub_comes_last = strcmp(family, "hub-last") == 0;
    if ((!hub_comes_last && strcmp(family, "hub-first") != 0) || tl_navmesh_create(NULL, &w->navmesh) != TL_OK) {
        return false;
    }
    tl_nav_tile *there = nav_row_tile(hub_comes_last ? n : 1, n, 0);
    w->tile = nav_row_tile(hub_comes_last ? 1 : n, n, 1);
    return there != NULL && w->tile != NULL && tl_navmesh_add_tile(w->navmesh, there, TL_NAV_TILE_OWNED) == TL_OK;
}

// A place for an agent wider than all of them.
static bool make_wide(work *w, const char *family, uint32_t n)
{
    return make_hub(w, family, n) && tl_navmesh_add_tile(w->navmesh, w->tile, TL_NAV_TILE_OWNED) == TL_OK &&
           tl_nav_query_create(NULL, &w->query, NULL) == TL_OK;
}

static tl_result find_wide_place(work *w)
{
    const float size = (float)w->n;
    const tl_vec3 middle = { size, 0.0f, 0.5f * size }, half = { size, 1.0f, size };
    tl_nav_around_request around = { .radius = 4.0f * size };
    const tl_result result = tl_navmesh_find_nearest(w->navmesh, NULL, middle, half, &around.center);
    tl_nav_location place;
    return result != TL_OK ? result : tl_nav_query_find_wide_place(w->query, w->navmesh, &around, 8.0f * size, &place);
}

void growth_measured(work *w);

ALONE void growth_measured(work *w)
{
    if (strncmp(w->operation, "soup", 4) == 0 && strcmp(w->operation, "soup-check") != 0) {
        w->result = bake_soup_of(w);
    } else if (strcmp(w->operation, "soup-check") == 0) {
        w->result = tl_soup_check(w->soup, tl_soup_size(w->soup), NULL);
    } else if (strcmp(w->operation, "mesh") == 0) {
        tl_mesh mesh;
        w->result = tl_mesh_bake(&w->view, NULL, &mesh, NULL);
        tl_mesh_free(&mesh);
    } else if (strcmp(w->operation, "weld") == 0) {
        tl_mesh_def def = tl_default_mesh_def();
        def.weld_tolerance = 0.001f;
        tl_mesh mesh;
        w->result = tl_mesh_bake(&w->view, &def, &mesh, NULL);
        tl_mesh_free(&mesh);
    } else if (strcmp(w->operation, "adjacency") == 0) {
        tl_adjacency adjacency;
        w->result = tl_adjacency_bake(&w->view, NULL, &adjacency, NULL);
        tl_adjacency_free(&adjacency);
    } else if (strcmp(w->operation, "hull") == 0) {
        tl_hull *hull = NULL;
        w->result = tl_hull_bake(w->view.vertices, w->view.vertex_count, NULL, &hull, NULL);
        tl_blob_free(hull);
    } else if (strcmp(w->operation, "hull-tolerance") == 0) {
        tl_hull_def def = tl_default_hull_def();
        def.tolerance = 1e-3f;
        tl_hull *hull = NULL;
        tl_hull_report report;
        w->result = tl_hull_bake(w->view.vertices, w->view.vertex_count, &def, &hull, &report);
        tl_blob_free(hull);
    } else if (strcmp(w->operation, "nav") == 0) {
        w->result = bake_nav_of(w);
    } else if (strcmp(w->operation, "polygons") == 0) {
        w->result = bake_polygons_of(w);
    } else if (strcmp(w->operation, "polygon-check") == 0) {
        w->result = tl_polygon_mesh_check(&w->polygons, NULL, NULL, NULL);
    } else if (strcmp(w->operation, "add-tile") == 0) {
        w->result = tl_navmesh_add_tile(w->navmesh, w->tile, TL_NAV_TILE_OWNED);
    } else if (strcmp(w->operation, "wide-place") == 0) {
        w->result = find_wide_place(w);
    } else {
        w->result = TL_ERR_UNSUPPORTED;
    }
}

static bool make_input(work *w, const char *family, uint32_t n)
{
    return strcmp(w->operation, "add-tile") == 0      ? make_hub(w, family, n)
           : strcmp(w->operation, "wide-place") == 0  ? make_wide(w, family, n)
           : strncmp(w->operation, "polygon", 7) == 0 ? make_outline(&w->l, family, n)
                                                      : make_mesh(&w->l, family, n);
}

int main(int count, char **arguments)
{
    const uint32_t n = count == 4 ? (uint32_t)strtoul(arguments[3], NULL, 10) : 0;
    if (n < 8) {
        fprintf(stderr, "growth OPERATION FAMILY SIZE\n");
        return 2;
    }
    work w = { .operation = arguments[1], .n = n };
    w.l.vertices = malloc((4 * (size_t)n + 16) * sizeof *w.l.vertices);
    w.l.indices = malloc((4 * (size_t)n + 16) * 3 * sizeof *w.l.indices);
    w.l.outline = malloc((2 * (size_t)n + 16) * sizeof *w.l.outline);
    if (w.l.vertices == NULL || w.l.indices == NULL || w.l.outline == NULL || !make_input(&w, arguments[2], n)) {
        fprintf(stderr, "no such family\n");
        return 2;
    }
    w.view = (tl_mesh_view){ w.l.vertices, w.l.vertex_count, w.l.indices, w.l.triangle_count, NULL };
    if (strcmp(w.operation, "soup-check") == 0 && bake_soup_of(&w) != TL_OK) {
        return 1;
    }
    if (strcmp(w.operation, "polygon-check") == 0 && bake_polygons_of(&w) != TL_OK) {
        return 1;
    }
    growth_measured(&w);
    printf("%s%s\n", tl_result_name(w.result), w.polygons.note_count > 0 ? ", not divided as given" : "");
    tl_blob_free(w.soup);
    tl_polygon_mesh_free(&w.polygons);
    tl_nav_query_destroy(w.query);
    tl_navmesh_destroy(w.navmesh);
    free(w.l.vertices);
    free(w.l.indices);
    free(w.l.outline);
    return 0;
}
