// SPDX-License-Identifier: MIT
//
// What users of Recast, Detour, RecastDemo and recast-navigation-js call the settings that talus has too.

#ifndef TALUS_CLI_RECAST_NAMES_H
#define TALUS_CLI_RECAST_NAMES_H

#include <stdint.h>

/// One name of theirs, for a command that has `option`.
typedef struct tl_recast_name {
    const char *name;   ///< in camelCase, as it stands there
    const char *option; ///< ours, without the dashes before it
    const char *advice; ///< NULL: the same setting in the same unit. Else what differs, and what to give instead.
} tl_recast_name;

const tl_recast_name *tl_recast_names(uint32_t *count_out);

#endif
