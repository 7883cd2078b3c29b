// SPDX-License-Identifier: MIT
//
// A level from a file: imported, welded, cleaned, and counted.

#ifndef TALUS_CLI_LOAD_LEVEL_H
#define TALUS_CLI_LOAD_LEVEL_H

#include "cli/shared/command.h"
#include "io/mesh/mesh_import.h"

#include <talus/mesh.h>

/// How a level is to be read: the options that all commands share which take one.
typedef struct tl_level_settings {
    int up; ///< a tl_up_axis
    float scale;
    float weld;
    const char *origin; ///< "X,Y,Z" or "auto"; NULL: 0,0,0
} tl_level_settings;

enum { TL_LEVEL_OPTIONS = 5 };

tl_level_settings tl_default_level_settings(void);
/// Fills a table with the options that set `settings`.
void tl_level_options(tl_level_settings *settings, tl_option table[TL_LEVEL_OPTIONS]);

/// From now on the command speaks the coordinates of a level whose axes and origin (metres) these are; one that does
/// not says what its own coordinates are.
void tl_level_take_frame(tl_cli *cli, const char *path, tl_pack_axes axes, const double origin[3]);

/// Half the sizes of a box along the level's axes, as talus has them.
tl_vec3 tl_level_enter_half(const tl_cli *cli, tl_vec3 half);

/// "y", "z", "y-left" or "z-left".
const char *tl_level_axes_name(tl_pack_axes axes);

typedef struct tl_level {
    const char *path;
    tl_pack_axes axes;         ///< of the file; `imported` and `mesh` are turned already
    double origin[3];          ///< metres: the level's point, in its axes, that became 0,0,0
    tl_imported_mesh imported; ///< as it stands in the file
    tl_mesh mesh;              ///< welded and cleaned
    tl_mesh_report report;
    uint32_t *source_indices; ///< with welding: the corners of every source triangle, 0 0 0 for those dropped
} tl_level;

/// False: the failure was reported, and `*exit_out` is the exit code. Free with tl_level_free, also then.
bool tl_level_load(tl_cli *cli, const char *path, const tl_level_settings *settings, tl_level *level_out,
                   tl_exit *exit_out);
void tl_level_free(tl_level *level);

/// All triangles of the file in the file's order, so that a triangle's index is its index in the source. Welded when
/// the settings asked for it.
tl_mesh_view tl_level_source_view(const tl_level *level);

/// How the level is to be imported. False: --origin was refused.
bool tl_level_import_options(tl_cli *cli, const tl_level_settings *settings, tl_import_options *options_out,
                             tl_exit *exit_out);

#endif
