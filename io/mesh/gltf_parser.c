// SPDX-License-Identifier: MIT
//
// The container, the JSON, its lists one after the other, then the tree of nodes: that it is one is checked in linear
// time, whatever the file says.

#include "io/mesh/gltf_parser.h"

#include "io/files/growable.h"
#include "io/text/json_place.h"

#include <stdio.h>
#include <string.h>

enum {
    GLB_HEADER_BYTES = 12,
    GLB_CHUNK_BYTES = 8, // of a chunk's own header
    GLB_JSON = 0x4e4f534a,
    GLB_BINARY = 0x004e4942
};

typedef struct gltf_parser {
    tl_json_reader json;
    tl_gltf_data *data;
    tl_json_place root;
} gltf_parser;

static tl_result fail_container(gltf_parser *parser, tl_result result, const char *advice, const char *what)
{
    parser->json.result = result;
    return tl_io_fail(parser->json.error, result, parser->json.name, 0, advice, "%s", what);
}

// --- the container --------------------------------------------------------------------------------------------------

static uint32_t read_glb_u32(const unsigned char *at)
{
    return (uint32_t)at[0] | (uint32_t)at[1] << 8 | (uint32_t)at[2] << 16 | (uint32_t)at[3] << 24;
}

// A GLB's chunks: JSON first, then perhaps bytes; chunks of other kinds are skipped, as the format asks.
static tl_result open_glb(gltf_parser *parser, const unsigned char *bytes, size_t size, const unsigned char **text_out,
                          size_t *length_out)
{
    static const char cut[] = "the file is cut short";
    if (size < GLB_HEADER_BYTES + GLB_CHUNK_BYTES) {
        return fail_container(parser, TL_ERR_FORMAT, "export it again", cut);
    }
    uint32_t version = read_glb_u32(bytes + 4);
    if (version != 2) {
        return fail_container(parser, TL_ERR_UNSUPPORTED, "export it as glTF 2.0",
                              version == 1 ? "glTF 1.0 is not read" : "a GLB of a version that is not 2");
    }
    size_t total = read_glb_u32(bytes + 8);
    if (total > size || total < GLB_HEADER_BYTES + GLB_CHUNK_BYTES) {
        return fail_container(parser, TL_ERR_FORMAT, "export it again", cut);
    }
    size_t at = GLB_HEADER_BYTES;
    for (size_t chunk = 0; total - at >= GLB_CHUNK_BYTES; chunk++) {
        size_t length = read_glb_u32(bytes + at);
        uint32_t type = read_glb_u32(bytes + at + 4);
        at += GLB_CHUNK_BYTES;
        if (length > total - at) {
            return fail_container(parser, TL_ERR_FORMAT, "export it again", cut);
        }
        if ((chunk == 0) != (type == GLB_JSON)) {
            return fail_container(parser, TL_ERR_FORMAT, "export it again",
                                  chunk == 0 ? "the first chunk of the GLB is no JSON" : "a GLB of two chunks of JSON");
        }
        if (chunk == 0) {
            *text_out = bytes + at;
            *length_out = length;
        } else if (type == GLB_BINARY && parser->data->binary == NULL) {
            parser->data->binary = bytes + at;
            parser->data->binary_size = length;
        }
        at += length;
    }
    while (*length_out > 0 && (*text_out)[*length_out - 1] == 0) {
        --*length_out; // filled up with zeros instead of blanks, as some exporters do
    }
    return TL_OK;
}

static tl_result open_container(gltf_parser *parser, const tl_mesh_source *source, const unsigned char **text_out,
                                size_t *length_out)
{
    const unsigned char *bytes = source->bytes;
    size_t size = source->size;
    if (size >= 4 && memcmp(bytes, "glTF", 4) == 0) {
        return open_glb(parser, bytes, size, text_out, length_out);
    }
    if (size >= 2 && (memcmp(bytes, "\xff\xfe", 2) == 0 || memcmp(bytes, "\xfe\xff", 2) == 0)) {
        return fail_container(parser, TL_ERR_UNSUPPORTED, "save it as UTF-8", "its text is UTF-16, not UTF-8");
    }
    size_t mark = size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    *text_out = bytes + mark;
    *length_out = size - mark;
    return TL_OK;
}

