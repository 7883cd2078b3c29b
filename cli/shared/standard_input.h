// SPDX-License-Identifier: MIT
//
// Standard input as FILE: a pipe is copied to a temporary file that takes its place, so that its first bytes can be
// looked at before a reader is chosen, and Ctrl-C ends the wait for it.

#ifndef TALUS_CLI_STANDARD_INPUT_H
#define TALUS_CLI_STANDARD_INPUT_H

#include "io/files/io_error.h"

/// Makes standard input a file that can be read again from where it stands now. TL_ERR_CANCELLED: Ctrl-C.
tl_result tl_standard_input_hold(tl_io_error *error_out);

/// Copies at most `capacity` of the bytes that come next, without taking them; after tl_standard_input_hold.
size_t tl_standard_input_peek(void *bytes, size_t capacity);

#endif
