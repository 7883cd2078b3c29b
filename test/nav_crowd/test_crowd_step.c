// SPDX-License-Identifier: MIT
//
// Scenes that crowds are judged by: everyone arrives, nobody leaves the mesh or comes into a wall, and few overlap.

#include "crowd_world.h"

#define DT 0.05f

// Nobody off the mesh or in a wall; overlaps few and shallow: a fifth of a radius at most, and velocities steady.
static void check_measure(const crowd_measure *m)
{
    TEST_CHECK(m->off_mesh == 0 && m->in_walls == 0);
    TEST_CHECK(m->overlaps * 100 < m->agent_steps && m->deepest < 0.12f);
    TEST_CHECK(m->turn_sum < 0.05 * (double)m->agent_steps);
}

static void test_circle(void **state)
{
    (void)state;
    enum { COUNT = 250 };
    tl_navmesh *navmesh = crowd_open_floor(45.0f, 45.0f);
    tl_nav_crowd *crowd = crowd_make(COUNT);
    for (uint32_t i = 0; i < COUNT; i++) {
        double angle = 6.283185307179586 * i / COUNT;
        float x = (float)(40.0 * cos(angle)), z = (float)(40.0 * sin(angle));
        tl_nav_location goal = crowd_place(navmesh, -x, 0.0f, -z);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), x, 0.0f, z, &goal);
    }
    crowd_measure m;
    uint32_t steps = crowd_run(crowd, navmesh, DT, 6000, &m);
    crowd_print("circle 250", &m, DT);
    TEST_CHECK(steps < 3000);
    check_measure(&m);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

static void pass_door(float width, uint32_t count, uint32_t max_steps)
{
    tl_navmesh *navmesh = crowd_door_world(width);
    tl_nav_crowd *crowd = crowd_make(2 * count);
    for (uint32_t i = 0; i < 2 * count; i++) {
        float side = i % 2 == 0 ? 1.0f : -1.0f;
        float x = side * (5.0f + 1.2f * (float)(i / 2 / 10)), z = -9.0f + 2.0f * (float)(i / 2 % 10);
        tl_nav_location goal = crowd_place(navmesh, -x, 0.0f, z);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), x, 0.0f, z, &goal);
    }
    crowd_measure m;
    uint32_t steps = crowd_run(crowd, navmesh, DT, max_steps, &m);
    crowd_print("door", &m, DT);
    TEST_CHECK(steps < max_steps);
    check_measure(&m);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

static void test_door(void **state)
{
    (void)state;
    pass_door(1.5f, 100, 5000);
}

// Where only one fits through at a time.
static void test_narrow_door(void **state)
{
    (void)state;
    pass_door(0.9f, 40, 4000);
}

// Widths at which two may just not pass one another, and at which lanes form.
static void test_other_doors(void **state)
{
    (void)state;
    pass_door(1.2f, 50, 4000);
    pass_door(2.4f, 50, 3000);
}

static void test_one_point(void **state)
{
    (void)state;
    enum { COUNT = 500 };
    tl_navmesh *navmesh = crowd_open_floor(40.0f, 40.0f);
    tl_nav_crowd *crowd = crowd_make(COUNT);
    test_random random = { 5 };
    tl_nav_location goal = crowd_place(navmesh, 0.0f, 0.0f, 0.0f);
    for (uint32_t i = 0; i < COUNT; i++) {
        float x = -37.0f + 3.2f * (float)(i % 24) + test_random_range(&random, -1.2f, 1.2f);
        float z = -37.0f + 3.2f * (float)(i / 24) + test_random_range(&random, -1.2f, 1.2f);
        crowd_send(crowd, navmesh, tl_default_nav_agent_def(), x, 0.0f, z, &goal);
    }
    crowd_measure m;
    uint32_t steps = crowd_run(crowd, navmesh, DT, 3000, &m);
    crowd_print("one point", &m, DT);
    TEST_CHECK(steps < 1500);
    check_measure(&m);
    // Those who stand stand still: less than a metre each until the last one has come.
    TEST_CHECK(m.still_sum < 1.0 * COUNT);
    tl_nav_crowd_destroy(crowd);
    tl_navmesh_destroy(navmesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_circle), cmocka_unit_test(test_door),
                                        cmocka_unit_test(test_narrow_door), cmocka_unit_test(test_other_doors),
                                        cmocka_unit_test(test_one_point) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
