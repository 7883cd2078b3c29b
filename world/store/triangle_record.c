// SPDX-License-Identifier: MIT

#include "world/store/triangle_record.h"

#include "world/bytes/little_endian.h"

#include <math.h>
#include <string.h>
#include <talus/mesh.h>

static double nearest_to_zero(double low, double high)
{
    return low > 0.0 ? low : high < 0.0 ? high : 0.0;
}

void tl_world_cell_origin(const tl_world_cell *cell, double cell_size, double origin_out[3])
{
    const double edge = ldexp(cell_size, cell->level);
    origin_out[0] = (double)cell->x * edge;
    origin_out[1] = (double)cell->y * TL_WORLD_CELL_HEIGHT;
    origin_out[2] = (double)cell->z * edge;
}

int tl_world_cell_compare(const tl_world_cell *a, const tl_world_cell *b)
{
    if (a->level != b->level) {
        return a->level < b->level ? -1 : 1;
    }
    if (a->z != b->z) {
        return a->z < b->z ? -1 : 1;
    }
    if (a->x != b->x) {
        return a->x < b->x ? -1 : 1;
    }
    return a->y != b->y ? (a->y < b->y ? -1 : 1) : 0;
}

// The exact question is tl_mesh_bake's; it is asked only where doubles may be wrong.
static bool ask_mesh(const float corners[9])
{
    static const uint32_t indices[3] = { 0, 1, 2 };
    tl_vec3 vertices[3];
    for (int k = 0; k < 3; k++) {
        vertices[k] = tl_vec3_make(corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]);
    }
    const tl_mesh_view view = { vertices, 3, indices, 1, NULL };
    tl_mesh mesh;
    const tl_result result = tl_mesh_bake(&view, NULL, &mesh, NULL);
    tl_mesh_free(&mesh);
    return result != TL_ERR_EMPTY;
}

// A component of the cross product is u v - w s, of differences of floats. In doubles each difference, product and
// the sum is off by 2^-53 of itself at most: in all less than 1e-15 of |u v| + |w s|.
static bool has_area(const float p[9])
{
    double u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = (double)p[3 + i] - (double)p[i];
        v[i] = (double)p[6 + i] - (double)p[i];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double plus = u[j] * v[k], minus = u[k] * v[j];
        if (fabs(plus - minus) > 1e-15 * (fabs(plus) + fabs(minus))) {
            return true;
        }
    }
    return ask_mesh(p);
}

static bool choose_cell(const double low[3], const double high[3], double cell_size, tl_world_cell *cell)
{
    const double extent = fmax(high[0] - low[0], high[2] - low[2]);
    double edge = cell_size;
    int32_t level = 0;
    for (; extent > edge && level < TL_WORLD_MAX_LEVEL; level++) {
        edge *= 2.0;
    }
    const double x = nearest_to_zero(low[0], high[0]) / edge, z = nearest_to_zero(low[2], high[2]) / edge;
    const double y = nearest_to_zero(low[1], high[1]) / TL_WORLD_CELL_HEIGHT;
    if (fabs(x) > 0x1p30 || fabs(y) > 0x1p30 || fabs(z) > 0x1p30) {
        return false;
    }
    const tl_world_cell chosen = { level, (int32_t)x, (int32_t)y, (int32_t)z }; // towards 0
    *cell = chosen;
    return true;
}

tl_world_taken tl_world_record_encode(const tl_world_triangle *triangle, double cell_size, tl_world_cell *cell_out,
                                      unsigned char record_out[TL_WORLD_RECORD_BYTES])
{
    double low[3], high[3], origin[3];
    for (int i = 0; i < 3; i++) {
        const double a = triangle->corner[0][i], b = triangle->corner[1][i], c = triangle->corner[2][i];
        if (!isfinite(a) || !isfinite(b) || !isfinite(c)) {
            return TL_WORLD_NOT_FINITE;
        }
        const double ab_low = a < b ? a : b, ab_high = a < b ? b : a;
        low[i] = ab_low < c ? ab_low : c;
        high[i] = ab_high > c ? ab_high : c;
        if (low[i] < -TL_WORLD_MAX_COORDINATE || high[i] > TL_WORLD_MAX_COORDINATE) {
            return TL_WORLD_TOO_FAR;
        }
    }
    if (!choose_cell(low, high, cell_size, cell_out)) {
        return TL_WORLD_TOO_FAR;
    }
    tl_world_cell_origin(cell_out, cell_size, origin);
    float offsets[9];
    for (int k = 0; k < 9; k++) {
        offsets[k] = (float)(triangle->corner[k / 3][k % 3] - origin[k % 3]) + 0.0f; // -0 becomes 0
        tl_put_float(record_out + 4 * k, offsets[k]);
    }
    memset(record_out + 36, 0, TL_WORLD_RECORD_BYTES - 36);
    record_out[36] = triangle->area;
    return has_area(offsets) ? TL_WORLD_TAKEN : TL_WORLD_NO_AREA;
}
