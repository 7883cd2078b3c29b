// SPDX-License-Identifier: MIT
//
// Pairs of convex shapes on a small lattice, where everything touches, coincides, is flat or parallel. The properties:
// every query ends; the queries agree with one another and with themselves when the shapes are swapped; the depth's
// normal separates the shapes; a cast stops where the distance says they touch.

#include "fuzz/fuzz_input.h"

#include <string.h>
#include <talus/convex.h>

enum { MAX_POINTS = 24 };

static tl_vec3 lattice_point(fuzz_bytes *b, float scale)
{
    uint32_t x = next_byte(b), y = next_byte(b);
    tl_vec3 p = tl_vec3_make((float)(x % 8) - 3, (float)(x / 8 % 8) - 3, (float)(y % 8) - 3);
    return tl_scale(p, scale);
}

typedef struct body {
    tl_vec3 points[MAX_POINTS];
    tl_hull *hull;
    tl_convex shape;
    bool curved;
} body;

static void make_body(body *body, fuzz_bytes *b, float scale)
{
    uint32_t kind = next_byte(b), count = 1 + next_byte(b) % MAX_POINTS;
    float radius = kind & 8u ? 0.0f : 0.5f * scale * (float)(kind >> 4);
    tl_vec3 zero = tl_vec3_make(0, 0, 0), up = tl_vec3_make(0, scale, 0);
    for (uint32_t i = 0; i < count; i++) {
        body->points[i] = lattice_point(b, scale);
    }
    body->hull = NULL;
    body->curved = false;
    switch (kind % 8) {
    case 0:
        body->shape = tl_convex_box(body->points[0], tl_abs(body->points[count - 1]), radius);
        break;
    case 1:
        body->shape = tl_convex_capsule(body->points[0], body->points[count - 1], radius);
        break;
    case 2:
        body->shape = tl_convex_triangle(body->points[0], body->points[count / 2], body->points[count - 1], radius);
        break;
    case 3:
        body->shape = tl_convex_cylinder(tl_neg(up), up, scale * (float)(count % 4), radius);
        body->curved = true;
        break;
    case 4:
        body->shape = tl_convex_cone(zero, up, scale * (float)(count % 4), radius);
        body->curved = true;
        break;
    default:
        if (kind % 8 == 5 || tl_hull_bake(body->points, count, NULL, &body->hull, NULL) != TL_OK) {
            body->shape = tl_convex_from_points(body->points, count, radius);
        } else {
            body->shape = tl_convex_from_hull(body->hull, radius);
        }
    }
}

static tl_transform make_pose(fuzz_bytes *b, float scale)
{
    tl_transform pose;
    pose.position = lattice_point(b, scale);
    uint32_t turn = next_byte(b);
    tl_quat q = { (float)(turn % 4) - 1, (float)(turn / 4 % 4) - 1, (float)(turn / 16 % 4) - 1, (float)(turn / 64) };
    pose.rotation = q;
    return pose;
}

static tl_transform moved(tl_transform pose, tl_vec3 by)
{
    pose.position = tl_add(pose.position, by);
    return pose;
}

static void check_pair(const body *a, tl_transform pose_a, const body *b, tl_transform pose_b, float scale)
{
    // No body is larger than some 30 lattice steps; a hundred-thousandth of that.
    const float slack = 3e-4f * scale;
    bool curved = a->curved || b->curved;
    tl_separation s, t;
    tl_penetration p;
    tl_convex_distance(&a->shape, pose_a, &b->shape, pose_b, NULL, &s);
    tl_convex_distance(&b->shape, pose_b, &a->shape, pose_a, NULL, &t);
    tl_convex_penetration(&a->shape, pose_a, &b->shape, pose_b, NULL, &p);
    require(s.overlap == p.overlap);
    require(curved || (s.status != TL_CONVEX_ITERATIONS && p.status == TL_CONVEX_CONVERGED));
    require(fabsf(s.distance - t.distance) <= slack);
    require(s.lower_bound <= s.distance && p.lower_bound <= p.depth && p.depth <= p.upper_bound);
    bool touch = tl_convex_overlap(&a->shape, pose_a, &b->shape, pose_b, NULL);
    require(touch == s.overlap || (s.distance <= slack && p.depth <= slack));
    if (p.overlap) {
        require(p.upper_bound - p.lower_bound <= (curved ? 30.0f : 1.0f) * slack);
        tl_convex_distance(&a->shape, pose_a, &b->shape, moved(pose_b, tl_scale(p.normal, p.depth + slack)), NULL, &t);
        require(!t.overlap);
    }
    tl_contact_manifold m;
    uint32_t count =
        tl_convex_contacts(&a->shape, pose_a, &b->shape, pose_b, &(tl_contact_limits){ slack, slack, 0 }, NULL, &m);
    require(count <= TL_MAX_CONTACTS && (count > 0 || !s.overlap));
}

static void check_cast(const body *a, tl_transform pose_a, const body *b, tl_transform pose_b, tl_vec3 motion,
                       float scale)
{
    const float slack = 3e-4f * scale;
    tl_convex_hit hit;
    tl_separation s;
    tl_convex_cast(&a->shape, pose_a, &b->shape, pose_b, motion, &hit);
    require(hit.status != TL_CONVEX_ITERATIONS || a->curved || b->curved);
    if (hit.hit) {
        require(hit.t >= 0.0f && hit.t <= 1.0f);
        tl_convex_distance(&a->shape, pose_a, &b->shape, moved(pose_b, tl_scale(motion, hit.t)), NULL, &s);
        require(s.distance <= slack);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const float scales[] = { 1.0f, 1e-6f, 1e6f, 0.1f };
    fuzz_bytes b = { data, size };
    float scale = scales[next_byte(&b) % 4];
    body a, c;
    make_body(&a, &b, scale);
    make_body(&c, &b, scale);
    tl_transform pose_a = make_pose(&b, scale), pose_c = make_pose(&b, scale);
    check_pair(&a, pose_a, &c, pose_c, scale);
    check_cast(&a, pose_a, &c, pose_c, lattice_point(&b, 2.0f * scale), scale);
    tl_blob_free(a.hull);
    tl_blob_free(c.hull);
    return 0;
}
