// SPDX-License-Identifier: MIT

#include "io/text/contour_text.h"
#include "io/text/polygon_text_write.h"

#include "polygon_shapes.h"
#include "polygon_text.h"

#include <talus/polygon.h>

enum { TEXT_BYTES = 1 << 16 };

typedef struct buffer {
    char bytes[TEXT_BYTES];
    size_t size;
    size_t limit;
} buffer;

static buffer first, second;

static tl_result into_buffer(const char *bytes, size_t size, void *user)
{
    buffer *b = user;
    if (b->limit != 0 && b->size + size > b->limit) {
        return TL_ERR_IO;
    }
    TEST_CHECK(b->size + size <= TEXT_BYTES);
    memcpy(b->bytes + b->size, bytes, size);
    b->size += size;
    return TL_OK;
}

static tl_text_reader reader_of(const char *bytes, size_t size)
{
    tl_text_reader reader = { bytes, size, "set.txt", NULL, 0, 0 };
    return reader;
}

static const char two_contours[] = "navcontours 1\n"
                                   "name a level of two\n"
                                   "cs 0.300000012\n"
                                   "ch 0.200000003\n"
                                   "bmin -1.5 2 1e-3\r\n"
                                   "bmax 10 20 30\n"
                                   "width 20\n"
                                   "height 30\n"
                                   "border 5\n"
                                   "maxerror 1.29999995\n"
                                   "nvp 6\n"
                                   "contours 2\n"
                                   "c 0 7 63 3\n"
                                   "0 1 2 131072\n"
                                   "-4 5 6 65536\n"
                                   "7 8 9 0\n"
                                   "\n"
                                   "c 1 8 1 0\n"
                                   "end\n";

static void reads_what_the_text_says(void **state)
{
    (void)state;
    tl_text_reader reader = reader_of(two_contours, sizeof two_contours - 1);
    tl_contour_text text;
    TEST_CHECK(!tl_text_reader_at_end(&reader));
    TEST_RESULT(tl_contour_text_read(&reader, &text, NULL), TL_OK);
    TEST_CHECK(tl_text_reader_at_end(&reader));
    TEST_CHECK(strcmp(text.name, "a level of two") == 0 && text.max_verts_per_poly == 6);
    TEST_CHECK(text.set.cell_size == 0.3f && text.set.cell_height == 0.2f && text.set.max_error == 1.3f);
    TEST_CHECK(text.set.bounds.min.x == -1.5f && text.set.bounds.min.z == 1e-3f && text.set.bounds.max.z == 30.0f);
    TEST_CHECK(text.set.width == 20 && text.set.height == 30 && text.set.border_size == 5);
    TEST_CHECK(text.set.contour_count == 2 && text.set.vertex_count == 3);
    TEST_CHECK(text.set.contours[0].region == 7 && text.set.contours[0].area == 63);
    TEST_CHECK(text.set.contours[1].first_vertex == 3 && text.set.contours[1].vertex_count == 0);
    TEST_CHECK(text.set.vertices[1].x == -4 && text.set.vertices[1].flags == TL_CONTOUR_BORDER_VERTEX);
    tl_contour_text_free(&text);
    tl_contour_text_free(&text);
}

static void sets_follow_one_another(void **state)
{
    (void)state;
    char both[2 * sizeof two_contours];
    memcpy(both, two_contours, sizeof two_contours - 1);
    memcpy(both + sizeof two_contours - 1, two_contours, sizeof two_contours - 1);
    tl_text_reader reader = reader_of(both, 2 * (sizeof two_contours - 1));
    uint32_t sets = 0;
    for (; !tl_text_reader_at_end(&reader); sets++) {
        tl_contour_text text;
        TEST_RESULT(tl_contour_text_read(&reader, &text, NULL), TL_OK);
        TEST_CHECK(text.set.contour_count == 2 && text.set.vertex_count == 3);
        tl_contour_text_free(&text);
    }
    TEST_CHECK(sets == 2);
}

