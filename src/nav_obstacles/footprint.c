// SPDX-License-Identifier: MIT
//
// Marking floors under an obstacle: here those that stand upright; convex_marks.c has all others.
//
// A body's footprint is the Minkowski sum of its outline and a disc of the agent's radius: the places where the agent's
// own disc would touch it. A column goes when any point of its square lies in it, so that what is left keeps the whole
// radius; the distance between the square and the outline decides, so corners are round as the agent is, and nothing is
// grown twice. An area marks the columns whose centres lie inside its outline, as volumes of a bake do.

#include "nav_obstacles/footprint.h"

#include "base/host.h"
#include "math/tolerance.h"
#include "nav_obstacles/convex_marks.h"
#include "nav_obstacles/obstacle_window.h"

#include <math.h>

/// Corners are floats, each coordinate rounded once, and a difference has two. So the cross product of two differences
/// is off by at most this share of the largest coordinate times the sum of their components, all without signs. What
/// is lost in double is far below that.
#define CORNER_NOISE ((double)TL_FLOAT_GAMMA(2))

// The outline in its own frame: local = turn(world - base). A box is a polygon of four corners.
typedef struct footprint {
    bool round;
    double radius;       // of the cylinder
    double x[16], z[16]; // of the polygon, counter-clockwise where x runs right and z up
    uint32_t count;
    double base_x, base_z;
    double cosine, sine;
    double grow;      // metres; 0 for an area
    double low, high; // heights of floors, metres
} footprint;

// A floor at exactly the body's top is free, and one that leaves exactly the agent's height below its base too; an
// area holds its ends. So bodies test low < y < high, areas low <= y <= high.
static bool height_is_in(const footprint *foot, double y)
{
    return foot->grow >= 0.0 ? y > foot->low && y < foot->high : y >= foot->low && y <= foot->high;
}

static double twice_area(const footprint *foot)
{
    double sum = 0.0;
    for (uint32_t i = 0, before = foot->count - 1; i < foot->count; before = i++) {
        sum += foot->x[before] * foot->z[i] - foot->x[i] * foot->z[before];
    }
    return sum;
}

static void reverse(footprint *foot)
{
    for (uint32_t i = 0, k = foot->count - 1; i < k; i++, k--) {
        double x = foot->x[i], z = foot->z[i];
        foot->x[i] = foot->x[k];
        foot->z[i] = foot->z[k];
        foot->x[k] = x;
        foot->z[k] = z;
    }
}

static void make_outline(const tl_nav_obstacle *obstacle, footprint *foot)
{
    foot->count = obstacle->shape == TL_NAV_OBSTACLE_BOX ? 4 : obstacle->point_count;
    for (uint32_t i = 0; i < foot->count; i++) {
        bool right = i == 1 || i == 2, far = i >= 2;
        bool box = obstacle->shape == TL_NAV_OBSTACLE_BOX;
        foot->x[i] = box ? (double)(right ? obstacle->half_x : -obstacle->half_x) : (double)obstacle->points[i].x;
        foot->z[i] = box ? (double)(far ? obstacle->half_z : -obstacle->half_z) : (double)obstacle->points[i].z;
    }
    if (twice_area(foot) < 0.0) {
        reverse(foot);
    }
}

static footprint make_footprint(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height)
{
    footprint foot;
    bool body = obstacle->area == TL_NAV_NULL_AREA;
    foot.round = obstacle->shape == TL_NAV_OBSTACLE_CYLINDER;
    foot.radius = (double)obstacle->radius;
    foot.count = 0;
    if (!foot.round) {
        make_outline(obstacle, &foot);
    }
    foot.base_x = (double)obstacle->base.x;
    foot.base_z = (double)obstacle->base.z;
    double length =
        sqrt((double)obstacle->cosine * (double)obstacle->cosine + (double)obstacle->sine * (double)obstacle->sine);
    foot.cosine = length > 0.0 ? (double)obstacle->cosine / length : 1.0;
    foot.sine = length > 0.0 ? (double)obstacle->sine / length : 0.0;
    foot.grow = body ? (double)agent_radius : -1.0;
    foot.low = (double)obstacle->base.y - (body ? (double)agent_height : 0.0);
    foot.high = (double)obstacle->base.y + (double)obstacle->height;
    return foot;
}

static double clamp_unit(double t)
{
    return t < 0.0 ? 0.0 : t > 1.0 ? 1.0 : t;
}

