// SPDX-License-Identifier: MIT
//
// Crowds: agents by arrays of their names, and rows of fixed layout in and out, which the numpy types of crowd.py give.

#include "binding.h"

#include <stdlib.h>
#include <string.h>

#define CROWD_NAME "talus.crowd"

typedef struct binding_crowd {
    tl_nav_crowd *crowd;
    tl_tasks tasks; // the crowd points to it
} binding_crowd;

// crowd.py has both as _AGENT and _STATE.
typedef struct agent_row {
    tl_vec3 position;
    float reach, radius, height, max_speed, max_acceleration, arrive_distance, priority;
    uint32_t filter;
    uint32_t is_fixed;
} agent_row;

typedef struct state_row {
    uint64_t polygon, link;
    tl_vec3 position, velocity, wanted, goal;
    float radius, height;
    uint32_t status;
    uint32_t reserved;
} state_row;

_Static_assert(sizeof(agent_row) == 48 && sizeof(state_row) == 80, "crowd.py has the same rows");

static binding_crowd *crowd_of(PyObject *capsule)
{
    return PyCapsule_GetPointer(capsule, CROWD_NAME);
}

tl_nav_crowd *binding_crowd_of(PyObject *capsule)
{
    const binding_crowd *held = crowd_of(capsule);
    return held != NULL ? held->crowd : NULL;
}

static void free_crowd(PyObject *capsule)
{
    binding_crowd *held = crowd_of(capsule);
    tl_nav_crowd_destroy(held->crowd);
    free(held);
}

// Raises the error of one agent of an array.
static PyObject *raise_for(tl_result result, const tl_report *report, Py_ssize_t index)
{
    tl_report of_agent = { NULL, NULL, "agent", (uint64_t)index, NULL, 0 };
    if (report != NULL) {
        of_agent.field = report->field;
        of_agent.advice = report->advice;
    }
    return binding_raise(result, &of_agent);
}

// crowd_create((max agents, max path, max neighbors, paths per step, max nodes, neighbor distance, agent horizon, wall
//              horizon, max shared goals, max groups, max members), threads) -> crowd
static PyObject *crowd_create(PyObject *self, PyObject *args)
{
    (void)self;
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "(IIIIIfffIII)I", &def.max_agents, &def.max_path, &def.max_neighbors,
                          &def.paths_per_step, &def.max_nodes, &def.neighbor_distance, &def.agent_horizon,
                          &def.wall_horizon, &def.max_shared_goals, &def.max_groups, &def.max_members, &threads)) {
        return NULL;
    }
    binding_crowd *held = calloc(1, sizeof(*held));
    if (held == NULL) {
        return PyErr_NoMemory();
    }
    binding_tasks(&held->tasks, threads);
    def.host.tasks = &held->tasks;
    tl_report report;
    tl_result result = tl_nav_crowd_create(&def, &held->crowd, &report);
    if (result != TL_OK) {
        free(held);
        return binding_raise(result, &report);
    }
    PyObject *capsule = PyCapsule_New(held, CROWD_NAME, free_crowd);
    if (capsule == NULL) {
        tl_nav_crowd_destroy(held->crowd);
        free(held);
    }
    return capsule;
}

// crowd_set_filter(crowd, place, filter)
static PyObject *crowd_set_filter(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    unsigned place = 0;
    if (!PyArg_ParseTuple(args, "OIO", &capsule, &place, &filter_tuple)) {
        return NULL;
    }
    binding_crowd *held = crowd_of(capsule);
    tl_nav_filter filter;
    if (held == NULL || !binding_filter(filter_tuple, &filter)) {
        return NULL;
    }
    tl_result result = tl_nav_crowd_set_filter(held->crowd, place, &filter);
    return result == TL_OK ? Py_NewRef(Py_None) : binding_raise(result, NULL);
}

static tl_result add_row(binding_crowd *held, const tl_navmesh *navmesh, const agent_row *row, tl_nav_agent *agent,
                         tl_report *report)
{
    tl_nav_agent_def def = tl_default_nav_agent_def();
    def.position = row->position;
    def.reach = row->reach;
    def.radius = row->radius;
    def.height = row->height;
    def.max_speed = row->max_speed;
    def.max_acceleration = row->max_acceleration;
    def.arrive_distance = row->arrive_distance;
    def.priority = row->priority;
    def.filter = row->filter;
    def.is_fixed = row->is_fixed != 0;
    tl_result result = tl_nav_crowd_add(held->crowd, navmesh, &def, agent, report);
    if (result != TL_OK) {
        *agent = TL_NAV_NO_AGENT;
    }
    return result;
}

