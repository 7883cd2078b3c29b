// SPDX-License-Identifier: MIT
//
// What is asked of a world: nearest points, paths, rays along the surface, routes; and what is in memory, to be drawn.

#include "world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// world.py has them as _PATH_STATUS, by number, beside those of tl_nav_path_status.
enum { NO_START = 250, NO_GOAL = 251, START_NOT_LOADED = 252, GOAL_NOT_LOADED = 253 };

// --- queries --------------------------------------------------------------------------------------------------------

// The ends of a query, as PyArg_ParseTuple reads them.
typedef struct query_ends {
    double start[3], end[3];
    tl_vec3 extents;
    tl_nav_filter filter;
} query_ends;

// Takes (world, filter, (start), (end), (half extents)).
static binding_world *take_ends(PyObject *args, query_ends *ends)
{
    PyObject *capsule;
    PyObject *filter_tuple;
    double *s = ends->start;
    double *e = ends->end;
    tl_vec3 *x = &ends->extents;
    if (!PyArg_ParseTuple(args, "OO(ddd)(ddd)(fff)", &capsule, &filter_tuple, &s[0], &s[1], &s[2], &e[0], &e[1], &e[2],
                          &x->x, &x->y, &x->z)) {
        return NULL;
    }
    binding_world *held = binding_world_of(capsule);
    return held != NULL && binding_filter(filter_tuple, &ends->filter) ? held : NULL;
}

// Where both ends stand. 0, or a status that says which does not; an error is in *result.
static int locate_ends(const binding_world *held, const query_ends *ends, tl_nav_location *start, tl_nav_location *goal,
                       tl_result *result)
{
    *result = tl_nav_world_find_nearest(held->world, &ends->filter, ends->start, ends->extents, start);
    if (*result != TL_OK) {
        return *result == TL_NOT_LOADED ? START_NOT_LOADED : NO_START;
    }
    *result = tl_nav_world_find_nearest(held->world, &ends->filter, ends->end, ends->extents, goal);
    if (*result != TL_OK) {
        return *result == TL_NOT_LOADED ? GOAL_NOT_LOADED : NO_GOAL;
    }
    return 0;
}

// world_nearest(world, filter, points f64[n][3], (half extents), found u8[n], loaded u8[n], nearest f64[n][3])
static PyObject *world_nearest(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    tl_vec3 extents;
    Py_buffer b[4];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "OOy*(fff)w*w*w*", &capsule, &filter_tuple, &b[0], &extents.x, &extents.y, &extents.z,
                          &b[1], &b[2], &b[3])) {
        return NULL;
    }
    const binding_world *held = binding_world_of(capsule);
    tl_nav_filter filter;
    Py_ssize_t count =
        held != NULL && binding_filter(filter_tuple, &filter) ? binding_count(&b[0], 3 * sizeof(double), "points") : -1;
    bool good = count >= 0 && binding_has(&b[1], 1, count, false, "found") &&
                binding_has(&b[2], 1, count, false, "loaded") && binding_has(&b[3], 24, count, false, "nearest");
    tl_result result = TL_OK;
    if (good) {
        PyThreadState *state = PyEval_SaveThread();
        for (Py_ssize_t i = 0; i < count && !tl_is_error(result); i++) {
            const double *point = (const double *)b[0].buf + 3 * i;
            double *nearest = (double *)b[3].buf + 3 * i;
            tl_nav_location place;
            result = tl_nav_world_find_nearest(held->world, &filter, point, extents, &place);
            bool found = place.polygon != TL_NAV_NO_REF;
            ((uint8_t *)b[1].buf)[i] = found;
            ((uint8_t *)b[2].buf)[i] = result != TL_NOT_LOADED;
            nearest[0] = nearest[1] = nearest[2] = (double)NAN;
            if (found) {
                tl_nav_world_place_out(held->world, place.point, nearest);
            }
        }
        PyEval_RestoreThread(state);
    }
    binding_release(b, 4);
    if (good && tl_is_error(result)) {
        return binding_raise(result, NULL);
    }
    return good ? Py_NewRef(Py_None) : NULL;
}

// Points of the local frame to bytes of doubles.
static PyObject *points_out(const binding_world *held, const tl_nav_corner *corners, uint32_t count)
{
    PyObject *bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)count * 24);
    for (uint32_t i = 0; bytes != NULL && i < count; i++) {
        double point[3];
        tl_nav_world_place_out(held->world, corners[i].point, point);
        memcpy(PyBytes_AsString(bytes) + (size_t)i * 24, point, sizeof(point));
    }
    return bytes;
}

