// SPDX-License-Identifier: MIT
//
// Scenes that crowds are measured in: the level, who starts where and goes where, and what is counted while they walk.
// Whoever moves them counts the same way, by positions alone.

#ifndef TALUS_BENCH_CROWD_SCENES_HPP
#define TALUS_BENCH_CROWD_SCENES_HPP

#include "base/random.h"
#include "detour_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

constexpr float CROWD_RADIUS = 0.3f, CROWD_HEIGHT = 1.8f, CROWD_SPEED = 1.4f, CROWD_ACCELERATION = 8.0f;
constexpr float CROWD_DT = 0.05f;

/// Triangles of a floor and what stands on it.
struct crowd_level {
    std::vector<tl_vec3> vertices;
    std::vector<uint32_t> indices;

    void quad(tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d)
    {
        const uint32_t v = (uint32_t)vertices.size();
        vertices.insert(vertices.end(), { a, b, c, d });
        indices.insert(indices.end(), { v, v + 1, v + 2, v, v + 2, v + 3 });
    }

    void floor(float x0, float z0, float x1, float z1, float y)
    {
        quad({ x0, y, z0 }, { x0, y, z1 }, { x1, y, z1 }, { x1, y, z0 });
    }

    void block(float x0, float z0, float x1, float z1)
    {
        quad({ x0, 3, z0 }, { x0, 3, z1 }, { x1, 3, z1 }, { x1, 3, z0 });
        quad({ x0, 0, z0 }, { x0, 3, z0 }, { x1, 3, z0 }, { x1, 0, z0 });
        quad({ x1, 0, z1 }, { x1, 3, z1 }, { x0, 3, z1 }, { x0, 0, z1 });
        quad({ x0, 0, z1 }, { x0, 3, z1 }, { x0, 3, z0 }, { x0, 0, z0 });
        quad({ x1, 0, z0 }, { x1, 3, z0 }, { x1, 3, z1 }, { x1, 0, z1 });
    }
};

/// Where an agent is after a step.
struct crowd_body {
    float x, y, z, vx, vz;
    bool off_mesh;
};

struct crowd_scene {
    const char *name;
    detour_level level;
    std::vector<tl_nav_location> starts, goals;
    std::vector<dtPolyRef> start_refs, goal_refs;
    float near_goal = CROWD_RADIUS; ///< metres: an agent that came so near to its goal has arrived
    float seconds = 600.0f;         ///< of the run, unless all have arrived before
    float door = 0.0f;              ///< metres; > 0: a wall of half a metre along x = 0 has a door of that width
    uint64_t random = 4;

    bool bake(const crowd_level &soup)
    {
        const tl_mesh_view view = { soup.vertices.data(), (uint32_t)soup.vertices.size(), soup.indices.data(),
                                    (uint32_t)soup.indices.size() / 3, nullptr };
        tl_nav_def def = tl_default_nav_def();
        def.cell_size = 0.15f;
        def.agent_radius = CROWD_RADIUS;
        def.agent_height = CROWD_HEIGHT;
        def.tile_size = 128;
        tl_aabb bounds = tl_aabb_empty();
        for (const tl_vec3 &v : soup.vertices) {
            bounds = tl_aabb_add_point(bounds, v);
        }
        return level.build(def, view, bounds);
    }

    bool place(tl_vec3 at, std::vector<tl_nav_location> *out, std::vector<dtPolyRef> *refs)
    {
        const dtQueryFilter filter;
        const float extents[3] = { 0.5f, 1.0f, 0.5f };
        float point[3];
        dtPolyRef ref = 0;
        tl_nav_location location;
        level.query->findNearestPoly(&at.x, extents, &filter, &ref, point);
        if (ref == 0 || tl_navmesh_find_nearest(level.twin.get(), nullptr, at, { 0.5f, 1, 0.5f }, &location) != TL_OK) {
            return false;
        }
        out->push_back(location);
        refs->push_back(ref);
        return true;
    }

    bool send(tl_vec3 start, tl_vec3 goal)
    {
        return place(start, &starts, &start_refs) && place(goal, &goals, &goal_refs);
    }

    /// A square of 6 m2 an agent, with pillars 10 m apart or without: everybody to a random place.
    bool square(uint32_t count, bool pillars)
    {
        constexpr float AREA = 6.0f, APART = 10.0f;
        crowd_level soup;
        const float side = std::sqrt(AREA * (float)count);
        soup.floor(0, 0, side, side, 0);
        for (float x = APART / 2; pillars && x < side - 1; x += APART) {
            for (float z = APART / 2; z < side - 1; z += APART) {
                soup.block(x - 0.5f, z - 0.5f, x + 0.5f, z + 0.5f);
            }
        }
        if (!bake(soup)) {
            return false;
        }
        // Starts on a jittered lattice, so that nobody overlaps; goals anywhere.
        const uint32_t rows = (uint32_t)std::ceil(std::sqrt((float)count));
        const float cell = (side - 2.0f) / (float)rows;
        const float jitter = std::max(0.0f, cell - 2.5f * CROWD_RADIUS);
        for (uint32_t i = 0; starts.size() < count && i < rows * rows; i++) {
            const float x = 1.0f + cell * (float)(i % rows) + jitter * tl_random_unit_float(&random);
            const float z = 1.0f + cell * (float)(i / rows) + jitter * tl_random_unit_float(&random);
            place({ x, 0, z }, &starts, &start_refs);
        }
        while (goals.size() < starts.size()) {
            const float x = 1.0f + (side - 2.0f) * tl_random_unit_float(&random);
            const float z = 1.0f + (side - 2.0f) * tl_random_unit_float(&random);
            place({ x, 0, z }, &goals, &goal_refs);
        }
        return true;
    }

