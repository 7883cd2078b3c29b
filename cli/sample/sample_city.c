// SPDX-License-Identifier: MIT
//
// City: blocks of 52 m, each a pavement with a kerb and four lots between streets. A lot has a house of one to five
// storeys, hollow, with windows, doors, partitions and stairs from floor to floor, up to a flat roof with a parapet or
// under a gable with overhang; or a park with trees round a sunken square. Footbridges lead over some streets.

#include "cli/sample/sample_carving.h"
#include "cli/sample/sample_level.h"

#define CITY_BLOCK  52.0f
#define PAVEMENT    20.0f // from the block's centre to the kerb
#define KERB        0.15f
#define LOT         10.0f // from the block's centre to a lot's centre
#define CITY_STOREY 3.2f
#define SLAB        0.25f
#define CITY_WALL   0.3f
#define HALF_X      8.0f // of a house
#define HALF_Z      6.0f

typedef enum lot_kind { LOT_FLAT, LOT_GABLE, LOT_PARK } lot_kind;

typedef struct lot {
    lot_kind kind;
    uint32_t storeys;
    unsigned turns;
    tl_vec3 center; // on the pavement
    uint64_t hash;
} lot;

static lot lot_of(const tl_sample_plan *plan, uint32_t column, uint32_t row, unsigned index)
{
    tl_sample_random random = tl_sample_random_make(plan->seed + index, column, row);
    lot result;
    uint32_t draw = tl_sample_random_below(&random, 8);
    result.kind = draw < 4 ? LOT_FLAT : draw < 6 ? LOT_GABLE : LOT_PARK;
    result.storeys = result.kind == LOT_FLAT ? 1 + tl_sample_random_below(&random, 5) : 1 + draw % 2;
    result.turns = 2 * tl_sample_random_below(&random, 2);
    result.center = tl_vec3_make(((float)column + 0.5f) * CITY_BLOCK + (index & 1 ? LOT : -LOT), KERB,
                                 ((float)row + 0.5f) * CITY_BLOCK + (index & 2 ? LOT : -LOT));
    result.hash = tl_sample_random_u64(&random);
    return result;
}

static void cut_windows(tl_sample_carving *walls, float floor)
{
    static const float along_x[3] = { -6.4f, -2.2f, 5.0f };
    static const float along_z[2] = { -3.2f, 2.0f };
    for (unsigned i = 0; i < 3; ++i) {
        tl_sample_carving_cut(walls, along_x[i], floor + 0.9f, -HALF_Z, along_x[i] + 1.4f, floor + 2.2f, HALF_Z);
    }
    for (unsigned i = 0; i < 2; ++i) {
        tl_sample_carving_cut(walls, -HALF_X, floor + 0.9f, along_z[i], HALF_X, floor + 2.2f, along_z[i] + 1.2f);
    }
}

// Walls, and thin partitions with a door on each floor. Floors are pieces of their own: the windows' planes would
// cut them to shreds.
static void add_house_walls(const lot *here, bool windows, float top, tl_sample_mesh *mesh)
{
    tl_sample_carving walls = { 0 };
    float x = HALF_X - CITY_WALL;
    float z = HALF_Z - CITY_WALL;
    tl_sample_carving_add(&walls, -HALF_X, 0.0f, -HALF_Z, HALF_X, top, HALF_Z);
    tl_sample_carving_cut(&walls, -x, 0.0f, -z, x, top, z);
    for (uint32_t i = 0; windows && i < here->storeys; ++i) {
        cut_windows(&walls, (float)i * CITY_STOREY);
    }
    tl_sample_carving_cut(&walls, 2.0f, 0.0f, -HALF_Z, 4.2f, 2.4f, -z); // front door
    tl_sample_carving_cut(&walls, -0.2f, 0.0f, z, 2.0f, 2.4f, HALF_Z);  // back door
    tl_sample_carving_finish(&walls, NULL, mesh);
    for (uint32_t i = 0; windows && i < here->storeys; ++i) {
        float floor = (float)i * CITY_STOREY;
        tl_sample_carving_add(&walls, -0.06f, floor, -z, 0.06f, floor + CITY_STOREY - SLAB, z);
        tl_sample_carving_cut(&walls, -0.06f, floor, -1.2f, 0.06f, floor + 2.4f, 1.2f);
        tl_sample_carving_finish(&walls, NULL, mesh);
    }
}

