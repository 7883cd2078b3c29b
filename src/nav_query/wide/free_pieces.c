// SPDX-License-Identifier: MIT
//
// The pieces of a convex polygon's outline that the centre of a wide agent may cross, and which of them are connected
// inside. Exact: no sampling, no search.
//
// A wall forbids its Minkowski sum with a disc, the stadium of all spots nearer to it than the reach: a convex set, so
// it takes one interval off each edge. Intervals that overlap make an arc; the free pieces lie between arcs. Inside the
// polygon two free pieces are separated exactly when some connected part of what is forbidden touches the outline on
// both sides between them. Stadiums whose intervals overlap are connected. So are two that overlap only inside: then
// all of their overlap lies inside, and with it the middle between the two spots where the walls come nearest to each
// other. No other pair is. As every wall lies outside or on the outline, every connected part reaches it, so the arcs
// tell all. Parts do not cross one another. So the piece before an arc is bounded, inside, by the arc's part, and that
// leads to the piece behind the arc which the same part touched last: one pass over the arcs joins all pieces that are
// connected (Kreweras' complement of a non-crossing partition).
//
// The widths of portals that others keep (Demyen and Buro, Efficient Triangulation-Based Pathfinding, 2006; Kallmann,
// Dynamic and Robust Local Clearance Triangulations, 2014) hold for triangles whose corners are all walls; polygons of
// a navmesh have corners on nothing, and walls of other polygons reach in through several portals. Source: Kreweras,
// Sur les partitions non croisees d'un cycle, 1972.

#include "nav_query/wide/free_pieces.h"

#include "base/assert.h"
#include "base/disjoint_sets.h"
#include "base/min_max.h"

#include <string.h>

// A forbidden stretch of the outline: places are edge + [0, 1]. Before it is merged, that of one wall.
typedef struct arc {
    double from, to;
    uint32_t wall; // one of its part
} arc;

typedef struct outline_cut {
    const tl_nav_spot *corners;
    uint32_t count;
    const tl_nav_near_walls *near;
    const tl_nav_wall_cell *kept; // what is precomputed, or NULL
    double reach;
    uint32_t *parts; // [wall_count]: union-find over walls
    arc *arcs;       // [wall_count * count]
    uint32_t arc_count;
    uint32_t *components; // [arc_count]: union-find over the pieces behind arcs
} outline_cut;

bool tl_nav_pair_walls(const tl_nav_spot *corners, uint32_t count, const tl_nav_near_wall *walls, uint32_t a,
                       uint32_t b, tl_nav_wall_pair *pair_out)
{
    tl_nav_spot middle;
    tl_nav_wall_pair pair = { 0.0, a, b };
    pair.distance_sq =
        tl_nav_between_segments(tl_nav_segment_of_wall(&walls[a]), tl_nav_segment_of_wall(&walls[b]), &middle);
    *pair_out = pair;
    return tl_nav_outside_by(corners, count, middle) <= 0.0;
}

static void widen_interval(double from, double to, double *low, double *high)
{
    *low = from < *low ? from : *low;
    *high = to > *high ? to : *high;
}

// The part of the line p + t d that lies in a disc.
static void cut_by_disc(tl_nav_spot p, tl_nav_spot d, tl_nav_spot center, double reach, double *low, double *high)
{
    double x = p.x - center.x;
    double z = p.z - center.z;
    double a = d.x * d.x + d.z * d.z;
    double b = x * d.x + z * d.z;
    double c = x * x + z * z - reach * reach;
    double root = b * b - a * c;
    if (root > 0.0) {
        root = sqrt(root);
        double inverse = 1.0 / a;
        widen_interval((-b - root) * inverse, (-b + root) * inverse, low, high);
    }
}

// Takes off [*low, *high] all t for which p + t d is not between two parallel lines. False: none is left.
static bool clip_by_band(double at, double step, double from, double to, double *low, double *high)
{
    if (step == 0.0) {
        return at > from && at < to;
    }
    double first = (from - at) / step;
    double last = (to - at) / step;
    *low = tl_max_f64(tl_min_f64(last, first), *low);
    *high = tl_min_f64(tl_max_f64(last, first), *high);
    return *low < *high;
}

