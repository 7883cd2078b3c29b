// SPDX-License-Identifier: MIT
//
// The triangles of a level by place, so that a rebake reads those near it only.
//
// A grid of the plane, whose cells are tiles or squares of tiles; each has a list of the triangles whose boxes reach
// it, all lists in one array (counting sort). What changes is not moved from list to list: it becomes loose, and loose
// triangles are compared with each window one by one, until there are so many that the grid is made again. So a change
// costs what changed, and a question what is near. Rejected: the soup's BVH, which drops triangles without area, that
// a bake does rasterize; lists with room to grow, which take twice the memory for levels that hardly change.

#include "nav_bake/tiles/tile_bake.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/host.h"
#include "base/lowest_bit.h"
#include "nav_bake/input/range_input.h"

#include <math.h>
#include <string.h>

enum {
    MAX_CELLS_OF_ONE = 64,  // that a triangle is listed in; a larger one is loose
    SPARE_CELLS = 1024,     // more than there are triangles, at most
    MOST_CHANGED_SHARE = 4, // a quarter of all
    FEW_CHANGED = 1024,     // that are left loose in any case
    TRIANGLES_OF_A_WORD = 64
};

// Cells [first_x, end_x) by [first_z, end_z).
typedef struct cell_range {
    uint32_t first_x, first_z, end_x, end_z;
} cell_range;

struct tl_nav_triangles {
    tl_allocator allocator;
    tl_nav_def def; // without host
    tl_vec3 origin;
    double cell; // metres
    uint32_t cells_x, cells_z;
    uint32_t *first;   // [cells + 1]
    uint32_t *members; // [member_capacity]
    uint64_t member_capacity;
    uint64_t *is_loose, *is_near; // [word_count] a bit a triangle; is_near is scratch
    uint64_t word_count;
    uint32_t triangle_count;
    uint32_t changed_count; // that became loose since all were sorted
    uint32_t *found;        // [found_capacity]
    uint64_t found_capacity;
    tl_range_input part;
};

static uint64_t cell_count_of(const tl_nav_triangles *t)
{
    return (uint64_t)t->cells_x * t->cells_z;
}

static bool triangle_bit_is_set(const uint64_t *bits, uint32_t at)
{
    return (bits[at / TRIANGLES_OF_A_WORD] >> (at % TRIANGLES_OF_A_WORD) & 1) != 0;
}

static void set_triangle_bit(uint64_t *bits, uint32_t at)
{
    bits[at / TRIANGLES_OF_A_WORD] |= UINT64_C(1) << (at % TRIANGLES_OF_A_WORD);
}

// ---- Places ------------------------------------------------------------------------------------------------

// Monotone, and what lies outside belongs to the outermost cells: intervals that overlap share a cell.
static uint32_t cell_at(const tl_nav_triangles *t, float origin, uint32_t count, float at)
{
    const double cell = floor(((double)at - (double)origin) / t->cell);
    return cell <= 0.0 ? 0 : cell >= (double)count ? count - 1 : (uint32_t)cell;
}

static cell_range cells_of_box(const tl_nav_triangles *t, const tl_aabb *box)
{
    return (cell_range){ cell_at(t, t->origin.x, t->cells_x, box->min.x),
                         cell_at(t, t->origin.z, t->cells_z, box->min.z),
                         cell_at(t, t->origin.x, t->cells_x, box->max.x) + 1,
                         cell_at(t, t->origin.z, t->cells_z, box->max.z) + 1 };
}

// False: the triangle is near everywhere, for it is large, or a bake must see it to refuse it.
static bool cells_of_triangle(const tl_nav_triangles *t, const tl_mesh_view *mesh, uint32_t triangle,
                              cell_range *range_out)
{
    const uint32_t *corners = mesh->indices + 3 * (size_t)triangle;
    tl_aabb box = tl_aabb_empty();
    for (int k = 0; k < 3; k++) {
        if (corners[k] >= mesh->vertex_count || !tl_is_finite(mesh->vertices[corners[k]])) {
            return false;
        }
        box = tl_aabb_add_point(box, mesh->vertices[corners[k]]);
    }
    *range_out = cells_of_box(t, &box);
    return (uint64_t)(range_out->end_x - range_out->first_x) * (range_out->end_z - range_out->first_z) <=
           MAX_CELLS_OF_ONE;
}

// ---- The lists ---------------------------------------------------------------------------------------------

