// SPDX-License-Identifier: MIT
//
// The small builder that sample levels are made with: boxes, stairs, ramps, pillars, arches and rocks, each a closed
// surface without T-junctions inside. sample_carving.h adds solids that are cut out of boxes.
//
// Every number comes from +, -, *, / and sqrt, so a level is the same on every machine. Lengths are metres, y is up,
// faces are counter-clockwise from outside.

#ifndef TALUS_CLI_SAMPLE_MESH_H
#define TALUS_CLI_SAMPLE_MESH_H

#include <talus/base.h>
#include <talus/mesh.h>
#include <talus/vec.h>

/// A growing triangle list. All zero is an empty one. The first failure is kept in `result`; calls after it do nothing,
/// so a level is written without a check a line.
typedef struct tl_sample_mesh {
    tl_vec3 *vertices;
    uint32_t *indices;
    uint32_t vertex_count, vertex_capacity;
    uint32_t triangle_count, triangle_capacity;
    bool counting; ///< count triangles only; store nothing
    tl_result result;
    tl_vec3 origin;         ///< where the local origin of the pieces lies
    unsigned quarter_turns; ///< pieces are turned about y by this many quarters before they are moved; exact
} tl_sample_mesh;

void tl_sample_mesh_free(tl_sample_mesh *mesh);
tl_mesh_view tl_sample_mesh_as_view(const tl_sample_mesh *mesh);

/// Where the pieces that follow are put.
void tl_sample_place(tl_sample_mesh *mesh, tl_vec3 origin, unsigned quarter_turns);

/// Adds a vertex in local coordinates and gives its index.
uint32_t tl_sample_vertex(tl_sample_mesh *mesh, tl_vec3 local);
void tl_sample_triangle(tl_sample_mesh *mesh, uint32_t a, uint32_t b, uint32_t c);
/// Two triangles, a-b-c and a-c-d.
void tl_sample_quad(tl_sample_mesh *mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

/// 12 triangles.
void tl_sample_box(tl_sample_mesh *mesh, tl_aabb box);
/// Steps that climb towards +x and fill the box below them: `steps` of equal rise, >= 1.
void tl_sample_stairs(tl_sample_mesh *mesh, tl_aabb box, uint32_t steps);
/// A wedge that climbs towards +x and fills half of the box. 8 triangles.
void tl_sample_ramp(tl_sample_mesh *mesh, tl_aabb box);
/// A gable roof on the box's footprint, ridge along x. 8 triangles.
void tl_sample_gable(tl_sample_mesh *mesh, tl_aabb box);
/// An upright prism with 4 * quarter_sides sides.
void tl_sample_pillar(tl_sample_mesh *mesh, tl_vec3 base, float radius, float height, uint32_t quarter_sides);
/// A half ring that stands on the ground across x, of rectangular section.
void tl_sample_arch(tl_sample_mesh *mesh, tl_vec3 base, float inner_radius, float outer_radius, float depth,
                    uint32_t segments);
/// An octahedron split `level` times, pushed onto a dented sphere: 8 * 4^level triangles.
void tl_sample_rock(tl_sample_mesh *mesh, tl_vec3 center, float radius, uint32_t level, uint64_t seed);

static inline tl_aabb tl_sample_bounds(float x0, float y0, float z0, float x1, float y1, float z1)
{
    tl_aabb box = { { x0, y0, z0 }, { x1, y1, z1 } };
    return box;
}

/// SplitMix64 (Steele, Lea, Flood 2014): one word of state.
typedef struct tl_sample_random {
    uint64_t state;
} tl_sample_random;

/// A source that depends on all three and nothing else, so that each part of a level has its own.
tl_sample_random tl_sample_random_make(uint64_t seed, uint64_t x, uint64_t z);
uint64_t tl_sample_random_u64(tl_sample_random *random);
/// [0, bound), bound > 0.
uint32_t tl_sample_random_below(tl_sample_random *random, uint32_t bound);
/// [low, high) in 24 bits.
float tl_sample_random_range(tl_sample_random *random, float low, float high);

#endif
