// SPDX-License-Identifier: MIT
//
// A route: from both ends up through the cells that hold them, to the separator where the shortest way crosses.
//
// A way from one place to another crosses the separator of the smallest cell that holds both, or else leaves that cell
// and crosses the separator of a larger one. Within a cell, lengths from an end to the gates of the separator are those
// that its child knows; one product with the cell's lengths, minimum for sum and sum for product, gives those to all
// gates of the cell. That is about 25,000 sums an end in a world of 10,000 places, in rows that stand one behind the
// other. Rejected: A* over gates with landmarks (ALT), whose lengths over an open plain tie so often that it visits
// most gates of the ellipse around both ends; hub labels, which answer in microseconds from kilobytes a place.

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "nav_world/router.h"

#include <math.h>
#include <string.h>

tl_result tl_nav_router_create(const tl_nav_world *world, const tl_allocator *allocator, tl_nav_router **router_out,
                               tl_report *report)
{
    tl_report_begin(report, "create router");
    TL_REFUSE_NULL(router_out, report);
    *router_out = NULL;
    TL_REFUSE_NULL(world, report);
    if (world->routes == NULL) {
        return tl_report_fail(report, TL_NOT_FOUND, "chunk", TL_NO_ELEMENT,
                              "the file has no routes: bake them into it");
    }
    tl_nav_router *router = tl_allocate_array(allocator, 1, sizeof *router);
    if (router == NULL) {
        return tl_nav_world_no_memory(report);
    }
    memset(router, 0, sizeof *router);
    router->allocator = tl_allocator_or_default(allocator);
    router->world = world;
    const uint32_t longest = world->routes->tree.longest_chain;
    bool fits = true;
    for (int end = 0; end < 2; end++) {
        router->ends[end].upper = tl_allocate_array(allocator, longest, sizeof(float));
        router->ends[end].lower = tl_allocate_array(allocator, longest, sizeof(float));
        fits = fits && router->ends[end].upper != NULL && router->ends[end].lower != NULL;
    }
    tl_nav_query_def def = tl_default_nav_query_def();
    def.allocator = allocator;
    fits = fits && tl_nav_query_create(&def, &router->query, NULL) == TL_OK;
    if (!fits) {
        tl_nav_router_destroy(router);
        return tl_nav_world_no_memory(report);
    }
    *router_out = router;
    return TL_OK;
}

void tl_nav_router_destroy(tl_nav_router *router)
{
    if (router == NULL) {
        return;
    }
    const tl_allocator allocator = router->allocator;
    const uint32_t longest = router->world->routes->tree.longest_chain;
    for (int end = 0; end < 2; end++) {
        tl_release_array(&allocator, router->ends[end].upper, longest, sizeof(float));
        tl_release_array(&allocator, router->ends[end].lower, longest, sizeof(float));
    }
    tl_nav_query_destroy(router->query);
    tl_release_array(&allocator, router, 1, sizeof *router);
}

// ---------------------------------------------------------------------------------------------------------
// Within the places of both ends.

// An end of a route, in the frame of now.
typedef struct route_end {
    tl_nav_location at;
    int32_t x, z; // its place in the file's grid
    uint32_t place;
    double in_file[2]; // metres
    double slack;      // of lengths from it
} route_end;

// The length from an end to a point in its place, rounded up; INFINITY: there is no path within the place.
static tl_result length_in_place(tl_nav_router *router, const route_end *end, const tl_nav_location *to,
                                 float *length_out)
{
    const tl_nav_world *world = router->world;
    int32_t place[2] = { end->x - world->frame_x, end->z - world->frame_z };
    tl_nav_filter filter = tl_default_nav_filter();
    filter.pass = tl_route_is_of_place;
    filter.user = place;
    const tl_nav_path_request request = { &filter, end->at, *to };
    tl_nav_shortest_path path;
    TL_TRY(tl_nav_query_find_shortest_path(router->query, world->navmesh, &request, NULL, &path));
    if (path.status == TL_NAV_PATH_OUT_OF_NODES) {
        return TL_ERR_NODES;
    }
    *length_out = path.status == TL_NAV_PATH_COMPLETE ? tl_route_round_up(path.length + end->slack) : INFINITY;
    return TL_OK;
}