// Counts each cell's triangles in first[cell + 1], and marks the loose ones.
static uint64_t count_members(tl_nav_triangles *t, const tl_mesh_view *mesh)
{
    uint64_t members = 0;
    memset(t->first, 0, (size_t)(cell_count_of(t) + 1) * sizeof *t->first);
    memset(t->is_loose, 0, (size_t)t->word_count * sizeof *t->is_loose);
    t->changed_count = 0;
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        cell_range range;
        if (!cells_of_triangle(t, mesh, i, &range)) {
            set_triangle_bit(t->is_loose, i);
            continue;
        }
        for (uint32_t z = range.first_z; z < range.end_z; z++) {
            for (uint32_t x = range.first_x; x < range.end_x; x++) {
                t->first[(uint64_t)z * t->cells_x + x + 1]++;
                members++;
            }
        }
    }
    return members;
}

// From counts to lists; first[cell + 1] runs through the cell's list meanwhile.
static void list_members(tl_nav_triangles *t, const tl_mesh_view *mesh)
{
    uint32_t begin = 0;
    for (uint64_t c = 0; c < cell_count_of(t); c++) {
        const uint32_t count = t->first[c + 1];
        t->first[c + 1] = begin;
        begin += count;
    }
    for (uint32_t i = 0; i < mesh->triangle_count; i++) {
        cell_range range;
        if (!cells_of_triangle(t, mesh, i, &range)) {
            continue;
        }
        for (uint32_t z = range.first_z; z < range.end_z; z++) {
            for (uint32_t x = range.first_x; x < range.end_x; x++) {
                t->members[t->first[(uint64_t)z * t->cells_x + x + 1]++] = i;
            }
        }
    }
}

static tl_result list_all_triangles(tl_nav_triangles *t, const tl_mesh_view *mesh)
{
    const uint64_t count = count_members(t, mesh);
    if (count >= UINT32_MAX) {
        return TL_ERR_LIMIT;
    }
    if (count > t->member_capacity) {
        tl_release_array(&t->allocator, t->members, t->member_capacity, sizeof *t->members);
        t->member_capacity = 0;
        t->members = tl_allocate_array(&t->allocator, count, sizeof *t->members);
        if (t->members == NULL) {
            memset(t->first, 0,
                   (size_t)(cell_count_of(t) + 1) * sizeof *t->first); // all lists are empty, and all are loose
            memset(t->is_loose, 0xff, (size_t)t->word_count * sizeof *t->is_loose);
            return TL_ERR_MEMORY;
        }
        t->member_capacity = count;
    }
    list_members(t, mesh);
    return TL_OK;
}

// Room for the bits of so many triangles.
static tl_result reserve_bits(tl_nav_triangles *t, uint32_t triangle_count)
{
    const uint64_t words = (uint64_t)triangle_count / TRIANGLES_OF_A_WORD + 1;
    if (words <= t->word_count) {
        return TL_OK;
    }
    uint64_t *loose = tl_allocate_array(&t->allocator, words, sizeof *loose);
    uint64_t *near = tl_allocate_array(&t->allocator, words, sizeof *near);
    if (loose == NULL || near == NULL) {
        tl_release_array(&t->allocator, loose, words, sizeof *loose);
        tl_release_array(&t->allocator, near, words, sizeof *near);
        return TL_ERR_MEMORY;
    }
    memset(loose, 0, (size_t)words * sizeof *loose);
    memset(near, 0, (size_t)words * sizeof *near);
    if (t->word_count > 0) {
        memcpy(loose, t->is_loose, (size_t)t->word_count * sizeof *loose);
    }
    tl_release_array(&t->allocator, t->is_loose, t->word_count, sizeof *t->is_loose);
    tl_release_array(&t->allocator, t->is_near, t->word_count, sizeof *t->is_near);
    t->is_loose = loose;
    t->is_near = near;
    t->word_count = words;
    return TL_OK;
}

// ---- Making and ending -------------------------------------------------------------------------------------

