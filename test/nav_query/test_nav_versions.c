// SPDX-License-Identifier: MIT
//
// Versions of a navmesh: each answers bit for bit as a navmesh that is alone and went through the same edits; a version
// that is held does not change; what no held version has is freed; references from version to version.

#include "nav_answers.h"
#include "nav_fixture.h"

#include "nav_query/navmesh/navmesh.h"

#include <talus/nav_versions.h>

enum { TILES = 5, CELLS = 4, MAX_HELD = 5, ROUNDS = 60, PAIRS = 6, MAX_LINKS = 24 };

// The same edits on a navmesh alone and on the draft of one in versions.
typedef struct twins {
    fixture_level level;
    tl_navmesh *alone;
    tl_nav_versions *versions;
    bool present[TILES * TILES];
    tl_nav_ref links[MAX_LINKS];
    uint32_t link_count;
    test_random random;
} twins;

static void toggle_both(twins *t, tl_navmesh *draft)
{
    const uint32_t at = test_random_below(&t->random, TILES * TILES);
    bool *present = &t->present[at], before = *present;
    fixture_toggle_tile(&t->level, t->alone, at % TILES, at / TILES, present);
    fixture_toggle_tile(&t->level, draft, at % TILES, at / TILES, &before);
    TEST_CHECK(before == *present);
}

static void link_both(twins *t, tl_navmesh *draft)
{
    if (t->link_count == MAX_LINKS || (t->link_count > 0 && test_random_below(&t->random, 3) == 0)) {
        tl_nav_ref *link = &t->links[test_random_below(&t->random, t->link_count)];
        TEST_RESULT(tl_navmesh_remove_offmesh(t->alone, *link), TL_OK);
        TEST_RESULT(tl_navmesh_remove_offmesh(draft, *link), TL_OK);
        *link = t->links[--t->link_count];
        return;
    }
    const float side = TILES * CELLS * FIXTURE_STEP * t->level.cell_size;
    const tl_vec3 low = t->level.origin, high = tl_add(low, tl_vec3_make(side, 3, side));
    tl_nav_offmesh jump = tl_default_nav_offmesh();
    jump.start = test_random_point(&t->random, low, high);
    jump.end = test_random_point(&t->random, low, high);
    jump.radius = 2.5f;
    jump.cost_factor = test_random_below(&t->random, 4) == 0 ? 0.5f : 1.5f; // some are short cuts
    jump.both_ways = test_random_below(&t->random, 2) == 0;
    tl_nav_ref own;
    TEST_RESULT(tl_navmesh_add_offmesh(t->alone, &jump, &t->links[t->link_count], NULL), TL_OK);
    TEST_RESULT(tl_navmesh_add_offmesh(draft, &jump, &own, NULL), TL_OK);
    TEST_CHECK(own == t->links[t->link_count++]);
}

static void state_both(twins *t, tl_navmesh *draft)
{
    const fixture_refs all = fixture_all_refs(t->alone);
    for (int i = 0; i < 3 && all.count > 0; i++) {
        const tl_nav_ref ref = all.refs[test_random_below(&t->random, all.count)];
        const uint64_t flags = 1u << test_random_below(&t->random, 3);
        const uint8_t area = (uint8_t)(1 + test_random_below(&t->random, 5));
        TEST_RESULT(tl_navmesh_set_polygon_flags(t->alone, ref, flags), TL_OK);
        TEST_RESULT(tl_navmesh_set_polygon_flags(draft, ref, flags), TL_OK);
        TEST_RESULT(tl_navmesh_set_polygon_area(t->alone, ref, area), TL_OK);
        TEST_RESULT(tl_navmesh_set_polygon_area(draft, ref, area), TL_OK);
    }
    const uint32_t at = test_random_below(&t->random, TILES * TILES);
    const tl_result reset = tl_navmesh_reset_state(t->alone, (int32_t)(at % TILES), 0, (int32_t)(at / TILES));
    TEST_RESULT(tl_navmesh_reset_state(draft, (int32_t)(at % TILES), 0, (int32_t)(at / TILES)), reset);
    free(all.refs);
}

