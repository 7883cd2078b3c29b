// SPDX-License-Identifier: MIT

#include "cli/shared/standard_input.h"

#include "cli/shared/interrupt.h"

#include <errno.h>
#include <stdio.h>
#include <sys/types.h>
#include <unistd.h>

enum { COPY_BYTES = 1 << 16 };

static const char name[] = "standard input";

static tl_result fail_hold(tl_io_error *error)
{
    return tl_interrupted() ? tl_io_fail(error, TL_ERR_CANCELLED, name, 0, NULL, "cancelled")
                            : tl_io_fail_system(error, name, "read", errno);
}

static tl_result copy_stream(FILE *file, tl_io_error *error)
{
    char bytes[COPY_BYTES];
    for (;;) {
        const ssize_t got = read(STDIN_FILENO, bytes, sizeof(bytes));
        if (got < 0 && errno == EINTR && !tl_interrupted()) {
            continue;
        }
        if (got < 0 || tl_interrupted()) {
            return fail_hold(error);
        }
        if (got == 0) {
            return TL_OK;
        }
        if (fwrite(bytes, 1, (size_t)got, file) != (size_t)got) {
            return fail_hold(error);
        }
    }
}

tl_result tl_standard_input_hold(tl_io_error *error_out)
{
    if (lseek(STDIN_FILENO, 0, SEEK_CUR) >= 0) {
        return TL_OK; // a file already
    }
    FILE *file = tmpfile();
    if (file == NULL) {
        return fail_hold(error_out);
    }
    tl_result result = copy_stream(file, error_out);
    if (result == TL_OK && (fflush(file) != 0 || lseek(fileno(file), 0, SEEK_SET) != 0 ||
                            dup2(fileno(file), STDIN_FILENO) != STDIN_FILENO)) {
        result = fail_hold(error_out);
    }
    fclose(file);
    return result;
}

size_t tl_standard_input_peek(void *bytes, size_t capacity)
{
    const off_t at = lseek(STDIN_FILENO, 0, SEEK_CUR);
    const ssize_t got = at >= 0 ? pread(STDIN_FILENO, bytes, capacity, at) : -1;
    return got > 0 ? (size_t)got : 0;
}
