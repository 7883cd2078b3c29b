// SPDX-License-Identifier: MIT
//
// glTF 2.0, text (.gltf) and binary (.glb), its JSON parsed by Jansson.
//
// Read: the nodes of the file's scene (of its first one, or all nodes without a parent, when it names none), meshes of
// triangles, strips and fans; positions of any component type (KHR_mesh_quantization), packed by
// EXT_meshopt_compression where talus was built with meshoptimizer, sparse ones; EXT_mesh_gpu_instancing. Points and
// lines are counted and ignored. Skins and morph targets are left in the pose in which the vertices are stored.
//
// An extension that the file requires and that is not read here is refused by its name, unless it is known to change
// materials, lights and pictures only. Buffers may lie in the file, in data URIs, and in files of its own folder.

#ifndef TALUS_IO_GLTF_READER_H
#define TALUS_IO_GLTF_READER_H

#include "io/mesh/mesh_source.h"

/// A tl_mesh_reader. Further errors: TL_ERR_UNSUPPORTED for glTF 1.0, extensions and files elsewhere.
tl_result tl_gltf_read(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                       tl_io_error *error_out);

#endif
