// SPDX-License-Identifier: MIT
//
// What areas cost, and which may not be entered, from the command line.

#ifndef TALUS_CLI_AREA_FILTER_H
#define TALUS_CLI_AREA_FILTER_H

#include "cli/shared/command.h"

#include <talus/nav_query.h>

typedef struct tl_area_filter {
    tl_option_texts costs;    ///< "ID=COST" each
    tl_option_texts excluded; ///< "ID" each
    tl_nav_filter filter;     ///< after tl_area_filter_read; its function reads this struct, so it must stay in place
    bool is_excluded[TL_NAV_MAX_AREA + 1];
    bool is_named[TL_NAV_MAX_AREA + 1]; ///< by either option
} tl_area_filter;

enum { TL_AREA_FILTER_OPTIONS = 3 };

void tl_area_filter_options(tl_area_filter *areas, tl_option table[TL_AREA_FILTER_OPTIONS]);

/// Makes the filter. False: a text was refused.
bool tl_area_filter_read(tl_cli *cli, tl_area_filter *areas, tl_exit *exit_out);

/// Warns of areas that were named and that no polygon has.
void tl_area_filter_warn(tl_cli *cli, const tl_area_filter *areas, const tl_navmesh *navmesh, const char *path);

#endif
