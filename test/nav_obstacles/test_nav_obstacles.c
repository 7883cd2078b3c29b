// SPDX-License-Identifier: MIT
//
// Temporary obstacles: the same bytes as a bake with those volumes, whatever came and went before; floors and
// names kept right under random edits.

#include "backward_tasks.h"
#include "nav_obstacles/footprint.h"
#include "nav_obstacles/unpacked_tiles.h"
#include "obstacle_world.h"

#include <math.h>
#include <stdlib.h>
#include <talus/nav_around.h>
#include <talus/nav_obstacles.h>

static bool same_tile(const tl_nav_tile *a, const tl_nav_tile *b)
{
    return (a == NULL) == (b == NULL) &&
           (a == NULL || (a->blob.size == b->blob.size && memcmp(a, b, a->blob.size) == 0));
}

// Every tile of the navmesh is that of a bake with the volumes given.
static void check_against_bake(const world *w, const tl_nav_volume *volumes, uint32_t volume_count)
{
    tl_nav_input input = w->input;
    input.volumes = volumes;
    input.volume_count = volume_count;
    tl_nav_tile_range all = { 0, 0, 0, 0 };
    tl_nav_tile_block block;
    TEST_RESULT(tl_nav_tile_grid(&w->def, w->def.bounds, &all.count_x, &all.count_z, NULL), TL_OK);
    TEST_RESULT(tl_nav_bake_range(&w->def, &input, all, NULL, &block, NULL), TL_OK);
    uint32_t count = 0;
    for (uint32_t i = 0; i < all.count_x * all.count_z; i++) {
        const int32_t x = (int32_t)(i % all.count_x), z = (int32_t)(i / all.count_x);
        for (uint32_t k = 0; k < block.stacks[i].count; k++, count++) {
            const tl_nav_tile *tile = block.stacks[i].tiles[k];
            TEST_CHECK(same_tile(tl_navmesh_find_layer(w->navmesh, x, tile->layer, z), tile));
        }
    }
    TEST_CHECK(count == tl_navmesh_tile_count(w->navmesh));
    tl_nav_tile_block_free(&block);
}

// An area is a volume of the bake.
static void test_volumes(void **state)
{
    (void)state;
    world w;
    make_world(&w, NULL);
    check_against_bake(&w, NULL, 0);
    tl_nav_volume volumes[3];
    memset(volumes, 0, sizeof volumes);
    volumes[0].kind = volumes[1].kind = TL_NAV_VOLUME_CYLINDER;
    volumes[0].area = 5;
    volumes[0].base = tl_vec3_make(7.3f, -0.1f, 8.1f);
    volumes[0].radius = 2.4f;
    volumes[0].height = 1.0f;
    volumes[1].area = 7;
    volumes[1].base = tl_vec3_make(14.2f, -0.05f, 9.3f);
    volumes[1].radius = 1.5f;
    volumes[1].height = 1.0f;
    volumes[2].kind = TL_NAV_VOLUME_BOX;
    volumes[2].area = 9;
    volumes[2].box.min = tl_vec3_make(1.13f, -0.3f, 8.2f);
    volumes[2].box.max = tl_vec3_make(5.37f, 0.7f, 14.4f);
    tl_nav_obstacle wanted[3] = {
        cylinder(5, volumes[0].base, 2.4f, 1.0f),
        cylinder(7, tl_vec3_make(14.2f, -0.05f, 9.3f), 1.5f, 1.0f),
        box(9, tl_vec3_make(3.25f, -0.3f, 11.3f), 2.12f, 3.1f, 1.0f),
    };
    tl_nav_obstacle_id ids[3];
    for (int i = 0; i < 3; i++) {
        TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &wanted[i], &ids[i], NULL), TL_OK);
        settle(&w);
        check_against_bake(&w, volumes, (uint32_t)i + 1);
    }
    TEST_CHECK(tl_nav_obstacles_count(w.obstacles) == 3);
    // Elsewhere and back: as if nothing had been.
    tl_nav_obstacle moved = wanted[1];
    moved.base.x += 4.0f;
    TEST_RESULT(tl_nav_obstacles_move(w.obstacles, ids[1], &moved, NULL), TL_OK);
    settle(&w);
    TEST_RESULT(tl_nav_obstacles_move(w.obstacles, ids[1], &wanted[1], NULL), TL_OK);
    settle(&w);
    check_against_bake(&w, volumes, 3);
    for (int i = 3; i-- > 0;) {
        TEST_RESULT(tl_nav_obstacles_remove(w.obstacles, ids[i]), TL_OK);
        settle(&w);
        check_against_bake(&w, volumes, (uint32_t)i);
        TEST_RESULT(tl_nav_obstacles_remove(w.obstacles, ids[i]), TL_ERR_STALE);
        TEST_RESULT(tl_nav_obstacles_move(w.obstacles, ids[i], &moved, NULL), TL_ERR_STALE);
    }
    free_world(&w);
}

