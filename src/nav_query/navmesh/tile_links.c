// SPDX-License-Identifier: MIT
//
// Links across the seam of two tiles: portals of facing sides that overlap and whose heights meet; between two layers
// of a place, cuts with the same ends.
//
// Overlaps are exact: both tiles count lattice steps from one origin. Heights are compared along the baked profiles of
// the surface, at every kink of either one, so that a hill on the seam neither hides a link nor fakes one.

#include "nav_query/navmesh/tile_links.h"
#include "base/arena.h"
#include "nav_query/navmesh/navmesh.h"

#include <math.h>
#include <string.h>

// The heights along a portal, from end to end, and a place between two of them.
typedef struct profile_cursor {
    tl_nav_profile_point ends[2];
    const tl_nav_profile_point *inner;
    uint32_t count; // of all
    uint32_t at;    // the segment [at, at + 1]
} profile_cursor;

// At its ends a portal is as high as its corners.
static profile_cursor cursor_of(const tl_nav_tile *tile, uint32_t portal, uint32_t side)
{
    const tl_nav_portal *at = tl_nav_tile_portals(tile) + portal;
    const uint32_t edge = at->corner - tl_nav_tile_first_corner(tile, at->polygon);
    const bool rising = side < 2; // sides 0 and 1 run from low to high
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, at->polygon, &count);
    const float begin = corners[edge].y, end = corners[edge + 1 < count ? edge + 1 : 0].y;
    profile_cursor cursor = {
        { { (float)at->low, rising ? begin : end }, { (float)at->high, rising ? end : begin } }, NULL, 0, 0
    };
    cursor.inner = tl_nav_tile_profile(tile, portal, &cursor.count);
    cursor.count += 2;
    return cursor;
}

static tl_nav_profile_point profile_point_at(const profile_cursor *cursor, uint32_t i)
{
    return i == 0 ? cursor->ends[0] : i + 1 < cursor->count ? cursor->inner[i - 1] : cursor->ends[1];
}

// The height at `along`, which never decreases from call to call.
static double profile_height(profile_cursor *cursor, double along)
{
    while (cursor->at + 2 < cursor->count && (double)profile_point_at(cursor, cursor->at + 1).along <= along) {
        cursor->at++;
    }
    const tl_nav_profile_point a = profile_point_at(cursor, cursor->at), b = profile_point_at(cursor, cursor->at + 1);
    double length = (double)b.along - (double)a.along;
    double t = length > 0.0 ? (along - (double)a.along) / length : 0.0;
    return (double)a.height + t * ((double)b.height - (double)a.height);
}

// The next kink behind `along`, or `high`.
static double next_kink(const profile_cursor *cursor, double along, double high)
{
    for (uint32_t i = cursor->at; i < cursor->count; i++) {
        double kink = (double)profile_point_at(cursor, i).along;
        if (kink > along) {
            return kink < high ? kink : high;
        }
    }
    return high;
}

// Whether the surfaces come within `tolerance` anywhere on [low, high]. Between two kinks the difference is linear, so
// it is smallest at one of them, or zero between when its sign changes.
static bool profiles_meet(profile_cursor a, profile_cursor b, double low, double high, double tolerance)
{
    double difference = profile_height(&a, low) - profile_height(&b, low);
    double along = low;
    while (fabs(difference) > tolerance) {
        if (along >= high) {
            return false;
        }
        double kink_a = next_kink(&a, along, high);
        double kink_b = next_kink(&b, along, high);
        along = kink_a < kink_b ? kink_a : kink_b;
        double next = profile_height(&a, along) - profile_height(&b, along);
        if ((next < 0.0) != (difference < 0.0)) {
            return true;
        }
        difference = next;
    }
    return true;
}

typedef struct seam {
    const tl_nav_tile *tiles[2];
    uint32_t slots[2];
    uint32_t sides[2];
    uint32_t first[2];               // portals of the sides
    const tl_nav_portal *portals[2]; // these
    uint32_t counts[2];
    double tolerance; // metres
} seam;

// Each side's floor is rounded to whole cell heights on its own, so one step may look one cell higher than it is.
static double height_tolerance(const tl_nav_tile *a, const tl_nav_tile *b)
{
    float climb = a->agent_max_climb > b->agent_max_climb ? a->agent_max_climb : b->agent_max_climb;
    return (double)climb + (double)a->cell_height;
}

