// SPDX-License-Identifier: MIT
//
// The support query against an exhaustive scan: all kinds of hulls, sizes from 1e-15 to 1e15, offsets of up to a
// million sizes, level faces, wild directions, right and wrong hints, every instruction set.
//
//   test_hull_support [QUERIES]
//
// asks about so many questions instead of a million, and prints what they covered.

#include "talus_test.h"

#include "hull/support/direction_table.h"
#include "hull_climb.h"
#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/hull.h>

static uint64_t wanted = 1000000;

// Regimes: each query is counted once in every list.
enum { SIZE_COUNT = 7, OFFSET_COUNT = 4 };
static const float sizes[SIZE_COUNT] = { 1.0f, 1e-15f, 1e15f, 1e-3f, 37.0f, 1e-7f, 1e8f };
static const float offsets[OFFSET_COUNT] = { 0.0f, 3.0f, 1e3f, 1e6f }; // in sizes

typedef enum direction_kind {
    DIRECTION_ANY,
    DIRECTION_TURNED, ///< by a degree from the one before
    DIRECTION_FACE,   ///< a face's normal, rounded
    DIRECTION_EDGE,   ///< across an edge, rounded
    DIRECTION_AXIS,
    DIRECTION_EXTREME, ///< of lengths near the ends of float's range, components far apart
    DIRECTION_KINDS
} direction_kind;

typedef enum hint_kind { HINT_NONE, HINT_LAST, HINT_BESIDE, HINT_WILD, HINT_KINDS } hint_kind;

typedef struct coverage {
    uint64_t queries, wrong, ties, good_hints, scanned;
    uint64_t shape[SHAPE_COUNT + 1], size[SIZE_COUNT], offset[OFFSET_COUNT], direction[DIRECTION_KINDS],
        hint[HINT_KINDS], isa[TL_SUPPORT_ISA_COUNT + 1];
    uint32_t hulls, min_vertices, max_vertices;
} coverage;

// The scan in double: products of floats are exact, so only two sums are rounded. What they leave open is compared
// exactly. The lowest of several farthest vertices; `tied_out` tells whether there were several.
static uint32_t scan(const tl_hull *hull, tl_vec3 d, bool *tied_out)
{
    static double dots[1 << 16];
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    double most = -HUGE_VAL, magnitude = 0.0;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        tl_vec3 p = vertices[v];
        double x = (double)d.x * (double)p.x, y = (double)d.y * (double)p.y, z = (double)d.z * (double)p.z;
        dots[v] = x + y + z;
        most = dots[v] > most ? dots[v] : most;
        magnitude = fmax(magnitude, fabs(x) + fabs(y) + fabs(z));
    }
    uint32_t best = TL_NO_VERTEX;
    *tied_out = false;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        if (dots[v] < most - magnitude * 1e-15) {
            continue;
        }
        int order = best == TL_NO_VERTEX ? 1 : tl_compare_along(d, vertices[v], vertices[best]);
        *tied_out = order > 0 ? false : *tied_out || order == 0;
        best = order > 0 ? v : best;
    }
    return best;
}

static tl_vec3 make_direction(const tl_hull *hull, test_random *random, direction_kind kind, tl_vec3 last)
{
    tl_vec3 d = test_random_direction(random);
    switch (kind) {
    case DIRECTION_TURNED:
        return tl_add(last, tl_scale(d, 0.0174533f * tl_length(last)));
    case DIRECTION_FACE: {
        tl_hull_plane plane = tl_hull_face_plane(hull, test_random_below(random, hull->face_count));
        return tl_vec3_make((float)plane.normal[0], (float)plane.normal[1], (float)plane.normal[2]);
    }
    case DIRECTION_EDGE: {
        uint32_t e = test_random_below(random, hull->half_edge_count);
        tl_vec3 a = tl_hull_corner(hull, e), b = tl_hull_corner(hull, tl_hull_edge_next(hull, e));
        tl_vec3 n = tl_cross(tl_normalize(tl_sub(b, a)), d);
        return tl_dot(n, n) > 0.0f ? n : d;
    }
    case DIRECTION_AXIS: {
        int axis = (int)test_random_below(random, 3);
        float sign = test_random_below(random, 2) ? 1.0f : -1.0f;
        return tl_vec3_make(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0);
    }
    case DIRECTION_EXTREME: {
        float length = ldexpf(1.0f, (int)test_random_below(random, 250) - 125);
        float squeeze = ldexpf(1.0f, -(int)test_random_below(random, 200));
        return tl_vec3_make(d.x * length, d.y * length * squeeze, d.z * length);
    }
    default:
        return d;
    }
}

