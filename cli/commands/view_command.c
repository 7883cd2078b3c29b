// SPDX-License-Identifier: MIT
//
// talus view: a level with its bake in one HTML page, the viewer, that opens from disk in any browser.
//
// The page is built from web/ by `make viewer-page` and installed beside the command. It has one mark, which is
// replaced by two inert script elements: what the view is, as JSON, and the baked file, as base64.

#include "cli/level/open_input.h"
#include "cli/level/polygonize_compare.h"
#include "cli/level/write_pack.h"
#include "cli/options/parse_value.h"
#include "cli/shared/json_out.h"
#include "cli/shared/start.h"
#include "io/files/atomic_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char PAGE_MARK[] = "<!--talus-level-->";
static const char *const PAGE_ENDINGS[] = { ".html", ".htm", NULL };

enum { MAX_PAGE_PATH = 4096, ENCODED_BYTES = 4096 };

typedef struct view_settings {
    tl_bake_settings bake;
    const char *output;
    const char *from_text, *to_text;
    bool has_ends;
    tl_vec3 from, to;
} view_settings;

// ---------------------------------------------------------------------------------------------------------
// The empty page.

// The folder of the running program, without the last slash. False: the system does not tell.
static bool find_own_folder(char path[MAX_PAGE_PATH])
{
    if (!tl_own_path(path, MAX_PAGE_PATH)) {
        return false;
    }
    char *slash = strrchr(path, '/');
    if (slash == NULL) {
        return false;
    }
    *slash = '\0';
    return true;
}

// Opens the page: of TALUS_VIEWER, else where it is installed or built, relative to the program.
static bool open_page(tl_cli *cli, tl_file_map *map_out, tl_exit *exit_out)
{
    static const char *const places[] = { "../share/talus/viewer.html", "../viewer/viewer.html",
                                          "../../viewer/viewer.html" };
    tl_io_error error;
    const char *told = getenv("TALUS_VIEWER");
    if (told != NULL && told[0] != '\0') {
        if (tl_file_read(told, 0, map_out, &error) != TL_OK) {
            *exit_out = tl_cli_fail_io(cli, &error);
        }
        return map_out->bytes != NULL;
    }
    char folder[MAX_PAGE_PATH];
    char path[MAX_PAGE_PATH + 64];
    for (size_t i = 0; find_own_folder(folder) && i < sizeof(places) / sizeof(places[0]); ++i) {
        snprintf(path, sizeof(path), "%s/%s", folder, places[i]);
        if (tl_file_read(path, 0, map_out, NULL) == TL_OK) {
            return true;
        }
    }
    *exit_out = tl_cli_fail(cli, TL_EXIT_IO,
                            "the viewer's page is not installed beside this program; build it in a checkout of talus "
                            "by 'make viewer-page', which needs npm, or name it in TALUS_VIEWER");
    return false;
}

// Where the mark stands in the page; NULL: it has none.
static const char *find_mark(const tl_file_map *page)
{
    const char *bytes = page->bytes;
    const size_t length = sizeof(PAGE_MARK) - 1;
    for (size_t i = 0; i + length <= page->size; ++i) {
        if (memcmp(bytes + i, PAGE_MARK, length) == 0) {
            return bytes + i;
        }
    }
    return NULL;
}

// ---------------------------------------------------------------------------------------------------------
// What is put into it.

static json_t *settings_json(const tl_nav_def *def)
{
    static const char *const partitions[] = { "watershed", "monotone", "layers" };
    json_t *object =
        json_pack("{so so so so so so so so so so so so sI sI so}", "cellSize", tl_json_float(def->cell_size),
                  "cellHeight", tl_json_float(def->cell_height), "agentHeight", tl_json_float(def->agent_height),
                  "agentRadius", tl_json_float(def->agent_radius), "agentMaxClimb", tl_json_float(def->agent_max_climb),
                  "agentMaxSlope", tl_json_float(def->agent_max_slope), "regionMinSize",
                  tl_json_float(def->region_min_size), "regionMergeSize", tl_json_float(def->region_merge_size),
                  "edgeMaxLen", tl_json_float(def->edge_max_len), "edgeMaxError", tl_json_float(def->edge_max_error),
                  "detailSampleDist", tl_json_float(def->detail_sample_dist), "detailSampleMaxError",
                  tl_json_float(def->detail_sample_max_error), "maxVertsPerPoly", (json_int_t)def->max_verts_per_poly,
                  "tileSize", (json_int_t)def->tile_size, "tileHeight", tl_json_float(def->tile_height));
    json_object_set_new(object, "partition", json_string(partitions[def->partition]));
    json_object_set_new(object, "polygonMethod", json_string(tl_partition_method_names[def->polygon_method]));
    json_object_set_new(object, "filterLowHangingObstacles", json_boolean(def->filter_low_hanging_obstacles));
    json_object_set_new(object, "filterLedgeSpans", json_boolean(def->filter_ledge_spans));
    json_object_set_new(object, "filterWalkableLowHeightSpans", json_boolean(def->filter_walkable_low_height_spans));
    return object;
}

