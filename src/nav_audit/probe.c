// SPDX-License-Identifier: MIT
//
// The probe: what of an agent must be free wherever the navmesh says so, and how it walks.
//
// At each point the floor is looked up in the soup, above and below the navmesh's surface; the probe stands on the
// nearest one on which it fits. From floor to floor it is swept level, at the height of the higher one, because that is
// what the bake promises: two columns are linked when the free spaces above both have walkable_height in common above
// the higher floor, and when no more than walkable_climb lies between them.
//
// Where the tolerances come from:
//
// - Radius. Erosion leaves at least (2 R - 1) / sqrt 5 columns between a wall and the traced outline, R being the
//   radius in columns: it counts a diagonal step as 1.5 columns, and starts at columns that have no neighbour, not at
//   the wall. The outline is then simplified, which may move it by max_simplification_error. In coarse voxels both
//   together leave nothing to sweep, but they seldom meet, so the probe has half of the agent's radius at least; and
//   where it does not fit, the promise for that very place decides: a point d metres from the outline has d more
//   metres free than the outline. A probe as thin as that is swept again. A fixed radius that is small enough to be
//   safe everywhere was rejected: it would pass a pillar at arm's length.
// - Step. Two floors a climb apart in voxels are up to a voxel farther apart in truth, since both are rounded. And a
//   slope's voxel is as high as its column's upper side, from where the step is taken: whoever has walked on to the
//   lower side, as far as under the edge of a platform, has the slope's rise over a column more before him.
// - Height. A floor is rounded up and a ceiling down, so a column keeps its promise; but the floor under the path is
//   one point of the column.
// - Surface. A floor's voxel is the top of what lies in its column: a slope's higher side, rounded up. The detail mesh
//   keeps to the floors at its samples, and may miss by half a sample's distance up or down a slope.
// - Gap. A column is floor when a triangle lies anywhere in it.

#include "nav_audit/probe.h"

#include "base/assert.h"

#include <talus/nav_around.h>

#include <math.h>
#include <string.h>

#define SQRT_2 1.41421356f
#define SQRT_5 2.23606798f

// How far beneath the navmesh a floor is looked for to say how deep one falls, in heights of the agent.
#define FALL_HEIGHTS 1000.0f

// The rise of the steepest walkable slope over a metre.
static float steepest_rise(const tl_nav_config *config)
{
    const float cosine = config->walkable_slope_cos;
    return cosine > 0.0f ? sqrtf(1.0f - cosine * cosine) / cosine : 0.0f;
}

// What erosion and the simplified outline leave between the outline and a wall, metres; negative: they may cut into it.
float tl_audit_outline_promise(const tl_nav_config *config)
{
    const float eroded = tl_maxf((2.0f * (float)config->walkable_radius - 1.0f) / SQRT_5, 0.0f);
    return (eroded - config->max_simplification_error) * config->cell_size;
}

tl_nav_probe tl_nav_probe_from_config(const tl_nav_config *config)
{
    const float cell = config->cell_size, voxel = config->cell_height;
    const float across = cell * SQRT_2 + 0.5f * config->detail_sample_dist;
    tl_nav_probe probe;
    probe.radius =
        tl_maxf(tl_minf(tl_audit_outline_promise(config), config->agent_radius), 0.5f * config->agent_radius);
    probe.step = voxel * (float)(config->walkable_climb + 1);
    probe.height = voxel * (float)(config->walkable_height > 1 ? config->walkable_height - 1 : 1);
    probe.surface = voxel + config->detail_sample_max_error + steepest_rise(config) * across;
    if (config->detail_sample_dist == 0.0f) {
        probe.surface += config->agent_height; // the surface knows heights at corners only
    }
    probe.gap = cell;
    return probe;
}

// ---- Floors ------------------------------------------------------------------------------------------------

typedef struct floor_hit {
    float y;
    float rise; ///< of its slope, metres a metre, no steeper than what is walkable
    uint32_t triangle;
} floor_hit;

enum { MAX_FLOORS = 3 };

static float rise_of(const tl_audit_scene *scene, tl_vec3 normal)
{
    const float cosine = tl_maxf(fabsf(normal.y), scene->config.walkable_slope_cos);
    return cosine > 0.0f ? sqrtf(tl_maxf(1.0f - cosine * cosine, 0.0f)) / cosine : 0.0f;
}

