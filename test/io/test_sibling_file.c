// SPDX-License-Identifier: MIT
//
// What a file may name: files of its folder, by whatever way; nothing else is opened.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/files/atomic_write.h"
#include "io/files/sibling_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char root[64];

static const char *below(const char *name)
{
    static char paths[4][160];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", root, name);
    return path;
}

static int make_tree(void **state)
{
    (void)state;
    strcpy(root, "/tmp/talus_sibling_XXXXXX");
    bool made = mkdtemp(root) != NULL && mkdir(below("level"), 0700) == 0 && mkdir(below("level/sub"), 0700) == 0 &&
                mkdir(below("level2"), 0700) == 0;
    made = made && tl_atomic_write(below("outside"), "o", 1, NULL) == TL_OK &&
           tl_atomic_write(below("level2/outside"), "o", 1, NULL) == TL_OK &&
           tl_atomic_write(below("level/in"), "in", 2, NULL) == TL_OK &&
           tl_atomic_write(below("level/sub/in"), "sub", 3, NULL) == TL_OK;
    made = made && symlink("../outside", below("level/out_link")) == 0 &&
           symlink("sub/in", below("level/in_link")) == 0 && mkfifo(below("level/pipe"), 0600) == 0;
    return made ? 0 : -1;
}

static int remove_tree(void **state)
{
    (void)state;
    static const char *const files[] = { "outside",        "level2/outside", "level/in",  "level/sub/in",
                                         "level/out_link", "level/in_link",  "level/pipe" };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        unlink(below(files[i]));
    }
    rmdir(below("level/sub"));
    rmdir(below("level"));
    rmdir(below("level2"));
    return rmdir(root);
}

static void test_names(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        tl_result result;
        size_t size;
    } cases[] = {
        { "in", TL_OK, 2 },
        { "./sub/../in", TL_OK, 2 },
        { "sub/in", TL_OK, 3 },
        { "in_link", TL_OK, 3 },
        { "../level/in", TL_OK, 2 },
        { "absent", TL_ERR_IO, 0 },
        { "in/in", TL_ERR_IO, 0 },
        { "", TL_ERR_UNSUPPORTED, 0 },
        { ".", TL_ERR_UNSUPPORTED, 0 },
        { "sub", TL_ERR_UNSUPPORTED, 0 },
        { "pipe", TL_ERR_UNSUPPORTED, 0 },
        { "../outside", TL_ERR_UNSUPPORTED, 0 },
        { "../level2/outside", TL_ERR_UNSUPPORTED, 0 },
        { "out_link", TL_ERR_UNSUPPORTED, 0 },
        { "/dev/zero", TL_ERR_UNSUPPORTED, 0 },
        { "../../../../../../../../dev/zero", TL_ERR_UNSUPPORTED, 0 },
        { "file:///etc/passwd", TL_ERR_UNSUPPORTED, 0 },
        { "http://example.org/x", TL_ERR_UNSUPPORTED, 0 },
        { "c:\\x", TL_ERR_UNSUPPORTED, 0 },
    };
    char path[160];
    strcpy(path, below("level/level.gltf"));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tl_file_map map;
        tl_io_error error;
        tl_result result = tl_sibling_open(path, cases[i].name, path, &map, &error);
        if (result != cases[i].result || map.size != cases[i].size) {
            fail_msg("'%s': %s", cases[i].name, tl_result_name(result));
        }
        TEST_CHECK(result == TL_OK || (strstr(error.message, cases[i].name) != NULL && strcmp(error.path, path) == 0));
        tl_file_map_close(&map);
        TEST_RESULT(tl_sibling_open(NULL, cases[i].name, "standard input", &map, NULL), TL_ERR_UNSUPPORTED);
    }
}

// A path without a folder means the working folder.
static void test_working_folder(void **state)
{
    (void)state;
    char *before = getcwd(NULL, 0);
    tl_file_map map;
    TEST_CHECK(before != NULL && chdir(below("level")) == 0);
    TEST_RESULT(tl_sibling_open("level.gltf", "in", "level.gltf", &map, NULL), TL_OK);
    tl_file_map_close(&map);
    TEST_RESULT(tl_sibling_open("level.gltf", "../outside", "level.gltf", &map, NULL), TL_ERR_UNSUPPORTED);
    TEST_CHECK(chdir(before) == 0);
    free(before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_working_folder),
    };
    return cmocka_run_group_tests(tests, make_tree, remove_tree);
}
