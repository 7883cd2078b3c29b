// SPDX-License-Identifier: MIT
//
// The validator: each polygon by itself, then its links; polygon_cover.c checks the polygons of one contour together.
// It shares no step with the bake but the sweep that tells whether segments meet (test_sweep compares that with all
// pairs): links are checked in both directions and by one sort of all open edges, convexity by the turning directions.

#include "polygon/check/polygon_check.h"

#include "base/assert.h"
#include "base/host.h"
#include "base/radix_sort.h"

#include <string.h>

const char *tl_polygon_fault_text(tl_polygon_fault fault)
{
    static const char *const texts[TL_POLYGON_FAULT_COUNT] = {
        "an index points outside its array",
        "a polygon has too few or too many corners",
        "a polygon has one corner twice",
        "a polygon is inverted or has no area",
        "a polygon is not strictly convex",
        "two polygons of one contour overlap",
        "a vertex lies inside an edge of its contour's polygons",
        "a link is missing or not returned",
        "a portal is not on the tile's border",
        "the polygons' area is not the contour's",
        "the polygons' outline is not the contour's",
    };
    return (unsigned)fault < TL_POLYGON_FAULT_COUNT ? texts[fault] : "unknown fault";
}

void tl_polygon_checker_note(tl_polygon_checker *checker, tl_polygon_fault fault, const char *element, uint64_t index)
{
    bool is_first = true;
    for (uint32_t i = 0; i < TL_POLYGON_FAULT_COUNT; i++) {
        is_first = is_first && checker->report.counts[i] == 0;
    }
    if (is_first) {
        checker->report.first_fault = fault;
        tl_report_fail(&checker->report.base, TL_ERR_CORRUPT, element, index, tl_polygon_fault_text(fault));
    }
    checker->report.counts[fault]++;
}

static bool ranges_are_good(tl_polygon_checker *c)
{
    const tl_polygon_mesh *mesh = c->mesh;
    bool good = mesh->first[0] == 0 && mesh->first[mesh->polygon_count] == mesh->index_count;
    for (uint32_t p = 0; good && p < mesh->polygon_count; p++) {
        if (mesh->first[p + 1] < mesh->first[p] || mesh->first[p + 1] > mesh->index_count) {
            tl_polygon_checker_note(c, TL_POLYGON_FAULT_RANGE, "polygon", p);
            return false;
        }
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            uint32_t beyond = mesh->neighbours[k];
            bool is_portal = beyond != TL_NO_POLYGON && beyond >= TL_PORTAL && beyond <= (TL_PORTAL | 3u);
            if (mesh->indices[k] >= mesh->vertex_count ||
                (beyond != TL_NO_POLYGON && !is_portal && beyond >= mesh->polygon_count)) {
                tl_polygon_checker_note(c, TL_POLYGON_FAULT_RANGE, "polygon", p);
                return false;
            }
        }
        uint32_t contour = mesh->contours[p];
        if (c->contours != NULL && contour != TL_SEVERAL_CONTOURS && contour >= c->contours->contour_count) {
            tl_polygon_checker_note(c, TL_POLYGON_FAULT_RANGE, "polygon", p);
            return false;
        }
    }
    for (uint64_t v = 0; v < 3 * (uint64_t)mesh->vertex_count; v++) {
        if (mesh->vertices[v] < -TL_MAX_CONTOUR_COORDINATE || mesh->vertices[v] > TL_MAX_CONTOUR_COORDINATE) {
            tl_polygon_checker_note(c, TL_POLYGON_FAULT_RANGE, "vertex", v / 3);
            return false;
        }
    }
    if (!good) {
        tl_polygon_checker_note(c, TL_POLYGON_FAULT_RANGE, "polygon", 0);
    }
    return good;
}

