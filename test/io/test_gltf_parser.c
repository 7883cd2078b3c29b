// SPDX-License-Identifier: MIT
//
// Hostile glTF: each wrong thing is an error that names the element; and what only looks strange is read.

#include "talus_test.h"

#include "io/mesh/gltf_parser.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ASSET "{'asset':{'version':'2.0'}"
#define BASE                                                                                                           \
    ASSET ",'buffers':[{'byteLength':8}],'bufferViews':[{'buffer':0,'byteLength':8}],"                                 \
          "'accessors':[{'bufferView':0,'componentType':5126,'count':1,'type':'VEC3'}],'materials':[{}],"              \
          "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}],"

// Quotes are apostrophes here.
static tl_result parse(const char *json, size_t size, tl_gltf_data *data, tl_io_error *error)
{
    char *text = malloc(size + 1);
    for (size_t i = 0; i < size; i++) {
        text[i] = json[i] == '\'' ? '"' : json[i];
    }
    tl_mesh_source source = { "level.gltf", NULL, text, size, "gltf", false, { 0.0 } };
    tl_result result = tl_gltf_parse(&source, NULL, data, error);
    free(text); // of a text nothing is kept; of a GLB its binary chunk
    return result;
}

typedef struct hostile_case {
    const char *json;
    tl_result result;
    const char *words;
} hostile_case;

