// SPDX-License-Identifier: MIT
//
// The contact manifold of two shapes: the normal and depth of the distance or penetration query, and where faces or
// edges rest on each other the corners of their common patch.
//
// No angle decides whether faces touch. The two most opposed faces are clipped to their common patch, and of its
// corners those count that are not much farther apart than the deepest point. That is one length, it gives a tilted box
// one edge and a flat one four corners, and it has no angle at which the number of contacts would jump for large faces
// but not for small ones.
//
// Where two edges cross in front of the faces, as corners of bodies do, no corner of the patch is as deep as their
// crossing. The deepest point is always a contact: the query's witness joins the corners then.
//
// The normal comes from the last call where that is proven to serve still (contact_axis.c), of two boxes from their 15
// axes (box_depth.c), and else from GJK and EPA, which goes on from the polytope of the last call (polytope_keep.c).
// The first two know no deepest point: it is a corner of the patch, or the search is made after all.
//
// Where the last normal serves, its proof also tells that B has hardly moved: then the last contacts are kept, each a
// point of A and one of B, and only their separations are new (contact recycling: Catto, Box3D, 2026, there by a bound
// on the motion of its own). A pair at rest takes a third of the time that its faces would.

#include "convex/contact/contact_axis.h"

#include "base/assert.h"
#include "base/min_max.h"
#include "convex/contact/face_patch.h"
#include "convex/depth/epa.h"
#include "math/tolerance.h"

#include <float.h>
#include <string.h>

// A corner of the patch within so many float roundings of the coordinates is the deepest point: sides are plane to
// eight roundings, and so are their planes.
#define DEEPEST_GAP (16.0 * (double)TL_FLOAT_ROUNDING)

typedef struct contact_search {
    tl_minkowski pair;
    double margin, tolerance, radii;
    double slack; // metres that the deepest contact may be off
    tl_contact_cache *cache;
    tl_contact_manifold *out;
    tl_patch patch;
} contact_search;

static void add_deepest(tl_patch *patch, const tl_deepest *deepest)
{
    tl_patch_point point = { tl_vec3d_dot(patch->u, deepest->on_a),          tl_vec3d_dot(patch->v, deepest->on_a),
                             tl_vec3d_dot(patch->normal, deepest->on_a),     tl_vec3d_dot(patch->normal, deepest->on_b),
                             { deepest->features[0], deepest->features[1] }, TL_NO_CONTACT };
    tl_patch_match(patch, &point);
    patch->points[patch->count++] = point;
}

// No point is deeper than the support along the normal. At the tip of a needle, corners that are within rounding of
// both its sides may lie far beyond it, and its plane there below it.
static void raise_points(tl_patch *patch, double separation)
{
    for (uint32_t i = 0; i < patch->count; i++) {
        tl_patch_point *p = &patch->points[i];
        p->on_b = p->on_b - p->on_a < separation ? p->on_a + separation : p->on_b;
    }
}

// The corners of the patch, with the deepest point. False when that is neither among them nor known.
static bool find_common_patch(contact_search *s, const tl_deepest *deepest)
{
    const tl_vec3d normal = tl_vec3d_load_apart(&deepest->normal), back = tl_vec3d_neg(normal);
    const double gap = DEEPEST_GAP * s->pair.scale;
    tl_face face_a, face_b;
    tl_patch_start(&s->patch, normal);
    if (!tl_face_along(s->pair.a, NULL, &normal, &face_a) ||
        !tl_face_along(s->pair.b, &s->pair.b_to_a, &back, &face_b)) {
        return deepest->has_points;
    }
    const double limit = tl_min_f64(deepest->separation + s->tolerance, s->margin + s->radii);
    tl_patch_find(&face_a, &face_b, tl_max_f64(limit, deepest->separation + gap), s->cache, &s->patch);
    double slack = deepest->has_points ? gap : tl_max_f64(gap, s->slack);
    const uint32_t lowest = s->patch.count > 0 ? tl_patch_lowest(&s->patch) : 0;
    if (s->patch.count > 0 && tl_patch_separation(&s->patch.points[lowest]) < deepest->separation - gap) {
        raise_points(&s->patch, deepest->separation);
    }
    if (s->patch.count > 0 && tl_patch_separation(&s->patch.points[lowest]) <= deepest->separation + slack) {
        tl_patch_choose(&s->patch, lowest, tl_max_f64(gap, s->slack));
        return true;
    }
    if (!deepest->has_points) {
        return false;
    }
    // One end of an edge is the deepest point itself.
    if (s->patch.count < 2 && (face_a.count == 2 || face_b.count == 2)) {
        s->patch.count = 0;
    }
    if (s->patch.count > 0) {
        add_deepest(&s->patch, deepest);
        tl_patch_choose(&s->patch, s->patch.count - 1, tl_max_f64(gap, s->slack));
    }
    return true;
}