// Squared distance to a segment of the outline.
static double segment_distance_sq(const footprint *foot, uint32_t a, uint32_t b, double x, double z)
{
    double ux = foot->x[b] - foot->x[a], uz = foot->z[b] - foot->z[a];
    double dx = x - foot->x[a], dz = z - foot->z[a];
    double length_sq = ux * ux + uz * uz;
    double t = length_sq > 0.0 ? clamp_unit((dx * ux + dz * uz) / length_sq) : 0.0;
    dx -= t * ux;
    dz -= t * uz;
    return dx * dx + dz * dz;
}

static bool polygon_reaches(const footprint *foot, double x, double z)
{
    bool inside = true;
    double nearest = (double)INFINITY;
    for (uint32_t i = 0, before = foot->count - 1; i < foot->count; before = i++) {
        double ux = foot->x[i] - foot->x[before], uz = foot->z[i] - foot->z[before];
        inside = inside && ux * (z - foot->z[before]) - uz * (x - foot->x[before]) >= 0.0;
        if (foot->grow >= 0.0) {
            double distance_sq = segment_distance_sq(foot, before, i, x, z);
            nearest = distance_sq < nearest ? distance_sq : nearest;
        }
    }
    return inside || (foot->grow >= 0.0 && nearest <= foot->grow * foot->grow);
}

static bool footprint_reaches(const footprint *foot, double world_x, double world_z)
{
    double dx = world_x - foot->base_x, dz = world_z - foot->base_z;
    if (foot->round) {
        double radius = foot->radius + (foot->grow > 0.0 ? foot->grow : 0.0);
        return dx * dx + dz * dz < radius * radius;
    }
    return polygon_reaches(foot, dx * foot->cosine - dz * foot->sine, dx * foot->sine + dz * foot->cosine);
}

// ---- A body and the square of a column
// -------------------------------------------------------------------------------

// The square in the outline's frame: a middle, and its two half axes.
typedef struct column_square {
    double middle[2], along[2], across[2];
    double half; // length of an axis
    double corners[4][2];
} column_square;

