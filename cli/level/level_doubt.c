// SPDX-License-Identifier: MIT
//
// Area by direction tells up axis and winding. Of 22 levels of games and robotics, indoors and out, floors and ceilings
// (|n.y| > cos 45) have at least 0.85 times the area of the walls along either axis, and floors at least 0.99 times
// that of ceilings; the limits below leave room beyond both. A level of closed solids has as many floors as ceilings,
// so that areas do not tell its winding; the signed volumes of its closed parts do. Of those levels none has parts that
// face inwards beyond 0.2 m3, but for rooms, which are few; turned round, 19 of the 22 are told. What neither tells, a
// shell of one part, stays unsaid: seen from outside it is a level too.

#include "cli/level/level_doubt.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Square metres of triangles by direction; flat means no steeper than the agent's slope.
typedef struct face_areas {
    double all;
    double up, down;  // flat
    double z_up;      // would be floors and ceilings with z as the up axis
    double x_wall;    // the same with x
    double mean_edge; // metres: side of the mean triangle's square
    double min_slope; // degrees, of the triangles that face up; 90 when none does
} face_areas;

static face_areas measure_faces(const tl_mesh_view *mesh, double max_slope)
{
    face_areas f = { 0, 0, 0, 0, 0, 0, 90 };
    const double degree = 3.14159265358979 / 180.0, flat = cos(max_slope * degree);
    const double upright = cos(30.0 * degree); // stricter: a steep slope is no wall
    double max_up = 0.0;
    for (uint32_t i = 0; i < mesh->triangle_count; ++i) {
        const uint32_t *t = &mesh->indices[3 * (size_t)i];
        const tl_vec3 a = mesh->vertices[t[0]], b = mesh->vertices[t[1]], c = mesh->vertices[t[2]];
        const double ux = (double)b.x - (double)a.x, uy = (double)b.y - (double)a.y, uz = (double)b.z - (double)a.z;
        const double vx = (double)c.x - (double)a.x, vy = (double)c.y - (double)a.y, vz = (double)c.z - (double)a.z;
        const double nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
        const double length = sqrt(nx * nx + ny * ny + nz * nz), area = 0.5 * length;
        if (!(length > 0.0)) {
            continue;
        }
        f.all += area;
        f.up += ny >= flat * length ? area : 0.0;
        f.down += -ny >= flat * length ? area : 0.0;
        f.z_up += fabs(nz) >= upright * length ? area : 0.0;
        f.x_wall += fabs(nx) >= upright * length ? area : 0.0;
        max_up = ny / length > max_up ? ny / length : max_up;
    }
    f.mean_edge = mesh->triangle_count > 0 ? sqrt(2.0 * f.all / mesh->triangle_count) : 0.0;
    f.min_slope = acos(max_up < 1.0 ? max_up : 1.0) / degree;
    return f;
}

static double longest_side(tl_aabb bounds)
{
    const tl_vec3 size = tl_aabb_size(bounds);
    return (double)fmaxf(size.x, fmaxf(size.y, size.z));
}

// Of three axes the one along which a level is by far the thinnest is up, when enough of it lies flat across that one;
// and else the one whose area differs, since the other two are both walls.
static bool lies_on_its_side(const face_areas *f, tl_aabb bounds)
{
    const tl_vec3 size = tl_aabb_size(bounds);
    const double floors = f->up + f->down;
    const float across = fminf(size.x, size.y);
    const bool other_two_alike = f->x_wall > 0.6 * floors && f->x_wall < 1.6 * floors;
    return (f->z_up > 1.3 * floors && size.z < 0.6f * across) ||
           (f->z_up > 2.5 * floors && f->z_up > 2.0 * f->x_wall) ||
           (f->z_up > 0.8 * floors && size.z < 0.25f * across) ||
           (f->z_up > floors && size.z < 0.5f * across && other_two_alike);
}

// Cubic metres that closed parts enclose, by the side that they face.
typedef struct closed_volumes {
    double outward, inward;
    uint32_t inward_count;
} closed_volumes;

