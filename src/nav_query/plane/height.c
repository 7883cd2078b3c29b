// SPDX-License-Identifier: MIT
//
// Height on a polygon: find the detail triangle under the point, weight its corners.
//
// No triangle may hold the point by a rounding's breadth, at an edge of the patch. Then the triangle that misses it
// least answers, with its negative weights cut off; so a point on a polygon always has a height.

#include "base/compiler.h"
#include "nav_query/plane/surface.h"

typedef struct triangle_weights {
    double w[3]; // parts of the area, sum 1
} triangle_weights;

// Twice the areas of the parts into which a point divides a triangle.
static void divide_triangle(tl_vec3 a, tl_vec3 b, tl_vec3 c, double x, double z, double parts[3])
{
    double ax = (double)a.x - x, az = (double)a.z - z;
    double bx = (double)b.x - x, bz = (double)b.z - z;
    double cx = (double)c.x - x, cz = (double)c.z - z;
    parts[0] = bx * cz - bz * cx;
    parts[1] = cx * az - cz * ax;
    parts[2] = ax * bz - az * bx;
}

// Whether a triangle with area holds the point: what weigh would find, without its divisions. Most triangles of a patch
// do not, in no order that a processor could foresee: one branch.
static bool has_no_negative_part(const double parts[3])
{
    double low = parts[0] < parts[1] ? parts[0] : parts[1];
    double high = parts[0] < parts[1] ? parts[1] : parts[0];
    low = parts[2] < low ? parts[2] : low;
    high = parts[2] > high ? parts[2] : high;
    return ((low >= 0.0) & (high > 0.0)) | ((high <= 0.0) & (low < 0.0));
}

// False for a triangle without area in the plane.
static bool weigh(const double parts[3], triangle_weights *out)
{
    double sum = parts[0] + parts[1] + parts[2];
    if (sum == 0.0) {
        return false;
    }
    out->w[0] = parts[0] / sum;
    out->w[1] = parts[1] / sum;
    out->w[2] = parts[2] / sum;
    return true;
}

// Never outside the corners' own heights, so that a polygon's box bounds it.
static float mix_heights(const tl_vec3 *corners[3], const triangle_weights *weights)
{
    double sum = 0.0;
    double height = 0.0;
    double low = (double)corners[0]->y;
    double high = low;
    for (int k = 0; k < 3; k++) {
        double w = weights->w[k] > 0.0 ? weights->w[k] : 0.0;
        double y = (double)corners[k]->y;
        sum += w;
        height += w * y;
        low = y < low ? y : low;
        high = y > high ? y : high;
    }
    height /= sum;
    return (float)(height < low ? low : height > high ? high : height);
}

static float nearest_vertex_height(const tl_nav_surface *surface, double x, double z)
{
    double best = (double)INFINITY;
    float height = surface->vertices[0].y;
    for (uint32_t i = 0; i < surface->vertex_count; i++) {
        double dx = (double)surface->vertices[i].x - x;
        double dz = (double)surface->vertices[i].z - z;
        if (dx * dx + dz * dz < best) {
            best = dx * dx + dz * dz;
            height = surface->vertices[i].y;
        }
    }
    return height;
}

static void corners_of(const tl_nav_surface *surface, uint32_t triangle, const tl_vec3 *corners_out[3])
{
    const tl_nav_detail_triangle at = tl_nav_surface_triangle(surface, triangle);
    for (int k = 0; k < 3; k++) {
        corners_out[k] = &surface->vertices[at.corner[k]];
    }
}

// The smallest weight that a point has in a triangle: that of the part which is least in the triangle's own winding.
static double worst_weight(const double parts[3])
{
    double sum = parts[0] + parts[1] + parts[2];
    double low = parts[0] < parts[1] ? parts[0] : parts[1];
    double high = parts[0] < parts[1] ? parts[1] : parts[0];
    low = parts[2] < low ? parts[2] : low;
    high = parts[2] > high ? parts[2] : high;
    return sum > 0.0 ? low / sum : sum < 0.0 ? high / sum : -(double)INFINITY;
}

