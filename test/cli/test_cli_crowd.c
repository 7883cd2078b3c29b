// SPDX-License-Identifier: MIT
//
// talus crowd: all arrive, the same bytes for any number of threads, films that say what the run did, and every fault
// of a scenario named with its place.
#include "cli_run.h"

#include <math.h>

static void write_level(void)
{
    cli_write_floor("floor.obj", 80, false);
    cli_do(0, "bake floor.obj -o floor.talus");
    cli_write_text("two.json", "{ \"seconds\": 60, \"groups\": ["
                               " { \"name\": \"a\", \"count\": 12, \"at\": [4, 0, 20], \"goals\": [[16, 0, 20]] },"
                               " { \"name\": \"b\", \"count\": 12, \"at\": [16, 0, 20], \"goals\": [[4, 0, 20]] } ] }");
}

static void test_all_arrive(void **state)
{
    (void)state;
    write_level();
    json_t *one = cli_json(0, "crowd floor.talus two.json --json --threads 1");
    json_t *many = cli_json(0, "crowd floor.obj two.json --json --threads 3");
    TEST_CHECK(cli_number(one, "agents") == 24 && cli_number(one, "arrived") == 24);
    TEST_CHECK(cli_number(one, "unreachable") == 0 && cli_number(one, "off_mesh") == 0);
    TEST_CHECK(cli_number(one, "last_arrived_after") >= cli_number(one, "half_arrived_after"));
    // 12 m at 1.4 m/s at least, and the run ends with the last.
    TEST_CHECK(cli_number(one, "half_arrived_after") > 7 && cli_number(one, "seconds") < 60);
    TEST_CHECK(cli_number(one, "deepest_overlap") < 0.15);
    assert_string_equal(json_string_value(json_object_get(one, "hash")),
                        json_string_value(json_object_get(many, "hash")));
    json_decref(one);
    json_decref(many);
}

// A guard walks to and fro until the end, another group sets out late, a vehicle drives through.
static void test_goals_and_vehicles(void **state)
{
    (void)state;
    cli_write_text("guard.json",
                   "{ \"seconds\": 40, \"groups\": ["
                   " { \"at\": [4, 0, 10], \"goals\": [[9, 0, 10], [4, 0, 10]], \"repeat\": true, \"speed\": 2 },"
                   " { \"count\": 3, \"at\": [4, 0, 30], \"goals\": [[9, 0, 30]], \"start\": 20 } ],"
                   " \"vehicles\": [ { \"from\": [2, 0, 2], \"to\": [12, 0, 2], \"start\": 1, \"speed\": 5 } ] }");
    cli_result lines = cli_expect(0, "crowd floor.talus guard.json -o - --every 1");
    uint32_t frames = 0, turns = 0;
    double last_x = 4.0, last_way = 1.0;
    for (char *line = strtok(lines.out, "\n"); line != NULL; line = strtok(NULL, "\n"), ++frames) {
        json_t *frame = json_loads(line, 0, NULL);
        TEST_CHECK(frame != NULL && cli_number(frame, "t") == frames);
        const json_t *places = json_object_get(frame, "places");
        TEST_CHECK(json_array_size(places) == 5 && json_array_size(json_object_get(frame, "status")) == 5);
        const double x = json_number_value(json_array_get(json_array_get(places, 0), 0));
        if (x != last_x && (x > last_x) != (last_way > 0)) {
            ++turns;
            last_way = -last_way;
        }
        last_x = x;
        const double late = json_number_value(json_array_get(json_array_get(places, 1), 0));
        TEST_CHECK(frames >= 20 || fabs(late - 4.0) < 1.0); // it waits for its start
        const double car = json_number_value(json_array_get(json_array_get(places, 4), 0));
        const double wanted = frames <= 1 ? 2.0 : frames >= 3 ? 12.0 : 7.0;
        TEST_CHECK(fabs(car - wanted) < 0.3); // a step late: where it was in the step before
        json_decref(frame);
    }
    TEST_CHECK(frames == 41 && turns >= 8);
    cli_free(&lines);
}

static uint32_t count_parts(const char *text, const char *part)
{
    uint32_t count = 0;
    for (const char *at = text; (at = strstr(at, part)) != NULL; ++at) {
        ++count;
    }
    return count;
}

static void test_films(void **state)
{
    (void)state;
    cli_do(0, "crowd floor.talus two.json -o film.svg");
    size_t size;
    char *svg = cli_read_file("film.svg", &size);
    TEST_CHECK(count_parts(svg, "<circle") == 24 && count_parts(svg, "<animate ") == 48 &&
               strstr(svg, "</svg>") != NULL);
    TEST_CHECK(strstr(svg, "nan") == NULL && strstr(svg, "inf") == NULL);
    free(svg);
    cli_do(0, "crowd floor.talus two.json -o film.jsonl");
    TEST_CHECK(cli_exists("film.jsonl"));
}

