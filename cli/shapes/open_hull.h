// SPDX-License-Identifier: MIT
//
// HULL as the convex commands take it: points or a mesh, whose hull is built now; or a baked file that holds a hull.

#ifndef TALUS_CLI_OPEN_HULL_H
#define TALUS_CLI_OPEN_HULL_H

#include "cli/level/open_input.h"
#include "io/mesh/point_cloud.h"

#include <talus/hull.h>

typedef struct tl_hull_settings {
    tl_level_settings level; ///< weld is not used: a hull welds by itself
    uint32_t index;          ///< which cloud of a file of several
    uint32_t max_vertices;
    float tolerance, thickness, weld_distance, merge_distance;
} tl_hull_settings;

enum { TL_HULL_OPTIONS = 9 };

tl_hull_settings tl_default_hull_settings(void);
void tl_hull_options(tl_hull_settings *settings, tl_option table[TL_HULL_OPTIONS]);
/// Reads the command line of a command that takes one HULL: its own options, and those for a hull that is not baked.
/// False: reported.
bool tl_hull_parse(tl_cli *cli, const tl_option *options, uint32_t max_words, tl_hull_settings *settings,
                   tl_exit *exit_out);

typedef struct tl_hull_input {
    const tl_hull *hull;
    tl_hull *built;      ///< when it was built here
    tl_input baked;      ///< when it came from a baked file
    uint32_t points;     ///< it was built from; 0 when baked
    tl_pack_frame frame; ///< of the level that it is of; zero: talus' own
    tl_hull_report report;
} tl_hull_input;

/// The hull of a cloud. On failure `*hull_out` is NULL.
tl_result tl_hull_bake_cloud(tl_cli *cli, const tl_hull_settings *settings, tl_point_cloud cloud, tl_hull **hull_out,
                             tl_hull_report *report_out);
/// Reports a failure of tl_hull_bake_cloud, with what to do.
tl_exit tl_hull_fail(tl_cli *cli, const char *path, tl_result result, const tl_hull_report *report);

bool tl_read_clouds(tl_cli *cli, const char *path, const tl_hull_settings *settings, tl_point_clouds *clouds_out,
                    tl_exit *exit_out);

/// False: reported. Free with tl_hull_input_close, also then.
bool tl_hull_open(tl_cli *cli, const char *path, const tl_hull_settings *settings, tl_hull_input *input_out,
                  tl_exit *exit_out);
void tl_hull_input_close(tl_hull_input *input);

#endif
