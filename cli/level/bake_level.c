// SPDX-License-Identifier: MIT
//
// The soup takes the source's triangles, so that rays report the source's indices; navmesh and hull take the cleaned
// mesh.

#include "cli/level/bake_level.h"

#include "cli/level/level_doubt.h"
#include "cli/level/polygonize_compare.h"
#include "cli/options/parse_value.h"

#include <stdlib.h>
#include <string.h>

static bool bake_soup(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, tl_bake *bake,
                      tl_exit *exit_out)
{
    tl_mesh_view view = tl_level_source_view(level);
    tl_soup_def def = tl_default_soup_def();
    def.layout = (tl_soup_layout)settings->soup_layout;
    def.host = cli->host;
    tl_result result = tl_soup_bake(&view, &def, &bake->soup, &bake->soup_report);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, level->path, result, &bake->soup_report.base);
    }
    return result == TL_OK;
}

// A flat level has no hull, which is worth a word but no reason to give up the rest.
static bool bake_hull(tl_cli *cli, const tl_level *level, tl_bake *bake, tl_exit *exit_out)
{
    tl_hull_def def = tl_default_hull_def();
    tl_hull_report report;
    def.host = cli->host;
    bake->hull_result = tl_hull_bake(level->mesh.vertices, level->mesh.vertex_count, &def, &bake->hull, &report);
    switch (bake->hull_result) {
    case TL_OK:
        return true;
    case TL_ERR_COINCIDENT:
    case TL_ERR_COLLINEAR:
    case TL_ERR_COPLANAR:
        tl_cli_warn(cli, "%s: no hull: %s", level->path, tl_result_text(bake->hull_result));
        return true;
    default:
        *exit_out = tl_cli_fail_result(cli, level->path, bake->hull_result, &report.base);
        return false;
    }
}

// --bounds in the level's own coordinates.
static void enter_bounds(const tl_cli *cli, const tl_bake_settings *settings, tl_nav_def *def)
{
    double v[6];
    if (cli->frame != NULL && settings->bounds != NULL) {
        tl_parse_double_words(settings->bounds, v, 6);
        const tl_vec3 a = tl_pack_place_in(cli->frame, v), b = tl_pack_place_in(cli->frame, v + 3);
        def->bounds.min = tl_min(a, b); // turned, the lowest corner is another one
        def->bounds.max = tl_max(a, b);
    }
}

static bool fail_prune(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings,
                       const tl_nav_prune_def *def, tl_result result, const tl_report *report, tl_exit *exit_out)
{
    if (result == TL_ERR_ARGUMENT && report->element != NULL && strcmp(report->element, "seed") == 0 &&
        report->element_index < settings->seeds.count) {
        const tl_vec3 e = def->seed_extents;
        *exit_out = tl_cli_fail(cli, TL_EXIT_DATA,
                                "%s: --reachable-from %s: there is no navmesh within %g m, and %g m up or down",
                                level->path, settings->seeds.words[report->element_index], (double)e.x, (double)e.y);
    } else {
        *exit_out = tl_cli_fail_result(cli, level->path, result, report);
    }
    return false;
}

// The same point as a place for seeds, where a link set by hand leads on from an island with a seed: the islands that
// hang together by links count as one, so that a tower that only a ladder leads to is kept. False: reported.
static bool seed_linked_islands(tl_cli *cli, const tl_level *level, const tl_bake *bake, tl_nav_prune_def *def,
                                tl_vec3 *seeds, tl_exit *exit_out)
{
    tl_navmesh *navmesh = NULL;
    const bool ok = tl_bake_assemble_navmesh(cli, level->path, bake, &navmesh, exit_out);
    const uint32_t given = def->seed_count;
    uint32_t cursor = 0;
    tl_nav_ref link;
    while (ok && tl_navmesh_next_offmesh(navmesh, &cursor, &link)) {
        tl_nav_offmesh_state state;
        uint32_t island = 0, own = 0;
        if (tl_navmesh_offmesh_state(navmesh, link, &state) != TL_OK || !state.anchored) {
            continue;
        }
        tl_navmesh_island(navmesh, state.ends[0].polygon, &own);
        for (uint32_t i = 0; i < given; i++) {
            tl_nav_location near;
            if (tl_navmesh_find_nearest(navmesh, NULL, def->seeds[i], def->seed_extents, &near) == TL_OK &&
                tl_navmesh_island(navmesh, near.polygon, &island) == TL_OK && island == own) {
                seeds[def->seed_count++] = state.ends[0].point;
                seeds[def->seed_count++] = state.ends[1].point;
                break;
            }
        }
    }
    tl_navmesh_destroy(navmesh);
    return ok;
}

