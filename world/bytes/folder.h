// SPDX-License-Identifier: MIT
//
// Folders, and what the system says of a file. One source a system.

#ifndef TALUS_WORLD_FOLDER_H
#define TALUS_WORLD_FOLDER_H

#include "io/files/io_error.h"

#include <stdbool.h>

typedef struct tl_file_facts {
    uint64_t size;    ///< bytes
    uint64_t changed; ///< nanoseconds since 1970, as fine as the system knows
    bool is_folder;
} tl_file_facts;

/// Whether the file is there; `facts_out` may be NULL, and is zeroed when it is not.
bool tl_file_look(const char *path, tl_file_facts *facts_out);

/// Makes a folder, which may be there already. Those above it must be.
tl_result tl_folder_make(const char *path, tl_io_error *error_out);

/// Hands over the name of each entry but "." and "..", in the system's order.
typedef tl_result tl_folder_entry_fn(const char *name, void *user);
tl_result tl_folder_list(const char *path, tl_folder_entry_fn *entry, void *user, tl_io_error *error_out);

/// The path from the root on, freed with free(); NULL when there is no such file or memory is out.
char *tl_full_path(const char *path);

/// Takes a file away; one that is not there is fine.
void tl_file_remove(const char *path);

#endif
