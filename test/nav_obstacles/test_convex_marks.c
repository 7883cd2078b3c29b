// SPDX-License-Identifier: MIT
//
// Floors under convex shapes at any pose: by the definition, floor for floor, with an oracle that shares no code with
// the pair queries; the same whatever the part of the field that is looked at; and upright shapes as the older kinds.

#include "nav_obstacles/footprint.h"
#include "obstacle_world.h"

#include <math.h>
#include <stdlib.h>
#include <talus/hull.h>

enum { MAX_ORACLE_POINTS = 128 };

// A shape as points in the world that are grown by a ball; rims of discs are polygons.
typedef struct oracle_shape {
    double points[MAX_ORACLE_POINTS][3];
    uint32_t count;
    double radius;
} oracle_shape;

typedef struct random_shape {
    tl_hull *hull;
    tl_vec3 points[24];
    tl_nav_obstacle obstacle;
    oracle_shape oracle;
} random_shape;

// ---- Shapes ------------------------------------------------------------------------------------------------

static void turn_to_world(tl_transform pose, const double local[3], double placed[3])
{
    const double x = (double)pose.rotation.x, y = (double)pose.rotation.y, z = (double)pose.rotation.z,
                 w = (double)pose.rotation.w;
    const double rows[3][3] = { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y) },
                                { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x) },
                                { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } };
    const double at[3] = { (double)pose.position.x, (double)pose.position.y, (double)pose.position.z };
    for (int r = 0; r < 3; r++) {
        placed[r] = rows[r][0] * local[0] + rows[r][1] * local[1] + rows[r][2] * local[2] + at[r];
    }
}

static void add_oracle_point(random_shape *shape, double x, double y, double z)
{
    const double local[3] = { x, y, z };
    TEST_CHECK(shape->oracle.count < MAX_ORACLE_POINTS);
    turn_to_world(shape->obstacle.pose, local, shape->oracle.points[shape->oracle.count++]);
}

static void add_rim(random_shape *shape, double radius, double y)
{
    for (int k = 0; k < 60; k++) {
        const double angle = 6.283185307179586 * k / 60.0;
        add_oracle_point(shape, radius * cos(angle), y, radius * sin(angle));
    }
}

static void make_points(random_shape *shape, test_random *random, uint32_t count, tl_vec3 half)
{
    for (uint32_t i = 0; i < count; i++) {
        shape->points[i] = test_random_point(random, tl_neg(half), half);
        add_oracle_point(shape, (double)shape->points[i].x, (double)shape->points[i].y, (double)shape->points[i].z);
    }
}

// One of every kind of shape, with a radius or without.
static void make_random_convex(random_shape *shape, test_random *random, uint32_t kind)
{
    const tl_vec3 half = test_random_point(random, tl_vec3_make(0.05f, 0.05f, 0.05f), tl_vec3_make(2.5f, 1.5f, 2.5f));
    const float radius = kind == 2 || test_random_below(random, 3) == 0 ? test_random_range(random, 0.05f, 0.8f) : 0.0f;
    shape->oracle.radius = (double)radius;
    tl_convex *convex = &shape->obstacle.convex;
    const tl_vec3 up = tl_vec3_make(0, half.y, 0), down = tl_vec3_make(0, -half.y, 0);
    switch (kind) {
    case 0:
        *convex = tl_convex_box(tl_vec3_make(0, 0, 0), half, radius);
        for (int k = 0; k < 8; k++) {
            add_oracle_point(shape, (k & 1) != 0 ? (double)half.x : -(double)half.x,
                             (k & 2) != 0 ? (double)half.y : -(double)half.y,
                             (k & 4) != 0 ? (double)half.z : -(double)half.z);
        }
        break;
    case 1:
        make_points(shape, random, 24, half);
        TEST_RESULT(tl_hull_bake(shape->points, 24, NULL, &shape->hull, NULL), TL_OK);
        *convex = tl_convex_from_hull(shape->hull, radius);
        break;
    case 2: // point, capsule, triangle: grown
        make_points(shape, random, 1 + test_random_below(random, 3), half);
        *convex = tl_convex_triangle(shape->points[0], shape->points[1], shape->points[2], radius);
        convex->point_count = shape->oracle.count;
        break;
    case 3:
        make_points(shape, random, 5, half);
        *convex = tl_convex_from_points(shape->points, 5, radius);
        break;
    case 4:
        *convex = tl_convex_cylinder(down, up, half.x, radius);
        add_rim(shape, (double)half.x, (double)half.y);
        add_rim(shape, (double)half.x, -(double)half.y);
        break;
    default:
        *convex = tl_convex_cone(down, up, half.x, radius);
        add_rim(shape, (double)half.x, -(double)half.y);
        add_oracle_point(shape, 0.0, (double)half.y, 0.0);
        break;
    }
}

