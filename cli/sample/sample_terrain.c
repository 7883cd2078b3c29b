// SPDX-License-Identifier: MIT
//
// Terrain: a height field of value noise (Ken Perlin's lattice idea with smooth interpolation), terraced into plateaus
// where a slow noise says so. Most 96 m squares have a mound with a gorge cut through, roofed over with rock to a
// tunnel, and each has an arch. A small request is given wide grid cells, a large one cells of 1 m over a large land.

#include "cli/sample/sample_level.h"

#include <stdlib.h>

#define FEATURE_SQUARE 96.0f
#define GORGE_HALF     3.0f
#define GORGE_LENGTH   44.0f

enum { GORGE_SLICES = 24, GORGE_RIBS = 8 };

static float lattice_noise(uint64_t seed, int64_t x, int64_t z)
{
    tl_sample_random random = tl_sample_random_make(seed, (uint64_t)x, (uint64_t)z);
    return tl_sample_random_range(&random, 0.0f, 1.0f);
}

static float value_noise(uint64_t seed, float x, float z)
{
    float fx = floorf(x);
    float fz = floorf(z);
    float u = x - fx;
    float v = z - fz;
    int64_t ix = (int64_t)fx;
    int64_t iz = (int64_t)fz;
    u = u * u * (3.0f - 2.0f * u);
    v = v * v * (3.0f - 2.0f * v);
    float low = lattice_noise(seed, ix, iz) * (1.0f - u) + lattice_noise(seed, ix + 1, iz) * u;
    float high = lattice_noise(seed, ix, iz + 1) * (1.0f - u) + lattice_noise(seed, ix + 1, iz + 1) * u;
    return low * (1.0f - v) + high * v;
}

// The land before gorges are cut, metres above 0.
static float natural_height(uint64_t seed, float x, float z)
{
    float height = 22.0f * value_noise(seed, x / 61.0f, z / 61.0f) +
                   7.0f * value_noise(seed ^ 1, x / 23.0f, z / 23.0f) +
                   1.6f * value_noise(seed ^ 2, x / 7.0f, z / 7.0f);
    float plateau = value_noise(seed ^ 3, x / 83.0f, z / 83.0f);
    if (plateau > 0.55f) {
        float step = floorf(height / 5.0f);
        float rest = height / 5.0f - step;
        float cliff = tl_clampf((rest - 0.8f) * 5.0f, 0.0f, 1.0f);
        float weight = tl_clampf((plateau - 0.55f) * 12.0f, 0.0f, 1.0f);
        height += weight * ((step + cliff) * 5.0f - height);
    }
    return height;
}

// A cut along x, through a mound that is put there for it. half_width 0: none here.
typedef struct gorge {
    float x, z;       // of its middle
    float west, east; // floor at both ends
    float half_width;
} gorge;

static gorge gorge_of(uint64_t seed, int64_t square_x, int64_t square_z)
{
    tl_sample_random random = tl_sample_random_make(seed ^ 0x676f726765u, (uint64_t)square_x, (uint64_t)square_z);
    gorge cut = { 0, 0, 0, 0, 0 };
    if (tl_sample_random_below(&random, 3) != 0) {
        float half = 0.5f * GORGE_LENGTH;
        cut.x = ((float)square_x + tl_sample_random_range(&random, 0.35f, 0.65f)) * FEATURE_SQUARE;
        cut.z = ((float)square_z + tl_sample_random_range(&random, 0.25f, 0.75f)) * FEATURE_SQUARE;
        cut.west = natural_height(seed, cut.x - half, cut.z);
        cut.east = natural_height(seed, cut.x + half, cut.z);
        cut.half_width = GORGE_HALF;
    }
    return cut;
}

static float gorge_floor(const gorge *cut, float x)
{
    float t = tl_clampf((x - cut->x) / GORGE_LENGTH + 0.5f, 0.0f, 1.0f);
    return cut->west * (1.0f - t) + cut->east * t;
}

