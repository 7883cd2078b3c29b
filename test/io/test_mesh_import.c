// SPDX-License-Identifier: MIT
//
// Mesh files of every kind through one call: small files written here, real ones against Assimp's own OBJ reader.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/files/atomic_write.h"
#include "io/files/file_map.h"
#include "io/mesh/assimp_reader.h"
#include "io/mesh/mesh_import.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static char folder[64];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/talus_import_XXXXXX");
    return mkdtemp(folder) != NULL ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder); // fails when a test left a file behind
}

// Writes the file, imports it, removes it.
static tl_result import_bytes(const char *name, const void *bytes, size_t size, const tl_import_options *options,
                              tl_imported_mesh *mesh, tl_io_error *error)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    TEST_CHECK(file != NULL && fwrite(bytes, 1, size, file) == size && fclose(file) == 0);
    memset(error, 0, sizeof *error);
    tl_result result = tl_import_mesh(path, options, mesh, error);
    unlink(path);
    if (result == TL_OK) {
        for (uint32_t i = 0; i < mesh->triangle_count * 3; i++) {
            TEST_CHECK(mesh->indices[i] < mesh->vertex_count);
        }
        for (uint32_t i = 0; i < mesh->vertex_count; i++) {
            TEST_CHECK(tl_is_finite(mesh->vertices[i]));
        }
        TEST_CHECK(mesh->source_bytes == size);
    } else {
        TEST_CHECK(error->result == result && error->message[0] != '\0' && mesh->vertices == NULL);
        TEST_CHECK(strcmp(error->path, path) == 0);
    }
    return result;
}

static tl_imported_mesh import_good(const char *name, const void *bytes, size_t size, const tl_import_options *options)
{
    tl_imported_mesh mesh;
    tl_io_error error;
    if (import_bytes(name, bytes, size, options, &mesh, &error) != TL_OK) {
        char words[1024];
        tl_io_error_format(&error, words, sizeof words);
        fail_msg("%s", words);
    }
    return mesh;
}

static void check_corner(const tl_imported_mesh *mesh, uint32_t corner, float x, float y, float z)
{
    tl_vec3 p = mesh->vertices[mesh->indices[corner]];
    if (p.x != x || p.y != y || p.z != z) {
        fail_msg("corner %u is %g %g %g, not %g %g %g", corner, (double)p.x, (double)p.y, (double)p.z, (double)x,
                 (double)y, (double)z);
    }
}

// The right triangle (0,0,0) (1,0,0) (0,2,0) in whatever order of corners that begins anywhere.
static void check_triangle(const tl_imported_mesh *mesh)
{
    TEST_CHECK(mesh->triangle_count == 1);
    uint32_t first = 0;
    while (first < 2 && tl_length_sq(mesh->vertices[mesh->indices[first]]) > 0.0f) {
        first++;
    }
    check_corner(mesh, first, 0, 0, 0);
    check_corner(mesh, (first + 1) % 3, 1, 0, 0);
    check_corner(mesh, (first + 2) % 3, 0, 2, 0);
}

#define OBJ_TEXT "v 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n"
#define PLY_TEXT                                                                                                       \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"                  \
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 2 0\n3 0 1 2\n"
#define PLY_STRIPS                                                                                                     \
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"                  \
    "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 2 0\n1 2 0\n4 0 1 2 3\n"
#define STL_TEXT                                                                                                       \
    "solid level\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 2 0\nendloop\nendfacet\n"       \
    "endsolid level\n"

// Header, 12 floats and a 16-bit attribute a triangle, little-endian.
static size_t make_binary_stl(unsigned char bytes[134])
{
    static const float numbers[12] = { 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0 };
    memset(bytes, 0, 134);
    memcpy(bytes, "binary", 6);
    bytes[80] = 1;
    memcpy(bytes + 84, numbers, sizeof numbers);
    return 134;
}

