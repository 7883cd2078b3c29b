// SPDX-License-Identifier: MIT
//
// talus links: the drops, jumps and climbs of a level, found, proven, counted, drawn, and put into its baked file.

#include "cli/draw/draw_picture.h"
#include "cli/draw/draw_source.h"
#include "cli/draw/draw_stage.h"
#include "cli/level/write_pack.h"
#include "cli/options/output_check.h"
#include "cli/shared/json_out.h"

#include <stdio.h>
#include <string.h>

typedef struct links_settings {
    tl_bake_settings bake;
    const char *output;
    const char *picture;
    uint32_t size;
} links_settings;

// The file's chunks with these links in the place of those it had. Routes go: they know nothing of links, and files
// with links are not opened as worlds.
static tl_exit write_baked_links(tl_cli *cli, const draw_source *source, const tl_nav_links *links, const char *output)
{
    const tl_pack *pack = &source->input.pack;
    tl_pack_content content;
    uint64_t size = 0;
    tl_result result = tl_pack_content_make(pack->chunk_count + 1, &content);
    if (result != TL_OK) {
        return tl_cli_fail_result(cli, output, result, NULL);
    }
    for (uint32_t i = 0; i < pack->chunk_count; ++i) {
        tl_pack_chunk chunk = tl_pack_chunk_at(pack, i);
        if (chunk.type == TL_PACK_ROUT) {
            tl_cli_warn(cli, "%s: its routes know nothing of links, and are left out", output);
        } else if (chunk.type != TL_PACK_LINK) {
            tl_pack_item item = { chunk.type, chunk.id, chunk.bytes, chunk.size };
            content.items[content.count++] = item;
        }
    }
    tl_pack_content_add(&content, TL_PACK_LINK, 0, links);
    tl_exit code = tl_pack_content_write(cli, output, &content, &size);
    tl_pack_content_free(&content);
    return code;
}

static tl_exit draw_links(draw_source *source, const tl_nav_links *links, const links_settings *settings)
{
    draw_scene scene;
    draw_picture_begin(source, "links", &scene);
    draw_stage_links(&scene, source->input.navmesh, links);
    tl_exit code = TL_EXIT_OK;
    (void)draw_picture_end(source, &scene, settings->size, settings->picture, &code);
    return code;
}

static tl_exit report_links(tl_cli *cli, const tl_level_links *found, const links_settings *settings)
{
    tl_progress_end(&cli->progress);
    if (!cli->json) {
        tl_level_links_print(&found->report);
        return TL_EXIT_OK;
    }
    json_t *object = tl_level_links_json(&found->report);
    json_object_set_new(object, "file", tl_json_text(cli->arguments.words[0]));
    json_object_set_new(object, "links", tl_level_links_list_json(cli->frame, found->links));
    if (settings->output != NULL) {
        json_object_set_new(object, "output", tl_json_text(settings->output));
    }
    return tl_cli_print_json(cli, object);
}

// Links that a baked file has already are found anew.
static void drop_links(tl_navmesh *navmesh)
{
    uint32_t cursor = 0;
    tl_nav_ref link;
    while (tl_navmesh_next_offmesh(navmesh, &cursor, &link)) {
        (void)tl_navmesh_remove_offmesh(navmesh, link);
    }
}

static tl_exit find_level_links(tl_cli *cli, const links_settings *settings)
{
    const char *path = cli->arguments.words[0];
    draw_source source;
    tl_exit code;
    tl_level_links found;
    memset(&found, 0, sizeof found);
    bool open = draw_source_open(cli, path, &settings->bake, 0, &source, &code);
    if (open && (source.is_bare || source.is_contours)) {
        code = tl_cli_fail(cli, TL_EXIT_DATA, "%s: holds no triangles, which links are proven against", path);
        open = false;
    }
    open = open && draw_need_soup(&source, &code) && draw_need_walkable(&source, &code);
    if (open && settings->output != NULL && !source.input.baked) {
        code = tl_cli_fail(cli, TL_EXIT_USAGE, "%s is a level; write its links with talus bake --links", path);
        open = false;
    }
    if (open) {
        drop_links(source.input.navmesh);
    }
    if (open && tl_level_links_find(cli, &settings->bake.links_def, source.input.navmesh, source.soup, &found, &code)) {
        code = settings->output != NULL ? write_baked_links(cli, &source, found.links, settings->output) : TL_EXIT_OK;
        code = code == TL_EXIT_OK && settings->picture != NULL ? draw_links(&source, found.links, settings) : code;
        code = code == TL_EXIT_OK ? report_links(cli, &found, settings) : code;
    }
    tl_blob_free(found.links);
    draw_source_close(&source);
    return code;
}

static tl_exit run_links(tl_cli *cli)
{
    links_settings settings;
    memset(&settings, 0, sizeof settings);
    settings.bake = tl_default_bake_settings();
    settings.size = 1200;
    const tl_option options[] = {
        { "output", 'o', TL_OPTION_TEXT, &settings.output, "FILE",
          "where to write the baked file with its links; may be FILE itself", NULL, 0, 0, 0, 0 },
        { "draw", 0, TL_OPTION_OUTPUT, &settings.picture, "FILE", "draw a picture of them: .png or .svg",
          tl_picture_endings, 0, 0, 0, 0 },
        { "size", 0, TL_OPTION_COUNT, &settings.size, "PIXELS", "of the picture: longer side of each view", NULL, 0, 0,
          200, 8000 },
        TL_OPTION_TABLE_END,
    };
    tl_option link_options[TL_LINK_OPTIONS];
    tl_link_options(&settings.bake.links_def, link_options);
    const tl_option_group groups[] = { { "Options:", options },
                                       { "What an agent can do:", link_options },
                                       { NULL, NULL } };
    cli->speaks_frame = true;
    tl_exit code;
    if (!tl_input_parse(cli, groups, TL_INPUT_NAVMESH, &settings.bake, 1, 1, &code)) {
        return code;
    }
    return find_level_links(cli, &settings);
}

const tl_command tl_links_command = {
    "links",
    "Navmesh",
    "find drops, jumps and climbs",
    "FILE [-o OUT.talus] [--drop M] [--jump M] [--climb M] [--draw OUT.png] [options]",
    "Looks along the borders of the navmesh for places to drop, jump or climb from, and sweeps the agent's\n"
    "capsule through the level's triangles along each trajectory. Keeps the links that shorten paths, and\n"
    "prints how many there are and why others were refused. FILE is a baked file, or a level, which is then\n"
    "baked in memory. With -o the baked file is written with its links: talus path uses them from then on.",
    "talus sample courtyard -o courtyard.obj\n"
    "talus bake courtyard.obj -o courtyard.talus\n"
    "talus links courtyard.talus -o courtyard.talus --drop 5 --jump 2.5 --draw links.png --size 400\n"
    "talus links courtyard.obj --climb 0 --json",
    run_links,
};
