// SPDX-License-Identifier: MIT
//
// Which reader a mesh file is for; then its axes and its unit.

#include "io/mesh/mesh_import.h"

#include "io/files/file_map.h"
#include "io/mesh/assimp_reader.h"
#include "io/mesh/gltf_reader.h"
#include "io/mesh/import_process.h"
#include "io/mesh/obj_reader.h"

#include <string.h>

enum {
    EXTENSION_BYTES = 16,
    SNIFF_BYTES = 4096,
    STL_HEAD_BYTES = 84,
    STL_TRIANGLE_BYTES = 50,
    LONGEST_PLY_HEADER = 1 << 20
};

static const char known_kinds[] = "OBJ, glTF, GLB, FBX, STL, PLY and DAE are known";

tl_import_options tl_default_import_options(void)
{
    tl_import_options options;
    memset(&options, 0, sizeof options);
    options.unit_scale = 1.0f;
    return options;
}

// The extension with its point in lower case, or "".
static void find_extension(const char *path, char extension[EXTENSION_BYTES])
{
    const char *slash = strrchr(path, '/');
    const char *point = strrchr(slash != NULL ? slash : path, '.');
    extension[0] = '\0';
    if (point == NULL || strlen(point) >= EXTENSION_BYTES) {
        return;
    }
    size_t i = 0;
    for (; point[i] != '\0'; i++) {
        extension[i] = point[i] >= 'A' && point[i] <= 'Z' ? (char)(point[i] - 'A' + 'a') : point[i];
    }
    extension[i] = '\0';
}

static bool begins_with(const char *bytes, size_t size, const char *text)
{
    size_t length = strlen(text);
    return size >= length && memcmp(bytes, text, length) == 0;
}

// Where a text begins; `size` when it is not there.
static size_t find_in_bytes(const char *bytes, size_t size, const char *text)
{
    size_t length = strlen(text);
    for (size_t i = 0; i + length <= size; i++) {
        if (memcmp(bytes + i, text, length) == 0) {
            return i;
        }
    }
    return size;
}

static bool contains(const char *bytes, size_t size, const char *text)
{
    return find_in_bytes(bytes, size, text) < size;
}

// A binary STL file says nothing but its triangle count.
static bool is_binary_stl(const unsigned char *bytes, size_t size)
{
    if (size < STL_HEAD_BYTES) {
        return false;
    }
    const unsigned char *c = bytes + STL_HEAD_BYTES - 4;
    uint64_t count = (uint64_t)c[0] | (uint64_t)c[1] << 8 | (uint64_t)c[2] << 16 | (uint64_t)c[3] << 24;
    return count > 0 && size == STL_HEAD_BYTES + count * STL_TRIANGLE_BYTES;
}

// What the leading bytes say by a mark that OBJ text cannot have: an extension that Assimp knows, or NULL.
static const char *sniff_other(const char *bytes, size_t size)
{
    size_t head = size < SNIFF_BYTES ? size : SNIFF_BYTES;
    size_t blanks = 0;
    while (blanks < head &&
           (bytes[blanks] == ' ' || bytes[blanks] == '\t' || bytes[blanks] == '\r' || bytes[blanks] == '\n')) {
        blanks++;
    }
    if (begins_with(bytes, size, "glTF")) {
        return "glb";
    }
    if (begins_with(bytes, size, "Kaydara FBX Binary") || begins_with(bytes, size, "; FBX")) {
        return "fbx";
    }
    if (begins_with(bytes, size, "ply\n") || begins_with(bytes, size, "ply\r")) {
        return "ply";
    }
    if (blanks < head && bytes[blanks] == '{' && contains(bytes, head, "\"asset\"")) {
        return "gltf";
    }
    if (blanks < head && bytes[blanks] == '<' && contains(bytes, head, "<COLLADA")) {
        return "dae";
    }
    if (is_binary_stl((const unsigned char *)bytes, size) ||
        (begins_with(bytes, size, "solid") && contains(bytes, head, "facet"))) {
        return "stl";
    }
    return NULL;
}

// Whether the first line that is not empty or a comment begins as OBJ lines do.
static bool sniff_obj(const char *bytes, size_t size)
{
    static const char *const keywords[] = { "v ",  "v\t", "vn ", "vt ",     "o ",      "g ",
                                            "g\n", "s ",  "f ",  "mtllib ", "usemtl ", "\xef\xbb\xbf" };
    size_t at = 0;
    while (at < size) {
        while (at < size && (bytes[at] == ' ' || bytes[at] == '\t' || bytes[at] == '\r' || bytes[at] == '\n')) {
            at++;
        }
        if (at < size && bytes[at] == '#') {
            while (at < size && bytes[at] != '\n' && bytes[at] != '\r') {
                at++;
            }
            continue;
        }
        for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++) {
            if (begins_with(bytes + at, size - at, keywords[i])) {
                return true;
            }
        }
        return false;
    }
    return false;
}