static column_square place_square(const footprint *foot, double dx, double dz, double half)
{
    static const double SIGNS[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    column_square s = { { dx * foot->cosine - dz * foot->sine, dx * foot->sine + dz * foot->cosine },
                        { half * foot->cosine, half * foot->sine },
                        { -half * foot->sine, half * foot->cosine },
                        half,
                        { { 0 } } };
    for (int k = 0; k < 4; k++) {
        for (int c = 0; c < 2; c++) {
            s.corners[k][c] = s.middle[c] + SIGNS[k][0] * s.along[c] + SIGNS[k][1] * s.across[c];
        }
    }
    return s;
}

// Whether a line along an edge of the outline, or of the square, has one on each side (separating axis).
static bool is_apart(const footprint *foot, const column_square *s)
{
    double low[2] = { (double)INFINITY, (double)INFINITY }, high[2] = { -(double)INFINITY, -(double)INFINITY };
    for (uint32_t i = 0, before = foot->count - 1; i < foot->count; before = i++) {
        const double ux = foot->x[i] - foot->x[before], uz = foot->z[i] - foot->z[before];
        double innermost = -(double)INFINITY;
        for (int k = 0; k < 4; k++) {
            const double side = ux * (s->corners[k][1] - foot->z[before]) - uz * (s->corners[k][0] - foot->x[before]);
            innermost = side > innermost ? side : innermost;
        }
        if (innermost < 0.0) {
            return true;
        }
        const double px = foot->x[i] - s->middle[0], pz = foot->z[i] - s->middle[1];
        const double at[2] = { px * s->along[0] + pz * s->along[1], px * s->across[0] + pz * s->across[1] };
        for (int c = 0; c < 2; c++) {
            low[c] = at[c] < low[c] ? at[c] : low[c];
            high[c] = at[c] > high[c] ? at[c] : high[c];
        }
    }
    const double reach = s->half * s->half;
    return low[0] > reach || high[0] < -reach || low[1] > reach || high[1] < -reach;
}

static double point_segment_sq(const double p[2], const double a[2], const double b[2])
{
    const double ux = b[0] - a[0], uz = b[1] - a[1], length_sq = ux * ux + uz * uz;
    const double t = length_sq > 0.0 ? clamp_unit(((p[0] - a[0]) * ux + (p[1] - a[1]) * uz) / length_sq) : 0.0;
    const double dx = p[0] - a[0] - t * ux, dz = p[1] - a[1] - t * uz;
    return dx * dx + dz * dz;
}

// Of convex sets that are apart a corner is nearest, of one or the other.
static double square_distance_sq(const footprint *foot, const column_square *s)
{
    double nearest = (double)INFINITY;
    for (uint32_t i = 0, before = foot->count - 1; i < foot->count; before = i++) {
        const double a[2] = { foot->x[before], foot->z[before] }, b[2] = { foot->x[i], foot->z[i] };
        for (int k = 0; k < 4; k++) {
            const double to_edge = point_segment_sq(s->corners[k], a, b);
            const double to_side = point_segment_sq(b, s->corners[k], s->corners[(k + 1) % 4]);
            nearest = to_edge < nearest ? to_edge : nearest;
            nearest = to_side < nearest ? to_side : nearest;
        }
    }
    return nearest;
}

// Whether any point of a column's square lies in a body's footprint; that its centre does not is known.
static bool body_reaches_square(const footprint *foot, double world_x, double world_z, double half)
{
    const double dx = world_x - foot->base_x, dz = world_z - foot->base_z;
    if (foot->round) {
        const double reach = foot->grow + foot->radius;
        const double x = fabs(dx) > half ? fabs(dx) - half : 0.0, z = fabs(dz) > half ? fabs(dz) - half : 0.0;
        return x * x + z * z < reach * reach;
    }
    const column_square s = place_square(foot, dx, dz, half);
    // Most columns are farther off than half a square's diagonal.
    double nearest = (double)INFINITY;
    for (uint32_t i = 0, before = foot->count - 1; i < foot->count; before = i++) {
        const double distance_sq = segment_distance_sq(foot, before, i, s.middle[0], s.middle[1]);
        nearest = distance_sq < nearest ? distance_sq : nearest;
    }
    const double far = foot->grow + 1.4143 * half;
    return nearest < far * far && (!is_apart(foot, &s) || square_distance_sq(foot, &s) < foot->grow * foot->grow);
}

// ---------------------------------------------------------------------------------------------------------

static double largest_footprint_coordinate(const footprint *foot)
{
    double largest = 0.0;
    for (uint32_t i = 0; i < foot->count; i++) {
        largest = fmax(largest, fmax(fabs(foot->x[i]), fabs(foot->z[i])));
    }
    return largest;
}

// A corner may lie beyond another's edge line by rounding alone.
static bool is_convex_outline(const tl_nav_obstacle *obstacle)
{
    footprint foot;
    make_outline(obstacle, &foot);
    const double noise = CORNER_NOISE * largest_footprint_coordinate(&foot);
    for (uint32_t i = 0; i < foot.count; i++) {
        uint32_t next = (i + 1) % foot.count;
        double ux = foot.x[next] - foot.x[i], uz = foot.z[next] - foot.z[i];
        for (uint32_t k = 0; k < foot.count; k++) {
            double vx = foot.x[k] - foot.x[i], vz = foot.z[k] - foot.z[i];
            if (ux * vz - uz * vx < -noise * (fabs(ux) + fabs(uz) + fabs(vx) + fabs(vz))) {
                return false;
            }
        }
    }
    return twice_area(&foot) > 0.0;
}

static tl_result check_prism(const tl_nav_obstacle *obstacle, tl_report *report)
{
    if (obstacle->point_count < 3 || obstacle->point_count > TL_NAV_MAX_OBSTACLE_POINTS) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "point_count", "give 3 to 16 points");
    }
    for (uint32_t i = 0; i < obstacle->point_count; i++) {
        if (!tl_is_finite(obstacle->points[i])) {
            return tl_report_fail(report, TL_ERR_NOT_FINITE, "point", i, "use finite numbers");
        }
    }
    return is_convex_outline(obstacle) ? TL_OK
                                       : tl_report_field(report, TL_ERR_ARGUMENT, "points",
                                                         "give the outline of a convex polygon with area, in order");
}

