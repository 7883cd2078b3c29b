// SPDX-License-Identifier: MIT
//
// Getting what a stage is drawn from. A baked file keeps its geometry once, in the soup; the triangles are read back
// from there, and the navmesh's intermediate data is baked again with the parameters that the file remembers.

#include "cli/draw/draw_source.h"

#include <stdlib.h>
#include <string.h>

static bool fail_source_memory(draw_source *source, tl_exit *exit_out)
{
    *exit_out = tl_cli_fail(source->cli, TL_EXIT_MEMORY, "out of memory");
    return false;
}

static bool triangles_of_soup(draw_source *source, tl_exit *exit_out)
{
    tl_soup_stats stats = tl_soup_get_stats(source->soup);
    size_t corner_count = 3 * (size_t)stats.triangle_count;
    source->corners = malloc(corner_count * sizeof *source->corners);
    source->indices = malloc(corner_count * sizeof *source->indices);
    source->numbers = malloc(stats.triangle_count * sizeof *source->numbers);
    if (source->corners == NULL || source->indices == NULL || source->numbers == NULL) {
        return fail_source_memory(source, exit_out);
    }
    uint64_t cursor = 0;
    tl_soup_triangle triangle;
    uint32_t count = 0;
    while (count < stats.triangle_count && tl_soup_next_triangle(source->soup, &cursor, &triangle)) {
        for (uint32_t k = 0; k < 3; k++) {
            source->corners[3 * (size_t)count + k] = triangle.corners[k];
            source->indices[3 * (size_t)count + k] = 3 * count + k;
        }
        source->numbers[count++] = triangle.triangle;
    }
    tl_mesh_view view = { source->corners, 3 * count, source->indices, count, NULL };
    source->mesh = view;
    source->bounds = tl_soup_bounds(source->soup);
    return true;
}

// What materials gave the triangles, where the file says so.
static bool take_triangle_areas(draw_source *source, const char *path, tl_exit *exit_out)
{
    tl_result result;
    const tl_pack_areas *kept = tl_input_checked_chunk(&source->input, TL_PACK_AREA, tl_pack_areas_check, &result);
    if (kept != NULL) {
        source->soup_areas = tl_pack_areas_array(kept);
        result = tl_level_areas_of_triangles(kept, source->numbers, source->mesh.triangle_count, &source->areas);
    }
    if (result != TL_OK && result != TL_NOT_FOUND) {
        *exit_out = tl_cli_fail_result(source->cli, path, result, NULL);
    }
    return result == TL_OK || result == TL_NOT_FOUND;
}

static bool open_baked_source(draw_source *source, const char *path, tl_exit *exit_out)
{
    if (!tl_input_open_baked(source->cli, path, &source->input, exit_out)) {
        return false;
    }
    tl_result result;
    source->soup = tl_input_checked_chunk(&source->input, TL_PACK_SOUP, tl_soup_check, &result);
    if (source->soup == NULL && result != TL_NOT_FOUND) {
        *exit_out = tl_cli_fail_result(source->cli, path, result, NULL);
        return false;
    }
    source->is_bare = source->soup == NULL;
    const tl_pack_navmesh *parameters =
        tl_input_checked_chunk(&source->input, TL_PACK_NAVM, tl_pack_navmesh_check, &result);
    if (parameters != NULL) {
        source->nav_def = tl_pack_navmesh_def(parameters);
        source->bounds = parameters->bounds;
    }
    const tl_pack_volumes *marks = tl_input_checked_chunk(&source->input, TL_PACK_MARK, tl_pack_volumes_check, &result);
    if (marks != NULL) {
        result = tl_level_areas_of_marks(marks, &source->areas);
    }
    if (result != TL_OK && result != TL_NOT_FOUND) {
        *exit_out = tl_cli_fail_result(source->cli, path, result, NULL);
        return false;
    }
    return source->is_bare || (triangles_of_soup(source, exit_out) && take_triangle_areas(source, path, exit_out));
}

// Whether the file's first word says that it holds contours. One that cannot be opened does not: reading it as a level
// names the reason.
static bool is_contour_file(const char *path)
{
    static const char magic[] = "navcontours ";
    tl_file_map map;
    if (strcmp(path, "-") == 0 || tl_file_read(path, 0, &map, NULL) != TL_OK) {
        return false;
    }
    bool is = map.size >= sizeof magic && memcmp(map.bytes, magic, sizeof magic - 1) == 0;
    tl_file_map_close(&map);
    return is;
}

