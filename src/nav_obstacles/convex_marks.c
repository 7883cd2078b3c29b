// SPDX-License-Identifier: MIT
//
// Marking floors under a convex shape at any pose.
//
// A body takes a floor when the agent's cylinder overlaps it, wherever in the floor's column the agent stands. The
// cylinder swept over the column's square is one convex prism with a rounded square as its outline, and GJK (Gilbert,
// Johnson, Keerthi, 1988; convex.h) decides whether two convex shapes overlap. So every kind of shape is right at
// once, curved ones included. Rejected: the faces of the Minkowski sum of shape and prism, which a hull has many of and
// a cone none; heights of the shape's surface by column, which say nothing of what reaches in from the side.
//
// The places of the prism in which the shapes overlap are a convex set, so in a row of columns the floors of one height
// that are taken follow one another. Where a height repeats both ends are searched for, from where the row before had
// them: some five questions a row, however wide the body is. One takes 0.3 to 0.6 us. Rejected: distances, which free
// all floors that are nearer, as GJK takes ten to twenty steps to find one from a round shape.

#include "nav_obstacles/convex_marks.h"

#include "base/host.h"
#include "math/tolerance.h"
#include "nav_obstacles/obstacle_window.h"

/// Where a shape only touches. Its place in the world and the floor's are rounded once, its own coordinates some more
/// times: as they are given, turned, moved beside the agent, and in the agent's support. Bodies are taken larger by
/// this in the plan, for what is left must keep the radius, and lower in height, for what is walked on is touched.
#define PLACE_NOISE TL_FLOAT_GAMMA(2)
#define SHAPE_NOISE TL_FLOAT_GAMMA(8)

enum { FLOORS_WORTH_A_SEARCH = 8 };

// The agent with its foot in the middle of a column's square at height 0, swept over the square.
typedef struct swept_agent {
    float half;      // of the square's side
    float radius;    // of the agent
    float low, high; // of its foot and its head
} swept_agent;

typedef struct convex_marker {
    const tl_nav_obstacle *obstacle;
    swept_agent agent;
    tl_convex probe; // at a floor: a body's agent, or an area's point
    double noise;    // metres
    const tl_nav_compact *compact;
    tl_obstacle_window window;
    // The row in work.
    double z;
    double height;                 // of a floor; NaN: none
    int64_t first, last;           // columns whose floors of that height are taken; none where last < first
    int64_t near_first, near_last; // the last ones that there were
} convex_marker;

static tl_vec3 support_swept_agent(tl_vec3 direction, void *user)
{
    const swept_agent *agent = user;
    const float length = sqrtf(direction.x * direction.x + direction.z * direction.z);
    const float reach = length > 0.0f ? agent->radius / length : 0.0f;
    return tl_vec3_make(copysignf(agent->half, direction.x) + direction.x * reach,
                        direction.y > 0.0f ? agent->high : agent->low,
                        copysignf(agent->half, direction.z) + direction.z * reach);
}

// ---- Checking ----------------------------------------------------------------------------------------------

static bool convex_is_whole(const tl_convex *convex)
{
    switch (convex->kind) {
    case TL_CONVEX_HULL:
        return convex->hull != NULL;
    case TL_CONVEX_POINTS:
        return convex->points != NULL && convex->point_count > 0;
    case TL_CONVEX_INLINE:
        return convex->point_count >= 1 && convex->point_count <= 3;
    case TL_CONVEX_BOX:
    case TL_CONVEX_CYLINDER:
    case TL_CONVEX_CONE:
        return true;
    case TL_CONVEX_CUSTOM:
        return convex->support != NULL;
    }
    return false;
}

// Around its own place: in the world small shapes far away would lose their size in the roundings of floats.
static tl_aabb box_about_position(const tl_nav_obstacle *obstacle)
{
    const tl_transform turned = { obstacle->pose.rotation, { 0, 0, 0 } };
    return tl_convex_bounds(&obstacle->convex, turned);
}

tl_result tl_convex_obstacle_check(const tl_nav_obstacle *obstacle, tl_report *report)
{
    const tl_convex *convex = &obstacle->convex;
    if (!convex_is_whole(convex) || convex->radius < 0.0f) {
        return tl_report_field(report, TL_ERR_ARGUMENT, "convex",
                               "make it by a function of convex.h, radius 0 or more");
    }
    if (!tl_is_finite(obstacle->pose.position)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "pose", "use finite numbers");
    }
    const tl_aabb box = box_about_position(obstacle);
    if (!tl_is_finite(box.min) || !tl_is_finite(box.max)) {
        return tl_report_field(report, TL_ERR_NOT_FINITE, "convex", "use finite numbers, and a unit quaternion");
    }
    return TL_OK;
}

