// SPDX-License-Identifier: MIT
//
// Blocks of 256 m: a height field of value noise in cells of 4 m, and on it, by the block's own numbers, a town (the
// land is levelled towards the middle), a cave (a roof of rock on pillars), bridges and a road to the next blocks.

#include "cli/sample/sample_world.h"

#include <math.h>

enum {
    LAND_BLOCK = 256,
    LAND_CELL = 4,
    LAND_CELLS = LAND_BLOCK / LAND_CELL,
    LAND_BLOCKS = TL_SAMPLE_PART_METRES / LAND_BLOCK,
    LAND_ROAD_STEP = 8
};

typedef enum block_kind { LAND_WILD, LAND_TOWN, LAND_CAVES } block_kind;

typedef struct block_place {
    uint64_t seed;
    int64_t x, z; // in the world, blocks
    block_kind kind;
    float level; // height of a town's ground
} block_place;

static double noise_at(uint64_t seed, int64_t x, int64_t z)
{
    tl_sample_random random = tl_sample_random_make(seed, (uint64_t)x, (uint64_t)z);
    return (double)tl_sample_random_range(&random, 0.0f, 1.0f);
}

static double smooth_noise(uint64_t seed, double x, double z)
{
    const double fx = floor(x), fz = floor(z);
    double u = x - fx, v = z - fz;
    const int64_t ix = (int64_t)fx, iz = (int64_t)fz;
    u = u * u * (3.0 - 2.0 * u);
    v = v * v * (3.0 - 2.0 * v);
    const double low = noise_at(seed, ix, iz) * (1.0 - u) + noise_at(seed, ix + 1, iz) * u;
    const double high = noise_at(seed, ix, iz + 1) * (1.0 - u) + noise_at(seed, ix + 1, iz + 1) * u;
    return low * (1.0 - v) + high * v;
}

static double wild_height(uint64_t seed, double x, double z)
{
    return 90.0 * smooth_noise(seed, x / 700.0, z / 700.0) + 22.0 * smooth_noise(seed ^ 1, x / 130.0, z / 130.0) +
           3.0 * smooth_noise(seed ^ 2, x / 24.0, z / 24.0);
}

static block_place place_block(uint64_t seed, int64_t x, int64_t z)
{
    tl_sample_random random = tl_sample_random_make(seed ^ 0x776f726c64u, (uint64_t)x, (uint64_t)z);
    const uint32_t draw = tl_sample_random_below(&random, 4);
    block_place place = { seed, x, z, draw == 0 ? LAND_TOWN : draw == 1 ? LAND_CAVES : LAND_WILD, 0.0f };
    const double block = LAND_BLOCK;
    place.level = (float)wild_height(seed, ((double)x + 0.5) * block, ((double)z + 0.5) * block);
    return place;
}

// The ground at a point of a block, metres from its corner. At the block's edges it is the wild land, whatever lies
// beside.
static float ground(const block_place *place, float x, float z)
{
    const double block = LAND_BLOCK, half = 0.5 * block,
                 wide = fmax(fabs((double)x - half), fabs((double)z - half)) / half;
    const double wild =
        wild_height(place->seed, (double)place->x * block + (double)x, (double)place->z * block + (double)z);
    const double flat = place->kind != LAND_TOWN || wide >= 1.0 ? 0.0 : wide < 0.7 ? 1.0 : (1.0 - wide) / 0.3;
    return (float)(wild + flat * flat * (3.0 - 2.0 * flat) * ((double)place->level - wild));
}

static void add_land(tl_sample_mesh *mesh, const block_place *place)
{
    const uint32_t first = mesh->vertex_count;
    for (int z = 0; z <= LAND_CELLS; z++) {
        for (int x = 0; x <= LAND_CELLS; x++) {
            const float px = (float)(x * LAND_CELL), pz = (float)(z * LAND_CELL);
            tl_sample_vertex(mesh, tl_vec3_make(px, ground(place, px, pz), pz));
        }
    }
    for (uint32_t z = 0; z < LAND_CELLS; z++) {
        for (uint32_t x = 0; x < LAND_CELLS; x++) {
            const uint32_t a = first + z * (LAND_CELLS + 1) + x, b = a + LAND_CELLS + 1;
            tl_sample_quad(mesh, a, b, b + 1, a + 1);
        }
    }
}

// A strip of quads a hand above the land, from edge to edge through the middle.
static void add_road(tl_sample_mesh *mesh, const block_place *place, bool along_x)
{
    const float middle = 0.5f * (float)LAND_BLOCK, half = 3.0f;
    uint32_t before[2] = { 0, 0 };
    for (int i = 0; i <= LAND_BLOCK / LAND_ROAD_STEP; i++) {
        const float t = (float)(i * LAND_ROAD_STEP);
        uint32_t side[2];
        for (int k = 0; k < 2; k++) {
            const float across = middle + (k == 0 ? -half : half);
            const float x = along_x ? t : across, z = along_x ? across : t;
            const float height =
                tl_maxf(ground(place, x, z), ground(place, along_x ? t : middle, along_x ? middle : t));
            side[k] = tl_sample_vertex(mesh, tl_vec3_make(x, height + 0.1f, z));
        }
        if (i > 0 && along_x) {
            tl_sample_quad(mesh, before[0], before[1], side[1], side[0]);
        } else if (i > 0) {
            tl_sample_quad(mesh, before[0], side[0], side[1], before[1]);
        }
        before[0] = side[0];
        before[1] = side[1];
    }
}

