// SPDX-License-Identifier: MIT
//
// Options that say how a level is read or baked are refused by name where FILE is baked already.
#include "cli_run.h"

static void test_refused_by_name(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 8, false);
    cli_write_text("points.txt", "0 0 0\n2 0 0\n0 2 0\n0 0 2\n");
    cli_do(0, "bake level.obj -o level.talus");
    cli_do(0, "bake level.obj -o renamed");
    cli_do(0, "hull points.txt -o hull.talus");
    static const char *const lines[][2] = {
        { "path level.talus -1,0,-1 1,0,1 --agent-radius 5", "--agent-radius" },
        { "path renamed -1,0,-1 1,0,1 --agent-radius 5", "--agent-radius" },
        { "path level.talus -1,0,-1 1,0,1 --cs 0.1", "--cell-size" },
        { "path level.talus -1,0,-1 1,0,1 --bounds 0,0,0,1,1,1", "--bounds" },
        { "path level.talus -1,0,-1 1,0,1 --area a=1", "--area" },
        { "path level.talus -1,0,-1 1,0,1 --no-filter-ledge-spans", "--no-filter-ledge-spans" },
        { "around level.talus 0,0,0 --tile-size 32", "--tile-size" },
        { "why level.talus 0,0,0 --agent-max-slope 60", "--agent-max-slope" },
        { "audit level.talus --agent-height 1", "--agent-height" },
        { "links level.talus --agent-max-climb 1", "--agent-max-climb" },
        { "export level.talus -o x.bin --partition layers", "--partition" },
        { "draw level.talus -o x.png --stage regions --region-min-size 0", "--region-min-size" },
        { "ray level.talus 0,1,0 0,-1,0 --scale 0.01", "--scale" },
        { "sweep level.talus 0,3,0 0,0,0 --radius 1 --up z", "--up" },
        { "nearest level.talus 0,0,0 --weld 0.1", "--weld" },
        { "overlap level.talus 0,0,0 --radius 1 --scale 2", "--scale" },
        { "info level.talus --up z", "--up" },
        { "check level.talus --scale 2", "--scale" },
        { "hull hull.talus --max-vertices 4", "--max-vertices" },
        { "support hull.talus 0,1,0 --scale 2", "--scale" },
        { "distance hull.talus points.txt --index-a 0", "--index-a" },
        { "distance points.txt hull.talus --index-b 0", "--index-b" },
    };
    for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); ++i) {
        char named[64];
        snprintf(named, sizeof(named), "%s: ", lines[i][1]);
        cli_check_error(2, lines[i][0], named, "baked already");
    }
    TEST_CHECK(!cli_exists("x.bin") && !cli_exists("x.png"));
}

// The question's own options are as good as ever, and a level takes all.
static void test_taken(void **state)
{
    (void)state;
    cli_write_floor("level.obj", 8, false);
    cli_write_text("points.txt", "0 0 0\n2 0 0\n0 2 0\n0 0 2\n");
    cli_do(0, "bake level.obj -o level.talus");
    cli_do(0, "hull points.txt -o hull.talus");
    cli_do(0, "path level.talus -1,0,-1 1,0,1 --radius 1 --threads 1 --json");
    cli_do(0, "path level.obj -1,0,-1 1,0,1 --agent-radius 1 --scale 2");
    cli_do(0, "links level.talus --drop 3");
    cli_do(0, "distance hull.talus points.txt --index-b 0 --radius-a 1");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_refused_by_name),
        cmocka_unit_test(test_taken),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
