// SPDX-License-Identifier: MIT
//
// Baking a navmesh, and what its settings are.

#include "binding.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the def as a dict ----------------------------------------------------------------------------------------------

typedef enum def_kind { DEF_FLOAT, DEF_COUNT, DEF_BOOL, DEF_PARTITION, DEF_METHOD } def_kind;

typedef struct def_field {
    const char *name;
    size_t offset;
    def_kind kind;
} def_field;

#define FIELD(name, kind)                                                                                              \
    {                                                                                                                  \
#name, offsetof(tl_nav_def, name), kind                                                                        \
    }

static const def_field def_fields[] = {
    FIELD(cell_size, DEF_FLOAT),
    FIELD(cell_height, DEF_FLOAT),
    FIELD(agent_height, DEF_FLOAT),
    FIELD(agent_radius, DEF_FLOAT),
    FIELD(agent_max_climb, DEF_FLOAT),
    FIELD(agent_max_slope, DEF_FLOAT),
    FIELD(region_min_size, DEF_FLOAT),
    FIELD(region_merge_size, DEF_FLOAT),
    FIELD(edge_max_len, DEF_FLOAT),
    FIELD(edge_max_error, DEF_FLOAT),
    FIELD(max_verts_per_poly, DEF_COUNT),
    FIELD(detail_sample_dist, DEF_FLOAT),
    FIELD(detail_sample_max_error, DEF_FLOAT),
    FIELD(partition, DEF_PARTITION),
    FIELD(polygon_method, DEF_METHOD),
    FIELD(filter_low_hanging_obstacles, DEF_BOOL),
    FIELD(filter_ledge_spans, DEF_BOOL),
    FIELD(filter_walkable_low_height_spans, DEF_BOOL),
    FIELD(tile_size, DEF_COUNT),
    FIELD(tile_height, DEF_FLOAT),
};
enum { DEF_FIELDS = sizeof(def_fields) / sizeof(def_fields[0]) };

static const char *const partition_names[] = { "watershed", "monotone", "layers", NULL };
static const char *const method_names[] = { "classic", "optimal", "delaunay", NULL };

static int index_of_name(const char *const *names, PyObject *word, const char *field)
{
    const char *text = PyUnicode_AsUTF8AndSize(word, NULL);
    for (int i = 0; text != NULL && names[i] != NULL; i++) {
        if (strcmp(names[i], text) == 0) {
            return i;
        }
    }
    if (text != NULL) {
        PyErr_Format(PyExc_ValueError, "%s: no choice is called '%s'", field, text);
    }
    return -1;
}

static bool take_field(PyObject *value, const def_field *field, tl_nav_def *def)
{
    char *at = (char *)def + field->offset;
    if (field->kind == DEF_FLOAT) {
        *(float *)(void *)at = (float)PyFloat_AsDouble(value);
    } else if (field->kind == DEF_BOOL) {
        *(bool *)(void *)at = PyObject_IsTrue(value) == 1;
    } else if (field->kind == DEF_COUNT) {
        unsigned long count = PyLong_AsUnsignedLong(value);
        if (count > UINT32_MAX && PyErr_Occurred() == NULL) {
            PyErr_Format(PyExc_ValueError, "%s is too large", field->name);
        }
        *(uint32_t *)(void *)at = (uint32_t)count;
    } else if (field->kind == DEF_PARTITION) {
        int index = index_of_name(partition_names, value, field->name);
        def->partition = (tl_nav_partition)(index > 0 ? index : 0);
    } else {
        int index = index_of_name(method_names, value, field->name);
        def->polygon_method = (tl_partition_method)(index > 0 ? index : 0);
    }
    return PyErr_Occurred() == NULL;
}

bool binding_nav_def(PyObject *settings, tl_nav_def *def)
{
    for (int i = 0; i < DEF_FIELDS; i++) {
        PyObject *value = PyDict_GetItemString(settings, def_fields[i].name);
        if (value != NULL && !take_field(value, &def_fields[i], def)) {
            return false;
        }
    }
    PyObject *bounds = PyDict_GetItemString(settings, "bounds");
    if (bounds != NULL && bounds != Py_None) {
        return PyArg_ParseTuple(bounds, "(fff)(fff);bounds is ((x, y, z), (x, y, z))", &def->bounds.min.x,
                                &def->bounds.min.y, &def->bounds.min.z, &def->bounds.max.x, &def->bounds.max.y,
                                &def->bounds.max.z) != 0;
    }
    return true;
}

