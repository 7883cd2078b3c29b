// SPDX-License-Identifier: MIT
//
// A matrix of formats and what their files may hold. Every cell is a file written here that shows one floor: 1 m by 2 m
// in metres, y up, seen from above; it is read right, or refused by name. The matrix is printed.

#define _GNU_SOURCE

#include "format_bytes.h"
#include "talus_test.h"

#include "io/files/atomic_write.h"
#include "io/mesh/mesh_import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// --- OBJ, STL, PLY --------------------------------------------------------------------------------------------------

#define OBJ_FLOOR "v 0 0 0\nv 0 0 2\nv 1 0 2\nv 1 0 0\n"
#define STL_FACET(a, b, c)                                                                                             \
    "facet normal 0 1 0\nouter loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\nendfacet\n"
#define STL_TEXT "solid x\n" STL_FACET("0 0 0", "0 0 2", "1 0 2") STL_FACET("0 0 0", "1 0 2", "1 0 0") "endsolid x\n"

// --- glTF -----------------------------------------------------------------------------------------------------------

// Quotes are apostrophes here. Accessors: positions, a list, a strip, quantized positions.
#define GLTF_HEAD                                                                                                      \
    "{'asset':{'version':'2.0'},'buffers':[{'byteLength':100,'uri':'data:application/octet-stream;base64,"             \
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAABAAACAPwAAAAAAAABAAACAPwAAAAAAAAAAAAABAAIAAAACAAMAAAABAAMAAgAAAAAAAAAA"             \
    "AAAAAADIAAAAZAAAAMgAAABkAAAAAAAAAA=="                                                                             \
    "'}],'bufferViews':[{'buffer':0,'byteLength':48},{'buffer':0,'byteOffset':48,'byteLength':12},"                    \
    "{'buffer':0,'byteOffset':60,'byteLength':8},{'buffer':0,'byteOffset':68,'byteLength':32,'byteStride':8}],"        \
    "'accessors':[{'bufferView':0,'componentType':5126,'count':4,'type':'VEC3'},"                                      \
    "{'bufferView':1,'componentType':5123,'count':6,'type':'SCALAR'},"                                                 \
    "{'bufferView':2,'componentType':5123,'count':4,'type':'SCALAR'},"                                                 \
    "{'bufferView':3,'componentType':5123,'count':4,'type':'VEC3'}],'materials':[{'name':'stück'}],"                  \
    "'scenes':[{'nodes':[0]}],"
#define GLTF_MESH(vertex, more)                                                                                        \
    "'meshes':[{'primitives':[{'material':0,'attributes':{'POSITION':" #vertex "}" more "}]}]}"
#define GLTF_NODES(nodes) "'nodes':[" nodes "],"
#define GLTF_PLAIN        GLTF_HEAD GLTF_NODES("{'mesh':0}") GLTF_MESH(0, ",'indices':1")

// --- FBX ------------------------------------------------------------------------------------------------------------

#define FBX_NUMBER(name, type, value) "P: '" name "', '" type "', '" type "', ''," value "\n"
#define FBX_AXES(up, front, front_sign)                                                                                \
    FBX_NUMBER("UpAxis", "int", up)                                                                                    \
    FBX_NUMBER("UpAxisSign", "int", "1")                                                                               \
    FBX_NUMBER("FrontAxis", "int", front)                                                                              \
    FBX_NUMBER("FrontAxisSign", "int", front_sign)                                                                     \
    FBX_NUMBER("CoordAxis", "int", "0")                                                                                \
    FBX_NUMBER("CoordAxisSign", "int", "1")
#define FBX_UNIT(centimetres) FBX_NUMBER("UnitScaleFactor", "double", centimetres)
#define FBX_MODEL(id, properties)                                                                                      \
    "Model: " id ", 'Model::m" id "', 'Mesh' {\nVersion: 232\nProperties70: {\n" properties "}\n}\n"
