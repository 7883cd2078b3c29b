// SPDX-License-Identifier: MIT
//
// The bake of routes: gates place by place, then lengths block by block, then all that follows from them. Each tile is
// read four times, and never more than a block of places is in memory.

#include "base/arena.h"
#include "base/assert.h"
#include "base/hash.h"
#include "base/host.h"
#include "nav_world/routes.h"

#include <math.h>
#include <string.h>

typedef struct routes_bake {
    const tl_nav_routes_def *def;
    tl_allocator allocator;
    tl_nav_world *world;
    tl_report *report;
    tl_nav_gate_list found; // in the order of places
    tl_nav_gate *gates;     // in the order of cells
    tl_route_tree tree;
    tl_nav_routes *blob;
    tl_nav_query *query;
} routes_bake;

tl_nav_routes_def tl_default_nav_routes_def(void)
{
    tl_nav_routes_def def;
    memset(&def, 0, sizeof def);
    def.block = 4;
    def.cookie = TL_DEF_COOKIE;
    return def;
}

// Names what failed, unless that was done nearer to it.
static tl_result name_failure(const routes_bake *bake, tl_result result, const char *element, uint64_t index)
{
    if (bake->report != NULL && bake->report->element != NULL) {
        return result;
    }
    return tl_report_fail(bake->report, result, element, index, "merge the file again");
}

// ---------------------------------------------------------------------------------------------------------
// Some places in a navmesh of their own, in the frame of one of them.

typedef struct place_set {
    tl_navmesh *navmesh;
    uint32_t places; // that are in
} place_set;

static tl_result begin_set(const routes_bake *bake, place_set *set)
{
    set->navmesh = NULL;
    set->places = 0;
    return tl_navmesh_create(&bake->allocator, &set->navmesh);
}

static tl_result add_set_place(routes_bake *bake, place_set *set, uint32_t place, int32_t frame_x, int32_t frame_z)
{
    const tl_nav_world *world = bake->world;
    const tl_nav_world_place *at = &world->places[place];
    for (uint32_t i = 0; i < at->tile_count; i++) {
        const tl_nav_world_tile *tile = &world->tiles[at->first_tile + i];
        const char *advice = NULL;
        tl_nav_tile *blob = tl_blob_allocate(&bake->allocator, TL_NAV_TILE_MAGIC, TL_NAV_TILE_VERSION,
                                             world->index.entries[tile->entry].size);
        if (blob == NULL) {
            return tl_nav_world_no_memory(bake->report);
        }
        tl_result result = tl_nav_world_read_tile(world, tile, blob, &advice);
        if (result != TL_OK) {
            tl_blob_free(blob);
            return tl_report_fail(bake->report, result, "chunk", tile->entry, advice);
        }
        tl_nav_world_move_tile(blob, frame_x, frame_z);
        result = tl_navmesh_add_tile(set->navmesh, blob, TL_NAV_TILE_OWNED);
        if (result != TL_OK) {
            tl_blob_free(blob);
            return tl_report_fail(bake->report, result, "chunk", tile->entry, "");
        }
    }
    set->places++;
    return TL_OK;
}

// ---------------------------------------------------------------------------------------------------------
// Gates.

static tl_result find_place_gates(routes_bake *bake, uint32_t place)
{
    const tl_nav_world_place *at = &bake->world->places[place];
    place_set set;
    tl_result result = begin_set(bake, &set);
    if (result == TL_OK) {
        result = add_set_place(bake, &set, place, at->x, at->z);
    }
    for (uint32_t side = 1; result == TL_OK && side <= 2; side++) {
        if (at->neighbour[side] != TL_NAV_WORLD_NO_PLACE) {
            result = add_set_place(bake, &set, at->neighbour[side], at->x, at->z);
        }
    }
    if (result == TL_OK && set.places > 1) {
        result = tl_nav_find_gates(&bake->allocator, set.navmesh, at->x, at->z, &bake->found);
    }
    tl_navmesh_destroy(set.navmesh);
    return result;
}

// Into the order of the cells whose separators they are in, which the tree is built over again.
static tl_result sort_gates(routes_bake *bake)
{
    const uint32_t count = bake->found.count;
    tl_route_tree cells;
    tl_sort_item *items = tl_allocate_array(&bake->allocator, 2 * (uint64_t)count, sizeof *items);
    bake->gates = tl_allocate_array(&bake->allocator, count, sizeof *bake->gates);
    if (items == NULL || bake->gates == NULL) {
        tl_release_array(&bake->allocator, items, 2 * (uint64_t)count, sizeof *items);
        return tl_nav_world_no_memory(bake->report);
    }
    tl_result result = tl_route_tree_begin(&cells, &bake->allocator, bake->found.gates, count, bake->def->block);
    for (uint32_t i = 0; result == TL_OK && i < count; i++) {
        const tl_sort_item item = { tl_route_cell_of_gate(&cells, &bake->found.gates[i]), i, 0 };
        items[i] = item;
    }
    tl_route_tree_free(&cells);
    if (result == TL_OK) {
        tl_radix_sort(items, items + count, count);
        for (uint32_t i = 0; i < count; i++) {
            bake->gates[i] = bake->found.gates[items[i].value];
        }
        result = tl_route_tree_begin(&bake->tree, &bake->allocator, bake->gates, count, bake->def->block);
    }
    tl_release_array(&bake->allocator, items, 2 * (uint64_t)count, sizeof *items);
    if (result == TL_OK) {
        result = tl_route_tree_finish(&bake->tree);
    }
    return result == TL_OK ? result : tl_report_fail(bake->report, result, "gates", TL_NO_ELEMENT, "");
}

