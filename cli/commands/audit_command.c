// SPDX-License-Identifier: MIT
//
// talus audit: the navmesh held against the triangles.

#include "cli/draw/draw_picture.h"
#include "cli/draw/draw_source.h"
#include "cli/draw/draw_stage.h"
#include "cli/options/output_check.h"
#include "cli/shared/json_out.h"
#include "cli/shared/text_buffer.h"

#include <talus/nav_audit.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct audit_settings {
    tl_bake_settings bake;
    tl_nav_audit_def def;
    uint32_t paths, seed, list;
    float radius, area;
    const char *picture;
    uint32_t size;
} audit_settings;

// Why the first missing floors are missing; each takes some builds of a tile.
enum { MAX_EXPLAINED = 32 };

static const draw_colour FINDING_COLOURS[] = { 0xc0392b, 0xd35400, 0x8e44ad, 0x2471a3 };

// ---- What was found, as text -------------------------------------------------------------------------------

static void print_first_reason(const tl_nav_why_answer *why)
{
    if (why->reason_count > 0) {
        const tl_nav_reason *reason = &why->reasons[0];
        printf("; %s", tl_nav_cause_name(reason->cause));
        if (reason->parameter != NULL) {
            printf(", %s %.4g -> %.4g", reason->parameter, (double)reason->value, (double)reason->needed);
        }
    }
}

static void print_finding(const tl_pack_frame *frame, const tl_nav_finding *f, const tl_nav_why_answer *why)
{
    tl_text point = { NULL, 0, 0, false, frame };
    tl_text_add_point(&point, f->point, ',');
    printf("%-8s  at %.*s", tl_nav_finding_name(f->kind), (int)point.size, point.size > 0 ? point.bytes : "");
    tl_text_free(&point);
    switch (f->kind) {
    case TL_NAV_FINDING_BLOCKED:
        printf("  %.2f m deep in triangle %u", (double)f->depth, f->triangle);
        break;
    case TL_NAV_FINDING_STEP:
        printf("  %.2f m high", (double)f->depth);
        break;
    case TL_NAV_FINDING_NO_FLOOR:
        printf("  %.2f m to fall", (double)f->depth);
        break;
    case TL_NAV_FINDING_MISSING:
        printf("  %.2f m2", (double)f->area);
        break;
    }
    printf(", %u place%s", f->count, f->count == 1 ? "" : "s");
    if (why != NULL) {
        print_first_reason(why);
    }
    printf("\n");
}

static void print_audit_summary(const tl_nav_audit *audit, uint32_t listed)
{
    if (listed < audit->finding_count) {
        printf("... and %u more; --list %u prints all\n", audit->finding_count - listed, audit->finding_count);
    }
    const tl_nav_probe *p = &audit->probe;
    printf("%s%llu paths (%.0f m), %llu polygons, %llu portals: %llu sweeps of a capsule, radius %.3g m, from %.3g to "
           "%.3g m above the floor\n",
           audit->finding_count > 0 ? "\n" : "", (unsigned long long)audit->path_count, audit->path_metres,
           (unsigned long long)audit->polygon_count, (unsigned long long)audit->portal_count,
           (unsigned long long)audit->step_count, (double)p->radius, (double)p->step, (double)p->height);
    printf("%llu samples of the floor, %.3g m apart: %.1f m2 missing\n", (unsigned long long)audit->floor_samples,
           (double)audit->sample_spacing, audit->missing_area);
    if (audit->tolerated_count > 0) {
        printf("%llu sweeps touched a triangle beside the outline, no deeper than its simplification may reach "
               "(--edge-max-error)\n",
               (unsigned long long)audit->tolerated_count);
    }
    if (audit->finding_count == 0) {
        printf("the navmesh and the triangles agree\n");
    } else {
        printf("%u findings, %llu places\n", audit->finding_count, (unsigned long long)audit->contradictions);
    }
}

// ---- As JSON -----------------------------------------------------------------------------------------------

