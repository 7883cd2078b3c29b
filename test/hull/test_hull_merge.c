// SPDX-License-Identifier: MIT
//
// Hulls with a weld and a merge distance: turned boxes and prisms have the faces they were made with, scanned boxes
// six; no input point lies farther outside than promised, by an oracle of its own; every query still agrees with the
// vertices.
//
//   test_hull_merge [ROUNDS]

#include "talus_test.h"

#include "base/hash.h"
#include "hull/support/hull_support.h"
#include "hull_shapes.h"
#include "math/predicates.h"

#include <talus/convex.h>
#include <talus/hull.h>

#include <stddef.h>
#include <string.h>

enum { MAX_POINTS = 4096 };

static uint32_t rounds = 12;

static tl_quat any_rotation(test_random *random)
{
    tl_vec3 axis = test_random_direction(random);
    double angle = 3.0 * (double)test_random_unit(random);
    float s = (float)sin(0.5 * angle);
    tl_quat q = { axis.x * s, axis.y * s, axis.z * s, (float)cos(0.5 * angle) };
    return q;
}

static tl_hull *bake(const tl_vec3 *points, uint32_t count, float weld, float merge, tl_hull_report *report)
{
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    def.weld_distance = weld;
    def.merge_distance = merge;
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, count, &def, &hull, report), TL_OK);
    return hull;
}

// From the vertices alone, by GJK over them as a cloud: nothing of the hull's faces counts.
static double distance_from(const tl_hull *hull, tl_vec3 point)
{
    tl_convex cloud = tl_convex_from_points(tl_hull_vertices(hull), hull->vertex_count, 0.0f);
    tl_convex dot = tl_convex_sphere(point, 0.0f);
    tl_separation found;
    tl_convex_distance(&cloud, tl_transform_identity(), &dot, tl_transform_identity(), NULL, &found);
    return (double)found.distance;
}

// What holds of every merged hull.
static void prove(const tl_hull *hull, const tl_vec3 *points, uint32_t count, float allowed,
                  const tl_hull_report *report)
{
    tl_hull_validation found;
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
    TEST_CHECK(tl_hull_validate(hull, points, count, &found) == (found.contains ? TL_OK : TL_ERR_RANGE));
    TEST_CHECK(found.euler && found.flat_faces && found.convex);
    TEST_CHECK(report->max_outside <= (double)allowed * 1.000001);
    TEST_CHECK((report->max_outside == 0.0) == found.contains);
    TEST_CHECK(report->corners_left_out > 0 || found.contains);
    double farthest = 0.0, size = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 p = tl_abs(points[i]);
        size = fmax(size, (double)tl_maxf(p.x, tl_maxf(p.y, p.z)));
    }
    for (uint32_t i = 0; i < count; i++) {
        farthest = fmax(farthest, distance_from(hull, points[i]));
    }
    TEST_CHECK(fabs(farthest - report->max_outside) <= 1e-6 * size);
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_plane plane = tl_hull_face_plane(hull, f);
        tl_hull_face face = tl_hull_face_at(hull, f);
        for (uint32_t v = 0; v < hull->vertex_count; v++) {
            double height = plane.normal[0] * (double)vertices[v].x + plane.normal[1] * (double)vertices[v].y +
                            plane.normal[2] * (double)vertices[v].z - plane.offset;
            TEST_CHECK(height <= 1e-12 * size); // no plane cuts the body
        }
        for (uint32_t k = 0; k < face.count; k++) {
            tl_vec3 p = vertices[tl_hull_edge_origin(hull, face.first + k)];
            double height = plane.normal[0] * (double)p.x + plane.normal[1] * (double)p.y +
                            plane.normal[2] * (double)p.z - plane.offset;
            TEST_CHECK(height >= -(double)hull->merge_distance - 1e-12 * size);
        }
    }
}

