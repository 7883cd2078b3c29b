// SPDX-License-Identifier: MIT
//
// A character as a capsule: walk into a wall, stop at it, slide along, and get out when pushed inside.

#include <talus/convex.h>

#include <math.h>
#include <stdio.h>

int main(void)
{
    // Standing on y = 0, 1.8 m tall, 0.3 m wide to each side.
    tl_convex character = tl_convex_capsule(tl_vec3_make(0, 0.3f, 0), tl_vec3_make(0, 1.5f, 0), 0.3f);
    // A wall whose near face is x = 4.
    tl_convex wall = tl_convex_box(tl_vec3_make(4.5f, 1, 0), tl_vec3_make(0.5f, 1, 10), 0.0f);
    tl_transform at_wall = tl_transform_identity(), at = tl_transform_identity();

    // A step of six metres, slantwise. The cast moves B, so the character is B, and the normal points to it.
    tl_vec3 motion = tl_vec3_make(6, 0, 3);
    tl_convex_hit hit;
    if (!tl_convex_cast(&wall, at_wall, &character, at, motion, &hit)) {
        return 1;
    }
    printf("touches after %.3f of the way, at (%.3f, %.3f, %.3f)\n", (double)hit.t, (double)hit.point.x,
           (double)hit.point.y, (double)hit.point.z);
    at.position = tl_scale(motion, hit.t);
    float stopped_x = at.position.x;

    // What is left of the motion, without the part into the wall.
    tl_vec3 rest = tl_scale(motion, 1.0f - hit.t);
    tl_vec3 slide = tl_sub(rest, tl_scale(hit.normal, tl_dot(rest, hit.normal)));
    tl_convex_hit second;
    bool blocked = tl_convex_cast(&wall, at_wall, &character, at, slide, &second);
    if (!blocked) {
        at.position = tl_add(at.position, slide);
    }
    printf("slides to (%.3f, %.3f, %.3f)\n", (double)at.position.x, (double)at.position.y, (double)at.position.z);

    // Something pushes the character 0.2 m into the wall: the depth says how to part them.
    tl_transform inside = at;
    inside.position.x += 0.2f;
    tl_penetration penetration;
    bool overlap = tl_convex_penetration(&wall, at_wall, &character, inside, NULL, &penetration);
    inside.position = tl_mul_add(inside.position, penetration.normal, penetration.depth);
    printf("%.3f deep, back at x = %.3f\n", (double)penetration.depth, (double)inside.position.x);

    bool right = fabsf(stopped_x - 3.7f) < 1e-4f && fabsf(at.position.z - 3.0f) < 1e-3f && overlap &&
                 fabsf(penetration.depth - 0.2f) < 1e-4f && fabsf(inside.position.x - 3.7f) < 1e-4f;
    return right ? 0 : 1;
}
