// SPDX-License-Identifier: MIT
//
// Completion scripts for shells, out of the tables that the help is printed from.

#ifndef TALUS_CLI_COMPLETION_H
#define TALUS_CLI_COMPLETION_H

#include <stdbool.h>

/// Prints the script for "bash", "zsh" or "fish". False: no other shell is known.
bool tl_completion_print(const char *shell);

#endif
