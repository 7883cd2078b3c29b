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
    uint32_t node;
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
    const tl_gltf_data *data = reader->file.data;
    for (uint32_t i = 0; i < data->extension_count; i++) {
        const char *name = data->extensions[i];
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

static tl_result find_gltf_material(gltf_reader *reader, uint32_t material, uint32_t *id_out)
{
    const char *name = material != TL_GLTF_NONE ? reader->file.data->materials[material] : NULL;
    *id_out = 0;
    if (name == NULL || name[0] == '\0') {
        return TL_OK;
    }
    tl_result result = tl_name_table_add(&reader->mesh->names, &reader->mesh->allocator, name, strlen(name),
                                         TL_MAX_IMPORTED_MATERIALS, id_out);
    if (result == TL_ERR_LIMIT) {
        return tl_io_fail(reader->error, result, reader->name, 0, "join materials",
                          "more than 65535 different materials");
    }
    return result == TL_OK ? TL_OK : fail_gltf_memory(reader);
}

// The positions and indices of a primitive into the reader's arrays. Without indices each vertex is one in turn.
static tl_result load_primitive(gltf_reader *reader, const tl_gltf_primitive *primitive, size_t *index_count_out)
{
    const tl_allocator *allocator = &reader->mesh->allocator;
    const tl_gltf_accessor *positions = &reader->file.data->accessors[primitive->positions];
    const tl_gltf_accessor *indices =
        primitive->indices != TL_GLTF_NONE ? &reader->file.data->accessors[primitive->indices] : NULL;
    tl_result result = tl_gltf_check_accessor(&reader->file, primitive->positions);
    if (result == TL_OK && indices != NULL) {
        result = tl_gltf_check_accessor(&reader->file, primitive->indices);
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
    result = tl_gltf_read_floats(&reader->file, primitive->positions, 3, reader->positions);
    if (result == TL_OK && indices != NULL) {
        result = tl_gltf_read_indices(&reader->file, primitive->indices, reader->indices);
    }
    for (size_t i = 0; i < count && result == TL_OK; i++) {
        if (indices == NULL) {
            reader->indices[i] = (uint32_t)i;
        } else if (reader->indices[i] >= positions->count) {
            tl_io_fail(reader->error, TL_ERR_INDEX, reader->name, 0, "export the file again",
                       "index %zu of accessor %u names vertex %u of %zu", i, primitive->indices, reader->indices[i],
                       positions->count);
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

static tl_result add_gltf_triangles(gltf_reader *reader, tl_gltf_mode mode, size_t count, uint32_t first_vertex,
                                    bool mirrored, uint32_t material)
{
    tl_imported_mesh *mesh = reader->mesh;
    bool strip = mode == TL_GLTF_TRIANGLE_STRIP;
    bool fan = mode == TL_GLTF_TRIANGLE_FAN;
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

static tl_result add_gltf_faces(gltf_reader *reader, const tl_gltf_primitive *primitive, size_t count,
                                uint32_t first_vertex, bool mirrored)
{
    tl_imported_mesh *mesh = reader->mesh;
    uint32_t material;
    tl_result result;
    switch (primitive->mode) {
    case TL_GLTF_POINTS:
        mesh->ignored_points += count;
        return TL_OK;
    case TL_GLTF_LINES:
        mesh->ignored_lines += count / 2;
        return TL_OK;
    case TL_GLTF_LINE_STRIP:
        mesh->ignored_lines += count - 1;
        return TL_OK;
    case TL_GLTF_LINE_LOOP:
        mesh->ignored_lines += count;
        return TL_OK;
    case TL_GLTF_TRIANGLES:
    case TL_GLTF_TRIANGLE_STRIP:
    case TL_GLTF_TRIANGLE_FAN:
        result = find_gltf_material(reader, primitive->material, &material);
        return result != TL_OK ? result
                               : add_gltf_triangles(reader, primitive->mode, count, first_vertex, mirrored, material);
    default:
        return tl_io_fail(reader->error, TL_ERR_FORMAT, reader->name, 0, "export the file again",
                          "a mesh of an unknown mode");
    }
}

// A primitive, once for each of the maps.
static tl_result add_primitive(gltf_reader *reader, const tl_gltf_primitive *primitive, const tl_affine *maps,
                               size_t map_count)
{
    if (primitive->positions == TL_GLTF_NONE) {
        return TL_OK; // nothing to see, says glTF
    }
    const tl_gltf_accessor *positions = &reader->file.data->accessors[primitive->positions];
    if (primitive->is_draco && positions->view == TL_GLTF_NONE) {
        return tl_io_fail(reader->error, TL_ERR_UNSUPPORTED, reader->name, 0, "export it without Draco compression",
                          "its meshes are packed by the glTF extension KHR_draco_mesh_compression, which is not read");
    }
    size_t count = 0;
    tl_result result = load_primitive(reader, primitive, &count);
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
static tl_affine affine_of_parts(const double t[3], const double q[4], const double s[3])
{
    double x = q[0], y = q[1], z = q[2], w = q[3];
    double sx = s[0], sy = s[1], sz = s[2];
    return (tl_affine){ {
        { (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y - z * w) * sy, 2 * (x * z + y * w) * sz, t[0] },
        { 2 * (x * y + z * w) * sx, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z - x * w) * sz, t[1] },
        { 2 * (x * z - y * w) * sx, 2 * (y * z + x * w) * sy, (1 - 2 * (x * x + y * y)) * sz, t[2] },
    } };
}

static tl_affine affine_of_node(const tl_gltf_node *node)
{
    if (!node->has_matrix) {
        return affine_of_parts(node->translation, node->rotation, node->scale);
    }
    tl_affine result;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            result.row[i][k] = node->matrix[k * 4 + i];
        }
    }
    return result;
}

// One attribute of the instances, `width` numbers each, into `values`; untouched when it is not there. `floats` is
// room.
static tl_result read_instance_attribute(gltf_reader *reader, uint32_t accessor, size_t width, size_t count,
                                         float *floats, double *values)
{
    if (accessor == TL_GLTF_NONE) {
        return TL_OK;
    }
    if (reader->file.data->accessors[accessor].count != count) {
        return tl_io_fail(reader->error, TL_ERR_FORMAT, reader->name, 0, "export the file again",
                          "the attributes of instances differ in their counts");
    }
    tl_result result = tl_gltf_check_accessor(&reader->file, accessor);
    result = result == TL_OK ? tl_gltf_read_floats(&reader->file, accessor, width, floats) : result;
    for (size_t i = 0; i < count * width && result == TL_OK; i++) {
        values[i] = (double)floats[i];
    }
    return result;
}

// The maps of EXT_mesh_gpu_instancing into the reader's array.
static tl_result load_instances(gltf_reader *reader, const tl_gltf_node *node, const tl_affine *to_world,
                                size_t *count_out)
{
    const tl_allocator *allocator = &reader->mesh->allocator;
    *count_out = 0;
    if (node->instanced_by == TL_GLTF_NONE) {
        return TL_OK;
    }
    tl_result result = tl_gltf_check_accessor(&reader->file, node->instanced_by);
    if (result != TL_OK) {
        return result;
    }
    size_t count = reader->file.data->accessors[node->instanced_by].count;
    size_t room = count * (10 * sizeof(double) + 4 * sizeof(float));
    double *values = tl_io_allocate(allocator, room);
    if (values == NULL || !tl_io_grow(allocator, (void **)&reader->instances, &reader->instance_capacity, 0, count,
                                      sizeof *reader->instances)) {
        tl_io_release(allocator, values, room);
        return fail_gltf_memory(reader);
    }
    double *moves = values, *turns = values + count * 3, *scales = values + count * 7;
    float *floats = (float *)(values + count * 10);
    for (size_t i = 0; i < count; i++) {
        memset(moves + i * 3, 0, 3 * sizeof *moves);
        memcpy(turns + i * 4, (const double[4]){ 0.0, 0.0, 0.0, 1.0 }, 4 * sizeof *turns);
        memcpy(scales + i * 3, (const double[3]){ 1.0, 1.0, 1.0 }, 3 * sizeof *scales);
    }
    const uint32_t *by = node->instances;
    result = read_instance_attribute(reader, by[TL_GLTF_TRANSLATION], 3, count, floats, moves);
    result = result == TL_OK ? read_instance_attribute(reader, by[TL_GLTF_ROTATION], 4, count, floats, turns) : result;
    result = result == TL_OK ? read_instance_attribute(reader, by[TL_GLTF_SCALE], 3, count, floats, scales) : result;
    for (size_t i = 0; i < count && result == TL_OK; i++) {
        tl_affine local = affine_of_parts(moves + i * 3, turns + i * 4, scales + i * 3);
        reader->instances[i] = tl_affine_multiply(to_world, &local);
    }
    tl_io_release(allocator, values, room);
    *count_out = count;
    return result;
}

static tl_result add_gltf_node(gltf_reader *reader, const tl_gltf_node *node, const tl_affine *to_world)
{
    if (node->mesh == TL_GLTF_NONE) {
        return TL_OK;
    }
    const tl_gltf_data *data = reader->file.data;
    const tl_gltf_mesh *mesh = &data->meshes[node->mesh];
    const tl_affine *maps = to_world;
    size_t map_count = 1;
    tl_result result = TL_OK;
    if (node->has_instances) {
        result = load_instances(reader, node, to_world, &map_count);
        maps = reader->instances;
    }
    for (size_t i = 0; i < map_count && result == TL_OK; i++) {
        reader->mesh->mirrored_nodes += tl_affine_mirrors(&maps[i]);
    }
    for (uint32_t i = 0; i < mesh->primitive_count && result == TL_OK; i++) {
        result = add_primitive(reader, &data->primitives[mesh->first_primitive + i], maps, map_count);
    }
    return result;
}

static tl_result push_gltf_nodes(gltf_reader *reader, const uint32_t *nodes, size_t count, const tl_affine *parent)
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

// Depth first, children in their order. The parser has seen that each node comes once.
static tl_result walk_gltf_nodes(gltf_reader *reader)
{
    const tl_gltf_data *data = reader->file.data;
    tl_affine root = tl_affine_identity();
    for (int i = 0; i < 3; i++) {
        root.row[i][3] = 0.0 - reader->file.source->origin[i];
    }
    tl_result result = push_gltf_nodes(reader, data->roots, data->root_count, &root);
    while (reader->stack_count > 0 && result == TL_OK) {
        pending_gltf_node pending = reader->stack[--reader->stack_count];
        const tl_gltf_node *node = &data->nodes[pending.node];
        tl_affine local = affine_of_node(node);
        tl_affine to_world = tl_affine_multiply(&pending.parent, &local);
        result = add_gltf_node(reader, node, &to_world);
        if (result == TL_OK) {
            result = push_gltf_nodes(reader, data->links + node->first_link, node->child_count, &to_world);
        }
    }
    return result;
}

// --- the file -------------------------------------------------------------------------------------------------------

static tl_result read_gltf_scene(gltf_reader *reader, bool allow_no_triangles)
{
    tl_imported_mesh *mesh = reader->mesh;
    uint32_t nameless;
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
    tl_gltf_data data;
    tl_result result = tl_gltf_parse(source, allocator, &data, error_out);
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
    reader.file = (tl_gltf_file){ source, &data, NULL, NULL, mesh_out->allocator, error_out };
    reader.mesh = mesh_out;
    reader.name = source->name;
    reader.error = error_out;
    result = read_gltf_scene(&reader, source->allow_no_triangles);
    tl_io_release(&mesh_out->allocator, reader.stack, reader.stack_capacity * sizeof *reader.stack);
    tl_io_release(&mesh_out->allocator, reader.positions, reader.position_capacity * sizeof *reader.positions);
    tl_io_release(&mesh_out->allocator, reader.indices, reader.index_capacity * sizeof *reader.indices);
    tl_io_release(&mesh_out->allocator, reader.instances, reader.instance_capacity * sizeof *reader.instances);
    tl_gltf_data_free(&data);
    if (result != TL_OK) {
        tl_imported_mesh_free(mesh_out);
    }
    return result;
}
