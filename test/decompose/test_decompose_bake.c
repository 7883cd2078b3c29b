// SPDX-License-Identifier: MIT
//
// Decompositions held to what they promise: valid hulls, all of the mesh within them up to max_outside, no point of
// them farther from the body than their concavity, by samples that know nothing of grids and proofs; few parts where
// the right number is plain; the same bytes with any number of tasks.

#include "decompose_shapes.h"
#include "task_threads.h"

#include <string.h>
#include <talus/decompose.h>
#include <talus/soup.h>

enum { SAMPLES_A_TRIANGLE = 6, SAMPLES_A_PART = 3000 };

static test_shape shape;

static void clear_shape(void)
{
    shape.vertex_count = shape.triangle_count = 0;
}

// How far a point lies outside of the nearest hull at least: heights over planes are no more than the distance.
static double outside_of_all(const tl_decomposition *d, tl_vec3 p)
{
    double nearest = (double)INFINITY;
    for (uint32_t i = 0; i < d->part_count; i++) {
        double height = -(double)INFINITY;
        for (uint32_t f = 0; f < d->parts[i].hull->face_count; f++) {
            const tl_hull_plane plane = tl_hull_face_plane(d->parts[i].hull, f);
            height = fmax(height, plane.normal[0] * (double)p.x + plane.normal[1] * (double)p.y +
                                      plane.normal[2] * (double)p.z - plane.offset);
        }
        nearest = fmin(nearest, height);
    }
    return nearest;
}

// A random point of the convex hull of some points.
static tl_vec3 mixed_point(const tl_vec3 *points, uint32_t count, test_random *random)
{
    tl_vec3 p = points[test_random_below(random, count)];
    for (uint32_t i = 0; i < 3; i++) {
        p = tl_lerp(p, points[test_random_below(random, count)], test_random_unit(random));
    }
    return p;
}

static void check_mesh_is_covered(const tl_decomposition *d, double noise, test_random *random)
{
    for (uint32_t i = 0; i < shape.triangle_count; i++) {
        const tl_vec3 c[3] = { shape.vertices[shape.indices[3 * i]], shape.vertices[shape.indices[3 * i + 1]],
                               shape.vertices[shape.indices[3 * i + 2]] };
        for (uint32_t k = 0; k < 3 + SAMPLES_A_TRIANGLE; k++) {
            const tl_vec3 p = k < 3 ? c[k] : mixed_point(c, 3, random);
            TEST_CHECK(outside_of_all(d, p) <= d->max_outside + noise);
        }
    }
}

// The largest distance of samples of a part from the body, which encloses space when `is_closed`.
static double sampled_concavity(const tl_hull *hull, const tl_soup *soup, bool is_closed, test_random *random)
{
    double largest = 0.0;
    for (uint32_t i = 0; i < SAMPLES_A_PART; i++) {
        const tl_vec3 p = mixed_point(tl_hull_vertices(hull), hull->vertex_count, random);
        tl_soup_location location;
        tl_soup_point nearest;
        if (is_closed && tl_soup_locate(soup, p, &location) == TL_OK && location.side != TL_SOUP_OUTSIDE) {
            continue;
        }
        TEST_RESULT(tl_soup_nearest(soup, p, INFINITY, NULL, &nearest), TL_OK);
        largest = fmax(largest, (double)nearest.distance);
    }
    return largest;
}

// Checks a decomposition of the shape against all that it says of itself.
static void check_decomposition(const tl_decomposition *d, const tl_decompose_report *report, bool is_closed)
{
    const tl_mesh_view view = shape_view(&shape);
    test_random random = { 11 };
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&view, NULL, &soup, NULL), TL_OK);
    const tl_aabb box = tl_soup_bounds(soup);
    const tl_vec3 size = tl_max(tl_abs(box.min), tl_abs(box.max));
    const double noise = 1e-6 * (double)tl_maxf(size.x, tl_maxf(size.y, size.z));
    double worst = 0.0, volume = 0.0;
    for (uint32_t i = 0; i < d->part_count; i++) {
        const tl_convex_part *part = &d->parts[i];
        TEST_RESULT(tl_hull_check(part->hull, part->hull->blob.size, NULL), TL_OK);
        TEST_CHECK(part->concavity <= d->concavity && part->max_outside <= d->max_outside);
        TEST_CHECK(sampled_concavity(part->hull, soup, is_closed, &random) <= part->concavity + noise);
        TEST_CHECK(i == 0 || part->hull->mass.volume <= d->parts[i - 1].hull->mass.volume * 1.000001);
        worst = fmax(worst, part->concavity);
        volume += part->hull->mass.volume;
    }
    TEST_CHECK(d->part_count > 0 && worst == d->concavity && volume == d->hull_volume);
    TEST_CHECK(report->parts_over_tolerance > 0 || d->concavity <= (double)report->tolerance);
    check_mesh_is_covered(d, noise, &random);
    tl_blob_free(soup);
}

