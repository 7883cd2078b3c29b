// SPDX-License-Identifier: MIT
//
// What edits leave of a visibility graph: the edges and cones of all corner vertices that cannot see the change.
//
// A tile that came or went is known by its slot's salt, and a slot keeps the number of the last edit that changed what
// a search sees in it (tl_nav_note_edit). Where the tile stayed, an edit beside it has changed no more than its
// polygons at portals that lead to tiles that came, or to none, and those at vertices with new names; names are handed
// out once, so the same name means the same vertex. A corner vertex sees what it saw where none of its cones, which
// hold all that it can turn from or to, lies in a polygon that may have changed, and where all vertices at the ends of
// its edges still have their names. The others look around anew.
//
// What is asked of the world as a whole is one comparison a slot. All else goes by lists: from the polygons that
// changed to the corner vertices whose cones are there, and from those that are gone along their edges.

#include "nav_query/mending/graph_changes.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/hash.h"
#include "base/min_max.h"
#include "nav_query/mending/known_rings.h"

#include <math.h>
#include <string.h>

#define SLOT_IS_OTHER (TL_NAV_SLOT_OTHER | TL_NAV_SLOT_CONES | TL_NAV_SLOT_SIGHTS)

tl_result tl_nav_note_slot(tl_nav_graph_changes *c, uint32_t slot, uint32_t bits)
{
    if (c->slot_bits[slot] == 0) {
        TL_TRY(tl_nav_add_number(c->allocator, &c->slots, slot));
    }
    c->slot_bits[slot] = (uint8_t)(c->slot_bits[slot] | bits);
    return TL_OK;
}

static uint32_t salt_of(const tl_navmesh *navmesh, uint32_t slot)
{
    return slot < navmesh->slot_count && navmesh->slots[slot].tile != NULL ? navmesh->slots[slot].salt : 0;
}

// The polygons of a slot whose tile is another now: which of them are there still.
static tl_result map_slot(tl_nav_graph_changes *c, uint32_t slot)
{
    const tl_nav_known_rings *known = &c->graph->tiles[slot].rings;
    const uint64_t first = c->map.count;
    c->first_map[slot] = (uint32_t)first;
    TL_TRY(tl_nav_map_polygons(c->navmesh, known, slot, &c->map));
    const uint32_t count = c->navmesh->slots[slot].rings.polygon_count;
    bool moves = known->polygon_count != count;
    for (uint32_t p = 0; p < count; p++) {
        TL_TRY(tl_nav_add_number(c->allocator, &c->map, TL_NO_POLYGON));
    }
    for (uint32_t p = 0; p < known->polygon_count; p++) {
        const uint32_t now = c->map.numbers[first + p];
        moves = moves || now != p;
        if (now != TL_NO_POLYGON) {
            c->map.numbers[first + known->polygon_count + now] = p;
        }
    }
    return moves ? tl_nav_note_slot(c, slot, TL_NAV_SLOT_MAPPED | TL_NAV_SLOT_CONES) : TL_OK;
}

