// SPDX-License-Identifier: MIT
//
// Convex hulls: baking, what they are made of, and queries.

#include "binding.h"

#include <string.h>

static const tl_hull *hull_of(PyObject *capsule)
{
    return binding_blob_of(capsule, BINDING_HULL);
}

// hull_bake(points, max_vertices, tolerance, thickness, flatness, weld distance, merge distance, progress)
// -> (capsule, points left out, metres outside)
static PyObject *hull_bake(PyObject *self, PyObject *args)
{
    (void)self;
    Py_buffer points;
    PyObject *progress;
    tl_hull_def def = tl_default_hull_def();
    if (!PyArg_ParseTuple(args, "y*IfffffO", &points, &def.max_vertices, &def.tolerance, &def.thickness, &def.flatness,
                          &def.weld_distance, &def.merge_distance, &progress)) {
        return NULL;
    }
    Py_ssize_t count = binding_count(&points, sizeof(tl_vec3), "points");
    tl_hull *hull = NULL;
    tl_hull_report report;
    if (count > TL_MAX_HULL_POINTS) {
        binding_raise(TL_ERR_LIMIT, NULL);
    } else if (count >= 0) {
        binding_host host;
        binding_begin(&host, progress, 1);
        def.host = host.host;
        tl_result result = tl_hull_bake(points.buf, (uint32_t)count, &def, &hull, &report);
        binding_end(&host);
        if (result != TL_OK) {
            binding_raise(result, &report.base);
        }
    }
    PyBuffer_Release(&points);
    PyObject *capsule = hull != NULL ? binding_blob_capsule(hull, NULL, BINDING_HULL) : NULL;
    return capsule != NULL ? Py_BuildValue("NId", capsule, report.points_left_out, report.max_outside) : NULL;
}

// hull_transform(hull, (sx, sy, sz), pose bytes) -> capsule
static PyObject *hull_transform(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    tl_vec3 scale;
    Py_buffer pose;
    if (!PyArg_ParseTuple(args, "O(fff)y*", &capsule, &scale.x, &scale.y, &scale.z, &pose)) {
        return NULL;
    }
    const tl_hull *hull = hull_of(capsule);
    tl_hull *copy = NULL;
    if (hull != NULL && binding_has(&pose, sizeof(tl_transform), 1, false, "pose")) {
        tl_transform at;
        memcpy(&at, pose.buf, sizeof(at));
        tl_hull_report report;
        tl_result result = tl_hull_transform(hull, scale, at, NULL, &copy, &report);
        if (result != TL_OK) {
            binding_raise(result, &report.base);
        }
    }
    PyBuffer_Release(&pose);
    return copy != NULL ? binding_blob_capsule(copy, NULL, BINDING_HULL) : NULL;
}

static PyObject *bytes_of(const void *from, size_t size)
{
    return PyBytes_FromStringAndSize(from, (Py_ssize_t)size);
}

// hull_parts(hull) -> dict: vertices, sources, half-edge origins, faces (first, count), planes, mass
static PyObject *hull_parts(PyObject *self, PyObject *capsule)
{
    (void)self;
    const tl_hull *hull = hull_of(capsule);
    if (hull == NULL) {
        return NULL;
    }
    PyObject *sources = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)hull->vertex_count * 4);
    PyObject *origins = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)hull->half_edge_count * 4);
    PyObject *faces = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)(hull->face_count * sizeof(tl_hull_face)));
    PyObject *planes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)(hull->face_count * sizeof(tl_hull_plane)));
    if (sources == NULL || origins == NULL || faces == NULL || planes == NULL) {
        Py_XDECREF(sources);
        Py_XDECREF(origins);
        Py_XDECREF(faces);
        Py_XDECREF(planes);
        return NULL;
    }
    uint32_t *source = (uint32_t *)(void *)PyBytes_AsString(sources);
    for (uint32_t i = 0; i < hull->vertex_count; i++) {
        source[i] = tl_hull_source(hull, i);
    }
    uint32_t *origin = (uint32_t *)(void *)PyBytes_AsString(origins);
    for (uint32_t i = 0; i < hull->half_edge_count; i++) {
        origin[i] = tl_hull_edge_origin(hull, i);
    }
    for (uint32_t i = 0; i < hull->face_count; i++) {
        tl_hull_face face = tl_hull_face_at(hull, i);
        tl_hull_plane plane = tl_hull_face_plane(hull, i);
        memcpy(PyBytes_AsString(faces) + i * sizeof(face), &face, sizeof(face));
        memcpy(PyBytes_AsString(planes) + i * sizeof(plane), &plane, sizeof(plane));
    }
    return Py_BuildValue("{sNsNsNsNsNsN}", "vertices",
                         bytes_of(tl_hull_vertices(hull), hull->vertex_count * sizeof(tl_vec3)), "sources", sources,
                         "origins", origins, "faces", faces, "planes", planes, "mass",
                         bytes_of(&hull->mass, sizeof(hull->mass)));
}

// hull_contains(hull, points, inside u8)
static PyObject *hull_contains(PyObject *self, PyObject *args)
{
    (void)self;
    binding_items items;
    const tl_hull *hull = NULL;
    if (binding_take_items(args, sizeof(tl_vec3), 1, &items) && (hull = hull_of(items.capsule)) != NULL) {
        for (Py_ssize_t i = 0; i < items.count; i++) {
            ((uint8_t *)items.out.buf)[i] = tl_hull_contains(hull, ((const tl_vec3 *)items.in.buf)[i]);
        }
    }
    return binding_end_items(&items, hull != NULL);
}

// hull_support(hull, directions, vertices u32): each query starts from the answer before
static PyObject *hull_support(PyObject *self, PyObject *args)
{
    (void)self;
    binding_items items;
    const tl_hull *hull = NULL;
    if (binding_take_items(args, sizeof(tl_vec3), sizeof(uint32_t), &items) &&
        (hull = hull_of(items.capsule)) != NULL) {
        uint32_t hint = TL_NO_VERTEX;
        for (Py_ssize_t i = 0; i < items.count; i++) {
            hint = tl_hull_support(hull, ((const tl_vec3 *)items.in.buf)[i], hint);
            ((uint32_t *)items.out.buf)[i] = hint;
        }
    }
    return binding_end_items(&items, hull != NULL);
}

PyMethodDef binding_hull_methods[] = {
    { "hull_bake", hull_bake, METH_VARARGS, NULL },       { "hull_transform", hull_transform, METH_VARARGS, NULL },
    { "hull_parts", hull_parts, METH_O, NULL },           { "hull_contains", hull_contains, METH_VARARGS, NULL },
    { "hull_support", hull_support, METH_VARARGS, NULL }, { NULL, NULL, 0, NULL },
};
