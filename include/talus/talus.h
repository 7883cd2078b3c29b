// SPDX-License-Identifier: MIT
//
// All of talus.

#ifndef TALUS_TALUS_H
#define TALUS_TALUS_H

#include <talus/base.h>
#include <talus/character.h>
#include <talus/convex.h>
#include <talus/convex_scaled.h>
#include <talus/decompose.h>
#include <talus/halfedge.h>
#include <talus/hull.h>
#include <talus/mesh.h>
#include <talus/nav_around.h>
#include <talus/nav_audit.h>
#include <talus/nav_bake.h>
#include <talus/nav_corridor.h>
#include <talus/nav_crowd.h>
#include <talus/nav_detour.h>
#include <talus/nav_links.h>
#include <talus/nav_obstacles.h>
#include <talus/nav_prepare.h>
#include <talus/nav_prune.h>
#include <talus/nav_query.h>
#include <talus/nav_routes.h>
#include <talus/nav_sight.h>
#include <talus/nav_state.h>
#include <talus/nav_tile.h>
#include <talus/nav_versions.h>
#include <talus/nav_wide.h>
#include <talus/nav_world.h>
#include <talus/pack.h>
#include <talus/polygon.h>
#include <talus/scene.h>
#include <talus/scene_groups.h>
#include <talus/scene_versions.h>
#include <talus/soup.h>
#include <talus/soup_scaled.h>
#include <talus/vec.h>

#endif
