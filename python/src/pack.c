// SPDX-License-Identifier: MIT
//
// Baked files: what the command writes is read here, and the other way round, byte for byte.

#include "binding.h"

#include <stdlib.h>
#include <string.h>

// --- writing --------------------------------------------------------------------------------------------------------

typedef struct pack_writer {
    tl_pack_item *items;
    uint32_t count;
    tl_pack_meta *meta;
    tl_pack_navmesh *navmesh;
    tl_pack_volumes *volumes;
    binding_saved_links links;
    PyObject *kept; // list of (type, id, bytes): chunks of the file read, which Python has no objects for
    char *at;       // where the next bytes go
} pack_writer;

static void add_item(pack_writer *writer, uint32_t type, uint32_t id, const void *blob)
{
    if (blob != NULL) {
        tl_pack_item item = { type, id, blob, ((const tl_blob *)blob)->size };
        writer->items[writer->count++] = item;
    }
}

// Chunks that a bake writes here and there; all others stand at the end.
static int place_of_kept(unsigned long type)
{
    return type == TL_PACK_FRAM ? 0 : type == TL_PACK_OFFM || type == TL_PACK_AREA ? 1 : 2;
}

static void add_kept(pack_writer *writer, int place)
{
    for (Py_ssize_t i = 0; i < PyList_Size(writer->kept); i++) {
        PyObject *chunk = PyList_GetItem(writer->kept, i);
        const unsigned long type = PyLong_AsUnsignedLong(PyTuple_GetItem(chunk, 0));
        PyObject *bytes = PyTuple_GetItem(chunk, 2);
        // Of links set by hand the navmesh has the last word.
        bool is_stale = type == TL_PACK_OFFM && writer->navmesh != NULL;
        if (place_of_kept(type) == place && !is_stale) {
            const tl_pack_item item = { (uint32_t)type, (uint32_t)PyLong_AsUnsignedLong(PyTuple_GetItem(chunk, 1)),
                                        PyBytes_AsString(bytes), (uint64_t)PyBytes_Size(bytes) };
            writer->items[writer->count++] = item;
        }
    }
}

// Whether it is a list of (type, id, bytes).
static bool check_kept(PyObject *kept)
{
    for (Py_ssize_t i = 0; i < PyList_Size(kept); i++) {
        unsigned long type = 0;
        unsigned long id = 0;
        PyObject *bytes = NULL;
        PyObject *chunk = PyList_GetItem(kept, i);
        if (!PyTuple_Check(chunk)) {
            PyErr_SetString(PyExc_TypeError, "a chunk is a tuple of type, id and bytes");
            return false;
        }
        if (!PyArg_ParseTuple(chunk, "kkS", &type, &id, &bytes)) {
            return false;
        }
    }
    return true;
}

static tl_result copy_bytes(const void *bytes, size_t size, void *user)
{
    pack_writer *writer = user;
    memcpy(writer->at, bytes, size);
    writer->at += size;
    return TL_OK;
}

static int compare_places(const void *a, const void *b)
{
    const tl_nav_tile *s = *(const tl_nav_tile *const *)a;
    const tl_nav_tile *t = *(const tl_nav_tile *const *)b;
    return s->tile_z != t->tile_z   ? (s->tile_z < t->tile_z ? -1 : 1)
           : s->tile_x != t->tile_x ? (s->tile_x < t->tile_x ? -1 : 1)
                                    : (s->layer > t->layer) - (s->layer < t->layer);
}

// The tiles as a bake orders them: by row, column, layer. Slots hold them in the order in which they came.
static tl_result add_tiles(pack_writer *writer, uint32_t type, const tl_navmesh *navmesh)
{
    const tl_nav_tile **tiles = malloc(((size_t)tl_navmesh_tile_count(navmesh) + 1) * sizeof(*tiles));
    if (tiles == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        if (tile != NULL) {
            tiles[count++] = tile;
        }
    }
    qsort((void *)tiles, count, sizeof(*tiles), compare_places);
    for (uint32_t i = 0; i < count; i++) {
        add_item(writer, type, i, tiles[i]);
    }
    free((void *)tiles);
    return TL_OK;
}

