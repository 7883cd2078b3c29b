// SPDX-License-Identifier: MIT
//
// The text's function on the editable mesh against a scan with exact comparisons: polygons and triangle fans, vertices
// within flat faces and edges, isolated and removed vertices as hints, sizes from 1e-15 to 1e15.
//
//   test_halfedge_support [QUERIES]

#include "talus_test.h"

#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/halfedge.h>
#include <talus/hull.h>

#include <string.h>

static uint64_t wanted = 300000;

typedef enum hint_kind { HINT_LIVE, HINT_LAST, HINT_ISOLATED, HINT_REMOVED, HINT_OUTSIDE, HINT_KINDS } hint_kind;

typedef struct coverage {
    uint64_t queries, wrong, ties, flat_hints, hint[HINT_KINDS];
    uint32_t meshes, sizes;
} coverage;

// What a test mesh has beside its surface.
typedef struct subject {
    tl_halfedge_mesh mesh;
    uint32_t isolated, removed; // one of each; TL_HALFEDGE_NONE: there is none
} subject;

// The farthest of the vertices that have a face, and how many are as far.
static uint32_t scan(const tl_halfedge_mesh *mesh, tl_vec3 d, uint32_t *count_out)
{
    uint32_t best = TL_HALFEDGE_NONE;
    *count_out = 0;
    for (uint32_t v = 0; v < mesh->vertex_end; v++) {
        if (!tl_halfedge_is_vertex(mesh, v) || mesh->vertices[v].edge == TL_HALFEDGE_NONE) {
            continue;
        }
        int order = best == TL_HALFEDGE_NONE
                        ? 1
                        : tl_compare_along(d, mesh->vertices[v].position, mesh->vertices[best].position);
        *count_out = order > 0 ? 1 : *count_out + (order == 0);
        best = order > 0 ? v : best;
    }
    return best;
}

// A vertex far outside that has no face, and one that was there and is no more.
static void add_strays(subject *s, tl_vec3 outside)
{
    TEST_RESULT(tl_halfedge_mesh_add_vertex(&s->mesh, outside, &s->isolated), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_add_vertex(&s->mesh, tl_scale(outside, 2.0f), &s->removed), TL_OK);
    TEST_RESULT(tl_halfedge_mesh_remove_vertex(&s->mesh, s->removed), TL_OK);
}

// A hull's surface: polygons as they are, or cut to fans of triangles. Some faces are removed and come back, so that
// the pools have been used before.
static bool make_hull_mesh(subject *s, shape_kind kind, uint32_t count, float size, test_random *random)
{
    tl_vec3 points[300];
    tl_hull *hull;
    count = shape_make(kind, random, points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(points[i], size);
    }
    if (tl_hull_bake(points, count, NULL, &hull, NULL) != TL_OK) {
        return false;
    }
    bool fans = test_random_below(random, 2) != 0;
    tl_halfedge_mesh_init(&s->mesh, NULL);
    uint32_t v, corners[300];
    for (uint32_t i = 0; i < hull->vertex_count; i++) {
        TEST_RESULT(tl_halfedge_mesh_add_vertex(&s->mesh, tl_hull_vertices(hull)[i], &v), TL_OK);
    }
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_face_at(hull, f);
        for (uint32_t k = 0; k < face.count; k++) {
            corners[k] = tl_hull_edge_origin(hull, face.first + k);
        }
        for (uint32_t k = 1; fans && k + 1 < face.count; k++) {
            uint32_t made;
            TEST_RESULT(tl_halfedge_mesh_add_triangle(&s->mesh, corners[0], corners[k], corners[k + 1], &made), TL_OK);
            if (test_random_below(random, 4) == 0) {
                TEST_RESULT(tl_halfedge_mesh_remove_face(&s->mesh, made), TL_OK);
                TEST_RESULT(tl_halfedge_mesh_add_triangle(&s->mesh, corners[0], corners[k], corners[k + 1], NULL),
                            TL_OK);
            }
        }
        if (!fans) {
            TEST_RESULT(tl_halfedge_mesh_add_face(&s->mesh, corners, face.count, NULL), TL_OK);
        }
    }
    add_strays(s, tl_scale(tl_sub(hull->bounds.max, hull->bounds.min), 2.0f));
    tl_blob_free(hull);
    return true;
}

// A cube of side^2 squares a face, each cut in two: most vertices lie within a flat face, the others on an edge. The
// coordinates are small integers times a power of two, so that flat is flat.
static void make_plateaus(subject *s, uint32_t side, float unit)
{
    uint32_t index[6][6][6], v;
    tl_halfedge_mesh_init(&s->mesh, NULL);
    for (uint32_t i = 0; i < (side + 1) * (side + 1) * (side + 1); i++) {
        uint32_t x = i % (side + 1), y = i / (side + 1) % (side + 1), z = i / ((side + 1) * (side + 1));
        bool inside = x % side != 0 && y % side != 0 && z % side != 0;
        if (!inside) {
            tl_vec3 p = tl_vec3_make((float)x * unit, (float)y * unit, (float)z * unit);
            TEST_RESULT(tl_halfedge_mesh_add_vertex(&s->mesh, p, &v), TL_OK);
            index[x][y][z] = v;
        }
    }
    for (uint32_t face = 0; face < 6; face++) {
        for (uint32_t i = 0; i < side * side; i++) {
            uint32_t corner[4], level = face % 2 ? side : 0;
            for (uint32_t k = 0; k < 4; k++) {
                // Around the square, the other way on the lower faces.
                uint32_t turn = face % 2 ? k : 3 - k;
                uint32_t a = i % side + (turn == 1 || turn == 2), b = i / side + (turn >= 2);
                corner[k] = face / 2 == 0   ? index[level][a][b]
                            : face / 2 == 1 ? index[b][level][a]
                                            : index[a][b][level];
            }
            TEST_RESULT(tl_halfedge_mesh_add_triangle(&s->mesh, corner[0], corner[1], corner[2], NULL), TL_OK);
            TEST_RESULT(tl_halfedge_mesh_add_triangle(&s->mesh, corner[0], corner[2], corner[3], NULL), TL_OK);
        }
    }
    TEST_CHECK(s->mesh.boundary_count == 0);
    add_strays(s, tl_vec3_make(9 * unit, 8 * unit, -7 * unit));
}

