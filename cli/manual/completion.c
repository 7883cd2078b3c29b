// SPDX-License-Identifier: MIT
//
// Completion for bash, zsh and fish: a command first, then its options, the words of a choice, and files elsewhere. The
// scripts are complete by themselves, so that a key press starts no program.

#include "cli/manual/completion.h"

#include "cli/shared/command.h"

#include <stdio.h>
#include <string.h>

static bool takes_value(const tl_option *option)
{
    return option->kind != TL_OPTION_FLAG && option->kind != TL_OPTION_UNFLAG;
}

// Files are offered for texts that may be one; numbers have nothing to offer.
static bool takes_file(const tl_option *option)
{
    return option->kind == TL_OPTION_INPUT || option->kind == TL_OPTION_OUTPUT;
}

static void print_words(const char *const *words)
{
    for (int i = 0; words[i] != NULL; ++i) {
        printf("%s%s", i > 0 ? " " : "", words[i]);
    }
}

static void print_command_names(void)
{
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    for (uint32_t i = 0; i < count; ++i) {
        printf("%s%s", i > 0 ? " " : "", commands[i]->name);
    }
}

static void describe_all(tl_describe_fn *describe)
{
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    for (uint32_t i = 0; i < count; ++i) {
        tl_command_describe(commands[i], describe, NULL);
    }
}

// Text within single quotes, where a shell takes an apostrophe for their end. `special`: bytes that want a backslash.
static void print_quoted(const char *text, const char *special)
{
    for (; *text != '\0'; ++text) {
        if (*text == '\'') {
            printf("'\\''");
        } else {
            printf("%s%c", strchr(special, *text) != NULL ? "\\" : "", *text == '\n' ? ' ' : *text);
        }
    }
}

// What follows an option's name: the words of a choice, a file, or nothing that is known.
static void print_bash_values(const tl_command *command, const tl_option_group *groups, void *user)
{
    (void)user;
    for (; groups->title != NULL; ++groups) {
        for (const tl_option *option = groups->options; option->name != NULL; ++option) {
            if (!takes_value(option) || takes_file(option)) {
                continue;
            }
            printf("    '%s --%s'", command->name, option->name);
            if (option->letter != 0) {
                printf(" | '%s -%c'", command->name, option->letter);
            }
            if (option->kind == TL_OPTION_CHOICE) {
                printf(") words='");
                print_words(option->words);
                printf("' ;;\n");
            } else {
                printf(") return ;;\n");
            }
        }
    }
}

static void print_bash_options(const tl_command *command, const tl_option_group *groups, void *user)
{
    (void)user;
    printf("    %s) options='", command->name);
    for (const tl_option_group *group = groups; group->title != NULL; ++group) {
        for (const tl_option *option = group->options; option->name != NULL; ++option) {
            printf("%s--%s", group == groups && option == groups->options ? "" : " ", option->name);
        }
    }
    printf("' ;;\n");
}

static void print_bash(void)
{
    printf("# Completion of talus for bash; written by 'talus help --completion bash'.\n"
           "_talus()\n{\n"
           "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} words='' options=''\n"
           "    COMPREPLY=()\n"
           "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n        words='");
    print_command_names();
    printf(" help --help --version'\n"
           "    elif [ \"${COMP_WORDS[1]}\" = help ]; then\n        words='");
    print_command_names();
    printf("'\n    fi\n    case \"${COMP_WORDS[1]} $previous\" in\n");
    describe_all(print_bash_values);
    printf("    esac\n    if [ -n \"$words\" ]; then\n"
           "        mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n        return\n    fi\n"
           "    case \"${COMP_WORDS[1]}\" in\n");
    describe_all(print_bash_options);
    printf("    esac\n"
           "    case \"$current\" in\n"
           "    -*) mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\") ;;\n"
           "    *) mapfile -t COMPREPLY < <(compgen -f -- \"$current\") ;;\n"
           "    esac\n}\ncomplete -o filenames -F _talus talus\n");
}

