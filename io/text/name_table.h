// SPDX-License-Identifier: MIT
//
// Names to small numbers: each different name gets the next id, in order of first appearance.

#ifndef TALUS_IO_NAME_TABLE_H
#define TALUS_IO_NAME_TABLE_H

#include <talus/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Zero is a valid empty table. It keeps a copy of each name; the allocator is passed to each call that needs it.
typedef struct tl_name_table {
    char *text; ///< the names one after another, each with its terminating zero
    size_t text_size;
    size_t text_capacity;
    uint64_t *offsets; ///< [count]: where each begins in text
    uint32_t count;
    uint32_t capacity;
    uint32_t *slots; ///< open hash, id + 1 or 0
    uint32_t slot_count;
} tl_name_table;

/// The id of the name of `size` bytes at `name`, added when it is new. Bytes behind an embedded zero are cut off.
/// Errors: TL_ERR_LIMIT when it would get an id >= `max_count`; TL_ERR_MEMORY. Then the table is as before.
tl_result tl_name_table_add(tl_name_table *table, const tl_allocator *allocator, const char *name, size_t size,
                            uint32_t max_count, uint32_t *id_out);

/// The name of an id below `count`, terminated. Valid until the next add.
const char *tl_name_table_get(const tl_name_table *table, uint32_t id);

void tl_name_table_free(tl_name_table *table, const tl_allocator *allocator);

#ifdef __cplusplus
}
#endif

#endif