// crowd_add(crowd, navmesh, rows, agents u64): agent 0 where no polygon is within reach. All are added, or after an
// error none.
static PyObject *crowd_add(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *navmesh;
    Py_buffer b[2];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "OOy*w*", &capsule, &navmesh, &b[0], &b[1])) {
        return NULL;
    }
    binding_crowd *held = crowd_of(capsule);
    const binding_navmesh *mesh = held != NULL ? binding_navmesh_of(navmesh) : NULL;
    Py_ssize_t count = mesh != NULL ? binding_count(&b[0], sizeof(agent_row), "agents") : -1;
    bool good = count >= 0 && binding_has(&b[1], sizeof(tl_nav_agent), count, false, "names");
    const agent_row *rows = b[0].buf;
    tl_nav_agent *agents = b[1].buf;
    tl_report report = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
    tl_result result = TL_OK;
    Py_ssize_t done = 0;
    while (good && done < count && !tl_is_error(result)) {
        result = add_row(held, mesh->navmesh, &rows[done], &agents[done], &report);
        done++;
    }
    if (tl_is_error(result)) {
        for (Py_ssize_t i = 0; i < done; i++) {
            tl_nav_crowd_remove(held->crowd, agents[i]); // of none nothing is removed
        }
    }
    binding_release(b, 2);
    if (good && tl_is_error(result)) {
        return raise_for(result, &report, done - 1);
    }
    return good ? Py_NewRef(Py_None) : NULL;
}

// --- agents by their names ------------------------------------------------------------------------------------------

// What a function does with each agent of an array.
typedef struct agent_call {
    const char *format; // of the crowd, the names, and the columns
    struct {
        size_t size; // bytes an agent; 0: there is no such column
        bool optional;
        const char *name;
    } columns[2];
    tl_result (*visit)(tl_nav_crowd *crowd, tl_nav_agent agent, void *const columns[2], Py_ssize_t row);
} agent_call;

// Visits agent after agent. The first that fails ends it, and is named.
static PyObject *visit_agents(PyObject *args, const agent_call *call)
{
    PyObject *capsule;
    Py_buffer b[3];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, call->format, &capsule, &b[0], &b[1], &b[2])) {
        return NULL;
    }
    binding_crowd *held = crowd_of(capsule);
    Py_ssize_t count = held != NULL ? binding_count(&b[0], sizeof(tl_nav_agent), "agents") : -1;
    bool good = count >= 0;
    for (int i = 0; good && i < 2 && call->columns[i].size > 0; i++) {
        good = binding_has(&b[i + 1], call->columns[i].size, count, call->columns[i].optional, call->columns[i].name);
    }
    void *const columns[2] = { b[1].buf, b[2].buf };
    tl_result result = TL_OK;
    Py_ssize_t done = 0;
    while (good && done < count && result == TL_OK) {
        result = call->visit(held->crowd, ((const tl_nav_agent *)b[0].buf)[done], columns, done);
        done++;
    }
    binding_release(b, 3);
    if (good && result != TL_OK) {
        return raise_for(result, NULL, done - 1);
    }
    return good ? Py_NewRef(Py_None) : NULL;
}

static tl_result check_agent(tl_nav_crowd *crowd, tl_nav_agent agent, void *const columns[2], Py_ssize_t row)
{
    (void)columns;
    (void)row;
    tl_nav_agent_state state;
    return tl_nav_crowd_agent(crowd, agent, &state);
}

// crowd_check(crowd, agents u64): an error names the first that is not in the crowd
static PyObject *crowd_check(PyObject *self, PyObject *args)
{
    (void)self;
    static const agent_call call = { "Oy*", { { 0, false, NULL } }, check_agent };
    return visit_agents(args, &call);
}

static tl_result remove_agent(tl_nav_crowd *crowd, tl_nav_agent agent, void *const columns[2], Py_ssize_t row)
{
    (void)columns;
    (void)row;
    return tl_nav_crowd_remove(crowd, agent);
}

// crowd_remove(crowd, agents u64)
static PyObject *crowd_remove(PyObject *self, PyObject *args)
{
    (void)self;
    static const agent_call call = { "Oy*", { { 0, false, NULL } }, remove_agent };
    return visit_agents(args, &call);
}

static tl_result set_goal(tl_nav_crowd *crowd, tl_nav_agent agent, void *const columns[2], Py_ssize_t row)
{
    if (columns[0] == NULL || columns[1] == NULL) {
        return tl_nav_crowd_set_goal(crowd, agent, NULL);
    }
    tl_nav_location goal = { ((const tl_nav_ref *)columns[0])[row], ((const tl_vec3 *)columns[1])[row] };
    return goal.polygon != TL_NAV_NO_REF ? tl_nav_crowd_set_goal(crowd, agent, &goal) : TL_OK;
}

