// SPDX-License-Identifier: MIT
//
// The smallest use of talus: clean a square of two triangles, and find what lies across their shared edge.

#include <talus/talus.h>

#include <stdio.h>

int main(void)
{
    const tl_vec3 corners[6] = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 0, 0, 0 }, { 1, 0, 1 }, { 1, 0, 0 } };
    const uint32_t indices[6] = { 0, 1, 2, 3, 4, 5 };
    tl_mesh_view view = { corners, 6, indices, 2, NULL };

    tl_mesh_def def = tl_default_mesh_def();
    tl_mesh mesh;
    tl_mesh_report report;
    tl_result result = tl_mesh_bake(&view, &def, &mesh, &report);
    if (result != TL_OK) {
        fprintf(stderr, "talus: %s\n", tl_result_text(result));
        return 1;
    }
    tl_adjacency adjacency;
    tl_mesh_view clean = tl_mesh_as_view(&mesh);
    result = tl_adjacency_bake(&clean, NULL, &adjacency, NULL);
    if (result == TL_OK) {
        printf("talus %s: %u vertices welded to %u, %u shared edge\n", tl_version(), view.vertex_count,
               mesh.vertex_count, adjacency.paired_edges);
        tl_adjacency_free(&adjacency);
    }
    tl_mesh_free(&mesh);
    return result == TL_OK ? 0 : 1;
}
