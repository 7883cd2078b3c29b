// SPDX-License-Identifier: MIT
//
// Dungeon: a cell of 20 m holds a room; corridors join it to its neighbours as a binary-tree maze with extra loops.
// Rooms lie on three floor heights; the higher room's half of a corridor has the stairs or the ramp. Everything is
// hollowed out of rock, so surfaces look inward and nothing is walkable on top.

#include "cli/sample/sample_carving.h"
#include "cli/sample/sample_level.h"

#define CELL           20.0f
#define HALF_DOOR      1.2f
#define DUNGEON_STOREY 1.6f
#define DOOR_HEIGHT    2.8f

typedef enum room_kind { ROOM_PLAIN, ROOM_PILLARS, ROOM_PIT, ROOM_GALLERY, ROOM_PARTITION, ROOM_KINDS } room_kind;

typedef struct room {
    tl_aabb box; // local to the cell's centre
    room_kind kind;
    uint64_t hash;
} room;

static room room_of(const tl_sample_plan *plan, uint32_t column, uint32_t row)
{
    tl_sample_random random = tl_sample_random_make(plan->seed, column, row);
    room result;
    float half_x = tl_sample_random_range(&random, 4.8f, 6.4f);
    float half_z = tl_sample_random_range(&random, 4.8f, 6.4f);
    float floor = DUNGEON_STOREY * (float)tl_sample_random_below(&random, 3);
    float height = tl_sample_random_range(&random, 4.2f, 5.5f);
    result.kind = plan->detail > 0 ? (room_kind)tl_sample_random_below(&random, ROOM_KINDS) : ROOM_PLAIN;
    result.hash = tl_sample_random_u64(&random);
    result.box = tl_sample_bounds(-half_x, floor, -half_z, half_x, floor + height, half_z);
    return result;
}

// Whether the cell opens towards -x (side 0) or -z (side 1). Every cell but the first opens to at least one, which
// makes the dungeon connected.
static bool opens_back(const tl_sample_plan *plan, uint32_t column, uint32_t row, unsigned side)
{
    if (side == 0 ? column == 0 : row == 0) {
        return false;
    }
    uint64_t hash = room_of(plan, column, row).hash;
    bool only_way = side == 0 ? row == 0 : column == 0;
    bool chosen = (hash & 1) == side;
    bool loop = (hash >> 8) % 10 < 3;
    return only_way || chosen || loop;
}

// The neighbour across side 0 -x, 1 -z, 2 +x, 3 +z, when a corridor leads there.
static bool corridor_to(const tl_sample_plan *plan, uint32_t column, uint32_t row, unsigned side, room *neighbour_out)
{
    uint32_t next_column = side == 0 ? column - 1 : side == 2 ? column + 1 : column;
    uint32_t next_row = side == 1 ? row - 1 : side == 3 ? row + 1 : row;
    bool open = side < 2 ? opens_back(plan, column, row, side)
                         : next_column < plan->columns && next_row < plan->rows &&
                               opens_back(plan, next_column, next_row, side - 2);
    if (open) {
        *neighbour_out = room_of(plan, next_column, next_row);
    }
    return open;
}

// Half a corridor: from the room's wall to the cell's border, whose floor is the lower of the two rooms'.
static void cut_corridor(tl_sample_carving *rock, const room *here, const room *there, unsigned side)
{
    float floor = tl_minf(here->box.min.y, there->box.min.y);
    float top = tl_maxf(here->box.min.y, there->box.min.y) + DOOR_HEIGHT;
    float half = 0.5f * CELL;
    switch (side) {
    case 0:
        tl_sample_carving_cut(rock, -half, floor, -HALF_DOOR, here->box.min.x, top, HALF_DOOR);
        break;
    case 1:
        tl_sample_carving_cut(rock, -HALF_DOOR, floor, -half, HALF_DOOR, top, here->box.min.z);
        break;
    case 2:
        tl_sample_carving_cut(rock, here->box.max.x, floor, -HALF_DOOR, half, top, HALF_DOOR);
        break;
    default:
        tl_sample_carving_cut(rock, -HALF_DOOR, floor, here->box.max.z, HALF_DOOR, top, half);
    }
}

// Stairs or a ramp from the corridor up to the room. Pieces climb towards +x and are turned: side 0 by 0 quarters (the
// corridor comes from -x), and so on round.
static void add_climb(const room *here, const room *there, unsigned side, tl_vec3 center, tl_sample_mesh *mesh)
{
    static const unsigned turns[4] = { 0, 3, 2, 1 };
    float rise = here->box.min.y - there->box.min.y;
    if (rise <= 0.0f) {
        return;
    }
    float reach = side % 2 == 0 ? here->box.max.x : here->box.max.z;
    float length = rise * 1.1f;
    tl_sample_place(mesh, center, turns[side]);
    tl_aabb box = tl_sample_bounds(-reach - length, there->box.min.y, -HALF_DOOR, -reach, here->box.min.y, HALF_DOOR);
    if (rise < 1.5f * DUNGEON_STOREY && (here->hash >> (16 + side)) % 2 != 0) {
        box.min.x = tl_maxf(-reach - 2.0f * rise, -0.5f * CELL);
        tl_sample_ramp(mesh, box);
    } else {
        tl_sample_stairs(mesh, box, (uint32_t)(rise * 5.0f + 0.5f));
    }
}

