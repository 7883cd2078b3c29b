// SPDX-License-Identifier: MIT
//
// A level baked by Recast and Detour with talus's own settings, tile by tile, and the same polygons as a talus navmesh.

#ifndef TALUS_TEST_DETOUR_MESH_HPP
#define TALUS_TEST_DETOUR_MESH_HPP

#include "recast_pipeline.hpp"

#include <cstdlib>
#include <cstring>
#include <memory>
#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/DetourNavMeshQuery.h>
#include <talus/nav_query.h>

struct detour_deleter {
    void operator()(dtNavMesh *mesh) const
    {
        dtFreeNavMesh(mesh);
    }
    void operator()(dtNavMeshQuery *query) const
    {
        dtFreeNavMeshQuery(query);
    }
    void operator()(tl_navmesh *navmesh) const
    {
        tl_navmesh_destroy(navmesh);
    }
    void operator()(tl_nav_query *query) const
    {
        tl_nav_query_destroy(query);
    }
};

/// Detour's data of one tile; nullptr when the tile holds no polygon.
inline unsigned char *make_detour_tile(const recast_pipeline &recast, const tl_nav_config &config, int *size_out)
{
    const rcPolyMesh &mesh = *recast.polygons;
    const rcPolyMeshDetail &detail = *recast.detail;
    std::vector<unsigned short> flags((size_t)mesh.npolys, 1);
    dtNavMeshCreateParams params;
    std::memset(&params, 0, sizeof params);
    params.verts = mesh.verts;
    params.vertCount = mesh.nverts;
    params.polys = mesh.polys;
    params.polyFlags = flags.data();
    params.polyAreas = mesh.areas;
    params.polyCount = mesh.npolys;
    params.nvp = mesh.nvp;
    params.detailMeshes = detail.meshes;
    params.detailVerts = detail.verts;
    params.detailVertsCount = detail.nverts;
    params.detailTris = detail.tris;
    params.detailTriCount = detail.ntris;
    params.tileX = (int)config.tile_x;
    params.tileY = (int)config.tile_z;
    std::memcpy(params.bmin, mesh.bmin, sizeof params.bmin);
    std::memcpy(params.bmax, mesh.bmax, sizeof params.bmax);
    params.walkableHeight = config.agent_height;
    params.walkableRadius = config.agent_radius;
    params.walkableClimb = config.agent_max_climb;
    params.cs = config.cell_size;
    params.ch = config.cell_height;
    params.buildBvTree = true;
    unsigned char *data = nullptr;
    return dtCreateNavMeshData(&params, &data, size_out) ? data : nullptr;
}

/// The same polygons and detail as a talus tile; nullptr when there are none, or when they are not convex.
inline tl_nav_tile *make_talus_tile(const recast_pipeline &recast, const tl_nav_config &config)
{
    const rcPolyMesh &mesh = *recast.polygons;
    const rcPolyMeshDetail &detail = *recast.detail;
    std::vector<int32_t> vertices;
    for (int i = 0; i < 3 * mesh.nverts; i++) {
        vertices.push_back(mesh.verts[i]);
    }
    std::vector<uint32_t> first{ 0 }, indices, neighbours, areas;
    for (int p = 0; p < mesh.npolys; p++) {
        const unsigned short *polygon = mesh.polys + (size_t)p * 2 * (size_t)mesh.nvp;
        for (int k = 0; k < mesh.nvp && polygon[k] != RC_MESH_NULL_IDX; k++) {
            unsigned short across = polygon[mesh.nvp + k];
            indices.push_back(polygon[k]);
            bool portal = across != RC_MESH_NULL_IDX && (across & 0x8000) != 0 && (across & 0xf) != 0xf;
            neighbours.push_back(portal ? TL_PORTAL | (across & 3u) : (across & 0x8000) != 0 ? TL_NO_POLYGON : across);
        }
        first.push_back((uint32_t)indices.size());
        areas.push_back(mesh.areas[p]);
    }
    std::vector<tl_nav_detail_patch> patches;
    std::vector<tl_vec3> detail_vertices;
    std::vector<tl_nav_detail_triangle> triangles;
    for (int i = 0; i < detail.nverts; i++) {
        detail_vertices.push_back({ detail.verts[3 * i], detail.verts[3 * i + 1], detail.verts[3 * i + 2] });
    }
    for (int i = 0; i < detail.ntris; i++) {
        const unsigned char *t = detail.tris + 4 * i;
        triangles.push_back({ { t[0], t[1], t[2] }, 0 });
    }
    for (int i = 0; i < detail.nmeshes; i++) {
        const unsigned int *m = detail.meshes + 4 * i;
        patches.push_back({ m[0], m[1], m[2], m[3] });
    }
    tl_polygon_mesh polygons = {};
    polygons.vertex_count = (uint32_t)mesh.nverts;
    polygons.polygon_count = (uint32_t)mesh.npolys;
    polygons.index_count = (uint32_t)indices.size();
    polygons.vertices = vertices.data();
    polygons.first = first.data();
    polygons.indices = indices.data();
    polygons.neighbours = neighbours.data();
    polygons.areas = areas.data();
    polygons.bounds.min = { mesh.bmin[0], mesh.bmin[1], mesh.bmin[2] };
    polygons.cell_size = mesh.cs;
    polygons.cell_height = mesh.ch;
    tl_nav_detail patch_list = {};
    patch_list.patch_count = (uint32_t)patches.size();
    patch_list.vertex_count = (uint32_t)detail_vertices.size();
    patch_list.triangle_count = (uint32_t)triangles.size();
    patch_list.patches = patches.data();
    patch_list.vertices = detail_vertices.data();
    patch_list.triangles = triangles.data();
    tl_nav_tile_source source = {};
    source.polygons = &polygons;
    source.detail = &patch_list;
    source.tile_x = (int32_t)config.tile_x;
    source.tile_z = (int32_t)config.tile_z;
    source.tile_size = config.border_size > 0 ? config.width - 2 * config.border_size : 0;
    source.origin = config.lattice.origin;
    source.agent_height = config.agent_height;
    source.agent_radius = config.agent_radius;
    source.agent_max_climb = config.agent_max_climb;
    tl_nav_tile *tile = nullptr;
    tl_nav_tile_encode(&source, nullptr, &tile, nullptr);
    return tile;
}