static tl_result find_edited_slots(tl_nav_graph_changes *c)
{
    const tl_navmesh *navmesh = c->navmesh;
    for (uint32_t slot = 0; slot < c->graph->slot_count; slot++) {
        const uint32_t salt = salt_of(navmesh, slot), before = c->graph->tiles[slot].salt;
        if (salt != before) {
            const bool is_other = salt == 0 || before == 0;
            TL_TRY(tl_nav_note_slot(c, slot, is_other ? SLOT_IS_OTHER : TL_NAV_SLOT_EDITED));
            TL_TRY(is_other ? TL_OK : map_slot(c, slot));
        } else if (salt != 0 && navmesh->slots[slot].last_edit.number > navmesh->graph_edit) {
            TL_TRY(tl_nav_note_slot(c, slot, TL_NAV_SLOT_EDITED));
        }
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Corner vertices that are gone.

static uint32_t key_of_vertex(tl_vec3 at, const tl_nav_ring_walls *walls)
{
    const float values[7] = { at.x, at.y, at.z, walls->first_x, walls->first_z, walls->last_x, walls->last_z };
    return (uint32_t)tl_hash_bytes(values, sizeof values, 0);
}

static bool stands_at(const tl_nav_corner_vertex *vertex, tl_vec3 at, const tl_nav_ring_walls *walls)
{
    return vertex->x == at.x && vertex->y == at.y && vertex->z == at.z && vertex->walls.first_x == walls->first_x &&
           vertex->walls.first_z == walls->first_z && vertex->walls.last_x == walls->last_x &&
           vertex->walls.last_z == walls->last_z;
}

// All corner vertices of slots with changes, by key, each marked as gone until it is found.
static tl_result list_known(tl_nav_graph_changes *c, tl_nav_pair_list *known)
{
    tl_nav_visibility_graph *graph = c->graph;
    for (uint64_t i = 0; i < c->slots.count; i++) {
        for (uint32_t v = graph->tiles[c->slots.numbers[i]].first_vertex; v != TL_NAV_NO_VERTEX;
             v = graph->vertices[v].next) {
            const tl_nav_corner_vertex *vertex = &graph->vertices[v];
            graph->marks[v] = TL_NAV_MARK_GONE;
            TL_TRY(tl_nav_add_pair(c->allocator, known,
                                   key_of_vertex(tl_vec3_make(vertex->x, vertex->y, vertex->z), &vertex->walls), v));
        }
    }
    return tl_nav_sort_pairs(c->allocator, known, NULL);
}

// A corner vertex that has its old name, or stands as another did between the same walls. TL_NAV_NO_VERTEX: there is
// none, or it is found already.
static uint32_t find_known(const tl_nav_graph_changes *c, const tl_nav_pair_list *known, uint32_t turn, tl_vec3 at,
                           const tl_nav_ring_walls *walls)
{
    const tl_nav_visibility_graph *graph = c->graph;
    const uint32_t named = tl_nav_find_name(&graph->names, turn);
    if (named != TL_NAV_NO_VERTEX) {
        return graph->marks[named] == TL_NAV_MARK_GONE ? named : TL_NAV_NO_VERTEX;
    }
    const uint32_t key = key_of_vertex(at, walls);
    for (uint64_t i = tl_nav_find_pair(known, key); i < known->count && known->items[i].key >> 32 == key; i++) {
        const uint32_t v = (uint32_t)known->items[i].key;
        if (graph->marks[v] == TL_NAV_MARK_GONE && stands_at(&graph->vertices[v], at, walls)) {
            return v;
        }
    }
    return TL_NAV_NO_VERTEX;
}

// Where the fan begins around the vertex where an edge starts; and how high it is there, whichever tile asked.
static tl_vec3 begin_of_fan(const tl_navmesh *navmesh, tl_nav_ring_place *place)
{
    tl_nav_find_fan(navmesh, NULL, place);
    return tl_nav_ring_at(navmesh, place->slot, place->polygon).points[place->edge];
}

static tl_result find_vertex(tl_nav_graph_changes *c, tl_nav_ring_place place, tl_nav_ring_edge edge,
                             const tl_nav_pair_list *known)
{
    tl_nav_visibility_graph *graph = c->graph;
    const tl_nav_rings *rings = &c->navmesh->slots[place.slot].rings;
    const uint32_t turn = tl_nav_turn_of(rings, edge);
    const tl_vec3 at = begin_of_fan(c->navmesh, &place);
    const uint32_t v = find_known(c, known, turn, at, tl_nav_walls_of(rings, edge));
    if (v == TL_NAV_NO_VERTEX || place.slot != graph->vertices[v].place.slot) {
        return TL_OK;
    }
    tl_nav_corner_vertex *vertex = &graph->vertices[v];
    vertex->place = place;
    graph->marks[v] = TL_NAV_MARK_NONE;
    if (vertex->turn != turn) {
        tl_nav_drop_name(&graph->names, vertex->turn);
        vertex->turn = turn;
        return tl_nav_set_name(c->allocator, &graph->names, turn, v);
    }
    return TL_OK;
}

static tl_result find_vertices(tl_nav_graph_changes *c, uint32_t slot, const tl_nav_pair_list *known)
{
    const tl_nav_rings *rings = &c->navmesh->slots[slot].rings;
    for (uint32_t p = 0; p < rings->polygon_count; p++) {
        const tl_nav_ring ring = tl_nav_ring_of(rings, p);
        for (uint32_t i = 0; i < ring.count; i++) {
            const tl_nav_ring_place place = { slot, p, i };
            const tl_nav_ring_edge edge = tl_nav_ring_edge_at(&ring, i);
            TL_TRY(tl_nav_turn_of(rings, edge) != 0 ? find_vertex(c, place, edge, known) : TL_OK);
        }
    }
    return TL_OK;
}

// Takes the corner vertices that are marked as gone from a tile's list.
static tl_result list_gone(tl_nav_graph_changes *c, uint32_t slot)
{
    tl_nav_visibility_graph *graph = c->graph;
    uint32_t *at = &graph->tiles[slot].first_vertex;
    while (*at != TL_NAV_NO_VERTEX) {
        const uint32_t v = *at;
        if (graph->marks[v] == TL_NAV_MARK_GONE) {
            *at = graph->vertices[v].next;
            TL_TRY(tl_nav_add_number(c->allocator, &c->gone, v));
            TL_TRY(tl_nav_note_slot(c, slot, TL_NAV_SLOT_SIGHTS));
        } else {
            at = &graph->vertices[v].next;
        }
    }
    return TL_OK;
}

static tl_result find_all_vertices(tl_nav_graph_changes *c, tl_nav_pair_list *known)
{
    TL_TRY(list_known(c, known));
    for (uint64_t i = 0; i < c->slots.count && known->count > 0; i++) {
        const uint32_t slot = c->slots.numbers[i];
        TL_TRY(salt_of(c->navmesh, slot) != 0 ? find_vertices(c, slot, known) : TL_OK);
    }
    for (uint64_t i = 0; i < c->slots.count; i++) {
        TL_TRY(list_gone(c, c->slots.numbers[i]));
    }
    return TL_OK;
}

static tl_result find_gone(tl_nav_graph_changes *c)
{
    tl_nav_pair_list known = { NULL, 0, 0 };
    const tl_result result = find_all_vertices(c, &known);
    tl_nav_free_pairs(c->allocator, &known);
    return result;
}

// ---------------------------------------------------------------------------------------------------------
// Corner vertices that look anew.

static tl_result let_look(tl_nav_graph_changes *c, uint32_t vertex)
{
    if (c->graph->marks[vertex] != TL_NAV_MARK_NONE) {
        return TL_OK;
    }
    c->graph->marks[vertex] = TL_NAV_MARK_LOOKS;
    c->graph->orders[vertex] = (uint32_t)c->lookers.count;
    return tl_nav_add_number(c->allocator, &c->lookers, vertex);
}

// Those that saw a corner vertex which is gone.
static tl_result drop_gone(tl_nav_graph_changes *c)
{
    c->gone_spots = tl_allocate_array(c->allocator, c->gone.count, sizeof *c->gone_spots);
    if (c->gone_spots == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint64_t i = 0; i < c->gone.count; i++) {
        const tl_nav_corner_vertex *vertex = &c->graph->vertices[c->gone.numbers[i]];
        const tl_nav_gone_spot spot = { vertex->x, vertex->z };
        c->gone_spots[i] = spot;
        for (uint32_t k = 0; k < vertex->edge_count; k++) {
            const uint32_t to = vertex->edges[k].to;
            TL_TRY(let_look(c, to));
            TL_TRY(c->graph->marks[to] == TL_NAV_MARK_LOOKS
                       ? tl_nav_add_pair(c->allocator, &c->gone_sights, to, (uint32_t)i)
                       : TL_OK);
        }
        for (uint32_t k = 0; k < vertex->reach_count; k++) {
            TL_TRY(tl_nav_note_slot(c, tl_nav_reach_of(vertex)[k], TL_NAV_SLOT_CONES));
        }
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Polygons that are what they were.

// Whether what lies across an edge is what lay there. Of two polygons that have no match none is that of another.
static bool leads_on_alike(const tl_nav_graph_changes *c, uint32_t slot, const tl_nav_known_edge *before, uint32_t to)
{
    const tl_nav_known_rings *known = &c->graph->tiles[slot].rings;
    if (!tl_nav_ring_is_open(before->to) || !tl_nav_ring_is_open(to)) {
        return tl_nav_ring_is_open(before->to) == tl_nav_ring_is_open(to);
    }
    tl_nav_ring_seam was = { slot, before->to };
    if (tl_nav_ring_is_seam(before->to)) {
        was = known->seams[tl_nav_ring_seam_number(before->to)];
    }
    const tl_nav_ring_seam is = tl_nav_ring_across(c->navmesh, slot, to);
    const bool stays = (c->slot_bits[was.slot] & TL_NAV_SLOT_OTHER) == 0;
    const uint32_t now = stays ? tl_nav_new_polygon(c, was.slot, was.polygon) : TL_NO_POLYGON;
    if (now != TL_NO_POLYGON) {
        return is.slot == was.slot && is.polygon == now;
    }
    return tl_nav_old_polygon(c, is.slot, is.polygon) == TL_NO_POLYGON;
}

// A corner vertex that is gone is none of the polygon's concern: who saw it looks there.
static bool is_edge_alike(const tl_nav_graph_changes *c, uint32_t slot, const tl_nav_known_edge *before,
                          tl_nav_ring_edge edge)
{
    const uint32_t turn = tl_nav_turn_of(&c->navmesh->slots[slot].rings, edge);
    const uint32_t v = turn != 0 ? tl_nav_find_name(&c->graph->names, turn) : TL_NAV_NO_VERTEX;
    const bool same_vertex =
        turn == 0 || (v != TL_NAV_NO_VERTEX && v == before->vertex && c->graph->marks[v] != TL_NAV_MARK_GONE);
    return same_vertex && leads_on_alike(c, slot, before, edge.to);
}

// Whether nothing that can be seen in a polygon, or through it, is another for what has changed of itself.
static bool is_polygon_alike(const tl_nav_graph_changes *c, uint32_t slot, uint32_t before, uint32_t polygon)
{
    const tl_nav_known_rings *known = &c->graph->tiles[slot].rings;
    const tl_nav_ring ring = tl_nav_ring_at(c->navmesh, slot, polygon);
    const tl_nav_known_edge *edges = known->edges + known->first[before];
    bool alike = tl_nav_has_known_points(known, before, &ring);
    for (uint32_t i = 0; i < ring.count && alike; i++) {
        alike = is_edge_alike(c, slot, &edges[i], tl_nav_ring_edge_at(&ring, i));
    }
    return alike;
}

// Lists the polygons of a slot that came, went or may have changed. Where none is what it was the tile is another.
static tl_result compare_slot(tl_nav_graph_changes *c, uint32_t slot)
{
    const uint64_t old_count = c->old_polygons.count, count = c->polygons.count;
    const tl_nav_known_rings *known = &c->graph->tiles[slot].rings;
    for (uint32_t p = 0; p < known->polygon_count; p++) {
        const uint32_t now = tl_nav_new_polygon(c, slot, p);
        if (now == TL_NO_POLYGON || !is_polygon_alike(c, slot, p, now)) {
            TL_TRY(tl_nav_add_pair(c->allocator, &c->old_polygons, slot, p));
            TL_TRY(now != TL_NO_POLYGON ? tl_nav_add_pair(c->allocator, &c->polygons, slot, now) : TL_OK);
        }
    }
    for (uint32_t p = 0; p < c->navmesh->slots[slot].rings.polygon_count; p++) {
        const bool is_fresh = tl_nav_old_polygon(c, slot, p) == TL_NO_POLYGON;
        TL_TRY(is_fresh ? tl_nav_add_pair(c->allocator, &c->polygons, slot, p) : TL_OK);
    }
    if (c->old_polygons.count - old_count == known->polygon_count) {
        c->old_polygons.count = old_count;
        c->polygons.count = count;
        c->slot_bits[slot] = SLOT_IS_OTHER;
    }
    return TL_OK;
}

// Those whose cones lie in a polygon that may have changed, by its old number.
static tl_result let_onlookers_look(tl_nav_graph_changes *c, uint32_t slot, uint32_t polygon)
{
    const tl_nav_corner_cones *cones = &c->graph->tiles[slot].cones;
    for (uint32_t i = cones->first[polygon]; i < cones->first[polygon + 1]; i++) {
        TL_TRY(let_look(c, tl_nav_cone_vertex(cones, i)));
    }
    return TL_OK;
}

static tl_result find_onlookers(tl_nav_graph_changes *c)
{
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i];
        TL_TRY((c->slot_bits[slot] & TL_NAV_SLOT_EDITED) != 0 ? compare_slot(c, slot) : TL_OK);
    }
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i];
        const bool is_other = (c->slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0;
        for (uint32_t p = 0; is_other && p < c->graph->tiles[slot].cones.polygon_count; p++) {
            TL_TRY(let_onlookers_look(c, slot, p));
        }
    }
    for (uint64_t i = 0; i < c->old_polygons.count; i++) {
        const uint64_t key = c->old_polygons.items[i].key;
        TL_TRY(let_onlookers_look(c, (uint32_t)(key >> 32), (uint32_t)key));
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// New corner vertices.

// Of a name that has been found.
#define NO_NUMBER_YET (TL_NAV_NO_VERTEX - 1)

// Where the names are that the graph does not know yet; each is known then.
static tl_result find_new_names(tl_nav_graph_changes *c, uint32_t slot, tl_nav_number_list *places)
{
    const tl_nav_rings *rings = &c->navmesh->slots[slot].rings;
    for (uint32_t p = 0; p < rings->polygon_count; p++) {
        const tl_nav_ring ring = tl_nav_ring_of(rings, p);
        for (uint32_t i = 0; i < ring.count; i++) {
            const uint32_t turn = tl_nav_turn_of(rings, tl_nav_ring_edge_at(&ring, i));
            if (turn == 0 || tl_nav_find_name(&c->graph->names, turn) != TL_NAV_NO_VERTEX) {
                continue;
            }
            TL_TRY(tl_nav_set_name(c->allocator, &c->graph->names, turn, NO_NUMBER_YET));
            TL_TRY(tl_nav_add_number(c->allocator, places, slot));
            TL_TRY(tl_nav_add_number(c->allocator, places, p));
            TL_TRY(tl_nav_add_number(c->allocator, places, i));
        }
    }
    return TL_OK;
}

static tl_result add_corner_vertex_at(tl_nav_graph_changes *c, tl_nav_ring_place place)
{
    tl_nav_visibility_graph *graph = c->graph;
    const tl_nav_rings *rings = &c->navmesh->slots[place.slot].rings;
    const tl_nav_ring ring = tl_nav_ring_of(rings, place.polygon);
    const tl_nav_ring_edge edge = tl_nav_ring_edge_at(&ring, place.edge);
    const uint32_t turn = tl_nav_turn_of(rings, edge);
    const tl_nav_ring_walls walls = *tl_nav_walls_of(rings, edge);
    const tl_vec3 at = begin_of_fan(c->navmesh, &place);
    const uint32_t v = tl_nav_take_corner_vertex(graph);
    tl_nav_graph_tile *tile = &graph->tiles[place.slot];
    const tl_nav_corner_vertex vertex = { at.x, at.y, at.z, turn, walls, place, tile->first_vertex, 0, 0, NULL };
    tile->first_vertex = v;
    graph->vertices[v] = vertex;
    graph->marks[v] = TL_NAV_MARK_FRESH;
    TL_TRY(tl_nav_set_name(c->allocator, &graph->names, vertex.turn, v));
    TL_TRY(tl_nav_note_slot(c, vertex.place.slot, TL_NAV_SLOT_SIGHTS));
    return tl_nav_add_number(c->allocator, &c->lookers, v);
}

static tl_result add_corner_vertices(tl_nav_graph_changes *c, tl_nav_number_list *places)
{
    const uint32_t changed = TL_NAV_SLOT_OTHER | TL_NAV_SLOT_EDITED;
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i];
        if ((c->slot_bits[slot] & changed) != 0 && salt_of(c->navmesh, slot) != 0) {
            TL_TRY(find_new_names(c, slot, places));
        }
    }
    TL_TRY(tl_nav_reserve_corner_vertices(c->allocator, c->graph, places->count / 3));
    for (uint64_t i = 0; i < places->count; i += 3) {
        const tl_nav_ring_place place = { places->numbers[i], places->numbers[i + 1], places->numbers[i + 2] };
        TL_TRY(add_corner_vertex_at(c, place));
    }
    return TL_OK;
}

static tl_result compare_graph(tl_nav_graph_changes *c)
{
    TL_TRY(find_edited_slots(c));
    TL_TRY(find_gone(c));
    for (uint64_t i = 0; i < c->gone.count; i++) {
        tl_nav_drop_name(&c->graph->names, c->graph->vertices[c->gone.numbers[i]].turn);
    }
    TL_TRY(drop_gone(c));
    TL_TRY(find_onlookers(c));
    for (uint64_t i = 0; i < c->lookers.count; i++) {
        TL_TRY(tl_nav_note_slot(c, c->graph->vertices[c->lookers.numbers[i]].place.slot, TL_NAV_SLOT_SIGHTS));
    }
    for (uint64_t i = 0; i < c->gone.count; i++) {
        tl_nav_give_corner_vertex(c->graph, c->gone.numbers[i]);
    }
    c->first_fresh = c->lookers.count;
    tl_nav_number_list places = { NULL, 0, 0 };
    const tl_result result = add_corner_vertices(c, &places);
    tl_nav_free_numbers(c->allocator, &places);
    return result;
}

tl_result tl_nav_find_changes(const tl_navmesh *navmesh, tl_nav_visibility_graph *graph,
                              tl_nav_graph_changes *changes_out)
{
    memset(changes_out, 0, sizeof *changes_out);
    changes_out->navmesh = navmesh;
    changes_out->allocator = &navmesh->allocator;
    changes_out->graph = graph;
    changes_out->slot_bits = tl_allocate_array(&navmesh->allocator, graph->slot_count, sizeof *changes_out->slot_bits);
    changes_out->first_map = tl_allocate_array(&navmesh->allocator, graph->slot_count, sizeof *changes_out->first_map);
    if (changes_out->slot_bits == NULL || changes_out->first_map == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(changes_out->slot_bits, 0, graph->slot_count * sizeof *changes_out->slot_bits);
    return compare_graph(changes_out);
}

tl_result tl_nav_settle_changes(const tl_nav_graph_changes *c)
{
    for (uint64_t i = 0; i < c->gone.count; i++) {
        c->graph->marks[c->gone.numbers[i]] = TL_NAV_MARK_NONE;
    }
    for (uint64_t i = 0; i < c->lookers.count; i++) {
        c->graph->marks[c->lookers.numbers[i]] = TL_NAV_MARK_NONE;
    }
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i];
        tl_nav_graph_tile *tile = &c->graph->tiles[slot];
        const bool is_edited = (c->slot_bits[slot] & (TL_NAV_SLOT_OTHER | TL_NAV_SLOT_EDITED)) != 0;
        tile->salt = salt_of(c->navmesh, slot);
        if (is_edited && tile->salt != 0) {
            TL_TRY(tl_nav_keep_rings(c->navmesh, c->graph, slot));
            tile->box = tl_nav_box_of_edges(tile->rings.edges, tile->rings.edge_count);
        } else if (is_edited) {
            c->graph->tile_bytes -= tl_nav_known_rings_size(&tile->rings);
            tl_nav_free_known_rings(c->allocator, &tile->rings);
        }
    }
    return TL_OK;
}

void tl_nav_free_changes(tl_nav_graph_changes *c)
{
    tl_nav_free_numbers(c->allocator, &c->slots);
    tl_nav_free_numbers(c->allocator, &c->lookers);
    tl_release_array(c->allocator, c->gone_spots, c->gone.count, sizeof *c->gone_spots);
    tl_nav_free_numbers(c->allocator, &c->gone);
    tl_nav_free_pairs(c->allocator, &c->gone_sights);
    tl_nav_free_pairs(c->allocator, &c->polygons);
    tl_nav_free_pairs(c->allocator, &c->old_polygons);
    tl_nav_free_numbers(c->allocator, &c->map);
    tl_release_array(c->allocator, c->first_map, c->graph->slot_count, sizeof *c->first_map);
    tl_release_array(c->allocator, c->slot_bits, c->graph->slot_count, sizeof *c->slot_bits);
}
