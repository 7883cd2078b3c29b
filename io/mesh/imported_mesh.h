// SPDX-License-Identifier: MIT
//
// What every reader of meshes fills: triangles as they stand in the file, material names, and what was ignored.

#ifndef TALUS_IO_IMPORTED_MESH_H
#define TALUS_IO_IMPORTED_MESH_H

#include "io/text/name_table.h"

#include <talus/mesh.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Largest number of material ids: they are stored in 16 bits.
#define TL_MAX_IMPORTED_MATERIALS 65536u

/// Who read a file.
typedef enum tl_isolation {
    TL_ISOLATION_NONE,    ///< a reader of our own, in this process
    TL_ISOLATION_PROCESS, ///< a child process with limits on its time and memory
    TL_ISOLATION_SANDBOX  ///< which moreover may ask the system for little (import_sandbox.h)
} tl_isolation;

/// "none", "process", "sandbox".
const char *tl_isolation_name(tl_isolation isolation);

/// A mesh read from a file. Nothing is welded or cleaned: that is tl_mesh_bake's part. Every coordinate is finite,
/// every index below vertex_count. Free it with tl_imported_mesh_free. To be read only.
typedef struct tl_imported_mesh {
    tl_vec3 *vertices;
    uint32_t vertex_count;
    uint32_t *indices; ///< 3 a triangle
    uint32_t triangle_count;
    uint16_t *materials;     ///< one a triangle
    uint32_t *source_lines;  ///< one a triangle, from 1: the line its face begins on; 0 for formats without lines
    tl_name_table names;     ///< material names by id; id 0 is "" and stands for triangles without material
    const char *format;      ///< static: "OBJ", "glTF", or "Assimp"
    uint64_t source_bytes;   ///< size of the file
    double origin[3];        ///< subtracted from the file's coordinates, in its units and axes
    uint32_t face_count;     ///< in the file, triangles and polygons
    uint32_t polygon_count;  ///< faces of more than three corners
    uint32_t clipped_count;  ///< polygons split along ears: concave, or with corners in line (split_polygon.h)
    uint32_t crooked_count;  ///< polygons for which no proper split was found: left as a fan from their first corner
    uint64_t ignored_points; ///< point and
    uint64_t ignored_lines;  ///< line elements: they bound nothing
    uint64_t skipped_lines;  ///< lines of an unknown keyword
    float file_unit;         ///< metres a unit, as the file says and as was applied; 0: it does not say (OBJ, STL, PLY)
    int32_t file_up;         ///< 1, 2, 3: x, y or z is up, as the file says, negative: down; turned to y. 0: not said
    tl_isolation isolation;  ///< who read the file
    uint32_t mirrored_nodes; ///< nodes whose transform turns inside out: their triangles were re-wound
    tl_allocator allocator;  ///< all of the above lives in its memory
    uint32_t vertex_capacity; ///< what the arrays could hold; the readers' own
    uint32_t triangle_capacity;
} tl_imported_mesh;

/// The triangles as tl_mesh_bake takes them. Valid while the mesh lives.
tl_mesh_view tl_imported_mesh_as_view(const tl_imported_mesh *mesh);

/// Frees all that the mesh holds and zeroes it. A zeroed mesh is allowed.
void tl_imported_mesh_free(tl_imported_mesh *mesh);

/// For readers: an empty mesh over `allocator` (NULL: malloc).
void tl_imported_mesh_init(tl_imported_mesh *mesh, const tl_allocator *allocator);

/// For readers: reserves capacity for `count` more vertices or triangles. TL_ERR_LIMIT beyond TL_MAX_MESH_VERTICES or
/// TL_MAX_MESH_TRIANGLES, TL_ERR_MEMORY. Capacities double, so memory is at most twice what is used.
tl_result tl_imported_mesh_reserve_vertices(tl_imported_mesh *mesh, uint64_t count);
tl_result tl_imported_mesh_reserve_triangles(tl_imported_mesh *mesh, uint64_t count);

#ifdef __cplusplus
}
#endif

#endif