// Stairs alternate between two lanes, along the front and along the back wall, so that no flight stands over another.
static void add_floors(const lot *here, bool roof_access, tl_sample_mesh *mesh)
{
    float x = HALF_X - CITY_WALL;
    float z = HALF_Z - CITY_WALL;
    for (uint32_t i = 1; i <= here->storeys; ++i) {
        float top = (float)i * CITY_STOREY;
        unsigned turns = here->turns + 2 * ((i - 1) % 2);
        bool opening = i < here->storeys || roof_access;
        tl_sample_carving slab = { 0 };
        tl_sample_place(mesh, here->center, turns);
        tl_sample_carving_add(&slab, -x, top - SLAB, -z, x, top, z);
        if (opening) {
            tl_sample_carving_cut(&slab, -6.2f, top - SLAB, -z, -2.2f, top, -z + 2.5f);
        }
        tl_sample_carving_finish(&slab, NULL, mesh);
        if (opening) {
            tl_sample_stairs(mesh, tl_sample_bounds(-6.0f, top - CITY_STOREY, -z, -2.2f, top, -z + 2.4f), 16);
        }
    }
}

static void add_house(const lot *here, uint32_t detail, tl_sample_mesh *mesh)
{
    bool flat = here->kind == LOT_FLAT;
    float height = (float)here->storeys * CITY_STOREY;
    tl_sample_place(mesh, here->center, here->turns);
    add_house_walls(here, detail > 0, flat ? height + 0.8f : height, mesh);
    add_floors(here, flat && detail > 0 && here->hash % 2 == 0, mesh);
    tl_sample_place(mesh, here->center, here->turns);
    if (!flat) {
        tl_sample_gable(mesh, tl_sample_bounds(-HALF_X - 0.7f, height, -HALF_Z - 0.8f, HALF_X + 0.7f, height + 3.4f,
                                               HALF_Z + 0.8f));
    }
}

static void add_tree(tl_sample_mesh *mesh, float x, float z, uint64_t seed)
{
    tl_sample_pillar(mesh, tl_vec3_make(x, 0.0f, z), 0.2f, 3.0f, 2);
    tl_sample_rock(mesh, tl_vec3_make(x, 4.2f, z), 1.7f, 2, seed);
}

// The sunken square is cut out of the ground by add_ground; here come its stairs, a thin fence and trees.
static void add_park(const lot *here, tl_sample_mesh *mesh)
{
    tl_sample_carving fence = { 0 };
    tl_sample_place(mesh, here->center, here->turns);
    tl_sample_stairs(mesh, tl_sample_bounds(0.0f, -3.0f, 2.2f, 5.0f, 0.0f, 5.0f), 15);
    tl_sample_carving_add(&fence, -5.6f, 0.0f, -5.6f, 5.6f, 1.0f, 5.6f);
    tl_sample_carving_cut(&fence, -5.52f, 0.0f, -5.52f, 5.52f, 1.0f, 5.52f);
    tl_sample_carving_cut(&fence, 5.52f, 0.0f, 2.2f, 5.6f, 1.0f, 5.0f);
    tl_sample_carving_finish(&fence, NULL, mesh);
    for (unsigned i = 0; i < 4; ++i) {
        add_tree(mesh, i & 1 ? 7.5f : -7.5f, i & 2 ? 7.5f : -7.5f, here->hash + i);
    }
}