static tl_result add_navmesh(pack_writer *writer, const binding_navmesh *held)
{
    tl_result result = tl_pack_navmesh_encode(&held->def, held->tiles_x, held->tiles_z,
                                              tl_navmesh_tile_count(held->navmesh), NULL, &writer->navmesh, NULL);
    if (result == TL_OK) {
        add_item(writer, TL_PACK_NAVM, 0, writer->navmesh);
        result = add_tiles(writer, TL_PACK_NAVT, held->navmesh);
    }
    return result;
}

static size_t item_limit(const binding_navmesh *held, PyObject *kept)
{
    size_t tiles = held == NULL ? 0 : tl_navmesh_tile_count(held->navmesh);
    return 8 + (size_t)PyList_Size(kept) + tiles +
           (held != NULL && held->removed != NULL ? tl_navmesh_tile_count(held->removed) : 0);
}

// What follows the tiles: links, volumes, and what was pruned.
static tl_result add_rest(pack_writer *writer, const binding_navmesh *held)
{
    add_item(writer, TL_PACK_LINK, 0, writer->links.found);
    add_item(writer, TL_PACK_OFFM, 0, writer->links.by_hand);
    add_kept(writer, 1);
    add_item(writer, TL_PACK_MARK, 0, writer->volumes);
    add_item(writer, TL_PACK_PRUN, 0, held != NULL ? held->pruning : NULL);
    const tl_result result =
        held != NULL && held->removed != NULL ? add_tiles(writer, TL_PACK_PRUT, held->removed) : TL_OK;
    add_kept(writer, 2);
    return result;
}

// pack_write(name, up, vertices, triangles, ((bounds)), soup or None, hull or None, navmesh or None, level or None,
// kept) -> bytes
static PyObject *pack_write(PyObject *self, PyObject *args)
{
    (void)self;
    const char *name;
    const char *up;
    unsigned long long vertices = 0;
    unsigned long long triangles = 0;
    tl_aabb bounds;
    PyObject *soup_capsule;
    PyObject *hull_capsule;
    PyObject *navmesh_capsule;
    PyObject *level_tuple;
    PyObject *kept;
    if (!PyArg_ParseTuple(args, "ssKK((fff)(fff))OOOOO!", &name, &up, &vertices, &triangles, &bounds.min.x,
                          &bounds.min.y, &bounds.min.z, &bounds.max.x, &bounds.max.y, &bounds.max.z, &soup_capsule,
                          &hull_capsule, &navmesh_capsule, &level_tuple, &PyList_Type, &kept) ||
        !check_kept(kept)) {
        return NULL;
    }
    const void *soup = soup_capsule != Py_None ? binding_blob_of(soup_capsule, BINDING_SOUP) : NULL;
    const void *hull = hull_capsule != Py_None ? binding_blob_of(hull_capsule, BINDING_HULL) : NULL;
    const binding_navmesh *held = navmesh_capsule != Py_None ? binding_navmesh_of(navmesh_capsule) : NULL;
    binding_level level;
    memset(&level, 0, sizeof(level));
    if (PyErr_Occurred() != NULL || (level_tuple != Py_None && !binding_level_take(level_tuple, &level))) {
        binding_level_free(&level);
        return NULL;
    }
    pack_writer writer;
    memset(&writer, 0, sizeof(writer));
    writer.kept = kept;
    writer.items = calloc(item_limit(held, kept), sizeof(*writer.items));
    tl_result result = writer.items != NULL ? TL_OK : TL_ERR_MEMORY;
    tl_report report = { NULL, NULL, NULL, TL_NO_ELEMENT, NULL, 0 };
    if (result == TL_OK) {
        result = tl_pack_meta_encode(name, vertices, triangles, bounds, NULL, &writer.meta, &report);
    }
    if (result == TL_OK) {
        writer.meta->source_up = strcmp(up, "z") == 0 ? TL_PACK_UP_Z : TL_PACK_UP_Y;
        add_item(&writer, TL_PACK_META, 0, writer.meta);
        add_kept(&writer, 0);
        add_item(&writer, TL_PACK_SOUP, 0, soup);
        add_item(&writer, TL_PACK_HULL, 0, hull);
        result = held != NULL ? add_navmesh(&writer, held) : TL_OK;
    }
    if (result == TL_OK && level.input.volume_count > 0) {
        result = tl_pack_volumes_encode(level.volumes, level.input.volume_count, NULL, &writer.volumes, &report);
    }
    if (result == TL_OK && held != NULL) {
        result = binding_links_to_save(held, &writer.links, &report);
    }
    PyObject *bytes = NULL;
    result = result == TL_OK ? add_rest(&writer, held) : result;
    if (result == TL_OK) {
        bytes = PyBytes_FromStringAndSize(NULL, (Py_ssize_t)tl_pack_size(writer.items, writer.count));
        if (bytes != NULL) {
            writer.at = PyBytes_AsString(bytes);
            result = tl_pack_write(writer.items, writer.count, NULL, copy_bytes, &writer, &report);
        }
    }
    if (result != TL_OK) {
        Py_CLEAR(bytes);
        binding_raise(result, &report);
    }
    free(writer.items);
    tl_blob_free(writer.meta);
    tl_blob_free(writer.navmesh);
    tl_blob_free(writer.volumes);
    binding_saved_links_free(&writer.links);
    binding_level_free(&level);
    return bytes;
}

