// SPDX-License-Identifier: MIT
//
// Instead of assimp_reader.c, where talus is built without Assimp: its formats are known, and refused by name.

#include "io/mesh/assimp_reader.h"

#include <string.h>

bool tl_assimp_knows(const char *extension)
{
    static const char *const KNOWN[] = { ".fbx", ".stl", ".ply",  ".dae", ".3ds", ".blend", ".off", ".x",
                                         ".lwo", ".ase", ".gltf", ".glb", ".3mf", ".ac",    ".dxf", ".ifc" };
    for (size_t i = 0; i < sizeof KNOWN / sizeof KNOWN[0]; i++) {
        const char *a = extension, *b = KNOWN[i];
        while (*a != '\0' && (*a >= 'A' && *a <= 'Z' ? *a - 'A' + 'a' : *a) == *b) {
            a++;
            b++;
        }
        if (*a == '\0' && *b == '\0') {
            return true;
        }
    }
    return false;
}

tl_result tl_assimp_read(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                         tl_io_error *error_out)
{
    (void)allocator;
    memset(mesh_out, 0, sizeof *mesh_out);
    return tl_io_fail(error_out, TL_ERR_UNSUPPORTED, source->name, 0,
                      "export the level as OBJ, or build talus with Assimp",
                      "this build has no Assimp, which reads such files");
}