static closed_volumes measure_closed(const tl_mesh_view *mesh)
{
    closed_volumes v = { 0.0, 0.0, 0 };
    tl_closed_parts parts;
    if (tl_closed_parts_find(mesh, NULL, &parts, NULL) != TL_OK) {
        return v; // no memory for a doubt is none
    }
    for (uint32_t i = 0; i < parts.part_count; i++) {
        v.outward += parts.volumes[i] > 0.0 ? parts.volumes[i] : 0.0;
        v.inward -= parts.volumes[i] < 0.0 ? parts.volumes[i] : 0.0;
        v.inward_count += parts.volumes[i] < 0.0;
    }
    tl_closed_parts_free(&parts);
    return v;
}

// Closed rooms face inwards rightly, but a level has few of them, and furniture in it that faces outwards.
static bool is_inside_out(const closed_volumes *v, double agent_height)
{
    enum { MIN_PARTS = 6 };
    return v->inward_count >= MIN_PARTS && v->inward > 3.0 * v->outward &&
           v->inward > 0.05 * agent_height * agent_height * agent_height;
}

static tl_level_doubt doubt_up_axis(const face_areas *f, const tl_bake_settings *settings)
{
    const bool turned = settings->level.up == TL_UP_Z || settings->level.up == TL_UP_Z_LEFT;
    tl_level_doubt doubt = { "up axis", "" };
    snprintf(doubt.text, sizeof(doubt.text),
             "most of the level stands upright: %.4g m2 of its %.4g m2 would lie flat with %s up, %.4g m2 do now; %s",
             f->z_up, f->all, turned ? "y" : "z", f->up + f->down,
             turned ? "is it y-up? leave out --up z" : "is it z-up? give --up z");
    return doubt;
}

static tl_level_doubt doubt_winding(const face_areas *f)
{
    tl_level_doubt doubt = { "winding", "" };
    snprintf(doubt.text, sizeof(doubt.text),
             "its floors face down: %.4g m2 of triangles face down and %.4g m2 up; triangles are to be wound "
             "counter-clockwise as seen from above, so turn them round in the export",
             f->down, f->up);
    return doubt;
}

static tl_level_doubt doubt_solids(const closed_volumes *v)
{
    tl_level_doubt doubt = { "winding", "" };
    snprintf(
        doubt.text, sizeof(doubt.text),
        "its solids are inside out: %u closed parts of %.4g m3 face inwards, and %.4g m3 outwards; triangles are to "
        "be wound counter-clockwise as seen from outside, so turn them round in the export",
        v->inward_count, v->inward, v->outward);
    return doubt;
}

static tl_level_doubt doubt_units(double longest, double scale, const tl_bake_settings *settings)
{
    tl_level_doubt doubt = { "units", "" };
    snprintf(doubt.text, sizeof(doubt.text),
             "the level is %.4g m long and the agent %.4g m high, as if its unit was no metre; if one unit is %.4g m, "
             "give --scale %.4g",
             longest, (double)settings->nav_def.agent_height, scale * (double)settings->level.scale,
             scale * (double)settings->level.scale);
    return doubt;
}

// Metres from one float to the next at the level's farthest coordinate.
static double float_step(tl_aabb bounds)
{
    const tl_vec3 a = bounds.min, b = bounds.max;
    const float farthest = fmaxf(fmaxf(fmaxf(-a.x, b.x), fmaxf(-a.y, b.y)), fmaxf(-a.z, b.z));
    return (double)nextafterf(farthest, INFINITY) - (double)farthest;
}

static bool doubt_precision(tl_aabb bounds, const tl_bake_settings *settings, tl_level_doubt *doubt)
{
    const tl_nav_def *def = &settings->nav_def;
    const double step = float_step(bounds), cell = (double)fminf(def->cell_size, def->cell_height);
    if (step > 0.1 * cell) {
        doubt->cause = "precision";
        snprintf(doubt->text, sizeof(doubt->text),
                 "coordinates reach so far from the origin that floats step by %.3g m there, more than a tenth of a "
                 "cell (%.3g m): triangles collapse and the navmesh is inexact; give --origin auto",
                 step, cell);
    }
    return step > 0.1 * cell;
}

