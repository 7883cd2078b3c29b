// SPDX-License-Identifier: MIT
//
// Paths between pairs of points: many at once, each thread with a query of its own. Corners of all paths follow one
// another in one array, as rows in a CSR matrix.

#include "binding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PATHS_A_TASK = 32, FIRST_CORNERS = 256, FIRST_POLYGONS = 1024 };

// What the status says besides tl_nav_path_status.
enum { STATUS_NO_START = 250, STATUS_NO_GOAL = 251, STATUS_START_BLOCKED = 252, STATUS_GOAL_BLOCKED = 253 };

typedef struct path_batch {
    const binding_navmesh *held;
    const tl_nav_filter *filter;
    bool by_cost;       // A* by area costs instead of the shortest path
    float agent_radius; // > 0: a path with clearance
    tl_vec3 extents;
    const tl_vec3 *starts;
    const tl_vec3 *goals;
    uint32_t count;
    tl_nav_query **queries; // one a worker, made when it is first needed
    uint8_t *statuses;
    double *lengths; // in the plane
    double *lower_bounds;
    double *surface_lengths;
    double *costs;
    uint32_t *corner_counts;
    tl_vec3 **corners;  // one array a task; NULL: not wanted
    tl_result *results; // one a task
} path_batch;

// The growing arrays of one task.
typedef struct path_scratch {
    tl_nav_corner *corners;
    uint32_t corner_capacity;
    tl_nav_ref *polygons;
    uint32_t polygon_capacity;
    tl_vec3 *all;
    size_t all_count, all_capacity;
} path_scratch;

static bool grow(void **array, size_t needed, size_t size)
{
    void *larger = realloc(*array, needed * size);
    if (larger != NULL) {
        *array = larger;
    }
    return larger != NULL;
}

static tl_result keep_corners(path_scratch *scratch, uint32_t count)
{
    if (scratch->all_count + count > scratch->all_capacity) {
        size_t capacity = 2 * scratch->all_capacity + count + FIRST_CORNERS;
        if (!grow((void **)&scratch->all, capacity, sizeof(tl_vec3))) {
            return TL_ERR_MEMORY;
        }
        scratch->all_capacity = capacity;
    }
    for (uint32_t i = 0; i < count; i++) {
        scratch->all[scratch->all_count++] = scratch->corners[i].point;
    }
    return TL_OK;
}

static tl_result need_corners(path_scratch *scratch, uint32_t count)
{
    if (count <= scratch->corner_capacity) {
        return TL_OK;
    }
    if (!grow((void **)&scratch->corners, count, sizeof(tl_nav_corner))) {
        return TL_ERR_MEMORY;
    }
    scratch->corner_capacity = count;
    return TL_OK;
}

static tl_result find_shortest(const path_batch *batch, tl_nav_query *query, const tl_nav_path_request *request,
                               uint32_t index, path_scratch *scratch)
{
    tl_nav_shortest_path path;
    tl_result result;
    do {
        tl_nav_path_buffers buffers = { NULL, 0, scratch->corners, scratch->corner_capacity };
        result = tl_nav_query_find_shortest_path(query, batch->held->navmesh, request, &buffers, &path);
    } while (result == TL_INCOMPLETE && (result = need_corners(scratch, path.corner_count)) == TL_OK);
    if (tl_is_error(result)) {
        return result;
    }
    batch->statuses[index] = (uint8_t)path.status;
    batch->lengths[index] = path.status == TL_NAV_PATH_COMPLETE ? path.length : (double)INFINITY;
    batch->lower_bounds[index] = path.status == TL_NAV_PATH_UNREACHABLE ? (double)INFINITY : path.lower_bound;
    batch->surface_lengths[index] = path.status == TL_NAV_PATH_COMPLETE ? path.surface_length : (double)INFINITY;
    batch->costs[index] = batch->lengths[index];
    batch->corner_counts[index] = path.corner_count;
    return keep_corners(scratch, path.corner_count);
}

