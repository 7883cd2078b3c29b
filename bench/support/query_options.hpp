// SPDX-License-Identifier: MIT
//
// The options that the benchmarks of navmesh queries share.

#ifndef TALUS_BENCH_QUERY_OPTIONS_HPP
#define TALUS_BENCH_QUERY_OPTIONS_HPP

#include "bench_options.h"

#include <cstdint>
#include <string>

struct query_options {
    uint32_t count = 0;          // questions a level
    uint32_t city_triangles = 0; // 0: without the city
    uint32_t runs = 5;
    const char *only = "";      // levels whose name holds this
    uint32_t prepared_only = 0; // 1: searches on prepared navmeshes alone
    uint32_t table_only = 0;    // 1: only the table over all levels

    bool wants(const std::string &level) const
    {
        return level.find(only) != std::string::npos && (level != "city" || city_triangles > 0);
    }

    // `count_name` names the option for `count`. Returns the report's path, or nullptr.
    const char *parse(int argc, char **argv, const char *count_name)
    {
        const bench_option options[] = { { count_name, BENCH_COUNT, &count, "questions a level" },
                                         { "city", BENCH_COUNT, &city_triangles, "triangles of the city; 0: none" },
                                         { "runs", BENCH_COUNT, &runs, "runs of which the best counts" },
                                         { "only", BENCH_TEXT, &only, "levels whose name holds this" },
                                         { "prepared", BENCH_COUNT, &prepared_only, "1: prepared navmeshes alone" },
                                         { "table", BENCH_COUNT, &table_only, "1: the table over all levels alone" },
                                         { nullptr, BENCH_COUNT, nullptr, nullptr } };
        const char *json = nullptr;
        bench_parse(argc, argv, options, nullptr, &json);
        return json;
    }
};

#endif
