// SPDX-License-Identifier: MIT
//
// Groups of a crowd: agents that follow a leader, in a formation or loosely.

#include "binding.h"

#include <string.h>

// How a group walks, as Python gives it: (formation, spacing, wait distance, lost distance, slots f32[n][2], keep
// order).
typedef struct group_plan {
    tl_nav_group_def def;
    Py_buffer slots;
} group_plan;

// False: an exception is set. Release the slots in either case.
static bool take_plan(PyObject *tuple, group_plan *plan)
{
    memset(plan, 0, sizeof(*plan));
    plan->def = tl_default_nav_group_def();
    int formation = 0;
    int keep_order = 0;
    if (!PyArg_ParseTuple(tuple, "ifffy*p", &formation, &plan->def.spacing, &plan->def.wait_distance,
                          &plan->def.lost_distance, &plan->slots, &keep_order)) {
        return false;
    }
    plan->def.formation = (tl_nav_formation)formation;
    plan->def.slots = plan->slots.len > 0 ? plan->slots.buf : NULL;
    plan->def.keep_order = keep_order != 0;
    return true;
}

// Slots are a row for each agent but the leader; what has no slots of its own ignores them.
static bool has_slots(const group_plan *plan, Py_ssize_t agents)
{
    return plan->def.formation != TL_NAV_FORMATION_SLOTS ||
           binding_has(&plan->slots, sizeof(tl_nav_formation_slot), agents - 1, false, "slots");
}

// crowd_formation_names() -> tuple
static PyObject *crowd_formation_names(PyObject *self, PyObject *args)
{
    (void)self;
    (void)args;
    PyObject *names = PyTuple_New(TL_NAV_FORMATION_SLOTS + 1);
    for (int i = 0; names != NULL && i <= TL_NAV_FORMATION_SLOTS; i++) {
        PyObject *name = PyUnicode_FromString(tl_nav_formation_name((tl_nav_formation)i));
        if (name == NULL || PyTuple_SetItem(names, i, name) != 0) {
            Py_CLEAR(names);
        }
    }
    return names;
}

// crowd_add_group(crowd, agents u64, plan) -> group
static PyObject *crowd_add_group(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *tuple;
    Py_buffer agents;
    if (!PyArg_ParseTuple(args, "Oy*O!", &capsule, &agents, &PyTuple_Type, &tuple)) {
        return NULL;
    }
    tl_nav_crowd *crowd = binding_crowd_of(capsule);
    Py_ssize_t count = crowd != NULL ? binding_count(&agents, sizeof(tl_nav_agent), "agents") : -1;
    group_plan plan = { .slots = { 0 } };
    PyObject *made = NULL;
    if (count >= 0 && take_plan(tuple, &plan) && has_slots(&plan, count)) {
        tl_nav_group group;
        tl_report report = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
        tl_result result = tl_nav_crowd_add_group(crowd, &plan.def, agents.buf, (uint32_t)count, &group, &report);
        made = result == TL_OK ? PyLong_FromUnsignedLongLong(group) : binding_raise(result, &report);
    }
    binding_release(&plan.slots, 1);
    PyBuffer_Release(&agents);
    return made;
}

// crowd_set_formation(crowd, group, plan)
static PyObject *crowd_set_formation(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *tuple;
    unsigned long long group = 0;
    if (!PyArg_ParseTuple(args, "OKO!", &capsule, &group, &PyTuple_Type, &tuple)) {
        return NULL;
    }
    tl_nav_crowd *crowd = binding_crowd_of(capsule);
    if (crowd == NULL) {
        return NULL;
    }
    tl_nav_group_state state;
    tl_result result = tl_nav_crowd_group(crowd, group, &state);
    if (result != TL_OK) {
        return binding_raise(result, NULL);
    }
    group_plan plan;
    PyObject *done = NULL;
    if (take_plan(tuple, &plan) && has_slots(&plan, state.count)) {
        tl_report report = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
        result = tl_nav_crowd_set_formation(crowd, group, &plan.def, &report);
        done = result == TL_OK ? Py_NewRef(Py_None) : binding_raise(result, &report);
    }
    binding_release(&plan.slots, 1);
    return done;
}

// crowd_remove_group(crowd, group)
static PyObject *crowd_remove_group(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    unsigned long long group = 0;
    if (!PyArg_ParseTuple(args, "OK", &capsule, &group)) {
        return NULL;
    }
    tl_nav_crowd *crowd = binding_crowd_of(capsule);
    if (crowd == NULL) {
        return NULL;
    }
    tl_result result = tl_nav_crowd_remove_group(crowd, group);
    return result == TL_OK ? Py_NewRef(Py_None) : binding_raise(result, NULL);
}

// crowd_group(crowd, group) -> (formation, in place, on trail, lag, speed, (heading), bytes of the agents)
static PyObject *crowd_group(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    unsigned long long group = 0;
    if (!PyArg_ParseTuple(args, "OK", &capsule, &group)) {
        return NULL;
    }
    const tl_nav_crowd *crowd = binding_crowd_of(capsule);
    tl_nav_group_state s;
    tl_result result = crowd != NULL ? tl_nav_crowd_group(crowd, group, &s) : TL_ERR_ARGUMENT;
    if (result != TL_OK) {
        return binding_raise(result, NULL);
    }
    PyObject *agents = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)s.count * (Py_ssize_t)sizeof(tl_nav_agent));
    if (agents == NULL) {
        return NULL;
    }
    uint32_t count = 0;
    tl_nav_crowd_members(crowd, group, (tl_nav_agent *)(void *)PyBytes_AsString(agents), s.count, &count);
    return Py_BuildValue("(iIIff(fff)N)", (int)s.formation, s.in_place, s.on_trail, s.lag, s.speed, s.heading.x,
                         s.heading.y, s.heading.z, agents);
}

// crowd_groups_of(crowd, agents u64, groups u64, follows u8): 0 for agents of none; whether another one leads it
static PyObject *crowd_groups_of(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer b[3];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "Oy*w*w*", &capsule, &b[0], &b[1], &b[2])) {
        return NULL;
    }
    const tl_nav_crowd *crowd = binding_crowd_of(capsule);
    Py_ssize_t count = crowd != NULL ? binding_count(&b[0], sizeof(tl_nav_agent), "agents") : -1;
    bool good = count >= 0 && binding_has(&b[1], sizeof(tl_nav_group), count, false, "groups") &&
                binding_has(&b[2], 1, count, false, "follows");
    for (Py_ssize_t i = 0; good && i < count; i++) {
        const tl_nav_agent agent = ((const tl_nav_agent *)b[0].buf)[i];
        const tl_nav_group group = tl_nav_crowd_group_of(crowd, agent);
        tl_nav_group_state state;
        ((tl_nav_group *)b[1].buf)[i] = group;
        ((uint8_t *)b[2].buf)[i] = tl_nav_crowd_group(crowd, group, &state) == TL_OK && state.leader != agent;
    }
    binding_release(b, 3);
    return good ? Py_NewRef(Py_None) : NULL;
}

PyMethodDef binding_group_methods[] = {
    { "crowd_formation_names", crowd_formation_names, METH_NOARGS, NULL },
    { "crowd_add_group", crowd_add_group, METH_VARARGS, NULL },
    { "crowd_set_formation", crowd_set_formation, METH_VARARGS, NULL },
    { "crowd_remove_group", crowd_remove_group, METH_VARARGS, NULL },
    { "crowd_group", crowd_group, METH_VARARGS, NULL },
    { "crowd_groups_of", crowd_groups_of, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
