// SPDX-License-Identifier: MIT
//
// popt splits the command line into options and words; every value is read here as text, so that messages name the
// option, the value and the range. The help is printed from the same tables, because popt's own shows no defaults of
// values that it does not parse.

#include "cli/options/options.h"

#include "cli/options/option_spelling.h"
#include "cli/options/parse_value.h"
#include "io/text/format_float.h"

#include <popt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HELP_COLUMN = 32, HELP_WIDTH = 80, MAX_PARAGRAPH = 2048 };

// What popt returns for a word: an option's index from 1, one of these, or FIRST_REFUSED and a spelling's index.
enum { HELP_VALUE = TL_MAX_OPTIONS + 1, FIRST_REFUSED };

// All that popt may meet.
typedef struct option_list {
    const tl_option *options[TL_MAX_OPTIONS];
    uint32_t count;
    tl_option_spelling spellings[TL_MAX_OPTION_SPELLINGS];
    uint32_t spelling_count;
    struct poptOption table[TL_MAX_OPTIONS + TL_MAX_OPTION_SPELLINGS + 2];
} option_list;

// What parsed words and texts point into.
typedef struct storage {
    poptContext context;
    const char **argv;
    char **copies; // words that were changed before popt saw them
    int copy_count;
    char **values;
    int value_count;
} storage;

// "-1,2,3" and "-.5" are values; no option begins with a digit. A leading blank hides them from popt, and number
// parsing skips it.
static bool is_negative_number(const char *word)
{
    return word[0] == '-' && ((word[1] >= '0' && word[1] <= '9') || (word[1] == '.' && word[2] != '\0'));
}

static storage *make_storage(int argc, const char *const *argv)
{
    storage *s = calloc(1, sizeof(*s));
    if (s == NULL) {
        return NULL;
    }
    s->argv = calloc((size_t)argc + 1, sizeof(*s->argv));
    s->copies = calloc((size_t)argc + 1, sizeof(*s->copies));
    s->values = calloc((size_t)argc + 1, sizeof(*s->values));
    if (s->argv == NULL || s->copies == NULL || s->values == NULL) {
        return s;
    }
    for (int i = 0; i < argc; ++i) {
        s->argv[i] = argv[i];
        if (i > 0 && is_negative_number(argv[i])) {
            size_t length = strlen(argv[i]);
            char *copy = malloc(length + 2);
            if (copy != NULL) {
                copy[0] = ' ';
                memcpy(copy + 1, argv[i], length + 1);
                s->copies[s->copy_count++] = copy;
                s->argv[i] = copy;
            }
        }
    }
    return s;
}

void tl_arguments_free(tl_arguments *arguments)
{
    storage *s = arguments->storage;
    if (s == NULL) {
        return;
    }
    poptFreeContext(s->context);
    for (int i = 0; i < s->copy_count; ++i) {
        free(s->copies[i]);
    }
    for (int i = 0; i < s->value_count; ++i) {
        free(s->values[i]);
    }
    free(s->argv);
    free(s->copies);
    free(s->values);
    free(s);
    arguments->storage = NULL;
}

static bool is_flag(const tl_option *option)
{
    return option->kind == TL_OPTION_FLAG || option->kind == TL_OPTION_UNFLAG;
}

static void fill_list(const tl_option_group *groups, option_list *list)
{
    list->count = 0;
    struct poptOption *entry = list->table;
    for (; groups->title != NULL; ++groups) {
        for (const tl_option *option = groups->options; option->name != NULL && list->count < TL_MAX_OPTIONS;
             ++option) {
            list->options[list->count++] = option;
            const struct poptOption own = {
                option->name, option->letter,   is_flag(option) ? POPT_ARG_NONE : POPT_ARG_STRING,
                NULL,         (int)list->count, NULL,
                NULL
            };
            *entry++ = own;
        }
    }
    list->spelling_count = tl_option_spellings(list->options, list->count, list->spellings);
    for (uint32_t i = 0; i < list->spelling_count; ++i) {
        const tl_option_spelling *spelling = &list->spellings[i];
        const bool flag = is_flag(list->options[spelling->option]);
        const struct poptOption other = {
            spelling->word,
            0,
            // A refused word may come with its value or without.
            spelling->advice != NULL ? POPT_ARG_STRING | POPT_ARGFLAG_OPTIONAL
            : flag                   ? POPT_ARG_NONE
                                     : POPT_ARG_STRING,
            NULL,
            spelling->advice != NULL ? FIRST_REFUSED + (int)i : (int)spelling->option + 1,
            NULL,
            NULL,
        };
        *entry++ = other;
    }
    const struct poptOption help = { "help", 'h', POPT_ARG_NONE, NULL, HELP_VALUE, NULL, NULL };
    const struct poptOption end = POPT_TABLEEND;
    *entry++ = help;
    *entry = end;
}

