// SPDX-License-Identifier: MIT

#include "report.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct bench_report {
    json_t *root;
    json_t *charts; // of objects: name, and "curves" or "bars" as lists of rows in the order of arrival
    json_t *claims;
};

static void must(bool done)
{
    if (!done) {
        fprintf(stderr, "out of memory for the report\n");
        exit(1);
    }
}

bench_report *bench_report_new(const char *name, const char *unit, const char *x_label)
{
    bench_report *report = malloc(sizeof *report);
    must(report != NULL);
    report->charts = json_array();
    report->claims = json_array();
    report->root = json_pack("{ssssss*soso}", "benchmark", name, "unit", unit, "x", x_label, "charts", report->charts,
                             "claims", report->claims);
    must(report->root != NULL);
    return report;
}

static json_t *chart_named(bench_report *report, const char *name)
{
    size_t i;
    json_t *chart;
    json_array_foreach(report->charts, i, chart)
    {
        if (strcmp(json_string_value(json_object_get(chart, "name")), name) == 0) {
            return chart;
        }
    }
    chart = json_pack("{sss[]}", "name", name, "rows");
    must(chart != NULL && json_array_append_new(report->charts, chart) == 0);
    return chart;
}

static void add_row(bench_report *report, const char *chart, json_t *row)
{
    must(row != NULL && json_array_append_new(json_object_get(chart_named(report, chart), "rows"), row) == 0);
}

void bench_report_point(bench_report *report, const char *chart, const char *series, double x, double y)
{
    add_row(report, chart, json_pack("{sssfsf}", "series", series, "x", x, "y", y));
}

void bench_report_value(bench_report *report, const char *chart, const char *series, const char *label, double y)
{
    add_row(report, chart, json_pack("{sssssf}", "series", series, "label", label, "y", y));
}

static bool add_claim(bench_report *report, const char *claim, double value, const char *sense, double limit,
                      bool holds)
{
    must(json_array_append_new(report->claims, json_pack("{sssfsssfsb}", "claim", claim, "value", value, "sense", sense,
                                                         "limit", limit, "holds", (int)holds)) == 0);
    return holds;
}

bool bench_report_at_most(bench_report *report, const char *claim, double value, double limit)
{
    return add_claim(report, claim, value, "at most", limit, value <= limit);
}

bool bench_report_at_least(bench_report *report, const char *claim, double value, double limit)
{
    return add_claim(report, claim, value, "at least", limit, value >= limit);
}

bool bench_report_speed(bench_report *report, const char *what, const char *peer, double ratio, double limit)
{
    char claim[256];
    snprintf(claim, sizeof claim, "%s, times as fast as %s", what, peer);
    return bench_report_at_least(report, claim, ratio, limit);
}

void bench_report_print_claims(const bench_report *report)
{
    size_t i;
    json_t *row;
    json_array_foreach(report->claims, i, row)
    {
        printf("  %-64s %9.3f  %-8s %8.3f  %s\n", json_string_value(json_object_get(row, "claim")),
               json_real_value(json_object_get(row, "value")), json_string_value(json_object_get(row, "sense")),
               json_real_value(json_object_get(row, "limit")),
               json_is_true(json_object_get(row, "holds")) ? "ok" : "short");
    }
}

int bench_report_close(bench_report *report, const char *path)
{
    bool written = path == NULL || json_dump_file(report->root, path, JSON_INDENT(1) | JSON_REAL_PRECISION(6)) == 0;
    if (!written) {
        fprintf(stderr, "%s: cannot be written\n", path);
    }
    json_decref(report->root);
    free(report);
    return written ? 0 : 1;
}
