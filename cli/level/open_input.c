// SPDX-License-Identifier: MIT
//
// A baked file is recognised by its name or its head; a damaged one must be refused as what it is, and never be tried
// as a mesh.

#include "cli/level/open_input.h"

#include "cli/level/level_doubt.h"
#include "cli/shared/standard_input.h"

#include <string.h>

enum { PROBE_BYTES = 4096 };

static bool ends_with(const char *text, const char *end)
{
    size_t text_length = strlen(text);
    size_t end_length = strlen(end);
    return text_length >= end_length && strcmp(text + text_length - end_length, end) == 0;
}

// What the first bytes say. A file of fewer has no magic either, but it is no baked file until its name says so.
static bool has_baked_head(const void *bytes, size_t size)
{
    tl_pack pack;
    return size >= sizeof(tl_blob) && tl_pack_open(bytes, size, &pack, NULL) != TL_ERR_MAGIC;
}

bool tl_input_is_baked(const char *path)
{
    if (strcmp(path, "-") == 0) {
        _Alignas(TL_BLOB_ALIGNMENT) unsigned char head[PROBE_BYTES];
        return has_baked_head(head, tl_standard_input_peek(head, sizeof(head)));
    }
    if (ends_with(path, ".talus")) {
        return true;
    }
    tl_file_map map;
    if (tl_file_read(path, 0, &map, NULL) != TL_OK) {
        return false;
    }
    const bool baked = has_baked_head(map.bytes, map.size);
    tl_file_map_close(&map);
    return baked;
}

bool tl_input_refuse_options(tl_cli *cli, const char *path, const tl_option *options, tl_exit *exit_out)
{
    const char *given = tl_arguments_find_given(&cli->arguments, options);
    if (given == NULL || !tl_input_is_baked(path)) {
        return true;
    }
    *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE,
                            "--%s: %s is baked already, and keeps the options it was baked with; leave out --%s, or "
                            "give the level",
                            given, path, given);
    return false;
}

bool tl_input_parse(tl_cli *cli, const tl_option_group *own, tl_input_options options, tl_bake_settings *settings,
                    uint32_t min_words, uint32_t max_words, tl_exit *exit_out)
{
    tl_option level_options[TL_LEVEL_OPTIONS];
    tl_option nav_options[TL_NAV_OPTIONS];
    tl_option_group groups[TL_MAX_OPTION_GROUPS + 1];
    uint32_t count = 0;
    for (; own != NULL && own->title != NULL && count < TL_MAX_OPTION_GROUPS - 2; ++own) {
        groups[count++] = *own;
    }
    tl_level_options(&settings->level, level_options);
    const tl_option_group level = { "When FILE is a level:", level_options };
    groups[count++] = level;
    if (options == TL_INPUT_NAVMESH) {
        tl_nav_options(settings, nav_options);
        const tl_option_group nav = { "When FILE is a level, its navmesh:", nav_options };
        groups[count++] = nav;
    }
    const tl_option_group end = { NULL, NULL };
    groups[count] = end;
    if (!tl_cli_parse(cli, groups, min_words, max_words, exit_out)) {
        return false;
    }
    const char *path = cli->arguments.words[0];
    return tl_input_refuse_options(cli, path, level_options, exit_out) &&
           (options == TL_INPUT_LEVEL || (tl_input_refuse_options(cli, path, nav_options, exit_out) &&
                                          tl_bake_take_bounds(cli, settings, exit_out)));
}

// Files from before there were frames say only which axis was up.
static bool take_stored_frame(tl_cli *cli, const tl_input *input, tl_exit *exit_out)
{
    static const double nowhere[3] = { 0.0, 0.0, 0.0 };
    tl_result result;
    const tl_pack_frame *frame = tl_input_checked_chunk(input, TL_PACK_FRAM, tl_pack_frame_check, &result);
    if (result != TL_OK && result != TL_NOT_FOUND) {
        *exit_out = tl_cli_fail_result(cli, input->path, result, NULL);
        return false;
    }
    const tl_pack_meta *meta = tl_input_checked_chunk(input, TL_PACK_META, tl_pack_meta_check, &result);
    const bool z_up = meta != NULL && meta->source_up == TL_PACK_UP_Z;
    tl_level_take_frame(cli, input->path,
                        frame != NULL ? (tl_pack_axes)frame->axes
                        : z_up        ? TL_PACK_AXES_Z_UP
                                      : TL_PACK_AXES_Y_UP,
                        frame != NULL ? frame->origin : nowhere);
    return true;
}

bool tl_input_open_baked(tl_cli *cli, const char *path, tl_input *input_out, tl_exit *exit_out)
{
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    memset(input_out, 0, sizeof(*input_out));
    input_out->path = path;
    input_out->baked = true;
    if (tl_file_read(path, 0, &input_out->map, &error) != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
        return false;
    }
    tl_report report;
    memset(&report, 0, sizeof(report));
    report.element_index = TL_NO_ELEMENT;
    tl_result result = tl_file_open_pack(&input_out->map, &input_out->pack, &report);
    if (result != TL_OK) {
        report.advice =
            result == TL_ERR_MAGIC ? "this is not a file of talus bake" : "copy it again, or bake the level again";
        *exit_out = tl_cli_fail_result(cli, path, result, &report);
        return false;
    }
    return take_stored_frame(cli, input_out, exit_out);
}

