// SPDX-License-Identifier: MIT
//
// convex.h. Its queries return values: what is held here is that a zero rotation is the identity and that optional
// arguments may be NULL.

#include "contract.h"

#include <string.h>

// A box and the hull of the level's box, with poses that a case may zero.
typedef struct convex_pair {
    tl_convex a, b;
    tl_transform pose_a, pose_b;
} convex_pair;

static convex_pair make_pair(const contract_run *run, float height)
{
    convex_pair p;
    p.a = tl_convex_from_hull(contract_level_get()->hull, 0.0f);
    p.b = tl_convex_box(tl_vec3_make(10.0f, 0.5f, 10.0f), tl_vec3_make(1.0f, 0.5f, 1.5f), 0.0f);
    p.pose_a = p.pose_b = tl_transform_identity();
    p.pose_b.position.y = height;
    if (run->what == CONTRACT_ZERO_ROTATION) {
        memset(&p.pose_a.rotation, 0, sizeof p.pose_a.rotation);
        memset(&p.pose_b.rotation, 0, sizeof p.pose_b.rotation);
    }
    return p;
}

static tl_result bounds(contract_run *run)
{
    const convex_pair p = make_pair(run, 3.0f);
    const tl_aabb box = tl_convex_bounds(&p.b, p.pose_b);
    run->answer = contract_hash(&box, sizeof box, 0);
    return TL_OK;
}

static tl_result distance(contract_run *run)
{
    const convex_pair p = make_pair(run, 3.0f);
    tl_separation separation;
    tl_convex_distance(&p.a, p.pose_a, &p.b, p.pose_b, NULL, &separation);
    TEST_CHECK(!separation.overlap && separation.distance > 0.9f);
    run->answer = contract_hash(&separation.distance, sizeof separation.distance, separation.iterations);
    return TL_OK;
}

static tl_result overlap(contract_run *run)
{
    const convex_pair p = make_pair(run, 1.5f);
    run->answer = tl_convex_overlap(&p.a, p.pose_a, &p.b, p.pose_b, NULL);
    TEST_CHECK(run->answer == 1);
    return TL_OK;
}

static tl_result penetration(contract_run *run)
{
    const convex_pair p = make_pair(run, 1.5f);
    tl_penetration found;
    TEST_CHECK(tl_convex_penetration(&p.a, p.pose_a, &p.b, p.pose_b, NULL, &found));
    run->answer = contract_hash(&found.depth, sizeof found.depth, found.iterations);
    return TL_OK;
}

static tl_result penetration_within(contract_run *run)
{
    const convex_pair p = make_pair(run, 1.5f);
    tl_penetration found;
    TEST_CHECK(tl_convex_penetration_within(&p.a, p.pose_a, &p.b, p.pose_b, NULL, 2, &found));
    run->answer = contract_hash(&found.depth, sizeof found.depth, found.iterations);
    return TL_OK;
}

static tl_result cast(contract_run *run)
{
    const convex_pair p = make_pair(run, 3.0f);
    tl_convex_hit hit;
    TEST_CHECK(tl_convex_cast(&p.a, p.pose_a, &p.b, p.pose_b, tl_vec3_make(0.0f, -4.0f, 0.0f), &hit));
    run->answer = contract_hash(&hit.t, sizeof hit.t, hit.iterations);
    return TL_OK;
}

static tl_result cast_turning(contract_run *run)
{
    const convex_pair p = make_pair(run, 3.0f);
    tl_transform to = p.pose_b;
    to.position.y -= 4.0f;
    tl_convex_hit hit;
    TEST_CHECK(tl_convex_cast_turning(&p.a, p.pose_a, &p.b, p.pose_b, to, 0.01f, &hit));
    run->answer = contract_hash(&hit.t, sizeof hit.t, hit.iterations);
    return TL_OK;
}

static tl_result cast_ray(contract_run *run)
{
    const convex_pair p = make_pair(run, 3.0f);
    tl_convex_hit hit;
    TEST_CHECK(tl_convex_cast_ray(&p.b, p.pose_b, tl_vec3_make(10.0f, 9.0f, 10.0f), tl_vec3_make(0.0f, -1.0f, 0.0f),
                                  100.0f, &hit));
    run->answer = contract_hash(&hit.t, sizeof hit.t, hit.iterations);
    return TL_OK;
}

static tl_result contacts(contract_run *run)
{
    const convex_pair p = make_pair(run, 1.99f);
    const tl_contact_limits limits = { 0.0f, 0.0f, 0 };
    tl_contact_manifold manifold;
    const uint32_t count = tl_convex_contacts(&p.a, p.pose_a, &p.b, p.pose_b,
                                              run->what == CONTRACT_NULL_DEF ? NULL : &limits, NULL, &manifold);
    TEST_CHECK(count > 0);
    run->answer = contract_hash(manifold.contacts, count * sizeof *manifold.contacts, count);
    return TL_OK;
}

static tl_result contacts_along(contract_run *run)
{
    const convex_pair p = make_pair(run, 1.99f);
    const tl_contact_limits limits = { 0.0f, 0.0f, 0 };
    tl_contact_manifold manifold;
    const uint32_t count = tl_convex_contacts_along(&p.a, p.pose_a, &p.b, p.pose_b, tl_vec3_make(0.0f, 1.0f, 0.0f),
                                                    run->what == CONTRACT_NULL_DEF ? NULL : &limits, &manifold);
    TEST_CHECK(count > 0);
    run->answer = contract_hash(manifold.contacts, count * sizeof *manifold.contacts, count);
    return TL_OK;
}

enum { POSE_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(ZERO_ROTATION) };

const contract_entry CONTRACT_TABLE_convex[] = {
    { "tl_convex_from_hull", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_from_points", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_box", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_sphere", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_capsule", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_triangle", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_cylinder", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_cone", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_custom", 0, 0, 0, NULL, NULL, "returns a value" },
    { "tl_convex_bounds", POSE_CASES, 0, 0, NULL, bounds, NULL },
    { "tl_convex_distance", POSE_CASES, 0, 0, NULL, distance, NULL },
    { "tl_convex_overlap", POSE_CASES, 0, 0, NULL, overlap, NULL },
    { "tl_convex_penetration", POSE_CASES, 0, 0, NULL, penetration, NULL },
    { "tl_convex_penetration_within", POSE_CASES, 0, 0, NULL, penetration_within, NULL },
    { "tl_convex_cast", POSE_CASES, 0, 0, NULL, cast, NULL },
    { "tl_convex_cast_turning", POSE_CASES, 0, 0, NULL, cast_turning, NULL },
    { "tl_convex_cast_ray", POSE_CASES, 0, 0, NULL, cast_ray, NULL },
    { "tl_convex_contacts", POSE_CASES | CONTRACT_BIT(NULL_DEF), 0, 0, NULL, contacts, NULL },
    { "tl_convex_contacts_along", POSE_CASES | CONTRACT_BIT(NULL_DEF), 0, 0, NULL, contacts_along, NULL },
    { 0 },
};
