// SPDX-License-Identifier: MIT
//
// Where the bytes of an atomic file go: a temporary file beside its target; or the target itself, where that is a
// device or a pipe, which cannot be replaced. One source a system.

#ifndef TALUS_IO_ATOMIC_SINK_H
#define TALUS_IO_ATOMIC_SINK_H

#include "io/files/io_error.h"

typedef struct tl_atomic_sink tl_atomic_sink;

/// Opens a sink for `path`, as tl_atomic_file_open says. Failures of this and of all calls below are told in
/// `*failure`. Both must outlive the sink. `*sink_out` is NULL on failure.
tl_result tl_atomic_sink_open(const char *path, tl_io_error *failure, tl_atomic_sink **sink_out);

tl_result tl_atomic_sink_write(tl_atomic_sink *sink, const void *bytes, size_t size);

/// Replaces the target; with `flush` both the bytes and the folder are on disk afterwards.
tl_result tl_atomic_sink_replace(tl_atomic_sink *sink, bool flush);

/// Takes a temporary file that has not replaced its target away, and frees the sink. NULL: nothing happens.
void tl_atomic_sink_close(tl_atomic_sink *sink);

#endif
