// SPDX-License-Identifier: MIT
//
// Worlds larger than memory: a file opened by its index, and tiles that come and go.

#include "world.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

#define LOAD_NAME "talus.world_load"

typedef enum load_stage { LOAD_BEGUN, LOAD_RUNNING, LOAD_DONE } load_stage;

// A load is known to its world, until that has taken it back, and to the capsule that Python has. Who lets go of it
// last frees it. Both look at it with the GIL held.
struct binding_load {
    tl_nav_world_load load;
    load_stage stage;
    bool in_world, in_python;
    struct binding_load *next;
};

// --- the file -------------------------------------------------------------------------------------------------------

#ifdef _WIN32
static long long read_some(const binding_world *held, uint64_t offset, void *bytes, size_t size)
{
    const unsigned most = size < 1u << 30 ? (unsigned)size : 1u << 30;
    PyThread_acquire_lock(held->seeking, WAIT_LOCK);
    long long done = _lseeki64(held->descriptor, (long long)offset, SEEK_SET) >= 0
                         ? (long long)_read(held->descriptor, bytes, most)
                         : -1;
    PyThread_release_lock(held->seeking);
    return done;
}
#else
static long long read_some(const binding_world *held, uint64_t offset, void *bytes, size_t size)
{
    ssize_t done;
    do {
        done = pread(held->descriptor, bytes, size, (off_t)offset);
    } while (done < 0 && errno == EINTR);
    return (long long)done;
}
#endif

static tl_result read_file(uint64_t offset, void *bytes, size_t size, void *user)
{
    const binding_world *held = user;
    char *at = bytes;
    while (size > 0) {
        const long long done = read_some(held, offset, at, size);
        if (done <= 0) {
            return done < 0 ? TL_ERR_IO : TL_ERR_TRUNCATED;
        }
        at += done;
        offset += (uint64_t)done;
        size -= (size_t)done;
    }
    return TL_OK;
}

// --- the object -----------------------------------------------------------------------------------------------------

binding_world *binding_world_of(PyObject *capsule)
{
    return PyCapsule_GetPointer(capsule, BINDING_WORLD);
}

static void let_go(binding_load *load)
{
    if (!load->in_world && !load->in_python) {
        free(load);
    }
}

static void destroy_world(binding_world *held)
{
    // No load runs: each holds the capsule.
    while (held->loads != NULL) {
        binding_load *load = held->loads;
        held->loads = load->next;
        load->in_world = false;
        let_go(load);
    }
    tl_nav_router_destroy(held->router);
    tl_nav_query_destroy(held->query);
    tl_nav_world_destroy(held->world);
    if (held->seeking != NULL) {
        PyThread_free_lock(held->seeking);
    }
    Py_XDECREF(held->file);
    free(held);
}

static void free_world(PyObject *capsule)
{
    destroy_world(binding_world_of(capsule));
}

// world_open(file, descriptor, budget, frame reach) -> world
static PyObject *world_open(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *file;
    int descriptor = -1;
    unsigned long long budget = 0;
    tl_nav_world_def def = tl_default_nav_world_def();
    if (!PyArg_ParseTuple(args, "OiKd", &file, &descriptor, &budget, &def.frame_reach)) {
        return NULL;
    }
    binding_world *held = calloc(1, sizeof(*held));
    if (held == NULL) {
        return PyErr_NoMemory();
    }
    held->file = Py_NewRef(file);
    held->descriptor = descriptor;
#ifdef _WIN32
    held->seeking = PyThread_allocate_lock();
    if (held->seeking == NULL) {
        destroy_world(held);
        return PyErr_NoMemory();
    }
#endif
    def.read = read_file;
    def.user = held;
    def.budget = budget;
    tl_report report;
    tl_result result;
    PyThreadState *state = PyEval_SaveThread();
    result = tl_nav_world_create(&def, &held->world, &report);
    PyEval_RestoreThread(state);
    PyObject *capsule = NULL;
    if (result == TL_NOT_FOUND) {
        PyErr_SetString(PyExc_ValueError, "the file holds no navmesh");
    } else if (result != TL_OK) {
        binding_raise(result, &report);
    } else {
        capsule = PyCapsule_New(held, BINDING_WORLD, free_world);
    }
    if (capsule == NULL) {
        destroy_world(held);
    }
    return capsule;
}

