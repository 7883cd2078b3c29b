// SPDX-License-Identifier: MIT
//
// A scene of Assimp's to one list of triangles.
//
// The node tree is walked here, not by aiProcess_PreTransformVertices: that one leaves mirrored nodes wound inside out,
// joins what has no need to be joined, and reorders triangles. Nor are polygons split by aiProcess_Triangulate, which
// asserts on faces without corners; they are treated as those of OBJ files are (split_polygon.h). The walk keeps its
// own stack: a hostile file's depth of nesting must not become ours.

#include "io/mesh/assimp_reader.h"

#include "io/files/growable.h"
#include "io/mesh/affine.h"
#include "io/mesh/assimp_files.h"
#include "io/mesh/split_polygon.h"

#include <assimp/cimport.h>
#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <math.h>
#include <string.h>

// A node still to be visited, and its parent's map to the world.
typedef struct pending_scene_node {
    const struct aiNode *node;
    tl_affine parent;
} pending_scene_node;

typedef struct scene_reader {
    const struct aiScene *scene;
    tl_imported_mesh *mesh;
    const char *path;
    tl_io_error *error;
    pending_scene_node *stack;
    uint64_t stack_count;
    uint64_t stack_capacity;
    tl_affine to_metres;      // from the file's unit and axes
    tl_split_corner *scratch; // TL_MAX_SPLIT_CORNERS of each, once there is a polygon
    uint32_t *corners;
} scene_reader;