static void print_zsh_option(const tl_option *option)
{
    const bool value = takes_value(option);
    printf(" \\\n            ");
    if (option->letter != 0) {
        printf("'(-%c --%s)'{-%c,--%s%s}'[", option->letter, option->name, option->letter, option->name,
               value ? "=" : "");
    } else {
        printf("'%s--%s%s[", option->kind == TL_OPTION_TEXTS ? "*" : "", option->name, value ? "=" : "");
    }
    print_quoted(option->help, "[]:\\");
    printf("]");
    if (option->kind == TL_OPTION_CHOICE) {
        printf(":word:(");
        print_words(option->words);
        printf(")");
    } else if (value) {
        printf(":");
        print_quoted(option->metavar != NULL ? option->metavar : "value", "[]:\\");
        printf(":%s", takes_file(option) ? "_files" : " ");
    }
    printf("'");
}

static void print_zsh_command(const tl_command *command, const tl_option_group *groups, void *user)
{
    (void)user;
    printf("    %s)\n        _arguments", command->name);
    for (; groups->title != NULL; ++groups) {
        for (const tl_option *option = groups->options; option->name != NULL; ++option) {
            print_zsh_option(option);
        }
    }
    printf(" \\\n            '*:file:_files' ;;\n");
}

static void print_zsh(void)
{
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    printf("#compdef talus\n# Completion of talus for zsh; written by 'talus help --completion zsh'.\n"
           "_talus()\n{\n    local -a commands\n    commands=(\n");
    for (uint32_t i = 0; i < count; ++i) {
        printf("        '%s:", commands[i]->name);
        print_quoted(commands[i]->summary, ":\\");
        printf("'\n");
    }
    printf("        'help:explain a command'\n    )\n"
           "    if (( CURRENT == 2 )) || [[ $words[2] == help ]]; then\n"
           "        _describe command commands\n        return\n    fi\n"
           "    shift words\n    (( CURRENT-- ))\n    case $words[1] in\n");
    describe_all(print_zsh_command);
    printf("    esac\n}\n\n_talus \"$@\"\n");
}

static void print_fish_command(const tl_command *command, const tl_option_group *groups, void *user)
{
    (void)user;
    printf("complete -c talus -n __fish_use_subcommand -f -a %s -d '", command->name);
    print_quoted(command->summary, "");
    printf("'\n");
    for (; groups->title != NULL; ++groups) {
        for (const tl_option *option = groups->options; option->name != NULL; ++option) {
            printf("complete -c talus -n '__fish_seen_subcommand_from %s' -l %s", command->name, option->name);
            if (option->letter != 0) {
                printf(" -s %c", option->letter);
            }
            if (option->kind == TL_OPTION_CHOICE) {
                printf(" -x -a '");
                print_words(option->words);
                printf("'");
            } else if (takes_value(option)) {
                printf("%s", takes_file(option) ? " -r -F" : " -x");
            }
            printf(" -d '");
            print_quoted(option->help, "");
            printf("'\n");
        }
    }
}

static void print_fish(void)
{
    printf("# Completion of talus for fish; written by 'talus help --completion fish'.\n"
           "complete -c talus -n __fish_use_subcommand -f -a help -d 'explain a command'\n"
           "complete -c talus -n '__fish_seen_subcommand_from help' -f -a '");
    print_command_names();
    printf("'\n");
    describe_all(print_fish_command);
}

bool tl_completion_print(const char *shell)
{
    static const struct {
        const char *shell;
        void (*print)(void);
    } scripts[] = { { "bash", print_bash }, { "zsh", print_zsh }, { "fish", print_fish } };
    for (size_t i = 0; i < sizeof(scripts) / sizeof(scripts[0]); ++i) {
        if (strcmp(scripts[i].shell, shell) == 0) {
            scripts[i].print();
            return true;
        }
    }
    return false;
}
