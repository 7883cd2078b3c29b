// SPDX-License-Identifier: MIT
//
// Files as bytes: regular ones, pipes, standard input, and those that cannot be read.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/files/file_map.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[64];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/talus_file_map_XXXXXX");
    return mkdtemp(folder) != NULL ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder);
}

static void in_folder(const char *name, char path[128])
{
    snprintf(path, 128, "%s/%s", folder, name);
}

static void write_file(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "wb");
    TEST_CHECK(file != NULL);
    TEST_CHECK(fwrite(bytes, 1, size, file) == size);
    fclose(file);
}

static void check_bytes(const tl_file_map *map, unsigned char first, size_t size)
{
    TEST_CHECK(map->size == size && map->bytes != NULL && (uintptr_t)map->bytes % TL_BLOB_ALIGNMENT == 0);
    for (size_t i = 0; i < size; i++) {
        TEST_CHECK(((const unsigned char *)map->bytes)[i] == (unsigned char)(first + i));
    }
}

static void test_sizes(void **state)
{
    (void)state;
    static const size_t sizes[] = { 0, 1, 4095, 4096, 4097, 200000 };
    char path[128];
    in_folder("file", path);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        unsigned char *bytes = malloc(sizes[i] + 1);
        for (size_t k = 0; k < sizes[i]; k++) {
            bytes[k] = (unsigned char)(k + 3);
        }
        write_file(path, bytes, sizes[i]);
        tl_file_map map;
        tl_io_error error;
        TEST_RESULT(tl_file_map_open(path, 0, &map, &error), TL_OK);
        TEST_CHECK(map.mapped == (sizes[i] > 0));
        check_bytes(&map, 3, sizes[i]);
        tl_file_map_close(&map);
        tl_file_map_close(&map);
        TEST_CHECK(map.bytes == NULL && map.size == 0);
        // The limit is the largest size that is accepted.
        if (sizes[i] > 1) {
            TEST_RESULT(tl_file_map_open(path, sizes[i], &map, &error), TL_OK);
            tl_file_map_close(&map);
            TEST_RESULT(tl_file_map_open(path, sizes[i] - 1, &map, &error), TL_ERR_LIMIT);
            TEST_CHECK(map.bytes == NULL && strcmp(error.path, path) == 0);
        }
        free(bytes);
    }
    unlink(path);
}

// Bytes that were read stay what they were, whoever rewrites the file or cuts it short.
static void test_files_that_change(void **state)
{
    (void)state;
    enum { SIZE = 300000 };
    char path[128];
    in_folder("file", path);
    unsigned char *bytes = malloc(SIZE);
    for (size_t k = 0; k < SIZE; k++) {
        bytes[k] = (unsigned char)(k + 3);
    }
    write_file(path, bytes, SIZE);
    tl_file_map map;
    TEST_RESULT(tl_file_read(path, SIZE, &map, NULL), TL_OK);
    TEST_CHECK(!map.mapped);
    TEST_RESULT(tl_file_read(path, SIZE - 1, &(tl_file_map){ 0 }, NULL), TL_ERR_LIMIT);
    memset(bytes, 0xee, SIZE);
    write_file(path, bytes, SIZE);
    check_bytes(&map, 3, SIZE);
    TEST_CHECK(truncate(path, 10) == 0);
    check_bytes(&map, 3, SIZE);
    tl_file_map_close(&map);
    TEST_RESULT(tl_file_read(path, 0, &map, NULL), TL_OK);
    TEST_CHECK(map.size == 10);
    tl_file_map_close(&map);
    free(bytes);
    unlink(path);
}

// A writer at the other end, in a process of its own: a pipe holds 64 KiB at once.
static void test_pipe(void **state)
{
    (void)state;
    enum { SIZE = 300000 };
    char path[128];
    in_folder("pipe", path);
    for (int limited = 0; limited < 2; limited++) {
        TEST_CHECK(mkfifo(path, 0600) == 0);
        pid_t child = fork();
        if (child == 0) {
            signal(SIGPIPE, SIG_IGN);
            FILE *file = fopen(path, "wb");
            for (int i = 0; i < SIZE; i++) {
                putc(i & 255, file);
            }
            fclose(file);
            _exit(0);
        }
        tl_file_map map;
        tl_io_error error;
        tl_result result = tl_file_map_open(path, limited ? SIZE - 1 : SIZE, &map, &error);
        TEST_RESULT(result, limited ? TL_ERR_LIMIT : TL_OK);
        if (result == TL_OK) {
            TEST_CHECK(!map.mapped);
            check_bytes(&map, 0, SIZE);
        }
        tl_file_map_close(&map);
        waitpid(child, NULL, 0);
        unlink(path);
    }
}

static void test_standard_input(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    write_file(path, "\1\2\3\4\5", 5);
    int kept = dup(STDIN_FILENO);
    int file = open(path, O_RDONLY);
    TEST_CHECK(kept >= 0 && file >= 0 && dup2(file, STDIN_FILENO) >= 0);
    close(file);
    char first;
    TEST_CHECK(read(STDIN_FILENO, &first, 1) == 1); // what was read before is gone
    tl_file_map map;
    TEST_RESULT(tl_file_map_open("-", 0, &map, NULL), TL_OK);
    check_bytes(&map, 2, 4);
    tl_file_map_close(&map);
    // Standard input may be closed.
    close(STDIN_FILENO);
    tl_io_error error;
    TEST_RESULT(tl_file_map_open("-", 0, &map, &error), TL_ERR_IO);
    TEST_CHECK(strcmp(error.path, "standard input") == 0);
    dup2(kept, STDIN_FILENO);
    close(kept);
    unlink(path);
}

