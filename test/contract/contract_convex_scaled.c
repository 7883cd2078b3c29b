// SPDX-License-Identifier: MIT
//
// convex_scaled.h.

#include "contract.h"

#include <string.h>
#include <talus/convex_scaled.h>

static tl_result make(contract_run *run)
{
    const bool no_input = run->what == CONTRACT_NULL_INPUT, no_output = run->what == CONTRACT_NULL_OUTPUT;
    const tl_convex box = tl_convex_box(tl_vec3_make(1, 2, 3), tl_vec3_make(1, 1, 1), 0);
    tl_scaled_convex scaled;
    memset(&scaled, 0xff, sizeof scaled);
    const tl_result result =
        tl_scaled_convex_make(no_input ? NULL : &box, tl_vec3_make(1, -2, 3), no_output ? NULL : &scaled, run->report);
    run->is_clear = no_output || contract_is_zero(&scaled, sizeof scaled);
    run->answer = contract_hash(scaled.shape.corners, sizeof scaled.shape.corners, 0);
    return result;
}

const contract_entry CONTRACT_TABLE_convex_scaled[] = {
    { "tl_scaled_convex_make",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT), 1, 1, NULL,
      make, NULL },
    { 0 },
};
