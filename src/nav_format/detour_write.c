// SPDX-License-Identifier: MIT
//
// From our tile to Detour's. The formats are alike, so nothing is computed: shared vertices, polygons and links are
// copied, and so is the BVH, which is depth first with skips in both. Its boxes are rounded from the polygons' own.
//
// Source: the public description of the data in DetourNavMesh.h.

#include "nav_format/detour_read.h"

#include "base/assert.h"
#include "base/byte_order.h"
#include "base/host.h"
#include "nav_format/box_tree.h"
#include "nav_format/lattice_polygon.h"
#include "nav_format/triangle_fan.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Side 0 x-, 1 z+, 2 x+, 3 z- in Detour's eighths of a turn from x+.
static const uint16_t DETOUR_SIDES[4] = { 4, 2, 0, 6 };

static bool has_plain_detail(tl_nav_surface surface, uint32_t corner_count)
{
    return surface.vertex_count - corner_count > UINT8_MAX || surface.vertex_count > UINT8_MAX + 1u ||
           surface.triangle_count > UINT8_MAX;
}

static tl_result check_polygon(const tl_nav_tile *tile, uint32_t p, tl_report *report)
{
    uint32_t count;
    tl_nav_tile_corners(tile, p, &count);
    if (count > TL_DETOUR_MAX_CORNERS) {
        return tl_report_fail(report, TL_ERR_LIMIT, "polygon", p,
                              "Detour's polygons have at most 6 corners; bake with max_verts_per_poly 6");
    }
    if (tl_nav_tile_flags(tile, p) > UINT16_MAX) {
        return tl_report_fail(report, TL_ERR_LIMIT, "polygon", p, "Detour keeps the lowest 16 flags only");
    }
    if (tl_nav_tile_area(tile, p) > TL_DETOUR_MAX_AREA) {
        return tl_report_fail(report, TL_ERR_LIMIT, "polygon", p,
                              "Detour's areas are 0 to 63; give the areas above lower numbers");
    }
    return TL_OK;
}

static float position_x(const tl_nav_tile *tile, int32_t x)
{
    return tl_nav_tile_position(tile->origin.x, tile->tile_x, tile->tile_size, x, tile->cell_size);
}

static float position_z(const tl_nav_tile *tile, int32_t z)
{
    return tl_nav_tile_position(tile->origin.z, tile->tile_z, tile->tile_size, z, tile->cell_size);
}

// The box in which polygons are looked for: the whole tile, as the grid has it; of the only tile, what there is.
static void place_array(const tl_nav_tile *tile, tl_detour_header *header)
{
    bool alone = tile->tile_size == 0;
    header->min[0] = alone ? tile->bounds.min.x : position_x(tile, 0);
    header->min[1] = tile->bounds.min.y;
    header->min[2] = alone ? tile->bounds.min.z : position_z(tile, 0);
    header->max[0] = alone ? tile->bounds.max.x : position_x(tile, (int32_t)tile->tile_size);
    header->max[1] = tile->bounds.max.y;
    header->max[2] = alone ? tile->bounds.max.z : position_z(tile, (int32_t)tile->tile_size);
    header->quantization = 1.0f / tile->cell_size;
}

// --- off-mesh links -------------------------------------------------------------------------------------------------

// Tile number `index` of a set; a tile by itself is a set of one, without links.
typedef struct set_tile {
    const tl_detour_set *set;
    uint32_t index;
} set_tile;

static bool box_holds(const tl_nav_tile *tile, const tl_detour_header *box, tl_vec3 p)
{
    const bool alone = tile->tile_size == 0; // nobody adjoins its far sides
    return p.x >= box->min[0] && p.z >= box->min[2] && (p.x < box->max[0] || (alone && p.x == box->max[0])) &&
           (p.z < box->max[2] || (alone && p.z == box->max[2]));
}

static bool tile_holds(const tl_nav_tile *tile, tl_vec3 p)
{
    tl_detour_header box;
    place_array(tile, &box);
    return box_holds(tile, &box, p);
}

