// SPDX-License-Identifier: MIT
//
// The levels that are compared with Recast and Detour: built-in ones at 0.25 m, and those of the data folder at 0.3 m;
// or all at the cell size that is a test's first argument; or instead of all of them the files that follow it.

#ifndef TALUS_TEST_LEVEL_LIST_HPP
#define TALUS_TEST_LEVEL_LIST_HPP

#include "io/mesh/mesh_import.h"

#include <talus/mesh.h>

// C headers that do not say so themselves.
extern "C" {
#include "cli/sample/sample_level.h"
#include "talus_test.h"
}

#include <cstdlib>
#include <string>
#include <vector>

struct level {
    std::string name;
    float cell_size;
    float max_slope; // degrees
    float margin;    // metres by which the bounds are wider than the mesh on x and z
    std::vector<tl_vec3> vertices;
    std::vector<uint32_t> indices;

    tl_mesh_view view() const
    {
        return { vertices.data(), (uint32_t)vertices.size(), indices.data(), (uint32_t)(indices.size() / 3), nullptr };
    }

    tl_aabb bounds() const
    {
        tl_aabb box = tl_aabb_empty();
        for (uint32_t i : indices) {
            box = tl_aabb_add_point(box, vertices[i]);
        }
        box.min.x -= margin;
        box.min.z -= margin;
        box.max.x += margin;
        box.max.z += margin;
        return box;
    }
};

// 0: each level's own.
inline float wanted_cell_size = 0.0f;
// Not empty: these, and no others.
inline std::vector<std::string> wanted_files;

inline void take_level_arguments(int argc, char **argv)
{
    wanted_cell_size = argc > 1 ? std::strtof(argv[1], nullptr) : 0.0f;
    wanted_files.assign(argv + (argc < 2 ? argc : 2), argv + argc);
}

inline level copy_level(const std::string &name, float cell_size, const tl_mesh_view &view)
{
    return { name,
             wanted_cell_size > 0.0f ? wanted_cell_size : cell_size,
             45.0f,
             0.0f,
             { view.vertices, view.vertices + view.vertex_count },
             { view.indices, view.indices + 3 * (size_t)view.triangle_count } };
}

inline bool load_level_file(const std::string &path, const std::string &name, level *out)
{
    tl_imported_mesh mesh;
    if (tl_import_mesh(path.c_str(), nullptr, &mesh, nullptr) != TL_OK) {
        return false;
    }
    *out = copy_level(name, 0.3f, tl_imported_mesh_as_view(&mesh));
    tl_imported_mesh_free(&mesh);
    return true;
}

// A level of the data folder; false where there is none.
inline bool load_level(const std::string &name, level *out)
{
    if (!load_level_file(std::string(TALUS_DATA_DIR) + "/levels/" + name + ".obj", name, out)) {
        return false;
    }
    // Every second metre of this level is a bevel of exactly 45 degrees. At that limit they are not walkable here, and
    // some are and some are not by Recast's rounding, which at small cells is a ninth of the floor.
    if (name == "proto-level") {
        out->max_slope = 46.0f;
    }
    return true;
}

inline std::vector<level> load_wanted_files()
{
    std::vector<level> levels;
    for (const std::string &path : wanted_files) {
        level l;
        if (!load_level_file(path, path.substr(path.find_last_of('/') + 1), &l)) {
            fail_msg("%s cannot be read", path.c_str());
        }
        levels.push_back(l);
    }
    return levels;
}

// The built-in levels of at most `max_triangles`, then those of `files` that the data folder has; or those wanted.
inline std::vector<level> all_levels(uint32_t max_triangles, const std::vector<std::string> &files)
{
    std::vector<level> levels = load_wanted_files();
    if (!levels.empty()) {
        return levels;
    }
    uint32_t count;
    const tl_sample_level *samples = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; i++) {
        tl_sample_mesh mesh;
        uint32_t triangles =
            samples[i].default_triangles < max_triangles ? samples[i].default_triangles : max_triangles;
        TEST_RESULT(tl_sample_build_level(&samples[i], triangles, 1, &mesh), TL_OK);
        levels.push_back(copy_level(samples[i].name, 0.25f, tl_sample_mesh_as_view(&mesh)));
        // They are modelled in decimetres. Half of one aside no wall lies on a line between cells, where the noise of
        // Recast's lattice decides to which side it goes.
        levels.back().margin = wanted_cell_size > 0.0f ? 0.05f : 0.0f;
        tl_sample_mesh_free(&mesh);
    }
    for (const std::string &name : files) {
        level l;
        if (load_level(name, &l)) {
            levels.push_back(l);
        }
    }
    return levels;
}

#endif