// The stretch of an edge, as shares of it, that a wall forbids. False: none.
static bool forbidden_stretch(tl_nav_spot p, tl_nav_spot q, tl_nav_segment wall, double reach, double *from_out,
                              double *to_out)
{
    double low = (double)INFINITY;
    double high = -(double)INFINITY;
    tl_nav_spot d = { q.x - p.x, q.z - p.z };
    cut_by_disc(p, d, wall.a, reach, &low, &high);
    cut_by_disc(p, d, wall.b, reach, &low, &high);
    if (low <= 0.0 && high >= 1.0) {
        *from_out = 0.0;
        *to_out = 1.0;
        return true;
    }
    // The rectangle between the two discs.
    double wx = wall.b.x - wall.a.x;
    double wz = wall.b.z - wall.a.z;
    double length = sqrt(wx * wx + wz * wz);
    double first = -(double)INFINITY;
    double last = (double)INFINITY;
    double along = (p.x - wall.a.x) * wx + (p.z - wall.a.z) * wz;
    double aside = (p.z - wall.a.z) * wx - (p.x - wall.a.x) * wz;
    if (length > 0.0 && clip_by_band(along, d.x * wx + d.z * wz, 0.0, length * length, &first, &last) &&
        clip_by_band(aside, d.z * wx - d.x * wz, -reach * length, reach * length, &first, &last)) {
        widen_interval(first, last, &low, &high);
    }
    *from_out = tl_max_f64(0.0, low);
    *to_out = tl_min_f64(1.0, high);
    return low < 1.0 && high > 0.0 && *from_out < *to_out;
}

// Adds what a wall takes off an edge to the `count` stretches of it at `own`; returns their number.
static uint32_t add_stretch(const outline_cut *cut, uint32_t edge, uint32_t wall, arc *own, uint32_t count)
{
    tl_nav_spot p = cut->corners[edge];
    tl_nav_spot q = cut->corners[edge + 1 < cut->count ? edge + 1 : 0];
    arc stretch = { 0.0, 0.0, wall };
    if (!forbidden_stretch(p, q, tl_nav_segment_of_wall(&cut->near->walls[wall]), cut->reach, &stretch.from,
                           &stretch.to)) {
        return count;
    }
    stretch.from += (double)edge;
    stretch.to += (double)edge;
    // By insertion: a polygon has a dozen walls around it, and a pass over all pairs of them follows.
    uint32_t at = count;
    for (; at > 0 && own[at - 1].from > stretch.from; at--) {
        own[at] = own[at - 1];
    }
    own[at] = stretch;
    return count + 1;
}

// Adds a forbidden stretch behind all before it: stretches that overlap become one arc.
static void add_arc(outline_cut *cut, const arc *stretch)
{
    arc *last = cut->arc_count > 0 ? &cut->arcs[cut->arc_count - 1] : NULL;
    if (last != NULL && stretch->from <= last->to) {
        last->to = tl_max_f64(stretch->to, last->to);
        tl_disjoint_sets_unite(cut->parts, last->wall, stretch->wall);
    } else {
        cut->arcs[cut->arc_count++] = *stretch;
    }
}

bool tl_nav_is_side(const tl_nav_spot *corners, uint32_t count, uint32_t side, const tl_nav_near_wall *wall)
{
    tl_nav_spot p = corners[side];
    tl_nav_spot q = corners[side + 1 < count ? side + 1 : 0];
    tl_nav_segment w = tl_nav_segment_of_wall(wall);
    return w.a.x == p.x && w.a.z == p.z && w.b.x == q.x && w.b.z == q.z;
}

float tl_nav_side_distance_sq(const tl_nav_spot *corners, uint32_t count, uint32_t side, const tl_nav_near_wall *wall)
{
    tl_nav_segment segment = { corners[side], corners[side + 1 < count ? side + 1 : 0] };
    return (float)tl_nav_segments_distance_sq(segment, tl_nav_segment_of_wall(wall));
}

// A side that is a wall is forbidden as a whole. A wall that comes near to it anywhere is connected with it.
static void close_edge(outline_cut *cut, uint32_t edge, uint32_t wall)
{
    double reach_sq = cut->reach * cut->reach;
    arc whole = { (double)edge, (double)edge + 1.0, wall };
    add_arc(cut, &whole);
    if (cut->kept != NULL) {
        const tl_nav_wall_hit *hit = cut->kept->hits + cut->kept->side_first[edge];
        const tl_nav_wall_hit *end = cut->kept->hits + cut->kept->side_first[edge + 1];
        for (; hit < end && (double)hit->distance_sq < reach_sq; hit++) {
            if (hit->wall < cut->near->wall_count) {
                tl_disjoint_sets_unite(cut->parts, wall, hit->wall);
            }
        }
        return;
    }
    for (uint32_t i = 0; i < cut->near->wall_count; i++) {
        if (i != wall &&
            (double)tl_nav_side_distance_sq(cut->corners, cut->count, edge, &cut->near->walls[i]) < reach_sq) {
            tl_disjoint_sets_unite(cut->parts, wall, i);
        }
    }
}

