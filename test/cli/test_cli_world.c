// SPDX-License-Identifier: MIT
//
// talus world: the same bytes whatever the shards, threads, order and interruptions; only what changed is baked again;
// every fault has a name, and the next run mends it.
#include "cli_run.h"

#include <dirent.h>
#include <sys/resource.h>

static void shell(const char *line)
{
    if (system(line) != 0) {
        fail_msg("%s", line);
    }
}

// The path of the n-th file below `folder` whose name ends in `ending`, in order.
static void find_file(const char *folder, const char *ending, int n, char path[256])
{
    char line[256];
    snprintf(line, sizeof line, "find %s -name '*%s' | sort | sed -n %dp > found.txt", folder, ending, n);
    shell(line);
    char *text = cli_read_file("found.txt", NULL);
    assert_true(strlen(text) > 0 && strlen(text) < 256);
    text[strcspn(text, "\n")] = '\0';
    strcpy(path, text);
    free(text);
}

static double baked_now(const char *line)
{
    json_t *object = cli_json(0, line);
    const double count = cli_number(object, "baked");
    json_decref(object);
    return count;
}

static void test_same_as_plain_bake(void **state)
{
    (void)state;
    static const char *const levels[] = { "city", "terrain", "dungeon", "courtyard" };
    static const char *const settings[] = { "--tile-size 48", "--tile-size 64 --agent-radius 0.3 --tile-height 4",
                                            "--tile-size 100 --cell-size 0.4 --partition monotone",
                                            "--tile-size 40 --polygons optimal --agent-max-slope 30" };
    for (int i = 0; i < 4; i++) {
        char line[256];
        snprintf(line, sizeof line, "sample %s -n 20000 -o level.obj", levels[i]);
        cli_do(0, line);
        snprintf(line, sizeof line, "bake level.obj --no-soup %s -o plain.talus", settings[i]);
        cli_do(0, line);
        shell("rm -rf job");
        snprintf(line, sizeof line, "world plan level.obj -o job %s", settings[i]);
        cli_do(0, line);
        cli_do(0, "world bake job");
        cli_do(0, "world merge job -o world.talus");
        cli_check_same_files("plain.talus", "world.talus");
        cli_do(0, "world check world.talus");
        cli_do(0, "check world.talus");
    }
}

static void test_shards_and_threads(void **state)
{
    (void)state;
    static const int counts[] = { 1, 3, 7 };
    cli_do(0, "sample city -n 40000 -o land.obj");
    for (int c = 0; c < 3; c++) {
        char line[256];
        double tiles = 0, planned;
        shell("rm -rf job");
        json_t *plan = cli_json(0, "world plan land.obj -o job --tile-size 24 --memory 16 --json");
        planned = cli_number(plan, "tiles");
        json_decref(plan);
        for (int i = 1; i <= counts[c]; i++) {
            snprintf(line, sizeof line, "world bake job --shard %d/%d --threads %d --json", i, counts[c], 1 + i % 3);
            tiles += baked_now(line);
        }
        TEST_CHECK(tiles == planned && planned > 200); // every tile in one shard
        snprintf(line, sizeof line, "world merge job -o by_%d.talus", counts[c]);
        cli_do(0, line);
    }
    cli_check_same_files("by_1.talus", "by_3.talus");
    cli_check_same_files("by_1.talus", "by_7.talus");
}

// The faces of an OBJ in the opposite order, in two files whose vertices are the same.
static void split_backwards(const char *path, const char *a_path, const char *b_path)
{
    char line[512];
    snprintf(
        line, sizeof line,
        "(grep '^v ' %s; grep '^f ' %s | tac | awk 'NR %% 2') > %s; (grep '^v ' %s; grep '^f ' %s | tac | awk 'NR %% "
        "2 == 0') > %s",
        path, path, a_path, path, path, b_path);
    shell(line);
}