// crowd_set_goals(crowd, agents u64, polygons u64 or None, points f32[n][3] or None): polygon 0 leaves the goal as it
// is; None: agents stop
static PyObject *crowd_set_goals(PyObject *self, PyObject *args)
{
    (void)self;
    static const agent_call call = { "Oy*z*z*",
                                     { { sizeof(tl_nav_ref), true, "polygons" }, { sizeof(tl_vec3), true, "points" } },
                                     set_goal };
    return visit_agents(args, &call);
}

static tl_result set_motion(tl_nav_crowd *crowd, tl_nav_agent agent, void *const columns[2], Py_ssize_t row)
{
    return tl_nav_crowd_set_motion(crowd, agent, ((const tl_vec3 *)columns[0])[row],
                                   ((const tl_vec3 *)columns[1])[row]);
}

// crowd_set_motion(crowd, agents u64, positions f32[n][3], velocities f32[n][3])
static PyObject *crowd_set_motion(PyObject *self, PyObject *args)
{
    (void)self;
    static const agent_call call = {
        "Oy*y*y*", { { sizeof(tl_vec3), false, "positions" }, { sizeof(tl_vec3), false, "velocities" } }, set_motion
    };
    return visit_agents(args, &call);
}

static tl_result write_state(tl_nav_crowd *crowd, tl_nav_agent agent, void *const columns[2], Py_ssize_t row)
{
    tl_nav_agent_state s;
    tl_result result = tl_nav_crowd_agent(crowd, agent, &s);
    if (result == TL_OK) {
        ((state_row *)columns[0])[row] = (state_row){ s.polygon, s.link,   s.position, s.velocity,         s.wanted,
                                                      s.goal,    s.radius, s.height,   (uint32_t)s.status, 0 };
    }
    return result;
}

// crowd_states(crowd, agents u64, rows)
static PyObject *crowd_states(PyObject *self, PyObject *args)
{
    (void)self;
    static const agent_call call = { "Oy*w*", { { sizeof(state_row), false, "rows" } }, write_state };
    return visit_agents(args, &call);
}

// --- steps ----------------------------------------------------------------------------------------------------------

// crowd_step(crowd, navmesh, dt, count) -> (searched, waiting, walking, arrived, unreachable, on_link, off_mesh,
// shared) of the last of `count` steps; searched and shared of all of them
static PyObject *crowd_step(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *navmesh;
    float dt = 0;
    unsigned count = 1;
    if (!PyArg_ParseTuple(args, "OOfI", &capsule, &navmesh, &dt, &count)) {
        return NULL;
    }
    binding_crowd *held = crowd_of(capsule);
    const binding_navmesh *mesh = held != NULL ? binding_navmesh_of(navmesh) : NULL;
    if (mesh == NULL) {
        return NULL;
    }
    tl_nav_crowd_step_report report;
    tl_result result = TL_OK;
    unsigned searched = 0;
    unsigned shared = 0;
    for (unsigned done = 0; done < count && result == TL_OK;) {
        PyThreadState *state = PyEval_SaveThread();
        for (unsigned first = done; done < count && done - first < 64 && result == TL_OK; done++) {
            result = tl_nav_crowd_step(held->crowd, mesh->navmesh, dt, &report);
            searched += result == TL_OK ? report.searched : 0;
            shared += result == TL_OK ? report.shared : 0;
        }
        PyEval_RestoreThread(state);
        if (result == TL_OK && PyErr_CheckSignals() != 0) {
            return NULL;
        }
    }
    if (result != TL_OK) {
        tl_report refused = { NULL, "dt", NULL, TL_NO_ELEMENT, "make it > 0 and at most 1 second", 0 };
        return binding_raise(result, &refused);
    }
    return Py_BuildValue("(IIIIIIII)", searched, report.waiting, report.walking, report.arrived, report.unreachable,
                         report.on_link, report.off_mesh, shared);
}

// crowd_agents(crowd) -> bytes: the name of each agent
static PyObject *crowd_agents(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_crowd *held = crowd_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    PyObject *bytes =
        PyBytes_FromStringAndSize(NULL, (Py_ssize_t)tl_nav_crowd_count(held->crowd) * (Py_ssize_t)sizeof(tl_nav_agent));
    if (bytes == NULL) {
        return NULL;
    }
    char *at = PyBytes_AsString(bytes);
    uint32_t cursor = 0;
    for (tl_nav_agent agent; tl_nav_crowd_next(held->crowd, &cursor, &agent); at += sizeof(agent)) {
        memcpy(at, &agent, sizeof(agent));
    }
    return bytes;
}