static tl_result find_end(const tl_nav_world *world, const tl_nav_location *at, route_end *end)
{
    const tl_nav_tile *tile = NULL;
    double origin[2];
    TL_TRY(tl_navmesh_resolve(world->navmesh, at->polygon, &tile, NULL));
    end->at.polygon = at->polygon;
    TL_TRY(tl_navmesh_closest_point(world->navmesh, at->polygon, at->point, &end->at.point, NULL));
    end->x = tile->tile_x + world->frame_x;
    end->z = tile->tile_z + world->frame_z;
    end->place = tl_nav_world_find_place(world, end->x, end->z);
    tl_nav_world_frame_origin(world, origin);
    end->in_file[0] = (double)end->at.point.x + origin[0];
    end->in_file[1] = (double)end->at.point.z + origin[1];
    const double side = (double)world->tile_size * (double)world->cell_size;
    const double x = fabs((double)end->at.point.x), z = fabs((double)end->at.point.z);
    end->slack = tl_route_slack((x > z ? x : z) + side);
    return end->place == TL_NAV_WORLD_NO_PLACE ? TL_ERR_STALE : TL_OK;
}

// The middle of a gate in the place of an end, on its polygon. False: the tile is not the one that the gate names.
static bool locate_end_gate(const tl_nav_world *world, const route_end *end, const tl_nav_gate *gate,
                            tl_nav_location *out)
{
    const tl_nav_world_place *place = &world->places[end->place];
    const int side = gate->x == end->x && gate->z == end->z ? 0 : 1;
    double middle[2];
    tl_nav_gate_middle(gate, world, world->frame_x, world->frame_z, middle);
    out->point = tl_vec3_make((float)middle[0], gate->height, (float)middle[1]);
    for (uint32_t i = 0; i < place->tile_count; i++) {
        const tl_nav_world_tile *tile = &world->tiles[place->first_tile + i];
        if (tile->layer == gate->layer[side]) {
            out->polygon = tl_navmesh_polygon_ref(world->navmesh, tile->slot, gate->polygon[side]);
            return out->polygon != TL_NAV_NO_REF;
        }
    }
    return false;
}

// ---------------------------------------------------------------------------------------------------------
// Up through the cells.

static void relax_lengths(float *out, float length, const float *row, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const float sum = length + row[i];
        out[i] = sum < out[i] ? sum : out[i];
    }
}

// From the lengths to the rim of a child to those to the separator and the rim of the cell.
static void climb_cell(const tl_route_tree *tree, const tl_route_cell *cell, const tl_route_cell *child,
                       const float *fronts, const float *of_child, float *out)
{
    const uint32_t gates = cell->gate_count, width = gates + cell->rim_count;
    const uint32_t *rim = tl_route_rim(tree, cell), *child_rim = tl_route_rim(tree, child);
    for (uint32_t i = 0; i < gates; i++) {
        out[i] = INFINITY;
    }
    uint32_t next = gates;
    for (uint32_t i = 0; i < cell->rim_count; i++) {
        const bool is_of_child = next < child->rim_count && child_rim[next] == rim[i];
        out[gates + i] = is_of_child ? of_child[next] : INFINITY;
        next += is_of_child;
    }
    for (uint32_t u = 0; u < gates; u++) {
        if (of_child[u] < INFINITY) {
            relax_lengths(out, of_child[u], fronts + (uint64_t)u * width, width);
        }
    }
}

