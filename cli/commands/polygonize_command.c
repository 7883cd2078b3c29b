// SPDX-License-Identifier: MIT
//
// talus polygonize: contour sets in, meshes of convex polygons out, set by set.

#include "cli/level/polygonize_compare.h"
#include "cli/shared/command.h"
#include "cli/shared/json_out.h"
#include "io/files/atomic_write.h"
#include "io/files/file_map.h"
#include "io/text/contour_text.h"
#include "io/text/polygon_text_write.h"

#include <stdio.h>
#include <string.h>

// Repaired contours named one by one on standard error; the JSON report has them all.
enum { MAX_WARNINGS = 8 };

typedef struct job {
    tl_cli *cli;
    const char *input;
    const char *output; // NULL: none
    tl_polygon_def def;
    bool has_cap; // --max-verts was given
    bool check, compare;
    tl_atomic_file *file;
    tl_io_error error;
    json_t *sets; // NULL without --json
    uint32_t set_count, warnings, faulty_sets;
    uint64_t contours, polygons, vertices, links, repaired, refused;
    double seconds;
} job;

static tl_result write_mesh_text(const char *bytes, size_t size, void *user)
{
    job *j = user;
    return tl_atomic_file_write(j->file, bytes, size, &j->error);
}

static const char *fault_name(uint32_t bit)
{
    switch (bit) {
    case TL_CONTOUR_FAULT_EMPTY:
        return "empty";
    case TL_CONTOUR_FAULT_DUPLICATE:
        return "duplicate vertex";
    case TL_CONTOUR_FAULT_SPIKE:
        return "spike";
    case TL_CONTOUR_FAULT_TOUCH:
        return "touches itself";
    case TL_CONTOUR_FAULT_CROSSING:
        return "crosses itself";
    case TL_CONTOUR_FAULT_WINDING:
        return "winds backwards or more than once";
    case TL_CONTOUR_FAULT_PINCH:
        return "falls apart in a vertex";
    default:
        return "refused";
    }
}

static void list_faults(uint32_t faults, char *text, size_t capacity)
{
    size_t length = 0;
    text[0] = '\0';
    for (uint32_t bit = 1; bit <= TL_CONTOUR_FAULT_REFUSED && length < capacity; bit <<= 1) {
        if (faults & bit) {
            int added = snprintf(text + length, capacity - length, "%s%s", length > 0 ? ", " : "", fault_name(bit));
            length += added > 0 ? (size_t)added : 0;
        }
    }
}

static json_t *notes_as_json(const tl_polygon_mesh *mesh)
{
    json_t *array = json_array();
    for (uint32_t i = 0; i < mesh->note_count; i++) {
        const tl_contour_note *note = &mesh->notes[i];
        json_t *faults = json_array();
        for (uint32_t bit = 1; bit <= TL_CONTOUR_FAULT_REFUSED; bit <<= 1) {
            if (note->faults & bit) {
                json_array_append_new(faults, json_string(fault_name(bit)));
            }
        }
        json_array_append_new(array, json_pack("{s:I, s:I, s:o, s:f, s:f}", "contour", (json_int_t)note->contour,
                                               "vertex", (json_int_t)note->vertex, "faults", faults, "area_cells",
                                               (double)note->contour_area2 * 0.5, "covered_cells",
                                               (double)note->covered_area2 * 0.5));
    }
    return array;
}

static void report_set(job *j, const char *name, const tl_polygon_mesh *mesh, const tl_polygon_report *report,
                       double seconds, const char *verdict)
{
    for (uint32_t i = 0; i < mesh->note_count; i++) {
        const tl_contour_note *note = &mesh->notes[i];
        if ((note->faults & TL_CONTOUR_FAULT_EMPTY) == 0 && j->warnings++ < MAX_WARNINGS) {
            char faults[256];
            list_faults(note->faults, faults, sizeof faults);
            tl_cli_warn(j->cli, "%s: set '%s', contour %u, vertex %u: %s; covered %.1f of %.1f cells", j->input, name,
                        note->contour, note->vertex, faults, (double)note->covered_area2 * 0.5,
                        (double)note->contour_area2 * 0.5);
        }
    }
    if (j->sets != NULL) {
        json_array_append_new(
            j->sets,
            json_pack(
                "{s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:o, s:s, s:I}",
                "name", name, "contours", (json_int_t)report->contour_count, "empty_contours",
                (json_int_t)report->empty_contours, "repaired_contours", (json_int_t)report->repaired_contours,
                "refused_contours", (json_int_t)report->refused_contours, "triangles",
                (json_int_t)report->triangle_count, "lower_bound", (json_int_t)report->lower_bound, "polygons",
                (json_int_t)report->polygon_count, "vertices", (json_int_t)report->vertex_count, "links",
                (json_int_t)report->link_count, "portals", (json_int_t)report->portal_count, "non_manifold_edges",
                (json_int_t)report->non_manifold_edges, "straight_vertices_removed",
                (json_int_t)report->removed_straight_vertices, "contour_merges", (json_int_t)report->contour_merges,
                "border_vertices_removed", (json_int_t)report->removed_border_vertices, "border_vertices_kept",
                (json_int_t)report->kept_border_vertices, "seconds", tl_json_double(seconds), "notes",
                notes_as_json(mesh), "check", verdict, "peak_bytes", (json_int_t)report->base.peak_bytes));
    }
    j->set_count++;
    j->contours += report->contour_count;
    j->polygons += report->polygon_count;
    j->vertices += report->vertex_count;
    j->links += report->link_count;
    j->repaired += report->repaired_contours;
    j->refused += report->refused_contours;
    j->seconds += seconds;
}