static float height_gap(const tl_nav_tile *tile, float y)
{
    return fmaxf(fmaxf(tile->bounds.min.y - y, y - tile->bounds.max.y), 0.0f);
}

// Whether the link stands in this tile: its start does, and in no layer that is nearer in height or comes first.
static bool owns_link(set_tile at, const tl_detour_off_mesh *link)
{
    const tl_nav_tile *tile = at.set->tiles[at.index];
    if (!tile_holds(tile, link->start)) {
        return false;
    }
    const float own = height_gap(tile, link->start.y);
    for (uint32_t i = 0; i < at.set->tile_count; i++) {
        const tl_nav_tile *other = at.set->tiles[i];
        if (i != at.index && other->tile_x == tile->tile_x && other->tile_z == tile->tile_z &&
            tile_holds(other, link->start)) {
            const float gap = height_gap(other, link->start.y);
            if (gap < own || (gap == own && i < at.index)) {
                return false;
            }
        }
    }
    return true;
}

static void count_links(set_tile at, tl_detour_header *header)
{
    const tl_nav_tile *tile = at.set->tiles[at.index];
    for (uint32_t i = 0; i < at.set->off_mesh_count; i++) {
        const tl_detour_off_mesh *link = &at.set->off_mesh[i];
        const int32_t owned = owns_link(at, link);
        header->off_mesh_count += owned;
        // Two links of Detour's for each end that is connected to a polygon of this tile.
        header->max_link_count += 2 * owned + 2 * (int32_t)box_holds(tile, header, link->end);
    }
    header->polygon_count += header->off_mesh_count;
    header->vertex_count += 2 * header->off_mesh_count;
}

// The side of the tile beyond which a point lies, in Detour's eighths of a turn from x+; 0xff: none.
static uint8_t side_of(const tl_detour_header *box, tl_vec3 p)
{
    static const uint8_t SIDES[3][3] = { { 5, 6, 7 }, { 4, 0xff, 0 }, { 3, 2, 1 } };
    const int x = p.x < box->min[0] ? 0 : p.x >= box->max[0] ? 2 : 1;
    const int z = p.z < box->min[2] ? 0 : p.z >= box->max[2] ? 2 : 1;
    return SIDES[z][x];
}

static void write_off_mesh(set_tile at, const tl_detour_header *header, const tl_detour_offsets *to, uint8_t *bytes)
{
    const tl_nav_tile *tile = at.set->tiles[at.index];
    uint32_t n = 0;
    for (uint32_t i = 0; i < at.set->off_mesh_count && n < (uint32_t)header->off_mesh_count; i++) {
        const tl_detour_off_mesh *link = &at.set->off_mesh[i];
        if (!owns_link(at, link)) {
            continue;
        }
        tl_detour_polygon polygon;
        memset(&polygon, 0, sizeof polygon);
        polygon.first_link = UINT32_MAX;
        polygon.vertices[0] = (uint16_t)(tile->vertex_count + 2 * n);
        polygon.vertices[1] = (uint16_t)(tile->vertex_count + 2 * n + 1);
        polygon.vertex_count = 2;
        polygon.flags = link->flags;
        polygon.area_and_type = (uint8_t)(link->area | TL_DETOUR_OFF_MESH << 6);
        tl_detour_connection connection = { { { link->start.x, link->start.y, link->start.z },
                                              { link->end.x, link->end.y, link->end.z } },
                                            link->radius,
                                            (uint16_t)(tile->polygon_count + n),
                                            (uint8_t)(link->both_ways ? TL_DETOUR_BOTH_WAYS : 0),
                                            side_of(header, link->end),
                                            link->user_id };
        memcpy(bytes + to->vertices + 12 * (uint64_t)(tile->vertex_count + 2 * n), connection.ends,
               sizeof connection.ends);
        memcpy(bytes + to->polygons + sizeof polygon * (uint64_t)(tile->polygon_count + n), &polygon, sizeof polygon);
        memcpy(bytes + to->off_mesh + sizeof connection * (uint64_t)n, &connection, sizeof connection);
        n++;
    }
}

