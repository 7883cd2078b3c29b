// SPDX-License-Identifier: MIT
//
// man(7) takes a line that begins with a dot or an apostrophe for a macro, a backslash for an escape, and a dash for a
// hyphen, which nobody can copy into a shell: these are written in groff's spelling.

#include "cli/manual/manual_page.h"

#include <stdio.h>
#include <string.h>

// `count` bytes of text; an empty line between paragraphs becomes .PP.
static void print_escaped(const char *text, size_t count)
{
    bool line_begins = true;
    for (size_t i = 0; i < count; ++i) {
        if (text[i] == '\n' && i + 1 < count && text[i + 1] == '\n') {
            printf("\n.PP\n");
            i++;
            line_begins = true;
            continue;
        }
        if (line_begins && (text[i] == '.' || text[i] == '\'')) {
            printf("\\&");
        }
        line_begins = text[i] == '\n';
        if (text[i] == '\\') {
            printf("\\e");
        } else if (text[i] == '-') {
            printf("\\-");
        } else {
            putchar(text[i]);
        }
    }
}

static void print_text(const char *text)
{
    print_escaped(text, strlen(text));
}

static void print_head(const char *name, const char *summary)
{
    printf(".\\\" Written by 'talus help --man'.\n.TH \"");
    for (const char *at = name; *at != '\0'; ++at) {
        putchar(*at >= 'a' && *at <= 'z' ? *at - 'a' + 'A' : *at);
    }
    printf("\" 1 \"\" \"talus %s\" \"talus\"\n.SH NAME\n", tl_version());
    print_text(name);
    printf(" \\- ");
    print_text(summary);
    putchar('\n');
}

static void print_option_entry(const tl_option *option)
{
    char preset[96];
    printf(".TP\n");
    if (option->letter != 0) {
        printf("\\fB\\-%c\\fR, ", option->letter);
    }
    printf("\\fB\\-\\-");
    print_text(option->name);
    printf("\\fR");
    if (option->kind == TL_OPTION_CHOICE) {
        for (int i = 0; option->words[i] != NULL; ++i) {
            printf("%s", i > 0 ? "|" : " ");
            print_text(option->words[i]);
        }
    } else if (option->metavar != NULL) {
        printf(" \\fI");
        print_text(option->metavar);
        printf("\\fR");
    }
    putchar('\n');
    print_text(option->help);
    tl_option_default_text(option, preset, sizeof(preset));
    print_text(preset);
    putchar('\n');
}

static void print_lines(const char *lines, const char *before)
{
    printf(".nf\n");
    for (const char *line = lines; line != NULL && *line != '\0';) {
        const size_t length = strcspn(line, "\n");
        printf("%s", before);
        print_escaped(line, length);
        putchar('\n');
        line = line[length] == '\n' ? line + length + 1 : NULL;
    }
    printf(".fi\n");
}

static void print_command_page(const tl_command *command, const tl_option_group *groups, void *user)
{
    char name[64];
    char words[64];
    (void)user;
    snprintf(name, sizeof(name), "talus-%s", command->name);
    snprintf(words, sizeof(words), "talus %s ", command->name);
    print_head(name, command->summary);
    printf(".SH SYNOPSIS\n");
    print_lines(command->usage, words);
    printf(".SH DESCRIPTION\n");
    print_text(command->text);
    putchar('\n');
    for (; groups->title != NULL; ++groups) {
        printf(".SH \"");
        for (const char *at = groups->title; *at != '\0' && *at != ':'; ++at) {
            putchar(*at >= 'a' && *at <= 'z' ? *at - 'a' + 'A' : *at);
        }
        printf("\"\n");
        for (const tl_option *option = groups->options; option->name != NULL; ++option) {
            print_option_entry(option);
        }
    }
    printf(".SH \"EXIT STATUS\"\n");
    print_text(tl_exit_codes_text);
    printf("\n.SH EXAMPLES\n");
    print_lines(command->examples, "");
    printf(".SH \"SEE ALSO\"\n.BR talus (1)\n");
}

static void print_overview(void)
{
    uint32_t count;
    const tl_command *const *commands = tl_command_table(&count);
    const char *topic = "";
    print_head("talus", "collision and navigation geometry for games, servers and robots");
    printf(".SH SYNOPSIS\n.B talus\n.I COMMAND\n\\&...\n.SH DESCRIPTION\n");
    print_text(
        "Bakes a level's triangles into one file, and answers rays, convex shapes and paths from it. Each command "
        "has a page of its own, and explains itself with --help.\n");
    printf(".SH COMMANDS\n");
    for (uint32_t i = 0; i < count; ++i) {
        if (strcmp(commands[i]->topic, topic) != 0) {
            topic = commands[i]->topic;
            printf(".SS \"");
            print_text(topic);
            printf("\"\n");
        }
        printf(".TP\n.BR talus\\-%s (1)\n", commands[i]->name);
        print_text(commands[i]->summary);
        putchar('\n');
    }
    printf(".SH \"EXIT STATUS\"\n");
    print_text(tl_exit_codes_text);
    printf("\n.SH EXAMPLES\n");
    print_lines("talus sample courtyard -o courtyard.obj\n"
                "talus bake courtyard.obj -o courtyard.talus\n"
                "talus path courtyard.talus 2,0,20 38,0,20",
                "");
}

void tl_manual_page_print(const tl_command *command)
{
    if (command == NULL) {
        print_overview();
    } else {
        tl_command_describe(command, print_command_page, NULL);
    }
}
