// SPDX-License-Identifier: MIT
//
// The distance field in bands that are there.

#ifndef TALUS_SRC_NAV_BAKE_DISTANCE_FIELD_H
#define TALUS_SRC_NAV_BAKE_DISTANCE_FIELD_H

#include "nav_bake/floors/floor_bands.h"

/// tl_nav_distance_field, without its calls of the progress hook.
tl_result tl_nav_distance_of_bands(const tl_host *host, const tl_floor_bands *bands, tl_nav_compact *compact);

#endif
