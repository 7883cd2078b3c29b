// SPDX-License-Identifier: MIT
//
// Whether bytes are a valid tile. Offsets are not followed: they are computed from the counts and compared. Then every
// index that a query will use is checked, and every derived value is computed again. Nothing is
// allocated, so that a mapped file can be checked in place.

#include "base/assert.h"
#include "base/hash.h"
#include "base/host.h"
#include "nav_format/box_tree.h"
#include "nav_format/lattice_polygon.h"
#include "nav_format/source_check.h"
#include "nav_format/tile_layout.h"

#include <math.h>
#include <string.h>
#include <talus/mesh.h>

static tl_result corrupt(tl_report *report, const char *element, uint64_t index)
{
    return tl_report_fail(report, TL_ERR_CORRUPT, element, index, "bake the level again");
}

static bool is_positive(float value)
{
    return value > 0.0f && isfinite(value);
}

static bool is_cell(float value)
{
    return value >= TL_NAV_MIN_CELL && isfinite(value);
}

static bool is_place(float value)
{
    return value >= -TL_MAX_COORDINATE && value <= TL_MAX_COORDINATE;
}

static bool is_point(tl_vec3 v)
{
    return is_place(v.x) && is_place(v.y) && is_place(v.z);
}

// Bitwise, so that -0 and 0 differ: baked values are reproducible to the last bit.
static bool same_bits(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

static tl_result check_scalars(const tl_nav_tile *tile, tl_report *report)
{
    bool counts = tile->polygon_count >= 1 && tile->polygon_count <= TL_NAV_MAX_TILE_POLYGONS &&
                  tile->corner_count < TL_NAV_LINK_PORTAL && tile->node_count == 2 * tile->polygon_count - 1;
    bool place = tile->tile_x >= -TL_NAV_MAX_TILE_INDEX && tile->tile_x <= TL_NAV_MAX_TILE_INDEX &&
                 tile->tile_z >= -TL_NAV_MAX_TILE_INDEX && tile->tile_z <= TL_NAV_MAX_TILE_INDEX &&
                 tile->tile_size <= TL_MAX_CONTOUR_COORDINATE &&
                 (tile->tile_size > 0 || (tile->tile_x == 0 && tile->tile_z == 0));
    bool sizes = is_cell(tile->cell_size) && is_cell(tile->cell_height) && is_positive(tile->agent_height) &&
                 tile->agent_radius >= 0.0f && isfinite(tile->agent_radius) && tile->agent_max_climb >= 0.0f &&
                 isfinite(tile->agent_max_climb) && isfinite(tile->origin.x) && isfinite(tile->origin.y) &&
                 isfinite(tile->origin.z);
    const bool has_wide_corners = (tile->wide & TL_NAV_WIDE_CORNERS) != 0;
    const bool has_wide_firsts = (tile->wide & TL_NAV_WIDE_FIRSTS) != 0;
    const bool has_wide_links = (tile->wide & TL_NAV_WIDE_LINKS) != 0;
    bool sides = tile->layer <= TL_NAV_MAX_LAYER && tile->wide < 2 * TL_NAV_WIDE_FIRSTS && tile->zero == 0 &&
                 has_wide_corners == (tile->vertex_count > UINT16_MAX + 1u) &&
                 has_wide_links == tl_nav_needs_wide_links(tile) && has_wide_firsts == tl_nav_needs_wide_firsts(tile);
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        sides = sides && tl_nav_tile_side_first(tile, side) <= tl_nav_tile_side_first(tile, side + 1);
    }
    return counts && place && sizes && sides ? TL_OK : corrupt(report, "header", TL_NO_ELEMENT);
}