// The next call looks for a contact's features, for its place on A's core, or for the points of both cores.
static void keep_in_cache(contact_search *s, uint32_t contact, tl_vec3d on_a, tl_vec3d on_b, const uint32_t features[2])
{
    tl_contact_cache *cache = s->cache;
    if (cache != NULL) {
        const tl_frame *b_to_a = &s->pair.b_to_a;
        cache->points[contact] = tl_vec3d_to_float(on_a);
        cache->points_b[contact] = tl_vec3d_to_float(tl_frame_rotate_back(b_to_a, tl_vec3d_sub(on_b, b_to_a->origin)));
        cache->features[contact][0] = features[0];
        cache->features[contact][1] = features[1];
    }
}

// The deepest points alone.
static void write_deepest(contact_search *s, const tl_deepest *deepest)
{
    const tl_minkowski *pair = &s->pair;
    tl_contact *contact = &s->out->contacts[0];
    tl_vec3d normal = deepest->normal;
    contact->point_a = tl_minkowski_to_world(pair, tl_vec3d_mul_add(deepest->on_a, normal, (double)pair->a->radius));
    contact->point_b = tl_minkowski_to_world(pair, tl_vec3d_mul_add(deepest->on_b, normal, -(double)pair->b->radius));
    contact->separation = (float)(tl_vec3d_dot(normal, tl_vec3d_sub(deepest->on_b, deepest->on_a)) - s->radii);
    contact->feature_a = deepest->features[0];
    contact->feature_b = deepest->features[1];
    bool known = s->cache != NULL && s->cache->count == 1 && deepest->features[0] != 0 &&
                 deepest->features[0] == s->cache->features[0][0] && deepest->features[1] == s->cache->features[0][1];
    contact->previous = known ? 0 : TL_NO_CONTACT;
    keep_in_cache(s, 0, deepest->on_a, deepest->on_b, deepest->features);
    s->out->count = 1;
}

// Points of the patch's plane in the world: the axes are turned once for all.
static void write_patch(contact_search *s, tl_vec3d normal)
{
    const tl_patch *patch = &s->patch;
    const tl_frame *to_world = &s->pair.a_to_world;
    const tl_vec3d u = tl_frame_rotate(to_world, patch->u), v = tl_frame_rotate(to_world, patch->v);
    const double radius_a = (double)s->pair.a->radius, radius_b = (double)s->pair.b->radius;
    for (uint32_t i = 0; i < patch->chosen_count; i++) {
        const tl_patch_point *p = patch->chosen[i];
        tl_contact *contact = &s->out->contacts[i];
        tl_vec3d flat = tl_vec3d_mul_add(tl_vec3d_mul_add(to_world->origin, u, p->x), v, p->y);
        contact->point_a = tl_vec3d_to_float(tl_vec3d_mul_add(flat, normal, p->on_a + radius_a));
        contact->point_b = tl_vec3d_to_float(tl_vec3d_mul_add(flat, normal, p->on_b - radius_b));
        contact->separation = (float)(p->on_b - p->on_a - s->radii);
        contact->feature_a = p->features[0];
        contact->feature_b = p->features[1];
        contact->previous = p->previous;
        tl_vec3d on_a = tl_vec3d_mul_add(tl_vec3d_scale(patch->u, p->x), patch->v, p->y);
        keep_in_cache(s, i, tl_vec3d_mul_add(on_a, patch->normal, p->on_a),
                      tl_vec3d_mul_add(on_a, patch->normal, p->on_b), p->features);
    }
    s->out->count = patch->chosen_count;
}