// Supports are exact whatever was merged: a scan in double says which vertices can be farthest.
static void compare_supports(const tl_hull *hull, test_random *random, uint32_t count)
{
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 d = test_random_direction(random);
        if (i % 2 == 0) { // nearly a face's normal
            tl_hull_plane plane = tl_hull_face_plane(hull, test_random_below(random, hull->face_count));
            d = tl_add(tl_vec3_make((float)plane.normal[0], (float)plane.normal[1], (float)plane.normal[2]),
                       tl_scale(d, i % 4 == 0 ? 1e-6f : 0.0f));
        }
        if (i % 5 == 0) {
            d.x *= 1e-30f; // components too far apart for one scale
        }
        uint32_t answer =
            tl_hull_support(hull, d, i % 3 == 0 ? test_random_below(random, hull->vertex_count) : TL_NO_VERTEX);
        TEST_CHECK(answer < hull->vertex_count);
        for (uint32_t v = 0; v < hull->vertex_count; v++) {
            int order = tl_compare_along(d, vertices[v], vertices[answer]);
            TEST_CHECK(order < 0 || (order == 0 && v >= answer));
        }
    }
}

static void turn(tl_vec3 *points, uint32_t count, tl_quat rotation, tl_vec3 move)
{
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_add(tl_rotate(rotation, points[i]), move);
    }
}

static void test_turned_boxes_have_six_faces(void **state)
{
    (void)state;
    test_random random = { 1 };
    uint32_t apart = 0;
    for (uint32_t i = 0; i < 20 * rounds; i++) {
        tl_vec3 half = tl_vec3_make(0.1f + 2.0f * test_random_unit(&random), 0.1f + test_random_unit(&random),
                                    0.1f + 5.0f * test_random_unit(&random));
        tl_vec3 points[8];
        for (uint32_t k = 0; k < 8; k++) {
            points[k] = tl_vec3_make(k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z);
        }
        turn(points, 8, any_rotation(&random), tl_vec3_make(10.0f * test_random_unit(&random), 0.0f, 3.0f));
        tl_hull_report report;
        tl_hull *exact = bake(points, 8, 0.0f, 0.0f, NULL), *merged = bake(points, 8, 0.0f, 1e-5f, &report);
        apart += exact->face_count > 6;
        TEST_CHECK(merged->face_count == 6 && merged->vertex_count == 8 && merged->half_edge_count == 24);
        TEST_CHECK(fabs(merged->mass.volume - exact->mass.volume) <= 1e-5 * exact->mass.volume);
        prove(merged, points, 8, 0.0f, &report);
        compare_supports(merged, &random, 20);
        tl_blob_free(exact);
        tl_blob_free(merged);
    }
    TEST_CHECK(apart > 15 * rounds); // exactly flat faces are rare after a turn
}

static void test_turned_prisms_have_their_faces(void **state)
{
    (void)state;
    static const uint32_t sides[] = { 3, 5, 6, 12, 24, 60, 300 };
    test_random random = { 2 };
    for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
        uint32_t n = sides[s];
        tl_vec3 points[600];
        for (uint32_t i = 0; i < 2 * n; i++) {
            points[i] = shape_on_ring(i / 2, n);
            points[i].y = i % 2 != 0 ? 0.7f : -0.7f;
        }
        turn(points, 2 * n, any_rotation(&random), tl_vec3_make(1.0f, 2.0f, 3.0f));
        tl_hull_report report;
        tl_hull *merged = bake(points, 2 * n, 0.0f, 5e-6f, &report);
        TEST_CHECK(merged->face_count == n + 2 && merged->vertex_count == 2 * n);
        prove(merged, points, 2 * n, 0.0f, &report);
        compare_supports(merged, &random, 300);
        tl_blob_free(merged);
    }
}

// A box as a scanner sees it: a grid on each side, noise along all axes.
static uint32_t scanned_box(test_random *random, uint32_t steps, float noise, tl_vec3 *points)
{
    uint32_t count = 0;
    for (uint32_t side = 0; side < 6; side++) {
        for (uint32_t i = 0; i <= steps; i++) {
            for (uint32_t j = 0; j <= steps; j++) {
                float u = 2.0f * (float)i / (float)steps - 1.0f, v = 2.0f * (float)j / (float)steps - 1.0f;
                float w = side % 2 != 0 ? 1.0f : -1.0f;
                tl_vec3 p = side / 2 == 0   ? tl_vec3_make(w, u, v)
                            : side / 2 == 1 ? tl_vec3_make(u, w, v)
                                            : tl_vec3_make(u, v, w);
                points[count++] = tl_add(p, tl_scale(test_random_direction(random), noise * test_random_unit(random)));
            }
        }
    }
    return count;
}

