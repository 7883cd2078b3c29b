// SPDX-License-Identifier: MIT
//
// Crowds beside DetourCrowd's: the same polygons, agents, goals and steps, in one process.
//
//   bench_crowd [--seconds SIMULATED (40)] [--max AGENTS (2000)] [--scenes 0|1 (1)] [--detour 0|1 (1)]
//               [--threads 1|2 (1)] [--json FILE]
//
// First what a step of an agent costs: squares with pillars and without, six square metres an agent, everybody to a
// random place. CPU time of one thread; of two the time by the clock, and how much sooner they are done. Then the
// scenes that crowds are judged by (support/crowd_scenes.hpp): pairs that overlap by more than a hundredth of both
// radii, agents off their polygon, changes of velocity from step to step, and when all have arrived.

#include "bench_options.h"
#include "crowd_scenes.hpp"
#include "measure.h"
#include "report.h"
#include "second_thread.hpp"

#include <cstdio>
#include <cstring>
#include <recastnavigation/DetourCrowd.h>
#include <string>
#include <talus/nav_crowd.h>

namespace
{

crowd_figures run_talus(const crowd_scene &s, const tl_tasks *tasks = nullptr,
                        double (*seconds)() = bench_thread_seconds)
{
    crowd_figures f;
    const tl_navmesh *navmesh = s.level.twin.get();
    tl_nav_crowd_def def = tl_default_nav_crowd_def();
    def.max_agents = (uint32_t)s.starts.size();
    def.host.tasks = tasks;
    def.paths_per_step = std::max(64u, def.max_agents / 20); // all have one after a second
    tl_nav_crowd *crowd = nullptr;
    if (tl_nav_crowd_create(&def, &crowd, nullptr) != TL_OK) {
        return f;
    }
    std::vector<tl_nav_agent> agents(s.starts.size());
    tl_nav_agent_def agent = tl_default_nav_agent_def();
    agent.radius = CROWD_RADIUS;
    agent.height = CROWD_HEIGHT;
    agent.max_speed = CROWD_SPEED;
    agent.max_acceleration = CROWD_ACCELERATION;
    agent.reach = 0.5f;
    for (size_t i = 0; i < agents.size(); i++) {
        agent.position = s.starts[i].point;
        tl_nav_crowd_add(crowd, navmesh, &agent, &agents[i], nullptr);
        tl_nav_crowd_set_goal(crowd, agents[i], &s.goals[i]);
    }
    std::vector<crowd_body> now(agents.size()), before;
    while (!f.is_over(s)) {
        const double begin = seconds();
        tl_nav_crowd_step(crowd, navmesh, CROWD_DT, nullptr);
        f.seconds += seconds() - begin;
        before = now;
        for (size_t i = 0; i < agents.size(); i++) {
            tl_nav_agent_state state;
            tl_vec3 on;
            bool inside = false;
            tl_nav_crowd_agent(crowd, agents[i], &state);
            tl_navmesh_closest_point(navmesh, state.polygon, state.position, &on, &inside);
            now[i] = { state.position.x, state.position.y,
                       state.position.z, state.velocity.x,
                       state.velocity.z, std::hypot(on.x - state.position.x, on.z - state.position.z) > 1e-3f };
        }
        f.add(s, now, before.empty() ? now : before);
    }
    tl_nav_crowd_destroy(crowd);
    return f;
}

crowd_figures run_detour(const crowd_scene &s)
{
    crowd_figures f;
    dtCrowd *crowd = dtAllocCrowd();
    crowd->init((int)s.starts.size(), CROWD_RADIUS, s.level.mesh.get());
    dtCrowdAgentParams params;
    std::memset(&params, 0, sizeof params);
    params.radius = CROWD_RADIUS;
    params.height = CROWD_HEIGHT;
    params.maxAcceleration = CROWD_ACCELERATION;
    params.maxSpeed = CROWD_SPEED;
    params.collisionQueryRange = CROWD_RADIUS * 12.0f;
    params.pathOptimizationRange = CROWD_RADIUS * 30.0f;
    params.separationWeight = 2.0f;
    params.obstacleAvoidanceType = 3;
    params.updateFlags = DT_CROWD_ANTICIPATE_TURNS | DT_CROWD_OPTIMIZE_VIS | DT_CROWD_OPTIMIZE_TOPO |
                         DT_CROWD_OBSTACLE_AVOIDANCE | DT_CROWD_SEPARATION;
    for (size_t i = 0; i < s.starts.size(); i++) {
        const int index = crowd->addAgent(&s.starts[i].point.x, &params);
        crowd->requestMoveTarget(index, s.goal_refs[i], &s.goals[i].point.x);
    }
    std::vector<crowd_body> now(s.starts.size()), before;
    while (!f.is_over(s)) {
        const double begin = bench_thread_seconds();
        crowd->update(CROWD_DT, nullptr);
        f.seconds += bench_thread_seconds() - begin;
        before = now;
        for (size_t i = 0; i < now.size(); i++) {
            const dtCrowdAgent *agent = crowd->getAgent((int)i);
            float on[3] = { 0, 0, 0 };
            bool over = false;
            s.level.query->closestPointOnPoly(agent->corridor.getFirstPoly(), agent->npos, on, &over);
            now[i] = { agent->npos[0], agent->npos[1],
                       agent->npos[2], agent->vel[0],
                       agent->vel[2],  std::hypot(on[0] - agent->npos[0], on[2] - agent->npos[2]) > 1e-3f };
        }
        f.add(s, now, before.empty() ? now : before);
    }
    dtFreeCrowd(crowd);
    return f;
}

double microseconds(const crowd_figures &f)
{
    return f.agent_steps > 0 ? 1e6 * f.seconds / (double)f.agent_steps : 0.0;
}

void print(const crowd_scene &s, const char *who, const crowd_figures &f)
{
    const size_t count = s.starts.size();
    std::printf("%-20s %6zu %-7s %7.2f %9.2f %7.3f %8llu %6llu %8.4f %6u", s.name, count, who, microseconds(f),
                1000.0 * (double)f.overlaps / (double)f.agent_steps, (double)f.deepest, (unsigned long long)f.off_mesh,
                (unsigned long long)f.in_walls, f.turn / (double)f.agent_steps, f.arrived);
    if (f.arrived == count) {
        std::printf("  %.1f s\n", (double)f.last());
    } else {
        std::printf("  not all after %.0f s\n", (double)f.time);
    }
    std::fflush(stdout);
}

void run_scene(bench_report *report, const crowd_scene &s, bool with_detour, bool is_judged)
{
    const crowd_figures talus = run_talus(s);
    print(s, "talus", talus);
    bench_report_point(report, s.name, "talus", (double)s.starts.size(), microseconds(talus));
    bench_report_at_most(report, (std::string(s.name) + ": agents off the mesh").c_str(), (double)talus.off_mesh, 0.0);
    if (is_judged) {
        bench_report_at_least(report, (std::string(s.name) + ": agents that arrive").c_str(), talus.arrived,
                              (double)s.starts.size());
    }
    if (with_detour) {
        const crowd_figures detour = run_detour(s);
        print(s, "Detour", detour);
        bench_report_point(report, s.name, "DetourCrowd", (double)s.starts.size(), microseconds(detour));
        bench_report_speed(
            report, (std::string(s.name) + ", " + std::to_string(s.starts.size()) + " agents").c_str(), "DetourCrowd",
            detour.seconds / (double)detour.agent_steps * (double)talus.agent_steps / talus.seconds, 1.0);
    }
}

// The same steps by one thread and by two.
void run_on_two_threads(bench_report *report, const crowd_scene &s)
{
    second_thread second;
    const tl_tasks tasks = second.tasks();
    const crowd_figures one = run_talus(s, nullptr, bench_wall_seconds);
    const crowd_figures two = run_talus(s, &tasks, bench_wall_seconds);
    print(s, "1", one);
    print(s, "2", two);
    bench_report_speed(report, (std::string(s.name) + ", " + std::to_string(s.starts.size()) + " agents").c_str(),
                       "one thread", one.seconds / two.seconds, 1.0);
}

void run_squares(bench_report *report, float seconds, uint32_t most, bool with_detour, bool on_two_threads)
{
    for (const bool pillars : { true, false }) {
        for (const uint32_t count : { 100u, 500u, 2000u, 10000u, 100000u }) {
            crowd_scene s;
            s.name = pillars ? "square with pillars" : "open square";
            s.seconds = seconds;
            if (count > most || !s.square(count, pillars)) {
                continue;
            }
            if (on_two_threads) {
                run_on_two_threads(report, s);
            } else {
                run_scene(report, s, with_detour && count <= 2000, false);
            }
        }
    }
}

void run_scenes(bench_report *report, bool with_detour)
{
    crowd_scene circle, flows, one_way, point, floors;
    circle.name = "circle";
    flows.name = "two flows, 1.5 m";
    one_way.name = "bottleneck, 1.5 m";
    point.name = "one point";
    floors.name = "two floors";
    if (circle.circle(250) && flows.doorway(1.5f, 100, true) && one_way.doorway(1.5f, 200, false) &&
        point.one_point(500) && floors.floors(80)) {
        for (const crowd_scene *s : { &circle, &flows, &one_way, &point, &floors }) {
            run_scene(report, *s, with_detour, true);
        }
    }
}

} // namespace