// The shortest decimal number that is this float, so that 0.3f is 0.3 in Python too.
static double shortest_double(float value)
{
    char text[32];
    for (int digits = 6; digits < 9; digits++) {
        snprintf(text, sizeof(text), "%.*g", digits, (double)value);
        if (strtof(text, NULL) == value) {
            return strtod(text, NULL);
        }
    }
    return (double)value;
}

static PyObject *field_value(const def_field *field, const tl_nav_def *def)
{
    const char *at = (const char *)def + field->offset;
    switch (field->kind) {
    case DEF_FLOAT:
        return PyFloat_FromDouble(shortest_double(*(const float *)(const void *)at));
    case DEF_COUNT:
        return PyLong_FromUnsignedLong(*(const uint32_t *)(const void *)at);
    case DEF_BOOL:
        return PyBool_FromLong(*(const bool *)(const void *)at);
    case DEF_PARTITION:
        return PyUnicode_FromString(partition_names[def->partition]);
    default:
        return PyUnicode_FromString(method_names[def->polygon_method]);
    }
}

PyObject *binding_nav_def_dict(const tl_nav_def *def)
{
    PyObject *dict = PyDict_New();
    for (int i = 0; dict != NULL && i < DEF_FIELDS; i++) {
        PyObject *value = field_value(&def_fields[i], def);
        if (value == NULL || PyDict_SetItemString(dict, def_fields[i].name, value) != 0) {
            Py_CLEAR(dict);
        }
        Py_XDECREF(value);
    }
    const tl_aabb box = def->bounds;
    PyObject *bounds = dict == NULL ? NULL
                       : tl_aabb_is_empty(box)
                           ? Py_NewRef(Py_None)
                           : Py_BuildValue("(fff)(fff)", (double)box.min.x, (double)box.min.y, (double)box.min.z,
                                           (double)box.max.x, (double)box.max.y, (double)box.max.z);
    if (bounds == NULL || PyDict_SetItemString(dict, "bounds", bounds) != 0) {
        Py_CLEAR(dict);
    }
    Py_XDECREF(bounds);
    return dict;
}

// nav_default_settings() -> dict
static PyObject *nav_default_settings(PyObject *self, PyObject *none)
{
    (void)self;
    (void)none;
    tl_nav_def def = tl_default_nav_def();
    return binding_nav_def_dict(&def);
}

// --- the level ------------------------------------------------------------------------------------------------------

void binding_level_free(binding_level *level)
{
    tl_mesh_free(&level->mesh);
    free(level->areas);
    free(level->volumes);
    binding_release(level->buffers, 3);
    memset(level, 0, sizeof(*level));
}

// A volume is (kind, area, six numbers, points as bytes): box min and max; y range of a polygon in numbers 1 and 4;
// base, radius and height of a cylinder. The bytes are borrowed from the list, which the caller keeps.
static bool take_volume(PyObject *item, tl_nav_volume *volume)
{
    int kind = 0;
    int area = 0;
    float n[6];
    PyObject *points;
    if (!PyArg_ParseTuple(item, "ii(ffffff)O", &kind, &area, &n[0], &n[1], &n[2], &n[3], &n[4], &n[5], &points)) {
        return false;
    }
    memset(volume, 0, sizeof(*volume));
    volume->kind = (tl_nav_volume_kind)kind;
    volume->area = (uint8_t)area;
    if (kind == TL_NAV_VOLUME_CYLINDER) {
        volume->base = tl_vec3_make(n[0], n[1], n[2]);
        volume->radius = n[3];
        volume->height = n[4];
    } else {
        volume->box.min = tl_vec3_make(n[0], n[1], n[2]);
        volume->box.max = tl_vec3_make(n[3], n[4], n[5]);
    }
    if (kind == TL_NAV_VOLUME_POLYGON) {
        char *bytes;
        Py_ssize_t size;
        if (PyBytes_AsStringAndSize(points, &bytes, &size) != 0) {
            return false;
        }
        volume->points = (const tl_vec3 *)(const void *)bytes;
        volume->point_count = (uint32_t)((size_t)size / sizeof(tl_vec3));
    }
    return true;
}

static bool take_volumes(PyObject *list, binding_level *level)
{
    Py_ssize_t count = PyList_Size(list);
    level->volumes = count >= 0 ? calloc((size_t)count + 1, sizeof(*level->volumes)) : NULL;
    if (level->volumes == NULL) {
        if (count >= 0) {
            PyErr_NoMemory();
        }
        return false;
    }
    for (Py_ssize_t i = 0; i < count; i++) {
        if (!take_volume(PyList_GetItem(list, i), &level->volumes[i])) {
            return false;
        }
    }
    level->input.volumes = level->volumes;
    level->input.volume_count = (uint32_t)count;
    return true;
}

