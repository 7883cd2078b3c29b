// SPDX-License-Identifier: MIT
//
// The triangulation that ears are cut from, by one sweep: O(n log n), or O(n) after a sweep that was recorded.
//
// A line sweeps over the vertices by rising x, then z. Between two edges next to each other on it, with floor between
// them, lies a region; what of it is not triangulated yet is bounded by the two edges and a chain of vertices from the
// lower edge's begin to the upper edge's, none of which bends into the region. A vertex is joined to those of a chain
// that it sees, from the end where it stands on or, where it splits the region, from the last vertex put there on.
// Source: Hertel and Mehlhorn, "Fast triangulation of simple polygons", 1983; the cases as in de Berg et al.,
// Computational Geometry, section 3.2.
//
// Which edges bound a region is known by their numbers; coordinates only give the order, and the segment below a vertex
// where two edges begin. So vertices at one place (the sides of bridges, and outlines that touch themselves) need no
// care: each has an angle of its own, and is swept by itself.

#include "polygon/triangulate/ear_mesh.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/min_max.h"
#include "polygon/outline/key_table.h"

#include <string.h>

// The far side of a link of a chain: an edge of the mesh, an edge of the outline by the vertex where it starts, or a
// diagonal by the region that began with it. The mesh has fewer than 2^30 edges: MAX_CONTOUR_VERTICES.
#define OUTLINE_SIDE  0x40000000u
#define DIAGONAL_SIDE 0x80000000u
#define SIDE_NUMBER   0x3fffffffu

#define NO_REGION     UINT32_MAX

enum { VERTICES_AHEAD = 6 };

// A vertex that splits a region, and the one it is joined to, stand in two chains: once in each.
typedef struct chain_node {
    tl_lattice_point position;
    uint32_t vertex;
    uint32_t up, down;
    uint32_t beyond; // far side of the link up
} chain_node;

typedef struct sweep_region {
    uint32_t low, high, newest; // nodes
    uint32_t upper;             // edge
    uint32_t diagonal;          // the edge of the mesh on the first known side of the diagonal it began with
} sweep_region;

typedef struct ear_sweep {
    tl_ear_vertex *vertices;
    const tl_lattice_point *points;
    uint32_t count;
    uint32_t triangle_count;
    chain_node *nodes;
    uint32_t node_count;
    sweep_region *regions;
    uint32_t region_count;
    uint32_t *region_of; // [edge]
    bool is_broken;      // this is no outline
} ear_sweep;

static uint32_t vertex_before(const ear_sweep *s, uint32_t v)
{
    return v > 0 ? v - 1 : s->count - 1;
}

static uint32_t vertex_after(const ear_sweep *s, uint32_t v)
{
    return v + 1 < s->count ? v + 1 : 0;
}

// Joins an edge of a new triangle to what lies beyond it.
static void join_side(ear_sweep *s, uint32_t edge, uint32_t side)
{
    tl_ear_edge *e = tl_ear_edge_at(s->vertices, edge);
    e->twin = TL_NO_EAR_EDGE;
    if (side & OUTLINE_SIDE) {
        s->vertices[side & SIDE_NUMBER].outer = edge;
        return;
    }
    uint32_t twin = side;
    if (side & DIAGONAL_SIDE) {
        uint32_t *first = &s->regions[side & SIDE_NUMBER].diagonal;
        twin = *first;
        *first = edge;
    }
    if (twin != TL_NO_EAR_EDGE) {
        e->twin = twin;
        tl_ear_edge_at(s->vertices, twin)->twin = edge;
    }
}

// The first edge of a new triangle, from a to b. It lies at the vertex in the middle of the three: there is one only.
static uint32_t add_ear_triangle(ear_sweep *s, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t u = s->nodes[a].vertex, v = s->nodes[b].vertex, w = s->nodes[c].vertex;
    const uint32_t low = tl_min_u32(u, v), high = tl_max_u32(u, v);
    const uint32_t middle = tl_max_u32(low, tl_min_u32(high, w));
    tl_ear_edge *edges = s->vertices[middle].edges;
    s->is_broken = s->is_broken || edges[0].origin != TL_NO_EAR_VERTEX;
    s->triangle_count++;
    edges[0].origin = u;
    edges[1].origin = v;
    edges[2].origin = w;
    return 4 * middle;
}

static uint32_t add_chain_node(ear_sweep *s, uint32_t v)
{
    s->nodes[s->node_count].position = s->points[v];
    s->nodes[s->node_count].vertex = v;
    return s->node_count++;
}

static bool is_left_of(const ear_sweep *s, uint32_t a, uint32_t b, uint32_t c)
{
    return tl_turn(s->nodes[a].position, s->nodes[b].position, s->nodes[c].position) > 0;
}

