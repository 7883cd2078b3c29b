// SPDX-License-Identifier: MIT
//
// A scene that changes while it is queried: readers acquire the newest version and query it for as long as they like; a
// writer gives the instances as they are now, and publishes them as the next version.
//
//   readers  any number of threads. tl_scene_versions_acquire and tl_scene_versions_release are one atomic addition
//            each: no lock, no loop, no wait, whatever the writer or other readers do. What a reader holds is a scene
//            and its instances, which do not change.
//   writer   one thread at a time. tl_scene_versions_publish never waits for readers either.
//
// Soups and shapes are the caller's, and shared by all versions that name them. One that is not used any more is freed
// once tl_scene_versions_reclaim says that the last version which had it is gone; so a level's soup is exchanged for
// another one while rays are cast.
//
// Memory is taken and freed by the writer alone. A version that nobody holds becomes the next one: it is refitted,
// which costs next to nothing for instances that have not moved since. Two are kept for that.

#ifndef TALUS_SCENE_VERSIONS_H
#define TALUS_SCENE_VERSIONS_H

#include <talus/scene.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_scene_versions tl_scene_versions;

#define TL_MAX_SCENE_VERSIONS 1024u ///< that exist at one time: held by readers, newest, and spare

/// A scene and its instances: what every query of scene.h takes.
typedef struct tl_scene_version {
    const tl_scene *scene;
    const tl_scene_instance *instances; ///< [count], copied when it was published
    uint32_t count;
    uint64_t number; ///< ascending by 1 from 1 on
} tl_scene_version;

/// Creates a scene in versions, and publishes the first one: `count` instances, of which there may be none.
/// `allocator` is copied; NULL: malloc. Errors as of tl_scene_bake: `*versions_out` is NULL.
TL_API tl_result tl_scene_versions_create(const tl_scene_instance *instances, uint32_t count,
                                          const tl_allocator *allocator, tl_scene_versions **versions_out,
                                          tl_report *report_out);
/// Frees all versions. No reader may hold one any more. NULL: nothing happens.
TL_API void tl_scene_versions_destroy(tl_scene_versions *versions);

/// The newest version. Any thread; it is the reader's until tl_scene_versions_release, and stays as it is meanwhile.
/// May be acquired more than once, and released by another thread. Not NULL; `versions` must not be.
TL_API const tl_scene_version *tl_scene_versions_acquire(tl_scene_versions *versions);
/// Gives back a version, once for each time it was acquired. NULL version: nothing happens.
TL_API void tl_scene_versions_release(tl_scene_versions *versions, const tl_scene_version *version);

/// Makes the instances as they are now the newest version, whatever has changed: poses, masks, soups, shapes, how many
/// there are. A spare version is refitted, and baked anew where its tree has become half as costly again, or the number
/// is another one. Who acquires from now on gets it. Errors as of tl_scene_bake, and TL_ERR_LIMIT
/// (TL_MAX_SCENE_VERSIONS: readers do not release): then the newest version is the one before. O(n); O(n log n) where
/// it bakes.
TL_API tl_result tl_scene_versions_publish(tl_scene_versions *versions, const tl_scene_instance *instances,
                                           uint32_t count, tl_report *report_out);

/// What there is of versions.
typedef struct tl_scene_versions_state {
    uint32_t version_count;  ///< the newest and older ones that are held
    uint64_t newest, oldest; ///< their numbers: what only versions before `oldest` had is free
} tl_scene_versions_state;

/// Says which versions readers have left; for the writer's thread. `*state_out` may be NULL. TL_ERR_ARGUMENT.
TL_API tl_result tl_scene_versions_reclaim(tl_scene_versions *versions, tl_scene_versions_state *state_out);

#ifdef __cplusplus
}
#endif

#endif