static void write_manifold(contact_search *s, const tl_deepest *deepest)
{
    const tl_vec3d normal = tl_frame_rotate(&s->pair.a_to_world, deepest->normal);
    s->out->normal = tl_vec3d_to_float(normal);
    s->out->separation = (float)(deepest->separation - s->radii);
    if (s->patch.count == 0) {
        write_deepest(s, deepest);
    } else {
        write_patch(s, normal);
    }
}

static bool finish_manifold(contact_search *s, const tl_deepest *deepest)
{
    if (!find_common_patch(s, deepest)) {
        return false;
    }
    write_manifold(s, deepest);
    return true;
}

// The last contacts again. False where the slack does not cover that: the deepest point is none of them, or one of them
// has gone too far apart.
static bool keep_contacts(contact_search *s, const tl_deepest *deepest)
{
    const tl_minkowski *pair = &s->pair;
    const tl_contact_cache *cache = s->cache;
    tl_vec3d on_a[TL_MAX_CONTACTS];
    double apart[TL_MAX_CONTACTS], least = DBL_MAX, most = -DBL_MAX;
    for (uint32_t i = 0; i < cache->count; i++) {
        on_a[i] = tl_vec3d_from(cache->points[i]);
        const tl_vec3d on_b = tl_frame_point(&pair->b_to_a, tl_vec3d_from(cache->points_b[i]));
        apart[i] = tl_vec3d_dot(deepest->normal, tl_vec3d_sub(on_b, on_a[i]));
        least = apart[i] < least ? apart[i] : least;
        most = apart[i] > most ? apart[i] : most;
    }
    if (!(least <= deepest->separation + s->slack) ||
        !(most <= fmin(deepest->separation + s->tolerance, s->margin + s->radii) + s->slack)) {
        return false;
    }
    const tl_vec3d normal = tl_frame_rotate(&pair->a_to_world, deepest->normal);
    s->out->normal = tl_vec3d_to_float(normal);
    s->out->separation = (float)(deepest->separation - s->radii);
    s->out->count = cache->count;
    for (uint32_t i = 0; i < cache->count; i++) {
        tl_contact *contact = &s->out->contacts[i];
        const tl_vec3d on_core = tl_frame_point(&pair->a_to_world, on_a[i]),
                       point = tl_vec3d_mul_add(on_core, normal, (double)pair->a->radius);
        contact->point_a = tl_vec3d_to_float(point);
        contact->point_b = tl_vec3d_to_float(tl_vec3d_mul_add(point, normal, apart[i] - s->radii));
        contact->separation = (float)(apart[i] - s->radii);
        contact->feature_a = cache->features[i][0];
        contact->feature_b = cache->features[i][1];
        contact->previous = i;
    }
    return true;
}

// A vertex, when all points of the simplex have the same one.
static void simplex_features(const tl_simplex *simplex, uint32_t features[2])
{
    uint32_t a = simplex->points[0].vertex_a, b = simplex->points[0].vertex_b;
    for (uint32_t i = 1; i < simplex->count; i++) {
        a = simplex->points[i].vertex_a == a ? a : TL_NO_VERTEX;
        b = simplex->points[i].vertex_b == b ? b : TL_NO_VERTEX;
    }
    features[0] = a != TL_NO_VERTEX ? TL_FEATURE_VERTEX | a : 0;
    features[1] = b != TL_NO_VERTEX ? TL_FEATURE_VERTEX | b : 0;
}

static void take_depth(contact_search *s, const tl_core_depth *depth, tl_deepest *deepest)
{
    s->out->status = depth->status;
    deepest->normal = depth->normal;
    deepest->on_a = depth->on_a;
    deepest->on_b = depth->on_b;
    deepest->separation = -depth->upper;
    deepest->lower_depth = depth->status == TL_CONVEX_CONVERGED ? depth->lower : 0.0;
}

