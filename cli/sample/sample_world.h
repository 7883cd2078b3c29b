// SPDX-License-Identifier: MIT
//
// A world of any size, part by part: terrain, towns with houses, roads, bridges and caves.
//
// A part depends on its place and the seed only, so parts are made in any order, and none is held longer than it takes
// to write it. Neighbours share the heights of their common edge.

#ifndef TALUS_CLI_SAMPLE_WORLD_H
#define TALUS_CLI_SAMPLE_WORLD_H

#include "cli/sample/sample_mesh.h"

enum { TL_SAMPLE_PART_METRES = 1024, TL_SAMPLE_PART_TRIANGLES = 150000 }; // about

/// Appends the part at (x, z), in metres from its own corner. The mesh's result tells whether memory was out.
void tl_sample_world_part(uint64_t seed, uint32_t x, uint32_t z, tl_sample_mesh *mesh);

#endif
