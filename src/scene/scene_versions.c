// SPDX-License-Identifier: MIT
//
// Versions of a scene: each holds a copy of the instances and a tree over them. A navmesh's versions share what an edit
// leaves alone, page by page; a scene's tree is refitted as a whole each frame in any case, so a version has all of it:
// some 230 bytes an instance. The next version is made of a spare one, the newest that nobody holds: instances that
// have not moved since then are skipped.
//
// Readers enter and leave by split counts (base/version_door.h).

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/version_door.h"

#include <string.h>
#include <talus/scene_versions.h>

enum { SPARE_SCENES = 2 };

// A tree that costs so many times what it did when it was baked is baked anew.
#define REBAKE_GROWTH 1.5f

typedef struct scene_version {
    tl_scene_version view; // first: a reader's pointer is the version's
    tl_scene *scene;       // NULL: it has nothing
    tl_scene_instance *instances;
    uint32_t capacity; // of instances
    uint32_t index;
    uint64_t entered; // readers, known once it is not the newest
    bool is_there;    // newest, or older and held
    tl_version_leavers leavers;
} scene_version;

struct tl_scene_versions {
    tl_version_door door;
    scene_version *versions[TL_MAX_SCENE_VERSIONS]; // by index
    uint32_t count;
    scene_version *newest;
    tl_allocator allocator;
};

static_assert(TL_MAX_SCENE_VERSIONS <= TL_DOOR_MAX_VERSIONS, "indices fit the door");

// ---------------------------------------------------------------------------------------------------------
// Readers.

const tl_scene_version *tl_scene_versions_acquire(tl_scene_versions *versions)
{
    TL_ASSERT(versions != NULL);
    return &versions->versions[tl_version_enter(&versions->door)]->view;
}

void tl_scene_versions_release(tl_scene_versions *versions, const tl_scene_version *version)
{
    (void)versions;
    if (version != NULL) {
        // Readers are not to write to the version; the count behind it is not its.
        union {
            const tl_scene_version *read;
            scene_version *write;
        } held = { version };
        tl_version_leave(&held.write->leavers);
    }
}

// ---------------------------------------------------------------------------------------------------------
// The writer.

static void empty_scene_version(tl_scene_versions *versions, scene_version *version)
{
    tl_blob_free(version->scene);
    tl_release_array(&versions->allocator, version->instances, version->capacity, sizeof *version->instances);
    version->scene = NULL;
    version->instances = NULL;
    version->capacity = 0;
}

// Of the spare versions the newest, which lacks least; NULL: there is none.
static scene_version *best_spare_scene(const tl_scene_versions *versions)
{
    scene_version *best = NULL;
    for (uint32_t i = 0; i < versions->count; i++) {
        scene_version *version = versions->versions[i];
        if (!version->is_there && (best == NULL || version->view.number > best->view.number)) {
            best = version;
        }
    }
    return best;
}

// Versions that readers have left are spare; few of them keep what they have.
static void reclaim_scenes(tl_scene_versions *versions)
{
    uint32_t full = 0;
    for (uint32_t i = 0; i < versions->count; i++) {
        scene_version *version = versions->versions[i];
        if (version->is_there && version != versions->newest &&
            tl_version_left(&version->leavers) == version->entered) {
            version->is_there = false;
        }
        full += !version->is_there && version->scene != NULL;
    }
    for (; full > SPARE_SCENES; full--) {
        scene_version *oldest = NULL;
        for (uint32_t i = 0; i < versions->count; i++) {
            scene_version *version = versions->versions[i];
            if (!version->is_there && version->scene != NULL &&
                (oldest == NULL || version->view.number < oldest->view.number)) {
                oldest = version;
            }
        }
        empty_scene_version(versions, oldest);
    }
}

static tl_result take_spare_scene(tl_scene_versions *versions, scene_version **version_out)
{
    scene_version *version = best_spare_scene(versions);
    if (version == NULL && versions->count == TL_MAX_SCENE_VERSIONS) {
        return TL_ERR_LIMIT;
    }
    if (version == NULL) {
        version = (scene_version *)tl_allocate_array(&versions->allocator, 1, sizeof *version);
        if (version == NULL) {
            return TL_ERR_MEMORY;
        }
        memset(&version->view, 0, sizeof version->view);
        version->scene = NULL;
        version->instances = NULL;
        version->capacity = 0;
        version->index = versions->count;
        version->entered = 0;
        version->is_there = false;
        tl_version_leavers_init(&version->leavers);
        versions->versions[versions->count++] = version;
    }
    *version_out = version;
    return TL_OK;
}

