// SPDX-License-Identifier: MIT
//
// Erosion in bands that are there.

#ifndef TALUS_SRC_NAV_BAKE_ERODE_H
#define TALUS_SRC_NAV_BAKE_ERODE_H

#include "nav_bake/floors/floor_bands.h"

/// tl_nav_erode, without its calls of the progress hook.
tl_result tl_nav_erode_bands(const tl_nav_config *config, const tl_host *host, const tl_floor_bands *bands,
                             tl_nav_compact *compact);

#endif
