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
#include "nav_query/plane/side.h"
#include "nav_query/plane/surface.h"
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

// A place as it is seen from the apex.
typedef struct apex_view {
    double x, z;
} apex_view;

// One side of the wedge: where it is, and the portal that put it there.
typedef struct wedge_side {
    tl_vec3 point;
    apex_view from_apex; // the same; both 0: it stands open, at the apex
    uint32_t portal;
} wedge_side;

// Portals that were looked at last: where a path turns it goes back to those behind the corner.
enum { KEPT_PORTALS = 16 };

typedef struct kept_portal {
    uint32_t number; // of the portal and 1; 0: none
    tl_vec3 left, right;
} kept_portal;

// Which polygon one of a piece is.
typedef struct place_of_polygon {
    uint32_t number; // in the piece and 1; 0: none
    uint32_t slot, polygon;
} place_of_polygon;

typedef struct funnel {
    const tl_navmesh *navmesh;
    const tl_nav_ref *polygons; // of a piece
    uint32_t polygon_count;
    place_of_polygon place; // that was looked at last
    tl_vec3 start, end;
    kept_portal end_portal; // the end itself
    tl_vec3 apex;
    wedge_side left, right; // at the apex: open, no portal has narrowed it yet
    uint32_t portal;        // the one to look at
    uint32_t last_portal;   // the end itself
    bool only_first;        // as many corners as fit are enough
    kept_portal kept[KEPT_PORTALS];
    corner_list list;
} funnel;

// Polygon i of the piece, which is not stale.
static tl_result polygon_at(const funnel *f, uint32_t i, place_of_polygon *place_out)
{
    if (f->place.number == i + 1) {
        *place_out = f->place;
        return TL_OK;
    }
    place_out->number = i + 1;
    return tl_nav_split_ref(f->navmesh, f->polygons[i], &place_out->slot, &place_out->polygon) ? TL_OK : TL_ERR_STALE;
}

static tl_result keep_portal(funnel *f, uint32_t i, kept_portal *kept)
{
    place_of_polygon from, to;
    TL_TRY(polygon_at(f, i, &from));
    TL_TRY(polygon_at(f, i + 1, &to));
    f->place = to;
    const tl_nav_portal_ends ends = { from.slot, from.polygon, to.slot, to.polygon };
    if (!tl_nav_find_portal(f->navmesh, &ends, &kept->left, &kept->right)) {
        return TL_ERR_ARGUMENT;
    }
    kept->number = i + 1;
    return TL_OK;
}

// Portal i leads from polygon i to i + 1; the last one is the end itself.
static inline tl_result portal_at(funnel *f, uint32_t i, const kept_portal **portal_out)
{
    kept_portal *kept = &f->kept[i % KEPT_PORTALS];
    *portal_out = i == f->last_portal ? &f->end_portal : kept;
    return i == f->last_portal || kept->number == i + 1 ? TL_OK : keep_portal(f, i, kept);
}

static apex_view view_from(tl_vec3 apex, tl_vec3 point)
{
    const apex_view view = { (double)point.x - (double)apex.x, (double)point.z - (double)apex.z };
    return view;
}

static bool is_at_apex(apex_view view)
{
    return view.x == 0.0 && view.z == 0.0;
}

// The wedge from an apex on: open.
static void open_funnel(funnel *f, tl_vec3 apex)
{
    const wedge_side open = { apex, { 0.0, 0.0 }, f->portal };
    f->apex = apex;
    f->left = open;
    f->right = open;
}

// Makes a side of the wedge a corner and the apex; the walk continues behind its portal.
static void turn_funnel(funnel *f, const wedge_side *side, uint32_t flags)
{
    const tl_vec3 apex = side->point;
    // A corner in the start's own place is no corner; add_corner sees to all others.
    if (f->list.count > f->list.fixed || !tl_nav_is_same_place(apex, f->start)) {
        add_funnel_corner(&f->list, apex, f->polygons[side->portal + 1], flags, TL_NAV_NO_REF);
    }
    f->portal = side->portal + 1;
    open_funnel(f, apex);
}

