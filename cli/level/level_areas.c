// SPDX-License-Identifier: MIT
//
// A rule that names a material exactly means that one only, though the name may hold * or ?; else it is a pattern. The
// last rule that fits a material counts, so a pattern for most may come first.

#include "cli/level/level_areas.h"

#include "cli/options/closest_word.h"
#include "cli/options/parse_value.h"
#include "cli/shared/text_buffer.h"
#include "io/files/growable.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NAMES_LISTED = 24 };

static bool fail_areas_memory(tl_cli *cli, const tl_level *level, tl_exit *exit_out)
{
    *exit_out = tl_cli_fail(cli, TL_EXIT_MEMORY, "%s: out of memory", level->path);
    return false;
}

static bool take_word(tl_cli *cli, const tl_level *level, const char *word, tl_area_marks *marks, tl_exit *exit_out)
{
    const char *equals = strrchr(word, '=');
    uint64_t area = 0;
    const char *reason = equals != NULL ? tl_parse_count_value(equals + 1, TL_NAV_MAX_AREA, &area) : "has no area";
    if (reason != NULL) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--area: '%s' %s; write NAME=ID, the id from 0 to %d", word, reason,
                                TL_NAV_MAX_AREA);
        return false;
    }
    return tl_area_marks_add_rule(marks, word, (size_t)(equals - word), 0, (uint8_t)area) == TL_OK ||
           fail_areas_memory(cli, level, exit_out);
}

// ---- Materials -----------------------------------------------------------------------------------------------

static void list_names(const tl_name_table *names, tl_text *text)
{
    // Number 0 is what has no material.
    for (uint32_t id = 1; id < names->count && id <= MAX_NAMES_LISTED; id++) {
        tl_text_add(text, id > 1 ? ", '" : "'");
        tl_text_add_safe(text, tl_name_table_get(names, id));
        tl_text_add(text, "'");
    }
    if (names->count > MAX_NAMES_LISTED + 1) {
        tl_text_add(text, ", and ");
        tl_text_add_count(text, names->count - MAX_NAMES_LISTED - 1);
        tl_text_add(text, " more");
    }
}

static const char *nearest_name(const tl_name_table *names, const char *word)
{
    tl_closest_word closest = tl_closest_word_to(word);
    for (uint32_t id = 1; id < names->count; id++) {
        const char *name = tl_name_table_get(names, id);
        tl_closest_word_offer(&closest, name, name);
    }
    return closest.meant;
}

static void fail_unknown(tl_cli *cli, const tl_level *level, const char *path, const tl_area_marks *marks,
                         const tl_area_rule *rule, tl_exit *exit_out)
{
    const tl_name_table *names = &level->imported.names;
    const char *wanted = marks->text + rule->name, *nearest = nearest_name(names, wanted);
    tl_text text = { NULL, 0, 0, false, NULL };
    if (rule->line > 0) {
        tl_text_add(&text, path);
        tl_text_add(&text, ":");
        tl_text_add_count(&text, rule->line);
    } else {
        tl_text_add(&text, "--area");
    }
    tl_text_add(&text, ": ");
    tl_text_add(&text, level->path);
    tl_text_add(&text, " has no material '");
    tl_text_add_safe(&text, wanted);
    tl_text_add(&text, nearest != NULL ? "'; did you mean '" : "'; ");
    tl_text_add_safe(&text, nearest != NULL ? nearest : "");
    tl_text_add(&text, nearest != NULL ? "'? It has " : "it has ");
    tl_text_add(&text, names->count > 1 ? "" : "none");
    list_names(names, &text);
    *exit_out = tl_cli_fail(cli, rule->line > 0 ? TL_EXIT_DATA : TL_EXIT_USAGE, "%.*s", (int)text.size,
                            text.size > 0 ? text.bytes : "");
    tl_text_free(&text);
}

// Gives the materials that a rule matches the rule's area. False: it matches none.
static bool apply_rule(const tl_area_marks *marks, const tl_area_rule *rule, const tl_name_table *names, uint8_t *areas)
{
    bool found = false;
    for (int exact = 1; exact >= 0 && !found; exact--) {
        for (uint32_t id = 0; id < names->count; id++) {
            const char *name = tl_name_table_get(names, id);
            if (exact ? tl_area_rule_is_exact(marks, rule, name) : tl_area_rule_matches(marks, rule, name)) {
                areas[id] = rule->area;
                found = true;
            }
        }
    }
    return found;
}