static void meshes_come_back_as_written(void **state)
{
    (void)state;
    oracle_point points[512];
    tl_contour_vertex vertices[512];
    tl_contour contour;
    uint32_t n = shape_holes(points, 4, 4);
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    set.width = set.height = 50;
    set.border_size = 2;
    tl_polygon_def def = tl_default_polygon_def();
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_OK);
    first.size = second.size = first.limit = second.limit = 0;
    TEST_RESULT(tl_polygon_text_write(&mesh, "a\nb", "talus", 3, 12.5, into_buffer, &first), TL_OK);
    tl_text_reader reader = reader_of(first.bytes, first.size);
    polygon_text text;
    TEST_RESULT(polygon_text_read(&reader, &text, NULL), TL_OK);
    TEST_CHECK(strcmp(text.name, "a b") == 0 && strcmp(text.producer, "talus") == 0 && text.ok);
    TEST_CHECK(text.bad_triangulations == 3 && text.cpu_us == 12.5);
    TEST_CHECK(text.mesh.polygon_count == mesh.polygon_count && text.mesh.index_count == mesh.index_count);
    TEST_CHECK(memcmp(text.mesh.indices, mesh.indices, mesh.index_count * sizeof *mesh.indices) == 0);
    TEST_CHECK(memcmp(text.mesh.neighbours, mesh.neighbours, mesh.index_count * sizeof *mesh.indices) == 0);
    TEST_CHECK(memcmp(text.mesh.vertices, mesh.vertices, 3 * mesh.vertex_count * sizeof *mesh.vertices) == 0);
    TEST_RESULT(tl_polygon_mesh_check(&text.mesh, NULL, NULL, NULL), TL_OK);
    TEST_RESULT(tl_polygon_text_write(&text.mesh, text.name, text.producer, 3, 12.5, into_buffer, &second), TL_OK);
    TEST_CHECK(first.size == second.size && memcmp(first.bytes, second.bytes, first.size) == 0);
    polygon_text_free(&text);
    // A sink that takes no more.
    second.size = 0;
    second.limit = 100;
    TEST_RESULT(tl_polygon_text_write(&mesh, "a", "talus", 0, 0.0, into_buffer, &second), TL_ERR_IO);
    tl_polygon_mesh_free(&mesh);
}

static void every_prefix_is_refused(void **state)
{
    (void)state;
    oracle_point points[64];
    tl_contour_vertex vertices[64];
    tl_contour contour;
    uint32_t n = shape_holes(points, 1, 1);
    tl_contour_set set = shape_as_set(points, n, vertices, &contour);
    tl_polygon_def def = tl_default_polygon_def();
    tl_polygon_mesh mesh;
    TEST_RESULT(tl_polygon_mesh_bake(&set, &def, &mesh, NULL), TL_OK);
    first.size = first.limit = 0;
    TEST_RESULT(tl_polygon_text_write(&mesh, "a", "talus", 0, 0.0, into_buffer, &first), TL_OK);
    tl_polygon_mesh_free(&mesh);
    const char *texts[2] = { two_contours, first.bytes };
    const size_t sizes[2] = { sizeof two_contours - 1, first.size };
    uint32_t truncated = 0;
    for (uint32_t kind = 0; kind < 2; kind++) {
        // The last line end may be missing.
        for (size_t size = 0; size + 1 < sizes[kind]; size++) {
            char *copy = malloc(size + 1);
            memcpy(copy, texts[kind], size);
            tl_text_reader reader = reader_of(copy, size);
            tl_io_error error;
            memset(&error, 0, sizeof error);
            tl_contour_text contours;
            polygon_text polygons;
            tl_result result = kind == 0 ? tl_contour_text_read(&reader, &contours, &error)
                                         : polygon_text_read(&reader, &polygons, &error);
            TEST_CHECK(result != TL_OK && error.result == result && error.message[0] != '\0');
            truncated += result == TL_ERR_TRUNCATED;
            free(copy);
        }
    }
    TEST_CHECK(truncated > 50);
}

static void expect_error(const char *text, bool polygons, tl_result expected, uint64_t line)
{
    tl_text_reader reader = reader_of(text, strlen(text));
    tl_io_error error;
    memset(&error, 0, sizeof error);
    tl_contour_text contours;
    polygon_text mesh;
    tl_result result =
        polygons ? polygon_text_read(&reader, &mesh, &error) : tl_contour_text_read(&reader, &contours, &error);
    if (result != expected || error.line != line || strcmp(error.path, "set.txt") != 0) {
        fail_msg("'%s' gives %s at line %llu: %s", text, tl_result_name(result), (unsigned long long)error.line,
                 error.message);
    }
}