// ---- Places ------------------------------------------------------------------------------------------------

static double largest_of_vec3(tl_vec3 v)
{
    return fmax(fabs((double)v.x), fmax(fabs((double)v.y), fabs((double)v.z)));
}

static double noise_of(const tl_nav_obstacle *obstacle, const tl_aabb *local, float agent_radius, float agent_height)
{
    const double size = largest_of_vec3(local->min) + largest_of_vec3(local->max) + (double)agent_radius;
    return (double)PLACE_NOISE * largest_of_vec3(obstacle->pose.position) +
           (double)SHAPE_NOISE * (size + (double)agent_height);
}

tl_aabb tl_convex_obstacle_box(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height)
{
    const bool body = obstacle->area == TL_NAV_NULL_AREA;
    const tl_aabb local = box_about_position(obstacle);
    const double noise = noise_of(obstacle, &local, agent_radius, agent_height);
    const double grow = noise + (body ? (double)agent_radius : 0.0);
    const double below = noise + (body ? (double)agent_height : 0.0);
    const tl_vec3 at = obstacle->pose.position;
    tl_aabb box;
    tl_round_outward((double)at.x + (double)local.min.x - grow, (double)at.x + (double)local.max.x + grow, &box.min.x,
                     &box.max.x);
    tl_round_outward((double)at.y + (double)local.min.y - below, (double)at.y + (double)local.max.y + noise, &box.min.y,
                     &box.max.y);
    tl_round_outward((double)at.z + (double)local.min.z - grow, (double)at.z + (double)local.max.z + grow, &box.min.z,
                     &box.max.z);
    return box;
}

// ---- Marking -----------------------------------------------------------------------------------------------

// The shape's pose seen from a floor of the row.
static tl_transform pose_from_floor(const convex_marker *m, int64_t column_x, double height)
{
    const tl_vec3 at = m->obstacle->pose.position;
    const double x = tl_column_center_x(m->compact, (uint32_t)column_x);
    const tl_transform pose = { m->obstacle->pose.rotation,
                                { (float)((double)at.x - x), (float)((double)at.y - height),
                                  (float)((double)at.z - m->z) } };
    return pose;
}

// Whether the shape and the probe overlap where the probe is at a floor of the row.
static bool overlaps_at(const convex_marker *m, int64_t column_x, double height)
{
    const tl_transform origin = { { 0, 0, 0, 0 }, { 0, 0, 0 } };
    return tl_convex_overlap(&m->probe, origin, &m->obstacle->convex, pose_from_floor(m, column_x, height), NULL);
}

// The last taken column from a taken one toward a free one; `hint` is asked first.
static int64_t last_taken(const convex_marker *m, double height, int64_t taken, int64_t free, int64_t hint)
{
    const int64_t onward = free > taken ? 1 : -1;
    int64_t probe = hint, step = 1;
    while ((free - taken) * onward > 1) {
        const bool is_between = (probe - taken) * onward > 0 && (free - probe) * onward > 0;
        probe = is_between ? probe : taken + (free - taken) / 2;
        if (overlaps_at(m, probe, height)) {
            taken = probe;
            probe += onward * step;
        } else {
            free = probe;
            probe -= onward * step;
        }
        step *= 2;
    }
    return taken;
}

// How many columns onward the plane between two shapes that are apart keeps them apart, this one included.
static double columns_apart(const convex_marker *m, const tl_separation *apart)
{
    const double gap = (double)apart->lower_bound - m->noise, nearer = fabs((double)apart->normal.x);
    return fmax(1.0, ceil(gap / (nearer * (double)m->compact->cell_size)));
}

// Any column of the row whose floors of a height are taken; -1: there is none. A plane that separates the shapes at one
// column does so at all on the far side of it, and on the near side as far as the gap allows.
static int64_t any_taken(const convex_marker *m, double height)
{
    const tl_transform origin = { { 0, 0, 0, 0 }, { 0, 0, 0 } };
    int64_t low = m->window.first_x, high = (int64_t)m->window.end_x - 1;
    int64_t x = (m->near_first + m->near_last) / 2;
    while (low <= high) {
        tl_separation apart;
        tl_convex_distance(&m->probe, origin, &m->obstacle->convex, pose_from_floor(m, x, height), NULL, &apart);
        if (apart.overlap) {
            return x;
        }
        const double columns = columns_apart(m, &apart), left = (double)(high - low) + 1.0;
        if (apart.normal.x > 0.0f) {
            low = columns < left ? x + (int64_t)columns : high + 1;
            x = low;
        } else {
            high = columns < left ? x - (int64_t)columns : low - 1;
            x = high;
        }
    }
    return -1;
}

