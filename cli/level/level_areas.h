// SPDX-License-Identifier: MIT
//
// Which area each triangle of a level has, by its material, and the volumes that mark floors: the options --area and
// --areas made ready for a build.

#ifndef TALUS_CLI_LEVEL_AREAS_H
#define TALUS_CLI_LEVEL_AREAS_H

#include "cli/level/load_level.h"
#include "io/text/area_marks.h"

#include <talus/pack.h>

/// What the options say.
typedef struct tl_area_settings {
    tl_option_texts words; ///< NAME=ID, each
    const char *path;      ///< of a file of marks, or NULL
} tl_area_settings;

/// Zero marks nothing. Free with tl_level_areas_free.
typedef struct tl_level_areas {
    tl_area_marks marks;
    uint8_t *of_triangle; ///< one a triangle of the cleaned mesh; NULL: all walkable
} tl_level_areas;

/// False: reported; `*exit_out` says how to end. Free also then.
bool tl_level_areas_make(tl_cli *cli, const tl_level *level, const tl_area_settings *settings,
                         tl_level_areas *areas_out, tl_exit *exit_out);
/// The volumes of a baked file; `marks`, which are checked, must outlive the areas. TL_ERR_MEMORY.
tl_result tl_level_areas_of_marks(const tl_pack_volumes *marks, tl_level_areas *areas_out);
/// The areas of triangles of a baked file; `numbers` are the source's numbers of the `count` triangles. Once volumes
/// are there. TL_ERR_CORRUPT (a number is beyond), TL_ERR_MEMORY.
tl_result tl_level_areas_of_triangles(const tl_pack_areas *kept, const uint32_t *numbers, uint32_t count,
                                      tl_level_areas *areas);
void tl_level_areas_free(tl_level_areas *areas);

/// What the navmesh is built from: the cleaned mesh with its marks. Valid while they live.
tl_nav_input tl_level_areas_input(const tl_level_areas *areas, const tl_mesh_view *mesh);

#endif