static void add_town_house(tl_sample_mesh *mesh, float x, float y, float z, tl_sample_random *random)
{
    const float width = tl_sample_random_range(random, 8.0f, 14.0f),
                depth = tl_sample_random_range(random, 8.0f, 12.0f);
    const float height = 3.0f * (1.0f + (float)tl_sample_random_below(random, 4));
    tl_sample_box(mesh, tl_sample_bounds(x, y - 1.0f, z, x + width, y + height, z + depth));
    if (tl_sample_random_below(random, 2) == 0) {
        tl_sample_gable(mesh, tl_sample_bounds(x, y + height, z, x + width, y + height + 2.0f, z + depth));
    } else if (height < 4.0f) { // a flat roof to climb
        tl_sample_stairs(mesh, tl_sample_bounds(x - 6.0f, y - 0.2f, z, x, y + height, z + 2.0f), 12);
    }
    if (tl_sample_random_below(random, 3) == 0) {
        tl_sample_pillar(mesh, tl_vec3_make(x - 1.5f, y - 1.0f, z + depth + 1.0f), 0.4f, 5.0f, 3);
    }
}

static void add_town(tl_sample_mesh *mesh, const block_place *place)
{
    tl_sample_random random = tl_sample_random_make(place->seed ^ 0x746f776eu, (uint64_t)place->x, (uint64_t)place->z);
    for (int row = 0; row < 6; row++) {
        for (int column = 0; column < 6; column++) {
            const float x = 42.0f + 30.0f * (float)column, z = 42.0f + 30.0f * (float)row;
            const bool on_road = fabsf(x + 7.0f - 128.0f) < 14.0f || fabsf(z + 6.0f - 128.0f) < 14.0f;
            if (!on_road && tl_sample_random_below(&random, 5) != 0) {
                add_town_house(mesh, x, place->level, z, &random);
            }
        }
    }
}

// A bridge over the road: two ramps and a deck.
static void add_land_bridge(tl_sample_mesh *mesh, const block_place *place)
{
    const float y = ground(place, 128.0f, 60.0f), z = 58.0f;
    tl_sample_box(mesh, tl_sample_bounds(118.0f, y + 4.0f, z, 138.0f, y + 4.5f, z + 4.0f));
    tl_sample_ramp(mesh, tl_sample_bounds(100.0f, y - 6.0f, z, 118.0f, y + 4.5f, z + 4.0f));
    tl_sample_stairs(mesh, tl_sample_bounds(88.0f, y - 12.0f, z + 6.0f, 118.0f, y + 4.5f, z + 9.0f), 40);
    tl_sample_box(mesh, tl_sample_bounds(118.0f, y + 4.0f, z + 4.0f, 121.0f, y + 4.5f, z + 9.0f));
}

// A roof of rock over the land, whose underside an agent walks below.
static void add_cave(tl_sample_mesh *mesh, const block_place *place, float x0, float z0)
{
    enum { SIDE = 14 };
    uint32_t first[2];
    for (int side = 0; side < 2; side++) {
        first[side] = mesh->vertex_count;
        for (int z = 0; z <= SIDE; z++) {
            for (int x = 0; x <= SIDE; x++) {
                const float px = x0 + (float)(x * LAND_CELL), pz = z0 + (float)(z * LAND_CELL);
                const float roof = ground(place, px, pz) + 4.0f +
                                   (float)(3.0 * smooth_noise(place->seed ^ 7, (double)px / 9.0, (double)pz / 9.0));
                tl_sample_vertex(mesh, tl_vec3_make(px, roof + (side == 0 ? 0.0f : 2.0f), pz));
            }
        }
    }
    for (uint32_t z = 0; z < SIDE; z++) {
        for (uint32_t x = 0; x < SIDE; x++) {
            const uint32_t at = z * (SIDE + 1) + x, a = first[0] + at, b = first[1] + at;
            tl_sample_quad(mesh, a, a + 1, a + SIDE + 2, a + SIDE + 1);
            tl_sample_quad(mesh, b, b + SIDE + 1, b + SIDE + 2, b + 1);
        }
    }
    for (int i = 0; i < 9; i++) {
        const float x = x0 + 8.0f + 18.0f * (float)(i % 3), z = z0 + 8.0f + 18.0f * (float)(i / 3);
        tl_sample_pillar(mesh, tl_vec3_make(x, ground(place, x, z) - 1.0f, z), 1.2f, 9.0f, 3);
    }
}

static void add_block(tl_sample_mesh *mesh, const block_place *place)
{
    add_land(mesh, place);
    add_road(mesh, place, true);
    add_road(mesh, place, false);
    if (place->kind == LAND_TOWN) {
        add_town(mesh, place);
    } else if (place->kind == LAND_CAVES) {
        add_cave(mesh, place, 24.0f, 24.0f);
        add_cave(mesh, place, 168.0f, 156.0f);
        add_land_bridge(mesh, place);
    } else {
        tl_sample_rock(mesh, tl_vec3_make(64.0f, ground(place, 64.0f, 190.0f), 190.0f), 9.0f, 2,
                       place->seed ^ (uint64_t)place->x);
    }
}

void tl_sample_world_part(uint64_t seed, uint32_t x, uint32_t z, tl_sample_mesh *mesh)
{
    for (uint32_t i = 0; i < LAND_BLOCKS * LAND_BLOCKS; i++) {
        const uint32_t bx = i % LAND_BLOCKS, bz = i / LAND_BLOCKS;
        const block_place place = place_block(seed, (int64_t)x * LAND_BLOCKS + bx, (int64_t)z * LAND_BLOCKS + bz);
        tl_sample_place(mesh, tl_vec3_make((float)(bx * LAND_BLOCK), 0.0f, (float)(bz * LAND_BLOCK)), 0);
        add_block(mesh, &place);
    }
}