// Assimp 5 looks for the end of a PLY header beyond the end of the file, until its time is over; and of triangle strips
// it reads the first triangle and leaves out the others. A header is short text; comments may make it longer, but not
// without end.
static tl_result check_ply(const char *bytes, size_t size, const char *name, tl_io_error *error)
{
    if (!begins_with(bytes, size, "ply")) {
        return TL_OK;
    }
    size_t most = size < LONGEST_PLY_HEADER ? size : LONGEST_PLY_HEADER;
    size_t head = find_in_bytes(bytes, most, "end_header");
    if (!contains(bytes + head, most - head, "end_header\n") && !contains(bytes + head, most - head, "end_header\r")) {
        return tl_io_fail(error, TL_ERR_FORMAT, name, 0, "the file is cut short", "a PLY file without an end_header");
    }
    if (contains(bytes, head, "element tristrips")) {
        return tl_io_fail(error, TL_ERR_UNSUPPORTED, name, 0, "export it with faces (element face)",
                          "a PLY file of triangle strips");
    }
    return TL_OK;
}

bool tl_import_is_mesh_name(const char *path)
{
    char extension[EXTENSION_BYTES];
    find_extension(path, extension);
    return strcmp(extension, ".obj") == 0 || (extension[0] != '\0' && tl_assimp_knows(extension));
}

static bool is_gltf_kind(const char *kind)
{
    return strcmp(kind, "gltf") == 0 || strcmp(kind, "glb") == 0;
}

static tl_result read_mesh_bytes(const void *bytes, size_t size, const char *path, const tl_import_options *options,
                                 tl_imported_mesh *mesh, tl_io_error *error)
{
    const tl_host *host = &options->host;
    bool allow = options->allow_no_triangles;
    bool stream = strcmp(path, "-") == 0;
    const char *name = stream ? "standard input" : path;
    char extension[EXTENSION_BYTES];
    find_extension(path, extension);
    if (size == 0) {
        return tl_io_fail(error, TL_ERR_EMPTY, name, 0, "export the level again", "the file is empty");
    }
    const char *other = sniff_other(bytes, size);
    bool named_obj = strcmp(extension, ".obj") == 0;
    tl_result result = check_ply(bytes, size, name, error);
    if (result != TL_OK) {
        return result;
    }
    const double *o = options->origin;
    const tl_obj_source obj = { bytes, size, name, allow, { o[0], o[1], o[2] } };
    if (named_obj && other == NULL) {
        return tl_obj_read_source(&obj, host, mesh, error);
    }
    const char *kind = !named_obj && !stream && tl_import_is_mesh_name(path) ? extension + 1 : other;
    if (kind != NULL) {
        const tl_mesh_source source = { name, stream ? NULL : path, bytes, size, kind, allow, { o[0], o[1], o[2] } };
        bool gltf = is_gltf_kind(kind) || (other != NULL && is_gltf_kind(other));
        result = tl_read_isolated(gltf ? tl_gltf_read : tl_assimp_read, &source, &options->limits, host, mesh, error);
        mesh->format = gltf ? "glTF" : "Assimp";
        if (gltf) {
            memcpy(mesh->origin, o, sizeof mesh->origin); // its nodes' places are doubles, from which it was subtracted
        }
        return result;
    }
    if (sniff_obj(bytes, size)) {
        return tl_obj_read_source(&obj, host, mesh, error);
    }
    return tl_io_fail(error, TL_ERR_UNSUPPORTED, name, 0, known_kinds, "neither its name nor its content is a mesh's");
}

tl_result tl_import_place_vertices(const tl_import_options *options, const char *path, tl_vec3 *vertices,
                                   uint32_t count, tl_io_error *error_out)
{
    float scale = options->unit_scale;
    if (options->up_axis == TL_UP_Y && scale == 1.0f) {
        return TL_OK;
    }
    for (uint32_t i = 0; i < count; i++) {
        tl_vec3 vertex = vertices[i];
        if (options->up_axis == TL_UP_Z) {
            vertex = tl_vec3_make(vertex.x, vertex.z, 0.0f - vertex.y); // no -0 from a 0
        } else if (options->up_axis == TL_UP_Y_LEFT) {
            vertex.z = 0.0f - vertex.z;
        } else if (options->up_axis == TL_UP_Z_LEFT) {
            vertex = tl_vec3_make(vertex.x, vertex.z, vertex.y);
        }
        vertex = tl_scale(vertex, scale);
        if (!tl_is_finite(vertex)) {
            tl_io_fail(error_out, TL_ERR_RANGE, path, 0, "check the unit scale",
                       "vertex %u times the unit scale is beyond the largest float", (unsigned)i);
            return tl_io_blame(error_out, TL_ERR_RANGE, "vertex", i);
        }
        vertices[i] = vertex;
    }
    return TL_OK;
}