static bool open_contours(draw_source *source, const char *path, uint32_t set, tl_exit *exit_out)
{
    tl_io_error error;
    tl_file_map map;
    source->input.path = path;
    source->is_contours = true;
    if (tl_file_read(path, 0, &map, &error) != TL_OK) {
        *exit_out = tl_cli_fail_io(source->cli, &error);
        return false;
    }
    tl_text_reader reader;
    memset(&reader, 0, sizeof reader);
    reader.bytes = map.bytes;
    reader.size = map.size;
    reader.path = path;
    tl_result result = tl_contour_text_read(&reader, &source->text, &error);
    uint32_t at = 0;
    for (; result == TL_OK && at < set && !tl_text_reader_at_end(&reader); at++) {
        tl_contour_text_free(&source->text);
        result = tl_contour_text_read(&reader, &source->text, &error);
    }
    tl_file_map_close(&map);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_io(source->cli, &error);
    } else if (at < set) {
        *exit_out = tl_cli_fail(source->cli, TL_EXIT_USAGE, "--set: %s holds %u sets, numbered from 0", path, at + 1);
        result = TL_NOT_FOUND;
    }
    source->contours = &source->text.set;
    source->bounds = source->text.set.bounds;
    if (source->text.max_verts_per_poly >= 3 && source->text.max_verts_per_poly <= 64) {
        source->nav_def.max_verts_per_poly = source->text.max_verts_per_poly;
    }
    return result == TL_OK;
}

bool draw_source_open(tl_cli *cli, const char *path, const tl_bake_settings *settings, uint32_t set,
                      draw_source *source_out, tl_exit *exit_out)
{
    memset(source_out, 0, sizeof *source_out);
    source_out->cli = cli;
    source_out->settings = settings;
    source_out->nav_def = tl_bake_nav_def(settings);
    if (tl_input_is_baked(path)) {
        return open_baked_source(source_out, path, exit_out);
    }
    if (is_contour_file(path)) {
        return open_contours(source_out, path, set, exit_out);
    }
    source_out->input.path = path;
    if (!tl_level_load(cli, path, &settings->level, &source_out->input.level, exit_out)) {
        return false;
    }
    source_out->mesh = tl_mesh_as_view(&source_out->input.level.mesh);
    source_out->bounds = source_out->input.level.mesh.bounds;
    return tl_level_areas_make(cli, &source_out->input.level, &settings->areas, &source_out->areas, exit_out);
}

void draw_source_close(draw_source *source)
{
    if (source->is_contours) {
        tl_contour_text_free(&source->text);
    }
    tl_nav_stages_free(&source->stages);
    tl_level_areas_free(&source->areas);
    tl_blob_free(source->baked_soup);
    free(source->corners);
    free(source->indices);
    free(source->numbers);
    tl_navmesh_destroy(source->pruned);
    tl_input_close(&source->input);
    memset(source, 0, sizeof *source);
}

uint32_t draw_soup_triangle(const draw_source *source, uint32_t triangle)
{
    const bool cleaned = !source->input.baked && triangle != TL_NO_TRIANGLE;
    return cleaned ? source->input.level.mesh.source_triangles[triangle] : triangle;
}

uint32_t draw_mesh_triangle(const draw_source *source, uint32_t triangle)
{
    const bool read_back = source->numbers != NULL && triangle != TL_NO_TRIANGLE;
    return read_back ? source->numbers[triangle] : draw_soup_triangle(source, triangle);
}

bool draw_need_soup(draw_source *source, tl_exit *exit_out)
{
    if (source->soup != NULL) {
        return true;
    }
    tl_soup_def def = tl_default_soup_def();
    def.host = source->cli->host;
    tl_soup_report report;
    tl_result result = tl_soup_bake(&source->mesh, &def, &source->baked_soup, &report);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(source->cli, source->input.path, result, &report.base);
    }
    source->soup = source->baked_soup;
    return result == TL_OK;
}

// Files that were baked before they kept the areas of triangles have of materials only what came of them, in the tiles.
static void warn_of_areas(const draw_source *source)
{
    tl_area_sums sums;
    memset(&sums, 0, sizeof sums);
    const tl_pack *pack = &source->input.pack;
    for (uint32_t i = 0; source->input.baked && i < pack->chunk_count; i++) {
        const tl_pack_chunk chunk = tl_pack_chunk_at(pack, i);
        if (chunk.type == TL_PACK_NAVT && tl_nav_tile_check(chunk.bytes, chunk.size, NULL) == TL_OK) {
            tl_area_sums_add(&sums, chunk.bytes);
        }
    }
    if (source->areas.marks.volume_count == 0 && source->areas.of_triangle == NULL && tl_area_sums_has_others(&sums)) {
        tl_cli_warn(source->cli,
                    "%s was baked with areas; the stages before navmesh are baked again without them; draw "
                    "the level with the same --area and --areas to see them",
                    source->input.path);
    }
}

