// SPDX-License-Identifier: MIT
//
// Detour's data: the header, then the arrays in this order, each a multiple of four bytes long. The fields are those
// of dtMeshHeader, dtPoly, dtPolyDetail, dtBVNode (DetourNavMesh.h, version 7) and of the set that RecastDemo saves.

#ifndef TALUS_SRC_NAV_FORMAT_DETOUR_LAYOUT_H
#define TALUS_SRC_NAV_FORMAT_DETOUR_LAYOUT_H

#include <talus/nav_detour.h>

#define TL_DETOUR_TILE_MAGIC   0x444e4156u // 'D' << 24 | 'N' << 16 | 'A' << 8 | 'V'
#define TL_DETOUR_TILE_VERSION 7
#define TL_DETOUR_SET_MAGIC    0x4d534554u // 'M' << 24 | 'S' << 16 | 'E' << 8 | 'T'
#define TL_DETOUR_SET_VERSION  1
#define TL_DETOUR_EXTERNAL     0x8000u // in neighbours: across the tile's border; the low bits name the side
#define TL_DETOUR_EDGE_OUTLINE 1u      // in the flags of a detail triangle, two bits an edge
#define TL_DETOUR_BOTH_WAYS    1u      // in the flags of a connection
#define TL_DETOUR_GROUND       0u      // type of a polygon,
#define TL_DETOUR_OFF_MESH     1u      // and that of an off-mesh connection

typedef struct tl_detour_header {
    int32_t magic, version, x, y, layer;
    uint32_t user_id;
    int32_t polygon_count, vertex_count, max_link_count;
    int32_t detail_mesh_count, detail_vertex_count, detail_triangle_count;
    int32_t node_count, off_mesh_count, off_mesh_base;
    float walkable_height, walkable_radius, walkable_climb;
    float min[3], max[3];
    float quantization; // 1 / cell size
} tl_detour_header;

typedef struct tl_detour_polygon {
    uint32_t first_link;
    uint16_t vertices[TL_DETOUR_MAX_CORNERS];
    uint16_t neighbours[TL_DETOUR_MAX_CORNERS]; // 0 wall, k + 1 polygon k, TL_DETOUR_EXTERNAL | side
    uint16_t flags;
    uint8_t vertex_count;
    uint8_t area_and_type; // six bits and two
} tl_detour_polygon;

typedef struct tl_detour_patch {
    uint32_t vertex_base; // of the vertices beyond the polygon's own
    uint32_t triangle_base;
    uint8_t vertex_count;
    uint8_t triangle_count;
    uint8_t padding[2];
} tl_detour_patch;

typedef struct tl_detour_node {
    uint16_t min[3], max[3]; // cells from the tile's corner, on y too
    int32_t index;           // a polygon, or minus the nodes to skip
} tl_detour_node;

typedef struct tl_detour_connection {
    float ends[2][3];
    float radius;
    uint16_t polygon; // that stands for it, with its flags and area
    uint8_t flags;    // TL_DETOUR_BOTH_WAYS
    uint8_t side;
    uint32_t user_id;
} tl_detour_connection;

typedef struct tl_detour_params {
    float origin[3];
    float tile_width, tile_height;
    int32_t max_tiles, max_polygons;
} tl_detour_params;

typedef struct tl_detour_set_header {
    int32_t magic, version, tile_count;
    tl_detour_params params;
} tl_detour_set_header;

// Of each array: where it begins.
typedef struct tl_detour_offsets {
    uint64_t vertices, polygons, links, patches, detail_vertices, detail_triangles, nodes, off_mesh, end;
} tl_detour_offsets;

static inline uint64_t tl_detour_link_bytes(tl_detour_refs refs)
{
    return refs == TL_DETOUR_REFS_64 ? 16 : 12;
}

// A reference to the tile, then the bytes of its data.
static inline uint64_t tl_detour_entry_bytes(tl_detour_refs refs)
{
    return refs == TL_DETOUR_REFS_64 ? 16 : 8;
}

/// Counts must not be negative; sums of 32-bit counts don't overflow.
tl_detour_offsets tl_detour_offsets_of(const tl_detour_header *header, tl_detour_refs refs);

#endif
