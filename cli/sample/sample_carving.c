// SPDX-License-Identifier: MIT
//
// Boxes to a surface: the planes of all boxes divide space into cells, each cell is solid or empty, and a face is put
// wherever the two meet. Faces end at every plane, so no corner lies inside another face's edge: there are no
// T-junctions. Merging faces into larger rectangles was rejected, because it would bring them back.

#include "cli/sample/sample_carving.h"

#include <stdlib.h>
#include <string.h>

static void push_box(tl_sample_carving *carving, tl_aabb box, bool solid)
{
    if (carving->count == carving->capacity) {
        uint32_t grown = carving->capacity > 0 ? 2 * carving->capacity : 64;
        void *moved = realloc(carving->boxes, grown * sizeof(*carving->boxes));
        if (moved == NULL) {
            carving->failed = true;
            return;
        }
        carving->boxes = moved;
        carving->capacity = grown;
    }
    tl_sample_carving_box entry = { box, solid };
    carving->boxes[carving->count++] = entry;
}

void tl_sample_carving_add(tl_sample_carving *carving, float x0, float y0, float z0, float x1, float y1, float z1)
{
    push_box(carving, tl_sample_bounds(x0, y0, z0, x1, y1, z1), true);
}

void tl_sample_carving_cut(tl_sample_carving *carving, float x0, float y0, float z0, float x1, float y1, float z1)
{
    push_box(carving, tl_sample_bounds(x0, y0, z0, x1, y1, z1), false);
}

// The planes of one axis, ascending; cell i lies between planes i - 1 and i, so cells 0 and count lie outside.
typedef struct plane_list {
    float *at;
    uint32_t count;
} plane_list;

// The lattice and its vertices, made when a face first needs them.
typedef struct carving_lattice {
    plane_list axis[3];
    uint32_t cells[3]; // planes + 1
    unsigned char *solid;
    uint32_t *vertex; // index + 1, 0: not made yet
} carving_lattice;

