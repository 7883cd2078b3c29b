// SPDX-License-Identifier: MIT
//
// Navmeshes: tiles of several settings, what is found and proven over them, Detour's tiles, and the baked file.

#include "golden.h"

#include <stdlib.h>
#include <string.h>

typedef struct nav_setting {
    const char *kind;
    tl_nav_partition partition;
    uint32_t tile_size;
    float tile_height;
    tl_partition_method method;
} nav_setting;

static const nav_setting SETTINGS[] = {
    { "nav-whole", TL_NAV_WATERSHED, 0, 0, TL_PARTITION_CLASSIC },
    { "nav-tiles", TL_NAV_MONOTONE, 48, 0, TL_PARTITION_CLASSIC },
    { "nav-layers", TL_NAV_WATERSHED, 64, 3, TL_PARTITION_OPTIMAL },
};

static tl_nav_def def_of(const nav_setting *setting)
{
    tl_nav_def def = tl_default_nav_def();
    def.partition = setting->partition;
    def.tile_size = setting->tile_size;
    def.tile_height = setting->tile_height;
    def.polygon_method = setting->method;
    return def;
}

/// The tiles as Detour's set, and those that come back from it.
static void digest_detour(const tl_nav_tiles *tiles, const char *kind)
{
    const tl_nav_tile *const *list = (const tl_nav_tile *const *)tiles->tiles;
    const uint64_t size = tl_detour_set_size(list, tiles->tile_count, TL_DETOUR_REFS_32);
    uint8_t *bytes = calloc(1, (size_t)size);
    must(bytes != NULL ? TL_OK : TL_ERR_MEMORY, "calloc");
    MUST(tl_detour_set_write(list, tiles->tile_count, TL_DETOUR_REFS_32, bytes, size, NULL));
    digest d = digest_begin();
    digest_bytes(&d, bytes, size);
    d.found = tiles->tile_count;
    digest_print(&d, kind, "detour");

    tl_detour_tiles back;
    MUST(tl_detour_read(bytes, size, NULL, &back, NULL));
    d = digest_begin();
    for (uint32_t i = 0; i < back.tile_count; i++) {
        digest_blob(&d, back.tiles[i]);
    }
    digest_print(&d, kind, "detour-back");
    tl_detour_tiles_free(&back);
    free(bytes);
}

static void digest_audit(const tl_nav_def *def, const tl_navmesh *navmesh, const tl_soup *soup)
{
    tl_nav_audit_def audit_def = tl_default_nav_audit_def();
    audit_def.nav = *def;
    audit_def.path_count = 20;
    tl_nav_audit audit;
    MUST(tl_nav_audit_run(&audit_def, navmesh, soup, &audit, NULL));
    digest d = digest_begin();
    d.found = audit.step_count;
    digest_u64(&d, audit.step_count);
    digest_u64(&d, audit.floor_samples);
    digest_f64(&d, audit.path_metres);
    digest_f64(&d, audit.missing_area);
    for (uint32_t i = 0; i < audit.finding_count; i++) {
        digest_vec3(&d, audit.findings[i].point);
        digest_f32(&d, audit.findings[i].depth);
        digest_u32(&d, (uint32_t)audit.findings[i].kind);
    }
    digest_print(&d, "audit", "findings");
    tl_nav_audit_free(&audit);
}

