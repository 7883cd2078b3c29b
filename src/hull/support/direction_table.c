// SPDX-License-Identifier: MIT
//
// Fills the table of directions: see direction_table.h.

#include "hull/support/direction_table.h"
#include "base/assert.h"
#include "hull/support/cap_ring.h"

// With 16 cells a vertex the start is right in seven of eight queries. Four times as many would halve the rest, and
// their memory would cost more than that gains,
#define CELLS_PER_VERTEX 16.0f
// but for small hulls with large faces: there finer cells save most of the second look-ups that rings cost.
#define RINGED_CELLS_PER_VERTEX 64.0f
#define SMALL_RINGED            256u
// More cells than this no longer fit a second-level cache beside the blocks.
#define MAX_SIDE 512u

// The scale is chosen by so many of the faces, in a table of so many cells along a side.
enum { SCALE_SAMPLES = 256, SAMPLE_SIDE = 16 };

uint32_t tl_hull_table_side(uint32_t vertex_count, bool has_rings)
{
    float cells = has_rings && vertex_count <= SMALL_RINGED ? RINGED_CELLS_PER_VERTEX : CELLS_PER_VERTEX;
    uint32_t side = (uint32_t)sqrtf(0.5f * cells * (float)vertex_count) + 1;
    return tl_min_u32(side, MAX_SIDE);
}

// Extents over the largest one, so that no product with a direction in range under- or overflows.
static tl_vec3 relative_extents(tl_aabb bounds)
{
    double size[3] = { (double)bounds.max.x - (double)bounds.min.x, (double)bounds.max.y - (double)bounds.min.y,
                       (double)bounds.max.z - (double)bounds.min.z };
    double largest = size[0] > size[1] ? size[0] : size[1];
    largest = size[2] > largest ? size[2] : largest;
    return tl_vec3_make((float)tl_relative_extent(size[0], largest), (float)tl_relative_extent(size[1], largest),
                        (float)tl_relative_extent(size[2], largest));
}

// How many cells the normals of some faces fall into. Where normals are dense vertices change often.
static uint32_t count_cells(const tl_hull *hull, tl_vec3 scale)
{
    uint64_t seen[2 * SAMPLE_SIDE * SAMPLE_SIDE / 64] = { 0 };
    uint32_t count = 0, stride = hull->face_count / SCALE_SAMPLES + 1;
    for (uint32_t face = 0; face < hull->face_count; face += stride) {
        tl_hull_plane plane = tl_hull_face_plane(hull, face);
        tl_vec3 n = tl_vec3_make((float)plane.normal[0], (float)plane.normal[1], (float)plane.normal[2]);
        uint32_t cell = tl_table_cell(tl_mul(n, scale), SAMPLE_SIDE);
        count += (seen[cell / 64] >> cell % 64 & 1) == 0;
        seen[cell / 64] |= (uint64_t)1 << cell % 64;
    }
    return count;
}

tl_vec3 tl_hull_table_scale(const tl_hull *hull)
{
    tl_vec3 one = { 1.0f, 1.0f, 1.0f }, extents = relative_extents(hull->bounds);
    if (tl_hull_climb_head(hull)->table_side == 0) {
        return one;
    }
    // In full for a needle, not at all for a long capsule, whose ends are round, and halfway between.
    tl_vec3 scales[3] = { extents, tl_vec3_make(sqrtf(extents.x), sqrtf(extents.y), sqrtf(extents.z)), one };
    uint32_t best = 0, best_count = 0;
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t count = count_cells(hull, scales[i]);
        best = count > best_count ? i : best;
        best_count = tl_max_u32(best_count, count);
    }
    return scales[best];
}

// One row of a square: its cells' middles have a common x - y.
typedef struct table_row {
    const tl_hull *hull;
    const uint32_t *table; // in words, whose rings' cells are filled
    const uint32_t *rings; // of vertices; NULL: there are none
    uint32_t half, row;
} table_row;

static tl_vec3 unscaled(const tl_hull *hull, float x, float y, float z)
{
    const tl_vec3 scale = tl_hull_climb_head(hull)->table_scale;
    return tl_vec3_make(x / scale.x, y / scale.y, z / scale.z);
}

static tl_vec3 middle_of_cell(const table_row *row, uint32_t column)
{
    float side = (float)tl_hull_climb_head(row->hull)->table_side;
    float difference = 2.0f * ((float)row->row + 0.5f) / side - 1.0f;
    float sum = 2.0f * ((float)column + 0.5f) / side - 1.0f;
    float z = 1.0f - tl_maxf(fabsf(sum), fabsf(difference));
    return unscaled(row->hull, 0.5f * (sum + difference), 0.5f * (sum - difference), row->half != 0 ? -z : z);
}

// Columns begin .. end lie on one face of the octahedron, on which z changes by `slope` a unit of x + y.
static uint32_t fill_stretch(const table_row *row, const tl_support_kernel *kernel, uint32_t begin, uint32_t end,
                             float slope, uint32_t vertex, uint32_t *cells)
{
    const tl_hull *hull = row->hull;
    float width = 1.0f / (float)tl_hull_climb_head(hull)->table_side;
    tl_vec3 step = unscaled(hull, width, width, (row->half != 0 ? -slope : slope) * 2.0f * width);
    while (begin < end) {
        tl_vec3 d = middle_of_cell(row, begin);
        if (row->rings != NULL && row->rings[vertex] != TL_NO_FACE_RING) {
            vertex = row->table[tl_cell_in_ring(hull, row->rings[vertex],
                                                d)]; // many wedges may lie between this cell and the last
        }
        vertex = kernel->climb(hull, d.x, d.y, d.z, vertex);
        begin += kernel->march(hull, d, step, end - begin, vertex, cells + begin);
        vertex = cells[begin - 1];
    }
    return vertex;
}

