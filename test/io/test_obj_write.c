// SPDX-License-Identifier: MIT
//
// OBJ out: what is written reads back bit by bit; a failure leaves no file.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/files/file_map.h"
#include "io/mesh/obj_reader.h"
#include "io/mesh/obj_write.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static char path[64];

static int make_path(void **state)
{
    (void)state;
    snprintf(path, sizeof path, "/tmp/talus_obj_write_%d.obj", (int)getpid());
    return 0;
}

static void check_content(const char *expected)
{
    tl_file_map map;
    TEST_RESULT(tl_file_map_open(path, 0, &map, NULL), TL_OK);
    if (map.size != strlen(expected) || memcmp(map.bytes, expected, map.size) != 0) {
        fail_msg("wrote:\n%.*s", (int)map.size, (const char *)map.bytes);
    }
    tl_file_map_close(&map);
    unlink(path);
}

static void test_text(void **state)
{
    (void)state;
    static const tl_vec3 vertices[] = { { 0.1f, -2.5f, 1e-20f }, { 100, 0, 1 }, { 3, 4, 5 }, { 1, 1, 1 } };
    static const uint32_t triangle[] = { 2, 1, 0 };
    static const uint32_t quad[] = { 0, 1, 2, 3 };
    tl_obj_writer *writer;
    TEST_RESULT(tl_obj_writer_open(path, &writer, NULL), TL_OK);
    tl_obj_writer_comment(writer, "two\nlines");
    tl_obj_writer_object(writer, " a\rb c");
    TEST_CHECK(tl_obj_writer_vertices(writer, vertices, 3) == 0);
    tl_obj_writer_material(writer, "stone");
    tl_obj_writer_triangles(writer, triangle, 1, 0);
    TEST_CHECK(tl_obj_writer_vertices(writer, vertices + 3, 1) == 3);
    tl_obj_writer_triangles(writer, triangle, 1, 1);
    tl_obj_writer_face(writer, quad, 4);
    TEST_CHECK(access(path, F_OK) != 0);
    TEST_RESULT(tl_obj_writer_commit(writer, NULL), TL_OK);
    check_content("# two lines\no _a_b c\nv 0.1 -2.5 1e-20\nv 100 0 1\nv 3 4 5\nusemtl stone\nf 3 2 1\nv 1 1 1\n"
                  "f 4 3 2\nf 1 2 3 4\n");
}

static void test_round_trip(void **state)
{
    (void)state;
    enum { VERTICES = 5000, TRIANGLES = 12000 };
    test_random random = { 1 };
    tl_vec3 *vertices = malloc(VERTICES * sizeof *vertices);
    uint32_t *indices = malloc(TRIANGLES * 3 * sizeof *indices);
    uint16_t *materials = malloc(TRIANGLES * sizeof *materials);
    for (uint32_t i = 0; i < VERTICES * 3; i++) {
        float value;
        do {
            uint32_t bits = (uint32_t)test_random_u64(&random);
            memcpy(&value, &bits, sizeof value);
        } while (!isfinite(value));
        memcpy((char *)vertices + i * sizeof value, &value, sizeof value);
    }
    for (uint32_t i = 0; i < TRIANGLES * 3; i++) {
        indices[i] = test_random_below(&random, VERTICES);
    }
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        materials[i] = (uint16_t)(i / 100 % 7);
    }
    tl_mesh_view view = { vertices, VERTICES, indices, TRIANGLES, materials };
    static const char *const names[] = { "zero", "one", "two" };
    TEST_RESULT(tl_obj_write_mesh(path, &view, names, 3, NULL), TL_OK);
    tl_file_map map;
    tl_imported_mesh mesh;
    TEST_RESULT(tl_file_map_open(path, 0, &map, NULL), TL_OK);
    TEST_RESULT(tl_obj_read(map.bytes, map.size, path, false, NULL, &mesh, NULL), TL_OK);
    TEST_CHECK(mesh.vertex_count == VERTICES && mesh.triangle_count == TRIANGLES);
    TEST_CHECK(memcmp(mesh.vertices, vertices, VERTICES * sizeof *vertices) == 0);
    TEST_CHECK(memcmp(mesh.indices, indices, TRIANGLES * 3 * sizeof *indices) == 0);
    for (uint32_t i = 0; i < TRIANGLES; i++) {
        static const char *const expected[] = { "zero",       "one",        "two",       "material_3",
                                                "material_4", "material_5", "material_6" };
        assert_string_equal(tl_name_table_get(&mesh.names, mesh.materials[i]), expected[materials[i]]);
    }
    tl_imported_mesh_free(&mesh);
    tl_file_map_close(&map);
    // Without materials, and without anything.
    view.materials = NULL;
    view.triangle_count = 1;
    view.vertex_count = 0;
    tl_io_error error;
    TEST_RESULT(tl_obj_write_mesh(path, &view, NULL, 0, &error), TL_ERR_INDEX);
    view.triangle_count = 0;
    TEST_RESULT(tl_obj_write_mesh(path, &view, NULL, 0, NULL), TL_OK);
    check_content("");
    free(vertices);
    free(indices);
    free(materials);
}