static bool cast_upright(const tl_audit_scene *scene, tl_vec3 from, float direction, float reach, floor_hit *floor_out)
{
    const tl_ray ray = { from, { 0.0f, direction, 0.0f }, reach };
    tl_ray_hit hit;
    if (!tl_soup_cast_ray(scene->soup, &ray, NULL, &hit)) {
        return false;
    }
    floor_out->y = from.y + direction * hit.t;
    floor_out->rise = rise_of(scene, hit.normal);
    floor_out->triangle = hit.triangle;
    return true;
}

// What a ball comes to rest on: beside a crack or a steep bank the agent stands on its rim, as the column's voxel does.
static bool drop_ball(const tl_audit_scene *scene, tl_vec3 surface, floor_hit *floor_out)
{
    const tl_nav_probe *probe = &scene->probe;
    const float radius = tl_minf(probe->radius, probe->gap);
    const tl_vec3 from = { surface.x, surface.y + probe->step + radius, surface.z };
    const tl_vec3 motion = { 0.0f, -(2.0f * probe->step + probe->surface), 0.0f };
    const tl_convex ball = tl_convex_sphere(from, radius);
    tl_shape_hit hit;
    if (tl_soup_cast_shape(scene->soup, &ball, tl_transform_identity(), motion, NULL, &hit) != TL_OK ||
        hit.initial_overlap) {
        return false;
    }
    floor_out->y = from.y + motion.y * hit.t - radius;
    floor_out->rise = rise_of(scene, hit.face_normal);
    floor_out->triangle = hit.triangle;
    return true;
}

static void swap_floors(floor_hit *a, floor_hit *b)
{
    const floor_hit kept = *a;
    *a = *b;
    *b = kept;
}

// The floors at a point, the nearest to the navmesh's surface first: straight below and above, and under a ball.
static uint32_t find_floors(const tl_audit_scene *scene, tl_vec3 surface, floor_hit floors[MAX_FLOORS])
{
    const float reach = scene->probe.step + scene->probe.surface;
    uint32_t count = 0;
    count += cast_upright(scene, surface, -1.0f, reach, &floors[count]);
    count += cast_upright(scene, surface, 1.0f, reach, &floors[count]);
    count += drop_ball(scene, surface, &floors[count]);
    for (uint32_t i = 1; i < count; i++) {
        for (uint32_t k = i; k > 0 && fabsf(floors[k].y - surface.y) < fabsf(floors[k - 1].y - surface.y); k--) {
            swap_floors(&floors[k], &floors[k - 1]);
        }
    }
    return count;
}

// Whether something to stand on lies within a gap's width of a point and within `reach` of its height.
static bool is_carried(const tl_audit_scene *scene, tl_vec3 at, float reach)
{
    const tl_vec3 half = { scene->probe.gap, reach, scene->probe.gap };
    const tl_convex box = tl_convex_box(at, half, 0.0f);
    bool carried = false;
    (void)tl_soup_overlaps(scene->soup, &box, tl_transform_identity(), NULL, &carried);
    return carried;
}

// ---- The sweep ---------------------------------------------------------------------------------------------

// The probe over a floor.
static tl_convex probe_over(const tl_nav_probe *probe, float radius, tl_vec3 feet)
{
    const float high = probe->height - radius, low = tl_minf(probe->step + radius, high);
    return tl_convex_capsule(tl_vec3_make(feet.x, feet.y + low, feet.z), tl_vec3_make(feet.x, feet.y + high, feet.z),
                             radius);
}

static bool sweep_is_free(tl_audit_walker *walker, float radius, tl_vec3 feet, tl_vec3 motion, tl_shape_hit *hit)
{
    const tl_audit_scene *scene = walker->scene;
    const tl_convex probe = probe_over(&scene->probe, radius, feet);
    walker->sweeps++;
    return tl_soup_cast_shape(scene->soup, &probe, tl_transform_identity(), motion, NULL, hit) != TL_OK;
}

// From where the walker stands to a floor: level, at the height of the higher one. Or there at once.
static bool can_walk_to(tl_audit_walker *walker, float radius, tl_vec3 to, tl_shape_hit *hit)
{
    if (!walker->standing) {
        return sweep_is_free(walker, radius, to, tl_vec3_make(0.0f, 0.0f, 0.0f), hit);
    }
    const float base = tl_maxf(walker->feet.y, to.y);
    const tl_vec3 from = { walker->feet.x, base, walker->feet.z };
    return sweep_is_free(walker, radius, from, tl_vec3_make(to.x - from.x, 0.0f, to.z - from.z), hit);
}

// ---- The promise for a place -------------------------------------------------------------------------------

