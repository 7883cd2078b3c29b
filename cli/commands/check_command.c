// SPDX-License-Identifier: MIT
//
// talus check: proves a baked file right, or names each fault; tells what is odd about a mesh file.

#include "cli/level/level_doubt.h"
#include "cli/level/open_input.h"
#include "cli/shared/json_out.h"
#include "world/job/world_reader.h"

#include <talus/nav_routes.h>
#include <talus/polygon.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// What was found, as text or JSON.
typedef struct findings {
    tl_cli *cli;
    json_t *list; // NULL without --json
    uint32_t faults;
    bool empty; // there is a navmesh, and nothing in it
} findings;

static void add_finding(findings *f, const char *part, const char *element, uint64_t index, const char *fault)
{
    f->faults++;
    if (f->list != NULL) {
        json_t *object = json_pack("{ss ss}", "part", part, "fault", fault);
        if (element != NULL) {
            json_object_set_new(object, "element", json_string(element));
        }
        if (element != NULL && index != TL_NO_ELEMENT) {
            json_object_set_new(object, "index", json_integer((json_int_t)index));
        }
        json_array_append_new(f->list, object);
    } else if (element != NULL && index != TL_NO_ELEMENT) {
        printf("fault  %s: %s %llu: %s\n", part, element, (unsigned long long)index, fault);
    } else {
        printf("fault  %s: %s%s%s\n", part, element != NULL ? element : "", element != NULL ? ": " : "", fault);
    }
}

static void add_failed(findings *f, const char *part, tl_result result, const tl_report *report)
{
    if (result != TL_OK) {
        add_finding(f, part, report != NULL ? report->element : NULL,
                    report != NULL ? report->element_index : TL_NO_ELEMENT, tl_result_text(result));
    }
}

static void say_ok(const findings *f, const char *part, uint64_t bytes)
{
    if (f->list == NULL) {
        printf("ok     %s, %llu bytes\n", part, (unsigned long long)bytes);
    }
}

static bool is_out_of_memory(findings *f, tl_result result, tl_exit *exit_out)
{
    if (result == TL_ERR_MEMORY) {
        *exit_out = tl_cli_fail(f->cli, TL_EXIT_MEMORY, "out of memory");
    }
    return result == TL_ERR_MEMORY;
}

// ---------------------------------------------------------------------------------------------------------
// Polygons of a tile, in the validator's form.

// Every polygon counts as a contour of its own: a tile does not say which contour it came from, and floors that lie
// over one another must not be taken for overlaps.
typedef struct tile_polygons {
    tl_polygon_mesh mesh;
    void *block;
} tile_polygons;

static bool make_polygons(const tl_nav_tile *tile, tile_polygons *out)
{
    size_t polygons = tile->polygon_count;
    memset(out, 0, sizeof(*out));
    const size_t corners = tile->corner_count, coordinates = 3 * (size_t)tile->vertex_count;
    uint32_t *word = calloc(2 * corners + 4 * polygons + 1 + coordinates, sizeof(uint32_t));
    out->block = word;
    if (word == NULL) {
        return false;
    }
    tl_polygon_mesh *m = &out->mesh;
    m->vertex_count = tile->vertex_count;
    m->polygon_count = tile->polygon_count;
    m->index_count = tile->corner_count;
    m->first = word;
    m->neighbours = m->first + polygons + 1;
    m->regions = m->neighbours + corners;
    m->areas = m->regions + polygons;
    m->contours = m->areas + polygons;
    m->indices = m->contours + polygons;
    m->vertices = (int32_t *)(m->indices + corners);
    for (uint32_t p = 0; p <= tile->polygon_count; ++p) {
        m->first[p] = tl_nav_tile_first_corner(tile, p);
    }
    for (uint32_t k = 0; k < tile->corner_count; ++k) {
        m->indices[k] = tl_nav_tile_corner_vertex(tile, k);
    }
    for (uint32_t v = 0; v < tile->vertex_count; ++v) {
        const tl_nav_lattice_point point = tl_nav_tile_vertex(tile, v);
        memcpy(m->vertices + 3 * (size_t)v, point.at, sizeof point.at);
    }
    m->cell_size = tile->cell_size;
    m->cell_height = tile->cell_height;
    m->max_verts_per_poly = TL_NAV_MAX_CORNERS;
    for (uint32_t p = 0; p < tile->polygon_count; ++p) {
        m->areas[p] = tl_nav_tile_area(tile, p);
        m->contours[p] = p;
        for (uint32_t k = m->first[p]; k < m->first[p + 1]; ++k) {
            const uint32_t across = tl_nav_tile_neighbour(tile, p, k - m->first[p]);
            // Beyond a cut lies another layer: here it is a wall.
            m->neighbours[k] = across == (TL_PORTAL | TL_NAV_SIDE_CUT) ? TL_NO_POLYGON : across;
        }
    }
    return true;
}

