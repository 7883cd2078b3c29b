// SPDX-License-Identifier: MIT
//
// vec.h, all inline: what takes a rotation takes a zero one as the identity.

#include "contract.h"

#include <string.h>

static tl_transform pose_of(const contract_run *run)
{
    tl_transform pose = { tl_quat_identity(), { 1.0f, 2.0f, 3.0f } };
    if (run->what == CONTRACT_ZERO_ROTATION) {
        memset(&pose.rotation, 0, sizeof pose.rotation);
    }
    return pose;
}

static tl_result answer(contract_run *run, const void *bytes, size_t size)
{
    run->answer = contract_hash(bytes, size, 0);
    return TL_OK;
}

static const tl_vec3 POINT = { 4.0f, -5.0f, 6.0f };
static const tl_transform TURNED = { { 0.6f, 0.0f, 0.0f, 0.8f }, { 7.0f, 8.0f, 9.0f } };

static tl_result rotate(contract_run *run)
{
    const tl_vec3 p = tl_rotate(pose_of(run).rotation, POINT);
    return answer(run, &p, sizeof p);
}

static tl_result inverse_rotate(contract_run *run)
{
    const tl_vec3 p = tl_inverse_rotate(pose_of(run).rotation, POINT);
    return answer(run, &p, sizeof p);
}

static tl_result quat_mul(contract_run *run)
{
    const tl_quat q = pose_of(run).rotation;
    const tl_quat products[3] = { tl_quat_mul(q, TURNED.rotation), tl_quat_mul(TURNED.rotation, q), tl_quat_mul(q, q) };
    return answer(run, products, sizeof products);
}

static tl_result transform_point(contract_run *run)
{
    const tl_vec3 p[2] = { tl_transform_point(pose_of(run), POINT), tl_inverse_transform_point(pose_of(run), POINT) };
    return answer(run, p, sizeof p);
}

static tl_result transform_mul(contract_run *run)
{
    const tl_transform products[2] = { tl_transform_mul(pose_of(run), TURNED), tl_transform_mul(TURNED, pose_of(run)) };
    return answer(run, products, sizeof products);
}

static tl_result transform_relative(contract_run *run)
{
    const tl_transform seen[2] = { tl_transform_relative(pose_of(run), TURNED),
                                   tl_transform_relative(TURNED, pose_of(run)) };
    return answer(run, seen, sizeof seen);
}

enum { ROTATION_CASES = CONTRACT_BIT(GOOD) | CONTRACT_BIT(ZERO_ROTATION) };

const contract_entry CONTRACT_TABLE_vec[] = {
    { "tl_rotate", ROTATION_CASES, 0, 0, NULL, rotate, NULL },
    { "tl_inverse_rotate", ROTATION_CASES, 0, 0, NULL, inverse_rotate, NULL },
    { "tl_quat_mul", ROTATION_CASES, 0, 0, NULL, quat_mul, NULL },
    { "tl_transform_point", ROTATION_CASES, 0, 0, NULL, transform_point, NULL },
    { "tl_transform_mul", ROTATION_CASES, 0, 0, NULL, transform_mul, NULL },
    { "tl_transform_relative", ROTATION_CASES, 0, 0, NULL, transform_relative, NULL },
    { 0 },
};
