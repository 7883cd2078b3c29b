// SPDX-License-Identifier: MIT
//
// nav_sight.h.

#include "contract.h"

#include <string.h>

static const char *const PVS_FIELDS[] = { "eye_height", "max_distance", NULL };

static tl_result pvs_bake(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    tl_nav_pvs_def def = tl_default_nav_pvs_def();
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_BAD_FIELD) {
        *(run->variant == 0 ? &def.eye_height : &def.max_distance) = NAN;
    }
    def.host = *run->host;
    tl_nav_pvs *pvs = NULL;
    const tl_result result = tl_nav_pvs_bake(run->what == CONTRACT_NULL_DEF ? NULL : &def,
                                             null_input && run->variant == 0 ? NULL : level->navmesh,
                                             null_input && run->variant == 1 ? NULL : level->soup,
                                             run->what == CONTRACT_NULL_OUTPUT ? NULL : &pvs, run->report);
    run->is_clear = pvs == NULL;
    run->answer = pvs != NULL ? contract_hash(pvs, (size_t)pvs->blob.size, 0) : 0;
    tl_blob_free(pvs);
    return result;
}

static tl_nav_pvs *make_pvs(void)
{
    const contract_level *level = contract_level_get();
    tl_nav_pvs *pvs;
    TEST_RESULT(tl_nav_pvs_bake(NULL, level->navmesh, level->soup, &pvs, NULL), TL_OK);
    return pvs;
}

static tl_result pvs_check(contract_run *run)
{
    tl_nav_pvs *pvs = make_pvs();
    if (run->what == CONTRACT_BAD_BYTES) {
        pvs->rows++;
    }
    run->is_clear = true;
    const tl_result result =
        tl_nav_pvs_check(run->what == CONTRACT_NULL_INPUT ? NULL : pvs, pvs->blob.size, run->report);
    tl_blob_free(pvs);
    return result;
}

static tl_nav_location location_at(tl_vec3 point)
{
    tl_nav_location location;
    TEST_RESULT(tl_navmesh_find_nearest(contract_level_get()->navmesh, NULL, point, tl_vec3_make(2, 2, 2), &location),
                TL_OK);
    return location;
}

static tl_result pvs_sees(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const bool null_input = run->what == CONTRACT_NULL_INPUT, null_output = run->what == CONTRACT_NULL_OUTPUT;
    const tl_nav_ref a = run->what == CONTRACT_STALE ? level->stale : location_at(level->here).polygon;
    tl_nav_pvs *pvs = make_pvs();
    bool seen = true;
    const tl_result result = tl_nav_pvs_sees(null_input && run->variant == 0 ? NULL : pvs,
                                             null_input && run->variant == 1 ? NULL : level->navmesh, a,
                                             location_at(level->there).polygon, null_output ? NULL : &seen);
    run->is_clear = null_output || !seen;
    tl_blob_free(pvs);
    return result;
}

static tl_result pvs_seen_from(contract_run *run)
{
    enum { CAPACITY = 256 };
    const contract_level *level = contract_level_get();
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    const tl_nav_ref from = run->what == CONTRACT_STALE ? level->stale : location_at(level->here).polygon;
    tl_nav_pvs *pvs = make_pvs();
    tl_nav_ref seen[CAPACITY];
    uint32_t all = 0, capacity = CAPACITY;
    (void)tl_nav_pvs_seen_from(pvs, level->navmesh, location_at(level->here).polygon, NULL, 0, &all);
    capacity = run->what == CONTRACT_NO_BUFFER ? 0 : run->what == CONTRACT_SHORT_BUFFER ? all - 1 : CAPACITY;
    const tl_result result = tl_nav_pvs_seen_from(null_input && run->variant == 0 ? NULL : pvs,
                                                  null_input && run->variant == 1 ? NULL : level->navmesh, from,
                                                  capacity == 0 || (null_input && run->variant == 2) ? NULL : seen,
                                                  capacity, run->what == CONTRACT_NULL_OUTPUT ? NULL : &run->count);
    run->is_clear = run->count == 0;
    run->answer = result == TL_OK ? contract_hash(seen, run->count * sizeof *seen, 0) : 0;
    tl_blob_free(pvs);
    return result;
}

// The agent stands on the threat's side of the box and has to walk around it.
static tl_result find_cover(contract_run *run)
{
    const contract_level *level = contract_level_get();
    const bool null_input = run->what == CONTRACT_NULL_INPUT;
    tl_nav_cover_def def = tl_default_nav_cover_def();
    tl_nav_cover_request request = { level->navmesh, level->soup, NULL, location_at(level->there),
                                     tl_vec3_make(18, 1.6f, 10) };
    tl_nav_cover covers[4];
    memset(covers, 0, sizeof covers);
    if (run->what == CONTRACT_ZEROED_DEF) {
        memset(&def, 0, sizeof def);
    } else if (run->what == CONTRACT_STALE) {
        request.agent.polygon = level->stale;
    }
    request.navmesh = null_input && run->variant == 0 ? NULL : request.navmesh;
    request.soup = null_input && run->variant == 1 ? NULL : request.soup;
    const tl_result result = tl_nav_query_find_cover(
        null_input && run->variant == 2  ? NULL
        : run->what == CONTRACT_NO_NODES ? level->tiny_query
                                         : level->query,
        null_input && run->variant == 3 ? NULL : &request, run->what == CONTRACT_NULL_DEF ? NULL : &def,
        null_input && run->variant == 4 ? NULL : covers, 4, run->what == CONTRACT_NULL_OUTPUT ? NULL : &run->count);
    run->is_clear = run->count == 0 || result == TL_ERR_NODES;
    run->answer = run->count == 4 ? contract_hash(covers, sizeof covers, 0) : 0;
    return result;
}

const contract_entry CONTRACT_TABLE_nav_sight[] = {
    { "tl_default_nav_pvs_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_pvs_bake",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) |
          CONTRACT_BIT(BAD_FIELD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY) |
          CONTRACT_BIT(CANCELLED),
      2, 1, PVS_FIELDS, pvs_bake, NULL },
    { "tl_nav_pvs_check",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_BYTES), 1, 0, NULL,
      pvs_check, NULL },
    { "tl_nav_pvs_sees",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE), 2, 1, NULL,
      pvs_sees, NULL },
    { "tl_nav_pvs_seen_from",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_BUFFER) |
          CONTRACT_BIT(SHORT_BUFFER) | CONTRACT_BIT(STALE),
      3, 1, NULL, pvs_seen_from, NULL },
    { "tl_default_nav_cover_def", 0, 0, 0, NULL, NULL, "a constant value" },
    { "tl_nav_query_find_cover",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_DEF) | CONTRACT_BIT(ZEROED_DEF) | CONTRACT_BIT(NULL_INPUT) |
          CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(STALE) | CONTRACT_BIT(NO_NODES),
      5, 1, NULL, find_cover, NULL },
    { 0 },
};