static tl_result check_tile_polygons(findings *f, const char *part, const tl_nav_tile *tile)
{
    tile_polygons polygons;
    tl_polygon_check_report report;
    memset(&report, 0, sizeof(report));
    if (!make_polygons(tile, &polygons)) {
        return TL_ERR_MEMORY;
    }
    tl_result result = tl_polygon_mesh_check(&polygons.mesh, NULL, NULL, &report);
    if (result != TL_OK && result != TL_ERR_MEMORY) {
        add_finding(f, part, report.base.element, report.base.element_index, tl_polygon_fault_text(report.first_fault));
    }
    free(polygons.block);
    return result == TL_ERR_MEMORY ? result : TL_OK;
}

// ---------------------------------------------------------------------------------------------------------

static tl_result check_tile(findings *f, const char *part, tl_pack_chunk chunk)
{
    tl_report report;
    memset(&report, 0, sizeof(report));
    report.element_index = TL_NO_ELEMENT;
    tl_result result = tl_nav_tile_check(chunk.bytes, chunk.size, &report);
    if (result != TL_OK) {
        add_failed(f, part, result, &report);
        return TL_OK;
    }
    return check_tile_polygons(f, part, chunk.bytes);
}

static void check_hull(findings *f, const char *part, tl_pack_chunk chunk)
{
    tl_report report;
    tl_result result = tl_hull_check(chunk.bytes, chunk.size, &report);
    if (result == TL_OK) {
        tl_hull_validation validation;
        result = tl_hull_validate(chunk.bytes, NULL, 0, &validation);
        report = validation.base;
    }
    add_failed(f, part, result, &report);
}