// "ok", the first fault, or "not asked for".
static const char *check_set(job *j, const char *name, const tl_contour_set *set, const tl_polygon_mesh *mesh,
                             tl_exit *code)
{
    if (!j->check) {
        return "not asked for";
    }
    tl_polygon_check_report report;
    tl_result result = tl_polygon_mesh_check(mesh, set, NULL, &report);
    if (result == TL_OK) {
        return "ok";
    }
    if (result != TL_ERR_CORRUPT) {
        *code = tl_cli_fail_result(j->cli, j->input, result, &report.base);
        return tl_result_text(result);
    }
    j->faulty_sets++;
    tl_cli_warn(j->cli, "%s: set '%s', %s %llu: %s", j->input, name, report.base.element,
                (unsigned long long)report.base.element_index, tl_polygon_fault_text(report.first_fault));
    return tl_polygon_fault_text(report.first_fault);
}

static tl_exit run_set(job *j, const tl_contour_text *text)
{
    tl_polygon_def def = j->def;
    if (!j->has_cap && text->max_verts_per_poly >= 3 && text->max_verts_per_poly <= 64) {
        def.max_verts_per_poly = text->max_verts_per_poly;
    }
    if (j->compare) {
        bool is_right = true;
        tl_exit compared = tl_polygonize_compare(j->cli, j->input, text, &def, j->check, j->sets, &is_right);
        j->faulty_sets += !is_right;
        return compared;
    }
    tl_polygon_mesh mesh;
    tl_polygon_report report;
    double began = tl_clock_seconds();
    tl_result result = tl_polygon_mesh_bake(&text->set, &def, &mesh, &report);
    double seconds = tl_clock_seconds() - began;
    if (result != TL_OK) {
        return tl_cli_fail_result(j->cli, j->input, result, &report.base);
    }
    tl_exit code = TL_EXIT_OK;
    char producer[32];
    snprintf(producer, sizeof producer, "talus-%s", tl_version());
    const char *verdict = check_set(j, text->name, &text->set, &mesh, &code);
    if (code == TL_EXIT_OK && j->file != NULL &&
        tl_polygon_text_write(&mesh, text->name, producer, report.refused_contours, seconds * 1e6, write_mesh_text,
                              j) != TL_OK) {
        code = tl_cli_fail_io(j->cli, &j->error);
    }
    if (code == TL_EXIT_OK) {
        report_set(j, text->name, &mesh, &report, seconds, verdict);
    }
    tl_polygon_mesh_free(&mesh);
    return code;
}

static tl_exit run_sets(job *j, const tl_file_map *map)
{
    tl_text_reader reader;
    memset(&reader, 0, sizeof reader);
    reader.bytes = map->bytes;
    reader.size = map->size;
    reader.path = j->input;
    tl_exit code = TL_EXIT_OK;
    do {
        tl_contour_text text;
        if (tl_contour_text_read(&reader, &text, &j->error) != TL_OK) {
            return tl_cli_fail_io(j->cli, &j->error);
        }
        code = run_set(j, &text);
        tl_contour_text_free(&text);
    } while (code == TL_EXIT_OK && !tl_text_reader_at_end(&reader));
    return code;
}

static tl_exit print_polygonize_report(job *j)
{
    if (j->warnings > MAX_WARNINGS) {
        tl_cli_warn(j->cli, "%s: %u more contours were repaired; --json names them all", j->input,
                    j->warnings - MAX_WARNINGS);
    }
    tl_exit code = j->faulty_sets > 0 ? TL_EXIT_NEGATIVE : TL_EXIT_OK;
    if (j->cli->json) {
        json_t *object = json_pack("{s:o, s:O, s:o}", "file", tl_json_text(j->input), "sets", j->sets, "seconds",
                                   tl_json_double(j->seconds));
        const tl_exit printed = tl_cli_print_json(j->cli, object);
        return printed == TL_EXIT_OK ? code : printed;
    }
    if (j->output != NULL && strcmp(j->output, "-") != 0) {
        printf("%s: %u sets, %llu contours, %llu polygons, %llu vertices, %llu links, %.2f ms\n", j->output,
               j->set_count, (unsigned long long)j->contours, (unsigned long long)j->polygons,
               (unsigned long long)j->vertices, (unsigned long long)j->links, j->seconds * 1e3);
        if (j->repaired + j->refused > 0) {
            printf("%llu contours repaired, %llu refused\n", (unsigned long long)j->repaired,
                   (unsigned long long)j->refused);
        }
    }
    return code;
}

