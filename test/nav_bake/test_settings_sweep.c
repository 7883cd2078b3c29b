// SPDX-License-Identifier: MIT
//
// Random settings on the built-in levels, and on real ones where they are: every tile's polygons pass the validator
// (convex, simple, disjoint, covering their contours, linked both ways), every baked tile passes its check, and all
// tiles of a level go into one navmesh, where each way from polygon to polygon, over seams too, has one back.
// An argument sets the number of settings a level, and files behind it take the place of the real levels:
// test_settings_sweep 500 [LEVEL ...].

#include "talus_test.h"

#include "cli/sample/sample_level.h"
#include "io/mesh/mesh_import.h"

#include <talus/nav_bake.h>
#include <talus/nav_query.h>

#include <stdio.h>
#include <string.h>

static uint32_t settings_a_level = 12;
static char **wanted_files; // ends with NULL

typedef struct sweep_counts {
    uint32_t tiles, polygons, tiled, solo, repaired;
    uint32_t partitions[3], methods[3], with_areas;
    uint64_t links, filtered_spans;
} sweep_counts;

static tl_nav_def random_def(test_random *random)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = test_random_range(random, 0.15f, 0.65f);
    def.cell_height = test_random_range(random, 0.05f, 0.35f);
    def.agent_radius = test_random_range(random, 0.0f, 1.0f);
    def.agent_height = test_random_range(random, 0.5f, 2.5f);
    def.agent_max_climb = test_random_range(random, 0.0f, 1.2f);
    def.agent_max_slope = test_random_range(random, 0.0f, 80.0f);
    def.region_min_size = test_random_range(random, 0.0f, 10.0f);
    def.region_merge_size = test_random_range(random, 0.0f, 30.0f);
    def.edge_max_len = test_random_range(random, 0.0f, 20.0f);
    def.edge_max_error = test_random_range(random, 0.0f, 3.0f);
    def.max_verts_per_poly = 3 + test_random_below(random, 8);
    def.detail_sample_dist = test_random_range(random, 0.0f, 8.0f);
    def.partition = (tl_nav_partition)test_random_below(random, 3);
    def.polygon_method = (tl_partition_method)test_random_below(random, 3);
    def.tile_size = test_random_below(random, 2) == 0 ? 0 : 16 + test_random_below(random, 100);
    return def;
}

static void check_tile(const tl_nav_config *config, const tl_nav_input *input, const char *name, tl_navmesh *navmesh,
                       sweep_counts *counts)
{
    tl_host host = { NULL, NULL, NULL };
    tl_nav_stages stages = { 0 };
    tl_nav_tile *tile;
    TEST_RESULT(tl_nav_tile_bake(config, input, &host, &stages, &tile, NULL), TL_OK);
    tl_polygon_check_report report;
    if (tl_polygon_mesh_check(&stages.polygons, &stages.contours.set, NULL, &report) != TL_OK) {
        fail_msg("%s, tile %u, %u of cells of %g m: %s", name, config->tile_x, config->tile_z,
                 (double)config->cell_size, tl_polygon_fault_text(report.first_fault));
    }
    if (tile != NULL) {
        TEST_RESULT(tl_nav_tile_check(tile, ((const tl_blob *)tile)->size, NULL), TL_OK);
        TEST_RESULT(tl_navmesh_add_tile(navmesh, tile, TL_NAV_TILE_OWNED), TL_OK);
    }
    counts->tiles++;
    counts->polygons += stages.polygons.polygon_count;
    counts->repaired += stages.polygons.note_count;
    counts->filtered_spans += stages.compact.region_stats.filtered_spans;
    tl_nav_stages_free(&stages);
}

static bool leads_to(const tl_navmesh *navmesh, tl_nav_ref from, tl_nav_ref to)
{
    tl_nav_link links[256];
    uint32_t count;
    TEST_RESULT(tl_navmesh_links(navmesh, from, links, 256, &count), TL_OK);
    for (uint32_t i = 0; i < count; i++) {
        if (links[i].to == to) {
            return true;
        }
    }
    return false;
}

static void check_links(const tl_navmesh *navmesh, const char *name, sweep_counts *counts)
{
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            tl_nav_link links[256];
            uint32_t count;
            const tl_nav_ref from = tl_navmesh_polygon_ref(navmesh, slot, p);
            TEST_RESULT(tl_navmesh_links(navmesh, from, links, 256, &count), TL_OK);
            for (uint32_t i = 0; i < count; i++) {
                if (!leads_to(navmesh, links[i].to, from)) {
                    fail_msg("%s, tile %d, %d, polygon %u: a link leads one way", name, tile->tile_x, tile->tile_z, p);
                }
            }
            counts->links += count;
        }
    }
}

