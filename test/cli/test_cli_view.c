// SPDX-License-Identifier: MIT
//
// talus view: the page holds the baked file, byte by byte, and settings that a browser reads; and what it refuses.
// The viewer itself is tested in a browser, by web/test.
#include "cli_run.h"

static const char EMPTY_PAGE[] = "<!doctype html><head>\n<!--talus-level-->\n</head><body>the viewer</body>\n";

static void make_view_files(void)
{
    cli_write_text("empty.html", EMPTY_PAGE);
    assert_int_equal(setenv("TALUS_VIEWER", "empty.html", 1), 0);
    cli_do(0, "sample courtyard --triangles 2000 -o yard.obj");
}

// The text of the script element of that id; the caller's to free.
static char *element_text(const char *page, const char *id)
{
    const char *at = strstr(page, id);
    assert_non_null(at);
    at = strchr(at, '>');
    assert_non_null(at);
    const char *end = strstr(at, "</script>");
    assert_non_null(end);
    char *text = strndup(at + 1, (size_t)(end - at - 1));
    assert_non_null(text);
    return text;
}

static int digit_of(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c != '\0' ? strchr(digits, c) : NULL;
    return at != NULL ? (int)(at - digits) : -1;
}

// Compares base64 with a file.
static void check_decodes_to(const char *text, const char *path)
{
    size_t size;
    char *file = cli_read_file(path, &size);
    assert_int_equal(strlen(text), (size + 2) / 3 * 4);
    for (size_t i = 0; i < size; ++i) {
        const char *group = text + i / 3 * 4;
        uint32_t bits = 0;
        for (int k = 0; k < 4; ++k) {
            TEST_CHECK(group[k] == '=' || digit_of(group[k]) >= 0);
            bits = bits << 6 | (group[k] != '=' ? (uint32_t)digit_of(group[k]) : 0);
        }
        assert_int_equal((uint8_t)(bits >> (16 - 8 * (i % 3))), (uint8_t)file[i]);
    }
    free(file);
}

static json_t *page_view(const char *path)
{
    char *page = cli_read_file(path, NULL);
    TEST_CHECK(strstr(page, "<!--talus-level-->") == NULL && strstr(page, "the viewer</body>") != NULL);
    char *text = element_text(page, "id=\"talus-view\"");
    json_t *view = json_loads(text, 0, NULL);
    assert_non_null(view);
    free(text);
    free(page);
    return view;
}

static void check_holds(const char *path, const char *baked)
{
    char *page = cli_read_file(path, NULL);
    char *text = element_text(page, "id=\"talus-pack\"");
    check_decodes_to(text, baked);
    free(text);
    free(page);
}

// A level is baked as talus bake does; a baked file is taken as it is.
static void test_page_holds_the_bake(void **state)
{
    (void)state;
    make_view_files();
    cli_do(0, "bake yard.obj -o yard.talus --agent-radius 0.3 --tile-size 48");
    cli_do(0, "view yard.obj -o level.html --agent-radius 0.3 --tile-size 48");
    cli_do(0, "view yard.talus -o baked.html");
    check_holds("level.html", "yard.talus");
    check_holds("baked.html", "yard.talus");
    static const char *const pages[] = { "level.html", "baked.html" };
    for (size_t i = 0; i < 2; ++i) {
        json_t *view = page_view(pages[i]);
        const json_t *settings = json_object_get(view, "settings");
        assert_true((float)json_number_value(json_object_get(settings, "agentRadius")) == 0.3f);
        assert_int_equal(json_integer_value(json_object_get(settings, "tileSize")), 48);
        assert_string_equal(json_string_value(json_object_get(settings, "partition")), "watershed");
        assert_int_equal(json_object_size(settings), 20);
        assert_string_equal(json_string_value(json_object_get(view, "name")), i == 0 ? "yard.obj" : "yard.talus");
        assert_string_equal(json_string_value(json_object_get(view, "hash")), "");
        json_decref(view);
    }
}