#define FBX_FLOOR   "0,0,0,0,0,2,1,0,2,1,0,0"
#define FBX_CORNERS "0,1,2,-4"
#define FBX(settings, vertices, corners, models, links)                                                                \
    "; FBX 7.3.0 project file\nFBXHeaderExtension: {\nFBXHeaderVersion: 1003\nFBXVersion: 7300\n}\n"                   \
    "GlobalSettings: {\nVersion: 1000\nProperties70: {\n" settings "}\n}\nObjects: {\n"                                \
    "Geometry: 1, 'Geometry::g', 'Mesh' {\nVertices: *1 {\na: " vertices "\n}\nPolygonVertexIndex: *1 {\na: " corners  \
    "\n}\nGeometryVersion: 124\nLayerElementMaterial: 0 {\nVersion: 101\nName: ''\n"                                   \
    "MappingInformationType: 'AllSame'\nReferenceInformationType: 'IndexToDirect'\nMaterials: *1 {\na: 0\n}\n}\n"      \
    "Layer: 0 {\nVersion: 100\nLayerElement: {\nType: 'LayerElementMaterial'\nTypedIndex: 0\n}\n}\n}\n" models         \
    "Material: 9, 'Material::stück', '' {\nVersion: 102\nShadingModel: 'phong'\n}\n}\n"                               \
    "Connections: {\n" links "}\n"
#define FBX_LINK(id)                         "C: 'OO'," id ",0\nC: 'OO',1," id "\nC: 'OO',9," id "\n"
#define FBX_METRES                           FBX_AXES("1", "2", "1") FBX_UNIT("100")
#define FBX_ONE(settings, vertices, corners) FBX(settings, vertices, corners, FBX_MODEL("2", ""), FBX_LINK("2"))

// --- Collada --------------------------------------------------------------------------------------------------------

#define DAE(asset, vertices, count, faces, nodes)                                                                      \
    "<?xml version='1.0' encoding='utf-8'?>\n<COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' "           \
    "version='1.4.1'><asset>" asset "</asset><library_materials><material id='m' name='stück'>"                       \
    "<instance_effect url='#e'/></material></library_materials><library_effects><effect id='e'><profile_COMMON>"       \
    "<technique sid='c'><lambert/></technique></profile_COMMON></effect></library_effects><library_geometries>"        \
    "<geometry id='g'><mesh><source id='p'><float_array id='a' count='" count "'>" vertices "</float_array>"           \
    "<technique_common><accessor source='#a' count='" count "' stride='3'><param name='X' type='float'/>"              \
    "<param name='Y' type='float'/><param name='Z' type='float'/></accessor></technique_common></source>"              \
    "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices>" faces "</mesh></geometry>"                  \
    "</library_geometries><library_visual_scenes><visual_scene id='s'>" nodes "</visual_scene>"                        \
    "</library_visual_scenes><scene><instance_visual_scene url='#s'/></scene></COLLADA>"
#define DAE_INPUT "<input semantic='VERTEX' source='#v' offset='0'/>"
#define DAE_NODE(id, place)                                                                                            \
    "<node id='" id "'>" place "<instance_geometry url='#g'><bind_material><technique_common>"                         \
    "<instance_material symbol='m' target='#m'/></technique_common></bind_material></instance_geometry></node>"
#define DAE_METRES "<unit meter='1'/><up_axis>Y_UP</up_axis>"
#define DAE_FLOOR  "0 0 0 0 0 2 1 0 2 1 0 0"
#define DAE_QUAD   "<polylist material='m' count='1'>" DAE_INPUT "<vcount>4</vcount><p>0 1 2 3</p></polylist>"

// --- the matrix -----------------------------------------------------------------------------------------------------

typedef enum column { PLAIN, UNITS, AXES, MIRRORED, INSTANCES, QUANTIZED, COMPRESSED, POLYGON, STRIP, COLUMNS } column;