static void test_kinds(void **state)
{
    (void)state;
    unsigned char stl[134];
    size_t stl_size = make_binary_stl(stl);
    tl_imported_mesh mesh = import_good("a.obj", OBJ_TEXT, sizeof OBJ_TEXT - 1, NULL);
    assert_string_equal(mesh.format, "OBJ");
    check_triangle(&mesh);
    tl_imported_mesh_free(&mesh);
    static const char *const ply_names[] = { "a.ply", "A.PLY", "level", "level.", "level.abc", "level.obj" };
    for (size_t i = 0; i < 6; i++) {
        mesh = import_good(ply_names[i], PLY_TEXT, sizeof PLY_TEXT - 1, NULL);
        assert_string_equal(mesh.format, "Assimp");
        check_triangle(&mesh);
        tl_imported_mesh_free(&mesh);
    }
    static const char *const stl_names[] = { "a.stl", "a.STL", "level", "level.obj" };
    for (size_t i = 0; i < 4; i++) {
        mesh = import_good(stl_names[i], STL_TEXT, sizeof STL_TEXT - 1, NULL);
        check_triangle(&mesh);
        tl_imported_mesh_free(&mesh);
        mesh = import_good(stl_names[i], stl, stl_size, NULL);
        check_triangle(&mesh);
        tl_imported_mesh_free(&mesh);
    }
    static const char *const obj_names[] = { "a.OBJ", "level", "level.txt", ".obj" };
    for (size_t i = 0; i < 4; i++) {
        mesh = import_good(obj_names[i], "# x\n\n" OBJ_TEXT, sizeof OBJ_TEXT + 4, NULL);
        assert_string_equal(mesh.format, "OBJ");
        check_triangle(&mesh);
        tl_imported_mesh_free(&mesh);
    }
}

static void test_standard_input(void **state)
{
    (void)state;
    char path[128];
    snprintf(path, sizeof path, "%s/in", folder);
    static const char *const texts[] = { OBJ_TEXT, PLY_TEXT };
    for (int i = 0; i < 2; i++) {
        TEST_RESULT(tl_atomic_write(path, texts[i], strlen(texts[i]), NULL), TL_OK);
        int kept = dup(STDIN_FILENO);
        int file = open(path, O_RDONLY);
        TEST_CHECK(file >= 0 && dup2(file, STDIN_FILENO) >= 0);
        close(file);
        tl_imported_mesh mesh;
        tl_result result = tl_import_mesh("-", NULL, &mesh, NULL);
        dup2(kept, STDIN_FILENO);
        close(kept);
        TEST_RESULT(result, TL_OK);
        check_triangle(&mesh);
        tl_imported_mesh_free(&mesh);
    }
    unlink(path);
}

// One triangle (0,0,0) (1,0,0) (0,2,0) and a segment, shown by nodes: as it is, moved and turned below a scaled parent,
// mirrored. The buffer: 3 positions, then indices 0 1 2.
#define GLTF_HEAD                                                                                                      \
    "{\"asset\":{\"version\":\"2.0\"},\"buffers\":[{\"byteLength\":42,\"uri\":\"data:application/octet-stream;base64," \
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAAAAABAAIA\"}],"                                                    \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6}],"            \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"           \
    "\"max\":[1,2,0]},{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"}],"                     \
    "\"materials\":[{\"name\":\"stone\"}],"
#define GLTF_MESH "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]}],"

