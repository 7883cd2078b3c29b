// SPDX-License-Identifier: MIT
//
// Convex shapes and queries on pairs of them. Poses are arrays of tl_transform: quaternion x, y, z, w, then position.

#include "binding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void free_shape(PyObject *capsule)
{
    binding_shape *shape = PyCapsule_GetPointer(capsule, BINDING_SHAPE);
    free(shape->points);
    Py_XDECREF(shape->owner);
    free(shape);
}

const tl_convex *binding_shape_of(PyObject *capsule)
{
    binding_shape *shape = PyCapsule_GetPointer(capsule, BINDING_SHAPE);
    return shape != NULL ? &shape->convex : NULL;
}

// shape(kind, points f32[n][3], numbers f32: disc radius, radius; hull or None) -> capsule
// kinds: hull, points, sphere, capsule, box, triangle, cylinder, cone
static PyObject *make_shape(PyObject *self, PyObject *args)
{
    (void)self;
    const char *kind;
    Py_buffer points;
    float disc_radius = 0.0f;
    float radius = 0.0f;
    PyObject *hull_capsule;
    if (!PyArg_ParseTuple(args, "sy*ffO", &kind, &points, &disc_radius, &radius, &hull_capsule)) {
        return NULL;
    }
    Py_ssize_t count = binding_count(&points, sizeof(tl_vec3), "points");
    binding_shape *shape = count >= 0 ? calloc(1, sizeof(*shape)) : NULL;
    if (shape == NULL) {
        PyBuffer_Release(&points);
        return count < 0 ? NULL : PyErr_NoMemory();
    }
    const tl_vec3 *p = points.buf;
    bool good = true;
    if (strcmp(kind, "hull") == 0) {
        const tl_hull *hull = binding_blob_of(hull_capsule, BINDING_HULL);
        good = hull != NULL;
        if (good) {
            shape->convex = tl_convex_from_hull(hull, radius);
            shape->owner = Py_NewRef(hull_capsule);
        }
    } else if (strcmp(kind, "points") == 0 && count >= 1 && count <= TL_MAX_HULL_POINTS) {
        shape->points = malloc((size_t)points.len);
        good = shape->points != NULL;
        if (good) {
            memcpy(shape->points, p, (size_t)points.len);
            shape->convex = tl_convex_from_points(shape->points, (uint32_t)count, radius);
        } else {
            PyErr_NoMemory();
        }
    } else if (strcmp(kind, "sphere") == 0 && count == 1) {
        shape->convex = tl_convex_sphere(p[0], radius);
    } else if (strcmp(kind, "capsule") == 0 && count == 2) {
        shape->convex = tl_convex_capsule(p[0], p[1], radius);
    } else if (strcmp(kind, "box") == 0 && count == 2) {
        shape->convex = tl_convex_box(p[0], p[1], radius);
    } else if (strcmp(kind, "triangle") == 0 && count == 3) {
        shape->convex = tl_convex_triangle(p[0], p[1], p[2], radius);
    } else if (strcmp(kind, "cylinder") == 0 && count == 2) {
        shape->convex = tl_convex_cylinder(p[0], p[1], disc_radius, radius);
    } else if (strcmp(kind, "cone") == 0 && count == 2) {
        shape->convex = tl_convex_cone(p[0], p[1], disc_radius, radius);
    } else {
        good = false;
        PyErr_Format(PyExc_ValueError, "no %s can be made of %zd points", kind, count);
    }
    PyBuffer_Release(&points);
    PyObject *capsule = good ? PyCapsule_New(shape, BINDING_SHAPE, free_shape) : NULL;
    if (capsule == NULL) {
        free(shape->points);
        Py_XDECREF(shape->owner);
        free(shape);
    }
    return capsule;
}

// shape_bounds(shape, pose) -> (min, max)
static PyObject *shape_bounds(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer pose;
    if (!PyArg_ParseTuple(args, "Oy*", &capsule, &pose)) {
        return NULL;
    }
    const tl_convex *shape = binding_shape_of(capsule);
    PyObject *result = NULL;
    if (shape != NULL && binding_has(&pose, sizeof(tl_transform), 1, false, "pose")) {
        tl_transform at;
        memcpy(&at, pose.buf, sizeof(at));
        tl_aabb box = tl_convex_bounds(shape, at);
        result = Py_BuildValue("(fff)(fff)", box.min.x, box.min.y, box.min.z, box.max.x, box.max.y, box.max.z);
    }
    PyBuffer_Release(&pose);
    return result;
}

// What a query of pairs writes, an item a pose.
typedef struct pair_results {
    float *values;     // distance, depth, or t
    float *bounds;     // of the distance or depth; the gap of a cast
    uint8_t *overlaps; // or whether a cast hit
    tl_vec3 *points_a; // of a cast: where
    tl_vec3 *points_b;
    tl_vec3 *normals;
    uint8_t *statuses;
} pair_results;

typedef struct pair_batch {
    const tl_convex *a;
    const tl_convex *b;
    const tl_transform *poses_a;
    const tl_transform *poses_b;
    const tl_vec3 *motions; // of a cast
    Py_ssize_t count;
} pair_batch;

static void find_distances(const pair_batch *batch, const pair_results *out)
{
    tl_simplex_cache cache = { 0 };
    for (Py_ssize_t i = 0; i < batch->count; i++) {
        tl_separation found;
        tl_convex_distance(batch->a, batch->poses_a[i], batch->b, batch->poses_b[i], &cache, &found);
        out->values[i] = found.distance;
        out->bounds[i] = found.lower_bound;
        out->overlaps[i] = found.overlap;
        out->points_a[i] = found.point_a;
        out->points_b[i] = found.point_b;
        out->normals[i] = found.normal;
        out->statuses[i] = (uint8_t)found.status;
    }
}

