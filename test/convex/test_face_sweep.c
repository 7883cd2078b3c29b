// SPDX-License-Identifier: MIT
//
// The corners of the intersection of two faces, against each edge cut by all lines of the other face: random polygons,
// lattice polygons whose edges and corners coincide, and faces of more corners than are kept.

#include "talus_test.h"

#include "convex/contact/face_patch.h"

#include <string.h>

enum { MAX_CORNERS = 12 };

// In the plane y = 0, counter-clockwise seen from above (normal +y), or from below.
static void set_face(tl_face *face, const tl_point2 *points, uint32_t count, bool from_above)
{
    static tl_face empty;
    *face = empty;
    face->count = count;
    for (uint32_t i = 0; i < count; i++) {
        tl_point2 p = points[from_above ? i : count - 1 - i];
        face->corners[i] = tl_vec3d_make(p.y, 0.0, p.x); // z x x = y
        face->vertices[i] = TL_FEATURE_VERTEX | i;
        face->edges[i] = TL_FEATURE_EDGE | i;
    }
    face->feature = TL_FEATURE_FACE;
    face->normal = tl_vec3d_make(0.0, from_above ? 1.0 : -1.0, 0.0);
}

// A convex polygon: sorted angles on an ellipse, or a hull of lattice points.
static uint32_t make_polygon(test_random *random, bool lattice, tl_point2 *out)
{
    tl_point2 all[10];
    uint32_t count = 3 + test_random_below(random, 8);
    float x = test_random_range(random, -1, 1), y = test_random_range(random, -1, 1),
          tall = test_random_range(random, 0.01f, 2.0f);
    for (uint32_t i = 0; i < count; i++) {
        float angle = test_random_range(random, 0, 6.2831853f);
        all[i].x = lattice ? (double)test_random_below(random, 5) : (double)(x + cosf(angle));
        all[i].y = lattice ? (double)test_random_below(random, 5) : (double)(y + tall * sinf(angle));
    }
    // Gift wrapping; collinear points are left out.
    uint32_t first = 0, at, found = 0;
    for (uint32_t i = 1; i < count; i++) {
        first = all[i].x < all[first].x || (all[i].x == all[first].x && all[i].y < all[first].y) ? i : first;
    }
    at = first;
    do {
        uint32_t next = at;
        out[found++] = all[at];
        for (uint32_t i = 0; i < count; i++) {
            double ux = all[next].x - all[at].x, uy = all[next].y - all[at].y, vx = all[i].x - all[at].x,
                   vy = all[i].y - all[at].y, cross = ux * vy - uy * vx;
            bool other = vx != 0.0 || vy != 0.0;
            if (other &&
                ((ux == 0.0 && uy == 0.0) || cross < 0.0 || (cross == 0.0 && vx * vx + vy * vy > ux * ux + uy * uy))) {
                next = i;
            }
        }
        at = next;
    } while ((all[at].x != all[first].x || all[at].y != all[first].y) && found < MAX_CORNERS);
    return found;
}

// Sutherland and Hodgman. Returns the corners of the intersection, perhaps some twice.
static uint32_t clip(const tl_point2 *a, uint32_t a_count, const tl_point2 *b, uint32_t b_count, tl_point2 *out)
{
    tl_point2 from[64];
    uint32_t count = a_count;
    for (uint32_t i = 0; i < count; i++) {
        out[i] = a[i];
    }
    for (uint32_t e = 0; e < b_count; e++) {
        tl_point2 p = b[e], q = b[(e + 1) % b_count];
        uint32_t old = count;
        count = 0;
        for (uint32_t i = 0; i < old; i++) {
            from[i] = out[i];
        }
        for (uint32_t i = 0; i < old; i++) {
            tl_point2 r = from[i], s = from[(i + 1) % old];
            double at_r = (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x),
                   at_s = (q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x);
            if (at_r >= 0.0) {
                out[count++] = r;
            }
            if ((at_r > 0.0 && at_s < 0.0) || (at_r < 0.0 && at_s > 0.0)) {
                double t = at_r / (at_r - at_s);
                tl_point2 x = { r.x + (s.x - r.x) * t, r.y + (s.y - r.y) * t };
                out[count++] = x;
            }
        }
    }
    return count;
}

static double to_segment(double x, double y, tl_point2 p, tl_point2 q)
{
    double ux = q.x - p.x, uy = q.y - p.y, length_sq = ux * ux + uy * uy;
    double t = length_sq > 0.0 ? fmin(fmax(((x - p.x) * ux + (y - p.y) * uy) / length_sq, 0.0), 1.0) : 0.0;
    return hypot(p.x + ux * t - x, p.y + uy * t - y);
}

static double area_of(const tl_point2 *p, uint32_t count)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        sum += p[i].x * p[(i + 1) % count].y - p[i].y * p[(i + 1) % count].x;
    }
    return 0.5 * sum;
}

// Plain C and the processor's own level find the same bits.
static void check_levels(const tl_face *a, const tl_face *b, const tl_patch *patch)
{
    static const tl_patch_heights heights[2] = { { 0.1, 0.2, -0.3 }, { 0.2, 0.1, 0.4 } };
    static tl_patch base, best;
    if (a->count > TL_SMALL_FACE || b->count > TL_SMALL_FACE) {
        return;
    }
    base = best = *patch;
    base.count = best.count = 0;
    base.limit = best.limit = 0.5;
    TEST_CHECK(tl_face_clip_base(a, b, heights, &base) == tl_face_clip(a, b, heights, &best));
    TEST_CHECK(base.count == best.count);
    for (uint32_t i = 0; i < base.count; i++) {
        const tl_patch_point *p = &base.points[i], *q = &best.points[i];
        const double of_base[4] = { p->x, p->y, p->on_a, p->on_b }, of_best[4] = { q->x, q->y, q->on_a, q->on_b };
        TEST_CHECK(memcmp(of_base, of_best, sizeof of_base) == 0);
        TEST_CHECK(p->features[0] == q->features[0] && p->features[1] == q->features[1] && p->previous == q->previous);
        TEST_CHECK(p->on_b - p->on_a <= base.limit);
    }
}