static tl_exit run_job(job *j)
{
    tl_file_map map;
    if (tl_file_read(j->input, 0, &map, &j->error) != TL_OK) {
        return tl_cli_fail_io(j->cli, &j->error);
    }
    tl_exit code = TL_EXIT_OK;
    if (j->output != NULL && tl_atomic_file_open(j->output, &j->file, &j->error) != TL_OK) {
        code = tl_cli_fail_io(j->cli, &j->error);
    }
    if (code == TL_EXIT_OK) {
        code = run_sets(j, &map);
    }
    tl_file_map_close(&map);
    if (code == TL_EXIT_OK && j->file != NULL) {
        tl_atomic_file *file = j->file;
        j->file = NULL;
        code = tl_atomic_file_commit(file, &j->error) == TL_OK ? TL_EXIT_OK : tl_cli_fail_io(j->cli, &j->error);
    }
    tl_atomic_file_abort(j->file);
    return code == TL_EXIT_OK ? print_polygonize_report(j) : code;
}

static tl_exit run_polygonize(tl_cli *cli)
{
    const char *output = NULL;
    int method = 0;
    uint32_t max_verts = 0;
    bool unlimited = false;
    job j;
    memset(&j, 0, sizeof j);
    j.cli = cli;
    j.def = tl_default_polygon_def();
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &output, "FILE",
          "where to write the meshes; - is standard output (the default without --json)", NULL, 0, 0, 0, 0 },
        { "method", 'm', TL_OPTION_CHOICE, &method, "NAME", "how contours are divided", tl_partition_method_names, 0, 0,
          0, 0 },
        { "max-verts", 'n', TL_OPTION_COUNT, &max_verts, "N",
          "most corners of a polygon, 3 to 64 (0: what the set says, else 6)", NULL, 0, 0, 0, 64 },
        { "unlimited", 0, TL_OPTION_FLAG, &unlimited, NULL, "allow polygons of any number of corners", NULL, 0, 0, 0,
          0 },
        { "merge-height", 0, TL_OPTION_COUNT, &j.def.merge_height, "N",
          "lattice units: vertices at one place, no farther apart in height than this, become one", NULL, 0, 0, 0,
          UINT16_MAX },
        { "keep-border-vertices", 0, TL_OPTION_FLAG, &j.def.keep_border_vertices, NULL,
          "keep vertices that a tile's border does not need", NULL, 0, 0, 0, 0 },
        { "drop-straight", 0, TL_OPTION_FLAG, &j.def.drop_straight_vertices, NULL,
          "remove vertices of straight runs where no other contour has them", NULL, 0, 0, 0, 0 },
        { "merge-contours", 0, TL_OPTION_FLAG, &j.def.merge_contours, NULL,
          "merge polygons across contours of one region and area", NULL, 0, 0, 0, 0 },
        { "check", 'c', TL_OPTION_FLAG, &j.check, NULL, "verify the result; exits with 1 when it is wrong", NULL, 0, 0,
          0, 0 },
        { "compare", 0, TL_OPTION_FLAG, &j.compare, NULL,
          "divide by every method and print them side by side; writes no meshes", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    tl_exit code;
    if (!tl_cli_parse(cli, groups, 1, 1, &code)) {
        return code;
    }
    if (max_verts == 1 || max_verts == 2) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--max-verts: a polygon has at least 3 corners; use 3 to 64");
    }
    if (j.compare && output != NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--compare writes no meshes; leave out -o");
    }
    j.input = cli->arguments.words[0];
    j.output = output != NULL || cli->json || j.compare ? output : "-";
    j.def.method = (tl_partition_method)method;
    j.def.max_verts_per_poly = unlimited ? 0 : max_verts != 0 ? max_verts : j.def.max_verts_per_poly;
    j.def.host = cli->host;
    j.has_cap = unlimited || max_verts != 0;
    if (cli->json && output != NULL && strcmp(output, "-") == 0) {
        return tl_cli_fail(cli, TL_EXIT_USAGE,
                           "--json and the meshes cannot both go to standard output; name a file with -o");
    }
    if (cli->json) {
        j.sets = json_array();
    }
    code = run_job(&j);
    json_decref(j.sets);
    return code;
}

const tl_command tl_polygonize_command = {
    "polygonize",
    "Other formats",
    "divide contours into convex polygons",
    "CONTOURS [-o MESH.txt] [--method NAME] [--max-verts N] [--check] [--compare]",
    "Reads contour sets (text, 'navcontours 1'), divides each contour into convex polygons, links neighbours,\n"
    "and writes one mesh ('navpolys 1') for each set, in order. docs/guide/polygons.md describes both formats\n"
    "and the method. Contours that touch or cross themselves are repaired and named.",
    "printf '%s\\n' 'navcontours 1' 'cs 0.3' 'ch 0.2' 'contours 1' 'c 0 1 63 6' '0 0 0 0' '0 0 8 0' '4 0 8 0' '4 0 4 "
    "0' '8 0 4 0' '8 0 0 0' end > contours.txt\n"
    "talus polygonize contours.txt -o mesh.txt --check\n"
    "talus polygonize contours.txt --max-verts 12 --json\n"
    "talus polygonize contours.txt --compare",
    run_polygonize,
};
