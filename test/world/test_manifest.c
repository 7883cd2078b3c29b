// SPDX-License-Identifier: MIT
//
// Manifests: what they say is taken, and what is wrong in them is named with its place.
#include "talus_test.h"

#include "world/input/input_list.h"

#include <stdio.h>
#include <string.h>

static const char path[] = "manifest_test.json";

static tl_result read_text(const char *text, tl_world_inputs *inputs, tl_io_error *error)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    const tl_world_reading reading = { TL_UP_Y, 1.0f };
    memset(error, 0, sizeof *error);
    const tl_result result = tl_world_inputs_read(path, &reading, inputs, error);
    remove(path);
    return result;
}

static void everything_is_taken(void **state)
{
    (void)state;
    tl_world_inputs inputs;
    tl_io_error error;
    assert_int_equal(
        read_text("{ \"inputs\": [ { \"file\": \"a.obj\" }, { \"file\": \"/b.stl\", \"area\": 5, \"up\": \"z-left\", "
                  "\"scale\": 0.01, \"matrix\": [1,2,3,4,5,6,7,8,9,10,11,12] }, { \"file\": \"c.glb\", \"translate\": "
                  "[1e7, 0, -2.5], \"areas\": { \"gr*s\": 7, \"w?ter\": 0, \"*\": 9 } } ] }",
                  &inputs, &error),
        TL_OK);
    TEST_CHECK(inputs.count == 3);
    const tl_world_input *a = &inputs.items[0], *b = &inputs.items[1], *c = &inputs.items[2];
    TEST_CHECK(strcmp(a->path, "a.obj") == 0 && !a->is_placed && a->area == TL_NAV_WALKABLE_AREA && a->up == TL_UP_Y);
    TEST_CHECK(strcmp(b->path, "/b.stl") == 0 && b->is_placed && b->area == 5 && b->up == TL_UP_Z_LEFT &&
               b->scale == 0.01f && b->matrix[0] == 1 && b->matrix[11] == 12);
    TEST_CHECK(c->matrix[3] == 1e7 && c->matrix[11] == -2.5 && c->matrix[0] == 1 && c->matrix[1] == 0);
    TEST_CHECK(tl_world_input_area(c, "grass") == 7 && tl_world_input_area(c, "grs") == 7);
    TEST_CHECK(tl_world_input_area(c, "water") == 0 && tl_world_input_area(c, "waater") == 9);
    TEST_CHECK(tl_world_input_area(a, "grass") == TL_NAV_WALKABLE_AREA);
    tl_world_inputs_free(&inputs);
}

static void files_placed_twice_are_known(void **state)
{
    (void)state;
    tl_world_inputs inputs;
    tl_io_error error;
    assert_int_equal(read_text("{ \"inputs\": [ { \"file\": \"a.stl\" }, { \"file\": \"b.stl\" }, { \"file\": "
                               "\"a.stl\", \"translate\": [1, 0, 0] }, { \"file\": \"c.stl\" } ] }",
                               &inputs, &error),
                     TL_OK);
    TEST_CHECK(inputs.count == 4 && inputs.items[0].is_shared && inputs.items[2].is_shared);
    TEST_CHECK(!inputs.items[1].is_shared && !inputs.items[3].is_shared);
    tl_world_inputs_free(&inputs);
}

static void faults_are_named(void **state)
{
    (void)state;
    static const struct {
        const char *text, *place;
    } cases[] = {
        { "{}", "inputs" },
        { "{ \"inputs\": [] }", "inputs" },
        { "{ \"inputs\": [ {} ] }", "inputs[0]" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"area\": 256 } ] }", "area" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"area\": 1.5 } ] }", "area" },
        { "{ \"inputs\": [ { \"file\": \"a\" }, { \"file\": \"a\", \"areas\": { \"x\": -1 } } ] }", "inputs[1].areas" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"matrix\": [1, 2] } ] }", "12" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"translate\": [1, 2, \"x\"] } ] }", "translate" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"translate\": [1,2,3], \"matrix\": [1,0,0,0,0,1,0,0,0,0,1,0] } ] }",
          "translate" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"up\": \"x\" } ] }", "up" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"scale\": 0 } ] }", "scale" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"scale\": \"2\" } ] }", "scale" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"colour\": 1 } ] }", "colour" },
        { "{ \"input\": [ { \"file\": \"a\" } ] }", "input" },
        { "{ \"inputs\": [ { \"file\": \"a\", \"file\": \"b\" } ] }", "file" },
        { "[1]", "" },
        { "{ \"inputs\": ", "" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tl_world_inputs inputs;
        tl_io_error error;
        const tl_result result = read_text(cases[i].text, &inputs, &error);
        tl_world_inputs_free(&inputs);
        if (result == TL_OK || strstr(error.message, cases[i].place) == NULL) {
            fail_msg("%s: %s, no '%s'", cases[i].text, error.message, cases[i].place);
        }
        TEST_CHECK(tl_is_error(result) && strcmp(error.path, path) == 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_is_taken),
        cmocka_unit_test(files_placed_twice_are_known),
        cmocka_unit_test(faults_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