static json_t *finding_json(const tl_pack_frame *frame, const tl_nav_finding *f, const tl_nav_why_answer *why)
{
    json_t *object =
        json_pack("{ss so sI so}", "kind", tl_nav_finding_name(f->kind), "point", tl_json_placed(frame, f->point),
                  "places", (json_int_t)f->count, "bounds", tl_json_placed_bounds(frame, f->bounds));
    if (object == NULL) {
        return NULL;
    }
    if (f->triangle != TL_NO_TRIANGLE) {
        json_object_set_new(object, "triangle", json_integer((json_int_t)f->triangle));
    }
    if (f->polygon != TL_NAV_NO_REF) {
        json_object_set_new(object, "polygon", json_integer((json_int_t)f->polygon));
    }
    if (f->kind == TL_NAV_FINDING_MISSING) {
        json_object_set_new(object, "area", tl_json_float(f->area));
    } else {
        json_object_set_new(object, "depth", tl_json_float(f->depth));
        json_object_set_new(object, "contact", tl_json_placed(frame, f->contact));
    }
    if (why != NULL && why->reason_count > 0) {
        const tl_nav_reason *reason = &why->reasons[0];
        json_object_set_new(object, "cause", json_string(tl_nav_cause_name(reason->cause)));
        if (reason->parameter != NULL) {
            json_object_set_new(object, "parameter", json_string(reason->parameter));
            json_object_set_new(object, "needed", tl_json_float(reason->needed));
        }
    }
    return object;
}

static json_t *audit_json(tl_cli *cli, const tl_nav_audit *audit, const tl_nav_why_answer *whys, uint32_t why_count,
                          uint32_t first_missing)
{
    json_t *list = json_array(), *times = json_object();
    for (uint32_t i = 0; i < audit->finding_count; i++) {
        const bool explained = i >= first_missing && i - first_missing < why_count;
        json_array_append_new(
            list, finding_json(cli->frame, &audit->findings[i], explained ? &whys[i - first_missing] : NULL));
    }
    for (uint32_t i = 0; i < cli->progress.time_count; i++) {
        json_object_set_new(times, cli->progress.times[i].stage, json_real(cli->progress.times[i].seconds));
    }
    const tl_nav_probe *p = &audit->probe;
    json_t *probe =
        json_pack("{so so so so so}", "radius", tl_json_float(p->radius), "step", tl_json_float(p->step), "height",
                  tl_json_float(p->height), "surface", tl_json_float(p->surface), "gap", tl_json_float(p->gap));
    return json_pack("{so sb sI so sI sf sI sI sI sI sI sI so sf so so}", "file", tl_json_text(cli->arguments.words[0]),
                     "clean", (int)(audit->finding_count == 0), "finding_count", (json_int_t)audit->finding_count,
                     "probe", probe, "paths", (json_int_t)audit->path_count, "path_metres", audit->path_metres,
                     "polygons", (json_int_t)audit->polygon_count, "portals", (json_int_t)audit->portal_count, "sweeps",
                     (json_int_t)audit->step_count, "tolerated", (json_int_t)audit->tolerated_count, "places",
                     (json_int_t)audit->contradictions, "floor_samples", (json_int_t)audit->floor_samples,
                     "sample_spacing", tl_json_float(audit->sample_spacing), "missing_area", audit->missing_area,
                     "seconds", times, "findings", list);
}

// ---- As a picture ------------------------------------------------------------------------------------------

static void add_marks(draw_scene *scene, const tl_nav_audit *audit)
{
    uint32_t counts[4] = { 0, 0, 0, 0 };
    for (uint32_t i = audit->finding_count; i-- > 0;) {
        const tl_nav_finding *f = &audit->findings[i];
        counts[f->kind]++;
        draw_add_box(scene, f->bounds, FINDING_COLOURS[f->kind], 1.2f, 0.8f);
        draw_add_dot(scene, f->point, FINDING_COLOURS[f->kind], 5.0f);
    }
    for (int kind = 0; kind < 4; kind++) {
        char text[48];
        snprintf(text, sizeof text, "%s: %u", tl_nav_finding_name((tl_nav_finding_kind)kind), counts[kind]);
        if (counts[kind] > 0) {
            draw_add_legend(scene, FINDING_COLOURS[kind], text);
        }
    }
    const size_t used = strlen(scene->subtitle);
    snprintf(scene->subtitle + used, sizeof scene->subtitle - used, "; %u findings of the audit", audit->finding_count);
}

