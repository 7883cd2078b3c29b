// SPDX-License-Identifier: MIT
//
// How long a bake or check is silent: the CPU time between two calls of progress, on inputs that take seconds. A user
// who cancels waits that long.
//
// The bar is 50 ms with the release's flags on an idle core; here four times as much, and more under sanitizers and
// without optimisation, so that a busy machine fails nothing. `test_silence` prints what it measures. Each operation is
// also cancelled in its middle: it must end at once, and leave nothing.

#include "nav_bake.h"
#include "talus_test.h"

#include <talus/talus.h>

#include <math.h>
#include <string.h>
#include <time.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define IS_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || defined(IS_SANITIZED) || !defined(__OPTIMIZE__)
#define MAX_SILENCE 2.0
#else
#define MAX_SILENCE 0.2
#endif

enum { SIDE = 360 }; // of the terrain, in squares

typedef struct silence {
    clock_t last;
    double longest;
    const char *before, *stage; // the stage in which the longest silence ended, and the newest one
    uint32_t calls, cancel_at;  // 0: never
} silence;

static bool note_call(const char *stage, uint64_t done, uint64_t total, void *user)
{
    silence *s = user;
    const clock_t now = clock();
    const double seconds = (double)(now - s->last) / CLOCKS_PER_SEC;
    TEST_CHECK(done <= total);
    if (seconds > s->longest) {
        s->longest = seconds;
        s->before = stage;
    }
    s->stage = stage;
    s->last = clock();
    return ++s->calls != s->cancel_at;
}

typedef struct silent_world {
    tl_mesh terrain;
    tl_mesh_view view;  // the terrain's triangles
    tl_mesh_view loose; // the same with three vertices each
    tl_vec3 *ball;
    uint32_t ball_count;
    tl_soup *soup;
    tl_navmesh *navmesh; // of pillars on a floor
    tl_soup *floor;
} silent_world;

static silent_world world;

typedef tl_result operation(const tl_host *host);

static void measure(const char *name, operation *run)
{
    silence s;
    memset(&s, 0, sizeof s);
    const tl_progress progress = { note_call, &s };
    const tl_host host = { NULL, NULL, &progress };
    const clock_t begin = clock();
    s.last = begin;
    TEST_RESULT(run(&host), TL_OK);
    (void)note_call("the end", 0, 0, &s);
    print_message("%-16s %6.2f s, %6u calls, silent for %5.1f ms at most, before a call of \"%s\"\n", name,
                  (double)(clock() - begin) / CLOCKS_PER_SEC, s.calls, 1000.0 * s.longest, s.before);
    TEST_CHECK(s.longest <= MAX_SILENCE);
    s.cancel_at = s.calls / 2;
    s.calls = 0;
    TEST_RESULT(run(&host), TL_ERR_CANCELLED);
    assert_int_equal(s.calls, s.cancel_at);
}

// ---- Operations ----------------------------------------------------------------------------------------------------

static tl_result bake_hull(const tl_host *host)
{
    tl_hull *hull = NULL;
    tl_hull_def def = tl_default_hull_def();
    def.host = *host;
    const tl_result result = tl_hull_bake(world.ball, world.ball_count, &def, &hull, NULL);
    TEST_CHECK((hull != NULL) == (result == TL_OK));
    tl_blob_free(hull);
    return result;
}

// Most points are on the surface here, and flat faces are merged.
static tl_result bake_lattice_hull(const tl_host *host)
{
    tl_hull *hull = NULL;
    tl_hull_def def = tl_default_hull_def();
    def.host = *host;
    const tl_result result = tl_hull_bake(world.terrain.vertices, world.terrain.vertex_count, &def, &hull, NULL);
    tl_blob_free(hull);
    return result;
}

static tl_result bake_mesh(const tl_host *host)
{
    tl_mesh mesh;
    tl_mesh_def def = tl_default_mesh_def();
    def.host = *host;
    const tl_result result = tl_mesh_bake(&world.loose, &def, &mesh, NULL);
    tl_mesh_free(&mesh);
    return result;
}

static tl_result bake_adjacency(const tl_host *host)
{
    tl_adjacency adjacency;
    const tl_result result = tl_adjacency_bake(&world.view, host, &adjacency, NULL);
    tl_adjacency_free(&adjacency);
    return result;
}

static tl_result find_closed_parts(const tl_host *host)
{
    tl_closed_parts parts;
    const tl_result result = tl_closed_parts_find(&world.view, host, &parts, NULL);
    tl_closed_parts_free(&parts);
    return result;
}

