// SPDX-License-Identifier: MIT
//
// Tables of sight against lines cast one by one.

#include "backward_tasks.h"
#include "nav_audit_level.h"

#include <math.h>
#include <string.h>
#include <talus/nav_sight.h>

// Two rooms with a door between them, a window beside it, and a gallery over one of them.
static void make_rooms(test_level *level)
{
    memset(level, 0, sizeof *level);
    audit_floor(level, 0, 0, 24, 12, 0);
    audit_block(level, -1, -1, -1, 0, 5, 13);
    audit_block(level, 24, -1, -1, 25, 5, 13);
    audit_block(level, -1, -1, -1, 25, 5, 0);
    audit_block(level, -1, -1, 12, 25, 5, 13);
    audit_block(level, 12, 0, 0, 12.4f, 5, 5);
    audit_block(level, 12, 0, 7.5f, 12.4f, 5, 12); // the door: 5 to 7.5
    audit_block(level, 16, 0, 3, 18, 5, 5);
    audit_block(level, 0, 2.6f, 0, 6, 2.9f, 12); // the gallery
}

typedef struct rooms {
    test_level level;
    tl_nav_def def;
    tl_navmesh *navmesh;
    tl_soup *soup;
} rooms;

static void set_up(rooms *r, uint32_t tile_size)
{
    make_rooms(&r->level);
    r->def = tl_default_nav_def();
    r->def.tile_size = tile_size;
    const tl_nav_input input = { r->level.mesh, NULL, NULL, 0 };
    r->navmesh = test_nav_bake(&r->def, &input);
    r->soup = audit_soup(&r->level);
}

static void tear_down(rooms *r)
{
    tl_navmesh_destroy(r->navmesh);
    tl_blob_free(r->soup);
}

// The samples of a polygon, made here once more from the header's words.
static uint32_t samples_of(const tl_navmesh *navmesh, tl_nav_ref ref, float eye, tl_vec3 *out)
{
    const tl_nav_tile *tile;
    uint32_t polygon, count;
    TEST_RESULT(tl_navmesh_resolve(navmesh, ref, &tile, &polygon), TL_OK);
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &count);
    tl_vec3 middle = { 0, 0, 0 };
    for (uint32_t i = 0; i < count; i++) {
        middle = tl_add(middle, tl_scale(corners[i], 1.0f / (float)count));
    }
    for (uint32_t i = 0; i <= count; i++) {
        out[i] = i == 0 ? middle : tl_lerp(middle, corners[i - 1], 0.5f);
        TEST_RESULT(tl_navmesh_height(navmesh, ref, out[i].x, out[i].z, &out[i].y), TL_OK);
        out[i].y += eye;
    }
    return count + 1;
}

static bool see_each_other(const rooms *r, tl_nav_ref a, tl_nav_ref b, const tl_nav_pvs_def *def)
{
    tl_vec3 from[TL_NAV_MAX_CORNERS + 1], to[TL_NAV_MAX_CORNERS + 1];
    const uint32_t n = samples_of(r->navmesh, a, def->eye_height, from);
    const uint32_t m = samples_of(r->navmesh, b, def->eye_height, to);
    bool seen = a == b;
    for (uint32_t i = 0; i < n; i++) {
        for (uint32_t k = 0; k < m; k++) {
            seen = seen || (tl_distance(from[i], to[k]) <= def->max_distance &&
                            tl_soup_line_of_sight(r->soup, from[i], to[k], NULL));
        }
    }
    return seen;
}

static uint32_t list_refs(const tl_navmesh *navmesh, tl_nav_ref *refs)
{
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            refs[count++] = tl_navmesh_polygon_ref(navmesh, slot, p);
        }
    }
    return count;
}

static void equals_lines_cast_one_by_one(void **state)
{
    (void)state;
    for (int round = 0; round < 3; round++) {
        rooms r;
        set_up(&r, round == 0 ? 0 : 24);
        tl_nav_pvs_def def = tl_default_nav_pvs_def();
        def.max_distance = round == 2 ? 7.0f : INFINITY;
        tl_nav_pvs *sight;
        TEST_RESULT(tl_nav_pvs_bake(&def, r.navmesh, r.soup, &sight, NULL), TL_OK);
        TEST_RESULT(tl_nav_pvs_check(sight, sight->blob.size, NULL), TL_OK);
        static tl_nav_ref refs[4096], listed[4096];
        const uint32_t count = list_refs(r.navmesh, refs);
        uint32_t seen_pairs = 0, hidden_pairs = 0;
        for (uint32_t a = 0; a < count; a++) {
            uint32_t from_a = 0, expected = 0;
            TEST_RESULT(tl_nav_pvs_seen_from(sight, r.navmesh, refs[a], listed, 4096, &from_a), TL_OK);
            for (uint32_t b = 0; b < count; b++) {
                bool seen;
                TEST_RESULT(tl_nav_pvs_sees(sight, r.navmesh, refs[a], refs[b], &seen), TL_OK);
                assert_int_equal(seen, see_each_other(&r, refs[a], refs[b], &def));
                TEST_CHECK(!seen || listed[expected] == refs[b]);
                expected += seen;
                seen_pairs += seen && a != b;
                hidden_pairs += !seen;
            }
            assert_int_equal(expected, from_a);
            if (expected > 1) {
                TEST_RESULT(tl_nav_pvs_seen_from(sight, r.navmesh, refs[a], listed, 1, &from_a), TL_INCOMPLETE);
                assert_int_equal(from_a, expected);
            }
        }
        TEST_CHECK(count > 6 && seen_pairs > 10 && hidden_pairs > 10 && sight->pair_count * 2 == seen_pairs);
        tl_blob_free(sight);
        tear_down(&r);
    }
}