static bool contours_are_good(tl_polygon_checker *c)
{
    const tl_contour_set *set = c->contours;
    for (uint32_t i = 0; set != NULL && i < set->contour_count; i++) {
        const tl_contour *contour = &set->contours[i];
        bool good = contour->first_vertex <= set->vertex_count &&
                    contour->vertex_count <= set->vertex_count - contour->first_vertex;
        for (uint32_t k = 0; good && k < contour->vertex_count; k++) {
            const tl_contour_vertex *v = &set->vertices[contour->first_vertex + k];
            const int32_t limit = TL_MAX_CONTOUR_COORDINATE;
            good = v->x >= -limit && v->x <= limit && v->z >= -limit && v->z <= limit;
        }
        if (!good) {
            tl_polygon_checker_note(c, TL_POLYGON_FAULT_RANGE, "contour", i);
            return false;
        }
    }
    return true;
}

static bool is_late_direction(tl_lattice_point a, tl_lattice_point b)
{
    return !(b.x > a.x || (b.x == a.x && b.z > a.z));
}

// Turns left in each corner, and around once only: the directions leave the early half plane once.
static bool is_convex_polygon(const tl_polygon_mesh *mesh, uint32_t p)
{
    uint32_t rounds = 0;
    for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
        uint32_t next = tl_mesh_next(mesh, p, k);
        tl_lattice_point a = tl_mesh_corner(mesh, k);
        tl_lattice_point b = tl_mesh_corner(mesh, next);
        tl_lattice_point d = tl_mesh_corner(mesh, tl_mesh_next(mesh, p, next));
        if (tl_turn(a, b, d) <= 0) {
            return false;
        }
        rounds += !is_late_direction(a, b) && is_late_direction(b, d);
    }
    return rounds == 1;
}

static bool repeats_corner(const tl_polygon_mesh *mesh, uint32_t p, uint32_t *last_seen)
{
    for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
        if (last_seen[mesh->indices[k]] == p) {
            return true;
        }
        last_seen[mesh->indices[k]] = p;
    }
    return false;
}

static int64_t polygon_area2(const tl_polygon_mesh *mesh, uint32_t p)
{
    uint64_t sum = 0;
    for (uint32_t k = mesh->first[p] + 1; k + 1 < mesh->first[p + 1]; k++) {
        sum += (uint64_t)tl_turn(tl_mesh_corner(mesh, mesh->first[p]), tl_mesh_corner(mesh, k),
                                 tl_mesh_corner(mesh, k + 1));
    }
    return (int64_t)sum;
}

// True: each polygon by itself is in order.
static tl_result check_shapes(tl_polygon_checker *c, bool *good)
{
    const tl_polygon_mesh *mesh = c->mesh;
    uint32_t *last_seen = TL_PUSH(&c->arena, uint32_t, mesh->vertex_count);
    if (last_seen == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(last_seen, 0xff, mesh->vertex_count * sizeof *last_seen);
    *good = true;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        uint32_t corners = mesh->first[p + 1] - mesh->first[p];
        tl_polygon_fault fault = TL_POLYGON_FAULT_COUNT;
        if (corners < 3 || (mesh->max_verts_per_poly != 0 && corners > mesh->max_verts_per_poly)) {
            fault = TL_POLYGON_FAULT_CORNERS;
        } else if (repeats_corner(mesh, p, last_seen)) {
            fault = TL_POLYGON_FAULT_REPEATED;
        } else if (polygon_area2(mesh, p) <= 0) {
            fault = TL_POLYGON_FAULT_INVERTED;
        } else if (!is_convex_polygon(mesh, p)) {
            fault = TL_POLYGON_FAULT_NOT_CONVEX;
        }
        if (fault != TL_POLYGON_FAULT_COUNT) {
            tl_polygon_checker_note(c, fault, "polygon", p);
            *good = false;
        }
    }
    return TL_OK;
}

