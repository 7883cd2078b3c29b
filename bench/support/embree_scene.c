// SPDX-License-Identifier: MIT

#include "embree_scene.h"

#include <string.h>

RTCScene bench_embree_scene(RTCDevice device, RTCGeometry geometry, enum RTCSceneFlags flags,
                            enum RTCBuildQuality quality)
{
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, flags);
    rtcSetSceneBuildQuality(scene, quality);
    rtcSetGeometryBuildQuality(geometry, quality);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

RTCScene bench_embree_triangles(RTCDevice device, const tl_mesh_view *view, enum RTCSceneFlags flags,
                                enum RTCBuildQuality quality)
{
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, view->vertex_count),
           view->vertices, 12 * (size_t)view->vertex_count);
    memcpy(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, view->triangle_count),
           view->indices, 12 * (size_t)view->triangle_count);
    return bench_embree_scene(device, geometry, flags, quality);
}