// Each corner found lies on both faces, and each corner of the intersection is found.
static void check_patch(const tl_patch *patch, const tl_point2 *clipped, uint32_t count)
{
    const double gap = 1e-5;
    for (uint32_t i = 0; i < patch->count; i++) {
        tl_vec3d p = tl_vec3d_mul_add(tl_vec3d_scale(patch->u, patch->points[i].x), patch->v, patch->points[i].y);
        double nearest = (double)INFINITY;
        for (uint32_t k = 0; k < count; k++) {
            nearest = fmin(nearest, to_segment(p.z, p.x, clipped[k], clipped[(k + 1) % count]));
        }
        TEST_CHECK(nearest < gap);
    }
    for (uint32_t k = 0; k < count; k++) {
        double nearest = (double)INFINITY;
        for (uint32_t i = 0; i < patch->count; i++) {
            tl_vec3d p = tl_vec3d_mul_add(tl_vec3d_scale(patch->u, patch->points[i].x), patch->v, patch->points[i].y);
            nearest = fmin(nearest, hypot(p.z - clipped[k].x, p.x - clipped[k].y));
        }
        TEST_CHECK(nearest < gap);
    }
}

static void test_polygons(void **state)
{
    (void)state;
    test_random random = { 61 };
    uint32_t together = 0, apart = 0;
    for (int i = 0; i < 100000; i++) {
        tl_point2 a[MAX_CORNERS], b[MAX_CORNERS], both[64];
        bool lattice = i % 2 == 0;
        uint32_t a_count = make_polygon(&random, lattice, a), b_count = make_polygon(&random, lattice, b);
        if (a_count < 3 || b_count < 3) {
            continue;
        }
        tl_face face_a, face_b;
        set_face(&face_a, a, a_count, true);
        set_face(&face_b, b, b_count, false);
        tl_patch patch;
        tl_vec3d normal = tl_vec3d_make(0.0, 1.0, 0.0);
        tl_patch_start(&patch, normal);
        tl_patch_find(&face_a, &face_b, 1.0, NULL, &patch);
        check_levels(&face_a, &face_b, &patch);
        uint32_t count = clip(a, a_count, b, b_count, both);
        // Small faces are cut; swept they have the same corners.
        static const tl_patch_heights flat[2];
        tl_patch swept = patch;
        swept.count = 0;
        tl_face_sweep(&face_a, &face_b, flat, &swept);
        if (area_of(both, count) > 1e-4) {
            check_patch(&patch, both, count);
            check_patch(&swept, both, count);
            together++;
        } else if (count == 0) {
            // What is apart by less than the gap may touch.
            TEST_CHECK(patch.count <= 4 && swept.count <= 4);
            apart++;
        }
    }
    print_message("%u overlap, %u are apart\n", together, apart);
    TEST_CHECK(together > 20000 && apart > 5000);
}

// Prisms of many sides: the patch is the square in the middle of both, whatever is walked.
static void test_faces_of_many_corners(void **state)
{
    (void)state;
    for (uint32_t sides = 20; sides <= 1280; sides *= 2) {
        tl_vec3 *points = malloc(2 * sides * sizeof *points);
        for (uint32_t i = 0; i < sides; i++) {
            double angle = 6.283185307179586 * (double)i / (double)sides;
            points[2 * i] = tl_vec3_make((float)cos(angle), -1.0f, (float)sin(angle));
            points[2 * i + 1] = tl_vec3_make((float)cos(angle), 1.0f, (float)sin(angle));
        }
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, 2 * sides, NULL, &hull, NULL), TL_OK);
        tl_convex prism = tl_convex_from_hull(hull, 0.0f);
        for (int k = 0; k < 20; k++) {
            tl_transform pose = { { 0, sinf(0.3f * (float)k), 0, cosf(0.3f * (float)k) },
                                  { 0.05f * (float)k, 1.999f, 0 } };
            tl_contact_manifold m;
            uint32_t count = tl_convex_contacts(&prism, tl_transform_identity(), &prism, pose,
                                                &(tl_contact_limits){ 0.01f, 0.01f, 0 }, NULL, &m);
            TEST_CHECK(count >= 4 && fabsf(m.normal.y) > 0.999f);
            float low = INFINITY, high = -INFINITY, across = 0.0f;
            for (uint32_t i = 0; i < count; i++) {
                tl_vec3 p = m.contacts[i].point_a;
                low = tl_minf(low, p.x);
                high = tl_maxf(high, p.x);
                across = tl_maxf(across, fabsf(p.z));
                TEST_CHECK(p.x * p.x + p.z * p.z < 1.0001f); // on both discs
                TEST_CHECK((p.x - pose.position.x) * (p.x - pose.position.x) + p.z * p.z < 1.0001f);
            }
            // A lens from pose.x - 1 to 1.
            TEST_CHECK(high - low > 0.6f * (2.0f - pose.position.x) && across > 0.3f * (2.0f - pose.position.x));
        }
        tl_blob_free(hull);
        free(points);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_polygons),
        cmocka_unit_test(test_faces_of_many_corners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
