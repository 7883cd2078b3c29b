// SPDX-License-Identifier: MIT
//
// half_plane_program.c against a scan of all candidates: the wanted point, its projections on the lines and the disc,
// and all crossings. Where nothing is feasible, against the least violation that a fine lattice finds.

#include "nav_crowd/half_plane_program.h"
#include "talus_test.h"

#include <math.h>

static double violation(const tl_half_plane *p, double x, double z)
{
    return (double)p->along_x * ((double)p->z - z) - (double)p->along_z * ((double)p->x - x);
}

static tl_half_plane_program random_program(test_random *random, uint32_t count, float spread)
{
    tl_half_plane_program program;
    program.count = count;
    program.hard_count = 0;
    program.max_length = 1.5f;
    double angle = 6.283185307 * (double)test_random_unit(random), length = 1.5 * (double)test_random_unit(random);
    program.wanted_x = (float)(length * cos(angle));
    program.wanted_z = (float)(length * sin(angle));
    for (uint32_t i = 0; i < count; i++) {
        double a = 6.283185307 * (double)test_random_unit(random);
        tl_half_plane plane = { test_random_range(random, -spread, spread), test_random_range(random, -spread, spread),
                                (float)cos(a), (float)sin(a) };
        program.planes[i] = plane;
    }
    return program;
}

typedef struct best_point {
    bool found;
    double distance;
} best_point;

static void try_point(const tl_half_plane_program *p, double x, double z, best_point *best)
{
    const double slack = 1e-6;
    bool feasible = x * x + z * z <= (double)p->max_length * (double)p->max_length * (1.0 + slack);
    for (uint32_t i = 0; i < p->count && feasible; i++) {
        feasible = violation(&p->planes[i], x, z) <= slack;
    }
    double distance = hypot(x - (double)p->wanted_x, z - (double)p->wanted_z);
    if (feasible && (!best->found || distance < best->distance)) {
        best->found = true;
        best->distance = distance;
    }
}

static best_point scan(const tl_half_plane_program *p)
{
    best_point best = { false, 0.0 };
    try_point(p, (double)p->wanted_x, (double)p->wanted_z, &best);
    for (uint32_t i = 0; i < p->count; i++) {
        const tl_half_plane *a = &p->planes[i];
        double ax = (double)a->along_x, az = (double)a->along_z, px = (double)a->x, pz = (double)a->z;
        double t = ax * ((double)p->wanted_x - px) + az * ((double)p->wanted_z - pz);
        try_point(p, px + t * ax, pz + t * az, &best);
        double middle = -(px * ax + pz * az);
        double half_sq = middle * middle + (double)p->max_length * (double)p->max_length - px * px - pz * pz;
        for (int sign = -1; sign <= 1 && half_sq >= 0.0; sign += 2) {
            double s = middle + sign * sqrt(half_sq);
            try_point(p, px + s * ax, pz + s * az, &best);
        }
        for (uint32_t k = 0; k < i; k++) {
            const tl_half_plane *b = &p->planes[k];
            double sine = ax * (double)b->along_z - az * (double)b->along_x;
            if (fabs(sine) > 1e-9) {
                double s = ((double)b->along_x * (pz - (double)b->z) - (double)b->along_z * (px - (double)b->x)) / sine;
                try_point(p, px + s * ax, pz + s * az, &best);
            }
        }
    }
    return best;
}

static double worst_violation(const tl_half_plane_program *p, double x, double z)
{
    double worst = 0.0;
    for (uint32_t i = p->hard_count; i < p->count; i++) {
        worst = fmax(worst, violation(&p->planes[i], x, z));
    }
    return worst;
}

static void test_random_programs(void **state)
{
    (void)state;
    test_random random = { 77 };
    uint32_t feasible = 0, infeasible = 0, bound = 0;
    for (uint32_t round = 0; round < 40000; round++) {
        const tl_half_plane_program p = random_program(&random, 1 + round % 12, round % 3 == 0 ? 0.4f : 1.2f);
        float v[2];
        tl_half_plane_solve(&p, v);
        TEST_CHECK(hypot((double)v[0], (double)v[1]) <= 1.5 * (1.0 + 1e-5));
        const best_point best = scan(&p);
        double x = (double)v[0], z = (double)v[1];
        if (best.found) {
            feasible++;
            bound += best.distance > 1e-6;
            // Sharp crossings magnify the rounding of directions.
            TEST_CHECK(worst_violation(&p, x, z) < 2e-3);
            TEST_CHECK(hypot(x - (double)p.wanted_x, z - (double)p.wanted_z) < best.distance + 2e-2);
        } else if (round % 16 == 0) {
            infeasible++;
            double least = worst_violation(&p, x, z);
            for (int i = -60; i <= 60; i++) {
                for (int k = -60; k <= 60; k++) {
                    double lx = 1.5 * i / 60.0, lz = 1.5 * k / 60.0;
                    if (lx * lx + lz * lz <= 2.25) {
                        TEST_CHECK(worst_violation(&p, lx, lz) > least - 2e-3);
                    }
                }
            }
        }
    }
    TEST_CHECK(feasible > 10000 && bound > 5000 && infeasible > 200);
}

// Hard half-planes hold, whatever the others ask for.
static void test_hard(void **state)
{
    (void)state;
    test_random random = { 78 };
    uint32_t relaxed = 0;
    for (uint32_t round = 0; round < 20000; round++) {
        tl_half_plane_program p = random_program(&random, 3 + round % 9, 1.0f);
        p.hard_count = 1 + round % 2;
        for (uint32_t i = 0; i < p.hard_count; i++) { // walls: standing still is allowed
            p.planes[i].x = -p.planes[i].along_z * -0.05f;
            p.planes[i].z = p.planes[i].along_x * -0.05f;
        }
        float v[2];
        tl_half_plane_solve(&p, v);
        for (uint32_t i = 0; i < p.hard_count; i++) {
            TEST_CHECK(violation(&p.planes[i], (double)v[0], (double)v[1]) < 1e-4);
        }
        relaxed += worst_violation(&p, (double)v[0], (double)v[1]) > 1e-3;
    }
    TEST_CHECK(relaxed > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_random_programs), cmocka_unit_test(test_hard) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
