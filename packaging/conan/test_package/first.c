// SPDX-License-Identifier: MIT
//
// A ray down to a floor 10 m square: what an installed library must answer.
#include <talus/talus.h>

#include <stdio.h>

int main(void)
{
    const tl_vec3 vertices[] = { { -5, 0, -5 }, { -5, 0, 5 }, { 5, 0, 5 }, { 5, 0, -5 } };
    const uint32_t indices[] = { 0, 1, 2, 0, 2, 3 };
    const tl_mesh_view triangles = { vertices, 4, indices, 2, NULL };
    const tl_ray ray = { { 1, 30, 0 }, { 0, -1, 0 }, 100.0f };
    tl_soup *soup;
    tl_ray_hit hit = { 0 };
    if (tl_soup_bake(&triangles, NULL, &soup, NULL) != TL_OK) {
        return 1;
    }
    const bool found = tl_soup_cast_ray(soup, &ray, NULL, &hit);
    printf("talus %s: triangle %u at %g m\n", tl_version(), hit.triangle, (double)hit.t);
    tl_blob_free(soup);
    return found && hit.triangle == 1 ? 0 : 1;
}
