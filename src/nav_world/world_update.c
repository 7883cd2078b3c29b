// SPDX-License-Identifier: MIT
//
// An update: which places are wanted, which come in, which make room, and where the frame lies.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_world/world.h"

#include <math.h>
#include <string.h>

// ---------------------------------------------------------------------------------------------------------
// What is wanted.

// Metres in the plane from a point of the file to the box of a place.
static double place_distance(const tl_nav_world_place *place, const double at[3])
{
    const double dx = tl_nav_world_gap(at[0], (double)place->bounds.min.x, (double)place->bounds.max.x);
    const double dz = tl_nav_world_gap(at[2], (double)place->bounds.min.z, (double)place->bounds.max.z);
    return sqrt(dx * dx + dz * dz);
}

typedef struct want_walk {
    tl_nav_world *world;
    const tl_nav_world_interest *interest;
} want_walk;

static bool want_place(const tl_nav_world *world, uint32_t index, void *user)
{
    const want_walk *walk = user;
    tl_nav_world_place *place = &walk->world->places[index];
    const double distance = place_distance(place, walk->interest->point);
    (void)world;
    if (distance <= walk->interest->radius) {
        if (place->distance == (double)INFINITY) {
            walk->world->wanted[walk->world->wanted_count++] = index;
        }
        place->distance = distance < place->distance ? distance : place->distance;
    }
    return true;
}

// Distances are not negative, and bits of such doubles stand in the order of their values.
static uint64_t distance_key(double distance)
{
    uint64_t bits;
    memcpy(&bits, &distance, sizeof bits);
    return bits;
}

static void find_wanted(tl_nav_world *world)
{
    for (uint32_t i = 0; i < world->wanted_count; i++) {
        world->places[world->wanted[i]].distance = (double)INFINITY;
    }
    world->wanted_count = 0;
    for (uint32_t i = 0; i < world->interest_count; i++) {
        const tl_nav_world_interest *interest = &world->interests[i];
        const double low[2] = { interest->point[0] - interest->radius, interest->point[2] - interest->radius };
        const double high[2] = { interest->point[0] + interest->radius, interest->point[2] + interest->radius };
        want_walk walk = { world, interest };
        tl_nav_world_visit_box(world, low, high, want_place, &walk);
    }
    for (uint32_t i = 0; i < world->wanted_count; i++) {
        const uint32_t place = world->wanted[i];
        const tl_sort_item item = { distance_key(world->places[place].distance), place, 0 };
        world->sorted[i] = item;
        if (world->places[place].stage == TL_NAV_PLACE_FAILED) {
            world->places[place].stage = TL_NAV_PLACE_ABSENT; // once more
        }
    }
    tl_radix_sort(world->sorted, world->sorted + world->tile_capacity, world->wanted_count);
    for (uint32_t i = 0; i < world->wanted_count; i++) {
        world->wanted[i] = world->sorted[i].value;
    }
    world->failed = 0;
    world->is_full = false;
}

// Interests move by less than a quarter of a tile without anything being looked at.
static bool moved_little(const tl_nav_world *world, const tl_nav_world_interest *interests, uint32_t count)
{
    const double step = 0.25 * (double)world->tile_size * (double)world->cell_size;
    bool little = count == world->interest_count && world->frames > 0;
    for (uint32_t i = 0; little && i < count; i++) {
        double at[3];
        tl_nav_world_to_file(world, interests[i].point, at);
        const double dx = at[0] - world->interests[i].point[0], dz = at[2] - world->interests[i].point[2];
        little = interests[i].radius == world->interests[i].radius && dx * dx + dz * dz <= step * step;
    }
    return little;
}

static tl_result note_interests(tl_nav_world *world, const tl_nav_world_interest *interests, uint32_t count)
{
    if (moved_little(world, interests, count)) {
        return TL_OK;
    }
    if (count != world->interest_count || world->interests == NULL) {
        tl_nav_world_interest *copy = tl_allocate_array(&world->allocator, count, sizeof *copy);
        if (copy == NULL) {
            return TL_ERR_MEMORY;
        }
        tl_release_array(&world->allocator, world->interests, world->interest_count, sizeof *copy);
        world->interests = copy;
        world->interest_count = count;
    }
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_world_to_file(world, interests[i].point, world->interests[i].point);
        world->interests[i].radius = interests[i].radius;
    }
    find_wanted(world);
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// In and out.

// The navmesh borrows the tiles: they are taken out of it before they are freed.
static void remove_place(tl_nav_world *world, const tl_nav_world_place *place)
{
    (void)tl_navmesh_remove_tile(world->navmesh, place->x - world->frame_x, place->z - world->frame_z);
}

