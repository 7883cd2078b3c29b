// SPDX-License-Identifier: MIT
//
// The nodes of a glTF scene to one list of triangles. The walk keeps its own stack, as assimp_reader.c's does.

#include "io/mesh/gltf_reader.h"

#include "io/files/growable.h"
#include "io/mesh/affine.h"
#include "io/mesh/gltf_buffers.h"

#include <string.h>

// A node still to be visited, and its parent's map to the world.
typedef struct pending_gltf_node {
    const cgltf_node *node;
    tl_affine parent;
} pending_gltf_node;

typedef struct gltf_reader {
    tl_gltf_file file;
    tl_imported_mesh *mesh;
    const char *name;
    tl_io_error *error;
    pending_gltf_node *stack;
    uint64_t stack_count;
    uint64_t stack_capacity;
    uint64_t visited_count;
    float *positions; // of the primitive
    uint64_t position_capacity;
    uint32_t *indices;
    uint64_t index_capacity;
    tl_affine *instances; // of the node
    uint64_t instance_capacity;
} gltf_reader;

static tl_result fail_gltf_memory(const gltf_reader *reader)
{
    return tl_io_fail(reader->error, TL_ERR_MEMORY, reader->name, 0, NULL, "out of memory");
}

static tl_result fail_gltf_reserve(const gltf_reader *reader, tl_result result, const char *what)
{
    if (result == TL_ERR_MEMORY) {
        return fail_gltf_memory(reader);
    }
    return tl_io_fail(reader->error, result, reader->name, 0, "cut the level into parts",
                      "more %s than one mesh may have", what);
}

// --- extensions -----------------------------------------------------------------------------------------------------

// Read here, or of no concern to the shape.
static bool is_known_extension(const char *name)
{
    static const char *const known[] = {
        "KHR_mesh_quantization",  "EXT_mesh_gpu_instancing", "EXT_meshopt_compression",
        "KHR_texture_transform",  "KHR_texture_basisu",      "EXT_texture_webp",
        "EXT_texture_avif",       "MSFT_texture_dds",        "KHR_lights_punctual",
        "EXT_lights_image_based", "EXT_lights_ies",          "KHR_animation_pointer",
        "KHR_xmp_json_ld",        "KHR_techniques_webgl",    "ADOBE_materials_clearcoat_tint",
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strcmp(name, known[i]) == 0) {
            return true;
        }
    }
    return strncmp(name, "KHR_materials_", 14) == 0 || strncmp(name, "EXT_materials_", 14) == 0;
}

static tl_result check_extensions(const gltf_reader *reader)
{
    const cgltf_data *data = reader->file.data;
    for (size_t i = 0; i < data->extensions_required_count; i++) {
        const char *name = data->extensions_required[i];
        if (!is_known_extension(name)) {
            bool draco = strcmp(name, "KHR_draco_mesh_compression") == 0;
            return tl_io_fail(reader->error, TL_ERR_UNSUPPORTED, reader->name, 0,
                              draco ? "export it without Draco compression" : "export it without this extension",
                              "it requires the glTF extension %s, which is not read", name);
        }
    }
    return TL_OK;
}

// --- primitives -----------------------------------------------------------------------------------------------------

static tl_result find_gltf_material(gltf_reader *reader, const cgltf_material *material, uint32_t *id_out)
{
    *id_out = 0;
    if (material == NULL || material->name == NULL || material->name[0] == '\0') {
        return TL_OK;
    }
    tl_result result = tl_name_table_add(&reader->mesh->names, &reader->mesh->allocator, material->name,
                                         strlen(material->name), TL_MAX_IMPORTED_MATERIALS, id_out);
    if (result == TL_ERR_LIMIT) {
        return tl_io_fail(reader->error, result, reader->name, 0, "join materials",
                          "more than 65535 different materials");
    }
    return result == TL_OK ? TL_OK : fail_gltf_memory(reader);
}

