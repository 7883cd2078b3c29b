// SPDX-License-Identifier: MIT
//
// Off-mesh links set by hand: from options and JSON files into the baked file, and from there into paths and Detour's
// tiles; and what is wrong with a list of them is named.

#include "cli_run.h"

#include <talus/nav_detour.h>

// Three floors of 10 by 10 m, each higher than the one before, with gaps between; `z_up`: turned, and moved far out.
static void write_floors(const char *path, bool z_up)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int i = 0; i < 3; i++) {
        const int x = 20 * i, y = 3 * i, v = 4 * i;
        for (int k = 0; k < 4; k++) {
            const int cx = x + (k >= 2 ? 10 : 0), cz = k == 1 || k == 2 ? 10 : 0;
            if (z_up) {
                fprintf(file, "v %d %d %d\n", 400000 + cx, 5000000 - cz, y);
            } else {
                fprintf(file, "v %d %d %d\n", cx, y, cz);
            }
        }
        fprintf(file, "f %d %d %d %d\n", v + 1, v + 2, v + 3, v + 4);
    }
    fclose(file);
}

static void test_links_lead_paths(void **state)
{
    (void)state;
    write_floors("floors.obj", false);
    cli_do(0, "bake floors.obj -o none.talus");
    cli_do(1, "path none.talus 2,0,5 28,3,5");
    cli_do(0, "bake floors.obj -o one.talus --link 8,0,5,22,3,5");
    cli_do(0, "check one.talus");
    cli_do(0, "path one.talus 2,0,5 28,3,5");
    cli_do(1, "path one.talus 28,3,5 2,0,5"); // one way
    cli_do(0, "path floors.obj 2,0,5 28,3,5 --link 8,0,5,22,3,5");
    cli_do(0, "path floors.obj 28,3,5 2,0,5 --link 8,0,5,22,3,5 --link 22,3,5,8,0,5");
    cli_write_text("links.json", "{\"links\": [{\"start\": [8, 0, 5], \"end\": [22, 3, 5], \"both_ways\": true,"
                                 " \"radius\": 0.75, \"user\": 77, \"area\": 5, \"flags\": 9, \"fixed_cost\": 2},"
                                 " {\"start\": [28, 3, 5], \"end\": [42, 6, 5]}]}");
    json_t *bake = cli_json(0, "bake floors.obj -o file.talus --link-file links.json --json");
    TEST_CHECK(cli_number(bake, "off_mesh") == 2.0);
    json_decref(bake);
    cli_do(0, "path file.talus 2,0,5 48,6,5");
    cli_do(0, "path file.talus 28,3,5 2,0,5");
    cli_do(1, "path file.talus 48,6,5 2,0,5");
}

static void test_links_go_to_detour(void **state)
{
    (void)state;
    write_floors("floors.obj", false);
    cli_write_text("links.json", "{\"links\": [{\"start\": [8, 0, 5], \"end\": [22, 3, 5], \"both_ways\": true,"
                                 " \"radius\": 0.75, \"user\": 77, \"area\": 5, \"flags\": 9}]}");
    cli_do(0, "bake floors.obj -o file.talus --link-file links.json");
    json_t *written = cli_json(0, "export file.talus -o file.bin --json");
    TEST_CHECK(cli_number(written, "off_mesh_links") == 1.0);
    json_decref(written);
    size_t size;
    char *bytes = cli_read_file("file.bin", &size);
    tl_detour_off_mesh link;
    uint32_t count = 0;
    TEST_RESULT(tl_detour_read_off_mesh(bytes, size, &link, 1, &count, NULL), TL_OK);
    TEST_CHECK(count == 1 && link.both_ways && link.radius == 0.75f && link.user_id == 77 && link.area == 5);
    TEST_CHECK(link.flags == 9 && link.start.x == 8.0f && link.end.x == 22.0f && link.end.y == 3.0f);
    free(bytes);
}

