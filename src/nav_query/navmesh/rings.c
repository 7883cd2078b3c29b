// SPDX-License-Identifier: MIT
//
// Building rings: first counted, then written, polygon by polygon (ring_writer.h).

#include "nav_query/navmesh/rings.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/navmesh/fans.h"
#include "nav_query/navmesh/navmesh.h"
#include "nav_query/navmesh/ring_writer.h"

#include <string.h>

// Of a polygon whose rings are made.
enum {
    RING_CHANGES = 1,   // its ring is not that of the rings before
    RING_HAS_POINTS = 2 // of its own: they are not its corners
};

void tl_nav_set_edge(const tl_nav_rings *rings, uint64_t place, tl_nav_ring_edge edge)
{
    if (rings->has_wide_edges) {
        rings->edges.wide[place] = edge;
    } else {
        rings->edges.narrow[place].to = (int16_t)(uint16_t)edge.to;
        rings->edges.narrow[place].mark = (uint16_t)edge.mark;
    }
}

tl_nav_ring_edge tl_nav_edge_of(const tl_nav_rings *rings, uint64_t place)
{
    return tl_nav_edge_at(rings->edges, rings->has_wide_edges, place);
}

uint32_t tl_nav_ring_first(const tl_nav_rings *rings, uint32_t polygon)
{
    return rings->has_wide_firsts ? ((const uint32_t *)rings->first)[polygon]
                                  : ((const uint16_t *)rings->first)[polygon];
}

uint32_t tl_nav_ring_first_point(const tl_nav_rings *rings, uint32_t polygon)
{
    return rings->has_wide_firsts ? ((const uint32_t *)rings->first_point)[polygon]
                                  : ((const uint16_t *)rings->first_point)[polygon];
}

uint32_t tl_nav_inner_twin(const tl_nav_rings *rings, uint32_t polygon, uint32_t edge)
{
    const uint32_t twin =
        tl_nav_edge_of(rings, (uint64_t)tl_nav_ring_first(rings, polygon) + edge).mark & TL_NAV_RING_FAR_TWIN;
    return twin < TL_NAV_RING_FAR_TWIN ? twin : tl_nav_find_far_twin(rings, polygon, edge);
}

void tl_nav_set_ring_number(const tl_nav_rings *rings, tl_nav_ring_numbers numbers, uint32_t i, uint32_t number)
{
    if (rings->is_wide) {
        numbers.wide[i] = number;
    } else {
        numbers.narrow[i] = (uint16_t)number;
    }
}

static bool is_same_vertex(tl_vec3 a, tl_vec3 b)
{
    return a.x == b.x && a.z == b.z;
}

// Vertices that a polygon had before keep their walls: for now by their place among the old ones.
static void copy_walls(tl_nav_rings *rings, const tl_nav_rings *old, uint32_t polygon)
{
    const tl_nav_ring before = tl_nav_ring_of(old, polygon), now = tl_nav_ring_of(rings, polygon);
    for (uint32_t k = 0; k < now.count; k++) {
        tl_nav_ring_edge edge = tl_nav_ring_edge_at(&now, k);
        for (uint32_t i = 0; i < before.count; i++) {
            if (is_same_vertex(before.points[i], now.points[k])) {
                edge.mark = (tl_nav_ring_edge_at(&before, i).mark & ~(uint32_t)TL_NAV_RING_FAR_TWIN) |
                            tl_nav_ring_twin_hint(edge);
            }
        }
        tl_nav_set_edge(rings, now.first + k, edge);
    }
}

// The place of an edge in the ring of the polygon across, which is of the same tile; none before `from`.
static inline uint32_t find_twin(const tl_nav_rings *rings, tl_nav_ring ring, uint32_t polygon, uint32_t edge,
                                 uint32_t from)
{
    const tl_nav_ring across = tl_nav_ring_of(rings, tl_nav_ring_to(&ring, edge));
    const tl_vec3 end = ring.points[edge + 1 < ring.count ? edge + 1 : 0];
    uint32_t twin = from;
    while (twin + 1 < across.count &&
           (tl_nav_ring_to(&across, twin) != polygon || !is_same_vertex(across.points[twin], end))) {
        twin++;
    }
    TL_ASSERT(tl_nav_ring_to(&across, twin) == polygon);
    return twin;
}

static void set_twin(const tl_nav_rings *rings, uint64_t place, uint32_t twin)
{
    tl_nav_set_edge(rings, place, tl_nav_with_twin(tl_nav_edge_of(rings, place), twin));
}

