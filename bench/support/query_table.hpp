// SPDX-License-Identifier: MIT
//
// What bench_query prints at its end: each kind of query over many levels, as geometric mean and worst
// (query_table.cpp).

#ifndef TALUS_BENCH_QUERY_TABLE_HPP
#define TALUS_BENCH_QUERY_TABLE_HPP

#include "query_options.hpp"
#include "report.h"

/// Measures all rows on every level of the data folder, the built-in samples and the city, and prints them as a table.
void bench_query_table(const query_options &options, bench_report *report);

#endif