// Finds the columns of the row whose floors of a height are taken.
static void find_taken_columns(convex_marker *m, double height)
{
    const int64_t any = any_taken(m, height);
    m->height = height;
    m->first = 0;
    m->last = -1;
    if (any >= 0) {
        m->first = m->near_first = last_taken(m, height, any, (int64_t)m->window.first_x - 1, m->near_first);
        m->last = m->near_last = last_taken(m, height, any, m->window.end_x, m->near_last);
    }
}

static bool floor_is_taken(convex_marker *m, uint32_t column_x, double height, bool repeats)
{
    if (height != m->height && !repeats) {
        return overlaps_at(m, column_x, height);
    }
    if (height != m->height) {
        find_taken_columns(m, height);
    }
    return column_x >= m->first && column_x <= m->last;
}

// Whether the next columns of the row have a floor of this height too, so many that it is cheaper to search for the
// ends of the taken ones than to ask for each.
static bool height_repeats(const tl_nav_compact *compact, uint32_t column, uint32_t floor)
{
    for (uint32_t k = 1; k < FLOORS_WORTH_A_SEARCH; k++) {
        bool is_there = false;
        for (uint32_t i = compact->first_span[column + k]; i < compact->first_span[column + k + 1]; i++) {
            is_there = is_there || compact->floor[i] == compact->floor[floor];
        }
        if (!is_there) {
            return false;
        }
    }
    return true;
}

static void mark_row_of_columns(convex_marker *m, const tl_aabb *box, uint32_t z, tl_nav_compact *compact)
{
    m->z = tl_column_center_z(compact, z);
    m->height = (double)NAN;
    for (uint32_t x = m->window.first_x; x < m->window.end_x; x++) {
        const uint32_t column = z * compact->width + x;
        for (uint32_t i = compact->first_span[column]; i < compact->first_span[column + 1]; i++) {
            const double height = tl_floor_height(compact, i);
            if (compact->area[i] != TL_NAV_NULL_AREA && height >= (double)box->min.y && height <= (double)box->max.y &&
                floor_is_taken(m, x, height,
                               m->window.end_x - x >= FLOORS_WORTH_A_SEARCH && height_repeats(compact, column, i))) {
                compact->area[i] = m->obstacle->area;
            }
        }
    }
}

// What is left of the agent's height between two touched ends; its middle, where that is nothing.
static swept_agent make_swept_agent(float cell_size, float agent_radius, float agent_height, double noise)
{
    const double middle = 0.5 * (double)agent_height;
    const double inset = noise < middle ? noise : middle;
    return (swept_agent){ (float)(0.5 * (double)cell_size + noise), agent_radius, (float)inset,
                          (float)((double)agent_height - inset) };
}

void tl_convex_obstacle_mark(const tl_nav_obstacle *obstacle, float agent_radius, float agent_height,
                             tl_nav_compact *compact)
{
    const tl_aabb local = box_about_position(obstacle);
    const tl_aabb box = tl_convex_obstacle_box(obstacle, agent_radius, agent_height);
    convex_marker m = { .obstacle = obstacle, .compact = compact };
    m.noise = noise_of(obstacle, &local, agent_radius, agent_height);
    const double reach = 0.5 * (double)compact->cell_size + m.noise;
    m.agent = make_swept_agent(compact->cell_size, agent_radius, agent_height, m.noise);
    m.window = tl_obstacle_window_make(compact, box);
    m.near_first = m.near_last = ((int64_t)m.window.first_x + m.window.end_x) / 2;
    m.probe = obstacle->area == TL_NAV_NULL_AREA ? tl_convex_custom(support_swept_agent, &m.agent, 0.0f)
                                                 : tl_convex_sphere(tl_vec3_make(0, 0, 0), (float)m.noise);
    for (uint32_t z = m.window.first_z; z < m.window.end_z; z++) {
        const double center = tl_column_center_z(compact, z);
        if (center + reach >= (double)box.min.z && center - reach <= (double)box.max.z) {
            mark_row_of_columns(&m, &box, z, compact);
        }
    }
}
