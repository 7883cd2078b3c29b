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

/// Whether a distance is small enough, for a word of that length, to be a typing error.
int tl_word_is_near(const char *word, unsigned distance);

#endif