// The positions and indices of a primitive into the reader's arrays. Without indices each vertex is one in turn.
static tl_result load_primitive(gltf_reader *reader, const cgltf_primitive *primitive, const cgltf_accessor *positions,
                                size_t *index_count_out)
{
    const tl_allocator *allocator = &reader->mesh->allocator;
    const cgltf_accessor *indices = primitive->indices;
    tl_result result = tl_gltf_check_accessor(&reader->file, positions);
    if (result == TL_OK && indices != NULL) {
        result = tl_gltf_check_accessor(&reader->file, indices);
    }
    if (result != TL_OK) {
        return result;
    }
    size_t count = indices != NULL ? indices->count : positions->count;
    if (!tl_io_grow(allocator, (void **)&reader->positions, &reader->position_capacity, 0, positions->count * 3,
                    sizeof *reader->positions) ||
        !tl_io_grow(allocator, (void **)&reader->indices, &reader->index_capacity, 0, count, sizeof *reader->indices)) {
        return fail_gltf_memory(reader);
    }
    result = tl_gltf_read_floats(&reader->file, positions, 3, reader->positions);
    if (result == TL_OK && indices != NULL) {
        result = tl_gltf_read_indices(&reader->file, indices, reader->indices);
    }
    for (size_t i = 0; i < count && result == TL_OK; i++) {
        if (indices == NULL) {
            reader->indices[i] = (uint32_t)i;
        } else if (reader->indices[i] >= positions->count) {
            tl_io_fail(reader->error, TL_ERR_INDEX, reader->name, 0, "export the file again",
                       "index %zu of accessor %zu names vertex %u of %zu", i,
                       (size_t)(indices - reader->file.data->accessors), reader->indices[i], positions->count);
            return tl_io_blame(reader->error, TL_ERR_INDEX, "face", reader->mesh->face_count);
        }
    }
    *index_count_out = count;
    return result;
}

static tl_result add_gltf_vertices(gltf_reader *reader, size_t count, const tl_affine *to_world)
{
    tl_imported_mesh *mesh = reader->mesh;
    tl_result result = tl_imported_mesh_reserve_vertices(mesh, count);
    if (result != TL_OK) {
        return fail_gltf_reserve(reader, result, "vertices");
    }
    for (size_t i = 0; i < count; i++) {
        const float *p = reader->positions + i * 3;
        tl_vec3 vertex = tl_affine_apply(to_world, (double)p[0], (double)p[1], (double)p[2]);
        if (!tl_is_finite(vertex)) {
            bool was_finite = tl_is_finite(tl_vec3_make(p[0], p[1], p[2]));
            result = was_finite ? TL_ERR_RANGE : TL_ERR_NOT_FINITE;
            tl_io_fail(
                reader->error, result, reader->name, 0,
                was_finite ? "check the scale of its nodes" : "remove the broken vertex in the tool that wrote it",
                "vertex %zu of a mesh %s", i, was_finite ? "is placed beyond the largest float" : "is not finite");
            return tl_io_blame(reader->error, result, "vertex", mesh->vertex_count);
        }
        mesh->vertices[mesh->vertex_count++] = vertex;
    }
    return TL_OK;
}

static tl_result add_gltf_triangles(gltf_reader *reader, cgltf_primitive_type type, size_t count, uint32_t first_vertex,
                                    bool mirrored, uint32_t material)
{
    tl_imported_mesh *mesh = reader->mesh;
    bool strip = type == cgltf_primitive_type_triangle_strip;
    bool fan = type == cgltf_primitive_type_triangle_fan;
    size_t triangles = strip || fan ? (count >= 3 ? count - 2 : 0) : count / 3;
    if (!strip && !fan && count % 3 != 0) {
        return tl_io_fail(reader->error, TL_ERR_FORMAT, reader->name, 0, "export the file again",
                          "%zu corners of triangles: no multiple of 3", count);
    }
    tl_result result = tl_imported_mesh_reserve_triangles(mesh, triangles);
    if (result != TL_OK) {
        return fail_gltf_reserve(reader, result, "triangles");
    }
    for (size_t i = 0; i < triangles; i++) {
        size_t odd = i & 1;
        size_t corners[3] = { i * 3, i * 3 + 1, i * 3 + 2 };
        if (strip) {
            corners[0] = i;
            corners[1] = i + 1 + odd;
            corners[2] = i + 2 - odd;
        } else if (fan) {
            corners[0] = 0;
            corners[1] = i + 1;
            corners[2] = i + 2;
        }
        uint32_t *indices = mesh->indices + (size_t)mesh->triangle_count * 3;
        indices[0] = first_vertex + reader->indices[corners[0]];
        indices[1] = first_vertex + reader->indices[corners[mirrored ? 2 : 1]];
        indices[2] = first_vertex + reader->indices[corners[mirrored ? 1 : 2]];
        mesh->materials[mesh->triangle_count] = (uint16_t)material;
        mesh->source_lines[mesh->triangle_count] = 0;
        mesh->triangle_count++;
        mesh->face_count++;
    }
    return TL_OK;
}

