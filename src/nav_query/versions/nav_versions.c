// SPDX-License-Identifier: MIT
//
// Versions of a navmesh: entering and leaving them by counts, and freeing what no version that is held has.
//
// Counts of references, not epochs: a reader may hold a version for a search that is sliced over many frames. An epoch
// would keep all that died since; a count for each version keeps what that version has, and no more. A reader is no
// object to be registered, and what it holds may travel to another thread, as jobs do.
// The count is split in two, so that one addition enters (base/version_door.h). Nobody retries: entering and leaving
// are wait-free. Looked at: hazard pointers and per-reader epochs (an announcement needs a fence that costs as much as
// the addition, and readers that are registered); left-right (the writer waits for readers, each edit is made twice,
// and all derived data, as large as the tiles, is there twice).
//
// What died in a version is freed like a file system's snapshots: a version's list holds the blocks that it has and the
// next newer version that is there has not. When it goes, blocks born after the version before it have no holder left;
// the others join that version's list. So each block is freed as soon as no version that has it is held.
//
// Sources: Fraser, Practical lock-freedom, 2004; Hart, McKenney, Brown, Walpole, Performance of memory reclamation for
// lockless synchronization, 2007; Williams, C++ Concurrency in Action, 2012, 7.2.4 (split counts); Ramalhete, Correia,
// Left-Right, 2015; Wen et al., Interval-based memory reclamation, 2018; Bonwick et al., The Zettabyte File System,
// 2003 (dead lists).

#include "base/arena.h"
#include "base/assert.h"
#include "base/exact_floats.h"
#include "base/version_door.h"
#include "nav_query/versions/catch_up.h"

#include <string.h>
#include <talus/nav_versions.h>

enum { SPARE_VERSIONS = 2 };
static_assert(TL_NAV_MAX_VERSIONS <= TL_DOOR_MAX_VERSIONS, "indices fit the door");

typedef struct nav_version {
    tl_navmesh navmesh; // first: a reader's pointer is the version's
    uint64_t number;    // 0: it has no arrays
    uint64_t entered;   // readers, known once it is not the newest
    tl_nav_block *dead; // blocks that it has, and the next newer version has not
    struct nav_version *older, *newer;
    uint32_t index;
    bool is_there; // newest, or older and held
    tl_version_leavers leavers;
} nav_version;

struct tl_nav_versions {
    tl_version_door door;
    nav_version *versions[TL_NAV_MAX_VERSIONS]; // by index
    uint32_t count;                             // of them
    uint32_t there_count;
    nav_version *newest, *oldest, *draft;
    tl_nav_history history;
};

// ---------------------------------------------------------------------------------------------------------
// Readers.

const tl_navmesh *tl_nav_versions_acquire(tl_nav_versions *versions)
{
    TL_ASSERT(versions != NULL);
    return &versions->versions[tl_version_enter(&versions->door)]->navmesh;
}

void tl_nav_versions_release(tl_nav_versions *versions, const tl_navmesh *navmesh)
{
    (void)versions;
    if (navmesh != NULL) {
        // Readers are not to write to the navmesh; the count behind it is not its.
        union {
            const tl_navmesh *read;
            nav_version *write;
        } version = { navmesh };
        tl_version_leave(&version.write->leavers);
    }
}

// ---------------------------------------------------------------------------------------------------------
// The writer.

static nav_version *new_version(tl_nav_versions *versions)
{
    nav_version *version = (nav_version *)tl_allocate_array(&versions->history.host, 1, sizeof *version);
    if (version != NULL) {
        memset(&version->navmesh, 0, sizeof version->navmesh);
        version->number = 0;
        version->entered = 0;
        version->dead = NULL;
        version->older = version->newer = NULL;
        version->index = versions->count;
        version->is_there = false;
        tl_version_leavers_init(&version->leavers);
        versions->versions[versions->count++] = version;
    }
    return version;
}

static void free_dead(tl_nav_history *history, tl_nav_block *block)
{
    while (block != NULL) {
        tl_nav_block *next = block->next;
        tl_nav_free_block(history, block);
        block = next;
    }
}

// A version that nobody holds any more, and that is not the newest, becomes a spare one.
static void let_go(tl_nav_versions *versions, nav_version *version)
{
    tl_nav_history *history = &versions->history;
    nav_version *older = version->older;
    tl_nav_block *block = version->dead;
    version->dead = NULL;
    while (block != NULL) {
        tl_nav_block *next = block->next;
        if (older != NULL && block->born <= older->number) {
            block->next = older->dead;
            older->dead = block;
        } else {
            history->waiting_bytes -= block->size;
            tl_nav_free_block(history, block);
        }
        block = next;
    }
    if (older != NULL) {
        older->newer = version->newer;
    } else {
        versions->oldest = version->newer;
    }
    version->newer->older = older;
    version->older = version->newer = NULL;
    version->is_there = false;
    versions->there_count--;
}

// The spare version that lacks least; NULL: there is none. Few are kept: others lose their arrays.
static nav_version *best_spare(tl_nav_versions *versions)
{
    nav_version *best = NULL;
    for (uint32_t i = 0; i < versions->count; i++) {
        nav_version *version = versions->versions[i];
        if (!version->is_there && version != versions->draft && (best == NULL || version->number > best->number)) {
            best = version;
        }
    }
    return best;
}

