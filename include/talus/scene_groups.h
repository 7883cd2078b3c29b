// SPDX-License-Identifier: MIT
//
// Groups of instances inside groups (prefabs): a town of houses of rooms of chairs, each described once, laid out as
// the flat instances that a scene takes.
//
//   tl_scene_group [count] --tl_scene_groups_expand--> tl_scene_expansion --its instances--> tl_scene_bake, queries
//   a house is moved --tl_scene_groups_place--^
//
// Every query of a scene then answers as ever, and pays nothing for the nesting: a ray is brought into an instance's
// space once, however deep it lies, and rounded once. What is shared are the soups and shapes; an instance takes 64
// bytes here and 256 in the scene, as one that was never in a group.
//
// A copy is a group where it stands in the world. The instances of a copy, with those of all copies inside it, are
// neighbours in the array: so a filter's [first_ignored, first_ignored + ignored_count) leaves out a vehicle with
// all that is on board, and moving it touches one range.
//
// A point p of a group is R (s p) + position in its parent, with one factor s for all axes: factors that differ would
// shear what is turned inside. An instance in a group may have any scale of its own.

#ifndef TALUS_SCENE_GROUPS_H
#define TALUS_SCENE_GROUPS_H

#include <talus/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A group inside another group.
typedef struct tl_scene_placement {
    uint32_t group;    ///< its index
    tl_transform pose; ///< from the group's space to that of the group it is placed in; a zero quaternion: not rotated
    float scale;       ///< of all axes, mirrored where negative; 0: 1. Its size is within TL_MAX_SCALE and its inverse
} tl_scene_placement;

/// Instances, and other groups.
typedef struct tl_scene_group {
    const tl_scene_instance *instances; ///< [instance_count], in the group's space; NULL where there are none
    uint32_t instance_count;
    const tl_scene_placement *placements; ///< [placement_count]; NULL where there are none
    uint32_t placement_count;
} tl_scene_group;

#define TL_NO_COPY UINT32_MAX

/// A group where it stands in the world. Copies follow one another as one goes into them: a copy's own instances, then
/// the copies inside it, in the order of its group's placements.
typedef struct tl_scene_copy {
    tl_transform pose; ///< from the group's space to the world
    float scale;
    uint32_t group;
    uint32_t parent;         ///< the copy that it is in, which is earlier; TL_NO_COPY: none, it is the first
    uint32_t placement;      ///< which of the parent's group
    uint32_t first_instance; ///< its own instances come first, in the order of its group
    uint32_t instance_count; ///< with those of the copies inside
    uint32_t copy_count;     ///< itself, and the copies inside, which follow it
} tl_scene_copy;

/// What groups come to. Free with tl_scene_expansion_free.
typedef struct tl_scene_expansion {
    tl_scene_instance *instances; ///< [instance_count]: what tl_scene_bake takes
    uint32_t instance_count;
    tl_scene_copy *copies; ///< [copy_count]
    uint32_t copy_count;
    tl_allocator allocator; ///< private: what frees it
} tl_scene_expansion;

/// Lays out group `root`, at the world's origin, with all groups inside it.
///
/// A copy's pose is its parent's with its own after it, an instance's its copy's with its own after it, each computed
/// in double and rounded to float once. Where a parent stands at the identity, without a scale, what is inside keeps
/// its bits. Masks, soups and shapes are taken as they are. O(copies + instances); groups that are not inside the root
/// cost nothing. `host` and `report_out` may be NULL; of the host only the allocator is used. Errors, with the group in
/// `report_out`: TL_ERR_INDEX (a placement's group, or the root, that is not there), TL_ERR_NOT_FINITE (a placement),
/// TL_ERR_RANGE (its scale), TL_ERR_ARGUMENT (a group that is inside itself; arrays that are NULL), TL_ERR_LIMIT (more
/// than TL_MAX_SCENE_INSTANCES instances, or as many copies), TL_ERR_MEMORY. The expansion is zeroed then. Instances
/// are not looked at: tl_scene_bake refuses what it cannot take, by their index.
TL_API tl_result tl_scene_groups_expand(const tl_scene_group *groups, uint32_t group_count, uint32_t root,
                                        const tl_host *host, tl_scene_expansion *expansion_out, tl_report *report_out);

/// Moves a copy to where `at` says, in the world, and all that is inside it with it; at->group is not looked at.
///
/// Takes the instances and placements of the copy's group, and of the groups inside, as they are now: other poses,
/// scales, masks, soups or shapes. O(what is inside). Then refit the scene (tl_scene_refit skips what did not move).
/// No memory. `report_out` may be NULL. Errors as of tl_scene_groups_expand; TL_ERR_INDEX (no such copy),
/// TL_ERR_ARGUMENT (a group that holds more, fewer or other groups, or another number of instances than when it was
/// expanded). The expansion is unchanged then.
TL_API tl_result tl_scene_groups_place(const tl_scene_group *groups, uint32_t group_count,
                                       tl_scene_expansion *expansion, uint32_t copy, const tl_scene_placement *at,
                                       tl_report *report_out);

/// The innermost copy that an instance is in, by its index in the expansion: whose hit it was. O(log copies).
/// TL_NO_COPY: the index is not one of the expansion's.
TL_API uint32_t tl_scene_copy_of(const tl_scene_expansion *expansion, uint32_t instance);

/// Gives the memory back to the host's allocator and zeroes the struct. NULL or zeroed: nothing happens.
TL_API void tl_scene_expansion_free(tl_scene_expansion *expansion);

#ifdef __cplusplus
}
#endif

#endif