tl_level_doubt tl_level_doubt_find(const tl_mesh_view *mesh, tl_aabb bounds, const tl_bake_settings *settings)
{
    enum { LARGE_METRES = 1000, LARGE_TRIANGLES = 20 }; // of agents' heights, a triangle
    const face_areas f = measure_faces(mesh, (double)settings->nav_def.agent_max_slope);
    const double longest = longest_side(bounds);
    tl_level_doubt precision = { NULL, "" };
    if (doubt_precision(bounds, settings, &precision)) {
        return precision;
    }
    if (lies_on_its_side(&f, bounds)) {
        return doubt_up_axis(&f, settings);
    }
    if (f.down > 2.0 * f.up) {
        return doubt_winding(&f);
    }
    if (longest > (double)LARGE_METRES && mesh->triangle_count >= 100 &&
        f.mean_edge > (double)LARGE_TRIANGLES * (double)settings->nav_def.agent_height) {
        return doubt_units(longest, 0.01, settings);
    }
    const closed_volumes closed = measure_closed(mesh);
    if (is_inside_out(&closed, (double)settings->nav_def.agent_height)) {
        return doubt_solids(&closed);
    }
    const tl_level_doubt none = { NULL, "" };
    return none;
}

// ---------------------------------------------------------------------------------------------------------
// Nothing is walkable.

static bool doubt_pruned(const tl_nav_prune_report *pruned, tl_level_doubt *doubt)
{
    const uint32_t islands = pruned->inside.islands + pruned->unreachable.islands + pruned->small.islands;
    if (islands > 0) {
        doubt->cause = "pruning";
        snprintf(doubt->text, sizeof(doubt->text),
                 "all %u islands were left out: %u inside solids, %u not reachable, %u smaller than --island-min-area",
                 islands, pruned->inside.islands, pruned->unreachable.islands, pruned->small.islands);
    }
    return islands > 0;
}

// Islands of fewer square metres together than `area` are leavings of another cause.
static bool doubt_filtered(const tl_nav_bake_report *nav, double area, tl_level_doubt *doubt)
{
    if (nav->filtered_regions > 0 && nav->filtered_area > area) {
        doubt->cause = "region_min_size";
        snprintf(doubt->text, sizeof(doubt->text),
                 "all of its islands, %u with %.4g m2 together, have fewer cells than --region-min-size squared; give "
                 "a smaller one, or a smaller --cell-size",
                 nav->filtered_regions, nav->filtered_area);
    }
    return doubt->cause != NULL;
}

// Square metres of a bake without the areas; 0 when it fails too.
static double walkable_with(const tl_cli *cli, const tl_level *level, const tl_nav_def *def)
{
    const tl_mesh_view mesh = tl_mesh_as_view(&level->mesh);
    tl_nav_input input;
    memset(&input, 0, sizeof(input));
    input.mesh = mesh;
    tl_nav_def own = *def;
    own.host = cli->host;
    own.host.progress = NULL;
    tl_nav_tiles tiles;
    double area = 0.0;
    if (tl_nav_bake(&own, &input, &tiles, NULL) == TL_OK) {
        for (uint32_t i = 0; i < tiles.tile_count; ++i) {
            area += tiles.tiles[i]->area;
        }
        tl_nav_tiles_free(&tiles);
    }
    return area;
}

static bool doubt_smaller(const tl_cli *cli, const tl_level *level, const tl_nav_def *def, float radius, float height,
                          tl_level_doubt *doubt)
{
    tl_nav_def smaller = *def;
    smaller.agent_radius = radius;
    smaller.agent_height = height;
    const double area = walkable_with(cli, level, &smaller);
    if (area > 0.0) {
        doubt->cause = "agent";
        snprintf(doubt->text, sizeof(doubt->text),
                 "the agent is too large: with --agent-radius %.3g and --agent-height %.3g, %.4g m2 are walkable",
                 (double)smaller.agent_radius, (double)smaller.agent_height, area);
    }
    return area > 0.0;
}

