// SPDX-License-Identifier: MIT

#include "io/text/area_marks.h"

#include "talus_test.h"

#include <stdio.h>
#include <string.h>

static tl_result parse(tl_area_marks *marks, const char *text, tl_io_error *error)
{
    memset(marks, 0, sizeof *marks);
    memset(error, 0, sizeof *error);
    return tl_area_marks_parse(marks, text, strlen(text), "marks.txt", NULL, error);
}

static void reads_every_kind_of_mark(void **state)
{
    (void)state;
    tl_area_marks marks;
    tl_io_error error;
    TEST_RESULT(parse(&marks,
                      "# of a park\n\n"
                      "material 5 wet grass \r\n"
                      "prism 7 -1 2.5 0 0 0 4 4 4 4 0\n"
                      "  box 255 -1 -2 -3 4 5 6\n"
                      "prism 0 0 0 1 1 1 2 2 2\n"
                      "cylinder 9 1 2 3 0.5 4\n"
                      "material 0 water*",
                      &error),
                TL_OK);
    TEST_CHECK(marks.rule_count == 2 && marks.volume_count == 4);
    TEST_CHECK(marks.rules[0].area == 5 && marks.rules[0].line == 3 && marks.rules[1].line == 8);
    assert_string_equal(marks.text + marks.rules[0].name, "wet grass");
    const tl_nav_volume *v = marks.volumes;
    TEST_CHECK(v[0].kind == TL_NAV_VOLUME_POLYGON && v[0].area == 7 && v[0].point_count == 4);
    TEST_CHECK(v[0].box.min.y == -1.0f && v[0].box.max.y == 2.5f && v[0].points[2].x == 4.0f && v[0].points[1].z == 4);
    TEST_CHECK(v[1].kind == TL_NAV_VOLUME_BOX && v[1].area == 255 && v[1].box.min.z == -3.0f && v[1].points == NULL);
    TEST_CHECK(v[2].point_count == 3 && v[2].points == v[0].points + 4 && v[2].points[2].z == 2.0f);
    TEST_CHECK(v[3].kind == TL_NAV_VOLUME_CYLINDER && v[3].base.y == 2.0f && v[3].radius == 0.5f && v[3].height == 4);
    // More marks go behind those that are there.
    TEST_RESULT(tl_area_marks_parse(&marks, "prism 3 0 1 5 5 5 6 6 6", 23, "more.txt", NULL, &error), TL_OK);
    TEST_CHECK(marks.volume_count == 5 && marks.volumes[4].points == marks.volumes[0].points + 7);
    TEST_CHECK(marks.volumes[0].points[2].x == 4.0f && marks.volumes[4].points[0].x == 5.0f);
    tl_area_marks_free(&marks);
}

// In the level's own coordinates: far out, and with z up.
static void speaks_the_levels_axes(void **state)
{
    (void)state;
    tl_pack_frame frame;
    memset(&frame, 0, sizeof frame);
    frame.axes = TL_PACK_AXES_Z_UP;
    frame.origin[0] = 448262.0;
    frame.origin[1] = 5411932.0;
    frame.origin[2] = 100.0;
    static const char text[] = "box 3 448263 5411934 100.5 448264 5411937 102.5\n"
                               "cylinder 4 448263 5411933 99 0.5 2\n"
                               "prism 5 101 103 448262 5411932 448264.25 5411932 448262 5411935\n";
    tl_area_marks marks;
    tl_io_error error;
    memset(&marks, 0, sizeof marks);
    TEST_RESULT(tl_area_marks_parse(&marks, text, sizeof text - 1, "utm.txt", &frame, &error), TL_OK);
    const tl_nav_volume *v = marks.volumes; // (x, y, z) becomes (x, z, -y)
    TEST_CHECK(v[0].box.min.x == 1.0f && v[0].box.min.y == 0.5f && v[0].box.min.z == -5.0f);
    TEST_CHECK(v[0].box.max.x == 2.0f && v[0].box.max.y == 2.5f && v[0].box.max.z == -2.0f);
    TEST_CHECK(v[1].base.x == 1.0f && v[1].base.y == -1.0f && v[1].base.z == -1.0f && v[1].height == 2.0f);
    TEST_CHECK(v[2].box.min.y == 1.0f && v[2].box.max.y == 3.0f && v[2].point_count == 3);
    TEST_CHECK(v[2].points[1].x == 2.25f && v[2].points[1].z == 0.0f && v[2].points[2].z == -3.0f);
    tl_area_marks_free(&marks);
}

