// SPDX-License-Identifier: MIT
//
// Ctrl-C as a flag that the progress hook looks at, so that a build ends in order and no partial file is left.

#ifndef TALUS_CLI_INTERRUPT_H
#define TALUS_CLI_INTERRUPT_H

#include <stdbool.h>

/// From now on the first SIGINT, SIGTERM or SIGHUP sets the flag, and a second one kills as usual.
void tl_interrupt_catch(void);
bool tl_interrupted(void);

/// For work that never looks at tl_interrupted and has nothing to clean up: a signal ends the program from now on, with
/// the exit code of a cancelled run.
void tl_interrupt_ends(void);

#endif
