// SPDX-License-Identifier: MIT
//
// Triangle soups: baking, refitting, what they hold, and the queries that are no rays.

#include "binding.h"

#include <math.h>
#include <string.h>

enum { SOUP_BATCH = 256 }; // items of a batch in one task

static const tl_soup *soup_of(PyObject *capsule)
{
    return binding_blob_of(capsule, BINDING_SOUP);
}

// soup_bake(vertices, indices, materials, layout, split_budget, pair, threads, progress) -> (capsule, degenerate)
static PyObject *soup_bake(PyObject *self, PyObject *args)
{
    (void)self;
    Py_buffer buffers[3];
    memset(buffers, 0, sizeof(buffers));
    tl_soup_def def = tl_default_soup_def();
    int layout = 0;
    int pair = 1;
    unsigned threads = 1;
    PyObject *progress;
    if (!PyArg_ParseTuple(args, "y*y*z*ifpIO", &buffers[0], &buffers[1], &buffers[2], &layout, &def.split_budget, &pair,
                          &threads, &progress)) {
        return NULL;
    }
    tl_mesh_view view;
    tl_soup *soup = NULL;
    tl_soup_report report;
    tl_result result = TL_ERR_ARGUMENT;
    if (binding_mesh_view(&buffers[0], &buffers[1], &buffers[2], &view)) {
        binding_host host;
        def.layout = (tl_soup_layout)layout;
        def.pair_triangles = pair != 0;
        binding_begin(&host, progress, threads);
        def.host = host.host;
        result = tl_soup_bake(&view, &def, &soup, &report);
        binding_end(&host);
        if (result != TL_OK) {
            binding_raise(result, &report.base);
        }
    }
    binding_release(buffers, 3);
    if (result != TL_OK) {
        return NULL;
    }
    PyObject *capsule = binding_blob_capsule(soup, NULL, BINDING_SOUP);
    return capsule != NULL ? Py_BuildValue("NI", capsule, report.degenerate_triangles) : NULL;
}

// soup_refit(soup, vertices, indices, materials): the view it was baked from, at other positions
static PyObject *soup_refit(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer buffers[3];
    memset(buffers, 0, sizeof(buffers));
    if (!PyArg_ParseTuple(args, "Oy*y*z*", &capsule, &buffers[0], &buffers[1], &buffers[2])) {
        return NULL;
    }
    tl_soup *soup = binding_blob_of(capsule, BINDING_SOUP);
    tl_mesh_view view;
    tl_result result = TL_ERR_ARGUMENT;
    if (soup != NULL && binding_mesh_view(&buffers[0], &buffers[1], &buffers[2], &view)) {
        tl_report report;
        result = tl_soup_refit(soup, &view, &report);
        if (result != TL_OK) {
            binding_raise(result, &report);
        }
    }
    binding_release(buffers, 3);
    return result == TL_OK ? Py_NewRef(Py_None) : NULL;
}

// soup_stats(soup) -> dict
static PyObject *soup_stats(PyObject *self, PyObject *capsule)
{
    (void)self;
    const tl_soup *soup = soup_of(capsule);
    if (soup == NULL) {
        return NULL;
    }
    tl_soup_stats stats = tl_soup_get_stats(soup);
    tl_aabb bounds = tl_soup_bounds(soup);
    return Py_BuildValue("{sKsIsIsIsIsIsIsisIs((ddd)(ddd))}", "size", (unsigned long long)stats.size,
                         "source_triangle_count", stats.source_triangle_count, "triangle_count", stats.triangle_count,
                         "pair_count", stats.pair_count, "single_count", stats.single_count, "coincident_count",
                         stats.coincident_count, "node_count", stats.node_count, "layout", (int)stats.layout, "depth",
                         stats.depth, "bounds", (double)bounds.min.x, (double)bounds.min.y, (double)bounds.min.z,
                         (double)bounds.max.x, (double)bounds.max.y, (double)bounds.max.z);
}