static void digest_obstacles(tl_nav_def def, const tl_nav_input *input)
{
    tl_nav_obstacles *obstacles;
    tl_nav_tile_block block;
    def.bounds = (tl_aabb){ { 0, -1, 0 }, { 40, 14, 40 } };
    MUST(tl_nav_obstacles_bake(&def, input, &obstacles, &block, NULL));
    tl_nav_obstacle obstacle;
    memset(&obstacle, 0, sizeof obstacle);
    obstacle.shape = TL_NAV_OBSTACLE_CYLINDER;
    obstacle.base = tl_vec3_make(20, -1, 30);
    obstacle.height = 5;
    obstacle.radius = 3;
    tl_nav_obstacle_id id;
    MUST(tl_nav_obstacles_add(obstacles, &obstacle, &id, NULL));
    digest d = digest_begin();
    while (tl_nav_obstacles_waiting(obstacles) > 0) {
        tl_nav_rebaked_tile tile;
        if (tl_nav_obstacles_bake_next(obstacles, &tile, NULL) != TL_OK) {
            break;
        }
        for (uint32_t i = 0; i < tile.stack.count; i++) {
            digest_blob(&d, tile.stack.tiles[i]);
        }
        tl_nav_tile_stack_free(&tile.stack);
    }
    digest_print(&d, "obstacles", "tiles");
    tl_nav_tile_block_free(&block);
    tl_nav_obstacles_destroy(obstacles);
}

static void digest_pruned(const tl_nav_def *def, const tl_nav_input *input)
{
    tl_nav_tiles tiles;
    MUST(tl_nav_bake(def, input, &tiles, NULL));
    tl_nav_prune_def prune = tl_default_nav_prune_def();
    const tl_vec3 seed = { 2, 0.25f, 30 };
    prune.seeds = &seed;
    prune.seed_count = 1;
    MUST(tl_nav_prune(&prune, &tiles, NULL, NULL));
    digest d = digest_begin();
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        digest_blob(&d, tiles.tiles[i]);
    }
    digest_print(&d, "prune", "tiles");
    tl_nav_tiles_free(&tiles);
}

typedef struct memory_file {
    uint8_t *bytes;
    uint64_t size;
} memory_file;

static tl_result append(const void *bytes, size_t size, void *user)
{
    memory_file *file = user;
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
    return TL_OK;
}

void golden_pack(const tl_soup *soup, const tl_hull *hull, const tl_nav_tiles *tiles, const tl_nav_links *links)
{
    tl_pack_item items[64];
    uint32_t count = 0;
    const tl_nav_def def = tl_default_nav_def();
    tl_pack_navmesh *navmesh;
    tl_pack_meta *meta;
    tl_pack_volumes *volumes;
    const tl_nav_volume volume = { .kind = TL_NAV_VOLUME_BOX, .area = 3, .box = { { 1, 2, 3 }, { 4, 5, 6 } } };
    MUST(tl_pack_meta_encode("golden.obj", 8, 12, tl_soup_bounds(soup), NULL, &meta, NULL));
    MUST(tl_pack_navmesh_encode(&def, tiles->tiles_x, tiles->tiles_z, tiles->tile_count, NULL, &navmesh, NULL));
    MUST(tl_pack_volumes_encode(&volume, 1, NULL, &volumes, NULL));
    tl_nav_offmesh ladder = tl_default_nav_offmesh();
    ladder.end = tl_vec3_make(1, 2, 3);
    ladder.user = 0x0102030405060708u;
    tl_pack_offmesh *offmesh;
    tl_pack_areas *areas;
    MUST(tl_pack_offmesh_encode(&ladder, 1, NULL, &offmesh, NULL));
    MUST(tl_pack_areas_encode((const uint8_t[]){ 1, 2, 3 }, 3, NULL, &areas, NULL));
    const void *const blobs[] = { meta, soup, hull, navmesh, volumes, links, offmesh, areas };
    const uint32_t types[] = { TL_PACK_META, TL_PACK_SOUP, TL_PACK_HULL, TL_PACK_NAVM,
                               TL_PACK_MARK, TL_PACK_LINK, TL_PACK_OFFM, TL_PACK_AREA };
    for (uint32_t i = 0; i < 8; i++) {
        const tl_pack_item item = { types[i], 0, blobs[i], ((const tl_blob *)blobs[i])->size };
        items[count++] = item;
    }
    for (uint32_t i = 0; i < tiles->tile_count && count < 64; i++) {
        const tl_pack_item item = { TL_PACK_NAVT, i, tiles->tiles[i], tiles->tiles[i]->blob.size };
        items[count++] = item;
    }
    // A block of its own, aligned to 64 as a mapped file is.
    uint8_t *block = malloc((size_t)tl_pack_size(items, count) + 63);
    memory_file file = { block + (64 - (uintptr_t)block % 64) % 64, 0 };
    must(block != NULL ? TL_OK : TL_ERR_MEMORY, "malloc");
    MUST(tl_pack_write(items, count, NULL, append, &file, NULL));
    digest d = digest_begin();
    digest_bytes(&d, file.bytes, file.size);
    d.found = count;
    digest_print(&d, "pack", "file");

    // As whoever gets the file from another machine: opened, checked, and asked.
    tl_pack pack;
    MUST(tl_pack_to_host_order(file.bytes, file.size, NULL));
    MUST(tl_pack_open(file.bytes, file.size, &pack, NULL));
    tl_pack_chunk chunk;
    MUST(tl_pack_find(&pack, TL_PACK_SOUP, 0, &chunk));
    MUST(tl_soup_check(chunk.bytes, chunk.size, NULL));
    golden_rays(chunk.bytes, "pack");
    MUST(tl_pack_find(&pack, TL_PACK_HULL, 0, &chunk));
    MUST(tl_hull_check(chunk.bytes, chunk.size, NULL));
    tl_navmesh *loaded;
    MUST(tl_pack_load_navmesh(&pack, NULL, &loaded, NULL));
    golden_nav_answers(loaded, "pack");
    tl_navmesh_destroy(loaded);
    free(block);
    tl_blob_free(meta);
    tl_blob_free(navmesh);
    tl_blob_free(volumes);
    tl_blob_free(offmesh);
    tl_blob_free(areas);
}

