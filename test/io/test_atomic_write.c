// SPDX-License-Identifier: MIT
//
// Whole files or none: what is in the folder after success, failure, abort and death.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/files/atomic_write.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static char folder[64];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/talus_atomic_XXXXXX");
    return mkdtemp(folder) != NULL ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder); // fails when a test left a file behind
}

static void in_folder(const char *name, char path[128])
{
    snprintf(path, 128, "%s/%s", folder, name);
}

static uint32_t count_files(void)
{
    uint32_t count = 0;
    DIR *directory = opendir(folder);
    TEST_CHECK(directory != NULL);
    for (struct dirent *entry; (entry = readdir(directory)) != NULL;) {
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    }
    closedir(directory);
    return count;
}

static void check_content(const char *path, const char *expected)
{
    char content[256] = { 0 };
    FILE *file = fopen(path, "rb");
    TEST_CHECK(file != NULL);
    size_t size = fread(content, 1, sizeof content - 1, file);
    fclose(file);
    TEST_CHECK(size == strlen(expected));
    assert_string_equal(content, expected);
}

static void test_new_and_replaced(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    mode_t mask = umask(022);
    TEST_RESULT(tl_atomic_write(path, "first", 5, NULL), TL_OK);
    check_content(path, "first");
    struct stat status;
    TEST_CHECK(stat(path, &status) == 0 && (status.st_mode & 0777) == 0644);
    chmod(path, 0640);
    TEST_RESULT(tl_atomic_write(path, "2nd", 3, NULL), TL_OK);
    check_content(path, "2nd");
    TEST_CHECK(stat(path, &status) == 0 && (status.st_mode & 0777) == 0640);
    TEST_RESULT(tl_atomic_write(path, NULL, 0, NULL), TL_OK);
    check_content(path, "");
    TEST_CHECK(count_files() == 1);
    umask(mask);
    unlink(path);
}

// Chunks of all sizes around the buffer's.
static void test_streaming(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    enum { SIZE = 1000000 };
    unsigned char *bytes = malloc(SIZE);
    test_random random = { 1 };
    for (size_t i = 0; i < SIZE; i++) {
        bytes[i] = (unsigned char)test_random_u64(&random);
    }
    static const size_t chunks[] = { 1, 7, 4096, 65535, 65536, 65537, 300000 };
    tl_atomic_file *file;
    TEST_RESULT(tl_atomic_file_open(path, &file, NULL), TL_OK);
    size_t size = 0;
    for (int i = 0; size < SIZE; i++) {
        size_t chunk = chunks[i % 7] < SIZE - size ? chunks[i % 7] : SIZE - size;
        TEST_RESULT(tl_atomic_file_write(file, bytes + size, chunk, NULL), TL_OK);
        size += chunk;
        TEST_CHECK(tl_atomic_file_size(file) == size && access(path, F_OK) != 0);
    }
    TEST_RESULT(tl_atomic_file_commit(file, NULL), TL_OK);
    unsigned char *content = malloc(SIZE + 1);
    FILE *stream = fopen(path, "rb");
    TEST_CHECK(fread(content, 1, SIZE + 1, stream) == SIZE && memcmp(bytes, content, SIZE) == 0);
    fclose(stream);
    free(content);
    free(bytes);
    unlink(path);
}

static void test_abort(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    tl_atomic_file *file;
    TEST_RESULT(tl_atomic_file_open(path, &file, NULL), TL_OK);
    TEST_RESULT(tl_atomic_file_write(file, "x", 1, NULL), TL_OK);
    tl_atomic_file_abort(file);
    TEST_CHECK(count_files() == 0);
    TEST_RESULT(tl_atomic_write(path, "old", 3, NULL), TL_OK);
    TEST_RESULT(tl_atomic_file_open(path, &file, NULL), TL_OK);
    TEST_RESULT(tl_atomic_file_write(file, "new", 3, NULL), TL_OK);
    tl_atomic_file_abort(file);
    check_content(path, "old");
    TEST_CHECK(count_files() == 1);
    tl_atomic_file_abort(NULL);
    unlink(path);
}

