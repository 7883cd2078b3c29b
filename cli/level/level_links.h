// SPDX-License-Identifier: MIT
//
// Drops, jumps and climbs of a level: the options that bake and links share, and what is said of what was found.

#ifndef TALUS_CLI_LEVEL_LINKS_H
#define TALUS_CLI_LEVEL_LINKS_H

#include "cli/shared/command.h"

#include <jansson.h>
#include <talus/nav_links.h>

enum { TL_LINK_OPTIONS = 9 };

/// Options for the fields of a def, named by what the agent can do.
void tl_link_options(tl_nav_links_def *def, tl_option table[TL_LINK_OPTIONS]);

/// What was found, and the counts. `links` is freed with tl_blob_free.
typedef struct tl_level_links {
    tl_nav_links *links;
    tl_nav_links_report report;
} tl_level_links;

/// Finds the links of the level that the command line names first. False: the failure was reported.
bool tl_level_links_find(tl_cli *cli, const tl_nav_links_def *def, const tl_navmesh *navmesh, const tl_soup *soup,
                         tl_level_links *links_out, tl_exit *exit_out);

/// A table of kinds, and what became of the trajectories that were tried.
void tl_level_links_print(const tl_nav_links_report *report);
json_t *tl_level_links_json(const tl_nav_links_report *report);
/// Start, end, apex, kind and whether it leads both ways, of each link.
json_t *tl_level_links_list_json(const tl_pack_frame *frame, const tl_nav_links *links);

#endif