// Joins vertex v to a region's chain from its lower end on. `side`: the far side of the edge between these two.
static void join_from_below(ear_sweep *s, sweep_region *region, uint32_t v, uint32_t side)
{
    const uint32_t node = add_chain_node(s, v);
    uint32_t u = region->low;
    for (uint32_t w; u != region->high; u = w) {
        w = s->nodes[u].up;
        if (!is_left_of(s, u, node, w)) {
            break;
        }
        const uint32_t edge = add_ear_triangle(s, u, node, w);
        join_side(s, edge, side);
        join_side(s, edge + 2, s->nodes[u].beyond);
        side = edge + 1;
    }
    s->nodes[node].up = u;
    s->nodes[node].beyond = side;
    s->nodes[u].down = node;
    region->low = region->newest = node;
}

static void join_from_above(ear_sweep *s, sweep_region *region, uint32_t v, uint32_t side)
{
    const uint32_t node = add_chain_node(s, v);
    uint32_t u = region->high;
    for (uint32_t w; u != region->low; u = w) {
        w = s->nodes[u].down;
        if (!is_left_of(s, node, u, w)) {
            break;
        }
        const uint32_t edge = add_ear_triangle(s, node, u, w);
        join_side(s, edge, side);
        join_side(s, edge + 1, s->nodes[w].beyond);
        side = edge + 2;
    }
    s->nodes[node].down = u;
    s->nodes[u].up = node;
    s->nodes[u].beyond = side;
    region->high = region->newest = node;
}

static sweep_region *region_at(ear_sweep *s, uint32_t edge)
{
    s->is_broken = s->is_broken || edge >= s->count || s->region_of[edge] == NO_REGION;
    return &s->regions[s->is_broken ? 0 : s->region_of[edge]];
}

// Vertex v between the edges `in` and `out` = v: the case is who of them lies before it on the sweep's way.
static void continue_below(ear_sweep *s, uint32_t in, uint32_t v)
{
    sweep_region *region = region_at(s, in);
    if (!s->is_broken) {
        join_from_below(s, region, v, OUTLINE_SIDE | in);
        s->region_of[v] = s->region_of[in];
    }
}

static void continue_above(ear_sweep *s, uint32_t in, uint32_t v)
{
    sweep_region *region = region_at(s, v);
    if (!s->is_broken) {
        join_from_above(s, region, v, OUTLINE_SIDE | v);
        region->upper = in;
        s->region_of[in] = s->region_of[v];
    }
}

static void end_or_merge(ear_sweep *s, uint32_t in, uint32_t v)
{
    sweep_region *above = region_at(s, in), *below = region_at(s, v);
    if (s->is_broken) {
        return;
    }
    join_from_below(s, above, v, OUTLINE_SIDE | in);
    const chain_node joined = s->nodes[above->low];
    if (above == below) {
        s->is_broken = s->is_broken || joined.up != above->high || (joined.beyond & OUTLINE_SIDE) != 0;
        join_side(s, s->is_broken ? 0 : joined.beyond, OUTLINE_SIDE | v);
        return;
    }
    s->node_count--; // both chains go on from one node
    join_from_above(s, below, v, OUTLINE_SIDE | v);
    s->nodes[below->high].up = joined.up;
    s->nodes[below->high].beyond = joined.beyond;
    s->nodes[joined.up].down = below->high;
    below->high = above->high;
    below->upper = above->upper;
    s->region_of[below->upper] = s->region_of[v];
}

static sweep_region *begin_region(ear_sweep *s, uint32_t lower, uint32_t upper, uint32_t low, uint32_t high)
{
    sweep_region *region = &s->regions[s->region_count];
    const sweep_region begun = { low, high, high, upper, TL_NO_EAR_EDGE };
    *region = begun;
    s->region_of[lower] = s->region_of[upper] = s->region_count++;
    return region;
}

// `lower`: the edge below v.
static void split_sweep_region(ear_sweep *s, uint32_t in, uint32_t v, uint32_t lower)
{
    sweep_region *below = region_at(s, lower);
    if (s->is_broken) {
        return;
    }
    // The region above begins with a node of its own for the vertex that v is joined to.
    const uint32_t last = below->newest, low = add_chain_node(s, s->nodes[last].vertex);
    s->nodes[low] = s->nodes[last];
    if (last != below->high) {
        s->nodes[s->nodes[low].up].down = low;
    }
    sweep_region *above = begin_region(s, v, below->upper, low, last != below->high ? below->high : low);
    const uint32_t side = DIAGONAL_SIDE | s->region_of[v];
    below->high = last;
    below->upper = in;
    s->region_of[in] = s->region_of[lower];
    join_from_above(s, below, v, side);
    join_from_below(s, above, v, side);
}

