// SPDX-License-Identifier: MIT
//
// Portals: the edges on a tile's border, sorted by side and place, each with the profile of the surface along it; then
// the edges that were cut between layers, by the layer across and by their ends.
//
// Two tiles are linked where their borders meet in height. A polygon's edge is straight from corner to corner, while
// the floor under it may rise and fall by more than a step; and the neighbour tile may have put its corners elsewhere.
// To compare straight edges (as other systems do) misses links on hilly ground, or makes false ones with a tolerance
// wide enough to avoid that. So the heights of the detail mesh along the edge are baked in, and those are compared.

#include "nav_format/portal_bake.h"

#include "base/assert.h"
#include "base/host.h"
#include "base/radix_sort.h"
#include "nav_format/lattice_polygon.h"

#include <math.h>
#include <string.h>

// A detail vertex belongs to the border when it is no farther from it than this. Vertices on the edge are off by
// float rounding only; vertices inside a polygon lie on cell centres or sample points, at least half a cell away.
#define BORDER_VERTEX_CELLS 0.25

// The side on which a portal edge really lies, or 4.
static uint32_t side_of_edge(const tl_nav_tile_source *source, uint32_t p, uint32_t k)
{
    const tl_polygon_mesh *polygons = source->polygons;
    uint32_t across = polygons->neighbours[k];
    if (across < TL_PORTAL || across == TL_NO_POLYGON || source->tile_size == 0) {
        return 4;
    }
    uint32_t next = k + 1 < polygons->first[p + 1] ? k + 1 : polygons->first[p];
    const int32_t *a = polygons->vertices + 3 * (size_t)polygons->indices[k];
    const int32_t *b = polygons->vertices + 3 * (size_t)polygons->indices[next];
    uint32_t side = across - TL_PORTAL;
    return tl_nav_on_side(a, b, side, source->tile_size) ? side : 4;
}

typedef struct profile_frame {
    double origin_along, origin_across; // metres: the tile's lattice origin, on the two axes
    double cell;
    double border; // metres from origin_across
    bool along_x;
} profile_frame;

static profile_frame make_frame(const tl_nav_tile_source *source, uint32_t side)
{
    double cell = (double)source->polygons->cell_size;
    double x = (double)source->origin.x + (double)source->tile_x * (double)source->tile_size * cell;
    double z = (double)source->origin.z + (double)source->tile_z * (double)source->tile_size * cell;
    bool along_x = tl_nav_side_axis(side) == 0;
    bool far_side = side == 1 || side == 2;
    profile_frame frame = { along_x ? x : z, along_x ? z : x, cell, far_side ? source->tile_size * cell : 0.0,
                            along_x };
    return frame;
}

// The added vertices of a patch that lie on the border strictly between low and high, sorted; returns their number.
static uint32_t border_vertices(const tl_nav_tile_source *source, const tl_nav_portal *portal, uint32_t side,
                                tl_sort_item *items, tl_sort_item *scratch)
{
    const tl_polygon_mesh *polygons = source->polygons;
    const tl_nav_detail_patch *patch = &source->detail->patches[portal->polygon];
    profile_frame frame = make_frame(source, side);
    uint32_t corner_count = polygons->first[portal->polygon + 1] - polygons->first[portal->polygon];
    uint32_t count = 0;
    for (uint32_t i = corner_count; i < patch->vertex_count; i++) {
        tl_vec3 v = source->detail->vertices[patch->first_vertex + i];
        double across = (double)(frame.along_x ? v.z : v.x) - frame.origin_across;
        double along = ((double)(frame.along_x ? v.x : v.z) - frame.origin_along) / frame.cell;
        float place = (float)along;
        if (fabs(across - frame.border) <= BORDER_VERTEX_CELLS * frame.cell && place > (float)portal->low &&
            place < (float)portal->high) {
            tl_sort_item item = { tl_float_sort_key(place), patch->first_vertex + i, 0 };
            items[count++] = item;
        }
    }
    tl_radix_sort(items, scratch, count);
    return count;
}

