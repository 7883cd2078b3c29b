// SPDX-License-Identifier: MIT
//
// What the sources of the extension module share. The module is private to the package: the Python classes above it
// check shapes and types of arrays, and hand over contiguous buffers. Here only their sizes are checked, so that no
// call can read or write beyond a buffer.

#ifndef TALUS_PYTHON_BINDING_H
#define TALUS_PYTHON_BINDING_H

#ifndef Py_LIMITED_API
#define Py_LIMITED_API 0x030B0000
#endif
#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include <talus/talus.h>

// --- errors ---------------------------------------------------------------------------------------------------------

/// Raises the package's exception for a result; MemoryError for TL_ERR_MEMORY. An exception that is set already, such
/// as a KeyboardInterrupt that cancelled a bake, stays. `report` may be NULL. Returns NULL.
PyObject *binding_raise(tl_result result, const tl_report *report);

/// set_error_class(class): what binding_raise raises.
PyObject *binding_set_error_class(PyObject *module, PyObject *error_class);

// --- buffers --------------------------------------------------------------------------------------------------------

/// Items of `size` bytes in a buffer; -1 with a ValueError where they are no whole number.
Py_ssize_t binding_count(const Py_buffer *buffer, size_t size, const char *name);
/// Whether a buffer has that many items of `size` bytes; else a ValueError is set. An absent buffer (None) passes where
/// `optional`.
bool binding_has(const Py_buffer *buffer, size_t size, Py_ssize_t count, bool optional, const char *name);

/// A view of a mesh's buffers; those of `materials` may be absent. False: a ValueError is set.
bool binding_mesh_view(const Py_buffer *vertices, const Py_buffer *indices, const Py_buffer *materials,
                       tl_mesh_view *view);

/// Releases what PyArg_ParseTuple filled; buffers that it did not reach are zero.
void binding_release(Py_buffer *buffers, size_t count);

/// The arguments of a function that answers item by item: (object, array of items, array of answers).
typedef struct binding_items {
    PyObject *capsule;
    Py_buffer in, out;
    Py_ssize_t count;
} binding_items;

/// Fills `items` by arrays whose items have these sizes; false: an exception is set. binding_end_items in either case.
bool binding_take_items(PyObject *args, size_t in_size, size_t out_size, binding_items *items);
/// Gives the arrays back; None, or NULL where the function failed.
PyObject *binding_end_items(binding_items *items, bool answered);

// --- the host of a bake or batch ------------------------------------------------------------------------------------

/// Runs a bake or a batch without the GIL, on `threads` threads, and asks Python now and then for signals and progress.
typedef struct binding_host {
    tl_host host;
    tl_tasks tasks;
    tl_progress progress;
    PyObject *callback; ///< borrowed; NULL: only signals are looked at
    PyThreadState *state;
} binding_host;

/// Fills tasks that run loops on so many threads; it stays where it is while it is used.
void binding_tasks(tl_tasks *tasks, unsigned threads);

/// Gives up the GIL. `callback`: None, or called with (stage, done, total); returning False cancels.
void binding_begin(binding_host *host, PyObject *callback, unsigned threads);
/// Takes the GIL back.
void binding_end(binding_host *host);

#if defined(__SSE2__) || defined(_M_X64)
#define BINDING_SSE2 1
#endif

// --- hits -----------------------------------------------------------------------------------------------------------

/// The parts of many hits, an array each.
typedef struct binding_hit_arrays {
    float *t;
    int32_t *triangles;  ///< -1: none
    float *barycentrics; ///< two each
    tl_vec3 *normals;
    uint16_t *materials;
    uint8_t *backs;
} binding_hit_arrays;

/// Writes `count` hits of a batch to their parts, from `first` on.
void binding_scatter_hits(const tl_ray_hit *hits, uint32_t count, const binding_hit_arrays *out, uint32_t first);

// --- objects --------------------------------------------------------------------------------------------------------

/// What a capsule of a blob holds: a blob of its own, or one inside the bytes of an open pack, which `owner` keeps.
typedef struct binding_blob {
    void *blob;
    PyObject *owner; ///< NULL: the blob is freed with the capsule
} binding_blob;

#define BINDING_SOUP    "talus.soup"
#define BINDING_HULL    "talus.hull"
#define BINDING_SHAPE   "talus.shape"
#define BINDING_NAVMESH "talus.navmesh"
#define BINDING_PACK    "talus.pack"

/// A capsule around a blob, which is freed on failure. `owner` NULL, or what the blob lies in.
PyObject *binding_blob_capsule(void *blob, PyObject *owner, const char *name);
/// The blob of a capsule; NULL with a TypeError.
void *binding_blob_of(PyObject *capsule, const char *name);

