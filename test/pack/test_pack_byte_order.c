// SPDX-License-Identifier: MIT
//
// Blobs and files of machines of the other byte order. What those machines do is done here by hand: each kind of blob
// is turned round and back. tools/cross runs the public functions on such a machine (s390x) and compares the bytes.

#include "nav_fixture.h"

#include "hull/support/hull_support.h"
#include "nav_format/detour_read.h"
#include "pack/pack_format.h"

#include <talus/talus.h>

enum { SIDE = 24, HULL_POINTS = 900 };

typedef struct byte_order_level {
    tl_vec3 vertices[SIDE * SIDE];
    uint32_t indices[6 * SIDE * SIDE];
    uint16_t materials[2 * SIDE * SIDE];
    tl_mesh_view view;
} byte_order_level;

static byte_order_level *hills(void)
{
    byte_order_level *level = calloc(1, sizeof *level);
    test_random random = { 5 };
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const float height = test_random_range(&random, 0.0f, 0.5f) + (i % SIDE > SIDE / 2 ? 4.0f : 0.0f);
        level->vertices[i] = tl_vec3_make((float)(i % SIDE), height, (float)(i / SIDE));
    }
    for (uint32_t z = 0; z + 1 < SIDE; z++) {
        for (uint32_t x = 0; x + 1 < SIDE; x++) {
            const uint32_t a = z * SIDE + x;
            const uint32_t quad[6] = { a, a + SIDE, a + SIDE + 1, a, a + SIDE + 1, a + 1 };
            memcpy(level->indices + 3 * (size_t)level->view.triangle_count, quad, sizeof quad);
            level->materials[level->view.triangle_count] = (uint16_t)(x * 300);
            level->view.triangle_count += 2;
        }
    }
    level->view.vertices = level->vertices;
    level->view.vertex_count = SIDE * SIDE;
    level->view.indices = level->indices;
    level->view.materials = level->materials;
    return level;
}

typedef tl_result check_fn(const void *bytes, uint64_t size, tl_report *report);

static void *copy_blob(const void *blob, uint64_t size)
{
    void *copy = test_blob_alloc((size_t)size);
    memcpy(copy, blob, (size_t)size);
    return copy;
}

/// There and back; in between no check takes it, and the head is what another machine would read.
static void goes_round(const void *blob, check_fn *check)
{
    const tl_blob head = *(const tl_blob *)blob;
    uint8_t *copy = copy_blob(blob, head.size);
    TEST_RESULT(tl_blob_swap(copy, head.size, false, NULL), TL_OK);
    TEST_RESULT(check(copy, head.size, NULL), TL_ERR_MAGIC);
    TEST_CHECK(copy[0] == (uint8_t)(head.magic >> 24) && copy[3] == (uint8_t)head.magic);
    TEST_CHECK(copy[15] == (uint8_t)head.size && copy[14] == (uint8_t)(head.size >> 8));
    TEST_RESULT(tl_blob_swap(copy, head.size, false, NULL), TL_ERR_MAGIC);
    TEST_RESULT(tl_blob_swap(copy, head.size, true, NULL), TL_OK);
    TEST_CHECK(memcmp(copy, blob, (size_t)head.size) == 0);
    TEST_RESULT(check(copy, head.size, NULL), TL_OK);
    TEST_RESULT(tl_blob_swap(copy, 8, true, NULL), TL_ERR_TRUNCATED);
    test_blob_free(copy);
}

/// Any byte of a foreign head may be wrong: nothing is read or written out of bounds, and the check has the last word.
static void survives_damage(const void *blob, check_fn *check)
{
    const uint64_t size = ((const tl_blob *)blob)->size;
    uint8_t *foreign = copy_blob(blob, size);
    TEST_RESULT(tl_blob_swap(foreign, size, false, NULL), TL_OK);
    uint32_t refused = 0;
    for (size_t at = 0; at < 256 && at < size; at++) {
        for (int bit = 0; bit < 8; bit += 7) {
            uint8_t *damaged = copy_blob(foreign, size);
            damaged[at] ^= (uint8_t)(1 << bit);
            const tl_result swapped = tl_blob_swap(damaged, size, true, NULL);
            refused += swapped != TL_OK ? 1 : 0;
            check(damaged, size, NULL);
            test_blob_free(damaged);
        }
    }
    TEST_CHECK(refused >= 8); // the magic's bits at least
    for (uint64_t shorter = 16; shorter < size; shorter += 40) {
        uint8_t *part = copy_blob(foreign, shorter);
        (void)tl_blob_swap(part, shorter, true, NULL);
        TEST_CHECK(check(part, shorter, NULL) != TL_OK);
        test_blob_free(part);
    }
    test_blob_free(foreign);
}

