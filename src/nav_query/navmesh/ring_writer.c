// SPDX-License-Identifier: MIT

#include "nav_query/navmesh/ring_writer.h"

#include "base/assert.h"
#include "nav_query/navmesh/navmesh.h"

#include <string.h>

static bool is_closed(tl_nav_ring_edge edge)
{
    return edge.to == TL_NAV_RING_WALL && tl_nav_ring_twin_hint(edge) == TL_NAV_RING_CLOSED;
}

// Whether an edge stands as it would be written. A closed way stands for an open one.
static bool is_same_edge(tl_nav_ring_edge standing, uint32_t to, uint32_t mark)
{
    if (tl_nav_ring_is_seam(to)) {
        return is_closed(standing) || tl_nav_ring_is_seam(standing.to);
    }
    return standing.to == to && (to != TL_NAV_RING_WALL || tl_nav_ring_twin_hint(standing) == mark);
}

static void add_ring_edge(tl_nav_ring_writer *writer, tl_vec3 start, uint32_t to, uint32_t mark)
{
    const uint32_t i = writer->count++;
    const tl_nav_ring *standing = &writer->standing;
    tl_nav_ring_edge edge = { to, mark };
    switch (writer->mode) {
    case TL_NAV_RINGS_COUNT:
        writer->has_points =
            writer->has_points || i >= writer->corner_count || memcmp(&writer->corners[i], &start, sizeof start) != 0;
        break;
    case TL_NAV_RINGS_WRITE:
        tl_nav_set_edge(writer->rings, writer->edge_count + i, edge);
        if (writer->has_points) {
            writer->points[writer->point_count + i] = start;
        }
        break;
    case TL_NAV_RINGS_COMPARE:
        writer->is_same = writer->is_same && i < standing->count &&
                          memcmp(&standing->points[i], &start, sizeof start) == 0 &&
                          is_same_edge(tl_nav_ring_edge_at(standing, i), to, mark);
        break;
    case TL_NAV_RINGS_REOPEN:
        edge = tl_nav_ring_edge_at(standing, i);
        if (is_closed(edge)) {
            edge.to = to;
            writer->rings->seams[tl_nav_ring_seam_number(to)] = writer->seam;
            tl_nav_set_edge(writer->rings, (uint64_t)standing->first + i, tl_nav_with_twin(edge, mark));
        }
        break;
    }
}

// Returns what the edge leads to.
static uint32_t add_ring_seam(tl_nav_ring_writer *writer, tl_nav_ring_seam seam)
{
    writer->seam = seam;
    if (writer->mode == TL_NAV_RINGS_WRITE) {
        writer->rings->seams[writer->seam_count] = seam;
    }
    return TL_NAV_RING_BACK - 1 - (uint32_t)writer->seam_count++; // tl_nav_ring_seam_number
}

// An edge without a way from `at` to `point`, unless they are one. `ahead` is the edge's direction.
static void add_gap(tl_nav_ring_writer *writer, tl_vec3 at, tl_vec3 point, tl_vec3 ahead)
{
    if (at.x != point.x || at.z != point.z) {
        const bool forward = tl_dot(tl_sub(point, at), ahead) > 0.0f;
        add_ring_edge(writer, at, forward ? TL_NAV_RING_WALL : TL_NAV_RING_BACK, TL_NAV_RING_ON_PORTAL);
        writer->has_back = writer->has_back || !forward;
    }
}

// The pieces of a border edge from `start` to `end`. The links ascend along the side, the edge does on sides 0 and 1.
static void add_border_edge(tl_nav_ring_writer *writer, const tl_nav_tile *tile, uint32_t portal, tl_vec3 start,
                            tl_vec3 end, const tl_nav_side_links *links)
{
    const uint32_t side = tl_nav_tile_side_of(tile, portal);
    const uint32_t *first = links->first + (portal - tl_nav_tile_side_first(tile, side));
    const tl_nav_seam_link *seams = tl_nav_seam_links_of(links) + first[0];
    const uint32_t count = first[1] - first[0];
    const tl_vec3 ahead = tl_sub(end, start);
    tl_vec3 at = start;
    for (uint32_t i = 0; i < count; i++) {
        const tl_nav_seam_link *link = &seams[side < 2 ? i : count - 1 - i];
        const tl_nav_ring_seam seam = { tl_nav_seam_slot(link), tl_nav_seam_polygon(link) };
        tl_vec3 left, right;
        tl_nav_seam_ends(tile, portal, link, &left, &right);
        add_gap(writer, at, right, ahead);
        add_ring_edge(writer, right, add_ring_seam(writer, seam), TL_NAV_RING_ON_PORTAL);
        at = left;
    }
    add_gap(writer, at, end, ahead);
}