static const hostile_case hostile[] = {
    // the JSON
    { "", TL_ERR_FORMAT, "" },
    { "[]", TL_ERR_FORMAT, "the JSON is no object" },
    { ASSET, TL_ERR_FORMAT, "cut short" },
    { ASSET ",'nodes':[{'mesh':0},", TL_ERR_FORMAT, "cut short" },
    { ASSET ",'scene':0,'scene':0}", TL_ERR_FORMAT, "duplicate object key" },
    { ASSET ",'x':'\xff'}", TL_ERR_FORMAT, "unable to decode byte 0xff" },
    { ASSET ",'x':'\xed\xa0\x80'}", TL_ERR_FORMAT, "unable to decode" }, // half of a UTF-16 pair
    { ASSET ",'x':'\\u0000'}", TL_ERR_FORMAT, "\\u0000" },
    { ASSET ",'x':1e999}", TL_ERR_FORMAT, "real number overflow" },
    { ASSET ",'x':NaN}", TL_ERR_FORMAT, "NaN" },
    { ASSET "} {}", TL_ERR_FORMAT, "end of file expected" },
    { "\xff\xfe{", TL_ERR_UNSUPPORTED, "UTF-16" },
    // the file
    { "{}", TL_ERR_FORMAT, "asset.version is missing" },
    { "{'asset':{'version':2}}", TL_ERR_FORMAT, "asset.version is no text" },
    { "{'asset':{'version':'1.0'}}", TL_ERR_UNSUPPORTED, "glTF 1.0 is not read" },
    { "{'asset':{'version':'2.1','minVersion':'2.1'}}", TL_ERR_UNSUPPORTED, "glTF 2.1 is not read" },
    { ASSET ",'extensionsRequired':['a',1]}", TL_ERR_FORMAT, "extensionsRequired[1] is no text" },
    { ASSET ",'nodes':{}}", TL_ERR_FORMAT, "nodes is no array" },
    { ASSET ",'nodes':[[]]}", TL_ERR_FORMAT, "nodes[0] is no object" },
    // lists
    { ASSET ",'buffers':[{'byteLength':-1}]}", TL_ERR_FORMAT, "buffers[0].byteLength is no whole number" },
    { ASSET ",'buffers':[{'byteLength':1.5}]}", TL_ERR_FORMAT, "buffers[0].byteLength is no whole number" },
    { ASSET ",'buffers':[{'uri':7}]}", TL_ERR_FORMAT, "buffers[0].uri is no text" },
    { ASSET ",'bufferViews':[{'buffer':0}]}", TL_ERR_INDEX, "bufferViews[0].buffer is 0, but the file has 0 buffers" },
    { ASSET ",'bufferViews':[{'extensions':{'EXT_meshopt_compression':{'mode':'LZ'}}}]}", TL_ERR_UNSUPPORTED,
      "bufferViews[0].extensions.EXT_meshopt_compression.mode is not known" },
    { ASSET ",'bufferViews':[{'extensions':{'EXT_meshopt_compression':{'filter':'COLOR'}}}]}", TL_ERR_UNSUPPORTED,
      "EXT_meshopt_compression.filter is not known" },
    { ASSET ",'accessors':[{},{'sparse':{'indices':{'bufferView':9}}}]}", TL_ERR_INDEX,
      "accessors[1].sparse.indices.bufferView is 9" },
    { ASSET ",'accessors':[{'normalized':1}]}", TL_ERR_FORMAT, "accessors[0].normalized is neither true nor false" },
    { BASE "'nodes':[{'mesh':18446744073709551616}]}", TL_ERR_INDEX, "nodes[0].mesh is 9007199254740992, but" },
    { BASE "'nodes':[{'mesh':'0'}]}", TL_ERR_FORMAT, "nodes[0].mesh is no index" },
    { BASE "'nodes':[{'mesh':null}]}", TL_ERR_FORMAT, "nodes[0].mesh is no index" },
    { ASSET ",'accessors':[{}],'meshes':[{},{'primitives':[{},{'mode':7}]}]}", TL_ERR_UNSUPPORTED,
      "meshes[1].primitives[1].mode is not known" },
    { ASSET ",'meshes':[{'primitives':[{'attributes':{'POSITION':3}}]}]}", TL_ERR_INDEX,
      "meshes[0].primitives[0].attributes.POSITION is 3, but the file has 0 accessors" },
    { ASSET ",'meshes':[{'primitives':[{'material':0}]}]}", TL_ERR_INDEX, "meshes[0].primitives[0].material is 0" },
    { ASSET ",'meshes':[{'primitives':[3]}]}", TL_ERR_FORMAT, "meshes[0].primitives[0] is no object" },
    // nodes
    { ASSET ",'nodes':[{'matrix':[1,2]}]}", TL_ERR_FORMAT, "nodes[0].matrix has 2 numbers instead of 16" },
    { ASSET ",'nodes':[{},{'scale':[1,'1',1]}]}", TL_ERR_FORMAT, "nodes[1].scale[1] is no number" },
    { ASSET ",'nodes':[{'children':[0]}]}", TL_ERR_FORMAT, "nodes[0] stands below itself" },
    { ASSET ",'nodes':[{},{'children':[3]},{'children':[1]},{'children':[2]}]}", TL_ERR_FORMAT, "stands below itself" },
    { ASSET ",'nodes':[{},{'children':[0]},{'children':[0]}]}", TL_ERR_FORMAT,
      "nodes[2].children[0] is 0, which is a child of node 1 already" },
    { ASSET ",'nodes':[{},{'children':[0,0]}]}", TL_ERR_FORMAT, "nodes[1].children[1] is 0, which is a child" },
    { ASSET ",'nodes':[{'children':[1]}]}", TL_ERR_INDEX, "nodes[0].children[0] is 1, but the file has 1 nodes" },
    { ASSET ",'nodes':[{'extensions':{'EXT_mesh_gpu_instancing':{'attributes':{'_ID':2}}}}]}", TL_ERR_INDEX,
      "nodes[0].extensions.EXT_mesh_gpu_instancing.attributes._ID is 2" },
    { ASSET ",'scene':1,'scenes':[{}]}", TL_ERR_INDEX, "scene is 1, but the file has 1 scenes" },
    { ASSET ",'scenes':[{'nodes':[0]}]}", TL_ERR_INDEX, "scenes[0].nodes[0] is 0, but the file has 0 nodes" },
    { ASSET ",'nodes':[{},{}],'scenes':[{'nodes':[1,0,1]}]}", TL_ERR_FORMAT, "the scene shows node 1 twice" },
    { ASSET ",'nodes':[{'children':[1]},{'children':[2]},{},{}],'scenes':[{'nodes':[3,2,0]}]}", TL_ERR_FORMAT,
      "the scene shows node 2 twice" },
};