static float point_component(tl_vec3 v, unsigned axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static int compare_floats(const void *a, const void *b)
{
    float x = *(const float *)a;
    float y = *(const float *)b;
    return (x > y) - (x < y);
}

static void collect_planes(const tl_sample_carving *carving, unsigned axis, plane_list *out)
{
    for (uint32_t i = 0; i < carving->count; ++i) {
        out->at[2 * i] = point_component(carving->boxes[i].box.min, axis);
        out->at[2 * i + 1] = point_component(carving->boxes[i].box.max, axis);
    }
    qsort(out->at, 2 * (size_t)carving->count, sizeof(float), compare_floats);
    uint32_t count = 0;
    for (uint32_t i = 0; i < 2 * carving->count; ++i) {
        if (count == 0 || out->at[i] != out->at[count - 1]) {
            out->at[count++] = out->at[i];
        }
    }
    out->count = count;
}

static uint32_t plane_index(const plane_list *axis, float value)
{
    const float *found = bsearch(&value, axis->at, axis->count, sizeof(float), compare_floats);
    return (uint32_t)(found - axis->at);
}

static size_t cell_index(const carving_lattice *grid, uint32_t x, uint32_t y, uint32_t z)
{
    return ((size_t)z * grid->cells[1] + y) * grid->cells[0] + x;
}

static void fill_cells(carving_lattice *grid, const tl_sample_carving_box *entry)
{
    uint32_t low[3], high[3];
    for (unsigned axis = 0; axis < 3; ++axis) {
        low[axis] = plane_index(&grid->axis[axis], point_component(entry->box.min, axis)) + 1;
        high[axis] = plane_index(&grid->axis[axis], point_component(entry->box.max, axis)) + 1;
    }
    if (high[0] <= low[0]) {
        return;
    }
    for (uint32_t z = low[2]; z < high[2]; ++z) {
        for (uint32_t y = low[1]; y < high[1]; ++y) {
            memset(grid->solid + cell_index(grid, low[0], y, z), entry->solid, high[0] - low[0]);
        }
    }
}

static uint32_t lattice_corner(carving_lattice *grid, const uint32_t plane[3], tl_sample_mesh *mesh)
{
    if (mesh->counting) {
        return 0;
    }
    uint32_t *slot = &grid->vertex[cell_index(grid, plane[0], plane[1], plane[2])];
    if (*slot == 0) {
        tl_vec3 p = { grid->axis[0].at[plane[0]], grid->axis[1].at[plane[1]], grid->axis[2].at[plane[2]] };
        *slot = tl_sample_vertex(mesh, p) + 1;
    }
    return *slot - 1;
}

// The face on plane `plane` of `axis` of the cell column (b, c) of the two other axes; it looks towards +axis when
// `forward`.
static void put_face(carving_lattice *grid, unsigned axis, uint32_t plane, uint32_t b, uint32_t c, bool forward,
                     tl_sample_mesh *mesh)
{
    unsigned axis_b = (axis + 1) % 3;
    unsigned axis_c = (axis + 2) % 3;
    uint32_t v[4];
    for (unsigned i = 0; i < 4; ++i) {
        uint32_t at[3];
        at[axis] = plane;
        at[axis_b] = b - 1 + (i == 1 || i == 2);
        at[axis_c] = c - 1 + (i >= 2);
        v[i] = lattice_corner(grid, at, mesh);
    }
    if (forward) {
        tl_sample_quad(mesh, v[0], v[1], v[2], v[3]);
    } else {
        tl_sample_quad(mesh, v[0], v[3], v[2], v[1]);
    }
}

static bool on_window(const tl_aabb *window, unsigned axis, float at)
{
    return window != NULL && axis != 1 &&
           (at == point_component(window->min, axis) || at == point_component(window->max, axis));
}

static void put_faces(carving_lattice *grid, unsigned axis, const tl_aabb *window, tl_sample_mesh *mesh)
{
    unsigned axis_b = (axis + 1) % 3;
    unsigned axis_c = (axis + 2) % 3;
    for (uint32_t plane = 0; plane < grid->axis[axis].count; ++plane) {
        if (on_window(window, axis, grid->axis[axis].at[plane])) {
            continue;
        }
        for (uint32_t c = 1; c < grid->axis[axis_c].count; ++c) {
            for (uint32_t b = 1; b < grid->axis[axis_b].count; ++b) {
                uint32_t at[3];
                at[axis_b] = b;
                at[axis_c] = c;
                at[axis] = plane;
                bool below = grid->solid[cell_index(grid, at[0], at[1], at[2])] != 0;
                at[axis] = plane + 1;
                bool above = grid->solid[cell_index(grid, at[0], at[1], at[2])] != 0;
                if (below != above) {
                    put_face(grid, axis, plane, b, c, below, mesh);
                }
            }
        }
    }
}

static bool make_lattice(const tl_sample_carving *carving, carving_lattice *grid)
{
    size_t cells = 1;
    for (unsigned axis = 0; axis < 3; ++axis) {
        grid->axis[axis].at = malloc(2 * (size_t)carving->count * sizeof(float));
        if (grid->axis[axis].at == NULL) {
            return false;
        }
        collect_planes(carving, axis, &grid->axis[axis]);
        grid->cells[axis] = grid->axis[axis].count + 1;
        cells *= grid->cells[axis];
    }
    grid->solid = malloc(cells);
    grid->vertex = calloc(cells, sizeof(uint32_t));
    if (grid->solid == NULL || grid->vertex == NULL) {
        return false;
    }
    memset(grid->solid, carving->rock_outside, cells);
    return true;
}

void tl_sample_carving_finish(tl_sample_carving *carving, const tl_aabb *window, tl_sample_mesh *mesh)
{
    carving_lattice grid = { 0 };
    if (carving->failed || (carving->count > 0 && !make_lattice(carving, &grid))) {
        mesh->result = TL_ERR_MEMORY;
    } else if (carving->count > 0 && mesh->result == TL_OK) {
        for (uint32_t i = 0; i < carving->count; ++i) {
            fill_cells(&grid, &carving->boxes[i]);
        }
        for (unsigned axis = 0; axis < 3; ++axis) {
            put_faces(&grid, axis, window, mesh);
        }
    }
    for (unsigned axis = 0; axis < 3; ++axis) {
        free(grid.axis[axis].at);
    }
    free(grid.solid);
    free(grid.vertex);
    free(carving->boxes);
    tl_sample_carving empty = { 0 };
    empty.rock_outside = carving->rock_outside;
    *carving = empty;
}