// A vertex one edge away.
static uint32_t neighbour_of(const tl_hull *hull, uint32_t vertex, test_random *random)
{
    uint32_t edge = tl_hull_vertex_edge(hull, vertex);
    for (uint32_t turns = test_random_below(random, 8); turns > 0; turns--) {
        edge = tl_hull_edge_next(hull, tl_hull_edge_twin(hull, edge));
    }
    return tl_hull_edge_origin(hull, tl_hull_edge_next(hull, edge));
}

// One question by one instruction set or, with TL_SUPPORT_ISA_COUNT, by the public function.
static uint32_t ask(const tl_hull *hull, tl_vec3 d, uint32_t hint, uint32_t isa)
{
    tl_support_kernel kernel;
    if (isa < TL_SUPPORT_ISA_COUNT && tl_support_kernel_for((tl_support_isa)isa, &kernel)) {
        return kernel.support(hull, d.x, d.y, d.z, hint);
    }
    return tl_hull_support(hull, d, hint);
}

static void query(const tl_hull *hull, test_random *random, uint64_t count, coverage *seen)
{
    tl_vec3 last = tl_vec3_make(0, 1, 0);
    uint32_t answer = TL_NO_VERTEX;
    for (uint64_t i = 0; i < count; i++) {
        direction_kind kind = (direction_kind)test_random_below(random, DIRECTION_KINDS);
        hint_kind hint_is = (hint_kind)test_random_below(random, HINT_KINDS);
        uint32_t isa = test_random_below(random, TL_SUPPORT_ISA_COUNT + 1);
        tl_vec3 d = make_direction(hull, random, kind, last);
        bool tied;
        uint32_t expected = scan(hull, d, &tied);
        uint32_t hint = hint_is == HINT_NONE     ? TL_NO_VERTEX
                        : hint_is == HINT_LAST   ? answer
                        : hint_is == HINT_BESIDE ? neighbour_of(hull, expected, random)
                                                 : (uint32_t)test_random_u64(random);
        answer = ask(hull, d, hint, isa);
        seen->wrong += answer != expected;
        seen->queries++;
        seen->ties += tied;
        seen->good_hints += hint == expected;
        seen->scanned += hull->vertex_count <= TL_HULL_SCAN_LIMIT;
        seen->direction[kind]++;
        seen->hint[hint_is]++;
        seen->isa[isa]++;
        last = kind == DIRECTION_EXTREME ? last : d;
    }
    seen->hulls++;
    seen->min_vertices = hull->vertex_count < seen->min_vertices ? hull->vertex_count : seen->min_vertices;
    seen->max_vertices = hull->vertex_count > seen->max_vertices ? hull->vertex_count : seen->max_vertices;
}

static void query_points(tl_vec3 *points, uint32_t count, uint32_t shape, uint32_t size, uint32_t offset,
                         test_random *random, uint64_t queries, coverage *seen)
{
    // A million sizes away every edge is a few quanta long.
    tl_vec3 away = tl_scale(tl_vec3_make(1.0f, -0.1f, 0.4f), offsets[offset] * sizes[size]);
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_add(tl_scale(points[i], sizes[size]), away);
    }
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    tl_hull *hull;
    if (tl_hull_bake(points, count, &def, &hull, NULL) != TL_OK) {
        return; // too few places are left so far away
    }
    uint64_t before = seen->queries;
    query(hull, random, queries, seen);
    seen->shape[shape] += seen->queries - before;
    seen->size[size] += seen->queries - before;
    seen->offset[offset] += seen->queries - before;
    tl_blob_free(hull);
}

static void query_shapes(coverage *seen)
{
    static const uint32_t counts[] = { 4, 9, 30, 48, 49, 90, 300, 1000, 3000 };
    enum { COUNTS = sizeof counts / sizeof *counts };
    tl_vec3 *points = malloc(3000 * sizeof *points);
    uint64_t cells = SHAPE_COUNT * COUNTS * OFFSET_COUNT;
    for (uint32_t kind = 0; kind < SHAPE_COUNT; kind++) {
        for (uint32_t c = 0; c < COUNTS * OFFSET_COUNT; c++) {
            test_random random = { (uint64_t)kind * 131 + c };
            uint32_t count = shape_make((shape_kind)kind, &random, points, counts[c % COUNTS]);
            query_points(points, count, kind, (c + kind) % SIZE_COUNT, c / COUNTS, &random, wanted / cells, seen);
        }
    }
    free(points);
}

