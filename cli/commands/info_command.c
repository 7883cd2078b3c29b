// SPDX-License-Identifier: MIT
//
// talus info: what a baked file, or a mesh file, holds.

#include "cli/level/open_input.h"
#include "cli/level/polygonize_compare.h"
#include "cli/shared/json_out.h"
#include "cli/shared/table.h"
#include "cli/shared/text_buffer.h"

#include <stdio.h>
#include <string.h>

// In the level's own coordinates.
static void print_bounds(const tl_pack_frame *frame, tl_aabb b)
{
    const tl_pack_axes axes = frame != NULL ? (tl_pack_axes)frame->axes : TL_PACK_AXES_Y_UP;
    const tl_vec3 low = tl_pack_turn_out(axes, b.min), high = tl_pack_turn_out(axes, b.max);
    const tl_vec3 size = tl_sub(tl_max(low, high), tl_min(low, high));
    tl_text text;
    memset(&text, 0, sizeof(text));
    text.frame = frame;
    tl_text_add_point(&text, tl_pack_turn_in(axes, tl_min(low, high)), ',');
    tl_text_add(&text, " to ");
    tl_text_add_point(&text, tl_pack_turn_in(axes, tl_max(low, high)), ',');
    printf("bounds     %.*s (%.4g x %.4g x %.4g m)\n", (int)text.size, text.bytes, (double)size.x, (double)size.y,
           (double)size.z);
    tl_text_free(&text);
}

// ---------------------------------------------------------------------------------------------------------
// Baked files.

// The sums of all tiles.
typedef struct nav_sums {
    uint32_t tiles;
    uint64_t polygons, vertices, detail_triangles, bytes;
    double area;
    tl_area_sums areas;
    const tl_nav_tile *first;
} nav_sums;

static tl_result sum_tiles(const tl_pack *pack, nav_sums *sums_out, tl_report *report)
{
    memset(sums_out, 0, sizeof(*sums_out));
    for (uint32_t i = 0; i < pack->chunk_count; ++i) {
        tl_pack_chunk chunk = tl_pack_chunk_at(pack, i);
        if (chunk.type != TL_PACK_NAVT) {
            continue;
        }
        tl_result result = tl_nav_tile_check(chunk.bytes, chunk.size, report);
        if (result != TL_OK) {
            return result;
        }
        const tl_nav_tile *tile = chunk.bytes;
        sums_out->first = sums_out->first != NULL ? sums_out->first : tile;
        sums_out->tiles++;
        sums_out->polygons += tile->polygon_count;
        sums_out->vertices += tile->vertex_count;
        sums_out->detail_triangles += tile->detail_triangle_count;
        sums_out->bytes += chunk.size;
        sums_out->area += tile->area;
        tl_area_sums_add(&sums_out->areas, tile);
    }
    return TL_OK;
}

typedef struct baked_info {
    const tl_pack_meta *meta;
    const tl_pack_frame *frame; // NULL: the level's coordinates are those that were baked
    const tl_soup *soup;
    const tl_hull *hull;
    const tl_pack_navmesh *navmesh;
    const tl_nav_links *links;
    nav_sums nav;
} baked_info;

// A missing part is no failure, a damaged one is.
static bool take_checked_chunk(tl_cli *cli, const tl_input *input, uint32_t type,
                               tl_result (*check)(const void *, uint64_t, tl_report *), const void **chunk_out,
                               tl_exit *exit_out)
{
    tl_result result;
    *chunk_out = tl_input_checked_chunk(input, type, check, &result);
    if (result != TL_OK && result != TL_NOT_FOUND) {
        *exit_out = tl_cli_fail_result(cli, input->path, result, NULL);
        return false;
    }
    return true;
}

static bool collect_baked_info(tl_cli *cli, const tl_input *input, baked_info *info_out, tl_exit *exit_out)
{
    const void *chunk[5];
    memset(info_out, 0, sizeof(*info_out));
    if (!take_checked_chunk(cli, input, TL_PACK_META, tl_pack_meta_check, &chunk[0], exit_out) ||
        !take_checked_chunk(cli, input, TL_PACK_SOUP, tl_soup_check, &chunk[1], exit_out) ||
        !take_checked_chunk(cli, input, TL_PACK_HULL, tl_hull_check, &chunk[2], exit_out) ||
        !take_checked_chunk(cli, input, TL_PACK_NAVM, tl_pack_navmesh_check, &chunk[3], exit_out) ||
        !take_checked_chunk(cli, input, TL_PACK_LINK, tl_nav_links_check, &chunk[4], exit_out)) {
        return false;
    }
    info_out->meta = chunk[0];
    info_out->frame = cli->frame;
    info_out->soup = chunk[1];
    info_out->hull = chunk[2];
    info_out->navmesh = chunk[3];
    info_out->links = chunk[4];
    tl_report report;
    memset(&report, 0, sizeof(report));
    report.element_index = TL_NO_ELEMENT;
    tl_result result = sum_tiles(&input->pack, &info_out->nav, &report);
    if (result != TL_OK) {
        *exit_out = tl_cli_fail_result(cli, input->path, result, &report);
    }
    return result == TL_OK;
}

