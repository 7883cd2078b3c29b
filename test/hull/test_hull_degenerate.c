// SPDX-License-Identifier: MIT
//
// What a hull build answers to input without volume and to bad input: a row each, with the default flatness, exactly
// decided, and made thick on request. The rows are those of docs/guide/hulls.md, word for word.

#include "talus_test.h"

#include "hull_shapes.h"

#include <talus/hull.h>

#include <float.h>
#include <string.h>

enum { CAPACITY = 64 };

typedef struct input {
    const char *name;
    void (*make)(tl_vec3 *points, uint32_t count);
    uint32_t count;
    tl_result results[3]; // defaults; flatness 0; thickness a quarter of the size
} input;

static void make_one_place(tl_vec3 *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_vec3_make(0.1f, -0.2f, 0.3f);
    }
}

// One point and its neighbours among the floats.
static void make_one_ulp(tl_vec3 *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_vec3_make(i & 1 ? 1.0f : nextafterf(1.0f, 2.0f), i & 2 ? 1.0f : nextafterf(1.0f, 2.0f),
                                 i & 4 ? 1.0f : nextafterf(1.0f, 2.0f));
    }
}

static void make_line(tl_vec3 *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(tl_vec3_make(1.0f, 2.0f, 3.0f), (float)(i % 7) / 8.0f);
    }
}

static void make_rounded_line(tl_vec3 *points, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(tl_vec3_make(0.3f, 0.7f, 0.1f), (float)i / 31.0f);
    }
}

static void make_plane(tl_vec3 *points, uint32_t count)
{
    test_random random = { 5 };
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_vec3_make(test_random_range(&random, -1, 1), 3.0f, test_random_range(&random, -1, 1));
    }
}

static void make_rounded_plane(tl_vec3 *points, uint32_t count)
{
    test_random random = { 6 };
    tl_vec3 u = test_random_direction(&random), v = test_random_direction(&random);
    for (uint32_t i = 0; i < count; i++) {
        float s = test_random_range(&random, -1, 1), t = test_random_range(&random, -1, 1);
        points[i] = tl_add(tl_vec3_make(7, 5, 3), tl_add(tl_scale(u, s), tl_scale(v, t)));
    }
}

static void make_sphere(tl_vec3 *points, uint32_t count)
{
    test_random random = { 7 };
    shape_make(SHAPE_SPHERE, &random, points, count);
}

static void make_far_sphere(tl_vec3 *points, uint32_t count)
{
    make_sphere(points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i].x += 1e9f;
    }
}

static void make_denormals(tl_vec3 *points, uint32_t count)
{
    make_sphere(points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(points[i], 1e-42f);
    }
}

static void make_largest(tl_vec3 *points, uint32_t count)
{
    make_sphere(points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i] = tl_scale(points[i], 0.99e30f);
    }
}

static void make_too_large(tl_vec3 *points, uint32_t count)
{
    make_sphere(points, count);
    points[3].z = 1.01e30f;
}

static void make_nan(tl_vec3 *points, uint32_t count)
{
    make_sphere(points, count);
    points[3].y = NAN;
}

static void make_infinity(tl_vec3 *points, uint32_t count)
{
    make_sphere(points, count);
    points[3].x = -INFINITY;
}

static void make_repeated(tl_vec3 *points, uint32_t count)
{
    make_sphere(points, count);
    for (uint32_t i = 0; i < count; i++) {
        points[i] = points[i % 6];
    }
}

static void make_chip(tl_vec3 *points, uint32_t count)
{
    make_plane(points, count);
    points[count - 1].y = nextafterf(3.0f, 4.0f);
}

static const input inputs[] = {
    { "no point", make_sphere, 0, { TL_ERR_EMPTY, TL_ERR_EMPTY, TL_ERR_EMPTY } },
    { "NaN", make_nan, 20, { TL_ERR_NOT_FINITE, TL_ERR_NOT_FINITE, TL_ERR_NOT_FINITE } },
    { "infinity", make_infinity, 20, { TL_ERR_NOT_FINITE, TL_ERR_NOT_FINITE, TL_ERR_NOT_FINITE } },
    { "a coordinate above 1e30", make_too_large, 20, { TL_ERR_RANGE, TL_ERR_RANGE, TL_ERR_RANGE } },
    { "2^28 points", make_sphere, TL_MAX_HULL_POINTS, { TL_ERR_LIMIT, TL_ERR_LIMIT, TL_ERR_LIMIT } },
    { "one point", make_one_place, 1, { TL_ERR_COINCIDENT, TL_ERR_COINCIDENT, TL_OK } },
    { "many points at one place", make_one_place, 30, { TL_ERR_COINCIDENT, TL_ERR_COINCIDENT, TL_OK } },
    { "a point and its neighbours among the floats", make_one_ulp, 8, { TL_ERR_COINCIDENT, TL_OK, TL_OK } },
    { "a ball 1e9 radii away", make_far_sphere, 30, { TL_ERR_COINCIDENT, TL_ERR_COPLANAR, TL_OK } },
    { "two points", make_line, 2, { TL_ERR_COLLINEAR, TL_ERR_COLLINEAR, TL_OK } },
    { "a line, some points twice", make_line, 30, { TL_ERR_COLLINEAR, TL_ERR_COLLINEAR, TL_OK } },
    { "a line, rounded", make_rounded_line, 30, { TL_ERR_COLLINEAR, TL_OK, TL_OK } },
    { "three points", make_plane, 3, { TL_ERR_COPLANAR, TL_ERR_COPLANAR, TL_OK } },
    { "a plane", make_plane, 30, { TL_ERR_COPLANAR, TL_ERR_COPLANAR, TL_OK } },
    { "a tilted plane, rounded", make_rounded_plane, 30, { TL_ERR_COPLANAR, TL_OK, TL_OK } },
    { "a plane and a point one float above it", make_chip, 30, { TL_ERR_COPLANAR, TL_OK, TL_OK } },
    { "six points, ten times each", make_repeated, 60, { TL_OK, TL_OK, TL_OK } },
    { "a ball of denormal size", make_denormals, 60, { TL_OK, TL_OK, TL_OK } },
    { "a ball of the largest size", make_largest, 60, { TL_OK, TL_OK, TL_OK } },
};