static tl_result check_layout(const tl_nav_tile *tile, tl_report *report)
{
    tl_nav_extent extents[TL_NAV_TILE_ARRAYS];
    tl_nav_tile_extents(tile, extents);
    tl_nav_tile expected = *tile;
    tl_nav_tile_set_offsets(&expected, extents);
    if (!same_bits(&expected, tile, sizeof expected) || tile->blob.size != extents[TL_NAV_TILE_ARRAYS - 1].end ||
        tile->blob.size > TL_NAV_MAX_TILE_SIZE) {
        return corrupt(report, "header", TL_NO_ELEMENT);
    }
    const uint8_t *bytes = (const uint8_t *)tile;
    for (uint32_t i = 0; i < TL_NAV_TILE_ARRAYS; i++) {
        for (uint64_t at = extents[i].offset + extents[i].size; at < extents[i].end; at++) {
            if (bytes[at] != 0) {
                return corrupt(report, "padding", at);
            }
        }
    }
    return TL_OK;
}

// Whether the first of an array is 0, every step is in [low, high], and the last entry is `total`.
static bool is_range_table(const tl_nav_tile *tile, uint32_t array, uint32_t low, uint32_t high, uint32_t total)
{
    uint32_t before = tl_nav_tile_first(tile, array, 0);
    bool right = before == 0 && tl_nav_tile_first(tile, array, tile->polygon_count) == total;
    for (uint32_t i = 1; i <= tile->polygon_count && right; i++) {
        const uint32_t first = tl_nav_tile_first(tile, array, i);
        right = first >= before && first - before >= low && first - before <= high;
        before = first;
    }
    return right;
}

static tl_result check_lattice(const tl_nav_tile *tile, tl_report *report)
{
    bool is_wide = false;
    for (uint32_t i = 0; i < tile->vertex_count; i++) {
        const tl_nav_lattice_point v = tl_nav_tile_vertex(tile, i);
        for (int axis = 0; axis < 3; axis++) {
            if (v.at[axis] < -TL_MAX_CONTOUR_COORDINATE || v.at[axis] > TL_MAX_CONTOUR_COORDINATE) {
                return corrupt(report, "vertex", i);
            }
            is_wide = is_wide || v.at[axis] < 0 || v.at[axis] > UINT16_MAX;
        }
    }
    for (uint32_t k = 0; k < tile->corner_count; k++) {
        if (tl_nav_tile_corner_vertex(tile, k) >= tile->vertex_count) {
            return corrupt(report, "corner", k);
        }
    }
    return is_wide == ((tile->wide & TL_NAV_WIDE_LATTICE) != 0) ? TL_OK : corrupt(report, "header", TL_NO_ELEMENT);
}

// As tl_nav_links_back of a source.
static bool tile_links_back(const tl_nav_tile *tile, uint32_t polygon, uint32_t corner)
{
    const uint32_t other = tl_nav_tile_link(tile, corner);
    const uint32_t begin = tl_nav_tile_corner_vertex(tile, corner);
    const uint32_t end = tl_nav_tile_corner_vertex(tile, tl_nav_tile_next_corner(tile, polygon, corner));
    const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, other);
    for (uint32_t k = corners.begin; k < corners.end; k++) {
        if (tl_nav_tile_link(tile, k) == polygon && tl_nav_tile_corner_vertex(tile, k) == end &&
            tl_nav_tile_corner_vertex(tile, tl_nav_tile_next_corner(tile, other, k)) == begin) {
            return true;
        }
    }
    return false;
}

static bool is_link(const tl_nav_tile *tile, uint32_t p, uint32_t k)
{
    const uint32_t link = tl_nav_tile_link(tile, k);
    if (link == TL_NAV_LINK_WALL) {
        return true;
    }
    if (tl_nav_is_portal(link)) {
        const uint32_t portal = tl_nav_link_portal(link);
        return portal < tile->portal_count && tl_nav_tile_portals(tile)[portal].corner == k;
    }
    return link < tile->polygon_count && link != p && tile_links_back(tile, p, k);
}

