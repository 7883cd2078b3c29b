// SPDX-License-Identifier: MIT
//
// Where a convex shape rests on the triangles of a soup, without ghost contacts at inner edges.
//
// A soup knows no neighbours. Whether an edge or corner stands out is asked of the geometry when it matters: the
// triangles that hold the point of contact are looked up, and if none rises above the plane across the normal, the
// contact is one with the whole surface (its normal lies in the surface's normal cone there; Ericson, Real-Time
// Collision Detection, 2005, 5.1.5). Marking edges when the mesh is baked, as physics engines do, needs welded meshes
// without T-junctions, and nothing that moves.

#include "base/assert.h"
#include "math/tolerance.h"
#include "soup/query/query_shape.h"
#include "soup/query/region_walk.h"
#include "soup/triangle/triangle_point.h"

#include <math.h>
#include <string.h>

// A normal this near to the triangle's is the triangle's: 1 - cos of a thousandth.
#define FACE_ANGLE 5e-7

// How far a corner may rise above the plane across a contact's normal, over its distance from the contact.
#define RISE 1e-4

// Triangles meet at a point that is this near to both, over the size of its coordinates: points are floats, rounded
// after a few steps.
#define MEETING_GAP (16.0f * TL_FLOAT_ROUNDING)

typedef struct contact_walk {
    const tl_soup *soup;
    const tl_soup_contact_query *query;
    tl_query_shape shape;
    tl_aabb box; // of the shape, grown by the margin
    tl_soup_contact *contacts;
    uint32_t capacity, count;
} contact_walk;

// Whether all triangles at a point lie below the plane across a normal there.
typedef struct plane_test {
    const struct contact_walk *walk;
    tl_vec3 point;
    tl_vec3d normal;
    tl_aabb box;
    float gap;
    bool rises;
} plane_test;

static double rise_above(const plane_test *t, tl_vec3 corner, double *distance)
{
    tl_vec3d to = tl_vec3d_sub(tl_vec3d_from(corner), tl_vec3d_from(t->point));
    *distance = tl_vec3d_length(to);
    return tl_vec3d_dot(to, t->normal);
}

static tl_aabb grown_box(tl_aabb box, float by)
{
    const tl_vec3 all = tl_vec3_make(by, by, by);
    tl_aabb grown = { tl_sub(box.min, all), tl_add(box.max, all) };
    return grown;
}

static bool is_accepted(const contact_walk *w, const tl_walk_triangle *triangle)
{
    return w->query->filter == NULL || tl_ray_filter_accepts(w->soup, w->query->filter, triangle->triangle,
                                                             tl_query_shape_sees(&w->shape, triangle->corners));
}

static bool rises_at_point(const plane_test *t, const tl_vec3 corners[3])
{
    bool rises = false;
    for (int i = 0; i < 3; i++) {
        double distance, rise = rise_above(t, corners[i], &distance);
        rises = rises || rise > RISE * distance + (double)t->gap;
    }
    if (!rises) { // the exact distance only where it matters
        return false;
    }
    tl_convex shape = tl_convex_triangle(corners[0], corners[1], corners[2], 0.0f),
              point = tl_convex_sphere(t->point, t->gap);
    return tl_convex_overlap(&shape, tl_transform_identity(), &point, tl_transform_identity(), NULL);
}

// Here a triangle that comes twice does no harm, so none is said to belong: that it is the first copy takes another
// walk, on a stack where one walk is under way already.
static bool look_at_neighbour(const tl_walk_triangle *triangle, void *user)
{
    plane_test *t = user;
    t->rises = t->rises || (tl_aabb_overlaps(tl_walk_triangle_box(triangle), t->box) &&
                            is_accepted(t->walk, triangle) && rises_at_point(t, triangle->corners));
    return false;
}

static bool go_on(const tl_walk_triangle *triangle, void *user)
{
    (void)triangle;
    (void)user;
    return true;
}

// Of several contacts a point of the edge that they lie on, which is no end of it.
static tl_vec3 middle_contact(const tl_contact_manifold *manifold)
{
    tl_vec3 sum = manifold->contacts[0].point_a;
    for (uint32_t i = 1; i < manifold->count; i++) {
        sum = tl_add(sum, manifold->contacts[i].point_a);
    }
    return manifold->count > 1 ? tl_scale(sum, 1.0f / (float)manifold->count) : sum;
}