// talus draw: traces in the colours of the groups, straight ones of few lines; obstacles need the level.
static void test_traces(void **state)
{
    (void)state;
    write_level();
    cli_result drawn = cli_expect(0, "draw floor.talus -o traces.svg --scenario two.json --view top --size 300");
    cli_check_part(drawn.out, "24 of 24 agents arrived, the last after ");
    cli_free(&drawn);
    char *svg = cli_read_file("traces.svg", NULL);
    TEST_CHECK(count_parts(svg, "stroke:rgb(0%,44.70") >= 12 && count_parts(svg, "stroke:rgb(90.19") >= 12);
    free(svg);
    // One that walks straight for 8 s, 64 frames, is few lines.
    cli_write_text("one.json", "{ \"groups\": [ { \"at\": [4, 0, 20], \"goals\": [[16, 0, 20]] } ] }");
    cli_do(0, "draw floor.talus -o one.svg --scenario one.json --view top --size 300");
    svg = cli_read_file("one.svg", NULL);
    const uint32_t lines = count_parts(svg, "stroke:rgb(0%,44.70");
    TEST_CHECK(lines >= 1 && lines <= 8);
    free(svg);
    // With an obstacle the level is baked in tiles; of a baked file that cannot be.
    cli_write_text("crate.json", "{ \"groups\": [ { \"at\": [4, 0, 20], \"goals\": [[16, 0, 20]] } ],"
                                 " \"obstacles\": [ { \"at\": [10, 0, 20], \"size\": [1, 4], \"turn\": 20 } ] }");
    cli_do(0, "draw floor.obj -o crate.png --stage navmesh,crowd --scenario crate.json --size 200");
    TEST_CHECK(cli_exists("crate-navmesh.png") && cli_exists("crate-crowd.png"));
    json_t *all = cli_json(0, "draw floor.obj -o all.png --stage all --scenario two.json --size 200 --json");
    TEST_CHECK(json_array_size(json_object_get(all, "pictures")) == 14);
    json_decref(all);
    cli_check_error(3, "draw floor.talus -o crate.png --scenario crate.json", "a baked file", "give the level itself");
    cli_check_error(2, "draw floor.talus -o x.png --stage crowd", "--scenario FILE.json", "talus crowd --help");
    cli_check_error(2, "draw floor.talus -o x.png --stage soup --scenario two.json", "--scenario", "add crowd");
    cli_check_error(4, "draw floor.talus -o x.png --scenario no.json", "no.json", "check the path");
    cli_check_error(3, "draw floor.talus -o x.png --scenario floor.obj", "floor.obj", "");
}

// A bar across the floor that goes after 20 s: nobody is past it before, all arrive later, and the film shows when it
// is there. The same for any number of threads; another that stays for ever leaves the goal unreachable.
static void test_obstacles(void **state)
{
    (void)state;
    cli_write_text("bar.json",
                   "{ \"seconds\": 90, \"groups\": [ { \"count\": 6, \"at\": [4, 0, 20], \"goals\": [[16, 0, 20]] } ],"
                   " \"obstacles\": [ { \"at\": [10, 0, 20], \"size\": [1, 200], \"until\": 20 },"
                   " { \"at\": [4, 0, 30], \"radius\": 1, \"from\": 5 } ] }");
    json_t *one = cli_json(0, "crowd floor.obj bar.json --json --threads 1");
    json_t *many = cli_json(0, "crowd floor.obj bar.json --json --threads 3");
    TEST_CHECK(cli_number(one, "arrived") == 6 && cli_number(one, "unreachable") == 0);
    TEST_CHECK(cli_number(one, "half_arrived_after") > 23 && cli_number(one, "last_arrived_after") < 60);
    assert_string_equal(json_string_value(json_object_get(one, "hash")),
                        json_string_value(json_object_get(many, "hash")));
    json_decref(one);
    json_decref(many);
    cli_result lines = cli_expect(0, "crowd floor.obj bar.json -o - --every 1");
    uint32_t frames = 0, past = 0;
    for (char *line = strtok(lines.out, "\n"); line != NULL; line = strtok(NULL, "\n"), ++frames) {
        json_t *frame = json_loads(line, 0, NULL);
        for (size_t i = 0; i < 6; ++i) {
            const double x = json_number_value(json_array_get(json_array_get(json_object_get(frame, "places"), i), 0));
            past += x > 9.5;
            TEST_CHECK(frames > 20 || x < 9.5);
        }
        json_decref(frame);
    }
    TEST_CHECK(frames > 23 && past > 0);
    cli_free(&lines);
    cli_do(0, "crowd floor.obj bar.json -o bar.svg");
    size_t size;
    char *svg = cli_read_file("bar.svg", &size);
    TEST_CHECK(strstr(svg, "values=\"visible;hidden\" keyTimes=\"0;0.") != NULL);
    TEST_CHECK(strstr(svg, "values=\"hidden;visible\" keyTimes=\"0;0.") != NULL && strstr(svg, "nan") == NULL);
    free(svg);
    cli_write_text("shut.json", "{ \"seconds\": 30, \"groups\": [ { \"at\": [4, 0, 20], \"goals\": [[16, 0, 20]] } ],"
                                " \"obstacles\": [ { \"at\": [10, 0, 20], \"size\": [1, 200] } ] }");
    json_t *shut = cli_json(1, "crowd floor.obj shut.json --json");
    TEST_CHECK(cli_number(shut, "arrived") == 0 && cli_number(shut, "unreachable") == 1);
    TEST_CHECK(cli_number(shut, "seconds") < 30);
    json_decref(shut);
    cli_check_error(3, "crowd floor.talus shut.json", "a baked file", "give the level itself");
    cli_check_error(2, "crowd floor.obj shut.json --drop-inside-solids", "pruned", "leave those options out");
    cli_check_error(2, "crowd floor.obj shut.json --link 4,0,20,16,0,20", "linked by hand", "");
}

