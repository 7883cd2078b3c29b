// SPDX-License-Identifier: MIT
//
// Embree scenes of one geometry, as the benchmarks compare with.

#ifndef TALUS_BENCH_EMBREE_SCENE_H
#define TALUS_BENCH_EMBREE_SCENE_H

#include <embree3/rtcore.h>
#include <talus/mesh.h>

/// A built scene that holds a geometry alone, both of that quality. Takes over the geometry, whose buffers are filled.
RTCScene bench_embree_scene(RTCDevice device, RTCGeometry geometry, enum RTCSceneFlags flags,
                            enum RTCBuildQuality quality);

/// The same of a mesh's triangles, in buffers of Embree's own.
RTCScene bench_embree_triangles(RTCDevice device, const tl_mesh_view *view, enum RTCSceneFlags flags,
                                enum RTCBuildQuality quality);

#endif