static bool stands_out(const contact_walk *w, const tl_walk_triangle *triangle, const tl_contact_manifold *manifold)
{
    plane_test t;
    tl_triangle_point nearest;
    const tl_vec3 corners[3] = { triangle->corners[0], triangle->corners[1], triangle->corners[2] };
    tl_triangle_nearest(corners, tl_vec3d_from(middle_contact(manifold)), &nearest);
    t.walk = w;
    t.point = tl_vec3d_to_float(nearest.point);
    tl_vec3 size = tl_abs(t.point);
    t.gap = MEETING_GAP * (tl_maxf(size.x, tl_maxf(size.y, size.z)) + tl_length(tl_aabb_size(w->box)));
    t.normal = tl_vec3d_from(manifold->normal);
    t.box.min = t.box.max = t.point;
    t.box = grown_box(t.box, t.gap);
    t.rises = false;
    tl_region region = { .box = &t.box, .belongs = look_at_neighbour, .found = go_on, .user = &t };
    tl_region_walk(w->soup, &region);
    return !t.rises;
}

// Unit, towards the shape's middle; zero for a triangle without an area.
static tl_vec3d face_normal_to(const tl_walk_triangle *triangle, tl_vec3 middle)
{
    tl_vec3d a = tl_vec3d_from(triangle->corners[0]), b = tl_vec3d_from(triangle->corners[1]),
             c = tl_vec3d_from(triangle->corners[2]);
    tl_vec3d n = tl_vec3d_cross(tl_vec3d_sub(b, a), tl_vec3d_sub(c, a));
    double length = tl_vec3d_length(n), side = tl_vec3d_dot(n, tl_vec3d_sub(tl_vec3d_from(middle), a));
    return tl_vec3d_scale(n, length > 0.0 ? (side < 0.0 ? -1.0 : 1.0) / length : 0.0);
}

static bool is_wanted(const tl_walk_triangle *triangle, void *user)
{
    const contact_walk *w = user;
    return is_accepted(w, triangle);
}

static bool add_triangle(const tl_walk_triangle *triangle, void *user)
{
    contact_walk *w = user;
    const tl_soup_contact_query *q = w->query;
    const tl_convex face = tl_convex_triangle(triangle->corners[0], triangle->corners[1], triangle->corners[2], 0.0f);
    const tl_transform here = tl_transform_identity();
    tl_soup_contact found;
    memset(&found, 0, sizeof found);
    if (tl_convex_contacts(&face, here, q->shape, q->pose, &q->limits, NULL, &found.manifold) == 0) {
        return true;
    }
    tl_vec3d normal = face_normal_to(triangle, w->shape.middle);
    found.is_face = tl_vec3d_dot(normal, tl_vec3d_from(found.manifold.normal)) >= 1.0 - FACE_ANGLE;
    if (!found.is_face && !stands_out(w, triangle, &found.manifold)) {
        found.is_face = true;
        if (tl_vec3d_dot(normal, normal) == 0.0 ||
            tl_convex_contacts_along(&face, here, q->shape, q->pose, tl_vec3d_to_float(normal), &q->limits,
                                     &found.manifold) == 0) {
            return true;
        }
    }
    found.triangle = triangle->triangle;
    found.material = tl_soup_material(w->soup, triangle->triangle);
    if (w->count < w->capacity) {
        w->contacts[w->count] = found;
    }
    w->count++;
    return true;
}

tl_result tl_soup_find_contacts(const tl_soup *soup, const tl_soup_contact_query *query, tl_soup_contact *contacts_out,
                                uint32_t capacity, uint32_t *count_out)
{
    if (count_out == NULL) {
        return TL_ERR_ARGUMENT;
    }
    *count_out = 0;
    if (soup == NULL || query == NULL || query->shape == NULL || (contacts_out == NULL && capacity > 0)) {
        return TL_ERR_ARGUMENT;
    }
    if (!isfinite(query->limits.margin) || isnan(query->limits.tolerance)) {
        return TL_ERR_NOT_FINITE;
    }
    contact_walk w = { .soup = soup, .query = query, .contacts = contacts_out, .capacity = capacity };
    TL_TRY(tl_query_shape_make(query->shape, query->pose, &w.shape));
    w.box = grown_box(w.shape.bounds, tl_maxf(query->limits.margin, 0.0f));
    tl_region region = { .box = &w.box, .belongs = is_wanted, .found = add_triangle, .user = &w };
    tl_region_walk(soup, &region);
    *count_out = w.count;
    return w.count <= capacity ? TL_OK : TL_INCOMPLETE;
}
