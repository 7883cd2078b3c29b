// SPDX-License-Identifier: MIT
//
// glTF in every form that stores positions and triangles, and in forms that are refused: one quad, (0,0,0) to (1,2,0),
// seen from +z, stored in each of them.

#define _GNU_SOURCE

#include "talus_test.h"

#include "io/files/atomic_write.h"
#include "io/mesh/gltf_reader.h"
#include "io/mesh/mesh_import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

// Quotes are apostrophes here.
#define HEAD                                                                                                           \
    "{'asset':{'version':'2.0'},'buffers':[{'byteLength':300},{'byteLength':1000,'extensions':{"                       \
    "'EXT_meshopt_compression':{'fallback':true}}}],'materials':[{'name':'st\\u00fcck'}],'bufferViews':["              \
    "{'buffer':0,'byteLength':48},{'buffer':0,'byteOffset':48,'byteLength':12},"                                       \
    "{'buffer':0,'byteOffset':60,'byteLength':8},{'buffer':0,'byteOffset':68,'byteLength':32,'byteStride':8},"         \
    "{'buffer':0,'byteOffset':100,'byteLength':16,'byteStride':4},"                                                    \
    "{'buffer':1,'byteLength':32,'byteStride':8,'extensions':{'EXT_meshopt_compression':{'buffer':0,"                  \
    "'byteOffset':116,'byteLength':52,'byteStride':8,'count':4,'mode':'ATTRIBUTES'}}},"                                \
    "{'buffer':1,'byteLength':12,'extensions':{'EXT_meshopt_compression':{'buffer':0,"                                 \
    "'byteOffset':168,'byteLength':19,'byteStride':2,'count':6,'mode':'TRIANGLES'}}},"                                 \
    "{'buffer':1,'byteLength':12,'extensions':{'EXT_meshopt_compression':{'buffer':0,"                                 \
    "'byteOffset':188,'byteLength':11,'byteStride':2,'count':6,'mode':'INDICES'}}},"                                   \
    "{'buffer':1,'byteLength':48,'byteStride':12,'extensions':{'EXT_meshopt_compression':{'buffer':0,"                 \
    "'byteOffset':200,'byteLength':57,'byteStride':12,'count':4,'mode':'ATTRIBUTES','filter':'EXPONENTIAL'}}},"        \
    "{'buffer':0,'byteOffset':260,'byteLength':24},{'buffer':0,'byteOffset':284,'byteLength':2},"                      \
    "{'buffer':0,'byteOffset':288,'byteLength':12},"                                                                   \
    "{'buffer':1,'byteLength':32,'byteStride':8,'extensions':{'EXT_meshopt_compression':{'buffer':0,"                  \
    "'byteOffset':120,'byteLength':48,'byteStride':8,'count':4,'mode':'ATTRIBUTES'}}}],"                               \
    "'accessors':[{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'},"                                      \
    "{'bufferView':1,'componentType':5123,'count':6,'type':'SCALAR'},"                                                 \
    "{'bufferView':2,'componentType':5123,'count':4,'type':'SCALAR'},"                                                 \
    "{'bufferView':3,'componentType':5123,'count':4,'type':'VEC3'},"                                                   \
    "{'bufferView':4,'componentType':5120,'normalized':true,'count':4,'type':'VEC3'},"                                 \
    "{'bufferView':5,'componentType':5123,'count':4,'type':'VEC3'},"                                                   \
    "{'bufferView':6,'componentType':5123,'count':6,'type':'SCALAR'},"                                                 \
    "{'bufferView':7,'componentType':5123,'count':6,'type':'SCALAR'},"                                                 \
    "{'bufferView':8,'componentType':5126,'count':4,'type':'VEC3'},"                                                   \
    "{'bufferView':9,'componentType':5126,'count':2,'type':'VEC3'},"                                                   \
    "{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3','sparse':{'count':1,'indices':{'bufferView':10,"     \
    "'componentType':5123},'values':{'bufferView':11}}},"                                                              \
    "{'componentType':5126,'count':800000000,'type':'VEC3'},"                                                          \
    "{'bufferView':0,'componentType':5126,'count':600000,'type':'VEC3'},"                                              \
    "{'bufferView':3,'byteOffset':8,'componentType':5123,'count':3,'type':'SCALAR'},"                                  \
    "{'bufferView':12,'componentType':5123,'count':4,'type':'VEC3'},"                                                  \
    "{'bufferView':0,'byteOffset':18446744073709551600,'componentType':5126,'count':4,'type':'VEC3'},"                 \
    "{'bufferView':0,'componentType':5126,'count':6,'type':'VEC2'},"                                                   \
    "{'componentType':5126,'count':3,'type':'VEC3','sparse':{'count':3,'indices':{'bufferView':1,"                     \
    "'componentType':5123},'values':{'bufferView':0}}},"                                                               \
    "{'componentType':5123,'count':3,'type':'SCALAR','sparse':{'count':3,'indices':{'bufferView':1,"                   \
    "'componentType':5123},'values':{'bufferView':1}}},"                                                               \
    "{'componentType':5126,'count':800000000,'type':'VEC3','sparse':{'count':1,'indices':{'bufferView':1,"             \
    "'componentType':5123},'values':{'bufferView':0}}}],"
