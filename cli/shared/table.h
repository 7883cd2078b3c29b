// SPDX-License-Identifier: MIT
//
// Aligned text tables: numbers to the right, words to the left, thousands separated.

#ifndef TALUS_CLI_TABLE_H
#define TALUS_CLI_TABLE_H

#include <stdint.h>

enum { TL_TABLE_COLUMNS = 6, TL_TABLE_ROWS = 64, TL_TABLE_CELL_BYTES = 64 };

/// Zero is an empty table. Rows and columns beyond the limits are a caller's bug.
typedef struct tl_table {
    char cells[TL_TABLE_ROWS][TL_TABLE_COLUMNS][TL_TABLE_CELL_BYTES];
    unsigned row_count;
    unsigned column_count;
} tl_table;

/// Begins a row; the cells that follow belong to it, left to right.
void tl_table_row(tl_table *table);
void tl_table_text(tl_table *table, const char *text);
/// "1,234,567"
void tl_table_count(tl_table *table, uint64_t count);
/// "12.3 ms", "4.56 s"
void tl_table_seconds(tl_table *table, double seconds);
/// "512 B", "12.3 KB", "4.56 MB"
void tl_table_bytes(tl_table *table, uint64_t bytes);
void tl_table_blank(tl_table *table);

/// Prints to standard output: the first column to the left, the others to the right.
void tl_table_print(const tl_table *table);

#endif
