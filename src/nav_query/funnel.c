// SPDX-License-Identifier: MIT
//
// String pulling: narrow a wedge from the apex, portal by portal; where one side would cross the other, the other is a
// corner and the next apex, and the walk goes on from that corner's last portal.
//
// All turns are decided exactly, so portals of no width, portals that share an end with the apex, and wedges that have
// closed to a line need no tolerance: a point on a side's own line still narrows it. A corner is remembered with the
// last portal that has it, so each restart begins behind the one before: at most n(n + 1)/2 portals are looked at, and
// about 2n on real corridors.
// Source: Mikko Mononen, Simple Stupid Funnel Algorithm, 2010; Lee and Preparata, Euclidean Shortest Paths in the
// Presence of Rectilinear Barriers, 1984.

#include "base/assert.h"
#include "portal_between.h"
#include "side.h"
#include "surface.h"

typedef struct corner_list {
    tl_nav_corner *corners;
    uint32_t capacity, count;
    tl_vec3 last;
    double length;
} corner_list;

static void add_corner(corner_list *list, tl_vec3 point, tl_nav_ref polygon, uint32_t flags)
{
    if (list->count > 0) {
        list->length += (double)tl_distance(list->last, point);
    }
    if (list->count < list->capacity) {
        tl_nav_corner corner = { point, polygon, flags };
        list->corners[list->count] = corner;
    }
    list->count++;
    list->last = point;
}

// One side of the wedge: where it is, and the portal that put it there.
typedef struct wedge_side {
    tl_vec3 point;
    uint32_t portal;
} wedge_side;

typedef struct funnel {
    const tl_navmesh *navmesh;
    const tl_nav_ref *polygons;
    uint32_t polygon_count;
    tl_vec3 start, end;
    corner_list list;
} funnel;

static bool same_place(tl_vec3 a, tl_vec3 b)
{
    return a.x == b.x && a.z == b.z;
}

// A corner that coincides with the one before, or with the end, adds nothing.
static void add_turn(funnel *f, const wedge_side *side, uint32_t flags)
{
    if (!same_place(side->point, f->list.last) && !same_place(side->point, f->end)) {
        add_corner(&f->list, side->point, f->polygons[side->portal + 1], flags);
    }
}

// Portal i leads from polygon i to i + 1; the last one is the end itself.
static tl_result portal_at(const funnel *f, uint32_t i, tl_vec3 *left_out, tl_vec3 *right_out)
{
    if (i + 1 == f->polygon_count) {
        *left_out = f->end;
        *right_out = f->end;
        return TL_OK;
    }
    uint32_t slot = 0;
    uint32_t polygon = 0;
    if (!tl_nav_split_ref(f->navmesh, f->polygons[i + 1], &slot, &polygon)) {
        return TL_ERR_NOT_FOUND;
    }
    return tl_nav_portal_between(f->navmesh, f->polygons[i], slot, polygon, left_out, right_out) ? TL_OK
                                                                                                 : TL_ERR_ARGUMENT;
}

static tl_result pull(funnel *f)
{
    tl_vec3 apex = f->start;
    // The apex stands before portal 0; `portal` of an unset side is never read.
    wedge_side left = { apex, 0 };
    wedge_side right = { apex, 0 };
    uint32_t i = 0;
    while (i < f->polygon_count) {
        tl_vec3 new_left, new_right;
        TL_TRY(portal_at(f, i, &new_left, &new_right));
        if (tl_nav_side_of(apex, right.point, new_right) <= 0) {
            if (tl_nav_side_of(apex, left.point, new_right) < 0) {
                add_turn(f, &left, TL_NAV_CORNER_LEFT);
                apex = left.point;
                i = left.portal + 1;
                right = left;
                continue;
            }
            right.point = new_right;
            right.portal = i;
        }
        if (tl_nav_side_of(apex, left.point, new_left) >= 0) {
            if (tl_nav_side_of(apex, right.point, new_left) > 0) {
                add_turn(f, &right, TL_NAV_CORNER_RIGHT);
                apex = right.point;
                i = right.portal + 1;
                left = right;
                continue;
            }
            left.point = new_left;
            left.portal = i;
        }
        i++;
    }
    return TL_OK;
}

tl_result tl_navmesh_straight_path(const tl_navmesh *navmesh, const tl_nav_ref *polygons, uint32_t polygon_count,
                                   tl_vec3 start, tl_vec3 end, tl_nav_corner *corners_out, uint32_t capacity,
                                   uint32_t *count_out, float *length_out)
{
    *count_out = 0;
    if (length_out != NULL) {
        *length_out = 0.0f;
    }
    if (polygon_count == 0) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_is_finite(start) || !tl_nav_is_finite(end)) {
        return TL_ERR_NOT_FINITE;
    }
    uint32_t slots[2], ends[2];
    if (!tl_nav_split_ref(navmesh, polygons[0], &slots[0], &ends[0]) ||
        !tl_nav_split_ref(navmesh, polygons[polygon_count - 1], &slots[1], &ends[1])) {
        return TL_ERR_NOT_FOUND;
    }
    bool inside = false;
    funnel f = { navmesh,
                 polygons,
                 polygon_count,
                 tl_nav_clamp_to_polygon(navmesh->slots[slots[0]].tile, ends[0], start, &inside),
                 tl_nav_clamp_to_polygon(navmesh->slots[slots[1]].tile, ends[1], end, &inside),
                 { corners_out, capacity, 0, start, 0.0 } };
    add_corner(&f.list, f.start, polygons[0], TL_NAV_CORNER_START);
    TL_TRY(pull(&f));
    add_corner(&f.list, f.end, polygons[polygon_count - 1], TL_NAV_CORNER_END);
    *count_out = f.list.count;
    if (length_out != NULL) {
        *length_out = (float)f.list.length;
    }
    return f.list.count <= capacity ? TL_OK : TL_ERR_CAPACITY;
}