// Cells as large as tiles, or so much larger that there are no more than triangles, about.
static tl_result choose_cells(tl_nav_triangles *t, uint32_t triangle_count, tl_report *report)
{
    tl_nav_config config;
    TL_TRY(tl_nav_tile_grid(&t->def, t->def.bounds, &t->cells_x, &t->cells_z, report));
    TL_TRY(tl_nav_config_from_def(&t->def, t->def.bounds, 0, 0, &config, report));
    t->origin = config.lattice.origin;
    t->cell = t->def.tile_size > 0 ? (double)t->def.tile_size * (double)config.cell_size : (double)INFINITY;
    while (cell_count_of(t) > (uint64_t)triangle_count + SPARE_CELLS) {
        t->cell *= 2.0;
        t->cells_x = t->cells_x / 2 + t->cells_x % 2;
        t->cells_z = t->cells_z / 2 + t->cells_z % 2;
    }
    return TL_OK;
}

static tl_result fill_triangles(tl_nav_triangles *t, const tl_mesh_view *mesh, tl_report *report)
{
    TL_TRY(choose_cells(t, mesh->triangle_count, report));
    t->first = tl_allocate_array(&t->allocator, cell_count_of(t) + 1, sizeof *t->first);
    if (t->first == NULL) {
        return TL_ERR_MEMORY;
    }
    TL_TRY(reserve_bits(t, mesh->triangle_count));
    t->triangle_count = mesh->triangle_count;
    return list_all_triangles(t, mesh);
}

tl_result tl_nav_triangles_create(const tl_nav_def *def, const tl_mesh_view *mesh, tl_nav_triangles **triangles_out,
                                  tl_report *report_out)
{
    tl_report_begin(report_out, "triangles");
    TL_REFUSE_NULL(triangles_out, report_out);
    *triangles_out = NULL;
    TL_REFUSE_NULL(mesh, report_out);
    const tl_nav_def defaults = tl_default_nav_def();
    def = def != NULL ? def : &defaults;
    TL_TRY(tl_def_check(def->cookie, "begin with tl_default_nav_def()", report_out));
    if (tl_aabb_is_empty(def->bounds)) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "bounds",
                               "give def->bounds, or the lattice moves when the mesh does");
    }
    const tl_allocator allocator = tl_allocator_or_default(def->host.allocator);
    tl_nav_triangles *t = tl_allocate_array(&allocator, 1, sizeof *t);
    if (t == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(t, 0, sizeof *t);
    t->allocator = allocator;
    t->def = *def;
    memset(&t->def.host, 0, sizeof t->def.host);
    const tl_result result = fill_triangles(t, mesh, report_out);
    if (result != TL_OK) {
        tl_nav_triangles_destroy(t);
        return result;
    }
    *triangles_out = t;
    return TL_OK;
}

void tl_nav_triangles_destroy(tl_nav_triangles *triangles)
{
    tl_nav_triangles *t = triangles;
    if (t == NULL) {
        return;
    }
    const tl_allocator allocator = t->allocator;
    tl_range_input_free(&t->part, &allocator);
    tl_release_array(&allocator, t->first, cell_count_of(t) + 1, sizeof *t->first);
    tl_release_array(&allocator, t->members, t->member_capacity, sizeof *t->members);
    tl_release_array(&allocator, t->is_loose, t->word_count, sizeof *t->is_loose);
    tl_release_array(&allocator, t->is_near, t->word_count, sizeof *t->is_near);
    tl_release_array(&allocator, t->found, t->found_capacity, sizeof *t->found);
    tl_release_array(&allocator, t, 1, sizeof *t);
}

// ---- Changes and questions ---------------------------------------------------------------------------------

tl_result tl_nav_triangles_change(tl_nav_triangles *triangles, const tl_mesh_view *mesh, const uint32_t *changed,
                                  uint32_t changed_count, tl_report *report_out)
{
    tl_nav_triangles *t = triangles;
    tl_report_begin(report_out, "triangles");
    TL_REFUSE_NULL(triangles, report_out);
    TL_REFUSE_NULL(mesh, report_out);
    if (changed_count > 0) {
        TL_REFUSE_NULL(changed, report_out);
    }
    for (uint32_t i = 0; i < changed_count; i++) {
        if (changed[i] >= mesh->triangle_count) {
            return tl_report_fail(report_out, TL_ERR_INDEX, "changed", i, "name triangles of the mesh");
        }
    }
    TL_TRY(reserve_bits(t, mesh->triangle_count));
    for (uint32_t i = 0; i < changed_count; i++) {
        t->changed_count += !triangle_bit_is_set(t->is_loose, changed[i]);
        set_triangle_bit(t->is_loose, changed[i]);
    }
    t->triangle_count = mesh->triangle_count;
    if (t->changed_count > FEW_CHANGED && t->changed_count > mesh->triangle_count / MOST_CHANGED_SHARE) {
        const tl_result result = list_all_triangles(t, mesh);
        return result == TL_ERR_MEMORY ? TL_OK : result; // all are loose then: slower, and as right
    }
    return TL_OK;
}