static void errors_name_the_line(void **state)
{
    (void)state;
    expect_error("", false, TL_ERR_TRUNCATED, 0);
    expect_error("navpolys 1\n", false, TL_ERR_MAGIC, 1);
    expect_error("\n\nnavcontours 2\n", false, TL_ERR_VERSION, 3);
    expect_error("navcontours 1\ncs nan\n", false, TL_ERR_FORMAT, 2);
    expect_error("navcontours 1\ncs 0\n", false, TL_ERR_FORMAT, 2);
    expect_error("navcontours 1\ncs 1e99\n", false, TL_ERR_FORMAT, 2);
    expect_error("navcontours 1\nwidth 1.5\n", false, TL_ERR_FORMAT, 2);
    expect_error("navcontours 1\nwidth -1\n", false, TL_ERR_FORMAT, 2);
    expect_error("navcontours 1\nwidth 99999999999999999999\n", false, TL_ERR_FORMAT, 2);
    expect_error("navcontours 1\ncolour 3\n", false, TL_ERR_FORMAT, 2);
    expect_error("navcontours 1\nch 1\ncontours 0\nend\n", false, TL_ERR_FORMAT, 3);
    expect_error("navcontours 1\ncs 1\nch 1\ncontours 1\nend\n", false, TL_ERR_FORMAT, 5);
    expect_error("navcontours 1\ncs 1\nch 1\ncontours 1\nc 0 0 0 1\n1 2 3\nend\n", false, TL_ERR_FORMAT, 6);
    expect_error("navcontours 1\ncs 1\nch 1\ncontours 1\nc 0 0 0 1\n1 2 536870913 0\nend\n", false, TL_ERR_FORMAT, 6);
    expect_error("navcontours 1\ncs 1\nch 1\ncontours 0\nc 0 0 0 0\nend\n", false, TL_ERR_FORMAT, 5);
    expect_error("navcontours 1\ncs 1\nch 1\ncontours 4000000000\nend\n", false, TL_ERR_FORMAT, 5);
    expect_error("navpolys 1\nverts 1\npolys 1\nv 0 0\n", true, TL_ERR_FORMAT, 4);
    expect_error("navpolys 1\nverts 1\npolys 1\nv 0 0 0\np 0 0 1 1 | -1\n", true, TL_ERR_FORMAT, 5);
    expect_error("navpolys 1\nverts 1\npolys 1\nv 0 0 0\np 0 0 1 0 | 1\n", true, TL_ERR_FORMAT, 5);
    expect_error("navpolys 1\nverts 1\npolys 1\nv 0 0 0\np 0 0 1 0 | x4\n", true, TL_ERR_FORMAT, 5);
    expect_error("navpolys 1\nverts 1\npolys 1\nv 0 0 0\np 0 0 4000000000 0 | -1\n", true, TL_ERR_FORMAT, 5);
    expect_error("navpolys 1\nverts 1\npolys 1\nv 0 0 0\np 0 0 1 0 | x3 -1\n", true, TL_ERR_FORMAT, 5);
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static const char mesh_text[] =
        "navpolys 1\nverts 3\npolys 1\nv 0 0 0\nv 0 0 4\nv 4 0 0\np 1 2 3 0 1 2 | -1 x0 -1\nend";
    for (uint32_t kind = 0; kind < 2; kind++) {
        tl_result result = TL_ERR_MEMORY;
        uint64_t fail_at = 1;
        for (; result == TL_ERR_MEMORY; fail_at++) {
            test_allocator allocator;
            test_allocator_init(&allocator, fail_at);
            tl_text_reader reader = kind == 0 ? reader_of(two_contours, sizeof two_contours - 1)
                                              : reader_of(mesh_text, sizeof mesh_text - 1);
            reader.allocator = &allocator.allocator;
            if (kind == 0) {
                tl_contour_text text;
                result = tl_contour_text_read(&reader, &text, NULL);
                tl_contour_text_free(&text);
            } else {
                polygon_text text;
                result = polygon_text_read(&reader, &text, NULL);
                TEST_CHECK(result != TL_OK || text.mesh.neighbours[1] == (TL_PORTAL | 0u));
                polygon_text_free(&text);
            }
            TEST_CHECK(allocator.live_blocks == 0);
        }
        TEST_RESULT(result, TL_OK);
        TEST_CHECK(fail_at > 3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_what_the_text_says),    cmocka_unit_test(sets_follow_one_another),
        cmocka_unit_test(meshes_come_back_as_written), cmocka_unit_test(every_prefix_is_refused),
        cmocka_unit_test(errors_name_the_line),        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
