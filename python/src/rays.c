// SPDX-License-Identifier: MIT
//
// Batches of rays and segments: arrays of origins and directions in, one array for each part of the hits out.
//
// A task gathers some rays into the library's own form, casts them, and scatters the hits, all within the cache. So
// arrays of any strides, of float or double, are read where they lie, and one row stands for many without a copy.
// Beside tl_soup_cast_rays that costs 3 to 4.5 ns a ray: 2 to gather it, 1 to 2 to scatter its hit, 0.5 for calls in
// groups. docs/notes/rays.md has what was tried.

#include "binding.h"

#include <stddef.h>
#include <string.h>

#ifdef BINDING_SSE2
#include <emmintrin.h>

_Static_assert(sizeof(tl_ray) == 28 && offsetof(tl_ray, direction) == 12 && offsetof(tl_ray, tmax) == 24,
               "the shuffles know where the parts of a ray lie");
#endif

enum { GATHERED = 256, RAYS_A_TASK = 16384 };

typedef enum ray_kind { CAST_RAYS, TEST_RAYS, CAST_SEGMENTS, TEST_SEGMENTS } ray_kind;

// A numpy array of points in any layout: strides are in bytes, and may be zero or negative.
typedef struct point_rows {
    Py_buffer buffer;
    const char *first;
    Py_ssize_t row, column;
    bool is_double;
} point_rows;

typedef struct ray_batch {
    const tl_soup *soup;
    ray_kind kind;
    point_rows origins;
    point_rows directions; // or the ends of segments
    const float *tmax;     // one, or one for each ray
    bool each_tmax;
    uint32_t count;
    tl_ray_filter filter;
    binding_hit_arrays out;
    bool *tests; // whether a ray hits, or a segment is clear
} ray_batch;

// Takes an (N, 3) array; false: an exception is set.
static bool take_points(PyObject *array, const char *name, point_rows *rows)
{
    if (PyObject_GetBuffer(array, &rows->buffer, PyBUF_RECORDS_RO) != 0) {
        return false;
    }
    const Py_buffer *b = &rows->buffer;
    const char *format = b->format != NULL ? b->format : "";
    format += *format == '='; // this machine's byte order, not aligned
    bool is_float = strcmp(format, "f") == 0;
    rows->is_double = strcmp(format, "d") == 0;
    if (b->ndim != 2 || b->shape[1] != 3 || !(is_float || rows->is_double)) {
        PyErr_Format(PyExc_ValueError, "%s should be an (N, 3) array of float32 or float64", name);
        return false;
    }
    rows->first = b->buf;
    rows->row = b->strides[0];
    rows->column = b->strides[1];
    return true;
}

// Copies rows to points, `step` floats apart. By memcpy, since a view into records may lie at any address.
static void gather_points(const point_rows *rows, uint32_t first, uint32_t count, float *restrict points, size_t step)
{
    const char *from = rows->first + (Py_ssize_t)first * rows->row;
    if (!rows->is_double && rows->column == (Py_ssize_t)sizeof(float)) {
        for (uint32_t i = 0; i < count; i++, from += rows->row, points += step) {
            memcpy(points, from, 3 * sizeof(float));
        }
        return;
    }
    for (uint32_t i = 0; i < count; i++, from += rows->row, points += step) {
        for (int axis = 0; axis < 3; axis++) {
            if (rows->is_double) {
                double value;
                memcpy(&value, from + axis * rows->column, sizeof(value));
                points[axis] = (float)value;
            } else {
                memcpy(&points[axis], from + axis * rows->column, sizeof(float));
            }
        }
    }
}

#ifdef BINDING_SSE2
// Where rows of three floats begin, one after the other or one for all, that four floats may be loaded of: `spare`
// holds the one for all. NULL: the array is another one.
static const char *dense_rows(const point_rows *rows, uint32_t first, float spare[4])
{
    if (rows->is_double || rows->column != (Py_ssize_t)sizeof(float)) {
        return NULL;
    }
    if (rows->row == 0) {
        memcpy(spare, rows->first, 3 * sizeof(float));
        return (const char *)spare;
    }
    return rows->row == 3 * (Py_ssize_t)sizeof(float) ? rows->first + (Py_ssize_t)first * rows->row : NULL;
}