// Every length modulo 3 of what is encoded: file sizes are multiples of 64, which are 1, 2 and 0 modulo 3 in turn.
static void test_every_padding(void **state)
{
    (void)state;
    make_view_files();
    static const char *const sizes[] = { "0.4", "0.5", "0.6", "0.7", "0.8", "0.9" };
    bool seen[3] = { false };
    for (size_t i = 0; i < sizeof(sizes) / sizeof(sizes[0]); ++i) {
        char line[96];
        snprintf(line, sizeof(line), "bake yard.obj -o yard.talus --cell-size %s", sizes[i]);
        cli_do(0, line);
        cli_do(0, "view yard.talus -o page.html");
        check_holds("page.html", "yard.talus");
        struct stat status;
        assert_int_equal(stat("yard.talus", &status), 0);
        seen[status.st_size % 3] = true;
    }
    TEST_CHECK(seen[0] + seen[1] + seen[2] >= 2);
}

static void test_view_of_a_path(void **state)
{
    (void)state;
    make_view_files();
    cli_do(0, "view yard.obj -o page.html --from 2,0,20 --to -1.5,5,20");
    json_t *view = page_view("page.html");
    assert_string_equal(json_string_value(json_object_get(view, "hash")), "#tool=path&start=2,0,20&goal=-1.5,5,20");
    json_decref(view);
    cli_do(2, "view yard.obj -o page.html --from 2,0,20");
    cli_do(2, "view yard.obj -o page.html --from 2,0,20 --to 1,2");
}

// A name must not end the element that it stands in.
static void test_hostile_name(void **state)
{
    (void)state;
    make_view_files();
    assert_int_equal(rename("yard.obj", "a<!--b<script>\"\\.obj"), 0);
    cli_do(0, "view a<!--b<script>\"\\.obj -o page.html");
    char *page = cli_read_file("page.html", NULL);
    TEST_CHECK(strstr(page, "<!--") == NULL);
    char *text = element_text(page, "id=\"talus-view\"");
    TEST_CHECK(strchr(text, '<') == NULL);
    json_t *view = json_loads(text, 0, NULL);
    assert_string_equal(json_string_value(json_object_get(view, "name")), "a<!--b<script>\"\\.obj");
    json_decref(view);
    free(text);
    free(page);
}

// Nothing walkable: the page is where to find out why.
static void test_nothing_walkable(void **state)
{
    (void)state;
    make_view_files();
    cli_result result = cli_expect(0, "view yard.obj -o page.html --agent-height 500 --agent-max-climb 0");
    json_t *view = page_view("page.html");
    json_decref(view);
    cli_free(&result);
}

static void test_view_refusals(void **state)
{
    (void)state;
    make_view_files();
    cli_do(2, "view yard.obj");
    cli_do(2, "view yard.obj -o page.png");
    cli_do(4, "view absent.obj -o refused.html");
    cli_do(0, "bake yard.obj -o bare.talus --no-soup");
    cli_result bare = cli_expect(3, "view bare.talus -o refused.html");
    TEST_CHECK(strstr(bare.err, "--no-soup") != NULL);
    cli_free(&bare);
    cli_do(0, "bake yard.obj -o yard.talus");
    cli_do(2, "view yard.talus -o refused.html --agent-radius 1");
    cli_write_text("unmarked.html", "<html></html>");
    assert_int_equal(setenv("TALUS_VIEWER", "unmarked.html", 1), 0);
    cli_result unmarked = cli_expect(3, "view yard.talus -o refused.html");
    TEST_CHECK(strstr(unmarked.err, "make viewer-page") != NULL);
    cli_free(&unmarked);
    assert_int_equal(setenv("TALUS_VIEWER", "nowhere.html", 1), 0);
    cli_do(4, "view yard.talus -o refused.html");
    TEST_CHECK(!cli_exists("refused.html"));
}

static void test_view_json(void **state)
{
    (void)state;
    make_view_files();
    json_t *object = cli_json(0, "view yard.obj -o page.html --json");
    struct stat status;
    assert_int_equal(stat("page.html", &status), 0);
    assert_int_equal(json_integer_value(json_object_get(object, "bytes")), status.st_size);
    json_decref(object);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_page_holds_the_bake), cmocka_unit_test(test_every_padding),
        cmocka_unit_test(test_view_of_a_path),      cmocka_unit_test(test_hostile_name),
        cmocka_unit_test(test_nothing_walkable),    cmocka_unit_test(test_view_refusals),
        cmocka_unit_test(test_view_json),
    };
    return cmocka_run_group_tests(tests, cli_enter_folder, cli_leave_folder);
}
