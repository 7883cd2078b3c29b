// SPDX-License-Identifier: MIT
//
// All spellings are written out, and the parser gets them as options of their own: it needs no rules for letters.

#include "cli/options/option_spelling.h"

#include "cli/options/closest_word.h"
#include "cli/options/recast_names.h"

#include <stdio.h>
#include <string.h>

// "cell-size" to "cellSize".
static void write_camel_case(const char *name, char out[TL_OPTION_SPELLING_BYTES])
{
    size_t length = 0;
    for (bool upper = false; *name != '\0' && length + 1 < TL_OPTION_SPELLING_BYTES; ++name) {
        if (*name == '-') {
            upper = true;
        } else {
            out[length++] = (char)(upper && *name >= 'a' && *name <= 'z' ? *name - 'a' + 'A' : *name);
            upper = false;
        }
    }
    out[length] = '\0';
}

// "cellSize" to "cell-size".
static void write_kebab_case(const char *name, char out[TL_OPTION_SPELLING_BYTES])
{
    size_t length = 0;
    for (; *name != '\0' && length + 2 < TL_OPTION_SPELLING_BYTES; ++name) {
        bool upper = *name >= 'A' && *name <= 'Z';
        if (upper) {
            out[length++] = '-';
        }
        out[length++] = (char)(upper ? *name - 'A' + 'a' : *name);
    }
    out[length] = '\0';
}

typedef struct spelling_list {
    const tl_option *const *options;
    uint32_t option_count;
    tl_option_spelling *spellings;
    uint32_t count;
} spelling_list;

static uint32_t option_named(const spelling_list *list, const char *name)
{
    uint32_t i = 0;
    while (i < list->option_count && strcmp(list->options[i]->name, name) != 0) {
        i++;
    }
    return i;
}

// An option's own name stays its own, and of two meanings the first counts.
static void add_spelling(spelling_list *list, const char *word, uint32_t option, const char *advice)
{
    if (list->count == TL_MAX_OPTION_SPELLINGS || option_named(list, word) < list->option_count) {
        return;
    }
    for (uint32_t i = 0; i < list->count; ++i) {
        if (strcmp(list->spellings[i].word, word) == 0) {
            return;
        }
    }
    tl_option_spelling *spelling = &list->spellings[list->count++];
    snprintf(spelling->word, sizeof(spelling->word), "%s", word);
    spelling->option = option;
    spelling->advice = advice;
}

uint32_t tl_option_spellings(const tl_option *const *options, uint32_t count,
                             tl_option_spelling spellings_out[TL_MAX_OPTION_SPELLINGS])
{
    spelling_list list = { options, count, spellings_out, 0 };
    char word[TL_OPTION_SPELLING_BYTES];
    uint32_t name_count;
    const tl_recast_name *names = tl_recast_names(&name_count);
    // Recast's come first: Detour's tileHeight is not --tile-height.
    for (uint32_t i = 0; i < name_count; ++i) {
        uint32_t option = option_named(&list, names[i].option);
        if (option < count) {
            add_spelling(&list, names[i].name, option, names[i].advice);
            write_kebab_case(names[i].name, word);
            add_spelling(&list, word, option, names[i].advice);
        }
    }
    for (uint32_t i = 0; i < count; ++i) {
        write_camel_case(options[i]->name, word);
        add_spelling(&list, word, i, NULL);
    }
    return list.count;
}

// Whether `word` stands whole between the dashes of `name`.
static bool has_part(const char *name, const char *word)
{
    size_t length = strlen(word);
    for (const char *part = name; length > 0 && part != NULL; part = strchr(part, '-')) {
        part += *part == '-';
        if (strncmp(part, word, length) == 0 && (part[length] == '-' || part[length] == '\0')) {
            return true;
        }
    }
    return false;
}

const char *tl_option_suggestion(const char *word, const tl_option *const *options, uint32_t count,
                                 const tl_option_spelling *spellings, uint32_t spelling_count)
{
    tl_closest_word closest = tl_closest_word_to(word);
    for (uint32_t i = 0; i < count; ++i) {
        tl_closest_word_offer(&closest, options[i]->name, options[i]->name);
    }
    for (uint32_t i = 0; i < spelling_count; ++i) {
        tl_closest_word_offer(&closest, spellings[i].word, options[spellings[i].option]->name);
    }
    for (uint32_t i = 0; i < count && closest.meant == NULL; ++i) {
        closest.meant = has_part(options[i]->name, word) ? options[i]->name : NULL;
    }
    return closest.meant;
}
