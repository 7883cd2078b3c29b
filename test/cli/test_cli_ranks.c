// SPDX-License-Identifier: MIT
//
// talus world bake under a real mpirun: the bytes of one process for any number of ranks; a rank's failure has its name
// and leaves the others at work; what a killed rank leaves is gone on with. Without mpirun it says so and skips.
#include "cli_run.h"

#ifndef TALUS_MPIRUN
#define TALUS_MPIRUN ""
#endif

// Containers run as root, and have fewer processors than ranks are tried.
#define MPIRUN "timeout 300 " TALUS_MPIRUN " --allow-run-as-root --oversubscribe"

static bool has_mpirun(void)
{
    return TALUS_MPIRUN[0] != '\0';
}

static void need_mpirun(void)
{
    if (!has_mpirun()) {
        print_message("SKIPPED: built without MPI (TALUS_MPI), or there is no mpirun\n");
        skip();
    }
}

// Runs `mpirun OPTIONS talus LINE`; returns the exit code. What it says goes to ranks.out and ranks.err.
static int run_ranks(const char *options, const char *line)
{
    char text[1024];
    snprintf(text, sizeof text, MPIRUN " %s " TALUS_COMMAND " %s </dev/null >ranks.out 2>ranks.err", options, line);
    const int status = system(text);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static void expect_ranks(int code, const char *options, const char *line)
{
    const int got = run_ranks(options, line);
    if (got != code) {
        char *err = cli_read_file("ranks.err", NULL);
        print_error("mpirun %s talus %s: exit code %d, expected %d\n%.2000s\n", options, line, got, code, err);
        free(err);
        fail();
    }
}

static void plan_anew(const char *job)
{
    char line[128];
    snprintf(line, sizeof line, "rm -rf %s", job);
    assert_int_equal(system(line), 0);
    snprintf(line, sizeof line, "world plan city.obj --tile-size 24 -o %s", job);
    cli_do(0, line);
}

static double status_of(const char *job, const char *key)
{
    char line[128];
    snprintf(line, sizeof line, "world status %s --json", job);
    cli_result result = cli_run_with(NULL, line);
    json_t *object = json_loads(result.out, 0, NULL);
    assert_non_null(object);
    const double number = cli_number(object, key);
    json_decref(object);
    cli_free(&result);
    return number;
}

static int make_city(void **state)
{
    const int code = cli_enter_folder(state);
    if (has_mpirun()) {
        cli_do(0, "sample city -n 100000 -o city.obj");
        plan_anew("alone");
        cli_do(0, "world bake alone");
        cli_do(0, "world merge alone -o alone.talus");
    }
    return code;
}

static void test_ranks(void **state)
{
    (void)state;
    need_mpirun();
    // The last is a cluster of plain Ethernet: no memory is shared, and rank 0 must answer while it bakes.
    static const char *const options[] = { "-n 1", "-n 2", "-n 4", "--mca btl tcp,self -n 3" };
    static const size_t counts[] = { 1, 2, 4, 3 };
    const double tiles = status_of("alone", "tiles");
    for (int i = 0; i < 4; i++) {
        plan_anew("shared");
        expect_ranks(0, options[i], "world bake shared --json");
        char *text = cli_read_file("ranks.out", NULL);
        json_t *object = json_loads(text, 0, NULL); // one object: rank 0 answers for all
        assert_non_null(object);
        assert_true(cli_number(object, "baked") == tiles && cli_number(object, "failed") == 0);
        const json_t *baked = json_object_get(object, "baked_by_rank");
        assert_int_equal(json_array_size(baked), counts[i]);
        for (size_t r = 0; r < counts[i]; r++) {
            TEST_CHECK(json_integer_value(json_array_get(baked, r)) > 0);
        }
        json_decref(object);
        free(text);
        cli_do(0, "world merge shared -o shared.talus");
        cli_check_same_files("alone.talus", "shared.talus");
    }
    expect_ranks(0, "-n 2", "world bake shared"); // nothing is left to do
    char *text = cli_read_file("ranks.out", NULL);
    cli_check_part(text, "0 baked now, 0 failed");
    free(text);
}

// Ranks share what --shard leaves them, so that an array of mpiruns is possible.
static void test_ranks_of_shards(void **state)
{
    (void)state;
    need_mpirun();
    plan_anew("parts");
    expect_ranks(0, "-n 2", "world bake parts --shard 1/2");
    const double half = status_of("parts", "there"), tiles = status_of("parts", "tiles");
    assert_true(half == (double)(((long)tiles + 1) / 2));
    expect_ranks(0, "-n 2 -x SLURM_ARRAY_TASK_ID=1 -x SLURM_ARRAY_TASK_COUNT=2", "world bake parts");
    cli_do(0, "world merge parts -o parts.talus");
    cli_check_same_files("alone.talus", "parts.talus");
}

static void test_failing_tile(void **state)
{
    (void)state;
    need_mpirun();
    plan_anew("broken");
    // A byte of a record in the middle of the store.
    assert_int_equal(system("f=$(ls broken/store/*.segment | head -n 1); cp $f kept; s=$(stat -c %s $f); "
                            "printf 'XXXX' | dd of=$f bs=1 seek=$((s / 2)) conv=notrunc 2>/dev/null"),
                     0);
    expect_ranks(3, "-n 3", "world bake broken");
    char *text = cli_read_file("ranks.err", NULL);
    cli_check_part(text, "rank ");
    cli_check_part(text, "the triangles of cell");
    cli_check_part(text, "tiles failed; the others are done");
    free(text);
    const double there = status_of("broken", "there"), tiles = status_of("broken", "tiles");
    TEST_CHECK(there < tiles && there > 0.9 * tiles); // the rest went on
    assert_int_equal(system("cp kept $(ls broken/store/*.segment | head -n 1)"), 0);
    expect_ranks(0, "-n 3", "world bake broken");
    cli_do(0, "world merge broken -o broken.talus");
    cli_check_same_files("alone.talus", "broken.talus");
}

// Rank 1 is killed when it puts its third tile in place.
static void test_killed_rank(void **state)
{
    (void)state;
    need_mpirun();
    plan_anew("killed");
    cli_write_text("rank.sh", "if [ \"$OMPI_COMM_WORLD_RANK\" = 1 ]; then\n"
                              "    export LD_PRELOAD=" TALUS_KILL_AT_RENAME " KILL_AT_RENAME=3\n"
                              "    export ASAN_OPTIONS=$ASAN_OPTIONS:verify_asan_link_order=0\n"
                              "fi\n"
                              "exec " TALUS_COMMAND " world bake killed --threads 1\n");
    const int status = system(MPIRUN " -n 2 sh rank.sh </dev/null >ranks.out 2>ranks.err");
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) != 0);
    char *text = cli_read_file("ranks.err", NULL);
    cli_check_part(text, "rank 1"); // mpirun names it
    free(text);
    const double there = status_of("killed", "there"), tiles = status_of("killed", "tiles");
    TEST_CHECK(there >= 2 && there < tiles);
    expect_ranks(0, "-n 2", "world bake killed --json");
    text = cli_read_file("ranks.out", NULL);
    json_t *object = json_loads(text, 0, NULL);
    assert_true(cli_number(object, "baked") == tiles - there); // nothing was lost
    json_decref(object);
    free(text);
    cli_do(0, "world merge killed -o killed.talus");
    cli_check_same_files("alone.talus", "killed.talus");
}

int main(void)
{
    setenv("ASAN_OPTIONS", "detect_leaks=0", 0); // MPI keeps what it found for the life of the program
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ranks),
        cmocka_unit_test(test_ranks_of_shards),
        cmocka_unit_test(test_failing_tile),
        cmocka_unit_test(test_killed_rank),
    };
    return cmocka_run_group_tests(tests, make_city, cli_leave_folder);
}