static void test_gltf_nodes(void **state)
{
    (void)state;
    static const char text[] =
        GLTF_HEAD GLTF_MESH "\"scene\":0,\"scenes\":[{\"nodes\":[0,1,3]}],\"nodes\":[{\"mesh\":0},"
                            "{\"children\":[2],\"scale\":[2,2,2]},"
                            "{\"mesh\":0,\"translation\":[10,20,30],\"rotation\":[0,0,0.70710678,0.70710678]},"
                            "{\"mesh\":0,\"scale\":[-1,1,1]}]}";
    tl_imported_mesh mesh = import_good("a.gltf", text, sizeof text - 1, NULL);
    TEST_CHECK(mesh.triangle_count == 3 && mesh.mirrored_nodes == 1);
    check_corner(&mesh, 0, 0, 0, 0);
    check_corner(&mesh, 1, 1, 0, 0);
    check_corner(&mesh, 2, 0, 2, 0);
    // A quarter turn about z: x to y, y to -x; then moved, then doubled. The quaternion is rounded.
    tl_vec3 expected[3] = { { 20, 40, 60 }, { 20, 42, 60 }, { 16, 40, 60 } };
    for (uint32_t i = 0; i < 3; i++) {
        TEST_CHECK(tl_distance(mesh.vertices[mesh.indices[3 + i]], expected[i]) < 1e-5f);
    }
    // Mirrored and re-wound: still seen from +z.
    check_corner(&mesh, 6, 0, 0, 0);
    check_corner(&mesh, 7, 0, 2, 0);
    check_corner(&mesh, 8, -1, 0, 0);
    for (uint32_t i = 0; i < 3; i++) {
        tl_vec3 a = mesh.vertices[mesh.indices[i * 3]];
        tl_vec3 b = mesh.vertices[mesh.indices[i * 3 + 1]];
        tl_vec3 c = mesh.vertices[mesh.indices[i * 3 + 2]];
        TEST_CHECK(tl_cross(tl_sub(b, a), tl_sub(c, a)).z > 0.0f);
        TEST_CHECK(mesh.materials[i] == 1);
    }
    assert_string_equal(tl_name_table_get(&mesh.names, 1), "stone");
    tl_imported_mesh_free(&mesh);
}

static void test_points_and_lines(void **state)
{
    (void)state;
    static const char text[] =
        GLTF_HEAD "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1},"
                  "{\"attributes\":{\"POSITION\":0},\"mode\":0},{\"attributes\":{\"POSITION\":0},\"mode\":3}]}],"
                  "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]}";
    tl_imported_mesh mesh = import_good("a.gltf", text, sizeof text - 1, NULL);
    TEST_CHECK(mesh.triangle_count == 1 && mesh.ignored_points == 3 && mesh.ignored_lines == 2);
    tl_imported_mesh_free(&mesh);
}

static void test_options(void **state)
{
    (void)state;
    tl_import_options options = tl_default_import_options();
    static const char text[] = "v 1 2 3\nv 1 0 0\nv 0 2 0\nf 1 2 3\n";
    options.up_axis = TL_UP_Z;
    options.unit_scale = 0.5f;
    tl_imported_mesh mesh = import_good("a.obj", text, sizeof text - 1, &options);
    check_corner(&mesh, 0, 0.5f, 1.5f, -1.0f);
    check_corner(&mesh, 1, 0.5f, 0, 0);
    TEST_CHECK(!signbit(mesh.vertices[1].z));
    // A rotation: the triangle's normal turns with it.
    tl_vec3 e = tl_sub(mesh.vertices[1], mesh.vertices[0]);
    tl_vec3 f = tl_sub(mesh.vertices[2], mesh.vertices[0]);
    tl_vec3 normal = tl_cross(e, f);
    tl_vec3 before = tl_cross(tl_vec3_make(0, -2, -3), tl_vec3_make(-1, 0, -3));
    TEST_CHECK(normal.x == before.x / 4 && normal.y == before.z / 4 && normal.z == -before.y / 4);
    tl_imported_mesh_free(&mesh);

    tl_io_error error;
    static const float bad_scales[] = { 0.0f, -1.0f, INFINITY, NAN };
    for (int i = 0; i < 4; i++) {
        options.unit_scale = bad_scales[i];
        TEST_RESULT(import_bytes("a.obj", text, sizeof text - 1, &options, &mesh, &error), TL_ERR_ARGUMENT);
    }
    options.unit_scale = 1e38f;
    static const char large[] = "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n";
    TEST_RESULT(import_bytes("a.obj", large, sizeof large - 1, &options, &mesh, &error), TL_ERR_RANGE);
    TEST_CHECK(error.element_index == 1);
    options = tl_default_import_options();
    options.up_axis = (tl_up_axis)7;
    TEST_RESULT(import_bytes("a.obj", text, sizeof text - 1, &options, &mesh, &error), TL_ERR_ARGUMENT);
    options = tl_default_import_options();
    options.max_file_bytes = sizeof text - 2;
    TEST_RESULT(import_bytes("a.obj", text, sizeof text - 1, &options, &mesh, &error), TL_ERR_LIMIT);
}

