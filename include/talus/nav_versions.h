// SPDX-License-Identifier: MIT
//
// A navmesh that changes while it is read: readers acquire the newest version and ask it for as long as they like; a
// writer makes the next version beside them and publishes it.
//
//   readers  any number of threads. tl_nav_versions_acquire and tl_nav_versions_release are one atomic addition each:
//            no lock, no loop, no wait, whatever the writer or other readers do. What a reader holds is a navmesh like
//            any other and does not change: all queries take it, and see all of an edit or nothing of it.
//   writer   one thread at a time. tl_nav_versions_edit gives the draft, a navmesh that all functions which change one
//            take: tiles, off-mesh links, flags and areas, obstacles, preparing. tl_nav_versions_publish makes it the
//            newest version. The writer never waits for readers either.
//
// Versions share all that an edit leaves alone: tiles, their links over seams and rings, what was prepared. The writer
// copies what it is about to change, and of each version's table of slots the pages that changed. So an edit costs
// about what it costs on a navmesh that is alone, and a version that is held costs the memory of what has changed
// since.
//
// References, corridors and crowds go from version to version as they go over edits: a reference names the same polygon
// in all versions that have its tile, and is TL_ERR_STALE in others. A sliced search stays with the version that it
// began with: hold that until the path is written. tl_navmesh_edit_count tells two versions apart.
//
// Memory is taken and freed by the writer alone, so the allocator needs no lock, and no reader ever pays for freeing.
// What older versions alone have is freed by the writer's next call here, once no reader holds a version that has it.

#ifndef TALUS_NAV_VERSIONS_H
#define TALUS_NAV_VERSIONS_H

#include <talus/nav_query.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tl_nav_versions tl_nav_versions;

#define TL_NAV_MAX_VERSIONS 1024u ///< that exist at one time: held by readers, newest, and draft

/// Creates a navmesh in versions. The first version is there, and empty. `allocator` is copied; NULL: malloc.
/// TL_ERR_ARGUMENT, TL_ERR_MEMORY: `*versions_out` is NULL.
TL_API tl_result tl_nav_versions_create(const tl_allocator *allocator, tl_nav_versions **versions_out);
/// Frees all versions, the draft too, and the tiles they own. No reader may hold a version any more. NULL: nothing
/// happens.
TL_API void tl_nav_versions_destroy(tl_nav_versions *versions);

/// The newest version. Any thread; it is the reader's until tl_nav_versions_release, and stays as it is meanwhile. May
/// be acquired more than once, and released by another thread: a job takes it along. Not NULL; `versions` must not be.
TL_API const tl_navmesh *tl_nav_versions_acquire(tl_nav_versions *versions);
/// Gives back a version, once for each time it was acquired. NULL navmesh: nothing happens.
TL_API void tl_nav_versions_release(tl_nav_versions *versions, const tl_navmesh *navmesh);

/// The draft, to be changed by the functions that change a navmesh: begun from the newest version, or the one under
/// way. It is not to be destroyed, and is gone with tl_nav_versions_publish; ask again. The writer may query it.
///
/// Functions that change a draft keep their promises; beyond those, what removes or replaces tiles can fail with
/// TL_ERR_MEMORY, since it copies: what is there then is whole. Tiles that are borrowed must outlive all versions that
/// have them: free them once tl_nav_versions_reclaim says that the versions from before their removal are gone.
/// TL_ERR_ARGUMENT; TL_ERR_MEMORY, TL_ERR_LIMIT (TL_NAV_MAX_VERSIONS: readers do not release): `*draft_out` is NULL,
/// and a later call may succeed. O(what the last versions changed), now and then O(slots).
TL_API tl_result tl_nav_versions_edit(tl_nav_versions *versions, tl_navmesh **draft_out);

/// Makes the draft the newest version: who acquires from now on gets it. Without a draft nothing happens. It cannot
/// fail but for TL_ERR_ARGUMENT (NULL). Also frees what readers have left.
TL_API tl_result tl_nav_versions_publish(tl_nav_versions *versions);

/// What there is of versions, and memory that waits.
typedef struct tl_nav_versions_state {
    uint32_t version_count;  ///< the newest and older ones that are held; the draft is not counted
    uint64_t newest, oldest; ///< their numbers, ascending by 1 with each tl_nav_versions_publish
    uint64_t waiting_bytes;  ///< of what the newest version, or the draft, has no more and older ones have
} tl_nav_versions_state;

/// Frees what readers have left, and says what is left; for the writer's thread. `*state_out` may be NULL.
/// TL_ERR_ARGUMENT.
TL_API tl_result tl_nav_versions_reclaim(tl_nav_versions *versions, tl_nav_versions_state *state_out);

#ifdef __cplusplus
}
#endif

#endif
