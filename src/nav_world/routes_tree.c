// SPDX-License-Identifier: MIT
//
// The tree of places over which lengths are known: nested dissection of the grid by halving it, x and z in turn, which
// is a Patricia trie over the places' interleaved coordinates. Separators are straight seams, which are as short as a
// grid of tiles has them. Rejected: a partition by minimum cuts, which finds rivers and walls, but has to be stored,
// and gains little where half of the seams are open.

#include "base/arena.h"
#include "base/assert.h"
#include "nav_world/routes.h"

#include <math.h>
#include <string.h>

static uint64_t spread_place_bits(uint32_t value)
{
    uint64_t v = value;
    v = (v | v << 16) & UINT64_C(0x0000ffff0000ffff);
    v = (v | v << 8) & UINT64_C(0x00ff00ff00ff00ff);
    v = (v | v << 4) & UINT64_C(0x0f0f0f0f0f0f0f0f);
    v = (v | v << 2) & UINT64_C(0x3333333333333333);
    return (v | v << 1) & UINT64_C(0x5555555555555555);
}

static uint64_t place_code(int32_t x, int32_t z)
{
    return spread_place_bits((uint32_t)x) | spread_place_bits((uint32_t)z) << 1;
}

static uint32_t find_code(const tl_route_tree *tree, uint64_t code)
{
    uint32_t low = 0, high = tree->place_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (tree->places[middle].code < code) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < tree->place_count && tree->places[low].code == code ? low : UINT32_MAX;
}

uint32_t tl_route_find_place(const tl_route_tree *tree, int32_t x, int32_t z)
{
    return x < 0 || z < 0 ? UINT32_MAX : find_code(tree, place_code(x, z));
}

static tl_result gather_route_places(tl_route_tree *tree)
{
    const uint64_t most = 2 * (uint64_t)tree->gate_count;
    tl_sort_item *items = tl_allocate_array(&tree->allocator, 2 * most, sizeof *items);
    if (items == NULL) {
        return TL_ERR_MEMORY;
    }
    for (uint32_t i = 0; i < tree->gate_count; i++) {
        const tl_nav_gate *gate = &tree->gates[i];
        int32_t across[2];
        tl_nav_gate_across(gate, across);
        const tl_sort_item own = { place_code(gate->x, gate->z), i, 0 };
        const tl_sort_item other = { place_code(across[0], across[1]), i, 1 };
        items[2 * (size_t)i] = own;
        items[2 * (size_t)i + 1] = other;
    }
    tl_radix_sort(items, items + most, (uint32_t)most);
    uint32_t count = 0;
    for (uint64_t i = 0; i < most; i++) {
        count += i == 0 || items[i].key != items[i - 1].key;
    }
    tree->places = tl_allocate_array(&tree->allocator, count, sizeof *tree->places);
    for (uint64_t i = 0; tree->places != NULL && i < most; i++) {
        if (i > 0 && items[i].key == items[i - 1].key) {
            continue;
        }
        const tl_nav_gate *gate = &tree->gates[items[i].value];
        int32_t at[2] = { gate->x, gate->z };
        if (items[i].extra != 0) {
            tl_nav_gate_across(gate, at);
        }
        const tl_route_place place = { items[i].key, at[0], at[1], TL_ROUTE_NO_CELL };
        tree->places[tree->place_count++] = place;
    }
    tl_release_array(&tree->allocator, items, 2 * most, sizeof *items);
    return tree->places == NULL ? TL_ERR_MEMORY : TL_OK;
}

static uint32_t highest_bit(uint64_t bits)
{
    uint32_t bit = 0;
    for (uint32_t step = 32; step > 0; step /= 2) {
        if (bits >> step != 0) {
            bits >>= step;
            bit += step;
        }
    }
    return bit;
}

// Cells that are open while places come by rising code: those on the way down to the last place.
typedef struct open_cells {
    uint32_t cells[TL_ROUTE_MAX_DEPTH];
    uint32_t bits[TL_ROUTE_MAX_DEPTH]; // the highest bit in which the places of a cell and of the one before differ
    uint32_t count;
} open_cells;

