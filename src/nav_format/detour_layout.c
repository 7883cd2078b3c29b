// SPDX-License-Identifier: MIT

#include "nav_format/detour_layout.h"

#include "base/exact_floats.h"

#include <assert.h>

static_assert(sizeof(tl_detour_header) == 100, "dtMeshHeader");
static_assert(sizeof(tl_detour_polygon) == 32, "dtPoly");
static_assert(sizeof(tl_detour_patch) == 12, "dtPolyDetail");
static_assert(sizeof(tl_detour_node) == 16, "dtBVNode");
static_assert(sizeof(tl_detour_set_header) == 40, "the set's header");

_Static_assert(sizeof(tl_detour_connection) == 36, "no hidden padding");

tl_detour_offsets tl_detour_offsets_of(const tl_detour_header *header, tl_detour_refs refs)
{
    tl_detour_offsets at;
    at.vertices = sizeof *header;
    at.polygons = at.vertices + 12 * (uint64_t)header->vertex_count;
    at.links = at.polygons + sizeof(tl_detour_polygon) * (uint64_t)header->polygon_count;
    at.patches = at.links + tl_detour_link_bytes(refs) * (uint64_t)header->max_link_count;
    at.detail_vertices = at.patches + sizeof(tl_detour_patch) * (uint64_t)header->detail_mesh_count;
    at.detail_triangles = at.detail_vertices + 12 * (uint64_t)header->detail_vertex_count;
    at.nodes = at.detail_triangles + 4 * (uint64_t)header->detail_triangle_count;
    at.off_mesh = at.nodes + sizeof(tl_detour_node) * (uint64_t)header->node_count;
    at.end = at.off_mesh + sizeof(tl_detour_connection) * (uint64_t)header->off_mesh_count;
    return at;
}