/// Links, what they add to the answers, and a file that holds all kinds.
static void links_and_file(tl_navmesh *navmesh, const tl_soup *soup, const tl_nav_tiles *tiles)
{
    tl_nav_links *links;
    MUST(tl_nav_links_find(NULL, navmesh, soup, &links, NULL));
    digest d = digest_begin();
    digest_blob(&d, links);
    d.found = links->link_count;
    digest_print(&d, "links", "blob");
    MUST(tl_nav_links_add(links, NULL, navmesh));
    golden_nav_answers(navmesh, "nav-links");

    const tl_vec3 corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } };
    tl_hull *hull;
    MUST(tl_hull_bake(corners, 5, NULL, &hull, NULL));
    golden_pack(soup, hull, tiles, links);
    tl_blob_free(hull);
    tl_blob_free(links);
}

void golden_navmeshes(const tl_mesh_view *view, const tl_soup *soup)
{
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = *view;
    for (uint32_t k = 0; k < sizeof SETTINGS / sizeof SETTINGS[0]; k++) {
        const tl_nav_def def = def_of(&SETTINGS[k]);
        const char *kind = SETTINGS[k].kind;
        tl_nav_tiles tiles;
        MUST(tl_nav_bake(&def, &input, &tiles, NULL));
        digest d = digest_begin();
        for (uint32_t i = 0; i < tiles.tile_count; i++) {
            MUST(tl_nav_tile_check(tiles.tiles[i], tiles.tiles[i]->blob.size, NULL));
            digest_blob(&d, tiles.tiles[i]);
        }
        digest_print(&d, kind, "tiles");
        tl_navmesh *navmesh;
        MUST(tl_navmesh_create(NULL, &navmesh));
        MUST(tl_navmesh_add_tiles(navmesh, tiles.tiles, tiles.tile_count, TL_NAV_TILE_BORROWED, NULL));
        golden_nav_answers(navmesh, kind);
        if (k == 0) {
            digest_audit(&def, navmesh, soup);
            golden_nav_sight(navmesh, soup);
            golden_nav_prepared(navmesh);
        } else if (k == 1) {
            digest_detour(&tiles, kind);
            digest_obstacles(def, &input);
            digest_pruned(&def, &input);
            links_and_file(navmesh, soup, &tiles);
        }
        tl_navmesh_destroy(navmesh);
        tl_nav_tiles_free(&tiles);
    }
}