// The version that the file needs: "minVersion", or else the one that it was written for.
static void read_asset(gltf_parser *parser)
{
    tl_json_reader *json = &parser->json;
    tl_json_place asset;
    bool has_asset = tl_json_object(json, &parser->root, "asset", &asset);
    const char *written = has_asset ? tl_json_string(json, &asset, "version") : NULL;
    const char *needed = has_asset ? tl_json_string(json, &asset, "minVersion") : NULL;
    if (json->result == TL_OK && written == NULL) {
        tl_json_fail(json, TL_ERR_FORMAT, &parser->root, "asset.version", "is missing");
    }
    if (json->result != TL_OK) {
        return;
    }
    if (strncmp(written, "2.", 2) != 0 || (needed != NULL && strcmp(needed, "2.0") != 0)) {
        json->result = tl_io_fail(json->error, TL_ERR_UNSUPPORTED, json->name, 0, "export it as glTF 2.0",
                                  "glTF %s is not read", needed != NULL ? needed : written);
    }
}

// --- the lists ------------------------------------------------------------------------------------------------------

// A zeroed array of `count` items and one more, so that none of them is NULL.
static void *make_array(gltf_parser *parser, size_t count, size_t item_size)
{
    if (parser->json.result != TL_OK) {
        return NULL;
    }
    void *array = tl_io_allocate(&parser->data->allocator, (count + 1) * item_size);
    if (array == NULL) {
        fail_container(parser, TL_ERR_MEMORY, NULL, "out of memory");
        return NULL;
    }
    return memset(array, 0, (count + 1) * item_size);
}

static void read_buffers(gltf_parser *parser)
{
    tl_json_place list, at;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "buffers", &list);
    data->buffers = make_array(parser, count, sizeof *data->buffers);
    data->buffer_count = data->buffers != NULL ? (uint32_t)count : 0;
    for (uint32_t i = 0; i < data->buffer_count && tl_json_item(&parser->json, &list, i, &at); i++) {
        data->buffers[i].uri = tl_json_string(&parser->json, &at, "uri");
        data->buffers[i].size = tl_json_size(&parser->json, &at, "byteLength", 0);
    }
}

// The place of a word in a list that ends with NULL; what is not there is an error.
static int read_choice(gltf_parser *parser, const tl_json_place *at, const char *key, const char *const *words)
{
    const char *word = tl_json_string(&parser->json, at, key);
    for (int i = 0; word != NULL && words[i] != NULL; i++) {
        if (strcmp(word, words[i]) == 0) {
            return i;
        }
    }
    if (word != NULL) {
        tl_json_fail(&parser->json, TL_ERR_UNSUPPORTED, at, key, "is not known");
    }
    return 0;
}

static void read_packing(gltf_parser *parser, const tl_json_place *view_at, tl_gltf_view *view)
{
    static const char *const packings[] = { "ATTRIBUTES", "TRIANGLES", "INDICES", NULL };
    static const char *const filters[] = { "NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", NULL };
    tl_json_reader *json = &parser->json;
    tl_json_place extensions, at;
    view->is_packed = tl_json_object(json, view_at, "extensions", &extensions) &&
                      tl_json_object(json, &extensions, "EXT_meshopt_compression", &at);
    if (!view->is_packed) {
        return;
    }
    view->packed_buffer = tl_json_index(json, &at, "buffer", parser->data->buffer_count, "buffers");
    view->packed_offset = tl_json_size(json, &at, "byteOffset", 0);
    view->packed_size = tl_json_size(json, &at, "byteLength", 0);
    view->packed_stride = tl_json_size(json, &at, "byteStride", 0);
    view->packed_count = tl_json_size(json, &at, "count", 0);
    view->packing = (tl_gltf_packing)read_choice(parser, &at, "mode", packings);
    view->filter = (tl_gltf_filter)read_choice(parser, &at, "filter", filters);
}

static void read_views(gltf_parser *parser)
{
    tl_json_place list, at;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "bufferViews", &list);
    data->views = make_array(parser, count, sizeof *data->views);
    data->view_count = data->views != NULL ? (uint32_t)count : 0;
    for (uint32_t i = 0; i < data->view_count && tl_json_item(&parser->json, &list, i, &at); i++) {
        tl_gltf_view *view = &data->views[i];
        view->buffer = tl_json_index(&parser->json, &at, "buffer", data->buffer_count, "buffers");
        view->offset = tl_json_size(&parser->json, &at, "byteOffset", 0);
        view->size = tl_json_size(&parser->json, &at, "byteLength", 0);
        view->stride = tl_json_size(&parser->json, &at, "byteStride", 0);
        read_packing(parser, &at, view);
    }
}