static tl_result check_polygons(const tl_nav_tile *tile, tl_report *report)
{
    if (!is_range_table(tile, tile->first_corner, 3, TL_NAV_MAX_CORNERS, tile->corner_count)) {
        return corrupt(report, "polygon", TL_NO_ELEMENT);
    }
    TL_TRY(check_lattice(tile, report));
    double area = 0.0;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        tl_nav_lattice_polygon outline;
        tl_nav_gather_tile_polygon(tile, p, &outline);
        if (tl_nav_tile_area(tile, p) == 0 || tl_nav_double_area(&outline) <= 0 || !tl_nav_is_convex(&outline)) {
            return corrupt(report, "polygon", p);
        }
        const tl_nav_tile_part corners = tl_nav_tile_part_of(tile, tile->first_corner, p);
        for (uint32_t k = corners.begin; k < corners.end; k++) {
            if (!is_link(tile, p, k)) {
                return corrupt(report, "polygon", p);
            }
        }
        area += tl_nav_tile_polygon_area(tile, p);
    }
    return same_bits(&area, &tile->area, sizeof area) ? TL_OK : corrupt(report, "header", TL_NO_ELEMENT);
}

static bool is_surface(const tl_nav_tile *tile, uint32_t p)
{
    uint32_t corner_count = 0;
    tl_nav_tile_corners(tile, p, &corner_count);
    const tl_nav_surface surface = tl_nav_tile_surface(tile, p);
    if (surface.vertex_count < corner_count) {
        return false;
    }
    for (uint32_t i = 0; i < surface.vertex_count; i++) {
        if (!is_point(surface.vertices[i])) {
            return false;
        }
    }
    for (uint32_t i = 0; i < corner_count; i++) {
        const tl_vec3 expected = tl_nav_lattice_position(tile, tl_nav_tile_lattice(tile, p, i));
        if (!same_bits(&expected, &surface.vertices[i], sizeof expected)) {
            return false;
        }
    }
    for (uint32_t i = 0; i < surface.triangle_count; i++) {
        const tl_nav_detail_triangle triangle = tl_nav_surface_triangle(&surface, i);
        if (triangle.corner[0] >= surface.vertex_count || triangle.corner[1] >= surface.vertex_count ||
            triangle.corner[2] >= surface.vertex_count || triangle.edge_flags > 7) {
            return false;
        }
    }
    return true;
}

static tl_result check_surfaces(const tl_nav_tile *tile, tl_report *report)
{
    if (!is_range_table(tile, tile->detail_first_vertex, 3, UINT16_MAX + 1u, tile->detail_vertex_count) ||
        !is_range_table(tile, tile->detail_first_triangle, 1, UINT32_MAX, tile->detail_triangle_count)) {
        return corrupt(report, "patch", TL_NO_ELEMENT);
    }
    bool is_wide = false;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        if (!is_surface(tile, p)) {
            return corrupt(report, "patch", p);
        }
        is_wide = is_wide || tl_nav_tile_surface(tile, p).vertex_count > UINT8_MAX + 1u;
    }
    return is_wide == ((tile->wide & TL_NAV_WIDE_TRIANGLES) != 0) ? TL_OK : corrupt(report, "header", TL_NO_ELEMENT);
}

// Whether the heights along a portal, whose range is within the profile, rise from its low end to its high one.
static bool is_profile(const tl_nav_tile *tile, uint32_t index)
{
    const tl_nav_portal *portal = &tl_nav_tile_portals(tile)[index];
    uint32_t count = 0;
    const tl_nav_profile_point *points = tl_nav_tile_profile(tile, index, &count);
    bool right = true;
    for (uint32_t i = 0; i < count; i++) {
        right = right && is_place(points[i].height) && points[i].along > (float)portal->low &&
                points[i].along < (float)portal->high && (i == 0 || points[i - 1].along <= points[i].along);
    }
    return right;
}