static void names_the_line_that_is_wrong(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        tl_result result;
        const char *part;
    } cases[] = {
        { "grass 5", TL_ERR_FORMAT, "expected material, box" },
        { "box 256 0 0 0 1 1 1", TL_ERR_FORMAT, "0 to 255" },
        { "box -1 0 0 0 1 1 1", TL_ERR_FORMAT, "0 to 255" },
        { "box five 0 0 0 1 1 1", TL_ERR_FORMAT, "0 to 255" },
        { "material 5", TL_ERR_FORMAT, "name" },
        { "box 5 0 0 0 1 1", TL_ERR_FORMAT, "x y z x y z" },
        { "box 5 0 0 0 1 1 1 1", TL_ERR_FORMAT, "x y z x y z" },
        { "box 5 0 0 nan 1 1 1", TL_ERR_FORMAT, "x y z x y z" },
        { "box 5 0 2 0 1 1 1", TL_ERR_RANGE, "lowest corner" },
        { "cylinder 5 0 0 0 1", TL_ERR_FORMAT, "radius height" },
        { "cylinder 5 0 0 0 0 1", TL_ERR_RANGE, "radius above 0" },
        { "cylinder 5 0 0 0 1 -1", TL_ERR_RANGE, "height of 0" },
        { "prism 5 0 1 0 0 1 1", TL_ERR_FORMAT, "corners" },
        { "prism 5 0 1 0 0 1 1 2", TL_ERR_FORMAT, "corners" },
        { "prism 5 1 0 0 0 1 1 2 0", TL_ERR_RANGE, "low end" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[128];
        tl_area_marks marks;
        tl_io_error error;
        snprintf(text, sizeof text, "# one\nbox 1 0 0 0 1 1 1\n%s\n", cases[i].text);
        TEST_RESULT(parse(&marks, text, &error), cases[i].result);
        TEST_CHECK(error.line == 3 && strstr(error.message, cases[i].part) != NULL);
        tl_area_marks_free(&marks);
    }
    tl_area_marks none = { 0 };
    tl_io_error error;
    TEST_RESULT(tl_area_marks_read(&none, "no/such/file", NULL, &error), TL_ERR_IO);
}

static void patterns_match_as_they_say(void **state)
{
    (void)state;
    static const struct {
        const char *pattern, *material;
        bool exact, matches;
    } cases[] = {
        { "grass", "grass", true, true },
        { "grass", "Grass", false, false },
        { "grass", "grass2", false, false },
        { "*", "", false, true },
        { "*", "anything", false, true },
        { "", "", true, true },
        { "", "x", false, false },
        { "w*r", "water", false, true },
        { "w*r", "waters", false, false },
        { "w?ter", "water", false, true },
        { "w?ter", "wter", false, false },
        { "*a*b*", "xaybz", false, true },
        { "*a*b*", "xbya", false, false },
        { "*ab", "aab", false, true },
        { "a*b*c", "abcbc", false, true },
        { "a**c", "abc", false, true },
        { "*_wet_*", "x_wet_y_wet", false, true },
        { "*?", "", false, false },
        { "floor[1]", "floor[1]", true, true },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        tl_area_marks marks = { 0 };
        TEST_RESULT(tl_area_marks_add_rule(&marks, cases[i].pattern, strlen(cases[i].pattern), 0, 1), TL_OK);
        TEST_CHECK(tl_area_rule_is_exact(&marks, marks.rules, cases[i].material) == cases[i].exact);
        if (tl_area_rule_matches(&marks, marks.rules, cases[i].material) != cases[i].matches) {
            fail_msg("'%s' and '%s'", cases[i].pattern, cases[i].material);
        }
        tl_area_marks_free(&marks);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(reads_every_kind_of_mark),
                                        cmocka_unit_test(speaks_the_levels_axes),
                                        cmocka_unit_test(names_the_line_that_is_wrong),
                                        cmocka_unit_test(patterns_match_as_they_say) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
