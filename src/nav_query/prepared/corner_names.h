// SPDX-License-Identifier: MIT
//
// The numbers of a visibility graph's corner vertices by their names in rings (corner_names.c).

#ifndef TALUS_SRC_NAV_QUERY_CORNER_NAMES_H
#define TALUS_SRC_NAV_QUERY_CORNER_NAMES_H

#include <talus/base.h>

/// A hash table with open addressing. All 0: it is empty.
typedef struct tl_nav_corner_names {
    uint64_t *entries; ///< name << 32 | number; 0: none
    uint32_t capacity; ///< of entries, a power of two, at least twice as many as there are
    uint32_t count;
} tl_nav_corner_names;

/// The number of a name, or TL_NAV_NO_VERTEX.
uint32_t tl_nav_find_name(const tl_nav_corner_names *names, uint32_t turn);
/// Gives a name, not 0, a number, in place of the one that it had. TL_ERR_MEMORY.
tl_result tl_nav_set_name(const tl_allocator *allocator, tl_nav_corner_names *names, uint32_t turn, uint32_t vertex);
/// Forgets a name that is known.
void tl_nav_drop_name(tl_nav_corner_names *names, uint32_t turn);
void tl_nav_free_names(const tl_allocator *allocator, tl_nav_corner_names *names);

#endif
