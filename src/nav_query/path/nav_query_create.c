// SPDX-License-Identifier: MIT
//
// Creating a query: its memory, with what path searches keep in it.

#include "base/assert.h"
#include "base/host.h"
#include "nav_query/path/path_run.h"
#include "nav_query/prepared/graph_search.h"
#include "nav_query/search/query_memory.h"

_Static_assert(sizeof(tl_nav_wedge) >= sizeof(tl_nav_corner_leg), "a wedge has room for a leg");

// Nodes that a query begins with: paths of a level of some hundred polygons need no more.
enum { FIRST_QUERY_NODES = 512 };

tl_nav_query_def tl_default_nav_query_def(void)
{
    tl_nav_query_def def = { 65536, NULL, TL_DEF_COOKIE };
    return def;
}

tl_result tl_nav_query_create(const tl_nav_query_def *def, tl_nav_query **query_out, tl_report *report)
{
    const tl_nav_query_def used = def != NULL ? *def : tl_default_nav_query_def();
    tl_report_begin(report, "query");
    TL_REFUSE_NULL(query_out, report);
    *query_out = NULL;
    TL_TRY(tl_def_check(used.cookie, "begin with tl_default_nav_query_def()", report));
    if (used.max_nodes < 2 || used.max_nodes > TL_NAV_MAX_QUERY_NODES) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "max_nodes", "make it 2 to 2^30");
    }
    const tl_nav_query_sizes sizes = { sizeof(tl_nav_stop), sizeof(tl_nav_path_run) };
    const uint32_t first = used.max_nodes < FIRST_QUERY_NODES ? used.max_nodes : FIRST_QUERY_NODES;
    TL_TRY(tl_nav_query_allocate(first, sizes, used.allocator, query_out));
    (*query_out)->node_limit = used.max_nodes;
    return TL_OK;
}

tl_result tl_nav_query_reserve(tl_nav_query *query, uint32_t nodes)
{
    if (query == NULL) {
        return TL_ERR_ARGUMENT;
    }
    return nodes <= query->node_limit ? tl_nav_query_make_room(query, nodes) : TL_ERR_LIMIT;
}

void tl_nav_query_destroy(tl_nav_query *query)
{
    tl_nav_query_release(query);
}