// Areas are given by triangle of the view; the bake wants them by triangle of the cleaned mesh.
static bool take_areas(const uint8_t *areas, binding_level *level)
{
    if (areas == NULL) {
        return true;
    }
    level->areas = malloc((size_t)level->mesh.triangle_count + 1);
    if (level->areas == NULL) {
        PyErr_NoMemory();
        return false;
    }
    for (uint32_t i = 0; i < level->mesh.triangle_count; i++) {
        level->areas[i] = areas[level->mesh.source_triangles[i]];
    }
    level->input.areas = level->areas;
    return true;
}

bool binding_level_take(PyObject *tuple, binding_level *level)
{
    memset(level, 0, sizeof(*level));
    Py_buffer *b = level->buffers;
    PyObject *volumes;
    if (!PyArg_ParseTuple(tuple, "y*y*z*O", &b[0], &b[1], &b[2], &volumes)) {
        return false;
    }
    Py_ssize_t vertex_count = binding_count(&b[0], sizeof(tl_vec3), "vertices");
    Py_ssize_t triangle_count = binding_count(&b[1], 3 * sizeof(uint32_t), "faces");
    if (vertex_count < 0 || triangle_count < 0 || !binding_has(&b[2], 1, triangle_count, true, "areas")) {
        return false;
    }
    if (vertex_count > TL_MAX_MESH_VERTICES || triangle_count > TL_MAX_MESH_TRIANGLES) {
        binding_raise(TL_ERR_LIMIT, NULL);
        return false;
    }
    const tl_mesh_view view = { b[0].buf, (uint32_t)vertex_count, b[1].buf, (uint32_t)triangle_count, NULL };
    tl_mesh_report report;
    tl_result result = tl_mesh_bake(&view, NULL, &level->mesh, &report);
    if (result != TL_OK) {
        binding_raise(result, &report.base);
        return false;
    }
    level->input.mesh = tl_mesh_as_view(&level->mesh);
    return take_areas(b[2].buf, level) && take_volumes(volumes, level);
}

// --- the bake -------------------------------------------------------------------------------------------------------

// What is left out of a finished navmesh: seeds as bytes, or None; whether islands in solids are; smallest area.
typedef struct prune_choice {
    Py_buffer seeds;
    int inside;
    double min_area;
} prune_choice;

// Prunes, and keeps what was removed and the rules, for audit, why and files.
static tl_result prune_tiles(const prune_choice *choice, const binding_level *level, tl_nav_tiles *tiles,
                             binding_navmesh *made, tl_report *report)
{
    tl_nav_prune_def def = tl_default_nav_prune_def();
    def.seeds = choice->seeds.buf;
    def.seed_count = (uint32_t)((size_t)choice->seeds.len / sizeof(tl_vec3));
    def.solids = choice->inside ? &level->input.mesh : NULL;
    def.min_area = choice->min_area;
    def.host = made->def.host;
    if (tiles->tile_count == 0 || (def.seed_count == 0 && !choice->inside && choice->min_area <= 0)) {
        return TL_OK;
    }
    tl_nav_prune_report pruned;
    tl_nav_tiles removed;
    tl_result result = tl_nav_prune(&def, tiles, &removed, &pruned);
    *report = pruned.base;
    if (result == TL_OK) {
        result = tl_pack_pruning_encode(&def, NULL, &made->own_pruning, report);
        made->pruning = made->own_pruning;
    }
    if (result == TL_OK && removed.tile_count > 0) {
        result = tl_navmesh_create(NULL, &made->removed);
    }
    if (result == TL_OK && removed.tile_count > 0) {
        result = tl_navmesh_add_tiles(made->removed, removed.tiles, removed.tile_count, TL_NAV_TILE_OWNED, report);
        removed.tile_count = result == TL_OK ? 0 : removed.tile_count; // the navmesh has them now
    }
    tl_nav_tiles_free(&removed);
    return result;
}

static tl_result bake_plain(binding_navmesh *made, const binding_level *level, const prune_choice *choice,
                            tl_nav_bake_report *report)
{
    tl_nav_tiles tiles;
    tl_result result = tl_nav_bake(&made->def, &level->input, &tiles, report);
    if (result != TL_OK) {
        return result;
    }
    result = prune_tiles(choice, level, &tiles, made, &report->base);
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(made->navmesh, tiles.tiles, tiles.tile_count, TL_NAV_TILE_OWNED, &report->base);
    }
    if (result == TL_OK) {
        made->tiles_x = tiles.tiles_x;
        made->tiles_z = tiles.tiles_z;
        tiles.tile_count = 0; // the navmesh has them now
    }
    tl_nav_tiles_free(&tiles);
    return result;
}

