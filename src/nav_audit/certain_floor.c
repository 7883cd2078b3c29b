// SPDX-License-Identifier: MIT
//
// Floor that must outlive a bake, found without its voxels.
//
// Erosion removes a column when a chain of steps shorter than the radius, a straight one counting 1 and a diagonal one
// 1.5, leads from it to a column that lacks a walkable neighbour. So the columns that can remove one are known exactly,
// whatever lies in the others. Each of them must have walkable floor, with free height above all of the column; and
// the columns beside them floor at least, because beside a drop the filter takes a column too. Between columns the
// floor may rise or fall by half a climb less a voxel, because the filter compares a column with both of its neighbours
// when it judges a stair; where the slope changes, by less. That holds for middles of columns, which is where samples
// are taken.
//
// A circle around the point in place of the columns was rejected: it must be wider by a diagonal on every side, so
// that in corridors three radii wide, which every bake keeps, nothing would be certain.

#include "nav_audit/certain_floor.h"

#include "base/arena.h"
#include "base/assert.h"
#include "base/min_max.h"

#include <math.h>
#include <string.h>

// Blocks from the middle to a side, at most: beyond, blocks are several columns wide.
enum { MAX_FLOOR_SIDE = 26 };

// A block's parent lies in the ring before its own, so the floors of the last two rings are all that is kept: at most
// 8 (26 + 25) of them.
enum { KEPT_FLOORS = 512 };

// A floor that varies less than this share of a voxel is flat: it may still round to two neighbouring voxels.
#define FLAT_SHARE 0.02f
#define SQRT_2     1.41421356f

// What only touches a column counts as in it, and coordinates are rounded: blocks are wider by this share of a cell.
#define TOUCH_SHARE 0.01f

static uint32_t distance_of(int32_t a, int32_t b)
{
    const int32_t x = a < 0 ? -a : a, z = b < 0 ? -b : b;
    return (uint32_t)(x > z ? 2 * x + z : 2 * z + x); // in halves, as erosion counts
}

// Whether a column without walkable floor, there, removes the middle.
static bool removes_middle(int32_t x, int32_t z, uint32_t radius)
{
    return (x == 0 && z == 0) || distance_of(x - 1, z) < 2 * radius || distance_of(x + 1, z) < 2 * radius ||
           distance_of(x, z - 1) < 2 * radius || distance_of(x, z + 1) < 2 * radius;
}

static bool is_beside(int32_t x, int32_t z, uint32_t radius)
{
    return removes_middle(x - 1, z, radius) || removes_middle(x + 1, z, radius) || removes_middle(x, z - 1, radius) ||
           removes_middle(x, z + 1, radius);
}

typedef bool column_test(int32_t x, int32_t z, uint32_t radius);

static bool any_column(column_test *test, int32_t block_x, int32_t block_z, int32_t columns, uint32_t radius)
{
    const int32_t half = columns / 2;
    for (int32_t z = block_z * columns - half; z <= block_z * columns + half; z++) {
        for (int32_t x = block_x * columns - half; x <= block_x * columns + half; x++) {
            if (test(x, z, radius)) {
                return true;
            }
        }
    }
    return false;
}

static int32_t towards_middle(int32_t a, int32_t b)
{
    const int32_t size = a < 0 ? -a : a, other = b < 0 ? -b : b;
    return size < other || a == 0 ? a : a < 0 ? a + 1 : a - 1;
}

static uint32_t find_parent(const tl_audit_window *window, const tl_audit_block *block)
{
    const int32_t x = towards_middle(block->x, block->z), z = towards_middle(block->z, block->x);
    for (uint32_t i = window->count; i-- > 0;) {
        if (window->blocks[i].x == x && window->blocks[i].z == z) {
            return i;
        }
    }
    return window->count; // the middle, its own
}

static void add_level_block(tl_audit_window *window, int32_t x, int32_t z, uint32_t radius)
{
    const int32_t columns = (int32_t)window->block_columns;
    const bool walked = any_column(removes_middle, x, z, columns, radius);
    if (walked || any_column(is_beside, x, z, columns, radius)) {
        tl_audit_block *block = &window->blocks[window->count];
        block->x = x;
        block->z = z;
        block->is_walked = walked;
        block->parent = find_parent(window, block);
        window->count++;
    }
}

tl_result tl_audit_window_create(uint32_t radius, float cell_size, const tl_allocator *allocator,
                                 tl_audit_window *window_out)
{
    const uint32_t columns = (radius + 2) / MAX_FLOOR_SIDE;
    tl_audit_window *w = window_out;
    w->count = 0;
    w->block_columns = 2 * ((columns + 1) / 2) + 1;
    const int32_t side = (int32_t)((radius + 2 + w->block_columns / 2) / w->block_columns);
    w->capacity = (uint32_t)((2 * side + 1) * (2 * side + 1));
    w->reach = cell_size * ((float)side + 0.5f) * (float)w->block_columns;
    w->blocks = tl_allocate_array(allocator, w->capacity, sizeof *w->blocks);
    if (w->blocks == NULL) {
        return TL_ERR_MEMORY;
    }
    memset(w->blocks, 0, w->capacity * sizeof *w->blocks);
    // Ring by ring, so that parents stand before their children.
    for (int32_t ring = 0; ring <= side; ring++) {
        for (int32_t z = -ring; z <= ring; z++) {
            const int32_t step = z == -ring || z == ring || ring == 0 ? 1 : 2 * ring;
            for (int32_t x = -ring; x <= ring; x += step) {
                add_level_block(w, x, z, radius);
            }
        }
    }
    return TL_OK;
}

