// SPDX-License-Identifier: MIT
//
// Times of tiles: what is noted comes back, whatever stands beside it; and replays of times that can be counted by
// hand.
#include "talus_test.h"

#include "base/random.h"
#include "world/bytes/thread_clock.h"
#include "world/job/rank_replay.h"
#include "world/job/shard.h"
#include "world/job/tile_times.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TILES = 1000, ACROSS = 40 };

static tl_world_tile tiles[TILES];

static tl_world_plan make_plan(void)
{
    tl_world_plan plan;
    memset(&plan, 0, sizeof plan);
    for (uint32_t i = 0; i < TILES; i++) {
        const tl_world_tile tile = { i % ACROSS, i / ACROSS, 10, 100, { i * 7919u, i } };
        tiles[i] = tile;
    }
    plan.tiles = tiles;
    plan.tile_count = TILES;
    return plan;
}

static void append_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *file = fopen(path, "ab");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void note(tl_world_times *times, const tl_world_tile *tile, uint64_t nanoseconds)
{
    unsigned char record[TL_WORLD_TIME_RECORD];
    tl_io_error error;
    tl_world_time_encode(tile, nanoseconds, record);
    assert_int_equal(tl_world_times_append(times, "times_job", 0, record, 1, &error), TL_OK);
}

static void notes_come_back(void **state)
{
    (void)state;
    const tl_world_plan plan = make_plan();
    tl_io_error error;
    uint64_t *times;
    tl_world_times first = { NULL }, second = { NULL };
    assert_int_equal(system("rm -rf times_job && mkdir times_job"), 0);
    assert_int_equal(tl_world_times_read("times_job", &plan, &times, &error), TL_OK);
    TEST_CHECK(times[0] == 0 && times[TILES - 1] == 0); // nothing is noted yet
    free(times);
    for (uint32_t i = 0; i < TILES; i += 2) {
        note(i % 4 == 0 ? &first : &second, &tiles[i], 1000 + i);
    }
    TEST_CHECK(strcmp(first.path, second.path) != 0);
    note(&second, &tiles[4], 900);   // another process baked it too, and was faster
    note(&second, &tiles[8], 10000); // and slower
    tl_world_tile other = tiles[3];
    other.key.low++; // an earlier plan's
    note(&first, &other, 5);
    other = tiles[5];
    other.x = ACROSS; // no tile of this plan
    note(&first, &other, 5);
    unsigned char record[TL_WORLD_TIME_RECORD];
    tl_world_time_encode(&tiles[7], 77, record);
    record[33] ^= 1; // altered
    append_bytes(first.path, record, sizeof record);
    tl_world_time_encode(&tiles[9], 99, record);
    append_bytes(first.path, record, 20); // cut off, as by a full disk
    append_bytes("times_job/times/notes.txt", "none of ours", 12);
    assert_int_equal(tl_world_times_read("times_job", &plan, &times, &error), TL_OK);
    for (uint32_t i = 0; i < TILES; i++) {
        TEST_CHECK(times[i] == (i == 4 ? 900u : i % 2 == 0 ? 1000u + i : 0u));
    }
    free(times);
    free(first.path);
    free(second.path);
}

static void the_clock_counts_work(void **state)
{
    (void)state;
    const uint64_t began = tl_thread_nanoseconds();
    uint64_t sum = 1;
    while (tl_thread_nanoseconds() - began < 20000000) {
        sum = sum * 6364136223846793005u + 1;
    }
    TEST_CHECK(sum != 0);
}

static bool is_near(double a, double b)
{
    return fabs(a - b) < 1e-12;
}