// Searches with as much memory as it takes; the corners are to be freed.
static tl_result search(binding_world *held, const tl_nav_path_request *request, tl_nav_corner **corners,
                        tl_nav_shortest_path *path)
{
    tl_result result = TL_OK;
    if (held->query == NULL) {
        result = binding_query_create(&held->query);
    }
    for (uint32_t capacity = 256; result == TL_OK;) {
        free(*corners);
        *corners = malloc(capacity * sizeof(**corners));
        if (*corners == NULL) {
            return TL_ERR_MEMORY;
        }
        const tl_nav_path_buffers buffers = { NULL, 0, *corners, capacity };
        result = tl_nav_world_find_path(held->world, held->query, request, &buffers, path);
        if (tl_is_error(result) || path->corner_count <= capacity) {
            break;
        }
        capacity = path->corner_count;
        result = TL_OK;
    }
    return result;
}

// world_path(world, filter, (start), (goal), (half extents)) -> (status, proven, length, lower bound, surface length,
// points)
static PyObject *world_path(PyObject *self, PyObject *args)
{
    (void)self;
    query_ends ends;
    binding_world *held = take_ends(args, &ends);
    if (held == NULL) {
        return NULL;
    }
    tl_nav_path_request request = { .filter = &ends.filter };
    tl_nav_shortest_path path;
    memset(&path, 0, sizeof(path));
    tl_nav_corner *corners = NULL;
    tl_result result = TL_OK;
    PyThreadState *state = PyEval_SaveThread();
    int status = locate_ends(held, &ends, &request.start, &request.goal, &result);
    if (status == 0) {
        result = search(held, &request, &corners, &path);
        status = (int)path.status;
    }
    PyEval_RestoreThread(state);
    PyObject *answer = NULL;
    if (tl_is_error(result)) {
        binding_raise(result, NULL);
    } else {
        bool is_path = status == TL_NAV_PATH_COMPLETE;
        bool is_proven = result != TL_NOT_LOADED && status != TL_NAV_PATH_OUT_OF_NODES;
        PyObject *points = points_out(held, corners, is_path ? path.corner_count : 0);
        if (points != NULL) {
            answer =
                Py_BuildValue("(iNdddN)", status, PyBool_FromLong(is_proven), is_path ? path.length : (double)INFINITY,
                              status == TL_NAV_PATH_UNREACHABLE ? (double)INFINITY : path.lower_bound,
                              is_path ? path.surface_length : (double)INFINITY, points);
        }
    }
    free(corners);
    return answer;
}

// world_raycast(world, filter, (start), (end), (half extents)) -> (status of the start or 0, hit, loaded, t, point,
// normal)
static PyObject *world_raycast(PyObject *self, PyObject *args)
{
    (void)self;
    query_ends ends;
    const binding_world *held = take_ends(args, &ends);
    if (held == NULL) {
        return NULL;
    }
    tl_nav_location start;
    tl_nav_ray_hit hit;
    memset(&hit, 0, sizeof(hit));
    tl_result result = tl_nav_world_find_nearest(held->world, &ends.filter, ends.start, ends.extents, &start);
    int status = result == TL_OK ? 0 : result == TL_NOT_LOADED ? START_NOT_LOADED : NO_START;
    double point[3] = { (double)NAN, (double)NAN, (double)NAN };
    double tip[3] = { 0, 0, 0 };
    double root[3] = { 0, 0, 0 };
    if (status == 0) {
        result = tl_nav_world_cast_ray(held->world, &ends.filter, &start, ends.end, &hit);
    }
    if (tl_is_error(result)) {
        return binding_raise(result, NULL);
    }
    if (status == 0) {
        tl_navmesh_height(tl_nav_world_navmesh(held->world), hit.polygon, hit.point.x, hit.point.z, &hit.point.y);
        tl_nav_world_place_out(held->world, hit.point, point);
        // The axes of the level may be others.
        tl_nav_world_place_out(held->world, hit.normal, tip);
        tl_nav_world_place_out(held->world, tl_vec3_make(0, 0, 0), root);
    }
    return Py_BuildValue("(iNNf(ddd)(ddd))", status, PyBool_FromLong(hit.hit && result == TL_OK),
                         PyBool_FromLong(result != TL_NOT_LOADED), hit.t, point[0], point[1], point[2],
                         tip[0] - root[0], tip[1] - root[1], tip[2] - root[2]);
}

// world_covers(world, (center), radius) -> bool
static PyObject *world_covers(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    double center[3];
    double radius = 0;
    if (!PyArg_ParseTuple(args, "O(ddd)d", &capsule, &center[0], &center[1], &center[2], &radius)) {
        return NULL;
    }
    const binding_world *held = binding_world_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    tl_result result = tl_nav_world_covers(held->world, center, radius);
    return tl_is_error(result) ? binding_raise(result, NULL) : PyBool_FromLong(result == TL_OK);
}