static float largest_size(const tl_vec3 *points, uint32_t count)
{
    float size = 0.0f;
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 p = tl_abs(points[i]);
        size = tl_maxf(size, tl_maxf(p.x, tl_maxf(p.y, p.z)));
    }
    return isfinite(size) && size > 0.0f ? size : 1.0f;
}

static void prove(const tl_hull *hull, const tl_vec3 *points, uint32_t count, bool thickened)
{
    TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
    TEST_RESULT(tl_hull_validate(hull, NULL, 0, NULL), TL_OK);
    // Points of a flat cloud lie on the end faces of what it was thickened to, and those were rounded.
    tl_hull_validation found;
    tl_hull_validate(hull, points, count, &found);
    TEST_CHECK(found.max_outside <= (thickened ? 1e-6 * (double)largest_size(points, count) : 0.0));
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        TEST_CHECK(tl_hull_source(hull, v) < count);
    }
}

static tl_result ask(const input *in, const tl_vec3 *points, int way)
{
    tl_hull_def def = tl_default_hull_def();
    def.flatness = way == 1 ? 0.0f : def.flatness;
    def.thickness = way == 2 ? 0.25f * largest_size(points, in->count < CAPACITY ? in->count : CAPACITY) : 0.0f;
    tl_hull *hull;
    tl_hull_report report;
    tl_result result = tl_hull_bake(points, in->count, &def, &hull, &report);
    if (result == TL_OK) {
        TEST_CHECK(report.thickened == (in->results[0] != TL_OK && way == 2));
        prove(hull, points, in->count, report.thickened);
        tl_blob_free(hull);
    } else {
        TEST_CHECK(hull == NULL && report.base.advice != NULL);
        bool a_point = result == TL_ERR_NOT_FINITE || result == TL_ERR_RANGE;
        TEST_CHECK(report.base.element_index == (a_point ? 3 : TL_NO_ELEMENT));
    }
    return result;
}

static char *read_doc(void)
{
    FILE *file = fopen(TALUS_SOURCE_DIR "/docs/guide/hulls.md", "r");
    TEST_CHECK(file != NULL);
    char *text = calloc(1, 65536);
    TEST_CHECK(fread(text, 1, 65535, file) > 0);
    fclose(file);
    return text;
}

static void test_degenerate_input_has_a_name(void **state)
{
    (void)state;
    tl_vec3 points[CAPACITY];
    char *doc = read_doc();
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        const input *in = &inputs[i];
        in->make(points, in->count < CAPACITY ? in->count : CAPACITY);
        char line[256];
        int length = snprintf(line, sizeof line, "| %s |", in->name);
        for (int way = 0; way < 3; way++) {
            tl_result result = ask(in, points, way);
            TEST_RESULT(result, in->results[way]);
            bool solid = result == TL_OK;
            length += snprintf(line + length, sizeof line - (size_t)length, " %s%s%s |", solid ? "" : "`",
                               solid ? "a hull" : tl_result_name(result), solid ? "" : "`");
        }
        print_message("%s\n", line);
        TEST_CHECK(strstr(doc, line) != NULL);
    }
    free(doc);
}

static void test_a_thickness_lost_in_rounding_is_none(void **state)
{
    (void)state;
    tl_vec3 points[30];
    make_plane(points, 30);
    tl_hull_def def = tl_default_hull_def();
    def.thickness = 1e-20f;
    tl_hull *hull;
    TEST_RESULT(tl_hull_bake(points, 30, &def, &hull, NULL), TL_ERR_COPLANAR);
}

// What is baked passes its own check; the rest is refused by the field's name.
static void test_a_thickness_out_of_range_is_refused(void **state)
{
    (void)state;
    tl_vec3 points[30];
    uint32_t baked = 0, refused = 0;
    for (uint32_t rank = 0; rank < 3; rank++) {
        make_plane(points, 30);
        for (uint32_t i = 0; i < 30 && rank < 2; i++) {
            points[i] = rank == 0 ? points[0] : tl_scale(points[0], (float)i);
        }
        for (float thickness = 1.0f; thickness < 1e38f; thickness *= 10.0f) {
            tl_hull_def def = tl_default_hull_def();
            def.thickness = thickness;
            tl_hull *hull;
            tl_hull_report report;
            tl_result result = tl_hull_bake(points, 30, &def, &hull, &report);
            if (result == TL_OK) {
                TEST_RESULT(tl_hull_check(hull, hull->blob.size, NULL), TL_OK);
                tl_blob_free(hull);
                baked++;
            } else if (thickness > 1e30f) {
                TEST_RESULT(result, TL_ERR_RANGE);
                TEST_CHECK(strcmp(report.base.field, "thickness") == 0);
                refused++;
            }
        }
    }
    TEST_CHECK(baked > 20 && refused > 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_degenerate_input_has_a_name),
        cmocka_unit_test(test_a_thickness_lost_in_rounding_is_none),
        cmocka_unit_test(test_a_thickness_out_of_range_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