static void query_cloud(tl_vec3 *points, uint32_t count, void *user)
{
    coverage *seen = user;
    test_random random = { seen->hulls };
    query_points(points, count, SHAPE_COUNT, seen->hulls % SIZE_COUNT, seen->hulls % OFFSET_COUNT, &random,
                 wanted / 30000, seen);
}

// Real data, where it is: clouds, and models of thousands of vertices.
static void query_data(coverage *seen)
{
    static const char *const models[] = { "suzanne", "teapot", "cow", "fandisk", "rocker-arm", "stanford-bunny" };
    shape_each_cloud(TALUS_DATA_DIR "/hulls/hulls_dev.txt", query_cloud, seen);
    for (uint32_t i = 0; i < sizeof models / sizeof *models; i++) {
        char path[1024];
        uint32_t count;
        snprintf(path, sizeof path, "%s/models/%s.obj", TALUS_DATA_DIR, models[i]);
        tl_vec3 *points = shape_read_obj(path, &count);
        if (points != NULL) {
            test_random random = { i };
            query_points(points, count, SHAPE_COUNT, i % SIZE_COUNT, i % OFFSET_COUNT, &random, wanted / 500, seen);
        }
        free(points);
    }
}

static void print_coverage(const coverage *seen)
{
    static const char *const shapes[SHAPE_COUNT + 1] = { "sphere",  "ball",    "cube volume", "cube surface", "grid",
                                                         "prism",   "cone",    "needle",      "plate",        "lens",
                                                         "capsule", "cluster", "real data" };
    static const char *const directions[DIRECTION_KINDS] = { "any",  "turned a degree", "face normal", "across edge",
                                                             "axis", "extreme" };
    static const char *const hints[HINT_KINDS] = { "none", "the last answer", "beside the answer", "any number" };
    static const char *const isas[TL_SUPPORT_ISA_COUNT + 1] = { "scalar", "SSE4.2", "AVX2", "the machine's best" };
    print_message("%llu queries, %llu wrong; %u hulls of %u to %u vertices\n", (unsigned long long)seen->queries,
                  (unsigned long long)seen->wrong, seen->hulls, seen->min_vertices, seen->max_vertices);
    print_message("  %llu scanned, the others climbed; %llu with several farthest vertices; %llu right hints\n",
                  (unsigned long long)seen->scanned, (unsigned long long)seen->ties,
                  (unsigned long long)seen->good_hints);
    for (int i = 0; i <= SHAPE_COUNT; i++) {
        print_message("  shape %-18s %9llu\n", shapes[i], (unsigned long long)seen->shape[i]);
    }
    for (int i = 0; i < SIZE_COUNT; i++) {
        print_message("  size %-19g %9llu\n", (double)sizes[i], (unsigned long long)seen->size[i]);
    }
    for (int i = 0; i < OFFSET_COUNT; i++) {
        print_message("  offset, sizes %-10g %9llu\n", (double)offsets[i], (unsigned long long)seen->offset[i]);
    }
    for (int i = 0; i < DIRECTION_KINDS; i++) {
        print_message("  direction %-14s %9llu\n", directions[i], (unsigned long long)seen->direction[i]);
    }
    for (int i = 0; i < HINT_KINDS; i++) {
        print_message("  hint %-19s %9llu\n", hints[i], (unsigned long long)seen->hint[i]);
    }
    for (int i = 0; i <= TL_SUPPORT_ISA_COUNT; i++) {
        print_message("  by %-21s %9llu\n", isas[i], (unsigned long long)seen->isa[i]);
    }
}

