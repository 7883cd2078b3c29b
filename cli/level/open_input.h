// SPDX-License-Identifier: MIT
//
// FILE as queries take it: a baked file, mapped and checked; or a level, baked in memory as far as it is needed.

#ifndef TALUS_CLI_OPEN_INPUT_H
#define TALUS_CLI_OPEN_INPUT_H

#include "cli/level/bake_level.h"
#include "io/files/file_pack.h"

#include <talus/pack.h>

typedef struct tl_input {
    const char *path;
    bool baked; ///< `pack` is open; else `level` and `bake` hold what was asked for
    tl_file_map map;
    tl_pack pack;
    tl_level level;
    tl_bake bake;
    const tl_soup *soup; ///< after tl_input_need_soup
    tl_navmesh *navmesh; ///< after tl_input_need_navmesh
} tl_input;

/// Which options for a level a command that takes FILE has beside its own.
typedef enum tl_input_options {
    TL_INPUT_LEVEL,  ///< how the level is read
    TL_INPUT_NAVMESH ///< and how its navmesh is baked
} tl_input_options;

/// True when `path` is a level, or when none of `options` was given: they say how a level is read or baked, and a baked
/// file would ignore them. False: the first that was given is refused by name.
bool tl_input_refuse_options(tl_cli *cli, const char *path, const tl_option *options, tl_exit *exit_out);

/// tl_cli_parse for a command that takes FILE: its own option groups, then those for a level, which fill `settings` and
/// are refused when FILE is baked already.
bool tl_input_parse(tl_cli *cli, const tl_option_group *own, tl_input_options options, tl_bake_settings *settings,
                    uint32_t min_words, uint32_t max_words, tl_exit *exit_out);

/// Whether the file's first bytes, or its ending .talus, say that it is a baked file. A file that cannot be opened is
/// none: reading it as a level names the reason.
bool tl_input_is_baked(const char *path);

/// Maps and checks a baked file. False: reported. Free with tl_input_close, also then.
bool tl_input_open_baked(tl_cli *cli, const char *path, tl_input *input_out, tl_exit *exit_out);

/// Opens FILE and makes sure of a soup, or of a navmesh: from the baked file, or baked now with `settings`. Free with
/// tl_input_close, also after a failure, which has been reported.
bool tl_input_open_soup(tl_cli *cli, const char *path, const tl_bake_settings *settings, tl_input *input_out,
                        tl_exit *exit_out);
bool tl_input_open_navmesh(tl_cli *cli, const char *path, const tl_bake_settings *settings, tl_input *input_out,
                           tl_exit *exit_out);
/// The same in two steps, for what must be known in between: the file or the level alone, and the frame it is in; then
/// its navmesh.
bool tl_input_open_level(tl_cli *cli, const char *path, const tl_bake_settings *settings, tl_input *input_out,
                         tl_exit *exit_out);
bool tl_input_need_navmesh(tl_cli *cli, const tl_bake_settings *settings, tl_input *input, tl_exit *exit_out);
/// Says that nothing of a level, or of a baked file, is walkable, and of a level why. Gives the exit code.
tl_exit tl_input_fail_empty(tl_cli *cli, const tl_input *input, const tl_bake_settings *settings);
void tl_input_close(tl_input *input);

/// The blob of the only chunk of a type, after `check` found it sound; NULL when there is none (`*result_out` is
/// TL_NOT_FOUND) or it is damaged.
const void *tl_input_checked_chunk(const tl_input *input, uint32_t type,
                                   tl_result (*check)(const void *, uint64_t, tl_report *), tl_result *result_out);

#endif
