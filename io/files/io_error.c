// SPDX-License-Identifier: MIT
//
// Errors of files in words.

#define _POSIX_C_SOURCE 200809L

#include "io/files/io_error.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

// Length of the well-formed UTF-8 sequence at `text`, or 0. Overlong forms and surrogates are refused, and so are the
// control characters U+0080 to U+009F, which terminals obey (RFC 3629, table 3-7 of the Unicode standard).
static size_t utf8_length(const unsigned char *text)
{
    unsigned char lead = text[0];
    size_t length = lead >= 0xf0 && lead <= 0xf4  ? 4
                    : lead >= 0xe0 && lead < 0xf0 ? 3
                    : lead >= 0xc2 && lead < 0xe0 ? 2
                                                  : 0;
    for (size_t i = 1; i < length; i++) {
        if ((text[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    bool overlong = (lead == 0xe0 && text[1] < 0xa0) || (lead == 0xf0 && text[1] < 0x90);
    bool surrogate = lead == 0xed && text[1] >= 0xa0;
    bool too_large = lead == 0xf4 && text[1] >= 0x90;
    bool control = lead == 0xc2 && text[1] < 0xa0;
    return overlong || surrogate || too_large || control ? 0 : length;
}

static void make_printable(char *text)
{
    unsigned char *at = (unsigned char *)text;
    while (*at != 0) {
        size_t length = *at >= 0x80 ? utf8_length(at) : 0;
        if (length > 0) {
            at += length;
            continue;
        }
        if (*at < 0x20 || *at >= 0x7f) {
            *at = '?';
        }
        at++;
    }
}

static void set_path(tl_io_error *error, const char *path)
{
    size_t length = strlen(path);
    if (length < sizeof error->path) {
        memcpy(error->path, path, length + 1);
        return;
    }
    size_t kept = sizeof error->path - 4;
    memcpy(error->path, "...", 3);
    memcpy(error->path + 3, path + length - kept, kept + 1);
}

tl_result tl_io_fail(tl_io_error *error, tl_result result, const char *path, uint64_t line, const char *advice,
                     const char *format, ...)
{
    if (error == NULL) {
        return result;
    }
    memset(error, 0, sizeof *error);
    error->result = result;
    error->line = line;
    error->element_index = TL_NO_ELEMENT;
    snprintf(error->advice, sizeof error->advice, "%s", advice != NULL ? advice : "");
    make_printable(error->advice);
    if (path != NULL) {
        set_path(error, path);
    }
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    make_printable(error->message);
    return result;
}

static const char *system_advice(int error_number)
{
    switch (error_number) {
    case ENOENT:
    case ENOTDIR:
        return "check the path";
    case EACCES:
    case EPERM:
    case EROFS:
        return "check the permissions, or choose another place";
    case EISDIR:
        return "name a file, not a folder";
    case EBUSY:
        return "close the programs that have it open, or choose another place";
    case ENOSPC:
#ifdef EDQUOT
    case EDQUOT:
#endif
        return "free some room on the disk, or choose another place";
    case EFBIG:
        return "raise the file size limit (ulimit -f), or choose another place";
    default:
        return NULL;
    }
}

tl_result tl_io_fail_system(tl_io_error *error, const char *path, const char *action, int error_number)
{
    tl_result result = error_number == ENOMEM ? TL_ERR_MEMORY : TL_ERR_IO;
    // strerror's text may be shared between threads; strerror_r has two signatures, of which this is the XSI one.
    char reason[128];
#ifdef _WIN32
    if (strerror_s(reason, sizeof reason, error_number) != 0) {
#else
    if (strerror_r(error_number, reason, sizeof reason) != 0) {
#endif
        snprintf(reason, sizeof reason, "system error %d", error_number);
    }
    return tl_io_fail(error, result, path, 0, system_advice(error_number), "cannot %s: %s", action, reason);
}

tl_result tl_io_blame(tl_io_error *error, tl_result result, const char *element, uint64_t element_index)
{
    if (error == NULL) {
        return result;
    }
    snprintf(error->element, sizeof error->element, "%s", element);
    error->element_index = element_index;
    return result;
}

size_t tl_io_error_format(const tl_io_error *error, char *text, size_t capacity)
{
    char line[32] = "";
    if (error->line != 0) {
        snprintf(line, sizeof line, "%llu:", (unsigned long long)error->line);
    }
    char path[TL_IO_PATH_BYTES];
    memcpy(path, error->path, sizeof path);
    make_printable(path);
    const char *message = error->message[0] != '\0' ? error->message : tl_result_text(error->result);
    bool advice = error->advice[0] != '\0';
    int length = snprintf(text, capacity, "%s%s%s%s%s%s%s%s", path, path[0] != '\0' ? ":" : "", line,
                          path[0] != '\0' || line[0] != '\0' ? " " : "", message, advice ? " (" : "", error->advice,
                          advice ? ")" : "");
    return length > 0 ? (size_t)length : 0;
}