static tl_route_cell *new_cell(tl_route_tree *tree, uint32_t first_place, uint32_t place_count)
{
    tl_route_cell *cell = &tree->cells[tree->cell_count++];
    memset(cell, 0, sizeof *cell);
    cell->parent = TL_ROUTE_NO_CELL;
    cell->child[0] = TL_ROUTE_NO_CELL;
    cell->child[1] = TL_ROUTE_NO_CELL;
    cell->first_place = first_place;
    cell->place_count = place_count;
    return cell;
}

static void join_last_two(tl_route_tree *tree, open_cells *open, uint32_t block_bits)
{
    const uint32_t number = tree->cell_count;
    const uint32_t left = open->cells[open->count - 2], right = open->cells[open->count - 1];
    tl_route_cell *cell =
        new_cell(tree, tree->cells[left].first_place, tree->cells[left].place_count + tree->cells[right].place_count);
    cell->child[0] = left;
    cell->child[1] = right;
    cell->is_above = open->bits[open->count - 1] >= block_bits;
    tree->cells[left].parent = number;
    tree->cells[right].parent = number;
    open->count--;
    open->cells[open->count - 1] = number;
}

tl_result tl_route_tree_begin(tl_route_tree *tree, const tl_allocator *allocator, const tl_nav_gate *gates,
                              uint32_t gate_count, uint32_t block)
{
    memset(tree, 0, sizeof *tree);
    tree->allocator = tl_allocator_or_default(allocator);
    tree->gates = gates;
    tree->gate_count = gate_count;
    tree->block = block;
    if (gate_count == 0) {
        return TL_OK;
    }
    TL_TRY(gather_route_places(tree));
    tree->cells = tl_allocate_array(&tree->allocator, 2 * (uint64_t)tree->place_count, sizeof *tree->cells);
    if (tree->cells == NULL) {
        return TL_ERR_MEMORY;
    }
    const uint32_t block_bits = 2 * highest_bit(block);
    open_cells open;
    open.count = 0;
    for (uint32_t i = 0; i < tree->place_count; i++) {
        const uint32_t bit = i == 0 ? 64 : highest_bit(tree->places[i - 1].code ^ tree->places[i].code);
        while (open.count > 1 && open.bits[open.count - 1] < bit) {
            join_last_two(tree, &open, block_bits);
        }
        tree->places[i].cell = tree->cell_count;
        open.bits[open.count] = bit;
        open.cells[open.count++] = tree->cell_count;
        new_cell(tree, i, 1)->is_leaf = true;
    }
    while (open.count > 1) {
        join_last_two(tree, &open, block_bits);
    }
    for (uint32_t i = 0; i < tree->cell_count; i++) {
        tl_route_cell *cell = &tree->cells[i];
        cell->is_block = !cell->is_above && (cell->parent == TL_ROUTE_NO_CELL || tree->cells[cell->parent].is_above);
    }
    return TL_OK;
}

// The leaves of the two places that a gate lies between.
static void leaves_of_gate(const tl_route_tree *tree, const tl_nav_gate *gate, uint32_t leaves[2])
{
    int32_t across[2];
    tl_nav_gate_across(gate, across);
    leaves[0] = tree->places[find_code(tree, place_code(gate->x, gate->z))].cell;
    leaves[1] = tree->places[find_code(tree, place_code(across[0], across[1]))].cell;
}

// The smallest cell that holds two cells. Parents have higher numbers.
static uint32_t common_cell(const tl_route_tree *tree, uint32_t a, uint32_t b)
{
    while (a != b) {
        if (a < b) {
            a = tree->cells[a].parent;
        } else {
            b = tree->cells[b].parent;
        }
    }
    return a;
}

uint32_t tl_route_cell_of_gate(const tl_route_tree *tree, const tl_nav_gate *gate)
{
    uint32_t leaves[2];
    leaves_of_gate(tree, gate, leaves);
    return common_cell(tree, leaves[0], leaves[1]);
}

// ---------------------------------------------------------------------------------------------------------
// Separators and rims.