// Two of one name at once: the last commit wins, nothing is mixed.
static void test_two_at_once(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    tl_atomic_file *files[2];
    for (int i = 0; i < 2; i++) {
        TEST_RESULT(tl_atomic_file_open(path, &files[i], NULL), TL_OK);
        TEST_RESULT(tl_atomic_file_write(files[i], i == 0 ? "aaaa" : "bb", i == 0 ? 4 : 2, NULL), TL_OK);
    }
    TEST_RESULT(tl_atomic_file_commit(files[1], NULL), TL_OK);
    check_content(path, "bb");
    TEST_RESULT(tl_atomic_file_commit(files[0], NULL), TL_OK);
    check_content(path, "aaaa");
    TEST_CHECK(count_files() == 1);
    unlink(path);
}

static void test_symbolic_link(void **state)
{
    (void)state;
    char path[128];
    char link[128];
    in_folder("file", path);
    in_folder("link", link);
    TEST_RESULT(tl_atomic_write(path, "old", 3, NULL), TL_OK);
    TEST_CHECK(symlink("file", link) == 0);
    TEST_RESULT(tl_atomic_write(link, "new", 3, NULL), TL_OK);
    struct stat status;
    TEST_CHECK(lstat(link, &status) == 0 && S_ISLNK(status.st_mode));
    check_content(path, "new");
    TEST_CHECK(count_files() == 2);
    unlink(link);
    unlink(path);
}

static void test_relative_path(void **state)
{
    (void)state;
    char *back = getcwd(NULL, 0);
    TEST_CHECK(back != NULL && chdir(folder) == 0);
    TEST_RESULT(tl_atomic_write("file", "here", 4, NULL), TL_OK);
    check_content("file", "here");
    unlink("file");
    TEST_CHECK(chdir(back) == 0);
    free(back);
}

static void check_refused(const char *path, tl_result result, int reason)
{
    tl_atomic_file *file;
    tl_io_error error;
    TEST_RESULT(tl_atomic_file_open(path, &file, &error), result);
    TEST_CHECK(file == NULL && error.result == result && strcmp(error.path, path) == 0);
    TEST_CHECK(strstr(error.message, strerror(reason)) != NULL && error.advice[0] != '\0');
    TEST_CHECK(count_files() <= 1);
}

static void test_refusals(void **state)
{
    (void)state;
    char path[128];
    check_refused(folder, TL_ERR_IO, EISDIR);
    in_folder("missing/file", path);
    check_refused(path, TL_ERR_IO, ENOENT);
    in_folder("new/", path);
    check_refused(path, TL_ERR_IO, EISDIR);
    check_refused("", TL_ERR_IO, ENOENT);
    in_folder("file", path);
    TEST_RESULT(tl_atomic_write(path, "x", 1, NULL), TL_OK);
    char below[160];
    snprintf(below, sizeof below, "%s/below", path);
    check_refused(below, TL_ERR_IO, ENOTDIR);
    // Root may write everywhere, so it becomes somebody else for a moment.
    uid_t user = geteuid();
    chmod(path, 0444);
    chmod(folder, 0555);
    TEST_CHECK(user != 0 || seteuid(65534) == 0);
    check_refused(path, TL_ERR_IO, EACCES);
    in_folder("new", below);
    check_refused(below, TL_ERR_IO, EACCES);
    TEST_CHECK(seteuid(user) == 0);
    chmod(folder, 0755);
    unlink(path);
    // A file system that takes no files.
    if (access("/proc/self", F_OK) == 0) {
        tl_atomic_file *file;
        tl_io_error error;
        TEST_CHECK(tl_atomic_file_open("/proc/talus", &file, &error) != TL_OK && file == NULL);
        TEST_CHECK(strcmp(error.path, "/proc/talus") == 0 && error.message[0] != '\0');
    }
}

