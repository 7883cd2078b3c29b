// SPDX-License-Identifier: MIT
//
// Boundary loops by counted steps: near-linear whichever way the half-edges' numbers run along a loop.

#include "talus_test.h"

#include "halfedge/boundary_loop.h"

typedef enum loop_order { ORDER_FORWARD, ORDER_BACKWARD, ORDER_SHUFFLED, ORDER_COUNT } loop_order;

// A fan of so many triangles, added in one of three orders: the outline is one loop.
static void make_fan(tl_halfedge_mesh *mesh, loop_order order, uint32_t count)
{
    test_random random = { count };
    uint32_t *corners = malloc(count * sizeof *corners), hub;
    for (uint32_t i = 0; i < count; i++) {
        double turn = 6.283185307179586 * (double)i / (double)count;
        TEST_RESULT(tl_halfedge_mesh_add_vertex(mesh, tl_vec3_make((float)cos(turn), (float)sin(turn), 0.0f), &hub),
                    TL_OK);
        corners[i] = order == ORDER_BACKWARD ? count - 1 - i : i;
    }
    TEST_RESULT(tl_halfedge_mesh_add_vertex(mesh, tl_vec3_make(0.0f, 0.0f, 0.0f), &hub), TL_OK);
    for (uint32_t i = count - 1; i > 0 && order == ORDER_SHUFFLED; i--) {
        uint32_t k = test_random_below(&random, i + 1), swap = corners[i];
        corners[i] = corners[k];
        corners[k] = swap;
    }
    for (uint32_t i = 0; i < count; i++) {
        TEST_RESULT(tl_halfedge_mesh_add_triangle(mesh, hub, corners[i], (corners[i] + 1) % count, NULL), TL_OK);
    }
    free(corners);
}

static void test_all_loops_take_near_linear_steps(void **state)
{
    (void)state;
    for (loop_order order = ORDER_FORWARD; order < ORDER_COUNT; order++) {
        for (uint32_t count = 64, log2 = 6; count <= 4096; count *= 4, log2 += 2) {
            tl_halfedge_mesh mesh;
            tl_halfedge_mesh_init(&mesh, NULL);
            make_fan(&mesh, order, count);
            TEST_CHECK(mesh.boundary_count == count);
            uint64_t steps = 0;
            uint32_t loops = 0, lowest = TL_HALFEDGE_NONE;
            for (uint32_t e = 0; e < mesh.edge_end; e++) {
                if (tl_halfedge_is_edge(&mesh, e) && mesh.edges[e].face == TL_HALFEDGE_NONE &&
                    tl_halfedge_is_lowest_of_loop(&mesh, e, &steps)) {
                    lowest = e;
                    loops++;
                }
            }
            // Each half-edge looks twice at what is the smaller part, and the lowest at all; one way takes L^2 / 2.
            TEST_CHECK(loops == 1 && steps <= 2 * (uint64_t)count * (log2 + 2));
            TEST_CHECK(tl_halfedge_mesh_next_boundary_loop(&mesh, 0) == lowest &&
                       tl_halfedge_mesh_next_boundary_loop(&mesh, lowest + 1) == TL_HALFEDGE_NONE);
            tl_halfedge_mesh_destroy(&mesh);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_loops_take_near_linear_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
