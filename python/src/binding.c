// SPDX-License-Identifier: MIT
//
// Errors, buffers and blobs between C and Python.

#include "binding.h"

#include <stdlib.h>
#include <string.h>

static PyObject *error_class; // of the package; lives as long as the module

PyObject *binding_set_error_class(PyObject *module, PyObject *new_class)
{
    (void)module;
    Py_INCREF(new_class);
    Py_XDECREF(error_class);
    error_class = new_class;
    Py_RETURN_NONE;
}

PyObject *binding_raise(tl_result result, const tl_report *report)
{
    if (PyErr_Occurred() != NULL) {
        return NULL;
    }
    if (result == TL_ERR_MEMORY) {
        return PyErr_NoMemory();
    }
    tl_report none = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
    report = report != NULL ? report : &none;
    PyObject *index = report->element != NULL && report->element_index != TL_NO_ELEMENT
                          ? PyLong_FromUnsignedLongLong(report->element_index)
                          : Py_NewRef(Py_None);
    if (index == NULL) {
        return NULL;
    }
    PyObject *error = PyObject_CallFunction(error_class, "ssszzOz", tl_result_name(result), tl_result_text(result),
                                            report->stage != NULL ? report->stage : "", report->field, report->element,
                                            index, report->advice);
    Py_DECREF(index);
    if (error != NULL) {
        PyErr_SetObject(error_class, error);
        Py_DECREF(error);
    }
    return NULL;
}

Py_ssize_t binding_count(const Py_buffer *buffer, size_t size, const char *name)
{
    if ((size_t)buffer->len % size != 0) {
        PyErr_Format(PyExc_ValueError, "%s: %zd bytes are no whole number of items of %zu", name, buffer->len, size);
        return -1;
    }
    return buffer->len / (Py_ssize_t)size;
}

bool binding_has(const Py_buffer *buffer, size_t size, Py_ssize_t count, bool optional, const char *name)
{
    if (buffer->buf == NULL && optional) {
        return true;
    }
    if (buffer->len != count * (Py_ssize_t)size) {
        PyErr_Format(PyExc_ValueError, "%s has %zd bytes, and should have %zd", name, buffer->len,
                     count * (Py_ssize_t)size);
        return false;
    }
    return true;
}

void binding_release(Py_buffer *buffers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (buffers[i].obj != NULL) {
            PyBuffer_Release(&buffers[i]);
        }
    }
}

bool binding_take_items(PyObject *args, size_t in_size, size_t out_size, binding_items *items)
{
    memset(items, 0, sizeof(*items));
    if (!PyArg_ParseTuple(args, "Oy*w*", &items->capsule, &items->in, &items->out)) {
        return false;
    }
    items->count = binding_count(&items->in, in_size, "input");
    return items->count >= 0 && binding_has(&items->out, out_size, items->count, false, "output");
}

PyObject *binding_end_items(binding_items *items, bool answered)
{
    binding_release(&items->in, 1);
    binding_release(&items->out, 1);
    return answered ? Py_NewRef(Py_None) : NULL;
}

bool binding_mesh_view(const Py_buffer *vertices, const Py_buffer *indices, const Py_buffer *materials,
                       tl_mesh_view *view)
{
    Py_ssize_t vertex_count = binding_count(vertices, sizeof(tl_vec3), "vertices");
    Py_ssize_t triangle_count = binding_count(indices, 3 * sizeof(uint32_t), "faces");
    if (vertex_count < 0 || triangle_count < 0 ||
        !binding_has(materials, sizeof(uint16_t), triangle_count, true, "materials")) {
        return false;
    }
    if (vertex_count > TL_MAX_MESH_VERTICES || triangle_count > TL_MAX_MESH_TRIANGLES) {
        PyErr_SetString(PyExc_ValueError, "the mesh has more vertices or triangles than a talus mesh may have");
        return false;
    }
    *view =
        (tl_mesh_view){ vertices->buf, (uint32_t)vertex_count, indices->buf, (uint32_t)triangle_count, materials->buf };
    return true;
}

static void free_blob_capsule(PyObject *capsule)
{
    binding_blob *held = PyCapsule_GetPointer(capsule, PyCapsule_GetName(capsule));
    if (held->owner != NULL) {
        Py_DECREF(held->owner);
    } else {
        tl_blob_free(held->blob);
    }
    free(held);
}

PyObject *binding_blob_capsule(void *blob, PyObject *owner, const char *name)
{
    binding_blob *held = malloc(sizeof(*held));
    PyObject *capsule = held != NULL ? PyCapsule_New(held, name, free_blob_capsule) : PyErr_NoMemory();
    if (capsule == NULL) {
        free(held);
        if (owner == NULL) {
            tl_blob_free(blob);
        }
        return NULL;
    }
    held->blob = blob;
    held->owner = Py_XNewRef(owner);
    return capsule;
}

void *binding_blob_of(PyObject *capsule, const char *name)
{
    binding_blob *held = PyCapsule_GetPointer(capsule, name);
    return held != NULL ? held->blob : NULL;
}