const void *tl_input_checked_chunk(const tl_input *input, uint32_t type,
                                   tl_result (*check)(const void *, uint64_t, tl_report *), tl_result *result_out)
{
    tl_pack_chunk chunk;
    *result_out = tl_pack_find(&input->pack, type, 0, &chunk);
    if (*result_out == TL_OK) {
        *result_out = check(chunk.bytes, chunk.size, NULL);
    }
    return *result_out == TL_OK ? chunk.bytes : NULL;
}

bool tl_input_open_soup(tl_cli *cli, const char *path, const tl_bake_settings *settings, tl_input *input_out,
                        tl_exit *exit_out)
{
    if (tl_input_is_baked(path)) {
        if (!tl_input_open_baked(cli, path, input_out, exit_out)) {
            return false;
        }
        tl_result result;
        input_out->soup = tl_input_checked_chunk(input_out, TL_PACK_SOUP, tl_soup_check, &result);
        if (result == TL_NOT_FOUND) {
            *exit_out =
                tl_cli_fail(cli, TL_EXIT_DATA, "%s: holds no triangles to query; bake it without --no-soup", path);
        } else if (result != TL_OK) {
            *exit_out = tl_cli_fail_result(cli, path, result, NULL);
        }
        return input_out->soup != NULL;
    }
    memset(input_out, 0, sizeof(*input_out));
    input_out->path = path;
    tl_bake_settings only_soup = *settings;
    only_soup.soup = true;
    only_soup.nav = false;
    only_soup.hull = false;
    bool ok = tl_level_load(cli, path, &settings->level, &input_out->level, exit_out) &&
              tl_bake_level(cli, &input_out->level, &only_soup, &input_out->bake, exit_out);
    input_out->soup = input_out->bake.soup;
    tl_progress_end(&cli->progress);
    return ok;
}

tl_exit tl_input_fail_empty(tl_cli *cli, const tl_input *input, const tl_bake_settings *settings)
{
    if (input->baked) {
        return tl_cli_fail(cli, TL_EXIT_EMPTY,
                           "%s: nothing is walkable; bake the level again, which tells the likely cause", input->path);
    }
    const tl_level_doubt doubt =
        tl_level_explain_empty(cli, &input->level, settings, &input->bake.nav_report, &input->bake.pruned);
    return tl_cli_fail(cli, TL_EXIT_EMPTY, "%s: nothing is walkable (%s): %s", input->path, doubt.cause, doubt.text);
}

static bool load_navmesh(tl_cli *cli, tl_input *input, const tl_bake_settings *settings, tl_exit *exit_out)
{
    tl_report report;
    memset(&report, 0, sizeof(report));
    report.element_index = TL_NO_ELEMENT;
    tl_result result = tl_pack_load_navmesh(&input->pack, NULL, &input->navmesh, &report);
    if (result == TL_NOT_FOUND) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_DATA, "%s: holds no navmesh; bake it without --no-nav", input->path);
    } else if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, input->path, result, &report);
    } else if (tl_navmesh_tile_count(input->navmesh) == 0) {
        *exit_out = tl_input_fail_empty(cli, input, settings);
        return false;
    }
    return result == TL_OK;
}

bool tl_input_open_level(tl_cli *cli, const char *path, const tl_bake_settings *settings, tl_input *input_out,
                         tl_exit *exit_out)
{
    if (tl_input_is_baked(path)) {
        return tl_input_open_baked(cli, path, input_out, exit_out);
    }
    memset(input_out, 0, sizeof(*input_out));
    input_out->path = path;
    return tl_level_load(cli, path, &settings->level, &input_out->level, exit_out);
}

bool tl_input_need_navmesh(tl_cli *cli, const tl_bake_settings *settings, tl_input *input, tl_exit *exit_out)
{
    if (input->baked) {
        return load_navmesh(cli, input, settings, exit_out);
    }
    tl_bake_settings only_nav = *settings;
    only_nav.soup = false;
    only_nav.nav = true;
    only_nav.hull = false;
    bool ok = tl_bake_level(cli, &input->level, &only_nav, &input->bake, exit_out);
    tl_progress_end(&cli->progress);
    if (ok && !input->bake.walkable) {
        *exit_out = tl_input_fail_empty(cli, input, settings);
        return false;
    }
    return ok && tl_bake_assemble_navmesh(cli, input->path, &input->bake, &input->navmesh, exit_out);
}

bool tl_input_open_navmesh(tl_cli *cli, const char *path, const tl_bake_settings *settings, tl_input *input_out,
                           tl_exit *exit_out)
{
    return tl_input_open_level(cli, path, settings, input_out, exit_out) &&
           tl_input_need_navmesh(cli, settings, input_out, exit_out);
}

void tl_input_close(tl_input *input)
{
    tl_navmesh_destroy(input->navmesh);
    tl_bake_free(&input->bake);
    tl_level_free(&input->level);
    tl_file_map_close(&input->map);
    memset(input, 0, sizeof(*input));
}