void tl_nav_write_ring(tl_nav_ring_writer *writer, const tl_nav_tile *tile,
                       const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t polygon)
{
    const tl_vec3 *corners = tl_nav_tile_corners(tile, polygon, &writer->corner_count);
    const uint32_t count = writer->corner_count;
    writer->corners = corners;
    writer->count = 0;
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t link = tl_nav_tile_edge_link(tile, polygon, k);
        if (!tl_nav_is_portal(link)) {
            add_ring_edge(writer, corners[k], link == TL_NAV_LINK_WALL ? TL_NAV_RING_WALL : link, 0);
            continue;
        }
        const uint32_t portal = tl_nav_link_portal(link);
        const uint32_t side = tl_nav_tile_side_of(tile, portal);
        const uint32_t at = portal - tl_nav_tile_side_first(tile, side);
        if (sides[side]->first == NULL || sides[side]->first[at] == sides[side]->first[at + 1]) {
            add_ring_edge(writer, corners[k], TL_NAV_RING_WALL, TL_NAV_RING_ON_PORTAL);
        } else {
            add_border_edge(writer, tile, portal, corners[k], corners[k + 1 < count ? k + 1 : 0], sides[side]);
        }
    }
    writer->has_points = writer->has_points || (writer->mode == TL_NAV_RINGS_COUNT && writer->count != count);
}

void tl_nav_write_same_ring(tl_nav_ring_writer *writer, const tl_nav_rings *old, uint32_t polygon)
{
    const tl_nav_ring ring = tl_nav_ring_of(old, polygon);
    writer->has_points = (tl_nav_ring_first_point(old, polygon) & TL_NAV_RING_OWN_POINTS) != 0;
    writer->count = ring.count;
    for (uint32_t i = 0; i < ring.count; i++) {
        tl_nav_ring_edge edge = tl_nav_ring_edge_at(&ring, i);
        if (tl_nav_ring_is_seam(edge.to)) {
            edge.to = add_ring_seam(writer, old->seams[tl_nav_ring_seam_number(edge.to)]);
        } else if (is_closed(edge)) {
            edge = tl_nav_with_twin(edge, TL_NAV_RING_ON_PORTAL);
        }
        writer->has_back = writer->has_back || edge.to == TL_NAV_RING_BACK;
        if (writer->mode == TL_NAV_RINGS_WRITE) {
            tl_nav_set_edge(writer->rings, writer->edge_count + i, edge);
        }
    }
    if (writer->mode == TL_NAV_RINGS_WRITE && writer->has_points) {
        memcpy(writer->points + writer->point_count, ring.points, ring.count * sizeof *ring.points);
    }
}

void tl_nav_rings_close(tl_nav_rings *rings, uint32_t slot)
{
    for (uint32_t i = 0; i < rings->edge_count; i++) {
        tl_nav_ring_edge edge = tl_nav_edge_of(rings, i);
        if (tl_nav_ring_is_seam(edge.to) && tl_nav_ring_seam_of(rings, edge.to).slot == slot) {
            edge.to = TL_NAV_RING_WALL;
            tl_nav_set_edge(rings, i, tl_nav_with_twin(edge, TL_NAV_RING_CLOSED));
        }
    }
}

static bool is_on_side(const tl_nav_tile *tile, uint32_t polygon, uint32_t side)
{
    uint32_t count = 0;
    (void)tl_nav_tile_corners(tile, polygon, &count);
    for (uint32_t k = 0; k < count; k++) {
        const uint32_t link = tl_nav_tile_edge_link(tile, polygon, k);
        if (tl_nav_is_portal(link) && tl_nav_tile_side_of(tile, tl_nav_link_portal(link)) == side) {
            return true;
        }
    }
    return false;
}

// Ways of a ring, closed ones too: those that had a number when the rings were made.
static uint32_t count_ways(const tl_nav_ring *ring)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < ring->count; i++) {
        const tl_nav_ring_edge edge = tl_nav_ring_edge_at(ring, i);
        count += tl_nav_ring_is_seam(edge.to) || is_closed(edge) ? 1 : 0;
    }
    return count;
}

// Goes through the rings of the polygons on a side. False: some other ring would be written.
static bool meet_standing_rings(tl_nav_ring_writer *writer, const tl_nav_rings *standing, const tl_nav_tile *tile,
                                const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t side)
{
    writer->is_same = true;
    for (uint32_t p = 0; p < tile->polygon_count && writer->is_same; p++) {
        writer->standing = tl_nav_ring_of(standing, p);
        if (is_on_side(tile, p, side)) {
            tl_nav_write_ring(writer, tile, sides, p);
            writer->is_same = writer->is_same && writer->count == writer->standing.count;
        } else {
            writer->seam_count += count_ways(&writer->standing);
        }
    }
    return writer->is_same;
}

bool tl_nav_rings_can_reopen(const tl_nav_rings *rings, const tl_nav_tile *tile,
                             const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t changed_side)
{
    tl_nav_ring_writer writer;
    memset(&writer, 0, sizeof writer);
    writer.mode = TL_NAV_RINGS_COMPARE;
    return meet_standing_rings(&writer, rings, tile, sides, changed_side);
}

void tl_nav_rings_reopen(tl_nav_rings *rings, const tl_nav_tile *tile,
                         const tl_nav_side_links *sides[TL_NAV_SIDE_COUNT], uint32_t changed_side)
{
    tl_nav_ring_writer writer;
    memset(&writer, 0, sizeof writer);
    writer.mode = TL_NAV_RINGS_REOPEN;
    writer.rings = rings;
    const bool is_same = meet_standing_rings(&writer, rings, tile, sides, changed_side);
    TL_ASSERT(is_same);
    (void)is_same;
}