static void add_city_ground(const tl_sample_plan *plan, uint32_t column, uint32_t row, tl_sample_mesh *mesh)
{
    tl_vec3 center = { ((float)column + 0.5f) * CITY_BLOCK, 0.0f, ((float)row + 0.5f) * CITY_BLOCK };
    tl_sample_carving ground = { 0 };
    float half = 0.5f * CITY_BLOCK;
    tl_sample_carving_add(&ground, -half, -4.0f, -half, half, 0.0f, half);
    tl_sample_carving_add(&ground, -PAVEMENT, 0.0f, -PAVEMENT, PAVEMENT, KERB, PAVEMENT);
    for (unsigned i = 0; i < 4 && plan->detail > 0; ++i) {
        if (lot_of(plan, column, row, i).kind == LOT_PARK) {
            float x = i & 1 ? LOT : -LOT;
            float z = i & 2 ? LOT : -LOT;
            tl_sample_carving_cut(&ground, x - 5.0f, KERB - 3.0f, z - 5.0f, x + 5.0f, KERB, z + 5.0f);
        }
    }
    tl_sample_place(mesh, center, 0);
    tl_sample_carving_finish(&ground, NULL, mesh);
}

// Over the street towards +x, with stairs along the kerb on both pavements.
static void add_footbridge(uint32_t column, uint32_t row, tl_sample_mesh *mesh)
{
    tl_vec3 middle = { ((float)column + 1.0f) * CITY_BLOCK, 0.0f, ((float)row + 0.5f) * CITY_BLOCK };
    tl_sample_carving deck = { 0 };
    tl_sample_place(mesh, middle, 0);
    tl_sample_carving_add(&deck, -7.8f, 4.7f, -1.4f, 7.8f, 5.0f, 1.4f);
    tl_sample_carving_add(&deck, -4.9f, 5.0f, -1.4f, 4.9f, 6.0f, -1.34f);
    tl_sample_carving_add(&deck, -4.9f, 5.0f, 1.34f, 4.9f, 6.0f, 1.4f);
    tl_sample_carving_finish(&deck, NULL, mesh);
    for (unsigned side = 0; side < 2; ++side) {
        tl_sample_place(mesh, middle, 1 + 2 * side); // climbs towards -z, then towards +z
        tl_sample_stairs(mesh, tl_sample_bounds(-8.4f, 0.0f, 5.0f, -1.4f, 5.0f, 7.8f), 28);
        tl_sample_pillar(mesh, tl_vec3_make(0.0f, 0.0f, 6.6f), 0.3f, 4.7f, 2);
    }
}

static bool has_footbridge(const tl_sample_plan *plan, uint32_t column, uint32_t row)
{
    tl_sample_random random = tl_sample_random_make(plan->seed ^ 0x627269646765u, column, row);
    return plan->detail > 0 && column + 1 < plan->columns && tl_sample_random_below(&random, 3) == 0;
}

void tl_sample_build_city(const tl_sample_plan *plan, tl_sample_mesh *mesh)
{
    for (uint32_t row = 0; row < plan->rows; ++row) {
        for (uint32_t column = 0; column < plan->columns; ++column) {
            add_city_ground(plan, column, row, mesh);
            for (unsigned i = 0; i < (plan->detail > 0 ? 4u : 1u); ++i) {
                lot here = lot_of(plan, column, row, i);
                if (plan->detail == 0) {
                    here.kind = LOT_GABLE;
                    here.storeys = 1;
                }
                if (here.kind == LOT_PARK) {
                    add_park(&here, mesh);
                } else {
                    add_house(&here, plan->detail, mesh);
                }
            }
            if (has_footbridge(plan, column, row)) {
                add_footbridge(column, row, mesh);
            }
        }
    }
}

// In the gutter beside the kerb.
tl_vec3 tl_sample_city_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random)
{
    uint32_t column = tl_sample_random_below(random, plan->columns);
    uint32_t row = tl_sample_random_below(random, plan->rows);
    float across = tl_sample_random_range(random, PAVEMENT + radius, PAVEMENT + 2.5f);
    float along = tl_sample_random_range(random, -PAVEMENT, PAVEMENT);
    uint32_t side = tl_sample_random_below(random, 4);
    tl_vec3 local = side == 0   ? tl_vec3_make(across, 0.0f, along)
                    : side == 1 ? tl_vec3_make(-across, 0.0f, along)
                    : side == 2 ? tl_vec3_make(along, 0.0f, across)
                                : tl_vec3_make(along, 0.0f, -across);
    return tl_add(tl_vec3_make(((float)column + 0.5f) * CITY_BLOCK, 0.0f, ((float)row + 0.5f) * CITY_BLOCK), local);
}