// Rays of dense arrays in two loads and two stores each, instead of six; the last one is left out, since there may be
// no fourth float behind its rows. Returns how many.
static uint32_t gather_dense_rays(const ray_batch *batch, uint32_t first, uint32_t count, tl_ray *rays)
{
    float spare[2][4] = { { 0 } };
    const char *origin = dense_rows(&batch->origins, first, spare[0]);
    const char *direction = dense_rows(&batch->directions, first, spare[1]);
    if (origin == NULL || direction == NULL) {
        return 0;
    }
    const float *tmax = batch->tmax + (batch->each_tmax ? first : 0);
    for (uint32_t i = 0; i + 1 < count; i++) {
        __m128 a = _mm_loadu_ps((const float *)(const void *)origin);
        __m128 b = _mm_loadu_ps((const float *)(const void *)direction);
        __m128 zzxx = _mm_shuffle_ps(a, b, _MM_SHUFFLE(0, 0, 2, 2));
        _mm_storeu_ps(&rays[i].origin.x, _mm_shuffle_ps(a, zzxx, _MM_SHUFFLE(2, 0, 1, 0)));
        // The fourth float is the next ray's first, which is written next.
        _mm_storeu_ps(&rays[i].direction.y, _mm_shuffle_ps(b, _mm_load1_ps(tmax), _MM_SHUFFLE(0, 0, 2, 1)));
        origin += batch->origins.row;
        direction += batch->directions.row;
        tmax += batch->each_tmax;
    }
    return count - 1;
}
#endif

// `count` > 0 rays in the library's own form.
static void gather_rays(const ray_batch *batch, uint32_t first, uint32_t count, tl_ray *rays)
{
    uint32_t done = 0;
#ifdef BINDING_SSE2
    done = gather_dense_rays(batch, first, count, rays);
#endif
    const size_t step = sizeof(tl_ray) / sizeof(float);
    gather_points(&batch->origins, first + done, count - done, &rays[done].origin.x, step);
    gather_points(&batch->directions, first + done, count - done, &rays[done].direction.x, step);
    for (uint32_t i = done; i < count; i++) {
        rays[i].tmax = batch->tmax[batch->each_tmax ? first + i : 0];
    }
}

static void cast_rays(const ray_batch *batch, uint32_t first, uint32_t count)
{
    tl_ray rays[GATHERED];
    tl_ray_hit hits[GATHERED];
    gather_rays(batch, first, count, rays);
    if (batch->kind == TEST_RAYS) {
        tl_soup_occluded_rays(batch->soup, rays, count, &batch->filter, NULL, batch->tests + first);
    } else {
        tl_soup_cast_rays(batch->soup, rays, count, &batch->filter, NULL, hits);
        binding_scatter_hits(hits, count, &batch->out, first);
    }
}

static void cast_segments(const ray_batch *batch, uint32_t first, uint32_t count)
{
    tl_segment segments[GATHERED];
    tl_ray_hit hits[GATHERED];
    gather_points(&batch->origins, first, count, &segments[0].a.x, sizeof(tl_segment) / sizeof(float));
    gather_points(&batch->directions, first, count, &segments[0].b.x, sizeof(tl_segment) / sizeof(float));
    if (batch->kind == TEST_SEGMENTS) {
        tl_soup_lines_of_sight(batch->soup, segments, count, &batch->filter, NULL, batch->tests + first);
    } else {
        tl_soup_cast_segments(batch->soup, segments, count, &batch->filter, NULL, hits);
        binding_scatter_hits(hits, count, &batch->out, first);
    }
}

static void run_rays(uint32_t index, uint32_t worker, void *user)
{
    (void)worker;
    const ray_batch *batch = user;
    uint32_t first = index * RAYS_A_TASK;
    uint32_t end = batch->count - first > RAYS_A_TASK ? first + RAYS_A_TASK : batch->count;
    for (; first < end; first += GATHERED) {
        uint32_t count = end - first > GATHERED ? GATHERED : end - first;
        if (batch->kind == CAST_RAYS || batch->kind == TEST_RAYS) {
            cast_rays(batch, first, count);
        } else {
            cast_segments(batch, first, count);
        }
    }
}

// Outputs: t, triangles, barycentrics, normals, materials, backs; tests.
enum { OUTPUTS = 7 };

