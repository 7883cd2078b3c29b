// SPDX-License-Identifier: MIT
//
// What the soup's benchmarks run on: levels of the data folder and generated ones, and random places and directions
// that are the same in every run.

#ifndef TALUS_BENCH_SOUP_LEVELS_H
#define TALUS_BENCH_SOUP_LEVELS_H

#include <stdbool.h>
#include <talus/mesh.h>

typedef struct bench_level {
    char name[64];
    tl_mesh_view view; // owns its arrays
} bench_level;

enum { BENCH_MAX_LEVELS = 16 };

/// The six levels of TALUS_DATA_DIR, where it is there, and dungeons and cities of 8,000 to 1,000,000 triangles.
/// `only`, a part of a name, leaves others out; NULL takes all. Returns how many.
uint32_t bench_load_levels(bench_level levels[BENCH_MAX_LEVELS], const char *only);
void bench_free_levels(bench_level *levels, uint32_t count);

/// A file of a mesh, or a generated level. False, and nothing to free, when there is none.
bool bench_load_file(const char *path, bench_level *level);
bool bench_make_sample(const char *name, uint32_t triangles, bench_level *level);

/// A point of a box, and a direction, from a state of the caller's (base/random.h).
tl_vec3 bench_point_in(uint64_t *random, tl_aabb box);
tl_vec3 bench_direction(uint64_t *random);

#endif