static tl_result count_separators(tl_route_tree *tree)
{
    uint32_t before = 0;
    for (uint32_t i = 0; i < tree->gate_count; i++) {
        uint32_t leaves[2];
        leaves_of_gate(tree, &tree->gates[i], leaves);
        const uint32_t number = common_cell(tree, leaves[0], leaves[1]);
        tl_route_cell *cell = &tree->cells[number];
        if (number < before) {
            return TL_ERR_CORRUPT;
        }
        before = number;
        cell->first_gate = cell->gate_count == 0 ? i : cell->first_gate;
        cell->gate_count++;
        tree->cells[leaves[0]].rim_count++;
        tree->cells[leaves[1]].rim_count++;
    }
    return TL_OK;
}

// Lengths of a cell, laid out behind those of the cells before.
static void place_lengths(tl_route_tree *tree, tl_route_cell *cell)
{
    const uint64_t rim = cell->rim_count, gates = cell->gate_count, front = gates * (gates + rim);
    cell->base = tree->length_count;
    tree->length_count += cell->is_leaf || cell->is_block ? rim * (rim > 0 ? rim - 1 : 0) / 2 : 0;
    cell->upper = tree->length_count;
    tree->length_count += front;
    cell->lower = tree->length_count;
    tree->length_count += cell->is_above ? front : 0;
}

static tl_result lay_out_cells(tl_route_tree *tree)
{
    for (uint32_t i = 0; i < tree->cell_count; i++) {
        tl_route_cell *cell = &tree->cells[i];
        if (!cell->is_leaf) {
            cell->rim_count =
                tree->cells[cell->child[0]].rim_count + tree->cells[cell->child[1]].rim_count - 2 * cell->gate_count;
        }
        if (tree->rim_count > UINT32_MAX / 4) {
            return TL_ERR_LIMIT;
        }
        cell->first_rim = (uint32_t)tree->rim_count;
        tree->rim_count += cell->rim_count;
        place_lengths(tree, cell);
        if (tree->length_count > UINT32_MAX) {
            return TL_ERR_LIMIT;
        }
    }
    for (uint32_t i = tree->cell_count; i > 0; i--) {
        tl_route_cell *cell = &tree->cells[i - 1];
        const uint32_t above = cell->parent == TL_ROUTE_NO_CELL ? 0 : tree->cells[cell->parent].chain;
        cell->chain = above + cell->gate_count + cell->rim_count;
        tree->longest_chain = cell->chain > tree->longest_chain ? cell->chain : tree->longest_chain;
    }
    return TL_OK;
}

// The rims of two cells, less the gates between them.
static void join_rims(const tl_route_tree *tree, const tl_route_cell *cell)
{
    const tl_route_cell *a = &tree->cells[cell->child[0]], *b = &tree->cells[cell->child[1]];
    const uint32_t *of_a = tl_route_rim(tree, a), *of_b = tl_route_rim(tree, b);
    uint32_t *out = tree->rims + cell->first_rim;
    uint32_t i = cell->gate_count, j = cell->gate_count;
    while (i < a->rim_count || j < b->rim_count) {
        const bool from_a = j >= b->rim_count || (i < a->rim_count && of_a[i] < of_b[j]);
        *out++ = from_a ? of_a[i] : of_b[j];
        i += from_a;
        j += !from_a;
    }
}

tl_result tl_route_tree_finish(tl_route_tree *tree)
{
    TL_TRY(count_separators(tree));
    TL_TRY(lay_out_cells(tree));
    if (tree->gate_count == 0) {
        return TL_OK;
    }
    tree->rims = tl_allocate_array(&tree->allocator, tree->rim_count, sizeof *tree->rims);
    uint32_t *filled = tl_allocate_array(&tree->allocator, tree->place_count, sizeof *filled);
    if (tree->rims != NULL && filled != NULL) {
        memset(filled, 0, tree->place_count * sizeof *filled);
        for (uint32_t i = 0; i < tree->gate_count; i++) {
            uint32_t leaves[2];
            leaves_of_gate(tree, &tree->gates[i], leaves);
            for (int k = 0; k < 2; k++) {
                const tl_route_cell *leaf = &tree->cells[leaves[k]];
                tree->rims[leaf->first_rim + filled[leaf->first_place]++] = i;
            }
        }
        for (uint32_t i = 0; i < tree->cell_count; i++) {
            if (!tree->cells[i].is_leaf) {
                join_rims(tree, &tree->cells[i]);
            }
        }
    }
    const bool fits = tree->rims != NULL && filled != NULL;
    tl_release_array(&tree->allocator, filled, tree->place_count, sizeof *filled);
    return fits ? TL_OK : TL_ERR_MEMORY;
}

