// SPDX-License-Identifier: MIT
//
// A navmesh in Python's hands: its polygons and surface, queries at points, off-mesh links and obstacles.

#include "binding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// --- the object -----------------------------------------------------------------------------------------------------

void binding_navmesh_free_parts(binding_navmesh *navmesh)
{
    tl_nav_query_destroy(navmesh->query);
    if (navmesh->versions != NULL) {
        if (navmesh->is_fixed) {
            tl_nav_versions_release(navmesh->versions, navmesh->navmesh);
        }
        Py_XDECREF(navmesh->owner);
        return;
    }
    tl_nav_obstacles_destroy(navmesh->obstacles);
    Py_XDECREF(navmesh->obstacle_shapes);
    tl_navmesh_destroy(navmesh->navmesh);
    tl_navmesh_destroy(navmesh->removed);
    tl_blob_free(navmesh->own_pruning);
    tl_blob_free(navmesh->own_links);
    Py_XDECREF(navmesh->owner);
}

static void free_navmesh(PyObject *capsule)
{
    binding_navmesh *navmesh = PyCapsule_GetPointer(capsule, BINDING_NAVMESH);
    binding_navmesh_free_parts(navmesh);
    free(navmesh);
}

PyObject *binding_navmesh_capsule(binding_navmesh *navmesh)
{
    binding_navmesh *held = malloc(sizeof(*held));
    PyObject *capsule = held != NULL ? PyCapsule_New(held, BINDING_NAVMESH, free_navmesh) : PyErr_NoMemory();
    if (capsule == NULL) {
        free(held);
        binding_navmesh_free_parts(navmesh);
        return NULL;
    }
    *held = *navmesh;
    return capsule;
}

binding_navmesh *binding_navmesh_of(PyObject *capsule)
{
    binding_navmesh *held = PyCapsule_GetPointer(capsule, BINDING_NAVMESH);
    if (held != NULL && held->navmesh == NULL) {
        PyErr_SetString(PyExc_ValueError, "this version of the navmesh was given back: acquire another one");
        return NULL;
    }
    return held;
}

binding_navmesh *binding_navmesh_to_change(PyObject *capsule)
{
    binding_navmesh *held = binding_navmesh_of(capsule);
    if (held != NULL && held->is_fixed) {
        PyErr_SetString(PyExc_ValueError, "a navmesh in versions is changed by NavVersions.edit alone");
        return NULL;
    }
    return held;
}

tl_result binding_query_create(tl_nav_query **query_out)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    // Memory grows with need. The number of links bounds a search for any path; for the shortest one it is too small.
    def.max_nodes = 1u << 30;
    return tl_nav_query_create(&def, query_out, NULL);
}

tl_nav_query *binding_query_of(binding_navmesh *navmesh)
{
    if (navmesh->query == NULL && binding_query_create(&navmesh->query) != TL_OK) {
        PyErr_NoMemory();
        return NULL;
    }
    return navmesh->query;
}

bool binding_filter(PyObject *object, tl_nav_filter *filter)
{
    *filter = tl_default_nav_filter();
    if (object == Py_None) {
        return true;
    }
    Py_buffer costs = { 0 };
    unsigned long long include = 0;
    unsigned long long exclude = 0;
    float slack = 0.0f;
    if (!PyArg_ParseTuple(object, "KKz*f", &include, &exclude, &costs, &slack)) {
        return false;
    }
    bool good = binding_has(&costs, sizeof(float), TL_NAV_MAX_AREA + 1, true, "area_costs");
    if (good) {
        filter->include_flags = include;
        filter->exclude_flags = exclude;
        filter->slack = slack;
        if (costs.buf != NULL) {
            memcpy(filter->area_cost, costs.buf, sizeof(filter->area_cost));
        }
    }
    binding_release(&costs, 1);
    return good;
}

// --- what it is made of ---------------------------------------------------------------------------------------------

// navmesh_counts(navmesh) -> (tiles, polygons, corners, detail vertices, detail triangles, area, off-mesh links, bytes)
static PyObject *navmesh_counts(PyObject *self, PyObject *capsule)
{
    (void)self;
    const binding_navmesh *held = binding_navmesh_of(capsule);
    if (held == NULL) {
        return NULL;
    }
    unsigned long long n[5] = { 0, 0, 0, 0, 0 };
    double area = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(held->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(held->navmesh, slot);
        if (tile != NULL) {
            n[0] += tile->polygon_count;
            n[1] += tile->corner_count;
            n[2] += tile->detail_vertex_count;
            n[3] += tile->detail_triangle_count;
            n[4] += tile->blob.size;
            area += tile->area;
        }
    }
    return Py_BuildValue("IKKKKdIK", tl_navmesh_tile_count(held->navmesh), n[0], n[1], n[2], n[3], area,
                         tl_navmesh_offmesh_count(held->navmesh), n[4]);
}