static void test_order_of_inputs(void **state)
{
    (void)state;
    shell("mkdir -p whole parts");
    cli_do(0, "sample city -n 30000 -o city.obj");
    split_backwards("city.obj", "first.obj", "second.obj");
    cli_write_text("whole/world.json", "{ \"inputs\": [ { \"file\": \"../city.obj\" } ] }");
    cli_write_text("parts/world.json",
                   "{ \"inputs\": [ { \"file\": \"../second.obj\" }, { \"file\": \"../first.obj\" } ] }");
    double keys[2] = { 0, 0 };
    static const char *const inputs[] = { "whole", "parts" };
    for (int i = 0; i < 2; i++) {
        char line[128];
        snprintf(line, sizeof line, "world plan %s/world.json -o shared --tile-size 64", inputs[i]);
        cli_do(0, line);
        keys[i] = baked_now("world bake shared --json");
        snprintf(line, sizeof line, "world merge shared -o %s.talus", inputs[i]);
        cli_do(0, line);
    }
    TEST_CHECK(keys[0] > 20 && keys[1] == 0); // the same triangles have the same keys, whatever files they came in
    shell("rm -rf shared");
    cli_do(0, "world plan parts/world.json -o shared --tile-size 64 --threads 1");
    TEST_CHECK(baked_now("world bake shared --json") == keys[0]);
    cli_do(0, "world merge shared -o fresh.talus");
    cli_check_same_files("parts.talus", "fresh.talus");
    // META counts the vertices of all files, which are there twice; the tiles are the same.
    cli_do(0, "world check whole.talus");
    size_t a_size, b_size;
    char *a = cli_read_file("whole.talus", &a_size), *b = cli_read_file("parts.talus", &b_size);
    assert_int_equal(a_size, b_size);
    size_t differs = 0;
    for (size_t k = 0; k < a_size; k++) {
        differs += a[k] != b[k];
    }
    TEST_CHECK(differs > 0 && differs < 40); // the count, and the hashes over it
    free(a);
    free(b);
}

static void sleep_ms(long ms)
{
    const struct timespec time = { ms / 1000, ms % 1000 * 1000000 };
    nanosleep(&time, NULL);
}

// Files of a job's tiles, finished ones: in one folder of 256 each.
static uint32_t count_tiles(const char *job)
{
    uint32_t count = 0;
    for (uint32_t part = 0; part < 256; part++) {
        char path[64];
        snprintf(path, sizeof path, "%s/tiles/%02x", job, part);
        DIR *folder = opendir(path);
        for (struct dirent *entry; folder != NULL && (entry = readdir(folder)) != NULL;) {
            count += entry->d_name[0] != '.';
        }
        if (folder != NULL) {
            closedir(folder);
        }
    }
    return count;
}

static uint32_t next_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 33);
}

// Seconds of work for one thread under a sanitizer, and hundreds of tiles.
#define WILD "wild.obj --tile-size 24"

static void test_kills(void **state)
{
    (void)state;
    cli_do(0, "sample city -n 100000 --seed 5 -o wild.obj");
    cli_do(0, "world plan " WILD " -o once");
    cli_do(0, "world bake once");
    cli_do(0, "world merge once -o once.talus");
    uint64_t random = 12345;
    for (int i = 0; i < 6; i++) {
        const pid_t child = cli_start("world plan " WILD " -o often", "/dev/null", "out.txt", "err.txt");
        sleep_ms((long)(next_random(&random) % 25));
        kill(child, SIGKILL);
        const int code = cli_wait(child);
        assert_true(code == 256 + SIGKILL || code == 0);
    }
    cli_do(0, "world plan " WILD " -o often");
    // However fast the machine is: a bake lives until it has made some tiles more.
    for (int i = 0; i < 14; i++) {
        const uint32_t enough = count_tiles("often") + next_random(&random) % 20;
        const pid_t child = cli_start("world bake often --threads 1", "/dev/null", "out.txt", "err.txt");
        for (int waits = 0; waits < 120000 && count_tiles("often") < enough; waits++) {
            sleep_ms(1);
        }
        kill(child, SIGKILL);
        assert_int_equal(cli_wait(child), 256 + SIGKILL);
    }
    json_t *before = cli_json(1, "world status often --json"); // what was baked before the kills is there
    const double there = cli_number(before, "there"), tiles = cli_number(before, "tiles");
    json_decref(before);
    TEST_CHECK(there > 14 && there == count_tiles("often"));
    TEST_CHECK(baked_now("world bake often --json") == tiles - there);
    cli_do(0, "world status often");
    cli_do(0, "world merge often -o often.talus");
    cli_check_same_files("once.talus", "often.talus");
}