static bool doubt_agent(const tl_cli *cli, const tl_level *level, const tl_bake_settings *settings,
                        tl_level_doubt *doubt)
{
    const tl_nav_def def = tl_bake_nav_def(settings);
    if (walkable_with(cli, level, &def) > 0.0) {
        doubt->cause = "areas";
        snprintf(doubt->text, sizeof(doubt->text), "--area and --areas make all of its floors not walkable");
        return true;
    }
    for (int halves = 1; halves <= 3; ++halves) {
        const float part = halves < 3 ? ldexpf(1.0f, -halves) : 0.0f;
        const float radius = part * def.agent_radius;
        const float height = fmaxf(part * def.agent_height, 2.0f * def.cell_height);
        if (doubt_smaller(cli, level, &def, radius, def.agent_height, doubt) ||
            doubt_smaller(cli, level, &def, def.agent_radius, height, doubt) ||
            doubt_smaller(cli, level, &def, radius, height, doubt)) {
            return true;
        }
    }
    return false;
}

tl_level_doubt tl_level_explain_empty(const tl_cli *cli, const tl_level *level, const tl_bake_settings *settings,
                                      const tl_nav_bake_report *baked, const tl_nav_prune_report *pruned)
{
    tl_level_doubt doubt = { NULL, "" };
    const tl_mesh_view mesh = tl_mesh_as_view(&level->mesh);
    const tl_nav_def def = tl_bake_nav_def(settings);
    const tl_aabb bounds = level->mesh.bounds;
    const double longest = longest_side(bounds);
    const face_areas f = measure_faces(&mesh, (double)def.agent_max_slope);
    const double agent_area = 4.0 * (double)def.agent_radius * (double)def.agent_radius;
    if (doubt_pruned(pruned, &doubt) || doubt_filtered(baked, agent_area, &doubt)) {
        return doubt;
    }
    if (!tl_aabb_is_empty(def.bounds) && !tl_aabb_overlaps(def.bounds, bounds)) {
        doubt.cause = "bounds";
        snprintf(doubt.text, sizeof(doubt.text),
                 "--bounds lies beside the level, which reaches from %.6g,%.6g,%.6g to %.6g,%.6g,%.6g",
                 (double)bounds.min.x, (double)bounds.min.y, (double)bounds.min.z, (double)bounds.max.x,
                 (double)bounds.max.y, (double)bounds.max.z);
        return doubt;
    }
    if (longest < 2.0 * (double)def.agent_height) {
        // The power of ten that makes it 10 m and more.
        return doubt_units(longest, pow(10.0, ceil(1.0 - log10(longest))), settings);
    }
    if (f.up < 0.25 * f.down) {
        return doubt_winding(&f);
    }
    if (lies_on_its_side(&f, bounds) || (f.up <= 0.0 && f.z_up > 0.25 * f.all)) {
        return doubt_up_axis(&f, settings);
    }
    if (f.up <= 0.0 && f.min_slope < 89.0) {
        doubt.cause = "slope";
        snprintf(doubt.text, sizeof(doubt.text),
                 "all of it is too steep: its flattest triangle slopes %.3g degrees, --agent-max-slope is %.3g",
                 f.min_slope, (double)def.agent_max_slope);
        return doubt;
    }
    if (!doubt_agent(cli, level, settings, &doubt) && !doubt_filtered(baked, 0.0, &doubt)) {
        doubt.cause = "unknown";
        snprintf(doubt.text, sizeof(doubt.text),
                 "%.4g m2 of its triangles are floor by their slope, but none has room for the agent; talus why FILE "
                 "X,Y,Z explains a point",
                 f.up);
    }
    return doubt;
}
