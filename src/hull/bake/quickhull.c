// SPDX-License-Identifier: MIT
//
// Quickhull: from a tetrahedron outward, each step adds the farthest point of some face, until no point is outside.
// Source: Barber, Dobkin, Huhdanpaa, The Quickhull Algorithm for Convex Hulls, ACM TOMS 22, 1996.
//
// Where it differs: the paper bounds rounding by thick facets and merges what becomes concave; here every side test is
// exact, so nothing can become concave. A face is visible only when the point is strictly in front of it. The visible
// faces then are those that a point just inside of the new one would see, hence a disk with a simple horizon; and a new
// triangle is never degenerate, since a point on the line of a horizon edge lies in the plane of the visible face
// there. Coplanar triangles are merged once, at the end: merging on the way saves no predicate.

#include "hull/bake/quickhull.h"

#include "base/assert.h"
#include "base/host.h"
#include "base/min_max.h"
#include "hull/bake/file_points.h"
#include "hull/bake/flat_regions.h"

#include <string.h>

// Capacity for faces: a first block, then each as large as all that may come, within this factor.
#define FACES_A_STEP 64u
#define FACE_GROWTH  8u

// Of many points most lie well inside: until the hull has some faces the farthest point of all is added, which leaves
// those behind at once. From then on the newest face's is, as its neighbours and points are in the cache. Where a
// tolerance or a number of vertices is to be met the order stays, and with a tolerance fewer points are enough from
// then on, as each is filed where it tells most.
enum { MANY_POINTS = 256, FIRST_LOOK = 24, FIRST_FACES = 128 };

// In which points are measured for the tolerance: one for most bodies, up to a dozen for thin plates.
enum { MAX_TOLERANCE_ROUNDS = 32 };

// No point is near enough to a face's plane to stay outside.
#define ANY_DISTANCE (-(double)INFINITY)

// On the stack: enough for the hull of a dozen points.
enum { MEMORY_BYTES = 8 * 1024 };

