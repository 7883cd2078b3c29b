// SPDX-License-Identifier: MIT
//
// talus links, and bake --links: the same links either way, which paths then take.
#include "cli_run.h"

#include <math.h>
#include <string.h>

static json_int_t kept(json_t *object, const char *kind)
{
    return json_integer_value(json_object_get(json_object_get(object, kind), "kept"));
}

static void test_links(void **state)
{
    (void)state;
    cli_do(0, "sample courtyard -o courtyard.obj");
    cli_do(0, "bake courtyard.obj -o plain.talus --cell-size 0.25");
    cli_do(0, "bake courtyard.obj -o linked.talus --cell-size 0.25 --links --threads 2");
    json_t *found = cli_json(0, "links plain.talus -o added.talus --threads 1 --json");
    json_int_t drops = kept(found, "drop"), jumps = kept(found, "jump"), climbs = kept(found, "climb");
    TEST_CHECK(drops > 0 && jumps > 0 && climbs >= 0);
    TEST_CHECK((json_int_t)json_array_size(json_object_get(found, "links")) == drops + jumps + climbs);
    json_decref(found);
    // Found again in a file that has them: the same.
    found = cli_json(0, "links added.talus --json");
    TEST_CHECK(kept(found, "drop") == drops && kept(found, "jump") == jumps && kept(found, "climb") == climbs);
    json_decref(found);
    cli_do(0, "check linked.talus");
    cli_do(0, "check added.talus");
    // A path down from the gallery drops over its edge.
    json_t *plain = cli_json(0, "path plain.talus 4.5,5.2,12 12,0,12 --json");
    json_t *linked = cli_json(0, "path linked.talus 4.5,5.2,12 12,0,12 --json");
    json_t *added = cli_json(0, "path added.talus 4.5,5.2,12 12,0,12 --json");
    TEST_CHECK(json_object_get(plain, "links_at") == NULL && json_object_get(linked, "links_at") != NULL);
    TEST_CHECK(cli_number(linked, "length") < cli_number(plain, "length"));
    TEST_CHECK(cli_number(linked, "length") == cli_number(added, "length"));
    json_decref(plain);
    json_decref(linked);
    json_decref(added);
    cli_result info = cli_expect(0, "info linked.talus");
    cli_check_part(info.out, "links ");
    cli_free(&info);
}

static void test_refusals(void **state)
{
    (void)state;
    cli_write_floor("floor.obj", 20, false);
    cli_result none = cli_expect(0, "links floor.obj");
    cli_check_part(none.out, "places along");
    cli_free(&none);
    cli_do(2, "links floor.obj -o floor.talus");
    cli_do(2, "bake floor.obj -o floor.talus --links --no-soup");
    cli_do(2, "links floor.obj --link-gain 0.5");
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_links), cmocka_unit_test(test_refusals) };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