static void check_portal(tl_polygon_checker *c, uint32_t p, uint32_t place)
{
    if (c->contours == NULL) {
        return;
    }
    tl_lattice_point a = tl_mesh_corner(c->mesh, place);
    tl_lattice_point b = tl_mesh_corner(c->mesh, tl_mesh_next(c->mesh, p, place));
    const int32_t width = c->contours->width, height = c->contours->height;
    const bool on_side[4] = { a.x == 0 && b.x == 0, a.z == height && b.z == height, a.x == width && b.x == width,
                              a.z == 0 && b.z == 0 };
    if (c->contours->border_size <= 0 || !on_side[c->mesh->neighbours[place] & 3u]) {
        tl_polygon_checker_note(c, TL_POLYGON_FAULT_PORTAL, "polygon", p);
    }
}

// An edge: the polygon that has it, the one across, and whether it rises to the vertex of the larger number.
typedef struct edge_end {
    uint32_t polygon, across;
    bool rises;
} edge_end;

static edge_end edge_end_of(const tl_polygon_mesh *mesh, const tl_sort_item *item)
{
    const uint32_t next = tl_mesh_next(mesh, item->extra, item->value);
    const edge_end end = { item->extra, mesh->neighbours[item->value],
                           mesh->indices[item->value] < mesh->indices[next] };
    return end;
}

// All edges that are open, or that are linked, as items: their places, and their polygons as `extra`. With room to
// sort.
static tl_result gather_mesh_edges(tl_polygon_checker *c, bool open, tl_sort_item **items_out, uint32_t *count_out)
{
    const tl_polygon_mesh *mesh = c->mesh;
    tl_sort_item *items = TL_PUSH(&c->arena, tl_sort_item, 2 * (uint64_t)mesh->index_count);
    if (items == NULL) {
        return TL_ERR_MEMORY;
    }
    uint32_t count = 0;
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            if (open ? mesh->neighbours[k] == TL_NO_POLYGON : mesh->neighbours[k] < mesh->polygon_count) {
                const tl_sort_item item = { 0, k, p };
                items[count++] = item;
            }
        }
    }
    *items_out = items;
    *count_out = count;
    return TL_OK;
}

// By the two vertices, whichever way an edge runs.
static void sort_by_vertices(const tl_polygon_mesh *mesh, tl_sort_item *items, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t from = mesh->indices[items[i].value];
        const uint32_t to = mesh->indices[tl_mesh_next(mesh, items[i].extra, items[i].value)];
        items[i].key = from < to ? (uint64_t)from << 32 | to : (uint64_t)to << 32 | from;
    }
    tl_radix_sort(items, items + count, count);
}

// Two open edges that run along each other in opposite directions should have been linked. Sorted by their vertices,
// they stand side by side.
static tl_result check_open_edges(tl_polygon_checker *c)
{
    tl_sort_item *items = NULL;
    uint32_t count = 0;
    TL_TRY(gather_mesh_edges(c, true, &items, &count));
    sort_by_vertices(c->mesh, items, count);
    for (uint32_t i = 0; i < count;) {
        bool falls = false, rises = false;
        const uint32_t first = i;
        for (; i < count && items[i].key == items[first].key; i++) {
            const bool up = edge_end_of(c->mesh, &items[i]).rises;
            falls = falls || !up;
            rises = rises || up;
        }
        if (falls && rises) {
            tl_polygon_checker_note(c, TL_POLYGON_FAULT_LINK, "polygon", items[first].extra);
        }
    }
    return TL_OK;
}

static bool is_before(const edge_end *a, const edge_end *b)
{
    return a->polygon != b->polygon ? a->polygon < b->polygon
                                    : (a->across != b->across ? a->across < b->across : a->rises < b->rises);
}