static tl_result add_gltf_faces(gltf_reader *reader, const cgltf_primitive *primitive, size_t count,
                                uint32_t first_vertex, bool mirrored)
{
    tl_imported_mesh *mesh = reader->mesh;
    uint32_t material;
    tl_result result;
    switch (primitive->type) {
    case cgltf_primitive_type_points:
        mesh->ignored_points += count;
        return TL_OK;
    case cgltf_primitive_type_lines:
        mesh->ignored_lines += count / 2;
        return TL_OK;
    case cgltf_primitive_type_line_strip:
        mesh->ignored_lines += count - 1;
        return TL_OK;
    case cgltf_primitive_type_line_loop:
        mesh->ignored_lines += count;
        return TL_OK;
    case cgltf_primitive_type_triangles:
    case cgltf_primitive_type_triangle_strip:
    case cgltf_primitive_type_triangle_fan:
        result = find_gltf_material(reader, primitive->material, &material);
        return result != TL_OK ? result
                               : add_gltf_triangles(reader, primitive->type, count, first_vertex, mirrored, material);
    default:
        return tl_io_fail(reader->error, TL_ERR_FORMAT, reader->name, 0, "export the file again",
                          "a mesh of an unknown mode");
    }
}

static const cgltf_accessor *find_positions(const cgltf_primitive *primitive)
{
    for (size_t i = 0; i < primitive->attributes_count; i++) {
        if (primitive->attributes[i].type == cgltf_attribute_type_position) {
            return primitive->attributes[i].data;
        }
    }
    return NULL;
}

// A primitive, once for each of the maps.
static tl_result add_primitive(gltf_reader *reader, const cgltf_primitive *primitive, const tl_affine *maps,
                               size_t map_count)
{
    const cgltf_accessor *positions = find_positions(primitive);
    if (positions == NULL) {
        return TL_OK; // nothing to see, says glTF
    }
    if (primitive->has_draco_mesh_compression && positions->buffer_view == NULL) {
        return tl_io_fail(reader->error, TL_ERR_UNSUPPORTED, reader->name, 0, "export it without Draco compression",
                          "its meshes are packed by the glTF extension KHR_draco_mesh_compression, which is not read");
    }
    size_t count = 0;
    tl_result result = load_primitive(reader, primitive, positions, &count);
    for (size_t i = 0; i < map_count && result == TL_OK; i++) {
        uint32_t first_vertex = reader->mesh->vertex_count;
        result = add_gltf_vertices(reader, positions->count, &maps[i]);
        if (result == TL_OK) {
            result = add_gltf_faces(reader, primitive, count, first_vertex, tl_affine_mirrors(&maps[i]));
        }
    }
    return result;
}

// --- nodes ----------------------------------------------------------------------------------------------------------

// A translation, a turn (a unit quaternion) and a scale.
static tl_affine affine_of_parts(const float t[3], const float q[4], const float s[3])
{
    double x = (double)q[0], y = (double)q[1], z = (double)q[2], w = (double)q[3];
    double sx = (double)s[0], sy = (double)s[1], sz = (double)s[2];
    return (tl_affine){ {
        { (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y - z * w) * sy, 2 * (x * z + y * w) * sz, (double)t[0] },
        { 2 * (x * y + z * w) * sx, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z - x * w) * sz, (double)t[1] },
        { 2 * (x * z - y * w) * sx, 2 * (y * z + x * w) * sy, (1 - 2 * (x * x + y * y)) * sz, (double)t[2] },
    } };
}

static tl_affine affine_of_node(const cgltf_node *node)
{
    if (!node->has_matrix) {
        return affine_of_parts(node->translation, node->rotation, node->scale);
    }
    tl_affine result;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            result.row[i][k] = (double)node->matrix[k * 4 + i];
        }
    }
    return result;
}

// One attribute of the instances, `width` floats each, into `values`; untouched when it is not there.
static tl_result read_instance_attribute(gltf_reader *reader, const cgltf_node *node, const char *name, size_t width,
                                         size_t count, float *values)
{
    const cgltf_mesh_gpu_instancing *instancing = &node->mesh_gpu_instancing;
    for (size_t i = 0; i < instancing->attributes_count; i++) {
        const cgltf_accessor *accessor = instancing->attributes[i].data;
        if (instancing->attributes[i].name == NULL || strcmp(instancing->attributes[i].name, name) != 0) {
            continue;
        }
        if (accessor->count != count) {
            return tl_io_fail(reader->error, TL_ERR_FORMAT, reader->name, 0, "export the file again",
                              "the attributes of instances differ in their counts");
        }
        tl_result result = tl_gltf_check_accessor(&reader->file, accessor);
        return result == TL_OK ? tl_gltf_read_floats(&reader->file, accessor, width, values) : result;
    }
    return TL_OK;
}