static void test_scanned_boxes_lose_their_noise(void **state)
{
    (void)state;
    tl_vec3 *points = malloc(MAX_POINTS * sizeof *points);
    test_random random = { 3 };
    for (uint32_t i = 0; i < rounds; i++) {
        uint32_t count = scanned_box(&random, 4 + i % 12, 1e-3f, points);
        turn(points, count, any_rotation(&random), tl_vec3_make(0.0f, 5.0f, 0.0f));
        tl_hull_report report;
        tl_hull *exact = bake(points, count, 0.0f, 0.0f, NULL), *merged = bake(points, count, 0.0f, 2e-2f, &report);
        TEST_CHECK(merged->vertex_count * 3 < exact->vertex_count && merged->face_count * 3 < exact->face_count);
        TEST_CHECK(merged->face_count <= 14 && report.corners_left_out == exact->vertex_count - merged->vertex_count);
        prove(merged, points, count, 2e-2f, &report);
        compare_supports(merged, &random, 100);
        tl_blob_free(exact);
        tl_blob_free(merged);
    }
    free(points);
}

// All families of clouds at several sizes and distances: whatever merging does, its promises hold.
static void test_promises_hold_for_all_clouds(void **state)
{
    (void)state;
    static const float merges[] = { 1e-6f, 1e-3f, 0.03f, 0.4f }, welds[] = { 0.0f, 0.1f };
    tl_vec3 points[700];
    uint32_t left_out = 0, merged_faces = 0, same = 0;
    for (uint32_t i = 0; i < rounds * SHAPE_COUNT; i++) {
        test_random random = { 100 + i };
        const float size = i / SHAPE_COUNT % 3 == 0 ? 1.0f : i / SHAPE_COUNT % 3 == 1 ? 1e-6f : 1e9f;
        uint32_t count =
            shape_make((shape_kind)(i % SHAPE_COUNT), &random, points, 20 + test_random_below(&random, 300));
        turn(points, count, any_rotation(&random), tl_vec3_make(0.0f, 0.0f, 0.0f));
        for (uint32_t k = 0; k < count; k++) {
            points[k] = tl_scale(points[k], size);
        }
        float merge = size * merges[i / 2 % 4], weld = size * welds[i % 2];
        tl_hull_report report;
        tl_hull *exact = bake(points, count, 0.0f, 0.0f, NULL), *merged = bake(points, count, weld, merge, &report);
        prove(merged, points, count, weld + merge, &report);
        compare_supports(merged, &random, 40);
        left_out += report.corners_left_out;
        merged_faces += merged->merge_distance > 0.0f;
        same += merged->face_count == exact->face_count;
        TEST_CHECK(merged->face_count <= exact->face_count);
        // The same again, byte for byte.
        tl_hull *again = bake(points, count, weld, merge, NULL);
        TEST_CHECK(again->blob.size == merged->blob.size);
        TEST_CHECK(tl_hash_bytes(again + 1, again->blob.size - sizeof *again, 0) ==
                   tl_hash_bytes(merged + 1, merged->blob.size - sizeof *merged, 0));
        tl_blob_free(again);
        tl_blob_free(exact);
        tl_blob_free(merged);
    }
    TEST_CHECK(left_out > 300 && merged_faces > rounds && same > rounds / 2);
}

static void test_welding_alone_keeps_faces_exact(void **state)
{
    (void)state;
    tl_vec3 points[300];
    test_random random = { 5 };
    uint32_t count = shape_make(SHAPE_SPHERE, &random, points, 300);
    tl_hull_report report;
    tl_hull *hull = bake(points, count, 0.2f, 0.0f, &report);
    TEST_CHECK(hull->merge_distance == 0.0f && report.corners_left_out > 100 && report.max_outside > 0.0);
    prove(hull, points, count, 0.2f, &report);
    const tl_vec3 *vertices = tl_hull_vertices(hull);
    for (uint32_t a = 0; a < hull->vertex_count; a++) {
        for (uint32_t b = 0; b < a; b++) {
            TEST_CHECK(tl_distance_sq(vertices[a], vertices[b]) > 0.2f * 0.2f * 0.99999f);
        }
    }
    tl_blob_free(hull);
    // A distance beyond the size would leave nothing solid; so nothing goes that the limit does not allow.
    hull = bake(points, count, 0.0f, 100.0f, &report);
    prove(hull, points, count, 100.0f, &report);
    tl_blob_free(hull);
    hull = bake(points, count, 100.0f, 0.0f, &report);
    prove(hull, points, count, 100.0f, &report);
    tl_blob_free(hull);
}

