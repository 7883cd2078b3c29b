// SPDX-License-Identifier: MIT
//
// The commands, in the order in which a new user meets them. A new one is one line here.

#include "cli/shared/command.h"

// clang-format off
#define COMMANDS(COMMAND) \
    COMMAND(sample) \
    COMMAND(bake) \
    COMMAND(world) \
    COMMAND(info) \
    COMMAND(check) \
    COMMAND(draw) \
    COMMAND(view) \
    COMMAND(ray) \
    COMMAND(nearest) \
    COMMAND(overlap) \
    COMMAND(sweep) \
    COMMAND(path) \
    COMMAND(around) \
    COMMAND(crowd) \
    COMMAND(links) \
    COMMAND(why) \
    COMMAND(audit) \
    COMMAND(hull) \
    COMMAND(support) \
    COMMAND(distance) \
    COMMAND(decompose) \
    COMMAND(polygonize) \
    COMMAND(export) \
    COMMAND(import)
// clang-format on

#define DECLARE(name) extern const tl_command tl_##name##_command;
COMMANDS(DECLARE)

#define ENTRY(name) &tl_##name##_command,
static const tl_command *const commands[] = { COMMANDS(ENTRY) };

const tl_command *const *tl_command_table(uint32_t *count_out)
{
    *count_out = (uint32_t)(sizeof(commands) / sizeof(commands[0]));
    return commands;
}