// How far the square around a point is from it: of its points those of a grid are looked at.
static double square_distance(const tl_nav_obstacle *o, double x, double z, double size, double at_middle)
{
    enum { GRID = 8 };
    double nearest = at_middle;
    for (int i = 0; i <= GRID; i++) {
        for (int k = 0; k <= GRID; k++) {
            const bool is_border = i == 0 || k == 0 || i == GRID || k == GRID;
            const double px = x + ((double)i / GRID - 0.5) * size, pz = z + ((double)k / GRID - 0.5) * size;
            nearest = is_border ? fmin(nearest, outline_distance(o, px, pz)) : nearest;
        }
    }
    return nearest;
}

// Each walkable floor of a field, marked by one obstacle: by the definition, except within a hair of its limits.
static void test_marks(void **state)
{
    (void)state;
    test_random random = { 21 };
    test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_def def = make_def();
    def.tile_size = 0;
    tl_nav_config config;
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    tl_nav_tile *tile;
    TEST_RESULT(tl_nav_config_from_def(&def, def.bounds, 0, 0, &config, NULL), TL_OK);
    TEST_RESULT(tl_nav_tile_bake(&config, &input, NULL, &stages, &tile, NULL), TL_OK);
    tl_nav_compact *compact = &stages.compact;
    uint8_t *base = malloc(compact->span_count);
    memcpy(base, compact->area, compact->span_count);
    uint64_t marked[3] = { 0, 0, 0 }, left = 0, close = 0, by_height = 0;
    for (int round = 0; round < 300; round++) {
        tl_nav_obstacle o = random_obstacle(&random);
        TEST_RESULT(tl_obstacle_check(&o, NULL), TL_OK);
        bool body = o.area == TL_NAV_NULL_AREA;
        double grow = body ? (double)def.agent_radius : 0.0;
        double low = (double)o.base.y - (body ? (double)def.agent_height : 0.0);
        double high = (double)o.base.y + (double)o.height;
        tl_aabb bounds = tl_obstacle_box(&o, def.agent_radius, def.agent_height);
        memcpy(compact->area, base, compact->span_count);
        tl_obstacle_mark(&o, def.agent_radius, def.agent_height, compact);
        for (uint32_t column = 0; column < compact->width * compact->height; column++) {
            double x = (double)def.bounds.min.x + ((double)(column % compact->width) + 0.5) * (double)def.cell_size;
            double z = (double)def.bounds.min.z + ((double)(column / compact->width) + 0.5) * (double)def.cell_size;
            bool beside = x < (double)bounds.min.x || x > (double)bounds.max.x || z < (double)bounds.min.z ||
                          z > (double)bounds.max.z;
            // Most columns lie far away; in some rounds they are asked all the same.
            bool far = x < (double)bounds.min.x - 1.0 || x > (double)bounds.max.x + 1.0 ||
                       z < (double)bounds.min.z - 1.0 || z > (double)bounds.max.z + 1.0;
            bool skip = body ? far && round % 16 != 0 : beside;
            double distance = skip ? 1e9 : outline_distance(&o, x, z);
            if (body && distance >= grow && distance < grow + 0.75 * (double)def.cell_size) {
                distance = square_distance(&o, x, z, (double)def.cell_size, distance);
            } else if (body && distance >= grow) {
                distance = 1e9;
            }
            for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
                double y = (double)def.bounds.min.y + (double)compact->floor[i] * (double)def.cell_height;
                bool near_limit = fabs(distance - grow) < 3e-2 || fabs(y - low) < 1e-4 || fabs(y - high) < 1e-4;
                bool in = distance < grow && y > low && y < high;
                uint8_t expected = in && base[i] != TL_NAV_NULL_AREA ? o.area : base[i];
                close += near_limit;
                TEST_CHECK(near_limit || compact->area[i] == expected);
                marked[o.shape] += !near_limit && expected != base[i];
                left += !near_limit && !in;
                by_height += distance < grow && !in && !near_limit;
            }
        }
    }
    TEST_CHECK(marked[0] > 500 && marked[1] > 500 && marked[2] > 500);
    TEST_CHECK(left > 100000 && by_height > 500 && close > 100 && close < left / 50);
    free(base);
    tl_blob_free(tile);
    tl_nav_stages_free(&stages);
}

