// SPDX-License-Identifier: MIT
//
// The mover's scratch, and the parts of a move, from the ground up: what is near, contacts, sweeps, slides, steps.

#ifndef TALUS_SRC_CHARACTER_MOVER_H
#define TALUS_SRC_CHARACTER_MOVER_H

#include "character/allowed_motion.h"
#include "character/capsule_gap.h"

#include <talus/character.h>

/// Where the capsule is near something: at most the gap and a quarter of it away.
typedef struct tl_mover_contact {
    tl_vec3d normal, point;
    double gap; ///< metres between capsule and item; negative: overlap
    uint32_t item;
    bool face;
    bool inner;    ///< at an inner edge: of no account
    bool supports; ///< can be stood on
} tl_mover_contact;

/// The boxes of all items in float, for a look at all of them at once.
typedef struct tl_mover_boxes {
    float *low_x, *low_y, *low_z, *high_x, *high_y, *high_z;
    float *away_sq; ///< 4 m2: of tl_mover_measure_boxes
} tl_mover_boxes;

/// Loops run over whole lanes: each array has room for them.
enum { TL_MOVER_BOX_ARRAYS = 7, TL_MOVER_BOX_LANES = 8 };

static inline uint64_t tl_mover_box_room(uint32_t max_triangles)
{
    return ((uint64_t)max_triangles + TL_MOVER_BOX_LANES - 1) / TL_MOVER_BOX_LANES * TL_MOVER_BOX_LANES;
}

struct tl_character_mover {
    tl_character_def def;
    tl_allocator allocator;
    double radius, core_length, step_height;
    double cos_slope, tan_slope;
    // Of this move.
    const tl_character_level *level;
    tl_character_report *report; ///< never NULL
    double gap;
    uint32_t ignored_instance;    ///< TL_NO_INSTANCE: none
    tl_vec3d feet_low, feet_high; ///< where the feet may go: around it all items are known
    double ground_height;         ///< of the point that it stands on: steps down are measured from there
    bool climbing;                ///< it is on the steep side of a step
    bool crowded;                 ///< more was near than fits: the move fails
    bool contacts_known;          ///< the contacts are those at contacts_at
    tl_vec3d contacts_at;
    double least_gap; ///< there
    uint32_t item_count, contact_count;
    tl_mover_item *items;       ///< [def.max_triangles]
    bool has_boxes;             ///< the items are many, and their boxes are filled in
    tl_mover_boxes boxes;       ///< of the items
    float *box_numbers;         ///< [TL_MOVER_BOX_ARRAYS * tl_mover_box_room()]: theirs
    tl_mover_contact *contacts; ///< [def.max_triangles]: of the last tl_mover_find_contacts
};

static inline tl_mover_core tl_mover_core_at(const tl_character_mover *m, tl_vec3d feet)
{
    tl_mover_core core = { feet, m->core_length, m->radius };
    core.low.y += m->radius;
    return core;
}

/// Collects what the capsule may come near while its feet stay between two corners; false: more than max_triangles.
bool tl_mover_collect(tl_character_mover *m, tl_vec3d low, tl_vec3d high);

/// Where the items are many: how far their boxes are from a box at least, in boxes.away_sq. What lies within `reach` of
/// it has no more than the number returned.
float tl_mover_measure_boxes(tl_character_mover *m, tl_vec3d low, tl_vec3d high, double reach);

/// Whether an item's box was measured, and is farther than that.
static inline bool tl_mover_is_box_away(const tl_character_mover *m, uint32_t item, float most_sq)
{
    return m->has_boxes && m->boxes.away_sq[item] > most_sq;
}

/// Finds the contacts at a place, unless they are known, and returns the smallest gap, also of those that do not count;
/// INFINITY: none.
double tl_mover_find_contacts(tl_character_mover *m, tl_vec3d feet);

/// The most level of the contacts that can be stood on, or NULL. Edges above the height `highest` do not count.
const tl_mover_contact *tl_mover_support(const tl_character_mover *m, double highest);

/// The same of all contacts that face up, for who climbs.
const tl_mover_contact *tl_mover_steep_support(const tl_character_mover *m);

typedef struct tl_mover_sweep {
    double t; ///< [0, 1]
    bool hit;
    uint32_t item;
    tl_vec3d normal, point;
} tl_mover_sweep;

/// How far the capsule may move before half of the gap is gone, and within the collected box; there it ends without a
/// hit. What it is nearer to already it may not approach.
tl_mover_sweep tl_mover_cast(tl_character_mover *m, tl_vec3d feet, tl_vec3d motion);

/// A slide: where it begins, what is wished, and where it ended.
typedef struct tl_mover_slide {
    tl_vec3d feet; ///< moved
    tl_vec3d wish;
    tl_vec3d rest;  ///< of the wish, where the slide came to the end of the collected box
    bool walking;   ///< heights are cheap, and ground that is not walkable is a wall
    bool quiet;     ///< a trial: nothing is reported
    double highest; ///< when walking: edges above this height are walls
    bool blocked;   ///< a wall or a steep slope took a part of it
} tl_mover_slide;

/// The allowed motions at the contacts that were found last, as planes; their number.
uint32_t tl_mover_planes(const tl_character_mover *m, const tl_mover_slide *slide, tl_mover_plane *planes);

/// Who falls against steep ground slides down it: what of the wish pushes at it is taken from it. The nearest motion
/// that is allowed would hold it there for as long as it pushes.
void tl_mover_fall_aside(const tl_character_mover *m, tl_vec3d *wish);

void tl_mover_slide_along(tl_character_mover *m, tl_mover_slide *slide);

/// Moves a capsule that overlaps, or nearly, out of what it overlaps.
void tl_mover_push_out(tl_character_mover *m, tl_vec3d *feet);

/// Walks by a horizontal wish of at most a radius, over steps, and down to the ground. False: no ground there.
bool tl_mover_walk(tl_character_mover *m, tl_vec3d *feet, tl_vec3d wish);

#endif