int main(int argc, char **argv)
{
    uint32_t seconds = 40, most = 2000, scenes = 1, detour = 1, threads = 1;
    const bench_option options[] = { { "seconds", BENCH_COUNT, &seconds, "that are simulated in the squares" },
                                     { "max", BENCH_COUNT, &most, "agents of the largest square; 1: none" },
                                     { "scenes", BENCH_COUNT, &scenes, "1: the scenes too" },
                                     { "detour", BENCH_COUNT, &detour, "1: DetourCrowd too" },
                                     { "threads", BENCH_COUNT, &threads, "2: the squares on one thread and on two" },
                                     { nullptr, BENCH_COUNT, nullptr, nullptr } };
    const char *json = nullptr;
    bench_parse(argc, argv, options, nullptr, &json);
    bench_report *report = bench_report_new("crowd", "us", "agents");
    std::printf("%-20s %6s %-7s %7s %9s %7s %8s %6s %8s %6s\n", "scene", "agents", "who", "us/step", "overlaps",
                "deepest", "off mesh", "walls", "turn", "arrive");
    run_squares(report, (float)seconds, most, detour != 0, threads > 1);
    if (scenes != 0) {
        run_scenes(report, detour != 0);
    }
    bench_report_print_claims(report);
    return bench_report_close(report, json);
}