// --- routes ---------------------------------------------------------------------------------------------------------

// The whole route; its points are to be freed.
static tl_result find_route(const binding_world *held, const tl_nav_world_route_request *request,
                            tl_nav_world_route_point **points, tl_nav_world_route *route)
{
    tl_result result = TL_INCOMPLETE;
    for (uint32_t capacity = 256; result == TL_INCOMPLETE; capacity = route->point_count) {
        free(*points);
        *points = malloc(capacity * sizeof(**points));
        if (*points == NULL) {
            return TL_ERR_MEMORY;
        }
        result = tl_nav_world_find_route(held->world, held->router, request, *points, capacity, route);
    }
    return result;
}

// world_route(world, filter (None), (start), (goal), (half extents)) -> (status, length, lower bound, rows): a row is
// point f64[3], length f64, tile i32[2]
static PyObject *world_route(PyObject *self, PyObject *args)
{
    (void)self;
    query_ends ends;
    binding_world *held = take_ends(args, &ends);
    if (held == NULL) {
        return NULL;
    }
    tl_report report = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
    tl_result result = held->router == NULL ? tl_nav_router_create(held->world, NULL, &held->router, &report) : TL_OK;
    if (result == TL_NOT_FOUND) {
        return PyErr_Format(PyExc_ValueError, "the file has no routes: make them by talus world routes");
    }
    if (result != TL_OK) {
        return binding_raise(result, &report);
    }
    tl_nav_world_route_request request;
    tl_nav_world_route route;
    memset(&route, 0, sizeof(route));
    tl_nav_world_route_point *points = NULL;
    PyThreadState *state = PyEval_SaveThread();
    int status = locate_ends(held, &ends, &request.start, &request.goal, &result);
    if (status == 0) {
        result = find_route(held, &request, &points, &route);
        status = (int)route.status;
    }
    PyEval_RestoreThread(state);
    PyObject *answer = NULL;
    if (tl_is_error(result)) {
        binding_raise(result, NULL);
    } else {
        bool is_route = status == TL_NAV_PATH_COMPLETE;
        bool is_proven_apart = status == TL_NAV_PATH_UNREACHABLE;
        answer = Py_BuildValue("(iddy#)", status, is_route ? route.length : (double)INFINITY,
                               is_proven_apart ? (double)INFINITY : route.lower_bound,
                               points != NULL ? (const char *)points : "",
                               (Py_ssize_t)(route.point_count * sizeof(*points)));
    }
    free(points);
    return answer;
}

_Static_assert(sizeof(tl_nav_world_interest) == 32 && sizeof(tl_nav_world_route_point) == 40,
               "world.py has the same rows");

// --- for drawing ----------------------------------------------------------------------------------------------------

static void free_view(PyObject *capsule)
{
    binding_navmesh *view = PyCapsule_GetPointer(capsule, BINDING_NAVMESH);
    Py_XDECREF(view->owner);
    free(view);
}

// world_view(world) -> the tiles in memory as a navmesh's capsule, to be read until the next update
static PyObject *world_view(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_world *held = binding_world_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    binding_navmesh *view = calloc(1, sizeof(*view));
    PyObject *made = view != NULL ? PyCapsule_New(view, BINDING_NAVMESH, free_view) : PyErr_NoMemory();
    if (made == NULL) {
        free(view);
        return NULL;
    }
    view->navmesh = (tl_navmesh *)(uintptr_t)tl_nav_world_navmesh(held->world);
    view->owner = Py_NewRef(capsule);
    return made;
}

// world_place_out(world, local f32[n][3], points f64[n][3])
static PyObject *world_place_out(PyObject *self, PyObject *args)
{
    (void)self;
    binding_items items;
    const binding_world *held = NULL;
    if (binding_take_items(args, sizeof(tl_vec3), 3 * sizeof(double), &items) &&
        (held = binding_world_of(items.capsule)) != NULL) {
        for (Py_ssize_t i = 0; i < items.count; i++) {
            tl_nav_world_place_out(held->world, ((const tl_vec3 *)items.in.buf)[i], (double *)items.out.buf + 3 * i);
        }
    }
    return binding_end_items(&items, held != NULL);
}

PyMethodDef binding_world_query_methods[] = {
    { "world_nearest", world_nearest, METH_VARARGS, NULL },     { "world_path", world_path, METH_VARARGS, NULL },
    { "world_raycast", world_raycast, METH_VARARGS, NULL },     { "world_covers", world_covers, METH_VARARGS, NULL },
    { "world_route", world_route, METH_VARARGS, NULL },         { "world_view", world_view, METH_O, NULL },
    { "world_place_out", world_place_out, METH_VARARGS, NULL }, { NULL, NULL, 0, NULL },
};