// navmesh_polygons(navmesh, corners f32[c][3], offsets u32[p + 1], refs u64[p], areas u8[p], flags u64[p], islands
// u32[p],
//                  sizes f64[p])
static PyObject *navmesh_polygons(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer b[7];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "Ow*w*w*w*w*w*w*", &capsule, &b[0], &b[1], &b[2], &b[3], &b[4], &b[5], &b[6])) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    Py_ssize_t corners = held != NULL ? binding_count(&b[0], sizeof(tl_vec3), "corners") : -1;
    Py_ssize_t count = corners >= 0 ? binding_count(&b[3], 1, "areas") : -1;
    bool good = count >= 0 && binding_has(&b[1], 4, count + 1, false, "offsets") &&
                binding_has(&b[2], 8, count, false, "refs") && binding_has(&b[4], 8, count, false, "flags") &&
                binding_has(&b[5], 4, count, false, "islands") && binding_has(&b[6], 8, count, false, "sizes");
    Py_ssize_t at = 0;
    Py_ssize_t corner = 0;
    for (uint32_t slot = 0; good && slot < tl_navmesh_slot_count(held->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(held->navmesh, slot);
        good = tile == NULL || (at + tile->polygon_count <= count && corner + tile->corner_count <= corners);
        for (uint32_t p = 0; good && tile != NULL && p < tile->polygon_count; p++, at++) {
            uint32_t n;
            const tl_vec3 *points = tl_nav_tile_corners(tile, p, &n);
            memcpy((tl_vec3 *)b[0].buf + corner, points, n * sizeof(*points));
            ((uint32_t *)b[1].buf)[at] = (uint32_t)corner;
            tl_nav_ref ref = tl_navmesh_polygon_ref(held->navmesh, slot, p);
            ((uint64_t *)b[2].buf)[at] = ref;
            ((uint8_t *)b[3].buf)[at] = tl_nav_tile_area(tile, p);
            ((uint64_t *)b[4].buf)[at] = tl_nav_tile_flags(tile, p);
            tl_navmesh_island(held->navmesh, ref, (uint32_t *)b[5].buf + at);
            ((double *)b[6].buf)[at] = tl_nav_tile_polygon_area(tile, p);
            corner += n;
        }
    }
    if (good) {
        ((uint32_t *)b[1].buf)[count] = (uint32_t)corner;
    }
    binding_release(b, 7);
    return good ? Py_NewRef(Py_None) : PyErr_Occurred() ? NULL : PyErr_Format(PyExc_ValueError, "arrays are too small");
}

// navmesh_surface(navmesh, vertices f32[v][3], faces u32[t][3], polygons u32[t]): the detail mesh of all tiles
static PyObject *navmesh_surface(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    Py_buffer b[3];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "Ow*w*w*", &capsule, &b[0], &b[1], &b[2])) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    Py_ssize_t vertices = held != NULL ? binding_count(&b[0], sizeof(tl_vec3), "vertices") : -1;
    Py_ssize_t triangles = vertices >= 0 ? binding_count(&b[2], 4, "polygons") : -1;
    bool good = triangles >= 0 && binding_has(&b[1], 12, triangles, false, "faces");
    Py_ssize_t vertex = 0;
    Py_ssize_t triangle = 0;
    uint32_t polygon = 0;
    for (uint32_t slot = 0; good && slot < tl_navmesh_slot_count(held->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(held->navmesh, slot);
        for (uint32_t p = 0; good && tile != NULL && p < tile->polygon_count; p++, polygon++) {
            tl_nav_surface surface = tl_nav_tile_surface(tile, p);
            good = vertex + surface.vertex_count <= vertices && triangle + surface.triangle_count <= triangles;
            for (uint32_t t = 0; good && t < surface.triangle_count; t++, triangle++) {
                const tl_nav_detail_triangle face = tl_nav_surface_triangle(&surface, t);
                for (int k = 0; k < 3; k++) {
                    ((uint32_t *)b[1].buf)[3 * triangle + k] = (uint32_t)vertex + face.corner[k];
                }
                ((uint32_t *)b[2].buf)[triangle] = polygon;
            }
            if (good) {
                memcpy((tl_vec3 *)b[0].buf + vertex, surface.vertices, surface.vertex_count * sizeof(tl_vec3));
                vertex += surface.vertex_count;
            }
        }
    }
    binding_release(b, 3);
    if (!good) {
        return PyErr_Occurred() ? NULL : PyErr_Format(PyExc_ValueError, "arrays are too small");
    }
    return Py_BuildValue("nn", vertex, triangle);
}