tl_hull_def tl_default_hull_def(void)
{
    tl_hull_def def;
    memset(&def, 0, sizeof def);
    def.flatness = 8.0f;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

uint32_t tl_quickhull_new_face(tl_quickhull *hull, uint32_t a, uint32_t b, uint32_t c)
{
    uint32_t index = hull->free_face;
    if (index != TL_NONE) {
        hull->free_face = hull->faces[index].vertex[0];
    } else {
        TL_ASSERT(hull->face_count < hull->face_capacity);
        index = hull->face_count++;
        hull->conflicts[index].seen = 0;
    }
    tl_quickhull_face *face = &hull->faces[index];
    face->vertex[0] = a;
    face->vertex[1] = b;
    face->vertex[2] = c;
    face->across[0] = face->across[1] = face->across[2] = TL_NONE;
    const tl_quickhull_point *local = hull->local;
    face->plane = tl_side_plane_make(local[a].position, local[b].position, local[c].position, hull->reach);
    tl_quickhull_conflicts *conflicts = &hull->conflicts[index];
    conflicts->first = TL_NONE;
    conflicts->farthest = TL_NONE;
    conflicts->farthest_value = 0.0;
    conflicts->live = true;
    hull->live_faces++;
    return index;
}

void tl_quickhull_free_face(tl_quickhull *hull, uint32_t index)
{
    tl_quickhull_unqueue(hull, index);
    hull->conflicts[index].live = false;
    hull->conflicts[index].first = TL_NONE;
    hull->faces[index].vertex[0] = hull->free_face;
    hull->free_face = index;
    hull->live_faces--;
}

tl_result tl_quickhull_reserve(tl_quickhull *hull, uint32_t more)
{
    uint32_t needed = hull->live_faces + more;
    if (needed <= hull->face_capacity) {
        return TL_OK;
    }
    // As many as there will be if every point that waits becomes a corner (Euler), and some for a step; but no more
    // than some times what it has come to, for of a solid cloud few do.
    uint64_t most = (uint64_t)hull->live_faces + 2 * (uint64_t)hull->waiting + FACES_A_STEP;
    uint64_t growth = FACE_GROWTH * (uint64_t)needed;
    uint32_t capacity = (uint32_t)tl_min_u64(most, growth);
    capacity = tl_max_u32(capacity, needed);
    tl_quickhull_face *faces = TL_PUSH(hull->arena, tl_quickhull_face, capacity);
    tl_quickhull_conflicts *conflicts = TL_PUSH(hull->arena, tl_quickhull_conflicts, capacity);
    uint32_t *visible = TL_PUSH(hull->arena, uint32_t, capacity);
    // A disk of n triangles has at most n + 2 border edges.
    uint32_t *horizon = TL_PUSH(hull->arena, uint32_t, (uint64_t)capacity + 2);
    uint32_t *created = TL_PUSH(hull->arena, uint32_t, (uint64_t)capacity + 2);
    if (faces == NULL || conflicts == NULL || visible == NULL || horizon == NULL || created == NULL) {
        return TL_ERR_MEMORY;
    }
    if (hull->face_count > 0) {
        TL_TRY(tl_stage_copy(hull->stage, faces, hull->faces, hull->face_count * sizeof *faces));
        TL_TRY(tl_stage_copy(hull->stage, conflicts, hull->conflicts, hull->face_count * sizeof *conflicts));
        memcpy(visible, hull->visible, hull->visible_count * sizeof *visible);
        memcpy(horizon, hull->horizon, hull->horizon_count * sizeof *horizon);
    }
    hull->faces = faces;
    hull->conflicts = conflicts;
    hull->visible = visible;
    hull->horizon = horizon;
    hull->created = created;
    hull->face_capacity = capacity;
    return TL_OK;
}

static bool is_in_range(tl_vec3 point)
{
    tl_vec3 size = tl_abs(point);
    return tl_maxf(size.x, tl_maxf(size.y, size.z)) <= TL_MAX_HULL_COORDINATE;
}

static tl_result check_points(const tl_vec3 *points, uint32_t count, tl_report *report)
{
    if (count == 0) {
        return tl_report_fail(report, TL_ERR_EMPTY, NULL, TL_NO_ELEMENT, "give at least four points");
    }
    if (points == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "points", "give as many points as count says");
    }
    if (count >= TL_MAX_HULL_POINTS) {
        return tl_report_field(report, TL_ERR_LIMIT, "count", "bake hulls of parts, then of their vertices");
    }
    for (uint32_t i = 0; i < count; i++) {
        if (!tl_is_finite(points[i])) {
            return tl_report_fail(report, TL_ERR_NOT_FINITE, "point", i, "remove or repair this point");
        }
        if (!is_in_range(points[i])) {
            return tl_report_fail(report, TL_ERR_RANGE, "point", i, "use a larger unit");
        }
    }
    return TL_OK;
}

static void measure_box(tl_quickhull *hull, uint32_t count)
{
    hull->box = tl_aabb_empty();
    for (uint32_t i = 0; i < count; i++) {
        hull->box = tl_aabb_add_point(hull->box, hull->points[i]);
    }
}

// Moves the points near the origin, where the bounds of side tests are tight. No coordinate is rounded, so the hull is
// the same.
static tl_result make_local(tl_quickhull *hull)
{
    const uint32_t count = hull->point_count + hull->passive_count;
    if (hull->passive_count > 0) {
        measure_box(hull, count);
    }
    hull->local = TL_PUSH(hull->arena, tl_quickhull_point, count);
    if (hull->local == NULL) {
        return TL_ERR_MEMORY;
    }
    tl_vec3 low = hull->box.min, high = hull->box.max;
    tl_vec3 origin =
        tl_vec3_make(tl_side_origin(low.x, high.x), tl_side_origin(low.y, high.y), tl_side_origin(low.z, high.z));
    hull->origin = origin;
    tl_vec3 reach = tl_max(tl_abs(tl_sub(low, origin)), tl_abs(tl_sub(high, origin)));
    for (uint32_t i = 0; i < count; i++) {
        hull->local[i].position = tl_sub(hull->points[i], origin);
    }
    hull->exact = tl_quickhull_on_lattice(hull->local, count, reach);
    if (!hull->exact) {
        hull->reach[0] = (double)reach.x;
        hull->reach[1] = (double)reach.y;
        hull->reach[2] = (double)reach.z;
    }
    return TL_OK;
}