// Of a cut: the layer across is another one. Where it lies is its edge's business.
static bool is_cut(const tl_nav_tile *tile, uint32_t index)
{
    const tl_nav_portal *portal = &tl_nav_tile_portals(tile)[index];
    uint32_t profile_count = 0;
    tl_nav_tile_profile(tile, index, &profile_count);
    return portal->low >= 0 && (uint32_t)portal->low <= TL_NAV_MAX_LAYER && (uint32_t)portal->low != tile->layer &&
           portal->high >= 0 && profile_count == 0;
}

// Whether a portal's edge is this portal's own, on whatever side.
static bool is_own_edge(const tl_nav_tile *tile, uint32_t index)
{
    const tl_nav_portal *portal = &tl_nav_tile_portals(tile)[index];
    uint32_t p = portal->polygon;
    return p < tile->polygon_count && portal->corner >= tl_nav_tile_first_corner(tile, p) &&
           portal->corner < tl_nav_tile_first_corner(tile, p + 1) &&
           tl_nav_link_portal(tl_nav_tile_link(tile, portal->corner)) == index;
}

static bool is_on_border(const tl_nav_tile *tile, uint32_t index, uint32_t side)
{
    const tl_nav_portal *portal = &tl_nav_tile_portals(tile)[index];
    uint32_t p = portal->polygon;
    uint32_t edge = portal->corner - tl_nav_tile_first_corner(tile, p);
    uint32_t next = tl_nav_tile_next_corner(tile, p, portal->corner) - tl_nav_tile_first_corner(tile, p);
    const tl_nav_lattice_point begin = tl_nav_tile_lattice(tile, p, edge), end = tl_nav_tile_lattice(tile, p, next);
    const int32_t *a = begin.at, *b = end.at;
    uint32_t axis = tl_nav_side_axis(side);
    return tl_nav_on_side(a, b, side, tile->tile_size) && portal->low == (a[axis] < b[axis] ? a[axis] : b[axis]) &&
           portal->high == (a[axis] < b[axis] ? b[axis] : a[axis]) && is_profile(tile, index);
}

// Whether the portal before stands before this one of the same side. Both are edges of their own.
static bool is_ordered(const tl_nav_tile *tile, uint32_t side, const tl_nav_portal *before, const tl_nav_portal *portal)
{
    if (before->low != portal->low) {
        return before->low < portal->low;
    }
    return side == TL_NAV_SIDE_CUT ? tl_nav_cut_compare(tile, before, tile, portal) < 0
                                   : before->corner < portal->corner;
}

static tl_result check_portals(const tl_nav_tile *tile, tl_report *report)
{
    const tl_nav_portal *portals = tl_nav_tile_portals(tile);
    uint32_t profile_end = 0;
    for (uint32_t i = 0; i < tile->portal_count; i++) {
        if (portals[i].first_profile < profile_end || portals[i].first_profile > tile->profile_count) {
            return corrupt(report, "portal", i);
        }
        profile_end = portals[i].first_profile;
    }
    for (uint32_t side = 0; side < TL_NAV_SIDE_COUNT; side++) {
        const uint32_t begin = tl_nav_tile_side_first(tile, side);
        for (uint32_t i = begin; i < tl_nav_tile_side_first(tile, side + 1); i++) {
            const tl_nav_portal *portal = &portals[i];
            if (!is_own_edge(tile, i) || !(side == TL_NAV_SIDE_CUT ? is_cut(tile, i) : is_on_border(tile, i, side)) ||
                (i > begin && !is_ordered(tile, side, portal - 1, portal))) {
                return corrupt(report, "portal", i);
            }
        }
    }
    const bool has_all = tile->portal_count > 0 ? portals[0].first_profile == 0 : tile->profile_count == 0;
    return has_all ? TL_OK : corrupt(report, "portal", TL_NO_ELEMENT);
}

typedef struct tree_check {
    const tl_nav_tile *tile;
    const tl_nav_tile_node *nodes;
    uint64_t polygon_digest; // sum of the hashes of the polygons seen
} tree_check;

