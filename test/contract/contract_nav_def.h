// SPDX-License-Identifier: MIT
//
// What the tables of bakes share: a def with the case's flaw, and the bits of their cases.

#ifndef TALUS_TEST_CONTRACT_NAV_DEF_H
#define TALUS_TEST_CONTRACT_NAV_DEF_H

#include "contract.h"

#include <talus/nav_bake.h>

#include <string.h>

static const tl_aabb CONTRACT_LEVEL_BOUNDS = { { 0, -1, 0 }, { 20, 4, 20 } };

static const char *const CONTRACT_NAV_DEF_FIELDS[] = { "cell_size",
                                                       "cell_height",
                                                       "agent_height",
                                                       "agent_radius",
                                                       "agent_max_climb",
                                                       "agent_max_slope",
                                                       "region_min_size",
                                                       "region_merge_size",
                                                       "edge_max_len",
                                                       "edge_max_error",
                                                       "tile_height",
                                                       "detail_sample_dist",
                                                       "partition",
                                                       "detail_sample_max_error",
                                                       "polygon_method",
                                                       "max_verts_per_poly",
                                                       NULL };

static inline void contract_spoil_nav_def(tl_nav_def *def, uint32_t field)
{
    float *const floats[] = {
        &def->cell_size,
        &def->cell_height,
        &def->agent_height,
        &def->agent_radius,
        &def->agent_max_climb,
        &def->agent_max_slope,
        &def->region_min_size,
        &def->region_merge_size,
        &def->edge_max_len,
        &def->edge_max_error,
        &def->tile_height,
        &def->detail_sample_dist,
        NULL,
        &def->detail_sample_max_error,
    };
    if (field < sizeof floats / sizeof *floats && floats[field] != NULL) {
        *floats[field] = -1.0f;
    } else if (field == 12) {
        def->partition = (tl_nav_partition)9;
    } else if (field == 14) {
        def->polygon_method = (tl_partition_method)9;
    } else {
        def->max_verts_per_poly = 2;
    }
}

static inline tl_nav_def contract_nav_def(const contract_run *run, uint32_t tile_size)
{
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = tile_size;
    def.bounds = CONTRACT_LEVEL_BOUNDS;
    if (run->what == CONTRACT_BAD_FIELD) {
        contract_spoil_nav_def(&def, run->variant);
    } else if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    }
    def.host = *run->host;
    return def;
}

static inline bool contract_input_is_null(const contract_run *run, uint32_t input)
{
    return run->what == CONTRACT_NULL_INPUT && run->variant == input;
}

#define DEFS   (CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(BAD_FIELD))
#define CALLS  (CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT))
#define INPUT  CONTRACT_BIT(NULL_INPUT)
#define OUTPUT CONTRACT_BIT(NULL_OUTPUT)
#define WORKS  (CONTRACT_BIT(NO_MEMORY) | CONTRACT_BIT(CANCELLED))
#define STAGE  (CALLS | INPUT | OUTPUT | WORKS)

#endif