static uint8_t wide_status(tl_nav_wide_status status)
{
    switch (status) {
    case TL_NAV_WIDE_COMPLETE:
        return TL_NAV_PATH_COMPLETE;
    case TL_NAV_WIDE_UNREACHABLE:
        return TL_NAV_PATH_UNREACHABLE;
    case TL_NAV_WIDE_OUT_OF_NODES:
        return TL_NAV_PATH_OUT_OF_NODES;
    case TL_NAV_WIDE_START_BLOCKED:
        return STATUS_START_BLOCKED;
    case TL_NAV_WIDE_GOAL_BLOCKED:
        return STATUS_GOAL_BLOCKED;
    default:
        return TL_NAV_PATH_NONE;
    }
}

static tl_result find_wide(const path_batch *batch, tl_nav_query *query, const tl_nav_path_request *request,
                           uint32_t index, path_scratch *scratch)
{
    tl_nav_wide_path path;
    tl_result result;
    do {
        result = tl_nav_query_find_wide_path(query, batch->held->navmesh, request, batch->agent_radius,
                                             scratch->corners, scratch->corner_capacity, &path);
    } while (result == TL_INCOMPLETE && (result = need_corners(scratch, path.corner_count)) == TL_OK);
    if (tl_is_error(result)) {
        return result;
    }
    bool complete = path.status == TL_NAV_WIDE_COMPLETE;
    batch->statuses[index] = wide_status(path.status);
    batch->lengths[index] = complete ? path.length : (double)INFINITY;
    batch->lower_bounds[index] = path.status == TL_NAV_WIDE_UNREACHABLE ? (double)INFINITY : 0.0; // not proven
    batch->surface_lengths[index] = complete ? path.surface_length : (double)INFINITY;
    batch->costs[index] = batch->lengths[index];
    batch->corner_counts[index] = path.corner_count;
    return keep_corners(scratch, path.corner_count);
}

static tl_result find_by_cost(const path_batch *batch, tl_nav_query *query, const tl_nav_path_request *request,
                              uint32_t index, path_scratch *scratch)
{
    const tl_navmesh *navmesh = batch->held->navmesh;
    tl_nav_path path;
    tl_result result =
        tl_nav_query_find_path(query, navmesh, request, scratch->polygons, scratch->polygon_capacity, &path);
    if (result == TL_INCOMPLETE) {
        if (!grow((void **)&scratch->polygons, path.polygon_count, sizeof(tl_nav_ref))) {
            return TL_ERR_MEMORY;
        }
        scratch->polygon_capacity = path.polygon_count;
        result = tl_nav_query_find_path(query, navmesh, request, scratch->polygons, scratch->polygon_capacity, &path);
    }
    if (result != TL_OK) {
        return result;
    }
    uint32_t count = 0;
    float length = 0;
    if (path.status == TL_NAV_PATH_COMPLETE) {
        tl_nav_polygon_path polygons = { scratch->polygons, path.polygon_count, request->start.point, path.end.point };
        do {
            result = tl_navmesh_straight_path(navmesh, &polygons, scratch->corners, scratch->corner_capacity, &count,
                                              &length);
        } while (result == TL_INCOMPLETE && (result = need_corners(scratch, count)) == TL_OK);
        if (tl_is_error(result)) {
            return result;
        }
    }
    bool complete = path.status == TL_NAV_PATH_COMPLETE;
    double plane = 0;
    for (uint32_t i = 1; i < count; i++) {
        tl_vec3 step = tl_sub(scratch->corners[i].point, scratch->corners[i - 1].point);
        plane += sqrt((double)step.x * (double)step.x + (double)step.z * (double)step.z);
    }
    batch->statuses[index] = (uint8_t)path.status;
    batch->lengths[index] = complete ? plane : (double)INFINITY;
    batch->lower_bounds[index] = path.status == TL_NAV_PATH_UNREACHABLE ? (double)INFINITY : 0.0; // not proven
    batch->surface_lengths[index] = complete ? (double)length : (double)INFINITY;
    batch->costs[index] = complete ? (double)path.cost : (double)INFINITY;
    batch->corner_counts[index] = count;
    return keep_corners(scratch, count);
}