static const char *const column_names[COLUMNS] = { "plain",     "units",      "axes",    "mirrored", "instances",
                                                   "quantized", "compressed", "polygon", "strip" };

typedef struct format_cell {
    const char *extension;
    column column;
    const char *text;    // apostrophes stand for quotes in glTF and FBX
    const char *refusal; // words of the message
} format_cell;

static const format_cell cells[] = {
    { "obj", PLAIN, OBJ_FLOOR "usemtl stück\nf 1 2 3\nf 1 3 4\n", NULL },
    { "obj", POLYGON, OBJ_FLOOR "v 0.9 0 1\nusemtl stück\nf 1 2 3 5 4\n", NULL },
    { "stl", PLAIN, STL_TEXT, NULL },
    { "ply", PLAIN, PLY_HEAD("ascii", "4", "2") "0 0 0\n0 0 2\n1 0 2\n1 0 0\n3 0 1 2\n3 0 2 3\n", NULL },
    { "ply", POLYGON, PLY_HEAD("ascii", "5", "1") "0 0 0\n0 0 2\n1 0 2\n0.9 0 1\n1 0 0\n5 0 1 2 3 4\n", NULL },
    { "ply", STRIP,
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n0 0 2\n1 0 0\n1 0 2\n4 0 1 2 3\n",
      "triangle strips" },
    { "gltf", PLAIN, GLTF_PLAIN, NULL },
    { "gltf", MIRRORED,
      GLTF_HEAD GLTF_NODES("{'mesh':0,'scale':[-1,1,1],'translation':[1,0,0]}") GLTF_MESH(0, ",'indices':1"), NULL },
    { "gltf", INSTANCES,
      GLTF_HEAD GLTF_NODES("{'children':[1,2]},{'mesh':0,'scale':[0.5,1,1]},"
                           "{'mesh':0,'scale':[0.5,1,1],'translation':[0.5,0,0]}") GLTF_MESH(0, ",'indices':1"),
      NULL },
    { "gltf", QUANTIZED,
      GLTF_HEAD "'extensionsRequired':['KHR_mesh_quantization']," GLTF_NODES("{'mesh':0,'scale':[0.01,1,0.01]}")
          GLTF_MESH(3, ",'indices':1"),
      NULL },
    { "gltf", COMPRESSED,
      GLTF_HEAD "'extensionsRequired':['KHR_draco_mesh_compression']," GLTF_NODES("{'mesh':0}")
          GLTF_MESH(0, ",'indices':1"),
      "KHR_draco_mesh_compression" },
    { "gltf", STRIP, GLTF_HEAD GLTF_NODES("{'mesh':0}") GLTF_MESH(0, ",'mode':5,'indices':2"), NULL },
    { "fbx", PLAIN, FBX_ONE(FBX_METRES, FBX_FLOOR, FBX_CORNERS), NULL },
    { "fbx", UNITS, FBX_ONE(FBX_AXES("1", "2", "1") FBX_UNIT("1"), "0,0,0,0,0,200,100,0,200,100,0,0", FBX_CORNERS),
      NULL },
    { "fbx", AXES, FBX_ONE(FBX_AXES("2", "1", "-1") FBX_UNIT("100"), "0,0,0,0,-2,0,1,-2,0,1,0,0", FBX_CORNERS), NULL },
    { "fbx", MIRRORED,
      FBX(FBX_METRES, FBX_FLOOR, FBX_CORNERS,
          FBX_MODEL("2", "P: 'Lcl Scaling', 'Lcl Scaling', '', 'A',-1,1,1\n"
                         "P: 'Lcl Translation', 'Lcl Translation', '', 'A',1,0,0\n"),
          FBX_LINK("2")),
      NULL },
    { "fbx", INSTANCES,
      FBX(FBX_METRES, FBX_FLOOR, FBX_CORNERS,
          FBX_MODEL("2", "P: 'Lcl Scaling', 'Lcl Scaling', '', 'A',0.5,1,1\n")
              FBX_MODEL("3", "P: 'Lcl Scaling', 'Lcl Scaling', '', 'A',0.5,1,1\n"
                             "P: 'Lcl Translation', 'Lcl Translation', '', 'A',0.5,0,0\n"),
          FBX_LINK("2") FBX_LINK("3")),
      NULL },
    { "fbx", POLYGON, FBX_ONE(FBX_METRES, "0,0,0,0,0,2,1,0,2,0.9,0,1,1,0,0", "0,1,2,3,-5"), NULL },
    { "3ds", PLAIN, "", NULL },
    { "off", PLAIN, "OFF\n4 1 0\n0 0 0\n0 0 2\n1 0 2\n1 0 0\n4 0 1 2 3\n", NULL },
    { "off", POLYGON, "OFF\n5 1 0\n0 0 0\n0 0 2\n1 0 2\n1 0 0\n0.9 0 1\n5 0 1 2 4 3\n", NULL },
    { "dae", PLAIN, DAE(DAE_METRES, DAE_FLOOR, "12", DAE_QUAD, DAE_NODE("n", "")), NULL },
    { "dae", UNITS,
      DAE("<unit meter='0.01'/><up_axis>Y_UP</up_axis>", "0 0 0 0 0 200 100 0 200 100 0 0", "12", DAE_QUAD,
          DAE_NODE("n", "")),
      NULL },
    { "dae", AXES,
      DAE("<unit meter='1'/><up_axis>Z_UP</up_axis>", "0 0 0 0 -2 0 1 -2 0 1 0 0", "12", DAE_QUAD, DAE_NODE("n", "")),
      NULL },
    { "dae", MIRRORED,
      DAE(DAE_METRES, DAE_FLOOR, "12", DAE_QUAD, DAE_NODE("n", "<translate>1 0 0</translate><scale>-1 1 1</scale>")),
      NULL },
    { "dae", INSTANCES,
      DAE(DAE_METRES, DAE_FLOOR, "12", DAE_QUAD,
          DAE_NODE("n", "<scale>0.5 1 1</scale>")
              DAE_NODE("o", "<translate>0.5 0 0</translate><scale>0.5 1 1</scale>")),
      NULL },
    { "dae", POLYGON,
      DAE(DAE_METRES, "0 0 0 0 0 2 1 0 2 0.9 0 1 1 0 0", "15",
          "<polylist material='m' count='1'>" DAE_INPUT "<vcount>5</vcount><p>0 1 2 3 4</p></polylist>",
          DAE_NODE("n", "")),
      NULL },
    { "dae", STRIP,
      DAE(DAE_METRES, DAE_FLOOR, "12", "<tristrips material='m' count='1'>" DAE_INPUT "<p>0 1 3 2</p></tristrips>",
          DAE_NODE("n", "")),
      NULL },
};