static tl_result check_chunk(findings *f, tl_pack_chunk chunk)
{
    char part[32];
    snprintf(part, sizeof(part), "%c%c%c%c %u", (int)(chunk.type & 0x7f), (int)(chunk.type >> 8 & 0x7f),
             (int)(chunk.type >> 16 & 0x7f), (int)(chunk.type >> 24 & 0x7f), chunk.id);
    uint32_t faults = f->faults;
    tl_result memory = TL_OK;
    tl_report report;
    switch (chunk.type) {
    case TL_PACK_META:
        add_failed(f, part, tl_pack_meta_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_SOUP:
        add_failed(f, part, tl_soup_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_HULL:
        check_hull(f, part, chunk);
        break;
    case TL_PACK_NAVM:
        add_failed(f, part, tl_pack_navmesh_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_NAVT:
    case TL_PACK_PRUT:
        memory = check_tile(f, part, chunk);
        break;
    case TL_PACK_LINK:
        add_failed(f, part, tl_nav_links_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_MARK:
        add_failed(f, part, tl_pack_volumes_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_OFFM:
        add_failed(f, part, tl_pack_offmesh_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_AREA:
        add_failed(f, part, tl_pack_areas_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_FRAM:
        add_failed(f, part, tl_pack_frame_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_PRUN:
        add_failed(f, part, tl_pack_pruning_check(chunk.bytes, chunk.size, &report), &report);
        break;
    case TL_PACK_ROUT:
        add_failed(f, part, tl_nav_routes_check(chunk.bytes, chunk.size, &report), &report);
        break;
    default: // a later version may have more kinds; their bytes are covered by the file's hashes
        break;
    }
    if (f->faults == faults) {
        say_ok(f, part, chunk.size);
    }
    return memory;
}

// Tiles must also fit one another.
static tl_result check_navmesh(findings *f, const tl_pack *pack)
{
    tl_navmesh *navmesh;
    tl_report report;
    memset(&report, 0, sizeof(report));
    report.element_index = TL_NO_ELEMENT;
    tl_result result = tl_pack_load_navmesh(pack, NULL, &navmesh, &report);
    if (result == TL_NOT_FOUND) {
        return TL_OK;
    }
    if (result != TL_OK) {
        add_failed(f, "navmesh", result, &report);
        return result == TL_ERR_MEMORY ? result : TL_OK;
    }
    f->empty = tl_navmesh_tile_count(navmesh) == 0;
    if (f->list == NULL && f->empty) {
        printf("note   navmesh: empty, nothing is walkable\n");
    } else if (f->list == NULL) {
        printf("ok     navmesh: %u tiles fit, %llu links\n", tl_navmesh_tile_count(navmesh),
               (unsigned long long)tl_navmesh_link_count(navmesh));
    }
    tl_navmesh_destroy(navmesh);
    return TL_OK;
}

// Routes must be those of the file's tiles.
static tl_result check_routes(findings *f, const char *path, const tl_pack *pack)
{
    tl_pack_chunk chunk = { 0 };
    for (uint32_t i = 0; i < pack->chunk_count && chunk.type != TL_PACK_ROUT; i++) {
        chunk = tl_pack_chunk_at(pack, i);
    }
    tl_world_reader reader;
    if (chunk.type != TL_PACK_ROUT || tl_world_reader_open(path, &reader, NULL) != TL_OK) {
        return TL_OK;
    }
    tl_report report;
    tl_result result = tl_world_reader_index(&reader, NULL);
    if (result == TL_OK && tl_nav_routes_check_tiles(chunk.bytes, &reader.index, &report) != TL_OK) {
        add_finding(f, "routes", NULL, TL_NO_ELEMENT, "of other tiles: run 'talus world routes' again");
    }
    tl_world_reader_close(&reader);
    return result == TL_ERR_MEMORY ? result : TL_OK; // the pack was opened: its index is sound
}

static tl_exit check_baked(findings *f, const char *path)
{
    tl_file_map map;
    tl_io_error error;
    memset(&error, 0, sizeof(error));
    if (tl_file_read(path, 0, &map, &error) != TL_OK) {
        return tl_cli_fail_io(f->cli, &error);
    }
    tl_exit code = TL_EXIT_OK;
    tl_pack pack;
    tl_report report;
    memset(&report, 0, sizeof(report));
    report.element_index = TL_NO_ELEMENT;
    tl_result result = tl_file_open_pack(&map, &pack, &report);
    add_failed(f, "file", result, &report);
    if (result == TL_OK) {
        say_ok(f, "file", map.size);
    }
    for (uint32_t i = 0; result == TL_OK && i < pack.chunk_count; ++i) {
        result = check_chunk(f, tl_pack_chunk_at(&pack, i));
    }
    if (result == TL_OK && f->faults == 0) {
        result = check_navmesh(f, &pack);
    }
    if (result == TL_OK && f->faults == 0) {
        result = check_routes(f, path, &pack);
    }
    is_out_of_memory(f, result, &code);
    tl_file_map_close(&map);
    return code;
}

// ---------------------------------------------------------------------------------------------------------
// Mesh files: bakes take what is listed here, so it is no fault, but it is often not what was meant.

static void add_note(findings *f, uint64_t count, const char *what)
{
    if (count == 0) {
        return;
    }
    if (f->list != NULL) {
        json_array_append_new(f->list, json_pack("{sI ss}", "count", (json_int_t)count, "note", what));
    } else {
        printf("note   %llu %s\n", (unsigned long long)count, what);
    }
}

static tl_exit check_mesh_file(findings *f, const char *path, const tl_bake_settings *settings)
{
    tl_level level;
    tl_exit code;
    if (tl_level_load(f->cli, path, &settings->level, &level, &code)) {
        tl_adjacency adjacency;
        tl_mesh_view view = tl_mesh_as_view(&level.mesh);
        tl_result result = tl_adjacency_bake(&view, &f->cli->host, &adjacency, NULL);
        tl_progress_end(&f->cli->progress);
        code = TL_EXIT_OK;
        if (!is_out_of_memory(f, result, &code)) {
            add_note(f, level.report.degenerate_triangles, "triangles without area, left out");
            add_note(f, level.report.duplicate_triangles, "triangles that repeat another, left out");
            add_note(f, level.imported.crooked_count, "polygons that cross themselves, cut as fans");
            add_note(f, level.imported.skipped_lines, "lines of an unknown keyword, skipped");
            add_note(f, adjacency.border_edges, "open edges: the surface is not closed there");
            add_note(f, adjacency.non_manifold_edges,
                     "edges of more than two triangles, or of two that face differently");
            const tl_level_doubt doubt = tl_level_doubt_find(&view, level.mesh.bounds, settings);
            add_note(f, doubt.cause != NULL, doubt.text);
            if (f->list == NULL) {
                printf("ok     %u triangles\n", level.mesh.triangle_count);
            }
        }
        tl_adjacency_free(&adjacency);
    }
    tl_level_free(&level);
    return code;
}

static tl_exit run_check(tl_cli *cli)
{
    tl_bake_settings settings = tl_default_bake_settings();
    tl_exit code;
    if (!tl_input_parse(cli, NULL, TL_INPUT_LEVEL, &settings, 1, 1, &code)) {
        return code;
    }
    const char *path = cli->arguments.words[0];
    findings f = { cli, cli->json ? json_array() : NULL, 0, false };
    bool baked = tl_input_is_baked(path);
    code = baked ? check_baked(&f, path) : check_mesh_file(&f, path, &settings);
    if (code == TL_EXIT_OK) {
        code = f.faults > 0 ? TL_EXIT_NEGATIVE : f.empty ? TL_EXIT_EMPTY : TL_EXIT_OK;
        if (cli->json) {
            json_t *object = json_pack("{so ss sb sO}", "file", tl_json_text(path), "kind", baked ? "baked" : "mesh",
                                       "ok", (int)(f.faults == 0), baked ? "faults" : "notes", f.list);
            const tl_exit printed = tl_cli_print_json(cli, object);
            code = printed == TL_EXIT_OK ? code : printed;
        } else if (baked) {
            printf(f.faults == 0 ? "%s is whole\n" : "%s is damaged; bake it again\n", path);
        }
    }
    json_decref(f.list);
    return code;
}

const tl_command tl_check_command = {
    "check",
    "Levels",
    "check a baked file and name its faults",
    "FILE [options]",
    "Checks every part of a baked file: sizes, hashes and layouts; that hulls are convex; that navmesh\n"
    "polygons are convex and simple and name each other as neighbours; that tiles fit. Prints every fault,\n"
    "and exits with 1 when there is one. Of a mesh file it prints what a bake leaves out or repairs.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus check courtyard.talus\n"
    "talus check courtyard.obj --json",
    run_check,
};