static tl_result fill_squares(const tl_hull *hull, uint32_t *table, const uint32_t *rings, tl_stage *stage)
{
    uint32_t side = tl_hull_climb_head(hull)->table_side, first = 0;
    tl_support_kernel kernel = tl_support_kernel_best();
    for (uint32_t i = 0; i < 2 * side; i++) {
        table_row row = { hull, table, rings, i / side, i % side };
        uint32_t *cells = table + (uint64_t)i * side;
        uint32_t margin = row.row < side - 1 - row.row ? row.row : side - 1 - row.row;
        uint32_t vertex = fill_stretch(&row, &kernel, 0, margin, 1.0f, first, cells);
        vertex = fill_stretch(&row, &kernel, margin, side - margin, 0.0f, vertex, cells);
        fill_stretch(&row, &kernel, side - margin, side, -1.0f, vertex, cells);
        first = cells[0];
        TL_TRY(tl_stage_add(stage, 0));
    }
    return TL_OK;
}

// The cell beside another one. Both squares have the same rim, where the octahedron's halves meet: beyond it lies the
// cell of the other square that is in the same place.
static uint32_t cell_beside(const tl_hull *hull, uint32_t cell, int32_t row_step, int32_t column_step)
{
    uint32_t side = tl_hull_climb_head(hull)->table_side, half = cell / (side * side);
    uint32_t row = cell / side % side + (uint32_t)row_step, column = cell % side + (uint32_t)column_step;
    return row < side && column < side ? (half * side + row) * side + column
           : half == 0                 ? cell + side * side
                                       : cell - side * side;
}

// Whether a cell lies among wedges: at least three of the four cells beside it belong to other vertices of the same
// ring.
static bool is_among_wedges(const tl_hull *hull, const uint32_t *table, uint32_t cell, const uint32_t *rings)
{
    uint32_t vertex = table[cell] & ~TL_TABLE_RING, others = 0;
    const int32_t steps[4][2] = { { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
    for (int k = 0; k < 4; k++) {
        uint32_t other = table[cell_beside(hull, cell, steps[k][0], steps[k][1])] & ~TL_TABLE_RING;
        others += other != vertex && rings[other] == rings[vertex];
    }
    return others >= 3;
}

// Whether a cell's middle lies in the disc of the cap whose ring its vertex has.
static bool is_among_normals(const tl_hull *hull, const tl_hull_caps *caps, uint32_t cell, uint32_t ring)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    const uint32_t side = climb->table_side, face_rings = climb->ring_count - caps->count;
    const table_row row = { hull, NULL, NULL, cell / (side * side), cell / side % side };
    return ring >= face_rings && tl_is_in_cap(hull, &caps->caps[ring - face_rings], middle_of_cell(&row, cell % side));
}

static void name_rings(const tl_hull *hull, uint32_t *table, const uint32_t *rings, const tl_hull_caps *caps)
{
    const uint32_t side = tl_hull_climb_head(hull)->table_side, cells = 2 * side * side;
    for (uint32_t cell = 0; cell < cells; cell++) {
        const uint32_t ring = rings[table[cell]];
        if (ring != TL_NO_FACE_RING &&
            (is_among_wedges(hull, table, cell, rings) || is_among_normals(hull, caps, cell, ring))) {
            table[cell] |= TL_TABLE_RING; // beside its vertex, which the next cells need
        }
    }
    for (uint32_t cell = 0; cell < cells; cell++) {
        if ((table[cell] & TL_TABLE_RING) != 0) {
            table[cell] = TL_TABLE_RING | rings[table[cell] & ~TL_TABLE_RING];
        }
    }
}

// The table's place in the hull.
static void *table_cells(tl_hull *hull)
{
    return (char *)hull + (uint64_t)tl_hull_climb_head(hull)->table * TL_BLOB_ALIGNMENT;
}

// What is filled in words, in the table's own cells; a flag becomes that of a short cell.
static void write_short_cells(tl_hull *hull, const uint32_t *table)
{
    uint16_t *cells = table_cells(hull);
    const uint64_t count = tl_hull_cell_count(tl_hull_climb_head(hull));
    for (uint64_t i = 0; i < count; i++) {
        const uint32_t flag = (table[i] & TL_TABLE_RING) != 0 ? TL_TABLE_SHORT_RING : 0;
        cells[i] = (uint16_t)((table[i] & ~TL_TABLE_RING) | flag);
    }
}

tl_result tl_hull_fill_table(tl_hull *hull, const tl_hull_caps *caps, tl_arena *arena, tl_stage *stage)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    const bool is_short = climb->cell_bytes == sizeof(uint16_t);
    uint32_t *table = NULL;
    if (is_short) {
        table = TL_PUSH(arena, uint32_t, tl_hull_cell_count(climb));
    } else {
        table = table_cells(hull);
    }
    uint32_t *rings = climb->ring_count > 0 ? TL_PUSH_ZERO(arena, uint32_t, hull->vertex_count) : NULL;
    if (table == NULL || (climb->ring_count > 0 && rings == NULL)) {
        return TL_ERR_MEMORY;
    }
    if (rings != NULL) {
        tl_hull_fill_rings(hull, table, rings);
        TL_TRY(tl_hull_fill_caps(hull, caps, table, rings, stage));
    }
    TL_TRY(fill_squares(hull, table, rings, stage));
    if (rings != NULL) {
        name_rings(hull, table, rings, caps);
    }
    if (is_short) {
        write_short_cells(hull, table);
    }
    return TL_OK;
}
