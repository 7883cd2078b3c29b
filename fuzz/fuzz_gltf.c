// SPDX-License-Identifier: MIT
//
// Any bytes as glTF or GLB: a whole and valid mesh, or a named error; and the same bytes give the same mesh.

#include "io/mesh/gltf_reader.h"

#include <assert.h>
#include <string.h>

static void check_mesh(const tl_imported_mesh *mesh)
{
    assert(mesh->triangle_count > 0 && mesh->face_count == mesh->triangle_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        assert(tl_is_finite(mesh->vertices[i]));
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            assert(mesh->indices[(size_t)i * 3 + k] < mesh->vertex_count);
        }
        assert(mesh->materials[i] < mesh->names.count);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tl_imported_mesh mesh, second;
    tl_io_error error;
    const tl_mesh_source source = {
        "fuzz.glb", NULL, data, size, "glb", false, { 0.0 }
    }; // no folder, so no files beside it
    tl_result result = tl_gltf_read(&source, NULL, &mesh, &error);
    if (result != TL_OK) {
        char words[1024];
        assert(error.result == result && error.message[0] != '\0' && mesh.vertices == NULL);
        assert(tl_io_error_format(&error, words, sizeof words) < sizeof words);
        return 0;
    }
    check_mesh(&mesh);
    result = tl_gltf_read(&source, NULL, &second, NULL);
    assert(result == TL_OK && second.vertex_count == mesh.vertex_count && second.triangle_count == mesh.triangle_count);
    assert(memcmp(mesh.vertices, second.vertices, mesh.vertex_count * sizeof *mesh.vertices) == 0);
    assert(memcmp(mesh.indices, second.indices, (size_t)mesh.triangle_count * 3 * sizeof *mesh.indices) == 0);
    tl_imported_mesh_free(&second);
    tl_imported_mesh_free(&mesh);
    return 0;
}