static bool take_seeds(tl_cli *cli, const tl_bake_settings *settings, tl_vec3 *seeds, tl_exit *exit_out)
{
    for (uint32_t i = 0; i < settings->seeds.count; i++) {
        const char *word = settings->seeds.words[i], *reason = tl_parse_point_value(word, &seeds[i]);
        if (reason != NULL) {
            *exit_out = tl_cli_fail(cli, TL_EXIT_USAGE, "--reachable-from: '%s' %s; give x,y,z", word, reason);
            return false;
        }
        double exact[3];
        if (cli->frame != NULL && tl_parse_double_triple(word, exact) == NULL) {
            seeds[i] = tl_pack_place_in(cli->frame, exact);
        }
    }
    return true;
}

static bool prune_with(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, tl_bake *bake,
                       tl_vec3 *seeds, tl_exit *exit_out)
{
    const tl_mesh_view mesh = tl_mesh_as_view(&level->mesh);
    tl_nav_prune_def def = tl_default_nav_prune_def();
    def.seeds = seeds;
    def.seed_count = settings->seeds.count;
    def.solids = settings->drop_inside ? &mesh : NULL;
    def.min_area = (double)settings->min_island_area;
    def.host = cli->host;
    if (def.seed_count > 0 && bake->offmesh != NULL && !seed_linked_islands(cli, level, bake, &def, seeds, exit_out)) {
        return false;
    }
    tl_result result = tl_pack_pruning_encode(&def, NULL, &bake->pruning, &bake->pruned.base);
    if (result == TL_OK) {
        result = tl_nav_prune(&def, &bake->tiles, &bake->removed, &bake->pruned);
    }
    return result == TL_OK || fail_prune(cli, level, settings, &def, result, &bake->pruned.base, exit_out);
}

static bool prune_nav(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, tl_bake *bake,
                      tl_exit *exit_out)
{
    const bool asked = settings->seeds.count > 0 || settings->drop_inside || settings->min_island_area > 0.0f;
    const size_t room = settings->seeds.count + (bake->offmesh != NULL ? 2 * (size_t)bake->offmesh->count : 0);
    tl_vec3 *seeds = malloc((room + 1) * sizeof *seeds);
    bool ok = seeds != NULL;
    if (!ok) {
        *exit_out = tl_cli_fail(cli, TL_EXIT_MEMORY, "%s: out of memory", level->path);
    }
    ok = ok && take_seeds(cli, settings, seeds, exit_out) &&
         (!asked || bake->tiles.tile_count == 0 || prune_with(cli, level, settings, bake, seeds, exit_out));
    free(seeds);
    return ok;
}

// The areas of triangles as the file keeps them: by the source's numbers, those that were dropped as the default.
static tl_result keep_triangle_areas(const tl_level *level, const tl_level_areas *areas, tl_bake *bake)
{
    if (areas->of_triangle == NULL) {
        return TL_OK;
    }
    const uint32_t count = level->imported.triangle_count;
    uint8_t *of_source = malloc((size_t)count + 1);
    if (of_source == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(of_source, TL_NAV_WALKABLE_AREA, count);
    for (uint32_t i = 0; i < level->mesh.triangle_count; i++) {
        of_source[level->mesh.source_triangles[i]] = areas->of_triangle[i];
    }
    const tl_result result =
        tl_pack_areas_encode(of_source, count, NULL, &bake->triangle_areas, &bake->nav_report.base);
    free(of_source);
    return result;
}

tl_nav_def tl_bake_begin_nav(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings)
{
    const tl_mesh_view mesh = tl_mesh_as_view(&level->mesh);
    // Told before the bake: a level that is too large takes long.
    const tl_level_doubt doubt = tl_level_doubt_find(&mesh, level->mesh.bounds, settings);
    if (doubt.cause != NULL) {
        tl_cli_warn(cli, "%s: %s", level->path, doubt.text);
    }
    tl_nav_def def = tl_bake_nav_def(settings);
    enter_bounds(cli, settings, &def);
    def.host = cli->host;
    return def;
}

static bool bake_nav(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, tl_bake *bake,
                     tl_exit *exit_out)
{
    tl_level_areas areas;
    if (!tl_level_areas_make(cli, level, &settings->areas, &areas, exit_out)) {
        tl_level_areas_free(&areas);
        return false;
    }
    const tl_mesh_view mesh = tl_mesh_as_view(&level->mesh);
    const tl_nav_input input = tl_level_areas_input(&areas, &mesh);
    bake->nav_def = tl_bake_begin_nav(cli, level, settings);
    bake->nav_bounds = tl_aabb_is_empty(bake->nav_def.bounds) ? level->mesh.bounds : bake->nav_def.bounds;
    tl_result result = tl_nav_bake(&bake->nav_def, &input, &bake->tiles, &bake->nav_report);
    if (result == TL_OK && input.volume_count > 0) {
        result = tl_pack_volumes_encode(input.volumes, input.volume_count, NULL, &bake->marks, &bake->nav_report.base);
    }
    if (result == TL_OK) {
        result = keep_triangle_areas(level, &areas, bake);
    }
    tl_level_areas_free(&areas);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, level->path, result, &bake->nav_report.base);
        return false;
    }
    if (!tl_hand_links_make(cli, &settings->hand_links, &bake->offmesh, exit_out) ||
        !prune_nav(cli, level, settings, bake, exit_out)) {
        return false;
    }
    bake->walkable = bake->tiles.tile_count > 0;
    for (uint32_t i = 0; i < bake->tiles.tile_count; ++i) {
        bake->nav_area += bake->tiles.tiles[i]->area;
        bake->nav_polygons += bake->tiles.tiles[i]->polygon_count;
        tl_area_sums_add(&bake->areas, bake->tiles.tiles[i]);
    }
    return true;
}

