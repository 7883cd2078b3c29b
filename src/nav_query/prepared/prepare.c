// SPDX-License-Identifier: MIT
//
// Preparing a navmesh: its roads, and what is known of lengths along them as far as memory may go.

#include "nav_query/prepared/roads.h"

#include "base/assert.h"

#include <string.h>

tl_nav_prepare_def tl_default_nav_prepare_def(void)
{
    tl_nav_prepare_def def = { 32u << 20, 0 };
    return def;
}

const char *tl_nav_prepared_kind_name(tl_nav_prepared_kind kind)
{
    static const char *const NAMES[] = { "none", "roads", "table", "labels" };
    return (unsigned)kind < TL_COUNT_OF(NAMES) ? NAMES[kind] : "unknown";
}

static bool floors_fork(const tl_navmesh *navmesh)
{
    for (uint32_t slot = 0; slot < navmesh->slot_count; slot++) {
        if (navmesh->slots[slot].tile != NULL && navmesh->slots[slot].rings.has_back) {
            return true;
        }
    }
    return false;
}

static tl_result prepare(tl_navmesh *navmesh, const tl_nav_prepare_def *def)
{
    if (!tl_nav_roads_hold(navmesh)) {
        tl_nav_free_roads(&navmesh->allocator, navmesh->roads);
        navmesh->roads = NULL;
        if (floors_fork(navmesh)) {
            return TL_OK;
        }
        TL_TRY(tl_nav_make_roads(navmesh, &navmesh->roads));
    }
    const tl_allocator *allocator = &navmesh->allocator;
    tl_nav_roads *roads = navmesh->roads;
    if (tl_nav_bend_table_size(roads) <= def->table_bytes) {
        tl_nav_free_hub_labels(allocator, roads);
        return roads->table == NULL ? tl_nav_make_bend_table(allocator, roads) : TL_OK;
    }
    tl_nav_free_bend_table(allocator, roads);
    if (roads->labels.first != NULL && tl_nav_hub_labels_size(roads) <= def->label_bytes) {
        return TL_OK;
    }
    tl_nav_free_hub_labels(allocator, roads);
    tl_result result = def->label_bytes > 0 ? tl_nav_make_hub_labels(allocator, roads, def->label_bytes) : TL_OK;
    return result == TL_ERR_LIMIT ? TL_OK : result; // the roads serve without
}

static tl_nav_prepared report(const tl_navmesh *navmesh)
{
    const tl_nav_roads *roads = navmesh->roads;
    tl_nav_prepared made = { TL_NAV_PREPARED_NONE, 0, 0, 0, 0 };
    if (roads != NULL) {
        made.kind = roads->table != NULL          ? TL_NAV_PREPARED_TABLE
                    : roads->labels.first != NULL ? TL_NAV_PREPARED_LABELS
                                                  : TL_NAV_PREPARED_ROADS;
        made.bend_count = roads->bend_count;
        made.road_count = roads->road_count;
        made.table_bytes = tl_nav_bend_table_size(roads);
        made.bytes = tl_nav_roads_size(roads) + (roads->table != NULL ? made.table_bytes : 0) +
                     (roads->labels.first != NULL ? tl_nav_hub_labels_size(roads) : 0);
    }
    return made;
}

tl_result tl_navmesh_prepare(tl_navmesh *navmesh, const tl_nav_prepare_def *def, tl_nav_prepared *prepared_out)
{
    const tl_nav_prepare_def usual = tl_default_nav_prepare_def();
    tl_result result = prepare(navmesh, def != NULL ? def : &usual);
    if (result != TL_OK) {
        tl_nav_free_roads(&navmesh->allocator, navmesh->roads);
        navmesh->roads = NULL;
    }
    if (prepared_out != NULL) {
        *prepared_out = report(navmesh);
    }
    return result;
}

bool tl_navmesh_is_prepared(const tl_navmesh *navmesh)
{
    return tl_nav_roads_hold(navmesh) && navmesh->offmesh.count == 0;
}