// By GJK and EPA, which goes on from the last polytope where there is one. False when the shapes are farther apart than
// the margin.
static bool search_deepest(contact_search *s, tl_deepest *deepest)
{
    tl_core_depth depth;
    tl_polytope_cache *polytope = s->cache != NULL ? &s->cache->polytope : NULL;
    deepest->has_points = true;
    deepest->features[0] = deepest->features[1] = 0;
    if (polytope != NULL && tl_epa_resume(&s->pair, polytope, &depth)) {
        take_depth(s, &depth, deepest);
        return true;
    }
    tl_gjk gjk;
    tl_gjk_run(&s->pair, s->cache != NULL ? &s->cache->simplex : NULL, -1.0, &gjk);
    s->out->status = gjk.status;
    if (gjk.overlap) {
        tl_core_depth_find(&s->pair, &gjk, polytope, &depth);
        take_depth(s, &depth, deepest);
        return true;
    }
    if (polytope != NULL) {
        polytope->point_count = 0;
    }
    if (gjk.upper - s->radii > s->margin) {
        return false;
    }
    deepest->normal = gjk.normal;
    tl_simplex_witness(&gjk.simplex, &deepest->on_a, &deepest->on_b);
    simplex_features(&gjk.simplex, deepest->features);
    deepest->separation = gjk.upper;
    deepest->lower_depth = 0.0;
    return true;
}

// By the 15 axes of two boxes that overlap. False of others.
static bool find_box_depth(contact_search *s, tl_deepest *deepest, bool *near_enough)
{
    tl_box box_a, box_b;
    *near_enough = true;
    if (!tl_box_of(s->pair.a, &box_a) || !tl_box_of(s->pair.b, &box_b)) {
        return false;
    }
    tl_box_depth(&s->pair, &box_a, &box_b, deepest);
    *near_enough = deepest->separation - s->radii <= s->margin;
    return deepest->separation <= 0.0;
}

// Whether a depth that is proven now proves the last normal, and that and the last contacts serve again.
static bool keep_near(contact_search *s, const tl_deepest *last, const tl_deepest *deepest)
{
    return deepest->lower_depth > 0.0 && -last->separation - deepest->lower_depth <= s->slack && keep_contacts(s, last);
}

static void store_axis(contact_search *s, const tl_deepest *deepest)
{
    if (s->cache != NULL) {
        tl_axis_store(&s->pair, deepest, s->cache);
    }
}

// The ways from the cheapest on.
static void find_manifold(contact_search *s)
{
    tl_deepest last, deepest;
    const tl_axis_trial trial = s->cache != NULL ? tl_axis_try(&s->pair, s->cache, s->slack, &last) : TL_AXIS_GONE;
    if (trial == TL_AXIS_HOLDS && (keep_contacts(s, &last) || finish_manifold(s, &last))) {
        return;
    }
    bool near_enough;
    if (find_box_depth(s, &deepest, &near_enough)) {
        if (trial == TL_AXIS_NEAR && keep_near(s, &last, &deepest)) {
            return;
        }
        if (finish_manifold(s, &deepest)) {
            store_axis(s, &deepest);
            return;
        }
    }
    near_enough = near_enough && search_deepest(s, &deepest);
    if (near_enough && trial == TL_AXIS_NEAR && keep_near(s, &last, &deepest)) {
        return;
    }
    if (near_enough) {
        finish_manifold(s, &deepest);
        store_axis(s, &deepest);
    } else if (s->cache != NULL) {
        s->cache->has_axis = 0;
    }
}

// False when a pose, shape or limit is not finite.
static bool start_search(contact_search *s, const tl_convex *a, const tl_transform *pose_a, const tl_convex *b,
                         const tl_transform *pose_b, const tl_contact_limits *limits)
{
    s->margin = limits != NULL ? (double)limits->margin : 0.0;
    s->tolerance = limits != NULL ? (double)limits->tolerance : 0.0;
    s->slack = 0.0;
    s->cache = NULL;
    // All of it: how many contacts there will be is as good as random, and a loop over the others a wrong guess.
    memset(s->out, 0, sizeof *s->out);
    if (!tl_minkowski_init(&s->pair, a, pose_a, b, pose_b) || isnan(s->margin) || isnan(s->tolerance)) {
        s->out->status = TL_CONVEX_NOT_FINITE;
        return false;
    }
    s->radii = (double)a->radius + (double)b->radius;
    s->pair.depth_steps = limits != NULL && limits->max_steps > 0 ? limits->max_steps : UINT32_MAX;
    return true;
}