// Checks the subtree at `node`, which must end exactly at `end`. Subtrees are disjoint and the depth is bounded, so
// the recursion is too.
static bool check_subtree(tree_check *check, uint32_t node, uint32_t end, uint32_t depth)
{
    const bool is_leaf = (check->nodes[node].link & TL_NAV_NODE_LEAF) != 0;
    if (is_leaf != (end - node == 1) || tl_nav_tile_node_skip(check->nodes, node) != end ||
        depth > TL_NAV_MAX_TILE_DEPTH) {
        return false;
    }
    tl_nav_tile_node at = check->nodes[node];
    if (is_leaf) {
        const uint32_t polygon = at.link & ~TL_NAV_NODE_LEAF;
        if (polygon >= check->tile->polygon_count) {
            return false;
        }
        tl_nav_set_leaf_box(check->tile, &at);
        check->polygon_digest += tl_hash_mix(polygon + 1u);
        return same_bits(&at, &check->nodes[node], sizeof at);
    }
    const uint32_t second = tl_nav_tile_node_skip(check->nodes, node + 1);
    if (second <= node + 1 || second >= end) {
        return false;
    }
    tl_nav_set_inner_box(&at, &check->nodes[node + 1], &check->nodes[second]);
    return same_bits(&at, &check->nodes[node], sizeof at) && check_subtree(check, node + 1, second, depth + 1) &&
           check_subtree(check, second, end, depth + 1);
}

static tl_result check_tree(const tl_nav_tile *tile, tl_report *report)
{
    const tl_aabb bounds = tl_nav_tile_surface_bounds(tile);
    if (!same_bits(&tile->bounds, &bounds, sizeof bounds) || tile->node_steps != tl_nav_steps_over(bounds)) {
        return corrupt(report, "header", TL_NO_ELEMENT);
    }
    tree_check check = { tile, tl_nav_tile_nodes(tile), 0 };
    if (!check_subtree(&check, 0, tile->node_count, 0)) {
        return corrupt(report, "node", TL_NO_ELEMENT);
    }
    // There are as many leaves as polygons; that each polygon has one follows when the sums of hashes agree, which
    // spares a table of marks.
    uint64_t expected = 0;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        expected += tl_hash_mix(p + 1u);
    }
    if (check.polygon_digest != expected) {
        return corrupt(report, "node", TL_NO_ELEMENT);
    }
    return TL_OK;
}

tl_result tl_nav_tile_check(const void *bytes, uint64_t size, tl_report *report_out)
{
    tl_report_begin(report_out, "check tile");
    TL_REFUSE_NULL(bytes, report_out);
    if ((uintptr_t)bytes % 8 != 0) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "bytes", "align the bytes to 8");
    }
    if (size < sizeof(tl_blob)) {
        return tl_report_fail(report_out, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT,
                              "the bytes end too early: give them all");
    }
    const tl_nav_tile *tile = bytes;
    if (tile->blob.magic != TL_NAV_TILE_MAGIC) {
        return tl_report_fail(report_out, TL_ERR_MAGIC, "header", TL_NO_ELEMENT, "give the bytes of a navmesh tile");
    }
    if (tile->blob.version != TL_NAV_TILE_VERSION) {
        return tl_report_fail(report_out, TL_ERR_VERSION, "header", TL_NO_ELEMENT, "bake the level again");
    }
    if (size < sizeof *tile || size < tile->blob.size) {
        return tl_report_fail(report_out, TL_ERR_TRUNCATED, "header", TL_NO_ELEMENT,
                              "the bytes end too early: give them all");
    }
    if (size != tile->blob.size) {
        return corrupt(report_out, "header", TL_NO_ELEMENT);
    }
    TL_TRY(check_scalars(tile, report_out));
    TL_TRY(check_layout(tile, report_out));
    TL_TRY(check_polygons(tile, report_out));
    TL_TRY(check_surfaces(tile, report_out));
    TL_TRY(check_portals(tile, report_out));
    return check_tree(tile, report_out);
}
