// SPDX-License-Identifier: MIT
//
// String pulling (the funnel algorithm): narrow a wedge from the apex, portal by portal; where one side would cross the
// other, the other becomes a corner and the next apex, and the walk continues from that corner's last portal.
//
// All turns are decided exactly, so nothing needs a tolerance; what remains is to decide every tie. Where both sides of
// the wedge fall on one line the path must follow it, so the side that the corridor reaches first becomes a corner at
// once, and the next corner removes it again if it lies straight behind. That keeps the order right where a corridor
// turns back along a line, as it does around the end of a wall on the seam of two tiles.
//
// Where a corridor leaves a polygon by the very edge by which it came in (to another of two polygons that lie over one
// another there), the line is inside the corridor but need not be the shortest. Off-mesh links cut a corridor into
// pieces, each pulled by itself from anchor to anchor. A corner is remembered with the last portal that has it, so each
// restart begins behind the one before: at most n(n + 1)/2 portals are visited, and about 2n on real corridors. Source:
// Mikko Mononen, Simple Stupid Funnel Algorithm, 2010; Lee and Preparata, Euclidean Shortest Paths in the Presence of
// Rectilinear Barriers, 1984.

#include "nav_query/path/funnel.h"

#include "base/assert.h"
#include "nav_query/navmesh/surface.h"
#include "nav_query/plane/side.h"
#include "nav_query/search/portal_between.h"

#include <string.h>

typedef struct corner_list {
    tl_nav_corner *corners;
    uint32_t capacity, count;
    uint32_t fixed;       // the first ones, up to where the current piece begins
    tl_vec3 last, before; // the last two points
    double length, length_before;
} corner_list;

static void set_last(corner_list *list, tl_vec3 point, tl_nav_ref polygon, uint32_t flags, tl_nav_ref link)
{
    list->last = point;
    list->length = list->length_before + (list->count > 1 ? (double)tl_distance(list->before, point) : 0.0);
    if (list->count <= list->capacity) {
        tl_nav_corner corner = { point, polygon, flags, link };
        list->corners[list->count - 1] = corner;
    }
}

// Whether b lies on the straight way from a to c.
static bool lies_straight_between(tl_vec3 a, tl_vec3 b, tl_vec3 c)
{
    double ahead = ((double)b.x - (double)a.x) * ((double)c.x - (double)b.x) +
                   ((double)b.z - (double)a.z) * ((double)c.z - (double)b.z);
    return ahead > 0.0 && tl_nav_side_of(a, b, c) == 0;
}

// Adds a corner; one before it at which the path does not turn, or the same place, gives way to it.
static void add_funnel_corner(corner_list *list, tl_vec3 point, tl_nav_ref polygon, uint32_t flags, tl_nav_ref link)
{
    bool replaces = list->count > list->fixed &&
                    (tl_nav_is_same_place(list->last, point) || lies_straight_between(list->before, list->last, point));
    if (!replaces) {
        list->before = list->last;
        list->length_before = list->length;
        list->count++;
    }
    set_last(list, point, polygon, flags, link);
}

// One side of the wedge: where it is, and the portal that put it there.
typedef struct wedge_side {
    tl_vec3 point;
    uint32_t portal;
} wedge_side;

// Portals that were looked at last: where a path turns it goes back to those behind the corner.
enum { KEPT_PORTALS = 16 };

typedef struct kept_portal {
    uint32_t number; // of the portal and 1; 0: none
    tl_vec3 left, right;
} kept_portal;

typedef struct funnel {
    const tl_navmesh *navmesh;
    const tl_nav_ref *polygons; // of a piece
    uint32_t polygon_count;
    tl_vec3 start, end;
    tl_vec3 apex;
    wedge_side left, right; // at the apex: open, no portal has narrowed it yet
    uint32_t portal;        // the one to look at
    uint32_t last_portal;   // the end itself
    bool only_first;        // as many corners as fit are enough
    kept_portal kept[KEPT_PORTALS];
    corner_list list;
} funnel;

// Portal i leads from polygon i to i + 1; the last one is the end itself.
static tl_result portal_at(funnel *f, uint32_t i, tl_vec3 *left_out, tl_vec3 *right_out)
{
    if (i == f->last_portal) {
        *left_out = f->end;
        *right_out = f->end;
        return TL_OK;
    }
    kept_portal *kept = &f->kept[i % KEPT_PORTALS];
    if (kept->number != i + 1) {
        uint32_t slot = 0;
        uint32_t polygon = 0;
        if (!tl_nav_split_ref(f->navmesh, f->polygons[i + 1], &slot, &polygon)) {
            return TL_ERR_STALE;
        }
        if (!tl_nav_portal_between(f->navmesh, f->polygons[i], slot, polygon, &kept->left, &kept->right)) {
            return TL_ERR_ARGUMENT;
        }
        kept->number = i + 1;
    }
    *left_out = kept->left;
    *right_out = kept->right;
    return TL_OK;
}