static uint32_t component_size(uint32_t component)
{
    switch (component) {
    case TL_GLTF_I8:
    case TL_GLTF_U8:
        return 1;
    case TL_GLTF_I16:
    case TL_GLTF_U16:
        return 2;
    case TL_GLTF_U32:
    case TL_GLTF_F32:
        return 4;
    default:
        return 0;
    }
}

static uint32_t read_component_type(gltf_parser *parser, const tl_json_place *at)
{
    size_t type = tl_json_size(&parser->json, at, "componentType", 0);
    return type < UINT32_MAX ? (uint32_t)type : UINT32_MAX;
}

// How many components an element of this type has; 0: it is none of glTF's.
static uint32_t read_width(gltf_parser *parser, const tl_json_place *at)
{
    static const struct {
        const char *name;
        uint32_t width;
    } types[] = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 }, { "VEC4", 4 },
                  { "MAT2", 4 },   { "MAT3", 9 }, { "MAT4", 16 } };
    const char *name = tl_json_string(&parser->json, at, "type");
    for (size_t i = 0; name != NULL && i < sizeof types / sizeof types[0]; i++) {
        if (strcmp(name, types[i].name) == 0) {
            return types[i].width;
        }
    }
    return 0;
}

static void read_sparse_part(gltf_parser *parser, const tl_json_place *accessor_at, tl_gltf_accessor *accessor)
{
    tl_json_reader *json = &parser->json;
    tl_json_place sparse, at;
    if (!tl_json_object(json, accessor_at, "sparse", &sparse)) {
        return;
    }
    accessor->sparse_count = tl_json_size(json, &sparse, "count", 0);
    if (tl_json_object(json, &sparse, "indices", &at)) {
        accessor->sparse_index_view = tl_json_index(json, &at, "bufferView", parser->data->view_count, "views");
        accessor->sparse_index_offset = tl_json_size(json, &at, "byteOffset", 0);
        accessor->sparse_index_component = read_component_type(parser, &at);
    }
    if (tl_json_object(json, &sparse, "values", &at)) {
        accessor->sparse_value_view = tl_json_index(json, &at, "bufferView", parser->data->view_count, "views");
        accessor->sparse_value_offset = tl_json_size(json, &at, "byteOffset", 0);
    }
}

static void read_accessors(gltf_parser *parser)
{
    tl_json_place list, at;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "accessors", &list);
    data->accessors = make_array(parser, count, sizeof *data->accessors);
    data->accessor_count = data->accessors != NULL ? (uint32_t)count : 0;
    for (uint32_t i = 0; i < data->accessor_count && tl_json_item(&parser->json, &list, i, &at); i++) {
        tl_gltf_accessor *accessor = &data->accessors[i];
        accessor->view = tl_json_index(&parser->json, &at, "bufferView", data->view_count, "views");
        accessor->offset = tl_json_size(&parser->json, &at, "byteOffset", 0);
        accessor->count = tl_json_size(&parser->json, &at, "count", 0);
        accessor->component = read_component_type(parser, &at);
        accessor->component_size = component_size(accessor->component);
        accessor->width = read_width(parser, &at);
        accessor->is_normalized = tl_json_bool(&parser->json, &at, "normalized");
        accessor->sparse_index_view = accessor->sparse_value_view = TL_GLTF_NONE;
        read_sparse_part(parser, &at, accessor);
    }
}

static void read_materials(gltf_parser *parser)
{
    tl_json_place list, at;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "materials", &list);
    data->materials = make_array(parser, count, sizeof *data->materials);
    data->material_count = data->materials != NULL ? (uint32_t)count : 0;
    for (uint32_t i = 0; i < data->material_count && tl_json_item(&parser->json, &list, i, &at); i++) {
        data->materials[i] = tl_json_string(&parser->json, &at, "name");
    }
}

// Those that the file cannot be read without.
static void read_extensions(gltf_parser *parser)
{
    tl_json_place list;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "extensionsRequired", &list);
    data->extensions = make_array(parser, count, sizeof *data->extensions);
    data->extension_count = data->extensions != NULL ? (uint32_t)count : 0;
    for (uint32_t i = 0; i < data->extension_count; i++) {
        data->extensions[i] = json_string_value(json_array_get(list.value, i));
        if (data->extensions[i] == NULL) {
            tl_json_place item = { &parser->root, "extensionsRequired", i, NULL };
            tl_json_fail(&parser->json, TL_ERR_FORMAT, &item, NULL, "is no text");
            return;
        }
    }
}

