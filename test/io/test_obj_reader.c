// SPDX-License-Identifier: MIT
//
// OBJ text to triangles: every form of every statement, bad input by name and line, every truncation, real files
// against a plain reader that uses strtof.

#include "talus_test.h"

#include "io/files/file_map.h"
#include "io/mesh/obj_reader.h"

#include <stdio.h>
#include <string.h>

static tl_result read_bytes(const char *text, size_t size, tl_imported_mesh *mesh, tl_io_error *error)
{
    // A block of exactly that size, so that the sanitizer sees each byte read behind it.
    char *exact = malloc(size > 0 ? size : 1);
    memcpy(exact, text, size);
    memset(error, 0, sizeof *error);
    tl_result result = tl_obj_read(exact, size, "level.obj", false, NULL, mesh, error);
    free(exact);
    if (result == TL_OK) {
        for (uint32_t i = 0; i < mesh->triangle_count * 3; i++) {
            TEST_CHECK(mesh->indices[i] < mesh->vertex_count);
        }
        for (uint32_t i = 0; i < mesh->vertex_count; i++) {
            TEST_CHECK(tl_is_finite(mesh->vertices[i]));
        }
    } else {
        TEST_CHECK(error->result == result && error->message[0] != '\0' && strcmp(error->path, "level.obj") == 0);
        TEST_CHECK(mesh->vertices == NULL && mesh->triangle_count == 0);
    }
    return result;
}

static tl_result read_string(const char *text, tl_imported_mesh *mesh, tl_io_error *error)
{
    return read_bytes(text, strlen(text), mesh, error);
}

static tl_imported_mesh read_good(const char *text)
{
    tl_imported_mesh mesh;
    tl_io_error error;
    if (read_string(text, &mesh, &error) != TL_OK) {
        char words[1024];
        tl_io_error_format(&error, words, sizeof words);
        fail_msg("%s", words);
    }
    return mesh;
}

static void check_triangle(const tl_imported_mesh *mesh, uint32_t triangle, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t *indices = mesh->indices + (size_t)triangle * 3;
    if (triangle >= mesh->triangle_count || indices[0] != a || indices[1] != b || indices[2] != c) {
        fail_msg("triangle %u is not %u %u %u", triangle, a, b, c);
    }
}

static void test_one_triangle(void **state)
{
    (void)state;
    tl_imported_mesh mesh = read_good("v 1 2 3\nv 4.5 -5.25 6e1\nv .5 5. +7\nf 1 2 3\n");
    TEST_CHECK(mesh.vertex_count == 3 && mesh.triangle_count == 1 && mesh.face_count == 1 && mesh.polygon_count == 0);
    TEST_CHECK(mesh.vertices[1].x == 4.5f && mesh.vertices[1].y == -5.25f && mesh.vertices[1].z == 60.0f);
    TEST_CHECK(mesh.vertices[2].x == 0.5f && mesh.vertices[2].y == 5.0f && mesh.vertices[2].z == 7.0f);
    check_triangle(&mesh, 0, 0, 1, 2);
    TEST_CHECK(mesh.source_lines[0] == 4 && mesh.materials[0] == 0 && mesh.names.count == 1);
    tl_mesh_view view = tl_imported_mesh_as_view(&mesh);
    TEST_CHECK(view.vertices == mesh.vertices && view.triangle_count == 1 && view.materials == mesh.materials);
    tl_imported_mesh_free(&mesh);
    tl_imported_mesh_free(&mesh);
}