/// A level as Recast and Detour have it, and the same polygons as talus has them.
struct detour_level {
    std::unique_ptr<dtNavMesh, detour_deleter> mesh{ dtAllocNavMesh() };
    std::unique_ptr<dtNavMeshQuery, detour_deleter> query{ dtAllocNavMeshQuery() };
    std::unique_ptr<tl_navmesh, detour_deleter> twin;
    bool twin_is_whole = true; ///< false: Recast made a polygon that is none
    unsigned area_kinds = 0;   ///< > 0: polygons get the areas 1 to this, by a hash of their number in the tile

    bool build(const tl_nav_def &def, const tl_mesh_view &view, tl_aabb bounds)
    {
        uint32_t tiles_x = 0, tiles_z = 0;
        tl_navmesh *navmesh = nullptr;
        if (tl_nav_tile_grid(&def, bounds, &tiles_x, &tiles_z, nullptr) != TL_OK ||
            tl_navmesh_create(nullptr, &navmesh) != TL_OK || !init(def, bounds, tiles_x * tiles_z)) {
            return false;
        }
        twin.reset(navmesh);
        for (uint32_t z = 0; z < tiles_z; z++) {
            for (uint32_t x = 0; x < tiles_x; x++) {
                if (!add_tile(def, view, bounds, x, z)) {
                    return false;
                }
            }
        }
        return dtStatusSucceed(query->init(mesh.get(), 65535));
    }

  private:
    bool init(const tl_nav_def &def, tl_aabb bounds, uint32_t tile_count)
    {
        dtNavMeshParams params;
        std::memset(&params, 0, sizeof params);
        std::memcpy(params.orig, &bounds.min.x, sizeof params.orig);
        params.tileWidth = def.tile_size > 0 ? (float)def.tile_size * def.cell_size : bounds.max.x - bounds.min.x;
        params.tileHeight = def.tile_size > 0 ? (float)def.tile_size * def.cell_size : bounds.max.z - bounds.min.z;
        // References have 22 bits for tile and polygon.
        params.maxTiles = 1;
        while (params.maxTiles < (int)tile_count) {
            params.maxTiles *= 2;
        }
        params.maxPolys = (1 << 22) / params.maxTiles;
        return dtStatusSucceed(mesh->init(&params));
    }

    bool add_tile(const tl_nav_def &def, const tl_mesh_view &view, tl_aabb bounds, uint32_t x, uint32_t z)
    {
        tl_nav_config config;
        recast_pipeline recast;
        if (tl_nav_config_from_def(&def, bounds, x, z, &config, nullptr) != TL_OK ||
            !recast.rasterize(config, view, def.agent_max_slope) || !recast.filter(config) ||
            !recast.build_compact(config) || !recast.erode(config) || !recast.distance_field() ||
            !recast.regions(config) || !recast.build_contours(config) || !recast.build_polygons(config) ||
            !recast.build_detail(config)) {
            return false;
        }
        if (recast.polygons->npolys == 0) {
            return true;
        }
        for (int p = 0; area_kinds > 0 && p < recast.polygons->npolys; p++) {
            recast.polygons->areas[p] = (unsigned char)(1u + ((unsigned)p * 2654435761u >> 16) % area_kinds);
        }
        int size = 0;
        unsigned char *data = make_detour_tile(recast, config, &size);
        if (data == nullptr || dtStatusFailed(mesh->addTile(data, size, DT_TILE_FREE_DATA, 0, nullptr))) {
            return false;
        }
        tl_nav_tile *tile = make_talus_tile(recast, config);
        if (tile == nullptr) {
            twin_is_whole = false;
            return true;
        }
        return tl_navmesh_add_tile(twin.get(), tile, TL_NAV_TILE_OWNED) == TL_OK;
    }
};

#endif
