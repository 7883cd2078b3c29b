// SPDX-License-Identifier: MIT
//
// Pruning: hollow solids on an open ground, pillars in a room, a cave in a mountain, roofs that nothing leads to; over
// tiles and in one; and what is left of a random set of islands.

#include "nav_fields.h"
#include "nav_level.h"

#include <talus/nav_prune.h>
#include <talus/nav_query.h>

// A level of boxes whose corners are shared, as in a welded mesh.
typedef struct world {
    test_level level;
    tl_mesh mesh; // welded
} world;

static world W;

static void begin_world(void)
{
    memset(&W, 0, sizeof W);
}

// A box that faces outwards, or inwards as a room.
static void add_box(tl_vec3 low, tl_vec3 high, bool room)
{
    const uint32_t first = W.level.mesh.triangle_count;
    test_level_box(&W.level, low.x, low.y, low.z, high.x, high.y, high.z, high.y);
    for (uint32_t t = first; room && t < W.level.mesh.triangle_count; t++) {
        const uint32_t b = W.level.indices[3 * t + 1];
        W.level.indices[3 * t + 1] = W.level.indices[3 * t + 2];
        W.level.indices[3 * t + 2] = b;
    }
}

static void add_ground(float x0, float z0, float x1, float z1)
{
    test_level_quad(&W.level, tl_vec3_make(x0, 0, z0), tl_vec3_make(x0, 0, z1), tl_vec3_make(x1, 0, z1),
                    tl_vec3_make(x1, 0, z0));
}

static void end_world(void)
{
    W.level.mesh.vertices = W.level.vertices;
    W.level.mesh.indices = W.level.indices;
    TEST_RESULT(tl_mesh_bake(&W.level.mesh, NULL, &W.mesh, NULL), TL_OK);
}

static tl_nav_tiles bake(uint32_t tile_size, const tl_host *host)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.25f;
    def.cell_height = 0.25f;
    def.agent_radius = 0.25f;
    def.tile_size = tile_size;
    if (host != NULL) {
        def.host = *host;
    }
    const tl_nav_input input = { tl_mesh_as_view(&W.mesh), NULL, NULL, 0 };
    tl_nav_tiles tiles;
    TEST_RESULT(tl_nav_bake(&def, &input, &tiles, NULL), TL_OK);
    return tiles;
}

static double area_of(const tl_nav_tiles *tiles)
{
    double area = 0.0;
    for (uint32_t t = 0; t < tiles->tile_count; t++) {
        TEST_RESULT(tl_nav_tile_check(tiles->tiles[t], tiles->tiles[t]->blob.size, NULL), TL_OK);
        area += tiles->tiles[t]->area;
    }
    return area;
}

static bool has_floor(const tl_nav_tiles *tiles, float x, float y, float z)
{
    tl_navmesh *navmesh;
    TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
    for (uint32_t t = 0; t < tiles->tile_count; t++) {
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tiles->tiles[t], TL_NAV_TILE_BORROWED), TL_OK);
    }
    tl_nav_location location;
    const tl_result result =
        tl_navmesh_find_nearest(navmesh, NULL, tl_vec3_make(x, y, z), tl_vec3_make(0.1f, 0.6f, 0.1f), &location);
    tl_navmesh_destroy(navmesh);
    return result == TL_OK;
}

static uint64_t count_flags(const tl_nav_tiles *tiles, uint64_t flags)
{
    uint64_t count = 0;
    for (uint32_t t = 0; t < tiles->tile_count; t++) {
        for (uint32_t p = 0; p < tiles->tiles[t]->polygon_count; p++) {
            count += tl_nav_tile_flags(tiles->tiles[t], p) == flags;
        }
    }
    return count;
}

static tl_nav_prune_report prune(tl_nav_tiles *tiles, const tl_nav_prune_def *def)
{
    tl_nav_prune_report report;
    const double before = area_of(tiles);
    const uint32_t tile_count = tiles->tile_count;
    tl_nav_tiles removed;
    TEST_RESULT(tl_nav_prune(def, tiles, &removed, &report), TL_OK);
    const double left_out = report.inside.area + report.unreachable.area + report.small.area;
    // What is removed is handed over, each polygon with its reason.
    TEST_CHECK(fabs(left_out - area_of(&removed)) < 1e-6 * before);
    TEST_CHECK(removed.tile_count == report.removed_tiles + report.changed_tiles);
    TEST_CHECK(count_flags(&removed, TL_NAV_PRUNED_INSIDE) == report.inside.polygons);
    TEST_CHECK(count_flags(&removed, TL_NAV_PRUNED_UNREACHABLE) == report.unreachable.polygons);
    TEST_CHECK(count_flags(&removed, TL_NAV_PRUNED_SMALL) == report.small.polygons);
    tl_nav_tiles_free(&removed);
    TEST_CHECK(fabs(before - left_out - area_of(tiles)) < 1e-6 * before);
    TEST_CHECK(tiles->tile_count + report.removed_tiles == tile_count);
    return report;
}

