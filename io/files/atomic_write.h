// SPDX-License-Identifier: MIT
//
// Atomic files: written beside their target, flushed to disk, then renamed over it, so that a file is whole or absent.
//
//   tl_atomic_file *file;
//   tl_atomic_file_open(path, &file, &error);
//   tl_atomic_file_write(file, bytes, size, &error);   any number of times
//   tl_atomic_file_commit(file, &error);               or tl_atomic_file_abort(file)
//
// Until the commit returns TL_OK the target is as it was before. Where the file system knows unnamed files (Linux,
// O_TMPFILE) even a killed process leaves nothing behind; elsewhere the temporary file ".talus-PID-N.tmp" in the
// target's folder is removed by commit and abort, so a program that catches Ctrl-C must abort its open files.

#ifndef TALUS_IO_ATOMIC_WRITE_H
#define TALUS_IO_ATOMIC_WRITE_H

#include "io/files/io_error.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A file being written. Not thread safe; different files are independent.
typedef struct tl_atomic_file tl_atomic_file;

/// Starts to write `path`; its folder must exist. An existing file keeps its permissions, a symbolic link keeps
/// pointing at the file that is replaced. "-" (standard output), devices and pipes cannot be replaced: what is written
/// goes to them directly. Errors: TL_ERR_IO, TL_ERR_MEMORY; then `*file_out` is NULL.
tl_result tl_atomic_file_open(const char *path, tl_atomic_file **file_out, tl_io_error *error_out);

/// Appends. After a failure (disk full) every later write and the commit fail in the same way.
tl_result tl_atomic_file_write(tl_atomic_file *file, const void *bytes, size_t size, tl_io_error *error_out);

/// Flushes to disk, replaces the target, flushes the folder, and frees `file` whatever the outcome. On failure the
/// target is untouched and no temporary file is left.
tl_result tl_atomic_file_commit(tl_atomic_file *file, tl_io_error *error_out);

/// The same without waiting for the disk, for files of which there are thousands, that carry a checksum of their own
/// and can be made again: a process that is killed leaves a whole file or none, a loss of power may leave a damaged
/// one.
tl_result tl_atomic_file_commit_unflushed(tl_atomic_file *file, tl_io_error *error_out);

/// Discards what was written and frees `file`. NULL: nothing happens.
void tl_atomic_file_abort(tl_atomic_file *file);

/// Bytes written so far.
uint64_t tl_atomic_file_size(const tl_atomic_file *file);

/// All in one call.
tl_result tl_atomic_write(const char *path, const void *bytes, size_t size, tl_io_error *error_out);

/// All in one call, with tl_atomic_file_commit_unflushed.
tl_result tl_atomic_write_unflushed(const char *path, const void *bytes, size_t size, tl_io_error *error_out);

#ifdef __cplusplus
}
#endif

#endif
