// SPDX-License-Identifier: MIT
//
// Changes of a navmesh: off-mesh links, obstacles, and what is prepared for faster paths.

#include "binding.h"

#include <math.h>
#include <string.h>

// --- off-mesh links -------------------------------------------------------------------------------------------------

// navmesh_add_link(navmesh, (start), (end), both ways, radius, cost factor, fixed cost, flags, area) -> ref
static PyObject *navmesh_add_link(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    tl_nav_offmesh link = tl_default_nav_offmesh();
    int both_ways = 0;
    int area = 0;
    unsigned long long flags = 0;
    if (!PyArg_ParseTuple(args, "O(fff)(fff)pfffKi", &capsule, &link.start.x, &link.start.y, &link.start.z, &link.end.x,
                          &link.end.y, &link.end.z, &both_ways, &link.radius, &link.cost_factor, &link.fixed_cost,
                          &flags, &area)) {
        return NULL;
    }
    binding_navmesh *held = binding_navmesh_to_change(capsule);
    if (held == NULL) {
        return NULL;
    }
    link.both_ways = both_ways != 0;
    link.flags = flags;
    link.area = (uint8_t)area;
    tl_nav_ref ref;
    tl_result result = tl_navmesh_add_offmesh(held->navmesh, &link, &ref, NULL);
    return result == TL_OK ? PyLong_FromUnsignedLongLong(ref) : binding_raise(result, NULL);
}

// navmesh_remove_link(navmesh, ref)
static PyObject *navmesh_remove_link(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    unsigned long long ref = 0;
    if (!PyArg_ParseTuple(args, "OK", &capsule, &ref)) {
        return NULL;
    }
    binding_navmesh *held = binding_navmesh_to_change(capsule);
    if (held == NULL) {
        return NULL;
    }
    tl_result result = tl_navmesh_remove_offmesh(held->navmesh, ref);
    return result == TL_OK ? Py_NewRef(Py_None) : binding_raise(result, NULL);
}

// navmesh_links(navmesh) -> list of (ref, start, end, both ways, anchored, cost)
static PyObject *navmesh_links(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_navmesh *held = binding_navmesh_of(capsule);
    PyObject *list = held != NULL ? PyList_New(0) : NULL;
    uint32_t cursor = 0;
    tl_nav_ref ref;
    while (list != NULL && tl_navmesh_next_offmesh(held->navmesh, &cursor, &ref)) {
        tl_nav_offmesh_state state;
        tl_navmesh_offmesh_state(held->navmesh, ref, &state);
        const tl_nav_offmesh *link = &state.offmesh;
        PyObject *item = Py_BuildValue("K(fff)(fff)NNf", (unsigned long long)ref, link->start.x, link->start.y,
                                       link->start.z, link->end.x, link->end.y, link->end.z,
                                       PyBool_FromLong(link->both_ways), PyBool_FromLong(state.anchored), state.cost);
        if (item == NULL || PyList_Append(list, item) != 0) {
            Py_CLEAR(list);
        }
        Py_XDECREF(item);
    }
    return list;
}

// navmesh_find_links(navmesh, soup, dict of limits, add, threads, progress) -> bytes of tl_nav_jump_link
static PyObject *navmesh_find_links(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *soup_capsule;
    PyObject *progress;
    tl_nav_links_def def = tl_default_nav_links_def();
    int add = 0;
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "OO(ffffffff)pIO", &capsule, &soup_capsule, &def.spacing, &def.max_drop, &def.max_jump,
                          &def.jump_height, &def.max_speed, &def.gravity, &def.max_climb, &def.min_gain, &add, &threads,
                          &progress)) {
        return NULL;
    }
    binding_navmesh *held = add ? binding_navmesh_to_change(capsule) : binding_navmesh_of(capsule);
    const tl_soup *soup = held != NULL ? binding_blob_of(soup_capsule, BINDING_SOUP) : NULL;
    if (soup == NULL) {
        return NULL;
    }
    if (add && held->versions != NULL) {
        // They are saved with the navmesh, and versions share what that was made with.
        PyErr_SetString(PyExc_ValueError, "add found links before the navmesh goes into versions, or use add_link");
        return NULL;
    }
    tl_nav_links *links = NULL;
    tl_nav_links_report report;
    binding_host host;
    binding_begin(&host, progress, threads);
    def.host = host.host;
    tl_result result = tl_nav_links_find(&def, held->navmesh, soup, &links, &report);
    if (result == TL_OK && add) {
        result = tl_nav_links_add(links, NULL, held->navmesh);
    }
    binding_end(&host);
    if (result != TL_OK) {
        tl_blob_free(links);
        return binding_raise(result, &report.base);
    }
    PyObject *bytes = PyBytes_FromStringAndSize((const char *)tl_nav_links_array(links),
                                                (Py_ssize_t)(links->link_count * sizeof(tl_nav_jump_link)));
    if (add) {
        tl_blob_free(held->own_links);
        held->links = held->own_links = links; // saved with the navmesh
    } else {
        tl_blob_free(links);
    }
    return bytes;
}