// --- reading --------------------------------------------------------------------------------------------------------

typedef struct open_pack {
    void *block; // what was allocated
    tl_pack pack;
} open_pack;

static void free_pack(PyObject *capsule)
{
    open_pack *held = PyCapsule_GetPointer(capsule, BINDING_PACK);
    free(held->block);
    free(held);
}

// pack_open(bytes) -> capsule: a checked copy
static PyObject *pack_open(PyObject *self, PyObject *args)
{
    (void)self;
    Py_buffer bytes;
    if (!PyArg_ParseTuple(args, "y*", &bytes)) {
        return NULL;
    }
    open_pack *held = calloc(1, sizeof(*held));
    size_t size = (size_t)bytes.len;
    if (held != NULL) {
        held->block = malloc(size + TL_BLOB_ALIGNMENT);
    }
    if (held == NULL || held->block == NULL) {
        free(held);
        PyBuffer_Release(&bytes);
        return PyErr_NoMemory();
    }
    char *copy = (char *)held->block + (TL_BLOB_ALIGNMENT - (uintptr_t)held->block % TL_BLOB_ALIGNMENT);
    memcpy(copy, bytes.buf, size);
    PyBuffer_Release(&bytes);
    tl_report report;
    tl_result result = tl_pack_open(copy, size, &held->pack, &report);
    PyObject *capsule = result == TL_OK ? PyCapsule_New(held, BINDING_PACK, free_pack) : binding_raise(result, &report);
    if (capsule == NULL) {
        free(held->block);
        free(held);
    }
    return capsule;
}

// pack_blob(pack, kind): "soup" or "hull" -> capsule, or None where the file has none
static PyObject *pack_blob(PyObject *self, PyObject *args)
{
    (void)self;
    PyObject *capsule;
    const char *kind;
    if (!PyArg_ParseTuple(args, "Os", &capsule, &kind)) {
        return NULL;
    }
    const open_pack *held = PyCapsule_GetPointer(capsule, BINDING_PACK);
    if (held == NULL) {
        return NULL;
    }
    bool soup = strcmp(kind, "soup") == 0;
    tl_pack_chunk chunk;
    if (tl_pack_find(&held->pack, soup ? TL_PACK_SOUP : TL_PACK_HULL, 0, &chunk) != TL_OK) {
        Py_RETURN_NONE;
    }
    tl_report report;
    tl_result result =
        soup ? tl_soup_check(chunk.bytes, chunk.size, &report) : tl_hull_check(chunk.bytes, chunk.size, &report);
    if (result != TL_OK) {
        return binding_raise(result, &report);
    }
    return binding_blob_capsule((void *)(uintptr_t)chunk.bytes, capsule, soup ? BINDING_SOUP : BINDING_HULL);
}