#define SCENE               "'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0}],"
#define MESH(more)          "'meshes':[{'primitives':[{'material':0," more "}]}]}"
#define SHAPE(vertex, more) MESH("'attributes':{'POSITION':" #vertex "}" more)

typedef struct gltf_case {
    const char *name;
    const char *json;     // behind HEAD
    const char *refusal;  // words of the message, or NULL
    uint32_t triangles;   // all of them seen from +z
    float min[3], max[3]; // of the vertices
    bool needs_unpacking; // or is refused by the name of the extension
} gltf_case;

#define QUAD                                                                                                           \
    2, { 0, 0, 0 },                                                                                                    \
    {                                                                                                                  \
        1, 2, 0                                                                                                        \
    }
#define NONE                                                                                                           \
    0, { 0, 0, 0 },                                                                                                    \
    {                                                                                                                  \
        0, 0, 0                                                                                                        \
    }

static const gltf_case cases[] = {
    { "list", SCENE SHAPE(0, ",'indices':1"), NULL, QUAD, false },
    { "strip", SCENE SHAPE(0, ",'mode':5,'indices':2"), NULL, QUAD, false },
    { "fan without indices", SCENE SHAPE(0, ",'mode':6"), NULL, QUAD, false },
    { "no scene", "'nodes':[{'children':[1]},{'mesh':0}]," SHAPE(0, ",'indices':1"), NULL, QUAD, false },
    { "quantized",
      "'extensionsRequired':['KHR_mesh_quantization'],'scenes':[{'nodes':[0]}],"
      "'nodes':[{'mesh':0,'scale':[0.25,0.25,1]}]," SHAPE(3, ",'indices':1"),
      NULL,
      2,
      { 0, 0, 0 },
      { 25, 50, 0 },
      false },
    { "quantized as fractions", SCENE SHAPE(4, ",'indices':1"), NULL, 2, { 0, 0, 0 }, { 1, 1, 0 }, false },
    { "packed",
      "'extensionsRequired':['EXT_meshopt_compression']," SCENE SHAPE(5, ",'indices':6"),
      NULL,
      2,
      { 0, 0, 0 },
      { 100, 200, 0 },
      true },
    { "packed sequence", SCENE SHAPE(5, ",'indices':7"), NULL, 2, { 0, 0, 0 }, { 100, 200, 0 }, true },
    { "packed with exponents", SCENE SHAPE(8, ",'indices':1"), NULL, QUAD, true },
    { "sparse", SCENE SHAPE(10, ",'indices':1"), NULL, 2, { 0, 0, 0 }, { 3, 4, 0 }, false },
    { "sparse, without the rest", SCENE SHAPE(17, ""), NULL, 1, { 0, 0, 0 }, { 1, 2, 0 }, false },
    { "sparse indices", SCENE SHAPE(0, ",'indices':18"), NULL, 1, { 0, 0, 0 }, { 1, 2, 0 }, false },
    { "sparse, nearly all zeros", SCENE SHAPE(19, ""), "of which the file holds 1", NONE, false },
    { "instances",
      "'extensionsRequired':['EXT_mesh_gpu_instancing'],'scenes':[{'nodes':[0]}],'nodes':[{'mesh':0,'extensions':{"
      "'EXT_mesh_gpu_instancing':{'attributes':{'TRANSLATION':9}}},'scale':[-2,1,1]}]," SHAPE(0, ",'indices':1"),
      NULL,
      4,
      { -12, 0, 0 },
      { 0, 3, 0 },
      false },
    { "mirrored twice, below a matrix",
      "'scenes':[{'nodes':[0]}],'nodes':[{'children':[1,2],'matrix':[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,7,1]},"
      "{'mesh':0,'scale':[-1,1,1]},{'mesh':0}]," SHAPE(0, ",'indices':1"),
      NULL,
      4,
      { -1, 0, 7 },
      { 1, 2, 7 },
      false },
    { "an extension for the eye", "'extensionsRequired':['KHR_materials_unlit']," SCENE SHAPE(0, ",'indices':1"), NULL,
      QUAD, false },
    { "Draco", "'extensionsRequired':['KHR_draco_mesh_compression']," SCENE SHAPE(0, ",'indices':1"),
      "KHR_draco_mesh_compression", NONE, false },
    { "an unknown extension", "'extensionsRequired':['KHR_materials_unlit','X_y']," SCENE SHAPE(0, ",'indices':1"),
      "X_y", NONE, false },
    { "packed, cut at its head", SCENE SHAPE(14, ",'indices':1"), "does not unpack", NONE, true },
    { "a count without data", SCENE SHAPE(11, ""), "accessor 11 has no data", NONE, false },
    { "a count beyond the data", SCENE SHAPE(12, ""), "too short", NONE, false },
    { "an offset that wraps around", SCENE SHAPE(15, ""), "too short", NONE, false },
    { "indices beyond the vertices", SCENE SHAPE(0, ",'indices':13"), "names vertex", NONE, false },
    { "half a triangle", SCENE SHAPE(0, ""), "no multiple of 3", NONE, false },
    { "flat positions", SCENE SHAPE(16, ""), "type that does not fit", NONE, false },
    { "a ring",
      "'scenes':[{'nodes':[0]}],'nodes':[{'children':[1]},{'children':[0],'mesh':0}]," SHAPE(0, ",'indices':1"),
      "nodes[0] stands below itself", NONE, false },
    { "a node twice", "'scenes':[{'nodes':[0,0]}],'nodes':[{'mesh':0}]," SHAPE(0, ",'indices':1"), "twice", NONE,
      false },
    { "points", SCENE SHAPE(0, ",'mode':0"), "no triangles", NONE, false },
    { "nothing to see", "'scenes':[{'nodes':[0]}],'nodes':[{}]," SHAPE(0, ",'indices':1"), "no vertices", NONE, false },
};