// The maps of EXT_mesh_gpu_instancing into the reader's array.
static tl_result load_instances(gltf_reader *reader, const cgltf_node *node, const tl_affine *to_world,
                                size_t *count_out)
{
    const tl_allocator *allocator = &reader->mesh->allocator;
    const cgltf_mesh_gpu_instancing *instancing = &node->mesh_gpu_instancing;
    *count_out = 0;
    if (instancing->attributes_count == 0) {
        return TL_OK;
    }
    tl_result result = tl_gltf_check_accessor(&reader->file, instancing->attributes[0].data);
    if (result != TL_OK) {
        return result;
    }
    size_t count = instancing->attributes[0].data->count;
    float *values = tl_io_allocate(allocator, count * 10 * sizeof *values);
    if (values == NULL || !tl_io_grow(allocator, (void **)&reader->instances, &reader->instance_capacity, 0, count,
                                      sizeof *reader->instances)) {
        tl_io_release(allocator, values, count * 10 * sizeof *values);
        return fail_gltf_memory(reader);
    }
    float *moves = values, *turns = values + count * 3, *scales = values + count * 7;
    for (size_t i = 0; i < count; i++) {
        memset(moves + i * 3, 0, 3 * sizeof *moves);
        memcpy(turns + i * 4, (const float[4]){ 0.0f, 0.0f, 0.0f, 1.0f }, 4 * sizeof *turns);
        memcpy(scales + i * 3, (const float[3]){ 1.0f, 1.0f, 1.0f }, 3 * sizeof *scales);
    }
    result = read_instance_attribute(reader, node, "TRANSLATION", 3, count, moves);
    result = result != TL_OK ? result : read_instance_attribute(reader, node, "ROTATION", 4, count, turns);
    result = result != TL_OK ? result : read_instance_attribute(reader, node, "SCALE", 3, count, scales);
    for (size_t i = 0; i < count && result == TL_OK; i++) {
        tl_affine local = affine_of_parts(moves + i * 3, turns + i * 4, scales + i * 3);
        reader->instances[i] = tl_affine_multiply(to_world, &local);
    }
    tl_io_release(allocator, values, count * 10 * sizeof *values);
    *count_out = count;
    return result;
}

static tl_result add_gltf_node(gltf_reader *reader, const cgltf_node *node, const tl_affine *to_world)
{
    if (node->mesh == NULL) {
        return TL_OK;
    }
    const tl_affine *maps = to_world;
    size_t map_count = 1;
    tl_result result = TL_OK;
    if (node->has_mesh_gpu_instancing) {
        result = load_instances(reader, node, to_world, &map_count);
        maps = reader->instances;
    }
    for (size_t i = 0; i < map_count && result == TL_OK; i++) {
        reader->mesh->mirrored_nodes += tl_affine_mirrors(&maps[i]);
    }
    for (size_t i = 0; i < node->mesh->primitives_count && result == TL_OK; i++) {
        result = add_primitive(reader, &node->mesh->primitives[i], maps, map_count);
    }
    return result;
}

static tl_result push_gltf_nodes(gltf_reader *reader, cgltf_node *const *nodes, size_t count, const tl_affine *parent)
{
    if (!tl_io_grow(&reader->mesh->allocator, (void **)&reader->stack, &reader->stack_capacity, reader->stack_count,
                    reader->stack_count + count, sizeof *reader->stack)) {
        return fail_gltf_memory(reader);
    }
    for (size_t i = count; i-- > 0;) {
        reader->stack[reader->stack_count].node = nodes[i];
        reader->stack[reader->stack_count].parent = *parent;
        reader->stack_count++;
    }
    return TL_OK;
}

static tl_result push_roots(gltf_reader *reader)
{
    const cgltf_data *data = reader->file.data;
    const cgltf_scene *scene = data->scene != NULL ? data->scene : data->scenes_count > 0 ? &data->scenes[0] : NULL;
    tl_affine identity = tl_affine_identity();
    if (scene != NULL) {
        return push_gltf_nodes(reader, scene->nodes, scene->nodes_count, &identity);
    }
    tl_result result = TL_OK;
    for (size_t i = data->nodes_count; i-- > 0 && result == TL_OK;) {
        cgltf_node *node = &data->nodes[i];
        result = node->parent == NULL ? push_gltf_nodes(reader, &node, 1, &identity) : TL_OK;
    }
    return result;
}