static tl_result check_off_mesh(const tl_detour_set *set, tl_report *report)
{
    for (uint32_t i = 0; i < set->off_mesh_count; i++) {
        const tl_detour_off_mesh *link = &set->off_mesh[i];
        if (!tl_is_finite(link->start) || !tl_is_finite(link->end) || !isfinite(link->radius)) {
            return tl_report_fail(report, TL_ERR_NOT_FINITE, "off_mesh", i, "use finite numbers");
        }
        if (!(link->radius > 0.0f)) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "off_mesh", i, "make its radius > 0");
        }
        if (link->area > TL_DETOUR_MAX_AREA) {
            return tl_report_fail(report, TL_ERR_LIMIT, "off_mesh", i,
                                  "Detour's areas are 0 to 63; give the areas above lower numbers");
        }
    }
    return TL_OK;
}

// Those that Detour will not connect.
static void count_unconnected(const tl_detour_set *set, tl_detour_report *report)
{
    report->off_mesh_outside = set->off_mesh_count - report->off_mesh_links;
    for (uint32_t i = 0; i < set->off_mesh_count; i++) {
        const tl_detour_off_mesh *link = &set->off_mesh[i];
        const tl_nav_tile *from = NULL, *to = NULL;
        for (uint32_t k = 0; k < set->tile_count; k++) {
            from = tile_holds(set->tiles[k], link->start) ? set->tiles[k] : from;
            to = tile_holds(set->tiles[k], link->end) ? set->tiles[k] : to;
        }
        if (from != NULL) {
            const bool near = to != NULL && abs(to->tile_x - from->tile_x) <= 1 && abs(to->tile_z - from->tile_z) <= 1;
            report->off_mesh_far += !near;
        }
    }
}

// --- tiles ----------------------------------------------------------------------------------------------------------

static tl_result make_header(set_tile at, tl_detour_header *header, tl_detour_report *report)
{
    const tl_nav_tile *tile = at.set->tiles[at.index];
    if (tile->polygon_count > TL_DETOUR_MAX_POLYGONS || tile->vertex_count > TL_DETOUR_MAX_VERTICES) {
        return tl_report_fail(&report->base, TL_ERR_LIMIT, "tile", TL_NO_ELEMENT,
                              "it has more polygons or vertices than Detour counts in 16 bits; bake smaller tiles");
    }
    if (tl_nav_tile_side_first(tile, TL_NAV_SIDE_CUT) < tile->portal_count) {
        return tl_report_fail(&report->base, TL_ERR_LIMIT, "layer", tile->layer,
                              "Detour links layers of a place over edges along the axes only; bake with tile_height 0");
    }
    memset(header, 0, sizeof *header);
    header->magic = (int32_t)TL_DETOUR_TILE_MAGIC;
    header->version = TL_DETOUR_TILE_VERSION;
    header->x = tile->tile_x;
    header->y = tile->tile_z;
    header->layer = (int32_t)tile->layer;
    header->polygon_count = header->detail_mesh_count = header->off_mesh_base = (int32_t)tile->polygon_count;
    header->vertex_count = (int32_t)tile->vertex_count;
    // One link an edge, and two more for each edge on the border, which several polygons may adjoin.
    header->max_link_count = (int32_t)(tile->corner_count + 2 * tile->portal_count);
    header->node_count = (int32_t)tile->node_count;
    header->walkable_height = tile->agent_height;
    header->walkable_radius = tile->agent_radius;
    header->walkable_climb = tile->agent_max_climb;
    place_array(tile, header);
    count_links(at, header);
    if (header->polygon_count > TL_DETOUR_MAX_POLYGONS || header->vertex_count > TL_DETOUR_MAX_VERTICES) {
        return tl_report_fail(&report->base, TL_ERR_LIMIT, "tile", TL_NO_ELEMENT,
                              "with its off-mesh links it has more polygons or vertices than Detour counts in 16 bits");
    }
    float cells = fmaxf(header->max[0] - header->min[0], header->max[2] - header->min[2]) * header->quantization;
    if (!(fmaxf(cells, (header->max[1] - header->min[1]) * header->quantization) < (float)UINT16_MAX)) {
        return tl_report_fail(&report->base, TL_ERR_LIMIT, "tile", TL_NO_ELEMENT,
                              "it has more cells along a side than Detour counts in 16 bits; bake smaller tiles");
    }
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        TL_TRY(check_polygon(tile, p, &report->base));
        uint32_t corner_count;
        tl_nav_tile_corners(tile, p, &corner_count);
        tl_nav_surface surface = tl_nav_tile_surface(tile, p);
        bool plain = has_plain_detail(surface, corner_count);
        report->plain_patches += plain;
        header->detail_vertex_count += plain ? 0 : (int32_t)(surface.vertex_count - corner_count);
        header->detail_triangle_count += (int32_t)(plain ? corner_count - 2 : surface.triangle_count);
    }
    report->polygon_count += tile->polygon_count;
    report->off_mesh_links += (uint32_t)header->off_mesh_count;
    report->tile_count++;
    return TL_OK;
}

