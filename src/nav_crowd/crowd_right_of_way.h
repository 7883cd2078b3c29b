// SPDX-License-Identifier: MIT

#ifndef TALUS_SRC_NAV_CROWD_CROWD_RIGHT_OF_WAY_H
#define TALUS_SRC_NAV_CROWD_CROWD_RIGHT_OF_WAY_H

#include "nav_crowd/crowd_kernels.h"

/// Keeps to the right of those who come the other way, lets them pass where neither gets on, and settles an agent that
/// stands before others with its goal: changes what it wants. The neighbours are those that it
/// sees.
void tl_crowd_give_way(const crowd_step *step, uint32_t k, const crowd_neighbor *neighbors, const crowd_view *view);

#endif
