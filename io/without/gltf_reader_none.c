// SPDX-License-Identifier: MIT
//
// Instead of gltf_reader.c, where talus is built without Jansson: glTF is refused by name.

#include "io/mesh/gltf_reader.h"

#include <string.h>

tl_result tl_gltf_read(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                       tl_io_error *error_out)
{
    (void)allocator;
    memset(mesh_out, 0, sizeof *mesh_out);
    return tl_io_fail(error_out, TL_ERR_UNSUPPORTED, source->name, 0,
                      "export the level as OBJ, or build talus with Jansson",
                      "this build has no Jansson, which reads the JSON of glTF");
}