// Within a tile: where each edge of a polygon stands in the ring across it, and that one in this.
static void find_twins(tl_nav_rings *rings, uint32_t polygon)
{
    const tl_nav_ring ring = tl_nav_ring_of(rings, polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        const uint32_t to = tl_nav_ring_to(&ring, i);
        if (to >= TL_NAV_RING_SEAM) {
            continue;
        }
        const uint32_t twin = find_twin(rings, ring, polygon, i, 0);
        set_twin(rings, (uint64_t)ring.first + i, twin);
        set_twin(rings, (uint64_t)tl_nav_ring_first(rings, to) + twin, i);
    }
}

uint32_t tl_nav_find_far_twin(const tl_nav_rings *rings, uint32_t polygon, uint32_t edge)
{
    return find_twin(rings, tl_nav_ring_of(rings, polygon), polygon, edge, TL_NAV_RING_FAR_TWIN);
}

static size_t number_size(const tl_nav_rings *rings)
{
    return rings->is_wide ? sizeof *rings->component.wide : sizeof *rings->component.narrow;
}

// Labels the connected components of the tile. `stack` holds polygon_count numbers.
static void label_components(tl_nav_rings *rings, uint32_t *stack)
{
    const uint32_t none = rings->is_wide ? UINT32_MAX : UINT16_MAX;
    memset(rings->component.narrow, 0xff, rings->polygon_count * number_size(rings));
    for (uint32_t p = 0; p < rings->polygon_count; p++) {
        if (tl_nav_component_of(rings, p) != none) {
            continue;
        }
        uint32_t label = rings->component_count++;
        uint32_t depth = 0;
        stack[depth++] = p;
        tl_nav_set_ring_number(rings, rings->component, p, label);
        tl_nav_set_ring_number(rings, rings->component, rings->polygon_count + p, p);
        while (depth > 0) {
            const tl_nav_ring ring = tl_nav_ring_of(rings, stack[--depth]);
            for (uint32_t i = 0; i < ring.count; i++) {
                const uint32_t to = tl_nav_ring_to(&ring, i);
                if (to < TL_NAV_RING_SEAM && tl_nav_component_of(rings, to) == none) {
                    tl_nav_set_ring_number(rings, rings->component, to, label);
                    tl_nav_set_ring_number(rings, rings->component, rings->polygon_count + to,
                                           tl_nav_next_member(rings, p));
                    tl_nav_set_ring_number(rings, rings->component, rings->polygon_count + p, to);
                    stack[depth++] = to;
                }
            }
        }
    }
}

static uint32_t component_bits(const tl_nav_rings *rings, uint32_t of_node)
{
    return (of_node & TL_NAV_MIXED_COMPONENTS) != 0 ? of_node : tl_nav_component_bit(rings, of_node);
}

// From the leaves up: a node's children stand behind it.
static void label_tree_nodes(const tl_nav_tile *tile, tl_nav_rings *rings)
{
    const tl_nav_tile_node *nodes = tl_nav_tile_nodes(tile);
    const uint32_t mixed = rings->is_wide ? TL_NAV_MIXED_COMPONENTS : TL_NAV_MAX_SHORT_NUMBER + 1u;
    for (uint32_t i = tile->node_count; i > 0; i--) {
        const uint32_t node = i - 1;
        if ((nodes[node].link & TL_NAV_NODE_LEAF) != 0) {
            const uint32_t polygon = nodes[node].link & ~TL_NAV_NODE_LEAF;
            tl_nav_set_ring_number(rings, rings->node_component, node, tl_nav_component_of(rings, polygon));
        } else {
            const uint32_t first = tl_nav_node_component(rings, node + 1);
            const uint32_t second = tl_nav_node_component(rings, tl_nav_tile_node_skip(nodes, node + 1));
            const uint32_t bits = component_bits(rings, first) | component_bits(rings, second);
            const bool is_one = first == second && (first & TL_NAV_MIXED_COMPONENTS) == 0;
            tl_nav_set_ring_number(rings, rings->node_component, node,
                                   is_one ? first : mixed | (bits & ~TL_NAV_MIXED_COMPONENTS));
        }
    }
}

// Bytes of the edges; what stands behind them has numbers of 32 bits.
static uint64_t edges_size(const tl_nav_rings *rings)
{
    return rings->edge_count * (uint64_t)(rings->has_wide_edges ? sizeof(tl_nav_ring_edge) : sizeof(tl_nav_short_edge));
}