static void bake_profile(const tl_nav_tile_source *source, uint32_t side, const tl_nav_portal *portal,
                         tl_sort_item *items, tl_sort_item *scratch, tl_nav_portals *portals)
{
    const profile_frame frame = make_frame(source, side);
    const uint32_t count = border_vertices(source, portal, side, items, scratch);
    for (uint32_t i = 0; i < count; i++) {
        // Two vertices at one place: the first stands for both.
        if (i == 0 || items[i].key != items[i - 1].key) {
            const tl_vec3 v = source->detail->vertices[items[i].value];
            const double along = ((double)(frame.along_x ? v.x : v.z) - frame.origin_along) / frame.cell;
            const tl_nav_profile_point point = { (float)along, v.y };
            portals->profile[portals->profile_count++] = point;
        }
    }
}

// An integer as one that sorts alike without a sign.
static uint64_t biased_height(int32_t value)
{
    return (uint32_t)value ^ 0x80000000u;
}

// What cuts are sorted by after their layer, the least word first: ends as tl_nav_cut_ends has them, then the ordinal.
enum { CUT_WORDS = 4 };

static void cut_words(const tl_polygon_mesh *polygons, const tl_nav_portal *cut, uint64_t words_out[CUT_WORDS])
{
    const uint32_t *first = polygons->first + cut->polygon;
    uint32_t next = cut->corner + 1 < first[1] ? cut->corner + 1 : first[0];
    const int32_t *a = polygons->vertices + 3 * (size_t)polygons->indices[cut->corner];
    const int32_t *b = polygons->vertices + 3 * (size_t)polygons->indices[next];
    bool rises = tl_nav_cut_rises(a, b);
    const int32_t *low = rises ? a : b;
    const int32_t *high = rises ? b : a;
    words_out[0] = (uint32_t)cut->high;
    words_out[1] = biased_height(high[2]) << 32 | biased_height(high[1]);
    words_out[2] = biased_height(low[1]) << 32 | biased_height(high[0]);
    words_out[3] = biased_height(low[0]) << 32 | biased_height(low[2]);
}

// Brings cuts, which stand behind `border_count` other portals, into the order of their words.
static tl_result sort_cuts(const tl_polygon_mesh *polygons, tl_nav_portal *portals, uint32_t border_count,
                           uint32_t count, tl_sort_item *items, tl_sort_item *scratch, tl_report *report)
{
    uint64_t words[CUT_WORDS], before[CUT_WORDS];
    for (uint32_t word = 0; word < CUT_WORDS; word++) {
        for (uint32_t i = border_count; i < count; i++) {
            cut_words(polygons, &portals[items[i].value], words);
            items[i].key = words[word];
        }
        tl_radix_sort(items + border_count, scratch, count - border_count);
    }
    for (uint32_t i = border_count + 1; i < count; i++) {
        const tl_nav_portal *cut = &portals[items[i].value], *other = &portals[items[i - 1].value];
        cut_words(polygons, cut, words);
        cut_words(polygons, other, before);
        if (cut->low == other->low && memcmp(words, before, sizeof words) == 0) {
            return tl_report_fail(report, TL_ERR_ARGUMENT, "cut", TL_NO_ELEMENT,
                                  "give cuts with the same ends ordinals of their own");
        }
    }
    return TL_OK;
}

// Orders portals by side, then low, then corner: the sort's input order, which it keeps. Cuts, which come last, are by
// their words before.
static tl_result sort_portals(const tl_nav_tile_source *source, tl_nav_portal *portals, const uint8_t *sides,
                              uint32_t count, tl_arena *arena, tl_nav_portals *portals_out, tl_report *report)
{
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, count);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, count);
    portals_out->portals = TL_PUSH(arena, tl_nav_portal, count);
    if (items == NULL || scratch == NULL || portals_out->portals == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        tl_sort_item item = { 0, i, 0 };
        items[i] = item;
        for (uint32_t side = sides[i]; side < TL_NAV_SIDE_CUT; side++) {
            portals_out->side_end[side]++;
        }
    }
    TL_TRY(sort_cuts(source->polygons, portals, count - source->cut_count, count, items, scratch, report));
    for (uint32_t i = 0; i < count; i++) {
        uint32_t portal = items[i].value;
        items[i].key = (uint64_t)sides[portal] << 32 | biased_height(portals[portal].low);
    }
    tl_radix_sort(items, scratch, count);
    for (uint32_t i = 0; i < count; i++) {
        portals_out->portals[i] = portals[items[i].value];
    }
    portals_out->portal_count = count;
    return TL_OK;
}

