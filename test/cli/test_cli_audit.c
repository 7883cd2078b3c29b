// SPDX-License-Identifier: MIT
//
// talus audit and talus why.
#include "cli_run.h"

#include <talus/pack.h>

#include <math.h>

static void test_a_sound_level(void **state)
{
    (void)state;
    cli_write_floor("wall.obj", 20, true);
    cli_do(0, "bake wall.obj -o wall.talus");
    cli_result baked = cli_expect(0, "audit wall.talus --paths 200");
    cli_check_part(baked.out, "200 paths");
    cli_check_part(baked.out, "the navmesh and the triangles agree");
    cli_result level = cli_expect(0, "audit wall.obj --paths 200 --threads 1");
    assert_string_equal(baked.out, level.out);
    cli_free(&baked);
    cli_free(&level);
    json_t *json = cli_json(0, "audit wall.talus --paths 50 --json");
    assert_true(json_is_true(json_object_get(json, "clean")));
    TEST_CHECK(cli_number(json, "paths") == 50.0 && cli_number(json, "finding_count") == 0.0);
    TEST_CHECK(cli_number(json, "sweeps") > 500.0 && cli_number(json, "probe.radius") > 0.29);
    TEST_CHECK(json_object_get(json_object_get(json, "seconds"), "audit paths") != NULL);
    json_decref(json);
}

// A material takes one of two floors out of the navmesh. The level's file tells the audit so; a baked file does not.
static tl_result append_to_file(const void *bytes, size_t size, void *user)
{
    assert_int_equal(fwrite(bytes, 1, size, (FILE *)user), size);
    return TL_OK;
}

// Writes a baked file again without its areas: its navmesh then lacks floor that nothing in the file explains.
static void forget_areas(const char *path)
{
    size_t size;
    char *text = cli_read_file(path, &size);
    void *bytes = test_blob_alloc(size);
    memcpy(bytes, text, size);
    free(text);
    tl_pack pack;
    TEST_RESULT(tl_pack_open(bytes, size, &pack, NULL), TL_OK);
    tl_pack_item items[16];
    uint32_t count = 0;
    for (uint32_t i = 0; i < pack.chunk_count; i++) {
        const tl_pack_chunk chunk = tl_pack_chunk_at(&pack, i);
        const tl_pack_item item = { chunk.type, chunk.id, chunk.bytes, chunk.size };
        TEST_CHECK(count < 16);
        items[count] = item;
        count += chunk.type != TL_PACK_AREA;
    }
    TEST_CHECK(count + 1 == pack.chunk_count);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    TEST_RESULT(tl_pack_write(items, count, NULL, append_to_file, file, NULL), TL_OK);
    fclose(file);
    test_blob_free(bytes);
}

static void test_missing_navmesh(void **state)
{
    (void)state;
    cli_write_text("floors.obj", "v -10 0 -10\nv -10 0 10\nv 10 0 10\nv 10 0 -10\nf 1 2 3 4\n"
                                 "v 12 0 0\nv 12 0 9\nv 21 0 9\nv 21 0 0\nusemtl lava\nf 5 6 7 8\n");
    cli_do(0, "bake floors.obj --area lava=0 -o hole.talus");
    cli_do(0, "audit floors.obj --area lava=0 --paths 50");
    cli_do(0, "audit hole.talus --paths 50");
    forget_areas("hole.talus");
    cli_result result = cli_expect(1, "audit hole.talus --paths 50 --draw hole.png --size 200");
    cli_check_part(result.out, "missing   at ");
    cli_check_part(result.out, "m2");
    cli_check_part(result.out, "changed");
    cli_free(&result);
    assert_true(cli_exists("hole.png"));
    json_t *json = cli_json(1, "audit hole.talus --paths 50 --json");
    assert_true(json_is_false(json_object_get(json, "clean")));
    TEST_CHECK(cli_number(json, "finding_count") == 1.0 && fabs(cli_number(json, "missing_area") - 49.0) < 16.0);
    const json_t *finding = json_array_get(json_object_get(json, "findings"), 0);
    assert_string_equal(json_string_value(json_object_get(finding, "kind")), "missing");
    assert_string_equal(json_string_value(json_object_get(finding, "cause")), "changed");
    json_decref(json);
    cli_do(0, "audit hole.talus --paths 50 --min-area 100");
}

// A ramp goes on under a platform that one steps up to from it: its column of voxels is as high as its upper side, from
// where the step is low enough. Whoever has walked to the lower side has more before him, which is no fault.
static void test_ramp_under_a_platform(void **state)
{
    (void)state;
    cli_write_text("ramp.obj", "v -3 4 0\nv -3 4 6\nv 3 4 6\nv 3 4 0\n"
                               "v -3 4.2935 -1.7\nv -3 2 0.714211\nv 3 2 0.714211\nv 3 4.2935 -1.7\n"
                               "v -3 4.2935 -6.2909\nv 3 4.2935 -6.2909\n"
                               "f 1 2 3 4\nf 5 6 7 8\nf 9 5 8 10\n");
    cli_do(0, "path ramp.obj 0,4.1,-5 0,4,5 --agent-radius 0.45");
    cli_do(0, "audit ramp.obj --agent-radius 0.45");
}