static void test_hostile(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof hostile / sizeof hostile[0]; i++) {
        tl_gltf_data data;
        tl_io_error error;
        memset(&error, 0, sizeof error);
        tl_result result = parse(hostile[i].json, strlen(hostile[i].json), &data, &error);
        if (result != hostile[i].result || strstr(error.message, hostile[i].words) == NULL || error.advice[0] == '\0') {
            fail_msg("%s: %s: %s", hostile[i].json, tl_result_name(result), error.message);
        }
        TEST_CHECK(data.nodes == NULL && data.json == NULL);
    }
}

static void test_strange(void **state)
{
    (void)state;
    static const char *const good[] = {
        "\xef\xbb\xbf" ASSET "}",
        ASSET ",'scene':0.0,'scenes':[{'nodes':[1e0]}],'nodes':[{},{}]}",
        "{'asset':{'version':'2.3','minVersion':'2.0'}}",
        BASE "'nodes':[{'mesh':0,'children':[1,2]},{},{'children':[3]},{}],'scenes':[{'nodes':[1,2]}]}",
        ASSET ",'nodes':[{'extensions':{'EXT_mesh_gpu_instancing':{}}}],'extras':{'x':[[[]]]}}",
    };
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        tl_gltf_data data;
        tl_io_error error;
        tl_result result = parse(good[i], strlen(good[i]), &data, &error);
        if (result != TL_OK) {
            fail_msg("%s: %s", good[i], error.message);
        }
        tl_gltf_data_free(&data);
        tl_gltf_data_free(&data);
    }
}

// A text with `middle` `count` times between its ends.
static tl_result parse_repeated(const char *head, const char *middle, size_t count, const char *tail,
                                tl_gltf_data *data, tl_io_error *error)
{
    size_t lengths[3] = { strlen(head), strlen(middle), strlen(tail) };
    size_t size = lengths[0] + lengths[1] * count + lengths[2];
    char *text = malloc(size);
    memcpy(text, head, lengths[0]);
    for (size_t i = 0; i < count; i++) {
        memcpy(text + lengths[0] + i * lengths[1], middle, lengths[1]);
    }
    memcpy(text + size - lengths[2], tail, lengths[2]);
    tl_result result = parse(text, size, data, error);
    free(text);
    return result;
}

// Nesting, and a chain of nodes as deep as there are nodes, in linear time and on a small stack.
static void test_depth(void **state)
{
    (void)state;
    enum { CHAIN = 200000 };
    tl_gltf_data data;
    tl_io_error error;
    TEST_RESULT(parse_repeated(ASSET ",'x':", "[", 1000000, "", &data, &error), TL_ERR_LIMIT);
    assert_non_null(strstr(error.message, "deeper than"));
    TEST_RESULT(parse_repeated(ASSET ",'extras':", "{'a':", 1000, "", &data, &error), TL_ERR_FORMAT);
    char *text = malloc(CHAIN * 32 + 100);
    for (int ring = 0; ring < 2; ring++) {
        size_t length = (size_t)sprintf(text, ASSET ",'nodes':[");
        for (int i = 0; i < CHAIN; i++) {
            int child = i + 1 < CHAIN ? i + 1 : 0;
            length += (size_t)(i + 1 < CHAIN || ring ? sprintf(text + length, "{'children':[%d]},", child)
                                                     : sprintf(text + length, "{},"));
        }
        length += (size_t)sprintf(text + length - 1, "]}") - 1;
        tl_result result = parse(text, length, &data, &error);
        TEST_RESULT(result, ring ? TL_ERR_FORMAT : TL_OK);
        TEST_CHECK(ring || (data.node_count == CHAIN && data.root_count == 1));
        tl_gltf_data_free(&data);
    }
    free(text);
}

