// SPDX-License-Identifier: MIT
//
// Points from text, from cloud lists and from meshes.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/files/atomic_write.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/point_cloud.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static tl_result parse(const char *text, size_t size, tl_point_clouds *clouds, tl_io_error *error)
{
    // A block of exactly that size, so that the sanitizer sees each byte read behind it.
    char *exact = malloc(size > 0 ? size : 1);
    memcpy(exact, text, size);
    memset(error, 0, sizeof *error);
    tl_result result = tl_point_clouds_parse(exact, size, "points.txt", NULL, clouds, error);
    free(exact);
    TEST_CHECK(result == TL_OK ? clouds->cloud_count >= 1 && clouds->first_points[0] == 0 &&
                                     clouds->first_points[clouds->cloud_count] == clouds->point_count
                               : clouds->points == NULL && error->result == result && error->message[0] != '\0');
    return result;
}

static tl_point_clouds parse_good(const char *text)
{
    tl_point_clouds clouds;
    tl_io_error error;
    if (parse(text, strlen(text), &clouds, &error) != TL_OK) {
        fail_msg("'%s': %s", text, error.message);
    }
    return clouds;
}

static void test_points(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "1 2 3\n-4 .5 6e1\n",
        "1 2 3\n-4 .5 6e1",
        "1 2 3\r\n-4 .5 6e1\r\n",
        "1 2 3\r-4 .5 6e1\r",
        "\xef\xbb\xbf# points\n\n\t1\t2  3  # first\n   \n#\n-4,.5, 6e1\n\n",
        "1,2,3\n-4,.5,60\n",
        "1 2 3\n-4 .5 60\n# a comment at the end that is long enough to be the whole last section of it",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        tl_point_clouds clouds = parse_good(texts[i]);
        TEST_CHECK(clouds.cloud_count == 1 && clouds.point_count == 2);
        tl_point_cloud cloud = tl_point_clouds_get(&clouds, 0);
        TEST_CHECK(cloud.count == 2 && cloud.points[0].x == 1 && cloud.points[0].y == 2 && cloud.points[0].z == 3);
        TEST_CHECK(cloud.points[1].x == -4 && cloud.points[1].y == 0.5f && cloud.points[1].z == 60);
        tl_point_clouds_free(&clouds);
        tl_point_clouds_free(&clouds);
    }
}

static void test_clouds(void **state)
{
    (void)state;
    tl_point_clouds clouds = parse_good("# three\n2\n1 2 3\n4 5 6\n0\n\n 1 # one\n7 8 9\n");
    TEST_CHECK(clouds.cloud_count == 3 && clouds.point_count == 3);
    TEST_CHECK(tl_point_clouds_get(&clouds, 0).count == 2 && tl_point_clouds_get(&clouds, 1).count == 0 &&
               tl_point_clouds_get(&clouds, 2).count == 1);
    TEST_CHECK(tl_point_clouds_get(&clouds, 2).points[0].y == 8);
    tl_point_clouds_free(&clouds);
    clouds = parse_good("0\n");
    TEST_CHECK(clouds.cloud_count == 1 && clouds.point_count == 0);
    tl_point_clouds_free(&clouds);
}

typedef struct bad_text {
    const char *text;
    tl_result result;
    uint64_t line;
    const char *message; // part of it
} bad_text;

static void test_bad_texts(void **state)
{
    (void)state;
    static const bad_text texts[] = {
        { "", TL_ERR_EMPTY, 0, "no points" },
        { "# nothing\n\n", TL_ERR_EMPTY, 0, "no points" },
        { "1 2 3\n1 2\n", TL_ERR_FORMAT, 2, "2 numbers" },
        { "1 2 3\n1\n", TL_ERR_FORMAT, 2, "1 number where" },
        { "1 2 3 4\n", TL_ERR_FORMAT, 1, "'4' is a number too many" },
        { "1 2 x\n", TL_ERR_FORMAT, 1, "'x'" },
        { "1 2 3x\n", TL_ERR_FORMAT, 1, "'3x'" },
        { "1 2 3\\\n", TL_ERR_FORMAT, 1, "'3\\'" },
        { "1 2 nan\n", TL_ERR_NOT_FINITE, 1, "'nan'" },
        { "1 -inf 2\n", TL_ERR_NOT_FINITE, 1, "'-inf'" },
        { "1 2 1e39\n", TL_ERR_RANGE, 1, "'1e39'" },
        { "2\n1 2 3\n", TL_ERR_TRUNCATED, 0, "announces 2 points and has 1" },
        { "2\n1 2 3\n1\n", TL_ERR_FORMAT, 3, "1 number where" },
        { "1\n1 2 3\n4 5 6\n", TL_ERR_FORMAT, 3, "3 numbers where a cloud's count" },
        { "1.5\n1 2 3\n", TL_ERR_FORMAT, 1, "'1.5' is no count" },
        { "-1\n1 2 3\n", TL_ERR_FORMAT, 1, "'-1' is no count" },
        { "2000000000\n1 2 3\n", TL_ERR_TRUNCATED, 0, "announces 2000000000 points" },
        { "99999999999999999999\n1 2 3\n", TL_ERR_LIMIT, 1, "more than" },
        { "1 2\n", TL_ERR_FORMAT, 1, "2 numbers" },
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        tl_point_clouds clouds;
        tl_io_error error;
        tl_result result = parse(texts[i].text, strlen(texts[i].text), &clouds, &error);
        if (result != texts[i].result || error.line != texts[i].line ||
            strstr(error.message, texts[i].message) == NULL) {
            fail_msg("text %zu: %s, line %llu: %s", i, tl_result_name(result), (unsigned long long)error.line,
                     error.message);
        }
    }
}