static void replays_by_hand(void **state)
{
    (void)state;
    tl_world_plan plan = make_plan();
    tl_world_replay replay;
    // Four tiles, 8 6 4 2 by cost as in truth, on two processes: dealt 8+2 | 6+4, and so by --shard.
    static const uint64_t four[] = { 2, 4, 6, 8 };
    plan.tile_count = 4;
    for (uint32_t i = 0; i < 4; i++) {
        tiles[i].cost = (uint32_t)four[i];
    }
    assert_int_equal(tl_world_replay_ranks(&plan, four, 2, &replay), TL_OK);
    TEST_CHECK(is_near(replay.dealt, 0.0) && is_near(replay.shards, 0.0) && is_near(replay.least, 0.0));
    TEST_CHECK(is_near(replay.dealt_naive, 1.0 - 20.0 / (2 * 12)));  // 2+6 | 4+8
    TEST_CHECK(is_near(replay.shards_naive, 1.0 - 20.0 / (2 * 14))); // 2+4 | 6+8
    // One process never waits; more than tiles wait for the longest.
    assert_int_equal(tl_world_replay_ranks(&plan, four, 1, &replay), TL_OK);
    TEST_CHECK(is_near(replay.dealt, 0.0) && is_near(replay.shards, 0.0) && is_near(replay.shards_naive, 0.0));
    assert_int_equal(tl_world_replay_ranks(&plan, four, 10, &replay), TL_OK);
    TEST_CHECK(is_near(replay.dealt, 0.75) && is_near(replay.least, 0.75) && is_near(replay.shards, 0.75));
    static const uint64_t nothing[4] = { 0 };
    assert_int_equal(tl_world_replay_ranks(&plan, nothing, 3, &replay), TL_OK);
    TEST_CHECK(is_near(replay.dealt, 0.0));
}

// Whoever is free first, found without a heap.
static void replays_of_many(void **state)
{
    (void)state;
    tl_world_plan plan = make_plan();
    uint64_t times[TILES], random = 7;
    for (uint32_t i = 0; i < TILES; i++) {
        const uint32_t cost = 10 + (uint32_t)(tl_random_below(&random, 400));
        tiles[i].cost = cost;
        times[i] = cost * (80 + tl_random_below(&random, 40));
    }
    const tl_world_shard whole = { 0, 1, NULL };
    uint64_t count = 0;
    uint64_t *order = tl_world_shard_tiles(&plan, &whole, &count);
    assert_int_equal(count, TILES);
    for (uint32_t ranks = 1; ranks <= 64; ranks += 9) {
        uint64_t free_at[64] = { 0 }, sum = 0, last = 0, worst_shard = 0;
        for (uint64_t i = 0; i < count;) {
            uint32_t next = 0;
            for (uint32_t r = 1; r < ranks; r++) {
                next = free_at[r] < free_at[next] ? r : next;
            }
            const uint64_t share = (count - i) / (2 * (uint64_t)ranks);
            const uint64_t end = i + (share < 1 ? 1 : share < 4 ? share : 4);
            for (; i < end && i < count; i++) {
                free_at[next] += times[order[i]];
                sum += times[order[i]];
            }
        }
        for (uint32_t r = 0; r < ranks; r++) {
            last = free_at[r] > last ? free_at[r] : last;
            const tl_world_shard shard = { r, ranks, NULL };
            uint64_t mine = 0, load = 0;
            uint64_t *own = tl_world_shard_tiles(&plan, &shard, &mine);
            for (uint64_t i = 0; i < mine; i++) {
                load += times[own[i]];
            }
            free(own);
            worst_shard = load > worst_shard ? load : worst_shard;
        }
        tl_world_replay replay;
        assert_int_equal(tl_world_replay_ranks(&plan, times, ranks, &replay), TL_OK);
        TEST_CHECK(is_near(replay.dealt, 1.0 - (double)sum / ((double)last * ranks)));
        TEST_CHECK(is_near(replay.shards, 1.0 - (double)sum / ((double)worst_shard * ranks)));
        TEST_CHECK(replay.least <= replay.dealt && replay.dealt < 0.05 && replay.dealt_naive < 0.3);
    }
    free(order);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(notes_come_back),
        cmocka_unit_test(the_clock_counts_work),
        cmocka_unit_test(replays_by_hand),
        cmocka_unit_test(replays_of_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
