// SPDX-License-Identifier: MIT
//
// What a command may write to: never a file that it reads, and no name whose ending promises another format.

#ifndef TALUS_CLI_OUTPUT_CHECK_H
#define TALUS_CLI_OUTPUT_CHECK_H

#include "cli/options/options.h"

/// The endings of pictures; NULL-terminated, for TL_OPTION_OUTPUT.
extern const char *const tl_picture_endings[];

/// Whether `path` ends in `ending` (".png"), whatever the case of its letters.
bool tl_has_ending(const char *path, const char *ending);

/// Refuses a second input that is standard input ("-"). Holds each TL_OPTION_OUTPUT that was given against all words
/// and each TL_OPTION_INPUT: files are compared by device and inode, so that links and other spellings are seen
/// through; and its ending against those it lists. False: `arguments->message` names the option, the file and what to
/// do.
bool tl_outputs_check(const tl_option_group *groups, tl_arguments *arguments);

#endif
