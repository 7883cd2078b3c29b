// SPDX-License-Identifier: MIT
//
// talus hull: the convex hull of points or of a mesh, measured and written.

#include "cli/options/output_check.h"
#include "cli/shapes/open_hull.h"
#include "cli/shared/json_out.h"
#include "io/files/atomic_write.h"
#include "io/mesh/obj_write.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static json_t *hull_json(const tl_hull *hull, uint32_t points, const tl_hull_report *report)
{
    const tl_hull_mass *mass = &hull->mass;
    json_t *object = json_pack("{sI sI sI sI so so s[ooo] so so}", "points", (json_int_t)points, "vertices",
                               (json_int_t)hull->vertex_count, "edges", (json_int_t)(hull->half_edge_count / 2),
                               "faces", (json_int_t)hull->face_count, "volume", tl_json_double(mass->volume), "area",
                               tl_json_double(mass->area), "centroid", tl_json_double(mass->center[0]),
                               tl_json_double(mass->center[1]), tl_json_double(mass->center[2]), "bounds",
                               tl_json_bounds(hull->bounds), "thickened", json_boolean(report->thickened));
    if (report->points_left_out > 0) {
        json_object_set_new(object, "points_left_out", json_integer((json_int_t)report->points_left_out));
    }
    if (report->corners_left_out > 0) {
        json_object_set_new(object, "corners_left_out", json_integer((json_int_t)report->corners_left_out));
    }
    if (report->points_left_out > 0 || report->corners_left_out > 0) {
        json_object_set_new(object, "max_outside", tl_json_double(report->max_outside));
    }
    return object;
}

// Of the two settings that leave points outside. Corners that were merged away count as vertices of the limit.
static bool is_by_tolerance(const tl_hull *hull, const tl_hull_report *report, const tl_hull_settings *settings)
{
    return settings->tolerance > 0.0f &&
           (settings->max_vertices == 0 || hull->vertex_count + report->corners_left_out < settings->max_vertices);
}

static void print_hull(const tl_hull *hull, uint32_t points, const tl_hull_report *report,
                       const tl_hull_settings *settings)
{
    const tl_hull_mass *mass = &hull->mass;
    if (points > 0) {
        printf("points    %u\n", points);
    }
    printf("vertices  %u\nedges     %u\nfaces     %u\n", hull->vertex_count, hull->half_edge_count / 2,
           hull->face_count);
    printf("volume    %.9g\narea      %.9g\ncentroid  %.9g,%.9g,%.9g\n", mass->volume, mass->area, mass->center[0],
           mass->center[1], mass->center[2]);
    if (report->thickened) {
        printf("thickened: the points have no volume of their own\n");
    }
    if (report->points_left_out > 0) {
        printf("%u points lie outside, by %.9g m at most: %s\n", report->points_left_out, report->max_outside,
               is_by_tolerance(hull, report, settings) ? "--tolerance allows it" : "--max-vertices was reached");
    }
    if (report->corners_left_out > 0) {
        printf("%u corners were left out; no point lies more than %.9g m outside\n", report->corners_left_out,
               report->max_outside);
    }
}

// Faces are polygons, in the hull's own order.
static tl_result write_hull_obj(const tl_hull *hull, const char *output, tl_io_error *error)
{
    tl_obj_writer *writer;
    tl_result result = tl_obj_writer_open(output, &writer, error);
    if (result != TL_OK) {
        return result;
    }
    uint32_t *corners = malloc(hull->half_edge_count * sizeof(*corners));
    if (corners == NULL) {
        tl_obj_writer_abort(writer);
        return tl_io_fail(error, TL_ERR_MEMORY, output, 0, NULL, "out of memory");
    }
    tl_obj_writer_object(writer, "hull");
    tl_obj_writer_vertices(writer, tl_hull_vertices(hull), hull->vertex_count);
    for (uint32_t i = 0; i < hull->face_count; ++i) {
        tl_hull_face face = tl_hull_face_at(hull, i);
        for (uint32_t k = 0; k < face.count; ++k) {
            corners[k] = tl_hull_edge_origin(hull, face.first + k);
        }
        tl_obj_writer_face(writer, corners, face.count);
    }
    free(corners);
    return tl_obj_writer_commit(writer, error);
}

static tl_result write_hull_bytes(const void *bytes, size_t size, void *user)
{
    return tl_atomic_file_write(user, bytes, size, NULL);
}

static tl_result write_baked_hull(const tl_hull *hull, const char *output, tl_io_error *error)
{
    tl_atomic_file *file;
    tl_result result = tl_atomic_file_open(output, &file, error);
    if (result != TL_OK) {
        return result;
    }
    tl_pack_item item = { TL_PACK_HULL, 0, hull, hull->blob.size };
    result = tl_pack_write(&item, 1, NULL, write_hull_bytes, file, NULL);
    if (result == TL_ERR_MEMORY) {
        tl_atomic_file_abort(file);
        return tl_io_fail(error, result, output, 0, NULL, "out of memory");
    }
    return tl_atomic_file_commit(file, error); // a failed write makes it fail, and says why
}