// Bytes of `first` and `first_point`, where they are not the tile's.
static uint64_t firsts_size(const tl_nav_rings *rings)
{
    return rings->point_count > 0 ? 2 * ((uint64_t)rings->polygon_count + 1) * sizeof(uint32_t) : 0;
}

static uint64_t block_size_of(const tl_nav_rings *rings)
{
    return edges_size(rings) + rings->point_count * (uint64_t)sizeof(tl_vec3) +
           rings->seam_count * (uint64_t)sizeof(tl_nav_ring_seam) + firsts_size(rings) +
           (3 * (uint64_t)rings->polygon_count + rings->node_count) * number_size(rings);
}

uint64_t tl_nav_rings_size(const tl_nav_rings *rings)
{
    return block_size_of(rings);
}

// Where the arrays stand in their block, one behind the other: the widest alignment any of them needs is that of their
// numbers. Returns `first` where it is not the tile's, else NULL.
static uint32_t *place_arrays(tl_nav_rings *rings, void *block)
{
    char *at = (char *)block;
    rings->edges.wide = (tl_nav_ring_edge *)block;
    at += edges_size(rings);
    rings->points[1] = (const tl_vec3 *)(void *)at;
    at += rings->point_count * sizeof(tl_vec3);
    rings->seams = (tl_nav_ring_seam *)(void *)at;
    at += rings->seam_count * sizeof(tl_nav_ring_seam);
    uint32_t *first = firsts_size(rings) > 0 ? (uint32_t *)(void *)at : NULL;
    if (first != NULL) {
        rings->first = first;
        rings->first_point = first + rings->polygon_count + 1;
    }
    at += firsts_size(rings);
    const size_t size = rings->polygon_count * number_size(rings);
    rings->component.wide = (uint32_t *)(void *)at;
    rings->branch.wide = (uint32_t *)(void *)(at + 2 * size); // behind the next members
    rings->node_component.wide = (uint32_t *)(void *)(at + 3 * size);
    return first;
}

// The polygons whose rings change: those on a side, or without rings from before all.
static void mark_changed(const tl_nav_tile *tile, uint32_t side, const tl_nav_rings *old, uint32_t *marks)
{
    const tl_nav_portal *portals = tl_nav_tile_portals(tile);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        marks[p] = old == NULL ? RING_CHANGES : 0;
    }
    for (uint32_t i = tl_nav_tile_side_first(tile, side); i < tl_nav_tile_side_first(tile, side + 1); i++) {
        marks[portals[i].polygon] = RING_CHANGES;
    }
}

// The changed polygons' rings anew, all others' as they were. `writer`: to count, then to write.
static void write_rings(tl_nav_ring_writer *writer, const tl_nav_tile *tile,
                        const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t *marks, const tl_nav_rings *old)
{
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        const bool changes = (marks[p] & RING_CHANGES) != 0;
        writer->has_points = (marks[p] & RING_HAS_POINTS) != 0;
        if (changes) {
            tl_nav_write_ring(writer, tile, sides, p);
        } else {
            tl_nav_write_same_ring(writer, old, p);
        }
        if (writer->first != NULL) {
            writer->first[p] = (uint32_t)writer->edge_count;
            writer->first_point[p] = writer->has_points ? (uint32_t)writer->point_count | TL_NAV_RING_OWN_POINTS
                                                        : tl_nav_tile_first(tile, tile->detail_first_vertex, p);
        }
        marks[p] |= writer->has_points ? RING_HAS_POINTS : 0;
        writer->edge_count += writer->count;
        writer->point_count += writer->has_points ? writer->count : 0;
    }
    if (writer->first != NULL) {
        writer->first[tile->polygon_count] = (uint32_t)writer->edge_count;
        writer->first_point[tile->polygon_count] = 0;
    }
}

// `counted`: what a writer without arrays has counted.
static tl_result fill_rings(const tl_allocator *allocator, const tl_nav_tile *tile,
                            const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t *marks, const tl_nav_rings *old,
                            const tl_nav_ring_writer *counted, tl_nav_rings *rings)
{
    rings->edge_count = (uint32_t)counted->edge_count;
    rings->seam_count = (uint32_t)counted->seam_count;
    rings->point_count = (uint32_t)counted->point_count;
    rings->has_wide_edges = true;
    void *block = tl_allocate_array(allocator, block_size_of(rings), 1);
    if (block == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_nav_ring_writer writer;
    memset(&writer, 0, sizeof writer);
    writer.mode = TL_NAV_RINGS_WRITE;
    writer.rings = rings;
    writer.first = place_arrays(rings, block);
    writer.first_point = writer.first != NULL ? writer.first + rings->polygon_count + 1 : NULL;
    writer.points = (tl_vec3 *)(void *)((char *)block + edges_size(rings));
    write_rings(&writer, tile, sides, marks, old);
    rings->has_back = writer.has_back;
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        if ((marks[p] & RING_CHANGES) != 0) {
            if (old != NULL) {
                copy_walls(rings, old, p);
            }
            find_twins(rings, p);
        }
    }
    return TL_OK;
}