static void trim_spares(tl_nav_versions *versions)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < versions->count; i++) {
        nav_version *version = versions->versions[i];
        if (!version->is_there && version != versions->draft && version->number > 0 && ++kept > SPARE_VERSIONS) {
            tl_nav_free_arrays(&versions->history, &version->navmesh);
            version->number = 0;
        }
    }
}

static void reclaim(tl_nav_versions *versions)
{
    nav_version *version = versions->oldest;
    while (version != versions->newest) {
        nav_version *newer = version->newer;
        if (tl_version_left(&version->leavers) == version->entered) {
            let_go(versions, version);
        }
        version = newer;
    }
    trim_spares(versions);
}

// What readers enter from now on.
static void open_door(tl_nav_versions *versions, nav_version *version)
{
    nav_version *before = versions->newest;
    version->entered = 0;
    version->is_there = true;
    version->older = before;
    versions->newest = version;
    versions->there_count++;
    versions->history.draft = version->number + 1;
    const uint64_t entered = tl_version_open(&versions->door, version->index, &version->leavers);
    if (before != NULL) {
        before->newer = version;
        before->entered = entered;
        before->dead = versions->history.dying;
        versions->history.dying = NULL;
    } else {
        versions->oldest = version;
    }
}

tl_result tl_nav_versions_create(const tl_allocator *allocator, tl_nav_versions **versions_out)
{
    if (versions_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *versions_out = NULL;
    tl_nav_versions *versions = (tl_nav_versions *)tl_allocate_array(allocator, 1, sizeof *versions);
    if (versions == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(versions->versions, 0, sizeof versions->versions);
    memset(&versions->history, 0, sizeof versions->history);
    versions->count = versions->there_count = 0;
    versions->newest = versions->oldest = versions->draft = NULL;
    versions->history.host = tl_allocator_or_default(allocator);
    tl_version_door_init(&versions->door);
    nav_version *first = new_version(versions);
    if (first == NULL) {
        tl_release_array(allocator, versions, 1, sizeof *versions);
        return TL_ERR_MEMORY;
    }
    first->number = 1;
    first->navmesh.allocator = tl_nav_history_allocator(&versions->history);
    first->navmesh.history = &versions->history;
    first->navmesh.islands.history = &versions->history;
    first->navmesh.free_slots = TL_NAV_NO_SLOT;
    open_door(versions, first);
    *versions_out = versions;
    return TL_OK;
}

void tl_nav_versions_destroy(tl_nav_versions *versions)
{
    if (versions == NULL) {
        return;
    }
    tl_nav_history *history = &versions->history;
    versions->newest->entered = tl_version_entered(&versions->door);
    // What is alive hangs on the draft, or on the newest version where there is none.
    nav_version *last = versions->draft != NULL ? versions->draft : versions->newest;
    free_dead(history, history->dying);
    history->dying = NULL;
    history->ends = true;
    tl_nav_free_content(&last->navmesh);
    for (uint32_t i = 0; i < versions->count; i++) {
        nav_version *version = versions->versions[i];
        TL_ASSERT(!version->is_there || tl_version_left(&version->leavers) == version->entered);
        free_dead(history, version->dead);
        if (version != last) {
            tl_nav_free_arrays(history, &version->navmesh);
        }
        tl_release_array(&history->host, version, 1, sizeof *version);
    }
    const tl_allocator host = history->host;
    tl_release_array(&host, versions, 1, sizeof *versions);
}

tl_result tl_nav_versions_edit(tl_nav_versions *versions, tl_navmesh **draft_out)
{
    if (draft_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *draft_out = NULL;
    if (versions == NULL) {
        return TL_ERR_ARGUMENT;
    }
    if (versions->draft == NULL) {
        reclaim(versions);
        nav_version *version = best_spare(versions);
        if (version == NULL && versions->count == TL_NAV_MAX_VERSIONS) {
            return TL_ERR_LIMIT;
        }
        version = version != NULL ? version : new_version(versions);
        if (version == NULL) {
            return TL_ERR_MEMORY;
        }
        TL_TRY(tl_nav_catch_up(&versions->history, &versions->newest->navmesh, version->number, &version->navmesh));
        version->number = versions->history.draft;
        versions->draft = version;
    }
    *draft_out = &versions->draft->navmesh;
    return TL_OK;
}

tl_result tl_nav_versions_publish(tl_nav_versions *versions)
{
    if (versions == NULL) {
        return TL_ERR_ARGUMENT;
    }
    nav_version *draft = versions->draft;
    if (draft != NULL) {
        versions->draft = NULL;
        open_door(versions, draft);
    }
    reclaim(versions);
    return TL_OK;
}

tl_result tl_nav_versions_reclaim(tl_nav_versions *versions, tl_nav_versions_state *state_out)
{
    if (state_out != NULL) {
        memset(state_out, 0, sizeof *state_out);
    }
    if (versions == NULL) {
        return TL_ERR_ARGUMENT;
    }
    reclaim(versions);
    if (state_out != NULL) {
        state_out->version_count = versions->there_count;
        state_out->newest = versions->newest->number;
        state_out->oldest = versions->oldest->number;
        state_out->waiting_bytes = versions->history.waiting_bytes;
    }
    return TL_OK;
}
