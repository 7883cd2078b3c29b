// SPDX-License-Identifier: MIT
//
// A floor of 20 x 20 m with holes, for targets that need a navmesh of several tiles.

#ifndef TALUS_FUZZ_HOLED_FLOOR_H
#define TALUS_FUZZ_HOLED_FLOOR_H

#include "fuzz/fuzz_input.h"

#include <talus/nav_bake.h>

#include <string.h>

enum { HOLED_FLOOR_SIDE = 10 };

/// Bakes it by the def, whose bounds are set to the floor's.
static void holed_floor_bake(tl_nav_def *def, tl_nav_tiles *tiles_out)
{
    enum { SIDE = HOLED_FLOOR_SIDE, VERTICES = (SIDE + 1) * (SIDE + 1) };
    tl_vec3 vertices[VERTICES];
    uint32_t indices[6 * SIDE * SIDE], count = 0;
    for (uint32_t i = 0; i < VERTICES; i++) {
        const tl_vec3 at = { 2.0f * (float)(i % (SIDE + 1)), 0.0f, 2.0f * (float)(i / (SIDE + 1)) };
        vertices[i] = at;
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t x = i % SIDE, z = i / SIDE, a = z * (SIDE + 1) + x;
        if ((x * 7 + z * 5 + x * z) % 6 != 0) {
            const uint32_t quad[6] = { a, a + SIDE + 1, a + SIDE + 2, a, a + SIDE + 2, a + 1 };
            memcpy(indices + count, quad, sizeof quad);
            count += 6;
        }
    }
    const tl_aabb bounds = { { 0.0f, -1.0f, 0.0f }, { 2.0f * (float)SIDE, 4.0f, 2.0f * (float)SIDE } };
    def->bounds = bounds;
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    const tl_mesh_view floor = { vertices, VERTICES, indices, count / 3, NULL };
    input.mesh = floor;
    require(tl_nav_bake(def, &input, tiles_out, NULL) == TL_OK);
}

#endif
