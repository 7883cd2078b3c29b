// SPDX-License-Identifier: MIT
//
// The units decide. rcConfig counts cells where talus takes metres, RecastDemo takes metres too, and
// recast-navigation-js takes rcConfig's units but the roots of its areas. A name with one meaning in talus's unit is an
// alias; any other is refused by a message that names our option and its unit, so that no number is taken for what it
// is not. Sources: Recast.h (rcConfig), DetourNavMesh.h, DetourNavMeshBuilder.h and DetourNavMeshQuery.h, version 1.6;
// the labels and fields of RecastDemo's Sample; recast-navigation-js 0.3x, RecastConfig.

#include "cli/options/recast_names.h"

#include <stddef.h>

static const tl_recast_name recast_names[] = {
    { "cs", "cell-size", NULL },
    { "ch", "cell-height", NULL },
    { "walkableSlopeAngle", "agent-max-slope", NULL },
    { "maxSlope", "agent-max-slope", NULL },
    { "maxClimb", "agent-max-climb", NULL },
    { "walkableHeight", "agent-height",
      "counts cells in Recast; use --agent-height, in metres: the count times --cell-height" },
    { "walkableClimb", "agent-max-climb",
      "counts cells in Recast; use --agent-max-climb, in metres: the count times --cell-height" },
    { "walkableRadius", "agent-radius",
      "counts cells in Recast; use --agent-radius, in metres: the count times --cell-size" },
    { "height", "agent-height",
      "is the grid's in Recast, which follows from --bounds; for the agent's use --agent-height, in metres" },
    { "width", "cell-size", "is the grid's in Recast, which follows from --bounds and --cell-size; leave it out" },
    { "maxEdgeLen", "edge-max-len",
      "counts cells in Recast; use --edge-max-len, in metres: the count times --cell-size" },
    { "maxEdgeLength", "edge-max-len", NULL },
    { "maxSimplificationError", "edge-max-error", NULL },
    { "maxEdgeError", "edge-max-error", NULL },
    { "minRegionArea", "region-min-size",
      "is an area in Recast, its square root in recast-navigation-js; use --region-min-size, in cells: the root" },
    { "mergeRegionArea", "region-merge-size",
      "is an area in Recast, its square root in recast-navigation-js; use --region-merge-size, in cells: the root" },
    { "minRegionSize", "region-min-size", NULL },
    { "mergeRegionSize", "region-merge-size", NULL },
    { "mergedRegionSize", "region-merge-size", NULL },
    { "maxVertsPerPoly", "max-verts", NULL },
    { "vertsPerPoly", "max-verts-per-poly", NULL },
    { "vertsPerPoly", "max-verts", NULL },
    { "nvp", "max-verts-per-poly", NULL },
    { "nvp", "max-verts", NULL },
    { "sampleDistance", "detail-sample-dist", NULL },
    { "maxSampleError", "detail-sample-max-error", NULL },
    { "partitionType", "partition", NULL },
    { "partitioning", "partition", NULL },
    { "borderSize", "tile-size", "follows from --agent-radius and --cell-size; leave it out" },
    { "bmin", "bounds", "is one corner; use --bounds MINX,MINY,MINZ,MAXX,MAXY,MAXZ, in metres" },
    { "bmax", "bounds", "is one corner; use --bounds MINX,MINY,MINZ,MAXX,MAXY,MAXZ, in metres" },
    { "tileWidth", "tile-size", "is in metres in Detour; use --tile-size, in cells: the width divided by --cell-size" },
    { "tileHeight", "tile-size",
      "is in metres in Detour; use --tile-size, in cells; --tile-height divides a tile's floors into layers" },
    { "maxTiles", "tile-size", "is not needed; a navmesh has as many tiles as the level takes" },
    { "maxPolys", "tile-size", "is not needed; a tile has as many polygons as it takes" },
    { "buildBvTree", "tile-size", "is not needed; every tile has what finding its polygons takes" },
    { "filterLowHangingObstacles", "no-filter-low-hanging-obstacles",
      "is on unless --no-filter-low-hanging-obstacles is given" },
    { "filterLedgeSpans", "no-filter-ledge-spans", "is on unless --no-filter-ledge-spans is given" },
    { "filterWalkableLowHeightSpans", "no-filter-walkable-low-height-spans",
      "is on unless --no-filter-walkable-low-height-spans is given" },
    { "expectedLayersPerTile", "tile-size", "belongs to Detour's tile cache; leave it out" },
    { "maxObstacles", "tile-size", "belongs to Detour's tile cache; leave it out" },
    { "halfExtents", "extents", NULL },
    { "maxNodes", "extents", "is not needed; a search has nodes for the whole navmesh" },
};

const tl_recast_name *tl_recast_names(uint32_t *count_out)
{
    *count_out = sizeof(recast_names) / sizeof(recast_names[0]);
    return recast_names;
}