// Whether a run of links, sorted by is_before, has the one that leads back.
static bool has_link_back(const tl_polygon_mesh *mesh, const tl_sort_item *run, uint32_t count, const edge_end *end)
{
    const bool is_point = run->key >> 32 == (uint32_t)run->key; // an edge from a vertex to itself
    const edge_end back = { end->across, end->polygon, !end->rises && !is_point };
    uint32_t low = 0;
    for (uint32_t rest = count; rest > 0;) {
        const uint32_t half = rest / 2;
        const edge_end at = edge_end_of(mesh, &run[low + half]);
        const bool below = is_before(&at, &back);
        low = below ? low + half + 1 : low;
        rest = below ? rest - half - 1 : half;
    }
    const edge_end found = low < count ? edge_end_of(mesh, &run[low]) : *end;
    return low < count && !is_before(&back, &found);
}

// Sorts linked edges by their vertices, and those of the same by is_before. A polygon may have as many links as
// corners, and a wrong mesh any number of links over one edge, so none is looked for one by one.
static void sort_links(const tl_polygon_mesh *mesh, tl_sort_item *items, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        const edge_end end = edge_end_of(mesh, &items[i]);
        items[i].key = (uint64_t)end.across << 1 | end.rises;
    }
    tl_radix_sort(items, items + count, count);
    for (uint32_t i = 0; i < count; i++) {
        items[i].key = items[i].extra;
    }
    tl_radix_sort(items, items + count, count);
    sort_by_vertices(mesh, items, count);
}

static tl_result check_links(tl_polygon_checker *c)
{
    const tl_polygon_mesh *mesh = c->mesh;
    tl_sort_item *items = NULL;
    uint32_t count = 0;
    TL_TRY(gather_mesh_edges(c, false, &items, &count));
    sort_links(mesh, items, count);
    uint8_t *is_returned = TL_PUSH_ZERO(&c->arena, uint8_t, mesh->index_count);
    if (is_returned == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t first = 0, end = 0; first < count; first = end) {
        while (end < count && items[end].key == items[first].key) {
            end++;
        }
        for (uint32_t i = first; i < end; i++) {
            const edge_end link = edge_end_of(mesh, &items[i]);
            is_returned[items[i].value] =
                link.across != link.polygon && has_link_back(mesh, items + first, end - first, &link);
        }
    }
    for (uint32_t p = 0; p < mesh->polygon_count; p++) {
        for (uint32_t k = mesh->first[p]; k < mesh->first[p + 1]; k++) {
            if (mesh->neighbours[k] < mesh->polygon_count) {
                if (!is_returned[k]) {
                    tl_polygon_checker_note(c, TL_POLYGON_FAULT_LINK, "polygon", p);
                }
            } else if (mesh->neighbours[k] != TL_NO_POLYGON) {
                check_portal(c, p, k);
            }
        }
    }
    return check_open_edges(c);
}

static tl_result check_polygon_mesh(tl_polygon_checker *c)
{
    if (!ranges_are_good(c) || !contours_are_good(c)) {
        return TL_OK;
    }
    bool shapes_are_good;
    TL_TRY(check_shapes(c, &shapes_are_good));
    TL_TRY(check_links(c));
    return shapes_are_good ? tl_polygon_check_cover(c) : TL_OK;
}

tl_result tl_polygon_mesh_check(const tl_polygon_mesh *mesh, const tl_contour_set *contours,
                                const tl_allocator *allocator, tl_polygon_check_report *report_out)
{
    tl_polygon_checker checker;
    memset(&checker, 0, sizeof checker);
    checker.mesh = mesh;
    checker.contours = contours;
    tl_report_begin(&checker.report.base, "polygon check");
    tl_arena_init(&checker.arena, allocator);
    tl_result result = tl_refuse_null(mesh, "mesh", &checker.report.base);
    if (result == TL_OK) {
        result = check_polygon_mesh(&checker);
    }
    checker.report.base.peak_bytes = checker.arena.peak_bytes;
    tl_arena_free(&checker.arena);
    if (result == TL_OK && checker.report.base.element != NULL) {
        result = TL_ERR_CORRUPT;
    }
    if (report_out != NULL) {
        *report_out = checker.report;
    }
    return result;
}