// The wall that a side is, or wall_count.
static uint32_t wall_of_side(const outline_cut *cut, uint32_t edge)
{
    uint32_t count = cut->near->wall_count;
    if (cut->kept != NULL) {
        const tl_nav_wall_hit *hit = cut->kept->hits + cut->kept->side_first[edge];
        const tl_nav_wall_hit *end = cut->kept->hits + cut->kept->side_first[edge + 1];
        return hit < end && hit->distance_sq < 0.0f ? hit->wall : count;
    }
    uint32_t i = 0;
    while (i < count && !tl_nav_is_side(cut->corners, cut->count, edge, &cut->near->walls[i])) {
        i++;
    }
    return i;
}

// Cuts one edge; its stretches follow those of the edges before, and arcs that overlap become one.
static void cut_edge(outline_cut *cut, uint32_t edge)
{
    uint32_t side_wall = wall_of_side(cut, edge);
    if (side_wall < cut->near->wall_count) {
        close_edge(cut, edge, side_wall);
        return;
    }
    arc *own = cut->arcs + cut->arc_count;
    uint32_t count = 0;
    if (cut->kept != NULL) {
        const tl_nav_wall_hit *hit = cut->kept->hits + cut->kept->side_first[edge];
        const tl_nav_wall_hit *end = cut->kept->hits + cut->kept->side_first[edge + 1];
        for (; hit < end && (double)hit->distance_sq < cut->kept->distance * cut->kept->distance; hit++) {
            count = add_stretch(cut, edge, hit->wall, own, count);
        }
    } else {
        for (uint32_t i = 0; i < cut->near->wall_count; i++) {
            count = add_stretch(cut, edge, i, own, count);
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        // It may be put into its own place, or one before.
        const arc stretch = own[i];
        add_arc(cut, &stretch);
    }
}

// The arc over the first corner was cut in two.
static void close_outline(outline_cut *cut)
{
    arc *last = cut->arc_count > 1 ? &cut->arcs[cut->arc_count - 1] : NULL;
    if (last != NULL && cut->arcs[0].from <= 0.0 && last->to >= (double)cut->count) {
        tl_disjoint_sets_unite(cut->parts, cut->arcs[0].wall, last->wall);
        cut->arcs[0].from = last->from - (double)cut->count;
        cut->arc_count--;
    }
}

// Stadiums that overlap inside the outline alone.
static void join_inside(outline_cut *cut)
{
    double both = 4.0 * cut->reach * cut->reach;
    if (cut->kept != NULL) {
        const tl_nav_wall_pair *pairs = cut->kept->pairs;
        for (uint32_t i = 0; i < cut->kept->pair_count && pairs[i].distance_sq < both; i++) {
            if (pairs[i].b < cut->near->wall_count) {
                tl_disjoint_sets_unite(cut->parts, pairs[i].a, pairs[i].b);
            }
        }
        return;
    }
    for (uint32_t i = 0; i < cut->near->wall_count && cut->arc_count > 1; i++) {
        for (uint32_t k = i + 1; k < cut->near->wall_count; k++) {
            tl_nav_wall_pair pair;
            if (tl_disjoint_sets_find(cut->parts, i) != tl_disjoint_sets_find(cut->parts, k) &&
                tl_nav_pair_walls(cut->corners, cut->count, cut->near->walls, i, k, &pair) && pair.distance_sq < both) {
                tl_disjoint_sets_unite(cut->parts, i, k);
            }
        }
    }
}

// Joins the pieces around each part. `last` holds wall_count numbers.
static void join_components(outline_cut *cut, uint32_t *last)
{
    uint32_t count = cut->arc_count;
    for (uint32_t i = 0; i < count; i++) {
        cut->components[i] = i;
        last[tl_disjoint_sets_find(cut->parts, cut->arcs[i].wall)] = i;
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t part = tl_disjoint_sets_find(cut->parts, cut->arcs[i].wall);
        tl_disjoint_sets_unite(cut->components, i > 0 ? i - 1 : count - 1, last[part]);
        last[part] = i;
    }
}

// Writes the free stretch between two places of the outline, edge by edge; the second may be a lap ahead.
static void add_pieces(const outline_cut *cut, double from, double to, uint32_t component, tl_nav_pieces *pieces)
{
    uint32_t edge = (uint32_t)from;
    double lap = 0.0;
    while ((double)edge + lap < to) {
        double start = (double)edge + lap;
        tl_nav_piece piece = { tl_max_f64(0.0, from - start), tl_min_f64(1.0, to - start), edge, component };
        if (piece.from < piece.to) {
            pieces->pieces[pieces->count++] = piece;
        }
        if (++edge == cut->count) {
            edge = 0;
            lap += (double)cut->count;
        }
    }
}

// `kept` may be NULL.
static bool cut_outline(tl_nav_clearance *clearance, const tl_nav_spot *corners, uint32_t count,
                        const tl_nav_near_walls *near, const tl_nav_wall_cell *kept, tl_nav_pieces *pieces_out)
{
    outline_cut cut = { corners, count, near, kept, clearance->reach, NULL, NULL, 0, NULL };
    memset(pieces_out, 0, sizeof *pieces_out);
    uint64_t stretches =
        kept != NULL ? kept->side_first[count] - kept->side_first[0] : (uint64_t)near->wall_count * count;
    // Each stretch is followed by at most one free piece, and each corner cuts one more.
    pieces_out->pieces = tl_nav_take_scratch(clearance, stretches + count, sizeof *pieces_out->pieces);
    tl_nav_scratch scratch = clearance->scratch;
    cut.parts = tl_nav_take_scratch(clearance, near->wall_count, sizeof *cut.parts);
    uint32_t *last = tl_nav_take_scratch(clearance, near->wall_count, sizeof *last);
    cut.arcs = tl_nav_take_scratch(clearance, stretches, sizeof *cut.arcs);
    cut.components = tl_nav_take_scratch(clearance, stretches, sizeof *cut.components);
    if (clearance->is_full) {
        return false;
    }
    tl_disjoint_sets_init(cut.parts, near->wall_count);
    for (uint32_t i = 0; i < count; i++) {
        cut_edge(&cut, i);
    }
    close_outline(&cut);
    join_inside(&cut);
    join_components(&cut, last);
    if (cut.arc_count == 0) {
        add_pieces(&cut, 0.0, (double)count, 0, pieces_out);
    }
    for (uint32_t i = 0; i < cut.arc_count; i++) {
        bool laps = i + 1 == cut.arc_count;
        double to = laps ? cut.arcs[0].from + (double)count : cut.arcs[i + 1].from;
        // The arc that was closed over the first corner begins before it.
        double from = cut.arcs[i].to;
        add_pieces(&cut, from, to, tl_disjoint_sets_find(cut.components, i), pieces_out);
    }
    pieces_out->component_count = cut.arc_count > 0 ? cut.arc_count : 1;
    TL_ASSERT(pieces_out->count <= stretches + count);
    clearance->scratch = scratch;
    return true;
}

bool tl_nav_cut_cell(tl_nav_clearance *clearance, const tl_nav_wall_cell *cell, tl_nav_pieces *pieces_out)
{
    return cut_outline(clearance, cell->corners, cell->count, &cell->near, cell->is_kept ? cell : NULL, pieces_out);
}

bool tl_nav_cut_outline(tl_nav_clearance *clearance, const tl_nav_spot *corners, uint32_t count,
                        const tl_nav_near_walls *near, tl_nav_pieces *pieces_out)
{
    return cut_outline(clearance, corners, count, near, NULL, pieces_out);
}

const tl_nav_piece *tl_nav_piece_at(const tl_nav_pieces *pieces, const tl_nav_spot *corners, uint32_t count,
                                    tl_nav_spot spot, double slack)
{
    const tl_nav_piece *best = NULL;
    double best_sq = slack * slack;
    for (uint32_t i = 0; i < pieces->count; i++) {
        const tl_nav_piece *piece = &pieces->pieces[i];
        tl_nav_spot p = corners[piece->edge];
        tl_nav_spot q = corners[piece->edge + 1 < count ? piece->edge + 1 : 0];
        tl_nav_segment stretch = { tl_nav_spot_lerp(p, q, piece->from), tl_nav_spot_lerp(p, q, piece->to) };
        tl_nav_spot nearest;
        double distance_sq = tl_nav_nearest_of_segment(stretch, spot, &nearest);
        if (distance_sq <= best_sq) {
            best_sq = distance_sq;
            best = piece;
        }
    }
    return best;
}
