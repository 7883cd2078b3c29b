// SPDX-License-Identifier: MIT
//
// A path over the visibility graph, written: its corners, and the polygons along each leg.
//
// A leg ends in one of the polygons around a corner vertex and the next one begins in another: the polygons between
// them, on the side away from the walls, belong to the path too.

#include "nav_query/prepared/graph_path.h"

#include <math.h>
#include <string.h>

uint32_t tl_nav_fan_of(const tl_navmesh *navmesh, const tl_nav_corner_vertex *vertex, tl_nav_ring_place *fan_out)
{
    tl_nav_ring_place at = vertex->place;
    for (uint32_t i = 0; i < TL_NAV_MAX_FAN; i++) {
        const tl_nav_ring ring = tl_nav_ring_at(navmesh, at.slot, at.polygon);
        uint32_t before = at.edge > 0 ? at.edge - 1 : ring.count - 1;
        fan_out[i] = at;
        if (!tl_nav_ring_is_open(tl_nav_ring_to(&ring, before))) {
            return i + 1;
        }
        at = tl_nav_ring_twin(navmesh, at.slot, at.polygon, &ring, before);
    }
    return TL_NAV_MAX_FAN;
}

static bool is_ahead(const tl_nav_line *line, const tl_vec3 *vertex)
{
    return line->on_x * ((double)vertex->x - line->x) + line->on_z * ((double)vertex->z - line->z) > 0.0;
}

// How far from 0 rounding may put what says on which side of a line a vertex lies: both ends of the line are rounded,
// so a vertex that is farther away than the line is long counts by its distance.
static double line_slack(const tl_nav_line *line, const tl_vec3 *vertex)
{
    return line->rounding * (fabs(line->on_x) + fabs(line->on_z) + fabs((double)vertex->x - line->x) +
                             fabs((double)vertex->z - line->z));
}

bool tl_nav_line_enters(const tl_nav_line *line, const tl_nav_ring_place *place)
{
    if (line->on_x == 0.0 && line->on_z == 0.0) {
        return place->slot == line->slot && place->polygon == line->polygon; // the goal is in the vertex
    }
    const tl_nav_ring ring = tl_nav_ring_at(line->navmesh, place->slot, place->polygon);
    const tl_vec3 *right = &ring.points[place->edge + 1 < ring.count ? place->edge + 1 : 0];
    const tl_vec3 *left = &ring.points[place->edge > 0 ? place->edge - 1 : ring.count - 1];
    double right_slack = line_slack(line, right);
    double left_slack = line_slack(line, left);
    double to_right = tl_nav_right_of_line(line, right);
    double to_left = tl_nav_right_of_line(line, left);
    if (to_right > right_slack && to_left < -left_slack) {
        return true;
    }
    return (fabs(to_right) <= right_slack && is_ahead(line, right)) ||
           (fabs(to_left) <= left_slack && is_ahead(line, left));
}

typedef struct graph_path {
    const tl_nav_shortest_search *search;
    const tl_nav_visibility_graph *graph;
    const tl_nav_path_buffers *room;
    tl_nav_shortest_path *path;
    tl_nav_trail trail;
    tl_vec3 last;       // corner
    uint8_t arrived_at; // the place of the trail's last polygon in the fan that the last leg led to, if it is known
} graph_path;

static double corner_distance(tl_vec3 a, tl_vec3 b)
{
    double x = (double)b.x - (double)a.x;
    double z = (double)b.z - (double)a.z;
    return sqrt(x * x + z * z);
}

static void add_path_corner(graph_path *p, tl_vec3 point, tl_nav_ref polygon, uint32_t flags)
{
    if (p->path->corner_count > 0) {
        p->path->length += corner_distance(p->last, point);
        p->path->surface_length += (double)tl_distance(p->last, point);
    }
    if (p->path->corner_count < p->room->corner_capacity) {
        tl_nav_corner corner = { point, polygon, flags, TL_NAV_NO_REF };
        p->room->corners[p->path->corner_count] = corner;
    }
    p->path->corner_count++;
    p->last = point;
}

// Adds a corner vertex as a corner, unless the path goes straight on there.
static void add_corner_vertex(graph_path *p, tl_vec3 point, tl_vec3 next, tl_nav_ref polygon, bool is_left)
{
    double x = (double)point.x - (double)p->last.x;
    double z = (double)point.z - (double)p->last.z;
    double on_x = (double)next.x - (double)point.x;
    double on_z = (double)next.z - (double)point.z;
    double turn = x * on_z - z * on_x;
    if (turn != 0.0) {
        is_left = turn < 0.0;
    } else if (x * on_x + z * on_z >= 0.0) {
        return;
    }
    add_path_corner(p, point, polygon, is_left ? TL_NAV_CORNER_LEFT : TL_NAV_CORNER_RIGHT);
}