static bool mark_triangles(tl_cli *cli, const tl_level *level, const char *path, tl_level_areas *areas,
                           tl_exit *exit_out)
{
    const tl_area_marks *marks = &areas->marks;
    const tl_name_table *names = &level->imported.names;
    if (marks->rule_count == 0) {
        return true;
    }
    uint8_t *of_material = malloc(names->count + 1);
    areas->of_triangle = malloc(level->mesh.triangle_count);
    if (of_material == NULL || areas->of_triangle == NULL) {
        free(of_material);
        return fail_areas_memory(cli, level, exit_out);
    }
    memset(of_material, TL_NAV_WALKABLE_AREA, names->count + 1);
    bool known = true;
    for (uint32_t i = 0; known && i < marks->rule_count; i++) {
        known = apply_rule(marks, &marks->rules[i], names, of_material);
        if (!known) {
            fail_unknown(cli, level, path, marks, &marks->rules[i], exit_out);
        }
    }
    if (known) {
        const tl_mesh_view view = tl_mesh_as_view(&level->mesh);
        tl_nav_areas_from_materials(&view, of_material, names->count, areas->of_triangle);
    }
    free(of_material);
    return known;
}

bool tl_level_areas_make(tl_cli *cli, const tl_level *level, const tl_area_settings *settings,
                         tl_level_areas *areas_out, tl_exit *exit_out)
{
    memset(areas_out, 0, sizeof(*areas_out));
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    if (settings->path != NULL &&
        tl_area_marks_read(&areas_out->marks, settings->path, &cli->frame_room, &error) != TL_OK) {
        *exit_out = tl_cli_fail_io(cli, &error);
        return false;
    }
    for (uint32_t i = 0; i < settings->words.count; i++) {
        if (!take_word(cli, level, settings->words.words[i], &areas_out->marks, exit_out)) {
            return false;
        }
    }
    return mark_triangles(cli, level, settings->path, areas_out, exit_out);
}

tl_result tl_level_areas_of_marks(const tl_pack_volumes *marks, tl_level_areas *areas_out)
{
    memset(areas_out, 0, sizeof(*areas_out));
    if (marks->count == 0) {
        return TL_OK;
    }
    const tl_allocator allocator = tl_io_allocator_or_default(NULL);
    areas_out->marks.volumes = tl_io_allocate(&allocator, marks->count * sizeof(tl_nav_volume));
    if (areas_out->marks.volumes == NULL) {
        return TL_ERR_MEMORY;
    }
    areas_out->marks.volume_capacity = marks->count;
    areas_out->marks.volume_count = marks->count;
    for (uint32_t i = 0; i < marks->count; i++) {
        areas_out->marks.volumes[i] = tl_pack_volumes_at(marks, i);
    }
    return TL_OK;
}

tl_result tl_level_areas_of_triangles(const tl_pack_areas *kept, const uint32_t *numbers, uint32_t count,
                                      tl_level_areas *areas)
{
    areas->of_triangle = malloc((size_t)count + 1);
    if (areas->of_triangle == NULL) {
        return TL_ERR_MEMORY;
    }
    const uint8_t *of_source = tl_pack_areas_array(kept);
    for (uint32_t i = 0; i < count; i++) {
        if (numbers[i] >= kept->count) {
            return TL_ERR_CORRUPT;
        }
        areas->of_triangle[i] = of_source[numbers[i]];
    }
    return TL_OK;
}

void tl_level_areas_free(tl_level_areas *areas)
{
    tl_area_marks_free(&areas->marks);
    free(areas->of_triangle);
    memset(areas, 0, sizeof(*areas));
}

tl_nav_input tl_level_areas_input(const tl_level_areas *areas, const tl_mesh_view *mesh)
{
    const tl_nav_input input = { *mesh, areas->of_triangle, areas->marks.volumes, areas->marks.volume_count };
    return input;
}