// Decomposes the shape by a def, checks it and gives the number of parts.
static uint32_t decompose_and_check(const tl_decompose_def *def, bool is_closed)
{
    const tl_mesh_view view = shape_view(&shape);
    tl_decomposition d;
    tl_decompose_report report;
    TEST_RESULT(tl_decomposition_bake(&view, def, &d, &report), TL_OK);
    check_decomposition(&d, &report, is_closed);
    const uint32_t count = d.part_count;
    tl_decomposition_free(&d);
    return count;
}

static tl_decompose_def relative_def(float tolerance)
{
    tl_decompose_def def = tl_default_decompose_def();
    def.relative_tolerance = tolerance;
    def.max_vertices = 0;
    return def;
}

static const float L_OUTLINE[6][2] = { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };

static void plain_solids_get_as_many_parts_as_they_have(void **state)
{
    (void)state;
    const tl_decompose_def def = relative_def(0.02f);
    clear_shape();
    shape_box(&shape, tl_vec3_make(0, 0, 0), tl_vec3_make(1, 2, 3));
    assert_int_equal(decompose_and_check(&def, true), 1);
    clear_shape();
    shape_prism(&shape, L_OUTLINE, 6, 1.0f);
    assert_int_equal(decompose_and_check(&def, true), 2);
    shape_map(&shape, 1e-5f, tl_vec3_make(0, 0, 0));
    assert_int_equal(decompose_and_check(&def, true), 2);
    shape_map(&shape, 1e12f, tl_vec3_make(0, 0, 0));
    assert_int_equal(decompose_and_check(&def, true), 2);
    clear_shape(); // a table: a top on four legs
    shape_box(&shape, tl_vec3_make(0, 0, 2), tl_vec3_make(4, 3, 2.2f));
    for (uint32_t i = 0; i < 4; i++) {
        const tl_vec3 foot = tl_vec3_make((i & 1u) != 0 ? 3.6f : 0.0f, (i & 2u) != 0 ? 2.6f : 0.0f, 0.0f);
        shape_box(&shape, foot, tl_add(foot, tl_vec3_make(0.4f, 0.4f, 2.0f)));
    }
    assert_int_equal(decompose_and_check(&def, true), 5);
}

static void a_ring_keeps_its_hole(void **state)
{
    (void)state;
    clear_shape();
    shape_torus(&shape, 2.0f, 0.5f, 40, 16);
    const tl_mesh_view view = shape_view(&shape);
    const tl_decompose_def def = relative_def(0.03f);
    tl_decomposition d;
    tl_decompose_report report;
    TEST_RESULT(tl_decomposition_bake(&view, &def, &d, &report), TL_OK);
    check_decomposition(&d, &report, true);
    for (uint32_t i = 0; i < d.part_count; i++) {
        TEST_CHECK(!tl_hull_contains(d.parts[i].hull, tl_vec3_make(0, 0, 0)));
    }
    TEST_CHECK(d.part_count >= 6 && d.part_count <= 14);
    tl_decomposition_free(&d);
}

static void open_and_flat_surfaces_are_covered(void **state)
{
    (void)state;
    const tl_decompose_def def = relative_def(0.04f);
    clear_shape();
    shape_bowl(&shape, 1.0f, 24, 8);
    TEST_CHECK(decompose_and_check(&def, false) > 4);
    clear_shape(); // a floor with a hole, one triangle thick
    for (uint32_t i = 0; i < 9; i++) {
        const float x = (float)(i % 3), y = (float)(i / 3);
        if (i != 4) {
            const uint32_t a = shape_vertex(&shape, x, y, 0), b = shape_vertex(&shape, x + 1, y, 0);
            const uint32_t c = shape_vertex(&shape, x + 1, y + 1, 0), e = shape_vertex(&shape, x, y + 1, 0);
            shape_quad(&shape, a, b, c, e);
        }
    }
    const uint32_t count = decompose_and_check(&def, false);
    TEST_CHECK(count >= 3 && count <= 5);
}

static void loose_triangles_and_rubbish_are_covered(void **state)
{
    (void)state;
    test_random random = { 3 };
    for (uint32_t round = 0; round < 4; round++) {
        clear_shape();
        for (uint32_t i = 0; i < 30; i++) {
            const tl_vec3 at = test_random_point(&random, tl_vec3_make(0, 0, 0), tl_vec3_make(4, 4, 1));
            uint32_t corners[3];
            for (uint32_t k = 0; k < 3; k++) {
                const tl_vec3 p = tl_mul_add(at, test_random_direction(&random), round < 2 ? 0.5f : 1.5f);
                corners[k] = shape_vertex(&shape, p.x, p.y, p.z);
            }
            shape_triangle(&shape, corners[0], corners[1], corners[2]);
            shape_triangle(&shape, corners[0], corners[2], corners[1]); // from behind, too
            shape_triangle(&shape, corners[0], corners[0], corners[1]); // no area
        }
        const tl_decompose_def def = relative_def(round % 2 == 0 ? 0.1f : 0.05f);
        TEST_CHECK(decompose_and_check(&def, false) > 1);
    }
}