static void go(void *blob, check_fn *check)
{
    goes_round(blob, check);
    survives_damage(blob, check);
    tl_blob_free(blob);
}

static void test_soups(void **state)
{
    (void)state;
    byte_order_level *level = hills();
    for (int kind = 0; kind < 4; kind++) {
        tl_soup_def def = tl_default_soup_def();
        def.layout = kind % 2 == 0 ? TL_SOUP_FAST : TL_SOUP_COMPACT;
        level->view.materials = kind < 2 ? level->materials : NULL;
        tl_soup *soup;
        TEST_RESULT(tl_soup_bake(&level->view, &def, &soup, NULL), TL_OK);
        go(soup, tl_soup_check);
    }
    // Both sides of every triangle.
    const uint32_t count = level->view.triangle_count;
    uint32_t *sides = malloc(6 * (size_t)count * sizeof *sides);
    TEST_CHECK(sides != NULL);
    for (uint32_t i = 0; i < 3 * count; i++) {
        sides[i] = sides[6 * count - 1 - i] = level->view.indices[i];
    }
    tl_mesh_view both = level->view;
    both.indices = sides;
    both.triangle_count = 2 * count;
    for (int kind = 0; kind < 2; kind++) {
        tl_soup_def def = tl_default_soup_def();
        def.layout = kind == 0 ? TL_SOUP_FAST : TL_SOUP_COMPACT;
        tl_soup *soup;
        TEST_RESULT(tl_soup_bake(&both, &def, &soup, NULL), TL_OK);
        TEST_CHECK(tl_soup_get_stats(soup).coincident_count == count);
        go(soup, tl_soup_check);
    }
    free(sides);
    free(level);
}

static void test_hulls(void **state)
{
    (void)state;
    // Scanned, and with blocks and sources too; with a table; with a table and rings, for its two large faces.
    tl_vec3 points[HULL_POINTS];
    test_random random = { 6 };
    for (int kind = 0; kind < 4; kind++) {
        const uint32_t count = kind == 0 ? 12 : kind == 1 ? 30 : HULL_POINTS;
        for (uint32_t i = 0; i < count; i++) {
            const tl_vec3 p =
                tl_vec3_make(test_random_range(&random, -1.0f, 1.0f), test_random_range(&random, -1.0f, 1.0f),
                             test_random_range(&random, -1.0f, 1.0f));
            points[i] = tl_normalize(p);
            if (kind == 3) {
                points[i] = tl_normalize(tl_vec3_make(p.x, 0.0f, p.z));
                points[i].y = i % 2 == 0 ? 1.0f : -1.0f;
            }
        }
        points[1] = kind == 1 ? points[0] : points[1];
        tl_hull *hull;
        TEST_RESULT(tl_hull_bake(points, count, NULL, &hull, NULL), TL_OK);
        TEST_CHECK((hull->vertex_count > TL_HULL_FEW) == (kind > 0) &&
                   (tl_hull_source_bytes(hull) == 1) == (kind == 1));
        TEST_CHECK((hull->vertex_count > TL_HULL_SCAN_LIMIT) == (kind > 1));
        TEST_CHECK(kind == 0 || (tl_hull_climb_head(hull)->ring_count > 0) == (kind == 3));
        go(hull, tl_hull_check);
    }
}