static char folder[64];

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/talus_formats_XXXXXX");
    return mkdtemp(folder) != NULL ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder);
}

// The file's name is Unicode too.
static tl_result import_file(const char *extension, const void *bytes, size_t size, tl_imported_mesh *mesh,
                             tl_io_error *error)
{
    char path[128];
    snprintf(path, sizeof path, "%s/straße 地図.%s", folder, extension);
    TEST_RESULT(tl_atomic_write(path, bytes, size, NULL), TL_OK);
    tl_result result = tl_import_mesh(path, NULL, mesh, error);
    unlink(path);
    return result;
}

static bool near(float a, float b)
{
    return fabsf(a - b) < 1e-5f;
}

static bool has_materials(const char *extension)
{
    return strcmp(extension, "stl") != 0 && strcmp(extension, "ply") != 0 && strcmp(extension, "off") != 0;
}

// The floor: its bounds, its area, each triangle seen from above, its material.
static const char *find_wrong(const char *extension, const tl_imported_mesh *mesh)
{
    tl_vec3 low = mesh->vertices[0];
    tl_vec3 high = low;
    float area = 0.0f;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        low = tl_min(low, mesh->vertices[i]);
        high = tl_max(high, mesh->vertices[i]);
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + (size_t)i * 3;
        tl_vec3 a = mesh->vertices[corner[0]];
        float twice = tl_cross(tl_sub(mesh->vertices[corner[1]], a), tl_sub(mesh->vertices[corner[2]], a)).y;
        area += twice / 2.0f;
        if (!(twice > 0.0f)) {
            return "wound inside out";
        }
    }
    if (!near(low.x, 0) || !near(low.y, 0) || !near(low.z, 0) || !near(high.x, 1) || !near(high.y, 0) ||
        !near(high.z, 2)) {
        return "elsewhere";
    }
    if (!near(area, 2.0f) && !near(area, 1.9f)) { // a polygon with a dent
        return "another area";
    }
    if (has_materials(extension) &&
        (mesh->names.count < 2 || strcmp(tl_name_table_get(&mesh->names, 1), "stück") != 0)) {
        return "another material";
    }
    return NULL;
}

