// SPDX-License-Identifier: MIT
//
// Shards: what schedulers say, one row a scheduler; every tile in one shard, and shards of equal estimated cost.
#include "talus_test.h"

#include "base/random.h"
#include "world/job/shard.h"

#include <stdlib.h>
#include <string.h>

typedef struct shard_case {
    const char *variables; // NAME=VALUE with blanks between
    uint32_t given;        // --shards
    tl_result result;
    uint32_t index, count;
    const char *source;
} shard_case;

static const char *look_up_in(const char *name, void *user)
{
    static char value[64];
    const size_t length = strlen(name);
    for (const char *at = user; at != NULL; at = strchr(at, ' ')) {
        at += *at == ' ';
        if (strncmp(at, name, length) == 0 && at[length] == '=') {
            const size_t size = strcspn(at + length + 1, " ");
            assert_true(size < sizeof value);
            memcpy(value, at + length + 1, size);
            value[size] = '\0';
            return value;
        }
    }
    return NULL;
}

static void schedulers_say_it(void **state)
{
    (void)state;
    static const shard_case cases[] = {
        { "", 0, TL_OK, 0, 1, NULL },
        { "SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_COUNT=8 SLURM_ARRAY_TASK_MIN=0", 0, TL_OK, 7, 8,
          "SLURM_ARRAY_TASK_ID" },
        { "SLURM_ARRAY_TASK_ID=12 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=10", 0, TL_OK, 2, 3,
          "SLURM_ARRAY_TASK_ID" },
        { "SLURM_ARRAY_TASK_ID=9 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_STEP=4", 0, TL_OK, 2,
          3, "SLURM_ARRAY_TASK_ID" },
        { "SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=0", 0, TL_ERR_ARGUMENT, 0, 0, NULL },
        { "SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_MIN=2", 0, TL_ERR_ARGUMENT, 0, 0, NULL },
        { "OMPI_COMM_WORLD_RANK=3 OMPI_COMM_WORLD_SIZE=4", 0, TL_OK, 3, 4, "OMPI_COMM_WORLD_RANK" },
        { "OMPI_COMM_WORLD_RANK=4 OMPI_COMM_WORLD_SIZE=4", 0, TL_ERR_ARGUMENT, 0, 0, NULL },
        { "PMI_RANK=0 PMI_SIZE=2", 0, TL_OK, 0, 2, "PMI_RANK" },
        { "SLURM_PROCID=1 SLURM_NTASKS=2", 0, TL_OK, 1, 2, "SLURM_PROCID" },
        { "SLURM_PROCID=0 SLURM_NTASKS=1", 0, TL_OK, 0, 1, NULL },
        { "JOB_COMPLETION_INDEX=5", 0, TL_ERR_ARGUMENT, 0, 0, NULL },
        { "JOB_COMPLETION_INDEX=5", 16, TL_OK, 5, 16, "JOB_COMPLETION_INDEX" },
        { "JOB_COMPLETION_INDEX=5 JOB_COMPLETIONS=6", 0, TL_OK, 5, 6, "JOB_COMPLETION_INDEX" },
        { "AWS_BATCH_JOB_ARRAY_INDEX=0", 64, TL_OK, 0, 64, "AWS_BATCH_JOB_ARRAY_INDEX" },
        { "AWS_BATCH_JOB_ARRAY_INDEX=2 AWS_BATCH_JOB_ARRAY_SIZE=3", 0, TL_OK, 2, 3, "AWS_BATCH_JOB_ARRAY_INDEX" },
        { "SLURM_PROCID=1 SLURM_NTASKS=2 SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_COUNT=9 SLURM_ARRAY_TASK_MIN=1", 0,
          TL_OK, 0, 9, "SLURM_ARRAY_TASK_ID" },
        { "OMPI_COMM_WORLD_RANK=x OMPI_COMM_WORLD_SIZE=4", 0, TL_ERR_ARGUMENT, 0, 0, NULL },
        { "OMPI_COMM_WORLD_RANK=99999999999 OMPI_COMM_WORLD_SIZE=4", 0, TL_ERR_ARGUMENT, 0, 0, NULL },
        { "", 8, TL_ERR_ARGUMENT, 0, 0, NULL },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const shard_case *c = &cases[i];
        tl_world_shard shard;
        tl_io_error error;
        char variables[256];
        strcpy(variables, c->variables);
        assert_int_equal(tl_world_shard_find(NULL, c->given, look_up_in, variables, &shard, &error), c->result);
        if (c->result == TL_OK) {
            TEST_CHECK(shard.index == c->index && shard.count == c->count);
            TEST_CHECK((shard.source == NULL) == (c->source == NULL) &&
                       (c->source == NULL || strcmp(shard.source, c->source) == 0));
        }
    }
}

static void the_option_comes_first(void **state)
{
    (void)state;
    char variables[] = "OMPI_COMM_WORLD_RANK=3 OMPI_COMM_WORLD_SIZE=4";
    tl_world_shard shard;
    tl_io_error error;
    assert_int_equal(tl_world_shard_find("3/64", 0, look_up_in, variables, &shard, &error), TL_OK);
    TEST_CHECK(shard.index == 2 && shard.count == 64 && strcmp(shard.source, "--shard") == 0);
    static const char *const wrong[] = {
        "", "3", "0/4", "5/4", "1/0", "1/2/3", "-1/2", "1 /2", "a/b", "1/99999999999"
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        assert_int_equal(tl_world_shard_find(wrong[i], 0, look_up_in, variables, &shard, &error), TL_ERR_ARGUMENT);
    }
}

static void every_tile_is_in_one_shard(void **state)
{
    (void)state;
    enum { TILES = 800 };
    tl_world_tile *tiles = calloc(TILES, sizeof *tiles);
    uint64_t random = 1, total = 0;
    tl_world_plan plan;
    memset(&plan, 0, sizeof plan);
    plan.tiles = tiles;
    plan.tile_count = TILES;
    for (int i = 0; i < TILES; i++) {
        tiles[i].cost = 1000 + tl_random_below(&random, 100000);
        total += tiles[i].cost;
    }
    static const uint32_t counts[] = { 1, 2, 64, 99, 800, 900 };
    for (int c = 0; c < 6; c++) {
        unsigned char seen[TILES] = { 0 };
        uint64_t largest = 0;
        for (uint32_t s = 0; s < counts[c]; s++) {
            const tl_world_shard shard = { s, counts[c], NULL };
            uint64_t count, sum = 0, *list = tl_world_shard_tiles(&plan, &shard, &count);
            assert_non_null(list);
            for (uint64_t i = 0; i < count; i++) {
                seen[list[i]]++;
                sum += tiles[list[i]].cost;
                TEST_CHECK(i == 0 || tiles[list[i]].cost <= tiles[list[i - 1]].cost);
            }
            largest = sum > largest ? sum : largest;
            free(list);
        }
        for (int i = 0; i < TILES; i++) {
            TEST_CHECK(seen[i] == 1);
        }
        TEST_CHECK(largest <= total / counts[c] + 101000); // one tile more than the mean at most
    }
    free(tiles);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(schedulers_say_it),
        cmocka_unit_test(the_option_comes_first),
        cmocka_unit_test(every_tile_is_in_one_shard),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
