// SPDX-License-Identifier: MIT
//
// The functions of nav_bake.h under the contract. Those of triangles by place stand in contract_nav_triangles.c.

#include "contract_nav_def.h"

// The level baked as one tile, with all that lies in between. Made once, from malloc.
typedef struct baked_level {
    tl_nav_def def;
    tl_nav_config config;
    tl_nav_stages stages;
    tl_nav_tile *tile;
} baked_level;

static const baked_level *baked(void)
{
    static baked_level level;
    if (level.tile == NULL) {
        level.def = tl_default_nav_def();
        level.def.bounds = CONTRACT_LEVEL_BOUNDS;
        TEST_RESULT(tl_nav_config_from_def(&level.def, CONTRACT_LEVEL_BOUNDS, 0, 0, &level.config, NULL), TL_OK);
        TEST_RESULT(
            tl_nav_tile_bake(&level.config, &contract_level_get()->nav_input, NULL, &level.stages, &level.tile, NULL),
            TL_OK);
    }
    return &level;
}

// A compact heightfield of the caller's own, up to its distance field.
static tl_nav_compact make_compact(void)
{
    const baked_level *level = baked();
    tl_nav_compact compact;
    TEST_RESULT(tl_nav_filter_and_compact(&level->config, &level->stages.heightfield, NULL, &compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_erode(&level->config, NULL, &compact, NULL), TL_OK);
    TEST_RESULT(tl_nav_distance_field(NULL, &compact, NULL), TL_OK);
    return compact;
}

static uint64_t compact_hash(const tl_nav_compact *compact)
{
    uint64_t hash = contract_hash(compact->area, compact->span_count, compact->span_count);
    if (compact->distance != NULL) {
        hash = contract_hash(compact->distance, compact->span_count * sizeof *compact->distance, hash);
    }
    if (compact->region != NULL) {
        hash = contract_hash(compact->region, compact->span_count * sizeof *compact->region, hash);
    }
    return hash;
}

static uint64_t tile_hash(const tl_nav_tile *tile, uint64_t seed)
{
    return contract_hash(tile, (size_t)tile->blob.size, seed);
}

// ---- Defs ----------------------------------------------------------------------------------------------------

static tl_result nav_tile_grid(contract_run *run)
{
    tl_nav_def def = contract_nav_def(run, 0);
    uint32_t x = 9, z = 9;
    const bool no_x = run->what == CONTRACT_NULL_OUTPUT && run->variant == 0;
    const bool no_z = run->what == CONTRACT_NULL_OUTPUT && run->variant == 1;
    const tl_result result = tl_nav_tile_grid(run->what == CONTRACT_NULL_DEF ? NULL : &def, CONTRACT_LEVEL_BOUNDS,
                                              no_x ? NULL : &x, no_z ? NULL : &z, run->report);
    run->is_clear = no_x || no_z || (x == 0 && z == 0);
    run->answer = 1000 * x + z;
    return result;
}

static tl_result nav_config_from_def(contract_run *run)
{
    tl_nav_def def = contract_nav_def(run, 0);
    tl_nav_config config;
    memset(&config, 0x55, sizeof config);
    const tl_result result =
        tl_nav_config_from_def(run->what == CONTRACT_NULL_DEF ? NULL : &def, CONTRACT_LEVEL_BOUNDS, 0, 0,
                               run->what == CONTRACT_NULL_OUTPUT ? NULL : &config, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&config, sizeof config);
    run->answer = config.width + 1000u * config.walkable_height;
    return result;
}

static tl_result nav_tiles_in_box(contract_run *run)
{
    tl_nav_def def = contract_nav_def(run, 0);
    const tl_aabb box = { { 1, 0, 1 }, { 2, 1, 2 } };
    tl_nav_tile_range range = { 9, 9, 9, 9 };
    const tl_result result = tl_nav_tiles_in_box(run->what == CONTRACT_NULL_DEF ? NULL : &def, CONTRACT_LEVEL_BOUNDS,
                                                 box, run->what == CONTRACT_NULL_OUTPUT ? NULL : &range, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&range, sizeof range);
    run->answer = range.count_x + range.count_z;
    return result;
}

// ---- Stages --------------------------------------------------------------------------------------------------

static tl_result nav_rasterize(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_heightfield field;
    memset(&field, 0x55, sizeof field);
    const tl_result result =
        tl_nav_rasterize(contract_input_is_null(run, 0) ? NULL : &level->config,
                         contract_input_is_null(run, 1) ? NULL : &contract_level_get()->view, NULL, run->host,
                         run->what == CONTRACT_NULL_OUTPUT ? NULL : &field, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&field, sizeof field);
    if (result == TL_OK) {
        run->answer = contract_hash(field.spans, field.span_count * sizeof *field.spans, 0);
        tl_nav_heightfield_free(&field);
    }
    return result;
}

static tl_result nav_filters(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_heightfield field;
    TEST_RESULT(tl_nav_rasterize(&level->config, &contract_level_get()->view, NULL, NULL, &field, NULL), TL_OK);
    tl_nav_filter_low_hanging_obstacles(&level->config, &field);
    tl_nav_filter_ledge_spans(&level->config, &field);
    tl_nav_filter_walkable_low_height_spans(&level->config, &field);
    run->answer = contract_hash(field.spans, field.span_count * sizeof *field.spans, 0);
    tl_nav_heightfield_free(&field);
    return TL_OK;
}

typedef tl_result compact_fn(const tl_nav_config *config, const tl_nav_heightfield *field, const tl_host *host,
                             tl_nav_compact *compact_out, tl_report *report_out);

static tl_result compact_by(contract_run *run, compact_fn *fn)
{
    const baked_level *level = baked();
    tl_nav_compact compact;
    memset(&compact, 0x55, sizeof compact);
    const tl_result result = fn(contract_input_is_null(run, 0) ? NULL : &level->config,
                                contract_input_is_null(run, 1) ? NULL : &level->stages.heightfield, run->host,
                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &compact, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&compact, sizeof compact);
    if (result == TL_OK) {
        run->answer = compact_hash(&compact);
        tl_nav_compact_free(&compact);
    }
    return result;
}

static tl_result nav_bake_compact(contract_run *run)
{
    return compact_by(run, tl_nav_bake_compact);
}

static tl_result nav_filter_and_compact(contract_run *run)
{
    return compact_by(run, tl_nav_filter_and_compact);
}

static tl_result end_compact(contract_run *run, tl_result result, tl_nav_compact *compact)
{
    run->is_clear = true; // the heightfield is changed in place
    run->answer = compact_hash(compact);
    tl_nav_compact_free(compact);
    return result;
}

static tl_result nav_erode(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_compact compact = make_compact();
    const tl_result result = tl_nav_erode(contract_input_is_null(run, 0) ? NULL : &level->config, run->host,
                                          contract_input_is_null(run, 1) ? NULL : &compact, run->report);
    return end_compact(run, result, &compact);
}

static tl_result nav_distance_field(contract_run *run)
{
    tl_nav_compact compact = make_compact();
    return end_compact(
        run, tl_nav_distance_field(run->host, contract_input_is_null(run, 0) ? NULL : &compact, run->report), &compact);
}

static tl_result nav_bake_regions(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_compact compact = make_compact();
    const tl_result result = tl_nav_bake_regions(contract_input_is_null(run, 0) ? NULL : &level->config, run->host,
                                                 contract_input_is_null(run, 1) ? NULL : &compact, run->report);
    return end_compact(run, result, &compact);
}

static tl_result nav_mark_areas(contract_run *run)
{
    const tl_vec3 points[3] = { { 1, 0, 1 }, { 3, 0, 1 }, { 1, 0, 3 } };
    tl_nav_volume volume;
    tl_nav_compact compact = make_compact();
    memset(&volume, 0, sizeof volume);
    volume.kind = TL_NAV_VOLUME_CYLINDER;
    volume.area = 7;
    volume.radius = volume.height = 1.0f;
    volume.base = tl_vec3_make(4, 0, 4);
    tl_nav_mark_box_area(&compact, CONTRACT_LEVEL_BOUNDS, 5);
    tl_nav_mark_polygon_area(&compact, points, 3, -1.0f, 1.0f, 6);
    tl_nav_mark_cylinder_area(&compact, tl_vec3_make(5, 0, 5), 1.0f, 1.0f, 7);
    tl_nav_mark_volume_area(&compact, &volume);
    return end_compact(run, TL_OK, &compact);
}

static tl_result nav_bake_contours(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_contours contours;
    memset(&contours, 0x55, sizeof contours);
    const tl_result result =
        tl_nav_bake_contours(contract_input_is_null(run, 0) ? NULL : &level->config,
                             contract_input_is_null(run, 1) ? NULL : &level->stages.compact, run->host,
                             run->what == CONTRACT_NULL_OUTPUT ? NULL : &contours, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&contours, sizeof contours);
    if (result == TL_OK) {
        run->answer =
            contract_hash(contours.set.vertices, contours.set.vertex_count * sizeof *contours.set.vertices, 0);
        tl_nav_contours_free(&contours);
    }
    return result;
}

static tl_result nav_bake_detail(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_detail detail;
    memset(&detail, 0x55, sizeof detail);
    const tl_result result =
        tl_nav_bake_detail(contract_input_is_null(run, 0) ? NULL : &level->config,
                           contract_input_is_null(run, 1) ? NULL : &level->stages.compact,
                           contract_input_is_null(run, 2) ? NULL : &level->stages.polygons, run->host,
                           run->what == CONTRACT_NULL_OUTPUT ? NULL : &detail, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&detail, sizeof detail);
    if (result == TL_OK) {
        run->answer = contract_hash(detail.vertices, detail.vertex_count * sizeof *detail.vertices, 0);
        tl_nav_detail_free(&detail);
    }
    return result;
}

static tl_result nav_areas_from_materials(contract_run *run)
{
    const uint8_t area = 9;
    uint8_t areas[64] = { 0 };
    tl_nav_areas_from_materials(&contract_level_get()->view, &area, 1, areas);
    run->answer = contract_hash(areas, sizeof areas, 0);
    TEST_CHECK(areas[0] == 9);
    return TL_OK;
}

static tl_result nav_assign_layers(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_config config = level->config;
    uint32_t layers[64] = { 0 };
    config.layer_height = 8;
    TEST_CHECK(level->stages.polygons.polygon_count <= 64);
    const tl_result result =
        tl_nav_assign_layers(contract_input_is_null(run, 0) ? NULL : &config,
                             contract_input_is_null(run, 1) ? NULL : &level->stages.polygons, run->host->allocator,
                             run->what == CONTRACT_NULL_OUTPUT ? NULL : layers, run->report);
    run->is_clear = contract_is_zero(layers, sizeof layers);
    run->answer = contract_hash(layers, sizeof layers, 0);
    return result;
}

// ---- Tiles ---------------------------------------------------------------------------------------------------

static tl_result nav_tile_bake(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_tile *tile = (tl_nav_tile *)(uintptr_t)1;
    tl_nav_stages stages;
    memset(&stages, 0x55, sizeof stages);
    tl_nav_bake_report report = { 0 };
    const tl_result result =
        tl_nav_tile_bake(contract_input_is_null(run, 0) ? NULL : &level->config,
                         contract_input_is_null(run, 1) ? NULL : &contract_level_get()->nav_input, run->host, &stages,
                         run->what == CONTRACT_NULL_OUTPUT ? NULL : &tile, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = contract_is_zero(&stages, sizeof stages) && (run->what == CONTRACT_NULL_OUTPUT || tile == NULL);
    if (result == TL_OK) {
        run->answer = tile_hash(tile, 0);
        tl_blob_free(tile);
        tl_nav_stages_free(&stages);
    }
    return result;
}

static tl_result end_stack(contract_run *run, tl_result result, const tl_nav_bake_report *report,
                           tl_nav_tile_stack *stack, tl_nav_compact *compact)
{
    run->own_report = report->base;
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(stack, sizeof *stack);
    if (result == TL_OK) {
        run->answer = tile_hash(stack->tiles[0], stack->count);
        tl_nav_tile_stack_free(stack);
    }
    tl_nav_compact_free(compact);
    return result;
}

static tl_result nav_tile_bake_from_compact(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_compact compact = make_compact();
    tl_nav_tile_stack stack;
    memset(&stack, 0x55, sizeof stack);
    tl_nav_bake_report report = { 0 };
    const tl_result result = tl_nav_tile_bake_from_compact(
        contract_input_is_null(run, 0) ? NULL : &level->config, contract_input_is_null(run, 1) ? NULL : &compact,
        run->host, run->what == CONTRACT_NULL_OUTPUT ? NULL : &stack, run->wants_report ? &report : NULL);
    return end_stack(run, result, &report, &stack, &compact);
}

static tl_result nav_tile_rebake(contract_run *run)
{
    const baked_level *level = baked();
    tl_nav_compact compact = make_compact();
    uint8_t base[8192];
    TEST_CHECK(compact.span_count <= sizeof base);
    memcpy(base, compact.area, compact.span_count);
    const tl_aabb crate = { { 2, -1, 2 }, { 4, 1, 4 } };
    tl_nav_mark_box_area(&compact, crate, TL_NAV_NULL_AREA);
    tl_nav_tile_memo *memo = NULL;
    tl_nav_tile_stack stack;
    memset(&stack, 0x55, sizeof stack);
    tl_nav_bake_report report = { 0 };
    const tl_result result = tl_nav_tile_rebake(
        contract_input_is_null(run, 0) ? NULL : &level->config, contract_input_is_null(run, 1) ? NULL : &compact,
        contract_input_is_null(run, 2) ? NULL : base, contract_input_is_null(run, 3) ? NULL : &memo, run->host,
        run->what == CONTRACT_NULL_OUTPUT ? NULL : &stack, run->wants_report ? &report : NULL);
    if (run->what == CONTRACT_GOOD) { // the crate stands within the level
        TEST_CHECK(tl_nav_tile_keeps_bytes(&level->config, &compact, compact.area));
        TEST_CHECK(!tl_nav_tile_keeps_bytes(&level->config, &compact, base));
    }
    TEST_CHECK((memo != NULL) == (result == TL_OK) && (memo == NULL || tl_nav_tile_memo_bytes(memo) > 0));
    tl_nav_tile_memo_free(memo);
    return end_stack(run, result, &report, &stack, &compact);
}

static tl_result nav_bake(contract_run *run)
{
    tl_nav_def def = contract_nav_def(run, 0);
    if (run->what != CONTRACT_ZEROED_DEF) {
        def.bounds = tl_aabb_empty(); // as the default, for the case of NULL
    }
    tl_nav_tiles tiles;
    memset(&tiles, 0x55, sizeof tiles);
    tl_nav_bake_report report = { 0 };
    const tl_result result =
        tl_nav_bake(run->what == CONTRACT_NULL_DEF ? NULL : &def,
                    contract_input_is_null(run, 0) ? NULL : &contract_level_get()->nav_input,
                    run->what == CONTRACT_NULL_OUTPUT ? NULL : &tiles, run->wants_report ? &report : NULL);
    run->own_report = report.base;
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&tiles, sizeof tiles);
    if (result == TL_OK) {
        run->answer = tile_hash(tiles.tiles[0], tiles.tile_count);
        tl_nav_tiles_free(&tiles);
    }
    return result;
}

static tl_result end_block(contract_run *run, tl_result result, const tl_nav_bake_report *report,
                           tl_nav_tile_block *block)
{
    run->own_report = report->base;
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(block, sizeof *block);
    if (result == TL_OK) {
        run->answer = tile_hash(block->stacks[0].tiles[0], block->range.count_x);
        tl_nav_tile_block_free(block);
    }
    return result;
}

static tl_result nav_bake_range(contract_run *run)
{
    tl_nav_def def = contract_nav_def(run, 32);
    const tl_nav_tile_range range = { 0, 0, 1, 1 };
    tl_nav_tile_block block;
    memset(&block, 0x55, sizeof block);
    tl_nav_bake_report report = { 0 };
    const tl_result result =
        tl_nav_bake_range(&def, contract_input_is_null(run, 0) ? NULL : &contract_level_get()->nav_input, range, NULL,
                          run->what == CONTRACT_NULL_OUTPUT ? NULL : &block, run->wants_report ? &report : NULL);
    return end_block(run, result, &report, &block);
}

static tl_result nav_rebake(contract_run *run)
{
    tl_nav_def def = contract_nav_def(run, 32);
    const tl_aabb changed = { { 1, 0, 1 }, { 2, 1, 2 } };
    tl_nav_tile_block block;
    memset(&block, 0x55, sizeof block);
    tl_nav_bake_report report = { 0 };
    const tl_result result =
        tl_nav_rebake(&def, contract_input_is_null(run, 0) ? NULL : &contract_level_get()->nav_input, changed,
                      run->what == CONTRACT_NULL_OUTPUT ? NULL : &block, run->wants_report ? &report : NULL);
    return end_block(run, result, &report, &block);
}

static tl_result nav_bake_frees(contract_run *run)
{
    tl_nav_heightfield field;
    tl_nav_compact compact;
    tl_nav_contours contours;
    tl_nav_stages stages;
    tl_nav_tiles tiles;
    tl_nav_tile_block block;
    (void)run;
    memset(&field, 0, sizeof field);
    memset(&compact, 0, sizeof compact);
    memset(&contours, 0, sizeof contours);
    memset(&stages, 0, sizeof stages);
    memset(&tiles, 0, sizeof tiles);
    memset(&block, 0, sizeof block);
    tl_nav_heightfield_free(NULL);
    tl_nav_heightfield_free(&field);
    tl_nav_compact_free(NULL);
    tl_nav_compact_free(&compact);
    tl_nav_contours_free(NULL);
    tl_nav_contours_free(&contours);
    tl_nav_stages_free(NULL);
    tl_nav_stages_free(&stages);
    tl_nav_tiles_free(NULL);
    tl_nav_tiles_free(&tiles);
    tl_nav_tile_block_free(NULL);
    tl_nav_tile_block_free(&block);
    tl_nav_tile_memo_free(NULL);
    return TL_OK;
}

#define FREES CONTRACT_BIT(NULL_FREE), 0, 0, NULL, nav_bake_frees, NULL

const contract_entry CONTRACT_TABLE_nav_bake[] = {
    { "tl_default_nav_def", 0, 0, 0, NULL, NULL, "returns the defaults" },
    { "tl_nav_tile_grid", CALLS | CONTRACT_BIT(NULL_DEF) | DEFS | OUTPUT, 0, 2, CONTRACT_NAV_DEF_FIELDS, nav_tile_grid,
      NULL },
    { "tl_nav_config_from_def", CALLS | CONTRACT_BIT(NULL_DEF) | DEFS | OUTPUT, 0, 1, CONTRACT_NAV_DEF_FIELDS,
      nav_config_from_def, NULL },
    { "tl_nav_rasterize", STAGE, 2, 1, NULL, nav_rasterize, NULL },
    { "tl_nav_heightfield_free", FREES },
    { "tl_nav_filter_low_hanging_obstacles", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_filters, NULL },
    { "tl_nav_filter_ledge_spans", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_filters, NULL },
    { "tl_nav_filter_walkable_low_height_spans", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_filters, NULL },
    { "tl_nav_bake_compact", STAGE, 2, 1, NULL, nav_bake_compact, NULL },
    { "tl_nav_filter_and_compact", STAGE, 2, 1, NULL, nav_filter_and_compact, NULL },
    { "tl_nav_compact_free", FREES },
    { "tl_nav_erode", CALLS | INPUT | WORKS, 2, 0, NULL, nav_erode, NULL },
    { "tl_nav_mark_box_area", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_mark_areas, NULL },
    { "tl_nav_mark_polygon_area", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_mark_areas, NULL },
    { "tl_nav_mark_cylinder_area", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_mark_areas, NULL },
    { "tl_nav_mark_volume_area", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_mark_areas, NULL },
    { "tl_nav_distance_field", CALLS | INPUT | WORKS, 1, 0, NULL, nav_distance_field, NULL },
    { "tl_nav_bake_regions", CALLS | INPUT | WORKS, 2, 0, NULL, nav_bake_regions, NULL },
    { "tl_nav_bake_contours", STAGE, 2, 1, NULL, nav_bake_contours, NULL },
    { "tl_nav_contours_free", FREES },
    { "tl_nav_bake_detail", STAGE, 3, 1, NULL, nav_bake_detail, NULL },
    { "tl_nav_areas_from_materials", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_areas_from_materials, NULL },
    { "tl_nav_stages_free", FREES },
    { "tl_nav_assign_layers", CALLS | INPUT | OUTPUT | CONTRACT_BIT(NO_MEMORY), 2, 1, NULL, nav_assign_layers, NULL },
    { "tl_nav_tile_bake", STAGE, 2, 1, NULL, nav_tile_bake, NULL },
    { "tl_nav_tile_bake_from_compact", STAGE, 2, 1, NULL, nav_tile_bake_from_compact, NULL },
    { "tl_nav_tile_rebake", STAGE, 4, 1, NULL, nav_tile_rebake, NULL },
    { "tl_nav_tile_keeps_bytes", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_tile_rebake, NULL },
    { "tl_nav_tile_memo_free", FREES },
    { "tl_nav_tile_memo_bytes", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_tile_rebake, NULL },
    { "tl_nav_bake", STAGE | CONTRACT_BIT(NULL_DEF) | DEFS, 1, 1, CONTRACT_NAV_DEF_FIELDS, nav_bake, NULL },
    { "tl_nav_tiles_free", FREES },
    { "tl_nav_tiles_in_box", CALLS | CONTRACT_BIT(NULL_DEF) | DEFS | OUTPUT, 0, 1, CONTRACT_NAV_DEF_FIELDS,
      nav_tiles_in_box, NULL },
    { "tl_nav_bake_range", STAGE | DEFS, 1, 1, CONTRACT_NAV_DEF_FIELDS, nav_bake_range, NULL },
    { "tl_nav_rebake", STAGE | DEFS, 1, 1, CONTRACT_NAV_DEF_FIELDS, nav_rebake, NULL },
    { "tl_nav_tile_block_free", FREES },
    { 0 },
};
