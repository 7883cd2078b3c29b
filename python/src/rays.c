// SPDX-License-Identifier: MIT
//
// Batches of rays and segments: arrays of origins and directions in, one array for each part of the hits out.
//
// A task gathers some rays into the library's own form, casts them, and scatters the hits, all within the cache. So
// arrays need no copy of their own, and the cost beside tl_soup_cast_rays is a few nanoseconds a ray.

#include "binding.h"

#include <math.h>
#include <string.h>

enum { GATHERED = 128, RAYS_A_TASK = 16384 };

typedef enum ray_kind { CAST_RAYS, TEST_RAYS, CAST_SEGMENTS, TEST_SEGMENTS } ray_kind;

typedef struct ray_batch {
    const tl_soup *soup;
    ray_kind kind;
    const tl_vec3 *origins;
    const tl_vec3 *directions; // or the ends of segments
    const float *tmax;         // one, or one for each ray
    bool each_tmax;
    uint32_t count;
    tl_ray_filter filter;
    float *t;
    int32_t *triangles;
    float *barycentrics; // [2 * count], or NULL; as all below
    tl_vec3 *normals;
    uint16_t *materials;
    uint8_t *backs;
    uint8_t *tests; // hit, or blocked
} ray_batch;

static void scatter(const ray_batch *batch, uint32_t first, const tl_ray_hit *hits, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        batch->t[first + i] = hits[i].t;
        batch->triangles[first + i] = (int32_t)hits[i].triangle; // TL_NO_TRIANGLE becomes -1
    }
    if (batch->barycentrics != NULL) {
        for (uint32_t i = 0; i < count; i++) {
            bool hit = hits[i].triangle != TL_NO_TRIANGLE;
            batch->barycentrics[2 * (size_t)(first + i)] = hit ? hits[i].u : 0.0f;
            batch->barycentrics[2 * (size_t)(first + i) + 1] = hit ? hits[i].v : 0.0f;
            batch->normals[first + i] = hit ? hits[i].normal : tl_vec3_make(0, 0, 0);
            batch->materials[first + i] = hit ? hits[i].material : 0;
            batch->backs[first + i] = hit && hits[i].back;
        }
    }
}

static void cast_gathered(const ray_batch *batch, uint32_t first, uint32_t count)
{
    tl_ray rays[GATHERED];
    tl_ray_hit hits[GATHERED];
    for (uint32_t i = 0; i < count; i++) {
        rays[i].origin = batch->origins[first + i];
        rays[i].direction = batch->directions[first + i];
        rays[i].tmax = batch->tmax[batch->each_tmax ? first + i : 0];
    }
    if (batch->kind == TEST_RAYS) {
        for (uint32_t i = 0; i < count; i++) {
            batch->tests[first + i] = tl_soup_occluded(batch->soup, &rays[i], &batch->filter);
        }
        return;
    }
    tl_soup_cast_rays(batch->soup, rays, count, &batch->filter, NULL, hits);
    scatter(batch, first, hits, count);
}

static void cast_segments(const ray_batch *batch, uint32_t first, uint32_t count)
{
    tl_ray_hit hits[GATHERED];
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 a = batch->origins[first + i];
        tl_vec3 b = batch->directions[first + i];
        if (batch->kind == TEST_SEGMENTS) {
            batch->tests[first + i] = !tl_soup_line_of_sight(batch->soup, a, b, &batch->filter);
        } else if (!tl_soup_cast_segment(batch->soup, a, b, &batch->filter, &hits[i])) {
            memset(&hits[i], 0, sizeof(hits[i]));
            hits[i].t = INFINITY;
            hits[i].triangle = TL_NO_TRIANGLE;
        }
    }
    if (batch->kind == CAST_SEGMENTS) {
        scatter(batch, first, hits, count);
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
            cast_gathered(batch, first, count);
        } else {
            cast_segments(batch, first, count);
        }
    }
}

// cast(soup, kind, origins, directions, tmax, cull, ignored, threads, t, triangles, barycentrics, normals, materials,
//      backs, tests): kind 0 rays, 1 rays tested, 2 segments, 3 segments tested. What a kind does not write may be
//      None.
static PyObject *cast(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer b[10];
    memset(b, 0, sizeof(b));
    int kind = 0;
    int cull = 0;
    unsigned long long ignored = 0;
    unsigned threads = 1;
    // z* reads; outputs are numpy arrays that the package made itself, writable and contiguous.
    if (!PyArg_ParseTuple(args, "Oiy*y*y*iKIz*z*z*z*z*z*z*", &capsule, &kind, &b[0], &b[1], &b[2], &cull, &ignored,
                          &threads, &b[3], &b[4], &b[5], &b[6], &b[7], &b[8], &b[9])) {
        return NULL;
    }
    ray_batch batch;
    memset(&batch, 0, sizeof(batch));
    batch.soup = binding_blob_of(capsule, BINDING_SOUP);
    batch.kind = (ray_kind)kind;
    bool tested = kind == TEST_RAYS || kind == TEST_SEGMENTS;
    Py_ssize_t count = batch.soup != NULL ? binding_count(&b[0], sizeof(tl_vec3), "origins") : -1;
    bool good = count >= 0 && binding_has(&b[1], sizeof(tl_vec3), count, false, "directions") &&
                (b[2].len == sizeof(float) || binding_has(&b[2], sizeof(float), count, false, "max_distance")) &&
                binding_has(&b[3], sizeof(float), count, tested, "t") &&
                binding_has(&b[4], sizeof(int32_t), count, tested, "triangles") &&
                binding_has(&b[5], 2 * sizeof(float), count, true, "barycentrics") &&
                binding_has(&b[6], sizeof(tl_vec3), count, true, "normals") &&
                binding_has(&b[7], sizeof(uint16_t), count, true, "materials") &&
                binding_has(&b[8], 1, count, true, "backs") && binding_has(&b[9], 1, count, !tested, "tests");
    for (int i = 3; i < 10 && good; i++) {
        good = b[i].buf == NULL || !b[i].readonly;
        if (!good) {
            PyErr_SetString(PyExc_ValueError, "an output array is read-only");
        }
    }
    if (good && count > UINT32_MAX - RAYS_A_TASK) {
        PyErr_SetString(PyExc_ValueError, "more than 4 G rays in one batch");
        good = false;
    }
    if (good) {
        batch.origins = b[0].buf;
        batch.directions = b[1].buf;
        batch.tmax = b[2].buf;
        batch.each_tmax = b[2].len != sizeof(float);
        batch.count = (uint32_t)count;
        batch.filter.cull = (tl_ray_cull)cull;
        batch.filter.ignored_materials = ignored;
        batch.t = b[3].buf;
        batch.triangles = b[4].buf;
        batch.barycentrics = b[6].buf != NULL && b[7].buf != NULL && b[8].buf != NULL ? b[5].buf : NULL;
        batch.normals = b[6].buf;
        batch.materials = b[7].buf;
        batch.backs = b[8].buf;
        batch.tests = b[9].buf;
        binding_host host;
        binding_begin(&host, Py_None, threads);
        host.tasks.run(run_rays, (uint32_t)((count + RAYS_A_TASK - 1) / RAYS_A_TASK), &batch, host.tasks.user);
        binding_end(&host);
    }
    binding_release(b, 10);
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
