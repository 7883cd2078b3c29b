// SPDX-License-Identifier: MIT
//
// Rays against triangles: what does this ray hit, can these two see each other?

#include <talus/soup.h>

#include <stdio.h>

int main(void)
{
    // A floor of two triangles, and a wall of two that stands across it.
    const tl_vec3 vertices[] = { { -5, 0, -5 }, { -5, 0, 5 }, { 5, 0, 5 }, { 5, 0, -5 },
                                 { 0, 0, -2 },  { 0, 0, 2 },  { 0, 3, 2 }, { 0, 3, -2 } };
    const uint32_t indices[] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7 };
    tl_mesh_view level = { vertices, 8, indices, 4, NULL };

    tl_soup *soup;
    tl_soup_report report;
    tl_result result = tl_soup_bake(&level, NULL, &soup, &report);
    if (result != TL_OK) {
        fprintf(stderr, "bake: %s\n", tl_result_text(result));
        return 1;
    }
    printf("%u triangles in %u pairs, %llu bytes\n", report.triangle_count, report.pair_count,
           (unsigned long long)tl_soup_size(soup));

    // The closest hit. The direction need not have length 1; t counts in its lengths.
    tl_ray ray = { { -4, 2, 0 }, { 1, 0, 0 }, 100.0f };
    tl_ray_hit hit;
    bool wall = tl_soup_cast_ray(soup, &ray, NULL, &hit);
    if (wall) {
        tl_vec3 point = tl_mul_add(ray.origin, ray.direction, hit.t);
        printf("hit triangle %u at (%g, %g, %g), t = %g\n", hit.triangle, (double)point.x, (double)point.y,
               (double)point.z, (double)hit.t);
    }

    // Line of sight: the wall stands between the first two, the third looks past its end.
    tl_vec3 guard = { -3, 1.7f, 0 };
    tl_vec3 thief = { 3, 1.7f, 0 };
    tl_vec3 friend_of_hers = { 0.5f, 1.7f, 4 };
    bool sees_thief = tl_soup_line_of_sight(soup, guard, thief, NULL);
    bool sees_friend = tl_soup_line_of_sight(soup, guard, friend_of_hers, NULL);
    printf("the guard %s the thief and %s her friend\n", sees_thief ? "sees" : "does not see",
           sees_friend ? "sees" : "does not see");

    tl_blob_free(soup);
    return wall && hit.t == 4.0f && !sees_thief && sees_friend ? 0 : 1;
}
