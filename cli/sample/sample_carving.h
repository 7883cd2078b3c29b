// SPDX-License-Identifier: MIT
//
// Solids made of axis-aligned boxes that are added and cut away one after another: walls with doors and windows, floors
// with pits and stair holes, rooms and corridors hollowed out of rock.

#ifndef TALUS_CLI_SAMPLE_CARVING_H
#define TALUS_CLI_SAMPLE_CARVING_H

#include "cli/sample/sample_mesh.h"

typedef struct tl_sample_carving_box {
    tl_aabb box;
    bool solid;
} tl_sample_carving_box;

/// All zero, but for rock_outside, is an empty carving.
typedef struct tl_sample_carving {
    bool rock_outside; ///< what no box covers is solid, so that cuts make rooms
    tl_sample_carving_box *boxes;
    uint32_t count, capacity;
    bool failed;
} tl_sample_carving;

void tl_sample_carving_add(tl_sample_carving *carving, float x0, float y0, float z0, float x1, float y1, float z1);
void tl_sample_carving_cut(tl_sample_carving *carving, float x0, float y0, float z0, float x1, float y1, float z1);

/// Puts the solid's surface into the mesh and empties the carving. Later boxes win over earlier ones. Faces that lie on
/// the sides of `window` (x and z only; NULL: none) are left out: there another carving goes on.
void tl_sample_carving_finish(tl_sample_carving *carving, const tl_aabb *window, tl_sample_mesh *mesh);

#endif