static void bake_hills(const byte_order_level *level, tl_nav_tiles *tiles, tl_navmesh **navmesh)
{
    tl_nav_def def = tl_default_nav_def();
    def.tile_size = 32;
    tl_nav_input input;
    memset(&input, 0, sizeof input);
    input.mesh = level->view;
    TEST_RESULT(tl_nav_bake(&def, &input, tiles, NULL), TL_OK);
    TEST_CHECK(tiles->tile_count > 3);
    TEST_RESULT(tl_navmesh_create(NULL, navmesh), TL_OK);
    TEST_RESULT(tl_navmesh_add_tiles(*navmesh, tiles->tiles, tiles->tile_count, TL_NAV_TILE_BORROWED, NULL), TL_OK);
}

static void test_navmesh_blobs(void **state)
{
    (void)state;
    byte_order_level *level = hills();
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
    bake_hills(level, &tiles, &navmesh);
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&level->view, NULL, &soup, NULL), TL_OK);
    for (uint32_t i = 0; i < tiles.tile_count; i++) {
        goes_round(tiles.tiles[i], tl_nav_tile_check);
    }
    survives_damage(tiles.tiles[0], tl_nav_tile_check);
    tl_nav_links *links;
    TEST_RESULT(tl_nav_links_find(NULL, navmesh, soup, &links, NULL), TL_OK);
    TEST_CHECK(links->link_count > 0);
    go(links, tl_nav_links_check);
    tl_nav_pvs *pvs;
    TEST_RESULT(tl_nav_pvs_bake(NULL, navmesh, soup, &pvs, NULL), TL_OK);
    TEST_CHECK(pvs->pair_count > 0);
    go(pvs, tl_nav_pvs_check);
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&tiles);
    tl_blob_free(soup);
    free(level);
}

static void test_chunks_of_the_file(void **state)
{
    (void)state;
    const tl_vec3 corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 } };
    tl_nav_volume volumes[2];
    memset(volumes, 0, sizeof volumes);
    volumes[0].kind = TL_NAV_VOLUME_POLYGON;
    volumes[0].points = corners;
    volumes[0].point_count = 3;
    volumes[0].box.max.y = 2.0f;
    volumes[1].kind = TL_NAV_VOLUME_CYLINDER;
    volumes[1].radius = volumes[1].height = 3.0f;
    const tl_aabb box = { { 1, 2, 3 }, { 4, 5, 6 } };
    tl_pack_meta *meta;
    tl_pack_navmesh *navmesh;
    tl_pack_volumes *marks;
    tl_pack_frame *frame;
    TEST_RESULT(tl_pack_meta_encode("a name", 3, 4, box, NULL, &meta, NULL), TL_OK);
    TEST_RESULT(tl_pack_navmesh_encode(NULL, 2, 3, 6, NULL, &navmesh, NULL), TL_OK);
    TEST_RESULT(tl_pack_volumes_encode(volumes, 2, NULL, &marks, NULL), TL_OK);
    go(meta, tl_pack_meta_check);
    go(navmesh, tl_pack_navmesh_check);
    go(marks, tl_pack_volumes_check);
    TEST_RESULT(tl_pack_frame_encode(TL_PACK_AXES_Z_UP, (const double[]){ 1e6, 2.5, -3 }, NULL, &frame, NULL), TL_OK);
    go(frame, tl_pack_frame_check);
    tl_nav_prune_def rules = tl_default_nav_prune_def();
    rules.seeds = corners;
    rules.seed_count = 3;
    rules.min_area = 2.5;
    tl_pack_pruning *pruning;
    TEST_RESULT(tl_pack_pruning_encode(&rules, NULL, &pruning, NULL), TL_OK);
    go(pruning, tl_pack_pruning_check);
    tl_nav_offmesh links[2] = { tl_default_nav_offmesh(), tl_default_nav_offmesh() };
    links[0].end = tl_vec3_make(1, 2, 3);
    links[1].flags = (uint64_t)1 << 40 | 3;
    links[1].user = 0x0102030405060708u;
    links[1].both_ways = true;
    tl_pack_offmesh *offmesh;
    TEST_RESULT(tl_pack_offmesh_encode(links, 2, NULL, &offmesh, NULL), TL_OK);
    go(offmesh, tl_pack_offmesh_check);
    tl_pack_areas *areas;
    TEST_RESULT(tl_pack_areas_encode((const uint8_t[]){ 1, 2, 3 }, 3, NULL, &areas, NULL), TL_OK);
    go(areas, tl_pack_areas_check);
}