// Components do not depend on seams.
static void copy_components(const tl_nav_rings *old, tl_nav_rings *rings)
{
    const size_t size = rings->polygon_count * number_size(rings);
    memcpy(rings->component.narrow, old->component.narrow, 2 * size);
    memcpy(rings->node_component.narrow, old->node_component.narrow, rings->node_count * number_size(rings));
    rings->component_count = old->component_count;
}

static uint64_t walls_size(const tl_nav_rings *rings)
{
    return rings->walls_count * (uint64_t)(sizeof *rings->walls + sizeof *rings->turns) +
           rings->component_count * (uint64_t)sizeof(uint32_t) + rings->branch_count * sizeof *rings->branch_end;
}

static void place_walls(tl_nav_rings *rings, void *block)
{
    rings->walls = (tl_nav_ring_walls *)block;
    rings->turns = (uint32_t *)(void *)(rings->walls + rings->walls_count);
    rings->branch_end = tl_nav_ring_islands(rings) + rings->component_count;
}

// Gives all vertices their walls: those of old rings, where edges name some, and others that are not known yet.
static tl_result make_walls(const tl_allocator *allocator, const tl_nav_rings *old, const uint32_t *branch_end,
                            tl_nav_rings *rings)
{
    const uint64_t edges = rings->edge_count;
    uint32_t *walls_of = tl_allocate_array(allocator, edges, sizeof *walls_of);
    if (walls_of == NULL) {
        return TL_ERR_MEMORY;
    }
    rings->walls_count = tl_nav_assign_walls(rings, walls_of);
    const bool fits = rings->walls_count < TL_NAV_RING_MAX_WALLS;
    void *block = fits ? tl_allocate_array(allocator, walls_size(rings), 1) : NULL;
    if (block != NULL) {
        memset(block, 0, (size_t)walls_size(rings));
        place_walls(rings, block);
        memcpy(rings->branch_end, branch_end, rings->branch_count * sizeof *rings->branch_end);
        if (old != NULL) {
            memcpy(tl_nav_ring_islands(rings), tl_nav_ring_islands(old), rings->component_count * sizeof(uint32_t));
        }
        rings->walls[TL_NAV_WALLS_CONVEX].first_x = 1.0f;
        for (uint64_t k = 0; k < edges; k++) {
            tl_nav_ring_edge edge = tl_nav_edge_of(rings, k);
            const uint32_t before = tl_nav_walls_number(edge);
            if (old != NULL && before >= TL_NAV_WALLS_FIRST && walls_of[k] >= TL_NAV_WALLS_FIRST) {
                rings->walls[walls_of[k]] = old->walls[before];
                rings->turns[walls_of[k]] = old->turns[before];
            }
            edge.mark = walls_of[k] << TL_NAV_RING_TWIN_BITS | tl_nav_ring_twin_hint(edge);
            tl_nav_set_edge(rings, k, edge);
        }
    }
    tl_release_array(allocator, walls_of, edges, sizeof *walls_of);
    return rings->walls != NULL ? TL_OK : fits ? TL_ERR_MEMORY : TL_ERR_LIMIT;
}

// The block of rings, with edges of one kind, in memory of its own. TL_ERR_MEMORY: nothing is changed.
static tl_result copy_block(const tl_allocator *allocator, bool has_wide_edges, tl_nav_rings *rings)
{
    tl_nav_rings copy = *rings;
    copy.has_wide_edges = has_wide_edges;
    const uint64_t size = block_size_of(&copy);
    void *block = tl_allocate_array(allocator, size, 1);
    if (block == NULL) {
        return TL_ERR_MEMORY;
    }
    place_arrays(&copy, block);
    const uint64_t old_edges = edges_size(rings), new_edges = edges_size(&copy);
    memcpy((char *)block + new_edges, (const char *)rings->edges.wide + old_edges, (size_t)(size - new_edges));
    for (uint32_t k = 0; k < rings->edge_count; k++) {
        tl_nav_set_edge(&copy, k, tl_nav_edge_of(rings, k));
    }
    tl_release_array(allocator, rings->edges.wide, tl_nav_rings_size(rings), 1);
    *rings = copy;
    return TL_OK;
}