static void any_host_gives_the_same_bytes(void **state)
{
    (void)state;
    rooms r;
    set_up(&r, 24);
    tl_tasks tasks;
    test_backward_tasks(&tasks, 3);
    tl_nav_pvs_def def = tl_default_nav_pvs_def();
    tl_nav_pvs *one, *three;
    TEST_RESULT(tl_nav_pvs_bake(&def, r.navmesh, r.soup, &one, NULL), TL_OK);
    def.host.tasks = &tasks;
    TEST_RESULT(tl_nav_pvs_bake(&def, r.navmesh, r.soup, &three, NULL), TL_OK);
    assert_memory_equal(one, three, (size_t)one->blob.size);
    // Every truncated prefix, and every altered head, is refused or at least sound to ask.
    for (uint64_t size = 0; size < one->blob.size; size += 8) {
        TEST_CHECK(tl_nav_pvs_check(one, size, NULL) == TL_ERR_TRUNCATED);
    }
    for (size_t at = 0; at < (size_t)one->rows; at++) {
        unsigned char *byte = (unsigned char *)one + at;
        *byte ^= 0x41;
        if (tl_nav_pvs_check(one, three->blob.size, NULL) == TL_OK) {
            TEST_CHECK(one->polygon_count == three->polygon_count && one->rows == three->rows);
        }
        *byte ^= 0x41;
    }
    tl_blob_free(one);
    tl_blob_free(three);
    tear_down(&r);
}

static bool stop(const char *stage, uint64_t done, uint64_t total, void *user)
{
    (void)stage;
    (void)done;
    (void)total;
    (void)user;
    return false;
}

static void failures(void **state)
{
    (void)state;
    rooms r;
    set_up(&r, 0);
    tl_nav_pvs_def def = tl_default_nav_pvs_def();
    tl_nav_pvs *sight;
    tl_result result = TL_ERR_MEMORY;
    for (uint64_t k = 1; result == TL_ERR_MEMORY; k++) {
        test_allocator failing;
        test_allocator_init(&failing, k);
        def.host.allocator = &failing.allocator;
        result = tl_nav_pvs_bake(&def, r.navmesh, r.soup, &sight, NULL);
        TEST_CHECK((result == TL_OK) == (sight != NULL));
        tl_blob_free(sight);
        assert_int_equal(failing.live_blocks, 0);
    }
    TEST_RESULT(result, TL_OK);
    def = tl_default_nav_pvs_def();
    const tl_progress progress = { stop, NULL };
    def.host.progress = &progress;
    TEST_RESULT(tl_nav_pvs_bake(&def, r.navmesh, r.soup, &sight, NULL), TL_ERR_CANCELLED);
    def.host.progress = NULL;
    def.eye_height = NAN;
    tl_report report;
    TEST_RESULT(tl_nav_pvs_bake(&def, r.navmesh, r.soup, &sight, &report), TL_ERR_ARGUMENT);
    assert_string_equal(report.field, "eye_height");
    def = tl_default_nav_pvs_def();
    tl_navmesh *empty;
    TEST_RESULT(tl_navmesh_create(NULL, &empty), TL_OK);
    TEST_RESULT(tl_nav_pvs_bake(&def, empty, r.soup, &sight, NULL), TL_ERR_EMPTY);
    TEST_RESULT(tl_nav_pvs_bake(&def, r.navmesh, r.soup, &sight, NULL), TL_OK);
    bool seen;
    TEST_RESULT(tl_nav_pvs_sees(sight, r.navmesh, 12345, tl_navmesh_polygon_ref(r.navmesh, 0, 0), &seen), TL_ERR_STALE);
    tl_navmesh_destroy(empty);
    tl_blob_free(sight);
    tear_down(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equals_lines_cast_one_by_one),
        cmocka_unit_test(any_host_gives_the_same_bytes),
        cmocka_unit_test(failures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