// The chunk of a type after its check; NULL where there is none, or with an error.
static const void *checked_chunk(const open_pack *held, uint32_t type,
                                 tl_result (*check)(const void *, uint64_t, tl_report *), tl_result *result,
                                 tl_report *report)
{
    tl_pack_chunk chunk;
    if (*result != TL_OK || tl_pack_find(&held->pack, type, 0, &chunk) != TL_OK) {
        return NULL;
    }
    *result = check(chunk.bytes, chunk.size, report);
    return *result == TL_OK ? chunk.bytes : NULL;
}

// pack_navmesh(pack) -> (capsule, settings dict), or None where the file has none
static PyObject *pack_navmesh(PyObject *self, PyObject *capsule)
{
    (void)self;
    const open_pack *held = PyCapsule_GetPointer(capsule, BINDING_PACK);
    if (held == NULL) {
        return NULL;
    }
    tl_report report;
    tl_result result = TL_OK;
    binding_navmesh made;
    memset(&made, 0, sizeof(made));
    const tl_pack_navmesh *blob = checked_chunk(held, TL_PACK_NAVM, tl_pack_navmesh_check, &result, &report);
    if (blob == NULL && result == TL_OK) {
        Py_RETURN_NONE;
    }
    made.pruning = checked_chunk(held, TL_PACK_PRUN, tl_pack_pruning_check, &result, &report);
    made.links = checked_chunk(held, TL_PACK_LINK, tl_nav_links_check, &result, &report);
    if (result == TL_OK) {
        made.def = tl_pack_navmesh_def(blob);
        made.tiles_x = blob->tiles_x;
        made.tiles_z = blob->tiles_z;
        result = tl_pack_load_navmesh(&held->pack, NULL, &made.navmesh, &report);
    }
    if (result == TL_OK) {
        result = tl_pack_load_pruned(&held->pack, NULL, &made.removed, &report);
        result = result == TL_NOT_FOUND ? TL_OK : result;
    }
    if (result != TL_OK) {
        binding_navmesh_free_parts(&made);
        return binding_raise(result, &report);
    }
    made.owner = Py_NewRef(capsule);
    const tl_nav_def def = made.def;
    PyObject *navmesh = binding_navmesh_capsule(&made);
    PyObject *settings = navmesh != NULL ? binding_nav_def_dict(&def) : NULL;
    if (settings == NULL) {
        Py_XDECREF(navmesh);
        return NULL;
    }
    return Py_BuildValue("NN", navmesh, settings);
}

// pack_volumes(pack) -> list of (kind, area, six numbers, points as bytes), as bakes take them
static PyObject *pack_volumes(PyObject *self, PyObject *capsule)
{
    (void)self;
    const open_pack *held = PyCapsule_GetPointer(capsule, BINDING_PACK);
    PyObject *list = held != NULL ? PyList_New(0) : NULL;
    tl_pack_chunk chunk;
    if (list == NULL || tl_pack_find(&held->pack, TL_PACK_MARK, 0, &chunk) != TL_OK) {
        return list;
    }
    tl_report report;
    tl_result result = tl_pack_volumes_check(chunk.bytes, chunk.size, &report);
    if (result != TL_OK) {
        Py_DECREF(list);
        return binding_raise(result, &report);
    }
    const tl_pack_volumes *volumes = chunk.bytes;
    for (uint32_t i = 0; list != NULL && i < volumes->count; i++) {
        tl_nav_volume v = tl_pack_volumes_at(volumes, i);
        bool cylinder = v.kind == TL_NAV_VOLUME_CYLINDER;
        tl_vec3 a = cylinder ? v.base : v.box.min;
        tl_vec3 b = cylinder ? tl_vec3_make(v.radius, v.height, 0) : v.box.max;
        PyObject *item = Py_BuildValue("ii(ffffff)y#", (int)v.kind, (int)v.area, a.x, a.y, a.z, b.x, b.y, b.z,
                                       v.points != NULL ? (const char *)v.points : "",
                                       (Py_ssize_t)(v.point_count * sizeof(tl_vec3)));
        if (item == NULL || PyList_Append(list, item) != 0) {
            Py_CLEAR(list);
        }
        Py_XDECREF(item);
    }
    return list;
}