static void test_support_is_exact_on_all_shapes(void **state)
{
    (void)state;
    coverage seen;
    memset(&seen, 0, sizeof seen);
    seen.min_vertices = UINT32_MAX;
    query_data(&seen);
    query_shapes(&seen);
    print_coverage(&seen);
    TEST_CHECK(seen.wrong == 0);
    uint64_t few = wanted / 100;
    TEST_CHECK(seen.queries > wanted * 3 / 4 && seen.ties > few && seen.good_hints > few);
    TEST_CHECK(seen.scanned > 10 * few && seen.queries - seen.scanned > 10 * few);
    for (int i = 0; i < SHAPE_COUNT; i++) {
        TEST_CHECK(seen.shape[i] > few);
    }
    for (int i = 0; i < SIZE_COUNT; i++) {
        TEST_CHECK(seen.size[i] > few);
    }
    for (int i = 0; i < OFFSET_COUNT; i++) {
        TEST_CHECK(seen.offset[i] > few);
    }
}

static tl_hull *build_shape(shape_kind kind, uint32_t count)
{
    tl_vec3 *points = malloc(count * sizeof *points);
    test_random random = { 3 };
    count = shape_make(kind, &random, points, count);
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
    free(points);
    return hull;
}

static void test_directions_without_a_size(void **state)
{
    (void)state;
    for (uint32_t count = 20; count <= 200; count += 180) {
        tl_hull *hull = build_shape(SHAPE_SPHERE, count);
        test_random random = { 4 };
        for (uint32_t isa = 0; isa <= TL_SUPPORT_ISA_COUNT; isa++) {
            TEST_CHECK(ask(hull, tl_vec3_make(0, 0, 0), 5, isa) == 0);
            TEST_CHECK(ask(hull, tl_vec3_make(-0.0f, 0, 0), TL_NO_VERTEX, isa) == 0);
            const float bad[] = { NAN, INFINITY, -INFINITY };
            for (int i = 0; i < 9; i++) {
                tl_vec3 d =
                    tl_vec3_make(i / 3 == 0 ? bad[i % 3] : 1, i / 3 == 1 ? bad[i % 3] : 1, i / 3 == 2 ? bad[i % 3] : 1);
                TEST_CHECK(ask(hull, d, TL_NO_VERTEX, isa) < hull->vertex_count);
            }
            // Denormal and largest directions.
            for (int i = 0; i < 1000; i++) {
                tl_vec3 d = tl_scale(test_random_direction(&random), i % 2 ? 1e-44f : 3.4e38f);
                bool tied;
                TEST_CHECK(ask(hull, d, (uint32_t)i % 7, isa) == scan(hull, d, &tied));
            }
        }
        tl_blob_free(hull);
    }
}

// How many starts from the table are wrong: a table that has gone bad would not show otherwise, for the answers would
// still be right.
static void test_starts_are_good(void **state)
{
    (void)state;
    // Of directions that the shape's box has stretched: as even as the table itself.
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        tl_hull *hull = build_shape((shape_kind)kind, 2000);
        test_random random = { 5 };
        uint32_t wrong = 0;
        for (int i = 0; i < 10000 && hull->vertex_count > TL_HULL_SCAN_LIMIT; i++) {
            tl_vec3 d = test_random_direction(&random), s = tl_hull_climb_head(hull)->table_scale;
            d = tl_vec3_make(d.x / s.x, d.y / s.y, d.z / s.z);
            wrong += tl_hull_table_start(hull, d) != tl_hull_support(hull, d, TL_NO_VERTEX);
        }
        TEST_CHECK(wrong < 2500);
        tl_blob_free(hull);
    }
}

static tl_vec3 along_axis(int axis, float along, float u, float v)
{
    return axis == 0 ? tl_vec3_make(along, u, v) : axis == 1 ? tl_vec3_make(v, along, u) : tl_vec3_make(u, v, along);
}