// The height where no triangle holds the point.
static float height_beside(const tl_nav_surface *surface, double x, double z)
{
    const tl_vec3 *corners[3];
    double parts[3];
    double worst = -(double)INFINITY;
    uint32_t best = UINT32_MAX;
    for (uint32_t i = 0; i < surface->triangle_count; i++) {
        corners_of(surface, i, corners);
        divide_triangle(*corners[0], *corners[1], *corners[2], x, z, parts);
        double weight = worst_weight(parts);
        if (weight > worst) {
            worst = weight;
            best = i;
        }
    }
    // Only a patch that is one vertical wall has no triangle with area in the plane.
    if (best == UINT32_MAX) {
        return nearest_vertex_height(surface, x, z);
    }
    triangle_weights weights;
    corners_of(surface, best, corners);
    divide_triangle(*corners[0], *corners[1], *corners[2], x, z, parts);
    weigh(parts, &weights);
    return mix_heights(corners, &weights);
}

enum { MAX_CODES = 256, FEW_TRIANGLES = 8 };

// On which sides of a point vertices lie, a bit a side: none of a triangle whose corners have one in common holds it.
// In a patch of many triangles that leaves one or two to look at.
static bool code_vertices(const tl_nav_surface *surface, float x, float z, uint8_t codes[MAX_CODES])
{
    if (surface->triangle_count < FEW_TRIANGLES || surface->vertex_count > MAX_CODES) {
        return false;
    }
    for (uint32_t i = 0; i < surface->vertex_count; i++) {
        const tl_vec3 *v = &surface->vertices[i];
        codes[i] = (uint8_t)((v->x < x ? 1 : 0) | (v->x > x ? 2 : 0) | (v->z < z ? 4 : 0) | (v->z > z ? 8 : 0));
    }
    return true;
}

// Compiled for each width of a triangle's corners.
static TL_ALWAYS_INLINE bool find_height_in(tl_nav_surface surface, bool is_wide, float x, float z, float *height_out)
{
    uint8_t codes[MAX_CODES];
    surface.is_wide = is_wide;
    const bool has_codes = code_vertices(&surface, x, z, codes);
    for (uint32_t i = 0; i < surface.triangle_count; i++) {
        const tl_nav_detail_triangle triangle = tl_nav_surface_triangle(&surface, i);
        const uint16_t *at = triangle.corner;
        if (has_codes && (codes[at[0]] & codes[at[1]] & codes[at[2]]) != 0) {
            continue;
        }
        const tl_vec3 *corners[3] = { &surface.vertices[at[0]], &surface.vertices[at[1]], &surface.vertices[at[2]] };
        double parts[3];
        triangle_weights weights;
        divide_triangle(*corners[0], *corners[1], *corners[2], (double)x, (double)z, parts);
        if (has_no_negative_part(parts) && weigh(parts, &weights)) {
            *height_out = mix_heights(corners, &weights);
            return true;
        }
    }
    return false;
}

static bool find_height(const tl_nav_surface *surface, float x, float z, float *height_out)
{
    return surface->is_wide ? find_height_in(*surface, true, x, z, height_out)
                            : find_height_in(*surface, false, x, z, height_out);
}

bool tl_nav_find_surface_height(const tl_nav_tile *tile, uint32_t polygon, float x, float z, float *height_out)
{
    const tl_nav_surface surface = tl_nav_tile_surface(tile, polygon);
    return find_height(&surface, x, z, height_out);
}

float tl_nav_surface_height(const tl_nav_tile *tile, uint32_t polygon, float x, float z)
{
    const tl_nav_surface surface = tl_nav_tile_surface(tile, polygon);
    float height = 0.0f;
    return find_height(&surface, x, z, &height) ? height : height_beside(&surface, (double)x, (double)z);
}
