// SPDX-License-Identifier: MIT
//
// A character in a level of triangles: fall to the floor, walk into a wall, slide along it, and look where the head is.

#include <talus/soup.h>

#include <math.h>
#include <stdio.h>

// A floor of two triangles, 20 m square, and a wall across it at x = 4.
static const tl_vec3 vertices[8] = { { -10, 0, -10 }, { 10, 0, -10 }, { 10, 0, 10 }, { -10, 0, 10 },
                                     { 4, 0, -10 },   { 4, 3, -10 },  { 4, 3, 10 },  { 4, 0, 10 } };
static const uint32_t indices[12] = { 0, 2, 1, 0, 3, 2, 4, 7, 6, 4, 6, 5 };

// Moves until something is hit, and returns the rest of the motion without its component into the surface.
static tl_vec3 move(const tl_soup *soup, const tl_convex *body, tl_transform *at, tl_vec3 motion)
{
    tl_shape_hit hit;
    if (tl_soup_cast_shape(soup, body, *at, motion, NULL, &hit) != TL_OK) {
        at->position = tl_add(at->position, motion);
        return tl_vec3_make(0, 0, 0);
    }
    printf("  meets triangle %u after %.3f of the way\n", hit.triangle, (double)hit.t);
    at->position = tl_mul_add(at->position, motion, hit.t);
    tl_vec3 rest = tl_scale(motion, 1 - hit.t);
    return tl_sub(rest, tl_scale(hit.normal, tl_dot(rest, hit.normal)));
}

int main(void)
{
    tl_mesh_view view = { vertices, 8, indices, 4, NULL };
    tl_soup *soup;
    if (tl_soup_bake(&view, NULL, &soup, NULL) != TL_OK) {
        return 1;
    }
    // 1.8 m tall, 0.3 m to each side; the position is at its feet.
    tl_convex body = tl_convex_capsule(tl_vec3_make(0, 0.3f, 0), tl_vec3_make(0, 1.5f, 0), 0.3f);
    tl_transform at = tl_transform_identity();
    at.position = tl_vec3_make(0, 2, 0);
    (void)move(soup, &body, &at, tl_vec3_make(0, -5, 0));
    float floor_height = at.position.y;
    // It stands on the floor, and slides over the floor's inner edge until the wall stops it.
    tl_vec3 rest = move(soup, &body, &at, tl_vec3_make(6, 0, 3));
    (void)move(soup, &body, &at, rest);
    printf("stands at (%.3f, %.3f, %.3f)\n", (double)at.position.x, (double)at.position.y, (double)at.position.z);

    tl_soup_point nearest;
    tl_vec3 head = tl_add(at.position, tl_vec3_make(0, 1.7f, 0));
    tl_result result = tl_soup_nearest(soup, head, 1.0f, NULL, &nearest);
    printf("its head is %.3f from triangle %u\n", (double)nearest.distance, nearest.triangle);
    bool right = result == TL_OK && fabsf(nearest.distance - 0.3f) < 1e-4f && fabsf(floor_height) < 1e-4f &&
                 fabsf(at.position.x - 3.7f) < 1e-4f && fabsf(at.position.z - 3.0f) < 1e-3f;
    tl_blob_free(soup);
    return right ? 0 : 1;
}
