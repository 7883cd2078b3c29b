// SPDX-License-Identifier: MIT
//
// What the benchmarks of queries are told.

#ifndef TALUS_BENCH_OPTIONS_HPP
#define TALUS_BENCH_OPTIONS_HPP

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

struct bench_options {
    size_t count = 0;            // of questions a level
    uint32_t city_triangles = 0; // 0: without the city
    int runs = 5;
    std::string only; // levels whose name holds this
    bool prepared_only = false;

    bool wants(const std::string &level) const
    {
        return level.find(only) != std::string::npos && (level != "city" || city_triangles > 0);
    }

    // `count_option` names the option for `count`. False: an option is unknown, and was named.
    bool take(int argc, char **argv, const std::string &count_option)
    {
        for (int i = 1; i + 1 < argc; i += 2) {
            const std::string option = argv[i];
            if (option == "--city") {
                city_triangles = (uint32_t)std::strtoul(argv[i + 1], nullptr, 10);
            } else if (option == count_option) {
                count = std::strtoul(argv[i + 1], nullptr, 10);
            } else if (option == "--runs") {
                runs = std::atoi(argv[i + 1]);
            } else if (option == "--only") {
                only = argv[i + 1];
            } else if (option == "--prepared") {
                prepared_only = std::atoi(argv[i + 1]) != 0;
            } else {
                std::fprintf(stderr, "unknown option %s\n", argv[i]);
                return false;
            }
        }
        return true;
    }
};

#endif