typedef struct bad_file {
    const char *name;
    const char *text;
    tl_result result;
} bad_file;

static void test_bad_files(void **state)
{
    (void)state;
    static const bad_file files[] = {
        { "a.obj", "", TL_ERR_EMPTY },
        { "a.gltf", "", TL_ERR_EMPTY },
        { "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", TL_ERR_EMPTY },
        { "a.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", TL_ERR_NOT_FINITE },
        { "a.obj", "v 0 0 0\nf 1 2 3\n", TL_ERR_INDEX },
        { "a.obj", "{\"asset\":{\"version\":\"2.0\"}}", TL_ERR_EMPTY },
        { "a.gltf", "{\"asset\":", TL_ERR_FORMAT },
        { "a.gltf", "not json", TL_ERR_FORMAT },
        { "a.glb", "glTF\2\0\0\0", TL_ERR_FORMAT },
        { "a.fbx", "Kaydara FBX Binary  and no more", TL_ERR_FORMAT },
        { "a.ply", "ply\nformat ascii 1.0\n", TL_ERR_FORMAT },
        { "a.ply", PLY_STRIPS, TL_ERR_UNSUPPORTED },
        { "a.dae", "<COLLADA>", TL_ERR_FORMAT },
        { "a.stl", "nothing of the kind", TL_ERR_FORMAT },
        { "level", "hello world", TL_ERR_UNSUPPORTED },
        { "level.png", "\x89PNG\r\n\x1a\n", TL_ERR_UNSUPPORTED },
        { "level.txt", "1 2 3\n", TL_ERR_UNSUPPORTED },
    };
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        tl_imported_mesh mesh;
        tl_io_error error;
        tl_result result = import_bytes(files[i].name, files[i].text, strlen(files[i].text), NULL, &mesh, &error);
        if (result != files[i].result && !(files[i].result == TL_ERR_EMPTY && result == TL_ERR_FORMAT && i == 5)) {
            fail_msg("file %zu (%s): %s: %s", i, files[i].name, tl_result_name(result), error.message);
        }
    }
    tl_imported_mesh mesh;
    tl_io_error error;
    TEST_RESULT(tl_import_mesh("/missing/level.obj", NULL, &mesh, &error), TL_ERR_IO);
    TEST_RESULT(tl_import_mesh("/missing/level.gltf", NULL, &mesh, &error), TL_ERR_IO);
    TEST_RESULT(tl_import_mesh(folder, NULL, &mesh, &error), TL_ERR_IO);
    TEST_CHECK(strcmp(error.path, folder) == 0);
}

// A binary STL whose coordinates are not finite or whose count is a lie.
static void test_hostile_stl(void **state)
{
    (void)state;
    unsigned char stl[134];
    size_t size = make_binary_stl(stl);
    tl_imported_mesh mesh;
    tl_io_error error;
    static const float nan = NAN;
    memcpy(stl + 96, &nan, sizeof nan);
    TEST_RESULT(import_bytes("a.stl", stl, size, NULL, &mesh, &error), TL_ERR_NOT_FINITE);
    make_binary_stl(stl);
    memset(stl + 80, 0xff, 4);
    TEST_RESULT(import_bytes("a.stl", stl, size, NULL, &mesh, &error), TL_ERR_FORMAT);
}

// Every truncation of small files ends well or with a name.
static void test_every_prefix(void **state)
{
    (void)state;
    static const char gltf[] = GLTF_HEAD GLTF_MESH "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]}";
    const char *texts[] = { OBJ_TEXT, PLY_TEXT, gltf };
    static const char *const names[] = { "a.obj", "a.ply", "a.gltf" };
    uint32_t failed = 0;
    uint32_t good = 0;
    for (int i = 0; i < 3; i++) {
        for (size_t size = 0; size <= strlen(texts[i]); size++) {
            tl_imported_mesh mesh;
            tl_io_error error;
            if (import_bytes(names[i], texts[i], size, NULL, &mesh, &error) == TL_OK) {
                good++;
                tl_imported_mesh_free(&mesh);
            } else {
                failed++;
            }
        }
    }
    TEST_CHECK(good >= 3 && failed > 500);
}