// Two processes bake all tiles at the same time.
static void test_race(void **state)
{
    (void)state;
    cli_do(0, "world plan " WILD " -o raced");
    const pid_t a = cli_start("world bake raced", "/dev/null", "a.txt", "a.err");
    const pid_t b = cli_start("world bake raced", "/dev/null", "b.txt", "b.err");
    assert_int_equal(cli_wait(a), 0);
    assert_int_equal(cli_wait(b), 0);
    cli_do(0, "world merge raced -o raced.talus");
    cli_check_same_files("once.talus", "raced.talus");
    shell("test -z \"$(find raced -name '.talus*')\""); // nothing half written is left
}

static void write_town(double house_x)
{
    char text[256];
    snprintf(text, sizeof text,
             "{ \"inputs\": [ { \"file\": \"floor.obj\" }, { \"file\": \"house.obj\", \"translate\": [%g, 0, 30] } ] }",
             house_x);
    cli_write_text("town.json", text);
}

// Tiles whose window a house 10 m square meets, by the rule of tile_grid.h: a tile of 64 cells and 5 + 2 more around.
static int tiles_met(double x0, double x1, double other_x0, double other_x1)
{
    int count = 0;
    const double tile = 64 * 0.3, margin = 7 * 0.3, low = -150;
    for (int z = 0; z < 16; z++) {
        for (int x = 0; x < 16; x++) {
            const double tx = low + x * tile, tz = low + z * tile;
            const bool in_z = tz - margin <= 40 && tz + tile + margin >= 30;
            const bool in_x = (tx - margin <= x1 && tx + tile + margin >= x0) ||
                              (tx - margin <= other_x1 && tx + tile + margin >= other_x0);
            count += in_x && in_z;
        }
    }
    return count;
}

static void test_moved_building(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 300, false);
    cli_write_text("house.obj", "v 0 0 0\nv 10 0 0\nv 10 0 10\nv 0 0 10\nv 0 6 0\nv 10 6 0\nv 10 6 10\nv 0 6 10\n"
                                "f 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    write_town(10);
    cli_do(0, "world plan town.json -o town --tile-size 64");
    TEST_CHECK(baked_now("world bake town --json") == 16 * 16);
    write_town(50);
    json_t *plan = cli_json(0, "world plan town.json -o town --tile-size 64 --json");
    TEST_CHECK(cli_number(plan, "inputs_read") == 1);
    json_decref(plan);
    const int expected = tiles_met(10, 20, 50, 60);
    TEST_CHECK(expected >= 4 && expected <= 12);
    assert_int_equal((int)baked_now("world bake town --json"), expected);
    cli_do(0, "world merge town -o moved.talus");
    cli_do(0, "world plan town.json -o fresh_town --tile-size 64");
    cli_do(0, "world bake fresh_town");
    cli_do(0, "world merge fresh_town -o fresh_town.talus");
    cli_check_same_files("moved.talus", "fresh_town.talus");
    write_town(10); // back: all of it is there
    cli_do(0, "world plan town.json -o town --tile-size 64");
    TEST_CHECK(baked_now("world bake town --json") == 0);
}

static void test_tile_faults(void **state)
{
    (void)state;
    char path[256];
    cli_do(0, "world plan town.json -o faults --tile-size 64");
    cli_check_error(1, "world merge faults -o faults.talus", "256 of 256 tiles are missing", "first is tile 0,0");
    cli_do(0, "world bake faults");
    cli_do(0, "world merge faults -o whole.talus");
    find_file("faults/tiles", ".tile", 7, path);
    assert_int_equal(unlink(path), 0);
    cli_check_error(1, "world merge faults -o faults.talus", "1 of 256 tiles are missing", "talus world bake");
    assert_false(cli_exists("faults.talus"));
    cli_do(1, "world status faults");
    TEST_CHECK(baked_now("world bake faults --json") == 1);
    find_file("faults/tiles", ".tile", 9, path);
    cli_damage(path, true);
    cli_check_error(3, "world merge faults -o faults.talus", "is damaged: its content was altered", ".tile");
    assert_false(cli_exists(path)); // so that the next bake makes it again
    TEST_CHECK(baked_now("world bake faults --json") == 1);
    find_file("faults/tiles", ".tile", 11, path);
    assert_int_equal(truncate(path, 50), 0); // what a loss of power leaves counts as missing
    TEST_CHECK(baked_now("world bake faults --json") == 1);
    cli_do(0, "world merge faults -o faults.talus");
    cli_check_same_files("whole.talus", "faults.talus");
    cli_damage("faults.talus", false);
    cli_check_error(3, "world check faults.talus", "faults.talus", "chunk");
}