static tl_exit hull_of_one(tl_cli *cli, const tl_hull_settings *settings, const char *output)
{
    tl_hull_input input;
    tl_exit code;
    if (tl_hull_open(cli, cli->arguments.words[0], settings, &input, &code)) {
        tl_io_error error;
        memset(&error, 0, sizeof(error));
        code = TL_EXIT_OK;
        if (output != NULL && (tl_has_ending(output, ".talus") ? write_baked_hull(input.hull, output, &error)
                                                               : write_hull_obj(input.hull, output, &error)) != TL_OK) {
            code = tl_cli_fail_io(cli, &error);
        } else if (output != NULL && strcmp(output, "-") == 0) {
            code = TL_EXIT_OK; // the hull itself went to standard output
        } else if (cli->json) {
            json_t *object = hull_json(input.hull, input.points, &input.report);
            if (output != NULL) {
                json_object_set_new(object, "output", tl_json_text(output));
            }
            code = tl_cli_print_json(cli, object);
        } else {
            print_hull(input.hull, input.points, &input.report, settings);
        }
    }
    tl_hull_input_close(&input);
    return code;
}

// One line a cloud; a cloud without volume is told in its line and does not end the run.
static tl_exit print_cloud(tl_cli *cli, const tl_hull_settings *settings, const tl_point_clouds *clouds, uint32_t index)
{
    tl_hull *hull;
    tl_hull_report report;
    tl_point_cloud cloud = tl_point_clouds_get(clouds, index);
    tl_result result = tl_hull_bake_cloud(cli, settings, cloud, &hull, &report);
    bool ok = true;
    if (result == TL_ERR_MEMORY || result == TL_ERR_CANCELLED) {
        return tl_cli_fail_result(cli, cli->arguments.words[0], result, &report.base);
    }
    if (cli->json) {
        json_t *object = result == TL_OK
                             ? hull_json(hull, cloud.count, &report)
                             : json_pack("{sI ss}", "points", (json_int_t)cloud.count, "error", tl_result_text(result));
        json_object_set_new(object, "index", json_integer((json_int_t)index));
        ok = tl_json_print_line(object);
    } else if (result == TL_OK) {
        const tl_hull_mass *mass = &hull->mass;
        printf("%6u %8u %8u %8u %8u %16.9g %16.9g\n", index, cloud.count, hull->vertex_count, hull->half_edge_count / 2,
               hull->face_count, mass->volume, mass->area);
    } else {
        printf("%6u %8u %s\n", index, cloud.count, tl_result_text(result));
    }
    tl_blob_free(hull);
    return ok ? TL_EXIT_OK : TL_EXIT_MEMORY;
}

static tl_exit hulls_of_all(tl_cli *cli, const tl_hull_settings *settings, const tl_point_clouds *clouds)
{
    if (!cli->json) {
        printf("%6s %8s %8s %8s %8s %16s %16s\n", "index", "points", "vertices", "edges", "faces", "volume", "area");
    }
    tl_exit code = TL_EXIT_OK;
    for (uint32_t i = 0; i < clouds->cloud_count && code == TL_EXIT_OK; ++i) {
        code = print_cloud(cli, settings, clouds, i);
    }
    return code;
}

static tl_exit run_hull(tl_cli *cli)
{
    const char *output = NULL;
    bool all = false;
    tl_hull_settings settings = tl_default_hull_settings();
    static const char *const hull_endings[] = { ".obj", ".talus", NULL };
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &output, "FILE",
          "where to write the hull: .obj with polygon faces, or .talus", hull_endings, 0, 0, 0, 0 },
        { "all", 'a', TL_OPTION_FLAG, &all, NULL, "measure every cloud of the file, one a line", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    tl_exit code;
    if (!tl_hull_parse(cli, options, 1, &settings, &code)) {
        return code;
    }
    if (!all) {
        return hull_of_one(cli, &settings, output);
    }
    if (output != NULL || settings.index != UINT32_MAX) {
        return tl_cli_fail(cli, TL_EXIT_USAGE,
                           "--all only measures; without it, --index chooses the cloud and -o writes its hull");
    }
    tl_point_clouds clouds;
    if (tl_read_clouds(cli, cli->arguments.words[0], &settings, &clouds, &code)) {
        code = hulls_of_all(cli, &settings, &clouds);
        tl_point_clouds_free(&clouds);
    }
    return code;
}

const tl_command tl_hull_command = {
    "hull",
    "Convex hulls",
    "bake and measure a convex hull",
    "MESH|POINTS [-o OUT.obj|OUT.talus] [options]",
    "Bakes the convex hull of a mesh's vertices or of points, and prints its counts, volume, area and\n"
    "centroid. POINTS is a text of x y z lines, or of several clouds: a line N, then N lines x y z; then\n"
    "--index chooses one, and --all measures every one. A baked file that holds a hull is measured too.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus hull courtyard.obj -o hull.obj\n"
    "printf '%s\\n' '0 0 0' '2 0 0' '0 2 0' '0 0 2' > points.txt\n"
    "talus hull points.txt -o hull.talus --json\n"
    "printf '%s\\n' 4 '0 0 0' '1 0 0' '0 1 0' '0 0 1' 4 '0 0 0' '2 0 0' '0 2 0' '0 0 2' > clouds.txt\n"
    "talus hull clouds.txt --all\n"
    "talus hull courtyard.obj --merge-distance 0.05",
    run_hull,
};