static void test_copies_stay_merged(void **state)
{
    (void)state;
    tl_vec3 points[8];
    for (uint32_t k = 0; k < 8; k++) {
        points[k] = tl_vec3_make(k & 1 ? 1.0f : -1.0f, k & 2 ? 2.0f : -2.0f, k & 4 ? 3.0f : -3.0f);
    }
    test_random random = { 6 };
    turn(points, 8, any_rotation(&random), tl_vec3_make(0.0f, 0.0f, 0.0f));
    tl_hull *hull = bake(points, 8, 0.0f, 1e-5f, NULL), *copy;
    tl_transform pose = { any_rotation(&random), { 1.0f, 2.0f, 3.0f } };
    TEST_RESULT(tl_hull_transform(hull, tl_vec3_make(2.0f, 2.0f, -2.0f), pose, NULL, &copy, NULL), TL_OK);
    TEST_CHECK(copy->face_count == 6 && copy->vertex_count == 8 && fabs(copy->mass.volume - 8.0 * 48.0) < 1e-3);
    tl_blob_free(copy);
    tl_blob_free(hull);
}

// Merged boxes answer as the boxes they are: rays, contains, distances and contacts beside the shape's own.
static void test_queries_agree_with_the_box(void **state)
{
    (void)state;
    test_random random = { 7 };
    uint32_t hits = 0, touching = 0;
    for (uint32_t i = 0; i < 60 * rounds; i++) {
        tl_vec3 half = tl_vec3_make(0.5f + test_random_unit(&random), 0.5f, 1.0f), points[8];
        tl_transform pose = { any_rotation(&random), { 0.3f, 0.0f, -0.2f } };
        for (uint32_t k = 0; k < 8; k++) {
            tl_vec3 corner = { k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z };
            points[k] = tl_add(tl_rotate(pose.rotation, corner), pose.position);
        }
        tl_hull *hull = bake(points, 8, 0.0f, 1e-5f, NULL);
        tl_convex a = tl_convex_from_hull(hull, 0.0f), box = tl_convex_box(tl_vec3_make(0, 0, 0), half, 0.0f);
        tl_convex other = tl_convex_box(tl_vec3_make(0, 0, 0), tl_vec3_make(0.4f, 0.6f, 0.3f), 0.0f);
        tl_transform still = tl_transform_identity();
        tl_transform beside = { any_rotation(&random),
                                tl_scale(test_random_direction(&random), 1.0f + test_random_unit(&random)) };
        const tl_contact_limits limits = { 0.05f, 0.05f, 0 };
        tl_contact_manifold merged, exact;
        tl_convex_contacts(&a, still, &other, beside, &limits, NULL, &merged);
        tl_convex_contacts(&box, pose, &other, beside, &limits, NULL, &exact);
        if (merged.count > 0 && exact.count > 0) {
            touching++;
            TEST_CHECK(fabsf(merged.separation - exact.separation) <= 1e-4f);
        }
        tl_vec3 from = tl_scale(test_random_direction(&random), 4.0f);
        tl_vec3 to = tl_scale(test_random_direction(&random), 0.9f);
        tl_hull_hit hit;
        if (tl_hull_cast_ray(hull, from, tl_sub(to, from), 1.0f, &hit)) {
            hits++;
            tl_vec3 at = tl_add(from, tl_scale(tl_sub(to, from), hit.t));
            TEST_CHECK(distance_from(hull, at) <= 2e-5);
        }
        tl_vec3 middle = { 0.3f, 0.0f, -0.2f };
        TEST_CHECK(tl_hull_contains(hull, middle) && !tl_hull_contains(hull, from));
        tl_blob_free(hull);
    }
    TEST_CHECK(hits > 10 * rounds && touching > 5 * rounds);
}