// Links the four faces of the tetrahedron, turned outward.
static tl_result make_tetrahedron(tl_quickhull *hull, const uint32_t seed[4])
{
    uint32_t a = seed[0], b = seed[1], c = seed[2], d = seed[3];
    if (tl_orient3d(hull->points[a], hull->points[b], hull->points[c], hull->points[d]) > 0) {
        uint32_t swap = b;
        b = c;
        c = swap;
    }
    TL_TRY(tl_quickhull_reserve(hull, 4));
    tl_quickhull_new_face(hull, a, b, c);
    tl_quickhull_new_face(hull, a, d, b);
    tl_quickhull_new_face(hull, b, d, c);
    tl_quickhull_new_face(hull, c, d, a);
    // The twins of a b, b c, c a and so on, in the order above.
    static const uint32_t across[4][3] = { { 6, 10, 14 }, { 13, 8, 0 }, { 5, 12, 1 }, { 9, 4, 2 } };
    for (uint32_t f = 0; f < 4; f++) {
        memcpy(hull->faces[f].across, across[f], sizeof across[f]);
    }
    return TL_OK;
}

// Lets points wait that lie farther out than the tolerance, when none is left that lies so far from the plane of the
// face that it is filed under: beside a sharp edge, or a thin plate's, a point may be near to one plane and far from
// the hull. After some rounds whatever is outside waits, so that a body of needles is not measured once for each.
// False: there are none.
static tl_result find_beyond_tolerance(tl_quickhull *hull, uint32_t *rounds, double *enough, bool *found)
{
    *found = false;
    if (*enough < 0.0) {
        return TL_OK;
    }
    const bool is_last = (*rounds)++ == MAX_TOLERANCE_ROUNDS;
    hull->each_farthest = true;
    TL_TRY(tl_quickhull_enqueue_beyond(hull, is_last ? 0.0 : *enough, found));
    *enough = is_last ? ANY_DISTANCE : *enough;
    return TL_OK;
}

// Whether the farthest points have left behind what they can, or most points are corners, as of a ball.
static bool is_order_spent(const tl_quickhull *hull)
{
    return hull->live_faces >= FIRST_FACES ||
           (hull->live_faces >= FIRST_LOOK && hull->waiting > hull->point_count - hull->point_count / 16);
}

static tl_result add_farthest_points(tl_quickhull *hull, const tl_hull_def *def)
{
    const bool is_ordered = def->max_vertices != 0 || def->tolerance > 0.0f; // to the end
    double enough = def->tolerance > 0.0f ? (double)def->tolerance : ANY_DISTANCE;
    uint32_t rounds = 1;
    for (;;) {
        // A triangulated sphere of F faces has F / 2 + 2 vertices.
        if (def->max_vertices != 0 && hull->live_faces / 2 + 2 >= def->max_vertices) {
            return TL_OK;
        }
        if (hull->live_faces >= FIRST_FACES) {
            hull->each_farthest = def->tolerance > 0.0f;
        }
        if (hull->farthest_first && !is_ordered && is_order_spent(hull)) {
            tl_quickhull_end_order(hull);
        }
        uint32_t face = tl_quickhull_dequeue(hull, enough);
        if (face == TL_NONE) {
            bool found;
            TL_TRY(find_beyond_tolerance(hull, &rounds, &enough, &found));
            if (!found) {
                return TL_OK;
            }
            continue;
        }
        TL_TRY(tl_quickhull_add_point(hull, face));
        TL_TRY(tl_quickhull_count_work(hull, hull->visible_count + hull->created_count));
        TL_TRY(tl_quickhull_refile(hull));
        for (uint32_t i = 0; i < hull->created_count; i++) {
            TL_TRY(tl_quickhull_enqueue(hull, hull->created[i]));
        }
    }
}