static unsigned char data[300];

static void make_data(void)
{
    static const float quad[12] = { 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 0 };
    static const uint16_t list[6] = { 0, 1, 2, 0, 2, 3 }, strip[4] = { 0, 1, 3, 2 };
    static const uint16_t quantized[16] = { 0, 0, 0, 0, 100, 0, 0, 0, 100, 200, 0, 0, 0, 200, 0, 0 };
    static const signed char fractions[16] = { 0, 0, 0, 0, 127, 0, 0, 0, 127, 127, 0, 0, 0, 127, 0, 0 };
    // What meshoptimizer 0.18 makes of quantized, list (both ways), and quad with exponents.
    static const unsigned char packed[52] = { 160, 1, 51, 0, 0, 0, 200, 199, 0, 1, 12, 0, 0, 0, 111 };
    static const unsigned char packed_list[19] = { 225, 240, 0,   0,   118, 135, 86,  103, 120, 169,
                                                   134, 101, 137, 104, 152, 1,   105, 0,   0 };
    static const unsigned char packed_sequence[11] = { 209, 0, 4, 4, 6, 8, 4 };
    static const unsigned char packed_exponents[57] = { 160, 1, 33, 0, 0, 0, 0, 0, 0, 1, 8, 0, 0, 0, 0, 0, 1, 8 };
    static const float moves[6] = { 0, 0, 0, 5, 1, 0 }, moved[3] = { 3, 4, 0 };
    static const uint16_t which = 2;
    memcpy(data, quad, sizeof quad);
    memcpy(data + 48, list, sizeof list);
    memcpy(data + 60, strip, sizeof strip);
    memcpy(data + 68, quantized, sizeof quantized);
    memcpy(data + 100, fractions, sizeof fractions);
    memcpy(data + 116, packed, sizeof packed);
    memcpy(data + 168, packed_list, sizeof packed_list);
    memcpy(data + 188, packed_sequence, sizeof packed_sequence);
    memcpy(data + 200, packed_exponents, sizeof packed_exponents);
    memcpy(data + 260, moves, sizeof moves);
    memcpy(data + 284, &which, sizeof which);
    memcpy(data + 288, moved, sizeof moved);
}

static void put_u32(unsigned char *at, size_t value)
{
    for (int i = 0; i < 4; i++) {
        at[i] = (unsigned char)(value >> (8 * i));
    }
}