// Depth first, children in their order. Each node has one parent, so more visits than nodes mean a ring.
static tl_result walk_gltf_nodes(gltf_reader *reader)
{
    tl_result result = push_roots(reader);
    while (reader->stack_count > 0 && result == TL_OK) {
        if (reader->stack_count + reader->visited_count++ > reader->file.data->nodes_count) {
            return tl_io_fail(reader->error, TL_ERR_FORMAT, reader->name, 0, "export the file again",
                              "a node stands below itself, or twice in a scene");
        }
        pending_gltf_node pending = reader->stack[--reader->stack_count];
        tl_affine local = affine_of_node(pending.node);
        tl_affine to_world = tl_affine_multiply(&pending.parent, &local);
        result = add_gltf_node(reader, pending.node, &to_world);
        if (result == TL_OK) {
            result = push_gltf_nodes(reader, pending.node->children, pending.node->children_count, &to_world);
        }
    }
    return result;
}

// --- the file -------------------------------------------------------------------------------------------------------

static tl_result parse_gltf(const tl_mesh_source *source, cgltf_data **data_out, tl_io_error *error)
{
    const char *bytes = source->bytes;
    size_t mark = source->size >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    cgltf_options options;
    memset(&options, 0, sizeof options);
    switch (cgltf_parse(&options, bytes + mark, source->size - mark, data_out)) {
    case cgltf_result_success:
        return TL_OK;
    case cgltf_result_legacy_gltf:
        return tl_io_fail(error, TL_ERR_UNSUPPORTED, source->name, 0, "export it as glTF 2.0", "glTF 1.0 is not read");
    case cgltf_result_out_of_memory:
        return tl_io_fail(error, TL_ERR_MEMORY, source->name, 0, NULL, "out of memory");
    case cgltf_result_data_too_short:
        return tl_io_fail(error, TL_ERR_FORMAT, source->name, 0, "export it again", "the file is cut short");
    case cgltf_result_invalid_json:
        return tl_io_fail(error, TL_ERR_FORMAT, source->name, 0, "export it again", "the JSON of the glTF is damaged");
    default:
        return tl_io_fail(error, TL_ERR_FORMAT, source->name, 0, "export it again", "no well-formed glTF 2.0");
    }
}

static tl_result read_gltf_scene(gltf_reader *reader, bool allow_no_triangles)
{
    tl_imported_mesh *mesh = reader->mesh;
    const cgltf_data *data = reader->file.data;
    uint32_t nameless;
    for (size_t i = 0; i < data->materials_count; i++) {
        if (data->materials[i].name != NULL) {
            cgltf_decode_string(data->materials[i].name);
        }
    }
    if (tl_name_table_add(&mesh->names, &mesh->allocator, "", 0, 1, &nameless) != TL_OK) {
        return fail_gltf_memory(reader);
    }
    tl_result result = check_extensions(reader);
    result = result != TL_OK ? result : tl_gltf_file_init(&reader->file);
    if (result == TL_OK) {
        result = walk_gltf_nodes(reader);
        tl_gltf_file_free(&reader->file);
    }
    if (result == TL_OK && (mesh->vertex_count == 0 || (mesh->triangle_count == 0 && !allow_no_triangles))) {
        return tl_io_fail(reader->error, TL_ERR_EMPTY, reader->name, 0, "export the level with its meshes", "%s",
                          mesh->vertex_count == 0 ? "no vertices" : "no triangles");
    }
    return result;
}

tl_result tl_gltf_read(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                       tl_io_error *error_out)
{
    memset(mesh_out, 0, sizeof *mesh_out);
    cgltf_data *data = NULL;
    tl_result result = parse_gltf(source, &data, error_out);
    if (result != TL_OK) {
        return result;
    }
    tl_imported_mesh_init(mesh_out, allocator);
    mesh_out->format = "glTF";
    mesh_out->file_unit = 1.0f; // glTF is in metres, y up
    mesh_out->file_up = 2;
    mesh_out->source_bytes = source->size;
    gltf_reader reader;
    memset(&reader, 0, sizeof reader);
    reader.file = (tl_gltf_file){ source, data, NULL, NULL, mesh_out->allocator, error_out };
    reader.mesh = mesh_out;
    reader.name = source->name;
    reader.error = error_out;
    result = read_gltf_scene(&reader, source->allow_no_triangles);
    tl_io_release(&mesh_out->allocator, reader.stack, reader.stack_capacity * sizeof *reader.stack);
    tl_io_release(&mesh_out->allocator, reader.positions, reader.position_capacity * sizeof *reader.positions);
    tl_io_release(&mesh_out->allocator, reader.indices, reader.index_capacity * sizeof *reader.indices);
    tl_io_release(&mesh_out->allocator, reader.instances, reader.instance_capacity * sizeof *reader.instances);
    cgltf_free(data);
    if (result != TL_OK) {
        tl_imported_mesh_free(mesh_out);
    }
    return result;
}
