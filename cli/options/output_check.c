// SPDX-License-Identifier: MIT
//
// Files are compared by what they are, not by their names: ./level.obj, a symbolic or hard link to it, and standard
// input that comes from it are all the level itself.

#include "cli/options/output_check.h"

#include "cli/options/same_file.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

const char *const tl_picture_endings[] = { ".png", ".svg", NULL };

bool tl_has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), end_length = strlen(ending);
    if (length < end_length) {
        return false;
    }
    const char *end = path + length - end_length;
    while (*ending != '\0' && tolower((unsigned char)*end) == tolower((unsigned char)*ending)) {
        ++end;
        ++ending;
    }
    return *ending == '\0';
}

static const char *text_of(const tl_option *option)
{
    return *(const char *const *)option->target;
}

static bool has_known_ending(const tl_option *output, tl_arguments *arguments)
{
    const char *path = text_of(output);
    if (output->words == NULL || tl_is_stream(path)) {
        return true;
    }
    char list[128] = "";
    for (int i = 0; output->words[i] != NULL; ++i) {
        if (tl_has_ending(path, output->words[i])) {
            return true;
        }
        const size_t used = strlen(list);
        snprintf(list + used, sizeof(list) - used, "%s%s", i > 0 ? " or " : "", output->words[i]);
    }
    snprintf(arguments->message, sizeof(arguments->message), "--%s: '%s' has an ending that cannot be written; use %s",
             output->name, path, list);
    return false;
}

static const char *find_same_input(const tl_option_group *groups, const tl_arguments *arguments, const char *output)
{
    for (uint32_t i = 0; i < arguments->count; ++i) {
        if (tl_is_same_file(output, arguments->words[i])) {
            return arguments->words[i];
        }
    }
    for (; groups->title != NULL; ++groups) {
        for (const tl_option *option = groups->options; option->name != NULL; ++option) {
            const char *path = option->kind == TL_OPTION_INPUT ? text_of(option) : NULL;
            if (path != NULL && tl_is_same_file(output, path)) {
                return path;
            }
        }
    }
    return NULL;
}

static bool check_output_path(const tl_option_group *groups, const tl_option *output, tl_arguments *arguments)
{
    if (!has_known_ending(output, arguments)) {
        return false;
    }
    const char *path = text_of(output);
    if (tl_is_stream(path)) {
        return true;
    }
    const char *input = find_same_input(groups, arguments, path);
    if (input != NULL) {
        snprintf(arguments->message, sizeof(arguments->message),
                 "--%s: '%s' is the same file as the input '%s', which would be destroyed; write to another file",
                 output->name, path, input);
    }
    return input == NULL;
}

// Whoever reads second would find nothing.
static bool check_standard_inputs(const tl_option_group *groups, tl_arguments *arguments)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < arguments->count; ++i) {
        count += strcmp(arguments->words[i], "-") == 0;
    }
    for (; groups->title != NULL; ++groups) {
        for (const tl_option *option = groups->options; option->name != NULL; ++option) {
            count += option->kind == TL_OPTION_INPUT && text_of(option) != NULL && strcmp(text_of(option), "-") == 0;
        }
    }
    if (count > 1) {
        snprintf(arguments->message, sizeof(arguments->message),
                 "%u inputs are '-', and standard input can be read once; name files for the others", count);
    }
    return count <= 1;
}

bool tl_outputs_check(const tl_option_group *groups, tl_arguments *arguments)
{
    if (!check_standard_inputs(groups, arguments)) {
        return false;
    }
    for (const tl_option_group *group = groups; group->title != NULL; ++group) {
        for (const tl_option *option = group->options; option->name != NULL; ++option) {
            if (option->kind == TL_OPTION_OUTPUT && text_of(option) != NULL &&
                !check_output_path(groups, option, arguments)) {
                return false;
            }
        }
    }
    return true;
}