// A GLB of HEAD, `json` and the data; returns its size.
static size_t make_glb(const char *json, unsigned char *glb)
{
    size_t text = (size_t)sprintf((char *)glb + 20, "%s%s", HEAD, json);
    for (size_t i = 0; i < text; i++) {
        glb[20 + i] = glb[20 + i] == '\'' ? '"' : glb[20 + i];
    }
    while (text % 4 != 0) {
        glb[20 + text++] = ' ';
    }
    memcpy(glb, "glTF\2\0\0\0", 8);
    memcpy(glb + 16, "JSON", 4);
    put_u32(glb + 8, 28 + text + sizeof data);
    put_u32(glb + 12, text);
    put_u32(glb + 20 + text, sizeof data);
    memcpy(glb + 24 + text, "BIN\0", 4);
    memcpy(glb + 28 + text, data, sizeof data);
    return 28 + text + sizeof data;
}

static void check_shape(const gltf_case *c, const tl_imported_mesh *mesh)
{
    tl_vec3 low = mesh->vertices[0];
    tl_vec3 high = low;
    for (uint32_t i = 1; i < mesh->vertex_count; i++) {
        low = tl_min(low, mesh->vertices[i]);
        high = tl_max(high, mesh->vertices[i]);
    }
    bool as_said = mesh->triangle_count == c->triangles && low.x == c->min[0] && low.y == c->min[1] &&
                   low.z == c->min[2] && high.x == c->max[0] && high.y == c->max[1] && high.z == c->max[2];
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + (size_t)i * 3;
        tl_vec3 a = mesh->vertices[corner[0]];
        as_said = as_said && mesh->materials[i] == 1 &&
                  tl_cross(tl_sub(mesh->vertices[corner[1]], a), tl_sub(mesh->vertices[corner[2]], a)).z > 0.0f;
    }
    if (!as_said) {
        fail_msg("%s: %u triangles, %g %g %g to %g %g %g", c->name, mesh->triangle_count, (double)low.x, (double)low.y,
                 (double)low.z, (double)high.x, (double)high.y, (double)high.z);
    }
    assert_string_equal(tl_name_table_get(&mesh->names, 1), "stück");
}

static void test_cases(void **state)
{
    (void)state;
    static unsigned char glb[16384];
    make_data();
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const gltf_case *c = &cases[i];
        tl_imported_mesh mesh;
        tl_io_error error;
        memset(&error, 0, sizeof error);
        tl_mesh_source source = { "level.glb", NULL, glb, make_glb(c->json, glb), "glb", false, { 0.0 } };
        tl_result result = tl_gltf_read(&source, NULL, &mesh, &error);
        bool by_name = c->needs_unpacking && result == TL_ERR_UNSUPPORTED &&
                       strstr(error.message, "EXT_meshopt_compression") != NULL;
        if (by_name) {
            print_message("%s: talus was built without meshoptimizer\n", c->name);
        } else if (c->refusal != NULL) {
            if (result == TL_OK || strstr(error.message, c->refusal) == NULL) {
                fail_msg("%s: %s: %s", c->name, tl_result_name(result), error.message);
            }
            TEST_CHECK(mesh.vertices == NULL && error.advice[0] != '\0');
        } else if (result != TL_OK) {
            fail_msg("%s: %s: %s", c->name, tl_result_name(result), error.message);
        } else {
            check_shape(c, &mesh);
        }
        tl_imported_mesh_free(&mesh);
    }
}

// Every allocation that fails, every byte of a file that is one of two or three others, and every length: an error or a
// sound mesh.
static void test_damage(void **state)
{
    (void)state;
    static unsigned char glb[16384];
    make_data();
    static const size_t picked[] = { 4, 6, 8, 9, 10 };
    for (size_t p = 0; p < sizeof picked / sizeof picked[0]; p++) {
        size_t size = make_glb(cases[picked[p]].json, glb);
        tl_mesh_source source = { "level.glb", NULL, glb, size, "glb", false, { 0.0 } };
        tl_imported_mesh mesh;
        test_allocator allocator;
        for (uint64_t fail_at = 1, calls = 2; fail_at <= calls; fail_at++) {
            test_allocator_init(&allocator, fail_at);
            tl_result result = tl_gltf_read(&source, &allocator.allocator, &mesh, NULL);
            TEST_CHECK(result == TL_ERR_MEMORY || result == TL_OK || result == TL_ERR_UNSUPPORTED);
            calls = result == TL_ERR_MEMORY ? fail_at + 1 : 0;
            tl_imported_mesh_free(&mesh);
            TEST_CHECK(allocator.live_blocks == 0 && allocator.live_bytes == 0);
        }
        for (size_t at = 0; at < size; at++) {
            unsigned char kept = glb[at];
            static const unsigned char others[] = { 0, 1, '9', '-', 0xff };
            for (size_t k = at % 2; k < sizeof others; k += 2) {
                glb[at] = others[k];
                if (tl_gltf_read(&source, NULL, &mesh, NULL) == TL_OK) {
                    for (uint32_t i = 0; i < mesh.triangle_count * 3; i++) {
                        TEST_CHECK(mesh.indices[i] < mesh.vertex_count);
                    }
                    tl_imported_mesh_free(&mesh);
                }
            }
            glb[at] = kept;
        }
        for (source.size = 0; source.size < size; source.size++) {
            TEST_CHECK(tl_gltf_read(&source, NULL, &mesh, NULL) != TL_OK);
        }
    }
}