static seam make_seam(const tl_nav_tile_side *a, const tl_nav_tile_side *b)
{
    seam s = { { a->tile, b->tile },
               { a->slot, b->slot },
               { a->side, b->side },
               { 0, 0 },
               { NULL, NULL },
               { 0, 0 },
               height_tolerance(a->tile, b->tile) };
    for (int i = 0; i < 2; i++) {
        s.first[i] = tl_nav_tile_side_first(s.tiles[i], s.sides[i]);
        s.portals[i] = tl_nav_tile_portals(s.tiles[i]) + s.first[i];
        s.counts[i] = tl_nav_tile_side_first(s.tiles[i], s.sides[i] + 1) - s.first[i];
    }
    return s;
}

// Portals of a side are sorted by low. Calls back for every pair that is to be linked, by a's order, then b's.
typedef void pair_fn(const seam *s, uint32_t i, uint32_t j, void *user);

static void for_each_overlap(const seam *s, pair_fn *pair, void *user)
{
    uint32_t begin = 0;
    for (uint32_t i = 0; i < s->counts[0]; i++) {
        const tl_nav_portal *a = &s->portals[0][i];
        while (begin < s->counts[1] && s->portals[1][begin].high <= a->low) {
            begin++;
        }
        for (uint32_t j = begin; j < s->counts[1] && s->portals[1][j].low < a->high; j++) {
            const tl_nav_portal *b = &s->portals[1][j];
            int32_t low = a->low > b->low ? a->low : b->low;
            int32_t high = a->high < b->high ? a->high : b->high;
            if (low < high &&
                profiles_meet(cursor_of(s->tiles[0], s->first[0] + i, s->sides[0]),
                              cursor_of(s->tiles[1], s->first[1] + j, s->sides[1]), low, high, s->tolerance)) {
                pair(s, i, j, user);
            }
        }
    }
}

// Whether the edge of a cut runs from the first of its ends to the second.
static bool runs_up(const tl_nav_tile *tile, const tl_nav_portal *cut)
{
    tl_nav_lattice_point ends[2];
    tl_nav_cut_ends(tile, cut, ends);
    const tl_nav_lattice_point start =
        tl_nav_tile_lattice(tile, cut->polygon, cut->corner - tl_nav_tile_first_corner(tile, cut->polygon));
    return memcmp(&ends[0], &start, sizeof start) == 0;
}

// The cuts of one tile that lead to the other's layer: both stand in the same order.
static void for_each_cut(const seam *s, pair_fn *pair, void *user)
{
    uint32_t at[2], end[2];
    for (int i = 0; i < 2; i++) {
        const int32_t layer = (int32_t)s->tiles[1 - i]->layer;
        for (at[i] = 0; at[i] < s->counts[i] && s->portals[i][at[i]].low < layer; at[i]++) {
        }
        for (end[i] = at[i]; end[i] < s->counts[i] && s->portals[i][end[i]].low == layer; end[i]++) {
        }
    }
    while (at[0] < end[0] && at[1] < end[1]) {
        const tl_nav_portal *a = &s->portals[0][at[0]];
        const tl_nav_portal *b = &s->portals[1][at[1]];
        const int order = tl_nav_cut_compare(s->tiles[0], a, s->tiles[1], b);
        if (order == 0 && runs_up(s->tiles[0], a) != runs_up(s->tiles[1], b)) {
            pair(s, at[0], at[1], user);
        }
        at[0] += order <= 0;
        at[1] += order >= 0;
    }
}

static void for_each_pair(const seam *s, pair_fn *pair, void *user)
{
    if (s->sides[0] == TL_NAV_SIDE_CUT) {
        for_each_cut(s, pair, user);
    } else {
        for_each_overlap(s, pair, user);
    }
}

static void count_pair(const seam *s, uint32_t i, uint32_t j, void *user)
{
    tl_nav_side_links *out = user;
    (void)s;
    out[0].first[i + 1]++;
    out[1].first[j + 1]++;
}

// The point of a portal's edge at a lattice coordinate: x and z from the lattice, the same bits from both tiles.
static tl_vec3 edge_point(const tl_nav_tile *tile, const tl_nav_portal *portal, uint32_t side, int32_t along)
{
    uint32_t edge = portal->corner - tl_nav_tile_first_corner(tile, portal->polygon);
    uint32_t count = 0;
    const tl_vec3 *corners = tl_nav_tile_corners(tile, portal->polygon, &count);
    tl_vec3 start = corners[edge];
    tl_vec3 end = corners[edge + 1 < count ? edge + 1 : 0];
    bool rising = side < 2; // sides 0 and 1 run from low to high
    tl_vec3 low = rising ? start : end;
    tl_vec3 high = rising ? end : start;
    if (along == portal->low || along == portal->high) {
        return along == portal->low ? low : high;
    }
    float t = (float)((double)(along - portal->low) / (double)(portal->high - portal->low));
    tl_vec3 point = tl_lerp(low, high, t);
    if ((side & 1u) != 0) {
        point.x = tl_nav_tile_position(tile->origin.x, tile->tile_x, tile->tile_size, along, tile->cell_size);
        point.z = low.z;
    } else {
        point.x = low.x;
        point.z = tl_nav_tile_position(tile->origin.z, tile->tile_z, tile->tile_size, along, tile->cell_size);
    }
    return point;
}

