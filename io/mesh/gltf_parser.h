// SPDX-License-Identifier: MIT
//
// The part of glTF 2.0 that says where triangles are: buffers, views, accessors, meshes, nodes, scenes, names of
// materials, and the extensions that change them. Jansson reads the JSON; everything else here is checked once, so that
// what follows may use each index without a look: every index names something, every node has one parent at most, and
// no node is below itself.

#ifndef TALUS_IO_GLTF_PARSER_H
#define TALUS_IO_GLTF_PARSER_H

#include "io/mesh/mesh_source.h"

/// An index that names nothing.
#define TL_GLTF_NONE UINT32_MAX

/// As the file numbers them.
typedef enum tl_gltf_component {
    TL_GLTF_I8 = 5120,
    TL_GLTF_U8 = 5121,
    TL_GLTF_I16 = 5122,
    TL_GLTF_U16 = 5123,
    TL_GLTF_U32 = 5125,
    TL_GLTF_F32 = 5126,
} tl_gltf_component;

/// As the file numbers them.
typedef enum tl_gltf_mode {
    TL_GLTF_POINTS,
    TL_GLTF_LINES,
    TL_GLTF_LINE_LOOP,
    TL_GLTF_LINE_STRIP,
    TL_GLTF_TRIANGLES,
    TL_GLTF_TRIANGLE_STRIP,
    TL_GLTF_TRIANGLE_FAN,
    TL_GLTF_MODES,
} tl_gltf_mode;

typedef enum tl_gltf_packing { TL_GLTF_ATTRIBUTES, TL_GLTF_TRIANGLE_LIST, TL_GLTF_INDEX_LIST } tl_gltf_packing;

typedef enum tl_gltf_filter {
    TL_GLTF_NO_FILTER,
    TL_GLTF_OCTAHEDRAL,
    TL_GLTF_QUATERNION,
    TL_GLTF_EXPONENTIAL
} tl_gltf_filter;

typedef struct tl_gltf_buffer {
    const char *uri; ///< NULL: the binary chunk, or nothing but room for what views unpack
    size_t size;     ///< bytes, as the file says
} tl_gltf_buffer;

/// A buffer view. With EXT_meshopt_compression its bytes are those that `packed_size` others unpack to.
typedef struct tl_gltf_view {
    uint32_t buffer;
    size_t offset, size; ///< bytes
    size_t stride;       ///< bytes from element to element; 0: they are dense
    bool is_packed;
    uint32_t packed_buffer;
    size_t packed_offset, packed_size;  ///< bytes
    size_t packed_count, packed_stride; ///< elements, and the bytes of each
    tl_gltf_packing packing;
    tl_gltf_filter filter;
} tl_gltf_view;

/// Values in a view from a byte offset on. `view` TL_GLTF_NONE: all are zero.
typedef struct tl_gltf_accessor {
    uint32_t view;
    size_t offset;
    size_t count;
    uint32_t component; ///< a tl_gltf_component; anything else that the file says has component_size 0
    uint32_t component_size;
    uint32_t width; ///< components an element: 1, 2, 3, 4, 9, 16; 0: a type that is not known
    bool is_normalized;
    size_t sparse_count; ///< elements that stand elsewhere; 0: none
    uint32_t sparse_index_view, sparse_value_view;
    size_t sparse_index_offset, sparse_value_offset;
    uint32_t sparse_index_component;
} tl_gltf_accessor;

typedef struct tl_gltf_primitive {
    tl_gltf_mode mode;
    uint32_t positions, indices; ///< accessors or TL_GLTF_NONE
    uint32_t material;           ///< or TL_GLTF_NONE
    bool is_draco;
} tl_gltf_primitive;

typedef struct tl_gltf_mesh {
    uint32_t first_primitive, primitive_count;
} tl_gltf_mesh;

/// What EXT_mesh_gpu_instancing places instances by.
typedef enum tl_gltf_placement { TL_GLTF_TRANSLATION, TL_GLTF_ROTATION, TL_GLTF_SCALE } tl_gltf_placement;

typedef struct tl_gltf_node {
    bool has_matrix;
    double matrix[16]; ///< column by column, when has_matrix; else
    double translation[3], rotation[4], scale[3];
    uint32_t mesh;                    ///< or TL_GLTF_NONE
    uint32_t parent;                  ///< or TL_GLTF_NONE
    uint32_t first_link, child_count; ///< children are links[first_link...]
    bool has_instances;
    uint32_t instances[3]; ///< accessors by tl_gltf_placement, or TL_GLTF_NONE
    uint32_t instanced_by; ///< the accessor that says how many there are: any attribute's; TL_GLTF_NONE: none is there
} tl_gltf_node;

/// A parsed file. Strings are UTF-8 without NUL inside, and live as long.
typedef struct tl_gltf_data {
    tl_gltf_buffer *buffers;
    tl_gltf_view *views;
    tl_gltf_accessor *accessors;
    const char **materials; ///< names, NULL without
    tl_gltf_primitive *primitives;
    tl_gltf_mesh *meshes;
    tl_gltf_node *nodes;
    uint32_t *links;         ///< children of nodes
    uint32_t *roots;         ///< nodes of the scene to show; without scenes: all that have no parent
    const char **extensions; ///< those that the file requires
    uint32_t buffer_count, view_count, accessor_count, material_count, primitive_count, mesh_count, node_count,
        link_count, root_count, root_room, extension_count;
    const unsigned char *binary; ///< of a GLB, or NULL
    size_t binary_size;
    void *json; ///< holds the strings
    tl_allocator allocator;
} tl_gltf_data;

/// Parses glTF or GLB; `data_out` keeps a pointer into the bytes of a GLB. Errors name the element, as in
/// "nodes[3].mesh is 7, but there are 2 meshes": TL_ERR_FORMAT, TL_ERR_INDEX, TL_ERR_LIMIT, TL_ERR_UNSUPPORTED (glTF 1,
/// 3 and on; UTF-16), TL_ERR_MEMORY; `*data_out` is zeroed then.
tl_result tl_gltf_parse(const tl_mesh_source *source, const tl_allocator *allocator, tl_gltf_data *data_out,
                        tl_io_error *error_out);

/// Frees all that it holds and zeroes it. Zeroed is allowed.
void tl_gltf_data_free(tl_gltf_data *data);

#endif