// A buffer beside the file: its name with and without escapes; elsewhere, or no file: refused by name, at once.
static void test_buffers(void **state)
{
    (void)state;
    static const struct {
        const char *uri;
        const char *refusal;
    } buffers[] = {
        { "a%20b.bin", NULL },
        { "a b.bin", NULL },
        { "100%25.bin", NULL },
        { "sub%2Fx%c3%bc.bin", NULL },
        { "sub/x\\u00fc.bin", NULL },
        { "../outside.bin", "../outside.bin" },
        { "%2e%2e/outside.bin", "../outside.bin" },
        { "pipe", "no regular file" },
        { "/dev/zero", "/dev/zero" },
        { "absent.bin", "absent.bin" },
        { "short.bin", "shorter" },
        { "data:text/plain,xx", "base64" },
        { "data:;base64,AAAA", "shorter" },
    };
    char root[64] = "/tmp/talus_gltf_XXXXXX";
    TEST_CHECK(mkdtemp(root) != NULL && chdir(root) == 0);
    make_data();
    static const char *const good[] = { "outside.bin", "l/a b.bin", "l/100%.bin", "l/sub/x\xc3\xbc.bin" };
    TEST_CHECK(mkdir("l", 0700) == 0 && mkdir("l/sub", 0700) == 0 && mkfifo("l/pipe", 0600) == 0);
    for (size_t i = 0; i < 4; i++) {
        TEST_RESULT(tl_atomic_write(good[i], data, sizeof data, NULL), TL_OK);
    }
    TEST_RESULT(tl_atomic_write("l/short.bin", data, 200, NULL), TL_OK);
    for (size_t i = 0; i < sizeof buffers / sizeof buffers[0]; i++) {
        char text[8192];
        int length =
            snprintf(text, sizeof text, "{'asset':{'version':'2.0'},'buffers':[{'byteLength':300,'uri':'%s'}%s",
                     buffers[i].uri, strchr(HEAD, '[') + strlen("[{'byteLength':300}"));
        length += snprintf(text + length, sizeof text - (size_t)length, "%s", cases[0].json);
        for (int k = 0; k < length; k++) {
            text[k] = text[k] == '\'' ? '"' : text[k];
        }
        TEST_RESULT(tl_atomic_write("l/level.gltf", text, (size_t)length, NULL), TL_OK);
        tl_imported_mesh mesh;
        tl_io_error error;
        tl_result result = tl_import_mesh("l/level.gltf", NULL, &mesh, &error);
        if ((result == TL_OK) != (buffers[i].refusal == NULL) ||
            (result != TL_OK && strstr(error.message, buffers[i].refusal) == NULL)) {
            fail_msg("%s: %s: %s", buffers[i].uri, tl_result_name(result), result != TL_OK ? error.message : "");
        }
        TEST_CHECK(result != TL_OK || (mesh.triangle_count == 2 && strcmp(mesh.format, "glTF") == 0));
        tl_imported_mesh_free(&mesh);
    }
    static const char *const files[] = { "l/short.bin", "l/level.gltf", "l/pipe" };
    for (size_t i = 0; i < 3; i++) {
        unlink(files[i]);
    }
    for (size_t i = 0; i < 4; i++) {
        unlink(good[i]);
    }
    TEST_CHECK(rmdir("l/sub") == 0 && rmdir("l") == 0 && chdir("/") == 0 && rmdir(root) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_cases),
        cmocka_unit_test(test_damage),
        cmocka_unit_test(test_buffers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
