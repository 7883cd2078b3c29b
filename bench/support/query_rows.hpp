// SPDX-License-Identifier: MIT
//
// The rows of the table over many levels (query_table.cpp): what each is called and held to, and how it is printed.

#ifndef TALUS_BENCH_QUERY_ROWS_HPP
#define TALUS_BENCH_QUERY_ROWS_HPP

#include "report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace
{

// What a path may be longer than the shortest by.
constexpr unsigned SLACK_KINDS = 4;
const float SLACKS[SLACK_KINDS] = { 0.0f, 0.05f, 0.1f, 0.3f };

enum row {
    ONE_CALL,
    FIRST_SLACK,
    LAST_SLACK = FIRST_SLACK + SLACK_KINDS - 2,
    SLACK_AREA_COST,
    TWO_CALLS,
    AREA_COST,
    UNREACHABLE,
    PREPARED,
    RANDOM_AROUND,
    HEIGHT,
    MESH_MEMORY,
    QUERY_MEMORY,
    AREA_PATH_COST,
    SLACK_AREA_PATH_COST,
    ROWS
};

struct row_name {
    const char *what;
    double bar, worst_bar; // 0: no bar
    bool is_less;          // a share of Detour's, of which less is better
};

const row_name NAMES[ROWS] = { { "polygons and corners, one call", 1.5, 1.0, false },
                               { "one call, slack 0.05", 1.2, 0.0, false },
                               { "one call, slack 0.1", 1.2, 1.0, false },
                               { "one call, slack 0.3", 1.5, 1.0, false },
                               { "areas of different cost, slack 0.1", 1.2, 0.0, false },
                               { "polygons, then corners", 1.2, 0.0, false },
                               { "areas of different cost", 1.2, 0.0, false },
                               { "to the nearest reachable point", 2.0, 0.0, false },
                               { "one call, prepared", 6.0, 0.0, false },
                               { "random point around a place", 1.0, 0.0, false },
                               { "height", 1.0, 0.0, false },
                               { "memory of tiles and table", 1.2, 0.0, true },
                               { "memory of a query", 1.0, 0.0, true },
                               { "cost of paths over areas", 1.0, 0.0, true },
                               { "the same with slack 0.1", 1.0, 0.0, true } };

struct row_value {
    std::string level;
    double ratio;
};

enum group { SOLO, TILED, CITY, GROUPS };
const char *const GROUP_NAMES[GROUPS] = { "one piece", "tiles", "city" };

std::vector<row_value> values[GROUPS][ROWS];

// By how much paths are longer than the shortest, as a share: Detour's, then ours by slack.
struct excess {
    double mean, most;
};
std::vector<excess> excesses[GROUPS][SLACK_KINDS];
void print_row(group in, row which, bench_report *report)
{
    const std::vector<row_value> &list = values[in][which];
    if (list.empty()) {
        return;
    }
    const row_name &name = NAMES[which];
    double sum = 0.0;
    const row_value *worst = &list[0];
    for (const row_value &v : list) {
        sum += std::log(v.ratio);
        worst = (name.is_less ? v.ratio > worst->ratio : v.ratio < worst->ratio) ? &v : worst;
    }
    const double mean = std::exp(sum / (double)list.size());
    const std::string claim = std::string(name.what) + ", " + GROUP_NAMES[in];
    std::printf("  %-32s %-10s %3zu levels: %6.2f   worst %6.2f (%s)\n", name.what, GROUP_NAMES[in], list.size(), mean,
                worst->ratio, worst->level.c_str());
    double bar = name.bar;
    if (in == CITY && (which == ONE_CALL || which == PREPARED)) {
        bar = which == ONE_CALL ? 3.0 : 8.0;
    }
    if (name.is_less) {
        bench_report_at_most(report, claim.c_str(), mean, bar);
    } else {
        bench_report_speed(report, claim.c_str(), "Detour", mean, bar);
    }
    if (name.worst_bar > 0.0) {
        bench_report_speed(report, (claim + ", worst").c_str(), "Detour", worst->ratio, name.worst_bar);
    }
}

void print_excess(group in, unsigned kind)
{
    const std::vector<excess> &list = excesses[in][kind];
    double mean = 0.0, worst_mean = 0.0, most = 0.0;
    for (const excess &e : list) {
        mean += e.mean / (double)list.size();
        worst_mean = std::max(worst_mean, e.mean);
        most = std::max(most, e.most);
    }
    if (!list.empty()) {
        std::printf("  longer than the shortest, %-10s  %-10s %3zu levels: %.2f%% on average   worst level %.2f%%   "
                    "most of a pair %.2f%%\n",
                    kind == 0 ? "Detour" : ("slack " + std::to_string(SLACKS[kind]).substr(0, 4)).c_str(),
                    GROUP_NAMES[in], list.size(), 100.0 * mean, 100.0 * worst_mean, 100.0 * most);
    }
}

} // namespace

#endif