// Of a block: straight from the end, where the gate can be reached within it.
static void begin_lower(const tl_nav_world *world, const route_end *end, const tl_route_cell *cell, const float *upper,
                        float *lower)
{
    const tl_route_tree *tree = &world->routes->tree;
    const uint32_t *rim = tl_route_rim(tree, cell);
    for (uint32_t i = 0; i < cell->rim_count; i++) {
        const double length = tl_nav_gate_distance_to(&tree->gates[rim[i]], world, end->in_file) - end->slack;
        lower[i] = upper[i] < INFINITY ? tl_route_round_down(length > 0.0 ? length : 0.0) : INFINITY;
    }
}

static tl_result climb_chain(tl_nav_router *router, int which, const route_end *end)
{
    const tl_world_routes *routes = router->world->routes;
    const tl_route_tree *tree = &routes->tree;
    tl_route_chain *chain = &router->ends[which];
    const uint32_t place = tl_route_find_place(tree, end->x, end->z);
    uint32_t offset = 0;
    chain->count = 0;
    for (uint32_t c = place == UINT32_MAX ? TL_ROUTE_NO_CELL : tree->places[place].cell; c != TL_ROUTE_NO_CELL;
         c = tree->cells[c].parent) {
        const tl_route_cell *cell = &tree->cells[c];
        const uint32_t level = chain->count++;
        chain->cells[level] = c;
        chain->offsets[level] = offset;
        float *upper = chain->upper + offset, *lower = chain->lower + offset;
        offset += cell->gate_count + cell->rim_count;
        if (level == 0) {
            const uint32_t *rim = tl_route_rim(tree, cell);
            for (uint32_t i = 0; i < cell->rim_count; i++) {
                tl_nav_location gate;
                if (!locate_end_gate(router->world, end, &tree->gates[rim[i]], &gate)) {
                    return TL_ERR_CORRUPT;
                }
                TL_TRY(length_in_place(router, end, &gate, &upper[i]));
            }
        } else {
            const tl_route_cell *child = &tree->cells[chain->cells[level - 1]];
            const uint32_t below = chain->offsets[level - 1] + child->gate_count;
            climb_cell(tree, cell, child, routes->lengths + cell->upper, chain->upper + below, upper);
            if (cell->is_above) {
                climb_cell(tree, cell, child, routes->lengths + cell->lower, chain->lower + below, lower);
            }
        }
        if (cell->is_block) {
            begin_lower(router->world, end, cell, upper + cell->gate_count, lower + cell->gate_count);
        }
    }
    return TL_OK;
}

// The least sum over all separators that hold both ends in a cell.
static tl_route_meeting meet(const tl_nav_router *router, bool is_lower)
{
    const tl_route_tree *tree = &router->world->routes->tree;
    const tl_route_chain *from = &router->ends[0], *to = &router->ends[1];
    tl_route_meeting best = { { 0, 0 }, 0, INFINITY };
    uint32_t common = 0; // cells that both chains share, from the root down
    while (common < from->count && common < to->count &&
           from->cells[from->count - 1 - common] == to->cells[to->count - 1 - common]) {
        common++;
    }
    for (uint32_t k = 0; k < common; k++) {
        const uint32_t level = from->count - 1 - k, below = to->count - 1 - k;
        const tl_route_cell *cell = &tree->cells[from->cells[level]];
        if (below == 0 || (is_lower && !cell->is_above)) {
            break; // the place of both, or the block
        }
        const float *own = (is_lower ? from->lower : from->upper) + from->offsets[level];
        const float *other =
            (is_lower ? to->lower : to->upper) + to->offsets[below - 1] + tree->cells[to->cells[below - 1]].gate_count;
        for (uint32_t i = 0; i < cell->gate_count; i++) {
            const float sum = own[i] + other[i];
            if (sum < best.length) {
                const tl_route_meeting meeting = { { level, below - 1 }, i, sum };
                best = meeting;
            }
        }
    }
    return best;
}

// ---------------------------------------------------------------------------------------------------------
// The answer.