static void test_input_faults(void **state)
{
    (void)state;
    char path[256];
    cli_check_error(4, "world bake nowhere", "nowhere", "there is no such job");
    cli_check_error(4, "world plan nowhere.obj -o none", "nowhere.obj", "cannot open");
    cli_do(0, "sample courtyard -o yard.obj");
    cli_do(0, "world plan yard.obj -o yard --tile-size 64");
    shell("echo 'f 1 2 3' >> yard.obj");
    cli_check_error(3, "world bake yard", "yard.obj: changed since the plan", "--as-planned");
    TEST_CHECK(baked_now("world bake yard --as-planned --json") > 5);
    cli_check_error(3, "world merge yard -o yard.talus", "changed since the plan", "talus world plan");
    cli_do(0, "world merge yard --as-planned -o yard.talus");
    cli_do(0, "world plan yard.obj -o yard --tile-size 64");
    cli_do(0, "world bake yard");
    cli_do(0, "world merge yard -o yard.talus");
    // A damaged store is named, and made again.
    cli_do(0, "sample courtyard --seed 3 -o other.obj");
    cli_do(0, "world plan other.obj -o other --tile-size 64");
    find_file("other/store", ".segment", 1, path);
    cli_damage(path, false);
    cli_check_error(3, "world bake other", ".segment: the triangles of cell", "tiles failed");
    assert_int_equal(unlink(path), 0);
    cli_check_error(4, "world bake other", ".segment", "cannot open");
    cli_do(0, "world plan other.obj -o other --tile-size 64");
    cli_do(0, "world bake other");
    cli_damage("other/plan", false);
    cli_check_error(3, "world bake other", "other/plan: was altered", "talus world plan");
    cli_write_text("bad.json", "{ \"inputs\": [ { \"file\": \"yard.obj\", \"translat\": [1, 2, 3] } ] }");
    cli_check_error(3, "world plan bad.json -o bad", "inputs[0]", "translat");
    cli_write_text("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1e39\nf 1 2 3\n");
    cli_check_error(3, "world plan nan.obj -o bad", "nan.obj", "3");
    cli_write_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
    cli_check_error(3, "world plan flat.obj -o bad", "flat.obj", "none of the 1 triangles has area");
}

// A file system that is full, as far as a test may fill one: no file may grow beyond a limit.
static int run_with_limit(const char *line, rlim_t bytes)
{
    struct rlimit before, limit;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    limit = before;
    limit.rlim_cur = bytes;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    const int code = cli_wait(cli_start(line, "/dev/null", "limit.txt", "limit.err"));
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    return code;
}

static void check_limit_error(const char *line, rlim_t bytes, const char *part)
{
    const int code = run_with_limit(line, bytes);
    char *text = cli_read_file("limit.err", NULL);
    cli_check_part(text, part);
    cli_check_part(text, "cannot write");
    free(text);
    assert_int_equal(code, 4);
}

static void test_full_disk(void **state)
{
    (void)state;
    cli_do(0, "sample city -n 20000 -o full.obj");
    check_limit_error("world plan full.obj -o full --tile-size 64", 100000, "full/store/");
    shell("test -z \"$(find full -name '*.segment')\"");
    cli_do(0, "world plan full.obj -o full --tile-size 64");
    check_limit_error("world bake full", 4000, "full/tiles/");
    cli_do(1, "world status full");
    cli_do(0, "world bake full");
    cli_check_error(4, "world merge full -o /dev/full", "/dev/full", "cannot write");
    cli_do(0, "world merge full -o full.talus");
    cli_do(0, "bake full.obj --no-soup --tile-size 64 -o plain.talus");
    cli_check_same_files("plain.talus", "full.talus");
    assert_int_equal(cli_wait(cli_start("world merge full -o -", "/dev/null", "piped.talus", "piped.err")), 0);
    cli_check_same_files("plain.talus", "piped.talus");
    cli_check_error(2, "world merge full -o - --json", "--json and -o -", "standard output");
}

