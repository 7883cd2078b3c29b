// SPDX-License-Identifier: MIT
//
// talus why: which stage and which setting made a point not walkable, and the value that would make it so.

#include "cli/draw/draw_source.h"
#include "cli/options/parse_value.h"
#include "cli/shared/json_out.h"

#include <talus/nav_audit.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

// What was measured, in words. Empty where the cause says it all.
static void print_measured(const tl_nav_reason *reason)
{
    const double m = (double)reason->measured;
    switch (reason->cause) {
    case TL_NAV_CAUSE_SLOPE:
        printf(" Its slope is %.4g degrees.", m);
        break;
    case TL_NAV_CAUSE_LEDGE:
        if (isfinite(m)) {
            printf(" The drop or stair is %.4g m in voxels.", m);
        }
        break;
    case TL_NAV_CAUSE_CEILING:
        printf(" There are %.4g m.", m);
        break;
    case TL_NAV_CAUSE_RADIUS:
        printf(" The floor keeps %.4g m from them.", m);
        break;
    case TL_NAV_CAUSE_WALL:
        printf(" It is %.4g m away.", m);
        break;
    case TL_NAV_CAUSE_ISLAND:
        printf(" It has %.9g columns.", m);
        break;
    case TL_NAV_CAUSE_NO_FLOOR:
        if (isfinite(m)) {
            printf(" The next floor lies %.4g m below.", m);
        }
        break;
    case TL_NAV_CAUSE_OUTSIDE:
        printf(" It is %.4g m.", m);
        break;
    default:
        break;
    }
}

static void print_reason(const tl_nav_reason *reason, bool first)
{
    printf("%s%s (stage %s). %s", first ? "" : "then: ", tl_nav_cause_name(reason->cause), reason->stage,
           tl_nav_cause_text(reason->cause));
    print_measured(reason);
    if (reason->triangle != TL_NO_TRIANGLE) {
        printf(" Triangle %u.", reason->triangle);
    }
    printf("\n");
    if (reason->parameter == NULL) {
        printf("      no setting helps\n");
    } else if (strcmp(reason->parameter, "bounds") == 0) {
        printf("      bounds: %.4g m wider\n", (double)reason->needed);
    } else {
        printf("      %s %.6g -> %.6g\n", reason->parameter, (double)reason->value, (double)reason->needed);
    }
}

// The island that was left out, and what keeps it.
static void print_pruned_island(const tl_nav_reason *reason)
{
    printf("pruned: island of %.4g m2, ", (double)reason->measured);
    if (strcmp(reason->parameter, "min_area") == 0) {
        printf("kept from --island-min-area %.6g (now %.6g)\n", (double)reason->needed, (double)reason->value);
    } else if (strcmp(reason->parameter, "solids") == 0) {
        printf("inside a closed part of the level; kept without --drop-inside-solids\n");
    } else {
        printf("without a point of --reachable-from; kept with one on it\n");
    }
}

static void print_answer(const tl_nav_why_answer *answer)
{
    if (answer->walkable) {
        printf("walkable, at height %.6g\n", (double)answer->floor.y);
        if (answer->apart) {
            printf("      but on an island (connected component) of %.4g m2; no path leads to the largest one, of %.4g "
                   "m2\n",
                   (double)answer->island_area, (double)answer->largest_island_area);
        }
        return;
    }
    if (answer->reason_count > 0 && answer->reasons[0].cause == TL_NAV_CAUSE_PRUNED) {
        print_pruned_island(&answer->reasons[0]);
        return;
    }
    for (uint32_t i = 0; i < answer->reason_count; i++) {
        print_reason(&answer->reasons[i], i == 0);
    }
    if (answer->proven && answer->reasons[0].parameter != NULL) {
        printf("proven: tile %u,%u was baked with %s, and the point is walkable (%u bakes)\n", answer->tile_x,
               answer->tile_z, answer->reason_count == 1 ? "it" : "all of them", answer->bake_count);
    }
}

