// SPDX-License-Identifier: MIT
//
// Built-in levels: courtyard, dungeon, terrain, city. The same name, size and seed give the same triangles on every
// machine, so tests, benchmarks and the demo need no file.

#ifndef TALUS_CLI_SAMPLE_LEVEL_H
#define TALUS_CLI_SAMPLE_LEVEL_H

#include "cli/sample/sample_mesh.h"

/// What a level is built from: cells (rooms, wards, blocks, terrain squares) in rows and columns.
typedef struct tl_sample_plan {
    uint32_t columns, rows; ///< >= 1
    uint32_t detail;        ///< 0 plain pieces only, 1 everything
    uint64_t seed;
} tl_sample_plan;

typedef struct tl_sample_level {
    const char *name;
    const char *description;     ///< one line
    uint32_t default_triangles;  ///< what `talus sample` makes without --triangles
    uint32_t smallest_triangles; ///< a request below this may give a level of a little more than it asked for
    void (*build)(const tl_sample_plan *plan, tl_sample_mesh *mesh);
    /// A place on the ground where a loose prop of the given radius stands free of walls and doors.
    tl_vec3 (*prop_place)(const tl_sample_plan *plan, float radius, tl_sample_random *random);
} tl_sample_level;

/// All levels; `count_out` of them.
const tl_sample_level *tl_sample_levels(uint32_t *count_out);
/// NULL when there is none of that name.
const tl_sample_level *tl_sample_find_level(const char *name);

/// Builds a level of `triangle_count` triangles, at most 7 fewer, by choosing how far it extends and then strewing
/// rocks. The mesh is freed with tl_sample_mesh_free, also after a failure. TL_ERR_LIMIT above
/// TL_MAX_MESH_TRIANGLES / 4; TL_ERR_MEMORY.
tl_result tl_sample_build_level(const tl_sample_level *level, uint32_t triangle_count, uint64_t seed,
                                tl_sample_mesh *mesh_out);

void tl_sample_build_courtyard(const tl_sample_plan *plan, tl_sample_mesh *mesh);
tl_vec3 tl_sample_courtyard_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random);
void tl_sample_build_dungeon(const tl_sample_plan *plan, tl_sample_mesh *mesh);
tl_vec3 tl_sample_dungeon_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random);
void tl_sample_build_terrain(const tl_sample_plan *plan, tl_sample_mesh *mesh);
tl_vec3 tl_sample_terrain_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random);
void tl_sample_build_city(const tl_sample_plan *plan, tl_sample_mesh *mesh);
tl_vec3 tl_sample_city_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random);

#endif
