// SPDX-License-Identifier: MIT
//
// Creating a query: its memory, with what path searches keep in it.

#include "base/assert.h"
#include "base/host.h"
#include "nav_query/path/path_run.h"
#include "nav_query/prepared/graph_search.h"
#include "nav_query/search/query_memory.h"

_Static_assert(sizeof(tl_nav_wedge) >= sizeof(tl_nav_corner_leg), "a wedge has room for a leg");

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
    return tl_nav_query_allocate(used.max_nodes, sizes, used.allocator, query_out);
}

void tl_nav_query_destroy(tl_nav_query *query)
{
    tl_nav_query_release(query);
}
