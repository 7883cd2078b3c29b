// SPDX-License-Identifier: MIT
//
// Links on a small level where it is known what there must be: a floor, a low wall across it, a ledge too high to
// climb, a ledge to climb, and an island behind a gap. Then the same bytes on any tasks, failing memory, cancelling,
// damage.

#include "backward_tasks.h"
#include "talus_test.h"

#include <math.h>
#include <string.h>
#include <talus/nav_bake.h>
#include <talus/nav_links.h>

enum { MAX_BOXES = 8 };

typedef struct box_level {
    tl_vec3 vertices[8 * MAX_BOXES];
    uint32_t indices[36 * MAX_BOXES];
    uint32_t count;
} box_level;

static void add_box(box_level *level, tl_vec3 low, tl_vec3 high)
{
    // Corner i has x, y, z of `high` where its bits 0, 1, 2 are set; each face counter-clockwise from outside.
    static const uint32_t FACES[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 },
                                          { 2, 6, 7, 3 }, { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };
    uint32_t first = 8 * level->count;
    for (uint32_t i = 0; i < 8; i++) {
        level->vertices[first + i] =
            tl_vec3_make(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    }
    for (uint32_t f = 0; f < 6; f++) {
        const uint32_t corners[6] = { 0, 1, 2, 0, 2, 3 };
        for (uint32_t k = 0; k < 6; k++) {
            level->indices[36 * level->count + 6 * f + k] = first + FACES[f][corners[k]];
        }
    }
    level->count++;
}

typedef struct linked_level {
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
    tl_soup *soup;
} linked_level;

static void bake_boxes(const box_level *boxes, float scale, linked_level *out)
{
    tl_mesh_view view = { boxes->vertices, 8 * boxes->count, boxes->indices, 12 * boxes->count, NULL };
    tl_nav_input input = { view, NULL, NULL, 0 };
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = 0.2f * scale;
    def.cell_height *= scale;
    def.agent_height *= scale;
    def.agent_radius = 0.4f * scale;
    def.agent_max_climb = 0.4f * scale;
    def.edge_max_len *= scale;
    TEST_RESULT(tl_nav_bake(&def, &input, &out->tiles, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_create(NULL, &out->navmesh), TL_OK);
    for (uint32_t i = 0; i < out->tiles.tile_count; i++) {
        TEST_RESULT(tl_navmesh_add_tile(out->navmesh, out->tiles.tiles[i], TL_NAV_TILE_BORROWED), TL_OK);
    }
    TEST_RESULT(tl_soup_bake(&view, NULL, &out->soup, NULL), TL_OK);
}

// `scale` times as large, and the agent with it.
static void make_scaled_level(linked_level *out, float scale)
{
    static box_level boxes;
    memset(&boxes, 0, sizeof boxes);
    add_box(&boxes, tl_vec3_make(0, -1, 0), tl_vec3_make(20, 0, 20));     // the floor
    add_box(&boxes, tl_vec3_make(6, 0, 0), tl_vec3_make(6.4f, 0.8f, 20)); // a low wall from side to side
    add_box(&boxes, tl_vec3_make(12, 0, 0), tl_vec3_make(20, 3, 8));      // a ledge to drop from
    add_box(&boxes, tl_vec3_make(12, 0, 12), tl_vec3_make(20, 1, 20));    // a ledge to climb
    add_box(&boxes, tl_vec3_make(21.5f, -1, 0), tl_vec3_make(30, 0, 20)); // an island
    for (uint32_t i = 0; i < 8 * boxes.count; i++) {
        boxes.vertices[i] = tl_scale(boxes.vertices[i], scale);
    }
    bake_boxes(&boxes, scale, out);
}

static void make_level(linked_level *out)
{
    make_scaled_level(out, 1.0f);
}

static void free_level(linked_level *level)
{
    tl_navmesh_destroy(level->navmesh);
    tl_nav_tiles_free(&level->tiles);
    tl_blob_free(level->soup);
}

static tl_nav_path_status ask(const linked_level *level, tl_vec3 from, tl_vec3 to, uint32_t *links_out)
{
    tl_nav_query_def def = tl_default_nav_query_def();
    tl_nav_query *query;
    TEST_RESULT(tl_nav_query_create(&def, &query, NULL), TL_OK);
    tl_nav_ref polygons[256];
    tl_nav_corner corners[256];
    tl_nav_path_buffers buffers = { polygons, 256, corners, 256 };
    tl_nav_route route;
    TEST_RESULT(tl_nav_query_find_route(query, level->navmesh,
                                        &(tl_nav_route_request){ NULL, from, to, tl_vec3_make(0.5f, 0.5f, 0.5f) },
                                        &buffers, &route),
                TL_OK);
    *links_out = 0;
    for (uint32_t i = 0; i < route.corner_count; i++) {
        *links_out += (corners[i].flags & TL_NAV_CORNER_LINK) != 0;
    }
    tl_nav_query_destroy(query);
    return route.path.status;
}

static void test_known_level(void **state)
{
    (void)state;
    linked_level level;
    make_level(&level);
    tl_vec3 west = tl_vec3_make(3, 0, 10), east = tl_vec3_make(10, 0, 10), top = tl_vec3_make(16, 3, 4);
    tl_vec3 low = tl_vec3_make(16, 1, 16), island = tl_vec3_make(26, 0, 10);
    uint32_t over = 0;
    TEST_CHECK(ask(&level, west, east, &over) == TL_NAV_PATH_UNREACHABLE);
    TEST_CHECK(ask(&level, top, east, &over) == TL_NAV_PATH_UNREACHABLE);
    TEST_CHECK(ask(&level, low, east, &over) == TL_NAV_PATH_UNREACHABLE);
    TEST_CHECK(ask(&level, east, island, &over) == TL_NAV_PATH_UNREACHABLE);
    tl_nav_links_def def = tl_default_nav_links_def();
    tl_nav_links *links;
    tl_nav_links_report report;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_OK);
    TEST_CHECK(links->kind_counts[TL_NAV_LINK_DROP] > 0 && links->kind_counts[TL_NAV_LINK_CLIMB] > 0);
    TEST_CHECK(links->kind_counts[TL_NAV_LINK_JUMP] > 0 && report.sample_count > 100 && report.ledge_count > 10);
    TEST_RESULT(tl_nav_links_add(links, NULL, level.navmesh), TL_OK);
    TEST_CHECK(ask(&level, west, east, &over) == TL_NAV_PATH_COMPLETE && over == 1);
    TEST_CHECK(ask(&level, east, west, &over) == TL_NAV_PATH_COMPLETE && over == 1);
    TEST_CHECK(ask(&level, top, west, &over) == TL_NAV_PATH_COMPLETE && over == 2);
    TEST_CHECK(ask(&level, low, east, &over) == TL_NAV_PATH_COMPLETE && over == 1);
    TEST_CHECK(ask(&level, east, low, &over) == TL_NAV_PATH_COMPLETE && over == 1);
    TEST_CHECK(ask(&level, west, island, &over) == TL_NAV_PATH_COMPLETE && over == 2);
    // Three metres are down only.
    TEST_CHECK(ask(&level, east, top, &over) == TL_NAV_PATH_UNREACHABLE);
    tl_blob_free(links);
    free_level(&level);
}

// A limit of 0 leaves that kind out.
static void test_limits(void **state)
{
    (void)state;
    linked_level level;
    make_level(&level);
    for (int kind = 0; kind < TL_NAV_LINK_KINDS; kind++) {
        tl_nav_links_def def = tl_default_nav_links_def();
        def.max_drop = kind == TL_NAV_LINK_DROP ? 0.0f : def.max_drop;
        def.max_jump = kind == TL_NAV_LINK_JUMP ? 0.0f : def.max_jump;
        def.max_climb = kind == TL_NAV_LINK_CLIMB ? 0.0f : def.max_climb;
        tl_nav_links *links;
        TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, NULL), TL_OK);
        TEST_CHECK(links->kind_counts[kind] == 0 && links->link_count > 0);
        tl_blob_free(links);
    }
    tl_nav_links *links;
    tl_nav_links_report report;
    tl_nav_links_def def = tl_default_nav_links_def();
    def.min_gain = 0.5f;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_ERR_ARGUMENT);
    TEST_CHECK(links == NULL && report.base.advice != NULL);
    def = tl_default_nav_links_def();
    def.max_drop = NAN;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_ERR_NOT_FINITE);
    tl_navmesh *empty;
    TEST_RESULT(tl_navmesh_create(NULL, &empty), TL_OK);
    def = tl_default_nav_links_def();
    TEST_RESULT(tl_nav_links_find(&def, empty, level.soup, &links, &report), TL_ERR_EMPTY);
    tl_navmesh_destroy(empty);
    free_level(&level);
}