// An area for every few triangles, and one for what lies in a cylinder in the middle.
static uint8_t *make_areas(const tl_mesh *mesh, tl_nav_volume *volume)
{
    uint8_t *areas = malloc(mesh->triangle_count);
    for (uint32_t t = 0; t < mesh->triangle_count; t++) {
        areas[t] = (uint8_t)(t / 61 % 256);
    }
    const tl_vec3 middle = tl_aabb_center(mesh->bounds), size = tl_aabb_size(mesh->bounds);
    memset(volume, 0, sizeof *volume);
    volume->kind = TL_NAV_VOLUME_CYLINDER;
    volume->area = 255;
    volume->base = tl_vec3_make(middle.x, mesh->bounds.min.y, middle.z);
    volume->radius = 0.2f * size.x;
    volume->height = size.y;
    return areas;
}

static void sweep_level(const tl_mesh_view *view, const char *name, uint64_t seed, sweep_counts *counts)
{
    tl_mesh mesh;
    TEST_RESULT(tl_mesh_bake(view, NULL, &mesh, NULL), TL_OK);
    tl_nav_volume volume;
    uint8_t *areas = make_areas(&mesh, &volume);
    const tl_nav_input plain = { tl_mesh_as_view(&mesh), NULL, NULL, 0 };
    const tl_nav_input marked = { plain.mesh, areas, &volume, 1 };
    test_random random = { seed };
    for (uint32_t i = 0; i < settings_a_level; i++) {
        tl_nav_def def = random_def(&random);
        uint32_t tiles_x;
        uint32_t tiles_z;
        TEST_RESULT(tl_nav_tile_grid(&def, mesh.bounds, &tiles_x, &tiles_z, NULL), TL_OK);
        tl_navmesh *navmesh;
        TEST_RESULT(tl_navmesh_create(NULL, &navmesh), TL_OK);
        for (uint32_t t = 0; t < tiles_x * tiles_z; t++) {
            tl_nav_config config;
            TEST_RESULT(tl_nav_config_from_def(&def, mesh.bounds, t % tiles_x, t / tiles_x, &config, NULL), TL_OK);
            check_tile(&config, i % 3 == 2 ? &marked : &plain, name, navmesh, counts);
        }
        check_links(navmesh, name, counts);
        tl_navmesh_destroy(navmesh);
        *(def.tile_size == 0 ? &counts->solo : &counts->tiled) += 1;
        counts->partitions[def.partition]++;
        counts->with_areas += i % 3 == 2;
        counts->methods[def.polygon_method]++;
    }
    free(areas);
    tl_mesh_free(&mesh);
}

static void print_counts(const sweep_counts *counts)
{
    print_message("%u tiles, %u polygons, %llu links, %u repaired contours, %llu floors of small islands dropped; "
                  "%u settings in one tile, %u in tiles, %u with areas\n",
                  counts->tiles, counts->polygons, (unsigned long long)counts->links, counts->repaired,
                  (unsigned long long)counts->filtered_spans, counts->solo, counts->tiled, counts->with_areas);
}

static void built_in_levels(void **state)
{
    (void)state;
    sweep_counts counts = { 0 };
    uint32_t count;
    const tl_sample_level *levels = tl_sample_levels(&count);
    for (uint32_t i = 0; i < count; i++) {
        tl_sample_mesh mesh;
        TEST_RESULT(tl_sample_build_level(&levels[i], 4000, i + 1, &mesh), TL_OK);
        tl_mesh_view view = tl_sample_mesh_as_view(&mesh);
        sweep_level(&view, levels[i].name, i, &counts);
        tl_sample_mesh_free(&mesh);
    }
    print_counts(&counts);
    TEST_CHECK(counts.polygons > 2000 && counts.solo > 10 && counts.tiled > 10);
    TEST_CHECK(counts.partitions[0] > 5 && counts.partitions[1] > 5 && counts.partitions[2] > 5);
    TEST_CHECK(counts.methods[0] > 5 && counts.methods[1] > 5 && counts.methods[2] > 5 && counts.links > 2000);
}

static bool sweep_file(const char *path, const char *name, uint32_t seed, sweep_counts *counts)
{
    tl_imported_mesh mesh;
    if (tl_import_mesh(path, NULL, &mesh, NULL) != TL_OK) {
        return false;
    }
    tl_mesh_view view = tl_imported_mesh_as_view(&mesh);
    sweep_level(&view, name, seed, counts);
    tl_imported_mesh_free(&mesh);
    return true;
}

static void real_levels(void **state)
{
    (void)state;
    static const char *const names[] = { "nav_test",    "dungeon",    "collision_mesh_01",
                                         "proto-level", "undulating", "test_map01" };
    sweep_counts counts = { 0 };
    for (uint32_t i = 0; i < 6 && *wanted_files == NULL; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/levels/%s.obj", TALUS_DATA_DIR, names[i]);
        (void)sweep_file(path, names[i], i, &counts);
    }
    for (uint32_t i = 0; wanted_files[i] != NULL; i++) {
        if (!sweep_file(wanted_files[i], wanted_files[i], i, &counts)) {
            fail_msg("%s cannot be read", wanted_files[i]);
        }
    }
    print_counts(&counts);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        settings_a_level = (uint32_t)strtoul(argv[1], NULL, 10);
    }
    wanted_files = argv + (argc < 2 ? argc : 2);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(built_in_levels),
        cmocka_unit_test(real_levels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
