// SPDX-License-Identifier: MIT
//
// A process that reads and one that listens, on every system: children that crash, compute for ever or say what is not
// so.

#include "talus_test.h"

#include "io/mesh/import_process.h"

#include <string.h>

static const tl_mesh_source any_source = { "level.x", NULL, "bytes", 5, "x", true, { 1.0, 2.0, 3.0 } };

static tl_result crash(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                       tl_io_error *error_out)
{
    (void)allocator;
    (void)mesh_out;
    (void)error_out;
    volatile char *volatile nowhere = NULL;
    *nowhere = source->kind[0];
    return TL_OK;
}

static void test_crash(void **state)
{
    (void)state;
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(tl_read_isolated(crash, &any_source, NULL, NULL, &mesh, &error), TL_ERR_FORMAT);
    TEST_CHECK(strstr(error.message, "reader failed") != NULL && strcmp(error.path, "level.x") == 0);
    TEST_CHECK(mesh.vertices == NULL);
    TEST_RESULT(tl_read_isolated(crash, &any_source, NULL, NULL, &mesh, NULL), TL_ERR_FORMAT);
}

static tl_result compute_for_ever(const tl_mesh_source *source, const tl_allocator *allocator,
                                  tl_imported_mesh *mesh_out, tl_io_error *error_out)
{
    (void)allocator;
    (void)mesh_out;
    (void)error_out;
    for (const volatile char *kind = source->kind;;) {
        if (*kind == 0) {
            return TL_OK;
        }
    }
}

static bool cancel_third(const char *stage, uint64_t done, uint64_t total, void *user)
{
    int *calls = user;
    TEST_CHECK(strcmp(stage, "read mesh") == 0 && done <= total);
    return ++*calls < 3;
}

// The child ends when the host has had enough, or its time is over.
static void test_endless(void **state)
{
    (void)state;
    int calls = 0;
    tl_progress progress = { cancel_third, &calls };
    tl_host host = { NULL, NULL, &progress };
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(tl_read_isolated(compute_for_ever, &any_source, NULL, &host, &mesh, &error), TL_ERR_CANCELLED);
    TEST_CHECK(calls == 3 && mesh.vertices == NULL && strcmp(error.path, "level.x") == 0);
    tl_import_limits second = { 1, 0 };
    TEST_RESULT(tl_read_isolated(compute_for_ever, &any_source, &second, NULL, &mesh, &error), TL_ERR_LIMIT);
    TEST_CHECK(strstr(error.message, "1 s") != NULL && mesh.vertices == NULL);
}

// Fails with all that it was given in its message.
static tl_result repeat_source(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                               tl_io_error *error_out)
{
    (void)allocator;
    (void)mesh_out;
    const double *o = source->origin;
    return tl_io_fail(error_out, TL_ERR_EMPTY, source->name, 7, "give it more", "\033[31m%s,%s,%.*s,%s,%d,%g,%g,%g",
                      source->name, source->path != NULL ? source->path : "none", (int)source->size,
                      (const char *)source->bytes, source->kind, (int)source->allow_no_triangles, o[0], o[1], o[2]);
}

// The source arrives whole; so do the child's own words, but for what would drive a terminal.
static void test_words(void **state)
{
    (void)state;
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(tl_read_isolated(repeat_source, &any_source, NULL, NULL, &mesh, &error), TL_ERR_EMPTY);
    assert_string_equal(error.message, "?[31mlevel.x,none,bytes,x,1,1,2,3");
    assert_string_equal(error.advice, "give it more");
    TEST_CHECK(error.line == 7);
    const tl_mesh_source with_path = { "standard input", "\xd0\xbf/a.ply", "", 0, "ply", false, { 0.0 } };
    TEST_RESULT(tl_read_isolated(repeat_source, &with_path, NULL, NULL, &mesh, &error), TL_ERR_EMPTY);
    assert_string_equal(error.message, "?[31mstandard input,\xd0\xbf/a.ply,,ply,0,0,0,0");
}