static const char *partition_word(uint32_t partition)
{
    static const char *const words[] = { "watershed", "monotone", "layers" };
    return partition < 3 ? words[partition] : "unknown";
}

static const char *polygons_word(uint32_t method)
{
    return method <= TL_PARTITION_DELAUNAY ? tl_partition_method_names[method] : "unknown";
}

static void print_navmesh(const baked_info *info)
{
    const tl_pack_navmesh *n = info->navmesh;
    if (info->nav.tiles == 0) {
        printf("navmesh    empty: nothing is walkable for this agent\n");
    } else {
        printf("navmesh    %llu polygons, %llu vertices, %llu detail triangles, %.1f m2, %u tiles\n",
               (unsigned long long)info->nav.polygons, (unsigned long long)info->nav.vertices,
               (unsigned long long)info->nav.detail_triangles, info->nav.area, info->nav.tiles);
        tl_area_sums_print(&info->nav.areas);
    }
    printf("agent      height %g m, radius %g m, climbs %g m, slopes up to %g degrees\n", (double)n->agent_height,
           (double)n->agent_radius, (double)n->agent_max_climb, (double)n->agent_max_slope);
    printf("cells      %g m, %g m high, %s, %s polygons", (double)n->cell_size, (double)n->cell_height,
           partition_word(n->partition), polygons_word(n->polygon_method));
    if (n->tile_size > 0) {
        printf(", tiles of %u cells in a grid of %u x %u", n->tile_size, n->tiles_x, n->tiles_z);
    }
    if (n->tile_height > 0.0f) {
        printf(", in layers of %g m", (double)n->tile_height);
    }
    printf("\n");
}

static void print_soup(const tl_soup *soup)
{
    tl_soup_stats s = tl_soup_get_stats(soup);
    double triangles = s.triangle_count;
    printf("soup       %u triangles, %.1f%% paired, %.1f bytes a triangle%s\n", s.triangle_count,
           200.0 * s.pair_count / (triangles - s.coincident_count), (double)s.size / triangles,
           s.layout == TL_SOUP_COMPACT ? ", compact" : "");
    if (s.coincident_count > 0) {
        printf("           %u of them lie on another one, corner by corner\n", s.coincident_count);
    }
    printf("           %u nodes, %u leaves, %u deep\n", s.node_count, s.leaf_count, s.depth);
}

static void chunk_type_text(uint32_t type, char name[5])
{
    for (unsigned i = 0; i < 4; ++i) {
        char c = (char)(type >> (8 * i) & 0xff);
        name[i] = c >= ' ' && c <= '~' ? c : '?';
    }
    name[4] = '\0';
}

// Tiles are summed in one row: a city has thousands.
static void print_chunks(const tl_input *input, const nav_sums *nav)
{
    tl_table table;
    memset(&table, 0, sizeof(table));
    tl_table_row(&table);
    tl_table_text(&table, "chunk");
    tl_table_text(&table, "number");
    tl_table_text(&table, "bytes");
    for (uint32_t i = 0; i < input->pack.chunk_count && table.row_count < TL_TABLE_ROWS - 2; ++i) {
        tl_pack_chunk chunk = tl_pack_chunk_at(&input->pack, i);
        char name[5];
        chunk_type_text(chunk.type, name);
        if (chunk.type != TL_PACK_NAVT) {
            tl_table_row(&table);
            tl_table_text(&table, name);
            tl_table_count(&table, 1);
            tl_table_bytes(&table, chunk.size);
        }
    }
    if (nav->tiles > 0) {
        tl_table_row(&table);
        tl_table_text(&table, "NAVT");
        tl_table_count(&table, nav->tiles);
        tl_table_bytes(&table, nav->bytes);
    }
    printf("\n");
    tl_table_print(&table);
}

