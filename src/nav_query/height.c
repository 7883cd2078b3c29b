// SPDX-License-Identifier: MIT
//
// Height on a polygon: find the detail triangle under the point, weight its corners.
//
// No triangle may hold the point by a rounding's breadth, at an edge of the patch. Then the triangle that misses it
// least answers, with its negative weights cut off; so a point on a polygon always has a height.

#include "nav_query/navmesh.h"
#include "nav_query/surface.h"

typedef struct triangle_weights {
    double w[3];  // parts of the area, sum 1
    double worst; // the smallest of them; >= 0: the triangle holds the point
} triangle_weights;

// False for a triangle without area in the plane.
static bool weigh(tl_vec3 a, tl_vec3 b, tl_vec3 c, double x, double z, triangle_weights *out)
{
    double ax = (double)a.x - x, az = (double)a.z - z;
    double bx = (double)b.x - x, bz = (double)b.z - z;
    double cx = (double)c.x - x, cz = (double)c.z - z;
    double wa = bx * cz - bz * cx;
    double wb = cx * az - cz * ax;
    double wc = ax * bz - az * bx;
    double sum = wa + wb + wc;
    if (sum == 0.0) {
        return false;
    }
    out->w[0] = wa / sum;
    out->w[1] = wb / sum;
    out->w[2] = wc / sum;
    out->worst = out->w[0] < out->w[1] ? out->w[0] : out->w[1];
    out->worst = out->w[2] < out->worst ? out->w[2] : out->worst;
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

float tl_nav_surface_height(const tl_nav_tile *tile, uint32_t polygon, float x, float z)
{
    tl_nav_surface surface = tl_nav_tile_surface(tile, polygon);
    const tl_vec3 *best[3] = { NULL, NULL, NULL };
    triangle_weights best_weights = { { 0.0, 0.0, 0.0 }, -(double)INFINITY };
    for (uint32_t i = 0; i < surface.triangle_count && best_weights.worst < 0.0; i++) {
        const tl_nav_detail_triangle *triangle = &surface.triangles[i];
        const tl_vec3 *a = &surface.vertices[triangle->corner[0]];
        const tl_vec3 *b = &surface.vertices[triangle->corner[1]];
        const tl_vec3 *c = &surface.vertices[triangle->corner[2]];
        triangle_weights weights;
        if (weigh(*a, *b, *c, (double)x, (double)z, &weights) && weights.worst > best_weights.worst) {
            best_weights = weights;
            best[0] = a;
            best[1] = b;
            best[2] = c;
        }
    }
    // Only a patch that is one vertical wall has no triangle with area in the plane.
    return best[0] != NULL ? mix_heights(best, &best_weights) : nearest_vertex_height(&surface, (double)x, (double)z);
}

tl_result tl_navmesh_height(const tl_navmesh *navmesh, tl_nav_ref ref, float x, float z, float *height_out)
{
    tl_vec3 closest;
    *height_out = 0.0f;
    tl_result result = tl_navmesh_closest_point(navmesh, ref, tl_vec3_make(x, 0.0f, z), &closest, NULL);
    if (result == TL_OK) {
        *height_out = closest.y;
    }
    return result;
}