// Every chunk that holds a blob is turned round with the file, under each type that it may have.
static void test_chunk_types(void **state)
{
    (void)state;
    byte_order_level *level = hills();
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
    bake_hills(level, &tiles, &navmesh);
    tl_pack_pruning *pruning;
    TEST_RESULT(tl_pack_pruning_encode(NULL, NULL, &pruning, NULL), TL_OK);
    const tl_blob *blobs[] = { &tiles.tiles[0]->blob, &tiles.tiles[0]->blob, &pruning->blob };
    const uint32_t types[] = { TL_PACK_NAVT, TL_PACK_PRUT, TL_PACK_PRUN };
    for (int i = 0; i < 3; i++) {
        uint8_t *chunk = copy_blob(blobs[i], blobs[i]->size);
        TEST_CHECK(tl_pack_swap_chunk(chunk, blobs[i]->size, types[i], false));
        uint8_t *blob = copy_blob(blobs[i], blobs[i]->size);
        TEST_RESULT(tl_blob_swap(blob, blobs[i]->size, false, NULL), TL_OK);
        TEST_CHECK(memcmp(chunk, blob, (size_t)blobs[i]->size) == 0);
        TEST_CHECK(memcmp(chunk, blobs[i], (size_t)blobs[i]->size) != 0);
        test_blob_free(chunk);
        test_blob_free(blob);
    }
    tl_blob_free(pruning);
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&tiles);
    free(level);
}

typedef struct memory_bytes {
    uint8_t *bytes;
    size_t size;
} memory_bytes;

static tl_result append_bytes(const void *bytes, size_t size, void *user)
{
    memory_bytes *file = user;
    memcpy(file->bytes + file->size, bytes, size);
    file->size += size;
    return TL_OK;
}

static memory_bytes small_file(void)
{
    byte_order_level *level = hills();
    tl_soup *soup;
    TEST_RESULT(tl_soup_bake(&level->view, NULL, &soup, NULL), TL_OK);
    static const char WORDS[] = "no blob, though the type says so";
    const tl_pack_item items[] = { { TL_PACK_SOUP, 0, soup, tl_soup_size(soup) },
                                   { TL_PACK_HULL, 0, WORDS, sizeof WORDS },
                                   { TL_PACK_TYPE('M', 'I', 'N', 'E'), 0, soup, 64 } };
    memory_bytes file = { test_blob_alloc((size_t)tl_pack_size(items, 3)), 0 };
    TEST_RESULT(tl_pack_write(items, 3, NULL, append_bytes, &file, NULL), TL_OK);
    tl_blob_free(soup);
    free(level);
    return file;
}

static void test_file(void **state)
{
    (void)state;
    memory_bytes file = small_file();
    uint8_t *copy = copy_blob(file.bytes, file.size);
    TEST_RESULT(tl_pack_swap(copy, file.size, false, NULL), TL_OK);
    tl_pack pack;
    tl_report report;
    TEST_RESULT(tl_pack_open(copy, file.size, &pack, &report), TL_ERR_VERSION);
    TEST_CHECK(strstr(report.advice, "byte order") != NULL);
    TEST_RESULT(tl_pack_swap(copy, file.size, true, NULL), TL_OK);
    TEST_CHECK(memcmp(copy, file.bytes, file.size) == 0);
    // What is public does nothing on this machine, or the same twice.
    TEST_RESULT(tl_pack_to_host_order(copy, file.size, NULL), TL_OK);
    TEST_RESULT(tl_pack_to_host_order(copy, file.size, NULL), TL_OK);
    TEST_RESULT(tl_pack_open(copy, file.size, &pack, NULL), TL_OK);
    test_blob_free(copy);
    test_blob_free(file.bytes);
}