static tl_result fit_tree(tl_scene_versions *versions, scene_version *version, const tl_scene_instance *instances,
                          uint32_t count, tl_report *report)
{
    if (version->scene != NULL && version->view.count == count) {
        float growth = 0.0f;
        TL_TRY(tl_scene_refit(version->scene, instances, count, &growth, report));
        if (growth <= REBAKE_GROWTH) {
            return TL_OK;
        }
    }
    tl_host host;
    memset(&host, 0, sizeof host);
    host.allocator = &versions->allocator;
    tl_scene *baked = NULL;
    TL_TRY(tl_scene_bake(instances, count, &host, &baked, report));
    tl_blob_free(version->scene);
    version->scene = baked;
    version->view.count = count;
    return TL_OK;
}

static tl_result copy_instances(tl_scene_versions *versions, scene_version *version, const tl_scene_instance *instances,
                                uint32_t count)
{
    if (count > version->capacity) {
        tl_scene_instance *grown =
            (tl_scene_instance *)tl_allocate_array(&versions->allocator, count, sizeof *version->instances);
        if (grown == NULL) {
            return TL_ERR_MEMORY;
        }
        tl_release_array(&versions->allocator, version->instances, version->capacity, sizeof *version->instances);
        version->instances = grown;
        version->capacity = count;
    }
    if (count > 0) {
        memcpy(version->instances, instances, count * sizeof *instances);
    }
    return TL_OK;
}

static void open_scene_door(tl_scene_versions *versions, scene_version *version)
{
    scene_version *before = versions->newest;
    version->view.scene = version->scene;
    version->view.instances = version->instances;
    version->view.number = before != NULL ? before->view.number + 1 : 1;
    version->entered = 0;
    version->is_there = true;
    versions->newest = version;
    const uint64_t entered = tl_version_open(&versions->door, version->index, &version->leavers);
    if (before != NULL) {
        before->entered = entered;
    }
}

static tl_result publish_scene(tl_scene_versions *versions, const tl_scene_instance *instances, uint32_t count,
                               tl_report *report)
{
    scene_version *version = NULL;
    reclaim_scenes(versions);
    TL_TRY(take_spare_scene(versions, &version));
    TL_TRY(fit_tree(versions, version, instances, count, report));
    TL_TRY(copy_instances(versions, version, instances, count));
    open_scene_door(versions, version);
    return TL_OK;
}

tl_result tl_scene_versions_publish(tl_scene_versions *versions, const tl_scene_instance *instances, uint32_t count,
                                    tl_report *report_out)
{
    tl_report_begin(report_out, "publish scene");
    TL_REFUSE_NULL(versions, report_out);
    if (instances == NULL && count > 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "instances", "give the instances");
    }
    return publish_scene(versions, instances, count, report_out);
}

tl_result tl_scene_versions_create(const tl_scene_instance *instances, uint32_t count, const tl_allocator *allocator,
                                   tl_scene_versions **versions_out, tl_report *report_out)
{
    tl_report_begin(report_out, "create scene versions");
    if (versions_out != NULL) {
        *versions_out = NULL;
    }
    TL_REFUSE_NULL(versions_out, report_out);
    if (instances == NULL && count > 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "instances", "give the instances");
    }
    tl_scene_versions *versions = (tl_scene_versions *)tl_allocate_array(allocator, 1, sizeof *versions);
    if (versions == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(versions->versions, 0, sizeof versions->versions);
    versions->count = 0;
    versions->newest = NULL;
    versions->allocator = tl_allocator_or_default(allocator);
    tl_version_door_init(&versions->door);
    const tl_result result = publish_scene(versions, instances, count, report_out);
    if (result != TL_OK) {
        tl_scene_versions_destroy(versions);
        return result;
    }
    *versions_out = versions;
    return TL_OK;
}

void tl_scene_versions_destroy(tl_scene_versions *versions)
{
    if (versions == NULL) {
        return;
    }
    if (versions->newest != NULL) {
        versions->newest->entered = tl_version_entered(&versions->door);
    }
    for (uint32_t i = 0; i < versions->count; i++) {
        scene_version *version = versions->versions[i];
        TL_ASSERT(!version->is_there || tl_version_left(&version->leavers) == version->entered);
        empty_scene_version(versions, version);
        tl_release_array(&versions->allocator, version, 1, sizeof *version);
    }
    const tl_allocator allocator = versions->allocator;
    tl_release_array(&allocator, versions, 1, sizeof *versions);
}

tl_result tl_scene_versions_reclaim(tl_scene_versions *versions, tl_scene_versions_state *state_out)
{
    if (state_out != NULL) {
        memset(state_out, 0, sizeof *state_out);
    }
    if (versions == NULL) {
        return TL_ERR_ARGUMENT;
    }
    reclaim_scenes(versions);
    if (state_out == NULL) {
        return TL_OK;
    }
    state_out->newest = state_out->oldest = versions->newest->view.number;
    for (uint32_t i = 0; i < versions->count; i++) {
        const scene_version *version = versions->versions[i];
        if (version->is_there) {
            state_out->version_count++;
            state_out->oldest = version->view.number < state_out->oldest ? version->view.number : state_out->oldest;
        }
    }
    return TL_OK;
}