static bool draw_findings(draw_source *source, const audit_settings *settings, const tl_nav_audit *audit,
                          tl_exit *exit_out)
{
    draw_scene scene;
    draw_picture_begin(source, "audit", &scene);
    draw_stage_navmesh(&scene, source->input.navmesh);
    add_marks(&scene, audit);
    return draw_picture_end(source, &scene, settings->size, settings->picture, exit_out);
}

// ---- The command -------------------------------------------------------------------------------------------

static tl_exit explain_missing(draw_source *source, const tl_nav_audit *audit, uint32_t first, tl_nav_why_answer *whys,
                               uint32_t *count)
{
    const tl_nav_input input = tl_level_areas_input(&source->areas, &source->mesh);
    tl_nav_def def = source->nav_def;
    def.host.allocator = source->cli->host.allocator;
    *count = 0;
    for (uint32_t i = first; i < audit->finding_count && *count < MAX_EXPLAINED; i++) {
        tl_report report;
        memset(&report, 0, sizeof report);
        tl_result result = tl_nav_why(&def, &input, source->input.navmesh, &source->pruning, audit->findings[i].point,
                                      &whys[*count], &report);
        if (result != TL_OK) {
            return tl_cli_fail_result(source->cli, source->input.path, result, &report);
        }
        ++*count;
    }
    return TL_EXIT_OK;
}

static tl_exit report_audit(draw_source *source, const audit_settings *settings, const tl_nav_audit *audit)
{
    tl_nav_why_answer *whys = calloc(MAX_EXPLAINED, sizeof *whys);
    if (whys == NULL) {
        return tl_cli_fail(source->cli, TL_EXIT_MEMORY, "out of memory");
    }
    uint32_t first = 0, count;
    while (first < audit->finding_count && audit->findings[first].kind != TL_NAV_FINDING_MISSING) {
        first++;
    }
    tl_exit code = explain_missing(source, audit, first, whys, &count);
    tl_progress_end(&source->cli->progress);
    if (code == TL_EXIT_OK && source->cli->json) {
        code = tl_cli_print_json(source->cli, audit_json(source->cli, audit, whys, count, first));
    } else if (code == TL_EXIT_OK) {
        const uint32_t listed = audit->finding_count < settings->list ? audit->finding_count : settings->list;
        for (uint32_t i = 0; i < listed; i++) {
            print_finding(source->cli->frame, &audit->findings[i],
                          i >= first && i - first < count ? &whys[i - first] : NULL);
        }
        print_audit_summary(audit, listed);
    }
    free(whys);
    return code;
}