// Marks what is listed in the cells of a window, and what is loose.
static void mark_near(tl_nav_triangles *t, const tl_aabb *window)
{
    memcpy(t->is_near, t->is_loose, (size_t)t->word_count * sizeof *t->is_near);
    const cell_range range = cells_of_box(t, window);
    for (uint32_t z = range.first_z; z < range.end_z; z++) {
        const uint32_t *first = t->first + (uint64_t)z * t->cells_x;
        for (uint32_t m = first[range.first_x]; m < first[range.end_x]; m++) {
            set_triangle_bit(t->is_near, t->members[m]);
        }
    }
}

static uint32_t count_bits(uint64_t word)
{
    return tl_bit_count((uint32_t)word) + tl_bit_count((uint32_t)(word >> 32));
}

// The marked triangles, ascending.
static tl_result take_near(tl_nav_triangles *t, tl_triangle_list *list_out)
{
    const uint64_t words = (uint64_t)t->triangle_count / TRIANGLES_OF_A_WORD + 1;
    uint64_t count = 0;
    for (uint64_t w = 0; w < words; w++) {
        count += count_bits(t->is_near[w]);
    }
    if (count > t->found_capacity) {
        tl_release_array(&t->allocator, t->found, t->found_capacity, sizeof *t->found);
        t->found_capacity = 0;
        t->found = tl_allocate_array(&t->allocator, count, sizeof *t->found);
        if (t->found == NULL) {
            return TL_ERR_MEMORY;
        }
        t->found_capacity = count;
    }
    list_out->indices = t->found;
    list_out->count = 0;
    for (uint64_t w = 0; w < words; w++) {
        for (uint64_t left = t->is_near[w]; left != 0; left &= left - 1) {
            const uint64_t triangle = w * TRIANGLES_OF_A_WORD + tl_lowest_bit(left);
            if (triangle < t->triangle_count) { // others are there no more
                t->found[list_out->count++] = (uint32_t)triangle;
            }
        }
    }
    return TL_OK;
}

tl_result tl_nav_triangles_near(tl_nav_triangles *triangles, const tl_nav_input *input, tl_aabb changed,
                                tl_nav_near_triangles *near_out, tl_report *report_out)
{
    tl_nav_triangles *t = triangles;
    tl_nav_tile_range range;
    tl_aabb window;
    tl_report_begin(report_out, "triangles");
    TL_REFUSE_NULL(near_out, report_out);
    memset(near_out, 0, sizeof *near_out);
    TL_REFUSE_NULL(triangles, report_out);
    TL_REFUSE_NULL(input, report_out);
    if (input->mesh.triangle_count != t->triangle_count) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "mesh", "tell tl_nav_triangles_change of new triangles");
    }
    TL_TRY(tl_nav_tiles_in_box(&t->def, t->def.bounds, changed, &range, report_out));
    tl_range_input_free(&t->part, &t->allocator);
    tl_triangle_list list = { NULL, 0 };
    if (range.count_x > 0) {
        TL_TRY(tl_nav_range_window(&t->def, &range, &window, report_out));
        mark_near(t, &window);
        TL_TRY(take_near(t, &list));
        TL_TRY(tl_range_input_make(input, list, window, &t->allocator, &t->part));
        t->part.input.mesh.materials = NULL; // areas say all
    } else {
        t->part.input = *input;
        t->part.input.mesh.triangle_count = 0;
    }
    near_out->input = t->part.input;
    near_out->sources = t->part.triangles;
    return TL_OK;
}

uint64_t tl_nav_triangles_bytes(const tl_nav_triangles *triangles)
{
    const tl_nav_triangles *t = triangles;
    const uint64_t part = t->part.input.mesh.triangle_count * (3 * sizeof(uint32_t) + (t->part.areas != NULL));
    return sizeof *t + (cell_count_of(t) + 1) * sizeof *t->first + t->member_capacity * sizeof *t->members +
           2 * t->word_count * sizeof *t->is_loose + t->found_capacity * sizeof *t->found +
           t->part.capacity * sizeof *t->part.triangles + part;
}
