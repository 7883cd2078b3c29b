// SPDX-License-Identifier: MIT
//
// Fills the rings of large faces: for the direction of each cell's middle in the face's plane, the farthest vertex of
// the polygon. Both go around once, so this is linear (rotating calipers: Shamos, Computational Geometry, 1978).

#include "hull/support/face_ring.h"

#include "base/min_max.h"
#include "hull/support/direction_table.h"
#include "math/vec3d.h"

// Tiers of a cap that its ring serves: more would be as many steps away.
enum { MAX_SPREADS = 4 };

static tl_vec3d ring_corner(const tl_hull *hull, uint32_t half_edge)
{
    return tl_vec3d_from(tl_hull_corner(hull, half_edge));
}

// The plane's axes, right-handed with its normal, of unit length; any turn about the normal will do.
static void plane_axes(const tl_hull *hull, uint32_t face, tl_vec3d axes[2])
{
    tl_hull_plane plane = tl_hull_face_plane(hull, face);
    tl_vec3d normal = tl_vec3d_make(plane.normal[0], plane.normal[1], plane.normal[2]);
    axes[1] = tl_vec3d_perpendicular(normal);
    axes[0] = tl_vec3d_cross(axes[1], normal);
}

static void extents_along(const tl_hull *hull, uint32_t face, const tl_vec3d axes[2], double extent[2])
{
    tl_hull_face f = tl_hull_face_at(hull, face);
    tl_vec3d origin = ring_corner(hull, f.first);
    for (int i = 0; i < 2; i++) {
        double low = 0.0, high = 0.0;
        for (uint32_t k = 1; k < f.count; k++) {
            double at = tl_vec3d_dot(axes[i], tl_vec3d_sub(ring_corner(hull, f.first + k), origin));
            low = tl_min_f64(low, at);
            high = tl_max_f64(high, at);
        }
        extent[i] = high - low;
    }
    double largest = extent[0] > extent[1] ? extent[0] : extent[1];
    for (int i = 0; i < 2; i++) {
        extent[i] = tl_relative_extent(extent[i], largest);
    }
}

tl_face_ring tl_face_ring_make(const tl_hull *hull, uint32_t face, uint32_t first)
{
    tl_vec3d axes[2];
    double extent[2];
    plane_axes(hull, face, axes);
    extents_along(hull, face, axes, extent);
    tl_vec3 u = tl_vec3d_to_float(tl_vec3d_scale(axes[0], extent[0]));
    tl_vec3 v = tl_vec3d_to_float(tl_vec3d_scale(axes[1], extent[1]));
    uint32_t cells = tl_face_ring_cells(tl_hull_face_at(hull, face).count);
    tl_face_ring ring = { { u.x, u.y, u.z }, { v.x, v.y, v.z }, first, cells };
    return ring;
}

// Of the middle of a cell, in space.
static tl_vec3d cell_direction(const tl_vec3d axes[2], const double extent[2], uint32_t cell, uint32_t cell_count)
{
    double at[2];
    tl_ring_cell_middle(cell, cell_count, at);
    return tl_vec3d_add(tl_vec3d_scale(axes[0], at[0] / extent[0]), tl_vec3d_scale(axes[1], at[1] / extent[1]));
}

static void fill_ring(const tl_hull *hull, uint32_t face, const tl_face_ring *ring, uint32_t *table)
{
    tl_vec3d axes[2];
    double extent[2];
    plane_axes(hull, face, axes);
    extents_along(hull, face, axes, extent);
    tl_hull_face f = tl_hull_face_at(hull, face);
    uint32_t best = 0;
    for (uint32_t cell = 0; cell < ring->cell_count; cell++) {
        tl_vec3d d = cell_direction(axes, extent, cell, ring->cell_count);
        // The first cell looks at all corners; from then on the farthest one only moves forward, along the loop.
        for (uint32_t k = 1, at = best; k < f.count; k++) {
            at = at + 1 < f.count ? at + 1 : 0;
            tl_vec3d ahead = tl_vec3d_sub(ring_corner(hull, f.first + at), ring_corner(hull, f.first + best));
            if (tl_vec3d_dot(d, ahead) > 0.0) {
                best = at;
            } else if (cell > 0) {
                break;
            }
        }
        table[ring->first + cell] = tl_hull_edge_origin(hull, f.first + best);
    }
}