// --- meshes ---------------------------------------------------------------------------------------------------------

static void read_primitive(gltf_parser *parser, const tl_json_place *at, tl_gltf_primitive *primitive)
{
    tl_json_reader *json = &parser->json;
    const tl_gltf_data *data = parser->data;
    tl_json_place inner, draco;
    size_t mode = tl_json_size(json, at, "mode", TL_GLTF_TRIANGLES);
    if (mode >= TL_GLTF_MODES) {
        tl_json_fail(json, TL_ERR_UNSUPPORTED, at, "mode", "is not known: 0 to 6 are");
        return;
    }
    primitive->mode = (tl_gltf_mode)mode;
    primitive->indices = tl_json_index(json, at, "indices", data->accessor_count, "accessors");
    primitive->material = tl_json_index(json, at, "material", data->material_count, "materials");
    primitive->positions = tl_json_object(json, at, "attributes", &inner)
                               ? tl_json_index(json, &inner, "POSITION", data->accessor_count, "accessors")
                               : TL_GLTF_NONE;
    primitive->is_draco = tl_json_object(json, at, "extensions", &inner) &&
                          tl_json_object(json, &inner, "KHR_draco_mesh_compression", &draco);
}

// How long the lists `key` of all objects of a list are together.
static size_t sum_lists(gltf_parser *parser, const tl_json_place *list, size_t count, const char *key)
{
    tl_json_place at, inner;
    size_t sum = 0;
    for (size_t i = 0; i < count && tl_json_item(&parser->json, list, i, &at); i++) {
        sum += tl_json_list(&parser->json, &at, key, &inner);
    }
    if (sum >= UINT32_MAX) {
        tl_json_fail(&parser->json, TL_ERR_LIMIT, list->above, list->name, "has too many parts");
        return 0;
    }
    return sum;
}

static void read_meshes(gltf_parser *parser)
{
    tl_json_place list, at, primitives, inner;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "meshes", &list);
    size_t primitive_count = sum_lists(parser, &list, count, "primitives");
    data->meshes = make_array(parser, count, sizeof *data->meshes);
    data->mesh_count = data->meshes != NULL ? (uint32_t)count : 0;
    data->primitives = make_array(parser, primitive_count, sizeof *data->primitives);
    data->primitive_count = data->primitives != NULL ? (uint32_t)primitive_count : 0;
    uint32_t next = 0;
    for (uint32_t i = 0; i < data->mesh_count && tl_json_item(&parser->json, &list, i, &at); i++) {
        size_t parts = tl_json_list(&parser->json, &at, "primitives", &primitives);
        data->meshes[i] = (tl_gltf_mesh){ next, (uint32_t)parts };
        for (size_t k = 0; k < parts && tl_json_item(&parser->json, &primitives, k, &inner); k++) {
            read_primitive(parser, &inner, &data->primitives[next++]);
        }
    }
}

// --- nodes ----------------------------------------------------------------------------------------------------------

static void read_instancing(gltf_parser *parser, const tl_json_place *node_at, tl_gltf_node *node)
{
    static const char *const names[] = { "TRANSLATION", "ROTATION", "SCALE" };
    tl_json_reader *json = &parser->json;
    tl_json_place extensions, at, attributes;
    node->instanced_by = TL_GLTF_NONE;
    node->has_instances = tl_json_object(json, node_at, "extensions", &extensions) &&
                          tl_json_object(json, &extensions, "EXT_mesh_gpu_instancing", &at);
    for (int i = 0; i < 3; i++) {
        node->instances[i] = TL_GLTF_NONE;
    }
    if (!node->has_instances || !tl_json_object(json, &at, "attributes", &attributes)) {
        return;
    }
    // Attributes of one's own, "_ID", say how many there are as well.
    for (void *it = json_object_iter(attributes.value); it != NULL; it = json_object_iter_next(attributes.value, it)) {
        node->instanced_by =
            tl_json_index(json, &attributes, json_object_iter_key(it), parser->data->accessor_count, "accessors");
    }
    for (int i = 0; i < 3; i++) {
        node->instances[i] = tl_json_index(json, &attributes, names[i], parser->data->accessor_count, "accessors");
        node->instanced_by = node->instances[i] != TL_GLTF_NONE ? node->instances[i] : node->instanced_by;
    }
}