// --- obstacles ------------------------------------------------------------------------------------------------------

static binding_navmesh *with_obstacles(PyObject *capsule)
{
    binding_navmesh *held = binding_navmesh_to_change(capsule);
    if (held != NULL && held->obstacles == NULL) {
        PyErr_SetString(PyExc_ValueError, "the navmesh was baked without obstacles; bake it with obstacles=True");
        return NULL;
    }
    return held;
}

// The obstacle of an id borrows this shape from now on; None: none.
static bool keep_shape(const binding_navmesh *held, tl_nav_obstacle_id id, PyObject *shape)
{
    PyObject *key = PyLong_FromUnsignedLongLong(id);
    int failed = key == NULL ? -1 : PyDict_SetItem(held->obstacle_shapes, key, shape);
    Py_XDECREF(key);
    return failed == 0;
}

static bool take_shape(PyObject *shape, const Py_buffer *pose, tl_nav_obstacle *o)
{
    if (shape == Py_None) {
        return true;
    }
    const tl_convex *convex = binding_shape_of(shape);
    if (convex == NULL || !binding_has(pose, sizeof(tl_transform), 1, false, "pose")) {
        return false;
    }
    o->convex = *convex;
    memcpy(&o->pose, pose->buf, sizeof(o->pose));
    return true;
}

static bool take_outline(const Py_buffer *points, tl_nav_obstacle *o)
{
    const Py_ssize_t count = binding_count(points, sizeof(tl_vec3), "points");
    if (count > TL_NAV_MAX_OBSTACLE_POINTS) {
        PyErr_Format(PyExc_ValueError, "an outline has at most %d points", TL_NAV_MAX_OBSTACLE_POINTS);
    }
    if (count < 0 || count > TL_NAV_MAX_OBSTACLE_POINTS) {
        return false;
    }
    memcpy(o->points, points->buf, (size_t)points->len);
    o->point_count = (uint32_t)count;
    return true;
}

// Adds the obstacle where id is 0, or moves the one of that id.
static PyObject *place_obstacle(const binding_navmesh *held, tl_nav_obstacle_id id, const tl_nav_obstacle *o,
                                PyObject *shape)
{
    tl_report report;
    tl_nav_obstacle_id made = id;
    const tl_result result = id == 0 ? tl_nav_obstacles_add(held->obstacles, o, &made, &report)
                                     : tl_nav_obstacles_move(held->obstacles, id, o, &report);
    if (result != TL_OK) {
        return binding_raise(result, &report);
    }
    if (!keep_shape(held, made, shape)) {
        tl_nav_obstacles_remove(held->obstacles, made);
        return NULL;
    }
    return PyLong_FromUnsignedLongLong(made);
}

// obstacle_set(navmesh, id or 0, kind, area, (base), height, numbers (radius, half x, half z, cosine, sine), points,
//   shape or None, pose) -> id: adds one, or moves the one of that id
static PyObject *obstacle_set(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *shape;
    unsigned long long id = 0;
    int kind = 0;
    int area = 0;
    tl_nav_obstacle o;
    memset(&o, 0, sizeof(o));
    Py_buffer buffers[2];
    if (!PyArg_ParseTuple(args, "OKii(fff)f(fffff)y*Oy*", &capsule, &id, &kind, &area, &o.base.x, &o.base.y, &o.base.z,
                          &o.height, &o.radius, &o.half_x, &o.half_z, &o.cosine, &o.sine, &buffers[0], &shape,
                          &buffers[1])) {
        return NULL;
    }
    o.shape = (tl_nav_obstacle_shape)kind;
    o.area = (uint8_t)area;
    const binding_navmesh *held = with_obstacles(capsule);
    const bool good = held != NULL && take_outline(&buffers[0], &o) && take_shape(shape, &buffers[1], &o);
    PyObject *made = good ? place_obstacle(held, id, &o, shape) : NULL;
    binding_release(buffers, 2);
    return made;
}