static tl_result bake_with_obstacles(binding_navmesh *made, const binding_level *level, tl_nav_bake_report *report)
{
    tl_nav_tile_block block;
    tl_result result = tl_nav_tile_grid(&made->def, level->mesh.bounds, &made->tiles_x, &made->tiles_z, &report->base);
    if (result != TL_OK) {
        return result;
    }
    result = tl_nav_obstacles_bake(&made->def, &level->input, &made->obstacles, &block, report);
    if (result != TL_OK) {
        return result;
    }
    const tl_nav_tile_range range = block.range;
    for (uint32_t i = 0; i < range.count_x * range.count_z && result == TL_OK; i++) {
        result = tl_navmesh_replace_tiles(made->navmesh, (int32_t)(range.x + i % range.count_x),
                                          (int32_t)(range.z + i / range.count_x), &block.stacks[i]);
    }
    tl_nav_tile_block_free(&block);
    return result;
}

static PyObject *report_dict(const tl_nav_bake_report *r)
{
    return Py_BuildValue("{sKsKsIsIsKsdsIsIsIsIsIsIsI}", "span_count", (unsigned long long)r->span_count,
                         "compact_span_count", (unsigned long long)r->compact_span_count, "region_count",
                         r->region_count, "filtered_regions", r->filtered_regions, "filtered_spans",
                         (unsigned long long)r->filtered_spans, "filtered_area", r->filtered_area, "contour_count",
                         r->contour_count, "unbridged_holes", r->unbridged_holes, "repaired_contours",
                         r->repaired_contours, "polygon_count", r->polygon_count, "vertex_count", r->vertex_count,
                         "detail_triangle_count", r->detail_triangle_count, "tile_count", r->tile_count);
}

// nav_bake(level, settings, (seeds, inside solids, min area), with obstacles, threads, progress) -> (capsule, report)
static PyObject *nav_bake(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *level_tuple;
    PyObject *settings;
    PyObject *progress;
    prune_choice choice;
    memset(&choice, 0, sizeof(choice));
    int with_obstacles = 0;
    unsigned threads = 1;
    if (!PyArg_ParseTuple(args, "OO!(z*pd)pIO", &level_tuple, &PyDict_Type, &settings, &choice.seeds, &choice.inside,
                          &choice.min_area, &with_obstacles, &threads, &progress)) {
        return NULL;
    }
    binding_level level;
    binding_navmesh made;
    memset(&made, 0, sizeof(made));
    made.def = tl_default_nav_def();
    PyObject *answer = NULL;
    if (binding_level_take(level_tuple, &level) && binding_nav_def(settings, &made.def)) {
        if (tl_aabb_is_empty(made.def.bounds)) {
            made.def.bounds = level.mesh.bounds;
        }
        tl_nav_bake_report report;
        memset(&report, 0, sizeof(report));
        binding_host host;
        binding_begin(&host, progress, threads);
        made.def.host = host.host;
        tl_result result = tl_navmesh_create(NULL, &made.navmesh);
        if (result == TL_OK) {
            result = with_obstacles ? bake_with_obstacles(&made, &level, &report)
                                    : bake_plain(&made, &level, &choice, &report);
        }
        made.def.host = (tl_host){ NULL, NULL, NULL };
        binding_end(&host);
        made.obstacle_shapes = result == TL_OK && with_obstacles ? PyDict_New() : NULL;
        result = result == TL_OK && with_obstacles && made.obstacle_shapes == NULL ? TL_ERR_MEMORY : result;
        if (result == TL_OK) {
            PyObject *capsule = binding_navmesh_capsule(&made);
            PyObject *counts = capsule != NULL ? report_dict(&report) : NULL;
            answer = counts != NULL ? Py_BuildValue("NN", capsule, counts) : NULL;
        } else {
            binding_raise(result, &report.base);
            binding_navmesh_free_parts(&made);
        }
    }
    binding_level_free(&level);
    binding_release(&choice.seeds, 1);
    return answer;
}

PyMethodDef binding_bake_methods[] = {
    { "nav_default_settings", nav_default_settings, METH_NOARGS, NULL },
    { "nav_bake", nav_bake, METH_VARARGS, NULL },
    { NULL, NULL, 0, NULL },
};
