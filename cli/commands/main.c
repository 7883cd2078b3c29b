// SPDX-License-Identifier: MIT
//
// talus COMMAND ...: finds the command and hands over.

#include "cli/options/closest_word.h"
#include "cli/shared/command.h"
#include "cli/shared/start.h"

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

int main(int argc, char **argv)
{
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
    const char *name = help ? argv[2] : argv[1];
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    for (uint32_t i = 0; i < count; ++i) {
        if (strcmp(commands[i]->name, name) == 0) {
            const char *const ask_help[] = { name, "--help", NULL };
            return (int)(help ? tl_command_run(commands[i], 2, ask_help)
                              : tl_command_run(commands[i], argc - 1, (const char *const *)(argv + 1)));
        }
    }
    return unknown_command(name);
}
