// SPDX-License-Identifier: MIT

#include "cli/options/same_file.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool tl_is_stream(const char *path)
{
    struct stat status;
    return strcmp(path, "-") == 0 || (stat(path, &status) == 0 && !S_ISREG(status.st_mode));
}

bool tl_is_same_file(const char *output, const char *input)
{
    struct stat written, status;
    if (stat(output, &written) != 0) {
        return false;
    }
    const bool there = strcmp(input, "-") == 0 ? fstat(STDIN_FILENO, &status) == 0 : stat(input, &status) == 0;
    return there && status.st_dev == written.st_dev && status.st_ino == written.st_ino;
}