bool draw_need_stages(draw_source *source, tl_exit *exit_out)
{
    if (source->has_stages) {
        return true;
    }
    warn_of_areas(source);
    tl_nav_def def = source->nav_def;
    def.tile_size = 0;
    def.host = source->cli->host;
    tl_nav_config config;
    tl_nav_bake_report report;
    memset(&report, 0, sizeof report);
    tl_result result = tl_nav_config_from_def(&def, source->bounds, 0, 0, &config, &report.base);
    tl_nav_tile *tile = NULL;
    if (result == TL_OK) {
        const tl_nav_input input = tl_level_areas_input(&source->areas, &source->mesh);
        result = tl_nav_tile_bake(&config, &input, &source->cli->host, &source->stages, &tile, &report);
    }
    tl_blob_free(tile);
    source->has_stages = result == TL_OK;
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(source->cli, source->input.path, result, &report.base);
    }
    return source->has_stages;
}

bool draw_need_contours(draw_source *source, tl_exit *exit_out)
{
    if (source->contours == NULL && draw_need_stages(source, exit_out)) {
        source->contours = &source->stages.contours.set;
    }
    return source->contours != NULL;
}

// A level's tiles, as bake makes them.
static bool bake_tiles(draw_source *source, tl_exit *exit_out)
{
    tl_bake_settings only_nav = *source->settings;
    only_nav.soup = false;
    only_nav.nav = true;
    only_nav.hull = false;
    return tl_bake_level(source->cli, &source->input.level, &only_nav, &source->input.bake, exit_out) &&
           tl_bake_assemble_navmesh(source->cli, source->input.path, &source->input.bake, &source->input.navmesh,
                                    exit_out);
}

static bool load_tiles(draw_source *source, tl_exit *exit_out)
{
    tl_report report;
    memset(&report, 0, sizeof report);
    report.element_index = TL_NO_ELEMENT;
    const tl_result result = tl_pack_load_navmesh(&source->input.pack, NULL, &source->input.navmesh, &report);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(source->cli, source->input.path, result, &report);
    }
    return result == TL_OK;
}

static tl_result assemble_pruned(draw_source *source)
{
    const tl_nav_tiles *removed = &source->input.bake.removed;
    tl_result result = removed->tile_count > 0 ? tl_navmesh_create(NULL, &source->pruned) : TL_NOT_FOUND;
    for (uint32_t i = 0; i < removed->tile_count && result == TL_OK; i++) {
        result = tl_navmesh_add_tile(source->pruned, removed->tiles[i], TL_NAV_TILE_BORROWED);
    }
    return result;
}

// What was left out, and by which rules.
static bool need_pruned(draw_source *source, tl_exit *exit_out)
{
    tl_report report;
    memset(&report, 0, sizeof report);
    report.element_index = TL_NO_ELEMENT;
    const tl_pack_pruning *rules = source->input.bake.pruning;
    tl_result result = TL_NOT_FOUND;
    if (source->input.baked) {
        rules = tl_input_checked_chunk(&source->input, TL_PACK_PRUN, tl_pack_pruning_check, &result);
    }
    if (rules != NULL) {
        source->pruning.min_area = rules->min_area;
        result = source->input.baked ? tl_pack_load_pruned(&source->input.pack, NULL, &source->pruned, &report)
                                     : assemble_pruned(source);
        source->pruning.removed = source->pruned;
    }
    if (result != TL_OK && result != TL_NOT_FOUND) {
        *exit_out = tl_cli_fail_result(source->cli, source->input.path, result, &report);
        return false;
    }
    return true;
}

bool draw_need_navmesh(draw_source *source, tl_exit *exit_out)
{
    if (!source->has_navmesh) {
        source->has_navmesh = (source->input.baked ? load_tiles(source, exit_out) : bake_tiles(source, exit_out)) &&
                              need_pruned(source, exit_out);
    }
    return source->has_navmesh;
}

bool draw_need_walkable(draw_source *source, tl_exit *exit_out)
{
    if (!draw_need_navmesh(source, exit_out)) {
        return false;
    }
    const bool walkable = tl_navmesh_tile_count(source->input.navmesh) > 0;
    if (!walkable) {
        *exit_out = tl_input_fail_empty(source->cli, &source->input, source->settings);
    }
    return walkable;
}