// A triangle with something wrong about it: what, the source's kind says.
static tl_result tell_lies(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                           tl_io_error *error_out)
{
    uint32_t id;
    tl_imported_mesh_init(mesh_out, allocator);
    mesh_out->format = (const char *)(uintptr_t)1;
    tl_name_table_add(&mesh_out->names, &mesh_out->allocator, "", 0, 1, &id);
    tl_imported_mesh_reserve_vertices(mesh_out, 3);
    tl_imported_mesh_reserve_triangles(mesh_out, 1);
    for (uint32_t i = 0; i < 3; i++) {
        mesh_out->vertices[i] = tl_vec3_make((float)i, (float)(i * i), 0);
        mesh_out->indices[i] = i;
    }
    mesh_out->vertex_count = 3;
    mesh_out->triangle_count = 1;
    mesh_out->materials[0] = 0;
    switch (source->kind[0]) {
    case 'i':
        mesh_out->indices[2] = 3;
        break;
    case 'm':
        mesh_out->materials[0] = 1;
        break;
    case 'n':
        mesh_out->vertices[1].y = NAN;
        break;
    case 'v':
        mesh_out->vertex_count = UINT32_MAX;
        break;
    case 't':
        mesh_out->names.text_size = SIZE_MAX;
        break;
    case 'r':
        memset(error_out, 'x', sizeof *error_out);
        return (tl_result)12345;
    default:
        break;
    }
    return TL_OK;
}

// Nothing that comes back is believed unseen.
static void test_lies(void **state)
{
    (void)state;
    static const char *const kinds[] = { "good", "index", "material", "nan", "vertices", "text", "result" };
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++) {
        tl_imported_mesh mesh;
        tl_io_error error;
        tl_mesh_source source = { "level.x", NULL, "", 0, kinds[i], false, { 0.0 } };
        tl_result result = tl_read_isolated(tell_lies, &source, NULL, NULL, &mesh, &error);
        TEST_CHECK((result == TL_OK) == (i == 0));
        if (result != TL_OK) {
            TEST_CHECK(error.result == result && error.message[0] != '\0' && mesh.vertices == NULL);
            char words[1024];
            tl_io_error_format(&error, words, sizeof words);
        }
        tl_imported_mesh_free(&mesh);
    }
}

// A grid, its heights by a formula: more than a pipe holds at once.
static tl_result make_grid(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                           tl_io_error *error_out)
{
    enum { SIDE = 400 };
    (void)source;
    (void)error_out;
    uint32_t id;
    tl_imported_mesh_init(mesh_out, allocator);
    tl_name_table_add(&mesh_out->names, &mesh_out->allocator, "stone", 5, 1, &id);
    tl_imported_mesh_reserve_vertices(mesh_out, SIDE * SIDE);
    tl_imported_mesh_reserve_triangles(mesh_out, SIDE * SIDE);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        mesh_out->vertices[i] = tl_vec3_make((float)(i % SIDE), (float)(i * 7 % 31), (float)(i / SIDE));
        for (uint32_t k = 0; k < 3; k++) {
            mesh_out->indices[i * 3 + k] = (i + k * k) % (SIDE * SIDE);
        }
        mesh_out->materials[i] = 0;
    }
    mesh_out->vertex_count = mesh_out->triangle_count = SIDE * SIDE;
    return TL_OK;
}

static void test_large(void **state)
{
    (void)state;
    tl_imported_mesh direct;
    tl_imported_mesh piped;
    TEST_RESULT(make_grid(&any_source, NULL, &direct, NULL), TL_OK);
    TEST_RESULT(tl_read_isolated(make_grid, &any_source, NULL, NULL, &piped, NULL), TL_OK);
    TEST_CHECK(piped.isolation != TL_ISOLATION_NONE && piped.source_bytes == any_source.size);
    TEST_CHECK(piped.vertex_count == direct.vertex_count && piped.triangle_count == direct.triangle_count);
    TEST_CHECK(memcmp(piped.vertices, direct.vertices, direct.vertex_count * sizeof *direct.vertices) == 0);
    TEST_CHECK(memcmp(piped.indices, direct.indices, direct.triangle_count * 3 * sizeof *direct.indices) == 0);
    TEST_CHECK(memcmp(piped.materials, direct.materials, direct.triangle_count * sizeof *direct.materials) == 0);
    assert_string_equal(tl_name_table_get(&piped.names, 0), "stone");
    tl_imported_mesh_free(&direct);
    tl_imported_mesh_free(&piped);
}

int main(void)
{
    tl_import_child_main();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crash), cmocka_unit_test(test_endless), cmocka_unit_test(test_words),
        cmocka_unit_test(test_lies),  cmocka_unit_test(test_large),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