static void test_failures(void **state)
{
    (void)state;
    static const tl_vec3 vertices[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, NAN } };
    static const uint32_t triangle[] = { 0, 1, 2 };
    tl_obj_writer *writer;
    tl_io_error error;
    TEST_RESULT(tl_obj_writer_open(path, &writer, NULL), TL_OK);
    tl_obj_writer_vertices(writer, vertices, 3);
    tl_obj_writer_face(writer, triangle, 2); // the first failure is the one that is told
    TEST_RESULT(tl_obj_writer_commit(writer, &error), TL_ERR_NOT_FINITE);
    TEST_CHECK(strcmp(error.element, "vertex") == 0 && error.element_index == 2 && strcmp(error.path, path) == 0);
    TEST_CHECK(access(path, F_OK) != 0);

    TEST_RESULT(tl_obj_writer_open(path, &writer, NULL), TL_OK);
    tl_obj_writer_vertices(writer, vertices, 2);
    tl_obj_writer_triangles(writer, triangle, 1, 0);
    TEST_RESULT(tl_obj_writer_commit(writer, &error), TL_ERR_INDEX);

    TEST_RESULT(tl_obj_writer_open(path, &writer, NULL), TL_OK);
    tl_obj_writer_vertices(writer, vertices, 2);
    tl_obj_writer_triangles(writer, triangle, 1, UINT32_MAX); // wraps around
    TEST_RESULT(tl_obj_writer_commit(writer, &error), TL_ERR_INDEX);

    TEST_RESULT(tl_obj_writer_open(path, &writer, NULL), TL_OK);
    tl_obj_writer_face(writer, triangle, 0);
    TEST_RESULT(tl_obj_writer_commit(writer, NULL), TL_ERR_ARGUMENT);

    TEST_RESULT(tl_obj_writer_open(path, &writer, NULL), TL_OK);
    tl_obj_writer_vertices(writer, vertices, 2);
    tl_obj_writer_abort(writer);
    tl_obj_writer_abort(NULL);
    TEST_CHECK(access(path, F_OK) != 0);

    TEST_RESULT(tl_obj_writer_open("/missing/a.obj", &writer, &error), TL_ERR_IO);
    TEST_CHECK(writer == NULL);
    if (access("/dev/full", W_OK) == 0) {
        TEST_RESULT(tl_obj_writer_open("/dev/full", &writer, &error), TL_OK);
        for (int i = 0; i < 20000; i++) {
            tl_obj_writer_vertices(writer, vertices, 2);
        }
        TEST_RESULT(tl_obj_writer_commit(writer, &error), TL_ERR_IO);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_text),
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_failures),
    };
    return cmocka_run_group_tests(tests, make_path, NULL);
}