static tl_result find_one(const path_batch *batch, tl_nav_query *query, uint32_t index, path_scratch *scratch)
{
    const tl_navmesh *navmesh = batch->held->navmesh;
    tl_nav_path_request request;
    request.filter = batch->filter;
    batch->lengths[index] = batch->surface_lengths[index] = batch->costs[index] = (double)INFINITY;
    batch->lower_bounds[index] = (double)INFINITY;
    batch->corner_counts[index] = 0;
    tl_result result =
        tl_navmesh_find_nearest(navmesh, batch->filter, batch->starts[index], batch->extents, &request.start);
    if (result == TL_OK) {
        result = tl_navmesh_find_nearest(navmesh, batch->filter, batch->goals[index], batch->extents, &request.goal);
        batch->statuses[index] = STATUS_NO_GOAL;
    } else {
        batch->statuses[index] = STATUS_NO_START;
    }
    if (result != TL_OK) {
        return result == TL_NOT_FOUND ? TL_OK : result;
    }
    return batch->agent_radius > 0 ? find_wide(batch, query, &request, index, scratch)
           : batch->by_cost        ? find_by_cost(batch, query, &request, index, scratch)
                                   : find_shortest(batch, query, &request, index, scratch);
}

static void find_some(uint32_t task, uint32_t worker, void *user)
{
    const path_batch *batch = user;
    path_scratch scratch;
    memset(&scratch, 0, sizeof(scratch));
    tl_result result = TL_OK;
    if (batch->queries[worker] == NULL) {
        result = binding_query_create(&batch->queries[worker]);
    }
    if (result == TL_OK) {
        result = need_corners(&scratch, FIRST_CORNERS);
    }
    if (result == TL_OK && batch->by_cost) {
        scratch.polygon_capacity = FIRST_POLYGONS;
        result = grow((void **)&scratch.polygons, FIRST_POLYGONS, sizeof(tl_nav_ref)) ? TL_OK : TL_ERR_MEMORY;
    }
    uint32_t first = task * PATHS_A_TASK;
    uint32_t end = batch->count - first > PATHS_A_TASK ? first + PATHS_A_TASK : batch->count;
    for (uint32_t i = first; i < end && result == TL_OK; i++) {
        result = find_one(batch, batch->queries[worker], i, &scratch);
    }
    free(scratch.corners);
    free(scratch.polygons);
    batch->corners[task] = scratch.all;
    batch->results[task] = result;
}

// The corners of all tasks as one bytes object; their arrays are freed.
static PyObject *join_corners(const path_batch *batch, uint32_t tasks)
{
    size_t total = 0;
    for (uint32_t i = 0; i < batch->count; i++) {
        total += batch->corner_counts[i];
    }
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)(total * sizeof(tl_vec3)));
    tl_vec3 *at = bytes != NULL ? (tl_vec3 *)(void *)PyBytes_AsString(bytes) : NULL;
    for (uint32_t task = 0; at != NULL && task < tasks; task++) {
        size_t count = 0;
        for (uint32_t i = task * PATHS_A_TASK; i < batch->count && i < (task + 1) * PATHS_A_TASK; i++) {
            count += batch->corner_counts[i];
        }
        if (count > 0) {
            memcpy(at, batch->corners[task], count * sizeof(*at));
            at += count;
        }
    }
    return bytes;
}

// The error of the first task that has one.
static PyObject *raise_first(const path_batch *batch, uint32_t tasks)
{
    for (uint32_t i = 0; i < tasks; i++) {
        if (batch->results[i] != TL_OK) {
            return binding_raise(batch->results[i], NULL);
        }
    }
    return NULL;
}

