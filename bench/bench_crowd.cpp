// SPDX-License-Identifier: MIT
//
// Crowds beside DetourCrowd's: the same polygons, agents, goals and steps, in one process.
//
//   bench_crowd [--seconds SIMULATED (40)] [--max AGENTS (2000)] [--json FILE]
//
// A square with pillars, six square metres an agent; everybody walks to a random place. CPU time of one thread. Besides
// the time: pairs that overlap by more than a hundredth of both radii, agents off their polygon, changes of velocity
// from step to step, and how many have arrived.

#include "base/random.h"
#include "bench_options.h"
#include "detour_mesh.hpp"
#include "measure.h"
#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <recastnavigation/DetourCrowd.h>
#include <string>
#include <talus/nav_crowd.h>
#include <vector>

namespace
{

constexpr float RADIUS = 0.3f, HEIGHT = 1.8f, SPEED = 1.4f, ACCELERATION = 8.0f, DT = 0.05f;
constexpr float AREA = 6.0f;     // square metres an agent
constexpr float PILLARS = 10.0f; // metres from one to the next

uint64_t random_state = 4;

struct crowd_level {
    std::vector<tl_vec3> vertices;
    std::vector<uint32_t> indices;

    void quad(tl_vec3 a, tl_vec3 b, tl_vec3 c, tl_vec3 d)
    {
        const uint32_t v = (uint32_t)vertices.size();
        vertices.insert(vertices.end(), { a, b, c, d });
        indices.insert(indices.end(), { v, v + 1, v + 2, v, v + 2, v + 3 });
    }

    void pillar(float x, float z)
    {
        const float x0 = x - 0.5f, x1 = x + 0.5f, z0 = z - 0.5f, z1 = z + 0.5f;
        quad({ x0, 3, z0 }, { x0, 3, z1 }, { x1, 3, z1 }, { x1, 3, z0 });
        quad({ x0, 0, z0 }, { x0, 3, z0 }, { x1, 3, z0 }, { x1, 0, z0 });
        quad({ x1, 0, z1 }, { x1, 3, z1 }, { x0, 3, z1 }, { x0, 0, z1 });
        quad({ x0, 0, z1 }, { x0, 3, z1 }, { x0, 3, z0 }, { x0, 0, z0 });
        quad({ x1, 0, z0 }, { x1, 3, z0 }, { x1, 3, z1 }, { x1, 0, z1 });
    }

    explicit crowd_level(float side)
    {
        quad({ 0, 0, 0 }, { 0, 0, side }, { side, 0, side }, { side, 0, 0 });
        for (float x = PILLARS / 2; x < side - 1; x += PILLARS) {
            for (float z = PILLARS / 2; z < side - 1; z += PILLARS) {
                pillar(x, z);
            }
        }
    }
};

struct body {
    float x, y, z, vx, vz;
    bool off_mesh, arrived;
};

struct figures {
    double seconds = 0;
    uint64_t agent_steps = 0, overlaps = 0, off_mesh = 0;
    float deepest = 0;
    double turn = 0;
    uint32_t arrived = 0;

    void add(const std::vector<body> &now, const std::vector<body> &before)
    {
        arrived = 0;
        for (size_t i = 0; i < now.size(); i++) {
            agent_steps++;
            off_mesh += now[i].off_mesh;
            arrived += now[i].arrived;
            turn += (double)std::hypot(now[i].vx - before[i].vx, now[i].vz - before[i].vz);
        }
        // Pairs by a sweep along x.
        std::vector<uint32_t> order(now.size());
        for (uint32_t i = 0; i < order.size(); i++) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return now[a].x < now[b].x; });
        for (size_t i = 0; i < order.size(); i++) {
            for (size_t k = i + 1; k < order.size() && now[order[k]].x - now[order[i]].x < 2 * RADIUS; k++) {
                const body &a = now[order[i]], &b = now[order[k]];
                const float depth = 2 * RADIUS - std::hypot(a.x - b.x, a.z - b.z);
                if (depth > 0.02f * RADIUS) {
                    overlaps++;
                    deepest = std::max(deepest, depth);
                }
            }
        }
    }
};

