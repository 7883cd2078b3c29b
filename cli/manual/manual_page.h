// SPDX-License-Identifier: MIT
//
// Manual pages, out of the tables that the help is printed from.

#ifndef TALUS_CLI_MANUAL_PAGE_H
#define TALUS_CLI_MANUAL_PAGE_H

#include "cli/shared/command.h"

/// Prints talus-NAME.1 for a command, or talus.1, which lists all, for NULL. In man(7)'s macros.
void tl_manual_page_print(const tl_command *command);

#endif