// The head of the data: name, settings, and the view as a link's hash. Free it; NULL: out of memory.
static char *make_head(const char *path, const tl_nav_def *def, const view_settings *settings)
{
    char hash[256] = "";
    if (settings->has_ends) {
        const tl_vec3 a = settings->from;
        const tl_vec3 b = settings->to;
        snprintf(hash, sizeof(hash), "#tool=path&start=%.9g,%.9g,%.9g&goal=%.9g,%.9g,%.9g", (double)a.x, (double)a.y,
                 (double)a.z, (double)b.x, (double)b.y, (double)b.z);
    }
    json_t *object = json_pack("{so ss so}", "name", tl_json_text(tl_pack_source_name(path)), "hash", hash, "settings",
                               settings_json(def));
    char *text = object != NULL ? json_dumps(object, JSON_COMPACT | JSON_ENSURE_ASCII | JSON_REAL_PRECISION(9)) : NULL;
    json_decref(object);
    return text;
}

typedef struct page_sink {
    tl_atomic_file *file;
    tl_io_error *error;
    uint8_t rest[3]; // bytes that are no whole group yet
    uint32_t rest_count;
    char text[ENCODED_BYTES];
    uint32_t text_count;
} page_sink;

static tl_result write_text(page_sink *sink, const char *text, size_t size)
{
    return tl_atomic_file_write(sink->file, text, size, sink->error);
}

// Inside a script element "</script" and "<!--" would be read as markup: as JSON escapes they are not.
static tl_result write_page_json(page_sink *sink, const char *text)
{
    tl_result result = TL_OK;
    while (result == TL_OK && *text != '\0') {
        const size_t plain = strcspn(text, "<");
        result = write_text(sink, text, plain);
        text += plain;
        if (result == TL_OK && *text == '<') {
            result = write_text(sink, "\\u003c", 6);
            text++;
        }
    }
    return result;
}

