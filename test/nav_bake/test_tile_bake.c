// SPDX-License-Identifier: MIT
//
// One tile through all stages: order of the stages, what is kept and freed, areas, the same bytes always, failing and
// cancelling anywhere.

#include "base/hash.h"
#include "nav_fields.h"
#include "nav_level.h"

#include <math.h>

static test_level LEVEL;

static tl_nav_config level_config(float cell_size, tl_nav_partition partition)
{
    tl_nav_def def = tl_default_nav_def();
    def.cell_size = cell_size;
    def.agent_radius = 0.4f;
    def.partition = partition;
    def.region_min_size = 3;
    tl_nav_config config;
    TEST_RESULT(tl_nav_config_from_def(&def, test_level_bounds(&LEVEL), 0, 0, &config, NULL), TL_OK);
    return config;
}

static tl_nav_tile *build(const tl_nav_config *config, const tl_nav_input *input, tl_nav_bake_report *report)
{
    tl_nav_tile *tile;
    TEST_RESULT(tl_nav_tile_bake(config, input, NULL, NULL, &tile, report), TL_OK);
    if (tile != NULL) {
        TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    }
    return tile;
}

static bool same_tile(const tl_nav_tile *a, const tl_nav_tile *b)
{
    return a->blob.size == b->blob.size && memcmp(a, b, a->blob.size) == 0;
}

static void every_partition_builds(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    for (int p = TL_NAV_WATERSHED; p <= TL_NAV_LAYERS; p++) {
        tl_nav_config config = level_config(0.2f, (tl_nav_partition)p);
        tl_nav_bake_report report;
        tl_nav_tile *tile = build(&config, &input, &report);
        TEST_CHECK(tile->polygon_count == report.polygon_count && report.polygon_count > 15);
        TEST_CHECK(report.tile_count == 1 && report.contour_count > 0 && report.region_count > 0);
        TEST_CHECK(report.span_count > report.compact_span_count && report.compact_span_count > 8000);
        TEST_CHECK(report.detail_triangle_count >= report.polygon_count && report.base.peak_bytes > 100000);
        // The ground but for walls and blocks, and the bridge over it, each less the agent's radius.
        TEST_CHECK(tile->area > 330 && tile->area < 390);
        TEST_CHECK(tile->bounds.max.y > 3.0f && tile->bounds.min.y < 2.3f);
        tl_blob_free(tile);
    }
}

static void kept_stages_are_whole(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_config config = level_config(0.2f, TL_NAV_WATERSHED);
    test_allocator memory;
    test_allocator_init(&memory, 0);
    tl_host host = { &memory.allocator, NULL, NULL };
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    tl_nav_tile *kept, *lean;
    tl_nav_bake_report kept_report, lean_report;
    TEST_RESULT(tl_nav_tile_bake(&config, &input, &host, NULL, &lean, &lean_report), TL_OK);
    TEST_CHECK(memory.live_blocks == 1 &&
               memory.live_bytes == TL_BLOB_ALIGNMENT + lean->blob.size); // whose it is, and the blob
    TEST_RESULT(tl_nav_tile_bake(&config, &input, &host, &stages, &kept, &kept_report), TL_OK);
    TEST_CHECK(same_tile(lean, kept));
    TEST_CHECK(stages.heightfield.span_count == kept_report.span_count);
    TEST_CHECK(stages.compact.distance != NULL && stages.compact.region != NULL);
    TEST_CHECK(stages.contours.set.contour_count == kept_report.contour_count);
    TEST_CHECK(stages.polygons.polygon_count == kept->polygon_count);
    TEST_CHECK(stages.detail.patch_count == kept->polygon_count);
    TEST_CHECK(lean_report.base.peak_bytes < kept_report.base.peak_bytes);
    // The stages hold no trace of the build's own allocator.
    tl_nav_heightfield_free(&stages.heightfield);
    tl_nav_compact_free(&stages.compact);
    tl_nav_stages_free(&stages);
    tl_blob_free(lean);
    tl_blob_free(kept);
    TEST_CHECK(memory.live_blocks == 0 && memory.live_bytes == 0);
}