// Of any kind: tilted boxes and capsules too.
static tl_nav_obstacle random_obstacle_at_any_pose(test_random *random)
{
    tl_nav_obstacle o = random_obstacle(random);
    if (test_random_below(random, 2) == 0) {
        return o;
    }
    const tl_vec3 axis = test_random_direction(random), half = tl_vec3_make(0.3f + o.half_x, 0.2f, 0.3f + o.half_z);
    const tl_quat turn = { axis.x, axis.y, axis.z, test_random_range(random, -1.0f, 1.0f) };
    o.shape = TL_NAV_OBSTACLE_CONVEX;
    o.pose.position = o.base;
    o.pose.rotation = tl_quat_normalize(turn);
    o.convex = test_random_below(random, 2) == 0 ? tl_convex_box(tl_vec3_make(0, 0, 0), half, 0.0f)
                                                 : tl_convex_capsule(tl_neg(half), half, 0.3f);
    return o;
}

// Whatever comes, moves and goes, in whatever order: the same bytes as when only what is left had come.
static void test_random_edits(void **state)
{
    (void)state;
    enum { EDITS = 1000, CAPACITY = 24 };
    const char *asked = getenv("TALUS_EDITS"); // many more, and others
    const int edits = asked != NULL ? atoi(asked) : EDITS;
    world w, other;
    make_world(&w, NULL);
    tl_nav_obstacle there[CAPACITY];
    tl_nav_obstacle_id ids[CAPACITY], other_id;
    uint32_t count = 0, added = 0, moved = 0, removed = 0, compared = 0;
    test_random random = { asked != NULL ? (uint64_t)edits : 3 };
    tl_tasks tasks;
    for (int edit = 0; edit < edits; edit++) {
        if (edit % 50 == 0) { // in turn without tasks, and by other numbers of workers
            test_backward_tasks(&tasks, 1 + test_random_below(&random, 5));
            TEST_RESULT(tl_nav_obstacles_set_tasks(w.obstacles, edit % 100 == 0 ? NULL : &tasks), TL_OK);
        }
        uint32_t what = test_random_below(&random, 3);
        if (count == 0 || (what == 0 && count < CAPACITY)) {
            there[count] = random_obstacle_at_any_pose(&random);
            TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &there[count], &ids[count], NULL), TL_OK);
            count++;
            added++;
        } else {
            uint32_t which = test_random_below(&random, count);
            if (what == 1) {
                there[which] = random_obstacle_at_any_pose(&random);
                TEST_RESULT(tl_nav_obstacles_move(w.obstacles, ids[which], &there[which], NULL), TL_OK);
                moved++;
            } else {
                TEST_RESULT(tl_nav_obstacles_remove(w.obstacles, ids[which]), TL_OK);
                there[which] = there[--count];
                ids[which] = ids[count];
                removed++;
            }
        }
        TEST_CHECK(tl_nav_obstacles_count(w.obstacles) == count);
        if (test_random_below(&random, 4) == 0) { // several edits may wait together
            TEST_RESULT(tl_nav_obstacles_update(w.obstacles, w.navmesh, test_random_below(&random, 6), NULL, NULL),
                        TL_OK);
        }
        if (edit % 50 != 49) {
            continue;
        }
        settle(&w);
        make_world(&other, NULL);
        for (uint32_t i = count; i-- > 0;) { // in the other order
            TEST_RESULT(tl_nav_obstacles_add(other.obstacles, &there[i], &other_id, NULL), TL_OK);
        }
        settle(&other);
        TEST_CHECK(tl_navmesh_tile_count(w.navmesh) == tl_navmesh_tile_count(other.navmesh));
        for (uint32_t slot = 0; slot < tl_navmesh_slot_count(w.navmesh); slot++) {
            const tl_nav_tile *tile = tl_navmesh_slot_tile(w.navmesh, slot);
            if (tile != NULL) {
                TEST_CHECK(
                    same_tile(tile, tl_navmesh_find_layer(other.navmesh, tile->tile_x, tile->layer, tile->tile_z)));
                TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
                compared++;
            }
        }
        free_world(&other);
    }
    TEST_CHECK(added > 200 && moved > 200 && removed > 200 && compared > 150);
    free_world(&w);
}