// Polygons along a line behind a place of a fan, and around the fan to that place.
static uint32_t count_on_line(const tl_nav_line *line, const tl_nav_ring_place *place, uint32_t from, uint32_t at)
{
    tl_nav_trail trail = { NULL, 0, 0, 0, 0 };
    bool arrives = tl_nav_walk_line(line, place->slot, place->polygon, &trail) == TL_NAV_LINE_ARRIVES;
    return arrives ? trail.count + (at > from ? at - from : from - at) : UINT32_MAX - 1;
}

// The place of a fan into which a line leads; `count` when there is none. A fan may wind more than once around, and a
// line along an edge leads into two polygons: then the way over the fewest polygons is taken.
static uint32_t next_in_fan(const tl_nav_ring_place *fan, uint32_t count, uint32_t from, const tl_nav_line *line)
{
    uint32_t best = count;
    uint32_t least = UINT32_MAX; // of polygons to the best; UINT32_MAX: not counted
    for (uint32_t i = 0; i < count; i++) {
        if (!tl_nav_line_enters(line, &fan[i])) {
            continue;
        }
        if (best == count) {
            best = i;
            continue;
        }
        if (least == UINT32_MAX) {
            least = count_on_line(line, &fan[best], from, best);
        }
        uint32_t steps = count_on_line(line, &fan[i], from, i);
        best = steps < least ? i : best;
        least = steps < least ? steps : least;
    }
    return best;
}

// Goes around a corner vertex from the last polygon to the one into which the next leg leads.
static bool turn_around(graph_path *p, const tl_nav_corner_vertex *vertex, const tl_nav_line *line, tl_vec3 next)
{
    const tl_navmesh *navmesh = p->search->navmesh;
    tl_nav_ring_place fan[TL_NAV_MAX_FAN];
    uint32_t count = tl_nav_fan_of(navmesh, vertex, fan);
    uint32_t from = 0;
    while (from < count && (fan[from].slot != p->trail.slot || fan[from].polygon != p->trail.polygon)) {
        from++;
    }
    uint32_t to = next_in_fan(fan, count, from, line);
    if (from == count || to == count) {
        return false;
    }
    for (uint32_t i = from; i != to; i += to > from ? 1u : UINT32_MAX) {
        tl_nav_add_to_trail(&p->trail, navmesh, fan[i].slot, fan[i].polygon);
    }
    tl_nav_add_to_trail(&p->trail, navmesh, fan[to].slot, fan[to].polygon);
    add_corner_vertex(p, tl_vec3_make(vertex->x, vertex->y, vertex->z), next,
                      tl_nav_make_ref(navmesh, fan[to].slot, fan[to].polygon), to > from);
    return true;
}

// Of the edge between two corner vertices, or NULL. Edges stand by where they lead.
static const tl_nav_kept_leg *kept_between(const tl_nav_visibility_graph *graph, const tl_nav_corner_vertex *from,
                                           const tl_nav_corner_vertex *to)
{
    const uint32_t end = (uint32_t)(to - graph->vertices);
    const tl_nav_kept_leg *legs = graph->kept.legs + graph->kept.leg_first[from - graph->vertices];
    const uint32_t k = tl_nav_find_visibility_edge(from, end);
    const bool is_kept = k < from->edge_count && from->edges[k].to == end && legs[k].enters != TL_NAV_NO_PLACE;
    return is_kept ? &legs[k] : NULL;
}

static void add_refs(tl_nav_trail *trail, const tl_nav_ref *refs, uint32_t count)
{
    if (trail->count < trail->capacity) {
        const uint32_t room = trail->capacity - trail->count;
        memcpy(trail->polygons + trail->count, refs, (count < room ? count : room) * sizeof *refs);
    }
    trail->count += count;
}

