// SPDX-License-Identifier: MIT
//
// Courtyard: wards of 40 m side by side. A ward is a walled court with a gate in each side and a wall-walk behind a
// crenellated parapet, reached by stairs and by a ramp; a bridge crosses over the court from walk to walk; below lie a
// garden with a kerb and thin fences, a sunken basin, a well, a colonnade under a roof with overhang, and a gatehouse
// with a room inside.

#include "cli/sample/sample_carving.h"
#include "cli/sample/sample_level.h"

#define WARD       40.0f
#define HALF_WALL  18.0f // outer face of the walls, from the ward's centre
#define INNER_FACE 15.0f // inner face
#define WALK       5.0f  // height of the wall-walk

static void add_court_ground(const tl_sample_plan *plan, tl_sample_mesh *mesh)
{
    tl_sample_carving ground = { 0 };
    float half = 0.5f * WARD;
    tl_sample_carving_add(&ground, -half, -7.0f, -half, half, 0.0f, half);
    if (plan->detail > 0) {
        tl_sample_carving_cut(&ground, 4.0f, -0.8f, 4.0f, 11.0f, 0.0f, 11.0f); // basin, two steps deep
        tl_sample_carving_add(&ground, 4.0f, -0.8f, 4.0f, 11.0f, -0.4f, 5.0f);
        tl_sample_carving_cut(&ground, -4.0f, -6.0f, 8.0f, -2.5f, 0.0f, 9.5f);     // well
        tl_sample_carving_add(&ground, -12.0f, 0.0f, -11.0f, -4.0f, 0.15f, -4.0f); // garden bed with a kerb
        tl_sample_carving_cut(&ground, -11.7f, 0.05f, -10.7f, -4.3f, 0.15f, -4.3f);
    }
    tl_sample_carving_finish(&ground, NULL, mesh);
}

static void add_curtain_walls(const tl_sample_plan *plan, tl_sample_mesh *mesh)
{
    tl_sample_carving walls = { 0 };
    float a = HALF_WALL;
    tl_sample_carving_add(&walls, -a, 0.0f, -a, a, WALK, a);
    if (plan->detail > 0) {
        tl_sample_carving_add(&walls, -a, WALK, -a, a, WALK + 1.1f, a);
        tl_sample_carving_cut(&walls, -a + 0.3f, WALK, -a + 0.3f, a - 0.3f, WALK + 1.1f, a - 0.3f);
        for (int i = -3; i <= 3; ++i) { // crenels
            float at = 4.5f * (float)i;
            tl_sample_carving_cut(&walls, at - 0.5f, WALK + 0.6f, -a, at + 0.5f, WALK + 1.1f, a);
            tl_sample_carving_cut(&walls, -a, WALK + 0.6f, at - 0.5f, a, WALK + 1.1f, at + 0.5f);
        }
    }
    tl_sample_carving_cut(&walls, -INNER_FACE, 0.0f, -INNER_FACE, INNER_FACE, WALK, INNER_FACE);
    tl_sample_carving_cut(&walls, -1.6f, 0.0f, -a, 1.6f, 3.4f, a); // gates
    tl_sample_carving_cut(&walls, -a, 0.0f, -1.6f, a, 3.4f, 1.6f);
    if (plan->detail > 0) { // bridge over the court with low rails
        tl_sample_carving_add(&walls, -INNER_FACE, WALK - 0.3f, -1.2f, INNER_FACE, WALK, 1.2f);
        tl_sample_carving_add(&walls, -INNER_FACE, WALK, -1.2f, INNER_FACE, WALK + 1.0f, -1.1f);
        tl_sample_carving_add(&walls, -INNER_FACE, WALK, 1.1f, INNER_FACE, WALK + 1.0f, 1.2f);
    }
    tl_sample_carving_finish(&walls, NULL, mesh);
}

static void add_climbs(const tl_sample_plan *plan, tl_vec3 center, unsigned turns, tl_sample_mesh *mesh)
{
    float w = INNER_FACE;
    tl_sample_place(mesh, center, turns);
    tl_sample_stairs(mesh, tl_sample_bounds(-w + 4.0f, 0.0f, -w, -w + 11.0f, WALK, -w + 2.6f), plan->detail ? 25 : 12);
    tl_sample_box(mesh, tl_sample_bounds(-w + 11.0f, 0.0f, -w, -w + 13.0f, WALK, -w + 2.6f)); // landing
    if (plan->detail > 0) {
        tl_sample_place(mesh, center, turns + 2);
        tl_sample_ramp(mesh, tl_sample_bounds(-w + 1.5f, 0.0f, -w, -w + 12.0f, WALK, -w + 2.6f));
        tl_sample_box(mesh, tl_sample_bounds(-w + 12.0f, 0.0f, -w, -w + 13.5f, WALK, -w + 2.6f));
    }
}

