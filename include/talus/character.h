// SPDX-License-Identifier: MIT
//
// Moving a character: an upright capsule that walks over the triangles of a soup, or over a scene whose parts move. It
// slides along walls, follows the ground up and down steps and slopes, stops at what is too steep, rides on platforms,
// and gets out of what it was put into.
//
//   tl_character_def --tl_character_mover_create--> tl_character_mover (scratch, one a thread)
//   tl_character (position, velocity, ground) --tl_character_move, once a step--> tl_character, tl_character_report
//
// What a move promises:
//
// - The capsule keeps a gap to every triangle. Motion is swept, over any length, by exact distances in double: it ends
//   before the gap is half gone, so nothing is penetrated and nothing tunnelled through, however fast or thin. Only
//   what moves into the character (a door, a lift), or a start inside of something, makes an overlap; the next move
//   pushes it out.
// - A flat floor is flat, whatever triangles it is made of: a contact at an edge counts only where the level has no
//   nearer point beside it, so inner edges neither stop nor lift it.
// - Motion that the level does not allow is replaced by the nearest motion that all contacts allow together, not one
//   after the other. So a character that is pushed into a corner comes to rest there; it does not jitter.
// - On the ground it keeps its horizontal speed over slopes and steps.
// - The state is a plain struct without pointers or padding: copy it, store it, compare its bytes. The same state,
// level
//   and step give the same bits on every machine.
//
// It has no mass and no forces: gravity, jumps and acceleration are the game's, as velocities. y is up. A soup has no
// inside: a character that is placed within a solid, and touches nothing, walks on in there.

#ifndef TALUS_CHARACTER_H
#define TALUS_CHARACTER_H

#include <talus/base.h>
#include <talus/scene.h>
#include <talus/soup.h>
#include <talus/vec.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The shape of characters and what they can do. Begin with tl_default_character_def().
typedef struct tl_character_def {
    float radius;      ///< metres, > 0. Default 0.3
    float height;      ///< metres, >= 2 radius; from the feet to the top. Default 1.8
    float step_height; ///< metres, >= 0: the highest step that it climbs, and follows down. Default 0.4
    float max_slope;   ///< degrees, [0, 85]: steeper ground is a wall when it walks, and slides off. Default 45
    /// Metres, > 0, at most radius / 4: kept free around the capsule. Default 0.002. Where coordinates are larger than
    /// 2^20 gaps (2 km by default) it is a 2^20th of them, since positions are floats.
    float gap;
    /// Triangles and shapes near a character at one time, >= 16; each takes 340 bytes of scratch. Default 1024
    uint32_t max_triangles;
    const tl_allocator *allocator; ///< NULL: malloc
    uint32_t cookie;               ///< TL_DEF_COOKIE, set by tl_default_character_def
} tl_character_def;

TL_API tl_character_def tl_default_character_def(void);

/// The scratch of moves, and the def. It moves any number of characters of that def, one at a time.
typedef struct tl_character_mover tl_character_mover;

/// Makes a mover; nothing is allocated later. NULL `def`: the defaults. TL_ERR_ARGUMENT with the field in `report`
/// (may be NULL), TL_ERR_MEMORY. Give it back with tl_character_mover_destroy.
TL_API tl_result tl_character_mover_create(const tl_character_def *def, tl_character_mover **mover_out,
                                           tl_report *report);

/// NULL: nothing happens.
TL_API void tl_character_mover_destroy(tl_character_mover *mover);

/// A character's state. Zero it and set the position. No pointers, no padding.
typedef struct tl_character {
    tl_vec3 position;         ///< metres, of its feet: the lowest point of the capsule
    tl_vec3 velocity;         ///< metres a second: the part of the last wish that the contacts at its end allow;
                              ///< and what its ground gave it, when it left that
    tl_vec3 ground_normal;    ///< unit, of the face that it stands on; zero in the air
    tl_vec3 ground_point;     ///< where it stands
    uint32_t grounded;        ///< 1: it stands on something that can be walked on, 0: in the air
    uint32_t ground_triangle; ///< index in its soup; TL_NO_TRIANGLE: a shape
    uint32_t ground_instance; ///< in the scene; 0 in a soup
    tl_transform ground_pose; ///< of that instance, at the end of the last move
} tl_character;