static json_t *reason_json(const tl_nav_reason *reason)
{
    json_t *object = json_pack("{ss ss ss}", "cause", tl_nav_cause_name(reason->cause), "stage", reason->stage, "text",
                               tl_nav_cause_text(reason->cause));
    if (object != NULL && reason->parameter != NULL) {
        json_object_set_new(object, "parameter", json_string(reason->parameter));
        json_object_set_new(object, "value", tl_json_float(reason->value));
        json_object_set_new(object, "needed", tl_json_float(reason->needed));
    }
    if (object != NULL && reason->triangle != TL_NO_TRIANGLE) {
        json_object_set_new(object, "triangle", json_integer((json_int_t)reason->triangle));
    }
    if (object != NULL) {
        json_object_set_new(object, "measured", tl_json_float(reason->measured));
    }
    return object;
}

static json_t *answer_json(const tl_cli *cli, const tl_nav_why_answer *answer)
{
    json_t *reasons = json_array();
    for (uint32_t i = 0; i < answer->reason_count; i++) {
        json_array_append_new(reasons, reason_json(&answer->reasons[i]));
    }
    return json_pack(
        "{so sb so so sb so sI sb so so}", "file", tl_json_text(cli->arguments.words[0]), "walkable",
        (int)answer->walkable, "floor", tl_json_placed(cli->frame, answer->floor), "reasons", reasons, "proven",
        (int)answer->proven, "tile", json_pack("[II]", (json_int_t)answer->tile_x, (json_int_t)answer->tile_z),
        "builds", (json_int_t)answer->bake_count, "apart", (int)answer->apart, "island_area",
        tl_json_float(answer->island_area), "largest_island_area", tl_json_float(answer->largest_island_area));
}

static tl_exit explain_point(draw_source *source, tl_vec3 point)
{
    tl_cli *cli = source->cli;
    tl_exit code = TL_EXIT_OK;
    if (source->is_bare) {
        return tl_cli_fail(cli, TL_EXIT_DATA, "%s: holds no triangles; bake it without --no-soup", source->input.path);
    }
    if (!draw_need_navmesh(source, &code)) {
        return code;
    }
    const tl_nav_input input = tl_level_areas_input(&source->areas, &source->mesh);
    tl_nav_def def = source->nav_def;
    def.host = cli->host;
    tl_nav_why_answer answer;
    tl_report report;
    memset(&report, 0, sizeof report);
    tl_result result = tl_nav_why(&def, &input, source->input.navmesh, &source->pruning, point, &answer, &report);
    tl_progress_end(&cli->progress);
    if (result != TL_OK) {
        return tl_cli_fail_result(cli, source->input.path, result, &report);
    }
    for (uint32_t i = 0; i < answer.reason_count; i++) {
        answer.reasons[i].triangle = draw_mesh_triangle(source, answer.reasons[i].triangle);
    }
    if (cli->json) {
        code = tl_cli_print_json(cli, answer_json(cli, &answer));
    } else {
        print_answer(&answer);
    }
    return code == TL_EXIT_OK && !answer.walkable ? TL_EXIT_NEGATIVE : code;
}

static tl_exit run_why(tl_cli *cli)
{
    tl_bake_settings settings = tl_default_bake_settings();
    cli->speaks_frame = true;
    tl_exit code;
    float n[3] = { 0 };
    if (!tl_input_parse(cli, NULL, TL_INPUT_NAVMESH, &settings, 2, 2, &code) ||
        !tl_cli_read_triple(cli, 1, "point", n, &code)) {
        return code;
    }
    draw_source source;
    if (draw_source_open(cli, cli->arguments.words[0], &settings, 0, &source, &code)) {
        double exact[3];
        tl_vec3 point = tl_vec3_make(n[0], n[1], n[2]);
        if (cli->frame != NULL && tl_parse_double_triple(cli->arguments.words[1], exact) == NULL) {
            point = tl_pack_place_in(cli->frame, exact);
        }
        code = explain_point(&source, point);
    }
    draw_source_close(&source);
    return code;
}

const tl_command tl_why_command = {
    "why",
    "Navmesh",
    "explain why a point is not walkable",
    "FILE X,Y,Z [options]",
    "Bakes the tile around a point again, stage by stage, and names the first stage that removes the point,\n"
    "the setting to blame, and the nearest value of it that would keep the point; then what else stands in\n"
    "the way. Each value is proven: the tile is baked with it. FILE is a baked file, or a level. A point\n"
    "that is not walkable exits with 1.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus why courtyard.talus 20,6,20\n"
    "talus why courtyard.obj 20,6,20 --agent-radius 0.3 --json\n"
    "talus why courtyard.talus 0.5,0.2,20  # exits with 1",
    run_why,
};