// Fills the batch from its arrays; false: an exception is set.
static bool take_batch(ray_batch *batch, PyObject *const points[2], const Py_buffer *tmax, const Py_buffer *out)
{
    bool segments = batch->kind == CAST_SEGMENTS || batch->kind == TEST_SEGMENTS;
    if (!take_points(points[0], segments ? "starts" : "origins", &batch->origins) ||
        !take_points(points[1], segments ? "ends" : "directions", &batch->directions)) {
        return false;
    }
    Py_ssize_t count = batch->origins.buffer.shape[0];
    if (batch->directions.buffer.shape[0] != count || count > (Py_ssize_t)(UINT32_MAX - RAYS_A_TASK)) {
        PyErr_SetString(PyExc_ValueError, "the arrays differ in length, or hold more than 4 G rays");
        return false;
    }
    bool tested = batch->kind == TEST_RAYS || batch->kind == TEST_SEGMENTS;
    static const struct {
        const char *name;
        size_t size;
    } kinds[OUTPUTS] = {
        { "t", sizeof(float) },         { "triangles", sizeof(int32_t) },  { "barycentrics", 2 * sizeof(float) },
        { "normals", sizeof(tl_vec3) }, { "materials", sizeof(uint16_t) }, { "backs", 1 },
        { "tests", sizeof(bool) }
    };
    for (int i = 0; i < OUTPUTS; i++) {
        if (!binding_has(&out[i], kinds[i].size, count, (i == OUTPUTS - 1) != tested, kinds[i].name)) {
            return false;
        }
        if (out[i].buf != NULL && out[i].readonly) {
            PyErr_SetString(PyExc_ValueError, "an output array is read-only");
            return false;
        }
    }
    batch->each_tmax = tmax->len != sizeof(float);
    if (batch->each_tmax && !binding_has(tmax, sizeof(float), count, false, "max_distance")) {
        return false;
    }
    batch->tmax = tmax->buf;
    batch->count = (uint32_t)count;
    batch->out = (binding_hit_arrays){ out[0].buf, out[1].buf, out[2].buf, out[3].buf, out[4].buf, out[5].buf };
    batch->tests = out[6].buf;
    return true;
}

// cast(soup, kind, origins, directions, tmax, cull, ignored, threads, t, triangles, barycentrics, normals, materials,
//      backs, tests): kind 0 rays, 1 whether rays hit, 2 segments, 3 whether segments are clear. 0 and 2 write all but
//      tests, which is None, and the others tests alone.
static PyObject *cast(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *points[2];
    Py_buffer b[1 + OUTPUTS];
    memset(b, 0, sizeof(b));
    int kind = 0;
    int cull = 0;
    unsigned long long ignored = 0;
    unsigned threads = 1;
    // z* reads; outputs are numpy arrays that the package made itself, writable and contiguous.
    if (!PyArg_ParseTuple(args, "OiOOy*iKIz*z*z*z*z*z*z*", &capsule, &kind, &points[0], &points[1], &b[0], &cull,
                          &ignored, &threads, &b[1], &b[2], &b[3], &b[4], &b[5], &b[6], &b[7])) {
        return NULL;
    }
    ray_batch batch;
    memset(&batch, 0, sizeof(batch));
    batch.soup = binding_blob_of(capsule, BINDING_SOUP);
    batch.kind = (ray_kind)kind;
    batch.filter.cull = (tl_ray_cull)cull;
    batch.filter.ignored_materials = ignored;
    bool good = batch.soup != NULL && take_batch(&batch, points, &b[0], &b[1]);
    if (good) {
        binding_host host;
        binding_begin(&host, Py_None, threads);
        host.tasks.run(run_rays, (batch.count + RAYS_A_TASK - 1) / RAYS_A_TASK, &batch, host.tasks.user);
        binding_end(&host);
    }
    binding_release(&batch.origins.buffer, 1);
    binding_release(&batch.directions.buffer, 1);
    binding_release(b, 1 + OUTPUTS);
    return good ? Py_NewRef(Py_None) : NULL;
}

// cast_all(soup, origin, direction, tmax, crossed, cull, ignored) -> bytes of tl_ray_hit, nearest first
static PyObject *cast_all(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    tl_ray ray;
    int crossed = 0;
    int cull = 0;
    unsigned long long ignored = 0;
    if (!PyArg_ParseTuple(args, "O(fff)(fff)fpiK", &capsule, &ray.origin.x, &ray.origin.y, &ray.origin.z,
                          &ray.direction.x, &ray.direction.y, &ray.direction.z, &ray.tmax, &crossed, &cull, &ignored)) {
        return NULL;
    }
    const tl_soup *soup = binding_blob_of(capsule, BINDING_SOUP);
    if (soup == NULL) {
        return NULL;
    }
    tl_ray_filter filter = { .cull = (tl_ray_cull)cull, .ignored_materials = ignored };
    tl_hit_rule rule = crossed ? TL_HITS_CROSSED : TL_HITS_TOUCHED;
    tl_ray_hit some[32];
    uint32_t count = 0;
    tl_result result = tl_soup_cast_ray_all(soup, &ray, rule, &filter, some, 32, &count);
    if (tl_is_error(result)) {
        return binding_raise(result, NULL);
    }
    if (result == TL_OK) {
        return PyBytes_FromStringAndSize((const char *)some, (Py_ssize_t)(count * sizeof(some[0])));
    }
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)count * (Py_ssize_t)sizeof(some[0]));
    if (bytes != NULL) {
        tl_soup_cast_ray_all(soup, &ray, rule, &filter, (tl_ray_hit *)(void *)PyBytes_AsString(bytes), count, &count);
    }
    return bytes;
}

PyMethodDef binding_ray_methods[] = {
    { "cast", cast, METH_VARARGS, NULL },
    { "cast_all", cast_all, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