// Makes a side of the wedge a corner and the apex; the walk continues behind its portal.
static void turn_funnel(funnel *f, const wedge_side *side, uint32_t flags)
{
    // A corner in the start's own place is no corner; add_corner sees to all others.
    if (f->list.count > f->list.fixed || !tl_nav_is_same_place(side->point, f->start)) {
        add_funnel_corner(&f->list, side->point, f->polygons[side->portal + 1], flags, TL_NAV_NO_REF);
    }
    f->apex = side->point;
    f->portal = side->portal + 1;
    f->left.point = f->apex;
    f->right.point = f->apex;
}

// Whether `point` lies at least as far from the apex as `side`, which is on the same line.
static bool is_no_nearer(const funnel *f, const wedge_side *side, tl_vec3 point)
{
    double x = (double)side->point.x - (double)f->apex.x;
    double z = (double)side->point.z - (double)f->apex.z;
    return x * ((double)point.x - (double)side->point.x) + z * ((double)point.z - (double)side->point.z) >= 0.0;
}

// Whether `point`, an end of the current portal, lies on or beyond the ray from the apex through the other side.
static bool closes(const funnel *f, const wedge_side *other, int hand, tl_vec3 point, bool *in_line_out)
{
    *in_line_out = false;
    if (tl_nav_is_same_place(other->point, f->apex)) {
        return false;
    }
    // The end of the path is both ends of its portal, and closes nothing by itself.
    if (f->portal == f->last_portal && other->portal == f->portal) {
        return false;
    }
    int side = hand * tl_nav_side_of(f->apex, other->point, point);
    double ahead = ((double)other->point.x - (double)f->apex.x) * ((double)point.x - (double)f->apex.x) +
                   ((double)other->point.z - (double)f->apex.z) * ((double)point.z - (double)f->apex.z);
    *in_line_out = side == 0 && ahead > 0.0;
    return side < 0 || *in_line_out;
}

// Moves one side of the wedge to its end of the current portal, unless that would widen it. `hand` is 1 for the right
// side, -1 for the left one: hand * side_of is < 0 for what lies on the inner side of it.
// Returns true when the wedge has closed: then there is a new apex.
static bool narrow_funnel(funnel *f, wedge_side *own, const wedge_side *other, int hand, tl_vec3 end)
{
    if (tl_nav_is_same_place(end, f->apex)) {
        return false;
    }
    if (!tl_nav_is_same_place(own->point, f->apex)) {
        int side = hand * tl_nav_side_of(f->apex, own->point, end);
        if (side > 0 || (side == 0 && !is_no_nearer(f, own, end))) {
            return false;
        }
    }
    wedge_side moved = { end, f->portal };
    bool in_line = false;
    if (!closes(f, other, hand, end, &in_line)) {
        *own = moved;
        return false;
    }
    // Both ends of one portal in line with the apex: the near one comes first.
    bool own_is_first = in_line && other->portal == f->portal && !is_no_nearer(f, other, end);
    wedge_side first = own_is_first ? moved : *other;
    bool is_left = (hand < 0) == own_is_first;
    turn_funnel(f, &first, is_left ? TL_NAV_CORNER_LEFT : TL_NAV_CORNER_RIGHT);
    return true;
}

// Whether a point lies on a portal, or by rounding beyond it: `hand` 1 means on its far side, -1 on the near one.
static bool is_on_portal(tl_vec3 left, tl_vec3 right, tl_vec3 point, int hand)
{
    if (hand * tl_nav_side_of(right, left, point) < 0) {
        return false;
    }
    double x = (double)left.x - (double)right.x;
    double z = (double)left.z - (double)right.z;
    double along = x * ((double)point.x - (double)right.x) + z * ((double)point.z - (double)right.z);
    return along >= 0.0 && along <= x * x + z * z;
}

// A start that lies beyond its portal by rounding would see it from behind. So portals that the start lies on are
// passed already, and those that the end lies on need not be.
static tl_result pass_ends(funnel *f)
{
    tl_vec3 left, right;
    f->last_portal = f->polygon_count - 1;
    while (f->portal < f->last_portal) {
        TL_TRY(portal_at(f, f->portal, &left, &right));
        if (!is_on_portal(left, right, f->start, 1)) {
            break;
        }
        f->portal++;
    }
    while (f->last_portal > f->portal) {
        TL_TRY(portal_at(f, f->last_portal - 1, &left, &right));
        if (!is_on_portal(left, right, f->end, -1)) {
            break;
        }
        f->last_portal--;
    }
    return TL_OK;
}

// Whether all corners that are wanted are there: of those that were added only the last one may change still.
static bool is_enough(const funnel *f)
{
    return f->only_first && f->list.count > f->list.capacity;
}

static tl_result pull(funnel *f)
{
    while (f->portal <= f->last_portal && !is_enough(f)) {
        tl_vec3 left, right;
        TL_TRY(portal_at(f, f->portal, &left, &right));
        if (f->portal == f->last_portal && tl_nav_is_same_place(f->end, f->apex)) {
            return TL_OK;
        }
        if (!narrow_funnel(f, &f->right, &f->left, 1, right) && !narrow_funnel(f, &f->left, &f->right, -1, left)) {
            f->portal++;
        }
    }
    return TL_OK;
}