// A trunk that lies across the floor, and a wall that leans: nobody passes. Where the wall leans so far that its other
// end is above the agents' heads, all do. Both are in the film.
static void test_leaning_obstacles(void **state)
{
    (void)state;
    const char *const obstacle[] = { "{ \"at\": [10, 0.5, -50], \"to\": [10, 0.5, 80], \"radius\": 0.5 }",
                                     "{ \"at\": [10, 0, 20], \"size\": [0.2, 200], \"height\": 3, \"tilt\": 60 }",
                                     "{ \"at\": [10, 2.5, 20], \"size\": [0.2, 200], \"height\": 3, \"tilt\": -60 }" };
    for (int i = 0; i < 3; ++i) {
        char scenario[400];
        snprintf(
            scenario, sizeof(scenario),
            "{ \"seconds\": 60, \"groups\": [ { \"at\": [4, 0, 20], \"goals\": [[16, 0, 20]] } ], \"obstacles\": [ "
            "%s ] }",
            obstacle[i]);
        cli_write_text("leaning.json", scenario);
        json_t *found = cli_json(i < 2 ? 1 : 0, "crowd floor.obj leaning.json --json");
        TEST_CHECK(cli_number(found, "arrived") == (i < 2 ? 0 : 1));
        json_decref(found);
        cli_do(i < 2 ? 1 : 0, "crowd floor.obj leaning.json -o leaning.svg");
        size_t size;
        char *svg = cli_read_file("leaning.svg", &size);
        TEST_CHECK(strstr(svg, i == 0 ? "stroke-linecap=\"round\"" : "rotate(") != NULL && strstr(svg, "nan") == NULL);
        free(svg);
    }
}

// The scenarios that come with the sources.
static void test_examples(void **state)
{
    (void)state;
    static const char *const runs[] = { "halls.obj door.json", "halls.obj patrol.json", "halls.obj formations.json" };
    for (size_t i = 0; i < sizeof(runs) / sizeof(runs[0]); ++i) {
        char level[32], scenario[32], line[1024];
        TEST_CHECK(sscanf(runs[i], "%31s %31s", level, scenario) == 2);
        snprintf(line, sizeof(line),
                 "crowd %s/examples/crowds/%s %s/examples/crowds/%s --agent-radius 0.3 --cell-size 0.15 --json",
                 TALUS_SOURCE_DIR, level, TALUS_SOURCE_DIR, scenario);
        json_t *outcome = cli_json(0, line);
        TEST_CHECK(cli_number(outcome, "arrived") == cli_number(outcome, "agents"));
        json_decref(outcome);
    }
}

