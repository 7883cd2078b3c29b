// SPDX-License-Identifier: MIT
//
// What benchmarks measure with: clocks, and quantiles of what was measured.

#ifndef TALUS_BENCH_MEASURE_H
#define TALUS_BENCH_MEASURE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Seconds on the wall.
double bench_wall_seconds(void);
/// Seconds of processor time: of this thread, or of all threads of the program. A busy machine disturbs them less.
double bench_thread_seconds(void);
double bench_process_seconds(void);

/// The value below which a `fraction` of the values lies: 0.5 is the median. Sorts them; count >= 1.
double bench_quantile(double *values, size_t count, double fraction);

#ifdef __cplusplus
}
#endif

#endif