// Changed bytes are found, whatever they are.
static void test_changed_bytes_are_found(void **state)
{
    (void)state;
    tl_vec3 points[200];
    test_random random = { 8 };
    uint32_t count = shape_make(SHAPE_PRISM, &random, points, 120);
    turn(points, count, any_rotation(&random), tl_vec3_make(0.0f, 1.0f, 0.0f));
    tl_hull *hull = bake(points, count, 0.0f, 1e-5f, NULL);
    TEST_CHECK(hull->merge_distance > 0.0f);
    unsigned char *bytes = test_blob_alloc(hull->blob.size);
    uint32_t found = 0;
    for (uint32_t i = 0; i < 40 * rounds; i++) {
        memcpy(bytes, hull, hull->blob.size);
        const uint64_t at = 16 + test_random_below(&random, (uint32_t)hull->blob.size - 16);
        const uint64_t distance = offsetof(tl_hull, merge_distance), sources = tl_hull_sources_offset(hull);
        // Other sources, or a little more distance, would be as right.
        if ((at >= sources && at < sources + tl_hull_source_bytes(hull) * (uint64_t)hull->vertex_count) ||
            (at >= distance && at < distance + sizeof hull->merge_distance)) {
            continue;
        }
        bytes[at] ^= (unsigned char)(1u << test_random_below(&random, 8));
        tl_result result = tl_hull_check(bytes, hull->blob.size, NULL);
        TEST_CHECK(result == TL_ERR_CORRUPT);
        found += result != TL_OK;
    }
    TEST_CHECK(found > 10 * rounds);
    test_blob_free(bytes);
    tl_blob_free(hull);
}

static bool go_on(const char *stage, uint64_t done, uint64_t total, void *user)
{
    TEST_CHECK(stage != NULL && done <= total);
    uint32_t *left = user;
    return (*left)-- > 0;
}

static void test_memory_runs_out_and_progress_ends_it(void **state)
{
    (void)state;
    tl_vec3 *points = malloc(MAX_POINTS * sizeof *points);
    test_random random = { 9 };
    uint32_t count = scanned_box(&random, 6, 1e-3f, points);
    tl_hull_def def = tl_default_hull_def();
    def.weld_distance = 0.05f;
    def.merge_distance = 0.01f;
    uint64_t failures = 0;
    for (tl_result result = TL_ERR_MEMORY; result != TL_OK; failures++) {
        test_allocator memory;
        test_allocator_init(&memory, failures + 1);
        def.host.allocator = &memory.allocator;
        tl_hull *hull;
        result = tl_hull_bake(points, count, &def, &hull, NULL);
        TEST_CHECK(result == TL_OK || (result == TL_ERR_MEMORY && hull == NULL));
        tl_blob_free(hull);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    TEST_CHECK(failures > 3);
    // Cancelled at every call of progress in turn.
    uint32_t calls = 0, cancelled = 0;
    for (tl_result result = TL_ERR_CANCELLED; result != TL_OK; calls++) {
        uint32_t left = calls;
        tl_progress progress = { go_on, &left };
        def.host.allocator = NULL;
        def.host.progress = &progress;
        tl_hull *hull;
        result = tl_hull_bake(points, count, &def, &hull, NULL);
        TEST_CHECK(result == TL_OK || (result == TL_ERR_CANCELLED && hull == NULL));
        cancelled += result != TL_OK;
        tl_blob_free(hull);
    }
    TEST_CHECK(cancelled > 6);
    free(points);
}

int main(int argc, char **argv)
{
    rounds = argc > 1 ? (uint32_t)atoi(argv[1]) : rounds;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_turned_boxes_have_six_faces),
        cmocka_unit_test(test_turned_prisms_have_their_faces),
        cmocka_unit_test(test_scanned_boxes_lose_their_noise),
        cmocka_unit_test(test_promises_hold_for_all_clouds),
        cmocka_unit_test(test_welding_alone_keeps_faces_exact),
        cmocka_unit_test(test_copies_stay_merged),
        cmocka_unit_test(test_queries_agree_with_the_box),
        cmocka_unit_test(test_changed_bytes_are_found),
        cmocka_unit_test(test_memory_runs_out_and_progress_ends_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
