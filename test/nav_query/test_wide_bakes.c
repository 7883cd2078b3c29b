// SPDX-License-Identifier: MIT
//
// One mesh for three radii against a bake for each: whether there is a way between two places must be the same.
//
// It cannot be the same everywhere: a bake takes the radius off in whole cells, and simplifies its own outlines by up
// to edge_max_error cells. So a passage about as wide as the agent is may be open in one and closed in the other. Pairs
// that differ are asked again with a radius a little smaller and larger: where one of these gives the bake's answer,
// the difference is that of a bottleneck within so many cells of the radius; all others are counted as unexplained.
//
//   test_wide_bakes         a small level
//   test_wide_bakes PAIRS   PAIRS pairs a radius on the built-in levels and those of the data folder

#include "cli/sample/sample_level.h"
#include "io/mesh/mesh_import.h"
#include "nav_bake.h"
#include "nav_level.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <talus/nav_wide.h>

enum { CAPACITY = 4096 };

static const float CELL = 0.15f, RADII[3] = { 0.3f, 0.6f, 1.2f };
static uint32_t g_pairs = 0;

static tl_navmesh *bake(const tl_mesh_view *mesh, float radius, uint32_t tile_size)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = CELL;
    def.cell_height = 0.1f;
    def.agent_radius = radius;
    def.tile_size = tile_size;
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = *mesh;
    return test_nav_bake(&def, &input);
}

// Places on a navmesh, uniform by area.
typedef struct floor_area {
    const tl_navmesh *navmesh;
    tl_nav_ref *refs;
    double *sums; // square metres, up to each polygon
    uint32_t count;
} floor_area;

static floor_area measure(const tl_navmesh *navmesh)
{
    floor_area area = { navmesh, NULL, NULL, 0 };
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        uint32_t count = tile != NULL ? tile->polygon_count : 0;
        area.refs = realloc(area.refs, (area.count + count + 1u) * sizeof *area.refs);
        area.sums = realloc(area.sums, (area.count + count + 1u) * sizeof *area.sums);
        for (uint32_t p = 0; p < count; p++) {
            double before = area.count > 0 ? area.sums[area.count - 1] : 0.0;
            area.refs[area.count] = tl_navmesh_polygon_ref(navmesh, slot, p);
            area.sums[area.count++] = before + tl_nav_tile_polygon_area(tile, p);
        }
    }
    return area;
}

static double plan_area(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    return 0.5 * fabs(((double)b.x - (double)a.x) * ((double)c.z - (double)a.z) -
                      ((double)b.z - (double)a.z) * ((double)c.x - (double)a.x));
}