static void encode_group(page_sink *sink, const uint8_t group[3], uint32_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const uint32_t bits =
        (uint32_t)group[0] << 16 | (count > 1 ? (uint32_t)group[1] << 8 : 0) | (count > 2 ? group[2] : 0);
    for (uint32_t k = 0; k < 4; ++k) {
        sink->text[sink->text_count++] = k <= count ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
}

static tl_result flush_encoded(page_sink *sink)
{
    const tl_result result = write_text(sink, sink->text, sink->text_count);
    sink->text_count = 0;
    return result;
}

// A tl_write_fn: base64 (RFC 4648).
static tl_result write_encoded(const void *bytes, size_t size, void *user)
{
    page_sink *sink = user;
    const uint8_t *next = bytes;
    for (size_t i = 0; i < size; ++i) {
        sink->rest[sink->rest_count++] = next[i];
        if (sink->rest_count < 3) {
            continue;
        }
        encode_group(sink, sink->rest, 3);
        sink->rest_count = 0;
        if (sink->text_count == ENCODED_BYTES) {
            const tl_result result = flush_encoded(sink);
            if (result != TL_OK) {
                return result;
            }
        }
    }
    return TL_OK;
}

static tl_result end_encoded(page_sink *sink)
{
    if (sink->rest_count > 0) {
        encode_group(sink, sink->rest, sink->rest_count);
        sink->rest_count = 0;
    }
    return flush_encoded(sink);
}

// ---------------------------------------------------------------------------------------------------------

// The baked file's content: its bytes, or chunks yet to be written.
typedef struct view_content {
    const tl_file_map *file;
    const tl_pack_content *chunks;
} view_content;

static tl_result write_content(page_sink *sink, const view_content *content)
{
    tl_result result = content->file != NULL ? write_encoded(content->file->bytes, content->file->size, sink)
                                             : tl_pack_write(content->chunks->items, content->chunks->count, NULL,
                                                             write_encoded, sink, NULL);
    return result == TL_OK ? end_encoded(sink) : result;
}

static tl_result write_page(page_sink *sink, const tl_file_map *page, const char *head, const view_content *content)
{
    static const char open_head[] = "<script type=\"application/json\" id=\"talus-view\">";
    static const char open_pack[] = "</script>\n<script type=\"text/plain\" id=\"talus-pack\">";
    static const char close[] = "</script>";
    const char *begin = page->bytes;
    const char *mark = find_mark(page);
    const char *after = mark + sizeof(PAGE_MARK) - 1;
    tl_result result = write_text(sink, begin, (size_t)(mark - begin));
    result = result == TL_OK ? write_text(sink, open_head, sizeof(open_head) - 1) : result;
    result = result == TL_OK ? write_page_json(sink, head) : result;
    result = result == TL_OK ? write_text(sink, open_pack, sizeof(open_pack) - 1) : result;
    result = result == TL_OK ? write_content(sink, content) : result;
    result = result == TL_OK ? write_text(sink, close, sizeof(close) - 1) : result;
    return result == TL_OK ? write_text(sink, after, page->size - (size_t)(after - begin)) : result;
}

static tl_exit print_page(tl_cli *cli, const view_settings *settings, uint64_t size)
{
    if (strcmp(settings->output, "-") == 0) {
        return TL_EXIT_OK;
    }
    if (cli->json) {
        return tl_cli_print_json(cli, json_pack("{so so sI}", "file", tl_json_text(cli->arguments.words[0]), "output",
                                                tl_json_text(settings->output), "bytes", (json_int_t)size));
    }
    printf("wrote    %s, %.1f MB; open it in a browser\n", settings->output, (double)size / 1e6);
    return TL_EXIT_OK;
}

static tl_exit fill_page(tl_cli *cli, const view_settings *settings, const tl_nav_def *def, const view_content *content)
{
    tl_exit code = TL_EXIT_OK;
    tl_file_map page;
    memset(&page, 0, sizeof(page));
    if (!open_page(cli, &page, &code)) {
        return code;
    }
    if (find_mark(&page) == NULL) {
        tl_file_map_close(&page);
        return tl_cli_fail(cli, TL_EXIT_DATA,
                           "the viewer's page has no mark '%s': build it again by 'make viewer-page'", PAGE_MARK);
    }
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    char *head = make_head(cli->arguments.words[0], def, settings);
    page_sink sink;
    memset(&sink, 0, sizeof(sink));
    sink.error = &error;
    tl_result result = head != NULL ? tl_atomic_file_open(settings->output, &sink.file, &error) : TL_ERR_MEMORY;
    uint64_t size = 0;
    if (result == TL_OK) {
        result = write_page(&sink, &page, head, content);
        size = tl_atomic_file_size(sink.file);
        if (result == TL_OK) {
            result = tl_atomic_file_commit(sink.file, &error);
        } else {
            tl_atomic_file_abort(sink.file);
        }
    }
    free(head);
    tl_file_map_close(&page);
    if (result != TL_OK) {
        return error.result != TL_OK ? tl_cli_fail_io(cli, &error)
                                     : tl_cli_fail_result(cli, settings->output, result, NULL);
    }
    return print_page(cli, settings, size);
}

static tl_exit view_level(tl_cli *cli, const view_settings *settings)
{
    tl_exit code = TL_EXIT_OK;
    tl_level level;
    tl_bake bake;
    tl_pack_content chunks;
    memset(&bake, 0, sizeof(bake));
    memset(&chunks, 0, sizeof(chunks));
    if (tl_level_load(cli, cli->arguments.words[0], &settings->bake.level, &level, &code) &&
        tl_bake_level(cli, &level, &settings->bake, &bake, &code)) {
        tl_progress_end(&cli->progress);
        const tl_result result = tl_pack_content_of_bake(&level, &bake, true, &chunks);
        const view_content content = { NULL, &chunks };
        code = result == TL_OK ? fill_page(cli, settings, &bake.nav_def, &content)
                               : tl_cli_fail_result(cli, level.path, result, NULL);
        if (code == TL_EXIT_OK && !bake.walkable) {
            tl_cli_warn(cli, "%s: nothing is walkable; in the page, choose Why and click a floor", level.path);
        }
    }
    tl_pack_content_free(&chunks);
    tl_bake_free(&bake);
    tl_level_free(&level);
    return code;
}

static tl_exit view_baked(tl_cli *cli, const view_settings *settings)
{
    tl_exit code = TL_EXIT_OK;
    tl_input input;
    const char *path = cli->arguments.words[0];
    if (tl_input_open_baked(cli, path, &input, &code)) {
        tl_result result;
        tl_nav_def def = tl_default_nav_def();
        const void *soup = tl_input_checked_chunk(&input, TL_PACK_SOUP, tl_soup_check, &result);
        if (soup == NULL) {
            code = result != TL_NOT_FOUND
                       ? tl_cli_fail_result(cli, path, result, NULL)
                       : tl_cli_fail(cli, TL_EXIT_DATA, "%s: holds no triangles; bake it without --no-soup", path);
        } else {
            const tl_pack_navmesh *navmesh =
                tl_input_checked_chunk(&input, TL_PACK_NAVM, tl_pack_navmesh_check, &result);
            if (navmesh != NULL) {
                def = tl_pack_navmesh_def(navmesh);
            }
            const view_content content = { &input.map, NULL };
            code = fill_page(cli, settings, &def, &content);
        }
    }
    tl_input_close(&input);
    return code;
}

static bool read_view_end(tl_cli *cli, const char *option, const char *text, tl_vec3 *point, tl_exit *exit_out)
{
    const char *reason = tl_parse_point_value(text, point);
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "%s: '%s' %s; give x,y,z", option, text, reason);
    }
    return reason == NULL;
}