static const char *skip_marker(const char *value)
{
    return value[0] == ' ' && is_negative_number(value + 1) ? value + 1 : value;
}

static bool refuse(tl_arguments *arguments, const tl_option *option, const char *value, const char *reason)
{
    snprintf(arguments->message, sizeof(arguments->message), "--%s: '%s' %s", option->name, skip_marker(value), reason);
    return false;
}

static bool set_float(tl_arguments *arguments, const tl_option *option, const char *value)
{
    float number = 0.0f;
    const char *reason = tl_parse_float_value(value, &number);
    if (reason != NULL) {
        return refuse(arguments, option, value, reason);
    }
    if (number < option->min || number > option->max) {
        char range[96];
        char min[TL_FLOAT_TEXT_BYTES], max[TL_FLOAT_TEXT_BYTES];
        tl_format_float(option->min, min);
        tl_format_float(option->max, max);
        snprintf(range, sizeof(range), "is out of range; use %s to %s", min, max);
        return refuse(arguments, option, value, range);
    }
    *(float *)option->target = number;
    return true;
}

static bool set_count(tl_arguments *arguments, const tl_option *option, const char *value)
{
    uint32_t max_count = option->max_count != 0 ? option->max_count : UINT32_MAX - 1;
    uint64_t number = 0;
    const char *reason = tl_parse_count_value(value, max_count, &number);
    if (reason == NULL && number < option->min_count) {
        reason = "is too small";
    }
    if (reason != NULL) {
        char range[96];
        snprintf(range, sizeof(range), "%s; use %u to %u", reason, option->min_count, max_count);
        return refuse(arguments, option, value, range);
    }
    *(uint32_t *)option->target = (uint32_t)number;
    return true;
}

static bool set_choice(tl_arguments *arguments, const tl_option *option, const char *value)
{
    char list[256] = "is not one of";
    for (int i = 0; option->words[i] != NULL; ++i) {
        if (strcmp(option->words[i], value) == 0) {
            *(int *)option->target = i;
            return true;
        }
        size_t used = strlen(list);
        snprintf(list + used, sizeof(list) - used, "%s %s", i > 0 ? "," : "", option->words[i]);
    }
    return refuse(arguments, option, value, list);
}

static bool add_text(tl_arguments *arguments, const tl_option *option, const char *value)
{
    tl_option_texts *texts = option->target;
    if (texts->count == TL_MAX_OPTION_TEXTS) {
        return refuse(arguments, option, value, "is one too many; put them into a file");
    }
    texts->words[texts->count++] = skip_marker(value);
    return true;
}

static bool set_value(tl_arguments *arguments, const tl_option *option, const char *value)
{
    uint64_t number = 0;
    const char *reason;
    switch (option->kind) {
    case TL_OPTION_FLAG:
        *(bool *)option->target = true;
        return true;
    case TL_OPTION_UNFLAG:
        *(bool *)option->target = false;
        return true;
    case TL_OPTION_FLOAT:
        return set_float(arguments, option, value);
    case TL_OPTION_COUNT:
    case TL_OPTION_NEEDED_COUNT:
        return set_count(arguments, option, value);
    case TL_OPTION_NUMBER:
        reason = tl_parse_count_value(value, UINT64_MAX, &number);
        if (reason != NULL) {
            return refuse(arguments, option, value, reason);
        }
        *(uint64_t *)option->target = number;
        return true;
    case TL_OPTION_CHOICE:
        return set_choice(arguments, option, value);
    case TL_OPTION_TEXTS:
        return add_text(arguments, option, value);
    default:
        *(const char **)option->target = skip_marker(value);
        return true;
    }
}