static void sweep_vertex(ear_sweep *s, uint32_t v, uint32_t lower)
{
    const uint32_t in = vertex_before(s, v);
    const tl_lattice_point p = s->points[v], a = s->points[in], c = s->points[vertex_after(s, v)];
    const bool ends_in = tl_is_swept_first(a, p), ends_out = tl_is_swept_first(c, p);
    if (ends_in && ends_out) {
        end_or_merge(s, in, v);
    } else if (ends_in) {
        continue_below(s, in, v);
    } else if (ends_out) {
        continue_above(s, in, v);
    } else if (tl_turn(a, p, c) > 0) {
        const uint32_t node = add_chain_node(s, v);
        (void)begin_region(s, v, in, node, node);
    } else {
        split_sweep_region(s, in, v, lower);
    }
}

// What vertex v needs when its turn comes, in steps, each of which reads what the one before has fetched.
static TL_ALWAYS_INLINE void fetch_vertex(const ear_sweep *s, uint32_t v)
{
    tl_prefetch(&s->points[v]);
    tl_prefetch(&s->region_of[v]);
    tl_prefetch(&s->vertices[v]);
}

static TL_ALWAYS_INLINE void fetch_region(const ear_sweep *s, uint32_t v)
{
    const uint32_t region = s->region_of[v], before = s->region_of[vertex_before(s, v)];
    tl_prefetch(&s->regions[region != NO_REGION ? region : 0]);
    tl_prefetch(&s->regions[before != NO_REGION ? before : 0]);
}

static TL_ALWAYS_INLINE void fetch_chain(const ear_sweep *s, uint32_t v)
{
    const uint32_t edges[2] = { v, vertex_before(s, v) };
    for (uint32_t k = 0; k < 2; k++) {
        if (s->region_of[edges[k]] != NO_REGION) {
            const sweep_region *region = &s->regions[s->region_of[edges[k]]];
            tl_prefetch(&s->nodes[region->low]);
            tl_prefetch(&s->nodes[region->high]);
        }
    }
}

// An outline whose vertices stand at different places: edges are the sweep's segments.
static void sweep_plain_outline(ear_sweep *s, const tl_sweep_record *record)
{
    const uint32_t *order = record->order;
    for (uint32_t i = 0; i < s->count && !s->is_broken; i++) {
        const uint32_t left = s->count - i;
        if (3 * VERTICES_AHEAD < left) {
            fetch_vertex(s, order[i + 3 * VERTICES_AHEAD]);
        }
        if (2 * VERTICES_AHEAD < left) {
            fetch_region(s, order[i + 2 * VERTICES_AHEAD]);
        }
        if (VERTICES_AHEAD < left) {
            fetch_chain(s, order[i + VERTICES_AHEAD]);
        }
        sweep_vertex(s, order[i], record->below[i]);
    }
}