static void make_random_shape(random_shape *shape, test_random *random, uint32_t kind)
{
    memset(shape, 0, sizeof *shape);
    const tl_vec3 axis = test_random_direction(random);
    const tl_quat turn = { axis.x, axis.y, axis.z, test_random_range(random, -1.0f, 1.0f) };
    shape->obstacle.shape = TL_NAV_OBSTACLE_CONVEX;
    shape->obstacle.area = (uint8_t)(test_random_below(random, 3) == 0 ? 1 + test_random_below(random, 4) : 0);
    shape->obstacle.pose.rotation = tl_quat_normalize(turn);
    shape->obstacle.pose.position = test_random_point(random, tl_vec3_make(-1, -1, -1), tl_vec3_make(26, 5, 19));
    make_random_convex(shape, random, kind);
}

// ---- The oracle: Gilbert's algorithm in double, with proven bounds -----------------------------------------

// What must be apart: a body's agent over its square, or the point of an area.
typedef struct oracle_agent {
    double half, radius, low, high;
} oracle_agent;

static double farthest_along(const oracle_shape *shape, const oracle_agent *agent, const double floor_at[3],
                             const double d[3], double point[3])
{
    uint32_t best = 0;
    double most = -1e30;
    for (uint32_t i = 0; i < shape->count; i++) {
        const double *p = shape->points[i];
        const double dot = p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
        best = dot > most ? i : best;
        most = dot > most ? dot : most;
    }
    const double flat = hypot(d[0], d[2]), length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double disc = flat > 0.0 ? agent->radius / flat : 0.0, ball = length > 0.0 ? shape->radius / length : 0.0;
    const double mine[3] = { copysign(agent->half, -d[0]) - d[0] * disc, d[1] > 0.0 ? agent->low : agent->high,
                             copysign(agent->half, -d[2]) - d[2] * disc };
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
        point[c] = shape->points[best][c] + d[c] * ball - (floor_at[c] + mine[c]);
        sum += point[c] * d[c];
    }
    return sum;
}

// Bounds of the distance between the shape and the agent.
static void bound_distance(const oracle_shape *shape, const oracle_agent *agent, const double floor_at[3],
                           double enough, double *low_out, double *high_out)
{
    double x[3], down[3] = { 1.0, 0.0, 0.0 };
    farthest_along(shape, agent, floor_at, down, x);
    double low = 0.0, length = 0.0;
    for (int step = 0; step < 3000; step++) {
        length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        if (length < enough) {
            break;
        }
        double point[3], move_sq = 0.0, toward = 0.0;
        for (int c = 0; c < 3; c++) {
            down[c] = -x[c];
        }
        const double bound = -farthest_along(shape, agent, floor_at, down, point) / length;
        low = fmax(low, bound);
        if (low > enough || length - low < 1e-3 * enough) {
            break;
        }
        for (int c = 0; c < 3; c++) {
            move_sq += (point[c] - x[c]) * (point[c] - x[c]);
            toward -= (point[c] - x[c]) * x[c];
        }
        const double t = move_sq > 0.0 ? fmin(1.0, fmax(0.0, toward / move_sq)) : 0.0;
        for (int c = 0; c < 3; c++) {
            x[c] += t * (point[c] - x[c]);
        }
    }
    *low_out = low;
    *high_out = length;
}

enum { ORACLE_FREE, ORACLE_TAKEN, ORACLE_OPEN };

// A body's agent is taken smaller by SHRINK on every side: what comes within half of that overlaps the whole agent, and
// what keeps FAR off is free of it.
#define SHRINK 0.02
#define FAR    0.055