static void leave_memory(tl_nav_world *world, uint32_t at)
{
    const uint32_t index = world->present[at];
    tl_nav_world_place *place = &world->places[index];
    remove_place(world, place);
    tl_nav_world_drop_blobs(world, index);
    place->stage = TL_NAV_PLACE_ABSENT;
    world->present_file_bytes -= place->file_bytes;
    world->present[at] = world->present[--world->present_count];
}

// The place in memory that is farthest from all interests, in `present`; one that nobody wants is farther than any.
static uint32_t farthest_present(const tl_nav_world *world)
{
    uint32_t farthest = 0;
    for (uint32_t i = 1; i < world->present_count; i++) {
        if (world->places[world->present[i]].distance > world->places[world->present[farthest]].distance) {
            farthest = i;
        }
    }
    return farthest;
}

// Makes room for a place by one that is farther away by a tile's side or more, so that two do not push each other out.
static bool make_room(tl_nav_world *world, uint32_t for_place)
{
    const double side = (double)world->tile_size * (double)world->cell_size;
    if (world->present_count == 0) {
        return false;
    }
    const uint32_t at = farthest_present(world);
    if (!(world->places[world->present[at]].distance > world->places[for_place].distance + side)) {
        return false;
    }
    leave_memory(world, at);
    return true;
}

static uint32_t find_slot_of(const tl_nav_world *world, const tl_nav_tile *tile)
{
    uint32_t slot = 0;
    while (tl_navmesh_slot_tile(world->navmesh, slot) != tile) {
        slot++;
    }
    return slot;
}

// Adds the tiles of a place, which are in the frame of now. On failure none is in.
static tl_result add_world_place(tl_nav_world *world, uint32_t index)
{
    tl_nav_world_place *place = &world->places[index];
    for (uint32_t i = 0; i < place->tile_count; i++) {
        tl_nav_world_tile *tile = &world->tiles[place->first_tile + i];
        const tl_result result = tl_navmesh_add_tile(world->navmesh, tile->blob, TL_NAV_TILE_BORROWED);
        if (result != TL_OK) {
            remove_place(world, place);
            return result;
        }
        tile->slot = find_slot_of(world, tile->blob);
    }
    place->stage = TL_NAV_PLACE_LOADED;
    world->present[world->present_count++] = index;
    world->present_file_bytes += place->file_bytes;
    return TL_OK;
}

static void move_place(tl_nav_world *world, uint32_t index, int32_t step_x, int32_t step_z)
{
    const tl_nav_world_place *place = &world->places[index];
    for (uint32_t i = 0; i < place->tile_count; i++) {
        tl_nav_world_move_tile(world->tiles[place->first_tile + i].blob, step_x, step_z);
    }
}

// Takes in a place that was read. Where even farther places gone leave too little room it is given up.
static tl_result take_in(tl_nav_world *world, uint32_t index, uint32_t *changes)
{
    tl_nav_world_place *place = &world->places[index];
    move_place(world, index, world->frame_x, world->frame_z);
    tl_result result = TL_OK;
    bool no_room = false;
    do {
        world->purse.parent_failed = false;
        result = add_world_place(world, index);
        no_room = result == TL_ERR_MEMORY && !world->purse.parent_failed;
        (*changes)++;
    } while (no_room && make_room(world, index));
    world->ready--;
    if (result != TL_OK) {
        tl_nav_world_drop_blobs(world, index);
        place->stage = TL_NAV_PLACE_ABSENT;
        world->is_full = world->is_full || no_room;
    }
    return no_room ? TL_OK : result;
}

// Takes in places that were read, the nearest first, then makes room for the next one that is wanted.
static tl_result exchange_places(tl_nav_world *world, uint32_t max_changes, uint32_t *changes)
{
    for (uint32_t i = 0; i < world->wanted_count && world->ready > 0 && *changes < max_changes; i++) {
        if (world->places[world->wanted[i]].stage == TL_NAV_PLACE_READY) {
            TL_TRY(take_in(world, world->wanted[i], changes));
        }
    }
    // Those that nobody wants any more.
    for (uint32_t i = 0; i < world->place_count && world->ready > 0 && *changes < max_changes; i++) {
        if (world->places[i].stage == TL_NAV_PLACE_READY) {
            TL_TRY(take_in(world, i, changes));
        }
    }
    const uint32_t next = tl_nav_world_next_wanted(world);
    while (next != TL_NAV_WORLD_NO_PLACE && *changes < max_changes && !tl_nav_world_has_room(world, next) &&
           make_room(world, next)) {
        (*changes)++;
    }
    return TL_OK;
}

// Of the places in memory those beside one that is not: behind their edges the world goes on.
static void find_open(tl_nav_world *world)
{
    world->open_count = 0;
    for (uint32_t i = 0; i < world->present_count; i++) {
        const tl_nav_world_place *place = &world->places[world->present[i]];
        bool is_open = false;
        for (int side = 0; side < 4; side++) {
            const uint32_t beside = place->neighbour[side];
            is_open = is_open || (beside != TL_NAV_WORLD_NO_PLACE && !tl_nav_world_is_present(world, beside));
        }
        if (is_open) {
            world->open[world->open_count++] = world->present[i];
        }
    }
}