// A prism, or a cone when the second cap is a point: a flat cap across each axis, its directions by how far they are
// off the axis. Along x and y the cap's normal lies in a corner of the table's squares.
static void test_starts_at_caps(void **state)
{
    (void)state;
    enum { MAX_SIDES = 512, QUERIES = 200 };
    static tl_vec3 points[2 * MAX_SIDES];
    test_random random = { 8 };
    double most = 0.0;
    for (int shape = 0; shape < 2 * 3 * 4; shape++) {
        int axis = shape % 3, cone = shape / 3 % 2;
        uint32_t sides = MAX_SIDES >> shape / 6;
        for (uint32_t i = 0; i < 2 * sides; i++) {
            double turn = 6.283185307179586 * (double)(i / 2) / (double)sides;
            double size = cone && i % 2 != 0 ? 0.0 : 1.0;
            points[i] =
                along_axis(axis, i % 2 != 0 ? 0.5f : -0.5f, (float)(size * cos(turn)), (float)(size * sin(turn)));
        }
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 2 * sides, NULL, &hull, NULL), TL_OK);
        TEST_CHECK(tl_hull_climb_head(hull)->table_side > 0);
        TEST_CHECK(tl_hull_climb_head(hull)->ring_count == (cone ? 1 : 2));
        for (float away = 1e-9f; away < 0.2f; away *= 10.0f) {
            for (int end = 0; end < 2 - cone; end++) {
                double steps = 0.0;
                for (int i = 0; i < QUERIES; i++) {
                    double turn = (double)test_random_range(&random, 0.0f, 6.2831853f);
                    steps += hull_climb_steps(hull, along_axis(axis, end != 0 ? 1.0f : -1.0f, away * (float)cos(turn),
                                                               away * (float)sin(turn)));
                }
                most = fmax(most, steps / QUERIES);
            }
        }
        tl_blob_free(hull);
    }
    print_message("at caps: %.2f steps at most\n", most);
    TEST_CHECK(most <= 2.0);
}

// A cap of a flat middle and a band around it whose slope no cell of the table can tell from flat.
static void test_starts_at_nearly_flat_caps(void **state)
{
    (void)state;
    enum { SIDES = 512, QUERIES = 200 };
    static tl_vec3 points[3 * SIDES];
    test_random random = { 9 };
    double most = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        static const float along[3] = { -1.0f, 1.0f, 1.001f }, size[3] = { 1.0f, 0.99f, 0.5f };
        for (uint32_t i = 0; i < 3 * SIDES; i++) {
            const double turn = 6.283185307179586 * (double)(i / 3) / SIDES, radius = (double)size[i % 3];
            points[i] = along_axis(axis, along[i % 3], (float)(radius * cos(turn)), (float)(radius * sin(turn)));
        }
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 3 * SIDES, NULL, &hull, NULL), TL_OK);
        TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
        for (float away = 1e-6f; away < 0.2f; away *= 10.0f) {
            double steps = 0.0;
            for (int i = 0; i < QUERIES; i++) {
                const double turn = (double)test_random_range(&random, 0.0f, 6.2831853f);
                steps +=
                    hull_climb_steps(hull, along_axis(axis, 1.0f, away * (float)cos(turn), away * (float)sin(turn)));
            }
            most = fmax(most, steps / QUERIES);
        }
        tl_blob_free(hull);
    }
    print_message("at nearly flat caps: %.2f steps at most\n", most);
    TEST_CHECK(most <= 2.0);
}

// The table's bytes do not depend on the machine: the march gives the same cells in every instruction set.
static void test_marches_agree(void **state)
{
    (void)state;
    enum { COUNT = 500 };
    uint32_t changes = 0;
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        tl_hull *hull = build_shape((shape_kind)kind, 700);
        test_random random = { 6 };
        for (int i = 0; i < 200 && hull->vertex_count > TL_HULL_FEW; i++) {
            tl_vec3 from = test_random_direction(&random);
            tl_vec3 step = tl_scale(test_random_direction(&random), 4.0f / COUNT);
            uint32_t cells[2][COUNT], filled = 0, start = tl_hull_support(hull, from, TL_NO_VERTEX);
            for (uint32_t isa = 0; isa < TL_SUPPORT_ISA_COUNT; isa++) {
                tl_support_kernel kernel;
                if (tl_support_kernel_for((tl_support_isa)isa, &kernel)) {
                    uint32_t n = kernel.march(hull, from, step, COUNT, start, cells[isa > 0]);
                    TEST_CHECK(isa == 0 || (n == filled && memcmp(cells[0], cells[1], n * sizeof(uint32_t)) == 0));
                    filled = n;
                }
            }
            TEST_CHECK(filled > 0 && filled <= COUNT);
            changes += cells[0][filled - 1] != start;
        }
        tl_blob_free(hull);
    }
    TEST_CHECK(changes > SHAPE_COUNT * 100);
}

int main(int argc, char **argv)
{
    wanted = argc > 1 ? strtoull(argv[1], NULL, 10) : wanted;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_support_is_exact_on_all_shapes),
        cmocka_unit_test(test_directions_without_a_size),
        cmocka_unit_test(test_starts_are_good),
        cmocka_unit_test(test_starts_at_caps),
        cmocka_unit_test(test_starts_at_nearly_flat_caps),
        cmocka_unit_test(test_marches_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