static bool stop_late(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)done;
    (void)total;
    return strcmp(stage, user) != 0;
}

static void test_hosts(void **state)
{
    (void)state;
    linked_level level;
    make_level(&level);
    tl_tasks tasks;
    test_backward_tasks(&tasks, 3);
    tl_host host = { NULL, &tasks, NULL };
    tl_nav_links_def def = tl_default_nav_links_def();
    tl_nav_links *first, *second;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &first, NULL), TL_OK);
    def.host = host;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &second, NULL), TL_OK);
    TEST_CHECK(first->blob.size == second->blob.size && memcmp(first, second, first->blob.size) == 0);
    static char stages[3][16] = { "ledges", "sweeps", "selection" };
    for (int i = 0; i < 3; i++) {
        tl_progress progress = { stop_late, stages[i] };
        tl_host stopped = { NULL, NULL, &progress };
        def.host = stopped;
        tl_nav_links *links;
        TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, NULL), TL_ERR_CANCELLED);
        TEST_CHECK(links == NULL);
    }
    tl_blob_free(first);
    tl_blob_free(second);
    free_level(&level);
}

static void test_failing_memory(void **state)
{
    (void)state;
    linked_level level;
    make_level(&level);
    uint64_t refused = 0;
    tl_result result = TL_ERR_MEMORY;
    for (uint64_t fail_at = 1; result != TL_OK; fail_at++) {
        test_allocator memory;
        test_allocator_init(&memory, fail_at);
        tl_host host = { &memory.allocator, NULL, NULL };
        tl_nav_links_def def = tl_default_nav_links_def();
        def.host = host;
        def.spacing = 2.0f;
        tl_nav_links *links;
        result = tl_nav_links_find(&def, level.navmesh, level.soup, &links, NULL);
        TEST_CHECK((result == TL_OK) == (links != NULL));
        TEST_CHECK(result == TL_OK || result == TL_ERR_MEMORY);
        refused += result != TL_OK;
        tl_blob_free(links);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    TEST_CHECK(refused > 10);
    free_level(&level);
}

static void test_damage(void **state)
{
    (void)state;
    linked_level level;
    make_level(&level);
    tl_nav_links_def def = tl_default_nav_links_def();
    tl_nav_links *links;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, NULL), TL_OK);
    uint64_t size = links->blob.size;
    TEST_RESULT(tl_nav_links_check(links, size, NULL), TL_OK);
    uint8_t *bytes = test_blob_alloc(size);
    for (uint64_t cut = 0; cut < size; cut++) {
        memcpy(bytes, links, size);
        TEST_CHECK(tl_nav_links_check(bytes, cut, NULL) != TL_OK);
    }
    // A bit in the head, or in a link's kind, direction or padding, or behind the last link, is found.
    uint64_t refused = 0;
    for (uint64_t i = 0; i < size; i++) {
        memcpy(bytes, links, size);
        bytes[i] ^= 0xff;
        refused += tl_nav_links_check(bytes, size, NULL) != TL_OK;
    }
    TEST_CHECK(refused > 60);
    TEST_RESULT(tl_nav_links_check(bytes + 1, size - 1, NULL), TL_ERR_ARGUMENT);
    // A link as it must not be added is refused whole.
    tl_nav_offmesh like = tl_default_nav_offmesh();
    like.flags = 0;
    TEST_RESULT(tl_nav_links_add(links, &like, level.navmesh), TL_ERR_ARGUMENT);
    TEST_CHECK(tl_navmesh_offmesh_count(level.navmesh) == 0);
    test_blob_free(bytes);
    tl_blob_free(links);
    free_level(&level);
}