// soup_triangles(soup, corners f32[count][3][3], triangles u32[count], materials u16[count])
static PyObject *soup_triangles(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer out[3];
    memset(out, 0, sizeof(out));
    if (!PyArg_ParseTuple(args, "Ow*w*w*", &capsule, &out[0], &out[1], &out[2])) {
        return NULL;
    }
    const tl_soup *soup = soup_of(capsule);
    bool good = soup != NULL;
    if (good) {
        Py_ssize_t count = tl_soup_get_stats(soup).triangle_count;
        good = binding_has(&out[0], 3 * sizeof(tl_vec3), count, false, "corners") &&
               binding_has(&out[1], sizeof(uint32_t), count, false, "triangles") &&
               binding_has(&out[2], sizeof(uint16_t), count, false, "materials");
    }
    if (good) {
        uint64_t cursor = 0;
        tl_soup_triangle triangle;
        for (size_t i = 0; tl_soup_next_triangle(soup, &cursor, &triangle); i++) {
            memcpy((tl_vec3 *)out[0].buf + 3 * i, triangle.corners, sizeof(triangle.corners));
            ((uint32_t *)out[1].buf)[i] = triangle.triangle;
            ((uint16_t *)out[2].buf)[i] = triangle.material;
        }
    }
    binding_release(out, 3);
    return good ? Py_NewRef(Py_None) : NULL;
}

// soup_check_closed(soup)
static PyObject *soup_check_closed(PyObject *self, PyObject *capsule)
{
    (void)self;
    const tl_soup *soup = soup_of(capsule);
    if (soup == NULL) {
        return NULL;
    }
    tl_report report;
    tl_result result = tl_soup_check_closed(soup, NULL, &report);
    return result == TL_OK ? Py_NewRef(Py_None) : binding_raise(result, &report);
}

// --- nearest points and locations -----------------------------------------------------------------------------------

typedef struct point_batch {
    const tl_soup *soup;
    const tl_vec3 *points;
    uint32_t count;
    float max_distance;
    tl_ray_filter filter;
    tl_vec3 *nearest;
    float *distances;
    int32_t *triangles; // -1: none
    tl_vec3 *normals;
    uint8_t *features;
    uint8_t *backs;
    int8_t *sides; // -1 outside, 0 on the surface, 1 inside
    int32_t *windings;
    tl_result *failures; // of locate, a result for each task
} point_batch;

static void find_nearest_points(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const point_batch *batch = user;
    uint32_t first = index * SOUP_BATCH;
    uint32_t end = batch->count - first > SOUP_BATCH ? first + SOUP_BATCH : batch->count;
    for (uint32_t i = first; i < end; i++) {
        tl_soup_point found;
        bool some =
            tl_soup_nearest(batch->soup, batch->points[i], batch->max_distance, &batch->filter, &found) == TL_OK;
        batch->nearest[i] = some ? found.point : tl_vec3_make(NAN, NAN, NAN);
        batch->distances[i] = some ? found.distance : INFINITY;
        batch->triangles[i] = some ? (int32_t)found.triangle : -1;
        batch->normals[i] = found.normal;
        batch->features[i] = (uint8_t)found.feature;
        batch->backs[i] = found.back;
    }
}

static void locate_points(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const point_batch *batch = user;
    uint32_t first = index * SOUP_BATCH;
    uint32_t end = batch->count - first > SOUP_BATCH ? first + SOUP_BATCH : batch->count;
    batch->failures[index] = TL_OK;
    for (uint32_t i = first; i < end; i++) {
        tl_soup_location found;
        tl_result result = tl_soup_locate(batch->soup, batch->points[i], &found);
        batch->failures[index] = batch->failures[index] == TL_OK ? result : batch->failures[index];
        batch->sides[i] = found.side == TL_SOUP_INSIDE ? 1 : found.side == TL_SOUP_ON_SURFACE ? 0 : -1;
        batch->windings[i] = found.winding;
    }
}