// A point lies inside where one of the shape's lies in every octant around it.
static int ask_oracle_of_point(const random_shape *shape, const double at[3])
{
    const oracle_agent point = { 0.0, 0.0, 0.0, 0.0 };
    double low, high;
    bound_distance(&shape->oracle, &point, at, SHRINK, &low, &high);
    if (low > SHRINK) {
        return ORACLE_FREE;
    }
    for (int k = 0; k < 8; k++) {
        const double corner[3] = { at[0] + ((k & 1) != 0 ? SHRINK : -SHRINK), at[1] + ((k & 2) != 0 ? SHRINK : -SHRINK),
                                   at[2] + ((k & 4) != 0 ? SHRINK : -SHRINK) };
        bound_distance(&shape->oracle, &point, corner, SHRINK, &low, &high);
        if (!(high < SHRINK)) {
            return ORACLE_OPEN;
        }
    }
    return ORACLE_TAKEN;
}

static int ask_oracle(const random_shape *shape, const tl_nav_def *def, const double floor_at[3])
{
    if (shape->obstacle.area != TL_NAV_NULL_AREA) {
        return ask_oracle_of_point(shape, floor_at);
    }
    const oracle_agent agent = { 0.5 * (double)def->cell_size - SHRINK, (double)def->agent_radius - SHRINK, SHRINK,
                                 (double)def->agent_height - SHRINK };
    double low, high;
    bound_distance(&shape->oracle, &agent, floor_at, 0.5 * SHRINK, &low, &high);
    if (high < 0.5 * SHRINK) {
        return ORACLE_TAKEN;
    }
    if (low > 0.5 * SHRINK) { // which ended the search: how far really?
        bound_distance(&shape->oracle, &agent, floor_at, FAR, &low, &high);
        return low > FAR ? ORACLE_FREE : ORACLE_OPEN;
    }
    return ORACLE_OPEN;
}

// ---- Floors ------------------------------------------------------------------------------------------------

typedef struct floors_fixture {
    test_level level;
    tl_nav_def def;
    tl_nav_stages stages;
    tl_nav_tile *tile;
    uint8_t *base;
} floors_fixture;

static void make_floors(floors_fixture *f)
{
    memset(f, 0, sizeof *f);
    test_level_make(&f->level, tl_vec3_make(0, 0, 0));
    f->def = make_def();
    f->def.tile_size = 0;
    tl_nav_config config;
    const tl_nav_input input = { f->level.mesh, NULL, NULL, 0 };
    TEST_RESULT(tl_nav_config_from_def(&f->def, f->def.bounds, 0, 0, &config, NULL), TL_OK);
    TEST_RESULT(tl_nav_tile_bake(&config, &input, NULL, &f->stages, &f->tile, NULL), TL_OK);
    f->base = malloc(f->stages.compact.span_count);
    memcpy(f->base, f->stages.compact.area, f->stages.compact.span_count);
}

static void free_floors(floors_fixture *f)
{
    free(f->base);
    tl_blob_free(f->tile);
    tl_nav_stages_free(&f->stages);
}

static void floor_place(const floors_fixture *f, uint32_t column, uint32_t i, double at[3])
{
    const tl_nav_compact *compact = &f->stages.compact;
    at[0] = (double)f->def.bounds.min.x + ((double)(column % compact->width) + 0.5) * (double)f->def.cell_size;
    at[1] = (double)f->def.bounds.min.y + (double)compact->floor[i] * (double)f->def.cell_height;
    at[2] = (double)f->def.bounds.min.z + ((double)(column / compact->width) + 0.5) * (double)f->def.cell_size;
}

static void mark(floors_fixture *f, const tl_nav_obstacle *obstacle)
{
    memcpy(f->stages.compact.area, f->base, f->stages.compact.span_count);
    TEST_RESULT(tl_obstacle_check(obstacle, NULL), TL_OK);
    tl_obstacle_mark(obstacle, f->def.agent_radius, f->def.agent_height, &f->stages.compact);
}

// ---- Tests -------------------------------------------------------------------------------------------------