// On which hand of a side of the wedge a point lies: tl_nav_side_of(apex, side, point), as both are seen from the apex.
static inline int side_of_wedge(const funnel *f, const wedge_side *side, tl_vec3 point, apex_view view)
{
    const double left = side->from_apex.x * view.z, right = side->from_apex.z * view.x;
    const double turn = left - right, bound = TL_CROSS_ERROR * (fabs(left) + fabs(right));
    return turn > bound ? 1 : turn < -bound ? -1 : tl_nav_side_of(f->apex, side->point, point);
}

// Whether a point lies at least as far from the apex as `side`, which is on the same line.
static bool is_no_nearer(const wedge_side *side, tl_vec3 point)
{
    const apex_view on = view_from(side->point, point);
    return side->from_apex.x * on.x + side->from_apex.z * on.z >= 0.0;
}

// Whether `point`, an end of the current portal, lies on or beyond the ray from the apex through the other side.
static inline bool closes(const funnel *f, const wedge_side *other, int hand, tl_vec3 point, apex_view view,
                          bool *in_line_out)
{
    *in_line_out = false;
    if (is_at_apex(other->from_apex)) {
        return false;
    }
    // The end of the path is both ends of its portal, and closes nothing by itself.
    if (f->portal == f->last_portal && other->portal == f->portal) {
        return false;
    }
    const int side = hand * side_of_wedge(f, other, point, view);
    *in_line_out = side == 0 && other->from_apex.x * view.x + other->from_apex.z * view.z > 0.0;
    return side < 0 || *in_line_out;
}

// Moves one side of the wedge to its end of the current portal, unless that would widen it. `hand` is 1 for the right
// side, -1 for the left one: hand * side_of_wedge is < 0 for what lies on the inner side of it.
// Returns true when the wedge has closed: then there is a new apex.
static inline bool narrow_funnel(funnel *f, wedge_side *own, const wedge_side *other, int hand, tl_vec3 end)
{
    const apex_view view = view_from(f->apex, end);
    if (is_at_apex(view)) {
        return false;
    }
    if (!is_at_apex(own->from_apex)) {
        const int side = hand * side_of_wedge(f, own, end, view);
        if (side > 0 || (side == 0 && !is_no_nearer(own, end))) {
            return false;
        }
    }
    const wedge_side moved = { end, view, f->portal };
    bool in_line = false;
    if (!closes(f, other, hand, end, view, &in_line)) {
        *own = moved;
        return false;
    }
    // Both ends of one portal in line with the apex: the near one comes first.
    const bool own_is_first = in_line && other->portal == f->portal && !is_no_nearer(other, end);
    const wedge_side first = own_is_first ? moved : *other;
    const bool is_left = (hand < 0) == own_is_first;
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
    const kept_portal *portal;
    f->last_portal = f->polygon_count - 1;
    while (f->portal < f->last_portal) {
        TL_TRY(portal_at(f, f->portal, &portal));
        if (!is_on_portal(portal->left, portal->right, f->start, 1)) {
            break;
        }
        f->portal++;
    }
    while (f->last_portal > f->portal) {
        TL_TRY(portal_at(f, f->last_portal - 1, &portal));
        if (!is_on_portal(portal->left, portal->right, f->end, -1)) {
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
        const kept_portal *portal;
        TL_TRY(portal_at(f, f->portal, &portal));
        if (f->portal == f->last_portal && tl_nav_is_same_place(f->end, f->apex)) {
            return TL_OK;
        }
        if (!narrow_funnel(f, &f->right, &f->left, 1, portal->right) &&
            !narrow_funnel(f, &f->left, &f->right, -1, portal->left)) {
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
        f->end_portal.left = f->end;
        f->end_portal.right = f->end;
        f->place.number = 0;
        f->portal = 0;
        open_funnel(f, f->start);
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

// All else is set where a piece begins.
static tl_result pull_path(funnel *f, const tl_navmesh *navmesh, const tl_nav_polygon_path *path,
                           tl_nav_corner *corners, uint32_t capacity, bool only_first)
{
    memset(&f->list, 0, sizeof f->list);
    f->only_first = only_first;
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
    TL_TRY(pull_path(&f, navmesh, path, corners_out, capacity, true));
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
    TL_TRY(pull_path(&f, navmesh, path, corners_out, capacity, false));
    *count_out = f.list.count;
    if (length_out != NULL) {
        *length_out = (float)f.list.length;
    }
    return f.list.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