static void limits_of_parts_and_vertices_hold(void **state)
{
    (void)state;
    clear_shape();
    shape_torus(&shape, 2.0f, 0.5f, 40, 16);
    const tl_mesh_view view = shape_view(&shape);
    for (uint32_t most = 1; most <= 6; most++) {
        tl_decompose_def def = relative_def(0.03f);
        def.max_parts = most;
        def.max_vertices = 12;
        tl_decomposition d;
        tl_decompose_report report;
        TEST_RESULT(tl_decomposition_bake(&view, &def, &d, &report), TL_OK);
        check_decomposition(&d, &report, true);
        TEST_CHECK(d.part_count <= most && report.parts_over_tolerance > 0 && d.max_outside > 0.0);
        for (uint32_t i = 0; i < d.part_count; i++) {
            TEST_CHECK(d.parts[i].hull->vertex_count <= 12);
        }
        tl_decomposition_free(&d);
    }
}

// A closed room is filled, or stays open, as the def says.
static void rooms_are_solid_or_open(void **state)
{
    (void)state;
    clear_shape();
    shape_box(&shape, tl_vec3_make(0, 0, 0), tl_vec3_make(3, 3, 3));
    tl_decompose_def def = relative_def(0.05f);
    assert_int_equal(decompose_and_check(&def, true), 1);
    def.solid = TL_SOLID_SURFACE;
    const uint32_t walls = decompose_and_check(&def, false);
    TEST_CHECK(walls >= 6 && walls <= 12);
}

static void tasks_do_not_change_a_byte(void **state)
{
    (void)state;
    clear_shape();
    shape_torus(&shape, 2.0f, 0.4f, 32, 12);
    const tl_mesh_view view = shape_view(&shape);
    tl_decompose_def def = relative_def(0.04f);
    tl_decomposition one;
    TEST_RESULT(tl_decomposition_bake(&view, &def, &one, NULL), TL_OK);
    for (uint32_t workers = 2; workers <= 4; workers++) {
        uint32_t count = workers;
        const tl_tasks tasks = { run_on_threads, workers, &count };
        def.host.tasks = &tasks;
        tl_decomposition many;
        TEST_RESULT(tl_decomposition_bake(&view, &def, &many, NULL), TL_OK);
        assert_int_equal(one.part_count, many.part_count);
        for (uint32_t i = 0; i < one.part_count; i++) {
            TEST_CHECK(one.parts[i].concavity == many.parts[i].concavity);
            assert_int_equal(one.parts[i].hull->blob.size, many.parts[i].hull->blob.size);
            assert_memory_equal(one.parts[i].hull, many.parts[i].hull, (size_t)one.parts[i].hull->blob.size);
        }
        tl_decomposition_free(&many);
    }
    tl_decomposition_free(&one);
}

static void what_cannot_be_done_is_named(void **state)
{
    (void)state;
    clear_shape();
    shape_box(&shape, tl_vec3_make(0, 0, 0), tl_vec3_make(1, 1, 1));
    shape_map(&shape, 1.0f, tl_vec3_make(1e6f, 0, 0));
    tl_mesh_view view = shape_view(&shape);
    tl_decompose_def def = relative_def(0.01f);
    tl_decompose_report report;
    tl_decomposition d;
    TEST_RESULT(tl_decomposition_bake(&view, &def, &d, &report), TL_ERR_RANGE);
    assert_string_equal(report.base.field, "tolerance");
    def.tolerance = 10.0f;
    def.thickness = 10.5f;
    TEST_RESULT(tl_decomposition_bake(&view, &def, &d, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.base.field, "thickness");
    view.triangle_count = 0;
    TEST_RESULT(tl_decomposition_bake(&view, &def, &d, &report), TL_ERR_EMPTY);
    view.triangle_count = 1;
    const uint32_t flat[3] = { 0, 0, 1 };
    view.indices = flat;
    TEST_RESULT(tl_decomposition_bake(&view, &def, &d, &report), TL_ERR_DEGENERATE);
    TEST_CHECK(d.parts == NULL && d.part_count == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_solids_get_as_many_parts_as_they_have),
        cmocka_unit_test(a_ring_keeps_its_hole),
        cmocka_unit_test(open_and_flat_surfaces_are_covered),
        cmocka_unit_test(loose_triangles_and_rubbish_are_covered),
        cmocka_unit_test(limits_of_parts_and_vertices_hold),
        cmocka_unit_test(rooms_are_solid_or_open),
        cmocka_unit_test(tasks_do_not_change_a_byte),
        cmocka_unit_test(what_cannot_be_done_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