// A chunk of the file, read and checked, to be freed; NULL where there is none, or with an error in *result.
static void *read_chunk(binding_world *held, const tl_pack_index *index, uint32_t type,
                        tl_result (*check)(const void *, uint64_t, tl_report *), tl_result *result, tl_report *report)
{
    for (uint32_t i = 0; *result == TL_OK && i < index->count; i++) {
        const tl_pack_entry *entry = &index->entries[i];
        if (entry->type != type || entry->size > PY_SSIZE_T_MAX) {
            continue;
        }
        void *bytes = malloc(entry->size > 0 ? (size_t)entry->size : 1);
        *result = bytes != NULL ? read_file(entry->offset, bytes, (size_t)entry->size, held) : TL_ERR_MEMORY;
        *result = *result == TL_OK ? tl_pack_entry_open(entry, bytes, report) : *result;
        *result = *result == TL_OK ? check(bytes, entry->size, report) : *result;
        if (*result == TL_OK) {
            return bytes;
        }
        free(bytes);
    }
    return NULL;
}

static tl_result read_index(binding_world *held, void **bytes, tl_pack_index *index, tl_report *report)
{
    uint64_t head[TL_PACK_HEAD_SIZE / 8];
    uint64_t size = 0;
    tl_result result = read_file(0, head, sizeof(head), held);
    result = result == TL_OK ? tl_pack_index_size(head, &size, report) : result;
    if (result != TL_OK) {
        return result;
    }
    *bytes = size <= PY_SSIZE_T_MAX ? malloc((size_t)size) : NULL;
    result = *bytes != NULL ? read_file(0, *bytes, (size_t)size, held) : TL_ERR_MEMORY;
    return result == TL_OK ? tl_pack_index_open(*bytes, size, index, report) : result;
}

// world_about(world) -> (settings dict, ((x, y, z), (x, y, z))): of the file; corners of the level's own coordinates
static PyObject *world_about(PyObject *self, PyObject *capsule)
{
    (void)self;
    binding_world *held = binding_world_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    tl_report report = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
    void *bytes = NULL;
    tl_pack_index index;
    memset(&index, 0, sizeof(index));
    tl_result result = read_index(held, &bytes, &index, &report);
    tl_pack_navmesh *head = read_chunk(held, &index, TL_PACK_NAVM, tl_pack_navmesh_check, &result, &report);
    tl_pack_frame *frame = read_chunk(held, &index, TL_PACK_FRAM, tl_pack_frame_check, &result, &report);
    PyObject *about = NULL;
    if (result == TL_OK && head != NULL) {
        const tl_nav_def def = tl_pack_navmesh_def(head);
        double a[3];
        double b[3];
        tl_pack_place_out(frame, def.bounds.min, a);
        tl_pack_place_out(frame, def.bounds.max, b);
        about = Py_BuildValue("N((ddd)(ddd))", binding_nav_def_dict(&def), fmin(a[0], b[0]), fmin(a[1], b[1]),
                              fmin(a[2], b[2]), fmax(a[0], b[0]), fmax(a[1], b[1]), fmax(a[2], b[2]));
    } else {
        binding_raise(result == TL_OK ? TL_ERR_CORRUPT : result, &report);
    }
    free(frame);
    free(head);
    free(bytes);
    return about;
}

// --- tiles in and out -----------------------------------------------------------------------------------------------

// Loads that have ended, or that nobody has any more, go back to the world.
static void take_back(binding_world *held)
{
    for (binding_load **at = &held->loads; *at != NULL;) {
        binding_load *load = *at;
        if (load->stage == LOAD_DONE || !load->in_python) {
            *at = load->next;
            tl_nav_world_end_load(&load->load);
            load->in_world = false;
            let_go(load);
        } else {
            at = &load->next;
        }
    }
}

// world_state(world) -> (places, loaded, loading, ready, missing, failed, frames, bytes, peak, index bytes, read bytes)
static PyObject *world_state(PyObject *self, PyObject *capsule)
{
    (void)self;
    binding_world *held = binding_world_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    take_back(held);
    tl_nav_world_state s;
    tl_result result = tl_nav_world_get_state(held->world, &s);
    return result != TL_OK ? binding_raise(result, NULL)
                           : Py_BuildValue("(IIIIIIIKKKK)", s.places, s.loaded, s.loading, s.ready, s.missing, s.failed,
                                           s.frames, (unsigned long long)s.bytes, (unsigned long long)s.peak_bytes,
                                           (unsigned long long)s.index_bytes, (unsigned long long)s.read_bytes);
}