// pack_meta(pack) -> (name, vertices, triangles, bounds, up axis), or None
static PyObject *pack_meta(PyObject *self, PyObject *capsule)
{
    (void)self;
    const open_pack *held = PyCapsule_GetPointer(capsule, BINDING_PACK);
    tl_pack_chunk chunk;
    if (held == NULL) {
        return NULL;
    }
    if (tl_pack_find(&held->pack, TL_PACK_META, 0, &chunk) != TL_OK) {
        Py_RETURN_NONE;
    }
    tl_report report;
    tl_result result = tl_pack_meta_check(chunk.bytes, chunk.size, &report);
    if (result != TL_OK) {
        return binding_raise(result, &report);
    }
    const tl_pack_meta *meta = chunk.bytes;
    const tl_aabb box = meta->bounds;
    PyObject *name = PyUnicode_DecodeUTF8(tl_pack_meta_name(meta), (Py_ssize_t)meta->name_size, "replace");
    return name == NULL ? NULL
                        : Py_BuildValue("NKK((fff)(fff))s", name, (unsigned long long)meta->source_vertices,
                                        (unsigned long long)meta->source_triangles, box.min.x, box.min.y, box.min.z,
                                        box.max.x, box.max.y, box.max.z, meta->source_up == TL_PACK_UP_Z ? "z" : "y");
}

// pack_kept(pack) -> list of (type, id, bytes): the chunks that Python has no objects for
static PyObject *pack_kept(PyObject *self, PyObject *capsule)
{
    (void)self;
    static const uint32_t KNOWN[] = { TL_PACK_META, TL_PACK_SOUP, TL_PACK_HULL, TL_PACK_NAVM, TL_PACK_NAVT,
                                      TL_PACK_LINK, TL_PACK_MARK, TL_PACK_PRUN, TL_PACK_PRUT };
    const open_pack *held = PyCapsule_GetPointer(capsule, BINDING_PACK);
    PyObject *list = held != NULL ? PyList_New(0) : NULL;
    for (uint32_t i = 0; list != NULL && i < held->pack.chunk_count; i++) {
        const tl_pack_chunk chunk = tl_pack_chunk_at(&held->pack, i);
        bool known = false;
        for (size_t k = 0; k < sizeof(KNOWN) / sizeof(KNOWN[0]); k++) {
            known = known || chunk.type == KNOWN[k];
        }
        PyObject *entry = known ? NULL
                                : Py_BuildValue("kky#", (unsigned long)chunk.type, (unsigned long)chunk.id, chunk.bytes,
                                                (Py_ssize_t)chunk.size);
        if (!known && (entry == NULL || PyList_Append(list, entry) != 0)) {
            Py_CLEAR(list);
        }
        Py_XDECREF(entry);
    }
    return list;
}

PyMethodDef binding_pack_methods[] = {
    { "pack_write", pack_write, METH_VARARGS, NULL }, { "pack_open", pack_open, METH_VARARGS, NULL },
    { "pack_blob", pack_blob, METH_VARARGS, NULL },   { "pack_navmesh", pack_navmesh, METH_O, NULL },
    { "pack_volumes", pack_volumes, METH_O, NULL },   { "pack_meta", pack_meta, METH_O, NULL },
    { "pack_kept", pack_kept, METH_O, NULL },         { NULL, NULL, 0, NULL },
};