static uint32_t task_count(Py_ssize_t items)
{
    return (uint32_t)((items + SOUP_BATCH - 1) / SOUP_BATCH);
}

// soup_nearest(soup, points, max_distance, ignored, threads, nearest, distances, triangles, normals, features, backs)
static PyObject *soup_nearest(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer b[7];
    memset(b, 0, sizeof(b));
    point_batch batch;
    memset(&batch, 0, sizeof(batch));
    unsigned long long ignored = 0;
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "Oy*fKIw*w*w*w*w*w*", &capsule, &b[0], &batch.max_distance, &ignored, &threads, &b[1],
                          &b[2], &b[3], &b[4], &b[5], &b[6])) {
        return NULL;
    }
    batch.soup = soup_of(capsule);
    Py_ssize_t count = batch.soup != NULL ? binding_count(&b[0], sizeof(tl_vec3), "points") : -1;
    bool good = count >= 0 && count <= INT32_MAX && binding_has(&b[1], sizeof(tl_vec3), count, false, "nearest") &&
                binding_has(&b[2], sizeof(float), count, false, "distances") &&
                binding_has(&b[3], sizeof(int32_t), count, false, "triangles") &&
                binding_has(&b[4], sizeof(tl_vec3), count, false, "normals") &&
                binding_has(&b[5], 1, count, false, "features") && binding_has(&b[6], 1, count, false, "backs");
    if (good) {
        batch.points = b[0].buf;
        batch.count = (uint32_t)count;
        batch.filter.ignored_materials = ignored;
        batch.nearest = b[1].buf;
        batch.distances = b[2].buf;
        batch.triangles = b[3].buf;
        batch.normals = b[4].buf;
        batch.features = b[5].buf;
        batch.backs = b[6].buf;
        binding_host host;
        binding_begin(&host, Py_None, threads);
        host.tasks.run(find_nearest_points, task_count(count), &batch, host.tasks.user);
        binding_end(&host);
    }
    binding_release(b, 7);
    return good ? Py_NewRef(Py_None) : NULL;
}

// soup_locate(soup, points, threads, sides i8, windings i32)
static PyObject *soup_locate(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer b[3];
    memset(b, 0, sizeof(b));
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "Oy*Iw*w*", &capsule, &b[0], &threads, &b[1], &b[2])) {
        return NULL;
    }
    point_batch batch;
    memset(&batch, 0, sizeof(batch));
    batch.soup = soup_of(capsule);
    Py_ssize_t count = batch.soup != NULL ? binding_count(&b[0], sizeof(tl_vec3), "points") : -1;
    bool good = count >= 0 && count <= INT32_MAX && binding_has(&b[1], 1, count, false, "sides") &&
                binding_has(&b[2], sizeof(int32_t), count, false, "windings");
    batch.failures = good ? PyMem_Malloc((task_count(count) + 1) * sizeof(tl_result)) : NULL;
    if (good && batch.failures == NULL) {
        PyErr_NoMemory();
        good = false;
    }
    if (good) {
        batch.points = b[0].buf;
        batch.count = (uint32_t)count;
        batch.sides = b[1].buf;
        batch.windings = b[2].buf;
        binding_host host;
        binding_begin(&host, Py_None, threads);
        host.tasks.run(locate_points, task_count(count), &batch, host.tasks.user);
        binding_end(&host);
        for (uint32_t i = 0; i < task_count(count) && good; i++) {
            if (batch.failures[i] != TL_OK) {
                binding_raise(batch.failures[i], NULL);
                good = false;
            }
        }
    }
    PyMem_Free(batch.failures);
    binding_release(b, 3);
    return good ? Py_NewRef(Py_None) : NULL;
}

// --- shapes against the soup ----------------------------------------------------------------------------------------

