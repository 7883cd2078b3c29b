// SPDX-License-Identifier: MIT

#include "bench_options.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_help(const char *program, const bench_option *options)
{
    printf("%s [--name VALUE]...\n", program);
    for (const bench_option *o = options; o->name != NULL; o++) {
        char value[64] = "";
        if (o->kind == BENCH_COUNT) {
            snprintf(value, sizeof value, "%u", *(const uint32_t *)o->target);
        } else if (o->kind == BENCH_NUMBER) {
            snprintf(value, sizeof value, "%g", (double)*(const float *)o->target);
        } else if (*(const char *const *)o->target != NULL) {
            snprintf(value, sizeof value, "%s", *(const char *const *)o->target);
        }
        printf("  --%-12s %s%s%s%s\n", o->name, o->help, value[0] != '\0' ? " (" : "", value,
               value[0] != '\0' ? ")" : "");
    }
    printf("  --%-12s %s\n", "json", "file to write the report to, as JSON");
}

static int set_value(const bench_option *option, const char *word)
{
    char *end = NULL;
    if (option->kind == BENCH_TEXT) {
        *(const char **)option->target = word;
        return 1;
    }
    if (option->kind == BENCH_COUNT) {
        *(uint32_t *)option->target = (uint32_t)strtoul(word, &end, 10);
    } else {
        *(float *)option->target = strtof(word, &end);
    }
    return end != word && *end == '\0' && *word != '-';
}

// The option that a word names; NULL ends the program.
static const bench_option *find_option(const char *word, const bench_option *options, const bench_option *json)
{
    for (const bench_option *o = options; o->name != NULL; o++) {
        if (strcmp(o->name, word + 2) == 0) {
            return o;
        }
    }
    if (strcmp(json->name, word + 2) != 0) {
        fprintf(stderr, "%s is no option; --help lists them\n", word);
        exit(2);
    }
    return json;
}

int bench_parse(int argc, char **argv, const bench_option *options, const char **words_out, const char **json_out)
{
    *json_out = NULL;
    const bench_option json = { "json", BENCH_TEXT, (void *)json_out, "" };
    int count = 0;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0) {
            print_help(argv[0], options);
            exit(0);
        }
        if (strncmp(argv[i], "--", 2) != 0) {
            if (words_out == NULL) {
                fprintf(stderr, "unexpected word '%s'; --help lists the options\n", argv[i]);
                exit(2);
            }
            words_out[count++] = argv[i];
            continue;
        }
        const bench_option *option = find_option(argv[i], options, &json);
        if (i + 1 == argc || !set_value(option, argv[i + 1])) {
            fprintf(stderr, "%s: a value is missing, or is not a number\n", argv[i]);
            exit(2);
        }
        i++;
    }
    return count;
}