// crowd_corners(crowd, navmesh, agent) -> bytes: f32[k][3]
static PyObject *crowd_corners(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *navmesh;
    unsigned long long agent = 0;
    if (!PyArg_ParseTuple(args, "OOK", &capsule, &navmesh, &agent)) {
        return NULL;
    }
    const binding_crowd *held = crowd_of(capsule);
    const binding_navmesh *mesh = held != NULL ? binding_navmesh_of(navmesh) : NULL;
    if (mesh == NULL) {
        return NULL;
    }
    enum { MAX_CORNERS = 1025 }; // an agent keeps 1024 polygons at most, and each gives a corner
    tl_nav_corner *corners = malloc(MAX_CORNERS * sizeof(*corners));
    if (corners == NULL) {
        return PyErr_NoMemory();
    }
    uint32_t count = 0;
    tl_result result = tl_nav_crowd_corners(held->crowd, mesh->navmesh, agent, corners, MAX_CORNERS, &count);
    PyObject *bytes = NULL;
    if (tl_is_error(result)) {
        binding_raise(result, NULL);
    } else {
        count = result == TL_NOT_FOUND ? 0 : count < MAX_CORNERS ? count : MAX_CORNERS;
        bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)count * (Py_ssize_t)sizeof(tl_vec3));
        for (uint32_t i = 0; bytes != NULL && i < count; i++) {
            memcpy(PyBytes_AsString(bytes) + i * sizeof(tl_vec3), &corners[i].point, sizeof(tl_vec3));
        }
    }
    free(corners);
    return bytes;
}

// crowd_save(crowd) -> bytes
static PyObject *crowd_save(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_crowd *held = crowd_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    size_t size = tl_nav_crowd_state_size(held->crowd);
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)size);
    tl_result result = bytes != NULL ? tl_nav_crowd_save(held->crowd, PyBytes_AsString(bytes), size) : TL_OK;
    if (result != TL_OK) {
        Py_DECREF(bytes);
        return binding_raise(result, NULL);
    }
    return bytes;
}

// crowd_restore(crowd, bytes)
static PyObject *crowd_restore(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer b = { 0 };
    if (!PyArg_ParseTuple(args, "Oy*", &capsule, &b)) {
        return NULL;
    }
    binding_crowd *held = crowd_of(capsule);
    void *copy = held != NULL ? malloc(b.len > 0 ? (size_t)b.len : 1) : NULL; // aligned, whatever was given
    if (copy != NULL) {
        memcpy(copy, b.buf, (size_t)b.len);
        tl_report report;
        tl_result result = tl_nav_crowd_restore(held->crowd, copy, (size_t)b.len, &report);
        if (result != TL_OK) {
            binding_raise(result, &report);
        }
    } else if (held != NULL) {
        PyErr_NoMemory();
    }
    free(copy);
    binding_release(&b, 1);
    return PyErr_Occurred() ? NULL : Py_NewRef(Py_None);
}

// crowd_hash(crowd) -> int
static PyObject *crowd_hash(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_crowd *held = crowd_of(capsule);
    return held != NULL ? PyLong_FromUnsignedLongLong(tl_nav_crowd_hash(held->crowd)) : NULL;
}

// crowd_status_names() -> list, by number
static PyObject *crowd_status_names(PyObject *self, PyObject *none)
{
    (void)self;
    (void)none;
    PyObject *names = PyList_New(0);
    for (int status = 0; names != NULL && status <= (int)TL_NAV_AGENT_FIXED; status++) {
        PyObject *name = PyUnicode_FromString(tl_nav_agent_status_name((tl_nav_agent_status)status));
        if (name == NULL || PyList_Append(names, name) != 0) {
            Py_CLEAR(names);
        }
        Py_XDECREF(name);
    }
    return names;
}

PyMethodDef binding_crowd_methods[] = {
    { "crowd_create", crowd_create, METH_VARARGS, NULL },
    { "crowd_set_filter", crowd_set_filter, METH_VARARGS, NULL },
    { "crowd_add", crowd_add, METH_VARARGS, NULL },
    { "crowd_check", crowd_check, METH_VARARGS, NULL },
    { "crowd_remove", crowd_remove, METH_VARARGS, NULL },
    { "crowd_set_goals", crowd_set_goals, METH_VARARGS, NULL },
    { "crowd_set_motion", crowd_set_motion, METH_VARARGS, NULL },
    { "crowd_step", crowd_step, METH_VARARGS, NULL },
    { "crowd_agents", crowd_agents, METH_O, NULL },
    { "crowd_states", crowd_states, METH_VARARGS, NULL },
    { "crowd_corners", crowd_corners, METH_VARARGS, NULL },
    { "crowd_save", crowd_save, METH_O, NULL },
    { "crowd_restore", crowd_restore, METH_VARARGS, NULL },
    { "crowd_hash", crowd_hash, METH_O, NULL },
    { "crowd_status_names", crowd_status_names, METH_NOARGS, NULL },
    { NULL, NULL, 0, NULL },
};
