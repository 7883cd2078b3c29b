// SPDX-License-Identifier: MIT
//
// The functions of nav_tile.h under the contract.

#include "contract.h"

#include <talus/nav_tile.h>

#include <string.h>

// Two squares beside one another.
static const tl_contour_vertex SQUARES[] = {
    { 0, 0, 0, 2 }, { 0, 0, 4, 2 }, { 4, 0, 4, 2 }, { 4, 0, 0, 2 },
    { 4, 0, 0, 1 }, { 4, 0, 4, 1 }, { 8, 0, 4, 1 }, { 8, 0, 0, 1 },
};
static const tl_contour SQUARE_CONTOURS[] = { { 0, 4, 1, 1 }, { 4, 4, 2, 1 } };

static void make_source(tl_polygon_mesh *polygons, tl_nav_tile_source *source)
{
    tl_contour_set set;
    memset(&set, 0, sizeof set);
    set.vertices = SQUARES;
    set.vertex_count = 8;
    set.contours = SQUARE_CONTOURS;
    set.contour_count = 2;
    set.bounds.max = tl_vec3_make(8, 1, 4);
    set.cell_size = set.cell_height = 1.0f;
    set.width = 8;
    set.height = 4;
    TEST_RESULT(tl_polygon_mesh_bake(&set, NULL, polygons, NULL), TL_OK);
    memset(source, 0, sizeof *source);
    source->polygons = polygons;
    source->agent_height = 2.0f;
}

static tl_nav_tile *make_tile(void)
{
    tl_polygon_mesh polygons;
    tl_nav_tile_source source;
    tl_nav_tile *tile;
    make_source(&polygons, &source);
    TEST_RESULT(tl_nav_tile_encode(&source, NULL, &tile, NULL), TL_OK);
    tl_polygon_mesh_free(&polygons);
    return tile;
}

static tl_result take_tile(contract_run *run, tl_result result, tl_nav_tile *tile)
{
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || tile == NULL;
    run->answer = result == TL_OK ? contract_hash(tile, (size_t)tile->blob.size, 0) : 0;
    tl_blob_free(tile);
    return result;
}

static const char *const SOURCE_FIELDS[] = { "agent_height", "agent_radius", "agent_max_climb", "tile_size", "tile_x",
                                             "tile_z",       "origin",       "layer",           NULL };

static tl_result nav_tile_encode(contract_run *run)
{
    tl_polygon_mesh polygons;
    tl_nav_tile_source source;
    make_source(&polygons, &source);
    if (run->what == CONTRACT_BAD_FIELD) {
        source.agent_height = run->variant == 0 ? 0.0f : 2.0f;
        source.agent_radius = run->variant == 1 ? -1.0f : 0.0f;
        source.agent_max_climb = run->variant == 2 ? -1.0f : 0.0f;
        source.tile_size = run->variant == 3 ? UINT32_MAX : 0;
        source.tile_x = run->variant == 4;
        source.tile_z = run->variant == 5;
        source.origin.x = run->variant == 6 ? 100.0f : 0.0f;
        source.layer = run->variant == 7 ? TL_NAV_MAX_LAYER + 1 : 0;
    }
    tl_nav_tile *tile = NULL;
    const tl_result result = tl_nav_tile_encode(run->what == CONTRACT_NULL_INPUT ? NULL : &source, run->host->allocator,
                                                run->what == CONTRACT_NULL_OUTPUT ? NULL : &tile, run->report);
    tl_polygon_mesh_free(&polygons);
    return take_tile(run, result, tile);
}

static tl_result nav_tile_subset(contract_run *run)
{
    tl_nav_tile *tile = make_tile(), *subset = NULL;
    const uint8_t keep[2] = { 1, 0 };
    const bool no_input = run->what == CONTRACT_NULL_INPUT;
    const tl_result result =
        tl_nav_tile_subset(no_input && run->variant == 0 ? NULL : tile, no_input && run->variant == 1 ? NULL : keep,
                           run->host->allocator, run->what == CONTRACT_NULL_OUTPUT ? NULL : &subset, run->report);
    tl_blob_free(tile);
    return take_tile(run, result, subset);
}

