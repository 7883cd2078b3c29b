// SPDX-License-Identifier: MIT
//
// What a benchmark found, as data: points of curves, values of bars, and claims with their limits. The benchmark prints
// its own table; the report is the same figures for machines (JSON) and, by bench_chart, for the eye.

#ifndef TALUS_BENCH_REPORT_H
#define TALUS_BENCH_REPORT_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct bench_report bench_report;

/// A new report of the benchmark `name`; `unit` is that of every y ("ns", "ms", "Mray/s"), `x_label` that of every x of
/// a curve (NULL: there are none). Never NULL: out of memory ends the program. Close it with bench_report_close.
bench_report *bench_report_new(const char *name, const char *unit, const char *x_label);

/// One point of the curve `series` in the chart `chart`. The first series of a chart is the one whose crossings with
/// the others the picture marks. x and y > 0: charts are log-log.
void bench_report_point(bench_report *report, const char *chart, const char *series, double x, double y);

/// One bar: `series` (who) at `label` (on what) in the chart `chart`.
void bench_report_value(bench_report *report, const char *chart, const char *series, const char *label, double y);

/// A claim: `value` is at most (or at least) `limit`. Prints nothing; true when it holds.
bool bench_report_at_most(bench_report *report, const char *claim, double value, double limit);
bool bench_report_at_least(bench_report *report, const char *claim, double value, double limit);

/// The claim that `what` is at least `limit` times as fast as `peer`: every speed is such a ratio.
bool bench_report_speed(bench_report *report, const char *what, const char *peer, double ratio, double limit);

/// Prints the claims as a table: value, limit, "ok" or "short".
void bench_report_print_claims(const bench_report *report);

/// Writes the report to `path` (NULL: nowhere), frees it, and returns the program's exit code: 1 when the file could
/// not be written, else 0. A claim that falls short is a finding, not a failure.
int bench_report_close(bench_report *report, const char *path);

#ifdef __cplusplus
}
#endif

#endif
