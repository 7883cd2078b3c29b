// SPDX-License-Identifier: MIT
//
// One hash for each kind of blob and of answer, on levels that are made from integers: the same on every machine.
// tools/cross builds this program for many processors and compares what they print with what this one prints.
//
// It needs the library and the C library only, and calls no function of libm but sqrtf, which IEEE 754 rounds exactly.

#ifndef TALUS_TEST_CROSS_GOLDEN_H
#define TALUS_TEST_CROSS_GOLDEN_H

#include <talus/talus.h>

/// FNV-1a over values in little-endian order, whatever the machine's.
typedef struct digest {
    uint64_t hash;
    uint64_t found; ///< answers that found something: a kind without any shows nothing, and is a failure
} digest;

digest digest_begin(void);
void digest_bytes(digest *d, const void *bytes, uint64_t size);
void digest_u32(digest *d, uint32_t value);
void digest_u64(digest *d, uint64_t value);
void digest_f32(digest *d, float value);
void digest_f64(digest *d, double value);
void digest_vec3(digest *d, tl_vec3 value);
/// The bytes that the blob has in a file.
void digest_blob(digest *d, const void *blob);
/// A result, and one more answer where it is TL_OK: `if (digest_result(d, tl_soup_nearest(...)))`.
bool digest_result(digest *d, tl_result result);
/// The same for queries that return bool.
bool digest_found(digest *d, bool found);
/// Prints a line: kind, part, hash, answers.
void digest_print(const digest *d, const char *kind, const char *part);

/// Ends the program with a message unless `result` is TL_OK. `what` names the call.
void must(tl_result result, const char *what);
#define MUST(call) must((call), #call)

/// Random numbers from integers alone; the same seed gives the same numbers.
typedef struct dice {
    uint64_t state;
} dice;

uint32_t roll(dice *d, uint32_t sides);
/// A multiple of 1/1024 in [low, high].
float roll_between(dice *d, float low, float high);
tl_vec3 roll_in_box(dice *d, tl_aabb box);
tl_quat roll_rotation(dice *d);

/// A level of floors, stairs, a ramp, a gallery, pillars and loose triangles, about 40 m by 40 m.
typedef struct level {
    tl_vec3 *vertices;
    uint32_t *indices;
    uint32_t vertex_count, triangle_count;
    uint32_t vertex_capacity, triangle_capacity;
} level;

/// Freed with level_free.
level level_make(uint64_t seed);
void level_free(level *made);
tl_mesh_view level_view(const level *made);

/// The parts of the program; each prints its kinds. `soup` and `navmesh` are those of `view`.
void golden_meshes(const tl_mesh_view *view);
void golden_soups(const tl_mesh_view *view);
void golden_rays(const tl_soup *soup, const char *kind);
void golden_scene(const tl_soup *soup);
void golden_characters(const tl_soup *soup);
void golden_hulls(void);
void golden_pairs(void);
void golden_polygons(void);
void golden_decompositions(const tl_mesh_view *view);
void golden_navmeshes(const tl_mesh_view *view, const tl_soup *soup);
void golden_world(const tl_mesh_view *view);
void golden_nav_answers(const tl_navmesh *navmesh, const char *kind);
void golden_nav_prepared(tl_navmesh *navmesh);
void golden_nav_sight(const tl_navmesh *navmesh, const tl_soup *soup);
void golden_pack(const tl_soup *soup, const tl_hull *hull, const tl_nav_tiles *tiles, const tl_nav_links *links);

#endif