static void volumes_give_areas_and_cut_holes(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_config config = level_config(0.2f, TL_NAV_WATERSHED);
    tl_vec3 points[3] = { { 16, 0, 1 }, { 16, 0, 7 }, { 23, 0, 4 } };
    tl_nav_volume volumes[3];
    memset(volumes, 0, sizeof volumes);
    volumes[0].kind = TL_NAV_VOLUME_BOX;
    volumes[0].area = 5;
    volumes[0].box = (tl_aabb){ { 1, -3, 8 }, { 6, 3, 10 } };
    volumes[1].kind = TL_NAV_VOLUME_POLYGON;
    volumes[1].area = TL_NAV_NULL_AREA;
    volumes[1].box = (tl_aabb){ { 0, -3, 0 }, { 0, 3, 0 } };
    volumes[1].points = points;
    volumes[1].point_count = 3;
    volumes[2].kind = TL_NAV_VOLUME_CYLINDER;
    volumes[2].area = 9;
    volumes[2].base = tl_vec3_make(16, 2.5f, 12.2f); // on the bridge, not below
    volumes[2].radius = 2;
    volumes[2].height = 2;
    tl_nav_input plain = { LEVEL.mesh, NULL, NULL, 0 }, marked = { LEVEL.mesh, NULL, volumes, 3 };
    tl_nav_tile *before = build(&config, &plain, NULL), *after = build(&config, &marked, NULL);
    double box = 0, cylinder = 0, other = 0, lowest = 1e9;
    for (uint32_t p = 0; p < after->polygon_count; p++) {
        uint8_t area = tl_nav_tile_area(after, p);
        double size = tl_nav_tile_polygon_area(after, p);
        uint32_t count;
        const tl_vec3 *corners = tl_nav_tile_corners(after, p, &count);
        for (uint32_t k = 0; area == 9 && k < count; k++) {
            lowest = fmin(lowest, (double)corners[k].y);
        }
        box += area == 5 ? size : 0;
        cylinder += area == 9 ? size : 0;
        other += area == TL_NAV_WALKABLE_AREA ? size : 0;
    }
    TEST_CHECK(fabs(box - 10) < 1);
    TEST_CHECK(cylinder > 4 && cylinder < 8 && lowest > 3);
    TEST_CHECK(fabs(before->area - (box + cylinder + other) - 21) < 2); // the triangle's area
    tl_blob_free(before);
    tl_blob_free(after);
}

// Areas by triangle reach the tile, and triangles of area 0 are no floors.
static void triangles_bring_their_areas(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_config config = level_config(0.2f, TL_NAV_MONOTONE);
    uint8_t areas[TEST_LEVEL_MAX_TRIANGLES];
    memset(areas, 0, sizeof areas);
    areas[0] = 7; // half of the ground
    tl_nav_input input = { LEVEL.mesh, areas, NULL, 0 };
    tl_nav_tile *tile = build(&config, &input, NULL);
    for (uint32_t p = 0; p < tile->polygon_count; p++) {
        TEST_CHECK(tl_nav_tile_area(tile, p) == 7);
    }
    TEST_CHECK(tile->area > 100 && tile->area < 230);
    tl_blob_free(tile);
    areas[0] = 0;
    TEST_CHECK(build(&config, &input, NULL) == NULL); // nothing walkable is no error
}

static void the_same_bytes_always(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(100.7f, -3, 55.1f));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_config config = level_config(0.13f, TL_NAV_WATERSHED);
    tl_nav_tile *first = build(&config, &input, NULL), *other;
    test_random random = { 1 };
    for (uint32_t round = 0; round < 3; round++) {
        for (uint32_t i = LEVEL.mesh.triangle_count; i > 1; i--) {
            uint32_t k = test_random_below(&random, i), swapped[3];
            memcpy(swapped, LEVEL.indices + 3 * k, sizeof swapped);
            memcpy(LEVEL.indices + 3 * k, LEVEL.indices + 3 * (i - 1), sizeof swapped);
            memcpy(LEVEL.indices + 3 * (i - 1), swapped, sizeof swapped);
        }
        tl_tasks tasks;
        test_backward_tasks(&tasks, 1 + round);
        tl_host host = { NULL, &tasks, NULL };
        TEST_RESULT(tl_nav_tile_bake(&config, &input, &host, NULL, &other, NULL), TL_OK);
        TEST_CHECK(same_tile(first, other));
        tl_blob_free(other);
    }
    TEST_CHECK(tl_hash_bytes(first, first->blob.size, 0) == 0x0a5bd4f852d8f2c2u);
    tl_blob_free(first);
}