void tl_audit_window_free(tl_audit_window *window, const tl_allocator *allocator)
{
    tl_release_array(allocator, window->blocks, window->capacity, sizeof *window->blocks);
    memset(window, 0, sizeof *window);
}

// ---- The floor ---------------------------------------------------------------------------------------------

// Walkable floor of a column within a climb of a height; NULL: the highest surface there is none.
static tl_result find_level_floor(tl_audit_columns *columns, const int32_t column[2], float y, float climb,
                                  tl_audit_surface **floor_out)
{
    TL_TRY(tl_audit_find_surface(columns, column, y, climb, floor_out));
    if (*floor_out != NULL && !(*floor_out)->is_walkable) {
        *floor_out = NULL;
    }
    return TL_OK;
}

// Nothing may stand out of the floor's plane: even a low kerb's side may be the top of a column, which is not walkable
// then. The answer is kept with the surface.
static bool is_free_above(const tl_audit_job *job, uint32_t block_columns, tl_vec3 at, tl_audit_surface *floor)
{
    if (floor->free_edge != block_columns) {
        const tl_nav_config *config = &job->scene.config;
        const float voxel = config->cell_height;
        const float half = config->cell_size * (0.5f * (float)block_columns + TOUCH_SHARE);
        const float low = SQRT_2 * half * floor->rise + FLAT_SHARE * voxel;
        const float high = voxel * (float)(config->walkable_height + 2);
        const tl_convex box = tl_convex_box(tl_vec3_make(at.x, at.y + 0.5f * (low + high), at.z),
                                            tl_vec3_make(half, 0.5f * (high - low), half), 0.0f);
        bool blocked = true;
        (void)tl_soup_overlaps(job->scene.soup, &box, tl_transform_identity(), NULL, &blocked);
        floor->is_free = !blocked;
        floor->free_edge = block_columns;
    }
    return floor->is_free;
}

// Metres by which floors of neighbouring columns may differ.
static float level_climb(const tl_nav_config *config)
{
    return config->cell_height * tl_maxf(0.5f * ((float)config->walkable_climb - 1.0f), FLAT_SHARE);
}

tl_result tl_audit_follow_floor(tl_audit_columns *columns, const int32_t column[2], float *y, bool *found_out)
{
    tl_audit_surface *floor;
    TL_TRY(find_level_floor(columns, column, *y, level_climb(&columns->job->scene.config), &floor));
    *found_out = floor != NULL;
    *y = floor != NULL ? floor->y : *y;
    return TL_OK;
}

// The floor of a block, as far as its neighbours need it.
typedef struct block_floor {
    float y, rise;
} block_floor;

tl_result tl_audit_is_certain(tl_audit_columns *columns, const tl_audit_window *window, const int32_t column[2],
                              float y, bool *is_certain_out)
{
    const tl_audit_job *job = columns->job;
    const tl_nav_config *config = &job->scene.config;
    const float edge = config->cell_size * (float)window->block_columns, climb = level_climb(config);
    block_floor floors[KEPT_FLOORS];
    *is_certain_out = false;
    if (config->walkable_climb == 0) {
        return TL_OK; // two floors of one height may round to two voxels, which no climb of 0 crosses
    }
    for (uint32_t i = 0; i < window->count; i++) {
        const tl_audit_block *block = &window->blocks[i];
        const block_floor *parent = &floors[block->parent % KEPT_FLOORS];
        TL_ASSERT(i - block->parent < KEPT_FLOORS);
        const float before = i > 0 ? parent->y : y;
        const int32_t at[2] = { column[0] + block->x * (int32_t)window->block_columns,
                                column[1] + block->z * (int32_t)window->block_columns };
        tl_audit_surface *floor;
        TL_TRY(find_level_floor(columns, at, before, climb, &floor));
        if (floor == NULL) {
            return TL_OK;
        }
        // A column's voxel is as high as its highest corner.
        const float bend = i > 0 ? SQRT_2 * 0.5f * edge * fabsf(floor->rise - parent->rise) : 0.0f;
        if (fabsf(floor->y - before) + bend > climb ||
            (block->is_walked &&
             !is_free_above(job, window->block_columns, tl_audit_column_point(job, at, floor->y), floor))) {
            return TL_OK;
        }
        floors[i % KEPT_FLOORS].y = floor->y;
        floors[i % KEPT_FLOORS].rise = floor->rise;
    }
    *is_certain_out = true;
    return TL_OK;
}