// A jump passes its highest point once, at its apex, and ends where it must; a drop turns one corner.
static void test_points(void **state)
{
    (void)state;
    tl_nav_jump_link jump = { { 1, 2, 3 }, { 4, 1.5f, 7 }, 0.75f, TL_NAV_LINK_JUMP, 1, 0 };
    float highest = 0.0f;
    for (int i = 0; i <= 1000; i++) {
        tl_vec3 p = tl_nav_jump_link_point(&jump, (float)i / 1000.0f);
        highest = fmaxf(highest, p.y);
    }
    TEST_CHECK(fabsf(highest - 2.75f) < 1e-4f);
    TEST_CHECK(tl_distance(tl_nav_jump_link_point(&jump, 0.999f), jump.end) < 0.02f);
    tl_nav_jump_link drop = { { 0, 3, 0 }, { 1, 0, 0 }, 0.0f, TL_NAV_LINK_DROP, 0, 0 };
    TEST_CHECK(tl_distance(tl_nav_jump_link_point(&drop, 0.25f), tl_vec3_make(1, 3, 0)) < 1e-6f);
    TEST_CHECK(tl_distance(tl_nav_jump_link_point(&drop, 0.5f), tl_vec3_make(1, 2, 0)) < 1e-6f);
}

// A jump goes no farther than the navmesh does, and no place is tried that cannot be afforded.
static void test_scales(void **state)
{
    (void)state;
    linked_level level;
    tl_nav_links *links = NULL;
    tl_nav_links *same = NULL;
    tl_nav_links_report report;
    tl_nav_links_def def = tl_default_nav_links_def();
    make_level(&level);
    def.max_speed = 100.0f;
    def.max_jump = 50.0f; // from corner to corner it is 36 m
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_OK);
    for (def.max_jump = 1e3f; def.max_jump < 1e38f; def.max_jump *= 1e5f) {
        TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &same, &report), TL_OK);
        TEST_CHECK(same->blob.size == links->blob.size && memcmp(same, links, links->blob.size) == 0);
        tl_blob_free(same);
    }
    tl_blob_free(links);
    def = tl_default_nav_links_def();
    for (def.spacing = 1e-5f; def.spacing > 1e-37f; def.spacing *= 1e-8f) {
        TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_ERR_LIMIT);
        TEST_CHECK(links == NULL && strcmp(report.base.field, "spacing") == 0);
    }
    const float cell = tl_navmesh_slot_tile(level.navmesh, 0)->cell_size;
    def.spacing = 0.9f * TL_NAV_LINKS_MIN_SPACING * cell;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_ERR_LIMIT);
    TEST_CHECK(links == NULL && strcmp(report.base.field, "spacing") == 0);
    def.spacing = 1.1f * TL_NAV_LINKS_MIN_SPACING * cell;
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_OK);
    tl_blob_free(links);
    free_level(&level);
    def = tl_default_nav_links_def();
    make_scaled_level(&level, 1e-8f);
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_OK);
    tl_blob_free(links);
    free_level(&level);
    make_scaled_level(&level, 1e6f);
    TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, &report), TL_ERR_LIMIT);
    TEST_CHECK(strcmp(report.base.field, "spacing") == 0);
    free_level(&level);
}