static tl_result check_closed(const tl_host *host)
{
    const tl_result result = tl_soup_check_closed(world.soup, host, NULL);
    return result == TL_ERR_NOT_CLOSED ? TL_OK : result;
}

static tl_result bake_soup_of(const tl_mesh_view *view, const tl_host *host, tl_soup_layout layout, float split)
{
    tl_soup *soup = NULL;
    tl_soup_def def = tl_default_soup_def();
    def.host = *host;
    def.layout = layout;
    def.split_budget = split;
    const tl_result result = tl_soup_bake(view, &def, &soup, NULL);
    tl_blob_free(soup);
    return result;
}

static tl_result bake_soup(const tl_host *host)
{
    return bake_soup_of(&world.view, host, TL_SOUP_FAST, 0.0f);
}

static tl_result bake_compact_soup(const tl_host *host)
{
    return bake_soup_of(&world.loose, host, TL_SOUP_COMPACT, 0.0f);
}

static tl_result bake_split_soup(const tl_host *host)
{
    return bake_soup_of(&world.view, host, TL_SOUP_FAST, 0.3f);
}

static tl_result bake_navmesh(const tl_host *host)
{
    tl_nav_def def = tl_default_nav_def();
    tl_nav_tiles tiles;
    const tl_nav_input input = { .mesh = world.view };
    def.host = *host;
    def.tile_size = 128;
    const tl_result result = tl_nav_bake(&def, &input, &tiles, NULL);
    tl_nav_tiles_free(&tiles);
    return result;
}

static tl_result prepare_with(const tl_host *host, uint64_t table_bytes)
{
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    def.progress = host->progress;
    def.table_bytes = table_bytes;
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (uint32_t i = 0; i < tl_navmesh_slot_count(world.navmesh); i++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(world.navmesh, i);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_BORROWED), TL_OK);
    }
    const tl_result result = tl_navmesh_prepare(navmesh, &def, NULL);
    TEST_CHECK(tl_navmesh_is_prepared(navmesh) == (result == TL_OK));
    tl_navmesh_destroy(navmesh);
    return result;
}

static tl_result prepare_table(const tl_host *host)
{
    return prepare_with(host, (uint64_t)1 << 30);
}

static tl_result prepare_graph(const tl_host *host)
{
    return prepare_with(host, 0);
}

static tl_result find_links(const tl_host *host)
{
    tl_nav_links *links = NULL;
    tl_nav_links_def def = tl_default_nav_links_def();
    def.host = *host;
    const tl_result result = tl_nav_links_find(&def, world.navmesh, world.floor, &links, NULL);
    tl_blob_free(links);
    return result;
}

static tl_result audit(const tl_host *host)
{
    tl_nav_audit found;
    tl_nav_audit_def def = tl_default_nav_audit_def();
    def.host = *host;
    def.path_count = 300;
    const tl_result result = tl_nav_audit_run(&def, world.navmesh, world.floor, &found, NULL);
    tl_nav_audit_free(&found);
    return result;
}

// All floor is missing: each sample is looked at closely.
static tl_result audit_nothing(const tl_host *host)
{
    tl_nav_audit found;
    tl_nav_audit_def def = tl_default_nav_audit_def();
    def.host = *host;
    const tl_result result = tl_nav_audit_run(&def, NULL, world.floor, &found, NULL);
    tl_nav_audit_free(&found);
    return result;
}

// ---- The world -----------------------------------------------------------------------------------------------------