// A full device: written to directly, and the failure sticks.
static void test_full_device(void **state)
{
    (void)state;
    if (access("/dev/full", W_OK) != 0) {
        skip();
    }
    tl_atomic_file *file;
    tl_io_error error;
    char *bytes = calloc(1, 100000);
    TEST_RESULT(tl_atomic_file_open("/dev/full", &file, &error), TL_OK);
    TEST_RESULT(tl_atomic_file_write(file, bytes, 10, &error), TL_OK); // still in the buffer
    TEST_RESULT(tl_atomic_file_write(file, bytes, 100000, &error), TL_ERR_IO);
    TEST_CHECK(strstr(error.message, strerror(ENOSPC)) != NULL && strcmp(error.path, "/dev/full") == 0);
    TEST_RESULT(tl_atomic_file_write(file, bytes, 1, NULL), TL_ERR_IO);
    memset(&error, 0, sizeof error);
    TEST_RESULT(tl_atomic_file_commit(file, &error), TL_ERR_IO);
    TEST_CHECK(strstr(error.message, strerror(ENOSPC)) != NULL);
    // What is small fails at the commit.
    TEST_RESULT(tl_atomic_write("/dev/full", bytes, 10, &error), TL_ERR_IO);
    struct stat status;
    TEST_CHECK(stat("/dev/full", &status) == 0 && S_ISCHR(status.st_mode)); // not replaced by a file
    TEST_RESULT(tl_atomic_write("/dev/null", bytes, 100000, &error), TL_OK);
    free(bytes);
}

// A limit on file sizes stands for a disk that runs full in the middle; in a child, because it cannot be taken back.
static void test_size_limit(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    TEST_RESULT(tl_atomic_write(path, "old", 3, NULL), TL_OK);
    pid_t child = fork();
    if (child == 0) {
        struct rlimit limit = { 100000, 100000 };
        char *bytes = calloc(1, 70000);
        tl_atomic_file *file;
        tl_io_error error;
        signal(SIGXFSZ, SIG_IGN);
        bool right = setrlimit(RLIMIT_FSIZE, &limit) == 0 && tl_atomic_file_open(path, &file, &error) == TL_OK &&
                     tl_atomic_file_write(file, bytes, 70000, &error) == TL_OK &&
                     tl_atomic_file_write(file, bytes, 70000, &error) == TL_ERR_IO &&
                     strstr(error.message, strerror(EFBIG)) != NULL && tl_atomic_file_commit(file, &error) == TL_ERR_IO;
        _exit(right ? 0 : 1);
    }
    int status;
    TEST_CHECK(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
    check_content(path, "old");
    TEST_CHECK(count_files() == 1);
    unlink(path);
}

// Killed in the middle: nothing is left where unnamed temporary files are known, at most a temporary file elsewhere.
static void test_killed(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    TEST_RESULT(tl_atomic_write(path, "old", 3, NULL), TL_OK);
#ifdef O_TMPFILE
    int probe = open(folder, O_WRONLY | O_TMPFILE, 0600);
#else
    int probe = -1;
#endif
    pid_t child = fork();
    if (child == 0) {
        char *bytes = calloc(1, 200000);
        tl_atomic_file *file;
        if (tl_atomic_file_open(path, &file, NULL) == TL_OK &&
            tl_atomic_file_write(file, bytes, 200000, NULL) == TL_OK) {
            raise(SIGKILL);
        }
        _exit(1);
    }
    int status;
    TEST_CHECK(waitpid(child, &status, 0) == child && WIFSIGNALED(status));
    check_content(path, "old");
    if (probe >= 0) {
        TEST_CHECK(count_files() == 1);
        close(probe);
    } else {
        char command[160];
        snprintf(command, sizeof command, "%s/.talus-%lld-0.tmp", folder, (long long)child);
        unlink(command);
    }
    unlink(path);
}

static void test_standard_output(void **state)
{
    (void)state;
    char path[128];
    in_folder("file", path);
    fflush(stdout);
    int kept = dup(STDOUT_FILENO);
    int file = open(path, O_WRONLY | O_CREAT, 0600);
    dup2(file, STDOUT_FILENO);
    close(file);
    tl_result result = tl_atomic_write("-", "to the output", 13, NULL);
    tl_result again = tl_atomic_write("-", ", twice", 7, NULL); // it was not closed
    dup2(kept, STDOUT_FILENO);
    close(kept);
    TEST_RESULT(result, TL_OK);
    TEST_RESULT(again, TL_OK);
    check_content(path, "to the output, twice");
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_new_and_replaced),
        cmocka_unit_test(test_streaming),
        cmocka_unit_test(test_abort),
        cmocka_unit_test(test_two_at_once),
        cmocka_unit_test(test_symbolic_link),
        cmocka_unit_test(test_relative_path),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_full_device),
        cmocka_unit_test(test_size_limit),
        cmocka_unit_test(test_killed),
        cmocka_unit_test(test_standard_output),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