// The level itself changes under the obstacles.
static void test_rebake(void **state)
{
    (void)state;
    world w;
    make_world(&w, NULL);
    tl_nav_obstacle_id id;
    tl_nav_obstacle danger = cylinder(5, tl_vec3_make(7.3f, -0.1f, 8.1f), 2.4f, 1.0f);
    TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &danger, &id, NULL), TL_OK);
    settle(&w);
    test_level_box(&w.level, 6, 0, 7, 8, 2.0f, 9.5f, 2.0f);
    w.input.mesh = w.level.mesh;
    tl_aabb changed = { { 6, 0, 7 }, { 8, 2, 9.5f } };
    TEST_RESULT(tl_nav_obstacles_rebake(w.obstacles, &w.input, changed, NULL), TL_OK);
    TEST_CHECK(tl_nav_obstacles_waiting(w.obstacles) > 0);
    settle(&w);
    tl_nav_volume volume;
    memset(&volume, 0, sizeof volume);
    volume.kind = TL_NAV_VOLUME_CYLINDER;
    volume.area = 5;
    volume.base = danger.base;
    volume.radius = danger.radius;
    volume.height = danger.height;
    check_against_bake(&w, &volume, 1);
    tl_aabb elsewhere = { { 900, 0, 7 }, { 901, 2, 9.5f } };
    TEST_RESULT(tl_nav_obstacles_rebake(w.obstacles, &w.input, elsewhere, NULL), TL_OK);
    TEST_CHECK(tl_nav_obstacles_waiting(w.obstacles) == 0);
    free_world(&w);
}