struct scene {
    detour_level level;
    std::vector<tl_nav_location> starts, goals;
    std::vector<dtPolyRef> start_refs, goal_refs;

    bool locate(const dtQueryFilter &filter, std::vector<tl_nav_location> *out, std::vector<dtPolyRef> *refs)
    {
        float point[3];
        dtPolyRef ref = 0;
        tl_nav_location at;
        level.query->findRandomPoint(
            &filter, [] { return tl_random_unit_float(&random_state); }, &ref, point);
        if (tl_navmesh_find_nearest(level.twin.get(), nullptr, { point[0], point[1], point[2] }, { 0.5f, 1, 0.5f },
                                    &at) != TL_OK) {
            return false;
        }
        for (const tl_nav_location &other : *out) {
            if (out == &starts && std::hypot(other.point.x - at.point.x, other.point.z - at.point.z) < 2.5f * RADIUS) {
                return false;
            }
        }
        out->push_back(at);
        refs->push_back(ref);
        return true;
    }

    bool build(uint32_t count)
    {
        const crowd_level soup(std::sqrt(AREA * (float)count));
        const tl_mesh_view view = { soup.vertices.data(), (uint32_t)soup.vertices.size(), soup.indices.data(),
                                    (uint32_t)soup.indices.size() / 3, nullptr };
        tl_nav_def def = tl_default_nav_def();
        def.cell_size = 0.15f;
        def.agent_radius = RADIUS;
        def.agent_height = HEIGHT;
        def.tile_size = 128;
        tl_aabb bounds = tl_aabb_empty();
        for (const tl_vec3 &v : soup.vertices) {
            bounds = tl_aabb_add_point(bounds, v);
        }
        if (!level.build(def, view, bounds)) {
            return false;
        }
        dtQueryFilter filter;
        while (starts.size() < count) {
            locate(filter, &starts, &start_refs);
        }
        while (goals.size() < count) {
            locate(filter, &goals, &goal_refs);
        }
        return true;
    }
};

figures run_talus(const scene &s, uint32_t steps)
{
    figures f;
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    def.max_agents = (uint32_t)s.starts.size();
    tl_nav_crowd *crowd = nullptr;
    tl_nav_crowd_create(&def, &crowd, nullptr);
    std::vector<tl_nav_agent> agents(s.starts.size());
    tl_nav_agent_def agent = tl_default_nav_agent_def();
    agent.radius = RADIUS;
    agent.height = HEIGHT;
    agent.max_speed = SPEED;
    agent.max_acceleration = ACCELERATION;
    agent.arrive_distance = RADIUS;
    for (size_t i = 0; i < agents.size(); i++) {
        agent.position = s.starts[i].point;
        tl_nav_crowd_add(crowd, s.level.twin.get(), &agent, &agents[i], nullptr);
        tl_nav_crowd_set_goal(crowd, agents[i], &s.goals[i]);
    }
    std::vector<body> now(agents.size()), before;
    for (uint32_t step = 0; step < steps; step++) {
        const double begin = bench_thread_seconds();
        tl_nav_crowd_step(crowd, s.level.twin.get(), DT, nullptr);
        f.seconds += bench_thread_seconds() - begin;
        before = now;
        for (size_t i = 0; i < agents.size(); i++) {
            tl_nav_agent_state state;
            tl_vec3 on;
            bool inside = false;
            tl_nav_crowd_agent(crowd, agents[i], &state);
            tl_navmesh_closest_point(s.level.twin.get(), state.polygon, state.position, &on, &inside);
            now[i] = { state.position.x,
                       state.position.y,
                       state.position.z,
                       state.velocity.x,
                       state.velocity.z,
                       std::hypot(on.x - state.position.x, on.z - state.position.z) > 1e-3f,
                       state.status == TL_NAV_AGENT_ARRIVED };
        }
        f.add(now, step == 0 ? now : before);
    }
    tl_nav_crowd_destroy(crowd);
    return f;
}