static void explain_bad_option(tl_arguments *arguments, const storage *s, int code, const option_list *list)
{
    const char *bad = poptBadOption(s->context, POPT_BADOPTION_NOALIAS);
    const char *meant = NULL;
    if (code == POPT_ERROR_BADOPT) {
        meant = tl_option_suggestion(bad + strspn(bad, "-"), list->options, list->count, list->spellings,
                                     list->spelling_count);
    }
    if (meant != NULL) {
        snprintf(arguments->message, sizeof(arguments->message), "%s is no option; did you mean --%s?", bad, meant);
    } else if (code == POPT_ERROR_BADOPT) {
        snprintf(arguments->message, sizeof(arguments->message), "%s is no option", bad);
    } else {
        snprintf(arguments->message, sizeof(arguments->message), "%s: %s", bad, poptStrerror(code));
    }
}

static void note_given(tl_arguments *arguments, const char *name)
{
    for (uint32_t i = 0; i < arguments->given_count; ++i) {
        if (arguments->given[i] == name) {
            return;
        }
    }
    arguments->given[arguments->given_count++] = name;
}

const char *tl_arguments_find_given(const tl_arguments *arguments, const tl_option *options)
{
    for (; options->name != NULL; ++options) {
        for (uint32_t i = 0; i < arguments->given_count; ++i) {
            if (strcmp(arguments->given[i], options->name) == 0) {
                return options->name;
            }
        }
    }
    return NULL;
}

bool tl_is_listed(const char *const *list, const char *name)
{
    while (*list != NULL && strcmp(*list, name) != 0) {
        list++;
    }
    return *list != NULL;
}

const char *tl_arguments_find_other(const tl_arguments *arguments, const char *const *taken, const tl_option *options)
{
    static const char *const common[] = { "json", "threads", "progress", "help", NULL };
    for (uint32_t i = 0; i < arguments->given_count; ++i) {
        const char *name = arguments->given[i];
        bool is_known = tl_is_listed(common, name) || tl_is_listed(taken, name);
        for (const tl_option *option = options; option != NULL && option->name != NULL; ++option) {
            is_known = is_known || strcmp(option->name, name) == 0;
        }
        if (!is_known) {
            return name;
        }
    }
    return NULL;
}

// Takes the option that popt met. False: it is refused.
static bool take_option(tl_arguments *arguments, storage *s, const option_list *list, int code)
{
    char *value = poptGetOptArg(s->context);
    if (value != NULL) {
        s->values[s->value_count++] = value;
    }
    if (code >= FIRST_REFUSED) {
        const tl_option_spelling *spelling = &list->spellings[code - FIRST_REFUSED];
        snprintf(arguments->message, sizeof(arguments->message), "--%s %s", spelling->word, spelling->advice);
        return false;
    }
    note_given(arguments, list->options[code - 1]->name);
    return set_value(arguments, list->options[code - 1], value != NULL ? value : "");
}

static bool take_words(tl_arguments *arguments, const storage *s)
{
    for (const char *word; (word = poptGetArg(s->context)) != NULL;) {
        if (arguments->count == TL_MAX_ARGUMENTS) {
            snprintf(arguments->message, sizeof(arguments->message), "more than %d words", TL_MAX_ARGUMENTS);
            return false;
        }
        arguments->words[arguments->count++] = skip_marker(word);
    }
    return true;
}