static const char *check_file(const char *extension, const void *bytes, size_t size, const char *refusal)
{
    tl_imported_mesh mesh;
    tl_io_error error;
    tl_result result = import_file(extension, bytes, size, &mesh, &error);
    if (result != TL_OK) {
        if (refusal == NULL || strstr(error.message, refusal) == NULL) {
            print_message("%s: %s: %s\n", extension, tl_result_name(result), error.message);
            return "FAILED";
        }
        return "refused";
    }
    const char *wrong = refusal != NULL ? "read" : find_wrong(extension, &mesh);
    tl_imported_mesh_free(&mesh);
    return wrong != NULL ? wrong : "right";
}

static const char *check_cell(const format_cell *cell)
{
    static char text[16384];
    size_t size = strlen(cell->text);
    bool quotes = strcmp(cell->extension, "gltf") == 0 || strcmp(cell->extension, "fbx") == 0;
    TEST_CHECK(size < sizeof text);
    for (size_t i = 0; i < size; i++) {
        text[i] = quotes && cell->text[i] == '\'' ? '"' : cell->text[i];
    }
    return check_file(cell->extension, text, size, cell->refusal);
}

// --- the table ------------------------------------------------------------------------------------------------------

typedef enum form { AS_TEXT, BINARY_STL, BINARY_PLY, GLB, BINARY_FBX, AS_3DS } form;

typedef struct format_row {
    const char *name;
    const char *extension;
    const char *cells; // the extension whose cells these are
    form form;
} format_row;

static const format_row rows[] = {
    { "OBJ", "obj", "obj", AS_TEXT },       { "STL, text", "stl", "stl", AS_TEXT }, { "STL", "stl", "stl", BINARY_STL },
    { "PLY, text", "ply", "ply", AS_TEXT }, { "PLY", "ply", "ply", BINARY_PLY },    { "glTF", "gltf", "gltf", AS_TEXT },
    { "GLB", "glb", "gltf", GLB },          { "FBX, text", "fbx", "fbx", AS_TEXT }, { "FBX", "fbx", "fbx", BINARY_FBX },
    { "Collada", "dae", "dae", AS_TEXT },   { "3DS", "3ds", "3ds", AS_3DS },        { "OFF", "off", "off", AS_TEXT },
};

static const char *check_in_form(const format_row *row, const format_cell *cell)
{
    static byte_buffer file;
    file.size = 0;
    switch (row->form) {
    case BINARY_STL:
        make_binary_stl(&file);
        break;
    case BINARY_PLY:
        if (cell->refusal != NULL) {
            return check_cell(cell);
        }
        make_binary_ply(&file, cell->column == POLYGON);
        break;
    case GLB:
        make_glb(&file, cell->text);
        break;
    case BINARY_FBX:
        make_binary_fbx(&file, cell->text);
        break;
    case AS_3DS:
        make_3ds(&file);
        break;
    default:
        return check_cell(cell);
    }
    return check_file(row->extension, file.bytes, file.size, cell->refusal);
}