static const char *const STAGES[] = { "rasterize", "compact",  "erode",    "areas",  "distance field",
                                      "regions",   "contours", "polygons", "detail", "tile" };

typedef struct stage_log {
    tl_progress progress;
    uint32_t stage; ///< how many stages have begun
    uint64_t done;
    bool ended;
} stage_log;

static bool log_stage(const char *stage, uint64_t done, uint64_t total, void *user)
{
    stage_log *log = user;
    if (log->stage == 0 || strcmp(stage, STAGES[log->stage - 1]) != 0) {
        TEST_CHECK(log->stage < sizeof STAGES / sizeof STAGES[0] && (log->stage == 0 || log->ended));
        assert_string_equal(stage, STAGES[log->stage]);
        TEST_CHECK(done == 0);
        log->stage++;
        log->done = 0;
    }
    TEST_CHECK(done >= log->done && done <= total);
    log->done = done;
    log->ended = done == total;
    return true;
}

static void stages_are_told_in_order(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_config config = level_config(0.2f, TL_NAV_WATERSHED);
    stage_log log = { { log_stage, &log }, 0, 0, false };
    tl_host host = { NULL, NULL, &log.progress };
    tl_nav_tile *tile;
    TEST_RESULT(tl_nav_tile_bake(&config, &input, &host, NULL, &tile, NULL), TL_OK);
    TEST_CHECK(log.stage == sizeof STAGES / sizeof STAGES[0] && log.ended);
    tl_blob_free(tile);
}

// Bakes the level's tile with a host that fails at some point. Nothing of what it took is left.
static tl_result bake_and_free(float cell_size, tl_host host, bool keeps_stages, const test_allocator *memory)
{
    tl_nav_input input = { LEVEL.mesh, NULL, NULL, 0 };
    tl_nav_config config = level_config(cell_size, TL_NAV_WATERSHED);
    tl_nav_stages stages;
    memset(&stages, 0, sizeof stages);
    tl_nav_tile *tile;
    tl_nav_bake_report report;
    tl_result result = tl_nav_tile_bake(&config, &input, &host, keeps_stages ? &stages : NULL, &tile, &report);
    TEST_CHECK((tile != NULL) == (result == TL_OK) && report.base.stage != NULL);
    tl_blob_free(tile);
    tl_nav_stages_free(&stages);
    TEST_CHECK(memory->live_blocks == 0 && memory->live_bytes == 0);
    return result;
}

static void cancelling_anywhere_leaves_nothing(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    for (uint32_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, 0);
        test_progress progress;
        test_progress_init(&progress, k);
        tl_host host = { &memory.allocator, NULL, &progress.progress };
        const tl_result result = bake_and_free(0.3f, host, k % 2 == 0, &memory);
        if (result == TL_OK) {
            TEST_CHECK(k > 20);
            break;
        }
        TEST_RESULT(result, TL_ERR_CANCELLED);
    }
}

static void failing_memory_anywhere_leaves_nothing(void **state)
{
    (void)state;
    test_level_make(&LEVEL, tl_vec3_make(0, 0, 0));
    for (uint64_t k = 1;; k++) {
        test_allocator memory;
        test_allocator_init(&memory, k);
        tl_host host = { &memory.allocator, NULL, NULL };
        const tl_result result = bake_and_free(0.5f, host, k % 2 == 0, &memory);
        if (result == TL_OK) {
            TEST_CHECK(k > 20);
            break;
        }
        TEST_RESULT(result, TL_ERR_MEMORY);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_partition_builds),
        cmocka_unit_test(kept_stages_are_whole),
        cmocka_unit_test(volumes_give_areas_and_cut_holes),
        cmocka_unit_test(triangles_bring_their_areas),
        cmocka_unit_test(the_same_bytes_always),
        cmocka_unit_test(stages_are_told_in_order),
        cmocka_unit_test(cancelling_anywhere_leaves_nothing),
        cmocka_unit_test(failing_memory_anywhere_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