tl_parse_outcome tl_options_parse(const tl_option_group *groups, int argc, const char *const *argv,
                                  tl_arguments *arguments_out)
{
    option_list list;
    memset(arguments_out, 0, sizeof(*arguments_out));
    fill_list(groups, &list);
    storage *s = make_storage(argc, argv);
    arguments_out->storage = s;
    if (s != NULL && s->values != NULL && s->argv != NULL && s->copies != NULL) {
        s->context = poptGetContext(NULL, argc, s->argv, list.table, 0);
    }
    if (s == NULL || s->context == NULL) {
        snprintf(arguments_out->message, sizeof(arguments_out->message), "out of memory");
        return TL_PARSE_ERROR;
    }
    int code;
    while ((code = poptGetNextOpt(s->context)) > 0) {
        if (code == HELP_VALUE) {
            return TL_PARSE_HELP;
        }
        if (!take_option(arguments_out, s, &list, code)) {
            return TL_PARSE_ERROR;
        }
    }
    if (code < -1) {
        explain_bad_option(arguments_out, s, code, &list);
        return TL_PARSE_ERROR;
    }
    return take_words(arguments_out, s) ? TL_PARSE_OK : TL_PARSE_ERROR;
}

void tl_options_print_wrapped(const char *text, int column, int indent)
{
    bool first = true;
    while (*text != '\0') {
        const size_t length = strcspn(text, " \n");
        if (!first && column + (int)length + 1 > HELP_WIDTH) {
            printf("\n%*s", indent, "");
            column = indent;
        } else if (!first) {
            putchar(' ');
            column++;
        }
        printf("%.*s", (int)length, text);
        column += (int)length;
        first = false;
        text += length + (text[length] != '\0');
    }
    putchar('\n');
}

void tl_options_print_text(const char *text)
{
    while (*text != '\0') {
        const char *end = strstr(text, "\n\n");
        const size_t length = end != NULL ? (size_t)(end - text) : strlen(text);
        char paragraph[MAX_PARAGRAPH];
        snprintf(paragraph, sizeof(paragraph), "%.*s", (int)length, text);
        tl_options_print_wrapped(paragraph, 0, 0);
        text += length;
        if (*text != '\0') {
            putchar('\n');
            text += 2;
        }
    }
}

void tl_option_default_text(const tl_option *option, char *text, size_t capacity)
{
    const char *word = NULL;
    char number[TL_FLOAT_TEXT_BYTES];
    text[0] = '\0';
    switch (option->kind) {
    case TL_OPTION_FLOAT:
        tl_format_float(*(const float *)option->target, number);
        snprintf(text, capacity, " [%s]", number);
        break;
    case TL_OPTION_COUNT:
        snprintf(text, capacity, " [%u]", *(const uint32_t *)option->target);
        break;
    case TL_OPTION_NUMBER:
        snprintf(text, capacity, " [%llu]", (unsigned long long)*(const uint64_t *)option->target);
        break;
    case TL_OPTION_CHOICE:
        word = option->words[*(const int *)option->target];
        break;
    case TL_OPTION_TEXT:
    case TL_OPTION_INPUT:
        word = *(const char *const *)option->target;
        break;
    default:
        break;
    }
    if (word != NULL) {
        snprintf(text, capacity, " [%s]", word);
    }
}

static void print_option(const tl_option *option)
{
    char name[96];
    char value[256] = "";
    char text[512];
    char preset[96];
    if (option->kind == TL_OPTION_CHOICE) {
        for (int i = 0; option->words[i] != NULL; ++i) {
            size_t used = strlen(value);
            snprintf(value + used, sizeof(value) - used, "%c%s", i > 0 ? '|' : ' ', option->words[i]);
        }
    } else if (option->metavar != NULL) {
        snprintf(value, sizeof(value), " %s", option->metavar);
    }
    if (option->letter != 0) {
        snprintf(name, sizeof(name), "  -%c, --%s%.60s", option->letter, option->name, value);
    } else {
        snprintf(name, sizeof(name), "      --%s%.60s", option->name, value);
    }
    tl_option_default_text(option, preset, sizeof(preset));
    snprintf(text, sizeof(text), "%s%s", option->help, preset);
    if ((int)strlen(name) >= HELP_COLUMN) {
        printf("%s\n%*s", name, HELP_COLUMN, "");
    } else {
        printf("%-*s", HELP_COLUMN, name);
    }
    tl_options_print_wrapped(text, HELP_COLUMN, HELP_COLUMN);
}

void tl_options_print(const tl_option_group *groups)
{
    for (; groups->title != NULL; ++groups) {
        printf("\n%s\n", groups->title);
        for (const tl_option *option = groups->options; option->name != NULL; ++option) {
            print_option(option);
        }
    }
}