// An outline whose sides coincide in parts: the vertices at a place are swept one after another.
static tl_result sweep_united_outline(ear_sweep *s, tl_arena *arena, const tl_outline_sweep *sweep)
{
    uint32_t *first = TL_PUSH(arena, uint32_t, sweep->place_count); // vertex there
    uint32_t *next_there = TL_PUSH(arena, uint32_t, s->count);
    uint32_t *forward = TL_PUSH(arena, uint32_t, sweep->segment_count); // the edge that runs on the sweep's way
    if (first == NULL || next_there == NULL || forward == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(first, 0xff, sweep->place_count * sizeof *first);
    memset(forward, 0xff, sweep->segment_count * sizeof *forward);
    for (uint32_t v = s->count; v-- > 0;) {
        uint32_t *there = &first[sweep->place_of[v]];
        next_there[v] = *there;
        *there = v;
        if (tl_is_swept_first(s->points[v], s->points[vertex_after(s, v)])) {
            forward[sweep->segment_of[v]] = v;
        }
    }
    const uint32_t *order = sweep->record.order, *below = sweep->record.below;
    for (uint32_t i = 0; i < sweep->place_count && !s->is_broken; i++) {
        const uint32_t left = sweep->place_count - i;
        if (4 * VERTICES_AHEAD < left) {
            tl_prefetch(&first[order[i + 4 * VERTICES_AHEAD]]);
        }
        if (3 * VERTICES_AHEAD < left) {
            const uint32_t later = first[order[i + 3 * VERTICES_AHEAD]];
            fetch_vertex(s, later);
            tl_prefetch(&next_there[later]);
        }
        if (2 * VERTICES_AHEAD < left) {
            fetch_region(s, first[order[i + 2 * VERTICES_AHEAD]]);
        }
        if (VERTICES_AHEAD < left) {
            fetch_chain(s, first[order[i + VERTICES_AHEAD]]);
        }
        const uint32_t segment = below[i];
        const uint32_t lower = segment < sweep->segment_count ? forward[segment] : NO_REGION;
        for (uint32_t v = first[order[i]]; v != TL_NO_VALUE && !s->is_broken; v = next_there[v]) {
            sweep_vertex(s, v, lower);
        }
    }
    return TL_OK;
}

static bool unite_places(tl_outline_sweep *sweep, tl_lattice_point **places_out, tl_arena *arena, const ear_sweep *s)
{
    tl_lattice_point *places = *places_out = TL_PUSH(arena, tl_lattice_point, s->count);
    sweep->place_of = TL_PUSH(arena, uint32_t, s->count);
    tl_key_table table;
    if (places == NULL || sweep->place_of == NULL || !tl_key_table_init(&table, arena, s->count)) {
        return false;
    }
    for (uint32_t v = 0; v < s->count; v++) {
        const tl_lattice_point p = s->points[v];
        uint32_t *place = tl_key_table_at(&table, tl_pair_key((uint32_t)p.x, (uint32_t)p.z));
        if (*place == TL_NO_VALUE) {
            places[sweep->place_count] = p;
            *place = sweep->place_count++;
        }
        sweep->place_of[v] = *place;
    }
    return true;
}

static bool unite_segments(tl_outline_sweep *sweep, tl_lattice_segment **segments_out, tl_arena *arena, ear_sweep *s)
{
    tl_lattice_segment *segments = *segments_out = TL_PUSH(arena, tl_lattice_segment, s->count);
    sweep->segment_of = TL_PUSH(arena, uint32_t, s->count);
    tl_key_table table;
    if (segments == NULL || sweep->segment_of == NULL || !tl_key_table_init(&table, arena, s->count)) {
        return false;
    }
    for (uint32_t v = 0; v < s->count && !s->is_broken; v++) {
        const uint32_t from = sweep->place_of[v], to = sweep->place_of[vertex_after(s, v)];
        const tl_lattice_segment segment = { from < to ? from : to, from < to ? to : from };
        uint32_t *number = tl_key_table_at(&table, tl_pair_key(segment.a, segment.b));
        if (*number == TL_NO_VALUE) {
            segments[sweep->segment_count] = segment;
            *number = sweep->segment_count++;
        }
        sweep->segment_of[v] = *number;
        s->is_broken = from == to;
    }
    return true;
}

// An outline of which nothing is known.
static tl_result sweep_unknown_outline(ear_sweep *s, tl_arena *arena)
{
    tl_outline_sweep sweep;
    memset(&sweep, 0, sizeof sweep);
    tl_lattice_point *places;
    tl_lattice_segment *segments;
    if (!unite_places(&sweep, &places, arena, s) || !unite_segments(&sweep, &segments, arena, s) ||
        !tl_sweep_record_init(&sweep.record, arena, sweep.place_count)) {
        return TL_ERR_MEMORY;
    }
    if (s->is_broken) {
        return TL_OK;
    }
    bool is_apart = false;
    TL_TRY(
        tl_sweep_segments(arena, places, sweep.place_count, segments, sweep.segment_count, &sweep.record, &is_apart));
    s->is_broken = !is_apart;
    return is_apart ? sweep_united_outline(s, arena, &sweep) : TL_OK;
}

tl_result tl_ear_mesh_init(tl_ear_vertex *vertices, uint32_t count, tl_arena *scratch, const tl_lattice_point *points,
                           const tl_outline_sweep *sweep)
{
    const tl_arena_mark mark = tl_arena_get_mark(scratch);
    ear_sweep s = { vertices, points, count, 0, NULL, 0, NULL, 0, NULL, false };
    // A vertex that splits makes three nodes and two edges begin, so at most every other one does.
    s.nodes = TL_PUSH(scratch, chain_node, 2 * (uint64_t)count + 1);
    s.regions = TL_PUSH(scratch, sweep_region, (uint64_t)count / 2 + 1);
    s.region_of = TL_PUSH(scratch, uint32_t, count);
    if (s.nodes == NULL || s.regions == NULL || s.region_of == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t v = 0; v < count; v++) {
        s.region_of[v] = NO_REGION;
        vertices[v].edges[0].origin = TL_NO_EAR_VERTEX;
    }
    if (sweep == NULL) {
        TL_TRY(sweep_unknown_outline(&s, scratch));
    } else if (sweep->place_of == NULL) {
        sweep_plain_outline(&s, &sweep->record);
    } else {
        TL_TRY(sweep_united_outline(&s, scratch, sweep));
    }
    tl_arena_rollback(scratch, mark);
    return s.is_broken || s.triangle_count != count - 2 ? TL_ERR_SELF_INTERSECTION : TL_OK;
}
