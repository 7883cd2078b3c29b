// SPDX-License-Identifier: MIT
//
// Directions that a part may be cut across: the coordinate axes, the principal axes of its surface, and the normals
// that most of its area has. A turned box with a notch is cut along its own faces, a limb across its length.
//
// Source of the eigenvectors: Jacobi, 1846, as in Golub, Van Loan, Matrix Computations, 8.5.

#include "decompose/cut_search.h"

#include <math.h>
#include <string.h>

// Directions closer than this cosine count as one: 2.5 degrees.
static const double SAME_DIRECTION = 0.999;

enum { NORMAL_CELLS = 12, NORMAL_DIRECTIONS = 4, JACOBI_SWEEPS = 12 };

static void add_direction(tl_vec3d *directions, uint32_t *count, tl_vec3d unit)
{
    for (uint32_t i = 0; i < *count; i++) {
        if (fabs(tl_vec3d_dot(directions[i], unit)) > SAME_DIRECTION) {
            return;
        }
    }
    directions[(*count)++] = unit;
}

// Twice the area of triangle i, as a vector along its normal.
static tl_vec3d triangle_area_vector(const tl_part *part, uint32_t i)
{
    const tl_vec3 *c = part->corners + 3 * (size_t)i;
    const tl_vec3d a = tl_vec3d_from(c[0]);
    return tl_vec3d_cross(tl_vec3d_sub(tl_vec3d_from(c[1]), a), tl_vec3d_sub(tl_vec3d_from(c[2]), a));
}

static tl_vec3d triangle_middle(const tl_part *part, uint32_t i)
{
    const tl_vec3 *c = part->corners + 3 * (size_t)i;
    const tl_vec3d sum = tl_vec3d_add(tl_vec3d_add(tl_vec3d_from(c[0]), tl_vec3d_from(c[1])), tl_vec3d_from(c[2]));
    return tl_vec3d_scale(sum, 1.0 / 3.0);
}

static tl_vec3d surface_middle(const tl_part *part)
{
    tl_vec3d sum = { 0.0, 0.0, 0.0 };
    double area_sum = 0.0;
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const double area = tl_vec3d_length(triangle_area_vector(part, i));
        sum = tl_vec3d_mul_add(sum, triangle_middle(part, i), area);
        area_sum += area;
    }
    return area_sum > 0.0 ? tl_vec3d_scale(sum, 1.0 / area_sum) : tl_vec3d_from(part->corners[0]);
}

// How the surface spreads about its middle.
static void surface_covariance(const tl_part *part, double m[3][3])
{
    const tl_vec3d middle = surface_middle(part);
    memset(m, 0, 9 * sizeof m[0][0]);
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        const double area = tl_vec3d_length(triangle_area_vector(part, i));
        for (uint32_t k = 0; k < 3; k++) {
            const tl_vec3d p = tl_vec3d_sub(tl_vec3d_from(part->corners[3 * (size_t)i + k]), middle);
            const double v[3] = { p.x, p.y, p.z };
            for (uint32_t row = 0; row < 3; row++) {
                for (uint32_t column = 0; column < 3; column++) {
                    m[row][column] += area * v[row] * v[column];
                }
            }
        }
    }
}

// One rotation that makes m[p][q] zero; the columns of v become the eigenvectors.
static void rotate_jacobi(double m[3][3], double v[3][3], uint32_t p, uint32_t q)
{
    if (m[p][q] == 0.0) {
        return;
    }
    const double ratio = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    const double tangent = (ratio >= 0.0 ? 1.0 : -1.0) / (fabs(ratio) + sqrt(ratio * ratio + 1.0));
    const double cosine = 1.0 / sqrt(tangent * tangent + 1.0), sine = tangent * cosine;
    for (uint32_t k = 0; k < 3; k++) {
        const double a = m[k][p], b = m[k][q];
        m[k][p] = cosine * a - sine * b;
        m[k][q] = sine * a + cosine * b;
    }
    for (uint32_t k = 0; k < 3; k++) {
        const double a = m[p][k], b = m[q][k];
        m[p][k] = cosine * a - sine * b;
        m[q][k] = sine * a + cosine * b;
    }
    for (uint32_t k = 0; k < 3; k++) {
        const double a = v[k][p], b = v[k][q];
        v[k][p] = cosine * a - sine * b;
        v[k][q] = sine * a + cosine * b;
    }
}

