// SPDX-License-Identifier: MIT
//
// Decomposition of a mesh into convex parts.

#include "binding.h"

#include <string.h>

// (hull, concavity, metres outside); the hull is the capsule's from now on.
static PyObject *take_part(tl_convex_part *part)
{
    PyObject *capsule = binding_blob_capsule(part->hull, NULL, BINDING_HULL);
    part->hull = NULL;
    return capsule != NULL ? Py_BuildValue("Ndd", capsule, part->concavity, part->max_outside) : NULL;
}

static PyObject *take_parts(tl_decomposition *body)
{
    PyObject *parts = PyList_New((Py_ssize_t)body->part_count);
    for (uint32_t i = 0; parts != NULL && i < body->part_count; i++) {
        PyObject *part = take_part(&body->parts[i]);
        if (part == NULL || PyList_SetItem(parts, (Py_ssize_t)i, part) != 0) {
            Py_CLEAR(parts);
        }
    }
    return parts;
}

// decompose(vertices, faces, tolerance, relative tolerance, max parts, max vertices, thickness, solid, max cells,
// threads, progress) -> (list of parts, tolerance, cell, degenerate triangles, parts over the tolerance)
static PyObject *decompose(PyObject *self, PyObject *args)
{
    (void)self;
    Py_buffer buffers[2], none;
    memset(buffers, 0, sizeof(buffers));
    memset(&none, 0, sizeof(none));
    tl_decompose_def def = tl_default_decompose_def();
    int solid;
    unsigned threads;
    PyObject *progress;
    if (!PyArg_ParseTuple(args, "y*y*ffIIfiIIO", &buffers[0], &buffers[1], &def.tolerance, &def.relative_tolerance,
                          &def.max_parts, &def.max_vertices, &def.thickness, &solid, &def.max_cells, &threads,
                          &progress)) {
        return NULL;
    }
    tl_mesh_view view;
    tl_decomposition body;
    tl_decompose_report report;
    PyObject *answer = NULL;
    if (binding_mesh_view(&buffers[0], &buffers[1], &none, &view)) {
        binding_host host;
        def.solid = (tl_solid_rule)solid;
        binding_begin(&host, progress, threads);
        def.host = host.host;
        tl_result result = tl_decomposition_bake(&view, &def, &body, &report);
        binding_end(&host);
        PyObject *parts = result == TL_OK ? take_parts(&body) : binding_raise(result, &report.base);
        tl_decomposition_free(&body);
        if (parts != NULL) {
            answer = Py_BuildValue("NddII", parts, (double)report.tolerance, (double)report.cell,
                                   report.degenerate_triangles, report.parts_over_tolerance);
        }
    }
    binding_release(buffers, 2);
    return answer;
}

PyMethodDef binding_decompose_methods[] = {
    { "decompose", decompose, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
