// SPDX-License-Identifier: MIT
//
// From a mesh file to a baked file: import, clean, bake triangles for rays and a navmesh for paths, write one .talus.
// open_baked.c opens it.
//
//   bake_from_obj [LEVEL [OUT.talus]]       LEVEL: any kind of mesh file; a small level of its own without

#include <io/files/atomic_write.h>
#include <io/mesh/mesh_import.h>
#include <talus/talus.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A floor 20 m square, and a wall 3 m high with a passage around its end at z = 6.
static const char OBJ[] = "v -10 0 -10\nv -10 0 10\nv 10 0 10\nv 10 0 -10\n"
                          "v 0 0 -10\nv 0 0 6\nv 0 3 6\nv 0 3 -10\n"
                          "v 0.5 0 -10\nv 0.5 0 6\nv 0.5 3 6\nv 0.5 3 -10\n"
                          "f 1 2 3 4\nusemtl wall\nf 5 6 7 8\nf 9 12 11 10\nf 6 10 11 7\nf 8 7 11 12\n";

// Everything that the file holds.
typedef struct baked_level {
    tl_soup *soup;
    tl_nav_tiles tiles;
    tl_pack_navmesh *navmesh;
    tl_pack_meta *meta;
} baked_level;

static tl_result bake_level(const tl_imported_mesh *imported, const char *name, baked_level *level)
{
    tl_mesh mesh;
    tl_mesh_view source = tl_imported_mesh_as_view(imported);
    tl_result result = tl_mesh_bake(&source, NULL, &mesh, NULL); // welds, and drops what has no area
    if (result != TL_OK) {
        return result;
    }
    tl_nav_def def = tl_default_nav_def();
    def.bounds = mesh.bounds;
    tl_nav_input input = { .mesh = tl_mesh_as_view(&mesh) };
    result = tl_soup_bake(&input.mesh, NULL, &level->soup, NULL);
    if (result == TL_OK) {
        result = tl_nav_bake(&def, &input, &level->tiles, NULL);
    }
    if (result == TL_OK) {
        const tl_nav_tiles *tiles = &level->tiles;
        result = tl_pack_navmesh_encode(&def, tiles->tiles_x, tiles->tiles_z, tiles->tile_count, NULL, &level->navmesh,
                                        NULL);
    }
    if (result == TL_OK) {
        result = tl_pack_meta_encode(name, imported->vertex_count, imported->triangle_count, mesh.bounds, NULL,
                                     &level->meta, NULL);
    }
    tl_mesh_free(&mesh);
    return result;
}

static tl_result write_bytes(const void *bytes, size_t size, void *user)
{
    return tl_atomic_file_write(user, bytes, size, NULL);
}

// The file appears whole or not at all.
static tl_result write_level(const baked_level *level, const char *path, tl_io_error *error)
{
    uint32_t count = 3 + level->tiles.tile_count;
    tl_pack_item *items = calloc(count, sizeof *items);
    if (items == NULL) {
        return TL_ERR_MEMORY;
    }
    items[0] = (tl_pack_item){ TL_PACK_META, 0, level->meta, level->meta->blob.size };
    items[1] = (tl_pack_item){ TL_PACK_SOUP, 0, level->soup, tl_soup_size(level->soup) };
    items[2] = (tl_pack_item){ TL_PACK_NAVM, 0, level->navmesh, level->navmesh->blob.size };
    for (uint32_t i = 0; i < level->tiles.tile_count; i++) {
        const tl_nav_tile *tile = level->tiles.tiles[i];
        items[3 + i] = (tl_pack_item){ TL_PACK_NAVT, i, tile, tile->blob.size };
    }
    tl_atomic_file *file;
    tl_result result = tl_atomic_file_open(path, &file, error);
    if (result == TL_OK) {
        result = tl_pack_write(items, count, NULL, write_bytes, file, NULL);
        if (result == TL_OK) {
            result = tl_atomic_file_commit(file, error);
        } else {
            tl_atomic_file_abort(file);
        }
    }
    free(items);
    return result;
}

int main(int argc, char **argv)
{
    const char *path = argc > 1 ? argv[1] : "level.obj";
    const char *out = argc > 2 ? argv[2] : "baked_from_obj.talus";
    tl_io_error error = { .result = TL_OK };
    tl_imported_mesh imported;
    tl_result result = argc > 1 ? tl_import_mesh(path, NULL, &imported, &error)
                                : tl_import_mesh_bytes(OBJ, sizeof OBJ - 1, path, NULL, &imported, &error);
    if (result == TL_OK) {
        printf("%s: %u triangles of %u materials\n", path, imported.triangle_count, imported.names.count - 1);
        baked_level level;
        memset(&level, 0, sizeof level);
        result = bake_level(&imported, path, &level);
        if (result == TL_OK) {
            result = write_level(&level, out, &error);
        }
        if (result == TL_OK) {
            printf("%s: %u tile(s), %llu bytes of triangles\n", out, level.tiles.tile_count,
                   (unsigned long long)tl_soup_size(level.soup));
        }
        tl_blob_free(level.soup);
        tl_blob_free(level.navmesh);
        tl_blob_free(level.meta);
        tl_nav_tiles_free(&level.tiles);
    }
    if (result != TL_OK) {
        char words[1024];
        tl_io_error_format(&error, words, sizeof words); // with file, line and what to do
        fprintf(stderr, "talus: %s\n", error.result != TL_OK ? words : tl_result_text(result));
    }
    tl_imported_mesh_free(&imported);
    return result == TL_OK ? 0 : 1;
}