static void test_every_allocation(void **state)
{
    (void)state;
    static const char gltf[] = GLTF_HEAD GLTF_MESH "\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}]}";
    uint64_t calls = 0;
    for (uint64_t fail_at = 0; fail_at <= calls; fail_at++) {
        test_allocator allocator;
        test_allocator_init(&allocator, fail_at);
        tl_import_options options = tl_default_import_options();
        options.host.allocator = &allocator.allocator;
        tl_imported_mesh mesh;
        tl_io_error error;
        tl_result result = import_bytes("a.gltf", gltf, sizeof gltf - 1, &options, &mesh, &error);
        TEST_RESULT(result, fail_at == 0 ? TL_OK : TL_ERR_MEMORY);
        calls = fail_at == 0 ? allocator.calls : calls;
        tl_imported_mesh_free(&mesh);
        TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
    }
    TEST_CHECK(calls > 5);
}

// Our reader and Assimp's, corner by corner and bit by bit. Assimp rounds its numbers through a double with a tabled
// fraction, so it may be the last bit off: those are counted, and strtof has the last word elsewhere
// (test_obj_reader.c).
static void check_against_assimp(const char *path, uint64_t *corners, uint64_t *different)
{
    if (access(path, R_OK) != 0) {
        return;
    }
    tl_imported_mesh ours;
    tl_imported_mesh theirs;
    TEST_RESULT(tl_import_mesh(path, NULL, &ours, NULL), TL_OK);
    tl_file_map map;
    TEST_RESULT(tl_file_map_open(path, 0, &map, NULL), TL_OK);
    tl_mesh_source source = { path, path, map.bytes, map.size, "obj", false, { 0.0 } };
    TEST_RESULT(tl_assimp_read(&source, NULL, &theirs, NULL), TL_OK);
    tl_file_map_close(&map);
    TEST_CHECK(ours.triangle_count == theirs.triangle_count);
    for (uint32_t i = 0; i < ours.triangle_count * 3; i++) {
        tl_vec3 a = ours.vertices[ours.indices[i]];
        tl_vec3 b = theirs.vertices[theirs.indices[i]];
        *corners += 1;
        if (a.x == b.x && a.y == b.y && a.z == b.z) {
            continue;
        }
        *different += 1;
        tl_vec3 size = tl_max(tl_abs(a), tl_abs(b));
        tl_vec3 gap = tl_abs(tl_sub(a, b));
        const float ulp = 1.2e-7f; // one unit in the last place, at most 2^-23 of the value
        TEST_CHECK(gap.x <= size.x * ulp && gap.y <= size.y * ulp && gap.z <= size.z * ulp);
    }
    tl_imported_mesh_free(&ours);
    tl_imported_mesh_free(&theirs);
}

static void test_real_files(void **state)
{
    (void)state;
    static const char *const names[] = {
        "levels/nav_test",   "levels/dungeon",           "levels/undulating", "levels/proto-level",
        "levels/test_map01", "levels/collision_mesh_01", "models/cow",        "models/fandisk",
        "models/rocker-arm", "models/suzanne",           "models/teapot",     "models/stanford-bunny",
    };
    uint64_t corners = 0;
    uint64_t different = 0;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s.obj", TALUS_DATA_DIR, names[i]);
        check_against_assimp(path, &corners, &different);
    }
    print_message("%llu corners, %llu of them not bit-equal to Assimp's\n", (unsigned long long)corners,
                  (unsigned long long)different);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_standard_input),
        cmocka_unit_test(test_gltf_nodes),
        cmocka_unit_test(test_points_and_lines),
        cmocka_unit_test(test_options),
        cmocka_unit_test(test_bad_files),
        cmocka_unit_test(test_hostile_stl),
        cmocka_unit_test(test_every_prefix),
        cmocka_unit_test(test_every_allocation),
        cmocka_unit_test(test_real_files),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