bool tl_bake_assemble_navmesh(tl_cli *cli, const char *path, const tl_bake *bake, tl_navmesh **navmesh_out,
                              tl_exit *exit_out)
{
    tl_report report;
    memset(&report, 0, sizeof(report));
    tl_result result = tl_navmesh_create(NULL, navmesh_out);
    if (result == TL_OK) {
        result = tl_navmesh_add_tiles(*navmesh_out, bake->tiles.tiles, bake->tiles.tile_count, TL_NAV_TILE_BORROWED,
                                      &report);
    }
    if (result == TL_OK) {
        result = tl_hand_links_add(bake->offmesh, *navmesh_out, &report);
    }
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, path, result, &report);
    }
    return result == TL_OK;
}

// Says which links set by hand are of no use.
static bool look_at_hand_links(tl_cli *cli, const tl_level *level, const tl_bake *bake, tl_exit *exit_out)
{
    tl_navmesh *navmesh = NULL;
    const bool ok = tl_bake_assemble_navmesh(cli, level->path, bake, &navmesh, exit_out);
    if (ok) {
        tl_hand_links_warn(cli, level->path, navmesh);
    }
    tl_navmesh_destroy(navmesh);
    return ok;
}

static bool bake_links(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, tl_bake *bake,
                       tl_exit *exit_out)
{
    tl_navmesh *navmesh;
    const bool ok = tl_bake_assemble_navmesh(cli, level->path, bake, &navmesh, exit_out) &&
                    tl_level_links_find(cli, &settings->links_def, navmesh, bake->soup, &bake->links, exit_out);
    tl_navmesh_destroy(navmesh);
    return ok;
}

bool tl_bake_level(tl_cli *cli, const tl_level *level, const tl_bake_settings *settings, tl_bake *bake_out,
                   tl_exit *exit_out)
{
    memset(bake_out, 0, sizeof(*bake_out));
    return (!settings->soup || bake_soup(cli, level, settings, bake_out, exit_out)) &&
           (!settings->hull || bake_hull(cli, level, bake_out, exit_out)) &&
           (!settings->nav || bake_nav(cli, level, settings, bake_out, exit_out)) &&
           (bake_out->offmesh == NULL || !bake_out->walkable || look_at_hand_links(cli, level, bake_out, exit_out)) &&
           (!settings->links || !settings->soup || !bake_out->walkable ||
            bake_links(cli, level, settings, bake_out, exit_out));
}

void tl_bake_free(tl_bake *bake)
{
    tl_blob_free(bake->soup);
    tl_blob_free(bake->hull);
    tl_blob_free(bake->links.links);
    tl_blob_free(bake->marks);
    tl_blob_free(bake->triangle_areas);
    tl_blob_free(bake->offmesh);
    tl_blob_free(bake->pruning);
    tl_nav_tiles_free(&bake->removed);
    tl_nav_tiles_free(&bake->tiles);
    memset(bake, 0, sizeof(*bake));
}