// Ground of 30 by 12 m; on it a hollow box of 6 by 6 m, and one of the same size that lacks its top.
static void make_hollow_boxes(void)
{
    begin_world();
    add_ground(0, 0, 30, 12);
    add_box(tl_vec3_make(3, -1, 3), tl_vec3_make(9, 4, 9), false);
    add_box(tl_vec3_make(15, -1, 3), tl_vec3_make(21, 4, 9), false);
    W.level.indices[3 * (2 + 12)] = W.level.indices[3 * (2 + 12) + 1]; // the second box's first triangle is its top's
    end_world();
}

static void floors_inside_solids_go(void **state)
{
    (void)state;
    for (uint32_t tile_size = 0; tile_size <= 40; tile_size += 20) {
        make_hollow_boxes();
        tl_nav_tiles tiles = bake(tile_size, NULL);
        TEST_CHECK(has_floor(&tiles, 6, 0.3f, 6) && has_floor(&tiles, 18, 0.3f, 6) && has_floor(&tiles, 6, 4.3f, 6));
        const tl_mesh_view view = tl_mesh_as_view(&W.mesh);
        tl_nav_prune_def def = tl_default_nav_prune_def();
        def.solids = &view;
        const tl_nav_prune_report report = prune(&tiles, &def);
        TEST_CHECK(report.solid_count == 1 && report.inside.islands == 1 && report.inside.polygons >= 1);
        TEST_CHECK(report.inside.area > 20.0 && report.inside.area < 36.0 && report.unreachable.islands == 0);
        TEST_CHECK(!has_floor(&tiles, 6, 0.3f, 6));                                       // in the solid
        TEST_CHECK(has_floor(&tiles, 18, 0.3f, 6));                                       // in one with a hole
        TEST_CHECK(has_floor(&tiles, 6, 4.3f, 6) && has_floor(&tiles, 1.5f, 0.3f, 1.5f)); // on the roof, outside
        tl_nav_tiles_free(&tiles);
        tl_mesh_free(&W.mesh);
    }
}

// A mountain with a cave, in the cave a pillar, and in the pillar a cellar.
static void the_innermost_surface_decides(void **state)
{
    (void)state;
    begin_world();
    add_box(tl_vec3_make(0, -1, 0), tl_vec3_make(40, 12, 40), false);
    add_box(tl_vec3_make(5, 0, 5), tl_vec3_make(35, 8, 35), true);
    add_box(tl_vec3_make(10, -0.5f, 10), tl_vec3_make(25, 9, 25), false);
    add_box(tl_vec3_make(12, 2, 12), tl_vec3_make(16, 6, 16), true);
    add_ground(10.5f, 10.5f, 24.5f, 24.5f); // what the pillar hides
    end_world();
    const tl_mesh_view view = tl_mesh_as_view(&W.mesh);
    tl_nav_tiles tiles = bake(0, NULL);
    TEST_CHECK(has_floor(&tiles, 7, 0.3f, 7) && has_floor(&tiles, 14, 2.3f, 14) && has_floor(&tiles, 20, 0.3f, 20));
    TEST_CHECK(has_floor(&tiles, 20, 12.3f, 20));
    tl_nav_prune_def def = tl_default_nav_prune_def();
    def.solids = &view;
    const tl_nav_prune_report report = prune(&tiles, &def);
    TEST_CHECK(report.solid_count == 2 && report.inside.islands >= 1);
    TEST_CHECK(has_floor(&tiles, 20, 12.3f, 20)); // on the mountain
    TEST_CHECK(has_floor(&tiles, 7, 0.3f, 7));    // in the cave
    TEST_CHECK(!has_floor(&tiles, 20, 0.3f, 20)); // in the pillar
    TEST_CHECK(has_floor(&tiles, 14, 2.3f, 14));  // in its cellar
    tl_nav_tiles_free(&tiles);
    tl_mesh_free(&W.mesh);
}

static void islands_without_a_seed_go(void **state)
{
    (void)state;
    for (uint32_t tile_size = 0; tile_size <= 40; tile_size += 20) {
        make_hollow_boxes();
        tl_nav_tiles tiles = bake(tile_size, NULL);
        const tl_vec3 seeds[2] = { { 1.5f, 0.5f, 1.5f }, { 6, 4, 6 } };
        tl_nav_prune_def def = tl_default_nav_prune_def();
        def.seed_extents = tl_vec3_make(0.5f, 1, 0.5f);
        def.seeds = seeds;
        def.seed_count = 2;
        const tl_nav_prune_report report = prune(&tiles, &def);
        TEST_CHECK(report.island_count >= 4 && report.unreachable.islands == report.island_count - 2);
        TEST_CHECK(has_floor(&tiles, 1.5f, 0.3f, 1.5f) && has_floor(&tiles, 28, 0.3f, 10)); // hang together over tiles
        TEST_CHECK(has_floor(&tiles, 6, 4.3f, 6));                                          // a seed's own roof
        TEST_CHECK(!has_floor(&tiles, 6, 0.3f, 6) && !has_floor(&tiles, 18, 0.3f, 6));
        // Pruned again nothing changes; and a seed keeps what is inside, or small.
        const tl_mesh_view view = tl_mesh_as_view(&W.mesh);
        def.solids = &view;
        def.min_area = 1e6;
        const tl_nav_prune_report again = prune(&tiles, &def);
        TEST_CHECK(again.island_count == 2 && again.changed_tiles == 0 && again.removed_tiles == 0);
        // Without seeds everything is small.
        def.seed_count = 0;
        const tl_nav_prune_report all = prune(&tiles, &def);
        TEST_CHECK(all.small.islands == 2 && tiles.tile_count == 0);
        tl_nav_tiles_free(&tiles);
        tl_mesh_free(&W.mesh);
    }
}