figures run_detour(scene &s, uint32_t steps)
{
    figures f;
    dtCrowd *crowd = dtAllocCrowd();
    crowd->init((int)s.starts.size(), RADIUS, s.level.mesh.get());
    dtCrowdAgentParams params;
    std::memset(&params, 0, sizeof params);
    params.radius = RADIUS;
    params.height = HEIGHT;
    params.maxAcceleration = ACCELERATION;
    params.maxSpeed = SPEED;
    params.collisionQueryRange = RADIUS * 12.0f;
    params.pathOptimizationRange = RADIUS * 30.0f;
    params.separationWeight = 2.0f;
    params.obstacleAvoidanceType = 3;
    params.updateFlags = DT_CROWD_ANTICIPATE_TURNS | DT_CROWD_OPTIMIZE_VIS | DT_CROWD_OPTIMIZE_TOPO |
                         DT_CROWD_OBSTACLE_AVOIDANCE | DT_CROWD_SEPARATION;
    for (size_t i = 0; i < s.starts.size(); i++) {
        const int index = crowd->addAgent(&s.starts[i].point.x, &params);
        crowd->requestMoveTarget(index, s.goal_refs[i], &s.goals[i].point.x);
    }
    std::vector<body> now(s.starts.size()), before;
    for (uint32_t step = 0; step < steps; step++) {
        const double begin = bench_thread_seconds();
        crowd->update(DT, nullptr);
        f.seconds += bench_thread_seconds() - begin;
        before = now;
        for (size_t i = 0; i < now.size(); i++) {
            const dtCrowdAgent *agent = crowd->getAgent((int)i);
            float on[3] = { 0, 0, 0 };
            bool over = false;
            s.level.query->closestPointOnPoly(agent->corridor.getFirstPoly(), agent->npos, on, &over);
            const tl_vec3 goal = s.goals[i].point;
            now[i] = { agent->npos[0],
                       agent->npos[1],
                       agent->npos[2],
                       agent->vel[0],
                       agent->vel[2],
                       std::hypot(on[0] - agent->npos[0], on[2] - agent->npos[2]) > 1e-3f,
                       std::hypot(goal.x - agent->npos[0], goal.z - agent->npos[2]) <= RADIUS };
        }
        f.add(now, step == 0 ? now : before);
    }
    dtFreeCrowd(crowd);
    return f;
}

void print(const char *who, uint32_t count, const figures &f)
{
    std::printf("%7u  %-8s %7.2f us  %8.2f  %6.3f m  %6llu  %7.4f  %5.1f%%\n", count, who,
                1e6 * f.seconds / (double)f.agent_steps, 1000.0 * (double)f.overlaps / (double)f.agent_steps,
                (double)f.deepest, (unsigned long long)f.off_mesh, f.turn / (double)f.agent_steps,
                100.0 * f.arrived / count);
}

} // namespace

int main(int argc, char **argv)
{
    uint32_t seconds = 40, most = 2000;
    const bench_option options[] = { { "seconds", BENCH_COUNT, &seconds, "that are simulated" },
                                     { "max", BENCH_COUNT, &most, "agents of the largest crowd" },
                                     { nullptr, BENCH_COUNT, nullptr, nullptr } };
    const char *json = nullptr;
    bench_parse(argc, argv, options, nullptr, &json);
    bench_report *report = bench_report_new("crowd", "us", "agents");
    std::printf(" agents  who      an agent's step  overlaps   deepest  off mesh  turn m/s  arrived\n"
                "                           per 1000 agent-steps\n");
    for (const uint32_t count : { 100u, 500u, 2000u, 10000u }) {
        scene s;
        if (count > most || !s.build(count)) {
            continue;
        }
        const uint32_t steps = (uint32_t)((float)seconds / DT);
        const figures talus = run_talus(s, steps);
        const figures detour = run_detour(s, steps);
        print("talus", count, talus);
        print("Detour", count, detour);
        bench_report_point(report, "a step of an agent", "talus", count,
                           1e6 * talus.seconds / (double)talus.agent_steps);
        bench_report_point(report, "a step of an agent", "DetourCrowd", count,
                           1e6 * detour.seconds / (double)detour.agent_steps);
        bench_report_speed(report, (std::to_string(count) + " agents").c_str(), "DetourCrowd",
                           detour.seconds / talus.seconds, 1.0);
        bench_report_at_most(report, "agents off the mesh", (double)talus.off_mesh, 0.0);
    }
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