static bool share_block(const tl_nav_router *router)
{
    const tl_route_tree *tree = &router->world->routes->tree;
    const tl_route_chain *from = &router->ends[0], *to = &router->ends[1];
    for (uint32_t i = 0; i < from->count; i++) {
        if (tree->cells[from->cells[i]].is_block) {
            for (uint32_t j = 0; j < to->count; j++) {
                if (to->cells[j] == from->cells[i]) {
                    return true;
                }
            }
        }
    }
    return false;
}

static double find_lower_bound(const tl_nav_router *router, const route_end ends[2], bool same_place)
{
    const double dx = ends[0].in_file[0] - ends[1].in_file[0], dz = ends[0].in_file[1] - ends[1].in_file[1];
    const double straight = sqrt(dx * dx + dz * dz) - ends[0].slack - ends[1].slack;
    double bound = straight > 0.0 ? straight : 0.0;
    if (!same_place && !share_block(router)) {
        // Each of the sums, two a cell, is off by 2^-24 of it at most.
        const double sums = 2.0 + (double)(router->ends[0].count + router->ends[1].count);
        const double over_gates = (double)meet(router, true).length * (1.0 - 0x1p-23 * sums);
        bound = over_gates > bound ? over_gates : bound;
    }
    return bound;
}

static void write_route(const tl_nav_router *router, const route_end ends[2], const tl_route_meeting *meeting,
                        float direct, tl_route_writer *writer)
{
    double point[3];
    writer->place[0] = ends[0].x;
    writer->place[1] = ends[0].z;
    tl_nav_world_place_out(router->world, ends[0].at.point, point);
    tl_route_write_point(writer, point, 0.0);
    double last = (double)direct;
    if (meeting->length < direct) {
        tl_route_trace(router, meeting, writer);
        last = writer->length;
    }
    writer->place[0] = ends[1].x;
    writer->place[1] = ends[1].z;
    tl_nav_world_place_out(router->world, ends[1].at.point, point);
    tl_route_write_point(writer, point, last);
}

static tl_result find_route(const tl_nav_world *world, tl_nav_router *router, const tl_nav_world_route_request *request,
                            tl_route_writer *writer, tl_nav_world_route *route)
{
    route_end ends[2];
    TL_TRY(find_end(world, &request->start, &ends[0]));
    TL_TRY(find_end(world, &request->goal, &ends[1]));
    const bool same_place = ends[0].place == ends[1].place;
    float direct = INFINITY;
    if (same_place) {
        TL_TRY(length_in_place(router, &ends[0], &ends[1].at, &direct));
    }
    TL_TRY(climb_chain(router, 0, &ends[0]));
    TL_TRY(climb_chain(router, 1, &ends[1]));
    const tl_route_meeting meeting = meet(router, false);
    if (!(direct < INFINITY) && !(meeting.length < INFINITY)) {
        route->status = TL_NAV_PATH_UNREACHABLE;
        route->lower_bound = (double)INFINITY;
        return TL_OK;
    }
    write_route(router, ends, &meeting, direct, writer);
    route->status = TL_NAV_PATH_COMPLETE;
    route->point_count = writer->count;
    route->length = writer->length;
    route->lower_bound = find_lower_bound(router, ends, same_place);
    return writer->capacity > 0 && writer->count > writer->capacity ? TL_INCOMPLETE : TL_OK;
}

tl_result tl_nav_world_find_route(const tl_nav_world *world, tl_nav_router *router,
                                  const tl_nav_world_route_request *request, tl_nav_world_route_point *points_out,
                                  uint32_t capacity, tl_nav_world_route *route_out)
{
    if (route_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    memset(route_out, 0, sizeof *route_out);
    if (world == NULL || router == NULL || request == NULL || router->world != world ||
        (points_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    tl_route_writer writer;
    memset(&writer, 0, sizeof writer);
    writer.world = world;
    writer.points = points_out;
    writer.capacity = capacity;
    return find_route(world, router, request, &writer, route_out);
}