static tl_nav_location random_place(const floor_area *area, test_random *random)
{
    double at = (double)test_random_unit(random) * area->sums[area->count - 1];
    uint32_t low = 0, high = area->count - 1;
    while (low < high) {
        uint32_t middle = (low + high) / 2;
        if (area->sums[middle] < at) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    const tl_nav_tile *tile = NULL;
    uint32_t polygon = 0, count = 0, k = 1;
    TEST_RESULT(tl_navmesh_resolve(area->navmesh, area->refs[low], &tile, &polygon), TL_OK);
    const tl_vec3 *c = tl_nav_tile_corners(tile, polygon, &count);
    double left = (double)test_random_unit(random) * tl_nav_tile_polygon_area(tile, polygon);
    while (k + 2 < count && left > plan_area(c[0], c[k], c[k + 1])) {
        left -= plan_area(c[0], c[k], c[k + 1]);
        k++;
    }
    float u = test_random_unit(random), v = test_random_unit(random);
    if (u + v > 1.0f) {
        u = 1.0f - u;
        v = 1.0f - v;
    }
    tl_vec3 point = tl_mul_add(tl_mul_add(c[0], tl_sub(c[k], c[0]), u), tl_sub(c[k + 1], c[0]), v);
    tl_nav_location place = { area->refs[low], point };
    TEST_RESULT(tl_navmesh_closest_point(area->navmesh, place.polygon, point, &place.point, NULL), TL_OK);
    return place;
}

// How far from a place both look for room, on the mesh of the smallest radius: as far as the radius differs, and two
// cells. A bake that has dropped a small island would else be asked from another one.
static float near_by(float radius)
{
    return radius - RADII[0] + 2.0f * CELL;
}

static bool baked_way(const tl_navmesh *navmesh, float radius, const tl_nav_location *a, const tl_nav_location *b)
{
    const tl_vec3 extents = { near_by(radius), 1.0f, near_by(radius) };
    tl_nav_location start, goal;
    uint32_t from = 0, to = 0;
    if (tl_navmesh_find_nearest(navmesh, NULL, a->point, extents, &start) != TL_OK ||
        tl_navmesh_find_nearest(navmesh, NULL, b->point, extents, &goal) != TL_OK) {
        return false;
    }
    TEST_RESULT(tl_navmesh_island(navmesh, start.polygon, &from), TL_OK);
    TEST_RESULT(tl_navmesh_island(navmesh, goal.polygon, &to), TL_OK);
    return from == to;
}

typedef struct tally {
    uint32_t pairs, ways, same;
    uint32_t within[3]; // differences by one, two, three cells of the radius
    uint32_t others;
    double min_room; // metres between a path and the walls that are missing to the radius
} tally;

// `t` NULL: only whether there is a way.
static bool wide_way(tl_nav_query *query, const tl_navmesh *navmesh, float radius, float near, const tl_nav_location *a,
                     const tl_nav_location *b, tally *t)
{
    static tl_nav_corner corners[CAPACITY];
    tl_nav_location start, goal;
    tl_nav_wide_path path;
    if (tl_nav_query_find_wide_place(query, navmesh, &(tl_nav_around_request){ NULL, *a, near }, radius, &start) !=
            TL_OK ||
        tl_nav_query_find_wide_place(query, navmesh, &(tl_nav_around_request){ NULL, *b, near }, radius, &goal) !=
            TL_OK) {
        return false;
    }
    TEST_RESULT(tl_nav_query_find_wide_path(query, navmesh, &(tl_nav_path_request){ NULL, start, goal }, radius,
                                            corners, CAPACITY, &path),
                TL_OK);
    if (path.status > 1)
        printf("%s at %.9g %.9g -> %.9g %.9g, radius %g, near %.9g %.9g\n", tl_nav_wide_status_name(path.status),
               (double)start.point.x, (double)start.point.z, (double)goal.point.x, (double)goal.point.z, (double)radius,
               (double)a->point.x, (double)a->point.z);
    TEST_CHECK(path.status == TL_NAV_WIDE_COMPLETE || path.status == TL_NAV_WIDE_UNREACHABLE);
    if (t != NULL && path.status == TL_NAV_WIDE_COMPLETE && radius > RADII[0]) {
        float clearance = 0.0f, reach = radius - RADII[0];
        TEST_RESULT(
            tl_nav_query_path_clearance(query, navmesh, NULL, corners, path.corner_count, 2.0f * reach, &clearance),
            TL_OK);
        t->min_room = fmin(t->min_room, (double)clearance - (double)reach);
        TEST_CHECK((double)clearance >= path.wall_distance * (1.0 - 1e-6));
        TEST_CHECK(clearance >= reach - CELL);
    }
    return path.status == TL_NAV_WIDE_COMPLETE;
}

static void compare_pair(tl_nav_query *query, const tl_navmesh *own, const tl_navmesh *baked, float radius,
                         const floor_area *area, test_random *random, tally *t)
{
    tl_nav_location a = random_place(area, random), b = random_place(area, random);
    bool wanted = baked_way(baked, radius, &a, &b), found = wide_way(query, own, radius, near_by(radius), &a, &b, t);
    t->pairs++;
    t->ways += wanted ? 1u : 0u;
    t->same += wanted == found ? 1u : 0u;
    for (uint32_t k = 0; wanted != found && k < 4; k++) {
        float other = wanted ? radius - (float)(k + 1) * CELL : radius + (float)(k + 1) * CELL;
        if (k == 3) {
            t->others++;
        } else if (wide_way(query, own, other, near_by(radius), &a, &b, NULL) == wanted) {
            t->within[k]++;
            break;
        }
    }
}

static void compare_level(const char *name, const tl_mesh_view *mesh, uint32_t tile_size, uint32_t pairs)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query = NULL;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_navmesh *own = bake(mesh, RADII[0], tile_size);
    floor_area area = measure(own);
    for (uint32_t i = 0; i < 3; i++) {
        tl_navmesh *baked = bake(mesh, RADII[i], tile_size);
        test_random random = { 17 + i };
        tally t = { 0, 0, 0, { 0, 0, 0 }, 0, 1e9 };
        for (uint32_t k = 0; k < pairs; k++) {
            compare_pair(query, own, baked, RADII[i], &area, &random, &t);
        }
        printf("%s, tiles of %u, radius %.1f: %.2f%% of %u pairs as in the bake (%u ways); differ: %u by a bottleneck "
               "within 1 cell of the radius, %u within 2, %u within 3, %u others; room %+.4f m\n",
               name, tile_size, (double)RADII[i], 100.0 * t.same / t.pairs, t.pairs, t.ways, t.within[0], t.within[1],
               t.within[2], t.others, i > 0 ? t.min_room : 0.0);
        fflush(stdout);
        TEST_CHECK(100 * t.same >= 97 * t.pairs && 200 * t.others <= t.pairs);
        tl_navmesh_destroy(baked);
    }
    free(area.refs);
    free(area.sums);
    tl_nav_query_destroy(query);
    tl_navmesh_destroy(own);
}

static void test_small_level(void **state)
{
    (void)state;
    static test_level level;
    test_level_make(&level, tl_vec3_make(3.3f, 0, -7.7f));
    compare_level("small", &level.mesh, 0, 300);
    compare_level("small", &level.mesh, 48, 300);
}

static void test_all_levels(void **state)
{
    (void)state;
    const char *const names[] = {
        "nav_test", "dungeon", "undulating", "test_map01", "collision_mesh_01", "proto-level"
    };
    const char *const built_in[] = { "dungeon", "courtyard" };
    for (uint32_t i = 0; g_pairs > 0 && i < sizeof built_in / sizeof *built_in; i++) {
        const tl_sample_level *level = tl_sample_find_level(built_in[i]);
        tl_sample_mesh mesh;
        char name[64];
        TEST_RESULT(tl_sample_build_level(level, 20000, 1, &mesh), TL_OK);
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        snprintf(name, sizeof name, "built-in %s", built_in[i]);
        compare_level(name, &view, 128, g_pairs);
        tl_sample_mesh_free(&mesh);
    }
    for (uint32_t i = 0; g_pairs > 0 && i < sizeof names / sizeof *names; i++) {
        char path[512];
        tl_imported_mesh mesh;
        snprintf(path, sizeof path, "%s/levels/%s.obj", TALUS_DATA_DIR, names[i]);
        if (tl_import_mesh(path, NULL, &mesh, NULL) != TL_OK) {
            continue;
        }
        tl_mesh_view view = tl_imported_mesh_as_view(&mesh);
        compare_level(names[i], &view, 128, g_pairs);
        tl_imported_mesh_free(&mesh);
    }
}

int main(int argc, char **argv)
{
    g_pairs = argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_small_level),
        cmocka_unit_test(test_all_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