typedef struct shape_batch {
    const tl_soup *soup;
    const tl_convex *shape;
    const tl_transform *poses; // rotation x, y, z, w, then position
    const tl_vec3 *motions;
    uint32_t count;
    tl_ray_filter filter;
    uint8_t *overlaps;
    float *t;
    int32_t *triangles;
    tl_vec3 *points;
    tl_vec3 *normals;
    float *depths;
    tl_result *results; // for each item
} shape_batch;

static void test_overlaps(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const shape_batch *batch = user;
    uint32_t first = index * SOUP_BATCH;
    uint32_t end = batch->count - first > SOUP_BATCH ? first + SOUP_BATCH : batch->count;
    for (uint32_t i = first; i < end; i++) {
        bool overlaps = false;
        batch->results[i] = tl_soup_overlaps(batch->soup, batch->shape, batch->poses[i], &batch->filter, &overlaps);
        batch->overlaps[i] = overlaps;
    }
}

static void sweep_shapes(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const shape_batch *batch = user;
    uint32_t first = index * SOUP_BATCH;
    uint32_t end = batch->count - first > SOUP_BATCH ? first + SOUP_BATCH : batch->count;
    for (uint32_t i = first; i < end; i++) {
        tl_shape_hit hit;
        tl_result result =
            tl_soup_cast_shape(batch->soup, batch->shape, batch->poses[i], batch->motions[i], &batch->filter, &hit);
        batch->results[i] = tl_is_error(result) ? result : TL_OK;
        batch->t[i] = result == TL_OK ? hit.t : INFINITY;
        batch->triangles[i] = result == TL_OK ? (int32_t)hit.triangle : -1;
        batch->points[i] = hit.point;
        batch->normals[i] = hit.normal;
        batch->depths[i] = hit.depth;
    }
}

// Runs a batch of shapes; false: an exception is set.
static bool run_shapes(shape_batch *batch, tl_task_fn *task, unsigned threads)
{
    batch->results = PyMem_Malloc(((size_t)batch->count + 1) * sizeof(tl_result));
    if (batch->results == NULL) {
        PyErr_NoMemory();
        return false;
    }
    binding_host host;
    binding_begin(&host, Py_None, threads);
    host.tasks.run(task, task_count(batch->count), batch, host.tasks.user);
    binding_end(&host);
    bool good = true;
    for (uint32_t i = 0; i < batch->count && good; i++) {
        if (batch->results[i] != TL_OK) {
            tl_report report = { "query", NULL, "pose", i, NULL, 0 };
            binding_raise(batch->results[i], &report);
            good = false;
        }
    }
    PyMem_Free(batch->results);
    return good;
}

// soup_overlaps(soup, shape, poses, ignored, threads, overlaps u8)
static PyObject *soup_overlaps(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *shape;
    Py_buffer b[2];
    memset(b, 0, sizeof(b));
    unsigned long long ignored = 0;
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "OOy*KIw*", &capsule, &shape, &b[0], &ignored, &threads, &b[1])) {
        return NULL;
    }
    shape_batch batch;
    memset(&batch, 0, sizeof(batch));
    batch.soup = soup_of(capsule);
    batch.shape = batch.soup != NULL ? binding_shape_of(shape) : NULL;
    Py_ssize_t count = batch.shape != NULL ? binding_count(&b[0], sizeof(tl_transform), "poses") : -1;
    bool good = count >= 0 && count <= INT32_MAX && binding_has(&b[1], 1, count, false, "overlaps");
    if (good) {
        batch.poses = b[0].buf;
        batch.count = (uint32_t)count;
        batch.filter.ignored_materials = ignored;
        batch.overlaps = b[1].buf;
        good = run_shapes(&batch, test_overlaps, threads);
    }
    binding_release(b, 2);
    return good ? Py_NewRef(Py_None) : NULL;
}