tl_result tl_obstacle_check(const tl_nav_obstacle *obstacle, tl_report *report)
{
    if ((unsigned)obstacle->shape > (unsigned)TL_NAV_OBSTACLE_CONVEX) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "shape", "use a tl_nav_obstacle_shape");
    }
    if (obstacle->shape == TL_NAV_OBSTACLE_CONVEX) {
        return tl_convex_obstacle_check(obstacle, report);
    }
    if (!tl_is_finite(obstacle->base)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "base", "use finite numbers");
    }
    if (!isfinite(obstacle->height)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "height", "use finite numbers");
    }
    bool round = obstacle->shape == TL_NAV_OBSTACLE_CYLINDER;
    if (!round && (!isfinite(obstacle->cosine) || !isfinite(obstacle->sine))) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "cosine", "use finite numbers");
    }
    if (!(obstacle->height >= 0.0f)) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "height", "give a height of 0 or more");
    }
    if (round && !(obstacle->radius > 0.0f && isfinite(obstacle->radius))) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "radius", "give a radius above 0");
    }
    if (obstacle->shape == TL_NAV_OBSTACLE_BOX && !(obstacle->half_x >= 0.0f && isfinite(obstacle->half_x) &&
                                                    obstacle->half_z >= 0.0f && isfinite(obstacle->half_z))) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "half_x", "give extents of 0 or more");
    }
    return obstacle->shape == TL_NAV_OBSTACLE_PRISM ? check_prism(obstacle, report) : TL_OK;
}

static tl_aabb footprint_box(const footprint *foot)
{
    double grow = foot->grow > 0.0 ? foot->grow : 0.0;
    double min_x = -foot->radius, max_x = foot->radius, min_z = -foot->radius, max_z = foot->radius;
    if (!foot->round) {
        min_x = min_z = (double)INFINITY;
        max_x = max_z = -(double)INFINITY;
        for (uint32_t i = 0; i < foot->count; i++) {
            double x = foot->x[i] * foot->cosine + foot->z[i] * foot->sine;
            double z = foot->z[i] * foot->cosine - foot->x[i] * foot->sine;
            min_x = x < min_x ? x : min_x;
            max_x = x > max_x ? x : max_x;
            min_z = z < min_z ? z : min_z;
            max_z = z > max_z ? z : max_z;
        }
    }
    tl_aabb box;
    tl_round_outward(foot->base_x + min_x - grow, foot->base_x + max_x + grow, &box.min.x, &box.max.x);
    tl_round_outward(foot->low, foot->high, &box.min.y, &box.max.y);
    tl_round_outward(foot->base_z + min_z - grow, foot->base_z + max_z + grow, &box.min.z, &box.max.z);
    return box;
}

tl_aabb tl_obstacle_box(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height)
{
    if (obstacle->shape == TL_NAV_OBSTACLE_CONVEX) {
        return tl_convex_obstacle_box(obstacle, agent_radius, agent_height);
    }
    const footprint foot = make_footprint(obstacle, agent_radius, agent_height);
    return footprint_box(&foot);
}

static bool floor_may_be_marked(const footprint *foot, const tl_nav_compact *compact, uint32_t floor)
{
    return compact->area[floor] != TL_NAV_NULL_AREA && height_is_in(foot, tl_floor_height(compact, floor));
}

// Whether a column has a floor to be marked: asked first, as where obstacles stand close together, and on other
// storeys, most have none.
static bool column_may_be_marked(const footprint *foot, const tl_nav_compact *compact, uint32_t column)
{
    for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
        if (floor_may_be_marked(foot, compact, i)) {
            return true;
        }
    }
    return false;
}

static void mark_footprint_column(const footprint *foot, uint8_t area, uint32_t column, tl_nav_compact *compact)
{
    for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
        compact->area[i] = floor_may_be_marked(foot, compact, i) ? area : compact->area[i];
    }
}

void tl_obstacle_mark(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height, tl_nav_compact *compact)
{
    if (obstacle->shape == TL_NAV_OBSTACLE_CONVEX) {
        tl_convex_obstacle_mark(obstacle, agent_radius, agent_height, compact);
        return;
    }
    const footprint foot = make_footprint(obstacle, agent_radius, agent_height);
    const tl_obstacle_window window = tl_obstacle_window_make(compact, footprint_box(&foot));
    const double half = 0.5 * (double)compact->cell_size;
    const bool body = obstacle->area == TL_NAV_NULL_AREA;
    for (uint32_t z = window.first_z; z < window.end_z; z++) {
        const double center_z = tl_column_center_z(compact, z);
        for (uint32_t x = window.first_x; x < window.end_x; x++) {
            const uint32_t column = z * compact->width + x;
            if (!column_may_be_marked(&foot, compact, column)) {
                continue;
            }
            const double center_x = tl_column_center_x(compact, x);
            if (footprint_reaches(&foot, center_x, center_z) ||
                (body && body_reaches_square(&foot, center_x, center_z, half))) {
                mark_footprint_column(&foot, obstacle->area, column, compact);
            }
        }
    }
}