// The land with the mound.
static float hill_height(uint64_t seed, const gorge *cut, float x, float z)
{
    float along = tl_minf(fabsf(x - cut->x) / (0.5f * GORGE_LENGTH), 1.0f);
    float across = tl_minf(fabsf(z - cut->z) / 20.0f, 1.0f);
    float along_weight = (1.0f - along * along) * (1.0f - along * along);
    float across_weight = (1.0f - across * across) * (1.0f - across * across);
    float mound = cut->half_width > 0.0f ? 11.0f * along_weight * across_weight : 0.0f;
    return natural_height(seed, x, z) + mound;
}

// The land with the mound and the cut: gentle at both ends, steep at the sides.
static float ground_height(uint64_t seed, const gorge *cut, float x, float z)
{
    float height = hill_height(seed, cut, x, z);
    float along = tl_clampf((0.5f * GORGE_LENGTH - fabsf(x - cut->x)) / 6.0f, 0.0f, 1.0f);
    float across = tl_clampf(cut->half_width + 1.0f - fabsf(z - cut->z), 0.0f, 1.0f);
    float depth = height - gorge_floor(cut, x);
    return cut->half_width > 0.0f && depth > 0.0f ? height - along * across * depth : height;
}

static float spacing_of(const tl_sample_plan *plan)
{
    uint64_t cells = (uint64_t)plan->columns * plan->rows;
    return cells < 2000 ? 4.0f : cells < 20000 ? 2.0f : 1.0f;
}

// Four corners of the roof's cross-section a rib: the roof is closed above, below and at its ends.
static void add_gorge_roof(uint64_t seed, const gorge *cut, tl_sample_mesh *mesh)
{
    uint32_t top[GORGE_SLICES + 1][GORGE_RIBS + 1];
    uint32_t bottom[GORGE_SLICES + 1][GORGE_RIBS + 1];
    for (uint32_t i = 0; i <= GORGE_SLICES; ++i) {
        float x = cut->x + 24.0f * ((float)i / (float)GORGE_SLICES - 0.5f);
        for (uint32_t k = 0; k <= GORGE_RIBS; ++k) {
            float v = 2.0f * (float)k / (float)GORGE_RIBS - 1.0f;
            float z = cut->z + v * (cut->half_width + 1.5f);
            float under = gorge_floor(cut, x) + 4.5f - 2.0f * v * v;
            float over = tl_maxf(hill_height(seed, cut, x, z), under + 0.8f);
            top[i][k] = tl_sample_vertex(mesh, tl_vec3_make(x, over, z));
            bottom[i][k] = tl_sample_vertex(mesh, tl_vec3_make(x, under, z));
        }
    }
    for (uint32_t i = 0; i < GORGE_SLICES; ++i) {
        for (uint32_t k = 0; k < GORGE_RIBS; ++k) {
            tl_sample_quad(mesh, top[i][k], top[i][k + 1], top[i + 1][k + 1], top[i + 1][k]);
            tl_sample_quad(mesh, bottom[i][k], bottom[i + 1][k], bottom[i + 1][k + 1], bottom[i][k + 1]);
        }
        tl_sample_quad(mesh, bottom[i][0], top[i][0], top[i + 1][0], bottom[i + 1][0]);
        tl_sample_quad(mesh, bottom[i][GORGE_RIBS], bottom[i + 1][GORGE_RIBS], top[i + 1][GORGE_RIBS],
                       top[i][GORGE_RIBS]);
    }
    for (uint32_t k = 0; k < GORGE_RIBS; ++k) {
        tl_sample_quad(mesh, bottom[0][k], bottom[0][k + 1], top[0][k + 1], top[0][k]);
        tl_sample_quad(mesh, bottom[GORGE_SLICES][k], top[GORGE_SLICES][k], top[GORGE_SLICES][k + 1],
                       bottom[GORGE_SLICES][k + 1]);
    }
}