// What is cut into or left standing in the room.
static void furnish_rock(tl_sample_carving *rock, const room *r)
{
    tl_vec3 a = r->box.min;
    tl_vec3 b = r->box.max;
    switch (r->kind) {
    case ROOM_PIT: // a hole with a bridge across and one flush floor all round
        tl_sample_carving_cut(rock, a.x + 2.2f, a.y - 4.0f, a.z + 2.2f, b.x - 2.2f, a.y, b.z - 2.2f);
        tl_sample_carving_add(rock, a.x + 2.2f, a.y - 0.4f, -1.3f, b.x - 2.2f, a.y, 1.3f);
        break;
    case ROOM_GALLERY: // a second floor along +z, reached by stairs
        tl_sample_carving_cut(rock, a.x, b.y, a.z, b.x, a.y + 6.0f, b.z);
        tl_sample_carving_add(rock, a.x, a.y + 3.0f, b.z - 2.6f, b.x, a.y + 3.25f, b.z);
        break;
    case ROOM_PARTITION: // two thin walls with a door each, on opposite sides
        tl_sample_carving_add(rock, a.x, a.y, -1.9f, b.x, b.y, -1.8f);
        tl_sample_carving_cut(rock, a.x + 0.6f, a.y, -1.9f, a.x + 2.8f, a.y + 2.4f, -1.8f);
        tl_sample_carving_add(rock, a.x, a.y, 1.8f, b.x, b.y, 1.9f);
        tl_sample_carving_cut(rock, b.x - 2.8f, a.y, 1.8f, b.x - 0.6f, a.y + 2.4f, 1.9f);
        break;
    default:
        break;
    }
}

static void furnish_mesh(const room *r, tl_vec3 center, tl_sample_mesh *mesh)
{
    tl_vec3 a = r->box.min;
    tl_vec3 b = r->box.max;
    tl_sample_place(mesh, center, 0);
    if (r->kind == ROOM_PILLARS) {
        for (unsigned i = 0; i < 4; ++i) {
            tl_vec3 base = { (i & 1 ? 0.5f : -0.5f) * b.x, a.y, (i & 2 ? 0.5f : -0.5f) * b.z };
            tl_sample_pillar(mesh, base, 0.45f, b.y - a.y, 2);
        }
    } else if (r->kind == ROOM_GALLERY) {
        float top = a.y + 3.25f;
        tl_sample_place(mesh, center, 3); // climbs towards +z
        tl_aabb box = tl_sample_bounds(b.z - 2.6f - 4.0f, a.y, -1.25f, b.z - 2.6f, top, 1.25f);
        tl_sample_stairs(mesh, box, 16);
    }
}

void tl_sample_build_dungeon(const tl_sample_plan *plan, tl_sample_mesh *mesh)
{
    for (uint32_t row = 0; row < plan->rows; ++row) {
        for (uint32_t column = 0; column < plan->columns; ++column) {
            tl_vec3 center = { ((float)column + 0.5f) * CELL, 0.0f, ((float)row + 0.5f) * CELL };
            room here = room_of(plan, column, row);
            tl_sample_carving rock = { 0 };
            rock.rock_outside = true;
            tl_sample_carving_cut(&rock, here.box.min.x, here.box.min.y, here.box.min.z, here.box.max.x, here.box.max.y,
                                  here.box.max.z);
            furnish_rock(&rock, &here);
            for (unsigned side = 0; side < 4; ++side) {
                room there;
                if (corridor_to(plan, column, row, side, &there)) {
                    cut_corridor(&rock, &here, &there, side);
                    add_climb(&here, &there, side, center, mesh);
                }
            }
            tl_aabb window = tl_sample_bounds(-0.5f * CELL, 0, -0.5f * CELL, 0.5f * CELL, 0, 0.5f * CELL);
            tl_sample_place(mesh, center, 0);
            tl_sample_carving_finish(&rock, &window, mesh);
            furnish_mesh(&here, center, mesh);
        }
    }
}

// Along the walls, away from the middle of a side where the doors are.
tl_vec3 tl_sample_dungeon_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random)
{
    uint32_t column = tl_sample_random_below(random, plan->columns);
    uint32_t row = tl_sample_random_below(random, plan->rows);
    room r = room_of(plan, column, row);
    float x = tl_sample_random_range(random, HALF_DOOR + 0.4f + radius, r.box.max.x - radius);
    float z = r.box.max.z - radius - tl_sample_random_range(random, 0.0f, 0.3f);
    uint32_t corner = tl_sample_random_below(random, 4);
    tl_vec3 local = { corner & 1 ? x : -x, r.box.min.y, corner & 2 ? z : -z };
    return tl_add(tl_vec3_make(((float)column + 0.5f) * CELL, 0.0f, ((float)row + 0.5f) * CELL), local);
}