tl_result tl_nav_find_link(const tl_navmesh *navmesh, const tl_nav_ref *corridor, tl_vec3 ends_out[2])
{
    tl_nav_offmesh_state link;
    if (tl_navmesh_offmesh_state(navmesh, corridor[1], &link) != TL_OK) {
        return TL_ERR_STALE;
    }
    int from = (corridor[1] & TL_NAV_OFFMESH_BACKWARD) != 0 ? 1 : 0;
    ends_out[0] = link.ends[from].point;
    ends_out[1] = link.ends[1 - from].point;
    bool leads = link.anchored && (from == 0 || link.offmesh.both_ways) && link.ends[from].polygon == corridor[0] &&
                 link.ends[1 - from].polygon == corridor[2];
    return leads ? TL_OK : TL_ERR_ARGUMENT;
}

// From link to link, and from the last one to the end. A piece's first corner stays whatever comes.
static tl_result pull_pieces(funnel *f, const tl_nav_polygon_path *path, tl_vec3 start, tl_vec3 end)
{
    const tl_nav_ref *polygons = path->polygons;
    const uint32_t polygon_count = path->polygon_count;
    for (uint32_t begin = 0; begin < polygon_count && !is_enough(f);) {
        uint32_t next = begin;
        while (next < polygon_count && !tl_nav_is_offmesh(polygons[next])) {
            next++;
        }
        bool is_last = next == polygon_count;
        tl_vec3 link[2] = { end, end };
        if (next == begin || next + 1 == polygon_count) {
            return TL_ERR_ARGUMENT;
        }
        if (!is_last) {
            TL_TRY(tl_nav_find_link(f->navmesh, &polygons[next - 1], link));
        }
        memset(f->kept, 0, sizeof f->kept);
        f->polygons = &polygons[begin];
        f->polygon_count = next - begin;
        f->start = begin == 0 ? start : f->end;
        f->end = link[0];
        f->apex = f->start;
        f->left.point = f->start;
        f->right.point = f->start;
        f->portal = 0;
        f->list.fixed = f->list.count + 1;
        add_funnel_corner(&f->list, f->start, f->polygons[0], begin == 0 ? TL_NAV_CORNER_START : 0, TL_NAV_NO_REF);
        TL_TRY(pass_ends(f));
        TL_TRY(pull(f));
        add_funnel_corner(&f->list, f->end, f->polygons[f->polygon_count - 1],
                          is_last ? TL_NAV_CORNER_END : TL_NAV_CORNER_LINK, is_last ? TL_NAV_NO_REF : polygons[next]);
        f->end = link[1];
        begin = next + 1;
    }
    return TL_OK;
}

static tl_result pull_path(funnel *f, const tl_navmesh *navmesh, const tl_nav_polygon_path *path,
                           tl_nav_corner *corners, uint32_t capacity)
{
    if (path->polygons == NULL || path->polygon_count == 0) {
        return TL_ERR_ARGUMENT;
    }
    if (!tl_nav_is_finite(path->start) || !tl_nav_is_finite(path->end)) {
        return TL_ERR_NOT_FINITE;
    }
    uint32_t slots[2], ends[2];
    if (!tl_nav_split_ref(navmesh, path->polygons[0], &slots[0], &ends[0]) ||
        !tl_nav_split_ref(navmesh, path->polygons[path->polygon_count - 1], &slots[1], &ends[1])) {
        return TL_ERR_STALE;
    }
    bool inside = false;
    f->navmesh = navmesh;
    f->list.corners = corners;
    f->list.capacity = capacity;
    tl_vec3 first = tl_nav_clamp_to_polygon(navmesh->slots[slots[0]].tile, ends[0], path->start, &inside);
    tl_vec3 last = tl_nav_clamp_to_polygon(navmesh->slots[slots[1]].tile, ends[1], path->end, &inside);
    return pull_pieces(f, path, first, last);
}

tl_result tl_nav_first_corners(const tl_navmesh *navmesh, const tl_nav_polygon_path *path, tl_nav_corner *corners_out,
                               uint32_t capacity, uint32_t *count_out)
{
    *count_out = 0;
    funnel f;
    memset(&f, 0, sizeof f);
    f.only_first = true;
    TL_TRY(pull_path(&f, navmesh, path, corners_out, capacity));
    *count_out = f.list.count <= capacity ? f.list.count : capacity;
    return f.list.count <= capacity ? TL_OK : TL_INCOMPLETE;
}

tl_result tl_navmesh_straight_path(const tl_navmesh *navmesh, const tl_nav_polygon_path *path,
                                   tl_nav_corner *corners_out, uint32_t capacity, uint32_t *count_out,
                                   float *length_out)
{
    if (navmesh == NULL || path == NULL || count_out == NULL || (corners_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (length_out != NULL) {
        *length_out = 0.0f;
    }
    funnel f;
    memset(&f, 0, sizeof f);
    TL_TRY(pull_path(&f, navmesh, path, corners_out, capacity));
    *count_out = f.list.count;
    if (length_out != NULL) {
        *length_out = (float)f.list.length;
    }
    return f.list.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