static tl_vec3 make_direction(const tl_halfedge_mesh *mesh, test_random *random)
{
    tl_vec3 d = test_random_direction(random);
    switch (test_random_below(random, 5)) {
    case 0: { // across an axis: edges and faces of cubes are level
        float *part[3] = { &d.x, &d.y, &d.z };
        *part[test_random_below(random, 3)] = 0.0f;
        return d;
    }
    case 1: {
        float sign = test_random_below(random, 2) ? 1.0f : -1.0f;
        uint32_t axis = test_random_below(random, 3);
        return tl_vec3_make(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0);
    }
    case 2: { // the normal of some corner's triangle
        uint32_t e = test_random_below(random, mesh->edge_end);
        if (!tl_halfedge_is_edge(mesh, e)) {
            return d;
        }
        uint32_t next = tl_halfedge_next(mesh, e);
        tl_vec3 a = mesh->vertices[tl_halfedge_origin(mesh, e)].position;
        tl_vec3 b = mesh->vertices[tl_halfedge_target(mesh, e)].position;
        tl_vec3 c = mesh->vertices[tl_halfedge_target(mesh, next)].position;
        tl_vec3 n = tl_cross(tl_normalize(tl_sub(b, a)), tl_normalize(tl_sub(c, a)));
        return tl_dot(n, n) > 0.0f ? n : d;
    }
    case 3:
        return tl_scale(d, ldexpf(1.0f, (int)test_random_below(random, 200) - 100));
    default:
        return d;
    }
}

static void query(const subject *s, test_random *random, uint64_t count, coverage *seen)
{
    const tl_halfedge_mesh *mesh = &s->mesh;
    uint32_t answer = 0;
    for (uint64_t i = 0; i < count; i++) {
        hint_kind kind = (hint_kind)test_random_below(random, HINT_KINDS);
        uint32_t live = test_random_below(random, mesh->vertex_count - 1);
        uint32_t hint = kind == HINT_LIVE       ? live
                        : kind == HINT_LAST     ? answer
                        : kind == HINT_ISOLATED ? s->isolated
                        : kind == HINT_REMOVED  ? s->removed
                                                : mesh->vertex_end + test_random_below(random, UINT32_MAX / 2);
        tl_vec3 d = make_direction(mesh, random);
        uint32_t tied, best = scan(mesh, d, &tied);
        answer = tl_halfedge_mesh_support(mesh, d, hint);
        bool right = tl_halfedge_is_vertex(mesh, answer) && mesh->vertices[answer].edge != TL_HALFEDGE_NONE &&
                     tl_compare_along(d, mesh->vertices[answer].position, mesh->vertices[best].position) == 0;
        seen->wrong += !right;
        seen->queries++;
        seen->ties += tied > 1;
        seen->flat_hints += kind == HINT_LIVE && tied > 3;
        seen->hint[kind]++;
    }
    seen->meshes++;
}

static void test_support_is_exact(void **state)
{
    (void)state;
    static const float sizes[] = { 1.0f, 1e-15f, 1e15f, 1e-4f, 1e5f };
    static const int exponents[] = { 0, -50, 50, -13, 17 };
    enum { SIZES = 5, ROUNDS = 4 };
    coverage seen;
    memset(&seen, 0, sizeof seen);
    uint64_t each = wanted / (SIZES * ROUNDS * (SHAPE_COUNT + 4));
    for (uint32_t i = 0; i < SIZES * ROUNDS; i++) {
        test_random random = { i };
        subject s;
        for (int kind = 0; kind < SHAPE_COUNT; kind++) {
            if (make_hull_mesh(&s, (shape_kind)kind, 20 + 70 * (i / SIZES), sizes[i % SIZES], &random)) {
                query(&s, &random, each, &seen);
                tl_halfedge_mesh_destroy(&s.mesh);
            }
        }
        make_plateaus(&s, 2 + i / SIZES, ldexpf(1.0f, exponents[i % SIZES]));
        query(&s, &random, 4 * each, &seen);
        tl_halfedge_mesh_destroy(&s.mesh);
    }
    print_message("%llu queries on %u meshes, %llu wrong; %llu with several farthest vertices\n",
                  (unsigned long long)seen.queries, seen.meshes, (unsigned long long)seen.wrong,
                  (unsigned long long)seen.ties);
    static const char *const names[HINT_KINDS] = { "any live vertex", "the last answer", "isolated", "removed",
                                                   "out of range" };
    for (int i = 0; i < HINT_KINDS; i++) {
        print_message("  hint %-16s %9llu\n", names[i], (unsigned long long)seen.hint[i]);
        TEST_CHECK(seen.hint[i] > wanted / 10);
    }
    TEST_CHECK(seen.wrong == 0 && seen.ties > wanted / 10 && seen.flat_hints > wanted / 100);
}

int main(int argc, char **argv)
{
    wanted = argc > 1 ? strtoull(argv[1], NULL, 10) : wanted;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_support_is_exact),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