static uint32_t cell_of_direction(const tl_hull *hull, tl_vec3 direction)
{
    const tl_hull_climb *climb = tl_hull_climb_head(hull);
    return tl_table_cell(tl_mul(direction, climb->table_scale), climb->table_side);
}

// Of a face's normal, or of the normal of a ring's face: the axes' cross product.
static uint32_t cell_of_face(const tl_hull *hull, uint32_t face)
{
    const tl_hull_plane plane = tl_hull_face_plane(hull, face);
    const tl_vec3d normal = tl_vec3d_make(plane.normal[0], plane.normal[1], plane.normal[2]);
    return cell_of_direction(hull, tl_vec3d_to_float(normal));
}

static uint32_t cell_of_ring(const tl_hull *hull, uint32_t index)
{
    const tl_face_ring *ring = &tl_hull_rings(hull)[index];
    return cell_of_direction(hull, tl_cross(tl_vec3_make(ring->u[0], ring->u[1], ring->u[2]),
                                            tl_vec3_make(ring->v[0], ring->v[1], ring->v[2])));
}

// Whether two cells of the table are one or lie side by side. Its two squares have one rim.
static bool are_cells_near(uint32_t a, uint32_t b, uint32_t side)
{
    const uint32_t row = a / side % side, column = a % side, other_row = b / side % side, other_column = b % side;
    const bool on_rim = row == 0 || column == 0 || row == side - 1 || column == side - 1;
    return (on_rim || a / (side * side) == b / (side * side)) && row - other_row + 1 <= 2 &&
           column - other_column + 1 <= 2;
}

// Gives rings to corners of faces whose normals the table cannot tell from a ring's: a cap that is nearly flat has
// wedges beyond its middle, too. From the ring's corner at the same angle they are a step or two away, along the rim
// up to half of it.
static void spread_rings(const tl_hull *hull, uint32_t *rings_of_vertices)
{
    const uint32_t side = tl_hull_climb_head(hull)->table_side;
    bool spreads = true;
    for (uint32_t round = 0; round < MAX_SPREADS && spreads; round++) {
        spreads = false;
        for (uint32_t edge = 0; edge < hull->half_edge_count; edge++) {
            const uint32_t ring = rings_of_vertices[tl_hull_edge_origin(hull, tl_hull_edge_twin(hull, edge))];
            uint32_t *of = &rings_of_vertices[tl_hull_edge_origin(hull, edge)];
            if (*of == TL_NO_FACE_RING && ring != TL_NO_FACE_RING &&
                are_cells_near(cell_of_face(hull, tl_hull_edge_face(hull, edge)), cell_of_ring(hull, ring), side)) {
                *of = ring;
                spreads = true;
            }
        }
    }
}

void tl_hull_fill_rings(tl_hull *hull, uint32_t *table, uint32_t *rings_of_vertices)
{
    tl_face_ring *rings = (tl_face_ring *)(uintptr_t)tl_hull_rings(hull);
    const uint32_t side = tl_hull_climb_head(hull)->table_side;
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        rings_of_vertices[v] = TL_NO_FACE_RING;
    }
    uint32_t count = 0, first = 2 * side * side;
    for (uint32_t face = 0; face < hull->face_count; face++) {
        const tl_hull_face f = tl_hull_face_at(hull, face);
        if (!tl_face_has_ring(f.count)) {
            continue;
        }
        rings[count] = tl_face_ring_make(hull, face, first);
        fill_ring(hull, face, &rings[count], table);
        for (uint32_t k = 0; k < f.count; k++) {
            uint32_t *of = &rings_of_vertices[tl_hull_edge_origin(hull, f.first + k)];
            if (*of == TL_NO_FACE_RING || rings[*of].cell_count < rings[count].cell_count) {
                *of = count;
            }
        }
        first += rings[count].cell_count;
        count++;
    }
    spread_rings(hull, rings_of_vertices);
}