// No link is longer, deeper or higher than its def allows, on gaps of many widths and depths at any angle.
static void test_ranges(void **state)
{
    (void)state;
    test_random random = { 3 };
    uint32_t jumps = 0, near_limit = 0;
    for (uint32_t round = 0; round < 40; round++) {
        static box_level boxes;
        memset(&boxes, 0, sizeof boxes);
        add_box(&boxes, tl_vec3_make(0, -1, 0), tl_vec3_make(8, 0, 12));
        const float gap = 0.4f + 2.4f * test_random_unit(&random), low = -4.4f + 5.6f * test_random_unit(&random);
        add_box(&boxes, tl_vec3_make(8 + gap, -6, 0), tl_vec3_make(16 + gap, low, 12));
        // Turned, so that ledges run across the cells.
        const float angle = 0.78f * test_random_unit(&random), c = cosf(angle), s = sinf(angle);
        for (uint32_t i = 0; i < 8 * boxes.count; i++) {
            const tl_vec3 v = boxes.vertices[i];
            boxes.vertices[i] = tl_vec3_make(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
        }
        linked_level level;
        bake_boxes(&boxes, 1.0f, &level);
        tl_nav_links_def def = tl_default_nav_links_def();
        def.max_jump = 2.0f + 2.0f * test_random_unit(&random);
        tl_nav_links *links = NULL;
        TEST_RESULT(tl_nav_links_find(&def, level.navmesh, level.soup, &links, NULL), TL_OK);
        for (uint32_t i = 0; i < links->link_count; i++) {
            const tl_nav_jump_link *link = &tl_nav_links_array(links)[i];
            const double across =
                hypot((double)link->end.x - (double)link->start.x, (double)link->end.z - (double)link->start.z);
            const float down = link->start.y - link->end.y;
            TEST_CHECK(down <= def.max_drop);
            if (link->kind == TL_NAV_LINK_JUMP) {
                TEST_CHECK(across <= (double)def.max_jump && -down <= link->apex && link->apex <= def.jump_height);
                TEST_CHECK(link->both_ways == 0 || (link->apex + down <= def.jump_height && -down <= def.max_drop));
                jumps++;
                near_limit += across > 0.9 * (double)def.max_jump;
            } else {
                TEST_CHECK(link->kind != TL_NAV_LINK_CLIMB || down <= def.max_climb);
            }
        }
        tl_blob_free(links);
        free_level(&level);
    }
    TEST_CHECK(jumps > 40 && near_limit > 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_known_level), cmocka_unit_test(test_limits),
                                        cmocka_unit_test(test_hosts),       cmocka_unit_test(test_failing_memory),
                                        cmocka_unit_test(test_damage),      cmocka_unit_test(test_points),
                                        cmocka_unit_test(test_scales),      cmocka_unit_test(test_ranges) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