static void print_baked(const tl_input *input, const baked_info *info)
{
    printf("%s: baked file, version %u, %llu bytes\n", input->path, TL_PACK_VERSION,
           (unsigned long long)input->pack.size);
    if (info->meta != NULL) {
        printf("source     %s, %llu triangles, %llu vertices\n", tl_pack_meta_name(info->meta),
               (unsigned long long)info->meta->source_triangles, (unsigned long long)info->meta->source_vertices);
        print_bounds(info->frame, info->meta->bounds);
        if (info->frame != NULL) {
            const double *o = info->frame->origin;
            printf("points     as in the level: %s up, 0,0,0 inside is %.15g,%.15g,%.15g\n",
                   tl_level_axes_name((tl_pack_axes)info->frame->axes), o[0], o[1], o[2]);
        }
    }
    if (info->soup != NULL) {
        print_soup(info->soup);
    }
    if (info->hull != NULL) {
        printf("hull       %u vertices, %u faces, volume %.9g m3\n", info->hull->vertex_count, info->hull->face_count,
               info->hull->mass.volume);
    }
    if (info->navmesh != NULL) {
        print_navmesh(info);
    }
    if (info->links != NULL) {
        printf("links      %u drops, %u jumps, %u climbs\n", info->links->kind_counts[TL_NAV_LINK_DROP],
               info->links->kind_counts[TL_NAV_LINK_JUMP], info->links->kind_counts[TL_NAV_LINK_CLIMB]);
    }
    print_chunks(input, &info->nav);
}

static json_t *soup_json(const tl_pack_frame *frame, const tl_soup *soup)
{
    tl_soup_stats s = tl_soup_get_stats(soup);
    const double share = 2.0 * s.pair_count / ((double)s.triangle_count - s.coincident_count);
    return json_pack("{ss sI sI sI sI so so sI sI sI sI so}", "layout",
                     s.layout == TL_SOUP_COMPACT ? "compact" : "fast", "triangles", (json_int_t)s.triangle_count,
                     "pairs", (json_int_t)s.pair_count, "singles", (json_int_t)s.single_count, "coincident",
                     (json_int_t)s.coincident_count, "paired_share", tl_json_double(share), "bytes_a_triangle",
                     tl_json_double((double)s.size / (double)s.triangle_count), "bytes", (json_int_t)s.size, "nodes",
                     (json_int_t)s.node_count, "leaves", (json_int_t)s.leaf_count, "depth", (json_int_t)s.depth,
                     "bounds", tl_json_placed_bounds(frame, tl_soup_bounds(soup)));
}

static json_t *navmesh_json(const baked_info *info)
{
    const tl_pack_navmesh *n = info->navmesh;
    json_t *object = json_pack("{sI sI sI sI so sI}", "tiles", (json_int_t)info->nav.tiles, "polygons",
                               (json_int_t)info->nav.polygons, "vertices", (json_int_t)info->nav.vertices,
                               "detail_triangles", (json_int_t)info->nav.detail_triangles, "area",
                               tl_json_double(info->nav.area), "bytes", (json_int_t)info->nav.bytes);
    json_object_set_new(
        object, "settings",
        json_pack("{so so so so so so so ss ss sI so sI}", "cell_size", tl_json_float(n->cell_size), "cell_height",
                  tl_json_float(n->cell_height), "agent_height", tl_json_float(n->agent_height), "agent_radius",
                  tl_json_float(n->agent_radius), "agent_max_climb", tl_json_float(n->agent_max_climb),
                  "agent_max_slope", tl_json_float(n->agent_max_slope), "edge_max_error",
                  tl_json_float(n->edge_max_error), "partition", partition_word(n->partition), "polygon_method",
                  polygons_word(n->polygon_method), "tile_size", (json_int_t)n->tile_size, "tile_height",
                  tl_json_float(n->tile_height), "max_verts_per_poly", (json_int_t)n->max_verts_per_poly));
    json_object_set_new(object, "areas", tl_area_sums_json(&info->nav.areas));
    return object;
}