void tl_nav_seam_ends(const tl_nav_tile *tile, uint32_t portal, const tl_nav_seam_link *link, tl_vec3 *left_out,
                      tl_vec3 *right_out)
{
    const tl_nav_portal *own = tl_nav_tile_portals(tile) + portal;
    const uint32_t side = tl_nav_tile_side_of(tile, portal);
    if (side == TL_NAV_SIDE_CUT) {
        uint32_t count = 0;
        const tl_vec3 *corners = tl_nav_tile_corners(tile, own->polygon, &count);
        const uint32_t edge = own->corner - tl_nav_tile_first_corner(tile, own->polygon);
        *left_out = corners[edge + 1 < count ? edge + 1 : 0];
        *right_out = corners[edge];
        return;
    }
    const tl_vec3 low = edge_point(tile, own, side, own->low > link->low ? own->low : link->low);
    const tl_vec3 high = edge_point(tile, own, side, own->high < link->high ? own->high : link->high);
    // An edge runs from its right end to its left end, seen looking out.
    *left_out = side < 2 ? high : low;
    *right_out = side < 2 ? low : high;
}

static void add_link(const seam *s, int from, uint32_t portal, uint32_t other, tl_nav_side_links *out)
{
    const tl_nav_portal *across = &s->portals[1 - from][other];
    const uint64_t polygon = (uint64_t)s->slots[1 - from] << TL_NAV_REF_POLYGON_BITS | across->polygon;
    const tl_nav_seam_link link = { polygon << TL_NAV_SEAM_LAYER_BITS | s->tiles[1 - from]->layer, across->low,
                                    across->high };
    tl_nav_seam_links_of(out)[out->first[portal]++] = link;
}

static void fill_pair(const seam *s, uint32_t i, uint32_t j, void *user)
{
    tl_nav_side_links *out = user;
    add_link(s, 0, i, j, &out[0]);
    add_link(s, 1, j, i, &out[1]);
}

// ---------------------------------------------------------------------------------------------------------
// The links of a side.

static uint64_t side_block_size(uint32_t portal_count, uint32_t link_capacity)
{
    const uint64_t numbers = ((uint64_t)portal_count + 3) & ~(uint64_t)1;
    return numbers * sizeof(uint32_t) + link_capacity * (uint64_t)sizeof(tl_nav_seam_link);
}

// Room for links of so many portals, none of which has any yet. NULL `first`: there is no memory.
static tl_nav_side_links allocate_side(const tl_allocator *allocator, uint32_t portal_count, uint32_t link_capacity)
{
    tl_nav_side_links side = { NULL, portal_count, 0 };
    side.first = tl_allocate_array(allocator, side_block_size(portal_count, link_capacity), 1);
    if (side.first != NULL) {
        memset(side.first, 0, (size_t)side_block_size(portal_count, 0));
        side.first[portal_count + 1] = link_capacity;
    }
    return side;
}

void tl_nav_free_side(const tl_allocator *allocator, tl_nav_side_links *side)
{
    if (side->first != NULL) {
        const uint32_t link_capacity = side->first[side->portal_count + 1];
        tl_release_array(allocator, side->first, side_block_size(side->portal_count, link_capacity), 1);
    }
    memset(side, 0, sizeof *side);
}

tl_result tl_nav_copy_side(const tl_allocator *allocator, tl_nav_side_links *side)
{
    tl_nav_side_links copy = allocate_side(allocator, side->portal_count, side->link_count);
    if (copy.first == NULL) {
        return TL_ERR_MEMORY;
    }
    copy.link_count = side->link_count;
    memcpy(copy.first, side->first, ((size_t)side->portal_count + 1) * sizeof *copy.first);
    memcpy(tl_nav_seam_links_of(&copy), tl_nav_seam_links_of(side), side->link_count * sizeof(tl_nav_seam_link));
    tl_nav_free_side(allocator, side);
    *side = copy;
    return TL_OK;
}

// Running sums: first[i + 1] holds portal i's count and becomes its end.
static void sum_counts(tl_nav_side_links *side)
{
    for (uint32_t i = 0; i < side->portal_count; i++) {
        side->first[i + 1] += side->first[i];
    }
}

