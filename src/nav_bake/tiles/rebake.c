// SPDX-License-Identifier: MIT
//
// Which tiles a change can touch, and rebaking them.
//
// A tile depends on its own columns and on a border of its neighbours' only. So a change inside a box can touch the
// tiles whose columns, border included, meet it; all others keep their bytes.

#include "base/assert.h"
#include "base/host.h"
#include "nav_bake/tiles/tile_bake.h"

#include <math.h>
#include <string.h>

// The tiles along one axis of the level.
typedef struct tile_axis {
    float origin;    // metres
    float cell_size; // metres
    uint32_t size;   // of a tile, columns
    uint32_t border; // columns
    uint32_t tiles;
} tile_axis;

// Tiles whose columns [t * size - border, (t + 1) * size + border) meet [min, max], metres. One column more on each
// side pays for the rounding of the division.
static void tiles_along(const tile_axis *axis, float min, float max, uint32_t *first_out, uint32_t *count_out)
{
    const double reach = (double)axis->border + 1.0, size = (double)axis->size, tiles = (double)axis->tiles;
    double first = floor((((double)min - (double)axis->origin) / (double)axis->cell_size - reach) / size);
    double last = floor((((double)max - (double)axis->origin) / (double)axis->cell_size + reach) / size);
    *first_out = *count_out = 0;
    if (last >= 0.0 && first < tiles) {
        *first_out = first > 0.0 ? (uint32_t)first : 0;
        *count_out = (last < tiles - 1.0 ? (uint32_t)last : axis->tiles - 1) - *first_out + 1;
    }
}

tl_result tl_nav_tiles_in_box(const tl_nav_def *def, tl_aabb level_bounds, tl_aabb box, tl_nav_tile_range *range_out,
                              tl_report *report_out)
{
    tl_nav_tile_range range = { 0, 0, 0, 0 };
    tl_report_begin(report_out, "tiles in box");
    TL_REFUSE_NULL(range_out, report_out);
    *range_out = range;
    const tl_nav_def defaults = tl_default_nav_def();
    def = def != NULL ? def : &defaults;
    if (!tl_is_finite(box.min) || !tl_is_finite(box.max)) {
        return tl_report_field(report_out, TL_ERR_NOT_FINITE, "box", "use finite numbers");
    }
    if (tl_aabb_is_empty(box)) {
        return tl_report_field(report_out, TL_ERR_ARGUMENT, "box", "give a box with min <= max");
    }
    uint32_t tiles_x, tiles_z;
    tl_nav_config config;
    TL_TRY(tl_nav_tile_grid(def, level_bounds, &tiles_x, &tiles_z, report_out));
    TL_TRY(tl_nav_config_from_def(def, level_bounds, 0, 0, &config, report_out));
    if (def->tile_size == 0) {
        range.count_x = range.count_z = 1;
    } else {
        const tl_vec3 origin = config.lattice.origin;
        const tile_axis x = { origin.x, config.cell_size, def->tile_size, config.border_size, tiles_x };
        const tile_axis z = { origin.z, config.cell_size, def->tile_size, config.border_size, tiles_z };
        tiles_along(&x, box.min.x, box.max.x, &range.x, &range.count_x);
        tiles_along(&z, box.min.z, box.max.z, &range.z, &range.count_z);
    }
    if (range.count_x > 0 && range.count_z > 0) {
        *range_out = range;
    }
    return TL_OK;
}

tl_result tl_nav_rebake(const tl_nav_def *def, const tl_nav_input *input, tl_aabb changed, tl_nav_tile_block *block_out,
                        tl_nav_bake_report *report_out)
{
    tl_report *base = tl_nav_bake_report_begin(report_out, "rebake");
    TL_REFUSE_NULL(block_out, base);
    memset(block_out, 0, sizeof *block_out);
    TL_REFUSE_NULL(input, base);
    const tl_nav_def defaults = tl_default_nav_def();
    def = def != NULL ? def : &defaults;
    tl_nav_tile_range range;
    if (tl_aabb_is_empty(def->bounds)) {
        return tl_report_field(base, TL_ERR_ARGUMENT, "bounds",
                               "give def->bounds, or the lattice moves when the mesh does");
    }
    TL_TRY(tl_nav_tiles_in_box(def, def->bounds, changed, &range, base));
    if (range.count_x == 0) {
        return TL_OK; // beside the level: nothing is read
    }
    return tl_nav_bake_range(def, input, range, NULL, block_out, report_out);
}