static tl_affine affine_of_matrix(const struct aiMatrix4x4 *m)
{
    return (tl_affine){ { { (double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4 },
                          { (double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4 },
                          { (double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4 } } };
}

static tl_result fail_scene_memory(scene_reader *reader)
{
    return tl_io_fail(reader->error, TL_ERR_MEMORY, reader->path, 0, NULL, "out of memory");
}

static tl_result fail_scene_reserve(scene_reader *reader, tl_result result, const char *what)
{
    if (result == TL_ERR_MEMORY) {
        return fail_scene_memory(reader);
    }
    return tl_io_fail(reader->error, result, reader->path, 0, "cut the level into parts",
                      "more %s than one mesh may have", what);
}

static tl_result find_material(scene_reader *reader, unsigned index, uint32_t *id_out)
{
    struct aiString name;
    memset(&name, 0, sizeof name);
    *id_out = 0;
    if (index >= reader->scene->mNumMaterials ||
        aiGetMaterialString(reader->scene->mMaterials[index], AI_MATKEY_NAME, &name) != aiReturn_SUCCESS ||
        strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0) {
        return TL_OK;
    }
    tl_result result = tl_name_table_add(&reader->mesh->names, &reader->mesh->allocator, name.data, strlen(name.data),
                                         TL_MAX_IMPORTED_MATERIALS, id_out);
    if (result == TL_ERR_LIMIT) {
        return tl_io_fail(reader->error, result, reader->path, 0, "join materials",
                          "more than 65535 different materials");
    }
    return result == TL_OK ? TL_OK : fail_scene_memory(reader);
}

static tl_result add_scene_vertices(scene_reader *reader, const struct aiMesh *part, const tl_affine *to_root)
{
    tl_imported_mesh *mesh = reader->mesh;
    tl_affine to_world = tl_affine_multiply(&reader->to_metres, to_root);
    tl_result result = tl_imported_mesh_reserve_vertices(mesh, part->mNumVertices);
    if (result != TL_OK) {
        return fail_scene_reserve(reader, result, "vertices");
    }
    for (unsigned i = 0; i < part->mNumVertices; i++) {
        struct aiVector3D source = part->mVertices[i];
        tl_vec3 vertex = tl_affine_apply(&to_world, (double)source.x, (double)source.y, (double)source.z);
        if (!tl_is_finite(vertex)) {
            bool was_finite = tl_is_finite(tl_vec3_make(source.x, source.y, source.z));
            result = was_finite ? TL_ERR_RANGE : TL_ERR_NOT_FINITE;
            tl_io_fail(reader->error, result, reader->path, 0,
                       was_finite ? "check the scale of its nodes"
                                  : "remove the broken vertex in the tool that wrote it",
                       "vertex %u of mesh '%s' %s", i, part->mName.data,
                       was_finite ? "is placed beyond the largest float" : "is not finite");
            return tl_io_blame(reader->error, result, "vertex", mesh->vertex_count);
        }
        mesh->vertices[mesh->vertex_count++] = vertex;
    }
    return TL_OK;
}

// The fan of a face of three corners or more, wound the other way when mirrored.
static tl_result add_face_fan(scene_reader *reader, const struct aiFace *face, uint32_t first_vertex, bool mirrored,
                              uint32_t material)
{
    tl_imported_mesh *mesh = reader->mesh;
    tl_result result = tl_imported_mesh_reserve_triangles(mesh, (uint64_t)face->mNumIndices - 2);
    if (result != TL_OK) {
        return fail_scene_reserve(reader, result, "triangles");
    }
    for (unsigned k = 1; k + 1 < face->mNumIndices; k++) {
        uint32_t *indices = mesh->indices + (size_t)mesh->triangle_count * 3;
        indices[0] = first_vertex + face->mIndices[0];
        indices[1] = first_vertex + face->mIndices[mirrored ? k + 1 : k];
        indices[2] = first_vertex + face->mIndices[mirrored ? k : k + 1];
        mesh->materials[mesh->triangle_count] = (uint16_t)material;
        mesh->source_lines[mesh->triangle_count] = 0;
        mesh->triangle_count++;
    }
    mesh->face_count++;
    return TL_OK;
}

// Splits the polygon whose fan was added last.
static tl_result split_last(scene_reader *reader, const struct aiFace *face, uint32_t first_vertex, bool mirrored)
{
    tl_imported_mesh *mesh = reader->mesh;
    uint32_t count = face->mNumIndices;
    mesh->polygon_count++;
    if (count > TL_MAX_SPLIT_CORNERS) {
        mesh->crooked_count++;
        return TL_OK;
    }
    if (reader->scratch == NULL) {
        reader->scratch = tl_io_allocate(&mesh->allocator, TL_MAX_SPLIT_CORNERS * sizeof *reader->scratch);
    }
    if (reader->corners == NULL) {
        reader->corners = tl_io_allocate(&mesh->allocator, TL_MAX_SPLIT_CORNERS * sizeof *reader->corners);
    }
    if (reader->scratch == NULL || reader->corners == NULL) {
        return fail_scene_memory(reader);
    }
    for (uint32_t k = 0; k < count; k++) {
        reader->corners[k] = first_vertex + face->mIndices[mirrored && k > 0 ? count - k : k];
    }
    uint32_t *triangles = mesh->indices + (size_t)(mesh->triangle_count - (count - 2)) * 3;
    tl_split split = tl_split_polygon(mesh->vertices, reader->corners, count, reader->scratch, triangles);
    mesh->clipped_count += split == TL_SPLIT_EARS;
    mesh->crooked_count += split == TL_SPLIT_GAVE_UP;
    return TL_OK;
}

static tl_result check_face(scene_reader *reader, const struct aiMesh *part, unsigned index)
{
    const struct aiFace *face = &part->mFaces[index];
    for (unsigned k = 0; k < face->mNumIndices; k++) {
        if (face->mIndices[k] >= part->mNumVertices) {
            tl_io_fail(reader->error, TL_ERR_INDEX, reader->path, 0, "export the file again",
                       "face %u of mesh '%s' names vertex %u of %u", index, part->mName.data, face->mIndices[k],
                       part->mNumVertices);
            return tl_io_blame(reader->error, TL_ERR_INDEX, "face", reader->mesh->face_count);
        }
    }
    return TL_OK;
}

static tl_result add_scene_faces(scene_reader *reader, const struct aiMesh *part, uint32_t first_vertex, bool mirrored)
{
    uint32_t material;
    tl_result result = find_material(reader, part->mMaterialIndex, &material);
    for (unsigned i = 0; i < part->mNumFaces && result == TL_OK; i++) {
        const struct aiFace *face = &part->mFaces[i];
        reader->mesh->ignored_points += face->mNumIndices == 1;
        reader->mesh->ignored_lines += face->mNumIndices == 2;
        if (face->mNumIndices < 3) {
            continue;
        }
        result = check_face(reader, part, i);
        if (result == TL_OK) {
            result = add_face_fan(reader, face, first_vertex, mirrored, material);
        }
        if (result == TL_OK && face->mNumIndices > 3) {
            result = split_last(reader, face, first_vertex, mirrored);
        }
    }
    return result;
}

static tl_result add_scene_node(scene_reader *reader, const struct aiNode *node, const tl_affine *to_world)
{
    bool mirrored = tl_affine_mirrors(to_world);
    reader->mesh->mirrored_nodes += mirrored && node->mNumMeshes > 0;
    for (unsigned i = 0; i < node->mNumMeshes; i++) {
        if (node->mMeshes[i] >= reader->scene->mNumMeshes) {
            tl_io_fail(reader->error, TL_ERR_INDEX, reader->path, 0, "export the file again",
                       "node '%s' names mesh %u of %u", node->mName.data, node->mMeshes[i], reader->scene->mNumMeshes);
            return tl_io_blame(reader->error, TL_ERR_INDEX, "node", TL_NO_ELEMENT);
        }
        const struct aiMesh *part = reader->scene->mMeshes[node->mMeshes[i]];
        uint32_t first_vertex = reader->mesh->vertex_count;
        tl_result result = add_scene_vertices(reader, part, to_world);
        if (result == TL_OK) {
            result = add_scene_faces(reader, part, first_vertex, mirrored);
        }
        if (result != TL_OK) {
            return result;
        }
    }
    return TL_OK;
}

static bool push_scene_node(scene_reader *reader, const struct aiNode *node, const tl_affine *parent)
{
    if (!tl_io_grow(&reader->mesh->allocator, (void **)&reader->stack, &reader->stack_capacity, reader->stack_count,
                    reader->stack_count + 1, sizeof *reader->stack)) {
        return false;
    }
    reader->stack[reader->stack_count].node = node;
    reader->stack[reader->stack_count].parent = *parent;
    reader->stack_count++;
    return true;
}

// Depth first, children in their order.
static tl_result walk_nodes(scene_reader *reader)
{
    tl_affine identity = tl_affine_identity();
    if (!push_scene_node(reader, reader->scene->mRootNode, &identity)) {
        return fail_scene_memory(reader);
    }
    while (reader->stack_count > 0) {
        pending_scene_node pending = reader->stack[--reader->stack_count];
        tl_affine local = affine_of_matrix(&pending.node->mTransformation);
        tl_affine to_world = tl_affine_multiply(&pending.parent, &local);
        tl_result result = add_scene_node(reader, pending.node, &to_world);
        if (result != TL_OK) {
            return result;
        }
        for (unsigned i = pending.node->mNumChildren; i-- > 0;) {
            if (!push_scene_node(reader, pending.node->mChildren[i], &to_world)) {
                return fail_scene_memory(reader);
            }
        }
    }
    return TL_OK;
}

static tl_result read_scene(scene_reader *reader, bool allow_no_triangles)
{
    tl_imported_mesh *mesh = reader->mesh;
    uint32_t nameless;
    if (tl_name_table_add(&mesh->names, &mesh->allocator, "", 0, 1, &nameless) != TL_OK) {
        return fail_scene_memory(reader);
    }
    tl_result result = walk_nodes(reader);
    tl_io_release(&mesh->allocator, reader->stack, reader->stack_capacity * sizeof *reader->stack);
    tl_io_release(&mesh->allocator, reader->scratch, TL_MAX_SPLIT_CORNERS * sizeof *reader->scratch);
    tl_io_release(&mesh->allocator, reader->corners, TL_MAX_SPLIT_CORNERS * sizeof *reader->corners);
    if (result != TL_OK) {
        return result;
    }
    if (mesh->vertex_count == 0 || (mesh->triangle_count == 0 && !allow_no_triangles)) {
        return tl_io_fail(reader->error, TL_ERR_EMPTY, reader->path, 0, "export the level with its meshes", "%s",
                          mesh->vertex_count == 0 ? "no vertices" : "no triangles");
    }
    return TL_OK;
}

bool tl_assimp_knows(const char *extension)
{
    return aiIsExtensionSupported(extension) == AI_TRUE;
}

// --- what the file says of itself -----------------------------------------------------------------------------------

static const struct aiMetadataEntry *find_statement(const struct aiScene *scene, const char *key)
{
    for (unsigned i = 0; scene->mMetaData != NULL && i < scene->mMetaData->mNumProperties; i++) {
        if (strcmp(scene->mMetaData->mKeys[i].data, key) == 0) {
            return &scene->mMetaData->mValues[i];
        }
    }
    return NULL;
}

// An axis and its sign as 1, 2, 3 or negative; 0 when it is not there.
static int find_axis(const struct aiScene *scene, const char *key, const char *sign_key)
{
    const struct aiMetadataEntry *axis = find_statement(scene, key);
    const struct aiMetadataEntry *sign = find_statement(scene, sign_key);
    if (axis == NULL || axis->mType != AI_INT32 || sign == NULL || sign->mType != AI_INT32) {
        return 0;
    }
    int32_t number = *(const int32_t *)axis->mData;
    return number < 0 || number > 2 ? 0 : *(const int32_t *)sign->mData < 0 ? -(number + 1) : number + 1;
}

// The unit and axes of FBX, which Assimp hands on and does not apply. (It applies those of Collada, and no other kind
// has any.) Axes that make a left-handed system mirror the numbers, not what their author saw: the winding stays.
static void read_statements(const struct aiScene *scene, tl_imported_mesh *mesh, tl_affine *to_metres)
{
    int axes[3] = { find_axis(scene, "CoordAxis", "CoordAxisSign"), find_axis(scene, "UpAxis", "UpAxisSign"),
                    find_axis(scene, "FrontAxis", "FrontAxisSign") };
    unsigned named = 0;
    for (int i = 0; i < 3; i++) {
        named |= 1u << (axes[i] < 0 ? -axes[i] : axes[i]);
    }
    if (named == (1u << 1 | 1u << 2 | 1u << 3)) {
        for (int i = 0; i < 3; i++) {
            memset(to_metres->row[i], 0, sizeof to_metres->row[i]);
            to_metres->row[i][(axes[i] < 0 ? -axes[i] : axes[i]) - 1] = axes[i] < 0 ? -1.0 : 1.0;
        }
        mesh->file_up = axes[1];
    }
    const struct aiMetadataEntry *unit = find_statement(scene, "UnitScaleFactor");
    double centimetres = unit == NULL               ? 0.0
                         : unit->mType == AI_FLOAT  ? (double)*(const float *)unit->mData
                         : unit->mType == AI_DOUBLE ? *(const double *)unit->mData
                                                    : 0.0;
    if (centimetres > 0.0 && isfinite(centimetres)) {
        for (int i = 0; i < 3; i++) {
            for (int k = 0; k < 4; k++) {
                to_metres->row[i][k] *= centimetres / 100.0;
            }
        }
        mesh->file_unit = (float)(centimetres / 100.0);
    }
}

// A glTF file that passes for another kind comes here, past what gltf_reader.c refuses.
static bool is_gltf_scene(const struct aiScene *scene)
{
    const struct aiMetadataEntry *format = find_statement(scene, AI_METADATA_SOURCE_FORMAT);
    return format != NULL && format->mType == AI_AISTRING &&
           strncmp(((const struct aiString *)format->mData)->data, "glTF", 4) == 0;
}

// What Assimp made of it, or why nothing.
static tl_result check_scene(const tl_assimp_files *files, const struct aiScene *scene, tl_io_error *error)
{
    const char *name = files->source->name;
    if (files->refused.result != TL_OK) {
        if (error != NULL) {
            *error = files->refused;
        }
        return files->refused.result;
    }
    if (scene == NULL || scene->mRootNode == NULL) {
        const char *reason = aiGetErrorString();
        if (reason != NULL && strstr(reason, "bad_alloc") != NULL) {
            return tl_io_fail(error, TL_ERR_MEMORY, name, 0, NULL, "out of memory");
        }
        return tl_io_fail(error, TL_ERR_FORMAT, name, 0, "open it in a modelling tool and export it again", "%s",
                          reason != NULL && reason[0] != '\0' ? reason : "not readable");
    }
    if (is_gltf_scene(scene)) {
        return tl_io_fail(error, TL_ERR_UNSUPPORTED, name, 0, "name it .gltf or .glb", "a glTF file of another name");
    }
    return TL_OK;
}

tl_result tl_assimp_read(const tl_mesh_source *source, const tl_allocator *allocator, tl_imported_mesh *mesh_out,
                         tl_io_error *error_out)
{
    memset(mesh_out, 0, sizeof *mesh_out);
    tl_assimp_files files;
    tl_assimp_files_init(&files, source);
    const struct aiScene *scene = aiImportFileEx(files.name, 0, &files.io);
    tl_result result = check_scene(&files, scene, error_out);
    if (result == TL_OK) {
        tl_imported_mesh_init(mesh_out, allocator);
        mesh_out->format = "Assimp";
        mesh_out->source_bytes = source->size;
        scene_reader reader = {
            scene, mesh_out, source->name, error_out, NULL, 0, 0, tl_affine_identity(), NULL, NULL
        };
        read_statements(scene, mesh_out, &reader.to_metres);
        result = read_scene(&reader, source->allow_no_triangles);
        if (result != TL_OK) {
            tl_imported_mesh_free(mesh_out);
        }
    }
    aiReleaseImport(scene);
    return result;
}