// Each must give three vertices (0,0,0) (1,0,0) (0,1,0), and one triangle 0 1 2.
static void test_forms_of_a_triangle(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
        "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
        "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3",
        "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "  v\t0  0\t\t0 \n\tv 1 0 0\t\n v 0 1 0  \n\t f  1\t2  3 \t\n",
        "# comment\n\n\nv 0 0 0 # origin\nv 1 0 0\nv 0 1 0\n#\nf 1 2 3 # the face\n",
        "v 0 0 0 1.0\nv 1 0 0 1\nv 0 1 0 0.5\nf 1 2 3\n",
        "v 0 0 0 .1 .2 .3\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\n",
        "v 0 0 0 1 .1 .2 .3\nv 1 0 0 1 1 1 1\nv 0 1 0 1 1 1 1\nf 1 2 3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1 2/2 3/3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//2 3//3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/2/2 3/3/3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/ 2/ 3/\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1// 2/1/ 3/123456789/-1\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3/-1/-1 -2//-2 -1/-5\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 -2 3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 00000001 000000000000002 3\n",
        "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n",
        "v 0 0 0\nf 1 2 3\nv 1 0 0\nv 0 1 0\n",
        "v 0 0 \\\n0\nv \\\n1 0 0\nv 0 1 0\nf 1 \\\n 2 \\\n3\n",
        "v 0 0 \\\r\n0\r\nv \\\r\n1 0 0\r\nv 0 1 0\r\nf 1 \\\r\n 2 \\\r\n3\r\n",
        "v 0 0 \\\r0\rv \\\r1 0 0\rv 0 1 0\rf 1 \\\r 2 \\\r3\r",
        "v\\\n 0 0 0\n\\\nv 1 0 0\nv 0 1\\\n 0\nf\\\n 1 2 3\\\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\\",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nfo 1 2 3\n",
        "v 0 -0 0\nv 1e0 0e5 0E-5\nv 0.0 1.000000000000000000000000 0\nf 1 2 3\n",
        "mtllib a b.mtl\no an object\ng a b c\ns off\ns 1\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 0 0 0\nvn 0 0 1\n"
        "vp 1 2\nf 1/1/1 2/2/1 3/1/1\n",
        "vn 0 \\\n 0 1\nvt 0 \\\n 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "# a path: C:\\levels\\\nv 0 0 0\nmtllib C:\\materials\\\nv 1 0 0\no C:\\\nv 0 1 0\nf 1 2 3\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\n\n\n\nf 1 2 3\n\n\n",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# no more, without a line end and quite long, so that it is the last "
        "section",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        tl_imported_mesh mesh = read_good(texts[i]);
        TEST_CHECK(mesh.vertex_count == 3 && mesh.triangle_count == 1 && mesh.skipped_lines == 0);
        check_triangle(&mesh, 0, 0, 1, 2);
        TEST_CHECK(mesh.vertices[0].x == 0 && mesh.vertices[0].y == 0 && mesh.vertices[0].z == 0);
        TEST_CHECK(mesh.vertices[1].x == 1 && mesh.vertices[1].y == 0 && mesh.vertices[1].z == 0);
        TEST_CHECK(mesh.vertices[2].x == 0 && mesh.vertices[2].y == 1 && mesh.vertices[2].z == 0);
        tl_imported_mesh_free(&mesh);
    }
}

static void test_lines_are_counted(void **state)
{
    (void)state;
    static const char *const ends[] = { "\n", "\r\n", "\r" };
    for (int i = 0; i < 3; i++) {
        char text[512];
        sprintf(text, "v 0 0 0%sv 1 0 0 \\%s 1%s%s# comment%sv 0 1 0%sf 1 2 3%sf 1 \\%s 2 3%sf 3 2 1", ends[i], ends[i],
                ends[i], ends[i], ends[i], ends[i], ends[i], ends[i], ends[i]);
        tl_imported_mesh mesh = read_good(text);
        TEST_CHECK(mesh.triangle_count == 3);
        TEST_CHECK(mesh.source_lines[0] == 7 && mesh.source_lines[1] == 8 && mesh.source_lines[2] == 10);
        tl_imported_mesh_free(&mesh);
    }
}

static void test_other_statements(void **state)
{
    (void)state;
    tl_imported_mesh mesh =
        read_good("v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\np 1 2\nl 1 2\nl 1 2 3\nl 1 \\\n 2\n"
                  "cstype bezier\ndeg 3 3\ncurv 0 1 \\\n 1 2 3 \\\n 4\nend\nmg 1 2\nbevel on\nf 1 2 3\n");
    TEST_CHECK(mesh.ignored_points == 2 && mesh.ignored_lines == 3 && mesh.skipped_lines == 6);
    TEST_CHECK(mesh.triangle_count == 1 && mesh.source_lines[0] == 18);
    tl_imported_mesh_free(&mesh);
}