static void write_polygon(const tl_nav_tile *tile, uint32_t p, uint8_t *bytes)
{
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, p);
    tl_detour_polygon out;
    memset(&out, 0, sizeof out);
    out.first_link = UINT32_MAX;
    out.flags = (uint16_t)tl_nav_tile_flags(tile, p);
    out.vertex_count = (uint8_t)(corners.end - corners.begin);
    out.area_and_type = (uint8_t)(tl_nav_tile_area(tile, p) | TL_DETOUR_GROUND << 6);
    for (uint32_t k = 0; k < out.vertex_count; k++) {
        uint32_t across = tl_nav_tile_neighbour(tile, p, k);
        out.vertices[k] = (uint16_t)tl_nav_tile_corner_vertex(tile, corners.begin + k);
        out.neighbours[k] = across == TL_NO_POLYGON ? 0
                            : across >= TL_PORTAL   ? (uint16_t)(TL_DETOUR_EXTERNAL | DETOUR_SIDES[across & 3u])
                                                    : (uint16_t)(across + 1);
    }
    memcpy(bytes + p * sizeof out, &out, sizeof out);
}

static void write_vertices(const tl_nav_tile *tile, uint8_t *bytes)
{
    for (uint32_t i = 0; i < tile->vertex_count; i++) {
        const tl_vec3 v = tl_nav_lattice_position(tile, tl_nav_tile_vertex(tile, i));
        const float out[3] = { v.x, v.y, v.z };
        memcpy(bytes + i * sizeof out, out, sizeof out);
    }
}

static void write_triangle(tl_nav_detail_triangle triangle, uint8_t *bytes)
{
    uint32_t flags = 0;
    for (uint32_t k = 0; k < 3; k++) {
        bytes[k] = (uint8_t)triangle.corner[k];
        flags |= ((uint32_t)triangle.edge_flags >> k & 1u) != 0 ? TL_DETOUR_EDGE_OUTLINE << (2 * k) : 0;
    }
    bytes[3] = (uint8_t)flags;
}

static void write_detail(const tl_nav_tile *tile, const tl_detour_offsets *at, uint8_t *bytes)
{
    uint32_t vertex = 0, triangle = 0;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        uint32_t corner_count;
        tl_nav_tile_corners(tile, p, &corner_count);
        tl_nav_surface surface = tl_nav_tile_surface(tile, p);
        bool plain = has_plain_detail(surface, corner_count);
        uint32_t added = plain ? 0 : surface.vertex_count - corner_count;
        uint32_t triangles = plain ? corner_count - 2 : surface.triangle_count;
        tl_detour_patch patch = { vertex, triangle, (uint8_t)added, (uint8_t)triangles, { 0, 0 } };
        memcpy(bytes + at->patches + p * sizeof patch, &patch, sizeof patch);
        if (added > 0) {
            memcpy(bytes + at->detail_vertices + 12 * (uint64_t)vertex, surface.vertices + corner_count,
                   12 * (size_t)added);
        }
        uint8_t *out = bytes + at->detail_triangles + 4 * (uint64_t)triangle;
        for (uint32_t i = 0; i < triangles; i++) {
            write_triangle(plain ? tl_nav_fan_triangle(i, corner_count) : tl_nav_surface_triangle(&surface, i),
                           out + 4 * (size_t)i);
        }
        vertex += added;
        triangle += triangles;
    }
}