static void read_node(gltf_parser *parser, const tl_json_place *at, tl_gltf_node *node)
{
    tl_json_reader *json = &parser->json;
    node->parent = TL_GLTF_NONE;
    node->mesh = tl_json_index(json, at, "mesh", parser->data->mesh_count, "meshes");
    node->rotation[3] = 1.0;
    node->scale[0] = node->scale[1] = node->scale[2] = 1.0;
    node->has_matrix = tl_json_numbers(json, at, "matrix", node->matrix, 16);
    tl_json_numbers(json, at, "translation", node->translation, 3);
    tl_json_numbers(json, at, "rotation", node->rotation, 4);
    tl_json_numbers(json, at, "scale", node->scale, 3);
    read_instancing(parser, at, node);
}

static void read_children(gltf_parser *parser, const tl_json_place *at, uint32_t self, uint32_t *next)
{
    tl_gltf_data *data = parser->data;
    tl_json_place children;
    char words[96];
    size_t count = tl_json_list(&parser->json, at, "children", &children);
    data->nodes[self].first_link = *next;
    data->nodes[self].child_count = (uint32_t)count;
    for (size_t i = 0; i < count && parser->json.result == TL_OK; i++) {
        uint32_t child = tl_json_index_item(&parser->json, &children, i, data->node_count, "nodes");
        if (parser->json.result != TL_OK) {
            return;
        }
        if (data->nodes[child].parent != TL_GLTF_NONE) {
            tl_json_place item = { at, "children", i, NULL };
            snprintf(words, sizeof words, "is %u, which is a child of node %u already", child,
                     data->nodes[child].parent);
            tl_json_fail(&parser->json, TL_ERR_FORMAT, &item, NULL, words);
            return;
        }
        data->nodes[child].parent = self;
        data->links[(*next)++] = child;
    }
}

static void read_nodes(gltf_parser *parser)
{
    tl_json_place list, at;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "nodes", &list);
    size_t link_count = sum_lists(parser, &list, count, "children");
    data->nodes = make_array(parser, count, sizeof *data->nodes);
    data->node_count = data->nodes != NULL ? (uint32_t)count : 0;
    data->links = make_array(parser, link_count, sizeof *data->links);
    data->link_count = data->links != NULL ? (uint32_t)link_count : 0;
    for (uint32_t i = 0; i < data->node_count && tl_json_item(&parser->json, &list, i, &at); i++) {
        read_node(parser, &at, &data->nodes[i]);
    }
    uint32_t next = 0;
    for (uint32_t i = 0; i < data->node_count && tl_json_item(&parser->json, &list, i, &at); i++) {
        read_children(parser, &at, i, &next);
    }
}

// Up from every node until one that was met: met in this very walk, it is above itself.
static void check_rings(gltf_parser *parser, uint32_t *met)
{
    const tl_gltf_data *data = parser->data;
    for (uint32_t i = 0; i < data->node_count; i++) {
        uint32_t at = i;
        while (at != TL_GLTF_NONE && met[at] == 0) {
            met[at] = i + 1;
            at = data->nodes[at].parent;
        }
        if (at != TL_GLTF_NONE && met[at] == i + 1) {
            tl_json_place node = { &parser->root, "nodes", at, NULL };
            tl_json_fail(&parser->json, TL_ERR_FORMAT, &node, NULL, "stands below itself");
            return;
        }
    }
}

// What the scene shows: each node once.
static void check_roots(gltf_parser *parser, uint32_t *met)
{
    enum { UNMET, SHOWN, ABOVE };
    const tl_gltf_data *data = parser->data;
    memset(met, 0, (data->node_count + 1) * sizeof *met);
    bool twice = false;
    uint32_t i = 0;
    for (; i < data->root_count && !twice; i++) {
        twice = met[data->roots[i]] == SHOWN;
        met[data->roots[i]] = SHOWN;
    }
    for (uint32_t k = 0; k < data->root_count && !twice; k++) {
        uint32_t at = data->nodes[data->roots[k]].parent;
        while (at != TL_GLTF_NONE && met[at] == UNMET) {
            met[at] = ABOVE;
            at = data->nodes[at].parent;
        }
        twice = at != TL_GLTF_NONE && met[at] == SHOWN;
        i = k + 1;
    }
    if (twice) {
        char words[64];
        snprintf(words, sizeof words, "shows node %u twice", data->roots[i - 1]);
        tl_json_fail(&parser->json, TL_ERR_FORMAT, &parser->root, "the scene", words);
    }
}

