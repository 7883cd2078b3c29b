// SPDX-License-Identifier: MIT
//
// Any bytes as OBJ: a whole and valid mesh, or a named error; and the same bytes give the same mesh.

#include "io/mesh/obj_reader.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

static void check_mesh(const tl_imported_mesh *mesh, size_t size)
{
    assert(mesh->triangle_count > 0 && mesh->face_count > 0 && mesh->face_count <= mesh->triangle_count);
    assert(mesh->polygon_count <= mesh->face_count);
    assert(mesh->clipped_count + mesh->crooked_count <= mesh->polygon_count);
    // `v 0 0 0` and its line end take eight bytes; a corner takes two.
    assert(mesh->vertex_count <= size / 8 + 1 && mesh->triangle_count <= size / 2);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        assert(tl_is_finite(mesh->vertices[i]));
    }
    uint32_t line = 1;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        for (uint32_t k = 0; k < 3; k++) {
            assert(mesh->indices[(size_t)i * 3 + k] < mesh->vertex_count);
        }
        assert(mesh->materials[i] < mesh->names.count);
        assert(mesh->source_lines[i] >= line && mesh->source_lines[i] <= size + 1);
        line = mesh->source_lines[i];
    }
}

static void check_equal(const tl_imported_mesh *a, const tl_imported_mesh *b)
{
    assert(a->vertex_count == b->vertex_count && a->triangle_count == b->triangle_count);
    assert(memcmp(a->vertices, b->vertices, a->vertex_count * sizeof *a->vertices) == 0);
    assert(memcmp(a->indices, b->indices, (size_t)a->triangle_count * 3 * sizeof *a->indices) == 0);
    assert(memcmp(a->materials, b->materials, a->triangle_count * sizeof *a->materials) == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    tl_imported_mesh mesh;
    tl_io_error error;
    tl_result result = tl_obj_read(data, size, "fuzz.obj", false, NULL, &mesh, &error);
    if (result != TL_OK) {
        char words[1024];
        assert(error.result == result && error.message[0] != '\0' && mesh.vertices == NULL);
        assert(tl_io_error_format(&error, words, sizeof words) < sizeof words);
        return 0;
    }
    check_mesh(&mesh, size);
    // The cut between the part that is read in place and the copied rest must not matter: with blanks behind, the whole
    // text lies in the first part.
    char *longer = malloc(size + 65);
    memcpy(longer, data, size);
    longer[size] = '\n';
    memset(longer + size + 1, ' ', 64);
    tl_imported_mesh second;
    result = tl_obj_read(longer, size + 65, NULL, false, NULL, &second, NULL);
    assert(result == TL_OK);
    check_equal(&mesh, &second);
    free(longer);
    tl_imported_mesh_free(&second);
    tl_imported_mesh_free(&mesh);
    return 0;
}