// Rounded outward: a box may only grow.
static uint16_t quantized(float value, float origin, float factor, bool up)
{
    float cells = (value - origin) * factor;
    float rounded = up ? ceilf(cells) + 1.0f : floorf(cells) - 1.0f;
    return (uint16_t)fminf(fmaxf(rounded, 0.0f), (float)UINT16_MAX);
}

static void write_nodes(const tl_nav_tile *tile, const tl_detour_header *header, uint8_t *bytes)
{
    const tl_nav_tile_node *nodes = tl_nav_tile_nodes(tile);
    for (uint32_t i = tile->node_count; i-- > 0;) {
        const bool is_leaf = (nodes[i].link & TL_NAV_NODE_LEAF) != 0;
        const uint32_t polygon = nodes[i].link & ~TL_NAV_NODE_LEAF;
        tl_detour_node out;
        if (is_leaf) {
            const tl_aabb box = tl_nav_polygon_box(tile, polygon);
            const float min[3] = { box.min.x, box.min.y, box.min.z }, max[3] = { box.max.x, box.max.y, box.max.z };
            for (int k = 0; k < 3; k++) {
                out.min[k] = quantized(min[k], header->min[k], header->quantization, false);
                out.max[k] = quantized(max[k], header->min[k], header->quantization, true);
            }
        } else {
            // Depth first: what lies below stands behind it.
            tl_detour_node other;
            memcpy(&out, bytes + (i + 1) * sizeof out, sizeof out);
            memcpy(&other, bytes + tl_nav_tile_node_skip(nodes, i + 1) * sizeof out, sizeof out);
            for (int k = 0; k < 3; k++) {
                out.min[k] = out.min[k] < other.min[k] ? out.min[k] : other.min[k];
                out.max[k] = out.max[k] > other.max[k] ? out.max[k] : other.max[k];
            }
        }
        out.index = is_leaf ? (int32_t)polygon : -(int32_t)(nodes[i].link - i);
        memcpy(bytes + i * sizeof out, &out, sizeof out);
    }
}

uint64_t tl_detour_tile_size(const tl_nav_tile *tile, tl_detour_refs refs)
{
    tl_detour_header header;
    tl_detour_report report;
    const tl_detour_set alone = { &tile, 1, NULL, 0, refs };
    memset(&report, 0, sizeof report);
    return make_header((set_tile){ &alone, 0 }, &header, &report) == TL_OK ? tl_detour_offsets_of(&header, refs).end
                                                                           : 0;
}

static tl_result write_tile(set_tile place, uint8_t *bytes, uint64_t capacity, uint64_t *size_out,
                            tl_detour_report *report)
{
    const tl_nav_tile *tile = place.set->tiles[place.index];
    tl_detour_header header;
    TL_TRY(make_header(place, &header, report));
    tl_detour_offsets at = tl_detour_offsets_of(&header, place.set->refs);
    if (at.end > capacity) {
        return TL_INCOMPLETE;
    }
    memcpy(bytes, &header, sizeof header);
    write_vertices(tile, bytes + at.vertices);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        write_polygon(tile, p, bytes + at.polygons);
    }
    memset(bytes + at.links, 0, (size_t)(at.patches - at.links)); // Detour links a tile when it is added
    write_detail(tile, &at, bytes);
    write_nodes(tile, &header, bytes + at.nodes);
    write_off_mesh(place, &header, &at, bytes);
    *size_out = at.end;
    return TL_OK;
}

