// SPDX-License-Identifier: MIT
//
// Volume, area, centre of mass and inertia, as sums over the tetrahedra from the mean of the vertices to the triangles
// of each face's fan. The mean lies inside, so all terms are positive and nothing cancels. Source: David Eberly,
// Polyhedral Mass Properties (Revisited), 2002; here in the form of tetrahedra.

#include "base/assert.h"
#include "hull/bake/hull_polygons.h"
#include "hull/support/hull_support.h"

#include <string.h>

typedef struct moments {
    double volume6;   // six times the volume
    double first[3];  // 24 times the first moment
    double second[6]; // 120 times the second: xx, yy, zz, xy, xz, yz
    double area2;     // twice the area
} moments;

static void relative(const tl_hull *hull, uint32_t half_edge, const double middle[3], double out[3])
{
    tl_vec3 p = tl_hull_corner(hull, half_edge);
    out[0] = (double)p.x - middle[0];
    out[1] = (double)p.y - middle[1];
    out[2] = (double)p.z - middle[2];
}

static void add_tetrahedron(moments *m, const double a[3], const double b[3], const double c[3])
{
    static const int rows[6] = { 0, 1, 2, 0, 0, 1 }, columns[6] = { 0, 1, 2, 1, 2, 2 };
    double u[3], v[3], n[3], sum[3];
    for (int i = 0; i < 3; i++) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
        sum[i] = a[i] + b[i] + c[i];
    }
    n[0] = u[1] * v[2] - u[2] * v[1];
    n[1] = u[2] * v[0] - u[0] * v[2];
    n[2] = u[0] * v[1] - u[1] * v[0];
    double determinant = a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
    m->area2 += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    m->volume6 += determinant;
    for (int i = 0; i < 3; i++) {
        m->first[i] += determinant * sum[i];
    }
    for (int k = 0; k < 6; k++) {
        int i = rows[k], j = columns[k];
        m->second[k] += determinant * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j]);
    }
}

tl_result tl_hull_measure_mass(const tl_hull *hull, tl_stage *stage, tl_hull_mass *mass_out)
{
    tl_hull_mass mass;
    memset(&mass, 0, sizeof mass);
    double middle[3] = { 0.0, 0.0, 0.0 };
    for (uint32_t v = 0; v < hull->vertex_count; v++) {
        tl_vec3 p = tl_hull_vertices(hull)[v];
        middle[0] += (double)p.x;
        middle[1] += (double)p.y;
        middle[2] += (double)p.z;
    }
    for (int i = 0; i < 3; i++) {
        middle[i] /= (double)hull->vertex_count;
        mass.center[i] = middle[i];
    }
    moments m = { 0.0, { 0.0 }, { 0.0 }, 0.0 };
    for (uint32_t f = 0; f < hull->face_count; f++) {
        tl_hull_face face = tl_hull_face_at(hull, f);
        double a[3], b[3], c[3];
        TL_TRY(tl_stage_tick(stage, f));
        relative(hull, face.first, middle, a);
        for (uint32_t k = 1; k + 1 < face.count; k++) {
            relative(hull, face.first + k, middle, b);
            relative(hull, face.first + k + 1, middle, c);
            add_tetrahedron(&m, a, b, c);
        }
    }
    mass.area = 0.5 * m.area2;
    if (!(m.volume6 > 0.0)) {
        *mass_out = mass; // thinner than double rounding of its length: no volume, the mean as centre
        return TL_OK;
    }
    mass.volume = m.volume6 / 6.0;
    double center[3];
    for (int i = 0; i < 3; i++) {
        center[i] = m.first[i] / (4.0 * m.volume6);
        mass.center[i] = middle[i] + center[i];
    }
    double xx = m.second[0] / 120.0 - mass.volume * center[0] * center[0];
    double yy = m.second[1] / 120.0 - mass.volume * center[1] * center[1];
    double zz = m.second[2] / 120.0 - mass.volume * center[2] * center[2];
    mass.inertia[0] = yy + zz;
    mass.inertia[1] = xx + zz;
    mass.inertia[2] = xx + yy;
    mass.inertia[3] = mass.volume * center[0] * center[1] - m.second[3] / 120.0;
    mass.inertia[4] = mass.volume * center[0] * center[2] - m.second[4] / 120.0;
    mass.inertia[5] = mass.volume * center[1] * center[2] - m.second[5] / 120.0;
    *mass_out = mass;
    return TL_OK;
}
