// SPDX-License-Identifier: MIT
//
// A navmesh in versions: read while it changes. A version, and the draft, are navmeshes like any other to Python, whose
// capsules hold the versions; what they were baked with is shared with the navmesh that the versions were made from.

#include "binding.h"

#include <stdlib.h>
#include <string.h>

#define VERSIONS_NAME "talus.versions"

typedef struct binding_versions {
    tl_nav_versions *versions;
    PyObject *source; // the navmesh's capsule: it owns the first version's tiles, and the obstacles
} binding_versions;

static binding_versions *versions_of(PyObject *capsule)
{
    return PyCapsule_GetPointer(capsule, VERSIONS_NAME);
}

static void destroy_versions(binding_versions *held)
{
    tl_nav_versions_destroy(held->versions);
    Py_XDECREF(held->source);
    free(held);
}

static void free_versions(PyObject *capsule)
{
    destroy_versions(versions_of(capsule));
}

// The tiles of `from`, borrowed, and its off-mesh links.
static tl_result copy_navmesh(const tl_navmesh *from, tl_navmesh *to, tl_report *report)
{
    tl_nav_tile **tiles = malloc(((size_t)tl_navmesh_tile_count(from) + 1) * sizeof(*tiles));
    if (tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(from); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(from, slot);
        if (tile != NULL) {
            tiles[count++] = (tl_nav_tile *)(uintptr_t)tile; // it is not written
        }
    }
    tl_result result = tl_navmesh_add_tiles(to, tiles, count, TL_NAV_TILE_BORROWED, report);
    free((void *)tiles);
    uint32_t cursor = 0;
    for (tl_nav_ref ref; result == TL_OK && tl_navmesh_next_offmesh(from, &cursor, &ref);) {
        tl_nav_offmesh_state state;
        tl_nav_ref made;
        result = tl_navmesh_offmesh_state(from, ref, &state);
        result = result == TL_OK ? tl_navmesh_add_offmesh(to, &state.offmesh, &made, report) : result;
    }
    return result;
}

// versions_create(navmesh) -> versions; the navmesh is not to be changed any more
static PyObject *versions_create(PyObject *self, PyObject *source)
{
    (void)self;
    binding_navmesh *navmesh = binding_navmesh_to_change(source);
    if (navmesh == NULL) {
        return NULL;
    }
    if (navmesh->versions != NULL) {
        return PyErr_Format(PyExc_ValueError, "it is a draft of versions already");
    }
    binding_versions *held = calloc(1, sizeof(*held));
    if (held == NULL) {
        return PyErr_NoMemory();
    }
    held->source = Py_NewRef(source);
    tl_navmesh *draft = NULL;
    tl_report report = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
    PyThreadState *state = PyEval_SaveThread();
    tl_result result = tl_nav_versions_create(NULL, &held->versions);
    result = result == TL_OK ? tl_nav_versions_edit(held->versions, &draft) : result;
    result = result == TL_OK ? copy_navmesh(navmesh->navmesh, draft, &report) : result;
    result = result == TL_OK ? tl_nav_versions_publish(held->versions) : result;
    PyEval_RestoreThread(state);
    PyObject *capsule =
        result == TL_OK ? PyCapsule_New(held, VERSIONS_NAME, free_versions) : binding_raise(result, &report);
    if (capsule == NULL) {
        destroy_versions(held);
        return NULL;
    }
    navmesh->is_fixed = true;
    return capsule;
}

// A version or the draft as a navmesh, which holds the versions.
static PyObject *wrap(PyObject *capsule, const tl_navmesh *navmesh, bool is_fixed)
{
    const binding_versions *held = versions_of(capsule);
    binding_navmesh made = *binding_navmesh_of(held->source);
    made.navmesh = (tl_navmesh *)(uintptr_t)navmesh;
    made.query = NULL;
    made.own_links = NULL;
    made.own_pruning = NULL;
    made.owner = Py_NewRef(capsule);
    made.versions = held->versions;
    made.is_fixed = is_fixed;
    return binding_navmesh_capsule(&made);
}

// versions_acquire(versions) -> navmesh
static PyObject *versions_acquire(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_versions *held = versions_of(capsule);
    return held != NULL ? wrap(capsule, tl_nav_versions_acquire(held->versions), true) : NULL;
}

// versions_leave(navmesh): of a version, or of a draft that was published; it is of no use then
static PyObject *versions_leave(PyObject *self, PyObject *capsule)
{
    (void)self;
    binding_navmesh *held = binding_navmesh_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    if (held->versions == NULL) {
        return PyErr_Format(PyExc_TypeError, "it is no version");
    }
    if (held->is_fixed) {
        tl_nav_versions_release(held->versions, held->navmesh);
    }
    held->navmesh = NULL;
    tl_nav_query_destroy(held->query);
    held->query = NULL;
    Py_RETURN_NONE;
}

// versions_edit(versions) -> the draft, as a navmesh
static PyObject *versions_edit(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_versions *held = versions_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    tl_navmesh *draft = NULL;
    PyThreadState *state = PyEval_SaveThread();
    tl_result result = tl_nav_versions_edit(held->versions, &draft);
    PyEval_RestoreThread(state);
    return result == TL_OK ? wrap(capsule, draft, false) : binding_raise(result, NULL);
}

// versions_publish(versions): makes the draft the newest version
static PyObject *versions_publish(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_versions *held = versions_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    PyThreadState *state = PyEval_SaveThread();
    tl_result result = tl_nav_versions_publish(held->versions);
    PyEval_RestoreThread(state);
    return result == TL_OK ? Py_NewRef(Py_None) : binding_raise(result, NULL);
}

// versions_state(versions) -> (version count, newest, oldest, waiting bytes), after what can be freed was
static PyObject *versions_state(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_versions *held = versions_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    tl_nav_versions_state s;
    tl_result result = tl_nav_versions_reclaim(held->versions, &s);
    return result == TL_OK ? Py_BuildValue("(IKKK)", s.version_count, (unsigned long long)s.newest,
                                           (unsigned long long)s.oldest, (unsigned long long)s.waiting_bytes)
                           : binding_raise(result, NULL);
}

PyMethodDef binding_versions_methods[] = {
    { "versions_create", versions_create, METH_O, NULL },
    { "versions_acquire", versions_acquire, METH_O, NULL },
    { "versions_leave", versions_leave, METH_O, NULL },
    { "versions_edit", versions_edit, METH_O, NULL },
    { "versions_publish", versions_publish, METH_O, NULL },
    { "versions_state", versions_state, METH_O, NULL },
    { NULL, NULL, 0, NULL },
};