/// What characters move in: a soup, or a scene with its instances; set one of the two. Poses count as of the scene's
/// last bake or refit, so refit it after instances have moved.
typedef struct tl_character_level {
    const tl_soup *soup;
    const tl_ray_filter *soup_filter; ///< what is ignored in `soup`; may be NULL
    const tl_scene *scene;
    const tl_scene_instance *instances;
    const tl_scene_filter *scene_filter; ///< what is ignored in `scene`; may be NULL
} tl_character_level;

/// The longest motion of one move, metres.
#define TL_MAX_CHARACTER_MOTION 1000.0f

/// What a character is to do in one step of the game.
typedef struct tl_character_step {
    /// Metres a second. On the ground it is relative to the ground, x and z alone count, and the ground is followed.
    /// With leave_ground y counts too, still relative to the ground, so that a jump from a lift is a jump. In the air
    /// it is the velocity in the world.
    tl_vec3 velocity;
    float seconds;     ///< >= 0
    bool leave_ground; ///< it jumps: the ground does not hold it in this step
} tl_character_step;

/// What a character meets.
typedef enum tl_character_surface {
    TL_CHARACTER_GROUND, ///< can be walked on
    TL_CHARACTER_SLOPE,  ///< faces up, too steep
    TL_CHARACTER_WALL,   ///< upright
    TL_CHARACTER_CEILING ///< faces down
} tl_character_surface;

/// Something that a character touched or ran into.
typedef struct tl_character_hit {
    tl_vec3 point;
    tl_vec3 normal; ///< unit, towards the character
    uint32_t instance;
    uint32_t triangle; ///< TL_NO_TRIANGLE: a shape
    uint16_t material;
    tl_character_surface surface;
} tl_character_hit;

/// The first so many hits of a move are kept.
#define TL_MAX_CHARACTER_HITS 8u

/// What a move did.
typedef struct tl_character_report {
    tl_report base;
    bool landed;             ///< it came from the air to the ground
    bool left_ground;        ///< the other way: a jump, a ledge, a slope too steep
    bool blocked;            ///< a wall or steep slope took a part of the motion
    bool hit_ceiling;        ///< something above stopped it
    bool stuck;              ///< it overlaps the level at its end, and no small motion parts them
    float stepped_up;        ///< metres climbed over steps
    float pushed;            ///< metres that it was pushed out of what it overlapped at its start
    tl_vec3 carried;         ///< metres, by the platform that it stands on
    tl_quat turned;          ///< that platform's rotation since the last move: turn the character's heading by it
    tl_vec3 ground_velocity; ///< metres a second, of the platform there
    uint32_t sweeps;         ///< sweeps of the capsule that the move took
    uint32_t hit_count;      ///< things met, each triangle once; of more than TL_MAX_CHARACTER_HITS the first are kept
    tl_character_hit hits[TL_MAX_CHARACTER_HITS];
} tl_character_report;

/// Moves a character for one step.
///
/// In this order: it is carried by the instance that it stands on, to where that has moved; it is pushed out of what it
/// overlaps; it moves by velocity * seconds, sliding, and on the ground follows steps and slopes. `character` is read
/// and written; after an error it is unchanged. `report_out` may be NULL. No allocation; 6 KB of stack beside that of a
/// soup's query. Steps that stay within a radius cost a walk of the tree and some tens of distances; on the ground a
/// longer motion is made in parts of that length.
///
/// A step up counts when its end is walkable ground no more than step_height above its begin and it leads farther than
/// sliding does. Ground is walkable when its normal is within max_slope; at the edge of a step its face counts.
/// What is too steep to stand on, as a rock, a beam or a sheet on its edge, is climbed where such ground lies a radius
/// or half of one ahead. In the air, what pushes at ground that is too steep is taken from the velocity: it slides
/// down.
///
/// TL_ERR_ARGUMENT, with the field in the report: NULLs; "level" has both a soup and a scene, or neither; "seconds";
/// "max_triangles" is TL_ERR_LIMIT: more of them touch the box of the capsule, its step height and a quarter of its
/// radius around. TL_ERR_NOT_FINITE: "velocity", "position". TL_ERR_RANGE: "velocity" leads beyond
/// TL_MAX_CHARACTER_MOTION, or "position" lies beyond 2^18 radii (78 km by default), where floats are too coarse.
TL_API tl_result tl_character_move(tl_character_mover *mover, const tl_character_level *level,
                                   const tl_character_step *step, tl_character *character,
                                   tl_character_report *report_out);

#ifdef __cplusplus
}
#endif

#endif