static void what_is_wrong_is_named(void **state)
{
    (void)state;
    make_hollow_boxes();
    tl_nav_tiles tiles = bake(20, NULL);
    const double before = area_of(&tiles);
    const tl_vec3 seeds[2] = { { 1.5f, 0.5f, 1.5f }, { 6, 400, 6 } };
    tl_nav_prune_def def = tl_default_nav_prune_def();
    tl_nav_prune_report report;
    def.seeds = seeds;
    def.seed_count = 2;
    TEST_RESULT(tl_nav_prune(&def, &tiles, NULL, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(report.base.element_index == 1);
    assert_string_equal(report.base.element, "seed");
    def.seed_count = 0;
    def.min_area = -1.0;
    TEST_RESULT(tl_nav_prune(&def, &tiles, NULL, &report), TL_ERR_ARGUMENT);
    def.min_area = (double)NAN;
    TEST_RESULT(tl_nav_prune(&def, &tiles, NULL, NULL), TL_ERR_ARGUMENT);
    def.min_area = 0.0;
    def.seed_extents.y = -1.0f;
    TEST_RESULT(tl_nav_prune(&def, &tiles, NULL, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.base.field, "seed_extents");
    def = tl_default_nav_prune_def();
    tl_nav_tile *twice[2] = { tiles.tiles[0], tiles.tiles[0] };
    tl_nav_tiles same = { .tiles = twice, .tile_count = 2, .tiles_x = 1, .tiles_z = 1 };
    TEST_RESULT(tl_nav_prune(&def, &same, NULL, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(report.base.element_index == 1);
    TEST_CHECK(area_of(&tiles) == before);
    tl_nav_tiles_free(&tiles);
    tl_mesh_free(&W.mesh);
}

static void no_tiles_are_no_trouble(void **state)
{
    (void)state;
    tl_nav_tiles none = { 0 };
    const tl_nav_prune_def def = tl_default_nav_prune_def();
    TEST_RESULT(tl_nav_prune(&def, &none, NULL, NULL), TL_OK);
    tl_nav_tiles_free(&none);
}

// Fails the k-th allocation, or stops at the k-th call of the progress hook.
static tl_result prune_until(test_allocator *memory, const tl_progress *progress)
{
    const tl_mesh_view view = tl_mesh_as_view(&W.mesh);
    const uint64_t fail_at = memory->fail_at;
    memory->fail_at = 0;
    tl_host host = { &memory->allocator, NULL, NULL };
    tl_nav_tiles tiles = bake(20, &host);
    const double before = area_of(&tiles);
    memory->fail_at = fail_at > 0 ? memory->calls + fail_at : 0;
    tl_nav_prune_def def = tl_default_nav_prune_def();
    def.solids = &view;
    def.min_area = 30.0;
    def.host = host;
    def.host.progress = progress;
    tl_nav_tiles removed;
    const tl_result result = tl_nav_prune(&def, &tiles, &removed, NULL);
    TEST_CHECK((area_of(&tiles) < before) == (result == TL_OK));
    TEST_CHECK((removed.tile_count > 0) == (result == TL_OK));
    tl_nav_tiles_free(&removed);
    tl_nav_tiles_free(&tiles);
    TEST_CHECK(memory->live_blocks == 0 && memory->live_bytes == 0);
    return result;
}

static void failures_change_nothing(void **state)
{
    (void)state;
    make_hollow_boxes();
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        const tl_result result = prune_until(&memory, NULL);
        if (result == TL_OK) {
            TEST_CHECK(k > 30);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
    for (uint32_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        test_progress progress;
        test_progress_init(&progress, k);
        const tl_result result = prune_until(&memory, &progress.progress);
        if (result == TL_OK) {
            TEST_CHECK(k > 2);
            break;
        }
        TEST_RESULT(result, TL_ERR_CANCELLED);
    }
    tl_mesh_free(&W.mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floors_inside_solids_go),   cmocka_unit_test(the_innermost_surface_decides),
        cmocka_unit_test(islands_without_a_seed_go), cmocka_unit_test(what_is_wrong_is_named),
        cmocka_unit_test(no_tiles_are_no_trouble),   cmocka_unit_test(failures_change_nothing)
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