// In the level's own coordinates, from the options and from a file.
static void test_links_in_the_levels_axes(void **state)
{
    (void)state;
    write_floors("far.obj", true);
    cli_write_text("far.json", "{\"links\": [{\"start\": [400008, 4999995, 0], \"end\": [400022, 4999995, 3]}]}");
    cli_do(0, "bake far.obj -o a.talus --up z --origin auto --link-file far.json");
    cli_do(0, "bake far.obj -o b.talus --up z --origin auto --link 400008,4999995,0,400022,4999995,3");
    cli_do(0, "path a.talus 400002,4999995,0 400028,4999995,3");
    size_t size_a, size_b;
    char *a = cli_read_file("a.talus", &size_a), *b = cli_read_file("b.talus", &size_b);
    TEST_CHECK(size_a == size_b && memcmp(a, b, size_a) == 0);
    free(a);
    free(b);
}

// What a link leads to is reachable; what is of no use is told, and so is what is wrong.
static void test_what_is_told(void **state)
{
    (void)state;
    write_floors("floors.obj", false);
    cli_result kept = cli_expect(0, "bake floors.obj -o kept.talus --link 8,0,5,22,3,5 --reachable-from 2,0,2");
    cli_check_part(kept.out, "left out 1 islands");
    cli_check_part(kept.out, "off-mesh 1 links");
    cli_free(&kept);
    cli_do(0, "path kept.talus 2,0,5 28,3,5");
    cli_result lost = cli_expect(0, "bake floors.obj -o lost.talus --link 8,0,5,22,3,5 --link 8,0,5,15,3,5");
    cli_check_part(lost.err, "link 1 is of no use: there is no navmesh within 0.5 m of its end, 15,3,5");
    cli_free(&lost);
    static const struct {
        int code;
        const char *text, *part;
    } cases[] = {
        { 3, "{\"links\": [{\"start\": [0,0,0], \"end\": [1,1,1], \"bothways\": true}]}",
          "links[0].bothways is no key" },
        { 3, "{\"links\": [{\"start\": [0,0,0]}]}", "links[0].end must be a point" },
        { 3, "{\"links\": [{\"start\": [0,0], \"end\": [1,1,1]}]}", "links[0].start has 2 numbers instead of 3" },
        { 3, "{\"links\": [{\"start\": [0,0,1e300], \"end\": [1,1,1]}]}", "links[0].start must be a point" },
        { 3, "{\"links\": [{\"start\": [0,0,0], \"end\": [1,1,1], \"radius\": -1}]}", "links[0].radius must be" },
        { 3, "{\"links\": [{\"start\": [0,0,0], \"end\": [1,1,1], \"flags\": 0}]}", "links[0].flags must not be 0" },
        { 3, "{\"links\": [{\"start\": [0,0,0], \"end\": [1,1,1], \"area\": 256}]}", "links[0].area must be 0 to 255" },
        { 3, "{\"links\": [{\"start\": [0,0,0], \"end\": [1,1,1], \"user\": 1.5}]}", "links[0].user must be a whole" },
        { 3, "{\"link\": []}", "link is no key" },
        { 3, "{}", "links is missing" },
        { 3, "[1]", "is no object" },
        { 3, "{\"links\": [", "cut short" },
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        cli_write_text("bad.json", cases[i].text);
        cli_check_error(cases[i].code, "bake floors.obj -o bad.talus --link-file bad.json", "bad.json", cases[i].part);
        TEST_CHECK(!cli_exists("bad.talus"));
    }
    cli_check_error(2, "bake floors.obj -o bad.talus --link 1,2,3", "--link: '1,2,3'", "x,y,z,x,y,z");
    cli_check_error(2, "bake floors.obj -o bad.talus --link 1,2,3,4,5,x", "--link:", "x,y,z,x,y,z");
    cli_check_error(2, "path kept.talus 2,0,5 28,3,5 --link 1,2,3,4,5,6", "--link", "baked already");
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_links_lead_paths),
                                        cmocka_unit_test(test_links_go_to_detour),
                                        cmocka_unit_test(test_links_in_the_levels_axes),
                                        cmocka_unit_test(test_what_is_told) };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
