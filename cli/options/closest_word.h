// SPDX-License-Identifier: MIT
//
// "Did you mean": the known word nearest to a mistyped one.

#ifndef TALUS_CLI_CLOSEST_WORD_H
#define TALUS_CLI_CLOSEST_WORD_H

#include <stddef.h>

enum { TL_MAX_WORD_BYTES = 63 };

/// Letters to insert, delete, exchange or swap with their neighbour to turn a into b; words are cut at
/// TL_MAX_WORD_BYTES.
unsigned tl_word_distance(const char *a, const char *b);

/// The search for a mistyped word among known ones.
typedef struct tl_closest_word {
    const char *word;
    const char *meant; ///< what the nearest known word stands for; NULL: none is near enough to be a typing error
    unsigned distance; ///< of the nearest
} tl_closest_word;

tl_closest_word tl_closest_word_to(const char *word);
/// Compares with one more known word, which stands for `meant`: often itself.
void tl_closest_word_offer(tl_closest_word *closest, const char *known, const char *meant);

#endif