// How long tiles took is noted beside them, by every process, and replayed.
static void test_times(void **state)
{
    (void)state;
    cli_do(0, "world plan full.obj -o timed --tile-size 64");
    cli_check_error(1, "world status timed --ranks 4", "not known how long they take", "bake them first");
    const double half = baked_now("world bake timed --shard 1/2 --json");
    json_t *first = cli_json(1, "world status timed --json");
    TEST_CHECK(half > 5 && cli_number(first, "timed") == half && cli_number(first, "seconds") > 0);
    json_decref(first);
    cli_do(0, "world bake timed --shard 2/2");
    json_t *all = cli_json(0, "world status timed --ranks 4 --json");
    json_t *replay = json_object_get(all, "replay");
    TEST_CHECK(cli_number(all, "timed") == cli_number(all, "tiles"));
    assert_non_null(replay);
    TEST_CHECK(cli_number(replay, "ranks") == 4 && cli_number(replay, "idle_dealt") >= 0 &&
               cli_number(replay, "idle_dealt") < 0.75 && cli_number(replay, "idle_shards") < 0.75);
    json_decref(all);
    cli_result text = cli_expect(0, "world status timed --ranks 1");
    cli_check_part(text.out, "ranks    1: idle 0.0% with mpirun, 0.0% with --shard");
    cli_check_part(text.out, "s of processor for");
    cli_free(&text);
    cli_check_error(2, "world status timed --ranks 4 --shard 1/2", "--ranks", "--shard");
    cli_check_error(2, "world bake timed --ranks 4", "--ranks is no option", "talus world bake");
}

// The schedulers' variables, as the processes of a job see them.
static void test_environment(void **state)
{
    (void)state;
    cli_do(0, "world plan full.obj -o array --tile-size 64");
    double tiles = 0;
    setenv("SLURM_ARRAY_TASK_COUNT", "3", 1);
    setenv("SLURM_ARRAY_TASK_MIN", "5", 1);
    for (int i = 5; i < 8; i++) {
        char id[8];
        snprintf(id, sizeof id, "%d", i);
        setenv("SLURM_ARRAY_TASK_ID", id, 1);
        tiles += baked_now("world bake array --json");
    }
    cli_result text = cli_expect(0, "world bake array");
    cli_check_part(text.out, "shard    3 of 3, says SLURM_ARRAY_TASK_ID");
    cli_free(&text);
    setenv("SLURM_ARRAY_TASK_ID", "9", 1);
    cli_check_error(2, "world bake array", "SLURM_ARRAY_TASK_ID is 9, which is not one of 3 from 5 on", "--shard I/N");
    unsetenv("SLURM_ARRAY_TASK_ID");
    unsetenv("SLURM_ARRAY_TASK_COUNT");
    unsetenv("SLURM_ARRAY_TASK_MIN");
    cli_do(0, "world status array");
    json_t *all = cli_json(0, "world status array --json");
    TEST_CHECK(tiles > 15 && tiles == cli_number(all, "tiles"));
    json_decref(all);
    cli_check_error(2, "world bake array --shard 4/3", "'4/3' is no shard", "from 1 to N");
    cli_check_error(2, "world bake array --tile-size 3", "--tile-size is no option", "talus world bake");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_as_plain_bake),
        cmocka_unit_test(test_shards_and_threads),
        cmocka_unit_test(test_order_of_inputs),
        cmocka_unit_test(test_kills),
        cmocka_unit_test(test_race),
        cmocka_unit_test(test_moved_building),
        cmocka_unit_test(test_tile_faults),
        cmocka_unit_test(test_input_faults),
        cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_times),
        cmocka_unit_test(test_environment),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
