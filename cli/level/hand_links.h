// SPDX-License-Identifier: MIT
//
// Off-mesh links that a person sets: from options, and from a JSON file.

#ifndef TALUS_CLI_HAND_LINKS_H
#define TALUS_CLI_HAND_LINKS_H

#include "cli/shared/command.h"

#include <talus/pack.h>

/// What the options say.
typedef struct tl_hand_link_settings {
    tl_option_texts words; ///< "x,y,z,x,y,z" each: one way
    const char *path;      ///< of a JSON file, or NULL
} tl_hand_link_settings;

/// The links in talus' coordinates, freed with tl_blob_free; NULL where none were given. The command must know the
/// level's frame by now. False: reported, and `*exit_out` says how to end.
bool tl_hand_links_make(tl_cli *cli, const tl_hand_link_settings *settings, tl_pack_offmesh **links_out,
                        tl_exit *exit_out);

/// Adds the links (NULL: none) to a navmesh.
tl_result tl_hand_links_add(const tl_pack_offmesh *links, tl_navmesh *navmesh, tl_report *report);

/// Warns of each off-mesh link of a navmesh of which an end is near no polygon. How many those are.
uint32_t tl_hand_links_warn(tl_cli *cli, const char *path, const tl_navmesh *navmesh);

#endif