static void test_every_prefix_and_allocation(void **state)
{
    (void)state;
    char text[4096] = "# clouds\r\n";
    size_t size = strlen(text);
    for (int i = 0; i < 40; i++) {
        size += (size_t)sprintf(text + size, "2 \n%d.5 2 -3e1\n4 5,6 # and\n", i);
    }
    tl_point_clouds clouds;
    tl_io_error error;
    uint32_t good = 0;
    for (size_t i = 0; i <= size; i++) {
        tl_result result = parse(text, i, &clouds, &error);
        TEST_CHECK(result == TL_OK || result == TL_ERR_EMPTY || result == TL_ERR_FORMAT || result == TL_ERR_TRUNCATED);
        good += result == TL_OK;
        tl_point_clouds_free(&clouds);
    }
    TEST_CHECK(good > 100 && good < size - 500);

    uint64_t calls = 0;
    for (uint64_t fail_at = 0; fail_at <= calls; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        tl_import_options options = tl_default_import_options();
        options.host.allocator = &allocator.allocator;
        tl_result result = tl_point_clouds_parse(text, size, NULL, &options, &clouds, NULL);
        TEST_RESULT(result, fail_at == 0 ? TL_OK : TL_ERR_MEMORY);
        TEST_CHECK(fail_at != 0 || clouds.point_count == 80);
        calls = fail_at == 0 ? allocator.calls : calls;
        tl_point_clouds_free(&clouds);
        TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
    }
    TEST_CHECK(calls >= 4);
}

static void check_read(const char *name, const char *text, const tl_import_options *options, uint32_t clouds_expected,
                       uint32_t points_expected, tl_vec3 last)
{
    char path[128];
    snprintf(path, sizeof path, "/tmp/talus_points_%d_%s", (int)getpid(), name);
    TEST_RESULT(tl_atomic_write(path, text, strlen(text), NULL), TL_OK);
    tl_point_clouds clouds;
    tl_io_error error;
    tl_result result = tl_point_clouds_read(path, options, &clouds, &error);
    if (result != TL_OK) {
        fail_msg("%s: %s", name, error.message);
    }
    TEST_CHECK(clouds.cloud_count == clouds_expected && clouds.point_count == points_expected);
    TEST_CHECK(memcmp(&clouds.points[points_expected - 1], &last, sizeof last) == 0);
    tl_point_clouds_free(&clouds);
    unlink(path);
}

static void test_files(void **state)
{
    (void)state;
    tl_import_options options = tl_default_import_options();
    options.up_axis = TL_UP_Z;
    options.unit_scale = 2.0f;
    tl_vec3 last = { 7, 8, 9 };
    tl_vec3 turned = { 14, 18, -16 };
    const char *obj = "v 1 2 3\nv 7 8 9\n";
    check_read("a.obj", obj, NULL, 1, 2, last);
    check_read("a.obj", "v 1 2 3\nv 4 5 6\nv 7 8 9\nf 1 2 3\n", &options, 1, 3, turned);
    check_read("a.txt", "1 2 3\n7 8 9\n", NULL, 1, 2, last);
    check_read("a.txt", "1\n1 2 3\n1\n7 8 9\n", &options, 2, 2, turned);
    check_read("a", obj, NULL, 1, 2, last);
    check_read("a.xyz", "# x\n+7 8 9", NULL, 1, 1, last);
    check_read("a.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 1\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n4 5 6\n7 8 9\n3 0 1 2\n",
               NULL, 1, 3, last);
    tl_point_clouds clouds;
    tl_io_error error;
    TEST_RESULT(tl_point_clouds_read("/missing/points.txt", NULL, &clouds, &error), TL_ERR_IO);
    options.unit_scale = -1.0f;
    TEST_RESULT(tl_point_clouds_parse("1 2 3", 5, "x", &options, &clouds, &error), TL_ERR_ARGUMENT);
}

static void test_real_clouds(void **state)
{
    (void)state;
    const char *path = TALUS_DATA_DIR "/hulls/hulls_dev.txt";
    if (access(path, R_OK) != 0) {
        skip();
    }
    tl_point_clouds clouds;
    TEST_RESULT(tl_point_clouds_read(path, NULL, &clouds, NULL), TL_OK);
    FILE *file = fopen(path, "r");
    uint32_t index = 0;
    for (unsigned count; fscanf(file, "%u", &count) == 1; index++) {
        tl_point_cloud cloud = tl_point_clouds_get(&clouds, index);
        TEST_CHECK(cloud.count == count);
        for (unsigned i = 0; i < count; i++) {
            tl_vec3 point;
            TEST_CHECK(fscanf(file, "%f %f %f", &point.x, &point.y, &point.z) == 3);
            TEST_CHECK(memcmp(&point, &cloud.points[i], sizeof point) == 0);
        }
    }
    fclose(file);
    TEST_CHECK(index == clouds.cloud_count && index > 1000);
    tl_point_clouds_free(&clouds);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points),    cmocka_unit_test(test_clouds),
        cmocka_unit_test(test_bad_texts), cmocka_unit_test(test_every_prefix_and_allocation),
        cmocka_unit_test(test_files),     cmocka_unit_test(test_real_clouds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