static void test_refusals(void **state)
{
    (void)state;
    world w;
    make_world(&w, NULL);
    const tl_nav_obstacle good = cylinder(0, tl_vec3_make(5, 0, 5), 1.0f, 1.0f);
    tl_nav_obstacle_id id;
    for (int i = 0; i < 12; i++) {
        tl_nav_obstacle bad = i < 4 ? good : box(0, tl_vec3_make(5, 0, 5), 1.0f, 1.0f, 1.0f);
        tl_result expected = TL_ERR_ARGUMENT;
        switch (i) {
        case 0:
            bad.radius = 0.0f;
            break;
        case 1:
            bad.height = -1.0f;
            break;
        case 2:
            bad.radius = NAN;
            break;
        case 3:
            bad.base.x = NAN;
            expected = TL_ERR_NOT_FINITE;
            break;
        case 4:
            bad.half_x = -1.0f;
            break;
        case 5:
            bad.half_z = INFINITY;
            break;
        case 6:
            bad.cosine = NAN;
            expected = TL_ERR_NOT_FINITE;
            break;
        case 7:
            bad.shape = (tl_nav_obstacle_shape)9;
            break;
        default:
            bad.shape = TL_NAV_OBSTACLE_PRISM;
            bad.point_count = i == 8 ? 2 : i == 9 ? 17 : 4;
            bad.points[1].x = bad.points[2].x = i == 11 ? NAN : 1.0f;
            bad.points[2].z = 1.0f; // 10: the fourth point is the first again, but with a dent
            bad.points[3] = tl_vec3_make(0.9f, 0.0f, 0.2f);
            expected = i == 11 ? TL_ERR_NOT_FINITE : TL_ERR_ARGUMENT;
            break;
        }
        TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &bad, &id, NULL), expected);
    }
    TEST_RESULT(tl_nav_obstacles_remove(w.obstacles, 0), TL_ERR_STALE);
    TEST_RESULT(tl_nav_obstacles_remove(w.obstacles, UINT64_MAX), TL_ERR_STALE);
    tl_nav_obstacle far_away = good;
    far_away.base.x = 1e6f;
    TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &far_away, &id, NULL), TL_OK);
    TEST_CHECK(tl_nav_obstacles_count(w.obstacles) == 1 && tl_nav_obstacles_waiting(w.obstacles) == 0);
    tl_nav_rebaked_tile remade;
    TEST_RESULT(tl_nav_obstacles_bake_next(w.obstacles, &remade, NULL), TL_NOT_FOUND);
    tl_nav_bake_report report;
    tl_nav_obstacles *none;
    tl_nav_def def = w.def;
    def.tile_size = 0;
    TEST_RESULT(tl_nav_obstacles_bake(&def, &w.input, &none, NULL, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.base.field, "tile_size");
    def = w.def;
    def.bounds = tl_aabb_empty();
    TEST_RESULT(tl_nav_obstacles_bake(&def, &w.input, &none, NULL, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.base.field, "bounds");
    TEST_CHECK(none == NULL);
    free_world(&w);
}

// Every allocation may fail; what waits goes on waiting and comes when there is memory again.
static void test_out_of_memory(void **state)
{
    (void)state;
    test_allocator counting;
    tl_nav_def def = make_def();
    def.bounds.max = tl_vec3_make(9, 9, 9);
    test_level level;
    test_level_make(&level, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { level.mesh, NULL, NULL, 0 };
    def.host.allocator = &counting.allocator;
    tl_nav_obstacles *obstacles = NULL;
    tl_nav_obstacle_id id;
    const tl_nav_obstacle crate = box(0, tl_vec3_make(4, 0, 8), 1.0f, 1.0f, 1.0f);
    uint32_t failures[3] = { 0, 0, 0 };
    for (uint64_t k = 1; obstacles == NULL; k += 1 + k / 8) {
        test_allocator_init(&counting, k);
        tl_result result = tl_nav_obstacles_bake(&def, &input, &obstacles, NULL, NULL);
        TEST_CHECK(result == TL_OK || (result == TL_ERR_MEMORY && counting.live_blocks == 0));
        failures[0] += result != TL_OK;
    }
    for (uint64_t k = 1;; k++) {
        counting.calls = 0;
        counting.fail_at = k;
        tl_result result = tl_nav_obstacles_add(obstacles, &crate, &id, NULL);
        if (result == TL_OK) {
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
        failures[1]++;
    }
    while (tl_nav_obstacles_waiting(obstacles) > 0) {
        uint32_t waiting = tl_nav_obstacles_waiting(obstacles);
        for (uint64_t k = 1;; k++) {
            tl_nav_rebaked_tile remade;
            counting.calls = 0;
            counting.fail_at = k;
            uint64_t blocks = counting.live_blocks;
            tl_result result = tl_nav_obstacles_bake_next(obstacles, &remade, NULL);
            if (result == TL_OK) {
                // And what the tile keeps of itself.
                TEST_CHECK(counting.live_blocks >= blocks + (remade.stack.count > 0 ? remade.stack.count + 1 : 0));
                tl_nav_tile_stack_free(&remade.stack);
                break;
            }
            TEST_RESULT(result, TL_ERR_MEMORY);
            // The room that tiles are unpacked in is given back, where there is any.
            TEST_CHECK(counting.live_blocks <= blocks && counting.live_blocks + 4 >= blocks);
            TEST_CHECK(remade.stack.count == 0);
            TEST_CHECK(tl_nav_obstacles_waiting(obstacles) == waiting);
            failures[2]++;
        }
    }
    TEST_CHECK(failures[0] > 10 && failures[1] > 0 && failures[2] > 30);
    TEST_CHECK(tl_nav_obstacles_bytes(obstacles) > 1000);
    counting.fail_at = 0;
    tl_nav_obstacles_destroy(obstacles);
    TEST_CHECK(counting.live_blocks == 0);
}

// Every allocation of several workers may fail: what was made is in the navmesh, the others wait, and in the end the
// navmesh is that of a world without failures.
static void test_update_out_of_memory(void **state)
{
    (void)state;
    test_allocator counting;
    test_allocator_init(&counting, 0);
    world w, other;
    make_world(&other, NULL);
    make_world(&w, &counting.allocator);
    settle(&w);
    settle(&other);
    uint32_t failures = 0;
    tl_tasks tasks;
    test_backward_tasks(&tasks, 3);
    TEST_RESULT(tl_nav_obstacles_set_tasks(w.obstacles, &tasks), TL_OK);
    test_random random = { 12 };
    for (int edit = 0; edit < 6; edit++) {
        tl_nav_obstacle_id id;
        for (int i = 0; i < 5; i++) {
            const tl_nav_obstacle obstacle = random_obstacle(&random);
            counting.fail_at = 0;
            TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &obstacle, &id, NULL), TL_OK);
            TEST_RESULT(tl_nav_obstacles_add(other.obstacles, &obstacle, &id, NULL), TL_OK);
        }
        for (uint64_t k = 1; tl_nav_obstacles_waiting(w.obstacles) > 0; k += 1 + k / 8) {
            uint32_t waiting = 0;
            counting.calls = 0;
            counting.fail_at = k;
            const tl_result result = tl_nav_obstacles_update(w.obstacles, w.navmesh, UINT32_MAX, &waiting, NULL);
            TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
            TEST_CHECK(waiting == tl_nav_obstacles_waiting(w.obstacles) && (waiting == 0) == (result == TL_OK));
            failures += result != TL_OK;
        }
        settle(&other);
        for (uint32_t slot = 0; slot < tl_navmesh_slot_count(other.navmesh); slot++) {
            const tl_nav_tile *tile = tl_navmesh_slot_tile(other.navmesh, slot);
            TEST_CHECK(tile == NULL ||
                       same_tile(tile, tl_navmesh_find_layer(w.navmesh, tile->tile_x, tile->layer, tile->tile_z)));
        }
        TEST_CHECK(tl_navmesh_tile_count(w.navmesh) == tl_navmesh_tile_count(other.navmesh));
    }
    TEST_CHECK(failures > 50);
    counting.fail_at = 0;
    free_world(&w);
    free_world(&other);
    TEST_CHECK(counting.live_blocks == 0);
}

// The same with floors in layers of two metres.
static int divide(void **state)
{
    (void)state;
    tile_height = 2.0f;
    return 0;
}

static int use_monotone(void **state)
{
    (void)state;
    tile_height = 0.0f;
    partition = TL_NAV_MONOTONE;
    return 0;
}

static int use_layers(void **state)
{
    (void)state;
    tile_height = 0.0f;
    partition = TL_NAV_LAYERS;
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_volumes),
        cmocka_unit_test(test_marks),
        cmocka_unit_test(test_random_edits),
        cmocka_unit_test(test_rebake),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_out_of_memory),
        cmocka_unit_test(test_update_out_of_memory),
        cmocka_unit_test_setup(test_volumes, divide),
        cmocka_unit_test_setup(test_random_edits, divide),
        cmocka_unit_test_setup(test_rebake, divide),
        cmocka_unit_test_setup(test_out_of_memory, divide),
        cmocka_unit_test_setup(test_volumes, use_monotone),
        cmocka_unit_test_setup(test_random_edits, use_monotone),
        cmocka_unit_test_setup(test_out_of_memory, use_monotone),
        cmocka_unit_test_setup(test_random_edits, use_layers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