static tl_result fail_without_volume(tl_report *report, tl_result result)
{
    return tl_report_fail(report, result, NULL, TL_NO_ELEMENT,
                          "the points have no volume: set a thickness, or use them as a point cloud");
}

void tl_quickhull_init(tl_quickhull *hull, const tl_vec3 *points, uint32_t count, tl_arena *arena, tl_stage *stage)
{
    memset(hull, 0, sizeof *hull);
    hull->arena = arena;
    hull->stage = stage;
    hull->points = points;
    hull->point_count = count;
    hull->free_face = TL_NONE;
    hull->newest = TL_NONE;
    hull->file_points = tl_file_points_for(tl_cpu_level_up_to(TL_CPU_LEVELS));
}

tl_result tl_quickhull_build(tl_quickhull *hull, const tl_hull_def *def, tl_hull_report *report, uint32_t *copies_out,
                             tl_hull_polygons *polygons_out)
{
    tl_report *base = report != NULL ? &report->base : NULL;
    uint32_t seed[4], rank;
    *copies_out = 1;
    hull->farthest_first = def->max_vertices != 0 || def->tolerance > 0.0f || hull->point_count >= MANY_POINTS;
    measure_box(hull, hull->point_count);
    tl_result result = tl_quickhull_seed(hull, (double)def->flatness, seed, &rank);
    if (result != TL_OK && def->thickness > 0.0f) {
        TL_TRY(tl_quickhull_thicken(hull, seed, rank, def->thickness, copies_out));
        measure_box(hull, hull->point_count);
        if (!is_in_range(hull->box.min) || !is_in_range(hull->box.max)) {
            return tl_report_field(base, TL_ERR_RANGE, "thickness", "make it smaller, or use a larger unit");
        }
        result = tl_quickhull_seed(hull, 0.0, seed, &rank);
    }
    if (result != TL_OK) {
        return fail_without_volume(base, result);
    }
    hull->cone_face = TL_PUSH(hull->arena, uint32_t, hull->point_count);
    if (hull->cone_face == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(make_local(hull));
    TL_TRY(make_tetrahedron(hull, seed));
    TL_TRY(tl_quickhull_file_all(hull, seed));
    for (uint32_t i = 0; i < 4; i++) {
        TL_TRY(tl_quickhull_enqueue(hull, i));
    }
    TL_TRY(add_farthest_points(hull, def));
    if (report != NULL) {
        report->triangle_count = hull->live_faces;
        report->thickened = *copies_out > 1;
        uint32_t beyond_count;
        report->points_left_out = hull->waiting;
        TL_TRY(tl_quickhull_measure_left_out(hull, (double)INFINITY, NULL, &beyond_count, &report->max_outside));
    }
    return tl_quickhull_merge_faces(hull, polygons_out);
}

// The exact hull of corners, and the same with nearly flat faces merged.
static tl_result merge_and_encode(tl_quickhull *hull, const tl_hull_polygons *exact, float distance, uint32_t copies,
                                  tl_hull **hull_out)
{
    tl_hull_polygons merged = *exact;
    if (distance > 0.0f) {
        TL_TRY(tl_hull_merge_flat_regions(exact, hull->points, distance, hull->arena, hull->stage, &merged));
    }
    const tl_hull_polygons *polygons = merged.face_count < exact->face_count ? &merged : exact;
    return tl_hull_encode(polygons, hull->points, hull->named, copies, hull->arena, hull->stage, hull_out);
}

// The exact hull, then what the def's distances make of it.
static tl_result bake_polytope(tl_quickhull *hull, const tl_hull_def *def, tl_hull **hull_out, tl_hull_report *report)
{
    uint32_t copies;
    tl_hull_polygons exact;
    TL_TRY(tl_quickhull_build(hull, def, report, &copies, &exact));
    const uint32_t corners = exact.vertex_count;
    double outside = 0.0;
    if (def->weld_distance > 0.0f || def->merge_distance > 0.0f) {
        TL_TRY(tl_hull_simplify(hull->points, def, hull->arena, &exact, &outside));
    }
    if (report != NULL) {
        report->corners_left_out = corners - exact.vertex_count;
        report->max_outside += outside;
    }
    return merge_and_encode(hull, &exact, def->merge_distance, copies, hull_out);
}

tl_result tl_hull_bake_merged(const tl_hull *corners, float distance, const tl_allocator *allocator, tl_hull **hull_out)
{
    const uint32_t count = corners->vertex_count;
    tl_hull_def def = tl_default_hull_def();
    def.flatness = 0.0f;
    tl_arena arena;
    tl_arena_init(&arena, allocator);
    tl_quickhull hull;
    tl_stage stage = { .name = "hull", .total = count };
    tl_quickhull_init(&hull, tl_hull_vertices(corners), count, &arena, &stage);
    hull.named = corners;
    tl_hull_polygons exact;
    uint32_t copies;
    tl_result result = tl_quickhull_build(&hull, &def, NULL, &copies, &exact);
    if (result == TL_OK) {
        result =
            exact.vertex_count == count ? merge_and_encode(&hull, &exact, distance, copies, hull_out) : TL_ERR_CORRUPT;
    }
    tl_arena_free(&arena);
    return result;
}

static tl_result check_hull_def(const tl_hull_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_hull_def()", report));
    if (def->max_vertices != 0 && def->max_vertices < 4) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_vertices", "give 0 for no limit, or at least 4");
    }
    if (!(def->tolerance >= 0.0f) || !isfinite(def->tolerance)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "tolerance", "give metres, 0 or more");
    }
    if (!(def->thickness >= 0.0f) || !isfinite(def->thickness)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "thickness", "give metres, 0 or more");
    }
    if (!(def->flatness >= 0.0f)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "flatness", "give half ulps, 0 or more");
    }
    if (!(def->weld_distance >= 0.0f) || !isfinite(def->weld_distance)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "weld_distance", "give metres, 0 or more");
    }
    if (!(def->merge_distance >= 0.0f) || !isfinite(def->merge_distance)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "merge_distance", "give metres, 0 or more");
    }
    return TL_OK;
}