static void test_refusals(void **state)
{
    (void)state;
    tl_file_map map;
    tl_io_error error;
    char path[128];
    in_folder("missing.obj", path);
    TEST_RESULT(tl_file_map_open(path, 0, &map, &error), TL_ERR_IO);
    TEST_CHECK(error.result == TL_ERR_IO && strcmp(error.path, path) == 0 && map.bytes == NULL);
    TEST_CHECK(strstr(error.message, strerror(ENOENT)) != NULL && error.advice[0] != '\0');
    TEST_RESULT(tl_file_map_open(folder, 0, &map, &error), TL_ERR_IO);
    TEST_CHECK(strstr(error.message, strerror(EISDIR)) != NULL);
    TEST_RESULT(tl_file_map_open("", 0, &map, NULL), TL_ERR_IO);
    in_folder("file", path);
    write_file(path, "x", 1);
    strcat(path, "/below");
    TEST_RESULT(tl_file_map_open(path, 0, &map, &error), TL_ERR_IO);
    in_folder("file", path);
    // Root may read everything, so it becomes somebody else for a moment.
    uid_t user = geteuid();
    chmod(path, 0);
    chmod(folder, 0755);
    TEST_CHECK(user != 0 || seteuid(65534) == 0);
    tl_result result = tl_file_map_open(path, 0, &map, &error);
    TEST_CHECK(seteuid(user) == 0);
    TEST_RESULT(result, TL_ERR_IO);
    TEST_CHECK(strstr(error.message, strerror(EACCES)) != NULL);
    unlink(path);
}

// Files that claim no size, and a device.
static void test_unsized(void **state)
{
    (void)state;
    tl_file_map map;
    if (access("/proc/self/stat", R_OK) == 0) {
        TEST_RESULT(tl_file_map_open("/proc/self/stat", 0, &map, NULL), TL_OK);
        TEST_CHECK(map.size > 10 && !map.mapped);
        tl_file_map_close(&map);
    }
    if (access("/dev/zero", R_OK) == 0) {
        TEST_RESULT(tl_file_map_open("/dev/zero", 1000000, &map, NULL), TL_ERR_LIMIT);
    }
}

// The words of an error: place, message, advice; nothing that drives a terminal; long paths keep their end.
static void test_error_words(void **state)
{
    (void)state;
    tl_io_error error;
    char words[1024];
    TEST_RESULT(tl_io_fail(&error, TL_ERR_FORMAT, "a.obj", 7, "mend it", "'%s' is bad", "x\x1b[31m\xff"),
                TL_ERR_FORMAT);
    size_t length = tl_io_error_format(&error, words, sizeof words);
    assert_string_equal(words, "a.obj:7: 'x?[31m?' is bad (mend it)");
    TEST_CHECK(length == strlen(words));
    TEST_CHECK(tl_io_error_format(&error, words, 8) == length);
    assert_string_equal(words, "a.obj:7");
    tl_io_fail(&error, TL_ERR_FORMAT, "b\n.obj", 0, NULL, "%s",
               "\xc3\xa4\xe2\x82\xac \xc0\x80\xed\xa0\x80\xf5\xc2\x85");
    tl_io_error_format(&error, words, sizeof words);
    assert_string_equal(words, "b?.obj: \xc3\xa4\xe2\x82\xac ????????");
    tl_io_fail(&error, TL_ERR_EMPTY, NULL, 0, NULL, "%s", "");
    tl_io_error_format(&error, words, sizeof words);
    assert_string_equal(words, tl_result_text(TL_ERR_EMPTY));
    char path[TL_IO_PATH_BYTES * 2];
    memset(path, 'p', sizeof path);
    memcpy(path + sizeof path - 7, "/z.obj", 7);
    tl_io_fail(&error, TL_ERR_EMPTY, path, 0, NULL, "x");
    TEST_CHECK(strlen(error.path) == TL_IO_PATH_BYTES - 1 && memcmp(error.path, "...ppp", 6) == 0 &&
               strcmp(error.path + strlen(error.path) - 6, "/z.obj") == 0);
    TEST_RESULT(tl_io_blame(&error, TL_ERR_INDEX, "face", 3), TL_ERR_INDEX);
    TEST_CHECK(strcmp(error.element, "face") == 0 && error.element_index == 3);
    TEST_RESULT(tl_io_fail(NULL, TL_ERR_EMPTY, "a", 0, NULL, "x"), TL_ERR_EMPTY);
    TEST_RESULT(tl_io_blame(NULL, TL_ERR_INDEX, "face", 3), TL_ERR_INDEX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),          cmocka_unit_test(test_files_that_change), cmocka_unit_test(test_pipe),
        cmocka_unit_test(test_standard_input), cmocka_unit_test(test_refusals),          cmocka_unit_test(test_unsized),
        cmocka_unit_test(test_error_words),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
