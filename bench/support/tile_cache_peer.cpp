// SPDX-License-Identifier: MIT
//
// Layers by Recast's stages at our own settings; no compression, which is the fastest there is, and a linear allocator,
// as Detour's own users have. Its tiles have no detail mesh, which ours do.

#include "tile_cache_peer.h"

#include "recast_pipeline.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/DetourTileCache.h>
#include <recastnavigation/DetourTileCacheBuilder.h>
#include <vector>

namespace
{

constexpr int MAX_LAYERS = 8;
constexpr float SLOPE_DEGREES = 45.0f; // the default def's

struct linear_alloc : dtTileCacheAlloc {
    std::vector<unsigned char> room = std::vector<unsigned char>((size_t)4 << 20);
    size_t used = 0;

    void reset() override
    {
        used = 0;
    }
    void *alloc(const size_t size) override
    {
        const size_t at = used;
        used += (size + 15) / 16 * 16;
        return used <= room.size() ? room.data() + at : nullptr;
    }
    void free(void *) override
    {
    }
};

struct no_compressor : dtTileCacheCompressor {
    int maxCompressedSize(const int size) override
    {
        return size;
    }
    dtStatus compress(const unsigned char *from, const int size, unsigned char *to, const int, int *to_size) override
    {
        std::memcpy(to, from, (size_t)size);
        *to_size = size;
        return DT_SUCCESS;
    }
    dtStatus decompress(const unsigned char *from, const int size, unsigned char *to, const int max_size,
                        int *to_size) override
    {
        if (size > max_size) {
            return DT_FAILURE;
        }
        std::memcpy(to, from, (size_t)size);
        *to_size = size;
        return DT_SUCCESS;
    }
};

struct all_walk : dtTileCacheMeshProcess {
    void process(dtNavMeshCreateParams *params, unsigned char *, unsigned short *flags) override
    {
        std::fill(flags, flags + params->polyCount, (unsigned short)1);
    }
};

// The triangles of each tile's box, with its border.
struct tile_triangles {
    std::vector<uint32_t> indices;

    tl_mesh_view view(const tl_mesh_view &mesh) const
    {
        tl_mesh_view part = mesh;
        part.indices = indices.data();
        part.triangle_count = (uint32_t)(indices.size() / 3);
        return part;
    }
};

} // namespace

struct bench_tile_cache {
    linear_alloc alloc;
    no_compressor compressor;
    all_walk process;
    dtTileCache cache;
    dtNavMesh mesh;
    dtObstacleRef last = 0;
    float agent_radius = 0.0f;
    double bytes = 0.0;

    bool add_layers(const tl_nav_config &config, const tl_mesh_view &triangles)
    {
        recast_pipeline recast;
        if (!recast.rasterize(config, triangles, SLOPE_DEGREES) || !recast.filter(config) ||
            !recast.build_compact(config) || !recast.erode(config)) {
            return false;
        }
        std::unique_ptr<rcHeightfieldLayerSet, void (*)(rcHeightfieldLayerSet *)> set(rcAllocHeightfieldLayerSet(),
                                                                                      rcFreeHeightfieldLayerSet);
        if (!rcBuildHeightfieldLayers(&recast.context, *recast.compact, (int)config.border_size,
                                      (int)config.walkable_height, *set)) {
            return false;
        }
        for (int i = 0; i < set->nlayers && i < MAX_LAYERS; i++) {
            const rcHeightfieldLayer &layer = set->layers[i];
            dtTileCacheLayerHeader header{};
            header.magic = DT_TILECACHE_MAGIC;
            header.version = DT_TILECACHE_VERSION;
            header.tx = (int)config.tile_x;
            header.ty = (int)config.tile_z;
            header.tlayer = i;
            std::copy(layer.bmin, layer.bmin + 3, header.bmin);
            std::copy(layer.bmax, layer.bmax + 3, header.bmax);
            header.hmin = (unsigned short)layer.hmin;
            header.hmax = (unsigned short)layer.hmax;
            header.width = (unsigned char)layer.width;
            header.height = (unsigned char)layer.height;
            header.minx = (unsigned char)layer.minx;
            header.maxx = (unsigned char)layer.maxx;
            header.miny = (unsigned char)layer.miny;
            header.maxy = (unsigned char)layer.maxy;
            unsigned char *data = nullptr;
            int size = 0;
            if (dtStatusFailed(dtBuildTileCacheLayer(&compressor, &header, layer.heights, layer.areas, layer.cons,
                                                     &data, &size)) ||
                dtStatusFailed(cache.addTile(data, size, DT_COMPRESSEDTILE_FREE_DATA, nullptr))) {
                return false;
            }
            bytes += size;
        }
        return dtStatusSucceed(cache.buildNavMeshTilesAt((int)config.tile_x, (int)config.tile_z, &mesh));
    }