static void find_penetrations(const pair_batch *batch, const pair_results *out)
{
    tl_simplex_cache cache = { 0 };
    for (Py_ssize_t i = 0; i < batch->count; i++) {
        tl_penetration found;
        tl_convex_penetration(batch->a, batch->poses_a[i], batch->b, batch->poses_b[i], &cache, &found);
        out->values[i] = found.depth;
        out->bounds[i] = found.lower_bound;
        out->overlaps[i] = found.overlap;
        out->points_a[i] = found.point_a;
        out->points_b[i] = found.point_b;
        out->normals[i] = found.normal;
        out->statuses[i] = (uint8_t)found.status;
    }
}

static void cast_shapes(const pair_batch *batch, const pair_results *out)
{
    for (Py_ssize_t i = 0; i < batch->count; i++) {
        tl_convex_hit found;
        tl_convex_cast(batch->a, batch->poses_a[i], batch->b, batch->poses_b[i], batch->motions[i], &found);
        out->values[i] = found.hit ? found.t : INFINITY;
        out->bounds[i] = found.gap;
        out->overlaps[i] = found.hit;
        out->points_a[i] = found.point;
        out->points_b[i] = found.point;
        out->normals[i] = found.normal;
        out->statuses[i] = (uint8_t)found.status;
    }
}

// shape_pairs(kind, a, poses_a, b, poses_b, motions or None, values, bounds, overlaps, points_a, points_b, normals,
//             statuses): kind 0 distance, 1 penetration, 2 cast
static PyObject *shape_pairs(PyObject *self, PyObject *args)
{
    (void)self;
    int kind = 0;
    PyObject *a;
    PyObject *b;
    Py_buffer in[3];
    Py_buffer out[7];
    memset(in, 0, sizeof(in));
    memset(out, 0, sizeof(out));
    if (!PyArg_ParseTuple(args, "iOy*Oy*z*w*w*w*w*w*w*w*", &kind, &a, &in[0], &b, &in[1], &in[2], &out[0], &out[1],
                          &out[2], &out[3], &out[4], &out[5], &out[6])) {
        return NULL;
    }
    pair_batch batch = { binding_shape_of(a), NULL, in[0].buf, in[1].buf, in[2].buf, 0 };
    batch.b = batch.a != NULL ? binding_shape_of(b) : NULL;
    batch.count = batch.b != NULL ? binding_count(&in[0], sizeof(tl_transform), "pose_a") : -1;
    bool good = batch.count >= 0 && binding_has(&in[1], sizeof(tl_transform), batch.count, false, "pose_b") &&
                binding_has(&in[2], sizeof(tl_vec3), batch.count, kind != 2, "motion");
    static const size_t sizes[] = { 4, 4, 1, 12, 12, 12, 1 };
    for (int i = 0; i < 7 && good; i++) {
        good = binding_has(&out[i], sizes[i], batch.count, false, "output");
    }
    if (good) {
        pair_results results = { out[0].buf, out[1].buf, out[2].buf, out[3].buf, out[4].buf, out[5].buf, out[6].buf };
        Py_BEGIN_ALLOW_THREADS if (kind == 0)
        {
            find_distances(&batch, &results);
        }
        else if (kind == 1)
        {
            find_penetrations(&batch, &results);
        }
        else
        {
            cast_shapes(&batch, &results);
        }
        Py_END_ALLOW_THREADS
    }
    binding_release(in, 3);
    binding_release(out, 7);
    return good ? Py_NewRef(Py_None) : NULL;
}

// shape_contacts(a, pose_a, b, pose_b, margin, tolerance) -> bytes of tl_contact_manifold
static PyObject *shape_contacts(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *a;
    PyObject *b;
    Py_buffer poses[2];
    memset(poses, 0, sizeof(poses));
    tl_contact_limits limits = { 0.0f, 0.0f, 0 };
    if (!PyArg_ParseTuple(args, "Oy*Oy*ff", &a, &poses[0], &b, &poses[1], &limits.margin, &limits.tolerance)) {
        return NULL;
    }
    const tl_convex *shape_a = binding_shape_of(a);
    const tl_convex *shape_b = shape_a != NULL ? binding_shape_of(b) : NULL;
    PyObject *result = NULL;
    if (shape_b != NULL && binding_has(&poses[0], sizeof(tl_transform), 1, false, "pose_a") &&
        binding_has(&poses[1], sizeof(tl_transform), 1, false, "pose_b")) {
        tl_transform at[2];
        memcpy(&at[0], poses[0].buf, sizeof(at[0]));
        memcpy(&at[1], poses[1].buf, sizeof(at[1]));
        tl_contact_manifold manifold;
        tl_convex_contacts(shape_a, at[0], shape_b, at[1], &limits, NULL, &manifold);
        result = PyBytes_FromStringAndSize((const char *)&manifold, sizeof(manifold));
    }
    binding_release(poses, 2);
    return result;
}

PyMethodDef binding_convex_methods[] = {
    { "shape", make_shape, METH_VARARGS, NULL },
    { "shape_bounds", shape_bounds, METH_VARARGS, NULL },
    { "shape_pairs", shape_pairs, METH_VARARGS, NULL },
    { "shape_contacts", shape_contacts, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