// Pillars along +x under a lean-to roof that hangs over them.
static void add_colonnade(tl_vec3 center, unsigned turns, tl_sample_mesh *mesh)
{
    tl_sample_place(mesh, center, turns);
    for (int side = -1; side <= 1; side += 2) {
        for (int i = 0; i < 4; ++i) {
            tl_vec3 base = { INNER_FACE - 3.0f, 0.0f, (float)side * (3.0f + 3.0f * (float)i) };
            tl_sample_pillar(mesh, base, 0.3f, 3.2f, 3);
        }
        float z0 = side < 0 ? -13.0f : 2.2f;
        tl_sample_ramp(mesh, tl_sample_bounds(INNER_FACE - 4.0f, 3.2f, z0, INNER_FACE, 4.4f, z0 + 10.8f));
    }
}

static void add_fences(tl_vec3 center, unsigned turns, tl_sample_mesh *mesh)
{
    tl_sample_carving fence = { 0 };
    tl_sample_place(mesh, center, turns);
    tl_sample_carving_add(&fence, -12.6f, 0.0f, -11.6f, -3.4f, 1.1f, -3.4f);
    tl_sample_carving_cut(&fence, -12.54f, 0.0f, -11.54f, -3.46f, 1.1f, -3.46f);
    tl_sample_carving_cut(&fence, -8.8f, 0.0f, -3.46f, -7.2f, 1.1f, -3.4f);
    tl_sample_carving_finish(&fence, NULL, mesh);
}

static void add_gatehouse(tl_vec3 center, unsigned turns, tl_sample_mesh *mesh)
{
    tl_sample_carving house = { 0 };
    tl_sample_place(mesh, center, turns);
    tl_sample_carving_add(&house, -13.0f, 0.0f, 7.0f, -6.0f, 3.4f, 12.6f);
    tl_sample_carving_cut(&house, -12.7f, 0.15f, 7.3f, -6.3f, 3.0f, 12.3f);
    tl_sample_carving_cut(&house, -9.2f, 0.15f, 7.0f, -7.0f, 2.45f, 7.3f);
    tl_sample_carving_cut(&house, -6.3f, 1.1f, 9.0f, -6.0f, 2.2f, 10.4f);
    tl_sample_carving_add(&house, -9.6f, 0.15f, 9.8f, -9.5f, 3.0f, 12.3f); // a thin partition inside
    tl_sample_carving_finish(&house, NULL, mesh);
    tl_sample_gable(mesh, tl_sample_bounds(-13.6f, 3.4f, 6.4f, -5.4f, 5.6f, 13.2f));
}

void tl_sample_build_courtyard(const tl_sample_plan *plan, tl_sample_mesh *mesh)
{
    for (uint32_t row = 0; row < plan->rows; ++row) {
        for (uint32_t column = 0; column < plan->columns; ++column) {
            tl_vec3 center = { ((float)column + 0.5f) * WARD, 0.0f, ((float)row + 0.5f) * WARD };
            tl_sample_random random = tl_sample_random_make(plan->seed, column, row);
            unsigned turns = tl_sample_random_below(&random, 4);
            tl_sample_place(mesh, center, turns);
            add_court_ground(plan, mesh);
            add_curtain_walls(plan, mesh);
            add_climbs(plan, center, turns, mesh);
            if (plan->detail > 0) {
                add_colonnade(center, turns, mesh);
                add_fences(center, turns, mesh);
                add_gatehouse(center, turns, mesh);
            }
        }
    }
}

// In the alley between the wards, where nothing else stands, clear of the gates.
tl_vec3 tl_sample_courtyard_prop_place(const tl_sample_plan *plan, float radius, tl_sample_random *random)
{
    uint32_t column = tl_sample_random_below(random, plan->columns);
    uint32_t row = tl_sample_random_below(random, plan->rows);
    float across = tl_sample_random_range(random, HALF_WALL + 0.5f * radius, 0.5f * WARD - radius);
    float along = tl_sample_random_range(random, 2.5f + radius, 0.5f * WARD - radius);
    uint32_t corner = tl_sample_random_below(random, 8);
    float x = corner & 1 ? across : -across;
    float z = corner & 2 ? along : -along;
    tl_vec3 local = corner & 4 ? tl_vec3_make(z, 0.0f, x) : tl_vec3_make(x, 0.0f, z);
    return tl_add(tl_vec3_make(((float)column + 0.5f) * WARD, 0.0f, ((float)row + 0.5f) * WARD), local);
}