static void add_principal_axes(const tl_part *part, tl_vec3d *directions, uint32_t *count)
{
    double m[3][3], v[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    surface_covariance(part, m);
    const double trace = m[0][0] + m[1][1] + m[2][2];
    if (!(trace > 0.0) || !isfinite(trace)) {
        return;
    }
    for (uint32_t row = 0; row < 3; row++) {
        for (uint32_t column = 0; column < 3; column++) {
            m[row][column] /= trace;
        }
    }
    for (uint32_t sweep = 0; sweep < JACOBI_SWEEPS; sweep++) {
        rotate_jacobi(m, v, 0, 1);
        rotate_jacobi(m, v, 0, 2);
        rotate_jacobi(m, v, 1, 2);
    }
    for (uint32_t i = 0; i < 3; i++) {
        const tl_vec3d axis = tl_vec3d_make(v[0][i], v[1][i], v[2][i]);
        add_direction(directions, count, tl_vec3d_scale(axis, 1.0 / tl_vec3d_length(axis)));
    }
}

typedef struct normal_cell {
    tl_vec3d sum;
    double area;
} normal_cell;

// A cell of the cube around the origin, opposite ones being one; the vector is turned to the positive side.
static uint32_t cube_cell(tl_vec3d *v)
{
    const double c[3] = { v->x, v->y, v->z };
    const uint32_t axis =
        fabs(c[0]) >= fabs(c[1]) ? (fabs(c[0]) >= fabs(c[2]) ? 0u : 2u) : (fabs(c[1]) >= fabs(c[2]) ? 1u : 2u);
    const double side = c[axis] < 0.0 ? -1.0 : 1.0;
    *v = tl_vec3d_scale(*v, side);
    const double a = c[(axis + 1) % 3] / c[axis], b = c[(axis + 2) % 3] / c[axis];
    // Half a cell aside, so that the middle of a cell is a direction of whole numbers, not the border of four.
    const uint32_t i = (uint32_t)((a + 1.0) * 0.5 * (NORMAL_CELLS - 1) + 0.5);
    const uint32_t j = (uint32_t)((b + 1.0) * 0.5 * (NORMAL_CELLS - 1) + 0.5);
    return (axis * NORMAL_CELLS + i) * NORMAL_CELLS + j;
}

static void add_common_normals(const tl_part *part, tl_vec3d *directions, uint32_t *count)
{
    normal_cell cells[3 * NORMAL_CELLS * NORMAL_CELLS];
    memset(cells, 0, sizeof cells);
    for (uint32_t i = 0; i < part->triangle_count; i++) {
        tl_vec3d normal = triangle_area_vector(part, i);
        const double area = tl_vec3d_length(normal);
        if (area > 0.0) {
            normal_cell *cell = &cells[cube_cell(&normal)];
            cell->sum = tl_vec3d_add(cell->sum, normal);
            cell->area += area;
        }
    }
    for (uint32_t found = 0; found < NORMAL_DIRECTIONS; found++) {
        uint32_t best = 0;
        for (uint32_t i = 1; i < 3 * NORMAL_CELLS * NORMAL_CELLS; i++) {
            best = cells[i].area > cells[best].area ? i : best;
        }
        const double length = tl_vec3d_length(cells[best].sum);
        if (!(cells[best].area > 0.0) || !(length > 0.0)) {
            return;
        }
        add_direction(directions, count, tl_vec3d_scale(cells[best].sum, 1.0 / length));
        cells[best].area = 0.0;
    }
}

uint32_t tl_cut_directions(const tl_part *part, tl_vec3d directions[TL_CUT_DIRECTIONS])
{
    uint32_t count = 3;
    directions[0] = tl_vec3d_make(1.0, 0.0, 0.0);
    directions[1] = tl_vec3d_make(0.0, 1.0, 0.0);
    directions[2] = tl_vec3d_make(0.0, 0.0, 1.0);
    add_principal_axes(part, directions, &count);
    add_common_normals(part, directions, &count);
    return count;
}