// ---------------------------------------------------------------------------------------------------------
// Lengths.

// The middle of a gate on its polygon in a place, in the frame of another place.
static bool locate_gate(const routes_bake *bake, const place_set *set, const tl_nav_gate *gate,
                        const tl_route_place *within, const tl_route_place *frame, tl_nav_location *out)
{
    const int end = gate->x == within->x && gate->z == within->z ? 0 : 1;
    double middle[2];
    tl_nav_gate_middle(gate, bake->world, frame->x, frame->z, middle);
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(set->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(set->navmesh, slot);
        if (tile != NULL && tile->tile_x == within->x - frame->x && tile->tile_z == within->z - frame->z &&
            tile->layer == gate->layer[end]) {
            out->polygon = tl_navmesh_polygon_ref(set->navmesh, slot, gate->polygon[end]);
            out->point = tl_vec3_make((float)middle[0], gate->height, (float)middle[1]);
            return true;
        }
    }
    return false;
}

// The tree's place of a cell on whose side a gate of its rim lies.
static const tl_route_place *place_of_rim(const tl_route_tree *tree, const tl_route_cell *cell, const tl_nav_gate *gate)
{
    const uint32_t place = tl_route_find_place(tree, gate->x, gate->z);
    if (place - cell->first_place < cell->place_count) {
        return &tree->places[place];
    }
    int32_t across[2];
    tl_nav_gate_across(gate, across);
    return &tree->places[tl_route_find_place(tree, across[0], across[1])];
}

// Where the gates of a cell's rim are on their polygons.
static tl_result locate_rim(const routes_bake *bake, const place_set *set, const tl_route_cell *cell,
                            const tl_route_place *frame, tl_nav_location *out)
{
    const uint32_t *rim = tl_route_rim(&bake->tree, cell);
    for (uint32_t i = 0; i < cell->rim_count; i++) {
        const tl_nav_gate *gate = &bake->gates[rim[i]];
        if (!locate_gate(bake, set, gate, place_of_rim(&bake->tree, cell, gate), frame, &out[i])) {
            return TL_ERR_CORRUPT;
        }
    }
    return TL_OK;
}

// Shortest lengths between the gates of a cell's rim, which are `at` these places, over the tiles of the set that pass.
static tl_result search_lengths(const routes_bake *bake, const place_set *set, const tl_route_cell *cell,
                                const tl_route_place *frame, const tl_nav_location *at, float *lengths)
{
    const tl_route_tree *tree = &bake->tree;
    const tl_route_place *first = &tree->places[cell->first_place];
    const double side = (double)bake->world->tile_size * (double)bake->world->cell_size;
    const double slack = tl_route_slack(side * (double)tree->block);
    int32_t place[2] = { first->x - frame->x, first->z - frame->z };
    tl_nav_filter filter = tl_default_nav_filter();
    filter.pass = tl_route_is_of_place;
    filter.user = place;
    for (uint32_t j = 1; j < cell->rim_count; j++) {
        for (uint32_t i = 0; i < j; i++) {
            const tl_nav_path_request request = { cell->is_leaf ? &filter : NULL, at[i], at[j] };
            tl_nav_shortest_path path;
            TL_TRY(tl_nav_query_find_shortest_path(bake->query, set->navmesh, &request, NULL, &path));
            if (path.status == TL_NAV_PATH_OUT_OF_NODES) {
                return TL_ERR_NODES;
            }
            lengths[cell->base + tl_route_pair(i, j)] = path.status == TL_NAV_PATH_COMPLETE
                                                            ? tl_route_round_up(path.length * (1.0 + 0x1p-32) + slack)
                                                            : INFINITY;
        }
    }
    return TL_OK;
}

static tl_result measure_cell(const routes_bake *bake, const place_set *set, const tl_route_cell *cell,
                              const tl_route_place *frame, float *lengths)
{
    tl_nav_location *at = tl_allocate_array(&bake->allocator, cell->rim_count, sizeof *at);
    if (at == NULL) {
        return tl_nav_world_no_memory(bake->report);
    }
    tl_result result = locate_rim(bake, set, cell, frame, at);
    if (result == TL_OK) {
        result = search_lengths(bake, set, cell, frame, at, lengths);
    }
    tl_release_array(&bake->allocator, at, cell->rim_count, sizeof *at);
    return result;
}

