// SPDX-License-Identifier: MIT
//
// talus polygonize --compare: each method's counts, shapes and time for one contour set.

#include "cli/level/polygonize_compare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *const tl_partition_method_names[] = { "classic", "optimal", "delaunay", NULL };

typedef struct row {
    const char *method;
    tl_polygon_report report;
    tl_polygon_quality quality;
    double seconds;
    const char *verdict; // NULL: not checked
} row;

static double degrees(double cosine)
{
    return acos(cosine > 1.0 ? 1.0 : cosine) * 57.29577951308232;
}

static tl_exit run_method(tl_cli *cli, const char *input, const tl_contour_text *text, const tl_polygon_def *def,
                          bool proven, row *r)
{
    tl_polygon_mesh mesh;
    double began = tl_clock_seconds();
    tl_result result = tl_polygon_mesh_bake(&text->set, def, &mesh, &r->report);
    r->seconds = tl_clock_seconds() - began;
    if (result != TL_OK) {
        return tl_cli_fail_result(cli, input, result, &r->report.base);
    }
    r->quality = tl_polygon_mesh_measure(&mesh);
    if (proven) {
        tl_polygon_check_report check;
        result = tl_polygon_mesh_check(&mesh, &text->set, NULL, &check);
        r->verdict = result == TL_OK            ? "ok"
                     : result == TL_ERR_CORRUPT ? tl_polygon_fault_text(check.first_fault)
                                                : tl_result_text(result);
    }
    tl_polygon_mesh_free(&mesh);
    return TL_EXIT_OK;
}

static json_t *row_as_json(const row *r)
{
    return json_pack("{s:s, s:I, s:I, s:I, s:f, s:I, s:f, s:f, s:f, s:f, s:o, s:s}", "method", r->method, "polygons",
                     (json_int_t)r->report.polygon_count, "lower_bound", (json_int_t)r->report.lower_bound, "vertices",
                     (json_int_t)r->report.vertex_count, "mean_corners", r->quality.mean_corners, "max_corners",
                     (json_int_t)r->quality.max_corners, "smallest_angle_degrees",
                     degrees(r->quality.smallest_angle_cosine), "mean_sharpest_cosine", r->quality.mean_sharpest_cosine,
                     "mean_aspect", r->quality.mean_aspect, "worst_aspect", r->quality.worst_aspect, "seconds",
                     tl_json_double(r->seconds), "check", r->verdict != NULL ? r->verdict : "not asked for");
}

static void print_row(const row *r)
{
    printf("  %-9s %9u %12u %11.2f %15.2f %11.2f %12.1f %9.3f", r->method, r->report.polygon_count,
           r->report.lower_bound, r->quality.mean_corners, degrees(r->quality.smallest_angle_cosine),
           r->quality.mean_aspect, r->quality.worst_aspect, r->seconds * 1e3);
    printf("%s%s\n", r->verdict != NULL ? "  " : "", r->verdict != NULL ? r->verdict : "");
}

tl_exit tl_polygonize_compare(tl_cli *cli, const char *input, const tl_contour_text *text, const tl_polygon_def *def,
                              bool proven, json_t *sets, bool *is_right)
{
    json_t *methods = sets != NULL ? json_array() : NULL;
    if (sets == NULL) {
        printf("%s: %u contours, %u vertices\n", text->name, text->set.contour_count, text->set.vertex_count);
        printf("  %-9s %9s %12s %11s %15s %11s %12s %9s\n", "method", "polygons", "lower bound", "corners",
               "least angle", "aspect", "worst aspect", "ms");
    }
    tl_exit code = TL_EXIT_OK;
    for (int m = 0; tl_partition_method_names[m] != NULL && code == TL_EXIT_OK; m++) {
        tl_polygon_def with_method = *def;
        with_method.method = (tl_partition_method)m;
        row r;
        memset(&r, 0, sizeof r);
        r.method = tl_partition_method_names[m];
        code = run_method(cli, input, text, &with_method, proven, &r);
        if (code != TL_EXIT_OK) {
            break;
        }
        *is_right &= r.verdict == NULL || strcmp(r.verdict, "ok") == 0;
        if (sets != NULL) {
            json_array_append_new(methods, row_as_json(&r));
        } else {
            print_row(&r);
        }
    }
    if (sets != NULL) {
        json_array_append_new(sets, json_pack("{s:s, s:I, s:I, s:o}", "name", text->name, "contours",
                                              (json_int_t)text->set.contour_count, "vertices",
                                              (json_int_t)text->set.vertex_count, "methods", methods));
    }
    return code;
}