// A file keeps the volumes that it was baked with: where one cut the floor away nothing is missing, and why names it.
static void test_volumes_are_kept(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_write_text("areas.txt", "box 0 -4 -1 -4 0 1 4\nprism 0 -1 1 0 -4 0 4 4 4 4 -4\ncylinder 5 7 -1 7 1 2\n");
    cli_do(0, "bake floor.obj --areas areas.txt -o volumes.talus");
    cli_do(0, "check volumes.talus");
    cli_do(0, "audit floor.obj --areas areas.txt --paths 50");
    cli_do(0, "audit volumes.talus --paths 50");
    for (int i = 0; i < 2; i++) {
        cli_result result = cli_expect(1, i == 0 ? "why volumes.talus -2,0,0" : "why volumes.talus 2,0,0");
        cli_check_part(result.out, "volume");
        cli_free(&result);
    }
}

static void test_why(void **state)
{
    (void)state;
    cli_write_floor("wall.obj", 20, true);
    cli_do(0, "bake wall.obj -o wall.talus");
    cli_result result = cli_expect(0, "why wall.talus 5,0,0");
    cli_check_part(result.out, "walkable");
    cli_free(&result);
    result = cli_expect(1, "why wall.talus 0.75,0,0");
    cli_check_part(result.out, "radius (stage erode)");
    cli_check_part(result.out, "agent_radius 0.6 -> 0.3");
    cli_check_part(result.out, "proven");
    cli_free(&result);
    json_t *json = cli_json(1, "why wall.obj 0.75,0,0 --json");
    assert_true(json_is_true(json_object_get(json, "proven")));
    const json_t *reason = json_array_get(json_object_get(json, "reasons"), 0);
    assert_string_equal(json_string_value(json_object_get(reason, "parameter")), "agent_radius");
    char line[128];
    snprintf(line, sizeof line, "why wall.obj 0.75,0,0 --agent-radius %.9g",
             json_number_value(json_object_get(reason, "needed")));
    json_decref(json);
    cli_do(0, line); // the value does what it promises
    json = cli_json(1, "why wall.obj 5,9,0 --json");
    assert_false(json_is_true(json_object_get(json, "proven")));
    assert_null(json_object_get(json_array_get(json_object_get(json, "reasons"), 0), "parameter"));
    json_decref(json);
}

// What was pruned is meant to be gone: no finding, and "why" names the rule with the value that keeps the island.
static void test_pruned_files(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o yard.obj");
    cli_do(0, "bake yard.obj -o whole.talus");
    const char *const rules[][3] = {
        { "--island-min-area 60", "island of 37.26 m2, kept from --island-min-area 37.25 (now 60)", "29.55,5.5,10.35" },
        { "--drop-inside-solids", "kept without --drop-inside-solids", "3.75,0,29.55" },
        { "--reachable-from 20,0,30", "kept with one on it", "29.55,5.5,10.35" },
    };
    for (size_t i = 0; i < 3; i++) {
        char line[256];
        snprintf(line, sizeof line, "bake yard.obj -o pruned.talus %s", rules[i][0]);
        cli_do(0, line);
        cli_do(0, "check pruned.talus");
        cli_do(0, "audit pruned.talus --paths 50");
        snprintf(line, sizeof line, "audit yard.obj --paths 50 %s", rules[i][0]);
        cli_do(0, line);
        for (int baked = 0; baked < 2; baked++) {
            snprintf(line, sizeof line, "why %s %s %s", baked ? "pruned.talus" : "yard.obj", rules[i][2],
                     baked ? "" : rules[i][0]);
            cli_result why = cli_expect(1, line);
            cli_check_part(why.out, rules[i][1]);
            cli_free(&why);
        }
    }
    // The value that is named does what it promises.
    cli_do(0, "why yard.obj 29.55,5.5,10.35 --island-min-area 37.25");
    cli_do(1, "why yard.obj 29.55,5.5,10.35 --island-min-area 37.3");
}

static void test_bad_input(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_do(0, "bake floor.obj --no-soup -o bare.talus");
    cli_check_error(3, "audit bare.talus", "holds no triangles", "--no-soup");
    cli_check_error(3, "why bare.talus 0,0,0", "holds no triangles", "--no-soup");
    cli_check_error(2, "why floor.obj 0,0", "point", "X,Y,Z");
    cli_check_error(4, "audit nothing.talus", "nothing.talus", "");
    cli_check_error(2, "audit floor.obj --cell-size x", "--cell-size", "number");
    cli_check_error(4, "audit floor.obj --paths 5 --draw none/x.png", "none/x.png", "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_sound_level),
        cmocka_unit_test(test_missing_navmesh),
        cmocka_unit_test(test_ramp_under_a_platform),
        cmocka_unit_test(test_volumes_are_kept),
        cmocka_unit_test(test_why),
        cmocka_unit_test(test_pruned_files),
        cmocka_unit_test(test_bad_input),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