static void prepare_both(twins *t, tl_navmesh *draft)
{
    tl_nav_prepare_def def = tl_default_nav_prepare_def();
    def.table_bytes = test_random_below(&t->random, 2) == 0 ? 0 : def.table_bytes;
    TEST_RESULT(tl_navmesh_prepare(t->alone, &def, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_prepare(draft, &def, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_prepare_wide(t->alone, NULL, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_prepare_wide(draft, NULL, NULL), TL_OK);
}

static void edit_both(twins *t)
{
    const uint32_t edits = 1 + test_random_below(&t->random, 4);
    for (uint32_t i = 0; i < edits; i++) {
        tl_navmesh *draft;
        TEST_RESULT(tl_nav_versions_edit(t->versions, &draft), TL_OK);
        const uint32_t kind = test_random_below(&t->random, 10);
        if (kind < 5) {
            toggle_both(t, draft);
        } else if (kind < 7) {
            link_both(t, draft);
        } else if (kind < 9) {
            state_both(t, draft);
        } else {
            prepare_both(t, draft);
        }
    }
}

static twins make_twins(uint64_t seed, uint32_t kind, const tl_allocator *allocator)
{
    twins t;
    memset(&t, 0, sizeof t);
    t.random.state = seed;
    t.level = fixture_random(&t.random, kind, TILES * CELLS);
    t.level.tile_cells = CELLS;
    TEST_RESULT(tl_navmesh_create(NULL, &t.alone), TL_OK);
    TEST_RESULT(tl_nav_versions_create(allocator, &t.versions), TL_OK);
    return t;
}

static void free_twins(twins *t)
{
    tl_navmesh_destroy(t->alone);
    tl_nav_versions_destroy(t->versions);
}

// A version with arrays that caught up is the same as the one it caught up with.
static void check_caught_up(const tl_navmesh *draft, const tl_navmesh *newest)
{
    TEST_CHECK(draft->slot_count == newest->slot_count && draft->bucket_count == newest->bucket_count);
    for (uint32_t i = 0; i < newest->slot_count; i++) {
        TEST_CHECK(memcmp(&draft->slots[i], &newest->slots[i], sizeof draft->slots[i]) == 0);
    }
    for (uint32_t i = 0; i < newest->bucket_count; i++) {
        TEST_CHECK(draft->buckets[i] == newest->buckets[i]);
    }
    for (uint32_t i = 0; newest->slot_capacity > 0 && i <= newest->slot_capacity; i++) {
        TEST_CHECK(draft->area_table[i] == newest->area_table[i]);
    }
    const tl_nav_islands *a = &draft->islands, *b = &newest->islands;
    TEST_CHECK(a->used == b->used);
    for (uint32_t i = 0; i < b->used; i++) {
        TEST_CHECK(a->nodes[i].slot == b->nodes[i].slot && a->nodes[i].polygon == b->nodes[i].polygon);
        const bool is_free = b->nodes[i].slot == TL_NAV_NO_SLOT;
        TEST_CHECK(is_free ? a->nodes[i].next == b->nodes[i].next : a->nodes[i].piece == b->nodes[i].piece);
    }
    for (int kind = 0; kind < TL_NAV_ISLAND_KINDS; kind++) {
        TEST_CHECK(a->label_count[kind] == b->label_count[kind]);
        for (uint32_t i = 0; i < b->label_count[kind]; i++) {
            TEST_CHECK(memcmp(&a->labels[kind][i], &b->labels[kind][i], sizeof a->labels[kind][i]) == 0);
        }
        for (uint32_t i = 0; i < b->used; i++) {
            TEST_CHECK(b->nodes[i].slot == TL_NAV_NO_SLOT || a->nodes[i].labels[kind] == b->nodes[i].labels[kind]);
        }
    }
}

// Random edits with some versions held for random times.
static void run_twins(twins *t, tl_nav_query *query)
{
    const tl_navmesh *held[MAX_HELD] = { NULL };
    uint64_t hashes[MAX_HELD] = { 0 };
    for (int round = 0; round < ROUNDS; round++) {
        const tl_navmesh *before = tl_nav_versions_acquire(t->versions);
        tl_navmesh *draft;
        TEST_RESULT(tl_nav_versions_edit(t->versions, &draft), TL_OK);
        check_caught_up(draft, before);
        tl_nav_versions_release(t->versions, before);
        edit_both(t);
        TEST_RESULT(tl_nav_versions_publish(t->versions), TL_OK);

        const tl_navmesh *newest = tl_nav_versions_acquire(t->versions);
        const uint64_t hash = test_answers_hash(newest, query, PAIRS);
        TEST_CHECK(hash == test_answers_hash(t->alone, query, PAIRS));
        const uint32_t at = test_random_below(&t->random, MAX_HELD);
        TEST_CHECK(held[at] == NULL || test_answers_hash(held[at], query, PAIRS) == hashes[at]);
        tl_nav_versions_release(t->versions, held[at]);
        held[at] = newest;
        hashes[at] = hash;
    }
    for (int i = 0; i < MAX_HELD; i++) {
        TEST_CHECK(held[i] == NULL || test_answers_hash(held[i], query, PAIRS) == hashes[i]);
        tl_nav_versions_release(t->versions, held[i]);
    }
    tl_nav_versions_state left;
    TEST_RESULT(tl_nav_versions_reclaim(t->versions, &left), TL_OK);
    TEST_CHECK(left.version_count == 1 && left.oldest == left.newest && left.waiting_bytes == 0);
}

static void test_same_as_alone(void **state)
{
    (void)state;
    tl_nav_query *query = fixture_query(4096);
    for (uint64_t seed = 0; seed < 24; seed++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        twins t = make_twins(seed, (uint32_t)seed % 6, &memory.allocator);
        run_twins(&t, query);
        free_twins(&t);
        TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
    }
    tl_nav_query_destroy(query);
}

// Numbers of fans run out: all rings are numbered anew, those that older versions have too.
static void test_numbers_anew(void **state)
{
    (void)state;
    tl_nav_query *query = fixture_query(4096);
    twins t = make_twins(3, 4, NULL);
    for (int round = 0; round < 12; round++) {
        tl_navmesh *draft;
        TEST_RESULT(tl_nav_versions_edit(t.versions, &draft), TL_OK);
        for (int i = 0; i < 6; i++) {
            toggle_both(&t, draft);
        }
        t.alone->last_fan = draft->last_fan = round >= 6 ? UINT32_MAX / 2 + 1 : draft->last_fan;
        TEST_RESULT(tl_nav_versions_publish(t.versions), TL_OK);
        const tl_navmesh *held = tl_nav_versions_acquire(t.versions);
        const uint64_t hash = test_answers_hash(held, query, PAIRS);
        TEST_CHECK(hash == test_answers_hash(t.alone, query, PAIRS));
        TEST_RESULT(tl_nav_versions_edit(t.versions, &draft), TL_OK);
        toggle_both(&t, draft);
        TEST_CHECK(test_answers_hash(held, query, PAIRS) == hash);
        tl_nav_versions_release(t.versions, held);
    }
    free_twins(&t);
    tl_nav_query_destroy(query);
}

static fixture_level open_level(void)
{
    const char *const rows[] = { "00000000", "00000000", "00000000", "00000000" };
    fixture_level level = fixture_make(rows, 4);
    level.tile_cells = 4;
    return level;
}

// A navmesh of two tiles in versions, published.
static tl_nav_versions *two_tiles(const fixture_level *level, const tl_allocator *allocator)
{
    tl_nav_versions *versions;
    tl_navmesh *draft;
    TEST_RESULT(tl_nav_versions_create(allocator, &versions), TL_OK);
    TEST_RESULT(tl_nav_versions_edit(versions, &draft), TL_OK);
    for (int32_t x = 0; x < 2; x++) {
        tl_nav_tile *tile = fixture_build_tile(level, x, 0, allocator);
        TEST_RESULT(tl_navmesh_add_tile(draft, tile, TL_NAV_TILE_OWNED), TL_OK);
    }
    TEST_RESULT(tl_nav_versions_publish(versions), TL_OK);
    return versions;
}

static void remove_first(tl_nav_versions *versions)
{
    tl_navmesh *draft;
    TEST_RESULT(tl_nav_versions_edit(versions, &draft), TL_OK);
    TEST_RESULT(tl_navmesh_remove_tile(draft, 0, 0), TL_OK);
    TEST_RESULT(tl_nav_versions_publish(versions), TL_OK);
}

static void test_references(void **state)
{
    (void)state;
    const fixture_level level = open_level();
    tl_nav_versions *versions = two_tiles(&level, NULL);
    const tl_navmesh *old = tl_nav_versions_acquire(versions);
    const tl_nav_ref leaves = tl_navmesh_polygon_ref(old, 0, 0), stays = tl_navmesh_polygon_ref(old, 1, 0);
    remove_first(versions);
    const tl_navmesh *newest = tl_nav_versions_acquire(versions);
    TEST_CHECK(newest != old);
    TEST_RESULT(tl_navmesh_resolve(old, leaves, NULL, NULL), TL_OK);
    TEST_RESULT(tl_navmesh_resolve(newest, leaves, NULL, NULL), TL_ERR_STALE);
    const tl_nav_tile *tiles[2];
    TEST_RESULT(tl_navmesh_resolve(old, stays, &tiles[0], NULL), TL_OK);
    TEST_RESULT(tl_navmesh_resolve(newest, stays, &tiles[1], NULL), TL_OK);
    TEST_CHECK(tiles[0] == tiles[1]); // shared, not copied
    tl_nav_versions_release(versions, old);
    tl_nav_versions_release(versions, newest);
    tl_nav_versions_destroy(versions);
}

// A draft's edits are seen by no reader before they are published, then by those that enter.
static void test_published_whole(void **state)
{
    (void)state;
    const fixture_level level = open_level();
    tl_nav_versions *versions = two_tiles(&level, NULL);
    tl_navmesh *draft, *again;
    TEST_RESULT(tl_nav_versions_edit(versions, &draft), TL_OK);
    TEST_RESULT(tl_navmesh_remove_tile(draft, 0, 0), TL_OK);
    const tl_navmesh *reader = tl_nav_versions_acquire(versions);
    TEST_CHECK(tl_navmesh_tile_count(reader) == 2 && tl_navmesh_tile_count(draft) == 1);
    TEST_RESULT(tl_nav_versions_edit(versions, &again), TL_OK);
    TEST_CHECK(again == draft); // the one under way
    TEST_RESULT(tl_nav_versions_publish(versions), TL_OK);
    TEST_CHECK(tl_navmesh_tile_count(reader) == 2);
    const tl_navmesh *next = tl_nav_versions_acquire(versions);
    TEST_CHECK(tl_navmesh_tile_count(next) == 1);
    TEST_RESULT(tl_nav_versions_publish(versions), TL_OK); // nothing to publish
    const tl_navmesh *same = tl_nav_versions_acquire(versions);
    TEST_CHECK(same == next);
    tl_nav_versions_release(versions, same);
    tl_nav_versions_release(versions, next);
    tl_nav_versions_release(versions, reader);
    tl_nav_versions_destroy(versions);
}

// A tile's memory goes with the last reader that sees it, and not before; other readers do not keep it.
static void test_freed_with_last_reader(void **state)
{
    (void)state;
    const fixture_level level = open_level();
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_nav_versions *versions = two_tiles(&level, &memory.allocator);
    const tl_navmesh *first = tl_nav_versions_acquire(versions), *second = tl_nav_versions_acquire(versions);
    const uint64_t tile_bytes = tl_navmesh_slot_tile(first, 0)->blob.size;
    remove_first(versions);
    const tl_navmesh *later = tl_nav_versions_acquire(versions);
    tl_nav_versions_state now;
    TEST_RESULT(tl_nav_versions_reclaim(versions, &now), TL_OK);
    TEST_CHECK(now.version_count == 2 && now.newest == now.oldest + 1 && now.waiting_bytes > 0);
    const uint64_t held_bytes = memory.live_bytes;
    tl_nav_versions_release(versions, first);
    TEST_RESULT(tl_nav_versions_reclaim(versions, NULL), TL_OK);
    TEST_CHECK(memory.live_bytes == held_bytes); // the second reader is in there
    tl_nav_versions_release(versions, second);
    TEST_CHECK(memory.live_bytes == held_bytes); // readers free nothing
    TEST_RESULT(tl_nav_versions_reclaim(versions, &now), TL_OK);
    TEST_CHECK(now.version_count == 1 && now.waiting_bytes == 0 && memory.live_bytes + tile_bytes <= held_bytes);
    TEST_CHECK(tl_navmesh_tile_count(later) == 1);
    tl_nav_versions_release(versions, later);
    tl_nav_versions_destroy(versions);
    TEST_CHECK(memory.live_blocks == 0);
}

// What lives between two versions that are held is seen by neither, and goes.
static void test_freed_between_readers(void **state)
{
    (void)state;
    const fixture_level level = open_level();
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_nav_versions *versions = two_tiles(&level, &memory.allocator);
    const tl_navmesh *oldest = tl_nav_versions_acquire(versions);
    uint64_t settled = 0;
    for (int i = 0; i < 200; i++) {
        tl_navmesh *draft;
        TEST_RESULT(tl_nav_versions_edit(versions, &draft), TL_OK);
        TEST_RESULT(tl_navmesh_remove_tile(draft, 0, 0), TL_OK);
        tl_nav_tile *tile = fixture_build_tile(&level, 0, 0, &memory.allocator);
        TEST_RESULT(tl_navmesh_add_tile(draft, tile, TL_NAV_TILE_OWNED), TL_OK);
        TEST_RESULT(tl_nav_versions_publish(versions), TL_OK);
        settled = i == 20 ? memory.live_bytes : settled;
    }
    TEST_CHECK(memory.live_bytes == settled); // 180 edits beside a reader cost nothing that stays
    TEST_CHECK(tl_navmesh_tile_count(oldest) == 2);
    tl_nav_versions_release(versions, oldest);
    tl_nav_versions_destroy(versions);
    TEST_CHECK(memory.live_blocks == 0);
}

// Versions that nobody releases end at the limit, by name; a release later there is room.
static void test_limit(void **state)
{
    (void)state;
    const fixture_level level = open_level();
    tl_nav_versions *versions = two_tiles(&level, NULL);
    static const tl_navmesh *held[TL_NAV_MAX_VERSIONS];
    uint32_t count = 0;
    tl_navmesh *draft;
    tl_result result = TL_OK;
    while (count < TL_NAV_MAX_VERSIONS && result == TL_OK) {
        held[count++] = tl_nav_versions_acquire(versions);
        result = tl_nav_versions_edit(versions, &draft);
        if (result == TL_OK) {
            TEST_RESULT(tl_nav_versions_publish(versions), TL_OK);
        }
    }
    TEST_RESULT(result, TL_ERR_LIMIT);
    TEST_CHECK(count == TL_NAV_MAX_VERSIONS && draft == NULL);
    tl_nav_versions_release(versions, held[7]);
    TEST_RESULT(tl_nav_versions_edit(versions, &draft), TL_OK);
    TEST_RESULT(tl_nav_versions_publish(versions), TL_OK);
    for (uint32_t i = 0; i < count; i++) {
        tl_nav_versions_release(versions, i == 7 ? NULL : held[i]);
    }
    tl_nav_versions_destroy(versions);
}

// Each allocation of a run of edits fails in turn: the draft is whole, and the same edit works when there is memory.
static void test_memory_fails(void **state)
{
    (void)state;
    const fixture_level level = open_level();
    tl_nav_query *query = fixture_query(256);
    uint32_t failures = 0;
    for (uint64_t fail_at = 1;; fail_at++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        tl_nav_versions *versions = two_tiles(&level, &memory.allocator);
        const tl_navmesh *held = tl_nav_versions_acquire(versions);
        const uint64_t hash = test_answers_hash(held, query, PAIRS);
        memory.fail_at = memory.calls + fail_at;
        tl_navmesh *draft = NULL;
        tl_result result = tl_nav_versions_edit(versions, &draft);
        result = result == TL_OK ? tl_navmesh_set_polygon_area(draft, tl_navmesh_polygon_ref(draft, 0, 0), 9) : result;
        result = result == TL_OK ? tl_navmesh_remove_tile(draft, 1, 0) : result;
        const bool failed = result != TL_OK;
        memory.fail_at = 0;
        TEST_CHECK(!failed || result == TL_ERR_MEMORY);
        TEST_CHECK(test_answers_hash(held, query, PAIRS) == hash);
        TEST_RESULT(tl_nav_versions_edit(versions, &draft), TL_OK);
        const tl_result removed = tl_navmesh_remove_tile(draft, 1, 0);
        TEST_RESULT(removed, failed ? TL_OK : TL_NOT_FOUND);
        TEST_RESULT(tl_nav_versions_publish(versions), TL_OK);
        TEST_CHECK(test_answers_hash(held, query, PAIRS) == hash);
        tl_nav_versions_release(versions, held);
        tl_nav_versions_destroy(versions);
        TEST_CHECK(memory.live_blocks == 0);
        failures += failed;
        if (!failed) {
            break;
        }
    }
    TEST_CHECK(failures > 8);
    tl_nav_query_destroy(query);
}

// Adding several tiles of which one is refused gives them all back; owned ones are not freed.
static void test_batch_given_back(void **state)
{
    (void)state;
    const fixture_level level = open_level();
    tl_nav_versions *versions = two_tiles(&level, NULL);
    tl_nav_tile *tiles[2] = { fixture_build_tile(&level, 0, 0, NULL), fixture_build_tile(&level, 1, 0, NULL) };
    remove_first(versions);
    tl_navmesh *draft;
    TEST_RESULT(tl_nav_versions_edit(versions, &draft), TL_OK);
    TEST_RESULT(tl_navmesh_add_tiles(draft, tiles, 2, TL_NAV_TILE_OWNED, NULL), TL_ERR_ARGUMENT);
    TEST_CHECK(tl_navmesh_tile_count(draft) == 1);
    TEST_RESULT(tl_nav_tile_check(tiles[0], tiles[0]->blob.size, NULL), TL_OK);
    tl_blob_free(tiles[0]);
    tl_blob_free(tiles[1]);
    tl_nav_versions_destroy(versions); // with a draft under way
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_as_alone),
        cmocka_unit_test(test_numbers_anew),
        cmocka_unit_test(test_references),
        cmocka_unit_test(test_published_whole),
        cmocka_unit_test(test_freed_with_last_reader),
        cmocka_unit_test(test_freed_between_readers),
        cmocka_unit_test(test_limit),
        cmocka_unit_test(test_memory_fails),
        cmocka_unit_test(test_batch_given_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