tl_result tl_detour_tile_write(const tl_nav_tile *tile, tl_detour_refs refs, void *bytes, uint64_t capacity,
                               tl_detour_report *report_out)
{
    tl_detour_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "write detour tile");
    uint64_t size;
    tl_result result = tl_refuse_null(tile, "tile", &report.base);
    if (result == TL_OK) {
        const tl_detour_set alone = { &tile, 1, NULL, 0, refs };
        result = write_tile((set_tile){ &alone, 0 }, bytes, capacity, &size, &report);
    }
    if (TL_BIG_ENDIAN && result == TL_OK) {
        tl_detour_swap(bytes, size, false);
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Sets.

static uint32_t bits_for(uint32_t count)
{
    uint32_t bits = 0;
    while ((uint64_t)1 << bits < count) {
        bits++;
    }
    return bits;
}

// Detour's dtTileRef of the tile in slot `index`, as a navmesh gives it the first time: salt 1, polygon 0.
static uint64_t tile_reference(uint32_t index, uint32_t tile_bits, uint32_t polygon_bits, tl_detour_refs refs)
{
    return refs == TL_DETOUR_REFS_64 ? (uint64_t)1 << 48 | (uint64_t)index << 20
                                     : (uint64_t)1 << (tile_bits + polygon_bits) | (uint64_t)index << polygon_bits;
}

static tl_result check_grid(const tl_detour_set *set, tl_report *report)
{
    const tl_nav_tile *model = set->tiles[0];
    for (uint32_t i = 0; i < set->tile_count; i++) {
        const tl_nav_tile *tile = set->tiles[i];
        if (memcmp(&tile->origin, &model->origin, sizeof tile->origin) != 0 || tile->cell_size != model->cell_size ||
            tile->cell_height != model->cell_height || tile->tile_size != model->tile_size) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "tile", i, "it is of another grid than the first one");
        }
    }
    return TL_OK;
}

// What cannot be written is said before there is any room, which its size is not known without.
static tl_result check_tiles(const tl_detour_set *set, uint32_t *most_polygons_out, tl_report *report)
{
    *most_polygons_out = 0;
    for (uint32_t i = 0; i < set->tile_count; i++) {
        tl_detour_header header;
        tl_detour_report probe;
        memset(&probe, 0, sizeof probe);
        const tl_result result = make_header((set_tile){ set, i }, &header, &probe);
        if (result != TL_OK) {
            *report = probe.base;
            return result;
        }
        const uint32_t count = (uint32_t)header.polygon_count;
        *most_polygons_out = count > *most_polygons_out ? count : *most_polygons_out;
    }
    return TL_OK;
}

static void make_set_header(const tl_detour_set *set, uint32_t most_polygons, tl_detour_set_header *header)
{
    const tl_nav_tile *model = set->tiles[0];
    memset(header, 0, sizeof *header);
    header->magic = (int32_t)TL_DETOUR_SET_MAGIC;
    header->version = TL_DETOUR_SET_VERSION;
    header->tile_count = (int32_t)set->tile_count;
    tl_detour_params *params = &header->params;
    params->origin[0] = model->origin.x;
    params->origin[1] = model->origin.y;
    params->origin[2] = model->origin.z;
    params->tile_width = params->tile_height = (float)model->tile_size * model->cell_size;
    params->max_tiles = (int32_t)set->tile_count;
    params->max_polygons = (int32_t)most_polygons;
    for (uint32_t i = 0; i < set->tile_count && model->tile_size == 0; i++) {
        // The only place, wide enough for all its layers.
        params->tile_width = fmaxf(params->tile_width, set->tiles[i]->bounds.max.x - model->origin.x);
        params->tile_height = fmaxf(params->tile_height, set->tiles[i]->bounds.max.z - model->origin.z);
    }
}

uint64_t tl_detour_linked_set_size(const tl_detour_set *set)
{
    uint64_t size = sizeof(tl_detour_set_header);
    for (uint32_t i = 0; i < set->tile_count; i++) {
        tl_detour_header header;
        tl_detour_report report;
        memset(&report, 0, sizeof report);
        if (make_header((set_tile){ set, i }, &header, &report) != TL_OK) {
            return 0;
        }
        size += tl_detour_entry_bytes(set->refs) + tl_detour_offsets_of(&header, set->refs).end;
    }
    return set->tile_count > 0 ? size : 0;
}

