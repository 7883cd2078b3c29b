// SPDX-License-Identifier: MIT
//
// What went wrong with a file: the result, the place (file, line, element), a sentence, and what to do about it.
//
// The core reports through tl_report, which has static texts only. Files need more: a path, a line, the operating
// system's reason, the offending text. All of io fills this one struct, and one function puts it into words.

#ifndef TALUS_IO_IO_ERROR_H
#define TALUS_IO_IO_ERROR_H

#include <talus/base.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TL_IO_PATH_BYTES    512
#define TL_IO_MESSAGE_BYTES 256
#define TL_IO_ADVICE_BYTES  128
#define TL_IO_ELEMENT_BYTES 16

/// Holds no pointer: it may be copied, kept and dropped. All zero is "no error". A function that
/// takes an `error_out` fills it when it fails, and leaves it alone when it succeeds.
typedef struct tl_io_error {
    tl_result result;
    uint64_t line;                     ///< in a text file, from 1; 0 when no line is to blame
    uint64_t element_index;            ///< of the offending element in the file, from 0, or TL_NO_ELEMENT
    char element[TL_IO_ELEMENT_BYTES]; ///< its kind ("face", "vertex", "node"), or ""
    char advice[TL_IO_ADVICE_BYTES];   ///< what to do, or ""
    char path[TL_IO_PATH_BYTES];       ///< as the caller gave it; a longer one keeps its end, behind "..."
    char message[TL_IO_MESSAGE_BYTES]; ///< what is wrong, without path, line and full stop
} tl_io_error;

#if defined(__MINGW32__)
#define TL_IO_PRINTF(format_index, first) __attribute__((format(gnu_printf, format_index, first)))
#elif defined(__GNUC__)
#define TL_IO_PRINTF(format_index, first) __attribute__((format(printf, format_index, first)))
#else
#define TL_IO_PRINTF(format_index, first)
#endif

/// Fills `error` (NULL is allowed) and returns `result`, so that it reads `return tl_io_fail(error, TL_ERR_FORMAT,
/// ...);`. `path` may be NULL. The message is cut at TL_IO_MESSAGE_BYTES; bytes outside printable ASCII become '?'
/// unless they are part of well-formed UTF-8 text, so a hostile file cannot drive the user's terminal.
tl_result tl_io_fail(tl_io_error *error, tl_result result, const char *path, uint64_t line, const char *advice,
                     const char *format, ...) TL_IO_PRINTF(6, 7);

/// The same for a refusal of the operating system: TL_ERR_IO (TL_ERR_MEMORY for ENOMEM). The message is "cannot
/// <action>: <reason>", the advice fits the reason.
tl_result tl_io_fail_system(tl_io_error *error, const char *path, const char *action, int error_number);

/// Names the offending element in an error that tl_io_fail has filled. Returns error->result, or `result` when NULL.
tl_result tl_io_blame(tl_io_error *error, tl_result result, const char *element, uint64_t element_index);

/// Writes "file:line: message (advice)" into `text`, always terminated, cut at `capacity` (> 0). Returns the length
/// of the whole, without the terminator. An error without message gets tl_result_text.
size_t tl_io_error_format(const tl_io_error *error, char *text, size_t capacity);

#ifdef __cplusplus
}
#endif

#endif