static tl_result nav_tile_divide(contract_run *run)
{
    tl_nav_tile *tile = make_tile();
    const uint32_t layers[2] = { 0, 1 };
    tl_nav_tile_stack stack;
    memset(&stack, 0x55, sizeof stack);
    const bool no_input = run->what == CONTRACT_NULL_INPUT;
    const tl_result result =
        tl_nav_tile_divide(no_input && run->variant == 0 ? NULL : tile, no_input && run->variant == 1 ? NULL : layers,
                           run->host->allocator, run->what == CONTRACT_NULL_OUTPUT ? NULL : &stack, run->report);
    run->is_clear = run->what == CONTRACT_NULL_OUTPUT || contract_is_zero(&stack, sizeof stack);
    if (result == TL_OK) {
        run->answer = contract_hash(stack.tiles[1], (size_t)stack.tiles[1]->blob.size, stack.count);
        tl_nav_tile_stack_free(&stack);
    }
    tl_blob_free(tile);
    return result;
}

static tl_result nav_tile_check(contract_run *run)
{
    static const uint64_t NO_TILE[16] = { 1, 2, 3 };
    tl_nav_tile *tile = make_tile();
    const uint64_t size = tile->blob.size;
    tl_result result = TL_OK;
    if (run->what == CONTRACT_BAD_BYTES) {
        result = tl_nav_tile_check(NO_TILE, sizeof NO_TILE, run->report);
    } else {
        result = tl_nav_tile_check(run->what == CONTRACT_NULL_INPUT ? NULL : tile, size, run->report);
    }
    run->is_clear = true;
    tl_blob_free(tile);
    return result;
}

static tl_result nav_tile_frees(contract_run *run)
{
    tl_nav_tile_stack stack;
    tl_nav_detail detail;
    (void)run;
    memset(&stack, 0, sizeof stack);
    memset(&detail, 0, sizeof detail);
    tl_nav_tile_stack_free(NULL);
    tl_nav_tile_stack_free(&stack);
    tl_nav_detail_free(NULL);
    tl_nav_detail_free(&detail);
    return TL_OK;
}

static tl_result nav_tile_copy(contract_run *run)
{
    tl_nav_tile *tile = make_tile(), *copy = NULL;
    const tl_result result = tl_nav_tile_copy(run->what == CONTRACT_NULL_INPUT ? NULL : tile, true,
                                              run->host->allocator, run->what == CONTRACT_NULL_OUTPUT ? NULL : &copy);
    tl_blob_free(tile);
    return take_tile(run, result, copy);
}

static tl_result nav_tile_reads(contract_run *run)
{
    tl_nav_tile *tile = make_tile();
    TEST_CHECK(tl_nav_tile_polygon_area(tile, 0) == 16.0);
    tl_nav_tile_fit_boxes(tile); // nothing was moved
    TEST_RESULT(tl_nav_tile_check(tile, tile->blob.size, NULL), TL_OK);
    for (uint32_t edge = 0; edge < 4; edge++) {
        run->answer += tl_nav_tile_neighbour(tile, 0, edge) == 1;
    }
    TEST_CHECK(run->answer == 1);
    tl_blob_free(tile);
    return TL_OK;
}

#define BAKES                                                                                                          \
    CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) |            \
        CONTRACT_BIT(NO_MEMORY)

const contract_entry CONTRACT_TABLE_nav_tile[] = {
    { "tl_nav_detail_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, nav_tile_frees, NULL },
    { "tl_nav_tile_encode", BAKES | CONTRACT_BIT(BAD_FIELD), 1, 1, SOURCE_FIELDS, nav_tile_encode, NULL },
    { "tl_nav_tile_subset", BAKES, 2, 1, NULL, nav_tile_subset, NULL },
    { "tl_nav_tile_stack_free", CONTRACT_BIT(NULL_FREE), 0, 0, NULL, nav_tile_frees, NULL },
    { "tl_nav_tile_divide", BAKES, 2, 1, NULL, nav_tile_divide, NULL },
    { "tl_nav_tile_check",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_REPORT) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(BAD_BYTES), 1, 0, NULL,
      nav_tile_check, NULL },
    { "tl_nav_tile_copy",
      CONTRACT_BIT(GOOD) | CONTRACT_BIT(NULL_INPUT) | CONTRACT_BIT(NULL_OUTPUT) | CONTRACT_BIT(NO_MEMORY), 1, 1, NULL,
      nav_tile_copy, NULL },
    { "tl_nav_tile_fit_boxes", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_tile_reads, NULL },
    { "tl_nav_tile_neighbour", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_tile_reads, NULL },
    { "tl_nav_tile_polygon_area", CONTRACT_BIT(GOOD), 0, 0, NULL, nav_tile_reads, NULL },
    { 0 },
};