/// A shape and the hull or points that it borrows from.
typedef struct binding_shape {
    tl_convex convex;
    tl_vec3 *points;
    PyObject *owner;
} binding_shape;

/// A shape's capsule; NULL with a TypeError.
const tl_convex *binding_shape_of(PyObject *capsule);

/// A navmesh with what it was baked with.
typedef struct binding_navmesh {
    tl_navmesh *navmesh;
    tl_nav_query *query; ///< NULL until it is needed; single queries use it, under the Python object's lock
    tl_nav_def def;
    uint32_t tiles_x, tiles_z;
    tl_nav_obstacles *obstacles;
    PyObject *obstacle_shapes;      ///< of ids to the capsules of the shapes that they borrow; NULL: no obstacles
    tl_navmesh *removed;            ///< what was pruned, as a navmesh; NULL: nothing
    const tl_pack_pruning *pruning; ///< the rules; NULL: nothing was asked for
    const tl_nav_links *links;      ///< found and added; NULL: none
    tl_pack_pruning *own_pruning;   ///< freed with it; NULL where it lies in the pack
    tl_nav_links *own_links;        ///< the same
    PyObject *owner;                ///< the pack whose bytes the tiles lie in, or the versions
    tl_nav_versions *versions;      ///< of which it is a version, or the draft; it owns its query alone then
    bool is_fixed;                  ///< a version, or what was given to versions: not to be changed
} binding_navmesh;

void binding_navmesh_free_parts(binding_navmesh *navmesh);

/// A capsule around a navmesh, whose parts are freed with it, and on failure.
PyObject *binding_navmesh_capsule(binding_navmesh *navmesh);
/// NULL with a TypeError; with a ValueError where a version was given back.
binding_navmesh *binding_navmesh_of(PyObject *capsule);
/// The same for what changes it: NULL with a ValueError where it is fixed.
binding_navmesh *binding_navmesh_to_change(PyObject *capsule);
/// A query that no search is too large for.
tl_result binding_query_create(tl_nav_query **query_out);
/// The navmesh's own. NULL: MemoryError.
tl_nav_query *binding_query_of(binding_navmesh *navmesh);

/// A level that a navmesh is baked from, or checked against.
typedef struct binding_level {
    Py_buffer buffers[3]; ///< vertices, faces, areas
    tl_mesh mesh;
    uint8_t *areas;
    tl_nav_volume *volumes;
    tl_nav_input input; ///< of the cleaned mesh
} binding_level;

/// Takes (vertices, faces, areas or None, list of volumes). False: an exception is set. Free it in either case.
bool binding_level_take(PyObject *tuple, binding_level *level);
void binding_level_free(binding_level *level);

/// Fills a def from a dict of its fields; false with a TypeError or ValueError. `def` holds the defaults before.
bool binding_nav_def(PyObject *settings, tl_nav_def *def);
/// The def as a dict of its fields.
PyObject *binding_nav_def_dict(const tl_nav_def *def);

/// A navmesh's off-mesh links as they are saved. All zero at first; free it in either case.
typedef struct binding_saved_links {
    const tl_nav_links *found; ///< NULL: none
    tl_pack_offmesh *by_hand;  ///< NULL: none
    tl_nav_links *own_found;   ///< `found` where some of them were removed
} binding_saved_links;

tl_result binding_links_to_save(const binding_navmesh *held, binding_saved_links *saved, tl_report *report);
void binding_saved_links_free(binding_saved_links *saved);

/// NULL with a TypeError.
tl_nav_crowd *binding_crowd_of(PyObject *capsule);

/// A filter from (include flags, exclude flags, 256 float costs or None); None: the default filter. False: an
/// exception is set.
bool binding_filter(PyObject *object, tl_nav_filter *filter);

// --- the functions of the module, by source -------------------------------------------------------------------------

extern PyMethodDef binding_soup_methods[];
extern PyMethodDef binding_ray_methods[];
extern PyMethodDef binding_hull_methods[];
extern PyMethodDef binding_decompose_methods[];
extern PyMethodDef binding_convex_methods[];
extern PyMethodDef binding_bake_methods[];
extern PyMethodDef binding_navmesh_methods[];
extern PyMethodDef binding_edit_methods[];
extern PyMethodDef binding_path_methods[];
extern PyMethodDef binding_audit_methods[];
extern PyMethodDef binding_pack_methods[];
extern PyMethodDef binding_crowd_methods[];
extern PyMethodDef binding_group_methods[];
extern PyMethodDef binding_character_methods[];
extern PyMethodDef binding_versions_methods[];

#endif