static tl_exit audit_source(draw_source *source, audit_settings *settings)
{
    tl_exit code = TL_EXIT_OK;
    if (source->is_bare) {
        return tl_cli_fail(source->cli, TL_EXIT_DATA, "%s: holds no triangles; bake it without --no-soup",
                           source->input.path);
    }
    if (!draw_need_soup(source, &code) || !draw_need_walkable(source, &code)) {
        return code;
    }
    const tl_nav_input input = tl_level_areas_input(&source->areas, &source->mesh);
    settings->def.areas = source->soup_areas != NULL ? source->soup_areas : input.areas;
    settings->def.volumes = input.volumes;
    settings->def.volume_count = input.volume_count;
    settings->def.pruned = source->pruned;
    settings->def.nav = source->nav_def;
    settings->def.path_count = settings->paths;
    settings->def.seed = settings->seed;
    settings->def.probe_radius = settings->radius;
    settings->def.min_missing_area = settings->area;
    settings->def.host = source->cli->host;
    tl_nav_audit audit;
    tl_report failure;
    memset(&failure, 0, sizeof failure);
    tl_result result = tl_nav_audit_run(&settings->def, source->input.navmesh, source->soup, &audit, &failure);
    if (result != TL_OK) {
        return tl_cli_fail_result(source->cli, source->input.path, result, &failure);
    }
    for (uint32_t i = 0; i < audit.finding_count; i++) {
        audit.findings[i].triangle = draw_soup_triangle(source, audit.findings[i].triangle);
    }
    code = report_audit(source, settings, &audit);
    if (code == TL_EXIT_OK && settings->picture != NULL) {
        draw_findings(source, settings, &audit, &code);
    }
    code = code == TL_EXIT_OK && audit.finding_count > 0 ? TL_EXIT_NEGATIVE : code;
    tl_nav_audit_free(&audit);
    return code;
}

static tl_exit run_audit_command(tl_cli *cli)
{
    audit_settings settings;
    memset(&settings, 0, sizeof settings);
    settings.bake = tl_default_bake_settings();
    settings.def = tl_default_nav_audit_def();
    settings.paths = settings.def.path_count;
    settings.seed = (uint32_t)settings.def.seed;
    settings.radius = settings.area = -1.0f;
    settings.list = 20;
    settings.size = 900;
    const tl_option options[] = {
        { "paths", 'n', TL_OPTION_COUNT, &settings.paths, "N", "random paths to walk", NULL, 0, 0, 0, 0 },
        { "seed", 0, TL_OPTION_COUNT, &settings.seed, "N", "seed of the random paths", NULL, 0, 0, 0, 0 },
        { "probe-radius", 0, TL_OPTION_FLOAT, &settings.radius, "M",
          "metres: radius of the capsule (-1: the agent's, less what voxels and contours may cost)", NULL, -1, 1e6f, 0,
          0 },
        { "min-area", 0, TL_OPTION_FLOAT, &settings.area, "M2",
          "square metres: ignore missing floors smaller than this (-1: than 8 columns beside navmesh, and the smallest "
          "island "
          "kept apart from it)",
          NULL, -1, 1e12f, 0, 0 },
        { "list", 0, TL_OPTION_COUNT, &settings.list, "N", "findings to print; --json has all", NULL, 0, 0, 0, 0 },
        { "draw", 0, TL_OPTION_OUTPUT, &settings.picture, "FILE",
          "draw a picture with the findings marked: .png or .svg", tl_picture_endings, 0, 0, 0, 0 },
        { "size", 0, TL_OPTION_COUNT, &settings.size, "PIXELS", "of the picture: longer side of each view", NULL, 0, 0,
          200, 8000 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    if (!tl_input_parse(cli, groups, TL_INPUT_NAVMESH, &settings.bake, 1, 1, &code)) {
        return code;
    }
    draw_source source;
    if (draw_source_open(cli, cli->arguments.words[0], &settings.bake, 0, &source, &code)) {
        code = audit_source(&source, &settings);
    }
    draw_source_close(&source);
    return code;
}

const tl_command tl_audit_command = {
    "audit",
    "Navmesh",
    "compare a navmesh with the triangles",
    "FILE [options]",
    "Walks a capsule through the triangles wherever the navmesh says that an agent may go: around every\n"
    "polygon, through every portal, along random shortest paths. Then looks for floor that has room for the\n"
    "agent and no navmesh. Prints every place where the two disagree, and exits with 1 when there is one.\n"
    "FILE is a baked file, or a level, which is then baked in memory. docs/guide/audit.md says what is\n"
    "promised and what is tolerated.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus audit courtyard.talus --paths 100\n"
    "talus audit courtyard.obj --paths 100 --draw audit.png --size 400\n"
    "talus audit courtyard.talus --paths 100 --json > audit.json",
    run_audit_command,
};