// --- points ---------------------------------------------------------------------------------------------------------

// navmesh_nearest(navmesh, filter, points, (ex, ey, ez), refs u64, nearest f32[n][3]): ref 0 where nothing is near
static PyObject *navmesh_nearest(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    tl_vec3 extents;
    Py_buffer b[3];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "OOy*(fff)w*w*", &capsule, &filter_tuple, &b[0], &extents.x, &extents.y, &extents.z,
                          &b[1], &b[2])) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    tl_nav_filter filter;
    Py_ssize_t count =
        held != NULL && binding_filter(filter_tuple, &filter) ? binding_count(&b[0], sizeof(tl_vec3), "points") : -1;
    bool good =
        count >= 0 && binding_has(&b[1], 8, count, false, "refs") && binding_has(&b[2], 12, count, false, "nearest");
    tl_result result = TL_OK;
    if (good) {
        Py_BEGIN_ALLOW_THREADS for (Py_ssize_t i = 0; i < count && !tl_is_error(result); i++)
        {
            tl_nav_location found;
            result = tl_navmesh_find_nearest(held->navmesh, &filter, ((const tl_vec3 *)b[0].buf)[i], extents, &found);
            ((uint64_t *)b[1].buf)[i] = found.polygon;
            ((tl_vec3 *)b[2].buf)[i] = result == TL_OK ? found.point : tl_vec3_make(NAN, NAN, NAN);
        }
        Py_END_ALLOW_THREADS
    }
    binding_release(b, 3);
    if (good && tl_is_error(result)) {
        return binding_raise(result, NULL);
    }
    return good ? Py_NewRef(Py_None) : NULL;
}

// navmesh_random(navmesh, filter, numbers u64[n][2], points f32[n][3], refs u64[n])
static PyObject *navmesh_random(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    Py_buffer b[3];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "OOy*w*w*", &capsule, &filter_tuple, &b[0], &b[1], &b[2])) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    tl_nav_filter filter;
    Py_ssize_t count = held != NULL && binding_filter(filter_tuple, &filter) ? binding_count(&b[0], 16, "numbers") : -1;
    bool good =
        count >= 0 && binding_has(&b[1], 12, count, false, "points") && binding_has(&b[2], 8, count, false, "refs");
    tl_result result = TL_OK;
    for (Py_ssize_t i = 0; good && i < count && result == TL_OK; i++) {
        tl_nav_location found;
        result = tl_navmesh_random_point(held->navmesh, &filter, (const uint64_t *)b[0].buf + 2 * i, &found);
        ((tl_vec3 *)b[1].buf)[i] = found.point;
        ((uint64_t *)b[2].buf)[i] = found.polygon;
    }
    binding_release(b, 3);
    if (good && result != TL_OK) {
        return binding_raise(result, NULL);
    }
    return good ? Py_NewRef(Py_None) : NULL;
}

