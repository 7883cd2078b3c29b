// SPDX-License-Identifier: MIT
//
// Inner samples and greedy insertion: positions by brute force, errors by brute force, and the limit of a patch.

#include "nav_compact_fixture.h"

#include <math.h>

#include "nav_bake/detail/detail.h"

static double plane_error(const tl_detail_mesh *m, const tl_detail_point *s)
{
    uint32_t t = tl_detail_locate(m, s, 0);
    const tl_detail_point *p[3];
    for (int k = 0; k < 3; k++) {
        p[k] = &m->points[m->triangles[t].corner[k]];
    }
    double area2 = (double)tl_detail_orient(p[0], p[1], p[2]), y = 0;
    for (int k = 0; k < 3; k++) {
        y += p[k]->y * ((double)tl_detail_orient(p[(k + 1) % 3], p[(k + 2) % 3], s) / area2);
    }
    return fabs(y - s->y);
}

typedef struct scratch {
    tl_arena arena;
    tl_detail_mesh mesh;
    tl_detail_heap heap;
    tl_detail_point *samples;
} scratch;

static void scratch_init(scratch *s, uint32_t points, uint32_t samples)
{
    memset(s, 0, sizeof *s);
    tl_arena_init(&s->arena, NULL);
    s->mesh.points = TL_PUSH(&s->arena, tl_detail_point, points);
    s->mesh.triangle_of = TL_PUSH(&s->arena, uint32_t, points);
    s->mesh.triangles = TL_PUSH(&s->arena, tl_detail_triangle, 2 * points);
    s->mesh.changed = TL_PUSH(&s->arena, uint32_t, 2 * points + 4);
    s->mesh.stack = TL_PUSH(&s->arena, uint32_t, points + 4);
    s->mesh.next_sample = TL_PUSH(&s->arena, uint32_t, samples);
    s->heap.triangles = TL_PUSH(&s->arena, uint32_t, 2 * points);
    s->heap.place = TL_PUSH(&s->arena, uint32_t, 2 * points);
    s->heap.error = TL_PUSH(&s->arena, double, 2 * points);
    s->heap.worst = TL_PUSH(&s->arena, uint32_t, 2 * points);
    s->samples = TL_PUSH(&s->arena, tl_detail_point, samples);
    s->mesh.samples = s->samples;
}

// A square with samples in all its columns.
static double refine_square(scratch *s, test_random *random, int32_t side, int32_t roughness, double max_error)
{
    int32_t end = side * TL_DETAIL_ONE;
    tl_detail_point square[4] = { { 0, 0, 0 }, { 0, end, 5 }, { end, end, 9 }, { end, 0, 2 } };
    memcpy(s->mesh.points, square, sizeof square);
    tl_detail_start(&s->mesh, 4);
    uint32_t count = 0, t = 0;
    for (int32_t z = 0; z < side; z++) {
        for (int32_t x = 0; x < side; x++) {
            tl_detail_point *p = &s->samples[count];
            p->x = x * TL_DETAIL_ONE + TL_DETAIL_ONE / 2;
            p->z = z * TL_DETAIL_ONE + TL_DETAIL_ONE / 2;
            p->y = (int32_t)(20.0f + 10.0f * sinf(0.2f * (float)x) * sinf(0.13f * (float)z)) +
                   (int32_t)test_random_below(random, (uint32_t)roughness + 1);
            t = tl_detail_locate(&s->mesh, p, t);
            s->mesh.next_sample[count] = s->mesh.triangles[t].first_sample;
            s->mesh.triangles[t].first_sample = count++;
        }
    }
    return tl_detail_refine(&s->mesh, &s->heap, count, max_error);
}

static void errors_by_brute_force(void **state)
{
    (void)state;
    test_random random = { 64 };
    uint32_t refined = 0, complete = 0;
    for (int round = 0; round < 40; round++) {
        int32_t side = 4 + (int32_t)test_random_below(&random, 30);
        double max_error = round % 5 == 0 ? 0.0 : (double)test_random_range(&random, 0.1f, 6.0f);
        scratch s;
        uint32_t samples = (uint32_t)(side * side);
        scratch_init(&s, samples + 4, samples);
        double left = refine_square(&s, &random, side, round % 3, max_error), worst = 0;
        for (uint32_t k = 0; k < samples; k++) {
            double error = plane_error(&s.mesh, &s.samples[k]);
            worst = error > worst ? error : worst;
        }
        TEST_CHECK(left <= max_error && fabs(worst - left) < 1e-6);
        refined += s.mesh.point_count > 10;
        complete += s.mesh.point_count > samples / 2;
        TEST_CHECK(s.mesh.point_count < samples + 4 || max_error == 0);
        tl_arena_free(&s.arena);
    }
    TEST_CHECK(refined > 20 && complete > 3);
}