tl_result tl_hull_bake(const tl_vec3 *points, uint32_t count, const tl_hull_def *def, tl_hull **hull_out,
                       tl_hull_report *report_out)
{
    return tl_hull_bake_named(points, count, NULL, def, hull_out, report_out);
}

tl_result tl_hull_bake_named(const tl_vec3 *points, uint32_t count, const tl_hull *named, const tl_hull_def *def,
                             tl_hull **hull_out, tl_hull_report *report_out)
{
    const tl_hull_def defaults = tl_default_hull_def();
    def = def != NULL ? def : &defaults;
    tl_report *base = NULL;
    if (report_out != NULL) {
        memset(report_out, 0, sizeof *report_out);
        base = &report_out->base;
    }
    tl_report_begin(base, "hull");
    if (hull_out == NULL) {
        return tl_report_field(base, TL_ERR_ARGUMENT, "hull_out", "give where the hull goes");
    }
    *hull_out = NULL;
    TL_TRY(check_hull_def(def, base));
    TL_TRY(check_points(points, count, base));
    tl_arena arena;
    _Alignas(64) char memory[MEMORY_BYTES];
    tl_arena_init_with(&arena, def->host.allocator, memory, sizeof memory);
    tl_quickhull hull;
    tl_stage stage;
    tl_quickhull_init(&hull, points, count, &arena, &stage);
    hull.named = named;
    const tl_host serial = { def->host.allocator, NULL, def->host.progress };
    tl_result result = tl_stage_begin(&stage, &serial, "hull", count);
    result = result == TL_OK ? bake_polytope(&hull, def, hull_out, report_out) : result;
    result = result == TL_OK ? tl_stage_end(&stage) : result;
    if (result != TL_OK) {
        tl_blob_free(*hull_out);
        *hull_out = NULL;
    }
    if (base != NULL) {
        base->peak_bytes = arena.peak_bytes + (*hull_out != NULL ? (*hull_out)->blob.size : 0);
    }
    tl_arena_free(&arena);
    return result;
}