// Every walkable floor near a shape is marked where the oracle proves that it must be, and not where it must not.
static void test_definition(void **state)
{
    (void)state;
    test_random random = { 5 };
    floors_fixture f;
    make_floors(&f);
    const tl_nav_compact *compact = &f.stages.compact;
    uint64_t taken[6] = { 0 }, kept[6] = { 0 }, open = 0, areas = 0;
    for (uint32_t round = 0; round < 600; round++) {
        random_shape shape;
        make_random_shape(&shape, &random, round % 6);
        f.def.agent_radius = test_random_range(&random, 0.0f, 1.0f) + 0.03f;
        mark(&f, &shape.obstacle);
        const tl_aabb box = tl_obstacle_box(&shape.obstacle, f.def.agent_radius, f.def.agent_height);
        for (uint32_t column = 0; column < compact->width * compact->height; column++) {
            for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
                double at[3];
                floor_place(&f, column, i, at);
                const bool near_box = at[0] > (double)box.min.x - 0.5 && at[0] < (double)box.max.x + 0.5 &&
                                      at[2] > (double)box.min.z - 0.5 && at[2] < (double)box.max.z + 0.5;
                const bool marked = compact->area[i] != f.base[i];
                TEST_CHECK(!marked || (near_box && f.base[i] != TL_NAV_NULL_AREA));
                if (!near_box || f.base[i] == TL_NAV_NULL_AREA) {
                    continue;
                }
                const int verdict = ask_oracle(&shape, &f.def, at);
                TEST_CHECK(verdict == ORACLE_OPEN || marked == (verdict == ORACLE_TAKEN));
                taken[round % 6] += verdict == ORACLE_TAKEN;
                kept[round % 6] += verdict == ORACLE_FREE;
                open += verdict == ORACLE_OPEN;
                areas += marked && shape.obstacle.area != TL_NAV_NULL_AREA;
            }
        }
        tl_blob_free(shape.hull);
    }
    for (int k = 0; k < 6; k++) {
        TEST_CHECK(taken[k] > 500 && kept[k] > 5000);
    }
    TEST_CHECK(areas > 300 && open < 3000);
    free_floors(&f);
}

// Each floor asked alone gives what the search by rows gives.
static void test_alone(void **state)
{
    (void)state;
    test_random random = { 8 };
    floors_fixture f;
    make_floors(&f);
    tl_nav_compact *compact = &f.stages.compact;
    uint8_t *marks = malloc(compact->span_count);
    uint64_t asked = 0, different = 0;
    for (uint32_t round = 0; round < 60; round++) {
        random_shape shape;
        make_random_shape(&shape, &random, round % 6);
        mark(&f, &shape.obstacle);
        memcpy(marks, compact->area, compact->span_count);
        for (uint32_t column = 0; column < compact->width * compact->height; column++) {
            uint32_t begin = compact->first_span[column], end = compact->first_span[column + 1];
            if (begin == end || test_random_below(&random, 3) > 0) {
                continue;
            }
            // A field of this column only.
            uint32_t bounds[2] = { 0, end - begin };
            tl_nav_compact alone = *compact;
            alone.lattice.first_x += (int32_t)(column % compact->width);
            alone.lattice.first_z += (int32_t)(column / compact->width);
            alone.width = alone.height = 1;
            alone.first_span = bounds;
            alone.floor = compact->floor + begin;
            alone.area = compact->area + begin;
            memcpy(alone.area, f.base + begin, end - begin);
            tl_obstacle_mark(&shape.obstacle, f.def.agent_radius, f.def.agent_height, &alone);
            for (uint32_t i = begin; i < end; i++) {
                TEST_CHECK(compact->area[i] == marks[i]);
                different += marks[i] != f.base[i];
            }
            asked += end - begin;
        }
        tl_blob_free(shape.hull);
    }
    TEST_CHECK(asked > 50000 && different > 500);
    free(marks);
    free_floors(&f);
}