// Metres in the plane from a place to the outline, up to `reach`.
static float distance_to_outline(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 at, float reach)
{
    const tl_nav_around_request request = { NULL, { polygon, at }, reach };
    tl_nav_wall_segment wall;
    uint32_t count = 0;
    (void)tl_nav_query_find_walls(walker->query, walker->scene->navmesh, &request, &wall, 1, &count);
    return count > 0 ? wall.distance : reach;
}

// The radius that must be free on the way from where the walker stands to a place: at most the probe's. 0 or less:
// the outline may run through a wall there, or beyond a ledge.
static float promised_radius(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 to)
{
    const tl_audit_scene *scene = walker->scene;
    const float reach = scene->probe.radius - scene->promise;
    if (!(reach > 0.0f)) {
        return scene->probe.radius;
    }
    float distance = distance_to_outline(walker, polygon, to, reach);
    if (walker->standing) {
        distance = tl_minf(distance, distance_to_outline(walker, walker->polygon, walker->feet, reach));
    }
    return tl_minf(scene->promise + distance, scene->probe.radius);
}

// ---- Records -----------------------------------------------------------------------------------------------

static int32_t cube_of(float at, float origin, float edge)
{
    // A level has at most TL_NAV_MAX_LATTICE columns; points of its soup beyond it are clamped.
    const double cube = floor(((double)at - (double)origin) / (double)edge);
    const double most = (double)(1 << 30);
    return (int32_t)(cube < -most ? -most : cube > most ? most : cube);
}

// A record at a point; the caller fills in what else there is to say.
static tl_audit_record record_at(const tl_audit_walker *walker, tl_nav_finding_kind kind, tl_nav_ref polygon,
                                 tl_vec3 point)
{
    const tl_nav_config *config = &walker->scene->config;
    tl_audit_record record;
    memset(&record, 0, sizeof record);
    record.kind = kind;
    record.triangle = TL_NO_TRIANGLE;
    record.polygon = polygon;
    record.point = record.contact = point;
    record.cube[0] = cube_of(point.x, config->lattice.origin.x, config->cell_size);
    record.cube[1] = cube_of(point.y, config->lattice.origin.y, config->cell_size);
    record.cube[2] = cube_of(point.z, config->lattice.origin.z, config->cell_size);
    return record;
}

static bool record_blocked(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 to, const tl_shape_hit *hit)
{
    tl_audit_record record = record_at(walker, TL_NAV_FINDING_BLOCKED, polygon, to);
    // How much deeper the sweep would have gone, or the overlap at its start.
    float depth = hit->depth;
    if (!hit->initial_overlap) {
        const tl_vec3 motion = { to.x - walker->feet.x, 0.0f, to.z - walker->feet.z };
        depth = -tl_dot(motion, hit->normal) * (1.0f - hit->t);
    }
    record.triangle = hit->triangle;
    record.contact = hit->point;
    record.depth = tl_maxf(depth, 0.0f);
    return tl_audit_records_add(walker->records, &record) == TL_OK;
}

static bool record_no_floor(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 surface)
{
    tl_audit_record record = record_at(walker, TL_NAV_FINDING_NO_FLOOR, polygon, surface);
    floor_hit floor;
    const float reach = walker->scene->config.agent_height * FALL_HEIGHTS;
    const bool ends = cast_upright(walker->scene, surface, -1.0f, reach, &floor);
    record.depth = ends ? surface.y - floor.y : INFINITY;
    return tl_audit_records_add(walker->records, &record) == TL_OK;
}

static bool record_high_step(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 nearest, uint32_t triangle)
{
    tl_audit_record record = record_at(walker, TL_NAV_FINDING_STEP, polygon, nearest);
    record.triangle = triangle;
    record.depth = fabsf(nearest.y - walker->feet.y);
    return tl_audit_records_add(walker->records, &record) == TL_OK;
}

// ---- Walks -------------------------------------------------------------------------------------------------

tl_audit_walker tl_audit_walker_make(const tl_audit_scene *scene, tl_nav_query *query, tl_audit_records *records)
{
    tl_audit_walker walker;
    memset(&walker, 0, sizeof walker);
    walker.scene = scene;
    walker.query = query;
    walker.records = records;
    return walker;
}

void tl_audit_walk_begin(tl_audit_walker *walker)
{
    walker->standing = false;
}

static bool is_step(const tl_audit_walker *walker, const floor_hit *floor)
{
    const tl_audit_scene *scene = walker->scene;
    const float slope = tl_maxf(floor->rise * scene->stride, walker->rise * SQRT_2 * scene->config.cell_size);
    return !walker->standing || fabsf(floor->y - walker->feet.y) <= scene->probe.step + slope;
}