static tl_nav_portal make_portal(const tl_polygon_mesh *polygons, uint32_t p, uint32_t k, uint32_t side)
{
    uint32_t next = k + 1 < polygons->first[p + 1] ? k + 1 : polygons->first[p];
    uint32_t axis = tl_nav_side_axis(side);
    int32_t a = polygons->vertices[3 * (size_t)polygons->indices[k] + axis];
    int32_t b = polygons->vertices[3 * (size_t)polygons->indices[next] + axis];
    tl_nav_portal portal = { p, k, a < b ? a : b, a < b ? b : a, 0 };
    return portal;
}

static void gather_cuts(const tl_nav_tile_source *source, uint32_t made, tl_nav_portal *portals, uint8_t *sides)
{
    uint32_t p = 0;
    for (uint32_t i = 0; i < source->cut_count; i++) {
        const tl_nav_cut *cut = &source->cuts[i];
        while (cut->corner >= source->polygons->first[p + 1]) {
            p++;
        }
        tl_nav_portal portal = { p, cut->corner, (int32_t)cut->layer, (int32_t)cut->ordinal, 0 };
        sides[made + i] = TL_NAV_SIDE_CUT;
        portals[made + i] = portal;
    }
}

tl_result tl_nav_bake_portals(const tl_nav_tile_source *source, tl_arena *arena, tl_nav_portals *portals_out,
                              tl_report *report)
{
    const tl_polygon_mesh *polygons = source->polygons;
    tl_nav_portals zero = { 0 };
    *portals_out = zero;
    uint32_t count = source->cut_count;
    uint32_t largest_patch = 0;
    uint64_t profile_capacity = 0;
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        uint32_t patch_vertices = source->detail != NULL ? source->detail->patches[p].vertex_count : 0;
        largest_patch = patch_vertices > largest_patch ? patch_vertices : largest_patch;
        for (uint32_t k = polygons->first[p]; k < polygons->first[p + 1]; k++) {
            if (side_of_edge(source, p, k) < 4) {
                count++;
                profile_capacity += patch_vertices;
            }
        }
    }
    if (profile_capacity > UINT32_MAX) {
        return tl_report_field(report, TL_ERR_LIMIT, "detail", "use smaller tiles");
    }
    tl_nav_portal *found = TL_PUSH(arena, tl_nav_portal, count);
    uint8_t *sides = TL_PUSH(arena, uint8_t, count);
    tl_sort_item *items = TL_PUSH(arena, tl_sort_item, largest_patch);
    tl_sort_item *scratch = TL_PUSH(arena, tl_sort_item, largest_patch);
    portals_out->profile = TL_PUSH(arena, tl_nav_profile_point, profile_capacity);
    if (found == NULL || sides == NULL || items == NULL || scratch == NULL || portals_out->profile == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t made = 0;
    for (uint32_t p = 0; p < polygons->polygon_count; p++) {
        for (uint32_t k = polygons->first[p]; k < polygons->first[p + 1]; k++) {
            uint32_t side = side_of_edge(source, p, k);
            if (side < 4) {
                sides[made] = (uint8_t)side;
                found[made++] = make_portal(polygons, p, k, side);
            }
        }
    }
    gather_cuts(source, made, found, sides);
    TL_TRY(sort_portals(source, found, sides, count, arena, portals_out, report));
    for (uint32_t i = 0, side = 0; i < count; i++) {
        while (side < TL_NAV_SIDE_CUT && i >= portals_out->side_end[side]) {
            side++;
        }
        portals_out->portals[i].first_profile = portals_out->profile_count;
        if (side < TL_NAV_SIDE_CUT && source->detail != NULL) {
            bake_profile(source, side, &portals_out->portals[i], items, scratch, portals_out);
        }
    }
    return TL_OK;
}