// As tl_pack_open: every part of the file is refused by name, and none is believed before its hash.
static void test_damaged_file(void **state)
{
    (void)state;
    memory_bytes file = small_file();
    uint8_t *foreign = copy_blob(file.bytes, file.size);
    TEST_RESULT(tl_pack_swap(foreign, file.size, false, NULL), TL_OK);
    for (size_t at = 0; at < 2048 && at < file.size; at++) {
        uint8_t *damaged = copy_blob(foreign, file.size);
        damaged[at] ^= 4;
        tl_pack pack;
        const tl_result expected = at < 8 ? TL_ERR_MAGIC : at < 12 ? TL_ERR_VERSION : TL_ERR_HASH;
        const bool padding = at >= 64 + 3 * 32 && at < 192;
        const tl_result result = tl_pack_swap(damaged, file.size, true, NULL);
        TEST_CHECK(result == (padding ? TL_OK : expected));
        TEST_CHECK(result != TL_OK || tl_pack_open(damaged, file.size, &pack, NULL) == TL_ERR_CORRUPT);
        test_blob_free(damaged);
    }
    for (size_t size = 0; size < file.size; size += 7) {
        uint8_t *part = copy_blob(foreign, size + 1);
        TEST_RESULT(tl_pack_swap(part, size, true, NULL), TL_ERR_TRUNCATED);
        test_blob_free(part);
    }
    test_blob_free(foreign);
    test_blob_free(file.bytes);
}

static void test_detour_of_both_orders(void **state)
{
    (void)state;
    byte_order_level *level = hills();
    tl_nav_tiles tiles;
    tl_navmesh *navmesh;
    bake_hills(level, &tiles, &navmesh);
    const tl_nav_tile *const *list = (const tl_nav_tile *const *)tiles.tiles;
    for (int refs = TL_DETOUR_REFS_32; refs <= TL_DETOUR_REFS_64; refs++) {
        const uint64_t size = tl_detour_set_size(list, tiles.tile_count, (tl_detour_refs)refs);
        uint8_t *bytes = malloc((size_t)size);
        TEST_RESULT(tl_detour_set_write(list, tiles.tile_count, (tl_detour_refs)refs, bytes, size, NULL), TL_OK);
        tl_detour_tiles ours, theirs;
        TEST_RESULT(tl_detour_read(bytes, size, NULL, &ours, NULL), TL_OK);
        TEST_CHECK(tl_detour_swap(bytes, size, false));
        TEST_RESULT(tl_detour_read(bytes, size, NULL, &theirs, NULL), TL_OK);
        TEST_CHECK(ours.tile_count == tiles.tile_count && theirs.tile_count == tiles.tile_count);
        for (uint32_t i = 0; i < ours.tile_count; i++) {
            TEST_CHECK(ours.tiles[i]->blob.size == theirs.tiles[i]->blob.size &&
                       memcmp(ours.tiles[i], theirs.tiles[i], (size_t)ours.tiles[i]->blob.size) == 0);
        }
        uint32_t count = 1;
        TEST_RESULT(tl_detour_read_off_mesh(bytes, size, NULL, 0, &count, NULL), TL_OK);
        TEST_CHECK(count == 0);
        tl_detour_tiles_free(&ours);
        tl_detour_tiles_free(&theirs);
        // Cut short, or damaged, it is refused as its own order's bytes are.
        for (uint64_t shorter = 0; shorter < size; shorter += 61) {
            uint8_t *part = copy_blob(bytes, shorter + 1);
            TEST_CHECK(tl_detour_read(part, shorter, NULL, &ours, NULL) != TL_OK);
            test_blob_free(part);
        }
        free(bytes);
    }
    tl_navmesh_destroy(navmesh);
    tl_nav_tiles_free(&tiles);
    free(level);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_soups),         cmocka_unit_test(test_hulls),
        cmocka_unit_test(test_navmesh_blobs), cmocka_unit_test(test_chunks_of_the_file),
        cmocka_unit_test(test_chunk_types),   cmocka_unit_test(test_file),
        cmocka_unit_test(test_damaged_file),  cmocka_unit_test(test_detour_of_both_orders),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