static tl_result measure_block(routes_bake *bake, const tl_route_cell *block, float *lengths)
{
    const tl_route_tree *tree = &bake->tree;
    const tl_route_place *frame = &tree->places[block->first_place];
    place_set set;
    tl_result result = begin_set(bake, &set);
    for (uint32_t i = 0; result == TL_OK && i < block->place_count; i++) {
        const tl_route_place *place = frame + i;
        const uint32_t at = tl_nav_world_find_place(bake->world, place->x, place->z);
        result = add_set_place(bake, &set, at, frame->x, frame->z);
    }
    for (uint32_t i = 0; result == TL_OK && i < block->place_count && !block->is_leaf; i++) {
        result = measure_cell(bake, &set, &tree->cells[frame[i].cell], frame, lengths);
    }
    if (result == TL_OK) {
        result = measure_cell(bake, &set, block, frame, lengths);
    }
    tl_navmesh_destroy(set.navmesh);
    return result;
}

static tl_result make_routes_blob(routes_bake *bake)
{
    const tl_route_tree *tree = &bake->tree;
    const uint64_t size =
        sizeof(tl_nav_routes) + (uint64_t)tree->gate_count * sizeof(tl_nav_gate) + tree->length_count * sizeof(float);
    bake->blob = tl_blob_allocate(&bake->allocator, TL_PACK_ROUTES_MAGIC, TL_PACK_ROUTES_VERSION, size);
    if (bake->blob == NULL) {
        return tl_nav_world_no_memory(bake->report);
    }
    const uint64_t hash = tl_route_tiles_hash(&bake->world->index);
    bake->blob->tiles_hash[0] = (uint32_t)(hash & UINT32_MAX);
    bake->blob->tiles_hash[1] = (uint32_t)(hash >> 32);
    bake->blob->gate_count = tree->gate_count;
    bake->blob->length_count = (uint32_t)tree->length_count;
    bake->blob->block = bake->def->block;
    char *gates = (char *)(bake->blob + 1);
    if (tree->gate_count > 0) {
        memcpy(gates, bake->gates, tree->gate_count * sizeof(tl_nav_gate));
    }
    float *lengths = (float *)(void *)(gates + tree->gate_count * sizeof(tl_nav_gate));
    for (uint32_t i = 0; i < tree->cell_count; i++) {
        if (tree->cells[i].is_block) {
            TL_TRY(tl_progress_update(&bake->def->host, "routes: measure blocks", i, tree->cell_count));
            const tl_result result = measure_block(bake, &tree->cells[i], lengths);
            if (result != TL_OK) {
                return name_failure(bake, result, "block", i);
            }
        }
    }
    TL_TRY(tl_progress_update(&bake->def->host, "routes: measure blocks", tree->cell_count, tree->cell_count));
    return tl_route_fill_fronts(tree, bake->world, &bake->def->host, lengths);
}

static tl_result run_bake(routes_bake *bake)
{
    const tl_nav_routes_def *def = bake->def;
    tl_nav_world_def opening = tl_default_nav_world_def();
    opening.read = def->read;
    opening.user = def->user;
    opening.allocator = &bake->allocator;
    TL_TRY(tl_nav_world_open(&opening, true, &bake->world, bake->report));
    tl_report_begin(bake->report, "bake routes");
    tl_nav_query_def query = tl_default_nav_query_def();
    query.max_nodes = 1u << 26;
    query.allocator = &bake->allocator;
    TL_TRY(tl_nav_query_create(&query, &bake->query, bake->report));
    const uint32_t places = bake->world->place_count;
    for (uint32_t i = 0; i < places; i++) {
        TL_TRY(tl_progress_update(&def->host, "routes: find gates", i, places));
        const tl_result result = find_place_gates(bake, i);
        if (result != TL_OK) {
            return name_failure(bake, result, "place", i);
        }
    }
    TL_TRY(tl_progress_update(&def->host, "routes: find gates", places, places));
    TL_TRY(sort_gates(bake));
    return make_routes_blob(bake);
}

static tl_result check_routes_def(const tl_nav_routes_def *def, tl_report *report)
{
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_routes_def()", report));
    if (def->read == NULL) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "read", "give a function that reads the file");
    }
    if (!tl_route_is_block_side(def->block)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "block", "make it 1, 2, 4, 8 or 16");
    }
    return TL_OK;
}

tl_result tl_nav_routes_bake(const tl_nav_routes_def *def, tl_nav_routes **routes_out, tl_report *report)
{
    tl_report_begin(report, "bake routes");
    TL_REFUSE_NULL(routes_out, report);
    *routes_out = NULL;
    TL_REFUSE_NULL(def, report);
    TL_TRY(check_routes_def(def, report));
    routes_bake bake;
    memset(&bake, 0, sizeof bake);
    bake.def = def;
    bake.allocator = tl_allocator_or_default(def->host.allocator);
    bake.report = report;
    const tl_result result = run_bake(&bake);
    if (result == TL_OK) {
        *routes_out = bake.blob;
    } else {
        tl_blob_free(bake.blob);
    }
    tl_route_tree_free(&bake.tree);
    tl_nav_query_destroy(bake.query);
    tl_release_array(&bake.allocator, bake.gates, bake.found.count, sizeof *bake.gates);
    tl_release_array(&bake.allocator, bake.found.gates, bake.found.capacity, sizeof *bake.found.gates);
    tl_nav_world_destroy(bake.world);
    return result;
}
