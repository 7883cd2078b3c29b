// SPDX-License-Identifier: MIT
//
// Storage of imported meshes.

#include "io/mesh/imported_mesh.h"

#include "io/files/growable.h"

#include <string.h>

const char *tl_isolation_name(tl_isolation isolation)
{
    static const char *const names[] = { "none", "process", "sandbox" };
    return (unsigned)isolation < 3 ? names[isolation] : "unknown";
}

tl_mesh_view tl_imported_mesh_as_view(const tl_imported_mesh *mesh)
{
    tl_mesh_view view = { mesh->vertices, mesh->vertex_count, mesh->indices, mesh->triangle_count, mesh->materials };
    return view;
}

void tl_imported_mesh_init(tl_imported_mesh *mesh, const tl_allocator *allocator)
{
    memset(mesh, 0, sizeof *mesh);
    mesh->allocator = tl_io_allocator_or_default(allocator);
}

void tl_imported_mesh_free(tl_imported_mesh *mesh)
{
    if (mesh->allocator.release == NULL) {
        return;
    }
    size_t triangles = mesh->triangle_capacity;
    const tl_allocator *allocator = &mesh->allocator;
    tl_io_release(allocator, mesh->vertices, mesh->vertex_capacity * sizeof *mesh->vertices);
    tl_io_release(allocator, mesh->indices, triangles * 3 * sizeof *mesh->indices);
    tl_io_release(allocator, mesh->materials, triangles * sizeof *mesh->materials);
    tl_io_release(allocator, mesh->source_lines, triangles * sizeof *mesh->source_lines);
    tl_name_table_free(&mesh->names, allocator);
    memset(mesh, 0, sizeof *mesh);
}

tl_result tl_imported_mesh_reserve_vertices(tl_imported_mesh *mesh, uint64_t count)
{
    uint64_t needed = mesh->vertex_count + count;
    if (needed > TL_MAX_MESH_VERTICES) {
        return TL_ERR_LIMIT;
    }
    uint64_t capacity = mesh->vertex_capacity;
    bool enough = tl_io_grow(&mesh->allocator, (void **)&mesh->vertices, &capacity, mesh->vertex_count, needed,
                             sizeof *mesh->vertices);
    mesh->vertex_capacity = (uint32_t)capacity;
    return enough ? TL_OK : TL_ERR_MEMORY;
}

// The three arrays of triangles have one capacity. They grow one after another, so a failure between them must leave
// that number right for each: new blocks are all taken before an old one is given back.
tl_result tl_imported_mesh_reserve_triangles(tl_imported_mesh *mesh, uint64_t count)
{
    uint64_t needed = mesh->triangle_count + count;
    if (needed > TL_MAX_MESH_TRIANGLES) {
        return TL_ERR_LIMIT;
    }
    uint64_t old = mesh->triangle_capacity;
    if (needed <= old) {
        return TL_OK;
    }
    uint64_t wanted = old * 2 > needed ? old * 2 : needed;
    wanted = wanted < 64 ? 64 : wanted;
    const tl_allocator *allocator = &mesh->allocator;
    uint32_t *indices = tl_io_allocate(allocator, wanted * 3 * sizeof *indices);
    uint16_t *materials = tl_io_allocate(allocator, wanted * sizeof *materials);
    uint32_t *lines = tl_io_allocate(allocator, wanted * sizeof *lines);
    if (indices == NULL || materials == NULL || lines == NULL) {
        tl_io_release(allocator, indices, wanted * 3 * sizeof *indices);
        tl_io_release(allocator, materials, wanted * sizeof *materials);
        tl_io_release(allocator, lines, wanted * sizeof *lines);
        return TL_ERR_MEMORY;
    }
    if (old > 0) {
        memcpy(indices, mesh->indices, (size_t)mesh->triangle_count * 3 * sizeof *indices);
        memcpy(materials, mesh->materials, (size_t)mesh->triangle_count * sizeof *materials);
        memcpy(lines, mesh->source_lines, (size_t)mesh->triangle_count * sizeof *lines);
        tl_io_release(allocator, mesh->indices, old * 3 * sizeof *indices);
        tl_io_release(allocator, mesh->materials, old * sizeof *materials);
        tl_io_release(allocator, mesh->source_lines, old * sizeof *lines);
    }
    mesh->indices = indices;
    mesh->materials = materials;
    mesh->source_lines = lines;
    mesh->triangle_capacity = (uint32_t)wanted;
    return TL_OK;
}
