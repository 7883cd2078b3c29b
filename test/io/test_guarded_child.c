// SPDX-License-Identifier: MIT
//
// What POSIX does with children that crash, wait or take too much memory; the sandbox; a large mesh through the pipe.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/mesh/assimp_reader.h"
#include "io/mesh/import_process.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/socket.h>
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
    tl_mesh_source source = { "level.ply", NULL, page, 4096, "ply", false, { 0.0 } };
    TEST_RESULT(tl_read_isolated(tl_assimp_read, &source, NULL, NULL, &mesh, &error), TL_ERR_FORMAT);
    TEST_CHECK(error.result == TL_ERR_FORMAT && strcmp(error.path, "level.ply") == 0 && mesh.vertices == NULL);
    TEST_CHECK(strstr(error.message, "reader failed") != NULL);
    TEST_RESULT(tl_read_isolated(tl_assimp_read, &source, NULL, NULL, &mesh, NULL), TL_ERR_FORMAT);
    munmap(page, 4096);
    TEST_CHECK(waitpid(-1, NULL, WNOHANG) == -1); // no child is left
}

static const tl_mesh_source any_source = { "level.x", NULL, "", 0, "x", false, { 0.0 } };

static tl_result wait_for_ever(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                               tl_io_error *error_out)
{
    (void)source;
    (void)allocator;
    (void)mesh_out;
    (void)error_out;
    while (pause() != 0) {
    }
    return TL_OK;
}

// The child waits until the wall clock has its say: it takes no processor time.
static void test_waiting(void **state)
{
    (void)state;
    tl_imported_mesh mesh;
    tl_io_error error;
    tl_import_limits limits = { 1, 0 };
    TEST_RESULT(tl_read_isolated(wait_for_ever, &any_source, &limits, NULL, &mesh, &error), TL_ERR_LIMIT);
    TEST_CHECK(strstr(error.message, "after 1 s") != NULL);
    TEST_CHECK(waitpid(-1, NULL, WNOHANG) == -1);
}

static tl_result take_memory(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                             tl_io_error *error_out)
{
    (void)allocator;
    (void)mesh_out;
    void *volatile block = malloc((size_t)1 << 30); // volatile: a compiler may leave out a pair that nothing looks at
    if (block == NULL) {
        return tl_io_fail(error_out, TL_ERR_MEMORY, source->name, 0, NULL, "out of memory");
    }
    free(block);
    return tl_io_fail(error_out, TL_ERR_EMPTY, source->name, 0, NULL, "had enough");
}

#if defined(__SANITIZE_ADDRESS__)
#define LIMITS_MEMORY 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer) || __has_feature(thread_sanitizer)
#define LIMITS_MEMORY 0
#endif
#endif
#ifndef LIMITS_MEMORY
#define LIMITS_MEMORY 1
#endif

static void test_memory_limit(void **state)
{
    (void)state;
    tl_imported_mesh mesh;
    tl_io_error error;
    tl_import_limits narrow = { 0, (uint64_t)100 << 20 };
    if (LIMITS_MEMORY) {
        TEST_RESULT(tl_read_isolated(take_memory, &any_source, &narrow, NULL, &mesh, &error), TL_ERR_LIMIT);
        TEST_CHECK(strstr(error.message, "more than 104 MB") != NULL);
    }
    TEST_RESULT(tl_read_isolated(take_memory, &any_source, NULL, NULL, &mesh, &error), TL_ERR_EMPTY);
}

// What a reader that was taken over might try, and what it needs.
static tl_result try_to_break_out(const tl_mesh_source *source, const tl_allocator *allocator,
                                  tl_imported_mesh *mesh_out, tl_io_error *error_out)
{
    (void)allocator;
    (void)mesh_out;
    char outcome[16];
    memset(outcome, 0, sizeof outcome);
    char *program[] = { (char *)(uintptr_t) "/bin/true", NULL };
    const bool refused[] = {
        open("/tmp/talus_break_out", O_WRONLY | O_CREAT, 0600) < 0 && errno == EPERM,
        open("/dev/null", O_RDWR) < 0 && errno == EPERM,
        socket(AF_INET, SOCK_STREAM, 0) < 0 && errno == EPERM,
        fork() < 0 && errno == EPERM,
        execv(program[0], program) < 0 && errno == EPERM,
        kill(getppid(), 0) < 0, // getppid is refused too
        write(STDERR_FILENO, "x", 1) < 0 && errno == EPERM,
        unlink("/tmp/talus_break_out") < 0 && errno == EPERM,
        mkdir("/tmp/talus_break_out", 0700) < 0 && errno == EPERM,
        chmod("/tmp", 0777) < 0 && errno == EPERM,
    };
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; i++) {
        outcome[i] = refused[i] ? '-' : (char)('0' + i);
    }
    int file = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
    char bytes[64];
    const bool reads = file >= 0 && read(file, bytes, sizeof bytes) > 0 && close(file) == 0;
    void *volatile block = malloc((size_t)64 << 20);
    const bool allocates = block != NULL;
    free(block);
    return tl_io_fail(error_out, TL_ERR_EMPTY, source->name, 0, NULL, "%s%s%s", outcome, reads ? "r" : "",
                      allocates ? "a" : "");
}

static tl_result make_nothing(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                              tl_io_error *error_out)
{
    (void)source;
    (void)error_out;
    tl_imported_mesh_init(mesh_out, allocator);
    return TL_OK;
}

static void test_sandbox(void **state)
{
    (void)state;
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(tl_read_isolated(make_nothing, &any_source, NULL, NULL, &mesh, &error), TL_OK);
    const tl_isolation isolation = mesh.isolation;
    print_message("isolation: %s\n", tl_isolation_name(isolation));
    tl_imported_mesh_free(&mesh);
    if (isolation != TL_ISOLATION_SANDBOX) {
        TEST_CHECK(isolation == TL_ISOLATION_PROCESS);
        skip(); // sanitizers, another system, or a kernel that refuses
    }
    TEST_RESULT(tl_read_isolated(try_to_break_out, &any_source, NULL, NULL, &mesh, &error), TL_ERR_EMPTY);
    assert_string_equal(error.message, "----------ra");
    TEST_CHECK(access("/tmp/talus_break_out", F_OK) != 0);
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
    tl_mesh_source source = { "a.ply", NULL, text, size, "ply", false, { 0.0 } };
    TEST_RESULT(tl_assimp_read(&source, NULL, &direct, NULL), TL_OK);
    TEST_RESULT(tl_read_isolated(tl_assimp_read, &source, NULL, NULL, &piped, NULL), TL_OK);
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
        cmocka_unit_test(test_crash),   cmocka_unit_test(test_waiting), cmocka_unit_test(test_memory_limit),
        cmocka_unit_test(test_sandbox), cmocka_unit_test(test_large),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
