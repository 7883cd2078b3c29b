// SPDX-License-Identifier: MIT
//
// Other ways to write an option's name: camelCase (cellSize), and the names that Recast's and Detour's users know.

#ifndef TALUS_CLI_OPTION_SPELLING_H
#define TALUS_CLI_OPTION_SPELLING_H

#include "cli/options/options.h"

enum { TL_MAX_OPTION_SPELLINGS = 256, TL_OPTION_SPELLING_BYTES = 48 };

/// A word that stands for an option, or is refused in favour of it.
typedef struct tl_option_spelling {
    char word[TL_OPTION_SPELLING_BYTES]; ///< without the dashes before it
    uint32_t option;                     ///< index among the command's options
    const char *advice;                  ///< NULL: the same as the option. Else why it is refused, and what to use
} tl_option_spelling;

/// Fills in the spellings of `count` options that are no option's own name, each once. Returns how many.
uint32_t tl_option_spellings(const tl_option *const *options, uint32_t count,
                             tl_option_spelling spellings_out[TL_MAX_OPTION_SPELLINGS]);

/// The option that a mistyped word most likely means: one whose name or other spelling is a slip away, else the first
/// with that word between its dashes (radius: agent-radius). NULL: none.
const char *tl_option_suggestion(const char *word, const tl_option *const *options, uint32_t count,
                                 const tl_option_spelling *spellings, uint32_t spelling_count);

#endif
