// SPDX-License-Identifier: MIT
//
// A key that is not known is refused: a "bothways" that nobody reads would be a ladder that leads up only.

#include "cli/level/hand_links.h"

#include "cli/options/parse_value.h"
#include "io/files/file_map.h"
#include "io/files/growable.h"
#include "io/text/json_place.h"

#include <math.h>
#include <string.h>

typedef struct link_list {
    const tl_pack_frame *frame;
    tl_nav_offmesh *links;
    uint32_t count;
    uint64_t capacity;
} link_list;

static tl_nav_offmesh *push_link(link_list *list, const double ends[6])
{
    const tl_allocator allocator = tl_io_allocator_or_default(NULL);
    void *links = list->links;
    const bool fits = list->count < TL_NAV_MAX_OFFMESH && tl_io_grow(&allocator, &links, &list->capacity, list->count,
                                                                     (uint64_t)list->count + 1, sizeof *list->links);
    list->links = links;
    if (!fits) {
        return NULL;
    }
    tl_nav_offmesh *link = &list->links[list->count++];
    *link = tl_default_nav_offmesh();
    link->start = tl_pack_place_in(list->frame, ends);
    link->end = tl_pack_place_in(list->frame, ends + 3);
    return link;
}

static bool take_link_words(tl_cli *cli, const tl_option_texts *words, link_list *list, tl_exit *exit_out)
{
    for (uint32_t i = 0; i < words->count; i++) {
        float check[6];
        double ends[6];
        const char *reason = tl_parse_float_list(words->words[i], check, 6, 6, NULL);
        if (reason != NULL) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--link: '%s' %s; give start and end, x,y,z,x,y,z",
                                    words->words[i], reason);
            return false;
        }
        tl_parse_double_words(words->words[i], ends, 6);
        if (push_link(list, ends) == NULL) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_MEMORY, "out of memory");
            return false;
        }
    }
    return true;
}

// ---- The file ----------------------------------------------------------------------------------------------------

static bool is_known_key(const char *key, const char *const *known)
{
    while (*known != NULL && strcmp(key, *known) != 0) {
        known++;
    }
    return *known != NULL;
}

static void refuse_unknown(tl_json_reader *json, const tl_json_place *at, const char *const *known)
{
    const char *key;
    json_t *value;
    json_object_foreach(at->value, key, value)
    {
        if (!is_known_key(key, known)) {
            tl_json_fail(json, TL_ERR_FORMAT, at, key, "is no key that links have");
            return;
        }
    }
}

static float read_length(tl_json_reader *json, const tl_json_place *at, const char *key, float absent)
{
    const json_t *value = json_object_get(at->value, key);
    if (value == NULL) {
        return absent;
    }
    const double number = json_number_value(value);
    if (!json_is_number(value) || !(number >= 0.0 && number <= 1e30)) {
        tl_json_fail(json, TL_ERR_RANGE, at, key, "must be a number from 0 on");
    }
    return (float)number;
}

// Numbers of JSON are read as doubles, which are exact up to there.
static uint64_t read_count_or(tl_json_reader *json, const tl_json_place *at, const char *key, uint64_t absent)
{
    const json_t *value = json_object_get(at->value, key);
    if (value == NULL) {
        return absent;
    }
    const double number = json_number_value(value);
    if (!json_is_number(value) || !(number >= 0.0 && number <= 9007199254740992.0) || number != floor(number)) {
        tl_json_fail(json, TL_ERR_RANGE, at, key, "must be a whole number from 0 to 2^53");
        return absent;
    }
    return (uint64_t)number;
}

static void read_json_link(tl_json_reader *json, const tl_json_place *at, link_list *list)
{
    static const char *const known[] = { "start",      "end",  "both_ways", "radius", "cost_factor",
                                         "fixed_cost", "area", "user",      "flags",  NULL };
    double ends[6];
    refuse_unknown(json, at, known);
    for (int i = 0; i < 2; i++) {
        const char *key = i == 0 ? "start" : "end";
        double *point = ends + 3 * i;
        const bool is_there = tl_json_numbers(json, at, key, point, 3);
        const bool fits = is_there && tl_is_finite(tl_vec3_make((float)point[0], (float)point[1], (float)point[2]));
        if (!fits && json->result == TL_OK) {
            tl_json_fail(json, TL_ERR_FORMAT, at, key, "must be a point, [x, y, z]");
        }
    }
    if (json->result != TL_OK) {
        return;
    }
    tl_nav_offmesh *link = push_link(list, ends);
    if (link == NULL) {
        tl_json_fail(json, TL_ERR_MEMORY, at, NULL, "there is no memory for it");
        return;
    }
    link->both_ways = tl_json_bool(json, at, "both_ways");
    link->radius = read_length(json, at, "radius", link->radius);
    link->cost_factor = read_length(json, at, "cost_factor", link->cost_factor);
    link->fixed_cost = read_length(json, at, "fixed_cost", link->fixed_cost);
    link->flags = read_count_or(json, at, "flags", link->flags);
    link->user = read_count_or(json, at, "user", link->user);
    const uint64_t area = read_count_or(json, at, "area", link->area);
    if (area > TL_NAV_MAX_AREA) {
        tl_json_fail(json, TL_ERR_RANGE, at, "area", "must be 0 to 255");
    }
    if (link->flags == 0) {
        tl_json_fail(json, TL_ERR_RANGE, at, "flags", "must not be 0: no filter passes that");
    }
    link->area = (uint8_t)area;
}