static PyObject *run_batch(path_batch *batch, unsigned threads)
{
    uint32_t tasks = (batch->count + PATHS_A_TASK - 1) / PATHS_A_TASK;
    threads = threads > 1 ? threads : 1;
    PyObject *bytes = NULL;
    batch->queries = calloc(threads, sizeof(*batch->queries));
    batch->corners = calloc((size_t)tasks + 1, sizeof(*batch->corners));
    batch->results = calloc((size_t)tasks + 1, sizeof(*batch->results));
    bool good = batch->queries != NULL && batch->corners != NULL && batch->results != NULL;
    if (good) {
        binding_host host;
        binding_begin(&host, Py_None, threads);
        host.tasks.run(find_some, tasks, batch, host.tasks.user);
        binding_end(&host);
        raise_first(batch, tasks);
        bytes = PyErr_Occurred() == NULL ? join_corners(batch, tasks) : NULL;
    } else {
        PyErr_NoMemory();
    }
    for (uint32_t i = 0; batch->queries != NULL && i < threads; i++) {
        tl_nav_query_destroy(batch->queries[i]);
    }
    for (uint32_t i = 0; batch->corners != NULL && i < tasks; i++) {
        free(batch->corners[i]);
    }
    free(batch->queries);
    free(batch->corners);
    free(batch->results);
    return bytes;
}

// navmesh_paths(navmesh, filter, by cost, agent radius, (ex, ey, ez), starts, goals, threads, statuses u8, lengths f64,
//               lower bounds f64, surface lengths f64, costs f64, corner counts u32) -> corners as bytes
static PyObject *navmesh_paths(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    int by_cost = 0;
    unsigned threads = 1;
    path_batch batch;
    memset(&batch, 0, sizeof(batch));
    Py_buffer b[8];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "OOpf(fff)y*y*Iw*w*w*w*w*w*", &capsule, &filter_tuple, &by_cost, &batch.agent_radius,
                          &batch.extents.x, &batch.extents.y, &batch.extents.z, &b[0], &b[1], &threads, &b[2], &b[3],
                          &b[4], &b[5], &b[6], &b[7])) {
        return NULL;
    }
    tl_nav_filter filter;
    batch.held = binding_navmesh_of(capsule);
    batch.filter = &filter;
    batch.by_cost = by_cost != 0;
    Py_ssize_t count = batch.held != NULL && binding_filter(filter_tuple, &filter)
                           ? binding_count(&b[0], sizeof(tl_vec3), "starts")
                           : -1;
    static const size_t sizes[] = { 12, 12, 1, 8, 8, 8, 8, 4 };
    bool good = count >= 0 && count < INT32_MAX;
    for (int i = 1; i < 8 && good; i++) {
        good = binding_has(&b[i], sizes[i], count, false, i == 1 ? "goals" : "output");
    }
    PyObject *bytes = NULL;
    if (good) {
        batch.starts = b[0].buf;
        batch.goals = b[1].buf;
        batch.count = (uint32_t)count;
        batch.statuses = b[2].buf;
        batch.lengths = b[3].buf;
        batch.lower_bounds = b[4].buf;
        batch.surface_lengths = b[5].buf;
        batch.costs = b[6].buf;
        batch.corner_counts = b[7].buf;
        bytes = run_batch(&batch, threads);
    }
    binding_release(b, 8);
    return bytes;
}

// navmesh_reachable_point(navmesh, filter, ref, (point)) -> (ref, point): nearest to the point, on the island of ref
static PyObject *navmesh_reachable_point(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    unsigned long long ref = 0;
    tl_vec3 point;
    if (!PyArg_ParseTuple(args, "OOK(fff)", &capsule, &filter_tuple, &ref, &point.x, &point.y, &point.z)) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    tl_nav_filter filter;
    if (held == NULL || !binding_filter(filter_tuple, &filter)) {
        return NULL;
    }
    tl_nav_location found;
    tl_result result = tl_navmesh_find_nearest_reachable(held->navmesh, &filter, ref, point, &found);
    if (result != TL_OK) {
        return binding_raise(result, NULL);
    }
    return Py_BuildValue("K(fff)", (unsigned long long)found.polygon, found.point.x, found.point.y, found.point.z);
}

PyMethodDef binding_path_methods[] = {
    { "navmesh_paths", navmesh_paths, METH_VARARGS, NULL },
    { "navmesh_reachable_point", navmesh_reachable_point, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