// Filling moved first[i] on to portal i's end, which is the next one's start.
static void restore_first(tl_nav_side_links *side)
{
    memmove(side->first + 1, side->first, side->portal_count * sizeof *side->first);
    side->first[0] = 0;
}

// Makes both sides' links, whose numbers by portal `counted` holds.
static bool fill_sides(const tl_allocator *allocator, const seam *s, const tl_nav_side_links *counted,
                       tl_nav_side_links *out)
{
    for (int i = 0; i < 2; i++) {
        const uint32_t link_count = counted[i].first[s->counts[i]];
        out[i] = allocate_side(allocator, s->counts[i], link_count);
        if (out[i].first == NULL) {
            return false;
        }
        out[i].link_count = link_count;
        memcpy(out[i].first, counted[i].first, ((size_t)s->counts[i] + 1) * sizeof *out[i].first);
    }
    for_each_pair(s, fill_pair, out);
    restore_first(&out[0]);
    restore_first(&out[1]);
    return true;
}

tl_result tl_nav_link_sides(const tl_allocator *allocator, const tl_nav_tile_side *a, const tl_nav_tile_side *b,
                            tl_nav_side_links *a_out, tl_nav_side_links *b_out)
{
    const seam s = make_seam(a, b);
    tl_nav_side_links counted[2], out[2];
    memset(out, 0, sizeof out);
    counted[0] = allocate_side(allocator, s.counts[0], 0);
    counted[1] = allocate_side(allocator, s.counts[1], 0);
    bool fits = counted[0].first != NULL && counted[1].first != NULL;
    if (fits) {
        for_each_pair(&s, count_pair, counted);
        sum_counts(&counted[0]);
        sum_counts(&counted[1]);
        fits = counted[0].first[s.counts[0]] == 0 || fill_sides(allocator, &s, counted, out);
    }
    tl_nav_free_side(allocator, &counted[0]);
    tl_nav_free_side(allocator, &counted[1]);
    if (!fits) {
        tl_nav_free_side(allocator, &out[0]);
        tl_nav_free_side(allocator, &out[1]);
        return TL_ERR_MEMORY;
    }
    *a_out = out[0];
    *b_out = out[1];
    return TL_OK;
}

static uint32_t seam_layer(const tl_nav_seam_link *link)
{
    return (uint32_t)link->place & ((1u << TL_NAV_SEAM_LAYER_BITS) - 1);
}

static bool stands_before(const tl_nav_seam_link *a, const tl_nav_seam_link *b)
{
    return a->low != b->low ? a->low < b->low : seam_layer(a) < seam_layer(b);
}

tl_result tl_nav_join_sides(const tl_allocator *allocator, const tl_nav_side_links *a, const tl_nav_side_links *b,
                            tl_nav_side_links *out)
{
    const tl_nav_seam_link *links_a = tl_nav_seam_links_of(a), *links_b = tl_nav_seam_links_of(b);
    tl_nav_side_links side = allocate_side(allocator, a->portal_count, a->link_count + b->link_count);
    if (side.first == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_nav_seam_link *links = tl_nav_seam_links_of(&side);
    for (uint32_t portal = 0; portal < side.portal_count; portal++) {
        uint32_t i = a->first[portal], k = b->first[portal];
        side.first[portal] = side.link_count;
        while (i < a->first[portal + 1] || k < b->first[portal + 1]) {
            const bool takes_b =
                i == a->first[portal + 1] || (k < b->first[portal + 1] && stands_before(&links_b[k], &links_a[i]));
            links[side.link_count++] = takes_b ? links_b[k++] : links_a[i++];
        }
    }
    side.first[side.portal_count] = side.link_count;
    *out = side;
    return TL_OK;
}

uint32_t tl_nav_drop_links(const tl_allocator *allocator, tl_nav_side_links *side, uint32_t slot)
{
    if (side->first == NULL) {
        return 0;
    }
    tl_nav_seam_link *links = tl_nav_seam_links_of(side);
    uint32_t kept = 0;
    for (uint32_t portal = 0; portal < side->portal_count; portal++) {
        const uint32_t begin = kept;
        for (uint32_t i = side->first[portal]; i < side->first[portal + 1]; i++) {
            if (tl_nav_seam_slot(&links[i]) != slot) {
                links[kept++] = links[i];
            }
        }
        side->first[portal] = begin;
    }
    const uint32_t dropped = side->link_count - kept;
    side->first[side->portal_count] = kept;
    side->link_count = kept;
    if (kept == 0) {
        tl_nav_free_side(allocator, side);
    }
    return dropped;
}