static void put_glb_u32(unsigned char *at, size_t value)
{
    for (int i = 0; i < 4; i++) {
        at[i] = (unsigned char)(value >> (8 * i));
    }
}

static tl_result parse_glb(const unsigned char *glb, size_t size, tl_gltf_data *data, tl_io_error *error)
{
    unsigned char *copy = malloc(size); // so that a sanitizer sees its end
    memcpy(copy, glb, size);
    tl_mesh_source source = { "level.glb", NULL, copy, size, "glb", false, { 0.0 } };
    tl_result result = tl_gltf_parse(&source, NULL, data, error);
    bool inside = result != TL_OK || data->binary == NULL ||
                  (data->binary >= copy && data->binary_size <= size - (size_t)(data->binary - copy));
    free(copy);
    TEST_CHECK(inside);
    return result;
}

static void test_container(void **state)
{
    (void)state;
    static const char json[28] = "{\"asset\":{\"version\":\"2.0\"}}"; // filled up with a zero
    enum { JSON = sizeof json, SIZE = 20 + JSON + 8 + 4 + 8 + 4 };
    unsigned char glb[SIZE] = "glTF\2";
    put_glb_u32(glb + 8, SIZE);
    put_glb_u32(glb + 12, JSON);
    memcpy(glb + 16, "JSON", 4);
    memcpy(glb + 20, json, JSON);
    put_glb_u32(glb + 20 + JSON, 4);
    memcpy(glb + 24 + JSON, "XTRA", 4);
    put_glb_u32(glb + 32 + JSON, 4);
    memcpy(glb + 36 + JSON, "BIN\0abcd", 8);
    tl_gltf_data data;
    tl_io_error error;
    TEST_RESULT(parse_glb(glb, SIZE, &data, &error), TL_OK);
    TEST_CHECK(data.binary_size == 4);
    tl_gltf_data_free(&data);
    static const struct {
        size_t at, value;
        tl_result result;
        const char *words;
    } edits[] = {
        { 4, 1, TL_ERR_UNSUPPORTED, "glTF 1.0" },
        { 4, 3, TL_ERR_UNSUPPORTED, "version that is not 2" },
        { 8, SIZE + 1, TL_ERR_FORMAT, "cut short" },
        { 8, 0, TL_ERR_FORMAT, "cut short" },
        { 8, 0xffffffff, TL_ERR_FORMAT, "cut short" },
        { 12, 0xffffffff, TL_ERR_FORMAT, "cut short" },
        { 12, JSON + 64, TL_ERR_FORMAT, "cut short" },
        { 12, JSON - 8, TL_ERR_FORMAT, "" },
        { 12, 0, TL_ERR_FORMAT, "" },
        { 16, 0x004e4942, TL_ERR_FORMAT, "first chunk of the GLB is no JSON" },
        { 24 + JSON, 0x4e4f534a, TL_ERR_FORMAT, "two chunks of JSON" },
        { 20 + JSON, 0xfffffff8, TL_ERR_FORMAT, "cut short" },
        { 32 + JSON, 5, TL_ERR_FORMAT, "cut short" },
    };
    for (size_t i = 0; i < sizeof edits / sizeof edits[0]; i++) {
        unsigned char kept[4];
        memcpy(kept, glb + edits[i].at, 4);
        put_glb_u32(glb + edits[i].at, edits[i].value);
        memset(&error, 0, sizeof error);
        tl_result result = parse_glb(glb, SIZE, &data, &error);
        if (result != edits[i].result || strstr(error.message, edits[i].words) == NULL) {
            fail_msg("%zu at %zu: %s: %s", edits[i].value, edits[i].at, tl_result_name(result), error.message);
        }
        memcpy(glb + edits[i].at, kept, 4);
    }
    for (size_t size = 4; size < SIZE; size++) {
        TEST_CHECK(parse_glb(glb, size, &data, &error) != TL_OK);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hostile),
        cmocka_unit_test(test_strange),
        cmocka_unit_test(test_depth),
        cmocka_unit_test(test_container),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