// ---------------------------------------------------------------------------------------------------------
// The frame.

static int32_t frame_place(const tl_nav_world *world, double at, float origin, uint32_t tiles)
{
    if (world->tile_size == 0 || tiles == 0) {
        return 0; // one tile alone: its own corner is the frame's origin
    }
    const double index = floor((at - (double)origin) / ((double)world->tile_size * (double)world->cell_size));
    return (int32_t)(index < 0.0 ? 0.0 : index >= (double)tiles ? (double)(tiles - 1) : index);
}

// Moves all tiles in memory to the frame at another place, the nearest to the interests first: should the navmesh have
// no room for some of them afterwards, those are gone.
static void move_frame(tl_nav_world *world, int32_t x, int32_t z)
{
    const uint32_t count = world->present_count;
    const int32_t step_x = x - world->frame_x, step_z = z - world->frame_z;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t place = world->present[i];
        const tl_sort_item item = { distance_key(world->places[place].distance), place, 0 };
        world->sorted[i] = item;
        remove_place(world, &world->places[place]);
    }
    tl_radix_sort(world->sorted, world->sorted + world->tile_capacity, count);
    world->frame_x = x;
    world->frame_z = z;
    world->frames++;
    world->present_count = 0;
    world->present_file_bytes = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t place = world->sorted[i].value;
        move_place(world, place, step_x, step_z);
        if (add_world_place(world, place) != TL_OK) {
            tl_nav_world_drop_blobs(world, place);
            world->places[place].stage = TL_NAV_PLACE_ABSENT;
        }
    }
}

// Whether the first interest is farther from the frame's origin than the def allows.
static bool has_left_frame(const tl_nav_world *world)
{
    double origin[2];
    tl_nav_world_frame_origin(world, origin);
    const double dx = world->interests[0].point[0] - origin[0], dz = world->interests[0].point[2] - origin[1];
    return sqrt(dx * dx + dz * dz) > world->frame_reach;
}

static bool settle_frame(tl_nav_world *world)
{
    if (world->interest_count == 0 || (world->frames > 0 && !has_left_frame(world))) {
        return false;
    }
    const int32_t x = frame_place(world, world->interests[0].point[0], world->lattice_origin.x, world->tiles_x);
    const int32_t z = frame_place(world, world->interests[0].point[2], world->lattice_origin.z, world->tiles_z);
    if (world->frames > 0 && x == world->frame_x && z == world->frame_z) {
        return false; // the interest lies outside the grid: no place is nearer to it
    }
    move_frame(world, x, z);
    return true;
}

static tl_result check_interests(const tl_nav_world_interest *interests, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_world_interest *interest = &interests[i];
        if (!tl_nav_world_is_finite(interest->point) || !isfinite(interest->radius)) {
            return TL_ERR_NOT_FINITE;
        }
        if (interest->radius < 0.0) {
            return TL_ERR_ARGUMENT;
        }
    }
    return TL_OK;
}

tl_result tl_nav_world_update(tl_nav_world *world, const tl_nav_world_interest *interests, uint32_t count,
                              uint32_t max_changes)
{
    if (world == NULL || (interests == NULL && count > 0)) {
        return TL_ERR_ARGUMENT;
    }
    TL_TRY(check_interests(interests, count));
    TL_TRY(note_interests(world, interests, count));
    const bool has_moved = settle_frame(world);
    uint32_t changes = 0;
    const tl_result result = exchange_places(world, max_changes, &changes);
    if (!has_moved && changes == 0) {
        return result != TL_OK ? result : TL_NOT_FOUND;
    }
    find_open(world);
    return result;
}

tl_result tl_nav_world_get_state(const tl_nav_world *world, tl_nav_world_state *state_out)
{
    if (state_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(state_out, 0, sizeof *state_out);
    if (world == NULL) {
        return TL_ERR_ARGUMENT;
    }
    for (uint32_t i = 0; i < world->wanted_count; i++) {
        state_out->missing += world->places[world->wanted[i]].stage == TL_NAV_PLACE_ABSENT;
    }
    state_out->places = world->place_count;
    state_out->loaded = world->present_count;
    state_out->loading = world->loading;
    state_out->ready = world->ready;
    state_out->failed = world->failed;
    state_out->frames = world->frames;
    state_out->bytes = world->purse.taken;
    state_out->peak_bytes = world->purse.peak;
    state_out->index_bytes = sizeof *world + world->index_size +
                             (uint64_t)world->tile_capacity * (sizeof *world->tiles + sizeof *world->places +
                                                               3 * sizeof *world->wanted + 2 * sizeof *world->sorted);
    state_out->read_bytes = world->read_bytes;
    return TL_OK;
}