// obstacle_remove(navmesh, id)
static PyObject *obstacle_remove(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    unsigned long long id = 0;
    if (!PyArg_ParseTuple(args, "OK", &capsule, &id)) {
        return NULL;
    }
    const binding_navmesh *held = with_obstacles(capsule);
    if (held == NULL) {
        return NULL;
    }
    tl_result result = tl_nav_obstacles_remove(held->obstacles, id);
    if (result != TL_OK) {
        return binding_raise(result, NULL);
    }
    PyObject *key = PyLong_FromUnsignedLongLong(id);
    int failed = key == NULL ? -1 : PyDict_DelItem(held->obstacle_shapes, key);
    Py_XDECREF(key);
    return failed == 0 ? Py_NewRef(Py_None) : NULL;
}

// obstacles_update(navmesh, max tiles, threads) -> tiles still waiting
static PyObject *obstacles_update(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    unsigned max_tiles = 0, threads = 1;
    if (!PyArg_ParseTuple(args, "OII", &capsule, &max_tiles, &threads)) {
        return NULL;
    }
    const binding_navmesh *held = with_obstacles(capsule);
    if (held == NULL) {
        return NULL;
    }
    tl_nav_bake_report report = { 0 };
    uint32_t waiting = 0;
    tl_tasks tasks;
    binding_tasks(&tasks, threads);
    tl_result result;
    Py_BEGIN_ALLOW_THREADS result = tl_nav_obstacles_set_tasks(held->obstacles, threads > 1 ? &tasks : NULL);
    if (result == TL_OK) {
        result = tl_nav_obstacles_update(held->obstacles, held->navmesh, max_tiles, &waiting, &report);
        tl_nav_obstacles_set_tasks(held->obstacles, NULL);
    }
    Py_END_ALLOW_THREADS return result == TL_OK ? PyLong_FromUnsignedLong(waiting)
                                                : binding_raise(result, &report.base);
}

// --- preparing ------------------------------------------------------------------------------------------------------

// navmesh_prepare(navmesh, table bytes, threads, progress) -> (kind, corner vertices, bytes)
static PyObject *navmesh_prepare(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule, *progress;
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    unsigned long long table = 0;
    unsigned threads;
    if (!PyArg_ParseTuple(args, "OKIO", &capsule, &table, &threads, &progress)) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_to_change(capsule);
    if (held == NULL) {
        return NULL;
    }
    def.table_bytes = table;
    tl_nav_prepared prepared;
    binding_host host;
    binding_begin(&host, progress, threads);
    def.tasks = host.host.tasks;
    def.progress = host.host.progress;
    const tl_result result = tl_navmesh_prepare(held->navmesh, &def, &prepared);
    binding_end(&host);
    return result == TL_OK ? Py_BuildValue("sIK", tl_nav_prepared_kind_name(prepared.kind),
                                           prepared.corner_vertex_count, (unsigned long long)prepared.bytes)
                           : binding_raise(result, &prepared.base);
}

PyMethodDef binding_edit_methods[] = {
    { "navmesh_add_link", navmesh_add_link, METH_VARARGS, NULL },
    { "navmesh_remove_link", navmesh_remove_link, METH_VARARGS, NULL },
    { "navmesh_links", navmesh_links, METH_O, NULL },
    { "navmesh_find_links", navmesh_find_links, METH_VARARGS, NULL },
    { "obstacle_set", obstacle_set, METH_VARARGS, NULL },
    { "obstacle_remove", obstacle_remove, METH_VARARGS, NULL },
    { "obstacles_update", obstacles_update, METH_VARARGS, NULL },
    { "navmesh_prepare", navmesh_prepare, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