// More than 65,535 vertices are wanted: the patch is filled to there, and says what error is left.
static void full_patch(void **state)
{
    (void)state;
    test_random random = { 65 };
    scratch s;
    scratch_init(&s, TL_DETAIL_MAX_VERTICES, 280 * 280);
    double left = refine_square(&s, &random, 280, 30, 0.0);
    TEST_CHECK(s.mesh.point_count == TL_DETAIL_MAX_VERTICES && left > 0);
    TEST_CHECK(s.mesh.triangle_count == 2 * s.mesh.point_count - 4 - 2);
    tl_arena_free(&s.arena);
}

static void positions_by_brute_force(void **state)
{
    (void)state;
    test_random random = { 66 };
    uint32_t found = 0;
    for (int round = 0; round < 60; round++) {
        // A convex quadrilateral of lattice corners, in the polygons' winding.
        int32_t d[8];
        for (int k = 0; k < 8; k++) {
            d[k] = (int32_t)test_random_below(&random, 15);
        }
        int32_t vertices[12] = { -8 + d[0], 3, -8 - d[1], -9 - d[2], 5, 20 + d[3],
                                 30 + d[4], 7, 22 + d[5], 25 + d[6], 1, -10 - d[7] };
        uint32_t first[2] = { 0, 4 }, indices[4] = { 0, 1, 2, 3 }, region = 0;
        tl_polygon_mesh polygons;
        memset(&polygons, 0, sizeof polygons);
        polygons.vertices = vertices;
        polygons.first = first;
        polygons.indices = indices;
        polygons.regions = &region;
        polygons.polygon_count = 1;
        fixture_map map = fixture_map_make(1, 1);
        tl_nav_compact compact = fixture_compact_make(&map, 0);
        compact.region = tl_allocate_array(NULL, 0, sizeof(uint32_t));
        tl_detail_work work;
        memset(&work, 0, sizeof work);
        work.compact = &compact;
        work.polygons = &polygons;
        work.spacing = round % 3 == 0 ? 0.9 : (double)test_random_range(&random, 0.9f, 7.0f);
        uint64_t bound = tl_detail_sample_bound(&work, 0);
        tl_detail_point *samples = malloc((size_t)bound * sizeof *samples);
        uint32_t count = tl_detail_sample_inside(&work, 0, samples, (uint32_t)bound), expected = 0;
        TEST_CHECK(count <= bound);
        tl_detail_extent e = tl_detail_polygon_extent(&polygons, 0);
        int64_t last_z = INT64_MIN;
        for (double i = -200; i <= 200; i += 1) {
            int64_t z = (int64_t)floor(i * work.spacing), last_x = INT64_MIN;
            for (double j = -200; j <= 200 && z != last_z; j += 1) {
                int64_t x = (int64_t)floor(j * work.spacing);
                double depth = 1e9;
                for (int k = 0; k < 4; k++) {
                    const int32_t *a = vertices + 3 * k, *b = vertices + 3 * ((k + 1) % 4);
                    double dx = b[0] - a[0], dz = b[2] - a[2];
                    double side = (((double)x + 0.5 - a[0]) * dz - dx * ((double)z + 0.5 - a[2])) / hypot(dx, dz);
                    depth = side < depth ? side : depth;
                }
                if (x != last_x && depth > 0.5 * work.spacing) {
                    bool listed = false;
                    for (uint32_t s = 0; s < count; s++) {
                        listed |= samples[s].x == (x - e.min_x) * TL_DETAIL_ONE + TL_DETAIL_ONE / 2 &&
                                  samples[s].z == (z - e.min_z) * TL_DETAIL_ONE + TL_DETAIL_ONE / 2;
                    }
                    TEST_CHECK(listed);
                    expected++;
                }
                last_x = x;
            }
            last_z = z;
        }
        TEST_CHECK(count >= expected && count <= expected + 2); // a tie of depth may go either way
        found += count;
        free(samples);
        fixture_compact_free(&compact);
        fixture_map_free(&map);
    }
    TEST_CHECK(found > 2000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(errors_by_brute_force),
        cmocka_unit_test(full_patch),
        cmocka_unit_test(positions_by_brute_force),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