static json_t *baked_json(const tl_input *input, const baked_info *info)
{
    json_t *object = json_pack("{so ss sI sI}", "file", tl_json_text(input->path), "kind", "baked", "version",
                               (json_int_t)TL_PACK_VERSION, "bytes", (json_int_t)input->pack.size);
    json_t *chunks = json_array();
    for (uint32_t i = 0; i < input->pack.chunk_count; ++i) {
        tl_pack_chunk chunk = tl_pack_chunk_at(&input->pack, i);
        char name[5];
        chunk_type_text(chunk.type, name);
        json_array_append_new(
            chunks, json_pack("{ss sI sI}", "type", name, "id", (json_int_t)chunk.id, "bytes", (json_int_t)chunk.size));
    }
    json_object_set_new(object, "chunks", chunks);
    if (info->meta != NULL) {
        json_object_set_new(object, "source",
                            json_pack("{so sI sI}", "name", tl_json_text(tl_pack_meta_name(info->meta)), "triangles",
                                      (json_int_t)info->meta->source_triangles, "vertices",
                                      (json_int_t)info->meta->source_vertices));
        json_object_set_new(object, "bounds", tl_json_placed_bounds(info->frame, info->meta->bounds));
    }
    if (info->frame != NULL) {
        const double *o = info->frame->origin;
        json_object_set_new(object, "origin", json_pack("[fff]", o[0], o[1], o[2]));
        json_object_set_new(object, "up", json_string(tl_level_axes_name((tl_pack_axes)info->frame->axes)));
    }
    if (info->soup != NULL) {
        json_object_set_new(object, "soup", soup_json(info->frame, info->soup));
    }
    if (info->hull != NULL) {
        json_object_set_new(object, "hull",
                            json_pack("{sI sI so so}", "vertices", (json_int_t)info->hull->vertex_count, "faces",
                                      (json_int_t)info->hull->face_count, "volume",
                                      tl_json_double(info->hull->mass.volume), "bounds",
                                      tl_json_placed_bounds(info->frame, info->hull->bounds)));
    }
    if (info->navmesh != NULL) {
        json_object_set_new(object, "navmesh", navmesh_json(info));
    }
    if (info->links != NULL) {
        json_t *links = json_object();
        for (int kind = 0; kind < TL_NAV_LINK_KINDS; ++kind) {
            json_object_set_new(links, tl_nav_link_kind_name((tl_nav_link_kind)kind),
                                json_integer((json_int_t)info->links->kind_counts[kind]));
        }
        json_object_set_new(object, "links", links);
    }
    return object;
}

static tl_exit info_of_baked(tl_cli *cli, const char *path)
{
    tl_input input;
    baked_info info;
    tl_exit code;
    if (tl_input_open_baked(cli, path, &input, &code) && collect_baked_info(cli, &input, &info, &code)) {
        code = TL_EXIT_OK;
        if (cli->json) {
            code = tl_cli_print_json(cli, baked_json(&input, &info));
        } else {
            print_baked(&input, &info);
        }
    }
    tl_input_close(&input);
    return code;
}

// ---------------------------------------------------------------------------------------------------------
// Mesh files.

// Square metres of all triangles, and how many are walkable by their slope for Recast's default of 45 degrees.
static double surface_area(const tl_mesh *mesh)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t *corner = mesh->indices + 3 * (size_t)i;
        tl_vec3 a = mesh->vertices[corner[0]];
        tl_vec3 ab = tl_sub(mesh->vertices[corner[1]], a);
        tl_vec3 ac = tl_sub(mesh->vertices[corner[2]], a);
        sum += 0.5 * (double)tl_length(tl_cross(ab, ac));
    }
    return sum;
}

// What --area may name; number 0 is what has no material.
static void print_materials(const tl_name_table *names)
{
    printf("materials  %u", names->count - 1);
    for (uint32_t id = 1; id < names->count; id++) {
        tl_text text = { NULL, 0, 0, false, NULL };
        tl_text_add_safe(&text, tl_name_table_get(names, id));
        printf("%s '%.*s'", id == 1 ? ":" : ",", (int)text.size, text.size > 0 ? text.bytes : "");
        tl_text_free(&text);
    }
    printf("\n");
}

static json_t *materials_json(const tl_name_table *names)
{
    json_t *array = json_array();
    for (uint32_t id = 1; id < names->count; id++) {
        json_array_append_new(array, tl_json_text(tl_name_table_get(names, id)));
    }
    return array;
}

