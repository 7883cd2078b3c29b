// SPDX-License-Identifier: MIT
//
// Audit and why: a navmesh checked against its triangles, and the reason why a point is not walkable.

#include "binding.h"

#include <math.h>
#include <string.h>

static PyObject *finding_of(const tl_nav_finding *f)
{
    PyObject *triangle = f->triangle == TL_NO_TRIANGLE ? Py_NewRef(Py_None) : PyLong_FromUnsignedLong(f->triangle);
    return Py_BuildValue("sN(fff)(fff)fIf", tl_nav_finding_name(f->kind), triangle, f->point.x, f->point.y, f->point.z,
                         f->contact.x, f->contact.y, f->contact.z, f->depth, f->count, f->area);
}

// navmesh_audit(navmesh, soup, level or None, path count, seed, threads, progress) -> (findings, dict)
// Triangles of areas are those of the soup, so areas are by triangle of the view that both were baked from.
static PyObject *navmesh_audit(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *soup_capsule;
    PyObject *level_tuple;
    PyObject *progress;
    unsigned paths = 0;
    unsigned long long seed = 0;
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "OOOIKIO", &capsule, &soup_capsule, &level_tuple, &paths, &seed, &threads, &progress)) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    const tl_soup *soup = held != NULL ? binding_blob_of(soup_capsule, BINDING_SOUP) : NULL;
    binding_level level;
    memset(&level, 0, sizeof(level));
    if (soup == NULL || (level_tuple != Py_None && !binding_level_take(level_tuple, &level))) {
        binding_level_free(&level);
        return NULL;
    }
    tl_nav_audit_def def = tl_default_nav_audit_def();
    def.nav = held->def;
    def.pruned = held->removed;
    def.path_count = paths;
    def.seed = seed;
    def.areas = level.buffers[2].buf;
    def.volumes = level.volumes;
    def.volume_count = level.input.volume_count;
    tl_nav_audit audit;
    tl_report report;
    binding_host host;
    binding_begin(&host, progress, threads);
    def.host = host.host;
    tl_result result = tl_nav_audit_run(&def, held->navmesh, soup, &audit, &report);
    binding_end(&host);
    binding_level_free(&level);
    if (result != TL_OK) {
        return binding_raise(result, &report);
    }
    PyObject *list = PyList_New(0);
    for (uint32_t i = 0; list != NULL && i < audit.finding_count; i++) {
        PyObject *item = finding_of(&audit.findings[i]);
        if (item == NULL || PyList_Append(list, item) != 0) {
            Py_CLEAR(list);
        }
        Py_XDECREF(item);
    }
    PyObject *answer =
        list == NULL
            ? NULL
            : Py_BuildValue("N{sKsdsKsKsKsKsd}", list, "path_count", (unsigned long long)audit.path_count,
                            "path_metres", audit.path_metres, "polygon_count", (unsigned long long)audit.polygon_count,
                            "portal_count", (unsigned long long)audit.portal_count, "step_count",
                            (unsigned long long)audit.step_count, "floor_samples",
                            (unsigned long long)audit.floor_samples, "missing_area", audit.missing_area);
    tl_nav_audit_free(&audit);
    return answer;
}

static PyObject *reason_of(const tl_nav_reason *r)
{
    return Py_BuildValue("sszzfff", tl_nav_cause_name(r->cause), tl_nav_cause_text(r->cause), r->stage, r->parameter,
                         r->value, r->needed, r->measured);
}

// navmesh_why(navmesh, level, (point), progress) -> (walkable, floor, reasons, proven, needed settings, apart,
//                                                    island area, largest island area)
static PyObject *navmesh_why(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *level_tuple;
    PyObject *progress;
    tl_vec3 point;
    if (!PyArg_ParseTuple(args, "OO(fff)O", &capsule, &level_tuple, &point.x, &point.y, &point.z, &progress)) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    binding_level level;
    memset(&level, 0, sizeof(level));
    if (held == NULL || !binding_level_take(level_tuple, &level)) {
        binding_level_free(&level);
        return NULL;
    }
    tl_nav_def def = held->def;
    const tl_nav_pruning pruning = { held->removed, held->pruning != NULL ? held->pruning->min_area : 0.0 };
    tl_nav_why_answer why;
    tl_report report;
    binding_host host;
    binding_begin(&host, progress, 1);
    def.host = host.host;
    tl_result result =
        tl_nav_why(&def, &level.input, held->navmesh, held->removed != NULL ? &pruning : NULL, point, &why, &report);
    binding_end(&host);
    binding_level_free(&level);
    if (result != TL_OK) {
        return binding_raise(result, &report);
    }
    PyObject *reasons = PyList_New(0);
    for (uint32_t i = 0; reasons != NULL && i < why.reason_count; i++) {
        PyObject *item = reason_of(&why.reasons[i]);
        if (item == NULL || PyList_Append(reasons, item) != 0) {
            Py_CLEAR(reasons);
        }
        Py_XDECREF(item);
    }
    PyObject *needed = reasons != NULL ? binding_nav_def_dict(&why.needed) : NULL;
    if (needed == NULL) {
        Py_XDECREF(reasons);
        return NULL;
    }
    return Py_BuildValue("N(fff)NNNNff", PyBool_FromLong(why.walkable), why.floor.x, why.floor.y, why.floor.z, reasons,
                         PyBool_FromLong(why.proven), needed, PyBool_FromLong(why.apart), why.island_area,
                         why.largest_island_area);
}

PyMethodDef binding_audit_methods[] = {
    { "navmesh_audit", navmesh_audit, METH_VARARGS, NULL },
    { "navmesh_why", navmesh_why, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
