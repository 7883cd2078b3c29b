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
#include "base/min_max.h"

#include <math.h>
#include <string.h>

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

static tl_result find_edited_slots(tl_nav_graph_changes *c)
{
    const tl_navmesh *navmesh = c->navmesh;
    for (uint32_t slot = 0; slot < c->graph->slot_count; slot++) {
        const uint32_t salt = salt_of(navmesh, slot);
        if (salt != c->graph->tiles[slot].salt) {
            TL_TRY(tl_nav_note_slot(c, slot, TL_NAV_SLOT_OTHER | TL_NAV_SLOT_CONES | TL_NAV_SLOT_SIGHTS));
        } else if (salt != 0 && navmesh->slots[slot].last_edit.number > navmesh->graph_edit) {
            TL_TRY(tl_nav_note_slot(c, slot, TL_NAV_SLOT_EDITED));
        }
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Corner vertices that are gone.

// Corner vertices of a tile that stayed: those with names that are still there find their places in its rings again, in
// which edges may have been cut anew. The others are marked as gone.
static void find_places(tl_nav_graph_changes *c, uint32_t slot)
{
    tl_nav_visibility_graph *graph = c->graph;
    const tl_nav_rings *rings = &c->navmesh->slots[slot].rings;
    for (uint32_t v = graph->tiles[slot].first_vertex; v != TL_NAV_NO_VERTEX; v = graph->vertices[v].next) {
        graph->marks[v] = TL_NAV_MARK_GONE;
    }
    for (uint32_t p = 0; p < rings->polygon_count; p++) {
        const tl_nav_ring ring = tl_nav_ring_of(rings, p);
        for (uint32_t i = 0; i < ring.count; i++) {
            const uint32_t turn = tl_nav_turn_of(rings, tl_nav_ring_edge_at(&ring, i));
            const uint32_t v = turn != 0 ? tl_nav_find_name(&graph->names, turn) : TL_NAV_NO_VERTEX;
            if (v != TL_NAV_NO_VERTEX && graph->marks[v] == TL_NAV_MARK_GONE && graph->vertices[v].place.slot == slot) {
                tl_nav_ring_place place = { slot, p, i };
                tl_nav_find_fan(c->navmesh, NULL, &place);
                if (place.slot == slot) {
                    graph->vertices[v].place = place;
                    graph->marks[v] = TL_NAV_MARK_NONE;
                }
            }
        }
    }
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

static tl_result find_gone(tl_nav_graph_changes *c)
{
    tl_nav_visibility_graph *graph = c->graph;
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i];
        if ((c->slot_bits[slot] & TL_NAV_SLOT_EDITED) != 0) {
            find_places(c, slot);
        }
        for (uint32_t v = graph->tiles[slot].first_vertex;
             v != TL_NAV_NO_VERTEX && (c->slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0; v = graph->vertices[v].next) {
            graph->marks[v] = TL_NAV_MARK_GONE;
        }
        TL_TRY(list_gone(c, slot));
    }
    return TL_OK;
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

// Whether an edge may have been another before an edit beside its tile.
static bool may_edge_be_new(const tl_nav_graph_changes *c, uint32_t slot, tl_nav_ring_edge edge)
{
    const uint32_t turn = tl_nav_turn_of(&c->navmesh->slots[slot].rings, edge);
    if (turn != 0 && tl_nav_find_name(&c->graph->names, turn) == TL_NAV_NO_VERTEX) {
        return true;
    }
    if (!tl_nav_ring_is_open(edge.to)) {
        return tl_nav_ring_twin_hint(edge) == TL_NAV_RING_ON_PORTAL;
    }
    return (edge.to & TL_NAV_RING_SEAM) != 0 &&
           (c->slot_bits[tl_nav_ring_across(c->navmesh, slot, edge.to).slot] & TL_NAV_SLOT_OTHER) != 0;
}

static bool may_be_new(const tl_nav_graph_changes *c, uint32_t slot, uint32_t polygon)
{
    const tl_nav_ring ring = tl_nav_ring_at(c->navmesh, slot, polygon);
    for (uint32_t i = 0; i < ring.count; i++) {
        if (may_edge_be_new(c, slot, tl_nav_ring_edge_at(&ring, i))) {
            return true;
        }
    }
    return false;
}

// Those whose cones lie in polygons that may have changed.
static tl_result find_onlookers(tl_nav_graph_changes *c, uint32_t slot)
{
    const tl_nav_corner_cones *cones = &c->graph->tiles[slot].cones;
    const bool stays = (c->slot_bits[slot] & TL_NAV_SLOT_EDITED) != 0;
    for (uint32_t p = 0; p < cones->polygon_count; p++) {
        if (stays && !may_be_new(c, slot, p)) {
            continue;
        }
        TL_TRY(stays ? tl_nav_add_pair(c->allocator, &c->polygons, slot, p) : TL_OK);
        for (uint32_t i = cones->first[p]; i < cones->first[p + 1]; i++) {
            TL_TRY(let_look(c, tl_nav_cone_vertex(cones, i)));
        }
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
    const tl_vec3 at = ring.points[place.edge];
    const uint32_t v = tl_nav_take_corner_vertex(graph);
    tl_nav_corner_vertex vertex = {
        at.x, at.y, at.z, tl_nav_turn_of(rings, edge), *tl_nav_walls_of(rings, edge), place, 0, 0, 0, NULL
    };
    tl_nav_find_fan(c->navmesh, NULL, &vertex.place);
    tl_nav_graph_tile *tile = &graph->tiles[vertex.place.slot];
    vertex.next = tile->first_vertex;
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
    for (uint64_t i = 0; i < c->slots.count; i++) {
        if ((c->slot_bits[c->slots.numbers[i]] & (TL_NAV_SLOT_OTHER | TL_NAV_SLOT_EDITED)) != 0) {
            TL_TRY(find_onlookers(c, c->slots.numbers[i]));
        }
    }
    TL_TRY(tl_nav_sort_pairs(c->allocator, &c->polygons, NULL));
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
    if (changes_out->slot_bits == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(changes_out->slot_bits, 0, graph->slot_count * sizeof *changes_out->slot_bits);
    return compare_graph(changes_out);
}

tl_nav_plan_box tl_nav_box_of_polygons(const tl_nav_rings *rings, uint32_t first, uint32_t count)
{
    tl_nav_plan_box box = { INFINITY, INFINITY, -INFINITY, -INFINITY };
    for (uint32_t p = first; p < first + count; p++) {
        const tl_nav_ring ring = tl_nav_ring_of(rings, p);
        for (uint32_t i = 0; i < ring.count; i++) {
            box.low_x = tl_min_f32(box.low_x, ring.points[i].x);
            box.low_z = tl_min_f32(box.low_z, ring.points[i].z);
            box.high_x = tl_max_f32(box.high_x, ring.points[i].x);
            box.high_z = tl_max_f32(box.high_z, ring.points[i].z);
        }
    }
    return box;
}

void tl_nav_settle_changes(const tl_nav_graph_changes *c)
{
    for (uint64_t i = 0; i < c->gone.count; i++) {
        c->graph->marks[c->gone.numbers[i]] = TL_NAV_MARK_NONE;
    }
    for (uint64_t i = 0; i < c->lookers.count; i++) {
        c->graph->marks[c->lookers.numbers[i]] = TL_NAV_MARK_NONE;
    }
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i];
        c->graph->tiles[slot].salt = salt_of(c->navmesh, slot);
        if ((c->slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0 && c->graph->tiles[slot].salt != 0) {
            const tl_nav_rings *rings = &c->navmesh->slots[slot].rings;
            c->graph->tiles[slot].box = tl_nav_box_of_polygons(rings, 0, rings->polygon_count);
        }
    }
}

void tl_nav_free_changes(tl_nav_graph_changes *c)
{
    tl_nav_free_numbers(c->allocator, &c->slots);
    tl_nav_free_numbers(c->allocator, &c->lookers);
    tl_release_array(c->allocator, c->gone_spots, c->gone.count, sizeof *c->gone_spots);
    tl_nav_free_numbers(c->allocator, &c->gone);
    tl_nav_free_pairs(c->allocator, &c->gone_sights);
    tl_nav_free_pairs(c->allocator, &c->polygons);
    tl_release_array(c->allocator, c->slot_bits, c->graph->slot_count, sizeof *c->slot_bits);
}