// Upright boxes and cylinders mark the floors that their own kinds do. Those kinds compare heights without a tolerance,
// so that a floor at exactly the top, whose height was rounded, may go; here it stays.
static void test_upright(void **state)
{
    (void)state;
    test_random random = { 9 };
    floors_fixture f;
    make_floors(&f);
    tl_nav_compact *compact = &f.stages.compact;
    uint8_t *marks = malloc(compact->span_count);
    uint64_t marked = 0, tops = 0, ends = 0;
    for (uint32_t round = 0; round < 300; round++) {
        tl_nav_obstacle old = random_obstacle(&random);
        old.base.y = 0.2f * floorf(old.base.y / 0.2f);
        old.height = 0.2f * ceilf(old.height / 0.2f);
        if (old.shape == TL_NAV_OBSTACLE_PRISM) {
            continue;
        }
        tl_nav_obstacle fresh;
        memset(&fresh, 0, sizeof fresh);
        fresh.shape = TL_NAV_OBSTACLE_CONVEX;
        fresh.area = old.area;
        fresh.pose.position = old.base;
        if (old.shape == TL_NAV_OBSTACLE_CYLINDER) {
            fresh.convex = tl_convex_cylinder(tl_vec3_make(0, 0, 0), tl_vec3_make(0, old.height, 0), old.radius, 0.0f);
        } else {
            const double angle = atan2((double)old.sine, (double)old.cosine);
            fresh.convex = tl_convex_box(tl_vec3_make(0, 0.5f * old.height, 0),
                                         tl_vec3_make(old.half_x, 0.5f * old.height, old.half_z), 0.0f);
            fresh.pose.rotation.y = (float)sin(0.5 * angle);
            fresh.pose.rotation.w = (float)cos(0.5 * angle);
        }
        mark(&f, &old);
        memcpy(marks, compact->area, compact->span_count);
        mark(&f, &fresh);
        const bool body = old.area == TL_NAV_NULL_AREA;
        const double low = (double)old.base.y - (body ? (double)f.def.agent_height : 0.0);
        const double high = (double)old.base.y + (double)old.height;
        for (uint32_t i = 0; i < compact->span_count; i++) {
            const double y = (double)f.def.bounds.min.y + (double)compact->floor[i] * (double)f.def.cell_height;
            const bool is_end = fabs(y - low) < 1e-5 || fabs(y - high) < 1e-5;
            TEST_CHECK(is_end || marks[i] == compact->area[i]);
            TEST_CHECK(!is_end || !body || compact->area[i] == f.base[i]);
            marked += marks[i] != f.base[i];
            tops += is_end && body && marks[i] != f.base[i];
            ends += is_end && !body && compact->area[i] != f.base[i];
        }
    }
    TEST_CHECK(marked > 5000 && tops > 0 && ends > 0);
    free(marks);
    free_floors(&f);
}

static void test_refused_shapes(void **state)
{
    (void)state;
    tl_nav_obstacle good;
    memset(&good, 0, sizeof good);
    good.shape = TL_NAV_OBSTACLE_CONVEX;
    good.convex = tl_convex_sphere(tl_vec3_make(0, 0, 0), 1.0f);
    TEST_RESULT(tl_obstacle_check(&good, NULL), TL_OK);
    const tl_vec3 point = { 0, 0, 0 };
    for (int k = 0; k < 10; k++) {
        tl_nav_obstacle bad = good;
        switch (k) {
        case 0:
            bad.convex = tl_convex_from_points(&point, 1, 0.0f);
            bad.convex.points = NULL;
            break;
        case 1:
            bad.convex.kind = TL_CONVEX_HULL;
            break;
        case 2:
            bad.convex.kind = TL_CONVEX_CUSTOM;
            break;
        case 3:
            bad.convex.kind = (tl_convex_kind)77;
            break;
        case 4:
            bad.convex.point_count = 4;
            break;
        case 5:
            bad.convex.radius = -1.0f;
            break;
        case 6:
            bad.convex.radius = NAN;
            break;
        case 7:
            bad.convex.corners[0].y = INFINITY;
            break;
        case 8:
            bad.pose.position.z = NAN;
            break;
        default:
            bad.pose.rotation.x = NAN;
            break;
        }
        tl_report report;
        memset(&report, 0, sizeof report);
        TEST_RESULT(tl_obstacle_check(&bad, &report), k < 6 ? TL_ERR_ARGUMENT : TL_ERR_NOT_FINITE);
        assert_string_equal(report.field, k == 8 ? "pose" : "convex");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_definition),
        cmocka_unit_test(test_alone),
        cmocka_unit_test(test_upright),
        cmocka_unit_test(test_refused_shapes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