static void read_shown_scene(gltf_parser *parser)
{
    tl_json_place list, at, nodes;
    tl_gltf_data *data = parser->data;
    size_t count = tl_json_list(&parser->json, &parser->root, "scenes", &list);
    uint32_t shown = tl_json_index(&parser->json, &parser->root, "scene", count, "scenes");
    shown = shown == TL_GLTF_NONE ? 0 : shown;
    bool has_scene = count > 0 && tl_json_item(&parser->json, &list, shown, &at);
    size_t root_count = has_scene ? tl_json_list(&parser->json, &at, "nodes", &nodes) : data->node_count;
    data->roots = make_array(parser, root_count, sizeof *data->roots);
    data->root_room = data->roots != NULL ? (uint32_t)root_count : 0;
    data->root_count = data->root_room;
    uint32_t next = 0;
    for (uint32_t i = 0; i < data->root_count && parser->json.result == TL_OK; i++) {
        if (has_scene) {
            data->roots[i] = tl_json_index_item(&parser->json, &nodes, i, data->node_count, "nodes");
        } else if (data->nodes[i].parent == TL_GLTF_NONE) {
            data->roots[next++] = i;
        }
    }
    data->root_count = has_scene ? data->root_count : next;
    uint32_t *met = make_array(parser, data->node_count, sizeof *met);
    if (met == NULL) {
        return;
    }
    check_rings(parser, met);
    if (parser->json.result == TL_OK) {
        check_roots(parser, met);
    }
    tl_io_release(&data->allocator, met, (data->node_count + (size_t)1) * sizeof *met);
}

// --- the file -------------------------------------------------------------------------------------------------------

tl_result tl_gltf_parse(const tl_mesh_source *source, const tl_allocator *allocator, tl_gltf_data *data_out,
                        tl_io_error *error_out)
{
    memset(data_out, 0, sizeof *data_out);
    data_out->allocator = tl_io_allocator_or_default(allocator);
    gltf_parser parser = { { TL_OK, source->name, error_out, NULL }, data_out, { NULL, NULL, 0, NULL } };
    const unsigned char *text = NULL;
    size_t length = 0;
    tl_result result = open_container(&parser, source, &text, &length);
    if (result == TL_OK) {
        result = tl_json_load(&parser.json, text, length, &parser.root);
        data_out->json = parser.root.value;
    }
    if (result == TL_OK) {
        static void (*const readers[])(gltf_parser *) = { read_asset,  read_extensions, read_buffers,
                                                          read_views,  read_accessors,  read_materials,
                                                          read_meshes, read_nodes,      read_shown_scene };
        for (size_t i = 0; i < sizeof readers / sizeof readers[0] && parser.json.result == TL_OK; i++) {
            readers[i](&parser);
        }
        result = parser.json.result;
    }
    if (result != TL_OK) {
        tl_gltf_data_free(data_out);
    }
    return result;
}

void tl_gltf_data_free(tl_gltf_data *data)
{
    const struct {
        void *array;
        size_t count, item_size;
    } arrays[] = {
        { data->buffers, data->buffer_count, sizeof *data->buffers },
        { data->views, data->view_count, sizeof *data->views },
        { data->accessors, data->accessor_count, sizeof *data->accessors },
        { data->materials, data->material_count, sizeof *data->materials },
        { data->primitives, data->primitive_count, sizeof *data->primitives },
        { data->meshes, data->mesh_count, sizeof *data->meshes },
        { data->nodes, data->node_count, sizeof *data->nodes },
        { data->links, data->link_count, sizeof *data->links },
        { data->roots, data->root_room, sizeof *data->roots },
        { data->extensions, data->extension_count, sizeof *data->extensions },
    };
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) {
        if (arrays[i].array != NULL) {
            tl_io_release(&data->allocator, arrays[i].array, (arrays[i].count + 1) * arrays[i].item_size);
        }
    }
    json_decref(data->json);
    memset(data, 0, sizeof *data);
}
