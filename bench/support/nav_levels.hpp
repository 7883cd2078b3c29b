// SPDX-License-Identifier: MIT
//
// What bench_nav builds: levels of one part, and one of many tiles whose triangles are sorted before the clock starts.

#ifndef TALUS_BENCH_NAV_LEVELS_HPP
#define TALUS_BENCH_NAV_LEVELS_HPP

#include "io/mesh/mesh_import.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <talus/nav_bake.h>
#include <unordered_map>
#include <vector>

extern "C" {
#include "cli/sample/sample_level.h"
}

struct bench_mesh {
    std::vector<tl_vec3> vertices;
    std::vector<uint32_t> indices;

    tl_mesh_view view() const
    {
        return { vertices.data(), (uint32_t)vertices.size(), indices.data(), (uint32_t)(indices.size() / 3), nullptr };
    }
};

struct bench_part {
    tl_nav_config config;
    bench_mesh mesh;
};

struct bench_level {
    std::string name, description;
    bench_mesh mesh;
    std::vector<bench_part> parts;
};

constexpr uint32_t TILE_SIZE = 64, CITY_TRIANGLES = 1000000;

inline tl_aabb bounds_of(const bench_mesh &mesh)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i : mesh.indices) {
        bounds = tl_aabb_add_point(bounds, mesh.vertices[i]);
    }
    return bounds;
}

inline bool overlaps_on_xz(const tl_aabb &a, const tl_aabb &b)
{
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.z <= b.max.z && a.max.z >= b.min.z;
}

// The triangles of a mesh that a tile has to look at, with vertices of their own.
inline bench_mesh cut_mesh(const bench_mesh &mesh, const std::vector<uint32_t> &triangles)
{
    bench_mesh cut;
    std::unordered_map<uint32_t, uint32_t> renamed;
    for (uint32_t t : triangles) {
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t vertex = mesh.indices[3 * t + k];
            auto place = renamed.emplace(vertex, (uint32_t)cut.vertices.size());
            if (place.second) {
                cut.vertices.push_back(mesh.vertices[vertex]);
            }
            cut.indices.push_back(place.first->second);
        }
    }
    return cut;
}

// Adds the tiles that any triangle lies in.
inline bool add_tiles(const tl_nav_def &def, bench_level *level)
{
    const tl_aabb bounds = bounds_of(level->mesh);
    uint32_t tiles_x, tiles_z;
    if (tl_nav_tile_grid(&def, bounds, &tiles_x, &tiles_z, nullptr) != TL_OK) {
        return false;
    }
    std::vector<tl_nav_config> configs(tiles_x * tiles_z);
    std::vector<std::vector<uint32_t>> triangles(tiles_x * tiles_z);
    for (uint32_t t = 0; t < tiles_x * tiles_z; t++) {
        tl_nav_config_from_def(&def, bounds, t % tiles_x, t / tiles_x, &configs[t], nullptr);
    }
    for (uint32_t k = 0; k < level->mesh.indices.size() / 3; k++) {
        tl_aabb box = tl_aabb_empty();
        for (uint32_t c = 0; c < 3; c++) {
            box = tl_aabb_add_point(box, level->mesh.vertices[level->mesh.indices[3 * k + c]]);
        }
        const float tile = def.cell_size * (float)def.tile_size;
        const uint32_t x = (uint32_t)std::max(0.0f, (box.min.x - bounds.min.x) / tile - 1);
        const uint32_t z = (uint32_t)std::max(0.0f, (box.min.z - bounds.min.z) / tile - 1);
        for (uint32_t tz = z; tz < tiles_z && configs[tz * tiles_x].bounds.min.z <= box.max.z; tz++) {
            for (uint32_t tx = x; tx < tiles_x && configs[tx].bounds.min.x <= box.max.x; tx++) {
                if (overlaps_on_xz(box, configs[tz * tiles_x + tx].bounds)) {
                    triangles[tz * tiles_x + tx].push_back(k);
                }
            }
        }
    }
    for (uint32_t t = 0; t < tiles_x * tiles_z; t++) {
        if (!triangles[t].empty()) {
            level->parts.push_back({ configs[t], cut_mesh(level->mesh, triangles[t]) });
        }
    }
    return !level->parts.empty();
}

// With def.tile_size 0: one part.
inline void add_level(const std::string &name, const tl_mesh_view &view, const tl_nav_def &def,
                      std::vector<bench_level> *levels)
{
    bench_level level;
    level.mesh.vertices.assign(view.vertices, view.vertices + view.vertex_count);
    level.mesh.indices.assign(view.indices, view.indices + 3 * (size_t)view.triangle_count);
    level.name = name;
    level.description = name + ": " + std::to_string(view.triangle_count) + " triangles, ";
    if (def.tile_size > 0) {
        if (!add_tiles(def, &level)) {
            return;
        }
        level.description +=
            std::to_string(level.parts.size()) + " tiles of " + std::to_string(def.tile_size) + " cells";
    } else {
        tl_nav_config config;
        if (tl_nav_config_from_def(&def, bounds_of(level.mesh), 0, 0, &config, nullptr) != TL_OK) {
            std::printf("%s: no lattice\n", name.c_str());
            return;
        }
        level.description += std::to_string(config.width) + " x " + std::to_string(config.height) + " columns";
        level.parts.push_back({ config, level.mesh });
    }
    levels->push_back(level);
}

inline std::vector<bench_level> levels_of_files(const std::vector<std::string> &files, const tl_nav_def &def)
{
    std::vector<bench_level> levels;
    for (const std::string &path : files) {
        tl_imported_mesh mesh;
        if (tl_import_mesh(path.c_str(), nullptr, &mesh, nullptr) == TL_OK) {
            const size_t name = path.find_last_of('/') + 1;
            add_level(path.substr(name), tl_imported_mesh_as_view(&mesh), def, &levels);
            tl_imported_mesh_free(&mesh);
        }
    }
    return levels;
}

inline void add_sample(const tl_sample_level &sample, uint32_t triangles, const tl_nav_def &def,
                       std::vector<bench_level> *levels)
{
    tl_sample_mesh mesh;
    if (tl_sample_build_level(&sample, triangles, 1, &mesh) == TL_OK) {
        add_level(def.tile_size > 0 ? std::string(sample.name) + " in tiles" : sample.name,
                  tl_sample_mesh_as_view(&mesh), def, levels);
    }
    tl_sample_mesh_free(&mesh);
}

inline std::vector<bench_level> city_in_tiles(tl_nav_def def)
{
    std::vector<bench_level> levels;
    def.tile_size = TILE_SIZE;
    add_sample(*tl_sample_find_level("city"), CITY_TRIANGLES, def, &levels);
    return levels;
}

inline std::vector<bench_level> default_levels(const tl_nav_def &def)
{
    std::vector<std::string> files;
    std::error_code missing; // without the data folder the built-in levels are all there is
    for (const auto &entry : std::filesystem::directory_iterator(std::string(TALUS_DATA_DIR) + "/levels", missing)) {
        if (entry.path().extension() == ".obj") {
            files.push_back(entry.path().string());
        }
    }
    std::sort(files.begin(), files.end());
    std::vector<bench_level> levels = levels_of_files(files, def);
    uint32_t count;
    const tl_sample_level *samples = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; i++) {
        add_sample(samples[i], samples[i].default_triangles, def, &levels);
    }
    return levels;
}

#endif
