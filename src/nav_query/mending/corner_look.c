// SPDX-License-Identifier: MIT
//
// Looking around from a corner vertex: all that is visible is found once, by the wedges of the exact search.
//
// An edge needs two corner vertices that see one another, and at both ends walls on the side to which a path would
// turn: few lines of sight qualify.
//
// After an edit most look only in the directions in which they may see a change (change_sectors.c). Wedges that show
// none of these are not gone through, and cones are taken in the polygons alone that lie beyond a change: as they are
// seen now, or were seen before. The wedges that are left come in the same order as in a look all around.

#include "nav_query/mending/corner_look.h"

#include "base/arena.h"
#include "base/assert.h"
#include "nav_query/exact/wedge_sight.h"
#include "nav_query/search/query_memory.h"

#include <string.h>

// Wedges that one look around may need at first. It is doubled where that is too few.
enum { FIRST_WEDGES = 4096 };

static tl_result make_look_query(tl_nav_corner_look *look, uint32_t max_nodes)
{
    tl_nav_query_release(look->query);
    look->query = NULL;
    const tl_nav_query_sizes none = { 0, 0 };
    return tl_nav_query_allocate(max_nodes, none, look->ground->changes->allocator, &look->query);
}

static tl_result list_new_polygons(tl_nav_look_ground *ground)
{
    const tl_nav_graph_changes *c = ground->changes;
    uint64_t count = 0;
    for (uint32_t slot = 0; slot < c->graph->slot_count; slot++) {
        const bool is_there = slot < c->navmesh->slot_count && c->navmesh->slots[slot].tile != NULL;
        ground->first_polygon[slot] = (uint32_t)count;
        count += is_there ? c->navmesh->slots[slot].rings.polygon_count : 0;
        if (count > UINT32_MAX) {
            return TL_ERR_LIMIT;
        }
    }
    ground->first_polygon[c->graph->slot_count] = (uint32_t)count;
    ground->is_new = tl_allocate_array(c->allocator, count, sizeof *ground->is_new);
    if (ground->is_new == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(ground->is_new, 0, (size_t)count * sizeof *ground->is_new);
    for (uint64_t i = 0; i < c->slots.count; i++) {
        const uint32_t slot = c->slots.numbers[i], first = ground->first_polygon[slot];
        if ((c->slot_bits[slot] & TL_NAV_SLOT_OTHER) != 0) {
            memset(ground->is_new + first, true, (ground->first_polygon[slot + 1] - first) * sizeof *ground->is_new);
        }
    }
    for (uint64_t i = 0; i < c->polygons.count; i++) {
        const uint64_t key = c->polygons.items[i].key;
        ground->is_new[ground->first_polygon[key >> 32] + (uint32_t)key] = true;
    }
    return TL_OK;
}

tl_result tl_nav_make_look_ground(const tl_nav_change_sectors *sectors, tl_nav_look_ground *ground_out)
{
    const tl_nav_graph_changes *changes = sectors->changes;
    memset(ground_out, 0, sizeof *ground_out);
    ground_out->sectors = sectors;
    ground_out->changes = changes;
    ground_out->first_polygon =
        tl_allocate_array(changes->allocator, (uint64_t)changes->graph->slot_count + 1, sizeof(uint32_t));
    return ground_out->first_polygon != NULL ? list_new_polygons(ground_out) : TL_ERR_MEMORY;
}

static uint64_t polygon_count(const tl_nav_look_ground *ground)
{
    return ground->first_polygon != NULL ? ground->first_polygon[ground->changes->graph->slot_count] : 0;
}

void tl_nav_free_look_ground(tl_nav_look_ground *ground)
{
    const tl_allocator *allocator = ground->changes->allocator;
    const uint64_t slots = ground->changes->graph->slot_count;
    tl_release_array(allocator, ground->is_new, polygon_count(ground), sizeof *ground->is_new);
    tl_release_array(allocator, ground->first_polygon, slots + 1, sizeof *ground->first_polygon);
}

static tl_result begin_looks(const tl_nav_look_ground *ground, tl_nav_corner_look *look)
{
    const tl_allocator *allocator = ground->changes->allocator;
    const uint64_t slots = ground->changes->graph->slot_count, polygons = polygon_count(ground);
    look->ground = ground;
    look->cones.allocator = allocator;
    look->last_looks = tl_allocate_array(allocator, slots, sizeof *look->last_looks);
    look->last_anew = tl_allocate_array(allocator, polygons, sizeof *look->last_anew);
    if (look->last_looks == NULL || look->last_anew == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(look->last_looks, 0, (size_t)slots * sizeof *look->last_looks);
    memset(look->last_anew, 0, (size_t)polygons * sizeof *look->last_anew);
    return make_look_query(look, FIRST_WEDGES);
}

void tl_nav_end_looks(tl_nav_corner_look *look)
{
    if (look->ground == NULL) {
        return; // there was none
    }
    const tl_allocator *allocator = look->ground->changes->allocator;
    tl_nav_query_release(look->query);
    tl_nav_free_pairs(allocator, &look->seen.edges);
    tl_nav_free_pairs(allocator, &look->seen.reaches);
    tl_nav_free_pairs(allocator, &look->dropped);
    tl_nav_free_numbers(allocator, &look->is_changed);
    tl_release_array(allocator, look->cones.cones, look->cones.capacity, sizeof *look->cones.cones);
    tl_release_array(allocator, look->last_looks, look->ground->changes->graph->slot_count, sizeof *look->last_looks);
    tl_release_array(allocator, look->last_anew, polygon_count(look->ground), sizeof *look->last_anew);
}

// Whether a corner vertex has an edge to another, and keeps it.
static bool has_edge(const tl_nav_corner_look *look, uint32_t from, uint32_t to)
{
    const tl_nav_corner_vertex *vertex = &look->ground->changes->graph->vertices[from];
    const uint32_t k = tl_nav_find_visibility_edge(vertex, to);
    return k < vertex->edge_count && vertex->edges[k].to == to && tl_nav_edge_stays(look->ground->sectors, from, to);
}

// Adds an edge at both ends: each may have missed the other by rounding. Where it stood and stays, it does at both.
static void add_edge_seen(tl_nav_corner_look *look, uint32_t from, uint32_t to)
{
    if (look->result == TL_OK && !has_edge(look, from, to)) {
        look->result = tl_nav_add_pair(look->ground->changes->allocator, &look->seen.edges, from, to);
        look->result = look->result == TL_OK
                           ? tl_nav_add_pair(look->ground->changes->allocator, &look->seen.edges, to, from)
                           : look->result;
    }
}

static void note_sight(void *user, uint32_t turn)
{
    tl_nav_corner_look *look = (tl_nav_corner_look *)user;
    const tl_nav_visibility_graph *graph = look->ground->changes->graph;
    const uint32_t seen = tl_nav_find_name(&graph->names, turn);
    TL_ASSERT(seen != TL_NAV_NO_VERTEX);
    const tl_nav_corner_vertex *from = &graph->vertices[look->vertex];
    const tl_nav_corner_vertex *to = &graph->vertices[seen];
    const double x = (double)to->x - (double)from->x, z = (double)to->z - (double)from->z;
    if (seen != look->vertex && (x != 0.0 || z != 0.0) && tl_nav_turns_at(from, -x, -z, graph->rounding) != 0 &&
        tl_nav_turns_at(to, x, z, graph->rounding) != 0) {
        add_edge_seen(look, look->vertex, seen);
    }
}

// Whether a wedge may show any direction of the view. Both are less than half a turn wide where that is asked.
static bool looks_through(void *user, const tl_nav_wedge *wedge)
{
    const tl_nav_corner_look *look = (const tl_nav_corner_look *)user;
    const tl_nav_sector_rays rays = { wedge->right.x, wedge->right.z, wedge->left.x, wedge->left.z };
    bool any = is_open_direction(wedge->right) || is_open_direction(wedge->left);
    for (uint32_t i = 0; i < look->view.count && !any; i++) {
        any = look->view.sectors[i].width >= 0.5 * TL_NAV_FULL_TURN ||
              !tl_nav_are_rays_apart(&look->view.rays[i], &rays, 0.0);
    }
    return any;
}

static tl_result see_from(tl_nav_corner_look *look, bool all_around)
{
    const tl_nav_corner_vertex *from = &look->ground->changes->graph->vertices[look->vertex];
    tl_nav_shortest_search start;
    memset(&start, 0, sizeof start);
    start.navmesh = look->ground->changes->navmesh;
    start.start_slot = from->place.slot;
    start.start_polygon = from->place.polygon;
    start.start = tl_vec3_make(from->x, from->y, from->z);
    for (uint32_t i = 0; i < look->view.count; i++) {
        look->view.rays[i] = tl_nav_rays_of_sector(&look->view.sectors[i]);
    }
    const tl_nav_sight sight = { note_sight, all_around ? NULL : looks_through, look, &from->walls };
    start.query = look->query;
    while (!tl_nav_see(&start, &sight)) {
        if (look->query->max_nodes > TL_NAV_MAX_QUERY_NODES / 2) {
            return TL_ERR_LIMIT;
        }
        TL_TRY(make_look_query(look, 2 * look->query->max_nodes));
        start.query = look->query;
    }
    return look->result;
}

// Adds the cones of a wedge.
static tl_result take_wedge(tl_nav_corner_look *look, const tl_nav_wedge *wedge)
{
    const uint64_t before = look->cones.count;
    TL_TRY(tl_nav_add_cones(&look->cones, look->ground->changes->graph, look->vertex, wedge));
    if (look->cones.count == before || look->last_looks[wedge->slot] == look->look_count) {
        return TL_OK;
    }
    look->last_looks[wedge->slot] = look->look_count;
    return tl_nav_add_pair(look->ground->changes->allocator, &look->seen.reaches, look->vertex, wedge->slot);
}

static tl_result look_around(tl_nav_corner_look *look)
{
    TL_TRY(see_from(look, true));
    for (uint32_t i = 0; i < look->query->wedge_count; i++) {
        TL_TRY(take_wedge(look, &look->query->wedges[i]));
    }
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Towards changes.

// Adds a sector to the view. Where there are too many, it becomes all directions.
static void widen_view(tl_nav_view *view, tl_nav_sector sector)
{
    for (uint32_t i = view->count; i > 0; i--) {
        if (tl_nav_sectors_overlap(&view->sectors[i - 1], &sector)) {
            sector = tl_nav_unite_sectors(&view->sectors[i - 1], &sector);
            view->sectors[i - 1] = view->sectors[--view->count];
            i = view->count + 1;
        }
    }
    if (view->count == TL_NAV_MAX_VIEW) {
        const tl_nav_sector all = { 0.0, TL_NAV_FULL_TURN };
        view->count = 0;
        sector = all;
    }
    view->sectors[view->count++] = sector;
}

static bool is_in_view(const tl_nav_view *view, const tl_nav_sector *sector)
{
    for (uint32_t i = 0; i < view->count; i++) {
        if (tl_nav_holds_sector(&view->sectors[i], sector)) {
            return true;
        }
    }
    return false;
}

// The last look that finds its cones in a polygon anew.
static uint32_t *anew_in(const tl_nav_corner_look *look, uint32_t slot, uint32_t polygon)
{
    return &look->last_anew[look->ground->first_polygon[slot] + polygon];
}

// The sectors of changes, and of the cones that are found anew.
static void begin_view(tl_nav_corner_look *look, uint32_t order)
{
    const tl_nav_change_sectors *s = look->ground->sectors;
    look->view.count = 0;
    for (uint64_t i = s->first[order]; i < s->first[order + 1]; i++) {
        widen_view(&look->view, s->sectors[i].sector);
    }
    for (uint64_t i = tl_nav_find_pair(&s->beyond, order); i < s->beyond.count && s->beyond.items[i].key >> 32 == order;
         i++) {
        const tl_sort_item *item = &s->beyond.items[i];
        const uint32_t slot = (uint32_t)item->key;
        const tl_nav_sector sector =
            tl_nav_sector_of_cone(&look->ground->changes->graph->tiles[slot].cones, item->value);
        if (!is_in_view(&look->view, &sector)) {
            widen_view(&look->view, sector);
        }
        *anew_in(look, slot, item->extra) = look->look_count;
    }
}

// A polygon that is seen beyond a change now, and was not before: the cones there go, and what they showed is looked
// at.
static tl_result drop_cones_in(tl_nav_corner_look *look, uint32_t slot, uint32_t polygon, bool *widens)
{
    const tl_nav_corner_cones *cones = &look->ground->changes->graph->tiles[slot].cones;
    const uint32_t old = tl_nav_old_polygon(look->ground->changes, slot, polygon);
    for (uint32_t i = old != TL_NO_POLYGON ? cones->first[old] : 1; old != TL_NO_POLYGON && i < cones->first[old + 1];
         i++) {
        if (tl_nav_cone_vertex(cones, i) == look->vertex) {
            const tl_nav_sector sector = tl_nav_sector_of_cone(cones, i);
            TL_TRY(tl_nav_add_pair(look->ground->changes->allocator, &look->dropped, slot, i));
            if (!is_in_view(&look->view, &sector)) {
                widen_view(&look->view, sector);
                *widens = true;
            }
        }
    }
    return TL_OK;
}

// Finds the polygons that are seen beyond changes now.
static tl_result find_changed_sight(tl_nav_corner_look *look, bool *widens)
{
    const tl_nav_query *query = look->query;
    look->is_changed.count = 0;
    for (uint32_t i = 0; i < query->wedge_count; i++) {
        const tl_nav_wedge *wedge = &query->wedges[i];
        uint32_t *anew = anew_in(look, wedge->slot, wedge->polygon);
        const bool by_parent = wedge->parent < i && look->is_changed.numbers[wedge->parent] != 0;
        const bool is_changed = by_parent || look->ground->is_new[anew - look->last_anew];
        TL_TRY(tl_nav_add_number(look->ground->changes->allocator, &look->is_changed, is_changed ? 1 : 0));
        if (is_changed && *anew != look->look_count) {
            *anew = look->look_count;
            TL_TRY(drop_cones_in(look, wedge->slot, wedge->polygon, widens));
        }
    }
    return TL_OK;
}

static tl_result look_towards_changes(tl_nav_corner_look *look, uint32_t order)
{
    begin_view(look, order);
    for (bool widens = true; widens;) {
        widens = false;
        TL_TRY(see_from(look, false));
        TL_TRY(find_changed_sight(look, &widens));
    }
    for (uint32_t i = 0; i < look->query->wedge_count; i++) {
        const tl_nav_wedge *wedge = &look->query->wedges[i];
        if (*anew_in(look, wedge->slot, wedge->polygon) == look->look_count) {
            TL_TRY(take_wedge(look, wedge));
        }
    }
    return TL_OK;
}

static tl_result look_from(const tl_nav_look_ground *ground, tl_nav_corner_look *look, uint32_t vertex)
{
    const tl_nav_visibility_graph *graph = ground->changes->graph;
    if (look->ground == NULL) {
        TL_TRY(begin_looks(ground, look));
    }
    look->vertex = vertex;
    look->look_count++;
    return graph->marks[vertex] == TL_NAV_MARK_LOOKS ? look_towards_changes(look, graph->orders[vertex])
                                                     : look_around(look);
}

void tl_nav_look_from(const tl_nav_look_ground *ground, tl_nav_corner_look *look, uint32_t vertex)
{
    if (look->result == TL_OK) {
        look->result = look_from(ground, look, vertex);
    }
}