// What was tried when no floor could be reached.
typedef struct floor_trial {
    tl_vec3 nearest;    ///< the first floor within a step, else the nearest one
    tl_shape_hit first; ///< what stopped the probe there
    bool stopped;       ///< something did
} floor_trial;

// Walks to the first floor that a probe of this radius can reach.
static bool reach_floor(tl_audit_walker *walker, float radius, tl_vec3 surface, const floor_hit *floors, uint32_t count,
                        floor_trial *trial)
{
    memset(trial, 0, sizeof *trial);
    trial->nearest = tl_vec3_make(surface.x, floors[0].y, surface.z);
    for (uint32_t i = 0; i < count; i++) {
        const tl_vec3 to = { surface.x, floors[i].y, surface.z };
        tl_shape_hit hit;
        if (!is_step(walker, &floors[i])) {
            continue;
        }
        if (can_walk_to(walker, radius, to, &hit)) {
            walker->feet = to;
            walker->rise = floors[i].rise;
            return true;
        }
        if (!trial->stopped) {
            trial->first = hit;
            trial->nearest = to;
            trial->stopped = true;
        }
    }
    return false;
}

// The first floor that can be reached; else the nearest one, with what is wrong about it.
static bool choose_floor(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 surface, const floor_hit *floors,
                         uint32_t count)
{
    floor_trial trial, thinner;
    bool done = true;
    if (!reach_floor(walker, walker->scene->probe.radius, surface, floors, count, &trial)) {
        const float radius = promised_radius(walker, polygon, surface);
        const bool promised = radius > 0.0f;
        if (!promised || (trial.stopped && radius < walker->scene->probe.radius &&
                          reach_floor(walker, radius, surface, floors, count, &thinner))) {
            walker->tolerated++;
        } else {
            done = trial.stopped ? record_blocked(walker, polygon, trial.nearest, &trial.first)
                                 : record_high_step(walker, polygon, trial.nearest, floors[0].triangle);
        }
        walker->feet = trial.nearest;
        walker->rise = 0.0f;
    }
    walker->polygon = polygon;
    walker->standing = true;
    return done;
}

bool tl_audit_walk_to(tl_audit_walker *walker, tl_nav_ref polygon, float x, float z)
{
    const tl_audit_scene *scene = walker->scene;
    tl_vec3 surface = { x, 0.0f, z };
    walker->steps++;
    if (tl_navmesh_height(scene->navmesh, polygon, x, z, &surface.y) != TL_OK) {
        walker->standing = false;
        return true;
    }
    floor_hit floors[MAX_FLOORS];
    uint32_t count = find_floors(scene, surface, floors);
    // Between planks one does not fall: the floor goes on at the height where one stands.
    const tl_vec3 level = { x, walker->standing ? walker->feet.y : surface.y, z };
    bool fits = false;
    for (uint32_t i = 0; i < count; i++) {
        fits = fits || is_step(walker, &floors[i]);
    }
    if (!fits && is_carried(scene, level, scene->probe.step + (walker->standing ? 0.0f : scene->probe.surface))) {
        const floor_hit carried = { level.y, 0.0f, TL_NO_TRIANGLE };
        floors[0] = carried;
        count = 1;
    }
    if (count == 0) {
        const bool promised = promised_radius(walker, polygon, surface) > 0.0f;
        walker->tolerated += promised ? 0 : 1;
        walker->standing = false;
        return !promised || record_no_floor(walker, polygon, surface);
    }
    return choose_floor(walker, polygon, surface, floors, count);
}

uint64_t tl_audit_line_steps(const tl_audit_scene *scene, tl_vec3 from, tl_vec3 to)
{
    const float dx = to.x - from.x, dz = to.z - from.z;
    const float strides = ceilf(sqrtf(dx * dx + dz * dz) / scene->stride);
    return strides >= 0x1p31f ? (uint64_t)1 << 31 : strides >= 1.0f ? (uint64_t)strides : 1;
}

bool tl_audit_walk_line(tl_audit_walker *walker, tl_nav_ref polygon, tl_vec3 from, tl_vec3 to, uint64_t first,
                        uint64_t end)
{
    const uint64_t count = tl_audit_line_steps(walker->scene, from, to);
    for (uint64_t i = first; i <= end && i <= count; i++) {
        const tl_vec3 at = tl_lerp(from, to, (float)i / (float)count);
        if (!tl_audit_walk_to(walker, polygon, at.x, at.z)) {
            return false;
        }
    }
    return true;
}
