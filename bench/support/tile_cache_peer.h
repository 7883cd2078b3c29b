// SPDX-License-Identifier: MIT
//
// DetourTileCache as a peer: the same level, voxels and tiles, cut into layers by Recast, and obstacles over them.

#ifndef TALUS_BENCH_TILE_CACHE_PEER_H
#define TALUS_BENCH_TILE_CACHE_PEER_H

#include <talus/nav_bake.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bench_tile_cache bench_tile_cache;

/// All tiles of a level, in a navmesh of Detour's. NULL: Recast or Detour failed.
bench_tile_cache *bench_tile_cache_make(const tl_nav_def *def, const tl_mesh_view *mesh);
void bench_tile_cache_free(bench_tile_cache *cache);

/// Puts a cylinder where it is asked for, or moves the last one there, and updates until the navmesh is right.
/// `base`: the middle of its bottom; the agent's radius is added, as the layers' floors know nothing of it. False: the
/// cache refused it.
bool bench_tile_cache_place(bench_tile_cache *cache, tl_vec3 base, float radius, float height, bool moves_last);

/// Bytes of the layers, which are not compressed.
double bench_tile_cache_bytes(const bench_tile_cache *cache);

#ifdef __cplusplus
}
#endif

#endif