    bool init(const tl_nav_config &config, uint32_t tiles_x, uint32_t tiles_z, uint32_t tile_size,
              const tl_aabb &bounds)
    {
        dtTileCacheParams params{};
        std::memcpy(params.orig, &bounds.min, sizeof params.orig);
        params.cs = config.cell_size;
        params.ch = config.cell_height;
        params.width = params.height = (int)tile_size;
        params.walkableHeight = config.agent_height;
        params.walkableRadius = config.agent_radius;
        params.walkableClimb = config.agent_max_climb;
        params.maxSimplificationError = config.max_simplification_error;
        params.maxTiles = (int)(tiles_x * tiles_z) * MAX_LAYERS;
        params.maxObstacles = 4096;
        dtNavMeshParams mesh_params{};
        std::memcpy(mesh_params.orig, &bounds.min, sizeof mesh_params.orig);
        mesh_params.tileWidth = mesh_params.tileHeight = (float)tile_size * config.cell_size;
        int bits = 0;
        while (1 << bits < params.maxTiles && bits < 14) {
            bits++;
        }
        mesh_params.maxTiles = 1 << bits;
        mesh_params.maxPolys = 1 << (22 - bits);
        agent_radius = config.agent_radius;
        return dtStatusSucceed(cache.init(&params, &alloc, &compressor, &process)) &&
               dtStatusSucceed(mesh.init(&mesh_params));
    }

    bool update()
    {
        bool is_done = false;
        while (!is_done) {
            if (dtStatusFailed(cache.update(0.0f, &mesh, &is_done))) {
                return false;
            }
        }
        return true;
    }
};

static void bin_triangles(const tl_mesh_view &mesh, const std::vector<tl_nav_config> &configs, uint32_t tiles_x,
                          std::vector<tile_triangles> &bins)
{
    const uint32_t tiles_z = (uint32_t)configs.size() / tiles_x;
    const float tile = configs.size() > 1 && tiles_x > 1 ? configs[1].bounds.min.x - configs[0].bounds.min.x : 1e30f;
    const tl_vec3 origin = configs[0].bounds.min;
    const auto place = [tile](float at, uint32_t count) {
        return std::min((int64_t)count - 1, std::max((int64_t)0, (int64_t)std::floor(at / tile)));
    };
    for (uint32_t t = 0; t < mesh.triangle_count; t++) {
        tl_aabb box = tl_aabb_empty();
        for (uint32_t k = 0; k < 3; k++) {
            box = tl_aabb_add_point(box, mesh.vertices[mesh.indices[3 * (size_t)t + k]]);
        }
        // A tile reaches less than another one's size beyond its own places.
        const int64_t x_end = place(box.max.x - origin.x, tiles_x), z_end = place(box.max.z - origin.z, tiles_z);
        for (int64_t z = std::max((int64_t)0, place(box.min.z - origin.z, tiles_z) - 1); z <= z_end; z++) {
            for (int64_t x = std::max((int64_t)0, place(box.min.x - origin.x, tiles_x) - 1); x <= x_end; x++) {
                const size_t i = (size_t)z * tiles_x + (size_t)x;
                const tl_aabb &of_tile = configs[i].bounds;
                if (box.max.x >= of_tile.min.x && box.min.x <= of_tile.max.x && box.max.z >= of_tile.min.z &&
                    box.min.z <= of_tile.max.z) {
                    const uint32_t *corners = mesh.indices + 3 * (size_t)t;
                    bins[i].indices.insert(bins[i].indices.end(), corners, corners + 3);
                }
            }
        }
    }
}

bench_tile_cache *bench_tile_cache_make(const tl_nav_def *def, const tl_mesh_view *mesh)
{
    uint32_t tiles_x = 0, tiles_z = 0;
    if (tl_nav_tile_grid(def, def->bounds, &tiles_x, &tiles_z, nullptr) != TL_OK) {
        return nullptr;
    }
    std::vector<tl_nav_config> configs((size_t)tiles_x * tiles_z);
    for (uint32_t i = 0; i < tiles_x * tiles_z; i++) {
        if (tl_nav_config_from_def(def, def->bounds, i % tiles_x, i / tiles_x, &configs[i], nullptr) != TL_OK) {
            return nullptr;
        }
    }
    std::vector<tile_triangles> bins(configs.size());
    bin_triangles(*mesh, configs, tiles_x, bins);
    std::unique_ptr<bench_tile_cache> peer(new bench_tile_cache);
    if (!peer->init(configs[0], tiles_x, tiles_z, def->tile_size, def->bounds)) {
        return nullptr;
    }
    for (size_t i = 0; i < configs.size(); i++) {
        if (!bins[i].indices.empty() && !peer->add_layers(configs[i], bins[i].view(*mesh))) {
            return nullptr;
        }
    }
    return peer.release();
}

void bench_tile_cache_free(bench_tile_cache *cache)
{
    delete cache;
}

bool bench_tile_cache_place(bench_tile_cache *cache, tl_vec3 base, float radius, float height, bool moves_last)
{
    if (moves_last && cache->last != 0 && dtStatusFailed(cache->cache.removeObstacle(cache->last))) {
        return false;
    }
    return dtStatusSucceed(cache->cache.addObstacle(&base.x, radius + cache->agent_radius, height, &cache->last)) &&
           cache->update();
}

double bench_tile_cache_bytes(const bench_tile_cache *cache)
{
    return cache->bytes;
}
