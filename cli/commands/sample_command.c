// SPDX-License-Identifier: MIT
//
// talus sample: a built-in level as an OBJ file.

#include "cli/commands/sample_files.h"
#include "cli/options/output_check.h"
#include "cli/options/same_file.h"
#include "cli/sample/sample_level.h"
#include "cli/shared/command.h"
#include "cli/shared/interrupt.h"
#include "cli/shared/json_out.h"
#include "io/mesh/obj_write.h"

#include <stdio.h>
#include <string.h>

enum { WORLD_TRIANGLES = 1000000 };

static const char world_text[] = "a folder of files for 'talus world': terrain, towns, roads, bridges, caves, any size";

static tl_exit list_levels(tl_cli *cli)
{
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    if (cli->json) {
        json_t *array = json_array();
        for (uint32_t i = 0; i < count; ++i) {
            json_array_append_new(array,
                                  json_pack("{ss ss si}", "name", levels[i].name, "description", levels[i].description,
                                            "triangles", (int)levels[i].default_triangles));
        }
        json_array_append_new(array, json_pack("{ss ss si}", "name", "world", "description", world_text, "triangles",
                                               (int)WORLD_TRIANGLES));
        return tl_cli_print_json(cli, json_pack("{so}", "levels", array));
    }
    for (uint32_t i = 0; i < count; ++i) {
        printf("%-11s %6u triangles  %s\n", levels[i].name, levels[i].default_triangles, levels[i].description);
    }
    printf("%-11s %6u triangles  %s\n", "world", WORLD_TRIANGLES, world_text);
    return TL_EXIT_OK;
}

static tl_aabb bounds_of(const tl_sample_mesh *mesh)
{
    tl_aabb bounds = tl_aabb_empty();
    for (uint32_t i = 0; i < mesh->vertex_count; ++i) {
        bounds = tl_aabb_add_point(bounds, mesh->vertices[i]);
    }
    return bounds;
}

static tl_exit report_sample(tl_cli *cli, const char *name, const char *output, const tl_sample_mesh *mesh)
{
    tl_aabb bounds = bounds_of(mesh);
    if (cli->json) {
        json_t *object = json_pack("{ss so sI sI so}", "level", name, "output", tl_json_text(output), "triangles",
                                   (json_int_t)mesh->triangle_count, "vertices", (json_int_t)mesh->vertex_count,
                                   "bounds", tl_json_bounds(bounds));
        return tl_cli_print_json(cli, object);
    }
    tl_vec3 size = tl_aabb_size(bounds);
    printf("%s: %s, %u triangles, %.0f x %.0f x %.0f m\n", output, name, mesh->triangle_count, (double)size.x,
           (double)size.y, (double)size.z);
    return TL_EXIT_OK;
}

static tl_exit write_level(tl_cli *cli, const tl_sample_level *level, const char *output, uint32_t triangles,
                           uint64_t seed)
{
    tl_sample_mesh mesh;
    tl_result result = tl_sample_build_level(level, triangles, seed, &mesh);
    tl_exit code;
    if (result == TL_ERR_LIMIT) {
        code = tl_cli_fail(cli, TL_EXIT_USAGE, "--triangles: %u is too many; use at most %u", triangles,
                           TL_MAX_MESH_TRIANGLES / 4);
    } else if (result != TL_OK) {
        code = tl_cli_fail_result(cli, level->name, result, NULL);
    } else {
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        tl_io_error error;
        memset(&error, 0, sizeof(error));
        if (tl_obj_write_mesh(output, &view, NULL, 0, &error) != TL_OK) {
            code = tl_cli_fail_io(cli, &error);
        } else {
            code = strcmp(output, "-") == 0 ? TL_EXIT_OK : report_sample(cli, level->name, output, &mesh);
        }
    }
    tl_sample_mesh_free(&mesh);
    return code;
}

static tl_exit write_world(tl_cli *cli, const char *output, uint32_t triangles, uint64_t seed)
{
    tl_sample_files files;
    tl_exit code = tl_sample_files_write(cli, output, triangles != 0 ? triangles : WORLD_TRIANGLES, seed, &files);
    tl_progress_end(&cli->progress);
    if (code != TL_EXIT_OK) {
        return code;
    }
    if (cli->json) {
        return tl_cli_print_json(cli, json_pack("{ss so sI sI sI}", "level", "world", "output", tl_json_text(output),
                                                "triangles", (json_int_t)files.triangles, "parts_x",
                                                (json_int_t)files.parts_x, "parts_z", (json_int_t)files.parts_z));
    }
    printf("%s: world, %llu triangles in %u x %u parts of a square kilometre\n", output,
           (unsigned long long)files.triangles, files.parts_x, files.parts_z);
    return TL_EXIT_OK;
}

static tl_exit run_sample(tl_cli *cli)
{
    const char *output = NULL;
    uint32_t triangles = 0;
    uint64_t seed = 1;
    bool list = false;
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_OUTPUT, &output, "FILE",
          "where to write; - is standard output (NAME.obj); of the world a folder (world)", NULL, 0, 0, 0, 0 },
        { "triangles", 'n', TL_OPTION_COUNT, &triangles, "N",
          "triangles of the level, from 500; up to 7 fewer are made (0: as --list says)", NULL, 0, 0, 0,
          TL_MAX_MESH_TRIANGLES / 4 },
        { "seed", 's', TL_OPTION_NUMBER, &seed, "N", "each number gives another level of the same kind", NULL, 0, 0, 0,
          0 },
        { "list", 'l', TL_OPTION_FLAG, &list, NULL, "list the levels", NULL, 0, 0, 0, 0 },
        TL_OPTION_TABLE_END,
    };
    const tl_option_group groups[] = { { "Options:", options }, { NULL, NULL } };
    tl_exit code;
    if (!tl_cli_parse(cli, groups, 0, 1, &code)) {
        return code;
    }
    if (list || cli->arguments.count == 0) {
        return list_levels(cli);
    }
    if (strcmp(cli->arguments.words[0], "world") == 0) {
        return write_world(cli, output != NULL ? output : "world", triangles, seed);
    }
    if (output != NULL && !tl_is_stream(output) && !tl_has_ending(output, ".obj")) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "--output: '%s' has an ending that cannot be written; use .obj", output);
    }
    const tl_sample_level *level = tl_sample_find_level(cli->arguments.words[0]);
    if (level == NULL) {
        return tl_cli_fail(cli, TL_EXIT_USAGE, "there is no level '%s'; 'talus sample --list' names them",
                           cli->arguments.words[0]);
    }
    tl_interrupt_ends(); // the file comes into being with its last byte
    char name[32];
    snprintf(name, sizeof(name), "%s.obj", level->name);
    return write_level(cli, level, output != NULL ? output : name,
                       triangles != 0 ? triangles : level->default_triangles, seed);
}

const tl_command tl_sample_command = {
    "sample",
    "Levels",
    "write a built-in level as OBJ",
    "NAME [-o FILE.obj] [--triangles N] [--seed N]\n"
    "world [-o FOLDER] [--triangles N] [--seed N]\n"
    "--list",
    "Writes a built-in level: rooms, stairs, ramps, bridges over floors, thin walls, pits. Metres, y up. The\n"
    "same name, size and seed give the same file on every machine. Without NAME it lists the levels.\n"
    "The world is a folder of parts, written one by one, so that it may be larger than memory.",
    "talus sample --list\n"
    "talus sample courtyard -o courtyard.obj\n"
    "talus sample city --triangles 100000 --seed 7 -o city.obj\n"
    "talus sample world --triangles 300000 -o land",
    run_sample,
};
