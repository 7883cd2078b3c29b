// SPDX-License-Identifier: MIT
//
// A z-up level is turned; each command that takes points says in which axes, also for a baked file of it.
#include "cli_run.h"

static void test_z_up_is_told_each_time(void **state)
{
    (void)state;
    cli_write_text("z.obj", "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nf 1 2 3 4\n");
    cli_write_floor("y.obj", 10, false);
    cli_do(0, "bake z.obj -o z.talus --up z");
    cli_do(0, "bake y.obj -o y.talus");
    static const char *const lines[] = { "bake %s -o out.talus",
                                         "ray %s 1,1,-2 0,-1,0",
                                         "path %s -2,0,-2 2,0,2",
                                         "nearest %s 1,1,-2",
                                         "around %s 0,0,0",
                                         "why %s 0,0,0",
                                         "info %s",
                                         "audit %s" };
    for (size_t i = 0; i < sizeof(lines) / sizeof(lines[0]); ++i) {
        char line[128];
        snprintf(line, sizeof(line), lines[i], "z.obj");
        strcat(line, " --up z");
        cli_check_error(0, line, "z.obj: the level is z-up", "as x,z,-y");
        snprintf(line, sizeof(line), lines[i], "y.obj");
        cli_result plain = cli_expect(0, line);
        TEST_CHECK(strstr(plain.err, "z-up") == NULL);
        cli_free(&plain);
        if (i > 0) {
            snprintf(line, sizeof(line), lines[i], "z.talus");
            cli_check_error(0, line, "z.talus: the level is z-up", "as x,z,-y");
            snprintf(line, sizeof(line), lines[i], "y.talus");
            plain = cli_expect(0, line);
            assert_string_equal(plain.err, "");
            cli_free(&plain);
        }
    }
    cli_do(0, "check z.talus");
    // (1, 2) of the file's floor is hit where the words say.
    cli_result hit = cli_expect(0, "ray z.talus 1,1,-2 0,-1,0");
    cli_check_part(hit.out, "1");
    cli_free(&hit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_z_up_is_told_each_time),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
