// SPDX-License-Identifier: MIT
//
// What is written never destroys what is read, under whatever name, and has the format that its ending promises.
#include "cli_run.h"

// The command must refuse by name, and leave the input as it is.
static void check_refused(const char *input, const char *line)
{
    size_t size, size_after;
    char *before = cli_read_file(input, &size);
    cli_check_error(2, line, "is the same file as the input", "write to another file");
    char *after = cli_read_file(input, &size_after);
    TEST_CHECK(size == size_after && memcmp(before, after, size) == 0);
    free(before);
    free(after);
}

static void test_output_is_the_input(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 8, false);
    cli_write_text("contours.txt", "navcontours 1\ncs 0.3\nch 0.2\ncontours 1\nc 0 1 63 4\n0 0 0 0\n0 0 8 0\n4 0 8 0\n"
                                   "4 0 0 0\nend\n");
    cli_write_text("areas.txt", "box 5 0 -1 0 1 1 1\n");
    cli_do(0, "bake level.obj -o level.talus");
    cli_do(0, "export level.obj -o level.bin");
    assert_int_equal(symlink("level.obj", "link.png"), 0);
    assert_int_equal(symlink("level.talus", "baked.svg"), 0);
    assert_int_equal(link("level.obj", "hard.png"), 0);
    check_refused("level.obj", "bake level.obj -o level.obj");
    check_refused("level.obj", "bake level.obj -o ./level.obj");
    check_refused("level.obj", "bake ./level.obj --output=level.obj");
    check_refused("level.obj", "hull level.obj -o level.obj");
    check_refused("level.obj", "export level.obj -o level.obj");
    check_refused("level.obj", "draw level.obj -o link.png");
    check_refused("level.obj", "draw level.obj -o hard.png --overview");
    check_refused("level.obj", "audit level.obj --draw hard.png");
    check_refused("level.obj", "links level.obj --draw link.png");
    check_refused("level.talus", "links level.talus --draw baked.svg");
    check_refused("level.talus", "export level.talus -o level.talus");
    check_refused("level.bin", "import level.bin -o level.bin");
    check_refused("contours.txt", "polygonize contours.txt -o contours.txt");
    check_refused("areas.txt", "bake level.obj --areas areas.txt -o areas.txt");
    // Standard input comes from stdin.txt here.
    char *text = cli_read_file("level.obj", NULL);
    cli_result piped = cli_expect_with(2, text, "bake - -o stdin.txt");
    cli_check_part(piped.err, "is the same file as the input '-'");
    cli_free(&piped);
    free(text);
}

// A baked file with its links is the file again: nothing is lost.
static void test_links_may_replace_their_file(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 8, false);
    cli_do(0, "bake level.obj -o level.talus");
    cli_do(0, "links level.talus -o level.talus");
    cli_do(0, "path level.talus -2,0,-2 2,0,2");
    cli_do(0, "bake level.obj -o level.talus"); // an older output is no input
    cli_do(0, "bake level.obj -o /dev/null");
}

static void test_endings(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 8, false);
    static const char *const lines[] = { "draw level.obj -o p.jpg", "draw level.obj -o p",
                                         "draw level.obj -o p.png.pdf", "audit level.obj --draw p.jpg",
                                         "links level.obj --draw p.gif" };
    for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); ++i) {
        cli_check_error(2, lines[i], "has an ending that cannot be written", "use .png or .svg");
    }
    cli_check_error(2, "hull level.obj -o hull.stl", "'hull.stl'", "use .obj or .talus");
    cli_check_error(2, "sample courtyard -o level.glb", "'level.glb'", "use .obj");
    TEST_CHECK(!cli_exists("p.jpg") && !cli_exists("p") && !cli_exists("hull.stl") && !cli_exists("level.glb"));
    cli_do(0, "draw level.obj -o P.PNG --size 200");
    cli_do(0, "draw level.obj -o P.SVG --size 200");
    char *text = cli_read_file("P.SVG", NULL);
    cli_check_part(text, "<svg");
    free(text);
    cli_do(0, "draw level.obj -o /dev/null --size 200");
}

// A picture on standard output has no line of text behind it.
static void test_picture_on_standard_output(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 8, false);
    static const char *const lines[] = { "draw level.obj -o - --size 200",
                                         "draw level.obj -o - --size 200 --overview --stage soup,regions" };
    for (int i = 0; i < 2; ++i) {
        cli_result picture = cli_expect(0, lines[i]);
        TEST_CHECK(picture.out_size > 100 && memcmp(picture.out + picture.out_size - 8, "IEND", 4) == 0);
        cli_free(&picture);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_output_is_the_input),
        cmocka_unit_test(test_links_may_replace_their_file),
        cmocka_unit_test(test_endings),
        cmocka_unit_test(test_picture_on_standard_output),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