static void add_features(const tl_sample_plan *plan, uint32_t squares_x, uint32_t squares_z, tl_sample_mesh *mesh)
{
    for (uint32_t row = 0; row < squares_z; ++row) {
        for (uint32_t column = 0; column < squares_x; ++column) {
            gorge cut = gorge_of(plan->seed, column, row);
            if (cut.half_width > 0.0f) {
                add_gorge_roof(plan->seed, &cut, mesh);
            }
            tl_sample_random random = tl_sample_random_make(plan->seed ^ 0x61726368u, column, row);
            float x = ((float)column + tl_sample_random_range(&random, 0.15f, 0.85f)) * FEATURE_SQUARE;
            float z = ((float)row + tl_sample_random_range(&random, 0.15f, 0.85f)) * FEATURE_SQUARE;
            float ground = natural_height(plan->seed, x, z);
            ground = tl_minf(ground, natural_height(plan->seed, x - 6.0f, z));
            ground = tl_minf(ground, natural_height(plan->seed, x + 6.0f, z));
            tl_sample_arch(mesh, tl_vec3_make(x, ground - 1.0f, z), 5.5f, 7.5f, 3.0f, 12);
        }
    }
}

// Heights of one row of the grid. Gorges never reach over the border of their square.
static void fill_row(const tl_sample_plan *plan, uint32_t row, const gorge *gorges, uint32_t squares_x,
                     tl_sample_mesh *mesh)
{
    float spacing = spacing_of(plan);
    float z = (float)row * spacing;
    for (uint32_t column = 0; column <= plan->columns; ++column) {
        float x = (float)column * spacing;
        uint32_t square = (uint32_t)(x / FEATURE_SQUARE);
        const gorge *cut = square < squares_x && gorges != NULL ? &gorges[square] : NULL;
        float y = cut != NULL ? ground_height(plan->seed, cut, x, z) : natural_height(plan->seed, x, z);
        tl_sample_vertex(mesh, tl_vec3_make(x, y, z));
    }
}

static void add_hills(const tl_sample_plan *plan, uint32_t squares_x, uint32_t squares_z, tl_sample_mesh *mesh)
{
    gorge *gorges = malloc((squares_x + 1) * sizeof(*gorges));
    if (gorges == NULL) {
        mesh->result = TL_ERR_MEMORY;
        return;
    }
    uint32_t square_row = UINT32_MAX;
    for (uint32_t row = 0; row <= plan->rows && !mesh->counting; ++row) {
        uint32_t square = (uint32_t)((float)row * spacing_of(plan) / FEATURE_SQUARE);
        for (uint32_t i = 0; square != square_row && i < squares_x; ++i) {
            gorges[i] = gorge_of(plan->seed, i, square);
        }
        square_row = square;
        fill_row(plan, row, square < squares_z ? gorges : NULL, squares_x, mesh);
    }
    free(gorges);
    uint32_t stride = plan->columns + 1;
    for (uint32_t row = 0; row < plan->rows; ++row) {
        for (uint32_t column = 0; column < plan->columns; ++column) {
            uint32_t a = row * stride + column;
            if ((row + column) % 2 != 0) { // diagonals alternate, so that slopes do not lean one way
                tl_sample_quad(mesh, a, a + stride, a + stride + 1, a + 1);
            } else {
                tl_sample_quad(mesh, a + stride, a + stride + 1, a + 1, a);
            }
        }
    }
}

void tl_sample_build_terrain(const tl_sample_plan *plan, tl_sample_mesh *mesh)
{
    uint32_t squares_x = (uint32_t)((float)plan->columns * spacing_of(plan) / FEATURE_SQUARE);
    uint32_t squares_z = (uint32_t)((float)plan->rows * spacing_of(plan) / FEATURE_SQUARE);
    tl_sample_place(mesh, tl_vec3_make(0, 0, 0), 0);
    add_hills(plan, squares_x, squares_z, mesh);
    add_features(plan, squares_x, squares_z, mesh);
}

tl_vec3 tl_sample_terrain_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random)
{
    float spacing = spacing_of(plan);
    float x = tl_sample_random_range(random, radius, (float)plan->columns * spacing - radius);
    float z = tl_sample_random_range(random, radius, (float)plan->rows * spacing - radius);
    gorge cut = gorge_of(plan->seed, (int64_t)(x / FEATURE_SQUARE), (int64_t)(z / FEATURE_SQUARE));
    return tl_vec3_make(x, ground_height(plan->seed, &cut, x, z), z);
}
