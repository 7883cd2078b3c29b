// SPDX-License-Identifier: MIT
//
// A child that dies, a child that hangs, and a large mesh through the pipe.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/mesh/assimp_process.h"
#include "io/mesh/assimp_reader.h"

#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// Bytes that cannot be read: the child is killed by them, the parent never looks.
static void test_crash(void **state)
{
    (void)state;
    void *page = mmap(NULL, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    TEST_CHECK(page != MAP_FAILED);
    tl_imported_mesh mesh;
    tl_io_error error;
    tl_result result =
        tl_assimp_read_isolated(&(tl_assimp_source){ "level.ply", page, 4096, "ply", false }, NULL, &mesh, &error);
    TEST_RESULT(result, TL_ERR_FORMAT);
    TEST_CHECK(error.result == TL_ERR_FORMAT && strcmp(error.path, "level.ply") == 0 && mesh.vertices == NULL);
    TEST_CHECK(strstr(error.message, "Assimp failed") != NULL);
    TEST_RESULT(
        tl_assimp_read_isolated(&(tl_assimp_source){ "level.ply", page, 4096, "ply", false }, NULL, &mesh, NULL),
        TL_ERR_FORMAT);
    munmap(page, 4096);
    TEST_CHECK(waitpid(-1, NULL, WNOHANG) == -1); // no child is left
}

static bool cancel_third(const char *stage, uint64_t done, uint64_t total, void *user)
{
    int *calls = user;
    TEST_CHECK(strcmp(stage, "read mesh") == 0 && done <= total);
    return ++*calls < 3;
}

// A pipe that nobody writes to: the child waits for ever, until the host has had enough.
static void test_cancel(void **state)
{
    (void)state;
    char path[64];
    snprintf(path, sizeof path, "/tmp/talus_pipe_%d.ply", (int)getpid());
    TEST_CHECK(mkfifo(path, 0600) == 0);
    int calls = 0;
    tl_progress progress = { cancel_third, &calls };
    tl_host host = { NULL, NULL, &progress };
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(tl_assimp_read_isolated(&(tl_assimp_source){ path, NULL, 100, NULL, false }, &host, &mesh, &error),
                TL_ERR_CANCELLED);
    TEST_CHECK(calls == 3 && mesh.vertices == NULL && strcmp(error.path, path) == 0);
    TEST_CHECK(waitpid(-1, NULL, WNOHANG) == -1);
    unlink(path);
}

// More than a pipe holds at once, and the same as without the pipe.
static void test_large(void **state)
{
    (void)state;
    enum { SIDE = 150, VERTICES = (SIDE + 1) * (SIDE + 1) };
    char *text = malloc(VERTICES * 48 + SIDE * SIDE * 48 + 1000);
    size_t size =
        (size_t)sprintf(text,
                        "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                        "property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n",
                        VERTICES, SIDE * SIDE);
    for (int i = 0; i < VERTICES; i++) {
        size += (size_t)sprintf(text + size, "%d %d.25 %d\n", i % (SIDE + 1), i % 7, i / (SIDE + 1));
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        int corner = i / SIDE * (SIDE + 1) + i % SIDE;
        size +=
            (size_t)sprintf(text + size, "4 %d %d %d %d\n", corner, corner + SIDE + 1, corner + SIDE + 2, corner + 1);
    }
    tl_imported_mesh direct;
    tl_imported_mesh piped;
    TEST_RESULT(tl_assimp_read(&(tl_assimp_source){ "a.ply", text, size, "ply", false }, NULL, &direct, NULL), TL_OK);
    TEST_RESULT(tl_assimp_read_isolated(&(tl_assimp_source){ "a.ply", text, size, "ply", false }, NULL, &piped, NULL),
                TL_OK);
    TEST_CHECK(direct.triangle_count == 2 * SIDE * SIDE && direct.polygon_count == SIDE * SIDE);
    TEST_CHECK(piped.vertex_count == direct.vertex_count && piped.triangle_count == direct.triangle_count);
    TEST_CHECK(memcmp(piped.vertices, direct.vertices, direct.vertex_count * sizeof *direct.vertices) == 0);
    TEST_CHECK(memcmp(piped.indices, direct.indices, direct.triangle_count * 3 * sizeof *direct.indices) == 0);
    TEST_CHECK(memcmp(piped.materials, direct.materials, direct.triangle_count * sizeof *direct.materials) == 0);
    TEST_CHECK(piped.names.count == direct.names.count && piped.polygon_count == direct.polygon_count &&
               piped.face_count == direct.face_count && piped.source_bytes == size);
    for (uint32_t i = 0; i < direct.names.count; i++) {
        assert_string_equal(tl_name_table_get(&piped.names, i), tl_name_table_get(&direct.names, i));
    }
    tl_imported_mesh_free(&direct);
    tl_imported_mesh_free(&piped);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crash),
        cmocka_unit_test(test_cancel),
        cmocka_unit_test(test_large),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
