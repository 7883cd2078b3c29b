// SPDX-License-Identifier: MIT
//
// Optimal string alignment: Levenshtein's table with one more move for two letters in the wrong order, the most common
// slip of all. Source: Damerau, A Technique for Computer Detection and Correction of Spelling Errors, CACM 1964.

#include "cli/options/closest_word.h"

#include <string.h>

static unsigned smaller_of(unsigned a, unsigned b)
{
    return a < b ? a : b;
}

unsigned tl_word_distance(const char *a, const char *b)
{
    size_t a_length = strnlen(a, TL_MAX_WORD_BYTES);
    size_t b_length = strnlen(b, TL_MAX_WORD_BYTES);
    unsigned rows[3][TL_MAX_WORD_BYTES + 1]; // row i of the table is rows[i % 3]
    for (size_t j = 0; j <= b_length; ++j) {
        rows[0][j] = (unsigned)j;
    }
    for (size_t i = 1; i <= a_length; ++i) {
        unsigned *row = rows[i % 3];
        const unsigned *above = rows[(i + 2) % 3];
        const unsigned *two_above = rows[(i + 1) % 3];
        row[0] = (unsigned)i;
        for (size_t j = 1; j <= b_length; ++j) {
            unsigned exchanged = above[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = smaller_of(exchanged, smaller_of(above[j], row[j - 1]) + 1);
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = smaller_of(row[j], two_above[j - 2] + 1);
            }
        }
    }
    return rows[a_length % 3][b_length];
}

tl_closest_word tl_closest_word_to(const char *word)
{
    const tl_closest_word closest = { word, NULL, ~0u };
    return closest;
}

void tl_closest_word_offer(tl_closest_word *closest, const char *known, const char *meant)
{
    unsigned distance = tl_word_distance(closest->word, known);
    if (distance < closest->distance && distance <= 1 + strlen(closest->word) / 5) {
        closest->distance = distance;
        closest->meant = meant;
    }
}