void tl_route_tree_free(tl_route_tree *tree)
{
    tl_release_array(&tree->allocator, tree->rims, tree->rim_count, sizeof *tree->rims);
    tl_release_array(&tree->allocator, tree->cells, 2 * (uint64_t)tree->place_count, sizeof *tree->cells);
    // Places were allocated as many as they are.
    tl_release_array(&tree->allocator, tree->places, tree->place_count, sizeof *tree->places);
    memset(tree, 0, sizeof *tree);
}

uint32_t tl_route_rim_index(const tl_route_tree *tree, const tl_route_cell *cell, uint32_t gate)
{
    const uint32_t *rim = tl_route_rim(tree, cell);
    uint32_t low = 0, high = cell->rim_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (rim[middle] < gate) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < cell->rim_count && rim[low] == gate ? low : UINT32_MAX;
}

bool tl_route_is_of_place(const tl_nav_tile *tile, uint32_t polygon, void *user)
{
    const int32_t *place = (const int32_t *)user;
    (void)polygon;
    return tile->tile_x == place[0] && tile->tile_z == place[1];
}

// ---------------------------------------------------------------------------------------------------------
// Gates in the plane.

// The seam that a gate lies on, and its ends along it, in lattice steps from the lattice's origin.
static int64_t gate_line(const tl_nav_gate *gate, const tl_nav_world *world, int64_t ends[2])
{
    const int64_t size = (int64_t)world->tile_size;
    const int64_t along = gate->side == 2 ? gate->z : gate->x, across = gate->side == 2 ? gate->x : gate->z;
    ends[0] = along * size + gate->low;
    ends[1] = along * size + gate->high;
    return (across + 1) * size;
}

void tl_nav_gate_middle(const tl_nav_gate *gate, const tl_nav_world *world, int32_t from_x, int32_t from_z,
                        double out[2])
{
    int64_t ends[2];
    const int64_t line = gate_line(gate, world, ends), size = (int64_t)world->tile_size;
    const double along = 0.5 * (double)(ends[0] + ends[1] - 2 * size * (gate->side == 2 ? from_z : from_x));
    const double across = (double)(line - size * (gate->side == 2 ? from_x : from_z));
    out[gate->side == 2 ? 0 : 1] = across * (double)world->cell_size;
    out[gate->side == 2 ? 1 : 0] = along * (double)world->cell_size;
}

double tl_nav_gate_distance_to(const tl_nav_gate *gate, const tl_nav_world *world, const double at[2])
{
    int64_t ends[2];
    const double cell = (double)world->cell_size, line = (double)gate_line(gate, world, ends) * cell;
    const double x = at[0] - (double)world->lattice_origin.x, z = at[1] - (double)world->lattice_origin.z;
    const double across = (gate->side == 2 ? x : z) - line;
    const double along = tl_nav_world_gap(gate->side == 2 ? z : x, (double)ends[0] * cell, (double)ends[1] * cell);
    return sqrt(across * across + along * along);
}

double tl_nav_gate_distance(const tl_nav_gate *a, const tl_nav_gate *b, const tl_nav_world *world)
{
    int64_t along_a[2], along_b[2], box_a[2][2], box_b[2][2];
    const int64_t line_a = gate_line(a, world, along_a), line_b = gate_line(b, world, along_b);
    double gap[2];
    for (int axis = 0; axis < 2; axis++) {
        for (int end = 0; end < 2; end++) {
            box_a[axis][end] = (a->side == 2) == (axis == 0) ? line_a : along_a[end];
            box_b[axis][end] = (b->side == 2) == (axis == 0) ? line_b : along_b[end];
        }
        const int64_t ahead = box_b[axis][0] - box_a[axis][1], behind = box_a[axis][0] - box_b[axis][1];
        const int64_t least = ahead > behind ? ahead : behind;
        gap[axis] = least > 0 ? (double)least * (double)world->cell_size : 0.0;
    }
    return sqrt(gap[0] * gap[0] + gap[1] * gap[1]);
}