// navmesh_walls(navmesh, filter, refs u64, points, radius, distances f32, walls f32[n][3], normals f32[n][3])
static PyObject *navmesh_walls(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    float radius = 0;
    Py_buffer b[5];
    memset(b, 0, sizeof(b));
    if (!PyArg_ParseTuple(args, "OOy*y*fw*w*w*", &capsule, &filter_tuple, &b[0], &b[1], &radius, &b[2], &b[3], &b[4])) {
        return NULL;
    }
    binding_navmesh *held = binding_navmesh_of(capsule);
    tl_nav_filter filter;
    Py_ssize_t count = held != NULL && binding_filter(filter_tuple, &filter) ? binding_count(&b[0], 8, "refs") : -1;
    bool good = count >= 0 && binding_has(&b[1], 12, count, false, "points") &&
                binding_has(&b[2], 4, count, false, "distances") && binding_has(&b[3], 12, count, false, "walls") &&
                binding_has(&b[4], 12, count, false, "normals");
    tl_nav_query *query = good ? binding_query_of(held) : NULL;
    tl_result result = TL_OK;
    for (Py_ssize_t i = 0; query != NULL && i < count && result == TL_OK; i++) {
        tl_nav_around_request request = { &filter,
                                          { ((const uint64_t *)b[0].buf)[i], ((const tl_vec3 *)b[1].buf)[i] },
                                          radius };
        tl_nav_wall wall;
        result = tl_nav_query_find_wall(query, held->navmesh, &request, &wall);
        ((float *)b[2].buf)[i] = wall.hit ? wall.distance : INFINITY;
        ((tl_vec3 *)b[3].buf)[i] = wall.hit ? wall.point : tl_vec3_make(NAN, NAN, NAN);
        ((tl_vec3 *)b[4].buf)[i] = wall.normal;
    }
    binding_release(b, 5);
    if (query != NULL && result != TL_OK) {
        return binding_raise(result, NULL);
    }
    return query != NULL ? Py_NewRef(Py_None) : NULL;
}

// navmesh_raycast(navmesh, filter, ref, (start), (end)) -> (hit, t, point, normal)
static PyObject *navmesh_raycast(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    unsigned long long ref = 0;
    tl_nav_location start;
    tl_vec3 end;
    if (!PyArg_ParseTuple(args, "OOK(fff)(fff)", &capsule, &filter_tuple, &ref, &start.point.x, &start.point.y,
                          &start.point.z, &end.x, &end.y, &end.z)) {
        return NULL;
    }
    const binding_navmesh *held = binding_navmesh_of(capsule);
    tl_nav_filter filter;
    if (held == NULL || !binding_filter(filter_tuple, &filter)) {
        return NULL;
    }
    start.polygon = ref;
    tl_nav_ray_hit hit;
    tl_result result = tl_navmesh_cast_ray(held->navmesh, &filter, &start, end, NULL, 0, &hit);
    if (tl_is_error(result)) {
        return binding_raise(result, NULL);
    }
    float y = hit.point.y;
    tl_navmesh_height(held->navmesh, hit.polygon, hit.point.x, hit.point.z, &y);
    return Py_BuildValue("Nf(fff)(fff)", PyBool_FromLong(hit.hit), hit.t, hit.point.x, y, hit.point.z, hit.normal.x,
                         hit.normal.y, hit.normal.z);
}

// navmesh_move(navmesh, filter, ref, (start), (target)) -> (ref, point)
static PyObject *navmesh_move(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    PyObject *filter_tuple;
    unsigned long long ref = 0;
    tl_nav_move_request request;
    if (!PyArg_ParseTuple(args, "OOK(fff)(fff)", &capsule, &filter_tuple, &ref, &request.start.point.x,
                          &request.start.point.y, &request.start.point.z, &request.target.x, &request.target.y,
                          &request.target.z)) {
        return NULL;
    }
    binding_navmesh *held = binding_navmesh_of(capsule);
    tl_nav_filter filter;
    tl_nav_query *query = held != NULL && binding_filter(filter_tuple, &filter) ? binding_query_of(held) : NULL;
    if (query == NULL) {
        return NULL;
    }
    request.filter = &filter;
    request.start.polygon = ref;
    tl_nav_move move;
    tl_result result = tl_nav_query_move_along_surface(query, held->navmesh, &request, NULL, 0, &move);
    if (tl_is_error(result)) {
        return binding_raise(result, NULL);
    }
    tl_vec3 p = move.end.point;
    tl_navmesh_height(held->navmesh, move.end.polygon, p.x, p.z, &p.y);
    return Py_BuildValue("K(fff)", (unsigned long long)move.end.polygon, p.x, p.y, p.z);
}

PyMethodDef binding_navmesh_methods[] = {
    { "navmesh_counts", navmesh_counts, METH_O, NULL },
    { "navmesh_polygons", navmesh_polygons, METH_VARARGS, NULL },
    { "navmesh_surface", navmesh_surface, METH_VARARGS, NULL },
    { "navmesh_nearest", navmesh_nearest, METH_VARARGS, NULL },
    { "navmesh_random", navmesh_random, METH_VARARGS, NULL },
    { "navmesh_walls", navmesh_walls, METH_VARARGS, NULL },
    { "navmesh_raycast", navmesh_raycast, METH_VARARGS, NULL },
    { "navmesh_move", navmesh_move, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