// world_update(world, interests f64[n][4], max changes) -> whether anything changed
static PyObject *world_update(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer interests;
    unsigned max_changes = 0;
    if (!PyArg_ParseTuple(args, "Oy*I", &capsule, &interests, &max_changes)) {
        return NULL;
    }
    binding_world *held = binding_world_of(capsule);
    Py_ssize_t count = held != NULL ? binding_count(&interests, sizeof(tl_nav_world_interest), "interests") : -1;
    tl_result result = TL_OK;
    if (count >= 0) {
        take_back(held);
        PyThreadState *state = PyEval_SaveThread();
        result = tl_nav_world_update(held->world, interests.buf, (uint32_t)count, max_changes);
        PyEval_RestoreThread(state);
    }
    PyBuffer_Release(&interests);
    if (count < 0) {
        return NULL;
    }
    return tl_is_error(result) ? binding_raise(result, NULL) : PyBool_FromLong(result == TL_OK);
}

static void free_load(PyObject *capsule)
{
    binding_load *load = PyCapsule_GetPointer(capsule, LOAD_NAME);
    PyObject *world = PyCapsule_GetContext(capsule);
    load->in_python = false;
    let_go(load);
    Py_XDECREF(world);
}

// world_begin_load(world) -> load, or None where nothing is to be loaded now
static PyObject *world_begin_load(PyObject *self, PyObject *capsule)
{
    (void)self;
    binding_world *held = binding_world_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    binding_load *load = calloc(1, sizeof(*load));
    if (load == NULL) {
        return PyErr_NoMemory();
    }
    tl_result result = tl_nav_world_begin_load(held->world, &load->load);
    if (result != TL_OK) {
        free(load);
        return result == TL_NOT_FOUND ? Py_NewRef(Py_None) : binding_raise(result, NULL);
    }
    PyObject *made = PyCapsule_New(load, LOAD_NAME, free_load);
    if (made == NULL || PyCapsule_SetContext(made, Py_NewRef(capsule)) != 0) {
        tl_nav_world_end_load(&load->load); // it was never run
        if (made == NULL) {
            free(load);
        }
        Py_XDECREF(made);
        return NULL;
    }
    load->in_world = load->in_python = true;
    load->next = held->loads;
    held->loads = load;
    return made;
}

// load_run(load): reads and checks it, without the GIL
static PyObject *load_run(PyObject *self, PyObject *capsule)
{
    (void)self;
    binding_load *load = PyCapsule_GetPointer(capsule, LOAD_NAME);
    if (load == NULL) {
        return NULL;
    }
    if (load->stage != LOAD_BEGUN) {
        return PyErr_Format(PyExc_ValueError, "a load runs once");
    }
    load->stage = LOAD_RUNNING;
    Py_INCREF(capsule); // and so the world
    PyThreadState *state = PyEval_SaveThread();
    tl_result result = tl_nav_world_run_load(&load->load);
    PyEval_RestoreThread(state);
    load->stage = LOAD_DONE;
    char element[48];
    snprintf(element, sizeof(element), "tile %d,%d", (int)load->load.tile_x, (int)load->load.tile_z);
    const tl_report report = { NULL, NULL, element, TL_NO_ELEMENT, load->load.advice, 0 };
    Py_DECREF(capsule);
    return result == TL_OK ? Py_NewRef(Py_None) : binding_raise(result, &report);
}

// load_place(load) -> (tile x, tile z)
static PyObject *load_place(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_load *load = PyCapsule_GetPointer(capsule, LOAD_NAME);
    return load != NULL ? Py_BuildValue("(ii)", (int)load->load.tile_x, (int)load->load.tile_z) : NULL;
}

PyMethodDef binding_world_methods[] = {
    { "world_open", world_open, METH_VARARGS, NULL },
    { "world_about", world_about, METH_O, NULL },
    { "world_state", world_state, METH_O, NULL },
    { "world_update", world_update, METH_VARARGS, NULL },
    { "world_begin_load", world_begin_load, METH_O, NULL },
    { "load_run", load_run, METH_O, NULL },
    { "load_place", load_place, METH_O, NULL },
    { NULL, NULL, 0, NULL },
};