static void print_mesh(const tl_cli *cli, const tl_level *level, const tl_adjacency *adjacency)
{
    const tl_imported_mesh *m = &level->imported;
    printf("%s: mesh, read as %s, %llu bytes\n", level->path, m->format, (unsigned long long)m->source_bytes);
    printf("faces      %u, %u of them polygons, %u triangles in all\n", m->face_count, m->polygon_count,
           m->triangle_count);
    printf("vertices   %u, %u distinct\n", m->vertex_count, level->mesh.vertex_count);
    print_materials(&m->names);
    print_bounds(cli->frame, level->mesh.bounds);
    printf("area       %.9g m2\n", surface_area(&level->mesh));
    printf("edges      %u between two triangles, %u open, %u non-manifold\n", adjacency->paired_edges,
           adjacency->border_edges, adjacency->non_manifold_edges);
    if (level->report.degenerate_triangles > 0 || level->report.duplicate_triangles > 0) {
        printf("left out   %u triangles without area, %u that repeat another\n", level->report.degenerate_triangles,
               level->report.duplicate_triangles);
    }
    bool scaled = m->file_unit > 0.0f && m->file_unit != 1.0f;
    bool turned = m->file_up != 0 && m->file_up != 2;
    if (scaled || turned) {
        static const char *const axes[] = { "-z", "-y", "-x", "?", "x", "y", "z" };
        printf("units      %g m and %s up, as the file says; given in metres, y up\n", (double)m->file_unit,
               axes[m->file_up + 3]);
    }
    if (m->isolation != TL_ISOLATION_NONE) {
        printf("isolation  read by a process of its own%s\n",
               m->isolation == TL_ISOLATION_SANDBOX ? ", in a sandbox" : "; the system refuses a sandbox");
    }
    if (m->crooked_count > 0) {
        printf("polygons   %u that could not be split properly\n", m->crooked_count);
    }
}

static json_t *mesh_json(const tl_cli *cli, const tl_level *level, const tl_adjacency *adjacency)
{
    const tl_imported_mesh *m = &level->imported;
    return json_pack(
        "{so ss ss ss sI sI sI sI sI sI sI sI sI sI sI so so so}", "file", tl_json_text(level->path), "kind", "mesh",
        "format", m->format, "isolation", tl_isolation_name(m->isolation), "bytes", (json_int_t)m->source_bytes,
        "faces", (json_int_t)m->face_count, "polygons", (json_int_t)m->polygon_count, "triangles",
        (json_int_t)m->triangle_count, "vertices", (json_int_t)m->vertex_count, "distinct_vertices",
        (json_int_t)level->mesh.vertex_count, "materials", (json_int_t)m->names.count - 1, "degenerate_triangles",
        (json_int_t)level->report.degenerate_triangles, "duplicate_triangles",
        (json_int_t)level->report.duplicate_triangles, "paired_edges", (json_int_t)adjacency->paired_edges,
        "open_edges", (json_int_t)adjacency->border_edges, "material_names", materials_json(&m->names), "area",
        tl_json_double(surface_area(&level->mesh)), "bounds", tl_json_placed_bounds(cli->frame, level->mesh.bounds));
}

static tl_exit info_of_mesh(tl_cli *cli, const char *path, const tl_level_settings *settings)
{
    tl_level level;
    tl_exit code;
    if (tl_level_load(cli, path, settings, &level, &code)) {
        tl_adjacency adjacency;
        tl_mesh_view view = tl_mesh_as_view(&level.mesh);
        tl_result result = tl_adjacency_bake(&view, &cli->host, &adjacency, NULL);
        tl_progress_end(&cli->progress);
        if (result != TL_OK) {
            code = tl_cli_fail_result(cli, path, result, NULL);
        } else if (cli->json) {
            code = tl_cli_print_json(cli, mesh_json(cli, &level, &adjacency));
        } else {
            print_mesh(cli, &level, &adjacency);
            code = TL_EXIT_OK;
        }
        tl_adjacency_free(&adjacency);
    }
    tl_level_free(&level);
    return code;
}

static tl_exit run_info(tl_cli *cli)
{
    tl_bake_settings settings = tl_default_bake_settings();
    cli->speaks_frame = true;
    tl_exit code;
    if (!tl_input_parse(cli, NULL, TL_INPUT_LEVEL, &settings, 1, 1, &code)) {
        return code;
    }
    const char *path = cli->arguments.words[0];
    return tl_input_is_baked(path) ? info_of_baked(cli, path) : info_of_mesh(cli, path, &settings.level);
}

const tl_command tl_info_command = {
    "info",
    "Levels",
    "print what a baked file or a mesh file holds",
    "FILE [options]",
    "Prints counts, sizes, bounds and settings of a baked file, or the counts of a mesh file.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus info courtyard.talus\n"
    "talus info courtyard.obj --json",
    run_info,
};