static void add_box(tl_vec3 *vertices, uint32_t *indices, uint32_t at, tl_aabb box)
{
    static const uint32_t FACES[12][3] = {
        { 0, 2, 1 }, { 1, 2, 3 }, { 4, 5, 6 }, { 5, 7, 6 }, { 0, 1, 4 }, { 1, 5, 4 },
        { 2, 6, 3 }, { 3, 6, 7 }, { 0, 4, 2 }, { 2, 4, 6 }, { 1, 3, 5 }, { 3, 7, 5 }
    };
    for (uint32_t i = 0; i < 8; i++) {
        vertices[8 * at + i] = tl_vec3_make((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                            (i & 4) != 0 ? box.max.z : box.min.z);
    }
    for (uint32_t i = 0; i < 36; i++) {
        indices[36 * at + i] = 8 * at + FACES[i / 3][i % 3];
    }
}

// A slab with pillars on it, for corners to turn at.
static void make_pillars(void)
{
    enum { ROW = 12, COUNT = 1 + ROW * ROW };
    static tl_vec3 vertices[8 * COUNT];
    static uint32_t indices[36 * COUNT];
    const float size = 4.0f * ROW;
    add_box(vertices, indices, 0, (tl_aabb){ { 0, -1, 0 }, { size, 0, size } });
    for (uint32_t i = 1; i < COUNT; i++) {
        const float x = 4.0f * (float)((i - 1) % ROW) + 1.5f, z = 4.0f * (float)((i - 1) / ROW) + 1.2f;
        add_box(vertices, indices, i, (tl_aabb){ { x, -0.5f, z }, { x + 1, 3, z + 1.3f } });
    }
    const tl_mesh_view view = { vertices, 8 * COUNT, indices, 12 * COUNT, NULL };
    const tl_nav_input input = { .mesh = view };
    tl_nav_def def = tl_default_nav_def();
    world.navmesh = test_nav_bake(&def, &input);
    TEST_RESULT(tl_soup_bake(&view, NULL, &world.floor, NULL), TL_OK);
}

static void make_terrain(void)
{
    tl_mesh *mesh = &world.terrain;
    mesh->vertex_count = (SIDE + 1) * (SIDE + 1);
    mesh->triangle_count = 2 * SIDE * SIDE;
    mesh->vertices = test_malloc(mesh->vertex_count * sizeof *mesh->vertices);
    mesh->indices = test_malloc(3 * (size_t)mesh->triangle_count * sizeof *mesh->indices);
    tl_vec3 *loose = test_malloc(3 * (size_t)mesh->triangle_count * sizeof *loose);
    uint32_t *loose_indices = test_malloc(3 * (size_t)mesh->triangle_count * sizeof *loose_indices);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const float x = (float)(i % (SIDE + 1)), z = (float)(i / (SIDE + 1));
        mesh->vertices[i] = tl_vec3_make(0.5f * x, sinf(0.2f * x) * cosf(0.17f * z), 0.5f * z);
    }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE, b = a + 1, c = a + SIDE + 1, d = c + 1;
        const uint32_t corners[6] = { a, c, b, b, c, d };
        memcpy(mesh->indices + 6 * (size_t)i, corners, sizeof corners);
    }
    for (uint32_t i = 0; i < 3 * mesh->triangle_count; i++) {
        loose[i] = mesh->vertices[mesh->indices[i]];
        loose_indices[i] = i;
    }
    const tl_mesh_view view = { mesh->vertices, mesh->vertex_count, mesh->indices, mesh->triangle_count, NULL };
    const tl_mesh_view apart = { loose, 3 * mesh->triangle_count, loose_indices, mesh->triangle_count, NULL };
    world.view = view;
    world.loose = apart;
    TEST_RESULT(tl_soup_bake(&view, NULL, &world.soup, NULL), TL_OK);
}

static int make_world(void **state)
{
    test_random random = { 7 };
    (void)state;
    make_terrain();
    make_pillars();
    world.ball_count = 200000;
    world.ball = test_malloc(world.ball_count * sizeof *world.ball);
    for (uint32_t i = 0; i < world.ball_count; i++) {
        const tl_vec3 d = test_random_direction(&random);
        world.ball[i] = tl_scale(d, (i % 2 == 0 ? 1.0f : test_random_unit(&random)) / sqrtf(tl_length_sq(d)));
    }
    return 0;
}

static int free_world(void **state)
{
    (void)state;
    test_free(world.terrain.vertices);
    test_free(world.terrain.indices);
    test_free((void *)(uintptr_t)world.loose.vertices);
    test_free((void *)(uintptr_t)world.loose.indices);
    test_free(world.ball);
    tl_blob_free(world.soup);
    tl_blob_free(world.floor);
    tl_navmesh_destroy(world.navmesh);
    return 0;
}

static void no_operation_is_silent_for_long(void **state)
{
    (void)state;
    measure("hull, ball", bake_hull);
    measure("hull, terrain", bake_lattice_hull);
    measure("mesh", bake_mesh);
    measure("adjacency", bake_adjacency);
    measure("closed parts", find_closed_parts);
    measure("check closed", check_closed);
    measure("soup", bake_soup);
    measure("compact soup", bake_compact_soup);
    measure("split soup", bake_split_soup);
    measure("navmesh", bake_navmesh);
    measure("prepare, table", prepare_table);
    measure("prepare, graph", prepare_graph);
    measure("links", find_links);
    measure("audit", audit);
    measure("audit, missing", audit_nothing);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(no_operation_is_silent_for_long) };
    return cmocka_run_group_tests(tests, make_world, free_world);
}