uint64_t tl_detour_set_size(const tl_nav_tile *const *tiles, uint32_t tile_count, tl_detour_refs refs)
{
    const tl_detour_set set = { tiles, tile_count, NULL, 0, refs };
    return tl_detour_linked_set_size(&set);
}

static tl_result write_set(const tl_detour_set *set, uint8_t *bytes, uint64_t capacity, tl_detour_report *report)
{
    uint32_t most_polygons;
    if (set->tile_count == 0) {
        return tl_report_fail(&report->base, TL_ERR_EMPTY, "tile", TL_NO_ELEMENT, "give at least one");
    }
    TL_TRY(check_grid(set, &report->base));
    TL_TRY(check_off_mesh(set, &report->base));
    TL_TRY(check_tiles(set, &most_polygons, &report->base));
    tl_detour_set_header header;
    make_set_header(set, most_polygons, &header);
    uint32_t tile_bits = bits_for(set->tile_count), polygon_bits = bits_for(most_polygons);
    if (set->refs == TL_DETOUR_REFS_32 && tile_bits + polygon_bits > 22) {
        return tl_report_fail(&report->base, TL_ERR_LIMIT, "tile", TL_NO_ELEMENT,
                              "tiles and polygons a tile need more than 22 bits; write 64-bit references");
    }
    uint64_t entry = tl_detour_entry_bytes(set->refs), at = sizeof header;
    if (at > capacity) {
        return TL_INCOMPLETE;
    }
    memcpy(bytes, &header, sizeof header);
    for (uint32_t i = 0; i < set->tile_count; i++) {
        uint64_t size = 0;
        tl_result result = at + entry > capacity ? TL_INCOMPLETE
                                                 : write_tile((set_tile){ set, i }, bytes + at + entry,
                                                              capacity - at - entry, &size, report);
        if (result != TL_OK) {
            return result;
        }
        uint64_t reference = tile_reference(i, tile_bits, polygon_bits, set->refs);
        uint32_t size32 = (uint32_t)size;
        memset(bytes + at, 0, (size_t)entry);
        const uint32_t reference32 = (uint32_t)reference; // its low half, whichever comes first here
        memcpy(bytes + at, set->refs == TL_DETOUR_REFS_64 ? (const void *)&reference : &reference32,
               (size_t)(entry / 2));
        memcpy(bytes + at + (set->refs == TL_DETOUR_REFS_64 ? 8 : 4), &size32, 4);
        at += entry + size;
    }
    count_unconnected(set, report);
    return TL_OK;
}

tl_result tl_detour_linked_set_write(const tl_detour_set *set, void *bytes, uint64_t capacity,
                                     tl_detour_report *report_out)
{
    tl_detour_report report;
    memset(&report, 0, sizeof report);
    tl_report_begin(&report.base, "write detour set");
    tl_result result = tl_refuse_null(set, "set", &report.base);
    if (result == TL_OK && set->tile_count > 0) {
        result = tl_refuse_null(set->tiles, "tiles", &report.base);
    }
    if (result == TL_OK && set->off_mesh_count > 0) {
        result = tl_refuse_null(set->off_mesh, "off_mesh", &report.base);
    }
    if (result == TL_OK) {
        result = write_set(set, bytes, capacity, &report);
    }
    if (TL_BIG_ENDIAN && result == TL_OK) {
        tl_detour_swap(bytes, tl_detour_linked_set_size(set), false);
    }
    if (report_out != NULL) {
        *report_out = report;
    }
    return result;
}

tl_result tl_detour_set_write(const tl_nav_tile *const *tiles, uint32_t tile_count, tl_detour_refs refs, void *bytes,
                              uint64_t capacity, tl_detour_report *report_out)
{
    const tl_detour_set set = { tiles, tile_count, NULL, 0, refs };
    return tl_detour_linked_set_write(&set, bytes, capacity, report_out);
}
