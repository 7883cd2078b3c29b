// SPDX-License-Identifier: MIT
//
// Convex shapes: the hull of a cloud of points, its farthest point in a direction, the distance between two hulls.

#include <talus/convex.h>
#include <talus/hull.h>

#include <math.h>
#include <stdio.h>

int main(void)
{
    // The corners of a cube two metres wide, its centre, and a point on a face: neither is a vertex of the hull.
    const tl_vec3 points[] = { { -1, -1, -1 }, { 1, -1, -1 }, { 1, 1, -1 }, { -1, 1, -1 }, { -1, -1, 1 },
                               { 1, -1, 1 },   { 1, 1, 1 },   { -1, 1, 1 }, { 0, 0, 0 },   { 1, 0, 0 } };
    tl_hull *hull;
    tl_result result = tl_hull_bake(points, 10, NULL, &hull, NULL);
    if (result != TL_OK) {
        fprintf(stderr, "hull: %s\n", tl_result_text(result));
        return 1;
    }
    printf("V %u, E %u, F %u, volume %g\n", hull->vertex_count, hull->half_edge_count / 2, hull->face_count,
           hull->mass.volume);

    // The support function: the last answer is the best hint for the next, nearby direction.
    uint32_t farthest = tl_hull_support(hull, tl_vec3_make(1, 2, 3), TL_NO_VERTEX);
    tl_vec3 corner = tl_hull_vertices(hull)[farthest];
    printf("farthest along (1, 2, 3): (%g, %g, %g)\n", (double)corner.x, (double)corner.y, (double)corner.z);

    // A second one, five metres along x and turned by 45 degrees about y, so that an edge faces the first.
    tl_convex shape = tl_convex_from_hull(hull, 0.0f);
    tl_quat turn = { 0, 0.38268343f, 0, 0.92387953f };
    tl_transform here = tl_transform_identity();
    tl_transform there = { turn, { 5, 0, 0 } };
    tl_separation separation;
    tl_convex_distance(&shape, here, &shape, there, NULL, &separation);
    tl_vec3 a = separation.point_a, b = separation.point_b; // the witness points: where they are nearest
    printf("distance %g, from (%g, %g, %g) to (%g, %g, %g)\n", (double)separation.distance, (double)a.x, (double)a.y,
           (double)a.z, (double)b.x, (double)b.y, (double)b.z);

    bool right = hull->vertex_count == 8 && hull->face_count == 6 && corner.x == 1 && corner.y == 1 && corner.z == 1 &&
                 fabsf(separation.distance - (4.0f - sqrtf(2.0f))) < 1e-5f && !separation.overlap &&
                 fabsf(a.x - 1.0f) < 1e-5f && fabsf(tl_distance(a, b) - separation.distance) < 1e-5f;
    tl_blob_free(hull);
    return right ? 0 : 1;
}
