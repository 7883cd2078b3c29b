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
    const uint32_t edge = at->corner - ((const uint32_t *)tl_nav_tile_at(tile, tile->first_corner))[at->polygon];
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
typedef void pair_fn(const seam *s, uint32_t i, uint32_t j, int32_t low, int32_t high, void *user);

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
                pair(s, i, j, low, high, user);
            }
        }
    }
}

// Whether the edge of a cut runs from the first of its ends to the second.
static bool runs_up(const tl_nav_tile *tile, const tl_nav_portal *cut)
{
    const uint32_t *first = (const uint32_t *)tl_nav_tile_at(tile, tile->first_corner) + cut->polygon;
    tl_nav_lattice_point ends[2];
    tl_nav_cut_ends(tile, cut, ends);
    const tl_nav_lattice_point start = tl_nav_tile_lattice(tile, cut->polygon, cut->corner - first[0]);
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
            pair(s, at[0], at[1], 0, 0, user);
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

static void count_pair(const seam *s, uint32_t i, uint32_t j, int32_t low, int32_t high, void *user)
{
    tl_nav_side_links *out = user;
    (void)s;
    (void)low;
    (void)high;
    out[0].first[i + 1]++;
    out[1].first[j + 1]++;
}

// The point of a portal's edge at a lattice coordinate: x and z from the lattice, the same bits from both tiles.
static tl_vec3 edge_point(const tl_nav_tile *tile, const tl_nav_portal *portal, uint32_t side, int32_t along)
{
    const uint32_t *first = tl_nav_tile_at(tile, tile->first_corner);
    uint32_t edge = portal->corner - first[portal->polygon];
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

static void add_link(const seam *s, int from, uint32_t portal, uint32_t other, int32_t low, int32_t high,
                     tl_nav_side_links *out)
{
    const tl_nav_portal *own = &s->portals[from][portal];
    const tl_nav_portal *across = &s->portals[1 - from][other];
    uint32_t side = s->sides[from];
    if (side == TL_NAV_SIDE_CUT) {
        uint32_t count = 0;
        const tl_nav_tile *tile = s->tiles[from];
        const tl_vec3 *corners = tl_nav_tile_corners(tile, own->polygon, &count);
        uint32_t edge = own->corner - ((const uint32_t *)tl_nav_tile_at(tile, tile->first_corner))[own->polygon];
        tl_nav_seam_link link = { s->slots[1 - from],          across->polygon, across->low, s->tiles[1 - from]->layer,
                                  corners[(edge + 1) % count], corners[edge] };
        out->links[out->first[portal]++] = link;
        return;
    }
    tl_vec3 at_low = edge_point(s->tiles[from], own, side, low);
    tl_vec3 at_high = edge_point(s->tiles[from], own, side, high);
    bool rising = side < 2;
    // An edge runs from its right end to its left end, seen looking out.
    tl_nav_seam_link link = { s->slots[1 - from],        across->polygon,           across->low,
                              s->tiles[1 - from]->layer, rising ? at_high : at_low, rising ? at_low : at_high };
    out->links[out->first[portal]++] = link;
}

static void fill_pair(const seam *s, uint32_t i, uint32_t j, int32_t low, int32_t high, void *user)
{
    tl_nav_side_links *out = user;
    add_link(s, 0, i, j, low, high, &out[0]);
    add_link(s, 1, j, i, low, high, &out[1]);
}

void tl_nav_free_side(const tl_allocator *allocator, tl_nav_side_links *side)
{
    tl_release_array(allocator, side->first, (uint64_t)side->portal_count + 1, sizeof *side->first);
    tl_release_array(allocator, side->links, side->link_capacity, sizeof *side->links);
    memset(side, 0, sizeof *side);
}

tl_result tl_nav_copy_side(const tl_allocator *allocator, tl_nav_side_links *side)
{
    tl_nav_side_links copy = *side;
    const uint64_t firsts = (uint64_t)side->portal_count + 1;
    copy.first = tl_allocate_array(allocator, firsts, sizeof *copy.first);
    copy.links = tl_allocate_array(allocator, copy.link_capacity, sizeof *copy.links);
    if (copy.first == NULL || copy.links == NULL) {
        tl_nav_free_side(allocator, &copy);
        return TL_ERR_MEMORY;
    }
    memcpy(copy.first, side->first, (size_t)firsts * sizeof *copy.first);
    memcpy(copy.links, side->links, side->link_count * sizeof *copy.links);
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

tl_result tl_nav_link_sides(const tl_allocator *allocator, const tl_nav_tile_side *a, const tl_nav_tile_side *b,
                            tl_nav_side_links *a_out, tl_nav_side_links *b_out)
{
    seam s = make_seam(a, b);
    tl_nav_side_links out[2];
    memset(out, 0, sizeof out);
    bool fits = true;
    for (int i = 0; i < 2; i++) {
        out[i].portal_count = s.counts[i];
        out[i].first = tl_allocate_array(allocator, (uint64_t)s.counts[i] + 1, sizeof *out[i].first);
        fits = fits && out[i].first != NULL;
        if (out[i].first != NULL) {
            memset(out[i].first, 0, ((size_t)s.counts[i] + 1) * sizeof *out[i].first);
        }
    }
    if (fits) {
        for_each_pair(&s, count_pair, out);
        for (int i = 0; i < 2; i++) {
            sum_counts(&out[i]);
            out[i].link_count = out[i].link_capacity = out[i].first[out[i].portal_count];
            out[i].links = tl_allocate_array(allocator, out[i].link_count, sizeof *out[i].links);
            fits = fits && out[i].links != NULL;
        }
    }
    if (!fits) {
        tl_nav_free_side(allocator, &out[0]);
        tl_nav_free_side(allocator, &out[1]);
        return TL_ERR_MEMORY;
    }
    for_each_pair(&s, fill_pair, out);
    for (int i = 0; i < 2; i++) {
        restore_first(&out[i]);
        if (out[i].link_count == 0) {
            tl_nav_free_side(allocator, &out[i]);
        }
    }
    *a_out = out[0];
    *b_out = out[1];
    return TL_OK;
}

static bool stands_before(const tl_nav_seam_link *a, const tl_nav_seam_link *b)
{
    return a->low != b->low ? a->low < b->low : a->layer < b->layer;
}

tl_result tl_nav_join_sides(const tl_allocator *allocator, const tl_nav_side_links *a, const tl_nav_side_links *b,
                            tl_nav_side_links *out)
{
    tl_nav_side_links side = { NULL, NULL, a->portal_count, a->link_count + b->link_count,
                               a->link_count + b->link_count };
    side.first = tl_allocate_array(allocator, (uint64_t)side.portal_count + 1, sizeof *side.first);
    side.links = tl_allocate_array(allocator, side.link_capacity, sizeof *side.links);
    if (side.first == NULL || side.links == NULL) {
        tl_nav_free_side(allocator, &side);
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t portal = 0; portal < side.portal_count; portal++) {
        uint32_t i = a->first[portal], k = b->first[portal];
        side.first[portal] = count;
        while (i < a->first[portal + 1] || k < b->first[portal + 1]) {
            const bool takes_b =
                i == a->first[portal + 1] || (k < b->first[portal + 1] && stands_before(&b->links[k], &a->links[i]));
            side.links[count++] = takes_b ? b->links[k++] : a->links[i++];
        }
    }
    side.first[side.portal_count] = count;
    *out = side;
    return TL_OK;
}

uint32_t tl_nav_drop_links(const tl_allocator *allocator, tl_nav_side_links *side, uint32_t slot)
{
    uint32_t kept = 0;
    for (uint32_t portal = 0; side->first != NULL && portal < side->portal_count; portal++) {
        const uint32_t begin = kept;
        for (uint32_t i = side->first[portal]; i < side->first[portal + 1]; i++) {
            if (side->links[i].slot != slot) {
                side->links[kept++] = side->links[i];
            }
        }
        side->first[portal] = begin;
    }
    const uint32_t dropped = side->link_count - kept;
    if (side->first != NULL) {
        side->first[side->portal_count] = kept;
        side->link_count = kept;
    }
    if (kept == 0) {
        tl_nav_free_side(allocator, side);
    }
    return dropped;
}