// Four agents in slots of their own: at the end they stand there, around the first.
static void test_slots(void **state)
{
    (void)state;
    cli_write_text("slots.json", "{\"groups\": [{\"at\": [4, 0, 20], \"goals\": [[16, 0, 20]], \"count\": 4,"
                                 "\"formation\": [[-1, 1], [-1, -1], [-2, 0]]}]}");
    json_t *outcome = cli_json(0, "crowd floor.talus slots.json --json");
    TEST_CHECK(cli_number(outcome, "arrived") == 4);
    json_decref(outcome);
    cli_result lines = cli_expect(0, "crowd floor.talus slots.json -o -");
    const char *last = lines.out;
    for (char *line = strtok(lines.out, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        last = line;
    }
    json_t *frame = json_loads(last, 0, NULL);
    const json_t *places = json_object_get(frame, "places");
    const json_t *leader = json_array_get(places, 0);
    double behind = 0.0, beside = 0.0;
    for (size_t i = 1; i < 4; ++i) {
        const json_t *place = json_array_get(places, i);
        behind += json_number_value(json_array_get(leader, 0)) - json_number_value(json_array_get(place, 0));
        beside += fabs(json_number_value(json_array_get(leader, 2)) - json_number_value(json_array_get(place, 2)));
    }
    TEST_CHECK(fabs(behind - 4.0) < 0.4 && fabs(beside - 2.0) < 0.4);
    json_decref(frame);
    cli_free(&lines);
}

static void test_not_all_arrive(void **state)
{
    (void)state;
    cli_write_text("short.json", "{\"seconds\": 1, \"groups\": [{\"at\": [4, 0, 20], \"goals\": [[16, 0, 20]]}]}");
    json_t *outcome = cli_json(1, "crowd floor.talus short.json --json");
    TEST_CHECK(cli_number(outcome, "arrived") == 0 && cli_number(outcome, "seconds") == 1);
    json_decref(outcome);
}

static void test_faults(void **state)
{
    (void)state;
    static const char *const faults[][2] = {
        { "{\"groops\": []}", "groops is no key" },
        { "{}", "groups is empty" },
        { "{\"groups\": [{\"at\": [1, 2], \"goals\": [[9, 0, 9]]}]}", "groups[0].at is no place" },
        { "{\"groups\": [{\"at\": [4, 0, 9]}]}", "groups[0].goals holds no place" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9], 5]}]}", "groups[0].goals[1] is no place" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, \"x\"]]}]}", "groups[0].goals[0] is no place" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9]], \"radius\": -1}]}",
          "groups[0].radius is no number" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9]], \"count\": 0}]}", "groups[0].count" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9]], \"count\": 99999}]}", "there is room for" },
        { "{\"groups\": [{\"at\": [400, 0, 9], \"goals\": [[9, 0, 9]]}]}", "no navmesh within 2 m of its \"at\"" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 90, 9]]}]}", "no navmesh within 2 m of its goals[0]" },
        { "{\"step\": 2, \"groups\": []}", "step is no number from 0.001 to 1" },
        { "{\"groups\": [], \"vehicles\": [{\"from\": [0, 0, 0]}]}", "vehicles[0].to is no place" },
        { "{\"groups\": [], \"obstacles\": [{\"at\": [0, 0, 0]}]}", "obstacles[0].size is no size" },
        { "{\"groups\": [], \"obstacles\": [{\"at\": [0, 0, 0], \"size\": [1, 0]}]}", "obstacles[0].size is no size" },
        { "{\"groups\": [], \"obstacles\": [{\"at\": [0, 0, 0], \"size\": [1, 1], \"radius\": 1}]}", "beside a size" },
        { "{\"groups\": [], \"obstacles\": [{\"at\": [0, 0, 0], \"radius\": 1, \"from\": 5, \"until\": 5}]}",
          "until is not after from" },
        { "{\"groups\": [], \"obstacles\": [{\"at\": [0, 0, 0], \"size\": [1, 1], \"to\": [1, 0, 0]}]}",
          "obstacles[0].to is given without a radius" },
        { "{\"groups\": [], \"obstacles\": [{\"at\": [0, 0, 0], \"radius\": 1, \"tilt\": 5}]}", "tilt is for boxes" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9]], \"formation\": \"square\"}]}",
          "groups[0].formation is none of loose" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9]], \"count\": 3, \"formation\": [[1, 1]]}]}",
          "groups[0].formation has not one slot" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9]], \"count\": 2, \"formation\": [[1, 2000]]}]}",
          "groups[0].formation[0] is no slot" },
        { "{\"groups\": [{\"at\": [4, 0, 9], \"goals\": [[9, 0, 9]], \"apart\": 1}]}", "apart is given without" },
        { "{\"groups\": [", "cut short" },
    };
    for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); ++i) {
        cli_write_text("fault.json", faults[i][0]);
        cli_check_error(3, "crowd floor.talus fault.json -o fault.svg", faults[i][1], "");
        TEST_CHECK(!cli_exists("fault.svg"));
    }
    cli_check_error(4, "crowd floor.talus no.json", "no.json", "check the path");
    cli_check_error(2, "crowd floor.talus", "SCENARIO", "");
    cli_check_error(2, "crowd floor.talus two.json -o film.png", "film.png", ".svg");
    cli_check_error(4, "crowd floor.talus two.json -o no/such/film.svg", "no/such", ";");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_arrive), cmocka_unit_test(test_goals_and_vehicles),
        cmocka_unit_test(test_films),      cmocka_unit_test(test_traces),
        cmocka_unit_test(test_obstacles),  cmocka_unit_test(test_leaning_obstacles),
        cmocka_unit_test(test_examples),   cmocka_unit_test(test_not_all_arrive),
        cmocka_unit_test(test_slots),      cmocka_unit_test(test_faults),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