// The leg between two corner vertices by its kept polygons. False: they are not kept.
static bool add_kept_leg(graph_path *p, const tl_nav_corner_vertex *from, const tl_nav_corner_vertex *to)
{
    const tl_nav_kept_legs *kept = &p->graph->kept;
    const tl_nav_kept_leg *leg = kept->legs != NULL ? kept_between(p->graph, from, to) : NULL;
    if (leg == NULL) {
        return false;
    }
    const tl_navmesh *navmesh = p->search->navmesh;
    const uint32_t *ends = &kept->fan_first[from - p->graph->vertices];
    const tl_nav_ref *fan = kept->fans + ends[0];
    const uint32_t fan_count = ends[1] - ends[0];
    uint32_t at = p->arrived_at;
    if (at == TL_NAV_NO_PLACE) {
        const tl_nav_ref last = tl_nav_make_ref(navmesh, p->trail.slot, p->trail.polygon);
        for (at = 0; at < fan_count && fan[at] != last; at++) {
        }
    }
    if (at == fan_count) {
        return false;
    }
    // fan[at] is there already; the leg begins with fan[enters].
    const bool is_left = leg->enters > at;
    if (is_left) {
        add_refs(&p->trail, fan + at + 1, leg->enters - at - 1);
    }
    for (uint32_t i = at; i > (uint32_t)leg->enters + 1;) {
        add_refs(&p->trail, fan + --i, 1);
    }
    const tl_nav_ref *polygons = kept->polygons + leg->first;
    const uint32_t count = leg[1].first - leg->first;
    const uint32_t known = leg->enters == at ? 1 : 0;
    add_refs(&p->trail, polygons + known, count - known);
    tl_nav_split_ref(navmesh, polygons[count - 1], &p->trail.slot, &p->trail.polygon);
    p->arrived_at = leg->arrives;
    add_corner_vertex(p, tl_vec3_make(from->x, from->y, from->z), tl_vec3_make(to->x, to->y, to->z), polygons[0],
                      is_left);
    return true;
}

// The leg from a corner vertex (NULL: the start) to another (NULL: the goal).
static bool add_leg(graph_path *p, const tl_nav_corner_vertex *from, const tl_nav_corner_vertex *to)
{
    const tl_nav_shortest_search *search = p->search;
    tl_vec3 point = from != NULL ? tl_vec3_make(from->x, from->y, from->z) : search->start;
    tl_vec3 next = to != NULL ? tl_vec3_make(to->x, to->y, to->z) : search->goal;
    tl_nav_line line = { search->navmesh,
                         (double)point.x,
                         (double)point.z,
                         (double)next.x - (double)point.x,
                         (double)next.z - (double)point.z,
                         to != NULL ? to->turn : 0,
                         search->goal_slot,
                         search->goal_polygon,
                         p->graph->rounding };
    if (from != NULL && to != NULL && add_kept_leg(p, from, to)) {
        return true;
    }
    p->arrived_at = TL_NAV_NO_PLACE;
    if (from != NULL && !turn_around(p, from, &line, next)) {
        return false;
    }
    uint32_t slot = from != NULL ? p->trail.slot : search->start_slot;
    uint32_t polygon = from != NULL ? p->trail.polygon : search->start_polygon;
    return tl_nav_walk_line(&line, slot, polygon, &p->trail) == TL_NAV_LINE_ARRIVES;
}

uint32_t tl_nav_write_graph_path(const tl_nav_shortest_search *search, const tl_nav_visibility_graph *graph,
                                 const uint64_t *vertices, uint32_t vertex_count, const tl_nav_path_buffers *room,
                                 tl_nav_shortest_path *path_out)
{
    const tl_navmesh *navmesh = search->navmesh;
    memset(path_out, 0, sizeof *path_out);
    graph_path p = { search,        graph,          room, path_out, { room->polygons, room->polygon_capacity, 0, 0, 0 },
                     search->start, TL_NAV_NO_PLACE };
    add_path_corner(&p, search->start, tl_nav_make_ref(navmesh, search->start_slot, search->start_polygon),
                    TL_NAV_CORNER_START);
    const tl_nav_corner_vertex *from = NULL;
    for (uint32_t i = 0; i <= vertex_count; i++) {
        const tl_nav_corner_vertex *to = i < vertex_count ? &graph->vertices[vertices[vertex_count - 1 - i]] : NULL;
        if (!add_leg(&p, from, to)) {
            return i;
        }
        from = to;
    }
    add_path_corner(&p, search->goal, tl_nav_make_ref(navmesh, search->goal_slot, search->goal_polygon),
                    TL_NAV_CORNER_END);
    path_out->status = TL_NAV_PATH_COMPLETE;
    path_out->polygon_count = p.trail.count;
    path_out->lower_bound = fmin(search->lower_bound, path_out->length);
    return UINT32_MAX;
}
