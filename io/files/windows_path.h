// SPDX-License-Identifier: MIT
//
// Windows: paths of talus are UTF-8, those of the system UTF-16; its reasons have numbers of their own.

#ifndef TALUS_IO_WINDOWS_PATH_H
#define TALUS_IO_WINDOWS_PATH_H

#ifdef _WIN32

#include <stdbool.h>
#include <stddef.h>

/// The path as the system wants it, freed with free(): absolute behind "\\?\" where it is longer than the 260
/// characters that old calls take. NULL, with errno: ENOMEM, EILSEQ (no UTF-8), ENOENT (no path at all).
wchar_t *tl_wide_path(const char *path);

/// The reason that GetLastError gives, as an errno that tl_io_fail_system has words for.
int tl_windows_errno(void);

#endif

#endif