tl_result tl_import_options_check(const tl_import_options *options, const char *path, tl_io_error *error_out)
{
    if (!(options->unit_scale > 0.0f && isfinite(options->unit_scale))) {
        return tl_io_fail(error_out, TL_ERR_ARGUMENT, path, 0, "give metres a file unit, such as 0.01 for centimetres",
                          "the unit scale is not a positive number");
    }
    if ((unsigned)options->up_axis > TL_UP_Z_LEFT) {
        return tl_io_fail(error_out, TL_ERR_ARGUMENT, path, 0, "y, z, y-left or z-left", "the up axis is not known");
    }
    return TL_OK;
}

// What the reader has not subtracted itself.
static void subtract_file_origin(const double origin[3], tl_imported_mesh *mesh)
{
    if (memcmp(mesh->origin, origin, sizeof mesh->origin) == 0) {
        return;
    }
    memcpy(mesh->origin, origin, sizeof mesh->origin);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        tl_vec3 *v = &mesh->vertices[i];
        *v = tl_vec3_make((float)((double)v->x - origin[0]), (float)((double)v->y - origin[1]),
                          (float)((double)v->z - origin[2]));
    }
}

// The middle of each axis on which some coordinate lies beyond 2^14 units, where a float steps by a millimetre of a
// metre, in whole units, so that it can be written down. False: the level is near enough as it is.
static bool choose_origin(const tl_imported_mesh *mesh, double origin[3])
{
    const float far_out = 16384.0f;
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        bounds = tl_aabb_add_point(bounds, mesh->vertices[i]);
    }
    const float low[3] = { bounds.min.x, bounds.min.y, bounds.min.z };
    const float high[3] = { bounds.max.x, bounds.max.y, bounds.max.z };
    bool any = false;
    for (int axis = 0; axis < 3; axis++) {
        const bool is_far = mesh->vertex_count > 0 && fmaxf(-low[axis], high[axis]) > far_out;
        origin[axis] = is_far ? round(0.5 * ((double)low[axis] + (double)high[axis])) : 0.0;
        any = any || origin[axis] != 0.0;
    }
    return any;
}

// Reads the file, and with auto_origin a second time when it lies far out.
static tl_result read_mesh_at_origin(const void *bytes, size_t size, const char *path, const tl_import_options *options,
                                     tl_imported_mesh *mesh, tl_io_error *error)
{
    tl_import_options used = *options;
    if (used.auto_origin) {
        memset(used.origin, 0, sizeof used.origin);
    }
    tl_result result = read_mesh_bytes(bytes, size, path, &used, mesh, error);
    if (result == TL_OK && used.auto_origin && choose_origin(mesh, used.origin)) {
        tl_imported_mesh_free(mesh);
        result = read_mesh_bytes(bytes, size, path, &used, mesh, error);
    }
    if (result == TL_OK) {
        subtract_file_origin(used.origin, mesh);
    }
    return result;
}

tl_result tl_import_mesh_bytes(const void *bytes, size_t size, const char *path, const tl_import_options *options,
                               tl_imported_mesh *mesh_out, tl_io_error *error_out)
{
    tl_import_options used = options != NULL ? *options : tl_default_import_options();
    memset(mesh_out, 0, sizeof *mesh_out);
    tl_result result = tl_import_options_check(&used, path, error_out);
    if (result == TL_OK) {
        result = read_mesh_at_origin(bytes, size, path, &used, mesh_out, error_out);
    }
    if (result == TL_OK) {
        result = tl_import_place_vertices(&used, path, mesh_out->vertices, mesh_out->vertex_count, error_out);
    }
    if (result == TL_OK && used.up_axis >= TL_UP_Y_LEFT) {
        for (uint32_t i = 0; i < mesh_out->triangle_count; i++) {
            uint32_t *corner = mesh_out->indices + (size_t)i * 3;
            const uint32_t second = corner[1];
            corner[1] = corner[2];
            corner[2] = second;
        }
    }
    if (result != TL_OK) {
        tl_imported_mesh_free(mesh_out);
    }
    return result;
}

tl_result tl_import_mesh(const char *path, const tl_import_options *options, tl_imported_mesh *mesh_out,
                         tl_io_error *error_out)
{
    memset(mesh_out, 0, sizeof *mesh_out);
    tl_file_map map;
    tl_result result = tl_file_read(path, options != NULL ? options->max_file_bytes : 0, &map, error_out);
    if (result == TL_OK) {
        result = tl_import_mesh_bytes(map.bytes, map.size, path, options, mesh_out, error_out);
        tl_file_map_close(&map);
    }
    return result;
}
