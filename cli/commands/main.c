// SPDX-License-Identifier: MIT
//
// talus COMMAND ...: finds the command and hands over.

#include "cli/manual/completion.h"
#include "cli/manual/manual_page.h"
#include "cli/options/closest_word.h"
#include "cli/shared/command.h"
#include "cli/shared/start.h"
#include "io/mesh/mesh_import.h"

#include <stdio.h>
#include <string.h>

static void print_commands(FILE *out)
{
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    fprintf(out, "Usage: talus COMMAND ...\n\n"
                 "Bakes a level's triangles into one file, and answers rays, convex shapes and paths from it.\n\n"
                 "Start here:\n"
                 "  talus sample courtyard -o courtyard.obj\n"
                 "  talus bake courtyard.obj -o courtyard.talus\n"
                 "  talus path courtyard.talus 2,0,20 38,0,20\n");
    const char *topic = "";
    for (uint32_t i = 0; i < count; ++i) {
        if (strcmp(commands[i]->topic, topic) != 0) {
            topic = commands[i]->topic;
            fprintf(out, "\n%s:\n", topic);
        }
        fprintf(out, "  %-12s%s\n", commands[i]->name, commands[i]->summary);
    }
    fprintf(out, "\n'talus COMMAND --help' explains a command, with examples that run as they are.\n"
                 "'talus --version' prints the version.\n");
}

static int unknown_command(const char *word)
{
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    tl_closest_word closest = tl_closest_word_to(word);
    for (uint32_t i = 0; i < count; ++i) {
        tl_closest_word_offer(&closest, commands[i]->name, commands[i]->name);
    }
    if (closest.meant != NULL) {
        fprintf(stderr, "talus: '%s' is no command; did you mean '%s'?\n", word, closest.meant);
    } else {
        fprintf(stderr, "talus: '%s' is no command; 'talus --help' lists all\n", word);
    }
    return TL_EXIT_USAGE;
}

static const tl_command *find_command(const char *name)
{
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    for (uint32_t i = 0; i < count; ++i) {
        if (strcmp(commands[i]->name, name) == 0) {
            return commands[i];
        }
    }
    return NULL;
}

// talus help --man [COMMAND], talus help --completion SHELL: what packages install beside the program.
static int print_for_packages(int argc, char **argv)
{
    const char *word = argc > 3 ? argv[3] : NULL;
    if (strcmp(argv[2], "--man") == 0) {
        const tl_command *command = word != NULL ? find_command(word) : NULL;
        if (word != NULL && command == NULL) {
            return unknown_command(word);
        }
        tl_manual_page_print(command);
        return TL_EXIT_OK;
    }
    if (word == NULL || !tl_completion_print(word)) {
        fprintf(stderr, "talus: help --completion wants a shell: bash, zsh or fish\n");
        return TL_EXIT_USAGE;
    }
    return TL_EXIT_OK;
}

int main(int argc, char **argv)
{
    tl_import_child_main();
    if (!tl_start(&argc, &argv)) {
        fprintf(stderr, "talus: the arguments cannot be read\n");
        return TL_EXIT_USAGE;
    }
    if (argc < 2) {
        print_commands(stderr);
        return TL_EXIT_USAGE;
    }
    bool help = strcmp(argv[1], "help") == 0;
    if ((help && argc == 2) || strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_commands(stdout);
        return TL_EXIT_OK;
    }
    if (strcmp(argv[1], "--version") == 0) {
        printf("talus %s\n", tl_version());
        return TL_EXIT_OK;
    }
    if (help && (strcmp(argv[2], "--man") == 0 || strcmp(argv[2], "--completion") == 0)) {
        return print_for_packages(argc, argv);
    }
    const char *name = help ? argv[2] : argv[1];
    const tl_command *command = find_command(name);
    if (command == NULL) {
        return unknown_command(name);
    }
    const char *const ask_help[] = { name, "--help", NULL };
    return (int)(help ? tl_command_run(command, 2, ask_help)
                      : tl_command_run(command, argc - 1, (const char *const *)(argv + 1)));
}