// soup_sweep(soup, shape, poses, motions, ignored, threads, t, triangles, points, normals, depths)
static PyObject *soup_sweep(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *shape;
    Py_buffer b[7];
    memset(b, 0, sizeof(b));
    unsigned long long ignored = 0;
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "OOy*y*KIw*w*w*w*w*", &capsule, &shape, &b[0], &b[1], &ignored, &threads, &b[2], &b[3],
                          &b[4], &b[5], &b[6])) {
        return NULL;
    }
    shape_batch batch;
    memset(&batch, 0, sizeof(batch));
    batch.soup = soup_of(capsule);
    batch.shape = batch.soup != NULL ? binding_shape_of(shape) : NULL;
    Py_ssize_t count = batch.shape != NULL ? binding_count(&b[0], sizeof(tl_transform), "poses") : -1;
    bool good = count >= 0 && count <= INT32_MAX && binding_has(&b[1], sizeof(tl_vec3), count, false, "motions") &&
                binding_has(&b[2], sizeof(float), count, false, "t") &&
                binding_has(&b[3], sizeof(int32_t), count, false, "triangles") &&
                binding_has(&b[4], sizeof(tl_vec3), count, false, "points") &&
                binding_has(&b[5], sizeof(tl_vec3), count, false, "normals") &&
                binding_has(&b[6], sizeof(float), count, false, "depths");
    if (good) {
        batch.poses = b[0].buf;
        batch.motions = b[1].buf;
        batch.count = (uint32_t)count;
        batch.filter.ignored_materials = ignored;
        batch.t = b[2].buf;
        batch.triangles = b[3].buf;
        batch.points = b[4].buf;
        batch.normals = b[5].buf;
        batch.depths = b[6].buf;
        good = run_shapes(&batch, sweep_shapes, threads);
    }
    binding_release(b, 7);
    return good ? Py_NewRef(Py_None) : NULL;
}

// soup_find_overlaps(soup, shape, pose, ignored) -> bytes: u32 triangles, in an order of the soup's own
static PyObject *soup_find_overlaps(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *shape;
    Py_buffer pose;
    unsigned long long ignored = 0;
    if (!PyArg_ParseTuple(args, "OOy*K", &capsule, &shape, &pose, &ignored)) {
        return NULL;
    }
    const tl_soup *soup = soup_of(capsule);
    const tl_convex *convex = soup != NULL ? binding_shape_of(shape) : NULL;
    PyObject *bytes = NULL;
    if (convex != NULL && binding_has(&pose, sizeof(tl_transform), 1, false, "pose")) {
        tl_ray_filter filter = { .ignored_materials = ignored };
        tl_transform at;
        memcpy(&at, pose.buf, sizeof(at));
        uint32_t count = 0;
        tl_result result = tl_soup_find_overlaps(soup, convex, at, &filter, NULL, 0, &count);
        if (tl_is_error(result)) {
            binding_raise(result, NULL);
        } else if ((bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)count * 4)) != NULL) {
            tl_soup_find_overlaps(soup, convex, at, &filter, (uint32_t *)(void *)PyBytes_AsString(bytes), count,
                                  &count);
        }
    }
    PyBuffer_Release(&pose);
    return bytes;
}

PyMethodDef binding_soup_methods[] = {
    { "soup_bake", soup_bake, METH_VARARGS, NULL },
    { "soup_refit", soup_refit, METH_VARARGS, NULL },
    { "soup_stats", soup_stats, METH_O, NULL },
    { "soup_triangles", soup_triangles, METH_VARARGS, NULL },
    { "soup_check_closed", soup_check_closed, METH_O, NULL },
    { "soup_nearest", soup_nearest, METH_VARARGS, NULL },
    { "soup_locate", soup_locate, METH_VARARGS, NULL },
    { "soup_overlaps", soup_overlaps, METH_VARARGS, NULL },
    { "soup_sweep", soup_sweep, METH_VARARGS, NULL },
    { "soup_find_overlaps", soup_find_overlaps, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
