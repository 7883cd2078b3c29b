// SPDX-License-Identifier: MIT
//
// The promise of temporary obstacles: the navmesh keeps the agent's whole radius from a body, by whatever error
// contours may be simplified, in every partition.

#include "obstacle_world.h"

#include <talus/nav_around.h>

// How near the navmesh comes to bodies: never nearer than the agent's radius, whatever contours may be simplified by.
static void check_clearance(const world *w, const tl_nav_obstacle *bodies, uint32_t count, double *nearest,
                            uint32_t *beside)
{
    const double limit = (double)w->def.agent_radius - 1e-4; // lattice places are rounded to floats
    for (uint32_t slot = 0; slot < tl_navmesh_slot_count(w->navmesh); slot++) {
        const tl_nav_tile *tile = tl_navmesh_slot_tile(w->navmesh, slot);
        for (uint32_t p = 0; tile != NULL && p < tile->polygon_count; p++) {
            uint32_t corners = 0;
            const tl_vec3 *at = tl_nav_tile_corners(tile, p, &corners);
            for (uint32_t k = 0; k < corners * 8; k++) {
                const tl_vec3 point = tl_lerp(at[k / 8], at[(k / 8 + 1) % corners], (float)(k % 8) / 8.0f);
                for (uint32_t b = 0; b < count; b++) {
                    const double rough =
                        hypot((double)point.x - (double)bodies[b].base.x, (double)point.z - (double)bodies[b].base.z);
                    const double distance =
                        rough < 4.0 ? outline_distance(&bodies[b], (double)point.x, (double)point.z) : rough;
                    TEST_CHECK(distance > limit);
                    *nearest = fmin(*nearest, distance);
                    *beside += distance < 1.0;
                }
            }
        }
    }
}

static void test_clearance(void **state)
{
    (void)state;
    static const float errors[] = { 0.5f, 1.3f, 4.0f };
    test_random random = { 77 };
    double nearest = 1e9;
    uint32_t beside = 0;
    for (uint32_t round = 0; round < 24; round++) {
        world w;
        test_level_make(&w.level, tl_vec3_make(0, 0, 0));
        w.def = make_def();
        w.def.cell_size = round % 2 == 0 ? 0.2f : 0.3f;
        w.def.edge_max_error = errors[round % 3];
        w.def.partition = (tl_nav_partition)(round / 3 % 3);
        memset(&w.input, 0, sizeof w.input);
        w.input.mesh = w.level.mesh;
        TEST_RESULT(tl_nav_obstacles_bake(&w.def, &w.input, &w.obstacles, NULL, NULL), TL_OK);
        TEST_RESULT(tl_navmesh_create(NULL, &w.navmesh), TL_OK);
        tl_nav_obstacle bodies[6];
        for (int i = 0; i < 6; i++) {
            tl_nav_obstacle_id id;
            bodies[i] = random_obstacle(&random);
            bodies[i].area = TL_NAV_NULL_AREA;
            bodies[i].base.y = -4.0f; // through all storeys
            bodies[i].height = 14.0f;
            TEST_RESULT(tl_nav_obstacles_add(w.obstacles, &bodies[i], &id, NULL), TL_OK);
        }
        settle(&w);
        check_clearance(&w, bodies, 6, &nearest, &beside);
        free_world(&w);
    }
    // Nor does it keep much more than 0.6.
    TEST_CHECK(beside > 1000 && nearest < 0.62);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_clearance) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