// Rings are made with wide edges: how many walls there are is known at the end.
static tl_result narrow_edges(const tl_allocator *allocator, tl_nav_rings *rings)
{
    const bool are_short =
        !rings->is_wide && rings->seam_count <= TL_NAV_SHORT_SEAMS && rings->walls_count <= TL_NAV_SHORT_WALLS;
    return are_short ? copy_block(allocator, false, rings) : TL_OK;
}

static tl_result make_rings(const tl_allocator *allocator, const tl_nav_tile *tile,
                            const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], const tl_nav_rings *old,
                            uint32_t *scratch, tl_nav_rings *rings)
{
    tl_nav_ring_writer counted;
    memset(&counted, 0, sizeof counted);
    counted.rings = rings;
    write_rings(&counted, tile, sides, scratch, old);
    if (counted.edge_count > UINT32_MAX || counted.seam_count >= TL_NAV_RING_BACK - TL_NAV_RING_SEAM ||
        counted.point_count >= TL_NAV_RING_OWN_POINTS || tile->detail_vertex_count >= TL_NAV_RING_OWN_POINTS) {
        return TL_ERR_LIMIT;
    }
    rings->polygon_count = tile->polygon_count;
    rings->node_count = tile->node_count;
    rings->is_wide = tile->polygon_count > TL_NAV_MAX_SHORT_NUMBER;
    rings->has_wide_firsts = counted.point_count > 0 || (tile->wide & TL_NAV_WIDE_FIRSTS) != 0;
    rings->first = tl_nav_tile_at(tile, tile->first_corner);
    rings->first_point = tl_nav_tile_at(tile, tile->detail_first_vertex);
    rings->points[0] = (const tl_vec3 *)tl_nav_tile_at(tile, tile->detail_vertices);
    TL_TRY(fill_rings(allocator, tile, sides, scratch, old, &counted, rings));
    TL_ASSERT(tl_nav_ring_first(rings, tile->polygon_count) == rings->edge_count);
    if (old != NULL) {
        copy_components(old, rings);
    } else {
        label_components(rings, scratch);
        label_tree_nodes(tile, rings);
    }
    const uint32_t *branch_end = tl_nav_find_branches(rings, scratch);
    TL_TRY(make_walls(allocator, old, branch_end, rings));
    return narrow_edges(allocator, rings);
}

tl_result tl_nav_rings_make(const tl_allocator *allocator, const tl_nav_tile *tile,
                            const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], const tl_nav_rings *old,
                            uint32_t changed_side, tl_nav_rings *rings_out)
{
    memset(rings_out, 0, sizeof *rings_out);
    tl_nav_rings rings;
    memset(&rings, 0, sizeof rings);
    const uint64_t scratch_count = TL_NAV_BRANCH_SCRATCH * (uint64_t)tile->polygon_count + 1;
    uint32_t *scratch = tl_allocate_array(allocator, scratch_count, sizeof *scratch);
    if (scratch == NULL) {
        return TL_ERR_MEMORY;
    }
    mark_changed(tile, changed_side, old, scratch);
    const tl_result result = make_rings(allocator, tile, sides, old, scratch, &rings);
    tl_release_array(allocator, scratch, scratch_count, sizeof *scratch);
    if (result != TL_OK) {
        tl_nav_rings_free(allocator, &rings);
        return result;
    }
    *rings_out = rings;
    return TL_OK;
}

void tl_nav_rings_free(const tl_allocator *allocator, tl_nav_rings *rings)
{
    tl_release_array(allocator, rings->walls, walls_size(rings), 1);
    if (rings->edges.wide != NULL) {
        tl_release_array(allocator, rings->edges.wide, tl_nav_rings_size(rings), 1);
    }
    memset(rings, 0, sizeof *rings);
}

tl_result tl_nav_rings_copy(const tl_allocator *allocator, tl_nav_rings *rings)
{
    void *walls = tl_allocate_array(allocator, walls_size(rings), 1);
    const tl_result result = walls != NULL ? copy_block(allocator, rings->has_wide_edges, rings) : TL_ERR_MEMORY;
    if (result != TL_OK) {
        tl_release_array(allocator, walls, walls_size(rings), 1);
        return result;
    }
    memcpy(walls, rings->walls, (size_t)walls_size(rings));
    tl_release_array(allocator, rings->walls, walls_size(rings), 1);
    place_walls(rings, walls);
    return TL_OK;
}