static bool read_view_ends(tl_cli *cli, view_settings *settings, tl_exit *exit_out)
{
    settings->has_ends = settings->from_text != NULL && settings->to_text != NULL;
    if (!settings->has_ends) {
        if (settings->from_text != NULL || settings->to_text != NULL) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "a path needs both --from and --to");
        }
        return settings->from_text == NULL && settings->to_text == NULL;
    }
    return read_view_end(cli, "--from", settings->from_text, &settings->from, exit_out) &&
           read_view_end(cli, "--to", settings->to_text, &settings->to, exit_out);
}

static tl_exit run_view(tl_cli *cli)
{
    view_settings settings;
    memset(&settings, 0, sizeof(settings));
    settings.bake = tl_default_bake_settings();
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &settings.output, "PAGE.html", "where to write; required", PAGE_ENDINGS, 0,
          0, 0, 0 },
        { "from", 0, TL_OPTION_TEXT, &settings.from_text, "X,Y,Z", "open with a path from here ...", NULL, 0, 0, 0, 0 },
        { "to", 0, TL_OPTION_TEXT, &settings.to_text, "X,Y,Z", "... to here", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group own[] = { { "Options:", options }, { NULL, NULL } };
    tl_exit code;
    if (!tl_input_parse(cli, own, TL_INPUT_NAVMESH, &settings.bake, 1, 1, &code) ||
        !read_view_ends(cli, &settings, &code)) {
        return code;
    }
    if (settings.output == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "say where to write with -o PAGE.html");
    }
    return tl_input_is_baked(cli->arguments.words[0]) ? view_baked(cli, &settings) : view_level(cli, &settings);
}

const tl_command tl_view_command = {
    "view",
    "Levels",
    "write a page that shows a level and its bake in a browser",
    "FILE -o PAGE.html [options]",
    "Writes one HTML page that opens from disk, without a server or a network: the level, its bake and the\n"
    "viewer are in it. There every stage can be seen, every parameter changed, and the level is baked again\n"
    "in the page: paths, why a point is not walkable, obstacles, links, rays, the audit. FILE is a baked\n"
    "file, or a level, which is then baked.\n"
    "\n"
    "The empty page is found beside this program, where 'make install' puts it, or by the environment's\n"
    "TALUS_VIEWER. 'make viewer-page' builds it.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus view courtyard.obj -o courtyard.html\n"
    "talus view courtyard.obj -o narrow.html --agent-radius 0.3 --tile-size 48\n"
    "talus bake courtyard.obj -o courtyard.talus --links\n"
    "talus view courtyard.talus -o path.html --from 2,0,20 --to 20,5,20",
    run_view,
};