    /// Everybody to the other side of a circle.
    bool circle(uint32_t count)
    {
        crowd_level soup;
        soup.floor(-45, -45, 45, 45, 0);
        bool good = bake(soup);
        for (uint32_t i = 0; i < count; i++) {
            const double angle = 6.283185307179586 * i / count;
            const float x = (float)(40 * std::cos(angle)), z = (float)(40 * std::sin(angle));
            good = good && send({ x, 0, z }, { -x, 0, -z });
        }
        return good;
    }

    /// Two halls and a door between them; `count` agents from each side, or all from one.
    bool doorway(float width, uint32_t count, bool both)
    {
        crowd_level soup;
        soup.floor(-32, -12, 32, 12, 0);
        soup.block(-0.25f, -12.5f, 0.25f, -0.5f * width);
        soup.block(-0.25f, 0.5f * width, 0.25f, 12.5f);
        bool good = bake(soup);
        door = width;
        for (uint32_t i = 0; i < (both ? 2 * count : count); i++) {
            const uint32_t k = both ? i / 2 : i;
            const float side = both && i % 2 != 0 ? -1.0f : 1.0f;
            const float x = side * (5.0f + 1.2f * (float)(k / 10)), z = -9.0f + 2.0f * (float)(k % 10);
            good = good && send({ x, 0, z }, { -x, 0, z });
        }
        return good;
    }

    /// Everybody to one point: arrived is who stands within the disc that they fill.
    bool one_point(uint32_t count)
    {
        constexpr float FILLED = 0.3f; // share of the disc that they cover; the densest packing has 0.9
        crowd_level soup;
        soup.floor(-40, -40, 40, 40, 0);
        bool good = bake(soup);
        near_goal = CROWD_RADIUS * std::sqrt((float)count / FILLED);
        for (uint32_t i = 0; i < count; i++) {
            const float x = -37.0f + 3.2f * (float)(i % 24) + 2.4f * tl_random_unit_float(&random) - 1.2f;
            const float z = -37.0f + 3.2f * (float)(i / 24) + 2.4f * tl_random_unit_float(&random) - 1.2f;
            good = good && send({ x, 0, z }, { 0, 0, 0 });
        }
        return good;
    }

    /// Two floors 2.5 m apart, on each `count` agents who cross: nobody avoids those on the other one.
    bool floors(uint32_t count)
    {
        crowd_level soup;
        soup.floor(-15, -15, 15, 15, 0);
        soup.floor(-15, -15, 15, 15, 2.5f);
        bool good = bake(soup);
        for (uint32_t i = 0; i < 2 * count; i++) {
            const double angle = 6.283185307179586 * (i / 2) / count;
            const float x = (float)(13 * std::cos(angle)), z = (float)(13 * std::sin(angle));
            const float y = i % 2 == 0 ? 0.0f : 2.5f;
            good = good && send({ x, y, z }, { -x, y, -z });
        }
        return good;
    }
};

/// Sums over the steps of a run.
struct crowd_figures {
    double seconds = 0; ///< of CPU, that the steps took
    uint64_t agent_steps = 0, overlaps = 0, off_mesh = 0, in_walls = 0;
    float deepest = 0;
    double turn = 0; ///< metres a second: changes of velocity from step to step, of all
    std::vector<float> arrived_at;
    uint32_t arrived = 0;
    float time = 0;

    void add(const crowd_scene &scene, const std::vector<crowd_body> &now, const std::vector<crowd_body> &before)
    {
        arrived_at.resize(now.size(), -1.0f);
        time += CROWD_DT;
        for (size_t i = 0; i < now.size(); i++) {
            agent_steps++;
            off_mesh += now[i].off_mesh;
            in_walls += scene.door > 0 && std::fabs(now[i].x) < 0.25f + 0.99f * CROWD_RADIUS &&
                        std::fabs(now[i].z) > 0.5f * scene.door;
            turn += (double)std::hypot(now[i].vx - before[i].vx, now[i].vz - before[i].vz);
            const tl_vec3 goal = scene.goals[i].point;
            if (arrived_at[i] < 0 && std::hypot(now[i].x - goal.x, now[i].z - goal.z) <= scene.near_goal) {
                arrived_at[i] = time;
                arrived++;
            }
        }
        // Pairs by a sweep along x: deeper than a hundredth of both radii.
        std::vector<uint32_t> order(now.size());
        for (uint32_t i = 0; i < order.size(); i++) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return now[a].x < now[b].x; });
        for (size_t i = 0; i < order.size(); i++) {
            for (size_t k = i + 1; k < order.size() && now[order[k]].x - now[order[i]].x < 2 * CROWD_RADIUS; k++) {
                const crowd_body &a = now[order[i]], &b = now[order[k]];
                const float depth = 2 * CROWD_RADIUS - std::hypot(a.x - b.x, a.z - b.z);
                if (depth > 0.02f * CROWD_RADIUS && std::fabs(a.y - b.y) < CROWD_HEIGHT) {
                    overlaps++;
                    deepest = std::max(deepest, depth);
                }
            }
        }
    }

    float last() const
    {
        return arrived_at.empty() ? 0.0f : *std::max_element(arrived_at.begin(), arrived_at.end());
    }

    bool is_over(const crowd_scene &scene) const
    {
        return arrived == scene.starts.size() || time >= scene.seconds;
    }
};

#endif
