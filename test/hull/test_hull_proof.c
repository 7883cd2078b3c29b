// SPDX-License-Identifier: MIT
//
// Every cloud there is, generated and real, proven: Euler's formula, exact convexity, all points inside; and the same
// faces from the same points at other scales and a million sizes from the origin. Prints a row for each kind.

#include "talus_test.h"

#include "hull_shapes.h"

#include <talus/hull.h>

#include <string.h>

// Whole powers of two, so that the points stay the same: 9e-16, 3e-8, 3e7, 1e15.
static const int exponents[] = { -50, -25, 25, 50 };
enum { SCALES = 4 };

typedef struct row {
    const char *name;
    uint32_t clouds, flat;
    uint64_t points, vertices, faces;
    uint32_t euler, convex, contains, same_scaled, same_moved;
    uint32_t flat_moved;  // clouds whose points lie in one plane when rounded a million sizes away
    double worst_outside; // share of the size
} row;

static void print_head(void)
{
    print_message("%-16s %6s %5s %9s %8s %8s %7s %7s %7s %8s %10s %10s\n", "clouds", "count", "flat", "points",
                  "vertices", "faces", "V-E+F=2", "convex", "inside", "outside", "rescaled", "moved 1e6");
}

static void print_row(const row *r)
{
    print_message("%-16s %6u %5u %9llu %8llu %8llu %7u %7u %7u %8.1g %10u %5u of %u\n", r->name, r->clouds, r->flat,
                  (unsigned long long)r->points, (unsigned long long)r->vertices, (unsigned long long)r->faces,
                  r->euler, r->convex, r->contains, r->worst_outside, r->same_scaled, r->same_moved,
                  r->clouds - r->flat - r->flat_moved);
}

// A row whose every hull is proven in every respect.
static void check_row(const row *r)
{
    uint32_t solid = r->clouds - r->flat;
    print_row(r);
    TEST_CHECK(r->euler == solid && r->convex == solid && r->contains == solid && r->same_scaled == solid);
    TEST_CHECK(r->worst_outside <= 1e-6 && r->same_moved == solid - r->flat_moved);
}

static tl_hull *build_exactly(const tl_vec3 *points, uint32_t count)
{
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    tl_hull *hull;
    tl_result result = tl_hull_bake(points, count, &def, &hull, NULL);
    TEST_CHECK(result == TL_OK || result == TL_ERR_COPLANAR || result == TL_ERR_COLLINEAR ||
               result == TL_ERR_COINCIDENT);
    return hull;
}

static bool is_same_scaled(const tl_hull *hull, const tl_vec3 *points, uint32_t count, tl_vec3 *scratch)
{
    bool same = true;
    for (int e = 0; e < SCALES; e++) {
        for (uint32_t i = 0; i < count; i++) {
            scratch[i] = tl_scale(points[i], ldexpf(1.0f, exponents[e]));
        }
        tl_hull *other = build_exactly(scratch, count);
        same = same && other != NULL && shape_is_same_topology(hull, other) &&
               tl_hull_check(other, other->blob.size, NULL) == TL_OK;
        tl_blob_free(other);
    }
    return same;
}

// A million sizes away the points become others, of a coarse lattice; these are the same points near the origin.
static void compare_moved(const tl_vec3 *points, uint32_t count, float size, tl_vec3 *scratch, row *r)
{
    tl_vec3 offset = tl_scale(tl_vec3_make(1.0f, -0.7f, 0.6f), 1e6f * size);
    for (uint32_t i = 0; i < count; i++) {
        scratch[i] = tl_add(points[i], offset);
    }
    tl_hull *far = build_exactly(scratch, count);
    if (far == NULL) {
        r->flat_moved++;
        return;
    }
    bool proven = tl_hull_validate(far, scratch, count, NULL) == TL_OK;
    for (uint32_t i = 0; i < count; i++) {
        scratch[i] = tl_sub(scratch[i], offset);
    }
    tl_hull *near = build_exactly(scratch, count);
    r->same_moved += proven && near != NULL && shape_is_same_topology(far, near);
    tl_blob_free(near);
    tl_blob_free(far);
}

static void visit(tl_vec3 *points, uint32_t count, void *user)
{
    row *r = user;
    tl_hull *hull;
    r->clouds++;
    r->points += count;
    if (tl_hull_bake(points, count, NULL, &hull, NULL) != TL_OK) {
        r->flat++;
        return;
    }
    tl_hull_validation found;
    tl_hull_validate(hull, points, count, &found);
    tl_vec3 box = tl_aabb_size(hull->bounds);
    float size = tl_maxf(box.x, tl_maxf(box.y, box.z));
    r->vertices += hull->vertex_count;
    r->faces += hull->face_count;
    r->euler += found.euler;
    r->convex += found.convex && found.flat_faces;
    r->contains += found.contains;
    r->worst_outside = fmax(r->worst_outside, found.max_outside / (double)size);
    tl_vec3 *scratch = malloc(count * sizeof *scratch);
    r->same_scaled += is_same_scaled(hull, points, count, scratch);
    compare_moved(points, count, size, scratch, r);
    free(scratch);
    tl_blob_free(hull);
}

static void test_generated_clouds(void **state)
{
    (void)state;
    static const char *const names[SHAPE_COUNT] = { "sphere", "ball",  "cube volume", "cube surface",
                                                    "grid",   "prism", "cone",        "needle",
                                                    "plate",  "lens",  "capsule",     "cluster" };
    static const uint32_t counts[] = { 4, 5, 6, 8, 13, 20, 33, 60, 100, 200, 500, 1000 };
    tl_vec3 points[1000];
    uint32_t solid = 0;
    print_head();
    for (int kind = 0; kind < SHAPE_COUNT; kind++) {
        row r = { 0 };
        r.name = names[kind];
        for (uint32_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            test_random random = { (uint64_t)kind * 100 + c };
            visit(points, shape_make((shape_kind)kind, &random, points, counts[c]), &r);
        }
        check_row(&r);
        solid += r.clouds - r.flat;
    }
    TEST_CHECK(solid > 135);
}

static void test_real_clouds(void **state)
{
    (void)state;
    row r = { 0 };
    r.name = "hulls_dev";
    if (shape_each_cloud(TALUS_DATA_DIR "/hulls/hulls_dev.txt", visit, &r) == 0) {
        skip();
    }
    print_head();
    check_row(&r);
    TEST_CHECK(r.clouds > 3000 && r.flat < r.clouds / 10);
}

static void test_real_models(void **state)
{
    (void)state;
    static const char *const names[] = {
        "models/cow",      "models/fandisk",     "models/rocker-arm", "models/stanford-bunny",
        "models/suzanne",  "models/teapot",      "levels/dungeon",    "levels/collision_mesh_01",
        "levels/nav_test", "levels/proto-level", "levels/test_map01", "levels/undulating",
    };
    uint32_t seen = 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s.obj", TALUS_DATA_DIR, names[i]);
        uint32_t count;
        tl_vec3 *points = shape_read_obj(path, &count);
        if (points == NULL) {
            continue;
        }
        if (seen++ == 0) {
            print_head();
        }
        row r = { 0 };
        r.name = strchr(names[i], '/') + 1;
        visit(points, count, &r);
        check_row(&r);
        TEST_CHECK(r.flat == 0);
        free(points);
    }
    if (seen == 0) {
        skip();
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_generated_clouds),
        cmocka_unit_test(test_real_clouds),
        cmocka_unit_test(test_real_models),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
