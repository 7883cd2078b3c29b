// SPDX-License-Identifier: MIT
//
// Cells are kept as text until all are known, because a column is as wide as its widest cell.

#include "cli/shared/table.h"

#include <assert.h>
#include <stdio.h>
#include <string.h>

static unsigned next_column(const tl_table *table)
{
    const char(*row)[TL_TABLE_CELL_BYTES] = table->cells[table->row_count - 1];
    unsigned column = 0;
    while (column < TL_TABLE_COLUMNS && row[column][0] != '\0') {
        column++;
    }
    return column;
}

void tl_table_row(tl_table *table)
{
    assert(table->row_count < TL_TABLE_ROWS);
    table->row_count++;
}

void tl_table_text(tl_table *table, const char *text)
{
    unsigned column = next_column(table);
    assert(column < TL_TABLE_COLUMNS);
    snprintf(table->cells[table->row_count - 1][column], TL_TABLE_CELL_BYTES, "%s", text[0] != '\0' ? text : " ");
    if (column + 1 > table->column_count) {
        table->column_count = column + 1;
    }
}

void tl_table_blank(tl_table *table)
{
    tl_table_text(table, " ");
}

void tl_table_count(tl_table *table, uint64_t count)
{
    char digits[24];
    char text[32];
    int length = snprintf(digits, sizeof(digits), "%llu", (unsigned long long)count);
    int out = 0;
    for (int i = 0; i < length; ++i) {
        if (i > 0 && (length - i) % 3 == 0) {
            text[out++] = ',';
        }
        text[out++] = digits[i];
    }
    text[out] = '\0';
    tl_table_text(table, text);
}

void tl_table_seconds(tl_table *table, double seconds)
{
    char text[32];
    if (seconds < 1.0) {
        snprintf(text, sizeof(text), "%.*f ms", seconds < 0.1 ? 2 : 1, seconds * 1e3);
    } else {
        snprintf(text, sizeof(text), "%.2f s", seconds);
    }
    tl_table_text(table, text);
}

void tl_table_bytes(tl_table *table, uint64_t bytes)
{
    static const char *const units[] = { "B", "KB", "MB", "GB", "TB" };
    char text[32];
    double value = (double)bytes;
    unsigned unit = 0;
    while (value >= 1000.0 && unit < 4) {
        value /= 1000.0;
        unit++;
    }
    snprintf(text, sizeof(text), "%.*f %s", unit == 0 ? 0 : value < 10.0 ? 2 : 1, value, units[unit]);
    tl_table_text(table, text);
}

void tl_table_print(const tl_table *table)
{
    for (unsigned row = 0; row < table->row_count; ++row) {
        char line[TL_TABLE_COLUMNS * (TL_TABLE_CELL_BYTES + 2) + 1];
        int used = 0;
        for (unsigned column = 0; column < table->column_count; ++column) {
            int width = 0;
            for (unsigned other = 0; other < table->row_count; ++other) {
                int length = (int)strlen(table->cells[other][column]);
                width = length > width ? length : width;
            }
            const char *cell = table->cells[row][column];
            used += snprintf(line + used, sizeof(line) - (size_t)used, column == 0 ? "%-*s" : "  %*s", width, cell);
        }
        while (used > 0 && line[used - 1] == ' ') {
            used--;
        }
        printf("%.*s\n", used, line);
    }
}