// "-": the format cannot say such a thing; units and axes are then the options' (--scale, --up). Names are those of the
// material and of the file, both beyond ASCII.
static void test_matrix(void **state)
{
    (void)state;
    int wrong = 0, right = 0;
    print_message("%-10s", "");
    for (int k = 0; k < COLUMNS; k++) {
        print_message("%-11s", column_names[k]);
    }
    print_message("names\n");
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        const char *names = "-";
        print_message("%-10s", rows[r].name);
        for (int k = 0; k < COLUMNS; k++) {
            const char *said = "-";
            for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++) {
                if (strcmp(cells[i].extension, rows[r].cells) == 0 && (int)cells[i].column == k) {
                    said = check_in_form(&rows[r], &cells[i]);
                    const bool as_wanted = strcmp(said, cells[i].refusal != NULL ? "refused" : "right") == 0;
                    right += as_wanted;
                    wrong += !as_wanted;
                }
            }
            names = k == PLAIN && has_materials(rows[r].extension) ? said : names;
            print_message("%-11s", said);
        }
        print_message("%s\n", names);
    }
    TEST_CHECK(wrong == 0 && right >= 44);
}

// A node far out keeps its place to the millimetre, where a float steps by half a metre.
static void test_far_nodes(void **state)
{
    (void)state;
    static const char json[] =
        GLTF_HEAD GLTF_NODES("{'mesh':0,'translation':[4649000.125,-7,5000000.375]}") GLTF_MESH(0, ",'indices':1");
    static byte_buffer file;
    file.size = 0;
    make_glb(&file, json);
    tl_import_options options = tl_default_import_options();
    const double origin[3] = { 4649000.0, 0.0, 5000000.0 };
    memcpy(options.origin, origin, sizeof origin);
    tl_imported_mesh mesh;
    TEST_RESULT(tl_import_mesh_bytes(file.bytes, file.size, "far.glb", &options, &mesh, NULL), TL_OK);
    TEST_CHECK(mesh.vertices[0].x == 0.125f && mesh.vertices[0].y == -7.0f && mesh.vertices[0].z == 0.375f);
    TEST_CHECK(memcmp(mesh.origin, origin, sizeof origin) == 0);
    tl_imported_mesh_free(&mesh);
}

static void test_cut_3ds(void **state)
{
    (void)state;
    static byte_buffer file;
    file.size = 0;
    make_3ds(&file);
    for (size_t size = 0; size < file.size; size += 7) { // cut anywhere: an error, or what was read before
        tl_imported_mesh mesh;
        tl_result result = import_file("3ds", file.bytes, size, &mesh, NULL);
        TEST_CHECK(result != TL_OK || mesh.triangle_count <= 2);
        tl_imported_mesh_free(&mesh);
    }
}

// What the file said of itself is in the report.
static void test_statements(void **state)
{
    (void)state;
    char text[8192] = FBX_ONE(FBX_AXES("2", "1", "-1") FBX_UNIT("2.54"), FBX_FLOOR, FBX_CORNERS);
    for (char *at = text; *at != 0; at++) {
        *at = *at == '\'' ? '"' : *at;
    }
    tl_imported_mesh mesh;
    TEST_RESULT(import_file("fbx", text, strlen(text), &mesh, NULL), TL_OK);
    TEST_CHECK(near(mesh.file_unit, 0.0254f) && mesh.file_up == 3);
    tl_imported_mesh_free(&mesh);
    static const char stl[] = STL_TEXT;
    TEST_RESULT(import_file("stl", stl, sizeof stl - 1, &mesh, NULL), TL_OK);
    TEST_CHECK(mesh.file_unit == 0.0f && mesh.file_up == 0);
    tl_imported_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_matrix),
        cmocka_unit_test(test_cut_3ds),
        cmocka_unit_test(test_far_nodes),
        cmocka_unit_test(test_statements),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