static tl_result read_links_text(const char *path, const tl_file_map *map, link_list *list, tl_io_error *error)
{
    static const char *const known[] = { "links", NULL };
    tl_json_reader json = { TL_OK, path, error, "'talus bake --help' shows the keys" };
    tl_json_place root, links, item;
    if (tl_json_load(&json, map->bytes, map->size, &root) != TL_OK) {
        return json.result;
    }
    refuse_unknown(&json, &root, known);
    const size_t count = tl_json_list(&json, &root, "links", &links);
    if (json.result == TL_OK && json_object_get(root.value, "links") == NULL) {
        tl_json_fail(&json, TL_ERR_FORMAT, &root, "links", "is missing: the array of links");
    }
    for (size_t i = 0; json.result == TL_OK && i < count; i++) {
        if (tl_json_item(&json, &links, i, &item)) {
            read_json_link(&json, &item, list);
        }
    }
    json_decref(root.value);
    return json.result;
}

static bool take_link_file(tl_cli *cli, const char *path, link_list *list, tl_exit *exit_out)
{
    tl_file_map map;
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    tl_result result = tl_file_read(path, 0, &map, &error);
    if (result == TL_OK) {
        result = read_links_text(path, &map, list, &error);
        tl_file_map_close(&map);
    }
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
    }
    return result == TL_OK;
}

// ---- What the others call ------------------------------------------------------------------------------------------

bool tl_hand_links_make(tl_cli *cli, const tl_hand_link_settings *settings, tl_pack_offmesh **links_out,
                        tl_exit *exit_out)
{
    link_list list = { &cli->frame_room, NULL, 0, 0 }; // the level's own, whatever the command speaks
    tl_report report;
    memset(&report, 0, sizeof(report));
    *links_out = NULL;
    bool ok = (settings->path == NULL || take_link_file(cli, settings->path, &list, exit_out)) &&
              take_link_words(cli, &settings->words, &list, exit_out);
    if (ok && list.count > 0) {
        const tl_result result = tl_pack_offmesh_encode(list.links, list.count, NULL, links_out, &report);
        ok = result == TL_OK;
        if (!ok) {
            *exit_out = tl_cli_fail_result(cli, settings->path != NULL ? settings->path : "--link", result, &report);
        }
    }
    const tl_allocator allocator = tl_io_allocator_or_default(NULL);
    tl_io_release(&allocator, list.links, list.capacity * sizeof *list.links);
    return ok;
}

tl_result tl_hand_links_add(const tl_pack_offmesh *links, tl_navmesh *navmesh, tl_report *report)
{
    tl_result result = TL_OK;
    for (uint32_t i = 0; result == TL_OK && links != NULL && i < links->count; i++) {
        const tl_nav_offmesh link = tl_pack_offmesh_at(links, i);
        tl_nav_ref ref;
        result = tl_navmesh_add_offmesh(navmesh, &link, &ref, report);
    }
    return result;
}

uint32_t tl_hand_links_warn(tl_cli *cli, const char *path, const tl_navmesh *navmesh)
{
    uint32_t cursor = 0, number = 0, lost = 0;
    tl_nav_ref link;
    for (; tl_navmesh_next_offmesh(navmesh, &cursor, &link); number++) {
        tl_nav_offmesh_state state;
        if (tl_navmesh_offmesh_state(navmesh, link, &state) != TL_OK || state.anchored) {
            continue;
        }
        const bool no_start = state.ends[0].polygon == TL_NAV_NO_REF;
        double at[3];
        tl_pack_place_out(cli->frame, no_start ? state.offmesh.start : state.offmesh.end, at);
        tl_cli_warn(cli,
                    "%s: link %u is of no use: there is no navmesh within %g m of its %s, %.9g,%.9g,%.9g; move it, or "
                    "give a larger radius",
                    path, number, (double)state.offmesh.radius, no_start ? "start" : "end", at[0], at[1], at[2]);
        lost++;
    }
    return lost;
}