static void test_materials(void **state)
{
    (void)state;
    tl_imported_mesh mesh = read_good("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl stone\nf 1 2 3\nf 1 2 3\n"
                                      "usemtl   wet grass \t\r\nf 1 2 3\nusemtl stone\nf 1 2 3\nusemtl\nf 1 2 3\n"
                                      "usemtl stone2\nf 1 2 3");
    static const uint16_t expected[] = { 0, 1, 1, 2, 1, 0, 3 };
    TEST_CHECK(mesh.triangle_count == 7 && mesh.names.count == 4);
    for (uint32_t i = 0; i < 7; i++) {
        TEST_CHECK(mesh.materials[i] == expected[i]);
    }
    assert_string_equal(tl_name_table_get(&mesh.names, 0), "");
    assert_string_equal(tl_name_table_get(&mesh.names, 1), "stone");
    assert_string_equal(tl_name_table_get(&mesh.names, 2), "wet grass");
    assert_string_equal(tl_name_table_get(&mesh.names, 3), "stone2");
    tl_imported_mesh_free(&mesh);
}

static void test_material_limit(void **state)
{
    (void)state;
    enum { NAMES = 65536 };
    char *text = malloc(NAMES * 40 + 100);
    size_t size = (size_t)sprintf(text, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for (unsigned i = 1; i <= NAMES; i++) {
        if (i == NAMES) {
            // The last that has an id: 65535.
            tl_imported_mesh mesh = read_good(text);
            TEST_CHECK(mesh.names.count == 65536 && mesh.materials[NAMES - 2] == 65535);
            assert_string_equal(tl_name_table_get(&mesh.names, 4711), "m4711");
            tl_imported_mesh_free(&mesh);
        }
        size += (size_t)sprintf(text + size, "usemtl m%u\nf 1 2 3\n", i);
    }
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(read_string(text, &mesh, &error), TL_ERR_LIMIT);
    TEST_CHECK(error.line == 3 + 2 * NAMES - 1);
    free(text);
}

typedef struct bad_text {
    const char *text;
    tl_result result;
    uint64_t line;
    const char *message; // part of it
} bad_text;

#define THREE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void test_bad_texts(void **state)
{
    (void)state;
    static const bad_text texts[] = {
        { "", TL_ERR_EMPTY, 0, "empty" },
        { "\n\n# nothing\n", TL_ERR_EMPTY, 0, "no vertices" },
        { "hello world\nthis is text\n", TL_ERR_EMPTY, 0, "no vertices" },
        { THREE, TL_ERR_EMPTY, 0, "no faces" },
        { THREE "l 1 2\n", TL_ERR_EMPTY, 0, "no faces" },
        { "v 1 2\n", TL_ERR_FORMAT, 1, "line ends" },
        { "v\n", TL_ERR_FORMAT, 1, "line ends" },
        { "v 1 2 # 3\n", TL_ERR_FORMAT, 1, "line ends" },
        { "v 1 2 x\n", TL_ERR_FORMAT, 1, "'x'" },
        { "v 1 2 3x\n", TL_ERR_FORMAT, 1, "'3x'" },
        { "v 1 2,5 3\n", TL_ERR_FORMAT, 1, "'2,5'" },
        { "v 1 2 3 4 5\n", TL_ERR_FORMAT, 1, "5 numbers" },
        { "v 1 2 3 4 5 6 7 8\n", TL_ERR_FORMAT, 1, "8 numbers" },
        { "v 1 2 3 w\n", TL_ERR_FORMAT, 1, "'w'" },
        { "v 1 2 0x10\n", TL_ERR_FORMAT, 1, "'0x10'" },
        { "v 1 2 3e\n", TL_ERR_FORMAT, 1, "'3e'" },
        { "v 1 2 --3\n", TL_ERR_FORMAT, 1, "'--3'" },
        { "v 1 2 nan\n", TL_ERR_NOT_FINITE, 1, "'nan'" },
        { "v 1 -NaN 2\n", TL_ERR_NOT_FINITE, 1, "'-NaN'" },
        { "v inf 1 2\n", TL_ERR_NOT_FINITE, 1, "'inf'" },
        { "v -Infinity 1 2\n", TL_ERR_NOT_FINITE, 1, "'-Infinity'" },
        { "v 1.#QNAN 1 2\n", TL_ERR_NOT_FINITE, 1, "'1.#QNAN'" },
        { "v -1.#IND 1 2\n", TL_ERR_NOT_FINITE, 1, "'-1.#IND'" },
        { THREE "v 0 1e39 0\nf 1 2 3\n", TL_ERR_RANGE, 4, "largest float" },
        { THREE "v 0 0 -99999999999999999999999999999999999999999\n", TL_ERR_RANGE, 4, "largest float" },
        { THREE "f\n", TL_ERR_FORMAT, 4, "0 corners" },
        { THREE "f 1\n", TL_ERR_FORMAT, 4, "1 corner" },
        { THREE "f 1 2\n", TL_ERR_FORMAT, 4, "2 corners" },
        { THREE "f 1 2 # 3\n", TL_ERR_FORMAT, 4, "2 corners" },
        { THREE "f 1 2 0\n", TL_ERR_INDEX, 4, "'0'" },
        { THREE "f 1 2 -0\n", TL_ERR_INDEX, 4, "'-0'" },
        { THREE "f 1 2 -4\n", TL_ERR_INDEX, 4, "'-4'" },
        { THREE "f 1 2 -4294967295\n", TL_ERR_INDEX, 4, "'-4294967295'" },
        { THREE "f 1 2 -4294967296\n", TL_ERR_INDEX, 4, "'-4294967296'" },
        { THREE "f 1 2 4\n", TL_ERR_INDEX, 4, "vertex 4" },
        { THREE "f 1 2 3\nf 1 2 9\nf 1 2 5\nv 0 0 0\nv 0 0 0\n", TL_ERR_INDEX, 5, "vertex 9" },
        { THREE "f 1 2 99999999\n", TL_ERR_INDEX, 4, "vertex 99999999" },
        { THREE "f 1 2 4294967296\n", TL_ERR_INDEX, 4, "'4294967296'" },
        { THREE "f 1 2 99999999999999999999999\n", TL_ERR_INDEX, 4, "'99999999999999999999999'" },
        { THREE "f 1 2 3.5\n", TL_ERR_FORMAT, 4, "'3.5'" },
        { THREE "f 1 2 c\n", TL_ERR_FORMAT, 4, "'c'" },
        { THREE "f 1 2 /3\n", TL_ERR_FORMAT, 4, "'/3'" },
        { THREE "f 1 2 3/x\n", TL_ERR_FORMAT, 4, "'3/x'" },
        { THREE "f 1 2 3/1/1/1\n", TL_ERR_FORMAT, 4, "'3/1/1/1'" },
        { THREE "f 1 2 -\n", TL_ERR_FORMAT, 4, "'-'" },
        { THREE "f 1 2 nan\n", TL_ERR_NOT_FINITE, 4, "'nan'" },
        { "\xff\xfev\0 \0", TL_ERR_FORMAT, 1, "UTF-16" },
        { "\x89PNG\r\n\x1a\n", TL_ERR_FORMAT, 2, "binary" },
        { THREE "\x01\x02\x03", TL_ERR_FORMAT, 4, "binary" },
        { "abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz\n", TL_ERR_LIMIT, 1, "keyword" },
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        tl_imported_mesh mesh;
        tl_io_error error;
        tl_result result = read_string(texts[i].text, &mesh, &error);
        if (result != texts[i].result || error.line != texts[i].line ||
            strstr(error.message, texts[i].message) == NULL) {
            fail_msg("text %zu: %s, line %llu: %s", i, tl_result_name(result), (unsigned long long)error.line,
                     error.message);
        }
    }
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(read_bytes("v 1 2 \0003\n", 9, &mesh, &error), TL_ERR_FORMAT);
    TEST_RESULT(read_bytes("\0\0\0\0", 4, &mesh, &error), TL_ERR_FORMAT);
    read_string(THREE "f 1 2 9\n", &mesh, &error);
    char words[256];
    tl_io_error_format(&error, words, sizeof words);
    assert_string_equal(words,
                        "level.obj:4: a corner names vertex 9, and the file has 3 (the file is cut short, or its "
                        "indices are wrong)");
    TEST_CHECK(strcmp(error.element, "face") == 0 && error.element_index == 0);
    // Without an error struct.
    TEST_RESULT(tl_obj_read("v x", 3, NULL, false, NULL, &mesh, NULL), TL_ERR_FORMAT);
}

// Vertices alone are enough for a point cloud.
static void test_no_faces_allowed(void **state)
{
    (void)state;
    tl_imported_mesh mesh;
    TEST_RESULT(tl_obj_read("v 1 2 3\n", 8, NULL, true, NULL, &mesh, NULL), TL_OK);
    TEST_CHECK(mesh.vertex_count == 1 && mesh.triangle_count == 0);
    tl_imported_mesh_free(&mesh);
    TEST_RESULT(tl_obj_read("f 1 2 3\n", 8, NULL, true, NULL, &mesh, NULL), TL_ERR_INDEX);
    TEST_RESULT(tl_obj_read("", 0, NULL, true, NULL, &mesh, NULL), TL_ERR_EMPTY);
}

static void test_long_lines(void **state)
{
    (void)state;
    enum { LONG = 300000, TOO_LONG = TL_MAX_OBJ_LINE_BYTES + 1 };
    char *text = malloc(TOO_LONG + 100);
    tl_imported_mesh mesh;
    tl_io_error error;
    // One word of 300,000 characters.
    memset(text, 'a', LONG);
    TEST_RESULT(read_bytes(text, LONG, &mesh, &error), TL_ERR_LIMIT);
    memcpy(text, "v ", 2);
    TEST_RESULT(read_bytes(text, LONG, &mesh, &error), TL_ERR_FORMAT);
    TEST_CHECK(strstr(error.message, "aaa...'") != NULL && strlen(error.message) < 100);
    // A number of 300,000 digits is a number.
    memset(text + 2, '0', LONG);
    strcpy(text + LONG, "1 2 3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    TEST_RESULT(read_string(text, &mesh, &error), TL_OK);
    TEST_CHECK(mesh.vertices[0].x == 1.0f);
    tl_imported_mesh_free(&mesh);
    // A polygon of 100,000 corners is one, but too long to be clipped.
    size_t size = (size_t)sprintf(text, THREE "f");
    for (int i = 0; i < 100000; i++) {
        size += (size_t)sprintf(text + size, " %d", i % 3 + 1);
    }
    TEST_RESULT(read_bytes(text, size, &mesh, &error), TL_OK);
    TEST_CHECK(mesh.triangle_count == 99998 && mesh.crooked_count == 1);
    tl_imported_mesh_free(&mesh);
    // A comment, longer than any line may be; and one that just fits.
    memset(text, '#', TOO_LONG);
    strcpy(text + TOO_LONG, "\n" THREE "f 1 2 3\n");
    TEST_RESULT(read_string(text, &mesh, &error), TL_ERR_LIMIT);
    TEST_CHECK(error.line == 1);
    TEST_RESULT(read_string(text + 1, &mesh, &error), TL_OK);
    tl_imported_mesh_free(&mesh);
    free(text);
}

// Every part of every form, cut off at each byte: the right prefix of the mesh, or an error with its line.
static void test_every_prefix(void **state)
{
    (void)state;
    static const char text[] =
        "\xef\xbb\xbf# sample\r\nmtllib a.mtl\no box\nv -1.5 2.25e1 .5\nv 1 0 0 1 .5 .5 .5\nv 0 1 0\n"
        "v 1 1 \\\n 1\nvt 0 1\nvn 0 0 1\ns off\nusemtl stone\nf 1 2 3\nf 1/1 2/1 4/1 \\\r\n 3/1\r"
        "g a b\nusemtl grass\nf -1//-1 -2//-1 -3//-1\nl 1 2\nf 4/1/1 3/1/1 2/1/1 1/1/1 # end\n";
    uint32_t good = 0;
    uint32_t bad = 0;
    uint32_t most = 0;
    for (size_t size = 0; size < sizeof text; size++) {
        tl_imported_mesh mesh;
        tl_io_error error;
        tl_result result = read_bytes(text, size, &mesh, &error);
        if (result == TL_OK) {
            good++;
            TEST_CHECK(mesh.triangle_count >= most);
            most = mesh.triangle_count;
            tl_imported_mesh_free(&mesh);
        } else {
            bad++;
            TEST_CHECK(result == TL_ERR_EMPTY || result == TL_ERR_FORMAT || result == TL_ERR_INDEX);
        }
    }
    TEST_CHECK(good > 50 && bad > 100 && most == 6);
}

// Bytes changed at random in a good text: never a crash, always a mesh or a name.
static void test_changed_bytes(void **state)
{
    (void)state;
    static const char text[] = "v -1.5 2.25e1 .5\nv 1 0 0\nv 0 1 0\nv 1 1 1\nusemtl stone\nf 1 2 3\nf 1/1 2/1 4/1 3/1\n"
                               "f -1//-1 -2//-1 -3//-1\nf 4/1/1 3/1/1 2/1/1 1/1/1\n# the end of the text\n";
    test_random random = { 1 };
    uint32_t good = 0;
    uint32_t bad = 0;
    for (int i = 0; i < 50000; i++) {
        char changed[sizeof text];
        memcpy(changed, text, sizeof text);
        for (uint32_t k = test_random_below(&random, 4) + 1; k > 0; k--) {
            static const char likely[] = " \t\n\r\\#/-+.e0919vfn";
            uint32_t at = test_random_below(&random, sizeof text - 1);
            changed[at] = test_random_below(&random, 2) == 0 ? (char)test_random_below(&random, 256)
                                                             : likely[test_random_below(&random, sizeof likely - 1)];
        }
        tl_imported_mesh mesh;
        tl_io_error error;
        if (read_bytes(changed, sizeof changed - 1, &mesh, &error) == TL_OK) {
            good++;
            tl_imported_mesh_free(&mesh);
        } else {
            bad++;
        }
    }
    TEST_CHECK(good > 5000 && bad > 5000);
}

static void test_every_allocation(void **state)
{
    (void)state;
    char text[4096] = THREE "v 1 1 0\n";
    size_t size = strlen(text);
    for (int i = 0; i < 60; i++) {
        size += (size_t)sprintf(text + size, "usemtl m%d\nv %d 0 0\nf 1 2 4 3\nf 1 2 3\n", i, i);
    }
    uint64_t calls = 0;
    for (uint64_t fail_at = 0; fail_at <= calls; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        tl_host host = { &allocator.allocator, NULL, NULL };
        tl_imported_mesh mesh;
        tl_io_error error;
        tl_result result = tl_obj_read(text, size, "level.obj", false, &host, &mesh, &error);
        TEST_RESULT(result, fail_at == 0 ? TL_OK : TL_ERR_MEMORY);
        if (fail_at == 0) {
            calls = allocator.calls;
            TEST_CHECK(mesh.triangle_count == 180);
            tl_imported_mesh_free(&mesh);
        }
        TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
    }
    TEST_CHECK(calls > 10);
}

static bool cancel_after(const char *stage, uint64_t done, uint64_t total, void *user)
{
    int *left = user;
    TEST_CHECK(strcmp(stage, "read mesh") == 0 && done <= total);
    return (*left)-- > 0;
}

static void test_cancel(void **state)
{
    (void)state;
    enum { LINES = 600000 };
    char *text = malloc(LINES * 8 + 10);
    size_t size = 0;
    for (int i = 0; i < LINES; i++) {
        memcpy(text + size, "v 1 2 3\n", 8);
        size += 8;
    }
    memcpy(text + size, "f 1 2 3\n", 8);
    size += 8;
    for (int allowed = 0; allowed < 4; allowed++) {
        int left = allowed;
        tl_progress progress = { cancel_after, &left };
        tl_host host = { NULL, NULL, &progress };
        tl_imported_mesh mesh;
        tl_result result = tl_obj_read(text, size, NULL, false, &host, &mesh, NULL);
        TEST_RESULT(result, allowed < 3 ? TL_ERR_CANCELLED : TL_OK); // at the start, at 4 MiB, at the end
        tl_imported_mesh_free(&mesh);
    }
    free(text);
}

// --- real files -----------------------------------------------------------------------------------------------------

// The plainest reader: lines by hand, numbers by strtof and strtol, triangles only.
static void check_file(const char *path)
{
    tl_file_map map;
    if (tl_file_map_open(path, 0, &map, NULL) != TL_OK) {
        return;
    }
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(tl_obj_read(map.bytes, map.size, path, false, NULL, &mesh, &error), TL_OK);
    char *text = malloc(map.size + 1);
    memcpy(text, map.bytes, map.size);
    text[map.size] = '\0';
    uint32_t vertices = 0;
    uint32_t triangles = 0;
    for (char *at = text; *at != '\0';) {
        if (memcmp(at, "v ", 2) == 0) {
            tl_vec3 vertex;
            vertex.x = strtof(at + 2, &at);
            vertex.y = strtof(at, &at);
            vertex.z = strtof(at, &at);
            TEST_CHECK(vertices < mesh.vertex_count && memcmp(&vertex, &mesh.vertices[vertices++], sizeof vertex) == 0);
        } else if (memcmp(at, "f ", 2) == 0) {
            uint32_t a = (uint32_t)strtol(at + 2, &at, 10) - 1;
            uint32_t b = (uint32_t)strtol(at, &at, 10) - 1;
            uint32_t c = (uint32_t)strtol(at, &at, 10) - 1;
            check_triangle(&mesh, triangles++, a, b, c);
        }
        at = strchr(at, '\n') + 1;
    }
    TEST_CHECK(vertices == mesh.vertex_count && triangles == mesh.triangle_count);
    free(text);
    tl_imported_mesh_free(&mesh);
    tl_file_map_close(&map);
}

static void test_real_files(void **state)
{
    (void)state;
    check_file(TALUS_DATA_DIR "/levels/nav_test.obj");
    check_file(TALUS_DATA_DIR "/levels/dungeon.obj");
    check_file(TALUS_DATA_DIR "/levels/undulating.obj");
    check_file(TALUS_DATA_DIR "/levels/proto-level.obj");
    check_file(TALUS_DATA_DIR "/levels/test_map01.obj");
    check_file(TALUS_DATA_DIR "/levels/collision_mesh_01.obj");
    check_file(TALUS_DATA_DIR "/models/stanford-bunny.obj");
    check_file(TALUS_DATA_DIR "/models/fandisk.obj");
    check_file(TALUS_DATA_DIR "/models/cow.obj");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_triangle),
        cmocka_unit_test(test_forms_of_a_triangle),
        cmocka_unit_test(test_lines_are_counted),
        cmocka_unit_test(test_other_statements),
        cmocka_unit_test(test_materials),
        cmocka_unit_test(test_material_limit),
        cmocka_unit_test(test_bad_texts),
        cmocka_unit_test(test_no_faces_allowed),
        cmocka_unit_test(test_long_lines),
        cmocka_unit_test(test_every_prefix),
        cmocka_unit_test(test_changed_bytes),
        cmocka_unit_test(test_every_allocation),
        cmocka_unit_test(test_cancel),
        cmocka_unit_test(test_real_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