uint32_t tl_convex_contacts(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                            const tl_contact_limits *limits, tl_contact_cache *cache, tl_contact_manifold *manifold_out)
{
    TL_ASSERT(a != NULL && b != NULL && manifold_out != NULL);
    contact_search s;
    s.out = manifold_out;
    if (!start_search(&s, a, &pose_a, b, &pose_b, limits)) {
        return manifold_out->count;
    }
    if (cache != NULL && cache->count > TL_MAX_CONTACTS) {
        cache->count = 0; // not what a call left there
    }
    s.cache = cache;
    s.slack = cache != NULL && cache->count > 0 ? (double)TL_CONTACT_SLACK * s.tolerance : 0.0;
    find_manifold(&s);
    if (cache != NULL) {
        cache->count = manifold_out->count;
    }
    return manifold_out->count;
}

// B's farthest point on A's face, when it lies over that.
static void meet_by_point(contact_search *s, const tl_face *face_a, const tl_minkowski_point *point)
{
    tl_face spot = *face_a;
    spot.count = 2;
    spot.first = 0;
    spot.normal = tl_vec3d_neg(s->patch.normal);
    spot.corners[0] = spot.corners[1] = tl_vec3d_sub(point->a, point->w);
    spot.vertices[0] = spot.vertices[1] = point->vertex_b != TL_NO_VERTEX ? TL_FEATURE_VERTEX | point->vertex_b : 0;
    spot.feature = spot.edges[0] = spot.edges[1] = spot.vertices[0];
    spot.offset = tl_vec3d_dot(spot.normal, spot.corners[0]);
    if (face_a->count != 2) {
        tl_patch_find(face_a, &spot, s->margin + s->radii, NULL, &s->patch);
    }
}

static void drop_shallow(tl_patch *patch, double limit)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < patch->count; i++) {
        if (tl_patch_separation(&patch->points[i]) <= limit) {
            patch->points[kept++] = patch->points[i];
        }
    }
    patch->count = kept;
}

uint32_t tl_convex_contacts_along(const tl_convex *a, tl_transform pose_a, const tl_convex *b, tl_transform pose_b,
                                  tl_vec3 normal, const tl_contact_limits *limits, tl_contact_manifold *manifold_out)
{
    TL_ASSERT(a != NULL && b != NULL && manifold_out != NULL);
    contact_search s;
    s.out = manifold_out;
    if (!start_search(&s, a, &pose_a, b, &pose_b, limits)) {
        return manifold_out->count;
    }
    tl_vec3d along = tl_frame_rotate_back(&s.pair.a_to_world, tl_vec3d_from(normal));
    double length = tl_vec3d_length(along);
    if (!(length > 0.0 && length <= DBL_MAX)) {
        manifold_out->status = TL_CONVEX_NOT_FINITE;
        return manifold_out->count;
    }
    tl_deepest deepest;
    deepest.normal = tl_vec3d_scale(along, 1.0 / length);
    tl_minkowski_point point;
    tl_minkowski_support(&s.pair, deepest.normal, &point);
    tl_face face_a, face_b;
    tl_patch_start(&s.patch, deepest.normal);
    if (-tl_vec3d_dot(deepest.normal, point.w) - s.radii <= s.margin &&
        tl_face_along(a, NULL, &deepest.normal, &face_a)) {
        const tl_vec3d back = tl_vec3d_neg(deepest.normal);
        if (tl_face_along(b, &s.pair.b_to_a, &back, &face_b)) {
            tl_patch_find(&face_a, &face_b, s.margin + s.radii, NULL, &s.patch);
        } else {
            meet_by_point(&s, &face_a, &point);
        }
    }
    if (s.patch.count > 0) {
        deepest.separation = tl_patch_separation(&s.patch.points[tl_patch_lowest(&s.patch)]);
        drop_shallow(&s.patch, deepest.separation + fmax(s.tolerance, DEEPEST_GAP * s.pair.scale));
        tl_patch_choose(&s.patch, tl_patch_lowest(&s.patch), DEEPEST_GAP * s.pair.scale);
        write_manifold(&s, &deepest);
    }
    return manifold_out->count;
}
